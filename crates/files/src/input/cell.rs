//! The fibre's cell: `CELL.ron`.

use std::path::{Path, PathBuf};

use homogenization::irregular::Outline;
use homogenization::{FibreCell, Homogenized, Packing, Ring, Role};

use super::InputError;
use super::cell_file::{CellFile, PackingFile};
use super::cell_general::{GeneralCase, MOST_FIBRES, layouts, outline, pitch};
use super::cell_material::{Material, material};
use super::fingerprint::Fingerprint;
use super::group::Group;
use super::mirror::Mirror;
use super::opened::open;
use super::source::{CELL, Source};
use crate::Error;
use crate::note::Note;
use crate::remark::Remark;

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
    /// The cell that it describes, in SI.
    pub cell: FibreCell,
    /// Its content.
    pub fingerprint: Fingerprint,
}

/// A cell file of either kind.
#[derive(Debug, Clone)]
pub enum AnyCell {
    /// One fibre of round rings, isotropic constituents; also as a general cell, unless a film or ring is too thin for that.
    Regular(Box<CellCase>, Result<GeneralCase, InputError>),
    /// Any other.
    General(GeneralCase),
}

/// Reads and checks the file of a regular cell: one fibre of round rings, isotropic constituents.
///
/// # Errors
/// The fault, in which file, line and field, and how to mend it.
pub fn read_cell(path: &Path) -> Result<CellCase, InputError> {
    let source = open(path)?;
    let file: CellFile = source.parse(Some(&CELL))?;
    if let Some(key) = file.general_key() {
        return Err(irregular(&Group::whole(&source), &key));
    }
    Fibre::new(&source, file)?.regular(path)
}

/// Reads and checks a cell file of any arrangement.
///
/// # Errors
/// The fault, in which file, line and field, and how to mend it.
pub fn read_any_cell(path: &Path) -> Result<AnyCell, InputError> {
    any(path, &open(path)?)
}

/// Checks a cell file that is not written yet: the case that [`read_any_cell`] would read.
///
/// # Errors
/// As [`read_any_cell`].
pub fn check_any_cell(path: &Path, text: &str) -> Result<AnyCell, InputError> {
    any(path, &Source::of(path, text.to_owned()))
}

fn any(path: &Path, source: &Source) -> Result<AnyCell, InputError> {
    let fibre = Fibre::new(source, source.parse(Some(&CELL))?)?;
    if fibre.file.general_key().is_some() {
        return fibre.general(path).map(AnyCell::General);
    }
    Ok(AnyCell::Regular(Box::new(fibre.regular(path)?), fibre.general(path)))
}

/// The complaint about a key that a regular cell does not have.
fn irregular(top: &Group, key: &str) -> InputError {
    top.fault(key, "the cell must be regular here", "leave the key out, or take `fogcoil homogenize`")
}

impl AnyCell {
    /// A note on materials that have no density or no specific heat where others have one.
    pub fn untold(&self) -> Option<Note> {
        let each: Vec<(&str, [Option<f64>; 2])> = match self {
            Self::Regular(case, _) => {
                let names = case.ring_names.iter().map(String::as_str).chain(["adhesive"]);
                names.zip(case.cell.constituents().map(|c| [c.density, c.specific_heat])).collect()
            }
            Self::General(case) => case.phases.iter().map(|(name, _, material)| (name.as_str(), material.masses())).collect(),
        };
        let of = |(k, key): (usize, &str)| {
            let lacking: Vec<&str> = each.iter().filter(|(_, values)| values[k].is_none()).map(|(name, _)| *name).collect();
            let some = !lacking.is_empty() && lacking.len() < each.len();
            some.then(|| format!("{} without {key}, which the others have", lacking.join(", ")))
        };
        let said: Vec<String> = ["density_kg_per_m3", "specific_heat_j_per_kgk"].into_iter().enumerate().filter_map(of).collect();
        (!said.is_empty()).then(|| Remark::UntoldMaterial.note(format!("{}: the cell's mean is left out", said.join("; "))))
    }
}

/// Common part of every cell: a fibre of rings, and constituents.
struct Fibre<'a> {
    source: &'a Source,
    file: CellFile,
    /// Outlines of the rings from the inside out.
    outlines: Vec<Outline>,
    /// Names, roles and materials of the rings, last of the adhesive.
    phases: Vec<(String, Role, Material)>,
}

