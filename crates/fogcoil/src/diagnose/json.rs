//! The outcome as scripts read it.

use diagnosis::{HeldOut, Verdict};
use mechanisms::RATE as RATE_CHANNEL;
use serde_json::{Value, json};

use super::{Outcome, name};
use crate::compose::{Composed, StandIn};

impl Outcome<'_> {
    /// One object, as scripts read it.
    pub fn json(&self) -> Value {
        let d = &self.diagnosis;
        let explained = d.verdict == Verdict::Explained;
        let mechanisms: Vec<Value> = self.likely().map(|(id, p)| json!({"id": id, "probability": p})).collect();
        let set: Vec<&str> = d.set.iter().map(|m| self.id(*m)).collect();
        let mut parameters = serde_json::Map::new();
        for estimate in d.parameters.iter().flatten().filter(|_| explained) {
            parameters.insert(estimate.name.clone(), json!({"value": estimate.value, "ci90": estimate.ci90}));
        }
        let located = self.places().next().filter(|_| explained).map(|(_, stage, place)| {
            json!({"stage": stage, "temperature_c": place.temperature, "time_s": place.time, "layers": place.layers})
        });
        let held = self.holdouts.first().map(|held| {
            let of = |h: &HeldOut| h.rmse[RATE_CHANNEL];
            let floor = held.model.noise_floor[RATE_CHANNEL];
            let [spool_nominal, spool_model] = self.thermometer(held).map_or([None; 2], |spool| spool.map(Some));
            json!({
                "rmse_nominal": of(&held.nominal),
                "rmse_model": of(&held.model),
                "noise_floor": floor,
                "accepted": held.accepted,
                "spool_rmse_nominal": spool_nominal,
                "spool_rmse_model": spool_model,
            })
        });
        let nowhere = json!({"stage": null, "temperature_c": null, "time_s": null, "layers": null});
        let [none, recalibrate, by_library, unknown] = d.verdicts();
        json!({
            "verdict": name(d.verdict),
            "is_open": self.is_open(),
            "verdicts": {"none": none, "recalibrate": recalibrate, "explained": by_library, "unknown": unknown},
            "mechanisms": mechanisms,
            "set": set,
            "taken_back": self.withdrawn.iter().map(|(m, p)| json!({"id": self.id(*m), "probability": p})).collect::<Vec<_>>(),
            "parameters": parameters,
            "constants": self.constants_json(),
            "sensors": self.sensors_json(),
            "unknowns": self.unknowns_json(),
            "named": self.named_json(),
            "located": located.unwrap_or(nowhere),
            "structure": self.structure(),
            "other_drawing": self.other_drawing,
            "follows_column": self.follows_column,
            "stand_ins": self.stand_ins.iter().map(StandIn::json).collect::<Vec<_>>(),
            "composed": self.composed.as_ref().map(Composed::json),
            "holdout": held,
            "notes": self.notes,
            "note_ids": self.notes.iter().map(|note| note.remark.id()).collect::<Vec<_>>(),
        })
    }

    /// The best explanation by mechanisms with a name, whatever the verdict; null where none is worth telling.
    fn named_json(&self) -> Value {
        let Some(best) = self.best_named() else { return Value::Null };
        let ids: Vec<&str> = best.fit.active.iter().map(|a| self.id(a.mechanism)).collect();
        let estimates = (0..ids.len()).flat_map(|place| best.fit.estimates(&self.gyro, place));
        let parameters: serde_json::Map<String, Value> =
            estimates.map(|e| (e.name, json!({"value": e.value, "ci90": e.ci90}))).collect();
        json!({"id": ids[0], "ids": ids, "probability": best.probability, "parameters": parameters})
    }
}
