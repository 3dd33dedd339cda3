//! Outputs computed for a design.

use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Dynamics, Layout, Region, STANDARD, STEADY, Tolerances, sensitivity_band, sensitivity_on};
use std::f64::consts::PI;
use winding::wind;

use crate::input::ProfileCase;
use crate::units::to_mm;

/// The name of the sensitivity among the outputs.
pub(super) const TOTAL: &str = "total";

/// Numbers that are computed of each design.
pub enum Output {
    /// Steady-ramp sensitivity by part and in all, by adjoint on one mesh.
    Sensitivity,
    /// One standard deviation of it by the tolerances, to first order.
    Tolerances,
    /// Fibre, turns, dimensions, mass.
    Winding,
    /// Bias under a profile.
    Simulation(Box<ProfileCase>),
}

impl Output {
    /// Names of the numbers.
    pub fn names(&self) -> &'static [&'static str] {
        match self {
            Self::Sensitivity => &["shupe", "eo_axial", "eo_radial", TOTAL],
            Self::Tolerances => &["tolerance_sd"],
            Self::Winding => &["length_m", "turns", "outer_radius_mm", "height_mm", "mass_kg"],
            Self::Simulation(_) => &["peak_deg_per_h", "rms_deg_per_h", "end_deg_per_h"],
        }
    }

    /// The numbers of a design.
    ///
    /// # Errors
    /// [`coil::Error`] names the reason why it cannot be computed.
    pub fn of(&self, design: &Design, tolerances: &Tolerances) -> Result<Vec<Option<f64>>, coil::Error> {
        match self {
            Self::Sensitivity => {
                let s = sensitivity_on(design, &STEADY)?;
                Ok([s.shupe, s.eo_axial, s.eo_radial, s.total()].map(Some).to_vec())
            }
            Self::Tolerances => Ok(vec![Some(sensitivity_band(design, tolerances)?.sd)]),
            Self::Winding => {
                let winding = wind(&design.winding)?;
                let [outer, height] = [design.body.outer_radius, design.body.height].map(to_mm);
                Ok([winding.length(), winding.turns().len() as f64, outer, height, mass(design)?].map(Some).to_vec())
            }
            Self::Simulation(profile) => {
                let dynamics = Dynamics::new(design, &profile.drives, &STANDARD)?;
                let rows = dynamics.simulate(&profile.profile)?;
                let rates: Vec<f64> = rows.iter().map(|row| row.rate() * DEG_PER_H_PER_RAD_PER_S).collect();
                Ok(course(&profile.profile.time, &rates).map(Some).to_vec())
            }
        }
    }
}

/// Mass of coil and spool \[kg\].
pub(crate) fn mass(design: &Design) -> Result<f64, coil::Error> {
    let layout = Layout::new(design)?;
    let of_spool = design.spool.as_ref().map_or(0.0, |spool| spool.material.density);
    let hub = |region: Region| !matches!(region, Region::LeftFlange | Region::RightFlange | Region::Coil);
    // a flange holds the part of the hub in it: what of the hub lies there is counted once
    let flanges: Vec<[f64; 2]> =
        layout.solids.iter().filter(|s| matches!(s.region, Region::LeftFlange | Region::RightFlange)).map(|s| s.y).collect();
    let own = |region: Region, [low, high]: [f64; 2]| {
        let inside = |y: &[f64; 2]| (high.min(y[1]) - low.max(y[0])).max(0.0);
        high - low - if hub(region) { flanges.iter().map(inside).sum() } else { 0.0 }
    };
    let of = |solid: &coil::Rectangle| {
        let density = match solid.region {
            Region::Coil => design.body.density,
            Region::Hub | Region::LeftFlange | Region::RightFlange => of_spool,
            // skins of a micrometre lie in hub and flanges
            Region::Contact | Region::LeftContact | Region::RightContact | Region::Medium => 0.0,
        };
        density * PI * (solid.r[1].powi(2) - solid.r[0].powi(2)) * own(solid.region, solid.y)
    };
    Ok(layout.solids.iter().map(of).sum())
}

/// Largest magnitude, root of the mean square over time, and last value of a course.
fn course(time: &[f64], rates: &[f64]) -> [f64; 3] {
    let peak = rates.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
    let duration = time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first);
    let squares: f64 = time.windows(2).zip(&rates[1.min(rates.len())..]).map(|(t, rate)| rate * rate * (t[1] - t[0])).sum();
    let rms = if duration > 0.0 { (squares / duration).sqrt() } else { 0.0 };
    [peak, rms, rates.last().copied().unwrap_or(0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_weighs_what_its_rectangles_do() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron");
        let design = crate::input::read_coil(file.as_ref()).unwrap().design;
        let ring = |inner: f64, outer: f64, height: f64| PI * (outer * outer - inner * inner) * height * 1e-9;
        // hub from the coil's left face to the outer face of the flange, which begins at the bore
        let expected = 1400.0 * ring(43.5, 48.825, 18.02) + 2700.0 * (ring(39.5, 43.5, 18.02) + ring(39.5, 49.825, 2.0));
        let found = mass(&design).unwrap();
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }

    #[test]
    fn a_course_in_three_numbers() {
        assert_eq!(course(&[0.0, 1.0, 4.0], &[0.0, -2.0, 1.0]), [2.0, (7.0_f64 / 4.0).sqrt(), 1.0]);
        assert_eq!(course(&[0.0], &[0.5]), [0.5, 0.0, 0.5]);
    }
}
