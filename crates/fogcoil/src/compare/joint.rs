//! Effect of the tolerances of two designs on a difference.
//!
//! To first order a design's sensitivity moves by cᵀu: u the deviations of its numbers in standard deviations, with correlations R, c what one changes.
//! Of B less A the variance is
//!
//! ```text
//! c_Bᵀ R_B c_B + c_Aᵀ R_A c_A − 2 c_Aᵀ R_AB c_B
//! ```
//!
//! A number that both designs share (the same value, tolerance and correlations with the others that they share) deviates by the same in both. The own
//! numbers of A and of B are correlated through shared numbers alone: with S the shared numbers, R_AB = R_A[·,S] R[S,S]⁻¹ R_B[S,·]. Where nothing is
//! correlated, a shared number contributes (c_B − c_A)², another c_A² and c_B².

use coil::Number;
use nalgebra::{DMatrix, DVector};

use super::drawing::is_same;
use crate::input::CoilCase;

/// Correlations of the numbers of A, of B, and between both.
pub(super) struct Joint {
    own: [DMatrix<f64>; 2],
    between: DMatrix<f64>,
    shared: Vec<Number>,
}

impl Joint {
    pub(super) fn of(cases: [&CoilCase; 2], numbers: [&[Number]; 2]) -> Self {
        let [a, b] = numbers;
        let same = |number: &Number| {
            let [own, other] = cases.map(|case| number.of(&case.design));
            let [tails, others] = cases.map(|case| case.design.winding.tails.ccw);
            let tolerances = cases.map(|case| case.tolerances.of(*number));
            own.zip(other).is_some_and(|(own, other)| is_same(own, other))
                && (*number != Number::Tail || is_same(tails, others))
                && tolerances[0] == tolerances[1]
        };
        let both: Vec<Number> = a.iter().copied().filter(|number| b.contains(number) && same(number)).collect();
        let [of_a, of_b] = cases.map(|case| case.tolerances.correlation(&both));
        let alike = |i: usize| (0..both.len()).all(|j| is_same(of_a[(i, j)], of_b[(i, j)]));
        let shared = both.iter().enumerate().filter(|(i, _)| alike(*i)).map(|(_, number)| *number).collect();
        let own = [0, 1].map(|k| cases[k].tolerances.correlation(numbers[k]));
        Self::new(numbers, own, shared)
    }

    fn new(numbers: [&[Number]; 2], own: [DMatrix<f64>; 2], shared: Vec<Number>) -> Self {
        let places = numbers.map(|all| shared.iter().filter_map(|n| all.iter().position(|m| m == n)).collect::<Vec<usize>>());
        let to_shared = [0, 1].map(|k| DMatrix::from_fn(own[k].nrows(), shared.len(), |i, j| own[k][(i, places[k][j])]));
        let among = DMatrix::from_fn(shared.len(), shared.len(), |i, j| own[0][(places[0][i], places[0][j])]);
        // a file's correlations are positive definite, and so is any part of them
        let between = match among.cholesky() {
            Some(factor) if !shared.is_empty() => &to_shared[0] * factor.solve(&to_shared[1].transpose()),
            _ => DMatrix::zeros(own[0].nrows(), own[1].nrows()),
        };
        Self { own, between, shared }
    }

    pub(super) fn shares(&self, number: Number) -> bool {
        self.shared.contains(&number)
    }

