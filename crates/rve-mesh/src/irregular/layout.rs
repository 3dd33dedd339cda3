//! The periodic cell: lattice, inclusions, matrix.

use super::{LayoutError, Outline};

/// Least film between two inclusions, and least thickness of a ring, over the smallest semi-axis at hand. Thinner ones are refused.
pub const LEAST_FILM: f64 = 1e-3;

/// Points of an outline at which distances between ellipses are taken.
const SAMPLES: usize = 360;

/// A fibre or a void: nested outlines and what lies within each.
#[derive(Debug, Clone, PartialEq)]
pub struct Inclusion {
    /// Outlines from the inside out.
    pub outlines: Vec<Outline>,
    /// Phase inside each outline; the innermost may be empty (a void, a hollow core).
    pub phases: Vec<Option<usize>>,
}

/// A cell that repeats by its lattice vectors, filled with a matrix around inclusions.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    lattice: [[f64; 2]; 2],
    inclusions: Vec<Inclusion>,
    matrix: usize,
}

impl Inclusion {
    /// A void.
    pub fn void(outline: Outline) -> Self {
        Self { outlines: vec![outline], phases: vec![None] }
    }

    /// The outermost outline.
    pub fn hull(&self) -> &Outline {
        &self.outlines[self.outlines.len() - 1]
    }

    fn moved(&self, by: [f64; 2]) -> Self {
        Self { outlines: self.outlines.iter().map(|o| o.moved(by)).collect(), phases: self.phases.clone() }
    }

    fn check(&self, inclusion: usize) -> Result<(), LayoutError> {
        if let Some(ring) = self.outlines.iter().position(|o| !o.is_valid()) {
            return Err(LayoutError::Outline { inclusion, ring });
        }
        if self.outlines.is_empty() || self.phases.len() != self.outlines.len() || self.phases[1..].contains(&None) {
            return Err(LayoutError::Phases(inclusion));
        }
        for (ring, pair) in self.outlines.windows(2).enumerate() {
            let thickness = samples(&pair[0]).map(|p| -pair[1].nearest(p).0).fold(f64::INFINITY, f64::min);
            if thickness < LEAST_FILM * pair[0].semi_axes[0].min(pair[0].semi_axes[1]) {
                return Err(LayoutError::Nesting { inclusion, ring, thickness });
            }
        }
        Ok(())
    }
}

fn samples(outline: &Outline) -> impl Iterator<Item = [f64; 2]> {
    (0..SAMPLES).map(|k| outline.point(std::f64::consts::TAU * k as f64 / SAMPLES as f64))
}

/// Shifts of a cell's neighbours, itself first.
pub(super) fn shifts(reach: i32) -> impl Iterator<Item = [i32; 2]> + Clone {
    let all = (-reach..=reach).flat_map(move |i| (-reach..=reach).map(move |j| [i, j]));
    std::iter::once([0, 0]).chain(all.filter(|s| *s != [0, 0]))
}

impl Layout {
    /// A cell of `lattice` vectors \[m\] whose `matrix` is the given phase. The vectors are reduced, and inclusions moved by whole
    /// lattice vectors into the cell.
    ///
    /// # Errors
    /// [`LayoutError`] names the inclusion that touches another, leaves its ring, or is no ellipse.
    pub fn new(lattice: [[f64; 2]; 2], inclusions: Vec<Inclusion>, matrix: usize) -> Result<Self, LayoutError> {
        let area = lattice[0][0] * lattice[1][1] - lattice[0][1] * lattice[1][0];
        if !(area.is_finite() && area > 0.0) {
            return Err(LayoutError::Lattice(lattice));
        }
        if inclusions.is_empty() {
            return Err(LayoutError::Empty);
        }
        let mut layout = Self { lattice: reduced(lattice), inclusions: Vec::new(), matrix };
        for (i, inclusion) in inclusions.iter().enumerate() {
            inclusion.check(i)?;
            layout.inclusions.push(layout.wrapped(inclusion));
        }
        layout.check_films()?;
        Ok(layout)
    }

