//! The triangles of an opaque body with normals for shading, in boxes by which rays find them.
//!
//! Rays meet the flat triangles, so the outline of a body is that of its triangles. The normals at the corners change
//! only the direction of reflected light.

use super::extent::{bounds, reach};
use super::{Ball, Bvh, Hit, ShadedSurface};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The distance from a ray's start within which it meets nothing, as a part of the surface's size: there, because of
/// rounding, it would meet the surface that it has just left.
const AWAY: f64 = 1e-10;

/// The reason why triangles cannot be traced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ShadedSurfaceError {
    /// The list of triangles is empty.
    #[error("there are no triangles")]
    Empty,
    /// A triangle names a corner that does not exist.
    #[error("triangle {triangle} names corner {corner}, and there are {count}; both are counted from 0")]
    NoCorner {
        /// The triangle, counted from 0.
        triangle: usize,
        /// The corner that the triangle names.
        corner: u32,
        /// The number of corners.
        count: usize,
    },
    /// A coordinate is NaN, or too large to be traced.
    #[error("corner {corner} is at {at}; coordinates must be numbers from -{LARGEST:e} to {LARGEST:e}")]
    NotFinite {
        /// The corner, counted from 0.
        corner: usize,
        /// The coordinates given for it.
        at: DVec3,
    },
    /// The number of normals is neither 0 nor the number of points.
    #[error("there are {normals} normals for {points} points: give one for each, or none")]
    Normals {
        /// The number of normals.
        normals: usize,
        /// The number of points.
        points: usize,
    },
    /// All points lie in one place.
    #[error("all corners are at the same place")]
    NoExtent,
}

/// The largest coordinate that is accepted, so that squares of areas do not overflow.
const LARGEST: f64 = 1e60;

/// The triangles of an opaque body, in a hierarchy of boxes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "ShadedSurface", into = "ShadedSurface")]
pub struct ShadedMesh {
    surface: ShadedSurface,
    bvh: Bvh,
    ball: Ball,
    reach: f64,
    bounds: (DVec3, DVec3),
}

/// The two normals at a point of a surface, of length 1 and on the same side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceNormals {
    /// The normal of the flat triangle.
    pub flat: DVec3,
    /// The normal by which light is reflected, interpolated between the corners.
    pub shading: DVec3,
}

impl ShadedMesh {
    /// Builds the boxes around the triangles of a surface.
    ///
    /// # Errors
    /// Fails where [`ShadedSurface::check`] does.
    pub fn new(surface: ShadedSurface) -> Result<Self, ShadedSurfaceError> {
        surface.check()?;
        let bvh = Bvh::new(&surface.points, &surface.corners);
        let used: Vec<DVec3> =
            surface.corners.iter().flatten().map(|&v| surface.points[v as usize]).collect();
        let (ball, reach, bounds) = (Ball::around(&used), reach(&used), bounds(used.iter().copied()));
        Ok(Self { surface, bvh, ball, reach, bounds })
    }

    /// Returns the triangles.
    pub fn surface(&self) -> &ShadedSurface {
        &self.surface
    }

    /// Returns the boxes around the triangles.
    pub fn bvh(&self) -> &Bvh {
        &self.bvh
    }

    /// Returns a ball around all triangles.
    pub fn ball(&self) -> Ball {
        self.ball
    }

    /// Returns the distance of the farthest corner from the origin.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Returns the smallest box with sides along the axes that holds all triangles, as (least, greatest) coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    /// Returns the first triangle that a ray meets, from either side. Where the ray has just `left` a triangle, that
    /// triangle is passed over, and so are those that contain the ray's start up to rounding.
    pub fn meet(&self, origin: DVec3, direction: DVec3, left: Option<u32>) -> Option<Hit> {
        let away = if left.is_some() { AWAY * self.ball.radius } else { 0.0 };
        self.bvh.nearest(origin, direction, away, |triangle| Some(triangle) != left)
    }

