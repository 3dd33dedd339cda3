//! A lot, calibrated: its coil file, and in words and as JSON.

use diagnosis::{Believed, Lot};
use recording::statistics::normal_quantile;
use serde_json::{Value, json};

use super::{Constant, Outcome, Told};
use crate::Error;
use crate::input::{check_coil, keyed};
use crate::keys::interval_by_key;
use crate::left::Left;
use crate::output::coil_file;
use crate::table::{significant, table};

impl Outcome {
    /// The coil file of the lot.
    ///
    /// # Errors
    /// Reason why a coil file cannot hold it.
    pub fn file(&self) -> Result<String, Error> {
        let (design, tolerances) = self.design();
        let name = format!("{}, calibrated", self.case.name);
        let unit = |unit: &Told| {
            let names: Vec<String> = unit.files.iter().map(|f| files::shown_path(&f.file)).collect();
            format!("  {}{}", names.join(", "), if unit.good { "" } else { " (doubted)" })
        };
        let heading = format!("{}, {}, by fogcoil calibrate:", self.case.name, self.of_units());
        let told = "Values are fitted to their records; tolerances are of a further unit of the lot, with their correlations.";
        let warnings = self.notes.iter().filter(|note| note.is_warning()).map(ToString::to_string);
        let comments: Vec<String> =
            std::iter::once(heading).chain(self.units.iter().map(unit)).chain([told.to_owned()]).chain(warnings).collect();
        let text = coil_file(&name, &design, &tolerances, &comments);
        check_coil("the lot's design".as_ref(), &text)?;
        Ok(text)
    }

    /// The lot's units in words: those are called good that fit and that nothing else speaks against.
    fn of_units(&self) -> String {
        let (all, good) = (self.units.len(), self.units.iter().filter(|unit| unit.good).count());
        let units = if all == 1 { "unit" } else { "units" };
        match good {
            good if good == all => format!("the lot of {all} good {units}"),
            0 => format!("the lot of {all} {units}, none of which can be called good"),
            good => format!("the lot of {all} {units}, {good} of which can be called good"),
        }
    }

    /// Some constants as JSON.
    fn told_json(&self, believed: &Believed) -> Value {
        let (half, sd) = (half_of_90(), believed.sd());
        let of = |(k, constant): (usize, &Constant)| {
            let u = believed.mean[k];
            let at = [u, u - half * sd[k], u + half * sd[k]].map(|u| constant.prior.value(u));
            let (key, value, ci90) = interval_by_key(&self.case.design, self.told(believed), &constant.name, at)?;
            Some(json!({"key": key, "value": value, "ci90": ci90, "sigmas": u}))
        };
        self.constants.iter().enumerate().filter_map(of).collect()
    }

    /// The lot as one JSON object.
    pub fn json(&self) -> Value {
        let files = |unit: &Told| unit.files.iter().map(|f| f.file.display().to_string()).collect::<Vec<_>>();
        let left = |left: Option<Left>| {
            left.map(|Left { rms, noise, with_drift }| json!({"rms": rms, "noise": noise, "noise_with_drift": with_drift}))
        };
        let units = self.units.iter().zip(&self.lot.units);
        let sd = self.lot.further.sd();
        let tolerances = self.constants.iter().enumerate().filter_map(|(k, constant)| {
            let (key, _) = keyed(constant.number, &self.case.design)?;
            Some(json!({"key": key, "drawing": constant.prior.sd(), "lot": constant.prior.sd() * sd[k]}))
        });
        let effects = self.effects.iter().map(|(id, [drawing, lot])| json!({"id": id, "drawing": drawing, "lot": lot}));
        json!({
            "constants": self.told_json(&self.lot.common),
            "units": units
                .map(|(unit, believed)| json!({
                    "name": unit.name,
                    "files": files(unit),
                    "good": unit.good,
                    "left": {"rate_deg_per_h": left(unit.left.rate), "spool_c": left(unit.left.spool)},
                    "constants": self.told_json(believed),
                }))
                .collect::<Vec<_>>(),
            "tolerances": tolerances.collect::<Vec<_>>(),
            "stands_out": effects.collect::<Vec<_>>(),
            "notes": self.notes,
        })
    }

