//! Tests of measures of the pattern that an eye sees, and of scintillation: laws, an independent tracer, and
//! published statements.

use crate::common::*;
use brillianteer::base::{Stopped, unwatched};
use brillianteer::cut::RoundBrilliant;
use brillianteer::math::{Plane, Polytope};
use brillianteer::measure::{
    ContrastMap, EYE_RESOLVES_MM, Interval, LightMeasures, MeasureName, MeasureSettings, PatternMeasures,
    PatternSettings, Scintillation, SquareContrast, rocked_views,
};
use brillianteer::optics::{line, material};
use brillianteer::scene::{Medium, View, elevation_deg};
use brillianteer::trace::{
    beam::{BeamOptions, Beams, trace},
    ray::{Camera, RayOptions, StoneTracer},
};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

const DIAMOND: f64 = 2.4175;

fn settings(unit_mm: f64) -> MeasureSettings {
    let pattern = Some(PatternSettings::usual(unit_mm));
    MeasureSettings { pattern, ..MeasureSettings::usual([2.4075, 2.4512]) }
}

fn traced(stone: &Polytope, index: f64, view: &View, unresolved: f64) -> Beams {
    let options = BeamOptions { unresolved, ..BeamOptions::default() };
    trace(stone, Medium::clear(index), view, &options, &unwatched).unwrap()
}

fn modern() -> Polytope {
    built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 96)).polytope
}

/// A brilliant that is stretched along x.
fn stretched(factor: DVec3) -> Polytope {
    let planes: Vec<Plane> = modern()
        .facets()
        .iter()
        .map(|facet| {
            let normal = facet.plane.normal / factor;
            Plane::new(normal / normal.length(), facet.plane.offset / normal.length())
        })
        .collect();
    Polytope::from_planes(&planes).unwrap()
}

fn pattern(beams: &Beams, stone: &Polytope, unit_mm: f64) -> PatternMeasures {
    LightMeasures::of(beams, stone, &settings(unit_mm), &unwatched).unwrap().pattern.unwrap()
}

fn is_within(inner: Interval, outer: Interval) -> bool {
    inner.least >= outer.least - 1e-12 && inner.most <= outer.most + 1e-12
}

#[test]
fn finer_beams_narrow_every_interval_of_the_pattern_and_never_leave_it() {
    let stone = stretched(DVec3::new(1.0, 1.3, 1.0));
    for view in [View::default(), View { tilt: 0.12, azimuth: 0.2, ..View::default() }] {
        let found = [0.2, 0.05, 0.01].map(|unresolved| {
            let beams = traced(&stone, DIAMOND, &view, unresolved);
            let measures = LightMeasures::of(&beams, &stone, &settings(3.25), &unwatched).unwrap();
            let names = MeasureName::all(&settings(3.25));
            names.into_iter().map(|name| (name, name.of(&measures).unwrap())).collect::<Vec<_>>()
        });
        assert_eq!(found[0].len(), 21);
        for pair in found.windows(2) {
            for ((name, wide), (_, narrow)) in pair[0].iter().zip(&pair[1]) {
                assert!(is_within(*narrow, *wide), "{name}: {narrow:?} is not within {wide:?}");
            }
        }
        let last = found[2].iter().filter(|(_, of)| of.error() > 0.1).count();
        assert_eq!(last, 0, "{:?}", found[2]);
    }
}

