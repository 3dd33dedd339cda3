//! The commands on good files: keys, headers, units, every variant of the file format.

use crate::common::{CELL, COIL, Folder, change, schema, stderr, stdout};
use fogcoil::glossary::Remark;
use fogcoil::input::{Origin, read_cell, read_coil};

const KEYS: [&str; 16] = [
    "e_z",
    "e_r",
    "g_zr",
    "g_r",
    "k_plane_strain",
    "nu_zr",
    "nu_r",
    "nu_rz",
    "alpha_z",
    "alpha_r",
    "k_z",
    "k_r",
    "m_rx",
    "m_ry",
    "m_rz",
    "m_rt",
];

/// Runs the program, which says nothing but what it does and what it has written.
fn run(folder: &Folder, arguments: &[&str]) -> String {
    let output = folder.run(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let expected = |line: &str| line.is_empty() || line.ends_with(" written") || line.ends_with(" ...");
    assert!(stderr(&output).lines().all(expected), "{}", stderr(&output));
    stdout(&output)
}

fn json(text: &str) -> serde_json::Value {
    assert_eq!(text.trim_end().lines().count(), 1);
    serde_json::from_str(text).unwrap()
}

#[test]
fn homogenize_reports_every_constant_with_its_error() {
    let folder = Folder::new();
    folder.write("cell.ron", CELL);
    let result = json(&run(&folder, &["homogenize", "cell.ron", "--json"]));
    for key in KEYS {
        assert!(result[key].as_f64().unwrap().is_finite(), "{key}");
        assert!(result["error_estimate"][key].as_f64().unwrap().abs() < 1e-4, "{key}");
    }
    assert_eq!(format!("{:.1e}", result["e_z"].as_f64().unwrap()), "1.5e10"); // Pa
    let text = run(&folder, &["homogenize", "cell.ron"]);
    assert!(KEYS.iter().all(|key| text.contains(key)) && text.contains("MPa"), "{text}");
}

/// Square packing has a constant that others have not.
#[test]
fn a_square_cell_keeps_its_schema_and_says_what_lies_along_its_rows() {
    let folder = Folder::new();
    folder.write("cell.ron", change(CELL, "pitch_um: 170.0,", "pitch_um: 170.0, packing: Square, columns: 1,"));
    let result = json(&run(&folder, &["homogenize", "cell.ron", "--json"]));
    let under = json(&run(&folder, &["homogenize", "cell.ron", "--json", "--load", "exx=1e-4,dt=10"]));
    for object in [&result, &under] {
        assert_eq!(fogcoil::schema::misfit(object, &schema("homogenize")), None);
    }
    assert!(under["strains"].is_object());
    let [e, nu, g] = ["e_r", "nu_r", "g_r_45"].map(|key| result[key].as_f64().unwrap());
    assert!((g / (e / (2.0 * (1.0 + nu))) - 1.0).abs() < 1e-9, "{g}");
    assert!((0.0..1e-4).contains(&result["error_estimate"]["g_r_45"].as_f64().unwrap()), "{result}");
    let text = run(&folder, &["homogenize", "cell.ron"]);
    let row = |key: &str| {
        text.lines().find(|line| line.split_whitespace().next() == Some(key)).unwrap_or_else(|| panic!("{key}: {text}"))
    };
    let words: Vec<&str> = row("g_r_45").split_whitespace().collect();
    assert!((words[1].parse::<f64>().unwrap() / (g / 1e6) - 1.0).abs() < 1e-5 && words[4] == "MPa", "{words:?}");
    for key in ["e_r", "g_r", "nu_r"] {
        assert!(row(key).ends_with(", along its rows"), "{text}");
    }
    // hexagonal packing is the same along all directions
    folder.write("cell.ron", CELL);
    let text = run(&folder, &["homogenize", "cell.ron"]);
    assert!(!text.contains("rows") && !text.contains("g_r_45"), "{text}");
}

#[test]
fn sensitivity_reports_its_parts() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let result = json(&run(&folder, &["sensitivity", "coil.ron", "--json"]));
    let keys = ["shupe", "eo_axial", "eo_radial", "total", "length_m", "error_estimate"];
    let [shupe, axial, radial, total, length, error] = keys.map(|key| result[key].as_f64().unwrap());
    assert!((shupe + axial + radial - total).abs() < 1e-12 && error > 0.0 && error < 0.01);
    assert!((-2.74..-2.72).contains(&total), "{total}");
    assert_eq!(format!("{length:.4}"), "1101.5666");
    let text = run(&folder, &["sensitivity", "coil.ron"]);
    assert!(text.contains("the sum of the three"));
    // every tolerance is in the JSON; the table says how many it leaves out
    let shares = result["tolerance_shares"].as_array().unwrap();
    let small = shares.iter().filter(|share| share["share"].as_f64().unwrap().abs() < 0.005).count();
    let sum: f64 = shares.iter().map(|share| share["share"].as_f64().unwrap()).sum();
    assert!(small > 0 && (sum - 1.0).abs() < 1e-9, "{result}");
    let left = format!("{small} more below 0.5 %: --all\n");
    assert!(text.contains(&left), "{text}");
    let all = run(&folder, &["sensitivity", "coil.ron", "--all"]);
    assert!(!all.contains("--all") && all.lines().count() == text.lines().count() + small - 2, "{all}");
    assert!(shares.iter().all(|share| all.contains(share["key"].as_str().unwrap())), "{all}");
}

