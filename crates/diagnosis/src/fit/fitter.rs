//! The quantities to fit, and the result of a fit.

use super::beforehand::{Beforehand, without};
use super::checked;
use super::derivatives::Derivatives;
use super::hypothesis::Hypothesis;
use super::unknowns::{Layout, Unknown, expected};
use crate::noise::Noise;
use crate::{Active, Channel, Error, ForwardModel, Observation, Role};
use nalgebra::{DMatrix, DVector};

/// A hypothesis at its most probable parameters.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The fitted hypothesis.
    pub hypothesis: Hypothesis,
    /// ln of the marginal likelihood (Laplace), up to a constant that all fits to the same records share.
    pub log_evidence: f64,
    /// The nominal model's uncertain numbers, all of them, in every record.
    pub nuisances: Vec<Vec<f64>>,
    /// Mechanisms at work.
    pub active: Vec<Active>,
    /// Offset of every channel of every record.
    pub offsets: Vec<Vec<f64>>,
    /// Residual `[record][channel][row]`, NaN where nothing was recorded.
    pub residuals: Vec<Vec<Vec<f64>>>,
    pub(crate) u: DVector<f64>,
    pub(crate) layout: Layout,
    pub(crate) beforehand: Beforehand,
    pub(crate) covariance: DMatrix<f64>,
    pub(crate) noise: Noise,
    pub(crate) whitened: DVector<f64>,
    pub(crate) derivatives: Derivatives,
}

impl Fit {
    /// Noise of a channel of a record that was fitted.
    pub fn noise_model(&self, record: usize, channel: usize) -> &recording::noise::NoiseModel {
        self.noise.model(record, channel)
    }

    /// Whitened derivatives by every unknown.
    pub(crate) fn jacobian(&self) -> &DMatrix<f64> {
        &self.derivatives.jacobian
    }

    /// −ln p of records and unknowns, but for a constant that all fits under the same noise share.
    pub(crate) fn value(&self) -> f64 {
        self.whitened.norm_squared() / 2.0 + self.beforehand.energy(&self.u)
    }

    /// The same fit where its unknowns are as they are expected beforehand.
    pub(crate) fn as_drawn(&self, model: &dyn ForwardModel) -> Self {
        let (drawn, u) = (expected(model.nuisances()), DVector::zeros(self.u.len()));
        Self { nuisances: vec![drawn; self.nuisances.len()], u, ..self.clone() }
    }

    /// The likelier of two; of equals the first.
    pub(crate) fn better(first: Option<Self>, second: Self) -> Self {
        first.filter(|first| second.log_evidence <= first.log_evidence).unwrap_or(second)
    }
}

/// A model to be fitted to observations of some of its records.
pub(crate) struct Fitter<'a> {
    pub(crate) model: &'a dyn ForwardModel,
    pub(crate) observations: &'a [Observation],
    /// numbers of the records in the model
    pub(crate) records: &'a [usize],
    /// offset of every channel of every record
    offsets: Vec<Vec<Offset>>,
}

/// Prior of an offset: a normal distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Offset {
    pub(crate) mean: f64,
    pub(crate) sd: f64,
}

/// Standard deviation, in those of the recorded channel or of its noise where it stands still, that stands for an infinite one: a record cannot tell the
/// two apart.
const ANYTHING: f64 = 10.0;

