//! Units with constants anywhere within the tolerances, instruments as they come, and a law that no library lists, or none.

use super::build::Build;
use super::chamber::ProgrammeFamily;
use super::laws::{Drawn, LAWS};
use super::matched::{Whitening, beyond};
use super::noise::Noise;
use super::ordinary::{NOTHING, Ordinary};
use super::plant::Plant;
use super::random::Random;
use super::record::{Sensors, Signal, THERMOMETER, signal};
use super::scene::{Scene, minus, times};
use super::unit::meta;
use crate::Failure;
use crate::truth::ConcealedEffect;
use coil::Design;

/// Signal-to-noise ratios, given the tolerances, that laws are sized to, evenly in the logarithm.
const STRENGTH: [f64; 2] = [5.0, 150.0];
/// Constants with their standard deviations, relative: of the coil k_r, c, E_r with G, E_z, α_r, α_z; α of the spool; k of the air; ∂n/∂T; and, in pitches,
/// the winding's start and end.
const TOLERANCES: [f64; 11] = [0.1, 0.05, 0.1, 0.03, 0.03, 0.03, 0.02, 0.05, 0.05, 0.1, 0.1];
/// Standard deviations beyond which a unit is no good one.
const FARTHEST: f64 = 2.0;
/// Standard deviations that derivatives are taken with.
const STEP: f64 = 0.5;
/// Delay of the chamber's thermometer and log, one standard deviation \[s\].
const LATE: f64 = 45.0;
/// Error of a good forward model, relative.
const GRANTED: f64 = 0.003;
/// Offsets may be anything.
const ANYTHING: f64 = 1e3;
/// Records that are fitted.
const FITTED: usize = 2;

/// A design with a constant moved by so many standard deviations.
fn moved(build: &mut Build, constant: usize, deviations: f64) {
    let by = 1.0 + TOLERANCES[constant] * deviations;
    let Design { body, spool, surroundings, optics, winding, .. } = &mut build.design;
    match constant {
        0 => body.conductivity_r *= by,
        1 => body.specific_heat *= by,
        2 => {
            body.elastic.e_r *= by;
            body.elastic.g_zr *= by;
        }
        3 => body.elastic.e_z *= by,
        4 => body.elastic.alpha_r *= by,
        5 => body.elastic.alpha_z *= by,
        6 => spool.iter_mut().for_each(|spool| spool.material.elastic.thermal_expansion *= by),
        7 => surroundings.conductivity *= by,
        8 => optics.thermo_optic *= by,
        _ => {
            let moved = (by - 1.0) * winding.pitch;
            let [start, end] = winding.edges();
            (winding.start, winding.end) = if constant == 9 { (start + moved, Some(end)) } else { (start, Some(end + moved)) };
        }
    }
}

/// The effect that was put into a unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Concealed {
    pub(crate) law: ConcealedEffect,
    /// Signal-to-noise ratio in the records that are fitted, all constants and offsets free within their tolerances.
    pub(crate) snr: f64,
}

/// A unit's records, and what they would hold without noise.
pub(crate) struct DrawnUnit {
    /// Two to fit, one that judges, as CSV.
    pub(crate) records: [String; FITTED + 1],
    pub(crate) meta: String,
    pub(crate) concealed: Option<Concealed>,
    /// Rates in the record that judges, without the law and with it, row by row [deg/h].
    pub(crate) rates: [Vec<f64>; 2],
}

/// The design as drawn, and with each constant moved.
pub(crate) struct DrawnUnits {
    nominal: Plant,
    moved: Vec<Plant>,
}

impl DrawnUnits {
    /// Of a design. [`Failure`] if a system cannot be solved.
    pub(crate) fn new(design: &Design) -> Result<Self, Failure> {
        let nominal = Plant::new(Build::new(design.clone()), None)?;
        let with = |constant: usize| {
            let mut build = Build::new(design.clone());
            moved(&mut build, constant, STEP);
            Ok(Plant::new(build, Some(&nominal))?)
        };
        let moved = (0..TOLERANCES.len()).map(with).collect::<Result<_, Failure>>()?;
        Ok(Self { nominal, moved })
    }

