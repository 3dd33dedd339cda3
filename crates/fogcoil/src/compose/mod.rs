//! Laws composed where no mechanism of the library explains a record.

mod laws;

use std::ops::Range;

use diagnosis::{Active, Candidate, Diagnosis, Estimate, Fit, ForwardModel, HeldOut, Judged, Observation, Settings, Verdict};
use mechanisms::{Gyro, Mechanism, RATE, Scene};
use progress::Step;
use serde_json::{Value, json};

use crate::Error;
use crate::input::{MechanismCase, check_mechanism};
use crate::table::significant;
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

/// The laws that were composed for a diagnosis.
pub(crate) struct Sought {
    /// For what it leaves unknown; `None` where it leaves nothing, no law gains enough, or a name is likelier.
    pub(crate) composed: Option<Composed>,
    /// In the place of each name that is likelier than not.
    pub(crate) stand_ins: Vec<StandIn>,
}

/// The likeliest law in the place of a mechanism that has a name.
pub(crate) struct StandIn {
    /// The mechanism's id.
    pub(crate) of: String,
    id: String,
    title: String,
    known: &'static str,
    /// ln evidence of all records by which the law is behind
    behind: f64,
    /// probability of the mechanism against the law, both as likely beforehand
    share: f64,
    /// Probability that the law took from the mechanism.
    pub(crate) taken: f64,
}

/// A term of a law.
struct Term {
    case: MechanismCase,
    known: &'static str,
    values: Vec<f64>,
    estimates: Vec<Estimate>,
}

/// Share of the records' temperatures that a knee leaves below it at most where nobody sees it, and by how many noises of a reading of a minute the law then
/// differs from a straight line at most.
const EDGE: f64 = 0.1;
const UNSEEN: f64 = 3.0;
/// What has the form of a knee that is not seen.
const STRAIGHT: &str = "a straight line over these records, as a temperature coefficient of the read-out makes; the knee lies at their cold end and is not seen";

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

type Failure = diagnosis::Error;

/// ln evidence by which another law is behind and still not excluded, as odds of 1 to 20.
const NEAR: f64 = 3.0;

/// Probability from which a name is put to the test by a law in its place: one that is less likely than not claims nothing.
const LIKELIER_THAN_NOT: f64 = 0.5;

/// Composes a law for the residual of a diagnosis, unknown or named, and one in the place of each name. `held` are the held-out records, by their numbers,
/// and `judged` their predictions without a law.
pub(crate) fn compose(
    gyro: &Gyro,
    diagnosis: &mut Diagnosis,
    settings: &Settings,
    fitted: &[Observation],
    held: &[(usize, &Observation)],
    judged: &[Judged],
    progress: &dyn Fn(Step),
) -> Result<Sought, Failure> {
    if !matches!(diagnosis.verdict, Verdict::Unknown | Verdict::Explained) {
        return Ok(Sought { composed: None, stand_ins: Vec::new() });
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
    let numbers: Vec<usize> = (0..fitted.len()).collect();
    let judge = diagnosis.best().fit.clone();
    let laws = first..with.mechanisms().len();
    let search = Search { with, cases: &cases, laws, numbers: &numbers, fitted, held, judge };
    let mut all_found: Vec<Found> = Vec::new();
    for beside in constants.into_iter().chain(named) {
        let log_prior = settings.log_unlisted(gyro, &beside.fit.hypothesis);
        all_found.extend(search.found(&beside.fit, log_prior, progress)?);
    }
    let chosen = chosen(all_found);
    let accepted = chosen.as_ref().is_some_and(|Chosen { found, .. }| {
        !held.is_empty() && judged.iter().zip(&found.held).all(|(without, by_law)| without.is_beaten_by(by_law, RATE))
    });
    let by_best = judged.iter().map(|judged| judged.model.log_score).sum();
    let mut answers = vec![(diagnosis.best().clone(), by_best)];
    if let Some(Chosen { found, log_weight, names }) = &chosen {
        let by_law = log_score(&found.held);
        // what has a name gives way to a law that is likelier by all records; what has none, unless a record that was held out says otherwise
        let is_named = diagnosis.verdict == Verdict::Explained;
        if is_named || accepted || held.is_empty() {
            let by_noise = diagnosis::gained_by_noise_of(gyro, &numbers, fitted, diagnosis.best(), &found.law.fit)?;
            diagnosis.weigh_unlisted(*log_weight, names, by_noise, if is_named { by_best - by_law } else { 0.0 });
        }
        let beside_law = Candidate { fit: found.law.fit.clone(), rival: None, ..diagnosis.best().clone() };
        answers.push((beside_law, by_law));
    }
    let mut stand_ins = Vec::new();
    for mechanism in likely_names(gyro, diagnosis) {
        // in the answer that holds it, of several the last
        let holds = |(answer, _): &&(Candidate, f64)| answer.fit.hypothesis.has(mechanism);
        let Some((answer, score)) = answers.iter().rev().find(holds) else { continue };
        if let Some(mut stand_in) = search.stand_in(mechanism, answer, *score)? {
            let probability = |d: &Diagnosis| d.mechanisms.iter().find(|(m, _)| *m == mechanism).map_or(0.0, |(_, p)| *p);
            let before = probability(diagnosis);
            stand_in.share = diagnosis.doubt(mechanism, stand_in.behind);
            stand_in.taken = before - probability(diagnosis);
            stand_ins.push(stand_in);
        }
    }
    let unknown = chosen.filter(|_| diagnosis.verdict != Verdict::Explained);
    Ok(Sought { composed: unknown.map(|chosen| search.told(chosen.found, accepted)), stand_ins })
}

/// The search among laws: the model with all of them beside the library, and the records.
struct Search<'a> {
    with: Gyro<'a>,
    /// each law, and the known physics of its form
    cases: &'a [(MechanismCase, &'static str)],
    /// their numbers in the model
    laws: Range<usize>,
    numbers: &'a [usize],
    fitted: &'a [Observation],
    held: &'a [(usize, &'a Observation)],
    /// in whose noise records held out are judged
    judge: Fit,
}

