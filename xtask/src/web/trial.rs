//! The page in a browser beside the program: one design after the other, all numbers of both.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use fogcoil::input::{read_text, with_fields};
use proof::Failure;
use proof::files::root;
use serde_json::{Value, json};

use crate::browser::{Browser, complaint, request};
use crate::tools::printed;

/// Largest relative difference between the page and the program: they round in another order.
const SAME: f64 = 1e-9;
/// The same of a bias under a profile, of its largest value: rounding adds up over modes and rows.
const SAME_BIAS: f64 = 1e-8;
/// The same of a noise model's sizes, which are sought step by step.
const SAME_NOISE: f64 = 1e-6;
const RECORDING: &str = "fixtures/concealed/open/case_03/fit.csv";
const CELL: &str = "crates/fogcoil/templates/cell.ron";
/// Designs, by what a hand does to the form of the page: keys or ids of fields, and what is written there.
const DESIGNS: [(&str, &[(&str, &str)]); 4] = [
    ("as it opens", &[]),
    ("a thicker hub of titanium", &[("spool.hub_thickness_mm", "4.5"), ("spool.material", "titanium")]),
    (
        "an octupole with tails, wound the other way",
        &[
            ("winding.pattern", "Octupole"),
            ("winding.cw_climbs", "Left"),
            ("winding.tails_m.cw", "1.5"),
            ("winding.tails_m.ccw", "0.25"),
        ],
    ),
    (ADHESIVE, &[("winding.pattern", "PracticalQuadrupole"), ("constants", "cell"), ("adhesive.youngs_modulus_mpa", "3.5")]),
];
const ADHESIVE: &str = "in a softer adhesive";
/// Waits until the page has computed, and gives what it has.
const COMPUTED: &str = "new Promise(done => { const look = () => document.documentElement.dataset.state === 'done' ? done(fogcoil()) : \
                        setTimeout(look, 20); look(); })";

/// Course of the trial.
pub(super) struct Tried {
    /// For the document.
    pub(super) text: String,
    /// Faults that were seen.
    pub(super) faults: Vec<String>,
}

/// Largest relative differences so far.
#[derive(Default)]
struct Differences {
    winding: f64,
    sensitivity: f64,
    bias: f64,
    noise: f64,
}

/// Opens the page, has it compute designs and judge a recording, and has `program` do the same.
pub(super) fn tried(chromium: &str, page: &Path, program: &Path) -> Result<Tried, Failure> {
    let place = tempfile::tempdir()?;
    let place = &place.path().canonicalize()?;
    let mut browser = Browser::launch(chromium, &place.join("browser"))?;
    let url = format!("file://{}", page.display());
    let (mut faults, mut differences) = (Vec::new(), Differences::default());
    let (mut times, mut rows) = (Vec::new(), Value::Null);
    let start = Instant::now();
    browser.open(&url)?;
    for (name, changes) in DESIGNS {
        let start = if changes.is_empty() { start } else { Instant::now() };
        browser.evaluate(&set(changes))?;
        let computed = browser.evaluate(COMPUTED)?;
        times.push(start.elapsed().as_secs_f64());
        let message = browser.evaluate("document.getElementById('wrong').textContent")?;
        if message != "" {
            return Err(Failure(format!("the page says of the design {name}: {message}")));
        }
        println!("{name}: S = {}, after {:.1} s", computed["sensitivity"]["total"], times[times.len() - 1]);
        rows = computed["bias"]["json"]["rows"].clone();
        compare(&computed, place, program, name == ADHESIVE, &mut differences)?;
    }
    recording(&mut browser, program, &mut differences)?;
    faults.extend(refusals(&mut browser)?);
    let events = browser.events();
    faults.extend(events.iter().filter_map(complaint).map(|said| format!("console: {said}")));
    let inside = |to: &String| *to == url || ["blob:", "data:"].iter().any(|inner| to.starts_with(inner));
    faults.extend(events.iter().filter_map(request).filter(|to| !inside(to)).map(|to| format!("request: {to}")));
    let Differences { winding, sensitivity, bias, noise } = differences;
    for (what, difference, most) in
        [("winding", winding, SAME), ("sensitivity", sensitivity, SAME), ("bias", bias, SAME_BIAS), ("noise", noise, SAME_NOISE)]
    {
        // not-a-number is no agreement
        if difference.is_nan() || difference > most {
            faults.push(format!("{what}: the page and the program differ by {difference:.1e}, more than {most:.0e}"));
        }
    }
    let slowest = times[1..].iter().copied().fold(0.0, f64::max);
    let text = format!(
        "In {} it opens with all its numbers after {:.1} s; a change takes {slowest:.1} s at most, sensitivity, band and a profile of {rows} rows included, on two cores that other \
         work shares. Over {} designs its numbers and the program's differ by at most {} (lengths of the winding), {sensitivity:.1e} (sensitivity and band) \
         and {bias:.1e} (bias, of its largest value), relatively; over a recording by {noise:.1e} (sizes of the noise). It makes no network request.",
        browser.version,
        times[0],
        DESIGNS.len(),
        if winding == 0.0 { "0".to_owned() } else { format!("{winding:.1e}") },
    );
    Ok(Tried { text, faults })
}

