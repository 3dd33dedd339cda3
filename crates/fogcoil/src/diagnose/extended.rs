//! The extended model: the design with what was found put in at its place, as a coil file.

use coil::{Design, Drifts, Mechanics};
use diagnosis::{Active, ForwardModel, Place, Posterior, Role, Verdict};
use mechanisms::{
    Gyro, REFERENCE_C, with_air, with_glass_transition, with_heater, with_hub_resistance, with_mount, with_opening, with_polymer,
    with_relaxation, with_tail,
};
use winding::LayerDefect;

use super::{Outcome, Record};
use crate::input::check_coil;
use crate::output::coil_file;
use crate::table::significant;

impl Outcome {
    /// A coil file of the design with what was found, fitted, that `fogcoil simulate` runs.
    ///
    /// Where the nominal model suffices, or predicts a held-out record better, it is the nominal design.
    ///
    /// # Errors
    /// Why there is none: nothing was found, or a coil file cannot hold it.
    pub fn model(&self) -> Result<String, String> {
        let best = &self.diagnosis.best().fit;
        let nominal = self.gyro.library().design();
        let found = match self.diagnosis.verdict {
            Verdict::Unknown | Verdict::None => Vec::new(),
            _ if !self.accepted() => Vec::new(),
            Verdict::Recalibrate | Verdict::Explained => best.posteriors(&self.gyro),
        };
        let mut comments = self.heading();
        if found.is_empty() {
            return Ok(coil_file(&self.name, nominal, &comments));
        }
        comments.extend(found.iter().filter(|p| p.record.is_none()).map(|p| said(p, self.interval(p))));
        let mut design = nominal.clone();
        for posterior in found.iter().filter(|p| p.place == Place::Nominal(Role::Constant)) {
            match with_constant(&design, &posterior.name, posterior.value()) {
                Some(changed) => design = changed,
                None => return Err(format!("a coil file cannot hold a change of {}", posterior.name)),
            }
        }
        for (place, active) in best.active.iter().enumerate() {
            let id = self.id(active.mechanism);
            if let (Some((name, value)), Some([low, high])) = (self.choice(active), self.diagnosis.choice(place)) {
                comments.push(format!("  {name} = {value} ({low} to {high}), compared with every other"));
            }
            comments.extend(caveat(id, nominal).map(str::to_owned));
            match with_mechanism(&self.gyro, &design, active) {
                Some(changed) => design = changed,
                None => return Err(format!("a coil file cannot hold {}", self.names().join(" and "))),
            }
        }
        let name = match self.names().join(" and ") {
            names if names.is_empty() => format!("{}, recalibrated", self.name),
            names => format!("{}, {names}", self.name),
        };
        let text = coil_file(&name, &design, &comments);
        check_coil("the extended model".as_ref(), &text).map_err(|error| error.to_string())?;
        Ok(text)
    }

    /// What the file holds, and from what.
    fn heading(&self) -> Vec<String> {
        let names = |records: &mut dyn Iterator<Item = &Record>| records.map(Record::name).collect::<Vec<_>>().join(", ");
        let mut lines = vec![format!("{}, extended by fogcoil diagnose.", self.name), self.verdict()];
        lines.push(format!("Fitted to: {}.", names(&mut self.fits.iter())));
        if !self.holdouts.is_empty() {
            let verdict = if self.accepted() { "predicted no worse than by" } else { "predicted worse than by" };
            lines.push(format!(
                "Held out: {}; {verdict} the nominal design.",
                names(&mut self.holdouts.iter().map(|held| &held.record))
            ));
        }
        lines.push(match self.diagnosis.verdict {
            Verdict::None | Verdict::Unknown => "This is the nominal design, unchanged.".into(),
            _ if !self.accepted() => "What was fitted is not accepted: this is the nominal design, unchanged.".into(),
            _ => "Fitted, not measured; most probable values with 90 % intervals:".to_owned(),
        });
        lines
    }

    /// 90 % interval of an unknown of the best candidate, with the doubt about its mechanism's choice in it.
    pub(super) fn interval(&self, posterior: &Posterior) -> [f64; 2] {
        let with_choice = match posterior.place {
            Place::Mechanism(place) => self.diagnosis.parameters.get(place),
            Place::Nominal(_) => None,
        };
        let same = with_choice.into_iter().flatten().find(|estimate| estimate.name == posterior.name);
        same.map_or_else(|| posterior.ci90(), |estimate| estimate.ci90)
    }

    /// Name and value of a mechanism's choice.
    pub(super) fn choice(&self, active: &Active) -> Option<(&str, f64)> {
        let (name, _) = self.gyro.mechanisms()[active.mechanism].choice.as_ref()?;
        Some((name, active.choice?))
    }
}

impl Record {
    /// Its file's name, with the folder: records of many units are called alike.
    pub(super) fn name(&self) -> String {
        let parts: Vec<_> = self.file.components().rev().take(2).map(|part| part.as_os_str().to_string_lossy()).collect();
        parts.into_iter().rev().collect::<Vec<_>>().join("/")
    }
}

