//! Several records in one figure: each has the same panels, on the same scales.

use charts::{Content, Panel, Series};

use crate::diagnose::{Outcome, Record};

impl Outcome {
    /// A heading, with the record's name where several were fitted.
    pub(super) fn headed(&self, text: &str, record: &Record) -> String {
        match (self.fits.len() > 1, text.is_empty()) {
            (false, _) => text.to_owned(),
            (true, true) => record.name(),
            (true, false) => format!("{text}, {}", record.name()),
        }
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

/// What is comparable has one scale.
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
