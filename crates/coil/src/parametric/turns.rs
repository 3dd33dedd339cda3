//! The turns of a parametric model's designs: their temperature and strain, wherever the winding begins.

use super::project::Fields;
use crate::probe::{Probe, Prober, Sums};
use crate::{Error, Grid, Region};
use nalgebra::{DMatrix, DVector};
use winding::{Turn, Winding};

/// Displacement of the coil in every field, and sums over the turns of the design that was modelled.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Turns {
    /// components along r and y, a row for each of [`coil_nodes`], a column for each field
    displacement: [DMatrix<f64>; 2],
    /// sums with the weights of the turns
    pub(super) weighted: Weighted,
    /// sums with their lengths
    pub(super) lengths: Weighted,
}

/// The fibre of a changed design: its length with tails \[m\], the weight of those \[m²\], and sums over its turns.
pub(super) struct Fibre {
    pub(super) length: f64,
    pub(super) tail_weight: f64,
    pub(super) sums: Weighted,
}

/// Sums over turns: of temperature fields, and of the strains rr, yy, hoop of displacement fields.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Weighted {
    pub(super) temperature: DVector<f64>,
    pub(super) strains: [DVector<f64>; 3],
}

impl Weighted {
    /// Their sum with a factor each.
    pub(super) fn combined(terms: &[(f64, &Self)]) -> Self {
        let sum = |of: &dyn Fn(&Self) -> &DVector<f64>| {
            let mut sum = DVector::zeros(terms.first().map_or(0, |(_, first)| of(first).len()));
            terms.iter().for_each(|(factor, term)| sum.axpy(*factor, of(term), 1.0));
            sum
        };
        Self { temperature: sum(&|w| &w.temperature), strains: [0, 1, 2].map(|k: usize| sum(&|w| &w.strains[k])) }
    }
}

/// Nodes of the coil's elements, in increasing order.
fn coil_nodes(grid: &Grid) -> Vec<usize> {
    let of_coil = grid.regions().iter().zip(grid.mesh().elements()).filter(|(region, _)| **region == Region::Coil);
    let mut nodes: Vec<usize> = of_coil.flat_map(|(_, nodes)| nodes.iter().copied()).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Centres of the turns in a mesh.
fn probes(grid: &Grid, winding: &Winding) -> Result<Vec<Probe>, Error> {
    let mut prober = Prober::new(grid);
    winding.turns().iter().map(|turn| prober.probe("winding", turn.r, turn.y)).collect()
}

/// Sums over turns with a weight each; displacements as [`Turns`] has them.
fn sums([u_r, u_y]: &[DMatrix<f64>; 2], grid: &Grid, temperatures: &Fields, probes: &[Probe], weights: Vec<f64>) -> Weighted {
    let nodes = coil_nodes(grid);
    let sums = Sums::new(probes, weights, grid.mesh().nodes().len());
    let on_coil = |functional: &[f64]| DVector::from_iterator(nodes.len(), nodes.iter().map(|&node| functional[node]));
    let mut laid = vec![0.0; temperatures.values.nrows()];
    nodes.iter().for_each(|&node| laid[grid.places()[node]] = sums.value[node]);
    let strains = [u_r.tr_mul(&on_coil(&sums.d_r)), u_y.tr_mul(&on_coil(&sums.d_y)), u_r.tr_mul(&on_coil(&sums.over_r))];
    Weighted { temperature: temperatures.apply(&laid), strains }
}

impl Turns {
    /// Of fields of temperature and of displacement (components along r and y) on the lattice of `grid`.
    pub(super) fn new(grid: &Grid, temperatures: &Fields, displacements: &[Fields; 2], winding: &Winding) -> Result<Self, Error> {
        let nodes = coil_nodes(grid);
        let within = |fields: &Fields| -> DMatrix<f64> {
            DMatrix::from_fn(nodes.len(), fields.values.ncols(), |row, field| fields.values[(grid.places()[nodes[row]], field)])
        };
        let (displacement, probes) = (displacements.each_ref().map(within), probes(grid, winding)?);
        let of = |weights: Vec<f64>| sums(&displacement, grid, temperatures, &probes, weights);
        let (weighted, lengths) = (of(winding.weights()), of(winding.turns().iter().map(Turn::length).collect()));
        Ok(Self { displacement, weighted, lengths })
    }

    /// Number of fields of displacement.
    pub(super) fn displacements(&self) -> usize {
        self.displacement[0].ncols()
    }

    /// Numbers that it holds.
    pub(super) fn numbers(&self) -> usize {
        self.displacement.iter().map(DMatrix::len).sum()
    }

    /// Sums with the weights of another winding's turns.
    pub(super) fn elsewhere(&self, grid: &Grid, temperatures: &Fields, winding: &Winding) -> Result<Weighted, Error> {
        Ok(sums(&self.displacement, grid, temperatures, &probes(grid, winding)?, winding.weights()))
    }

    /// Temperature and strains rr, yy, hoop of every turn of `winding`, for each of some combinations of the fields of temperature and of displacement.
    pub(super) fn values(
        &self,
        grid: &Grid,
        temperatures: &Fields,
        [of_temperature, of_displacement]: [&DMatrix<f64>; 2],
        winding: &Winding,
    ) -> Result<[DMatrix<f64>; 4], Error> {
        let (probes, nodes) = (probes(grid, winding)?, coil_nodes(grid));
        let mut values = [0, 1, 2, 3].map(|_| DMatrix::zeros(probes.len(), of_temperature.ncols()));
        let mut temperature = vec![0.0; grid.mesh().nodes().len()];
        let mut displacement = vec![0.0; 2 * temperature.len()];
        let laid = &temperatures.values * of_temperature;
        let moved = self.displacement.each_ref().map(|component| component * of_displacement);
        for k in 0..of_temperature.ncols() {
            for (row, &node) in nodes.iter().enumerate() {
                temperature[node] = laid[(grid.places()[node], k)];
                [displacement[2 * node], displacement[2 * node + 1]] = [moved[0][(row, k)], moved[1][(row, k)]];
            }
            for (turn, probe) in probes.iter().enumerate() {
                let [rr, yy, hoop] = probe.strain_of(&displacement);
                let all = [probe.value_of(&temperature), rr, yy, hoop];
                values.iter_mut().zip(all).for_each(|(values, value)| values[(turn, k)] = value);
            }
        }
        Ok(values)
    }
}
