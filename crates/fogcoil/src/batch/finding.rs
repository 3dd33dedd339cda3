//! Finding of a unit's records: figures and diagnosis, as one object.

use std::path::PathBuf;

use files::Remark;
use progress::Step;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::units::Unit;
use crate::Error;
use crate::cache::Cache;
use crate::diagnose::{diagnose, of_columns};
use crate::input::{Asked, CoilCase, RecordCase, RecordOptions, hexadecimal, read_record};
use crate::measure::{self, Figure, Measurement, Prediction, Told, measure};

/// Inputs that all units share.
pub struct Inputs<'a> {
    /// The design.
    pub case: &'a CoilCase,
    /// The mechanisms to weigh.
    pub asked: &'a Asked,
    /// Options for reading records.
    pub options: &'a RecordOptions,
    /// Cache of the design's models.
    pub cache: &'a Cache,
    /// Prediction of the design.
    pub prediction: &'a Prediction,
}

/// A unit whose records have been read.
pub(super) struct Read {
    pub(super) name: String,
    /// Its lot where no meta file tells one.
    pub(super) lot: Option<String>,
    fits: Vec<RecordCase>,
    holdouts: Vec<RecordCase>,
    /// SHA-256 of all inputs of its finding.
    pub(super) key: String,
}

impl Inputs<'_> {
    /// Reads the records of a unit, for the program of this hash.
    ///
    /// # Errors
    /// [`files::Error::Input`] of a record that cannot be used.
    pub(super) fn read(&self, unit: &Unit, program: &str) -> Result<Read, Error> {
        let read = |paths: &[PathBuf]| -> Result<Vec<RecordCase>, Error> {
            let of = |path: &PathBuf| {
                let record = read_record(path, self.options)?;
                record.require_usable()?;
                Ok(record)
            };
            paths.iter().map(of).collect()
        };
        let (fits, holdouts) = (read(&unit.fits)?, read(&unit.holdouts)?);
        let mut hash = Sha256::new().chain_update(format!("{program}\n{}\n", unit.name));
        self.case.fingerprints.iter().for_each(|file| hash.update(&file.sha256));
        self.asked.own.iter().for_each(|own| hash.update(own.fingerprint().sha256));
        hash.update(format!("{:?}\n", self.asked.with_catalogue().iter().map(|m| m.facts().id).collect::<Vec<_>>()));
        for (record, role) in fits.iter().map(|r| (r, "fit")).chain(holdouts.iter().map(|r| (r, "holdout"))) {
            // how it is read is in what is read: instants, values, what is known of it
            hash.update(format!("{role} {} {:?} {}\n", record.fingerprint.sha256, record.meta, record.averaging));
            let channels = record.recording.channels().iter().map(|channel| channel.values.as_slice());
            for number in std::iter::once(record.recording.time()).chain(channels).flatten() {
                hash.update(number.to_bits().to_le_bytes());
            }
        }
        let key = hexadecimal(&hash.finalize());
        Ok(Read { name: unit.name.clone(), lot: unit.lot.clone(), fits, holdouts, key })
    }

    /// The finding of its records, and the page of its diagnosis, if there is one.
    pub(super) fn find(&self, unit: &Read, progress: &(dyn Fn(Step) + Sync)) -> (Value, Option<String>) {
        let records = || unit.fits.iter().chain(&unit.holdouts);
        let measured = self.measured(unit);
        let mechanisms = self.asked.with_catalogue();
        let columns = of_columns(&unit.fits, &unit.holdouts, &mechanisms);
        let diagnosis = diagnose(self.case, &mechanisms, &columns, &unit.fits, &unit.holdouts, self.cache, progress);
        let (told, left, page, problem) = match &diagnosis {
            Ok(outcome) => {
                let page = titled(&outcome.report(), &unit.name, &self.case.name);
                (outcome.json(), json!(outcome.left_of_rate()), Some(page), None)
            }
            Err(error) => (Value::Null, Value::Null, None, Some(error.to_string())),
        };
        let meta = |of: &dyn Fn(&crate::input::Meta) -> Option<Value>| records().find_map(|r| of(r.meta.as_ref()?));
        let finding = json!({
            "key": unit.key,
            "program": format!("fogcoil {}", env!("CARGO_PKG_VERSION")),
            "unit": unit.name,
            "serial": meta(&|meta| Some(meta.serial.as_ref()?.0.clone().into())),
            "lot": meta(&|meta| Some(meta.lot.as_ref()?.0.clone().into())),
            "date": meta(&|meta| Some(meta.date.clone()).filter(|date| !date.is_empty()).map(Value::from)),
            "files": records().map(|r| r.fingerprint.file.display().to_string()).collect::<Vec<_>>(),
            "sha256": records().map(|r| r.fingerprint.sha256.clone()).collect::<Vec<_>>(),
            "measured": measured,
            "diagnosis": told,
            "left": left,
            "problem": problem,
        });
        (finding, page)
    }

    /// The figures of the unit: one that was held out of the fit is measured as well.
    fn measured(&self, unit: &Read) -> Value {
        let all: Vec<Measurement> = unit.fits.iter().chain(&unit.holdouts).filter_map(|record| measure(record).ok()).collect();
        of_unit(&all).map_or(Value::Null, |mut figures| {
            let doubt = self.prediction.other_unit(&figures);
            figures.notes.splice(0..0, doubt);
            measure::json(&figures, Some(self.prediction))
        })
    }
}