    /// Unit `number` of a seed: always the same. Even ones conceal nothing, odd ones a law, the forms in turn. [`Failure`] if a system cannot be solved.
    pub(crate) fn unit(&self, design: &Design, seed: u64, number: usize) -> Result<DrawnUnit, Failure> {
        let random = &mut Random::new(seed, number as u64);
        let noise = Noise { unseen: None, ..Noise::draw(random) };
        let sensors = Sensors { resolution: if random.chance(0.35) { 0.0625 } else { 0.01 }, offset: 0.3 * random.normal() };
        let ordinary = Ordinary {
            earth: random.uniform(-10.0, 10.0),
            gains: [0.001 * random.normal(), 0.001 * random.normal()],
            chamber_late: [random.uniform(0.0, 30.0), random.uniform(0.0, 20.0)],
            ..NOTHING
        };
        let mut build = Build::new(design.clone());
        for constant in 0..TOLERANCES.len() {
            moved(&mut build, constant, random.normal().clamp(-FARTHEST, FARTHEST));
        }
        let plant = Plant::new(build, None)?;
        let mut families = ProgrammeFamily::ALL.to_vec();
        let mut family = || families.swap_remove(random.below(families.len()));
        let families = [family(), family(), family()];
        let scenes = families.map(|family| Scene::draw(family, random));
        let law = (number % 2 == 1).then(|| Drawn::draw(number / 2 % LAWS, random));
        let wanted = random.log_uniform(STRENGTH[0], STRENGTH[1]);
        let sized = law.map(|law| {
            let snr = self.strength(&scenes[..FITTED], &plant, &law, &noise, &sensors);
            law.times(wanted / snr.max(1e-9))
        });
        let signals: Vec<[Signal; 2]> =
            scenes.iter().map(|scene| [None, sized.as_ref()].map(|law| of(scene, &plant, law))).collect();
        let mut since = 0.0;
        let mut write = |scene: &Scene, clean: &Signal| {
            let readings = noise.sample(&scene.time, since, random);
            since += scene.time[scene.time.len() - 1] + 6.0 * 3600.0;
            sensors.write(
                &ordinary.read(&scene.course),
                &scene.time,
                &ordinary.signal(&scene.time, clean),
                &readings,
                noise.white(0.0),
                random,
            )
        };
        let records = [0, 1, 2].map(|k: usize| write(&scenes[k], &signals[k][1]));
        let rates = signals[FITTED].clone().map(|signal| signal.rate);
        let concealed = sized.map(|law| Concealed { law: law.effect(), snr: wanted });
        Ok(DrawnUnit { records, meta: meta(&sensors, None), concealed, rates })
    }

    /// The signal-to-noise ratio of a law in some records beyond what constants, offsets, the chamber's delay and a good model's error explain.
    fn strength(&self, scenes: &[Scene], plant: &Plant, law: &Drawn, noise: &Noise, sensors: &Sensors) -> f64 {
        let spool_sd = (THERMOMETER.powi(2) + sensors.resolution.powi(2) / 12.0).sqrt();
        let whitening: Vec<Whitening> = scenes.iter().map(|scene| Whitening::new(noise, &scene.time)).collect();
        // all records one behind another, of what is said of each
        let joined = |of: &dyn Fn(usize) -> Signal| -> Vec<f64> {
            let whitened = |k: usize| {
                let Signal { spool, rate } = of(k);
                times(&spool, 1.0 / spool_sd).into_iter().chain(whitening[k].apply(&rate)).collect::<Vec<_>>()
            };
            (0..scenes.len()).flat_map(whitened).collect()
        };
        let drawn: Vec<Signal> = scenes.iter().map(|scene| of(scene, &self.nominal, None)).collect();
        let mut granted: Vec<Vec<f64>> = Vec::new();
        for other in &self.moved {
            granted.push(joined(&|k| scaled(&less(&of(&scenes[k], other, None), &drawn[k]), 1.0 / STEP)));
        }
        granted.push(joined(&|k| Signal { spool: vec![0.0; drawn[k].spool.len()], rate: times(&drawn[k].rate, GRANTED) }));
        let later = |k: usize| {
            let of = |series: &[f64]| -> Vec<f64> {
                let time = &scenes[k].time;
                let slope = |n: usize| if n == 0 { 0.0 } else { (series[n] - series[n - 1]) / (time[n] - time[n - 1]) };
                (0..series.len()).map(|n| LATE * slope(n)).collect()
            };
            Signal { spool: of(&drawn[k].spool), rate: of(&drawn[k].rate) }
        };
        granted.push(joined(&later));
        for record in 0..scenes.len() {
            for channel in 0..2 {
                let anything =
                    |k: usize, own: usize| vec![if (k, own) == (record, channel) { ANYTHING } else { 0.0 }; drawn[k].rate.len()];
                granted.push(joined(&|k| Signal { spool: anything(k, 0), rate: anything(k, 1) }));
            }
        }
        let difference = joined(&|k| less(&of(&scenes[k], plant, Some(law)), &of(&scenes[k], plant, None)));
        beyond(&difference, &granted)
    }
}

/// Response of a unit in a scene, a law added.
fn of(scene: &Scene, plant: &Plant, law: Option<&Drawn>) -> Signal {
    let mut run = plant.run(&scene.course.temperature);
    // before the first row the unit is at rest, and so is a law
    let rest = law.map_or(0.0, |law| law.act(&scene.course.temperature, &mut run));
    signal(&run, &scene.time, plant.read_out_at(run.bore[0]) + rest)
}

fn less(a: &Signal, b: &Signal) -> Signal {
    Signal { spool: minus(&a.spool, &b.spool), rate: minus(&a.rate, &b.rate) }
}

fn scaled(signal: &Signal, by: f64) -> Signal {
    Signal { spool: times(&signal.spool, by), rate: times(&signal.rate, by) }
}