impl<'a> Fibre<'a> {
    fn new(source: &'a Source, file: CellFile) -> Result<Self, InputError> {
        let top = Group::whole(source);
        if file.rings.is_empty() || file.rings.len() > MOST_RINGS {
            let problem = format!("{} rings are given, but a fibre has 1 to {MOST_RINGS}", file.rings.len());
            return Err(top.fault("rings", problem, "list the fibre's rings from the inside out"));
        }
        for (key, count) in [("columns", *file.columns), ("rows", *file.rows)] {
            count.map_or(Ok(1), |count| top.count(key, count, MOST_FIBRES))?;
        }
        let (mut outlines, mut phases) = (Vec::new(), Vec::new());
        for (at, ring) in top.each("rings", &file.rings) {
            outlines.push(outline(&at, ring)?);
            let role = if ring.glass { Role::Glass } else { Role::Coating };
            phases.push((ring.name.clone(), role, material(&at.group("material"), &ring.material)?));
        }
        if phases.iter().all(|(_, role, _)| *role == Role::Coating) {
            let remedy = "mark the fibre's silica with `glass: true`";
            return Err(top.fault("rings[0].glass", "no ring is glass, so the M row has no strain to report", remedy));
        }
        phases.push(("adhesive".into(), Role::Coating, material(&top.group("adhesive"), &file.adhesive)?));
        Ok(Self { source, file, outlines, phases })
    }

    fn general(&self, path: &Path) -> Result<GeneralCase, InputError> {
        let layouts = layouts(&Group::whole(self.source), &self.file, &self.outlines)?;
        let (file, name, phases) = (path.to_owned(), self.file.name.clone(), self.phases.clone());
        Ok(GeneralCase { file, name, layouts, phases, fingerprint: self.source.fingerprint() })
    }

    /// The cell of a file without a general key: its rings are round and its constituents isotropic.
    fn regular(&self, path: &Path) -> Result<CellCase, InputError> {
        let (top, file) = (Group::whole(self.source), &self.file);
        let pitch = pitch(&top, file)?;
        let mut inside = 0.0;
        for (at, ring) in top.each("rings", &file.rings) {
            let fault = |problem, remedy: &str| Err(at.fault("outer_diameter_um", problem, remedy));
            let outside = ring.outer_diameter_um.unwrap_or_default().0;
            if outside <= inside {
                let problem = format!("{outside} um is not greater than the ring inside it, {inside} um");
                return fault(problem, "list the rings from the inside out by their outer diameters");
            }
            if outside >= pitch.0 {
                let problem = format!("{outside} um reaches the next fibre, {} um away: no adhesive is left", pitch.0);
                return fault(problem, "make it less than pitch_um");
            }
            inside = outside;
        }
        let packing = match *file.packing {
            Some(PackingFile::Square) => Packing::Square,
            Some(PackingFile::Hexagonal) | None => Packing::Hexagonal,
        };
        let isotropic = |k: usize, key: &str| match &self.phases[k].2 {
            Material::Isotropic(constituent) => Ok(*constituent),
            Material::Orthotropic(_) | Material::Table(_) => Err(irregular(&top, key)),
        };
        let ring = |(k, outline): (usize, &Outline)| {
            let constituent = isotropic(k, &format!("rings[{k}].material"))?;
            Ok(Ring { outer_radius: outline.semi_axes[0], constituent, role: self.phases[k].1 })
        };
        let rings: Vec<Ring> = self.outlines.iter().enumerate().map(ring).collect::<Result<_, InputError>>()?;
        let adhesive = isotropic(rings.len(), "adhesive")?;
        Ok(CellCase {
            file: path.to_owned(),
            name: file.name.clone(),
            ring_names: file.rings.iter().map(|ring| ring.name.clone()).collect(),
            cell: FibreCell { packing, pitch: pitch.model(), rings, adhesive },
            fingerprint: self.source.fingerprint(),
        })
    }
}

impl CellCase {
    /// Effective constants, each to a relative error.
    ///
    /// # Errors
    /// [`Error::Homogenization`] if the cell cannot be solved to it.
    pub fn homogenize_to(&self, relative_error: f64) -> Result<Homogenized, Error> {
        homogenization::homogenize_to(&self.cell, relative_error)
            .map_err(|source| Error::Homogenization { file: self.file.clone(), source })
    }
}
