//! How a parametric model is made: full solutions at chosen designs of the box, compressed.

use super::effort::{Effort, MODULI};
use super::heat::{self, Heat, stored};
use super::model::ParametricModel;
use super::project::Fields;
use super::range::Range;
use super::section::Section;
use super::strip::Strip;
use super::structure::{self, Structure};
use super::turns::Turns;
use crate::grid::Grading;
use crate::layout::Skins;
use crate::thermal::{Shifted, properties};
use crate::{Design, Error, Grid, Layout, MechanicalState, MeshFineness, Model, Parameter, Region, Side};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// Rates of growth at which a design's heat flow is solved, besides none. More designs are worth more than more rates.
const RATES: usize = 6;

/// Designs of the box whose coefficients the kept terms hold.
const SAMPLES: usize = 250;

/// States of the mechanics that laws with a state go through.
const STATES: [MechanicalState; 3] = [
    MechanicalState::NOMINAL,
    MechanicalState { transverse_modulus: MODULI[0], transverse_expansion: 2.0, ..MechanicalState::NOMINAL },
    MechanicalState { transverse_modulus: MODULI[1], ..MechanicalState::NOMINAL },
];

/// Weight of stored heat beside conduction in the size of a field \[1/s\]: a coil's slowest rates are of its order.
const STORED: f64 = 1e-3;

/// Heat flow of one design of the box.
struct Solved {
    /// Temperatures on the lattice, one for every rate and load.
    fields: Vec<DVector<f64>>,
    /// Rate of growth from which the others are made \[1/s\].
    slowest: f64,
}

/// The lattice of nodes of a thermal mesh.
#[derive(PartialEq)]
struct Lattice {
    width: usize,
    height: usize,
}

impl Lattice {
    fn of(grid: &Grid) -> Self {
        let nodes = |d: usize| (grid.lines()[d].len() - 1) * grid.mesh().order() + 1;
        Self { width: nodes(0), height: nodes(1) }
    }

    fn size(&self) -> usize {
        self.width * self.height
    }

    /// A nodal field on the lattice, 0 where there is no node.
    fn lay(&self, grid: &Grid, field: &[f64]) -> DVector<f64> {
        let mut laid = DVector::zeros(self.size());
        grid.places().iter().zip(field).for_each(|(place, value)| laid[*place] = *value);
        laid
    }
}

/// Columns that make fields with the inner products `gram` orthonormal, the largest first, without those below `least` of the largest.
fn compressed(gram: &DMatrix<f64>, least: f64, most: usize) -> DMatrix<f64> {
    let scale: Vec<f64> = gram.diagonal().iter().map(|g| if *g > 0.0 { 1.0 / g.sqrt() } else { 0.0 }).collect();
    let scaled = DMatrix::from_fn(gram.nrows(), gram.nrows(), |i, j| gram[(i, j)] * scale[i] * scale[j]);
    let eigen = scaled.symmetric_eigen();
    let mut order: Vec<usize> = (0..gram.nrows()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let largest = eigen.eigenvalues[order[0]];
    let kept: Vec<usize> = order.into_iter().filter(|&i| eigen.eigenvalues[i] > least * least * largest).take(most).collect();
    DMatrix::from_fn(gram.nrows(), kept.len(), |i, k| {
        eigen.eigenvectors[(i, kept[k])] * scale[i] / eigen.eigenvalues[kept[k]].sqrt()
    })
}

/// Fractional parts of multiples of roots: points spread over a box, the same every time; a few in many dimensions leave gaps.
///
/// M. Roberts, the R sequence: the roots of x^(d+1) = x + 1.
pub(super) fn point(number: usize, dimension: usize) -> Vec<f64> {
    let mut root = 2.0f64;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (dimension as f64 + 1.0));
    }
    (1..=dimension).map(|k| (0.5 + number as f64 * root.powi(-(k as i32))).fract()).collect()
}

/// A design within the box: each parameter at its share of its range, in the coordinate in which responses are smooth.
pub(super) fn placed(design: &Design, ranges: &[Range], shares: &[f64]) -> Design {
    let mut changed =
        ranges.iter().zip(shares).fold(design.clone(), |design, (range, share)| range.parameter.set(&design, range.at(*share)));
    // constants that no solid has together: the contraction stays as it is designed, or its range is as far as this stiffness allows
    let stiffest = STATES.iter().map(|state| state.transverse_modulus).fold(1.0, f64::max);
    if changed.body.elastic.indefinite_at_e_r_factor() <= stiffest {
        changed.body.elastic.nu_r = changed.body.elastic.nu_r.min(design.body.elastic.nu_r);
    }
    changed
}

