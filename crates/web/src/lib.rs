//! The program in a web page: a question as JSON in, an answer as JSON out.
//!
//! [`answer`] computes nothing of its own: it calls the library [`fogcoil`], and its numbers are the program's. Compiled to WebAssembly it is one file
//! that needs nothing: no file, no network, no clock, no threads. `cargo xtask web` puts it into a page with a form; [`exchange`] is how the page
//! hands over its texts.
//!
//! ```
//! use serde_json::{Value, json};
//!
//! let files: Value = serde_json::from_str(&web::answer(r#"{"start": {}}"#)).unwrap();
//! let thicker = json!({"design": {"coil": files["answer"]["coil"], "values": [["spool.hub_thickness_mm", "4.5"], ["sensor.radius_mm", "39.0"]]}});
//! let design: Value = serde_json::from_str(&web::answer(&thicker.to_string())).unwrap();
//! assert_eq!(design["answer"]["values"]["spool.hub_thickness_mm"], "4.5");
//! assert!((design["answer"]["winding"]["fibre_m"].as_f64().unwrap() - 1101.57).abs() < 0.01);
//! ```

mod design;
pub mod exchange;
mod question;
mod results;

use fogcoil::Error;
use serde_json::{Value, json};

use question::Question;

/// The answer to a question, `{"answer": ...}`, or `{"error": "..."}` with the program's message.
///
/// Questions, each with texts of files in place of their paths:
///
/// - `{"start": {}}`: files to start from: `coil`, `cell`, `profile`;
/// - `{"design": {"coil", "values", "cell", "of_cell"}}`: the coil file with other `values`, pairs of a key and RON, and the constants of a `cell` with other
///   values `of_cell` if there is one; its winding, as `fogcoil wind --json` has it, and its section as SVG;
/// - `{"sensitivity": {"coil"}}`: what `fogcoil sensitivity` prints, as text and as JSON;
/// - `{"simulate": {"coil", "profile", "step"}}`: what `fogcoil simulate` prints, with `--step` if there is one, the result as CSV, and figures as HTML;
/// - `{"check": {"name", "text"}}`: what `fogcoil check` says of a recording in the standard columns.
pub fn answer(question: &str) -> String {
    let found = serde_json::from_str(question).map_err(|error| format!("the question cannot be read: {error}"));
    let answer = found.and_then(|question| answered(&question).map_err(|error| error.to_string()));
    match answer {
        Ok(answer) => json!({ "answer": answer }),
        Err(message) => json!({ "error": message }),
    }
    .to_string()
}

fn answered(question: &Question) -> Result<Value, Error> {
    match question {
        Question::Start {} => Ok(design::start()),
        Question::Design(changes) => design::changed(changes),
        Question::Sensitivity { coil } => results::sensitivity(coil),
        Question::Simulate { coil, profile, step } => results::simulate(coil, profile, *step),
        Question::Check { name, text } => results::check(name, text),
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_question_is_refused() {
        for question in ["", "{", "3", r#"{"ask": {}}"#, r#"{"start": {"coil": ""}}"#, r#"{"check": {"name": "a"}}"#] {
            let said: Value = serde_json::from_str(&answer(question)).unwrap();
            assert!(said["error"].as_str().unwrap().starts_with("the question cannot be read"), "{question}: {said}");
        }
    }

    #[test]
    fn messages_are_the_program_s() {
        let said = answer(&json!({"sensitivity": {"coil": "(name: \"x\""}}).to_string());
        assert!(said.contains("coil.ron") && said.contains("is cut short"), "{said}");
        let said = answer(&json!({"check": {"name": "b.csv", "text": "time_s,rate_deg_per_h\n0,1\nx,2\n"}}).to_string());
        assert!(said.contains("b.csv:3: time_s"), "{said}");
    }
}