#[test]
fn wind_writes_the_turn_table_and_the_picture() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let said = run(&folder, &["wind", "coil.ron", "--csv", "turns.csv", "--svg", "section.svg"]);
    assert!(said.contains("1899, 1899") && said == run(&folder, &["wind", "coil.ron"]), "{said}");
    let case = read_coil(&folder.path("coil.ron")).unwrap();
    let table = std::fs::read_to_string(folder.path("turns.csv")).unwrap();
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("half,layer,turn,y_mm,r_mm,z_start_m,z_end_m"));
    for turn in case.winding.turns() {
        let row: Vec<&str> = rows.next().unwrap().split(',').collect();
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        assert_eq!((number(3), number(4), number(5), number(6)), (turn.y * 1e3, turn.r * 1e3, turn.z_start, turn.z_end));
        assert_eq!(row[0], if turn.half == winding::Half::Cw { "CW" } else { "CCW" });
        assert_eq!((row[1].parse(), row[2].parse()), (Ok(turn.layer), Ok(turn.turn)));
    }
    assert_eq!(rows.next(), None);
    let picture = std::fs::read_to_string(folder.path("section.svg")).unwrap();
    assert!(picture.contains("<title") && picture.matches("<circle").count() >= 3798 && picture.len() < 1_500_000);
    assert_eq!(folder.names(), ["coil.ron", "section.svg", "turns.csv"]);
}

#[test]
fn a_result_replaces_an_older_one_through_a_link() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("old.csv", "old");
    #[cfg(unix)]
    std::os::unix::fs::symlink("old.csv", folder.path("turns.csv")).unwrap();
    run(&folder, &["wind", "coil.ron", "--csv", "turns.csv"]);
    #[cfg(unix)]
    assert!(std::fs::read_to_string(folder.path("old.csv")).unwrap().starts_with("half,"));
}

#[test]
fn a_large_coil_makes_a_small_picture() {
    let folder = Folder::new();
    let large = change(&change(COIL, "layers: 36", "layers: 400"), "outer_radius_mm: 48.825", "outer_radius_mm: 102.5");
    folder.write("coil.ron", change(&large, "        sagnac_diameter_mm: 92.325,\n", ""));
    run(&folder, &["wind", "coil.ron", "--svg", "section.svg"]);
    assert!(std::fs::metadata(folder.path("section.svg")).unwrap().len() < 500_000);
}

