//! Every way a case file can be wrong ends in one message, exit status 2, and nothing written.

use crate::common::{CELL, COIL, Folder, change, line_of, schema, stderr};
use serde_json::json;

/// Replaced text, its replacement, the field that the message names, and a part of the message.
type Case = (&'static str, &'static str, &'static str, &'static str);

fn refuse(folder: &Folder, arguments: &[&str], expected: &[&str]) {
    let before = folder.names();
    let output = folder.run(arguments);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(output.stdout.is_empty());
    assert!(message.starts_with("error: ") && message.trim_end().lines().count() == 1, "{message}");
    for part in expected {
        assert!(message.contains(part), "`{part}` not in: {message}");
    }
    assert_eq!(folder.names(), before, "something was written");
}

fn refuse_all(reference: &str, file: &str, arguments: &[&str], cases: &[Case]) {
    for (old, new, field, says) in cases {
        let folder = Folder::new();
        folder.write(file, change(reference, old, new));
        let line = line_of(reference, old);
        refuse(&folder, arguments, &[&format!("{file}:{line}: {field}: "), says]);
    }
}

#[test]
fn a_bad_value_in_a_cell_file() {
    let cases: &[Case] = &[
        ("pitch_um: 170.0", "pitch_um: -170.0", "pitch_um", "not greater than 0"),
        ("pitch_um: 170.0", "pitch_um: NaN", "pitch_um", "NaN is not a finite number"),
        ("pitch_um: 170.0", "pitch_um: 1e999", "pitch_um", "inf is not a finite number"),
        ("pitch_um: 170.0", "pitch_um: \"170\"", "pitch_um", "a number is needed"),
        ("pitch_um: 170.0", "pitch_um: 170.0, pitch_um: 1.0", "pitch_um", "twice"),
        ("pitch_um: 170.0", "pitch_mm: 0.17", "pitch_mm", "unknown field `pitch_mm`; the fields here are name, pitch_um, rings"),
        ("outer_diameter_um: 80.0", "outer_diameter_um: 0.0", "rings[0].outer_diameter_um", "not greater than 0"),
        (
            "outer_diameter_um: 112.0",
            "outer_diameter_um: 79.0",
            "rings[1].outer_diameter_um",
            "79 um is not greater than the ring",
        ),
        ("outer_diameter_um: 165.0", "outer_diameter_um: 170.0", "rings[2].outer_diameter_um", "no adhesive is left"),
        ("glass: true", "glass: false", "rings[0].glass", "no ring is glass"),
        ("glass: true", "glass: yes", "rings[0].glass", "`true` or `false`"),
        (
            "poisson_ratio: 0.4998,",
            "poisson_ratio: 0.5,",
            "rings[1].material.poisson_ratio",
            "0.5 is not greater than -1 and less than",
        ),
        ("poisson_ratio: 0.4998,", "poisson_ratio: -1,", "rings[1].material.poisson_ratio", "e.g. 0.4998"),
        ("poisson_ratio: 0.4998,", "", "rings[1].material.poisson_ratio", "the field is missing"),
        ("poisson_ratio: 0.49985", "poison: 0.49985", "adhesive.poison", "the fields here are youngs_modulus_mpa, poisson_ratio"),
        ("youngs_modulus_mpa: 70200.0", "youngs_modulus_mpa: 70.2e9", "rings[0].material.youngs_modulus_mpa", "in MPa"),
        ("expansion_per_k: 0.55e-6", "expansion_per_k: 0.55", "rings[0].material.thermal_expansion_per_k", "e.g. 0.55e-6"),
        ("conductivity_w_per_mk: 0.45", "conductivity_w_per_mk: -1", "adhesive.conductivity_w_per_mk", "not greater than 0"),
        ("conductivity_w_per_mk: 0.45", "conductivity_w_per_mk: 0.00045", "adhesive.conductivity_w_per_mk", "the least accepted"),
    ];
    refuse_all(CELL, "cell.ron", &["homogenize", "cell.ron", "--json"], cases);
}

