//! Mechanisms whose law is text: a user's own.

use crate::bond;
use crate::catalogue::debond;
use crate::change::Per;
use crate::course::{Clock, GAP, Series, add, total};
use crate::design::heatable_flanges;
use crate::law_tools::Chain;
use crate::mechanism::{Change, Effect, Extent, Facts, Mechanism, Naming, Offer, Scene, Stage, Steady};
use crate::record_to_bias::Prepared;
use coil::{Design, Error};
use diagnosis::{Active, Parameter};
use laws::{Run, System};

/// A mechanism of a user's file.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Short name in every output, in kebab case.
    pub id: String,
    /// A heading.
    pub title: String,
    /// Stage at which it acts.
    pub stage: Stage,
    /// Its law, as it is written.
    pub equation: String,
    /// Its signature in a record.
    pub signature: String,
    /// Literature.
    pub source: String,
    /// The mechanism in a sentence.
    pub meaning: String,
    /// A check of the unit itself that decides about it.
    pub inspection: String,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Values of the parameters from which fits start.
    pub starts: Vec<Vec<f64>>,
    /// Quantities of a record that its laws and states use, in the order of the system's inputs.
    pub inputs: Vec<Input>,
    /// Its laws with their states, in parameters and inputs.
    pub system: System,
    /// Changed quantity of each law.
    pub targets: Vec<Target>,
}

/// Quantity of a record that a law may use.
#[derive(Debug, Clone, PartialEq)]
pub enum Input {
    /// Seconds since the first row.
    Time,
    /// A temperature as designed \[°C\], or a rate of it \[K/s\], or the rate of that \[K/s²\]: so many times differenced.
    Temperature(Body, usize),
    /// A part of the bias as designed \[deg/h\]: 0 Shupe, 1 elasto-optic axial, 2 radial.
    Part(usize),
    /// All parts together \[deg/h\].
    Bias,
    /// A further column of the record, as it stands there.
    Column(String),
}

/// Body of a temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// The chamber.
    Chamber,
    /// The spool where its thermometer sits.
    Spool,
    /// The coil, its mean.
    Coil,
}

/// Quantity that a law may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Added to the rate \[deg/h\].
    Rate,
    /// Added to what the spool's thermometer sees \[K\].
    Thermometer,
    /// Added to the chamber's temperature \[K\]: everything follows.
    Chamber,
    /// Heat into the first flange that may be heated \[W\].
    FlangePower,
    /// Relative change of the coil's transverse moduli.
    Stiffness,
    /// Relative change of the coil's transverse expansion.
    Expansion,
    /// Share of the first flange's bond that is open.
    OpenBond,
    /// Length by which the CW tail is longer \[m\].
    Tail,
    /// Relative change of the thermal phase (Shupe).
    Shupe,
    /// Relative change of the elasto-optic axial part.
    Axial,
    /// Relative change of the elasto-optic radial part.
    Radial,
    /// Relative change of all parts of the bias.
    Bias,
}

/// A name in laws, what it stands for, and its unit.
pub const INPUTS: [(&str, Input, &str); 14] = [
    ("time", Input::Time, "s"),
    ("chamber", Input::Temperature(Body::Chamber, 0), "degC"),
    ("chamber_rate", Input::Temperature(Body::Chamber, 1), "K/s"),
    ("chamber_rate2", Input::Temperature(Body::Chamber, 2), "K/s2"),
    ("spool", Input::Temperature(Body::Spool, 0), "degC"),
    ("spool_rate", Input::Temperature(Body::Spool, 1), "K/s"),
    ("spool_rate2", Input::Temperature(Body::Spool, 2), "K/s2"),
    ("coil", Input::Temperature(Body::Coil, 0), "degC"),
    ("coil_rate", Input::Temperature(Body::Coil, 1), "K/s"),
    ("coil_rate2", Input::Temperature(Body::Coil, 2), "K/s2"),
    ("shupe", Input::Part(0), "deg/h"),
    ("eo_axial", Input::Part(1), "deg/h"),
    ("eo_radial", Input::Part(2), "deg/h"),
    ("bias", Input::Bias, "deg/h"),
];

