//! A temperature's course as heating and cooling.

use super::absent::{Direction, Short, Watch};
use crate::statistics::median;

/// Range, of noise, from which a movement is none of it: white noise has turns of seven standard deviations among thousands of rows.
const NOISES: f64 = 10.0;
/// The same of the resolution's steps, and of the whole range: a controller's ripple is no ramp.
const STEPS: f64 = 3.0;
const OF_RANGE: f64 = 0.02;
/// A turn is where the course was last within this share of the threshold from its extreme: on a rest, noise stays within it.
const AT_EXTREME: f64 = 0.7;
/// A course has a ramp from this many thresholds on.
pub(super) const RAMP: f64 = 2.0;

/// Width of the play, in thresholds: noise moves it by a fourteenth.
const PLAY: f64 = 10.0;
/// Levels of a branch's way, and how many times longer than usual the course stays between two of them where it rests.
const LEVELS: usize = 20;
const RESTS: f64 = 3.0;

/// A response slower than its ramp by more than this hardly begins in it.
const WATCHED: f64 = 2.0;

/// A course between two turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Branch {
    pub(super) direction: Direction,
    /// First row of the next.
    pub(super) end: usize,
    /// Its range \[K\].
    pub(super) travel: f64,
    /// Duration of its longest ramp without a rest \[s\].
    pub(super) ramp: f64,
    /// Duration of its longest rest \[s\].
    pub(super) rest: f64,
}

/// A temperature's course.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    /// Branches, in their order.
    pub(super) branches: Vec<Branch>,
    /// Sum of all movement upwards, and of all downwards: the temperature less its first value is the sum of the two \[K\].
    pub(super) movement: [Vec<f64>; 2],
    /// From −½ to ½: where it has come from. A movement of [`PLAY`] thresholds upwards takes it to ½, as much downwards to −½ (the play of a gear;
    /// Krasnosel'skii and Pokrovskii 1989); 0 at first.
    pub(super) side: Vec<f64>,
}

/// Least movement \[K\] that is no noise.
pub(super) fn threshold(range: f64, noise: f64, step: f64) -> f64 {
    (NOISES * noise).max(STEPS * step).max(OF_RANGE * range)
}

impl Course {
    /// Course of a temperature whose movements below `threshold` are noise.
    pub(super) fn new(time: &[f64], temperature: &[f64], threshold: f64) -> Self {
        let mut branches = Vec::new();
        let mut from = 0;
        for (direction, end) in turns(temperature, threshold) {
            branches.push(branch(direction, from, end, time, temperature));
            from = end;
        }
        let (mut movement, mut side) = ([vec![0.0; time.len()], vec![0.0; time.len()]], vec![0.0; time.len()]);
        let (mut sums, mut now) = ([0.0; 2], 0);
        for row in 1..time.len() {
            if branches.get(now).is_some_and(|branch: &Branch| row > branch.end) {
                now += 1;
            }
            if let Some(branch) = branches.get(now) {
                sums[branch.direction as usize] += temperature[row] - temperature[row - 1];
            }
            side[row] = (side[row - 1] + (temperature[row] - temperature[row - 1]) / (PLAY * threshold)).clamp(-0.5, 0.5);
            movement.iter_mut().zip(sums).for_each(|(moved, sum)| moved[row] = sum);
        }
        Self { branches, movement, side }
    }

    /// Whether there is a ramp this way, given the threshold of noise.
    pub(super) fn ramps(&self, direction: Direction, threshold: f64) -> bool {
        self.branches.iter().any(|branch| branch.direction == direction && branch.travel > RAMP * threshold)
    }

    /// How long a response is seen to settle: a ramp, or a rest up to [`WATCHED`] times as long, of the branches that go at least half as far as the
    /// farthest.
    pub(super) fn watched(&self) -> Option<Watch> {
        let farthest = self.branches.iter().map(|branch| branch.travel).fold(0.0, f64::max);
        let far = || self.branches.iter().filter(|branch| branch.travel >= 0.5 * farthest && branch.travel > 0.0);
        let seen = |branch: &Branch| branch.ramp.max(branch.rest.min(WATCHED * branch.ramp));
        let longest = far().max_by(|a, b| seen(a).total_cmp(&seen(b)))?;
        let short = match longest.rest {
            rest if rest <= longest.ramp => Short::Both,
            rest if rest <= WATCHED * longest.ramp => Short::Rests,
            _ => Short::Ramps,
        };
        let most = |of: fn(&Branch) -> f64| far().map(of).fold(0.0, f64::max);
        Some(Watch { ramp: most(|branch| branch.ramp), rest: most(|branch| branch.rest), settling: seen(longest), short })
    }
}