#[test]
fn a_bad_value_in_the_winding() {
    let cases: &[Case] = &[
        ("layers: 36", "layers: 0", "winding.layers", "at least 1"),
        ("layers: 36", "layers: 36.0", "winding.layers", "not whole"),
        ("layers: 36", "layers: -36", "winding.layers", "a whole number"),
        ("layers: 36", "layers: 99999999999999999999999", "winding.layers", "a whole number"),
        ("layers: 36", "layers: 10001", "winding.layers", "more than 10000"),
        ("turns_odd_layers: 106", "turns_odd_layers: 100001", "winding.turns_odd_layers", "more than 100000"),
        ("turns_even_layers: 105", "turns_even_layers: 107", "winding.turns_even_layers", "set it to 106"),
        ("pattern: PracticalQuadrupole", "pattern: Hexapole", "winding.pattern", "choose Cylindrical or Dipole or"),
        ("cw_climbs: Right", "cw_climbs: Up", "winding.cw_climbs", "choose Left or Right"),
        ("turn_length: True", "turn_length: true", "winding.turn_length", "choose True or Equal"),
        ("pitch_mm: 0.170", "pitch_mm: 170.0", "winding.pitch_mm", "in mm, e.g. 0.170"),
        ("pitch_mm: 0.170", "pitch_mm: 0.000170", "winding.pitch_mm", "in mm, e.g. 0.170"),
        ("pitch_mm: 0.170", "pitch_mm: 0,170", "winding.pitch_mm", "write decimals with a point"),
        ("inner_radius_mm: 43.5", "inner_radius_mm: 43,5", "winding", "decimals with a point"),
        ("cw: 0.0, ccw", "cw: -0.1, ccw", "winding.tails_m.cw", "negative"),
        ("inner_radius_mm: 43.5", "inner_radius_mm: inf", "winding.inner_radius_mm", "not a finite number"),
    ];
    refuse_all(COIL, "coil.ron", &["wind", "coil.ron", "--csv", "out.csv", "--svg", "out.svg"], cases);
}

#[test]
fn a_bad_value_in_the_coil() {
    let cases: &[Case] = &[
        // g/cm3, kJ/(kg K), kW/(m K)
        ("density_kg_per_m3: 1400.0", "density_kg_per_m3: 1.4", "coil.density_kg_per_m3", "1.4 kg/m3 is less than 9 kg/m3"),
        ("density_kg_per_m3: 2700.0", "density_kg_per_m3: 4.43", "spool.material.density_kg_per_m3", "the least accepted"),
        ("kgk: 1300.0", "kgk: 1.3", "coil.specific_heat_j_per_kgk", "1.3 J/(kg K) is less than 100 J/(kg K)"),
        ("kgk: 896.0", "kgk: 0.526", "spool.material.specific_heat_j_per_kgk", "give the value in J/(kg K)"),
        ("mk: 167.0", "mk: 0.0067", "spool.material.conductivity_w_per_mk", "0.0067 W/(m K) is less than 0.01 W/(m K)"),
        ("kgk: 1005.0", "kgk: 1.005", "surroundings.medium.specific_heat_j_per_kgk", "the least accepted"),
        ("outer_radius_mm: 48.825", "outer_radius_mm: 48.0", "coil.outer_radius_mm", "the winding reaches 48.8229 mm"),
        (
            "outer_radius_mm: 48.825",
            "outer_radius_mm: 5.325",
            "coil.outer_radius_mm",
            "5.325 mm is not greater than winding.inner_radius_mm, 43.5 mm; give both as radii of the wound coil: either may be a diameter or a thickness",
        ),
        ("cw_climbs: Right", "start_mm: -0.1, cw_climbs: Right", "winding.start_mm", "give more than -0.0850"),
        ("cw_climbs: Right", "end_mm: 18.2, cw_climbs: Right", "winding.end_mm", "give less than 18.1054"),
        ("cw_climbs: Right", "end_mm: -1.0, cw_climbs: Right", "winding.end_mm", "above start"),
        ("cw_climbs: Right", "start_mm: inf, cw_climbs: Right", "winding.start_mm", "not a finite number"),
        ("height_mm: 18.02", "height_mm: 17.85", "coil.height_mm", "the winding reaches 18.0200 mm"),
        ("e_r_mpa: 95.2", "e_r_mpa: 0.0", "coil.material.e_r_mpa", "not greater than 0"),
        ("nu_r: 0.979", "nu_r: 0.999", "coil.material.nu_r", "0.997982"),
        ("nu_r: 0.979", "nu_r: NaN", "coil.material.nu_r", "NaN is not"),
        (
            "k_z_w_per_mk: 0.51, k_r_w_per_mk: 0.34,\n        ))",
            "k_r_w_per_mk: 0.34))",
            "coil.material.k_z_w_per_mk",
            "the field is missing",
        ),
        ("hub_thickness_mm: 4.0", "hub_thickness_mm: 43.5", "spool.hub_thickness_mm", "leaves no bore"),
        ("hub_bonded: true", "hub_bonded: 1", "spool.hub_bonded", "`true` or `false`"),
        ("overhang_mm: 1.0", "overhang_mm: -1.0", "spool.flanges[0].overhang_mm", "negative"),
        ("poisson_ratio: 0.33", "poisson_ratio: 0.5", "spool.material.poisson_ratio", "0.5 is not"),
        ("margin_mm: 10.0", "margin_mm: 0.0", "surroundings.margin_mm", "not greater than 0; give the value in mm, e.g. 10.0"),
        ("radius_mm: 39.5", "radius_mm: 70.0", "sensor", "outside the chamber"),
        ("refractive_index: 1.45", "refractive_index: 0.9", "optics.refractive_index", "less than 1"),
        ("thermo_optic_per_k: 1.0e-5", "thermo_optic_per_k: 1.0e5", "optics.thermo_optic_per_k", "e.g. 1.0e-5 for silica"),
        ("p11: 0.121", "p11: 12.1", "optics.p11", "more than 1"),
        ("p12: 0.270", "p12: NaN", "optics.p12", "not a finite number"),
        ("strain: Total", "strain: Elastic", "optics.strain", "choose Total or Mechanical"),
        ("m_rz: -0.17,", "m_rz: -17.0,", "dehomogenization.m_rz", "less than -10"),
    ];
    refuse_all(COIL, "coil.ron", &["sensitivity", "coil.ron"], cases);
}