impl Search<'_> {
    fn predicted(&self, fit: &Fit) -> Result<Vec<HeldOut>, Failure> {
        self.held.iter().map(|(record, observed)| fit.hold_out(&self.with, *record, observed, &self.judge)).collect()
    }

    /// Laws beside a fit.
    fn found(&self, beside: &Fit, log_prior: f64, progress: &dyn Fn(Step)) -> Result<Option<Found>, Failure> {
        let Self { with, laws, numbers, fitted, .. } = self;
        let law = diagnosis::compose(with, laws.clone(), numbers, fitted, beside, progress)?;
        law.map(|law| Ok(Found { log_prior, held: self.predicted(&law.fit)?, law })).transpose()
    }

    /// The likeliest law in the place of a mechanism of an answer, which predicts the records held out with this ln of their density.
    fn stand_in(&self, mechanism: usize, answer: &Candidate, log_score: f64) -> Result<Option<StandIn>, Failure> {
        let Self { with, laws, numbers, fitted, .. } = self;
        let Some(law) = diagnosis::in_place_of(with, laws, numbers, fitted, &answer.fit, mechanism)? else { return Ok(None) };
        let by_noise = diagnosis::gained_by_noise_of(with, numbers, fitted, answer, &law)?;
        let by_held_out = log_score - self::log_score(&self.predicted(&law)?);
        let behind = answer.log_evidence() + by_noise + by_held_out - law.log_evidence;
        let of = with.mechanisms()[mechanism].id.clone();
        Ok(law.hypothesis.mechanisms.last().map(|(law, _)| {
            let facts = with.mechanism(*law).facts();
            let known = self.case(facts.id).map_or("", |(_, known)| known);
            StandIn { of, id: facts.id.to_owned(), title: facts.title.to_owned(), known, behind, share: 1.0, taken: 0.0 }
        }))
    }

    fn case(&self, id: &str) -> Option<&(MechanismCase, &'static str)> {
        self.cases.iter().find(|(case, _)| case.mechanism.id == id)
    }

    /// Whether a term is a knee that lies so near the cold end of its temperature that the records see a straight line.
    fn is_straight(&self, id: &str, estimates: &[Estimate]) -> bool {
        let Scene { temperatures, noise, .. } = *self.with.scene();
        let range = if id == "composed-knee-chamber" { self.with.chamber_range(self.fitted.len()) } else { temperatures };
        is_straight(id, estimates, range, noise)
    }

    /// Laws as they are told.
    fn told(&self, found: Found, accepted: bool) -> Composed {
        let Found { law: diagnosis::Composed { fit, laws, gain, others, .. }, held, .. } = found;
        // judged by the noise that it leaves itself: that of the search has swallowed what the law explains
        let by_itself = || {
            self.held
                .iter()
                .map(|(record, observed)| fit.hold_out(&self.with, *record, observed, &fit))
                .collect::<Result<Vec<_>, _>>()
        };
        let held = if accepted { by_itself().unwrap_or(held) } else { held };
        let own = fit.active.iter().enumerate().skip(fit.active.len() - laws);
        let term = |(place, active): (usize, &Active)| {
            let (case, known) = self.case(&self.with.mechanisms()[active.mechanism].id)?;
            let estimates = fit.estimates(&self.with, place);
            let known = if self.is_straight(&case.mechanism.id, &estimates) { STRAIGHT } else { known };
            Some(Term { case: case.clone(), known, values: active.values.clone(), estimates })
        };
        let other = |(law, behind): &(usize, f64)| {
            let facts = self.with.mechanism(*law).facts();
            (*behind < NEAR).then(|| (facts.title.to_owned(), facts.id.to_owned(), *behind))
        };
        let (terms, others) = (own.filter_map(term).collect(), others.iter().filter_map(other).collect());
        Composed { terms, fit, gain, others, held, accepted }
    }
}

