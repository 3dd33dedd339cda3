//! Inputs of a diagnosis or a recommendation: a design's library of models, and recordings in the engine's form.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use bias::units::S_PER_MIN;
use coil::COARSE;
use diagnosis::Observation;
use files::{Note, Remark, shown, shown_path};
use mechanisms::{
    CATALOGUE, Chamber, Gyro, Instrument, Instruments, Library, Mechanism, Models, Prepared, RATE as RATE_NUMBER,
    SPOOL as SPOOL_NUMBER, USUAL_NOISE,
};
use progress::Step;
use recording::check::{Finding, FindingKind, Severity, Unit, white_noise};
use recording::condition::{Rest, Thinned, Thinning, Unrest, bridged, filled, span, thinned, unrest};
use recording::smooth::resolution;
use recording::{Recording, Seconds, median_interval};

use crate::Error;
use crate::cache::Cache;
use crate::contradictions::contradictions;
use crate::copies::contains;
use crate::input::{CHAMBER, CoilCase, Fingerprint, InputError, Meta, RATE, RecordCase, SPOOL, Thermometer};

/// Fewest rows with a rate from which anything is said.
const FEWEST_ROWS: usize = 60;
/// Rows beyond which neighbours are averaged, a day of half minutes; the interval \[s\] to which they are, as a coil's fastest transients take
/// minutes; most rows that are compared: of more, the interval grows.
const THINNING: Thinning = Thinning { many_rows: 3_000, interval: 30.0, most_rows: 30_000 };
/// The same of the chamber's readings before they are freed of noise: where a programme turns, half a minute is much.
const THINNING_CHAMBER: Thinning = Thinning { many_rows: 9_000, interval: 10.0, most_rows: 30_000 };
/// Range of the chamber \[K\] below which it is noted that nothing shows; beyond it what a start or a gap hides may be taken for a finding.
const FEWEST_KELVIN: f64 = 5.0;
/// Rows from which what is missing counts as a gap, and readings on either side from which the chamber's slope there is taken.
const GAP_ROWS: f64 = 3.0;
const BESIDE_GAP: usize = 10;
/// Largest difference of chamber and spool at rest, and largest movement of the chamber in the first minutes \[K\]: thermometers' offsets and noise.
const REST: Rest = Rest { duration: 600.0, tolerance: 0.5 };

/// A record in the engine's form.
#[derive(Clone)]
pub(crate) struct Record {
    pub(crate) fingerprint: Fingerprint,
    pub(crate) observed: Observation,
    /// as read, averaged as the others are
    pub(crate) chamber: Vec<f64>,
    /// drive of the model
    pub(crate) drive: Chamber,
    pub(crate) averaging: f64,
    /// other units in which the rate may be, those that are rare last
    pub(crate) rate_units: Vec<Unit>,
    /// flags that name files with which it was read
    pub(crate) flags: Vec<(&'static str, PathBuf)>,
    /// further columns, which laws name, without gaps
    columns: BTreeMap<String, Vec<f64>>,
    /// columns that nothing reads, by their names; NaN where a value is missing
    pub(crate) ignored: BTreeMap<String, Vec<f64>>,
    /// facts about its instruments
    meta: Option<Meta>,
    /// whether a reading stands for several rows
    is_held: bool,
    /// instants of the rows before they were averaged \[s\], and how much earlier than its instant the middle of an averaged one lies
    instants: (Vec<f64>, f64),
}

impl Record {
    /// Responses of every model of a library to it.
    pub(crate) fn prepared(&self, library: &Library) -> Result<Prepared, coil::Error> {
        let prepared = Prepared::under(library, &self.observed.time, &self.drive, self.averaging)?;
        Ok(prepared.with_columns(self.columns.clone()))
    }

    /// Whether a column that nothing read has values in its rows.
    pub(crate) fn has_column(&self, name: &str) -> bool {
        self.ignored.get(name).is_some_and(|values| values.iter().any(|value| value.is_finite()))
    }

