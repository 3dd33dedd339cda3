//! The response to a watt in a flange, and what constants and tails change of it: it goes with them in its own way, not as the response to the chamber does.

use crate::course::{Clock, Course, Parts, Series, add};
use crate::interpolation::cubic_weights;
use crate::library::Library;
use coil::{Error, Reduced, Side};

/// A watt in a flange that is switched on some time before the first row: every mode decays on its own.
#[derive(Debug, Clone)]
pub(crate) struct Heating {
    /// amplitude of every mode in every row, switched on at the first, and its mean rate; the rates of the first row are not used
    course: Course,
    averaging: f64,
}

impl Heating {
    pub(crate) fn new(model: &Reduced, clock: &Clock, averaging: f64) -> Self {
        let n = clock.time.len();
        Self { course: Course::new(model, clock, &[vec![0.0; n], vec![1.0; n]], &[0.0, 0.0]), averaging }
    }

    /// Response to 1 W that is switched on `before` the first row \[s\].
    pub(crate) fn at(&self, model: &Reduced, before: f64) -> Series {
        self.switched_on(model, before).series(model)
    }

    fn switched_on(&self, model: &Reduced, before: f64) -> Course {
        let mut course = self.course.clone();
        let drives = course.states.ncols() - model.rates().len();
        for (i, rate) in model.rates().iter().enumerate() {
            let (k, decayed) = (drives + i, (-rate * before).exp());
            // the first reading began before its row, but sees nothing from before the heater was on
            let began = course.states[(0, k)] * (-rate * (before - self.averaging).max(0.0)).exp();
            course.states.column_mut(k).scale_mut(decayed);
            course.rates.column_mut(k).scale_mut(decayed);
            course.rates[(0, k)] = if self.averaging > 0.0 { (course.states[(0, k)] - began) / self.averaging } else { 0.0 };
        }
        course
    }
}

/// Times before the first row for which derivatives are worked out: at none, and at others up to the earliest \[s\], three spreads of its prior from the
/// median, whatever the record's interval; what was switched on before that is taken as then.
const TIMES: usize = 9;
const EARLIEST_S: f64 = 5400.0;
/// Intervals within which the time matters for the first readings.
const WITHIN: f64 = 0.3;

/// Derivatives of the response to a watt in a flange, by the time at which it is switched on.
#[derive(Debug, Clone)]
pub(crate) struct HeaterSlopes {
    /// a time of this size is early \[s\]
    scale: f64,
    /// logarithms of 1 + times/scale
    nodes: Vec<f64>,
    /// of each the change per relative change of every constant by 1, and the parts per metre of the CW tail
    slopes: Vec<(Vec<Series>, Parts)>,
}

impl HeaterSlopes {
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub(crate) fn new(library: &Library, side: Side, model: &Reduced, clock: &Clock, heating: &Heating) -> Result<Self, Error> {
        let (slopes, tail) = library.heater_slopes(side)?;
        let interval = clock.rows.get(1).map_or(1.0, |second| clock.time[*second] - clock.time[0]);
        let scale = WITHIN * interval;
        let last = (1.0 + EARLIEST_S / scale).ln();
        let nodes: Vec<f64> = (0..TIMES).map(|k| last * k as f64 / (TIMES - 1) as f64).collect();
        let values = library.values();
        let at = |node: &f64| {
            let before = scale * (node.exp() - 1.0);
            let mut of_each = clock.slopes_of_a_step(&slopes, before, heating.averaging);
            of_each.iter_mut().zip(&values).for_each(|(slope, value)| slope.scale(*value));
            (of_each, heating.switched_on(model, before).parts(&tail))
        };
        Ok(Self { scale, slopes: nodes.iter().map(at).collect(), nodes })
    }

    /// Change per relative change of every constant by 1, and parts per metre of the CW tail, of a watt that is switched on `before` the first row \[s\].
    pub(crate) fn at(&self, before: f64) -> (Vec<Series>, Parts) {
        let last = self.nodes[self.nodes.len() - 1];
        let weights = cubic_weights(&self.nodes, (1.0 + before.max(0.0) / self.scale).ln().min(last));
        let (of_first, tail) = &self.slopes[0];
        let mut sum: (Vec<Series>, Parts) =
            (of_first.iter().map(Series::nothing).collect(), tail.each_ref().map(|part| vec![0.0; part.len()]));
        for (weight, (slopes, tail)) in weights.iter().zip(&self.slopes).filter(|(weight, _)| **weight != 0.0) {
            sum.0.iter_mut().zip(slopes).for_each(|(sum, slope)| sum.change(slope, *weight));
            sum.1.iter_mut().zip(tail).for_each(|(sum, part)| add(sum, part, *weight));
        }
        sum
    }
}
