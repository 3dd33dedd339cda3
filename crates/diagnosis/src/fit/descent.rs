//! Minimisation of the objective by Levenberg's (1944) and Marquardt's (1963) method on whitened residuals and normal priors.

use super::derivatives::Derivatives;
use super::objective::{Objective, Point};
use crate::Error;
use nalgebra::{Cholesky, DVector, Dyn};

/// Largest number of steps.
const MOST_STEPS: usize = 16;
/// Change of ln p at which a fit has settled: far below what odds can tell.
const SETTLED: f64 = 5e-3;
/// Share of that below which the promised gain of a step is not worth its computation.
const NOTHING: f64 = 1e-5;
/// Largest step of a mechanism's unknown, and of any beside a kink [u]: half of a prior's reach.
const STRIDE: f64 = 2.0;
/// First damping, least damping, and damping at which no step is left; relative to the diagonal.
const DAMPING: [f64; 3] = [1e-3, 1e-9, 1e8];

impl Objective<'_> {
    /// The nearest minimum below a point, with the derivatives there or a negligible step before.
    pub(super) fn descend(&self, from: Point) -> Result<(Point, Derivatives), Error> {
        let mut at = from;
        let mut damping = DAMPING[0];
        let mut derivatives = self.derivatives(&at)?;
        let (mut is_own, mut undamped) = (true, false);
        for _ in 0..MOST_STEPS {
            let before = at.value;
            at = self.step(at, &derivatives, &mut damping)?;
            let mut settled = before - at.value < SETTLED;
            // what goes together moves little under damping, however far it has to go
            if settled && !undamped && self.left(&at, &derivatives)? >= SETTLED {
                (damping, undamped, settled) = (DAMPING[1], true, false);
            }
            // derivatives that hardly change are found anew where they seem to lead no further
            if settled && (is_own || !self.is_exact()) {
                break;
            }
            is_own = settled;
            // with derivatives of its own it sets out afresh
            if is_own {
                (damping, undamped) = (DAMPING[0], false);
            }
            self.found_anew(&at, is_own, &mut derivatives)?;
        }
        if !is_own {
            self.found_anew(&at, true, &mut derivatives)?;
        }
        Ok((at, derivatives))
    }

    /// Derivatives at another point: all of them where they are its own, else those that change.
    fn found_anew(&self, at: &Point, all: bool, derivatives: &mut Derivatives) -> Result<(), Error> {
        if all && self.is_exact() {
            *derivatives = self.derivatives(at)?;
            return Ok(());
        }
        self.renew(at, derivatives)
    }

    /// Fall of −ln p on the way to its minimum if the prediction were linear.
    fn left(&self, at: &Point, derivatives: &Derivatives) -> Result<f64, Error> {
        let gradient = self.gradient(at, derivatives);
        let normal: Cholesky<f64, Dyn> =
            Cholesky::new(self.beforehand.curvature(derivatives.products.clone())).ok_or(Error::NotFinite)?;
        Ok(gradient.dot(&normal.solve(&gradient)) / 2.0)
    }

    /// Gradient of ln p.
    pub(super) fn gradient(&self, at: &Point, derivatives: &Derivatives) -> DVector<f64> {
        derivatives.jacobian.tr_mul(&at.whitened) - self.beforehand.slope(&at.u)
    }

    /// One step down with the least damping that leads down; the same point if no step leads down or promises a gain.
    fn step(&self, at: Point, derivatives: &Derivatives, damping: &mut f64) -> Result<Point, Error> {
        let normal = self.beforehand.curvature(derivatives.products.clone());
        let gradient = self.gradient(&at, derivatives);
        let [_, least, most] = DAMPING;
        while *damping < most {
            let mut damped = normal.clone();
            for i in 0..self.layout.len() {
                damped[(i, i)] += *damping * normal[(i, i)];
            }
            let factor: Cholesky<f64, Dyn> = Cholesky::new(damped).ok_or(Error::NotFinite)?;
            let mut step = factor.solve(&gradient);
            self.shorten(&mut step, |i| self.layout[i].is_mechanism());
            if gradient.dot(&step) - (&normal * &step).dot(&step) / 2.0 < NOTHING * SETTLED {
                break;
            }
            let tried = self.point(&at.u + step)?;
            if tried.value < at.value {
                *damping = (*damping / 10.0).max(least);
                return Ok(tried);
            }
            *damping *= 10.0;
        }
        Ok(at)
    }

    /// Keeps a step of some unknowns within a stride.
    pub(super) fn shorten(&self, step: &mut DVector<f64>, which: impl Fn(usize) -> bool) {
        (0..step.len()).filter(|i| which(*i)).for_each(|i| step[i] = step[i].clamp(-STRIDE, STRIDE));
    }
}
