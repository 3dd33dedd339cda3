//! Derivatives of every output of a parametric model with respect to its parameters.

use super::heat::Modes;
use super::model::ParametricModel;
use super::parameter::Parameter;
use super::section::Section;
use super::structure::Solved;
use super::turns::{Fibre, Weighted};
use crate::{Design, Error, MechanicalState, Outputs, Reduced};
use fem_core::dense::{product, transposed_product};
use nalgebra::{DMatrix, DVector};

/// A model at a design with the derivatives of its outputs, ready to run.
#[derive(Debug, Clone)]
pub struct Slopes {
    reduced: Reduced,
    slopes: Vec<Outputs<Slope>>,
}

/// Derivative of an output: for each drive, its coefficients on the drive itself, on w and on v in every mode, with
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

/// Two rates closer than this, relative to their size, are one: differences of their modes lose more digits than that leaves out.
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
            // strain jumps by its error from element to element: wide beside that, and every turn in the coil
            Self::WindingStart | Self::WindingEnd => (0.1 * design.winding.pitch).min(self.axial_room(design) / 2.0),
            _ => 1e-4 * value.abs(),
        }
    }

    /// Designs with their sections at which something is evaluated, each with its weight, for the derivative with respect to it.
    fn stencil(self, design: &Design) -> Result<Vec<(f64, Design, Section)>, Error> {
        let value = self.of(design).ok_or_else(|| Error::design("parameter", format!("this design has no {self:?}")))?;
        let h = self.step(design, value);
        let one_sided = matches!(self, Self::HubResistance | Self::FlangeResistance(_) | Self::Mount(_)) && value < h;
        let weights: &[(f64, f64)] =
            if one_sided { &[(0.0, -1.5), (1.0, 2.0), (2.0, -0.5)] } else { &[(-1.0, -0.5), (1.0, 0.5)] };
        let at = |(by, weight): &(f64, f64)| {
            let design = self.set(design, value + by * h);
            let section = Section::new(&design)?;
            Ok((weight / h, design, section))
        };
        weights.iter().map(at).collect()
    }
}

/// Changes with a parameter, on the reduced fields.
struct Change {
    /// conductivity and capacity
    heat: [Option<DMatrix<f64>>; 2],
    heated: DVector<f64>,
    /// outputs' own, beside that of the temperature
    outputs: Outputs<DVector<f64>>,
}

/// A design's mechanics in one state, with the adjoints of the strains.
struct Strained {
    solved: Solved,
    adjoint: DMatrix<f64>,
}

/// Modes of a design with what makes derivatives of them.
struct Modal {
    modes: Modes,
    /// outputs' values on the modes, one a column
    outputs: DMatrix<f64>,
    /// one over the difference of two rates, 0 where they are one
    apart: DMatrix<f64>,
    /// pairs of modes whose rates are one
    together: Vec<(usize, usize)>,
}

/// Values on all fields but the constant one, one output a column.
fn inner(outputs: &Outputs<DVector<f64>>, n: usize) -> DMatrix<f64> {
    DMatrix::from_columns(&outputs.iter().map(|output| output.rows(1, n)).collect::<Vec<_>>())
}

