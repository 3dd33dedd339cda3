//! The fibre's cell: `CELL.ron`.

use std::path::{Path, PathBuf};

use fem_core::material::Isotropic;
use homogenization::{Constituent, FibreCell, Homogenized, Ring, Role};
use serde::Deserialize;

use super::InputError;
use super::fingerprint::Fingerprint;
use super::limits::{CONDUCTIVITY, EXPANSION_PER_K, FIBRE_UM, Group, MODULUS_MPA};
use super::source::Source;
use crate::Error;
use crate::units::{from_mpa, from_um};

/// Rings of the most elaborate fibre accepted.
const MOST_RINGS: usize = 16;

/// A cell file that has been read and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct CellCase {
    /// The file it was read from.
    pub file: PathBuf,
    /// Its name.
    pub name: String,
    /// Names of the rings from the inside out.
    pub ring_names: Vec<String>,
    /// What it describes, in SI.
    pub cell: FibreCell,
    /// Its content.
    pub fingerprint: Fingerprint,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CellFile {
    name: String,
    pitch_um: f64,
    rings: Vec<RingFile>,
    adhesive: ConstituentFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RingFile {
    name: String,
    outer_diameter_um: f64,
    glass: bool,
    material: ConstituentFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ConstituentFile {
    youngs_modulus_mpa: f64,
    poisson_ratio: f64,
    thermal_expansion_per_k: f64,
    conductivity_w_per_mk: f64,
}

/// Reads and checks a cell file.
///
/// # Errors
/// What is wrong, in which file, line and field, and how to mend it.
pub fn read_cell(path: &Path) -> Result<CellCase, InputError> {
    let source = Source::read(path)?;
    let file: CellFile = source.parse()?;
    let top = Group::whole(&source);
    let pitch = top.number("pitch_um", file.pitch_um, &FIBRE_UM)?;
    let rings = rings(&top, &file.rings, pitch)?;
    let adhesive = constituent(&top.group("adhesive"), &file.adhesive)?;
    let ring_names = file.rings.into_iter().map(|ring| ring.name).collect();
    Ok(CellCase {
        file: path.to_owned(),
        name: file.name,
        ring_names,
        cell: FibreCell { pitch: from_um(pitch), rings, adhesive },
        fingerprint: source.fingerprint(),
    })
}

impl CellCase {
    /// Effective constants with their numerical errors.
    ///
    /// # Errors
    /// [`Error::Homogenization`] if the cell cannot be solved.
    pub fn homogenize(&self) -> Result<Homogenized, Error> {
        homogenization::homogenize(&self.cell).map_err(|source| Error::Homogenization { file: self.file.clone(), source })
    }
}

fn rings(top: &Group, files: &[RingFile], pitch: f64) -> Result<Vec<Ring>, InputError> {
    if files.is_empty() || files.len() > MOST_RINGS {
        let problem = format!("{} rings are given, but a fibre has 1 to {MOST_RINGS}", files.len());
        return Err(top.fault("rings", problem, "list the fibre's rings from the inside out"));
    }
    let mut rings = Vec::with_capacity(files.len());
    let mut inside = 0.0;
    for (i, file) in files.iter().enumerate() {
        let at = top.group(&format!("rings[{i}]"));
        let (key, outside) = ("outer_diameter_um", file.outer_diameter_um);
        at.number(key, outside, &FIBRE_UM)?;
        if outside <= inside {
            let problem = format!("{outside} um is not greater than the ring inside it, {inside} um");
            return Err(at.fault(key, problem, "list the rings from the inside out by their outer diameters"));
        }
        if outside >= pitch {
            let problem = format!("{outside} um reaches the next fibre, {pitch} um away: no adhesive is left");
            return Err(at.fault(key, problem, "make it less than pitch_um"));
        }
        let role = if file.glass { Role::Glass } else { Role::Coating };
        let constituent = constituent(&at.group("material"), &file.material)?;
        rings.push(Ring { outer_radius: from_um(outside) / 2.0, constituent, role });
        inside = outside;
    }
    if rings.iter().all(|ring| ring.role == Role::Coating) {
        let remedy = "mark the fibre's silica with `glass: true`";
        return Err(top.fault("rings[0].glass", "no ring is glass, so the M row has no strain to report", remedy));
    }
    Ok(rings)
}

fn constituent(at: &Group, file: &ConstituentFile) -> Result<Constituent, InputError> {
    let elastic = Isotropic {
        youngs_modulus: from_mpa(at.number("youngs_modulus_mpa", file.youngs_modulus_mpa, &MODULUS_MPA)?),
        poisson_ratio: file.poisson_ratio,
        thermal_expansion: at.number("thermal_expansion_per_k", file.thermal_expansion_per_k, &EXPANSION_PER_K)?,
    };
    at.law(elastic.law())?;
    Ok(Constituent { elastic, conductivity: at.number("conductivity_w_per_mk", file.conductivity_w_per_mk, &CONDUCTIVITY)? })
}
