//! Longer work: sensitivities, simulations, recordings.

use fogcoil::cache::Cache;
use fogcoil::check::{self, Analysis};
use fogcoil::input::{check_profile, check_record};
use fogcoil::{Error, figures, sensitivity as ramp, simulate as runs, summary};
use serde_json::{Value, json};

use crate::design::case;

/// Name of the profile in messages.
const PROFILE: &str = "profile.csv";
/// Shortest time between rows that are added \[s\].
const LEAST_STEP_S: f64 = 1.0;

pub(crate) fn sensitivity(coil: &str) -> Result<Value, Error> {
    let case = case(coil)?;
    let (result, band) = (case.steady_sensitivity()?, case.sensitivity_band()?);
    Ok(json!({ "json": ramp::json(&case, &result, &band), "text": ramp::text(&case, &result, &band, false) }))
}

pub(crate) fn simulate(coil: &str, profile: &str, step: Option<f64>) -> Result<Value, Error> {
    let case = case(coil)?;
    let mut profile = check_profile(PROFILE.as_ref(), profile.to_owned(), &case.design, &[])?;
    match step {
        Some(step) if step >= LEAST_STEP_S => profile.divide(step)?,
        Some(step) => return Err(Error::usage(format!("a step of {step} s is too short; give {LEAST_STEP_S} s or more"))),
        None => {}
    }
    profile.note_long_rows("give a step of 30 s");
    let model = runs::model(&case, &profile.drives, &Cache::NONE)?;
    let simulation = runs::simulate(&case, &profile, &model)?;
    let mut csv = Vec::new();
    simulation.write_csv(&mut csv).map_err(Error::Stdout)?;
    let notes = profile.notes.iter().cloned().chain(simulation.warning()).map(|note| note.message());
    Ok(json!({
        "json": summary::json(&simulation),
        "text": summary::text(&simulation),
        "notes": notes.collect::<Vec<_>>(),
        "figures": figures::elements(&simulation, None, None, None).map(|markup| markup.into_string()).concat(),
        "csv": String::from_utf8_lossy(&csv),
    }))
}

pub(crate) fn check(name: &str, text: &str) -> Result<Value, Error> {
    let case = check_record(name.as_ref(), text.to_owned(), None, &[])?;
    let analysis = Analysis::new(&case);
    Ok(json!({
        "json": check::json(&analysis),
        "text": check::text(&analysis),
        "wrong": case.require_usable().err().map(|error| error.to_string()),
        "picture": check::svg(&analysis),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::start;
    use fogcoil::input::read_coil;

    fn text(name: &str) -> String {
        start()[name].as_str().unwrap().to_owned()
    }

    #[test]
    fn a_ramp_s_bias_is_that_of_the_same_file() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../fogcoil/templates/coil.ron");
        let case = read_coil(path.as_ref()).unwrap();
        let (result, band) = (case.steady_sensitivity().unwrap(), case.sensitivity_band().unwrap());
        let found = sensitivity(&text("coil")).unwrap();
        assert_eq!(found["json"], ramp::json(&case, &result, &band));
        assert!(found["text"].as_str().unwrap().contains("tolerance (1 sigma)"));
    }

    #[test]
    fn a_profile_gives_a_row_for_each_of_its_own() {
        let profile = "time_s,chamber_c\n0,20\n600,20\n1200,30\n1230,30\n";
        let found = simulate(&text("coil"), profile, None).unwrap();
        assert_eq!(found["csv"].as_str().unwrap().lines().count(), profile.lines().count());
        assert_eq!(found["json"]["rows"], 4);
        assert!(found["figures"].as_str().unwrap().starts_with("<figure"));
        let divided = simulate(&text("coil"), profile, Some(60.0)).unwrap();
        assert_eq!(divided["json"]["rows"], 22, "21 whole minutes and the last row");
        for (profile, step) in [("time_s,chamber_c\n0,20\n9,20\n", Some(0.5)), ("time_s,chamber_c\n0,20\n9,20\n", Some(f64::NAN))]
        {
            assert!(simulate(&text("coil"), profile, step).unwrap_err().to_string().contains("too short"));
        }
        let wrong = simulate(&text("coil"), "time_s,chamber_c\n0,x\n", None).unwrap_err().to_string();
        assert!(wrong.contains("profile.csv:2: chamber_c"), "{wrong}");
    }

    #[test]
    fn a_recording_is_judged_and_a_spoilt_one_refused() {
        let row = |n: u32| format!("{n},20,20,{}\n", f64::from((n * n) % 17));
        let rows: String = (0..400).map(row).collect();
        let head = "time_s,chamber_c,spool_c,rate_deg_per_h\n";
        let found = check("a.csv", &format!("{head}{rows}")).unwrap();
        assert!(
            found["wrong"].is_null() && found["picture"].is_string() && found["text"].as_str().unwrap().contains("a.csv: usable")
        );
        let still = check("b.csv", &format!("{head}0,20,20,1\n")).unwrap();
        assert!(still["wrong"].as_str().unwrap().contains("b.csv: cannot be used"), "{still}");
    }
}
