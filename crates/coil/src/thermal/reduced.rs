//! Krylov-reduced heat flow: a few exponentials that reproduce chosen outputs for any course of the drives.

use super::state::{dot, settled};
use super::{Drive, Output, Outputs, ThermalModel};
use crate::{Bonds, Error};
use fem_core::{Factor, SparseMatrix};
use nalgebra::{DMatrix, SymmetricEigen};

/// Decaying modes `q̇_i = −rate_i q_i − Σ_k drive_ik u̇_k` and outputs `y = Σ_k at_rest_k u_k + Σ_i modal_i q_i`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Reduced {
    /// Increasing.
    pub(crate) rates: Vec<f64>,
    /// Coupling of each mode (outer index) to each drive.
    pub(crate) drive: Vec<Vec<f64>>,
    pub(crate) outputs: Outputs<Output>,
}

/// A heat flow reduced, with what measures the reduction and what gives the temperature back everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// The model.
    pub reduced: Reduced,
    /// One on two thirds of the vectors: the distance between the two measures what the reduction leaves out.
    pub smaller: Reduced,
    /// Temperature of each mode of [`Self::reduced`] at all nodes of the thermal grid: `T = Σ_k u_k φ_k + Σ_i q_i modes_i` with the
    /// shapes φ of the [`ThermalModel`].
    pub modes: Vec<Vec<f64>>,
}

/// Time scale of the fast modes \[s\]: the shortest interval at which a bias is usually read.
const FAST: f64 = 1.0;

/// A direction that is this small after orthogonalisation, relative to before, is rounding.
const DEPENDENT: f64 = 1e-10;

/// Instants at which responses are compared: thirty a decade over seven decades resolve a sum of exponentials.
const INSTANTS: usize = 2000;

/// Orthonormal in the inner product of C: the basis with C times each vector beside it.
struct Basis<'a> {
    model: &'a ThermalModel,
    vectors: Vec<Vec<f64>>,
    weighted: Vec<Vec<f64>>,
}

impl Basis<'_> {
    /// Adds a block, up to `size` vectors in all, and returns the next block: the factor's solution for C times what was new.
    fn extend_by(&mut self, block: Vec<Vec<f64>>, size: usize, factor: &Factor) -> Result<Vec<Vec<f64>>, fem_core::Error> {
        let first = self.vectors.len();
        for v in block {
            if self.vectors.len() < size {
                self.extend(v);
            }
        }
        factor.solve(&self.weighted[first..])
    }

    /// Adds what is new in `v`; `false` if nothing is.
    fn extend(&mut self, mut v: Vec<f64>) -> bool {
        let norm = |v: &[f64], model: &ThermalModel| dot(v, &model.capacity().multiply(v)).sqrt();
        let before = norm(&v, self.model);
        for _ in 0..2 {
            for (q, cq) in self.vectors.iter().zip(&self.weighted) {
                let part = dot(cq, &v);
                v.iter_mut().zip(q).for_each(|(v, q)| *v -= part * q);
            }
        }
        let after = norm(&v, self.model);
        // not `<=`: a NaN is not a direction
        let new = after > DEPENDENT * before;
        if new {
            v.iter_mut().for_each(|v| *v /= after);
            self.weighted.push(self.model.capacity().multiply(&v));
            self.vectors.push(v);
        }
        new
    }
}

impl Reduction {
    /// Projects `model` on `size` vectors of the rational Krylov space of K⁻¹C and (K + C/1 s)⁻¹C.
    ///
    /// `functionals` of the nodal temperature (all nodes of the model's grid) become the outputs.
    ///
    /// # Errors
    /// [`Error::Solve`] if a solve leaves a residual.
    pub fn new(model: &ThermalModel, functionals: &Outputs<Vec<f64>>, size: usize) -> Result<Self, Error> {
        let failed = |source| Error::Solve { part: "chamber", source };
        let mut basis = Basis { model, vectors: Vec::new(), weighted: Vec::new() };
        // a heater jumps when it is switched on: its space starts from the jump itself, the others from the response to a ramp
        let ramps = model.conductivity().solve(model.stored()).map_err(failed)?;
        let mut block: Vec<Vec<f64>> = model
            .drives()
            .iter()
            .zip(ramps)
            .zip(model.shapes())
            .map(|((drive, ramp), shape)| if *drive == Drive::Heaters { model.map().restrict(shape) } else { ramp })
            .collect();
        // slow modes from K⁻¹, fast ones from (K + C/τ)⁻¹, in turn
        let fast = Factor::new(SparseMatrix::combine(1.0, model.conductivity().matrix(), 1.0 / FAST, model.capacity()))
            .map_err(failed)?;
        let mut fast_block = fast.solve(model.stored()).map_err(failed)?;
        while basis.vectors.len() < size && !(block.is_empty() && fast_block.is_empty()) {
            block = basis.extend_by(block, size, model.conductivity()).map_err(failed)?;
            fast_block = basis.extend_by(fast_block, size, &fast).map_err(failed)?;
        }
        let all = basis.vectors.len();
        if all == 0 {
            return Err(Error::Resolution("the mesh leaves nothing to reduce; refine it".into()));
        }
        let (smaller, _) = project(model, &basis, functionals, all.saturating_sub((size / 3).max(1)).max(1));
        let (reduced, combinations) = project(model, &basis, functionals, all);
        let modes = combinations.iter().map(|c| model.map().expand(&combined(&basis.vectors, c))).collect();
        Ok(Self { reduced, smaller, modes })
    }
}