/// Each figure of the record that tells it best: of the narrowest interval. The peak is the largest of all records, so that units whose records tell the
/// sensitivity equally well are compared at the same turn of the programme; the bias over temperature is one of the records that cover about the widest range,
/// and an upper bound of the bias instability gives way to a floor. What else is told is of the record that tells the sensitivity best, of the first where none
/// tells it.
fn of_unit(all: &[Measurement]) -> Option<Measurement> {
    let best = |of: fn(&Measurement) -> &Told| best_of(all.iter(), of, absolute);
    let sensitivity = best(|m| &m.sensitivity)?;
    let size = |m: &Measurement| m.peak.as_ref().map_or(0.0, |peak| peak.value.abs());
    let highest = all.iter().fold(sensitivity, |highest, m| if size(m) > size(highest) { m } else { highest });
    let (peak, peak_time, peak_under) = (highest.peak.clone(), highest.peak_time, highest.peak_under);
    // a record that does not tell the bias over temperature is no measure of those that do
    let widest = all.iter().filter(|m| m.bias_span.is_ok()).filter_map(|m| m.span_range).fold(0.0, f64::max);
    let wide = || all.iter().filter(|m| m.span_range.is_some_and(|range| range >= WIDE * widest));
    let span = best_of(wide(), |m| &m.bias_span, upper).unwrap_or(sensitivity);
    let hysteresis = best_of(wide(), |m| &m.hysteresis, absolute).filter(|m| m.hysteresis.is_ok());
    let floors = all.iter().filter(|m| !m.floor_is_bound && m.bias_instability.is_ok());
    let floor =
        best_of(floors, |m| &m.bias_instability, ratio).or_else(|| best_of(all.iter(), |m| &m.bias_instability, ratio))?;
    let mut unit = Measurement {
        heating: best(|m| &m.heating)?.heating.clone(),
        cooling: best(|m| &m.cooling)?.cooling.clone(),
        asymmetry: best(|m| &m.asymmetry)?.asymmetry.clone(),
        hysteresis: hysteresis.or_else(|| best(|m| &m.hysteresis))?.hysteresis.clone(),
        bias_span: span.bias_span.clone(),
        span_range: span.span_range,
        peak,
        peak_time,
        peak_under,
        arw: best_of(all.iter(), |m| &m.arw, ratio)?.arw.clone(),
        bias_instability: floor.bias_instability.clone(),
        floor_time: floor.floor_time,
        floor_is_bound: floor.floor_is_bound,
        ..sensitivity.clone()
    };
    unit.notes.retain(|note| note.remark != Remark::NotMeasured);
    unit.notes.extend(unit.not_measured());
    Some(unit)
}

/// Share of the widest range of temperatures from which a record's bias over temperature may be that of the unit: over less, a parabola makes about half of it.
const WIDE: f64 = 0.75;

/// Width of an interval.
fn absolute(figure: &Figure) -> f64 {
    figure.ci90[1] - figure.ci90[0]
}

/// The same of a figure whose lower end may be cut at 0.
fn upper(figure: &Figure) -> f64 {
    figure.ci90[1] - figure.value
}

/// The same of a figure that is known to a share of itself: the quietest record would always be the best.
fn ratio(figure: &Figure) -> f64 {
    let [low, high] = figure.ci90;
    if low > 0.0 { (high / low).ln() } else { f64::INFINITY }
}

/// The record that tells a figure best: by the least `width` of its interval, else by its value alone; the first of equals.
fn best_of<'a>(
    all: impl Iterator<Item = &'a Measurement>,
    of: fn(&Measurement) -> &Told,
    width: fn(&Figure) -> f64,
) -> Option<&'a Measurement> {
    let rank = |m: &Measurement| match of(m) {
        Ok(figure) => (0, width(figure)),
        Err(untold) => (if untold.value.is_some() { 1 } else { 2 }, 0.0),
    };
    all.min_by(|a, b| {
        let ((a, of_a), (b, of_b)) = (rank(a), rank(b));
        a.cmp(&b).then(of_a.total_cmp(&of_b))
    })
}

