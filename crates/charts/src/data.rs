//! The data of a figure as tables that are folded away: for those who do not see it, and for those who want a number.

use maud::{Markup, html};

use crate::number::significant;
use crate::tables::{Cells, grid};
use crate::{Content, Drawing, HeatMap, Panel, Series, Style};

/// Most rows of a table, extremes not counted.
const MOST_ROWS: usize = 40;
/// Most columns and rows of a map's table.
const MOST_CELLS: [usize; 2] = [12, 20];

/// The tables of a figure by its title and panels.
pub(crate) fn data(title: &str, panels: &[Panel]) -> Markup {
    // of panels under one another the last alone names their axis
    let shared = panels.iter().rev().map(|p| p.x.label.as_str()).find(|label| !label.is_empty()).unwrap_or_default();
    html! {
        details {
            summary { "The data of this figure: " (title) } "\n"
            @for panel in panels { (table(title, panel, shared)) }
        } "\n"
    }
}

fn table(title: &str, panel: &Panel, shared: &str) -> Markup {
    // apart from the other tables of the page
    let name = if panel.heading.is_empty() { title.to_owned() } else { format!("{title}, {}", panel.heading) };
    let x = [panel.x.label.as_str(), shared, panel.heading.as_str(), "x"].into_iter().find(|x| !x.is_empty()).unwrap_or_default();
    match (&panel.content, &panel.y.names) {
        (Content::Lines(series), Some(names)) => named(&name, &panel.y.label, names, x, series),
        (Content::Lines(series), None) => lines(&name, &panel.y.label, x, series),
        (Content::Map(map), _) => cells(&name, &panel.y.label, x, map),
        (Content::Drawing(drawing), _) => areas(&name, [&panel.x.label, &panel.y.label], drawing),
    }
}

/// Series that share their x in one table.
fn lines(name: &str, y: &str, x: &str, series: &[Series]) -> Markup {
    // a single point marks one of another series, a guide has no data
    let shown = series.iter().filter(|s| s.count > 1 && s.style != Style::Guide);
    let (upright, mut rest): (Vec<&Series>, Vec<&Series>) = shown.partition(|s| is_upright(s));
    let mut groups = Vec::new();
    while let Some(first) = rest.first() {
        let alike = |s: &&Series| s.count == first.count && (0..s.count).all(|n| (s.at)(n).0.total_cmp(&(first.at)(n).0).is_eq());
        let (group, others): (Vec<&Series>, Vec<&Series>) = rest.iter().partition(|s| alike(s));
        let mut head = vec![x.to_owned()];
        for (n, s) in group.iter().enumerate() {
            // what has no name is the other half of what stands before it
            let same = group[..n].iter().zip(&head[1..]).rev().find(|(before, _)| before.style == s.style);
            let own = if s.name.is_empty() { same.map_or(y, |(_, name)| name) } else { &s.name };
            head.push(own.to_owned());
        }
        let count = group[0].count;
        let every = count.div_ceil(MOST_ROWS);
        let mut chosen: Vec<usize> = (0..count).step_by(every).chain([count - 1]).collect();
        for s in &group {
            let by = |a: &usize, b: &usize| (s.at)(*a).1.total_cmp(&(s.at)(*b).1);
            chosen.extend((0..count).filter(|_| every > 1).min_by(by));
            chosen.extend((0..count).filter(|_| every > 1).max_by(by));
        }
        chosen.sort_unstable();
        chosen.dedup();
        let row = |n: usize| {
            let values = group.iter().map(|s| number((s.at)(n).1));
            std::iter::once(number((group[0].at)(n).0)).chain(values).collect()
        };
        let rows: Vec<Vec<String>> = chosen.into_iter().map(row).collect();
        let which = if every > 1 { format!(" (one point in {every}, the last and the extremes)") } else { String::new() };
        groups.push(grid(&format!("{name}: {y}{which}"), Cells::Numbers, &head, &rows));
        rest = others;
    }
    if !upright.is_empty() {
        let rows: Vec<Vec<String>> = upright.iter().map(|s| [(s.at)(0).0, (s.at)(0).1, (s.at)(1).1].map(number).into()).collect();
        groups.push(grid(&format!("{name}: {y}, upright lines"), Cells::Numbers, &[x, "from", "to"], &rows));
    }
    html! { @for group in groups { (group) } }
}

/// Whether it is a line without a name from one value to another at the same place.
fn is_upright(series: &Series) -> bool {
    series.name.is_empty() && series.count == 2 && (series.at)(0).0.total_cmp(&(series.at)(1).0).is_eq()
}

