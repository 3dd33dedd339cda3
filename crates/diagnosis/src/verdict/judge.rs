//! The verdict tested on held-out records, which may prove or contradict it.

use super::set::{likely, marginals, named};
use super::{Diagnosis, Verdict};
use crate::{Candidate, Error, Fit, ForwardModel, HeldOut, Hypothesis, Observation, as_designed};

/// Least probability of a mechanism that is named although a structure remains beside it, and of a verdict that is told without a doubt.
pub const SURE: f64 = 0.8;

/// A held-out record with its predictions.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// Prediction by the nominal model as it is designed, its offsets fitted ([`as_designed`]).
    pub nominal: HeldOut,
    /// Prediction by the best candidate, nothing fitted anew ([`crate::Fit::hold_out`]).
    pub model: HeldOut,
    /// Prediction by the design's own constants re-estimated, nothing fitted anew, if that was compared.
    pub constants: Option<HeldOut>,
    /// Whether the best candidate's error of the channel that judges is no larger than the nominal model's, or hardly larger while the whole record, with its
    /// other channels, is far likelier.
    pub accepted: bool,
}

impl Judged {
    /// Whether another prediction of the record is clearly better than the nominal model's and that of its constants re-estimated, proves something, and
    /// is not clearly worse than what was accepted, by the errors of a channel.
    pub fn is_beaten_by(&self, other: &HeldOut, channel: usize) -> bool {
        let beats = |without: &HeldOut| without.clearly_worse_than(other, channel);
        let answered = if self.accepted { &self.model } else { &self.nominal };
        beats(&self.nominal)
            && self.constants.as_ref().is_none_or(beats)
            && !other.proves_nothing(&self.nominal, channel)
            && !other.clearly_worse_than(answered, channel)
    }
}

/// Effect of the held-out records on a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ruling {
    /// The verdict stands.
    Stands,
    /// Mechanisms beside which a structure was left are proven: unknown becomes explained.
    AcceptedBeside,
    /// The design, or its constants re-estimated, are likelier than the explanation by all records together: none or recalibrate.
    Outweighed,
    /// The explanation is taken back: none or unknown remains.
    TakenBack {
        /// Number of the first record that contradicts it, among those held out.
        record: usize,
        /// Kind of contradiction.
        why: Contradiction,
    },
}

/// Way in which a record contradicts an explanation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contradiction {
    /// The explanation predicts it clearly worse than the nominal model does ([`HeldOut::clearly_worse_than`]).
    ClearlyWorse,
    /// The explanation predicts it hardly better, and far from its noise ([`HeldOut::proves_nothing`]).
    ProvesNothing,
}

/// Outcome of a diagnosis tested on the held-out records.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// Predictions of the held-out records, in their order.
    pub records: Vec<Judged>,
    /// Effect on the verdict.
    pub ruling: Ruling,
    /// Mechanisms that were taken back, with their probabilities by the fitted records.
    pub withdrawn: Vec<(usize, f64)>,
}

