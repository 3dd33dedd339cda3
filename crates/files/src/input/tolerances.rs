//! The tolerances of `COIL.ron`: deviations of a unit from the drawing.

use std::collections::BTreeMap;
use std::fmt::Formatter;

use coil::{Design, Number, Parameter, Tolerance, Tolerances};
use schemars::JsonSchema;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::InputError;
use super::group::Group;
use super::name::meant;
use crate::note::Note;
use crate::remark::Remark;
use crate::units::parameter_unit;

/// One standard deviation of a number: a share of it, or in the unit of its key.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) enum ToleranceFile {
    Relative(f64),
    Absolute(f64),
}

/// A note on each place of the winding whose tolerance is given and more than a design's turns have room for.
pub(super) fn cut(tolerances: &Tolerances, design: &Design) -> Vec<Note> {
    let of = |(number, tolerance): &(Number, Tolerance)| {
        let (key, unit) = key(*number, design)?;
        let (given, taken) = (tolerance.of(number.of(design)?), tolerances.sd(*number, design)?);
        let [given, taken] = [given, taken].map(|sd| format!("{:.5}", sd / unit).trim_end_matches('0').to_owned());
        (given != taken).then(|| {
            Remark::CutTolerance.note(format!(
                "tolerances: of {key:?} {taken} is taken in place of {given}, a quarter of the distance from the outermost turn's centre to the \
                 coil's face"
            ))
        })
    };
    let of_winding = |(number, _): &&(Number, Tolerance)| matches!(number, Number::Constant(parameter) if parameter.of_winding());
    tolerances.given.iter().filter(of_winding).filter_map(of).collect()
}

/// Keys of two numbers, and their correlation.
pub(crate) type CorrelationFile = (String, String, f64);

/// Tolerances by the keys of the numbers that they are of.
pub(crate) type TolerancesFile = BTreeMap<String, ToleranceFile>;

