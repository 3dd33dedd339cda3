//! Random coils: from 8 to 600 mm across, a layer to eighty, any pattern, material and bond.

use coil::{
    Body, Contact, Dehomogenization, Design, Drifts, Flange, HeatPaths, Mechanics, Sensor, Side, Solid, Spool, Surroundings,
};
use fem_core::material::{Isotropic, TransverselyIsotropic};
use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength};

use crate::generator::Random;

/// Young's modulus \[Pa\], Poisson's ratio, expansion \[1/K\], conductivity \[W/(m K)\], density \[kg/m³\], specific heat \[J/(kg K)\] of handbooks:
/// aluminium 6061, Ti-6Al-4V, steel 304, Invar, quasi-isotropic carbon fibre.
const SPOOLS: [[f64; 6]; 5] = [
    [68.9e9, 0.33, 23.6e-6, 167.0, 2700.0, 896.0],
    [113.8e9, 0.342, 8.6e-6, 6.7, 4430.0, 526.0],
    [193e9, 0.29, 17.3e-6, 16.2, 8000.0, 500.0],
    [141e9, 0.29, 1.3e-6, 10.5, 8050.0, 515.0],
    [60e9, 0.30, 2.0e-6, 5.0, 1550.0, 900.0],
];

fn elastic(random: &mut Random) -> TransverselyIsotropic {
    let e_z = random.log_uniform(2e9, 50e9);
    let nu_zr = random.uniform(0.2, 0.45);
    let nu_r = random.uniform(0.3, 0.985);
    // positive definite: E_r < (1 − ν_r) E_z/(2 ν_zr²)
    let most = 0.5 * (1.0 - nu_r) * e_z / (2.0 * nu_zr * nu_zr);
    let e_r = random.log_uniform(20e6, 5e9).min(most);
    TransverselyIsotropic {
        e_z,
        e_r,
        g_zr: e_r * random.uniform(0.2, 0.6),
        nu_zr,
        nu_r,
        alpha_z: random.log_uniform(0.6e-6, 2e-5),
        alpha_r: random.log_uniform(2e-5, 3e-4),
    }
}

fn spool(random: &mut Random, inner_radius: f64) -> Spool {
    let [youngs_modulus, poisson_ratio, thermal_expansion, conductivity, density, specific_heat] =
        SPOOLS[random.below(SPOOLS.len())];
    let contact = |random: &mut Random| if random.chance(0.8) { Contact::Bonded } else { Contact::Gap };
    let sides: &[Side] = [&[][..], &[Side::Left], &[Side::Right], &[Side::Left, Side::Right]][random.below(4)];
    let flanges = sides.iter().map(|&side| Flange {
        side,
        thickness: random.log_uniform(0.5e-3, 8e-3),
        overhang: random.uniform(0.0, 4e-3),
        contact: contact(random),
    });
    let flanges = flanges.collect();
    Spool {
        material: Solid {
            elastic: Isotropic { youngs_modulus, poisson_ratio, thermal_expansion },
            conductivity,
            density,
            specific_heat,
        },
        hub_thickness: random.log_uniform(0.5e-3, 8e-3).min(0.8 * inner_radius),
        hub_contact: contact(random),
        flanges,
    }
}

fn winding(random: &mut Random) -> Spec {
    const PATTERNS: [Pattern; 5] =
        [Pattern::Cylindrical, Pattern::Dipole, Pattern::Quadrupole, Pattern::PracticalQuadrupole, Pattern::Octupole];
    let pattern = PATTERNS[random.below(PATTERNS.len())];
    let layers = random.log_uniform(1.0, 80.0).round() as usize;
    let turns_odd_layers = random.log_uniform(4.0, 300.0).round() as usize;
    Spec {
        pattern,
        layers,
        turns_odd_layers,
        turns_even_layers: turns_odd_layers - random.below(2),
        inner_radius: random.log_uniform(4e-3, 300e-3),
        pitch: random.log_uniform(0.1e-3, 0.4e-3),
        start: 0.0,
        end: None,
        cw_climbs: if random.chance(0.5) { ClimbSide::Left } else { ClimbSide::Right },
        turn_length: if random.chance(0.9) { TurnLength::True } else { TurnLength::Equal },
        tails: Tails { cw: random.uniform(0.0, 2.0), ccw: random.uniform(0.0, 2.0) },
        defect: None,
    }
}

/// A coil with constant properties, in a still medium.
pub(super) fn coil(random: &mut Random, reference: &Design) -> Design {
    let winding = winding(random);
    let (inner_radius, pitch) = (winding.inner_radius, winding.pitch);
    let thickness = pitch + (winding.layers - 1) as f64 * pitch * 3.0_f64.sqrt() / 2.0;
    let spool = random.chance(0.9).then(|| spool(random, inner_radius));
    // even layers sit in the grooves: with as many turns they reach half a pitch farther
    let beyond = if winding.layers > 1 && winding.turns_even_layers == winding.turns_odd_layers { 0.5 } else { 0.0 };
    let height = (winding.turns_odd_layers as f64 + beyond) * pitch;
    let bore = inner_radius - spool.as_ref().map_or(0.0, |spool| spool.hub_thickness + spool.hub_contact.gap());
    Design {
        body: Body {
            outer_radius: inner_radius + thickness,
            height,
            density: random.uniform(1100.0, 2000.0),
            specific_heat: random.uniform(800.0, 1800.0),
            elastic: elastic(random),
            conductivity_z: random.uniform(0.3, 1.2),
            conductivity_r: random.log_uniform(0.1, 1.0),
        },
        spool,
        surroundings: Surroundings { margin: random.log_uniform(2e-3, 40e-3), ..reference.surroundings },
        mechanics: Mechanics::Elastic,
        heat: HeatPaths::default(),
        sensor: Sensor { radius: bore, y: height / 2.0, lag: 0.0 },
        optics: bias::Optics { sagnac_diameter: 2.0 * inner_radius + thickness, ..reference.optics },
        drifts: Drifts::default(),
        dehomogenization: Dehomogenization {
            m_rx: random.uniform(0.01, 0.3),
            m_ry: random.uniform(0.01, 0.3),
            m_rz: random.uniform(-0.2, -0.1),
            m_rt: random.uniform(-3e-5, 0.0),
        },
        winding,
    }
}
