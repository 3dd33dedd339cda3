//! `fogcoil sweep` as a user runs it: the same rows whatever computes them, what tolerances make of them, what is refused.

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use charts::faults;
use fogcoil::schema::misfit;
use serde_json::Value;

use crate::common::{CELL, COIL, Folder, change, schema, stderr, stdout};

fn swept(folder: &Folder, arguments: &[&str]) -> Value {
    let output = folder.run(&[&["sweep"], arguments, &["--json", "--quiet"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(misfit(&json, &schema("sweep")), None);
    json
}

fn with_plan(plan: &str) -> Folder {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("plan.ron", plan);
    folder
}

/// Column `name` of a table in CSV without quotes.
fn column(folder: &Folder, file: &str, name: &str) -> Vec<String> {
    let text = fs::read_to_string(folder.path(file)).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let place = lines.next().unwrap().iter().position(|head| head == name).unwrap();
    lines.map(|line| line[place].clone()).collect()
}

fn on_threads(folder: &Folder, count: &str, arguments: &[&str]) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fogcoil"));
    let output = command.args(arguments).env("RAYON_NUM_THREADS", count).current_dir(folder.path("")).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

#[test]
fn tolerances_make_of_the_sensitivity_what_is_said_to_first_order() {
    let folder = with_plan("(design: \"coil.ron\", sampling: LatinHypercube(200), others: WithinTolerances)");
    let json = swept(&folder, &["plan.ron", "--out", "t.csv"]);
    let total = json["outputs"].as_array().unwrap().iter().find(|output| output["name"] == "total").unwrap();
    let [sampled, linear] = [&total["sd"], &json["linear_sd"]].map(|value| value.as_f64().unwrap());
    assert!((sampled / linear - 1.0).abs() < 0.1, "{sampled} {linear}");
    let band: Value = serde_json::from_str(&stdout(&folder.run(&["sensitivity", "coil.ron", "--json"]))).unwrap();
    assert_eq!(band["tolerance_sd"], json["linear_sd"]);
    // no design to build is the best of those that tolerances make
    assert_eq!(json["smallest"], Value::Null);
    // what a plan draws is what the file says at its keys: E_r by 10 %, G with it
    let numbers = |key: &str| column(&folder, "t.csv", key).iter().map(|text| text.parse().unwrap()).collect::<Vec<f64>>();
    let modulus = numbers("coil.material.e_r_mpa");
    let mean = modulus.iter().sum::<f64>() / 200.0;
    let sd = (modulus.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 199.0).sqrt();
    assert!((mean / 95.2 - 1.0).abs() < 0.005 && (sd / 9.52 - 1.0).abs() < 0.05, "{mean} {sd}");
    let tails = numbers("winding.tails_m.cw").into_iter().zip(numbers("winding.tails_m.ccw"));
    let longer: Vec<f64> = tails.map(|(cw, ccw)| if cw.min(ccw) >= 0.0 { cw - ccw } else { f64::NAN }).collect();
    let sd = (longer.iter().map(|by| by * by).sum::<f64>() / 200.0).sqrt();
    assert!((sd / (0.02 * 2_f64.sqrt()) - 1.0).abs() < 0.2, "{sd}");
}

#[test]
fn the_same_bytes_on_any_threads_in_shares_and_after_a_kill() {
    let plan =
        "(design: \"coil.ron\", sampling: MonteCarlo(150), seed: 3, others: WithinTolerances, outputs: [Sensitivity, Winding])";
    let folder = with_plan(plan);
    on_threads(&folder, "2", &["sweep", "plan.ron", "--out", "two.parquet"]);
    let expected = fs::read(folder.path("two.parquet")).unwrap();
    for number in ["2/3", "1/3", "2/3"] {
        on_threads(&folder, "1", &["sweep", "plan.ron", "--out", "shares.parquet", "--share", number]);
    }
    assert!(!folder.path("shares.parquet").exists() && folder.path("shares.parquet.parts").exists());
    let merge = ["sweep", "plan.ron", "--out", "shares.parquet", "--merge"];
    let refused = folder.run(&merge);
    let said = "shares.parquet.parts: of 150 rows of this plan by this program 54 are missing, the first from point 96";
    assert!(refused.status.code() == Some(2) && stderr(&refused).contains(said), "{}", stderr(&refused));
    on_threads(&folder, "1", &["sweep", "plan.ron", "--out", "shares.parquet", "--share", "3/3"]);
    on_threads(&folder, "1", &merge);
    assert!(fs::read(folder.path("shares.parquet")).unwrap() == expected);
    // killed once the first rows are kept
    let mut command = Command::new(env!("CARGO_BIN_EXE_fogcoil"));
    let arguments = ["sweep", "plan.ron", "--out", "killed.parquet", "--quiet"];
    command.args(arguments).env("RAYON_NUM_THREADS", "1").current_dir(folder.path("")).stdout(Stdio::null());
    let mut run = command.spawn().unwrap();
    let parts = folder.path("killed.parquet.parts");
    let kept = || fs::read_dir(&parts).map_or(0, |files| files.flatten().filter(|f| f.path().extension().is_some()).count());
    let begun = Instant::now();
    while kept() == 0 && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(kept() > 0 && !folder.path("killed.parquet").exists());
    on_threads(&folder, "2", &arguments);
    assert!(fs::read(folder.path("killed.parquet")).unwrap() == expected && !parts.exists());
    assert_eq!(folder.names(), ["coil.ron", "killed.parquet", "plan.ron", "shares.parquet", "two.parquet"]);
}

#[test]
fn a_folder_gets_both_tables_and_a_page() {
    let folder = with_plan("(design: \"coil.ron\", sampling: Indices(8), others: WithinTolerances)");
    swept(&folder, &["plan.ron", "--out", "t.csv"]);
    swept(&folder, &["plan.ron", "--out", "t.parquet"]);
    let json = swept(&folder, &["plan.ron", "--out", "swept"]);
    for format in ["csv", "parquet"] {
        let [alone, within] = ["t", "swept/table"].map(|name| fs::read(folder.path(&format!("{name}.{format}"))).unwrap());
        assert!(alone == within, "{format}");
    }
    let page = fs::read_to_string(folder.path("swept/report.html")).unwrap();
    assert!(faults(&page).is_empty(), "{:?}", faults(&page));
    for said in ["points, seed 0", "Sobol", "plan.ron", "coil.ron", "Numerical error of a sensitivity: about "] {
        assert!(page.contains(said), "{said}");
    }
    // it is a folder now, whatever its name
    let other = swept(&folder, &["plan.ron", "--out", "swept/"]);
    assert_eq!(other["outputs"], json["outputs"]);
    assert_eq!(fs::read_dir(folder.path("swept")).unwrap().count(), 3);
}

#[test]
fn a_grid_has_the_designs_that_a_user_would_write() {
    let plan = "(design: \"coil.ron\", sampling: Grid, vary: {\
        \"spool.hub_thickness_mm\": Steps(3.0, 5.0, 2), \"winding.cw_climbs\": OneOf([\"Right\", \"Left\"]),\
        \"spool.flanges\": Named({\"one\": \"[(side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true)]\", \"none\": \"[]\"})})";
    let folder = with_plan(plan);
    let json = swept(&folder, &["plan.ron", "--out", "g.csv", "--svg", "g.svg"]);
    // the sensitivity against the only number, a colour for each pair of names
    let picture = fs::read_to_string(folder.path("g.svg")).unwrap();
    for said in ["spool.hub_thickness_mm", ">Left, none<", ">Left, one<", ">Right, none<", ">Right, one<", "Of 8 designs"] {
        assert!(picture.contains(said), "{said}");
    }
    assert_eq!((json["points"].as_u64(), json["failed"].as_u64(), &json["linear_sd"]), (Some(8), Some(0), &Value::Null));
    let total = column(&folder, "g.csv", "total");
    assert_eq!(column(&folder, "g.csv", "spool.flanges")[..4], ["one", "none", "one", "none"]);
    assert_eq!(column(&folder, "g.csv", "winding.cw_climbs")[1..3], ["Right", "Left"]);
    let other = change(&change(COIL, "hub_thickness_mm: 4.0", "hub_thickness_mm: 5.0"), "cw_climbs: Right", "cw_climbs: Left");
    folder.write("other.ron", other);
    let alone: Value = serde_json::from_str(&stdout(&folder.run(&["sensitivity", "other.ron", "--json", "--quiet"]))).unwrap();
    assert_eq!(total[6].parse::<f64>().ok(), alone["total"].as_f64());
    // the best design is told by its keys, and is the one of the table
    let magnitude = |n: &usize| total[*n].parse::<f64>().unwrap().abs();
    let best = (0..8).min_by(|a, b| magnitude(a).total_cmp(&magnitude(b))).unwrap();
    let row = |key: &str| column(&folder, "g.csv", key)[best].clone();
    let told = &json["smallest"];
    assert_eq!((told["point"].as_u64(), told["total"].as_f64()), (Some(best as u64), total[best].parse().ok()));
    let hub = told["values"]["spool.hub_thickness_mm"].as_f64();
    assert_eq!(hub, row("spool.hub_thickness_mm").parse().ok());
    for key in ["spool.flanges", "winding.cw_climbs"] {
        assert_eq!(told["values"][key], row(key), "{key}");
    }
}

/// Cells of one coil are exchanged in both places by one key; in one place alone they are warned of.
#[test]
fn keys_that_belong_together_get_one_value() {
    let keys = |key: &str| {
        format!(
            "(design: \"coil.ron\", sampling: Grid, vary: {{\"{key}\": Named({{\"soft\": \"FromCell(\\\"soft.ron\\\")\", \
             \"stiff\": \"FromCell(\\\"stiff.ron\\\")\"}})}})"
        )
    };
    let folder = with_plan(&keys("coil.material and dehomogenization"));
    folder.write("soft.ron", CELL);
    folder.write("stiff.ron", change(CELL, "youngs_modulus_mpa: 5.593", "youngs_modulus_mpa: 11.0"));
    let both = |cell: &str| {
        let (start, end) = (COIL.find("Constants((").unwrap(), COIL.find("))").unwrap() + 2);
        let material = change(COIL, &COIL[start..end], &format!("FromCell({cell:?})"));
        let (start, end) = (material.find("Matrix((").unwrap(), material.rfind("))").unwrap() + 2);
        change(&material, &material[start..end], &format!("FromCell({cell:?})"))
    };
    folder.write("coil.ron", both("soft.ron"));
    swept(&folder, &["plan.ron", "--out", "both.csv"]);
    folder.write("other.ron", both("stiff.ron"));
    let alone: Value = serde_json::from_str(&stdout(&folder.run(&["sensitivity", "other.ron", "--json", "--quiet"]))).unwrap();
    assert_eq!(column(&folder, "both.csv", "total")[1].parse::<f64>().ok(), alone["total"].as_f64());
    let warned = |plan: &str| {
        folder.write("plan.ron", plan);
        stderr(&folder.run(&["sweep", "plan.ron", "--out", "mixed.csv"])).contains("[other-cell]")
    };
    assert!(warned(&keys("coil.material")) && !warned(&keys("coil.material and dehomogenization")));
    // the dimensions of a coil that follows its winding are not those of the plan's text
    let following = change(&keys("coil.material and dehomogenization"), "sampling", "dimensions: FollowWinding, sampling");
    folder.write("plan.ron", &following);
    assert!(!stderr(&folder.run(&["sweep", "plan.ron", "--out", "follow.csv"])).contains("warning"));
    // rows of another content of a cell are rows of another plan
    folder.write("plan.ron", keys("coil.material and dehomogenization"));
    let share = |share: &str| folder.run(&["sweep", "plan.ron", "--out", "shares.csv", "--share", share]);
    assert!(["1/2", "2/2"].iter().all(|k| share(k).status.code() == Some(0)));
    folder.write("stiff.ron", change(CELL, "youngs_modulus_mpa: 5.593", "youngs_modulus_mpa: 12.0"));
    let merged = folder.run(&["sweep", "plan.ron", "--out", "shares.csv", "--merge"]);
    assert_eq!(merged.status.code(), Some(2), "{}", stderr(&merged));
}

#[test]
fn a_body_follows_its_winding_and_what_cannot_be_says_why() {
    let varied = "\"winding.layers\": OneOf([32, 36, 40]), \"winding.turns_odd_layers\": OneOf([80, 106])";
    let plan = |dimensions: &str| {
        format!(
            "(design: \"coil.ron\", sampling: Grid, vary: {{{varied}}}, dimensions: {dimensions}, outputs: [Sensitivity, Winding])"
        )
    };
    let folder = with_plan(&plan("FollowWinding"));
    assert_eq!(swept(&folder, &["plan.ron", "--out", "f.csv"])["failed"], 0);
    let numbers = |name: &str| column(&folder, "f.csv", name).iter().map(|text| text.parse().unwrap()).collect::<Vec<f64>>();
    let (outer, height, turns) = (numbers("outer_radius_mm"), numbers("height_mm"), numbers("turns"));
    // the fourth is the drawing; four layers more are four rows of turns more
    assert_eq!((outer[3], height[3], turns[3]), (48.825, 18.02, 3798.0));
    assert!(
        (outer[5] - outer[3] - 4.0 * 0.170 * 0.75_f64.sqrt()).abs() < 1e-9 && (height[3] - height[2] - 26.0 * 0.170).abs() < 1e-9
    );
    folder.write("plan.ron", plan("AsDrawn"));
    let json = swept(&folder, &["plan.ron", "--out", "d.csv"]);
    let problems = fs::read_to_string(folder.path("d.csv")).unwrap();
    assert!(json["failed"].as_u64().unwrap() >= 3 && problems.contains("set it to 80 or to one less"), "{json} {problems}");
}

/// An end up to which the turns are spread moves with their number: turns that touch are those of a drawing without ends, others keep their spacing.
#[test]
fn an_end_of_the_winding_follows_its_turns() {
    let varied = "\"winding.layers\": OneOf([1, 36]), \"winding.turns_odd_layers\": OneOf([80, 106])";
    let plan = format!(
        "(design: \"coil.ron\", sampling: Grid, vary: {{{varied}}}, dimensions: FollowWinding, outputs: [Sensitivity, Winding])"
    );
    let folder = with_plan(&plan);
    let numbers = |ends: &str, name: &str| {
        folder.write("coil.ron", change(COIL, "cw_climbs: Right", &format!("{ends}cw_climbs: Right")));
        assert_eq!(swept(&folder, &["plan.ron", "--out", "f.csv"])["failed"], 0);
        column(&folder, "f.csv", name).iter().map(|text| text.parse().unwrap()).collect::<Vec<f64>>()
    };
    for name in ["height_mm", "total"] {
        let (touching, ended) = (numbers("", name), numbers("start_mm: 0.0, end_mm: 18.02, ", name));
        assert!(touching.iter().zip(&ended).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{name}: {touching:?} {ended:?}");
    }
    // 106 turns in 17.96 mm
    let spread = numbers("start_mm: 0.03, end_mm: 17.99, ", "height_mm");
    assert!((spread[3] - 18.02).abs() < 1e-9 && (spread[3] - spread[2] - 26.0 * 17.96 / 106.0).abs() < 1e-9, "{spread:?}");
}

/// Its thermometer at the bore follows a hub of another thickness, so that it is never left in the air, where a film says nothing.
#[test]
fn a_thermometer_at_the_bore_stays_there() {
    let plan = "(design: \"coil.ron\", sampling: Grid, vary: {\"spool.hub_thickness_mm\": Steps(1.5, 6.0, 10)}, dimensions: FollowWinding)";
    let folder = with_plan(plan);
    let dehomogenization = "    dehomogenization: Matrix";
    folder.write(
        "coil.ron",
        change(COIL, dehomogenization, &format!("    heat: (film_w_per_m2k: Some(14.0)),\n{dehomogenization}")),
    );
    let json = swept(&folder, &["plan.ron", "--out", "f.csv"]);
    assert_eq!((&json["designs"], &json["failed"]), (&10.into(), &0.into()), "{json}");
    folder.write("plan.ron", change(plan, "FollowWinding", "AsDrawn"));
    assert!(swept(&folder, &["plan.ron", "--out", "d.csv"])["failed"].as_u64().unwrap() > 0);
}

#[test]
fn the_spread_comes_from_the_part_that_varies() {
    let varied = "\"spool.material.thermal_expansion_per_k\": Normal(23.6e-6, 0.5e-6), \"winding.tails_m\": Tolerance";
    let folder = with_plan(&format!("(design: \"coil.ron\", sampling: Indices(64), seed: 2, vary: {{{varied}}})"));
    let json = swept(&folder, &["plan.ron", "--out", "i.parquet", "--svg", "i.svg"]);
    assert_eq!(json["points"], 64 * 4);
    let groups = json["indices"]["groups"].as_array().unwrap();
    let of =
        |name: &str, kind: &str| groups.iter().find(|group| group["group"] == name).unwrap()[kind]["value"].as_f64().unwrap();
    // two numbers that add up: alone and in all are one, and both groups are everything
    for name in ["spool", "winding"] {
        assert!((of(name, "first") - of(name, "total")).abs() < 0.15, "{json}");
    }
    assert!((of("spool", "total") + of("winding", "total") - 1.0).abs() < 0.1, "{json}");
    assert!(of("spool", "total") > 0.05 && of("winding", "total") > 0.05, "{json}");
    let picture = fs::read_to_string(folder.path("i.svg")).unwrap();
    assert!(picture.contains(">spool</text>") && picture.contains("90 % intervals"));
}

#[test]
fn bad_plans_are_refused_and_nothing_is_written() {
    let good = "(design: \"coil.ron\", sampling: Sobol(8), vary: {\"spool.hub_thickness_mm\": Uniform(3.0, 5.0)})";
    let folder = with_plan(good);
    let vary = "\"spool.hub_thickness_mm\": Uniform(3.0, 5.0)";
    let cases = [
        (change(good, "hub_thickness_mm", "hub"), "vary: spool.hub: "),
        (change(good, "hub_thickness_mm", "hub"), "unknown field"),
        (change(good, "Uniform(3.0, 5.0)", "Uniform(5.0, 3.0)"), "from 5 to 3 is no range"),
        (change(good, "Uniform(3.0, 5.0)", "Uniform(NaN, 3.0)"), "is no range"),
        (change(good, "Uniform(3.0, 5.0)", "Uniform(-5.0, -3.0)"), "hub_thickness_mm"),
        (change(good, "Uniform(3.0, 5.0)", "Sometimes"), "plan.ron:1"),
        (change(good, vary, ""), "0 numbers and choices vary"),
        (
            change(good, vary, &format!("{vary}, \"spool.hub_thickness_mm and spool.hub_thickness_mm\": Uniform(2.0, 3.0)")),
            "varies by two keys",
        ),
        (change(good, vary, &format!("{vary}, {vary}")), "is given twice"),
        (change(good, vary, "\"optics.p11\": Tolerance"), "\"optics.p11\": has no tolerance"),
        (change(good, "Sobol(8)", "Sobol(0)"), "these are 0 points"),
        (change(good, "Sobol(8)", "Sobol(100000)"), "a Sobol' sequence of 100000 points is not known"),
        (change(good, "Sobol(8)", "MonteCarlo(99999999999)"), "these are 99999999999 points"),
        (change(good, "Sobol(8)", "LatinHypercube(99999999999)"), "a Latin hypercube of at most"),
        (change(good, "Sobol(8)", "Grid"), "\"spool.hub_thickness_mm\" has no values to go through"),
        (change(good, "Sobol(8)", "Indices(18446744073709551615)"), "is not known"),
        (change(good, "Sobol(8)", "Indices(8), outputs: [Winding]"), "add Sensitivity to outputs"),
        (change(good, "Sobol(8)", "Sobol(8), outputs: []"), "nothing is computed"),
        (change(good, "Sobol(8)", "Sobol(8), outputs: [Simulation(\"none.csv\")]"), "none.csv"),
        (change(good, "Sobol(8)", "Sobol(8), seeds: 3"), "seeds"),
        (change(good, "coil.ron", "none.ron"), "none.ron"),
    ];
    for (plan, said) in &cases {
        folder.write("plan.ron", plan);
        let output = folder.run(&["sweep", "plan.ron", "--out", "t.csv"]);
        assert_eq!(output.status.code(), Some(2), "{plan}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{plan}: {}", stderr(&output));
    }
    folder.write("plan.ron", good);
    let refused = [
        (&["--out", "t.txt"][..], "give a name that ends in .parquet or .csv"),
        (&["--out", "t.csv", "--share", "3/2"], "give K/N"),
        (&["--out", "t.csv", "--share", "0/2"], "give K/N"),
        (&["--out", "coil.ron"], "ends in .parquet or .csv"),
        (&["--out", "no/t.csv"], "there is no folder no"),
        (&["--out", "t.csv", "--svg", "t.csv"], "is given twice"),
    ];
    for (arguments, said) in refused {
        let output = folder.run(&[&["sweep", "plan.ron"], arguments].concat());
        assert!(output.status.code() == Some(2) && stderr(&output).contains(said), "{arguments:?}: {}", stderr(&output));
    }
    folder.write("plan.ron", change(good, ")})", ")}, outputs: [Winding])"));
    let output = folder.run(&["sweep", "plan.ron", "--out", "t.csv", "--svg", "i.svg"]);
    assert!(output.status.code() == Some(2) && stderr(&output).contains("there is nothing to draw"), "{}", stderr(&output));
    assert!(!folder.path("t.csv").exists() && !folder.path("i.svg").exists());
}

/// A peak between rows of half an hour is averaged away: the terminal says so, as `simulate` does.
#[test]
fn long_rows_of_a_profile_are_noted() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n1800,50\n3600,50\n");
    let plan = "(design: \"coil.ron\", vary: {\"spool.hub_thickness_mm\": Steps(2.0, 3.0, 2)}, sampling: Grid, outputs: [Simulation(\"p.csv\")])";
    folder.write("plan.ron", plan);
    let output = folder.run(&["sweep", "plan.ron", "--out", "t.csv"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).contains("[long-rows]"), "{}", stderr(&output));
    // and not of close ones
    let rows: String = (0..=120).map(|n| format!("{},{}\n", 30 * n, 20.0 + 0.25 * f64::from(n))).collect();
    folder.write("p.csv", format!("time_s,chamber_c\n{rows}"));
    let output = folder.run(&["sweep", "plan.ron", "--out", "t2.csv"]);
    assert!(output.status.success() && !stderr(&output).contains("[long-rows]"), "{}", stderr(&output));
}
