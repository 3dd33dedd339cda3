//! The mechanisms that the program knows: a file for each, a line for each here.

use crate::mechanism::Mechanism;

/// Declares a module for each mechanism and lists what the module's value of that name says.
macro_rules! catalogue {
    ($($module:ident $mechanism:ident)*) => {
        $(pub(crate) mod $module;)*

        /// All mechanisms that come with the crate: those with a name, then those that only describe.
        pub const CATALOGUE: &[&dyn Mechanism] = &[$(&$module::$mechanism,)*];
    };
}

catalogue! {
    tail_asymmetry TAIL_ASYMMETRY
    winding_defect WINDING_DEFECT
    adhesive_content ADHESIVE_CONTENT
    glass_transition GLASS_TRANSITION
    viscoelastic_relaxation VISCOELASTIC_RELAXATION
    debond DEBOND
    interface_resistance INTERFACE_RESISTANCE
    air_path AIR_PATH
    axial_heat_path AXIAL_HEAT_PATH
    mount_conductance MOUNT_CONDUCTANCE
    self_heating SELF_HEATING
    sensor_lag SENSOR_LAG
    chamber_lag CHAMBER_LAG
    thermo_optic_curvature THERMO_OPTIC_CURVATURE
    rate_temperature_coefficient RATE_TEMPERATURE_COEFFICIENT
    compensated_rate COMPENSATED_RATE
    polarisation_ripple POLARISATION_RIPPLE
    moisture MOISTURE
    ratcheting RATCHETING
    spool_expansion SPOOL_EXPANSION
    racket RACKET
    magnetic MAGNETIC
}

pub(crate) mod on_request;

pub use on_request::ON_REQUEST;
pub use rate_temperature_coefficient::usual_coefficient;

/// A mechanism of the [`CATALOGUE`], or of those [`ON_REQUEST`], by its id.
pub fn find(id: &str) -> Option<&'static dyn Mechanism> {
    CATALOGUE.iter().chain(ON_REQUEST).copied().find(|mechanism| mechanism.facts().id == id)
}
