//! Truth of a unit: opened by the scorer only, after every answer is written.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::Failure;

/// The truth of one unit, as `fixtures/concealed/truth/case_NN.ron` holds it; fields that no score needs are passed over.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Truth {
    /// Mechanisms that were built into the unit; the id `none` for nothing.
    pub(crate) mechanisms: Vec<ConcealedEffect>,
    /// Strength of each in the record that is fitted.
    pub(crate) snr: Vec<Strength>,
    /// For each mechanism: itself, then those that this record cannot separate from it.
    pub(crate) confusable_sets: Vec<Vec<String>>,
    pub(crate) noise: Noise,
    pub(crate) spool_sensor: SpoolSensor,
    pub(crate) noise_free_rms_deg_per_h: Sizes,
    /// Of the record that is fitted, of the one that judges: for a reader.
    #[serde(skip_deserializing)]
    pub(crate) profiles: [String; 2],
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ConcealedEffect {
    pub(crate) id: String,
    pub(crate) parameters: BTreeMap<String, f64>,
}

/// Matched-filter signal-to-noise ratio of a mechanism in the record that is fitted.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Strength {
    pub(crate) id: String,
    /// The forward model granted an error of 0.3 %.
    pub(crate) snr: f64,
    /// Noise alone.
    pub(crate) snr_noise_only_rate: f64,
    pub(crate) snr_noise_only_spool: f64,
}

/// Angle random walk, exponentially correlated drift, rate random walk.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Noise {
    pub(crate) arw_deg_per_sqrt_h: f64,
    pub(crate) gm_sigma_deg_per_h: f64,
    pub(crate) gm_tau_s: f64,
    pub(crate) rrw_deg_per_h_per_sqrt_h: f64,
    pub(crate) offset_deg_per_h: f64,
    /// A family that the identification has no term for.
    pub(crate) unseen: Option<String>,
}

/// The spool's thermometer \[K\].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SpoolSensor {
    pub(crate) noise_c: f64,
    pub(crate) quantisation_c: f64,
    pub(crate) offset_c: f64,
}

/// Root mean squares of the rate without noise: the nominal design's, the unit's, their difference's.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sizes {
    pub(crate) fit_nominal: f64,
    pub(crate) fit_true: f64,
    pub(crate) fit_difference: f64,
    pub(crate) holdout_difference: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Null,
    Single,
    Double,
    /// Something outside the library.
    Outside,
}

/// Strength of a unit's effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tier {
    /// Below 3: nothing is asked.
    Faint,
    /// 3 to 10.
    Weak,
    /// 10 to 50.
    Medium,
    /// 50 and more.
    Strong,
}

impl Tier {
    /// The tiers that something is asked of.
    pub(crate) const ASKED: [Self; 3] = [Self::Weak, Self::Medium, Self::Strong];

    fn of(snr: f64) -> Self {
        match snr {
            s if s < 3.0 => Self::Faint,
            s if s < 10.0 => Self::Weak,
            s if s < 50.0 => Self::Medium,
            _ => Self::Strong,
        }
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Faint => "faint",
            Self::Weak => "weak",
            Self::Medium => "medium",
            Self::Strong => "strong",
        }
    }
}

/// Signal-to-noise ratio below which what a gain leaves of an effect is not seen.
const UNSEEN: f64 = 3.0;

impl Truth {
    pub(crate) fn read(file: &Path) -> Result<Self, Failure> {
        Ok(fogcoil::input::read_ron(file)?.0)
    }

    pub(crate) fn write(&self) -> Result<String, Failure> {
        Ok(ron::ser::to_string_pretty(self, ron::ser::PrettyConfig::default())? + "\n")
    }

    /// Mechanisms that were built in, `none` left out.
    pub(crate) fn concealed(&self) -> impl Iterator<Item = &ConcealedEffect> {
        self.mechanisms.iter().filter(|m| m.id != "none")
    }

    pub(crate) fn kind(&self) -> Kind {
        match self.concealed().count() {
            0 => Kind::Null,
            _ if self.concealed().any(|m| m.id.starts_with("unknown:")) => Kind::Outside,
            1 => Kind::Single,
            _ => Kind::Double,
        }
    }

