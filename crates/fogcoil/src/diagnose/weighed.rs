//! Columns of the records that nothing reads, each as a mechanism that is weighed: a rate that follows it.

use std::collections::BTreeSet;
use std::path::Path;

use bias::units::S_PER_MIN;
use files::{Note, Remark, shown};
use mechanisms::{Mechanism, RATE as RATE_CHANNEL, USUAL_NOISE, usual_coefficient};
use recording::check::white_noise;
use recording::{Recording, median_interval};

use super::ignored::{centred, repeats, sums};
use crate::input::{CHAMBER, MechanismCase, RATE, RecordCase, SPOOL, check_mechanism};

/// Source by which such a mechanism is known: no user writes it.
const SOURCE: &str = "a column of the record that the model of the coil does not use";
/// Most columns that are weighed, each of which takes its time, and takes its share of what is likely beforehand.
const MOST: usize = 12;
/// Longest name in an id.
const LONGEST: usize = 24;

/// Whether a mechanism is one of those that [`of_columns`] makes.
pub(super) fn is_of_column(mechanism: &dyn Mechanism) -> bool {
    mechanism.facts().source == SOURCE
}

/// A mechanism for every column of numbers that all records of a unit hold, that nothing else reads, and that goes its own way: it is neither constant nor
/// a line of the time, of a temperature or of the rate itself. Each adds a rate in proportion to its column.
pub fn of_columns(fits: &[RecordCase], holdouts: &[RecordCase]) -> Vec<MechanismCase> {
    let rows = |record: &RecordCase| (record.report.used(&record.recording), record.ignored.select(&record.report.rows));
    let fitted: Vec<(Recording, Recording)> = fits.iter().map(rows).collect();
    let has = |record: &Recording, name: &str| record.channel(name).is_some_and(|c| c.values.iter().any(|v| v.is_finite()));
    let is_held = |name: &str| holdouts.iter().all(|record| has(&record.ignored, name));
    let names: BTreeSet<&str> =
        fitted.first().into_iter().flat_map(|(_, own)| own.channels()).map(|channel| channel.name.as_str()).collect();
    let (mut ids, mut all) = (BTreeSet::new(), Vec::new());
    for name in names.into_iter().filter(|name| is_held(name)) {
        let course = |own: &'_ Recording| own.channel(name).map(|channel| channel.values.clone());
        let Some(courses) = fitted.iter().map(|(_, own)| course(own)).collect::<Option<Vec<_>>>() else { continue };
        let of = |(read, _): &'_ (Recording, Recording), other: &str| read.channel(other).map(|c| c.values.clone());
        let like = |other: &str| {
            let both: Vec<_> = fitted.iter().zip(&courses).filter_map(|(record, own)| Some((own, of(record, other)?))).collect();
            !both.is_empty() && repeats(both.iter().map(|(own, other)| (own.as_slice(), other.as_slice())))
        };
        let is_time = repeats(fitted.iter().zip(&courses).map(|((read, _), own)| (own.as_slice(), read.time())));
        if is_time || [CHAMBER, SPOOL, RATE].into_iter().any(like) {
            continue;
        }
        let scale = fitted.iter().zip(&courses).filter_map(|((read, _), own)| usual_size(read, own)).reduce(f64::max);
        let id = id(name, all.len(), &mut ids);
        all.extend(scale.and_then(|scale| mechanism(name, &id, scale, mean(&courses))));
    }
    all.truncate(MOST);
    all
}

/// The note that these are weighed, if there are any.
pub(super) fn note(mechanisms: &[&dyn Mechanism]) -> Option<Note> {
    let own = mechanisms.iter().filter(|mechanism| is_of_column(**mechanism));
    let names: Vec<String> = own.flat_map(|own| own.columns()).map(|name| format!("`{}`", shown(name))).collect();
    let text = format!(
        "weighed beside the mechanisms: that the rate follows a column that the model does not use ({})",
        names.join(", ")
    );
    (!names.is_empty()).then(|| Remark::WeighedColumn.note(text))
}

