//! |S| over the spools that the paper could have meant: materials, flanges, bonds.

use super::fixtures::{Fixtures, SpoolMaterial};
use crate::Failure;
use coil::{Contact, Design, Flange, Side, steady_sensitivity};
use fem_core::material::Isotropic;
use rayon::prelude::*;

/// Smallest |S| with its numerical error and largest, each with the spool that gives it, and one line per spool: (name, S). Value and error are of
/// one solution, [`steady_sensitivity`].
pub(crate) struct Spread {
    pub(crate) lowest: (String, f64, f64),
    pub(crate) highest: (String, f64),
    pub(crate) lines: Vec<(String, f64)>,
}

fn spools(fixtures: &Fixtures) -> Vec<(String, Design)> {
    let contact = |bonded: bool| if bonded { Contact::Bonded } else { Contact::Gap };
    let word = |bonded: bool| if bonded { "bonded" } else { "loose" };
    let mut designs = Vec::new();
    for material in &fixtures.spools {
        for sides in [&[][..], &[Side::Right][..], &[Side::Left][..], &[Side::Left, Side::Right][..]] {
            for (hub, flange) in [(true, true), (true, false), (false, true), (false, false)] {
                // without flanges only the hub's bond counts; a coil that nothing holds is no coil on a spool
                if (sides.is_empty() && !flange) || (!hub && (sides.is_empty() || !flange)) {
                    continue;
                }
                let Some(design) = design(fixtures, material, sides, contact(hub), contact(flange)) else { continue };
                let flanges = match sides {
                    [] => "no flange".to_string(),
                    [Side::Right] => format!("one flange (CW side) {}", word(flange)),
                    [Side::Left] => format!("one flange (CCW side) {}", word(flange)),
                    _ => format!("two flanges {}", word(flange)),
                };
                designs.push((format!("{}, hub {}, {flanges}", material.name, word(hub)), design));
            }
        }
    }
    designs
}

fn design(fixtures: &Fixtures, material: &SpoolMaterial, sides: &[Side], hub: Contact, flange: Contact) -> Option<Design> {
    let mut design = fixtures.coil.clone();
    let spool = design.spool.as_mut()?;
    let like: Flange = *spool.flanges.first()?;
    spool.material.elastic = Isotropic {
        youngs_modulus: material.youngs_modulus_gpa * 1e9,
        poisson_ratio: material.poisson_ratio,
        thermal_expansion: material.thermal_expansion_per_k,
    };
    spool.hub_contact = hub;
    spool.flanges = sides.iter().map(|&side| Flange { side, contact: flange, ..like }).collect();
    Some(design)
}

pub(crate) fn over_spools(fixtures: &Fixtures) -> Result<Spread, Failure> {
    let solve = |(name, design): (String, Design)| -> Result<(String, f64, f64), Failure> {
        let s = steady_sensitivity(&design)?;
        Ok((name, s.sensitivity.total(), s.error_estimate))
    };
    let mut solved = spools(fixtures).into_par_iter().map(solve).collect::<Result<Vec<_>, _>>()?;
    let lines = solved.iter().map(|(name, s, _)| (name.clone(), *s)).collect();
    solved.sort_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let none = || Failure("fixtures/spool-materials.ron lists no material".into());
    let (lowest, highest) = (solved.first().ok_or_else(none)?, solved.last().ok_or_else(none)?);
    Ok(Spread { lowest: (lowest.0.clone(), lowest.1.abs(), lowest.2), highest: (highest.0.clone(), highest.1.abs()), lines })
}
