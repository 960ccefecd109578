//! The way of a prong in the plane through the stone's axis: up from its foot, around the girdle and onto the crown.

use super::skin::chords;
use glam::DVec2;

/// A place on the way of a prong's middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Waypoint {
    /// Distance from the stone's axis and height, in mm.
    pub at: DVec2,
    /// The unit direction away from the stone, square to the way.
    pub out: DVec2,
    /// True where the way follows the stone.
    pub is_beside: bool,
    /// The part of the way beside the stone that lies behind this place: 0 on the leg, 1 at the end.
    pub part: f64,
}

/// The longest step along a straight part beside the stone, in mm.
const STEP_MM: f64 = 0.06;

/// The longest step along the leg, in mm.
const LEG_STEP_MM: f64 = 0.3;

/// The least distance between two places, in mm: less than the shortest step of an arc.
const LEAST_STEP_MM: f64 = 1e-4;

/// The greatest angle between two places of an arc, radians.
const ARC_STEP: f64 = 0.12;

/// Returns the way from a foot to its end on the crown, which goes on for `grip` beyond the girdle; `None` where the foot is
/// nearer to the stone than `apart`.
///
/// `section` is half the stone's section, counter-clockwise. The way keeps the distance `apart` from it.
pub(super) fn way(section: &[DVec2], foot: DVec2, apart: f64, grip: f64) -> Option<Vec<Waypoint>> {
    let widest = section.iter().map(|at| at.x).fold(0.0, f64::max);
    let is_widest = |at: &DVec2| at.x > widest - 1e-7 * widest;
    let top = (0..section.len())
        .filter(|&k| is_widest(&section[k]))
        .max_by(|&a, &b| section[a].y.total_cmp(&section[b].y))?;
    let (touched, along) = first_touched(section, foot, apart)?;
    let out = -along.perp();
    let mut way = vec![];
    let end = section[touched] + out * apart;
    let steps = (foot.distance(end) / LEG_STEP_MM).ceil().max(1.0);
    for k in 0..steps as usize {
        way.push(Waypoint { at: foot + (end - foot) * (k as f64 / steps), out, is_beside: false, part: 0.0 });
    }
    follow(section, (touched, top), out, (apart, grip), &mut way);
    // Two places in one would make rows of triangles without area.
    way.dedup_by(|a, b| a.at.distance(b.at) < LEAST_STEP_MM);
    measure(&mut way);
    Some(way)
}

/// Returns the corner that the leg from the foot touches first at the distance `apart`, and the leg's direction.
fn first_touched(section: &[DVec2], foot: DVec2, apart: f64) -> Option<(usize, DVec2)> {
    let leg = |k: usize| {
        let corner = section[k] - foot;
        let distance = corner.length();
        let aside = (distance > apart).then(|| (apart / distance).asin())?;
        let along = DVec2::from_angle(-aside).rotate(corner / distance);
        Some((k, along))
    };
    // Of all legs, the one that leans most outward leaves the whole stone on its left.
    let legs = (0..section.len()).map(leg).collect::<Option<Vec<_>>>()?;
    legs.into_iter().max_by(|(_, a), (_, b)| (-a.to_angle()).total_cmp(&-b.to_angle()))
}

/// Follows the stone's section from a corner on, around the corner `top` at the girdle's upper edge and on by the grip.
fn follow(
    section: &[DVec2],
    (from, top): (usize, usize),
    mut out: DVec2,
    (apart, grip): (f64, f64),
    way: &mut Vec<Waypoint>,
) {
    let count = section.len();
    let (mut k, mut beyond, mut is_beyond) = (from, 0.0, false);
    for _ in 0..count {
        let (corner, next) = (section[k], section[(k + 1) % count]);
        let edge = next - corner;
        let along = edge.normalize_or_zero();
        let turn = out.angle_to(-along.perp());
        let steps = (turn / ARC_STEP).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let out = DVec2::from_angle(turn * step as f64 / steps as f64).rotate(out);
            way.push(Waypoint { at: corner + out * apart, out, is_beside: true, part: 0.0 });
        }
        out = -along.perp();
        is_beyond |= k == top;
        // On the crown's last edge before the axis, the way continues straight, in the air above the table.
        let is_last = next.x < 1e-9;
        let left = if is_beyond { grip - beyond } else { f64::INFINITY };
        let length = if is_last && is_beyond { left } else { edge.length().min(left) };
        let steps = (length / STEP_MM).ceil().max(1.0) as usize;
        for step in 1..=steps {
            let gone = length * step as f64 / steps as f64;
            way.push(Waypoint { at: corner + along * gone + out * apart, out, is_beside: true, part: 0.0 });
        }
        if is_beyond {
            beyond += length;
        }
        if is_beyond && beyond >= grip - 1e-9 {
            return;
        }
        k = (k + 1) % count;
    }
}

/// Computes for each place beside the stone the part of the way that lies behind it.
fn measure(way: &mut [Waypoint]) {
    let (mut length, mut last) = (0.0, None::<DVec2>);
    for at in way.iter_mut().filter(|at| at.is_beside) {
        length += last.map_or(0.0, |last| last.distance(at.at));
        (at.part, last) = (length, Some(at.at));
    }
    way.iter_mut().for_each(|at| at.part /= length.max(f64::MIN_POSITIVE));
}

/// Returns the number of places around a rod.
pub(super) fn around(radius: f64) -> usize {
    chords(radius, std::f64::consts::TAU).max(16)
}
