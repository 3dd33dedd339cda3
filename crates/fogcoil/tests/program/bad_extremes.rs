//! Values inside what a field accepts that no model can be made of: one message that names the field, or a warning.

use crate::common::{CELL, COIL, Folder, change, line_of, stderr, stdout};

const PROFILE: &str = "time_s,chamber_c\n0,25\n36000,25\n";

/// The message of `simulate` for a coil that cannot be solved.
fn unsolved(coil: &str) -> String {
    let folder = Folder::new();
    folder.write("coil.ron", coil);
    folder.write("p.csv", PROFILE);
    let output = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--step", "60", "--out", "o.csv"]);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(!folder.path("o.csv").exists());
    let error = message.lines().last().unwrap().to_owned();
    assert!(error.starts_with("error: coil.ron:"), "{message}");
    error
}

#[test]
fn numbers_too_far_apart_are_said_with_their_field() {
    let heated = |heat: &str| change(COIL, "    sensor: (", &format!("    heat: ({heat}),\n    sensor: ("));
    let film = unsolved(&heated("film_w_per_m2k: Some(1e-6)"));
    assert!(film.contains(": heat.film_w_per_m2k: this and the design's other numbers are too far apart"), "{film}");
    for (old, new, field) in [
        ("overhang_mm: 1.0", "overhang_mm: 1000.0", "spool.flanges[0].overhang_mm"),
        ("youngs_modulus_gpa: 68.9", "youngs_modulus_gpa: 1e-8", "spool.material.youngs_modulus_gpa"),
        ("poisson_ratio: 0.33", "poisson_ratio: 0.49999999999999994", "spool.material.poisson_ratio"),
    ] {
        let structure = unsolved(&change(COIL, old, new));
        assert!(structure.contains(&format!("coil.ron:{}: {field}: this and", line_of(COIL, old))), "{structure}");
        assert!(structure.contains("too far apart to be solved") && structure.contains("; give the "), "{structure}");
    }
    // a coil of 90 m
    let large = change(COIL, "inner_radius_mm: 43.5", "inner_radius_mm: 90000.0");
    let large = change(&large, "outer_radius_mm: 48.825", "outer_radius_mm: 90005.325");
    let large = unsolved(&change(&large, "sensor: (radius_mm: 39.5", "sensor: (radius_mm: 89996.0"));
    assert!(
        large.contains(&format!("coil.ron:{}: winding.inner_radius_mm: this and", line_of(COIL, "inner_radius_mm"))),
        "{large}"
    );
}

/// The schema's range is the model's.
#[test]
fn limits_are_said_in_the_files_unit() {
    let relaxing = |share: &str| {
        unsolved(&change(
            COIL,
            "    sensor: (",
            &format!("    mechanics: Relaxing((fraction: {share}, time_s: 1800.0)),\n    sensor: ("),
        ))
    };
    assert!(relaxing("0.9").contains("mechanics.fraction: 0.9 is more than 0.8, the most accepted"), "{}", relaxing("0.9"));
    for (old, new, field) in [
        ("hub_thickness_mm: 4.0", "hub_thickness_mm: 0.005", "spool.hub_thickness_mm"),
        ("thickness_mm: 2.0, overhang", "thickness_mm: 0.005, overhang", "spool.flanges[0].thickness_mm"),
    ] {
        let thin = unsolved(&change(COIL, old, new));
        assert!(
            thin.contains(&format!("{field}: 0.005 mm is less than 0.01 mm, the least accepted; give the value in mm")),
            "{thin}"
        );
    }
    let folder = Folder::new();
    for (thickness, status) in [("0.005", 2), ("0.01", 0)] {
        folder.write("coil.ron", change(COIL, "hub_thickness_mm: 4.0", &format!("hub_thickness_mm: {thickness}")));
        assert_eq!(folder.run(&["wind", "coil.ron"]).status.code(), Some(status), "{thickness}");
    }
}

#[test]
fn a_thermometer_below_absolute_zero_is_a_warning() {
    let folder = Folder::new();
    folder.write("p.csv", PROFILE);
    for (power, warned) in [("-1000.0", true), ("1.0", false)] {
        let heat = format!("    heat: (heaters: [(side: Right, power_w: {power})]),\n    sensor: (");
        folder.write("coil.ron", change(COIL, "    sensor: (", &heat));
        let output = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--step", "60", "--out", "o.csv"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let warning = stderr(&output).lines().any(|line| {
            line.starts_with("warning: coil.ron: spool_c is -")
                && line.contains("heat.heaters")
                && line.ends_with("[impossible-result]")
        });
        assert_eq!(warning, warned, "{}", stderr(&output));
    }
}

