//! A read-out that drifts with temperature: scale factor times Earth's rate, electronics.

use crate::REFERENCE_C;
use crate::design::drifts_about_reference;
use crate::mechanism::{Effect, Extent, Named, Offer, Scene, Stage, Steady};
use crate::series::middles;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use diagnosis::Prior;

pub(super) const RATE_TEMPERATURE_COEFFICIENT: Named = Named {
    id: "rate-temperature-coefficient",
    title: "A read-out that drifts with temperature",
    stage: Stage::Electronics,
    equation: "Bias c (T_spool − 20 °C): the electronics, or a scale factor that changes with temperature and acts on the Earth's rate.",
    place: "The electronics: `drifts.read_out`.",
    signature: "The rate follows the temperature, not its rate of change. Dwells at different temperatures show it, and no winding or material imitates it.",
    source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014); IEEE Std 952, *Specification Format Guide and Test Procedure for Single-Axis Interferometric Fiber Optic Gyros*.",
    meaning: "the read-out adds a rate proportional to the temperature, from 20 degC",
    inspection: "exchange the electronics, or warm them alone",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it follows the temperature, not its rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, scene| Some(Offer::one("coefficient_deg_per_h_per_k", Prior::Size { scale: usual(scene) }, &[0.0])),
    effect: |_, _, active| {
        let coefficient = active.values[0];
        Ok(Effect::Readings(Box::new(move |readings| {
            let drift = middles(&readings.thermometer, |t| coefficient * (t - REFERENCE_C));
            readings.rate.iter_mut().zip(drift).for_each(|(rate, drift)| *rate += drift);
        })))
    },
    extended: |design, active| {
        let mut changed = drifts_about_reference(design)?;
        changed.drifts.read_out += active.values[0] / DEG_PER_H_PER_RAD_PER_S;
        Some(changed)
    },
};

/// Usual temperature coefficient of the rate, of all causes together (1σ) \[deg/h/K\].
pub(super) fn usual(scene: &Scene) -> f64 {
    usual_coefficient(scene.noise)
}

/// The same of a gyroscope with this white noise in a reading of a minute \[deg/h\].
pub fn usual_coefficient(noise: f64) -> f64 {
    2.0 * noise
}
