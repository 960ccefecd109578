//! The convex outline of points in the plane, and how wide and long it is between pairs of parallel lines.

use super::polygon;
use glam::DVec2;
use std::f64::consts::TAU;

/// Widths and lengths whose ratio is nearer to 1 than this are equal: a hundred roundings of f32.
const EQUAL: f64 = 1e-5;

/// A turn carries an outline onto itself where no corner comes to lie farther from it than this part of its width: noise
/// of a scan does less, and no eye sees it.
const SAME: f64 = 1e-3;

/// Prime numbers of turns that are looked for. A figure of any other number of turns has one of these as well, up to 16.
const TURNS: [u32; 6] = [2, 3, 5, 7, 11, 13];

/// The convex hull of some points, counter-clockwise (Andrew's monotone chain).
pub fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = vec![];
        for p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter().copied());
    lower.extend(half(&mut points.iter().rev().copied()));
    lower
}

/// How wide and long a convex outline is. It is the same however the outline is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calipers {
    /// The least distance between two parallel lines that hold the outline.
    pub width: f64,
    /// The distance between the two lines square to those that hold it. Where several directions are as narrow, it is
    /// the greatest.
    pub length: f64,
    /// The direction from one line of the width to the other, a unit vector with x > 0, or x = 0 and y = 1. Where several
    /// are as narrow and as long, it is the one nearest to +x.
    pub across: DVec2,
    /// The point about which the outline can be turned onto itself, where there is one; else the middle of the rectangle
    /// between the four lines.
    pub middle: DVec2,
}

impl Calipers {
    /// Measures a convex outline, counter-clockwise, as [`hull`] answers it; `None` where it has no area.
    pub fn of(outline: &[DVec2]) -> Option<Self> {
        let edges = outline.iter().zip(outline.iter().cycle().skip(1));
        let across = edges.filter_map(|(&a, &b)| Some(rightward((b - a).perp().try_normalize()?)));
        let all: Vec<(f64, f64, DVec2)> = across
            .map(|across| (length(extent(outline, across)), length(extent(outline, across.perp())), across))
            .collect();
        let width = all.iter().map(|(width, ..)| *width).fold(f64::INFINITY, f64::min);
        if !(width > 0.0 && width.is_finite()) {
            return None;
        }
        let narrow = || all.iter().filter(|(w, ..)| *w <= width * (1.0 + EQUAL));
        let length = narrow().map(|(_, length, _)| *length).fold(0.0, f64::max);
        let long = narrow().filter(|(_, l, _)| *l >= length * (1.0 - EQUAL));
        // The last of equals, by direction, so that the order of the corners decides nothing.
        let across =
            long.map(|(.., across)| *across).max_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)))?;
        let middle = centre_of_turns(outline, SAME * width).unwrap_or_else(|| {
            let middle = |along: DVec2| {
                let (low, high) = extent(outline, along);
                (low + high) / 2.0 * along
            };
            middle(across) + middle(across.perp())
        });
        Some(Self { width, length, across, middle })
    }
}

/// Of a direction and its opposite, the one with x > 0, or x = 0 and y > 0.
fn rightward(direction: DVec2) -> DVec2 {
    // Rounding must not send an upright direction either way.
    let x = if direction.x.abs() < f64::EPSILON { 0.0 } else { direction.x };
    if x < 0.0 || (x == 0.0 && direction.y < 0.0) { -direction } else { DVec2::new(x, direction.y) }
}

