//! Power that is dissipated in a flange since the unit was switched on.

use crate::change::Per;
use crate::constants::Constant;
use crate::course::Series;
use crate::design::{choice_of, chosen, heatable_flanges, with_heater};
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady, grid};
use diagnosis::{Parameter, Prior};

pub(super) const SELF_HEATING: Named = Named {
    id: "self-heating",
    title: "Power dissipated in a flange",
    stage: Stage::Thermal,
    equation: "A constant power P in the flange since `before_s` ahead of the record's first row.",
    place: "The heat flow: `heat.heaters`.",
    signature: "The rate settles at the start of the record, whatever the chamber does, and the spool's temperature has a constant offset afterwards. A chamber\n\
        that rests while the unit is switched on shows the effect best.",
    source: "H. S. Carslaw and J. C. Jaeger, *Conduction of Heat in Solids*, 2nd ed., Oxford (1959), ch. 3.",
    meaning: "power is dissipated at the flange; it was switched on before_s before the first row",
    inspection: "switch the electronics on at a steady chamber temperature",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("a constant power makes a constant field, whose rate is zero")],
    // From the switch-on until the thermometer has risen by nearly all that it ever will in the first record.
    extent: |_, sight| {
        let time = sight.first.as_ref().and_then(|(record, change)| {
            let rise = change.thermometer.as_ref()?;
            let settled = RISEN * rise.last()?;
            let at = rise.iter().position(|r| r.abs() >= settled.abs())?;
            Some([record.time[0], record.time[at]])
        });
        Extent { time, ..Extent::default() }
    },
    caveat: |_| Some("simulate switches the heater on at the first row, not before_s earlier"),
    offer: |design, _| {
        let flanges = heatable_flanges(design);
        (!flanges.is_empty()).then(|| Offer {
            parameters: vec![
                Parameter::new("power_w", Prior::LogNormal { median: 0.2, spread: 1.6 }),
                Parameter::new("before_s", Prior::LogNormal { median: 60.0, spread: 1.5 }),
            ],
            choice: choice_of(&flanges),
            starts: grid(&[&[0.005, 0.05, 0.5], &[10.0, 60.0, 300.0]]),
        })
    },
    effect: |chain, record, active| {
        let [power, before] = [active.values[0], active.values[1]];
        let Some(mut series) = chain.heated(record, chosen(active), before) else {
            return Ok(Effect::Coil(Change::none(record)));
        };
        let (mut slopes, mut tail) = chain.heated_slopes(record, chosen(active), before)?;
        series.scale(power);
        slopes.iter_mut().for_each(|slope| slope.scale(power));
        tail.iter_mut().flatten().for_each(|rate| *rate *= power);
        let per = |(constant, slope): (&Constant, Series)| {
            let Series { sensor, parts } = slope;
            Per { parameter: constant.parameter, parts, thermometer: Some(sensor) }
        };
        let per = chain.library().constants.iter().zip(slopes).map(per).collect();
        let thermometer = Some(series.sensor);
        Ok(Effect::Coil(Change { thermometer, per, apart: Some(Box::new(tail)), ..Change::of_parts(series.parts) }))
    },
    extended: |design, active| {
        let side = *heatable_flanges(design).get(chosen(active))?;
        Some(with_heater(design, side, active.values[0]))
    },
};

/// Share of its final rise at which a heated unit has settled.
const RISEN: f64 = 0.95;
