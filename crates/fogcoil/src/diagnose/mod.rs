//! `fogcoil diagnose`: recordings of a unit in; what differs from its design, and what most likely causes it, out.

mod absolute;
mod alike;
mod apart;
mod as_drawn;
mod columns;
mod constants;
mod doubts;
mod drawing;
mod extended;
mod ignored;
mod in_rows;
mod json;
mod jumped;
mod left;
mod lines;
mod loose;
mod next;
mod report;
mod structure;
mod text;
mod told;
mod weighed;
mod written;

pub use weighed::of_columns;
pub use written::Written;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use diagnosis::{
    Candidate, Contradiction, Diagnosis, Fit, ForwardModel, HeldOut, Hypothesis, Judged, Judgement, Observation, Ruling,
    Settings, Verdict,
};
use files::{Note, Remark, shown, shown_path};
use mechanisms::{CATALOGUE, Extent, Gyro, Library, Mechanism, RATE as RATE_CHANNEL, SPOOL as SPOOL_CHANNEL};
use progress::Step;
use recording::Seconds;

use self::as_drawn::rms;
use crate::Error;
use crate::cache::Cache;
use crate::compose::{Composed, Sought, StandIn, compose};
use crate::input::{CoilCase, Fingerprint, InputError, MechanismCase, RecordCase};
use crate::left::Left;
use crate::prepare::{Record, chamber_offset, gyro, library, other_design, ready, refuse_copies};
use crate::table::significant;

/// A diagnosis with what it was made from.
pub struct Outcome<'m> {
    name: String,
    coil: PathBuf,
    design: Vec<Fingerprint>,
    /// about the constants that the records speak for
    gyro: Gyro<'m>,
    /// about the drawing
    library: Library,
    /// the next test, in a sentence, and whether one tells apart what it should, once it was worked out
    sought: OnceLock<(String, bool)>,
    /// what it was asked for
    mechanisms: Vec<&'m dyn Mechanism>,
    /// ids of those that nobody asked for: each is a column's
    of_columns: BTreeSet<String>,
    diagnosis: Diagnosis,
    /// a law for what is unknown, if one gains enough
    composed: Option<Composed>,
    /// laws in the place of what is named
    stand_ins: Vec<StandIn>,
    fits: Vec<Record>,
    /// residuals of each of them, by channel and row, by the design as drawn
    by_design: Vec<Vec<Vec<f64>>>,
    holdouts: Vec<Held>,
    /// mechanisms that a record held out took back, with their probabilities by what was fitted
    withdrawn: Vec<(usize, f64)>,
    /// the word of the drawing that may be another
    other_drawing: Option<String>,
    /// the column that the rate follows and the model of the coil does not use
    follows_column: Option<String>,
    /// whether the design is a lot's already
    is_lots: bool,
    notes: Vec<Note>,
}

/// A record that was held out: what the nominal and the extended model predict of it.
struct Held {
    record: Record,
    nominal: HeldOut,
    model: HeldOut,
    accepted: bool,
}

impl Held {
    /// The prediction by what a verdict says: the nominal model's where it is no better, or where what was found was `taken_back`.
    fn answer(&self, verdict: Verdict, taken_back: bool) -> &HeldOut {
        let is_found = matches!(verdict, Verdict::Explained | Verdict::Recalibrate);
        if is_found || self.accepted && !taken_back { &self.model } else { &self.nominal }
    }
}

