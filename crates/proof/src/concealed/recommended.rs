//! Whether what is recommended tells mechanisms apart.

use std::fmt::Write as _;

use fogcoil::cache::Cache;
use fogcoil::comparison::{Comparison, Trial};
use fogcoil::input;

use super::report;
use crate::files::root;
use crate::generator::Random;
use crate::{Failure, program, statistics};

const SEED: u64 = 1;
/// Share of the separable pairs that the recommendation has to separate.
const ASKED: f64 = 0.8;

/// Tries what is recommended for every pair of mechanisms; writes its section of docs/proof.md. Whether it separates as many as asked.
pub(super) fn run() -> Result<bool, Failure> {
    let program = program::hash(&root())?;
    let (coil, cache) = (input::read_coil(&root().join("fixtures/concealed/coil.ron"))?, Cache::of_user());
    let say = |step: progress::Step| eprintln!("{step}");
    let comparison = Comparison::measure(&coil, &cache, &say)?;
    let mut random = Random::new(SEED, 0);
    let trials = comparison.trials(&coil, &cache, &mut || random.normal(), &say)?;
    let separable: Vec<&Trial> = trials.iter().filter(|t| t.is_separable()).collect();
    let share = |which: usize| {
        let count = separable.iter().filter(|t| t.separated()[which]).count();
        let measured = statistics::rate(count, separable.len());
        let [low, high] = measured.map_or([f64::NAN; 2], |m| m.interval);
        let value = count as f64 / separable.len().max(1) as f64;
        (value, format!("{count} of {}: {:.0} % [{:.0} to {:.0}]", separable.len(), 100.0 * value, 100.0 * low, 100.0 * high))
    };
    let ((value, recommended), (_, repeated)) = (share(0), share(1));
    let mut out = format!(
        "Of {} pairs of mechanisms at typical sizes, {} are expected to be told apart by one of the programmes (ln odds of 3.5 either way). \
         One record of the recommended programme is made with either at work, and usual noise (seed {SEED}); both mechanisms are fitted to it, with their \
         noise; the pair is separated if both records have more evidence for what was at work. The records are made by the forward model that fits them: \
         this is about the recommendation, not the model.\n\n| | separated [90 %] | asked |\n|---|---|---|\n| the recommended programme | {recommended} | \
         ≥ {:.0} % |\n| the slow ramp again | {repeated} | |\n",
        trials.len(),
        separable.len(),
        100.0 * ASKED
    );
    let failed: Vec<&&Trial> = separable.iter().filter(|t| !t.separated()[0]).collect();
    if !failed.is_empty() {
        let _ = writeln!(out, "\nNot separated:\n");
    }
    for t in failed {
        let [a, b] = &t.pair;
        let [x, y] = t.found[0];
        let _ = writeln!(out, "- {a} and {b} by the {}: expected {:.1}, found {x:.1} and {y:.1}", t.programme, t.expected);
    }
    let others: Vec<String> = trials.iter().filter(|t| !t.is_separable()).map(|t| t.pair.join(" and ")).collect();
    let _ = writeln!(out, "\nNot expected to be separable: {}.", others.join("; "));
    report::publish("recommended", &program, &out)?;
    println!("{out}");
    Ok(value >= ASKED)
}