#[test]
fn a_second_flange_at_a_side() {
    let flange = "(side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true)";
    let folder = Folder::new();
    folder.write("coil.ron", change(COIL, flange, &format!("{flange},\n{flange}")));
    let line = 1 + line_of(COIL, flange);
    refuse(&folder, &["sensitivity", "coil.ron"], &[&format!("coil.ron:{line}: spool.flanges[1].side: "), "at most one flange"]);
}

#[test]
fn a_cell_that_cannot_be_used() {
    let given = &COIL
        [COIL.find("Constants((").unwrap()..COIL.find("k_r_w_per_mk: 0.34,").unwrap() + "k_r_w_per_mk: 0.34,\n        ))".len()];
    let coil = change(COIL, given, "FromCell(\"inner.ron\")");
    let line = line_of(&coil, "material: FromCell");
    let folder = Folder::new();
    folder.write("coil.ron", &coil);
    let outer = format!("coil.ron:{line}: coil.material: ");
    refuse(&folder, &["sensitivity", "coil.ron"], &[&outer, "inner.ron: cannot be read"]);
    folder.write("inner.ron", change(CELL, "poisson_ratio: 0.17", "poisson_ratio: 0.7"));
    let inner = format!("inner.ron:{}: rings[0].material.poisson_ratio: 0.7", line_of(CELL, "poisson_ratio: 0.17"));
    refuse(&folder, &["sensitivity", "coil.ron"], &[&outer, &inner]);
}

#[test]
fn a_file_that_is_no_case_file() {
    let folder = Folder::new();
    folder.write("empty.ron", "");
    folder.write("blank.ron", " \n\n");
    folder.write("latin.ron", b"(\n  name: \"\xe9\",\n)");
    folder.write("large.ron", vec![b' '; (1 << 20) + 1]);
    folder.write("deep.ron", "(".repeat(100_000));
    folder.write("lists.ron", format!("(name: {}", "[".repeat(100_000)));
    folder.write("record.csv", b"Datum;T (\xb0C)\n1;2\n");
    folder.write("cut.ron", &CELL[..CELL.len() / 2]);
    folder.write("twice.ron", format!("{CELL}{CELL}"));
    std::fs::create_dir(folder.path("folder.ron")).unwrap();
    for command in ["homogenize", "wind", "sensitivity"] {
        for (file, says) in [
            ("empty.ron", "empty.ron: is empty"),
            ("blank.ron", "blank.ron: is empty"),
            ("latin.ron", "latin.ron:2: is not UTF-8"),
            ("record.csv", "record.csv: looks like a table, not a RON file; the coil's file comes first"),
            ("large.ron", "large.ron: is larger than"),
            ("deep.ron", "deep.ron:1: the file is cut short, or a bracket is never closed"),
            ("lists.ron", "lists.ron:1: name"),
            ("missing.ron", "missing.ron: cannot be read"),
            ("folder.ron", "folder.ron: is a directory"),
        ] {
            refuse(&folder, &[command, file], &[says]);
        }
    }
    refuse(&folder, &["homogenize", "cut.ron"], &["cut.ron:"]);
    let line = format!("twice.ron:{}: the file goes on", CELL.lines().count() + 1);
    refuse(&folder, &["homogenize", "twice.ron"], &[&line]);
}

