//! A chamber's reading that is not that of the air at the unit.

use crate::mechanism::{Effect, Extent, Named, Offer, Stage, Steady};
use crate::series::lagged;
use diagnosis::Prior;

pub(super) const CHAMBER_LAG: Named = Named {
    id: "chamber-lag",
    title: "Air at the unit that lags behind the chamber's reading",
    stage: Stage::Sensor,
    equation: "The air at the unit follows the recorded chamber with a first-order lag: τ dT_air/dt = T_recorded − T_air. All that is linear in the air's course is delayed alike.",
    place: "The test, not the unit: a set point in place of a reading, a thermometer in the chamber's inlet, a box around the unit. A coil file has no key for it.",
    signature: "The spool's thermometer and the rate are late by the same time constant, the settled sensitivity as designed. A slow spool thermometer leaves the rate as it\n\
        is; another path of heat changes how the coil settles, not only when.",
    source: "IEC 60068-3-5, *Confirmation of the performance of temperature chambers*; IEC 60068-3-11, *Calculation of uncertainty of conditions in climatic test chambers*.",
    meaning: "the air at the unit follows the chamber's recorded temperature with a time constant: a set point was recorded, or the unit stands in a box",
    inspection: "record the air beside the unit",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it delays a ramp, whose rate stays")],
    extent: Extent::everywhere,
    caveat: |_| None,
    // chambers settle behind their set point within minutes, boxes within tens of them; what is shorter is a tolerance of thermometer and clock
    offer: |_, _| Some(Offer::one("lag_s", Prior::LogNormal { median: 400.0, spread: 0.5 }, &[150.0, 400.0, 1000.0])),
    effect: |_, _, active| {
        let lag = active.values[0];
        Ok(Effect::Readings(Box::new(move |r| {
            r.thermometer = lagged(r.time, &r.thermometer, lag);
            r.rate = lagged(r.time, &r.rate, lag);
        })))
    },
    extended: |_, _| None,
};