    /// Takes columns of these names, of those that nothing read, for laws that name them.
    pub(crate) fn read_columns(&mut self, names: &BTreeSet<&str>) {
        for name in names {
            let values = self.ignored.get(*name).and_then(|values| bridged(&self.observed.time, values));
            if let Some(values) = values {
                self.ignored.remove(*name);
                self.columns.insert((*name).to_owned(), values);
            }
        }
    }

    /// Instants of the record's rows, before they were averaged.
    pub(crate) fn instants(&self) -> &[f64] {
        &self.instants.0
    }

    /// Values of its averaged rows at the instants before the averaging: on straight lines between the middles of the means.
    pub(crate) fn at_instants(&self, values: &[f64]) -> Vec<f64> {
        let (instants, earlier) = (&self.instants.0, self.instants.1);
        let time = &self.observed.time;
        if time.len() < 2 {
            return values.to_vec();
        }
        let at = |t: &f64| {
            let t = t + earlier;
            let after = time.partition_point(|end| *end < t).clamp(1, time.len() - 1);
            if time[after] == t {
                return values[after];
            }
            let share = (t - time[after - 1]) / (time[after] - time[after - 1]);
            values[after - 1] + share * (values[after] - values[after - 1])
        };
        instants.iter().map(at).collect()
    }
}

/// The models of a design, from the cache if they are there; `progress` is told how far they are.
///
/// # Errors
/// [`files::Error::Coil`] if the design cannot be modelled.
pub fn models(case: &CoilCase, cache: &Cache, progress: &(dyn Fn(Step) + Sync)) -> Result<Models, Error> {
    const TASK: &str = "modelling the coil and what its model may leave out (half a minute, once for a design)";
    let key = (&case.design, &case.tolerances, COARSE);
    let built = cache.load_or_build("models", &key, || {
        progress(Step::begins(TASK));
        Models::build(&case.design, &case.tolerances, CATALOGUE, &|step| progress(Step { task: TASK, ..step }))
    });
    built.map(|(models, _)| models).map_err(Error::of_coil(&case.file))
}

/// The library of a design, of its [`models`].
///
/// # Errors
/// As [`models`].
pub fn library(case: &CoilCase, cache: &Cache, progress: &(dyn Fn(Step) + Sync)) -> Result<Library, Error> {
    Library::new(models(case, cache, progress)?, CATALOGUE).map_err(Error::of_coil(&case.file))
}

fn refuse(case: &RecordCase, field: &str, problem: String, remedy: &str) -> Error {
    let file = case.fingerprint.file.clone();
    InputError { file, line: None, field: Some(field.to_owned()), problem, remedy: remedy.to_owned() }.into()
}

/// Whether a temperature \[°C\], read at an interval \[s\], stands still. Means over a minute tell it: of single readings a thermometer's noise spans
/// the more, the more there are. A recording of less than two minutes has no others.
pub(crate) fn stands_still(readings: &[f64], interval: f64) -> bool {
    let known: Vec<f64> = readings.iter().copied().filter(|value| value.is_finite()).collect();
    let minute = ((S_PER_MIN / interval) as usize).max(1);
    let minute = if known.len() < 2 * minute { 1 } else { minute };
    let means: Vec<f64> = known.chunks_exact(minute).map(|chunk| chunk.iter().sum::<f64>() / chunk.len() as f64).collect();
    span(&means) <= 2.0 * REST.tolerance
}

/// Refuses a chamber that has one value throughout beside a spool that moves: what moves it was not recorded.
fn refuse_dead(case: &RecordCase, time: &[f64], chamber: &[f64], spool: &[f64]) -> Result<(), Error> {
    let moved: Vec<f64> = spool.iter().copied().filter(|value| value.is_finite()).collect();
    // from rest, where chamber and spool agree to the tolerance, a chamber at rest holds the spool within it on either side
    let interval = median_interval(time).unwrap_or(S_PER_MIN);
    if moved.is_empty() || span(chamber) > 0.0 || stands_still(&moved, interval) {
        return Ok(());
    }
    let problem = format!("is {} degC throughout, while the spool moves by {:.1} K", chamber[0], span(&moved));
    Err(refuse(case, CHAMBER, problem, "check the chamber's sensor and the choice of its column"))
}

/// A warning of the gap in which the chamber turned most: how, no reading tells.
fn moved_in_gap(case: &RecordCase) -> Option<Note> {
    let chamber = case.recording.channel(CHAMBER)?;
    let readings: Vec<(f64, f64)> = case
        .recording
        .time()
        .iter()
        .copied()
        .zip(chamber.values.iter().copied())
        .filter(|(_, value)| value.is_finite())
        .collect();
    let interval = median_interval(case.recording.time())?;
    let slope = |from: usize, to: usize| (readings[to].1 - readings[from].1) / (readings[to].0 - readings[from].0);
    let within = |n: usize| -> Option<(f64, f64)> {
        let gap = readings[n].0 - readings[n - 1].0;
        let (before, after) = (n.checked_sub(1 + BESIDE_GAP)?, n + BESIDE_GAP);
        (gap > GAP_ROWS * interval && after < readings.len())
            // a course that turns evenly is that far from its chord
            .then(|| (gap, (slope(n, after) - slope(before, n - 1)).abs() * gap / 8.0))
    };
    let (gap, off) = (1..readings.len()).filter_map(within).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let text = format!(
        "the chamber turned within a gap of {} s, over which its likeliest course is taken: up to {off:.1} K off; what the next hours leave may be no finding",
        Seconds(gap)
    );
    (off > REST.tolerance).then(|| Remark::Gap.warning(text))
}

/// A note on a recording that does not start at rest; a warning where that is far.
fn off_rest(time: &[f64], chamber: &[f64], spool: &[f64]) -> Option<Note> {
    let (by, off) = match unrest(time, chamber, spool, &REST)? {
        Unrest::Apart(by) => (by, format!("spool and chamber differ by {by:.1} K, and the difference changes")),
        Unrest::Moving(by) => (by, format!("the chamber moves by {by:.1} K in the first {} min", REST.duration / S_PER_MIN)),
    };
    let text = format!("does not start at rest ({off}): the model assumes rest; residuals from this are not findings");
    Some(if by > FEWEST_KELVIN { Remark::NotAtRest.warning(text) } else { Remark::NotAtRest.note(text) })
}

/// The same of a recording as it was read.
pub(crate) fn starts_off_rest(case: &RecordCase) -> Option<Note> {
    let used = case.report.used(&case.recording);
    let values = |name| used.channel(name).map(|channel| channel.values.clone());
    let chamber = bridged(used.time(), &values(CHAMBER)?)?;
    let spool = values(SPOOL).unwrap_or_else(|| vec![f64::NAN; used.time().len()]);
    off_rest(used.time(), &chamber, &spool)
}

/// A recording's usable values, averaged down where there are very many; what was done is added to `notes`.
pub(crate) fn ready(case: &RecordCase, notes: &mut Vec<Note>) -> Result<Record, Error> {
    case.require_usable()?;
    let file = &case.fingerprint.file;
    let interval = case.report.instants.as_ref().map_or(0.0, |instants| instants.interval);
    let used = case.report.used(&case.recording);
    let before = used.time().to_vec();
    let fine = thinned(&used, interval, &THINNING_CHAMBER).map(|thinned| thinned.recording);
    // means of readings have no last digit
    let digit = case.meta.as_ref().filter(|_| fine.is_none()).and_then(|meta| meta.resolutions()[0]);
    let is_held = |finding: &&Finding| matches!(finding.kind, FindingKind::Held { .. });
    let held: Vec<&Finding> = case.report.findings.iter().filter(is_held).collect();
    let drive = drive(&filled(fine.as_ref().unwrap_or(&used)), digit);
    let mut earlier = 0.0;
    let (used, averaging) = match thinned(&used, interval, &THINNING) {
        None => (used, case.averaging),
        Some(Thinned { recording, every, rows }) => {
            earlier = interval * (every - 1) as f64 / 2.0;
            let (left, interval) = (recording.time().len(), interval * every as f64);
            let message = format!("{rows} rows are averaged by {every} to {left} of {interval:.3} s");
            notes.push(Remark::Averaged.note(message).at(file));
            (recording, case.averaging * every as f64)
        }
    };
    // the chamber may have turned where a logger left rows out
    let used = filled(&used);
    let time = used.time().to_vec();
    let values = |name| used.channel(name).map_or_else(|| vec![f64::NAN; time.len()], |channel| channel.values.clone());
    let (spool, rate) = (values(SPOOL), values(RATE));
    let standard = |name: &str| [CHAMBER, SPOOL, RATE].contains(&name);
    let further = used.channels().iter().filter(|channel| !standard(&channel.name));
    let mut columns = BTreeMap::new();
    for channel in further {
        let Some(values) = bridged(&time, &channel.values) else {
            return Err(refuse(
                case,
                &channel.name,
                "there is no value in the column".to_owned(),
                "a mechanism's file names it: give values",
            ));
        };
        columns.insert(channel.name.clone(), values);
    }
    let Some((chamber, drive)) = bridged(&time, &values(CHAMBER)).zip(drive) else {
        let problem = "there is no chamber temperature to drive the model with".to_owned();
        return Err(refuse(case, CHAMBER, problem, "give a column with values"));
    };
    refuse_dead(case, &time, &chamber, &spool)?;
    let count = rate.iter().filter(|r| r.is_finite()).count();
    if count < FEWEST_ROWS {
        let problem = format!("{count} rows with a rate are too few to tell anything");
        return Err(refuse(case, RATE, problem, "record at least an hour, with ramps"));
    }
    let warnings = case.report.findings.iter().filter(|finding| finding.severity == Severity::Warning);
    notes.extend(warnings.map(|finding| Remark::of_finding(&finding.kind).warning(finding.to_string()).at(file)));
    notes.extend(held.iter().map(|finding| Remark::Held.note(finding.to_string()).at(file)));
    // how the file was read, where that is doubtful
    notes.extend(case.notes.iter().filter(|note| note.is_warning()).map(|note| note.clone().at(file)));
    notes.extend(moved_in_gap(case).map(|note| note.at(file)));
    notes.extend(contradictions(case));
    let mut say = |remark: Remark, text: String| notes.push(remark.note(text).at(file));
    let range = span(&chamber);
    if range < FEWEST_KELVIN {
        let message = format!("the chamber moves by {range:.1} K only: little that depends on temperature can show");
        say(Remark::NarrowRange, message);
    }
    if case.number(SPOOL).is_none() {
        say(Remark::NoThermometer, "no spool_c: heat paths and the thermometer cannot be told apart".to_owned());
    }
    notes.extend(off_rest(&time, &chamber, &spool).map(|note| note.at(file)));
    let (fingerprint, observed) = (case.fingerprint.clone(), Observation { time, channels: vec![spool, rate] });
    let (meta, flags, instants) = (case.meta.clone(), case.flags.clone(), (before, earlier));
    let is_held = !held.is_empty();
    let ignored = ignored(case, interval);
    let rate_units = case.rate_units.clone();
    Ok(Record { fingerprint, observed, chamber, drive, averaging, rate_units, flags, columns, ignored, meta, is_held, instants })
}

/// Columns that nothing reads, in the rows of a record that was made ready.
fn ignored(case: &RecordCase, interval: f64) -> BTreeMap<String, Vec<f64>> {
    let kept = case.ignored.select(&case.report.rows);
    let kept = filled(&thinned(&kept, interval, &THINNING).map_or(kept, |thinned| thinned.recording));
    kept.channels().iter().map(|channel| (channel.name.clone(), channel.values.clone())).collect()
}

/// Note on a record whose unit was built to a design of another name; files that the program writes have the drawing's name before a comma.
pub(crate) fn other_design(case: &CoilCase, record: &RecordCase) -> Option<Note> {
    let told = record.meta.as_ref().map(|meta| meta.design.trim()).filter(|told| !told.is_empty())?;
    let name = case.name.split(',').next().unwrap_or_default().trim();
    let message = || format!("the meta file says that the unit was built to `{}`; this design is `{name}`", shown(told));
    (!told.eq_ignore_ascii_case(name)).then(|| Remark::OtherDesign.warning(message()).at(&record.fingerprint.file))
}

/// The chamber by its readings; `None` where there are none. They leave its course between them to what is likely.
fn drive(recording: &Recording, digit: Option<f64>) -> Option<Chamber> {
    let chamber = &recording.channel(CHAMBER)?.values;
    let first = chamber.iter().position(|value| value.is_finite())?;
    let last = chamber.iter().rposition(|value| value.is_finite())?;
    Some(Chamber::recorded(&recording.time()[first..=last], &chamber[first..=last], digit))
}

/// The forward model of some records, of which the first `fitted` are fitted.
///
/// # Errors
/// [`coil::Error`] names the dimension or property at fault.
pub(crate) fn gyro<'m>(
    library: &Library,
    mechanisms: &[&'m dyn Mechanism],
    records: &[Record],
    fitted: usize,
) -> Result<Gyro<'m>, coil::Error> {
    let prepared = records.iter().map(|record| record.prepared(library)).collect::<Result<Vec<_>, _>>()?;
    Gyro::fitted_to(
        library.clone(),
        mechanisms,
        prepared,
        fitted,
        &Instruments { earth: earth_of(records), ..instruments_of(&records[..fitted]) },
    )
}

