//! Rectangles of the (r, y) half-plane and their content.

use crate::{Contact, Dehomogenization, Design, Error, Mechanics, Side};

/// Thickness of the skin of the hub whose radial conductivity stands for a contact resistance \[m\]: thin enough to leave the hub's
/// conduction and stiffness as they are (1/4000 of a wall of 4 mm).
pub(crate) const CONTACT_SKIN: f64 = 1e-6;

/// Largest relaxing share that the polynomial of [`crate::Relaxation`] resolves.
const MOST_RELAXING: f64 = 0.8;

/// Filling of a part of the half-plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Region {
    /// The homogenised coil.
    Coil,
    /// The hub between or beyond the flanges.
    Hub,
    /// The flange below y = 0, with the part of the hub in it.
    LeftFlange,
    /// The flange above y = height, with the part of the hub in it.
    RightFlange,
    /// The outermost skin of the hub, as thick as 1 µm, that carries a thermal contact resistance.
    Contact,
    /// The skin of the left flange at the coil's face, likewise.
    LeftContact,
    /// The skin of the right flange at the coil's face, likewise.
    RightContact,
    /// The medium around the solids.
    Medium,
}

/// Part of the half-plane that is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// Coil and spool: enough for mechanics.
    Solids,
    /// Coil, spool and what fills the gaps between them: heat flow where a film stands for the medium outside.
    SolidsAndGaps,
    /// Everything to the chamber wall: heat flow.
    Chamber,
}

impl Domain {
    /// Part that a design's heat flow takes.
    pub(crate) fn of_heat(design: &Design) -> Self {
        if design.heat.film.is_some() { Self::SolidsAndGaps } else { Self::Chamber }
    }
}

/// A solid rectangle of the half-plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Its content.
    pub region: Region,
    /// Inner and outer radius \[m\].
    pub r: [f64; 2],
    /// Lower and upper end along the axis \[m\].
    pub y: [f64; 2],
}

/// The solids of a design and the chamber around them.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Coil first, then flanges, contact skin and hub; where two overlap the earlier one holds.
    pub solids: Vec<Rectangle>,
    /// The whole computational domain, from the axis to the chamber wall.
    pub chamber: Rectangle,
    /// Bore of the hub, or of the coil where there is no spool \[m\].
    pub bore: f64,
    /// The medium between the coil and unbonded faces of the spool.
    pub gaps: Vec<Rectangle>,
    /// Closed part of a bond that can open: flange and outer radius of the lasting bond \[m\].
    pub lasting_bond: Option<(Side, f64)>,
}

impl Rectangle {
    fn holds(&self, r: f64, y: f64) -> bool {
        self.r[0] <= r && r <= self.r[1] && self.y[0] <= y && y <= self.y[1]
    }
}

impl Region {
    /// Number of regions.
    pub const COUNT: usize = 8;

    /// The flange on a side.
    pub fn flange(side: Side) -> Self {
        match side {
            Side::Left => Self::LeftFlange,
            Side::Right => Self::RightFlange,
        }
    }

    /// The end of a design's spool on a side: its flange, or the hub where there is none.
    pub fn end(design: &Design, side: Side) -> Self {
        let flanges = design.spool.iter().flat_map(|spool| &spool.flanges);
        if flanges.into_iter().any(|flange| flange.side == side) { Self::flange(side) } else { Self::Hub }
    }

    /// The skin between the coil and the flange on a side.
    pub fn contact(side: Side) -> Self {
        match side {
            Side::Left => Self::LeftContact,
            Side::Right => Self::RightContact,
        }
    }
}

/// Skins that are laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Skins {
    /// Those that carry a resistance.
    Needed,
    /// One at every bonded face, so that designs with and without a resistance share a mesh.
    All,
}

impl Layout {
    /// Lays out `design`.
    ///
    /// # Errors
    /// [`Error::Design`] names the dimension that is out of range.
    pub fn new(design: &Design) -> Result<Self, Error> {
        Self::with_skins(design, Skins::Needed)
    }

