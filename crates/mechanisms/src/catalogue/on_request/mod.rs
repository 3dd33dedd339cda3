//! Mechanisms that are weighed where somebody asks for them: their records look like those of other physics, so that a form alone must not name them.

use crate::mechanism::Mechanism;

mod fick;

/// Declares a module for each mechanism and lists what the module's value of that name says.
macro_rules! on_request {
    ($($module:ident $mechanism:ident)*) => {
        $(pub(crate) mod $module;)*

        /// Mechanisms that come with the crate and are offered where they are asked for, beside the [`CATALOGUE`](crate::CATALOGUE).
        pub const ON_REQUEST: &[&dyn Mechanism] = &[$(&$module::$mechanism,)*];
    };
}

on_request! {
    polarisation_ripple POLARISATION_RIPPLE
    magneto_optic MAGNETO_OPTIC
    constant_field CONSTANT_FIELD
    scale_factor_drift SCALE_FACTOR_DRIFT
    modulator_reset MODULATOR_RESET
    moisture MOISTURE
    drying DRYING
    stress_free_temperature STRESS_FREE_TEMPERATURE
    racket RACKET
    ratcheting RATCHETING
}
