//! A fibre coil on its spool in a test chamber: temperature, strain at every turn, bias.
//!
//! The coil is homogenised and transversely isotropic with its fibre along the hoop; coil, spool and medium are axisymmetric in
//! (r, y). [`Model`] solves thermo-elasticity on coil and spool,
//!
//! ```text
//! ∫ 2πr ε(v) : (C ε(u) − β ΔT) dr dy = 0,
//! ```
//!
//! gives the strain of the glass at the centre of every turn, and by one adjoint solve per part the bias as a linear functional of
//! the temperature rate at every node ([`BiasOperator`]). In a steady ramp that rate is uniform and its sum is the sensitivity:
//! [`steady_sensitivity`], with an error measured on a finer mesh. [`ThermalModel`] is the heat flow, stepped in full or reduced to
//! a few exponentials ([`Reduced`], stepped by [`Steps`]); [`Dynamics`] runs a chamber profile through both, and [`TurnFields`] gives temperature and strain
//! of every turn back, [`Section`] those everywhere in coil and spool. [`ParametricModel`] does the same for all designs within ranges of their constants and dimensions, in milliseconds, with
//! derivatives.
//!
//! Conventions: SI units; y = 0 is the coil's left face, +y its right; the strain-free state is ΔT = 0; surfaces are free of
//! traction and each connected body is held at one point along y. Unbonded faces are gaps of 0.2 mm. Tails are bare fibre that
//! expands freely at the temperature of the hub's bore.
//!
//! References: B. Osunluk, S. Ogut and E. Ozbay, *Thermally Induced Bias Errors for a Fiber Coil with Practical Quadrupole Winding*;
//! I. Babuška and B. Q. Guo, *SIAM J. Numer. Anal.* 25, 837 (1988), for the grading of the mesh; A. Ruhe, *Linear Algebra Appl.* 58,
//! 391 (1984), for the Krylov space of the reduction; G. Rozza, D. B. P. Huynh and A. T. Patera, *Arch. Comput. Methods Eng.* 15, 229 (2008), for
//! the reduced basis over parameters.

mod band;
mod design;
mod dynamics;
mod error;
mod fields;
mod grid;
mod inverse;
mod layout;
mod mechanics;
mod model;
mod parametric;
mod probe;
mod profile;
mod section;
mod sensitivity;
mod thermal;
mod trim;
mod turns;

pub use band::{Band, SensitivityChange, propagated, sensitivity_band, sensitivity_changes};
pub use design::{
    Body, Contact, Dehomogenization, Design, Drifts, FactorsAt, Flange, FlangeContact, HeatPaths, Heater, Mechanics, Mount,
    Opening, Sensor, Side, Solid, Spool, Surroundings,
};
pub use dynamics::{COARSER, Dynamics, Fidelity, REDUCTION_SAFETY, ReductionError, Response, STANDARD, functionals};
pub use error::Error;
pub use fields::TurnFields;
pub use grid::{Bonds, Grid, MeshFineness};
pub use inverse::{FEWEST_ROWS, Inferred, LEAST_NOISE, chamber_from_sensor};
pub use layout::{Domain, Layout, Rectangle, Region};
pub use mechanics::{MechanicalState, Relaxation};
pub use model::{BiasOperator, Model};
pub use parametric::{
    Courses, Effort as ModelEffort, FieldsOn, MODEL_SAFETY, MODULI, Number, Parameter, ParametricModel, Projected, Range, Slopes,
    Tolerance, Tolerances,
};
pub use profile::{Profile, Smooth};
pub use section::{Places, PointValues, Section, SectionElement, SectionFields, SectionState};
pub use sensitivity::{
    CHECKS, COARSE, FACTOR, FINE, SAFETY, STEADY, SteadySensitivity, sensitivity_in, sensitivity_on, steady_sensitivity,
};
pub use thermal::{
    Drive, FullRun, Output, Outputs, RampLag, Reduced, Reduction, Step, Steps, ThermalModel, ThermalState, ramp_lag,
};
pub use trim::{TailTrim, TurnTrim, tail_asymmetry, trim_tails, trim_turns, with_asymmetry};
pub use turns::TurnValues;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
