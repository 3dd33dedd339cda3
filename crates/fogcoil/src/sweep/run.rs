//! The rows of a plan, in tasks.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use progress::Step;
use rayon::prelude::*;

use super::parts::Parts;
use super::plan::Plan;
use super::row::Row;
use crate::Error;

/// Points of a task: a second of computing, or so.
const TASK: usize = 32;

/// A share of a plan's tasks: the k-th of n.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Share {
    /// Number of this share, from 1.
    pub number: usize,
    /// Number of all shares.
    pub of: usize,
}

impl Share {
    /// All tasks in one share.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    fn of_tasks(self, tasks: usize) -> Range<usize> {
        let end = |number: usize| (number as u128 * tasks as u128 / self.of as u128) as usize;
        end(self.number - 1)..end(self.number)
    }
}

/// The ranges of points that a plan's tasks are.
fn ranges(count: usize) -> impl ExactSizeIterator<Item = Range<usize>> {
    (0..count.div_ceil(TASK)).map(move |task| task * TASK..count.min((task + 1) * TASK))
}

/// The rows of a share of the plan's tasks, in order; those that `parts` has are not computed again, the others are kept there.
///
/// # Errors
/// [`files::Error::Output`] if rows cannot be kept.
pub fn run(plan: &Plan, share: Share, parts: Option<&Parts>, progress: &(dyn Fn(Step) + Sync)) -> Result<Vec<Row>, Error> {
    const NAME: &str = "computing designs";
    let all: Vec<Range<usize>> = ranges(plan.count()).collect();
    let tasks = &all[share.of_tasks(all.len())];
    let count: usize = tasks.iter().map(Range::len).sum();
    let found: Vec<Option<Vec<Row>>> = tasks.iter().map(|range| parts?.load(range)).collect();
    let done = AtomicUsize::new(found.iter().flatten().map(Vec::len).sum());
    progress(Step::counted(NAME, done.load(Ordering::Relaxed), count));
    let task = |(range, found): (&Range<usize>, Option<Vec<Row>>)| {
        if let Some(rows) = found {
            return Ok(rows);
        }
        let tell = || progress(Step::counted(NAME, done.load(Ordering::Relaxed), count));
        let rows: Vec<Row> = range.clone().into_par_iter().inspect(|_| tell()).map(|number| row(plan, number)).collect();
        if let Some(parts) = parts {
            parts.keep(range, &rows)?;
        }
        done.fetch_add(rows.len(), Ordering::Relaxed);
        tell();
        Ok(rows)
    };
    let rows: Vec<Vec<Row>> = tasks.par_iter().zip(found).map(task).collect::<Result<_, Error>>()?;
    Ok(rows.concat())
}

/// The rows of a plan in order, as shares left them in `parts`: nothing is computed.
///
/// # Errors
/// [`files::Error::Usage`] if some are missing.
pub fn merged(plan: &Plan, parts: &Parts) -> Result<Vec<Row>, Error> {
    let (mut rows, mut missing) = (Vec::new(), Vec::new());
    for range in ranges(plan.count()) {
        match parts.load(&range) {
            Some(kept) => rows.extend(kept),
            None => missing.push(range),
        }
    }
    let Some(first) = missing.first() else { return Ok(rows) };
    let (count, folder) = (missing.iter().map(Range::len).sum::<usize>(), files::shown_path(parts.folder()));
    Err(Error::usage(format!(
        "{folder}: of {} rows of this plan by this program {count} are missing, the first from point {}; compute the shares that are not \
         finished, or leave out --merge to compute what is missing here (rows from before a change of the plan, of the design, of a cell that they name, or of \
         the program do not count)",
        plan.count(),
        first.start
    )))
}

/// Removes what was kept of a plan's rows.
pub fn clear(plan: &Plan, parts: &Parts) {
    parts.clear(ranges(plan.count()));
}

fn row(plan: &Plan, number: usize) -> Row {
    let computed = plan.variants.at(&plan.points.point(number)).and_then(|variant| {
        let tolerances = &plan.variants.case.tolerances;
        let outputs: Result<Vec<_>, coil::Error> =
            plan.outputs.iter().map(|output| output.of(&variant.design, tolerances)).collect();
        let outputs = outputs.map_err(|error| error.to_string())?.concat();
        match outputs.iter().flatten().all(|value| value.is_finite()) {
            true => Ok(Row { values: variant.values, outputs, problem: None }),
            false => Err("a result is no finite number".to_owned()),
        }
    });
    computed.unwrap_or_else(|problem| Row {
        values: plan.variants.values(&plan.points.point(number)),
        outputs: vec![None; plan.names().len()],
        problem: Some(problem),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_every_task_once() {
        for (tasks, of) in [(10, 3), (2, 5), (0, 2), (7, 1), (1000, 16)] {
            let all: Vec<usize> = (1..=of).flat_map(|number| Share { number, of }.of_tasks(tasks)).collect();
            assert!(all.into_iter().eq(0..tasks), "{tasks} {of}");
        }
        let points: Vec<usize> = ranges(70).flatten().collect();
        assert!(points.into_iter().eq(0..70));
    }
}
