//! Laws with states of their own, followed through a record.

use crate::Expression;
use crate::expression::Operator;
use nalgebra::{DMatrix, DVector};

/// Steps of a state between two rows: inputs are linear between them.
const STEPS: usize = 4;
/// γ = 1 − 1/√2: of second order whatever the derivatives, and fast states are followed without overshoot.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Halvings of a step that place a jump in it.
const HALVINGS: usize = 30;

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

/// Values of laws through a record: in its rows, and on both sides of each jump between two rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Instants, increasing.
    pub time: Vec<f64>,
    /// Place of each row among them.
    pub rows: Vec<usize>,
    /// Places behind which a law jumps: the next instant follows at once.
    pub jumps: Vec<usize>,
    /// Values, `[law][instant]`.
    pub laws: Vec<Vec<f64>>,
}

impl Run {
    /// Values in the rows alone.
    pub fn in_rows(&self, values: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|n| values[*n]).collect()
    }

    fn push(&mut self, system: &System, time: f64, values: &[f64]) {
        self.time.push(time);
        self.laws.iter_mut().zip(&system.laws).for_each(|(series, law)| series.push(law.at(values)));
    }
}

/// A step between two rows, or a part of one: the inputs are linear in it.
struct Span<'a> {
    inputs: &'a [Vec<f64>],
    /// the row at its end
    row: usize,
    time: [f64; 2],
    /// shares of the interval between the rows
    ends: [f64; 2],
}

impl Span<'_> {
    /// Inputs at a share of the interval between the rows; in a row they are its own, bit by bit.
    fn inputs(&self, share: f64) -> impl Iterator<Item = f64> {
        let between = move |of: &Vec<f64>| {
            let [before, row] = [of[self.row - 1], of[self.row]];
            if share == 1.0 { row } else { before + share * (row - before) }
        };
        self.inputs.iter().map(between)
    }

    fn at(&self, share: f64) -> f64 {
        let [before, row] = self.time;
        if share == 1.0 { row } else { before + share * (row - before) }
    }

    /// Shares just before and just after a switch goes through 0, all values being linear between those `from` and `to`; none if it does not.
    fn crossing(&self, (switch, beyond): &(Expression, bool), from: &[f64], to: &[f64]) -> Option<[f64; 2]> {
        let on = |values: &[f64]| if *beyond { switch.at(values) > 0.0 } else { switch.at(values) >= 0.0 };
        let was = on(from);
        if was == on(to) {
            return None;
        }
        let [first, last] = self.ends;
        let [mut before, mut after] = self.ends;
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(before, after);
            if !(self.at(before) < self.at(middle) && self.at(middle) < self.at(after)) {
                break;
            }
            let share = (middle - first) / (last - first);
            let values: Vec<f64> = from.iter().zip(to).map(|(from, to)| from + share * (to - from)).collect();
            *(if on(&values) == was { &mut before } else { &mut after }) = middle;
        }
        Some([before, after])
    }
}

impl System {
    /// Values of all laws in every row, `[law][row]`, from parameters and the inputs' series. What an expression is not defined for is NaN from there on.
    ///
    /// # Panics
    /// If counts or lengths differ.
    pub fn run(&self, time: &[f64], parameters: &[f64], inputs: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let run = self.through(time, parameters, inputs);
        if run.jumps.is_empty() {
            return run.laws;
        }
        run.laws.iter().map(|values| run.in_rows(values)).collect()
    }

    /// The same with both sides of each instant between two rows at which a `step` or a `sign` jumps, in a law or in what a state follows.
    ///
    /// # Panics
    /// As [`Self::run`].
    pub fn through(&self, time: &[f64], parameters: &[f64], inputs: &[Vec<f64>]) -> Run {
        assert!(parameters.len() == self.parameters && inputs.len() == self.inputs, "as many values as the laws were made for");
        let switches = self.switches();
        let steps = if self.states.is_empty() { 1 } else { STEPS };
        let (laws, rows) = (vec![Vec::with_capacity(time.len()); self.laws.len()], Vec::with_capacity(time.len()));
        let mut run = Run { time: Vec::with_capacity(time.len()), rows, jumps: Vec::new(), laws };
        let mut values: Vec<f64> = parameters.to_vec();
        values.resize(self.parameters + self.inputs + self.states.len(), 0.0);
        for (row, now) in time.iter().enumerate() {
            if row == 0 {
                self.place(&mut values, inputs.iter().map(|of| of[row]));
                self.begin(&mut values);
            } else {
                let share = |step: usize| step as f64 / steps as f64;
                for step in 1..=steps {
                    let span = Span { inputs, row, time: [time[row - 1], *now], ends: [share(step - 1), share(step)] };
                    self.cross(&span, &switches, &mut values, &mut run);
                }
            }
            run.rows.push(run.time.len());
            run.push(self, *now, &values);
        }
        run
    }

    /// What a law or the change of a state jumps by.
    fn switches(&self) -> Vec<(Expression, bool)> {
        let of = |state: &State| match state {
            State::Rate { rate, .. } => rate.switches(),
            State::Play { of, .. } | State::Highest(of) | State::Lowest(of) => of.switches(),
        };
        self.laws.iter().flat_map(Expression::switches).chain(self.states.iter().flat_map(of)).collect()
    }