/// Reads tolerances, no key twice.
pub(super) fn each_once<'de, D: Deserializer<'de>>(deserializer: D) -> Result<TolerancesFile, D::Error> {
    struct Keys;
    impl<'de> Visitor<'de> for Keys {
        type Value = TolerancesFile;

        fn expecting(&self, formatter: &mut Formatter) -> std::fmt::Result {
            formatter.write_str("tolerances by the keys of their numbers")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<TolerancesFile, A::Error> {
            let mut all = TolerancesFile::new();
            while let Some((key, tolerance)) = entries.next_entry::<String, _>()? {
                if all.insert(key.clone(), tolerance).is_some() {
                    return Err(A::Error::custom(format!("{key:?} has two tolerances")));
                }
            }
            Ok(all)
        }
    }
    deserializer.deserialize_map(Keys)
}

const MM: f64 = 1e-3;
const MPA: f64 = 1e6;
const GPA: f64 = 1e9;

/// Keys that may carry a tolerance, each with its number and its unit in SI.
const KEYS: &[(&str, Number, f64)] = &[
    ("coil.material.e_z_gpa", Number::Constant(Parameter::AxialModulus), GPA),
    ("coil.material.e_r_mpa", Number::Constant(Parameter::TransverseModulus), MPA),
    ("coil.material.g_zr_mpa", Number::Constant(Parameter::ShearRatio), MPA),
    ("coil.material.nu_zr", Number::Constant(Parameter::AxialPoisson), 1.0),
    ("coil.material.nu_r", Number::Constant(Parameter::TransversePoisson), 1.0),
    ("coil.material.alpha_z_per_k", Number::Constant(Parameter::AxialExpansion), 1.0),
    ("coil.material.alpha_r_per_k", Number::Constant(Parameter::TransverseExpansion), 1.0),
    ("coil.material.k_r_w_per_mk", Number::Constant(Parameter::CoilConductivity), 1.0),
    ("coil.density_kg_per_m3", Number::Constant(Parameter::CoilDensity), 1.0),
    ("coil.specific_heat_j_per_kgk", Number::Constant(Parameter::CoilSpecificHeat), 1.0),
    ("spool.material.youngs_modulus_gpa", Number::Constant(Parameter::SpoolModulus), GPA),
    ("spool.material.poisson_ratio", Number::Constant(Parameter::SpoolPoisson), 1.0),
    ("spool.material.thermal_expansion_per_k", Number::Constant(Parameter::SpoolExpansion), 1.0),
    ("spool.material.conductivity_w_per_mk", Number::Constant(Parameter::SpoolConductivity), 1.0),
    ("spool.material.density_kg_per_m3", Number::Constant(Parameter::SpoolDensity), 1.0),
    ("spool.material.specific_heat_j_per_kgk", Number::Constant(Parameter::SpoolSpecificHeat), 1.0),
    ("winding.start_mm", Number::Constant(Parameter::WindingStart), MM),
    ("winding.end_mm", Number::Constant(Parameter::WindingEnd), MM),
    ("spool.hub_thickness_mm", Number::Constant(Parameter::HubThickness), MM),
    ("spool.flanges.thickness_mm", Number::Constant(Parameter::FlangeThickness), MM),
    ("spool.flanges.overhang_mm", Number::Constant(Parameter::FlangeOverhang), MM),
    ("surroundings.medium.conductivity_w_per_mk", Number::Constant(Parameter::MediumConductivity), 1.0),
    ("surroundings.medium.specific_heat_j_per_kgk", Number::Constant(Parameter::MediumSpecificHeat), 1.0),
    ("surroundings.margin_mm", Number::Constant(Parameter::Margin), MM),
    ("heat.film_w_per_m2k", Number::Constant(Parameter::Film), 1.0),
    ("optics.thermo_optic_per_k", Number::ThermoOptic, 1.0),
    ("winding.tails_m", Number::Tail, 1.0),
    ("sensor.lag_s", Number::SensorLag, 1.0),
];

/// The key of a number that has a tolerance, and its value in a design, in the key's unit; `None` where the design has no such number.
pub fn keyed(number: Number, design: &Design) -> Option<(&'static str, f64)> {
    let (key, unit) = key(number, design)?;
    Some((key, number.of(design)? / unit))
}

/// One standard deviation of a number of a design in the unit of its key; `None` where the design has no such number.
pub fn keyed_sd(number: Number, design: &Design, tolerances: &Tolerances) -> Option<f64> {
    Some(tolerances.sd(number, design)? / key(number, design)?.1)
}

/// Every key that may carry a tolerance, with the usual one: a share of the number, or in the key's unit.
pub fn usual_tolerances() -> impl Iterator<Item = (&'static str, String)> {
    let of = |&(key, number, unit): &(&'static str, Number, f64)| match number.tolerance() {
        Tolerance::Relative(share) => (key, format!("{} %", (1e5 * share).round() / 1e3)),
        Tolerance::Absolute(by) => (key, format!("{} {}", (1e6 * by / unit).round() / 1e6, parameter_unit(key))),
        Tolerance::Exact => (key, "exact".to_owned()),
    };
    KEYS.iter().map(of)
}

/// Largest share: beyond it a number means nothing.
const MOST: f64 = 0.5;

/// Tolerances of numbers that a design does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unused {
    Refused,
    LeftOut,
}

/// The tolerances and correlations that a file gives, checked.
pub(super) fn tolerances(
    top: &Group,
    file: &TolerancesFile,
    correlations: &[CorrelationFile],
    design: &Design,
    unused: Unused,
) -> Result<Tolerances, InputError> {
    let has = |key: &String| KEYS.iter().all(|(known, number, _)| known != key || number.of(design).is_some());
    let is_used = |key: &String| unused == Unused::Refused || has(key);
    let file = file.iter().filter(|(key, _)| is_used(key)).map(|(key, tolerance)| (key.clone(), *tolerance)).collect();
    let given = given(&top.group("tolerances"), &file, design)?;
    let tolerances = Tolerances { given, correlations: Vec::new() };
    let correlations: Vec<CorrelationFile> = correlations.iter().filter(|(a, b, _)| is_used(a) && is_used(b)).cloned().collect();
    let correlations = correlated_by(top, &correlations, &tolerances, design)?;
    Ok(Tolerances { correlations, ..tolerances })
}

