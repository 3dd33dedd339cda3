//! Conversion factors between SI and the units in which gyroscopes are quoted; multiply by `A_PER_B` to go from B to A.

use std::f64::consts::PI;

/// Speed of light in vacuum c \[m/s\].
pub const SPEED_OF_LIGHT: f64 = 299_792_458.0;
/// Degrees in a radian.
pub const DEG_PER_RAD: f64 = 180.0 / PI;
/// Seconds in a minute.
pub const S_PER_MIN: f64 = 60.0;
/// Seconds in an hour.
pub const S_PER_H: f64 = 60.0 * S_PER_MIN;
/// Degrees per hour in a radian per second.
pub const DEG_PER_H_PER_RAD_PER_S: f64 = DEG_PER_RAD * S_PER_H;
/// Radians per second in a degree per hour.
pub const RAD_PER_S_PER_DEG_PER_H: f64 = 1.0 / DEG_PER_H_PER_RAD_PER_S;
/// Kelvin per minute in a kelvin per second.
pub const K_PER_MIN_PER_K_PER_S: f64 = S_PER_MIN;
/// (deg/h)/(degC/min) in a (rad/s)/(K/s).
pub const DEG_PER_H_PER_K_PER_MIN_PER_RAD_PER_K: f64 = DEG_PER_H_PER_RAD_PER_S / K_PER_MIN_PER_K_PER_S;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earth_turns_fifteen_degrees_an_hour() {
        // IERS: 7.292115e-5 rad/s
        approx::assert_relative_eq!(7.292115e-5 * DEG_PER_H_PER_RAD_PER_S, 15.0411, max_relative = 1e-5);
        approx::assert_relative_eq!(15.0411 * RAD_PER_S_PER_DEG_PER_H, 7.292115e-5, max_relative = 1e-5);
        // one turn a minute over one kelvin a minute is one turn a kelvin: 21 600 deg/h per K/min
        approx::assert_relative_eq!(2.0 * PI * DEG_PER_H_PER_K_PER_MIN_PER_RAD_PER_K, 21_600.0, max_relative = 1e-15);
    }
}