/// The page of a unit, which is that of a diagnosis of the design, under the unit's name.
fn titled(page: &str, unit: &str, design: &str) -> String {
    let [unit, design] = [unit, design].map(|name| maud::html! { (name) }.into_string());
    ["<title>", "<h1>"]
        .iter()
        .fold(page.to_owned(), |page, mark| page.replacen(&format!("{mark}{design}: "), &format!("{mark}{unit} ({design}): "), 1))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::input::check_record;

    #[test]
    fn a_units_peak_is_that_of_all_its_records_whichever_tells_the_sensitivity_best() {
        let rows: String = (0..40).map(|n| format!("{},20,20,{}\n", 30 * n, n * n % 7)).collect();
        let record =
            check_record(Path::new("r.csv"), "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows, None, &[]).unwrap();
        let measured = measure(&record).unwrap();
        let of = |sd: f64, peak: Option<(f64, f64)>| {
            let told = |value: f64, sd: f64| Figure { value, ci90: [value - sd, value + sd] };
            Measurement {
                sensitivity: Ok(told(-2.8, sd)),
                peak: peak.map_or_else(|| Err("it moved".to_owned().into()), |(value, _)| Ok(told(value, 0.1))),
                peak_time: peak.map(|(_, time)| time),
                ..measured.clone()
            }
        };
        let (slow, fast, none) = (of(0.1, Some((2.7, 100.0))), of(0.2, Some((-4.9, 500.0))), of(0.05, None));
        let peak = |all: &[Measurement]| of_unit(all).map(|unit| (unit.peak.map(|peak| peak.value).ok(), unit.peak_time));
        for all in [[slow.clone(), fast.clone()], [fast.clone(), slow.clone()], [none.clone(), fast.clone()]] {
            assert_eq!(peak(&all), Some((Some(-4.9), Some(500.0))));
        }
        let unit = of_unit(&[fast, slow, none.clone()]).unwrap();
        assert_eq!(unit.sensitivity.unwrap().ci90, none.sensitivity.clone().unwrap().ci90);
        assert!(peak(&[none]) == Some((None, None)) && of_unit(&[]).is_none());
    }

    #[test]
    fn each_figure_of_a_unit_is_that_of_the_record_that_tells_it_best() {
        let rows: String = (0..40).map(|n| format!("{},20,20,{}\n", 30 * n, n * n % 7)).collect();
        let record =
            check_record(Path::new("r.csv"), "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows, None, &[]).unwrap();
        let measured = measure(&record).unwrap();
        let told = |value: f64, sd: f64| Ok(Figure { value, ci90: [value - sd, value + sd] });
        let of = |sensitivity: f64, span: f64, range: f64| Measurement {
            sensitivity: told(-2.8, sensitivity),
            bias_span: told(0.05, span),
            span_range: Some(range),
            ..measured.clone()
        };
        let [ramps, rests, narrow] = [of(0.1, 0.05, 100.0), of(0.2, 0.01, 95.0), of(0.3, 0.001, 40.0)];
        for all in [[ramps.clone(), rests.clone(), narrow.clone()], [narrow.clone(), rests.clone(), ramps.clone()]] {
            let unit = of_unit(&all).unwrap();
            assert_eq!((&unit.sensitivity, &unit.bias_span), (&ramps.sensitivity, &rests.bias_span));
        }
        // noise is known to a share of itself: the quieter record is not the better one; over a fifth of the range hysteresis is another
        let of = |arw: (f64, f64), hysteresis: f64, range: f64| Measurement {
            arw: told(arw.0, arw.1),
            hysteresis: told(hysteresis, hysteresis / 10.0),
            span_range: Some(range),
            ..ramps.clone()
        };
        let [quiet, sure] = [of((0.01, 0.001), 0.01, 20.0), of((0.02, 0.0018), 0.2, 100.0)];
        let unit = of_unit(&[quiet, sure.clone()]).unwrap();
        assert_eq!((&unit.arw, &unit.hysteresis), (&sure.arw, &sure.hysteresis));
        // what another record tells is told, and no note says that it is not
        let why = || Err("it moved".to_owned().into());
        let [untold, floor] = [
            Measurement {
                bias_span: why(),
                hysteresis: why(),
                bias_instability: told(0.001, 1e-4),
                floor_is_bound: true,
                ..ramps
            },
            Measurement { hysteresis: told(0.1, 0.01), bias_instability: told(0.002, 5e-4), floor_is_bound: false, ..rests },
        ];
        let unit = of_unit(&[untold, floor.clone()]).unwrap();
        assert_eq!((&unit.bias_span, &unit.hysteresis), (&floor.bias_span, &floor.hysteresis));
        assert!(unit.bias_instability == floor.bias_instability && !unit.floor_is_bound);
        assert!(!unit.notes.iter().any(|note| note.to_string().contains("bias_span") || note.to_string().contains("hysteresis")));
    }

    #[test]
    fn a_units_page_begins_with_its_name() {
        let page = "<title>a &amp; b: unknown</title><h1>a &amp; b: unknown</h1><p>a &amp; b: unknown</p>";
        let titled = super::titled(page, "L1-09", "a & b");
        assert_eq!(
            titled,
            "<title>L1-09 (a &amp; b): unknown</title><h1>L1-09 (a &amp; b): unknown</h1><p>a &amp; b: unknown</p>"
        );
    }
}
