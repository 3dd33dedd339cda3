//! Numbers of a design that may differ from one coil to the next.

use crate::{Contact, Design, FlangeContact, Heater, Mount, Side};

/// A number of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Parameter {
    /// Transverse conductivity of the coil \[W/(m K)\].
    CoilConductivity,
    /// Specific heat of the coil \[J/(kg K)\].
    CoilSpecificHeat,
    /// Density of the coil \[kg/m³\].
    CoilDensity,
    /// E_z of the coil \[Pa\].
    AxialModulus,
    /// E_r of the coil \[Pa\]; G_zr keeps its ratio to it.
    TransverseModulus,
    /// G_zr/E_r of the coil.
    ShearRatio,
    /// ν_zr of the coil.
    AxialPoisson,
    /// ν_r of the coil.
    TransversePoisson,
    /// α_z of the coil \[1/K\].
    AxialExpansion,
    /// α_r of the coil \[1/K\].
    TransverseExpansion,
    /// Conductivity of the spool \[W/(m K)\].
    SpoolConductivity,
    /// Specific heat of the spool \[J/(kg K)\].
    SpoolSpecificHeat,
    /// Density of the spool \[kg/m³\].
    SpoolDensity,
    /// Young's modulus of the spool \[Pa\].
    SpoolModulus,
    /// Poisson's ratio of the spool.
    SpoolPoisson,
    /// Expansion of the spool \[1/K\].
    SpoolExpansion,
    /// Conductivity of the medium \[W/(m K)\].
    MediumConductivity,
    /// Specific heat of the medium \[J/(kg K)\].
    MediumSpecificHeat,
    /// Axial place at which the winding begins between the flanges \[m\]: turns are spread to where it ends, the coil around them stays.
    WindingStart,
    /// Axial place at which it ends \[m\], likewise.
    WindingEnd,
    /// Wall of the hub \[m\]: the bore moves, and with it a thermometer that sits on it.
    HubThickness,
    /// Thickness of every flange \[m\]: the outer face moves, and with it a thermometer that sits on it.
    FlangeThickness,
    /// Overhang of every flange beyond the coil \[m\].
    FlangeOverhang,
    /// Distance to the chamber's wall \[m\].
    Margin,
    /// Contact resistance between hub and coil \[m² K/W\].
    HubResistance,
    /// Contact resistance between a flange and the coil \[m² K/W\].
    FlangeResistance(Side),
    /// Conductance of the mount of the spool's end on a side, a flange or the hub \[W/(m² K)\].
    Mount(Side),
    /// Film coefficient of all surfaces \[W/(m² K)\].
    Film,
    /// Power dissipated in the spool's end on a side, a flange or the hub \[W\].
    Heater(Side),
}

/// Deviation of a design's number from its drawing, one standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Tolerance {
    /// A share of the value.
    Relative(f64),
    /// In the value's unit.
    Absolute(f64),
    /// A number that a drawing has as it is: 0 unless something is wrong.
    Exact,
}

impl Tolerance {
    /// One standard deviation of a number that is drawn as `value`, in its unit.
    pub fn of(self, value: f64) -> f64 {
        match self {
            Self::Relative(share) => share * value.abs(),
            Self::Absolute(by) => by,
            Self::Exact => 0.0,
        }
    }
}

/// Two places closer than this are one \[m\].
const SAME_PLACE: f64 = 1e-9;

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < SAME_PLACE
}

impl Parameter {
    /// Whether it is a place of the winding within the coil, which is cut to no drawing: it may be 0, and its turns stay in the coil.
    pub fn of_winding(self) -> bool {
        matches!(self, Self::WindingStart | Self::WindingEnd)
    }

    /// Distance by which a place of the winding may move before a turn's centre reaches the coil's face there \[m\], 0 where one lies outside.
    pub(super) fn axial_room(self, design: &Design) -> f64 {
        let [low, high] = design.winding.reach();
        if self == Self::WindingStart { low.max(0.0) } else { (design.body.height - high).max(0.0) }
    }

