//! Derivatives of every output of a parametric model with respect to its parameters.

use super::model::ParametricModel;
use super::parameter::Parameter;
use super::section::Section;
use crate::{Design, Error, MechanicalState, Outputs, Reduced};
use nalgebra::{DMatrix, DVector};

/// A model at a design with the derivatives of its outputs, ready to run.
#[derive(Debug, Clone)]
pub struct Slopes {
    reduced: Reduced,
    slopes: Vec<Outputs<Slope>>,
}

/// Derivative of an output: of each drive, what it has of the drive itself, of w and of v in every mode, with
/// `ẇ = −λ w + u̇` and `v̇ = −λ v + w`.
#[derive(Debug, Clone)]
struct Slope {
    of_drives: Vec<OfDrive>,
}

#[derive(Debug, Clone)]
struct OfDrive {
    rest: f64,
    once: Vec<f64>,
    twice: Vec<f64>,
}

/// Two rates closer than this, relative to their size, are one: what differences of their modes lose is more than what that leaves out.
const ONE_RATE: f64 = 1e-6;

/// Courses of outputs in time: a value an instant for the model, then for each parameter's derivative.
#[derive(Debug, Clone)]
pub struct Courses {
    /// The outputs.
    pub outputs: Outputs<Vec<f64>>,
    /// Their derivatives, per unit of each parameter in its order.
    pub slopes: Vec<Outputs<Vec<f64>>>,
}

impl Parameter {
    /// A step over which coefficients are differenced: small beside their scale, large beside rounding.
    fn step(self, design: &Design, value: f64) -> f64 {
        match self {
            // the skin's own resistance is the scale
            Self::HubResistance | Self::FlangeResistance(_) => {
                let own = design.spool.as_ref().map_or(1.0, |s| crate::layout::CONTACT_SKIN / s.material.conductivity);
                1e-4 * (value + own)
            }
            Self::Mount(_) | Self::Heater(_) => 1e-4 * (value.abs() + 1.0),
            // what is left of incompressibility is the scale
            Self::TransversePoisson => {
                let e = &design.body.elastic;
                1e-3 * (1.0 - value - 2.0 * e.nu_zr * e.nu_rz())
            }
            Self::AxialPoisson | Self::SpoolPoisson => 1e-4 * value.abs().max(0.1),
            Self::AxialExpansion | Self::TransverseExpansion | Self::SpoolExpansion => 1e-4 * value.abs().max(1e-6),
            _ => 1e-4 * value.abs(),
        }
    }

    /// Designs at which something is evaluated, each with its weight, for the derivative with respect to it.
    fn stencil(self, design: &Design) -> Vec<(Design, f64)> {
        let Some(value) = self.of(design) else { return Vec::new() };
        let h = self.step(design, value);
        let at = |by: f64, weight: f64| (self.set(design, value + by * h), weight / h);
        let one_sided = matches!(self, Self::HubResistance | Self::FlangeResistance(_) | Self::Mount(_)) && value < h;
        if one_sided { vec![at(0.0, -1.5), at(1.0, 2.0), at(2.0, -0.5)] } else { vec![at(-1.0, -0.5), at(1.0, 0.5)] }
    }
}

/// What changes with a parameter, on the reduced fields.
struct Change {
    conduction: DMatrix<f64>,
    storage: DMatrix<f64>,
    heated: DVector<f64>,
    thermometer: DVector<f64>,
    /// of each state
    parts: Vec<[DVector<f64>; 3]>,
}

