//! Heat flow on a reduced basis: integrals over rectangles once, their sum for every design.

use super::project::{Fields, Kind, Stencil, Terms, combined, edge_integral, inner_products, integrals};
use super::section::Section;
use super::strip::{Op, Stretch, Strip};
use crate::thermal::properties;
use crate::{Design, Error, Reduced, Region, Side};
use fem_core::dense::{self, DenseFactor, product};
use nalgebra::{DMatrix, DVector};

/// The fastest rate of growth \[1/s\]: no reading is much shorter than its inverse.
const FASTEST: f64 = 0.3;

/// Rates at which a drive grows, at whose responses a heat flow is kept \[1/s\]: none, then `count` evenly in the logarithm between the slowest
/// of the coil and the fastest that a reading shows.
pub(super) fn rates(slowest: f64, count: usize) -> impl Iterator<Item = f64> {
    let first = 0.3 * slowest;
    let step = (FASTEST / first).ln() / (count - 1) as f64;
    [0.0].into_iter().chain((0..count).map(move |k| first * (step * k as f64).exp()))
}

/// Integrals over a rectangle that conduct, in the order of [`conduction`].
const CONDUCTION: [Kind; 4] = [
    Kind { of: [0, 0], r: Op::Stiffness(0), y: Op::Mass(0) },
    Kind { of: [0, 0], r: Op::Stiffness(1), y: Op::Mass(0) },
    Kind { of: [0, 0], r: Op::Mass(0), y: Op::Stiffness(0) },
    Kind { of: [0, 0], r: Op::Mass(1), y: Op::Stiffness(0) },
];

/// Integrals over a rectangle that store, in the order of [`storage`].
const STORAGE: [Kind; 2] =
    [Kind { of: [0, 0], r: Op::Mass(0), y: Op::Mass(0) }, Kind { of: [0, 0], r: Op::Mass(1), y: Op::Mass(0) }];

/// A line of the section that exchanges heat by a surface coefficient: the strip along it, and the number of the line across.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Face {
    /// Direction along the face: 0 r, 1 y.
    along: usize,
    strip: usize,
    line: usize,
    /// The end of the spool whose outer face it is.
    outer: Option<Side>,
    /// Whether nothing is modelled beyond it.
    free: bool,
}

/// Heat flow projected on fields, the first of which is 1 everywhere.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Heat {
    section: Section,
    faces: Vec<Face>,
    conduction: Terms,
    storage: Terms,
    /// the first column of each integral of storage: what it stores of a uniform temperature
    uniform: Vec<DVector<f64>>,
}

/// Coefficients of [`CONDUCTION`] in a rectangle with the conductivities `k` along r and y.
fn conduction(k: [f64; 2], [r, y]: [Stretch; 2]) -> [f64; 4] {
    let (d, a, b) = (r.shift, r.stretch, y.stretch);
    [k[0] * d * b / a, k[0] * b, k[1] * a * d / b, k[1] * a * a / b]
}

/// Coefficients of [`STORAGE`] in a rectangle of volumetric heat capacity `c`.
fn storage(c: f64, [r, y]: [Stretch; 2]) -> [f64; 2] {
    let (d, a, b) = (r.shift, r.stretch, y.stretch);
    [c * a * d * b, c * a * a * b]
}

/// Heat stored in a section per kelvin of every node of a lattice of `size` \[J/K, over 2π\], and the volume of each flange's nodes.
pub(super) fn stored(
    section: &Section,
    changed: &Section,
    strips: &[Vec<Strip>; 2],
    width: usize,
    size: usize,
    capacity: impl Fn(Region) -> f64,
) -> Result<Vec<f64>, Error> {
    let stretches = section.stretched(changed)?;
    let sums = |strip: &Strip, op: Op| -> Vec<f64> { strip.matrix(op).row_iter().map(|row| row.sum()).collect() };
    let mut load = vec![0.0; size];
    for (i, j, region) in section.rectangles() {
        let [r, y] = [&strips[0][i], &strips[1][j]];
        let along_y = sums(y, Op::Mass(0));
        for (k, factor) in storage(capacity(region), [stretches[0][i], stretches[1][j]]).into_iter().enumerate() {
            let along_r = sums(r, Op::Mass(k));
            for (b, of_y) in along_y.iter().enumerate() {
                for (a, of_r) in along_r.iter().enumerate() {
                    load[(y.first + b) * width + r.first + a] += factor * of_r * of_y;
                }
            }
        }
    }
    Ok(load)
}

