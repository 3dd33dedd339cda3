//! Measured effective constants and the cells that might be behind them: `TARGETS.ron`.

use std::path::{Path, PathBuf};

use homogenization::Role;
use homogenization::identify::{Family, MaterialPrior, Prior, RingPrior, Target, Uncertainty, Volume};

use super::InputError;
use super::group::Group;
use super::mirror::Mirror;
use super::opened::open;
use super::quantity::{Conductivity, ExpansionPerK, FibreUm, ModulusGpa, ModulusMpa, Quantity, Ratio};
use super::source::{Source, TARGETS};
use super::targets_file::{CellPrior, Entries, Entry, MaterialFile, RangeFile, TargetsFile};

const MOST_CELLS: usize = 6;
/// Rings of a cell to be identified.
const MOST_RINGS: usize = 5;

/// A file of targets that has been read and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetsCase {
    /// The file it was read from.
    pub file: PathBuf,
    /// Its name.
    pub name: String,
    /// The measured constants, SI.
    pub targets: Vec<Target>,
    /// The kinds of cells.
    pub families: Vec<Family>,
}

/// Reads and checks a file of targets.
///
/// # Errors
/// The fault, in which file, line and field, and how to mend it.
pub fn read_targets(path: &Path) -> Result<TargetsCase, InputError> {
    checked(open(path)?)
}

/// Checks targets that are not in a file, with the content of one; messages call them `path`.
///
/// # Errors
/// The fault, in which line and field, and how to mend it.
pub fn check_targets(path: &Path, text: &str) -> Result<TargetsCase, InputError> {
    checked(Source::of(path, text.to_owned()))
}

fn checked(source: Source) -> Result<TargetsCase, InputError> {
    let file: TargetsFile = source.parse(Some(&TARGETS))?;
    let top = Group::whole(&source);
    let pitch = file.pitch_um.model();
    let targets = entries(&top.group("targets"), &file.targets)?;
    if targets.is_empty() {
        return Err(top.fault("targets", "no constant is given", "give at least one, e.g. e_z_gpa: Printed(\"14.5\")"));
    }
    if file.cells.is_empty() || file.cells.len() > MOST_CELLS {
        let problem = format!("{} kinds of cells are given", file.cells.len());
        return Err(top.fault("cells", problem, format!("give 1 to {MOST_CELLS} kinds of cells to try")));
    }
    let cells = file.cells.iter().enumerate().map(|(i, cell)| family(&top.group(&format!("cells[{i}]")), cell, pitch));
    let families = cells.collect::<Result<_, _>>()?;
    Ok(TargetsCase { file: source.path().to_owned(), name: file.name, targets, families })
}

fn entries(at: &Group, file: &Entries) -> Result<Vec<Target>, InputError> {
    // key in the file, constant, what the file says, and its kind
    let all: [(&str, &str, &Entry, Quantity); 12] = [
        ("e_z_gpa", "e_z", &file.e_z_gpa, ModulusGpa::KIND),
        ("e_r_mpa", "e_r", &file.e_r_mpa, ModulusMpa::KIND),
        ("g_zr_mpa", "g_zr", &file.g_zr_mpa, ModulusMpa::KIND),
        ("g_r_mpa", "g_r", &file.g_r_mpa, ModulusMpa::KIND),
        ("k_plane_strain_mpa", "k_plane_strain", &file.k_plane_strain_mpa, ModulusMpa::KIND),
        ("nu_zr", "nu_zr", &file.nu_zr, Ratio::KIND),
        ("nu_r", "nu_r", &file.nu_r, Ratio::KIND),
        ("nu_rz", "nu_rz", &file.nu_rz, Ratio::KIND),
        ("alpha_z_per_k", "alpha_z", &file.alpha_z_per_k, ExpansionPerK::KIND),
        ("alpha_r_per_k", "alpha_r", &file.alpha_r_per_k, ExpansionPerK::KIND),
        ("k_z_w_per_mk", "k_z", &file.k_z_w_per_mk, Conductivity::KIND),
        ("k_r_w_per_mk", "k_r", &file.k_r_w_per_mk, Conductivity::KIND),
    ];
    let mut targets = Vec::new();
    for (key, name, entry, kind) in all {
        let Some((value, uncertainty)) = measured(at, key, entry, &kind)? else { continue };
        let target = Target::new(name, at.number(key, value, &kind)?, uncertainty);
        targets.push(target.ok_or_else(|| at.fault(key, "cannot be a target", "remove it"))?);
    }
    Ok(targets)
}

/// A constant in the file's unit, and its uncertainty in SI; `None` if it is absent.
fn measured(at: &Group, key: &str, entry: &Entry, kind: &Quantity) -> Result<Option<(f64, Uncertainty)>, InputError> {
    match entry {
        Entry::Absent => Ok(None),
        Entry::Printed(text) => {
            let remedy = "give the printed number in quotes, e.g. Printed(\"14.5\") or Printed(\"3.36e-6\")";
            let (value, half) = printed(text).ok_or_else(|| at.fault(key, format!("`{text}` is not a number"), remedy))?;
            Ok(Some((value, Uncertainty::Rounded((kind.si)(half)))))
        }
        Entry::Measured(value, sd) => {
            let problem = if !value.is_finite() {
                format!("the value {value} is not a finite number")
            } else if !(sd.is_finite() && *sd >= value.abs() * FINEST && *sd > 0.0) {
                format!("the standard deviation {sd} is not greater than {FINEST} of the value")
            } else {
                return Ok(Some((*value, Uncertainty::Normal((kind.si)(*sd)))));
            };
            let remedy = "give the value and its standard deviation in the key's unit, e.g. Measured(14.5, 0.1)";
            Err(at.fault(key, problem, remedy))
        }
    }
}

