//! `fogcoil homogenize` of cells that are not regular: the format, the strains, the files, the refusals.

use crate::common::{CELL, COIL, Folder, change, line_of, stderr};
use fogcoil::input::read_coil;
use serde_json::Value;

const FAULTS: &str = include_str!("../../../../fixtures/cells/faults.ron");
const DISPLACED: &str = include_str!("../../../../fixtures/cells/displaced.ron");
const TEMPERATURE: &str = include_str!("../../../../fixtures/cells/temperature.ron");

fn json(folder: &Folder, arguments: &[&str]) -> Value {
    let output = folder.run(&[&["homogenize"], arguments, &["--json"]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("no {key} in {value}"))
}

#[test]
fn a_table_at_its_row_is_the_cell_of_that_row() {
    let folder = Folder::new();
    folder.write("t.ron", TEMPERATURE);
    folder.write("cell.ron", CELL);
    let all = json(&folder, &["t.ron", "--temperatures", "20,50"]);
    let (at20, at50) = (&all["temperatures"][0], &all["temperatures"][1]);
    let regular = json(&folder, &["cell.ron"]);
    for (general, plain) in [("e_x", "e_r"), ("e_z", "e_z"), ("alpha_y", "alpha_r"), ("m_rt", "m_rt"), ("k_x", "k_r")] {
        assert!((number(at20, general) / number(&regular, plain) - 1.0).abs() < 1e-5, "{general}");
    }
    // half-way between two rows every constant is half-way between theirs
    let halved = [
        (
            "youngs_modulus_mpa: 2.0, poisson_ratio: 0.4998, thermal_expansion_per_k: 250.0e-6",
            "youngs_modulus_mpa: 1.9, poisson_ratio: 0.4998, thermal_expansion_per_k: 255.0e-6",
        ),
        (
            "youngs_modulus_mpa: 870.0, poisson_ratio: 0.4118, thermal_expansion_per_k: 102.75e-6",
            "youngs_modulus_mpa: 465.0, poisson_ratio: 0.4459, thermal_expansion_per_k: 141.375e-6",
        ),
    ];
    folder.write("cell.ron", halved.iter().fold(CELL.to_owned(), |text, (old, new)| change(&text, old, new)));
    let between = json(&folder, &["cell.ron"]);
    for (general, plain) in [("e_x", "e_r"), ("e_z", "e_z"), ("alpha_y", "alpha_r"), ("m_rt", "m_rt")] {
        assert!((number(at50, general) / number(&between, plain) - 1.0).abs() < 1e-5, "{general}");
        assert!((number(at50, general) / number(at20, general) - 1.0).abs() > 1e-3, "{general}");
    }
    assert_eq!(number(at50, "temperature_c"), 50.0);
}

#[test]
fn strains_and_files_of_a_faulty_cell() {
    let folder = Folder::new();
    folder.write("f.ron", FAULTS);
    let arguments = ["f.ron", "--load", "exx=1e-4,dt=10", "--vtu", "f.vtu", "--svg", "f.svg", "--field", "mechanical_radial"];
    let result = json(&folder, &arguments);
    let silica = &result["strains"]["phases"]["silica"]["mean_radial"]["total"]["mean"];
    let from_row = number(&result, "m_rx") * 1e-4 + number(&result, "m_rt") * 10.0;
    assert!((silica.as_f64().unwrap() / from_row - 1.0).abs() < 1e-6, "{silica} {from_row}");
    assert!(number(&result, "void_fraction") > 0.01 && number(&result, "anisotropy") > 1e-3);
    let vtu = std::fs::read_to_string(folder.path("f.vtu")).unwrap();
    let count =
        |key: &str| vtu.split(&format!("{key}=\"")).nth(1).and_then(|s| s.split('"').next()).unwrap().parse::<usize>().unwrap();
    let (points, cells) = (count("NumberOfPoints"), count("NumberOfCells"));
    let array = |name: &str| vtu.split(&format!("Name=\"{name}\"")).nth(1).and_then(|s| s.split('>').nth(1)).unwrap();
    let words = |name: &str| array(name).trim_end_matches("</DataArray").split_whitespace().count();
    let found = ["position", "total_strain", "total_radial", "phase", "connectivity"].map(words);
    assert_eq!(found, [3 * points, 6 * points, points, cells, 4 * cells]);
    let svg = std::fs::read_to_string(folder.path("f.svg")).unwrap();
    assert!(svg.contains("mechanical strain radial") && svg.ends_with("</svg>\n"));
}

#[test]
fn realisations_have_a_spread_and_a_single_one_has_none() {
    let folder = Folder::new();
    let small = change(&change(DISPLACED, "columns: 3", "columns: 2"), "rows: 3", "rows: 1");
    let many = json(&folder, &[folder.write("d.ron", &small).to_str().unwrap()]);
    assert_eq!(many["spread"]["realisations"], 4);
    assert!(number(&many["spread"]["standard_deviation"], "e_x") > 1e-4 * number(&many, "e_x"));
    assert!(number(&many["spread"]["standard_deviation"], "e_z") < 1e-4 * number(&many, "e_z"));
    let one = change(&small, "realisations: 4", "realisations: 1");
    assert!(json(&folder, &[folder.write("d.ron", one).to_str().unwrap()])["spread"].is_null());
}

#[test]
fn what_cannot_be_used_is_named_where_it_stands() {
    let folder = Folder::new();
    let refuse = |text: String, arguments: &[&str], line: Option<usize>, complaint: &str| {
        folder.write("c.ron", text);
        let output = folder.run(&[&["homogenize", "c.ron"], arguments].concat());
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{complaint}: {message}");
        assert!(message.contains(complaint), "`{complaint}` not in {message}");
        if let Some(line) = line {
            assert!(message.contains(&format!("c.ron:{line}: ")), "line {line} not in {message}");
        }
        assert!(folder.names() == ["c.ron"], "{:?}", folder.names());
    };
    let faults = |old: &str, new: &str| change(FAULTS, old, new);
    let at = |word: &str| Some(line_of(FAULTS, word));
    refuse(faults("(168.0, 0.0)", "(160.0, 0.0)"), &[], at("centres_um"), "overlap");
    refuse(faults("(84.0, 49.5)", "(70.0, 49.5)"), &[], at("(84.0, 49.5)"), "voids[0]");
    refuse(faults("offset_um: (3.0, 1.0)", "offset_um: (30.0, 1.0)"), &[], at("\"silica\""), "does not lie inside");
    refuse(faults("nu_xy: 0.41", "nu_xy: 1.41"), &[], at("nu_xy"), "nu_xy");
    refuse(faults("angle_deg: 20.0", "angle_deg: 2000.0"), &[], at("angle_deg: 20.0"), "angle_deg");
    refuse(faults("angle_deg: 20.0", "angle: 20.0"), &[], at("angle_deg: 20.0"), "angle");
    refuse(faults("cell_um: (", "pitch_um: 170.0, cell_um: ("), &[], at("cell_um: ("), "beside");
    let table = |old: &str, new: &str| change(TEMPERATURE, old, new);
    refuse(table("temperature_c: -30.0", "temperature_c: -70.0"), &[], None, "not greater than the row before");
    refuse(TEMPERATURE.into(), &[], None, "--temperatures");
    refuse(TEMPERATURE.into(), &["--temperatures", "20,90"], None, "90 degC is outside");
    refuse(CELL.into(), &["--temperatures", "20"], None, "no constituent is a table");
    refuse(CELL.into(), &["--load", "rr=1"], None, "not a load");
    refuse(CELL.into(), &["--vtu", "x.vtu"], None, "--load");
    refuse(CELL.into(), &["--load", "dt=1", "--svg", "x.svg", "--field", "zzz"], None, "not a field");
    refuse(change(DISPLACED, "least_film_um: 1.0", "least_film_um: 6.0"), &[], Some(line_of(DISPLACED, "least_film_um")), "film");
    refuse(change(DISPLACED, "columns: 3", "columns: 0"), &[], Some(line_of(DISPLACED, "columns")), "at least 1");
}

/// Two fibres on the regular lattice are the regular cell; an offset coating too far from isotropic is refused with the number.
#[test]
fn a_coil_takes_a_general_cell_that_is_nearly_isotropic() {
    let folder = Folder::new();
    let start = COIL.find("Constants((").unwrap();
    let end = start + COIL[start..].find("))").unwrap() + 2;
    let matrix = "Matrix((m_rx: 0.0274, m_ry: 0.0270, m_rz: -0.17, m_rt_per_k: -9.98e-6))";
    let coil = change(&change(COIL, &COIL[start..end], "FromCell(\"cell.ron\")"), matrix, "FromCell(\"cell.ron\")");
    let coil = folder.write("coil.ron", coil);
    folder.write("cell.ron", CELL);
    let regular = read_coil(&coil).unwrap();
    folder.write("cell.ron", change(CELL, "pitch_um: 170.0,", "pitch_um: 170.0, columns: 2,"));
    let general = read_coil(&coil).unwrap();
    let (a, b) = (general.design, regular.design);
    let pairs = [
        (a.body.elastic.e_r, b.body.elastic.e_r),
        (a.body.elastic.nu_zr, b.body.elastic.nu_zr),
        (a.body.elastic.alpha_r, b.body.elastic.alpha_r),
        (a.body.conductivity_r, b.body.conductivity_r),
        (a.dehomogenization.m_rx, b.dehomogenization.m_ry),
        (a.dehomogenization.m_rz, b.dehomogenization.m_rz),
        (a.dehomogenization.m_rt, b.dehomogenization.m_rt),
    ];
    pairs.iter().for_each(|(found, expected)| assert!((found / expected - 1.0).abs() < 1e-5, "{found:e} {expected:e}"));
    assert!(general.warnings.iter().any(|w| w.text.contains("by 0.00 %")), "{:?}", general.warnings);
    folder.write("cell.ron", FAULTS);
    let refused = read_coil(&coil).unwrap_err().to_string();
    assert!(refused.contains("coil.ron:") && refused.contains("% of strain energy, more than the 1 %"), "{refused}");
    folder.write("cell.ron", TEMPERATURE);
    assert!(read_coil(&coil).unwrap_err().to_string().contains("tables over temperature"));
}

/// A table and an orthotropic solid may have densities beside them.
#[test]
fn densities_of_general_cells() {
    let folder = Folder::new();
    let with = |text: &str| {
        let heavy = "material: (density_kg_per_m3: 1200.0, specific_heat_j_per_kgk: 1500.0, ";
        text.replace("material: (", heavy).replace("adhesive: (", &heavy.replace("material", "adhesive"))
    };
    let result = json(&folder, &[folder.write("f.ron", with(FAULTS)).to_str().unwrap(), "--tolerance", "1e-2"]);
    let solid = 1.0 - number(&result, "void_fraction");
    assert!((number(&result, "density_kg_per_m3") / (1200.0 * solid) - 1.0).abs() < 1e-6);
    assert!((number(&result, "heat_capacity_j_per_m3k") / (1.8e6 * solid) - 1.0).abs() < 1e-6);
    let [capacity, density, specific] =
        ["heat_capacity_j_per_m3k", "density_kg_per_m3", "specific_heat_j_per_kgk"].map(|key| number(&result, key));
    assert!((specific * density / capacity - 1.0).abs() < 1e-12);
    let file = folder.write("t.ron", with(TEMPERATURE));
    let result = json(&folder, &[file.to_str().unwrap(), "--temperatures", "50", "--tolerance", "1e-2"]);
    assert!((number(&result["temperatures"][0], "density_kg_per_m3") / 1200.0 - 1.0).abs() < 1e-6);
}