/// Faces of a design's section that can exchange heat: outer faces of the spool's ends, and in a section without a medium all that is free.
fn faces(section: &Section, design: &Design) -> Vec<Face> {
    let mut faces = Vec::new();
    for (i, j, region) in section.rectangles() {
        let beyond = |i: Option<usize>, j: Option<usize>| section.region(i, j);
        let sides = [
            (0, i, j, beyond(Some(i), j.checked_sub(1)), Some(Side::Left)),
            (0, i, j + 1, beyond(Some(i), Some(j + 1)), Some(Side::Right)),
            (1, j, i, beyond(i.checked_sub(1), Some(j)), None),
            (1, j, i + 1, beyond(Some(i + 1), Some(j)), None),
        ];
        for (along, strip, line, beyond, side) in sides {
            let outer = side.filter(|side| region == Region::end(design, *side));
            let free = beyond.is_none() && !(region == Region::Medium);
            if free || outer.is_some_and(|_| beyond == Some(Region::Medium)) {
                faces.push(Face { along, strip, line, outer, free });
            }
        }
    }
    faces
}

/// Inner products of fields in the energy of conduction and, at a `rate`, of storage: faces are left out.
pub(super) fn energy(section: &Section, strips: &[Vec<Strip>; 2], fields: &Fields, design: &Design, rate: f64) -> DMatrix<f64> {
    let still = Stretch { shift: 0.0, stretch: 1.0 };
    let kinds = [CONDUCTION.as_slice(), STORAGE.as_slice()].concat();
    let mut sum = DMatrix::zeros(fields.values.ncols(), fields.values.ncols());
    for (i, j, region) in section.rectangles() {
        let Some((k, c)) = properties(design, region) else { continue };
        let coefficients =
            [conduction([k[(0, 0)], k[(1, 1)]], [still; 2]).as_slice(), storage(rate * c, [still; 2]).as_slice()].concat();
        sum += inner_products(&kinds, &coefficients, &[fields], [&strips[0][i], &strips[1][j]]);
    }
    sum
}

impl Heat {
    /// Projects on `fields` of the `section` of `design`, whose `strips` lie along r and y.
    pub(super) fn new(design: &Design, section: &Section, strips: &[Vec<Strip>; 2], fields: &Fields) -> Self {
        let over = |kinds: &[Kind]| -> Vec<DMatrix<f64>> {
            let rectangle = |(i, j, _)| integrals(kinds, &[fields], &[fields], [&strips[0][i], &strips[1][j]], false);
            section.rectangles().flat_map(rectangle).collect()
        };
        let (mut conduction, storage) = (over(&CONDUCTION), over(&STORAGE));
        let faces = faces(section, design);
        for face in &faces {
            let strip = &strips[face.along][face.strip];
            let other = &strips[1 - face.along];
            let line = if face.line < other.len() {
                other[face.line].first
            } else {
                other[face.line - 1].first + other[face.line - 1].nodes() - 1
            };
            let integral = |op| edge_integral(op, fields, strip, face.along, line);
            conduction.push(integral(Op::Mass(0)));
            conduction.push(if face.along == 0 { integral(Op::Mass(1)) } else { DMatrix::zeros(0, 0) });
        }
        let uniform = storage.iter().map(|m| m.column(0).into_owned()).collect();
        let (conduction, storage) = (Terms::new(conduction, true), Terms::new(storage, true));
        Self { section: section.clone(), faces, conduction, storage, uniform }
    }

    /// The same with as few terms as the designs of `samples` need.
    pub(super) fn compressed(&self, samples: &[(Design, Section)]) -> Result<Self, Error> {
        let all = samples.iter().map(|(design, section)| self.coefficients(design, section)).collect::<Result<Vec<_>, _>>()?;
        let of =
            |which: usize| DMatrix::from_columns(&all.iter().map(|c| DVector::from_column_slice(&c[which])).collect::<Vec<_>>());
        Ok(Self { conduction: self.conduction.compressed(&of(0)), storage: self.storage.compressed(&of(1)), ..self.clone() })
    }

    /// Number of fields, the constant one included.
    pub(super) fn size(&self) -> usize {
        self.storage.shape().0
    }

    /// Numbers that it holds.
    pub(super) fn numbers(&self) -> usize {
        self.conduction.numbers() + self.storage.numbers()
    }

    /// How far a design's coefficients lie outside those that the terms were kept for.
    pub(super) fn left_out(&self, design: &Design, changed: &Section) -> Result<f64, Error> {
        let [k, c] = self.coefficients(design, changed)?;
        Ok(self.conduction.left_out(&k).max(self.storage.left_out(&c)))
    }