    pub(crate) fn tier(&self) -> Tier {
        Tier::of(self.snr.iter().map(|s| s.snr).fold(0.0, f64::max))
    }

    /// Whether `id` is what was built in at `place`, or inseparable from it by the record that is fitted.
    pub(crate) fn is_like(&self, place: usize, id: &str) -> bool {
        let itself = self.concealed().nth(place).is_some_and(|m| m.id == id);
        itself || self.confusable_sets.get(place).is_some_and(|set| set.iter().any(|other| other == id))
    }

    /// Whether `id` is true or inseparable from something that is.
    pub(crate) fn admits(&self, id: &str) -> bool {
        (0..self.concealed().count()).any(|place| self.is_like(place, id))
    }

    /// Whether the effect is a pure gain in the record that is fitted: what the best gain leaves of it is not seen in the rate, nor is it in
    /// the thermometer.
    pub(crate) fn is_gain(&self) -> bool {
        let [strength] = self.snr.as_slice() else { return false };
        let Sizes { fit_nominal: nominal, fit_true: with, fit_difference: difference, .. } = self.noise_free_rms_deg_per_h;
        if nominal * difference == 0.0 {
            return false;
        }
        // correlation of the difference with the nominal response, from the three sides of their triangle
        let correlation = (with.powi(2) - nominal.powi(2) - difference.powi(2)) / (2.0 * nominal * difference);
        let left = strength.snr_noise_only_rate * (1.0 - correlation.powi(2)).max(0.0).sqrt();
        left < UNSEEN && strength.snr_noise_only_spool < UNSEEN
    }
}

/// The stage at which a mechanism of the library acts.
pub(crate) fn stage(id: &str) -> Option<&'static str> {
    Some(match id {
        "tail-asymmetry" | "winding-defect" => "winding",
        "adhesive-content" | "glass-transition" | "viscoelastic-relaxation" => "material",
        "debond" => "bond",
        "interface-resistance" | "air-path" | "axial-heat-path" | "mount-conductance" | "self-heating" => "thermal",
        "thermo-optic-curvature" => "optics",
        "rate-temperature-coefficient" => "electronics",
        "sensor-lag" | "chamber-lag" => "sensor",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gain(strength: f64, spool: f64, with: f64) -> Truth {
        let snr = Strength { id: "x".into(), snr: 20.0, snr_noise_only_rate: strength, snr_noise_only_spool: spool };
        let sizes = Sizes { fit_nominal: 1.0, fit_true: with, fit_difference: 0.1, holdout_difference: 0.1 };
        Truth { snr: vec![snr], noise_free_rms_deg_per_h: sizes, ..Truth::default() }
    }

    #[test]
    fn a_gain_is_told_from_another_shape() {
        assert!(gain(100.0, 0.0, 1.1).is_gain());
        assert!(gain(100.0, 0.0, 0.9).is_gain());
        // at right angles to the nominal response
        assert!(!gain(100.0, 0.0, 1.01_f64.sqrt()).is_gain());
        assert!(gain(2.0, 0.0, 1.01_f64.sqrt()).is_gain());
        assert!(!gain(100.0, 50.0, 1.1).is_gain());
    }

    #[test]
    fn tiers_end_where_the_next_begins() {
        assert_eq!([2.9, 3.0, 10.0, 50.0].map(Tier::of), [Tier::Faint, Tier::Weak, Tier::Medium, Tier::Strong]);
    }

    #[test]
    fn kinds() {
        let of = |ids: &[&str]| {
            let mechanisms = ids.iter().map(|id| ConcealedEffect { id: (*id).into(), ..ConcealedEffect::default() }).collect();
            Truth { mechanisms, ..Truth::default() }.kind()
        };
        assert_eq!(of(&["none"]), Kind::Null);
        assert_eq!(of(&["debond"]), Kind::Single);
        assert_eq!(of(&["debond", "air-path"]), Kind::Double);
        assert_eq!(of(&["unknown:polarisation-ripple"]), Kind::Outside);
    }
}
