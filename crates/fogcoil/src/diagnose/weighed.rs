//! Columns of the records that nothing reads, each as a mechanism that is weighed: a rate that follows it.

use std::collections::BTreeSet;
use std::path::Path;

use bias::units::S_PER_MIN;
use files::{Note, Remark, shown};
use mechanisms::{Mechanism, RATE as RATE_CHANNEL, USUAL_NOISE, usual_coefficient};
use recording::check::white_noise;
use recording::statistics::robust_sd;
use recording::{Recording, median_interval};

use super::alike::{centred, repeats, sums};
use crate::input::{CHAMBER, MechanismCase, RATE, RecordCase, SPOOL, check_mechanism};

/// Most columns that are weighed, those that go with the rate most: each takes its time, and its share of what is likely beforehand.
const MOST: usize = 12;
/// Longest name in an id.
const LONGEST: usize = 24;
/// Least share of a record's rows in which a column has a value.
const FULL: f64 = 0.5;
/// Range of a column, as a share of its largest value, below which it is constant but for rounding.
const CONSTANT: f64 = 1e-9;
/// Standard deviation of the chamber about its mean, at least, that a column is compared with \[K\]: one at rest says nothing of a column's size.
const LIVELY_K: f64 = 1.0;
/// Standard errors by which chance alone puts a correlation off 0.
const BY_CHANCE: f64 = 5.0;
/// Correlation of a column's steps with those of the rate from which it is made from it: of a running mean it is 0.66, of a low-pass filter 0.9, of one of the
/// second order 0.7; a cause whose own fluctuations are much less than the rate's noise stays below.
const MADE: f64 = 0.5;
/// Rows by which a column that is made from the rate may be late or early.
const LATEST: isize = 16;
/// Robust standard deviations of a column's steps beyond which one is a switch's.
const SWITCHED: f64 = 4.0;

/// A column in the rows of all fitted records.
struct Column<'a> {
    name: &'a str,
    courses: Vec<&'a [f64]>,
}

impl Column<'_> {
    /// Whether it hardly moves beside its own size.
    fn is_constant(&self) -> bool {
        let known = || self.courses.iter().copied().flatten().filter(|value| value.is_finite());
        let [low, high] =
            known().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)]);
        high - low <= CONSTANT * low.abs().max(high.abs())
    }

    /// Whether it is a line of another series, record by record.
    fn repeats<'b>(&self, others: impl Iterator<Item = Option<&'b [f64]>>) -> bool {
        let both: Vec<_> = self.courses.iter().zip(others).filter_map(|(own, other)| Some((*own, other?))).collect();
        !both.is_empty() && repeats(both.into_iter())
    }

    /// Correlation with the rate.
    fn with_rate(&self, read: &[Recording]) -> f64 {
        let pairs = self.courses.iter().zip(read).filter_map(|(own, read)| Some(centred(own, &read.channel(RATE)?.values)));
        let [aa, ab, bb] = sums(&pairs.flatten().collect::<Vec<_>>());
        ab.abs() / (aa * bb).sqrt()
    }

    /// Whether it is made from the rate, as a filtered one is: from row to row it moves as the rate's white noise does.
    fn is_of_rate(&self, read: &[Recording]) -> bool {
        // fourth differences, which a slow course hardly touches: both may follow the same cause
        let fourth = |w: &[f64]| w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4];
        let steps = |series: &[f64]| series.windows(5).map(fourth).collect::<Vec<_>>();
        let own: Vec<Vec<f64>> = self.courses.iter().map(|course| steps(course)).collect();
        let known = || own.iter().flatten().copied().filter(|step| step.is_finite());
        // where a cause switches, the rate jumps with it: what is made from the rate moves in all rows alike
        let most = match SWITCHED * robust_sd(known(), 0.0).unwrap_or_default() {
            most if most > 0.0 => most,
            _ => f64::INFINITY,
        };
        let even = |steps: &[f64]| steps.iter().map(|step| if step.abs() <= most { *step } else { f64::NAN }).collect::<Vec<_>>();
        let both: Vec<(Vec<f64>, Vec<f64>)> =
            own.iter().zip(read).filter_map(|(own, read)| Some((even(own), steps(&read.channel(RATE)?.values)))).collect();
        // a mean about a row, or of rows before, is that much later or earlier
        (-LATEST..=LATEST).any(|late| {
            let [ahead, behind] = [late.max(0), (-late).max(0)].map(isize::unsigned_abs);
            let pairs = both.iter().filter_map(|(own, rate)| Some(centred(own.get(ahead..)?, rate.get(behind..)?)));
            let pairs: Vec<(f64, f64)> = pairs.flatten().collect();
            let [aa, ab, bb] = sums(&pairs);
            ab.abs() > MADE.max(BY_CHANCE / (pairs.len() as f64).sqrt()) * (aa * bb).sqrt()
        })
    }

    fn mean(&self) -> f64 {
        let known = || self.courses.iter().copied().flatten().filter(|value| value.is_finite());
        known().sum::<f64>() / known().count().max(1) as f64
    }

    /// The usual size of the rate for each unit of it \[deg/h\]: that of a temperature coefficient, were the column as lively as the chamber.
    fn usual_size(&self, read: &[Recording], minute: f64) -> f64 {
        let pairs = self.courses.iter().zip(read).filter_map(|(own, read)| Some(centred(own, &read.channel(CHAMBER)?.values)));
        let pairs: Vec<(f64, f64)> = pairs.flatten().collect();
        let [own, _, chamber] = sums(&pairs);
        usual_coefficient(minute) * (chamber.max(pairs.len() as f64 * LIVELY_K * LIVELY_K) / own).sqrt()
    }
}

