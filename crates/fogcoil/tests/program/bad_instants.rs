//! Recordings whose instants, or whose numbers, cannot be what they say: one message, exit status 2.

use crate::common::{COIL, Folder, stderr, stdout};

const HEADER: &str = "time_s,chamber_c,spool_c,rate_deg_per_h";

/// A table of these instants, each beside values that vary.
fn table(instants: impl IntoIterator<Item = String>) -> String {
    let row = |(n, t): (usize, String)| format!("{t},{},20,{}\n", 20 + n % 7, n * n % 5);
    format!("{HEADER}\n") + &instants.into_iter().enumerate().map(row).collect::<String>()
}

fn refuse(content: &str, arguments: &[&str], parts: &[&str]) {
    let folder = Folder::new();
    folder.write("r.csv", content);
    let output = folder.run(&[&["check", "r.csv"], arguments].concat());
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}{}", stdout(&output));
    assert_eq!((message.lines().count(), stdout(&output).as_str()), (1, ""), "{message}");
    parts.iter().for_each(|part| assert!(message.contains(part), "`{part}` in {message}"));
}

fn told(content: &str, arguments: &[&str], parts: &[&str]) {
    let folder = Folder::new();
    folder.write("r.csv", content);
    let output = folder.run(&[&["check", "r.csv"], arguments].concat());
    let said = stdout(&output) + &stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    parts.iter().for_each(|part| assert!(said.contains(part), "`{part}` in {said}"));
}

#[test]
fn instants_are_bounded() {
    let seconds = |n: usize| (30 * n).to_string();
    let far = (0..121).map(|n| if n == 120 { "1e300".into() } else { seconds(n) });
    refuse(&table(far), &[], &["r.csv:122: time_s: 1e300 s is beyond 1e12 s", "--unit time=UNIT"]);
    refuse(&table((0..9).map(|n| format!("{n}e306"))), &[], &["r.csv:3: time_s: 1e306 s is beyond 1e12 s"]);
    refuse(
        &table((0..9).map(seconds)).replace("time_s", "t"),
        &["--column", "time=t", "--unit", "time=h", "--scale", "time=1e9"],
        &["r.csv:3: t: "],
    );
    let without = "rate_deg_per_h\n1\n2\n3\n";
    refuse(without, &["--interval", "1e10"], &["--interval: 10000000000 s is not an interval"]);
}

#[test]
fn a_meta_file_is_bounded_too() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("r.csv", table((0..121).map(|n| (30 * n).to_string())));
    for (interval, says) in [
        ("1e308", "meta.ron:1: sample_interval_s: 1e308 s is not an interval of 0 to 1e9 s"),
        ("-1.0", "meta.ron:1: sample_interval_s: -1e0 s is not an interval"),
        ("3601.0", "meta.ron: sample_interval_s: 3601 s is longer than the recording, 3600 s"),
    ] {
        folder.write("meta.ron", format!("(sample_interval_s: {interval})"));
        for arguments in [&["check", "r.csv"][..], &["diagnose", "coil.ron", "--fit", "r.csv"]] {
            let output = folder.run(arguments);
            assert_eq!(output.status.code(), Some(2));
            assert!(stderr(&output).contains(says), "`{says}` in {}", stderr(&output));
        }
    }
}

#[test]
fn days_that_are_not_and_zones_that_come_and_go() {
    let day = |n: usize| format!("2026-02-{:02}T00:00:00Z", 20 + n);
    refuse(&table((0..11).map(day)), &[], &["r.csv:11: time_s: `2026-02-29T00:00:00Z` is a day that its month does not have"]);
    let german = |n: usize| format!("{:02}.04.2026 08:00", 21 + n);
    refuse(&table((0..11).map(german)), &[], &["r.csv:12: time_s: `31.04.2026 08:00` is a day"]);
    let mixed = |first: &'static str, then: &'static str| {
        (0..9).map(move |n| format!("2026-03-01T00:00:0{n}{}", if n == 0 { first } else { then }))
    };
    refuse(&table(mixed("", "Z")), &[], &["r.csv:3: time_s: `2026-03-01T00:00:01Z` has a zone, but the first instant has none"]);
    refuse(
        &table(mixed("+01:00", "")),
        &[],
        &["r.csv:3: time_s: `2026-03-01T00:00:01` has no zone, but the first", "give every instant its zone"],
    );
    // zones that differ are zones
    let folder = Folder::new();
    folder
        .write("r.csv", table(mixed("+01:00", "+01:00").take(5).chain(mixed("", "Z").skip(5).map(|t| t.replace("T00", "T01")))));
    assert_eq!(folder.run(&["check", "r.csv"]).status.code(), Some(0));
}