    /// Through a span; `run` gets both sides of its jumps.
    fn cross(&self, span: &Span, switches: &[(Expression, bool)], values: &mut Vec<f64>, run: &mut Run) {
        let [first, last] = span.ends;
        let before = if switches.is_empty() { Vec::new() } else { values.clone() };
        self.go(values, span, [first, last]);
        let mut crossings: Vec<[f64; 2]> = switches.iter().filter_map(|switch| span.crossing(switch, &before, values)).collect();
        if crossings.is_empty() {
            return;
        }
        crossings.sort_by(|a, b| a[0].total_cmp(&b[0]));
        *values = before;
        let mut at = first;
        for [until, from] in crossings {
            // another switch goes through 0 at the same instant
            if until < at {
                continue;
            }
            self.go(values, span, [at, until]);
            if run.time.last().is_none_or(|last| *last < span.at(until)) {
                run.push(self, span.at(until), values);
            }
            run.jumps.push(run.time.len() - 1);
            self.go(values, span, [until, from]);
            if from < 1.0 {
                run.push(self, span.at(from), values);
            }
            at = from;
        }
        self.go(values, span, [at, last]);
    }

    /// From one share of a span to another.
    fn go(&self, values: &mut [f64], span: &Span, [from, to]: [f64; 2]) {
        if self.states.is_empty() {
            self.place(values, span.inputs(to));
        } else {
            let next: Vec<f64> = span.inputs(to).collect();
            self.step(values, &next, (to - from) * (span.time[1] - span.time[0]));
        }
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
    fn exact_a_jump_has_its_instant_between_rows() {
        let time = even(30.0, 5);
        let system = |states: Vec<State>, law: &str| System { parameters: 2, inputs: 1, states, laws: vec![of(law)] };
        for when in [30.0, 30.001, 41.7, 59.9, 60.0] {
            // the input is the time, and a second law, or another place of the same switch, jumps with the first
            let run = system(vec![], "p * step(u - q) - step(u - q)").through(&time, &[3.0, when], std::slice::from_ref(&time));
            let [jump] = run.jumps[..] else { panic!("{when}: {run:?}") };
            assert!(run.time[jump] < when + 1e-6 && when < run.time[jump + 1] + 1e-6, "{when}: {run:?}");
            assert!(run.time.windows(2).all(|w| w[0] < w[1]), "{when}: {run:?}");
            assert_eq!([run.laws[0][jump], run.laws[0][jump + 1]], [0.0, 2.0]);
            assert_eq!(run.in_rows(&run.time), time);
            assert_eq!(run.in_rows(&run.laws[0]), time.iter().map(|t| if *t < when { 0.0 } else { 2.0 }).collect::<Vec<_>>());
            // a state that grows from then on
            let grown = vec![State::Rate { rate: of("p * step(u - q)"), first: of("0 * p") }];
            let x = system(grown, "x").run(&time, &[3.0, when], std::slice::from_ref(&time));
            let exact = |t: f64| 3.0 * (t - when).max(0.0);
            assert!(time.iter().zip(&x[0]).all(|(t, x)| (x - exact(*t)).abs() < 1e-5), "{when}: {x:?}");
        }
        // two jumps within a row: a pulse
        let pulse = system(vec![], "step(u - p) - step(u - q)").through(&time, &[65.0, 72.0], std::slice::from_ref(&time));
        assert_eq!((pulse.jumps.len(), pulse.time.len()), (2, 9));
        // what a state follows has jumped on the far side of the jump
        for follows in [State::Highest(of("step(u - q)")), State::Play { of: of("step(u - q)"), width: of("0 * p") }] {
            let run = system(vec![follows], "x").through(&time, &[3.0, 45.0], std::slice::from_ref(&time));
            let [jump] = run.jumps[..] else { panic!("{run:?}") };
            assert_eq!([run.laws[0][jump], run.laws[0][jump + 1]], [0.0, 1.0]);
        }
    }

    /// From rest to a rise, and to a fall: a sign jumps by as much at the same instant, and through 0 in one.
    #[test]
    fn a_sign_jumps_alike_either_way() {
        let time = even(30.0, 5);
        let system = System { parameters: 2, inputs: 1, states: Vec::new(), laws: vec![of("sign(u)")] };
        for way in [1.0, -1.0] {
            let to = |from: f64, to: f64| {
                let u: Vec<f64> = time.iter().map(|t| way * if *t < 60.0 { from } else { to }).collect();
                let run = system.through(&time, &[0.0, 0.0], &[u]);
                let jump = *run.jumps.first().expect("a jump");
                (
                    run.time[jump],
                    run.time[run.jumps[run.jumps.len() - 1] + 1],
                    run.laws[0].iter().map(|sign| way * sign).collect::<Vec<_>>(),
                )
            };
            let (before, after, rises) = to(0.0, 1.0);
            assert!(before >= 30.0 && after < 30.0 + 1e-6, "{before} {after}");
            assert_eq!(rises.iter().filter(|sign| **sign == 0.0).count(), 2, "{rises:?}");
            // halfway, at 0 itself for an instant at most
            let (before, after, turns) = to(-1.0, 1.0);
            assert!(
                before > 45.0 - 1e-6 && after < 45.0 + 1e-6 && turns.iter().filter(|sign| **sign == 0.0).count() <= 1,
                "{turns:?}"
            );
        }
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
