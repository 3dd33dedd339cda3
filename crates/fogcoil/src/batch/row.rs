//! A unit as a row of the table.

use files::Remark;
use serde_json::{Value, json};

use crate::table::significant;

/// Numbers of a unit, in the order of the table; the first eight have intervals, as `fogcoil measure` tells them.
pub(super) const NUMBERS: [&str; 16] = [
    "sensitivity",
    "heating",
    "cooling",
    "hysteresis",
    "bias_span",
    "peak",
    "arw",
    "bias_instability",
    "predicted_sensitivity",
    "sigmas_from_predicted",
    "residual_deg_per_h",
    "noise_deg_per_h",
    "residual_over_noise",
    "probability",
    "verdict_probability",
    "first_probability",
];

/// Number of the [`NUMBERS`] that have intervals.
pub(super) const MEASURED: usize = 8;

/// A constant of the design as a unit has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Standard deviations of its tolerance from the drawing.
    pub sigmas: f64,
}

/// A unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its name.
    pub unit: String,
    /// Its serial number: of the meta file, or of its name.
    pub serial: Option<String>,
    /// Its lot: of the meta file, or the folder in which its own lies.
    pub lot: Option<String>,
    /// Date of the recording, by the meta file.
    pub date: Option<String>,
    /// Its records.
    pub files: Vec<String>,
    /// SHA-256 of each.
    pub hashes: Vec<String>,
    /// The diagnosis' verdict.
    pub verdict: Option<String>,
    /// Ids that the records do not exclude, best first.
    pub set: Vec<String>,
    /// Those of them that take part more probably than not: they act together.
    together: Vec<String>,
    /// Ids of the warnings about its records, each once.
    pub warnings: Vec<String>,
    /// The word of the drawing that may be another, as the records have it.
    pub drawing: Option<String>,
    /// The column that the rate follows and the model does not use.
    pub column: Option<String>,
    /// The likeliest mechanism.
    pub first: Option<String>,
    /// Parameters of the explanation: name, value and both ends of the 90 % interval.
    pub parameters: Vec<(String, [f64; 3])>,
    /// Shape of a difference that is unknown: the law that was composed and accepted, or a description.
    pub(super) shape: Option<String>,
    /// Clocks that the records show to be late or early, in words.
    pub(super) clocks: Vec<String>,
    /// Constants of the design as the records leave them.
    pub constants: Vec<Constant>,
    /// Reason why there is no diagnosis.
    pub problem: Option<String>,
    /// Another verdict that is likelier, and its probability: no other explanation was strong enough to be named.
    pub rival: Option<(String, f64)>,
    /// The likeliest mechanisms and their probabilities, best first: those at least half as likely as the first.
    likeliest: Vec<(String, f64)>,
    /// Figures that were not measured, and why.
    missing: Vec<(String, String)>,
    /// Whether the bias instability is an upper bound, as the temperature changed.
    pub(super) instability_is_bound: bool,
    /// Length and fastest change of temperature of the record whose peak it is, if they are known.
    peak_under: Option<[f64; 2]>,
    numbers: Vec<Option<f64>>,
    intervals: Vec<Option<[f64; 2]>>,
}

impl Row {
    /// Row of a unit's kept finding.
    pub(super) fn of(finding: &Value) -> Self {
        let text = |value: &Value| value.as_str().map(str::to_owned);
        let texts = |value: &Value| value.as_array().into_iter().flatten().filter_map(text).collect::<Vec<_>>();
        let (measured, diagnosis) = (&finding["measured"], &finding["diagnosis"]);
        let unit = text(&finding["unit"]).unwrap_or_default();
        let alone = &measured["without_interval"];
        let told = |name: &&str| measured[name]["value"].as_f64().or_else(|| alone[name].as_f64());
        let mut numbers: Vec<Option<f64>> = NUMBERS[..MEASURED].iter().map(told).collect();
        let [residual, noise] = [0, 1].map(|n| finding["left"][n].as_f64());
        let prediction = &measured["prediction"];
        numbers.extend([prediction["value"].as_f64(), prediction["sigmas"].as_f64(), residual, noise]);
        numbers.push(residual.zip(noise).map(|(residual, noise)| residual / noise));
        let first = &diagnosis["mechanisms"][0];
        let probability = first["probability"].as_f64();
        numbers.extend([probability, of_verdict(diagnosis), probability]);
        let constants = diagnosis["unknowns"].as_array().into_iter().flatten().filter(|c| c["kind"] == "design");
        Self {
            serial: text(&finding["serial"]),
            lot: text(&finding["lot"]),
            date: text(&finding["date"]),
            files: texts(&finding["files"]),
            hashes: texts(&finding["sha256"]),
            verdict: text(&diagnosis["verdict"]),
            rival: rival(diagnosis),
            likeliest: likeliest(diagnosis),
            set: texts(&diagnosis["set"]),
            together: probable(diagnosis),
            warnings: warnings(diagnosis),
            drawing: text(&diagnosis["other_drawing"]),
            column: text(&diagnosis["follows_column"]),
            first: text(&first["id"]),
            parameters: parameters(&diagnosis["parameters"]),
            shape: shape(diagnosis),
            clocks: clocks(&diagnosis["sensors"]),
            constants: constants.filter_map(constant).collect(),
            problem: text(&finding["problem"]),
            missing: pairs(&measured["not_known"]),
            peak_under: ends(&json!(["length_s", "fastest_c_per_min"].map(|key| &measured["peak_under"][key]))),
            instability_is_bound: measured["bias_instability_is_bound"] == true,
            intervals: NUMBERS[..MEASURED].iter().map(|name| ends(&measured[name]["ci90"])).collect(),
            numbers,
            unit,
        }
    }