impl Offset {
    /// The prior of a channel's offset, from the `recorded` and the `predicted` values.
    pub(crate) fn of(channel: &Channel, recorded: &[f64], predicted: &[f64]) -> Self {
        let (mean, sd) = channel.offset;
        if sd.is_finite() {
            return Self { mean, sd };
        }
        let moments = |values: &mut dyn Iterator<Item = f64>| {
            let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0_f64);
            for value in values.filter(|v| v.is_finite()) {
                (sum, squares, count) = (sum + value, squares + value * value, count + 1.0);
            }
            let mean = sum / count.max(1.0);
            (mean, (squares / count.max(1.0) - mean * mean).max(0.0).sqrt())
        };
        let (mean, _) = moments(&mut recorded.iter().zip(predicted).map(|(y, p)| y - p));
        // distances from one of them: exact where all are alike, and where they differ little for their size
        let first = recorded.iter().copied().find(|y| y.is_finite()).unwrap_or_default();
        let (_, spread) = moments(&mut recorded.iter().map(|y| y - first));
        // a channel that stands still has an offset all the same
        let sd = ANYTHING * if spread > 0.0 { spread } else { channel.noise.white.0 };
        Self { mean, sd }
    }
}

impl<'a> Fitter<'a> {
    /// # Errors
    /// [`Error::Data`] if there is no record, or one that does not fit the model; [`Error::Definition`] if the model contradicts itself;
    /// [`Error::Model`] if it cannot respond.
    pub(crate) fn new(model: &'a dyn ForwardModel, records: &'a [usize], observations: &'a [Observation]) -> Result<Self, Error> {
        if records.is_empty() || records.len() != observations.len() {
            let (found, of) = (observations.len(), records.len());
            return Err(Error::Data(format!("{found} observations of {of} records; give one of each, and at least one")));
        }
        checked::definition(model)?;
        let middle = expected(model.nuisances());
        let of = |(record, observed): (&usize, &Observation)| -> Result<Vec<Offset>, Error> {
            let rows = observed.time.len();
            checked::observed(model, *record, observed)?;
            let predicted = checked::responded(model, *record, rows, &middle, &[])?;
            checked::finite(model, *record, &predicted)?;
            let channels = model.channels().iter().zip(&observed.channels).zip(&predicted);
            Ok(channels.map(|((channel, recorded), predicted)| Offset::of(channel, recorded, predicted)).collect())
        };
        let offsets = records.iter().zip(observations).map(of).collect::<Result<_, _>>()?;
        Ok(Self { model, observations, records, offsets })
    }

    pub(crate) fn offset(&self, record: usize, channel: usize) -> Offset {
        self.offsets[record][channel]
    }

    /// The unknowns of a hypothesis: nuisances that are free and not stood for by a mechanism, mechanisms' parameters, offsets.
    pub(super) fn layout(&self, hypothesis: &Hypothesis) -> Layout {
        let taken = self.taken(hypothesis);
        let free = |number: usize, role: Role| (role != Role::Constant || hypothesis.constants_free) && !taken.contains(&number);
        let mut layout = Layout::new();
        for (number, nuisance) in self.model.nuisances().iter().enumerate().filter(|(n, nuisance)| free(*n, nuisance.role)) {
            if nuisance.local {
                layout.extend((0..self.observations.len()).map(|r| Unknown::Nuisance { number, record: Some(r) }));
            } else {
                layout.push(Unknown::Nuisance { number, record: None });
            }
        }
        for (place, (mechanism, _)) in hypothesis.mechanisms.iter().enumerate() {
            let count = self.model.mechanisms()[*mechanism].parameters.len();
            layout.extend((0..count).map(|parameter| Unknown::Mechanism { place, parameter }));
        }
        for record in 0..self.observations.len() {
            layout.extend((0..self.model.channels().len()).map(|channel| Unknown::Offset { record, channel }));
        }
        layout
    }

    /// The nuisances that a hypothesis' mechanisms stand for.
    fn taken(&self, hypothesis: &Hypothesis) -> Vec<usize> {
        hypothesis.mechanisms.iter().filter_map(|(m, _)| self.model.stands_for(*m)).collect()
    }