/// A script that writes into fields of the page as a hand does.
fn set(changes: &[(&str, &str)]) -> String {
    format!(
        "(() => {{ for (const [key, value] of {}) {{
            const field = document.getElementById(key) || document.querySelector('[data-key=\"' + key + '\"], [data-cell=\"' + key + '\"]');
            const option = [...field.options || []].find(option => option.text.startsWith(value));
            field.value = option ? option.value : value;
            field.dispatchEvent(new Event('input', {{ bubbles: true }}));
        }} }})()",
        json!(changes)
    )
}

/// Compares what the page has with what the program says of the same files.
fn compare(computed: &Value, place: &Path, program: &Path, of_cell: bool, differences: &mut Differences) -> Result<(), Failure> {
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let mut coil = text(&computed["design"]["coil"]);
    if of_cell {
        // the program takes the constants from the cell's file itself
        let named = ["coil.material", "dehomogenization"].map(|key| (key.to_owned(), "FromCell(\"cell.ron\")".to_owned()));
        coil = with_fields("coil.ron".as_ref(), &coil, &named)?;
        let cell = read_text(&root().join(CELL))?;
        fs::write(
            place.join("cell.ron"),
            with_fields("cell.ron".as_ref(), &cell, &[("adhesive.youngs_modulus_mpa".into(), "3.5".into())])?,
        )?;
    }
    fs::write(place.join("coil.ron"), coil)?;
    fs::write(place.join("profile.csv"), include_str!("../../../crates/fogcoil/templates/profile.csv"))?;
    let run = |words: &str| printed(Command::new(program).args(words.split(' ')).current_dir(place));
    let wound: Value = serde_json::from_str(&run("wind coil.ron --json --quiet")?)?;
    differences.winding = differences.winding.max(apart(&computed["design"]["winding"], &wound, &|_| true));
    let ramp: Value = serde_json::from_str(&run("sensitivity coil.ron --json --quiet")?)?;
    // an estimated error is a difference of two numbers that agree in their first digits; in a ramp the Shupe bias is rounding, and part of the total;
    // a share is the square of a change
    let exact = |key: &str| !["error_estimate", "shupe", "share"].contains(&key);
    differences.sensitivity = differences.sensitivity.max(apart(&computed["sensitivity"], &ramp, &exact));
    run("simulate coil.ron --profile profile.csv --step 30 --out bias.csv --quiet --no-cache")?;
    let bias = courses(&text(&computed["bias"]["csv"]), &fs::read_to_string(place.join("bias.csv"))?);
    differences.bias = differences.bias.max(bias);
    Ok(())
}

/// Drops a recording on the page.
fn recording(browser: &mut Browser, program: &Path, differences: &mut Differences) -> Result<(), Failure> {
    let text = fs::read_to_string(root().join(RECORDING))?;
    browser.evaluate(&format!(
        "(() => {{ const given = new DataTransfer(); given.items.add(new File([{}], 'fit.csv'));
            document.body.dispatchEvent(new DragEvent('drop', {{ bubbles: true, cancelable: true, dataTransfer: given }})); }})()",
        json!(text)
    ))?;
    let judged = browser.evaluate(
        "new Promise(done => { const look = () => fogcoil().check ? done(fogcoil().check.json) : setTimeout(look, 20); look(); })",
    )?;
    let own: Value = serde_json::from_str(&printed(
        Command::new(program).args(["check", RECORDING, "--json", "--quiet"]).current_dir(root()),
    )?)?;
    differences.noise = apart(&judged["noise"], &own["noise"], &|key| !key.contains("error") && !key.contains("interval"));
    if judged["usable"] != own["usable"] || judged["findings"] != own["findings"] {
        return Err(Failure("the page judges a recording otherwise than the program".into()));
    }
    Ok(())
}