impl Modal {
    fn new(modes: Modes, outputs: &Outputs<DVector<f64>>) -> Self {
        let n = modes.rates.len();
        let one = |i: usize, j: usize| (modes.rates[i] - modes.rates[j]).abs() <= ONE_RATE * modes.rates[i];
        let apart = |i, j| if one(i, j) { 0.0 } else { 1.0 / (modes.rates[i] - modes.rates[j]) };
        let apart = DMatrix::from_fn(n, n, apart);
        let together = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).filter(|&(i, j)| one(i, j)).collect();
        let outputs = transposed_product(&modes.shapes, &inner(outputs, n));
        Self { modes, outputs, apart, together }
    }

    /// Derivatives of all outputs with a change.
    fn slopes(&self, change: &Change) -> Outputs<Slope> {
        let Self { modes, outputs, .. } = self;
        let n = modes.rates.len();
        let onto = |m: &Option<DMatrix<f64>>| {
            let m = m.as_ref()?.view((1, 1), (n, n)).into_owned();
            Some(transposed_product(&modes.shapes, &product(&m, &modes.shapes)))
        };
        let [conduction, storage] = change.heat.each_ref().map(onto);
        let on_modes = |field: DVector<f64>| modes.shapes.tr_mul(&field.rows(1, n));
        let stored = change.heat[1].as_ref().map(|c| on_modes(c.column(0).into_owned()));
        let heated = on_modes(change.heated.clone());
        let moved = transposed_product(&modes.shapes, &inner(&change.outputs, n));
        let mut slopes = change.outputs.map(|_| Slope { of_drives: Vec::new() });
        for d in 0..modes.drive.first().map_or(0, Vec::len) {
            let drive = DVector::from_iterator(n, modes.drive.iter().map(|drives| drives[d]));
            // what one mode drives in another
            let mut across = DMatrix::zeros(n, n);
            if let Some(conduction) = &conduction {
                across += conduction;
            }
            if let Some(storage) = &storage {
                storage
                    .column_iter()
                    .zip(across.column_iter_mut())
                    .zip(&modes.rates)
                    .for_each(|((h, mut a), rate)| a -= h * *rate);
            }
            across.column_iter_mut().zip(drive.iter()).for_each(|(mut column, l)| column *= *l);
            // what each mode's own part changes by at once, and what is at rest
            let mut at_once = DVector::zeros(n);
            let mut steady = DVector::zeros(n);
            if d == 0 {
                at_once += storage.as_ref().map_or(DVector::zeros(n), |h| h * &drive);
                at_once -= stored.as_ref().unwrap_or(&DVector::zeros(n));
            } else {
                let flow = &heated - conduction.as_ref().map_or(DVector::zeros(n), |g| g * &drive);
                steady = DVector::from_fn(n, |i, _| flow[i] / modes.rates[i]);
                at_once -= &steady;
            }
            let apart = across.component_mul(&self.apart);
            let from_others = apart.column_sum();
            let to_others = transposed_product(&apart, outputs);
            for (k, (slope, change)) in slopes.iter_mut().zip(change.outputs.iter()).enumerate() {
                let (m, dm) = (outputs.column(k), moved.column(k));
                let once = m.component_mul(&(&at_once - &from_others)) - dm.component_mul(&drive) + to_others.column(k);
                let mut twice = vec![0.0; n];
                for &(i, j) in &self.together {
                    let half = m[i] * across[(i, j)] / 2.0;
                    twice[i] += half;
                    twice[j] += half;
                }
                let rest = if d == 0 { change[0] } else { dm.dot(&drive) + m.dot(&steady) };
                slope.of_drives.push(OfDrive { rest, once: once.as_slice().to_vec(), twice });
            }
        }
        slopes
    }
}

