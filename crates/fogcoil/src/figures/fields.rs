//! Temperature and strain along the fibre, in time and at chosen instants (Figs. 4 to 6).

use charts::{Axis, Colours, Figure, HeatMap, Height, Panel, Series, Style};
use coil::{Mechanics, ThermalState, TurnFields, TurnValues};
use winding::Winding;

use super::course::time_axis;
use super::document::MOST_TURNS;
use super::instants::{Chosen, Instants};
use crate::simulate::{Sample, Simulation};
use crate::units::to_ppm;

/// Stretches of fibre in a map: a few for each layer, but no more than the paper shows.
const STRETCHES: usize = 180;
/// Smallest spans that are drawn.
const LEAST_K: f64 = 1e-3;
const LEAST_STRAIN: f64 = 0.1;

/// A quantity at every turn, in the unit of its axis.
type Field = fn(&At) -> Vec<f64>;

/// Values at every turn at one instant.
struct At {
    /// Strains are counted from the first row.
    values: TurnValues,
    /// Mean temperature of the fibre \[°C\].
    mean: f64,
}

/// Figures of temperature, radial and axial strain; none for a course without duration or a coil of too many turns.
pub(super) fn all<'a>(simulation: &'a Simulation, fields: &TurnFields) -> Vec<Figure<'a>> {
    let winding = &simulation.case.winding;
    if simulation.samples.is_empty() || winding.turns().len() > MOST_TURNS {
        return Vec::new();
    }
    let course = Course::of(simulation, fields);
    let state = match simulation.case.design.mechanics {
        Mechanics::Elastic => "",
        _ => " The mechanics change in time; these are the strains of the nominal state.",
    };
    let instants = "Below: along the fibre at chosen instants; the pattern repeats from layer to layer.";
    let temperature = Words {
        id: "temperature-along-fibre",
        title: "Temperature along the fibre",
        quantity: "temperature less the fibre's mean [K]",
        absolute: Some("fibre's mean temperature [°C]"),
        caption: format!(
            "Deviation of each turn from the fibre's mean, which is drawn above: a rate that all turns share drops out of the Shupe \
             bias. {instants} Counterpart of Osunluk et al., Fig. 4."
        ),
        field: |at| at.values.temperature.iter().map(|t| t - at.mean).collect(),
        least: LEAST_K,
    };
    let strain = |id, title, quantity, along: &str, number: u8, field: Field| {
        let caption = format!(
            "Strain of the glass at the centre of each turn since the first row.{state} {along} {instants} Counterpart of the paper's \
             Fig. {number}."
        );
        Words { id, title, quantity, absolute: None, caption, field, least: LEAST_STRAIN }
    };
    let radial = strain(
        "radial-strain-along-fibre",
        "Radial strain of the glass along the fibre",
        "radial strain [10⁻⁶]",
        "Dehomogenised, across the fibre.",
        5,
        |at| at.values.radial.iter().copied().map(to_ppm).collect(),
    );
    let axial = strain(
        "axial-strain-along-fibre",
        "Axial strain of the glass along the fibre",
        "axial strain [10⁻⁶]",
        "Along the fibre: the coil's hoop strain.",
        6,
        |at| at.values.axial.iter().copied().map(to_ppm).collect(),
    );
    [temperature, radial, axial].map(|words| course.figure(simulation, words)).into()
}

/// A quantity and its description.
struct Words {
    id: &'static str,
    title: &'static str,
    quantity: &'static str,
    /// Label of the mean temperature, where that is drawn too.
    absolute: Option<&'static str>,
    caption: String,
    field: Field,
    /// Smallest span that is drawn.
    least: f64,
}

/// The samples of a simulation with the fields of the turns.
struct Course<'a> {
    winding: &'a Winding,
    fields: &'a TurnFields,
    samples: &'a [Sample],
    /// Drives at rest, from which strains are counted.
    rest: Vec<f64>,
    instants: Instants,
}