#[test]
fn a_contrast_map_covers_the_face_once_and_its_mean_square_is_the_contrast_that_an_eye_sees() {
    let stone = stretched(DVec3::new(1.0, 1.3, 1.0));
    for view in [View::default(), View { tilt: 0.12, azimuth: 0.2, ..View::default() }] {
        let beams = traced(&stone, DIAMOND, &view, 0.01);
        let settings = settings(3.25);
        let of =
            |head_deg| ContrastMap::of(&beams, head_deg, &settings.pattern.unwrap(), &unwatched).unwrap();
        let (map, seen) = (of(settings.head_deg), pattern(&beams, &stone, 3.25).eye_contrast);
        assert_eq!((map.whole, map.unresolved), (seen, beams.unresolved()));
        let [mut area, mut first, mut second, mut bounds] = [0.0; 4];
        for (outline, contrast) in map.parts() {
            let part = brillianteer::math::area(outline);
            let SquareContrast { known, bounds: Interval { least, most } } = contrast;
            assert!(part >= 0.0 && (-1.0..=known).contains(&least) && known <= most, "{contrast:?}");
            area += part;
            first += part * known;
            second += part * known * known;
            bounds += part * (most - least);
        }
        assert!((area / beams.silhouette_area - 1.0).abs() < 1e-9, "{area}");
        // Squares are brighter and darker by the same amount in all; their root mean square is the known contrast.
        let rms = (second / area).sqrt();
        assert!((first / area).abs() < 1e-9, "{first}");
        assert!(seen.least < rms && rms < seen.most && bounds / area < 0.1, "{rms} is not in {seen:?}");
        // A wider head makes another map.
        let other = of(settings.head_deg + 5.0);
        assert!((other.whole.middle() - rms).abs() > 0.02, "{:?}", other.whole);
    }
}

#[test]
fn symmetry_changes_no_pattern() {
    let stone = modern();
    let [with, without] = [true, false].map(|symmetry| {
        let options = BeamOptions { unresolved: 0.01, symmetry, ..BeamOptions::default() };
        let beams = trace(&stone, Medium::clear(DIAMOND), &View::default(), &options, &unwatched).unwrap();
        pattern(&beams, &stone, 3.25)
    });
    let pairs = |of: PatternMeasures| {
        [
            of.eye_contrast,
            of.patch_size,
            of.crushed_ice,
            of.fire_seen,
            of.bow_tie.unwrap(),
            of.fish_eye.unwrap(),
        ]
    };
    for (a, b) in pairs(with).into_iter().zip(pairs(without)) {
        assert!(a.least <= b.most + 1e-9 && b.least <= a.most + 1e-9, "{a:?}, {b:?}");
        assert!((a.middle() - b.middle()).abs() < 0.02, "{a:?}, {b:?}");
    }
}

#[test]
fn a_stone_ten_times_as_large_from_ten_times_as_far_looks_the_same_and_one_that_is_near_shows_more() {
    let stone = modern();
    let beams = traced(&stone, DIAMOND, &View::default(), 0.01);
    let usual = settings(3.25);
    let far = PatternSettings { resolves_mm: 10.0 * EYE_RESOLVES_MM, ..PatternSettings::usual(32.5) };
    let far = LightMeasures::of(
        &beams,
        &stone,
        &MeasureSettings { pattern: Some(far), ..usual.clone() },
        &unwatched,
    )
    .unwrap();
    let near = LightMeasures::of(&beams, &stone, &usual, &unwatched).unwrap();
    let [(a, b), (c, d)] = [(near.pattern, far.pattern), (near.pattern, None)]
        .map(|(a, b)| (a.unwrap(), b.unwrap_or(a.unwrap())));
    for (a, b) in [
        (a.eye_contrast, b.eye_contrast),
        (a.patch_size, b.patch_size),
        (a.crushed_ice, b.crushed_ice),
        (a.fire_seen, b.fire_seen),
    ] {
        assert!(
            (a.middle() - b.middle()).abs() < 1e-9 && (a.error() - b.error()).abs() < 1e-9,
            "{a:?}, {b:?}"
        );
    }
    assert_eq!((c.bow_tie, c.fish_eye), (d.bow_tie, d.fish_eye));
    // A larger stone has its exact contrast and all its fire; a tiny one has neither and is all crushed ice.
    let [tiny, small, usual, large] = [0.02, 1.0, 3.25, 30.0].map(|unit_mm| pattern(&beams, &stone, unit_mm));
    let of = |pick: fn(&PatternMeasures) -> Interval| [tiny, small, usual, large].map(|p| pick(&p).middle());
    for rising in [of(|p| p.eye_contrast), of(|p| p.fire_seen)] {
        assert!(rising.windows(2).all(|pair| pair[0] < pair[1] + 1e-12), "{rising:?}");
    }
    let ice = of(|p| p.crushed_ice);
    assert!(ice.windows(2).all(|pair| pair[0] >= pair[1]), "{ice:?}");
    assert!(ice[0] > 0.99 && ice[2] < 0.6 && ice[3] < 0.01, "{ice:?}");
    assert!(tiny.eye_contrast.most < 0.2 && tiny.fire_seen.least == 0.0, "{tiny:?}");
    assert!(large.eye_contrast.least <= near.contrast.most);
    assert!((large.eye_contrast.middle() - near.contrast.middle()).abs() < 0.02);
    assert!((large.fire_seen.middle() - near.fire.middle()).abs() < 1e-3);
    assert!(
        [small, usual, large].iter().all(|p| is_within(p.fire_seen, Interval { least: 0.0, ..near.fire }))
    );
}

