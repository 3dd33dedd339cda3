//! A finding and its words.

use std::borrow::Cow;
use std::fmt;

use crate::Seconds;

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing.
    Note,
    /// Looks like a mistake.
    Warning,
    /// The recording cannot be used.
    Error,
}

/// Repair of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repair {
    /// Nothing.
    None,
    /// The rows are not kept.
    Dropped,
    /// The values are not used; the data are unchanged.
    Masked,
}

/// The kind of a finding, with its numbers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FindingKind {
    /// Rows are missing.
    Gap {
        /// Duration from the last row before it to the first after it \[s\].
        length: f64,
        /// Number of rows that it would have held.
        missing: usize,
    },
    /// Intervals vary.
    Jitter {
        /// Their root-mean-square distance from the median \[s\].
        rms: f64,
        /// The largest \[s\].
        largest: f64,
    },
    /// A row that repeats an earlier one.
    Duplicate,
    /// One instant with different values.
    Conflict,
    /// Time goes back, by so much \[s\].
    Backwards(f64),
    /// The clock was set: an interval \[s\] that is no whole number of intervals.
    ClockStep(f64),
    /// Values are missing.
    Missing,
    /// Lone values far from their neighbours; the largest distance \[u\].
    Outliers(f64),
    /// The same value \[u\] for longer than resolution and noise explain.
    Stuck(f64),
    /// The channel's largest or least value \[u\] for longer than resolution and noise explain.
    Saturation(f64),
    /// Each value stands for several rows: those of a slower logger, repeated until the next.
    Held {
        /// Usual number of rows for which it stands.
        rows: f64,
        /// The time of that many rows \[s\].
        interval: f64,
    },
    /// The resolution is coarser than the noise, which it hides.
    Quantised {
        /// Step between values \[u\].
        step: f64,
        /// Noise of a value \[u\].
        noise: f64,
    },
    /// The values are not of the size that the unit makes them.
    Unit {
        /// The size that was judged, e.g. "values".
        what: &'static str,
        /// The size that was found \[u\].
        found: f64,
        /// The plausible range \[u\].
        range: [f64; 2],
        /// Units in which it would be plausible.
        candidates: Vec<String>,
        /// Key of the channel where its unit is declared.
        key: String,
    },
    /// The channel changes faster than it can.
    TooFast {
        /// Its rate \[u/s\].
        rate: f64,
        /// The fastest that can be \[u/s\].
        limit: f64,
        /// Units of the instants in which it would be slow enough, the likeliest first.
        candidates: Vec<String>,
        /// Key of the instants where their unit is declared.
        key: String,
    },
    /// The recording is too short or too long to be one.
    Span {
        /// Duration from the first instant to the last \[s\].
        found: f64,
        /// The plausible range \[s\].
        range: [f64; 2],
        /// Units of the instants in which it would be plausible, the likeliest first.
        candidates: Vec<String>,
        /// Key of the instants where their unit is declared.
        key: String,
    },
    /// Values that no measurement gives; the largest \[u\].
    Impossible(f64),
    /// Values that what is at rest does not give, for longer than outliers do.
    Moving {
        /// The largest \[u\].
        largest: f64,
        /// The plausible range \[u\].
        range: [f64; 2],
    },
    /// A start that would be a room's in another unit.
    Start {
        /// The start \[u\].
        found: f64,
        /// The other unit.
        candidate: String,
        /// Key of the channel where its unit is declared.
        key: String,
    },
    /// One value \[u\] throughout.
    Constant(f64),
    /// No value at all.
    Empty,
    /// Few rows: how many.
    TooShort(usize),
    /// An offset that something known explains.
    Offset {
        /// Median \[u\].
        median: f64,
        /// The offset that is known, 0 if there is none \[u\].
        known: f64,
        /// The most that is expected beside it \[u\].
        largest: f64,
        /// The cause of what is known, or that would explain it.
        of: String,
        /// Whether it, or the opposite of what is known, would explain all of it.
        is_explained: bool,
    },
}

