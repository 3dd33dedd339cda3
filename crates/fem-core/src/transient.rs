//! Linear heat-like systems in time: `C ẏ + K y = f(t)` by TR-BDF2, with error control on a ladder of step sizes.
//!
//! TR-BDF2 (R. E. Bank et al., 1985) is L-stable and of second order; both implicit stages share the matrix `C + d h K`, so each
//! step size needs one factorisation, which is kept. The error estimate is that of M. E. Hosea and L. F. Shampine (1996): the
//! distance to an embedded third-order formula, filtered through the same matrix so that stiff modes do not inflate it.

use crate::{Error, Factor, SparseMatrix, SymbolicFactor};
use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;

/// First stage's reach, as a fraction of the step.
const GAMMA: f64 = 2.0 - SQRT_2;
/// Diagonal coefficient of both implicit stages.
const D: f64 = GAMMA / 2.0;
/// Weight of the first two stages.
const W: f64 = SQRT_2 / 4.0;
/// Halvings of an interval before the control gives up.
const MOST_HALVINGS: u32 = 30;

/// Factor by which the error must lie below the tolerance before the step is doubled, which raises it eightfold.
const ROOM: f64 = 16.0;

/// Factors that are kept: a ladder of step sizes has a few, irregular instants would have one each.
const MOST_FACTORS: usize = 32;

/// Effort of the stepping.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Effort {
    /// Steps that were taken.
    pub steps: usize,
    /// Steps that were tried and refused.
    pub refused: usize,
    /// Factorisations, one per step size.
    pub factorisations: usize,
}

/// The system with its factors.
#[derive(Debug)]
pub struct Transient {
    capacity: SparseMatrix,
    conductivity: SparseMatrix,
    symbolic: SymbolicFactor,
    factors: BTreeMap<u64, Factor>,
    effort: Effort,
}

/// Solves with `C + d step K` for a step and a right-hand side.
type Solve = fn(&mut Transient, f64, Vec<f64>) -> Result<Vec<f64>, Error>;

/// State y and its rate ẏ at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// y.
    pub value: Vec<f64>,
    /// ẏ.
    pub rate: Vec<f64>,
}

impl Transient {
    /// `C ẏ + K y = f`, both matrices symmetric positive definite and of one pattern, as [`crate::Problem::mass`] and
    /// [`crate::Problem::stiffness`] of one map make them where the same regions have a law.
    ///
    /// # Errors
    /// [`Error::Argument`] if the matrices are of different sizes or patterns; [`Error::NotPositiveDefinite`] if the ordering fails.
    pub fn new(capacity: SparseMatrix, conductivity: SparseMatrix) -> Result<Self, Error> {
        check_patterns(&capacity, &conductivity)?;
        let symbolic = SymbolicFactor::new(&SparseMatrix::combine(1.0, &capacity, 1.0, &conductivity))?;
        Ok(Self { capacity, conductivity, symbolic, factors: BTreeMap::new(), effort: Effort::default() })
    }

    /// C.
    pub fn capacity(&self) -> &SparseMatrix {
        &self.capacity
    }

    /// Effort of the stepping so far.
    pub fn effort(&self) -> Effort {
        self.effort
    }

    /// The factor of `C + d step K`, made when it is first asked for.
    fn factor(&mut self, step: f64) -> Result<&Factor, Error> {
        let key = step.to_bits();
        if !self.factors.contains_key(&key) {
            if self.factors.len() >= MOST_FACTORS {
                self.factors.clear();
            }
            let matrix = SparseMatrix::combine(1.0, &self.capacity, D * step, &self.conductivity);
            self.factors.insert(key, self.symbolic.factor(matrix)?);
            self.effort.factorisations += 1;
        }
        Ok(&self.factors[&key])
    }

    fn solve(&mut self, step: f64, rhs: Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok(self.factor(step)?.solve(&[rhs])?.remove(0))
    }

    fn substitute(&mut self, step: f64, rhs: Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok(self.factor(step)?.substitute(&[rhs]).remove(0))
    }

    /// Whether a state and a load have one entry for each unknown.
    fn check(&self, state: &State, load: &[f64]) -> Result<(), Error> {
        let unknowns = self.capacity.rows();
        Error::check_length("state's value", &state.value, unknowns)?;
        Error::check_length("state's rate", &state.rate, unknowns)?;
        Error::check_length("load", load, unknowns)
    }

    /// The state after a step, and the rate at its inner stage.
    fn stages(&mut self, state: &State, load: &[f64], step: f64, solve: Solve) -> Result<(State, Vec<f64>), Error> {
        let (y, z1) = (&state.value, &state.rate);
        // stages z = ẏ: (C + d h K) z = f − K (y + what the earlier stages add)
        let stage = |me: &mut Self, known: Vec<f64>| {
            let flow = me.conductivity.multiply(&known);
            solve(me, step, load.iter().zip(flow).map(|(f, k)| f - k).collect())
        };
        let z2 = stage(self, add(y, &[(D * step, z1)]))?;
        let z3 = stage(self, add(y, &[(W * step, z1), (W * step, &z2)]))?;
        let value = add(y, &[(W * step, z1), (W * step, &z2), (D * step, &z3)]);
        Ok((State { value, rate: z3 }, z2))
    }

    /// One step of size `step` \[s\], at least 0, under a constant load `f`: the new state and the estimated error of its value.
    ///
    /// # Errors
    /// [`Error::Argument`] if the step is negative or not finite, or if the state or the load has not one entry for each unknown; as
    /// [`Factor::solve`].
    pub fn step(&mut self, state: &State, load: &[f64], step: f64) -> Result<(State, Vec<f64>), Error> {
        self.check(state, load)?;
        check_duration("step", step)?;
        self.estimated(state, load, step)
    }

