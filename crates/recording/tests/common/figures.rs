//! Figures that are held as they were when the tests by other routes passed: a change that moves one has to say why.
//!
//! A file has a line for each. A test that fails writes its own beside, for comparison.

use std::fmt::{Debug, Write as _};

/// Distance of two numbers over the larger that still counts as the same: searches end within it, rounding moves them.
const SAME: f64 = 1e-4;
/// Distance over the largest number of the line.
const ROUNDING: f64 = 1e-12;

/// Figures, a line each: a name, a colon, and what it was found to be.
#[derive(Default)]
pub(crate) struct Figures(String);

impl Figures {
    pub(crate) fn add(&mut self, name: &str, figure: &impl Debug) {
        let _ = writeln!(self.0, "{name}: {figure:?}");
    }

    /// A few values of a series, and two sums that every one takes part in.
    pub(crate) fn series(&mut self, name: &str, values: &[f64]) {
        let known = || values.iter().enumerate().filter(|(_, value)| value.is_finite());
        let sum: f64 = known().map(|(_, value)| value).sum();
        let weighed: f64 = known().map(|(n, value)| value * ((n + 1) as f64).sin()).sum();
        let some: Vec<f64> = values.iter().step_by((values.len() / 5).max(1)).copied().collect();
        self.add(name, &(values.len(), known().count(), sum, weighed, some));
    }

    /// Holds the figures against the `kept` lines whose names begin with `topic`.
    pub(crate) fn hold(&self, kept: &str, topic: &str) {
        let kept = kept.lines().filter(|line| line.starts_with(topic));
        let (kept, found): (Vec<&str>, Vec<&str>) = (kept.collect(), self.0.lines().collect());
        let mut pairs = (0..kept.len().max(found.len())).map(|n| (kept.get(n), found.get(n)));
        let differ = pairs.find(|pair| !matches!(pair, (Some(kept), Some(found)) if is_same(kept, found)));
        if let Some((kept, found_line)) = differ {
            let own = format!("{}/figures-{topic}.txt", env!("CARGO_TARGET_TMPDIR"));
            std::fs::write(&own, found.join("\n") + "\n").expect("it can be written");
            panic!(
                "kept: {kept:#?}\nfound: {found_line:#?}\nif that is meant, put the lines of {own} in place of those of figures.txt that begin with `{topic}`"
            );
        }
    }
}

/// Numbers of a text, and the text without them.
fn parts(text: &str) -> (Vec<f64>, String) {
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    let words = || text.split_inclusive([' ', ',', ':', '(', ')', '[', ']', '{', '}', '"']);
    let bare = |word: &str| word.trim_end_matches([' ', ',', ':', '(', ')', '[', ']', '{', '}', '"']).to_owned();
    let numbers = words().filter_map(|word| bare(word).parse().ok()).collect();
    let rest = words().map(|word| if is_number(&bare(word)) { word.replacen(&bare(word), "#", 1) } else { word.to_owned() });
    (numbers, rest.collect())
}

fn is_same(a: &str, b: &str) -> bool {
    let ((numbers, rest), (others, other_rest)) = (parts(a), parts(b));
    // what rounding leaves of the largest is nothing
    let largest = numbers.iter().filter(|a| a.is_finite()).fold(0.0_f64, |most, a| most.max(a.abs()));
    let is_finite_and_near =
        |a: &f64, b: &f64| b.is_finite() && (a - b).abs() <= SAME * a.abs().max(b.abs()) + ROUNDING * largest;
    let near = |a: &f64, b: &f64| a == b || a.is_nan() && b.is_nan() || a.is_finite() && is_finite_and_near(a, b);
    rest == other_rest && numbers.len() == others.len() && numbers.iter().zip(&others).all(|(a, b)| near(a, b))
}