#[test]
fn an_optional_value_may_stand_without_some() {
    let folder = Folder::new();
    let wound = |end: &str| {
        folder.write("coil.ron", change(COIL, "cw_climbs", &format!("end_mm: {end}, cw_climbs")));
        json(&run(&folder, &["sensitivity", "coil.ron", "--json"]))["total"].clone()
    };
    assert_eq!(wound("18.0"), wound("Some(18.0)"));
    assert_ne!(wound("18.0"), wound("None"));
    folder.write(
        "bare.ron",
        change(&change(COIL, "spool: Some((", "spool: ("), "bonded: true)],\n    ))", "bonded: true)],\n    )"),
    );
    let total = |file: &str| json(&run(&folder, &["sensitivity", file, "--json"]))["total"].clone();
    folder.write("coil.ron", COIL);
    assert_eq!(total("bare.ron"), total("coil.ron"));
}

#[test]
fn every_variant_parses() {
    let variants = [
        ("PracticalQuadrupole,  ", "Cylindrical,"),
        ("PracticalQuadrupole,  ", "Dipole,"),
        ("PracticalQuadrupole,  ", "Quadrupole,"),
        ("PracticalQuadrupole,  ", "Octupole,"),
        ("turn_length: True", "turn_length: Equal"),
        ("cw_climbs: Right", "cw_climbs: Left"),
        ("(cw: 0.0, ccw: 0.0)", "(cw: 1.5, ccw: 0.5)"),
        ("strain: Total", "strain: Mechanical"),
        ("hub_bonded: true", "hub_bonded: false"),
        ("bonded: true)]", "bonded: false)]"),
        ("bonded: true)]", "bonded: true), (side: Left, thickness_mm: 1.0, overhang_mm: 0.0, bonded: false)]"),
        ("[(side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true)]", "[]"),
    ];
    let folder = Folder::new();
    let reference = read_coil(&folder.write("reference.ron", COIL)).unwrap();
    for (old, new) in variants {
        let case = read_coil(&folder.write("coil.ron", change(COIL, old, new))).unwrap();
        assert_ne!(case.design, reference.design, "{new}");
    }
}

#[test]
fn without_a_spool_the_thermometer_sits_at_the_bore() {
    let spool = &COIL[COIL.find("Some((").unwrap()..COIL.find("surroundings: (").unwrap()];
    let folder = Folder::new();
    let case = read_coil(&folder.write("coil.ron", change(COIL, spool, "None,\n    "))).unwrap();
    assert_eq!(case.design.spool, None);
    assert_eq!(case.design.sensor.radius, 43.5e-3);
}

