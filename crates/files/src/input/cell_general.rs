//! Cells of any arrangement: lattices of several fibres, displaced fibres, given places, ellipses, offsets, voids.

use std::path::PathBuf;

use homogenization::Role;
use homogenization::irregular::{Arrangement, Cell, Inclusion, Layout, LayoutError, Outline, Phase, displace};

use super::InputError;
use super::cell_file::{CellFile, PackingFile, RingFile, VoidFile};
use super::cell_material::Material;
use super::fingerprint::Fingerprint;
use super::group::Group;
use super::mirror::Mirror;
use super::quantity::FibreUm;
use super::syntax::MISSING;
use crate::{Error, shown_path};

pub(super) const MOST_FIBRES: usize = 100;
const MOST_REALISATIONS: usize = 1000;

/// A cell file of any arrangement that has been read and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct GeneralCase {
    /// The file it was read from.
    pub file: PathBuf,
    /// Its name.
    pub name: String,
    /// Arrangements: one, or as many as realisations are asked for.
    pub layouts: Vec<Layout>,
    /// Name, role and material of each phase: the rings from the inside out, last the adhesive.
    pub phases: Vec<(String, Role, Material)>,
    /// Its content.
    pub fingerprint: Fingerprint,
}

impl GeneralCase {
    /// Temperatures \[°C\] that all tables cover; none if there is no table.
    pub fn temperatures(&self) -> Option<[f64; 2]> {
        let ranges = self.phases.iter().filter_map(|(_, _, material)| material.range());
        ranges.reduce(|a, b| [a[0].max(b[0]), a[1].min(b[1])])
    }

    /// The cell of one of its layouts with the constants of a temperature \[°C\].
    ///
    /// # Errors
    /// [`Error::Usage`] if a table does not cover the temperature, or needs one.
    pub fn cell(&self, layout: &Layout, celsius: Option<f64>) -> Result<Cell, Error> {
        let phase = |(name, role, material): &(String, Role, Material)| {
            let solid = material.at(celsius).ok_or_else(|| {
                let [low, high] = material.range().unwrap_or_default();
                let file = shown_path(&self.file);
                Error::Usage(match celsius {
                    Some(t) => format!("{file}: the table of {name} runs from {low} to {high} degC, {t} degC is outside"),
                    None => {
                        format!("{file}: the constants of {name} are a table over temperature; say at which (--temperatures 20)")
                    }
                })
            })?;
            Ok(Phase { name: name.clone(), solid, role: *role })
        };
        Ok(Cell { layout: layout.clone(), phases: self.phases.iter().map(phase).collect::<Result<_, Error>>()? })
    }
}

/// The layouts of a cell whose rings have these outlines about the fibre's axis.
pub(super) fn layouts(top: &Group, file: &CellFile, outlines: &[Outline]) -> Result<Vec<Layout>, InputError> {
    if file.voids.len() > MOST_FIBRES {
        let problem = format!("{} voids are given, at most {MOST_FIBRES} are read", file.voids.len());
        return Err(top.fault("voids", problem, "leave some out"));
    }
    let layout = |arrangement: Arrangement| {
        let fibre = |centre: &[f64; 2]| Inclusion {
            outlines: outlines.iter().map(|o| o.moved(*centre)).collect(),
            phases: (0..outlines.len()).map(Some).collect(),
        };
        let fibres = arrangement.centres.len();
        let inclusions = arrangement.centres.iter().map(fibre).chain(file.voids.iter().map(void)).collect();
        let layout = Layout::new(arrangement.lattice, inclusions, outlines.len());
        layout.map_err(|error| misplaced(top, file, fibres, &error))
    };
    arrangements(top, file, outlines)?.into_iter().map(layout).collect()
}

/// Outline of a ring about the fibre's axis.
pub(super) fn outline(at: &Group, file: &RingFile) -> Result<Outline, InputError> {
    let diameters = match (*file.outer_diameter_um, *file.outer_diameters_um) {
        (Some(d), None) => (d, d),
        (None, Some(both)) => both,
        (Some(_), Some(_)) => {
            return Err(at.fault("outer_diameters_um", "is given beside `outer_diameter_um`", "keep one of the two"));
        }
        (None, None) => {
            let remedy = "add it to the group, or `outer_diameters_um: (a, b)` for an ellipse";
            return Err(at.fault("outer_diameter_um", MISSING, remedy));
        }
    };
    let semi_axes = diameters.model().map(|d| d / 2.0);
    Ok(Outline { centre: file.offset_um.model(), semi_axes, angle: file.angle_deg.model() })
}

fn void(file: &VoidFile) -> Inclusion {
    let semi_axes = file.diameters_um.model().map(|d| d / 2.0);
    Inclusion::void(Outline { centre: file.centre_um.model(), semi_axes, angle: file.angle_deg.model() })
}