#[test]
fn an_output_that_cannot_be_written() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    std::fs::create_dir(folder.path("folder")).unwrap();
    for (path, says) in [
        ("none/x.svg", "none/x.svg: there is no folder none; make it, or name another"),
        ("coil.ron/x.svg", "coil.ron/x.svg: there is no folder coil.ron"),
        ("./coil.ron", "coil.ron: is given twice, or is an input"),
        ("folder/../good.csv", "good.csv: is given twice, or is an input"),
        ("folder", "folder: is a folder; name a file in it"),
        ("..", "..: names no file"),
        ("-", "-: is no file; name one"),
    ] {
        refuse(&folder, &["wind", "coil.ron", "--csv", "good.csv", "--svg", path], &[says]);
    }
    assert_eq!(std::fs::read_to_string(folder.path("coil.ron")).unwrap(), COIL);
}

/// A file behind standard output would be replaced, and what else goes there lost.
#[cfg(target_os = "linux")]
#[test]
fn streams_and_devices_are_no_outputs() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("log", "kept\n");
    for path in ["/dev/stdout", "/dev/null", "/dev/fd/1", "/proc/self/fd/1"] {
        let log = std::fs::File::options().append(true).open(folder.path("log")).unwrap();
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_fogcoil"));
        let output =
            command.args(["wind", "coil.ron", "--csv", path]).current_dir(folder.path(".")).stdout(log).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{path}");
        assert!(
            stderr(&output).starts_with(&format!("error: {path}: is a device or a pipe; name a file")),
            "{}",
            stderr(&output)
        );
    }
    assert_eq!(std::fs::read_to_string(folder.path("log")).unwrap(), "kept\n");
    assert!(std::process::Command::new("mkfifo").arg(folder.path("pipe")).status().unwrap().success());
    refuse(&folder, &["wind", "coil.ron", "--svg", "pipe"], &["pipe: is a device or a pipe"]);
    // where nobody may write, the message has the file's own name alone
    let output = folder.run(&["wind", "coil.ron", "--svg", "/sys/x.svg"]);
    let message = stderr(&output);
    assert!(message.starts_with("error: /sys/x.svg: cannot be written: ") && !message.contains(".fogcoil-"), "{message}");
}

#[test]
fn a_path_is_checked_before_anything_is_read() {
    let folder = Folder::new();
    let out = "none/f: there is no folder none";
    for arguments in [
        &["simulate", "c.ron", "--profile", "p.csv", "--out", "none/f"][..],
        &["simulate", "c.ron", "--profile", "p.csv", "--out", "b.csv", "--report", "none/f"],
        &["diagnose", "c.ron", "--fit", "r.csv", "--model-out", "none/f"],
        &["diagnose", "c.ron", "--fit", "r.csv", "--report", "none/f"],
        &["diagnose", "c.ron", "--fit", "r.csv", "--json", "none/f"],
        &["diagnose", "c.ron", "--fit", "r.csv", "--holdout", "h.csv", "--prediction", "none/f"],
        &["recommend", "c.ron", "--between", "a,b", "--out", "none/f"],
        &["homogenize", "c.ron", "--svg", "none/f"],
        &["homogenize", "c.ron", "--load", "dt=1", "--vtu", "none/f"],
        &["check", "r.csv", "--svg", "none/f"],
        &["new", "none/f"],
    ] {
        refuse(&folder, arguments, &[out]);
    }
}

