//! Limits that a unit must keep, `limits.ron`.

use std::path::Path;

use diagnosis::SURE;
use serde::Deserialize;

use super::row::{NUMBERS, Row, has_interval};
use crate::Error;
use crate::input::{Fingerprint, check_ron, fault_in, meant, read_ron};
use crate::table::significant;
use crate::variants::each_once;

/// Condition on a number.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
enum Limit {
    /// At most, in magnitude.
    Magnitude(f64),
    /// Between two numbers.
    Within(f64, f64),
}

/// The value of a number that must keep the limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
enum By {
    /// The number itself.
    #[default]
    Value,
    /// Its whole 90 % interval.
    Interval,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LimitsFile {
    #[serde(deserialize_with = "each_once", default)]
    limits: Vec<(String, Limit)>,
    #[serde(default)]
    judged_by: By,
    #[serde(default)]
    verdicts: Vec<String>,
}

/// Limits that a unit must keep.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    limits: Vec<(&'static str, Limit)>,
    judged_by: By,
    /// Verdicts that pass; all where there are none.
    verdicts: Vec<String>,
    /// File of the limits.
    pub fingerprint: Fingerprint,
}

/// Whether a unit keeps its limits, with the reasons where it does not, or where that is not known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Judged {
    /// There are no limits.
    Unjudged,
    /// It keeps its limits.
    Passes,
    /// It does not keep its limits.
    Fails(Vec<String>),
    /// It breaks no limit, and of one at least it is not known whether it keeps it: it has not passed.
    NotKnown(Vec<String>),
}

/// Whether a number or a verdict keeps a limit.
enum Kept {
    Yes,
    No(String),
    NotKnown(String),
}

/// Verdicts of a diagnosis.
const VERDICTS: [&str; 4] = ["none", "recalibrate", "explained", "unknown"];

/// Reads and checks a file of limits.
///
/// # Errors
/// As [`check_limits`].
pub fn read_limits(path: &Path) -> Result<Limits, Error> {
    checked(path, read_ron(path)?)
}

/// Checks limits that are not in a file, with the content of one; messages call them `path`.
///
/// # Errors
/// [`files::Error::Input`] says what is wrong, where, and how to mend it.
pub fn check_limits(path: &Path, text: &str) -> Result<Limits, Error> {
    checked(path, check_ron(path, text)?)
}

fn checked(path: &Path, (file, fingerprint): (LimitsFile, Fingerprint)) -> Result<Limits, Error> {
    let fault = |field: &str, problem: String, remedy: String| Err(fault_in(path, field, problem, remedy).into());
    let mut limits = Vec::new();
    for (name, limit) in file.limits {
        let Some(known) = NUMBERS.iter().find(|known| **known == name) else {
            let remedy = format!("give some of {}{}", NUMBERS.join(", "), meant(&name, NUMBERS.iter().copied()));
            return fault("limits", format!("{name:?} is no number of a unit"), remedy);
        };
        let good = match limit {
            Limit::Magnitude(most) => most.is_finite() && most > 0.0,
            Limit::Within(low, high) => low.is_finite() && high.is_finite() && low < high,
        };
        if !good {
            return fault(
                "limits",
                format!("{name:?}: {limit:?} is no limit"),
                "give Magnitude(most), or Within(low, high)".into(),
            );
        }
        limits.push((*known, limit));
    }
    if let Some(unknown) = file.verdicts.iter().find(|verdict| !VERDICTS.contains(&verdict.as_str())) {
        return fault("verdicts", format!("{unknown:?} is no verdict"), format!("give some of {}", VERDICTS.join(", ")));
    }
    if limits.is_empty() && file.verdicts.is_empty() {
        return fault(
            "limits",
            "nothing is limited".into(),
            "give a limit, e.g. limits: {\"sensitivity\": Magnitude(3.0)}".into(),
        );
    }
    Ok(Limits { limits, judged_by: file.judged_by, verdicts: file.verdicts, fingerprint })
}

/// Between the name of a number and the reason why it is not known.
const NOT_KNOWN: &str = " is not known: ";

/// Reason why a unit has not passed of which a record that was held out shows something that its diagnosis does not hold.
const NOT_PREDICTED: &str = "the diagnosis does not predict the record that was held out: far more than noise is left of it";