/// Bad values are refused with the program's words, and good ones are computed again.
fn refusals(browser: &mut Browser) -> Result<Vec<String>, Failure> {
    let mut faults = Vec::new();
    for (value, message) in [("-3", "hub_thickness_mm"), ("4", "")] {
        browser.evaluate(&set(&[("spool.hub_thickness_mm", value)]))?;
        browser.evaluate(COMPUTED)?;
        let said = browser.evaluate("document.getElementById('wrong').textContent")?;
        let said = said.as_str().unwrap_or_default();
        if said.is_empty() != message.is_empty() || !said.contains(message) {
            faults.push(format!("of a hub of {value} mm the page says {said:?}"));
        }
    }
    Ok(faults)
}

/// Largest relative difference of the numbers in two values, of the keys that are `counted`; infinite where they are not alike otherwise.
fn apart(a: &Value, b: &Value, counted: &dyn Fn(&str) -> bool) -> f64 {
    match (a, b) {
        (Value::Object(one), Value::Object(other)) if one.len() == other.len() => one
            .iter()
            .filter(|(key, _)| counted(key))
            .map(|(key, value)| other.get(key).map_or(f64::INFINITY, |other| apart(value, other, counted)))
            .fold(0.0, f64::max),
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            one.iter().zip(other).map(|(a, b)| apart(a, b, counted)).fold(0.0, f64::max)
        }
        (Value::Number(_), Value::Number(_)) => match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) if a == b => 0.0,
            (Some(a), Some(b)) => (a - b).abs() / a.abs().max(b.abs()),
            _ => f64::INFINITY,
        },
        _ if a == b => 0.0,
        _ => f64::INFINITY,
    }
}

/// Largest difference of two tables of numbers, relative to the largest of each column; infinite where they are not alike.
fn courses(a: &str, b: &str) -> f64 {
    let columns = |text: &str| {
        let mut lines = text.lines();
        let names: Vec<String> = lines.next().unwrap_or_default().split(',').map(str::to_owned).collect();
        let rows: Vec<Vec<f64>> =
            lines.map(|line| line.split(',').map(|field| field.parse().unwrap_or(f64::NAN)).collect()).collect();
        (names, rows)
    };
    let ((names, a), (others, b)) = (columns(a), columns(b));
    if names != others || a.len() != b.len() || a.is_empty() || a.iter().chain(&b).any(|row| row.len() != names.len()) {
        return f64::INFINITY;
    }
    let column = |n: usize| {
        let largest = b.iter().map(|row| row[n].abs()).fold(0.0, f64::max);
        let apart = a.iter().zip(&b).map(|(a, b)| (a[n] - b[n]).abs());
        // a field that is no number is as far off as can be
        let apart = apart.fold(0.0, |most: f64, d| if d.is_nan() { f64::INFINITY } else { most.max(d) });
        if apart == 0.0 { 0.0 } else { apart / largest }
    };
    (0..names.len()).map(column).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_compared_and_all_else_must_be_the_same() {
        let all: &dyn Fn(&str) -> bool = &|_| true;
        assert_eq!(apart(&json!({"a": [1.0, 2], "b": "x"}), &json!({"a": [1.0, 2], "b": "x"}), all), 0.0);
        assert!((apart(&json!([1.0, 2.0]), &json!([1.0, 2.5]), all) - 0.2).abs() < 1e-15);
        for other in [json!({"a": 1.0, "b": "y"}), json!({"a": 1.0}), json!({"a": "1", "b": "x"}), json!([1.0])] {
            assert_eq!(apart(&json!({"a": 1.0, "b": "x"}), &other, all), f64::INFINITY, "{other}");
        }
        assert_eq!(apart(&json!({"error": 1.0}), &json!({"error": 2.0}), &|key| key != "error"), 0.0);
    }

    #[test]
    fn courses_are_compared_column_by_column() {
        assert_eq!(courses("t,x\n0,1\n1,-4\n", "t,x\n0,1\n1,-4\n"), 0.0);
        assert!((courses("t,x\n0,1\n1,-4\n", "t,x\n0,1.4\n1,-4\n") - 0.1).abs() < 1e-15);
        for other in ["t,y\n0,1\n1,-4\n", "t,x\n0,1\n", "t,x\n0,1\n1,a\n", "t,x\n0,1\n1\n", ""] {
            assert_eq!(courses("t,x\n0,1\n1,-4\n", other), f64::INFINITY, "{other}");
        }
    }
}
