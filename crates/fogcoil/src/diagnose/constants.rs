//! What the records say of the design's constants and of the instruments, beside what was known.

use diagnosis::{Place, Posterior, Role};
use serde_json::{Value, json};

use super::Outcome;

/// Standard deviations from the drawing from which a constant is worth a line.
const MOVED: f64 = 1.0;

/// A number of design or instrument as the records leave it.
pub(super) struct Constant {
    pub(super) posterior: Posterior,
    kind: &'static str,
}

impl Constant {
    /// Standard deviations of what was known from its middle.
    pub(super) fn moved(&self) -> f64 {
        self.posterior.u
    }
}

impl Outcome {
    /// Every constant of the design and number of an instrument that was free in the best hypothesis, as it is left.
    pub(super) fn constants(&self) -> Vec<Constant> {
        let of = |posterior: Posterior| {
            let kind = match posterior.place {
                Place::Nominal(Role::Constant) => "design",
                Place::Nominal(Role::Sensor) => "instrument",
                Place::Nominal(Role::ModelError) | Place::Mechanism(_) => return None,
            };
            Some(Constant { posterior, kind })
        };
        self.diagnosis.best().fit.posteriors(&self.gyro).into_iter().filter_map(of).collect()
    }

    /// Those that moved, the farthest first.
    pub(super) fn moved(&self) -> Vec<Constant> {
        let mut moved: Vec<Constant> = self.constants().into_iter().filter(|c| c.moved().abs() >= MOVED).collect();
        moved.sort_by(|a, b| b.moved().abs().total_cmp(&a.moved().abs()));
        moved
    }

    /// All of them as scripts read them.
    pub(super) fn constants_json(&self) -> Value {
        let of = |c: &Constant| {
            let p = &c.posterior;
            json!({
                "name": p.name, "kind": c.kind, "value": p.value(), "ci90": p.ci90(),
                "drawing": p.prior.value(0.0), "tolerance": p.prior.sd(), "moved_sigma": c.moved(),
            })
        };
        Value::Array(self.constants().iter().map(of).collect())
    }
}
