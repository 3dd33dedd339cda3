//! `fogcoil simulate`: a profile in, thermometer and bias out.

mod design_box;
mod infer;
mod model;
mod rows;
mod run;
mod samples;

use std::io::{self, Write};

use coil::{ReductionError, Response, SteadySensitivity};
use files::{Note, Remark};

pub use design_box::{DesignBox, Varied};
pub use infer::infer;
pub use model::{Fields, Model, model, model_with_fields};
pub use rows::{COLUMNS, Column, SimulatedRow, WINDOW_S, Window};
pub(crate) use rows::{number, windowed};
use run::{ABSOLUTE_ZERO_C, HOTTEST_C, course, is_possible, run};
pub(crate) use samples::{MOST_FRAMES, Sample};

use crate::Error;
use crate::cache::Source;
use crate::input::{CoilCase, ProfileCase};
use crate::tabular::{self, Table};

/// Response of a coil to a profile.
#[derive(Debug, Clone)]
pub struct Simulation<'a> {
    /// The coil.
    pub case: &'a CoilCase,
    /// The profile.
    pub profile: &'a ProfileCase,
    /// Its steady-ramp sensitivity.
    pub steady: SteadySensitivity,
    /// Errors of the reduction.
    pub reduction: ReductionError,
    /// Modes of the model.
    pub modes: usize,
    /// Whether the model was built or found in the cache.
    pub source: Source,
    responses: Vec<Response>,
    /// The same response on a coarser mesh.
    coarser: Vec<Response>,
    /// States at instants evenly spaced over the course; none if it has no duration.
    pub(crate) samples: Vec<Sample>,
    /// Fewer states, with both ends; one if it has no duration.
    pub(crate) frames: Vec<Sample>,
    /// contribution of mechanisms to thermometer \[K\] and rate \[deg/h\] in every row; none without mechanisms
    pub(crate) added: Vec<[f64; 2]>,
}

/// Runs a profile from rest at its first instant.
///
/// # Errors
/// [`files::Error::Coil`] if the profile cannot be run; [`Error::NotFinite`] if the model gives no number.
pub fn simulate<'a>(case: &'a CoilCase, profile: &'a ProfileCase, model: &Model) -> Result<Simulation<'a>, Error> {
    let (responses, coarser) = (run(&model.dynamics, profile)?, run(&model.coarser, profile)?);
    let course = course(profile);
    let at = |instants: &[f64]| {
        samples::samples(&model.dynamics, &course, instants).map_err(Error::of_coil(&profile.fingerprint.file))
    };
    let (samples, frames) = (at(&samples::middles(&course.time))?, at(&samples::frames(&course.time))?);
    let (reduction, modes) = (model.dynamics.reduction_error(), model.dynamics.reduced().rates().len());
    Ok(Simulation {
        case,
        profile,
        steady: model.steady,
        reduction,
        modes,
        source: model.source,
        responses,
        coarser,
        samples,
        frames,
        added: Vec::new(),
    })
}

/// A table of rows, with the [`COLUMNS`].
pub fn table(rows: &[SimulatedRow]) -> Table {
    tabled(COLUMNS.into_iter(), rows)
}

fn tabled(columns: impl Iterator<Item = Column>, rows: &[SimulatedRow]) -> Table {
    let cell = |value: f64| (!value.is_nan()).then_some(value);
    let column = |(name, of): Column| tabular::Column::numbers(name, rows.iter().map(|row| cell(of(row))).collect());
    Table { columns: columns.map(column).collect(), about: Vec::new() }
}

impl Simulation<'_> {
    /// Number of rows; at least one.
    pub fn count(&self) -> usize {
        self.responses.len()
    }

    /// A row.
    ///
    /// # Panics
    /// If `n` is not less than [`Simulation::count`].
    pub fn row(&self, n: usize) -> SimulatedRow {
        self.row_of(n, self.responses[n])
    }

    fn row_of(&self, n: usize, response: Response) -> SimulatedRow {
        let row = SimulatedRow::of(self.profile, n, response);
        match self.added.get(n) {
            Some([spool, rate]) => SimulatedRow { spool: row.spool + spool, mechanisms: *rate, rate: row.rate + rate, ..row },
            None => row,
        }
    }

    /// Differences of the rows from those on a coarser mesh; an estimate of the mesh's error.
    pub fn differences(&self) -> impl Iterator<Item = SimulatedRow> {
        let difference = |(row, other): (SimulatedRow, SimulatedRow)| SimulatedRow {
            spool: row.spool - other.spool,
            shupe: row.shupe - other.shupe,
            eo_axial: row.eo_axial - other.eo_axial,
            eo_radial: row.eo_radial - other.eo_radial,
            read_out: row.read_out - other.read_out,
            rate: row.rate - other.rate,
            ..row
        };
        self.rows().zip(self.coarser_rows()).map(difference)
    }

    fn coarser_rows(&self) -> impl Iterator<Item = SimulatedRow> {
        self.coarser.iter().enumerate().map(|(n, response)| self.row_of(n, *response))
    }

    /// All rows.
    pub fn rows(&self) -> impl Iterator<Item = SimulatedRow> {
        (0..self.count()).map(|n| self.row(n))
    }

    /// Duration from the first to the last instant \[s\].
    pub fn duration(&self) -> f64 {
        self.row(self.count() - 1).time - self.row(0).time
    }

    /// A warning of a thermometer outside what profiles may hold.
    pub fn warning(&self) -> Option<Note> {
        let row = self.rows().find(|row| !is_possible(row.spool))?;
        let text = format!(
            "spool_c is {:.0} degC at {:.0} s, outside {ABSOLUTE_ZERO_C} to {HOTTEST_C} degC; check heat.heaters and the profile",
            row.spool, row.time
        );
        Some(Remark::ImpossibleResult.warning(text).at(&self.case.file))
    }

    /// The rows in windows.
    pub fn windows(&self) -> impl Iterator<Item = Window> {
        windowed(self.row(0), self.rows().skip(1))
    }

    /// The rows on a coarser mesh in windows.
    pub fn coarser_windows(&self) -> impl Iterator<Item = Window> {
        windowed(self.row(0), self.coarser_rows().skip(1))
    }

    /// Names of the result's columns, and the value of each in a row.
    fn columns(&self) -> impl Iterator<Item = Column> {
        const READ_OUT: Column = ("read_out_deg_per_h", |row| row.read_out);
        const OWN: Column = ("mechanisms_deg_per_h", |row| row.mechanisms);
        const RECORDED: [Column; 2] =
            [("recorded_spool_c", |row| row.recorded[0]), ("recorded_rate_deg_per_h", |row| row.recorded[1])];
        let read_out = (self.case.design.drifts.read_out != 0.0).then_some(READ_OUT);
        let own = (!self.added.is_empty()).then_some(OWN);
        let recorded = self.profile.recorded.iter().flat_map(|_| RECORDED);
        COLUMNS.into_iter().chain(read_out).chain(own).chain(recorded)
    }

    /// The result as a table.
    pub fn table(&self) -> Table {
        tabled(self.columns(), &self.rows().collect::<Vec<_>>())
    }

    /// Writes the result; every number reads back to the same double.
    ///
    /// # Errors
    /// The error of `out`.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let columns: Vec<Column> = self.columns().collect();
        let line = |of: &dyn Fn(&Column) -> String| columns.iter().map(of).collect::<Vec<_>>().join(",");
        writeln!(out, "{}", line(&|(name, _)| (*name).to_owned()))?;
        self.rows().try_for_each(|row| writeln!(out, "{}", line(&|(_, of)| number(of(&row)))))
    }
}