/// The correlations that a file gives.
fn correlated_by(
    top: &Group,
    file: &[CorrelationFile],
    tolerances: &Tolerances,
    design: &Design,
) -> Result<Vec<(Number, Number, f64)>, InputError> {
    let mut all: Vec<(Number, Number, f64)> = Vec::new();
    for (at, (first, second, r)) in top.each("correlations", file) {
        let known = |key: &String| {
            let number = KEYS.iter().find(|(known, ..)| known == key).map(|(_, number, _)| *number);
            let has = |n: &Number| tolerances.sd(*n, design).is_some_and(|sd| sd > 0.0);
            number.filter(has).ok_or_else(|| at.fault("", format!("{key:?} is no number with a tolerance"), "see tolerances"))
        };
        let (a, b) = (known(first)?, known(second)?);
        if a == b || all.iter().any(|(c, d, _)| [a, b] == [*c, *d] || [a, b] == [*d, *c]) {
            return Err(at.fault("", format!("{first:?} and {second:?} are given twice, or are one"), "give every pair once"));
        }
        if r.is_nan() || r.abs() >= 1.0 {
            return Err(at.fault("", format!("{r} is no correlation"), "give a number between -1 and 1"));
        }
        all.push((a, b, *r));
    }
    let of_all = Tolerances { given: Vec::new(), correlations: all };
    let numbers: Vec<Number> = KEYS.iter().map(|(_, number, _)| *number).collect();
    if of_all.correlation(&numbers).cholesky().is_none() {
        let problem = "the correlations contradict each other: they are of no distribution";
        return Err(top.fault("correlations", problem, "give those that fogcoil calibrate writes, all of them"));
    }
    Ok(of_all.correlations)
}

/// The key of a number, and its unit in SI in a design.
fn key(number: Number, design: &Design) -> Option<(&'static str, f64)> {
    let (key, _, unit) = KEYS.iter().find(|(_, known, _)| *known == number)?;
    // G_zr varies as a ratio to E_r
    let ratio = if number == Number::Constant(Parameter::ShearRatio) { design.body.elastic.e_r } else { 1.0 };
    Some((key, unit / ratio))
}

/// Tolerances as a file has them, of the numbers that the design has: of others a file is refused.
pub(super) fn written(tolerances: &Tolerances, design: &Design) -> TolerancesFile {
    let of = |(number, tolerance): &(Number, Tolerance)| {
        number.of(design)?;
        let (key, unit) = key(*number, design)?;
        let tolerance = match tolerance {
            Tolerance::Relative(share) => ToleranceFile::Relative(*share),
            Tolerance::Absolute(by) => ToleranceFile::Absolute(by / unit),
            Tolerance::Exact => ToleranceFile::Absolute(0.0),
        };
        Some((key.to_owned(), tolerance))
    };
    tolerances.given.iter().filter_map(of).collect()
}

/// Correlations as a file has them, of the numbers that the design has.
pub(super) fn correlated(tolerances: &Tolerances, design: &Design) -> Vec<CorrelationFile> {
    let name = |number: Number| key(number, design).filter(|_| number.of(design).is_some()).map(|(key, _)| key.to_owned());
    tolerances.correlations.iter().filter_map(|(a, b, r)| Some((name(*a)?, name(*b)?, *r))).collect()
}

