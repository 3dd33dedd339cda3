//! The small laws that are tried where nothing that is listed explains a record, each as a mechanism's file.

use std::fmt::Write as _;

use mechanisms::Scene;

/// How far what laws depend on goes in the records that are fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ranges {
    /// Coldest and hottest \[°C\].
    temperatures: [f64; 2],
    /// Farthest from 20 °C \[K\].
    far: f64,
    /// Fastest of the spool \[K/s\].
    rate: f64,
    /// Longest record \[s\].
    duration: f64,
    /// Largest |part| of the bias as designed, and of the sum \[deg/h\].
    parts: [f64; 4],
    /// Size that is expected of an effect \[deg/h\].
    size: f64,
}

/// Size that is expected of an effect, in noises of a reading of a minute: what is larger is seen by eye, and what is smaller hardly at all.
const EXPECTED: f64 = 30.0;
/// Time in which a rate changes as much as it has, for the scale of a second derivative \[s\].
const TURN_S: f64 = 600.0;

impl Ranges {
    pub(crate) fn new(scene: &Scene, rate: f64, duration: f64, parts: [f64; 4]) -> Self {
        let temperatures = scene.temperatures;
        let far = temperatures.map(|t| (t - mechanisms::REFERENCE_C).abs()).into_iter().fold(1.0, f64::max);
        Self {
            temperatures,
            far,
            rate: rate.max(1e-9),
            duration: duration.max(1.0),
            parts: parts.map(|part| part.max(1e-12)),
            size: EXPECTED * scene.noise,
        }
    }

    /// Periods \[K\] that differ by a third of a cycle over the range, or somewhat more, from two cycles in it on, 4 K or longer: what lies between them a fit finds.
    fn periods(&self) -> Vec<f64> {
        const LEAST_K: f64 = 4.0;
        const MOST: usize = 50;
        let [low, high] = self.temperatures;
        let most = ((high - low) / LEAST_K).max(2.0);
        let step = ((most - 2.0) / (MOST - 1) as f64).clamp(1.0 / 3.0, 0.6);
        let cycles = (0..MOST).map(|k| 2.0 + step * k as f64).take_while(|cycles| *cycles <= most);
        let periods: Vec<f64> = cycles.map(|cycles| (high - low).max(1.0) / cycles).collect();
        if periods.is_empty() { vec![LEAST_K] } else { periods }
    }

    /// So many temperatures evenly over the range.
    fn across(&self, count: u32) -> Vec<f64> {
        let [low, high] = self.temperatures;
        (0..count).map(|k| low + (high - low) * (f64::from(k) + 0.5) / f64::from(count)).collect()
    }
}

/// A law as a mechanism's file, and the known physics that has its form.
pub(crate) struct Law {
    pub(crate) text: String,
    pub(crate) known: &'static str,
}

/// A parameter beside the size: name, unit, prior, starts.
type Beside = (&'static str, &'static str, String, Vec<f64>);

struct Form<'a> {
    id: String,
    title: String,
    known: &'static str,
    stage: &'static str,
    /// what the law is where the size is 1 in its unit, at most
    per_size: f64,
    unit: &'a str,
    beside: Vec<Beside>,
    states: String,
    target: &'static str,
    law: String,
}

/// Numbers of a prior, to two digits.
fn two(x: f64) -> String {
    format!("{x:.1e}").parse::<f64>().map_or_else(|_| x.to_string(), |x| format!("{x:?}"))
}

impl Form<'_> {
    fn law(&self, expected: f64) -> Law {
        let sd = two(expected / self.per_size);
        let mut parameters =
            format!("        (name: \"size\", unit: \"{}\", prior: Normal(0.0, {sd}), starts: [{sd}]),\n", self.unit);
        for (name, unit, prior, starts) in &self.beside {
            let starts: Vec<String> = starts.iter().map(|x| two(*x)).collect();
            let starts = starts.join(", ");
            let _ = writeln!(parameters, "        (name: \"{name}\", unit: \"{unit}\", prior: {prior}, starts: [{starts}]),");
        }
        let Self { id, title, stage, states, target, law, .. } = self;
        let states = if states.is_empty() { String::new() } else { format!("    states: [\n{states}    ],\n") };
        let text = format!(
            "(\n    id: \"{id}\",\n    title: \"{title}\",\n    stage: {stage},\n    source: \"composed by fogcoil diagnose; known physics of this form: {}\",\n    \
             parameters: [\n{parameters}    ],\n{states}    laws: [{target}(\"{law}\")],\n)\n",
            self.known
        );
        Law { text, known: self.known }
    }
}

