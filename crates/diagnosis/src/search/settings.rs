//! Prior probabilities of hypotheses, before any recording is seen.

use crate::fit::Hypothesis;
use crate::{ForwardModel, Role, Structure};

/// Prior probabilities, and the limit of exclusion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Prior probability of the nominal model.
    pub none: f64,
    /// Prior probability of constants that must be re-estimated.
    pub recalibrate: f64,
    /// Prior probability of one mechanism, all mechanisms together.
    pub single: f64,
    /// Prior probability of two mechanisms, all pairs together.
    pub pair: f64,
    /// Prior probability of something that has no name in the library: a mechanism without one, a structure or a law.
    pub unknown: f64,
    /// Smallest probability of a mechanism, relative to the best, at which it is not excluded.
    pub excluded: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { none: 0.20, recalibrate: 0.20, single: 0.41, pair: 0.07, unknown: 0.12, excluded: 0.03 }
    }
}

/// Share of the unknown that each of its kinds has: mechanisms without a name, structures, and laws that the library does not hold.
const KIND: f64 = 1.0 / 3.0;
/// Most terms of such a law.
const NUMBERS: f64 = 2.0;

impl Settings {
    /// ln of the prior probability that a certain number of laws that the library does not hold are at work beside a hypothesis: the design's
    /// constants, with mechanisms or without. The choice among the laws is not in it.
    pub fn log_unlisted(&self, model: &dyn ForwardModel, beside: &Hypothesis) -> f64 {
        let mechanisms = if beside.mechanisms.is_empty() { 0.0 } else { self.log_prior(model, beside, false) };
        mechanisms + (self.unknown * KIND / NUMBERS).ln()
    }

    /// ln of the prior probability of a hypothesis, beside a structure or alone.
    pub(super) fn log_prior(&self, model: &dyn ForwardModel, hypothesis: &Hypothesis, rival: bool) -> f64 {
        let library = model.mechanisms();
        // among those of its kind
        let share = |&(m, _): &(usize, Option<f64>)| {
            let all: f64 = library.iter().filter(|other| other.named == library[m].named).map(|m| m.weight).sum();
            let choices = library[m].choice.as_ref().map_or(1, |(_, values)| values.len());
            library[m].weight / all / choices as f64
        };
        // without constants the two are one
        let constants = model.nuisances().iter().any(|n| n.role == Role::Constant);
        let none = if constants { self.none } else { self.none + self.recalibrate };
        let base = match hypothesis.mechanisms.as_slice() {
            [] if hypothesis.constants_free => self.recalibrate,
            [] => none,
            [one] if library[one.0].named => self.single * share(one),
            [one] => self.unknown * KIND * share(one),
            // each pair is met in two orders
            many => self.pair * 2.0 * many.iter().map(share).product::<f64>(),
        };
        let structures = (Structure::ALL.len() * model.channels().len()) as f64;
        (base * if rival { self.unknown * KIND / structures } else { 1.0 }).ln()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::library;
    use crate::{Channel, NoisePrior, Nuisance};

    const SETTINGS: Settings = Settings { none: 0.3, recalibrate: 0.1, single: 0.4, pair: 0.05, unknown: 0.15, excluded: 0.03 };

    /// Prior probabilities of the nominal model and of the re-estimated one, with numbers of these roles.
    fn of_the_design(roles: &[Role]) -> [f64; 2] {
        let mut model = library(&[true]);
        model.1 = roles.iter().map(|role| Nuisance::normal("number", 0.0, 1.0, *role)).collect();
        [Hypothesis::NOMINAL, Hypothesis::RECALIBRATED].map(|of| SETTINGS.log_prior(&model, &of, false).exp())
    }

    #[test]
    fn constants_that_there_are_have_a_probability_of_their_own() {
        for roles in [&[Role::Constant][..], &[Role::Sensor, Role::Constant]] {
            let found = of_the_design(roles);
            assert!(found.iter().zip([0.3, 0.1]).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        }
        // without, the nominal model has it
        for roles in [&[][..], &[Role::Sensor, Role::ModelError]] {
            assert!((of_the_design(roles)[0] - 0.4).abs() < 1e-12);
        }
    }

    #[test]
    fn a_third_of_the_unknown_is_shared_by_all_structures_in_all_channels() {
        let noise = NoisePrior::new((1.0, 1.0), (0.1, 1.0), (1000.0, 1.0), (0.1, 1.0));
        let channel = Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise };
        for channels in [1, 2, 3] {
            let mut model = library(&[true]);
            model.2 = vec![channel.clone(); channels];
            let of = |rival: bool| SETTINGS.log_prior(&model, &Hypothesis::NOMINAL, rival).exp();
            let together = of(true) / of(false) * (Structure::ALL.len() * channels) as f64;
            assert!((together - 0.05).abs() < 1e-12, "{channels}: {together}");
        }
    }
}
