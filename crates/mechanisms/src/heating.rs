//! A flange that is heated from some time before a recording on.

use crate::course::{Clock, Course, Series, rows_of};
use coil::{Reduced, Slopes};
use std::sync::OnceLock;

/// Powers of two of a second at which derivatives are worked out; in between they are interpolated in the logarithm.
const NODES: usize = 16;

/// A watt in a flange that is switched on some time before the first row: every mode decays on its own.
#[derive(Debug, Clone)]
pub(crate) struct Heating {
    /// amplitude of every mode in every row, switched on at the first, and its mean rate; the rates of the first row are not used
    course: Course,
    averaging: f64,
    /// from when to when every row was read, after the first row \[s\]
    spans: Vec<[f64; 2]>,
    /// derivatives by every constant where it is switched on 2ⁿ s before the first row, as they were asked for
    nodes: [OnceLock<Vec<Series>>; NODES],
}

impl Heating {
    pub(crate) fn new(model: &Reduced, clock: &Clock, averaging: f64) -> Self {
        let (n, first) = (clock.time.len(), clock.time[0]);
        let mut spans: Vec<[f64; 2]> = clock.spans().into_iter().map(|span| span.map(|n| clock.time[n] - first)).collect();
        spans[0][0] = -averaging;
        let course = Course::new(model, clock, &[vec![0.0; n], vec![1.0; n]], &[0.0, 0.0]);
        Self { course, averaging, spans, nodes: Default::default() }
    }

    /// Response to 1 W that is switched on `before` the first row \[s\].
    pub(crate) fn at(&self, model: &Reduced, before: f64) -> Series {
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
        course.series(model)
    }

    /// Derivatives of that response by every constant, in which `slopes` are those of the heated design, driven by the chamber and by 1 W.
    pub(crate) fn by_constants(&self, slopes: &Slopes, before: f64) -> Vec<Series> {
        let at = before.max(1.0).log2().min((NODES - 1) as f64);
        let low = (at as usize).min(NODES - 2);
        let share = at - low as f64;
        let node = |k: usize| self.nodes[k].get_or_init(|| self.switched_on(slopes, (k as f64).exp2()));
        let between = |(a, b): (&Series, &Series)| {
            let mut series = a.clone();
            series.change(a, -share);
            series.change(b, share);
            series
        };
        node(low).iter().zip(node(low + 1)).map(between).collect()
    }

    fn switched_on(&self, slopes: &Slopes, before: f64) -> Vec<Series> {
        let spans: Vec<[f64; 2]> = self.spans.iter().map(|span| span.map(|t| (t + before).max(0.0))).collect();
        let mut time: Vec<f64> = std::iter::once(0.0).chain(spans.iter().flatten().copied()).collect();
        time.sort_by(f64::total_cmp);
        time.dedup();
        let place = |t: f64| time.partition_point(|instant| *instant < t);
        let spans: Vec<[usize; 2]> = spans.into_iter().map(|span| span.map(place)).collect();
        let courses = slopes.run(&time, &[vec![0.0; time.len()], vec![1.0; time.len()]], &[0.0, 0.0]);
        courses.slopes.iter().map(|slope| rows_of(slope, &time, &spans)).collect()
    }
}