/// White noise of the rate in a reading of a minute, by the quietest record \[deg/h\].
fn noise(read: &[Recording]) -> f64 {
    let of = |read: &Recording| {
        let rate = &read.channel(RATE)?.values;
        let used: Vec<bool> = rate.iter().map(|value| value.is_finite()).collect();
        let noise = white_noise(read.time(), rate, &used).filter(|noise| *noise > 0.0)?;
        Some(noise * (median_interval(read.time())? / S_PER_MIN).sqrt())
    };
    read.iter().filter_map(of).reduce(f64::min).unwrap_or(USUAL_NOISE[RATE_CHANNEL])
}

/// Records of a unit with the columns that nothing reads.
struct Unread {
    /// As a diagnosis has them.
    fits: Vec<Recording>,
    /// The columns that nothing reads, of the fitted records and of those held out.
    columns: [Vec<Recording>; 2],
}

impl Unread {
    fn of(fits: &[&RecordCase], holdouts: &[&RecordCase]) -> Self {
        // by name: the order of records says nothing
        let mut fits = fits.to_vec();
        fits.sort_by(|a, b| a.fingerprint.file.cmp(&b.fingerprint.file));
        let kept = |record: &&RecordCase| record.ignored.select(&record.report.rows);
        let columns = [&fits[..], holdouts].map(|records| records.iter().map(kept).collect());
        Self { fits: fits.iter().map(|record| record.report.used(&record.recording)).collect(), columns }
    }

    /// Columns of numbers that all records hold and that go their own way: neither constant nor a line of the time, of a temperature or of the rate. The second
    /// list has those that are made from the rate.
    fn columns(&self) -> [Vec<Column<'_>>; 2] {
        let [unread, held] = &self.columns;
        let course = |record: &Recording, name: &str| -> Option<usize> {
            let channel = record.channels().iter().position(|channel| channel.name == name)?;
            let values = &record.channels()[channel].values;
            let count = values.iter().filter(|value| value.is_finite()).count();
            (count as f64 >= FULL * values.len() as f64 && count > 0).then_some(channel)
        };
        let names = unread.first().map_or(&[][..], Recording::channels).iter().map(|channel| channel.name.as_str());
        let everywhere = |name: &str| -> Option<Vec<&[f64]>> {
            held.iter().map(|record| course(record, name)).collect::<Option<Vec<_>>>()?;
            unread.iter().map(|record| Some(record.channels()[course(record, name)?].values.as_slice())).collect()
        };
        let goes_its_own_way = |column: &Column| {
            let of =
                |other: &'static str| column.repeats(self.fits.iter().map(|read| Some(read.channel(other)?.values.as_slice())));
            !column.is_constant()
                && !column.repeats(self.fits.iter().map(|read| Some(read.time())))
                && ![CHAMBER, SPOOL, RATE].into_iter().any(of)
        };
        let columns = names.filter_map(|name| Some(Column { name, courses: everywhere(name)? })).filter(goes_its_own_way);
        let (of_rate, other) = columns.partition(|column| column.is_of_rate(&self.fits));
        [other, of_rate]
    }
}

