//! What a residual looks like that nothing explains, in words: temperatures, kelvins and hours for levels, periods and instants.

use bias::units::S_PER_H;
use diagnosis::{Active, ForwardModel, Rival, Structure};

use super::Outcome;
use crate::table::significant;

impl Outcome {
    /// What the residual looks like where nothing explains it.
    pub(super) fn structure(&self) -> Option<String> {
        let best = self.diagnosis.best();
        let beyond = best.fit.active.iter().filter(|a| !self.gyro.mechanisms()[a.mechanism].named);
        let mut parts: Vec<String> = beyond.map(|active| self.like(active)).collect();
        if let Some(rival) = &best.rival {
            let channel = &self.gyro.channels()[rival.channel].name;
            parts.push(format!("what is left in {channel} is {}", self.describe(rival)));
        }
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The shape of a mechanism that is no explanation, and what it is known from.
    fn like(&self, active: &Active) -> String {
        let entry = &self.gyro.mechanisms()[active.mechanism];
        let of = |name: &str| entry.parameters.iter().position(|p| p.name == name).map_or(f64::NAN, |at| active.values[at]);
        let short = entry.id.trim_start_matches("unknown:");
        let percent = |name: &str| format!("by {} % a kelvin", significant(100.0 * of(name), 2));
        let shape = match short {
            "polarisation-ripple" => format!(
                "periodic in the spool's temperature, with a period of {} K and an amplitude of {} deg/h",
                significant(of("period_k"), 3),
                significant(of("sine_deg_per_h").hypot(of("cosine_deg_per_h")), 2)
            ),
            "moisture" => format!("decaying with time, over {} h", significant(of("time_s") / S_PER_H, 2)),
            "ratcheting" => "present where a temperature is reached for the first time".into(),
            "spool-expansion" => {
                format!("like the spool's expansion changing with temperature, {}", percent("expansion_per_k2_relative"))
            }
            "racket" => format!("a sensitivity that changes with temperature, {}", percent("relative_per_k")),
            "magnetic" => "proportional to the rate of the chamber's temperature".into(),
            _ => return format!("the difference looks like {short}"),
        };
        format!("the difference is {shape} (as of {short})")
    }

    pub(super) fn describe(&self, rival: &Rival) -> String {
        match (rival.structure, rival.at) {
            (Structure::PeriodicInLevel, Some(period)) => {
                format!("periodic in the spool's temperature, with a period of about {} K", significant(period, 2))
            }
            (Structure::PeriodicInLevel, None) => "periodic in the spool's temperature".into(),
            (Structure::Level, _) => "a function of the spool's temperature".into(),
            (Structure::RateByLevel, _) => {
                "proportional to the spool's temperature rate, with a factor that depends on temperature".into()
            }
            (Structure::Rate, _) => "a nonlinear function of the spool's temperature rate".into(),
            (Structure::History, _) => "a function of the temperature's history (lagged temperature rate)".into(),
            (Structure::Acceleration, _) => "proportional to the change of the temperature rate".into(),
            (Structure::Direction, _) => "dependent on whether the temperature rises or falls".into(),
            (Structure::Step, Some(at)) => {
                let first = self.fits.first().and_then(|record| record.observed.time.first()).unwrap_or(&0.0);
                format!("a step about {} h after the first row", significant((at - first) / S_PER_H, 3))
            }
            (Structure::Step, None) => "a step in time".into(),
            (Structure::Accumulation, _) => "accumulating with time or with temperature cycling".into(),
        }
    }
}