    /// One standard deviation of A, of B, and of B less A, where one of each number changes them by `changes`.
    pub(super) fn sd(&self, changes: [&[f64]; 2]) -> [f64; 3] {
        let [a, b] = changes.map(DVector::from_column_slice);
        let [of_a, of_b] = [a.dot(&(&self.own[0] * &a)), b.dot(&(&self.own[1] * &b))];
        let covariance = a.dot(&(&self.between * &b));
        // what cancels leaves rounding
        let difference = of_a + of_b - 2.0 * covariance;
        let rounding = 1e-14 * (of_a + of_b);
        [of_a, of_b, if difference > rounding { difference } else { 0.0 }].map(|variance| variance.max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use coil::Parameter;

    use super::*;

    const NUMBERS: [Number; 4] = [
        Number::Constant(Parameter::AxialModulus),
        Number::Constant(Parameter::TransverseModulus),
        Number::Constant(Parameter::SpoolExpansion),
        Number::Tail,
    ];

    fn correlation(pairs: &[(usize, usize, f64)]) -> DMatrix<f64> {
        let mut all = DMatrix::identity(4, 4);
        for (i, j, r) in pairs {
            (all[(*i, *j)], all[(*j, *i)]) = (*r, *r);
        }
        all
    }

    #[test]
    fn independent_numbers_cancel_where_they_are_shared() {
        let joint = Joint::new([&NUMBERS; 2], [correlation(&[]), correlation(&[])], NUMBERS[..2].to_vec());
        let (a, b) = ([1.0, 2.0, 3.0, 4.0], [1.5, 2.0, -5.0, 6.0]);
        let [sd_a, sd_b, difference] = joint.sd([&a, &b]);
        assert!((sd_a - 30_f64.sqrt()).abs() < 1e-14 && (sd_b - (2.25 + 4.0 + 25.0 + 36.0_f64).sqrt()).abs() < 1e-14);
        // 0.5 of the first, nothing of the second, 3, 5, 4 and 6 of what is not shared
        assert!((difference.powi(2) - (0.25 + 9.0 + 25.0 + 16.0 + 36.0)).abs() < 1e-12, "{difference}");
        let all = Joint::new([&NUMBERS; 2], [correlation(&[]), correlation(&[])], NUMBERS.to_vec());
        assert_eq!(all.sd([&a, &a])[2], 0.0);
        let none = Joint::new([&NUMBERS; 2], [correlation(&[]), correlation(&[])], Vec::new());
        assert!((none.sd([&a, &a])[2] - 60_f64.sqrt()).abs() < 1e-14);
    }

    /// The deviations made outright: own ones of both designs are drawn given the shared ones, with Gaussian regression written out for one shared number.
    #[test]
    fn correlated_numbers_are_in_common_through_what_is_shared() {
        // number 0 is shared; 1 hangs on it by 0.6 in A, by -0.3 in B; 2 hangs on 1 in A alone
        let own = [correlation(&[(0, 1, 0.6), (1, 2, 0.5)]), correlation(&[(0, 1, -0.3)])];
        let joint = Joint::new([&NUMBERS; 2], own.clone(), vec![NUMBERS[0]]);
        let (a, b) = ([1.0, 2.0, -1.0, 0.5], [0.3, 1.5, 2.0, 0.7]);
        // what a unit of the shared deviation brings: directly, and through number 1
        let (through_a, through_b) = (a[0] + 0.6 * a[1], b[0] - 0.3 * b[1]);
        let variance = |own: &DMatrix<f64>, c: &[f64; 4]| {
            (0..4).flat_map(|i| (0..4).map(move |j| (i, j))).map(|(i, j)| c[i] * own[(i, j)] * c[j]).sum::<f64>()
        };
        let rest = variance(&own[0], &a) - through_a.powi(2) + variance(&own[1], &b) - through_b.powi(2);
        let expected = (through_b - through_a).powi(2) + rest;
        assert!((joint.sd([&a, &b])[2].powi(2) - expected).abs() < 1e-12, "{} {expected}", joint.sd([&a, &b])[2].powi(2));
        // with the roles exchanged it is the same
        let exchanged = Joint::new([&NUMBERS; 2], [own[1].clone(), own[0].clone()], vec![NUMBERS[0]]);
        assert!((exchanged.sd([&b, &a])[2] - joint.sd([&a, &b])[2]).abs() < 1e-12);
    }
}