/// Laws to be told, their weight, and the names beside them.
struct Chosen {
    found: Found,
    log_weight: f64,
    names: Vec<usize>,
}

/// Of laws that were found, beside names or alone, those to be told.
fn chosen(mut found: Vec<Found>) -> Option<Chosen> {
    found.sort_by(|a, b| b.log_weight().total_cmp(&a.log_weight()));
    let mut found = found.into_iter();
    let likeliest = found.next()?;
    let (log_weight, names) = (likeliest.log_weight(), likeliest.law.names());
    // a name beside a law has to be borne out, as the law has
    match found.next() {
        Some(alone) if !names.is_empty() && !likeliest.bears_out_names_over(&alone) => {
            Some(Chosen { found: alone, log_weight, names: Vec::new() })
        }
        _ => Some(Chosen { found: likeliest, log_weight, names }),
    }
}

/// ln of the probability density of records that were held out.
fn log_score(held: &[HeldOut]) -> f64 {
    held.iter().map(|held| held.log_score).sum()
}

/// Mechanisms with a name that are likelier than not.
fn likely_names(gyro: &Gyro, diagnosis: &Diagnosis) -> Vec<usize> {
    let likely = diagnosis.mechanisms.iter().filter(|(m, p)| *p >= LIKELIER_THAN_NOT && gyro.mechanisms()[*m].named);
    likely.map(|(m, _)| *m).collect()
}

fn ranges(gyro: &Gyro, fitted: &[Observation]) -> Ranges {
    let states = || (0..fitted.len()).map(|record| gyro.state(record));
    let rate = states().flat_map(|state| &state.rate).fold(0.0_f64, |most, rate| most.max(rate.abs()));
    let span = |o: &Observation| o.time.last().zip(o.time.first()).map_or(0.0, |(last, first)| last - first);
    let duration = fitted.iter().map(span).fold(0.0, f64::max);
    Ranges::new(gyro.scene(), rate, duration, gyro.largest_parts(fitted.len()))
}

/// The ln evidence of what is `behind` by so much, in words.
fn lower(behind: f64) -> String {
    format!("ln evidence {} by {:.1}", if behind < 0.0 { "higher" } else { "lower" }, behind.abs())
}

impl StandIn {
    /// Whether the records hardly tell the name from the law.
    pub(crate) fn is_near(&self) -> bool {
        self.behind < NEAR
    }

    /// One object, as scripts read it.
    pub(crate) fn json(&self) -> Value {
        let Self { of, id, title, known, behind, share, taken } = self;
        json!({
            "in_place_of": of, "id": id, "title": title, "known_physics": known,
            "behind": behind, "share": share, "probability": if self.is_near() { *taken } else { 0.0 },
        })
    }

    /// The law, with what is known of its form.
    pub(crate) fn said(&self) -> String {
        format!("{} (known physics of this form: {})", self.title, self.known)
    }

