//! The fitted parameters: densities after the recording beside those before.

use charts::{Axis, Cells, Figure, Panel, Series, Style, grid, significant};
use diagnosis::{Estimate, Place, Posterior, Role, Verdict};
use maud::{Markup, html};
use recording::statistics::normal_quantile;

use crate::diagnose::Outcome;
use crate::units::parameter_unit;

const POINTS: usize = 400;
/// Half-width over which a density is drawn [standard deviations].
const REACH: f64 = 5.0;

impl Outcome<'_> {
    /// Constants and instruments that the records put elsewhere than was known.
    pub(super) fn moved_table(&self) -> Markup {
        let rows = self.moved_rows();
        let Some((_, moved)) = rows.split_first() else { return Markup::default() };
        let head = ["constant or instrument", "value (fitted)", "standard deviations of what was known", "90 % interval"];
        html! {
            h3 { "Constants and instruments that moved" } "\n"
            (grid("Constants and instruments that moved", Cells::Words, &head, moved))
        }
    }

    pub(super) fn parameters(&self) -> Markup {
        if let Some(law) = self.law() {
            return of_law(&law.text().1);
        }
        let all = self.diagnosis.best().fit.posteriors(&self.gyro);
        let wanted = |p: &&Posterior| match self.diagnosis.verdict {
            Verdict::Explained | Verdict::Unknown => matches!(p.place, Place::Mechanism(_)),
            Verdict::Recalibrate => p.place == Place::Nominal(Role::Constant),
            Verdict::None => false,
        };
        let mut fitted: Vec<&Posterior> = all.iter().filter(wanted).collect();
        if self.diagnosis.verdict == Verdict::Recalibrate {
            // of many constants those that moved most come first
            fitted.sort_by(|a, b| b.u.abs().total_cmp(&a.u.abs()));
        }
        if fitted.is_empty() {
            return Markup::default();
        }
        let figure = Figure {
            id: "parameters",
            title: match self.diagnosis.verdict {
                Verdict::Unknown => "Parameters of the nearest description (fitted)".into(),
                _ => "Parameters (fitted)".into(),
            },
            description: "Probability density of each parameter after the recording, its 90 % interval, and its density before.".into(),
            caption: "After the recording (to either side of the value normal in the coordinate in which the prior is, and as wide as the \
                      90 % interval), that interval, and the prior; each density is scaled to its own maximum. If another mechanism is at work, none of this holds."
                .into(),
            columns: 2,
            panels: fitted.iter().map(|p| panel(p, self.interval(p))).collect(),
        };
        let rows: Vec<Vec<String>> = fitted
            .iter()
            .map(|p| {
                let (name, unit) = named(&p.name);
                let [after, before] = [self.interval(p), central(p, 0.0, 1.0)].map(interval);
                vec![name, significant(p.value(), 4), unit, after, before]
            })
            .collect();
        let head = ["parameter", "value (fitted)", "unit", "90 % interval", "90 % of the prior"];
        let chosen = self.diagnosis.best().fit.active.iter().enumerate().filter_map(|(place, active)| {
            let ((name, value), [low, high]) = (self.choice(active)?, self.diagnosis.choice(place)?);
            let id = self.id(active.mechanism);
            let [value, low, high] = [value, low, high].map(|k| self.chosen(name, k));
            Some(format!("{id}: {name} {value}, each compared with every other; 90 % lies in {low} to {high}."))
        });
        html! {
            (figure.element())
            (grid("Fitted values", Cells::Words, &head, &rows))
            @for choice in chosen { p { (choice) } "\n" }
        }
    }
}

/// A number's name and its unit, which stands in brackets behind a constant's name and at the end of a parameter's.
fn named(name: &str) -> (String, String) {
    let bracketed = name.strip_suffix(']').and_then(|name| name.rsplit_once(" ["));
    bracketed
        .map_or_else(|| (name.to_owned(), parameter_unit(name).into_owned()), |(name, unit)| (name.to_owned(), unit.to_owned()))
}

/// The numbers of a law that was composed.
fn of_law(estimates: &[Estimate]) -> Markup {
    let row =
        |e: &Estimate| vec![e.name.clone(), significant(e.value, 4), parameter_unit(&e.name).into_owned(), interval(e.ci90)];
    let rows: Vec<Vec<String>> = estimates.iter().map(row).collect();
    html! {
        h3 { "Parameters of the composed law (fitted)" } "\n"
        (grid("Fitted values", Cells::Words, &["parameter", "value (fitted)", "unit", "90 % interval"], &rows))
    }
}