/// Standard deviation of the offset of the chamber's thermometer \[K\], if a meta file of some records tells it.
pub(crate) fn chamber_offset(records: &[Record]) -> Option<f64> {
    instruments_of(records).chamber.offset_sd
}

/// Instruments by the meta files of some records; each number comes from the first record that states it.
fn instruments_of(records: &[Record]) -> Instruments {
    let metas = || records.iter().filter_map(|record| record.meta.as_ref());
    let first = |of: &dyn Fn(&Meta) -> Option<f64>| metas().find_map(of);
    let thermometer = |of: fn(&Meta) -> &Thermometer| Instrument {
        offset_sd: first(&|meta| of(meta).offset_sd),
        gain_sd: first(&|meta| of(meta).gain_sd),
        lag: first(&|meta| of(meta).lag_s),
        clock_sd: first(&|meta| of(meta).clock_offset_sd_s),
    };
    let rate = Instrument {
        offset_sd: first(&|meta| meta.rate_deg_per_h.offset_sd),
        gain_sd: first(&|meta| meta.rate_deg_per_h.scale_factor_sd),
        lag: None,
        clock_sd: first(&|meta| meta.rate_deg_per_h.clock_offset_sd_s),
    };
    // a display adds the noise of its rounding, and means of readings have neither its nor the sensor's
    let as_read = records.iter().all(|record| record.instants.1 == 0.0);
    let of_spool = first(&|meta| meta.spool_c.noise).filter(|_| as_read).filter(|noise| *noise > 0.0);
    let mut white = noise_of(records, [of_spool.unwrap_or(USUAL_NOISE[SPOOL_NUMBER]), USUAL_NOISE[RATE_NUMBER]]);
    let least = first(&|meta| meta.resolutions()[1]).filter(|_| as_read).map_or(0.0, of_rounding);
    white[SPOOL_NUMBER] = white[SPOOL_NUMBER].max(least);
    let (chamber, spool) = (thermometer(|meta| &meta.chamber_c), thermometer(|meta| &meta.spool_c));
    // a reading that a slower logger took comes into the next row, with up to a row's delay
    let is_vague = |record: &&Record| record.is_held || record.meta.as_ref().is_none_or(|meta| meta.sample_interval_s <= 0.0);
    let unsaid = records.iter().filter(is_vague).filter_map(|record| median_interval(record.instants())).fold(0.0, f64::max);
    Instruments { white, chamber, spool, rate, earth: None, unsaid }
}