/// A constant that is exactly 0 is judged by its natural scale; a film is called thin, not absent.
#[test]
fn cells_at_their_limits() {
    let folder = Folder::new();
    let material =
        "(youngs_modulus_mpa: 100.0, poisson_ratio: 0.4999999, thermal_expansion_per_k: 1e-5, conductivity_w_per_mk: 0.5)";
    let ring = format!("(name: \"fibre\", outer_diameter_um: 80.0, glass: true, material: {material})");
    folder.write("c.ron", format!("(name: \"homogeneous\", pitch_um: 170.0, rings: [{ring}], adhesive: {material})"));
    let output = folder.run(&["homogenize", "c.ron", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let of = |name: &str| json[name].as_f64().unwrap();
    assert!((of("alpha_r") / 1e-5 - 1.0).abs() < 1e-6 && of("m_rt").abs() < 1e-11, "{json}");

    folder.write("c.ron", change(CELL, "outer_diameter_um: 80.0", "outer_diameter_um: 80.0, offset_um: (15.99, 0.0)"));
    let message = stderr(&folder.run(&["homogenize", "c.ron"]));
    assert!(message.contains("leaves ring 1 only 0.010 um thick at its thinnest, too thin to be meshed; make"), "{message}");
    folder.write("c.ron", change(CELL, "outer_diameter_um: 80.0", "outer_diameter_um: 80.0, offset_um: (16.01, 0.0)"));
    let message = stderr(&folder.run(&["homogenize", "c.ron"]));
    assert!(message.contains("does not lie inside ring 1 (least thickness -0.010 um)"), "{message}");
}

#[test]
fn a_name_gives_no_orders_to_a_terminal() {
    let folder = Folder::new();
    let name = r#"name: "A\u{1b}]0;title\u{7}\u{1b}[2J\u{1b}[31mforged line\n\rerror: nothing\u{202e}""#;
    folder.write("coil.ron", change(COIL, "name: \"reference-coil\"", name));
    let output = folder.run(&["wind", "coil.ron"]);
    assert_eq!(output.status.code(), Some(0));
    let text = stdout(&output);
    assert!(
        text.starts_with(r"A\u{1b}]0;title\u{7}\u{1b}[2J\u{1b}[31mforged line\n\rerror: nothing\u{202e}: PracticalQuadrupole"),
        "{text}"
    );
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()));
}

/// Orders to a terminal: escape sequences, a carriage return, a change of direction.
#[cfg(unix)]
#[test]
fn a_file_s_name_gives_no_orders_to_a_terminal() {
    let folder = Folder::new();
    let name = "a\u{1b}[2J\rb\u{202e}c";
    let [coil, record, absent] = ["ron", "csv", "none"].map(|end| format!("{name}.{end}"));
    folder.write(&coil, change(COIL, "(cw: 0.0, ccw: 0.0)", "(cw: 800.0, ccw: 0.0)"));
    folder.write(&record, "time_s,chamber_c,spool_c,rate_deg_per_h,n\u{1b}[2J\n0,20,20,0.1,1\n30,20,20,0.2,1\n60,21,20,0.1,1\n");
    let out = format!("o{name}.csv");
    let runs = [
        &["wind", &coil, "--csv", &out][..],
        &["wind", &absent],
        &["check", &record],
        &["check", &record, "--json"],
        &["explain", &absent],
        &["new", &coil],
        &["wind", &coil, &absent],
    ];
    for arguments in runs {
        let output = folder.run(arguments);
        for text in [stdout(&output), stderr(&output)] {
            assert!(text.chars().all(|c| c == '\n' || !(c.is_control() || c == '\u{202e}')), "{arguments:?}: {text:?}");
        }
    }
    let message = stderr(&folder.run(&["wind", &absent]));
    assert!(message.starts_with("error: a\\u{1b}[2J\\rb\\u{202e}c.none: cannot be read"), "{message}");
    let json: serde_json::Value = serde_json::from_str(&stdout(&folder.run(&["check", &record, "--json"]))).unwrap();
    assert_eq!(json["file"], record.as_str(), "in JSON the name is what it is");
}

#[test]
fn a_long_word_is_quoted_in_part() {
    let folder = Folder::new();
    let word = "a".repeat(70_000);
    for text in [
        change(COIL, "    name:", &format!("    {word}: 1.0,\n    name:")),
        change(COIL, "PracticalQuadrupole, ", &format!("{word},")),
        change(COIL, "material: Constants(", &format!("material: {word}(")),
    ] {
        folder.write("coil.ron", text);
        let output = folder.run(&["wind", "coil.ron"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).len() < 1500 && stderr(&output).contains("aaaa"), "{}", stderr(&output));
    }
}