/// A row for each name, a column for each series.
fn named(name: &str, y: &str, names: &[String], x: &str, series: &[Series]) -> Markup {
    let named: Vec<&Series> = series.iter().filter(|s| s.style.is_points()).collect();
    let head: Vec<&str> = [y].into_iter().chain(named.iter().map(|s| s.name.as_str())).collect();
    let of = |s: &&Series, k: usize| {
        (0..s.count).map(|n| (s.at)(n)).find(|(_, y)| *y == k as f64).map_or(String::new(), |(x, _)| number(x))
    };
    let row = |(k, own): (usize, &String)| std::iter::once(own.clone()).chain(named.iter().map(|s| of(s, k))).collect();
    let rows: Vec<Vec<String>> = names.iter().enumerate().map(row).collect();
    grid(&format!("{name}: {x}"), Cells::Numbers, &head, &rows)
}

/// A map's cells, its upper row first.
fn cells(name: &str, y: &str, x: &str, map: &HeatMap) -> Markup {
    let (columns, rows) = (map.columns.max(1), map.values.len() / map.columns.max(1));
    let [across, down] = [columns.div_ceil(MOST_CELLS[0]), rows.div_ceil(MOST_CELLS[1]).max(1)];
    let middle = |[low, high]: [f64; 2], k: usize, count: usize| low + (high - low) * (k as f64 + 0.5) / count as f64;
    let corner = format!("{y} \\ {x}");
    let chosen = || (0..columns).step_by(across);
    let head: Vec<String> = std::iter::once(corner).chain(chosen().map(|k| significant(middle(map.x, k, columns), 3))).collect();
    let row = |r: usize| {
        let cell = |k: usize| {
            let at = r * columns + k;
            let stands_out = if map.marked.contains(&at) { " *" } else { "" };
            if map.values[at].is_finite() { significant(map.values[at], 2) + stands_out } else { String::new() }
        };
        std::iter::once(significant(middle(map.y, r, rows), 3)).chain(chosen().map(cell)).collect()
    };
    let rows: Vec<Vec<String>> = (0..rows).step_by(down).map(row).rev().collect();
    let thinned = if across * down > 1 { format!(" (one row in {down}, one column in {across})") } else { String::new() };
    let marks = if map.marked.is_empty() { "" } else { "; * stands out" };
    let caption = format!("{name}: {}{thinned}{marks}", map.colours.label);
    grid(&caption, Cells::Numbers, &head, &rows)
}

/// The parts of a drawing.
fn areas(name: &str, [x, y]: [&str; 2], drawing: &Drawing) -> Markup {
    let ends = |[low, high]: [f64; 2]| format!("{low:.3} to {high:.3}");
    let named = drawing.areas.iter().filter(|area| !area.name.is_empty());
    let mut rows: Vec<Vec<String>> = named.map(|area| vec![area.name.clone(), ends(area.x), ends(area.y)]).collect();
    rows.extend(drawing.point.iter().map(|([x, y], name)| vec![name.clone(), format!("{x:.3}"), format!("{y:.3}")]));
    grid(&format!("{name}: {} mesh elements", drawing.mesh.len()), Cells::Numbers, &["part", x, y], &rows)
}

fn number(value: f64) -> String {
    match value {
        v if !v.is_finite() => String::new(),
        v if v.fract() == 0.0 && v.abs() < 1e6 => format!("{v:.0}"),
        v => significant(v, 4),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Intervals of units stand in one table, which names their ends.
    #[test]
    fn exact_upright_lines_are_rows_of_one_table() {
        let upright = |x: f64, low: f64, high: f64| Series::new("", Style::Fine(2), vec![(x, low), (x, high)]);
        let points = Series::new("passes", Style::Points(0), vec![(7.0, 2.0), (8.0, 3.0)]);
        let page = lines("Trend", "sensitivity", "serial number", &[upright(7.0, 1.5, 2.5), upright(8.0, 2.5, 3.5), points]);
        let upright = grid(
            "Trend: sensitivity, upright lines",
            Cells::Numbers,
            &["serial number", "from", "to"],
            &[["7", "1.500", "2.500"], ["8", "2.500", "3.500"]].map(|row| row.map(str::to_owned).into()),
        );
        let page = page.into_string();
        assert!(page.matches("<table").count() == 2 && page.contains(&upright.into_string()), "{page}");
    }
}
