//! The convex hull of points in space, by Quickhull (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm
//! for Convex Hulls, ACM Trans. Math. Softw. 22, 1996).
//!
//! The test whether a point lies outside a facet is exact (J. R. Shewchuk's predicates, crate `robust`). So the
//! result is closed and convex whatever the points are, even where many lie in one plane or nearly so, like the
//! corners of a cut stone.

use glam::DVec3;
use robust::{Coord3D, orient3d};
use std::collections::HashMap;

/// Returns the triangles of the convex hull, as indices into the points, counter-clockwise seen from outside.
///
/// Points on the hull that it does not need as corners are left out, and of several points in one place only one is
/// used. `None` where all points lie in one plane, or where a coordinate is not finite.
pub fn convex_hull(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    if points.iter().any(|p| !p.is_finite()) {
        return None;
    }
    let mut hull = Hull::simplex(points)?;
    while let Some(face) = hull.open.pop() {
        if let Some(far) = hull.farthest(face) {
            hull.add(face, far);
        }
    }
    Some(hull.faces.into_iter().filter(|face| face.is_left).map(|face| face.corners).collect())
}

/// Returns a measure of the distance of a point outside the plane through three others, which are in
/// counter-clockwise order seen from outside.
///
/// The result is above 0 outside and 0 in the plane; its sign is exact.
fn outside(points: &[DVec3], [a, b, c]: [u32; 3], point: u32) -> f64 {
    let at = |i: u32| {
        let DVec3 { x, y, z } = points[i as usize];
        Coord3D { x, y, z }
    };
    -orient3d(at(a), at(b), at(c), at(point))
}

struct Face {
    corners: [u32; 3],
    /// The face across each edge; edge k runs from corner k to the next.
    across: [u32; 3],
    /// The points outside this face. Each point that is not yet known to lie within the hull is in one such list.
    above: Vec<u32>,
    /// True while this is still a face of the hull.
    is_left: bool,
}

/// The convex hull of some of the points.
struct Hull<'a> {
    points: &'a [DVec3],
    faces: Vec<Face>,
    /// The faces that may have points outside.
    open: Vec<u32>,
}

/// An edge between a face that is visible from a point and one that is not.
struct Rim {
    /// The ends of the edge, in the direction of the visible face.
    ends: [u32; 2],
    /// The face that is not visible.
    beyond: u32,
}