    /// Whether nothing was found: its records cannot be used.
    pub(super) fn is_unread(&self) -> bool {
        self.verdict.is_none() && self.numbers.iter().all(Option::is_none)
    }

    /// A column by its name; none if it was not found, or there is no such column.
    pub fn number(&self, name: &str) -> Option<f64> {
        NUMBERS.iter().position(|known| *known == name).and_then(|n| self.numbers[n])
    }

    /// Whether a number of this row and of another are of equals: of peaks, under programmes of one length and one rate to a tenth.
    pub(super) fn compares(&self, number: &str, other: &Self) -> bool {
        const ALIKE: f64 = 0.1;
        let alike = |(a, b): (f64, f64)| (a - b).abs() <= ALIKE * a.max(b);
        match (self.peak_under, other.peak_under) {
            _ if number != "peak" => true,
            (Some(own), Some(other)) => own.into_iter().zip(other).all(alike),
            (own, other) => own == other,
        }
    }

    /// Explanations that the records do not exclude, best first, in words; of a verdict that has a likelier rival, or one half as likely, the likeliest
    /// mechanisms; of what has no name, its shape.
    pub(super) fn open(&self) -> String {
        if let Some(shape) = &self.shape {
            return shape.clone();
        }
        if self.is_open() && !self.likeliest.is_empty() {
            let told = self.likeliest.iter().map(|(id, probability)| format!("{id} ({probability:.2})"));
            return told.collect::<Vec<_>>().join(" or ");
        }
        let others = self.set.iter().filter(|id| !self.together.contains(id)).cloned();
        let together: Vec<String> = self.set.iter().filter(|id| self.together.contains(id)).cloned().collect();
        Some(together.join(" and ")).filter(|all| !all.is_empty()).into_iter().chain(others).collect::<Vec<_>>().join(" or ")
    }

    /// Whether the verdict says nothing of mechanisms although something else is likelier, or one of them half as likely.
    fn is_open(&self) -> bool {
        (self.rival.is_some() || self.is_pressed()) && self.set.is_empty()
    }

    /// Whether a mechanism is at least half as likely as that the design suffices, where that is the verdict.
    pub(super) fn is_pressed(&self) -> bool {
        let suffices = matches!(self.verdict.as_deref(), Some("none" | "recalibrate"));
        let rival = self.number("first_probability").zip(self.number("verdict_probability"));
        suffices && rival.is_some_and(|(first, verdict)| 2.0 * first >= verdict)
    }

    /// Warnings of its records, in words.
    pub(super) fn warned(&self) -> Option<String> {
        let of = |id: &String| {
            let which = match id.as_str() {
                "doubted-drawing" => self.drawing.as_ref(),
                "follows-column" => self.column.as_ref(),
                _ => None,
            };
            which.map_or_else(|| id.clone(), |which| format!("{id} ({which})"))
        };
        (!self.warnings.is_empty()).then(|| format!("warned of {}", self.warnings.iter().map(of).collect::<Vec<_>>().join(", ")))
    }

    /// What is told of its records beside its verdict: warnings, and clocks.
    pub(super) fn told_besides(&self) -> Option<String> {
        let all: Vec<String> = self.warned().into_iter().chain(self.clocks.iter().cloned()).collect();
        (!all.is_empty()).then(|| all.join("; "))
    }

