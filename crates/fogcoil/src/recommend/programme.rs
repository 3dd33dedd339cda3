//! Chamber programmes within the chamber's limits: five families, several members of each.

use std::f64::consts::TAU;
use std::fmt::Write;

use crate::Error;
use crate::table::significant;
use crate::tabular::{Column, Table};

/// Abilities of the chamber.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Lowest temperature \[°C\].
    pub coldest: f64,
    /// Highest temperature \[°C\].
    pub hottest: f64,
    /// Fastest change [K/min].
    pub fastest: f64,
    /// Length of a test \[h\].
    pub hours: f64,
}

/// Shortest and longest test \[h\].
const HOURS: [f64; 2] = [2.0, 240.0];

impl Limits {
    /// Limits of a usual chamber and a day, where nothing else is given.
    pub const USUAL: Self = Self { coldest: -40.0, hottest: 60.0, fastest: 2.0, hours: 24.0 };

    /// Limits that leave something to vary.
    ///
    /// # Errors
    /// [`files::Error::Usage`] names the flag at fault.
    pub fn check(&self) -> Result<(), Error> {
        let Self { coldest, hottest, fastest, hours } = *self;
        let wrong = |text: String| Err(Error::usage(text));
        if ![coldest, hottest].iter().all(|t| (-100.0..=200.0).contains(t)) {
            return wrong(format!("--coldest {coldest} --hottest {hottest}: give degrees Celsius from -100 to 200"));
        }
        if hottest - coldest < 1.0 {
            return wrong(format!("--coldest {coldest} --hottest {hottest}: leave at least one kelvin between them"));
        }
        if !(0.01..=100.0).contains(&fastest) {
            return wrong(format!("--fastest {fastest}: give K/min from 0.01 to 100"));
        }
        if !(HOURS[0]..=HOURS[1]).contains(&hours) {
            return wrong(format!("--hours {hours}: give {} to {}", HOURS[0], HOURS[1]));
        }
        Ok(())
    }

    /// Between its ends \[K\].
    fn range(&self) -> f64 {
        self.hottest - self.coldest
    }
}

/// A chamber programme: temperature \[°C\] linear between instants \[s\].
#[derive(Debug, Clone, PartialEq)]
pub struct Programme {
    /// Short name of its family.
    pub family: &'static str,
    /// Its effect.
    pub name: String,
    /// Instants and temperatures of its corners.
    pub corners: Vec<(f64, f64)>,
}

/// Time at rest before anything moves \[s\].
const REST: f64 = 1800.0;
const HOUR: f64 = 3600.0;
/// Temperature at which a test begins if the limits allow it \[°C\].
const ROOM: f64 = 20.0;

/// Corners under way, cut at the end of the test.
struct Path {
    corners: Vec<(f64, f64)>,
    end: f64,
}

impl Path {
    fn new(limits: &Limits) -> Self {
        let start = ROOM.clamp(limits.coldest, limits.hottest);
        Self { corners: vec![(0.0, start), (REST, start)], end: limits.hours * HOUR }
    }

    fn last(&self) -> (f64, f64) {
        self.corners[self.corners.len() - 1]
    }

    /// Whether there is time left.
    fn open(&self) -> bool {
        self.last().0 < self.end
    }

    /// Goes to a temperature at a rate [K/s] and stays for `dwell` \[s\].
    fn go(&mut self, to: f64, rate: f64, dwell: f64) {
        let (time, from) = self.last();
        for (duration, to) in [((to - from).abs() / rate, to), (dwell, to)] {
            let (time, from) = (time.max(self.last().0), self.last().1);
            if duration <= 0.0 || time >= self.end {
                continue;
            }
            let share = ((self.end - time) / duration).min(1.0);
            self.corners.push((time + share * duration, from + share * (to - from)));
        }
    }

    /// Repeats `targets` until the test ends.
    fn cycle(mut self, targets: &[f64], rate: f64, dwell: f64) -> Vec<(f64, f64)> {
        while self.open() {
            targets.iter().for_each(|to| self.go(*to, rate, dwell));
        }
        self.corners
    }
}

/// Every programme that is compared; the first is the slow ramp that a test usually is.
pub fn programmes(limits: &Limits) -> Vec<Programme> {
    let Limits { coldest, hottest, fastest, hours } = *limits;
    let fast = fastest / 60.0;
    let mut programmes = Vec::new();
    let mut add = |family, name: String, corners| programmes.push(Programme { family, name, corners });
    let between = Path::new(limits);
    let start = between.last().1;
    // one cycle fills the test but for its dwells
    for dwell in [0.5_f64, 2.0] {
        let dwell = dwell.min(hours / 12.0);
        let travel = 2.0 * limits.range();
        let rate = (travel / (hours * HOUR - REST - 3.0 * dwell * HOUR)).min(fast);
        let corners = Path::new(limits).cycle(&[coldest, hottest, start], rate, dwell * HOUR);
        add("slow ramp", format!("slow ramp, {} K/min, dwells of {dwell:.1} h", pace(rate * 60.0)), corners);
    }
    for (rate, dwell) in [(fast, 3.0), (fast, 1.0), (fast / 2.0, 3.0)] {
        let corners = Path::new(limits).cycle(&[coldest, hottest], rate, dwell * HOUR);
        add("fast ramp", format!("fast ramp, {} K/min, dwells of {dwell:.0} h", pace(rate * 60.0)), corners);
    }
    for (step, minutes) in [(5.0, 20.0), (10.0, 45.0), (20.0, 90.0)] {
        let corners = Path::new(limits).cycle(&stairs(limits, start, step), fast, minutes * 60.0);
        let name = format!("staircase, steps of {step:.0} K at {} K/min, dwells of {minutes:.0} min", pace(fastest));
        add("staircase", name, corners);
    }
    for period in [0.5, 1.5, 4.0] {
        let name = format!("sine of {period:.1} h and steps about four temperatures");
        add("sine and steps", name, waves(limits, start, period * HOUR));
    }
    for share in [1.0, 0.5, 0.25, 0.1] {
        let corners = Path::new(limits).cycle(&[coldest, hottest], share * fast, 0.0);
        add("cycles", format!("cycles without dwells, {} K/min", pace(share * fastest)), corners);
    }
    programmes
}

