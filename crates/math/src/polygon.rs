//! Convex polygons in the plane, as slices of corners, counter-clockwise unless said otherwise.

use super::Affine;
use glam::DVec2;

/// Returns the signed area, positive for counter-clockwise corners.
#[inline]
pub fn area(corners: &[DVec2]) -> f64 {
    let Some((&first, rest)) = corners.split_first() else { return 0.0 };
    // The area is computed relative to one corner, so that a small polygon far from the origin keeps its digits.
    rest.windows(2).map(|w| (w[0] - first).perp_dot(w[1] - first)).sum::<f64>() / 2.0
}

/// A polygon whose area is below this part of the square of its length is a line up to rounding.
const THINNEST: f64 = 1e-13;

/// Returns the centroid of the area. Where the area vanishes, it is the mean of the corners; without corners, the
/// origin.
#[inline]
pub fn centroid(corners: &[DVec2]) -> DVec2 {
    let Some((&first, rest)) = corners.split_first() else { return DVec2::ZERO };
    let (mut moment, mut twice, mut square) = (DVec2::ZERO, 0.0, 0.0_f64);
    for w in rest.windows(2) {
        let (a, b) = (w[0] - first, w[1] - first);
        let cross = a.perp_dot(b);
        moment += (a + b) * cross;
        twice += cross;
        square = square.max(a.length_squared()).max(b.length_squared());
    }
    let mean = corners.iter().sum::<DVec2>() / corners.len() as f64;
    // Below this limit the area is only rounding, and its centroid may lie anywhere.
    let is_area = twice.abs() > f64::MIN_POSITIVE && twice.abs() > THINNEST * square;
    if is_area { first + moment / (3.0 * twice) } else { mean }
}

/// Returns the point of a convex polygon with this area that belongs to a point of the unit square: points that are
/// spread evenly over the square give points that are spread evenly over the polygon.
pub fn point_in_polygon(corners: &[DVec2], area: f64, place: DVec2) -> DVec2 {
    let Some((&first, rest)) = corners.split_first() else { return DVec2::ZERO };
    let mut left = 2.0 * area * place.x;
    let mut point = first;
    for w in rest.windows(2) {
        let (a, b) = (w[0] - first, w[1] - first);
        let twice = a.perp_dot(b);
        if twice > 0.0 {
            // Within the triangle, a line through `first` is chosen by area, then a point on this line by area.
            let part = (left / twice).min(1.0);
            point = first + (a + (b - a) * part) * place.y.sqrt();
        }
        if left <= twice {
            break;
        }
        left -= twice;
    }
    point
}

/// Returns whether `p` lies inside by more than `margin`. A negative margin allows points that far outside.
#[inline]
pub fn contains(corners: &[DVec2], p: DVec2, margin: f64) -> bool {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    corners.len() > 2
        && edges.into_iter().all(|(&a, &b)| (b - a).perp_dot(p - a) >= margin * (b - a).length())
}

/// Writes the part of a convex polygon where `keep` is not negative into `out`, which is emptied first.
#[inline]
pub fn clip(corners: &[DVec2], keep: Affine, out: &mut Vec<DVec2>) {
    out.clear();
    let Some(&last) = corners.last() else { return };
    let (mut a, mut at_a) = (last, keep.at(last));
    for &b in corners {
        let at_b = keep.at(b);
        if (at_a < 0.0) != (at_b < 0.0) {
            out.push(a + (b - a) * (at_a / (at_a - at_b)));
        }
        if at_b >= 0.0 {
            out.push(b);
        }
        (a, at_a) = (b, at_b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evenly_spread_places_give_evenly_spread_points() {
        let corners =
            [DVec2::new(0.0, 0.0), DVec2::new(3.0, 0.0), DVec2::new(4.0, 1.0), DVec2::new(1.0, 2.0)];
        let (whole, n) = (area(&corners), 300);
        let places =
            (0..n * n).map(|k| DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n));
        let points: Vec<DVec2> = places.map(|place| point_in_polygon(&corners, whole, place)).collect();
        assert!(points.iter().all(|&p| contains(&corners, p, -1e-12)));
        let mean = points.iter().sum::<DVec2>() / f64::from(n * n);
        assert!((mean - centroid(&corners)).length() < 1e-4);
        // Each half holds points in proportion to its area.
        for cut in [(DVec2::new(1.0, 0.3), 1.7), (DVec2::new(-0.4, 1.0), 0.2)] {
            let keep = Affine::new(-cut.1, cut.0);
            let mut half = vec![];
            clip(&corners, keep, &mut half);
            let found = points.iter().filter(|&&p| keep.at(p) > 0.0).count() as f64 / f64::from(n * n);
            assert!((found - area(&half) / whole).abs() < 2e-3, "{found}");
        }
    }

    const SQUARE: [DVec2; 4] =
        [DVec2::new(0.0, 0.0), DVec2::new(2.0, 0.0), DVec2::new(2.0, 2.0), DVec2::new(0.0, 2.0)];

    #[test]
    fn a_square_has_its_area_and_centre() {
        assert_eq!(area(&SQUARE), 4.0);
        assert_eq!(centroid(&SQUARE), DVec2::ONE);
        assert_eq!(area(&[]), 0.0);
        assert_eq!(centroid(&SQUARE[..1]), SQUARE[0]);
        // Four corners in one line, but for rounding.
        let line =
            [DVec2::ZERO, DVec2::new(0.3, 0.1), DVec2::new(0.6, 0.2 + 3e-17), DVec2::new(0.3, 0.1 - 2e-17)];
        assert!(centroid(&line).distance(DVec2::new(0.3, 0.1)) < 1e-12, "{}", centroid(&line));
    }

    #[test]
    fn the_two_sides_of_a_cut_make_up_the_whole() {
        let (mut left, mut right) = (vec![], vec![]);
        for k in 0..40 {
            let gradient = DVec2::from_angle(0.37 * f64::from(k));
            let cut = Affine::new(-gradient.dot(DVec2::new(0.7, 1.1)), gradient);
            clip(&SQUARE, cut, &mut left);
            clip(&SQUARE, cut * -1.0, &mut right);
            assert!((area(&left) + area(&right) - 4.0).abs() < 1e-14, "cut {k}");
            assert!(area(&left) > 0.5 && area(&right) > 0.5, "cut {k}");
        }
    }

    #[test]
    fn containment_respects_its_margin() {
        assert!(contains(&SQUARE, DVec2::new(1.0, 0.2), 0.1));
        assert!(!contains(&SQUARE, DVec2::new(1.0, 0.05), 0.1));
        assert!(contains(&SQUARE, DVec2::new(1.0, -0.05), -0.1));
        assert!(!contains(&SQUARE[..2], DVec2::new(1.0, 0.0), -1.0));
    }
}