    fn wrapped(&self, inclusion: &Inclusion) -> Inclusion {
        let [[ax, ay], [bx, by]] = self.lattice;
        let [x, y] = inclusion.hull().centre;
        let along = [(x * by - y * bx) / self.area(), (y * ax - x * ay) / self.area()];
        // a centre on the edge of the cell stays there, whatever its rounding
        inclusion.moved(self.vector(along.map(|f| -(f + 1e-9).floor() as i32)))
    }

    fn check_films(&self) -> Result<(), LayoutError> {
        for (first, a) in self.inclusions.iter().enumerate() {
            for (second, b) in self.inclusions.iter().enumerate().skip(first) {
                let shifts = shifts(2).filter(|s| second != first || *s != [0, 0]);
                let film = shifts.map(|s| film(a.hull(), &b.hull().moved(self.vector(s)))).fold(f64::INFINITY, f64::min);
                let smallest = a.hull().semi_axes.into_iter().chain(b.hull().semi_axes).fold(f64::INFINITY, f64::min);
                if film < LEAST_FILM * smallest {
                    return Err(LayoutError::Overlap { first, second, film });
                }
            }
        }
        Ok(())
    }

    /// Lattice vectors \[m\], reduced: as short as they can be.
    pub fn lattice(&self) -> [[f64; 2]; 2] {
        self.lattice
    }

    /// A whole number of lattice vectors \[m\].
    pub fn vector(&self, [i, j]: [i32; 2]) -> [f64; 2] {
        [0, 1].map(|c| f64::from(i) * self.lattice[0][c] + f64::from(j) * self.lattice[1][c])
    }

    /// The inclusions, moved into the cell.
    pub fn inclusions(&self) -> &[Inclusion] {
        &self.inclusions
    }

    /// Phase of the matrix.
    pub fn matrix(&self) -> usize {
        self.matrix
    }

    /// Area of the cell, voids included \[m²\].
    pub fn area(&self) -> f64 {
        self.lattice[0][0] * self.lattice[1][1] - self.lattice[0][1] * self.lattice[1][0]
    }

    /// Exact area of each phase \[m²\].
    pub fn phase_areas(&self) -> Vec<f64> {
        let phases = self.inclusions.iter().flat_map(|i| i.phases.iter().flatten()).chain([&self.matrix]);
        let mut areas = vec![0.0; phases.max().map_or(0, |p| p + 1)];
        areas[self.matrix] = self.area();
        for inclusion in &self.inclusions {
            let mut inside = 0.0;
            for (outline, phase) in inclusion.outlines.iter().zip(&inclusion.phases) {
                if let Some(phase) = phase {
                    areas[*phase] += outline.area() - inside;
                }
                inside = outline.area();
            }
            areas[self.matrix] -= inside;
        }
        areas
    }
}

/// Least distance between two outlines \[m\], negative if they overlap.
pub(super) fn film(a: &Outline, b: &Outline) -> f64 {
    let apart = (a.centre[0] - b.centre[0]).hypot(a.centre[1] - b.centre[1]);
    let round = |o: &Outline| o.semi_axes[0] == o.semi_axes[1];
    let at_least = apart - a.reach() - b.reach();
    // far apart, the exact film does not matter
    if (round(a) && round(b)) || at_least > a.reach() {
        return at_least;
    }
    samples(a).map(|p| b.nearest(p).0).chain(samples(b).map(|p| a.nearest(p).0)).fold(f64::INFINITY, f64::min)
}

/// Lagrange's reduction; the orientation is kept.
pub(super) fn reduced([mut a, mut b]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    for _ in 0..64 {
        let steps = (dot(a, b) / dot(a, a) - 1e-9).round();
        b = [b[0] - steps * a[0], b[1] - steps * a[1]];
        if dot(b, b) >= dot(a, a) * (1.0 - 1e-9) {
            break;
        }
        (a, b) = (b, [-a[0], -a[1]]);
    }
    [a, b]
}