    /// Prior of a hypothesis' unknowns; `None` if the model's precision is not that of a density. A constant that is not free is known, one that a
    /// mechanism stands for may have any value: the others are as the model says of them alone.
    pub(super) fn beforehand(&self, hypothesis: &Hypothesis, layout: &Layout) -> Option<Beforehand> {
        let shared = |i: usize| match layout[i] {
            Unknown::Nuisance { number, record: None } => Some(number),
            _ => None,
        };
        let precision = match self.model.precision() {
            Some(precision) => Some(without(precision, &self.taken(hypothesis))?),
            None => None,
        };
        Beforehand::new(layout.len(), |i, j| Some(precision.as_ref()?[(shared(i)?, shared(j)?)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::candidate;
    use crate::{NoisePrior, Nuisance, Omission, State};

    /// What is expected of an offset that may be anything, beside white noise of a half.
    fn of_any(recorded: &[f64], predicted: &[f64]) -> [f64; 2] {
        let noise = NoisePrior::new((0.5, 1.0), (0.1, 1.0), (1000.0, 1.0), (0.1, 1.0));
        let channel = Channel { name: "y".into(), unit: "1".into(), offset: (0.0, f64::INFINITY), averaging: 0.0, noise };
        let Offset { mean, sd } = Offset::of(&channel, recorded, predicted);
        [mean, sd]
    }

    #[test]
    fn exact_an_offset_that_may_be_anything_is_as_wide_as_ten_spreads_of_the_record() {
        // rows of 6 ± 2, the first one not recorded; what is predicted moves the middle alone
        let recorded = [f64::NAN, 8.0, 4.0];
        for (predicted, mean) in [([7.0, 3.0, 3.0], 3.0), ([0.0, 1.0, 9.0], 1.0), ([0.0; 3], 6.0)] {
            assert_eq!(of_any(&recorded, &predicted), [mean, 20.0]);
        }
        // about 0, far from 0 and where that is predicted
        assert_eq!(of_any(&[-2.0, 2.0], &[0.0; 2]), [0.0, 20.0]);
        assert_eq!(of_any(&[1e9, 1e9 + 4.0], &[0.0; 2]), [1e9 + 2.0, 20.0]);
        assert_eq!(of_any(&[1e9, 1e9 + 4.0], &[1e9; 2]), [2.0, 20.0]);
    }

    #[test]
    fn exact_the_offset_of_a_channel_that_stands_still_is_as_wide_as_ten_times_its_noise() {
        for still in [0.0, 0.1, 25.3, -1e9] {
            let [_, sd] = of_any(&[still; 7], &[20.0, 20.1, 20.2, 20.3, 20.4, 20.5, 20.6]);
            assert_eq!(sd, 5.0, "{still}");
        }
    }

    struct Drawn([Nuisance; 2]);

    impl ForwardModel for Drawn {
        fn channels(&self) -> &[Channel] {
            &[]
        }
        fn nuisances(&self) -> &[Nuisance] {
            &self.0
        }
        fn mechanisms(&self) -> &[Omission] {
            &[]
        }
        fn respond(&self, _: usize, _: &[f64], _: &[Active]) -> Result<Vec<Vec<f64>>, crate::Failure> {
            Ok(Vec::new())
        }
        fn state(&self, _: usize) -> &State {
            const { &State { level: Vec::new(), rate: Vec::new() } }
        }
    }

    #[test]
    fn a_fit_as_drawn_has_every_constant_in_every_record_where_the_design_has_it() {
        let constant = |mean: f64| Nuisance::normal("constant", mean, 0.1, Role::Constant);
        let strayed = Fit {
            nuisances: vec![vec![3.2, -5.1], vec![3.3, -5.1]],
            u: DVector::from_column_slice(&[2.0, -1.0, 3.0]),
            log_evidence: -7.0,
            ..candidate(&[4], 1.0).fit
        };
        let drawn = strayed.as_drawn(&Drawn([3.0, -5.0].map(constant)));
        assert_eq!((drawn.nuisances, drawn.u), (vec![vec![3.0, -5.0]; 2], DVector::zeros(3)));
        // all else stays
        assert_eq!((drawn.hypothesis, drawn.log_evidence), (strayed.hypothesis, -7.0));
    }
}
