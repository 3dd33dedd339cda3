//! The recordings with their models, and what is left; several records in one figure: each has the same panels, on the same scales.

use charts::{Axis, Content, Figure, Panel, Series, Style};
use maud::{Markup, html};

use super::{Clock, Quantity};
use crate::diagnose::{NOMINAL, Outcome, REFITTED, Record};

/// Ratio of what is left before to what is left after from which a picture shows it.
const SHOWS: f64 = 1.2;

/// What the first of two models is.
const NOMINAL_IS: &str =
    " The nominal model is the design as drawn with usual instruments, of which nothing but a constant offset was fitted.";

/// The residuals that a model leaves of a record that was fitted.
#[derive(Clone, Copy)]
struct Left<'a> {
    model: &'static str,
    record: &'a Record,
    /// by channel and row
    residuals: &'a [Vec<f64>],
}

impl Left<'_> {
    /// Rows of a channel with a value, and the residual there.
    fn of(&self, channel: usize) -> Vec<(f64, f64)> {
        let all = self.record.observed.time.iter().zip(&self.residuals[channel]);
        all.filter(|(_, r)| r.is_finite()).map(|(t, r)| (*t, *r)).collect()
    }
}

impl Outcome<'_> {
    /// Of each record that was fitted what the design leaves, and what the answer leaves; where they are one, that with the instruments fitted.
    ///
    /// The design has nothing fitted but an offset: an instrument's delay that may bend to a fault draws peaks that nobody recorded.
    fn before_and_after_of_each(&self) -> impl Iterator<Item = Vec<Left<'_>>> {
        let answer = &self.leading().residuals;
        self.fits.iter().zip(&self.by_design).zip(answer).map(|((record, by_design), answer)| {
            let left = |model, residuals| Left { model, record, residuals };
            match self.found() {
                None if !self.withdrawn.is_empty() => vec![left(NOMINAL, by_design)],
                None => vec![left(REFITTED, answer)],
                Some(name) => vec![left(NOMINAL, by_design), left(name, answer)],
            }
        })
    }

    pub(super) fn course(&self) -> Markup {
        html! { (self.recording().element()) (self.residuals().element()) }
    }

    /// The recordings with their models, an SVG document.
    pub fn picture(&self) -> String {
        self.recording().document()
    }

    fn recording(&self) -> Figure<'static> {
        let (columns, panels) = multiples(self.before_and_after_of_each().map(|shown| self.recorded(&shown)).collect());
        Figure {
            id: "course",
            title: format!("{}: recording and model", whose(&self.fits.iter().collect::<Vec<_>>())),
            description:
                "Chamber temperature, the gyroscope's rate and the spool's thermometer over time, as recorded and as modelled."
                    .into(),
            caption: "The models are driven by the recorded chamber temperature; each has its fitted constant offset.".into(),
            columns,
            panels,
        }
    }

    fn recorded(&self, shown: &[Left]) -> Vec<Panel<'static>> {
        let Some(Left { record, .. }) = shown.first() else { return Vec::new() };
        let (clock, time) = (self.clock(record), &record.observed.time);
        let chamber = time.iter().zip(&record.chamber).map(|(t, c)| (clock.at(*t), *c)).collect();
        let mut panels = vec![panel(&clock, "chamber [°C]", 0.1, 9.0, vec![Series::new("", Style::First, chamber)])];
        for q in self.quantities() {
            let recorded = &record.observed.channels[q.channel];
            let rows = || time.iter().zip(recorded).filter(|(_, y)| y.is_finite()).map(|(t, y)| (clock.at(*t), *y));
            let mut series = vec![Series::new("recording", Style::Fine(2), rows().collect())];
            for (n, fit) in shown.iter().enumerate() {
                let left = fit.of(q.channel);
                let predicted = rows().zip(left).map(|((t, y), (_, r))| (t, y - r)).collect();
                series.push(Series::new(fit.model, if n + 1 == shown.len() { Style::Second } else { Style::Third }, predicted));
            }
            panels.push(panel(&clock, q.label, q.least, 14.0, series));
        }
        panels.iter_mut().for_each(|panel| panel.heading = self.headed("", record));
        label_last(&mut panels, &clock);
        panels
    }

    fn residuals(&self) -> Figure<'static> {
        let (columns, panels) =
            multiples(self.before_and_after_of_each().map(|shown| self.left(&shown, self.quantities(), 9.0)).collect());
        Figure {
            id: "residuals",
            title: "What each model leaves".into(),
            description:
                "Recorded less modelled rate and spool temperature over time, for the design as drawn, and for what was found."
                    .into(),
            caption: format!(
                "A channel's panels have one scale. What is noise has no shape; what has one is missing in the model.{}",
                if self.found().is_some() { NOMINAL_IS } else { "" }
            ),
            columns,
            panels,
        }
    }

    /// Residuals in the first record: of the design as drawn, and of what was found; of the rate, or of the thermometer where that alone shows it.
    pub(super) fn before_and_after(&self) -> Figure<'static> {
        let panels = self.before_and_after_of_each().next().map_or(Vec::new(), |shown| {
            let rms = |left: &Left, q: &Quantity| {
                let left = left.of(q.channel);
                (left.iter().map(|(_, r)| r * r).sum::<f64>() / left.len().max(1) as f64).sqrt()
            };
            let shows = |q: &Quantity| {
                shown.first().zip(shown.last()).is_some_and(|(before, after)| rms(before, q) > SHOWS * rms(after, q))
            };
            let quantity = self.quantities().find(shows).or_else(|| self.quantities().next());
            self.left(&shown, quantity.into_iter(), 6.0)
        });
        Figure {
            id: "before-and-after",
            title: "What is left, before and after".into(),
            description: "Recorded less modelled over time, before and after what was found.".into(),
            caption: "Both panels have one scale. Noise has no shape.".into(),
            columns: 1,
            panels,
        }
    }

    fn left(&self, shown: &[Left], quantities: impl Iterator<Item = Quantity>, height: f64) -> Vec<Panel<'static>> {
        let Some(Left { record, .. }) = shown.first() else { return Vec::new() };
        let clock = self.clock(record);
        let mut panels = Vec::new();
        for q in quantities {
            let of = |fit: &Left| fit.of(q.channel).into_iter().map(|(t, r)| (clock.at(t), r)).collect::<Vec<_>>();
            // both on one scale
            let all = self.before_and_after_of_each().flatten().flat_map(|fit| fit.of(q.channel));
            let most = all.fold(q.least / 2.0, |most, (_, r)| r.abs().max(most));
            for (n, fit) in shown.iter().enumerate() {
                let style = if n + 1 == shown.len() { Style::Fine(2) } else { Style::Fine(0) };
                let label = format!("{} [{}]", q.name, q.unit);
                let heading = self.headed(&format!("recorded less {}", fit.model), record);
                let mut panel = panel(&clock, &label, q.least, height, vec![Series::new("", style, of(fit))]).headed(heading);
                panel.y.covers = Some([-most, most]);
                panels.push(panel);
            }
        }
        label_last(&mut panels, &clock);
        panels
    }

    /// A heading, with the record's name where several were fitted.
    pub(super) fn headed(&self, text: &str, record: &Record) -> String {
        match (self.fits.len() > 1, text.is_empty()) {
            (false, _) => text.to_owned(),
            (true, true) => record.name(),
            (true, false) => format!("{text}, {}", record.name()),
        }
    }
}