fn interval(ends: [f64; 2]) -> String {
    ends.map(|end| significant(end, 4)).join(" to ")
}

/// 90 % interval of a normal u.
fn central(p: &Posterior, u: f64, sd: f64) -> [f64; 2] {
    Posterior { u, sd, ..p.clone() }.ci90()
}

/// Middle and standard deviations to either side of two halves of normal densities of u, whose 90 % interval has these ends. The interval may be wider than
/// that of the fit, and beside it: what is compared choice by choice has a density of its own for each.
fn halves(p: &Posterior, ends: [f64; 2]) -> (f64, [f64; 2]) {
    let [a, b] = ends.map(|end| p.prior.standard(end)).map(|u| if u.is_finite() { u } else { p.u });
    let [low, high] = [a.min(b), a.max(b)];
    let middle = if low < p.u && p.u < high { p.u } else { f64::midpoint(low, high) };
    let reach = normal_quantile(0.95);
    (middle, [middle - low, high - middle].map(|half| (half / reach).max(f64::MIN_POSITIVE)))
}

fn panel(p: &Posterior, [low, high]: [f64; 2]) -> Panel<'static> {
    let (middle, sds) = halves(p, [low, high]);
    let [from, to] = [middle - REACH * sds[0], middle + REACH * sds[1]];
    let at = |k: usize| from + (to - from) * k as f64 / POINTS as f64;
    // du/dvalue, so that it is a density of the value
    let slope = |u: f64| {
        let h = 1e-4;
        2.0 * h / (p.prior.value(u + h) - p.prior.value(u - h)).abs().max(f64::MIN_POSITIVE)
    };
    let density = |mean: f64, sd: f64| move |u: f64| (-((u - mean) / sd).powi(2) / 2.0).exp();
    let scaled = |of: &dyn Fn(f64) -> f64, most: f64| -> Vec<(f64, f64)> {
        (0..=POINTS).map(|k| (p.prior.value(at(k)), of(at(k)) * slope(at(k)) / most)).collect()
    };
    let most = |of: &dyn Fn(f64) -> f64, middle: f64, sd: f64| {
        let points = (0..=POINTS).map(|k| middle + REACH * sd * (2.0 * k as f64 / POINTS as f64 - 1.0));
        points.map(|u| of(u) * slope(u)).fold(f64::MIN_POSITIVE, f64::max)
    };
    let before = density(0.0, 1.0);
    let after = |u: f64| density(middle, sds[usize::from(u > middle)])(u);
    let posterior = scaled(&after, most(&after, middle, sds[0].max(sds[1])));
    let prior = scaled(&before, most(&before, 0.0, 1.0));
    let ends = |value: f64| Series::new("", Style::Fine(2), vec![(value, 0.0), (value, 1.0)]);
    Panel::lines(
        Axis::tight(p.name.clone(), 0.0),
        Axis::round("density, scaled", 0.1).covering([0.0, 1.0]),
        10.0,
        vec![
            Series::new("prior", Style::Second, prior),
            ends(low),
            ends(high),
            Series::new("posterior", Style::First, posterior),
        ],
    )
}

#[cfg(test)]
mod tests {
    use diagnosis::Prior;

    use super::*;

    #[test]
    fn a_unit_stands_in_its_own_column() {
        let told = |name: &str| {
            let (name, unit) = named(name);
            format!("{name} | {unit}")
        };
        assert_eq!(told("CW tail less CCW tail, beyond the drawing's [m]"), "CW tail less CCW tail, beyond the drawing's | m");
        assert_eq!(told("power_w"), "power_w | W");
        assert_eq!(told("alpha_r"), "alpha_r | 1");
    }

    #[test]
    fn the_drawn_density_has_the_interval_that_is_told() {
        let prior = Prior::LogNormal { median: 10.0, spread: 0.5 };
        let p = Posterior { name: "a".into(), place: Place::Nominal(Role::Constant), record: None, prior, u: 0.4, sd: 0.1 };
        let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        let of = |ends| {
            let (middle, [low, high]) = halves(&p, ends);
            [middle, low, high]
        };
        assert!(close(of(p.ci90()), [0.4, 0.1, 0.1]));
        // wider, and to one side of the fit
        let reach = normal_quantile(0.95);
        let ends = |[low, high]: [f64; 2]| [low, high].map(|u| prior.value(u));
        assert!(close(of(ends([0.4 - 0.3 * reach, 0.4 + 0.2 * reach])), [0.4, 0.3, 0.2]));
        assert!(close(of(ends([1.0 - 0.2 * reach, 1.0 + 0.2 * reach])), [1.0, 0.2, 0.2]));
    }
}
