//! Units whose folder holds three records: two that are fitted, and one that is held out.

use std::path::{Path, PathBuf};

use fogcoil::cache::Cache;
use fogcoil::input::{CoilCase, RATE};

use crate::Failure;
use crate::concealed::{Answer, HeldOut, Written, answer_records, mean, record, rms, used};

/// Records that are fitted.
pub(crate) const FITTED: [&str; 2] = ["run1.csv", "run2.csv"];
/// The record that is held out.
pub(crate) const HELD_OUT: &str = "holdout.csv";

/// Output of the program on the unit in a folder.
pub(crate) fn answer(coil: &CoilCase, folder: &Path, cache: &Cache) -> Result<Written, Failure> {
    let fitted: Vec<PathBuf> = FITTED.iter().map(|file| folder.join(file)).collect();
    answer_records(coil, &fitted, &folder.join(HELD_OUT), cache)
}

/// The record held out, against which predictions are held.
pub(crate) struct HoldOut {
    file: PathBuf,
    recorded: Vec<f64>,
}

impl HoldOut {
    pub(crate) fn of(folder: &Path) -> Result<Self, Failure> {
        let file = folder.join(HELD_OUT);
        let recorded = used(&record(&file)?, RATE)?;
        Ok(Self { file, recorded })
    }

    /// Root mean square of recorded less predicted, less its mean \[deg/h\].
    pub(crate) fn left(&self, predicted: &[f64]) -> Result<f64, Failure> {
        let (rows, own) = (self.recorded.len(), predicted.len());
        if own != rows {
            return Err(Failure(format!("{}: {own} rates are predicted of {rows} that were recorded", self.file.display())));
        }
        let left: Vec<f64> = self.recorded.iter().zip(predicted).map(|(y, p)| y - p).collect();
        let offset = mean(left.iter().copied());
        Ok(rms(left.iter().map(|r| r - offset)))
    }

    /// Residuals of an answer and of the design beside that of the truth, whose error is given.
    pub(crate) fn judge(&self, answer: &Answer, predicted: &[f64], truth: f64) -> Result<HeldOut, Failure> {
        let model = self.left(predicted)?;
        // of many rows the answer's errors are those of means over some: the noise that both predictions lose by that is the same
        let lost = |rmse_model: f64| model.powi(2) - rmse_model.powi(2);
        let nominal = answer.holdout.map_or(f64::NAN, |h| (h.rmse_nominal.powi(2) + lost(h.rmse_model)).max(0.0).sqrt());
        Ok(HeldOut { nominal, model, truth })
    }
}
