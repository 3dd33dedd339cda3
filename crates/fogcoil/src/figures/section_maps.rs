//! The section of coil and spool as a raster, and its fields in it.

use coil::{Design, Error, Layout, Places, PointValues, STANDARD, Section, TurnFields};

use super::blocks::{Cells, cells};
use super::instants::Instants;
use crate::simulate::{Fields, Sample, Simulation};
use crate::turn_bias::{Contributions, Sum};
use crate::units::{to_mm, to_ppm, to_um};

/// Cells of a raster, about.
const CELLS: f64 = 3000.0;
/// Most cells along a side.
const MOST_ALONG: f64 = 240.0;

/// A field of the section, in the unit of its label.
pub(super) struct Quantity {
    pub(super) name: &'static str,
    /// Quantity and unit.
    pub(super) label: &'static str,
    /// Smallest span that is drawn.
    pub(super) least: f64,
    pub(super) kind: Kind,
}

/// Source of a field.
pub(super) enum Kind {
    /// The section; the second argument is the fibre's mean temperature.
    Point(fn(&PointValues, f64) -> f64),
    /// The turns: their contributions to the bias in blocks.
    Bias,
}

/// All fields, in the order in which they are drawn.
pub(super) const QUANTITIES: [Quantity; 5] = [
    Quantity {
        name: "temperature",
        label: "temperature less mean [K]",
        least: 1e-3,
        kind: Kind::Point(|at, mean| at.temperature - mean),
    },
    Quantity {
        name: "hoop strain", label: "hoop strain [10⁻⁶]", least: 0.1, kind: Kind::Point(|at, _| to_ppm(at.strain[2]))
    },
    Quantity {
        name: "radial strain of the glass",
        label: "radial strain of the glass [10⁻⁶]",
        least: 0.1,
        kind: Kind::Point(|at, _| to_ppm(at.glass_radial)),
    },
    Quantity {
        name: "radial displacement",
        label: "radial displacement [µm]",
        least: 1e-3,
        kind: Kind::Point(|at, _| to_um(at.displacement[0])),
    },
    Quantity { name: "contribution to the bias", label: "bias of each block [°/h]", least: 1e-6, kind: Kind::Bias },
];

/// The section of a simulation in equal cells.
pub(super) struct Raster<'a> {
    simulation: &'a Simulation<'a>,
    turns: &'a TurnFields,
    section: Section<'a>,
    instants: &'a Instants,
    rest: Vec<f64>,
    places: Places,
    /// Cells along the axis and along the radius.
    pub(super) count: [usize; 2],
    /// Ends along the axis \[m\].
    pub(super) y: [f64; 2],
    /// Ends along the radius \[m\].
    pub(super) r: [f64; 2],
}

/// Values in the cells of a raster, row by row from the inside; not a number where there is nothing.
pub(super) struct Maps {
    /// A raster for each of [`QUANTITIES`].
    pub(super) values: Vec<Vec<f64>>,
    /// Blocks of turns with the contribution of each to the bias.
    pub(super) blocks: Cells,
    /// What the bias adds up to \[°/h\].
    pub(super) bias: Sum,
}

impl<'a> Raster<'a> {
    pub(super) fn new(simulation: &'a Simulation, fields: &'a Fields, instants: &'a Instants) -> Result<Self, Error> {
        let design = &simulation.case.design;
        let layout = Layout::new(design)?;
        let least = |f: fn(&coil::Rectangle) -> f64| layout.solids.iter().map(f).fold(f64::INFINITY, f64::min);
        let (y, r) = ([least(|s| s.y[0]), -least(|s| -s.y[1])], [least(|s| s.r[0]), -least(|s| -s.r[1])]);
        let cell = ((y[1] - y[0]) * (r[1] - r[0]) / CELLS).sqrt();
        let count = [y, r].map(|[low, high]| ((high - low) / cell).ceil().clamp(1.0, MOST_ALONG) as usize);
        let section = Section::new(design, &STANDARD.resolution, &fields.section)?;
        let rest = simulation.profile.profile.rest(&simulation.profile.drives);
        let places = section.places(&centres(count, y, r));
        Ok(Self { simulation, turns: &fields.turns, section, instants, rest, places, count, y, r })
    }

    /// The fields at a sample of the course.
    pub(super) fn at(&self, sample: usize) -> Result<Maps, bias::Error> {
        let Sample { state, change, .. } = &self.simulation.samples[sample];
        let points = self.section.at(state, &self.rest).at_places(&self.places);
        let contributions = Contributions::of(self.simulation.case, self.turns, change)?;
        let blocks = cells(&self.simulation.case.winding, &contributions.part(bias::Bias::total), true);
        let mean = self.instants.means[sample];
        let values = |quantity: &Quantity| match quantity.kind {
            Kind::Point(of) => points.iter().map(|point| point.as_ref().map_or(f64::NAN, |point| of(point, mean))).collect(),
            Kind::Bias => centres(self.count, self.y, self.r).into_iter().map(|place| blocks.at(place)).collect(),
        };
        Ok(Maps { values: QUANTITIES.iter().map(values).collect(), bias: contributions.sum(bias::Bias::total), blocks })
    }

    /// Means of each row over the coil's height, and of each column over the coil's layers; where there is nothing, not a number.
    pub(super) fn profiles(&self, values: &[f64]) -> [Vec<f64>; 2] {
        let (design, [columns, rows]) = (&self.simulation.case.design, self.count);
        let middle = |k: usize, [low, high]: [f64; 2], count: usize| low + (high - low) * (k as f64 + 0.5) / count as f64;
        let along = (0..columns).filter(|k| (0.0..design.body.height).contains(&middle(*k, self.y, columns)));
        let layers = design.winding.inner_radius..design.body.outer_radius;
        let across = (0..rows).filter(|k| layers.contains(&middle(*k, self.r, rows)));
        let mean = |cells: &mut dyn Iterator<Item = usize>| {
            let found: Vec<f64> = cells.map(|cell| values[cell]).filter(|v| v.is_finite()).collect();
            found.iter().sum::<f64>() / found.len() as f64
        };
        let of_row = |row: usize| mean(&mut along.clone().map(|column| row * columns + column));
        let of_column = |column: usize| mean(&mut across.clone().map(|row| row * columns + column));
        [(0..rows).map(of_row).collect(), (0..columns).map(of_column).collect()]
    }

    /// Ends of the coil along the axis and along the radius \[mm\].
    pub(super) fn coil_mm(&self) -> [[f64; 2]; 2] {
        let Design { body, winding, .. } = &self.simulation.case.design;
        [[0.0, body.height], [winding.inner_radius, body.outer_radius]].map(|ends| ends.map(to_mm))
    }

    /// Ends along the axis and along the radius \[mm\].
    pub(super) fn ends_mm(&self) -> [[f64; 2]; 2] {
        [self.y.map(to_mm), self.r.map(to_mm)]
    }
}

/// Middles (r, y) of the cells of a raster, row by row from the inside.
fn centres([columns, rows]: [usize; 2], y: [f64; 2], r: [f64; 2]) -> Vec<[f64; 2]> {
    let at = |k: usize, [low, high]: [f64; 2], count: usize| low + (high - low) * (k as f64 + 0.5) / count as f64;
    (0..rows * columns).map(|k| [at(k / columns, r, rows), at(k % columns, y, columns)]).collect()
}