/// Earth's rate, where all records tell the same.
fn earth_of(records: &[Record]) -> Option<f64> {
    let told = |record: &Record| record.meta.as_ref().and_then(|meta| meta.rate_deg_per_h.earth());
    let first = told(records.first()?)?;
    records.iter().all(|record| told(record) == Some(first)).then_some(first)
}

/// White noise of thermometer and rate in a sample of the first record, by the quietest of some records; `usual` where none shows it. The noise of the
/// rate, a mean, falls with the length of rows.
fn noise_of(records: &[Record], usual: [f64; 2]) -> [f64; 2] {
    let first = records.first().and_then(|r| median_interval(&r.observed.time));
    let of = |channel: usize| {
        let white = |r: &Record| {
            let values = &r.observed.channels[channel];
            let is_used: Vec<bool> = values.iter().map(|v| v.is_finite()).collect();
            let used: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
            // a display that stands still for most rows has the noise of its rounding all the same
            let white = white_noise(&r.observed.time, values, &is_used)?.max(of_rounding(resolution(&used)));
            let longer = median_interval(&r.observed.time).zip(first).map_or(1.0, |(own, first)| own / first);
            Some(if channel == RATE_NUMBER { white * longer.sqrt() } else { white })
        };
        let each = records.iter().filter_map(white).filter(|sd| *sd > 0.0);
        each.reduce(f64::min).unwrap_or(usual[channel])
    };
    [of(SPOOL_NUMBER), of(RATE_NUMBER)]
}