impl Diagnosis {
    /// Predicts records that were held out and judges the verdict by them.
    ///
    /// - `model`: the model of the diagnosis; after [`crate::settled`], the one that is good about the result.
    /// - `drawn`: the model that is exact as it is designed, before it [`crate::settled`]; else the same one.
    /// - `alone`: the model that is good about the constants alone ([`crate::Settled::alone`]) and their fit there, if there is one; `None` takes
    ///   both from the diagnosis.
    /// - `fitted`: the first record that was fitted, its number in the model and its observation.
    /// - `held`: the records that were held out, each by its number in the model and its observation.
    /// - `channel`: the channel whose errors judge, from 0.
    ///
    /// The rules:
    ///
    /// - A structure beside mechanisms that have a name, one of them nearly certain, is no bar to naming them if *every* record is predicted to within
    ///   its noise, and clearly better than by the nominal model and by its constants re-estimated: the verdict becomes [`Verdict::Explained`], and
    ///   their probabilities count the candidates with a structure.
    /// - An explanation is outweighed where the design or its constants are likelier by fitted and held-out records together.
    /// - An explanation, or a recalibration, is taken back if *any* record contradicts it ([`Contradiction`]). The verdict is then none if the
    ///   nominal model predicts that record to within noise, and unknown otherwise; the mechanisms lose their probabilities, which were of the
    ///   fitted records alone.
    ///
    /// # Errors
    /// [`Error::Data`] if an observation does not fit the model or has no value, or if there is no such channel; [`Error`] if the model fails.
    pub fn judge(
        &mut self,
        model: &dyn ForwardModel,
        drawn: &dyn ForwardModel,
        alone: Option<(&dyn ForwardModel, &Fit)>,
        fitted: (usize, &Observation),
        held: &[(usize, &Observation)],
        channel: usize,
    ) -> Result<Judgement, Error> {
        if channel >= model.channels().len() {
            let count = model.channels().len();
            return Err(Error::Data(format!("channel {channel} is to judge, the model has {count}, numbered from 0")));
        }
        let best = self.best();
        let own = self.candidates.iter().find(|c| c.is_constants_alone()).map(|c| (model, &c.fit));
        let constants = own.map(|own| alone.unwrap_or(own));
        let predicted = |&(record, observed): &(usize, &Observation)| -> Result<Judged, Error> {
            let nominal = as_designed(drawn, fitted, (record, observed), &best.fit)?;
            let constants = constants.map(|(model, fit)| fit.hold_out(model, record, observed, &best.fit)).transpose()?;
            let by_model = match constants.as_ref().filter(|_| best.is_constants_alone()) {
                Some(constants) => constants.clone(),
                None => best.fit.hold_out(model, record, observed, &best.fit)?,
            };
            Ok(Judged { accepted: is_accepted(&by_model, &nominal, channel), nominal, model: by_model, constants })
        };
        let mut records = held.iter().map(predicted).collect::<Result<Vec<_>, _>>()?;
        let counted = |c: &Candidate| named(model, c);
        let beside = marginals(model, &self.candidates, counted);
        let sure = beside.iter().any(|(_, probability)| *probability >= SURE);
        let together = together(self.verdicts, &records);
        let ruling = rule(self.verdict, together, sure && self.is_beside_named(model), &records, channel);
        let mut withdrawn = Vec::new();
        match ruling {
            Ruling::Stands => {}
            Ruling::Outweighed => {
                self.outweighed(together, model);
                for record in &mut records {
                    let by_design = || record.nominal.clone();
                    record.model = match self.verdict {
                        Verdict::Recalibrate => record.constants.clone().unwrap_or_else(by_design),
                        _ => by_design(),
                    };
                    record.accepted = is_accepted(&record.model, &record.nominal, channel);
                }
            }
            Ruling::AcceptedBeside => {
                self.verdict = Verdict::Explained;
                // the structure beside them is taken for noise
                let explained = |c: &&Candidate| counted(c) && !c.fit.hypothesis.mechanisms.is_empty();
                let explained: f64 = self.candidates.iter().filter(explained).map(|c| c.probability).sum();
                let [none, recalibrate, ..] = self.verdicts;
                self.verdicts = [none, recalibrate, explained, (1.0 - none - recalibrate - explained).max(0.0)];
                self.mechanisms = beside;
                self.set = likely(&self.mechanisms, &self.candidates, counted, self.excluded, |m| model.mechanisms()[m].named);
            }
            Ruling::TakenBack { record, .. } => {
                let suffices = records[record].nominal.within_noise(channel);
                self.verdict = if suffices { Verdict::None } else { Verdict::Unknown };
                self.set.clear();
                withdrawn = std::mem::take(&mut self.mechanisms);
            }
        }
        Ok(Judgement { records, ruling, withdrawn })
    }

