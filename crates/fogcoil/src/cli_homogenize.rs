//! `fogcoil homogenize`: its arguments, and which route a cell takes.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::homogenize::{self, Quantity, Strains, general, parse_load, parse_quantity};
use fogcoil::input::{self, AnyCell, AtTemperature, CellCase, GeneralCase, InputError, at_temperature};
use fogcoil::output::{self, Content};
use fogcoil::{Error, picture_cell};
use homogenization::fields::{Fields, Load};
use homogenization::irregular::Solution;
use serde_json::{Value, json};

use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Homogenize {
    /// Case file of the cell
    #[arg(value_name = "CELL.ron")]
    cell: PathBuf,
    /// Relative error that every constant must meet
    #[arg(long, value_name = "ERROR", default_value = "1e-6", value_parser = relative_error, allow_negative_numbers = true)]
    tolerance: f64,
    /// Print one JSON object, in SI
    #[arg(long)]
    json: bool,
    /// Temperatures in degC at which to take constituents that are tables, e.g. -40,20,70
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true, value_parser = celsius)]
    temperatures: Vec<f64>,
    /// Total macroscopic strains and temperature change, e.g. exx=1e-4,dt=10 (also eyy, ezz, gyz, gxz, gxy): strains of each phase
    #[arg(long, value_name = "LOAD", value_parser = parse_load)]
    load: Option<Load>,
    /// Write all fields under the load here, for ParaView
    #[arg(long, value_name = "FILE", requires = "load")]
    vtu: Option<PathBuf>,
    /// Draw the cell and its mesh here
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Field under the load to draw: xx, mean_radial, radial, hoop, mechanical_xx, stress_xx, von_mises and so on
    #[arg(long, value_name = "NAME", requires_all = ["svg", "load"], value_parser = parse_quantity)]
    field: Option<Quantity>,
}

/// Divisions of an element's side where a field is drawn.
const FINE: usize = 12;
/// Divisions where the mesh is.
const COARSE: usize = 6;
/// Least tolerance for the fields inside a regular cell, whose constants are not taken from them.
const INSIDE: f64 = 1e-6;

fn celsius(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|t: &f64| (-273.15..=1000.0).contains(t));
    number.ok_or_else(|| "give degC from -273.15 to 1000, e.g. -40,20,70".into())
}

fn relative_error(text: &str) -> Result<f64, String> {
    let value = text.parse().map_err(|_| "not a number; give a relative error, e.g. 1e-6".to_owned())?;
    if value > 0.0 && value < 1.0 { Ok(value) } else { Err("must be greater than 0 and less than 1, e.g. 1e-6".to_owned()) }
}

pub(crate) fn run(arguments: &Homogenize, progress: &Progress) -> Result<(), Error> {
    let Homogenize { cell, json, temperatures, vtu, svg, .. } = arguments;
    progress.reads(std::slice::from_ref(cell), &[vtu.as_deref(), svg.as_deref()])?;
    let any = input::read_any_cell(cell)?;
    progress.tell(any.untold().map(|note| note.at(cell)).as_slice());
    let has_tables = matches!(&any, AnyCell::General(general) if general.temperatures().is_some());
    if !temperatures.is_empty() && !has_tables {
        let problem = "no constituent is a table over temperature: the constants are the same at all";
        return Err(Error::usage(format!("{}: {problem}; leave --temperatures out", files::shown_path(cell))));
    }
    let (text, object) = match any {
        AnyCell::Regular(case, general) => arguments.regular(&case, general, progress)?,
        AnyCell::General(general) => arguments.general(&general, progress)?,
    };
    print(&if *json { line(&object) } else { text })
}

impl Homogenize {
    /// A regular cell: by the structured route, its fields by the other.
    fn regular(
        &self,
        case: &CellCase,
        general: Result<GeneralCase, InputError>,
        progress: &Progress,
    ) -> Result<(String, Value), Error> {
        let result = progress.during("homogenizing the cell", || case.homogenize_to(self.tolerance))?;
        let (mut text, mut object) = (homogenize::text(case, &result), homogenize::json(case, &result));
        if self.load.is_some() || self.svg.is_some() {
            let general = general?;
            let cell = general.cell(&general.layouts[0], None)?;
            let failed = |source| files::Error::Homogenization { file: general.file.clone(), source };
            let solve = || cell.homogenize_to(self.tolerance.max(INSIDE)).map_err(failed);
            let solution = progress.during("solving for the fields inside", solve)?.solution;
            self.inside(&general, None, &solution, (&mut text, &mut object), progress)?;
        }
        Ok((text, object))
    }

    fn general(&self, case: &GeneralCase, progress: &Progress) -> Result<(String, Value), Error> {
        let wanted: Vec<Option<f64>> =
            if self.temperatures.is_empty() { vec![None] } else { self.temperatures.iter().copied().map(Some).collect() };
        // all tables are asked before anything is solved
        wanted.iter().try_for_each(|t| case.cell(&case.layouts[0], *t).map(drop))?;
        let task = match wanted.len() * case.layouts.len() {
            1 => "homogenizing the cell".to_owned(),
            cells => format!("homogenizing {cells} cells"),
        };
        let solve = || wanted.iter().map(|t| at_temperature(case, *t, self.tolerance)).collect::<Result<Vec<AtTemperature>, _>>();
        let results = progress.during(&task, solve)?;
        let (mut texts, mut objects) = (Vec::new(), Vec::new());
        for (k, result) in results.iter().enumerate() {
            let (mut text, mut object) = (general::text(result, case), general::json(result));
            if k == 0 && (self.load.is_some() || self.svg.is_some()) {
                self.inside(case, result.celsius, &result.first.solution, (&mut text, &mut object), progress)?;
            }
            texts.push(text);
            objects.push(object);
        }
        let object = if self.temperatures.is_empty() { objects.remove(0) } else { json!({ "temperatures": objects }) };
        Ok((texts.join("\n"), object))
    }

    /// Strains, picture and fields of the first temperature and realisation.
    fn inside(
        &self,
        case: &GeneralCase,
        celsius: Option<f64>,
        solution: &Solution,
        (text, object): (&mut String, &mut Value),
        progress: &Progress,
    ) -> Result<(), Error> {
        if let Some(load) = self.load {
            let failed = |source| files::Error::Homogenization { file: case.file.clone(), source };
            let strains = Strains::new(solution, load).map_err(failed)?;
            *text += &format!("\n{}", strains.text());
            object["strains"] = strains.json();
        }
        if self.svg.is_some() && self.load.is_some() && self.field.is_none() {
            progress.note("the picture shows phases and mesh; add --field NAME, e.g. --field radial, for a field under the load");
        }
        let at = celsius.map_or(String::new(), |t| format!(" at {t} degC"));
        let caption = match (self.field, &self.load) {
            (Some(quantity), Some(load)) => format!("{} under {}{at}", quantity.label(), homogenize::words(load)),
            _ => "phases and mesh".into(),
        };
        let fields = Fields::new(solution, self.load.unwrap_or_default());
        let sample = fields.sample(if self.field.is_some() { FINE } else { COARSE });
        let grid = |out: &mut dyn Write| output::vtu(out, &sample, &solution.periodic.inclusions);
        let mut files: Vec<(&Path, Content)> = Vec::new();
        if let Some(path) = &self.svg {
            files.push((path, Content::Text(picture_cell::svg(&case.name, &caption, solution, &sample, self.field))));
        }
        files.extend(self.vtu.as_deref().map(|path| (path, Content::Written(&grid))));
        progress.save(&files)
    }
}
