//! Facets of known surfaces, with noise and without.

mod meant;

use super::*;
use crate::Pose;
use crate::mending::tests::{cube, shaken, split, stone, surface};
use crate::solids::noise;
use glam::DQuat;
use proptest::prelude::*;

fn faceted(surface: Surface) -> Faceted {
    match facets(surface) {
        SurfaceKind::Convex(found) => *found,
        SurfaceKind::Concave(_) => panic!("taken for concave"),
    }
}

#[test]
fn a_cavity_faces_its_inside_and_two_stones_face_outward() {
    let outer = surface(&cube());
    let mut inner = surface(&cube());
    inner.vertices.iter_mut().for_each(|v| *v *= 0.5);
    let mut nested = outer.clone();
    nested.append(inner.clone());
    let mended = nested.mend().unwrap();
    assert_eq!(mended.mending.shells, 2);
    assert!((mended.surface.volume() - 7.0).abs() < 1e-12);
    assert!(matches!(facets(mended.surface), SurfaceKind::Concave(_)));
    inner.vertices.iter_mut().for_each(|v| *v += 3.0 * DVec3::X);
    inner.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let mut beside = outer;
    beside.append(inner);
    assert!((beside.mend().unwrap().surface.volume() - 9.0).abs() < 1e-12);
}

#[test]
fn a_dent_is_concave_and_a_dent_within_the_noise_is_not() {
    let dented = |depth: f64| {
        let mut dented = surface(&cube());
        let [a, b, c] = dented.triangles[0];
        let normal = dented.area_vector(0).normalize_or_zero();
        let middle = dented.corners(0).iter().sum::<DVec3>() / 3.0 - depth * normal;
        let new = dented.vertices.len() as u32;
        dented.vertices.push(middle);
        dented.triangles[0] = [a, b, new];
        dented.triangles.extend([[b, c, new], [c, a, new]]);
        dented.groups.extend([dented.groups[0]; 2]);
        facets(dented.mend().unwrap().surface)
    };
    assert!(matches!(dented(0.02), SurfaceKind::Concave(_)));
    let SurfaceKind::Convex(found) = dented(5e-4) else { panic!("noise was taken for a dent") };
    assert!(found.faces.len() == 6 && found.deviation > 1e-4 && found.deviation < 6e-4);
}

