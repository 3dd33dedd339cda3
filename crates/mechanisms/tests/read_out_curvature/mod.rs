//! A read-out whose bias bends with temperature.

use coil::{Design, Error};
use diagnosis::{Active, Prior};
use mechanisms::{
    Chain, Effect, Extent, Facts, Mechanism, Naming, Offer, Prepared, REFERENCE_C, Readings, Scene, Stage, Steady, middles,
};

pub(crate) struct ReadOutCurvature;

impl Mechanism for ReadOutCurvature {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: "read-out-curvature",
            title: "A read-out whose bias bends with temperature",
            stage: Stage::Electronics,
            equation: "The read-out adds q (T − 20 °C)², T at the spool's thermometer.",
            place: "The electronics, after the coil.",
            signature: "The rate follows the square of the temperature, whatever its rate: it shows in the soaks.",
            source: "An amplifier's data sheet: offset against temperature.",
            naming: Naming::Named {
                meaning: "the read-out adds a rate proportional to the square of the temperature from 20 degC",
                inspection: "warm the electronics alone",
            },
            heat_path: None,
            steady: vec![Steady::Nothing("it follows the temperature, not its rate")],
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    /// One parameter, its unit in its name; as likely negative as positive, and a hundredth of a degree per hour at 10 K is much.
    fn offer(&self, _: &Design, _: &Scene) -> Option<Offer> {
        Some(Offer::one("curvature_deg_per_h_per_k2", Prior::Normal { mean: 0.0, sd: 1e-4 }, &[0.0]))
    }

    /// It acts on the readings; one that changes the coil returns [`Effect::Coil`].
    fn effect(&self, _: &Chain, _: &Prepared, active: &Active) -> Result<Effect, Error> {
        let q = active.values[0];
        Ok(Effect::Readings(Box::new(move |readings| act(readings, q))))
    }

    /// A coil file has no key for it.
    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }

    /// It sees what all records have.
    fn columns(&self) -> Vec<&str> {
        Vec::new()
    }
}

/// The law.
fn act(readings: &mut Readings, q: f64) {
    // a temperature is of the row's instant, a rate is the mean since the row before
    let bent = middles(&readings.thermometer, |t| q * (t - REFERENCE_C).powi(2));
    readings.rate.iter_mut().zip(bent).for_each(|(rate, bent)| *rate += bent);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_bends_with_the_square_of_the_temperature() {
        let mut readings = Readings { time: &[0.0, 60.0, 120.0], thermometer: vec![20.0, 30.0, 40.0], rate: vec![1.0; 3] };
        act(&mut readings, 0.01);
        // means of 0 and 100 K², of 100 and 400 K²
        assert_eq!(readings.rate, [1.0, 1.5, 3.5]);
    }
}
