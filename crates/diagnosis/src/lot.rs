//! The constants that the units of a lot have in common.
//!
//! A constant of unit k is θₖ = ℓ + δₖ in standard deviations of its tolerance: the lot's part ℓ ~ N(0, S) and the unit's own δₖ ~ N(0, D),
//! with S + D = I. The records of a unit say of θₖ what a normal density says, with the precision Lₖ = C⁻¹ − I and the information
//! hₖ = C⁻¹ m, where m and C are mean and covariance of the constants in a fit under the prior N(0, I). Without the unit's own part they say of ℓ
//!
//! Λₖ = (I + Lₖ D)⁻¹ Lₖ, ηₖ = (I + Lₖ D)⁻¹ hₖ,
//!
//! and ℓ has the precision Λ = S⁻¹ + Σ Λₖ and the mean Λ⁻¹ Σ ηₖ: an empirical Bayes model of two levels (Gelman et al. 2013, ch. 5), exact for
//! normal densities. The constants of a further unit have that mean and the covariance Λ⁻¹ + D.

use crate::fit::{Fit, Unknown, checked};
use crate::{Active, Error, ForwardModel};
use nalgebra::{DMatrix, DVector};

/// Information in a unit's records on some constants, in standard deviations of their tolerances.
#[derive(Debug, Clone, PartialEq)]
pub struct Said {
    precision: DMatrix<f64>,
    information: DVector<f64>,
}

/// Mean and covariance of some constants, in standard deviations of their tolerances.
#[derive(Debug, Clone, PartialEq)]
pub struct Believed {
    /// Mean.
    pub mean: DVector<f64>,
    /// Covariance.
    pub covariance: DMatrix<f64>,
}

/// A lot as some of its units show it.
#[derive(Debug, Clone, PartialEq)]
pub struct Lot {
    /// The part in common.
    pub common: Believed,
    /// Each unit's constants, by its own records and by the lot as the others show it.
    pub units: Vec<Believed>,
    /// The constants of a further unit.
    pub further: Believed,
}

impl Said {
    /// Information on constants that have this mean and covariance by the records and a standard normal prior; `None` if the covariance is singular.
    pub fn of(posterior: &Believed) -> Option<Self> {
        let inverse = posterior.covariance.clone().cholesky()?.inverse();
        let count = inverse.nrows();
        Some(Self { information: &inverse * &posterior.mean, precision: inverse - DMatrix::identity(count, count) })
    }

    /// Information on the lot's part, where the units' own parts have the variances `own`.
    fn of_lot(&self, own: &DMatrix<f64>) -> Option<Self> {
        let count = own.nrows();
        let through = (DMatrix::identity(count, count) + &self.precision * own).lu();
        let precision = through.solve(&self.precision)?;
        // symmetric but for rounding
        let precision = (&precision + precision.transpose()) / 2.0;
        Some(Self { precision, information: through.solve(&self.information)? })
    }
}

impl Believed {
    /// Mean and covariance from a precision and an information.
    fn of(precision: DMatrix<f64>, information: &DVector<f64>) -> Option<Self> {
        let covariance = precision.cholesky()?.inverse();
        Some(Self { mean: &covariance * information, covariance })
    }

    /// Standard deviations.
    pub fn sd(&self) -> DVector<f64> {
        self.covariance.diagonal().map(|variance| variance.max(0.0).sqrt())
    }
}

impl Lot {
    /// The lot of some units, whose constants have the `shared` shares of their variance in common, each within 0 and 1; `None` if numbers are not
    /// finite.
    pub fn of(units: &[Said], shared: &[f64]) -> Option<Self> {
        let own = DMatrix::from_diagonal(&DVector::from_iterator(shared.len(), shared.iter().map(|s| 1.0 - s)));
        let prior = DMatrix::from_diagonal(&DVector::from_iterator(shared.len(), shared.iter().map(|s| 1.0 / s)));
        let of_lot = units.iter().map(|unit| unit.of_lot(&own)).collect::<Option<Vec<_>>>()?;
        let start = (prior, DVector::zeros(shared.len()));
        let (precision, information) = of_lot.iter().fold(start, |(p, h), said| (p + &said.precision, h + &said.information));
        let common = Believed::of(precision.clone(), &information)?;
        let unit = |(said, of_lot): (&Said, &Said)| {
            // by all units but this one
            let others = Believed::of(&precision - &of_lot.precision, &(&information - &of_lot.information))?;
            let before = (others.covariance + &own).cholesky()?.inverse();
            Believed::of(&before + &said.precision, &(before * others.mean + &said.information))
        };
        let of_units = units.iter().zip(&of_lot).map(unit).collect::<Option<_>>()?;
        let further = Believed { mean: common.mean.clone(), covariance: &common.covariance + own };
        Some(Self { common, units: of_units, further })
    }
}