impl ParametricModel {
    /// The model of a changed design with the derivatives of its outputs with respect to `parameters`, of which the design must have each.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn slopes(&self, design: &Design, parameters: &[Parameter]) -> Result<Slopes, Error> {
        let changed = Section::new(design)?;
        let modes = self.heat.modes(design, &changed, self.heat.size())?;
        let states = design.states().0;
        self.holds(design, &states)?;
        let n = self.heat.size() - 1;
        let mut at = Vec::new();
        for state in &states {
            let solved = self.structure.solved(design, &changed, state, usize::MAX)?;
            at.push(solved);
        }
        let outputs = self.functionals(design, &changed, &states)?;
        let mut slopes = Vec::new();
        for &parameter in parameters {
            let change = self.change(parameter, design, &changed, &states, &at)?;
            let inner = |m: &DMatrix<f64>| modes.shapes.tr_mul(&(m.view((1, 1), (n, n)) * &modes.shapes));
            let (g, h) = (inner(&change.conduction), inner(&change.storage));
            let stored = modes.shapes.tr_mul(&change.storage.column(0).rows(1, n));
            let heated = modes.shapes.tr_mul(&change.heated.rows(1, n));
            let drives = modes.drive.first().map_or(0, Vec::len);
            let of = |output: &DVector<f64>, change: &DVector<f64>| -> Slope {
                let (m, dm) = (modes.shapes.tr_mul(&output.rows(1, n)), modes.shapes.tr_mul(&change.rows(1, n)));
                let of_drive = |d: usize| {
                    let l = |i: usize| modes.drive[i][d];
                    let (mut once, mut twice) = (vec![0.0; n], vec![0.0; n]);
                    let mut rest = if d == 0 { change[0] } else { (0..n).map(|i| dm[i] * l(i)).sum() };
                    for i in 0..n {
                        once[i] -= dm[i] * l(i);
                        let (gl, hl): (f64, f64) =
                            (0..n).fold((0.0, 0.0), |(g0, h0), j| (g0 + g[(i, j)] * l(j), h0 + h[(i, j)] * l(j)));
                        if d == 0 {
                            once[i] += m[i] * (hl - stored[i]);
                        } else {
                            let steady = m[i] * (heated[i] - gl) / modes.rates[i];
                            once[i] -= steady;
                            rest += steady;
                        }
                        for j in 0..n {
                            let a = m[i] * l(j) * (g[(i, j)] - modes.rates[j] * h[(i, j)]);
                            let apart = modes.rates[i] - modes.rates[j];
                            if apart.abs() <= ONE_RATE * modes.rates[i] {
                                twice[i] += a / 2.0;
                                twice[j] += a / 2.0;
                            } else {
                                once[j] += a / apart;
                                once[i] -= a / apart;
                            }
                        }
                    }
                    OfDrive { rest, once, twice }
                };
                Slope { of_drives: (0..drives).map(of_drive).collect() }
            };
            let nothing = DVector::zeros(n + 1);
            let parts =
                outputs.parts.iter().zip(&change.parts).map(|(parts, changes)| [0, 1, 2].map(|p| of(&parts[p], &changes[p])));
            slopes.push(Outputs {
                thermometer: of(&outputs.thermometer, &change.thermometer),
                coil_mean: of(&outputs.coil_mean, &nothing),
                parts: parts.collect(),
            });
        }
        let reduced = outputs.map(|output| modes.output(output));
        Ok(Slopes { reduced: modes.model(reduced), slopes })
    }

    fn change(
        &self,
        parameter: Parameter,
        design: &Design,
        section: &Section,
        states: &[MechanicalState],
        solved: &[super::structure::Solved],
    ) -> Result<Change, Error> {
        let n = self.heat.size();
        let stencil = parameter.stencil(design);
        if stencil.is_empty() {
            return Err(Error::design("parameter", format!("this design has no {parameter:?}")));
        }
        let zero = || DVector::zeros(n);
        let (mut conduction, mut storage) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        let (mut heated, mut thermometer, mut bore) = (zero(), zero(), zero());
        let m = self.turns.hoop.ncols();
        let mut mechanics = vec![(DMatrix::zeros(m, m), DMatrix::zeros(m, n)); states.len()];
        for (of, weight) in &stencil {
            let changed = Section::new(of)?;
            if parameter.of_heat() {
                let (k, c) = self.heat.matrices(of, &changed)?;
                conduction += k * *weight;
                storage += c * *weight;
            }
            heated += self.heat.heated(of, &changed)? * *weight;
            thermometer += self.place(&changed, [of.sensor.radius, of.sensor.y])? * *weight;
            bore += self.bore_value(of, &changed)? * *weight;
            if parameter.of_mechanics() {
                for (state, (a, b)) in states.iter().zip(&mut mechanics) {
                    let [stiffness, load] = self.structure.matrices(of, &changed, state)?;
                    *a += stiffness * *weight;
                    *b += load * *weight;
                }
            }
        }
        let (winding, sums) = self.wound(design)?;
        let _ = section;
        let functionals = self.strain_functionals(design, &sums);
        let (c, w) = (design.optics.coefficients(winding.length())?, winding.tail_weight());
        let tails = &bore * w;
        let parts = solved.iter().zip(&mechanics).map(|(solved, (a, b))| {
            let through = if parameter.of_mechanics() { solved.changed(&functionals, a, b) } else { DMatrix::zeros(n, 2) };
            let free = &tails * design.optics.thermal_expansion;
            let (axial, radial) = (through.column(0) + &free, through.column(1) + free);
            [
                &tails * c.shupe,
                axial * c.axial + &tails * c.axial_per_temperature_rate,
                radial * c.radial + &tails * c.radial_per_temperature_rate,
            ]
        });
        Ok(Change { conduction, storage, heated, thermometer, parts: parts.collect() })
    }
}