fn mean(courses: &[Vec<f64>]) -> f64 {
    let known = || courses.iter().flatten().filter(|value| value.is_finite());
    known().sum::<f64>() / known().count().max(1) as f64
}

/// The usual size of the rate for each unit of a column \[deg/h\]: that of a temperature coefficient, were the column as lively as the chamber.
fn usual_size(read: &Recording, column: &[f64]) -> Option<f64> {
    let (chamber, rate) = (&read.channel(CHAMBER)?.values, &read.channel(RATE)?.values);
    let used: Vec<bool> = rate.iter().map(|value| value.is_finite()).collect();
    let noise = white_noise(read.time(), rate, &used).filter(|noise| *noise > 0.0);
    let interval = median_interval(read.time())?;
    let minute = noise.map_or(USUAL_NOISE[RATE_CHANNEL], |noise| noise * (interval / S_PER_MIN).sqrt());
    let [chamber, _, column] = sums(&centred(chamber, column));
    let size = usual_coefficient(minute) * (chamber / column).sqrt();
    (size.is_finite() && size > 0.0).then_some(size)
}

/// `follows-` and the column's name without its unit, in small letters and hyphens; its number where nothing is left of it.
fn id(name: &str, number: usize, taken: &mut BTreeSet<String>) -> String {
    let bare = name.split(['[', '(']).next().unwrap_or_default().to_lowercase();
    let words = bare.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let mut words = words.collect::<Vec<_>>().join("-");
    words.truncate(LONGEST);
    let words = if words.is_empty() { format!("column-{}", number + 1) } else { words.trim_end_matches('-').to_owned() };
    let id = format!("follows-{words}");
    let id = if taken.contains(&id) { format!("{id}-{}", number + 1) } else { id };
    taken.insert(id.clone());
    id
}