/// Something found in a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The kind of finding.
    pub kind: FindingKind,
    /// The channel; `None` if it is about the instants.
    pub channel: Option<String>,
    /// Unit of the channel; empty if there is none.
    pub unit: String,
    /// First and last instant concerned \[s\]; `None` if it is about all.
    pub span: Option<[f64; 2]>,
    /// Number of rows concerned, 0 if it is about all.
    pub rows: usize,
    /// Its severity.
    pub severity: Severity,
    /// The repair.
    pub repair: Repair,
}

impl Finding {
    /// About the whole recording.
    pub(super) fn whole(kind: FindingKind, severity: Severity) -> Self {
        Self { kind, channel: None, unit: String::new(), span: None, rows: 0, severity, repair: Repair::None }
    }

    /// About the instants from one to another.
    pub(super) fn at(kind: FindingKind, severity: Severity, span: [f64; 2], rows: usize, repair: Repair) -> Self {
        Self { span: Some(span), rows, repair, ..Self::whole(kind, severity) }
    }

    /// Advice, if there is any.
    pub fn advice(&self) -> Cow<'static, str> {
        let advice = match (&self.kind, self.severity) {
            (FindingKind::Start { candidate, key, .. }, _) => return declare(key, std::slice::from_ref(candidate)),
            (FindingKind::Unit { candidates, key, .. }, _) if !key.is_empty() => {
                return format!("{}; or --scale {key}=FACTOR where it holds counts", declare(key, candidates)).into();
            }
            (
                FindingKind::Unit { candidates, key, .. }
                | FindingKind::TooFast { candidates, key, .. }
                | FindingKind::Span { candidates, key, .. },
                _,
            ) => return declare(key, candidates),
            (FindingKind::Conflict, _) => {
                "keep the row that is right; if the clock shows no seconds, give the rows' interval in its place (--interval SECONDS, or interval_s in the map file)"
            }
            (FindingKind::Backwards { .. }, _) => {
                "sort the rows by time, or split the file where the clock restarts; if it was put back an hour as summer time ended, give the rows' interval in its place (--interval SECONDS, or interval_s in the map file)"
            }
            (FindingKind::ClockStep { .. }, _) => "if the clock was set, split the file there or mend the instants",
            (FindingKind::Empty | FindingKind::Constant { .. }, Severity::Error) => {
                "check the sensor's cable and the choice of the column"
            }
            (FindingKind::Stuck { .. } | FindingKind::Saturation { .. }, _) if self.repair == Repair::None => {
                "check the sensor and its range; the rows are still used: empty them if they are wrong"
            }
            (FindingKind::Stuck { .. } | FindingKind::Saturation { .. }, _) => "check the sensor and its range",
            (FindingKind::Moving { .. }, _) => "cut out the rows in which the unit was moved",
            (FindingKind::Offset { is_explained: false, .. }, _) => {
                "check unit and scale of the rate, or accept that the offset is fitted"
            }
            (FindingKind::Offset { .. }, _) => "remove it, or accept that the offset is fitted",
            (FindingKind::TooShort { .. }, _) => "give a longer recording",
            _ => "",
        };
        advice.into()
    }

    fn what(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = &self.unit;
        match &self.kind {
            FindingKind::Gap { length, missing } => {
                let rows = if *missing == 1 { "row" } else { "rows" };
                write!(f, "gap of {} s, {missing} {rows} missing", Short(*length))
            }
            FindingKind::Jitter { rms, largest } => {
                write!(f, "intervals vary by {} s rms, {} s at most", Short(*rms), Short(*largest))
            }
            FindingKind::Duplicate => write!(f, "a row is repeated"),
            FindingKind::Conflict => write!(f, "one instant has different values"),
            FindingKind::Backwards(by) => write!(f, "time goes back by {} s", Short(*by)),
            FindingKind::ClockStep(interval) => {
                write!(f, "an interval of {} s is no whole number of intervals", Short(*interval))
            }
            FindingKind::Missing => write!(f, "values are missing"),
            FindingKind::Outliers(largest) => write!(f, "outliers of up to {} {unit}", Short(*largest)),
            FindingKind::Stuck(value) => write!(f, "stuck at {} {unit}", Short(*value)),
            FindingKind::Saturation(value) => write!(f, "saturated at {} {unit}", Short(*value)),
            FindingKind::Held { rows, interval } => {
                write!(
                    f,
                    "a value stands for {} rows ({} s), as a slower logger's, repeated, does",
                    Short(*rows),
                    Short(*interval)
                )
            }
            FindingKind::Quantised { step, noise } => {
                write!(f, "the resolution, {} {unit}, hides the noise, at most {} {unit}", Short(*step), Short(*noise))
            }
            FindingKind::Unit { what, found, range: [low, high], candidates, .. } => {
                let verb = if *what == "noise" { "is" } else { "are" };
                write!(f, "{what} of {} {unit} {verb} implausible ({} to {} {unit})", Short(*found), Short(*low), Short(*high))?;
                if candidates.is_empty() { Ok(()) } else { write!(f, "; is it in {}?", candidates.join(" or ")) }
            }
            FindingKind::TooFast { rate, limit, candidates, .. } => {
                write!(f, "changes by {} {unit}/s, faster than it can (at most {} {unit}/s)", Short(*rate), Short(*limit))?;
                ask(f, candidates)
            }
            FindingKind::Span { found, range: [least, most], candidates, .. } => {
                write!(f, "it lasts {} s, which is implausible ({} to {} s)", Short(*found), Short(*least), Short(*most))?;
                ask(f, candidates)
            }
            FindingKind::Impossible(largest) => write!(f, "values that no measurement gives, up to {} {unit}", Short(*largest)),
            FindingKind::Moving { largest, range: [low, high] } => write!(
                f,
                "values of up to {} {unit}, impossible at rest ({} to {} {unit})",
                Short(*largest),
                Short(*low),
                Short(*high)
            ),
            FindingKind::Start { found, candidate, .. } => {
                write!(f, "starts at {} {unit}; a room has as many {candidate}: is it in {candidate}?", Short(*found))
            }
            FindingKind::Constant(value) => write!(f, "is {} {unit} throughout", Short(*value)),
            FindingKind::Empty => write!(f, "has no value at all"),
            FindingKind::TooShort(rows) => write!(f, "too few rows, {rows}"),
            FindingKind::Offset { median, known, largest, of, is_explained } => {
                let most = Short(*largest);
                write!(f, "the median, {} {unit}, ", Short(*median))?;
                match (*known == 0.0, is_explained) {
                    (true, true) => write!(f, "is more than {most} {unit}: perhaps {of}"),
                    (true, false) => write!(f, "is more than {most} {unit}, which this does not explain: {of}"),
                    (false, true) => write!(f, "is more than {most} {unit}: perhaps {of}, with the other sign"),
                    (false, false) => write!(f, "differs from {of}, by {} {unit}", Short(median - known)),
                }
            }
        }
    }
}