fn extent(outline: &[DVec2], along: DVec2) -> (f64, f64) {
    let reach = outline.iter().map(|p| p.dot(along));
    reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

fn length((low, high): (f64, f64)) -> f64 {
    high - low
}

/// The point about which some part of a whole turn carries the outline onto itself, but for `within`.
fn centre_of_turns(outline: &[DVec2], within: f64) -> Option<DVec2> {
    let centre = polygon::centroid(outline);
    let carried = |turns: u32| {
        let turn = DVec2::from_angle(TAU / f64::from(turns));
        outline.iter().all(|p| is_on(outline, centre + turn.rotate(*p - centre), within))
    };
    TURNS.into_iter().any(carried).then_some(centre)
}

/// Whether a point lies as near as `within` to a convex outline's edge.
fn is_on(outline: &[DVec2], point: DVec2, within: f64) -> bool {
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    let inside = edges.filter_map(|(&a, &b)| Some((b - a).try_normalize()?.perp_dot(point - a)));
    inside.fold(f64::INFINITY, f64::min).abs() <= within
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(points: &[[f64; 2]], angle: f64) -> Vec<DVec2> {
        hull(
            points
                .iter()
                .map(|p| DVec2::from_angle(angle).rotate(DVec2::from(*p)) + DVec2::new(3.0, -2.0))
                .collect(),
        )
    }

    #[test]
    fn a_hull_keeps_the_corners_alone() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.5], [0.0, 1.0], [0.0, 0.0]];
        let hull = hull(points.map(DVec2::from_array).to_vec());
        assert_eq!(hull, [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(DVec2::from_array));
    }

    #[test]
    fn width_and_length_are_the_same_however_an_outline_is_turned() {
        // A rectangle, a kite that is narrowest square to a side, and a regular pentagon.
        let pentagon: Vec<[f64; 2]> =
            (0..5).map(|k| DVec2::from_angle(TAU * f64::from(k) / 5.0).to_array()).collect();
        let side = 36f64.to_radians();
        let shapes: [(&[[f64; 2]], f64, f64); 3] = [
            (&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]], 1.0, 3.0),
            (&[[0.0, 0.0], [4.0, -3.0], [4.0, 0.0], [0.0, 3.0]], 3.0 * 0.8, 0.0),
            (&pentagon, 1.0 + side.cos(), 2.0 * 72f64.to_radians().sin()),
        ];
        for (shape, width, length) in shapes {
            let plain = Calipers::of(&turned(shape, 0.0)).unwrap();
            assert!((plain.width - width).abs() < 1e-12, "{plain:?}");
            assert!(length == 0.0 || (plain.length - length).abs() < 1e-12, "{plain:?}");
            for step in 1..50 {
                let again = Calipers::of(&turned(shape, 0.37 * f64::from(step))).unwrap();
                let off = (again.width - plain.width).abs().max((again.length - plain.length).abs());
                assert!(off < 1e-12, "{step}: {again:?} {plain:?}");
                assert!(again.across.x >= 0.0);
            }
        }
    }

    #[test]
    fn the_middle_is_the_axis_of_what_can_be_turned_and_else_that_of_the_rectangle() {
        let triangle: Vec<[f64; 2]> = [0.5, 120.5, 240.5]
            .map(|degrees: f64| DVec2::from_angle(degrees.to_radians()).to_array())
            .to_vec();
        let middle = Calipers::of(&turned(&triangle, 0.0)).unwrap().middle;
        assert!((middle - DVec2::new(3.0, -2.0)).length() < 1e-12, "{middle}");
        // Half of a circle, whose flat side lies on the axis of what it was cut from.
        let half: Vec<[f64; 2]> =
            (0..=32).map(|k| DVec2::from_angle(TAU / 2.0 * f64::from(k) / 32.0).to_array()).collect();
        let found = Calipers::of(&turned(&half, 0.0)).unwrap();
        assert!((found.middle - DVec2::new(3.0, -1.5)).length() < 1e-12, "{found:?}");
        assert!(
            (found.width - 1.0).abs() < 1e-12 && (found.length - 2.0).abs() < 1e-12 && found.across.y > 0.999
        );
    }

    #[test]
    fn what_has_no_area_has_no_width() {
        for none in [vec![], vec![DVec2::ONE], vec![DVec2::ZERO, DVec2::ONE]] {
            assert_eq!(Calipers::of(&hull(none)), None);
        }
    }
}