impl<'a> Course<'a> {
    fn of(simulation: &'a Simulation, fields: &'a TurnFields) -> Self {
        let winding = &simulation.case.winding;
        let samples = &simulation.samples;
        Self {
            winding,
            fields,
            samples,
            rest: simulation.profile.profile.rest(&simulation.profile.drives),
            instants: Instants::of(simulation, fields),
        }
    }

    fn at(&self, sample: usize) -> At {
        let Sample { state, .. } = &self.samples[sample];
        let since = state.drives.iter().zip(&self.rest).map(|(u, rest)| u - rest).collect();
        let mut values = self.fields.at(&ThermalState { drives: since, ..state.clone() });
        // temperatures count from 0 °C
        values.temperature = self.fields.at(state).temperature;
        At { values, mean: self.instants.means[sample] }
    }

    /// Means over stretches of fibre, a column for each sample.
    fn map(&self, field: Field) -> Vec<f64> {
        let (turns, length) = (self.winding.turns(), self.winding.length());
        let layers = self.winding.spec().layers.max(1);
        let rows = (STRETCHES / layers * layers).clamp(STRETCHES / 2, STRETCHES).min(turns.len());
        let row_of: Vec<usize> =
            turns.iter().map(|t| (((t.z_start + t.z_end) / 2.0 / length * rows as f64) as usize).min(rows - 1)).collect();
        let mut count = vec![0.0; rows];
        row_of.iter().for_each(|row| count[*row] += 1.0);
        let columns = self.samples.len();
        let mut values = vec![0.0; rows * columns];
        for column in 0..columns {
            for (value, row) in field(&self.at(column)).iter().zip(&row_of) {
                values[row * columns + column] += value / count[*row];
            }
        }
        // a stretch without a turn is a tail
        for row in (0..rows).filter(|row| count[*row] == 0.0) {
            values[row * columns..(row + 1) * columns].fill(f64::NAN);
        }
        values
    }

    fn figure<'b>(&self, simulation: &'b Simulation, words: Words) -> Figure<'b> {
        let (x, time) = time_axis(simulation);
        let length = self.winding.length();
        let ends = [simulation.row(0).time, simulation.row(simulation.count() - 1).time].map(time);
        let values = self.map(words.field);
        let range =
            values.iter().filter(|v| v.is_finite()).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(*v), b.max(*v)]);
        let mut panels = Vec::new();
        if let Some(label) = words.absolute {
            let points = self.samples.iter().zip(&self.instants.means).map(|(s, mean)| (time(s.time), *mean)).collect();
            let unlabelled = Axis::tight("", x.least_span).covering(ends);
            panels.push(Panel::lines(unlabelled, Axis::round(label, 0.1), 7.0, vec![Series::new("", Style::First, points)]));
        }
        let map = HeatMap {
            columns: self.samples.len(),
            values,
            x: ends,
            y: [0.0, length],
            colours: Colours::of(words.quantity, range, words.least),
            bar: true,
            marked: Vec::new(),
            outlines: Vec::new(),
        };
        let along = Axis::tight("place along the fibre z [m]", 1e-6);
        panels.push(Panel::map(x, along.clone(), Height::Lines(18.0), map));
        let curves = self.instants.chosen.iter().map(|chosen| self.curve(simulation, *chosen, words.field)).collect();
        panels.push(Panel::lines(along.covering([0.0, length]), Axis::round(words.quantity, words.least), 18.0, curves));
        Figure {
            id: words.id,
            title: words.title.into(),
            description: format!(
                "Heat map of the {} over time and place along the fibre, and curves at chosen instants.",
                words.quantity
            ),
            caption: words.caption,
            columns: 1,
            panels,
        }
    }

    fn curve<'b>(&self, simulation: &Simulation, chosen: Chosen, field: Field) -> Series<'b> {
        let at = self.at(chosen.sample);
        let values = field(&at);
        let places = self.winding.turns().iter().map(|t| (t.z_start + t.z_end) / 2.0);
        let [since, mean] = self.instants.when(simulation, chosen);
        let name = format!("{}, after {since}, mean {mean}", chosen.what);
        Series::new(name, Style::Fine(chosen.kind), places.zip(values).collect())
    }
}