    /// Coefficients of conduction and storage of a design whose section is `changed`.
    fn coefficients(&self, design: &Design, changed: &Section) -> Result<[Vec<f64>; 2], Error> {
        let stretches = self.section.stretched(changed)?;
        let (mut k, mut c) = (Vec::new(), Vec::new());
        for (i, j, region) in self.section.rectangles() {
            let (conductivity, capacity) = properties(design, region).unwrap_or((DMatrix::zeros(2, 2), 0.0));
            let stretch = [stretches[0][i], stretches[1][j]];
            k.extend(conduction([conductivity[(0, 0)], conductivity[(1, 1)]], stretch));
            c.extend(storage(capacity, stretch));
        }
        for face in &self.faces {
            let mounts = design.heat.mounts.iter().filter(|m| Some(m.side) == face.outer).map(|m| m.conductance);
            let film = design.heat.film.filter(|_| face.free);
            let (h, Stretch { shift, stretch }) = (mounts.sum::<f64>() + film.unwrap_or(0.0), stretches[face.along][face.strip]);
            let radius = changed.lines[0][face.line.min(changed.lines[0].len() - 1)];
            k.extend(if face.along == 0 { [h * stretch * shift, h * stretch * stretch] } else { [h * stretch * radius, 0.0] });
        }
        Ok([k, c])
    }

    /// Changes of conductivity and capacity on all fields: differences over designs with their sections and weights; `None` where nothing
    /// changes.
    pub(super) fn change(&self, stencil: &Stencil) -> Result<[Option<DMatrix<f64>>; 2], Error> {
        let [k, c] = combined(stencil, |design, section| self.coefficients(design, section))?;
        Ok([k.map(|k| self.conduction.sum(&k)), c.map(|c| self.storage.sum(&c))])
    }

    /// Power of each heater of `design` onto each field \[W\].
    pub(super) fn heated(&self, design: &Design, changed: &Section) -> Result<DVector<f64>, Error> {
        let stretches = self.section.stretched(changed)?;
        let mut load = DVector::zeros(self.size());
        for heater in &design.heat.heaters {
            let mut onto = DVector::<f64>::zeros(self.size());
            for (n, (i, j, region)) in self.section.rectangles().enumerate() {
                if region == Region::end(design, heater.side) {
                    let coefficients = storage(1.0, [stretches[0][i], stretches[1][j]]);
                    (0..2).for_each(|k| onto += &self.uniform[2 * n + k] * coefficients[k]);
                }
            }
            // the first field is 1: its entry is the volume over 2π
            load += &onto * (heater.power / onto[0]);
        }
        Ok(load / std::f64::consts::TAU)
    }

    /// Heat flow of a design on the first `fields` of the fields, the constant one included.
    pub(super) fn system(&self, design: &Design, changed: &Section, fields: usize) -> Result<System, Error> {
        let n = fields.min(self.size()) - 1;
        let [k, c] = self.coefficients(design, changed)?;
        let (k, c) = (self.conduction.sum(&k), self.storage.sum(&c));
        let inner = |m: &DMatrix<f64>| m.view((1, 1), (n, n)).into_owned();
        let stored = c.view((1, 0), (n, 1)).into_owned();
        let (conduction, storage) = (inner(&k), inner(&c));
        let heated = (!design.heat.heaters.is_empty()).then(|| self.heated(design, changed)).transpose()?;
        let loads = match heated {
            Some(heated) => stored.insert_column(1, 0.0).map_with_location(|i, j, v| if j == 1 { heated[i + 1] } else { v }),
            None => stored,
        };
        Ok(System { conduction, storage, loads })
    }
}

/// Heat flow on fields that are 0 at the chamber's wall.
pub(super) struct System {
    conduction: DMatrix<f64>,
    storage: DMatrix<f64>,
    /// what the chamber's rate, and the heaters, put onto each field
    loads: DMatrix<f64>,
}

/// Rates of growth of the drives at whose responses a design's modes hold, besides none.
pub(super) const SHIFTS: usize = 4;

/// Derivatives with respect to the rate that are held beside the responses themselves.
const MOMENTS: usize = 2;

/// A direction that is this small after orthogonalisation, relative to before, is rounding.
const DEPENDENT: f64 = 1e-10;

fn indefinite<E>(_: E) -> Error {
    Error::Resolution("the reduced heat flow is not positive definite; model the design anew".into())
}