/// Diagnoses a unit of the design `case` from the records `fits`, in whichever order, judged on `holdouts`, as far as `mechanisms` go: [`mechanisms::CATALOGUE`], or more,
/// and the records' `columns` that nothing reads, by [`of_columns`].
///
/// `progress` is told each task as it begins; of one that can be counted again and again.
///
/// # Errors
/// [`files::Error::Input`] names the record that cannot be used and why; [`files::Error::Coil`] if the design cannot be modelled.
pub fn diagnose<'m>(
    case: &CoilCase,
    mechanisms: &[&'m dyn Mechanism],
    columns: &'m [MechanismCase],
    fits: &[RecordCase],
    holdouts: &[RecordCase],
    cache: &Cache,
    progress: &(dyn Fn(Step) + Sync),
) -> Result<Outcome<'m>, Error> {
    let coil = Error::of_coil(&case.file);
    // by name: searches round as their sums do, and the order in which records are given says nothing
    let mut fits: Vec<&RecordCase> = fits.iter().collect();
    fits.sort_by(|a, b| a.fingerprint.file.cmp(&b.fingerprint.file));
    let all = || fits.iter().copied().chain(holdouts);
    refuse_copies(all())?;
    let mut notes: Vec<Note> = all().filter_map(|record| other_design(case, record)).collect();
    progress(Step::begins("lines in the rate"));
    let (without_lines, of_lines) = lines::taken_off(all());
    notes.extend(of_lines);
    let mut read: Vec<Record> = without_lines.iter().map(|record| ready(record, &mut notes)).collect::<Result<_, _>>()?;
    let columns: Vec<&MechanismCase> = columns
        .iter()
        .filter(|own| own.mechanism.columns().iter().all(|name| read.iter().all(|record| record.has_column(name))))
        .collect();
    let unread: BTreeSet<&str> = columns.iter().flat_map(|own| own.mechanism.columns()).collect();
    read.iter_mut().for_each(|record| record.read_columns(&unread));
    notes.extend(weighed::note(&columns, &fits, holdouts).map(|note| note.at(&case.file)));
    let of_columns: BTreeSet<String> = columns.iter().map(|own| own.mechanism.id.clone()).collect();
    let asked = mechanisms;
    let mechanisms: Vec<&'m dyn Mechanism> =
        asked.iter().copied().chain(columns.iter().map(|own| &own.mechanism as &dyn Mechanism)).collect();
    let mechanisms = mechanisms.as_slice();
    let library = library(case, cache, progress)?;
    progress(Step::begins("running every model under the recorded chamber"));
    let drawn = gyro(&library, mechanisms, &read, fits.len()).map_err(coil)?;
    let left_out = CATALOGUE.iter().map(|usual| usual.facts().id).filter(|id| mechanisms.iter().all(|own| own.facts().id != *id));
    let left_out: Vec<&str> = left_out.collect();
    if !left_out.is_empty() {
        notes.push(
            Remark::LeftOut
                .note(format!("not weighed, as the unit is said not to have them: {}", left_out.join(", ")))
                .at(&case.file),
        );
    }
    let is_offered = |mechanism: &dyn Mechanism| drawn.find(mechanism.facts().id).is_some();
    // of two paths of heat at one place, of a part that is drawn and of one that is not, either is enough
    let path = |m: &&&'m dyn Mechanism| m.facts().heat_path.is_some();
    let taken: BTreeSet<&str> = mechanisms.iter().filter(path).filter(|m| is_offered(**m)).map(|m| m.facts().place).collect();
    let is_taken = |m: &&&'m dyn Mechanism| path(m) && taken.contains(m.facts().place);
    let has_no_place = |m: &&&'m dyn Mechanism| !is_offered(**m) && !is_taken(m);
    let missing: Vec<String> = mechanisms.iter().filter(has_no_place).map(|mechanism| mechanism.facts().id.to_owned()).collect();
    if !missing.is_empty() {
        let message =
            format!("not offered, as the design, or what the meta files tell, leaves no place for it: {}", missing.join(", "));
        notes.push(Remark::NotOffered.note(message).at(&case.file));
    }
    check_laws(&drawn, asked, &read)?;
    let held = read.split_off(fits.len());
    let observations: Vec<Observation> = read.iter().map(|r| r.observed.clone()).collect();
    let numbers: Vec<usize> = (0..fits.len()).collect();
    let failed = &Error::of_diagnosis_with(&case.file, asked);
    let (settings, mut settled) =
        (Settings::default(), diagnosis::settled(&drawn, &numbers, &observations, progress).map_err(failed)?);
    let mut diagnosis =
        diagnosis::diagnose_settled(&drawn, &mut settled, &numbers, &observations, &settings, progress).map_err(failed)?;
    let gyro = settled.model.as_ref().unwrap_or(&drawn);
    let numbered: Vec<(usize, &Observation)> = (fits.len()..).zip(held.iter().map(|record| &record.observed)).collect();
    let alone: Option<(&dyn ForwardModel, _)> = Some((settled.alone(&drawn), &settled.recalibrated));
    let Judgement { records, ruling, withdrawn } =
        diagnosis.judge(gyro, &drawn, alone, (0, &read[0].observed), &numbered, RATE_CHANNEL).map_err(failed)?;
    if let Ruling::TakenBack { record, why } = ruling {
        notes.push(taken_back(&held[record].fingerprint.file, why));
    }
    let Sought { composed, stand_ins } =
        compose(gyro, &mut diagnosis, &settings, &observations, &numbered, &records, progress).map_err(failed)?;
    absolute::widen(&mut diagnosis, chamber_offset(&read).unwrap_or(absolute::USUAL_OFFSET_K));
    let best = diagnosis.best();
    let of_fit =
        |fit: &Fit| -> Vec<Vec<f64>> { fit.residuals.iter().map(|channels| channels.iter().map(|r| rms(r)).collect()).collect() };
    // what an accepted law leaves, or the best candidate, in all records
    let law = composed.as_ref().filter(|composed| composed.accepted);
    let mut answered = of_fit(law.map_or(&best.fit, |law| &law.fit));
    match law {
        Some(law) => answered.extend(law.held.iter().map(|held| held.rmse.to_vec())),
        None => answered.extend(records.iter().map(|judged| judged.model.rmse.to_vec())),
    }
    // what was taken back explains the records that were fitted all the same
    let explains_fitted = law.is_some() || diagnosis.verdict != Verdict::Unknown || !withdrawn.is_empty();
    let explains_held = law.is_some() || diagnosis.verdict != Verdict::Unknown;
    let mut is_unit = false;
    for (number, (record, answered)) in read.iter().chain(&held).zip(&answered).enumerate() {
        let explains = if number < read.len() { explains_fitted } else { explains_held };
        let found = columns::warning(&drawn, number, record, explains.then_some(answered.as_slice())).map_err(coil)?;
        // no word of a drawing makes tens of the rate
        is_unit |= number < read.len() && found.iter().any(|note| note.remark == Remark::RateUnit);
        notes.extend(found);
    }
    let mut other_drawing = None;
    if diagnosis.verdict != Verdict::None && !is_unit {
        progress(Step::begins("drawings that differ in one word"));
        let of_fitted = explains_fitted.then_some(&answered[..read.len()]);
        let constants_suffice = diagnosis.verdict == Verdict::Recalibrate;
        if let Some(doubt) = drawing::warning(&drawn, case, &read, of_fitted, constants_suffice).map_err(coil)? {
            let rather = read.iter().zip(&doubt.rather_than_sign).filter(|(_, rather)| **rather);
            let files: Vec<&Path> = rather.map(|(record, _)| record.fingerprint.file.as_path()).collect();
            notes.retain(|note| {
                note.remark != Remark::ReversedRate || !note.place.as_deref().is_some_and(|file| files.contains(&file))
            });
            notes.push(doubt.note);
            other_drawing = Some(doubt.words);
        }
    }
    let left = |pair: (usize, &Observation)| diagnosis::designed_residuals(&drawn, pair);
    let by_design = observations.iter().enumerate().map(left).collect::<Result<_, _>>().map_err(failed)?;
    let with_predictions =
        |(record, Judged { nominal, model, accepted, .. }): (Record, Judged)| Held { record, nominal, model, accepted };
    let mut holdouts: Vec<Held> = held.into_iter().zip(records).map(with_predictions).collect();
    if let Some(composed) = composed.as_ref().filter(|composed| composed.accepted) {
        for (held, by_law) in holdouts.iter_mut().zip(&composed.held) {
            (held.model, held.accepted) = (by_law.clone(), true);
        }
    }
    let (verdict, taken_back) = (diagnosis.verdict, !withdrawn.is_empty());
    let by_law = composed.as_ref().is_some_and(|composed| composed.accepted);
    let judged = holdouts.iter().filter(|_| verdict != Verdict::Unknown || by_law);
    notes.extend(judged.filter_map(|held| left_over(gyro, held, held.answer(verdict, taken_back))));
    // what stands beside a structure, or was taken back, is said to leave something
    let leading = Some(diagnosis.best()).filter(|best| verdict != Verdict::Unknown && best.rival.is_none() && !taken_back);
    if let Some(fit) = law.map(|law| &law.fit).or(leading.map(|best| &best.fit)) {
        notes.extend(read.iter().enumerate().filter_map(|(number, record)| in_rows::left_in_fit(gyro, number, record, fit)));
    }
    let (name, coil, design) = (case.name.clone(), case.file.clone(), case.fingerprints.clone());
    let alone = diagnosis.best().is_constants_alone();
    let gyro = if alone { settled.into_alone() } else { settled.model }.unwrap_or(drawn);
    let mut outcome = Outcome {
        name,
        coil,
        design,
        gyro,
        library,
        sought: OnceLock::new(),
        mechanisms: mechanisms.to_vec(),
        of_columns,
        diagnosis,
        composed,
        stand_ins,
        fits: read,
        by_design,
        holdouts,
        withdrawn,
        other_drawing,
        follows_column: None,
        is_lots: case.is_calibrated(),
        notes,
    };
    let far_off = outcome.far_off();
    outcome.notes.extend(far_off);
    if outcome.diagnosis.verdict != Verdict::None
        && let Some((column, note)) = outcome.follows_ignored()
    {
        outcome.notes.push(note);
        outcome.follows_column = Some(column);
    }
    if outcome.diagnosis.verdict == Verdict::Explained {
        let found = outcome.diagnosis.best().fit.active.iter().map(|active| outcome.gyro.mechanism(active.mechanism));
        let unread = found.filter(|own| outcome.of_columns.contains(own.facts().id));
        let column = unread.flat_map(|own| own.columns()).next().map(shown);
        outcome.follows_column = outcome.follows_column.or(column);
    }
    Ok(outcome)
}

