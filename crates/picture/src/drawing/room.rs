//! Room for labels: inside a facet, and beside it at the end of a leader (a line that leads to the facet).

use super::lettering::Frame;
use brillianteer_math::{Affine, area, centroid, clip};
use glam::DVec2;

/// Cost of a leader for each corner of the stone that it passes closely, in units of its length.
const PAST_CORNER: f64 = 30.0;
/// Cost of a leader that runs along the stone's outline instead of outward, in units of its length.
const TANGENT: f64 = 60.0;
/// Distance at which a leader passes a corner closely.
const CLOSE: f64 = 5.0;

/// Finds the places where the middle of a box of this size may stand so that the box lies inside a convex polygon,
/// `clearance` away from its edges. Returns their area and centroid, or `None` if there are none.
///
/// Corners run clockwise on the sheet, whose y axis points down.
pub(crate) fn room_for(corners: &[DVec2], size: DVec2, clearance: f64) -> Option<(f64, DVec2)> {
    let mut room: Vec<DVec2> = corners.to_vec();
    let mut kept = vec![];
    let half = size / 2.0 + clearance;
    for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let inward = -(b - a).perp();
        let needed = inward.abs().dot(half);
        clip(&room, Affine::new(-inward.dot(a) - needed, inward), &mut kept);
        std::mem::swap(&mut room, &mut kept);
    }
    let area = area(&room).abs();
    (area > 0.0).then(|| (area, centroid(&room)))
}

/// The lines, boxes and corners that leaders and their labels must keep clear of.
#[derive(Debug, Clone)]
pub(crate) struct LeaderRoom {
    /// The middle of the view, from which leaders run outward.
    pub middle: DVec2,
    /// Boxes that leaders must not cross: numbers and labels.
    pub taken: Vec<Frame>,
    /// Leaders drawn so far, which others must not cross.
    pub leaders: Vec<(DVec2, DVec2)>,
    /// The stone's corners in sight, which leaders avoid.
    pub corners: Vec<DVec2>,
}

impl LeaderRoom {
    /// Returns the cost of a leader: its length, and more for corners that it passes and for not running outward. Returns
    /// `None` where the leader crosses something or its label, which fills `label`, has no room.
    pub fn cost(&self, from: DVec2, to: DVec2, label: &Frame) -> Option<f64> {
        let crossed = self.taken.iter().any(|frame| crosses_box(from, to, frame) || overlap(frame, label))
            || self.leaders.iter().any(|&(a, b)| crosses(from, to, a, b) || crosses_box(a, b, label))
            || crosses_box(from, to, label);
        if crossed {
            return None;
        }
        let length = from.distance(to);
        let near = |p: &&DVec2| distance_to_line(**p, from, to) < CLOSE;
        let corners = self.corners.iter().filter(near).count() as f64;
        let outward = (from - self.middle).normalize_or_zero();
        let across = 1.0 - outward.dot((to - from) / length.max(f64::MIN_POSITIVE));
        Some(length + PAST_CORNER * corners + TANGENT * across)
    }
}

fn distance_to_line(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = (b - a).dot(p - a) / (b - a).length_squared().max(f64::MIN_POSITIVE);
    p.distance(a.lerp(b, along.clamp(0.0, 1.0)))
}

fn crosses(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

fn crosses_box(a: DVec2, b: DVec2, frame: &Frame) -> bool {
    let Frame { low, high } = *frame;
    let (up, down) = (DVec2::new(low.x, high.y), DVec2::new(high.x, low.y));
    crosses(a, b, low, high) || crosses(a, b, up, down)
}

/// Returns whether two boxes overlap.
pub(crate) fn overlap(a: &Frame, b: &Frame) -> bool {
    a.low.cmplt(b.high).all() && b.low.cmplt(a.high).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square whose corners run clockwise on the sheet, as y points down.
    const SQUARE: [DVec2; 4] =
        [DVec2::new(0.0, 0.0), DVec2::new(0.0, 100.0), DVec2::new(100.0, 100.0), DVec2::new(100.0, 0.0)];
    const CLEARANCE: f64 = 2.5;

    #[test]
    fn a_box_has_the_room_that_its_size_leaves() {
        let (area, middle) = room_for(&SQUARE, DVec2::new(40.0, 20.0), CLEARANCE).unwrap();
        let free = DVec2::splat(100.0 - 2.0 * CLEARANCE) - DVec2::new(40.0, 20.0);
        assert!((area - free.x * free.y).abs() < 1e-9);
        assert!(middle.distance(DVec2::splat(50.0)) < 1e-9);
        assert!(room_for(&SQUARE, DVec2::new(96.0, 1.0), CLEARANCE).is_none());
        assert!(room_for(&SQUARE[..2], DVec2::ONE, CLEARANCE).is_none());
    }

    #[test]
    fn a_line_through_a_box_crosses_it_and_one_beside_it_does_not() {
        let frame = Frame { low: DVec2::ZERO, high: DVec2::new(10.0, 4.0) };
        assert!(crosses_box(DVec2::new(5.0, -3.0), DVec2::new(5.5, 9.0), &frame));
        assert!(crosses_box(DVec2::new(-5.0, 2.0), DVec2::new(5.0, 2.1), &frame));
        assert!(!crosses_box(DVec2::new(-5.0, 5.0), DVec2::new(15.0, 5.0), &frame));
    }

    #[test]
    fn the_distance_to_a_line_ends_at_its_ends() {
        let (a, b) = (DVec2::ZERO, DVec2::new(10.0, 0.0));
        assert_eq!(distance_to_line(DVec2::new(4.0, 3.0), a, b), 3.0);
        assert_eq!(distance_to_line(DVec2::new(13.0, 4.0), a, b), 5.0);
        assert_eq!(distance_to_line(DVec2::new(3.0, 4.0), a, a), 5.0);
    }
}