impl System {
    /// All modes.
    pub(super) fn all_modes(&self) -> Result<Modes, Error> {
        let factor = DenseFactor::new(self.storage.clone()).map_err(indefinite)?;
        let half = factor.forward(self.conduction.clone());
        let symmetric = factor.forward(half.transpose());
        let (rates, vectors) = dense::symmetric_eigen(&symmetric).map_err(indefinite)?;
        let steady = DenseFactor::new(self.conduction.clone()).map_err(indefinite)?.solve(self.loads.clone());
        Ok(self.modes_of(rates, factor.backward(vectors), &steady))
    }

    /// The few modes that respond to the drives as all of them do: those of the fields that drives cause which grow at `shifts` rates, a rational
    /// Krylov space.
    pub(super) fn modes(&self, shifts: usize) -> Result<Modes, Error> {
        let (n, drives) = self.loads.shape();
        let steady = DenseFactor::new(self.conduction.clone()).map_err(indefinite)?.solve(self.loads.clone());
        let ramp = steady.columns(0, 1).into_owned();
        let slowest = ramp.dot(&self.loads.column(0)) / ramp.dot(&product(&self.storage, &ramp));
        let room = n.min(drives * (MOMENTS * (shifts + 1) + 1));
        let (mut basis, mut stored, mut count) = (DMatrix::zeros(n, room), DMatrix::zeros(n, room), 0);
        let mut hold = |fields: &DMatrix<f64>| {
            for field in fields.column_iter().take(room - count) {
                let (mut field, size) = (field.into_owned(), field.dot(&(&self.storage * field)).sqrt());
                for _ in 0..2 {
                    let along = stored.columns(0, count).tr_mul(&field);
                    field.gemv(-1.0, &basis.columns(0, count), &along, 1.0);
                }
                let image = &self.storage * &field;
                let left = field.dot(&image).sqrt();
                // not `<=`: a NaN is not a direction
                if left > DEPENDENT * size {
                    basis.set_column(count, &(field / left));
                    stored.set_column(count, &(image / left));
                    count += 1;
                }
            }
        };
        for rate in rates(slowest, shifts) {
            let factor = DenseFactor::new(&self.conduction + &self.storage * rate).map_err(indefinite)?;
            let mut fields = factor.solve(self.loads.clone());
            for moment in 0..MOMENTS {
                if moment > 0 {
                    fields = factor.solve(product(&self.storage, &fields));
                }
                hold(&fields);
            }
        }
        // what a jump of the drives leaves at once
        hold(&DenseFactor::new(self.storage.clone()).map_err(indefinite)?.solve(self.loads.clone()));
        let basis = basis.columns(0, count).into_owned();
        let small = dense::transposed_product(&basis, &product(&self.conduction, &basis));
        let (rates, vectors) = dense::symmetric_eigen(&small).map_err(indefinite)?;
        Ok(self.modes_of(rates, product(&basis, &vectors), &steady))
    }

    /// Modes of these rates and shapes; `steady` is what the loads lead to.
    fn modes_of(&self, rates: Vec<f64>, shapes: DMatrix<f64>, steady: &DMatrix<f64>) -> Modes {
        let heater = (self.loads.ncols() > 1).then(|| steady.column(1).into_owned());
        let chamber = shapes.tr_mul(&self.loads.column(0));
        let heated = heater.as_ref().map(|field| shapes.tr_mul(&(&self.storage * field)));
        let drive = (0..rates.len()).map(|i| [chamber[i]].into_iter().chain(heated.as_ref().map(|h| h[i])).collect()).collect();
        Modes { rates, shapes, drive, heater }
    }
}

/// Modes of a design on the reduced fields but the constant one.
pub(super) struct Modes {
    pub(super) rates: Vec<f64>,
    /// One a column.
    pub(super) shapes: DMatrix<f64>,
    /// Coupling of each mode to chamber and heaters.
    pub(super) drive: Vec<Vec<f64>>,
    /// Steady field under the heaters' power.
    pub(super) heater: Option<DVector<f64>>,
}

impl Modes {
    /// An output by its values on all reduced fields.
    pub(super) fn output(&self, of_fields: &DVector<f64>) -> crate::Output {
        let inner = of_fields.rows(1, self.shapes.nrows());
        let heater = self.heater.as_ref().map(|field| inner.dot(field));
        crate::Output {
            at_rest: [of_fields[0]].into_iter().chain(heater).collect(),
            modal: self.shapes.tr_mul(&inner).as_slice().to_vec(),
        }
    }

    /// The reduced model with these outputs.
    pub(super) fn model(self, outputs: crate::Outputs<crate::Output>) -> Reduced {
        Reduced { rates: self.rates, drive: self.drive, outputs }
    }
}
