//! Rates that are added, by the temperature of a body.

use super::form::{Form, Ranges, lag, state, two};

/// Width of a transition of a polymer, as calorimetry shows it (ISO 11357-2: some kelvin) \[K\].
const TRANSITION_K: f64 = 3.0;
/// Temperature by which a path of a centimetre of fibre grows by a wavelength: λ/(L·dn/dT), 1.55 µm over 12 mm times 1.1e-5/K \[K\].
const FRINGE_K: f64 = 12.0;
/// Temperature in which an activated process grows e-fold at room temperature: k·T²/E at 0.5 eV \[K\].
const ACTIVATED_K: f64 = 15.0;

/// Rates that are added, by the temperature of a body.
pub(super) fn forms<'a>(t: &str, ranges: &Ranges) -> Vec<Form<'a>> {
    let Ranges { far, rate, .. } = *ranges;
    let form = |id: &str, what: &str, known, unit, per_size: f64, beside, states: String, law: String| Form {
        id: format!("composed-{id}-{t}"),
        title: format!("A rate {what} the temperature of the {t}"),
        known,
        stage: "Optics",
        per_size,
        unit,
        beside,
        states,
        target: "Rate",
        law: law.replace('T', t),
    };
    let none = String::new;
    // a tenth of the range is a play that several turns show
    let play = ranges.span() / 10.0;
    let at = || {
        let [low, high] = ranges.temperatures.map(|x| format!("{x:.1?}"));
        ("at", "degC", format!("Uniform({low}, {high})"), ranges.across(5))
    };
    let middle = || ("middle", "degC", format!("Normal(20.0, {})", two(far)), vec![20.0]);
    let width = || ("width", "K", format!("LogNormal({TRANSITION_K:?}, 0.7)"), vec![TRANSITION_K]);
    vec![
        form(
            "square",
            "with the square of",
            "read-out or source whose drift bends",
            "deg/h/K2",
            far.powi(2),
            vec![middle()],
            none(),
            "size * (T - middle)^2".into(),
        ),
        form(
            "cube",
            "with the cube of",
            "read-out whose drift bends twice",
            "deg/h/K3",
            far.powi(3),
            vec![],
            none(),
            "size * (T - 20)^3".into(),
        ),
        form(
            "rate",
            "with the rate of",
            "thermal phase of a part outside the coil",
            "deg s/h/K",
            rate,
            vec![],
            none(),
            "size * T_rate".into(),
        ),
        form(
            "speed",
            "with the size of the rate of",
            "losses or polarisation in a gradient, whichever its sign",
            "deg s/h/K",
            rate,
            vec![],
            none(),
            "size * abs(T_rate)".into(),
        ),
        form(
            "direction",
            "with the direction of",
            "friction or stick-slip of a mount",
            "deg/h",
            1.0,
            vec![("slow", "K/s", format!("LogNormal({}, 0.7)", two(rate / 10.0)), vec![rate / 10.0])],
            none(),
            "size * tanh(T_rate / slow)".into(),
        ),
        form(
            "rate-square",
            "with the squared rate of",
            "phase that is of the second order in gradients",
            "deg s2/h/K2",
            rate.powi(2),
            vec![],
            none(),
            "size * T_rate^2".into(),
        ),
        // a second derivative is always seen through a filter
        form(
            "bend",
            "with the second derivative of",
            "a filter or an inner gradient that builds up",
            "deg s/h/K",
            rate,
            vec![ranges.filter()],
            state("x", "K/s", &format!("{t}_rate"), "tau"),
            "size * (T_rate - x)".into(),
        ),
        form(
            "lag",
            "with what a part lags behind",
            "slow electronics, or a part of another heat capacity",
            "deg/h/K",
            far,
            vec![ranges.memory()],
            lag("x", t, "tau"),
            "size * (T - x)".into(),
        ),
        // the mean of a slab, 8/pi^2 of it in the slowest term, then 1/9 and 1/25 of that (Crank, The Mathematics of Diffusion, 4.3)
        form(
            "memory",
            "with the memory of",
            "diffusion: moisture, or heat in a thick part",
            "deg/h/K",
            far,
            vec![ranges.memory()],
            lag("x", t, "tau") + &lag("y", t, "tau / 9") + &lag("z", t, "tau / 25"),
            "size * (T - (x + y / 9 + z / 25) / (1 + 1 / 9 + 1 / 25))".into(),
        ),
        form(
            "play",
            "with the play of",
            "hysteresis: friction, or a polymer that yields",
            "deg/h/K",
            far / 2.0,
            vec![("width", "K", format!("LogNormal({}, 0.8)", two(play)), [0.4, 1.0, 2.5].map(|x| x * play).to_vec())],
            format!("        (name: \"x\", unit: \"degC\", goes: Play(of: \"{t}\", width: \"width\")),\n"),
            "size * (T - x)".into(),
        ),
        form(
            "highest",
            "with how far from its highest is",
            "annealing or ratcheting",
            "deg/h/K",
            far,
            vec![],
            format!("        (name: \"x\", unit: \"degC\", goes: Highest(\"{t}\")),\n"),
            "size * (x - T)".into(),
        ),
        form(
            "lowest",
            "with how far from its lowest is",
            "cracking or ratcheting in the cold",
            "deg/h/K",
            far,
            vec![],
            format!("        (name: \"x\", unit: \"degC\", goes: Lowest(\"{t}\")),\n"),
            "size * (T - x)".into(),
        ),
        form(
            "threshold",
            "beyond a threshold of",
            "a transition, or a mode that hops",
            "deg/h",
            1.0,
            vec![at(), width()],
            none(),
            "size / (1 + exp(-(T - at) / width))".into(),
        ),
        form(
            "knee",
            "beyond a knee of",
            "contact that closes, or a thermostat",
            "deg/h/K",
            far,
            vec![at()],
            none(),
            "size * max(0, T - at)".into(),
        ),
        form(
            "period",
            "that is periodic in",
            "interference: polarisation or a spurious reflection",
            "deg/h",
            1.0,
            vec![
                ("period", "K", format!("LogNormal({FRINGE_K:?}, 0.8)"), ranges.periods()),
                ("phase", "1", "Uniform(-3.1416, 3.1416)".to_owned(), vec![0.0, 1.5]),
            ],
            none(),
            "size * sin(2 * pi * (T - 20) / period + phase)".into(),
        ),
        form(
            "pulse",
            "with the rate, at one value, of",
            "latent heat: ice, or a polymer that melts",
            "deg s/h/K",
            rate,
            vec![("at", "degC", at().2, ranges.every(2.0 * TRANSITION_K)), width()],
            none(),
            "size * T_rate * exp(-((T - at) / width)^2)".into(),
        ),
        // something happens at one temperature, nothing on both sides of it
        form(
            "bump",
            "that peaks at one value of",
            "a resonance or a mode that crosses, or a loss of a polymer that peaks",
            "deg/h",
            1.0,
            vec![("at", "degC", at().2, ranges.every(2.0 * TRANSITION_K)), width()],
            none(),
            "size * exp(-((T - at) / width)^2)".into(),
        ),
        form(
            "growth",
            "that grows exponentially with",
            "an activated process (Arrhenius): leakage, dark current",
            "deg/h",
            3.0,
            vec![("scale", "K", format!("LogNormal({ACTIVATED_K:?}, 0.5)"), vec![ACTIVATED_K])],
            none(),
            "size * exp((T - 20) / scale)".into(),
        ),
        form(
            "rate-by-level",
            "with rate times level of",
            "a constant that depends on temperature",
            "deg s/h/K2",
            far * rate,
            vec![],
            none(),
            "size * (T - 20) * T_rate".into(),
        ),
        form(
            "heating",
            "with the power that heats or holds",
            "field of a heater's current",
            "deg s/h/K",
            rate,
            vec![ranges.memory()],
            none(),
            "size * max(0, T_rate + (T - 20) / tau)".into(),
        ),
        form(
            "cooling",
            "with the power that cools",
            "field of a cooler's current, or its vibration",
            "deg s/h/K",
            rate,
            vec![ranges.memory()],
            none(),
            "size * max(0, (20 - T) / tau - T_rate)".into(),
        ),
    ]
}
