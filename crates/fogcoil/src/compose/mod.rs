//! Laws composed where no mechanism of the library explains a record.

mod laws;

use diagnosis::{Diagnosis, Estimate, Fit, ForwardModel, HeldOut, Judged, Observation, Settings, Verdict};
use mechanisms::{Gyro, Mechanism, RATE};
use progress::Step;
use serde_json::{Value, json};

use crate::Error;
use crate::input::{MechanismCase, check_mechanism};
use laws::{Law, Ranges};

/// A composed law of one or two terms, with its sizes.
pub(crate) struct Composed {
    terms: Vec<Term>,
    /// Its fit, constants and sensors free.
    pub(crate) fit: Fit,
    gain: f64,
    /// titles and ids of laws that the records hardly tell from the last, and by how much ln evidence they are behind
    others: Vec<(String, String, f64)>,
    /// Its prediction of each held-out record.
    pub(crate) held: Vec<HeldOut>,
    /// Whether it predicts every held-out record better, and there is one.
    pub(crate) accepted: bool,
}

/// A term of a law.
struct Term {
    case: MechanismCase,
    known: &'static str,
    values: Vec<f64>,
    estimates: Vec<Estimate>,
}

/// Laws that were found beside a hypothesis, with their predictions of the held-out records.
struct Found {
    law: diagnosis::Composed,
    /// ln of the prior probability of any laws beside it
    log_prior: f64,
    held: Vec<HeldOut>,
}

impl Found {
    fn log_weight(&self) -> f64 {
        self.law.log_weight(self.log_prior)
    }

    /// Whether records held out are predicted clearly better with the names beside this law than by another law alone, and none clearly worse; where no
    /// record was held out, the fitted ones alone have said so.
    fn bears_out_names_over(&self, alone: &Self) -> bool {
        let pairs = || self.held.iter().zip(&alone.held);
        let better = pairs().any(|(with, alone)| alone.clearly_worse_than(with, RATE));
        let worse = pairs().any(|(with, alone)| with.clearly_worse_than(alone, RATE));
        self.held.is_empty() || (better && !worse)
    }
}

/// ln evidence by which another law is behind and still not excluded, as odds of 1 to 20.
const NEAR: f64 = 3.0;

