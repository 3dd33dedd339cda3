//! No result replaces a file that was read, named on the command line or not.

use crate::common::{CELL, COIL, Folder, change, stderr};

const RECORD: &str = "time_s,chamber_c,spool_c,rate_deg_per_h\n0,20,20,0.1\n30,20,20,0.2\n60,21,20,0.1\n";

/// Runs and expects `file` to be refused and to stay as it is.
fn keeps(folder: &Folder, arguments: &[&str], file: &str) {
    let (names, before) = (folder.names(), std::fs::read(folder.path(file)).unwrap());
    let output = folder.run(arguments);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.contains(&format!("{file}: is given twice, or is an input")), "{message}");
    assert_eq!((folder.names(), std::fs::read(folder.path(file)).unwrap()), (names, before));
}

#[test]
fn files_beside_a_record_stay() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("r.csv", RECORD);
    folder.write("meta.ron", "(sample_interval_s: 30.0)");
    folder.write("r.map.ron", "()");
    for file in ["meta.ron", "r.map.ron"] {
        keeps(&folder, &["check", "r.csv", "--svg", file], file);
        keeps(&folder, &["diagnose", "coil.ron", "--fit", "r.csv", "--json", file], file);
        keeps(&folder, &["recommend", "coil.ron", "--between", "a,b", "--from", "r.csv", "--out", file], file);
    }
    folder.write("other.ron", "()");
    keeps(&folder, &["check", "r.csv", "--map", "other.ron", "--svg", "other.ron"], "other.ron");
    keeps(&folder, &["check", "r.csv", "--meta", "other.ron", "--svg", "other.ron"], "other.ron");
}

#[test]
fn a_cell_that_a_coil_names_stays() {
    let folder = Folder::new();
    folder.write("cell.ron", CELL);
    let start = COIL.find("material: Constants(").unwrap();
    let end = start + COIL[start..].find(")),").unwrap() + 1;
    folder.write("coil.ron", change(COIL, &COIL[start..=end], "material: FromCell(\"cell.ron\")"));
    folder.write("p.csv", "time_s,chamber_c\n0,20\n30,20\n");
    keeps(&folder, &["wind", "coil.ron", "--csv", "cell.ron"], "cell.ron");
    keeps(&folder, &["simulate", "coil.ron", "--profile", "p.csv", "--out", "cell.ron"], "cell.ron");
}

#[test]
fn the_map_that_a_run_writes_is_not_drawn_over() {
    let folder = Folder::new();
    folder.write("r.csv", RECORD);
    let output = folder.run(&["check", "r.csv", "--write-map", "m.map.ron", "--svg", "m.map.ron"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("m.map.ron: is given twice"), "{}", stderr(&output));
    assert_eq!(folder.names(), ["r.csv"], "nothing half-written");
}