    /// Returns the normal of a triangle, on the side from which its corners run counter-clockwise, and those at its corners, on the same side.
    pub fn corner_normals(&self, triangle: u32) -> (DVec3, [DVec3; 3]) {
        let corners = self.surface.corners[triangle as usize];
        let [a, b, c] = corners.map(|v| self.surface.points[v as usize]);
        let flat = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Z);
        let normal = |v: u32| self.surface.normals.get(v as usize).map_or(flat, |&normal| side(normal, flat));
        (flat, corners.map(normal))
    }

    /// Returns the normals at a point of a triangle, on the side from which its corners run counter-clockwise.
    pub fn normals(&self, triangle: u32, point: DVec3) -> SurfaceNormals {
        let corners = self.surface.corners[triangle as usize];
        let [a, b, c] = corners.map(|v| self.surface.points[v as usize]);
        let (flat, normals) = self.corner_normals(triangle);
        if self.surface.normals.is_empty() {
            return SurfaceNormals { flat, shading: flat };
        }
        // The areas of the three parts around the point, each opposite its corner.
        let share = |p: DVec3, q: DVec3| (p - point).cross(q - point).dot(flat).max(0.0);
        let shares = [share(b, c), share(c, a), share(a, b)];
        let mixed: DVec3 = normals.into_iter().zip(shares).map(|(normal, share)| normal * share).sum();
        SurfaceNormals { flat, shading: mixed.try_normalize().unwrap_or(flat) }
    }

    /// Returns the change of the shading normal from a point of a triangle along a short step in the triangle's plane, to
    /// first order.
    pub fn change_of_normal(&self, triangle: u32, point: DVec3, step: DVec3) -> DVec3 {
        if self.surface.normals.is_empty() {
            return DVec3::ZERO;
        }
        let corners = self.surface.corners[triangle as usize];
        let [a, b, c] = corners.map(|v| self.surface.points[v as usize]);
        let (flat, normals) = self.corner_normals(triangle);
        let share = |p: DVec3, q: DVec3| (p - point).cross(q - point).dot(flat).max(0.0);
        let change = |p: DVec3, q: DVec3| step.cross(p - q).dot(flat);
        let mixed = |shares: [f64; 3]| normals.iter().zip(shares).map(|(n, share)| *n * share).sum::<DVec3>();
        let here = mixed([share(b, c), share(c, a), share(a, b)]);
        let along = mixed([change(b, c), change(c, a), change(a, b)]);
        let Some(normal) = here.try_normalize() else { return DVec3::ZERO };
        (along - normal * along.dot(normal)) / here.length()
    }
}

impl ShadedSurface {
    /// Checks that all triangles can be traced.
    ///
    /// # Errors
    /// The [`ShadedSurfaceError`] names the first fault by its place in the lists.
    pub fn check(&self) -> Result<(), ShadedSurfaceError> {
        let count = self.points.len();
        if self.corners.is_empty() {
            return Err(ShadedSurfaceError::Empty);
        }
        let is_far = |v: &DVec3| v.is_nan() || v.abs().max_element() > LARGEST;
        if let Some(corner) = self.points.iter().position(is_far) {
            return Err(ShadedSurfaceError::NotFinite { corner, at: self.points[corner] });
        }
        for (triangle, corners) in self.corners.iter().enumerate() {
            if let Some(&corner) = corners.iter().find(|&&v| v as usize >= count) {
                return Err(ShadedSurfaceError::NoCorner { triangle, corner, count });
            }
        }
        if !self.normals.is_empty() && self.normals.len() != count {
            return Err(ShadedSurfaceError::Normals { normals: self.normals.len(), points: count });
        }
        let first = self.points[self.corners[0][0] as usize];
        let is_apart = |&v: &u32| self.points[v as usize] != first;
        if self.corners.iter().flatten().any(is_apart) { Ok(()) } else { Err(ShadedSurfaceError::NoExtent) }
    }
}

/// Returns a normal of length 1 on the same side as `of`; the zero vector where it has no length.
fn side(normal: DVec3, of: DVec3) -> DVec3 {
    let normal = normal.normalize_or_zero();
    if normal.dot(of) < 0.0 { -normal } else { normal }
}

impl TryFrom<ShadedSurface> for ShadedMesh {
    type Error = ShadedSurfaceError;

    fn try_from(surface: ShadedSurface) -> Result<Self, ShadedSurfaceError> {
        Self::new(surface)
    }
}

