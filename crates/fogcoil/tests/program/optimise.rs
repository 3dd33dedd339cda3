//! `fogcoil optimise` as a user runs it: what it finds, how it is checked, what is refused.

use std::fs;
use std::process::Command;

use charts::faults;
use fogcoil::schema::misfit;
use serde_json::Value;

use crate::common::{COIL, Folder, change, schema, stderr, stdout};

const PLAN: &str = "(
    design: \"coil.ron\",
    vary: {
        \"spool.flanges\": Named({\"as drawn\": \"[(side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true)]\", \"none\": \"[]\"}),
        \"spool.hub_thickness_mm\": Uniform(2.0, 6.0),
        \"winding.tails_m\": OneOf([\"(cw: 0.0, ccw: 0.0)\", \"(cw: 0.1, ccw: 0.0)\"]),
    },
    dimensions: FollowWinding,
    minimise: [Sensitivity, Mass],
    limits: {\"mass_kg\": (0.0, 0.12)},
    trials: 40,
)";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn the_optimum_is_found_checked_and_explained() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("plan.ron", PLAN);
    let run = |threads: &str, out: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_fogcoil"));
        command.args([
            "optimise",
            "plan.ron",
            "--out",
            out,
            "--model-out",
            "best.ron",
            "--svg",
            "front.svg",
            "--json",
            "--quiet",
        ]);
        let output = command.env("RAYON_NUM_THREADS", threads).current_dir(folder.path("")).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        serde_json::from_str::<Value>(&stdout(&output)).unwrap()
    };
    let json = run("2", "two.csv");
    assert_eq!(misfit(&json, &schema("optimise")), None);
    assert_eq!(
        (&run("1", "one"), fs::read(folder.path("one/table.csv")).unwrap()),
        (&json, fs::read(folder.path("two.csv")).unwrap())
    );
    let page = fs::read_to_string(folder.path("one/report.html")).unwrap();
    assert!(faults(&page).is_empty() && folder.path("one/table.parquet").exists(), "{:?}", faults(&page));
    assert!(page.contains("The optimum (least sensitivity) by the full model") && page.contains("plan.ron"));
    let best = &json["optimum"];
    // the flange makes most of the reference coil's sensitivity
    assert!(number(&best["total"]).abs() < number(&json["drawing"]["sensitivity"]) / 5.0, "{json}");
    assert_eq!(best["design"]["values"]["spool.flanges"], "none");
    assert!(number(&best["design"]["numbers"]["mass_kg"]) <= 0.12);
    // what is written is the design that was checked; the path ends at it
    let alone: Value = serde_json::from_str(&stdout(&folder.run(&["sensitivity", "best.ron", "--json", "--quiet"]))).unwrap();
    let near = |a: &Value, b: &Value| (number(a) - number(b)).abs() < 1e-9;
    assert!(near(&alone["total"], &best["total"]) && near(&alone["tolerance_sd"], &best["tolerance_sd"]), "{alone} {best}");
    assert_eq!(best["path"].as_array().unwrap().len(), 3);
    assert!(near(&best["path"][2]["total"], &best["total"]), "{best}");
    let units = &best["units"];
    assert!(
        number(&units["p95"]) <= number(&units["largest"]) && number(&units["p95"]) > number(&best["total"]).abs(),
        "{units}"
    );
    // along the front one number falls as the other rises, and nothing that was tried beats it
    let front: Vec<[f64; 2]> =
        json["front"].as_array().unwrap().iter().map(|d| ["sensitivity", "mass_kg"].map(|n| number(&d["numbers"][n]))).collect();
    assert!(front.len() > 1 && front.windows(2).all(|w| w[0][0] < w[1][0] && w[0][1] > w[1][1]), "{front:?}");
    let table = fs::read_to_string(folder.path("two.csv")).unwrap();
    assert!(table.starts_with(
        "design,spool.flanges,spool.hub_thickness_mm,winding.tails_m,total,sensitivity,mass_kg,length_m,keeps_limits,on_front\n"
    ));
    assert_eq!(json["tried"].as_u64().unwrap() as usize, table.lines().count() - 1);
    assert!(fs::read_to_string(folder.path("front.svg")).unwrap().contains(">the drawing</text>"));
}

