//! Bias of one metre of bare tail that warms by 1 °C/min at the CW end of a kilometre of fibre, free to expand.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use bias::{Error, Optics, Sensitivity, Slice, StrainConvention, bias};

fn main() -> Result<(), Error> {
    let optics = Optics {
        refractive_index: 1.45,
        thermo_optic: 1.0e-5,
        thermal_expansion: 0.55e-6,
        p11: 0.121,
        p12: 0.270,
        sagnac_diameter: 92.325e-3,
        strain: StrainConvention::Mechanical,
    };
    let rate = 1.0 / 60.0;
    let strain_rate = optics.thermal_expansion * rate;
    let tail = Slice {
        z_start: 999.0,
        z_end: 1000.0,
        temperature_rate: rate,
        axial_strain_rate: strain_rate,
        radial_strain_rate: strain_rate,
    };
    let sensitivity = Sensitivity::from_ramp(&bias(&optics, 1000.0, &[tail])?, rate)?;
    println!("{:.4} (deg/h)/(degC/min)", sensitivity.total());
    assert!((sensitivity.total() - -0.5824).abs() < 5e-5, "{sensitivity:?}");
    Ok(())
}
