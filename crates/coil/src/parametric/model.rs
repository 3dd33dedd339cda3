//! The parametric model and what it gives of a design.

use super::effort::{Effort, MODULI};
use super::heat::{Heat, SHIFTS};
use super::parameter::Parameter;
use super::project::Fields;
use super::range::Range;
use super::section::Section;
use super::structure::Structure;
use super::turns::{Fibre, Turns, Weighted};
use crate::probe::{Probe, Prober};
use crate::{BiasOperator, Bonds, Design, Error, Grid, MechanicalState, MeshFineness, Outputs, Reduced, TurnFields};
use nalgebra::{DMatrix, DVector};
use winding::{Spec, Winding};

/// Heat flow and thermo-elasticity of a design and of all that differ from it within ranges of [`Parameter`]s, projected once on fields
/// of temperature and displacement.
#[derive(Debug, Clone)]
pub struct ParametricModel {
    pub(super) design: Design,
    pub(super) ranges: Vec<Range>,
    pub(super) resolution: MeshFineness,
    pub(super) effort: Effort,
    pub(super) section: Section,
    pub(super) grid: Grid,
    /// temperatures at the nodes of the grid's lattice, 1 first
    pub(super) temperatures: Fields,
    pub(super) heat: Heat,
    pub(super) structure: Structure,
    pub(super) turns: Turns,
    pub(super) coil_mean: DVector<f64>,
}

/// Bias parts of some mechanics as functionals of a parametric model's fields of temperature; made by [`FieldsOn::project`].
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Projected {
    parts: [DVector<f64>; 3],
}

impl Projected {
    /// These less others.
    #[must_use]
    pub fn less(&self, other: &Self) -> Self {
        Self { parts: [0, 1, 2].map(|p: usize| &self.parts[p] - &other.parts[p]) }
    }

    /// These over a number.
    #[must_use]
    pub fn over(&self, divisor: f64) -> Self {
        Self { parts: self.parts.each_ref().map(|part| part / divisor) }
    }
}

/// A parametric model's fields of temperature on another grid; made by [`ParametricModel::fields_on`].
#[derive(Debug, Clone)]
pub struct FieldsOn<'a> {
    model: &'a ParametricModel,
    /// of each node of that grid on the model's own
    probes: Vec<Probe>,
}

impl FieldsOn<'_> {
    /// The bias parts of a full mechanical model on that grid, on the fields: what no state of the reduced mechanics has, as a bond that is open.
    pub fn project(&self, operator: &BiasOperator) -> Projected {
        let (grid, fields) = (&self.model.grid, &self.model.temperatures.values);
        let of = |part: &[f64]| {
            let mut at_nodes = vec![0.0; grid.mesh().nodes().len()];
            self.probes.iter().zip(part).for_each(|(probe, weight)| probe.add_value(&mut at_nodes, *weight));
            let mut at_places = DVector::zeros(fields.nrows());
            grid.places().iter().zip(at_nodes).for_each(|(place, weight)| at_places[*place] += weight);
            fields.tr_mul(&at_places)
        };
        Projected { parts: [of(&operator.shupe), of(&operator.eo_axial), of(&operator.eo_radial)] }
    }
}

/// Shares of the fields on which coarser models stand.
const COARSER: [f64; 2] = [0.85, 0.75];

/// Factor on the larger of the distances to the coarser models that estimates the error of the bias: an estimate, not a bound. At random points of the
/// boxes of `cargo xtask bench parametric` it covers; directions that are missing from all of them are not seen.
pub const MODEL_SAFETY: f64 = 3.0;

impl ParametricModel {
    /// The design that it was made about.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The ranges that it was made for.
    pub fn ranges(&self) -> &[Range] {
        &self.ranges
    }

    /// Number of temperature fields and of displacement fields.
    pub fn size(&self) -> [usize; 2] {
        [self.heat.size(), self.turns.displacements()]
    }

    /// Memory that it takes \[bytes\].
    pub fn bytes(&self) -> usize {
        let numbers = self.temperatures.values.len() + self.turns.numbers() + self.heat.numbers() + self.structure.numbers();
        numbers * std::mem::size_of::<f64>()
    }

    /// The first parameter of `design` that lies outside its range, with its value.
    pub fn outside(&self, design: &Design) -> Option<(Parameter, f64)> {
        Parameter::ALL.iter().find_map(|&parameter| {
            let (value, nominal) = (parameter.of(design)?, parameter.of(&self.design)?);
            let range = self.ranges.iter().find(|range| range.parameter == parameter);
            let [low, high] = range.map_or([nominal; 2], |range| [range.low, range.high]);
            // a hair of rounding
            let slack = 1e-9 * (high - low).max(1e-3 * nominal.abs());
            // not `<`: a NaN lies in no range
            let inside = low - slack <= value && value <= high + slack;
            (!inside).then_some((parameter, value))
        })
    }

