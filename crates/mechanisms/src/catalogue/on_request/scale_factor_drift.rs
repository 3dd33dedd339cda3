//! A scale factor that changes with temperature, in the Earth's rate.

use crate::catalogue::rate_temperature_coefficient::usual;
use crate::mechanism::{Effect, Extent, Named, Offer, Stage, Steady};
use crate::record_to_bias::Prepared;
use crate::{REFERENCE_C, mechanism::Readings};
use diagnosis::Prior;

pub(super) const SCALE_FACTOR_DRIFT: Named = Named {
    id: "scale-factor-drift",
    title: "A scale factor that changes with temperature",
    stage: Stage::Electronics,
    equation: "The gyroscope reads the factor 1 + k (T − 20 °C) of its rate, which is Earth's rate and its own bias:\n\
        \n\
        ```\n\
        rate = (1 + k (T − 20 °C)) (Ω_E + bias)\n\
        ```\n\
        \n\
        T is the reading of the spool's thermometer, Ω_E Earth's rate from the record's meta file; without it the mechanism has no place. The scale\n\
        factor is in proportion to 1/λ and to the coil's area. The wavelength of a semiconductor source changes by hundreds of ppm per kelvin, that of\n\
        an erbium source by a few.",
    place: "The read-out, after the coil.",
    signature: "The rate follows the temperature in the soaks, in proportion to Earth's rate. A read-out that drifts, a constant field and a modulator's reset\n\
        do the same while the unit stands still. When the unit is turned over, the effect changes its sign, and a drifting read-out does not. A rate\n\
        table shows the effect at once.",
    source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014); IEEE Std 952, *Specification Format Guide and Test Procedure for Single-Axis Interferometric Fiber Optic Gyros*.",
    meaning: "the scale factor changes by scale_ppm_per_k with the spool's temperature, and Earth's rate with it",
    inspection: "repeat the test with the unit turned over, or on a rate table",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it follows the temperature, not its rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, scene| {
        // as of a read-out that drifts: no record of a unit that stands still tells them apart
        let of = |earth: f64| Prior::Size { scale: 1e6 * usual(scene) / earth.abs() };
        scene.earth.filter(|earth| *earth != 0.0).map(|earth| Offer::one("scale_ppm_per_k", of(earth), &[0.0]))
    },
    effect: |_, record, active| Ok(scaled(record, active.values[0])),
    extended: |_, _| None,
};

/// Readings of a gyroscope whose scale factor changes by so many ppm a kelvin.
pub(super) fn scaled(record: &Prepared, ppm_per_k: f64) -> Effect {
    let earth = record.earth.unwrap_or(0.0);
    Effect::Readings(Box::new(move |r| act(r, earth, ppm_per_k)))
}

fn act(r: &mut Readings, earth: f64, ppm_per_k: f64) {
    for (n, rate) in r.rate.iter_mut().enumerate() {
        let kelvin = (r.thermometer[n] + r.thermometer[n.saturating_sub(1)]) / 2.0 - REFERENCE_C;
        *rate += 1e-6 * ppm_per_k * kelvin * (earth + *rate);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_what_the_unit_turns_with_is_read_by_the_scale_factor() {
        let (time, thermometer) = ([0.0, 60.0, 120.0], vec![20.0, 30.0, 50.0]);
        let with = |earth: f64, rate: [f64; 3], ppm: f64| {
            let mut r = Readings { time: &time, thermometer: thermometer.clone(), rate: rate.to_vec() };
            act(&mut r, earth, ppm);
            r.rate
        };
        // means of 0, 5 and 20 K: 10 deg/h and the bias by 1000 ppm a kelvin
        let found = with(10.0, [0.5, 0.5, -0.5], 1000.0);
        let by_hand = [0.5, 0.5 + 5e-3 * 10.5, -0.5 + 20e-3 * 9.5];
        assert!(found.iter().zip(by_hand).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        // nothing of size 0; turned over all is turned over
        assert_eq!(with(10.0, [0.5, 0.5, -0.5], 0.0), [0.5, 0.5, -0.5]);
        let turned = with(-10.0, [-0.5, -0.5, 0.5], 1000.0);
        assert!(turned.iter().zip(&found).all(|(a, b)| *a == -b));
    }
}
