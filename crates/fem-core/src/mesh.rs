//! Quadrilateral meshes of any order: curved, isoparametric, one region number per element.

use crate::Error;

/// Quadrilaterals of polynomial order p with (p+1)² nodes each, on a tensor grid of Gauss–Lobatto points.
///
/// Node (i, j) of an element, i along ξ and j along η, is `elements[e][j * (p + 1) + i]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    order: usize,
    nodes: Vec<[f64; 2]>,
    elements: Vec<Vec<usize>>,
    regions: Vec<usize>,
}

impl Mesh {
    /// Checks the arrays against each other and takes them.
    ///
    /// `nodes` are positions \[m\]; `elements` list (order+1)² node numbers each; `regions` give each element's material.
    ///
    /// # Errors
    /// [`Error::Mesh`] if a length or a node number does not fit, or a coordinate is not finite.
    pub fn new(order: usize, nodes: Vec<[f64; 2]>, elements: Vec<Vec<usize>>, regions: Vec<usize>) -> Result<Self, Error> {
        if order == 0 {
            return Err(Error::Mesh("the polynomial order must be at least 1".into()));
        }
        let per_element = (order + 1) * (order + 1);
        if regions.len() != elements.len() {
            return Err(Error::Mesh(format!("{} regions for {} elements", regions.len(), elements.len())));
        }
        for (e, element) in elements.iter().enumerate() {
            if element.len() != per_element {
                return Err(Error::Mesh(format!("element {e} has {} nodes, order {order} needs {per_element}", element.len())));
            }
            if let Some(node) = element.iter().find(|&&node| node >= nodes.len()) {
                return Err(Error::Mesh(format!("element {e} names node {node}, there are {}", nodes.len())));
            }
        }
        if let Some(node) = nodes.iter().position(|p| !(p[0].is_finite() && p[1].is_finite())) {
            return Err(Error::Mesh(format!("node {node} is at {:?}", nodes[node])));
        }
        Ok(Self { order, nodes, elements, regions })
    }

    /// Polynomial order p.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Positions of the nodes \[m\].
    pub fn nodes(&self) -> &[[f64; 2]] {
        &self.nodes
    }

    /// Node numbers of each element, (p+1)² each, ξ fastest.
    pub fn elements(&self) -> &[Vec<usize>] {
        &self.elements
    }

    /// Region number of each element.
    pub fn regions(&self) -> &[usize] {
        &self.regions
    }

    /// One more than the largest region number.
    pub fn region_count(&self) -> usize {
        self.regions.iter().max().map_or(0, |r| r + 1)
    }
}