/// A state that follows `of` with a time constant.
fn lag(name: &str, of: &str, tau: &str) -> String {
    format!("        (name: \"{name}\", unit: \"degC\", goes: Rate(rate: \"({of} - {name}) / ({tau})\", first: \"{of}\")),\n")
}

/// All laws, for records of these ranges.
pub(crate) fn laws(ranges: &Ranges) -> Vec<Law> {
    let mut all = Vec::new();
    for body in ["chamber", "spool", "coil"] {
        all.extend(of_temperature(body, ranges).iter().map(|form| form.law(ranges.size)));
    }
    all.extend(of_time(ranges).iter().map(|form| form.law(ranges.size)));
    for (target, what) in [
        ("Bias", "all parts of the bias"),
        ("Shupe", "the thermal phase"),
        ("Axial", "the axial strain's part"),
        ("Radial", "the radial strain's part"),
    ] {
        all.extend(of_part(target, what, ranges).iter().map(|form| form.law(ranges.size)));
    }
    all
}

/// Rates that are added, by the temperature of a body.
fn of_temperature<'a>(t: &str, ranges: &Ranges) -> Vec<Form<'a>> {
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
    let tau =
        |median: f64| ("tau", "s", format!("LogNormal({}, 1.0)", two(median)), [0.2, 1.0, 5.0].map(|x| x * median).to_vec());
    let at = || {
        let [low, high] = ranges.temperatures.map(|x| format!("{x:.1?}"));
        ("at", "degC", format!("Uniform({low}, {high})"), ranges.across(5))
    };
    let middle = || ("middle", "degC", "Normal(20.0, 30.0)".to_owned(), vec![20.0]);
    let width = || ("width", "K", "LogNormal(3.0, 0.7)".to_owned(), vec![3.0]);
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
        form(
            "bend",
            "with the second derivative of",
            "a filter or an inner gradient that builds up",
            "deg s2/h/K",
            rate / TURN_S,
            vec![],
            none(),
            "size * T_rate2".into(),
        ),
        form(
            "lag",
            "with what a part lags behind",
            "slow electronics, or a part of another heat capacity",
            "deg/h/K",
            far,
            vec![tau(1500.0)],
            lag("x", t, "tau"),
            "size * (T - x)".into(),
        ),
        form(
            "memory",
            "with the memory of",
            "diffusion: moisture, or heat in a thick part",
            "deg/h/K",
            far,
            vec![tau(600.0)],
            lag("x", t, "tau") + &lag("y", t, "5 * tau") + &lag("z", t, "25 * tau"),
            "size * (T - (x + y + z) / 3)".into(),
        ),
        form(
            "play",
            "with the play of",
            "hysteresis: friction, or a polymer that yields",
            "deg/h/K",
            far / 2.0,
            vec![("width", "K", "LogNormal(10.0, 0.8)".to_owned(), vec![4.0, 10.0, 25.0])],
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
                ("period", "K", "LogNormal(12.0, 0.8)".to_owned(), ranges.periods()),
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
            vec![at(), width()],
            none(),
            "size * T_rate * exp(-((T - at) / width)^2)".into(),
        ),
        form(
            "growth",
            "that grows exponentially with",
            "an activated process (Arrhenius): leakage, dark current",
            "deg/h",
            3.0,
            vec![("scale", "K", "LogNormal(15.0, 0.5)".to_owned(), vec![15.0])],
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
            vec![tau(2000.0)],
            none(),
            "size * max(0, T_rate + (T - 20) / tau)".into(),
        ),
        form(
            "cooling",
            "with the power that cools",
            "field of a cooler's current, or its vibration",
            "deg s/h/K",
            rate,
            vec![tau(2000.0)],
            none(),
            "size * max(0, (20 - T) / tau - T_rate)".into(),
        ),
    ]
}