/// Least relative standard deviation: the numerical error is below it.
const FINEST: f64 = 1e-5;

/// A printed number and half a unit of its last digit.
fn printed(text: &str) -> Option<(f64, f64)> {
    let text = text.trim();
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let plain = mantissa.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
    let exponent: i32 = exponent.parse().ok().filter(|e: &i32| e.abs() < 100)?;
    let value: f64 = text.parse().ok().filter(|value: &f64| plain && decimals < 9 && value.is_finite())?;
    Some((value, 0.5 * 10_f64.powi(exponent - i32::try_from(decimals).ok()?)))
}

fn family(at: &Group, file: &CellPrior, pitch: f64) -> Result<Family, InputError> {
    if file.rings.is_empty() || file.rings.len() > MOST_RINGS {
        let problem = format!("{} rings are given", file.rings.len());
        return Err(at.fault("rings", problem, format!("list the fibre's 1 to {MOST_RINGS} rings from the inside out")));
    }
    let mut rings = Vec::new();
    let mut inside = 0.0;
    for (here, ring) in at.each("rings", &file.rings) {
        let (low, high) = (ring.outer_diameter_um.0.0, ring.outer_diameter_um.1.0);
        let outer_diameter = range(&here, "outer_diameter_um", (low, high), &FibreUm::KIND, Prior::linear)?;
        let middle = (outer_diameter.low + outer_diameter.high) / 2.0;
        if middle <= inside || middle >= pitch {
            let problem = "its middle is not between the ring inside it and the pitch";
            return Err(here.fault(
                "outer_diameter_um",
                problem,
                "list the rings from the inside out, all narrower than pitch_um",
            ));
        }
        inside = middle;
        let role = if ring.glass { Role::Glass } else { Role::Coating };
        rings.push(RingPrior {
            name: ring.name.clone(),
            outer_diameter,
            role,
            material: material(&here.group("material"), &ring.material)?,
        });
    }
    if rings.iter().all(|ring| ring.role == Role::Coating) {
        return Err(at.fault("rings[0].glass", "no ring is glass", "mark the fibre's silica with `glass: true`"));
    }
    let adhesive = material(&at.group("adhesive"), &file.adhesive)?;
    let family = Family { name: file.name.clone(), pitch, rings, adhesive };
    let medians = vec![0.0; family.parameters().len()];
    if family.cell(&medians).is_none() {
        let problem = "in the middle of the ranges a Poisson's ratio is not between 0 and 0.5";
        return Err(at.fault("", problem, "a Young's modulus must be less than three times the bulk modulus"));
    }
    Ok(family)
}

fn material(at: &Group, file: &MaterialFile) -> Result<MaterialPrior, InputError> {
    let mut prior = file.kind.model().prior();
    let given = |key: &str, file: RangeFile, kind: Quantity, prior: fn(f64, f64) -> Prior| match file {
        RangeFile::Literature => Ok(None),
        RangeFile::Between(low, high) => range(at, key, (low, high), &kind, prior).map(Some),
    };
    let modulus = given("youngs_modulus_mpa", file.youngs_modulus_mpa, ModulusMpa::KIND, Prior::log)?;
    prior.youngs_modulus = modulus.unwrap_or(prior.youngs_modulus);
    let bulk = given("bulk_modulus_mpa", file.bulk_modulus_mpa, ModulusMpa::KIND, Prior::log)?;
    let ratio = given("poisson_ratio", file.poisson_ratio, Ratio::KIND, Prior::linear)?;
    match (bulk, ratio) {
        (None, None) => {}
        (Some(bulk), None) => prior.volume = Volume::BulkModulus(bulk),
        (None, Some(ratio)) => prior.volume = Volume::PoissonRatio(ratio),
        _ => return Err(at.fault("poisson_ratio", "is given beside bulk_modulus_mpa", "remove one of the two")),
    }
    // a prior for materials that expand on warming: all of a coil's do
    if let RangeFile::Between(low, _) = file.thermal_expansion_per_k
        && low <= 0.0
    {
        let remedy = "give a range of positive expansions, e.g. Between(50e-6, 150e-6)";
        return Err(at.fault("thermal_expansion_per_k", format!("{low} is not greater than 0"), remedy));
    }
    let expansion = given("thermal_expansion_per_k", file.thermal_expansion_per_k, ExpansionPerK::KIND, Prior::log)?;
    prior.thermal_expansion = expansion.unwrap_or(prior.thermal_expansion);
    let conductivity = given("conductivity_w_per_mk", file.conductivity_w_per_mk, Conductivity::KIND, Prior::log)?;
    prior.conductivity = conductivity.unwrap_or(prior.conductivity);
    Ok(prior)
}

/// A prior in SI from a range in the file's unit.
fn range(
    at: &Group,
    key: &str,
    (low, high): (f64, f64),
    kind: &Quantity,
    prior: fn(f64, f64) -> Prior,
) -> Result<Prior, InputError> {
    let ends = [at.number(key, low, kind)?, at.number(key, high, kind)?];
    if low >= high {
        let problem = format!("the range from {low} to {high} is empty");
        return Err(at.fault(key, problem, "give the lower end first; 90 % of the expectation lies inside"));
    }
    Ok(prior(ends[0], ends[1]))
}
