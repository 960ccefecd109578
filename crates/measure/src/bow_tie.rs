//! The bow tie: the obstruction by an observer's head toward the short axis of a stone less that toward its long
//! axis.

use super::exit_sight::ExitSight;
use super::interval::Interval;
use brillianteer_math::{Calipers, Polytope, hull};
use brillianteer_trace::beam::Beams;
use glam::DVec2;

/// A line that passes the origin more closely than this has no triangle with it.
const THROUGH_ORIGIN: f64 = 1e-14;

/// The square of the part of its distance from the origin up to which an edge is short: five points then give its integral to
/// 1e-13 of the triangle.
const SHORT_SQUARED: f64 = 0.01;

/// The places and weights of the integral from -1 to 1 by five points (Gauss and Legendre).
const FIVE_POINTS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// The image in coordinates in which the stone's outline is as wide as long: x along the short axis.
struct StretchedFace {
    middle: DVec2,
    short: DVec2,
    /// The outline's width and length.
    size: DVec2,
}

impl StretchedFace {
    fn of(beams: &Beams, polytope: &Polytope) -> Option<Self> {
        let outline = hull(polytope.vertices().iter().map(|&corner| beams.view.project(corner)).collect());
        let Calipers { width, length, across, middle } = Calipers::of(&outline)?;
        Some(Self { middle, short: across, size: DVec2::new(width, length) })
    }

    fn at(&self, p: DVec2) -> DVec2 {
        let p = p - self.middle;
        DVec2::new(p.dot(self.short), p.dot(self.short.perp())) / self.size
    }

    /// Returns the integral of cos 2φ over a convex polygon of the image, in the image's area, where φ is the angle from the short
    /// axis. The polygon may run either way round.
    fn cos_twice(&self, corners: impl Iterator<Item = DVec2> + Clone) -> f64 {
        let corners = corners.map(|p| self.at(p));
        let edges = corners.clone().zip(corners.clone().cycle().skip(1));
        let twice_area: f64 = edges.clone().map(|(a, b)| a.perp_dot(b)).sum();
        edges.map(|(a, b)| cos_twice_of(a, b)).sum::<f64>() * twice_area.signum() * self.size.x * self.size.y
    }
}

/// Returns the integral of cos 2φ over the triangle of the origin and an edge, negative for an edge that runs clockwise.
///
/// With the distance d of the edge's line, whose foot lies at the angle α, a point of the edge at the angle α + ψ is at the
/// distance d / cos ψ. So the integral is ½ d² ∫ cos(2α + 2ψ) / cos² ψ dψ, with t = d tan ψ along the edge:
/// ½ (cos 2α (2 d² ψ − d t) − sin 2α d² ln(d² + t²)), up to the sign of the last term, between the ends of the edge. Most
/// edges are short, and there the mean of cos 2φ along the edge needs no such functions.
fn cos_twice_of(a: DVec2, b: DVec2) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    if 4.0 * half.length_squared() < SHORT_SQUARED * middle.length_squared() {
        let cos = |part: f64| {
            let p = middle + half * part;
            (p.x * p.x - p.y * p.y) / p.length_squared()
        };
        let mean: f64 = FIVE_POINTS.iter().map(|&(place, weight)| weight * cos(place)).sum();
        return 0.25 * a.perp_dot(b) * mean;
    }
    let Some(along) = (b - a).try_normalize() else { return 0.0 };
    let foot = a - along * a.dot(along);
    let d = foot.length();
    if d < THROUGH_ORIGIN {
        return 0.0;
    }
    let out = foot / d;
    let [from, to] = [a, b].map(|p| {
        let t = p.dot(out.perp());
        (2.0 * d * d * t.atan2(d) - d * t, d * d * (d * d + t * t).ln())
    });
    // cos 2α and sin 2α of the direction `out`.
    let (cos, sin) = (out.x * out.x - out.y * out.y, 2.0 * out.x * out.y);
    0.5 * (cos * (to.0 - from.0) - sin * (to.1 - from.1))
}

