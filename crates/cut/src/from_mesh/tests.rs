//! Tests that turn stones into triangles, spoil these, and find the stones again.

use super::super::round_brilliant::{MODERN, RoundBrilliant};
use super::super::{Cut, Family};
use super::*;
use crate::solids::noise;
use brillianteer_math::faceting::{Face, SurfaceKind, facets};
use brillianteer_math::{Pose, Surface, triangulate};
use glam::DQuat;
use proptest::prelude::*;

/// The plane of a facet that is found again may be off by this much, degrees.
const DEGREES: f64 = 0.05;

/// The plane of a girdle's facet may be off by this much, degrees. Girdle facets are so narrow that noise tilts them more:
/// now and then one by 0.06.
const GIRDLE_DEGREES: f64 = 0.08;

/// The distance of a facet that is found again may be off by this much, girdle radii.
const PART: f64 = 1e-3;

/// The damage that is done to the triangles of a stone.
#[derive(Debug, Clone, Copy)]
struct Spoilt {
    /// The most noise that is added to each coordinate, girdle radii.
    noise: f64,
    /// True where each triangle's corners have their own noise.
    apart: bool,
    turn: DQuat,
    scale: f64,
    shift: DVec3,
    seed: u64,
}

fn solid(facets: &[(String, Plane)]) -> Polytope {
    Polytope::from_planes(&facets.iter().map(|(_, plane)| *plane).collect::<Vec<_>>()).unwrap()
}

