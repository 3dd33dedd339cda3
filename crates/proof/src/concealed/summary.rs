//! The scores of many units, beside what is asked of them.

use super::score::{HeldOut, Scored};
use crate::statistics::{Measured, mean, median, rate};
use crate::truth::{Kind, Tier};

/// Requirement on a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Bound {
    AtLeast(f64),
    AtMost(f64),
    Above(f64),
    /// Of a share: a measured one outside fails when its interval is outside, too.
    Within(f64, f64),
    /// Nothing: shown only.
    Open,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    Percent,
    Number,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ScoreRow {
    pub(crate) group: &'static str,
    pub(crate) quantity: &'static str,
    /// `None` where there is no unit to measure it on.
    pub(crate) measured: Option<Measured>,
    pub(crate) form: Form,
    pub(crate) bound: Bound,
}

impl ScoreRow {
    /// Whether the measured value is as asked; `None` if there is nothing to judge.
    pub(crate) fn holds(&self) -> Option<bool> {
        let Measured { value, interval, .. } = self.measured?;
        Some(match self.bound {
            Bound::AtLeast(bound) => value >= bound,
            Bound::AtMost(bound) => value <= bound,
            Bound::Above(bound) => value > bound,
            Bound::Within(low, high) => (low..=high).contains(&value) || interval[0] <= high && interval[1] >= low,
            Bound::Open => return None,
        })
    }
}

pub(crate) fn failures(rows: &[ScoreRow]) -> impl Iterator<Item = &ScoreRow> {
    rows.iter().filter(|row| row.holds() == Some(false))
}

/// Asked of a tier: detected, rightly named, in the set, misnamed, median skill.
fn asked(tier: Tier) -> [Bound; 5] {
    let misnamed = Bound::AtMost(0.02);
    match tier {
        Tier::Faint => [Bound::Open; 5],
        Tier::Weak => [Bound::AtLeast(0.75), Bound::AtLeast(0.75), Bound::AtLeast(0.85), misnamed, Bound::Above(0.0)],
        Tier::Medium => [Bound::AtLeast(0.95), Bound::AtLeast(0.90), Bound::AtLeast(0.95), misnamed, Bound::AtLeast(0.8)],
        Tier::Strong => [Bound::AtLeast(1.0), Bound::AtLeast(0.95), Bound::AtLeast(0.95), misnamed, Bound::AtLeast(0.95)],
    }
}

/// The scores of `units`; tiers are of those with one mechanism of the library.
pub(crate) fn summary(units: &[Scored]) -> Vec<ScoreRow> {
    let mut rows = Vec::new();
    for tier in Tier::ASKED {
        let of = Group { name: tier.name(), units: pick(units, |u| u.kind == Kind::Single && u.tier == tier) };
        let [detected, right, in_set, misnamed, skill] = asked(tier);
        rows.push(of.share("detected", detected, |u| u.detected));
        rows.push(of.share("first name true or inseparable", right, |u| u.right));
        rows.push(of.share("set holds the truth", in_set, |u| u.in_set));
        rows.push(of.share("confident and wrong", misnamed, |u| u.misnamed));
        rows.push(of.skill("held-out skill, median", skill, |u| u.held));
        rows.push(of.skill("the same before acceptance", Bound::Open, |u| u.fitted));
    }
    let of = Group { name: "two mechanisms", units: pick(units, |u| u.kind == Kind::Double) };
    rows.push(of.share("at least one named", Bound::AtLeast(1.0), |u| u.right));
    rows.push(of.share("both named", Bound::AtLeast(0.6), |u| u.both));
    rows.push(of.share("confident and wrong", Bound::AtMost(0.02), |u| u.misnamed));
    rows.push(of.skill("held-out skill, median", Bound::Open, |u| u.held));
    let of = Group { name: "nothing concealed", units: pick(units, |u| u.kind == Kind::Null) };
    rows.push(of.share("falsely detected", Bound::AtMost(0.01), |u| u.detected));
    rows.extend(of.both_worse().into_iter().skip(1));
    let of = Group { name: "out of the library", units: pick(units, |u| u.kind == Kind::Outside) };
    rows.push(of.share("verdict `unknown`", Bound::AtLeast(0.8), |u| u.right));
    rows.push(of.share("confident and wrong", Bound::AtMost(0.02), |u| u.misnamed));
    rows.extend(of.both_worse());
    let of = Group { name: "in the library", units: pick(units, |u| matches!(u.kind, Kind::Single | Kind::Double)) };
    rows.extend(of.both_worse());
    rows.push(of.share_of_some("stage right, of those named", Bound::AtLeast(0.9), |u| u.stage));
    let excess: Vec<f64> = of.units.iter().filter_map(|u| u.excess).map(|n| n as f64).collect();
    rows.push(of.row("members of the set that are separable", mean(&excess), Form::Number, Bound::AtMost(0.5)));
    let intervals: Vec<bool> = of.units.iter().flat_map(|u| &u.parameters).map(|p| p.is_covered()).collect();
    let covered = rate(intervals.iter().filter(|c| **c).count(), intervals.len());
    rows.push(of.row("90 % intervals that hold the parameter", covered, Form::Percent, Bound::Within(0.85, 0.95)));
    rows
}