impl ParametricModel {
    /// Models `design` and all that differ from it within `ranges`; `solved` is told of each of the [`Effort::solutions`].
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn new(
        design: &Design,
        ranges: &[Range],
        resolution: &MeshFineness,
        effort: &Effort,
        solved: &(dyn Fn() + Sync),
    ) -> Result<Self, Error> {
        let section = Section::new(design)?;
        let ranges: Vec<Range> = ranges.iter().copied().filter(|r| r.parameter.of(design).is_some()).collect();
        let skinned = |design: &Design| Layout::with_skins(design, Skins::All);
        // flanges, and the hub where it has a heater or may have one
        let hot_end = |side: Side| {
            let free = ranges.iter().any(|range| range.parameter == Parameter::Heater(side));
            let heated = design.heat.heaters.iter().any(|heater| heater.side == side);
            design.spool.is_some() && (Region::end(design, side) == Region::flange(side) || free || heated)
        };
        let ends: Vec<Side> = [Side::Left, Side::Right].into_iter().filter(|side| hot_end(*side)).collect();
        let hot: Vec<Range> = ranges.iter().copied().filter(|r| r.parameter.of_heat()).collect();
        let stiff: Vec<Range> = ranges.iter().copied().filter(|r| r.parameter.of_mechanics()).collect();
        let layout = skinned(design)?;
        let nominal = Shifted::new(&layout, design, resolution)?;
        let grid = nominal.grid().clone();
        let lattice = Lattice::of(&grid);
        let strips = [Strip::all(&grid, 0, &section.lines[0]), Strip::all(&grid, 1, &section.lines[1])];
        let mut fields: Vec<DVector<f64>> = vec![lattice.lay(&grid, &vec![1.0; grid.mesh().nodes().len()])];
        // fields of a training design at the rates that are made of the slowest one, which is that of the design itself
        let solved_at = |k: usize, slowest: Option<f64>| -> Result<Option<Solved>, Error> {
            solved();
            let changed = if k == 0 { design.clone() } else { placed(design, &hot, &training(k, hot.len())) };
            let made = || -> Result<_, Error> {
                let (layout, of_changed) = (skinned(&changed)?, Section::new(&changed)?);
                section.stretched(&of_changed)?;
                let heat = Shifted::new(&layout, &changed, resolution)?;
                Ok((layout, of_changed, heat))
            };
            // a corner of the box that cannot be built, or has faces of its own, says nothing of the others
            let (layout, of_changed, heat) = match made() {
                Ok(made) if Lattice::of(made.2.grid()) == lattice => made,
                Err(error) if k == 0 => return Err(error),
                _ => return Ok(None),
            };
            let load = |capacity: &dyn Fn(Region) -> f64| -> Result<Vec<f64>, Error> {
                let laid = stored(&section, &of_changed, &strips, lattice.width, lattice.size(), capacity)?;
                Ok(heat.grid().places().iter().map(|place| laid[*place] * std::f64::consts::TAU).collect())
            };
            let mut loads = vec![load(&|region| properties(&changed, region).map_or(0.0, |(_, c)| c))?];
            for side in &ends {
                loads.push(load(&|region| f64::from(u8::from(region == Region::end(design, *side))))?);
            }
            let mut fields = Vec::new();
            let mut solve = |rate: f64| -> Result<f64, Error> {
                let solutions = heat.solve(&layout, &changed, rate, &loads)?;
                fields.extend(solutions.iter().map(|field| lattice.lay(heat.grid(), field)));
                Ok(solutions[0].iter().copied().fold(0.0, f64::max))
            };
            let slowest = match slowest {
                Some(slowest) => slowest,
                None => 1.0 / solve(0.0)?,
            };
            for rate in heat::rates(slowest, RATES).skip(usize::from(k == 0)) {
                solve(rate)?;
            }
            Ok(Some(Solved { fields, slowest }))
        };
        let own = solved_at(0, None)?;
        let slowest = own.as_ref().map(|own| own.slowest);
        let others = (1..=effort.heat).into_par_iter().map(|k| solved_at(k, slowest)).collect::<Result<Vec<_>, _>>()?;
        fields.extend(std::iter::once(own).chain(others).flatten().flat_map(|one| one.fields));
        let raw = Fields { width: lattice.width, values: DMatrix::from_columns(&fields) };
        // those that are independent, and the constant one as it is
        let others = Fields { width: lattice.width, values: raw.values.columns(1, raw.values.ncols() - 1).into_owned() };
        let gram = heat::energy(&section, &strips, &others, design, STORED);
        let kept = others.combined(&compressed(&gram, effort.least_temperature, effort.most_temperatures));
        let mut values = kept.values.insert_column(0, 0.0);
        values.set_column(0, &raw.values.column(0));
        let temperatures = Fields { width: lattice.width, values };
        let heat = Heat::new(design, &section, &strips, &temperatures);
        let mechanics = |design: &Design, state: &MechanicalState| -> Result<Model, Error> {
            Model::on(&skinned(design)?, design, resolution, Grading::Even, state)
        };
        let model = mechanics(design, &MechanicalState::NOMINAL)?;
        solved();
        let shared = model.grid().shared_nodes(&grid)?;
        let onto =
            |field: usize| -> Vec<f64> { shared.iter().map(|&node| temperatures.values[(grid.places()[node], field)]).collect() };
        let mut displacements: Vec<Vec<f64>> = Vec::new();
        let loads: Vec<Vec<f64>> = (0..heat.size()).map(onto).collect();
        displacements.extend(model.displacements(&loads)?);
        let winding = winding::wind(&design.winding)?;
        let weights = winding.weights();
        let lengths: Vec<f64> = winding.turns().iter().map(winding::Turn::length).collect();
        displacements.extend(model.adjoints(&[weights.clone(), lengths.clone()])?);
        let corner = |k: usize| -> Result<Vec<Vec<f64>>, Error> {
            solved();
            let shares = training(k, stiff.len());
            let corner = mechanics(&placed(design, &stiff, &shares), &STATES[k % STATES.len()]);
            // as above
            let Some(model) = corner.ok().filter(|corner| corner.unknowns() == model.unknowns()) else { return Ok(Vec::new()) };
            let mut fields = model.adjoints(&[weights.clone(), lengths.clone()])?;
            fields.extend(model.displacements(&loads[..4.min(loads.len())])?);
            Ok(fields)
        };
        let corners = (0..effort.mechanics).into_par_iter().map(corner).collect::<Result<Vec<_>, _>>()?;
        displacements.extend(corners.into_iter().flatten());
        let component = |c: usize| {
            let columns: Vec<DVector<f64>> = displacements
                .iter()
                .map(|u| {
                    let mut laid = DVector::zeros(lattice.size());
                    shared.iter().enumerate().for_each(|(node, &of)| laid[grid.places()[of]] = u[2 * node + c]);
                    laid
                })
                .collect();
            Fields { width: lattice.width, values: DMatrix::from_columns(&columns) }
        };
        let raw = [component(0), component(1)];
        let kept = compressed(
            &structure::energy(&section, &strips, &raw, design)?,
            effort.least_displacement,
            effort.most_displacements,
        );
        let fields = raw.each_ref().map(|component| component.combined(&kept));
        let structure = Structure::new(&section, &strips, &fields, &temperatures);
        let samples = (0..SAMPLES)
            .filter_map(|k| {
                let design = placed(design, &ranges, &training(k, ranges.len()));
                let changed = Section::new(&design).ok().filter(|changed| section.stretched(changed).is_ok())?;
                Some((design, changed))
            })
            .collect::<Vec<_>>();
        let (heat, structure) = (heat.compressed(&samples)?, structure.compressed(&samples, &STATES)?);
        let turns = Turns::new(&grid, &temperatures, &fields, &winding)?;
        let mean = grid.coil_mean()?;
        let mut laid = vec![0.0; lattice.size()];
        grid.places().iter().zip(&mean).for_each(|(place, m)| laid[*place] = *m);
        let coil_mean = temperatures.apply(&laid);
        Ok(Self {
            design: design.clone(),
            ranges,
            resolution: *resolution,
            effort: *effort,
            section,
            grid,
            temperatures,
            heat,
            structure,
            turns,
            coil_mean,
        })
    }
}

