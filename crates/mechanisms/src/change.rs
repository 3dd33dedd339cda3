//! Designs with something changed: how each mechanism enters the coil's model.

use coil::{Contact, Design, FactorsAt, Heater, Mechanics, Mount, Opening, Side};

/// Share of polymer in the coil's cross-section that the reference design has; fibre of 80 µm in a cell of 170 µm pitch.
pub const POLYMER_FRACTION: f64 = 0.80;
/// Bounds of a change of it that leave glass and polymer their places.
const LEAST_POLYMER: f64 = 0.5;
const MOST_POLYMER: f64 = 0.95;

/// Fused silica: E \[Pa\], α \[1/K\], k \[W/(m K)\], ρc \[J/(m³ K)\].
const GLASS: [f64; 4] = [70.2e9, 0.55e-6, 1.38, 2200.0 * 740.0];

/// The first flange whose bond to the coil holds.
pub(crate) fn bonded_flange(design: &Design) -> Option<Side> {
    let flanges = &design.spool.as_ref()?.flanges;
    flanges.iter().find(|f| f.contact == Contact::Bonded).map(|f| f.side)
}

/// The first flange.
pub(crate) fn flange(design: &Design) -> Option<Side> {
    design.spool.as_ref()?.flanges.first().map(|f| f.side)
}

/// More polymer by `change` of the cross-section: rules of mixtures along the fibre (Voigt) and across it (Reuss), with the polymer's
/// constants such that the nominal body has [`POLYMER_FRACTION`].
pub fn with_polymer(design: &Design, change: f64) -> Design {
    let mut changed = design.clone();
    let body = &mut changed.body;
    let [e_g, alpha_g, k_g, c_g] = GLASS;
    let v = POLYMER_FRACTION;
    let new = (v + change).clamp(LEAST_POLYMER, MOST_POLYMER);
    let e = &mut body.elastic;
    let e_p = (e.e_z - (1.0 - v) * e_g) / v;
    let alpha_p = (e.alpha_z * e.e_z - (1.0 - v) * e_g * alpha_g) / (v * e_p);
    let k_p = v / (1.0 / body.conductivity_r - (1.0 - v) / k_g);
    let stored = body.density * body.specific_heat;
    let c_p = (stored - (1.0 - v) * c_g) / v;
    e.e_z = (1.0 - new) * e_g + new * e_p;
    e.alpha_z = ((1.0 - new) * e_g * alpha_g + new * e_p * alpha_p) / e.e_z;
    e.e_r *= v / new;
    e.g_zr *= v / new;
    e.alpha_r *= new / v;
    body.conductivity_r = 1.0 / ((1.0 - new) / k_g + new / k_p);
    body.specific_heat = ((1.0 - new) * c_g + new * c_p) / body.density;
    changed
}

/// More thermal resistance between hub and coil \[m² K/W\].
pub fn with_hub_resistance(design: &Design, resistance: f64) -> Design {
    let mut changed = design.clone();
    changed.heat.hub_resistance += resistance;
    changed
}

/// Surroundings that conduct better by a factor.
pub fn with_air(design: &Design, factor: f64) -> Design {
    let mut changed = design.clone();
    changed.surroundings.conductivity *= factor;
    changed
}

/// The outer face of the first flange coupled to the chamber [W/(m² K)].
pub fn with_mount(design: &Design, conductance: f64) -> Design {
    let mut changed = design.clone();
    if let Some(side) = flange(design).filter(|_| conductance > 0.0) {
        changed.heat.mounts.push(Mount { side, conductance });
    }
    changed
}

/// Power in the first flange \[W\].
pub fn with_heater(design: &Design, power: f64) -> Design {
    let mut changed = design.clone();
    if let Some(side) = flange(design) {
        changed.heat.heaters.push(Heater { side, power });
    }
    changed
}

/// The CW tail longer than the CCW tail by so much more \[m\].
pub fn with_tail(design: &Design, cw_minus_ccw: f64) -> Design {
    let mut changed = design.clone();
    changed.winding.tails.cw += cw_minus_ccw.max(0.0);
    changed.winding.tails.ccw += (-cw_minus_ccw).max(0.0);
    changed
}

/// Half the span in which a logistic step is tabulated, in widths: 5e-5 of the step lies beyond.
const SPAN: f64 = 10.0;
/// Rows of that table.
const ROWS: i32 = 80;

/// Factors on transverse stiffness and expansion that set in around a temperature, as a logistic step of the given width.
pub fn with_glass_transition(design: &Design, tg: f64, width: f64, modulus: f64, expansion: f64) -> Design {
    let row = |k: i32| {
        let x = SPAN * f64::from(2 * k - ROWS) / f64::from(ROWS);
        let share = logistic(x);
        FactorsAt {
            temperature: tg + width * x,
            transverse_modulus: 1.0 + (modulus - 1.0) * share,
            transverse_expansion: 1.0 + (expansion - 1.0) * share,
        }
    };
    Design { mechanics: Mechanics::TemperatureTable((0..=ROWS).map(row).collect()), ..design.clone() }
}

/// Transverse moduli that relax.
pub fn with_relaxation(design: &Design, fraction: f64, time: f64) -> Design {
    Design { mechanics: Mechanics::Relaxing { fraction, time }, ..design.clone() }
}

/// A bond of coil and flange whose outer part opens in the cold.
pub fn with_opening(design: &Design, below: f64, hysteresis: f64, fraction: f64) -> Design {
    match bonded_flange(design) {
        Some(side) => Design { mechanics: Mechanics::Opening(Opening { side, below, hysteresis, fraction }), ..design.clone() },
        None => design.clone(),
    }
}

/// 1/(1 + e^−x).
pub(crate) fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}
