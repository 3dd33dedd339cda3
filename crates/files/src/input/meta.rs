//! Facts about a record besides its columns: `meta.ron` beside it.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, de};

use super::InputError;
use super::quantity::NotNegative;
use super::source::Source;

/// Content of a meta file; everything may be left out.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Meta {
    /// Name of the design that the unit was built to.
    pub design: String,
    /// Serial number of the unit, as it is written: 1847, or "A-0042".
    pub serial: Option<Serial>,
    /// Lot of the unit, as it is written: 7, or "L-07"; of a batch the folder in which the unit's own lies if it is left out.
    pub lot: Option<Serial>,
    /// Date of the recording, e.g. "2026-03-02".
    pub date: String,
    /// Seconds over which a rate is the mean, up to its instant: the interval between rows \[s\]. It rules out stamps at the middle or the start of a row; 0 if it is not given.
    #[schemars(with = "NotNegative")]
    pub sample_interval_s: f64,
    /// Meaning of a row's rate, in words.
    pub rate_is: String,
    /// The thermometers.
    pub temperature_sensor: TemperatureSensor,
    /// Angle random walk from a bench test \[deg/√h\].
    #[schemars(with = "Option<NotNegative>")]
    pub nominal_arw_deg_per_sqrt_h: Option<f64>,
    /// The chamber's thermometer and its log.
    pub chamber_c: Thermometer,
    /// The spool's thermometer.
    pub spool_c: Thermometer,
    /// The gyroscope.
    pub rate_deg_per_h: Rate,
}

/// A serial number, of a unit or a lot: a number or a text, whose digits stay as they are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Serial(pub String);

impl<'de> Deserialize<'de> for Serial {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let raw = Box::<ron::value::RawValue>::deserialize(from)?;
        let written = raw.get_ron().trim();
        let text = if written.starts_with(|c: char| c.is_ascii_digit()) {
            Some(written.to_owned())
        } else {
            ron::from_str(written).ok()
        };
        let serial = text.filter(|text| !text.is_empty() && !text.contains(char::is_control));
        let problem = format!("{written} is no serial number");
        let remedy = "give a number or a text, e.g. Some(1847) or Some(\"A-0042\")";
        serial.map(Self).ok_or_else(|| de::Error::invalid_value(de::Unexpected::Other(&problem), &remedy))
    }
}

impl JsonSchema for Serial {
    fn schema_name() -> Cow<'static, str> {
        "Serial".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": ["integer", "string"]})
    }
}

/// A thermometer as its certificate has it, standard deviations; where nothing is given, a wide one stands.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Thermometer {
    /// Uncertainty of its offset \[°C\]; it counts where it is given of both thermometers.
    #[schemars(with = "Option<NotNegative>")]
    pub offset_sd: Option<f64>,
    /// Uncertainty of its gain, relative.
    #[schemars(with = "Option<NotNegative>")]
    pub gain_sd: Option<f64>,
    /// Its time constant \[s\], known to a fifth; of the spool's it counts where the design's is above 0.
    #[schemars(with = "Option<NotNegative>")]
    pub lag_s: Option<f64>,
    /// Uncertainty of its clock \[s\].
    #[schemars(with = "Option<NotNegative>")]
    pub clock_offset_sd_s: Option<f64>,
    /// Its last digit \[°C\].
    #[schemars(with = "Option<NotNegative>")]
    pub resolution: Option<f64>,
    /// Standard deviation of a reading \[°C\].
    #[schemars(with = "Option<NotNegative>")]
    pub noise: Option<f64>,
}

/// A gyroscope as its data sheet has it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Rate {
    /// Uncertainty of its bias \[deg/h\], a standard deviation; it counts where Earth's rate is known.
    #[schemars(with = "Option<NotNegative>")]
    pub offset_sd: Option<f64>,
    /// Uncertainty of its scale factor, relative, a standard deviation.
    #[schemars(with = "Option<NotNegative>")]
    pub scale_factor_sd: Option<f64>,
    /// Uncertainty of its clock \[s\], a standard deviation.
    #[schemars(with = "Option<NotNegative>")]
    pub clock_offset_sd_s: Option<f64>,
    /// Earth's rate along its axis \[deg/h\], as the record has it.
    pub earth_rate_deg_per_h: Option<f64>,
    /// Latitude of the laboratory \[deg\], north positive: Earth's rate follows from it and the axis, which is needed with it.
    pub latitude_deg: Option<f64>,
    /// Direction of the axis from north, east positive \[deg\]; of a vertical axis it is not needed.
    pub azimuth_deg: Option<f64>,
    /// How far the axis points up from the horizon \[deg\].
    pub elevation_deg: Option<f64>,
}

/// Earth's rotation \[deg/h\]: 7.292115e-5 rad/s (WGS 84).
const EARTH: f64 = 15.041_067;

impl Rate {
    fn is_vertical(&self) -> bool {
        self.elevation_deg.is_some_and(|elevation| elevation.abs() == 90.0)
    }

