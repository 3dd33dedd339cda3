//! Division of an outline: finely where a film or a ring is thin, coarsely elsewhere.

use super::Layout;
use super::layout::shifts;
use std::f64::consts::{FRAC_PI_6, TAU};

/// Parameters at which the spacing is taken.
const SAMPLES: usize = 720;
/// Growth of the spacing per length along the outline.
const GROWTH: f64 = 0.35;
const FEWEST: usize = 12;

/// Parameters \[rad\] of the ends of the divisions of inclusion `i`, increasing over one turn, the last one turn after the first.
///
/// A film of thickness g between surfaces of curvatures 1/ρ₁ and 1/ρ₂ widens over √(2 g / (1/ρ₁ + 1/ρ₂)), a ring of varying thickness δ
/// over R √(2 δ/δ_max): the divisions are `0.8 / fineness` of these, and at most 30° / fineness.
pub(super) fn divisions(layout: &Layout, i: usize, fineness: f64) -> Vec<f64> {
    let hull = layout.inclusions()[i].hull();
    let parameter = |k: usize| TAU * k as f64 / SAMPLES as f64;
    let mut spacing = spacing(layout, i, fineness);
    let step = |k: usize| hull.speed(parameter(k % SAMPLES)) * TAU / SAMPLES as f64;
    for k in 0..2 * SAMPLES {
        let (here, next) = (k % SAMPLES, (k + 1) % SAMPLES);
        spacing[next] = spacing[next].min(spacing[here] + GROWTH * step(here));
    }
    for k in (0..2 * SAMPLES).rev() {
        let (here, next) = (k % SAMPLES, (k + 1) % SAMPLES);
        spacing[here] = spacing[here].min(spacing[next] + GROWTH * step(here));
    }
    let first = (0..SAMPLES).fold(0, |best, k| if spacing[k] < spacing[best] * (1.0 - 1e-9) { k } else { best });
    let mut sums = vec![0.0];
    for k in 0..SAMPLES {
        let density = |k: usize| step(k) / spacing[k % SAMPLES];
        sums.push(sums[k] + f64::midpoint(density(first + k), density(first + k + 1)));
    }
    let count = FEWEST.max((sums[SAMPLES] - 1e-6).ceil() as usize);
    let mut k = 0;
    let interior = (1..count).map(|j| {
        let wanted = sums[SAMPLES] * j as f64 / count as f64;
        while sums[k + 1] < wanted {
            k += 1;
        }
        parameter(first) + TAU * (k as f64 + (wanted - sums[k]) / (sums[k + 1] - sums[k])) / SAMPLES as f64
    });
    let mut ends = vec![parameter(first)];
    ends.extend(interior);
    ends.push(parameter(first) + TAU);
    ends
}

/// Wanted length of a division at each sample \[m\].
fn spacing(layout: &Layout, i: usize, fineness: f64) -> Vec<f64> {
    let inclusion = &layout.inclusions()[i];
    let hull = inclusion.hull();
    let mut others = Vec::new();
    for (j, other) in layout.inclusions().iter().enumerate() {
        let moved = shifts(2).filter(|s| j != i || *s != [0, 0]).map(|s| other.hull().moved(layout.vector(s)));
        let apart = |o: &super::Outline| (o.centre[0] - hull.centre[0]).hypot(o.centre[1] - hull.centre[1]);
        others.extend(moved.filter(|o| apart(o) - o.reach() < 3.0 * hull.reach()));
    }
    let thickness = |t: f64| {
        inclusion.outlines.windows(2).map(move |pair| {
            let ([x, y], [u, v]) = (pair[0].point(t), pair[1].point(t));
            (x - u).hypot(y - v)
        })
    };
    let all: Vec<Vec<f64>> = (0..SAMPLES).map(|k| thickness(TAU * k as f64 / SAMPLES as f64).collect()).collect();
    let thickest: Vec<f64> =
        (0..inclusion.outlines.len() - 1).map(|ring| all.iter().map(|t| t[ring]).fold(0.0, f64::max)).collect();
    let wanted = |(k, thin): (usize, &Vec<f64>)| {
        let t = TAU * k as f64 / SAMPLES as f64;
        let (p, radius) = (hull.point(t), hull.curvature_radius(t));
        let films = others.iter().map(|other| {
            let (gap, at) = other.nearest(p);
            0.8 * (2.0 * gap / (1.0 / radius + 1.0 / other.curvature_radius(at))).sqrt()
        });
        let rings = thin.iter().zip(&thickest).map(|(thin, most)| 0.8 * hull.reach() * (2.0 * thin / most).sqrt());
        films.chain(rings).fold(FRAC_PI_6 * radius, f64::min) / fineness
    };
    all.iter().enumerate().map(wanted).collect()
}
