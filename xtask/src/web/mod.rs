//! `cargo xtask web`: the program in a page that needs no installation, compared with the program in a browser.

mod page;
mod toolchain;
mod trial;

use std::fs;
use std::path::Path;

use proof::Failure;
use proof::files::{failed, renew, root};

use crate::browser;
use crate::tools::{cargo, program, remapped, run};
use page::page;
use toolchain::TARGET;

/// Beside the book's pages, which are built with it.
const PAGE: &str = "docs/try-it.html";
const ABOUT: &str = "docs/try.md";
const MARKS: [&str; 2] = ["<!-- web: written by `cargo xtask web` -->", "<!-- web end -->"];

/// Compile the program to WebAssembly, put it into a page, and compare the page with the program in headless Chromium
///
/// Writes docs/try-it.html, which is not kept in the repository, and the sizes and differences into docs/try.md. Needs the standard library for wasm32:
/// that of the compiler if it is there, else one that is fetched into target/tools. Exit status 1 if a number differs by more than
/// rounding, or the page asks for anything.
#[derive(Debug, clap::Args)]
pub(crate) struct Web {
    /// Make the page and do not open it
    #[arg(long)]
    untried: bool,
}

impl Web {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let module = module()?;
        let file = root().join(PAGE);
        let html = page(&module)?;
        fs::write(&file, &html).map_err(failed(&file))?;
        let sizes = format!(
            "The module is {:.2} MB; the page, which holds it compressed, is {:.2} MB.",
            module.len() as f64 / 1e6,
            html.len() as f64 / 1e6
        );
        println!("{PAGE} is written. {sizes}");
        if self.untried {
            return Ok(true);
        }
        let chromium = browser::find()?;
        let tried = trial::tried(&chromium, &file, &program()?)?;
        println!("{}", tried.text);
        renew(&root().join(ABOUT), MARKS, &format!("\n{sizes} {}\n", tried.text))?;
        tried.faults.iter().for_each(|fault| println!("{fault}"));
        Ok(tried.faults.is_empty())
    }
}

/// The crate `web` as WebAssembly.
fn module() -> Result<Vec<u8>, Failure> {
    let compiler = toolchain::compiler()?;
    let into = root().join("target/web");
    let mut build = cargo();
    build.args([
        "build",
        "--quiet",
        "--locked",
        "--profile",
        "web",
        "--package",
        "fogcoil-web",
        "--target",
        TARGET,
        "--target-dir",
    ]);
    // nothing in a page draws at random; the processor's vectors are used where there are any, and all browsers have them
    let flags = [remapped(&root()), "--cfg=getrandom_backend=\"unsupported\"".into(), "-Ctarget-feature=+simd128".into()];
    build.arg(&into).env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
    compiler.used_by(&mut build);
    if !run(&mut build)? {
        return Err(Failure("the crate web does not build for WebAssembly".into()));
    }
    let file = into.join(TARGET).join("web/web.wasm");
    fs::read(Path::new(&file)).map_err(failed(&file))
}
