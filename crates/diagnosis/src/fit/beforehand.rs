//! Prior of a fit's unknowns, before the records are seen.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// The unknowns u are normal with mean 0 and this precision: the identity, but among nuisances that the model knows to go together
/// ([`crate::ForwardModel::precision`]).
#[derive(Debug, Clone)]
pub(crate) struct Beforehand {
    precision: DMatrix<f64>,
}

impl Beforehand {
    /// Unknowns of which any two have the precision `of` them, if they go together. `None` if that is no precision.
    pub(crate) fn new(count: usize, of: impl Fn(usize, usize) -> Option<f64>) -> Option<Self> {
        let independent = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let precision = DMatrix::from_fn(count, count, |i, j| of(i, j).unwrap_or_else(|| independent(i, j)));
        let known = Self { precision };
        known.half_log_det().map(|_| known)
    }

    /// The same where some unknowns, independent of the others, have another precision.
    pub(crate) fn with(&self, places: &[usize], precision: &DMatrix<f64>) -> Self {
        let mut changed = self.clone();
        for (i, a) in places.iter().enumerate() {
            places.iter().enumerate().for_each(|(j, b)| changed.precision[(*a, *b)] = precision[(i, j)]);
        }
        changed
    }

    /// −ln of their density, but for a common constant.
    pub(crate) fn energy(&self, u: &DVector<f64>) -> f64 {
        (&self.precision * u).dot(u) / 2.0
    }

    /// Its gradient.
    pub(crate) fn slope(&self, u: &DVector<f64>) -> DVector<f64> {
        &self.precision * u
    }

    /// ½ ln det of the precision; `None` if that is no precision.
    pub(super) fn half_log_det(&self) -> Option<f64> {
        let factor: Cholesky<f64, Dyn> = Cholesky::new(self.precision.clone())?;
        Some(factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum())
    }

    /// JᵀJ and their precision, the curvature of −ln p where the prediction is nearly linear; columns beyond the unknowns are independent of them,
    /// each with standard deviation 1.
    pub(crate) fn curvature(&self, products: DMatrix<f64>) -> DMatrix<f64> {
        let (mut curvature, own) = (products, self.precision.nrows());
        (own..curvature.ncols()).for_each(|i| curvature[(i, i)] += 1.0);
        curvature.view_mut((0, 0), (own, own)).zip_apply(&self.precision, |c, p| *c += p);
        curvature
    }
}

/// Precision of the rest where some of the unknowns may have any value: their Schur complement. `None` if that of those is no precision.
pub(super) fn without(precision: &DMatrix<f64>, unknowns: &[usize]) -> Option<DMatrix<f64>> {
    if unknowns.is_empty() {
        return Some(precision.clone());
    }
    let beside = precision.select_columns(unknowns);
    let own: Cholesky<f64, Dyn> = Cholesky::new(beside.select_rows(unknowns))?;
    Some(precision - &beside * own.solve(&beside.transpose()))
}
