//! A coil in time: chamber temperature in, thermometer and bias out, through a reduced model of the heat flow.

use crate::mechanics::Blend;
use crate::{
    BiasOperator, Design, Drifts, Drive, Error, MODEL_SAFETY, MechanicalState, MeshFineness, Model, Output, Outputs,
    ParametricModel, Profile, Reduced, Reduction, SectionFields, Steps, ThermalModel, ThermalState, TurnFields,
};
use bias::Bias;
use nalgebra::{DMatrix, DVector};

/// Resolution of a coil's model in time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fidelity {
    /// Mesh of heat flow and mechanics.
    pub resolution: MeshFineness,
    /// Modes of the reduced model for each drive.
    pub modes: usize,
}

/// The mesh and the modes behind a simulation.
pub const STANDARD: Fidelity = Fidelity { resolution: crate::COARSE, modes: 40 };

/// A coarser mesh for a sixth of the time: the distance to it is the estimate of the error of [`STANDARD`].
///
/// An estimate, not a bound: both meshes have the same grading, whose error it does not see. A test holds it against a finer mesh for designs like
/// the reference coil, and `cargo xtask survey`, with what a simulation adds to it, for random ones.
pub const COARSER: Fidelity = Fidelity { resolution: MeshFineness { order: 4, layers: 2, ..STANDARD.resolution }, ..STANDARD };

/// A design ready to be simulated: its thermometer, mean coil temperature and bias parts as a few exponentials.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Dynamics {
    reduced: Reduced,
    error: ReductionError,
    blend: Blend,
    pub(crate) sensor_lag: f64,
    pub(crate) drives: Vec<Drive>,
    drifts: Drifts,
    curvature: Option<Curvature>,
}

/// Phase of a curved ∂n/∂T \[rad\] as a quadratic form of drives and modes.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Curvature {
    form: DMatrix<f64>,
    linear: DVector<f64>,
}

impl Curvature {
    fn new(design: &Design, fields: &TurnFields) -> Result<Self, Error> {
        let winding = winding::wind(&design.winding)?;
        let (form, linear) = fields.moments(&winding);
        // eq. (1) integrated in time with b (T − reference) in place of ∂n/∂T
        let o = &design.optics;
        let scale = design.drifts.thermo_optic_curvature * o.refractive_index / (winding.length() * o.sagnac_diameter);
        Ok(Self { form: form * (scale / 2.0), linear: linear * (-scale * design.drifts.reference) })
    }

    fn phase(&self, state: &ThermalState) -> f64 {
        let state = state.vector();
        state.dot(&(&self.form * &state)) + self.linear.dot(&state)
    }
}

/// A reduced design, its heat flow, the nodal temperatures of its modes, and its nominal mechanics if that is among its states.
type Parts = (Dynamics, ThermalModel, Vec<Vec<f64>>, Option<Model>);

/// Factor on the distance to a smaller model that [`ReductionError`] states: with few modes the error was seen to be up to four
/// times that distance.
pub const REDUCTION_SAFETY: f64 = 4.0;

/// Estimates of the reduction's error, for any course of the drives and readings that are means over a second or more.
///
/// A response to any course is the convolution of the drive's rate with the step response, so a difference of step responses bounds
/// the difference of responses for every course of bounded rate. What is taken is [`REDUCTION_SAFETY`] ([`MODEL_SAFETY`]) times the difference to
/// a model with two thirds of the modes (two models on a part of a parametric model's fields), the worst over these, drives and mechanical states: an
/// estimate, not a bound.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ReductionError {
    /// Thermometer: kelvin per (kelvin per second) of a drive \[s\].
    pub sensor: f64,
    /// Total bias, relative to the largest that a drive of the same largest rate can cause.
    pub bias: f64,
}

impl ReductionError {
    /// The larger of each.
    fn worst(self, other: Self) -> Self {
        Self { sensor: self.sensor.max(other.sensor), bias: self.bias.max(other.bias) }
    }

