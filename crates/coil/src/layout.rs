//! Which rectangle of the (r, y) half-plane holds what.

use crate::{Design, Error, Side};

/// What fills a part of the half-plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Region {
    /// The homogenised coil.
    Coil,
    /// Hub or flange.
    Spool,
    /// The medium around the solids.
    Medium,
}

/// A solid rectangle of the half-plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// What it holds.
    pub region: Region,
    /// Inner and outer radius \[m\].
    pub r: [f64; 2],
    /// Lower and upper end along the axis \[m\].
    pub y: [f64; 2],
}

/// The solids of a design and the chamber around them.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Coil first, then hub and flanges.
    pub solids: Vec<Rectangle>,
    /// The whole computational domain, from the axis to the chamber wall.
    pub chamber: Rectangle,
    /// Bore of the hub, or of the coil where there is no spool \[m\].
    pub bore: f64,
}

impl Layout {
    /// Lays out `design`.
    ///
    /// # Errors
    /// [`Error::Design`] names the dimension that is out of range.
    pub fn new(design: &Design) -> Result<Self, Error> {
        check(design)?;
        let (inner, body) = (design.winding.inner_radius, &design.body);
        let coil = Rectangle { region: Region::Coil, r: [inner, body.outer_radius], y: [0.0, body.height] };
        let mut solids = vec![coil];
        let mut bore = inner;
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
                solids.push(Rectangle { region: Region::Spool, r: [bore, body.outer_radius + flange.overhang], y });
            }
            solids.insert(1, Rectangle { region: Region::Spool, r: [bore, hub_outer], y: hub_y });
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
        Ok(Self { solids, chamber, bore })
    }

    /// What fills the point (r, y).
    pub fn region(&self, r: f64, y: f64) -> Region {
        let inside = |s: &&Rectangle| s.r[0] <= r && r <= s.r[1] && s.y[0] <= y && y <= s.y[1];
        self.solids.iter().find(inside).map_or(Region::Medium, |s| s.region)
    }
}

fn positive(field: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(Error::design(field, format!("{value} must be finite and greater than 0")))
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
    let Some(spool) = &design.spool else { return Ok(()) };
    positive("spool.hub_thickness", spool.hub_thickness)?;
    positive("spool.material.conductivity", spool.material.conductivity)?;
    positive("spool.material.density", spool.material.density)?;
    positive("spool.material.specific_heat", spool.material.specific_heat)?;
    let room = inner - spool.hub_contact.gap();
    if spool.hub_thickness >= room {
        let problem = format!("{} m leaves no bore; it must be less than {room} m", spool.hub_thickness);
        return Err(Error::design("spool.hub_thickness", problem));
    }
    for (i, flange) in spool.flanges.iter().enumerate() {
        positive(&format!("spool.flanges[{i}].thickness"), flange.thickness)?;
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