fn arrangements(top: &Group, file: &CellFile, outlines: &[Outline]) -> Result<Vec<Arrangement>, InputError> {
    let regular = if file.centres_um.is_empty() && file.cell_um.is_none() { lattice(top, file)? } else { given(top, file)? };
    let Some(displaced) = *file.displaced else { return Ok(vec![regular]) };
    let at = top.group("displaced");
    let (most, film) = (displaced.most_um.model(), displaced.least_film_um.model());
    let count = at.count("realisations", displaced.realisations, MOST_REALISATIONS)?;
    // the circle about the axis that holds the fibre however its rings are shaped
    let reach = |o: &Outline| o.centre[0].hypot(o.centre[1]) + o.reach();
    let radius = outlines.iter().map(reach).fold(0.0, f64::max);
    let too_close = |error: LayoutError| at.fault("least_film_um", error.to_string(), "make it less than the regular film");
    let realisation = |k| displace(&regular, radius, most, film, displaced.seed.wrapping_add(k)).map_err(too_close);
    (0..count as u64).map(realisation).collect()
}

/// Distance of neighbouring fibres in the file's unit, which a lattice needs.
pub(super) fn pitch(top: &Group, file: &CellFile) -> Result<FibreUm, InputError> {
    file.pitch_um.ok_or_else(|| top.fault("pitch_um", MISSING, "add it to the group that ends here"))
}

fn lattice(top: &Group, file: &CellFile) -> Result<Arrangement, InputError> {
    let pitch = pitch(top, file)?.model();
    let (columns, rows) = (file.columns.unwrap_or(1), file.rows.unwrap_or(1));
    if columns * rows > MOST_FIBRES {
        let problem = format!("{columns} columns of {rows} are {} fibres, more than {MOST_FIBRES}", columns * rows);
        return Err(top.fault("rows", problem, "take a smaller cell and more realisations"));
    }
    let arrangement = match file.packing.unwrap_or(PackingFile::Hexagonal) {
        PackingFile::Hexagonal => Arrangement::hexagonal(pitch, columns, rows),
        PackingFile::Square => Arrangement::square(pitch, columns, rows),
    };
    arrangement
        .map_err(|error| top.fault("pitch_um", error.to_string(), "give the distance between the axes of neighbouring fibres"))
}

fn given(top: &Group, file: &CellFile) -> Result<Arrangement, InputError> {
    let Some([a, b]) = *file.cell_um else {
        let remedy = "`centres_um` needs the cell's two lattice vectors, e.g. ((340.0, 0.0), (170.0, 294.4))";
        return Err(top.fault("cell_um", MISSING, remedy));
    };
    let beside = [
        ("pitch_um", file.pitch_um.is_some()),
        ("packing", file.packing.is_some()),
        ("columns", file.columns.is_some()),
        ("rows", file.rows.is_some()),
    ];
    if let Some((key, _)) = beside.into_iter().find(|(_, given)| *given) {
        let problem = "is given beside `cell_um`, which sets the places";
        return Err(top.fault(key, problem, "remove it, or `cell_um` and `centres_um`"));
    }
    if file.centres_um.is_empty() || file.centres_um.len() > MOST_FIBRES {
        let problem = format!("{} fibres are placed, but a cell has 1 to {MOST_FIBRES}", file.centres_um.len());
        return Err(top.fault("centres_um", problem, "list the places of the fibre axes, e.g. [(0.0, 0.0)]"));
    }
    Ok(Arrangement { lattice: [a.model(), b.model()], centres: file.centres_um.model() })
}

/// The faults of an arrangement, at the field that is to blame.
fn misplaced(top: &Group, file: &CellFile, fibres: usize, error: &LayoutError) -> InputError {
    let name = |i: usize| if i < fibres { format!("fibre {i}") } else { format!("voids[{}]", i - fibres) };
    let last = file.rings.len() - 1;
    let ring = |i: usize| {
        format!(
            "rings[{i}].{}",
            if file.rings[i].outer_diameters_um.is_some() { "outer_diameters_um" } else { "outer_diameter_um" }
        )
    };
    match error {
        LayoutError::Nesting { ring: i, thickness, .. } => {
            let um = 1e6 * thickness;
            if *thickness > 0.0 {
                let problem = format!("leaves ring {} only {um:.3} um thick at its thinnest, too thin to be meshed", i + 1);
                return top.fault(&ring(*i), problem, "make the ring around it wider, or move this one towards its centre");
            }
            let problem = format!("does not lie inside ring {} (least thickness {um:.3} um)", i + 1);
            top.fault(&ring(*i), problem, "list the rings from the inside out, each inside the next")
        }
        LayoutError::Overlap { first, second, film } => {
            let problem =
                format!("{} and {} leave a film of {:.3} um (negative: they overlap)", name(*first), name(*second), 1e6 * film);
            let at = [*first, *second].into_iter().find(|i| *i >= fibres).map(name);
            let placed = (!file.centres_um.is_empty()).then(|| format!("centres_um[{second}]"));
            top.fault(&at.or(placed).unwrap_or_else(|| ring(last)), problem, "move them apart or make them smaller")
        }
        LayoutError::Lattice(_) => {
            let remedy = "give two vectors, the second to the left of the first, e.g. ((340.0, 0.0), (170.0, 294.4))";
            top.fault("cell_um", "the two vectors do not span a cell", remedy)
        }
        other => top.fault("rings", other.to_string(), "check the shapes"),
    }
}
