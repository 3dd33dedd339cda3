//! Rates that are added, by the time.

use super::form::{Form, Ranges, two};

/// Rates that are added, by the time.
pub(super) fn forms<'a>(ranges: &Ranges) -> Vec<Form<'a>> {
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
