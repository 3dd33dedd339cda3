//! One object, SI. See docs/schema/identify.schema.json.

use homogenization::identify::{Family, Fit, Identification, Posterior, Target};
use serde_json::{Map, Value, json as object};

use super::presentation;
use crate::input::TargetsCase;

/// The result, in SI.
pub fn json(case: &TargetsCase, result: &Identification) -> Value {
    let families = case.families.iter().zip(&result.outcomes).map(|(family, outcome)| {
        object!({
            "name": family.name,
            "explains": outcome.explains(),
            "best": fit(family, &case.targets, &outcome.best),
            "ordinary": outcome.ordinary.as_ref().map(|ordinary| fit(family, &case.targets, ordinary)),
        })
    });
    let chosen = &case.families[result.chosen];
    let alternatives = result.alternatives.as_ref().map(|alternatives| {
        let measurements = alternatives
            .measurements
            .iter()
            .map(|m| object!({ "what": m.what, "predicted": m.values, "spread": m.spread, "standard_error": m.error, "separation": m.separation() }));
        object!({
            "sets": alternatives.sets.iter().map(|set| fit(chosen, &case.targets, set)).collect::<Vec<_>>(),
            "measurements": measurements.collect::<Vec<_>>(),
        })
    });
    object!({
        "name": case.name,
        "cells": families.collect::<Vec<_>>(),
        "chosen": chosen.name,
        "explained": result.outcomes[result.chosen].explains(),
        "posterior": result.posterior.as_ref().map(|found| posterior(chosen, found)),
        "alternatives": alternatives,
    })
}

fn fit(family: &Family, targets: &[Target], fit: &Fit) -> Value {
    let entries: Map<String, Value> = (targets.iter().zip(fit.entries.iter().zip(&fit.met)))
        .map(|(t, (value, met))| (t.name().into(), object!({ "value": value, "target": t.value, "met": met })))
        .collect();
    let parameters = family.parameters().into_iter().zip(fit.values.iter().zip(&fit.u)).map(|(parameter, (value, u))| {
        object!({ "of": parameter.phase, "quantity": presentation(parameter.quantity).1, "value": value, "prior_sigma": u })
    });
    object!({
        "reproduces": fit.reproduces(),
        "largest_prior_sigma": fit.farthest().1,
        "entries": entries,
        "parameters": parameters.collect::<Vec<_>>(),
    })
}

fn posterior(family: &Family, posterior: &Posterior) -> Value {
    let parameters = family.parameters();
    let intervals = parameters.iter().enumerate().map(|(j, parameter)| {
        let prior = parameter.prior;
        object!({
            "of": parameter.phase,
            "quantity": presentation(parameter.quantity).1,
            "median": prior.value(posterior.interval(j, 0.0)[0]),
            "ci90": posterior.interval(j, 0.9).map(|u| prior.value(u)),
            "prior90": [prior.low, prior.high],
            "left_of_prior": posterior.deviation(j),
        })
    });
    let directions =
        posterior.directions.iter().map(|d| object!({ "gain": d.gain, "left_of_prior": d.shrinkage(), "along": d.along }));
    let regions =
        posterior.regions.iter().map(|region| object!({ "weight": region.weight, "centre_prior_sigma": region.centre }));
    object!({
        "regions": regions.collect::<Vec<_>>(),
        "parameters": intervals.collect::<Vec<_>>(),
        "rank": posterior.rank(),
        "directions": directions.collect::<Vec<_>>(),
        "draws": posterior.draws.len(),
        "effective_draws": posterior.effective_draws,
        "acceptance": posterior.acceptance,
        "emulator_error": posterior.emulator_error,
    })
}