    pub(crate) fn with_skins(design: &Design, skins: Skins) -> Result<Self, Error> {
        check(design)?;
        let skin = |contact: Contact, resistance: f64| contact == Contact::Bonded && (skins == Skins::All || resistance > 0.0);
        let (inner, body) = (design.winding.inner_radius, &design.body);
        let coil = Rectangle { region: Region::Coil, r: [inner, body.outer_radius], y: [0.0, body.height] };
        let mut solids = vec![coil];
        let (mut bore, mut gaps) = (inner, Vec::new());
        if let Some(spool) = &design.spool {
            let hub_outer = inner - spool.hub_contact.gap();
            bore = hub_outer - spool.hub_thickness;
            let mut hub_y = coil.y;
            for flange in &spool.flanges {
                let (near, far) = (flange.contact.gap(), flange.contact.gap() + flange.thickness);
                let y = match flange.side {
                    Side::Left => [-far, -near],
                    Side::Right => [body.height + near, body.height + far],
                };
                hub_y = [hub_y[0].min(y[0]), hub_y[1].max(y[1])];
                let r = [bore, body.outer_radius + flange.overhang];
                if near > 0.0 {
                    let y = match flange.side {
                        Side::Left => [-near, 0.0],
                        Side::Right => [body.height, body.height + near],
                    };
                    gaps.push(Rectangle { region: Region::Medium, r: [hub_outer, body.outer_radius], y });
                }
                if skin(flange.contact, design.heat.flange_resistance(flange.side)) {
                    let y = match flange.side {
                        Side::Left => [-CONTACT_SKIN, 0.0],
                        Side::Right => [body.height, body.height + CONTACT_SKIN],
                    };
                    solids.push(Rectangle { region: Region::contact(flange.side), r: coil.r, y });
                }
                solids.push(Rectangle { region: Region::flange(flange.side), r, y });
            }
            if hub_outer < inner {
                gaps.push(Rectangle { region: Region::Medium, r: [hub_outer, inner], y: coil.y });
            }
            if skin(spool.hub_contact, design.heat.hub_resistance) {
                solids.push(Rectangle { region: Region::Contact, r: [hub_outer - CONTACT_SKIN, hub_outer], y: coil.y });
            }
            solids.push(Rectangle { region: Region::Hub, r: [bore, hub_outer], y: hub_y });
        }
        let margin = design.surroundings.margin;
        let most = |f: fn(&Rectangle) -> f64| solids.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
        let (r1, y0, y1) = (most(|s| s.r[1]) + margin, -most(|s| -s.y[0]) - margin, most(|s| s.y[1]) + margin);
        let chamber = Rectangle { region: Region::Medium, r: [0.0, r1], y: [y0, y1] };
        let sensor = design.sensor;
        if !(chamber.r[0]..=chamber.r[1]).contains(&sensor.radius) || !(chamber.y[0]..=chamber.y[1]).contains(&sensor.y) {
            let inside = format!("r 0 to {r1} m, y {y0} to {y1} m");
            let problem = format!("({} m, {} m) lies outside the chamber, {inside}; move it inside", sensor.radius, sensor.y);
            return Err(Error::design("sensor", problem));
        }
        let lasting_bond = match design.mechanics {
            Mechanics::Opening(o) => Some((o.side, body.outer_radius - o.fraction * (body.outer_radius - inner))),
            _ => None,
        };
        Ok(Self { solids, chamber, bore, gaps, lasting_bond })
    }

    /// Filling of the point (r, y).
    pub fn region(&self, r: f64, y: f64) -> Region {
        self.solids.iter().find(|s| s.holds(r, y)).map_or(Region::Medium, |s| s.region)
    }

    /// Filling of the point (r, y), if it belongs to `domain`.
    pub(crate) fn region_in(&self, domain: Domain, r: f64, y: f64) -> Option<Region> {
        let belongs = |region: &Region| match domain {
            _ if *region != Region::Medium => true,
            Domain::Solids => false,
            Domain::SolidsAndGaps => self.gaps.iter().any(|gap| gap.holds(r, y)),
            Domain::Chamber => true,
        };
        Some(self.region(r, y)).filter(belongs)
    }
}

fn positive(field: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(Error::design(field, format!("{value} must be finite and greater than 0")))
}

/// A wall's thickness: at least ten contact skins, far below anything that is made.
fn thick(field: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value >= 10.0 * CONTACT_SKIN {
        return Ok(());
    }
    Err(Error::design(field, format!("{value} m must be finite and at least {} m", 10.0 * CONTACT_SKIN)))
}

fn check(design: &Design) -> Result<(), Error> {
    let (inner, body) = (design.winding.inner_radius, &design.body);
    positive("winding.inner_radius", inner)?;
    positive("coil.height", body.height)?;
    positive("coil.density", body.density)?;
    positive("coil.specific_heat", body.specific_heat)?;
    positive("coil.conductivity_r", body.conductivity_r)?;
    positive("surroundings.margin", design.surroundings.margin)?;
    positive("surroundings.conductivity", design.surroundings.conductivity)?;
    positive("surroundings.density", design.surroundings.density)?;
    positive("surroundings.specific_heat", design.surroundings.specific_heat)?;
    if !(body.outer_radius.is_finite() && body.outer_radius > inner) {
        let problem = format!("{} m must be finite and greater than the inner radius {inner} m", body.outer_radius);
        return Err(Error::design("coil.outer_radius", problem));
    }
    let Dehomogenization { m_rx, m_ry, m_rz, m_rt } = design.dehomogenization;
    for (name, value) in [("m_rx", m_rx), ("m_ry", m_ry), ("m_rz", m_rz), ("m_rt", m_rt)] {
        if !value.is_finite() {
            return Err(Error::design(&format!("dehomogenization.{name}"), format!("{value} must be finite")));
        }
    }
    check_heat(design)?;
    check_mechanics(design)?;
    let Some(spool) = &design.spool else { return Ok(()) };
    thick("spool.hub_thickness", spool.hub_thickness)?;
    positive("spool.material.conductivity", spool.material.conductivity)?;
    positive("spool.material.density", spool.material.density)?;
    positive("spool.material.specific_heat", spool.material.specific_heat)?;
    let room = inner - spool.hub_contact.gap();
    if spool.hub_thickness >= room {
        let problem = format!("{} m leaves no bore; it must be less than {room} m", spool.hub_thickness);
        return Err(Error::design("spool.hub_thickness", problem));
    }
    for (i, flange) in spool.flanges.iter().enumerate() {
        thick(&format!("spool.flanges[{i}].thickness"), flange.thickness)?;
        if !(flange.overhang.is_finite() && flange.overhang >= 0.0) {
            let problem = format!("{} m must be finite and not negative", flange.overhang);
            return Err(Error::design(&format!("spool.flanges[{i}].overhang"), problem));
        }
        if spool.flanges[..i].iter().any(|other| other.side == flange.side) {
            let problem = format!("a second flange on the side {:?}; at most one a side", flange.side);
            return Err(Error::design(&format!("spool.flanges[{i}].side"), problem));
        }
    }
    Ok(())
}

