//! One unit's answer held against its truth, and the scores of many beside what is asked.

use super::truth::{Kind, Truth};
use crate::concealed::{Answer, Bound, CONFIDENT, Form, HeldOut, MORE_THAN_NOT, Parameter, ScoreRow};
use crate::statistics::{Measured, median, rate};

#[derive(Debug, Clone)]
pub(super) struct Scored {
    pub(super) kind: Kind,
    /// The verdict is `none` or `recalibrate`.
    pub(super) quiet: bool,
    /// The verdict is `unknown`.
    pub(super) unknown: bool,
    /// A mechanism is named more probable than not.
    pub(super) named: bool,
    /// The first name is true or could do the same.
    pub(super) right: bool,
    /// The set holds every detectable effect.
    pub(super) in_set: bool,
    /// A name with confidence that is neither true nor of something that could do the same.
    pub(super) misnamed: bool,
    pub(super) held: HeldOut,
    /// The same for what was fitted, whether it was accepted or not.
    pub(super) fitted: HeldOut,
    /// Of mechanisms that are true and named.
    pub(super) parameters: Vec<Parameter>,
    /// Of constants, where the answer is right.
    pub(super) constants: Vec<Parameter>,
}

/// `lag` is that of the drawing's thermometer \[s\].
pub(super) fn score(truth: &Truth, answer: &Answer, held: HeldOut, lag: f64) -> Scored {
    let names = |id: &str| !id.starts_with("unknown:");
    let probable = |from: f64| answer.mechanisms.iter().filter(move |m| m.probability >= from && names(&m.id));
    let listed = |id: &str| answer.set.iter().any(|own| own == id);
    let (kind, explained) = (truth.kind(), answer.verdict == "explained");
    let quiet = matches!(answer.verdict.as_str(), "none" | "recalibrate");
    let right = explained && answer.named().next().is_some_and(|id| truth.admits(id));
    let named: Vec<&str> = answer.named().collect();
    let true_ones = truth.mechanisms.iter().filter(|m| named.contains(&m.id.as_str()));
    let parameter = |(name, alone): (&String, &f64)| {
        let fitted = answer.parameters.get(name)?;
        let values = truth.values(name, *alone, lag);
        let nearest = if (fitted.value - values[0]).abs() <= (fitted.value - values[1]).abs() { 0 } else { 1 };
        Some(Parameter { name: name.clone(), truth: values[nearest], value: fitted.value, ci90: fitted.ci90 })
    };
    let is_right = if kind == Kind::Good { quiet } else { right };
    let constant = |c: &crate::concealed::Constant| {
        let truth = truth.constant(&c.name, c.drawing)?;
        Some(Parameter { name: c.name.clone(), truth, value: c.value, ci90: c.ci90 })
    };
    Scored {
        kind,
        quiet,
        unknown: answer.verdict == "unknown",
        named: probable(MORE_THAN_NOT).next().is_some(),
        right,
        in_set: explained && truth.detectable().all(|effect| listed(&effect.id)),
        misnamed: probable(CONFIDENT).any(|m| !truth.admits(&m.id)),
        fitted: answer.holdout.map_or(held, |own| HeldOut { nominal: own.rmse_nominal, model: own.rmse_model, ..held }),
        held,
        parameters: true_ones.flat_map(|m| &m.parameters).filter_map(parameter).collect(),
        constants: if is_right { answer.constants.iter().filter_map(constant).collect() } else { Vec::new() },
    }
}

impl Scored {
    /// Faults, in words.
    pub(super) fn faults(&self) -> Vec<&'static str> {
        let detectable = self.kind == Kind::Detectable;
        [
            (self.kind == Kind::Good && !self.quiet, "falsely detected"),
            (matches!(self.kind, Kind::Detectable | Kind::Outside) && self.quiet, "not detected"),
            (detectable && self.unknown, "called unknown"),
            (detectable && !self.quiet && !self.unknown && !self.right, "wrongly named"),
            (detectable && self.right && !self.in_set, "truth not in the set"),
            (self.kind == Kind::Outside && !self.quiet && !self.unknown, "not called unknown"),
            (self.kind == Kind::Mimicked && !self.quiet && !self.unknown && !self.right, "wrongly named"),
            (self.misnamed, "confident and wrong"),
            (self.held.is_worse(), "held-out prediction made worse"),
            (self.parameters.iter().any(|p| !p.is_covered()), "an interval misses its parameter"),
        ]
        .into_iter()
        .filter_map(|(is, text)| is.then_some(text))
        .collect()
    }
}

