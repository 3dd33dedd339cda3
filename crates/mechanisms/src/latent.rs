//! Flexible inputs at every stage of a coil's chain, and what single layers do.

use crate::bond::Bond;
use crate::course::{Parts, total};
use crate::law_tools::Chain;
use crate::mechanism::{Change, Mechanism, Stage};
use crate::record_to_bias::Prepared;
use crate::series::{lagged, rates_per_hour};
use coil::{Error, Parameter};
use diagnosis::Latent;

/// Smooth functions of temperature that a flexible input is made of.
const HATS: usize = 9;
/// Time constants with which a material may lag behind \[s\].
const LAGS: [f64; 3] = [1000.0, 4000.0, 12000.0];
/// A heater's power \[W\], and when it may have been switched on before the record \[s\].
const POWER: f64 = 0.1;
const SWITCHED_ON: [f64; 4] = [1.0, 60.0, 300.0, 1500.0];
/// Factors on transverse modulus and expansion.
const SOFTER: f64 = 0.95;
const WIDER: f64 = 1.02;
/// Filters through which a unit may use its thermometer's rate \[s\].
const FILTERS: [f64; 2] = [30.0, 120.0];
/// A thermometer's lag \[s\].
const LAG: f64 = 30.0;
/// Tail \[m\] and every which layer for the winding as a whole.
const TAIL: f64 = 0.05;
const EVERY: usize = 6;

/// Functions `[function][channel][row]`.
type Functions = Vec<Vec<Vec<f64>>>;

/// Hats over the range of the coil's temperature, a partition of unity.
fn hats(x: &[f64]) -> Vec<Vec<f64>> {
    let (low, high) = x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let step = (high - low) / (HATS - 1) as f64;
    if step.is_nan() || step <= 0.0 {
        return vec![vec![1.0; x.len()]];
    }
    let hat = |k: usize| x.iter().map(|v| (1.0 - ((v - low) / step - k as f64).abs()).max(0.0)).collect();
    (0..HATS).map(hat).collect()
}

fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).collect()
}

/// Thermometer and rate, each times every hat.
fn shaped(change: &Change, hats: &[Vec<f64>]) -> Functions {
    let rate = total(&change.parts);
    let still = vec![0.0; rate.len()];
    let sensor = change.thermometer.as_ref().unwrap_or(&still);
    hats.iter().map(|h| vec![times(sensor, h), times(&rate, h)]).collect()
}

impl Chain {
    /// A flexible input at every stage.
    pub(crate) fn latent(&self, mechanisms: &[&dyn Mechanism], record: &Prepared) -> Result<Vec<Latent>, Error> {
        let hats = hats(&record.coil);
        let rows = record.time.len();
        let of_rate = |series: Vec<f64>| vec![vec![0.0; rows], series];
        let mut stages = Vec::new();
        let mut add = |stage: Stage, functions: Functions| stages.push(Latent { stage: stage.name().to_owned(), functions });

        let mut thermal = Functions::new();
        for mechanism in mechanisms {
            let facts = mechanism.facts();
            if let Some((path, nudge)) = facts.heat_path.as_ref().and_then(|path| Some((path, path.nudge?))) {
                let places = 0..(path.places)(self.library().design());
                places.for_each(|place| thermal.extend(shaped(&self.nudged(record, facts.id, place, nudge), &hats)));
            }
        }
        for before in SWITCHED_ON {
            let scaled = |series: &[f64]| series.iter().map(|x| POWER * x).collect();
            let heated = (0..record.heaters.len()).filter_map(|place| self.heated(record, place, before));
            let functions = heated.map(|heated| vec![scaled(&heated.sensor), total(&heated.parts.each_ref().map(|p| scaled(p)))]);
            thermal.extend(functions);
        }
        add(Stage::Thermal, thermal);

        let softer = Change::of_parts(self.softened(record, |_| (SOFTER, 1.0)));
        let wider = Change::of_parts(self.softened(record, |_| (1.0, WIDER)));
        let mut material: Functions = shaped(&softer, &hats);
        material.extend(shaped(&wider, &hats));
        material.extend(LAGS.iter().map(|lag| of_rate(lagged(&record.time, &total(&softer.parts), *lag))));
        let off = |which: fn(Parameter) -> bool| {
            let constants = self.library().constants.iter().zip(&record.slopes).filter(move |(c, _)| which(c.parameter));
            constants.map(|(c, slope)| of_rate(total(&slope.parts).iter().map(|x| x * c.tolerance).collect()))
        };
        material.extend(off(|of| of.of_mechanics() && !of.of_winding()));
        add(Stage::Material, material);

        let some = |bond: &Bond<Parts>| {
            let last = bond.openings.len() - 1;
            [0, last / 2, last].map(|k| bond.openings[k].drawn.clone())
        };
        let bond = record.bonds.iter().flat_map(some);
        add(Stage::Bond, bond.flat_map(|open| shaped(&Change::of_parts(open), &hats)).collect());

        let layers = self.library().design().winding.layers;
        let mut winding = vec![of_rate(total(&self.with_tail(record, TAIL)?))];
        winding.extend(off(Parameter::of_winding));
        for layer in (1..=layers).step_by(EVERY) {
            winding.push(of_rate(total(&self.with_turns(record, layer, 1.0)?)));
        }
        add(Stage::Winding, winding);

        let [shupe, ..] = &record.nominal.parts;
        let mut optics: Functions = hats.iter().map(|h| of_rate(times(shupe, h))).collect();
        optics.push(of_rate(record.curved.clone()));
        add(Stage::Optics, optics);

        let spool = &record.nominal.sensor;
        let mut electronics: Functions = hats.iter().map(|h| of_rate(h.clone())).collect();
        // a unit knows its own thermometer
        electronics
            .extend(FILTERS.iter().map(|filter| of_rate(rates_per_hour(&record.time, &lagged(&record.time, spool, *filter)))));
        add(Stage::Electronics, electronics);

        let behind: Vec<f64> = lagged(&record.time, spool, LAG).iter().zip(spool).map(|(a, b)| a - b).collect();
        let of_spool = |series: Vec<f64>| vec![series, vec![0.0; rows]];
        let mut sensor = vec![of_spool(behind)];
        sensor.extend(hats.iter().map(|h| of_spool(h.clone())));
        add(Stage::Sensor, sensor);
        Ok(stages)
    }

    pub(crate) fn layers(&self, record: &Prepared) -> Result<Latent, Error> {
        let rows = record.time.len();
        let layers = 1..=self.library().design().winding.layers;
        let of = |layer| Ok(vec![vec![0.0; rows], total(&self.with_turns(record, layer, 1.0)?)]);
        Ok(Latent { stage: Stage::Winding.name().to_owned(), functions: layers.map(of).collect::<Result<_, Error>>()? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_coil_that_rests_has_one_shape() {
        assert_eq!(hats(&[25.0; 3]), [[1.0; 3]]);
        assert_eq!(hats(&[20.0, 21.0, 28.0]).len(), HATS);
    }
}