#[test]
fn no_design_on_the_way_is_better_than_the_optimum() {
    let folder = Folder::new();
    folder.write("reference.ron", COIL);
    let case = fogcoil::input::read_coil(&folder.path("reference.ron")).unwrap();
    let (asymmetry, _) = coil::tail_asymmetry(&case.design, 0.0).unwrap();
    let tails = coil::with_asymmetry(&case.design, asymmetry).winding.tails;
    // a drawing without a sensitivity, in a plan of so few trials that none comes near
    folder.write(
        "coil.ron",
        change(COIL, "tails_m: (cw: 0.0, ccw: 0.0)", &format!("tails_m: (cw: {}, ccw: {})", tails.cw, tails.ccw)),
    );
    let varied = if tails.cw > 0.0 { "cw" } else { "ccw" };
    let plan = format!(
        "(design: \"coil.ron\", vary: {{\"spool.hub_thickness_mm\": Uniform(2.0, 6.0), \"winding.tails_m.{varied}\": Uniform(0.0, 20.0), \
         \"winding.cw_climbs\": OneOf([\"Right\", \"Left\"])}}, minimise: [Sensitivity], trials: 10)"
    );
    folder.write("plan.ron", plan);
    let output = folder.run(&["optimise", "plan.ron", "--json", "--quiet"]);
    let json: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let best = &json["optimum"];
    let own = number(&best["design"]["numbers"]["sensitivity"]);
    assert!(own <= number(&json["drawing"]["sensitivity"]) + 1e-9, "{json}");
    assert!(best["path"].as_array().unwrap().iter().all(|step| own <= number(&step["total"]).abs() + 1e-9), "{best}");
    // those on the way are beyond the plan's
    assert!(json["tried"].as_u64().unwrap() <= 10 + 3, "{json}");
}

