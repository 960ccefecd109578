//! Scans of a brilliant whose facets are off by known angles: noise must change nothing but the standard errors.

use crate::common::scans::{Corners, Scan, flawed};
use brillianteer::cut::{
    Crown, LowerHalf, Pavilion, RoundBrilliant,
    from_mesh::{Evening, FromMesh, Up, from_mesh},
};
use brillianteer::io::{cut_file, library};
use brillianteer::math::{
    Plane, Polytope,
    faceting::{Face, Faceted, NotFaceted, PlaneError, SurfaceKind, Unfaceted, faceted_hull, facets},
};
use brillianteer::measure::facet_deviations;
use brillianteer::scene::Stone;
use glam::{DQuat, DVec3};

/// Facets are named the same where their normals differ by less than this, radians: 3.4 degrees. The narrow facets of the girdle
/// are known least.
const SAME: f64 = 0.06;

/// The number of standard errors that 95 % of normally distributed errors stay within.
const NINETY_FIVE: f64 = 1.96;

/// The departures from symmetry, degrees.
const SLOPE_DEG: f64 = 0.15;
const AZIMUTH_DEG: f64 = 0.4;

fn even() -> Vec<Plane> {
    brilliant(16)
}

fn brilliant(girdle_facets: u32) -> Vec<Plane> {
    let cut = RoundBrilliant {
        table: 56.0,
        crown: Crown::Angle(34.5),
        pavilion: Pavilion::Angle(40.8),
        star_length: 50.0,
        lower_half: LowerHalf::Radial(77.0),
        girdle_thickness: 3.0,
        girdle_facets,
        culet: 0.0,
    };
    cut.facets().unwrap().into_iter().map(|(_, plane)| plane).collect()
}

fn uneven() -> Vec<Plane> {
    flawed(&even(), SLOPE_DEG, AZIMUTH_DEG, 5)
}

fn read(scan: &Scan, stone: &[Plane]) -> Option<Box<Faceted>> {
    match facets(scan.of(stone).mend().unwrap().surface) {
        SurfaceKind::Convex(found) => Some(found),
        SurfaceKind::Concave(_) => None,
    }
}

fn found(scan: &Scan, stone: &[Plane]) -> Box<Faceted> {
    read(scan, stone).unwrap_or_else(|| panic!("no facets: {scan:?}"))
}

fn stone_of(found: &Faceted, evening: Evening) -> FromMesh {
    from_mesh(found, Up::Given(DVec3::Z), evening).unwrap()
}

/// Returns the tilts and the distance by which a true plane lies off a found one, in standard errors.
fn in_errors(face: &Face, truth: &Plane, error: &PlaneError) -> [f64; 3] {
    let tilt = |k: usize| (truth.normal - face.plane.normal).dot(error.axes[k]) / error.tilts[k];
    [tilt(0), tilt(1), (truth.distance(error.middle) - face.plane.distance(error.middle)) / error.distance]
}

/// Scans of several kinds, each with every fault that it names.
fn kinds(triangles: u32, noise_um: f64, seed: u64) -> Vec<(&'static str, Scan)> {
    let plain = Scan::meshed(triangles, noise_um, seed);
    let turn = DQuat::from_axis_angle(DVec3::new(0.48, 0.6, 0.64), 2.0);
    vec![
        ("plain", plain),
        ("more noise along z", Scan { noise_um: noise_um * DVec3::new(0.5, 1.0, 2.0), ..plain }),
        ("fewer corners", Scan { kept: 0.5, ..plain }),
        ("needles, rounded to 10 um", Scan { kept: 0.5, needles: true, step_um: 10.0, ..plain }),
        ("rounded to 1 um", Scan { step_um: 1.0, ..plain }),
        ("rounded to 10 um", Scan { step_um: 10.0, ..plain }),
        ("correlated noise", Scan { blurs: 1, ..plain }),
        ("turned", Scan { turn, ..plain }),
        ("corners beside the edges", Scan { corners: Corners::Radial(triangles), ..plain }),
    ]
}

