//! Records that say nothing, or very much: one clear message, or an honest verdict.

use std::path::PathBuf;

use crate::common::{COIL, Folder, stderr, stdout};

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/concealed/open/case_13");
const HEAD: &str = "time_s,chamber_c,spool_c,rate_deg_per_h\n";

/// A record of rows, each with noise of its own in [-1, 1].
fn record(rows: usize, row: impl Fn(usize, [f64; 3]) -> [f64; 4]) -> String {
    let mut state = 7_u64;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..rows).fold(HEAD.to_owned(), |text, n| {
        let [time, chamber, spool, rate] = row(n, [noise(), noise(), noise()]);
        text + &format!("{time},{chamber:.2},{spool:.2},{rate:.5}\n")
    })
}

/// The rows of the fixture's record, each changed.
fn changed(row: impl Fn(usize, &[&str]) -> String) -> String {
    let text = std::fs::read_to_string(format!("{CASE}/fit.csv")).unwrap();
    let rows = text.lines().skip(1).enumerate().map(|(n, line)| row(n, &line.split(',').collect::<Vec<_>>()));
    rows.fold(HEAD.to_owned(), |text, row| text + &row + "\n")
}

fn folder() -> (Folder, PathBuf) {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let report = folder.path("r.html");
    (folder, report)
}

#[test]
fn a_record_without_information_is_refused_in_one_message() {
    let empty = |column: usize| {
        changed(|_, fields| (0..4).map(|k| if k == column { "" } else { fields[k] }).collect::<Vec<_>>().join(","))
    };
    for (content, says) in [
        (String::new(), "is empty"),
        (HEAD.to_owned(), "no row"),
        (empty(3), "rate_deg_per_h: has no value"),
        (empty(1), "chamber"),
        (changed(|_, f| format!("{},{},{},0.1", f[0], f[1], f[2])), "0.1 deg/h throughout"),
        (record(40, |n, e| [30.0 * n as f64, 20.0, 20.0, 0.01 * e[0]]), "too few"),
    ] {
        let (folder, report) = folder();
        folder.write("r.csv", content);
        let output = folder.run(&["diagnose", "coil.ron", "--fit", "r.csv", "--model-out", "m.ron", "--report", "r.html"]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{says}: {message}{}", stdout(&output));
        assert_eq!(message.lines().filter(|line| line.starts_with("error:")).count(), 1, "{message}");
        assert!(message.contains("r.csv") && message.contains(says), "`{says}` in {message}");
        assert!(!report.exists() && !folder.path("m.ron").exists());
    }
}

/// The verdict and the page for a record that can be used.
fn verdict(content: &str) -> (String, String, String) {
    let (folder, report) = folder();
    folder.write("r.csv", content);
    let output = folder.run(&["diagnose", "coil.ron", "--fit", "r.csv", "--json", "j.json", "--report", "r.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.path("j.json")).unwrap()).unwrap();
    let page = std::fs::read_to_string(report).unwrap();
    assert!(page.ends_with("</html>\n") && !page.contains("NaN") && !page.contains(">inf"));
    (json["verdict"].as_str().unwrap().to_owned(), stdout(&output) + &stderr(&output), page)
}

/// The cause of the spool's movement was not recorded.
#[test]
fn a_dead_chamber_beside_a_moving_spool_is_refused() {
    let (folder, report) = folder();
    folder.write("r.csv", changed(|_, f| format!("{},20.00,{},{}", f[0], f[2], f[3])));
    let output = folder.run(&["diagnose", "coil.ron", "--fit", "r.csv", "--report", "r.html", "--json", "j.json"]);
    let message = stderr(&output);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""), "{message}");
    let says = "error: r.csv: chamber_c: is 20 degC throughout, while the spool moves by ";
    assert!(message.lines().any(|line| line.starts_with(says) && line.contains("check the chamber's sensor")), "{message}");
    assert!(!report.exists() && !folder.path("j.json").exists());
}

/// `diagnose` says no more of a record than `check` does.
#[test]
fn what_check_refuses_or_doubts_is_refused_or_doubted() {
    let refused = |content: String, says: &str| {
        let (folder, _) = folder();
        folder.write("r.csv", content);
        let output = folder.run(&["diagnose", "coil.ron", "--fit", "r.csv"]);
        assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""));
        assert!(stderr(&output).contains(says), "`{says}` in {}", stderr(&output));
    };
    let number = |text: &str| text.parse::<f64>().unwrap();
    refused(changed(|_, f| format!("{},{}e300,{},{}", f[0], f[1], f[2], f[3])), "r.csv:2: chamber_c: ");
    refused(changed(|_, f| format!("{},{},{}e300,{}", f[0], f[1], f[2], f[3])), "r.csv:2: spool_c: ");
    refused(changed(|_, f| format!("{},{},{},{:e}", f[0], f[1], f[2], number(f[3]) / 3600.0)), "is it in deg/s");
    let fahrenheit = |text: &str| format!("{:.2}", 1.8 * number(text) + 32.0);
    let text = changed(|_, f| format!("{},{},{},{}", f[0], fahrenheit(f[1]), fahrenheit(f[2]), f[3]));
    let (_, notes, _) = verdict(&text.lines().take(66).fold(String::new(), |some, line| some + line + "\n"));
    for channel in ["chamber_c", "spool_c"] {
        let hint = format!("warning: r.csv: {channel}: starts at ");
        let said = notes.lines().filter(|line| line.starts_with(&hint) && line.contains("is it in degF?"));
        assert_eq!(said.count(), 1, "on the page of text or beside it, once: {notes}");
    }
}

#[test]
fn a_soak_or_an_hour_names_nothing() {
    let soak = record(300, |n, e| [30.0 * n as f64, 20.0 + 0.01 * e[0], 20.0 + 0.01 * e[1], 0.03 + 0.01 * e[2]]);
    let (soaked, notes, _) = verdict(&soak);
    assert_eq!(soaked, "none");
    assert!(notes.contains("the chamber moves by"), "{notes}");
    let hour: String =
        std::fs::read_to_string(format!("{CASE}/fit.csv")).unwrap().lines().take(121).map(|l| l.to_owned() + "\n").collect();
    assert_eq!(verdict(&hour).0, "none");
}