/// The tolerances that a file gives.
fn given(at: &Group, file: &TolerancesFile, design: &Design) -> Result<Vec<(Number, Tolerance)>, InputError> {
    let of_none = |key: &&String| KEYS.iter().any(|(known, number, _)| known == *key && number.of(design).is_none());
    let none: Vec<String> = file.keys().filter(of_none).map(|key| format!("{key:?}")).collect();
    if let Some((first, others)) = none.split_first() {
        let also = if others.is_empty() { String::new() } else { format!(", and likewise {}", others.join(", ")) };
        return Err(at.fault(
            "",
            format!("{first} has a tolerance, but the design has no such number"),
            format!("remove it{also}"),
        ));
    }
    let mut given = Vec::new();
    for (key, tolerance) in file {
        let Some((_, number, _)) = KEYS.iter().find(|(known, ..)| known == key) else {
            let all: Vec<&str> = KEYS.iter().map(|(key, ..)| *key).collect();
            let problem = format!("{key:?} is no number that has a tolerance");
            return Err(at.fault("", problem, format!("give one of {}{}", all.join(", "), meant(key, all.iter().copied()))));
        };
        let (Some(drawn), Some((_, unit))) = (number.of(design), self::key(*number, design)) else {
            return Err(at.fault("", format!("{key:?} has a tolerance, but the design has no such number"), "remove it"));
        };
        let may_be_0 = matches!(number, Number::Tail | Number::Constant(Parameter::WindingStart));
        let (value, unit) = match tolerance {
            ToleranceFile::Relative(value) => (*value, None),
            ToleranceFile::Absolute(value) => (*value, Some(unit)),
        };
        let of = |problem: String| {
            let remedy = "give one standard deviation, e.g. Relative(0.05) for 5 %, or Absolute(0.05) in the unit of the key";
            Err(at.fault("", format!("{key:?}: {problem}"), remedy))
        };
        if !value.is_finite() || value < 0.0 {
            return of(format!("{value} is no standard deviation"));
        }
        if unit.is_none() && may_be_0 {
            return of(format!("a share of {drawn} says nothing where it is 0; give it in {}", parameter_unit(key)));
        }
        if !may_be_0 && drawn == 0.0 {
            return of("the design's own value is 0, of which nothing varies".into());
        }
        let share = unit.map_or(value, |unit| value * unit / drawn.abs());
        if !may_be_0 && share > MOST {
            return of(format!("{share} of the value is more than {MOST}, the most accepted"));
        }
        given.push((*number, unit.map_or(Tolerance::Relative(value), |unit| Tolerance::Absolute(value * unit))));
    }
    Ok(given)
}