/// The scores of `units`.
pub(super) fn summary(units: &[Scored]) -> Vec<ScoreRow> {
    let of = |kind: Kind| -> Vec<&Scored> { units.iter().filter(|u| u.kind == kind).collect() };
    let share = |group: &'static str, quantity, bound, units: &[&Scored], is: &dyn Fn(&Scored) -> bool| {
        let measured = rate(units.iter().filter(|u| is(u)).count(), units.len());
        row(group, quantity, measured, Form::Percent, bound)
    };
    let [good, detectable, outside, mimicked] = [Kind::Good, Kind::Detectable, Kind::Outside, Kind::Mimicked].map(of);
    let all: Vec<&Scored> = units.iter().collect();
    let skills: Vec<f64> = detectable.iter().filter_map(|u| u.held.skill()).collect();
    let covered = |of: fn(&Scored) -> &[Parameter]| {
        let held: Vec<bool> = units.iter().flat_map(of).map(Parameter::is_covered).collect();
        rate(held.iter().filter(|held| **held).count(), held.len())
    };
    let wrong = Bound::AtMost(0.02);
    vec![
        share("good", "`none` or `recalibrate`", Bound::AtLeast(0.97), &good, &|u| u.quiet),
        share("good", "a mechanism at 0.5 or more", Bound::AtMost(0.0), &good, &|u| u.named),
        share("detectable", "detected", Bound::AtLeast(0.9), &detectable, &|u| !u.quiet),
        share("detectable", "first name true or inseparable", Bound::AtLeast(0.85), &detectable, &|u| u.right),
        share("detectable", "set holds the truth", Bound::AtLeast(0.92), &detectable, &|u| u.in_set),
        share("detectable", "confident and wrong", wrong, &detectable, &|u| u.misnamed),
        row("detectable", "held-out skill, median", median(&skills), Form::Number, Bound::AtLeast(0.9)),
        share("out of the library", "`unknown`", Bound::AtLeast(0.8), &outside, &|u| u.unknown),
        share("out of the library", "confident and wrong", wrong, &outside, &|u| u.misnamed),
        share("tolerances can do it", "confident and wrong", Bound::AtMost(0.0), &mimicked, &|u| u.misnamed),
        share("all", "held-out prediction made worse", Bound::AtMost(0.0), &all, &|u| u.held.is_worse()),
        share("all", "made worse by what was fitted, before it was accepted or not", Bound::Open, &all, &|u| u.fitted.is_worse()),
        row(
            "all",
            "90 % intervals that hold the parameter",
            covered(|u| &u.parameters),
            Form::Percent,
            Bound::Within(0.85, 0.95),
        ),
        row("all", "90 % intervals that hold the constant", covered(|u| &u.constants), Form::Percent, Bound::Within(0.85, 0.95)),
    ]
}

fn row(group: &'static str, quantity: &'static str, measured: Option<Measured>, form: Form, bound: Bound) -> ScoreRow {
    ScoreRow { group, quantity, measured, form, bound }
}

#[cfg(test)]
mod tests {
    use super::super::truth::Effect;
    use super::*;
    use crate::concealed::{Fitted, Probable};

    const HELD: HeldOut = HeldOut { nominal: 1.0, model: 0.12, truth: 0.1 };

    fn truth(effects: &[(&str, bool, &[&str])]) -> Truth {
        let of = |&(id, detectable, others): &(&str, bool, &[&str])| Effect {
            id: id.into(),
            detectable,
            inseparable: others.iter().map(|id| (*id).to_owned()).collect(),
            ..Effect::default()
        };
        let mechanism = |&(id, ..): &(&str, bool, &[&str])| crate::truth::ConcealedEffect {
            id: id.into(),
            parameters: [("tail_m".to_owned(), 2.0)].into(),
        };
        Truth {
            effects: effects.iter().map(of).collect(),
            mechanisms: effects.iter().map(mechanism).collect(),
            deviations: [("tail_cw_m".to_owned(), 0.1)].into(),
            ..Truth::default()
        }
    }

    fn answer(verdict: &str, mechanisms: &[(&str, f64)], set: &[&str]) -> Answer {
        Answer {
            verdict: verdict.into(),
            mechanisms: mechanisms.iter().map(|(id, p)| Probable { id: (*id).into(), probability: *p }).collect(),
            set: set.iter().map(|id| (*id).to_owned()).collect(),
            ..Answer::default()
        }
    }

