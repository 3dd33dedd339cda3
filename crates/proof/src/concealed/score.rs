//! One unit's answer held against its truth.

use super::answer::{Answer, MORE_THAN_NOT};
use crate::truth::{Kind, Tier, Truth, stage};

/// Probability from which a name is given with confidence.
pub(crate) const CONFIDENT: f64 = 0.8;
/// R_nominal/R_true from which a skill is computed.
const IMPROVABLE: f64 = 1.1;
/// Part of R_nominal by which a prediction may exceed it before it counts as worse: what offsets estimated otherwise change.
const WORSE: f64 = 0.01;

/// Root mean squares of recorded less predicted rate in the record held out \[deg/h\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HeldOut {
    /// Nominal design, offset from the record that is fitted.
    pub(crate) nominal: f64,
    pub(crate) model: f64,
    pub(crate) truth: f64,
}

impl HeldOut {
    /// 0 for the nominal design, 1 for the true model; `None` where the true one is hardly better.
    pub(crate) fn skill(&self) -> Option<f64> {
        let improvable = self.nominal > IMPROVABLE * self.truth;
        improvable.then(|| (self.nominal - self.model) / (self.nominal - self.truth))
    }

    pub(crate) fn is_worse(&self) -> bool {
        self.model > (1.0 + WORSE) * self.nominal
    }
}

/// A parameter of a mechanism that was rightly named.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parameter {
    pub(crate) name: String,
    pub(crate) truth: f64,
    pub(crate) value: f64,
    pub(crate) ci90: [f64; 2],
}

impl Parameter {
    pub(crate) fn is_covered(&self) -> bool {
        self.ci90[0] <= self.truth && self.truth <= self.ci90[1]
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scored {
    pub(crate) unit: String,
    pub(crate) kind: Kind,
    pub(crate) tier: Tier,
    /// The verdict is not `none`.
    pub(crate) detected: bool,
    /// The first name is true or inseparable from the truth, of two mechanisms any name; out of the library: the verdict is `unknown`;
    /// nothing concealed: `none`.
    pub(crate) right: bool,
    /// Two names for two mechanisms, each true or inseparable, or all that is inseparable from each together more probable than not.
    pub(crate) both: bool,
    /// The set holds everything that is true.
    pub(crate) in_set: bool,
    /// Something is named with confidence that is neither true nor inseparable from it.
    pub(crate) misnamed: bool,
    /// Members of the set that are separable from the truth; `None` where nothing is named.
    pub(crate) excess: Option<usize>,
    /// The stage is that of something true or inseparable; `None` where nothing is named.
    pub(crate) stage: Option<bool>,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) held: Option<HeldOut>,
    /// The same for what was fitted, whether it was accepted or not.
    pub(crate) fitted: Option<HeldOut>,
}

pub(crate) fn score(unit: &str, truth: &Truth, answer: &Answer, held: Option<HeldOut>) -> Scored {
    let kind = truth.kind();
    let verdict = answer.verdict.as_str();
    let right = match kind {
        Kind::Null => verdict == "none",
        Kind::Outside => verdict == "unknown",
        Kind::Single if verdict == "recalibrate" => truth.is_gain(),
        Kind::Single => answer.named().next().is_some_and(|id| truth.admits(id)),
        Kind::Double => answer.named().any(|id| truth.admits(id)),
    };
    let named: Vec<&str> = answer.named().collect();
    let pairs = || named.iter().flat_map(|a| named.iter().map(move |b| (a, b))).filter(|(a, b)| a != b);
    // the names may share a probability among what is inseparable from one truth, and from that one alone
    let likely = |of: usize| answer.probability(|id| truth.is_like(of, id) && !truth.is_like(1 - of, id)) >= MORE_THAN_NOT;
    let both = kind == Kind::Double
        && (pairs().any(|(a, b)| truth.is_like(0, a) && truth.is_like(1, b)) || (!named.is_empty() && likely(0) && likely(1)));
    let mut listed = truth.concealed();
    let in_set = kind != Kind::Null && listed.all(|m| answer.set.contains(&m.id));
    // an id that says of itself that it is unknown names nothing
    let names = |id: &str| !id.starts_with("unknown:");
    let misnamed = answer.mechanisms.iter().any(|m| m.probability >= CONFIDENT && names(&m.id) && !truth.admits(&m.id));
    let library = matches!(kind, Kind::Single | Kind::Double) && !named.is_empty();
    let excess = library.then(|| answer.set.iter().filter(|id| !truth.admits(id)).count());
    let place = answer.located.stage.as_deref();
    let admitted = || truth.concealed().map(|m| m.id.as_str()).chain(truth.confusable_sets.iter().flatten().map(String::as_str));
    let stage = library.then(|| place.is_some() && admitted().any(|id| stage(id) == place));
    Scored {
        unit: unit.to_owned(),
        kind,
        tier: truth.tier(),
        detected: verdict != "none",
        right,
        both,
        in_set,
        misnamed,
        excess,
        stage,
        parameters: parameters(truth, answer),
        held,
        fitted: held.zip(answer.holdout).map(|(held, answer)| HeldOut { model: answer.rmse_model, ..held }),
    }
}

/// Parameters of mechanisms that are true and named.
fn parameters(truth: &Truth, answer: &Answer) -> Vec<Parameter> {
    let named = |id: &str| answer.named().any(|other| other == id);
    let true_ones = truth.concealed().filter(|m| named(&m.id)).flat_map(|m| &m.parameters);
    let found = |(name, truth): (&String, &f64)| {
        let fitted = answer.parameters.get(name)?;
        Some(Parameter { name: name.clone(), truth: *truth, value: fitted.value, ci90: fitted.ci90 })
    };
    true_ones.filter_map(found).collect()
}

#[cfg(test)]
mod tests {
    use super::super::answer::{Fitted, Place, Probable};
    use super::*;
    use crate::truth::{ConcealedEffect, Sizes, Strength};

