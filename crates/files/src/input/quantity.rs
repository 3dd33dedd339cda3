//! The kinds of numbers in case files: unit, accepted range, and SI. The ranges are wide enough for any coil, narrow enough to catch a wrong unit.

use std::convert::identity;

use bias::units::DEG_PER_H_PER_RAD_PER_S;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize};

use super::mirror::Mirror;
use crate::units::{from_gpa, from_mm, from_mpa, from_um, to_gpa, to_mm, to_mpa, to_um};

/// A kind of number: its accepted range, the message on other values, and its conversion to SI.
pub(crate) struct Quantity {
    least: f64,
    most: f64,
    unit: &'static str,
    example: &'static str,
    /// Conversion from the file's unit.
    pub(crate) si: fn(f64) -> f64,
    /// Conversion to the file's unit.
    from_si: fn(f64) -> f64,
}

/// A type for each kind, so that a field's type says all of it.
macro_rules! quantities {
    ($($name:ident: $least:literal to $most:expr, $unit:literal, $example:literal, $si:expr, $from_si:expr;)*) => {$(
        #[doc = concat!("A number in the unit \"", $unit, "\", like ", $example, ", as it is written.")]
        #[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
        #[serde(transparent)]
        pub(crate) struct $name(pub(crate) f64);

        impl $name {
            pub(crate) const KIND: Quantity =
                Quantity { least: $least, most: $most, unit: $unit, example: $example, si: $si, from_si: $from_si };
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Self::KIND.accepted(deserializer).map(Self)
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn inline_schema() -> bool {
                true
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                Self::KIND.schema()
            }
        }

        impl Mirror<f64> for $name {
            fn model(&self) -> f64 {
                (Self::KIND.si)(self.0)
            }

            fn of(model: &f64) -> Self {
                Self(Self::KIND.written(*model))
            }
        }
    )*};
}

quantities! {
    FibreUm: 0.1 to 1e5, "um", "170.0", from_um, to_um;
    PlaceUm: -1e6 to 1e6, "um", "85.0", from_um, to_um;
    AngleDeg: -360.0 to 360.0, "deg", "30.0", f64::to_radians, f64::to_degrees;
    PitchMm: 1e-3 to 50.0, "mm", "0.170", from_mm, to_mm;
    WallMm: 0.01 to 1e5, "mm", "2.0", from_mm, to_mm;
    LengthMm: 1e-3 to 1e5, "mm", "43.5", from_mm, to_mm;
    MarginMm: 1e-3 to 1e5, "mm", "10.0", from_mm, to_mm;
    ExtraLengthMm: 0.0 to 1e5, "mm", "1.0", from_mm, to_mm;
    PositionMm: -1e5 to 1e5, "mm", "10.01", from_mm, to_mm;
    TailM: 0.0 to 1e5, "m", "0.5", identity, identity;
    ModulusMpa: 1e-6 to 2e6, "MPa", "70200.0 for silica", from_mpa, to_mpa;
    ModulusGpa: 1e-9 to 2e3, "GPa", "70.2 for silica", from_gpa, to_gpa;
    ExpansionPerK: -1e-2 to 1e-2, "1/K", "0.55e-6 for silica", identity, identity;
    ThermoOpticPerK: -1e-2 to 1e-2, "1/K", "1.0e-5 for silica", identity, identity;
    // of solids, so that kW/(m K), g/cm3 and kJ/(kg K) lie outside. Least: silica aerogel, 0.012 W/(m K) (Fricke and Emmerling, Structure and Bonding 77,
    // 1992); melamine foam, 9 to 11 kg/m3 (BASF, Basotect); uranium, 116 J/(kg K) (CRC Handbook). Most: diamond of one isotope, 3320 W/(m K) (Anthony et
    // al., Phys. Rev. B 42, 1990); osmium, 22590 kg/m3; lithium, 3580 J/(kg K), and water in a gel, 4180
    Conductivity: 0.01 to 4e3, "W/(m K)", "1.38 for silica", identity, identity;
    Density: 9.0 to 2.3e4, "kg/m3", "1400.0", identity, identity;
    SpecificHeat: 100.0 to 5e3, "J/(kg K)", "1300.0", identity, identity;
    // of a medium: from a thin gas to a liquid metal; xenon has 158 J/(kg K), hydrogen 14300
    MediumConductivity: 1e-6 to 1e2, "W/(m K)", "0.026 for air", identity, identity;
    MediumDensity: 1e-9 to 2e4, "kg/m3", "1.2 for air", identity, identity;
    MediumSpecificHeat: 100.0 to 2e4, "J/(kg K)", "1005.0 for air", identity, identity;
    Ratio: -10.0 to 10.0, "", "0.392", identity, identity;
    LagS: 0.0 to 1e6, "s", "20.0", identity, identity;
    Resistance: 0.0 to 1e2, "m2 K/W", "1e-4", identity, identity;
    Conductance: 1e-6 to 1e6, "W/(m2 K)", "50.0", identity, identity;
    Factor: 1e-3 to 1e3, "", "1.5", identity, identity;
    Share: 1e-6 to 0.999, "", "0.3", identity, identity;
    RelaxingShare: 1e-6 to 0.8, "", "0.3", identity, identity;
    TimeS: 1e-3 to 1e9, "s", "1800.0", identity, identity;
    TemperatureC: -273.15 to 1000.0, "degC", "-20.0", identity, identity;
    HysteresisK: 0.0 to 1000.0, "K", "5.0", identity, identity;
    PowerW: -1e3 to 1e3, "W", "0.5", identity, identity;
    CurvaturePerK2: -1e-4 to 1e-4, "1/K2", "2e-8", identity, identity;
    DriftDegPerHPerK: -1e3 to 1e3, "(deg/h)/K", "0.001", |v| v / DEG_PER_H_PER_RAD_PER_S, |v| v * DEG_PER_H_PER_RAD_PER_S;
    Index: 1.0 to 5.0, "", "1.45 for silica", identity, identity;
    Photoelastic: -1.0 to 1.0, "", "0.121 and 0.270 for silica", identity, identity;
    StrainRatio: -10.0 to 10.0, "", "0.0274", identity, identity;
    NotNegative: 0.0 to f64::MAX, "", "0.01", identity, identity;
}