/// Faults of a file in JSON are mended in JSON.
#[test]
fn a_fault_in_json_is_told_in_its_words() {
    let folder = Folder::new();
    folder.write("c.json", "{\n \"name\": \"x\",\n \"spool\": 3\n}\n");
    refuse(
        &folder,
        &["wind", "c.json"],
        &["c.json:3: spool: a group of fields is needed; write it in braces, {\"name\": value, ...}"],
    );
    folder.write("c.json", "{\n \"name\": tru\n}\n");
    refuse(&folder, &["wind", "c.json"], &["c.json:2: is not JSON: expected ident, at its end"]);
    // a key that cannot be a name in RON is unknown like any other
    for key in ["foo-bar", "//", "outer diameter", "1", "\u{e4}"] {
        folder.write("c.json", format!("{{\n \"name\": \"x\",\n \"{key}\": {{\"a b\": 1}}\n}}\n"));
        let unknown = format!("c.json:3: unknown field `{key}`; the fields here are name, winding, coil");
        refuse(&folder, &["wind", "c.json"], &[&unknown]);
    }
    for (field, says) in [
        ("\"heat\": {\"a-b\": 1}", "c.json:2: heat: unknown field `a-b`; the fields here are "),
        (
            "\"winding\": {\"pattern\": \"Di pole\"}",
            "c.json:2: winding.pattern: `Di pole` is not a choice here; choose Cylindrical or ",
        ),
        ("\"winding\": {\"pattern\": 3}", "c.json:2: winding.pattern: a name is needed; write it in double quotes"),
        ("\"a-b\": 3", "c.json:2: unknown field `a-b`"),
        ("\"$schema\": 3, \"winding\": {}", "c.json:2: unknown field `$schema`"),
        ("\"winding\": {\"$schema\": \"x\"}", "c.json:2: winding: unknown field `$schema`"),
    ] {
        folder.write("c.json", format!("{{\n {field}\n}}\n"));
        refuse(&folder, &["wind", "c.json"], &[says]);
    }
}

/// An editor finds the schema by it.
#[test]
fn the_address_of_the_schema_is_ignored_in_json() {
    let folder = Folder::new();
    let cell = |first: &str, columns: &str| {
        let material = "{\"youngs_modulus_mpa\": 70200.0, \"poisson_ratio\": 0.17, \"thermal_expansion_per_k\": 5e-7, \"conductivity_w_per_mk\": 1.38}";
        let ring = format!("{{\"name\": \"g\", \"outer_diameter_um\": 80.0, \"glass\": true, \"material\": {material}}}");
        let text = format!(
            "{{{first}\n\"name\": \"x\", \"pitch_um\": 170, \"columns\": {columns}, \"rings\": [{ring}], \"adhesive\": {material}}}"
        );
        let schema = schema("cell");
        let kept = fogcoil::schema::misfit(&serde_json::from_str(&text).unwrap(), &schema).is_none();
        folder.write("x.cell.json", text);
        let output = folder.run(&["homogenize", "x.cell.json", "--json"]);
        (kept, output.status.success(), stderr(&output))
    };
    for first in ["", "\"$schema\": \"./cell.schema.json\","] {
        let (kept, done, said) = cell(first, "1");
        assert!(kept && done, "{said}");
    }
    // a whole number is one in whatever way it is written, and 0 fibres are none
    assert!(cell("", "1.0").1);
    let (kept, done, said) = cell("", "0");
    assert!(!kept && !done && said.contains("x.cell.json:2: columns: 0 is not a count"), "{said}");
}

/// A value that the program refuses for itself alone is refused by the schema, too.
#[test]
fn what_a_schema_can_bound_it_bounds() {
    let rings = &CELL[CELL.find("rings: [").unwrap()..CELL.find("    adhesive").unwrap()];
    for (kind, text, old, new, place, value) in [
        ("cell", CELL, rings, "rings: [],", "/properties/rings", json!([])),
        ("cell", CELL, "poisson_ratio: 0.17", "poisson_ratio: 0.5", "/$defs/MaterialFile/properties/poisson_ratio", json!(0.5)),
        ("cell", CELL, "poisson_ratio: 0.17", "poisson_ratio: -1", "/$defs/MaterialFile/properties/poisson_ratio", json!(-1)),
        ("cell", CELL, "pitch_um", "rows: 101, pitch_um", "/properties/rows", json!(101)),
        ("coil", COIL, "layers: 36", "layers: 0", "/$defs/WindingFile/properties/layers", json!(0)),
        ("coil", COIL, "layers: 36", "layers: 10001", "/$defs/WindingFile/properties/layers", json!(10001)),
        ("coil", COIL, "layers: 36", "layers: 36.5", "/$defs/WindingFile/properties/layers", json!(36.5)),
        ("coil", COIL, "poisson_ratio: 0.33", "poisson_ratio: 0.5", "/$defs/SolidFile/properties/poisson_ratio", json!(0.5)),
    ] {
        let folder = Folder::new();
        folder.write("c.ron", change(text, old, new));
        refuse(&folder, &[if kind == "cell" { "homogenize" } else { "wind" }, "c.ron"], &["c.ron:"]);
        let schema = schema(kind);
        let of = schema.pointer(place).unwrap_or_else(|| panic!("{place}"));
        assert!(fogcoil::schema::misfit(&value, of).is_some(), "{place}: {value}");
    }
}

