//! A stone for the metal around it: its planes in mm, in its place.

use brillianteer_math::{Affine, Ball, Plane, Polytope, Pose, clip};
use glam::{DQuat, DVec2, DVec3};

/// The gap that is left between metal and stone, in mm, so that no two surfaces are one; less than a pixel.
pub(super) const CLEARANCE_MM: f64 = 0.004;

/// Metal may reach into a stone by this much, in mm: triangles are flat where the surface that they stand for is not.
pub(super) const TOUCHING_MM: f64 = 0.02;

/// Corners of a stone's section that are nearer than this to their neighbours, in mm, are left out: rounding.
const SAME_MM: f64 = 1e-6;

/// A stone that is set: its shape in its own frame (girdle radius 1, +z out of the table), and its size.
#[derive(Debug, Clone, Copy)]
pub struct SetStone<'a> {
    /// The shape.
    pub shape: &'a Polytope,
    /// The girdle diameter, in mm.
    pub diameter_mm: f64,
}

impl SetStone<'_> {
    /// Returns the pose of the stone whose origin lies at a place, its table turned toward where `turn` takes +z.
    pub(super) fn pose(&self, at: DVec3, turn: DQuat) -> Pose {
        Pose { at, turn, scale: 0.5 * self.diameter_mm }
    }

    /// Returns the least and the greatest height of the stone in its own frame, in mm.
    pub(super) fn heights(&self) -> [f64; 2] {
        let (low, high) = self.shape.bounds();
        [low.z, high.z].map(|z| z * 0.5 * self.diameter_mm)
    }

    /// Returns the half of the stone's section in the plane through its axis at an azimuth, in mm: its corners (distance from
    /// the axis, height), counter-clockwise with the axis on the left. Empty where the axis misses the stone.
    pub(super) fn section(&self, azimuth: f64) -> Vec<DVec2> {
        let scale = 0.5 * self.diameter_mm;
        let way = DVec2::from_angle(azimuth);
        let (low, high) = self.shape.bounds();
        let far = 2.0 * scale * low.abs().max(high.abs()).length();
        let mut section =
            vec![DVec2::new(0.0, -far), DVec2::new(far, -far), DVec2::new(far, far), DVec2::new(0.0, far)];
        for plane in self.shape.planes() {
            let gradient = DVec2::new(plane.normal.truncate().dot(way), plane.normal.z);
            let mut kept = vec![];
            clip(&section, Affine::new(plane.offset * scale, -gradient), &mut kept);
            section = kept;
        }
        section.dedup_by(|a, b| a.distance(*b) < SAME_MM);
        section
    }
}

/// A stone in its place in a ring, in mm.
pub(super) struct MountedStone {
    planes: Vec<Plane>,
    ball: Ball,
}

impl MountedStone {
    /// Puts a stone into its place.
    pub fn new(stone: &SetStone, pose: &Pose) -> Self {
        let corners = stone.shape.vertices().iter().map(|&corner| pose.place(corner));
        let radius = corners.map(|corner| corner.distance(pose.at)).fold(0.0, f64::max);
        let planes = stone.shape.planes().map(|plane| plane.placed(pose)).collect();
        Self { planes, ball: Ball { middle: pose.at, radius } }
    }

    /// Returns the depth of a point inside the stone; below 0 outside, where it is not the distance.
    #[cfg(test)]
    pub fn depth(&self, point: DVec3) -> f64 {
        if point.distance_squared(self.ball.middle) > self.ball.radius.powi(2) {
            return f64::NEG_INFINITY;
        }
        -self.planes.iter().map(|plane| plane.distance(point)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the depth of the deepest point of a triangle inside the stone, in mm, within a thousandth of
    /// [`TOUCHING_MM`]; 0 where it is no more than that.
    pub fn depth_of(&self, triangle: [DVec3; 3]) -> f64 {
        let [a, b, c] = triangle;
        let middle = (a + b + c) / 3.0;
        let reach = triangle.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
        if !self.is_near(middle, reach) {
            return 0.0;
        }
        // A point of the triangle is a + u (b - a) + v (c - a); its part below a depth is a polygon of (u, v).
        let lies_deeper = |depth: f64| {
            let mut rest = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
            for plane in &self.planes {
                let gradient = DVec2::new(plane.normal.dot(b - a), plane.normal.dot(c - a));
                let mut kept = vec![];
                clip(&rest, Affine::new(-plane.distance(a) - depth, -gradient), &mut kept);
                rest = kept;
                if rest.is_empty() {
                    return false;
                }
            }
            true
        };
        if !lies_deeper(TOUCHING_MM) {
            return 0.0;
        }
        let (mut low, mut high) = (TOUCHING_MM, 2.0 * self.ball.radius);
        while high - low > 1e-3 * TOUCHING_MM {
            let middle = 0.5 * (low + high);
            if lies_deeper(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// Returns the way that a point can go in a direction before it comes within the clearance of the stone; infinite
    /// where it never does, 0 where it starts there.
    pub fn free_way(&self, from: DVec3, way: DVec3) -> f64 {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for plane in &self.planes {
            let (height, speed) = (plane.distance(from) - CLEARANCE_MM, plane.normal.dot(way));
            if speed < 0.0 {
                enter = enter.max(height / -speed);
            } else if speed > 0.0 {
                leave = leave.min(-height / speed);
            } else if height > 0.0 {
                return f64::INFINITY;
            }
        }
        if enter < leave { enter } else { f64::INFINITY }
    }

    /// Returns whether a ball reaches the ball around the stone.
    pub fn is_near(&self, middle: DVec3, radius: f64) -> bool {
        middle.distance(self.ball.middle) < radius + self.ball.radius + CLEARANCE_MM
    }
}
