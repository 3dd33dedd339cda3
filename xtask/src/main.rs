//! Project chores: `cargo xtask validate [--json FILE]`.

mod validate;

use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "usage: cargo xtask validate [--json FILE]\n\n  \
    validate   run the whole chain, compare with the paper's Tables I to IV,\n             \
    write docs/validation.md and the README's headline table; exit 1 if a row that must hold does not";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let json = match words[..] {
        ["validate"] => None,
        ["validate", "--json", file] => Some(PathBuf::from(file)),
        ["--help" | "-h" | "help"] | ["validate", "--help" | "-h"] => {
            println!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            let given =
                if words.is_empty() { "no command is given".into() } else { format!("`{}` is not a command", words.join(" ")) };
            eprintln!("error: {given}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    match validate::run(json.as_deref()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
