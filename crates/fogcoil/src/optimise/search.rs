//! The search: all combinations of choices, points of a Sobol' sequence, then descents from the best.

use std::collections::HashSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use argmin::core::{CostFunction, Executor};
use argmin::solver::neldermead::NelderMead;
use progress::Step;
use rayon::prelude::*;

use super::evaluate::Tried;
use super::front::front;
use super::measure::Measure;
use super::plan::Plan;
use super::weigh::{NONE, weighed, weighings};
use crate::Error;
use crate::sweep::{Points, Sampling};

/// Result of a search.
pub struct Found {
    /// The drawing's numbers.
    pub drawn: super::measure::Measures,
    /// Every design that was tried, each once.
    pub all: Vec<Tried>,
    /// Points of the plan of which there is no design, and the first reason.
    pub failed: Option<(usize, String)>,
}

/// Descents for each weighing.
const DESCENTS: usize = 2;
/// First steps of a descent, in shares of a range.
const STEP: f64 = 0.15;
/// Trials of an iteration of the method, about.
const TRIALS_OF_ITERATION: f64 = 1.7;
/// Trials of a descent beyond its corners at least.
const LEAST_TRIALS: usize = 4;
/// Spread of what is weighed among a simplex at which a descent ends: what no drawing is made to.
const SETTLED: f64 = 1e-5;
/// Longest sequence of points.
const MOST_POINTS: usize = 1 << 16;

/// Searches a plan's designs.
///
/// # Errors
/// [`files::Error::Coil`] if the drawing cannot be modelled; [`files::Error::Usage`] if no design that was tried can be computed.
pub fn search(plan: &Plan, progress: &(dyn Fn(Step) + Sync)) -> Result<Found, Error> {
    let case = &plan.variants.case;
    let drawn = plan.measures(&case.design).map_err(Error::of_coil(&case.file))?;
    let done = AtomicUsize::new(0);
    let tell = || progress(Step::counted("trying designs", done.fetch_add(1, Ordering::Relaxed).min(plan.trials), plan.trials));
    let screened: Vec<Result<Tried, String>> = screening(plan)
        .par_iter()
        .map(|point| {
            tell();
            plan.tried(point)
        })
        .collect();
    let (screened, problems): (Vec<_>, Vec<_>) = screened.into_iter().partition(Result::is_ok);
    let screened: Vec<Tried> = screened.into_iter().flatten().collect();
    let problems: Vec<String> = problems.into_iter().filter_map(Result::err).collect();
    if screened.is_empty() {
        let first = problems.first().map_or(String::new(), |first| format!("; of the first: {first}"));
        return Err(Error::usage(format!(
            "no design of the plan can be computed; vary less, or give dimensions: FollowWinding{first}"
        )));
    }
    let failed = problems.first().map(|first| (problems.len(), first.clone()));
    let scales: Vec<f64> = plan.minimise.iter().map(|measure| scale(measure.of(&drawn))).collect();
    let left = plan.trials.saturating_sub(screened.len());
    let descents = starts(plan, &screened, &scales, left);
    let iterations = iterations(plan, left / descents.len().max(1));
    let descend = |(start, weights): &(usize, Vec<f64>)| {
        Descent { plan, start: &screened[*start], weights, scales: &scales, tell: &tell, trail: Mutex::default() }.run(iterations)
    };
    let followed: Vec<Vec<Tried>> = descents.par_iter().map(descend).collect();
    let mut all = [vec![screened], followed].concat().concat();
    all.extend(on_the_way(plan, &all));
    Ok(Found { drawn, all: each_once(all), failed })
}

/// Every design once: of whole numbers, points beside each other are one design.
fn each_once(all: Vec<Tried>) -> Vec<Tried> {
    let mut known = HashSet::new();
    let mut is_new = |tried: &Tried| {
        let own: Vec<String> = tried.values.iter().map(|value| format!("{value:?}")).collect();
        known.insert(own)
    };
    all.into_iter().filter(|tried| is_new(tried)).collect()
}

/// The designs on the way from the drawing to the best one, change by change, as far as the plan has them: one of them may be better than it.
fn on_the_way(plan: &Plan, all: &[Tried]) -> Vec<Tried> {
    let Some(best) = front(all, &plan.minimise).first().map(|n| &all[*n]) else { return Vec::new() };
    let drawn = plan.variants.drawn();
    let step = |changed: usize| {
        let mut point = best.point.clone();
        for n in changed..point.len() {
            point[n] = drawn[n]?;
        }
        Some(point).filter(|point| *point != best.point)
    };
    let steps: Vec<Vec<f64>> = (0..best.point.len()).filter_map(step).collect();
    steps.par_iter().filter_map(|point| plan.tried(point).ok()).collect()
}

/// Iterations of a descent of so many trials, its corners among them.
fn iterations(plan: &Plan, trials: usize) -> u64 {
    (trials.saturating_sub(corners(plan)) as f64 / TRIALS_OF_ITERATION) as u64
}

/// Corners of a descent's simplex.
fn corners(plan: &Plan) -> usize {
    numbers(plan).len() + 1
}

