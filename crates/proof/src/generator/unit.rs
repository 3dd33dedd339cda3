//! One unit: drawn, sized, run under two programmes, written down.

use super::build::Build;
use super::chamber;
use super::effect::{self, Effect};
use super::noise::{Noise, SPAN};
use super::outside::{Outside, SHAPES};
use super::plant::Plant;
use super::random::Random;
use super::record::{Sensors, Signal, THERMOMETER};
use super::scene::{AIRIER, Judge, Scene, minus};
use crate::Failure;
use crate::truth::{self, SpoolSensor, Strength, Truth};
use coil::Design;

/// Signal-to-noise ratios that effects are sized to, evenly in the logarithm.
const STRENGTH: [f64; 2] = [3.0, 200.0];
/// Off by less than this factor is as wanted.
const NEAR: f64 = 1.2;
/// Effects of which the size is no matter of degree that are tried.
const TRIES: usize = 3;

/// Which unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// Nothing is concealed.
    Null(usize),
    /// Something is.
    Concealed(usize),
}

impl Which {
    /// Even for nulls.
    fn number(self) -> usize {
        match self {
            Self::Null(n) => 2 * n,
            Self::Concealed(n) => 2 * n + 1,
        }
    }

    /// The unit's name; it does not say what kind it is of to who does not know how units are numbered.
    pub fn name(self) -> String {
        format!("unit_{:04}", self.number())
    }

    /// The unit of this name; `None` if it is none.
    pub fn of(name: &str) -> Option<Self> {
        let number: usize = name.strip_prefix("unit_")?.parse().ok()?;
        Some(if number.is_multiple_of(2) { Self::Null(number / 2) } else { Self::Concealed(number / 2) })
    }
}

/// A unit's files.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// The record that is fitted, as CSV.
    pub fit: String,
    /// The record that judges, as CSV.
    pub holdout: String,
    /// Sampling of both, as RON.
    pub meta: String,
    /// The concealed mechanisms, as RON.
    pub truth: String,
}

/// Common parts of all units: the design, and its response to the conductivity of its air.
pub struct Generator {
    pub(super) design: Design,
    nominal: Plant,
    airier: Plant,
}

impl Generator {
    /// Of a design. [`Failure`] if a system cannot be solved.
    pub fn new(design: Design) -> Result<Self, Failure> {
        let nominal = Plant::new(Build::new(design.clone()), None)?;
        let mut airier = Build::new(design.clone());
        airier.design.surroundings.conductivity *= 1.0 + AIRIER;
        Ok(Self { airier: Plant::new(airier, Some(&nominal))?, nominal, design })
    }

    /// The design as this unit has it: off by what no mesh resolves, at most 0.3 % of the peak all together.
    pub(super) fn specimen(&self, random: &mut Random) -> Build {
        let mut build = Build::new(self.design.clone());
        build.gain = random.uniform(0.9985, 1.0015);
        let design = &mut build.design;
        design.surroundings.conductivity *= random.uniform(0.999, 1.001);
        design.body.conductivity_r *= random.uniform(0.998, 1.002);
        let stiffer = random.uniform(0.9995, 1.0005);
        design.body.elastic.e_r *= stiffer;
        design.body.elastic.g_zr *= stiffer;
        design.body.elastic.alpha_r *= random.uniform(0.9998, 1.0002);
        build
    }

