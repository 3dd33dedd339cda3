//! The tools that mechanisms' laws are written with: a library's models under the chamber of a recording, changed.

use crate::change::Change;
use crate::course::{Functionals, Parts, Series, add};
use crate::interpolation::{Lagrange, weights};
use crate::library::Library;
use crate::record_to_bias::{Along, Prepared};
use crate::series::rates_per_hour;
use bias::units::{DEG_PER_H_PER_RAD_PER_S, S_PER_H};
use coil::Error;
use std::cell::RefCell;
use std::collections::HashMap;
use winding::LayerDefect;

/// A library with what is worked out from it once for all recordings.
pub struct Chain {
    library: Library,
    /// functionals of rewound coils by layer (0 for none) and size, as they were asked for
    rewound: RefCell<HashMap<(usize, u64), Functionals>>,
}

impl Chain {
    pub(crate) fn new(library: Library) -> Self {
        Self { library, rewound: RefCell::default() }
    }

    /// The models.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// Sensitivity of the library's own design in a steady ramp, of all parts together \[deg/h per K/s\].
    pub fn steady_sensitivity(&self) -> f64 {
        // without a mode: the chamber's drive alone
        self.library.base.parts().iter().map(|part| DEG_PER_H_PER_RAD_PER_S * part.vector()[0]).sum()
    }

    /// Response of the coil at a coordinate of the heat path of mechanism `id` at a place, counted from 0, less that of the library's own design.
    pub fn along(&self, record: &Prepared, id: &str, place: usize, coordinate: f64) -> Change {
        Self::path(record, id, place).map_or_else(|| Self::still(record), |path| Self::at(record, path, coordinate))
    }

    /// Change by a small step along a heat path, from the library's own design.
    pub(crate) fn nudged(&self, record: &Prepared, id: &str, place: usize, by: f64) -> Change {
        let step = |path: &Along| Self::at(record, path, stepped(&path.nodes, path.own, by));
        Self::path(record, id, place).map_or_else(|| Self::still(record), step)
    }