/// The facets that are found in scans, and how far they are off.
#[derive(Default)]
struct Tally {
    inside: [usize; 3],
    count: usize,
}

impl Tally {
    /// Compares the found facets with the true ones, each of which must be there once.
    fn add(&mut self, found: &Faceted, stone: &[Plane], name: &str) {
        self.add_with_strips(found, stone, name, 0);
    }

    /// Does the same where up to so many strips of facets may be facets of their own.
    fn add_with_strips(&mut self, found: &Faceted, stone: &[Plane], name: &str, strips: usize) {
        assert!(
            (stone.len()..=stone.len() + strips).contains(&found.faces.len()),
            "{name}: {}",
            found.faces.len()
        );
        for truth in stone {
            let off = |face: &&Face| (face.plane.normal - truth.normal).length();
            let face = found.faces.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            assert!(off(&face) < SAME, "{name}: a facet is {} off", off(&face));
            let moved = Plane::new(truth.normal, -truth.distance(found.centre));
            let error = face.error.unwrap_or_else(|| panic!("{name}: no standard errors"));
            let off = in_errors(face, &moved, &error);
            self.count += 1;
            (0..3).for_each(|k| self.inside[k] += usize::from(off[k].abs() < NINETY_FIVE));
        }
    }

    /// Returns the parts of the errors that stay within 1.96 standard errors, percent.
    fn coverage(&self) -> [f64; 3] {
        self.inside.map(|inside| 100.0 * inside as f64 / self.count as f64)
    }
}

#[test]
fn every_facet_is_found_and_known_to_its_standard_errors_in_scans_of_all_kinds() {
    let stone = uneven();
    let mut all = Tally::default();
    for (name, scan) in kinds(16_000, 0.8, 1) {
        let found = found(&scan, &stone);
        let mut tally = Tally::default();
        // Long triangles across rounded coordinates may make a facet of a strip.
        tally.add_with_strips(&found, &scan.planes(&stone), name, usize::from(scan.needles));
        let volume = Polytope::from_planes(&scan.planes(&stone)).unwrap().volume();
        assert!((found.polytope.volume() / volume - 1.0).abs() < 1e-3, "{name}");
        (0..3).for_each(|k| all.inside[k] += tally.inside[k]);
        all.count += tally.count;
        assert!(tally.coverage().iter().all(|c| *c > 85.0), "{name}: {:?}", tally.coverage());
    }
    assert!(all.coverage().iter().all(|c| (93.0..97.5).contains(c)), "{:?} of {}", all.coverage(), all.count);
}

#[test]
fn standard_errors_cover_at_any_noise_and_number_of_triangles() {
    let stone = uneven();
    let cases = [(2_000, 0.3), (2_000, 5.0), (8_000, 0.5), (8_000, 3.0), (30_000, 2.0), (60_000, 5.0)];
    let mut all = Tally::default();
    for (triangles, noise_um) in cases {
        let mut tally = Tally::default();
        let seeds = if triangles > 10_000 { 1..=1 } else { 1..=4 };
        for seed in seeds {
            let scan = Scan::meshed(triangles, noise_um, seed);
            tally.add(&found(&scan, &stone), &scan.planes(&stone), &format!("{triangles} at {noise_um} um"));
        }
        // A part of so many errors scatters by its standard deviation.
        let scatter = 100.0 * (0.95 * 0.05 / tally.count as f64).sqrt();
        assert!(
            tally.coverage().iter().all(|c| (c - 95.0).abs() < 2.0 + 3.0 * scatter),
            "{triangles} at {noise_um} um: {:?}",
            tally.coverage()
        );
        (0..3).for_each(|k| all.inside[k] += tally.inside[k]);
        all.count += tally.count;
    }
    assert!(all.coverage().iter().all(|c| (93.0..97.0).contains(c)), "{:?} of {}", all.coverage(), all.count);
}

