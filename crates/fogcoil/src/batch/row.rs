//! A unit as a row of the table.

use serde_json::Value;

/// Numbers of a unit, in the order of the table; the first eight have intervals, as `fogcoil measure` tells them.
pub(super) const NUMBERS: [&str; 14] = [
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
    /// Its serial number: of the meta file, or the digits that its name ends in.
    pub serial: Option<String>,
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
    /// Parameters of the explanation: name, value and both ends of the 90 % interval.
    pub parameters: Vec<(String, [f64; 3])>,
    /// Constants of the design as the records leave them.
    pub constants: Vec<Constant>,
    /// Reason why there is no diagnosis.
    pub problem: Option<String>,
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
        let mut numbers: Vec<Option<f64>> = NUMBERS[..MEASURED].iter().map(|name| measured[name]["value"].as_f64()).collect();
        let [residual, noise] = [0, 1].map(|n| finding["left"][n].as_f64());
        let prediction = &measured["prediction"];
        numbers.extend([prediction["value"].as_f64(), prediction["sigmas"].as_f64(), residual, noise]);
        numbers.push(residual.zip(noise).map(|(residual, noise)| residual / noise));
        numbers.push(diagnosis["mechanisms"][0]["probability"].as_f64());
        let constants = diagnosis["unknowns"].as_array().into_iter().flatten().filter(|c| c["kind"] == "design");
        Self {
            serial: text(&finding["serial"]).or_else(|| trailing(&unit).map(str::to_owned)),
            date: text(&finding["date"]),
            files: texts(&finding["files"]),
            hashes: texts(&finding["sha256"]),
            verdict: text(&diagnosis["verdict"]),
            set: texts(&diagnosis["set"]),
            parameters: parameters(&diagnosis["parameters"]),
            constants: constants.filter_map(constant).collect(),
            problem: text(&finding["problem"]),
            intervals: NUMBERS[..MEASURED].iter().map(|name| ends(&measured[name]["ci90"])).collect(),
            numbers,
            unit,
        }
    }

    /// A column by its name; none if it was not found, or there is no such column.
    pub fn number(&self, name: &str) -> Option<f64> {
        NUMBERS.iter().position(|known| *known == name).and_then(|n| self.numbers[n])
    }

    /// The ends of its 90 % interval, if it was measured.
    pub fn interval(&self, name: &str) -> Option<[f64; 2]> {
        NUMBERS[..MEASURED].iter().position(|known| *known == name).and_then(|n| self.intervals[n])
    }
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

/// The digits that a name ends in.
pub(super) fn trailing(name: &str) -> Option<&str> {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    Some(&name[letters.len()..]).filter(|digits| !digits.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_finding_becomes_a_row() {
        let row = Row::of(&json!({
            "unit": "SN-0042", "serial": null, "date": "2026-03-02", "files": ["a.csv"], "sha256": ["ff"], "left": [0.3, 0.1], "problem": null,
            "measured": {"sensitivity": {"value": -2.7, "ci90": [-2.8, -2.6]}, "arw": null, "prediction": {"value": -2.73, "sigmas": 0.2}},
            "diagnosis": {
                "verdict": "explained", "set": ["debond"], "mechanisms": [{"id": "debond", "probability": 0.9}],
                "parameters": {"area": {"value": 0.3, "ci90": [0.2, 0.4]}},
                "unknowns": [{"name": "E_r and G", "kind": "design", "sigmas": 1.5}, {"name": "gain", "kind": "instrument", "sigmas": 0.1}],
            },
        }));
        assert_eq!((row.serial.as_deref(), row.number("sensitivity"), row.number("arw")), (Some("0042"), Some(-2.7), None));
        assert_eq!((row.interval("sensitivity"), row.interval("residual_over_noise")), (Some([-2.8, -2.6]), None));
        assert!((row.number("residual_over_noise").unwrap() - 3.0).abs() < 1e-12);
        assert_eq!((row.number("probability"), row.constants.len()), (Some(0.9), 1));
        assert_eq!(row.parameters, [("area".to_owned(), [0.3, 0.2, 0.4])]);
    }
}
