//! Units made, answered and scored.

use super::synthetic::Plan;
use crate::truth::{Kind, Tier};

/// A few units are made, answered and scored; a second run finds them done.
#[test]
fn units_are_answered() {
    let folder = tempfile::tempdir().unwrap();
    // the library that the program's tests have it keep, if they ran
    let built = std::env::current_exe().unwrap().ancestors().nth(2).unwrap().to_owned();
    let cache = fogcoil::cache::Cache::in_folder(built.join("../tmp/cache")).of_code_in(built.join("fogcoil"));
    let plan = Plan { seed: 2, nulls: 1, concealed: 3 };
    let run = || plan.cases(folder.path(), &cache).unwrap_or_else(|e| panic!("{}", e.0));
    let scored: Vec<_> = run().into_iter().map(|case| case.scored).collect();
    println!("{scored:#?}");
    let of = |kind: Kind| scored.iter().filter(move |s| s.kind == kind);
    assert_eq!((scored.len(), of(Kind::Null).count()), (4, 1));
    assert_eq!(of(Kind::Null).filter(|s| s.detected).count(), 0, "falsely detected");
    assert!(scored.iter().all(|s| !s.misnamed), "confident and wrong");
    let strong = || of(Kind::Single).filter(|s| s.tier != Tier::Weak);
    assert!(strong().count() > 0 && strong().all(|s| s.detected && s.right));
    // nothing is made or answered anew
    let written = || -> Vec<_> {
        let files = |folder: std::path::PathBuf| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let answers = files(folder.path().join("answers")).flat_map(files);
        let mut all: Vec<_> = answers.map(|file| (file.metadata().unwrap().modified().unwrap(), file)).collect();
        all.sort();
        all
    };
    let before = written();
    let again: Vec<_> = run().into_iter().map(|case| case.scored).collect();
    assert!(scored == again && before.len() == 8 && written() == before, "{before:?}");
}

#[test]
fn a_case_has_its_number_in_two_digits() {
    assert_eq!(["3", "03", "case_12"].map(|number| super::case(number).unwrap()), ["case_03", "case_03", "case_12"]);
    assert!(["", "x", "case_", "-1"].iter().all(|number| super::case(number).is_err()));
}
