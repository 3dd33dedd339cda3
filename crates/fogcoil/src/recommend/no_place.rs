//! Reasons why an id cannot be told apart from others.

use coil::{Design, Mechanics};
use diagnosis::ForwardModel;
use mechanisms::{Gyro, Mechanism, ON_REQUEST};

use super::bench::Contender;
use crate::input::meant;

/// Message on an id that the library of a design does not hold, where these `mechanisms` were asked for.
pub(super) fn not_there(id: &str, gyro: &Gyro, mechanisms: &[&dyn Mechanism]) -> String {
    if mechanisms.iter().any(|mechanism| mechanism.facts().id == id) {
        let why = why(id, gyro.library().design());
        return format!(
            "--between: this design has no place for `{id}`: {why}; leave it out of --between, or mend the coil file"
        );
    }
    if ON_REQUEST.iter().any(|mechanism| mechanism.facts().id == id) {
        return format!("--between: `{id}` is weighed on request: add --mechanism {id}");
    }
    let further = ON_REQUEST.iter().map(|mechanism| mechanism.facts().id);
    let known = gyro.mechanisms().iter().map(|mechanism| mechanism.id.as_str());
    format!(
        "--between: `{id}` is not in this design's library; it holds {}, those that are weighed on request, and mechanisms of your own \
         (--mechanism){}",
        Contender::known(gyro),
        meant(id, known.chain(further))
    )
}

/// Reason why a design leaves a mechanism no place.
fn why(id: &str, design: &Design) -> String {
    let flanges = design.spool.as_ref().map_or(0, |spool| spool.flanges.len());
    match id {
        "debond" | "self-heating" | "axial-heat-path" if flanges == 0 => {
            "it acts at a flange, and the spool has none (spool.flanges)".to_owned()
        }
        "self-heating" => "it has heaters of its own (heat.heaters)".to_owned(),
        "axial-heat-path" if !design.heat.mounts.is_empty() => {
            "it has mounts of its own (heat.mounts), which `mount-conductance` changes".to_owned()
        }
        "mount-conductance" => "it has no mount (heat.mounts); one that is not drawn is `axial-heat-path`".to_owned(),
        "ratcheting" => "it is without a spool".to_owned(),
        "adhesive-content" => "its constants are not those of silica in a polymer (coil.material)".to_owned(),
        "scale-factor-drift" | "modulator-reset" => "it needs Earth's rate, which no programme tells".to_owned(),
        "debond"
        | "viscoelastic-relaxation"
        | "glass-transition"
        | "drying"
        | "moisture"
        | "racket"
        | "stress-free-temperature"
            if design.mechanics != Mechanics::Elastic =>
        {
            "its mechanics is not Elastic".to_owned()
        }
        "debond" => "no flange is bonded to the coil (spool.flanges)".to_owned(),
        _ => {
            "it has a part of that kind already, or none on which that acts (`fogcoil explain mechanism-not-offered`)".to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::read_coil;

    #[test]
    fn a_design_says_what_it_lacks() {
        let case = read_coil(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron").as_ref()).unwrap();
        let mut bare = case.design.clone();
        if let Some(spool) = &mut bare.spool {
            spool.flanges.clear();
        }
        assert!(why("debond", &bare).contains("the spool has none (spool.flanges)"));
        let mut loose = case.design.clone();
        if let Some(spool) = &mut loose.spool {
            spool.flanges.iter_mut().for_each(|flange| flange.contact = coil::Contact::Gap);
        }
        assert!(why("debond", &loose).contains("no flange is bonded"));
        assert!(why("ratcheting", &Design { spool: None, ..case.design }).contains("without a spool"));
    }
}