/// Directions of the branches, each with its last row.
fn turns(temperature: &[f64], threshold: f64) -> Vec<(Direction, usize)> {
    let mut found: Vec<(Direction, usize)> = Vec::new();
    let mut going: Option<Direction> = None;
    // least and largest since the last turn
    let mut extremes = [temperature.first().copied().unwrap_or(0.0); 2];
    for (row, &value) in temperature.iter().enumerate() {
        extremes = [extremes[0].min(value), extremes[1].max(value)];
        let turned = match going {
            Some(Direction::Heating) => value < extremes[1] - threshold,
            Some(Direction::Cooling) => value > extremes[0] + threshold,
            None => {
                let up = value > extremes[0] + threshold;
                going = if up {
                    Some(Direction::Heating)
                } else if value < extremes[1] - threshold {
                    Some(Direction::Cooling)
                } else {
                    None
                };
                false
            }
        };
        if let Some(direction) = going.filter(|_| turned) {
            let near = |value: &f64| match direction {
                Direction::Heating => *value >= extremes[1] - AT_EXTREME * threshold,
                Direction::Cooling => *value <= extremes[0] + AT_EXTREME * threshold,
            };
            let end = (0..row).rev().find(|&before| near(&temperature[before])).unwrap_or(row);
            found.push((direction, end));
            going = Some(if direction == Direction::Heating { Direction::Cooling } else { Direction::Heating });
            extremes = [value; 2];
        }
    }
    found.extend(going.map(|direction| (direction, temperature.len() - 1)));
    found
}

