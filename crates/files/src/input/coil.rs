//! The coil's case file: `COIL.ron`.

use std::path::{Path, PathBuf};

use coil::{Body, Dehomogenization, Design, Layout, Number, Parameter, Sensor, SteadySensitivity, Tolerances};
use homogenization::{Constants, Packing, TOLERANCE};
use winding::Winding;

use super::cell::{AnyCell, read_any_cell};
use super::cell_constants::at_temperature;
use super::cell_general::GeneralCase;
use super::coil_file::{self, BodyFile, CoilFile, DehomogenizationFile, MaterialFile};
use super::fingerprint::Fingerprint;
use super::group::Group;
use super::mechanics::mechanics;
use super::mirror::Mirror;
use super::opened::open;
use super::source::{COIL, Source};
use super::spool_file::spool;
use super::tolerances::{self, Unused};
use super::warnings::{in_medium, mean_diameter, warnings};
use super::winding_file::winding;
use super::{InputError, heat};
use crate::note::Note;
use crate::remark::Remark;
use crate::units::to_mm;
use crate::{Error, shown_path};

/// Table II of Osunluk, Ogut and Ozbay as printed; its exponents and the last sign are misprints (see the validation).
pub const PRINTED: Dehomogenization = Dehomogenization { m_rx: 2.74e-6, m_ry: 2.70e-6, m_rz: -0.17, m_rt: 9.98e-6 };

/// A coil file that has been read and checked.
#[derive(Debug, Clone)]
pub struct CoilCase {
    /// The file it was read from.
    pub file: PathBuf,
    /// Its name.
    pub name: String,
    /// The design that it describes, in SI.
    pub design: Design,
    /// Deviations of a unit from it.
    pub tolerances: Tolerances,
    /// Its turns.
    pub winding: Winding,
    /// Origin of its numbers.
    pub provenance: Provenance,
    /// The content of the file and of the cells it names, in this order.
    pub fingerprints: Vec<Fingerprint>,
    /// Warnings of entries that are allowed but look like mistakes.
    pub warnings: Vec<Note>,
}

/// Origins of a design's numbers that a file can give in several ways.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provenance {
    /// Origin of the coil's constants.
    pub material: Origin,
    /// Origin of the dehomogenisation row.
    pub dehomogenization: Origin,
}

/// Origin of a set of numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// Written in the coil file.
    Given,
    /// Homogenised from this cell file.
    Cell(PathBuf),
    /// As the paper prints it.
    Printed,
}

/// Cells that have been homogenised, by path: each once.
struct Cells<'a> {
    top: Group<'a>,
    source: &'a Source,
    done: Vec<(PathBuf, Constants)>,
    /// Mean density \[kg/m³\] and heat capacity of a volume \[J/(m³ K)\] of each, as far as its file gives them, with the name of the file.
    masses: Vec<(String, [Option<f64>; 2])>,
    fingerprints: Vec<Fingerprint>,
    /// Notes on numbers that were replaced by an approximation.
    notes: Vec<Note>,
    /// Pitch of the winding \[m\].
    pitch: f64,
}

/// Largest overhang of the winding beyond the coil's rectangle, in pitches: drawings round to hundredths of a millimetre.
const SLACK: f64 = 0.1;

/// Largest relative difference between the pitches of cell and winding that passes without a word.
const SAME_PITCH: f64 = 0.01;

/// Largest distance of a coil's cell from transverse isotropy, which a coil's law has.
const MOST_ANISOTROPY: f64 = 0.01;

/// Reads and checks a coil file; homogenises the cells it names.
///
/// Without a spool the thermometer sits at the coil's bore, whatever radius the file gives.
///
/// # Errors
/// [`Error::Input`] says what is wrong, in which file, line and field, and how to mend it; [`Error::Homogenization`] if a sound
/// cell cannot be solved.
pub fn read_coil(path: &Path) -> Result<CoilCase, Error> {
    checked(path, open(path)?, Unused::Refused)
}

/// Reads and checks a coil file, with its text.
///
/// # Errors
/// As [`read_coil`].
pub fn read_coil_with_text(path: &Path) -> Result<(CoilCase, String), Error> {
    let source = open(path)?;
    Ok((checked(path, source.clone(), Unused::Refused)?, source.into_text()))
}

/// Checks a coil file that is yet to be written: the case that [`read_coil`] would read.
///
/// # Errors
/// As [`read_coil`].
pub fn check_coil(path: &Path, text: &str) -> Result<CoilCase, Error> {
    checked(path, Source::of(path, text.to_owned()), Unused::Refused)
}

/// The same of a design that was made from a drawing: tolerances and correlations of parts that it does not have are the drawing's, and left out.
///
/// # Errors
/// As [`check_coil`].
pub fn check_variant(path: &Path, text: &str) -> Result<CoilCase, Error> {
    checked(path, Source::of(path, text.to_owned()), Unused::LeftOut)
}