    const TAIL: &str = "tail-asymmetry";
    const DEFECT: &str = "winding-defect";
    const AIR: &str = "air-path";

    /// Mechanisms with their sets; the first has a parameter `p` of 2.
    fn truth(sets: &[&[&str]]) -> Truth {
        let parameters = |k: usize| if k == 0 { [("p".to_owned(), 2.0)].into() } else { Default::default() };
        let mechanism = |(k, set): (usize, &&[&str])| ConcealedEffect { id: set[0].into(), parameters: parameters(k) };
        Truth {
            mechanisms: sets.iter().enumerate().map(mechanism).collect(),
            snr: sets.iter().map(|s| Strength { id: s[0].into(), snr: 20.0, ..Strength::default() }).collect(),
            confusable_sets: sets.iter().map(|s| s.iter().map(|id| (*id).to_owned()).collect()).collect(),
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
        score("unit", truth, answer, None)
    }

    #[test]
    fn detection_is_any_verdict_but_none() {
        let truth = truth(&[&[TAIL]]);
        for (verdict, detected) in [("none", false), ("recalibrate", true), ("unknown", true), ("explained", true)] {
            assert_eq!(of(&truth, &answer(verdict, &[], &[])).detected, detected, "{verdict}");
        }
    }

    #[test]
    fn the_first_name_is_right_if_true_or_inseparable() {
        let truth = truth(&[&[TAIL, DEFECT]]);
        let right = |verdict: &str, mechanisms: &[(&str, f64)]| of(&truth, &answer(verdict, mechanisms, &[])).right;
        assert!(right("explained", &[(TAIL, 0.6), (AIR, 0.4)]));
        assert!(right("explained", &[(DEFECT, 0.6), (AIR, 0.4)]));
        // the second name does not help, nor does a name under another verdict
        assert!(!right("explained", &[(AIR, 0.6), (TAIL, 0.5)]));
        assert!(!right("unknown", &[(TAIL, 0.6)]));
        assert!(!right("none", &[(TAIL, 0.4)]));
    }

    #[test]
    fn recalibration_is_right_for_a_gain_only() {
        let sized = |fit_true: f64| Truth {
            snr: vec![Strength { id: TAIL.into(), snr: 20.0, snr_noise_only_rate: 100.0, snr_noise_only_spool: 0.0 }],
            noise_free_rms_deg_per_h: Sizes { fit_nominal: 1.0, fit_true, fit_difference: 0.1, holdout_difference: 0.1 },
            ..truth(&[&[TAIL]])
        };
        let recalibrate = answer("recalibrate", &[], &[]);
        assert!(of(&sized(1.1), &recalibrate).right);
        assert!(!of(&sized(1.0), &recalibrate).right);
        assert!(!of(&truth(&[&["none"]]), &recalibrate).right);
    }

    #[test]
    fn the_set_holds_every_truth_or_fails() {
        let (single, double) = (truth(&[&[TAIL, DEFECT]]), truth(&[&[TAIL], &[AIR]]));
        let held = |truth: &Truth, set: &[&str]| of(truth, &answer("explained", &[(TAIL, 0.9)], set)).in_set;
        assert!(held(&single, &[DEFECT, TAIL]));
        assert!(!held(&single, &[DEFECT]));
        assert!(held(&double, &[AIR, TAIL]));
        assert!(!held(&double, &[TAIL]));
    }

    #[test]
    fn a_confident_name_is_wrong_if_separable_from_the_truth() {
        let wrong =
            |sets: &[&[&str]], mechanisms: &[(&str, f64)]| of(&truth(sets), &answer("explained", mechanisms, &[])).misnamed;
        assert!(wrong(&[&[TAIL, DEFECT]], &[(AIR, 0.85)]));
        assert!(wrong(&[&[TAIL, DEFECT]], &[(TAIL, 0.99), (AIR, 0.85)]));
        assert!(wrong(&[&["none"]], &[(AIR, 0.85)]));
        assert!(wrong(&[&["unknown:ripple"]], &[(AIR, 0.85)]));
        assert!(!wrong(&[&[TAIL, DEFECT]], &[(AIR, 0.75)]));
        assert!(!wrong(&[&[TAIL, DEFECT]], &[(DEFECT, 0.99)]));
        assert!(!wrong(&[&[TAIL], &[AIR]], &[(TAIL, 0.99), (AIR, 0.85)]));
    }

    #[test]
    fn what_is_not_in_the_library_is_called_unknown() {
        let truth = truth(&[&["unknown:ripple"]]);
        assert!(of(&truth, &answer("unknown", &[(AIR, 0.2)], &[])).right);
        assert!(!of(&truth, &answer("explained", &[(AIR, 0.6)], &[AIR])).right);
        assert!(!of(&truth, &answer("none", &[], &[])).right);
    }

    #[test]
    fn nothing_concealed_is_nothing_found() {
        let truth = truth(&[&["none"]]);
        let quiet = of(&truth, &answer("none", &[], &[]));
        assert!(quiet.kind == Kind::Null && quiet.right && !quiet.detected);
        let raised = of(&truth, &answer("recalibrate", &[], &[]));
        assert!(!raised.right && raised.detected);
    }

    #[test]
    fn two_mechanisms_need_two_names() {
        let truth = truth(&[&[TAIL, DEFECT], &[AIR, DEFECT]]);
        let both = |mechanisms: &[(&str, f64)]| of(&truth, &answer("explained", mechanisms, &[])).both;
        assert!(both(&[(AIR, 0.9), (TAIL, 0.6)]));
        assert!(both(&[(DEFECT, 0.9), (AIR, 0.6)]));
        // one that stands for either is one all the same; a name below one half is not said
        assert!(!both(&[(DEFECT, 0.9)]));
        assert!(!both(&[(AIR, 0.9), (TAIL, 0.4)]));
        // what is inseparable from one shares its probability; what is so from both counts for neither
        let three = |mechanisms: &[(&str, f64)], verdict: &str| {
            of(&self::truth(&[&[TAIL, "debond", DEFECT], &[AIR, DEFECT]]), &answer(verdict, mechanisms, &[])).both
        };
        assert!(three(&[(AIR, 0.9), (TAIL, 0.4), ("debond", 0.3)], "explained"));
        assert!(!three(&[(AIR, 0.9), (TAIL, 0.4), ("debond", 0.3)], "unknown"));
        assert!(!three(&[(AIR, 0.9), (TAIL, 0.4), (DEFECT, 0.3)], "explained"));
        let one = of(&truth, &answer("explained", &[("debond", 0.9), (TAIL, 0.6)], &[]));
        assert!(one.right && !one.both);
        assert!(!of(&truth, &answer("explained", &[("debond", 0.9), (TAIL, 0.4)], &[])).right);
    }

    #[test]
    fn skill_is_zero_for_the_nominal_model_and_one_for_the_true() {
        let held = |model: f64| HeldOut { nominal: 0.5, model, truth: 0.1 };
        assert_eq!(held(0.5).skill(), Some(0.0));
        assert_eq!(held(0.1).skill(), Some(1.0));
        assert!(held(0.6).skill().unwrap() < 0.0);
        assert_eq!(HeldOut { nominal: 0.109, model: 0.1, truth: 0.1 }.skill(), None);
        assert!(held(0.51).is_worse() && !held(0.504).is_worse() && !held(0.2).is_worse());
    }

    #[test]
    fn members_that_are_separable_are_too_many() {
        let excess = |set: &[&str]| of(&truth(&[&[TAIL, DEFECT]]), &answer("explained", &[(TAIL, 0.9)], set)).excess;
        assert_eq!(excess(&[TAIL, DEFECT]), Some(0));
        assert_eq!(excess(&[TAIL, DEFECT, AIR, "debond"]), Some(2));
        assert_eq!(of(&truth(&[&[TAIL]]), &answer("none", &[], &[])).excess, None);
    }

    #[test]
    fn the_stage_is_that_of_the_truth_or_of_what_is_inseparable() {
        let of = |stage: Option<&str>| {
            let place = Place { stage: stage.map(str::to_owned) };
            let answer = Answer { located: place, ..answer("explained", &[(TAIL, 0.9)], &[]) };
            of(&truth(&[&[TAIL, "adhesive-content"]]), &answer).stage
        };
        assert_eq!([of(Some("winding")), of(Some("material"))], [Some(true); 2]);
        assert_eq!([of(Some("thermal")), of(None)], [Some(false); 2]);
    }

    #[test]
    fn intervals_of_rightly_named_mechanisms_count() {
        let fitted = |low: f64, high: f64| [("p".to_owned(), Fitted { value: 1.9, ci90: [low, high] })].into();
        let with = |id: &str, low: f64, high: f64| {
            let answer = Answer { parameters: fitted(low, high), ..answer("explained", &[(id, 0.9)], &[]) };
            of(&truth(&[&[TAIL, DEFECT]]), &answer).parameters
        };
        assert!(with(TAIL, 1.8, 2.0)[0].is_covered());
        assert!(!with(TAIL, 1.8, 1.99)[0].is_covered());
        assert!(with(DEFECT, 1.8, 2.0).is_empty());
    }
}