/// Shares of the ranges at a training design: corners and points between, the same every time.
fn training(number: usize, dimension: usize) -> Vec<f64> {
    // the ends of the ranges matter most: the evenly spread points are pushed towards them
    point(number, dimension).into_iter().map(|x| (1.0 - (std::f64::consts::PI * x).cos()) / 2.0).collect()
}

impl Range {
    /// The value at a share of the range: even in the logarithm where both ends are positive and far apart, in x/(1 + x) where one is 0.
    pub fn at(&self, share: f64) -> f64 {
        let Self { low, high, .. } = *self;
        if low == 0.0 && high > 0.0 {
            // half of the shares lie below a twentieth of the end
            let middle = high / 20.0;
            let most = high / (high + middle);
            return middle * share * most / (1.0 - share * most);
        }
        if low > 0.0 && high / low > 1.5 { low * (high / low).powf(share) } else { low + (high - low) * share }
    }
}

impl Parameter {
    /// Whether it is a constant of an elastic law.
    fn is_elastic(self) -> bool {
        matches!(
            self,
            Self::AxialModulus
                | Self::TransverseModulus
                | Self::ShearRatio
                | Self::AxialPoisson
                | Self::TransversePoisson
                | Self::AxialExpansion
                | Self::TransverseExpansion
                | Self::SpoolModulus
                | Self::SpoolPoisson
                | Self::SpoolExpansion
        )
    }

    /// Whether the heat flow depends on it, other than in proportion.
    pub fn of_heat(self) -> bool {
        !self.is_elastic() && !matches!(self, Self::Heater(_)) && !self.of_winding()
    }

    /// Whether strain, or what the fibre makes of it, depends on it.
    pub fn of_mechanics(self) -> bool {
        self.is_elastic()
            || self.of_winding()
            || matches!(self, Self::HubThickness | Self::FlangeThickness | Self::FlangeOverhang)
    }
}
