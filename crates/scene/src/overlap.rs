//! Finds stones that overlap.

use super::Instance;
use brillianteer_math::{Ball, Plane, Polytope, PolytopeError, PosedSolid, SolidRef};
use glam::DVec3;

/// Stones that share no more than this part of their size only touch. It is far above the rounding errors of a
/// layout.
const TOUCHING: f64 = 1e-8;

/// Returns the first two stones, by their places in the list, that share some space. Stones that only touch do not overlap.
pub fn overlapping(stones: &[Instance]) -> Option<(usize, usize)> {
    let solids: Vec<PosedSolid> = stones.iter().map(Instance::solid).collect();
    let balls: Vec<Ball> = solids.iter().map(PosedSolid::ball).collect();
    let are_near =
        |i: usize, j: usize| balls[i].middle.distance(balls[j].middle) < balls[i].radius + balls[j].radius;
    let pairs = (0..stones.len()).flat_map(|i| (i + 1..stones.len()).map(move |j| (i, j)));
    let meet = |&(i, j): &(usize, usize)| {
        let (a, b) = (&solids[i], &solids[j]);
        let [from, to] = [i, j].map(|k| balls[k].middle);
        let depth = TOUCHING * (balls[i].radius + balls[j].radius);
        let are_one = || match (planes(a), planes(b)) {
            (Some(a), Some(b)) => share(a.chain(b), from, depth),
            _ => cross(a, b, from) || cross(b, a, to),
        };
        !is_between(a, b, to - from) && are_one()
    };
    pairs.filter(|&(i, j)| are_near(i, j)).find(meet)
}

/// Returns whether a plane square to `line` has `a` behind it and `b` before it, which is so for most pairs of
/// stones.
fn is_between(a: &PosedSolid, b: &PosedSolid, line: DVec3) -> bool {
    let is_line = line != DVec3::ZERO;
    is_line
        && a.vertices().map(|v| v.dot(line)).fold(f64::NEG_INFINITY, f64::max)
            <= b.vertices().map(|v| v.dot(line)).fold(f64::INFINITY, f64::min)
}

/// Returns the planes of a convex solid in its place; `None` for a solid of another kind.
fn planes<'a>(solid: &PosedSolid<'a>) -> Option<impl Iterator<Item = Plane> + use<'a>> {
    let PosedSolid { solid, pose } = *solid;
    let SolidRef::Convex(polytope) = solid else { return None };
    Some(polytope.planes().map(move |plane| plane.placed(&pose)))
}

/// Returns whether some point lies at least `depth` inside all planes of two stones.
///
/// The planes are taken about `middle`, a point within one stone, where the polytope's tolerances are fine. A common
/// part that is too thin to be built counts as none.
fn share(planes: impl Iterator<Item = Plane>, middle: DVec3, depth: f64) -> bool {
    let moved = |p: Plane| Plane::new(p.normal, p.offset - p.normal.dot(middle) - depth);
    let planes: Vec<Plane> = planes.map(moved).collect();
    !matches!(
        Polytope::from_planes(&planes),
        Err(PolytopeError::Empty { .. } | PolytopeError::Degenerate { .. })
    )
}