    fn between(reduced: &Reduced, smaller: &Reduced, drives: usize, safety: f64) -> Self {
        let times: Vec<f64> = [0.0].into_iter().chain(reduced.instants()).collect();
        let variation = |f: &dyn Fn(f64) -> f64| {
            let values: Vec<f64> = times.iter().map(|&t| f(t)).collect();
            values[0].abs() + values.windows(2).map(|w| (w[1] - w[0]).abs()).sum::<f64>()
        };
        let mut worst = Self { sensor: 0.0, bias: 0.0 };
        for drive in 0..drives {
            let thermometer = |model: &Reduced, t: f64| model.step_response(model.thermometer(), drive, t);
            let off = |t: f64| (thermometer(reduced, t) - thermometer(smaller, t)).abs();
            let sensor: f64 = times.windows(2).map(|w| (w[1] - w[0]) * off(w[0]).max(off(w[1]))).sum();
            worst.sensor = worst.sensor.max(safety * sensor);
            for (parts, of_smaller) in reduced.outputs().parts.iter().zip(&smaller.outputs().parts) {
                let bias = |model: &Reduced, parts: &[Output; 3], t: f64| {
                    parts.iter().map(|part| model.step_response(part, drive, t)).sum::<f64>()
                };
                let missing = variation(&|t| bias(reduced, parts, t) - bias(smaller, of_smaller, t));
                worst.bias = worst.bias.max(safety * missing / variation(&|t| bias(reduced, parts, t)));
            }
        }
        worst
    }
}

/// Response of a coil at one instant of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Thermometer \[K or °C, as the profile\].
    pub sensor: f64,
    /// Mean temperature of the coil.
    pub coil: f64,
    /// Mean bias since the previous instant \[rad/s\]; zero at the first.
    pub bias: Bias,
    /// Mean bias of the read-out since the previous instant \[rad/s\].
    pub read_out: f64,
}

impl Response {
    /// Everything that the gyroscope reads as a rate \[rad/s\].
    pub fn rate(&self) -> f64 {
        self.bias.total() + self.read_out
    }
}

/// Outputs of a coil in the mechanical state of `model`, as functionals of the temperature at the nodes of `thermal`'s mesh.
///
/// # Errors
/// [`Error`] names the dimension or property at fault; both models must be made on one [`MeshFineness`].
pub fn functionals(design: &Design, model: &Model, thermal: &ThermalModel) -> Result<Outputs<Vec<f64>>, Error> {
    Ok(Outputs { parts: vec![parts(model, thermal)?], ..temperatures(design, thermal)? })
}

fn temperatures(design: &Design, thermal: &ThermalModel) -> Result<Outputs<Vec<f64>>, Error> {
    let mut thermometer = vec![0.0; thermal.grid().mesh().nodes().len()];
    thermal.grid().probe("sensor", design.sensor.radius, design.sensor.y)?.add_value(&mut thermometer, 1.0);
    Ok(Outputs { thermometer, coil_mean: thermal.grid().coil_mean()?, parts: Vec::new() })
}

fn parts(model: &Model, thermal: &ThermalModel) -> Result<[Vec<f64>; 3], Error> {
    let BiasOperator { shupe, eo_axial, eo_radial } = model.bias_operator()?;
    let shared = model.grid().shared_nodes(thermal.grid())?;
    let embed = |part: Vec<f64>| {
        let mut embedded = vec![0.0; thermal.grid().mesh().nodes().len()];
        // both faces of an opened bond lie at one place
        shared.iter().zip(part).for_each(|(&node, value)| embedded[node] += value);
        embedded
    };
    Ok([shupe, eo_axial, eo_radial].map(embed))
}

impl Dynamics {
    /// Models `design` under `drives`, the first of which must be [`Drive::Chamber`].
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn new(design: &Design, drives: &[Drive], fidelity: &Fidelity) -> Result<Self, Error> {
        Ok(Self::reduce(design, drives, fidelity)?.0)
    }