fn pick(units: &[Scored], test: impl Fn(&Scored) -> bool) -> Vec<&Scored> {
    units.iter().filter(|u| test(u)).collect()
}

struct Group<'a> {
    name: &'static str,
    units: Vec<&'a Scored>,
}

impl Group<'_> {
    fn row(&self, quantity: &'static str, measured: Option<Measured>, form: Form, bound: Bound) -> ScoreRow {
        ScoreRow { group: self.name, quantity, measured, form, bound }
    }

    /// Share of the units for which something is known.
    fn share_of_some(&self, quantity: &'static str, bound: Bound, is: impl Fn(&Scored) -> Option<bool>) -> ScoreRow {
        let known: Vec<bool> = self.units.iter().filter_map(|u| is(u)).collect();
        let measured = rate(known.iter().filter(|k| **k).count(), known.len());
        self.row(quantity, measured, Form::Percent, bound)
    }

    fn share(&self, quantity: &'static str, bound: Bound, is: impl Fn(&Scored) -> bool) -> ScoreRow {
        self.share_of_some(quantity, bound, |u| Some(is(u)))
    }

    /// Share of units made worse: by the accepted answer, then by the fit, whether it was accepted or not.
    fn both_worse(&self) -> [ScoreRow; 2] {
        let worse = |held: Option<HeldOut>| held.map(|held| held.is_worse());
        let fitted = "made worse by what was fitted, before it was accepted or not";
        [
            self.share_of_some("held-out prediction made worse", Bound::AtMost(0.0), |u| worse(u.held)),
            self.share_of_some(fitted, Bound::Open, |u| worse(u.fitted)),
        ]
    }

    fn skill(&self, quantity: &'static str, bound: Bound, of: fn(&Scored) -> Option<HeldOut>) -> ScoreRow {
        let skills: Vec<f64> = self.units.iter().filter_map(|u| of(u)?.skill()).collect();
        self.row(quantity, median(&skills), Form::Number, bound)
    }
}

#[cfg(test)]
mod tests {
    use super::super::score::Parameter;
    use super::*;

    fn unit(kind: Kind, tier: Tier) -> Scored {
        Scored {
            unit: "unit".into(),
            kind,
            tier,
            detected: kind != Kind::Null,
            right: true,
            both: kind == Kind::Double,
            in_set: true,
            misnamed: false,
            excess: Some(0),
            stage: Some(true),
            parameters: vec![Parameter { name: "p".into(), truth: 1.0, value: 1.0, ci90: [0.9, 1.1] }],
            held: Some(HeldOut { nominal: 0.5, model: 0.1, truth: 0.1 }),
            fitted: None,
        }
    }