    /// Whether far more than noise is left of a record that was held out.
    pub(super) fn is_not_predicted(&self) -> bool {
        self.warnings.iter().any(|id| id == Remark::HeldOutLeft.id())
    }

    /// Reason why a number is not known.
    pub(super) fn why(&self, name: &str) -> Option<&str> {
        // what is measured less what is predicted
        let measured = if name == "sigmas_from_predicted" { "sensitivity" } else { name };
        let why = self.missing.iter().find(|(missing, _)| missing == measured).map(|(_, why)| why.as_str());
        why.or(self.problem.as_deref())
    }

    /// The ends of its 90 % interval, if it was measured.
    pub fn interval(&self, name: &str) -> Option<[f64; 2]> {
        NUMBERS[..MEASURED].iter().position(|known| *known == name).and_then(|n| self.intervals[n])
    }
}

/// Probability of a diagnosis' verdict; of none and recalibrate together where one of them is it: the design suffices.
fn of_verdict(diagnosis: &Value) -> Option<f64> {
    let of = |verdict: &str| diagnosis["verdicts"][verdict].as_f64();
    let probability = match diagnosis["verdict"].as_str()? {
        "none" | "recalibrate" => of("none")? + of("recalibrate")?,
        verdict => of(verdict)?,
    };
    // a sum of parts rounds beyond 1
    Some(probability.min(1.0))
}

/// Shape of what has no name, of a verdict that says so.
fn shape(diagnosis: &Value) -> Option<String> {
    if diagnosis["verdict"] != "unknown" {
        return None;
    }
    let composed = &diagnosis["composed"];
    let terms = composed["terms"].as_array().filter(|_| composed["accepted"] == true);
    let law: Vec<&str> = terms.into_iter().flatten().filter_map(|term| term["title"].as_str()).collect();
    let law = (!law.is_empty()).then(|| format!("a composed law, accepted: {}", law.join(" + ")));
    law.or_else(|| diagnosis["structure"].as_str().map(str::to_owned))
}

/// The verdict that is likelier than a diagnosis' own, if there is one.
fn rival(diagnosis: &Value) -> Option<(String, f64)> {
    let own = diagnosis["verdict"].as_str().unwrap_or_default();
    let is_design = |verdict: &str| ["none", "recalibrate"].contains(&verdict);
    let others = diagnosis["verdicts"].as_object()?.iter();
    let others = others.filter(|(verdict, _)| *verdict != own && !(is_design(verdict) && is_design(own)));
    let others = others.filter_map(|(verdict, p)| Some((verdict.clone(), p.as_f64()?)));
    let most = others.max_by(|a, b| a.1.total_cmp(&b.1))?;
    of_verdict(diagnosis).is_some_and(|p| p < most.1).then_some(most)
}

/// Mechanisms at least half as likely as the first.
fn likeliest(diagnosis: &Value) -> Vec<(String, f64)> {
    const MOST: usize = 3;
    let all = diagnosis["mechanisms"].as_array().into_iter().flatten();
    let all: Vec<_> = all.filter_map(|one| Some((one["id"].as_str()?.to_owned(), one["probability"].as_f64()?))).collect();
    let first = all.first().map_or(0.0, |(_, first)| *first);
    all.into_iter().take_while(|(_, p)| 2.0 * p >= first).take(MOST).collect()
}

/// Unit of a number of the table.
pub(super) fn unit_of(number: &str) -> &'static str {
    match number {
        "sensitivity" | "heating" | "cooling" | "predicted_sensitivity" => " (deg/h)/(degC/min)",
        "hysteresis" | "bias_span" | "peak" | "bias_instability" | "residual_deg_per_h" | "noise_deg_per_h" => " deg/h",
        "arw" => " deg/sqrt(h)",
        _ => "",
    }
}

/// Ids of mechanisms that take part more probably than not.
fn probable(diagnosis: &Value) -> Vec<String> {
    let takes_part = |told: &&Value| told["probability"].as_f64().is_some_and(|p| p >= 0.5);
    let all = diagnosis["mechanisms"].as_array().into_iter().flatten();
    all.filter(takes_part).filter_map(|told| told["id"].as_str()).map(str::to_owned).collect()
}

