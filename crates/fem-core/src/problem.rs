//! A weak form on a mesh: element matrices region by region, assembly, factor.

use crate::geometry::{Edge, ReferenceElement};
use crate::rectangle::{Coefficients, Rectangle};
use crate::{Condensed, DofMap, Error, Factor, Form, Mesh, Pattern, SparseMatrix};
use nalgebra::{DMatrix, DVector};

/// The load of a scalar nodal field on a form, kept element by element: `f = H T`, all unknowns, nothing eliminated.
#[derive(Debug, Clone)]
pub struct Coupling {
    components: usize,
    count: usize,
    nodes: Vec<Vec<usize>>,
    elements: Vec<DMatrix<f64>>,
}

impl Coupling {
    fn active(&self) -> impl Iterator<Item = (&Vec<usize>, &DMatrix<f64>)> {
        self.nodes.iter().zip(&self.elements).filter(|(_, m)| m.nrows() > 0)
    }

    /// H T: load vector (nodes × components, component fastest) of nodal values.
    ///
    /// # Panics
    /// If `field` has not one value for each node of the mesh.
    pub fn multiply(&self, field: &[f64]) -> Vec<f64> {
        assert!(field.len() == self.count, "a field of {} values for {} nodes", field.len(), self.count);
        let c = self.components;
        let mut load = vec![0.0; self.count * c];
        for (nodes, matrix) in self.active() {
            let product = matrix * DVector::from_iterator(nodes.len(), nodes.iter().map(|&node| field[node]));
            for (a, &node) in nodes.iter().enumerate() {
                (0..c).for_each(|i| load[node * c + i] += product[a * c + i]);
            }
        }
        load
    }

    /// Hᵀ u: what a displacement (nodes × components) says of each node's value.
    ///
    /// # Panics
    /// If `displacement` has not one entry for each component of each node of the mesh.
    pub fn multiply_transposed(&self, displacement: &[f64]) -> Vec<f64> {
        let (c, needed) = (self.components, self.count * self.components);
        assert!(displacement.len() == needed, "a displacement of {} entries, not {needed}", displacement.len());
        let mut result = vec![0.0; self.count];
        for (nodes, matrix) in self.active() {
            let local = nodes.iter().flat_map(|&node| &displacement[node * c..(node + 1) * c]);
            let product = matrix.tr_mul(&DVector::from_iterator(nodes.len() * c, local.copied()));
            nodes.iter().zip(product.iter()).for_each(|(&node, value)| result[node] += value);
        }
        result
    }
}

/// A form on a mesh with its quadrature.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    mesh: &'a Mesh,
    form: Form,
    points: usize,
    reference: ReferenceElement,
}

impl<'a> Problem<'a> {
    /// `form` on `mesh` with `points` Gauss points per direction.
    ///
    /// Order p needs p + 1 on straight elements, and on curved ones to reproduce uniform strains exactly in the plane; curved
    /// elements of a body of revolution need 3p/2 + 1 for that. One more than p + 1 suits gently curved elements. Without any point every
    /// integral is refused ([`Error::NoPoints`]).
    pub fn new(mesh: &'a Mesh, form: Form, points: usize) -> Self {
        Self { mesh, form, points, reference: ReferenceElement::new(mesh.order(), points) }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        self.mesh
    }

    /// Unknowns that the active regions use, for [`crate::Constraints::eliminate`].
    pub fn used(&self, active: impl Fn(usize) -> bool) -> Vec<bool> {
        let c = self.form.components;
        let mut used = vec![false; self.mesh.nodes().len() * c];
        for (element, &region) in self.mesh.elements().iter().zip(self.mesh.regions()) {
            if active(region) {
                element.iter().for_each(|node| used[node * c..(node + 1) * c].fill(true));
            }
        }
        used
    }

    /// The map must be of this form on this mesh, and hold the axis of a body of revolution where an element that is `active` touches it.
    fn check_map(&self, map: &DofMap, active: impl Fn(usize) -> bool) -> Result<(), Error> {
        let components = self.form.components;
        let (found, needed) = (map.full(), self.mesh.nodes().len() * components);
        if found != needed {
            return Err(Error::Map { found, needed, components });
        }
        let Some(component) = self.form.over_radius() else { return Ok(()) };
        let free: Vec<usize> =
            self.mesh.on_axis().into_iter().filter(|node| map.get(node * components + component).is_some()).collect();
        let touched = |node: &usize| self.mesh.elements().iter().enumerate().any(|(e, nodes)| active(e) && nodes.contains(node));
        match free.into_iter().find(touched) {
            Some(node) => Err(Error::Axis { node }),
            None => Ok(()),
        }
    }

