//! Changes that must not change an answer: another offset, another unit, another sampling.

use std::path::Path;

use fogcoil::input::CoilCase;

use crate::{Failure, files};

/// A change of a unit's records that says nothing of the coil.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    /// 10 deg/h more in the rate, as of Earth.
    MoreRate,
    /// The chamber's thermometer 1 K higher, the spool's 1 K lower.
    Thermometers,
    /// Rates twelve times as large, with a Sagnac diameter of a twelfth.
    OtherScale,
    /// Every second row.
    EverySecondRow,
}

const FACTOR: f64 = 12.0;
/// Code that loggers write for an overload; it has no unit.
const CODE: f64 = 9999.0;

impl Change {
    pub(super) const ALL: [Self; 4] = [Self::MoreRate, Self::Thermometers, Self::OtherScale, Self::EverySecondRow];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::MoreRate => "10 deg/h more",
            Self::Thermometers => "thermometers 1 K off",
            Self::OtherScale => "rates x 12, Sagnac diameter / 12",
            Self::EverySecondRow => "every second row",
        }
    }

    /// The name of its folder.
    pub(super) fn folder(self) -> &'static str {
        match self {
            Self::MoreRate => "more-rate",
            Self::Thermometers => "thermometers",
            Self::OtherScale => "other-scale",
            Self::EverySecondRow => "every-second-row",
        }
    }

    /// The drawing that goes with the changed records.
    pub(super) fn drawing(self, coil: CoilCase) -> CoilCase {
        let mut coil = coil;
        if self == Self::OtherScale {
            coil.design.optics.sagnac_diameter /= FACTOR;
        }
        coil
    }

    /// Writes the changed records of a unit and what is known of them into another folder.
    pub(super) fn write(self, records: &[&str], from: &Path, into: &Path) -> Result<(), Failure> {
        let mut all = Vec::new();
        for name in records {
            let changed = self.record(&files::read(&from.join(name))?).map_err(|Failure(f)| Failure(format!("{name}: {f}")))?;
            all.push((into.join(name), changed));
        }
        let meta = files::read(&from.join("meta.ron"))?;
        all.push((into.join("meta.ron"), if self == Self::OtherScale { scaled_meta(&meta) } else { meta }));
        files::write_all(&all)
    }

    /// A record `time_s,chamber_c,spool_c,rate_deg_per_h` changed.
    fn record(self, text: &str) -> Result<String, Failure> {
        let mut lines = text.lines();
        let mut changed = lines.next().unwrap_or_default().to_owned() + "\n";
        for (row, line) in lines.enumerate() {
            if self == Self::EverySecondRow && row % 2 == 1 {
                continue;
            }
            let fields: Vec<&str> = line.split(',').collect();
            let &[time, chamber, spool, rate] = fields.as_slice() else { return Err(Failure(format!("row {row}: {line:?}"))) };
            let moved = |field: &str, by: &dyn Fn(f64) -> f64| match field.trim().parse::<f64>() {
                Ok(value) if value.abs() < CODE => by(value).to_string(),
                _ => field.to_owned(),
            };
            let [chamber, spool, rate] = match self {
                Self::MoreRate => [chamber.to_owned(), spool.to_owned(), moved(rate, &|r| r + 10.0)],
                Self::Thermometers => [moved(chamber, &|t| t + 1.0), moved(spool, &|t| t - 1.0), rate.to_owned()],
                Self::OtherScale => [chamber.to_owned(), spool.to_owned(), moved(rate, &|r| FACTOR * r)],
                Self::EverySecondRow => [chamber, spool, rate].map(str::to_owned),
            };
            changed += &format!("{time},{chamber},{spool},{rate}\n");
        }
        Ok(changed)
    }
}

/// The angle random walk of a data sheet in the other scale.
fn scaled_meta(meta: &str) -> String {
    let scaled = |line: &str| -> Option<String> {
        let (key, value) = line.split_once("nominal_arw_deg_per_sqrt_h: Some(")?;
        let (value, rest) = value.split_once(')')?;
        Some(format!("{key}nominal_arw_deg_per_sqrt_h: Some({:?}){rest}", FACTOR * value.parse::<f64>().ok()?))
    };
    meta.lines().map(|line| scaled(line).unwrap_or_else(|| line.to_owned()) + "\n").collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECORD: &str = "time_s,chamber_c,spool_c,rate_deg_per_h\n0,20,21,5\n60,20.5,21,9999\n120,21,,6\n";

    #[test]
    fn records_are_changed_and_codes_are_not() {
        let of = |change: Change| change.record(RECORD).unwrap().lines().skip(1).collect::<Vec<_>>().join(" ");
        assert_eq!(of(Change::MoreRate), "0,20,21,15 60,20.5,21,9999 120,21,,16");
        assert_eq!(of(Change::Thermometers), "0,21,20,5 60,21.5,20,9999 120,22,,6");
        assert_eq!(of(Change::OtherScale), "0,20,21,60 60,20.5,21,9999 120,21,,72");
        assert_eq!(of(Change::EverySecondRow), "0,20,21,5 120,21,,6");
        assert!(Change::MoreRate.record("head\n1,2\n").is_err());
    }

    #[test]
    fn a_data_sheet_s_noise_has_the_scale_of_the_rate() {
        let meta = "(\n    sample_interval_s: 60.0,\n    nominal_arw_deg_per_sqrt_h: Some(0.008),   // data sheet\n)\n";
        assert_eq!(scaled_meta(meta), meta.replace("0.008", "0.096"));
    }
}