/// The mechanism as a user would write it, in the column's unit if its name ends in one that laws know.
fn mechanism(name: &str, id: &str, scale: f64, mean: f64) -> Option<MechanismCase> {
    let bracketed =
        name.trim_end().strip_suffix([']', ')']).and_then(|name| name.rsplit_once(['[', '('])).map(|(_, unit)| unit.trim());
    let in_unit = |unit: &str| {
        let per = match unit {
            "1" => "deg/h".to_owned(),
            "degC" => "deg/h/K".to_owned(),
            unit => format!("deg/h/({unit})"),
        };
        let text = format!(
            "(\n    id: {id:?},\n    title: {title:?},\n    stage: Electronics,\n    meaning: {meaning:?},\n    signature: \"The rate follows the column \
             at every instant.\",\n    inspection: {inspection:?},\n    source: {SOURCE:?},\n    parameters: [(name: \"size\", unit: {per:?}, prior: \
             Size({scale:e}))],\n    columns: [(name: \"column\", column: {name:?}, unit: {unit:?})],\n    laws: [Rate(\"size * (column - {mean:?})\")],\n)\n",
            title = format!("A rate that follows the column {name}"),
            meaning = format!("the rate follows the column {name}, which the model of the coil does not use"),
            inspection = format!("hold the temperature and change the quantity in the column {name} alone"),
        );
        check_mechanism(Path::new(&format!("{id}.ron")), text).ok()
    };
    bracketed.into_iter().chain(["1"]).find_map(in_unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::check_record;

    /// Three hours of minutes: a chamber that is warmed and held, a spool and a board behind it, and a gyroscope with noise. `further` makes more columns of
    /// minutes, chamber, board and rate.
    fn record(header: &str, further: impl Fn([f64; 4]) -> String) -> RecordCase {
        let (mut spool, mut board, mut rows) = (20.0, 20.0, String::new());
        for n in 0..180 {
            let chamber = 20.0 + 30.0 * (f64::from(n) / 60.0).min(1.0) + 0.01 * f64::from(n % 3);
            spool += (chamber - spool) / 20.0;
            board += (chamber - board) / 80.0;
            let rate = 0.02 * f64::from(n * n * 37 % 101);
            let more = further([f64::from(n), chamber, board, rate]);
            rows += &format!("{},{chamber:.3},{spool:.3},{rate:.4}{more}\n", 60 * n);
        }
        check_record(Path::new("r.csv"), format!("time_s,chamber_c,spool_c,rate_deg_per_h{header}\n{rows}"), None, &[]).unwrap()
    }

    fn ids(fits: &[RecordCase], holdouts: &[RecordCase]) -> Vec<String> {
        of_columns(fits, holdouts).iter().map(|own| own.mechanism.id.clone()).collect()
    }

    #[test]
    fn a_column_that_goes_its_own_way_is_weighed_and_no_other() {
        let all = |[n, chamber, board, rate]: [f64; 4]| {
            let word = if n < 90.0 { "warm" } else { "hold" };
            format!(",{board:.2},{:.3},{},5.0,{:.4},{:.3},{word}", 32.0 + 1.8 * chamber, 1.0 + n, 4.85e-6 * rate, 0.01 * n)
        };
        let header = ",Board [degC],Oven 2 [degF],row,Vref,raw [rad/s],h,state";
        let full = record(header, all);
        assert_eq!(ids(std::slice::from_ref(&full), &[]), ["follows-board"]);
        // every record holds it, or none is told by it
        assert_eq!(ids(&[full.clone(), full.clone()], std::slice::from_ref(&full)), ["follows-board"]);
        let bare = record("", |_| String::new());
        assert!(ids(&[full.clone(), bare.clone()], &[]).is_empty() && ids(std::slice::from_ref(&full), &[bare]).is_empty());
        // one that another mechanism's file names is read
        let text = "time_s,chamber_c,spool_c,rate_deg_per_h,Board [degC]\n0,20,20,0,1\n60,20,20,0,2\n120,20,20,0,3\n";
        let named = check_record(Path::new("r.csv"), text.to_owned(), None, &["Board [degC]".to_owned()]).unwrap();
        assert!(ids(&[named], &[]).is_empty());
    }

    #[test]
    fn the_size_that_is_usual_goes_with_the_columns_unit_and_not_with_its_zero() {
        let scale = |header: &str, of: fn(f64) -> f64| {
            let own = of_columns(&[record(header, |[_, _, board, _]| format!(",{}", of(board)))], &[]);
            let [own] = &own[..] else { panic!("{header}") };
            let parameter = &own.mechanism.parameters[0];
            let diagnosis::Prior::Size { scale } = parameter.prior else { panic!("{parameter:?}") };
            (parameter.name.clone(), scale)
        };
        let (name, kelvin) = scale(",Board [degC]", |board| board);
        assert_eq!(name, "size_deg_per_h_per_k");
        let (volts, name_of_volts) = (scale(",\"Board (V)\"", |board| 5.0 - board / 100.0), "size_deg_per_h_per_v");
        assert!(volts.0 == name_of_volts && (volts.1 / kelvin / 100.0 - 1.0).abs() < 1e-9, "{volts:?}");
        // a unit that laws do not know is the column's own
        let (name, foreign) = scale(",Board [fortnights]", |board| 1e6 + board);
        assert!(name == "size_deg_per_h" && (foreign / kelvin - 1.0).abs() < 1e-6, "{name} {foreign}");
    }

    #[test]
    fn ids_are_words_and_each_is_one() {
        let mut taken = BTreeSet::new();
        let names = ["Board [degC]", "board", "T\u{e4}fel \u{3b1}", "[V]", "A very long name of a column that never ends"];
        let ids = names.map(|name| id(name, 3, &mut taken));
        assert_eq!(
            ids,
            ["follows-board", "follows-board-4", "follows-t-fel", "follows-column-4", "follows-a-very-long-name-of-a-co"]
        );
    }
}
