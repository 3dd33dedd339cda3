//! What every mechanism, every constant and every instrument makes of a record, held as it was.

use crate::common::reference;
use crate::figures_kit::Figures;
use crate::{course, gyro, of, read_by};
use diagnosis::{Active, ForwardModel};
use mechanisms::{
    CATALOGUE, Chamber, Gyro, Instruments, ON_REQUEST, Prepared, RATE, SPOOL, lagged, middles, rates_per_hour, thermometer_under,
};

const KEPT: &str = include_str!("figures.txt");

/// A response less another, channel by channel.
fn change(figures: &mut Figures, name: &str, with: &[Vec<f64>], without: &[Vec<f64>]) {
    for (channel, of) in [(SPOOL, "thermometer"), (RATE, "rate")] {
        let change: Vec<f64> = with[channel].iter().zip(&without[channel]).map(|(a, b)| a - b).collect();
        if change.iter().any(|value| value.abs() > 1e-9) {
            figures.series(&format!("{name} {of}"), &change);
        }
    }
}

/// Everything that is offered, at each of a few starts and at the ends of its choice.
fn of_mechanisms(figures: &mut Figures, gyro: &Gyro) {
    let middle = diagnosis::expected(gyro.nuisances());
    let nominal = gyro.respond(0, &middle, &[]).expect("response");
    figures.series("mechanism none thermometer", &nominal[SPOOL]);
    figures.series("mechanism none rate", &nominal[RATE]);
    for (number, offered) in gyro.mechanisms().iter().enumerate() {
        let name = format!("mechanism {}", offered.id);
        figures.add(&name, offered);
        let choices: Vec<Option<f64>> = offered
            .choice
            .as_ref()
            .map_or(vec![None], |(_, all)| all.iter().step_by((all.len() - 1).max(1)).map(|value| Some(*value)).collect());
        let most = (offered.starts.len() - 1).max(1);
        for values in offered.starts.iter().step_by(most) {
            for choice in &choices {
                // a start may be nothing at all
                let values = values.iter().map(|value| if *value == 0.0 { 1e-3 } else { *value }).collect();
                let active = Active { mechanism: number, values, choice: *choice };
                let name = format!("{name} {:?} {choice:?}", active.values);
                let Ok(with) = gyro.respond(0, &middle, std::slice::from_ref(&active)) else {
                    figures.add(&name, &"impossible");
                    continue;
                };
                change(figures, &name, &with, &nominal);
                let extent = gyro.extent(&active, None);
                figures.add(&format!("{name} extent"), &(extent.temperature, extent.layers, extent.time));
                let design = gyro.extended(gyro.library().design(), &active);
                figures.add(&format!("{name} has a design"), &design.is_some_and(|design| design != *gyro.library().design()));
            }
        }
    }
}

#[test]
fn of_all_mechanisms() {
    let mut figures = Figures::default();
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let (time, chamber) = course();
    let prepared = Prepared::under(&library, &time, &Chamber::given(&time, &chamber), 60.0).expect("prepared");
    let humidity = time.iter().map(|t| if *t < 15_000.0 { 60.0 } else { 10.0 }).collect();
    let field = time.iter().map(|t| 50.0 * (t / 3000.0).sin()).collect();
    let columns = [("humidity_percent", humidity), ("field_ut", field)].map(|(name, values)| (name.to_owned(), values));
    let told = Instruments { earth: Some(9.7), ..Instruments::default() };
    let all = [CATALOGUE, ON_REQUEST].concat();
    let gyro = Gyro::fitted_to(library, &all, vec![prepared.with_columns(columns.into())], 1, &told).expect("gyro");
    of_mechanisms(&mut figures, &gyro);
    figures.hold(KEPT, "mechanism");
}

#[test]
fn of_all_constants_and_instruments() {
    let mut figures = Figures::default();
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let gyro = read_by(&Instruments { earth: Some(9.7), unsaid: 60.0, ..Instruments::default() }, library.clone(), CATALOGUE);
    figures.add("unknown scene", gyro.scene());
    figures.add("unknown parts", &gyro.largest_parts(1));
    figures.add("unknown channels", &gyro.channels());
    let middle = diagnosis::expected(gyro.nuisances());
    let nominal = gyro.respond(0, &middle, &[]).expect("response");
    for (number, nuisance) in gyro.nuisances().iter().enumerate() {
        figures.add(&format!("unknown {}", nuisance.parameter.name), nuisance);
        let mut moved = middle.clone();
        moved[number] = nuisance.parameter.prior.value(1.5);
        let with = gyro.respond(0, &moved, &[]).expect("response");
        change(&mut figures, &format!("unknown {}", nuisance.parameter.name), &with, &nominal);
    }
    // all at once, and about where they are
    let moved: Vec<f64> =
        gyro.nuisances().iter().enumerate().map(|(n, of)| of.parameter.prior.value([0.7, -0.4][n % 2])).collect();
    let with = gyro.respond(0, &moved, &[]).expect("response");
    change(&mut figures, "unknown all", &with, &nominal);
    let about = gyro.about(&moved, &[]).expect("a model").expect("it is far enough");
    let anew = about.respond(0, &moved, &[]).expect("response");
    change(&mut figures, "unknown all made anew", &anew, &with);
    figures.add("unknown values", &about.library().values());
    // what it is not told
    let missed = about.missed(0, &moved, &[], gyro.library().design()).expect("a solution").expect("no heaters");
    change(&mut figures, "unknown missed", &missed, &[vec![0.0; missed[0].len()], vec![0.0; missed[0].len()]]);
    figures.hold(KEPT, "unknown");
}

#[test]
fn of_readings() {
    let mut figures = Figures::default();
    let (time, chamber) = course();
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    figures.series("reading lagged", &lagged(&time, &chamber, 333.0));
    figures.series("reading middles", &middles(&chamber, |t| t * t));
    figures.series("reading rates", &rates_per_hour(&time, &chamber));
    let with_holes: Vec<f64> = chamber.iter().enumerate().map(|(n, t)| if n % 50 < 3 { f64::NAN } else { *t }).collect();
    figures.series("reading thermometer", &thermometer_under(&library, &time, &with_holes).expect("a course"));
    // a chamber whose thermometer is noisy, with gaps in the record
    let kept: Vec<usize> = (0..time.len()).filter(|n| !(200..230).contains(n)).collect();
    let at = |of: &[f64]| kept.iter().map(|n| of[*n]).collect::<Vec<f64>>();
    let shaken: Vec<f64> = chamber.iter().enumerate().map(|(n, t)| t + 0.02 * ((n * n) as f64).sin()).collect();
    let prepared = Prepared::new(&library, &at(&time), &at(&shaken), 60.0).expect("prepared");
    figures.add("reading noise", &prepared.noise());
    let gyro = Gyro::new(of(library, CATALOGUE).library().clone(), CATALOGUE, vec![prepared]).expect("gyro");
    let nominal = gyro.respond(0, &diagnosis::expected(gyro.nuisances()), &[]).expect("response");
    figures.series("reading nominal thermometer", &nominal[SPOOL]);
    figures.series("reading nominal rate", &nominal[RATE]);
    figures.add("reading channels", &gyro.channels());
    let full = gyro.in_full(&reference()).expect("a solution").under(0).expect("a solution");
    figures.series("reading full thermometer", &full[SPOOL]);
    figures.series("reading full rate", &full[RATE]);
    figures.hold(KEPT, "reading");
}
