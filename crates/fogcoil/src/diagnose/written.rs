//! The extended model as a file, and whether the file gives by itself what the fit says of it.

use std::path::Path;

use diagnosis::Active;
use files::{Note, Remark};
use mechanisms::{RATE, SPOOL};

use super::Outcome;
use super::as_drawn::rms;
use crate::Error;
use crate::input::check_coil;
use crate::table::significant;

/// An extended model's file.
pub struct Written {
    /// The file.
    pub text: String,
    /// A warning, where the file leaves more of the fitted records than the fit does.
    pub note: Option<Note>,
}

/// Error of the file over that of the fit from which the file is not what was fitted: a residual beyond it is more than noise.
const MORE: f64 = 1.3;
/// Channels with their names and units.
const CHANNELS: [(usize, &str, &str); 2] = [(RATE, "rate", "deg/h"), (SPOOL, "thermometer", "K")];

impl Outcome<'_> {
    /// [`Self::model`] as a file, whose heading ends with what its design leaves of the fitted records in a full simulation: a mechanism that is strong, or beside
    /// another strong one, may act otherwise than the fit takes it to.
    ///
    /// # Errors
    /// [`Error`] if the design cannot be solved. The inner one is the reason why there is no file.
    pub fn written(&self) -> Result<Result<Written, String>, Error> {
        let text = match self.model() {
            Ok(text) => text,
            Err(why) => return Ok(Err(why)),
        };
        let Some(left) = self.left_by(&text)? else { return Ok(Ok(Written { text, note: None })) };
        let said = |(_, name, unit): (usize, &str, &str), [by_file, by_fit]: [f64; 2]| {
            format!("{} {unit} rms of the {name} (the fit {})", significant(by_file, 3), significant(by_fit, 3))
        };
        let all = || CHANNELS.iter().zip(&left).filter_map(|(channel, left)| Some((*channel, (*left)?)));
        let lines: Vec<String> = all().map(|(channel, left)| said(channel, left)).collect();
        let more: Vec<String> =
            all().filter(|(_, [by_file, by_fit])| *by_file > MORE * by_fit).map(|(channel, left)| said(channel, left)).collect();
        let comment = format!("// Simulated under the fitted records, this design leaves {}.\n", lines.join(" and "));
        let heading: usize = text.split_inclusive('\n').take_while(|line| line.starts_with("//")).map(str::len).sum();
        let text = [&text[..heading], comment.as_str(), &text[heading..]].concat();
        let note = (!more.is_empty()).then(|| {
            Remark::WrittenModel.warning(format!(
                "simulated, the design of this file leaves {} of the fitted records: its numbers are those of the fit, which is good \
                 only for smaller changes; take what it names for found, and its sizes for rough",
                more.join(" and ")
            ))
        });
        Ok(Ok(Written { text, note }))
    }

    /// Root mean square of what a file's design leaves of thermometer and rate in all fitted records, and of what the fit leaves, in the order of
    /// [`CHANNELS`]; `None` where it is the drawing, or cannot be compared.
    fn left_by(&self, file: &str) -> Result<Option<[Option<[f64; 2]>; 2]>, Error> {
        let (coil, fit) = (Error::of_coil(&self.coil), &self.diagnosis.best().fit);
        let Ok(case) = check_coil(Path::new("the extended model"), file) else { return Ok(None) };
        if self.law().is_some() || case.design == *self.gyro.library().design() {
            return Ok(None);
        }
        // laws of a user's own have files of their own
        let in_the_file = |active: &&Active| mechanisms::find(self.id(active.mechanism)).is_some();
        let active: Vec<Active> = fit.active.iter().filter(in_the_file).cloned().collect();
        let mut residuals = [const { [const { Vec::new() }; 2] }; 2];
        for (record, channels) in fit.residuals.iter().enumerate() {
            let missed = self.gyro.missed(record, &fit.nuisances[record], &active, &case.design).map_err(&coil)?;
            let Some(missed) = missed else { return Ok(None) };
            for ((channel, ..), [by_file, by_fit]) in CHANNELS.iter().zip(&mut residuals) {
                let used = || channels[*channel].iter().zip(&missed[*channel]).filter(|(residual, _)| residual.is_finite());
                // offsets are fitted: they would take a constant
                let level = used().map(|(_, missed)| missed).sum::<f64>() / used().count().max(1) as f64;
                by_file.extend(used().map(|(residual, missed)| residual - (missed - level)));
                by_fit.extend(used().map(|(residual, _)| *residual));
            }
        }
        Ok(Some(residuals.map(|[by_file, by_fit]| (!by_fit.is_empty()).then(|| [rms(&by_file), rms(&by_fit)]))))
    }
}