/// Returns whether an edge of `a`, shrunk a little toward its middle, runs into `b` or begins inside `b`.
fn cross(a: &PosedSolid, b: &PosedSolid, middle: DVec3) -> bool {
    let (Some(mesh_a), Some(mesh_b)) = (a.solid.mesh(), b.solid.mesh()) else { return false };
    // The edges of `a` are carried into the frame of `b`.
    let corner = |v: &DVec3| b.pose.unplace(middle + (a.pose.place(*v) - middle) * (1.0 - TOUCHING));
    let corners: Vec<DVec3> = mesh_a.vertices().iter().map(corner).collect();
    let speed = |triangle: u32, way: DVec3| {
        mesh_b.planes()[mesh_b.facets()[triangle as usize] as usize].normal.dot(way)
    };
    mesh_a.surface().triangles.iter().any(|t| {
        (0..3).any(|i| {
            let [from, to] = [t[i], t[(i + 1) % 3]].map(|v| corners[v as usize]);
            // The first surface on the edge's way lies before the edge's end, or it is hit from inside.
            let hit = mesh_b.bvh().nearest(from, to - from, 0.0, |_| true);
            hit.is_some_and(|hit| hit.distance < 1.0 || speed(hit.triangle, to - from) > 0.0)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::{Pose, TriangleMesh};
    use brillianteer_optics::Material;
    use glam::DQuat;
    use std::sync::Arc;

    /// Returns a cube of side 2, turned and moved.
    fn cube(turn: DQuat, shift: DVec3) -> Instance {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let planes: Vec<_> =
            axes.into_iter().flat_map(|a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)]).collect();
        let cube = Polytope::from_planes(&planes).unwrap();
        let cube = Instance::new(cube, Material::from_index("glass", 1.5).unwrap());
        cube.moved(&Pose { at: shift, turn, ..Pose::STILL })
    }

    fn of(places: &[(DQuat, DVec3)]) -> Option<(usize, usize)> {
        overlapping(&places.iter().map(|&(turn, shift)| cube(turn, shift)).collect::<Vec<_>>())
    }

    #[test]
    fn stones_that_touch_are_apart_and_those_a_little_nearer_are_not() {
        let straight = DQuat::IDENTITY;
        let pair = |shift| of(&[(straight, DVec3::ZERO), (straight, shift)]);
        assert_eq!(pair(DVec3::new(2.0, 0.3, -0.1)), None);
        assert_eq!(pair(DVec3::new(1.999, 0.3, -0.1)), Some((0, 1)));
        assert_eq!(pair(DVec3::ZERO), Some((0, 1)));
        let far = DVec3::new(0.0, 900.0, 0.0);
        assert_eq!(of(&[(straight, DVec3::X * 5.0), (straight, far), (straight, far * 1.001)]), Some((1, 2)));
    }

    #[test]
    fn stones_of_triangles_are_told_apart_like_those_of_planes() {
        let triangles = |stone: Instance| {
            let polytope = &stone.body.stone().unwrap().polytope;
            Instance::new(Arc::new(TriangleMesh::of_polytope(polytope)), stone.material).moved(&stone.pose)
        };
        let turned = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4);
        let pair = |x: f64| {
            let other = cube(turned, DVec3::new(x, x, 0.0));
            let first = triangles(cube(turned, DVec3::ZERO));
            (overlapping(&[first.clone(), other.clone()]), overlapping(&[triangles(other), first]))
        };
        assert_eq!((pair(1.42), pair(1.41)), ((None, None), (Some((0, 1)), Some((0, 1)))));
        let (vertices, all) = crate::solids::clasp(1.0);
        let clasp = TriangleMesh::new(brillianteer_math::Surface::new(vertices, all)).unwrap();
        let clasp = Instance::new(Arc::new(clasp), Material::from_index("glass", 1.5).unwrap());
        // A cube is free in the clasp's gap. In its bar it is not, not even wholly inside it.
        let small = |x: f64, y: f64, scale: f64| {
            cube(DQuat::IDENTITY, DVec3::ZERO).moved(&Pose {
                at: DVec3::new(x, y, 0.0),
                scale,
                ..Pose::STILL
            })
        };
        let of = |stone| overlapping(&[clasp.clone(), stone]);
        assert_eq!(of(small(0.3, 0.0, 0.35)), None);
        assert_eq!(of(small(0.3, 0.1, 0.35)), Some((0, 1)));
        assert_eq!(of(small(-0.75, 0.0, 0.1)), Some((0, 1)));
    }

    #[test]
    fn an_edge_that_points_past_a_face_is_no_overlap_though_balls_and_boxes_meet() {
        let turned = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4);
        let pair = |x: f64| of(&[(turned, DVec3::ZERO), (turned, DVec3::new(x, x, 0.0))]);
        assert_eq!((pair(1.42), pair(1.41)), (None, Some((0, 1))));
        // Two edges that cross: no face separates the two.
        let roof = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_4);
        let floor = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_4);
        let pair = |z: f64| of(&[(roof, DVec3::ZERO), (floor, DVec3::new(0.1, 0.2, z))]);
        assert_eq!((pair(2.83), pair(2.82)), (None, Some((0, 1))));
    }
}