    fn of(truth: &Truth, answer: &Answer) -> Scored {
        score(truth, answer, HELD, 4.0)
    }

    #[test]
    fn a_good_unit_is_left_alone() {
        let good = truth(&[]);
        for verdict in ["none", "recalibrate"] {
            assert_eq!(of(&good, &answer(verdict, &[], &[])).faults(), [""; 0]);
        }
        assert_eq!(of(&good, &answer("unknown", &[], &[])).faults(), ["falsely detected"]);
        let named = of(&good, &answer("explained", &[("debond", 0.9)], &["debond"]));
        assert!(named.named && named.misnamed && !named.quiet);
        assert!(!of(&good, &answer("unknown", &[("unknown:moisture", 0.9)], &[])).misnamed);
    }

    #[test]
    fn a_detectable_effect_is_named_or_its_like() {
        let tail = truth(&[("tail-asymmetry", true, &["winding-defect"])]);
        let right = |name: &str, set: &[&str]| of(&tail, &answer("explained", &[(name, 0.9)], set)).faults();
        assert_eq!(right("tail-asymmetry", &["tail-asymmetry"]), [""; 0]);
        assert_eq!(right("winding-defect", &["tail-asymmetry"]), [""; 0]);
        assert_eq!(right("winding-defect", &["winding-defect"]), ["truth not in the set"]);
        assert_eq!(right("air-path", &["tail-asymmetry"]), ["wrongly named", "confident and wrong"]);
        assert_eq!(of(&tail, &answer("recalibrate", &[], &[])).faults(), ["not detected"]);
        assert_eq!(of(&tail, &answer("unknown", &[], &[])).faults(), ["called unknown"]);
    }

    #[test]
    fn what_tolerances_can_do_is_no_sure_name_of_something_else() {
        let tail = truth(&[("tail-asymmetry", false, &[])]);
        assert_eq!(of(&tail, &answer("recalibrate", &[], &[])).faults(), [""; 0]);
        assert_eq!(of(&tail, &answer("explained", &[("tail-asymmetry", 0.9)], &[])).faults(), [""; 0]);
        assert!(of(&tail, &answer("explained", &[("air-path", 0.9)], &["tail-asymmetry"])).misnamed);
    }

    #[test]
    fn what_is_not_in_the_library_is_called_unknown() {
        let ripple = truth(&[("ool:ripple", true, &[])]);
        assert_eq!(of(&ripple, &answer("unknown", &[("air-path", 0.3)], &[])).faults(), [""; 0]);
        assert_eq!(of(&ripple, &answer("recalibrate", &[], &[])).faults(), ["not detected"]);
        let sure = of(&ripple, &answer("explained", &[("air-path", 0.9)], &["air-path"]));
        assert_eq!(sure.faults(), ["not called unknown", "confident and wrong"]);
    }

    #[test]
    fn an_interval_may_hold_the_effect_alone_or_with_the_deviation() {
        let tail = truth(&[("tail-asymmetry", true, &[])]);
        let with = |value: f64| Answer {
            parameters: [("tail_m".to_owned(), Fitted { value, ci90: [value - 0.02, value + 0.02] })].into(),
            ..answer("explained", &[("tail-asymmetry", 0.9)], &["tail-asymmetry"])
        };
        for (value, held) in [(2.01, true), (2.09, true), (2.05, false)] {
            assert_eq!(of(&tail, &with(value)).parameters[0].is_covered(), held, "{value}");
        }
    }

    #[test]
    fn a_spoilt_unit_fails_its_rows_and_no_others() {
        let failing = |units: &[Scored]| -> Vec<&str> {
            let rows = summary(units);
            rows.iter().filter(|row| row.holds() == Some(false)).map(|row| row.quantity).collect()
        };
        let tail = truth(&[("tail-asymmetry", true, &[])]);
        let perfect = [
            of(&truth(&[]), &answer("none", &[], &[])),
            of(&tail, &answer("explained", &[("tail-asymmetry", 0.9)], &["tail-asymmetry"])),
        ];
        assert_eq!(failing(&perfect), [""; 0]);
        let named = of(&truth(&[]), &answer("explained", &[("debond", 0.6)], &[]));
        assert_eq!(failing(&[named, perfect[1].clone()]), ["`none` or `recalibrate`", "a mechanism at 0.5 or more"]);
        let worse = Scored { held: HeldOut { model: 1.2, ..HELD }, ..perfect[1].clone() };
        assert_eq!(failing(&[worse]), ["held-out skill, median", "held-out prediction made worse"]);
    }
}
