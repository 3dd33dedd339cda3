//! Place of the difference: over temperature and its rate, in time, in frequency.

use bias::units::S_PER_MIN;
use charts::{Axis, Colours, Figure, HeatMap, Height, Panel, Series, Style};
use diagnosis::{Cell, Spectrum};
use maud::{Markup, html};
use mechanisms::RATE;

use super::Shown;
use super::course::{self, multiples};
use crate::diagnose::Outcome;

/// z at which the colours end.
const MOST_Z: f64 = 10.0;

impl Outcome<'_> {
    pub(super) fn place(&self) -> Markup {
        // a figure of one record needs a panel at least
        let drawn = [self.map(), self.blocks(), self.coherence()].into_iter().filter(|figure| !figure.panels.is_empty());
        html! { @for figure in drawn { (figure.element()) } }
    }

    fn map(&self) -> Figure<'static> {
        let cells = |fit: Shown| {
            let cells = fit.fit.over_state(&self.gyro, (fit.number, fit.number), RATE, &fit.record.observed, fit.judge);
            (self.headed(fit.name, fit.record), cells)
        };
        let all: Vec<(String, Vec<Cell>)> = self.each().flatten().map(cells).collect();
        let most = all.iter().flat_map(|(_, cells)| cells).fold(3.0_f64, |most, cell| cell.z.abs().max(most)).min(MOST_Z);
        let panels: Vec<Panel> = all.iter().filter_map(|(name, cells)| grid(name, cells, most)).collect();
        Figure {
            id: "state",
            title: "The rate's residual over temperature and its rate".into(),
            description: "Map of the mean whitened residual over the spool's temperature and its rate; dots mark cells that stand out.".into(),
            caption: "z: sum of the whitened residual in a cell over the root of its rows, standard normal in noise. A dot marks what \
                      stands out, at most one in twenty of them by chance (Benjamini and Hochberg). Columns of one colour: a function of the \
                      temperature; upper and lower halves of opposite colours: a function of its rate."
                .into(),
            columns: 2,
            panels,
        }
    }

    fn blocks(&self) -> Figure<'static> {
        let (columns, panels) = multiples(self.each().map(|shown| self.stretches(&shown)).collect());
        Figure {
            id: "blocks",
            title: "When the residual is larger than noise".into(),
            description: "Mean square of the whitened residual in stretches of equal length; those that stand out are marked."
                .into(),
            caption: "In stretches of equal length; 1 is noise. Marked: what stands out, the number of stretches considered."
                .into(),
            columns,
            panels,
        }
    }

    fn stretches(&self, shown: &[Shown]) -> Vec<Panel<'static>> {
        let Some(Shown { record, .. }) = shown.first() else { return Vec::new() };
        let clock = self.clock(record);
        let mut panels = Vec::new();
        for q in self.quantities() {
            let mut series = Vec::new();
            for (n, fit) in shown.iter().enumerate() {
                let last = n + 1 == shown.len();
                let blocks = fit.fit.in_time(fit.number, q.channel, &fit.record.observed, fit.judge);
                let middle = |b: &diagnosis::Block| (clock.at((b.time[0] + b.time[1]) / 2.0), b.excess);
                series.push(Series::new(
                    fit.name,
                    if last { Style::First } else { Style::Second },
                    blocks.iter().map(middle).collect(),
                ));
                // each mark is a series of its own: none is joined to the next
                let marks = blocks.iter().filter(|b| b.significant).enumerate();
                series.extend(marks.map(|(k, b)| {
                    let name = if k == 0 { format!("stands out, {}", fit.name) } else { String::new() };
                    Series::new(name, Style::Marked(u8::from(!last)), vec![middle(b)])
                }));
            }
            let (time, excess) = (clock.axis().covering(clock.ends()), Axis::logarithmic("mean square over that of noise"));
            let time = Axis { label: String::new(), ..time };
            panels.push(Panel::lines(time, excess, 10.0, series).headed(self.headed(q.name, record)));
        }
        course::label_last(&mut panels, &clock);
        panels
    }

    fn coherence(&self) -> Figure<'static> {
        let panel = |fit: Shown| -> Option<Panel<'static>> {
            let spectra = fit.fit.in_frequency(&self.gyro, (fit.number, fit.number), RATE, &fit.record.observed);
            let threshold = spectra.first()?.threshold;
            let of = |k: usize| spectra.iter().map(|s: &Spectrum| (s.frequency, s.coherence[k])).collect::<Vec<_>>();
            let ends = [spectra.first()?.frequency, spectra.last()?.frequency];
            let series = vec![
                Series::new("noise exceeds it once in twenty", Style::Fine(1), ends.map(|f| (f, threshold)).to_vec()),
                Series::new("with the temperature", Style::First, of(0)),
                Series::new("with its rate", Style::Second, of(1)),
                Series::new("with the change of its rate", Style::Third, of(2)),
            ];
            let coherence = Axis::round("squared coherence", 0.1).covering([0.0, 1.0]);
            let panel = Panel::lines(Axis::logarithmic("frequency [Hz]"), coherence, 14.0, series);
            Some(panel.headed(self.headed(fit.name, fit.record)))
        };
        let panels: Vec<Panel> = self.each().flatten().filter_map(panel).collect();
        Figure {
            id: "coherence",
            title: "Coherence of the rate's residual with the spool's temperature".into(),
            description:
                "Squared coherence of the residual with the spool's temperature, its rate and the change of its rate against \
                          frequency, and what noise exceeds once in twenty."
                    .into(),
            caption:
                "Nine half-overlapping segments. At frequencies at which the temperature hardly moves, coherence says nothing."
                    .into(),
            columns: 2,
            panels,
        }
    }
}

/// Cells as a map, temperature to the right, its rate upwards.
fn grid(name: &str, cells: &[Cell], most: f64) -> Option<Panel<'static>> {
    let first = cells.first()?;
    let (wide, high) = (first.level[1] - first.level[0], first.rate[1] - first.rate[0]);
    let ends = |of: &dyn Fn(&Cell) -> [f64; 2]| {
        cells.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [c, d]| [a.min(c), b.max(d)])
    };
    let (x, y) = (ends(&|c| c.level), ends(&|c| c.rate));
    if !(wide > 0.0 && high > 0.0) {
        return None;
    }
    let place = |at: f64, low: f64, step: f64| ((at - low) / step).round() as usize;
    let (columns, rows) = (place(x[1], x[0], wide).max(1), place(y[1], y[0], high).max(1));
    let mut values = vec![f64::NAN; columns * rows];
    let mut marked = Vec::new();
    for cell in cells {
        let at = place(cell.rate[0], y[0], high) * columns + place(cell.level[0], x[0], wide);
        if let Some(value) = values.get_mut(at) {
            *value = cell.z;
            marked.extend(cell.significant.then_some(at));
        }
    }
    let (y, colours) = (y.map(|rate| rate * S_PER_MIN), Colours::diverging("z", most, 1.0));
    let map = HeatMap { columns, values, x, y, colours, bar: true, marked, outlines: Vec::new() };
    let (level, rate) = (Axis::tight("spool temperature [°C]", 0.1), Axis::tight("its rate [°C/min]", 1e-6));
    Some(Panel::map(level, rate, Height::Lines(16.0), map).headed(name))
}