    /// Earth's rate along the axis \[deg/h\], where it is known.
    pub fn earth(&self) -> Option<f64> {
        // of a vertical axis no direction is needed
        let azimuth = self.azimuth_deg.or(self.is_vertical().then_some(0.0));
        let axis = azimuth.zip(self.elevation_deg);
        let of = |(azimuth, elevation): (f64, f64)| {
            let latitude = self.latitude_deg?.to_radians();
            let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
            Some(EARTH * (latitude.cos() * azimuth.cos() * elevation.cos() + latitude.sin() * elevation.sin()))
        };
        self.earth_rate_deg_per_h.or(axis.and_then(of))
    }
}

impl Meta {
    /// Last digits of the chamber's and the spool's thermometer \[°C\], where they are known.
    pub fn resolutions(&self) -> [Option<f64>; 2] {
        let sensor = &self.temperature_sensor;
        let known = |own: Option<f64>, usual: f64| own.or(Some(usual)).filter(|digit| *digit > 0.0);
        [
            known(self.chamber_c.resolution, sensor.chamber_quantisation_c),
            known(self.spool_c.resolution, sensor.spool_quantisation_c),
        ]
    }
}

/// The thermometers of a record; 0 where nothing is known.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TemperatureSensor {
    /// Standard deviation of a reading \[°C\].
    #[schemars(with = "NotNegative")]
    pub noise_c: f64,
    /// Resolution of the chamber's \[°C\].
    #[schemars(with = "NotNegative")]
    pub chamber_quantisation_c: f64,
    /// Resolution of the spool's \[°C\].
    #[schemars(with = "NotNegative")]
    pub spool_quantisation_c: f64,
}

/// Longest interval between rows \[s\]: thirty years.
pub(super) const MOST_INTERVAL_S: f64 = 1e9;

/// The content of a meta file, checked.
pub(super) fn checked(source: &Source) -> Result<Meta, InputError> {
    let meta: Meta = source.parse(None)?;
    let sensor = &meta.temperature_sensor;
    let mut values = vec![
        ("temperature_sensor.noise_c".to_owned(), sensor.noise_c),
        ("temperature_sensor.chamber_quantisation_c".to_owned(), sensor.chamber_quantisation_c),
        ("temperature_sensor.spool_quantisation_c".to_owned(), sensor.spool_quantisation_c),
        ("nominal_arw_deg_per_sqrt_h".to_owned(), meta.nominal_arw_deg_per_sqrt_h.unwrap_or(0.0)),
    ];
    let rate = &meta.rate_deg_per_h;
    let of_rate =
        [("offset_sd", rate.offset_sd), ("scale_factor_sd", rate.scale_factor_sd), ("clock_offset_sd_s", rate.clock_offset_sd_s)];
    values.extend(of_rate.map(|(field, value)| (format!("rate_deg_per_h.{field}"), value.unwrap_or(0.0))));
    for (name, t) in [("chamber_c", &meta.chamber_c), ("spool_c", &meta.spool_c)] {
        let of_thermometer = [
            ("offset_sd", t.offset_sd),
            ("gain_sd", t.gain_sd),
            ("lag_s", t.lag_s),
            ("clock_offset_sd_s", t.clock_offset_sd_s),
            ("resolution", t.resolution),
            ("noise", t.noise),
        ];
        values.extend(of_thermometer.map(|(field, value)| (format!("{name}.{field}"), value.unwrap_or(0.0))));
    }
    check_axis(source, rate)?;
    if !(0.0..=MOST_INTERVAL_S).contains(&meta.sample_interval_s) {
        let problem = format!("{:e} s is not an interval of 0 to {MOST_INTERVAL_S:e} s", meta.sample_interval_s);
        return Err(source.fault(
            "sample_interval_s",
            problem,
            "give the seconds over which a rate is a mean, or leave the field out",
        ));
    }
    match values.into_iter().find(|(_, value)| !(*value >= 0.0 && value.is_finite())) {
        Some((field, value)) => {
            Err(source.fault(&field, format!("{value} is not 0 or more"), "give the value, or leave the field out"))
        }
        None => Ok(meta),
    }
}

