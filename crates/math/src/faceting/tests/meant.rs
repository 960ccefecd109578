//! Tests of surfaces that are not convex but represent a convex solid, and of surfaces that represent themselves.

use super::*;
use crate::convex_hull;
use crate::solids::divided;
use crate::solids::{self, Triangles};

fn mended((vertices, triangles): Triangles) -> Surface {
    Surface::new(vertices, triangles).mend().unwrap().surface
}

/// Makes a stone whose corners below the table are moved by up to `by`, so that no facet of four corners is flat. Each facet
/// is cut into triangles along the diagonal that bends it inward.
fn bent(by: f64) -> Surface {
    let turn = |k: u32| f64::from(k) * std::f64::consts::TAU / 7.0;
    let tier =
        |(slope, distance): (f64, f64)| (0..7).map(move |k| Plane::from_slope(slope, turn(k), distance));
    let tiers = [(0.6, 0.6), (std::f64::consts::FRAC_PI_2, 1.0), (2.4, 0.8)].into_iter().flat_map(tier);
    let planes: Vec<Plane> = tiers.chain([Plane::new(DVec3::Z, 0.3)]).collect();
    let solid = Polytope::from_planes(&planes).unwrap();
    let mut next = noise(3);
    let table = solid.vertices().iter().map(|v| v.z).fold(f64::NEG_INFINITY, f64::max);
    let moved = |v: &DVec3| if v.z > table - 1e-9 { *v } else { *v * (1.0 + by * next()) };
    let vertices: Vec<DVec3> = solid.vertices().iter().map(moved).collect();
    let mut triangles = vec![];
    for facet in solid.facets() {
        let outline = &facet.outline;
        let fan = |first: usize| {
            let at = |k: usize| outline[(first + k) % outline.len()];
            (1..outline.len() - 1).map(|k| [at(0), at(k), at(k + 1)]).collect::<Vec<_>>()
        };
        let content = |fan: &[[u32; 3]]| {
            Surface::new(vertices.clone(), fan.to_vec()).volume_of(0..fan.len(), DVec3::ZERO)
        };
        let fans = (0..outline.len()).map(fan);
        triangles.extend(fans.min_by(|a, b| content(a).total_cmp(&content(b))).unwrap());
    }
    mended((vertices, triangles))
}

fn hull_volume(surface: &Surface) -> f64 {
    Surface::new(surface.vertices.clone(), convex_hull(&surface.vertices).unwrap()).volume()
}

#[test]
fn facets_bent_over_the_wrong_diagonal_mean_the_hull_of_their_corners() {
    let surface = bent(0.06);
    let (volume, hull) = (surface.volume(), hull_volume(&surface));
    assert!(hull > 1.004 * volume, "the fixture is not bent: {}", hull / volume);
    let found = faceted(surface.clone());
    let change = found.change.unwrap();
    assert!((found.polytope.volume() / hull - 1.0).abs() < 1e-3 && found.deviation < 3e-3 * surface.size());
    assert!((change.volume - (found.polytope.volume() / volume - 1.0)).abs() < 1e-12);
    assert!(change.bent >= 7 && change.sharpest > 0.02 && change.sharpest < 0.5);
    // The table of seven corners stays one facet.
    assert!(found.faces.iter().any(|face| face.plane.normal.z > 1.0 - 1e-9));
    // The deepest point is as deep as samples all over the triangles, or deeper by what those miss.
    let planes: Vec<Plane> = found.polytope.planes().collect();
    let depth =
        |p: DVec3| planes.iter().map(|plane| -plane.distance(p - found.centre)).fold(f64::INFINITY, f64::min);
    let sampled = (0..surface.triangles.len())
        .flat_map(|t| {
            let [a, b, c] = surface.corners(t);
            (0..=40).flat_map(move |i| {
                (0..=40 - i)
                    .map(move |j| (a * f64::from(i) + b * f64::from(j) + c * f64::from(40 - i - j)) / 40.0)
            })
        })
        .map(depth)
        .fold(0.0, f64::max);
    assert!(
        change.deepest >= sampled - 1e-9 && change.deepest < sampled + 1e-3,
        "{} {sampled}",
        change.deepest
    );
}

#[test]
fn what_is_bent_too_far_stays_as_it_is_unless_it_is_asked_for() {
    let surface = bent(0.4);
    assert!(hull_volume(&surface) > 1.03 * surface.volume());
    assert!(matches!(facets(surface.clone()), SurfaceKind::Concave(_)));
    let forced = faceted_hull(surface.clone()).unwrap();
    assert!((forced.polytope.volume() / hull_volume(&surface) - 1.0).abs() < 2e-3);
    assert!(forced.change.unwrap().volume > 0.03);
}

#[test]
fn solids_that_are_meant_to_be_concave_stay_so_and_can_be_read_as_their_hulls() {
    for (name, solid) in [("heart", solids::heart()), ("star", solids::star()), ("clasp", solids::clasp(0.5))]
    {
        let surface = mended(solid);
        assert!(matches!(facets(surface.clone()), SurfaceKind::Concave(_)), "{name}");
        let hull = faceted_hull(surface.clone()).unwrap();
        let expected = hull_volume(&surface);
        assert!((hull.polytope.volume() / expected - 1.0).abs() < 5e-3, "{name}");
        assert!(hull.change.unwrap().deepest > 0.05 * surface.size(), "{name}");
    }
}

