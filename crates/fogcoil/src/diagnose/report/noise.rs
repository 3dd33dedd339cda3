//! The noise that the diagnosis identified, channel by channel.

use bias::units::S_PER_H;
use mechanisms::RATE;
use recording::allan::allan;

use crate::check::Allan;
use crate::diagnose::Outcome;
use crate::figures::element;
use crate::table::significant;

impl Outcome {
    pub(super) fn noise(&self, out: &mut String) {
        out.push_str("<h2>Noise</h2>\n");
        let best = &self.diagnosis.best().fit;
        let mut rows = Vec::new();
        for (n, record) in self.fits.iter().enumerate() {
            for q in self.quantities() {
                let (model, unit) = (best.noise_model(n, q.channel), if q.channel == RATE { "°/h" } else { "K" });
                let mut white = format!("{} {unit}", significant(model.white, 3));
                if let Some(random_walk) = model.angle_random_walk().filter(|_| q.channel == RATE) {
                    white += &format!(" ({} °/√h)", significant(random_walk / S_PER_H.sqrt(), 3));
                }
                rows.push(vec![
                    format!("{}, {}", record.name(), q.name),
                    white,
                    format!("{} {unit}", significant(model.drift, 2)),
                    format!("{} h", significant(model.drift_time / S_PER_H, 2)),
                    format!("{} {unit}/√h", significant(model.walk * S_PER_H.sqrt(), 2)),
                ]);
            }
        }
        super::grid(out, &["channel (fitted)", "white, of a sample", "drift", "its correlation time", "random walk"], &rows);
        let Some(shown) = self.shown().pop() else { return };
        let time = &shown.record.observed.time;
        let residual = &shown.fit.residuals[shown.number][RATE];
        let mask: Vec<bool> = residual.iter().map(|r| r.is_finite()).collect();
        let mut intervals: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
        intervals.sort_by(f64::total_cmp);
        let (Ok(points), Some(interval)) = (allan(time, residual, &mask), intervals.get(intervals.len() / 2)) else { return };
        let allan = Allan { points: &points, model: best.noise_model(shown.number, RATE), interval: *interval };
        let caption = format!("Of what the {} leaves of the rate, and of the noise model that was fitted with it.", shown.name);
        if let Some(figure) = allan.figure("allan", "Allan deviation of what is left of the rate".into(), caption) {
            out.push_str(&element(&figure));
        }
    }
}
