//! A layout and what its phases are made of.

use super::phase::{Phase, Solid};
use super::solve::Solution;
use crate::random::Random;
use crate::{Error, FibreCell, Role};
use fem_core::polynomial;
use rve_mesh::{Arrangement, Inclusion, Layout, LayoutError, Outline, periodic_mesh};

/// A periodic cell with its constituents.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Lattice, inclusions, matrix.
    pub layout: Layout,
    /// The phases the layout names by number.
    pub phases: Vec<Phase>,
}

impl Cell {
    /// The regular cell of [`crate::homogenize`] with `arrangement` in place of its lattice: phases are the rings from the inside out,
    /// last the adhesive.
    ///
    /// # Errors
    /// [`Error`] names the constituent or the geometry at fault.
    pub fn of_fibres(cell: &FibreCell, arrangement: &Arrangement) -> Result<Self, Error> {
        let fibre = |centre: &[f64; 2]| Inclusion {
            outlines: cell.rings.iter().map(|r| Outline::circle(*centre, r.outer_radius)).collect(),
            phases: (0..cell.rings.len()).map(Some).collect(),
        };
        let layout = Layout::new(arrangement.lattice, arrangement.centres.iter().map(fibre).collect(), cell.rings.len())?;
        let rings = cell.rings.iter().enumerate().map(|(i, r)| (format!("ring {i}"), &r.constituent, r.role));
        let mut phases = Vec::new();
        for (name, constituent, role) in rings.chain([("adhesive".into(), &cell.adhesive, Role::Coating)]) {
            let solid = Solid::isotropic(constituent);
            let solid = solid.map_err(|source| Error::Constituent { constituent: name.clone(), source })?;
            phases.push(Phase { name, solid, role });
        }
        Ok(Self { layout, phases })
    }

    /// Mean density \[kg/m³\], if that of every phase is known; voids weigh nothing.
    ///
    /// # Errors
    /// [`Error::Property`] of a density that is not positive; [`Error::NoPhase`].
    pub fn density(&self) -> Result<Option<f64>, Error> {
        self.mean("density", "kg/m³", |solid| solid.density)
    }

    /// Mean heat capacity of a volume \[J/(m³ K)\], voids included, if density and specific heat of every phase are known; the
    /// thermoelastic part is neglected, as in [`FibreCell::heat_capacity`].
    ///
    /// # Errors
    /// As [`Self::density`], also of a specific heat.
    pub fn heat_capacity(&self) -> Result<Option<f64>, Error> {
        self.density()?;
        self.mean("specific heat", "J/(kg K)", |solid| solid.specific_heat)?;
        self.mean("heat capacity", "J/(m³ K)", |solid| Some(solid.density? * solid.specific_heat?))
    }

    fn mean(&self, what: &'static str, unit: &'static str, of: impl Fn(&Solid) -> Option<f64>) -> Result<Option<f64>, Error> {
        self.check_phases()?;
        let mut sum = Some(0.0);
        for (phase, area) in self.phases.iter().zip(self.layout.phase_areas()).filter(|(_, area)| *area > 0.0) {
            let value = of(&phase.solid);
            if let Some(value) = value.filter(|v| !(v.is_finite() && *v > 0.0)) {
                return Err(Error::Property { constituent: phase.name.clone(), what, unit, value });
            }
            sum = sum.zip(value).map(|(sum, value)| sum + value * area / self.layout.area());
        }
        Ok(sum)
    }

    /// The same cell of solids that are a rounding off.
    pub(super) fn shaken(&self, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let phase = |phase: &Phase| Phase { solid: phase.solid.shaken(&mut random), ..phase.clone() };
        Self { phases: self.phases.iter().map(phase).collect(), ..self.clone() }
    }

    /// Every phase that the layout names must be there.
    fn check_phases(&self) -> Result<(), Error> {
        let of_inclusions = self.layout.inclusions().iter().enumerate();
        let named =
            of_inclusions.flat_map(|(i, inclusion)| inclusion.phases.iter().flatten().map(move |phase| (Some(i), *phase)));
        let phases = self.phases.len();
        match named.chain([(None, self.layout.matrix())]).find(|(_, phase)| *phase >= phases) {
            Some((inclusion, phase)) => {
                let place = inclusion.map_or_else(|| "the matrix".into(), |i| format!("inclusion {i}"));
                Err(Error::NoPhase { place, phase, phases })
            }
            None => Ok(()),
        }
    }

    /// Solves the cell problems on elements of polynomial `order`, at least 1; `fineness` 1 is the standard mesh.
    ///
    /// # Errors
    /// [`Error`] names the constituent or the inclusion at fault, or the mesh or solve that failed.
    pub fn solve(&self, order: usize, fineness: f64) -> Result<Solution, Error> {
        if order == 0 {
            return Err(LayoutError::Resolution("order = 0, but it must be at least 1; 4 and more are accurate".into()).into());
        }
        self.check_phases()?;
        self.phases.iter().try_for_each(|phase| phase.solid.check(&phase.name))?;
        if !self.phases.iter().any(|phase| phase.role == Role::Glass) {
            return Err(Error::NoGlass);
        }
        Solution::new(periodic_mesh(&self.layout, fineness, &polynomial::gauss_lobatto(order))?, &self.phases)
    }
}