/// A mechanism for every column of numbers that all records of a unit hold, that nothing else reads, and that goes its own way: it is neither constant nor
/// a line of the time, of a temperature, of the rate or of another column, nor made from the rate. Each adds a rate in proportion to its column. Their ids are
/// none of those `taken`.
pub fn of_columns(fits: &[RecordCase], holdouts: &[RecordCase], taken: &[&dyn Mechanism]) -> Vec<MechanismCase> {
    let unread = Unread::of(&fits.iter().collect::<Vec<_>>(), &holdouts.iter().collect::<Vec<_>>());
    let (read, [columns, _]) = (&unread.fits, unread.columns());
    let mut columns: Vec<(f64, Column)> = columns.into_iter().map(|column| (column.with_rate(read), column)).collect();
    columns.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.name.cmp(b.1.name)));
    let (noise, mut ids) = (noise(read), taken.iter().map(|own| own.facts().id.to_owned()).collect());
    let (mut chosen, mut all): (Vec<Column>, Vec<MechanismCase>) = (Vec::new(), Vec::new());
    for (_, column) in columns {
        let is_another = |other: &Column| column.repeats(other.courses.iter().map(|course| Some(*course)));
        if all.len() == MOST || chosen.iter().any(is_another) {
            continue;
        }
        let size = column.usual_size(read, noise);
        let own =
            (size.is_finite() && size > 0.0).then(|| mechanism(column.name, &id(column.name, &mut ids), size, column.mean()));
        all.extend(own.flatten());
        chosen.push(column);
    }
    all
}

/// The note that these are weighed, and which of the other columns are not because they are made from the rate, if there are any.
pub(super) fn note(columns: &[&MechanismCase], fits: &[&RecordCase], holdouts: &[RecordCase]) -> Option<Note> {
    let told = |names: Vec<&str>| {
        let quoted: Vec<String> = names.into_iter().map(|name| format!("`{}`", shown(name))).collect();
        Some(quoted.join(", ")).filter(|names| !names.is_empty())
    };
    let unread = Unread::of(fits, &holdouts.iter().collect::<Vec<_>>());
    let [_, of_rate] = unread.columns();
    let weighed = told(columns.iter().flat_map(|own| own.mechanism.columns()).collect()).map(|names| {
        format!("weighed beside the mechanisms: that the rate follows a column that the model does not use ({names})")
    });
    let left = told(of_rate.iter().map(|column| column.name).collect())
        .map(|names| format!("not weighed: {names}, which moves with the rate from row to row, as if made from it"));
    let parts: Vec<String> = weighed.into_iter().chain(left).collect();
    (!parts.is_empty()).then(|| Remark::WeighedColumn.note(parts.join("; ")))
}