/// Whose records a figure shows.
pub(super) fn whose(records: &[&Record]) -> String {
    if let [one] = records { one.name() } else { format!("{} records", records.len()) }
}

pub(super) fn panel(clock: &Clock, label: &str, least: f64, lines: f64, series: Vec<Series<'static>>) -> Panel<'static> {
    Panel::lines(Axis { label: String::new(), ..clock.axis() }, Axis::round(label, least), lines, series)
}

/// Labels the time axis of the last panel: panels over one axis share one label.
pub(super) fn label_last(panels: &mut [Panel], clock: &Clock) {
    if let Some(last) = panels.last_mut() {
        last.x = Axis { covers: last.x.covers, ..clock.axis() };
    }
}

/// The panels of all records, and how many of them stand side by side: two records abreast, or under one another if their number is odd.
pub(super) fn multiples(mut records: Vec<Vec<Panel<'static>>>) -> (usize, Vec<Panel<'static>>) {
    same_scales(&mut records);
    let columns = if records.len().is_multiple_of(2) { 2 } else { 1 };
    let mut panels = Vec::new();
    let mut left = records.into_iter();
    while let Some(first) = left.next() {
        let mut second = if columns == 2 { left.next().unwrap_or_default() } else { Vec::new() }.into_iter();
        for panel in first {
            panels.push(panel);
            panels.extend(second.next());
        }
    }
    (columns, panels)
}

fn same_scales(records: &mut [Vec<Panel>]) {
    let rows = records.first().map_or(0, Vec::len);
    if records.len() < 2 {
        return;
    }
    for row in 0..rows {
        let lines = records.iter().filter_map(|panels| panels.get(row)).filter_map(|panel| match &panel.content {
            Content::Lines(series) => Some(series),
            Content::Map(_) | Content::Drawing(_) => None,
        });
        let all = lines.flatten().filter_map(Series::ranges).map(|[_, y]| y);
        let Some([low, high]) = all.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) else { continue };
        for panel in records.iter_mut().filter_map(|panels| panels.get_mut(row)) {
            let [a, b] = panel.y.covers.unwrap_or([low, high]);
            panel.y.covers = Some([a.min(low), b.max(high)]);
        }
    }
}
