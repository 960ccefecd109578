//! Triangles with a normal at each point, for surfaces that reflect: smooth where neighbouring triangles share a
//! point, creased where several points share a place.

use super::Pose;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Triangles over points with normals.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ShadedSurface {
    /// The points. At a crease several points with different normals share one place.
    pub points: Vec<DVec3>,
    /// The corners of each triangle, by their places in `points`, counter-clockwise seen from outside.
    pub corners: Vec<[u32; 3]>,
    /// The outward unit normal at each point; empty where the normals of the triangles serve instead.
    pub normals: Vec<DVec3>,
}

impl ShadedSurface {
    /// Makes a surface of triangles whose normals are smooth except at creases, which are edges where the cosine of
    /// the angle between the two triangles' normals is less than `least_cos`.
    ///
    /// Points in one place become one, and triangles that lose a corner in this way are left out. All coordinates
    /// must be finite.
    pub fn creased(points: &[DVec3], triangles: &[[u32; 3]], least_cos: f64) -> Self {
        let (points, triangles) = welded(points, triangles);
        let areas: Vec<DVec3> =
            triangles.iter().map(|t| area_vector(t.map(|k| points[k as usize]))).collect();
        let mut around = vec![vec![]; points.len()];
        for (number, triangle) in triangles.iter().enumerate() {
            triangle.iter().for_each(|&k| around[k as usize].push(number));
        }
        let mut surface = Self { corners: triangles.clone(), ..Self::default() };
        for (k, fan) in around.iter().enumerate() {
            for group in smooth_groups(fan, &triangles, &areas, least_cos) {
                let sum: DVec3 = group.iter().map(|&t| areas[t]).sum();
                let number = surface.points.len() as u32;
                surface.points.push(points[k]);
                surface.normals.push(sum.try_normalize().unwrap_or(DVec3::Z));
                for t in group {
                    let place = triangles[t].iter().position(|&corner| corner as usize == k);
                    place.into_iter().for_each(|place| surface.corners[t][place] = number);
                }
            }
        }
        surface
    }

    /// Returns the places of a triangle's corners.
    pub fn triangle(&self, number: usize) -> [DVec3; 3] {
        self.corners[number].map(|k| self.points[k as usize])
    }

    /// Returns the enclosed volume. It is meaningful only for a closed surface, and negative for one that is turned
    /// inside out.
    pub fn volume(&self) -> f64 {
        // The volume is measured from one of the surface's own points, so that a surface far from the origin keeps
        // its digits.
        let Some(&apex) = self.points.first() else { return 0.0 };
        let cone = |number| {
            let [a, b, c] = self.triangle(number).map(|v| v - apex);
            a.dot(b.cross(c)) / 6.0
        };
        (0..self.corners.len()).map(cone).sum()
    }

    /// Returns the surface as a pose carries it into the world.
    pub fn placed(&self, pose: &Pose) -> Self {
        Self {
            points: self.points.iter().map(|&point| pose.place(point)).collect(),
            normals: self.normals.iter().map(|&normal| pose.turn * normal).collect(),
            corners: self.corners.clone(),
        }
    }
}

/// Returns the outward normal of a triangle, times its area.
fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a) / 2.0
}

/// Merges points that lie in one place, and leaves out triangles that have two corners in one place.
fn welded(points: &[DVec3], triangles: &[[u32; 3]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut places = BTreeMap::new();
    let mut kept = vec![];
    let mut weld = |k: u32| {
        // Adding 0 turns -0 into 0.
        let point = points[k as usize] + 0.0;
        *places.entry(point.to_array().map(f64::to_bits)).or_insert_with(|| {
            kept.push(point);
            kept.len() as u32 - 1
        })
    };
    let triangles = triangles.iter().map(|t| t.map(&mut weld)).filter(|[a, b, c]| a != b && b != c && c != a);
    let triangles = triangles.collect();
    (kept, triangles)
}

/// Divides the triangles around a point into groups that no crease separates. Triangles without area join no group,
/// because they have no normal and would connect any two groups.
fn smooth_groups(fan: &[usize], triangles: &[[u32; 3]], areas: &[DVec3], least_cos: f64) -> Vec<Vec<usize>> {
    let go_on = |a: usize, b: usize| {
        let shared = triangles[a].iter().filter(|corner| triangles[b].contains(corner)).count();
        let (x, y) = (areas[a], areas[b]);
        shared > 1 && x != DVec3::ZERO && y != DVec3::ZERO && x.dot(y) >= least_cos * x.length() * y.length()
    };
    let mut left = fan.to_vec();
    let mut groups = vec![];
    while let Some(first) = left.pop() {
        let mut group = vec![first];
        let mut next = 0;
        while next < group.len() {
            let from = group[next];
            let (joined, rest) = left.into_iter().partition(|&t| go_on(from, t));
            group.extend::<Vec<usize>>(joined);
            left = rest;
            next += 1;
        }
        groups.push(group);
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a cube of side 2, two triangles a face, with points that are not shared between faces.
    fn cube(least_cos: f64) -> ShadedSurface {
        let (mut points, mut triangles) = (vec![], vec![]);
        for axis in 0..3 {
            for side in [1.0, -1.0] {
                let n = DVec3::AXES[axis] * side;
                let (u, v) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3] * side);
                let first = points.len() as u32;
                points.extend([n - u - v, n + u - v, n + u + v, n - u + v]);
                triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            }
        }
        ShadedSurface::creased(&points, &triangles, least_cos)
    }

    #[test]
    fn a_cube_has_three_normals_at_each_corner_or_one_where_nothing_is_a_crease() {
        let creased = cube(0.5);
        assert_eq!((creased.points.len(), creased.corners.len()), (24, 12));
        assert!(creased.normals.iter().all(|n| n.abs().max_element() == 1.0));
        let smooth = cube(-1.0);
        assert_eq!(smooth.points.len(), 8);
        assert!(smooth.points.iter().zip(&smooth.normals).all(|(p, n)| p.dot(*n) > 1.5));
        assert!((creased.volume() - 8.0).abs() < 1e-12 && (smooth.volume() - 8.0).abs() < 1e-12);
        let pose =
            Pose { at: DVec3::X * 100.0, scale: 2.0, ..Pose::turned(glam::DQuat::from_rotation_x(1.0)) };
        assert!((creased.placed(&pose).volume() - 64.0).abs() < 1e-9);
    }

    #[test]
    fn a_triangle_without_area_joins_no_faces_across_a_crease() {
        // Two faces of a right angle, whose edge is cut once on one side: the sliver lies between them.
        let points = [DVec3::ZERO, DVec3::X * 2.0, DVec3::X, DVec3::Y, DVec3::Z];
        let triangles = [[0, 1, 3], [0, 2, 1], [0, 4, 2], [2, 4, 1]];
        let surface = ShadedSurface::creased(&points, &triangles, 0.5);
        for (number, axis) in [(0, DVec3::Z), (2, DVec3::Y), (3, DVec3::Y)] {
            for corner in surface.corners[number] {
                assert_eq!(surface.normals[corner as usize].abs(), axis, "triangle {number}");
            }
        }
    }

    #[test]
    fn triangles_without_area_are_left_out() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(-0.0, 0.0, -0.0)];
        let surface = ShadedSurface::creased(&points, &[[0, 1, 2], [0, 1, 3]], 0.5);
        assert_eq!((surface.points.len(), surface.corners.len()), (3, 1));
    }
}