    /// The nearest design within the ranges: each parameter of `design` that lies outside its own is taken to its end.
    pub fn nearest(&self, design: &Design) -> Design {
        let within = |design: Design, range: &Range| match range.parameter.of(&design) {
            Some(value) if !(range.low..=range.high).contains(&value) => {
                range.parameter.set(&design, value.clamp(range.low, range.high))
            }
            _ => design,
        };
        self.ranges.iter().fold(design.clone(), within)
    }

    /// The model made anew for ranges that hold `design`, too: nothing is extrapolated. `solved` is told as [`Self::new`] tells.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn including(&self, design: &Design, solved: &(dyn Fn() + Sync)) -> Result<Self, Error> {
        let mut ranges = self.ranges.clone();
        Range::widened(&mut ranges, &self.design, design);
        Self::new(&self.design, &ranges, &self.resolution, &self.effort, solved)
    }

    /// How far the constants and dimensions of `design` lie outside the combinations that the model was made for, relative to their size: 0
    /// within the box.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn left_out(&self, design: &Design) -> Result<f64, Error> {
        let changed = Section::new(design)?;
        let structure = self.structure.left_out(design, &changed, &MechanicalState::NOMINAL)?;
        Ok(self.heat.left_out(design, &changed)?.max(structure))
    }

    /// The reduced model of a changed design, driven by the chamber, and by its heaters if it has any; mounts follow the chamber. The
    /// thermometer's lag and the drifts are for [`crate::Dynamics`].
    ///
    /// # Errors
    /// [`Error::Design`] if the design cannot be reached from the one that was modelled, or lies outside the box.
    pub fn at(&self, design: &Design) -> Result<Reduced, Error> {
        self.on(design, self.size())
    }

    /// As [`Self::at`], on a part of the fields, once and once more: within the box [`MODEL_SAFETY`] times the larger of the distances to them estimates what
    /// the model leaves out. One alone may by chance be as near to the truth, or as far from it.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn coarser(&self, design: &Design) -> Result<[Reduced; 2], Error> {
        let on = |share: f64| self.on(design, self.size().map(|size| ((size as f64 * share) as usize).max(2)));
        let [more, fewer] = COARSER;
        Ok([on(more)?, on(fewer)?])
    }

    /// As [`Self::at`], with the bias parts of these states of the mechanics in place of the design's own, in their order.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn in_states(&self, design: &Design, states: &[MechanicalState]) -> Result<Reduced, Error> {
        self.of_states(design, self.size(), states, &[])
    }

    /// The fields of temperature at the nodes of the grid of a full mechanical model of the design that this was made about.
    ///
    /// # Errors
    /// [`Error::Resolution`] if a node of the grid lies outside this one's.
    pub fn fields_on(&self, grid: &Grid) -> Result<FieldsOn<'_>, Error> {
        let mut prober = Prober::new(&self.grid);
        let probes = grid.mesh().nodes().iter().map(|[r, y]| prober.probe("spool", *r, *y)).collect::<Result<_, _>>()?;
        Ok(FieldsOn { model: self, probes })
    }

    /// As [`Self::in_states`], with the bias parts of projected mechanics behind them, in their order.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn in_states_and(&self, design: &Design, states: &[MechanicalState], projected: &[Projected]) -> Result<Reduced, Error> {
        self.of_states(design, self.size(), states, projected)
    }

    fn on(&self, design: &Design, size: [usize; 2]) -> Result<Reduced, Error> {
        self.of_states(design, size, &design.states().0, &[])
    }

    fn of_states(
        &self,
        design: &Design,
        [temperatures, displacements]: [usize; 2],
        states: &[MechanicalState],
        projected: &[Projected],
    ) -> Result<Reduced, Error> {
        self.holds(design, states)?;
        let changed = Section::new(design)?;
        // what is coarser has fewer modes, too: the distance shows what they leave out
        let shifts = if temperatures < self.heat.size() { SHIFTS - 1 } else { SHIFTS };
        let modes = self.heat.system(design, &changed, temperatures)?.modes(shifts)?;
        let mut functionals = self.functionals(design, &changed, states, displacements)?;
        functionals.parts.extend(projected.iter().map(|p| p.parts.clone()));
        let outputs = functionals.map(|of| modes.output(of));
        Ok(modes.model(outputs))
    }

    /// Whether this is a model of `design` in these states of its mechanics.
    pub(super) fn holds(&self, design: &Design, states: &[MechanicalState]) -> Result<(), Error> {
        if states.iter().any(|state| state.bonds == Bonds::Opened) {
            let problem = "a bond that is open has a mechanical model of its own; see ParametricModel::project";
            return Err(Error::design("mechanics", problem.into()));
        }
        let [softest, stiffest] = MODULI;
        // a hair of rounding: nodes are even in the logarithm
        let beyond = |factor: f64| !(softest * (1.0 - 1e-9)..=stiffest * (1.0 + 1e-9)).contains(&factor);
        if let Some(state) = states.iter().find(|s| beyond(s.transverse_modulus)) {
            let problem = format!(
                "{} lies outside the factors {softest} to {stiffest} on the moduli that were modelled",
                state.transverse_modulus
            );
            return Err(Error::design("mechanics", problem));
        }
        if let Some((parameter, value)) = self.outside(design) {
            let problem = format!(
                "{parameter:?} of {value:e} lies outside the range that was modelled; model a box that includes this design"
            );
            return Err(Error::design("design", problem));
        }
        let (of, nominal) = (&design.surroundings, &self.design.surroundings);
        if design.heat.film.is_none() && of.density != nominal.density {
            let problem = format!("{} kg/m³ was not modelled; give the medium another specific heat instead", of.density);
            return Err(Error::design("surroundings.density", problem));
        }
        let flanges = |design: &Design| design.spool.as_ref().map_or(Vec::new(), |spool| spool.flanges.clone());
        let by: Vec<[f64; 2]> = flanges(design)
            .iter()
            .zip(flanges(&self.design))
            .map(|(to, from)| [to.thickness - from.thickness, to.overhang - from.overhang])
            .collect();
        if by.windows(2).any(|w| (0..2).any(|k| (w[0][k] - w[1][k]).abs() > crate::grid::COINCIDENT)) {
            let problem = "the flanges change unlike one another, which was not modelled; model the design anew";
            return Err(Error::design("spool.flanges", problem.into()));
        }
        Ok(())
    }

    /// Outputs as functionals of the temperature fields, on so many displacement fields.
    fn functionals(
        &self,
        design: &Design,
        changed: &Section,
        states: &[MechanicalState],
        displacements: usize,
    ) -> Result<Outputs<DVector<f64>>, Error> {
        let thermometer = self.place(changed, [design.sensor.radius, design.sensor.y])?;
        let bore = self.bore_value(design, changed)?;
        let fibre = self.fibre(design)?;
        let parts = states.iter().map(|state| {
            let solved = self.structure.solved(design, changed, state, displacements)?;
            let through = solved.through(&solved.adjoint(&self.strain_functionals(design, &fibre.sums)));
            self.parts(design, &fibre, &bore, &through)
        });
        Ok(Outputs { thermometer, coil_mean: self.coil_mean.clone(), parts: parts.collect::<Result<_, _>>()? })
    }

    /// Every temperature field at a place of a changed section.
    pub(super) fn place(&self, changed: &Section, at: [f64; 2]) -> Result<DVector<f64>, Error> {
        let [r, y] = self.section.reference(changed, at);
        self.value(r, y)
    }

    /// Every temperature field at the bore of a changed design, whose temperature the tails have.
    pub(super) fn bore_value(&self, design: &Design, changed: &Section) -> Result<DVector<f64>, Error> {
        let [low, high] = self.bore_ends(changed);
        self.place(changed, [self.bore(changed), design.sensor.y.clamp(low, high)])
    }

    /// Sums over turns as functionals of the displacement: of the strain along the fibre, and across it; one a column.
    pub(super) fn strain_functionals(&self, design: &Design, sums: &Weighted) -> DMatrix<f64> {
        let ([rr, yy, hoop], m) = (&sums.strains, design.dehomogenization);
        DMatrix::from_columns(&[hoop.clone(), rr * m.m_rx + yy * m.m_ry + hoop * m.m_rz])
    }

    /// Bias parts as functionals of the temperature fields; `through` are the strain functionals as such.
    pub(super) fn parts(
        &self,
        design: &Design,
        Fibre { length, tail_weight, sums }: &Fibre,
        bore: &DVector<f64>,
        through: &DMatrix<f64>,
    ) -> Result<[DVector<f64>; 3], Error> {
        let c = design.optics.coefficients(*length)?;
        let free = bore * *tail_weight;
        let temperature = &sums.temperature + &free;
        let expansion = free * design.optics.thermal_expansion;
        let axial = through.column(0) + &expansion;
        let radial = through.column(1) + &sums.temperature * design.dehomogenization.m_rt + expansion;
        Ok([
            &temperature * c.shupe,
            axial * c.axial + &temperature * c.axial_per_temperature_rate,
            radial * c.radial + temperature * c.radial_per_temperature_rate,
        ])
    }

    /// The winding of a changed design, which differs from that of the reference in its tails and in its place along the axis alone.
    pub(super) fn wound(&self, design: &Design) -> Result<Winding, Error> {
        let Spec { tails, start, end, .. } = design.winding;
        if design.winding != (Spec { tails, start, end, ..self.design.winding }) {
            let problem =
                "this design is wound otherwise than the one that was modelled, beyond its tails and its place; model it anew";
            return Err(Error::design("winding", problem.into()));
        }
        Ok(winding::wind(&design.winding)?)
    }

    /// The fibre of a changed design.
    pub(super) fn fibre(&self, design: &Design) -> Result<Fibre, Error> {
        let (winding, nominal) = (self.wound(design)?, self.design.winding);
        let (tails, wound) = (design.winding.tails, winding.wound_length());
        let sums = if design.winding.edges() == nominal.edges() {
            // tails shift every turn's weight by its length
            let by = (tails.cw - tails.ccw) - (nominal.tails.cw - nominal.tails.ccw);
            Weighted::combined(&[(1.0, &self.turns.weighted), (by, &self.turns.lengths)])
        } else {
            self.turns.elsewhere(&self.grid, &self.temperatures, &winding)?
        };
        Ok(Fibre { length: winding.length(), tail_weight: tails.weight(wound), sums })
    }

    /// Temperature and strain of every turn of a changed design, per unit of its drives and modes, in a state of its mechanics.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn fields(&self, design: &Design, state: &MechanicalState) -> Result<TurnFields, Error> {
        self.holds(design, std::slice::from_ref(state))?;
        let winding = self.wound(design)?;
        let changed = Section::new(design)?;
        let modes = self.heat.system(design, &changed, self.heat.size())?.modes(SHIFTS)?;
        let n = self.heat.size();
        let mut columns = DMatrix::zeros(n, 1 + usize::from(modes.heater.is_some()) + modes.rates.len());
        columns[(0, 0)] = 1.0;
        if let Some(field) = &modes.heater {
            columns.view_mut((1, 1), (n - 1, 1)).copy_from(field);
        }
        let first = columns.ncols() - modes.rates.len();
        columns.view_mut((1, first), (n - 1, modes.rates.len())).copy_from(&modes.shapes);
        let displacements = self.structure.solved(design, &changed, state, usize::MAX)?.displacements() * &columns;
        let [temperature, rr, yy, hoop] =
            self.turns.values(&self.grid, &self.temperatures, [&columns, &displacements], &winding)?;
        let m = design.dehomogenization;
        let radial = rr * m.m_rx + yy * m.m_ry + &hoop * m.m_rz + &temperature * m.m_rt;
        let bore = columns.tr_mul(&self.bore_value(design, &changed)?);
        Ok(TurnFields { temperature, axial: hoop, radial, bore: bore.as_slice().to_vec() })
    }

    /// Every temperature field at a place of the reference section.
    pub(super) fn value(&self, r: f64, y: f64) -> Result<DVector<f64>, Error> {
        let mut nodal = vec![0.0; self.grid.mesh().nodes().len()];
        self.grid.probe("sensor", r, y)?.add_value(&mut nodal, 1.0);
        let mut functional = DVector::zeros(self.temperatures.values.ncols());
        for (node, weight) in nodal.iter().enumerate().filter(|(_, w)| **w != 0.0) {
            functional += self.temperatures.values.row(self.grid.places()[node]).transpose() * *weight;
        }
        Ok(functional)
    }

    /// Radius of the hub's bore, or of the coil's where there is no spool.
    pub(super) fn bore(&self, section: &Section) -> f64 {
        let columns = section.rectangles().filter(|(.., region)| *region != crate::Region::Medium).map(|(i, ..)| i);
        columns.min().map_or(0.0, |i| section.lines[0][i])
    }

    /// Lower and upper end of the bore.
    pub(super) fn bore_ends(&self, section: &Section) -> [f64; 2] {
        let solid: Vec<(usize, usize)> =
            section.rectangles().filter(|(.., region)| *region != crate::Region::Medium).map(|(i, j, _)| (i, j)).collect();
        let first = solid.iter().map(|(i, _)| *i).min().unwrap_or(0);
        let rows = || solid.iter().filter(|(i, _)| *i == first).map(|(_, j)| *j);
        [section.lines[1][rows().min().unwrap_or(0)], section.lines[1][rows().max().unwrap_or(0) + 1]]
    }
}
