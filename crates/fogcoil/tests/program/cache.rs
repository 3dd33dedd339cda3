//! `simulate` with and without its cache.

use crate::common::{COIL, Folder, change, stderr, stdout};

const PROFILE: &str = "time_s,chamber_c\n0,20\n600,30\n1200,25\n3600,25\n";

/// Simulates in `folder` with the cache at `cache`; the JSON's `cached`, the rows and the report.
fn simulate(folder: &Folder, coil: &str, cache: &str, more: &[&str]) -> (bool, String, String) {
    folder.write("coil.ron", coil);
    folder.write("p.csv", PROFILE);
    let arguments = ["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--report", "r.html", "--json", "--quiet"];
    let output = folder.run_with_cache(&[&arguments, more].concat(), cache);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let read = |name| std::fs::read_to_string(folder.path(name)).unwrap();
    (json["cached"].as_bool().unwrap(), read("b.csv"), read("r.html"))
}

#[test]
fn exact_a_cached_model_gives_the_same_bytes() {
    let folder = Folder::new();
    let (first, rows, report) = simulate(&folder, COIL, "cache", &[]);
    assert!(!first);
    let again = simulate(&folder, COIL, "cache", &[]);
    assert_eq!(again, (true, rows.clone(), report.clone()));
    assert_eq!(simulate(&folder, COIL, "cache", &["--no-cache"]), (false, rows.clone(), report));
    let with_report = ["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--report", "r.html"];
    let output = folder.run_with_cache(&with_report, "cache");
    assert!(stdout(&output).contains("from the cache"));
}

#[test]
fn another_design_has_another_model_and_a_spoilt_one_is_built_anew() {
    let folder = Folder::new();
    let (_, rows, _) = simulate(&folder, COIL, "cache", &[]);
    let other = change(COIL, "sensor: (radius_mm: 39.5, y_mm: 10.01)", "sensor: (radius_mm: 39.5, y_mm: 10.02)");
    let (cached, moved, _) = simulate(&folder, &other, "cache", &[]);
    assert!(!cached && moved != rows);
    for entry in std::fs::read_dir(folder.path("cache")).unwrap() {
        let path = entry.unwrap().path();
        let mut bytes = std::fs::read(&path).unwrap();
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        std::fs::write(path, bytes).unwrap();
    }
    assert_eq!(simulate(&folder, COIL, "cache", &[]).1, rows);
}

#[test]
fn without_a_folder_to_keep_models_in_all_works() {
    let folder = Folder::new();
    folder.write("file", "");
    for cache in ["file", "file/below"] {
        assert!(!simulate(&folder, COIL, cache, &[]).0);
    }
    assert!(!simulate(&folder, COIL, "unused", &["--no-cache"]).0);
    assert_eq!(folder.names(), ["b.csv", "coil.ron", "file", "p.csv", "r.html"]);
}