#[test]
fn rounding_to_ten_micrometres_is_within_the_standard_errors_of_a_regular_stone() {
    let mut tally = Tally::default();
    for (triangles, noise_um) in [(8_000, 0.0), (8_000, 0.3), (24_000, 0.8), (8_000, 2.0)] {
        let scan = Scan { step_um: 10.0, ..Scan::meshed(triangles, noise_um, 1) };
        tally.add(&found(&scan, &even()), &scan.planes(&even()), &format!("{triangles} at {noise_um} um"));
    }
    // The facets of an even stone are rounded alike, eight at a time, so the part scatters by three percent.
    assert!(tally.coverage().iter().all(|c| *c > 85.0), "{:?}", tally.coverage());
    let all: usize = tally.inside.iter().sum();
    assert!(all as f64 > 0.92 * 3.0 * tally.count as f64, "{:?}", tally.coverage());
}

#[test]
fn facets_that_may_be_several_are_named_and_those_of_a_complete_stone_are_not() {
    let bent = |scan: Scan, stone: &[Plane]| {
        let found = found(&scan, stone);
        let count = found.faces.iter().filter(|face| face.is_bent).count();
        (found.faces.len(), count)
    };
    let girdle = brilliant(96);
    assert_eq!(bent(Scan::meshed(30_000, 0.3, 1), &girdle), (girdle.len(), 0));
    for noise_um in [1.0, 2.0, 3.0] {
        let (facets, bent) = bent(Scan::meshed(30_000, noise_um, 2), &girdle);
        assert!(facets < girdle.len() && bent > 30, "{noise_um} um: {bent} of {facets}");
    }
    for (triangles, noise_um) in [(2_000, 5.0), (8_000, 3.0), (30_000, 5.0)] {
        assert_eq!(bent(Scan::meshed(triangles, noise_um, 2), &uneven()), (uneven().len(), 0));
    }
    let scan = Scan::meshed(30_000, 2.0, 2);
    let made = stone_of(&found(&scan, &girdle), Evening::AsFound);
    assert!(made.errors.iter().filter(|error| error.is_bent).count() > 30);
}

#[test]
fn a_scan_with_few_corners_is_evened_only_where_its_stone_is_even() {
    for noise_um in [0.2, 0.8] {
        let few = Scan { kept: 0.3, ..Scan::meshed(2_000, noise_um, 2) };
        let needles = Scan { kept: 0.5, needles: true, ..Scan::meshed(2_000, noise_um, 2) };
        for scan in [few, needles] {
            let made = |stone: &[Plane]| stone_of(&found(&scan, stone), Evening::WhereLikely).evened;
            let (uneven, even) = (made(&uneven()), made(&even()));
            assert_eq!((uneven.turns, uneven.mirror), (1, None), "{scan:?}");
            assert!(even.turns == 8 && even.mirror.is_some(), "{scan:?}");
        }
    }
}

#[test]
fn an_uneven_stone_stays_as_found_and_an_even_one_is_evened_unless_it_is_to_stay() {
    for (triangles, noise_um) in [(2_000, 0.5), (2_000, 2.0), (20_000, 1.0)] {
        let scan = Scan::meshed(triangles, noise_um, 3);
        let stone = uneven();
        let uneven = stone_of(&found(&scan, &stone), Evening::WhereLikely);
        assert_eq!((uneven.evened.turns, uneven.evened.mirror), (1, None), "{triangles} at {noise_um} um");
        let even = found(&scan, &even());
        let evened = stone_of(&even, Evening::WhereLikely);
        assert!(evened.evened.turns == 8 && evened.evened.mirror.is_some(), "{triangles} at {noise_um} um");
        let kept = stone_of(&even, Evening::AsFound);
        assert_eq!((kept.evened.turns, kept.evened.mirror), (1, None));
        let spread = |made: &FromMesh| {
            facet_deviations(&Stone::new(&made.facets).unwrap()).unwrap()[0].azimuth_spread_deg
        };
        assert!(spread(&evened) < 1e-9 && spread(&kept) > 1e-4, "{} {}", spread(&evened), spread(&kept));
    }
}

