//! Checks that no compiler makes: documents that quote code which tests compile and run, and tests that no program holds.

use std::path::{Path, PathBuf};

fn read(path: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", path].iter().collect();
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_worked_example_of_a_mechanism_is_the_one_that_is_tested() {
    let page = read("docs/adding-a-mechanism.md");
    let example = read("crates/mechanisms/tests/read_out_curvature/mod.rs");
    assert!(page.contains(&format!("```rust,ignore\n{example}```\n")), "copy the file into the page");
    assert!(read("crates/mechanisms/tests/chain.rs").contains("\nmod read_out_curvature;\n"), "it is not compiled");
}

/// A crate's tests are modules of one program, which has to name them.
#[test]
fn every_file_of_tests_is_compiled() {
    let crates: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", "crates"].iter().collect();
    let inside = |folder: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(folder).map_or(Vec::new(), |all| all.map(|entry| entry.expect("a file").path()).collect())
    };
    let tests: Vec<PathBuf> = inside(&crates).iter().map(|folder| folder.join("tests")).collect();
    let programs = tests.iter().flat_map(|folder| inside(folder)).chain(tests.clone());
    let mut seen = 0;
    for folder in programs {
        let Ok(main) = std::fs::read_to_string(folder.join("main.rs")) else { continue };
        for file in inside(&folder).iter().filter(|file| file.extension().is_some_and(|end| end == "rs")) {
            let name = file.file_stem().and_then(|name| name.to_str()).expect("a name");
            assert!(name == "main" || main.contains(&format!("\nmod {name};\n")), "{} is not compiled", file.display());
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}

/// The page on trust names tests by what they hold the program to: each is a function of the crate that it names.
#[test]
fn the_tests_that_the_page_on_trust_names_are_there() {
    fn sources(folder: &Path, all: &mut String) {
        for entry in std::fs::read_dir(folder).into_iter().flatten() {
            let path = entry.expect("a file").path();
            if path.is_dir() {
                sources(&path, all);
            } else if path.extension().is_some_and(|end| end == "rs") {
                all.push_str(&std::fs::read_to_string(&path).expect("a source"));
            }
        }
    }
    let page = read("docs/trust.md");
    let rows = page.lines().filter(|line| line.starts_with('|') && line.contains("(`crates/"));
    let mut seen = 0;
    for cell in rows.filter_map(|row| row.split('|').nth(3)) {
        let mut waiting = Vec::new();
        for name in cell.split('`').skip(1).step_by(2) {
            let Some(krate) = name.strip_prefix("crates/") else {
                waiting.push(name);
                continue;
            };
            let (root, mut all) =
                ([env!("CARGO_MANIFEST_DIR"), "..", "crates", krate].iter().collect::<PathBuf>(), String::new());
            ["src", "tests"].iter().for_each(|part| sources(&root.join(part), &mut all));
            for test in waiting.drain(..) {
                assert!(all.contains(&format!("fn {test}(")), "{krate} has no test {test}");
                seen += 1;
            }
        }
        assert!(waiting.is_empty(), "{cell}: of which crate?");
    }
    assert!(seen >= 15, "{seen}");
}