impl Outcome<'_> {
    /// The best explanation by its mechanisms' ids; `constants` where there are none.
    pub fn hypothesis(&self) -> String {
        let ids: Vec<&str> = self.diagnosis.best().fit.active.iter().map(|active| self.id(active.mechanism)).collect();
        if ids.is_empty() { "constants".to_owned() } else { ids.join(" + ") }
    }

    /// Samples of what the best explanation leaves unknown, without the structure beside it: four walks of so many `steps`, the same for one `seed`.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the design cannot be modelled somewhere on the way.
    pub fn sampled(&self, steps: usize, seed: u64) -> Result<diagnosis::Samples, Error> {
        let observations: Vec<Observation> = self.fits.iter().map(|record| record.observed.clone()).collect();
        let numbers: Vec<usize> = (0..observations.len()).collect();
        let fit = &self.diagnosis.best().fit;
        diagnosis::sampled(&self.gyro, &numbers, &observations, fit, steps, seed).map_err(Error::of_diagnosis(&self.coil))
    }
}

/// Refuses a law of a user's own that is no number where its fits start.
fn check_laws(gyro: &Gyro, mechanisms: &[&dyn Mechanism], records: &[Record]) -> Result<(), Error> {
    let own = mechanisms.iter().map(|mechanism| mechanism.facts().id).filter(|id| mechanisms::find(id).is_none());
    let middle = diagnosis::expected(gyro.nuisances());
    for mechanism in own.filter_map(|id| gyro.find(id)) {
        let omission = &gyro.mechanisms()[mechanism];
        for (number, record) in records.iter().enumerate() {
            for values in &omission.starts {
                let active = diagnosis::Active { mechanism, values: values.clone(), choice: None };
                let Ok(response) = gyro.respond(number, &middle, &[active]) else { continue };
                let bad = (0..record.observed.time.len()).find(|row| response.iter().any(|series| !series[*row].is_finite()));
                if let Some(row) = bad {
                    let at: Vec<String> =
                        omission.parameters.iter().zip(values).map(|(p, v)| format!("{} = {v}", p.name)).collect();
                    let text = format!(
                        "--mechanism: the law of `{}` is no finite number at {} s of {}, where {}; bound it, e.g. by max(...), or give other starts",
                        omission.id,
                        Seconds(record.observed.time[row]),
                        shown_path(&record.fingerprint.file),
                        at.join(", ")
                    );
                    return Err(Error::usage(text));
                }
            }
        }
    }
    Ok(())
}