impl Target {
    /// The unit of a law that changes it.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Rate => "deg/h",
            Self::Thermometer | Self::Chamber => "K",
            Self::FlangePower => "W",
            Self::Tail => "m",
            Self::Stiffness | Self::Expansion | Self::OpenBond | Self::Shupe | Self::Axial | Self::Radial | Self::Bias => "1",
        }
    }

    /// The changed part of the model, in words.
    pub const fn place(self) -> &'static str {
        match self {
            Self::Rate => "added to the rate",
            Self::Thermometer => "added to what the spool's thermometer sees",
            Self::Chamber => "added to the chamber's temperature",
            Self::FlangePower => "heat into a flange",
            Self::Stiffness => "relative change of the coil's transverse moduli",
            Self::Expansion => "relative change of the coil's transverse expansion",
            Self::OpenBond => "share of a flange's bond that is open",
            Self::Tail => "length of the CW tail",
            Self::Shupe => "relative change of the thermal phase",
            Self::Axial => "relative change of the elasto-optic axial part",
            Self::Radial => "relative change of the elasto-optic radial part",
            Self::Bias => "relative change of all parts of the bias",
        }
    }

    /// Whether heat carries the change to fibre and thermometer: a jump of it is smooth there.
    pub const fn is_carried_by_heat(self) -> bool {
        matches!(self, Self::Chamber | Self::FlangePower)
    }

    /// Whether a design has such a place.
    fn is_in(self, design: &Design) -> bool {
        match self {
            Self::FlangePower => !heatable_flanges(design).is_empty(),
            Self::OpenBond => !debond::flanges(design).is_empty(),
            Self::Stiffness | Self::Expansion => design.mechanics == coil::Mechanics::Elastic,
            _ => true,
        }
    }
}

/// A factor that is still a coil's; what is no number stays none.
fn least(factor: f64) -> f64 {
    factor.clamp(0.05, f64::INFINITY)
}

impl Written {
    fn seen(&self, record: &Prepared) -> Vec<Vec<f64>> {
        let n = record.time.len();
        let rates = |series: &[f64]| recording::condition::slopes(&record.time, series);
        let of = |input: &Input| match input {
            Input::Time => record.time.iter().map(|t| t - record.time[0]).collect(),
            Input::Temperature(body, times) => {
                let level = match body {
                    Body::Chamber => &record.chamber,
                    Body::Spool => &record.nominal.sensor,
                    Body::Coil => &record.coil,
                };
                (0..*times).fold(level.clone(), |series, _| rates(&series))
            }
            Input::Part(part) => momentary(&record.nominal.parts[*part]),
            Input::Bias => momentary(&total(&record.nominal.parts)),
            // a record without the column is refused where it is read
            Input::Column(name) => record.columns.get(name).cloned().unwrap_or_else(|| vec![f64::NAN; n]),
        };
        self.inputs.iter().map(of).collect()
    }
}

/// Means over the interval that ends at each row of what is momentary and linear between the instants of a run; after a gap, over the span of a reading.
fn means(record: &Prepared, run: &Run, series: &[f64]) -> Vec<f64> {
    let of = |n: usize| {
        let Some(before) = n.checked_sub(1) else { return series[run.rows[0]] };
        let all = run.rows[before]..=run.rows[n];
        mean(&run.time[all.clone()], &series[all], record.averaging)
    };
    (0..run.rows.len()).map(of).collect()
}