impl Reduced {
    /// Decay rate of each mode \[1/s\], increasing.
    pub fn rates(&self) -> &[f64] {
        &self.rates
    }

    /// All outputs.
    pub fn outputs(&self) -> &Outputs<Output> {
        &self.outputs
    }

    /// Temperature at the thermometer's place \[K\].
    pub fn thermometer(&self) -> &Output {
        &self.outputs.thermometer
    }

    /// Mean temperature of the coil \[K\].
    pub fn coil_mean(&self) -> &Output {
        &self.outputs.coil_mean
    }

    /// Phases \[rad\] whose increase per time is the Shupe, the elasto-optic axial and the elasto-optic radial part of the bias, at rest:
    /// bonds hold, nothing has relaxed, the first row of a table.
    ///
    /// # Panics
    /// If the model was made without.
    pub fn parts(&self) -> &[Output; 3] {
        &self.outputs.parts[0]
    }

    /// As [`Self::parts`], of a design of [`crate::Mechanics::Opening`] while its bond is closed or opened.
    ///
    /// # Panics
    /// If the design has no bond that can open.
    pub fn parts_with(&self, bond: Bonds) -> &[Output; 3] {
        &self.outputs.parts[bond as usize]
    }

    /// Mean response of an output to a unit step of drive `d` over the second that begins `t` \[s\] after it: no reading is shorter.
    pub fn step_response(&self, output: &Output, d: usize, t: f64) -> f64 {
        let decaying = self.rates.iter().zip(&self.drive).zip(&output.modal);
        let mode =
            |((rate, drive), modal): ((&f64, &Vec<f64>), &f64)| modal * drive[d] * (-rate * t).exp() * settled(rate * FAST);
        output.at_rest[d] - decaying.map(mode).sum::<f64>()
    }

    /// The same model of these modes alone, under its first drive alone.
    pub(crate) fn truncated(&self, modes: &[usize]) -> Self {
        Self {
            rates: modes.iter().map(|&i| self.rates[i]).collect(),
            drive: modes.iter().map(|&i| vec![self.drive[i][0]]).collect(),
            outputs: self.outputs.map(|output| Output {
                at_rest: vec![output.at_rest[0]],
                modal: modes.iter().map(|&i| output.modal[i]).collect(),
            }),
        }
    }

    /// Instants that resolve every mode, evenly spaced in the logarithm of time \[s\].
    pub fn instants(&self) -> Vec<f64> {
        let ends = (self.rates.last(), self.rates.first());
        let (Some(fast), Some(slow)) = ends else { return vec![0.0] };
        let (first, last) = (0.01 / fast, 40.0 / slow);
        let step = (last / first).ln() / (INSTANTS - 1) as f64;
        (0..INSTANTS).map(|i| first * (step * i as f64).exp()).collect()
    }
}

/// The model on the first `n` vectors of `basis`, and each of its modes as a combination of them.
fn project(model: &ThermalModel, basis: &Basis, functionals: &Outputs<Vec<f64>>, n: usize) -> (Reduced, Vec<Vec<f64>>) {
    let flows: Vec<Vec<f64>> = basis.vectors[..n].iter().map(|v| model.conductivity().matrix().multiply(v)).collect();
    let small = DMatrix::from_fn(n, n, |i, j| (dot(&basis.vectors[i], &flows[j]) + dot(&basis.vectors[j], &flows[i])) / 2.0);
    let SymmetricEigen { eigenvalues, eigenvectors } = small.symmetric_eigen();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| eigenvalues[a].total_cmp(&eigenvalues[b]));
    let modal = |along: &[f64], mode: usize| (0..n).map(|j| eigenvectors[(j, mode)] * along[j]).sum::<f64>();
    let along = |load: &[f64]| basis.vectors[..n].iter().map(|v| dot(v, load)).collect::<Vec<_>>();
    let drives: Vec<_> = model.stored().iter().map(|w| along(w)).collect();
    let output = |functional: &Vec<f64>| {
        let onto = along(&model.map().restrict(functional));
        Output {
            at_rest: model.shapes().iter().map(|shape| dot(shape, functional)).collect(),
            modal: order.iter().map(|&mode| modal(&onto, mode)).collect(),
        }
    };
    let reduced = Reduced {
        rates: order.iter().map(|&mode| eigenvalues[mode]).collect(),
        drive: order.iter().map(|&mode| drives.iter().map(|d| modal(d, mode)).collect()).collect(),
        outputs: functionals.map(output),
    };
    (reduced, order.iter().map(|&mode| eigenvectors.column(mode).iter().copied().collect()).collect())
}

/// Σ cᵢ vᵢ.
fn combined(vectors: &[Vec<f64>], c: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; vectors.first().map_or(0, Vec::len)];
    for (v, c) in vectors.iter().zip(c) {
        sum.iter_mut().zip(v).for_each(|(s, v)| *s += c * v);
    }
    sum
}