    /// For people; `None` where the records tell the name from the law.
    pub(crate) fn text(&self) -> Option<String> {
        let Self { of, title, known, behind, share, .. } = self;
        self.is_near().then(|| {
            format!(
                "These records hardly tell {of} from a law that nobody listed: {title} (known physics of this form: {known}; {}). The probability \
                 of {of} counts both as equally likely beforehand, which leaves it {share:.2} of what it had.",
                lower(*behind)
            )
        })
    }
}

impl Composed {
    /// Its terms by their titles.
    pub(crate) fn name(&self) -> String {
        let terms: Vec<&str> = self.terms.iter().map(|term| term.case.mechanism.title.as_str()).collect();
        format!("composed law: {}", terms.join(" + "))
    }

    /// The law with its sizes as mechanisms' files: names and texts.
    pub(crate) fn files(&self) -> Result<Vec<(String, String)>, Error> {
        let of = |term: &Term| Ok((term.case.mechanism.id.clone(), term.case.with_values(&term.values)?));
        self.terms.iter().map(of).collect()
    }

    /// Two of its terms that are one law.
    fn followed(&self) -> Option<Followed> {
        self.terms.iter().find_map(|straight| self.terms.iter().find_map(|lagging| Followed::of(straight, lagging)))
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
            "one_law": self.followed().map(|followed| followed.json()),
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
            out += &format!(
                "{begins}: {}{} (known physics of this form: {}).\n",
                numbered(k, self.terms.len()),
                mechanism.title,
                term.known
            );
            out.extend(mechanism.equation.lines().map(|line| format!("  {line}\n")));
        }
        out.extend(self.followed().map(|followed| followed.text()));
        let by = format!("It gains {:.1} of ln evidence, the choice among all laws paid for", self.gain);
        let others: Vec<String> = self.others.iter().map(|(title, _, behind)| format!("{title} ({})", lower(*behind))).collect();
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
        let of = |(k, term): (usize, &Term)| -> Vec<Estimate> {
            let number = numbered(k, self.terms.len());
            term.estimates.iter().map(|e| Estimate { name: format!("{number}{}", e.name), ..e.clone() }).collect()
        };
        (out, self.terms.iter().enumerate().flat_map(of).collect())
    }
}

/// Whether a law is a knee of a temperature that lies so near the cold end of its range that it is a straight line.
fn is_straight(id: &str, estimates: &[Estimate], [low, high]: [f64; 2], noise: f64) -> bool {
    let Some((at, size)) = find(estimates, "at_").zip(find(estimates, "size_")) else { return false };
    let below = (at.value - low).max(0.0);
    id.starts_with("composed-knee-") && below < EDGE * (high - low) && (size.value * below).abs() < UNSEEN * noise
}

/// The estimate of a parameter by how its name begins.
fn find<'a>(estimates: &'a [Estimate], name: &str) -> Option<&'a Estimate> {
    estimates.iter().find(|estimate| estimate.name.starts_with(name))
}

/// Two terms that are one law: a straight line of a temperature T less its lag, size (T - at) - size (T - x), is the straight line of what follows it.
struct Followed {
    of: String,
    size: Estimate,
    lag: Estimate,
}

impl Followed {
    /// A straight line of a temperature and a lag of the same one with the opposite size, as far as the records tell both.
    fn of(straight: &Term, lagging: &Term) -> Option<Self> {
        let of = straight.case.mechanism.id.strip_prefix("composed-knee-").filter(|_| straight.known == STRAIGHT)?;
        let of_lag = lagging.case.mechanism.id.strip_prefix("composed-lag-")?;
        let (size, opposite) = find(&straight.estimates, "size_").zip(find(&lagging.estimates, "size_"))?;
        let ([low, high], [most, least]) = (size.ci90, opposite.ci90.map(|size| -size));
        let lag = find(&lagging.estimates, "tau_")?;
        (of == of_lag && least <= high && low <= most).then(|| Self { of: of.to_owned(), size: size.clone(), lag: lag.clone() })
    }

    fn json(&self) -> Value {
        let Self { of, size, lag } = self;
        let told = |Estimate { value, ci90, .. }: &Estimate| json!({"value": value, "ci90": ci90});
        json!({"follows": of, "size_deg_per_h_per_k": told(size), "lag_s": told(lag)})
    }