/// Whether the rate is as predicted, and the thermometer far from it.
fn reads_otherwise(answer: &HeldOut) -> bool {
    answer.within_noise(RATE_CHANNEL) && answer.is_far_from_noise(SPOOL_CHANNEL)
}

/// Note on a held-out record in which the answer leaves more than noise, or far more than the noise of its rows.
fn left_over(gyro: &Gyro, held: &Held, answer: &HeldOut) -> Option<Note> {
    let of = |channel: usize, name: &str| {
        let in_rows = in_rows::of_held(gyro, &held.record, answer, channel).filter(Left::is_misfit);
        if answer.within_noise(channel) {
            return in_rows
                .map(|left| (false, format!("{name} {} times the noise of its rows", significant(left.over_noise(), 2))));
        }
        let left = format!("{name} {} times its noise", significant(answer.over_noise(channel), 2));
        Some((answer.is_far_from_noise(channel), left))
    };
    let left: Vec<(bool, String)> =
        [of(RATE_CHANNEL, "of the rate"), of(SPOOL_CHANNEL, "of the thermometer")].into_iter().flatten().collect();
    let words: Vec<&str> = left.iter().map(|(_, words)| words.as_str()).collect();
    let far = left.iter().any(|(far, _)| *far);
    let meaning = if reads_otherwise(answer) {
        "the rate is as predicted: has the thermometer come off, or been moved?"
    } else if far {
        "something else is at work in it; is it of the same unit, mounted alike?"
    } else {
        "little, but more than noise; the model's own error may be as much"
    };
    let text = format!("what was found leaves {} in this record, which was held out: {meaning}", words.join(" and "));
    let note = if far { Remark::HeldOutLeft.warning(text) } else { Remark::HeldOutLeft.note(text) };
    (!left.is_empty()).then(|| note.at(&held.record.fingerprint.file))
}

