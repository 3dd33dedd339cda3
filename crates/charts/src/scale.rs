//! Map from values to pixels, and round numbers along an axis.

/// One of the two axes of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit, e.g. "time \[h\]".
    pub label: String,
    /// The smallest span that is drawn, in the axis' unit: less would blow rounding up to a picture.
    pub least_span: f64,
    /// Where the drawn range ends.
    pub ends: Ends,
    /// Range that is drawn in any case: both ends, in the axis' unit.
    pub covers: Option<[f64; 2]>,
    /// Names of 0, 1, … in place of numbers, written above the line of each; upwards only.
    pub names: Option<Vec<String>>,
}

/// Ends of the drawn range of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Ends of the data.
    Data,
    /// Round numbers around the ends of the data.
    Ticks,
    /// As [`Ends::Data`], the axis being logarithmic.
    Logarithmic,
}

impl Axis {
    /// An axis that ends where the data end.
    pub fn tight(label: impl Into<String>, least_span: f64) -> Self {
        Self { label: label.into(), least_span, ends: Ends::Data, covers: None, names: None }
    }

    /// An axis that ends at round numbers.
    pub fn round(label: impl Into<String>, least_span: f64) -> Self {
        Self { ends: Ends::Ticks, ..Self::tight(label, least_span) }
    }

    /// A logarithmic axis for positive numbers.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self { ends: Ends::Logarithmic, ..Self::tight(label, 0.0) }
    }

    /// An axis of names, the first at the bottom.
    pub fn named(label: impl Into<String>, names: Vec<String>) -> Self {
        let covers = Some([-0.4, names.len() as f64 - 0.2]);
        Self { covers, names: Some(names), ..Self::tight(label, 1.0) }
    }

    /// The axis with `ends` within what is drawn.
    pub fn covering(self, ends: [f64; 2]) -> Self {
        Self { covers: Some(ends), ..self }
    }
}

/// An axis laid over pixels.
pub(crate) struct Scale {
    /// Whether `low`, `high` and `step` are decimal logarithms.
    logarithmic: bool,
    low: f64,
    high: f64,
    /// Pixels of `low` and `high`.
    pixels: [f64; 2],
    step: f64,
}

impl Scale {
    /// Scale for data between `low` and `high`, with ticks at least `apart` pixels from each other.
    pub(crate) fn new(axis: &Axis, range: [f64; 2], pixels: [f64; 2], apart: f64) -> Self {
        let range = axis.covers.map_or(range, |[a, b]| [range[0].min(a), range[1].max(b)]);
        if axis.ends == Ends::Logarithmic {
            let [low, high] = range.map(|v| v.max(f64::MIN_POSITIVE).log10());
            let (low, high) = (low.min(high - 1.0) - MARGIN, high + MARGIN);
            let step = ((high - low) / ((pixels[1] - pixels[0]).abs() / apart).max(1.0)).ceil();
            return Self { logarithmic: true, low, high, pixels, step };
        }
        Self::linear(axis, range, pixels, apart)
    }

    fn linear(axis: &Axis, [mut low, mut high]: [f64; 2], pixels: [f64; 2], apart: f64) -> Self {
        let least = axis.least_span.max(1e-9 * low.abs().max(high.abs()));
        if high - low < least {
            let middle = low / 2.0 + high / 2.0;
            (low, high) = (middle - least / 2.0, middle + least / 2.0);
        }
        let count = ((pixels[1] - pixels[0]).abs() / apart).max(1.0);
        let step = round_step((high - low) / count);
        if axis.ends == Ends::Ticks {
            (low, high) = ((low / step + SLACK).floor() * step, (high / step - SLACK).ceil() * step);
        }
        Self { logarithmic: false, low, high, pixels, step }
    }

    pub(crate) fn pixel(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.max(f64::MIN_POSITIVE).log10() } else { value };
        self.pixels[0] + (value - self.low) / (self.high - self.low) * (self.pixels[1] - self.pixels[0])
    }

    /// Both ends of the drawn range, and whether they are decimal logarithms, as a page's script reads them.
    pub(crate) fn ends(&self) -> String {
        format!("{} {} {}", self.low, self.high, u8::from(self.logarithmic))
    }

    /// Whether a value lies in the drawn range.
    pub(crate) fn holds(&self, value: f64) -> bool {
        !self.logarithmic && (self.low..=self.high).contains(&value)
    }

    /// Round numbers and their labels.
    pub(crate) fn ticks(&self) -> Vec<(f64, String)> {
        let first = (self.low / self.step - SLACK).ceil();
        let all = (0..100).map(|i| (first + f64::from(i)) * self.step).take_while(|tick| *tick <= self.high + SLACK * self.step);
        if self.logarithmic {
            let powers: Vec<f64> = all.collect();
            // within two decades their halves and fifths help
            let factors: &[f64] = if self.high - self.low < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
            let short = factors.len() > 1 && self.low > -2.5 && self.high < 3.5;
            let below = powers.first().map(|first| first - 1.0);
            let each = below.iter().chain(&powers).flat_map(|power| factors.iter().map(move |factor| (*power, *factor)));
            return each.filter(|(power, factor)| self.spans(power + factor.log10())).map(|tick| of_ten(tick, short)).collect();
        }
        all.map(|tick| (tick, self.label(tick))).collect()
    }

    fn spans(&self, logarithm: f64) -> bool {
        (self.low - SLACK..=self.high + SLACK).contains(&logarithm)
    }

    fn label(&self, tick: f64) -> String {
        let most = self.low.abs().max(self.high.abs());
        let text = if !(1e-3..1e6).contains(&most) {
            // as many digits as the step needs below the largest number
            let digits = (most.log10().floor() - self.step.log10().floor()).clamp(0.0, 15.0) as usize;
            if tick.abs() < SLACK * self.step { "0".into() } else { format!("{tick:.digits$e}") }
        } else {
            let decimals = (-self.step.log10().floor()).clamp(0.0, 15.0) as usize;
            let rounded = format!("{tick:.decimals$}");
            if rounded.trim_start_matches('-').chars().all(|c| "0.".contains(c)) { "0".into() } else { rounded }
        };
        text.replace('-', "\u{2212}")
    }
}

