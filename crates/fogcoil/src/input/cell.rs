//! The fibre's cell: `CELL.ron`.

use std::path::{Path, PathBuf};

use homogenization::{FibreCell, Homogenized, Packing, Ring, Role};

use super::cell_file::{CellFile, PackingFile, RingFile};
use super::cell_general::{GeneralCase, general};
use super::cell_material::isotropic;
use super::fingerprint::Fingerprint;
use super::limits::{FIBRE_UM, Group};
use super::source::Source;
use super::{InputError, MOST_RINGS};
use crate::Error;
use crate::units::from_um;

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

/// Reads and checks the file of a regular cell: one fibre of round rings, isotropic constituents.
///
/// # Errors
/// What is wrong, in which file, line and field, and how to mend it.
pub fn read_cell(path: &Path) -> Result<CellCase, InputError> {
    let source = Source::read(path)?;
    let file: CellFile = source.parse()?;
    if let Some(key) = file.general_key() {
        let remedy = "leave the key out, or take `fogcoil homogenize`";
        return Err(Group::whole(&source).fault(&key, "the cell must be regular here", remedy));
    }
    regular(&source, file, path)
}

/// A cell file of either kind.
#[derive(Debug, Clone)]
pub enum AnyCell {
    /// One fibre of round rings, isotropic constituents; also as a general cell, unless a film or ring is too thin for that.
    Regular(Box<CellCase>, Result<GeneralCase, InputError>),
    /// Any other.
    General(GeneralCase),
}

/// Reads and checks a cell file of any arrangement.
///
/// # Errors
/// What is wrong, in which file, line and field, and how to mend it.
pub fn read_any_cell(path: &Path) -> Result<AnyCell, InputError> {
    any(path, &Source::read(path)?)
}

/// Checks a cell file that is not written yet: the case that [`read_any_cell`] would read.
///
/// # Errors
/// As [`read_any_cell`].
pub fn check_any_cell(path: &Path, text: &str) -> Result<AnyCell, InputError> {
    any(path, &Source::of(path, text.to_owned()))
}

fn any(path: &Path, source: &Source) -> Result<AnyCell, InputError> {
    let file: CellFile = source.parse()?;
    let general = || general(&Group::whole(source), &file, path.to_owned(), source.fingerprint());
    if file.general_key().is_some() {
        return general().map(AnyCell::General);
    }
    // a regular cell's own complaints come first
    let regular = regular(source, source.parse()?, path)?;
    Ok(AnyCell::Regular(Box::new(regular), general()))
}

fn regular(source: &Source, file: CellFile, path: &Path) -> Result<CellCase, InputError> {
    let top = Group::whole(source);
    let missing = || top.fault("pitch_um", "the field is missing", "add it to the group that ends here");
    let pitch = top.number("pitch_um", file.pitch_um.ok_or_else(missing)?, &FIBRE_UM)?;
    let packing = match file.packing {
        Some(PackingFile::Square) => Packing::Square,
        Some(PackingFile::Hexagonal) | None => Packing::Hexagonal,
    };
    let rings = rings(&top, &file.rings, pitch)?;
    let adhesive = isotropic(&top.group("adhesive"), &file.adhesive)?;
    let ring_names = file.rings.into_iter().map(|ring| ring.name).collect();
    Ok(CellCase {
        file: path.to_owned(),
        name: file.name,
        ring_names,
        cell: FibreCell { packing, pitch: from_um(pitch), rings, adhesive },
        fingerprint: source.fingerprint(),
    })
}

impl CellCase {
    /// Effective constants, each to the default relative error.
    ///
    /// # Errors
    /// As [`Self::homogenize_to`].
    pub fn homogenize(&self) -> Result<Homogenized, Error> {
        self.homogenize_to(homogenization::TOLERANCE)
    }

    /// Effective constants, each to a relative error.
    ///
    /// # Errors
    /// [`Error::Homogenization`] if the cell cannot be solved to it.
    pub fn homogenize_to(&self, relative_error: f64) -> Result<Homogenized, Error> {
        homogenization::homogenize_to(&self.cell, relative_error)
            .map_err(|source| Error::Homogenization { file: self.file.clone(), source })
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
        let key = "outer_diameter_um";
        let missing = || at.fault(key, "the field is missing", "add it to the group that ends here");
        let outside = file.outer_diameter_um.ok_or_else(missing)?;
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
        let constituent = isotropic(&at.group("material"), &file.material)?;
        rings.push(Ring { outer_radius: from_um(outside) / 2.0, constituent, role });
        inside = outside;
    }
    if rings.iter().all(|ring| ring.role == Role::Coating) {
        let remedy = "mark the fibre's silica with `glass: true`";
        return Err(top.fault("rings[0].glass", "no ring is glass, so the M row has no strain to report", remedy));
    }
    Ok(rings)
}