    /// Every parameter.
    pub const ALL: &[Self] = &[
        Self::CoilConductivity,
        Self::CoilSpecificHeat,
        Self::CoilDensity,
        Self::AxialModulus,
        Self::TransverseModulus,
        Self::ShearRatio,
        Self::AxialPoisson,
        Self::TransversePoisson,
        Self::AxialExpansion,
        Self::TransverseExpansion,
        Self::SpoolConductivity,
        Self::SpoolSpecificHeat,
        Self::SpoolDensity,
        Self::SpoolModulus,
        Self::SpoolPoisson,
        Self::SpoolExpansion,
        Self::MediumConductivity,
        Self::MediumSpecificHeat,
        Self::WindingStart,
        Self::WindingEnd,
        Self::HubThickness,
        Self::FlangeThickness,
        Self::FlangeOverhang,
        Self::Margin,
        Self::HubResistance,
        Self::FlangeResistance(Side::Left),
        Self::FlangeResistance(Side::Right),
        Self::Mount(Side::Left),
        Self::Mount(Side::Right),
        Self::Film,
        Self::Heater(Side::Left),
        Self::Heater(Side::Right),
    ];

    /// Its usual deviation from the drawing.
    ///
    /// Judgement, not measurement: data sheets of adhesives and coatings leave 10 % of a modulus or a conductivity open and 5 % of a heat
    /// capacity or an expansion, handbooks of metals 3 to 5 %; lengths are within ISO 2768-m, ±0.1 mm as two standard deviations, of which the distance
    /// between flanges leaves half of the variance to either end of a winding; still air is a model of the medium. Poisson's ratios keep the law positive definite.
    pub fn tolerance(self) -> Tolerance {
        match self {
            Self::CoilConductivity | Self::TransverseModulus | Self::MediumConductivity | Self::Film => Tolerance::Relative(0.10),
            Self::CoilSpecificHeat | Self::ShearRatio | Self::SpoolConductivity | Self::MediumSpecificHeat => {
                Tolerance::Relative(0.05)
            }
            Self::TransverseExpansion | Self::AxialExpansion => Tolerance::Relative(0.05),
            Self::AxialModulus | Self::SpoolModulus | Self::SpoolSpecificHeat | Self::CoilDensity => Tolerance::Relative(0.03),
            Self::SpoolExpansion | Self::SpoolPoisson | Self::AxialPoisson => Tolerance::Relative(0.02),
            Self::SpoolDensity => Tolerance::Relative(0.01),
            Self::TransversePoisson => Tolerance::Relative(0.003),
            Self::HubThickness | Self::FlangeThickness | Self::FlangeOverhang => Tolerance::Absolute(0.05e-3),
            Self::WindingStart | Self::WindingEnd => Tolerance::Absolute(0.035e-3),
            Self::Margin => Tolerance::Absolute(0.5e-3),
            Self::HubResistance | Self::FlangeResistance(_) | Self::Mount(_) | Self::Heater(_) => Tolerance::Exact,
        }
    }

    /// Its value in a design; `None` if the design has no such number.
    pub fn of(self, design: &Design) -> Option<f64> {
        let (body, medium, heat) = (&design.body, &design.surroundings, &design.heat);
        let spool = design.spool.as_ref();
        let solid = |f: fn(&crate::Solid) -> f64| spool.map(|s| f(&s.material));
        let still = heat.film.is_none();
        let flange = |side: Side| spool?.flanges.iter().find(|f| f.side == side);
        let first = || spool?.flanges.first();
        match self {
            Self::CoilConductivity => Some(body.conductivity_r),
            Self::CoilSpecificHeat => Some(body.specific_heat),
            Self::CoilDensity => Some(body.density),
            Self::AxialModulus => Some(body.elastic.e_z),
            Self::TransverseModulus => Some(body.elastic.e_r),
            Self::ShearRatio => Some(body.elastic.g_zr / body.elastic.e_r),
            Self::AxialPoisson => Some(body.elastic.nu_zr),
            Self::TransversePoisson => Some(body.elastic.nu_r),
            Self::AxialExpansion => Some(body.elastic.alpha_z),
            Self::TransverseExpansion => Some(body.elastic.alpha_r),
            Self::SpoolConductivity => solid(|m| m.conductivity),
            Self::SpoolSpecificHeat => solid(|m| m.specific_heat),
            Self::SpoolDensity => solid(|m| m.density),
            Self::SpoolModulus => solid(|m| m.elastic.youngs_modulus),
            Self::SpoolPoisson => solid(|m| m.elastic.poisson_ratio),
            Self::SpoolExpansion => solid(|m| m.elastic.thermal_expansion),
            Self::MediumConductivity => still.then_some(medium.conductivity),
            Self::MediumSpecificHeat => still.then_some(medium.specific_heat),
            Self::WindingStart => Some(design.winding.start),
            Self::WindingEnd => Some(design.winding.edges()[1]),
            Self::HubThickness => spool.map(|s| s.hub_thickness),
            Self::FlangeThickness => first().map(|f| f.thickness),
            Self::FlangeOverhang => first().map(|f| f.overhang).filter(|overhang| *overhang > 0.0),
            Self::Margin => still.then_some(medium.margin),
            Self::HubResistance => spool.filter(|s| s.hub_contact == Contact::Bonded).map(|_| heat.hub_resistance),
            Self::FlangeResistance(side) => {
                flange(side).filter(|f| f.contact == Contact::Bonded).map(|_| heat.flange_resistance(side))
            }
            Self::Mount(side) => spool.map(|_| heat.mounts.iter().filter(|m| m.side == side).map(|m| m.conductance).sum()),
            Self::Film => heat.film,
            Self::Heater(side) => spool.map(|_| heat.heaters.iter().filter(|h| h.side == side).map(|h| h.power).sum()),
        }
    }

