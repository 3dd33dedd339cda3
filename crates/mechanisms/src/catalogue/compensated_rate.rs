//! A rate from which the unit has taken off what its thermometer makes it expect.

use crate::mechanism::{Effect, Extent, Named, Offer, Stage, Steady, grid};
use crate::series::{lagged, rates_per_hour};
use bias::units::S_PER_H;
use diagnosis::{Parameter, Prior};

pub(super) const COMPENSATED_RATE: Named = Named {
    id: "compensated-rate",
    title: "A rate that the unit has compensated",
    stage: Stage::Electronics,
    equation: "The unit takes f S dT_f/dt off its rate: f of the design's sensitivity S in a steady ramp, times the rate of its spool thermometer T, which it\n\
        follows with the time constant τ of a filter: τ dT_f/dt = T − T_f.",
    place: "The electronics, not the coil: a coil file has no key for it. Switch the compensation off, or log the rate before it.",
    signature: "Ramps show less bias than the design, or none, or bias of the other sign, and the corners of the chamber's programme stay. Tails change the\n\
        sensitivity as well; those of usual lengths by a smaller part.",
    source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014); IEEE Std 952, *Specification Format Guide and Test Procedure for\n\
        Single-Axis Interferometric Fiber Optic Gyros*.",
    meaning: "the unit itself takes compensated_fraction of the design's bias off, by the rate of its thermometer through a filter of filter_s",
    inspection: "switch the unit's compensation off, or log the rate before it",
    columns: &[],
    heat_path: None,
    steady: &[
        Steady::Nothing("it is of the electronics: it changes the number that is measured, and the coil's own sensitivity stays"),
        Steady::Nothing("a filter of the electronics"),
    ],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, _| {
        Some(Offer {
            // a unit that is built to take its bias off takes most of it; a minute or so keeps a thermometer's noise from the rate. Both are estimates
            parameters: vec![
                Parameter::new("compensated_fraction", Prior::LogNormal { median: 0.8, spread: 0.35 }),
                Parameter::new("filter_s", Prior::LogNormal { median: 60.0, spread: 0.8 }),
            ],
            choice: None,
            starts: grid(&[&[0.5, 1.0], &[60.0]]),
        })
    },
    effect: |chain, _, active| {
        let (taken, filter) = (active.values[0] * chain.steady_sensitivity() / S_PER_H, active.values[1]);
        Ok(Effect::Readings(Box::new(move |r| {
            let expected = rates_per_hour(r.time, &lagged(r.time, &r.thermometer, filter));
            r.rate.iter_mut().zip(expected).for_each(|(rate, per_hour)| *rate -= taken * per_hour);
        })))
    },
    extended: |_, _| None,
};