/// Returns the triangles of a stone in random order. Each has its own corners and begins at any of them.
fn spoil(facets: &[(String, Plane)], how: Spoilt) -> Surface {
    let mesh = triangulate(&solid(facets));
    let mut next = noise(how.seed);
    let mut shaken = |v: DVec3| v + how.noise * DVec3::new(next(), next(), next());
    let shared: Vec<DVec3> = mesh.vertices.iter().map(|&v| shaken(v)).collect();
    let at = |&v: &u32| if how.apart { shaken(mesh.vertices[v as usize]) } else { shared[v as usize] };
    let placed = |v: DVec3| how.turn * v * how.scale + how.shift;
    let vertices: Vec<DVec3> = mesh.triangles.iter().flatten().map(at).map(placed).collect();
    let mut next = noise(how.seed + 1);
    let mut order: Vec<(f64, u32)> = (0..mesh.triangles.len() as u32).map(|t| (next(), t)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let corner = |t: u32, k: u32| 3 * t + (k + t) % 3;
    let triangles = order.iter().map(|&(_, t)| [corner(t, 0), corner(t, 1), corner(t, 2)]).collect();
    Surface::new(vertices, triangles)
}

fn found(surface: &Surface) -> Faceted {
    match facets(surface.mend().unwrap().surface) {
        SurfaceKind::Convex(found) => *found,
        SurfaceKind::Concave(_) => panic!("taken for concave"),
    }
}

fn again(facets: &[(String, Plane)], how: Spoilt, up: Up) -> FromMesh {
    from_mesh(&found(&spoil(facets, how)), up, Evening::default()).unwrap()
}

/// Returns the largest angle between planes of the same name, degrees, and the largest difference of their offsets.
fn worst(facets: &[(String, Plane)], back: &[(String, Plane)]) -> (f64, f64) {
    let names = |list: &[(String, Plane)]| list.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert!(names(facets) == names(back), "{:?}", names(back));
    let off = |((_, a), (_, b)): (&(String, Plane), &(String, Plane))| {
        ((a.normal - b.normal).length().to_degrees(), (a.offset - b.offset).abs())
    };
    facets.iter().zip(back).map(off).fold((0.0, 0.0), |w, d| (w.0.max(d.0), w.1.max(d.1)))
}

const PLAIN: Spoilt =
    Spoilt { noise: 0.0, apart: false, turn: DQuat::IDENTITY, scale: 1.0, shift: DVec3::ZERO, seed: 1 };

fn turns() -> impl Strategy<Value = DQuat> {
    (prop::array::uniform3(-1.0..1.0_f64), 0.0..6.3_f64).prop_map(|(axis, angle)| {
        let axis = DVec3::from_array(axis).try_normalize().unwrap_or(DVec3::X);
        DQuat::from_axis_angle(axis, angle)
    })
}

fn brilliants() -> impl Strategy<Value = RoundBrilliant> {
    let girdle = prop::sample::select(vec![(0.0, 96), (3.0, 16), (3.0, 96), (2.0, 64)]);
    (girdle, 52.0..60.0_f64, prop::sample::select(vec![0.0, 1.5]), 70.0..82.0_f64).prop_map(
        |((girdle_thickness, girdle_facets), table, culet, lower)| RoundBrilliant {
            table,
            girdle_thickness,
            girdle_facets,
            culet,
            lower_half: super::super::LowerHalf::Radial(lower),
            ..MODERN
        },
    )
}

#[test]
fn a_brilliant_without_noise_comes_back_to_the_last_digits() {
    for (girdle_thickness, girdle_facets) in [(0.0, 96), (3.0, 16), (3.0, 96)] {
        let facets =
            RoundBrilliant { girdle_thickness, girdle_facets, culet: 1.0, ..MODERN }.facets().unwrap();
        let shift = DVec3::new(3.0, -2.0, 5.0);
        let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 2.0);
        let back = again(&facets, Spoilt { scale: 7.0, shift, turn, ..PLAIN }, Up::Found);
        let (angle, offset) = worst(&facets, &back.facets);
        assert!(
            angle < 1e-9 && offset < 1e-11 && back.deviation < 1e-11,
            "{angle} {offset} {}",
            back.deviation
        );
        assert_eq!(back.evened.turns, 8);
        let point = back.pose.place(turn * DVec3::new(0.1, 0.2, 0.3) * 7.0 + shift);
        // The turn about the axis may be any of the eight.
        assert!((point.z - 0.3).abs() < 1e-11 && (point.truncate().length_squared() - 0.05).abs() < 1e-11);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn a_brilliant_comes_back_from_noise_splits_turns_scales_shifts_and_shuffles(
        stone in brilliants(),
        turn in turns(),
        apart in any::<bool>(),
        scale in -2.0..3.0_f64,
        shift in prop::array::uniform3(-10.0..10.0_f64),
        seed in 1_u64..10_000,
    ) {
        let facets = stone.facets().unwrap();
        let scale = 10_f64.powf(scale);
        let how = Spoilt { noise: 1e-4, apart, turn, scale, shift: scale * DVec3::from_array(shift), seed };
        let back = again(&facets, how, Up::Found);
        let (angle, offset) = worst(&facets, &back.facets);
        prop_assert!(angle < GIRDLE_DEGREES && offset < PART, "{angle} degrees, {offset}");
        let broad = |list: &[(String, Plane)]| {
            list.iter().filter(|(name, _)| !name.starts_with("girdle")).cloned().collect::<Vec<_>>()
        };
        let (angle, _) = worst(&broad(&facets), &broad(&back.facets));
        prop_assert!(angle < DEGREES, "{angle} degrees");
        prop_assert!(back.deviation > 1e-5 && back.deviation < 1e-3, "{}", back.deviation);
        prop_assert_eq!(back.evened.turns, 8);
    }

    #[test]
    fn a_stone_that_is_uneven_by_more_than_noise_stays_so(lean in 0.1..2.0_f64, turn in turns()) {
        let mut facets = RoundBrilliant { girdle_facets: 16, ..MODERN }.facets().unwrap();
        let bezel = &mut facets[1].1;
        bezel.normal = DQuat::from_rotation_y(-lean.to_radians()) * bezel.normal;
        let back = again(&facets, Spoilt { turn, noise: 1e-6, ..PLAIN }, Up::Found);
        prop_assert_eq!(back.evened.turns, 1);
        let slope = |p: &Plane| p.normal.z.acos().to_degrees();
        let least = back.facets.iter().filter(|(n, _)| n != "table").map(|(_, p)| slope(p));
        let meant = slope(&facets[1].1);
        prop_assert!(least.map(|s| (s - meant).abs()).fold(9.0, f64::min) < 1e-3);
    }
}

#[test]
fn the_comparison_sees_a_facet_that_is_off() {
    let facets = RoundBrilliant { girdle_facets: 16, ..MODERN }.facets().unwrap();
    let mut other = facets.clone();
    other[3].1.normal = DQuat::from_rotation_x(0.06_f64.to_radians()) * other[3].1.normal;
    other[5].1.offset += 2e-3;
    let back = again(&other, PLAIN, Up::Found);
    let sorted = |mut list: Vec<(String, Plane)>| {
        list.sort_by(|a, b| a.0.cmp(&b.0));
        list
    };
    let (names, back): (Vec<_>, Vec<_>) = (sorted(facets), sorted(back.facets));
    let far = |(_, p): &(String, Plane)| {
        !names.iter().any(|(_, q)| {
            (p.normal - q.normal).length().to_degrees() < DEGREES && (p.offset - q.offset).abs() < PART
        })
    };
    assert!(back.iter().filter(|p| far(p)).count() >= 2);
}

#[test]
fn up_may_be_given_and_must_be_a_direction() {
    let facets = RoundBrilliant { girdle_facets: 16, culet: 8.0, ..MODERN }.facets().unwrap();
    let seen = found(&spoil(&facets, PLAIN));
    let down = from_mesh(&seen, Up::Given(DVec3::new(0.0, 0.01, -3.0)), Evening::default()).unwrap();
    let table = down.facets.iter().find(|(name, _)| name == "table").unwrap();
    // Seen from below, the culet is the table, and the table the culet.
    assert!(table.1.offset > 0.7 && down.facets.iter().any(|(name, _)| name == "culet"));
    for bad in [DVec3::ZERO, DVec3::NAN] {
        assert!(matches!(from_mesh(&seen, Up::Given(bad), Evening::default()), Err(FromMeshError::Up(_))));
    }
    let aslant = from_mesh(&seen, Up::Given(DVec3::new(1.0, 0.2, 0.4)), Evening::default()).unwrap();
    assert!(aslant.facets.iter().all(|(name, _)| name != "table"));
}

/// A roof whose two sides lean by 4 degrees is no table, and a stone whose up is given is not tilted toward one of them.
#[test]
fn a_crown_without_a_table_is_not_tilted_toward_one_of_its_facets() {
    let level = |x: f64, y: f64| Plane::new(DVec3::new(x, y, 0.0), 1.0);
    let lean = |azimuth: f64, degrees: f64, offset: f64| {
        Plane::from_slope(f64::to_radians(degrees), azimuth, offset)
    };
    let quarter = |k: f64| k * std::f64::consts::FRAC_PI_2;
    let sides = [level(1.0, 0.0), level(-1.0, 0.0), level(0.0, 1.0), level(0.0, -1.0)];
    let pavilion = [0.0, 1.0, 2.0, 3.0].map(|k| lean(quarter(k), 138.0, 0.8));
    let roof = [lean(0.0, 4.0, 0.3), lean(quarter(2.0), 4.0, 0.3)];
    let name = |(k, plane): (usize, Plane)| (k.to_string(), plane);
    let facets: Vec<_> = sides.into_iter().chain(pavilion).chain(roof).enumerate().map(name).collect();
    let up = |up| again(&facets, PLAIN, up).up;
    assert!(up(Up::Given(DVec3::Z)).distance(DVec3::Z) < 1e-12 && up(Up::Found).distance(DVec3::Z) < 1e-9);
    // With a table of its own the direction that is given need not be exact.
    let table = [name((99, Plane::new(DVec3::Z, 0.25)))];
    let facets: Vec<_> = facets.into_iter().chain(table).collect();
    let aslant = again(&facets, PLAIN, Up::Given(DVec3::new(0.0, 0.05, 1.0))).up;
    assert!(aslant.distance(DVec3::Z) < 1e-9, "{aslant}");
}

/// A stone without a crown and a rose without a pavilion are one shape, so that the file's axes decide and a doubt stays.
#[test]
fn a_stone_that_is_all_pavilion_lies_as_its_file_does_and_leaves_a_doubt() {
    let ring = |slope: f64, offset: f64| {
        (0..8).map(move |k| {
            let azimuth = std::f64::consts::TAU / 8.0 * f64::from(k);
            Plane::from_slope(slope.to_radians(), azimuth, offset)
        })
    };
    let planes = ring(90.0, 1.0).chain(ring(135.0, 0.9)).chain([Plane::new(DVec3::Z, 0.1)]);
    let facets: Vec<_> = planes.enumerate().map(|(k, plane)| (k.to_string(), plane)).collect();
    for (up, custom) in [DVec3::Y, DVec3::Z].into_iter().flat_map(|up| [DVec3::Y, DVec3::Z].map(|c| (up, c)))
    {
        for noise in [0.0, 1e-3] {
            let turn = DQuat::from_rotation_arc(DVec3::Z, up);
            let back = again(&facets, Spoilt { turn, noise, ..PLAIN }, Up::FoundBy(custom));
            assert!(back.up.distance(up) < 0.01 && back.doubt.is_some(), "{up} {custom} {noise}: {back:?}");
        }
    }
}

/// Noise leans the table away from the file's axis. Then another direction, next to the table's normal, fits as well.
/// Facets of a girdle lean at random, so that only their azimuths are symmetric.
#[test]
fn symmetry_counts_the_same_however_a_stone_lies() {
    let lean = [1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0].map(|sign: f64| 0.04 * sign);
    let ring = lean.into_iter().enumerate().flat_map(|(k, lean)| {
        let azimuth = std::f64::consts::TAU / 8.0 * k as f64;
        [(0.6, 0.7), (std::f64::consts::FRAC_PI_2 + lean, 1.0), (2.4, 0.7)]
            .map(|(slope, offset)| Plane::from_slope(slope, azimuth, offset))
    });
    let planes: Vec<Plane> = ring.chain([Plane::new(DVec3::Z, 0.4)]).collect();
    let upright = Polytope::from_planes(&planes).unwrap();
    assert_eq!(upright.facets().len(), planes.len());
    let counted = |turn: DQuat| {
        let polytope = upright.reframed(&Pose::turned(turn));
        let face = |plane| Face { plane, area: 1.0, name: None, error: None, is_bent: false };
        let found = Faceted {
            surface: Surface::new(polytope.vertices().to_vec(), vec![]),
            centre: DVec3::ZERO,
            faces: polytope.planes().map(face).collect(),
            polytope,
            deviation: 0.0,
            tolerance: 1e-6,
            change: None,
            is_uncertain: false,
        };
        aim::evenness(&even::FacetParts::about(&found, DVec3::ZERO), turn * DVec3::Z).even
    };
    for turn in [DQuat::IDENTITY, DQuat::from_rotation_x(1.0), DQuat::from_rotation_y(1.7)] {
        assert!((counted(turn) - 1.0).abs() < 1e-12, "{turn}: {}", counted(turn));
    }
}

#[test]
fn directions_next_to_the_best_are_no_doubt() {
    for (noise, degrees, seed) in [1e-4, 1e-3]
        .into_iter()
        .flat_map(|n| [0.1, 0.5].into_iter().flat_map(move |d| (1..4).map(move |s| (n, d, s))))
    {
        let turn = DQuat::from_rotation_x(f64::to_radians(degrees));
        let how = Spoilt { noise, turn, seed, ..PLAIN };
        let FromMesh { up, doubt, .. } = again(&MODERN.facets().unwrap(), how, Up::Found);
        assert!(up.distance(turn * DVec3::Z) < 0.026, "{how:?}: {up}");
        assert!(doubt.is_none_or(|doubt| doubt.other.distance(up) > 0.026), "{how:?}: {up} {doubt:?}");
    }
}

#[test]
fn a_long_stone_lies_across_and_its_tiers_have_letters_and_numbers() {
    let mut planes = vec![("x".to_owned(), Plane::new(DVec3::Z, 0.3))];
    let mut ring = |slope: f64, near: f64, far: f64| {
        for k in 0..4 {
            let azimuth = f64::from(k) * std::f64::consts::FRAC_PI_2;
            let reach = if k % 2 == 0 { near } else { far };
            let s = slope.to_radians();
            planes.push(("x".to_owned(), Plane::from_slope(s, azimuth, reach * s.sin())));
        }
    };
    ring(40.0, 1.2, 1.7);
    ring(90.0, 1.0, 1.5);
    ring(130.0, 1.0, 1.5);
    let turn = DQuat::from_rotation_z(0.7) * DQuat::from_rotation_x(1.0);
    let back = again(&planes, Spoilt { turn, scale: 4.0, noise: 1e-5, ..PLAIN }, Up::Found);
    let names: Vec<&str> = back.facets.iter().map(|(name, _)| name.as_str()).collect();
    assert!(
        names.contains(&"crown A 1") && names.contains(&"girdle 4") && names.contains(&"pavilion 1 1"),
        "{names:?}"
    );
    let girdle: Vec<&Plane> =
        back.facets.iter().filter(|(n, _)| n.starts_with("girdle")).map(|(_, p)| p).collect();
    assert!((girdle[0].normal - DVec3::X).length() < 1e-9 && (girdle[0].offset - 1.0).abs() < 1e-9);
    assert!((girdle[1].normal - DVec3::Y).length() < 1e-9 && (girdle[1].offset - 1.5).abs() < 1e-3);
    assert_eq!(back.evened.turns, 2);
}

/// Noise of 0.2 % of the radius bends a table, so that its parts are found as facets.
#[test]
fn a_table_that_noise_divides_is_one() {
    let Cut::Family(princess) = &Family::of_key("princess").unwrap().first else { panic!("no family") };
    let facets = princess.facets().unwrap();
    let area = |planes: &[(String, Plane)]| {
        let solid = solid(planes);
        let table = planes.iter().position(|(_, plane)| plane.normal.z > 0.999_9).unwrap();
        let facet = solid.facets().iter().find(|facet| facet.source == table).unwrap();
        solid.facet_area(facet)
    };
    let (mut divided, mut whole, mut told) = (0, 0, 0);
    for seed in 1..=24 {
        let surface = spoil(&facets, Spoilt { noise: 2.5e-3, seed, ..PLAIN }).mend().unwrap().surface;
        let SurfaceKind::Convex(found) = brillianteer_math::faceting::facets(surface) else { continue };
        divided += u32::from(found.faces.iter().filter(|face| face.plane.normal.z > 0.999).count() > 1);
        let made = from_mesh(&found, Up::Given(DVec3::Z), Evening::default()).unwrap();
        let off = area(&made.facets) / (made.pose.scale.powi(2) * area(&facets)) - 1.0;
        whole += u32::from(off.abs() < 0.03);
        told += u32::from(made.table_part.is_some());
        assert!(off.abs() < 0.03 || made.table_part.is_some(), "{seed}: {off}");
    }
    assert!(divided >= 3 && told <= 2, "{divided} were divided, {whole} are whole, {told} are told");
}