/// The keys of a design's numbers with the usual tolerances: all that it has but the ends of its winding.
#[cfg(test)]
fn usual(design: &Design) -> TolerancesFile {
    let of = |&(key, number, unit): &(&str, Number, f64)| {
        let has = match number {
            // as much as its turns have room for
            Number::Constant(parameter) => !parameter.of_winding() && parameter.of(design).is_some(),
            Number::SensorLag => design.sensor.lag > 0.0,
            Number::ThermoOptic | Number::Tail => true,
        };
        let written = match number.tolerance() {
            Tolerance::Relative(share) => ToleranceFile::Relative(share),
            Tolerance::Absolute(by) => ToleranceFile::Absolute(by / unit),
            Tolerance::Exact => return None,
        };
        has.then(|| (key.to_owned(), written))
    };
    KEYS.iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::check_coil;
    use std::path::Path;

    const TEMPLATE: &str = include_str!("../../../fogcoil/templates/coil.ron");

    fn read(text: &str) -> Result<Tolerances, String> {
        check_coil(Path::new("coil.ron"), text).map(|case| case.tolerances).map_err(|error| error.to_string())
    }

    #[test]
    fn the_template_writes_the_usual_ones() {
        let case = check_coil(Path::new("coil.ron"), TEMPLATE).expect("the template");
        let written: TolerancesFile = usual(&case.design);
        assert_eq!(case.tolerances.given.len(), written.len());
        for (number, tolerance) in &case.tolerances.given {
            let (own, usual) = (tolerance.of(1.0), number.tolerance().of(1.0));
            assert!((own - usual).abs() < 1e-12 * usual, "{number:?}: {own} {usual}");
        }
    }

    #[test]
    fn bad_tolerances_are_refused() {
        let with =
            |entry: &str| read(&TEMPLATE.replace("\"coil.density_kg_per_m3\": Relative(0.03)", entry)).err().unwrap_or_default();
        let cases = [
            ("\"coil.dens\": Relative(0.03)", "\"coil.dens\" is no number that has a tolerance"),
            ("\"coil.density_kg_per_m3\": Relative(-0.03)", "-0.03 is no standard deviation"),
            ("\"coil.density_kg_per_m3\": Relative(NaN)", "NaN is no standard deviation"),
            ("\"coil.density_kg_per_m3\": Relative(3.0)", "3 of the value is more than 0.5"),
            ("\"coil.density_kg_per_m3\": Absolute(1000.0)", "of the value is more than 0.5"),
            ("\"heat.film_w_per_m2k\": Relative(0.1)", "the design has no such number"),
            (
                "\"coil.density_kg_per_m3\": 0.1",
                "tolerances: a number alone is no tolerance; write one standard deviation, Relative(0.05)",
            ),
            ("\"coil.material.e_r\": Relative(0.1)", "did you mean `coil.material.e_r_mpa`?"),
            (
                "\"coil.density_kg_per_m3\": Relative(0.1), \"coil.density_kg_per_m3\": Relative(0.2)",
                "\"coil.density_kg_per_m3\" has two tolerances",
            ),
        ];
        for (entry, expected) in cases {
            assert!(with(entry).contains(expected), "{entry}: {}", with(entry));
        }
        // in its own line, not that of the group
        let at = TEMPLATE.find("\"coil.density_kg_per_m3\": Relative(0.03)").expect("an entry");
        let line = 1 + TEMPLATE[..at].matches('\n').count();
        let told = with("\"coil.dens\": Relative(0.03)");
        assert!(told.contains(&format!(":{line}: tolerances")), "{told}");
        assert!(
            read(&TEMPLATE.replace("Absolute(0.02)", "Relative(0.02)"))
                .err()
                .unwrap_or_default()
                .contains("a share of 0 says nothing where it is 0; give it in m")
        );
        let with_start = |tolerance: &str| {
            TEMPLATE.replace("\"winding.tails_m\": ", &format!("\"winding.start_mm\": {tolerance}, \"winding.tails_m\": "))
        };
        let start = |tolerance: &str| read(&with_start(tolerance)).err().unwrap_or_default();
        assert!(start("Relative(0.1)").contains("give it in mm"), "{}", start("Relative(0.1)"));
        assert_eq!(start("Absolute(0.01)"), "");
        // an eighth of a turn of 0.17 mm, and a quarter of the room, are taken of more
        for (coil, given, taken) in [("", "0.021", None), ("", "0.035", Some("0.02125")), ("18.1", "0.035", Some("0.03125"))] {
            let text = with_start(&format!("Absolute({given})")).replace(
                "cw_climbs:",
                match coil {
                    "" => "cw_climbs:",
                    _ => "start_mm: 0.04, end_mm: 18.06, cw_climbs:",
                },
            );
            let text = text.replace("height_mm: 18.02", &format!("height_mm: {}", if coil.is_empty() { "18.02" } else { coil }));
            let warnings = check_coil(Path::new("coil.ron"), &text).expect("a design").warnings;
            let told: Vec<&str> = warnings.iter().map(|note| note.text.as_str()).collect();
            match taken {
                None => assert!(told.is_empty(), "{told:?}"),
                Some(taken) => {
                    let says = format!("tolerances: of \"winding.start_mm\" {taken} is taken in place of {given},");
                    assert!(told.len() == 1 && told[0].starts_with(&says), "{told:?}");
                }
            }
        }
    }

    #[test]
    fn a_file_without_any_has_the_usual_ones() {
        let text = &TEMPLATE[..TEMPLATE.find("    tolerances: {").expect("its place")];
        assert_eq!(read(&(text.to_owned() + ")")), Ok(Tolerances::default()));
    }
}