    /// Replaces the explanation by the design or its constants, whichever is likelier by all records `together`.
    fn outweighed(&mut self, together: [f64; 4], model: &dyn ForwardModel) {
        // no other explanation has a prediction of its own: all keep their shares of what explanations have
        let left = together[2] / self.verdicts[2];
        self.mechanisms.iter_mut().for_each(|(_, probability)| *probability *= left.min(1.0));
        self.verdicts = together;
        let recalibrate = together[1] > together[0];
        self.verdict = if recalibrate { Verdict::Recalibrate } else { Verdict::None };
        let leads = |c: &Candidate| {
            if recalibrate { c.is_constants_alone() } else { c.rival.is_none() && c.fit.hypothesis == Hypothesis::NOMINAL }
        };
        if let Some(at) = self.candidates.iter().position(leads) {
            self.candidates[..=at].rotate_right(1);
        }
        self.set.clear();
        self.parameters = (0..self.best().fit.active.len())
            .map(|place| crate::marginal::estimates(model, &self.candidates, &[], place))
            .collect();
    }

    /// Whether the unknown is a structure beside mechanisms that have a name.
    pub fn is_beside_named(&self, model: &dyn ForwardModel) -> bool {
        let best = self.best();
        let something = best.rival.is_some() && !best.fit.hypothesis.mechanisms.is_empty();
        self.verdict == Verdict::Unknown && something && named(model, best)
    }
}

/// No larger error than the nominal model's; or hardly a larger one, where another channel shows that the model is right.
fn is_accepted(model: &HeldOut, nominal: &HeldOut, channel: usize) -> bool {
    model.rmse[channel] <= nominal.rmse[channel] || model.is_likelier_than(nominal, channel)
}

/// Probabilities of none, recalibrate, explained and unknown by fitted and held-out records; the leading candidate stands for a verdict without a
/// prediction of its own.
fn together(verdicts: [f64; 4], records: &[Judged]) -> [f64; 4] {
    let gain = |of: &dyn Fn(&Judged) -> Option<f64>| -> f64 {
        records.iter().map(|r| of(r).map_or(0.0, |score| score - r.model.log_score)).sum()
    };
    let (none, recalibrate) = (gain(&|r| Some(r.nominal.log_score)), gain(&|r| r.constants.as_ref().map(|c| c.log_score)));
    let logs = [verdicts[0].ln() + none, verdicts[1].ln() + recalibrate, verdicts[2].ln(), verdicts[3].ln()];
    let most = logs.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = logs.iter().map(|log| (log - most).exp()).sum();
    logs.map(|log| (log - most).exp() / sum)
}

