//! What to look at where no test in the chamber tells.

/// A check of the unit itself that decides about a mechanism.
pub(crate) fn inspection(id: &str) -> Option<&'static str> {
    Some(match id {
        "tail-asymmetry" => "measure both tails' lengths outside the winding",
        "winding-defect" => "count the turns of each layer in the winding record, or section a sister unit",
        "adhesive-content" => "weigh the coil before and after potting, or section a sister unit",
        "glass-transition" => "measure the adhesive's storage modulus against temperature (DMA)",
        "viscoelastic-relaxation" => "measure the adhesive's stress relaxation (DMA)",
        "debond" => "look at the flange's bond with ultrasound",
        "interface-resistance" => "heat the hub and record a thermometer on the coil's outer surface",
        "air-path" => "repeat the test in vacuum or in another gas",
        "axial-heat-path" => "repeat the test with the flange insulated from its mount",
        "self-heating" => "switch the electronics on at a steady chamber temperature",
        "sensor-lag" => "dip the thermometer alone into a bath",
        "thermo-optic-curvature" => "measure the fibre's dn/dT at both ends of the range",
        "rate-temperature-coefficient" => "exchange the electronics, or warm them alone",
        _ => return None,
    })
}