    /// The unit of this number: always the same for one seed. [`Failure`] if a system cannot be solved.
    pub fn unit(&self, seed: u64, which: Which) -> Result<Unit, Failure> {
        let random = &mut Random::new(seed, which.number() as u64);
        let (noise, sensors) = (Noise::draw(random), Sensors::draw(random));
        let first = random.below(chamber::ProgrammeFamily::ALL.len());
        let second = (first + 1 + random.below(chamber::ProgrammeFamily::ALL.len() - 1)) % chamber::ProgrammeFamily::ALL.len();
        let families = [first, second].map(|k| chamber::ProgrammeFamily::ALL[k]);
        let [fit, holdout] = families.map(|family| Scene::draw(family, random));
        let specimen = self.specimen(random);
        let nominal = Plant::new(specimen.clone(), Some(&self.nominal))?;
        let nominal_fit = fit.signal(&nominal, &[]);
        let judge = Judge::new([&self.nominal, &self.airier], &fit, &nominal_fit, &noise, &sensors);
        let mut effects = Vec::new();
        let mut strengths = Vec::new();
        if let Which::Concealed(n) = which {
            for kind in kinds(n, random) {
                let (effect, strength) = self.sized(&kind, &specimen, &nominal, &fit, &judge, random)?;
                effects.push(effect);
                strengths.push(strength);
            }
        }
        let mut build = specimen;
        effects.iter().for_each(|effect| effect.build_into(&mut build));
        let plant = Plant::new(build, Some(&nominal))?;
        let signals = [&fit, &holdout].map(|scene| (scene.signal(&nominal, &[]), scene.signal(&plant, &effects)));
        let arw = random.chance(0.4).then(|| noise.arw * (1.0 + 0.1 * random.normal()));
        let mut write = |scene: &Scene, signal: &Signal, since: f64| {
            let readings = noise.sample(&scene.time, since, random);
            sensors.write(&scene.course, &scene.time, signal, &readings, noise.white(0.0), random)
        };
        let later = fit.time[fit.time.len() - 1] + 6.0 * 3600.0;
        let (fit_text, holdout_text) = (write(&fit, &signals[0].1, 0.0), write(&holdout, &signals[1].1, later));
        let mut mechanisms: Vec<_> = effects.iter().map(Effect::mechanism).collect();
        let confusable_sets = mechanisms.iter().map(|m| vec![m.id.clone()]).collect();
        if mechanisms.is_empty() {
            mechanisms.push(truth::ConcealedEffect { id: "none".into(), ..Default::default() });
        }
        let rms = |series: &[f64]| (series.iter().map(|x| x * x).sum::<f64>() / series.len() as f64).sqrt();
        let sizes = truth::Sizes {
            fit_nominal: rms(&signals[0].0.rate),
            fit_true: rms(&signals[0].1.rate),
            fit_difference: rms(&minus(&signals[0].1.rate, &signals[0].0.rate)),
            holdout_difference: rms(&minus(&signals[1].1.rate, &signals[1].0.rate)),
        };
        let truth = Truth {
            mechanisms,
            snr: strengths,
            confusable_sets,
            noise: noise.truth(),
            spool_sensor: SpoolSensor { noise_c: THERMOMETER, quantisation_c: sensors.resolution, offset_c: sensors.offset },
            noise_free_rms_deg_per_h: sizes,
            profiles: families.map(|f| format!("{f:?}")),
        };
        Ok(Unit { fit: fit_text, holdout: holdout_text, meta: meta(&sensors, arw), truth: truth.write()? })
    }

    /// A member of a family sized to a strength at random, alone in the unit.
    fn sized(
        &self,
        kind: &Kind,
        specimen: &Build,
        nominal: &Plant,
        scene: &Scene,
        judge: &Judge<'_>,
        random: &mut Random,
    ) -> Result<(Effect, Strength), Failure> {
        let wanted = random.log_uniform(STRENGTH[0], STRENGTH[1]);
        let tried = |effect: Effect| -> Result<(Effect, Strength), Failure> {
            let mut build = specimen.clone();
            effect.build_into(&mut build);
            let signal = scene.signal(&Plant::new(build, Some(nominal))?, &[effect]);
            Ok((effect, judge.strength(&effect.mechanism().id, &signal)))
        };
        let off = |strength: &Strength| (strength.snr.max(1e-9) / wanted).ln();
        let mut best = tried(kind.draw(random))?;
        for _ in 0..TRIES {
            if off(&best.1).abs() < NEAR.ln() {
                break;
            }
            let next = match best.0.scaled((-off(&best.1)).exp()) {
                Some(same) if same == best.0 => break,
                Some(next) => tried(next)?,
                None => tried(kind.draw(random))?,
            };
            if off(&next.1).abs() < off(&best.1).abs() {
                best = next;
            }
        }
        Ok(best)
    }
}

enum Kind {
    Library(effect::EffectFamily),
    Outside(usize),
}

impl Kind {
    fn draw(&self, random: &mut Random) -> Effect {
        match self {
            Self::Library(family) => Effect::draw(*family, random),
            Self::Outside(kind) => Effect::Outside(Outside::draw(*kind, random)),
        }
    }
}

/// Concealed kinds of the n-th unit: of twenty, two are outside the library, three hold two families, fifteen one; families in turn.
fn kinds(n: usize, random: &mut Random) -> Vec<Kind> {
    const ROUND: usize = 20;
    let (round, place) = (n / ROUND, n % ROUND);
    let all = effect::EffectFamily::ALL;
    match place {
        9 | 19 => vec![Kind::Outside((2 * round + place / 10) % SHAPES)],
        4 | 11 | 16 => {
            let first = all[random.below(all.len())];
            loop {
                let second = all[random.below(all.len())];
                if second != first && !(first.is_law() && second.is_law()) {
                    return vec![Kind::Library(first), Kind::Library(second)];
                }
            }
        }
        _ => {
            let before = [4, 9, 11, 16].iter().filter(|other| **other < place).count();
            vec![Kind::Library(all[(15 * round + place - before) % all.len()])]
        }
    }
}

/// Sampling of a record, as RON.
pub(super) fn meta(sensors: &Sensors, arw: Option<f64>) -> String {
    format!(
        "(\n    design: \"reference-coil\",\n    sample_interval_s: {SPAN:?},\n    rate_is: \"mean over the 30 s that end at time_s\",\n    \
         temperature_sensor: (noise_c: {THERMOMETER}, chamber_quantisation_c: 0.01, spool_quantisation_c: {}),\n    \
         nominal_arw_deg_per_sqrt_h: {},\n)\n",
        sensors.resolution,
        arw.map_or("None".into(), |arw| format!("Some({arw:.4})"))
    )
}