/// A rate [K/min] with two decimals, a slow one with two digits.
fn pace(rate: f64) -> String {
    if rate < 0.1 { significant(rate, 2) } else { format!("{rate:.2}") }
}

/// Down, up and back to the start in equal steps.
fn stairs(limits: &Limits, start: f64, step: f64) -> Vec<f64> {
    let mut stairs = Vec::new();
    let mut at = start;
    for to in [limits.coldest, limits.hottest, start] {
        while (to - at).abs() > 1e-9 {
            at += (to - at).clamp(-step, step);
            stairs.push(at);
        }
    }
    stairs
}

/// Steps of ±5 to ±15 K in a fixed pseudo-random order.
const STEPS: [f64; 8] = [5.0, -10.0, 15.0, -5.0, 10.0, -15.0, -10.0, 10.0];
/// Interval of a sine's corners \[s\].
const FINE: f64 = 120.0;

/// About each of four temperatures: a sine, then steps that dwell for half of its period.
fn waves(limits: &Limits, start: f64, period: f64) -> Vec<(f64, f64)> {
    let fast = limits.fastest / 60.0;
    let mut path = Path::new(limits);
    let quarter = (path.end - REST) / 4.0;
    // largest swing that stays within a quarter of the range and within the rate
    let swing = (limits.range() / 6.0).min(15.0).min(0.9 * fast * period / TAU);
    for (k, share) in [0.2, 0.6, 0.8, 0.4].into_iter().enumerate() {
        let mean = limits.coldest + share * limits.range();
        let until = REST + quarter * (k as f64 + 1.0);
        path.go(mean, fast, 0.0);
        let (begin, _) = path.last();
        let half = begin + (until - begin) / 2.0;
        while path.open() && path.last().0 + FINE < half {
            let phase = TAU * (path.last().0 + FINE - begin) / period;
            path.corners.push((path.last().0 + FINE, mean + swing * phase.sin()));
        }
        for step in STEPS.iter().cycle() {
            if !path.open() || path.last().0 >= until {
                break;
            }
            let to = (mean + step * swing / 15.0).clamp(limits.coldest, limits.hottest);
            path.go(to, fast, period / 2.0);
        }
    }
    if path.open() {
        path.go(start, fast, limits.hours * HOUR);
    }
    path.corners
}

impl Programme {
    /// Length \[s\].
    pub fn duration(&self) -> f64 {
        self.corners.last().map_or(0.0, |corner| corner.0)
    }

    /// Temperatures every `interval` seconds.
    pub(super) fn sampled(&self, interval: f64) -> (Vec<f64>, Vec<f64>) {
        let count = (self.duration() / interval).floor() as usize;
        let time: Vec<f64> = (0..=count).map(|n| n as f64 * interval).collect();
        let at = |t: &f64| {
            let upper = self.corners.partition_point(|corner| corner.0 <= *t).clamp(1, self.corners.len() - 1);
            let ((t0, a), (t1, b)) = (self.corners[upper - 1], self.corners[upper]);
            if t1 > t0 { a + (b - a) * ((t - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { b }
        };
        let chamber = time.iter().map(at).collect();
        (time, chamber)
    }

    /// The corners as a profile.
    pub fn table(&self) -> Table {
        let (time, chamber) = self.corners.iter().map(|corner| (Some(corner.0), Some(corner.1))).unzip();
        Table { columns: vec![Column::numbers("time_s", time), Column::numbers("chamber_c", chamber)], about: Vec::new() }
    }

    /// The programme as a profile that `fogcoil simulate` reads.
    pub fn csv(&self) -> String {
        let mut text = "time_s,chamber_c\n".to_owned();
        for (time, temperature) in &self.corners {
            let _ = writeln!(text, "{time:.1},{temperature:.3}");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_programme_keeps_the_limits_and_fills_the_test() {
        let narrow = Limits { coldest: 25.0, hottest: 29.0, fastest: 0.1, hours: 2.5 };
        let warm = Limits { coldest: 30.0, hottest: 80.0, fastest: 10.0, hours: 100.0 };
        let slow = Limits { coldest: 19.0, hottest: 20.5, fastest: 0.02, hours: 24.0 };
        for limits in [Limits::USUAL, narrow, warm, slow] {
            for programme in programmes(&limits) {
                let name = &programme.name;
                assert!((programme.duration() - limits.hours * HOUR).abs() < 1e-6, "{name}: {}", programme.duration());
                assert_eq!(programme.corners[0].1, programme.corners[1].1, "{name} begins at rest");
                assert!(!name.contains(" 0.00 K/min"), "{name}");
                for pair in programme.corners.windows(2) {
                    let ((t0, a), (t1, b)) = (pair[0], pair[1]);
                    assert!(t1 > t0 && (b - a).abs() / (t1 - t0) <= limits.fastest / 60.0 * 1.000_001, "{name}: {pair:?}");
                    assert!(b > limits.coldest - 1e-6 && b < limits.hottest + 1e-6, "{name}: {pair:?}");
                }
                let (time, chamber) = programme.sampled(30.0);
                assert!(time.len() == chamber.len() && time.len() > 100);
            }
        }
    }
}