impl Fit {
    /// The nuisances of these `numbers` as the fit leaves them, in standard deviations of their priors; those that were not free are as they were.
    ///
    /// # Errors
    /// [`Error::Data`] if every record has its own of one of them.
    pub fn believed(&self, model: &dyn ForwardModel, numbers: &[usize]) -> Result<Believed, Error> {
        if let Some(local) = numbers.iter().find(|n| model.nuisances()[**n].local) {
            let name = &model.nuisances()[*local].parameter.name;
            return Err(Error::Data(format!("every record has its own {name}, which is no constant of a unit")));
        }
        let at = |number: usize| self.layout.iter().position(|u| *u == Unknown::Nuisance { number, record: None });
        let places: Vec<Option<usize>> = numbers.iter().map(|number| at(*number)).collect();
        let covariance = DMatrix::from_fn(places.len(), places.len(), |i, j| match (places[i], places[j]) {
            (Some(a), Some(b)) => self.covariance[(a, b)],
            _ => f64::from(u8::from(i == j)),
        });
        let mean = DVector::from_iterator(places.len(), places.iter().map(|place| place.map_or(0.0, |at| self.u[at])));
        Ok(Believed { mean, covariance })
    }
}

/// Knowledge of some nuisances in place of their priors in a fit: their numbers, and their covariance in standard deviations of their priors.
pub type Known<'a> = (&'a [usize], &'a DMatrix<f64>);