impl Slopes {
    /// The model.
    pub fn reduced(&self) -> &Reduced {
        &self.reduced
    }

    /// Runs `courses`, one a drive, at the instants `time` \[s\] from rest with the drives at `rest`: outputs and derivatives at every instant,
    /// in phases \[rad\] for the parts of the bias.
    ///
    /// # Panics
    /// If there is no instant, or a course is shorter than `time`.
    pub fn run(&self, time: &[f64], courses: &[Vec<f64>], rest: &[f64]) -> Courses {
        let (rows, n, drives) = (time.len(), self.reduced.rates().len(), courses.len());
        // columns: of each drive u, then w and v of every mode
        let width = 1 + 2 * n;
        let mut states = DMatrix::zeros(width * drives, rows);
        let mut known: (f64, Vec<[f64; 4]>) = (f64::NAN, Vec::new());
        for (d, course) in courses.iter().enumerate() {
            let (mut w, mut v) = (vec![course[0] - rest[d]; n], vec![0.0; n]);
            for row in 0..rows {
                if row > 0 {
                    let dt = time[row] - time[row - 1];
                    if dt != known.0 {
                        known = (dt, self.reduced.rates().iter().map(|rate| interval(*rate, dt)).collect());
                    }
                    let slope = (course[row] - course[row - 1]) / dt;
                    for ((w, v), [decay, push, twice, of_w]) in w.iter_mut().zip(&mut v).zip(&known.1) {
                        *v = *v * decay + *w * of_w + slope * twice;
                        *w = *w * decay + slope * push;
                    }
                }
                let mut column = states.view_mut((d * width, row), (width, 1));
                column[0] = course[row];
                column.rows_mut(1, n).copy_from_slice(&w);
                column.rows_mut(1 + n, n).copy_from_slice(&v);
            }
        }
        let of_model = self.reduced.outputs().map(|output| {
            let mut of = Vec::with_capacity(width * drives);
            for d in 0..drives {
                of.push(output.at_rest[d]);
                of.extend(output.modal.iter().zip(&self.reduced.drive).map(|(m, l)| -m * l[d]));
                of.extend(std::iter::repeat_n(0.0, n));
            }
            of
        });
        let of_slopes = self.slopes.iter().map(|slope| {
            slope.map(|slope| {
                slope
                    .of_drives
                    .iter()
                    .flat_map(|of| [of.rest].into_iter().chain(of.once.iter().copied()).chain(of.twice.iter().copied()))
                    .collect::<Vec<f64>>()
            })
        });
        let all: Vec<Outputs<Vec<f64>>> = [of_model].into_iter().chain(of_slopes).collect();
        let mut columns = Vec::new();
        for outputs in &all {
            columns.extend([&outputs.thermometer, &outputs.coil_mean].into_iter().chain(outputs.parts.iter().flatten()));
        }
        let weights = DMatrix::from_fn(columns.len(), width * drives, |k, j| columns[k][j]);
        let values = (weights * states).transpose();
        let mut next = values.column_iter().map(|column| column.as_slice().to_vec());
        let mut results = all.iter().map(|outputs| outputs.map(|_| next.next().unwrap_or_default()));
        let outputs = results.next().expect("the model itself comes first");
        Courses { outputs, slopes: results.collect() }
    }
}

/// What an interval does to w and v of a mode: decay, what a slope adds to w and to v, what w adds to v.
fn interval(rate: f64, dt: f64) -> [f64; 4] {
    let x = rate * dt;
    let decay = (-x).exp();
    let push = if x.abs() < 1e-8 { dt } else { -(-x).exp_m1() / rate };
    // (1 − e^−x (1 + x))/rate², by its series where that cancels
    let twice = if x < 1e-3 { dt * dt * (0.5 - x / 3.0 + x * x / 8.0) } else { (1.0 - decay * (1.0 + x)) / (rate * rate) };
    [decay, push, twice, decay * dt]
}
