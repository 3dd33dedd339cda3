//! Temperatures and bias in time, and the bias against the temperature rate (Fig. 7).

use charts::{Axis, Figure, Panel, Series, Style, signed, significant};

use crate::band::CourseBand;
use crate::simulate::{SimulatedRow, Simulation, WINDOW_S, Window};
use crate::summary::{Regression, Summary};
use crate::units::DurationUnit;

/// Name of the figure of the bias in time.
pub(super) const BIAS: &str = "bias";

/// Smallest spans that are drawn: less is rounding or noise.
const LEAST_C: f64 = 0.1;
const LEAST_DEG_PER_H: f64 = 1e-4;
const LEAST_C_PER_MIN: f64 = 1e-4;

/// Temperatures and bias, within their `band` if there is one, and bias against rate beside `measured` sensitivities of coils of this design.
pub(super) fn all<'a>(simulation: &'a Simulation, measured: &[Measured], band: Option<&'a CourseBand>) -> [Figure<'a>; 3] {
    let windows: Vec<Window> = simulation.windows().collect();
    [temperatures(simulation, band), parts(simulation, windows.clone(), band), against_rate(simulation, windows, measured)]
}

/// A measured sensitivity: its name, and its value \[(°/h)/(°C/min)\].
pub type Measured<'a> = (&'a str, f64);

/// The time since the first row, in the unit of the axis.
pub(crate) fn time_axis(simulation: &Simulation) -> (Axis, impl Fn(f64) -> f64 + Copy + use<>) {
    let (unit, start) = (DurationUnit::of(simulation.duration()), simulation.row(0).time);
    let axis = Axis::tight(format!("time since the first row [{}]", unit.name), 1e-6);
    (axis, move |time: f64| unit.of_seconds(time - start))
}

fn temperatures<'a>(simulation: &'a Simulation, band: Option<&'a CourseBand>) -> Figure<'a> {
    let (x, time) = time_axis(simulation);
    let series = |name: &str, style, value: fn(&SimulatedRow) -> f64| {
        Series::computed(name, style, simulation.count(), move |n| {
            let row = simulation.row(n);
            (time(row.time), value(&row))
        })
    };
    Figure {
        id: "temperatures",
        title: "Chamber and spool temperature".into(),
        description: "Temperature of the chamber wall and of the spool's thermometer over time; the thermometer lags behind."
            .into(),
        caption: match simulation.profile.inferred {
            None => "The chamber as the profile gives it, linear between its rows; the spool's thermometer as computed.".into(),
            Some(_) => {
                "The chamber as inferred from the spool's thermometer, linear between its rows; the thermometer as computed."
                    .into()
            }
        },
        columns: 1,
        panels: vec![Panel::lines(
            x,
            Axis::round("temperature [°C]", LEAST_C),
            20.0,
            recorded(simulation, "thermometer as recorded", time, |row| row.recorded[0], 0.0)
                .into_iter()
                .chain([
                    series("chamber", Style::Second, |row| row.chamber),
                    series("spool thermometer", Style::First, |row| row.spool),
                ])
                .chain(edges(simulation, time, move |n| band.map(|band| band.spool(n))))
                .collect(),
        )],
    }
}

/// The two edges of a band: a value and its standard deviation in every row; nothing without a band.
fn edges<'a>(
    simulation: &'a Simulation,
    time: impl Fn(f64) -> f64 + Copy + 'a,
    within: impl Fn(usize) -> Option<[f64; 2]> + Copy + 'a,
) -> impl Iterator<Item = Series<'a>> {
    let edge = move |(name, sign): (&str, f64)| {
        within(0)?;
        let at = move |n: usize| {
            let [value, sd] = within(n).unwrap_or_default();
            (time(simulation.row(n).time), value + sign * sd)
        };
        Some(Series::computed(name, Style::Guide, simulation.count(), at))
    };
    [("± 1 standard deviation by the design's tolerances", 1.0), ("", -1.0)].into_iter().filter_map(edge)
}

/// The recorded values less an offset, where there are any.
fn recorded<'a>(
    simulation: &'a Simulation,
    name: &str,
    time: impl Fn(f64) -> f64,
    of: fn(&SimulatedRow) -> f64,
    offset: f64,
) -> Option<Series<'a>> {
    let points: Vec<(f64, f64)> =
        simulation.rows().map(|row| (time(row.time), of(&row) - offset)).filter(|(_, value)| value.is_finite()).collect();
    (!points.is_empty()).then(|| Series::new(name, Style::Record, points))
}

/// The row that a rate is taken of: the first has none and repeats the second's, and a lone row shows its zero.
fn with_rate(simulation: &Simulation, row: usize) -> usize {
    if row == 0 { 1.min(simulation.count() - 1) } else { row }
}

/// Rate that was recorded where the simulated one vanishes \[deg/h\]: the intercept of a regression on it, or the mean where it does not change.
fn offset(simulation: &Simulation) -> Option<f64> {
    simulation.profile.recorded.as_ref()?;
    let mut regression = Regression::default();
    let rows = simulation.rows().skip(1).filter(|row| row.recorded[1].is_finite());
    rows.for_each(|row| regression.add(row.rate, row.recorded[1]));
    regression.intercept()
}

