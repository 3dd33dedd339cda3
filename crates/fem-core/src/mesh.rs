//! Quadrilateral meshes of any order: curved, isoparametric, one region number per element.

use crate::Error;
use crate::polynomial::gauss_lobatto;

/// A node lies on the axis of a body of revolution if its radius is less than this share of the largest one: rounding.
const ON_AXIS: f64 = 1e-12;

/// Region numbers are below this: each of them has an entry among the laws.
const MOST_REGIONS: usize = u32::MAX as usize;

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
    /// [`Error::Mesh`] if a length, a node number or a region number (2³² − 1 or more) does not fit, or a coordinate is not finite.
    pub fn new(order: usize, nodes: Vec<[f64; 2]>, elements: Vec<Vec<usize>>, regions: Vec<usize>) -> Result<Self, Error> {
        if order == 0 {
            return Err(Error::Mesh("the polynomial order must be at least 1".into()));
        }
        let per_element = (order + 1) * (order + 1);
        if regions.len() != elements.len() {
            return Err(Error::Mesh(format!("{} regions for {} elements", regions.len(), elements.len())));
        }
        if let Some(e) = regions.iter().position(|&region| region >= MOST_REGIONS) {
            return Err(Error::Mesh(format!("element {e} is of region {}; number the regions from 0", regions[e])));
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

    /// Rectangles between the breaks along x and along y \[m\], each increasing: cell (i, j) lies between breaks i and i + 1 along x and j and
    /// j + 1 along y. `region` gives its material, or `None` where the mesh has a hole. Elements are numbered along x first, and the nodes
    /// at breaks lie there exactly.
    ///
    /// ```
    /// // an L of two materials
    /// let region = |i, j| if (i, j) == (1, 1) { None } else { Some(j) };
    /// let mesh = fem_core::Mesh::rectangles(2, &[0.0, 1.0, 3.0], &[0.0, 1.0, 2.0], region)?;
    /// assert_eq!((mesh.regions(), mesh.nodes().len()), (&[0, 0, 1][..], 21));
    /// # Ok::<(), fem_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Mesh`] for order 0, fewer than two breaks, breaks that do not increase, or a region number of 2³² − 1 or more.
    pub fn rectangles(order: usize, x: &[f64], y: &[f64], region: impl Fn(usize, usize) -> Option<usize>) -> Result<Self, Error> {
        if order == 0 {
            return Err(Error::Mesh("the polynomial order must be at least 1".into()));
        }
        let [along_x, along_y] = [lines("x", x, order)?, lines("y", y, order)?];
        let width = along_x.len();
        let mut number = vec![None; width * along_y.len()];
        let (mut nodes, mut elements, mut regions) = (Vec::new(), Vec::new(), Vec::new());
        for (j, i) in (1..y.len()).flat_map(|j| (1..x.len()).map(move |i| (j - 1, i - 1))) {
            let Some(region) = region(i, j) else { continue };
            let mut node = |k: usize| {
                let (a, b) = (i * order + k % (order + 1), j * order + k / (order + 1));
                *number[b * width + a].get_or_insert_with(|| {
                    nodes.push([along_x[a], along_y[b]]);
                    nodes.len() - 1
                })
            };
            elements.push((0..(order + 1) * (order + 1)).map(&mut node).collect());
            regions.push(region);
        }
        Self::new(order, nodes, elements, regions)
    }

    /// Nodes on the axis x = 0 of a body of revolution.
    pub(crate) fn on_axis(&self) -> Vec<usize> {
        let largest = self.nodes.iter().fold(0.0, |most: f64, p| most.max(p[0].abs()));
        (0..self.nodes.len()).filter(|&node| self.nodes[node][0].abs() <= ON_AXIS * largest).collect()
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

    /// Small quadrilaterals between neighbouring nodes, p² for each element in its order: a mesh of straight sides for a file or a picture, with
    /// corners that go round once.
    pub fn quadrilaterals(&self) -> Vec<[usize; 4]> {
        let p = self.order;
        let of = |element: &Vec<usize>| {
            let at = |i: usize, j: usize| element[j * (p + 1) + i];
            let corners = |k: usize| {
                let (i, j) = (k % p, k / p);
                [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
            };
            (0..p * p).map(corners).collect::<Vec<_>>()
        };
        self.elements.iter().flat_map(of).collect()
    }

    /// One more than the largest region number.
    pub fn region_count(&self) -> usize {
        self.regions.iter().max().map_or(0, |r| r + 1)
    }
}

/// Positions of the nodes between `breaks`, Gauss–Lobatto points in each interval.
fn lines(axis: &str, breaks: &[f64], order: usize) -> Result<Vec<f64>, Error> {
    if breaks.len() < 2 || !breaks.windows(2).all(|pair| pair[0] < pair[1]) {
        return Err(Error::Mesh(format!("the breaks along {axis} must be at least two and increase, they are {breaks:?}")));
    }
    let lattice = gauss_lobatto(order);
    let within = |pair: &[f64]| {
        let (low, high) = (pair[0], pair[1]);
        lattice[..order].iter().map(|xi| low + (high - low) * (1.0 + xi) / 2.0).collect::<Vec<_>>()
    };
    Ok(breaks.windows(2).flat_map(within).chain(breaks.last().copied()).collect())
}
