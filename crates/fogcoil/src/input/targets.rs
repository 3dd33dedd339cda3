//! Measured effective constants and the cells that might be behind them: `TARGETS.ron`.

use std::path::{Path, PathBuf};

use homogenization::Role;
use homogenization::identify::literature::Kind;
use homogenization::identify::{Family, MaterialPrior, Prior, RingPrior, Target, Uncertainty, Volume};

use super::InputError;
use super::limits::{CONDUCTIVITY, EXPANSION_PER_K, FIBRE_UM, Group, Limit, MODULUS_GPA, MODULUS_MPA, RATIO};
use super::source::Source;
use super::targets_file::{CellPrior, Entries, Entry, KindFile, MaterialFile, RangeFile, TargetsFile};
use crate::units::{from_gpa, from_mpa, from_um};

/// Kinds of cells in one file.
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
/// What is wrong, in which file, line and field, and how to mend it.
pub fn read_targets(path: &Path) -> Result<TargetsCase, InputError> {
    let source = Source::read(path)?;
    let file: TargetsFile = source.parse()?;
    let top = Group::whole(&source);
    let pitch = from_um(top.number("pitch_um", file.pitch_um, &FIBRE_UM)?);
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
    Ok(TargetsCase { file: path.to_owned(), name: file.name, targets, families })
}

/// Key in the file, constant, what the file says, conversion to SI, and what is accepted.
type Row<'a> = (&'a str, &'a str, &'a Entry, fn(f64) -> f64, &'a Limit);

fn entries(at: &Group, file: &Entries) -> Result<Vec<Target>, InputError> {
    let same: fn(f64) -> f64 = |value| value;
    let all: [Row; 12] = [
        ("e_z_gpa", "e_z", &file.e_z_gpa, from_gpa, &MODULUS_GPA),
        ("e_r_mpa", "e_r", &file.e_r_mpa, from_mpa, &MODULUS_MPA),
        ("g_zr_mpa", "g_zr", &file.g_zr_mpa, from_mpa, &MODULUS_MPA),
        ("g_r_mpa", "g_r", &file.g_r_mpa, from_mpa, &MODULUS_MPA),
        ("k_plane_strain_mpa", "k_plane_strain", &file.k_plane_strain_mpa, from_mpa, &MODULUS_MPA),
        ("nu_zr", "nu_zr", &file.nu_zr, same, &RATIO),
        ("nu_r", "nu_r", &file.nu_r, same, &RATIO),
        ("nu_rz", "nu_rz", &file.nu_rz, same, &RATIO),
        ("alpha_z_per_k", "alpha_z", &file.alpha_z_per_k, same, &EXPANSION_PER_K),
        ("alpha_r_per_k", "alpha_r", &file.alpha_r_per_k, same, &EXPANSION_PER_K),
        ("k_z_w_per_mk", "k_z", &file.k_z_w_per_mk, same, &CONDUCTIVITY),
        ("k_r_w_per_mk", "k_r", &file.k_r_w_per_mk, same, &CONDUCTIVITY),
    ];
    let mut targets = Vec::new();
    for (key, name, entry, si, limit) in all {
        let (value, uncertainty) = match entry {
            Entry::Absent => continue,
            Entry::Printed(text) => {
                let remedy = "give the printed number in quotes, e.g. Printed(\"14.5\") or Printed(\"3.36e-6\")";
                let (value, half) = printed(text).ok_or_else(|| at.fault(key, format!("`{text}` is not a number"), remedy))?;
                (value, Uncertainty::Rounded(si(half)))
            }
            Entry::Measured(value, sd) => {
                let remedy = "give the value and its standard deviation in the key's unit, e.g. Measured(14.5, 0.1)";
                if !value.is_finite() {
                    return Err(at.fault(key, format!("the value {value} is not a finite number"), remedy));
                }
                if !(sd.is_finite() && *sd >= value.abs() * FINEST && *sd > 0.0) {
                    let problem = format!("the standard deviation {sd} is not greater than {FINEST} of the value");
                    return Err(at.fault(key, problem, remedy));
                }
                (*value, Uncertainty::Normal(si(*sd)))
            }
        };
        at.number(key, value, limit)?;
        let target = Target::new(name, si(value), uncertainty);
        targets.push(target.ok_or_else(|| at.fault(key, "cannot be a target", "remove it"))?);
    }
    Ok(targets)
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
    for (i, ring) in file.rings.iter().enumerate() {
        let here = at.group(&format!("rings[{i}]"));
        let outer_diameter = range(&here, "outer_diameter_um", ring.outer_diameter_um, &FIBRE_UM, Prior::linear, from_um)?;
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
    let kind = match file.kind {
        KindFile::Silica => Kind::Silica,
        KindFile::SoftPrimary => Kind::SoftPrimary,
        KindFile::HardSecondary => Kind::HardSecondary,
        KindFile::AnyCoating => Kind::AnyCoating,
        KindFile::Adhesive => Kind::Adhesive,
    };
    let mut prior = kind.prior();
    let same: fn(f64) -> f64 = |value| value;
    if let RangeFile::Between(low, high) = file.youngs_modulus_mpa {
        prior.youngs_modulus = range(at, "youngs_modulus_mpa", (low, high), &MODULUS_MPA, Prior::log, from_mpa)?;
    }
    match (file.bulk_modulus_mpa, file.poisson_ratio) {
        (RangeFile::Literature, RangeFile::Literature) => {}
        (RangeFile::Between(low, high), RangeFile::Literature) => {
            prior.volume = Volume::BulkModulus(range(at, "bulk_modulus_mpa", (low, high), &MODULUS_MPA, Prior::log, from_mpa)?);
        }
        (RangeFile::Literature, RangeFile::Between(low, high)) => {
            prior.volume = Volume::PoissonRatio(range(at, "poisson_ratio", (low, high), &RATIO, Prior::linear, same)?);
        }
        _ => {
            return Err(at.fault("poisson_ratio", "is given beside bulk_modulus_mpa", "remove one of the two"));
        }
    }
    if let RangeFile::Between(low, high) = file.thermal_expansion_per_k {
        // a prior for materials that expand on warming: all of a coil's do
        if low <= 0.0 {
            let problem = format!("{low} is not greater than 0");
            return Err(at.fault(
                "thermal_expansion_per_k",
                problem,
                "give a range of positive expansions, e.g. Between(50e-6, 150e-6)",
            ));
        }
        prior.thermal_expansion = range(at, "thermal_expansion_per_k", (low, high), &EXPANSION_PER_K, Prior::log, same)?;
    }
    if let RangeFile::Between(low, high) = file.conductivity_w_per_mk {
        prior.conductivity = range(at, "conductivity_w_per_mk", (low, high), &CONDUCTIVITY, Prior::log, same)?;
    }
    Ok(prior)
}

fn range(
    at: &Group,
    key: &str,
    (low, high): (f64, f64),
    limit: &Limit,
    prior: fn(f64, f64) -> Prior,
    si: fn(f64) -> f64,
) -> Result<Prior, InputError> {
    at.number(key, low, limit)?;
    at.number(key, high, limit)?;
    if low >= high {
        let problem = format!("the range from {low} to {high} is empty");
        return Err(at.fault(key, problem, "give the lower end first; 90 % of the expectation lies inside"));
    }
    Ok(prior(si(low), si(high)))
}
