//! Mechanisms that `--mechanism` asks for: files of a user's own, and ids of mechanisms that are weighed on request.

use std::collections::BTreeSet;
use std::path::PathBuf;

use mechanisms::{CATALOGUE, Mechanism, ON_REQUEST};

use super::mechanism::{MechanismCase, read_mechanism};
use super::name::meant;
use crate::{Error, shown, shown_path};

/// Mechanisms that `--mechanism` asks for beside the program's usual ones.
#[derive(Default)]
pub struct Asked {
    /// Files of a user's own.
    pub own: Vec<MechanismCase>,
    /// Those of [`mechanisms::ON_REQUEST`], by their ids.
    pub listed: Vec<&'static dyn Mechanism>,
    /// Ids of the program's usual mechanisms that the unit is known not to have.
    pub left_out: Vec<String>,
}

/// Reads the values of `--mechanism`, each once: files, or ids of mechanisms that are weighed on request.
///
/// # Errors
/// As [`read_mechanism`]; [`Error::Usage`] if one is given twice.
pub fn read_mechanisms(paths: &[PathBuf]) -> Result<Asked, Error> {
    let (mut listed, mut files): (Vec<&'static dyn Mechanism>, Vec<&PathBuf>) = (Vec::new(), Vec::new());
    for path in paths {
        match ON_REQUEST.iter().find(|mechanism| path.as_os_str() == mechanism.facts().id) {
            Some(mechanism) if listed.iter().any(|other| other.facts().id == mechanism.facts().id) => {
                let id = mechanism.facts().id;
                return Err(Error::Usage(format!("--mechanism: `{id}` is asked for twice; give each id once")));
            }
            Some(mechanism) => listed.push(*mechanism),
            None => match path.to_str().filter(|id| is_id(id) && !path.is_file()) {
                Some(id) => return Err(unknown_id(id)),
                None => files.push(path),
            },
        }
    }
    Ok(Asked { own: read_own(&files)?, listed, left_out: Vec::new() })
}

/// Whether a word can be an id and no file's name: it has neither a point nor a separator.
fn is_id(word: &str) -> bool {
    word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
}

/// No file, and no mechanism that is weighed on request.
fn unknown_id(id: &str) -> Error {
    let word = shown(id);
    if CATALOGUE.iter().any(|usual| usual.facts().id == id) {
        return Error::Usage(format!("--mechanism: `{word}` is weighed in any case; leave it out"));
    }
    let ids: Vec<&str> = ON_REQUEST.iter().map(|mechanism| mechanism.facts().id).collect();
    let meant = meant(id, ids.iter().copied());
    Error::Usage(format!(
        "--mechanism: `{word}` is no file and no mechanism that is weighed on request; give a file, or one of {}{meant}",
        ids.join(", ")
    ))
}

fn read_own(paths: &[&PathBuf]) -> Result<Vec<MechanismCase>, Error> {
    let own = paths.iter().map(|path| read_mechanism(path)).collect::<Result<Vec<_>, _>>()?;
    let twice = own.iter().enumerate().find(|(k, case)| own[..*k].iter().any(|other| other.mechanism.id == case.mechanism.id));
    match twice {
        Some((_, case)) => Err(Error::Usage(format!(
            "{}: the mechanism `{}` is given twice; give each id once",
            shown_path(&case.file),
            case.mechanism.id
        ))),
        None => Ok(own),
    }
}

/// Reads mechanisms' files that are simulated, each once: their parameters have values.
///
/// # Errors
/// As [`read_mechanism`]; [`Error::Usage`] if one is given twice, or if an id is given: the program's own mechanisms stand in the design.
pub fn read_simulated(paths: &[PathBuf]) -> Result<Vec<MechanismCase>, Error> {
    let files: Vec<&PathBuf> = paths.iter().collect();
    match files.iter().find_map(|path| path.to_str().filter(|id| is_id(id) && !path.is_file())) {
        Some(id) => Err(not_simulated(id)),
        None => read_own(&files),
    }
}

/// Further columns that mechanisms' files name.
pub fn further_columns(own: &[MechanismCase]) -> Vec<String> {
    let all: BTreeSet<&str> = own.iter().flat_map(|own| own.mechanism.columns()).collect();
    all.into_iter().map(str::to_owned).collect()
}

/// Error of an id where files are simulated.
fn not_simulated(id: &str) -> Error {
    let mut listed = CATALOGUE.iter().chain(ON_REQUEST).map(|mechanism| mechanism.facts());
    let text = match listed.find(|facts| facts.id == id) {
        Some(facts) => {
            let place = facts.place.trim_end_matches('.');
            let place = place[..1].to_lowercase() + &place[1..];
            format!(
                "simulate takes the files of your own mechanisms; `{id}` is one of the program's: put it into the coil file ({place}), or take the \
                 coil file that `fogcoil diagnose --model-out` writes"
            )
        }
        None => {
            let ids = CATALOGUE.iter().chain(ON_REQUEST).map(|mechanism| mechanism.facts().id);
            format!("`{}` is no file; give a mechanism's file (`fogcoil new --kind mechanism FILE`){}", shown(id), meant(id, ids))
        }
    };
    Error::Usage(format!("--mechanism: {text}"))
}

impl Asked {
    /// Further columns of records that the mechanisms name.
    pub fn further_columns(&self) -> Vec<String> {
        let own = self.own.iter().flat_map(|own| own.mechanism.columns());
        let all: BTreeSet<&str> = own.chain(self.listed.iter().flat_map(|listed| listed.columns())).collect();
        all.into_iter().map(str::to_owned).collect()
    }

    /// The same without mechanisms of these ids (`--without`), which the unit is known not to have.
    ///
    /// # Errors
    /// [`Error::Usage`] of an id that is none of the program's usual mechanisms.
    pub fn without(self, ids: &[String]) -> Result<Self, Error> {
        let usual = || CATALOGUE.iter().map(|mechanism| mechanism.facts().id);
        match ids.iter().find(|id| usual().all(|usual| usual != id.as_str())) {
            Some(id) => {
                let (word, meant) = (shown(id), meant(id, usual()));
                Err(Error::Usage(format!(
                    "--without: `{word}` is no mechanism that is weighed in any case (`fogcoil explain`){meant}"
                )))
            }
            None => Ok(Self { left_out: ids.to_vec(), ..self }),
        }
    }

    /// The program's mechanisms but those left out, and those asked for.
    pub fn with_catalogue(&self) -> Vec<&dyn Mechanism> {
        let own = self.own.iter().map(|own| &own.mechanism as &dyn Mechanism);
        let usual = CATALOGUE.iter().filter(|usual| self.left_out.iter().all(|id| id != usual.facts().id));
        usual.chain(&self.listed).map(|known| *known as &dyn Mechanism).chain(own).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_weighed_on_request_is_asked_for_by_its_id() {
        let ask = |ids: &[&str]| read_mechanisms(&ids.iter().map(PathBuf::from).collect::<Vec<_>>());
        let asked = ask(&["drying", "moisture"]).unwrap();
        assert!(asked.own.is_empty());
        assert_eq!(asked.further_columns(), ["humidity_percent"]);
        let all: Vec<&str> = asked.with_catalogue().iter().map(|mechanism| mechanism.facts().id).collect();
        assert_eq!(all.len(), CATALOGUE.len() + 2);
        assert_eq!(all[CATALOGUE.len()..], ["drying", "moisture"]);
        // once each, and by its whole id; one of the usual mechanisms is weighed anyway
        assert!(ask(&["drying", "drying"]).is_err());
        assert!(ask(&["dryin"]).is_err() && ask(&["debond"]).is_err());
    }

    #[test]
    fn what_a_unit_has_not_is_left_out() {
        let asked = || read_mechanisms(&["drying".into()]).unwrap();
        let without = |id: &str| asked().without(&[id.to_owned()]);
        let left = without("debond").unwrap();
        let ids: Vec<&str> = left.with_catalogue().iter().map(|mechanism| mechanism.facts().id).collect();
        assert!(ids.len() == CATALOGUE.len() && !ids.contains(&"debond") && ids.contains(&"drying"));
        let says = |id: &str| without(id).err().unwrap().to_string();
        assert!(
            says("debnd").contains("did you mean `debond`?")
                && says("drying").contains("`drying` is no mechanism that is weighed in any case")
        );
    }
}
