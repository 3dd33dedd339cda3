//! Thermo-elasticity on a reduced basis: integrals over rectangles once, their sum for every design and mechanical state.

use super::project::{Fields, Kind, Stencil, Terms, combined, inner_products, integrals};
use super::section::Section;
use super::strip::{INVERSE, Op, Stretch, Strip};
use crate::model::region_law;
use crate::{Design, Error, MechanicalState, Region};
use fem_core::dense::{DenseFactor, transposed_product};
use nalgebra::{DMatrix, DVector};

const fn of(rows: usize, columns: usize, r: Op, y: Op) -> Kind {
    Kind { of: [rows, columns], r, y }
}

/// Components of the displacement.
const R: usize = 0;
const Y: usize = 1;

/// Integrals over a rectangle that make its stiffness, in the order of [`stiffness`].
const STIFFNESS: [Kind; 18] = [
    of(R, R, Op::Stiffness(0), Op::Mass(0)),
    of(R, R, Op::Stiffness(1), Op::Mass(0)),
    of(R, R, Op::Mass(0), Op::Stiffness(0)),
    of(R, R, Op::Mass(1), Op::Stiffness(0)),
    of(R, R, Op::Slopes, Op::Mass(0)),
    of(R, R, Op::Inverse(1), Op::Mass(0)),
    of(R, R, Op::Inverse(2), Op::Mass(0)),
    of(R, R, Op::Inverse(3), Op::Mass(0)),
    of(R, R, Op::Inverse(4), Op::Mass(0)),
    of(Y, Y, Op::Stiffness(0), Op::Mass(0)),
    of(Y, Y, Op::Stiffness(1), Op::Mass(0)),
    of(Y, Y, Op::Mass(0), Op::Stiffness(0)),
    of(Y, Y, Op::Mass(1), Op::Stiffness(0)),
    of(R, Y, Op::RowSlope(0), Op::ColumnSlope(0)),
    of(R, Y, Op::RowSlope(1), Op::ColumnSlope(0)),
    of(R, Y, Op::Mass(0), Op::ColumnSlope(0)),
    of(R, Y, Op::ColumnSlope(0), Op::RowSlope(0)),
    of(R, Y, Op::ColumnSlope(1), Op::RowSlope(0)),
];

/// Coefficients of [`STIFFNESS`] in a rectangle with the stiffness `c` (strains rr, yy, hoop, ry).
fn stiffness(c: &DMatrix<f64>, [r, y]: [Stretch; 2]) -> [f64; 18] {
    let (d, a, b) = (r.shift, r.stretch, y.stretch);
    let (c11, c22, c33, c12, c13, c23, c44) = (c[(0, 0)], c[(1, 1)], c[(2, 2)], c[(0, 1)], c[(0, 2)], c[(1, 2)], c[(3, 3)]);
    let hoop: [f64; INVERSE] = r.inverse().map(|power| c33 * a * b * power);
    [
        c11 * d * b / a,
        c11 * b,
        c44 * a * d / b,
        c44 * a * a / b,
        c13 * b,
        hoop[0],
        hoop[1],
        hoop[2],
        hoop[3],
        c44 * d * b / a,
        c44 * b,
        c22 * a * d / b,
        c22 * a * a / b,
        c12 * d,
        c12 * a,
        c23 * a,
        c44 * d,
        c44 * a,
    ]
}

/// Integrals over a rectangle by which a temperature loads it, in the order of [`load`].
const LOAD: [Kind; 5] = [
    of(R, 0, Op::RowSlope(0), Op::Mass(0)),
    of(R, 0, Op::RowSlope(1), Op::Mass(0)),
    of(R, 0, Op::Mass(0), Op::Mass(0)),
    of(Y, 0, Op::Mass(0), Op::RowSlope(0)),
    of(Y, 0, Op::Mass(1), Op::RowSlope(0)),
];

/// Coefficients of [`LOAD`] in a rectangle with the thermal stress `beta`.
fn load(beta: &DMatrix<f64>, [r, y]: [Stretch; 2]) -> [f64; 5] {
    let (d, a, b) = (r.shift, r.stretch, y.stretch);
    [beta[0] * d * b, beta[0] * a * b, beta[2] * a * b, beta[1] * a * d, beta[1] * a * a]
}

/// Stiffness on displacement fields, and the load of temperature fields on them.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Structure {
    section: Section,
    stiffness: Terms,
    load: Terms,
}

/// A structure of one design in one state, factorised.
pub(super) struct Solved {
    factor: DenseFactor,
    /// displacement fields × temperature fields
    load: DMatrix<f64>,
}

/// Rectangles that carry load.
fn solids(section: &Section) -> impl Iterator<Item = (usize, usize, Region)> + '_ {
    section.rectangles().filter(|(.., region)| *region != Region::Medium)
}

/// Inner products of displacements in the strain energy of a design.
pub(super) fn energy(
    section: &Section,
    strips: &[Vec<Strip>; 2],
    [u, v]: &[Fields; 2],
    design: &Design,
) -> Result<DMatrix<f64>, Error> {
    let still = Stretch { shift: 0.0, stretch: 1.0 };
    let mut sum = DMatrix::zeros(u.values.ncols(), u.values.ncols());
    for (i, j, region) in solids(section) {
        let (c, _) = region_law(design, region, &MechanicalState::NOMINAL)?;
        sum += inner_products(&STIFFNESS, &stiffness(&c, [still; 2]), &[u, v], [&strips[0][i], &strips[1][j]]);
    }
    Ok(sum)
}