fn branch(direction: Direction, from: usize, end: usize, time: &[f64], temperature: &[f64]) -> Branch {
    let way = |row: usize| (temperature[row] - temperature[from]).abs();
    let travel = (from..=end).map(way).fold(0.0, f64::max);
    let passes = |level: usize| {
        let to = level as f64 / LEVELS as f64 * travel;
        let row = (from..=end).find(|&row| way(row) >= to).unwrap_or(end);
        let Some(before) = row.checked_sub(1).filter(|_| row > from) else { return time[row] };
        // on the straight line from the row before
        let share = (to - way(before)) / (way(row) - way(before));
        time[before] + share.clamp(0.0, 1.0) * (time[row] - time[before])
    };
    let dwells: Vec<f64> = (1..LEVELS - 1).map(|level| passes(level + 1) - passes(level)).collect();
    let most = RESTS * median(dwells.clone()).unwrap_or(0.0);
    // where a rest lies between two levels, as a share of the way from one to the other
    let lies = |number: usize| {
        let span = passes(number + 1)..=passes(number + 2);
        let within = |row: &usize| span.contains(&time[*row]);
        let rest = median((from..=end).filter(within).map(way).collect()).unwrap_or(0.0);
        (rest / travel * LEVELS as f64 - (number + 1) as f64).clamp(0.0, 1.0)
    };
    // from the first dwell of a run to the one behind it; the levels at either end hold part of a rest each
    let ramp = |first: usize, behind: usize| {
        let before = first.checked_sub(1).map_or(1.0, |rest| 1.0 - lies(rest));
        let after = if behind < dwells.len() { lies(behind) } else { 1.0 };
        // and so may the dwells beside a rest
        let [from, to] = [first + usize::from(first > 0), behind - usize::from(behind < dwells.len())];
        let told = dwells.get(from..to).filter(|told| !told.is_empty()).unwrap_or(&dwells[first..behind]);
        told.iter().sum::<f64>() / told.len() as f64 * ((behind - first) as f64 + before + after)
    };
    let is_ramp = |number: usize| dwells[number] <= most;
    let firsts = (0..dwells.len()).filter(|&n| is_ramp(n) && (n == 0 || !is_ramp(n - 1)));
    let ramps = firsts.map(|first| ramp(first, (first..dwells.len()).find(|&n| !is_ramp(n)).unwrap_or(dwells.len())));
    let ends = [passes(1) - time[from], time[end] - passes(LEVELS - 1)];
    let rest = dwells.iter().chain(&ends).copied().filter(|dwell| *dwell > most).fold(0.0, f64::max);
    Branch { direction, end, travel, ramp: ramps.fold(0.0, f64::max), rest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rest_belongs_to_the_ramp_before_it() {
        let time: Vec<f64> = (0..400).map(f64::from).collect();
        // rest, up by 40 K in 100 s, rest, down by 20 K in 50 s, rest
        let clean = |t: f64| 20.0 + 0.4 * (t - 50.0).clamp(0.0, 100.0) - 0.4 * (t - 250.0).clamp(0.0, 50.0);
        let noisy: Vec<f64> = time.iter().map(|t| clean(*t) + 0.1 * (t * 12.9898).sin()).collect();
        let course = Course::new(&time, &noisy, 2.0);
        let of: Vec<Direction> = course.branches.iter().map(|b| b.direction).collect();
        assert_eq!(of, [Direction::Heating, Direction::Cooling]);
        // a turn is found to 0.7 of the threshold
        assert!((course.branches[0].travel - 40.0).abs() < 1.4 && (course.branches[1].travel - 20.0).abs() < 1.4, "{course:?}");
        assert!((course.branches[0].ramp - 100.0).abs() < 3.0 && (course.branches[0].rest - 105.0).abs() < 10.0, "{course:?}");
        assert!((course.branches[1].ramp - 50.0).abs() < 3.0 && (course.branches[1].rest - 103.0).abs() < 10.0, "{course:?}");
        assert_eq!(course.watched().map(|watch| watch.settling), Some(course.branches[0].rest));
        let side = [20, 100, 240, 280, 399].map(|row| course.side[row]);
        assert!(side[0].abs() < 0.02 && (side[1] - 0.5).abs() < 0.02 && (side[2] - 0.5).abs() < 0.02, "{side:?}");
        assert!((side[3] + 0.1).abs() < 0.02 && (side[4] + 0.5).abs() < 0.02, "{side:?}");
        for row in 0..400 {
            let sum = noisy[0] + course.movement[0][row] + course.movement[1][row];
            assert!((sum - noisy[row]).abs() < 1e-9);
        }
        assert!((course.movement[0][399] - 40.0).abs() < 1.5 && (course.movement[1][399] + 20.0).abs() < 1.5);
    }

    /// A branch ends with its last row within 0.7 of the threshold of the extreme: of a triangle of a little over a tenth of the threshold a row, the sixth behind the tip.
    #[test]
    fn exact_a_branch_ends_near_its_extreme() {
        let down_first: Vec<f64> = (0..401_usize).map(|row| 0.41 * (row % 200).abs_diff(100) as f64).collect();
        let of = |temperature: &[f64]| turns(temperature, 4.0).into_iter().map(|(_, end)| end).collect::<Vec<_>>();
        assert_eq!(of(&down_first), [106, 206, 306, 400]);
        let up_first: Vec<f64> = down_first.iter().map(|value| -value).collect();
        assert_eq!(of(&up_first), [106, 206, 306, 400]);
    }

    #[test]
    fn a_rest_on_the_way_ends_a_ramp() {
        let time: Vec<f64> = (0..1000).map(f64::from).collect();
        let way = |t: f64| 0.4 * (t - 50.0).clamp(0.0, 200.0) + 0.4 * (t - 650.0).clamp(0.0, 100.0);
        let course = Course::new(&time, &time.iter().map(|t| way(*t)).collect::<Vec<_>>(), 2.0);
        assert_eq!(course.branches.len(), 1);
        assert!((course.branches[0].ramp - 200.0).abs() < 2.0 && (course.branches[0].rest - 400.0).abs() < 20.0, "{course:?}");
    }

    /// Rests at levels that the way is divided by, beside noise: 80 K down in steps of 20 K, of 300 s each, with rests of an hour.
    #[test]
    fn ramps_between_rests_last_as_long_as_they_do() {
        let time: Vec<f64> = (0..551).map(|row| 30.0 * f64::from(row)).collect();
        let steps = |t: f64| (0..4).map(|n| 20.0 / 300.0 * (t - 900.0 - 3900.0 * f64::from(n)).clamp(0.0, 300.0)).sum::<f64>();
        for seed in 0..8 {
            let noise = |t: f64| 0.01 * (t * 12.9898 + f64::from(seed)).sin();
            let temperature: Vec<f64> = time.iter().map(|t| 60.0 - steps(*t) + noise(*t)).collect();
            let course = Course::new(&time, &temperature, 1.6);
            let watch = course.watched().expect("a course");
            assert!((watch.ramp - 300.0).abs() < 30.0 && (watch.rest - 3600.0).abs() < 120.0, "{watch:?}");
            assert!(watch.settling == WATCHED * watch.ramp && watch.short == Short::Ramps, "{watch:?}");
        }
    }

    #[test]
    fn noise_is_no_course() {
        let time: Vec<f64> = (0..100).map(f64::from).collect();
        let noise: Vec<f64> = time.iter().map(|t| (t * 12.9898).sin()).collect();
        let course = Course::new(&time, &noise, threshold(2.0, 0.7, 0.0));
        assert!(course.branches.is_empty() && course.watched().is_none() && !course.ramps(Direction::Heating, 7.0));
    }
}
