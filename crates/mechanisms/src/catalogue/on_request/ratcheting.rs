//! The racket effect, read as a ratchet: a grip that slips the first time a temperature is reached.

use crate::course::Parts;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady, grid};
use diagnosis::{Parameter, Prior};

pub(super) const RATCHETING: Named = Named {
    id: "ratcheting",
    title: "The racket effect, read as a ratchet",
    stage: Stage::Bond,
    equation: "The spool's grip of the coil slips where the coil is warmer, or colder, than ever before, and holds within that range. The range grows with the\n\
        temperatures that are reached:\n\
        \n\
        ```\n\
        elasto-optic parts → (1 − s) of them   while T > T_high or T < T_low,   T_high, T_low = the highest and the lowest T so far\n\
        ```\n\
        \n\
        T is the coil's mean temperature. At the first row the range reaches `before_k` to either side of it.",
    place: "The bond of coil and spool; a coil file has no key for it.",
    signature: "The first cycle differs from all later ones. The sensitivity is smaller while new temperatures are reached, and as designed on the way back and\n\
        in a second cycle. A bond that opens in the cold does so in every cycle.",
    source: "The paper names a racket effect without a source; slip that stops once a range has been passed is shakedown: K. L. Johnson, *Contact Mechanics*, Cambridge (1985), ch. 7 and 9.",
    meaning: "the coil slips on its spool by slipping_fraction of its strain where it goes beyond all temperatures before; those were before_k about the first row",
    inspection: "repeat the same cycle: the second one has none of it",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("within the temperatures that the coil has seen nothing changes")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        design.spool.is_some().then(|| Offer {
            parameters: vec![
                Parameter::new("slipping_fraction", Prior::Uniform { low: 0.0, high: 1.0 }),
                Parameter::new("before_k", Prior::LogNormal { median: 10.0, spread: 1.0 }).with_step(0.05),
            ],
            choice: None,
            starts: grid(&[&[0.1], &[2.0, 6.0, 15.0, 30.0]]),
        })
    },
    effect: |_, record, active| {
        let (share, before) = (active.values[0], active.values[1]);
        let slips = slips(record.coil(), before);
        let nominal = record.parts();
        let of = |p: usize| nominal[p].iter().zip(&slips).map(|(part, slip)| -share * slip * part).collect();
        let parts: Parts = [vec![0.0; slips.len()], of(1), of(2)];
        Ok(Effect::Coil(Change::of_parts(parts)))
    },
    extended: |_, _| None,
};

/// Share of each interval in which a temperature beyond all before is reached, being linear in it; the range begins so many kelvins about the first.
fn slips(temperature: &[f64], before: f64) -> Vec<f64> {
    let (mut low, mut high) = (temperature[0] - before, temperature[0] + before);
    let mut slips = vec![0.0];
    for w in temperature.windows(2) {
        let beyond = (w[1] - high).max(low - w[1]).max(0.0);
        slips.push(if beyond > 0.0 { (beyond / (w[1] - w[0]).abs()).min(1.0) } else { 0.0 });
        (low, high) = (low.min(w[1]), high.max(w[1]));
    }
    slips
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_only_what_is_new_slips() {
        let course = [20.0, 24.0, 28.0, 32.0, 28.0, 12.0, 8.0, 20.0, 32.0, 33.0];
        assert_eq!(slips(&course, 6.0), [0.0, 0.0, 0.5, 1.0, 0.0, 0.125, 1.0, 0.0, 0.0, 1.0]);
        // twice the same: the second time nothing does
        let again = [&course[..], &course[..]].concat();
        assert!(slips(&again, 6.0)[course.len()..].iter().all(|slip| *slip == 0.0));
        // a course turned over about its first row slips alike
        let mirrored: Vec<f64> = course.iter().map(|t| 40.0 - t).collect();
        assert_eq!(slips(&mirrored, 6.0), slips(&course, 6.0));
        assert_eq!(slips(&[20.0; 3], 0.0), [0.0; 3]);
    }
}
