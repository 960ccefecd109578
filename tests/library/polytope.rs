//! Tests of solids from half-spaces: closed ones, open ones, and the planes that are at fault.

use crate::common::*;
use brillianteer::math::{Basis, Plane, Polytope, PolytopeError, Pose, Symmetry, area, triangulate};
use glam::{DQuat, DVec2, DVec3};
use proptest::prelude::*;
use std::time::Instant;

fn cube() -> Vec<Plane> {
    [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .flat_map(|a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)])
        .collect()
}

/// Returns points that are spread evenly over the sphere (Fibonacci's lattice).
fn sphere(n: u32) -> impl Iterator<Item = DVec3> {
    (0..n).map(move |i| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(n);
        let azimuth = 2.399_963_229_728_653 * f64::from(i);
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * azimuth.cos(), r * azimuth.sin(), z)
    })
}

#[test]
fn a_cube_is_a_cube_whatever_the_length_of_its_normals() {
    let scaled: Vec<Plane> = (1..)
        .zip(cube())
        .map(|(k, p)| Plane::new(p.normal * f64::from(k), p.offset * f64::from(k)))
        .collect();
    let cube = Polytope::from_planes(&scaled).unwrap();
    assert_eq!((cube.vertices().len(), cube.edge_count(), cube.facets().len()), (8, 12, 6));
    assert!((cube.volume() - 8.0).abs() < 1e-14 && (cube.surface_area() - 24.0).abs() < 1e-13);
    assert!((cube.silhouette_area(DVec3::Z) - 4.0).abs() < 1e-14);
    let diagonal = DVec3::ONE / 3.0_f64.sqrt();
    assert!((cube.silhouette_area(diagonal) - 4.0 * 3.0_f64.sqrt()).abs() < 1e-13);
    assert!((cube.silhouette_area(-diagonal) - cube.silhouette_area(diagonal)).abs() < 1e-13);
    for (i, facet) in cube.facets().iter().enumerate() {
        assert_eq!(facet.source, i);
        assert_eq!(facet.outline.len(), 4);
        assert!(
            facet
                .neighbours
                .iter()
                .all(|&n| cube.facets()[n as usize].plane.normal.dot(facet.plane.normal) == 0.0)
        );
    }
}

#[test]
fn a_solid_far_from_the_origin_keeps_its_volume() {
    let shift = DVec3::new(30.0, -7.0, 100.0);
    let moved: Vec<Plane> =
        cube().iter().map(|p| Plane::new(p.normal, p.offset + p.normal.dot(shift))).collect();
    assert!((Polytope::from_planes(&moved).unwrap().volume() - 8.0).abs() < 1e-9);
}

#[test]
fn half_spaces_that_enclose_nothing_name_the_planes_at_fault() {
    let fails = |planes: &[Plane]| Polytope::from_planes(planes).unwrap_err();
    assert_eq!(fails(&cube()[..3]), PolytopeError::TooFew { given: 3 });
    assert_eq!(fails(&cube()[..5]), PolytopeError::Unbounded { planes: vec![0, 1, 2, 3] });
    let mut bad = cube();
    bad[4].normal = DVec3::ZERO;
    assert_eq!(fails(&bad), PolytopeError::ZeroNormal { plane: 4 });
    bad[4] = Plane::new(DVec3::new(0.0, f64::NAN, 0.0), 1.0);
    assert_eq!(fails(&bad), PolytopeError::NotFinite { plane: 4 });
    bad[4] = Plane::new(DVec3::Z, f64::INFINITY);
    assert_eq!(fails(&bad), PolytopeError::NotFinite { plane: 4 });

    let mut empty = cube();
    empty.push(Plane::new(DVec3::X, -1.5));
    // x <= -1.5 contradicts -x <= 1: the error must name these two planes, whatever others it names.
    let PolytopeError::Empty { planes } = fails(&empty) else { panic!("not empty") };
    assert!(planes.contains(&1) && planes.contains(&6), "{planes:?}");
    let witness: Vec<Plane> = planes.iter().map(|&i| empty[i]).chain(cube()).collect();
    assert!(matches!(fails(&witness), PolytopeError::Empty { .. }));

    let mut flat = cube();
    flat[1].offset = -1.0;
    assert!(matches!(fails(&flat), PolytopeError::Empty { .. }), "a cube of no thickness");
    let halves = [
        Plane::new(DVec3::X, 1.0),
        Plane::new(DVec3::X, 2.0),
        Plane::new(DVec3::Y, 1.0),
        Plane::new(DVec3::Z, 1.0),
    ];
    assert!(matches!(fails(&halves), PolytopeError::Unbounded { .. }));
}