/// `follows-` and the column's name without its unit, in small letters and hyphens; with a number where that is none, or another's.
fn id(name: &str, taken: &mut BTreeSet<String>) -> String {
    let bare = name.split(['[', '(']).next().unwrap_or_default().to_lowercase();
    let words = bare.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let mut words = words.collect::<Vec<_>>().join("-");
    words.truncate(LONGEST);
    let words = if words.is_empty() { "column" } else { words.trim_end_matches('-') };
    let plain = format!("follows-{words}");
    let mut numbered = (2..).map(|number| format!("{plain}-{number}"));
    let mut id = plain.clone();
    while !taken.insert(id.clone()) {
        id = numbered.next().unwrap_or_default();
    }
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
             at every instant.\",\n    inspection: {inspection:?},\n    source: \"a column of the record that the model of the coil does not use\",\n    parameters: [(name: \"{size}\", unit: {per:?}, prior: \
             Size({scale:e}))],\n    columns: [(name: \"column\", column: {name:?}, unit: {unit:?})],\n    laws: [Rate(\"{size} * (column - {mean:?})\")],\n)\n",
            size = id.replace('-', "_"),
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
        record_with(header, |_| 0.0, further)
    }

    /// The same with a rate by minutes added to the noise.
    fn record_with(header: &str, added: impl Fn(f64) -> f64, further: impl Fn([f64; 4]) -> String) -> RecordCase {
        let (mut spool, mut board, mut rows) = (20.0, 20.0, String::new());
        for n in 0..180 {
            let chamber = 20.0 + 30.0 * (f64::from(n) / 60.0).min(1.0) + 0.01 * f64::from(n % 3);
            spool += (chamber - spool) / 20.0;
            board += (chamber - board) / 80.0;
            let rate = 0.02 * f64::from(n * n * 37 % 101) + added(f64::from(n));
            let more = further([f64::from(n), chamber, board, rate]);
            rows += &format!("{},{chamber:.3},{spool:.3},{rate:.4}{more}\n", 60 * n);
        }
        check_record(Path::new("r.csv"), format!("time_s,chamber_c,spool_c,rate_deg_per_h{header}\n{rows}"), None, &[]).unwrap()
    }

    /// A number in 0 to 1 that has nothing to do with the next one's.
    fn random(n: f64) -> f64 {
        (43758.5453 * (12.9898 * n).sin()).rem_euclid(1.0)
    }

    fn ids(fits: &[RecordCase], holdouts: &[RecordCase]) -> Vec<String> {
        of_columns(fits, holdouts, &[]).iter().map(|own| own.mechanism.id.clone()).collect()
    }

    #[test]
    fn a_column_that_goes_its_own_way_is_weighed_and_no_other() {
        let all = |[n, chamber, board, rate]: [f64; 4]| {
            let word = if n < 90.0 { "warm" } else { "hold" };
            let [second, index, raw, clock] = [32.0 + 1.8 * chamber, 1.0 + n, 4.85e-6 * rate, 0.01 * n];
            format!(",{board:.2},{second:.3},{index},24.1,{raw:.4e},{clock:.3},{word},{:.2}", 1.8 * board + 32.0)
        };
        let header = ",Board [degC],Oven 2 [degF],row,Vref,raw [rad/s],h,state,Board [degF]";
        let full = record(header, all);
        let one = |record: &RecordCase| ids(std::slice::from_ref(record), &[]);
        assert_eq!(one(&full), ["follows-board"]);
        // every record holds it, or none is told by it
        assert_eq!(ids(&[full.clone(), full.clone()], std::slice::from_ref(&full)), ["follows-board"]);
        let empty = record(",Board [degC]", |[n, ..]| if n < 5.0 { ",20".to_owned() } else { ",".to_owned() });
        for bare in [record("", |_| String::new()), empty] {
            assert!(ids(&[full.clone(), bare.clone()], &[]).is_empty() && ids(std::slice::from_ref(&full), &[bare]).is_empty());
        }
        // a mean of ten readings of the rate, beside the board
        let passed = std::cell::RefCell::new(Vec::new());
        let filtered = record(",filtered,Board [degC]", |[_, _, board, rate]| {
            passed.borrow_mut().push(rate);
            let last = passed.borrow();
            let last = &last[last.len().saturating_sub(10)..];
            format!(",{:.4},{board:.2}", last.iter().sum::<f64>() / last.len() as f64)
        });
        assert_eq!(one(&filtered), ["follows-board"]);
        // a mean of eleven readings about each row: no reading of it is of its own row alone
        let about = |added: fn(f64) -> f64| {
            record_with(",about,Board [degC]", added, move |[n, _, board, _]| {
                let mean = (-5..=5).map(|k| random(n + f64::from(k))).sum::<f64>() / 11.0;
                format!(",{mean:.5},{board:.2}")
            })
        };
        assert_eq!(one(&about(|n| 20.0 * random(n))), ["follows-board"]);
        assert_eq!(one(&about(|n| 20.0 * random(n + 500.0))), ["follows-about", "follows-board"]);
        // of very many a few
        let many: Vec<String> = (0..20).map(|k| format!("c{k:02}")).collect();
        let many = record(&format!(",{}", many.join(",")), |[n, ..]| {
            (0..20).map(|k| format!(",{:.4}", (n / (5.0 + 3.0 * f64::from(k))).sin())).collect()
        });
        assert_eq!(one(&many).len(), MOST);
        // one that another mechanism's file names is read
        let text = "time_s,chamber_c,spool_c,rate_deg_per_h,Board [degC]\n0,20,20,0,1\n60,20,20,0,2\n120,20,20,0,3\n";
        let named = check_record(Path::new("r.csv"), text.to_owned(), None, &["Board [degC]".to_owned()]).unwrap();
        assert!(ids(&[named], &[]).is_empty());
    }

    #[test]
    fn a_cause_that_switches_is_weighed_though_the_rate_jumps_with_it() {
        // its own fluctuations act on the rate, too
        let field = |n: f64| 3.2 * random(n) + if n.rem_euclid(40.0) < 20.0 { 0.0 } else { 20.0 };
        // beside the rate's own noise of 0.6 deg/h; the filtered reading of that is made from it, and the note says so
        let last = std::cell::Cell::new(0.0);
        let text = |[n, _, _, rate]: [f64; 4]| {
            last.set(0.7 * last.get() + 0.3 * rate);
            format!(",{:.3},{:.4}", field(n), last.get())
        };
        let case = record_with(",B [uT],smooth", |n| 0.3 * field(n), text);
        let own = of_columns(std::slice::from_ref(&case), &[], &[]);
        assert_eq!(own.iter().map(|own| own.mechanism.id.as_str()).collect::<Vec<_>>(), ["follows-b"]);
        let note = note(&own.iter().collect::<Vec<_>>(), &[&case], &[]).unwrap();
        assert!(note.text.contains("(`B [uT]`); not weighed: `smooth`"), "{note:?}");
    }

    #[test]
    fn the_size_that_is_usual_goes_with_the_columns_unit_and_not_with_its_zero() {
        let scale = |header: &str, of: fn(f64) -> f64| {
            let own = of_columns(&[record(header, |[_, _, board, _]| format!(",{}", of(board)))], &[], &[]);
            let [own] = &own[..] else { panic!("{header}") };
            let parameter = &own.mechanism.parameters[0];
            let diagnosis::Prior::Size { scale } = parameter.prior else { panic!("{parameter:?}") };
            (parameter.name.clone(), scale)
        };
        let (name, kelvin) = scale(",Board [degC]", |board| board);
        assert_eq!(name, "follows_board_deg_per_h_per_k");
        let (volts, name_of_volts) = (scale(",\"Board (V)\"", |board| 5.0 - board / 100.0), "follows_board_deg_per_h_per_v");
        assert!(volts.0 == name_of_volts && (volts.1 / kelvin / 100.0 - 1.0).abs() < 1e-9, "{volts:?}");
        // a unit that laws do not know is the column's own
        let (name, foreign) = scale(",Board [fortnights]", |board| 1e6 + board);
        assert!(name == "follows_board_deg_per_h" && (foreign / kelvin - 1.0).abs() < 1e-6, "{name} {foreign}");
    }

    #[test]
    fn ids_are_words_and_each_is_one() {
        let mut taken = BTreeSet::from(["follows-ub".to_owned()]);
        let names = [
            "Board 2",
            "board",
            "Board [degC]",
            "T\u{e4}fel \u{3b1}",
            "[V]",
            "Ub [V]",
            "A very long name of a column that never ends",
        ];
        let ids = names.map(|name| id(name, &mut taken));
        let long = "follows-a-very-long-name-of-a-co";
        let each =
            ["follows-board-2", "follows-board", "follows-board-3", "follows-t-fel", "follows-column", "follows-ub-2", long];
        assert_eq!(ids, each);
    }

    #[test]
    fn whatever_a_column_is_called() {
        for name in ["a\\b", "\"\"q\"\"", "\u{1b}[31m", "a{b}", &"x".repeat(3000), "\u{202e}rtl"] {
            let made = of_columns(&[record(&format!(",\"{name}\""), |[_, _, board, _]| format!(",{board}"))], &[], &[]);
            assert!(made.len() <= 1 && made.iter().all(|own| own.mechanism.id.len() <= 40), "{name}");
        }
    }
}