/// Asks for the unit of the instants.
fn ask(f: &mut fmt::Formatter<'_>, candidates: &[String]) -> fmt::Result {
    if candidates.is_empty() { Ok(()) } else { write!(f, "; are the instants in {}?", candidates.join(" or ")) }
}

/// Advice to declare a unit, the likeliest of several.
fn declare(key: &str, candidates: &[String]) -> Cow<'static, str> {
    match candidates {
        [first, others @ ..] if !key.is_empty() => {
            let others = if others.is_empty() { String::new() } else { format!(" (or {})", others.join(", ")) };
            format!("if so, say it: --unit {key}={first}{others}, or unit in the map file").into()
        }
        [] => "if its unit is another, say it: --unit KEY=UNIT, or unit in the map file".into(),
        _ => "if so, say it: --unit KEY=UNIT, or unit in the map file".into(),
    }
}

/// A number with four figures.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || !size.is_finite() {
            return write!(f, "{}", self.0);
        }
        if !(1e-4..1e7).contains(&size) {
            return write!(f, "{:.3e}", self.0);
        }
        let decimals = (3.0 - size.log10().floor()).max(0.0) as usize;
        let text = format!("{:.decimals$}", self.0);
        f.write_str(if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text })
    }
}

impl fmt::Display for Finding {
    /// One sentence without its end: what, where, what was done, what to do.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(channel) = &self.channel {
            write!(f, "{channel}: ")?;
        }
        self.what(f)?;
        match (self.span, self.rows) {
            (Some([from, to]), 0) => write!(f, ", from {} to {} s", Seconds(from), Seconds(to))?,
            (Some([from, to]), rows) if to > from => write!(f, ", from {} to {} s ({rows} rows)", Seconds(from), Seconds(to))?,
            (Some([at, _]), _) => write!(f, ", at {} s", Seconds(at))?,
            (None, _) => {}
        }
        match self.repair {
            // of a recording that cannot be used nothing was repaired
            _ if self.severity == Severity::Error => {}
            Repair::None => {}
            Repair::Dropped => f.write_str("; dropped")?,
            Repair::Masked => f.write_str("; not used")?,
        }
        if self.advice().is_empty() { Ok(()) } else { write!(f, "; {}", self.advice()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_numbers_have_four_figures() {
        let written = [0.0, 12.0, -0.5, 6.54321, 1234.56, 12_345_678.0, 0.000_123_456, 0.000_012_3, 99.999, f64::INFINITY];
        let expected = ["0", "12", "-0.5", "6.543", "1235", "1.235e7", "0.0001235", "1.230e-5", "100", "inf"];
        assert_eq!(written.map(|value| Short(value).to_string()), expected);
    }

    #[test]
    fn one_missing_row_is_a_row() {
        let gap = |missing| Finding::whole(FindingKind::Gap { length: 60.0, missing }, Severity::Note).to_string();
        let [one, two] = [gap(1), gap(2)];
        assert!(one.contains("gap of 60 s, 1 row missing") && two.contains("gap of 60 s, 2 rows missing"), "{one} {two}");
    }

    #[test]
    fn an_offset_has_advice_by_what_explains_it() {
        let of =
            |is_explained| FindingKind::Offset { median: 7.0, known: 0.0, largest: 0.5, of: "Earth's rate".into(), is_explained };
        let advice = |is_explained| Finding::whole(of(is_explained), Severity::Note).advice().into_owned();
        assert!(advice(true).starts_with("remove it") && advice(false).starts_with("check unit and scale"));
    }

    #[test]
    fn exact_advice_declares_a_unit_by_the_key_that_there_is() {
        let unit = |candidates: &[&str], key: &str| FindingKind::Unit {
            what: "values",
            found: 300.0,
            range: [-50.0, 100.0],
            candidates: candidates.iter().map(|&name| name.to_owned()).collect(),
            key: key.into(),
        };
        let start = |key: &str| FindingKind::Start { found: 70.0, candidate: "degF".into(), key: key.into() };
        let cases = [
            (start("air"), "if so, say it: --unit air=degF, or unit in the map file"),
            (start(""), "if so, say it: --unit KEY=UNIT, or unit in the map file"),
            (
                unit(&["K", "degF"], "air"),
                "if so, say it: --unit air=K (or degF), or unit in the map file; or --scale air=FACTOR where it holds counts",
            ),
            (
                unit(&[], "air"),
                "if its unit is another, say it: --unit KEY=UNIT, or unit in the map file; or --scale air=FACTOR where it holds counts",
            ),
            (unit(&["K"], ""), "if so, say it: --unit KEY=UNIT, or unit in the map file"),
            (unit(&[], ""), "if its unit is another, say it: --unit KEY=UNIT, or unit in the map file"),
            (FindingKind::ClockStep(43.0), "if the clock was set, split the file there or mend the instants"),
        ];
        for (kind, advice) in cases {
            assert_eq!(Finding::whole(kind.clone(), Severity::Warning).advice(), advice, "{kind:?}");
        }
    }
}