#[test]
fn planes_that_nearly_coincide_become_one_and_idle_ones_are_reported() {
    let mut planes = cube();
    planes.push(Plane::new(DVec3::new(1.0, 1e-9, 0.0), 1.0 + 1e-10));
    planes.push(Plane::new(DVec3::ONE, 10.0));
    // The plane touches the cube along an edge and bounds no area.
    planes.push(Plane::new(DVec3::new(1.0, 1.0, 0.0), 2.0));
    let polytope = Polytope::from_planes(&planes).unwrap();
    assert_eq!(polytope.merged(), [(6, 0)]);
    assert_eq!(polytope.redundant(), [7, 8]);
    assert_eq!(polytope.facets().len(), 6);
    planes[6].offset += 1e-3;
    planes[6].normal.y = 1e-2;
    assert_eq!(Polytope::from_planes(&planes).unwrap().facets().len(), 7, "a true facet stays");
}

#[test]
fn two_thousand_planes_make_a_ball_in_no_more_than_seconds() {
    let planes: Vec<Plane> = sphere(2000).map(|n| Plane::new(n, 1.0)).collect();
    let start = Instant::now();
    let polytope = Polytope::from_planes(&planes).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(polytope.facets().len(), 2000);
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    assert!(polytope.volume() > ball && polytope.volume() < 1.002 * ball, "{}", polytope.volume());
    // The work takes a few hundredths of a second, and longer where other programs occupy the cores.
    assert!(seconds < 60.0, "{seconds} s");
}

#[test]
fn a_brilliant_has_the_corners_that_its_meet_points_make() {
    for girdle in [16_u32, 64, 96, 128] {
        let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), girdle));
        let corners: Vec<DVec3> = stone.polytope.vertices().to_vec();
        // 8 table corners, 8 star tips, 8 lower half tips, the culet, and two rings of the girdle; where a girdle
        // edge does not stand at an upper or lower half's, that one cuts off a corner more.
        assert_eq!(
            corners
                .iter()
                .filter(|v| (v.z - corners.iter().map(|w| w.z).fold(f64::MIN, f64::max)).abs() < 1e-9)
                .count(),
            8
        );
        let near = |a: &DVec3| corners.iter().filter(|b| (**b - *a).length() < 1e-6).count();
        assert!(corners.iter().all(|v| near(v) == 1), "{girdle}: corners lie upon one another");
        for facet in stone.polytope.facets() {
            let worst =
                stone.polytope.corners(facet).map(|c| facet.plane.distance(c).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-12, "{girdle}: a corner lies {worst:e} off its facet");
        }
    }
}