/// A number of the drawing that others are measured by; 1 where it is nothing.
fn scale(drawn: f64) -> f64 {
    if drawn > 0.0 { drawn } else { 1.0 }
}

/// Places of the factors that are numbers.
fn numbers(plan: &Plan) -> Vec<usize> {
    plan.variants.factors.iter().enumerate().filter(|(_, factor)| !factor.is_choice()).map(|(n, _)| n).collect()
}

/// Every combination of choices in turn, each time with the next point of a sequence; half of the trials, or each combination once where nothing else varies.
fn screening(plan: &Plan) -> Vec<Vec<f64>> {
    let factors = &plan.variants.factors;
    let numbers = numbers(plan);
    let levels: Vec<usize> = factors.iter().filter(|f| f.is_choice()).map(|f| f.levels().unwrap_or(1)).collect();
    let grid = Points::new(Sampling::Grid, plan.seed, levels.clone(), vec![0; levels.len()]);
    let combinations = grid.count().unwrap_or(1).max(1);
    let count = if numbers.is_empty() { combinations } else { combinations.max(plan.trials / 2).min(MOST_POINTS) };
    let sequence = Points::new(Sampling::Sobol(count), plan.seed, Vec::new(), vec![0; numbers.len()]);
    let point = |n: usize| {
        let (mut chosen, mut free) = (grid.point(n % combinations).into_iter(), sequence.point(n).into_iter());
        factors.iter().map(|f| if f.is_choice() { chosen.next() } else { free.next() }.unwrap_or(0.5)).collect()
    };
    (0..count).map(point).collect()
}

/// Places of the designs from which descents start, with the weights of each: the best of each weighing, of other choices each; as many as `left`
/// trials are enough for, the best ones and those of the first measure before others.
fn starts(plan: &Plan, screened: &[Tried], scales: &[f64], left: usize) -> Vec<(usize, Vec<f64>)> {
    let numbers = numbers(plan);
    if numbers.is_empty() {
        return Vec::new();
    }
    let choices = |tried: &Tried| {
        (0..tried.point.len()).filter(|n| !numbers.contains(n)).map(|n| tried.point[n].to_bits()).collect::<Vec<_>>()
    };
    let mut all = Vec::new();
    for weights in weighings(plan.minimise.len()).into_iter().rev() {
        let mut order: Vec<usize> = (0..screened.len()).collect();
        let cost = |n: &usize| weighed(&screened[*n], &plan.minimise, scales, &weights);
        order.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        let mut known: Vec<Vec<u64>> = Vec::new();
        for n in order {
            let own = choices(&screened[n]);
            if known.len() < DESCENTS && !known.contains(&own) {
                all.push((known.len(), n, weights.clone()));
                known.push(own);
            }
        }
    }
    all.sort_by_key(|(rank, ..)| *rank);
    all.truncate(left / (corners(plan) + LEAST_TRIALS));
    all.into_iter().map(|(_, n, weights)| (n, weights)).collect()
}

/// A descent by the Nelder–Mead method over the numbers, the choices as they are.
struct Descent<'a> {
    plan: &'a Plan,
    start: &'a Tried,
    weights: &'a [f64],
    scales: &'a [f64],
    tell: &'a (dyn Fn() + Sync),
    /// Designs on the way.
    trail: Mutex<Vec<Tried>>,
}

impl Descent<'_> {
    /// The designs on its way.
    fn run(self, iterations: u64) -> Vec<Tried> {
        let origin: Vec<f64> = numbers(self.plan).iter().map(|n| self.start.point[*n]).collect();
        let corner = |n: usize| {
            let mut corner = origin.clone();
            corner[n] += if corner[n] + STEP <= 1.0 { STEP } else { -STEP };
            corner
        };
        let simplex = std::iter::once(origin.clone()).chain((0..origin.len()).map(corner)).collect();
        let solver = NelderMead::new(simplex).with_sd_tolerance(SETTLED);
        if let (Ok(solver), true) = (solver, iterations > 0) {
            let executor = Executor::new(&self, solver).configure(|state| state.max_iters(iterations));
            // what it met on its way is kept, however it ends
            let _ = executor.run();
        }
        self.trail.into_inner().unwrap_or_default()
    }

    fn cost_at(&self, free: &[f64]) -> f64 {
        (self.tell)();
        let mut point = self.start.point.clone();
        for (n, u) in numbers(self.plan).into_iter().zip(free) {
            point[n] = u.clamp(0.0, 1.0);
        }
        let beyond: f64 = free.iter().map(|u| (u - u.clamp(0.0, 1.0)).abs()).sum();
        let Ok(tried) = self.plan.tried(&point) else { return NONE * (1.0 + beyond) };
        let minimise: &[Measure] = &self.plan.minimise;
        let cost = weighed(&tried, minimise, self.scales, self.weights);
        if let Ok(mut trail) = self.trail.lock() {
            trail.push(tried);
        }
        cost + beyond
    }
}

impl CostFunction for &Descent<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, free: &Self::Param) -> Result<f64, argmin::core::Error> {
        Ok(self.cost_at(free))
    }
}
