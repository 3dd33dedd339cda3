//! The reader never panics, whatever bytes it is given.

use crate::common::{CELL, COIL, Folder};
use fogcoil::input::{read_cell, read_coil, read_profile};
use proptest::prelude::*;

/// A change to a text: at a relative place, some bytes removed and others put in.
fn edit() -> impl Strategy<Value = (f64, usize, Vec<u8>)> {
    let words: Vec<Vec<u8>> = [
        "\n", "\r", ";", "\u{feff}", "time_s", "(", ")", "[", "]", ",", ":", "\"", "//", "/*", "*/", "r#\"", "NaN", "-", "1e999",
        "Some((", "0", "é",
    ]
    .iter()
    .map(|word| word.as_bytes().to_vec())
    .collect();
    let inserted = prop_oneof![proptest::sample::select(words), proptest::collection::vec(any::<u8>(), 0..4)];
    (0.0..1.0, 0_usize..12, inserted)
}

fn mutate(text: &str, edits: &[(f64, usize, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (place, removed, inserted) in edits {
        let start = (place * bytes.len() as f64) as usize;
        let end = (start + removed).min(bytes.len());
        bytes.splice(start..end, inserted.iter().copied());
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_files_are_read_or_refused(edits in proptest::collection::vec(edit(), 1..4)) {
        let folder = Folder::new();
        for (name, reference) in [("cell.ron", CELL), ("coil.ron", COIL)] {
            let path = folder.write(name, mutate(reference, &edits));
            let message = match name {
                "cell.ron" => read_cell(&path).err().map(|e| e.to_string()),
                _ => read_coil(&path).err().map(|e| e.to_string()),
            };
            if let Some(message) = message {
                prop_assert!(message.contains(name) && message.lines().count() == 1, "{}", message);
            }
        }
    }

    #[test]
    fn mutated_profiles_are_read_or_refused(edits in proptest::collection::vec(edit(), 1..4)) {
        let folder = Folder::new();
        let design = read_coil(&folder.write("coil.ron", COIL)).unwrap().design;
        let path = folder.write("p.csv", mutate("time_s,chamber_c,left_c,spool_c\n0,20,20,1\n30,21.5,-1e1,2\r\n\n60,1e2,+3,\n", &edits));
        match read_profile(&path, &design, &[]) {
            Ok(case) => prop_assert!(case.profile.drives.iter().all(|course| course.len() == case.profile.time.len())),
            Err(error) => {
                let message = error.to_string();
                prop_assert!(message.contains("p.csv") && message.lines().count() == 1, "{}", message);
            }
        }
    }
}