    /// As [`Self::new`], with the fields at the turns in the nominal mechanical state: every bond holds, nothing has relaxed, factors
    /// are 1.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_fields(design: &Design, drives: &[Drive], fidelity: &Fidelity) -> Result<(Self, TurnFields), Error> {
        Self::with_section(design, drives, fidelity).map(|(dynamics, fields, _)| (dynamics, fields))
    }

    /// As [`Self::with_fields`], and with the fields everywhere in coil and spool, for a [`crate::Section`].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_section(
        design: &Design,
        drives: &[Drive],
        fidelity: &Fidelity,
    ) -> Result<(Self, TurnFields, SectionFields), Error> {
        let (dynamics, thermal, modes, nominal) = Self::reduce(design, drives, fidelity)?;
        let nominal = nominal.map_or_else(|| Model::new(design, &fidelity.resolution), Ok)?;
        let (fields, section) = TurnFields::with_section(&nominal, &thermal, &modes)?;
        Ok((dynamics, fields, section))
    }

    /// Model of a design in a parametric model's box, in milliseconds: driven by the chamber, and by its heaters if it has any. The others stand
    /// on fewer of the model's fields and leave out terms quadratic in temperature; see [`Self::distance`].
    ///
    /// # Errors
    /// As [`ParametricModel::at`].
    pub fn varied(model: &ParametricModel, design: &Design) -> Result<[Self; 3], Error> {
        let drives = if design.heat.heaters.is_empty() { vec![Drive::Chamber] } else { vec![Drive::Chamber, Drive::Heaters] };
        let curvature = if design.drifts.thermo_optic_curvature == 0.0 {
            None
        } else {
            Some(Curvature::new(design, &model.fields(design, &MechanicalState::NOMINAL)?)?)
        };
        let (reduced, [more, fewer]) = (model.at(design)?, model.coarser(design)?);
        let errors = [&more, &fewer].map(|coarser| ReductionError::between(&reduced, coarser, drives.len(), MODEL_SAFETY));
        let error = errors[0].worst(errors[1]);
        let of = |reduced: Reduced, curvature: Option<Curvature>| Self {
            reduced,
            error,
            blend: design.states().1,
            sensor_lag: design.sensor.lag,
            drives: drives.clone(),
            drifts: design.drifts,
            curvature,
        };
        Ok([of(reduced, curvature), of(more, None), of(fewer, None)])
    }

    /// Largest distances of thermometer \[K\] and rate \[rad/s\] from those of others along a profile, without terms quadratic in temperature;
    /// NaN if any value is.
    ///
    /// # Errors
    /// As [`Self::simulate`].
    pub fn distance(&self, others: &[Self], profile: &Profile) -> Result<[f64; 2], Error> {
        let linear = |dynamics: &Self| Self { curvature: None, ..dynamics.clone() }.simulate(profile);
        let (ours, theirs) = (linear(self)?, others.iter().map(linear).collect::<Result<Vec<_>, _>>()?);
        let largest = |of: fn(&Response) -> f64| {
            let apart = theirs.iter().flat_map(|theirs| ours.iter().zip(theirs)).map(|(a, b)| (of(a) - of(b)).abs());
            apart.fold(0.0, |most: f64, d| if d.is_nan() || most.is_nan() { f64::NAN } else { most.max(d) })
        };
        Ok([largest(|r| r.sensor), largest(Response::rate)])
    }

    fn reduce(design: &Design, drives: &[Drive], fidelity: &Fidelity) -> Result<Parts, Error> {
        if fidelity.modes == 0 {
            return Err(Error::Resolution("a reduced model needs at least one mode".into()));
        }
        let thermal = ThermalModel::new(design, &fidelity.resolution, drives)?;
        let (states, blend) = design.states();
        let (mut outputs, mut nominal) = (temperatures(design, &thermal)?, None);
        for state in &states {
            let model = Model::in_state(design, &fidelity.resolution, state)?;
            outputs.parts.push(parts(&model, &thermal)?);
            if *state == MechanicalState::NOMINAL {
                nominal = Some(model);
            }
        }
        let Reduction { reduced, smaller, modes } = Reduction::new(&thermal, &outputs, fidelity.modes * drives.len())?;
        let error = ReductionError::between(&reduced, &smaller, drives.len(), REDUCTION_SAFETY);
        let curvature = if design.drifts.thermo_optic_curvature == 0.0 {
            None
        } else {
            if nominal.is_none() {
                nominal = Some(Model::new(design, &fidelity.resolution)?);
            }
            let fields = nominal.as_ref().map(|model| TurnFields::new(model, &thermal, &modes)).transpose()?;
            fields.map(|fields| Curvature::new(design, &fields)).transpose()?
        };
        let dynamics = Self {
            reduced,
            error,
            blend,
            sensor_lag: design.sensor.lag,
            drives: drives.to_vec(),
            drifts: design.drifts,
            curvature,
        };
        Ok((dynamics, thermal, modes, nominal))
    }

    /// Estimate of the error of the reduction.
    pub fn reduction_error(&self) -> ReductionError {
        self.error
    }

    /// The reduced model.
    pub fn reduced(&self) -> &Reduced {
        &self.reduced
    }

    /// Drives and modes along a profile from rest at its first instant: heaters, if any, are off before it. [`TurnFields::at`] makes
    /// fields of them.
    ///
    /// # Errors
    /// [`Error::Profile`] names the instant that is out of order or not finite.
    pub fn steps<'a>(&'a self, profile: &'a Profile) -> Result<Steps<'a>, Error> {
        profile.check(self.drives.len())?;
        Ok(self.reduced.steps(&profile.time, &profile.drives, &profile.rest(&self.drives)))
    }

    /// Runs a profile from rest at its first instant, as [`Self::steps`].
    ///
    /// # Errors
    /// As [`Self::steps`].
    pub fn simulate(&self, profile: &Profile) -> Result<Vec<Response>, Error> {
        let mut steps = self.steps(profile)?;
        let read = |state: &ThermalState| self.reduced.outputs().map(|output| output.of(state));
        let curved = |state: &ThermalState| self.curvature.as_ref().map_or(0.0, |c| c.phase(state));
        // the read-out's temperature is that of the thermometer's place, whatever the thermometer's lag
        let read_out = |mean: f64| self.drifts.read_out * (mean - self.drifts.reference);
        let (mut now, mut curved_now) = (read(steps.state()), curved(steps.state()));
        let mut sensor = now.thermometer;
        let mut rows = vec![Response { sensor, coil: now.coil_mean, bias: Bias::ZERO, read_out: read_out(sensor) }];
        let (thermometer, mut blend) = (self.reduced.thermometer(), self.blend.clone());
        while let Some(step) = steps.next() {
            let before = std::mem::replace(&mut now, read(steps.state()));
            let curved_before = std::mem::replace(&mut curved_now, curved(steps.state()));
            sensor = match self.sensor_lag {
                0.0 => now.thermometer,
                lag => self.reduced.lagged(thermometer, &step, lag, sensor),
            };
            let rates = now.parts.iter().zip(&before.parts).map(|(a, b)| [0, 1, 2].map(|p| (a[p] - b[p]) / step.dt));
            let [shupe, eo_axial, eo_radial] = blend.rates(&rates.collect::<Vec<_>>(), before.coil_mean, now.coil_mean, step.dt);
            let bias = Bias { shupe: shupe + (curved_now - curved_before) / step.dt, eo_axial, eo_radial };
            let read_out = read_out(self.reduced.mean(thermometer, &step));
            rows.push(Response { sensor, coil: now.coil_mean, bias, read_out });
        }
        Ok(rows)
    }
}