/// Ids of a diagnosis' warnings, each once.
fn warnings(diagnosis: &Value) -> Vec<String> {
    let all = |key: &str| diagnosis[key].as_array().into_iter().flatten();
    let mut warnings: Vec<String> = Vec::new();
    for (note, id) in all("notes").zip(all("note_ids")) {
        let (note, id) = (note.as_str().unwrap_or_default(), id.as_str().unwrap_or_default());
        if note.starts_with("warning: ") && !warnings.iter().any(|known| known == id) {
            warnings.push(id.to_owned());
        }
    }
    warnings
}

/// Of a diagnosis' instruments the delays that are no less than three of their deviations, unless they may make up for something else.
fn clocks(sensors: &Value) -> Vec<String> {
    /// Deviations of the half of a 90 % interval.
    const HALF: f64 = 1.645;
    const FAR: f64 = 3.0;
    let told = |sensor: &Value| {
        let (column, value) = (sensor["key"].as_str()?.strip_suffix(".delay_s")?, sensor["value"].as_f64()?);
        let [low, high] = ends(&sensor["ci90"])?;
        let is_sure = sensor["qualified"] != true && value.abs() > FAR * (high - low) / 2.0 / HALF;
        let (how, [low, high]) = if value > 0.0 { ("late", [low, high]) } else { ("early", [-high, -low]) };
        let [value, low, high] = [value.abs(), low, high].map(|seconds| significant(seconds, 3));
        is_sure.then(|| format!("{column} is read {value} s {how} ({low} to {high})"))
    };
    sensors.as_array().into_iter().flatten().filter_map(told).collect()
}

fn pairs(value: &Value) -> Vec<(String, String)> {
    let of = |(name, text): (&String, &Value)| Some((name.clone(), text.as_str()?.to_owned()));
    value.as_object().into_iter().flatten().filter_map(of).collect()
}

fn ends(value: &Value) -> Option<[f64; 2]> {
    Some([value[0].as_f64()?, value[1].as_f64()?])
}

fn parameters(value: &Value) -> Vec<(String, [f64; 3])> {
    let of = |(name, told): (&String, &Value)| {
        let [low, high] = ends(&told["ci90"])?;
        Some((name.clone(), [told["value"].as_f64()?, low, high]))
    };
    value.as_object().into_iter().flatten().filter_map(of).collect()
}

fn constant(value: &Value) -> Option<Constant> {
    Some(Constant { name: value["name"].as_str()?.to_owned(), sigmas: value["sigmas"].as_f64()? })
}

/// Whether a number has an interval where it is measured.
pub(super) fn has_interval(name: &str) -> bool {
    NUMBERS[..MEASURED].contains(&name)
}