fn parts<'a>(simulation: &'a Simulation, windows: Vec<Window>, band: Option<&'a CourseBand>) -> Figure<'a> {
    let (x, time) = time_axis(simulation);
    let series = |name: &str, style, value: fn(&SimulatedRow) -> f64| {
        Series::computed(name, style, simulation.count(), move |n| {
            let row = simulation.row(with_rate(simulation, n));
            (time(simulation.row(n).time), value(&row))
        })
    };
    let recorded = offset(simulation).and_then(|offset| {
        recorded(simulation, &format!("as recorded, less {} °/h", signed(offset, 4)), time, |row| row.recorded[1], offset)
    });
    let bias = recorded.into_iter().chain([
        series("Shupe", Style::First, |row| row.shupe),
        series("elasto-optic, axial strain", Style::Second, |row| row.eo_axial),
        series("elasto-optic, radial strain", Style::Third, |row| row.eo_radial),
        series("total", Style::Total, |row| row.rate),
    ]);
    let bias = bias.chain(edges(simulation, time, move |n| band.map(|band| band.rate(with_rate(simulation, n)))));
    let ends = [simulation.row(0).time, simulation.row(simulation.count() - 1).time].map(time);
    let rate = Series::computed("", Style::First, windows.len(), move |n| (time(windows[n].time), windows[n].spool_rate));
    let unlabelled = Axis::tight("", x.least_span).covering(ends);
    Figure {
        id: BIAS,
        title: "Bias, its parts, and the spool's temperature rate".into(),
        description:
            "Rotation rate that the gyroscope reports at rest over time with its thermal and elasto-optic parts, and below it \
                      the rate of the spool's temperature, which it follows."
                .into(),
        caption: format!(
            "Bias: means since the previous row, as a gyroscope reports them. Shupe: eq. (1), the thermal phase; elasto-optic: the two \
             terms of eq. (2), from the strain of the glass along and across the fibre. Temperature rate: differences over {WINDOW_S} s, \
             or over one row where rows are further apart. Counterpart of Osunluk et al., Fig. 7.{}",
            if simulation.profile.recorded.is_some() {
                " The record is drawn less the rate that it has where the simulated one vanishes, by regression: Earth's rate and offset."
            } else {
                ""
            }
        ),
        columns: 1,
        panels: vec![
            Panel::lines(unlabelled, Axis::round("bias [°/h]", LEAST_DEG_PER_H), 18.0, bias.collect()),
            Panel::lines(
                x.covering(ends),
                Axis::round("rate of the spool's temperature [°C/min]", LEAST_C_PER_MIN),
                9.0,
                vec![rate],
            ),
        ],
    }
}

fn against_rate<'a>(simulation: &'a Simulation, windows: Vec<Window>, measured: &[Measured]) -> Figure<'a> {
    let ends = windows.iter().fold([0.0_f64, 0.0_f64], |[low, high], w| [low.min(w.spool_rate), high.max(w.spool_rate)]);
    let steady = simulation.steady.sensitivity.total();
    let count = windows.len();
    let mean = |of: fn(&Window) -> f64| windows.iter().map(of).sum::<f64>() / count.max(1) as f64;
    let (mean_rate, mean_bias) = (mean(|w| w.spool_rate), mean(|w| w.rate));
    let line = |name: String, style, value: &dyn Fn(f64) -> f64| Series::new(name, style, ends.map(|x| (x, value(x))).to_vec());
    let error = significant(simulation.steady.error_estimate, 2);
    let unit = "(°/h)/(°C/min)";
    let steady_name = format!("steady ramp: slope {} ± {error} {unit}", signed(steady, 4));
    let slope = Summary::of(simulation).slope;
    let course = Series::computed("course", Style::First, count, move |n| (windows[n].spool_rate, windows[n].rate));
    let mut series = vec![course.anywhere()];
    if let Some(slope) = slope {
        let name = format!("regression: slope {} {unit}", signed(slope, 4));
        series.push(line(name, Style::Total, &|x| mean_bias + slope * (x - mean_rate)));
    }
    // where the two agree its dashes lie on the regression
    series.push(line(steady_name, Style::Second, &|x| steady * x));
    for (n, (name, slope)) in measured.iter().enumerate() {
        series.push(line(format!("{name}: slope {} {unit}", signed(*slope, 2)), Style::Fine(n as u8), &|x| slope * x));
    }
    let thin = if measured.is_empty() { "" } else { " Thin lines: measured sensitivities, taken with the sign of the design's." };
    Figure {
        id: "bias-against-rate",
        title: "Bias against the spool's temperature rate".into(),
        description: "Total bias against the rate of the spool's temperature, the line of the steady-ramp sensitivity and the \
                      regression line; in steady ramps the course meets the first."
            .into(),
        caption: format!(
            "Each point of the course is a mean over {WINDOW_S} s, or over one row where rows are further apart. Steady ramp: what a ramp \
             that lasts would give, with its numerical error; loops away from it are transients. Regression: least squares with \
             intercept through all points.{thin}"
        ),
        columns: 1,
        panels: vec![Panel::lines(
            Axis::round("spool temperature rate [°C/min]", LEAST_C_PER_MIN),
            Axis::round("bias [°/h]", LEAST_DEG_PER_H),
            22.0,
            series,
        )],
    }
}
