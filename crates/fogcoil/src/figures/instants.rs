//! Instants of a course at which fields are drawn.

use charts::signed;
use coil::TurnFields;

use crate::simulate::{Sample, Simulation};
use crate::units::DurationUnit;

/// The fibre's mean temperature over a course, and the instants that tell most.
pub(super) struct Instants {
    /// Mean temperature at each sample \[°C\].
    pub(super) means: Vec<f64>,
    /// Samples of which curves and maps are drawn, in order of time.
    pub(super) chosen: Vec<Chosen>,
}

/// A sample of which a curve or a map is drawn.
#[derive(Clone, Copy)]
pub(super) struct Chosen {
    pub(super) sample: usize,
    /// Its colour: 0 warming, 1 farthest from the start, 2 cooling.
    pub(super) kind: u8,
    /// The event.
    pub(super) what: &'static str,
}

impl Instants {
    pub(super) fn of(simulation: &Simulation, turns: &TurnFields) -> Self {
        let winding = &simulation.case.winding;
        let shares: Vec<f64> = winding.turns().iter().map(|t| (t.z_end - t.z_start) / winding.wound_length()).collect();
        let mean_of_column = |j: usize| turns.temperature.column(j).iter().zip(&shares).map(|(t, share)| t * share).sum::<f64>();
        let mean_of: Vec<f64> = (0..turns.temperature.ncols()).map(mean_of_column).collect();
        let mean = |sample: &Sample| sample.state.vector().iter().zip(&mean_of).map(|(a, b)| a * b).sum::<f64>();
        let means: Vec<f64> = simulation.samples.iter().map(mean).collect();
        let chosen = chosen(&simulation.samples, &means);
        Self { means, chosen }
    }

    /// Time of a chosen instant since the first row, and the fibre's mean temperature then.
    pub(super) fn when(&self, simulation: &Simulation, chosen: Chosen) -> [String; 2] {
        let unit = DurationUnit::of(simulation.duration());
        let since = unit.of_seconds(simulation.samples[chosen.sample].time - simulation.row(0).time);
        [format!("{since:.2} {}", unit.name), format!("{} °C", signed(self.means[chosen.sample], 1))]
    }
}

/// The samples of fastest warming, largest change of temperature since the first and fastest cooling, each once.
fn chosen(samples: &[Sample], means: &[f64]) -> Vec<Chosen> {
    let rate = |i: &usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(samples.len() - 1));
        let dt = samples[b].time - samples[a].time;
        if dt > 0.0 { (means[b] - means[a]) / dt } else { 0.0 }
    };
    let best = |value: &dyn Fn(&usize) -> f64| (0..samples.len()).max_by(|a, b| value(a).total_cmp(&value(b)));
    // at the first temperature there is nothing to see, though it may be the warmest
    let change = |i: usize| means[i] - means[0];
    let farthest = best(&|i| change(*i).abs());
    let extreme = if farthest.is_some_and(|i| change(i) < 0.0) { "coldest" } else { "warmest" };
    let all = [(1, farthest, extreme), (0, best(&rate), "fastest warming"), (2, best(&|i| -rate(i)), "fastest cooling")];
    let mut chosen: Vec<Chosen> =
        all.into_iter().filter_map(|(kind, sample, what)| Some(Chosen { sample: sample?, kind, what })).collect();
    chosen.sort_by_key(|c| c.sample);
    chosen.dedup_by_key(|c| c.sample);
    chosen
}