impl ParametricModel {
    /// The model of a changed design, on all of its modes, with the derivatives of its outputs with respect to `parameters`, each of which must
    /// have a range; a heater that is off is no drive, and its derivative 0.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn slopes(&self, design: &Design, parameters: &[Parameter]) -> Result<Slopes, Error> {
        let states = design.states().0;
        self.holds(design, &states)?;
        if let Some(fixed) = parameters.iter().find(|p| self.ranges.iter().all(|range| range.parameter != **p)) {
            return Err(Error::design("parameter", format!("{fixed:?} has no range in this model")));
        }
        let changed = Section::new(design)?;
        let fibre = self.fibre(design)?;
        let functionals = self.strain_functionals(design, &fibre.sums);
        let bore = self.bore_value(design, &changed)?;
        let strained = states.iter().map(|state| {
            let solved = self.structure.solved(design, &changed, state, usize::MAX)?;
            let adjoint = solved.adjoint(&functionals);
            Ok(Strained { solved, adjoint })
        });
        let strained = strained.collect::<Result<Vec<_>, Error>>()?;
        let parts = strained.iter().map(|s| self.parts(design, &fibre, &bore, &s.solved.through(&s.adjoint)));
        let outputs = Outputs {
            thermometer: self.place(&changed, [design.sensor.radius, design.sensor.y])?,
            coil_mean: self.coil_mean.clone(),
            parts: parts.collect::<Result<_, _>>()?,
        };
        let modes = self.heat.system(design, &changed, self.heat.size())?.all_modes()?;
        let reduced = outputs.map(|output| modes.output(output));
        let modal = Modal::new(modes, &outputs);
        let slopes = parameters
            .iter()
            .map(|&parameter| Ok(modal.slopes(&self.change(parameter, design, &changed, &fibre, &states, &strained)?)));
        let slopes = slopes.collect::<Result<_, Error>>()?;
        Ok(Slopes { reduced: modal.modes.model(reduced), slopes })
    }

    fn change(
        &self,
        parameter: Parameter,
        design: &Design,
        section: &Section,
        fibre: &Fibre,
        states: &[MechanicalState],
        strained: &[Strained],
    ) -> Result<Change, Error> {
        let n = self.heat.size();
        let stencil = parameter.stencil(design)?;
        let (mut heated, mut thermometer, mut bore) = (DVector::zeros(n), DVector::zeros(n), DVector::zeros(n));
        for (weight, of, changed) in &stencil {
            heated += self.heat.heated(of, changed)? * *weight;
            if changed != section {
                thermometer += self.place(changed, [of.sensor.radius, of.sensor.y])? * *weight;
                bore += self.bore_value(of, changed)? * *weight;
            }
        }
        // turns elsewhere weigh the same fields otherwise, tails do not
        let moved = if parameter.of_winding() {
            let fibres = stencil.iter().map(|(_, of, _)| self.fibre(of)).collect::<Result<Vec<_>, _>>()?;
            let terms: Vec<(f64, &Weighted)> = stencil.iter().zip(&fibres).map(|((w, ..), fibre)| (*w, &fibre.sums)).collect();
            Some(Fibre { length: fibre.length, tail_weight: 0.0, sums: Weighted::combined(&terms) })
        } else {
            None
        };
        let heat = if parameter.of_heat() { self.heat.change(&stencil)? } else { [None, None] };
        let (c, tails) = (design.optics.coefficients(fibre.length)?, &bore * fibre.tail_weight);
        let free = &tails * design.optics.thermal_expansion;
        let mut parts = Vec::new();
        for (state, Strained { solved, adjoint }) in states.iter().zip(strained) {
            if let Some(moved) = &moved {
                let through = solved.through(&solved.adjoint(&self.strain_functionals(design, &moved.sums)));
                parts.push(self.parts(design, moved, &bore, &through)?);
                continue;
            }
            let through = if parameter.of_mechanics() {
                solved.changed(adjoint, &self.structure.change(&stencil, state)?)
            } else {
                DMatrix::zeros(n, 2)
            };
            let (axial, radial) = (through.column(0) + &free, through.column(1) + &free);
            parts.push([
                &tails * c.shupe,
                axial * c.axial + &tails * c.axial_per_temperature_rate,
                radial * c.radial + &tails * c.radial_per_temperature_rate,
            ]);
        }
        Ok(Change { heat, heated, outputs: Outputs { thermometer, coil_mean: DVector::zeros(n), parts } })
    }
}

impl Slopes {
    /// The model.
    pub fn reduced(&self) -> &Reduced {
        &self.reduced
    }

