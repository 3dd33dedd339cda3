//! The same table for every recording.

use super::plant::Plant;
use super::study::Study;
use diagnosis::ForwardModel;

/// ln evidence by which another law is behind and still not excluded: odds of 1 to 148, as those by which what was held out is judged.
pub(crate) const NEAR: f64 = 5.0;

/// The composed laws, in words and numbers.
pub(crate) fn findings<P: Plant>(study: &Study<P>) -> String {
    let model = &study.model;
    let mut out = format!("{} small laws offered\n", model.laws.len());
    for posterior in study.composed.as_ref().map_or(&study.nominal, |c| &c.fit).posteriors(model) {
        if matches!(posterior.place, diagnosis::Place::Nominal(_)) && posterior.record.is_none() {
            let [low, high] = posterior.ci90();
            out += &format!("  constant {} = {:.4} ({low:.4} to {high:.4})\n", posterior.name, posterior.value());
        }
    }
    let Some(composed) = &study.composed else { return out + "nothing is composed\n" };
    let accepted = |law: usize| study.accepted.as_ref().is_some_and(|(fit, _)| fit.active.iter().any(|a| a.mechanism == law));
    for (place, active) in composed.fit.active.iter().enumerate() {
        let law = &model.laws[active.mechanism];
        let scale = model.scales.places[law.at];
        let unit = model.plant.facts().places[law.at].unit;
        let said = if accepted(active.mechanism) { "borne out" } else { "not borne out" };
        out += &format!(
            "law ({said}): {}  [{}; size in {scale:.4} {unit}]\n",
            model.mechanisms()[active.mechanism].id,
            model.legend(law)
        );
        for e in composed.fit.estimates(model, place) {
            out += &format!("  {} = {:.4}, 90 % {:.4} to {:.4}\n", e.name, e.value, e.ci90[0], e.ci90[1]);
        }
    }
    out += &format!("gain of ln evidence, the choice paid for: {:.1}\n", composed.gain);
    if let Some((fit, _)) = study.accepted.as_ref().filter(|(fit, _)| fit.active != composed.fit.active) {
        for (place, active) in fit.active.iter().enumerate() {
            let estimates = fit
                .estimates(model, place)
                .into_iter()
                .map(|e| format!("{} {:.4} ({:.4} to {:.4})", e.name, e.value, e.ci90[0], e.ci90[1]));
            let estimates: Vec<String> = estimates.collect();
            out += &format!("borne out: {}: {}\n", model.mechanisms()[active.mechanism].id, estimates.join(", "));
        }
    }
    for (law, behind) in &composed.others {
        let near = if *behind < NEAR { "hardly told apart from the last" } else { "behind" };
        out += &format!("  {near}: {} ({behind:.1})\n", model.mechanisms()[*law].id);
    }
    out
}

/// Held-out errors, one column for each way to predict.
pub(crate) fn table<P: Plant>(study: &Study<P>, names: &[&str]) -> String {
    let model = &study.model;
    let mut heads = vec!["nominal".to_owned(), "all laws composed".to_owned(), "laws borne out".to_owned()];
    heads.extend(study.told.iter().map(|(name, _)| (*name).to_owned()));
    heads.push("nominal + network".to_owned());
    let mut out = format!("| held out, rms | {} |\n|---|{}\n", heads.join(" | "), "---|".repeat(heads.len()));
    for (r, name) in names.iter().enumerate() {
        for (c, channel) in model.channels().iter().enumerate() {
            let mut row = vec![Some(study.before[r][c]), study.proof.as_ref().map(|p| p.after[r].rmse[c])];
            row.push(study.accepted.as_ref().map(|(_, p)| p.after[r].rmse[c]));
            row.extend(study.told.iter().map(|(_, proof)| Some(proof.after[r].rmse[c])));
            row.push(Some(study.network[r][c]));
            let cells: Vec<String> = row.iter().map(|x| x.map_or("-".into(), digits)).collect();
            out += &format!("| {name}, {} [{}] | {} |\n", channel.name, channel.unit, cells.join(" | "));
        }
    }
    out += match (&study.composed, &study.accepted) {
        (None, _) => "no law: the nominal model stands\n",
        (Some(composed), Some((fit, _))) if fit.active == composed.fit.active => {
            "accepted: what was held out bears out every law\n"
        }
        (_, Some(_)) => "accepted in part: what was held out bears out some of the laws, and refuses the others\n",
        (_, None) => "refused: what was held out bears out no law\n",
    };
    for (name, proof) in &study.told {
        let judged = if proof.accepted { "would be accepted" } else { "would be refused" };
        out += &format!("by the same rule {name} {judged}\n");
    }
    out
}

/// Three digits.
pub(crate) fn digits(x: f64) -> String {
    if x == 0.0 || !(1e-2..1e5).contains(&x.abs()) {
        return format!("{x:.2e}");
    }
    let places = (2.0 - x.abs().log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{x:.places$}")
}
