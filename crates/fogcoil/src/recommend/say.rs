//! A recommendation in words, as a table, as JSON.

use std::fmt::Write;

use serde_json::{Value, json};

use super::{Limits, Odds, Ranked, Recommendation, Size, WithSensor};
use crate::table::{capital, significant, table};

/// Most programmes in the table.
const SHOWN: usize = 8;

fn object(odds: &Odds) -> Value {
    json!({"sigma": odds.sigma, "log_odds": odds.log_odds, "decides": odds.decides(), "hardest_pair": odds.pair})
}

/// An object with the fields of another behind its own.
pub(crate) fn with(mut object: Value, more: Value) -> Value {
    if let (Some(object), Value::Object(more)) = (object.as_object_mut(), more) {
        object.extend(more);
    }
    object
}

/// One object; see docs/schema/recommend.schema.json.
pub fn json(r: &Recommendation) -> Value {
    let gain = |odds: &Odds| odds.log_odds - r.repeat.1.log_odds;
    let size = |Size { id, values }: &Size| {
        let parameters: serde_json::Map<String, Value> = values.iter().map(|(name, v)| (name.clone(), json!(v))).collect();
        json!({"id": id, "parameters": parameters})
    };
    let profile = |Ranked { programme: p, odds }: &Ranked| {
        with(object(odds), json!({"family": p.family, "name": p.name, "gain_over_repeat": gain(odds)}))
    };
    let sensor = |WithSensor { sensor, programme, odds }: &WithSensor| {
        with(object(odds), json!({"sensor": sensor, "profile": programme, "gain_over_repeat": gain(odds)}))
    };
    let (name, odds) = &r.repeat;
    let l = &r.limits;
    json!({
        "between": r.between,
        "limits": {"coldest_c": l.coldest, "hottest_c": l.hottest, "fastest_k_per_min": l.fastest, "hours": l.hours},
        "sizes": r.sizes.iter().map(size).collect::<Vec<_>>(),
        "fitted": r.fitted,
        "repeat": with(object(odds), json!({"name": name})),
        "profiles": r.profiles.iter().map(profile).collect::<Vec<_>>(),
        "sensors": r.sensors.iter().map(sensor).collect::<Vec<_>>(),
        "inspections": r.inspections.iter().map(|(id, what)| json!({"id": id, "what": what})).collect::<Vec<_>>(),
        "recommendation": sentence(r),
    })
}

/// ln odds or σ, with the digits that mean something.
pub(crate) fn number(x: f64) -> String {
    if x.abs() >= 9.95 { format!("{x:.0}") } else { format!("{x:.1}") }
}

fn repeat_is_better(r: &Recommendation) -> bool {
    r.repeat.1.log_odds > r.profiles[0].odds.log_odds
}

/// What a file with the best profile must not be taken for; `None` where it holds what is recommended.
pub fn caveat(r: &Recommendation, file: &str) -> Option<String> {
    let Ranked { programme, odds } = &r.profiles[0];
    if repeat_is_better(r) {
        return Some(format!(
            "{file} holds {}, the best of the profiles that were compared (ln odds {}); {}, done again, gives more (ln odds {})",
            programme.name,
            number(odds.log_odds),
            r.repeat.0,
            number(r.repeat.1.log_odds)
        ));
    }
    let all = r.between.join(", ");
    (!odds.decides()).then(|| {
        format!("{file} does not separate {all}: no profile within the limits does; it is the best of the insufficient ones")
    })
}

pub(crate) fn sentence(r: &Recommendation) -> String {
    let best = &r.profiles[0];
    let [truth, rival] = &best.odds.pair;
    let several = r.between.len() > 2;
    let all = if several { format!("{} from one another", r.between.join(", ")) } else { r.between.join(" from ") };
    let hardest = if several { format!(", the hardest pair being {truth} and {rival}") } else { String::new() };
    let (name, odds) = (&best.programme.name, number(best.odds.log_odds));
    let (repeat, repeated) = (&r.repeat.0, number(r.repeat.1.log_odds));
    let repeat_is_better = repeat_is_better(r);
    if r.repeat.1.decides() && (repeat_is_better || !best.odds.decides()) {
        return format!(
            "{repeat} separates {all} best (ln odds {repeated}{hardest}): do it again, as long as {} h. No profile within the limits gives more; \
             the best of them, {name}, gives ln odds {odds}.",
            r.limits.hours
        );
    }
    if best.odds.decides() {
        let beside = if r.repeat.1.decides() { "would do, too" } else { "would not" };
        return format!(
            "{name}: separates {all} in {} h (ln odds {odds}{hardest}); {repeat} {beside} (ln odds {repeated}).",
            r.limits.hours
        );
    }
    let mut out = format!(
        "No profile within the limits separates {all}: the best of the insufficient ones, {name}, gives ln odds {odds}{hardest}. "
    );
    if repeat_is_better {
        let _ = write!(out, "{}, done again, gives more, but not enough (ln odds {repeated}). ", capital(repeat));
    }
    let sensor = r.sensors.iter().filter(|s| s.odds.decides()).max_by(|a, b| a.odds.log_odds.total_cmp(&b.odds.log_odds));
    match sensor {
        Some(s) => {
            let _ = write!(out, "Add {}: with {} it gives ln odds {}.", s.sensor, s.programme, number(s.odds.log_odds));
        }
        None => {
            let checks: Vec<String> = r.inspections.iter().map(|(id, what)| format!("for {id}, {what}")).collect();
            let _ = write!(out, "Neither does a finer thermometer on the spool. Look at the unit itself: {}.", checks.join("; "));
        }
    }
    out
}

/// The recommendation as text.
pub fn text(r: &Recommendation) -> String {
    let said = sentence(r);
    let mut out = capital(&said) + "\n\n";
    let (Limits { coldest, hottest, fastest, hours }, sizes) =
        (r.limits, if r.fitted { "fitted to the record" } else { "typical" });
    let _ = writeln!(
        out,
        "chamber {coldest} to {hottest} degC, at most {fastest} K/min, {hours} h; expected ln odds for the truth, of the worst pair, at these \
         sizes ({sizes}):"
    );
    for Size { id, values } in &r.sizes {
        let values: Vec<String> = values.iter().map(|(name, v)| format!("{name} = {}", significant(*v, 3))).collect();
        let _ = writeln!(out, "  {id}: {}", values.join(", "));
    }
    let row = |name: &str, odds: &Odds| {
        let gain = odds.log_odds - r.repeat.1.log_odds;
        let gain = format!("{}{}", if gain >= 0.05 { "+" } else { "" }, number(gain));
        [name.to_owned(), number(odds.sigma), number(odds.log_odds), gain, odds.pair.join(" / ")]
    };
    let mut rows = vec![["profile", "sigma", "ln odds", "gain", "truth / taken for it"].map(str::to_owned)];
    rows.extend(r.profiles.iter().take(SHOWN).map(|p| row(&p.programme.name, &p.odds)));
    let (compared, gain) = if r.fitted {
        ("again", "over the recorded test done again")
    } else {
        ("for comparison", "over the slow ramp, which a test usually is")
    };
    rows.push(row(&format!("{compared}: {}", r.repeat.0), &r.repeat.1));
    rows.extend(r.sensors.iter().map(|s| row(&format!("{} with {}", s.programme, s.sensor), &s.odds)));
    out.push('\n');
    out.push_str(&table(&rows));
    let _ = writeln!(
        out,
        "(sigma: what the profile shows of the difference, in standard deviations of the noise; ln odds: expected, of the truth over what may \
         be taken for it, of the pair that is hardest to tell apart; gain: in ln odds, {gain})"
    );
    out
}
