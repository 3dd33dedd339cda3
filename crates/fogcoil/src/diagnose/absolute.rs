//! Temperatures among fitted parameters: no record tells them better than the chamber's thermometer is known.

use diagnosis::{Diagnosis, Estimate};
use recording::statistics::normal_quantile;

use crate::units::parameter_unit;

/// Offset of a chamber's thermometer of which no meta file tells (1σ) \[K\]: the tolerance of class B at 0 °C, IEC 60751.
pub(super) const USUAL_OFFSET_K: f64 = 0.3;

/// Widens the intervals of fitted temperatures by the offset of the chamber's thermometer (1σ) \[K\]: a fit takes the chamber's readings for its temperatures.
pub(super) fn widen(diagnosis: &mut Diagnosis, offset_sd: f64) {
    diagnosis.parameters.iter_mut().flatten().filter(|own| is_temperature(own)).for_each(|own| widened(own, offset_sd));
}

fn is_temperature(estimate: &Estimate) -> bool {
    parameter_unit(&estimate.name) == "degC"
}

fn widened(estimate: &mut Estimate, offset_sd: f64) {
    let by = normal_quantile(0.95) * offset_sd;
    let [low, high] = estimate.ci90.map(|end| (end - estimate.value).hypot(by));
    estimate.ci90 = [estimate.value - low, estimate.value + high];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_temperature_is_known_no_better_than_the_thermometer() {
        let of = |name: &str| Estimate { name: name.into(), value: -10.0, ci90: [-10.3, -9.6] };
        let mut own = of("debond_c");
        assert!(is_temperature(&own) && !is_temperature(&of("hysteresis_k")) && !is_temperature(&of("polymer_fraction_change")));
        widened(&mut own, 0.4 / normal_quantile(0.95));
        assert!((own.ci90[0] + 10.5).abs() < 1e-12 && (own.ci90[1] + 10.0 - 0.32_f64.sqrt()).abs() < 1e-12, "{own:?}");
        let mut exact = of("tg_c");
        widened(&mut exact, 0.0);
        assert!((exact.ci90[0] + 10.3).abs() < 1e-12 && (exact.ci90[1] + 9.6).abs() < 1e-12, "{exact:?}");
    }
}