/// Reasons of which each is said once, with all numbers that are not known for it.
fn merged(reasons: Vec<String>) -> Vec<String> {
    let mut merged: Vec<(Vec<String>, String)> = Vec::new();
    for reason in reasons {
        let (name, why) =
            reason.split_once(NOT_KNOWN).map_or((String::new(), reason.as_str()), |(name, why)| (name.to_owned(), why));
        match merged.iter_mut().find(|(names, known)| known == why && !names[0].is_empty()) {
            Some((names, _)) => names.push(name),
            None => merged.push((vec![name], why.to_owned())),
        }
    }
    let said = |(names, why): (Vec<String>, String)| match names.as_slice() {
        [name] if name.is_empty() => why,
        [name] => format!("{name}{NOT_KNOWN}{why}"),
        _ => format!("{} are not known: {why}", names.join(", ")),
    };
    merged.into_iter().map(said).collect()
}

impl Limit {
    fn ends(self) -> [f64; 2] {
        match self {
            Self::Magnitude(most) => [-most, most],
            Self::Within(low, high) => [low, high],
        }
    }

    fn broken(self) -> String {
        match self {
            Self::Magnitude(most) => format!("more than {most} in magnitude"),
            Self::Within(low, high) => format!("not within {low} and {high}"),
        }
    }
}

/// A verdict that keeps the limits, and another that is likelier.
fn not_sure(verdict: &str, (rival, probability): &(String, f64), row: &Row) -> Kept {
    let own = row.number("verdict_probability").map_or(String::new(), |own| format!(" ({own:.2})"));
    let likelier = match rival.as_str() {
        "explained" => format!("that one of the mechanisms acts ({probability:.2} together: {})", row.open()),
        rival => format!("{rival} ({probability:.2})"),
    };
    Kept::NotKnown(format!("the verdict {verdict}{own} is less likely than {likelier}"))
}

impl Limits {
    /// Both ends of the limit of a number, if it has one.
    pub(super) fn ends(&self, number: &str) -> Option<[f64; 2]> {
        self.limits.iter().find(|(name, _)| *name == number).map(|(_, limit)| limit.ends())
    }

    /// Judges a unit: of a number that was not measured, or whose interval is wider than its limits, it is not known whether it keeps them; of a unit whose
    /// record that was held out is not predicted, nothing is known that it keeps.
    pub fn judge(&self, row: &Row) -> Judged {
        if let Some(problem) = row.problem.as_ref().filter(|_| row.is_unread()) {
            return Judged::NotKnown(vec![problem.clone()]);
        }
        let verdict = (!self.verdicts.is_empty()).then(|| match &row.verdict {
            Some(verdict) if self.verdicts.contains(verdict) => {
                row.rival.as_ref().map_or(Kept::Yes, |rival| not_sure(verdict, rival, row))
            }
            Some(verdict) if verdict == "explained" => {
                let drawing = row.drawing.as_ref().map_or(String::new(), |word| format!("{word} in place of the drawing's, or "));
                Kept::No(format!("an effect was found: {drawing}{}", row.open()))
            }
            Some(verdict) => match row.number("verdict_probability").filter(|p| verdict == "unknown" && *p < SURE) {
                Some(p) => Kept::NotKnown(format!(
                    "the verdict is unknown, and not surely ({p:.2}): diagnose the unit with all of its records as --fit, or record it again"
                )),
                None => Kept::No(format!("the verdict is {verdict}")),
            },
            None => Kept::NotKnown("there is no verdict".into()),
        });
        let held = row.is_not_predicted().then(|| Kept::NotKnown(NOT_PREDICTED.into()));
        let (mut broken, mut not_known) = (Vec::new(), Vec::new());
        for kept in self.limits.iter().map(|(name, limit)| self.kept(name, *limit, row)).chain(verdict).chain(held) {
            match kept {
                Kept::Yes => {}
                Kept::No(reason) => broken.push(reason),
                Kept::NotKnown(reason) => not_known.push(reason),
            }
        }
        let not_known = merged(not_known);
        match (broken.is_empty(), not_known.is_empty()) {
            (true, true) => Judged::Passes,
            (true, false) => Judged::NotKnown(not_known),
            (false, _) => Judged::Fails(broken.into_iter().chain(not_known).collect()),
        }
    }

