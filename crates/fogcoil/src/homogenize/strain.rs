//! Strains of each phase under a load, as a table and as JSON.

use homogenization::Error;
use homogenization::fields::{Component, Convention, Fields, Load, PhaseStrain};
use homogenization::irregular::Solution;
use serde_json::{Map, Value, json};

use super::load::words;
use crate::table::{significant, table};
use crate::units::to_ppm;

const CONVENTIONS: [(&str, Convention); 2] = [("total", Convention::Total), ("mechanical", Convention::Mechanical)];

/// The strains of the phases of a solved cell under a load.
pub struct Strains {
    load: Load,
    names: Vec<String>,
    phases: Vec<PhaseStrain>,
}

impl Strains {
    /// Takes them.
    ///
    /// # Errors
    /// As [`Fields::summary`].
    pub fn new(solution: &Solution, load: Load) -> Result<Self, Error> {
        let names = solution.phases.iter().map(|p| p.name.clone()).collect();
        Ok(Self { load, names, phases: Fields::new(solution, load).summary()? })
    }

    /// Mean, least and largest of each component in each phase, in 10⁻⁶.
    pub fn text(&self) -> String {
        let mut rows = vec![vec!["phase".into(), "strain".into()]];
        for (name, _) in CONVENTIONS {
            rows[0].extend(["mean", "least", "most"].map(|what| format!("{name} {what}")));
        }
        rows[0].push("unit".into());
        for phase in &self.phases {
            for component in Component::ALL {
                let spreads = CONVENTIONS.map(|(_, convention)| phase.get(component, convention));
                if spreads[0].mean.is_nan() {
                    continue;
                }
                let name = if component == Component::ALL[0] { self.names[phase.phase].clone() } else { String::new() };
                let mut row = vec![name, component.name().replace('_', " ")];
                row.extend(spreads.iter().flat_map(|s| [s.mean, s.least, s.most].map(|v| significant(to_ppm(v), 5))));
                row.push("1e-6".into());
                rows.push(row);
            }
        }
        format!(
            "strain of each phase under {} (macroscopic total strain, K); mean over its area, least and most at points of a grid;\n\
             mechanical: less the free expansion of the phase; mean radial: (xx + yy)/2; radial, hoop: about the fibre's axis\n\n{}",
            words(&self.load),
            table(&rows)
        )
    }

    /// Summary by phase, component and convention: mean, least, most. Components without meaning are left out.
    pub fn json(&self) -> Value {
        let mut phases = Map::new();
        for phase in &self.phases {
            let mut components = Map::new();
            for component in Component::ALL {
                let mut both = Map::new();
                for (name, convention) in CONVENTIONS {
                    let s = phase.get(component, convention);
                    if !s.mean.is_nan() {
                        both.insert(name.into(), json!({"mean": s.mean, "least": s.least, "most": s.most}));
                    }
                }
                if !both.is_empty() {
                    components.insert(component.name().into(), both.into());
                }
            }
            phases.insert(self.names[phase.phase].clone(), components.into());
        }
        json!({"load": words(&self.load), "phases": phases})
    }
}
