//! Random coils under random profiles.

use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Drive, Dynamics, FactorsAt, Fidelity, HeatPaths, Mechanics, MeshFineness, Mount, Opening};
use fogcoil::cache::Cache;
use fogcoil::simulate::{model, simulate};
use fogcoil::summary::Summary;
use fogcoil::{input, output};

use super::coils::{reference, refused};
use super::draw;
use super::tally::{Compared, Drawn};
use crate::Failure;
use crate::generator::Random;

/// Mesh and modes behind the true error.
const TRUE: Fidelity = Fidelity { resolution: MeshFineness { order: 9, layers: 4, ratio: 0.2 }, modes: 90 };
const ROWS: usize = 160;
/// Temperatures between which a chamber goes \[°C\].
const COLDEST: f64 = -60.0;
const HOTTEST: f64 = 90.0;

/// Heat paths, a slow thermometer, and stiffness that depends on temperature or time.
fn furnish(random: &mut Random, design: &mut Design) {
    let flanges = design.spool.as_ref().map_or(vec![], |spool| spool.flanges.clone());
    let mounts = flanges.iter().filter(|_| random.chance(0.3));
    let mounts = mounts.map(|flange| flange.side).collect::<Vec<_>>();
    let bonded = design.spool.as_ref().is_some_and(|spool| spool.hub_contact == coil::Contact::Bonded);
    design.heat = HeatPaths {
        hub_resistance: if bonded && random.chance(0.3) { random.log_uniform(1e-5, 1e-2) } else { 0.0 },
        mounts: mounts.into_iter().map(|side| Mount { side, conductance: random.log_uniform(1.0, 1e3) }).collect(),
        film: random.chance(0.2).then(|| random.log_uniform(2.0, 200.0)),
        ..HeatPaths::default()
    };
    design.sensor.lag = if random.chance(0.3) { random.log_uniform(1.0, 100.0) } else { 0.0 };
    let opened = flanges.iter().find(|flange| flange.contact == coil::Contact::Bonded).map(|flange| flange.side);
    design.mechanics = match (random.below(10), opened) {
        (0, _) => Mechanics::Relaxing { fraction: random.uniform(0.1, 0.7), time: random.log_uniform(100.0, 2e4) },
        (1, _) => {
            let at = random.uniform(-20.0, 40.0);
            let row = |temperature, transverse_modulus, transverse_expansion| FactorsAt {
                temperature,
                transverse_modulus,
                transverse_expansion,
            };
            Mechanics::TemperatureTable(vec![
                row(at, random.uniform(0.8, 1.2), 1.0),
                row(at + random.uniform(5.0, 40.0), random.uniform(0.4, 0.9), random.uniform(0.9, 1.3)),
            ])
        }
        (2, Some(side)) => Mechanics::Opening(Opening {
            side,
            below: random.uniform(-20.0, 20.0),
            hysteresis: random.uniform(0.0, 10.0),
            fraction: random.uniform(0.1, 0.7),
        }),
        _ => Mechanics::Elastic,
    };
}

/// Ramps, soaks and swings of any rate, as the text of a file.
fn profile(random: &mut Random) -> String {
    let interval = random.log_uniform(5.0, 300.0);
    let fastest = random.log_uniform(0.05, 10.0) * interval / 60.0;
    let swing = if random.chance(0.5) { 0.0 } else { random.uniform(0.0, 0.5) };
    let period = random.uniform(6.0, 60.0);
    let (mut temperature, mut step, mut text) = (random.uniform(-40.0, 60.0), 0.0, String::from("time_s,chamber_c\n"));
    for row in 0..ROWS {
        if row % 20 == 0 {
            step = if random.chance(0.3) { 0.0 } else { random.sign() * random.uniform(0.2, 1.0) * fastest };
        }
        if !(COLDEST..=HOTTEST).contains(&(temperature + step)) {
            step = -step;
        }
        let wave = swing * fastest * (std::f64::consts::TAU * row as f64 / period).sin();
        text += &format!("{},{}\n", interval * row as f64, temperature + wave);
        temperature += step;
    }
    text
}

pub(super) fn compare(random: &mut Random) -> Result<Drawn, Failure> {
    let mut design = draw::coil(random, &reference()?);
    furnish(random, &mut design);
    let text = output::coil_file("survey", &design, &coil::Tolerances::default(), &[]);
    // what the file's ranges refuse is drawn outside them, and no draw
    let case = input::check_coil("coil.ron".as_ref(), &text)?;
    let profile = input::check_profile("profile.csv".as_ref(), profile(random), &case.design, &[])?;
    let model = match model(&case, &[Drive::Chamber], &Cache::NONE) {
        Ok(model) => model,
        Err(error) if error.to_string().contains("double precision") => return Ok(Drawn::Refused),
        Err(error) => return Err(error.into()),
    };
    let truth = match Dynamics::new(&case.design, &[Drive::Chamber], &TRUE) {
        Err(error) if refused(&error) => return Ok(Drawn::Refused),
        truth => truth?.simulate(&profile.profile)?,
    };
    let simulation = simulate(&case, &profile, &model)?;
    let Summary { errors, rms, .. } = Summary::of(&simulation);
    let (mut spool, mut rate, mut squares, mut last) = (0.0_f64, 0.0_f64, 0.0, simulation.row(0).time);
    for (row, truth) in simulation.rows().zip(&truth) {
        let true_rate = DEG_PER_H_PER_RAD_PER_S * truth.rate();
        spool = spool.max((row.spool - truth.sensor).abs());
        rate = rate.max((row.rate - true_rate).abs());
        squares += true_rate * true_rate * (row.time - last);
        last = row.time;
    }
    let true_rms = (squares / simulation.duration()).sqrt();
    let row = |quantity, stated, error| Compared { quantity, stated, error };
    let rows = vec![
        row("thermometer, any row", errors.spool, spool),
        row("rate, any row", errors.parts[4], rate),
        row("rate, root mean square", errors.rms, (rms - true_rms).abs()),
    ];
    Ok(Drawn::Compared { what: format!("{:?}", case.design), rows })
}