#[test]
fn there_is_no_fire_without_dispersion_and_more_with_a_smaller_pupil() {
    let stone = modern();
    let beams = traced(&stone, DIAMOND, &View::default(), 0.01);
    let fire = |indices: [f64; 2], blur_deg: f64| {
        let settings = MeasureSettings { indices, blur_deg, ..settings(3.25) };
        LightMeasures::of(&beams, &stone, &settings, &unwatched).unwrap().pattern.unwrap().fire_seen.least
    };
    assert_eq!(fire([DIAMOND; 2], 0.76), 0.0);
    let pupils = [3.0, 1.5, 0.76, 0.4].map(|blur| fire([2.4075, 2.4512], blur));
    assert!(pupils.windows(2).all(|pair| pair[0] < pair[1]), "{pupils:?}");
}

#[test]
fn fire_is_that_of_glass_zircon_diamond_and_strontium_titanate_in_this_order() {
    let stone = modern();
    let names = ["BK7", "zircon", "diamond", "strontium titanate"];
    let found = names.map(|name| {
        let material = material(name).unwrap();
        let indices = [line::FRAUNHOFER_B, line::FRAUNHOFER_G].map(|nm| material.index(nm));
        let beams = traced(&stone, material.index(line::SODIUM_D), &View::default(), 0.005);
        let settings = MeasureSettings { indices, ..settings(3.25) };
        (
            indices[1] - indices[0],
            LightMeasures::of(&beams, &stone, &settings, &unwatched).unwrap().pattern.unwrap().fire_seen,
        )
    });
    println!("{found:?}");
    assert!(
        found.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[0].1.most < pair[1].1.least),
        "{found:?}"
    );
}

#[test]
fn a_round_has_no_bow_tie_and_an_oval_the_same_however_it_lies() {
    let view = View::default();
    let of = |stone: &Polytope| pattern(&traced(stone, DIAMOND, &view, 0.01), stone, 3.25).bow_tie.unwrap();
    let round = of(&modern());
    assert!(round.middle().abs() < 1e-9, "{round:?}");
    let (along, across) =
        (of(&stretched(DVec3::new(1.4, 1.0, 1.0))), of(&stretched(DVec3::new(1.0, 1.4, 1.0))));
    println!("bow tie: {along:?}, {across:?}");
    assert!(along.least > 0.0, "{along:?}");
    assert!((along.middle() - across.middle()).abs() < 1e-3, "{along:?}, {across:?}");
}

