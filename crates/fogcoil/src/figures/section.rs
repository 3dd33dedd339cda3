//! The coil's section: temperature, strain, displacement and contribution to the bias over (r, y), at instants and over time.

use charts::{Axis, Colours, Figure, HeatMap, Height, Panel};
use coil::Mechanics;

use super::course::time_axis;
use super::document::MOST_TURNS;
use super::instants::{Chosen, Instants};
use super::section_maps::{Kind, Maps, QUANTITIES, Raster};
use crate::simulate::{Fields, Simulation};
use crate::units::to_mm;

/// One sample in so many is a column of the strips over time: more would make the page half as large again.
const EVERY: usize = 2;

/// Maps at the chosen instants, and strips over time; none for a course without duration or a coil of too many turns.
pub(super) fn all<'a>(simulation: &'a Simulation, fields: &Fields) -> Vec<Figure<'a>> {
    if simulation.samples.is_empty() || simulation.case.winding.turns().len() > MOST_TURNS {
        return Vec::new();
    }
    let instants = Instants::of(simulation, &fields.turns);
    // a design that was simulated has a layout and a mesh
    let Ok(raster) = Raster::new(simulation, fields, &instants) else { return Vec::new() };
    let at = |samples: &mut dyn Iterator<Item = usize>| samples.map(|sample| raster.at(sample)).collect::<Result<Vec<Maps>, _>>();
    let chosen = at(&mut instants.chosen.iter().map(|chosen| chosen.sample));
    let course = at(&mut (0..simulation.samples.len()).step_by(EVERY));
    // a coil that was simulated has optical constants in their range
    let (Ok(chosen), Ok(course)) = (chosen, course) else { return Vec::new() };
    vec![at_instants(simulation, &raster, &instants, &chosen), in_time(simulation, &raster, &course)]
}

fn ends(values: &[f64]) -> [f64; 2] {
    values.iter().filter(|v| v.is_finite()).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(*v), b.max(*v)])
}

fn state(simulation: &Simulation) -> &'static str {
    match simulation.case.design.mechanics {
        Mechanics::Elastic => "",
        _ => " The mechanics change in time; these are the fields of the nominal state.",
    }
}

fn at_instants<'a>(simulation: &'a Simulation, raster: &Raster, instants: &Instants, maps: &[Maps]) -> Figure<'a> {
    let [y, r] = raster.ends_mm();
    let mut panels = Vec::new();
    for (k, quantity) in QUANTITIES.iter().enumerate() {
        for (chosen, at) in instants.chosen.iter().zip(maps) {
            let heading = match (k, &quantity.kind) {
                (0, _) => format!("{}, {}", chosen.what, instants.when(simulation, *chosen).join(", ")),
                (_, Kind::Bias) => format!("{}: {} °/h", chosen.what, at.bias.whole(4)),
                _ => chosen.what.to_owned(),
            };
            let colours = Colours::of(quantity.label, ends(&at.values[k]), quantity.least);
            let map = HeatMap {
                columns: raster.count[0],
                values: at.values[k].clone(),
                x: y,
                y: r,
                colours,
                bar: true,
                marked: Vec::new(),
                outlines: vec![raster.coil_mm()],
            };
            let [axial, radial] = ["axial position y [mm]", "radius r [mm]"].map(|label| Axis::tight(label, 1e-6));
            panels.push(Panel::map(axial, radial, Height::ToScale(14.0), map).headed(heading));
        }
    }
    let sum = |(chosen, at): (&Chosen, &Maps)| format!("{}: {} °/h", chosen.what, at.bias.apart(4));
    let sums: Vec<String> = instants.chosen.iter().zip(maps).map(sum).collect();
    Figure {
        id: "section",
        title: "The coil's section".into(),
        description: "Maps over the cross-section of coil and spool: temperature, hoop strain, radial strain of the glass, radial \
                      displacement and contribution to the bias, at the instants of fastest warming, largest change of temperature and fastest cooling."
            .into(),
        caption: format!(
            "Coil, hub and flanges, the coil outlined, each map with a scale of its own; above the first maps the time since the first row and the fibre's mean \
             temperature. Strains and displacements are those since the first row. In the coil the \
             hoop strain is the glass's axial strain. The bias is that of the instant, summed over blocks of 4 layers by about 4 turns, in \
             which most of it cancels; {}. A scale of one sign is dark at the least magnitude and bright at the largest.{}",
            sums.join("; "),
            state(simulation)
        ),
        columns: instants.chosen.len(),
        panels,
    }
}

fn in_time<'a>(simulation: &'a Simulation, raster: &Raster, maps: &[Maps]) -> Figure<'a> {
    let (_, time) = time_axis(simulation);
    let x = [simulation.row(0).time, simulation.row(simulation.count() - 1).time].map(time);
    let mut panels = Vec::new();
    for (k, quantity) in QUANTITIES.iter().enumerate() {
        let courses: Vec<[Vec<f64>; 2]> = maps.iter().map(|at| strips(raster, at, k, &quantity.kind)).collect();
        let [y, r] = match quantity.kind {
            Kind::Point(_) => raster.ends_mm(),
            Kind::Bias => [maps[0].blocks.y, maps[0].blocks.r].map(|ends| ends.map(to_mm)),
        };
        for (side, (label, ends_of)) in [("radius r [mm]", r), ("axial position y [mm]", y)].into_iter().enumerate() {
            let rows = courses[0][side].len();
            let values: Vec<f64> = (0..rows).flat_map(|row| courses.iter().map(move |course| course[side][row])).collect();
            let what = match (&quantity.kind, side) {
                (Kind::Bias, 0) => "bias of each four layers [°/h]",
                (Kind::Bias, _) => "bias of each four turns along y [°/h]",
                _ => quantity.label,
            };
            let colours = Colours::of(what, ends(&values), quantity.least);
            let map = HeatMap {
                columns: courses.len(),
                values,
                x,
                y: ends_of,
                colours,
                bar: true,
                marked: Vec::new(),
                outlines: Vec::new(),
            };
            let heading = format!("{}, {}", quantity.name, ["along the radius", "along the axis"][side]);
            panels.push(Panel::map(time_axis(simulation).0, Axis::tight(label, 1e-6), Height::Lines(9.0), map).headed(heading));
        }
    }
    Figure {
        id: "section-in-time",
        title: "The coil's section in time".into(),
        description:
            "Heat maps over time and radius, and over time and axial position, of temperature, hoop strain, radial strain of the \
                      glass, radial displacement and contribution to the bias."
                .into(),
        caption: format!(
            "Along the radius: means over the coil's height, or the bias of each four layers. Along the axis: means over the coil's layers, \
             or the bias of each four turns side by side, all layers together. The bias of a map's column adds up to that of the instant, \
             tails left out.{}",
            state(simulation)
        ),
        columns: 2,
        panels,
    }
}

/// A field along the radius and along the axis: means of a point's, sums of the turns'.
fn strips(raster: &Raster, maps: &Maps, k: usize, kind: &Kind) -> [Vec<f64>; 2] {
    match kind {
        Kind::Point(_) => raster.profiles(&maps.values[k]),
        Kind::Bias => {
            let (values, columns) = (&maps.blocks.values, maps.blocks.columns);
            let finite = |v: &&f64| v.is_finite();
            let rows = values.chunks(columns).map(|row| row.iter().filter(finite).sum()).collect();
            let sums = (0..columns).map(|c| values.iter().skip(c).step_by(columns).filter(finite).sum()).collect();
            [rows, sums]
        }
    }
}