/// Refuses an axis that cannot be, or is told twice.
fn check_axis(source: &Source, rate: &Rate) -> Result<(), InputError> {
    let given = [
        ("earth_rate_deg_per_h", rate.earth_rate_deg_per_h, EARTH),
        ("latitude_deg", rate.latitude_deg, 90.0),
        ("azimuth_deg", rate.azimuth_deg, 360.0),
        ("elevation_deg", rate.elevation_deg, 90.0),
    ];
    let beyond = |(_, value, most): &(&str, Option<f64>, f64)| value.is_some_and(|value| !(-most..=*most).contains(&value));
    if let Some((field, value, most)) = given.into_iter().find(beyond) {
        let problem = format!("{} lies outside -{most} to {most}", value.unwrap_or(f64::NAN));
        return Err(source.fault(&format!("rate_deg_per_h.{field}"), problem, "give the value, or leave the field out"));
    }
    let mut axis = [rate.latitude_deg, rate.azimuth_deg, rate.elevation_deg].map(|angle| angle.is_some());
    axis[1] |= rate.is_vertical();
    if axis.contains(&true) && axis.contains(&false) {
        let remedy = "give latitude_deg, azimuth_deg and elevation_deg, or none of them";
        return Err(source.fault(
            "rate_deg_per_h",
            "Earth's rate needs the laboratory's latitude and both angles of the axis",
            remedy,
        ));
    }
    if rate.earth_rate_deg_per_h.is_some() && rate.latitude_deg.is_some() {
        let remedy = "leave one of the two out";
        return Err(source.fault("rate_deg_per_h.latitude_deg", "Earth's rate is given beside the latitude", remedy));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Meta, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("meta.ron");
        std::fs::write(&path, text).expect("written");
        checked(&crate::input::opened::open(&path).unwrap()).map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_known_of_instruments_is_read() {
        let meta = of("(
            temperature_sensor: (chamber_quantisation_c: 0.1, spool_quantisation_c: 0.03),
            chamber_c: (offset_sd: Some(0.1), gain_sd: Some(0.001), lag_s: Some(12.0), clock_offset_sd_s: Some(2.0)),
            spool_c: (resolution: Some(0.01), noise: Some(0.02)),
            rate_deg_per_h: (scale_factor_sd: Some(5e-4), offset_sd: Some(0.05), latitude_deg: Some(52.0), azimuth_deg: Some(0.0), elevation_deg: Some(90.0)),
        )")
        .expect("a meta file");
        assert_eq!((meta.chamber_c.lag_s, meta.spool_c.noise), (Some(12.0), Some(0.02)));
        assert_eq!(meta.resolutions(), [Some(0.1), Some(0.01)]);
        let up = meta.rate_deg_per_h.earth().expect("known");
        assert!((up - 15.041_067 * 52f64.to_radians().sin()).abs() < 1e-9, "{up}");
        // north at the equator, all of it; east, nothing
        let at = |azimuth: f64| {
            let axis = Rate { azimuth_deg: Some(azimuth), elevation_deg: Some(0.0), ..Rate::default() };
            Rate { latitude_deg: Some(0.0), ..axis }.earth().expect("known")
        };
        assert!((at(0.0) - EARTH).abs() < 1e-12 && at(90.0).abs() < 1e-12);
        let vertical = Rate { latitude_deg: Some(30.0), elevation_deg: Some(-90.0), ..Rate::default() };
        assert!((vertical.earth().expect("known") + EARTH / 2.0).abs() < 1e-12);
        assert_eq!(Rate { earth_rate_deg_per_h: Some(9.7), ..Rate::default() }.earth(), Some(9.7));
        assert_eq!(Rate::default().earth(), None);
    }

    #[test]
    fn a_serial_number_stays_as_it_is_written() {
        let serial = |text: &str| of(&format!("(serial: {text})")).map(|meta| meta.serial.map(|serial| serial.0));
        for (written, told) in
            [("Some(4907)", "4907"), ("Some(0042)", "0042"), ("Some(\"0042\")", "0042"), ("Some( \"A \\\"7\" )", "A \"7")]
        {
            assert_eq!(serial(written), Ok(Some(told.to_owned())), "{written}");
        }
        assert_eq!(serial("None"), Ok(None));
        for written in ["Some(\"\")", "Some(true)", "Some(-1)", "Some((1, 2))"] {
            let message = serial(written).expect_err(written);
            assert!(message.contains("meta.ron:1: serial: ") && message.contains("is no serial number"), "{message}");
        }
    }

    #[test]
    fn what_cannot_be_is_refused_where_it_stands() {
        for (text, complaint) in [
            ("(chamber_c: (gain_sd: Some(-0.1)))", "meta.ron:1: chamber_c.gain_sd: -0.1 is not 0 or more"),
            ("(\n\n spool_c: (lag_s: Some(inf)))", "meta.ron:3: spool_c.lag_s: inf is not 0 or more"),
            ("(rate_deg_per_h: (latitude_deg: Some(91.0)))", "rate_deg_per_h.latitude_deg: 91 lies outside -90 to 90"),
            ("(rate_deg_per_h: (latitude_deg: Some(48.0)))", "rate_deg_per_h: Earth's rate needs"),
            (
                "(rate_deg_per_h: (latitude_deg: Some(48.0), azimuth_deg: Some(0.0), elevation_deg: Some(0.0), earth_rate_deg_per_h: Some(11.0)))",
                "given beside the latitude",
            ),
            ("(chamber_c: (gain: 0.1))", "gain"),
        ] {
            let message = of(text).expect_err(text);
            assert!(message.contains(complaint), "{message}");
        }
    }
}
