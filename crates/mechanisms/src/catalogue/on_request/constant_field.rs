//! A constant magnetic field, whose bias changes with the coil's temperature.

use super::magneto_optic::responsivity;
use crate::REFERENCE_C;
use crate::catalogue::rate_temperature_coefficient::usual;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use crate::series::middles;
use diagnosis::Prior;

pub(super) const CONSTANT_FIELD: Named = Named {
    id: "constant-field",
    title: "A constant magnetic field",
    stage: Stage::Optics,
    equation: "The bias b of a coil in a constant field, such as the Earth's, grows with its temperature T:\n\
        \n\
        ```\n\
        bias = b r(T),   r(T) = (1 + v (T − 20 °C)) (T_s − 20 °C)/(T_s − T)\n\
        ```\n\
        \n\
        with v and T_s as in `magneto-optic`. The constant part of it is in the record's offset, which is free.",
    place: "The optics, beside the bias of the coil: the effect adds to the rate.",
    signature: "The rate follows the coil's temperature almost linearly, by 0.12 % of b per kelvin. A read-out that drifts and a scale factor in the Earth's\n\
        rate do the same, and no record of a unit that stands still tells them apart. A turn of the unit about its axis in the field, or a magnetic\n\
        shield, does.",
    source: "K. Hotate and K. Tabe, *Applied Optics* 25, 1086 (1986); H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014), ch. 7.",
    meaning: "a constant magnetic field biases the rate by field_bias_deg_per_h at 20 degC, and more where the coil is warmer",
    inspection: "repeat the test in a magnetic shield, or with the unit turned in the field",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it follows the temperature, not its rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, scene| {
        // no record tells it from a read-out that drifts: what is known of the size of either does not, either
        let per_kelvin = (responsivity(REFERENCE_C + 1.0) - 1.0).abs();
        let prior = Prior::Size { scale: usual(scene) / per_kelvin };
        Some(Offer::one("field_bias_deg_per_h", prior, &[0.0]))
    },
    effect: |_, record, active| {
        let rate = middles(record.coil(), |t| active.values[0] * (responsivity(t) - 1.0));
        Ok(Effect::Coil(Change::of_rate(record, rate)))
    },
    extended: |_, _| None,
};
