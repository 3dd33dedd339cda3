//! How each mechanism enters the steady sensitivity.

use coil::{Bonds, Design, MechanicalState};
use mechanisms::{with_air, with_hub_resistance, with_mount, with_opening, with_polymer, with_tail};
use winding::LayerDefect;

/// What a mechanism does to a coil in a steady ramp.
pub(super) enum Law {
    /// One number x changes the design, or the state it is in.
    Changes {
        /// Its place among the mechanism's parameters.
        parameter: usize,
        /// The changed design.
        changed: fn(&Design, f64) -> (Design, MechanicalState),
        /// Under which condition.
        when: &'static str,
    },
    /// A layer has too many turns or too few.
    Rewinds,
    /// Nothing.
    Nothing(&'static str),
}

/// A flange's bond is taken as open below this \[°C\], with this hysteresis \[K\]; in a steady state neither matters.
const OPENS: [f64; 2] = [0.0, 1.0];

fn nominal(design: Design) -> (Design, MechanicalState) {
    (design, MechanicalState::NOMINAL)
}

fn softer(design: &Design, transverse_modulus: f64) -> (Design, MechanicalState) {
    (design.clone(), MechanicalState { transverse_modulus, ..MechanicalState::NOMINAL })
}

fn open(design: &Design, share: f64) -> (Design, MechanicalState) {
    (with_opening(design, OPENS[0], OPENS[1], share), MechanicalState { bonds: Bonds::Opened, ..MechanicalState::NOMINAL })
}

fn stretched(design: &Design, transverse_expansion: f64) -> (Design, MechanicalState) {
    (design.clone(), MechanicalState { transverse_expansion, ..MechanicalState::NOMINAL })
}

/// Why what leaves the fields of a steady ramp as they are cannot change the sensitivity.
pub(super) const EVEN: &str = "in a steady ramp everything warms at the same rate: no heat path matters";

/// The laws of a mechanism: a glass transition has one for the stiffness and one for the expansion.
pub(super) fn laws(id: &str) -> Vec<Law> {
    let changes = |parameter, changed, when| Law::Changes { parameter, changed, when };
    let nothing = |why| vec![Law::Nothing(why)];
    match id {
        "tail-asymmetry" => vec![changes(0, |d, x| nominal(with_tail(d, x)), "")],
        "winding-defect" => vec![Law::Rewinds],
        "adhesive-content" => vec![changes(0, |d, x| nominal(with_polymer(d, x)), "")],
        "glass-transition" => vec![changes(2, softer, "above the transition"), changes(3, stretched, "above the transition")],
        "viscoelastic-relaxation" => vec![changes(0, |d, x| softer(d, 1.0 - x), "in ramps much slower than the relaxation")],
        "debond" => vec![changes(2, open, "while the bond is open")],
        "interface-resistance" => vec![changes(0, |d, x| nominal(with_hub_resistance(d, x)), "")],
        "air-path" => vec![changes(0, |d, x| nominal(with_air(d, x)), "")],
        "axial-heat-path" => vec![changes(0, |d, x| nominal(with_mount(d, x)), "")],
        "self-heating" => nothing("a constant power makes a constant field, whose rate is zero"),
        "sensor-lag" => nothing("it acts on the thermometer alone and shifts the temperature, not its rate"),
        "thermo-optic-curvature" => nothing("dn/dT changes alike along the fibre where the temperature is even, and cancels"),
        "rate-temperature-coefficient" => nothing("it follows the temperature, not its rate"),
        _ => nothing("its effect on a steady ramp is not known to this program"),
    }
}

/// A layer with turns too many or too few.
pub(super) fn rewound(design: &Design, layer: usize, turns: i32) -> Design {
    let mut changed = design.clone();
    changed.winding.defect = (turns != 0).then_some(LayerDefect { layer, turns });
    changed
}