/// Shallow pavilions show their girdle under the table as a ring, the fish eye; those of usual slope do not. Light that falls on a
/// main of slope p at the distance r from the axis rises to the opposite girdle by (1 + r) / tan 2p.
#[test]
fn a_shallow_pavilion_has_a_fish_eye_and_a_usual_one_has_none() {
    let of = |pavilion: f64, girdle_thickness: f64| {
        let cut = brilliant((56.0, 34.5, pavilion), (50.0, 77.0), 96);
        let stone = built(&RoundBrilliant { girdle_thickness, ..cut }).polytope;
        pattern(&traced(&stone, DIAMOND, &View::default(), 0.01), &stone, 3.25).fish_eye.unwrap()
    };
    let angles = [36.0, 38.0, 39.0, 40.8, 42.0];
    let found = angles.map(|pavilion| of(pavilion, 3.0));
    println!("fish eye: {found:?}");
    for (pavilion, found) in angles.into_iter().zip(found) {
        let p = pavilion.to_radians();
        let rise = |r: f64| (1.0 + r) / (2.0 * p).tan();
        // The main meets the girdle's lower edge, so that the axis is deeper by tan p.
        let reaches = |r: f64| rise(r) >= (1.0 - r) * p.tan();
        let is_seen = reaches(0.56);
        assert_eq!(found.most > 1e-3, is_seen, "{pavilion}: {found:?}");
    }
    assert!(found[0].least > 0.1 && found[3].most == 0.0, "{found:?}");
    // At 36° light rises past a girdle of usual height under the table, so that a thick one is seen by more of it.
    let thick = of(36.0, 8.0);
    println!("with a thick girdle: {thick:?}");
    assert!(thick.least > 1.3 * found[0].most, "{thick:?}, {found:?}");
}

/// Follows rays through a square of the image, from its least corner on; returns the number of those that meet the stone, and the
/// light that they see of an even dome beside a head of 15 degrees.
fn seen_by_rays(
    (stone, tracer): (&Polytope, &StoneTracer),
    view: &View,
    corner: DVec2,
    (side, per_side): (f64, u32),
) -> (u32, f64) {
    let (camera, zenith) = (Camera::new(view, stone), view.zenith());
    let (mut hits, mut light) = (0_u32, 0.0);
    for k in 0..per_side * per_side {
        let part = DVec2::new(f64::from(k % per_side) + 0.5, f64::from(k / per_side) + 0.5);
        let (origin, direction) = camera.ray(corner + part / f64::from(per_side) * side);
        let mut first = true;
        let followed = tracer.follow(origin, direction, |exit| {
            let elevation = elevation_deg(exit.direction, zenith);
            let is_lit = !first && (0.0..75.0).contains(&elevation);
            light += if is_lit { exit.weight } else { 0.0 };
            first = false;
        });
        hits += u32::from(followed.is_some());
    }
    (hits, light)
}

#[test]
fn the_contrast_of_a_square_is_that_of_rays_through_it() {
    let (stone, medium) = (modern(), Medium::clear(DIAMOND));
    let view = View { tilt: 0.12, azimuth: 0.2, ..View::default() };
    let beams = traced(&stone, DIAMOND, &view, 0.002);
    // Seen from 1.5 m, by 25 rays along each side of a square.
    let coarse = PatternSettings { resolves_mm: 6.0 * EYE_RESOLVES_MM, ..PatternSettings::usual(3.25) };
    let map = ContrastMap::of(&beams, 15.0, &coarse, &unwatched).unwrap();
    let (side, per_side) = (coarse.resolves_mm / coarse.unit_mm, 25);
    let tracer = StoneTracer::new(&stone, medium, RayOptions::default());
    let mut squares: BTreeMap<[i64; 2], f64> = BTreeMap::new();
    for (outline, contrast) in map.parts() {
        let square = (brillianteer::math::centroid(outline) / side).floor().as_i64vec2();
        squares.insert(square.to_array(), contrast.known);
    }
    let rays = |square: &[i64; 2]| {
        let corner = DVec2::new(square[0] as f64, square[1] as f64) * side;
        seen_by_rays((&stone, &tracer), &view, corner, (side, per_side))
    };
    let seen: Vec<(u32, f64)> = squares.keys().map(rays).collect();
    let (hits, light) = seen.iter().fold((0, 0.0), |(h, l), (hits, light)| (h + hits, l + light));
    let mean = light / f64::from(hits);
    let whole = squares.values().zip(&seen).filter(|(_, (hits, _))| *hits == per_side * per_side);
    let differences: Vec<f64> =
        whole.map(|(known, (hits, light))| light / f64::from(*hits) / mean - 1.0 - known).collect();
    let worst = differences.iter().fold(0.0_f64, |worst, d| worst.max(d.abs()));
    println!("{} squares, at most {worst:.3} off", differences.len());
    assert!(differences.len() > 100 && worst < 0.05, "{} squares, {worst}", differences.len());
}

