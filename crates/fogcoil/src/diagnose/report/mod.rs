//! A diagnosis as one page for an expert: verdict, recording, residuals before and after, where, which mechanism, proof, noise.

mod candidates;
mod course;
mod held_out;
mod next_test;
mod noise;
mod parameters;
mod place;
mod spectrum;
mod stages;

use charts::{Axis, facts, heading, nice, page, row, sections, significant};
use diagnosis::{Estimate, Fit, ForwardModel, HeldOut, Nuisance, Role, Verdict};
use files::Note;
use maud::{Markup, html};
use mechanisms::{Naming, RATE, SPOOL};

use super::apart::TOLD;
use super::{NOMINAL, Outcome, REFITTED, Record};
use crate::compose::StandIn;
use crate::report::provenance;
use crate::table::capital;
use crate::units::{DurationUnit, parameter_unit};

/// A fit beside the record that it is shown for.
#[derive(Clone, Copy)]
struct Shown<'a> {
    name: &'static str,
    fit: &'a Fit,
    /// Number of the record among those that were fitted.
    number: usize,
    record: &'a Record,
    /// The fit whose noise whitens.
    judge: &'a Fit,
}

impl Shown<'_> {
    fn whitened(&self, channel: usize) -> Vec<f64> {
        self.fit.whitened_residual(self.number, channel, &self.record.observed, self.judge).1
    }
}

/// Quantity shown for a channel.
#[derive(Clone, Copy)]
struct Quantity {
    channel: usize,
    /// Name with its unit.
    label: &'static str,
    name: &'static str,
    unit: &'static str,
    /// Least span that is drawn.
    least: f64,
}

const QUANTITIES: [Quantity; 2] = [
    Quantity { channel: RATE, label: "rate [°/h]", name: "rate", unit: "°/h", least: 1e-4 },
    Quantity { channel: SPOOL, label: "spool thermometer [°C]", name: "spool thermometer", unit: "K", least: 0.01 },
];

/// The time since the first row, in the unit of its axis.
struct Clock {
    unit: DurationUnit,
    start: f64,
    end: f64,
}

impl Clock {
    fn at(&self, time: f64) -> f64 {
        self.unit.of_seconds(time - self.start)
    }

    fn ends(&self) -> [f64; 2] {
        [0.0, self.at(self.end)]
    }

    fn axis(&self) -> Axis {
        Axis::tight(format!("time since the first row [{}]", self.unit.name), 1e-6)
    }
}

