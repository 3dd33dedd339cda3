//! A point in a mesh: values and gradients of a field there.

use crate::{Error, Grid, Region};

/// Nodes of the element (or elements) that hold a point, with values and gradients of their shape functions.
///
/// A point between elements takes the mean of their values: gradients jump there, and the mean keeps mirror symmetry.
#[derive(Debug, Clone)]
pub(crate) struct Probe {
    r: f64,
    nodes: Vec<usize>,
    value: Vec<f64>,
    d_r: Vec<f64>,
    d_y: Vec<f64>,
}

impl Grid {
    /// The point (r, y), which must lie in the mesh; a turn's centre (`field` "winding") in the coil. `field` is for the message.
    pub(crate) fn probe(&self, field: &str, r: f64, y: f64) -> Result<Probe, Error> {
        let mut hits = self.locate(r, y);
        if hits.is_empty() {
            return Err(Error::design(field, format!("the point r = {r} m, y = {y} m lies outside the mesh")));
        }
        if field == "winding" {
            hits.retain(|(element, _, _)| self.regions()[*element] == Region::Coil);
            if hits.is_empty() {
                let problem = format!("the turn at r = {r} m, y = {y} m lies outside the coil; enlarge the coil");
                return Err(Error::design(field, problem));
            }
        }
        let mut probe = Probe { r, nodes: Vec::new(), value: Vec::new(), d_r: Vec::new(), d_y: Vec::new() };
        let share = 1.0 / hits.len() as f64;
        for (element, xi, eta) in hits {
            let [value, d_r, d_y] = self.shape_functions(element, xi, eta);
            probe.nodes.extend(&self.mesh().elements()[element]);
            for (to, from) in [(&mut probe.value, value), (&mut probe.d_r, d_r), (&mut probe.d_y, d_y)] {
                to.extend(from.iter().map(|v| share * v));
            }
        }
        Ok(probe)
    }
}

impl Probe {
    /// Value of a nodal field.
    pub(crate) fn value_of(&self, field: &[f64]) -> f64 {
        self.nodes.iter().zip(&self.value).map(|(&node, v)| v * field[node]).sum()
    }

    /// Strains rr, yy, hoop of the displacement (u_r, u_y), component fastest.
    pub(crate) fn strain_of(&self, u: &[f64]) -> [f64; 3] {
        let mut strain = [0.0; 3];
        for (a, &node) in self.nodes.iter().enumerate() {
            strain[0] += self.d_r[a] * u[2 * node];
            strain[1] += self.d_y[a] * u[2 * node + 1];
            strain[2] += self.value[a] / self.r * u[2 * node];
        }
        strain
    }

    /// Adds `factor` times the value to a functional of a nodal field.
    pub(crate) fn add_value(&self, functional: &mut [f64], factor: f64) {
        for (a, &node) in self.nodes.iter().enumerate() {
            functional[node] += factor * self.value[a];
        }
    }

    /// Adds `factor · (s · strain)` to a functional of the displacement: the transpose of [`Self::strain_of`].
    pub(crate) fn add_strain(&self, functional: &mut [f64], factor: f64, s: [f64; 3]) {
        for (a, &node) in self.nodes.iter().enumerate() {
            functional[2 * node] += factor * (s[0] * self.d_r[a] + s[2] * self.value[a] / self.r);
            functional[2 * node + 1] += factor * s[1] * self.d_y[a];
        }
    }
}
