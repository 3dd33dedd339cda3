//! Laws with states of their own, followed through a record.

use crate::Expression;
use crate::expression::Operator;
use nalgebra::{DMatrix, DVector};

/// Steps of a state between two rows: inputs are linear between them.
const STEPS: usize = 4;
/// γ = 1 − 1/√2: of second order whatever the derivatives, and fast states are followed without overshoot.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Change of a state from its value before.
#[derive(Debug, Clone, PartialEq)]
pub enum State {
    /// dx/dt is an expression \[unit of the state/s\]; at first the state has the value of another, in which no state occurs.
    Rate {
        /// dx/dt.
        rate: Expression,
        /// Value in the first row.
        first: Expression,
    },
    /// It follows an expression, without other states, once that has moved half a width away; in the first row it is in the middle (a play, or backlash).
    Play {
        /// The expression that is followed.
        of: Expression,
        /// Width of the play, of parameters alone; 0 or less is none.
        width: Expression,
    },
    /// The highest value of an expression, without other states, so far.
    Highest(Expression),
    /// The lowest.
    Lowest(Expression),
}

/// Laws in parameters, inputs and states; their values stand in this order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct System {
    /// Number of parameters.
    pub parameters: usize,
    /// Number of inputs.
    pub inputs: usize,
    /// States.
    pub states: Vec<State>,
    /// The laws to evaluate.
    pub laws: Vec<Expression>,
}

impl System {
    /// Values of all laws in every row, `[law][row]`, from parameters and the inputs' series. What an expression is not defined for is NaN from there on.
    ///
    /// # Panics
    /// If counts or lengths differ.
    pub fn run(&self, time: &[f64], parameters: &[f64], inputs: &[Vec<f64>]) -> Vec<Vec<f64>> {
        assert!(parameters.len() == self.parameters && inputs.len() == self.inputs, "as many values as the laws were made for");
        let mut laws = vec![Vec::with_capacity(time.len()); self.laws.len()];
        let mut values: Vec<f64> = parameters.to_vec();
        values.resize(self.parameters + self.inputs + self.states.len(), 0.0);
        let mut next = vec![0.0; self.inputs];
        for row in 0..time.len() {
            if row == 0 || self.states.is_empty() {
                self.place(&mut values, inputs.iter().map(|of| of[row]));
                self.begin(&mut values);
            } else {
                let dt = (time[row] - time[row - 1]) / STEPS as f64;
                for step in 1..=STEPS {
                    let share = step as f64 / STEPS as f64;
                    let between = |of: &Vec<f64>| of[row - 1] + share * (of[row] - of[row - 1]);
                    let at = |of: &Vec<f64>| if step == STEPS { of[row] } else { between(of) };
                    next.iter_mut().zip(inputs).for_each(|(next, of)| *next = at(of));
                    self.step(&mut values, &next, dt);
                }
            }
            laws.iter_mut().zip(&self.laws).for_each(|(series, law)| series.push(law.at(&values)));
        }
        laws
    }

    fn place(&self, values: &mut [f64], inputs: impl Iterator<Item = f64>) {
        values[self.parameters..].iter_mut().zip(inputs).for_each(|(value, input)| *value = input);
    }

    fn begin(&self, values: &mut [f64]) {
        let first = self.parameters + self.inputs;
        for (k, state) in self.states.iter().enumerate() {
            values[first + k] = match state {
                State::Rate { first, .. } => first.at(values),
                State::Play { of, .. } | State::Highest(of) | State::Lowest(of) => of.at(values),
            };
        }
    }

