//! Constants of the design and the instruments by the records, beside their prior values.

use diagnosis::{Active, Fit, Hypothesis, Place, Posterior, Role, Verdict};
use files::{Note, Remark};
use mechanisms::reading_of;
use serde_json::{Value, json};

use super::Outcome;
use crate::keys::interval_by_key;
use crate::table::significant;

/// Name of the delay of the rate, as the model has it.
const RATE_DELAY: &str = "delay of the rate's readings [s]";

/// Standard deviations from the drawing from which a constant is worth a line.
pub(super) const MOVED: f64 = 1.0;

/// The same from which an instrument is not believed, and a constant that stands for a mechanism is worth a line.
pub(super) const FAR: f64 = 3.0;

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

    /// Whether it is a number of the design, not of an instrument.
    pub(super) fn is_of_design(&self) -> bool {
        self.kind == "design"
    }

    /// Whether it is an instrument's number of which little was known, and the records tell that it is not the usual one.
    fn is_told(&self) -> bool {
        let Posterior { u, sd, .. } = self.posterior;
        self.kind == "instrument" && u.abs() > WORTH && u.abs() > FAR * sd
    }
}

impl Outcome<'_> {
    /// Every constant of the design and number of an instrument that was free in the best hypothesis, as it is left. Where that is the design as drawn, the
    /// instruments' numbers are those beside constants within their tolerances: beside the drawing's own they would explain what such constants do.
    pub(super) fn constants(&self) -> Vec<Constant> {
        let of = |posterior: Posterior| {
            let kind = match posterior.place {
                Place::Nominal(Role::Constant) => "design",
                Place::Nominal(Role::Sensor) => "instrument",
                Place::Nominal(Role::ModelError) | Place::Mechanism(_) => return None,
            };
            Some(Constant { posterior, kind })
        };
        let is_design = |fit: &Fit| fit.hypothesis.mechanisms.is_empty() && !fit.hypothesis.constants_free;
        let recalibrated = self.diagnosis.candidates.iter().find(|candidate| {
            let Hypothesis { mechanisms, constants_free } = &candidate.fit.hypothesis;
            mechanisms.is_empty() && *constants_free && candidate.rival.is_none()
        });
        let beside = recalibrated.filter(|_| self.law().is_none() && is_design(self.leading()));
        let all = beside.map_or(self.leading(), |candidate| &candidate.fit).posteriors(&self.gyro).into_iter().filter_map(of);
        all.filter(|constant| beside.is_none() || constant.kind == "instrument").collect()
    }

    /// The constants that moved, and the instruments that the records tell to be off, the farthest first.
    pub(super) fn moved(&self) -> Vec<Constant> {
        let told = |c: &Constant| c.moved().abs() >= MOVED || c.is_told();
        let mut moved: Vec<Constant> = self.constants().into_iter().filter(told).collect();
        moved.sort_by(|a, b| b.moved().abs().total_cmp(&a.moved().abs()));
        moved
    }

    /// A sentence on rates that the records show to be read late or early.
    pub(super) fn late(&self) -> Option<String> {
        let delay = self.constants().into_iter().find(|c| c.posterior.name == RATE_DELAY)?;
        let sure = delay.posterior.u.abs() > FAR * delay.posterior.sd && delay.moved().abs() > WORTH;
        sure.then(|| delayed(ends(&delay.posterior), self.doubted().as_deref()))
    }

    /// Whether the instruments' numbers may only make up for what is unexplained: the verdict is unknown, or something without a name takes part more probably than
    /// not. A law that was composed predicts, and its form is no cause.
    pub(super) fn is_incomplete(&self) -> bool {
        let [.., unknown] = self.diagnosis.verdicts();
        self.diagnosis.verdict == Verdict::Unknown || unknown > 0.5
    }

    /// What else the instruments' numbers may make up for, if not only the instruments.
    fn doubted(&self) -> Option<String> {
        let unexplained = "as far as an incomplete model tells; it may only make up for what is unexplained";
        let imitated = || self.imitated().map(|other| format!("but {other}, may look the same"));
        if self.is_incomplete() { Some(unexplained.to_owned()) } else { imitated() }
    }

    /// What a path of heat of the answer may imitate: the records may be of that one, and constants and instruments make up for the difference.
    pub(super) fn imitated(&self) -> Option<String> {
        let of = |active: &Active| {
            let imitates = self.gyro.mechanism(active.mechanism).facts().heat_path?.imitates?;
            Some(imitates(self.gyro.library().design(), *active.values.first()?))
        };
        self.leading().active.iter().find_map(of)
    }

    /// A warning for each instrument that the answer takes to be far off.
    pub(super) fn far_off(&self) -> Vec<Note> {
        let doubted = self.doubted();
        let far = |c: &&Constant| c.kind == "instrument" && c.moved().abs() > FAR;
        let said = |c: &Constant| {
            let [value, low, high] = ends(&c.posterior).map(|value| significant(value, 4));
            let sigmas = significant(c.moved().abs(), 2);
            let off = format!(
                "the answer takes the {} to be {value} (90 % interval {low} to {high}), {sigmas} standard deviations off what is known of it",
                c.posterior.name
            );
            Remark::InstrumentOff.warning(format!("{off}: {}", advised("check the instrument", doubted.as_deref())))
        };
        self.moved().iter().filter(far).map(said).collect()
    }

    /// Whether something moved, and none of it is of the design.
    pub(super) fn drawing_stands(&self) -> bool {
        let moved: Vec<Constant> = self.moved().into_iter().filter(|c| c.moved().abs() >= MOVED).collect();
        !moved.is_empty() && moved.iter().all(|c| !c.is_of_design())
    }

    /// All constants as JSON, in the words of the terminal.
    pub(super) fn unknowns_json(&self) -> Value {
        let of = |c: &Constant| {
            let p = &c.posterior;
            json!({
                "name": p.name, "kind": c.kind, "value": p.value(), "ci90": p.ci90(),
                "drawing": p.prior.value(0.0), "tolerance": p.prior.sd(), "sigmas": c.moved(),
            })
        };
        Value::Array(self.constants().iter().map(of).collect())
    }

    /// The constants of the drawing that moved by more than [`WORTH`], by their keys and in the units of these, the farthest first.
    pub(super) fn constants_json(&self) -> Value {
        let all = self.constants();
        let told = all.iter().map(|c| (c.posterior.name.as_str(), c.posterior.value()));
        worth(&all, "design", |p| interval_by_key(self.gyro.library().design(), told.clone(), &p.name, ends(p)))
    }

    /// Numbers of the instruments likewise, each with whether it is qualified: it may only make up for what is unexplained or imitated.
    pub(super) fn sensors_json(&self) -> Value {
        let mut sensors = worth(&self.constants(), "instrument", |p| {
            let [value, low, high] = ends(p);
            Some((reading_of(&p.name)?, value, [low, high]))
        });
        for sensor in sensors.as_array_mut().into_iter().flatten() {
            sensor["qualified"] = self.doubted().is_some().into();
        }
        sensors
    }
}

