//! Documents that quote code which other tests compile and run.

fn read(path: &str) -> String {
    let path: std::path::PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", path].iter().collect();
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_worked_example_of_a_mechanism_is_the_one_that_is_tested() {
    let page = read("docs/adding-a-mechanism.md");
    let example = read("crates/mechanisms/tests/read_out_curvature/mod.rs");
    assert!(page.contains(&format!("```rust,ignore\n{example}```\n")), "copy the file into the page");
    assert!(read("crates/mechanisms/tests/chain.rs").contains("\nmod read_out_curvature;\n"), "it is not compiled");
}