    fn has_law<'m>(&'m self, laws: &'m [Option<DMatrix<f64>>]) -> impl Fn(usize) -> bool {
        |e| laws[self.mesh.regions()[e]].is_some()
    }

    fn check_points(&self) -> Result<(), Error> {
        if self.points == 0 { Err(Error::NoPoints) } else { Ok(()) }
    }

    /// Each region of the mesh must have an entry; those that are not `None` must have `rows` rows and, if given, `columns` columns.
    fn check(&self, laws: &[Option<DMatrix<f64>>], rows: usize, columns: Option<usize>) -> Result<(), Error> {
        self.check_points()?;
        let needed = || format!("{rows} × {}", columns.map_or("any".into(), |c| c.to_string()));
        let regions = self.mesh.region_count();
        if laws.len() < regions {
            return Err(Error::MissingLaw { laws: laws.len(), regions });
        }
        match laws.iter().position(|l| l.as_ref().is_some_and(|l| l.nrows() != rows || columns.is_some_and(|c| l.ncols() != c))) {
            None => Ok(()),
            Some(region) => {
                let found = laws[region].as_ref().map_or(String::new(), |l| format!("{} × {}", l.nrows(), l.ncols()));
                Err(Error::Law { region, found, needed: needed() })
            }
        }
    }

    /// Matrix of each element, one at a time, empty where the region has no law: on rectangles from `coefficients` of the law, on any
    /// other shape from its geometry.
    fn element_matrices<'m, C>(
        &'m self,
        laws: &'m [Option<DMatrix<f64>>],
        coefficients: impl Fn(&'m DMatrix<f64>) -> C,
        on_rectangle: impl Fn(&Rectangle, &C) -> DMatrix<f64> + 'm,
        matrix: impl Fn(&crate::ElementGeometry, &'m DMatrix<f64>) -> DMatrix<f64> + 'm,
    ) -> impl Iterator<Item = Result<DMatrix<f64>, Error>> {
        let coefficients: Vec<Option<C>> = laws.iter().map(|law| law.as_ref().map(&coefficients)).collect();
        let per_element = move |(e, &region): (usize, &usize)| match (&laws[region], &coefficients[region]) {
            (Some(law), Some(coefficients)) => match self.rectangle(e) {
                Some(rectangle) => Ok(on_rectangle(&rectangle, coefficients)),
                None => Ok(matrix(&self.reference.geometry(self.mesh, e, self.form.measure)?, law)),
            },
            _ => Ok(DMatrix::zeros(0, 0)),
        };
        self.mesh.regions().iter().enumerate().map(per_element)
    }

    fn rectangle(&self, e: usize) -> Option<Rectangle> {
        Rectangle::new(&self.reference, self.mesh, e, self.form.measure)
    }

    fn stiffnesses<'m>(
        &'m self,
        laws: &'m [Option<DMatrix<f64>>],
    ) -> Result<impl Iterator<Item = Result<DMatrix<f64>, Error>>, Error> {
        self.check(laws, self.form.strains, Some(self.form.strains))?;
        let unfit = |(region, law): (usize, &Option<DMatrix<f64>>)| Some((region, not_symmetric(law.as_ref()?)?));
        if let Some((region, found)) = laws.iter().enumerate().find_map(unfit) {
            let needed = "a symmetric matrix of finite numbers".to_owned();
            return Err(Error::Law { region, found: found.to_owned(), needed });
        }
        let coefficients = |law| Coefficients::stiffness(self.form, law);
        let general = |g: &crate::ElementGeometry, law: &DMatrix<f64>| self.form.stiffness(&self.reference.value, g, law);
        Ok(self.element_matrices(laws, coefficients, Rectangle::stiffness, general))
    }

    /// Stiffness matrix. `laws[region]` is the constitutive matrix (strains × strains), symmetric and positive definite, `None` where the region takes no part.
    ///
    /// # Errors
    /// [`Error::Law`] and [`Error::MissingLaw`] if the constants do not fit, [`Error::Map`] if the map does not; [`Error::Axis`] if a body of
    /// revolution touches its axis and is not held there; [`Error::Mesh`] if an element is turned inside out; [`Error::NoPoints`].
    pub fn stiffness(&self, map: &DofMap, laws: &[Option<DMatrix<f64>>]) -> Result<SparseMatrix, Error> {
        let elements = self.stiffnesses(laws)?;
        self.check_map(map, self.has_law(laws))?;
        let elements: Vec<_> = elements.collect::<Result<_, _>>()?;
        Ok(self.pattern(map, laws).assemble(&elements))
    }

    /// Stiffness matrix, factorised.
    ///
    /// # Errors
    /// As [`Self::stiffness`] and [`Factor::new`].
    pub fn factor(&self, map: &DofMap, laws: &[Option<DMatrix<f64>>]) -> Result<Factor, Error> {
        Factor::new(self.stiffness(map, laws)?)
    }

    /// Stiffness matrix with the unknowns inside elements eliminated, factorised.
    ///
    /// # Errors
    /// As [`Self::stiffness`] and [`Condensed::new`].
    pub fn condense(&self, map: &DofMap, laws: &[Option<DMatrix<f64>>]) -> Result<Condensed, Error> {
        let elements = self.stiffnesses(laws)?;
        self.check_map(map, self.has_law(laws))?;
        Condensed::assemble(self.mesh, map, self.has_law(laws), elements)
    }

    /// As [`Self::condense`], of the sum of this stiffness and that of `fewer`, the same form on the same mesh with fewer Gauss points
    /// and laws of its own: selective reduced integration. A nearly incompressible solid of low order does not lock if its volumetric
    /// part, `λ` times the square of the dilatation, is integrated with one point per direction fewer than p + 1.
    ///
    /// D. S. Malkus and T. J. R. Hughes, *Comput. Methods Appl. Mech. Eng.* 15, 63 (1978).
    ///
    /// # Errors
    /// As [`Self::condense`].
    pub fn condense_selective(
        &self,
        map: &DofMap,
        laws: &[Option<DMatrix<f64>>],
        fewer: &Problem,
        volumetric: &[Option<DMatrix<f64>>],
    ) -> Result<Condensed, Error> {
        let sums = self.stiffnesses(laws)?.zip(fewer.stiffnesses(volumetric)?).map(|(a, b)| Ok(a? + b?));
        self.check_map(map, self.has_law(laws))?;
        Condensed::assemble(self.mesh, map, self.has_law(laws), sums)
    }

    fn pattern(&self, map: &DofMap, laws: &[Option<DMatrix<f64>>]) -> Pattern {
        Pattern::new(self.mesh, map, self.has_law(laws))
    }

    /// Full load vectors `∫ Bᵀ σ_j`. `stresses[region]` has one column per load (strains × loads), or is `None`.
    ///
    /// # Errors
    /// As [`Self::stiffness`].
    pub fn loads(&self, stresses: &[Option<DMatrix<f64>>]) -> Result<Vec<Vec<f64>>, Error> {
        self.check(stresses, self.form.strains, None)?;
        let count = stresses.iter().flatten().map(|s| s.ncols()).max().unwrap_or(0);
        let c = self.form.components;
        let mut loads = vec![vec![0.0; self.mesh.nodes().len() * c]; count];
        let general = |g: &crate::ElementGeometry, stresses: &DMatrix<f64>| {
            let columns = stresses.column_iter().map(|s| self.form.load(&self.reference.value, g, s.as_slice()));
            DMatrix::from_columns(&columns.collect::<Vec<_>>())
        };
        let elements = self.element_matrices(stresses, |s| Coefficients::loads(self.form, s), Rectangle::loads, general);
        for (nodes, element) in self.mesh.elements().iter().zip(elements) {
            for (load, f) in loads.iter_mut().zip(element?.column_iter()) {
                for (a, node) in nodes.iter().enumerate() {
                    (0..c).for_each(|i| load[node * c + i] += f[a * c + i]);
                }
            }
        }
        Ok(loads)
    }

    /// Coupling of a scalar nodal field into this form: `laws[region]` is the column β (strains × 1) by which a unit of the
    /// field stresses the region.
    ///
    /// # Errors
    /// As [`Self::stiffness`].
    pub fn coupling(&self, laws: &[Option<DMatrix<f64>>]) -> Result<Coupling, Error> {
        self.check(laws, self.form.strains, Some(1))?;
        let general =
            |g: &crate::ElementGeometry, law: &DMatrix<f64>| self.form.coupling(&self.reference.value, g, law.as_slice());
        let coefficients = |law| Coefficients::loads(self.form, law);
        let elements = self.element_matrices(laws, coefficients, Rectangle::coupling, general).collect::<Result<_, _>>()?;
        let nodes: Vec<_> = self.mesh.elements().to_vec();
        Ok(Coupling { components: self.form.components, count: self.mesh.nodes().len(), nodes, elements })
    }

    fn masses<'m>(
        &'m self,
        capacities: &'m [Option<DMatrix<f64>>],
    ) -> Result<impl Iterator<Item = Result<DMatrix<f64>, Error>>, Error> {
        self.check(capacities, 1, Some(1))?;
        let components = self.form.components;
        let each = move |mass: DMatrix<f64>| {
            if components == 1 { mass } else { mass.kronecker(&DMatrix::identity(components, components)) }
        };
        let on_rectangle = move |r: &Rectangle, c: &f64| each(r.mass() * *c);
        let mass = move |g: &crate::ElementGeometry, c: &DMatrix<f64>| each(Form::mass(&self.reference.value, g, c[0]));
        Ok(self.element_matrices(capacities, |c| c[0], on_rectangle, mass))
    }

    /// Mass matrix, `∫ N c N` for each component: `capacities[region]` is 1 × 1.
    ///
    /// # Errors
    /// As [`Self::stiffness`].
    pub fn mass(&self, map: &DofMap, capacities: &[Option<DMatrix<f64>>]) -> Result<SparseMatrix, Error> {
        let elements = self.masses(capacities)?;
        // a mass does not ask whether the axis is held
        self.check_map(map, |_| false)?;
        let elements: Vec<_> = elements.collect::<Result<_, _>>()?;
        Ok(self.pattern(map, capacities).assemble(&elements))
    }

    /// Stiffness plus `rate` times the mass, plus the boundary mass over the `edges` (element, edge, h), with the unknowns inside elements
    /// eliminated, factorised: a diffusion's response to a drive that grows as e^(rate t).
    ///
    /// # Errors
    /// As [`Self::condense`] and [`Self::boundary_mass`].
    pub fn condense_shifted(
        &self,
        map: &DofMap,
        laws: &[Option<DMatrix<f64>>],
        capacities: &[Option<DMatrix<f64>>],
        rate: f64,
        edges: &[(usize, Edge, f64)],
    ) -> Result<Condensed, Error> {
        let both = self.stiffnesses(laws)?.zip(self.masses(capacities)?).enumerate();
        self.check_map(map, self.has_law(laws))?;
        self.check_edges(edges)?;
        let sums = both.map(|(e, (stiffness, mass))| {
            let mut sum = stiffness? + mass? * rate;
            for &(_, edge, h) in edges.iter().filter(|(at, ..)| *at == e) {
                sum += self.reference.edge_mass(self.mesh, e, edge, self.form.measure) * h;
            }
            Ok(sum)
        });
        Condensed::assemble(self.mesh, map, self.has_law(laws), sums)
    }

    /// Edges must be of elements of the mesh, and the form a scalar one.
    fn check_edges(&self, edges: &[(usize, Edge, f64)]) -> Result<(), Error> {
        let (components, elements) = (self.form.components, self.mesh.elements().len());
        if !edges.is_empty() && components != 1 {
            return Err(Error::Edges(format!(
                "a flux through edges is of a scalar form, this one has {components} unknowns for each node; a pressure is the surface_load of \
                 a scalar form on the same mesh, each node's entry put to the component that it pushes"
            )));
        }
        match edges.iter().find(|(e, ..)| *e >= elements) {
            Some((e, ..)) => Err(Error::Edges(format!("element {e} is named, the mesh has {elements}, numbered from 0"))),
            None => Ok(()),
        }
    }

    /// Boundary mass `∫ N h N ds` of a scalar form over the given (element, edge, h), on the pattern of the whole mesh.
    ///
    /// # Errors
    /// [`Error::Edges`] if the form has several unknowns for each node or there is no such element; [`Error::Map`].
    pub fn boundary_mass(&self, map: &DofMap, edges: &[(usize, Edge, f64)]) -> Result<SparseMatrix, Error> {
        self.check_map(map, |_| false)?;
        self.check_edges(edges)?;
        Ok(self.edge_mass(map, edges))
    }

    /// Full load vector of a source per volume, `∫ N q`, alike in all components: `sources[region]` is 1 × 1 \[W/m³ of heat\], or is `None`.
    /// [`DofMap::restrict`] makes the load of the unknowns of it.
    ///
    /// # Errors
    /// As [`Self::stiffness`].
    pub fn source(&self, sources: &[Option<DMatrix<f64>>]) -> Result<Vec<f64>, Error> {
        let mut load = self.no_load();
        for (e, element) in self.masses(sources)?.enumerate() {
            self.add(&mut load, e, &element?);
        }
        Ok(load)
    }

    /// Full load vector of a flux per area into edges, `∫ N q ds`, of a scalar form: (element, edge, q \[W/m² of heat\]). For a surface that exchanges heat
    /// with a medium, q = h T₀.
    ///
    /// # Errors
    /// [`Error::Edges`] as [`Self::boundary_mass`].
    pub fn surface_load(&self, edges: &[(usize, Edge, f64)]) -> Result<Vec<f64>, Error> {
        self.check_edges(edges)?;
        let mut load = self.no_load();
        for &(e, edge, q) in edges {
            self.add(&mut load, e, &(self.reference.edge_mass(self.mesh, e, edge, self.form.measure) * q));
        }
        Ok(load)
    }

    fn no_load(&self) -> Vec<f64> {
        vec![0.0; self.mesh.nodes().len() * self.form.components]
    }

    /// Adds what an element's mass makes of one everywhere; of an element without a mass nothing.
    fn add(&self, load: &mut [f64], e: usize, mass: &DMatrix<f64>) {
        let (c, sums) = (self.form.components, mass.column_sum());
        for (a, node) in self.mesh.elements()[e].iter().enumerate().filter(|_| !mass.is_empty()) {
            (0..c).for_each(|i| load[node * c + i] += sums[a * c + i]);
        }
    }

    /// As [`Self::boundary_mass`], of edges and a map that are known to fit.
    ///
    /// # Panics
    /// Where [`Self::boundary_mass`] returns an error.
    pub fn edge_mass(&self, map: &DofMap, edges: &[(usize, Edge, f64)]) -> SparseMatrix {
        let nodes = (self.mesh.order() + 1).pow(2);
        let mut elements = vec![DMatrix::zeros(nodes, nodes); self.mesh.elements().len()];
        for &(e, edge, h) in edges {
            elements[e] += self.reference.edge_mass(self.mesh, e, edge, self.form.measure) * h;
        }
        Pattern::new(self.mesh, map, |_| true).assemble(&elements)
    }

    /// Area (or volume of revolution) of each region \[m² or m³\].
    ///
    /// # Errors
    /// [`Error::Mesh`] if an element is turned inside out; [`Error::NoPoints`].
    pub fn region_measures(&self) -> Result<Vec<f64>, Error> {
        self.check_points()?;
        self.reference.region_measures(self.mesh, self.form.measure)
    }

    /// Strains of a full vector of unknowns in element `e` at (ξ, η), in the order of the form: gradients of a temperature, strains of a displacement (shear as the
    /// engineering strain). A stress is stiffness × strain − thermal stress × temperature rise. Where elements meet, strains jump: the element says which side.
    /// On the axis of a body of revolution the hoop strain is 0/0: take a point beside it.
    ///
    /// # Panics
    /// If there is no such element, or `u` has not one value for each component of each node.
    pub fn strain(&self, u: &[f64], e: usize, xi: f64, eta: f64) -> Vec<f64> {
        let (components, nodes) = (self.form.components, self.mesh.nodes());
        assert!(u.len() == nodes.len() * components, "{} values for {} nodes of {components} components", u.len(), nodes.len());
        let element = &self.mesh.elements()[e];
        let [value, dx, dy] = self.at_point(e, xi, eta);
        let x: f64 = element.iter().zip(&value).map(|(&node, value)| value * nodes[node][0]).sum();
        let own: Vec<f64> =
            element.iter().flat_map(|&node| u[node * components..(node + 1) * components].iter().copied()).collect();
        self.form.strain([&value, &dx, &dy], x, &own)
    }

    /// Values and gradients of the shape functions of element `e` at (ξ, η): see [`ReferenceElement::at_point`].
    pub fn at_point(&self, e: usize, xi: f64, eta: f64) -> [Vec<f64>; 3] {
        self.reference.at_point(self.mesh, e, xi, eta)
    }
}

/// Largest difference of two entries that should be the same, of the largest entry: constants from an inverse are symmetric to rounding.
const SYMMETRIC: f64 = 1e-6;

/// In words, the fault of a law that is no symmetric matrix of finite numbers.
fn not_symmetric(law: &DMatrix<f64>) -> Option<&'static str> {
    if law.iter().any(|entry| !entry.is_finite()) {
        return Some("an entry is not finite");
    }
    let is_off = (law - law.transpose()).amax() > SYMMETRIC * law.amax();
    is_off.then_some("a matrix that is not symmetric")
}