    fn text(&self) -> String {
        let Self { of, size, lag } = self;
        let [of_size, of_lag] = [size, lag].map(|estimate| significant(estimate.value, 4));
        format!(
            "Both are one law: a rate of {of_size} (deg/h)/K of a temperature that follows that of the {of} with a lag of {of_lag} s.\n"
        )
    }
}

/// The number of a term before what is its own; nothing where there is but one.
fn numbered(k: usize, terms: usize) -> String {
    if terms > 1 { format!("({}) ", k + 1) } else { String::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(name: &str, value: f64, ci90: [f64; 2]) -> Estimate {
        Estimate { name: name.into(), value, ci90 }
    }

    #[test]
    fn a_knee_at_the_cold_end_is_a_straight_line() {
        let of = |id: &str, size: f64, at: f64| {
            let of = |name: &str, value: f64| estimate(name, value, [value; 2]);
            is_straight(id, &[of("size_deg_per_h_per_k", size), of("at_c", at)], [-34.5, 45.5], 0.01)
        };
        for body in ["chamber", "spool", "coil"] {
            let knee = &format!("composed-knee-{body}");
            assert!(of(knee, -0.01, -34.0) && of(knee, 0.003, -26.6) && of(knee, 0.01, -40.0));
            // seen, or not at the cold end
            assert!(!of(knee, -0.01, -30.0) && !of(knee, 1e-3, -26.4) && !of(knee, 1e-3, 45.0));
        }
        assert!(!of("composed-threshold-coil", 1e-3, -34.0));
        // as the laws are called that are composed
        let scene = Scene { temperatures: [-34.5, 45.5], noise: 0.01, earth: None };
        let ids: Vec<String> = laws::laws(&Ranges::new(&scene, 0.01, 3e4, [1.0; 4])).into_iter().map(|law| law.text).collect();
        assert!(
            ids.iter().any(|text| text.contains("id: \"composed-knee-coil\"") && text.contains("(name: \"at\", unit: \"degC\""))
        );
    }

    #[test]
    fn a_straight_line_less_a_lag_is_the_line_of_what_follows() {
        let scene = Scene { temperatures: [-34.5, 45.5], noise: 0.01, earth: None };
        let all = laws::laws(&Ranges::new(&scene, 0.01, 3e4, [1.0; 4]));
        let term = |id: &str, known: &'static str, estimates: Vec<Estimate>| {
            let law = all.iter().find(|law| law.text.contains(&format!("id: \"{id}\""))).expect("a law");
            let case = check_mechanism("law".as_ref(), law.text.clone()).expect("a mechanism");
            Term { case, known, values: Vec::new(), estimates }
        };
        let size = |value: f64| estimate("size_deg_per_h_per_k", value, [value - 2e-4, value + 2e-4]);
        let knee =
            |known, value| term("composed-knee-chamber", known, vec![size(value), estimate("at_c", -34.0, [-34.5, -33.0])]);
        let lag = |of: &str, value| {
            term(&format!("composed-lag-{of}"), "slow", vec![size(value), estimate("tau_s", 2673.0, [2594.0, 2756.0])])
        };
        let told = |straight: Term, lagging: Term| Followed::of(&straight, &lagging).map(|followed| followed.text());
        for sign in [1.0, -1.0] {
            let text = told(knee(STRAIGHT, 0.012 * sign), lag("chamber", -0.0118 * sign)).expect("one law");
            assert!(text.contains("0.012") && text.contains("follows that of the chamber with a lag of 2673 s"), "{text}");
        }
        // a knee that is seen, another temperature, another size, the same sign
        assert_eq!(told(knee("contact", 0.012), lag("chamber", -0.012)), None);
        assert_eq!(told(knee(STRAIGHT, 0.012), lag("coil", -0.012)), None);
        assert_eq!(told(knee(STRAIGHT, 0.012), lag("chamber", -0.009)), None);
        assert_eq!(told(knee(STRAIGHT, 0.012), lag("chamber", 0.012)), None);
    }

    #[test]
    fn terms_have_numbers_where_there_are_several() {
        assert_eq!([numbered(0, 1), numbered(0, 2), numbered(1, 2)], ["", "(1) ", "(2) "]);
        // the unit of a numbered parameter is that of the parameter
        assert_eq!(
            crate::units::parameter_unit("(2) size_deg_per_h_per_k"),
            crate::units::parameter_unit("size_deg_per_h_per_k")
        );
    }
}
