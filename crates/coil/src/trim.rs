//! Tails, or turns to remove at the ends, that null the steady sensitivity of a coil, with their uncertainty.

use crate::band::{Band, sensitivity_band};
use crate::grid::Grading;
use crate::{Design, Error, MechanicalState, Model, STEADY, Tolerances};
use bias::{Sensitivity, Slice};
use winding::{Half, Tails};

/// A tail asymmetry that nulls the sensitivity.
#[derive(Debug, Clone, PartialEq)]
pub struct TailTrim {
    /// CW tail minus CCW tail, the shorter one kept as it is \[m\].
    pub cw_minus_ccw: f64,
    /// Spread of the sensitivity by the design's tolerances, (°/h)/(°C/min); over the slope it is the uncertainty of the asymmetry.
    pub band: Band,
    /// Change of the sensitivity per metre at the null, (°/h)/(°C/min)/m.
    pub slope: f64,
    /// Sensitivity before, (°/h)/(°C/min).
    pub before: f64,
}

/// Effect of removing turns from one end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurnTrim {
    /// The half whose outer end is unwound.
    pub half: Half,
    /// Turns cut off.
    pub turns: usize,
    /// Fibre cut off \[m\].
    pub length: f64,
    /// Sensitivity that is left, (°/h)/(°C/min).
    pub sensitivity: f64,
}

/// Every turn's place along the fibre and its rates in a ramp of 1 K/s, from the CCW end, with the rate of a bare tail.
struct Fibre {
    turns: Vec<Slice>,
    halves: Vec<Half>,
    free_strain: f64,
}

impl Fibre {
    fn new(design: &Design) -> Result<Self, Error> {
        let model = Model::graded(design, &STEADY, Grading::Strain, &MechanicalState::NOMINAL)?;
        let nodes = model.grid().mesh().nodes().len();
        let turns = model.winding().turns();
        let mut slices = model.slices(&vec![1.0; nodes])?;
        slices.truncate(turns.len());
        let halves = turns.iter().map(|t| t.half).collect();
        Ok(Self { turns: slices, halves, free_strain: design.optics.thermal_expansion })
    }

    /// Sensitivity with these tails and without the turns outside `range`.
    fn sensitivity(&self, design: &Design, tails: Tails, range: std::ops::Range<usize>) -> Result<f64, Error> {
        let turns = &self.turns[range];
        let mut z = tails.ccw;
        let mut slices = Vec::with_capacity(turns.len() + 2);
        let tail = |start: f64, length: f64| Slice {
            z_start: start,
            z_end: start + length,
            temperature_rate: 1.0,
            axial_strain_rate: self.free_strain,
            radial_strain_rate: self.free_strain,
        };
        slices.push(tail(0.0, tails.ccw));
        for turn in turns {
            let length = turn.z_end - turn.z_start;
            slices.push(Slice { z_start: z, z_end: z + length, ..*turn });
            z += length;
        }
        slices.push(tail(z, tails.cw));
        let bias = bias::bias(&design.optics, z + tails.cw, &slices)?;
        Ok(Sensitivity::from_ramp(&bias, 1.0)?.total())
    }

    /// CW − CCW asymmetry that gives `target`, and the slope there, by the secant method.
    fn asymmetry(&self, design: &Design, target: f64) -> Result<(f64, f64), Error> {
        let s =
            |x: f64| self.sensitivity(design, with_asymmetry(design, x).winding.tails, 0..self.turns.len()).map(|s| s - target);
        let (mut x0, mut x1) = (0.0, 0.5);
        let (mut f0, mut f1) = (s(x0)?, s(x1)?);
        let mut slope = (f1 - f0) / (x1 - x0);
        for _ in 0..SECANT_STEPS {
            if f1.abs() <= MET || slope == 0.0 {
                break;
            }
            (x0, f0, x1) = (x1, f1, x1 - f1 / slope);
            f1 = s(x1)?;
            slope = (f1 - f0) / (x1 - x0);
        }
        Ok((x1, slope))
    }
}

/// Distance to the target that counts as met, (°/h)/(°C/min): a millionth of a typical sensitivity.
const MET: f64 = 1e-6;
/// Steps of the secant method; the sensitivity is nearly linear in the tails, three suffice.
const SECANT_STEPS: usize = 12;

/// Tail asymmetry CW − CCW \[m\] that gives a steady sensitivity of `target` (°/h)/(°C/min), the shorter tail kept as it is, and the
/// change of sensitivity per metre there.
///
/// # Errors
/// [`Error`] names the dimension or property at fault, or the solve that failed.
pub fn tail_asymmetry(design: &Design, target: f64) -> Result<(f64, f64), Error> {
    Fibre::new(design)?.asymmetry(design, target)
}

impl TailTrim {
    /// Standard uncertainty of the asymmetry \[m\].
    pub fn uncertainty(&self) -> f64 {
        (self.band.sd / self.slope).abs()
    }
}

/// The tail asymmetry that nulls the steady sensitivity of `design`, with the uncertainty that its tolerances leave.
///
/// # Errors
/// [`Error`] names the dimension or property at fault, or the solve that failed.
pub fn trim_tails(design: &Design, tolerances: &Tolerances) -> Result<TailTrim, Error> {
    let fibre = Fibre::new(design)?;
    let (cw_minus_ccw, slope) = fibre.asymmetry(design, 0.0)?;
    let before = fibre.sensitivity(design, design.winding.tails, 0..fibre.turns.len())?;
    let band = sensitivity_band(&with_asymmetry(design, cw_minus_ccw), tolerances)?;
    Ok(TailTrim { cw_minus_ccw, band, slope, before })
}

/// A design with the CW tail longer than the CCW one by so much \[m\], the shorter one as it is.
pub fn with_asymmetry(design: &Design, cw_minus_ccw: f64) -> Design {
    let mut design = design.clone();
    let common = design.winding.tails.cw.min(design.winding.tails.ccw);
    design.winding.tails = Tails { cw: common + cw_minus_ccw.max(0.0), ccw: common + (-cw_minus_ccw).max(0.0) };
    design
}

/// Sensitivity that is left when up to `most` turns are cut off from either outer end, tails as they are.
///
/// # Errors
/// [`Error`] names the dimension or property at fault, or the solve that failed.
pub fn trim_turns(design: &Design, most: usize) -> Result<Vec<TurnTrim>, Error> {
    let fibre = Fibre::new(design)?;
    let count = fibre.turns.len();
    let mut trims = Vec::new();
    for half in [Half::Ccw, Half::Cw] {
        let own = fibre.halves.iter().filter(|h| **h == half).count();
        for turns in 1..=most.min(own.saturating_sub(1)) {
            let (range, cut) = match half {
                Half::Ccw => (turns..count, 0..turns),
                Half::Cw => (0..count - turns, count - turns..count),
            };
            let length = fibre.turns[cut].iter().map(|t| t.z_end - t.z_start).sum();
            let sensitivity = fibre.sensitivity(design, design.winding.tails, range)?;
            trims.push(TurnTrim { half, turns, length, sensitivity });
        }
    }
    Ok(trims)
}
