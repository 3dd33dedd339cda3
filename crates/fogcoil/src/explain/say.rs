//! Explanations in words, as a table, as JSON.

use std::fmt::Write;

use serde_json::{Value, json};

use super::{Explained, Explanation, PLAUSIBLE, Reach, STRAINED, Test};
use crate::input::CoilCase;
use crate::recommend::with;
use crate::table::{odds, significant, table};

fn verdict(sigma: f64) -> &'static str {
    match sigma.abs() {
        s if s <= PLAUSIBLE => "plausible",
        s if s <= STRAINED => "strained",
        _ => "implausible",
    }
}

/// One object; sensitivities in (deg/h)/(degC/min). See docs/schema/explain.schema.json.
pub fn json(e: &Explained) -> Value {
    let of = |x: &Explanation| {
        let outcome = match &x.outcome {
            Reach::Gives { value, error, sigma, layer } => json!({
                "able": true, "value": value, "numerical_error": error, "sigma": sigma, "verdict": verdict(*sigma),
                "layer": layer.map(|l| l.0), "plausible_layers": layer.map(|l| l.1),
            }),
            Reach::OutOfReach { range } => json!({"able": false, "range": range}),
            Reach::Unable { why } => json!({"able": false, "why": why}),
        };
        with(json!({"id": x.id, "parameter": x.parameter, "when": x.when}), outcome)
    };
    let test = |t: &Test| {
        let [slow, best] =
            [&t.slow, &t.best].map(|(name, odds)| json!({"profile": name, "log_odds": odds.log_odds, "decides": odds.decides()}));
        json!({"between": t.between, "slow_ramp": slow, "best": best})
    };
    json!({
        "sensitivity": e.measured,
        "taken_as_magnitude": e.magnitude,
        "nominal": {"sensitivity": e.nominal, "numerical_error": e.error},
        "recalibrate": {"sigma": e.recalibrate, "verdict": verdict(e.recalibrate), "uncertainty": e.constants},
        "explanations": e.explanations.iter().map(of).collect::<Vec<_>>(),
        "drawings": e.drawings.iter().map(|(words, total)| json!({"drawing": words, "sensitivity": total})).collect::<Vec<_>>(),
        "tests": e.tests.iter().map(test).collect::<Vec<_>>(),
    })
}

fn row(x: &Explanation) -> Option<Vec<String>> {
    let when = if x.when.is_empty() { String::new() } else { format!(", {}", x.when) };
    let name = format!("{} ({})", x.id, x.parameter);
    Some(match &x.outcome {
        Reach::Gives { value, error, sigma, layer } => {
            let layer = layer.map_or(String::new(), |(k, n)| match *value {
                0.0 => ": in no layer does a whole turn come nearer than none".into(),
                _ if n < 2 => format!(", in layer {k}"),
                _ => format!(", in layer {k}; as plausibly in {n} layers"),
            });
            let value = format!("{} ± {}", significant(*value, 3), significant(*error, 1));
            vec![name, value, format!("{sigma:+.1}"), format!("{}{layer}{when}", verdict(*sigma))]
        }
        Reach::OutOfReach { range: [low, high] } => {
            vec![name, "-".into(), "-".into(), format!("gives {low:.2} to {high:.2} only{when}")]
        }
        Reach::Unable { .. } => return None,
    })
}

/// The explanations as text.
pub fn text(case: &CoilCase, e: &Explained) -> String {
    let sign = if e.magnitude { " (a magnitude, taken with the design's sign; --signed takes it with its own)" } else { "" };
    let mut out = format!(
        "{}: measured {:.3}{sign}, the design gives {:.3} ± {} (deg/h)/(degC/min)\n\n",
        case.name,
        e.measured,
        e.nominal,
        significant(e.error, 1)
    );
    let mut rows = vec![["one change that gives it", "value (solved)", "sigma", ""].map(str::to_owned).to_vec()];
    let constants = format!("{}; together they leave ± {:.2}", verdict(e.recalibrate), e.constants);
    rows.push(vec!["the design's own constants".into(), "-".into(), format!("{:+.1}", e.recalibrate), constants]);
    rows.extend(e.explanations.iter().filter_map(row));
    out.push_str(&table(&rows));
    out.push('\n');
    let drawings = e.drawings.iter().map(|(words, total)| vec![words.clone(), format!("{total:.3}")]);
    let head = ["the drawing with one word changed", "gives"].map(str::to_owned).to_vec();
    out.push_str(&table(&std::iter::once(head).chain(drawings).collect::<Vec<_>>()));
    out.push_str("\nUnable to change the coil's own sensitivity:\n");
    let mut told = Vec::new();
    for x in &e.explanations {
        if let Reach::Unable { why } = x.outcome {
            // the first of several that have no parameter of their own says it
            if x.parameter.is_empty() && told.contains(&x.id.as_str()) {
                continue;
            }
            told.push(x.id.as_str());
            let several = e.explanations.iter().filter(|other| other.id == x.id).count() > 1;
            let parameter = if several && !x.parameter.is_empty() { format!(" ({})", x.parameter) } else { String::new() };
            let _ = writeln!(out, "  {}{parameter}: {why}", x.id);
        }
    }
    out.push_str(
        "\nOne number cannot tell these apart. In a slow ramp a longer tail and a changed coil are both factors on the slope, so a programme\n\
         with bends tells them better. Expected ln odds at these sizes, prior odds included, in 24 h, -40 to 60 degC, at most 2 K/min:\n",
    );
    let mut rows = vec![["", "slow ramp", "best", "by"].map(str::to_owned).to_vec()];
    for Test { between, slow, best } in &e.tests {
        let says = if best.1.decides() { best.0.clone() } else { format!("{}: does not decide", best.0) };
        let [slow, best] = [slow, best].map(|t| odds(t.1.log_odds, |ln| format!("{ln:.1}")));
        rows.push(vec![format!("{} from {}", between[0], between[1]), slow, best, says]);
    }
    if e.tests.is_empty() {
        out.push_str("  no tail within three sigma gives it: there is nothing to tell a tail from\n");
    } else {
        out.push_str(&table(&rows));
    }
    out
}
