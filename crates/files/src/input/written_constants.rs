//! The constants of a cell, written into a coil file.

use std::path::Path;

use coil::Dehomogenization;
use homogenization::Constants;
use serde::Serialize;

use super::InputError;
use super::coil_file::{self, DehomogenizationFile, MaterialFile};
use super::edit::with_fields;
use super::mirror::Mirror;

/// A coil file's text with the constants of a cell, and its row M, in place of its own; what `FromCell` says, without the cell's file.
///
/// # Errors
/// As [`with_fields`]; messages call the text `path`.
pub fn with_constants(path: &Path, text: &str, constants: &Constants) -> Result<String, InputError> {
    let Constants { k_z, k_r, m_rx, m_ry, m_rz, m_rt, .. } = *constants;
    let material = coil_file::Constants { elastic: constants.elastic(), conductivity_z: k_z, conductivity_r: k_r };
    let row = Dehomogenization { m_rx, m_ry, m_rz, m_rt };
    let values = [
        ("coil.material", ron(&MaterialFile::Constants(Mirror::of(&material)))),
        ("dehomogenization", ron(&DehomogenizationFile::Matrix(Mirror::of(&row)))),
    ];
    with_fields(path, text, &values.map(|(field, value)| (field.to_owned(), value)))
}

/// Numbers in a choice have nothing that RON cannot say.
fn ron(value: &impl Serialize) -> String {
    ron::to_string(value).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::super::{AnyCell, check_any_cell, check_coil, read_coil, read_text};
    use super::*;

    #[test]
    fn constants_that_are_written_are_those_of_the_cell_that_is_named() {
        let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
        let (cell, coil) = (fixtures.join("cell-reference.ron"), fixtures.join("coil-reference.ron"));
        let text = read_text(&coil).unwrap();
        let named =
            [("coil.material", "FromCell(\"cell-reference.ron\")"), ("dehomogenization", "FromCell(\"cell-reference.ron\")")];
        let named = with_fields(&coil, &text, &named.map(|(field, value)| (field.into(), value.into()))).unwrap();
        let named = check_coil(&coil, &named).unwrap().design;
        let AnyCell::Regular(case, _) = check_any_cell(&cell, &read_text(&cell).unwrap()).unwrap() else {
            panic!("a regular cell")
        };
        let constants = case.homogenize_to(homogenization::TOLERANCE).unwrap().constants;
        let written = check_coil(&coil, &with_constants(&coil, &text, &constants).unwrap()).unwrap().design;
        for (a, b) in [
            (written.body.elastic.e_z, named.body.elastic.e_z),
            (written.body.elastic.alpha_r, named.body.elastic.alpha_r),
            (written.body.conductivity_r, named.body.conductivity_r),
            (written.dehomogenization.m_rz, named.dehomogenization.m_rz),
            (written.dehomogenization.m_rt, named.dehomogenization.m_rt),
        ] {
            assert!((a / b - 1.0).abs() < 1e-15, "{a} {b}");
        }
        assert_ne!(written.body.elastic.e_z, read_coil(&coil).unwrap().design.body.elastic.e_z);
        assert!(with_constants(&coil, "(winding: ())", &constants).is_err());
    }
}
