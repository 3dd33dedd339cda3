//! `fogcoil sensitivity`: bias per temperature rate in a steady ramp, by part.

use coil::{Band, Mechanics, Number, SteadySensitivity, Tolerance};
use serde_json::{Value, json};

use crate::input::{CoilCase, Origin, keyed, keyed_sd};
use crate::table::{plus_minus, significant, table};
use crate::units::parameter_unit;

/// Contribution of a number of the design to a band.
pub(crate) struct Share {
    /// Its key.
    pub(crate) key: &'static str,
    /// One standard deviation of it, in words.
    pub(crate) tolerance: String,
    /// The change that it causes.
    pub(crate) change: f64,
    /// Share of the variance.
    pub(crate) share: f64,
}

/// One standard deviation of a number of a design in words, a share or in the unit of its key; `None` of one that is exact or that the design has not.
pub(crate) fn tolerance_in_words(case: &CoilCase, number: Number) -> Option<String> {
    let (key, _) = keyed(number, &case.design)?;
    let sd = keyed_sd(number, &case.design, &case.tolerances)?;
    match case.tolerances.of(number) {
        Tolerance::Relative(share) => Some(format!("{} %", significant(100.0 * share, 2))),
        Tolerance::Absolute(_) => Some(format!("{} {}", significant(sd, 2), parameter_unit(key))),
        Tolerance::Exact => None,
    }
}

/// Least share of the variance that is worth a line.
const WORTH: f64 = 0.005;

impl Share {
    /// Shares of a design's band that are worth a line, the largest first.
    pub(crate) fn of(case: &CoilCase, band: &Band) -> Vec<Self> {
        Self::all(case, band).into_iter().filter(Self::is_worth).collect()
    }

    fn is_worth(&self) -> bool {
        self.share.abs() >= WORTH
    }

    /// Shares of a design's band, the largest first.
    fn all(case: &CoilCase, band: &Band) -> Vec<Self> {
        let of = |((number, change), share): (&(Number, f64), &f64)| {
            let (key, _) = keyed(*number, &case.design)?;
            let tolerance = tolerance_in_words(case, *number)?;
            Some(Self { key, tolerance, change: *change, share: *share })
        };
        band.changes.iter().zip(&band.shares).filter_map(of).collect()
    }
}

/// The parts and their total in (deg/h)/(degC/min), the error estimate of the total in the same unit, the fibre's length in m, and the spread of the total
/// by tolerances.
pub fn json(case: &CoilCase, result: &SteadySensitivity, band: &Band) -> Value {
    let parts = result.sensitivity;
    let share = |s: Share| json!({"key": s.key, "tolerance": s.tolerance, "change": s.change, "share": s.share});
    json!({
        "tolerance_sd": band.sd,
        "tolerance_shares": Share::all(case, band).into_iter().map(share).collect::<Vec<_>>(),
        "shupe": parts.shupe,
        "eo_axial": parts.eo_axial,
        "eo_radial": parts.eo_radial,
        "total": parts.total(),
        "length_m": result.length,
        "error_estimate": result.error_estimate,
    })
}

/// Half of the last place to which changes are told.
const LAST_PLACE: f64 = 5e-5;

/// The parts as a table, the tolerances that matter, or `all`, and the origin of the numbers behind them.
pub fn text(case: &CoilCase, result: &SteadySensitivity, band: &Band, all: bool) -> String {
    let (parts, errors) = (result.sensitivity, result.part_errors);
    let row = |name: &str, value: f64, error: f64, meaning: &str| {
        vec![name.to_owned(), format!("{:.5}", (value * 1e5).round() / 1e5 + 0.0), plus_minus(error), meaning.to_owned()]
    };
    let rows = [
        row("shupe", parts.shupe, errors.shupe, "thermal phase, eq. (1)"),
        row("eo_axial", parts.eo_axial, errors.eo_axial, "strain along the fibre, eq. (2)"),
        row("eo_radial", parts.eo_radial, errors.eo_radial, "strain across the fibre, eq. (2)"),
        row("total", parts.total(), result.error_estimate, "the sum of the three"),
    ];
    let head = ["tolerance (1 sigma)", "", "change", "share"].map(str::to_owned).to_vec();
    let share = |s: Share| {
        let percent = 100.0 * s.share;
        let percent = if s.is_worth() { format!("{percent:.0}") } else { significant(percent, 1) };
        // what is less than the last place is told by its size
        let is_small = s.change != 0.0 && s.change.abs() < LAST_PLACE;
        let change = if is_small { format!("{:+.1e}", s.change) } else { format!("{:+.4}", s.change) };
        vec![s.key.into(), s.tolerance, change, format!("{percent} %")]
    };
    let (shown, less): (Vec<Share>, Vec<Share>) = Share::all(case, band).into_iter().partition(|s| all || s.is_worth());
    let more = if less.is_empty() { String::new() } else { format!("{} more below 0.5 %: --all\n\n", less.len()) };
    let shares: Vec<Vec<String>> = std::iter::once(head).chain(shown.into_iter().map(share)).collect();
    format!(
        "{}: steady-ramp sensitivity in (deg/h)/(degC/min), numerical error beside it\n\n{}\n\
         tolerances of the design leave the total uncertain by {} (1 sigma, linear); optical constants are taken as exact\n\n{}\n{more}\
         fibre {:.4} m; {} unknowns\n\
         coil constants: {}; dehomogenisation row: {}\n\
         The value follows from the file's spool, bonding and materials; where one of them was chosen to match a measurement, so was\n\
         this value.\n",
        case.name,
        table(&rows),
        significant(band.sd, 2),
        table(&shares),
        result.length,
        result.unknowns,
        origin(&case.provenance.material),
        origin(&case.provenance.dehomogenization),
    ) + match case.design.mechanics {
        Mechanics::Elastic => "",
        _ => {
            "The file's mechanics change with temperature or time; this is the sensitivity of the nominal state, see `simulate`.\n"
        }
    }
}

pub(crate) fn origin(origin: &Origin) -> String {
    match origin {
        Origin::Given => "as given in the file".into(),
        Origin::Cell(path) => format!("homogenised from {}", files::shown_path(path)),
        Origin::Printed => "Table II of Osunluk et al. as printed, misprints included".into(),
    }
}
