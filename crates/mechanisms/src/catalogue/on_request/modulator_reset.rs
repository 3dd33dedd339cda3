//! A phase ramp whose resets are not quite 2π, as the modulator's voltage for them changes with temperature.

use super::scale_factor_drift::scaled;
use crate::catalogue::rate_temperature_coefficient::usual;
use crate::mechanism::{Extent, Named, Offer, Stage, Steady};
use diagnosis::Prior;

pub(super) const MODULATOR_RESET: Named = Named {
    id: "modulator-reset",
    title: "A modulator whose reset is not 2π",
    stage: Stage::Electronics,
    equation: "A closed loop nulls the Sagnac phase by a phase ramp that is reset by 2π. If the voltage for 2π changes by ε(T) = k (T − 20 °C), and nothing corrects it, every\n\
        step of the ramp is larger by ε. Where the samples at the resets are left out, the loop therefore reads less:\n\
        \n\
        ```\n\
        rate = (1 − k (T − 20 °C)) (Ω_E + bias)\n\
        ```\n\
        \n\
        with Earth's rate Ω_E from the record's meta file; without it the mechanism has no place. T is the reading of the spool's thermometer: the\n\
        modulator is taken to be beside the coil.",
    place: "The closed loop of the read-out, after the coil.",
    signature: "The effect is one kind of a scale factor that changes with temperature. Records of a unit that stands still tell it apart neither from that\n\
        nor from a read-out that drifts. On a rate table its error changes with the rate, where resets become as frequent as the cycles of the loop. A\n\
        second loop that holds the reset at 2π removes it.",
    source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014), on closed-loop operation with a digital phase ramp.",
    meaning: "the modulator's voltage for 2 pi changes by reset_ppm_per_k, and Earth's rate is read by so much less",
    inspection: "log the loop's 2 pi voltage, or warm the modulator alone at a known rate",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it follows the temperature, not its rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, scene| {
        // as of a read-out that drifts: no record of a unit that stands still tells them apart
        let of = |earth: f64| Prior::Size { scale: 1e6 * usual(scene) / earth.abs() };
        scene.earth.filter(|earth| *earth != 0.0).map(|earth| Offer::one("reset_ppm_per_k", of(earth), &[0.0]))
    },
    effect: |_, record, active| Ok(scaled(record, -active.values[0])),
    extended: |_, _| None,
};