impl Structure {
    /// Projects on `displacements` (components along r and y) and `temperatures`.
    pub(super) fn new(section: &Section, strips: &[Vec<Strip>; 2], displacements: &[Fields; 2], temperatures: &Fields) -> Self {
        let [u, v] = displacements;
        let each = |of: &dyn Fn([&Strip; 2]) -> Vec<DMatrix<f64>>| -> Vec<DMatrix<f64>> {
            solids(section).flat_map(|(i, j, _)| of([&strips[0][i], &strips[1][j]])).collect()
        };
        let stiffness = each(&|strips| integrals(&STIFFNESS, &[u, v], &[u, v], strips, true));
        let load = each(&|strips| integrals(&LOAD, &[u, v], &[temperatures], strips, false));
        Self { section: section.clone(), stiffness: Terms::new(stiffness, true), load: Terms::new(load, false) }
    }

    /// The same with as few terms as the designs of `samples` need.
    pub(super) fn compressed(&self, samples: &[(Design, Section)], states: &[MechanicalState]) -> Result<Self, Error> {
        // constants that no solid has together say nothing
        let each = |(n, (design, section)): (usize, &(Design, Section))| {
            self.coefficients(design, section, &states[n % states.len()]).ok()
        };
        let all: Vec<_> = samples.iter().enumerate().filter_map(each).collect();
        let of =
            |which: usize| DMatrix::from_columns(&all.iter().map(|c| DVector::from_column_slice(&c[which])).collect::<Vec<_>>());
        Ok(Self {
            section: self.section.clone(),
            stiffness: self.stiffness.compressed(&of(0)),
            load: self.load.compressed(&of(1)),
        })
    }

    /// Numbers that it holds.
    pub(super) fn numbers(&self) -> usize {
        self.stiffness.numbers() + self.load.numbers()
    }

    /// How far a design's coefficients lie outside those that the terms were kept for.
    pub(super) fn left_out(&self, design: &Design, changed: &Section, state: &MechanicalState) -> Result<f64, Error> {
        let [k, f] = self.coefficients(design, changed, state)?;
        Ok(self.stiffness.left_out(&k).max(self.load.left_out(&f)))
    }

    fn coefficients(&self, design: &Design, changed: &Section, state: &MechanicalState) -> Result<[Vec<f64>; 2], Error> {
        let stretches = self.section.stretched(changed)?;
        let (mut k, mut f) = (Vec::new(), Vec::new());
        for (i, j, region) in solids(&self.section) {
            let stretch = [stretches[0][i], stretches[1][j]];
            let (c, beta) = region_law(design, region, state)?;
            k.extend(stiffness(&c, stretch));
            f.extend(load(&beta, stretch));
        }
        Ok([k, f])
    }

    /// Changes of stiffness and load: differences over designs with their sections and weights; `None` where nothing changes.
    pub(super) fn change(&self, stencil: &Stencil, state: &MechanicalState) -> Result<[Option<DMatrix<f64>>; 2], Error> {
        let [k, f] = combined(stencil, |design, section| self.coefficients(design, section, state))?;
        Ok([k.map(|k| self.stiffness.sum(&k)), f.map(|f| self.load.sum(&f))])
    }

    /// Factorised for a design whose section is `changed`, on the first `fields` of the displacement fields.
    pub(super) fn solved(
        &self,
        design: &Design,
        changed: &Section,
        state: &MechanicalState,
        fields: usize,
    ) -> Result<Solved, Error> {
        let [k, f] = self.coefficients(design, changed, state)?;
        let (mut stiffness, mut load) = (self.stiffness.sum(&k), self.load.sum(&f));
        if fields < stiffness.nrows() {
            (stiffness, load) = (stiffness.view((0, 0), (fields, fields)).into_owned(), load.rows(0, fields).into_owned());
        }
        let failed = |_| Error::Resolution("the reduced stiffness is not positive definite; model the design anew".into());
        Ok(Solved { factor: DenseFactor::new(stiffness).map_err(failed)?, load })
    }
}

impl Solved {
    /// Displacements that a functional of the displacement weighs temperatures with: adjoint, one a column.
    pub(super) fn adjoint(&self, functionals: &DMatrix<f64>) -> DMatrix<f64> {
        self.factor.solve(functionals.rows(0, self.load.nrows()).into_owned())
    }

    /// Functionals of the displacement as functionals of the temperature fields, by their adjoints.
    pub(super) fn through(&self, adjoint: &DMatrix<f64>) -> DMatrix<f64> {
        transposed_product(&self.load, adjoint)
    }

    /// Change of [`Self::through`] with a change of the stiffness and of the load.
    pub(super) fn changed(&self, adjoint: &DMatrix<f64>, [stiffness, load]: &[Option<DMatrix<f64>>; 2]) -> DMatrix<f64> {
        let mut change = DMatrix::zeros(self.load.ncols(), adjoint.ncols());
        if let Some(load) = load {
            change += transposed_product(load, adjoint);
        }
        if let Some(stiffness) = stiffness {
            change -= transposed_product(&self.load, &self.factor.solve(stiffness * adjoint));
        }
        change
    }

    /// Displacement caused by each temperature field.
    pub(super) fn displacements(&self) -> DMatrix<f64> {
        self.factor.solve(self.load.clone())
    }
}