    /// [`Self::step`] of what is known to fit.
    fn estimated(&mut self, state: &State, load: &[f64], step: f64) -> Result<(State, Vec<f64>), Error> {
        let (next, z2) = self.stages(state, load, step, Self::solve)?;
        let (z1, z3) = (&state.rate, &next.rate);
        let weights = [W - (1.0 - W) / 3.0, W - (3.0 * W + 1.0) / 3.0, D - D / 3.0];
        let raw = add(&vec![0.0; z1.len()], &[(step * weights[0], z1), (step * weights[1], &z2), (step * weights[2], z3)]);
        let filtered = self.capacity.multiply(&raw);
        let error = self.solve(step, filtered)?;
        Ok((next, error))
    }

    /// As [`Self::step`] without the error estimate and by plain substitution in the checked factor, a quarter of the work: for steps
    /// whose size is known to be small enough.
    ///
    /// # Errors
    /// [`Error::Argument`] as in [`Self::step`]; as [`Factor::new`]; [`Error::Residual`] if the new state is not finite.
    pub fn plain_step(&mut self, state: &State, load: &[f64], step: f64) -> Result<State, Error> {
        self.check(state, load)?;
        check_duration("step", step)?;
        let (next, _) = self.stages(state, load, step, Self::substitute)?;
        if next.value.iter().all(|v| v.is_finite()) {
            return Ok(next);
        }
        Err(Error::Residual { backward_error: f64::NAN, limit: crate::BACKWARD_ERROR_LIMIT, unknowns: load.len() })
    }

    /// C⁻¹ f: what a sudden change of load by `f` adds to the rate.
    ///
    /// # Errors
    /// [`Error::Argument`] if the load has not one entry for each unknown; as [`Factor::new`].
    pub fn rate_of_load(&mut self, load: &[f64]) -> Result<Vec<f64>, Error> {
        Error::check_length("load", load, self.capacity.rows())?;
        // the matrix of a step of no length is C
        self.solve(0.0, load.to_vec())
    }

    /// Advances by `interval` \[s\], at least 0, under a constant load, in steps of `interval / 2^k` whose error is at most `tolerance`, above 0,
    /// each (largest entry of the value). `halvings` is the k, at most 30, to begin with and, on return, to go on with.
    ///
    /// The state's rate must be that under this load: add [`Self::rate_of_load`] of every change of load to it.
    ///
    /// # Errors
    /// [`Error::Argument`] if a number is outside its range, or the state or the load has not one entry for each unknown; as
    /// [`Factor::solve`]; [`Error::Step`] if even the smallest step is not accurate enough.
    pub fn advance(
        &mut self,
        state: &State,
        load: &[f64],
        interval: f64,
        tolerance: f64,
        halvings: &mut u32,
    ) -> Result<State, Error> {
        self.check(state, load)?;
        check_duration("interval", interval)?;
        check_control(tolerance, *halvings)?;
        let mut now = state.clone();
        // time in units of the smallest step, so that it stays exact
        let whole = 1u64 << MOST_HALVINGS;
        let mut done = 0u64;
        while done < whole {
            let units = whole >> *halvings;
            let (next, error) = self.estimated(&now, load, interval / (whole / units) as f64)?;
            let size = error.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
            if size > tolerance {
                self.effort.refused += 1;
                *halvings += 1;
                if *halvings > MOST_HALVINGS {
                    return Err(Error::Step { tolerance, step: interval / whole as f64 });
                }
                continue;
            }
            self.effort.steps += 1;
            done += units;
            now = next;
            // the error is of third order in the step; a doubled step must end on its own grid
            if *halvings > 0 && size < tolerance / ROOM && done.is_multiple_of(2 * units) {
                *halvings -= 1;
            }
        }
        Ok(now)
    }
}

fn check_patterns(capacity: &SparseMatrix, conductivity: &SparseMatrix) -> Result<(), Error> {
    if capacity.has_pattern_of(conductivity) {
        return Ok(());
    }
    let size = |matrix: &SparseMatrix| format!("{} × {}", matrix.rows(), matrix.columns());
    let (of_capacity, of_conductivity) = (size(capacity), size(conductivity));
    Err(Error::Argument(if of_capacity == of_conductivity {
        "the capacity and the conductivity have entries in different places; make both of one map, a law in the same regions"
            .into()
    } else {
        format!("the capacity is {of_capacity}, the conductivity {of_conductivity}; make both of one map")
    }))
}

fn check_duration(name: &str, seconds: f64) -> Result<(), Error> {
    if seconds.is_finite() && seconds >= 0.0 {
        return Ok(());
    }
    Err(Error::Argument(format!("the {name} is {seconds} s; it must be finite and at least 0")))
}

fn check_control(tolerance: f64, halvings: u32) -> Result<(), Error> {
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(Error::Argument(format!("the tolerance is {tolerance}; it must be above 0")));
    }
    if halvings > MOST_HALVINGS {
        return Err(Error::Argument(format!(
            "{halvings} halvings of the interval are given; they must be at most {MOST_HALVINGS}"
        )));
    }
    Ok(())
}

fn add(y: &[f64], terms: &[(f64, &Vec<f64>)]) -> Vec<f64> {
    let mut sum = y.to_vec();
    for (factor, term) in terms {
        sum.iter_mut().zip(term.iter()).for_each(|(s, t)| *s += factor * t);
    }
    sum
}