const NO_SPOOL: &str = "there is no spool that has an end on this side";

fn check_heat(design: &Design) -> Result<(), Error> {
    let heat = &design.heat;
    if !(heat.hub_resistance.is_finite() && heat.hub_resistance >= 0.0) {
        return Err(Error::design("heat.hub_resistance", format!("{} must be finite and not negative", heat.hub_resistance)));
    }
    if !(design.sensor.lag.is_finite() && design.sensor.lag >= 0.0) {
        return Err(Error::design("sensor.lag", format!("{} s must be finite and not negative", design.sensor.lag)));
    }
    if let Some(film) = heat.film {
        positive("heat.film", film)?;
    }
    let flange = |side: Side| design.spool.iter().flat_map(|s| &s.flanges).any(|f| f.side == side);
    for (i, mount) in heat.mounts.iter().enumerate() {
        positive(&format!("heat.mounts[{i}].conductance"), mount.conductance)?;
        if design.spool.is_none() {
            return Err(Error::design(&format!("heat.mounts[{i}].side"), NO_SPOOL.into()));
        }
    }
    for (i, contact) in heat.flange_contacts.iter().enumerate() {
        if !(contact.resistance.is_finite() && contact.resistance >= 0.0) {
            let problem = format!("{} must be finite and not negative", contact.resistance);
            return Err(Error::design(&format!("heat.flange_contacts[{i}].resistance"), problem));
        }
        if !flange(contact.side) {
            return Err(Error::design(&format!("heat.flange_contacts[{i}].side"), "there is no flange on this side".into()));
        }
    }
    for (i, heater) in heat.heaters.iter().enumerate() {
        if !heater.power.is_finite() {
            return Err(Error::design(&format!("heat.heaters[{i}].power"), format!("{} W must be finite", heater.power)));
        }
        if design.spool.is_none() {
            return Err(Error::design(&format!("heat.heaters[{i}].side"), NO_SPOOL.into()));
        }
    }
    Ok(())
}

fn check_mechanics(design: &Design) -> Result<(), Error> {
    match &design.mechanics {
        Mechanics::Elastic => Ok(()),
        Mechanics::TemperatureTable(rows) => {
            if rows.is_empty() || rows.windows(2).any(|w| w[0].temperature.total_cmp(&w[1].temperature).is_ge()) {
                let problem = "at least one row is needed, temperatures increasing".into();
                return Err(Error::design("mechanics", problem));
            }
            for (i, row) in rows.iter().enumerate() {
                positive(&format!("mechanics[{i}].transverse_modulus"), row.transverse_modulus)?;
                if !(row.temperature.is_finite() && row.transverse_expansion.is_finite()) {
                    return Err(Error::design(&format!("mechanics[{i}]"), "every number must be finite".into()));
                }
            }
            Ok(())
        }
        Mechanics::Relaxing { fraction, time } => {
            positive("mechanics.time", *time)?;
            if !(0.0..=MOST_RELAXING).contains(fraction) {
                let problem = format!("{fraction} must lie in 0 … {MOST_RELAXING}; a larger share is not resolved");
                return Err(Error::design("mechanics.fraction", problem));
            }
            Ok(())
        }
        Mechanics::Opening(o) => {
            let bonded = |f: &crate::Flange| f.side == o.side && f.contact == Contact::Bonded;
            if !design.spool.iter().flat_map(|s| &s.flanges).any(bonded) {
                return Err(Error::design("mechanics.side", "there is no bonded flange on this side".into()));
            }
            if !(o.fraction > 0.0 && o.fraction < 1.0) {
                return Err(Error::design("mechanics.fraction", format!("{} must lie between 0 and 1", o.fraction)));
            }
            if !(o.below.is_finite() && o.hysteresis.is_finite() && o.hysteresis >= 0.0) {
                return Err(Error::design("mechanics", "temperatures must be finite, the hysteresis not negative".into()));
            }
            Ok(())
        }
    }
}
