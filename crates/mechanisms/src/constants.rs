//! The design's own constants, each known to its tolerance.

use coil::{Design, Number, Parameter, Tolerance, Tolerances};
use diagnosis::{Nuisance, Prior, Role};

/// A constant of a design that a unit may have otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Constant {
    /// Which.
    pub(crate) parameter: Parameter,
    /// Its value in the drawing, SI.
    pub(crate) drawn: f64,
    /// Deviation of a unit, one standard deviation, SI.
    pub(crate) tolerance: f64,
}

/// The constants of a design that have a tolerance.
pub(crate) fn constants(design: &Design, tolerances: &Tolerances) -> Vec<Constant> {
    let of = |(parameter, drawn, tolerance)| Constant { parameter, drawn, tolerance };
    tolerances.constants(design).into_iter().map(of).collect()
}

impl Constant {
    /// Its name in every output.
    pub(crate) fn name(&self) -> &'static str {
        name(self.parameter)
    }

    /// Whether it is told as a factor on the drawing's value, as all but lengths are; these are told in mm.
    pub(crate) fn is_factor(&self) -> bool {
        !matches!(self.parameter.tolerance(), Tolerance::Absolute(_))
    }

    /// The unit in which it is told.
    fn unit(&self) -> f64 {
        if self.is_factor() { self.drawn } else { 1e-3 }
    }

    pub(crate) fn nuisance(&self) -> Nuisance {
        let (mean, sd) = (self.drawn / self.unit(), (self.tolerance / self.unit()).abs());
        Nuisance {
            parameter: diagnosis::Parameter::new(self.name(), Prior::Normal { mean, sd }),
            role: Role::Constant,
            local: false,
        }
    }

    /// Text of a value in SI.
    pub(crate) fn told(&self, value: f64) -> f64 {
        value / self.unit()
    }

    /// Its value, SI, from that in which it is told.
    pub(crate) fn value(&self, told: f64) -> f64 {
        told * self.unit()
    }
}

fn name(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::CoilConductivity => "k_r",
        Parameter::CoilSpecificHeat => "specific heat of the coil",
        Parameter::CoilDensity => "density of the coil",
        Parameter::AxialModulus => "E_z",
        Parameter::TransverseModulus => "E_r and G",
        Parameter::ShearRatio => "G/E_r",
        Parameter::AxialPoisson => "nu_zr",
        Parameter::TransversePoisson => "nu_r",
        Parameter::AxialExpansion => "alpha_z",
        Parameter::TransverseExpansion => "alpha_r",
        Parameter::SpoolConductivity => "spool conductivity",
        Parameter::SpoolSpecificHeat => "spool specific heat",
        Parameter::SpoolDensity => "spool density",
        Parameter::SpoolModulus => "spool modulus",
        Parameter::SpoolPoisson => "spool Poisson's ratio",
        Parameter::SpoolExpansion => "spool expansion",
        Parameter::MediumConductivity => "conductivity of the surroundings",
        Parameter::MediumSpecificHeat => "specific heat of the surroundings",
        Parameter::WindingStart => "start of the winding [mm]",
        Parameter::WindingEnd => "end of the winding [mm]",
        Parameter::HubThickness => "hub thickness [mm]",
        Parameter::FlangeThickness => "flange thickness [mm]",
        Parameter::FlangeOverhang => "flange overhang [mm]",
        Parameter::Margin => "margin [mm]",
        Parameter::Film => "film coefficient",
        Parameter::HubResistance => "hub resistance",
        Parameter::FlangeResistance(_) => "flange resistance",
        Parameter::Mount(_) => "mount",
        Parameter::Heater(_) => "heater",
    }
}

/// Name of the nuisance that is the factor on ∂n/∂T.
const DN_DT: &str = "dn/dT";
/// Name of the nuisance that is the CW tail's length less the CCW one's, beyond what is drawn.
const TAILS: &str = "CW tail less CCW tail, beyond the drawing's [m]";
/// Name of the nuisance that is the factor on the thermometer's lag.
const SENSOR_LAG: &str = "lag of the spool's thermometer";

/// Standard deviation of the difference of the tails, both of which vary \[m\].
pub(crate) fn tails(design: &Design, tolerances: &Tolerances) -> f64 {
    let of = |length: f64| tolerances.of(Number::Tail).of(length);
    of(design.winding.tails.cw).hypot(of(design.winding.tails.ccw))
}

/// Further numbers of a design with a tolerance: optics, tails, thermometer.
pub(crate) fn others(design: &Design, tolerances: &Tolerances) -> [Nuisance; 3] {
    // none at all is a number that is known: a hair keeps the unknown one
    let share = |number: Number, value: f64| (tolerances.of(number).of(value) / value.abs().max(f64::MIN_POSITIVE)).max(KNOWN);
    [
        Nuisance::normal(DN_DT, 1.0, share(Number::ThermoOptic, design.optics.thermo_optic), Role::Constant),
        Nuisance::normal(TAILS, 0.0, tails(design, tolerances).max(KNOWN), Role::Constant),
        Nuisance::normal(SENSOR_LAG, 1.0, share(Number::SensorLag, design.sensor.lag.max(KNOWN)), Role::Sensor),
    ]
}

/// The number of a design that the forward model gives a name; `None` for a name of something else.
pub fn number_of(name: &str) -> Option<Number> {
    match name {
        DN_DT => Some(Number::ThermoOptic),
        TAILS => Some(Number::Tail),
        SENSOR_LAG => Some(Number::SensorLag),
        _ => Parameter::ALL.iter().find(|p| self::name(**p) == name).map(|p| Number::Constant(*p)),
    }
}

/// Standard deviation of what has no tolerance.
pub(crate) const KNOWN: f64 = 1e-9;

/// A design with a number that is uncertain at a value, by the name that the forward model gives it; `None` for a name of something else.
pub fn with_constant(design: &Design, name: &str, value: f64) -> Option<Design> {
    let mut changed = design.clone();
    match name {
        DN_DT => changed.optics.thermo_optic *= value,
        TAILS => changed = crate::design::with_tail(design, value),
        SENSOR_LAG => changed.sensor.lag *= value,
        _ => {
            let constant = constants(design, &Tolerances::default()).into_iter().find(|c| c.name() == name)?;
            changed = constant.parameter.set(design, constant.value(value));
        }
    }
    Some(changed)
}
