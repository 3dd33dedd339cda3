//! A bias by a magnetic field that was recorded, through the Faraday effect of a twisted coil.

use crate::REFERENCE_C;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use crate::series::middles;
use diagnosis::Prior;

pub(super) const MAGNETO_OPTIC: Named = Named {
    id: "magneto-optic",
    title: "A recorded magnetic field",
    stage: Stage::Optics,
    equation: "The Faraday effect turns the light of a coil whose fibre is twisted, and a bias remains:\n\
        \n\
        ```\n\
        bias = s B(t) r(T),   r(T) = (1 + v (T − 20 °C)) (T_s − 20 °C)/(T_s − T)\n\
        ```\n\
        \n\
        B is the record's column `field_ut` in µT, along the axis in which the coil is sensitive to it, T the coil's mean temperature. Silica's Verdet constant grows by\n\
        v = 6.9·10⁻⁵ a kelvin. The birefringence, which holds the light's polarisation, comes from thermal stress and is gone at T_s, taken as 900 °C: the\n\
        warmer the coil, the less of it.",
    place: "The optics, beside the bias of the coil: the effect adds to the rate.",
    signature: "The rate follows the field at once, at any temperature. A field that is turned while the chamber rests shows the effect alone. The field of the\n\
        chamber's heaters follows the chamber's rate, and so do many other effects: then only the field's own course tells them apart.",
    source: "K. Hotate and K. Tabe, *Applied Optics* 25, 1086 (1986); P. A. Williams, A. H. Rose, G. W. Day, T. E. Milner and M. N. Deeter, *Applied Optics* 30, 1176 (1991), for v; that \
             the birefringence of stress falls with temperature is textbook physics of PANDA fibres.",
    meaning: "the rate answers the recorded magnetic field by sensitivity_deg_per_h_per_ut, at 20 degC",
    inspection: "turn a magnet, or the unit in the Earth's field, at a steady temperature",
    columns: &[FIELD],
    heat_path: None,
    steady: &[Steady::Nothing("it follows the field, not the temperature's rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, scene| {
        // a coil in the Earth's field, some 50 µT, may be off by several times its noise
        let prior = Prior::Size { scale: 0.1 * scene.noise };
        Some(Offer::one("sensitivity_deg_per_h_per_ut", prior, &[0.0]))
    },
    effect: |_, record, active| {
        let Some(field) = record.column(FIELD) else { return Ok(Effect::Coil(Change::none(record))) };
        let (field, response) = (middles(field, |b| b), middles(record.coil(), responsivity));
        let rate = field.iter().zip(&response).map(|(b, r)| active.values[0] * b * r).collect();
        Ok(Effect::Coil(Change::of_rate(record, rate)))
    },
    extended: |_, _| None,
};

/// The record's column, along the axis in which the coil is sensitive \[µT\].
const FIELD: &str = "field_ut";
/// Relative change of silica's Verdet constant \[1/K\].
const VERDET_PER_K: f64 = 0.69e-4;
/// Temperature at which the stress that makes a fibre birefringent is gone \[°C\].
const SOFTENS_C: f64 = 900.0;

/// Bias by a field at a temperature \[°C\], as a share of that at 20 °C.
pub(super) fn responsivity(temperature: f64) -> f64 {
    let verdet = 1.0 + VERDET_PER_K * (temperature - REFERENCE_C);
    verdet * (SOFTENS_C - REFERENCE_C) / (SOFTENS_C - temperature).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: at 60 °C the Verdet constant is 0.276 % more, the birefringence 4.545 % less.
    #[test]
    fn exact_a_warm_coil_answers_more() {
        assert_eq!(responsivity(REFERENCE_C), 1.0);
        assert!((responsivity(60.0) - 1.00276 * 880.0 / 840.0).abs() < 1e-12);
        assert!(responsivity(-40.0) < 1.0);
    }
}