impl From<ShadedMesh> for ShadedSurface {
    fn from(mesh: ShadedMesh) -> Self {
        mesh.surface
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(normals: Vec<DVec3>) -> ShadedMesh {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        ShadedMesh::new(ShadedSurface { points, corners: vec![[0, 1, 2]], normals }).unwrap()
    }

    #[test]
    fn a_triangle_is_met_from_both_sides_and_not_again_by_what_leaves_it() {
        let mesh = triangle(vec![]);
        let (above, below) = (DVec3::new(0.2, 0.3, 1.0), DVec3::new(0.2, 0.3, -1.0));
        for (from, direction) in [(above, DVec3::NEG_Z), (below, DVec3::Z)] {
            assert_eq!(mesh.meet(from, direction, None).map(|hit| hit.distance), Some(1.0));
            assert_eq!(mesh.meet(from, direction, Some(0)), None);
            assert_eq!(mesh.meet(from + DVec3::X, direction, None), None);
        }
    }

    #[test]
    fn shading_normals_are_those_of_the_corners_and_mixed_between_them() {
        let corners = [DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.6, 0.8), DVec3::Z];
        let mesh = triangle(corners.to_vec());
        for (point, normal) in [DVec3::ZERO, DVec3::X, DVec3::Y].into_iter().zip(corners) {
            assert!(mesh.normals(0, point).shading.distance(normal) < 1e-12);
        }
        let middle = mesh.normals(0, DVec3::new(1.0, 1.0, 0.0) / 3.0);
        let sum = corners[0] + corners[1] + corners[2];
        assert!(middle.shading.distance(sum / sum.length()) < 1e-12);
        assert_eq!((middle.flat, triangle(vec![]).normals(0, DVec3::X).shading), (DVec3::Z, DVec3::Z));
        // A normal on the other side, as one-sided files have it, counts as on this one.
        let turned = triangle(corners.map(|n| -n).to_vec());
        assert!(turned.normals(0, DVec3::X).shading.distance(corners[1]) < 1e-12);
    }

    #[test]
    fn the_change_of_a_normal_is_the_difference_of_the_normals_at_both_ends_of_a_step() {
        let corners = [DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.6, 0.8), DVec3::new(-0.28, 0.0, 0.96)];
        let mesh = triangle(corners.to_vec());
        for (point, way) in
            [(DVec3::new(0.3, 0.2, 0.0), DVec3::X), (DVec3::new(0.1, 0.6, 0.0), DVec3::new(0.6, -0.8, 0.0))]
        {
            let step = way * 1e-5;
            let [before, after] = [-0.5, 0.5].map(|part| mesh.normals(0, point + step * part).shading);
            let change = mesh.change_of_normal(0, point, step);
            assert!((after - before).length() > 1e-6);
            assert!(change.distance(after - before) < 1e-10, "{change} {}", after - before);
        }
        assert_eq!(triangle(vec![]).change_of_normal(0, DVec3::X * 0.2, DVec3::X), DVec3::ZERO);
    }

    #[test]
    fn triangles_that_cannot_be_traced_are_refused_with_their_places() {
        let sound = ShadedSurface {
            points: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            corners: vec![[0, 1, 2]],
            normals: vec![],
        };
        assert_eq!(sound.check(), Ok(()));
        let spoilt = |spoil: fn(&mut ShadedSurface)| {
            let mut surface = sound.clone();
            spoil(&mut surface);
            surface.check().unwrap_err()
        };
        assert_eq!(spoilt(|s| s.corners.clear()), ShadedSurfaceError::Empty);
        let beyond = ShadedSurfaceError::NoCorner { triangle: 0, corner: 3, count: 3 };
        assert_eq!(spoilt(|s| s.corners[0][1] = 3), beyond);
        assert!(matches!(
            spoilt(|s| s.points[2].x = f64::NAN),
            ShadedSurfaceError::NotFinite { corner: 2, .. }
        ));
        let normals = ShadedSurfaceError::Normals { normals: 1, points: 3 };
        assert_eq!(spoilt(|s| s.normals = vec![DVec3::Z]), normals);
        assert_eq!(spoilt(|s| s.points = vec![DVec3::ONE; 3]), ShadedSurfaceError::NoExtent);
    }
}
