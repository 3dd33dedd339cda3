//! `fogcoil simulate`: a profile in, thermometer and bias out.

use std::io::{self, Write};

use bias::units::{DEG_PER_H_PER_RAD_PER_S, K_PER_MIN_PER_K_PER_S};
use coil::{Dynamics, ReductionError, Response, STANDARD, SteadySensitivity};

use crate::Error;
use crate::input::{CoilCase, ProfileCase};

/// Columns of the result.
pub const HEADER: &str = "time_s,chamber_c,spool_c,shupe_deg_per_h,eo_axial_deg_per_h,eo_radial_deg_per_h,rate_deg_per_h";

/// Span over which the thermometer is differenced for its rate \[s\]: the interval of the paper's record.
pub const WINDOW_S: f64 = 30.0;
/// How much shorter a window may be, in windows: what clocks of recorders jitter.
const JITTER: f64 = 0.1;

/// A coil modelled for a profile's drives.
#[derive(Debug, Clone)]
pub struct Model {
    dynamics: Dynamics,
    steady: SteadySensitivity,
}

/// What a coil does under a profile.
#[derive(Debug, Clone)]
pub struct Simulation<'a> {
    /// The coil.
    pub case: &'a CoilCase,
    /// The profile.
    pub profile: &'a ProfileCase,
    /// Its steady-ramp sensitivity.
    pub steady: SteadySensitivity,
    /// What the model leaves out.
    pub reduction: ReductionError,
    /// Modes of the model.
    pub modes: usize,
    responses: Vec<Response>,
}

/// One row of the result, in the units of its header; rates are means since the previous row, 0 in the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Instant \[s\].
    pub time: f64,
    /// Chamber \[°C\].
    pub chamber: f64,
    /// Thermometer \[°C\].
    pub spool: f64,
    /// Thermal phase \[deg/h\].
    pub shupe: f64,
    /// Axial strain \[deg/h\].
    pub eo_axial: f64,
    /// Radial strain \[deg/h\].
    pub eo_radial: f64,
    /// The sum of the three \[deg/h\].
    pub rate: f64,
}

/// Rates over the shortest run of whole rows that spans [`WINDOW_S`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Its end \[s\].
    pub time: f64,
    /// Difference of the thermometer over its span \[°C/min\].
    pub spool_rate: f64,
    /// Mean bias \[deg/h\].
    pub rate: f64,
}

/// Models a coil for the drives of a profile.
///
/// # Errors
/// [`Error::Coil`] if the coil cannot be solved.
pub fn model(case: &CoilCase, profile: &ProfileCase) -> Result<Model, Error> {
    let steady = case.steady_sensitivity()?;
    let dynamics = Dynamics::new(&case.design, &profile.drives, &STANDARD);
    Ok(Model { dynamics: dynamics.map_err(|source| Error::Coil { file: case.file.clone(), source })?, steady })
}

/// Runs a profile from rest at its first instant.
///
/// # Errors
/// [`Error::Coil`] if the profile cannot be run; [`Error::NotFinite`] if the model gives no number.
pub fn simulate<'a>(case: &'a CoilCase, profile: &'a ProfileCase, model: &Model) -> Result<Simulation<'a>, Error> {
    let file = || profile.fingerprint.file.clone();
    let responses = model.dynamics.simulate(&profile.profile).map_err(|source| Error::Coil { file: file(), source })?;
    if let Some(row) = responses.iter().position(|r| !(r.sensor.is_finite() && r.bias.total().is_finite())) {
        return Err(Error::NotFinite { file: file(), time: profile.profile.time[row] });
    }
    let (reduction, modes) = (model.dynamics.reduction_error(), model.dynamics.reduced().rates.len());
    Ok(Simulation { case, profile, steady: model.steady, reduction, modes, responses })
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
    pub fn row(&self, n: usize) -> Row {
        let Response { sensor, bias, .. } = self.responses[n];
        let bias = bias * DEG_PER_H_PER_RAD_PER_S;
        Row {
            time: self.profile.profile.time[n],
            chamber: self.profile.chamber()[n],
            spool: sensor,
            shupe: bias.shupe,
            eo_axial: bias.eo_axial,
            eo_radial: bias.eo_radial,
            rate: bias.total(),
        }
    }

    /// All rows.
    pub fn rows(&self) -> impl Iterator<Item = Row> {
        (0..self.count()).map(|n| self.row(n))
    }

    /// From the first to the last instant \[s\].
    pub fn duration(&self) -> f64 {
        self.row(self.count() - 1).time - self.row(0).time
    }

    /// The rows in windows.
    pub fn windows(&self) -> impl Iterator<Item = Window> {
        let (mut start, mut last, mut turned) = (self.row(0), self.row(0), 0.0);
        self.rows().skip(1).filter_map(move |row| {
            turned += row.rate * (row.time - last.time);
            last = row;
            let span = row.time - start.time;
            if span < (1.0 - JITTER) * WINDOW_S {
                return None;
            }
            let spool_rate = (row.spool - start.spool) / span * K_PER_MIN_PER_K_PER_S;
            let window = Window { time: row.time, spool_rate, rate: turned / span };
            (start, turned) = (row, 0.0);
            Some(window)
        })
    }

    /// Writes the result; every number reads back to the same double.
    ///
    /// # Errors
    /// What `out` says.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{HEADER}")?;
        for row in self.rows() {
            let Row { time, chamber, spool, shupe, eo_axial, eo_radial, rate } = row;
            for (i, value) in [time, chamber, spool, shupe, eo_axial, eo_radial, rate].into_iter().enumerate() {
                if i > 0 {
                    out.write_all(b",")?;
                }
                write_number(out, value)?;
            }
            out.write_all(b"\n")?;
        }
        Ok(())
    }
}

/// The shortest text that reads back to the same double; plain between a millionth and a quadrillion.
fn write_number(out: &mut dyn Write, value: f64) -> io::Result<()> {
    let size = value.abs();
    if size == 0.0 {
        out.write_all(b"0")
    } else if (1e-6..1e15).contains(&size) {
        write!(out, "{value}")
    } else {
        write!(out, "{value:e}")
    }
}
