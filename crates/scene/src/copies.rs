//! Copies of one body beside one another: where each lies, how they are laid out, and how they tumble in time.
//!
//! Lengths are in the body's own unit, girdle radii; times are in seconds. The same numbers always give the same places.

use super::layout::scattered;
use super::movement::Movement;
use brillianteer_math::Pose;
use glam::{DQuat, DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// The most copies that there may be.
pub const MOST_COPIES: usize = 8;

/// The speed at which a copy turns about its own axis of tumbling, radians a second.
const TUMBLING: f64 = 0.7;
/// The speed at which the axis of tumbling itself turns about z, radians a second.
const SWINGING: f64 = 0.31;

/// The clear space between two copies, as a part of their extent.
const CLEAR: f64 = 0.02;

/// The number of places that are tried for each copy before the room is made larger.
const TRIES: u64 = 256;
/// The factor by which the room is made larger when no place was found.
const LARGER: f64 = 1.04;

/// Copies of a body, at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Copies {
    /// The pose of each copy; at least one.
    pub poses: Vec<Pose>,
    /// Half the side of the square in which the copies were laid out. Views are fitted to it, so that nothing shrinks while
    /// a copy is moved. `None` for a body alone, whose own reach counts.
    pub room: Option<f64>,
    /// How the copies move.
    #[serde(default)]
    pub movement: Movement,
}

impl Default for Copies {
    fn default() -> Self {
        Self { poses: vec![Pose::STILL], room: None, movement: Movement::default() }
    }
}

impl Copies {
    /// Scatters `count` copies, 1 to [`MOST_COPIES`], in the plane across the axis, without any two touching.
    ///
    /// `corners` are those of the body, and each copy is turned as the body is. A different `number` gives a
    /// different arrangement. A single copy stays in the middle.
    pub fn scattered(count: usize, corners: &[DVec3], number: u64) -> Self {
        let count = count.clamp(1, MOST_COPIES);
        if count == 1 {
            return Self::default();
        }
        let half = corners.iter().fold(DVec2::ZERO, |half, c| half.max(c.truncate().abs())) * (1.0 + CLEAR);
        let mut room = (half.x * half.y * 4.0 * count as f64).sqrt().max(half.max_element());
        loop {
            if let Some(places) = places(count, half, room, number) {
                let poses = places.into_iter().map(|at| Pose { at: at.extend(0.0), ..Pose::STILL });
                return Self { poses: poses.collect(), room: Some(room), ..Self::default() };
            }
            room *= LARGER;
        }
    }

    /// Returns copies at given places, in a room that holds bodies of these corners there.
    pub fn at(poses: Vec<Pose>, corners: &[DVec3]) -> Self {
        if poses.len() == 1 && poses[0].at == DVec3::ZERO {
            return Self { poses, ..Self::default() };
        }
        let all = poses.iter().flat_map(|pose| corners.iter().map(|c| pose.place(*c).truncate().abs()));
        let room = all.fold(0.0, |room: f64, c| room.max(c.max_element()));
        Self { poses, room: Some(room), ..Self::default() }
    }

    /// Whether there is a single copy, in the place and pose of the body itself.
    pub fn is_one_at_rest(&self) -> bool {
        self.poses == [Pose::STILL] && self.room.is_none()
    }

    /// Returns half the side of the square that a view is fitted to; `alone` is the reach of the body alone.
    pub fn reach(&self, alone: f64) -> f64 {
        self.room.unwrap_or(alone)
    }

    /// Returns the poses of the copies of a body with these corners, at a time in seconds where they tumble, or at rest.
    ///
    /// Copies that would meet lie in layers behind one another, the later ones farther from the eye of the view face up.
    pub fn poses(&self, corners: &[DVec3], tumbling: Option<f64>) -> Vec<Pose> {
        let turned = |(number, pose): (usize, &Pose)| {
            tumbling.map_or(pose.turn, |seconds| tumbled(number, seconds) * pose.turn)
        };
        if let [alone] = &self.poses[..] {
            return vec![Pose { turn: turned((0, alone)), ..*alone }];
        }
        let reach = corners.iter().map(|c| c.length()).fold(0.0, f64::max) * (1.0 + CLEAR);
        let mut placed: Vec<(Pose, [DVec3; 2])> = Vec::with_capacity(self.poses.len());
        for (number, pose) in self.poses.iter().enumerate() {
            let turn = turned((number, pose));
            let around = match tumbling {
                // Holds the body in every orientation.
                Some(_) => [DVec3::splat(-reach), DVec3::splat(reach)],
                None => bounds(turn, corners),
            };
            let mut pose = Pose { turn, ..*pose };
            let meets = |at: DVec3| {
                let apart = |other: &(Pose, [DVec3; 2])| match tumbling {
                    Some(_) => other.0.at.distance(at) >= 2.0 * reach,
                    None => are_apart(around.map(|c| c + at), other.1),
                };
                !placed.iter().all(apart)
            };
            while meets(pose.at) {
                pose.at.z -= 2.0 * reach;
            }
            placed.push((pose, around.map(|c| c + pose.at)));
        }
        placed.into_iter().map(|(pose, _)| pose).collect()
    }
}