    /// Twenty of each kind, all as they should be.
    fn perfect() -> Vec<Scored> {
        let tiers = Tier::ASKED.map(|tier| unit(Kind::Single, tier));
        let others = [Kind::Double, Kind::Null, Kind::Outside].map(|kind| unit(kind, Tier::Medium));
        tiers.into_iter().chain(others).cycle().take(120).collect()
    }

    fn failing(units: &[Scored]) -> Vec<(&'static str, &'static str)> {
        failures(&summary(units)).map(|row| (row.group, row.quantity)).collect()
    }

    #[test]
    fn every_score_holds_for_the_perfect_and_fails_on_its_own() {
        // nine intervals of ten are asked to hold the parameter
        let mut units = perfect();
        for unit in units.iter_mut().filter(|u| u.kind == Kind::Single).step_by(8) {
            unit.parameters[0].ci90 = [2.0, 3.0];
        }
        assert_eq!(failing(&units), []);
        type Spoil = fn(&mut Scored);
        let spoilt: [(Kind, Spoil, &str); 15] = [
            (Kind::Single, |u| u.detected = false, "detected"),
            (Kind::Single, |u| u.right = false, "first name true or inseparable"),
            (Kind::Single, |u| u.in_set = false, "set holds the truth"),
            (Kind::Single, |u| u.misnamed = true, "confident and wrong"),
            (Kind::Single, |u| u.held = Some(HeldOut { nominal: 0.5, model: 0.501, truth: 0.1 }), "held-out skill, median"),
            (
                Kind::Single,
                |u| u.held = Some(HeldOut { nominal: 0.5, model: 0.6, truth: 0.49 }),
                "held-out prediction made worse",
            ),
            (Kind::Single, |u| u.stage = Some(false), "stage right, of those named"),
            (Kind::Single, |u| u.excess = Some(1), "members of the set that are separable"),
            (Kind::Single, |u| u.parameters[0].ci90 = [2.0, 3.0], "90 % intervals that hold the parameter"),
            (Kind::Double, |u| u.right = false, "at least one named"),
            (Kind::Double, |u| u.both = false, "both named"),
            (Kind::Null, |u| u.detected = true, "falsely detected"),
            (Kind::Outside, |u| u.right = false, "verdict `unknown`"),
            (Kind::Outside, |u| u.misnamed = true, "confident and wrong"),
            (
                Kind::Outside,
                |u| u.held = Some(HeldOut { nominal: 0.5, model: 0.6, truth: 0.1 }),
                "held-out prediction made worse",
            ),
        ];
        for (kind, spoil, quantity) in spoilt {
            let mut units = units.clone();
            units.iter_mut().filter(|u| u.kind == kind).for_each(spoil);
            let failing = failing(&units);
            assert!(!failing.is_empty() && failing.iter().all(|(_, q)| *q == quantity), "{quantity}: {failing:?}");
        }
    }

    #[test]
    fn intervals_that_always_hold_are_too_wide_once_there_are_many() {
        assert_eq!(failing(&perfect()), [("in the library", "90 % intervals that hold the parameter")]);
        assert_eq!(failing(&perfect()[..6]), []);
    }

    #[test]
    fn a_score_without_a_unit_is_not_judged() {
        let rows = summary(&[unit(Kind::Null, Tier::Faint)]);
        let judged: Vec<_> = rows.iter().filter(|row| row.holds().is_some()).map(|row| row.quantity).collect();
        assert_eq!(judged, ["falsely detected"]);
    }

    #[test]
    fn faint_units_are_asked_nothing_in_a_tier() {
        let mut faint = unit(Kind::Single, Tier::Faint);
        faint.detected = false;
        assert_eq!(failing(&[faint]), []);
    }
}