fn checked(path: &Path, source: Source, unused: Unused) -> Result<CoilCase, Error> {
    let file: CoilFile = source.parse(Some(&COIL))?;
    let top = Group::whole(&source);
    let winding = winding(&top.group("winding"), &file.winding)?;
    let inner_radius = winding.spec().inner_radius;
    check_rectangle(&top.group("coil"), &file.coil, &winding)?;
    check_place(&top.group("winding"), &file.coil, &winding)?;
    let spool = file.spool.as_ref().map(|file| spool(&top.group("spool"), file, inner_radius)).transpose()?;
    let mut sensor: Sensor = file.sensor.model();
    if spool.is_none() {
        sensor.radius = inner_radius;
    }
    let mut cells = Cells {
        top: top.clone(),
        source: &source,
        done: Vec::new(),
        masses: Vec::new(),
        fingerprints: vec![source.fingerprint()],
        notes: Vec::new(),
        pitch: winding.spec().pitch,
    };
    let (constants, material) = material(&mut cells, &file.coil.material)?;
    let (dehomogenization, row) = dehomogenization(&mut cells, &file.dehomogenization)?;
    // by their constants: one cell may have two paths
    if let (Origin::Cell(of_constants), Origin::Cell(of_row)) = (&material, &row)
        && let [(_, first), (_, second)] = &cells.done[..]
        && first != second
    {
        let [of_constants, of_row] = [of_constants, of_row].map(|path| shown_path(path));
        cells.notes.push(Remark::OtherCell.warning(format!(
            "dehomogenization is that of {of_row}, coil.material that of {of_constants}; is this meant? A plan exchanges both by the key \
             \"coil.material and dehomogenization\""
        )));
    }
    let coil_file::Constants { elastic, conductivity_z, conductivity_r } = constants;
    let body = Body {
        outer_radius: file.coil.outer_radius_mm.model(),
        height: file.coil.height_mm.model(),
        density: file.coil.density_kg_per_m3.model(),
        specific_heat: file.coil.specific_heat_j_per_kgk.model(),
        elastic,
        conductivity_z,
        conductivity_r,
    };
    let design = Design {
        winding: *winding.spec(),
        body,
        surroundings: file.surroundings.model(),
        mechanics: mechanics(&top.group("mechanics"), &file.mechanics, &body)?,
        heat: heat::paths(&top.group("heat"), &file.heat, spool.as_ref())?,
        spool,
        sensor,
        optics: optics(&file.optics, mean_diameter(&body, &winding)),
        drifts: file.drifts.model(),
        dehomogenization,
    };
    let layout = Layout::new(&design).map_err(|error| design_fault(&top, &design, &error))?;
    // with a film there is no medium for the thermometer to sit in
    if design.heat.film.is_some() && in_medium(&layout, design.sensor) {
        let problem = "the thermometer lies outside the solids, and a film stands in place of the medium";
        return Err(top.fault("sensor", problem, "move it into the spool or the coil, or remove heat.film_w_per_m2k").into());
    }
    let tolerances = tolerances::tolerances(&top, &file.tolerances, &file.correlations, &design, unused)?;
    let cut = tolerances::cut(&tolerances, &design);
    cells.compare_masses(&design, &tolerances);
    let name = file.name;
    let provenance = Provenance { material, dehomogenization: row };
    let (file, fingerprints) = (path.to_owned(), cells.fingerprints);
    let warnings = [cells.notes, warnings(&design, &layout, &winding), cut].concat();
    Ok(CoilCase { file, name, design, tolerances, winding, provenance, fingerprints, warnings })
}

impl CoilCase {
    /// Whether it is a lot's design, as `fogcoil calibrate` writes it: a drawing knows no correlations of its constants.
    pub fn is_calibrated(&self) -> bool {
        !self.tolerances.correlations.is_empty()
    }

    /// Bias per temperature rate in a steady ramp.
    ///
    /// # Errors
    /// [`Error::Coil`] if the coil cannot be solved.
    pub fn steady_sensitivity(&self) -> Result<SteadySensitivity, Error> {
        coil::steady_sensitivity(&self.design).map_err(|source| Error::Coil { file: self.file.clone(), source })
    }

    /// Effect of its tolerances on that.
    ///
    /// # Errors
    /// As [`Self::steady_sensitivity`].
    pub fn sensitivity_band(&self) -> Result<coil::Band, Error> {
        coil::sensitivity_band(&self.design, &self.tolerances).map_err(|source| Error::Coil { file: self.file.clone(), source })
    }

