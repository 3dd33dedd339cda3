//! Mean, least and largest strain of each phase.

use super::{Component, Convention, Fields, State};
use crate::Error;
use crate::irregular::Phase;
use fem_core::{Measure, ReferenceElement};

/// Mean and range of one component in one phase. NaN where the component has no meaning (radial and hoop in the matrix).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Area mean.
    pub mean: f64,
    /// Least value at the points of a grid in each element.
    pub least: f64,
    /// Largest value there.
    pub most: f64,
}

/// Strains of one phase under the load.
#[derive(Debug, Clone, PartialEq)]
pub struct PhaseStrain {
    /// Phase number.
    pub phase: usize,
    /// Area \[m²\].
    pub area: f64,
    /// By component, then by convention.
    spreads: Vec<[Spread; 2]>,
}

const CONVENTIONS: [Convention; 2] = [Convention::Total, Convention::Mechanical];

impl PhaseStrain {
    /// A component in a convention.
    pub fn get(&self, component: Component, convention: Convention) -> Spread {
        self.spreads[component as usize][usize::from(convention == Convention::Mechanical)]
    }

    fn each(&mut self, state: &State, mut f: impl FnMut(&mut Spread, f64)) {
        for (spreads, component) in self.spreads.iter_mut().zip(Component::ALL) {
            for (spread, convention) in spreads.iter_mut().zip(CONVENTIONS) {
                if let Some(value) = component.of(state.strain(convention), state.axis) {
                    f(spread, value);
                }
            }
        }
    }
}

impl Fields<'_> {
    /// Strains of each phase that has an area, in the order of their numbers.
    ///
    /// # Errors
    /// [`Error::Solve`] if an element is turned inside out, which a solved mesh does not have.
    pub fn summary(&self) -> Result<Vec<PhaseStrain>, Error> {
        let phases: &[Phase] = &self.solution.phases;
        let nothing = Spread { mean: 0.0, least: f64::INFINITY, most: f64::NEG_INFINITY };
        let empty = |phase| PhaseStrain { phase, area: 0.0, spreads: vec![[nothing; 2]; Component::ALL.len()] };
        let mut all: Vec<_> = (0..phases.len()).map(empty).collect();
        let mesh = &self.solution.mesh;
        let reference = ReferenceElement::new(mesh.order(), mesh.order() + 2);
        for (e, &phase) in mesh.regions().iter().enumerate() {
            let g = reference.geometry(mesh, e, Measure::Area)?;
            for (k, weight) in g.weight.iter().enumerate() {
                let [value, dx, dy] = [reference.value.column(k), g.d_x.column(k), g.d_y.column(k)];
                let state = self.state(e, [value.as_slice(), dx.as_slice(), dy.as_slice()]);
                all[phase].each(&state, |spread, value| spread.mean += weight * value);
                all[phase].area += weight;
            }
        }
        for state in &self.sample(mesh.order() + 2).states {
            all[state.phase].each(state, |spread, value| {
                (spread.least, spread.most) = (spread.least.min(value), spread.most.max(value));
            });
        }
        all.retain(|phase| phase.area > 0.0);
        for phase in &mut all {
            for spread in phase.spreads.iter_mut().flatten() {
                let known = spread.least <= spread.most;
                let nan = Spread { mean: f64::NAN, least: f64::NAN, most: f64::NAN };
                *spread = if known { Spread { mean: spread.mean / phase.area, ..*spread } } else { nan };
            }
        }
        Ok(all)
    }
}