#[test]
fn cuts_with_narrow_facets_are_evened_where_they_are_even_and_their_errors_cover() {
    let mut all = Tally::default();
    for (name, turns, seeds) in [("tolkowsky", 8, 1), ("pear", 1, 2)] {
        let stone = cut(name);
        let scan = |seed| Scan { corners: Corners::Halved(20_000), ..Scan::meshed(0, 1.0, seed) };
        for seed in 1..=seeds {
            let found = found(&scan(seed), &stone);
            all.add(&found, &scan(seed).planes(&stone), name);
            assert!(found.faces.iter().all(|face| !face.is_bent), "{name}");
            let evened = stone_of(&found, Evening::WhereLikely).evened;
            assert!(evened.turns == turns && evened.mirror.is_some(), "{name}, seed {seed}: {evened:?}");
        }
        let uneven = flawed(&stone, SLOPE_DEG, AZIMUTH_DEG, 5);
        let evened = stone_of(&found(&scan(1), &uneven), Evening::WhereLikely).evened;
        assert_eq!((evened.turns, evened.mirror), (1, None), "{name}");
    }
    assert!(all.coverage().iter().all(|c| (91.5..97.5).contains(c)), "{:?} of {}", all.coverage(), all.count);
}

#[test]
fn deviations_of_facets_are_those_of_the_stone_within_their_errors() {
    let stone = uneven();
    let truth = facet_deviations(&Stone::new(&named(&stone)).unwrap()).unwrap();
    let scan = Scan::meshed(20_000, 1.0, 2);
    let made = stone_of(&found(&scan, &stone), Evening::WhereLikely);
    assert_eq!(made.errors.len(), made.facets.len());
    let known = facet_deviations(&Stone::new(&made.facets).unwrap()).unwrap();
    for (truth, known) in truth.iter().zip(&known) {
        let error = |facet: &str| made.errors.iter().find(|e| e.facet == facet).unwrap();
        let azimuth = error(&known.worst_azimuth.facet).azimuth_deg.unwrap();
        let slope = error(&known.worst_slope.facet).slope_deg;
        assert!(azimuth > 1e-4 && azimuth < 0.1 && slope > 1e-4 && slope < 0.05, "{azimuth} {slope}");
        // A spread has the errors of its two ends, and of the median.
        let spreads = (truth.azimuth_spread_deg - known.azimuth_spread_deg).abs();
        assert!(spreads < 6.0 * azimuth, "{}: {spreads} {azimuth}", truth.class);
        let spreads = (truth.slope_spread_deg - known.slope_spread_deg).abs();
        assert!(spreads < 6.0 * slope, "{}: {spreads} {slope}", truth.class);
        assert!(known.azimuth_spread_deg > 0.3, "{}: {}", truth.class, known.azimuth_spread_deg);
    }
}

fn named(planes: &[Plane]) -> Vec<(String, Plane)> {
    planes.iter().enumerate().map(|(k, plane)| (format!("facet {k}"), *plane)).collect()
}

/// Returns the planes of a cut that comes with the program, with the facets of its girdle.
fn cut(name: &str) -> Vec<Plane> {
    let design = cut_file::parse(library::cut(name).unwrap(), name).unwrap();
    design.facets().unwrap().into_iter().map(|(_, plane)| plane).collect()
}