    /// The design with another value of it; unchanged if it has no such number.
    #[must_use]
    pub fn set(self, design: &Design, value: f64) -> Design {
        let mut changed = design.clone();
        let Some(before) = self.of(design) else { return changed };
        let (body, medium, heat) = (&mut changed.body, &mut changed.surroundings, &mut changed.heat);
        if let Some(spool) = &mut changed.spool {
            let (material, bore) = (&mut spool.material, design.winding.inner_radius - spool.hub_contact.gap());
            match self {
                Self::SpoolConductivity => material.conductivity = value,
                Self::SpoolSpecificHeat => material.specific_heat = value,
                Self::SpoolDensity => material.density = value,
                Self::SpoolModulus => material.elastic.youngs_modulus = value,
                Self::SpoolPoisson => material.elastic.poisson_ratio = value,
                Self::SpoolExpansion => material.elastic.thermal_expansion = value,
                Self::HubThickness => {
                    if same(changed.sensor.radius, bore - before) {
                        changed.sensor.radius = bore - value;
                    }
                    spool.hub_thickness = value;
                }
                Self::FlangeThickness => {
                    let outer = |side: Side, gap: f64, thickness: f64| match side {
                        Side::Left => -gap - thickness,
                        Side::Right => design.body.height + gap + thickness,
                    };
                    let y = changed.sensor.y;
                    for flange in &mut spool.flanges {
                        let (gap, to) = (flange.contact.gap(), flange.thickness + value - before);
                        if same(y, outer(flange.side, gap, flange.thickness)) {
                            changed.sensor.y = outer(flange.side, gap, to);
                        }
                        flange.thickness = to;
                    }
                }
                Self::FlangeOverhang => spool.flanges.iter_mut().for_each(|f| f.overhang += value - before),
                _ => {}
            }
        }
        match self {
            Self::CoilConductivity => body.conductivity_r = value,
            Self::CoilSpecificHeat => body.specific_heat = value,
            Self::CoilDensity => body.density = value,
            Self::AxialModulus => body.elastic.e_z = value,
            Self::TransverseModulus => {
                body.elastic.g_zr *= value / before;
                body.elastic.e_r = value;
            }
            Self::ShearRatio => body.elastic.g_zr = value * body.elastic.e_r,
            Self::AxialPoisson => body.elastic.nu_zr = value,
            Self::TransversePoisson => body.elastic.nu_r = value,
            Self::AxialExpansion => body.elastic.alpha_z = value,
            Self::TransverseExpansion => body.elastic.alpha_r = value,
            Self::MediumConductivity => medium.conductivity = value,
            Self::MediumSpecificHeat => medium.specific_heat = value,
            Self::WindingStart => {
                let [_, end] = design.winding.edges();
                (changed.winding.start, changed.winding.end) = (value, Some(end));
            }
            Self::WindingEnd => changed.winding.end = Some(value),
            Self::Margin => medium.margin = value,
            Self::HubResistance => heat.hub_resistance = value,
            Self::FlangeResistance(side) => {
                heat.flange_contacts.retain(|c| c.side != side);
                heat.flange_contacts.push(FlangeContact { side, resistance: value });
            }
            Self::Mount(side) => {
                heat.mounts.retain(|m| m.side != side);
                if value != 0.0 {
                    heat.mounts.push(Mount { side, conductance: value });
                }
            }
            Self::Film => heat.film = Some(value),
            Self::Heater(side) => {
                heat.heaters.retain(|h| h.side != side);
                if value != 0.0 {
                    heat.heaters.push(Heater { side, power: value });
                }
            }
            _ => {}
        }
        changed
    }
}
