//! Description of an unexplained residual, in words: temperatures, kelvins and hours for levels, periods and instants.

use bias::units::S_PER_H;
use diagnosis::{Active, ForwardModel, Rival, Structure};
use mechanisms::Naming;

use super::Outcome;
use crate::table::significant;

impl Outcome<'_> {
    /// Description of the residual where nothing explains it.
    pub(super) fn structure(&self) -> Option<String> {
        let best = self.diagnosis.best();
        let mut parts: Vec<String> = best.fit.active.iter().filter_map(|active| self.like(active)).collect();
        if let Some(rival) = &best.rival {
            let channel = &self.gyro.channels()[rival.channel].name;
            parts.push(format!("what is left in {channel} is {}", self.describe(rival)));
        }
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The structure that a mechanism describes, and the id it is known by; `None` for one that explains.
    fn like(&self, active: &Active) -> Option<String> {
        let facts = self.gyro.mechanism(active.mechanism).facts();
        let Naming::Described { likeness } = facts.naming else { return None };
        let short = facts.id.trim_start_matches("unknown:");
        Some(format!("the difference is {} (as of {short})", likeness(&active.values, &significant)))
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
