//! Truth of an ordinary unit: opened by the scorer only, after every answer is written.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::Failure;
use crate::truth::ConcealedEffect;

/// The truth of one unit, as `truth.ron` beside its records holds it; fields that no score needs are passed over.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(super) struct Truth {
    /// Mechanisms that were built into the unit; none for a good one.
    pub(super) mechanisms: Vec<ConcealedEffect>,
    pub(super) effects: Vec<Effect>,
    /// Deviations from the drawing: shares, lengths in mm or m.
    pub(super) deviations: BTreeMap<String, f64>,
    pub(super) holdout_noise_rms_deg_per_h: f64,
}

/// Size of an effect beside the noise of the fitted records.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(super) struct Effect {
    pub(super) id: String,
    /// Matched-filter signal-to-noise ratio, offsets free.
    pub(super) snr: f64,
    /// The same with tolerances and instruments free.
    pub(super) snr_given_tolerances: f64,
    pub(super) detectable: bool,
    /// Mechanisms that can do the same within tolerances.
    pub(super) inseparable: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Nothing but tolerances.
    Good,
    /// An effect that tolerances can make up for.
    Mimicked,
    /// An effect of the library that they cannot.
    Detectable,
    /// Something detectable that is not in the library.
    Outside,
}

fn is_outside(id: &str) -> bool {
    id.starts_with("ool:")
}

impl Truth {
    pub(super) fn read(file: &Path) -> Result<Self, Failure> {
        Ok(fogcoil::input::read_ron(file)?.0)
    }

    pub(super) fn kind(&self) -> Kind {
        let outside = self.effects.iter().any(|effect| is_outside(&effect.id));
        match self.effects.iter().any(|effect| effect.detectable) {
            _ if self.effects.is_empty() => Kind::Good,
            false => Kind::Mimicked,
            true if outside => Kind::Outside,
            true => Kind::Detectable,
        }
    }

    /// Ids of the library that were built in.
    pub(super) fn library(&self) -> impl Iterator<Item = &str> {
        self.effects.iter().map(|effect| effect.id.as_str()).filter(|id| !is_outside(id))
    }

    /// Effects that tolerances cannot make up for.
    pub(super) fn detectable(&self) -> impl Iterator<Item = &Effect> {
        self.effects.iter().filter(|effect| effect.detectable)
    }

    /// Whether a name is true, or of something that could do the same.
    pub(super) fn admits(&self, id: &str) -> bool {
        self.library().any(|own| own == id) || self.detectable().any(|effect| effect.inseparable.iter().any(|other| other == id))
    }

    /// Values of a parameter that are right: the effect's alone, and with what the unit deviates by in the same way.
    pub(super) fn values(&self, name: &str, alone: f64, lag: f64) -> [f64; 2] {
        let of = |key: &str| self.deviations.get(key).copied().unwrap_or(0.0);
        let both = match name {
            "tail_m" => alone + of("tail_cw_m") - of("tail_ccw_m"),
            "conductivity_factor" => alone * (1.0 + of("medium_k")),
            "lag_s" => alone + lag * of("lag"),
            _ => alone,
        };
        [alone, both]
    }

    /// The value of a constant by its name in an answer, in whose drawing it is `drawn`; `None` of one that the truth does not tell by itself.
    pub(super) fn constant(&self, name: &str, drawn: f64) -> Option<f64> {
        let of = |key: &str| self.deviations.get(key).copied();
        let factor = |key: &str| Some(1.0 + of(key)?);
        match name {
            "E_r and G" => factor("e_r"),
            "E_z" => factor("e_z"),
            "alpha_r" => factor("alpha_r"),
            "alpha_z" => factor("alpha_z"),
            "k_r" => factor("k_r"),
            "dn/dT" => factor("dndt"),
            "spool conductivity" => factor("spool_k"),
            "spool expansion" => factor("spool_alpha"),
            "conductivity of the surroundings" => factor("medium_k"),
            "lag of the spool's thermometer" => factor("lag"),
            "hub thickness [mm]" => Some(drawn + of("hub_mm")?),
            "flange thickness [mm]" => Some(drawn + of("flange_mm")?),
            "margin [mm]" => Some(drawn + of("margin_mm")?),
            // the second is its name in older answers
            "CW tail less CCW tail, beyond the drawing's [m]" | "CW tail less CCW tail [m]" => {
                Some(of("tail_cw_m")? - of("tail_ccw_m")?)
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(effects: &[(&str, bool)]) -> Truth {
        let of = |&(id, detectable): &(&str, bool)| Effect { id: id.into(), detectable, ..Effect::default() };
        Truth { effects: effects.iter().map(of).collect(), ..Truth::default() }
    }

    #[test]
    fn kinds() {
        assert_eq!(with(&[]).kind(), Kind::Good);
        assert_eq!(with(&[("debond", false)]).kind(), Kind::Mimicked);
        assert_eq!(with(&[("debond", false), ("air-path", true)]).kind(), Kind::Detectable);
        assert_eq!(with(&[("ool:ripple", false)]).kind(), Kind::Mimicked);
        assert_eq!(with(&[("ool:ripple", true)]).kind(), Kind::Outside);
    }

    #[test]
    fn values_alone_and_with_the_deviation_of_the_same_kind() {
        let deviations = [("tail_cw_m", 0.02), ("tail_ccw_m", -0.01), ("medium_k", 0.1), ("hub_mm", -0.05), ("lag", 0.2)];
        let truth = Truth { deviations: deviations.map(|(k, v)| (k.to_owned(), v)).into(), ..Truth::default() };
        assert_eq!(truth.values("tail_m", 2.0, 4.0), [2.0, 2.03]);
        assert_eq!(truth.values("conductivity_factor", 0.5, 4.0), [0.5, 0.55]);
        assert_eq!(truth.values("lag_s", 10.0, 4.0), [10.0, 10.8]);
        assert_eq!(truth.values("power_w", 1.0, 4.0), [1.0, 1.0]);
        assert_eq!(truth.constant("hub thickness [mm]", 3.0), Some(2.95));
        assert_eq!(truth.constant("conductivity of the surroundings", 1.0), Some(1.1));
        assert_eq!(truth.constant("E_z", 1.0), None);
    }
}