#[test]
fn constants_and_row_from_a_cell() {
    let folder = Folder::new();
    let start = COIL.find("Constants((").unwrap();
    let end = start + COIL[start..].find("))").unwrap() + 2;
    let coil = change(COIL, &COIL[start..end], "FromCell(\"cells/cell.ron\")");
    std::fs::create_dir(folder.path("cells")).unwrap();
    let cell_path = folder.write("cells/cell.ron", CELL);
    let matrix = "Matrix((m_rx: 0.0274, m_ry: 0.0270, m_rz: -0.17, m_rt_per_k: -9.98e-6))";
    let from_cell = change(&coil, matrix, &format!("FromCell({cell_path:?})"));
    let case = read_coil(&folder.write("coil.ron", from_cell)).unwrap();
    let expected = homogenization::homogenize(&read_cell(&cell_path).unwrap().cell).unwrap().constants;
    assert_eq!(case.design.body.elastic, expected.elastic());
    assert_eq!((case.design.body.conductivity_z, case.design.body.conductivity_r), (expected.k_z, expected.k_r));
    assert_eq!(case.design.dehomogenization.m_rt, expected.m_rt);
    assert_eq!(case.provenance.dehomogenization, Origin::Cell(cell_path));
    assert!(case.warnings.is_empty(), "{:?}", case.warnings);
    folder.write("cells/cell.ron", change(CELL, "pitch_um: 170.0", "pitch_um: 172.0"));
    let [warning] = &read_coil(&folder.path("coil.ron")).unwrap().warnings[..] else {
        panic!("one warning, though it is named twice")
    };
    assert!(warning.text.contains("172.00 um") && warning.remark == Remark::OtherPitch, "{warning:?}");
    // a row M of another cell is warned of, of a copy of the cell it is not
    folder.write("cells/cell.ron", CELL);
    for (other, warned) in [(change(CELL, "youngs_modulus_mpa: 5.593", "youngs_modulus_mpa: 6.5"), 1), (CELL.to_owned(), 0)] {
        folder.write("cells/other.ron", other);
        let mixed = change(&coil, matrix, "FromCell(\"cells/other.ron\")");
        let warnings = read_coil(&folder.write("coil.ron", mixed)).unwrap().warnings;
        assert_eq!(warnings.iter().filter(|warning| warning.remark == Remark::OtherCell).count(), warned, "{warnings:?}");
    }
    // so is a cell whose density or specific heat is another than the coil's
    let known = |density: f64| {
        let with = format!("density_kg_per_m3: {density:?}, specific_heat_j_per_kgk: 1300.0, youngs_modulus_mpa");
        CELL.replace("youngs_modulus_mpa", &with)
    };
    for (density, warned) in [(1400.0, 0), (1460.0, 1)] {
        folder.write("cells/cell.ron", known(density));
        let warnings = read_coil(&folder.write("coil.ron", &coil)).unwrap().warnings;
        let told: Vec<&str> = warnings.iter().filter(|w| w.remark == Remark::OtherMass).map(|w| w.text.as_str()).collect();
        assert_eq!(told.len(), warned, "{warnings:?}");
        assert!(
            told.iter().all(|t| t.starts_with("coil.density_kg_per_m3 is 1400, that of the cell \"cells/cell.ron\" is 1460.0")),
            "{told:?}"
        );
    }
    // a material without what the others have is named
    let lacking = known(1400.0).replacen("specific_heat_j_per_kgk: 1300.0, ", "", 1);
    let output = folder.run(&["homogenize", folder.write("cells/cell.ron", lacking).to_str().unwrap()]);
    assert!(
        stderr(&output).contains("without specific_heat_j_per_kgk, which the others have")
            && stderr(&output).contains("[untold-material]")
    );
    let printed = read_coil(&folder.write("coil.ron", change(COIL, matrix, "Printed"))).unwrap();
    assert_eq!(printed.design.dehomogenization.m_rx, 2.74e-6);
    assert_eq!(printed.provenance.dehomogenization, Origin::Printed);
}

#[test]
fn values_arrive_in_si() {
    let folder = Folder::new();
    let design = read_coil(&folder.write("coil.ron", COIL)).unwrap().design;
    assert_eq!((design.winding.inner_radius, design.winding.pitch, design.body.height), (43.5e-3, 0.170e-3, 18.02e-3));
    assert_eq!((design.body.elastic.e_z, design.body.elastic.e_r), (14.5e9, 95.2e6));
    assert_eq!(design.spool.unwrap().material.elastic.youngs_modulus, 68.9e9);
    assert_eq!(design.optics.sagnac_diameter, 92.325e-3);
    let cell = read_cell(&folder.write("cell.ron", CELL)).unwrap().cell;
    assert_eq!((cell.pitch, cell.rings[0].outer_radius), (170e-6, 40e-6));
    assert_eq!(cell.rings[2].constituent.elastic.youngs_modulus, 870e6);
}

/// The reference coil with `mechanics`.
fn with_mechanics(mechanics: &str) -> String {
    change(COIL, "    sensor: (", &format!("    mechanics: {mechanics},\n    sensor: ("))
}

