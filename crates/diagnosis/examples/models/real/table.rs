//! Files of numbers in columns.

/// The columns of these names, of a text whose first line names them; fields are separated by `separator`. An empty field is NaN.
pub(crate) fn columns(text: &str, separator: char, wanted: &[&str]) -> Result<Vec<Vec<f64>>, String> {
    let mut lines = text.lines();
    let clean = |name: &str| name.trim_matches(['"', ' ', '\u{feff}']).to_owned();
    let names: Vec<String> = lines.next().unwrap_or_default().split(separator).map(clean).collect();
    let find = |name: &&str| names.iter().position(|n| n == name).ok_or(format!("line 1: there is no column {name}"));
    let places = wanted.iter().map(find).collect::<Result<Vec<_>, _>>()?;
    let mut columns = vec![Vec::new(); wanted.len()];
    for (n, line) in lines.enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let fields: Vec<&str> = line.split(separator).map(str::trim).collect();
        for (column, place) in columns.iter_mut().zip(&places) {
            let field = fields.get(*place).copied().unwrap_or_default();
            let number = if field.is_empty() { Ok(f64::NAN) } else { field.parse() };
            column.push(number.map_err(|_| format!("line {}: {} is `{field}`, not a number", n + 2, names[*place]))?);
        }
    }
    Ok(columns)
}

/// The same of a file.
pub(crate) fn read(path: &str, separator: char, wanted: &[&str]) -> Result<Vec<Vec<f64>>, String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{path}: {e}"))?;
    columns(&text, separator, wanted).map_err(|e| format!("{path}: {e}"))
}

/// Means of so many rows each; what is left at the end makes none.
pub(crate) fn means(series: &[f64], rows: usize) -> Vec<f64> {
    series.chunks_exact(rows.max(1)).map(|c| c.iter().sum::<f64>() / c.len() as f64).collect()
}

/// Medians of so many rows each, for series with stray values.
pub(crate) fn medians(series: &[f64], rows: usize) -> Vec<f64> {
    let median = |chunk: &[f64]| {
        let mut sorted = chunk.to_vec();
        sorted.sort_by(f64::total_cmp);
        (sorted[(sorted.len() - 1) / 2] + sorted[sorted.len() / 2]) / 2.0
    };
    series.chunks_exact(rows.max(1)).map(median).collect()
}
