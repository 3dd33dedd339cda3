//! `cargo xtask prove --posteriors`: the 90 % intervals of Laplace's method against a sampler's, on ten ordinary units.

use std::fmt::Write as _;

use fogcoil::cache::Cache;
use fogcoil::diagnose;

use super::{drawing, folder};
use crate::concealed::{each, publish, record, short};
use crate::files::root;
use crate::three_records::FITTED;
use crate::{Failure, program};
use diagnosis::{Place, Sampled};

/// Good units, one mechanism of every kind that the open units have, and some that nobody listed.
const UNITS: [&str; 10] = [
    "A/open/U1847",
    "A/open/U7852",
    "A/open/U9990",
    "B/open/U8378",
    "B/open/U8618",
    "B/open/U9614",
    "C/open/U5546",
    "C/open/U7198",
    "C/open/U7337",
    "C/open/U7583",
];
/// Steps of each walk.
const STEPS: usize = 6000;
const SEED: u64 = 1;
/// Range of the share of samples within Laplace's interval, where walks agree, for an interval to hold.
const HOLDS: [f64; 2] = [0.8, 0.97];
/// Disagreement of walks, and fewest independent samples, beyond which nothing is said of an unknown.
const AGREE: f64 = 1.1;
const FEWEST: f64 = 100.0;
/// Share of the intervals that must hold, and of the unknowns of which walks must tell.
const MOST: f64 = 0.95;
const TOLD: f64 = 0.75;

fn told(unknown: &Sampled) -> bool {
    unknown.disagreement < AGREE && unknown.effective > FEWEST
}

fn holds(unknown: &Sampled) -> bool {
    (HOLDS[0]..=HOLDS[1]).contains(&unknown.inside)
}

/// Samples the best explanation of ten units; writes the section of docs/proof.md. Whether the intervals of 95 of 100 unknowns hold.
pub(crate) fn run() -> Result<bool, Failure> {
    let (program, cache) = (program::hash(&root())?, Cache::of_user());
    let found = each(&UNITS.map(str::to_owned), |unit| {
        let fitted = FITTED.map(|file| record(&folder().join(unit).join(file)));
        let fitted = fitted.into_iter().collect::<Result<Vec<_>, _>>()?;
        let outcome = diagnose::diagnose(&drawing(unit)?, mechanisms::CATALOGUE, &[], &fitted, &[], &cache, &|_| ())?;
        let samples = outcome.sampled(STEPS, SEED)?;
        eprintln!("{unit}: {} minima, {:.0} % of the steps are taken", samples.minima, 100.0 * samples.taken);
        Ok((outcome.hypothesis(), samples))
    })?;
    let mut out = String::from(
        "| unit | hypothesis | minima | steps taken | unknowns | walks agree | of them, interval holds | least and most inside | the mechanism's own: Laplace, sampler |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    let (mut all, mut held, mut unknowns) = (0, 0, 0);
    let (mut own_all, mut own_held) = (0, 0);
    for (unit, (hypothesis, samples)) in UNITS.iter().zip(&found) {
        let agreed: Vec<&Sampled> = samples.unknowns.iter().filter(|unknown| told(unknown)).collect();
        let holding = agreed.iter().filter(|unknown| holds(unknown)).count();
        (all, held, unknowns) = (all + agreed.len(), held + holding, unknowns + samples.unknowns.len());
        let of_mechanism = |unknown: &&&Sampled| matches!(unknown.laplace.place, Place::Mechanism(_));
        own_all += agreed.iter().filter(of_mechanism).count();
        own_held += agreed.iter().filter(of_mechanism).filter(|unknown| holds(unknown)).count();
        let least = agreed.iter().map(|unknown| unknown.inside).fold(f64::INFINITY, f64::min);
        let most = agreed.iter().map(|unknown| unknown.inside).fold(0.0, f64::max);
        let own = samples.unknowns.iter().filter(|unknown| matches!(unknown.laplace.place, Place::Mechanism(_)));
        let said: Vec<String> = own
            .map(|unknown| {
                let ([a, b], [c, d]) = (unknown.laplace.ci90(), unknown.ci90);
                let doubt = if told(unknown) { "" } else { " (walks apart)" };
                format!("`{}` {} to {}, {} to {}{doubt}", unknown.laplace.name, short(a), short(b), short(c), short(d))
            })
            .collect();
        let _ = writeln!(
            out,
            "| {unit} | {hypothesis} | {} | {:.0} % | {} | {} | {holding} | {least:.2}, {most:.2} | {} |",
            samples.minima,
            100.0 * samples.taken,
            samples.unknowns.len(),
            agreed.len(),
            said.join("; ")
        );
    }
    let share = held as f64 / (all as f64).max(1.0);
    let told = all as f64 / (unknowns as f64).max(1.0);
    let _ = writeln!(
        out,
        "\n{held} of {all} intervals, {own_held} of {own_all} of mechanisms' own numbers, hold between {:.0} and {:.0} % of the samples ({:.1} %, asked {:.0} %); an unknown counts where the walks agree to a factor of {AGREE} of their spread and \
         tell as much as {FEWEST:.0} independent samples, as they do of {:.0} % (asked {:.0} %).",
        100.0 * HOLDS[0],
        100.0 * HOLDS[1],
        100.0 * share,
        100.0 * MOST,
        100.0 * told,
        100.0 * TOLD
    );
    publish("posteriors", &program, &out)?;
    println!("{out}");
    Ok(share >= MOST && told >= TOLD)
}
