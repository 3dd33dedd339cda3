//! The plots of a simulation.

use crate::plot::{Axis, Figure, Series, Size, Style, Thinning};
use crate::simulate::{Row, Simulation, WINDOW_S};
use crate::units::DurationUnit;

/// Smallest spans that are drawn: less is rounding or noise.
const LEAST_C: f64 = 0.1;
const LEAST_DEG_PER_H: f64 = 1e-4;
const LEAST_C_PER_MIN: f64 = 1e-4;

/// All plots with their legends and captions.
pub(super) fn all(simulation: &Simulation) -> String {
    temperatures(simulation) + &parts(simulation) + &against_rate(simulation)
}

fn element(figure: &Figure, caption: &str) -> String {
    format!(
        "<figure>\n<h3>{}</h3>\n{}{}{}<figcaption>{caption}</figcaption>\n</figure>\n",
        figure.title,
        figure.legend(),
        figure.svg(Size::Wide),
        figure.svg(Size::Narrow)
    )
}

/// The time since the first row, in the unit of the axis.
fn time_axis(simulation: &Simulation) -> (Axis, impl Fn(&Row) -> f64) {
    let (unit, start) = (DurationUnit::of(simulation.duration()), simulation.row(0).time);
    let axis = Axis::tight(format!("time since the first row [{}]", unit.name()), 1e-6);
    (axis, move |row: &Row| unit.of_seconds(row.time - start))
}

fn temperatures(simulation: &Simulation) -> String {
    let (x, time) = time_axis(simulation);
    let point = |value: fn(&Row) -> f64| {
        let time = &time;
        move |n: usize| {
            let row = simulation.row(n);
            (time(&row), value(&row))
        }
    };
    let (chamber, spool) = (point(|row| row.chamber), point(|row| row.spool));
    let (count, thinning) = (simulation.count(), Thinning::Columns);
    let figure = Figure {
        id: "temperatures",
        title: "Chamber and spool temperature",
        description: "Temperature of the chamber wall and of the spool's thermometer over time; the thermometer lags behind.",
        x,
        y: Axis::round("temperature [°C]", LEAST_C),
        series: vec![
            Series { name: "chamber", style: Style::Second, count, at: &chamber, thinning },
            Series { name: "spool thermometer", style: Style::First, count, at: &spool, thinning },
        ],
    };
    element(&figure, "The chamber as the profile gives it, linear between its rows; the spool's thermometer as computed.")
}

fn parts(simulation: &Simulation) -> String {
    let (x, time) = time_axis(simulation);
    let point = |value: fn(&Row) -> f64| {
        let time = &time;
        move |n: usize| {
            // the first row has no rate: it repeats the second's, and a lone row shows its zero
            let row = simulation.row(if n == 0 { 1.min(simulation.count() - 1) } else { n });
            (time(&simulation.row(n)), value(&row))
        }
    };
    let values = [point(|row| row.shupe), point(|row| row.eo_axial), point(|row| row.eo_radial), point(|row| row.rate)];
    let names = ["Shupe", "elasto-optic, axial strain", "elasto-optic, radial strain", "total"];
    let styles = [Style::First, Style::Second, Style::Third, Style::Total];
    let (count, thinning) = (simulation.count(), Thinning::Columns);
    let all = values.iter().zip(names).zip(styles);
    let figure = Figure {
        id: "parts",
        title: "Bias and its parts",
        description: "Rotation rate that the gyroscope reports at rest over time, and its thermal and elasto-optic parts.",
        x,
        y: Axis::round("bias [°/h]", LEAST_DEG_PER_H),
        series: all.map(|((at, name), style)| Series { name, style, count, at, thinning }).collect(),
    };
    element(
        &figure,
        "Means since the previous row, as a gyroscope reports them. Shupe: eq. (1), the thermal phase; elasto-optic: the two terms of \
         eq. (2), from the strain of the glass along and across the fibre.",
    )
}

fn against_rate(simulation: &Simulation) -> String {
    let windows: Vec<(f64, f64)> = simulation.windows().map(|window| (window.spool_rate, window.rate)).collect();
    let ends = windows.iter().fold([0.0_f64, 0.0_f64], |[low, high], (x, _)| [low.min(*x), high.max(*x)]);
    let steady = simulation.steady.sensitivity.total();
    let ramp = |n: usize| (ends[n], steady * ends[n]);
    let course = |n: usize| windows[n];
    let figure = Figure {
        id: "loop",
        title: "Bias against the spool's temperature rate",
        description: "Total bias against the rate of the spool's temperature; in steady ramps the curve meets the straight line.",
        x: Axis::round("spool temperature rate [°C/min]", LEAST_C_PER_MIN),
        y: Axis::round("bias [°/h]", LEAST_DEG_PER_H),
        series: vec![
            Series { name: "steady-ramp sensitivity", style: Style::Second, count: 2, at: &ramp, thinning: Thinning::Distance },
            Series { name: "course", style: Style::First, count: windows.len(), at: &course, thinning: Thinning::Distance },
        ],
    };
    let caption = format!(
        "Each point is a mean over {WINDOW_S} s, or over one row where rows are further apart. The straight line has the slope of the \
         steady ramp, {} (°/h)/(°C/min); loops away from it are transients.",
        super::signed(steady, 3)
    );
    element(&figure, &caption)
}