    /// Runs `courses`, one a drive, at the instants `time` \[s\] from rest with the drives at `rest`: outputs and derivatives at every instant,
    /// in phases \[rad\] for the parts of the bias. A drive without a course stays at 0, a course without a drive does nothing.
    ///
    /// # Panics
    /// If there is no instant, or a course is shorter than `time`.
    pub fn run(&self, time: &[f64], courses: &[Vec<f64>], rest: &[f64]) -> Courses {
        // a few instants at once: their states stay near, and the outputs are a product of matrices
        const AT_ONCE: usize = 128;
        let courses = &courses[..self.reduced.thermometer().at_rest.len().min(courses.len())];
        let (rows, n, drives) = (time.len(), self.reduced.rates().len(), courses.len());
        let of_model = self.reduced.outputs().map(|output| {
            let of_drive = |d: usize| {
                let once = output.modal.iter().zip(&self.reduced.drive).map(move |(m, l)| -m * l[d]);
                [output.at_rest[d]].into_iter().chain(once).chain(std::iter::repeat_n(0.0, n))
            };
            (0..drives).flat_map(of_drive).collect::<Vec<f64>>()
        });
        let of_slopes = self.slopes.iter().map(|slope| {
            let of_drive = |of: &OfDrive| [&[of.rest][..], &of.once, &of.twice].concat();
            slope.map(|slope| slope.of_drives.iter().flat_map(of_drive).collect::<Vec<f64>>())
        });
        let all: Vec<Outputs<Vec<f64>>> = [of_model].into_iter().chain(of_slopes).collect();
        let columns: Vec<&Vec<f64>> = all.iter().flat_map(Outputs::iter).collect();
        // of each drive u, then w and v of every mode
        let width = 1 + 2 * n;
        let weights = DMatrix::from_fn(width * drives, columns.len(), |j, k| columns[k][j]);
        let mut results: Vec<Outputs<Vec<f64>>> = all.iter().map(|outputs| outputs.map(|_| Vec::with_capacity(rows))).collect();
        let mut states = DMatrix::zeros(width * drives, AT_ONCE.min(rows));
        let mut modes: Vec<[Vec<f64>; 2]> =
            courses.iter().zip(rest).map(|(course, rest)| [vec![course[0] - rest; n], vec![0.0; n]]).collect();
        let mut known: (f64, Vec<[f64; 4]>) = (f64::NAN, Vec::new());
        for first in (0..rows).step_by(AT_ONCE) {
            let count = AT_ONCE.min(rows - first);
            for (row, mut column) in (first..).zip(states.column_iter_mut()).take(count) {
                let dt = if row > 0 { time[row] - time[row - 1] } else { known.0 };
                if row > 0 && dt != known.0 {
                    known = (dt, self.reduced.rates().iter().map(|rate| interval(*rate, dt)).collect());
                }
                for (d, (course, [w, v])) in courses.iter().zip(&mut modes).enumerate() {
                    if row > 0 {
                        let slope = (course[row] - course[row - 1]) / dt;
                        for ((w, v), [decay, push, twice, of_w]) in w.iter_mut().zip(v.iter_mut()).zip(&known.1) {
                            *v = *v * decay + *w * of_w + slope * twice;
                            *w = *w * decay + slope * push;
                        }
                    }
                    column[d * width] = course[row];
                    column.rows_mut(d * width + 1, n).copy_from_slice(w);
                    column.rows_mut(d * width + 1 + n, n).copy_from_slice(v);
                }
            }
            let block = transposed_product(&states, &weights);
            let values = results.iter_mut().flat_map(Outputs::iter_mut);
            values.zip(block.column_iter()).for_each(|(values, new)| values.extend(new.iter().take(count)));
        }
        let mut results = results.into_iter();
        let outputs = results.next().expect("the model itself comes first");
        Courses { outputs, slopes: results.collect() }
    }
}

/// Effect of an interval on w and v of a mode: decay, contribution of a slope to w and to v, contribution of w to v.
fn interval(rate: f64, dt: f64) -> [f64; 4] {
    let x = rate * dt;
    let decay = (-x).exp();
    let push = if x.abs() < 1e-8 { dt } else { -(-x).exp_m1() / rate };
    // (1 − e^−x (1 + x))/rate², by its series where that cancels
    let twice = if x < 1e-3 { dt * dt * (0.5 - x / 3.0 + x * x / 8.0) } else { (1.0 - decay * (1.0 + x)) / (rate * rate) };
    [decay, push, twice, decay * dt]
}
