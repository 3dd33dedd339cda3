//! The steady sensitivity over spools of other materials, mounted otherwise.

use charts::{Axis, Figure, Panel, Series, Style};
use maud::Markup;

use super::document::Document;

/// A coil on a spool.
#[derive(Debug, Clone, PartialEq)]
pub struct OnSpool {
    /// Material of the spool.
    pub material: String,
    /// Its flanges and bonds.
    pub mounting: String,
    /// Steady sensitivity \[(deg/h)/(degC/min)\].
    pub sensitivity: f64,
}

/// The comparison as a file; `printed` is a magnitude to hold it against, with its name.
pub fn spools(all: &[OnSpool], printed: (&str, f64)) -> Document {
    let figure = figure(all, printed);
    (figure.id, figure.document())
}

/// The comparison as an element of a page, with its data.
pub fn spools_element(all: &[OnSpool], printed: (&str, f64)) -> Markup {
    figure(all, printed).element()
}

fn figure<'a>(all: &[OnSpool], (name, printed): (&str, f64)) -> Figure<'a> {
    let distinct = |of: fn(&OnSpool) -> &String| {
        all.iter().map(of).fold(Vec::new(), |mut seen: Vec<String>, one| {
            if !seen.contains(one) {
                seen.push(one.clone());
            }
            seen
        })
    };
    let (materials, mut mountings) = (distinct(|s| &s.material), distinct(|s| &s.mounting));
    mountings.reverse();
    let row = |mounting: &String| mountings.iter().position(|m| m == mounting).unwrap_or_default() as f64;
    let most = mountings.len() as f64;
    let mut series = vec![Series::new(name, Style::Second, vec![(printed, -0.4), (printed, most - 0.2)])];
    for (kind, material) in materials.into_iter().enumerate() {
        let own = all.iter().filter(|s| s.material == material);
        let points = own.map(|s| (s.sensitivity.abs(), row(&s.mounting))).collect();
        series.push(Series::new(material, Style::Points(kind as u8), points));
    }
    Figure {
        id: "spools",
        title: "The reference coil on other spools".into(),
        description: format!(
            "Magnitude of the steady sensitivity for spools of {} mountings, a mark for each material, beside {name}.",
            mountings.len()
        ),
        caption: "Everything but the spool's material, flanges and bonds as in the reference design; numerical error about 0.001 \
                  (°/h)/(°C/min). The paper does not say which spool it has: that of the reference design was chosen to agree (calibrated)."
            .into(),
        columns: 1,
        panels: vec![Panel::lines(
            Axis::round("|S|, magnitude of the steady sensitivity [(°/h)/(°C/min)]", 0.1).covering([0.0, printed]),
            Axis::named("flanges and bonds of the spool", mountings),
            2.6 * most,
            series,
        )],
    }
}
