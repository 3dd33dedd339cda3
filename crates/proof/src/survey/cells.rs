//! Random regular cells.

use fem_core::material::Isotropic;
use homogenization::{
    Constants, Constituent, Discretization, Error, Extent, FibreCell, HIGHEST_ORDER, Homogenized, Packing, Resolution, Ring,
    Role, homogenize, homogenize_on, multipoles,
};

use super::tally::{Compared, Drawn};
use crate::Failure;
use crate::generator::Random;

/// One cell in so many is solved by finite elements, too.
const ELEMENTS_EVERY: usize = 6;
/// Largest error that finite elements state of themselves where they judge.
const CONVERGED: f64 = 1e-6;

fn solid(random: &mut Random, moduli: [f64; 2]) -> Constituent {
    let [low, high] = moduli;
    Constituent::new(
        Isotropic {
            youngs_modulus: random.log_uniform(low, high),
            poisson_ratio: 0.5 - random.log_uniform(1e-5, 0.3),
            thermal_expansion: random.log_uniform(1e-6, 4e-4),
        },
        random.log_uniform(0.05, 5.0),
    )
}

/// Glass with up to four coatings of any thickness in an adhesive, the film between neighbours from a five-hundredth of the pitch.
fn cell(random: &mut Random) -> FibreCell {
    let pitch = random.log_uniform(60e-6, 500e-6);
    let outer = pitch * (1.0 - random.log_uniform(0.002, 0.3)) / 2.0;
    let glass = outer * random.uniform(0.2, 0.85);
    let coatings = random.below(5);
    let mut cuts: Vec<f64> = (1..coatings).map(|_| random.uniform(0.02, 0.98)).collect();
    cuts.sort_by(f64::total_cmp);
    let silica = Constituent::new(
        Isotropic {
            youngs_modulus: random.uniform(60e9, 80e9),
            poisson_ratio: random.uniform(0.14, 0.2),
            thermal_expansion: 0.55e-6,
        },
        1.38,
    );
    let radius = if coatings == 0 { outer } else { glass };
    let mut rings = vec![Ring { outer_radius: radius, constituent: silica, role: Role::Glass }];
    for n in 0..coatings {
        let outer_radius = cuts.get(n).map_or(outer, |cut| glass + cut * (outer - glass));
        let metal = random.chance(0.1);
        let constituent = solid(random, if metal { [50e9, 300e9] } else { [0.3e6, 5e9] });
        rings.push(Ring { outer_radius, constituent, role: Role::Coating });
    }
    let adhesive = solid(random, [0.3e6, 5e9]);
    let packing = if random.chance(0.7) { Packing::Hexagonal } else { Packing::Square };
    FibreCell { packing, ..FibreCell::hexagonal(pitch, rings, adhesive) }
}

/// The constant whose stated error is the least beside its true one.
fn worst(quantity: &'static str, stated: &Constants, ours: &Constants, other: &Constants) -> Compared {
    let error = ours.combine(other, |a, b| (a - b).abs());
    let rows = stated.named().into_iter().zip(error.named());
    let rows = rows.map(|((_, stated), (_, error))| Compared { quantity, stated, error });
    rows.min_by(|a, b| a.ratio().total_cmp(&b.ratio())).unwrap_or(Compared { quantity, stated: f64::NAN, error: f64::NAN })
}

pub(super) fn compare(random: &mut Random) -> Result<Drawn, Failure> {
    let (cell, elements) = (cell(random), random.below(ELEMENTS_EVERY) == 0);
    let ours = match homogenize(&cell) {
        Err(Error::Accuracy { .. }) => return Ok(Drawn::Refused),
        ours => ours?,
    };
    let what = format!("{cell:?}");
    let finer = multipoles(&cell, HIGHEST_ORDER)?.constants().ok_or_else(|| Failure("the stiffness is singular".into()))?;
    let mut rows = vec![worst("constants, by far more multipoles", &ours.error(), &ours.constants, &finer)];
    if elements {
        let mesh = Discretization {
            order: 10,
            resolution: Resolution { sectors: 3, grading: 1.6, across: vec![1; cell.rings.len() + 1] },
            extent: Extent::Quarter,
        };
        // both have errors: what they state together covers their distance
        let converged = |found: &Homogenized| found.relative_error.named().iter().all(|(_, error)| *error < CONVERGED);
        if let Some(other) = homogenize_on(&cell, &mesh).ok().filter(converged) {
            let stated = ours.error().combine(&other.error(), |a, b| a + b);
            rows.push(worst("constants, by finite elements and their own error", &stated, &ours.constants, &other.constants));
        }
    }
    Ok(Drawn::Compared { what, rows })
}
