//! The nominal model with its uncertain numbers somewhere: constants of the design, sensors, errors of the model.

use super::Gyro;
use super::recalibrated::{ByHeat, Recalibrated, share};
use crate::change::Change;
use crate::constants::Constant;
use crate::course::{Series, add};
use crate::instruments;
use crate::record_to_bias::Prepared;
use crate::series::lagged;
use std::sync::{Arc, OnceLock};

/// Change of the thermometer by a constant's tolerance below which that changes no temperature \[K\]: rounding.
const COLD_K: f64 = 1e-9;
/// Least factor on a constant that goes along a path of heat.
const LEAST: f64 = 1e-3;
/// Constants that are moved from where others are known.
const FEW: usize = 2;

impl Gyro<'_> {
    /// The derivative by a constant, and by how much it goes from one value to another, as told.
    fn slope<'a>(&self, record: &'a Prepared, k: usize, way: [f64; 2]) -> (&'a Series, f64) {
        let [from, to] = way.map(|told| self.library().constants[k].value(told));
        (&record.slopes[k], to - from)
    }

    /// Adds what constants change, those at `moved`, on their way from some values to others, as told.
    ///
    /// Where a path of heat follows one of them, all go along the path as far as they do to the temperatures what that one does, each by the logarithm of
    /// itself: the path bends, and what makes up for each other, such as a gap as much wider as what fills it conducts better, stays where it is on it.
    /// Beyond that, each is linear. So to first order each does what its derivative says.
    fn change_constants(&self, record: &Prepared, moved: &[usize], [from, to]: [&[f64]; 2], series: &mut Series) {
        let mut linear: Vec<_> = moved.iter().map(|k| self.slope(record, *k, [from[*k], to[*k]])).collect();
        if let Some((place, id)) = self.factored.first() {
            let alike: f64 = moved.iter().zip(&linear).map(|(k, (_, by))| record.alike[*k] * by).sum();
            linear.push((&record.slopes[*place], -alike));
            let [ahead, behind] = [to, from].map(|told| self.coordinate(record, *place, told));
            if ahead != behind {
                for (coordinate, sign) in [(ahead, 1.0), (behind, -1.0)] {
                    let Change { parts, thermometer, .. } = self.chain.along(record, id, 0, coordinate);
                    series.change(&Series { sensor: thermometer.unwrap_or_default(), parts }, sign);
                }
            }
        }
        series.change_by_all(&linear);
    }

    /// Where constants, as told, are on the path of heat that follows the one at `place`.
    fn coordinate(&self, record: &Prepared, place: usize, told: &[f64]) -> f64 {
        let (constants, own) = (&self.library().constants, self.library().values());
        let of = |k: usize| {
            let elasticity = record.alike[k] * own[k] / own[place];
            if elasticity == 0.0 { 0.0 } else { elasticity * (constants[k].value(told[k]) / own[k]).max(LEAST).ln() }
        };
        (own[place] / constants[place].drawn).ln() + (0..told.len()).map(of).sum::<f64>()
    }

    /// Parts and thermometer with the design's constants at those of `u`; kept for as long as other numbers are varied, or one of them.
    fn with_constants(&self, record: usize, u: &[f64]) -> Series {
        let told = &u[instruments::CONSTANTS..];
        let prepared = &self.records[record];
        let mut moved = self.moved.borrow_mut();
        let differs = |known: &[f64]| (0..told.len()).filter(|k| known[*k] != told[*k]).collect::<Vec<_>>();
        if let Some((_, known, series)) = moved.iter().find(|(own, known, _)| *own == record && differs(known).len() <= FEW) {
            let mut series = series.clone();
            self.change_constants(prepared, &differs(known), [known, told], &mut series);
            return series;
        }
        let mut series = prepared.nominal.clone();
        let own: Vec<f64> =
            self.library().constants.iter().zip(self.library().values()).map(|(c, value)| c.told(value)).collect();
        self.change_constants(prepared, &(0..told.len()).collect::<Vec<_>>(), [&own, told], &mut series);
        moved.retain(|(own, ..)| *own != record);
        moved.push((record, told.to_vec(), series.clone()));
        series
    }

    /// The nominal model with its uncertain numbers at `u`; kept for as long as mechanisms' own are varied.
    pub(super) fn recalibrated(&self, number: usize, u: &[f64]) -> Arc<Recalibrated> {
        let mut known = self.recalibrated.borrow_mut();
        if let Some(same) = known.iter().find(|known| known.record == number && known.at == u) {
            return Arc::clone(same);
        }
        let here = Arc::new(self.with_nuisances(number, u));
        known.retain(|known| known.record != number);
        known.push(Arc::clone(&here));
        here
    }

    fn with_nuisances(&self, number: usize, u: &[f64]) -> Recalibrated {
        let (record, library) = (&self.records[number], self.library());
        let mut series = self.with_constants(number, u);
        let mut change = |of: &Series, factor: f64| series.change(of, factor);
        // (1 + τ d/dt) e^(c d/dt) beside the values at which the model is exact, of the delay to the second order
        let late = u[instruments::CHAMBER_DELAY] - record.delay.total();
        let squared = u[instruments::CHAMBER_LAG_SQUARED] - record.delay.lag.powi(2);
        change(&record.later, late);
        change(&record.rates[1], late * late / 2.0);
        change(&record.slower, squared);
        change(&record.off_rest, u[instruments::REST]);
        let Series { mut parts, mut sensor } = series;
        // by a little, with what mechanisms add as far as that is a share of the parts; by more, all of the rate is late
        if !instruments::may_be_late(&self.nuisances) {
            let late = u[instruments::RATE_DELAY];
            let bent = (u[instruments::RATE_FILTER] + late * late) / 2.0;
            parts.iter_mut().zip(&record.rates[1].parts).for_each(|(part, second)| add(part, second, bent));
            parts.iter_mut().zip(&record.rates[0].parts).for_each(|(part, first)| add(part, first, -late));
        }
        let thermo_optic = {
            let o = &library.design().optics;
            let (a, b) = (o.thermo_optic, o.refractive_index * o.thermal_expansion);
            (a * u[instruments::THERMO_OPTIC] + b) / (a + b)
        };
        // a chamber that moved by more than its thermometer said moves everything by more, from rest
        let more = 1.0 / u[instruments::CHAMBER_GAIN];
        let factors = [thermo_optic * u[instruments::SHUPE] * more, more, more];
        let mut gain = [1.0; 3];
        for (p, part) in parts.iter_mut().enumerate() {
            // of a part that is nothing throughout, as at rest, nobody can say what share is left: all
            if record.squares[p] > 0.0 {
                let moved: Vec<f64> = part.iter().zip(&record.nominal.parts[p]).map(|(here, drawn)| here - drawn).collect();
                gain[p] = factors[p] * (1.0 + share(&moved, record, p));
            }
            part.iter_mut().for_each(|x| *x *= factors[p]);
        }
        // a tail weighs the coil's rates otherwise, which is no gain on what changes them
        let tails = [0, 1, 2].map(|p: usize| u[instruments::TAIL] * factors[p]);
        let of_tails = [0, 1, 2].map(|p: usize| record.tail[p].iter().map(|x| x * tails[p]).collect());
        let rest = sensor[0];
        sensor.iter_mut().for_each(|t| *t = rest + (*t - rest) * more);
        let (at, by_heat) = (u.to_vec(), OnceLock::new());
        Recalibrated { record: number, at, parts, of_tails, thermometer: sensor, gain, factors, by_heat }
    }

    /// What is recalibrated without the constants that change no temperature.
    pub(super) fn by_heat<'a>(&self, here: &'a Recalibrated) -> &'a ByHeat {
        let told = &here.at[instruments::CONSTANTS..];
        here.by_heat.get_or_init(|| {
            let record = &self.records[here.record];
            let constants = self.library().constants.iter().zip(self.library().values()).enumerate();
            let of = |(k, (constant, value)): (usize, (&Constant, f64))| {
                let slope = self.slope(record, k, [constant.told(value), told[k]]);
                slope.0.sensor.iter().all(|t| t.abs() * constant.tolerance < COLD_K).then_some(slope)
            };
            let mut mechanical = record.nominal.nothing();
            mechanical.change_by_all(&constants.filter_map(of).collect::<Vec<_>>());
            let mut found = ByHeat { parts: here.parts.clone(), gain: here.gain };
            for (p, factor) in here.factors.iter().enumerate() {
                add(&mut found.parts[p], &mechanical.parts[p], -factor);
                found.gain[p] -= factor * share(&mechanical.parts[p], record, p);
            }
            found
        })
    }

    /// Reading of a thermometer of the spool from its temperature.
    pub(super) fn read(&self, record: &Prepared, thermometer: &mut Vec<f64>, u: &[f64]) {
        let lag = self.library().design().sensor.lag * u[instruments::LAG];
        if lag > 0.0 {
            *thermometer = lagged(&record.time, thermometer, lag);
        }
    }
}
