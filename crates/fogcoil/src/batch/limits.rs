//! Limits that a unit must keep, `limits.ron`.

use std::path::Path;

use serde::Deserialize;

use super::row::{NUMBERS, Row};
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

/// Whether a unit keeps its limits, with the reasons where it does not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Judged {
    /// There are no limits.
    Unjudged,
    /// It keeps its limits.
    Passes,
    /// It does not keep its limits.
    Fails(Vec<String>),
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

impl Limits {
    /// Judges a unit: a number that was not measured does not keep a limit.
    pub fn judge(&self, row: &Row) -> Judged {
        let mut reasons: Vec<String> = self.limits.iter().filter_map(|(name, limit)| self.reason(name, *limit, row)).collect();
        if !self.verdicts.is_empty() {
            match &row.verdict {
                Some(verdict) if self.verdicts.contains(verdict) => {}
                Some(verdict) => reasons.push(format!("the verdict is {verdict}")),
                None => reasons.push("there is no verdict".into()),
            }
        }
        if reasons.is_empty() { Judged::Passes } else { Judged::Fails(reasons) }
    }

    fn reason(&self, name: &str, limit: Limit, row: &Row) -> Option<String> {
        let Some(value) = row.number(name) else { return Some(format!("{name} is not known")) };
        let ends = match (self.judged_by, row.interval(name)) {
            (By::Interval, Some(ends)) => ends,
            _ => [value; 2],
        };
        let (keeps, told) = match limit {
            Limit::Magnitude(most) => (ends.iter().all(|end| end.abs() <= most), format!("more than {most} in magnitude")),
            Limit::Within(low, high) => {
                (ends.iter().all(|end| (low..=high).contains(end)), format!("not within {low} and {high}"))
            }
        };
        let shown = match ends {
            [low, high] if low != high => {
                format!("{} ({} to {})", significant(value, 4), significant(low, 4), significant(high, 4))
            }
            _ => significant(value, 4),
        };
        (!keeps).then(|| format!("{name} is {shown}, {told}"))
    }
}

impl Judged {
    /// The outcome in a word; empty where there are no limits.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Unjudged => "",
            Self::Passes => "pass",
            Self::Fails(_) => "fail",
        }
    }

    /// Reasons why it fails.
    pub fn reasons(&self) -> Option<String> {
        match self {
            Self::Fails(reasons) => Some(reasons.join("; ")),
            Self::Unjudged | Self::Passes => None,
        }
    }
}
