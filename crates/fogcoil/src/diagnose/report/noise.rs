//! The noise that the diagnosis identified, channel by channel.

use bias::units::S_PER_H;
use charts::{Cells, Figure, grid, significant};
use maud::{Markup, html};
use mechanisms::RATE;
use recording::allan::{AllanPoint, allan};
use recording::median_interval;

use super::Shown;
use crate::check::Allan;
use crate::diagnose::Outcome;

impl Outcome<'_> {
    pub(super) fn noise(&self) -> Markup {
        let best = self.leading();
        let mut rows = Vec::new();
        for (n, record) in self.fits.iter().enumerate() {
            for q in self.quantities() {
                let (model, unit) = (best.noise_model(n, q.channel), q.unit);
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
        let head = ["channel (fitted)", "white, of a sample", "drift", "its correlation time", "random walk"];
        let left: Vec<(Shown, Vec<AllanPoint>)> =
            self.each().filter_map(|mut shown| shown.pop()).map(|shown| (shown, deviation(&shown))).collect();
        let figures = left.iter().filter_map(|(shown, points)| {
            let interval = median_interval(&shown.record.observed.time).unwrap_or(1.0);
            let allan = Allan { points, model: best.noise_model(shown.number, RATE), interval, is_bound: false };
            let caption =
                format!("Of what the {} leaves of the rate, and of the noise model that was fitted with it.", shown.name);
            let mut figure = allan.figure("allan", "Allan deviation of what is left of the rate".into(), caption)?;
            figure.panels.iter_mut().for_each(|panel| panel.heading = self.headed("", shown.record));
            Some(figure)
        });
        let all = figures.reduce(|mut all, one| {
            all.panels.extend(one.panels);
            Figure { columns: 2, ..all }
        });
        html! {
            (grid("Noise by channel", Cells::Words, &head, &rows))
            @if let Some(figure) = all { (figure.element()) }
        }
    }
}

/// Allan deviation of what is left of the rate; empty where there is too little.
fn deviation(shown: &Shown) -> Vec<AllanPoint> {
    let residual = &shown.fit.residuals[shown.number][RATE];
    let mask: Vec<bool> = residual.iter().map(|r| r.is_finite()).collect();
    allan(&shown.record.observed.time, residual, &mask).unwrap_or_default()
}