/// Margin of a logarithmic axis beyond its data, in decades.
const MARGIN: f64 = 0.15;

/// A multiple of a power of ten, and its label, without an exponent if `short`.
fn of_ten((power, factor): (f64, f64), short: bool) -> (f64, String) {
    if short {
        let decimals = (-power).max(0.0) as usize;
        let value = factor * 10_f64.powf(power);
        return (value, format!("{value:.decimals$}"));
    }
    let ten = power_of_ten(power);
    (factor * 10_f64.powf(power), if factor == 1.0 { ten } else { format!("{factor} · {ten}") })
}

/// Width of a digit in font sizes, a little more than the usual fonts have.
pub(crate) const DIGIT: f64 = 0.62;

/// A power of ten as text.
pub(crate) fn power_of_ten(power: f64) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        c => c.to_digit(10).map_or(c, |d| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][d as usize]),
    };
    "10".chars().chain(format!("{power:.0}").chars().map(digit)).collect()
}

/// A tick this close to the end of an axis, in steps, is on it.
const SLACK: f64 = 1e-6;

/// The next of 1, 2, 5 times a power of ten.
fn round_step(least: f64) -> f64 {
    let decade = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|m| m * decade).find(|step| *step >= least * (1.0 - 1e-9)).unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: [f64; 2], ends: Ends) -> Vec<String> {
        let axis = Axis { ends, ..Axis::tight("", 0.01) };
        Scale::new(&axis, range, [0.0, 300.0], 60.0).ticks().into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_and_carry_the_digits_they_need() {
        assert_eq!(labels([-41.0, 62.0], Ends::Ticks), ["\u{2212}50", "0", "50", "100"]);
        assert_eq!(labels([0.0, 31.0], Ends::Data), ["0", "10", "20", "30"]);
        assert_eq!(labels([-0.55, 0.55], Ends::Ticks), ["\u{2212}1.0", "\u{2212}0.5", "0", "0.5", "1.0"]);
        assert_eq!(labels([20.0, 20.0], Ends::Ticks), ["19.994", "19.996", "19.998", "20.000", "20.002", "20.004", "20.006"]);
        assert_eq!(labels([1e9, 1.000_000_3e9], Ends::Data)[0], "1.0000000e9");
    }

    #[test]
    fn logarithmic_axes_have_powers_of_ten() {
        let scale = Scale::new(&Axis::logarithmic(""), [3e-3, 2.0], [0.0, 300.0], 40.0);
        let labels: Vec<String> = scale.ticks().into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["10⁻²", "10⁻¹", "10⁰"]);
        let narrow = Scale::new(&Axis::logarithmic(""), [0.9, 9.0], [0.0, 300.0], 40.0);
        assert_eq!(narrow.ticks().iter().map(|(v, l)| format!("{v} {l}")).collect::<Vec<_>>(), ["1 1", "2 2", "5 5", "10 10"]);
        assert!((scale.pixel(0.1) - scale.pixel(0.01) - (scale.pixel(1.0) - scale.pixel(0.1))).abs() < 1e-9);
        let lone = Scale::new(&Axis::logarithmic(""), [0.0, 5.0], [0.0, 300.0], 40.0);
        assert!(lone.pixel(0.0).is_finite() && !lone.ticks().is_empty());
    }

    #[test]
    fn pixels_are_linear_and_every_range_can_be_drawn() {
        let axis = Axis::tight("", 0.0);
        let scale = Scale::new(&axis, [1.0, 3.0], [100.0, 0.0], 20.0);
        assert_eq!((scale.pixel(1.0), scale.pixel(2.0), scale.pixel(3.0)), (100.0, 50.0, 0.0));
        for range in [[0.0, 0.0], [1e300, 1e300], [-1e-300, 1e-300], [-1e12, 1e12]] {
            let scale = Scale::new(&Axis::round("", 1e-6), range, [0.0, 300.0], 50.0);
            assert!(scale.pixel(range[0]).is_finite() && scale.ticks().len() < 20, "{range:?}");
        }
    }
}