#[test]
fn a_ball_is_round_and_not_cut_into_facets() {
    let (rings, sides) = (60_u32, 120_u32);
    let at = |i: u32, k: u32| {
        let (s, c) = (f64::from(i) / f64::from(rings) * std::f64::consts::PI).sin_cos();
        let turn = f64::from(k) / f64::from(sides) * std::f64::consts::TAU;
        DVec3::new(s * turn.cos(), s * turn.sin(), c)
    };
    let vertices = (0..=rings).flat_map(|i| (0..sides).map(move |k| at(i, k))).collect();
    let cell = |i: u32, k: u32| {
        let (a, b) = (i * sides + k, i * sides + (k + 1) % sides);
        [[a, a + sides, b + sides], [a, b + sides, b]]
    };
    let triangles = (0..rings).flat_map(|i| (0..sides).flat_map(move |k| cell(i, k))).collect();
    let ball = Surface::new(vertices, triangles).mend().unwrap().surface;
    assert!((ball.volume() / (4.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 0.01);
    assert!(matches!(facets(ball), SurfaceKind::Concave(_)));
}

/// A ball of about so many corners, or a ball with a dimple.
fn round(count: u32, dimple: f64) -> Surface {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let at = |k: u32| {
        let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
        let (sin, cos) = (golden * f64::from(k)).sin_cos();
        DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
    };
    let ball: Vec<DVec3> = (0..count).map(at).collect();
    let triangles = crate::convex_hull(&ball).unwrap();
    let reach = |v: &DVec3| *v * (1.0 - dimple * (-8.0 * v.distance_squared(DVec3::X)).exp());
    Surface::new(ball.iter().map(reach).collect(), triangles)
}

#[test]
fn what_has_no_facets_is_curved_or_concave_or_has_noise_that_may_hide_them() {
    for (dimple, noise, why) in [
        (0.0, 0.0, Unfaceted::Curved),
        (0.0, 4e-3, Unfaceted::Noisy),
        (0.5, 0.0, Unfaceted::Concave),
        (0.5, 2e-3, Unfaceted::Concave),
    ] {
        let surface = shaken(&round(3000, dimple), noise, 7).mend().unwrap().surface;
        let SurfaceKind::Concave(surface) = facets(surface) else { panic!("{dimple} {noise}: facets") };
        assert_eq!(Unfaceted::of(&surface), why, "{dimple} {noise}");
    }
}

/// Corners spread over a stone by directions, without regard to its edges, and triangles between them; `step` is that of rounding.
fn spread_over(stone: &crate::Polytope, count: u32, step: f64) -> Surface {
    let ball = round(count, 0.0);
    let reach = |d: &DVec3| {
        let far = stone.planes().map(|p| p.offset / p.normal.dot(*d)).filter(|far| *far > 0.0);
        let at = *d * far.fold(f64::INFINITY, f64::min);
        if step > 0.0 { (at / step).round() * step } else { at.as_vec3().as_dvec3() }
    };
    Surface::new(ball.vertices.iter().map(reach).collect(), ball.triangles)
}

#[test]
fn triangles_across_the_edges_of_a_mesh_without_noise_make_no_facets_in_silence() {
    let cases =
        [(6, 3000, 0.0), (8, 8000, 0.0), (8, 8000, 1e-5), (11, 12_000, 1e-6), (12, 300, 0.0), (12, 900, 0.0)];
    for (sides, count, step) in cases {
        let original = stone(sides);
        let spread = spread_over(&original, count, step).mend().unwrap().surface;
        // Any other mesh of such corners is told: as triangles, or as uncertain.
        if let SurfaceKind::Convex(found) = facets(spread)
            && !found.is_uncertain
        {
            let volume = found.polytope.volume() / original.volume() - 1.0;
            let count_found = found.faces.len();
            assert_eq!(count_found, original.facets().len(), "{sides} sides, {count} corners, step {step}");
            assert!(volume.abs() < 1e-4, "{sides} sides, {count} corners: {volume}");
        }
    }
}

#[test]
fn groups_that_are_facets_lend_them_their_names() {
    let found = faceted(surface(&stone(6)).mend().unwrap().surface);
    let polytope = stone(6);
    for face in &found.faces {
        let name = face.name.as_deref().unwrap();
        let number: usize = name.strip_prefix("facet ").unwrap().parse().unwrap();
        assert!((polytope.facets()[number].plane.normal - face.plane.normal).length() < 1e-12);
    }
    let mut two = surface(&stone(6));
    two.groups.iter_mut().for_each(|g| *g /= 2);
    assert!(faceted(two.mend().unwrap().surface).faces.iter().any(|f| f.name.is_none()));
}

#[test]
fn facets_of_a_hull_have_the_names_of_the_groups_that_lie_on_them() {
    let polytope = stone(6);
    let mut dented = surface(&polytope);
    // A pit in the largest triangle leaves the triangles around it on their facet, in a group of its own.
    let t = (0..dented.triangles.len())
        .max_by(|&a, &b| dented.area_vector(a).length().total_cmp(&dented.area_vector(b).length()))
        .unwrap();
    let (corners, place) = (dented.corners(t), dented.vertices.len() as u32);
    let middle = corners.iter().sum::<DVec3>() / 3.0;
    dented.vertices.extend(corners.map(|corner| middle + 0.5 * (corner - middle)));
    dented.vertices.push(0.3 * middle);
    let ([a, b, c], [d, e, f, bottom]) = (dented.triangles[t], [0, 1, 2, 3].map(|k| place + k));
    let rim = [[a, b, e], [a, e, d], [b, c, f], [b, f, e], [c, a, d], [c, d, f]];
    let pit = [[d, e, bottom], [e, f, bottom], [f, d, bottom]];
    dented.triangles[t] = rim[0];
    dented.triangles.extend(rim[1..].iter().chain(&pit));
    dented.groups.extend([dented.groups[t]; 5]);
    dented.groups.extend([dented.names.len() as u32; 3]);
    dented.names.push("pit".to_owned());
    let mended = dented.mend().unwrap().surface;
    assert!(matches!(facets(mended.clone()), SurfaceKind::Concave(_)));
    let found = faceted_hull(mended).unwrap();
    assert_eq!(found.faces.len(), polytope.facets().len());
    for face in &found.faces {
        let number: usize = face.name.as_deref().unwrap().strip_prefix("facet ").unwrap().parse().unwrap();
        assert!((polytope.facets()[number].plane.normal - face.plane.normal).length() < 1e-9);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn facets_are_found_whatever_noise_turn_scale_and_place(
        sides in 5_u32..14,
        axis in prop::array::uniform3(-1.0..1.0_f64),
        angle in 0.0..6.0_f64,
        scale in -3.0..3.0_f64,
        by in prop::array::uniform3(-5.0..5.0_f64),
        level in 0_usize..4,
        seed in 1_u64..1000,
    ) {
        let original = stone(sides);
        let level = [0.0, 1e-7, 1e-5, 1e-4][level];
        let scale = 10_f64.powf(scale);
        let axis = (DVec3::from_array(axis) + 2.0 * DVec3::X).normalize_or_zero();
        let turn = DQuat::from_axis_angle(axis, angle);
        let mut seen = shaken(&split(&surface(&original)), level, seed);
        seen.vertices.iter_mut().for_each(|v| *v = turn * *v * scale + scale * DVec3::from_array(by));
        let found = faceted(seen.mend().unwrap().surface);
        prop_assert_eq!(found.faces.len(), original.facets().len());
        prop_assert!(found.deviation <= 3.0 * (level + 1e-9) * scale, "{} {}", found.deviation, scale);
        let moved = original.reframed(&Pose { at: scale * DVec3::from_array(by) - found.centre, turn, scale });
        for facet in moved.facets() {
            let off = |f: &&Face| (f.plane.normal - facet.plane.normal).length();
            let nearest = found.faces.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            prop_assert!(off(&nearest) < 30.0 * level + 1e-9, "{} at {level}", off(&nearest));
            prop_assert!((nearest.plane.offset - facet.plane.offset).abs() < (30.0 * level + 1e-9) * scale);
        }
    }
}
