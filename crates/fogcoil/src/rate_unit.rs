//! A rate that is in another unit than the one it is read in: a mistake that a design's prediction shows.

use recording::check::Unit;

/// Least ratio of two units at which one is suspected in place of the other: faults make less of a sensitivity.
const FAR: f64 = 10.0;

/// The first of these units in which a rate `agrees` with a prediction, given the factor on the rate as it was read.
pub(crate) fn suspected(units: &[Unit], agrees: impl Fn(f64) -> bool) -> Option<&Unit> {
    let is_far = |unit: &&Unit| unit.scale.max(1.0 / unit.scale) >= FAR;
    units.iter().filter(is_far).find(|unit| agrees(unit.scale))
}

/// How a rate is off that has to be multiplied by `scale`.
pub(crate) fn how_far(scale: f64) -> String {
    let (times, how) = if scale > 1.0 { (scale, "small") } else { (1.0 / scale, "large") };
    format!("{} times too {how}", crate::table::significant(times, 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_units_far_from_the_one_that_is_read_are_suspected() {
        let unit = |name: &str, scale: f64| Unit { name: name.into(), scale, offset: 0.0 };
        let units = [unit("deg/h", 1.0 / 3600.0), unit("rad/s", 57.3), unit("rad/h", 0.0159), unit("near", 3.6)];
        let of = |wanted: f64| suspected(&units, |scale| (scale / wanted - 1.0).abs() < 0.2).map(|unit| unit.name.as_str());
        assert_eq!(
            [of(60.0), of(1.0 / 3600.0), of(0.016), of(3.6), of(20.0)],
            [Some("rad/s"), Some("deg/h"), Some("rad/h"), None, None]
        );
        assert_eq!([how_far(57.3), how_far(1.0 / 3600.0)], ["57.3 times too small", "3600 times too large"]);
    }
}