    /// Effect of each of its tolerances on that, part by part.
    ///
    /// # Errors
    /// As [`Self::steady_sensitivity`].
    pub fn sensitivity_changes(&self) -> Result<Vec<coil::SensitivityChange>, Error> {
        coil::sensitivity_changes(&self.design, &self.tolerances)
            .map_err(|source| Error::Coil { file: self.file.clone(), source })
    }
}

/// The fibre's optics; an effective diameter that is not given is the mean one.
fn optics(file: &coil_file::OpticsFile, mean_diameter: f64) -> bias::Optics {
    let optics = file.model();
    let sagnac_diameter = if optics.sagnac_diameter.is_nan() { mean_diameter } else { optics.sagnac_diameter };
    bias::Optics { sagnac_diameter, ..optics }
}

/// A complaint about the design as a whole, at the field it names.
fn design_fault(top: &Group, design: &Design, error: &coil::Error) -> InputError {
    match error {
        coil::Error::Design { field, .. } if field == "sensor" => {
            let hub = design.spool.as_ref().map_or(0.0, |spool| spool.hub_contact.gap() + spool.hub_thickness);
            let (bore, middle) = (to_mm(design.winding.inner_radius - hub), to_mm(design.body.height / 2.0));
            let remedy = format!("at the bore, mid height, it would be (radius_mm: {bore:.3}, y_mm: {middle:.3})");
            top.fault(field, "the thermometer lies outside the chamber", remedy)
        }
        coil::Error::Design { field, problem } => top.fault(field, problem.as_str(), ""),
        other => top.fault("", other.to_string(), ""),
    }
}

fn check_rectangle(at: &Group, file: &BodyFile, winding: &Winding) -> Result<(), InputError> {
    let (inner, outer) = (to_mm(winding.spec().inner_radius), file.outer_radius_mm.0);
    if outer <= inner {
        let problem = format!("{outer} mm is not greater than winding.inner_radius_mm, {inner} mm");
        let remedy = "give both as radii of the wound coil: either may be a diameter or a thickness";
        return Err(at.fault("outer_radius_mm", problem, remedy));
    }
    let slack = SLACK * to_mm(winding.spec().pitch);
    let height = ("height_mm", file.height_mm.0, winding.height());
    let extents =
        [Some(("outer_radius_mm", outer, winding.outer_radius())), Some(height).filter(|_| winding.spec().end.is_none())];
    for (key, given, wound) in extents.into_iter().flatten() {
        let wound = to_mm(wound);
        if wound > given + slack {
            let problem = format!("the winding reaches {wound:.4} mm, outside the coil's {given} mm");
            let remedy = format!("set it to {wound:.4} or more, or check layers, turns and pitch_mm");
            return Err(at.fault(key, problem, remedy));
        }
    }
    Ok(())
}

/// Whether every turn's centre lies in the coil.
fn check_place(at: &Group, file: &BodyFile, winding: &Winding) -> Result<(), InputError> {
    let height = file.height_mm.0;
    let ([first, last], [start, end]) = (winding.spec().reach().map(to_mm), winding.spec().edges().map(to_mm));
    let outside = |centre: f64| format!("the centre of a turn lies at {centre:.4} mm, outside the coil's 0 to {height} mm");
    if first <= 0.0 {
        // turns are spread to an end that is given, and move with the start without one
        let least = if winding.spec().end.is_some() { end * (start - first) / (end - first) } else { start - first };
        return Err(at.fault("start_mm", outside(first), format!("give more than {least:.4}")));
    }
    if last >= height {
        let most = start + (height - start) * (end - start) / (last - start);
        return Err(at.fault("end_mm", outside(last), format!("give less than {most:.4}")));
    }
    Ok(())
}

fn material(cells: &mut Cells, file: &MaterialFile) -> Result<(coil_file::Constants, Origin), Error> {
    let (material, origin) = match file {
        MaterialFile::Constants(file) => (file.model(), Origin::Given),
        MaterialFile::FromCell(path) => {
            let (path, c) = cells.constants("coil.material", path)?;
            let elastic = c.elastic();
            (coil_file::Constants { elastic, conductivity_z: c.k_z, conductivity_r: c.k_r }, Origin::Cell(path))
        }
    };
    cells.top.group("coil.material").law(material.elastic.law())?;
    Ok((material, origin))
}

fn dehomogenization(cells: &mut Cells, file: &DehomogenizationFile) -> Result<(Dehomogenization, Origin), Error> {
    match file {
        DehomogenizationFile::Matrix(file) => Ok((file.model(), Origin::Given)),
        DehomogenizationFile::Printed => Ok((PRINTED, Origin::Printed)),
        DehomogenizationFile::FromCell(path) => {
            let (path, Constants { m_rx, m_ry, m_rz, m_rt, .. }) = cells.constants("dehomogenization", path)?;
            Ok((Dehomogenization { m_rx, m_ry, m_rz, m_rt }, Origin::Cell(path)))
        }
    }
}

