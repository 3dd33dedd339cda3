//! The extended model: the design with what was found put in at its place, as a coil file.

use diagnosis::{Active, ForwardModel, Place, Posterior, Role, Verdict};
use mechanisms::{RATE as RATE_CHANNEL, with_constant};

use super::{Held, Outcome, Record};
use crate::input::check_coil;
use crate::output::coil_file;
use crate::table::significant;

impl Outcome<'_> {
    /// A coil file of the design with what was found, fitted, that `fogcoil simulate` runs.
    ///
    /// The extended design; where the nominal model suffices, or predicts a held-out record better, it is the nominal design.
    ///
    /// # Errors
    /// Reason why there is none: nothing was found, or a coil file cannot hold it.
    pub fn model(&self) -> Result<String, String> {
        let best = self.leading();
        let (nominal, known) = (self.gyro.library().design(), self.gyro.library().tolerances());
        let found = match self.diagnosis.verdict {
            Verdict::Unknown if self.law().is_some() => {
                best.posteriors(&self.gyro).into_iter().filter(|p| matches!(p.place, Place::Nominal(_))).collect()
            }
            Verdict::Unknown | Verdict::None => Vec::new(),
            _ if !self.accepted() => Vec::new(),
            Verdict::Recalibrate | Verdict::Explained => best.posteriors(&self.gyro),
        };
        let mut comments = self.heading();
        if found.is_empty() {
            return Ok(coil_file(&self.name, nominal, known, &comments));
        }
        comments.extend(found.iter().filter(|p| p.record.is_none()).map(|p| said(p, self.interval(p))));
        let mut design = nominal.clone();
        for posterior in found.iter().filter(|p| p.place == Place::Nominal(Role::Constant)) {
            match with_constant(&design, &posterior.name, posterior.value()) {
                Some(changed) => design = changed,
                None => return Err(format!("a coil file cannot hold a change of {}", posterior.name)),
            }
        }
        // laws that were composed have files of their own
        let listed = best.active.iter().filter(|active| active.mechanism < self.gyro.mechanisms().len());
        for (place, active) in listed.enumerate() {
            if let (Some((name, value)), Some([low, high])) = (self.choice(active), self.diagnosis.choice(place)) {
                comments.push(format!("  {name} = {value} ({low} to {high}), compared with every other"));
            }
            let caveat = (self.gyro.mechanism(active.mechanism).facts().caveat)(nominal);
            comments.extend(caveat.map(|caveat| format!("  {caveat}")));
            match self.gyro.extended(&design, active) {
                Some(changed) => design = changed,
                None => return Err(format!("a coil file cannot hold {}", self.names().join(" and "))),
            }
        }
        comments.extend(self.doubts());
        let name = match self.names().join(" and ") {
            _ if self.law().is_some() => format!("{}, beside a composed law", self.name),
            names if names.is_empty() => format!("{}, recalibrated", self.name),
            names => format!("{}, {names}", self.name),
        };
        let text = coil_file(&name, &design, known, &comments);
        check_coil("the extended model".as_ref(), &text).map_err(|error| error.to_string())?;
        Ok(text)
    }

    /// Heading of the file: its contents and their origin.
    fn heading(&self) -> Vec<String> {
        let names = |records: &mut dyn Iterator<Item = &Record>| records.map(Record::name).collect::<Vec<_>>().join(", ");
        let mut lines = vec![format!("{}, extended by fogcoil diagnose.", self.name), self.verdict()];
        lines.push(format!("Fitted to: {}.", names(&mut self.fits.iter())));
        if !self.holdouts.is_empty() {
            lines.extend(self.holdouts.iter().map(held_out));
        }
        lines.push(match self.diagnosis.verdict {
            Verdict::Unknown if self.law().is_some() => {
                "Constants fitted beside a law that was composed, in a file of its own (--mechanism); most probable values with 90 % intervals:".into()
            }
            Verdict::None | Verdict::Unknown => "This is the nominal design, unchanged.".into(),
            _ if !self.accepted() => "What was fitted is not accepted: this is the nominal design, unchanged.".into(),
            _ => "Fitted, not measured; most probable values with 90 % intervals:".to_owned(),
        });
        lines
    }

    /// 90 % interval of an unknown of the best candidate, with the doubt about its mechanism's choice in it.
    pub(super) fn interval(&self, posterior: &Posterior) -> [f64; 2] {
        let with_choice = match posterior.place {
            Place::Mechanism(place) => self.diagnosis.parameters.get(place),
            Place::Nominal(_) => None,
        };
        let same = with_choice.into_iter().flatten().find(|estimate| estimate.name == posterior.name);
        same.map_or_else(|| posterior.ci90(), |estimate| estimate.ci90)
    }

    pub(super) fn choice(&self, active: &Active) -> Option<(&str, f64)> {
        let (name, _) = self.gyro.mechanisms()[active.mechanism].choice.as_ref()?;
        Some((name, active.choice?))
    }
}

impl Record {
    /// Its file's name, with the folder: records of many units are called alike.
    pub(super) fn name(&self) -> String {
        let parts: Vec<_> =
            self.fingerprint.file.components().rev().take(2).map(|part| part.as_os_str().to_string_lossy()).collect();
        parts.into_iter().rev().collect::<Vec<_>>().join("/")
    }
}

/// What a record that was held out says of the fit and of the nominal design.
fn held_out(held: &Held) -> String {
    let [fitted, nominal] = [&held.model, &held.nominal].map(|by| significant(by.rmse[RATE_CHANNEL], 3));
    format!(
        "Held out: {}; what was fitted predicts its rate to {fitted} deg/h rms, the nominal design to {nominal}.",
        held.record.name()
    )
}

fn said(posterior: &Posterior, ci90: [f64; 2]) -> String {
    let [low, high] = ci90.map(|end| significant(end, 5));
    let what = match posterior.place {
        Place::Mechanism(_) => "",
        Place::Nominal(Role::Constant) => ", a constant of the design; without a unit it is a factor on the file's own number",
        Place::Nominal(Role::Sensor) => ", of the instruments, not in this file",
        Place::Nominal(Role::ModelError) => ", for the model's own error, not in this file",
    };
    format!("  {} = {} ({low} to {high}){what}", posterior.name, significant(posterior.value(), 5))
}
