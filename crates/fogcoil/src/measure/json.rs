//! The figures as one object. See docs/schema/measure.schema.json.

use std::path::PathBuf;

use bias::units::S_PER_MIN;
use serde_json::{Map, Value, json};

use super::{Figure, Measurement, Prediction, Untold};
use crate::Error;

fn object(figure: &Figure) -> Value {
    json!({"value": figure.value, "ci90": figure.ci90})
}

/// One object, as scripts read it; `null` where a number or its interval is not told, with the reason in `notes`.
pub fn json(measured: &Measurement, prediction: Option<&Prediction>) -> Value {
    let mut all = json!({
        "file": measured.fingerprint.file.display().to_string(),
        "fnv1a": measured.fingerprint.to_string(),
        "ramp_of": measured.temperatures.map(|[driver, _]| driver),
        "span_over": measured.temperatures.map(|[_, seat]| seat),
        "lags_s": measured.lags,
        "peak_time_s": measured.peak_time,
        "peak_under": measured.peak_under.map(|[length, fastest]| json!({"length_s": length, "fastest_c_per_min": fastest * S_PER_MIN})),
        "floor_time_s": measured.floor_time,
        "bias_instability_is_bound": measured.floor_time.is_some() && measured.floor_is_bound,
        "prediction": prediction.map(|prediction| json!({
            "design": prediction.design,
            "value": prediction.sensitivity.value,
            "ci90": prediction.sensitivity.ci90,
            "sigmas": prediction.sigmas(measured),
        })),
        "notes": measured.notes,
        "note_ids": measured.notes.iter().map(|note| note.remark.id()).collect::<Vec<_>>(),
    });
    let (mut not_known, mut without_interval) = (Map::new(), Map::new());
    for (key, _, told) in measured.figures() {
        match told {
            Ok(_) => {}
            Err(Untold { value: Some(value), .. }) => drop(without_interval.insert(key.to_owned(), json!(value))),
            Err(Untold { why, .. }) => drop(not_known.insert(key.to_owned(), json!(why))),
        }
        all[key] = told.as_ref().map_or(Value::Null, object);
    }
    all["not_known"] = not_known.into();
    all["without_interval"] = without_interval.into();
    all
}

/// Output for one record: its own object; for several: `{"records": […]}`, of a record that cannot be used its file and the problem.
pub fn all(measured: &[Result<Measurement, (PathBuf, Error)>], prediction: Option<&Prediction>) -> Value {
    let of = |one: &Result<Measurement, (PathBuf, Error)>| match one {
        Ok(measured) => json(measured, prediction),
        Err((file, error)) => json!({"file": file.display().to_string(), "problem": error.to_string()}),
    };
    match measured {
        [one] => of(one),
        several => json!({"records": several.iter().map(of).collect::<Vec<_>>()}),
    }
}