/// Mean of lines from the first instant \[s\] to the last; if that is a gap between readings of so much `averaging` \[s\], over the last of these.
fn mean(time: &[f64], series: &[f64], averaging: f64) -> f64 {
    let [first, .., last] = time else { return f64::NAN };
    let gap = averaging > 0.0 && last - first > GAP * averaging;
    let began = if gap { last - averaging } else { *first };
    let part = |(t, x): (&[f64], &[f64])| {
        if t[1] <= began {
            return 0.0;
        }
        let from = t[0].max(began);
        let first = if from > t[0] { x[1] - (x[1] - x[0]) * (t[1] - from) / (t[1] - t[0]) } else { x[0] };
        (first + x[1]) / 2.0 * ((t[1] - from) / (last - began))
    };
    time.windows(2).zip(series.windows(2)).map(part).sum()
}

/// At the rows, of means over the intervals that end there.
fn momentary(means: &[f64]) -> Vec<f64> {
    (0..means.len()).map(|n| (means[n] + means[(n + 1).min(means.len() - 1)]) / 2.0).collect()
}

impl Mechanism for Written {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: &self.id,
            title: &self.title,
            stage: self.stage,
            equation: &self.equation,
            place: self.targets.first().map_or("", |target| target.place()),
            signature: &self.signature,
            source: &self.source,
            naming: Naming::Named { meaning: &self.meaning, inspection: &self.inspection },
            heat_path: None,
            steady: vec![Steady::Nothing("its law is a user's own")],
            extent: Extent::everywhere,
            caveat: |_| Some("whose law is not in this file: give the mechanism's own with --mechanism"),
        }
    }

    fn offer(&self, design: &Design, _: &Scene) -> Option<Offer> {
        let has_place = self.targets.iter().all(|target| target.is_in(design));
        has_place.then(|| Offer { parameters: self.parameters.clone(), choice: None, starts: self.starts.clone() })
    }

    fn effect(&self, chain: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        let run = self.system.through(&record.time, &active.values, &self.seen(record));
        let of = |target: Target| {
            let mut sum: Option<Vec<f64>> = None;
            for (_, series) in self.targets.iter().zip(&run.laws).filter(|(own, _)| **own == target) {
                let sum = sum.get_or_insert_with(|| vec![0.0; series.len()]);
                add(sum, series, 1.0);
            }
            sum
        };
        let mut change = Change {
            thermometer: of(Target::Thermometer).map(|kelvin| run.in_rows(&kelvin)),
            rate: of(Target::Rate).map(|rate| means(record, &run, &rate)),
            ..Change::none(record)
        };
        let mut follow = |series: Series| {
            change.parts.iter_mut().zip(&series.parts).for_each(|(part, by)| add(part, by, 1.0));
            let thermometer = change.thermometer.get_or_insert_with(|| vec![0.0; series.sensor.len()]);
            add(thermometer, &series.sensor, 1.0);
        };
        let clock = |course: &[f64]| Clock::with_jumps(&run.time, &run.rows, &run.jumps, course, record.averaging);
        if let Some(kelvin) = of(Target::Chamber) {
            follow(record.driven(&chain.library().base, 0, &clock(&kelvin)));
        }
        if let Some(watts) = of(Target::FlangePower)
            && let Some(heated) = chain.library().heaters.first()
        {
            follow(record.driven(heated, 1, &clock(&watts)));
        }
        if let Some(open) = of(Target::OpenBond)
            && let Some(bond) = record.bonds.first()
        {
            let mut per: Vec<_> = bond::constants().map(|_| Change::none(record).parts).collect();
            for (n, share) in means(record, &run, &open).into_iter().enumerate() {
                bond.add_to(&mut change.parts, &mut per, &bond.weights(share), n, 1.0);
            }
            change.per = Per::of_a_bond(per);
        }
        let factor = |target: Target| {
            of(target).map(|series| means(record, &run, &series).into_iter().map(|x| least(1.0 + x)).collect::<Vec<_>>())
        };
        let (stiffness, expansion) = (factor(Target::Stiffness), factor(Target::Expansion));
        if stiffness.is_some() || expansion.is_some() {
            let at = |factors: &Option<Vec<f64>>, n: usize| factors.as_ref().map_or(1.0, |factors| factors[n]);
            let parts = chain.softened(record, |n| (at(&stiffness, n), at(&expansion, n)));
            change.parts.iter_mut().zip(&parts).for_each(|(part, by)| add(part, by, 1.0));
        }
        if let Some(metres) = of(Target::Tail) {
            for (part, tail) in change.parts.iter_mut().zip(&record.tail) {
                part.iter_mut().zip(tail).zip(means(record, &run, &metres)).for_each(|((x, tail), metres)| *x += metres * tail);
            }
        }
        for (target, places) in [(Target::Shupe, 0..1), (Target::Axial, 1..2), (Target::Radial, 2..3), (Target::Bias, 0..3)] {
            if let Some(relative) = of(target) {
                let relative = means(record, &run, &relative);
                for p in places {
                    change.parts[p]
                        .iter_mut()
                        .zip(&record.nominal.parts[p])
                        .zip(&relative)
                        .for_each(|((x, part), by)| *x += part * by);
                }
            }
        }
        Ok(Effect::Coil(change))
    }

    /// A coil file holds no laws: the mechanism's own file does.
    fn extended(&self, design: &Design, _: &Active) -> Option<Design> {
        Some(design.clone())
    }

    fn columns(&self) -> Vec<&str> {
        let mut columns = Vec::new();
        for input in &self.inputs {
            if let Input::Column(name) = input {
                columns.push(name.as_str());
            }
        }
        columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x = 3 t at uneven instants: its mean is that at the middle, after a gap that of the last reading's span.
    #[test]
    fn exact_the_mean_of_a_line_is_its_middle() {
        let time = [10.0, 25.0, 30.0, 70.0];
        let line = time.map(|t| 3.0 * t);
        let of = |averaging: f64| mean(&time, &line, averaging);
        assert!((of(0.0) - 120.0).abs() < 1e-12 && (of(60.0) - 120.0).abs() < 1e-12);
        // 40 s are the longest reading that this is no gap for
        assert!((of(40.0) - 120.0).abs() < 1e-12 && (of(39.9) - 3.0 * (70.0 - 39.9 / 2.0)).abs() < 1e-9, "{}", of(39.9));
        assert!((of(20.0) - 180.0).abs() < 1e-9);
        assert!(mean(&[5.0], &[1.0], 0.0).is_nan());
    }

    #[test]
    fn exact_a_row_is_between_the_means_about_it() {
        assert_eq!(momentary(&[2.0, 4.0, 10.0, 1.0]), [3.0, 7.0, 5.5, 1.0]);
        assert!(momentary(&[]).is_empty());
    }

    #[test]
    fn a_factor_stays_a_coil_s() {
        assert_eq!([least(-3.0), least(0.04), least(0.05), least(2.0)], [0.05, 0.05, 0.05, 2.0]);
        assert!(least(f64::NAN).is_nan());
    }

    #[test]
    fn exact_after_a_gap_a_reading_is_the_mean_of_its_own_span() {
        let mean_of = |dt: f64, averaging: f64| mean(&[20.0, 20.0 + dt], &[1.0, 5.0], averaging);
        assert_eq!(mean_of(10.0, 10.0), 3.0);
        // the last 10 s of a line that rises by 4 in 100 s
        assert_eq!(mean_of(100.0, 10.0), 4.8);
        // rows of which nobody said how long a reading is
        assert_eq!(mean_of(100.0, 0.0), 3.0);
    }

    #[test]
    fn exact_a_reading_in_which_a_law_jumps_is_the_mean_of_both_sides() {
        let (time, series) = ([0.0, 7.0, 7.0 + 1e-9, 10.0], [0.0, 0.0, 1.0, 1.0]);
        assert!((mean(&time, &series, 10.0) - 0.3).abs() < 1e-9);
        // of the last 5 s
        assert!((mean(&time, &series, 5.0) - 0.6).abs() < 1e-9);
        // late in a record no number is left between the two sides
        assert!((mean(&[0.0, 7.0, 7.0, 10.0], &series, 10.0) - 0.3).abs() < 1e-12);
    }
}