    fn kept(&self, name: &str, limit: Limit, row: &Row) -> Kept {
        let Some(value) = row.number(name) else {
            let why = row.why(name).map(|why| format!("{name}{NOT_KNOWN}{why}"));
            return Kept::NotKnown(why.unwrap_or_else(|| format!("{name} is not known")));
        };
        let ([least, most], interval) = (limit.ends(), row.interval(name));
        if let Some([low, high]) = interval.filter(|[low, high]| high - low > most - least && *low < most && *high > least) {
            let [low, high] = [low, high].map(|end| significant(end, 4));
            let limits = format!("{least} to {most}");
            return Kept::NotKnown(format!(
                "{name} is not known well enough: its 90 % interval, {low} to {high}, is wider than the limits, {limits}"
            ));
        }
        let ends = match (self.judged_by, interval) {
            (By::Interval, Some(ends)) => ends,
            (By::Interval, None) if has_interval(name) => {
                return Kept::NotKnown(format!("{name} is {}, its interval is not known", significant(value, 4)));
            }
            _ => [value; 2],
        };
        let shown = match ends {
            [low, high] if low != high => {
                format!("{} ({} to {})", significant(value, 4), significant(low, 4), significant(high, 4))
            }
            _ => significant(value, 4),
        };
        if ends.iter().all(|end| (least..=most).contains(end)) {
            Kept::Yes
        } else if name == "bias_instability" && row.instability_is_bound {
            Kept::NotKnown(format!(
                "{name} is an upper bound, {shown}, as the temperature changed: a limit that it does not keep may be kept; record at rest"
            ))
        } else if name == "verdict_probability" && value < least {
            Kept::NotKnown(format!("{name} is {shown}, {}: a small fault may hide beside the verdict", limit.broken()))
        } else if (least..=most).contains(&value) {
            Kept::No(format!("{name} is {shown}, an interval that reaches beyond the limits, {least} to {most}"))
        } else {
            Kept::No(format!("{name} is {shown}, {}", limit.broken()))
        }
    }
}

