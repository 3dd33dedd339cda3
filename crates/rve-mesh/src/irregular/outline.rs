//! Ellipses: the outlines of rings and voids.

use std::f64::consts::PI;

/// An ellipse, counter-clockwise in a parameter that is the polar angle where it is a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    /// Centre \[m\].
    pub centre: [f64; 2],
    /// Semi-axes \[m\].
    pub semi_axes: [f64; 2],
    /// Direction of the first axis \[rad\].
    pub angle: f64,
}

impl Outline {
    /// A circle.
    pub fn circle(centre: [f64; 2], radius: f64) -> Self {
        Self { centre, semi_axes: [radius; 2], angle: 0.0 }
    }

    /// The same outline moved by `by` \[m\].
    pub fn moved(&self, by: [f64; 2]) -> Self {
        Self { centre: [self.centre[0] + by[0], self.centre[1] + by[1]], ..*self }
    }

    /// Area inside \[m²\].
    pub fn area(&self) -> f64 {
        PI * self.semi_axes[0] * self.semi_axes[1]
    }

    /// The larger semi-axis \[m\].
    pub fn reach(&self) -> f64 {
        self.semi_axes[0].max(self.semi_axes[1])
    }

    /// Whether all is finite and the semi-axes are positive.
    pub(super) fn is_valid(&self) -> bool {
        let finite = self.centre.iter().chain([&self.angle]).all(|v| v.is_finite());
        finite && self.semi_axes.iter().all(|a| a.is_finite() && *a > 0.0)
    }

    /// Position at parameter `t` \[rad\].
    pub fn point(&self, t: f64) -> [f64; 2] {
        let (s, c) = (t - self.angle).sin_cos();
        self.outwards([self.semi_axes[0] * c, self.semi_axes[1] * s])
    }

    /// Radius of curvature at `t` \[m\].
    pub(super) fn curvature_radius(&self, t: f64) -> f64 {
        let ([a, b], (s, c)) = (self.semi_axes, (t - self.angle).sin_cos());
        (a * s).hypot(b * c).powi(3) / (a * b)
    }

    /// Arc length per parameter at `t` \[m\].
    pub(super) fn speed(&self, t: f64) -> f64 {
        let ([a, b], (s, c)) = (self.semi_axes, (t - self.angle).sin_cos());
        (a * s).hypot(b * c)
    }

    fn outwards(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (s, c) = self.angle.sin_cos();
        [self.centre[0] + c * u - s * v, self.centre[1] + s * u + c * v]
    }

    /// Distance from `p` to the outline \[m\], negative inside, and the parameter of the nearest point.
    ///
    /// By bisection of the one root of the Lagrange multiplier (D. Eberly, *Distance from a Point to an Ellipse*, 2013).
    pub fn nearest(&self, p: [f64; 2]) -> (f64, f64) {
        let d = [p[0] - self.centre[0], p[1] - self.centre[1]];
        let (s, c) = self.angle.sin_cos();
        let (u, v) = (c * d[0] + s * d[1], c * d[1] - s * d[0]);
        let [a, b] = self.semi_axes;
        if a == b {
            return (u.hypot(v) - a, self.angle + v.atan2(u));
        }
        // in the first quadrant, long axis first
        let (long, short, x, y) = if a > b { (a, b, u.abs(), v.abs()) } else { (b, a, v.abs(), u.abs()) };
        let (ratio, y) = ((long / short).powi(2), y.max(1e-14 * short));
        let (zx, zy) = (x / long, y / short);
        let (mut low, mut high) = (zy - 1.0, (ratio * zx).hypot(zy) - 1.0);
        for _ in 0..80 {
            let middle = f64::midpoint(low, high);
            let outside = (ratio * zx / (middle + ratio)).powi(2) + (zy / (middle + 1.0)).powi(2) > 1.0;
            (low, high) = if outside { (middle, high) } else { (low, middle) };
        }
        let root = f64::midpoint(low, high);
        let (nx, ny) = (ratio * x / (root + ratio), y / (root + 1.0));
        let distance = (nx - x).hypot(ny - y) * if zx * zx + zy * zy < 1.0 { -1.0 } else { 1.0 };
        let (nu, nv) = if a > b { (nx, ny) } else { (ny, nx) };
        (distance, self.angle + (nv.copysign(v) / b).atan2(nu.copysign(u) / a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_the_nearest_point_is_where_the_normal_passes_through() {
        for (semi_axes, angle) in [([3.0, 1.0], 0.4), ([1.0, 2.5], -1.0), ([2.0, 2.0], 0.0)] {
            let outline = Outline { centre: [0.3, -0.2], semi_axes, angle };
            for k in 0..40 {
                let t = 0.157 * f64::from(k);
                let (p, q) = (outline.point(t), outline.point(t + 1e-6));
                let (dx, dy) = ((q[0] - p[0]) / 1e-6, (q[1] - p[1]) / 1e-6);
                let length = dx.hypot(dy);
                assert!((length - outline.speed(t)).abs() < 1e-5);
                let away = 0.7;
                let (distance, found) = outline.nearest([p[0] + away * dy / length, p[1] - away * dx / length]);
                let [x, y] = outline.point(found);
                assert!((distance - away).abs() < 1e-5 && (x - p[0]).hypot(y - p[1]) < 1e-5, "{t}: {distance}");
                let inside = outline.nearest([p[0] - 0.1 * dy / length, p[1] + 0.1 * dx / length]).0;
                assert!((inside + 0.1).abs() < 1e-5, "{t}: {inside}");
            }
        }
    }
}
