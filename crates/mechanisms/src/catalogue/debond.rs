//! A bond of coil and flange whose outer part opens in the cold.

use crate::Prepared;
use crate::bond::{self, LEAST, MOST};
use crate::change::{Per, Threshold};
use crate::course::Parts;
use crate::design::{bonded_flanges, choice_of, chosen};
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady, across, grid};
use coil::{Bonds, Design, MechanicalState, Mechanics, Opening, Side};
use diagnosis::{Parameter, Prior};

pub(super) const DEBOND: Named = Named {
    id: "debond",
    title: "A bond that opens in the cold",
    stage: Stage::Bond,
    equation: "Below T_d the outer part of the bond between coil and flange, a share f of the annulus' width, carries no force; above T_d + h it carries force\n\
        again. Heat passes in either state. Nothing jumps at the switch: only rates change.",
    place: "The bond of coil and flange: `mechanics: Opening(...)`.",
    signature: "The sensitivity has one value at low and another at high temperature, with hysteresis, and is not monotonic in f. A profile that passes both\n\
        thresholds shows both values; a profile that stays below T_d shows a gain.",
    source: "J. W. Hutchinson and Z. Suo, *Advances in Applied Mechanics* 29, 63 (1992).",
    meaning: "below debond_c the outer part of the bond between coil and flange, fraction of its width, carries no force; it closes \
              hysteresis_k above",
    inspection: "look at the flange's bond with ultrasound",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Changes {
        parameter: 2,
        changed: |d, share| (with_first_opening(d, share), MechanicalState { bonds: Bonds::Opened, ..MechanicalState::NOMINAL }),
        when: "while the bond is open",
    }],
    extent: |active, _| {
        let (opens, hysteresis) = (active.values[0], active.values[1]);
        Extent { temperature: Some([opens, opens + hysteresis]), ..Extent::default() }
    },
    caveat: |_| None,
    offer: |design, scene| {
        let (range, flanges) = (scene.temperatures, flanges(design));
        // what a share does turns back within two layers: other minima are sought in each of these
        let [coldest, hottest] = range;
        let turns = (1..).map(|k| 2.0 * f64::from(k) / design.winding.layers as f64).take_while(|share| *share < MOST);
        let turned = turns.filter(|share| *share > LEAST).map(|share| vec![(coldest + hottest) / 2.0, 6.0, share]);
        (!flanges.is_empty()).then(|| Offer {
            parameters: vec![
                Parameter::new("debond_c", Prior::Uniform { low: range[0], high: range[1] })
                    .with_step(0.02)
                    .with_search(&AROUND_K),
                Parameter::new("hysteresis_k", Prior::LogNormal { median: 6.0, spread: 0.6 })
                    .with_step(0.1)
                    .with_search(&AROUND_K),
                Parameter::new("fraction", Prior::Uniform { low: LEAST, high: MOST }).with_step(0.05),
            ],
            choice: choice_of(&flanges),
            starts: grid(&[&across(range, 40), &[3.0, 9.0], &[0.05, 0.15, 0.35, 0.6]]).into_iter().chain(turned).collect(),
        })
    },
    effect: |_, record, active| {
        let v = &active.values;
        Ok(Effect::Coil(opened(record, chosen(active), v[0], v[1], v[2])))
    },
    extended: |design, active| {
        let v = &active.values;
        Some(with_opening(design, *flanges(design).get(chosen(active))?, v[0], v[1], v[2]))
    },
};

/// Distances from a fitted switching temperature at which a better one is sought \[K\]: whether a row is before the switch is all or nothing.
const AROUND_K: [f64; 6] = [0.06, 0.15, 0.4, 1.0, 2.2, 4.5];
/// A flange's bond is taken as open below this \[°C\], with this hysteresis \[K\]; in a steady state neither matters.
pub(crate) const OPENS: [f64; 2] = [0.0, 1.0];

/// Flanges whose bond can open: none in a design whose mechanics changes already.
pub(crate) fn flanges(design: &Design) -> Vec<Side> {
    if design.mechanics == Mechanics::Elastic { bonded_flanges(design) } else { Vec::new() }
}

pub(crate) fn with_opening(design: &Design, side: Side, below: f64, hysteresis: f64, fraction: f64) -> Design {
    Design { mechanics: Mechanics::Opening(Opening { side, below, hysteresis, fraction }), ..design.clone() }
}

fn with_first_opening(design: &Design, fraction: f64) -> Design {
    let [below, hysteresis] = OPENS;
    flanges(design).first().map_or_else(|| design.clone(), |side| with_opening(design, *side, below, hysteresis, fraction))
}

/// A coil whose bond opens, less one whose bond holds.
fn opened(record: &Prepared, place: usize, below: f64, hysteresis: f64, share: f64) -> Change {
    let bond = &record.bonds[place];
    let weights = bond.weights(share);
    let none = || [0, 1, 2].map(|_: usize| vec![0.0; record.time.len()]);
    let (mut change, mut per): (Parts, Vec<Parts>) = (none(), bond::constants().map(|_| none()).collect());
    let mut open = record.coil[0] < below;
    // where it opens and where it closes
    let mut passed = [Vec::new(), Vec::new()];
    for n in 1..record.time.len() {
        // part of the interval after a threshold is crossed, the temperature being linear in it
        let (from, to) = (record.coil[n - 1], record.coil[n]);
        let after = |threshold: f64| if to == from { 0.0 } else { ((to - threshold) / (to - from)).clamp(0.0, 1.0) };
        let part = if open {
            let closes = to > below + hysteresis;
            open = !closes;
            passed[1].extend(closes.then_some(n));
            if closes { 1.0 - after(below + hysteresis) } else { 1.0 }
        } else {
            open = to < below;
            passed[0].extend(open.then_some(n));
            if open { after(below) } else { 0.0 }
        };
        if part > 0.0 {
            bond.add_to(&mut change, &mut per, &weights, n, part);
        }
    }
    // a hysteresis is known where both are
    let both = if passed.iter().all(|rows| !rows.is_empty()) { 1.0 } else { 0.0 };
    let of = |(number, parameters): (usize, [f64; 2])| {
        passed[number].iter().map(move |row| Threshold { row: *row, number, parameters: parameters.to_vec() })
    };
    let thresholds = [[1.0, -both], [0.0, both]].into_iter().enumerate().flat_map(of).collect();
    Change { per: Per::of_a_bond(per), thresholds, ..Change::of_parts(change) }
}