#[test]
fn mechanics_are_read_and_change_the_bias_in_time() {
    let folder = Folder::new();
    folder.write("p.csv", "time_s,chamber_c\n0,-40\n3600,-40\n18000,60\n21600,60\n");
    let peak = |name: &str, coil: &str| {
        folder.write(name, coil);
        let output = folder.run(&["simulate", name, "--profile", "p.csv", "--out", "b.csv", "--json", "--quiet"]);
        assert!(output.status.success(), "{name}: {}", stderr(&output));
        let rows = std::fs::read_to_string(folder.path("b.csv")).unwrap();
        rows.lines().nth(3).unwrap().split(',').next_back().unwrap().parse::<f64>().unwrap()
    };
    let elastic = peak("elastic.ron", COIL);
    assert_eq!(peak("named.ron", &with_mechanics("Elastic")), elastic);
    let table = "TemperatureTable([(temperature_c: -40.0, transverse_modulus_factor: 0.5, transverse_expansion_factor: 1.0)])";
    for (name, mechanics) in [
        ("table.ron", table),
        ("relaxing.ron", "Relaxing((fraction: 0.5, time_s: 600.0))"),
        ("opening.ron", "Opening((side: Right, below_c: 100.0, hysteresis_k: 5.0, fraction: 0.4))"),
    ] {
        let other = peak(name, &with_mechanics(mechanics));
        assert!((other / elastic - 1.0).abs() > 0.05, "{name}: {other} against {elastic}");
    }
    assert!(stdout(&folder.run(&["sensitivity", "table.ron"])).contains("nominal state"));
    assert!(!stdout(&folder.run(&["sensitivity", "elastic.ron"])).contains("nominal state"));
}

