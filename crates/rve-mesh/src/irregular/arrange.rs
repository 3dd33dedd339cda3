//! Places of fibres: regular lattices, and random displacements from them.

use super::LayoutError;
use super::layout::{reduced, shifts};
use std::f64::consts::TAU;

/// Lattice vectors and fibre axes of a cell of several fibres.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    /// Lattice vectors \[m\].
    pub lattice: [[f64; 2]; 2],
    /// Fibre axes \[m\].
    pub centres: Vec<[f64; 2]>,
}

const MOST_FIBRES: f64 = 1e6;

impl Arrangement {
    /// `columns` × `rows` fibres, at least one of each, at `pitch` \[m\], > 0, each row by half a pitch beyond the one below it.
    ///
    /// # Errors
    /// [`LayoutError::Range`] names the number that is 0, the product of both that exceeds a million, or the pitch that is no length.
    pub fn hexagonal(pitch: f64, columns: usize, rows: usize) -> Result<Self, LayoutError> {
        Self::rows(pitch, columns, rows, [pitch / 2.0, pitch * 0.75_f64.sqrt()])
    }

    /// `columns` × `rows` fibres, at least one of each, at `pitch` \[m\], > 0, row above row.
    ///
    /// # Errors
    /// As [`Self::hexagonal`].
    pub fn square(pitch: f64, columns: usize, rows: usize) -> Result<Self, LayoutError> {
        Self::rows(pitch, columns, rows, [0.0, pitch])
    }

    fn rows(pitch: f64, columns: usize, rows: usize, step: [f64; 2]) -> Result<Self, LayoutError> {
        check("pitch", pitch, pitch > 0.0, "finite and greater than 0 m")?;
        for (field, count) in [("columns", columns), ("rows", rows)] {
            check(field, count as f64, count > 0, "at least 1")?;
        }
        let fibres = columns as f64 * rows as f64;
        check("columns times rows", fibres, fibres <= MOST_FIBRES, "a million at most")?;
        let centre = |k: usize| {
            let (row, column) = ((k / columns) as f64, (k % columns) as f64);
            [column * pitch + row * step[0], row * step[1]]
        };
        let rows_up = rows as f64;
        Ok(Self {
            lattice: reduced([[columns as f64 * pitch, 0.0], [rows_up * step[0], rows_up * step[1]]]),
            centres: (0..columns * rows).map(centre).collect(),
        })
    }
}

fn check(field: &'static str, value: f64, holds: bool, range: &'static str) -> Result<(), LayoutError> {
    if holds && value.is_finite() { Ok(()) } else { Err(LayoutError::Range { field, value, range }) }
}

/// A small generator of equidistributed numbers (Steele, Lea and Flood, 2014).
pub(super) struct SplitMix64(u64);

impl SplitMix64 {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// In [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

const SWEEPS: usize = 60;

/// Moves every fibre of bounding radius `radius` \[m\] at random within `most` \[m\] of its place, keeping films of at least `film` \[m\].
///
/// Sweeps over the fibres propose a place, equidistributed in the disc, for one fibre at a time and take it if no film becomes too thin;
/// after `SWEEPS` of them the arrangement is a sample of hard discs tied to their places. The same seed gives the same places.
///
/// # Errors
/// [`LayoutError::Overlap`] if the arrangement itself leaves thinner films; [`LayoutError::Range`] names the length that is none.
pub fn displace(regular: &Arrangement, radius: f64, most: f64, film: f64, seed: u64) -> Result<Arrangement, LayoutError> {
    check("radius", radius, radius > 0.0, "finite and greater than 0 m")?;
    check("most", most, most >= 0.0, "finite and 0 m or more")?;
    check("film", film, true, "finite")?;
    let mut arrangement = regular.clone();
    let mut random = SplitMix64::new(seed);
    for i in 0..regular.centres.len() {
        let (closest, at) = arrangement.closest(i, arrangement.centres[i]);
        if closest - 2.0 * radius < film {
            return Err(LayoutError::Overlap { first: i, second: at, film: closest - 2.0 * radius });
        }
    }
    for _ in 0..SWEEPS {
        for i in 0..regular.centres.len() {
            let (r, angle) = (most * random.unit().sqrt(), TAU * random.unit());
            let [x, y] = regular.centres[i];
            let place = [x + r * angle.cos(), y + r * angle.sin()];
            if arrangement.closest(i, place).0 - 2.0 * radius >= film {
                arrangement.centres[i] = place;
            }
        }
    }
    Ok(arrangement)
}

impl Arrangement {
    /// Distance from `place` of fibre `i` to the nearest other axis, and its number.
    fn closest(&self, i: usize, place: [f64; 2]) -> (f64, usize) {
        let [a, b] = self.lattice;
        let area = a[0] * b[1] - a[1] * b[0];
        let mut best = (a[0].hypot(a[1]), i); // its own image: the shortest lattice vector
        for (j, centre) in self.centres.iter().enumerate().filter(|(j, _)| *j != i) {
            let [x, y] = [centre[0] - place[0], centre[1] - place[1]];
            let (m, n) = (((x * b[1] - y * b[0]) / area).round(), ((y * a[0] - x * a[1]) / area).round());
            for [k, l] in shifts(1) {
                let (m, n) = (f64::from(k) - m, f64::from(l) - n);
                let [x, y] = [x + m * a[0] + n * b[0], y + m * a[1] + n * b[1]];
                if x.hypot(y) < best.0 {
                    best = (x.hypot(y), j);
                }
            }
        }
        best
    }
}
