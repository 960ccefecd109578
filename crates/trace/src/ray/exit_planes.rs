//! Finds where light leaves a solid of triangles with few facets, without a search among all its triangles.
//!
//! A facet whose plane has the whole solid behind it, and holds no other facet, is an outer facet. Light inside cannot
//! cross the plane of an outer facet without leaving, and where it crosses the plane it leaves by that facet. So the nearest
//! of these planes, found as in a convex stone, limits how far the light can go. Only the other facets, those beside a cleft for example, can stop it
//! before: they are the inner ones, and are tried one after the other.

use super::search::Search;
use brillianteer_math::{Plane, TriangleMesh};
use glam::DVec3;

/// The most facets of a solid for which trying all planes is quicker than searching the triangles in boxes.
const MOST_FACETS: usize = 192;

/// The most inner facets, for the same reason.
const MOST_INNER: usize = 48;

/// The greatest distance of the normals of two facets that lie in one plane.
const SAME: f64 = 1e-9;

/// The facets of a solid, as light inside meets them.
#[derive(Debug)]
pub(super) struct ExitPlanes {
    /// The place of each outer facet in the solid.
    outer: Vec<u32>,
    planes: Vec<Plane>,
    search: Search,
    inner: Vec<InnerFacet>,
}

/// A facet beyond whose plane a part of the solid lies, or in whose plane another facet lies.
#[derive(Debug)]
struct InnerFacet {
    /// The place of the facet in the solid.
    facet: u32,
    plane: Plane,
    /// For each of its triangles, the planes through the sides, whose normals point out of the triangle and lie in its plane.
    triangles: Vec<[Plane; 3]>,
}

impl InnerFacet {
    /// Makes the facet with triangles that are larger by `slack` on all sides, so that no light passes between neighbours
    /// whatever the rounding.
    fn new(mesh: &TriangleMesh, facet: u32, slack: f64) -> Self {
        let plane = mesh.planes()[facet as usize];
        let sides = |triangle: &[u32; 3]| {
            let corners = triangle.map(|v| mesh.vertices()[v as usize]);
            [0, 1, 2].map(|i| {
                let (from, to) = (corners[i], corners[(i + 1) % 3]);
                let normal = (to - from).cross(plane.normal).normalize_or_zero();
                Plane::new(normal, normal.dot(from) + slack)
            })
        };
        let own = mesh.surface().triangles.iter().zip(mesh.facets()).filter(|(_, of)| **of == facet);
        Self { facet, plane, triangles: own.map(|(triangle, _)| sides(triangle)).collect() }
    }

    /// Returns the distance at which a ray crosses the facet from inside, above `after` and below `before`.
    #[inline]
    fn crossed(&self, point: DVec3, direction: DVec3, [after, before]: [f64; 2]) -> Option<f64> {
        let speed = self.plane.normal.dot(direction);
        let gap = -self.plane.distance(point);
        if !(speed > 0.0 && gap > after * speed && gap < before * speed) {
            return None;
        }
        let distance = gap / speed;
        let end = point + direction * distance;
        let holds = |sides: &[Plane; 3]| sides.iter().all(|side| side.distance(end) <= 0.0);
        self.triangles.iter().any(holds).then_some(distance)
    }
}

impl ExitPlanes {
    /// Sorts the facets of a solid; `None` where it has too many, or where a facet is not flat within `slack`.
    pub fn new(mesh: &TriangleMesh, slack: f64) -> Option<Self> {
        let is_flat = |(triangle, &facet): (&[u32; 3], &u32)| {
            let plane = &mesh.planes()[facet as usize];
            triangle.iter().all(|&v| plane.distance(mesh.vertices()[v as usize]).abs() <= slack)
        };
        let mut triangles = mesh.surface().triangles.iter().zip(mesh.facets());
        if mesh.planes().len() > MOST_FACETS || !triangles.all(is_flat) {
            return None;
        }
        let shares_plane = |own: &Plane| {
            let is_same = |other: &&Plane| {
                own.normal.distance(other.normal) <= SAME && (own.offset - other.offset).abs() <= slack
            };
            mesh.planes().iter().filter(is_same).count() > 1
        };
        let is_inner = |facet: &u32| {
            let plane = &mesh.planes()[*facet as usize];
            mesh.bvh().reaches_beyond(plane, slack) || shares_plane(plane)
        };
        let (inner, outer): (Vec<u32>, Vec<u32>) = (0..mesh.planes().len() as u32).partition(is_inner);
        if inner.len() > MOST_INNER {
            return None;
        }
        let planes: Vec<Plane> = outer.iter().map(|&facet| mesh.planes()[facet as usize]).collect();
        let inner = inner.into_iter().map(|facet| InnerFacet::new(mesh, facet, slack)).collect();
        Some(Self { outer, search: Search::new(&planes), planes, inner })
    }