    /// Residuals of every unit's records beside their noise.
    fn left(&self) -> String {
        let mut rows =
            vec![["unit", "of the", "rms left", "noise of a row, 1 sd", "with usual drift", ""].map(str::to_owned).to_vec()];
        for unit in &self.units {
            for (name, of, left) in unit.left.channels() {
                let [rms, noise, with_drift] =
                    [left.rms, left.noise, left.with_drift].map(|value| format!("{} {of}", significant(value, 3)));
                let says = if left.is_misfit() { "does not fit" } else { "" };
                rows.push(vec![unit.name.clone(), name.to_owned(), rms, noise, with_drift, says.to_owned()]);
            }
        }
        table(&rows)
    }

    /// The constants in which the lot differs from the drawing, in a sentence.
    fn deviation(&self) -> String {
        let (common, sd) = (&self.lot.common, self.lot.common.sd());
        let off = |k: usize| common.mean[k].abs();
        let mut order: Vec<usize> = (0..self.constants.len()).collect();
        order.sort_by(|a, b| off(*b).total_cmp(&off(*a)));
        let said = |k: usize| format!("{} ({:+.1} ± {:.1} tolerances)", self.constants[k].name, common.mean[k], sd[k]);
        let beyond: Vec<String> = order.iter().filter(|k| off(**k) > 2.0 * sd[**k]).map(|k| said(*k)).collect();
        match (beyond.is_empty(), order.first()) {
            (false, _) => format!("It is off the drawing, by more than two standard deviations, in {}.", beyond.join(", ")),
            (true, Some(farthest)) => {
                format!("It is off the drawing in no constant for certain; the farthest: {}.", said(*farthest))
            }
            (true, None) => String::new(),
        }
    }

    /// The lot as text: residuals of each unit, the lot's constants, each unit's, and the effects that a further unit shows the sooner.
    pub fn text(&self) -> String {
        let Lot { common, units, further } = &self.lot;
        let (half, sd) = (half_of_90(), common.sd());
        let mut rows = vec![["constant (fitted)", "lot", "90 % interval", "sigma", "tolerance"].map(str::to_owned).to_vec()];
        // more do not fit a line; they are in the JSON object
        let shown = if units.len() > MOST_UNITS { &[][..] } else { &units[..] };
        rows[0].extend(self.units.iter().take(shown.len()).map(|unit| unit.name.clone()));
        for (k, constant) in self.constants.iter().enumerate() {
            let u = common.mean[k];
            let at = |u: f64| constant.prior.value(u);
            let told = |u: f64| significant(at(u), 4);
            let mut row = vec![
                constant.name.clone(),
                told(u),
                format!("{} to {}", told(u - half * sd[k]), told(u + half * sd[k])),
                format!("{u:+.1}"),
                format!("{} -> {}", significant(constant.prior.sd(), 2), significant(constant.prior.sd() * further.sd()[k], 2)),
            ];
            row.extend(shown.iter().map(|unit| told(unit.mean[k])));
            rows.push(row);
        }
        let mut found: Vec<&(String, [f64; 2])> = self.effects.iter().filter(|(_, [drawing, _])| *drawing > 0.0).collect();
        found.sort_by(|a, b| (b.1[1] / b.1[0]).total_cmp(&(a.1[1] / a.1[0])));
        let effects = found.iter().map(|(id, [drawing, lot])| vec![id.clone(), format!("{:.2}", drawing / lot)]);
        let head = vec!["mechanism".to_owned(), "smallest effect, lot / drawing".to_owned()];
        let effects: Vec<Vec<String>> = std::iter::once(head).chain(effects).collect();
        format!(
            "{}: {}. {}\n\nWhat its constants leave of each unit, in the record in which that is most beside the noise:\n\n{}\n\
             Noise of a row: white, from neighbours' differences.\n\
             A constant is a factor on the drawing's value; sigma is what the lot deviates by, in tolerances;\n\
             tolerance: of a unit about the drawing, and of a further unit about the lot.\n\n{}\n\
             The smallest effect of a fault that a record of a further unit shows, with the lot's design over with the drawing\n\
             (0.50: half as large a fault is found; 1.00: none that is smaller; a mechanism that looks like a constant which the lot narrows is told from it all the same):\n\n{}",
            self.case.name,
            self.of_units(),
            self.deviation(),
            self.left(),
            table(&rows),
            table(&effects),
        )
    }
}

/// Most units that have a column each.
const MOST_UNITS: usize = 6;

/// Standard deviations from the middle of a normal density to the ends of its interval of 90 %.
fn half_of_90() -> f64 {
    normal_quantile(0.95)
}
