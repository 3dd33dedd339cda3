//! What a mechanism is, in a sentence.

/// Of one of the library; `None` for an id that it does not have.
pub(super) fn meaning(id: &str) -> Option<&'static str> {
    Some(match id {
        "tail-asymmetry" => "the fibre's tails outside the winding are of unequal length; tail_m is the CW one less the CCW one",
        "winding-defect" => "one layer has turns too many (+) or too few (−)",
        "adhesive-content" => "the coil holds more (+) or less (−) polymer than designed, as a share of its volume",
        "glass-transition" => {
            "transverse stiffness and expansion change around tg_c, by the factors, over some width_k to either side"
        }
        "viscoelastic-relaxation" => "the transverse stiffness relaxes by relaxing_fraction with the time constant tau_s",
        "debond" => {
            "below debond_c the outer part of the bond between coil and flange, fraction of its width, carries no force; it closes \
             hysteresis_k above"
        }
        "interface-resistance" => "heat passes between hub and coil through a contact resistance",
        "air-path" => "the surroundings conduct heat better or worse than designed, by conductivity_factor",
        "axial-heat-path" => "the flange's outer face exchanges heat with the chamber through its mount",
        "self-heating" => "power is dissipated at the flange; it was switched on before_s before the first row",
        "sensor-lag" => "the spool's thermometer follows the bore with a time constant of its own",
        "thermo-optic-curvature" => "the fibre's dn/dT depends on temperature",
        "rate-temperature-coefficient" => "the read-out adds a rate proportional to the temperature, from 20 degC",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recommend::inspection;

    #[test]
    fn whatever_can_be_looked_at_has_a_meaning() {
        for id in ["debond", "air-path", "tail-asymmetry", "sensor-lag"] {
            assert!(meaning(id).is_some() && inspection(id).is_some(), "{id}");
        }
        assert_eq!(meaning("unknown:racket"), None);
    }
}