#[test]
fn a_brilliant_is_eightfold_and_a_tilt_leaves_at_most_a_mirror() {
    let polytope = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 96)).polytope;
    let seen =
        |toward: DVec3, fixed: DVec3| Symmetry::of(polytope.planes(), &Basis::FACE_UP.aimed(toward), fixed);
    let face_up = seen(DVec3::Z, DVec3::Z);
    assert_eq!((face_up.turns, face_up.order()), (8, 16));
    assert_eq!(face_up.copies().len(), 16);
    let toward = |azimuth: f64| DVec3::new(0.2 * azimuth.cos(), 0.2 * azimuth.sin(), 0.96_f64.sqrt());
    let mirror = toward(std::f64::consts::FRAC_PI_8);
    assert_eq!(seen(mirror, DVec3::Z).order(), 2);
    assert_eq!(seen(mirror, mirror).order(), 2);
    assert_eq!(seen(toward(0.1), DVec3::Z), Symmetry::NONE);
    let three: Vec<Plane> = (0..3).map(|k| Plane::from_slope(1.0, 2.1 * f64::from(k), 1.0)).collect();
    assert_eq!(
        Symmetry::of(three.into_iter(), &Basis::FACE_UP, DVec3::Z).turns,
        1,
        "2.1 is not a third of a turn"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn a_random_solid_is_closed_and_its_parts_make_up_the_whole(planes in random_planes(), x in -1.0..1.0_f64, y in -1.0..1.0_f64) {
        let polytope = Polytope::from_planes(&planes).unwrap();
        let vertices = polytope.vertices().len();
        prop_assert_eq!(vertices + polytope.facets().len(), polytope.edge_count() + 2);
        let vector_sum: DVec3 = polytope.facets().iter().map(|f| f.plane.normal * polytope.facet_area(f)).sum();
        prop_assert!(vector_sum.length() < 1e-12, "a closed surface faces all ways alike");
        prop_assert!(polytope.vertices().iter().all(|&v| planes.iter().all(|p| p.distance(v) < 1e-9)));
        // The silhouette from anywhere is the area of its shadow, as the hull of projected corners.
        let toward = DVec3::new(x, y, 1.0) / DVec3::new(x, y, 1.0).length();
        let view = Basis::FACE_UP.aimed(toward);
        let shadow = hull(polytope.vertices().iter().map(|&v| view.project(v)).collect());
        prop_assert!((area(&shadow) - polytope.silhouette_area(toward)).abs() < 1e-9);
    }

    #[test]
    fn triangles_cover_every_facet_without_needless_slivers(planes in random_planes()) {
        let polytope = Polytope::from_planes(&planes).unwrap();
        let mesh = triangulate(&polytope);
        prop_assert_eq!(mesh.triangles.len(), 2 * polytope.vertices().len() - 4);
        let mut sums = vec![0.0; polytope.facets().len()];
        let corner = |i: u32| mesh.vertices[i as usize];
        for (triangle, &facet) in mesh.triangles.iter().zip(&mesh.facets) {
            let [a, b, c] = triangle.map(corner);
            let normal = polytope.facets()[facet as usize].plane.normal;
            let size = (b - a).cross(c - a).dot(normal) / 2.0;
            prop_assert!(size > -1e-15, "a triangle shows its back");
            sums[facet as usize] += size;
            // Delaunay: no other corner of the facet lies inside the circle through these three.
            let others = polytope.facets()[facet as usize].outline.iter().filter(|v| !triangle.contains(v));
            for &other in others {
                prop_assert!(!strictly_in_circle([a, b, c, corner(other)], normal));
            }
        }
        for (sum, facet) in sums.iter().zip(polytope.facets()) {
            prop_assert!((sum - polytope.facet_area(facet)).abs() < 1e-12);
        }
    }
}

/// Returns the convex hull, counter-clockwise (Andrew's monotone chain, 1979).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = vec![];
        for p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(p - b) <= 0.0
            {
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

/// Returns whether the fourth point lies well inside the circle through the first three, all in one plane.
fn strictly_in_circle([a, b, c, d]: [DVec3; 4], normal: DVec3) -> bool {
    let view = Basis::FACE_UP.aimed(normal);
    let [a, b, c] = [a, b, c].map(|p| view.project(p - d));
    let lift = |p: DVec2| p.length_squared();
    let det = lift(a) * b.perp_dot(c) - lift(b) * a.perp_dot(c) + lift(c) * a.perp_dot(b);
    det > 1e-9
}

proptest! {
    #[test]
    fn a_solid_that_is_moved_is_the_one_between_its_planes(
        planes in random_planes(),
        scale in 0.1..10.0_f64,
        (x, y, z) in (-9.0..9.0_f64, -9.0..9.0_f64, -9.0..9.0_f64),
    ) {
        let solid = Polytope::from_planes(&planes).unwrap();
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, x, y, z);
        let moved = solid.reframed(&Pose { at: DVec3::new(x, y, z), turn, scale });
        let built = Polytope::from_planes(&moved.planes().collect::<Vec<_>>()).unwrap();
        prop_assert!((moved.volume() - built.volume()).abs() < 1e-7 * built.volume());
        prop_assert!((moved.volume() - solid.volume() * scale.powi(3)).abs() < 1e-9 * moved.volume());
        for facet in moved.facets() {
            prop_assert!((facet.plane.normal.length() - 1.0).abs() < 1e-14);
            prop_assert!(moved.corners(facet).all(|c| facet.plane.distance(c).abs() < 1e-10));
        }
    }
}

#[test]
fn a_facet_that_is_nothing_but_rounding_is_none() {
    let mut planes: Vec<Plane> =
        DVec3::AXES.iter().flat_map(|&a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)]).collect();
    let corner = |depth: f64| Plane::new(DVec3::ONE, 3.0 - depth);
    planes.push(corner(1e-8));
    let cube = Polytope::from_planes(&planes).unwrap();
    assert_eq!((cube.facets().len(), cube.vertices().len(), cube.redundant()), (6, 8, [6].as_slice()));
    // A facet that is large enough for a machine to cut stays.
    planes[6] = corner(1e-3);
    assert_eq!(Polytope::from_planes(&planes).unwrap().facets().len(), 7);
}