/// Standard deviation of a display's rounding, evenly within its last digit.
fn of_rounding(digit: f64) -> f64 {
    digit / 12.0_f64.sqrt()
}

/// A record that is given twice, whole or in part, would be counted, or judged, by itself.
pub(crate) fn refuse_copies<'a>(records: impl Iterator<Item = &'a RecordCase>) -> Result<(), Error> {
    let mut known: Vec<&RecordCase> = Vec::new();
    let same = |a: &Fingerprint, b: &Fingerprint| (a.bytes, a.fnv1a) == (b.bytes, b.fnv1a);
    for record in records {
        let refused = |own: &RecordCase, is: &str, other: &RecordCase| {
            let problem = format!("{is} {}", shown_path(&other.fingerprint.file));
            let remedy = "give every recording once: what was fitted cannot judge";
            Err(InputError::whole(&own.fingerprint.file, problem, remedy).into())
        };
        for other in &known {
            if same(&record.fingerprint, &other.fingerprint) {
                return refused(record, "is the same recording as", other);
            }
            for (part, whole) in [(record, *other), (*other, record)] {
                if contains(whole, part) {
                    return refused(part, "is a part of another recording: all its rows stand in", whole);
                }
            }
        }
        known.push(record);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A thermometer's noise of 0.3 K spans 2.4 K in an hour of seconds, and no more than a minute's mean of it moves.
    #[test]
    fn a_noisy_thermometer_stands_still_however_often_it_is_read() {
        let reading = |n: usize| 20.0 + if n.is_multiple_of(600) { 1.2 } else { 0.3 * (n % 2) as f64 };
        let rest: Vec<f64> = (0..3600).map(reading).collect();
        assert!(stands_still(&rest, 1.0) && !stands_still(&rest, 60.0));
        let warmed: Vec<f64> = rest.iter().enumerate().map(|(n, t)| t + 1.2 * n as f64 / 3600.0).collect();
        assert!(!stands_still(&warmed, 1.0));
        assert!(stands_still(&[f64::NAN; 3], 1.0) && stands_still(&[20.0, f64::NAN, 20.9], 600.0));
        // less than two minutes have no means
        assert!(!stands_still(&warmed[..119].iter().enumerate().map(|(n, t)| t + 0.02 * n as f64).collect::<Vec<_>>(), 1.0));
    }

    /// Whatever the logger's interval: rows of a tenth of a second become means, and the spool moves through each of them.
    #[test]
    fn a_dead_chamber_beside_a_moving_spool_is_refused_at_any_rate() {
        let folder = tempfile::tempdir().unwrap();
        for interval in [0.5, 2.0, 60.0] {
            let path = folder.path().join("r.csv");
            let row = |n: usize| {
                let time = interval * n as f64;
                let spool = 20.0 + 8.0 * (time / 1800.0).sin();
                format!("{time},20.0,{spool:.3},{:.4}\n", 0.01 * (n % 7) as f64)
            };
            let rows: String = (0..(14_400.0 / interval) as usize).map(row).collect();
            std::fs::write(&path, format!("time_s,chamber_c,spool_c,rate_deg_per_h\n{rows}")).unwrap();
            let case = crate::input::read_record(&path, &crate::input::RecordOptions::default()).unwrap();
            let refused = ready(&case, &mut Vec::new()).err().map(|error| error.to_string()).unwrap_or_default();
            assert!(refused.contains("while the spool moves by"), "{interval}: {refused}");
        }
    }

    /// 12 000 rows of a second, the rate rising by 1 deg/h a row; from row 6000 on all is an hour later.
    #[test]
    fn very_many_rows_are_averaged_by_whole_numbers() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.csv");
        let row = |n: usize| {
            let (time, rate) = (n + if n < 6015 { 0 } else { 3600 }, 0.001 * n as f64 + 0.0001 * (n % 3) as f64);
            format!("{time},{},{},{rate:.4}\n", 20.0 + 0.001 * n as f64, 20.0 + 0.0005 * n as f64 + 0.01 * (n % 2) as f64)
        };
        let rows = (0..12_000).map(row).enumerate().map(|(n, row)| format!("{},{n},ok\n", row.trim_end()));
        let header = "time_s,chamber_c,spool_c,rate_deg_per_h,Ub [V],state\n".to_owned();
        std::fs::write(&path, header + &rows.collect::<String>()).unwrap();
        let case = crate::input::read_record(&path, &crate::input::RecordOptions::default()).unwrap();
        let mut notes = Vec::new();
        let ready = ready(&case, &mut notes).unwrap();
        let [spool, rate] = &ready.observed.channels[..] else { panic!() };
        let time = &ready.observed.time;
        // 200 whole groups before the gap, of which 15 rows are cut off, and 199 after it
        // and as many rows without a value as the gap has room for
        assert_eq!((time.len(), time[0], time[199], time[321]), (399 + 121, 29.0, 5999.0, 6044.0 + 3600.0));
        assert!(rate[200..321].iter().chain(&spool[200..321]).all(|value| value.is_nan()));
        assert_eq!(ready.averaging, 30.0);
        // what nothing reads stands in the same rows; words are no numbers
        let beside = &ready.ignored["Ub [V]"];
        assert_eq!((ready.ignored.len(), beside.len(), beside[0], beside[321]), (1, time.len(), 29.0, 6044.0));
        assert!(beside[200..321].iter().all(|value| value.is_nan()));
        // what is told of the means reads back at every row: the rate rises on a straight line, but for an hour without one
        assert_eq!(ready.instants().len(), 12_000);
        let again = ready.at_instants(rate);
        assert!([0, 15, 3000, 9000, 11_999].iter().all(|&n| (again[n] - (0.001 * n as f64 + 0.0001)).abs() < 1e-9), "{again:?}");
        assert!((rate[0] - (0.0145 + 0.0001)).abs() < 1e-12 && (rate[321] - (6.0295 + 0.0001)).abs() < 1e-9, "{rate:?}");
        assert!((ready.chamber[0] - 20.029).abs() < 1e-12 && (spool[0] - 20.0195).abs() < 1e-3, "{}", spool[0]);
        assert!(notes.iter().any(|note| note.text.contains("12000 rows are averaged by 30 to 399 of 30.000 s")), "{notes:?}");
    }
}