    fn path<'a>(record: &'a Prepared, id: &str, place: usize) -> Option<&'a Along> {
        record.paths.iter().find(|path| path.id == id && path.place == place)
    }

    fn still(record: &Prepared) -> Change {
        Change { thermometer: Some(vec![0.0; record.time.len()]), ..Change::none(record) }
    }

    fn at(record: &Prepared, path: &Along, coordinate: f64) -> Change {
        let mut change = Self::still(record);
        for (w, series) in weights(&path.nodes, coordinate).into_iter().zip(&path.changes) {
            for p in 0..3 {
                add(&mut change.parts[p], &series.parts[p], w);
            }
            if let Some(thermometer) = &mut change.thermometer {
                add(thermometer, &series.sensor, w);
            }
        }
        change
    }

    /// Response to a watt in a flange, of those that may be heated, switched on `before` \[s\] the first row; `None` without such a flange.
    pub(crate) fn heated(&self, record: &Prepared, place: usize, before: f64) -> Option<Series> {
        Some(record.heaters.get(place)?.at(self.library.heaters.get(place)?, before))
    }

    /// What a relative change of each constant by 1, and a CW tail that is longer by a metre, add to a watt in a flange, as [`Self::heated`] has it.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub(crate) fn heated_slopes(&self, record: &Prepared, place: usize, before: f64) -> Result<(Vec<Series>, Parts), Error> {
        record.heater_slopes(&self.library, place).map(|slopes| slopes.at(before))
    }

    /// Parts of a coil whose CW tail is longer than its CCW tail by so much more \[m\], less the nominal ones \[deg/h\].
    ///
    /// # Errors
    /// [`Error::Winding`] if there is no such winding.
    pub fn with_tail(&self, record: &Prepared, tail: f64) -> Result<Parts, Error> {
        self.less_nominal(record, &self.library.rewound(tail, None)?)
    }

    /// Parts of a coil with so many turns more in a layer, less the nominal ones \[deg/h\]; interpolated between whole numbers of turns.
    ///
    /// # Errors
    /// [`Error::Winding`] if there is no such winding.
    pub fn with_turns(&self, record: &Prepared, layer: usize, turns: f64) -> Result<Parts, Error> {
        let low = turns.floor();
        let at = |turns: f64| self.with_defect(layer, turns as i32);
        let (a, b) = (at(low)?, at(low + 1.0)?);
        self.less_nominal(record, &[0, 1, 2].map(|p: usize| &a[p] + (&b[p] - &a[p]) * (turns - low)))
    }

    fn less_nominal(&self, record: &Prepared, functionals: &Functionals) -> Result<Parts, Error> {
        let nominal = self.with_defect(0, 0)?;
        Ok(record.course.parts(&[0, 1, 2].map(|p: usize| &functionals[p] - &nominal[p])))
    }

    fn with_defect(&self, layer: usize, turns: i32) -> Result<Functionals, Error> {
        let key = (layer, turns as u64);
        if let Some(known) = self.rewound.borrow().get(&key) {
            return Ok(known.clone());
        }
        let defect = (turns != 0).then_some(LayerDefect { layer, turns });
        let functionals = self.library.rewound(0.0, defect)?;
        self.rewound.borrow_mut().insert(key, functionals.clone());
        Ok(functionals)
    }

    /// Phase of the coil at one temperature throughout, by part, per kelvin: at each node of ln of the factor on the transverse moduli, as designed and
    /// per unit of the factor on α_r \[deg/h s\].
    pub(crate) fn even(&self) -> Vec<(f64, [f64; 3], [f64; 3])> {
        // without a mode: the chamber's drive alone
        let of = |functionals: &Functionals| functionals.each_ref().map(|part| DEG_PER_H_PER_RAD_PER_S * part[0]);
        self.library.of_modulus().map(|(x, nominal, per_factor)| (x, of(&nominal), of(&per_factor))).collect()
    }

    /// Parts of a coil that swells across its fibre by a strain, alike throughout, a value for each row \[deg/h\]: as it would expand by its α_r, less what
    /// the fibre and the spool do when they are warmed. What the swelling does to the cores alike along the fibre cancels.
    pub(crate) fn swollen(&self, record: &Prepared, strain: &[f64]) -> Parts {
        let even = self.even();
        let nodes: Vec<f64> = even.iter().map(|(x, ..)| *x).collect();
        let alpha = self.library.design().body.elastic.alpha_r;
        // a design whose mechanics changes has no such states
        let w = if nodes.is_empty() { Vec::new() } else { weights(&nodes, 0.0) };
        let rate = rates_per_hour(&record.time, strain);
        [0, 1, 2].map(|p: usize| {
            let per_strain = w.iter().zip(&even).map(|(w, at)| w * at.2[p]).sum::<f64>() / alpha;
            rate.iter().map(|rate| per_strain * rate / S_PER_H).collect()
        })
    }

    /// Parts of a coil whose transverse moduli and α_r have factors that vary from row to row, less the nominal ones \[deg/h\].
    pub fn softened(&self, record: &Prepared, factors: impl Fn(usize) -> (f64, f64)) -> Parts {
        let nodes: Vec<f64> = record.modulus.iter().map(|(x, ..)| *x).collect();
        let (polynomials, rows) = (Lagrange::new(&nodes), record.time.len());
        let mut nominal = vec![0.0; nodes.len()];
        polynomials.weights(0.0, &mut nominal);
        let (mut known, mut here) = (1.0, nominal.clone());
        // of each node in every row
        let mut own = vec![vec![0.0; rows]; nodes.len()];
        let mut wider = vec![0.0; rows];
        for n in 0..rows {
            let (modulus, expansion) = factors(n);
            if modulus != known {
                polynomials.weights(modulus.ln(), &mut here);
                known = modulus;
            }
            own.iter_mut().zip(&here).for_each(|(own, here)| own[n] = *here);
            wider[n] = expansion - 1.0;
        }
        let mut change: Parts = [0, 1, 2].map(|_| vec![0.0; rows]);
        for ((own, nominal), (_, as_designed, per_factor)) in own.iter().zip(nominal).zip(&record.modulus) {
            for (p, change) in change.iter_mut().enumerate() {
                let (as_designed, per_factor) = (&as_designed[p][..rows], &per_factor[p][..rows]);
                for n in 0..rows {
                    change[n] += (own[n] - nominal) * as_designed[n] + own[n] * wider[n] * per_factor[n];
                }
            }
        }
        change
    }
}

/// A small step along a path from a coordinate of its own; where the path ends before, it goes back.
fn stepped(nodes: &[f64], own: f64, by: f64) -> f64 {
    let ahead = own + by;
    if nodes.last().is_some_and(|last| ahead > *last) { own - by } else { ahead }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_step_goes_as_far_as_the_end_and_from_there_back() {
        assert_eq!([0.25, 0.75, 0.875].map(|own| stepped(&[0.0, 0.5, 1.0], own, 0.25)), [0.5, 1.0, 0.625]);
    }
}