/// Rates that are added, by the time.
fn of_time<'a>(ranges: &Ranges) -> Vec<Form<'a>> {
    let duration = ranges.duration;
    let form = |id: &str, what: &str, known, unit, per_size: f64, beside, law: &str| Form {
        id: format!("composed-{id}"),
        title: format!("A rate that {what}"),
        known,
        stage: "Electronics",
        per_size,
        unit,
        beside,
        states: String::new(),
        target: "Rate",
        law: law.into(),
    };
    let share = |k: f64| k * duration;
    let at = ("at", "s", format!("Uniform(0.0, {})", two(duration)), [0.1, 0.3, 0.5, 0.7, 0.9].map(share).to_vec());
    let tau = ("tau", "s", format!("LogNormal({}, 1.0)", two(duration / 5.0)), [0.03, 0.1, 0.3].map(share).to_vec());
    vec![
        form("drift", "drifts with time", "ageing, or a leak", "deg/h/s", duration, vec![], "size * time"),
        form(
            "step",
            "steps once",
            "a connector, or a mode that hops",
            "deg/h",
            1.0,
            vec![at, ("width", "s", format!("LogNormal({}, 1.0)", two(duration / 100.0)), vec![duration / 100.0])],
            "size * (1 + tanh((time - at) / width)) / 2",
        ),
        form("fading", "fades after the start", "warm-up, or drying", "deg/h", 1.0, vec![tau], "size * exp(-time / tau)"),
    ]
}

/// Relative changes of a part of the bias, by the temperature of the coil.
fn of_part<'a>(target: &'static str, what: &str, ranges: &Ranges) -> Vec<Form<'a>> {
    let Ranges { far, rate, parts, .. } = *ranges;
    let [shupe, axial, radial, all] = parts;
    let bias = match target {
        "Shupe" => shupe,
        "Axial" => axial,
        "Radial" => radial,
        _ => all,
    };
    let form = |id: &str, with: &str, known, unit, per_size: f64, beside, states: String, law: &str| Form {
        id: format!("composed-{id}-of-{}", target.to_lowercase()),
        title: format!("A change of {what} with {with}"),
        known,
        stage: "Material",
        per_size: per_size * bias,
        unit,
        beside,
        states,
        target,
        law: law.into(),
    };
    let tau = ("tau", "s", "LogNormal(3000.0, 1.0)".to_owned(), vec![600.0, 3000.0, 15_000.0]);
    let none = String::new;
    vec![
        form(
            "level",
            "the coil's temperature",
            "constants that depend on temperature",
            "1/K",
            far,
            vec![],
            none(),
            "size * (coil - 20)",
        ),
        form(
            "square",
            "the square of the coil's temperature",
            "constants that bend with temperature",
            "1/K2",
            far.powi(2),
            vec![],
            none(),
            "size * (coil - 20)^2",
        ),
        form(
            "speed",
            "the speed of the coil's temperature",
            "stiffness that depends on the rate of strain",
            "s/K",
            rate,
            vec![],
            none(),
            "size * abs(coil_rate)",
        ),
        form(
            "lag",
            "what lags behind the coil's temperature",
            "relaxation, or swelling by moisture",
            "1/K",
            far,
            vec![tau],
            lag("x", "coil", "tau"),
            "size * (coil - x)",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_law_is_a_mechanism_file_of_its_own() {
        let scene = Scene { temperatures: [-38.7, 61.2], noise: 0.004 };
        let laws = laws(&Ranges::new(&scene, 0.017, 80_000.0, [0.1, 2.4, 0.3, 2.5]));
        let mut ids = Vec::new();
        for law in &laws {
            let case = crate::input::check_mechanism("law".as_ref(), law.text.clone())
                .unwrap_or_else(|error| panic!("{error}\n{}", law.text));
            assert!(!case.mechanism.starts.is_empty() && case.mechanism.starts.iter().all(|start| start[0] != 0.0));
            assert!(!ids.contains(&case.mechanism.id), "{}", case.mechanism.id);
            ids.push(case.mechanism.id);
        }
        assert_eq!(ids.len(), 79);
    }
}
