//! The representative cell: a coated fibre on a lattice, in adhesive. All SI.

use crate::Error;
use fem_core::material::{Isotropic, ThermoElastic};
use rve_mesh::{LatticeCell, Packing};

/// An isotropic constituent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constituent {
    /// Elastic constants and expansion.
    pub elastic: Isotropic,
    /// Thermal conductivity \[W/(m K)\].
    pub conductivity: f64,
    /// Density \[kg/m³\], if it is known.
    pub density: Option<f64>,
    /// Specific heat \[J/(kg K)\], if it is known.
    pub specific_heat: Option<f64>,
}

impl Constituent {
    /// A constituent whose density and specific heat are not known.
    pub fn new(elastic: Isotropic, conductivity: f64) -> Self {
        Self { elastic, conductivity, density: None, specific_heat: None }
    }

    /// Its elastic law, if that and its conductivity are in range; `name` is for the message.
    pub(crate) fn law(&self, name: impl Fn() -> String) -> Result<ThermoElastic, Error> {
        let law = self.elastic.law().map_err(|source| Error::Constituent { constituent: name(), source })?;
        if !(self.conductivity.is_finite() && self.conductivity > 0.0) {
            return Err(Error::conductivity(name(), self.conductivity));
        }
        Ok(law)
    }
}

/// One concentric ring of the fibre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Outer radius \[m\].
    pub outer_radius: f64,
    /// Its material.
    pub constituent: Constituent,
    /// Whether it guides the light or belongs to the glass whose mean strain M reports.
    pub role: Role,
}

impl Ring {
    /// "ring 0 (glass)", "ring 1 (coating)", …: its number from the inside, and its role.
    pub(crate) fn name(&self, number: usize) -> String {
        let role = match self.role {
            Role::Glass => "glass",
            Role::Coating => "coating",
        };
        format!("ring {number} ({role})")
    }
}

/// Role of a ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The core whose mean strain the dehomogenisation matrix gives: glass in a coil, steel in a cable.
    Glass,
    /// Coating.
    Coating,
}

/// A fibre's rings from the inside out, in adhesive, at the lattice pitch.
#[derive(Debug, Clone, PartialEq)]
pub struct FibreCell {
    /// Packing of the fibres.
    pub packing: Packing,
    /// Distance between neighbouring fibre axes \[m\].
    pub pitch: f64,
    /// Rings from the inside out, at least one; the outermost stays inside `pitch / 2`.
    pub rings: Vec<Ring>,
    /// Fills the rest of the hexagon or square.
    pub adhesive: Constituent,
}

impl FibreCell {
    /// A cell of the orthocyclic winding.
    pub fn hexagonal(pitch: f64, rings: Vec<Ring>, adhesive: Constituent) -> Self {
        Self { packing: Packing::Hexagonal, pitch, rings, adhesive }
    }

    /// The geometry alone.
    ///
    /// # Errors
    /// [`Error::Geometry`] if it is out of range.
    pub fn outline(&self) -> Result<LatticeCell, Error> {
        Ok(LatticeCell::new(self.packing, self.pitch, self.rings.iter().map(|r| r.outer_radius).collect())?)
    }

    /// Constituents of the phases: the rings from the inside out, last the adhesive.
    pub fn constituents(&self) -> impl Iterator<Item = &Constituent> {
        self.rings.iter().map(|ring| &ring.constituent).chain([&self.adhesive])
    }

    /// Radius of the outermost ring \[m\].
    pub(crate) fn outermost(&self) -> f64 {
        self.rings.last().map_or(0.0, |ring| ring.outer_radius)
    }

    /// Mean density \[kg/m³\], if that of every constituent is known.
    ///
    /// # Errors
    /// [`Error`] as [`Self::outline`], or of a density that is not positive.
    pub fn density(&self) -> Result<Option<f64>, Error> {
        self.mean("density", "kg/m³", |c| c.density)
    }

    /// Mean heat capacity of a volume \[J/(m³ K)\], if density and specific heat of every constituent are known. Whether the cell is held
    /// or free while it is heated makes no difference here: the thermoelastic part, `T β·α` of a solid, a few per cent in polymers, is
    /// neglected.
    ///
    /// # Errors
    /// As [`Self::density`].
    pub fn heat_capacity(&self) -> Result<Option<f64>, Error> {
        self.density()?;
        self.mean("specific heat", "J/(kg K)", |c| c.specific_heat)?;
        self.mean("heat capacity", "J/(m³ K)", |c| Some(c.density? * c.specific_heat?))
    }

    fn mean(
        &self,
        what: &'static str,
        unit: &'static str,
        of: impl Fn(&Constituent) -> Option<f64>,
    ) -> Result<Option<f64>, Error> {
        let outline = self.outline()?;
        let mut sum = Some(0.0);
        for (i, (constituent, area)) in self.constituents().zip(outline.phase_areas()).enumerate() {
            let value = of(constituent);
            if let Some(value) = value.filter(|v| !(v.is_finite() && *v > 0.0)) {
                return Err(Error::Property { constituent: self.phase_name(i), what, unit, value });
            }
            sum = sum.zip(value).map(|(sum, value)| sum + value * area / outline.area());
        }
        Ok(sum)
    }

    /// "ring 0 (glass)", "ring 1 (coating)", … from the inside, or "adhesive".
    pub(crate) fn phase_name(&self, phase: usize) -> String {
        self.rings.get(phase).map_or_else(|| "adhesive".into(), |ring| ring.name(phase))
    }
}

pub(crate) struct Phases {
    pub(crate) laws: Vec<ThermoElastic>,
    pub(crate) conductivities: Vec<f64>,
    /// Shares of the cell's area.
    pub(crate) fractions: Vec<f64>,
    pub(crate) glass: Vec<bool>,
}

impl Phases {
    /// # Errors
    /// [`Error`] names the constituent or the geometry at fault.
    pub(crate) fn new(cell: &FibreCell) -> Result<Self, Error> {
        let outline = cell.outline()?;
        let (mut laws, mut conductivities) = (Vec::new(), Vec::new());
        for (i, c) in cell.constituents().enumerate() {
            laws.push(c.law(|| cell.phase_name(i))?);
            conductivities.push(c.conductivity);
        }
        let glass: Vec<bool> = cell.rings.iter().map(|r| r.role == Role::Glass).chain([false]).collect();
        if !glass.contains(&true) {
            return Err(Error::NoGlass);
        }
        let fractions = outline.phase_areas().iter().map(|area| area / outline.area()).collect();
        Ok(Self { laws, conductivities, fractions, glass })
    }

    /// Mean over the cell of what each phase has.
    pub(crate) fn mean(&self, of: impl Fn(usize) -> f64) -> f64 {
        self.fractions.iter().enumerate().map(|(i, f)| f * of(i)).sum()
    }

    /// Mean over the glass of what each phase has.
    pub(crate) fn glass_mean(&self, values: impl Iterator<Item = f64>) -> f64 {
        let glass = self.fractions.iter().zip(&self.glass).map(|(f, glass)| if *glass { *f } else { 0.0 });
        let (sum, share) = glass.zip(values).fold((0.0, 0.0), |(sum, share), (f, value)| (sum + f * value, share + f));
        sum / share
    }
}