    /// Returns the facet and the distance, not below 0, at which light inside leaves. Inner facets count from the distance
    /// `behind` on, which is at most 0. `None` where rounding has let the ray slip out.
    pub fn next(&self, (point, direction): (DVec3, DVec3), behind: f64) -> Option<(usize, f64)> {
        let (mut found, mut first) = match self.next_outer(point, direction) {
            Some((facet, distance)) => (Some(facet), distance),
            None => (None, f64::INFINITY),
        };
        for inner in &self.inner {
            if let Some(distance) = inner.crossed(point, direction, [behind, first]) {
                (found, first) = (Some(inner.facet), distance);
            }
        }
        found.map(|facet| (facet as usize, first.max(0.0)))
    }

    /// Returns the outer facet whose plane a ray crosses first, and the distance, not below 0.
    #[inline]
    fn next_outer(&self, point: DVec3, direction: DVec3) -> Option<(u32, f64)> {
        let place = self.search.next(point, direction);
        let plane = self.planes.get(place)?;
        let speed = plane.normal.dot(direction);
        (speed > 0.0).then(|| (self.outer[place], (-plane.distance(point) / speed).max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solids::{Triangles, clasp, extruded, heart, star};
    use brillianteer_math::Surface;
    use glam::DVec2;
    use proptest::prelude::*;

    fn mesh((vertices, triangles): Triangles) -> TriangleMesh {
        TriangleMesh::new(Surface::new(vertices, triangles)).unwrap()
    }

    fn exits(mesh: &TriangleMesh) -> ExitPlanes {
        ExitPlanes::new(mesh, 1e-12).unwrap()
    }

    #[test]
    fn facets_beside_a_cleft_are_inner_ones() {
        let found = exits(&mesh(heart()));
        assert!(!found.inner.is_empty() && !found.outer.is_empty());
        let reach = |plane: &Plane| {
            let (vertices, _) = heart();
            vertices.iter().map(|&v| plane.distance(v)).fold(f64::NEG_INFINITY, f64::max)
        };
        assert!(found.inner.iter().all(|facet| reach(&facet.plane) > 1e-6));
        assert!(found.planes.iter().all(|plane| reach(plane) < 1e-9));
        let square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(DVec2::from);
        let cube = exits(&mesh(extruded(&square, 1.0)));
        assert_eq!((cube.outer.len(), cube.inner.len()), (6, 0));
    }

    #[test]
    fn a_solid_is_left_to_the_boxes_where_a_facet_is_not_flat_or_there_are_many() {
        let (mut vertices, triangles) = heart();
        vertices[0].z += 1e-9;
        assert!(ExitPlanes::new(&mesh((vertices, triangles)), 1e-12).is_none());
        let round: Vec<DVec2> = (0..200).map(|k| DVec2::from_angle(f64::from(k) * 0.0314)).collect();
        assert!(ExitPlanes::new(&mesh(extruded(&round, 1.0)), 1e-12).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, max_global_rejects: 50_000, ..ProptestConfig::default() })]
        #[test]
        fn light_leaves_where_the_first_triangle_is(
            shape in 0..3_usize, at in prop::array::uniform3(-1.0..1.0_f64), way in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            // The ends of a clasp lie in one plane.
            let shapes: [fn() -> Triangles; 3] = [heart, star, || clasp(0.5)];
            let mesh = mesh(shapes[shape]());
            let (point, direction) = (DVec3::from(at), DVec3::from(way).normalize_or(DVec3::X));
            // A point is inside where the first triangle of either side faces along the ray.
            let met = mesh.bvh().nearest(point, direction, 0.0, |_| true);
            let facet = |triangle: u32| mesh.facets()[triangle as usize] as usize;
            let is_inside = met.is_some_and(|hit| mesh.planes()[facet(hit.triangle)].normal.dot(direction) > 0.0);
            prop_assume!(is_inside);
            let (found, distance) = exits(&mesh).next((point, direction), -1e-12).unwrap();
            let hit = met.unwrap();
            prop_assert!((distance - hit.distance).abs() < 1e-9, "{distance} is not {}", hit.distance);
            prop_assert_eq!(found, facet(hit.triangle));
        }
    }
}