#[test]
fn a_template_is_not_written_under_a_name_that_is_read_as_json() {
    let folder = Folder::new();
    refuse(&folder, &["new", "c.JSON"], &["c.JSON: templates are RON; name it c.ron"]);
    refuse(&folder, &["new", "p.csv"], &["p.csv: templates are RON; name it p.ron"]);
    refuse(&folder, &["new", "profile", "p.ron"], &["p.ron: the template of a profile is a table; name it p.csv"]);
    assert!(!folder.path("c.JSON").exists());
}

#[test]
fn a_file_of_another_kind_is_named() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("cell.ron", CELL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n");
    folder.write("p.txt", "0;20,5\n");
    folder.write("comment.ron", "// nothing yet\n");
    folder.run(&["new", "t.ron", "--kind", "targets"]);
    for (command, file, says) in [
        ("homogenize", "coil.ron", "is a coil file, but a cell file is read here; `fogcoil new --kind cell FILE` writes one"),
        ("sensitivity", "cell.ron", "is a cell file, but a coil file is read here; `fogcoil new FILE` writes one"),
        ("sensitivity", "t.ron", "is a file of targets, but a coil file"),
        ("identify", "cell.ron", "is a cell file, but a file of targets is read here; `fogcoil new --kind targets FILE`"),
        ("sensitivity", "p.csv", "looks like a table, not a RON file; `fogcoil new FILE` writes one"),
        ("homogenize", "p.txt", "looks like a table, not a RON file"),
        ("sensitivity", "comment.ron", "is empty; `fogcoil new FILE` writes one to start from"),
        ("check", "coil.ron", "begins like a RON file, but a table (CSV) is read here; its first line names the columns"),
    ] {
        refuse(&folder, &[command, file], &[&format!("error: {file}: {says}")]);
    }
    let simulate = ["simulate", "coil.ron", "--out", "b.csv"];
    for flag in ["--profile", "--spool"] {
        refuse(&folder, &[&simulate[..], &[flag, "coil.ron"]].concat(), &["error: coil.ron: begins like a RON file"]);
    }
}

#[test]
fn bad_usage() {
    let folder = Folder::new();
    for arguments in [&[][..], &["unwind", "x.ron"], &["wind"], &["wind", "x.ron", "--json"], &["homogenize", "a", "b"]] {
        assert_eq!(folder.run(arguments).status.code(), Some(2));
    }
}

#[test]
fn a_file_that_is_cut_short_is_called_so_wherever_it_ends() {
    let folder = Folder::new();
    for (name, command, text) in [("cell.ron", "homogenize", CELL), ("coil.ron", "sensitivity", COIL)] {
        for tenth in 3..10 {
            let mut end = text.len() * tenth / 10;
            while !text.is_char_boundary(end) {
                end -= 1;
            }
            folder.write(name, &text[..end]);
            let output = folder.run(&[command, name]);
            assert_eq!(output.status.code(), Some(2));
            assert!(stderr(&output).contains("cut short"), "{name} at {tenth}/10: {}", stderr(&output));
        }
    }
}

#[test]
fn mechanics_that_cannot_be_are_refused() {
    let folder = Folder::new();
    for (mechanics, field) in [
        ("Relaxing((fraction: 0.95, time_s: 600.0))", "mechanics"),
        ("Relaxing((fraction: 0.5, time_s: -1.0))", "mechanics.time_s"),
        ("TemperatureTable([])", "mechanics"),
        ("Opening((side: Left, below_c: 0.0, hysteresis_k: 5.0, fraction: 0.4))", "mechanics"),
        (
            "TemperatureTable([(temperature_c: 0.0, transverse_modulus_factor: 30.0, transverse_expansion_factor: 1.0)])",
            "mechanics[0].transverse_modulus_factor",
        ),
    ] {
        let text = change(COIL, "    sensor: (", &format!("    mechanics: {mechanics},\n    sensor: ("));
        folder.write("coil.ron", &text);
        let output = folder.run(&["sensitivity", "coil.ron"]);
        assert_eq!(output.status.code(), Some(2), "{mechanics}: {}", stderr(&output));
        let line = 1 + text[..text.find("mechanics:").unwrap()].matches('\n').count();
        assert!(stderr(&output).contains(&format!("coil.ron:{line}: {field}")), "{mechanics}: {}", stderr(&output));
    }
}