fn said(posterior: &Posterior, ci90: [f64; 2]) -> String {
    let [low, high] = ci90.map(|end| significant(end, 5));
    let what = match posterior.place {
        Place::Mechanism(_) => "",
        Place::Nominal(Role::Constant) => ", factor on the design's own",
        Place::Nominal(Role::ModelError) => ", allowed for the model's own error, not in this file",
    };
    format!("  {} = {} ({low} to {high}){what}", posterior.name, significant(posterior.value(), 5))
}

/// What a file says less exactly than the fit.
fn caveat(id: &str, nominal: &Design) -> Option<&'static str> {
    match id {
        "winding-defect" => Some("  turns are whole in this file"),
        "self-heating" => Some("  simulate switches the heater on at the first row, not before_s earlier"),
        "glass-transition" => Some("  the transition is tabulated, linear between the rows"),
        "sensor-lag" if nominal.sensor.lag > 0.0 => Some("  the thermometer's own lag and this one are added"),
        _ => None,
    }
}

/// A wide transition is tabulated between these \[°C\]; no coil goes there.
const COLDEST_C: f64 = -250.0;
const HOTTEST_C: f64 = 500.0;

/// A mechanism of the library in the design; `None` if a coil file has no place for it, or the place is taken.
pub fn with_mechanism(gyro: &Gyro, design: &Design, active: &Active) -> Option<Design> {
    let mechanism = &gyro.mechanisms()[active.mechanism];
    let of = |name: &str| mechanism.parameters.iter().position(|p| p.name == name).map(|at| active.values[at]);
    let one = |name: &str, with: &dyn Fn(f64) -> Design| of(name).map(with);
    let elastic = design.mechanics == Mechanics::Elastic;
    let mut changed = design.clone();
    match mechanism.id.as_str() {
        "tail-asymmetry" => return one("tail_m", &|v| with_tail(design, v)),
        "adhesive-content" => return one("polymer_fraction_change", &|v| with_polymer(design, v)),
        "interface-resistance" => return one("resistance_m2k_per_w", &|v| with_hub_resistance(design, v)),
        "air-path" => return one("conductivity_factor", &|v| with_air(design, v)),
        "axial-heat-path" => return one("conductance_w_per_m2k", &|v| with_mount(design, v)),
        "self-heating" => return one("power_w", &|v| with_heater(design, v)),
        "glass-transition" if elastic => {
            let (modulus, expansion) = (of("e_r_factor")?, of("alpha_r_factor")?);
            changed = with_glass_transition(design, of("tg_c")?, of("width_k")?, modulus, expansion);
            if let Mechanics::TemperatureTable(rows) = &mut changed.mechanics {
                rows.retain(|row| (COLDEST_C..HOTTEST_C).contains(&row.temperature));
            }
        }
        "viscoelastic-relaxation" if elastic => return Some(with_relaxation(design, of("relaxing_fraction")?, of("tau_s")?)),
        "debond" if elastic => {
            return Some(with_opening(design, of("debond_c")?, of("hysteresis_k")?, of("fraction")?));
        }
        "winding-defect" => {
            let (layer, turns) = (active.choice? as usize, of("turns")?.round() as i32);
            changed.winding.defect = (turns != 0).then_some(LayerDefect { layer, turns });
        }
        "sensor-lag" => changed.sensor.lag += of("lag_s")?,
        "thermo-optic-curvature" => {
            changed.drifts = about_reference(design.drifts)?;
            changed.drifts.thermo_optic_curvature += of("curvature_per_k2")?;
        }
        "rate-temperature-coefficient" => {
            changed.drifts = about_reference(design.drifts)?;
            changed.drifts.read_out += of("coefficient_deg_per_h_per_k")? / bias::units::DEG_PER_H_PER_RAD_PER_S;
        }
        _ => return None,
    }
    Some(changed)
}

/// The drifts about the library's reference temperature, if the design's own vanish there or nowhere.
fn about_reference(own: Drifts) -> Option<Drifts> {
    let none = own.thermo_optic_curvature == 0.0 && own.read_out == 0.0;
    (none || own.reference == REFERENCE_C).then_some(Drifts { reference: REFERENCE_C, ..own })
}

/// A constant of the design times a factor, by the name that the forward model gives it.
fn with_constant(design: &Design, name: &str, factor: f64) -> Option<Design> {
    let mut changed = design.clone();
    let elastic = &mut changed.body.elastic;
    match name {
        "E_r and G" => {
            elastic.e_r *= factor;
            elastic.g_zr *= factor;
        }
        "alpha_r" => elastic.alpha_r *= factor,
        "E_z" => elastic.e_z *= factor,
        "alpha_z" => elastic.alpha_z *= factor,
        "spool expansion" => {
            if let Some(spool) = &mut changed.spool {
                spool.material.elastic.thermal_expansion *= factor;
            }
        }
        "conductivity of the surroundings" => changed.surroundings.conductivity *= factor,
        "dn/dT" => changed.optics.thermo_optic *= factor,
        _ => return None,
    }
    Some(changed)
}
