//! Test that tells a longer tail from the other explanations.

use diagnosis::Plan;
use mechanisms::Gyro;
use progress::Step;

use super::explanation::{Explanation, STRAINED, active};
use crate::recommend::{Contender, Odds, Programme, everything, odds, usual};

/// A test that tells two explanations apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// Their ids.
    pub between: [String; 2],
    /// The slow ramp and its separation.
    pub slow: (String, Odds),
    /// The best programme and its separation.
    pub best: (String, Odds),
}

/// A tail's id: the explanation that every other one is told from.
const TAIL: &str = "tail-asymmetry";

/// The record 0 is no programme; the others are `programmes`, the slow ramp first.
pub(super) fn tests(
    gyro: &Gyro,
    explanations: &[Explanation],
    programmes: &[Programme],
    progress: &dyn Fn(Step),
) -> Result<Vec<Test>, diagnosis::Error> {
    let likely = |e: &&Explanation| e.sigma().is_some_and(|sigma| sigma.abs() <= STRAINED);
    let mut contenders: Vec<Contender> = Vec::new();
    for truth in explanations.iter().filter(likely).filter_map(|e| active(gyro, e)) {
        let contender = Contender::of(gyro, truth);
        if !contenders.iter().any(|c| c.id == contender.id) {
            contenders.push(contender);
        }
    }
    let Some(at) = contenders.iter().position(|c| c.id == TAIL) else { return Ok(Vec::new()) };
    let tail = contenders.remove(at);
    contenders.push(Contender::recalibrated());
    let noise = usual(gyro);
    let mut tests = Vec::new();
    for other in contenders {
        let between = [tail.id.clone(), other.id.clone()];
        progress(Step::begins(&format!("what tells {} from {}", between[0], between[1])));
        let pair = [tail.clone(), other];
        let mut told = Vec::with_capacity(programmes.len());
        for (k, programme) in programmes.iter().enumerate() {
            let plan = Plan { records: &[k + 1], instants: &[everything(programme)], noise: Some(&noise) };
            told.push((programme.name.clone(), odds(gyro, &pair, &plan)?));
        }
        let slow = told[0].clone();
        let best = told.into_iter().max_by(|a, b| a.1.log_odds.total_cmp(&b.1.log_odds)).unwrap_or_else(|| slow.clone());
        tests.push(Test { between, slow, best });
    }
    Ok(tests)
}