#[test]
fn a_remark_below_the_rows() {
    let rows = table((0..40).map(|n| (30 * n).to_string()));
    for footer in ["Ende der Messung,,,\n", "*** recording ended ***\n", "# end\n\n# of it\n"] {
        told(
            &(rows.clone() + footer),
            &[],
            &["note: ", "begins in line 42", "which is not read [footer]", "rows kept       40  of 40"],
        );
    }
    let between = rows.replacen("\n60,", "\npause\n60,", 1);
    refuse(&between, &[], &["r.csv:4: holds no number, and rows follow; if the line is a remark, remove it"]);
}

#[test]
fn names_that_stand_again_are_no_row() {
    let rows = table((0..40).map(|n| (30 * n).to_string()));
    let names = rows.lines().next().unwrap().to_owned();
    let again = rows.replacen("\n600,", &format!("\n{names}\n600,"), 1);
    told(&again, &[], &["note: ", "line 22 holds the names again", "[names-again]", "rows kept       40  of 40"]);
}

#[test]
fn a_point_beside_a_decimal_comma() {
    let row = |n: usize| format!("{};{}.{:03}\n", 30 * n, 1 + n % 3, 7 * n);
    let text = "time_s;rate_deg_per_h\n".to_owned() + &(0..100).map(row).collect::<String>();
    let says = ["r.csv:2: rate_deg_per_h: `1.000` has a point, but decimals have a comma here", "thousands", "decimal_comma"];
    refuse(&text, &["--separator", ";", "--decimal-comma"], &says);
    refuse(
        &text.replace("1.000", "1.234,5"),
        &["--separator", ";", "--decimal-comma"],
        &["r.csv:2: rate_deg_per_h: `1.234,5` has a point"],
    );
}

#[test]
fn an_interval_stands_for_a_clock_that_is_wrong() {
    let told = |content: &str, interval: &str, parts: &[&str]| told(content, &["--interval", interval], parts);
    let plain = table((0..121).map(|n| (30 * n).to_string()));
    let unread = "the instants of the column `time_s` are not read: the interval that was declared stands for them";
    let lasts = "the rows last 120 s, by the column 3600 s";
    told(&plain, "1", &["warning: ", unread, lasts, "span         120.0  s"]);
    // without seconds, put back by an hour, and one that cannot be read
    let back = |n: usize| format!("2026-10-25T0{}:{:02}:00Z", if n < 180 { n / 60 } else { n / 60 - 1 }, n % 60);
    told(&table((0..300).map(back)), "60", &["note: ", unread, "the rows last 17940 s, by the column 14340 s"]);
    told(&plain.replace("\n60,", "\nabc,"), "30", &["note: ", unread, "the rows last 3600 s ["]);
}

#[test]
fn no_flag_is_ignored() {
    let dates = table((0..60).map(|n| format!("2026-03-01T00:{n:02}:00Z")));
    refuse(&dates, &["--unit", "time=ms"], &["r.csv:2: time_s: `2026-03-01T00:00:00Z` is a date, which has no unit or scale"]);
    refuse(&dates, &["--scale", "time=2"], &["r.csv:2: time_s: "]);
    let bare = "time_s,rate_deg_per_h\n0,1\n30,2\n60,1\n";
    refuse(bare, &["--unit", "spool=K"], &["r.csv:1: spool_c: the column is missing"]);
    refuse(bare, &["--scale", "chamber=0.1"], &["r.csv:1: chamber_c: the column is missing"]);
    refuse(bare, &["--unit", "rate=deg/s", "--unit", "rate=deg/h"], &["--unit: rate is given twice"]);
    refuse(bare, &["--column", "rate=a", "--column", "rate=b"], &["--column: rate is given twice"]);
}

/// A clock by the minute beside rows of half of one: the rows are counted, and those that the logger lost stay lost.
#[test]
fn lost_rows_stay_lost_where_an_interval_stands_for_the_clock() {
    let stamp = |n: usize| format!("03/04/2026 {:02}:{:02} AM", n / 120, n % 120 / 2);
    let sound = table((120..420).map(stamp));
    let lost = table((120..420).filter(|n| !(200..220).contains(n) && !(300..307).contains(n)).map(stamp));
    let with_gaps = "gaps             2  (27 rows missing)";
    let but = "stands for them, but for 2 gaps, over which its clock goes on; the rows last 8970 s, by the column 8940 s";
    let interval = &["--interval", "30"];
    told(&lost, interval, &["note: ", with_gaps, but]);
    told(&sound, interval, &["gaps             0", "stands for them; the rows last 8970 s, by the column 8940 s"]);
    let first = table((120..420).filter(|n| !(121..140).contains(n)).map(stamp));
    told(&first, interval, &["gaps             1  (19 rows missing)", "but for a gap, over which its clock goes on"]);
}