impl Outcome<'_> {
    /// A page that needs nothing but itself.
    pub fn report(&self) -> String {
        let mut parts = vec![
            ("Finding", html! { (self.finding()) (self.candidates()) (self.rivals()) (self.parameters()) (self.moved_table()) }),
            ("Recording and model", self.course()),
            ("Is what is left noise?", self.spectra()),
            ("Where the difference is", html! { (self.stages()) (self.place()) }),
        ];
        if !self.holdouts.is_empty() {
            parts.push(("Proof on a record that was held out", self.held_out()));
        }
        parts.extend([("The next test", self.next_test()), ("Noise", self.noise()), ("Limits", self.limits()), self.sources()]);
        let body = html! { (heading("In short")) (self.in_short()) (sections(&parts)) };
        let lead = html! {
            p { (nice(&self.verdict())) }
            @if let Some(sizes) = self.sizes() { p { "Fitted: " (sizes) "." } }
        };
        page(&format!("{}: what differs from the design", self.name), &lead, &body)
    }

    /// The design as drawn and, where it is another, what the answer rests on, for a record that was fitted.
    fn shown(&self, number: usize) -> Vec<Shown<'_>> {
        let best = self.leading();
        let of = |name, fit| Shown { name, fit, number, record: &self.fits[number], judge: best };
        match self.found() {
            None => vec![of(REFITTED, best)],
            Some(name) => vec![of(REFITTED, &self.diagnosis.mismatch), of(name, best)],
        }
    }

    /// The same for each of them.
    fn each(&self) -> impl Iterator<Item = Vec<Shown<'_>>> {
        (0..self.fits.len()).map(|number| self.shown(number))
    }

    /// Channels in which something was recorded.
    fn quantities(&self) -> impl Iterator<Item = Quantity> {
        let recorded = |q: &Quantity| self.fits.iter().any(|r| r.observed.channels[q.channel].iter().any(|v| v.is_finite()));
        QUANTITIES.into_iter().filter(recorded)
    }

    /// The time of a record, in the unit of the longest one's.
    fn clock(&self, record: &Record) -> Clock {
        let ends = |record: &Record| record.observed.time.first().zip(record.observed.time.last()).map(|(a, b)| [*a, *b]);
        let held = self.holdouts.iter().map(|held| &held.record);
        let longest = self.fits.iter().chain(held).filter_map(ends).fold(0.0_f64, |most, [a, b]| most.max(b - a));
        let [start, end] = ends(record).unwrap_or_default();
        Clock { unit: DurationUnit::of(longest), start, end }
    }

    /// The answer on one screen: what is left of the rate before and after, what it is, how to inspect it, how sure, and what next.
    fn in_short(&self) -> Markup {
        let explained = self.diagnosis.verdict == Verdict::Explained;
        let mut rows = Vec::new();
        let named = self.told_names();
        let best = self.diagnosis.best().fit.active.iter();
        for active in best.filter(|active| explained && named.contains(&self.id(active.mechanism))) {
            if let Naming::Named { meaning, inspection } = self.gyro.mechanism(active.mechanism).facts().naming {
                rows.extend([row(self.id(active.mechanism), nice(meaning)), row("inspect", nice(inspection))]);
            }
        }
        let law = self.law_name().or_else(|| self.in_place_of_all().map(StandIn::said));
        rows.extend(law.map(|law| row("it is like", nice(&law))));
        rows.extend(self.nearest_named().map(|nearest| row("nearest named", nice(&nearest))));
        for other in self.others() {
            rows.extend(self.inspection(other).map(|inspection| row("or inspect", format!("{}, for {other}", nice(inspection)))));
        }
        let likely = self.explanations().into_iter().filter(|e| e.open || e.probability >= TOLD);
        let sure: Vec<String> = likely.map(|e| format!("{} {:.2}", e.said(), e.probability)).collect();
        rows.push(row("how sure", format!("probability of {}", sure.join(", "))));
        rows.extend(self.late().map(|late| row("late", late)));
        rows.extend(self.held_in_short().map(|said| row("proof", said)));
        rows.push(row("next", self.alternatives().unwrap_or_else(|| capital(&self.next()))));
        html! { (self.before_and_after().element()) (facts("The answer in short", &rows)) }
    }

    /// Parameters of what was found, or of an accepted law, with their intervals.
    fn sizes(&self) -> Option<String> {
        let explained = self.diagnosis.verdict == Verdict::Explained && self.in_place_of_all().is_none();
        let mut found: Vec<Estimate> = self.diagnosis.parameters.iter().flatten().filter(|_| explained).cloned().collect();
        found.extend(self.law().into_iter().flat_map(|law| law.text().1));
        let of = |estimate: &Estimate| {
            let unit = parameter_unit(&estimate.name);
            let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
            let (value, [low, high]) = self.told(estimate, 3);
            format!("{} {value}{unit} (90 %: {low} to {high})", estimate.name)
        };
        (!found.is_empty()).then(|| nice(&found.iter().map(of).collect::<Vec<_>>().join("; ")))
    }

    /// Errors of the predictions of the record that was held out, of several the first.
    fn held_in_short(&self) -> Option<String> {
        let held = self.holdouts.first()?;
        let of = |prediction: &HeldOut| significant(prediction.rmse[RATE], 3);
        let model = self.fitted(held).map_or(String::new(), |name| format!(", of the {name} {}", of(&held.model)));
        let noise = significant(held.model.noise_floor[RATE], 3);
        Some(format!(
            "on {}, held out, the error of the {NOMINAL} is {}{model} °/h; its noise is {noise} °/h (rms)",
            held.record.name(),
            of(&held.nominal)
        ))
    }

    fn finding(&self) -> Markup {
        let d = &self.diagnosis;
        // what may make the rest void comes first
        let (warnings, notes): (Vec<&Note>, Vec<&Note>) = self.notes.iter().partition(|note| note.is_warning());
        let mut rows: Vec<_> = warnings.iter().map(|note| row("warning", note.message())).collect();
        let named = self.told_names();
        for (id, stage, extent) in self.places().filter(|(id, ..)| d.verdict == Verdict::Explained && named.contains(id)) {
            rows.push(row(id, nice(&super::text::place(stage, &extent))));
        }
        if let Some(alternatives) = self.alternatives() {
            rows.push(row("not told apart", format!("{alternatives} (see the next test)")));
        }
        rows.extend(self.doubts().iter().map(|doubt| row("doubt", nice(doubt))));
        rows.extend(self.late().map(|late| row("late", late)));
        if let Some(structure) = self.structure() {
            rows.push(row("structure", nice(&structure)));
        }
        if let Some(composed) = &self.composed {
            rows.push(row("composed law", nice(&composed.text().0)));
        }
        rows.extend(self.stand_ins.iter().filter_map(StandIn::text).map(|text| row("a law in its place", nice(&text))));
        rows.extend(self.fits.iter().map(|record| row("fitted", format!("{}, {}", record.name(), record.span()))));
        for held in &self.holdouts {
            rows.push(row("held out", format!("{}, {}", held.record.name(), held.record.span())));
        }
        if self.holdouts.is_empty() {
            rows.push(row("held out", "no record: what was fitted is not proven on data that it has not seen"));
        }
        rows.extend(notes.into_iter().map(|note| row("note", note.message())));
        facts("The finding", &rows)
    }

    fn limits(&self) -> Markup {
        let library: Vec<&str> = self.gyro.mechanisms().iter().map(|m| m.id.as_str()).collect();
        let errors: Vec<String> = self.gyro.nuisances().iter().filter(|n| n.role == Role::ModelError).map(sized).collect();
        let rows = [
            row("library", library.join(", ")),
            row(
                "probabilities",
                "posterior, with all that was compared counted in; they hold if the library and the priors do. A mechanism outside \
                 the library shows as structure that nothing explains",
            ),
            row("values", "fitted through the whole chain, most probable values with 90 % intervals; not measured"),
            row(
                "model errors allowed for",
                format!("{} (1σ); a constant offset of each channel is never a finding", errors.join(", ")),
            ),
        ];
        facts("Limits", &rows)
    }

    fn sources(&self) -> (&'static str, Markup) {
        let fitted = self.fits.iter().map(|record| ("fitted", &record.fingerprint));
        let held = self.holdouts.iter().map(|held| ("held out", &held.record.fingerprint));
        let design = self.design.iter().enumerate().map(|(n, file)| (if n == 0 { "coil" } else { "cell" }, file));
        let files: Vec<_> = design.chain(fitted).chain(held).collect();
        let settings = row("settings", "the program's own; what is known of the records: meta.ron beside each, or --meta");
        provenance("diagnose", &files, &[settings])
    }
}

/// A number of the nominal model with its uncertainty: of what has a unit in that, else relative.
fn sized(nuisance: &Nuisance) -> String {
    let name = nuisance.parameter.name.trim_end_matches(" (model)");
    let spread = nuisance.parameter.prior.sd();
    match name.strip_suffix(" [K]") {
        Some(name) => format!("{name} {} K", significant(spread, 2)),
        None => format!("{name} {} %", significant(100.0 * spread, 1)),
    }
}

impl Record {
    /// Duration and number of rows.
    fn span(&self) -> String {
        let time = &self.observed.time;
        let seconds = time.first().zip(time.last()).map_or(0.0, |(a, b)| b - a);
        let unit = DurationUnit::of(seconds);
        format!("{} rows over {:.1} {}", time.len(), unit.of_seconds(seconds), unit.name)
    }
}
