//! `fogcoil trim`: tails, or turns to cut off, that null the steady sensitivity, and the bias that remains in transients.

use std::fmt::Write;

use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Dynamics, STANDARD, TailTrim, TurnTrim, trim_tails, trim_turns, with_asymmetry};
use serde_json::{Value, json};
use winding::Half;

use crate::Error;
use crate::input::{CoilCase, ProfileCase};
use crate::sensitivity::Share;
use crate::summary::over_time;
use crate::table::{significant, table};
use crate::tabular::{Column, Table};
use crate::wind::name;

/// Turns cut off from either end, at most, in the table.
const MOST_TURNS: usize = 12;

/// Effect of trimming on a coil.
#[derive(Debug, Clone)]
pub struct Trim {
    /// Trimming by tails.
    pub tails: TailTrim,
    /// Trimming by turns.
    pub turns: Vec<TurnTrim>,
    /// Root mean square and peak of |bias| under the profile \[deg/h\], before and after trimming the tails.
    pub transients: Option<[[f64; 2]; 2]>,
}

/// Trims a coil; under `profile`, if there is one, shows what the tails' trim leaves.
///
/// # Errors
/// [`files::Error::Coil`] if the coil cannot be solved.
pub fn trim(case: &CoilCase, profile: Option<&ProfileCase>) -> Result<Trim, Error> {
    let at = Error::of_coil(&case.file);
    let tails = trim_tails(&case.design, &case.tolerances).map_err(at)?;
    let turns = trim_turns(&case.design, MOST_TURNS).map_err(at)?;
    let run = |design: &Design, profile: &ProfileCase| -> Result<[f64; 2], Error> {
        let rows = Dynamics::new(design, &profile.drives, &STANDARD).and_then(|d| d.simulate(&profile.profile)).map_err(at)?;
        let rates: Vec<f64> = rows.iter().map(|row| row.rate() * DEG_PER_H_PER_RAD_PER_S).collect();
        let course = profile.profile.time.iter().copied().zip(rates.iter().copied());
        Ok([over_time(course), rates.iter().fold(0.0, |m: f64, r| m.max(r.abs()))])
    };
    let transients = match profile {
        None => None,
        Some(profile) => Some([run(&case.design, profile)?, run(&with_asymmetry(&case.design, tails.cw_minus_ccw), profile)?]),
    };
    Ok(Trim { tails, turns, transients })
}

/// The result as JSON; lengths in m, sensitivities in (deg/h)/(degC/min), bias in deg/h.
pub fn json(trim: &Trim) -> Value {
    let turns =
        |t: &TurnTrim| json!({ "half": name(t.half), "turns": t.turns, "length_m": t.length, "sensitivity": t.sensitivity });
    let transients = trim.transients.map(|[[rms, peak], [rms_after, peak_after]]| {
        json!({ "rms_before": rms, "peak_before": peak, "rms_after": rms_after, "peak_after": peak_after })
    });
    json!({
        "sensitivity": trim.tails.before,
        "tail_cw_minus_ccw_m": trim.tails.cw_minus_ccw,
        "tail_standard_uncertainty_m": trim.tails.uncertainty(),
        "sensitivity_per_m": trim.tails.slope,
        "turns_cut_off": trim.turns.iter().map(turns).collect::<Vec<_>>(),
        "transients_deg_per_h": transients,
    })
}

/// The remaining sensitivity, a row for each number of turns cut off either end.
pub fn turns_cut_off(trim: &Trim) -> Table {
    let all = &trim.turns;
    let numbers = |name: &str, of: fn(&TurnTrim) -> f64| Column::numbers(name, all.iter().map(|t| Some(of(t))).collect());
    let columns = vec![
        Column::texts("half", all.iter().map(|t| Some(name(t.half).to_owned())).collect()),
        Column::whole("turns", all.iter().map(|t| t.turns as i64).collect()),
        numbers("length_m", |t| t.length),
        numbers("sensitivity", |t| t.sensitivity),
    ];
    Table { columns, about: Vec::new() }
}

/// The result in words and tables.
pub fn text(case: &CoilCase, trim: &Trim) -> String {
    let TailTrim { cw_minus_ccw, band, slope, before } = &trim.tails;
    let uncertainty = trim.tails.uncertainty();
    let (longer, other, difference) =
        if *cw_minus_ccw >= 0.0 { ("CW", "CCW", *cw_minus_ccw) } else { ("CCW", "CW", -cw_minus_ccw) };
    let tails = case.design.winding.tails;
    let more = cw_minus_ccw - (tails.cw - tails.ccw);
    let [add, cut] = if more >= 0.0 { ["CW", "CCW"] } else { ["CCW", "CW"] };
    let spare = if cut == "CW" { tails.cw } else { tails.ccw };
    let or = if spare >= more.abs() { format!(", or cut as much off {cut}") } else { String::new() };
    let mut text = format!(
        "{}: sensitivity {before:.4} (deg/h)/(degC/min); two ways to null it\n\n\
         tails: the {longer} tail must be {difference:.3} ± {uncertainty:.3} m longer than the {other} tail (± standard uncertainty)\n\
         in this file CW is {:.3} m and CCW {:.3} m: add {length:.3} m to {add}{or}\n\
         each metre of CW adds {slope:.3} (deg/h)/(degC/min); the spread that tolerances cause stays\n\n",
        case.name,
        tails.cw,
        tails.ccw,
        length = more.abs()
    );
    let head = ["of the uncertainty, by the tolerance of", "1 sd", "length", ""].map(str::to_owned);
    let rows = Share::of(case, band).into_iter().map(|share| {
        let by = (share.change / slope).abs();
        [format!("  {}", share.key), share.tolerance, format!("{by:.3}"), "m".into()]
    });
    let _ = writeln!(text, "{}", table(&std::iter::once(head).chain(rows).collect::<Vec<_>>()));
    let best = trim.turns.iter().min_by(|a, b| a.sensitivity.abs().total_cmp(&b.sensitivity.abs()));
    if let Some(best) = best.filter(|best| best.sensitivity.abs() < before.abs()) {
        let TurnTrim { half, turns, length, sensitivity } = best;
        let _ = writeln!(
            text,
            "turns: cut {turns} off the {} end ({length:.2} m), which leaves {sensitivity:.4} (deg/h)/(degC/min)",
            name(*half)
        );
    }
    text.push_str("(a turn at an end of the fibre counts by its own strain less the mean, not by its length: turns and tails may differ in sign)\n");
    let _ = write!(text, "\n{}", table(&cut_off(trim)));
    if let Some([[rms, peak], [rms_after, peak_after]]) = trim.transients {
        let _ = writeln!(
            text,
            "\nunder the profile, bias before: rms {rms:.4}, peak {peak:.4} deg/h; with the tails trimmed: rms {rms_after:.4}, peak \
             {peak_after:.4} deg/h\n(transients that a steady null does not touch)"
        );
    }
    text
}

/// The sensitivity that is left, a row for each number of turns cut off.
fn cut_off(trim: &Trim) -> Vec<Vec<String>> {
    let of = |half: Half| trim.turns.iter().filter(move |t| t.half == half);
    let mut rows = vec![["turns cut off", "CCW end", "CW end", "(deg/h)/(degC/min)"].map(str::to_owned).to_vec()];
    rows.extend(of(Half::Ccw).zip(of(Half::Cw)).map(|(ccw, cw)| {
        vec![format!("  {}", ccw.turns), significant(ccw.sensitivity, 4), significant(cw.sensitivity, 4), String::new()]
    }));
    rows
}