    /// One step to the next inputs. Rates see the other states as they were.
    fn step(&self, values: &mut [f64], next: &[f64], dt: f64) {
        let first = self.parameters + self.inputs;
        let rated: Vec<(usize, &Expression)> = self
            .states
            .iter()
            .enumerate()
            .filter_map(|(k, state)| match state {
                State::Rate { rate, .. } => Some((first + k, rate)),
                _ => None,
            })
            .collect();
        let moved = match rated[..] {
            [] => Vec::new(),
            [one] => vec![self.moved_alone(values, next, dt, one)],
            _ => self.moved(values, next, dt, &rated),
        };
        self.place(values, next.iter().copied());
        for (k, state) in self.states.iter().enumerate() {
            let before = values[first + k];
            values[first + k] = match state {
                State::Rate { .. } => before,
                State::Play { of, width } => {
                    let (at, half) = (of.at(values), width.at(values).max(0.0) / 2.0);
                    // a play of NaN is NaN
                    if at - half > before || at.is_nan() || half.is_nan() {
                        at - half
                    } else if at + half < before {
                        at + half
                    } else {
                        before
                    }
                }
                State::Highest(of) => Operator::Most.of(of.at(values), before),
                State::Lowest(of) => Operator::Least.of(of.at(values), before),
            };
        }
        rated.iter().zip(moved).for_each(|((place, _), moved)| values[*place] = moved);
    }

    /// [`Self::moved`] of one state, the only one that has a rate.
    fn moved_alone(&self, values: &mut [f64], next: &[f64], dt: f64, (place, rate): (usize, &Expression)) -> f64 {
        let before = values[place];
        let (now, slope) = rate.slope(values, place);
        let pivot = 1.0 - slope * (GAMMA * dt);
        let inputs = self.parameters..self.parameters + self.inputs;
        let said: Vec<f64> = values[inputs.clone()].to_vec();
        self.place(values, next.iter().copied());
        let driven = (rate.at(values) - now) * GAMMA;
        let k1 = (now + driven) / pivot;
        values[place] = before + dt * k1;
        let k2 = (rate.at(values) - 2.0 * k1 - driven) / pivot;
        values[place] = before;
        values[inputs].copy_from_slice(&said);
        before + dt * (1.5 * k1 + 0.5 * k2)
    }