/// The digits that a name ends in.
pub(super) fn trailing(name: &str) -> Option<&str> {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    Some(&name[letters.len()..]).filter(|digits| !digits.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_becomes_a_row() {
        let row = Row::of(&json!({
            "unit": "SN-0042", "serial": "42", "date": "2026-03-02", "files": ["a.csv"], "sha256": ["ff"], "left": [0.3, 0.1], "problem": null,
            "measured": {"sensitivity": {"value": -2.7, "ci90": [-2.8, -2.6]}, "arw": null, "without_interval": {"arw": 0.001}, "not_known": {"peak": "it moved"}, "prediction": {"value": -2.73, "sigmas": 0.2}},
            "diagnosis": {
                "verdict": "explained", "verdicts": {"none": 0.0, "recalibrate": 0.1, "explained": 0.7, "unknown": 0.2}, "set": ["debond"], "mechanisms": [{"id": "debond", "probability": 0.9}],
                "parameters": {"area": {"value": 0.3, "ci90": [0.2, 0.4]}},
                "unknowns": [{"name": "E_r and G", "kind": "design", "sigmas": 1.5}, {"name": "gain", "kind": "instrument", "sigmas": 0.1}],
            },
        }));
        assert_eq!((row.serial.as_deref(), row.number("sensitivity"), row.number("arw")), (Some("42"), Some(-2.7), Some(0.001)));
        assert_eq!((row.interval("arw"), row.number("peak"), row.why("peak")), (None, None, Some("it moved")));
        assert_eq!((row.first.as_deref(), row.number("first_probability")), (Some("debond"), Some(0.9)));
        assert_eq!(row.number("verdict_probability"), Some(0.7));
        assert_eq!((row.interval("sensitivity"), row.interval("residual_over_noise")), (Some([-2.8, -2.6]), None));
        assert!((row.number("residual_over_noise").unwrap() - 3.0).abs() < 1e-12);
        assert_eq!((row.number("probability"), row.constants.len()), (Some(0.9), 1));
        assert_eq!(row.parameters, [("area".to_owned(), [0.3, 0.2, 0.4])]);
        assert!(row.warnings.is_empty() && row.warned().is_none() && row.open() == "debond");
    }

    #[test]
    fn the_shape_of_what_has_no_name_is_told() {
        let of = |verdict: &str, accepted: bool| {
            let composed = json!({"accepted": accepted, "terms": [{"title": "A rate like the square"}]});
            let diagnosis = json!({"verdict": verdict, "structure": "a step", "composed": composed});
            Row::of(&json!({"unit": "U", "diagnosis": diagnosis})).open()
        };
        assert_eq!(of("unknown", true), "a composed law, accepted: A rate like the square");
        assert_eq!((of("unknown", false).as_str(), of("none", true).as_str()), ("a step", ""));
    }

    #[test]
    fn what_acts_together_is_not_one_or_the_other_and_warnings_are_told() {
        let row = Row::of(&json!({
            "unit": "U", "diagnosis": {
                "set": ["tail-asymmetry", "air-path", "debond"],
                "mechanisms": [{"id": "tail-asymmetry", "probability": 0.93}, {"id": "debond", "probability": 0.2}, {"id": "air-path", "probability": 0.83}],
                "notes": ["warning: a.csv: exchanged", "note: a.csv: late", "warning: b.csv: exchanged", "warning: stuck"],
                "note_ids": ["exchanged-columns", "gap", "exchanged-columns", "stuck"],
                "sensors": [
                    {"key": "chamber_c.delay_s", "value": 89.5, "ci90": [88.6, 90.5], "sigmas": 9.0, "qualified": false},
                    {"key": "rate_deg_per_h.delay_s", "value": -3.0, "ci90": [-6.0, 0.0], "sigmas": -0.6, "qualified": false},
                    {"key": "spool_c.lag_s", "value": 9.0, "ci90": [8.0, 10.0], "sigmas": 2.0, "qualified": false},
                ],
            },
        }));
        assert_eq!(
            row.told_besides().unwrap(),
            "warned of exchanged-columns, stuck; chamber_c is read 89.5 s late (88.6 to 90.5)"
        );
        assert_eq!(row.open(), "tail-asymmetry and air-path or debond");
        assert_eq!(row.warned().unwrap(), "warned of exchanged-columns, stuck");
    }

    #[test]
    fn a_verdict_less_likely_than_another_is_open() {
        let of = |recalibrate: f64, explained: f64, set: &[&str]| {
            let verdicts = json!({"none": 0.03, "recalibrate": recalibrate, "explained": explained, "unknown": 0.0});
            let others = [("air-path", 0.3), ("debond", 0.1)].map(|(id, p)| json!({"id": id, "probability": p}));
            let [second, third] = others;
            let mechanisms = json!([{"id": "sensor-lag", "probability": 0.46}, second, third]);
            Row::of(&json!({"unit": "U", "diagnosis":
                {"verdict": "recalibrate", "verdicts": verdicts, "mechanisms": mechanisms, "set": set}}))
        };
        let open = of(0.39, 0.57, &[]);
        assert_eq!(open.rival, Some(("explained".to_owned(), 0.57)));
        // those at least half as likely as the first
        assert_eq!(open.open(), "sensor-lag (0.46) or air-path (0.30)");
        // none and recalibrate are one: the design suffices
        let pressed = of(0.47, 0.49, &[]);
        assert!(pressed.rival.is_none() && pressed.is_pressed() && pressed.open() == "sensor-lag (0.46) or air-path (0.30)");
        let closed = of(0.93, 0.04, &[]);
        assert!(closed.rival.is_none() && !closed.is_pressed() && closed.open().is_empty());
        assert_eq!(of(0.39, 0.57, &["sensor-lag"]).open(), "sensor-lag");
    }

    #[test]
    fn a_design_that_suffices_needs_no_other_constants() {
        let of = |none: f64, recalibrate: f64| {
            let verdicts = json!({"none": none, "recalibrate": recalibrate, "explained": 0.0, "unknown": 0.0});
            Row::of(&json!({"unit": "U", "diagnosis": {"verdict": "recalibrate", "verdicts": verdicts}}))
                .number("verdict_probability")
                .unwrap()
        };
        assert!((of(0.0, 0.63) - 0.63).abs() < 1e-12 && (of(0.35, 0.5) - 0.85).abs() < 1e-12);
    }
}