impl Fit {
    /// Size of an effect, for small changes, in standard deviations by which it stands out of the records beside all unknowns of this fit.
    ///
    /// # Errors
    /// [`Error`] if the model fails, or a covariance is singular.
    pub fn stands_out(
        &self,
        model: &dyn ForwardModel,
        records: &[usize],
        effect: &Active,
        known: Option<Known>,
    ) -> Result<f64, Error> {
        let mut column = Vec::with_capacity(self.whitened.len());
        for (at, (record, nuisances)) in records.iter().zip(&self.nuisances).enumerate() {
            let rows = self.residuals[at].first().map_or(0, Vec::len);
            let respond = |active: &[Active]| checked::responded(model, *record, rows, nuisances, active);
            let [with, without] = [respond(std::slice::from_ref(effect))?, respond(&[])?];
            for (channel, (with, without)) in with.iter().zip(&without).enumerate() {
                let change: Vec<f64> = with.iter().zip(without).map(|(a, b)| a - b).collect();
                column.extend(self.noise.whiten(at, channel, &change));
            }
        }
        let column = DVector::from_vec(column);
        let beforehand = match known {
            None => self.beforehand.clone(),
            Some((numbers, covariance)) => {
                let precision = covariance.clone().cholesky().ok_or(Error::NotFinite)?.inverse();
                let place =
                    |number: &usize| self.layout.iter().position(|u| *u == Unknown::Nuisance { number: *number, record: None });
                let places = numbers.iter().map(place).collect::<Option<Vec<_>>>().ok_or(Error::NotFinite)?;
                self.beforehand.with(&places, &precision)
            }
        };
        let factor = beforehand.curvature(self.derivatives.products.clone()).cholesky().ok_or(Error::NotFinite)?;
        let shared = self.jacobian().tr_mul(&column);
        Ok((column.norm_squared() - shared.dot(&factor.solve(&shared))).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(precision: &[f64], information: &[f64]) -> Said {
        let n = information.len();
        Said { precision: DMatrix::from_row_slice(n, n, precision), information: DVector::from_column_slice(information) }
    }

    fn near(a: &DMatrix<f64>, b: &DMatrix<f64>) {
        assert!((a - b).amax() < 1e-9, "{a}{b}");
    }

    /// Three units whose records give the constant θ with variance v, by hand: each is an observation of ℓ with variance v + D.
    #[test]
    fn one_constant_is_a_weighted_mean() {
        let (theta, v, share) = ([0.9, 1.4, 0.1], [0.01, 0.2, 1.0], 0.5);
        let units: Vec<Said> = (0..3).map(|k| said(&[1.0 / v[k]], &[theta[k] / v[k]])).collect();
        let lot = Lot::of(&units, &[share]).expect("a lot");
        let weights = v.map(|v| 1.0 / (v + 0.5));
        let precision = 1.0 / share + weights.iter().sum::<f64>();
        let mean = (0..3).map(|k| weights[k] * theta[k]).sum::<f64>() / precision;
        assert!((lot.common.mean[0] - mean).abs() < 1e-12 && (lot.common.covariance[(0, 0)] - 1.0 / precision).abs() < 1e-12);
        assert!((lot.further.covariance[(0, 0)] - 1.0 / precision - 0.5).abs() < 1e-12);
        // a unit that is known is where its own records say, another where the lot is
        assert!((lot.units[0].mean[0] - 0.9).abs() < 0.01 && lot.units[2].mean[0] > 0.3);
    }

    /// The joint density of ℓ and all θ, solved as one.
    #[test]
    fn many_constants_are_as_the_joint_density_says() {
        let shared = [0.5, 0.2];
        let units = [said(&[4.0, -1.5, -1.5, 0.9], &[2.0, -0.4]), said(&[9.0, 0.0, 0.0, 0.0], &[-3.0, 0.0])];
        let lot = Lot::of(&units, &shared).expect("a lot");
        let mut joint = DMatrix::zeros(6, 6);
        let mut information = DVector::zeros(6);
        for i in 0..2 {
            let own = 1.0 / (1.0 - shared[i]);
            joint[(i, i)] += 1.0 / shared[i] + 2.0 * own;
            for (k, unit) in units.iter().enumerate() {
                let at = 2 + 2 * k;
                (joint[(i, at + i)], joint[(at + i, i)]) = (-own, -own);
                joint[(at + i, at + i)] += own;
                information[at + i] = unit.information[i];
                for j in 0..2 {
                    joint[(at + i, at + j)] += unit.precision[(i, j)];
                }
            }
        }
        let covariance = joint.cholesky().expect("a density").inverse();
        let mean = &covariance * information;
        near(&lot.common.covariance, &covariance.view((0, 0), (2, 2)).into_owned());
        assert!((&lot.common.mean - mean.rows(0, 2)).amax() < 1e-9);
        for (k, unit) in lot.units.iter().enumerate() {
            near(&unit.covariance, &covariance.view((2 + 2 * k, 2 + 2 * k), (2, 2)).into_owned());
            assert!((&unit.mean - mean.rows(2 + 2 * k, 2)).amax() < 1e-9);
        }
    }

    #[test]
    fn units_that_say_nothing_change_nothing_and_order_does_not_matter() {
        let silent = said(&[0.0; 4], &[0.0; 2]);
        let lot = Lot::of(&[silent.clone(), silent.clone()], &[0.5, 0.3]).expect("a lot");
        assert_eq!(lot.further.mean, DVector::zeros(2));
        near(&lot.further.covariance, &DMatrix::identity(2, 2));
        let [a, b] = [said(&[4.0, -1.5, -1.5, 0.9], &[2.0, -0.4]), said(&[1.0, 0.5, 0.5, 3.0], &[0.0, 1.0])];
        let of = |units: &[Said]| Lot::of(units, &[0.5, 0.3]).expect("a lot").further;
        let [one, other] = [of(&[a.clone(), b.clone(), silent]), of(&[b, a])];
        near(&one.covariance, &other.covariance);
        assert!((one.mean - other.mean).amax() < 1e-9);
    }

    #[test]
    fn what_is_said_is_the_posterior_without_the_prior() {
        let covariance = DMatrix::from_row_slice(2, 2, &[0.3, 0.1, 0.1, 0.8]);
        let posterior = Believed { mean: DVector::from_column_slice(&[0.7, -0.2]), covariance };
        let said = Said::of(&posterior).expect("a density");
        let again = Believed::of(said.precision + DMatrix::identity(2, 2), &said.information).expect("a density");
        near(&again.covariance, &posterior.covariance);
        assert!((again.mean - posterior.mean).amax() < 1e-12);
    }
}
