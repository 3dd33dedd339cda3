//! Contribution of each turn to the bias of a steady ramp, over the cross-section.

use bias::Bias;
use bias::units::K_PER_MIN_PER_K_PER_S;
use charts::{Axis, Colours, Figure, HeatMap, Height, Panel};
use coil::{Drive, ThermalState, TurnFields};

use super::blocks::{BLOCK, Cells, cells};
use super::document::MOST_TURNS;
use crate::simulate::Simulation;
use crate::turn_bias::{Contributions, OF_TAILS};
use crate::units::to_mm;

/// Smallest scale \[(°/h)/(°C/min)\].
const LEAST: f64 = 1e-9;

type Part = fn(&Bias) -> f64;

/// Contributions to the steady sensitivity \[(°/h)/(°C/min)\].
///
/// # Errors
/// [`bias::Error`] if an optical constant is out of range; no coil with it can be simulated.
pub fn contributions_in_ramp(simulation: &Simulation, fields: &TurnFields) -> Result<Contributions, bias::Error> {
    // every wall and mount warms by 1 K/s, the heaters stay as they are
    let drives: Vec<f64> = simulation.profile.drives.iter().map(|d| f64::from(u8::from(*d != Drive::Heaters))).collect();
    let amplitudes = vec![0.0; fields.temperature.ncols() - drives.len()];
    let per_rate = Contributions::of(simulation.case, fields, &ThermalState { drives, amplitudes })?;
    Ok(per_rate.scaled(1.0 / K_PER_MIN_PER_K_PER_S))
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
    let block = format!("each block of {BLOCK} × {BLOCK} turns");
    for (what, sum) in [("each turn", false), (block.as_str(), true)] {
        let maps = parts.map(|(_, part)| cells(winding, &contributions.part(part), sum));
        let most = maps.iter().flat_map(|map| &map.values).filter(|v| v.is_finite()).fold(0.0, |most: f64, v| most.max(v.abs()));
        columns.push((Colours::diverging(format!("{what} [(°/h)/(°C/min)]"), most, LEAST), maps));
    }
    let mut panels: Vec<Panel> = Vec::new();
    for (k, (name, part)) in parts.into_iter().enumerate() {
        let headings = [format!("{name}: {}", contributions.sum(part).apart(3)), format!("{name}, in blocks")];
        for ((colours, maps), heading) in columns.iter().zip(headings) {
            let Cells { columns, values, y, r } = maps[k].clone();
            let (x, y, colours) = (y.map(to_mm), r.map(to_mm), colours.clone());
            let map = HeatMap { columns, values, x, y, colours, bar: k == 0, marked: Vec::new(), outlines: Vec::new() };
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
             opposite signs and nearly all of it cancels. In blocks: summed over {BLOCK} layers by about {BLOCK} turns, where most of it has \
             cancelled; what is left adds up to the sum given of the turns. Bare tails lie outside the cross-section. {OF_TAILS} One scale for all maps of turns, one for all of blocks."
        ),
        columns: 2,
        panels,
    })
}
