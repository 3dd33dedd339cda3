//! What a figure shows, as tables that are folded away: for those who do not see it, and for those who want a number.

use std::fmt::Write;

use super::grid;
use crate::figures::element;
use crate::picture::escape;
use crate::plot::{Content, Figure, HeatMap, Panel, Series};
use crate::table::significant;

/// Most rows of a table.
const MOST_ROWS: usize = 40;

/// A figure with its data.
pub(super) fn with_data(figure: &Figure) -> String {
    let mut out = element(figure);
    let _ = writeln!(out, "<details>\n<summary>The data of this figure: {}</summary>", escape(&figure.title));
    // of panels under one another the last alone names their axis
    let shared = figure.panels.iter().rev().map(|p| p.x.label.as_str()).find(|label| !label.is_empty()).unwrap_or_default();
    for panel in &figure.panels {
        let x = if panel.x.label.is_empty() { shared } else { &panel.x.label };
        match &panel.content {
            Content::Lines(series) => lines(&mut out, panel, x, series),
            Content::Map(map) => cells(&mut out, panel, x, map),
            Content::Drawing(_) => {}
        }
    }
    out.push_str("</details>\n");
    out
}

/// Series that share their x in one table.
fn lines(out: &mut String, panel: &Panel, x: &str, series: &[Series]) {
    // a single point marks one of another series
    let mut rest: Vec<&Series> = series.iter().filter(|s| s.count > 1).collect();
    while let Some(first) = rest.first() {
        let alike = |s: &&Series| s.count == first.count && (0..s.count).all(|n| (s.at)(n).0 == (first.at)(n).0);
        let (group, others): (Vec<&Series>, Vec<&Series>) = rest.iter().partition(|s| alike(s));
        let mut head = vec![x.to_owned()];
        for (n, s) in group.iter().enumerate() {
            // what has no name is the other half of what stands before it
            let same = group[..n].iter().zip(&head[1..]).rev().find(|(before, _)| before.style == s.style);
            let name = if s.name.is_empty() { same.map_or(&panel.y.label, |(_, name)| name) } else { &s.name };
            head.push(name.clone());
        }
        let every = group[0].count.div_ceil(MOST_ROWS);
        let chosen = (0..group[0].count).filter(|n| n % every == 0 || n + 1 == group[0].count);
        let row = |n: usize| {
            let values = group.iter().map(|s| number((s.at)(n).1));
            std::iter::once(number((group[0].at)(n).0)).chain(values).collect()
        };
        let rows: Vec<Vec<String>> = chosen.map(row).collect();
        let which = if every > 1 { format!(" (one row in {every})") } else { String::new() };
        let _ = writeln!(out, "<p>{}{which}</p>", escape(&name(panel)));
        grid(out, &head.iter().map(String::as_str).collect::<Vec<_>>(), &rows);
        rest = others;
    }
}

/// A map's cells, its upper row first.
fn cells(out: &mut String, panel: &Panel, x: &str, map: &HeatMap) {
    let (columns, rows) = (map.columns.max(1), map.values.len() / map.columns.max(1));
    let middle = |[low, high]: [f64; 2], k: usize, count: usize| low + (high - low) * (k as f64 + 0.5) / count as f64;
    let corner = format!("{} \\ {x}", panel.y.label);
    let head: Vec<String> =
        std::iter::once(corner).chain((0..columns).map(|k| significant(middle(map.x, k, columns), 3))).collect();
    let row = |r: usize| {
        let cell = |k: usize| {
            let at = r * columns + k;
            let stands_out = if map.marked.contains(&at) { " *" } else { "" };
            if map.values[at].is_finite() { significant(map.values[at], 2) + stands_out } else { String::new() }
        };
        std::iter::once(significant(middle(map.y, r, rows), 2)).chain((0..columns).map(cell)).collect()
    };
    let rows: Vec<Vec<String>> = (0..rows).rev().map(row).collect();
    let _ = writeln!(out, "<p>{}: {}; * stands out</p>", escape(&name(panel)), escape(&map.colours.label));
    grid(out, &head.iter().map(String::as_str).collect::<Vec<_>>(), &rows);
}

fn name(panel: &Panel) -> String {
    if panel.heading.is_empty() { panel.y.label.clone() } else { panel.heading.clone() }
}

fn number(value: f64) -> String {
    match value {
        v if !v.is_finite() => String::new(),
        v if v.fract() == 0.0 && v.abs() < 1e6 => format!("{v:.0}"),
        v => significant(v, 4),
    }
}