impl<'a> Hull<'a> {
    /// Makes a tetrahedron from four of the points; `None` where all points lie in one plane.
    fn simplex(points: &'a [DVec3]) -> Option<Self> {
        let at = |i: u32| points[i as usize];
        let most = |size: &dyn Fn(u32) -> f64| {
            (0..points.len() as u32).max_by(|&i, &j| size(i).total_cmp(&size(j)).then(j.cmp(&i)))
        };
        let a = most(&|i| at(i).x)?;
        let b = most(&|i| at(i).distance_squared(at(a)))?;
        let c = most(&|i| (at(b) - at(a)).cross(at(i) - at(a)).length_squared())?;
        let d = most(&|i| outside(points, [a, b, c], i).abs())?;
        let corners = match outside(points, [a, b, c], d) {
            0.0 => return None,
            above if above > 0.0 => [a, c, b, d],
            _ => [a, b, c, d],
        };
        let [a, b, c, d] = corners;
        // Face 0 lies opposite the last corner, which the other three faces share.
        let faces =
            [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])];
        let face = |(corners, across)| Face { corners, across, above: vec![], is_left: true };
        let mut hull = Self { points, faces: faces.map(face).into(), open: vec![] };
        hull.share((0..points.len() as u32).collect(), 0);
        Some(hull)
    }

    /// Puts each point that lies outside a face, from face `first` on, into the list of one such face. The other
    /// points lie within the hull.
    fn share(&mut self, points: Vec<u32>, first: usize) {
        for point in points {
            let all = self.points;
            let face = self.faces[first..].iter_mut().find(|face| outside(all, face.corners, point) > 0.0);
            if let Some(face) = face {
                face.above.push(point);
            }
        }
        self.open.extend(
            (first as u32..).zip(&self.faces[first..]).filter(|(_, f)| !f.above.is_empty()).map(|(i, _)| i),
        );
    }

    /// Returns the farthest of the points outside a face; `None` where there is none or the face has been removed.
    fn farthest(&self, face: u32) -> Option<u32> {
        let Face { corners, above, is_left, .. } = &self.faces[face as usize];
        let [a, b, c] = corners.map(|v| self.points[v as usize]);
        let normal = (b - a).cross(c - a);
        let height = |&&i: &&u32| normal.dot(self.points[i as usize] - a);
        let far = above.iter().max_by(|i, j| height(i).total_cmp(&height(j)).then(j.cmp(i)));
        far.copied().filter(|_| *is_left)
    }

    /// Makes a point that lies outside a face a corner of the hull.
    fn add(&mut self, face: u32, point: u32) {
        let (seen, rim) = self.seen(face, point);
        let mut above = vec![];
        for face in seen {
            let face = &mut self.faces[face as usize];
            face.is_left = false;
            above.append(&mut face.above);
        }
        let first = self.faces.len();
        // The rim is one closed line, so exactly one of its edges begins at each of its corners, and one ends there.
        let beginning: HashMap<u32, u32> =
            (first as u32..).zip(&rim).map(|(new, rim)| (rim.ends[0], new)).collect();
        let end: HashMap<u32, u32> =
            (first as u32..).zip(&rim).map(|(new, rim)| (rim.ends[1], new)).collect();
        for (new, Rim { ends: [a, b], beyond }) in (first as u32..).zip(rim) {
            let across = [beyond, beginning[&b], end[&a]];
            self.faces.push(Face { corners: [a, b, point], across, above: vec![], is_left: true });
            let old = &mut self.faces[beyond as usize];
            let side = old.corners.iter().position(|&v| v == b).unwrap_or_default();
            old.across[side] = new;
        }
        self.share(above, first);
    }

    /// Returns the faces that are visible from a point, starting from one of them, and the edges around those faces.
    fn seen(&mut self, face: u32, point: u32) -> (Vec<u32>, Vec<Rim>) {
        let mut seen = vec![face];
        let mut rim = vec![];
        let mut known = HashMap::from([(face, true)]);
        let mut next = 0;
        while next < seen.len() {
            let Face { corners, across, .. } = &self.faces[seen[next] as usize];
            next += 1;
            for (k, &beyond) in across.iter().enumerate() {
                let is_seen = *known.entry(beyond).or_insert_with(|| {
                    let is_seen = outside(self.points, self.faces[beyond as usize].corners, point) > 0.0;
                    if is_seen {
                        seen.push(beyond);
                    }
                    is_seen
                });
                if !is_seen {
                    rim.push(Rim { ends: [corners[k], corners[(k + 1) % 3]], beyond });
                }
            }
        }
        (seen, rim)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Surface;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    /// Fails unless the triangles are closed, and no point lies outside one of them.
    fn is_hull(points: &[DVec3], hull: &[[u32; 3]]) {
        let edges = hull.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let all: BTreeSet<[u32; 2]> = edges.clone().collect();
        assert_eq!(all.len(), 3 * hull.len(), "an edge is there twice");
        assert!(edges.into_iter().all(|[a, b]| all.contains(&[b, a])), "an edge is open");
        let corners: BTreeSet<u32> = hull.iter().flatten().copied().collect();
        assert_eq!(corners.len() + hull.len(), all.len() / 2 + 2, "Euler's relation");
        for &face in hull {
            assert!((0..points.len() as u32).all(|i| outside(points, face, i) <= 0.0));
        }
    }

    #[test]
    fn a_grid_of_points_has_the_hull_of_its_box() {
        let axis = || (0..5).map(f64::from);
        let points: Vec<DVec3> = axis()
            .flat_map(|x| axis().flat_map(move |y| axis().map(move |z| DVec3::new(x, y, z) * 0.1)))
            .collect();
        let hull = convex_hull(&points).unwrap();
        is_hull(&points, &hull);
        let volume = Surface::new(points, hull).volume();
        assert!((volume - 0.064).abs() < 1e-15, "{volume}");
    }

    #[test]
    fn what_is_flat_or_not_finite_has_no_hull() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
        assert_eq!(convex_hull(&square), None);
        assert_eq!(convex_hull(&square[..2]), None);
        assert_eq!(convex_hull(&[]), None);
        let line: Vec<DVec3> = (0..9).map(|k| DVec3::new(0.125, 0.75, 0.25) * f64::from(k)).collect();
        assert_eq!(convex_hull(&line), None);
        assert_eq!(convex_hull(&[square.as_slice(), &[DVec3::splat(f64::NAN)]].concat()), None);
        assert_eq!(convex_hull(&[square.as_slice(), &[DVec3::Z]].concat()).unwrap().len(), 6);
    }

    #[test]
    fn the_hull_of_many_points_on_a_sphere_is_nearly_the_sphere() {
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let count = 20_000;
        let at = |k: i32| {
            let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
            let (sin, cos) = (golden * f64::from(k)).sin_cos();
            DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
        };
        let points: Vec<DVec3> = (0..count).map(at).collect();
        let hull = convex_hull(&points).unwrap();
        assert_eq!(hull.len(), 2 * points.len() - 4);
        let volume = Surface::new(points, hull).volume();
        assert!((volume / (4.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{volume}");
    }

    proptest! {
        #[test]
        fn the_hull_of_any_points_is_closed_and_holds_all(
            // Few steps put many points into one plane, into one line, or onto one another.
            steps in prop::collection::vec(prop::array::uniform3(-2_i32..3), 0..40),
            nudge in prop::collection::vec(prop::array::uniform3(-1.0_f64..1.0), 40),
            noise in prop::sample::select(vec![0.0, 1e-16, 1e-12, 1e-3]),
            scale in prop::sample::select(vec![1.0, 0.1, 1e-50, 1e50]),
        ) {
            let points: Vec<DVec3> = steps
                .iter()
                .zip(&nudge)
                .map(|(s, n)| (DVec3::from_array(s.map(f64::from)) + noise * DVec3::from_array(*n)) * scale)
                .collect();
            if let Some(hull) = convex_hull(&points) {
                is_hull(&points, &hull);
            }
        }
    }
}
