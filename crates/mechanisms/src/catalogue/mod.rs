//! The mechanisms that the program knows: a file for each, a line for each here.

use crate::mechanism::Mechanism;

/// Declares a module for each mechanism and lists what the module's type of the same name says.
macro_rules! catalogue {
    ($($module:ident $mechanism:ident)*) => {
        $(pub(crate) mod $module;)*

        /// All mechanisms that come with the crate: those with a name, then those that only describe.
        pub const CATALOGUE: &[&dyn Mechanism] = &[$(&$module::$mechanism,)*];
    };
}

catalogue! {
    tail_asymmetry TailAsymmetry
    winding_defect WindingDefect
    adhesive_content AdhesiveContent
    glass_transition GlassTransition
    viscoelastic_relaxation ViscoelasticRelaxation
    debond Debond
    interface_resistance InterfaceResistance
    air_path AirPath
    axial_heat_path AxialHeatPath
    self_heating SelfHeating
    sensor_lag SensorLag
    thermo_optic_curvature ThermoOpticCurvature
    rate_temperature_coefficient RateTemperatureCoefficient
    polarisation_ripple PolarisationRipple
    moisture Moisture
    ratcheting Ratcheting
    spool_expansion SpoolExpansion
    racket Racket
    magnetic Magnetic
}

/// A mechanism of the [`CATALOGUE`] by its id.
pub fn find(id: &str) -> Option<&'static dyn Mechanism> {
    CATALOGUE.iter().copied().find(|mechanism| mechanism.facts().id == id)
}
