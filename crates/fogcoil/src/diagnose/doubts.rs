//! Doubts about an explanation that its probability does not tell.

use diagnosis::{Estimate, Place, Role, Verdict};

use super::Outcome;
use super::constants::FAR;
use crate::table::significant;
use crate::units::parameter_unit;

impl Outcome<'_> {
    /// Sentences on an explanation by mechanisms: parameters of which not even the sign is known, and the constants that would have to move without it.
    pub(super) fn doubts(&self) -> Vec<String> {
        if self.diagnosis.verdict != Verdict::Explained {
            return Vec::new();
        }
        self.of_open_sign().into_iter().chain(self.instead()).collect()
    }

    fn of_open_sign(&self) -> Option<String> {
        let is_open = |estimate: &&Estimate| estimate.ci90[0] < 0.0 && estimate.ci90[1] > 0.0;
        let open: Vec<&str> =
            self.diagnosis.parameters.iter().flatten().filter(is_open).map(|estimate| estimate.name.as_str()).collect();
        (!open.is_empty()).then(|| {
            format!(
                "These records leave even the sign of {} open: the value is good for predictions, but it is no measurement.",
                open.join(" and ")
            )
        })
    }

    /// The constants that would have to lie far off the drawing if no mechanism took part.
    fn instead(&self) -> Option<String> {
        let alone = self.diagnosis.candidates.iter().find(|candidate| candidate.is_constants_alone())?;
        let all = alone.fit.posteriors(&self.gyro);
        let far = all.iter().filter(|p| p.place == Place::Nominal(Role::Constant) && p.u.abs() > FAR);
        let said: Vec<String> = far
            .map(|p| {
                let unit = parameter_unit(&p.name);
                let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
                format!("{} {}{unit} ({:+.1} standard deviations of its tolerance)", p.name, significant(p.value(), 3), p.u)
            })
            .collect();
        (!said.is_empty()).then(|| format!("If nothing but constants differed, these would be: {}.", said.join("; ")))
    }
}
