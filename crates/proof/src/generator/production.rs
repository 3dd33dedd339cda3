//! Thirty records of a production: three lots, each with constants of its own, and six units with a fault.

use super::ordinary::{NOTHING, Ordinary};
use super::random::Random;
use super::unit::{Generator, Which};
use crate::Failure;
use crate::truth::Truth;
use coil::Design;

/// Lots.
const LOTS: usize = 3;
/// Units of a lot.
const UNITS: usize = 10;
/// Their last ones have a fault.
const FAULTY: usize = 2;
/// Concealed units of the generator whose faults are well seen, of six mechanisms of the library.
const FAULTS: [usize; LOTS * FAULTY] = [0, 1, 2, 3, 7, 8];
/// Standard deviations of what the units of a lot have in common, and of what each has beyond it, relative: of k_r, of the coil's specific heat, of E_r and G.
const SPREAD: [[f64; 2]; 3] = [[0.08, 0.02], [0.04, 0.01], [0.08, 0.02]];

/// A unit of a production.
#[derive(Debug, Clone, PartialEq)]
pub struct Produced {
    /// Lot and number in it.
    pub name: String,
    /// Its record, as CSV.
    pub record: String,
    /// Facts about the record, as RON: serial number and date among them.
    pub meta: String,
    /// The mechanism that is concealed, by its id; `None` for a good unit.
    pub fault: Option<String>,
}

/// The units of a design, always the same for one seed. [`Failure`] if a system cannot be solved.
pub fn production(design: &Design, seed: u64) -> Result<Vec<Produced>, Failure> {
    let mut all = Vec::new();
    for lot in 0..LOTS {
        let random = &mut Random::new(seed, 1_000_000 + lot as u64);
        let common = SPREAD.map(|[common, _]| 1.0 + common * random.normal());
        let mut of_lot = design.clone();
        of_lot.body.conductivity_r *= common[0];
        of_lot.body.specific_heat *= common[1];
        of_lot.body.elastic.e_r *= common[2];
        of_lot.body.elastic.g_zr *= common[2];
        let generator = Generator::new(of_lot)?;
        for unit in 0..UNITS {
            let number = lot * UNITS + unit;
            let faulty = unit.checked_sub(UNITS - FAULTY).map(|k| FAULTS[lot * FAULTY + k]);
            let (record, meta, fault) = match faulty {
                Some(fault) => {
                    let made = generator.unit(seed, Which::Concealed(fault))?;
                    let truth: Truth = ron::from_str(&made.truth)?;
                    let id = truth.mechanisms.first().map(|mechanism| mechanism.id.clone());
                    (made.fit, made.meta, id)
                }
                None => {
                    let constants = SPREAD.map(|[_, own]| 1.0 + own * random.normal());
                    let ordinary = Ordinary {
                        constants,
                        earth: random.uniform(-10.0, 10.0),
                        spool_offset: 0.3 * random.normal(),
                        gains: [0.001 * random.normal(), 0.001 * random.normal()],
                        chamber_late: [random.uniform(0.0, 30.0), random.uniform(0.0, 20.0)],
                        ..NOTHING
                    };
                    let [record, _, meta] = generator.ordinary(seed + number as u64, &ordinary)?;
                    (record, meta, None)
                }
            };
            let known =
                format!("(\n    serial: Some({}),\n    date: \"2026-0{}-{:02}\",\n", 4001 + number, lot + 3, 2 * unit + 1);
            let name = format!("L{}-{:02}", lot + 1, unit + 1);
            all.push(Produced { name, record, meta: meta.replacen("(\n", &known, 1), fault });
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_of_six_mechanisms_and_dates_are_dates() {
        // the n-th concealed unit holds one family of the library, in turn
        let ids: std::collections::BTreeSet<usize> = FAULTS.iter().copied().collect();
        assert_eq!(ids.len(), LOTS * FAULTY);
        assert!(FAULTS.iter().all(|n| ![4, 9, 11, 16, 19].contains(n) && *n < 20));
        const { assert!(2 * (UNITS - 1) < 28 && LOTS + 2 < 10) };
    }
}
