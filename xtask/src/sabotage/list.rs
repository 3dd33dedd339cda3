//! The sabotages: what a distrustful reader would break to see whether a test notices.

use proof::Failure;
use proof::files::read;
use std::path::Path;

/// The crates under test, each after those it depends on.
pub(super) const CRATES: [&str; 3] = ["fem-core", "rve-mesh", "homogenization"];

pub(super) struct Sabotage {
    /// The fault that it makes.
    pub(super) name: &'static str,
    /// The file, in the workspace.
    pub(super) file: &'static str,
    /// The text that is replaced; it must be there exactly once.
    pub(super) find: &'static str,
    pub(super) replace: &'static str,
}

impl Sabotage {
    /// The file's text with the change made.
    pub(super) fn apply(&self, root: &Path) -> Result<String, Failure> {
        let text = read(&root.join(self.file))?;
        match text.matches(self.find).count() {
            1 => Ok(text.replacen(self.find, self.replace, 1)),
            count => Err(Failure(format!(
                "sabotage \"{}\" is stale: {} holds its text {count} times instead of once; mend xtask/src/sabotage/list.rs",
                self.name, self.file
            ))),
        }
    }

    /// The crates whose tests it may turn red.
    pub(super) fn reach(&self) -> &'static [&'static str] {
        let of_file = |name: &&str| self.file.starts_with(&format!("crates/{name}/"));
        &CRATES[CRATES.iter().position(of_file).unwrap_or(0)..]
    }
}

/// Nodes of every element moved onto the straight lines between its corners, given `nodes`, `elements`, `order` and `lattice`.
macro_rules! straightened {
    () => {
        "    let (curved, at) = (nodes.clone(), |k: usize| (1.0 + lattice[k]) / 2.0);
    for element in elements.iter() {
        for (k, &node) in element.iter().enumerate() {
            let (i, j) = (at(k % (order + 1)), at(k / (order + 1)));
            let corner = |a: usize, b: usize| curved[element[(b * (order + 1) + a) * order]];
            let side = |b: usize, c: usize| (1.0 - i) * corner(0, b)[c] + i * corner(1, b)[c];
            nodes[node] = [0, 1].map(|c| (1.0 - j) * side(0, c) + j * side(1, c));
        }
    }
"
    };
}