/// Returns how far the copy of a number has turned after some seconds: not at all at first, and no two copies alike.
fn tumbled(number: usize, seconds: f64) -> DQuat {
    let way = scattered(number as u64) * std::f64::consts::TAU;
    let axis = DVec3::new(way.cos(), way.sin(), 0.0);
    let speed = TUMBLING * (0.85 + 0.3 * scattered(100 + number as u64));
    DQuat::from_rotation_z(SWINGING * seconds) * DQuat::from_axis_angle(axis, speed * seconds)
}

/// Returns places for rectangles of half these sides within a square; `None` where they are not soon found.
fn places(count: usize, half: DVec2, room: f64, number: u64) -> Option<Vec<DVec2>> {
    let free = DVec2::splat(room) - half;
    let mut places: Vec<DVec2> = Vec::with_capacity(count);
    for k in 0..count as u64 {
        let place = |try_: u64| {
            let seed = (((number * 8 + k) * TRIES) + try_) * 2;
            DVec2::new(2.0 * scattered(seed) - 1.0, 2.0 * scattered(seed + 1) - 1.0) * free
        };
        let fits =
            |at: &DVec2| places.iter().all(|other| ((*at - *other).abs() / (2.0 * half)).max_element() > 1.0);
        places.push((0..TRIES).map(place).find(fits)?);
    }
    Some(places)
}

/// Returns the box around a body of these corners after a turn.
fn bounds(turn: DQuat, corners: &[DVec3]) -> [DVec3; 2] {
    let turned = corners.iter().map(|c| turn * *c);
    turned.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], c| [low.min(c), high.max(c)])
}

fn are_apart(a: [DVec3; 2], b: [DVec3; 2]) -> bool {
    (a[0] - b[1]).max_element() > 0.0 || (b[0] - a[1]).max_element() > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the corners of a brick.
    fn brick() -> Vec<DVec3> {
        let sign = |bit: usize| if bit == 0 { -1.0 } else { 1.0 };
        (0..8).map(|k| DVec3::new(sign(k & 1), 0.3 * sign(k & 2), 0.2 * sign(k & 4))).collect()
    }

    #[test]
    fn any_number_is_scattered_within_the_room_and_nothing_touches() {
        for count in 1..=MOST_COPIES {
            for number in 0..40 {
                let copies = Copies::scattered(count, &brick(), number);
                assert_eq!(copies.poses.len(), count);
                let boxes: Vec<_> =
                    copies.poses.iter().map(|p| bounds(p.turn, &brick()).map(|c| c + p.at)).collect();
                for (k, b) in boxes.iter().enumerate() {
                    let reach = b[0].truncate().abs().max(b[1].truncate().abs()).max_element();
                    assert!(reach <= copies.reach(1.0), "{count} {number}: {reach}");
                    assert!(boxes[..k].iter().all(|other| are_apart(*b, *other)));
                }
                assert_eq!(copies, Copies::scattered(count, &brick(), number));
                assert_eq!(copies.poses(&brick(), None), copies.poses, "none is put behind another");
            }
        }
        assert_ne!(Copies::scattered(4, &brick(), 1), Copies::scattered(4, &brick(), 2));
    }

    #[test]
    fn copies_that_would_meet_lie_behind_one_another_at_every_time() {
        let near = |x: f64| Pose { at: DVec3::new(x, 0.0, 0.0), ..Pose::STILL };
        let copies = Copies::at((0..8).map(|k| near(0.1 * f64::from(k))).collect(), &brick());
        for tumbling in [None, Some(0.0), Some(1.3), Some(77.0)] {
            let poses = copies.poses(&brick(), tumbling);
            let reach = brick()[0].length();
            for (k, pose) in poses.iter().enumerate() {
                assert!(poses[..k].iter().all(|other| other.at.distance(pose.at) > 2.0 * reach));
                assert_eq!(pose.at.truncate(), copies.poses[k].at.truncate());
            }
        }
        let apart = Copies::at(vec![near(0.0), near(2.01)], &brick());
        assert_eq!(apart.poses(&brick(), None), apart.poses);
        assert_ne!(apart.poses(&brick(), Some(0.0)), apart.poses, "they would meet as they tumble");
    }

    #[test]
    fn tumbling_begins_at_rest_and_goes_on_evenly() {
        let copies = Copies::scattered(3, &brick(), 5);
        let turns =
            |seconds| copies.poses(&brick(), Some(seconds)).into_iter().map(|p| p.turn).collect::<Vec<_>>();
        for (now, rest) in turns(0.0).iter().zip(&copies.poses) {
            assert!(now.angle_between(rest.turn) < 1e-7);
        }
        for k in 0..100 {
            let at = f64::from(k) * 0.37;
            let angles: Vec<f64> =
                turns(at).iter().zip(turns(at + 0.01)).map(|(a, b)| a.angle_between(b)).collect();
            assert!(angles.iter().all(|a| (0.002..0.015).contains(a)), "{angles:?}");
            assert!(angles.windows(2).all(|w| w[0] != w[1]), "no two turn alike");
        }
    }
}