fn taken_back(file: &Path, why: Contradiction) -> Note {
    let how = match why {
        Contradiction::ClearlyWorse => "clearly worse than by the nominal model",
        Contradiction::ProvesNothing => "no better than by the nominal model, far from its noise",
    };
    let file = shown_path(file);
    Remark::TakenBack
        .warning(format!("{file} is predicted {how}: the likeliest explanation is taken back; is it a record of the same unit?"))
}

fn name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::None => "none",
        Verdict::Recalibrate => "recalibrate",
        Verdict::Explained => "explained",
        Verdict::Unknown => "unknown",
    }
}

/// Name of the unchanged design.
const NOMINAL: &str = "nominal model";

/// Name of the design with its constants as drawn, and the instruments' own numbers fitted to the records.
const REFITTED: &str = "design as drawn, instruments fitted";

impl Outcome<'_> {
    /// Name of the model that the verdict rests on, where it is not the nominal one.
    fn found(&self) -> Option<&'static str> {
        match self.diagnosis.verdict {
            Verdict::None => None,
            Verdict::Recalibrate => Some("recalibrated model"),
            Verdict::Explained => Some("extended model"),
            Verdict::Unknown if self.law().is_some() => Some("model with the composed law"),
            Verdict::Unknown if self.diagnosis.best().fit.hypothesis == Hypothesis::NOMINAL => None,
            Verdict::Unknown => Some("best of the library"),
        }
    }

    /// Name of what was fitted beside the nominal model: what the verdict rests on, or, where the design suffices, the instruments, if they change the prediction of a
    /// record held out.
    fn fitted(&self, held: &Held) -> Option<&'static str> {
        self.found().or((held.model.rmse != held.nominal.rmse).then_some(REFITTED))
    }

    fn id(&self, mechanism: usize) -> &str {
        &self.gyro.mechanisms()[mechanism].id
    }

    /// Ids of the best candidate's mechanisms.
    fn names(&self) -> Vec<&str> {
        self.diagnosis.best().fit.active.iter().map(|a| self.id(a.mechanism)).collect()
    }

    /// Id and stage of each of the best candidate's mechanisms, and where it acts.
    fn places(&self) -> impl Iterator<Item = (&str, &str, Extent)> {
        let active = self.diagnosis.best().fit.active.iter().enumerate();
        active.map(|(n, a)| {
            let mechanism = &self.gyro.mechanisms()[a.mechanism];
            (mechanism.id.as_str(), mechanism.stage.as_str(), self.gyro.extent(a, self.diagnosis.choice(n)))
        })
    }

    /// The likeliest candidate of which all mechanisms have a name, and there is one, alone or beside a structure; none where nothing is called a
    /// finding.
    fn best_named(&self) -> Option<&Candidate> {
        let named = |c: &&Candidate| {
            let active = &c.fit.active;
            !active.is_empty() && active.iter().all(|a| self.gyro.mechanisms()[a.mechanism].named)
        };
        let found = matches!(self.diagnosis.verdict, Verdict::Explained | Verdict::Unknown);
        self.diagnosis.candidates.iter().filter(|_| found).find(named)
    }

    /// Rms of recorded less predicted thermometer in a record held out, of the design and of what was fitted \[K\], if it was recorded.
    fn thermometer(&self, held: &Held) -> Option<[f64; 2]> {
        let recorded = held.record.observed.channels[SPOOL_CHANNEL].iter().any(|v| v.is_finite());
        recorded.then(|| [held.nominal.rmse[SPOOL_CHANNEL], held.model.rmse[SPOOL_CHANNEL]])
    }

    /// Whether a record that was held out is left with far more than noise.
    fn is_left_over(&self) -> bool {
        let taken_back = !self.withdrawn.is_empty();
        let far = |held: &Held, channel: &usize| held.answer(self.diagnosis.verdict, taken_back).is_far_from_noise(*channel);
        self.holdouts.iter().any(|held| [RATE_CHANNEL, SPOOL_CHANNEL].iter().any(|channel| far(held, channel)))
    }

    /// The largest residual of the rate in a record that was held out over its noise, that of its rows or of its minutes, if it is far more than that.
    fn far_in_held(&self) -> Option<f64> {
        let taken_back = !self.withdrawn.is_empty();
        let of = |held: &Held| {
            let answer = held.answer(self.diagnosis.verdict, taken_back);
            let in_rows = in_rows::of_held(&self.gyro, &held.record, answer, RATE_CHANNEL).filter(Left::is_misfit);
            let in_minutes = answer.is_far_from_noise(RATE_CHANNEL).then(|| answer.over_noise(RATE_CHANNEL));
            in_rows.map(|left| left.over_noise()).into_iter().chain(in_minutes).reduce(f64::max)
        };
        self.holdouts.iter().filter_map(of).reduce(f64::max)
    }

    /// Whether the rate of a record that was held out is as predicted, and its thermometer far from it.
    fn reads_otherwise(&self, held: &Held) -> bool {
        reads_otherwise(held.answer(self.diagnosis.verdict, !self.withdrawn.is_empty()))
    }

    /// Whether no record that was held out is predicted worse than by the nominal model.
    fn accepted(&self) -> bool {
        self.holdouts.iter().all(|held| held.accepted)
    }

    /// Instants \[s\], and what the accepted model predicts of the rate \[deg/h\], of the first record that was held out, if one was.
    ///
    /// A model that predicts it worse than the nominal one is not accepted: then the nominal prediction is given.
    pub fn predicted_rate(&self) -> Option<[Vec<f64>; 2]> {
        let Held { record, model, nominal, accepted } = self.holdouts.first()?;
        let chosen = if *accepted { model } else { nominal };
        Some([record.instants().to_vec(), record.at_instants(&chosen.prediction[RATE_CHANNEL])])
    }

    /// [`Self::predicted_rate`] as a table `time_s,rate_deg_per_h`.
    pub fn prediction(&self) -> Option<String> {
        let [time, rates] = self.predicted_rate()?;
        let mut text = "time_s,rate_deg_per_h\n".to_owned();
        for (t, rate) in time.iter().zip(&rates) {
            let _ = writeln!(text, "{t},{rate}");
        }
        Some(text)
    }

    /// The law that was composed, if records held out bear it out.
    fn law(&self) -> Option<&Composed> {
        self.composed.as_ref().filter(|composed| composed.accepted)
    }

    /// An accepted law by its titles, with the mechanisms beside which it stands.
    fn law_name(&self) -> Option<String> {
        let law = self.law()?;
        let listed = law.fit.active.iter().filter(|active| active.mechanism < self.gyro.mechanisms().len());
        let beside: String = listed.map(|active| format!("{} + ", self.id(active.mechanism))).collect();
        Some(beside + &law.name())
    }

    /// The fit that the answer rests on: that of an accepted law, or of the best candidate.
    fn leading(&self) -> &Fit {
        self.law().map_or(&self.diagnosis.best().fit, |law| &law.fit)
    }

    /// Mechanisms' files with what was composed, by their ids; none unless records held out bear it out.
    ///
    /// # Errors
    /// [`files::Error::Input`] if a value cannot be written.
    pub fn laws(&self) -> Result<Vec<(String, String)>, Error> {
        self.law().map_or_else(|| Ok(Vec::new()), Composed::files)
    }

    /// Fitted values of a mechanism's parameters, if it is part of an accepted explanation.
    pub fn found_of(&self, id: &str) -> Option<Vec<f64>> {
        let best = &self.diagnosis.best().fit;
        let found = self.diagnosis.verdict == Verdict::Explained && self.accepted();
        best.active.iter().filter(|_| found).find(|active| self.id(active.mechanism) == id).map(|active| active.values.clone())
    }

    /// A check of the unit itself that decides about a mechanism.
    fn inspection(&self, id: &str) -> Option<&str> {
        self.mechanisms.iter().find(|mechanism| mechanism.facts().id == id).and_then(|mechanism| mechanism.facts().inspection())
    }

    /// Further remarks for the user.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Adds remarks, which stand in text, JSON and page from then on.
    pub fn add_notes(&mut self, notes: impl IntoIterator<Item = Note>) {
        self.notes.extend(notes);
    }
}

/// Refuses a design that the library cannot be made for.
///
/// # Errors
/// [`files::Error::Input`] for a coil file whose own mechanics changes with temperature or time.
pub fn check_design(case: &CoilCase, file: &Path) -> Result<(), Error> {
    if case.design.mechanics == coil::Mechanics::Elastic {
        return Ok(());
    }
    let problem =
        "a design whose mechanics changes is not diagnosed: its own changes would hide those that are sought".to_owned();
    let remedy = "set it to Elastic, the nominal design".to_owned();
    Err(InputError { file: file.to_owned(), line: None, field: Some("mechanics".into()), problem, remedy }.into())
}
