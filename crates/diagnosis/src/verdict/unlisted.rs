//! A composed law, weighed with the mechanisms that have a name.

use super::{Diagnosis, Verdict};
use crate::Candidate;

impl Diagnosis {
    /// Weighs a composed law, beside the design's constants or mechanisms that have a name, with all candidates: `log_weight` is ln of its evidence and
    /// prior probability ([`Composed::log_weight`](crate::Composed::log_weight)). Its probability is taken from all others and given to the mechanisms
    /// `names` that stand beside it. The candidates gain `by_noise` of ln evidence in the noise that the law leaves
    /// ([`gained_by_noise_of`](crate::gained_by_noise_of)), and the leader's gain over the law on held-out records, `by_held_out`. Where the law is
    /// likelier than the explanation, the verdict is unknown, and the law describes the records.
    pub fn weigh_unlisted(&mut self, log_weight: f64, names: &[usize], by_noise: f64, by_held_out: f64) {
        let ratio = |c: &Candidate| (c.log_weight + by_noise + by_held_out - log_weight).exp();
        let others: f64 = self.candidates.iter().map(ratio).sum();
        self.make_room(1.0 / (1.0 + others), names);
    }

    /// Leaves a mechanism so much of its probability as the records give it over another law in its place that is as likely as the mechanism beforehand
    /// ([`in_place_of`](crate::in_place_of)): `behind` is by how much ln evidence of all records the law is behind. A name that the records do not
    /// tell from a law of another cause is thought of, not found. The verdict is not touched: it weighs what is thought beforehand, too. The share
    /// that is left.
    pub fn doubt(&mut self, mechanism: usize, behind: f64) -> f64 {
        let share = 1.0 / (1.0 + (-behind).exp());
        self.mechanisms.iter_mut().filter(|(m, _)| *m == mechanism).for_each(|(_, p)| *p *= share);
        self.mechanisms.sort_by(|a, b| b.1.total_cmp(&a.1));
        share
    }