#[test]
fn the_effective_diameter_is_the_mean_one_unless_given_and_another_is_noted() {
    let folder = Folder::new();
    let given = "        sagnac_diameter_mm: 92.325,\n";
    let read = |text: String| fogcoil::input::read_coil(&folder.write("coil.ron", text)).unwrap();
    let left_out = read(change(COIL, given, ""));
    assert!((left_out.design.optics.sagnac_diameter - 92.325e-3).abs() < 1e-15 && left_out.warnings.is_empty());
    let noted = |diameter: &str| {
        let case = read(change(COIL, "sagnac_diameter_mm: 92.325", &format!("sagnac_diameter_mm: {diameter}")));
        case.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    assert_eq!([noted("93.5"), noted("91.0")].concat(), "");
    assert!(noted("95.0").contains("95 mm is not the mean diameter of the coil, 92.325 mm"), "{}", noted("95.0"));
    assert!(noted("80.0").contains("lies outside the coil"), "{}", noted("80.0"));
}

#[test]
fn in_potting_thicker_than_the_winding_the_effective_diameter_is_that_of_the_turns() {
    let folder = Folder::new();
    let given = "        sagnac_diameter_mm: 92.325,\n";
    let read = |outer: &str, diameter: &str| {
        let text = change(COIL, "outer_radius_mm: 48.825", &format!("outer_radius_mm: {outer}"));
        fogcoil::input::read_coil(&folder.write("coil.ron", change(&text, given, diameter))).unwrap()
    };
    let diameter = |case: &fogcoil::input::CoilCase| case.design.optics.sagnac_diameter;
    let ids = |case: &fogcoil::input::CoilCase| case.warnings.iter().map(|note| note.remark.id()).collect::<Vec<_>>();
    // room of a drawing, less than the pitch of 0.17 mm
    let room = read("48.95", "");
    assert!(diameter(&room) == room.winding.spec().inner_radius + 48.95e-3 && ids(&room).is_empty(), "{}", diameter(&room));
    let thick = read("55.0", "");
    let turns = thick.winding.turns();
    let mean = turns.iter().map(|turn| 2.0 * turn.r).sum::<f64>() / turns.len() as f64;
    assert!((diameter(&thick) - mean).abs() < 2e-5, "{} {mean}", diameter(&thick));
    assert_eq!(ids(&thick), ["unfilled-coil"]);
    // that diameter is right by hand, too, and the body's is not
    let by_hand = |millimetres: f64| read("55.0", &format!("        sagnac_diameter_mm: {millimetres},\n"));
    assert_eq!(ids(&by_hand(1e3 * mean)), ["unfilled-coil"]);
    let body = by_hand(98.5);
    assert_eq!(ids(&body), ["unfilled-coil", "sagnac-differs"]);
    let said = body.warnings[1].to_string();
    assert!(said.contains("98.5 mm is not the mean diameter of the turns, 92.3"), "{said}");
}

#[test]
fn room_beside_the_winding_is_warned_of_where_the_sensitivity_feels_it() {
    let folder = Folder::new();
    let noted = |height: &str| {
        folder.write("coil.ron", change(COIL, "height_mm: 18.02", &format!("height_mm: {height}")));
        stderr(&folder.run(&["wind", "coil.ron"]))
    };
    let said = noted("18.05");
    assert!(
        said.contains("coil.height_mm") && said.contains("they begin at the left face") && said.contains("[unfilled-coil]"),
        "{said}"
    );
    assert!(!noted("18.03").contains("unfilled-coil"), "{}", noted("18.03"));
    // who says where it is knows
    folder.write(
        "placed.ron",
        change(&change(COIL, "height_mm: 18.02", "height_mm: 18.05"), "cw_climbs", "start_mm: 0.01, end_mm: 18.04, cw_climbs"),
    );
    let said = stderr(&folder.run(&["wind", "placed.ron"]));
    assert!(["unfilled-coil", "other-spacing", "turn-outside"].iter().all(|id| !said.contains(id)), "{said}");
    // turns that stand out of the coil are warned of
    folder.write("out.ron", change(COIL, "cw_climbs", "start_mm: 0.0, end_mm: 18.08, cw_climbs"));
    let said = stderr(&folder.run(&["wind", "out.ron"]));
    assert!(said.contains("reach 0.060 mm out of the coil's 18.020 mm") && said.contains("[turn-outside]"), "{said}");
    // 17.4 mm for 106 turns: 0.1642 mm for each
    folder.write("squeezed.ron", change(COIL, "cw_climbs", "start_mm: 0.31, end_mm: 17.71, cw_climbs"));
    let said = stderr(&folder.run(&["wind", "squeezed.ron"]));
    assert!(said.contains("winding.end_mm: turns lie 0.1642 mm apart, where the pitch is 0.17 mm"), "{said}");
}

#[test]
fn trim_says_how_to_null_the_reference_coil() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let output = folder.run(&["trim", "coil.ron", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let tail = json["tail_cw_minus_ccw_m"].as_f64().unwrap();
    let trimmed = change(COIL, "tails_m: (cw: 0.0", &format!("tails_m: (cw: {tail}"));
    folder.write("trimmed.ron", trimmed);
    let output = folder.run(&["sensitivity", "trimmed.ron", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(json["total"].as_f64().unwrap().abs() < 1e-5, "{json}");
    let said = stdout(&folder.run(&["trim", "coil.ron"]));
    assert!(said.contains("CW tail must be 1.499 ± ") && said.contains("add 1.499 m to CW"), "{said}");
    // tails that differ already: the step that is told leads to the null
    folder.write("tailed.ron", change(COIL, "tails_m: (cw: 0.0, ccw: 0.0)", "tails_m: (cw: 0.5, ccw: 0.7)"));
    let said = stdout(&folder.run(&["trim", "tailed.ron"]));
    let step: f64 = said.split_once(": add ").unwrap().1.split_once(" m to CW").unwrap().0.parse().unwrap();
    folder.write("nulled.ron", change(COIL, "tails_m: (cw: 0.0, ccw: 0.0)", &format!("tails_m: (cw: {}, ccw: 0.7)", 0.5 + step)));
    let output = folder.run(&["sensitivity", "nulled.ron", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(json["total"].as_f64().unwrap().abs() < 2e-3, "{said}: {json}");
}

#[test]
fn what_looks_like_a_mistake_is_said_and_not_refused() {
    let folder = Folder::new();
    for (old, new, word) in [
        ("outer_radius_mm: 48.825", "outer_radius_mm: 97.65", "coil.outer_radius_mm"),
        ("height_mm: 18.02", "height_mm: 25.0", "coil.height_mm"),
        ("sagnac_diameter_mm: 92.325", "sagnac_diameter_mm: 0.092325", "optics.sagnac_diameter_mm"),
        ("tails_m: (cw: 0.0", "tails_m: (cw: 2000.0", "winding.tails_m"),
        ("layers: 36", "layers: 35", "[broken-pattern]"),
        ("hub_thickness_mm: 4.0", "hub_thickness_mm: 3.9", "[sensor-in-medium]"),
    ] {
        folder.write("coil.ron", change(COIL, old, new));
        let output = folder.run(&["wind", "coil.ron"]);
        assert!(output.status.success(), "{new}: {}", stderr(&output));
        assert!(stderr(&output).contains(word), "{new}: {}", stderr(&output));
    }
    // exactly at the bore, but for rounding
    let thicker = change(COIL, "hub_thickness_mm: 4.0", "hub_thickness_mm: 5.2");
    folder.write("coil.ron", change(&thicker, "radius_mm: 39.5", "radius_mm: 38.3"));
    assert_eq!(stderr(&folder.run(&["wind", "coil.ron"])), "");
    folder.write("coil.ron", COIL);
    let output = folder.run(&["wind", "coil.ron"]);
    assert_eq!(stderr(&output), "");
    assert!(stdout(&output).contains("-2.272064  m^3"), "{}", stdout(&output));
}

#[test]
fn what_is_written_is_said() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n");
    let wind = ["wind", "coil.ron", "--csv", "t.csv", "--svg", "t.svg"];
    assert_eq!(stderr(&folder.run(&wind)), "note: t.csv and t.svg are written\n");
    assert_eq!(stderr(&folder.run(&[&wind[..], &["--quiet"]].concat())), "");
    // warnings stay
    folder.write("long.ron", change(COIL, "(cw: 0.0, ccw: 0.0)", "(cw: 800.0, ccw: 0.0)"));
    folder.write("f.csv", "time_s,chamber_c\n0,73\n3600,160\n");
    let quiet = ["simulate", "long.ron", "--profile", "f.csv", "--out", "f.b.csv", "--quiet"];
    for (arguments, ids) in [(&["wind", "long.ron", "-q"][..], &["long-tail"][..]), (&quiet, &["long-tail", "fahrenheit"])] {
        let said = stderr(&folder.run(arguments));
        let all: Vec<&str> = said.lines().collect();
        assert!(all.len() == ids.len() && all.iter().zip(ids).all(|(line, id)| line.ends_with(&format!("[{id}]"))), "{said}");
        assert!(all.iter().all(|line| line.starts_with("warning: ")), "{said}");
    }
    // and that nothing happens in a profile of one row
    let said = stderr(&folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv"]));
    assert!(said.contains("note: p.csv: has one row, in which nothing can happen [one-row]\n"), "{said}");
    assert!(said.ends_with("note: b.csv is written\n"), "{said}");
}

#[test]
fn a_byte_order_mark_is_no_part_of_the_file() {
    let folder = Folder::new();
    folder.write("coil.ron", format!("\u{feff}{COIL}"));
    assert!(folder.run(&["wind", "coil.ron"]).status.success());
}
