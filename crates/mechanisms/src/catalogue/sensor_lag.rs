//! A spool thermometer with a time constant of its own.

use crate::mechanism::{Effect, Extent, Named, Offer, Stage, Steady};
use crate::series::lagged;
use diagnosis::Prior;

pub(super) const SENSOR_LAG: Named = Named {
    id: "sensor-lag",
    title: "A slow spool thermometer",
    stage: Stage::Sensor,
    equation: "The thermometer follows the bore with a first-order lag: τ dT_s/dt = T − T_s.",
    place: "The sensor: `sensor.lag_s`. The rate does not depend on it.",
    signature: "The effect shows in the spool's channel alone: τ times the temperature's rate of change. An effect that delays the spool itself also changes the\n\
        rate.",
    source: "L. Michalski, K. Eckersdorf, J. Kucharski and J. McGhee, *Temperature Measurement*, 2nd ed., Wiley (2001).",
    meaning: "the spool's thermometer follows the bore with a time constant of its own",
    inspection: "dip the thermometer alone into a bath",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it acts on the thermometer alone and shifts the temperature, not its rate")],
    extent: Extent::everywhere,
    caveat: |design| (design.sensor.lag > 0.0).then_some("the thermometer's own lag and this one are added"),
    offer: |_, _| Some(Offer::one("lag_s", Prior::LogNormal { median: 30.0, spread: 0.9 }, &[20.0, 60.0])),
    effect: |_, _, active| {
        let lag = active.values[0];
        Ok(Effect::Readings(Box::new(move |r| r.thermometer = lagged(r.time, &r.thermometer, lag))))
    },
    extended: |design, active| {
        let mut changed = design.clone();
        changed.sensor.lag += active.values[0];
        Some(changed)
    },
};
