//! What each turn adds to the bias of a steady ramp, over the cross-section.

use bias::Bias;
use bias::units::{DEG_PER_H_PER_RAD_PER_S, K_PER_MIN_PER_K_PER_S};
use charts::{Axis, Colours, Figure, HeatMap, Height, Panel, signed};
use coil::{Drive, ThermalState, TurnFields};
use winding::Winding;

use super::document::MOST_TURNS;
use crate::simulate::Simulation;
use crate::units::to_mm;

/// Most cells of a map along the axis and across the layers.
const MOST_CELLS: [usize; 2] = [440, 80];
/// Layers and turns of a block: four layers are the period of a quadrupole, within which the weights nearly cancel.
const BLOCK: usize = 4;
/// Smallest scale \[(°/h)/(°C/min)\].
const LEAST: f64 = 1e-9;

/// A cell that would hold less than this part of its width is none.
const SLACK: f64 = 1e-6;

type Part = fn(&Bias) -> f64;

/// What each turn adds to the steady sensitivity, in the winding's order \[(°/h)/(°C/min)\]; tails left out.
///
/// # Errors
/// [`bias::Error`] if an optical constant is out of range, with which no coil could have been simulated.
pub fn contributions_in_ramp(simulation: &Simulation, fields: &TurnFields) -> Result<Vec<Bias>, bias::Error> {
    let (case, winding) = (simulation.case, &simulation.case.winding);
    let coefficients = case.design.optics.coefficients(winding.length())?;
    // every wall and mount warms by 1 K/s, the heaters stay as they are
    let drives: Vec<f64> = simulation.profile.drives.iter().map(|d| f64::from(u8::from(*d != Drive::Heaters))).collect();
    let amplitudes = vec![0.0; fields.temperature.ncols() - drives.len()];
    let rates = fields.at(&ThermalState { drives, amplitudes });
    let unit = DEG_PER_H_PER_RAD_PER_S / K_PER_MIN_PER_K_PER_S;
    let of = |(i, w): (usize, f64)| coefficients.bias(w, rates.temperature[i], rates.axial[i], rates.radial[i]) * unit;
    Ok(winding.weights().into_iter().enumerate().map(of).collect())
}

pub(super) fn figure<'a>(simulation: &'a Simulation, fields: &TurnFields) -> Option<Figure<'a>> {
    let winding = &simulation.case.winding;
    if winding.turns().len() > MOST_TURNS {
        return None;
    }
    let contributions = contributions_in_ramp(simulation, fields).ok()?;
    let parts: [(&str, Part); 4] = [
        ("total", Bias::total),
        ("Shupe", |b| b.shupe),
        ("elasto-optic, axial strain", |b| b.eo_axial),
        ("elasto-optic, radial strain", |b| b.eo_radial),
    ];
    let mut columns = Vec::new();
    let block = format!("sum over blocks of {BLOCK} layers by {BLOCK} turns");
    for (what, sum) in [("each turn", false), (block.as_str(), true)] {
        let maps = parts.map(|(_, part)| cells(winding, &contributions.iter().map(part).collect::<Vec<f64>>(), sum));
        let most = maps.iter().flat_map(|map| &map.values).filter(|v| v.is_finite()).fold(0.0, |most: f64, v| most.max(v.abs()));
        columns.push((Colours::diverging(format!("{what} [(°/h)/(°C/min)]"), most, LEAST), maps));
    }
    let mut panels: Vec<Panel> = Vec::new();
    for (k, (name, part)) in parts.into_iter().enumerate() {
        let sum: f64 = contributions.iter().map(part).sum();
        let headings = [format!("{name}: sum {}", signed(sum, 3)), format!("{name}, in blocks")];
        for ((colours, maps), heading) in columns.iter().zip(headings) {
            let Cells { columns, values, y, r } = maps[k].clone();
            let (x, y, colours) = (y.map(to_mm), r.map(to_mm), colours.clone());
            let map = HeatMap { columns, values, x, y, colours, bar: k == 0, marked: Vec::new() };
            let [axial, radial] = ["axial position y [mm]", "radius r [mm]"].map(|label| Axis::tight(label, 1e-6));
            panels.push(Panel::map(axial, radial, Height::ToScale(20.0), map).headed(heading));
        }
    }
    Some(Figure {
        id: "contributions",
        title: "Where the bias of a steady ramp comes from".into(),
        description:
            "Heat maps over the coil's cross-section of what each turn, and each block of turns, adds to the bias in a steady \
                      ramp: total, Shupe, and elasto-optic from axial and radial strain."
                .into(),
        caption: format!(
            "Bias per temperature rate in a steady ramp, at its place in the cross-section. Of each turn: the two halves of the fibre have \
             opposite signs and nearly all of it cancels. In blocks: summed over {BLOCK} layers by {BLOCK} turns, where most of it has \
             cancelled; what is left adds up to the sum given. One scale for all maps of turns, one for all of blocks."
        ),
        columns: 2,
        panels,
    })
}

/// Values over the cross-section.
#[derive(Clone)]
struct Cells {
    columns: usize,
    /// Row by row from the inside.
    values: Vec<f64>,
    /// Ends along the axis \[m\].
    y: [f64; 2],
    /// Lower end of the first row, upper end of the last \[m\].
    r: [f64; 2],
}

/// Means over cells of half a pitch by a layer, larger where there are too many, or sums over blocks.
fn cells(winding: &Winding, values: &[f64], blocks: bool) -> Cells {
    let spec = winding.spec();
    let (height, pitch) = (winding.height(), spec.pitch);
    let (width, most_rows) =
        if blocks { (BLOCK as f64 * pitch, spec.layers.div_ceil(BLOCK)) } else { (pitch / 2.0, spec.layers) };
    let columns = ((height / width - SLACK).ceil().max(1.0) as usize).min(MOST_CELLS[0]);
    let width = width.max(height / columns as f64);
    let rows = most_rows.clamp(1, MOST_CELLS[1]);
    let layers_of_row = spec.layers.div_ceil(rows);
    let rows = spec.layers.div_ceil(layers_of_row);
    let (mut sums, mut counts) = (vec![0.0; rows * columns], vec![0.0; rows * columns]);
    for (turn, value) in winding.turns().iter().zip(values) {
        let row = (turn.layer - 1) / layers_of_row * columns;
        let (first, end) = if blocks {
            // a quarter of a pitch puts both kinds of layers well inside
            let column = (((turn.y - pitch / 4.0) / width).max(0.0) as usize).min(columns - 1);
            (column, column + 1)
        } else {
            let [first, end] = [-0.5, 0.5].map(|half| (((turn.y + half * pitch) / width).round().max(0.0) as usize).min(columns));
            (first.min(columns - 1), end.max(first + 1).min(columns))
        };
        for column in first..end {
            sums[row + column] += value;
            counts[row + column] += 1.0;
        }
    }
    // a place without a turn is 0/0, not a number
    let cell = |(sum, count): (&f64, &f64)| if blocks && *count > 0.0 { *sum } else { sum / count };
    let end = columns as f64 * width;
    let values = sums.iter().zip(&counts).map(cell).collect();
    let step = 3_f64.sqrt() / 2.0 * pitch;
    let lower = spec.inner_radius + (pitch - step) / 2.0;
    Cells { columns, values, y: [0.0, end], r: [lower, lower + (rows * layers_of_row) as f64 * step] }
}
