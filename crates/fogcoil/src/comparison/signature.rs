//! Drawings of the changes by a mechanism.

use charts::{Axis, Figure, Panel, Series, Style, significant};
use mechanisms::{RATE, SPOOL};

use super::{Comparison, Entry};
use crate::recommend::Programme;

const HOUR: f64 = 3600.0;

/// Drawing of a channel's change: its number, label, line, and the magnitude below which it is rounding \[deg/h\], \[K\].
type Channel = (usize, &'static str, Style, f64);

pub(crate) const CHANNELS: [Channel; 2] =
    [(RATE, "change of the rate [°/h]", Style::First, 1e-4), (SPOOL, "change of the spool's reading [K]", Style::Second, 0.02)];

pub(crate) fn chamber(programme: &Programme, time: Axis, high: f64) -> Panel<'static> {
    let corners = programme.corners.iter().map(|(t, c)| (t / HOUR, *c)).collect();
    Panel::lines(time, Axis::round("chamber [°C]", 1.0), high, vec![Series::new("", Style::Total, corners)])
}

impl Entry {
    /// Change by the mechanism in a channel under a programme, the `number`th of its comparison.
    pub(crate) fn change<'a>(
        &'a self,
        (number, programme): (usize, &Programme),
        (channel, label, style, least): Channel,
        time: Axis,
        high: f64,
    ) -> Panel<'a> {
        let change = &self.changes[number][channel];
        let interval = programme.duration() / (change.len().max(2) - 1) as f64;
        let line = Series::computed("", style, change.len(), move |n| (n as f64 * interval / HOUR, change[n]));
        Panel::lines(time, Axis::round(label, least), high, vec![line])
    }

    pub(crate) fn typical(&self, digits: usize) -> String {
        let values = self.parameters.iter().map(|p| format!("{} = {}", p.name, significant(p.typical, digits)));
        format!("{}: {}", self.id, values.collect::<Vec<_>>().join(", "))
    }
}

impl Comparison {
    /// Change of rate and of spool temperature by a mechanism of typical size, under the slow ramp and the fast one: an SVG document.
    pub fn signature(&self, entry: &Entry) -> String {
        let (both, time) = ([0, 1].map(|k: usize| (k, &self.programmes[k])), || Axis::tight("time [h]", 1.0));
        let mut panels: Vec<Panel> = both.iter().map(|(_, p)| chamber(p, time(), 5.0).headed(&p.name)).collect();
        for channel in CHANNELS {
            panels.extend(both.iter().map(|programme| entry.change(*programme, channel, time(), 8.0)));
        }
        let figure = Figure {
            id: "signature",
            title: entry.typical(3),
            description: "Left under a slow ramp, right under a fast one; from top to bottom the chamber, the change of the gyro's rate, the \
                          change of the spool thermometer's reading."
                .into(),
            caption: format!("{}; what the mechanism adds to the nominal response, without noise.", self.design),
            columns: 2,
            panels,
        };
        figure.document()
    }
}