/// What is to be done about an instrument by an answer, unless it is as `doubted`.
fn advised(advice: &str, doubted: Option<&str>) -> String {
    doubted.map_or_else(|| advice.to_owned(), |doubt| format!("{doubt}. Else {advice}"))
}

/// The sentence on a delay of the rate, with the ends of its interval \[s\].
fn delayed([value, low, high]: [f64; 3], doubted: Option<&str>) -> String {
    let (how, [low, high]) = if value > 0.0 { ("late", [low, high]) } else { ("early", [-high, -low]) };
    let [value, low, high] = [value.abs(), low, high].map(|seconds| significant(seconds, 2));
    let advice = advised("compare how the loggers stamp their rows", doubted);
    format!("The rate is read {value} s {how} (90 %: {low} to {high}), beside the temperatures: {advice}.")
}

fn ends(posterior: &Posterior) -> [f64; 3] {
    let [low, high] = posterior.ci90();
    [posterior.value(), low, high]
}

/// Standard deviations from which scripts are told of a constant.
const WORTH: f64 = 0.5;

/// Constants of a kind that moved, as key, value and interval.
fn worth(all: &[Constant], kind: &str, of: impl Fn(&Posterior) -> Option<(&'static str, f64, [f64; 2])>) -> Value {
    let mut moved: Vec<&Constant> = all.iter().filter(|c| c.kind == kind && c.moved().abs() > WORTH).collect();
    moved.sort_by(|a, b| b.moved().abs().total_cmp(&a.moved().abs()));
    let told = |c: &Constant| {
        let (key, value, ci90) = of(&c.posterior)?;
        Some(json!({"key": key, "value": value, "ci90": ci90, "sigmas": c.moved()}))
    };
    moved.into_iter().filter_map(told).collect()
}

#[cfg(test)]
mod tests {
    use diagnosis::Prior;

    use super::*;

    #[test]
    fn what_a_doubted_model_tells_of_an_instrument_is_qualified() {
        let doubt = "but air that moves may look the same";
        let [plain, doubted] = [None, Some(doubt)].map(|doubted| delayed([37.0, 23.0, 51.0], doubted));
        let said = "The rate is read 37 s late (90 %: 23 to 51), beside the temperatures: ";
        assert_eq!(plain, said.to_owned() + "compare how the loggers stamp their rows.");
        assert_eq!(doubted, format!("{said}{doubt}. Else compare how the loggers stamp their rows."));
        assert!(delayed([-2.0, -3.0, -1.0], None).starts_with("The rate is read 2.0 s early (90 %: 1.0 to 3.0)"));
    }

    /// A delay of 14 s of which ±16 s was known is worth a word if the records tell it to a second, and none if they say as little as before.
    #[test]
    fn what_records_tell_of_an_instrument_is_told() {
        let told = |kind: &'static str, u: f64, sd: f64| {
            let (name, place) = ("delay".to_owned(), Place::Nominal(Role::Sensor));
            let posterior = Posterior { name, place, record: None, prior: Prior::Normal { mean: 0.0, sd: 15.8 }, u, sd };
            Constant { posterior, kind }.is_told()
        };
        assert!(told("instrument", 0.9, 0.06) && told("instrument", -0.9, 0.06));
        assert!(!told("instrument", 0.9, 0.5) && !told("instrument", 0.1, 0.01) && !told("design", 0.9, 0.06));
    }
}