/// Returns the obstruction toward the short axis less that toward the long axis; `None` where the outline has no area.
///
/// Toward an axis places count by 1 ± cos 2φ, so that both means are parts of the light there, from 0 to 1.
pub(super) fn bow_tie(beams: &Beams, polytope: &Polytope, head_deg: f64) -> Option<Interval> {
    let face = StretchedFace::of(beams, polytope)?;
    let copies = beams.symmetry.copies();
    let of_outline = |outline: &[DVec2]| -> f64 {
        copies.iter().map(|copy| face.cos_twice(outline.iter().map(|&p| *copy * p))).sum()
    };
    let order = f64::from(beams.symmetry.order());
    // Three sums of light by its weight: over the whole face, from the head, and unresolved.
    let [mut all, mut head, mut open] = [[0.0; 2]; 3];
    let mut found = 0.0;
    for beam in beams.iter() {
        let is_head = !beam.is_surface()
            && beam.weight > 0.0
            && ExitSight::of(&beam, beams, head_deg) == ExitSight::Head;
        if !(beam.is_surface() || is_head || beam.open) {
            continue;
        }
        let twice = of_outline(beam.outline);
        let toward = [1.0, -1.0].map(|sign| beam.area * order + sign * twice);
        for k in 0..2 {
            all[k] += if beam.is_surface() { toward[k] } else { 0.0 };
            head[k] += if is_head { beam.weight * toward[k] } else { 0.0 };
            open[k] += if beam.open { beam.onward * toward[k] } else { 0.0 };
        }
        found += if beam.open { beam.onward * beam.area * order } else { 0.0 };
    }
    // Light that was lost in slivers counts in full toward each axis.
    let lost = (beams.unresolved() * beams.silhouette_area - found).max(0.0);
    let of_axis = |k: usize| {
        let whole = Some(all[k]).filter(|whole| *whole > 0.0)?;
        Some(Interval::from(head[k] / whole, (open[k] + 2.0 * lost) / whole))
    };
    let (short, long) = (of_axis(0)?, of_axis(1)?);
    Some(Interval { least: short.least - long.most, most: short.most - long.least })
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::{area, point_in_polygon};

    #[test]
    fn the_integral_over_a_short_edge_is_that_of_its_parts_and_of_longer_ones() {
        let at = |part: f64| DVec2::new(0.9, -0.3).lerp(DVec2::new(-0.2, 0.7), part);
        let whole = cos_twice_of(at(0.0), at(1.0));
        for count in [7, 40, 1000] {
            let place = |k: usize| at(k as f64 / count as f64);
            let sum: f64 = (0..count).map(|k| cos_twice_of(place(k), place(k + 1))).sum();
            assert!((sum - whole).abs() < 1e-13, "{count} parts: {sum}, {whole}");
        }
    }

    #[test]
    fn the_integral_over_a_polygon_is_that_of_its_points() {
        let plain = StretchedFace { middle: DVec2::ZERO, short: DVec2::X, size: DVec2::ONE };
        let oval = StretchedFace {
            middle: DVec2::new(0.1, -0.2),
            short: DVec2::from_angle(0.7),
            size: DVec2::new(1.1, 1.7),
        };
        let corners =
            [(-0.31, -0.22), (0.44, -0.4), (0.61, 0.37), (-0.1, 0.5)].map(|(x, y)| DVec2::new(x, y));
        for face in [plain, oval] {
            for shift in [DVec2::ZERO, DVec2::new(0.8, 0.3), DVec2::new(-0.5, 1.2)] {
                let corners = corners.map(|p| p + shift);
                let (whole, n) = (area(&corners), 400);
                let places = (0..n * n)
                    .map(|k| DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n));
                let sum: f64 = places
                    .map(|place| (2.0 * face.at(point_in_polygon(&corners, whole, place)).to_angle()).cos())
                    .sum();
                let (expected, found) =
                    (sum * whole / f64::from(n * n), face.cos_twice(corners.iter().copied()));
                assert!((found - expected).abs() < 1e-4, "{found}, {expected}");
                let reversed = face.cos_twice(corners.iter().rev().copied());
                assert!((found - reversed).abs() < 1e-14, "{found}, {reversed}");
            }
        }
    }
}
