//! Summary of a sweep's rows.

use super::indices::Indices;
use super::outputs::TOTAL;
use super::plan::Plan;
use super::points::Sampling;
use super::row::Row;
use crate::Error;
use crate::variants::{Factor, Kind, Value, Varied};

/// Largest magnitude that is nothing but rounding, as the thermal phase of a steady ramp.
const ROUNDING: f64 = 1e-12;

/// Spread of a computed number over the designs.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Its name.
    pub name: &'static str,
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub sd: f64,
    /// Least value, 5, 50 and 95 % quantiles, largest value.
    pub quantiles: [f64; 5],
}

/// The design whose sensitivity is smallest.
#[derive(Debug, Clone, PartialEq)]
pub struct Smallest {
    /// Its point.
    pub point: usize,
    /// Its sensitivity \[(deg/h)/(degC/min)\].
    pub total: f64,
    /// What the plan states of it: key and value, in the unit of the key.
    pub values: Vec<(String, Value)>,
}

impl Smallest {
    /// Of the rows of a plan whose keys are all for a designer to choose: what chance draws is no design to build.
    fn of(plan: &Plan, place: usize, rows: &[Row]) -> Option<Self> {
        let is_chosen = |factor: &Factor| match &factor.kind {
            Kind::Key(varied) => !matches!(varied, Varied::Tolerance | Varied::Normal(..)),
            _ => false,
        };
        let factors = &plan.variants.factors;
        let totals = rows.iter().enumerate().filter_map(|(point, row)| Some((point, row.outputs[place]?)));
        let (point, total) = totals.min_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
        let values: Vec<_> = factors
            .iter()
            .zip(&rows[point].values)
            .filter_map(|(factor, value)| Some((factor.key.clone(), value.clone()?)))
            .collect();
        (!values.is_empty() && factors.iter().all(is_chosen)).then_some(Self { point, total, values })
    }

    /// Its point and values, in words.
    pub(super) fn words(&self) -> String {
        let values = self.values.iter().map(|(key, value)| format!("{key} {}", value.shown())).collect::<Vec<_>>().join(", ");
        format!("point {}: {values}", self.point)
    }
}

/// Summary of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Designs that were computed.
    pub designs: usize,
    /// Points of which there is no design, and the first reason.
    pub failed: Option<(usize, String)>,
    /// Every number that is computed.
    pub spreads: Vec<Spread>,
    /// The design with the smallest |S|, of a plan that states a key.
    pub smallest: Option<Smallest>,
    /// Standard deviation of the sensitivity by its tolerances to first order, where the tolerances are all that varies.
    pub linear_sd: Option<f64>,
    /// Numerical error of the drawing's sensitivity, where sensitivities are computed \[(deg/h)/(degC/min)\].
    pub error: Option<f64>,
    /// Groups from which the spread of |S| comes.
    pub indices: Option<Indices>,
}

impl Summary {
    /// Summary of the rows of a plan, all of them and in order.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the drawing cannot be modelled.
    pub fn of(plan: &Plan, rows: &[Row]) -> Result<Self, Error> {
        let names = plan.names();
        let spread = |(n, name): (usize, &&'static str)| Spread::of(name, rows.iter().filter_map(|row| row.outputs[n]).collect());
        let spreads: Vec<Spread> = names.iter().enumerate().filter_map(spread).collect();
        let failed = rows.iter().filter_map(|row| row.problem.as_ref());
        let failed = failed.clone().next().map(|first| (failed.count(), first.clone()));
        let total = names.iter().position(|name| *name == TOTAL);
        let smallest = total.and_then(|place| Smallest::of(plan, place, rows));
        let case = &plan.variants.case;
        let linear_sd = match total.filter(|_| plan.is_band) {
            Some(_) => Some(case.sensitivity_band()?.sd),
            None => None,
        };
        let error = total.map(|_| case.steady_sensitivity()).transpose()?.map(|steady| steady.error_estimate);
        let indices = total.filter(|_| matches!(plan.sampling, Sampling::Indices(_))).and_then(|n| {
            let magnitudes: Vec<Option<f64>> = rows.iter().map(|row| row.outputs[n].map(f64::abs)).collect();
            Indices::of(&plan.groups, &magnitudes, plan.seed)
        });
        let designs = rows.iter().filter(|row| row.problem.is_none()).count();
        Ok(Self { designs, failed, spreads, smallest, linear_sd, error, indices })
    }

    /// Spread of the sensitivity.
    pub fn total(&self) -> Option<&Spread> {
        self.spreads.iter().find(|spread| spread.name == TOTAL)
    }
}

impl Spread {
    pub(crate) fn of(name: &'static str, mut values: Vec<f64>) -> Option<Self> {
        values.iter_mut().filter(|value| value.abs() < ROUNDING).for_each(|value| *value = 0.0);
        values.sort_by(f64::total_cmp);
        let (count, last) = (values.len() as f64, values.len().checked_sub(1)?);
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let sd = (squares / (count - 1.0).max(1.0)).sqrt();
        // between neighbours linearly, as numpy does
        let at = |share: f64| {
            let place = share * last as f64;
            let (low, high) = (values[place.floor() as usize], values[place.ceil() as usize]);
            low + (place - place.floor()) * (high - low)
        };
        Some(Self { name, mean, sd, quantiles: [0.0, 0.05, 0.5, 0.95, 1.0].map(at) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_of_five_numbers() {
        let spread = Spread::of("x", vec![5.0, 1.0, 2.0, 4.0, 3.0]).unwrap();
        assert_eq!((spread.mean, spread.sd), (3.0, 2.5_f64.sqrt()));
        assert_eq!(spread.quantiles, [1.0, 1.2, 3.0, 4.8, 5.0]);
        assert_eq!(Spread::of("x", Vec::new()), None);
        assert_eq!(Spread::of("x", vec![2.0]).map(|one| one.sd), Some(0.0));
    }
}
