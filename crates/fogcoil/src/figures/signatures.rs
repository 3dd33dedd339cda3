//! Contribution of each mechanism of the library to the nominal response: the signatures among which a diagnosis chooses.

use charts::{Axis, Figure, Panel};

use super::document::Document;
use crate::Error;
use crate::cache::Cache;
use crate::comparison::{CHANNELS, Responses, chamber};
use crate::input::CoilCase;

/// Height of a panel in font sizes.
const HIGH: f64 = 4.5;

/// Signatures of all mechanisms under one fast programme, a panel for rate and thermometer of each, as a file.
///
/// # Errors
/// [`files::Error::Coil`] if the design cannot be modelled.
pub fn signatures(case: &CoilCase, cache: &Cache) -> Result<Document, Error> {
    let responses = Responses::of(case, cache)?;
    let (number, programme) = (1, &responses.programmes[1]);
    let unlabelled = || Axis::tight("", 1.0);
    let mut panels: Vec<Panel> =
        [&programme.name, " "].map(|heading| chamber(programme, unlabelled(), HIGH).headed(heading)).into();
    for entry in &responses.entries {
        // over both panels of the row
        for (channel, heading) in CHANNELS.into_iter().zip([entry.typical(2), " ".into()]) {
            panels.push(entry.change((number, programme), channel, unlabelled(), HIGH).headed(heading));
        }
    }
    if let [.., a, b] = &mut panels[..] {
        [a, b].into_iter().for_each(|last| last.x.label = "time [h]".into());
    }
    let figure = Figure {
        id: "signatures",
        title: "Signatures of the mechanisms".into(),
        description: format!(
            "Under {}: a row for each mechanism of the library, left what it adds to the gyro's rate, right what it adds to the spool \
             thermometer's reading, over time; the chamber's temperature above.",
            programme.name
        ),
        caption: format!("{}; each mechanism at a typical size, without noise. Each panel has its own scale.", case.name),
        columns: 2,
        panels,
    };
    Ok((figure.id, figure.document()))
}