impl Cells<'_> {
    fn constants(&mut self, field: &str, named: &str) -> Result<(PathBuf, Constants), Error> {
        let path = self.source.neighbour(named);
        if let Some(done) = self.done.iter().find(|(known, _)| *known == path) {
            return Ok(done.clone());
        }
        let unusable = |inner: InputError| self.top.fault(field, format!("the cell cannot be used: {inner}"), "");
        let (constants, masses, fingerprint) = match read_any_cell(&path).map_err(unusable)? {
            AnyCell::General(case) => {
                let (constants, masses) = self.nearest(field, named, &case)?;
                (constants, masses, case.fingerprint)
            }
            AnyCell::Regular(case, _) if case.cell.packing == Packing::Square => {
                let problem = format!("the cell {named:?} is packed square, but a coil's law is isotropic across the fibre");
                let remedy = "give a cell of hexagonal packing, or the constants themselves";
                return Err(self.top.fault(field, problem, remedy).into());
            }
            AnyCell::Regular(case, _) => {
                self.compare_pitch(field, named, case.cell.pitch);
                // what is out of range was refused when the file was read
                let masses = [case.cell.density(), case.cell.heat_capacity()].map(|mean| mean.ok().flatten());
                (case.homogenize_to(TOLERANCE)?.constants, masses, case.fingerprint)
            }
        };
        self.masses.push((named.to_owned(), masses));
        self.fingerprints.push(fingerprint);
        self.done.push((path.clone(), constants));
        Ok((path, constants))
    }

    fn compare_pitch(&mut self, field: &str, named: &str, pitch: f64) {
        if (pitch / self.pitch - 1.0).abs() > SAME_PITCH {
            let (cell, winding) = (1e3 * to_mm(pitch), 1e3 * to_mm(self.pitch));
            self.notes.push(Remark::OtherPitch.warning(format!(
                "{field}: the cell {named:?} has a pitch of {cell:.2} um, the winding (winding.pitch_mm) one of {winding:.2} um; is this meant?"
            )));
        }
    }

    /// Warns of a density and a specific heat of the coil that are not those of its cell.
    fn compare_masses(&mut self, design: &Design, tolerances: &Tolerances) {
        for (named, [density, capacity]) in &self.masses {
            let specific_heat = density.zip(*capacity).map(|(density, capacity)| capacity / density);
            for (key, parameter, of_cell) in [
                ("density_kg_per_m3", Parameter::CoilDensity, *density),
                ("specific_heat_j_per_kgk", Parameter::CoilSpecificHeat, specific_heat),
            ] {
                let of_coil = parameter.of(design);
                let sd = tolerances.sd(Number::Constant(parameter), design);
                if let (Some(of_cell), Some(of_coil), Some(sd)) = (of_cell, of_coil, sd)
                    && (of_cell - of_coil).abs() > sd
                {
                    self.notes.push(Remark::OtherMass.warning(format!(
                        "coil.{key} is {of_coil}, that of the cell {named:?} is {of_cell:.1}: more than one standard deviation of its tolerance, \
                         {sd:.1}; is this meant?"
                    )));
                }
            }
        }
    }

    /// The nearest transversely isotropic constants of a general cell, with a note of how far they are, and its density and heat capacity.
    fn nearest(&mut self, field: &str, named: &str, case: &GeneralCase) -> Result<(Constants, [Option<f64>; 2]), Error> {
        if case.temperatures().is_some() {
            let problem = format!("the cell {named:?} has tables over temperature, but a coil has one set of constants");
            let remedy = "give those of one temperature, as `fogcoil homogenize --temperatures` prints them";
            return Err(self.top.fault(field, problem, remedy).into());
        }
        let found = at_temperature(case, None, TOLERANCE)?;
        let far = 100.0 * found.anisotropy;
        let constants = found.nearest.filter(|_| found.anisotropy <= MOST_ANISOTROPY).ok_or_else(|| {
            let most = 100.0 * MOST_ANISOTROPY;
            let problem = format!(
                "the cell {named:?} is not isotropic across the fibre by {far:.2} % of strain energy, more than the {most} % that a \
                 coil's law may leave out"
            );
            let remedy = "take a cell of more fibres, or give the constants themselves: `fogcoil homogenize` prints the nearest";
            self.top.fault(field, problem, remedy)
        })?;
        self.notes.push(Remark::AnisotropicCell.warning(format!(
            "{field}: the cell {named:?} is not isotropic across the fibre by {far:.2} % of strain energy; its mean over all turns about \
             the fibre is taken"
        )));
        Ok((constants, found.heavy))
    }
}
