//! A ∂n/∂T that is curved, which no reduced model has.

use crate::course::{Course, GAP};
use crate::library::Library;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::Error;
use nalgebra::{DMatrix, DVector};

/// Phase of a curved ∂n/∂T as a quadratic form of drives and modes: per curvature \[deg/h s K²\].
pub(crate) struct Curvature {
    form: DMatrix<f64>,
    linear: DVector<f64>,
    /// where ∂n/∂T has its nominal value \[°C\]
    reference: f64,
}

impl Curvature {
    pub(crate) fn new(library: &Library, reference: f64) -> Result<Self, Error> {
        let design = library.design();
        let winding = winding::wind(&design.winding)?;
        let (form, linear) = library.fields.moments(&winding);
        let scale = DEG_PER_H_PER_RAD_PER_S * design.optics.refractive_index / (winding.length() * design.optics.sagnac_diameter);
        Ok(Self { form: form * scale, linear: linear * scale, reference })
    }

    /// Its mean rate over each reading.
    pub(crate) fn rates(&self, course: &Course, time: &[f64], averaging: f64) -> Vec<f64> {
        let Self { form, linear, reference } = self;
        let states = &course.states;
        let phases: Vec<f64> = (0..states.nrows())
            .map(|n| {
                let s = states.row(n).transpose();
                (&s.transpose() * form * &s)[(0, 0)] / 2.0 - reference * linear.dot(&s)
            })
            .collect();
        // d/dt of the phase at the middle of a row's span: exact for the mean where rows are evenly spaced
        let rates = &course.rates;
        (0..states.nrows())
            .map(|n| {
                let dt = if n > 0 { time[n] - time[n - 1] } else { 0.0 };
                let is_after_gap = averaging > 0.0 && dt > GAP * averaging;
                if n == 0 || is_after_gap {
                    // after a gap: the mean over the span from the state at its end
                    let (s, r) = (states.row(n).transpose(), rates.row(n).transpose());
                    let middle = s - &r * (averaging / 2.0);
                    (middle.transpose() * form * &r)[(0, 0)] - reference * linear.dot(&r)
                } else {
                    (phases[n] - phases[n - 1]) / dt
                }
            })
            .collect()
    }
}
