//! The heat flow of a design as decaying modes, on a mesh and from a space of vectors that no other part of the program uses.

use coil::{Design, Drive, Error, MeshFineness, Outputs, ThermalModel};
use fem_core::{SparseMatrix, SymbolicFactor};
use nalgebra::{DMatrix, SymmetricEigen};

/// Finer than what the diagnosis works on, of another order and another grading.
pub(super) const MESH: MeshFineness = MeshFineness { order: 5, layers: 5, ratio: 0.2 };
/// Shifts of the rational Krylov space in turn \[1/s\]: slower than the air, the air, the coil.
const SHIFTS: [f64; 3] = [0.0, 2e-3, 0.05];
/// Vectors for each drive: twice as many change no reading by 2e-5 of the peak (tests).
pub(super) const VECTORS: usize = 27;
/// A direction as small as this after orthogonalisation is rounding.
const DEPENDENT: f64 = 1e-9;

/// `q̇_i = −rate_i q_i − Σ_k forcing_ki u̇_k`, `T = Σ_k u_k φ_k + Σ_i q_i v_i`.
pub(super) struct Heat {
    pub(super) model: ThermalModel,
    /// \[1/s\]
    pub(super) rates: Vec<f64>,
    /// By drive, then mode.
    pub(super) forcing: Vec<Vec<f64>>,
    /// φ of every drive, then every mode, at all nodes.
    pub(super) fields: Vec<Vec<f64>>,
}

fn failed(source: fem_core::Error) -> Error {
    Error::Solve { part: "chamber", source }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Heat {
    /// The chamber drives, and a heater if the design has one.
    pub(super) fn new(design: &Design, vectors: usize) -> Result<Self, Error> {
        let drives: &[Drive] = if design.heat.heaters.is_empty() { &[Drive::Chamber] } else { &[Drive::Chamber, Drive::Heaters] };
        let model = ThermalModel::new(design, &MESH, drives)?;
        let vectors = krylov(&model, vectors)?;
        let stiffness = model.conductivity().matrix();
        let flows: Vec<Vec<f64>> = vectors.iter().map(|v| stiffness.multiply(v)).collect();
        let small = DMatrix::from_fn(vectors.len(), vectors.len(), |i, j| {
            (dot(&vectors[i], &flows[j]) + dot(&vectors[j], &flows[i])) / 2.0
        });
        let SymmetricEigen { eigenvalues, eigenvectors } = small.symmetric_eigen();
        let mode = |i: usize| {
            let mut sum = vec![0.0; vectors[0].len()];
            for (v, c) in vectors.iter().zip(eigenvectors.column(i).iter()) {
                sum.iter_mut().zip(v).for_each(|(s, v)| *s += c * v);
            }
            sum
        };
        let modes: Vec<Vec<f64>> = (0..vectors.len()).map(mode).collect();
        let forcing = model.stored().iter().map(|stored| modes.iter().map(|m| dot(m, stored)).collect()).collect();
        let fields = model.shapes().iter().cloned().chain(modes.iter().map(|m| model.map().expand(m))).collect();
        Ok(Self { rates: eigenvalues.as_slice().to_vec(), forcing, fields, model })
    }

    /// A functional of the nodal temperature on drives and modes.
    pub(super) fn onto(&self, functional: &[f64]) -> Vec<f64> {
        self.fields.iter().map(|field| dot(field, functional)).collect()
    }

    /// The sum of the three bias parts on drives and modes \[rad\].
    pub(super) fn total(&self, functionals: &Outputs<Vec<f64>>) -> Vec<f64> {
        let parts: Vec<Vec<f64>> = functionals.parts.iter().flatten().map(|part| self.onto(part)).collect();
        (0..parts[0].len()).map(|k| parts.iter().map(|p| p[k]).sum()).collect()
    }
}

/// Vectors of `Π (K + s_j C)⁻¹ C` applied to what each drive sets off, orthonormal in the inner product of C.
fn krylov(model: &ThermalModel, count: usize) -> Result<Vec<Vec<f64>>, Error> {
    let (c, k) = (model.capacity(), model.conductivity().matrix());
    let symbolic = SymbolicFactor::new(k).map_err(failed)?;
    let factor = |shift: &f64| symbolic.factor(SparseMatrix::combine(1.0, k, *shift, c)).map_err(failed);
    let factors = SHIFTS.iter().map(factor).collect::<Result<Vec<_>, _>>()?;
    // a ramp of the chamber leaves a lag; a heater that is switched on leaves a jump
    let mut last: Vec<Vec<f64>> = Vec::new();
    for ((drive, stored), shape) in model.drives().iter().zip(model.stored()).zip(model.shapes()) {
        last.push(match drive {
            Drive::Heaters => model.map().restrict(shape),
            _ => factors[0].solve(std::slice::from_ref(stored)).map_err(failed)?.remove(0),
        });
    }
    let (mut vectors, mut weighted): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
    for n in 0..count {
        for v in &mut last {
            let before = dot(v, &c.multiply(v)).sqrt();
            for _ in 0..2 {
                for (q, cq) in vectors.iter().zip(&weighted) {
                    let part = dot(cq, v);
                    v.iter_mut().zip(q).for_each(|(v, q)| *v -= part * q);
                }
            }
            let mut stored = c.multiply(v);
            let after = dot(v, &stored).sqrt();
            if after <= DEPENDENT * before {
                continue;
            }
            v.iter_mut().chain(&mut stored).for_each(|v| *v /= after);
            vectors.push(v.clone());
            weighted.push(stored.clone());
            *v = factors[(n + 1) % SHIFTS.len()].solve(&[stored]).map_err(failed)?.remove(0);
        }
    }
    Ok(vectors)
}