/// Composes a law for the residual of a diagnosis, unknown or named; `None` where there is none, no law gains enough, or a name is likelier. `held` are
/// the held-out records, by their numbers, and `judged` their predictions without a law.
pub(crate) fn compose(
    gyro: &Gyro,
    diagnosis: &mut Diagnosis,
    settings: &Settings,
    fitted: &[Observation],
    held: &[(usize, &Observation)],
    judged: &[Judged],
    progress: &dyn Fn(Step),
) -> Result<Option<Composed>, diagnosis::Error<coil::Error>> {
    if !matches!(diagnosis.verdict, Verdict::Unknown | Verdict::Explained) {
        return Ok(None);
    }
    // beside the constants, and beside a mechanism that has a name if it leaves something
    let constants = diagnosis.candidates.iter().find(|c| c.is_constants_alone());
    let named = diagnosis.is_beside_named(gyro).then(|| diagnosis.best());
    let ranges = ranges(gyro, fitted);
    let laws: Vec<Law> = laws::laws(&ranges);
    // each is a file that the program has written: none is refused
    let read = |law: &Law| Some((check_mechanism("composed".as_ref(), law.text.clone()).ok()?, law.known));
    let cases: Vec<(MechanismCase, &'static str)> = laws.iter().filter_map(read).collect();
    let kinds: Vec<&dyn Mechanism> = cases.iter().map(|(case, _)| &case.mechanism as &dyn Mechanism).collect();
    let first = gyro.mechanisms().len();
    let with = gyro.beside(&kinds);
    let all = first..with.mechanisms().len();
    let numbers: Vec<usize> = (0..fitted.len()).collect();
    let mut all_found: Vec<Found> = Vec::new();
    for beside in constants.into_iter().chain(named) {
        if let Some(law) = diagnosis::compose(&with, all.clone(), &numbers, fitted, &beside.fit, progress)? {
            // in the noise in which the others are judged
            let predicted =
                |&(record, observed): &(usize, &Observation)| law.fit.hold_out(&with, record, observed, &diagnosis.best().fit);
            let held = held.iter().map(predicted).collect::<Result<Vec<_>, _>>()?;
            all_found.push(Found { log_prior: settings.log_unlisted(gyro, &beside.fit.hypothesis), law, held });
        }
    }
    all_found.sort_by(|a, b| b.log_weight().total_cmp(&a.log_weight()));
    let mut all_found = all_found.into_iter();
    let Some(likeliest) = all_found.next() else { return Ok(None) };
    let (log_weight, mut names) = (likeliest.log_weight(), likeliest.law.names());
    // a name beside a law has to be borne out, as the law has
    let chosen = match all_found.next() {
        Some(alone) if !names.is_empty() && !likeliest.bears_out_names_over(&alone) => {
            names.clear();
            alone
        }
        _ => likeliest,
    };
    let Found { law: found, held: predictions, .. } = chosen;
    let own = found.fit.active.iter().enumerate().skip(found.fit.active.len() - found.laws);
    let mut terms = Vec::new();
    for (place, active) in own {
        let id = &with.mechanisms()[active.mechanism].id;
        let Some((case, known)) = cases.iter().find(|(case, _)| case.mechanism.id == *id) else { continue };
        let estimates = found.fit.estimates(&with, place);
        terms.push(Term { case: case.clone(), known, values: active.values.clone(), estimates });
    }
    let other = |(law, behind): &(usize, f64)| {
        let facts = with.mechanism(*law).facts();
        (*behind < NEAR).then(|| (facts.title.to_owned(), facts.id.to_owned(), *behind))
    };
    let others = found.others.iter().filter_map(other).collect();
    let accepted =
        !held.is_empty() && judged.iter().zip(&predictions).all(|(without, by_law)| without.is_beaten_by(by_law, RATE));
    let by_held_out = judged.iter().zip(&predictions).map(|(without, by_law)| without.model.log_score - by_law.log_score).sum();
    // what has a name gives way to a law that is likelier by all records; what has none, unless a record that was held out says otherwise
    let is_named = diagnosis.verdict == Verdict::Explained;
    if is_named || accepted || held.is_empty() {
        let by_noise = diagnosis::gained_by_noise_of(gyro, &numbers, fitted, diagnosis.best(), &found.fit)?;
        diagnosis.weigh_unlisted(log_weight, &names, by_noise, if is_named { by_held_out } else { 0.0 });
    }
    if diagnosis.verdict == Verdict::Explained {
        return Ok(None);
    }
    Ok(Some(Composed { terms, fit: found.fit, gain: found.gain, others, held: predictions, accepted }))
}

fn ranges(gyro: &Gyro, fitted: &[Observation]) -> Ranges {
    let states = || (0..fitted.len()).map(|record| gyro.state(record));
    let rate = states().flat_map(|state| &state.rate).fold(0.0_f64, |most, rate| most.max(rate.abs()));
    let span = |o: &Observation| o.time.last().zip(o.time.first()).map_or(0.0, |(last, first)| last - first);
    let duration = fitted.iter().map(span).fold(0.0, f64::max);
    Ranges::new(gyro.scene(), rate, duration, gyro.largest_parts(fitted.len()))
}

impl Composed {
    /// The law with its sizes as mechanisms' files: names and texts.
    pub(crate) fn files(&self) -> Result<Vec<(String, String)>, Error> {
        let of = |term: &Term| Ok((term.case.mechanism.id.clone(), term.case.with_values(&term.values)?));
        self.terms.iter().map(of).collect()
    }

    /// The law as one JSON object.
    pub(crate) fn json(&self) -> Value {
        let term = |term: &Term| {
            let parameters: serde_json::Map<String, Value> =
                term.estimates.iter().map(|e| (e.name.clone(), json!({"value": e.value, "ci90": e.ci90}))).collect();
            json!({
                "id": term.case.mechanism.id,
                "title": term.case.mechanism.title,
                "stage": term.case.mechanism.stage.name(),
                "equation": term.case.mechanism.equation,
                "known_physics": term.known,
                "parameters": parameters,
            })
        };
        json!({
            "terms": self.terms.iter().map(term).collect::<Vec<_>>(),
            "gain": self.gain,
            "others": self.others.iter().map(|(_, id, behind)| json!({"id": id, "behind": behind})).collect::<Vec<_>>(),
            "accepted": self.accepted,
        })
    }

    /// The law as text: its meaning, its form, its numbers.
    pub(crate) fn text(&self) -> (String, Vec<Estimate>) {
        let mut out = String::new();
        for (k, term) in self.terms.iter().enumerate() {
            let mechanism = &term.case.mechanism;
            let begins = if k == 0 { "A law was composed" } else { "and beside it" };
            out += &format!("{begins}: {} (known physics of this form: {}).\n", mechanism.title, term.known);
            out.extend(mechanism.equation.lines().map(|line| format!("  {line}\n")));
        }
        let by = format!("It gains {:.1} of ln evidence, the choice among all laws paid for", self.gain);
        let others: Vec<String> = self.others.iter().map(|(title, _, behind)| format!("{title} ({behind:.1} behind)")).collect();
        let others =
            if others.is_empty() { String::new() } else { format!("; these records hardly tell it from {}", others.join(", ")) };
        let judged = match (self.held.is_empty(), self.accepted) {
            (true, _) => "no record was held out to judge it: give one with --holdout",
            (false, true) => "accepted: it predicts what was held out better than the design and than its constants re-estimated",
            (false, false) => {
                "not accepted: it does not predict what was held out better than the design and than its constants re-estimated"
            }
        };
        out += &format!("{by}{others}; {judged}.\n");
        (out, self.terms.iter().flat_map(|term| term.estimates.clone()).collect())
    }
}