    /// Gives this probability to something unknown beside mechanisms that have a name.
    fn make_room(&mut self, probability: f64, names: &[usize]) {
        let left = 1.0 - probability;
        self.candidates.iter_mut().for_each(|c| c.probability *= left);
        for (mechanism, p) in &mut self.mechanisms {
            *p = *p * left + if names.contains(mechanism) { probability } else { 0.0 };
        }
        self.mechanisms.sort_by(|a, b| b.1.total_cmp(&a.1));
        self.verdicts.iter_mut().for_each(|p| *p *= left);
        self.verdicts[3] += probability;
        let [_, _, explained, unknown] = self.verdicts;
        if self.verdict == Verdict::Explained && unknown > explained {
            self.verdict = Verdict::Unknown;
            self.set.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::set::tests::candidate;
    use super::*;

    /// A mechanism explains what the constants do not, ten units of evidence better.
    fn explained() -> Diagnosis {
        let with = |mechanisms: &[usize], log_weight: f64, probability: f64| {
            let mut candidate = candidate(mechanisms, probability);
            (candidate.fit.log_evidence, candidate.log_weight) = (log_weight, log_weight);
            candidate
        };
        let candidates = vec![with(&[0], 10.0, 1.0 - 4.5e-5), with(&[], 0.0, 4.5e-5)];
        let fit = candidates[1].fit.clone();
        Diagnosis {
            verdict: Verdict::Explained,
            mechanisms: vec![(0, candidates[0].probability)],
            set: vec![0],
            parameters: Vec::new(),
            nominal: fit.clone(),
            mismatch: fit,
            stages: Vec::new(),
            verdicts: [0.0, candidates[1].probability, candidates[0].probability, 0.0],
            excluded: 0.03,
            candidates,
        }
    }

    fn weighed(log_evidence: f64, choice: f64, by_noise: f64) -> Diagnosis {
        weighed_beside(&[], log_evidence, choice, by_noise)
    }

    fn weighed_beside(names: &[usize], log_evidence: f64, choice: f64, by_noise: f64) -> Diagnosis {
        let mut diagnosis = explained();
        // the law is the model's eighth mechanism
        let active = |mechanism: &usize| crate::Active { mechanism: *mechanism, values: Vec::new(), choice: None };
        let active = names.iter().chain(&[7]).map(active).collect();
        let fit = crate::Fit { log_evidence, active, ..diagnosis.nominal.clone() };
        let law = crate::Composed { fit, laws: 1, gain: 0.0, choice, others: Vec::new(), steps: Vec::new() };
        assert_eq!(law.names(), names);
        diagnosis.weigh_unlisted(law.log_weight(0.0), names, by_noise, 0.0);
        diagnosis
    }

    #[test]
    fn a_name_keeps_what_the_records_give_it_over_a_law_in_its_place() {
        for (behind, left) in [(0.0, 0.5), (9.0_f64.ln(), 0.9), (-9.0_f64.ln(), 0.1), (f64::INFINITY, 1.0), (700.0, 1.0)] {
            let (mut diagnosis, before) = (explained(), explained());
            assert!((diagnosis.doubt(0, behind) - left).abs() < 1e-12);
            assert!((diagnosis.mechanisms[0].1 - left * before.mechanisms[0].1).abs() < 1e-12);
            assert_eq!((diagnosis.verdict, diagnosis.verdicts()), (before.verdict, before.verdicts()));
            // of another mechanism nothing is said
            let mut other = explained();
            other.doubt(1, behind);
            assert_eq!(other.mechanisms, before.mechanisms);
        }
    }

    #[test]
    fn a_law_no_likelier_than_a_name_leaves_it_its_place() {
        // e⁰ against e⁰: exactly as likely
        let certain = Candidate { log_weight: 0.0, ..candidate(&[0], 1.0) };
        let of = |log_weight: f64| {
            let (candidates, verdicts) = (vec![certain.clone()], [0.0, 0.0, 1.0, 0.0]);
            let mut diagnosis = Diagnosis { candidates, verdicts, mechanisms: vec![(0, 1.0)], ..explained() };
            diagnosis.weigh_unlisted(log_weight, &[], 0.0, 0.0);
            diagnosis
        };
        let even = of(0.0);
        assert_eq!(even.verdicts(), [0.0, 0.0, 0.5, 0.5]);
        assert_eq!((even.verdict, even.set.as_slice()), (Verdict::Explained, &[0][..]));
        let likelier = of(0.01);
        assert_eq!((likelier.verdict, likelier.set.len()), (Verdict::Unknown, 0));
    }

    #[test]
    fn a_law_takes_a_name_s_place_where_it_is_likelier_with_its_choice_paid() {
        // as likely as all others together, whatever the choice cost
        for choice in [0.0, 4.0] {
            let even = weighed(10.0 + 4.5e-5 + choice, choice, 0.0);
            assert!(
                (even.verdicts()[3] - 0.5).abs() < 1e-6 && (even.mechanisms[0].1 - 0.5).abs() < 1e-4,
                "{:?}",
                even.verdicts()
            );
        }
        let likelier = weighed(14.0, 0.0, 0.0);
        assert_eq!((likelier.verdict, likelier.set.len()), (Verdict::Unknown, 0));
        let paid = weighed(14.0, 8.0, 0.0);
        assert_eq!((paid.verdict, paid.set.as_slice()), (Verdict::Explained, &[0][..]));
        // what the law owes to a noise that was found later is no merit of the law
        let by_noise = weighed(14.0, 0.0, 8.0);
        assert_eq!((by_noise.verdict, by_noise.set.as_slice()), (Verdict::Explained, &[0][..]));
        // a law beside a name leaves it as probable as it was
        let beside = weighed_beside(&[0], 14.0, 0.0, 0.0);
        assert!(beside.mechanisms[0].1 > 0.999 && likelier.mechanisms[0].1 < 0.02, "{:?}", beside.mechanisms);
        for diagnosis in [likelier, paid, by_noise, beside] {
            assert!((diagnosis.verdicts().iter().sum::<f64>() - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn what_the_leader_gains_on_held_out_records_counts_for_all_candidates() {
        let of = |by_noise: f64, by_held_out: f64| {
            let mut diagnosis = explained();
            diagnosis.weigh_unlisted(12.0, &[], by_noise, by_held_out);
            diagnosis.verdicts()[3]
        };
        assert_eq!(of(0.0, 3.0), of(3.0, 0.0));
        assert!(of(0.0, 0.0) > 0.85 && of(0.0, 3.0) < 0.3 && of(0.0, -3.0) > 0.99);
    }
}
