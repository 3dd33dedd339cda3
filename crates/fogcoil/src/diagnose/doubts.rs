//! Doubts about an explanation that its probability does not tell.

use diagnosis::{Estimate, Place, Role, Settings, Verdict};

use super::Outcome;
use super::constants::{FAR, MOVED};
use crate::table::significant;
use crate::units::parameter_unit;

/// Fewest and most digits of a constant.
const LEAST_DIGITS: usize = 3;
const MOST_DIGITS: usize = 8;

/// A value and that of the drawing, with the digits that show how far they are apart.
fn apart(value: f64, drawn: f64) -> [String; 2] {
    let size = value.abs().max(drawn.abs());
    let ratio = (size / (value - drawn).abs()).max(1.0);
    let digits = if ratio.is_finite() { 2 + ratio.log10().ceil() as usize } else { LEAST_DIGITS };
    [value, drawn].map(|x| significant(x, digits.clamp(LEAST_DIGITS, MOST_DIGITS)))
}

impl Outcome<'_> {
    /// Sentences on an explanation by mechanisms: parameters of which not even the sign is known, and the constants that would have to move without it.
    pub(super) fn doubts(&self) -> Vec<String> {
        if self.diagnosis.verdict != Verdict::Explained {
            return Vec::new();
        }
        self.of_open_sign().into_iter().chain(self.instead()).collect()
    }

    fn of_open_sign(&self) -> Option<String> {
        // the zero of a temperature is the scale's
        let has_a_sign = |estimate: &Estimate| parameter_unit(&estimate.name) != "degC";
        let is_open = |estimate: &&Estimate| estimate.ci90[0] < 0.0 && estimate.ci90[1] > 0.0 && has_a_sign(estimate);
        let open: Vec<&str> =
            self.diagnosis.parameters.iter().flatten().filter(is_open).map(|estimate| estimate.name.as_str()).collect();
        (!open.is_empty()).then(|| {
            format!(
                "These records leave even the sign of {} open: the value is good for predictions, but it is no measurement.",
                open.join(" and ")
            )
        })
    }

    /// The constants that would have to lie far off the drawing if no mechanism took part, or the one that would lie farthest, unless that is excluded.
    fn instead(&self) -> Option<String> {
        let candidates = &self.diagnosis.candidates;
        let alone = candidates.iter().find(|candidate| candidate.is_constants_alone())?;
        // what is excluded is no other way to read the record
        let most = candidates.iter().map(|candidate| candidate.probability).fold(0.0, f64::max);
        if alone.probability < Settings::default().excluded * most {
            return None;
        }
        let mut moved: Vec<_> =
            alone.fit.posteriors(&self.gyro).into_iter().filter(|p| p.place == Place::Nominal(Role::Constant)).collect();
        moved.sort_by(|a, b| b.u.abs().total_cmp(&a.u.abs()));
        let far = moved.iter().filter(|p| p.u.abs() > FAR).count();
        let said: Vec<String> = moved
            .iter()
            .take(far.max(1))
            .filter(|p| p.u.abs() > MOVED)
            .map(|p| {
                let unit = parameter_unit(&p.name);
                let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
                let [value, drawn] = apart(p.value(), p.prior.value(0.0));
                format!("{} {value}{unit} for {drawn} ({:+.1} standard deviations of its tolerance)", p.name, p.u)
            })
            .collect();
        let would = if said.len() > 1 { "these would be" } else { "the farthest from the drawing would be" };
        (!said.is_empty()).then(|| {
            format!("If nothing but constants differed (probability {:.3}), {would}: {}.", alone.probability, said.join("; "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_change_of_a_large_number_shows() {
        assert_eq!(apart(15.906, 15.84), ["15.906", "15.840"]);
        assert_eq!(apart(0.31, 0.2), ["0.310", "0.200"]);
        assert_eq!(apart(2.0, 2.0), ["2.00", "2.00"]);
    }
}