impl Judged {
    /// The outcome in a word; empty where there are no limits.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Unjudged => "",
            Self::Passes => "pass",
            Self::Fails(_) => "fail",
            Self::NotKnown(_) => "not known",
        }
    }

    /// Reasons why it does not pass.
    pub fn reasons(&self) -> Option<String> {
        match self {
            Self::Fails(reasons) | Self::NotKnown(reasons) => Some(reasons.join("; ")),
            Self::Unjudged | Self::Passes => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn judged(limits: &str, measured: serde_json::Value) -> Judged {
        let limits = check_limits("limits.ron".as_ref(), limits).unwrap();
        limits.judge(&Row::of(&json!({"unit": "U", "measured": measured, "diagnosis": {"verdict": "recalibrate"}})))
    }

    const LIMITS: &str = "(limits: {\"sensitivity\": Within(-3.2, -2.3)}, verdicts: [\"recalibrate\"])";

    #[test]
    fn what_is_not_known_neither_passes_nor_fails() {
        let why = "slower responses: the unit may not have settled; record ramps and rests that last longer";
        let both = ["sensitivity", "bias_span"].map(|name| format!("{name}{NOT_KNOWN}{why}")).to_vec();
        let told_once = [format!("sensitivity, bias_span are not known: {why}"), "arw is not known".to_owned()];
        assert_eq!(merged([both, vec!["arw is not known".to_owned()]].concat()), told_once);
        let unsettled = judged(LIMITS, json!({"sensitivity": null, "not_known": {"sensitivity": why}}));
        assert_eq!((unsettled.word(), unsettled.reasons().unwrap()), ("not known", format!("sensitivity is not known: {why}")));
        // a unit that breaks another limit fails
        let other = LIMITS.replace("recalibrate", "none");
        let fails = judged(&other, json!({"sensitivity": null, "not_known": {"sensitivity": why}}));
        assert_eq!(
            (fails.word(), fails.reasons().unwrap()),
            ("fail", format!("the verdict is recalibrate; sensitivity is not known: {why}"))
        );
    }

    /// A verdict that is hardly the likeliest is no fault.
    #[test]
    fn a_verdict_below_its_limit_is_not_known() {
        let limits = check_limits("limits.ron".as_ref(), "(limits: {\"verdict_probability\": Within(0.8, 1.0)})").unwrap();
        let of = |sure: f64| {
            let diagnosis = json!({"verdict": "recalibrate", "verdicts": {"none": 0.0, "recalibrate": sure, "explained": 0.0, "unknown": 0.0}});
            limits.judge(&Row::of(&json!({"unit": "U", "measured": {}, "diagnosis": diagnosis})))
        };
        let below = of(0.63);
        assert_eq!(of(0.9).reasons(), None);
        assert_eq!(below.word(), "not known");
        assert!(
            below.reasons().unwrap().starts_with("verdict_probability is 0.6300, not within 0.8 and 1: a small fault may hide")
        );
    }

    /// What nothing explains, and is not sure to be there, is no fault either.
    #[test]
    fn an_unknown_that_is_not_sure_is_not_known() {
        let limits = check_limits("limits.ron".as_ref(), "(limits: {}, verdicts: [\"recalibrate\"])").unwrap();
        let of = |sure: f64| {
            let verdicts = json!({"none": 0.0, "recalibrate": 1.0 - sure, "explained": 0.0, "unknown": sure});
            let diagnosis = json!({"verdict": "unknown", "verdicts": verdicts});
            limits.judge(&Row::of(&json!({"unit": "U", "measured": {}, "diagnosis": diagnosis})))
        };
        let [sure, unsure] = [of(0.95), of(0.57)];
        assert_eq!((sure.word(), sure.reasons().unwrap().as_str()), ("fail", "the verdict is unknown"));
        assert_eq!(unsure.word(), "not known");
        assert!(unsure.reasons().unwrap().starts_with("the verdict is unknown, and not surely (0.57): "), "{unsure:?}");
    }

    #[test]
    fn a_unit_whose_held_out_record_is_not_predicted_has_not_passed() {
        let of = |limits: &str, kind: &str, id: &str| {
            let limits = check_limits("limits.ron".as_ref(), limits).unwrap();
            let notes = [format!("{kind}: holdout.csv: far")];
            let diagnosis = json!({"verdict": "recalibrate", "notes": notes, "note_ids": [id]});
            let measured = json!({"sensitivity": {"value": -2.7, "ci90": [-2.8, -2.6]}});
            limits.judge(&Row::of(&json!({"unit": "U", "measured": measured, "diagnosis": diagnosis})))
        };
        let far = of(LIMITS, "warning", "held-out-left");
        assert_eq!((far.word(), far.reasons().as_deref()), ("not known", Some(NOT_PREDICTED)));
        assert_eq!(of("(limits: {\"sensitivity\": Within(-3.2, -2.3)})", "warning", "held-out-left").word(), "not known");
        // little left, or another warning
        assert_eq!([of(LIMITS, "note", "held-out-left"), of(LIMITS, "warning", "gap")], [Judged::Passes, Judged::Passes]);
        let fails = of(&LIMITS.replace("recalibrate", "none"), "warning", "held-out-left");
        assert_eq!((fails.word(), fails.reasons().unwrap()), ("fail", format!("the verdict is recalibrate; {NOT_PREDICTED}")));
    }

    #[test]
    fn an_interval_wider_than_the_limits_judges_nothing() {
        let of = |low: f64, high: f64| judged(LIMITS, json!({"sensitivity": {"value": (low + high) / 2.0, "ci90": [low, high]}}));
        assert_eq!([of(-2.8, -2.6).word(), of(-3.5, -2.0).word(), of(-2.0, -0.5).word()], ["pass", "not known", "fail"]);
        assert!(
            of(-3.5, -2.0)
                .reasons()
                .unwrap()
                .contains("its 90 % interval, -3.500 to -2.000, is wider than the limits, -3.2 to -2.3")
        );
    }

    #[test]
    fn an_upper_bound_keeps_a_limit_and_breaks_none() {
        let of = |value: f64, is_bound: bool| {
            let instability = json!({"value": value, "ci90": [0.9 * value, 1.1 * value]});
            let measured = json!({"bias_instability": instability, "bias_instability_is_bound": is_bound});
            judged("(limits: {\"bias_instability\": Magnitude(0.003)})", measured)
        };
        assert_eq!((of(0.0025, true).word(), of(0.0052, false).word()), ("pass", "fail"));
        let bound = of(0.0052, true);
        assert!(bound.word() == "not known" && bound.reasons().unwrap().contains("is an upper bound"), "{bound:?}");
    }

    #[test]
    fn an_interval_that_is_not_known_keeps_no_limit_of_intervals() {
        let limits = "(limits: {\"arw\": Magnitude(0.002)}, judged_by: Interval)";
        let measured = || json!({"arw": null, "without_interval": {"arw": 0.001}});
        let by_interval = judged(limits, measured());
        assert_eq!(
            (by_interval.word(), by_interval.reasons().unwrap().contains("its interval is not known")),
            ("not known", true)
        );
        assert_eq!(judged(&limits.replace("Interval", "Value"), measured()), Judged::Passes);
    }

    #[test]
    fn a_value_within_limits_whose_interval_is_not_says_so() {
        let limits = "(limits: {\"bias_span\": Magnitude(0.2)}, judged_by: Interval)";
        let failed = judged(limits, json!({"bias_span": {"value": 0.144, "ci90": [0.05, 0.2382]}}));
        let reason = "bias_span is 0.1440 (0.05000 to 0.2382), an interval that reaches beyond the limits, -0.2 to 0.2";
        assert_eq!(failed.reasons().as_deref(), Some(reason));
        let failed = judged(limits, json!({"bias_span": {"value": 0.3, "ci90": [0.25, 0.35]}}));
        assert!(failed.reasons().unwrap().contains("more than 0.2 in magnitude"), "{failed:?}");
    }
}