    /// Rated states at the end of a step: Rosenbrock's method of two stages (J. G. Verwer and others, *SIAM J. Sci. Comput.* 20, 1456 (1999)).
    fn moved(&self, values: &[f64], next: &[f64], dt: f64, rated: &[(usize, &Expression)]) -> Vec<f64> {
        let count = rated.len();
        let jacobian = DMatrix::from_fn(count, count, |i, j| rated[i].1.slope(values, rated[j].0).1);
        let matrix = (DMatrix::identity(count, count) - jacobian * (GAMMA * dt)).lu();
        let solved = |right: DVector<f64>| matrix.solve(&right).unwrap_or_else(|| DVector::from_element(count, f64::NAN));
        let rates = |values: &[f64]| DVector::from_iterator(count, rated.iter().map(|(_, rate)| rate.at(values)));
        let now = rates(values);
        let mut ahead = values.to_vec();
        self.place(&mut ahead, next.iter().copied());
        // what the inputs alone change in the step
        let driven = (rates(&ahead) - &now) * GAMMA;
        let k1 = solved(now + &driven);
        rated.iter().enumerate().for_each(|(n, (place, _))| ahead[*place] += dt * k1[n]);
        let k2 = solved(rates(&ahead) - 2.0 * &k1 - driven);
        rated.iter().enumerate().map(|(n, (place, _))| values[*place] + dt * (1.5 * k1[n] + 0.5 * k2[n])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Expression {
        // parameters p, q; input u; states x, y
        Expression::parse(text, &["p", "q", "u", "x", "y"]).unwrap_or_else(|fault| panic!("{text}: {fault}"))
    }

    fn run(states: Vec<State>, law: &str, time: &[f64], u: impl Fn(f64) -> f64, parameters: [f64; 2]) -> Vec<f64> {
        let system = System { parameters: 2, inputs: 1, states, laws: vec![of(law)] };
        system.run(time, &parameters, &[time.iter().map(|t| u(*t)).collect()]).swap_remove(0)
    }

    fn even(dt: f64, count: u32) -> Vec<f64> {
        (0..count).map(|n| dt * f64::from(n)).collect()
    }

    #[test]
    fn observed_order_of_a_lag_is_two_and_a_fast_one_follows() {
        let error = |count: u32| {
            let tau = 50.0;
            let time = even(1000.0 / f64::from(count), count + 1);
            let lag = vec![State::Rate { rate: of("(u - x) / p"), first: of("u") }];
            let x = run(lag, "x", &time, |t| 0.1 * t, [tau, 0.0]);
            let exact = |t: f64| 0.1 * (t - tau * (1.0 - (-t / tau).exp()));
            time.iter().zip(&x).map(|(t, x)| (x - exact(*t)).abs()).fold(0.0, f64::max)
        };
        let order = (error(40) / error(80)).log2();
        assert!((order - 2.0).abs() < 0.15, "{order}");
        // a lag far below the step: the input itself, and no overshoot after a jump
        let fast = vec![State::Rate { rate: of("(u - x) / p"), first: of("u") }];
        let x = run(fast, "x", &even(60.0, 20), |t| if t > 300.0 { 1.0 } else { 0.0 }, [1e-3, 0.0]);
        assert!((x[19] - 1.0).abs() < 1e-6 && x.iter().all(|x| (-0.3..1.3).contains(x)), "{x:?}");
        // on a ramp it is behind by its lag times the slope, however long the steps, and after a gap, too
        for (tau, dt) in [(1.0, 60.0), (2.0, 590.0), (600.0, 36_000.0), (1e-3, 60.0)] {
            let lag = vec![State::Rate { rate: of("(u - x) / p"), first: of("u") }];
            let behind = run(lag, "u - x", &even(dt, 40), |t| t / 60.0, [tau, 0.0]);
            assert!((behind[39] * 60.0 / tau - 1.0).abs() < 1e-6, "{tau} {dt}: {}", behind[39]);
        }
    }

    #[test]
    fn exact_an_oscillator_keeps_its_energy_to_the_order_of_the_method() {
        // x'' = −x in two states
        let states = || vec![State::Rate { rate: of("y"), first: of("p") }, State::Rate { rate: of("-x"), first: of("q") }];
        let time = even(0.05, 200);
        let x = run(states(), "x", &time, |_| 0.0, [1.0, 0.0]);
        assert!(time.iter().zip(&x).all(|(t, x)| (x - t.cos()).abs() < 2e-3));
    }

    #[test]
    fn exact_a_play_has_its_width_and_extremes_stay() {
        let time = even(1.0, 400);
        let u = |t: f64| 10.0 * (t / 20.0).sin();
        let play = run(vec![State::Play { of: of("u"), width: of("p") }], "u - x", &time, u, [4.0, 0.0]);
        let most = play[100..].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = play[100..].iter().copied().fold(f64::INFINITY, f64::min);
        assert!((most - 2.0).abs() < 1e-12 && (least + 2.0).abs() < 1e-12, "{most} {least}");
        assert_eq!(run(vec![State::Play { of: of("u"), width: of("0 * p") }], "u - x", &time, u, [4.0, 0.0]), vec![0.0; 400]);
        let extremes = vec![State::Highest(of("u")), State::Lowest(of("u"))];
        let span = run(extremes, "x - y", &time, u, [0.0, 0.0]);
        assert!(span.windows(2).all(|w| w[1] >= w[0]) && (span[399] - 20.0).abs() < 0.02);
    }

    #[test]
    fn what_is_not_defined_is_nan_and_no_panic() {
        let time = even(1.0, 10);
        let log = run(vec![], "ln(u)", &time, |t| 4.5 - t, [0.0, 0.0]);
        assert!(log[4].is_finite() && log[5].is_nan());
        let broken = run(vec![State::Rate { rate: of("x^2"), first: of("1e200 + p") }], "x", &time, |_| 0.0, [0.0, 0.0]);
        assert!(broken[0].is_finite() && !broken[9].is_finite());
        let play = run(vec![State::Play { of: of("sqrt(u)"), width: of("1") }], "x", &time, |t| 3.0 - t, [0.0, 0.0]);
        assert!(play[9].is_nan());
        for law in ["max(0, ln(u))", "min(ln(u), 0)", "max(ln(u), 0)"] {
            assert!(run(vec![], law, &time, |_| -1.0, [0.0, 0.0]).iter().all(|x| x.is_nan()), "{law}");
        }
        assert!(run(vec![State::Highest(of("ln(u)"))], "x", &time, |t| 4.5 - t, [0.0, 0.0])[9].is_nan());
    }
}
