//! Progress of benchmarks, and their results.

use proof::Failure;
use proof::files::{renew, root};
use std::time::Instant;

/// Prints what is going on, with the seconds since the start.
pub(super) struct Progress(Instant);

impl Progress {
    pub(super) fn new() -> Self {
        Self(Instant::now())
    }

    pub(super) fn say(&self, what: &str) {
        eprintln!("[{:5.1} s] {what}", self.0.elapsed().as_secs_f64());
    }
}

pub(super) fn reference_coil() -> Result<::coil::Design, Failure> {
    Ok(fogcoil::input::read_coil(&root().join("fixtures/coil-reference.ron"))?.design)
}

/// Prints a section and puts it into docs/benchmarks.md.
pub(super) fn publish(name: &str, section: &str) -> Result<(), Failure> {
    println!("\n{section}");
    let marks = [&format!("<!-- {name}: written by `cargo xtask bench {name}` -->")[..], &format!("<!-- {name} end -->")];
    renew(&root().join("docs/benchmarks.md"), marks, &format!("\n\n{section}\n"))
}