/// The rules of [`Diagnosis::judge`]: `together` are the verdicts' probabilities by all records, `beside_named` says whether the unknown is a structure
/// beside mechanisms that have a name.
fn rule(verdict: Verdict, together: [f64; 4], beside_named: bool, records: &[Judged], channel: usize) -> Ruling {
    // what a mechanism adds is proven over what constants do without it
    let beats = |other: &HeldOut, r: &Judged| other.clearly_worse_than(&r.model, channel);
    // a channel of which nothing is used has nothing to leave
    let within_noise = |r: &Judged| (0..r.model.rmse.len()).all(|c| r.model.rmse[c].is_nan() || r.model.within_noise(c));
    let proves =
        |r: &Judged| beats(&r.nominal, r) && r.constants.as_ref().is_none_or(|constants| beats(constants, r)) && within_noise(r);
    if beside_named && !records.is_empty() && records.iter().all(proves) {
        return Ruling::AcceptedBeside;
    }
    let contradicts = |r: &Judged| {
        if r.model.clearly_worse_than(&r.nominal, channel) {
            Some(Contradiction::ClearlyWorse)
        } else {
            r.model.proves_nothing(&r.nominal, channel).then_some(Contradiction::ProvesNothing)
        }
    };
    let found = matches!(verdict, Verdict::Explained | Verdict::Recalibrate);
    let first = records.iter().enumerate().find_map(|(record, r)| Some((record, contradicts(r)?)));
    if let Some((record, why)) = first.filter(|_| found) {
        return Ruling::TakenBack { record, why };
    }
    let [none, recalibrate, explained, _] = together;
    if verdict == Verdict::Explained && none + recalibrate >= explained { Ruling::Outweighed } else { Ruling::Stands }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of the nominal model and of the best candidate where noise is 1, and the ln of the likelihood ratio in favour of the latter.
    fn judged(nominal: f64, model: f64, gain: f64) -> Judged {
        let of = |rmse: f64, log_score: f64| HeldOut {
            prediction: Vec::new(),
            rmse: vec![f64::NAN, rmse],
            noise_floor: vec![1.0; 2],
            of_minutes: vec![f64::NAN, rmse],
            quiet: vec![1.0; 2],
            log_score,
        };
        Judged { nominal: of(nominal, 0.0), model: of(model, gain), constants: None, accepted: model <= nominal }
    }

    fn ruled(verdict: Verdict, records: &[Judged]) -> Ruling {
        rule(verdict, together(SURELY, records), false, records, 1)
    }

    /// Probabilities of the verdicts, of which the design has hardly any.
    const SURELY: [f64; 4] = [1e-12, 1e-12, 0.9, 0.1];

    #[test]
    fn an_explanation_is_outweighed_by_all_records_together() {
        let with_constants =
            |gain: f64| Judged { constants: Some(judged(5.0, 1.0, 50.0 + gain).model), ..judged(5.0, 1.0, 50.0) };
        let of = |recalibrate: f64, records: &[Judged]| {
            let verdicts = [0.0, recalibrate, 1.0 - recalibrate, 0.0];
            rule(Verdict::Explained, together(verdicts, records), false, records, 1)
        };
        // odds of nine to one against the constants, ln 2.2
        assert_eq!(of(0.1, &[with_constants(2.1)]), Ruling::Stands);
        assert_eq!(of(0.1, &[with_constants(2.3)]), Ruling::Outweighed);
        assert_eq!(of(0.1, &[with_constants(1.2), with_constants(1.2)]), Ruling::Outweighed);
        assert_eq!(of(0.1, &[with_constants(-9.0), with_constants(1.2)]), Ruling::Stands);
        assert_eq!(of(0.1, &[judged(5.0, 1.0, 50.0)]), Ruling::Stands);
    }

    const WORSE: Contradiction = Contradiction::ClearlyWorse;
    const NOTHING: Contradiction = Contradiction::ProvesNothing;

    #[test]
    fn one_record_takes_back_and_the_first_is_named() {
        let [good, worse, nothing] = [judged(5.0, 1.0, 50.0), judged(1.0, 3.0, -50.0), judged(3.0, 2.9, 3.0)];
        for verdict in [Verdict::Explained, Verdict::Recalibrate] {
            assert_eq!(ruled(verdict, &[]), Ruling::Stands);
            assert_eq!(ruled(verdict, std::slice::from_ref(&good)), Ruling::Stands);
            let records = [good.clone(), nothing.clone(), worse.clone()];
            assert_eq!(ruled(verdict, &records), Ruling::TakenBack { record: 1, why: NOTHING });
            assert_eq!(ruled(verdict, &records[2..]), Ruling::TakenBack { record: 0, why: WORSE });
        }
        // where nothing was claimed nothing is taken back
        for verdict in [Verdict::None, Verdict::Unknown] {
            assert_eq!(ruled(verdict, std::slice::from_ref(&worse)), Ruling::Stands);
        }
    }

    #[test]
    fn hardly_a_larger_error_is_accepted_where_the_whole_record_is_far_likelier() {
        let accepted = |nominal, model, gain, thermometer: [f64; 2]| {
            let mut judged = judged(nominal, model, gain);
            [judged.nominal.of_minutes[0], judged.model.of_minutes[0]] = thermometer;
            is_accepted(&judged.model, &judged.nominal, 1)
        };
        let better = [11.0, 0.01];
        assert!(accepted(1.0, 1.0, -50.0, [0.01, 11.0]) && accepted(1.0, 1.009, 5.1, better));
        assert!(!accepted(1.0, 1.009, 4.9, better) && !accepted(1.0, 1.011, 5000.0, better));
        // nothing but the rate shows anything
        assert!(!accepted(1.0, 1.009, 50.0, [1.0, 0.96]) && !accepted(1.0, 1.009, 50.0, [f64::NAN; 2]));
    }

    #[test]
    fn worse_is_by_error_and_by_likelihood() {
        let taken_back =
            |nominal, model, gain| matches!(ruled(Verdict::Explained, &[judged(nominal, model, gain)]), Ruling::TakenBack { .. });
        assert!(taken_back(1.0, 1.02, -5.1));
        assert!(!taken_back(1.0, 1.02, -4.9) && !taken_back(1.0, 1.009, -50.0));
        // no proof: beyond twice the noise, and by less than a twentieth better
        assert!(taken_back(2.2, 2.1, 50.0));
        assert!(!taken_back(2.2, 2.08, 50.0) && !taken_back(2.05, 1.99, 50.0));
    }

    #[test]
    fn a_law_has_to_beat_the_design_its_constants_and_what_was_accepted() {
        let constants = |rmse: f64, gain: f64| Some(judged(1.0, rmse, gain).model);
        let before =
            |nominal: f64, model: f64, rmse: f64| Judged { constants: constants(rmse, 10.0), ..judged(nominal, model, 20.0) };
        let beaten = |before: Judged, rmse: f64, gain: f64| before.is_beaten_by(&judged(1.0, rmse, gain).model, 1);
        assert!(beaten(before(3.0, 1.5, 1.5), 1.1, 40.0));
        // no better than the constants alone, by error or by likelihood
        assert!(!beaten(before(3.0, 1.5, 1.1), 1.1, 40.0) && !beaten(before(3.0, 1.5, 1.5), 1.1, 14.0));
        // worse than the explanation that was accepted; one that was not is no rival
        assert!(!beaten(before(3.0, 1.0, 1.5), 1.1, 14.9) && beaten(before(1.8, 2.0, 1.5), 1.1, 40.0));
        assert!(!beaten(before(1.05, 2.0, 1.5), 1.1, 40.0));
    }

    #[test]
    fn what_stands_beside_a_structure_is_proven_by_all_records_or_none() {
        let [proof, loud, even] = [judged(2.0, 1.2, 6.0), judged(5.0, 1.4, 50.0), judged(1.2, 1.15, 4.0)];
        let of = |records: &[Judged]| rule(Verdict::Unknown, SURELY, true, records, 1);
        assert_eq!(of(&[proof.clone(), proof.clone()]), Ruling::AcceptedBeside);
        assert_eq!(of(&[]), Ruling::Stands);
        assert_eq!(of(&[proof.clone(), loud]), Ruling::Stands);
        assert_eq!(of(&[even, proof.clone()]), Ruling::Stands);
        assert_eq!(rule(Verdict::Unknown, SURELY, false, std::slice::from_ref(&proof), 1), Ruling::Stands);
        // a thermometer that is left with more than its noise says that something is still missing
        let mut hot = proof.clone();
        (hot.model.rmse[0], hot.model.of_minutes[0]) = (5.0, 5.0);
        assert_eq!(of(&[hot]), Ruling::Stands);
        // where the constants predict as well, the mechanism has proven nothing
        let with_constants = |rmse: f64, gain: f64| Judged { constants: Some(judged(1.0, rmse, gain).model), ..proof.clone() };
        assert_eq!(of(&[with_constants(1.2, 6.0)]), Ruling::Stands);
        assert_eq!(of(&[with_constants(1.5, 0.0)]), Ruling::AcceptedBeside);
    }
}
