//! The evidence of a hypothesis by Laplace's method.
//!
//! p(data) = ∫ p(data | u) φ(u) du, with the normal density φ of the unknowns beforehand, is taken for the integral of the normal density that has its maximum and curvature. With the unknowns û at the
//! maximum, their precision P beforehand and their covariance C = (JᵀJ + P)⁻¹,
//!
//! ln p(data) ≈ −½ ‖r(û)‖² − ½ ûᵀPû + ½ ln det P + ½ ln det C − ½ ln det Σ + ln p(noise),
//!
//! up to −n/2 ln 2π, which all fits to the same rows share. Exact where the prediction is linear in u (Tierney and Kadane 1986; MacKay 2003, ch. 27).

use super::derivatives::Derivatives;
use super::fitter::Fit;
use super::objective::{Objective, Point};
use crate::Error;
use nalgebra::{Cholesky, Dyn};

impl Objective<'_> {
    /// The fit at a minimum with its derivatives.
    pub(super) fn concluded(&self, (at, derivatives): (Point, Derivatives)) -> Result<Fit, Error> {
        let normal: Cholesky<f64, Dyn> =
            Cholesky::new(self.beforehand.curvature(derivatives.products.clone())).ok_or(Error::NotFinite)?;
        let half_log_det: f64 = normal.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        let before = self.beforehand.half_log_det().ok_or(Error::NotFinite)?;
        let log_evidence = -at.value - half_log_det + before - self.noise.half_log_det() + self.noise.log_prior;
        if !log_evidence.is_finite() {
            return Err(Error::NotFinite);
        }
        let (nuisances, active) = self.at(&at.u);
        Ok(Fit {
            hypothesis: self.hypothesis.clone(),
            log_evidence,
            nuisances,
            active,
            offsets: self.offsets(&at.u),
            residuals: self.residuals(&at.u, &at.responses),
            layout: self.layout.clone(),
            beforehand: self.beforehand.clone(),
            covariance: normal.inverse(),
            noise: self.noise.clone(),
            whitened: at.whitened,
            u: at.u,
            derivatives,
        })
    }
}