/// In the order of [`CRATES`] from the last, so that little is built anew from one to the next.
pub(super) const LIST: &[Sabotage] = &[
    Sabotage {
        name: "Voigt: shear strain along the fibre counted once (finite elements)",
        file: "crates/homogenization/src/solve.rs",
        find: "|i, j| l.stiffness[(4 - i, 4 - j)])",
        replace: "|i, j| l.stiffness[(4 - i, 4 - j)] / 2.0)",
    },
    Sabotage {
        name: "rings swapped: their solids from the outside in",
        file: "crates/homogenization/src/cell.rs",
        find: "self.rings.iter().map(|ring| &ring.constituent).chain([&self.adhesive])",
        replace: "self.rings.iter().rev().map(|ring| &ring.constituent).chain([&self.adhesive])",
    },
    Sabotage {
        name: "thermal term missing (finite elements)",
        file: "crates/homogenization/src/solve.rs",
        find: "if load == 4 { -law.thermal_stress } else",
        replace: "if load == 4 { law.thermal_stress * 0.0 } else",
    },
    Sabotage {
        name: "thermal term missing (multipoles)",
        file: "crates/homogenization/src/multipole/plane.rs",
        find: "stress: [lambda, -phases.laws[i].thermal_stress[0]]",
        replace: "stress: [lambda, 0.0]",
    },
    Sabotage {
        name: "sign of the thermal term (cells without symmetry)",
        file: "crates/homogenization/src/irregular/solve.rs",
        find: "if load == TEMPERATURE { -law.thermal_stress } else",
        replace: "if load == TEMPERATURE { law.thermal_stress } else",
    },
    Sabotage {
        name: "sign of the half-turn pairs (quarter cell)",
        file: "crates/homogenization/src/solve.rs",
        find: "constraints.tie(slave * components + c, master * components + c, -1.0)?;",
        replace: "constraints.tie(slave * components + c, master * components + c, 1.0)?;",
    },
    Sabotage {
        name: "one periodic pair dropped (cells without symmetry)",
        file: "crates/homogenization/src/irregular/solve.rs",
        find: "for [copy, original] in &self.periodic.periodic {",
        replace: "for [copy, original] in self.periodic.periodic.iter().skip(1) {",
    },
    Sabotage {
        name: "shear loads with the symmetry of the normal ones (quarter cell)",
        file: "crates/homogenization/src/solve.rs",
        find: "Class { loads: odd, on_mirror_x: other, on_mirror_y: Some(0) }",
        replace: "Class { loads: odd, on_mirror_x: Some(0), on_mirror_y: other }",
    },
    Sabotage {
        name: "two Gauss points too few for the stiffness in the plane",
        file: "crates/homogenization/src/solve.rs",
        find: "fn plane(&self, effective: &mut Effective) -> Result<(), Error> {
        let problem = Problem::new(&self.mesh, Form::PLANE_STRAIN, self.mesh.order() + 2);",
        replace: "fn plane(&self, effective: &mut Effective) -> Result<(), Error> {
        let problem = Problem::new(&self.mesh, Form::PLANE_STRAIN, self.mesh.order());",
    },
    Sabotage {
        name: "selective integration of the shear too",
        file: "crates/homogenization/src/solve.rs",
        find: "laws.iter().map(|d| Self::volumetric(&[d[(0, 1)], d[(0, 1)], 0.0])).collect();",
        replace: "laws.clone();",
    },
    Sabotage {
        name: "glass's mean strain over the coatings too",
        file: "crates/homogenization/src/cell.rs",
        find: "cell.rings.iter().map(|r| r.role == Role::Glass)",
        replace: "cell.rings.iter().map(|_| true)",
    },
    Sabotage {
        name: "multipoles: sign of the lattice sums of conjugates",
        file: "crates/homogenization/src/multipole/lattice.rs",
        find: "-4.0 * tau[1] * sign",
        replace: "4.0 * tau[1] * sign",
    },
    Sabotage {
        name: "multipoles: index of the lattice sums, two too high",
        file: "crates/homogenization/src/multipole/system.rs",
        find: "sums.s(n + m)",
        replace: "sums.s(n + m + 2)",
    },
    Sabotage {
        name: "Hashin-Shtrikman: lower and upper environment exchanged",
        file: "crates/homogenization/src/bounds/mod.rs",
        find: "shear.map(|g| embedded(&phases, g))",
        replace: "[shear[1], shear[0]].map(|g| embedded(&phases, g))",
    },
    Sabotage {
        name: "identification: any value rounds to the printed digits",
        file: "crates/homogenization/src/identify/target.rs",
        find: "Uncertainty::Rounded(half) => half,",
        replace: "Uncertainty::Rounded(_) => f64::INFINITY,",
    },
    Sabotage {
        name: "identification: rounded entries drawn without their box",
        file: "crates/homogenization/src/identify/sample.rs",
        find: "3.0_f64.sqrt() * (w / 2.0).tanh(),",
        replace: "w,",
    },
    Sabotage {
        name: "straight edges instead of arcs (structured mesh)",
        file: "crates/rve-mesh/src/mesh.rs",
        find: "    Ok(CellMesh { order, nodes: grid.positions(cell), elements,",
        replace: concat!(
            "    let (mut nodes, elements): (_, Vec<Vec<usize>>) = (grid.positions(cell), elements);\n",
            straightened!(),
            "    Ok(CellMesh { order, nodes, elements,"
        ),
    },
    Sabotage {
        name: "straight edges instead of arcs (free mesh)",
        file: "crates/rve-mesh/src/irregular/build.rs",
        find: "    Ok(builder.finish())",
        replace: concat!(
            "    let mut mesh = builder.finish();\n    let (nodes, elements, order) = (&mut mesh.nodes, &mesh.elements, mesh.order);\n",
            straightened!(),
            "    Ok(mesh)"
        ),
    },
    Sabotage {
        name: "one periodic pair of each side dropped (whole cell)",
        file: "crates/rve-mesh/src/mesh.rs",
        find: "for offset in 0..=along {",
        replace: "for offset in (0..=along).filter(|offset| *offset != 1) {",
    },
    Sabotage {
        name: "free mesh: edges to different copies of a point taken for one",
        file: "crates/rve-mesh/src/irregular/build.rs",
        find: "let key = (from.0, to.0, apart);",
        replace: "let key = (from.0, to.0, [0, 0]);",
    },
    Sabotage {
        name: "Voigt: shear stress twice the shear modulus times engineering strain",
        file: "crates/fem-core/src/material.rs",
        find: "stiffness[(i + 3, i + 3)] = mu;",
        replace: "stiffness[(i + 3, i + 3)] = 2.0 * mu;",
    },
    Sabotage {
        name: "orthotropic law turned the wrong way in shear along the fibre",
        file: "crates/fem-core/src/material.rs",
        find: "0.0, 0.0, 0.0, c, s, 0.0,
        0.0, 0.0, 0.0, -s, c, 0.0,",
        replace: "0.0, 0.0, 0.0, c, -s, 0.0,
        0.0, 0.0, 0.0, s, c, 0.0,",
    },
];