#[test]
fn what_is_round_cannot_be_read_as_facets() {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let at = |k: i32| {
        let z = 1.0 - (2.0 * f64::from(k) + 1.0) / 6000.0;
        let (sin, cos) = (golden * f64::from(k)).sin_cos();
        DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
    };
    let vertices: Vec<DVec3> = (0..6000).map(at).collect();
    let triangles = convex_hull(&vertices).unwrap();
    let told = faceted_hull(mended((vertices, triangles))).unwrap_err().to_string();
    assert!(told.contains("more than 2500 facets"), "{told}");
}

/// Makes a box whose upper side is a groove along y, of so many strips and this depth.
fn grooved(strips: u32, depth: f64) -> Surface {
    let rows = 12;
    let at = |i: u32, j: u32| {
        let x = 2.0 * f64::from(i) / f64::from(strips) - 1.0;
        DVec3::new(x, 2.0 * f64::from(j) / f64::from(rows) - 1.0, 0.5 - depth * (1.0 - x * x))
    };
    let mut upper = vec![];
    for i in 0..strips {
        for j in 0..rows {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            upper.extend([[a, b, c], [a, c, d]]);
        }
    }
    // Walls down from the rim of the groove, and a flat bottom.
    let rim = (0..strips).map(|i| at(i, 0)).chain((0..rows).map(|j| at(strips, j)));
    let rim = rim.chain((0..strips).map(|i| at(strips - i, rows))).chain((0..rows).map(|j| at(0, rows - j)));
    let rim: Vec<DVec3> = rim.collect();
    let down = |v: DVec3| DVec3::new(v.x, v.y, -0.5);
    for (k, &a) in rim.iter().enumerate() {
        let b = rim[(k + 1) % rim.len()];
        upper.extend([
            [a, down(a), down(b)],
            [a, down(b), b],
            [DVec3::new(0.0, 0.0, -0.5), down(b), down(a)],
        ]);
    }
    let vertices: Vec<DVec3> = upper.iter().flatten().copied().collect();
    let triangles = (0..upper.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    mended((vertices, triangles))
}

#[test]
fn a_groove_deeper_than_modelling_errs_is_no_noise() {
    // Half the diagonal is 1.5, so these depths are a third of a percent to seven percent of it.
    for depth in [0.005, 0.007, 0.02, 0.1] {
        for strips in [6, 16] {
            let surface = grooved(strips, depth);
            assert!(matches!(facets(surface), SurfaceKind::Concave(_)), "{depth} in {strips} strips");
        }
    }
}

#[test]
fn a_scan_whose_noise_bends_it_everywhere_is_the_stone_that_was_scanned() {
    let solid = stone(8);
    let mut whole = surface(&solid);
    for times in 1..=4 {
        whole = divided(&whole);
        let by = [1e-3, 2e-3, 1e-3, 1e-3][times - 1] * whole.size();
        let seen = shaken(&whole, by, 7);
        let found = faceted(seen.mend().unwrap().surface);
        let off = found.polytope.volume() / solid.volume() - 1.0;
        assert!(off.abs() < 1e-3, "{off}");
        assert!(found.faces.len().abs_diff(solid.facets().len()) <= 1, "{} triangles", whole.triangles.len());
    }
}

fn cube_at(x: f64, y: f64, z: f64, half: f64) -> Surface {
    let mut cube = surface(&cube());
    cube.vertices.iter_mut().for_each(|v| *v = *v * half + DVec3::new(x, y, z));
    cube
}

#[test]
fn shells_that_touch_or_overlap_all_face_outward() {
    let sides = [
        (cube_at(2.0, 2.0, 2.0, 1.0), 16.0, "in a corner"),
        (cube_at(2.0, 2.0, 0.0, 1.0), 16.0, "along an edge"),
        (cube_at(0.0, 0.0, -1.5, 0.5), 9.0, "a small one below"),
        (cube_at(0.0, 0.0, 4.0, 3.0), 224.0, "a large one on top"),
        (cube_at(1.0, 0.3, 0.2, 1.0), 16.0, "overlapping"),
        (cube_at(1.5, 1.5, 1.5, 1.6), 8.0 + 8.0 * 1.6_f64.powi(3), "overlapping at a corner"),
        (cube_at(0.2, 0.1, 0.0, 0.5), 7.0, "within"),
        (cube_at(0.0, 0.0, 0.5, 0.5), 7.0, "within, at the wall"),
        (cube_at(0.0, 0.0, 0.0, 3.0), 208.0, "around"),
    ];
    for (other, volume, place) in sides {
        for turned in [false, true] {
            let mut both = surface(&cube());
            let mut other = other.clone();
            if turned {
                other.triangles.iter_mut().for_each(|t| t.swap(0, 1));
            }
            both.append(other);
            let found = both.mend().map(|mended| mended.surface);
            let mesh = crate::TriangleMesh::new(found.unwrap_or_else(|e| panic!("{place}: {e}")));
            let found = mesh.unwrap_or_else(|e| panic!("{place}: {e}")).volume();
            assert!((found - volume).abs() < 1e-9, "{place}: {found}, not {volume}");
        }
    }
}
