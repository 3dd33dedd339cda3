//! `fogcoil identify`: what it refuses, and one small answer in both forms.

use crate::common::{Folder, stderr, stdout};

const TABLE_ONE: &str = include_str!("../../../../fixtures/identify/table-one.ron");

#[test]
fn bad_targets_are_refused_in_one_message() {
    for (from, to, says) in [
        ("e_z_gpa: Printed(\"14.5\")", "e_z_gpa: Printed(\"14,5\")", ["e_z_gpa", "is not a number"]),
        ("e_z_gpa: Printed(\"14.5\")", "e_z_gpa: Measured(14.5, 0.0)", ["e_z_gpa", "standard deviation"]),
        ("e_z_gpa: Printed(\"14.5\")", "e_z_gpa: Printed(\"-14.5\")", ["e_z_gpa", "not greater than 0"]),
        ("e_z_gpa: P", "e_z_mpa: P", ["e_z_mpa", "unknown field"]),
        ("kind: AnyCoating", "kind: Wood", ["Wood", "AnyCoating"]),
        ("(163.0, 167.0)", "(167.0, 163.0)", ["outer_diameter_um", "empty"]),
        ("(163.0, 167.0)", "(183.0, 187.0)", ["outer_diameter_um", "pitch"]),
        ("glass: true", "glass: false", ["glass", "no ring is glass"]),
        ("kind: AnyCoating", "kind: AnyCoating, poisson_ratio: Between(0.6, 0.7)", ["cells[0]", "Poisson's ratio"]),
        (
            "kind: AnyCoating",
            "kind: AnyCoating, poisson_ratio: Between(0.3, 0.4), bulk_modulus_mpa: Between(1.0, 2.0)",
            ["poisson_ratio", "remove one"],
        ),
        (
            "kind: AnyCoating",
            "kind: AnyCoating, thermal_expansion_per_k: Between(-1e-6, 1e-6)",
            ["thermal_expansion", "positive"],
        ),
        ("pitch_um: 170.0", "pitch_um: NaN", ["pitch_um", "finite"]),
    ] {
        assert!(TABLE_ONE.contains(from), "{from}");
        let folder = Folder::new();
        folder.write("t.ron", TABLE_ONE.replacen(from, to, 1));
        let output = folder.run(&["identify", "t.ron"]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{to}: {message}");
        assert!(stdout(&output).is_empty());
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains("t.ron") && says.iter().all(|part| message.contains(part)), "{to}: {message}");
    }
    let folder = Folder::new();
    let targets = TABLE_ONE.split_once("targets: (").unwrap();
    let without = format!("{}targets: (),\n cells: {}", targets.0, targets.1.split_once("cells: ").unwrap().1);
    folder.write("t.ron", without);
    let output = folder.run(&["identify", "t.ron"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("no constant is given"), "{}", stderr(&output));
}

/// A bare fibre from four constants: text, JSON and their agreement.
#[test]
fn a_small_answer() {
    let folder = Folder::new();
    folder.write(
        "t.ron",
        r#"(name: "bare", pitch_um: 170.0,
            targets: (e_z_gpa: Printed("36.1"), e_r_mpa: Measured(5300.0, 100.0), alpha_r_per_k: Printed("60e-6"), k_r_w_per_mk: Printed("0.45")),
            cells: [(name: "bare fibre",
                rings: [(name: "silica", outer_diameter_um: (124.0, 126.0), glass: true, material: (kind: Silica))],
                adhesive: (kind: Adhesive, conductivity_w_per_mk: Between(0.1, 0.5)))])"#,
    );
    let output = folder.run(&["identify", "t.ron", "--json", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).is_empty());
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(json["explained"], true, "{json}");
    let e_r = json["cells"][0]["best"]["entries"]["e_r"]["value"].as_f64().unwrap();
    assert!((e_r / 5.3e9 - 1.0).abs() < 0.06, "{e_r}");
    let adhesive = &json["posterior"]["parameters"][4];
    assert_eq!((adhesive["of"].as_str(), adhesive["quantity"].as_str()), (Some("adhesive"), Some("youngs_modulus")));
    let [low, high] = [0, 1].map(|i| adhesive["ci90"][i].as_f64().unwrap());
    assert!(1e6 < low && low < high && high < 3e9 && high / low < 10.0, "{low} {high}");
    assert_eq!(json["alternatives"]["sets"].as_array().unwrap().len(), 2);
    let schema: serde_json::Value = serde_json::from_str(include_str!("../../../../docs/schema/identify.schema.json")).unwrap();
    for key in schema["required"].as_array().unwrap() {
        assert!(json.get(key.as_str().unwrap()).is_some(), "{key}");
    }
    assert_eq!(json.as_object().unwrap().len(), schema["properties"].as_object().unwrap().len());
}