/// Averages single rays over squares of the image: nothing of it is shared with exact beams but the stone.
#[test]
fn the_contrast_of_the_eye_is_that_of_pixels() {
    let (stone, medium, view) = (modern(), Medium::clear(DIAMOND), View::default());
    let found = pattern(&traced(&stone, DIAMOND, &view, 0.003), &stone, 3.25).eye_contrast;
    let tracer = StoneTracer::new(&stone, medium, RayOptions::default());
    let (side, per_side) = (EYE_RESOLVES_MM / 3.25, 5);
    let reach = (1.1 / side).ceil() as i32;
    let [mut area, mut mean, mut square] = [0.0; 3];
    // A quarter of an eightfold face has the contrast of the whole.
    for cell in (0..reach).flat_map(|y| (0..reach).map(move |x| DVec2::new(f64::from(x), f64::from(y)))) {
        let (hits, light) = seen_by_rays((&stone, &tracer), &view, cell * side, (side, per_side));
        if hits > 0 {
            let weight = f64::from(hits);
            area += weight;
            mean += light;
            square += light * light / weight;
        }
    }
    let mean = mean / area;
    let contrast = (square / area - mean * mean).sqrt() / mean;
    println!("contrast by rays {contrast}, by beams {found:?}");
    // Five rays a side leave an error in each square; it adds to the deviation.
    assert!((contrast - found.middle()).abs() < 0.015 + found.error(), "{contrast}, {found:?}");
}

fn scintillation(
    stone: &Polytope,
    index: f64,
    (rock_deg, unresolved): (f64, f64),
    head_deg: f64,
) -> Scintillation {
    let view = View::default();
    let rocked: Vec<Beams> =
        rocked_views(&view, rock_deg).iter().map(|view| traced(stone, index, view, unresolved)).collect();
    let beams = traced(stone, index, &view, unresolved / 10.0);
    let rocked = rocked.into_iter().map(Ok::<_, Stopped>);
    Scintillation::of(&beams, rocked, head_deg, &PatternSettings::usual(3.25), &unwatched).unwrap()
}

#[test]
fn scintillation_grows_as_the_stone_rocks_and_stays_inside_of_its_bounds() {
    let stone = modern();
    let found = [0.001, 0.5, 3.0].map(|rock| scintillation(&stone, DIAMOND, (rock, 0.03), 15.0));
    println!("scintillation: {found:?}");
    let [still, little, usual] = found.map(|of| of.change);
    assert!(still.least < 1e-3 && still.middle() < little.middle() && little.most < usual.least);
    let finer = scintillation(&stone, DIAMOND, (3.0, 0.01), 15.0);
    println!("finer: {finer:?}");
    assert!(is_within(finer.change, usual) && is_within(finer.size, found[2].size), "{finer:?}");
    assert!(finer.change.least > 0.15 && finer.change.most < 0.3, "{finer:?}");
}

#[test]
fn a_plate_does_not_scintillate_under_a_dome_without_a_head() {
    let sides = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y].map(|n| Plane::new(n, 1.0));
    let faces = [DVec3::Z, DVec3::NEG_Z].map(|n| Plane::new(n, 0.01));
    let planes: Vec<Plane> = sides.into_iter().chain(faces).collect();
    let plate = Polytope::from_planes(&planes).unwrap();
    let of = |head: f64| scintillation(&plate, 1.5, (3.0, 1e-3), head).change.middle();
    let (still, hidden) = (of(0.0), of(4.0));
    println!("plate: {still}, with a head {hidden}");
    assert!(still < 0.05, "{still}");
    // A head that is seen in the plate hides its back while it lies still, and no longer as it rocks: light returns at twice the angle.
    assert!(hidden > 0.5, "{hidden}");
}