impl Quantity {
    /// The faults of a value in the file's unit, and how to mend it.
    pub(crate) fn fault(&self, value: f64) -> Option<(String, String)> {
        let Self { least, most, unit, example, .. } = *self;
        let with_unit = |number: f64| format!("{number} {unit}").trim_end().to_owned();
        let problem = if !value.is_finite() {
            format!("{value} is not a finite number")
        } else if least > 0.0 && value <= 0.0 {
            format!("{value} is not greater than 0")
        } else if least == 0.0 && value < 0.0 {
            format!("{value} is negative")
        } else if value < least {
            format!("{} is less than {}, the least accepted", with_unit(value), with_unit(least))
        } else if value > most {
            format!("{} is more than {}, the most accepted", with_unit(value), with_unit(most))
        } else {
            return None;
        };
        let unit = if unit.is_empty() { String::new() } else { format!(" in {unit}") };
        Some((problem, format!("give the value{unit}, e.g. {example}")))
    }

    /// A number that is accepted; the reader's error has the problem as what was found and the remedy as what is expected.
    fn accepted<'de, D: Deserializer<'de>>(&self, deserializer: D) -> Result<f64, D::Error> {
        let value = f64::deserialize(deserializer)?;
        match self.fault(value) {
            Some((problem, remedy)) => Err(D::Error::invalid_value(Unexpected::Other(&problem), &remedy.as_str())),
            None => Ok(value),
        }
    }

    /// The shortest number in the file's unit that reads back as `si`; if there is none, the nearest.
    fn written(&self, si: f64) -> f64 {
        let near = (self.from_si)(si);
        let shorter = (0..17).filter_map(|digits| format!("{near:.digits$e}").parse::<f64>().ok());
        shorter.chain([near.next_up(), near.next_down()]).find(|number| (self.si)(*number) == si).unwrap_or(near)
    }

    fn schema(&self) -> Schema {
        let mut schema = json_schema!({ "type": "number", "format": "double" });
        if !self.unit.is_empty() {
            schema.insert("x-unit".into(), self.unit.into());
        }
        schema.insert("minimum".into(), self.least.into());
        if self.most < f64::MAX {
            schema.insert("maximum".into(), self.most.into());
        }
        schema
    }
}