#[test]
fn scans_without_corners_on_edges_are_read_with_true_facets_or_refused() {
    let stones = [("brilliant of 73", even()), ("princess", cut("princess")), ("pear", cut("pear"))];
    let (mut read_as, mut refused) = (0, 0);
    for (name, stone) in &stones {
        for (corners, noise_um) in [(2_500, 0.1), (2_500, 1.0), (10_000, 0.3)] {
            let scan = Scan { corners: Corners::Radial(corners), ..Scan::meshed(0, noise_um, 1) };
            let case = format!("{name}, {corners} corners, {noise_um} um");
            let surface = scan.of(stone).mend().unwrap().surface;
            match facets(surface) {
                SurfaceKind::Concave(surface) => {
                    assert_eq!(Unfaceted::of(&surface), Unfaceted::Noisy, "{case}");
                    assert_eq!(faceted_hull(surface), Err(NotFaceted::Noisy), "{case}");
                    refused += 1;
                }
                SurfaceKind::Convex(found) => {
                    let bent = found.faces.iter().filter(|face| face.is_bent).count();
                    let (count, truth) = (found.faces.len(), stone.len());
                    assert!(found.faces.iter().all(|face| face.error.is_some()), "{case}: {count} facets");
                    assert!(
                        count == truth || count < truth && bent > 0,
                        "{case}: {count} facets, {bent} bent"
                    );
                    read_as += 1;
                }
            }
        }
    }
    assert!(read_as > 0 && refused > 0, "{read_as} {refused}");
}

#[test]
fn facets_whose_corners_all_lie_on_their_edges_are_found() {
    // The cut corners of the girdle are less than a side of the triangles wide.
    let stone = cut("princess");
    let mut all = Tally::default();
    for (triangles, noise_um) in [(2_000, 0.3), (2_000, 2.0), (8_000, 1.0)] {
        let scan = Scan::meshed(triangles, noise_um, 1);
        let (found, name) = (found(&scan, &stone), format!("{triangles} at {noise_um} um"));
        all.add(&found, &scan.planes(&stone), &name);
        assert!(found.faces.iter().all(|face| !face.is_bent), "{name}");
    }
    assert!(all.coverage().iter().all(|c| (90.0..99.5).contains(c)), "{:?} of {}", all.coverage(), all.count);
}

#[test]
fn facets_without_corners_within_have_standard_errors_and_hidden_ones_are_named() {
    let mut all = Tally::default();
    for name in ["emerald", "oval", "pear", "princess"] {
        let stone = cut(name);
        let scan = Scan { corners: Corners::Halved(2_000), ..Scan::meshed(0, 1.0, 1) };
        all.add(&found(&scan, &stone), &scan.planes(&stone), name);
    }
    assert!(all.coverage().iter().all(|c| (90.0..99.5).contains(c)), "{:?} of {}", all.coverage(), all.count);
    let (stone, mut count) = (cut("tolkowsky"), 0);
    for (triangles, noise_um, seed) in [(2_000, 2.0, 1), (2_000, 2.0, 2), (2_000, 3.0, 1), (4_000, 2.0, 1)] {
        let corners =
            if triangles == 2_000 { Corners::Halved(triangles) } else { Corners::Meshed(triangles) };
        let scan = Scan { corners, ..Scan::meshed(0, noise_um, seed) };
        let Some(found) = read(&scan, &stone) else { continue };
        let has_word = found.is_uncertain || found.faces.iter().any(|face| face.is_bent);
        assert!(has_word || found.faces.len() == stone.len(), "{scan:?}: {}", found.faces.len());
        count += 1;
    }
    assert!(count > 0, "no scan was read");
}

#[test]
fn triangles_across_edges_make_no_facets_where_there_is_no_noise() {
    let scan = |corners| Scan { corners: Corners::Radial(corners), ..Scan::meshed(0, 0.0, 1) };
    let emerald = cut("emerald");
    let found = found(&scan(20_000), &emerald);
    assert_eq!(found.faces.len(), emerald.len());
    assert!(found.faces.iter().all(|face| face.error.is_some() && !face.is_bent) && !found.is_uncertain);
}

#[test]
fn noise_that_hides_facets_is_no_faceted_stone() {
    let scan = Scan::meshed(4_000, 40.0, 1);
    assert!(read(&scan, &even()).is_none());
    let surface = scan.of(&even()).mend().unwrap().surface;
    assert_eq!(faceted_hull(surface), Err(NotFaceted::Noisy));
}