/// A part that a choice takes away takes its tolerances with it; a choice that no design can have is counted and said.
#[test]
fn designs_without_a_part_are_tried_and_those_that_cannot_be_are_counted() {
    let folder = Folder::new();
    let flanged = change(COIL, "sensor:", "tolerances: {\"spool.flanges.thickness_mm\": Relative(0.02)},\n    sensor:");
    folder.write("coil.ron", flanged);
    let choices = |more: &str| {
        format!(
            "(design: \"coil.ron\", vary: {{\"spool.flanges\": Named({{\"one\": \"[(side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true)]\", \
             \"none\": \"[]\"{more}}}), \"spool.hub_thickness_mm\": Uniform(2.0, 4.0)}}, dimensions: FollowWinding, minimise: [Sensitivity], trials: 10)"
        )
    };
    let run = |plan: String| -> (Value, String) {
        folder.write("plan.ron", plan);
        let output = folder.run(&["optimise", "plan.ron", "--out", "t.csv", "--json", "--quiet"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        (serde_json::from_str(&stdout(&output)).unwrap(), fs::read_to_string(folder.path("t.csv")).unwrap())
    };
    let (json, table) = run(choices(""));
    assert!(json["failed"] == 0 && table.contains(",none,") && table.contains(",one,"), "{json} {table}");
    // what is written is read, of a design that has no such part
    assert_eq!(json["optimum"]["design"]["values"]["spool.flanges"], "none", "{json}");
    let output = folder.run(&["optimise", "plan.ron", "--model-out", "m.ron", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(!fs::read_to_string(folder.path("m.ron")).unwrap().contains("flanges.thickness_mm"));
    let output = folder.run(&["wind", "m.ron"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let (json, _) = run(choices(
        ", \"twice\": \"[(side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true), (side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true)]\"",
    ));
    assert!(json["failed"].as_u64().unwrap() > 0 && json["first_problem"].as_str().unwrap().contains("flanges"), "{json}");
    let text = stdout(&folder.run(&["optimise", "plan.ron", "--quiet"]));
    assert!(text.contains("points of the plan have no design; of the first:"), "{text}");
}

#[test]
fn a_warning_about_the_optimum_is_told_with_it() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let run = |layers: u32, more: &[&str]| {
        let plan = format!(
            "(design: \"coil.ron\", vary: {{\"winding.layers\": OneOf([\"{layers}\"])}}, dimensions: FollowWinding, minimise: [Sensitivity], trials: 10)"
        );
        folder.write("plan.ron", plan);
        stdout(&folder.run(&[&["optimise", "plan.ron", "--quiet"], more].concat()))
    };
    let json: Value = serde_json::from_str(&run(35, &["--json"])).unwrap();
    let warnings = json["optimum"]["warnings"].as_array().unwrap();
    assert!(warnings.len() == 1 && warnings[0].as_str().unwrap().contains("[broken-pattern]"), "{json}");
    let text = run(35, &[]);
    assert!(text.contains("about the optimum: winding.layers: 35 layers are no whole number of the 4"), "{text}");
    let whole: Value = serde_json::from_str(&run(32, &["--json"])).unwrap();
    assert!(whole["optimum"]["warnings"].as_array().unwrap().is_empty(), "{whole}");
}

#[test]
fn limits_that_nothing_keeps_leave_no_optimum() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("plan.ron", change(PLAN, "(0.0, 0.12)", "(0.0, 0.001)"));
    let output = folder.run(&["optimise", "plan.ron", "--json", "--quiet"]);
    let json: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(misfit(&json, &schema("optimise")), None);
    assert_eq!((&json["keep_limits"], &json["optimum"]), (&Value::from(0), &Value::Null));
}

#[test]
fn bad_plans_of_an_optimisation_are_refused() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let cases = [
        (change(PLAN, "[Sensitivity, Mass]", "[]"), "nothing is minimised"),
        (change(PLAN, "[Sensitivity, Mass]", "[Mass, Mass]"), "something is given twice"),
        (change(PLAN, "[Sensitivity, Mass]", "[Price]"), "plan.ron:9"),
        (change(PLAN, "trials: 40", "trials: 3"), "3 designs are to be tried"),
        (change(PLAN, "trials: 40", "trials: 99999999999"), "designs are to be tried"),
        (change(PLAN, "(0.0, 0.12)", "(0.12, 0.0)"), "is no range"),
        (change(PLAN, "(0.0, 0.12)", "(NaN, 0.1)"), "is no range"),
        (change(PLAN, "\"mass_kg\"", "\"mass\""), "\"mass\" is nothing that is limited"),
        (change(PLAN, "Uniform(2.0, 6.0)", "Tolerance"), "has a distribution, but what is optimised is chosen"),
        (change(PLAN, "hub_thickness_mm", "hub_mm"), "spool.hub_mm"),
        (change(PLAN, "coil.ron", "none.ron"), "none.ron"),
    ];
    for (plan, said) in cases {
        folder.write("plan.ron", &plan);
        let output = folder.run(&["optimise", "plan.ron", "--out", "t.csv"]);
        assert!(output.status.code() == Some(2) && stderr(&output).contains(said), "{said}: {}", stderr(&output));
    }
    folder.write("plan.ron", change(PLAN, "[Sensitivity, Mass]", "[Mass]"));
    for (arguments, said) in [
        (["--out", "t.txt"], "ends in .parquet or .csv"),
        (["--svg", "f.svg"], "no front to draw"),
        (["--model-out", "coil.ron"], "is an input"),
    ] {
        let output = folder.run(&[&["optimise", "plan.ron"][..], &arguments].concat());
        assert!(output.status.code() == Some(2) && stderr(&output).contains(said), "{said}: {}", stderr(&output));
    }
    assert!(!folder.path("t.csv").exists() && !folder.path("f.svg").exists());
}
