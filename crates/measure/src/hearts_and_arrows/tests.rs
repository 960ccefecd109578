use super::*;
use crate::by_beams;
use brillianteer_base::unwatched;
use brillianteer_cut::{LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
use brillianteer_math::Plane;
use brillianteer_scene::{Scope, VIEWER_CONES_DEG};
use glam::DVec2;

/// A change of a stone before it is measured.
#[derive(Clone, Copy)]
struct Change {
    /// The facet that is turned about the axis, and the angle in degrees.
    turned: (&'static str, f64),
    /// The turn of the whole stone, degrees.
    whole: f64,
    scale: f64,
    moved: DVec2,
}

const UNCHANGED: Change = Change { turned: ("", 0.0), whole: 0.0, scale: 1.0, moved: DVec2::ZERO };

/// Returns a modern ideal cut after a change.
fn changed(change: Change) -> Stone {
    let modern = RoundBrilliant {
        table: 56.0,
        pavilion: Pavilion::Angle(40.8),
        lower_half: LowerHalf::Radial(77.0),
        ..TOLKOWSKY
    };
    let facets = modern.facets().unwrap().into_iter().map(|(own, plane)| {
        let across = plane.normal.truncate();
        let (slope, azimuth) = (across.length().atan2(plane.normal.z), across.to_angle());
        let by = change.whole + if own == change.turned.0 { change.turned.1 } else { 0.0 };
        let plane = Plane::from_slope(slope, azimuth + by.to_radians(), plane.offset);
        let offset = change.scale * plane.offset + plane.normal.dot(change.moved.extend(0.0));
        (own, Plane { offset, ..plane })
    });
    Stone::new(&facets.collect::<Vec<_>>()).unwrap()
}

const DIAMOND: Medium = Medium::grey(2.4175, 0.0);

fn rough() -> BeamOptions {
    BeamOptions { unresolved: 1e-2, ..BeamOptions::default() }
}

fn measured(change: Change) -> HeartsAndArrows {
    hearts_and_arrows(&changed(change), DIAMOND, VIEWER_CONES_DEG, &rough(), &unwatched).unwrap()
}

fn turned(by: f64) -> HeartsAndArrows {
    measured(Change { turned: ("main 3", by), ..UNCHANGED })
}

fn patterns(found: &HeartsAndArrows) -> [&EightfoldPattern; 2] {
    [&found.arrows, &found.hearts]
}

fn figure<'a>(pattern: &'a EightfoldPattern, name: &str) -> &'a OctantFigure {
    pattern.figures.iter().find(|figure| figure.name == name).unwrap()
}

#[test]
fn octants_that_are_alike_have_the_same_figures_also_where_regions_are_mirror_images() {
    let stone = changed(UNCHANGED);
    // In these a heart falls into two mirror images.
    for index in [1.54, 1.76, 1.9] {
        let medium = Medium::grey(index, 0.0);
        let found = hearts_and_arrows(&stone, medium, VIEWER_CONES_DEG, &rough(), &unwatched).unwrap();
        for figure in patterns(&found).into_iter().flat_map(|pattern| &pattern.figures) {
            let spread = figure.spread.unwrap_or(0.0);
            assert!(spread < 1e-6, "{index}: {} differs by {spread}: {:?}", figure.name, figure.octants);
        }
    }
}

#[test]
fn stars_flatter_than_five_degrees_are_no_part_of_the_table() {
    let flat = RoundBrilliant { table: 72.0, star_length: 35.0, ..TOLKOWSKY };
    assert!(flat.derived().unwrap().star_angle < 5.0);
    let stone = Stone::new(&flat.facets().unwrap()).unwrap();
    assert_eq!(Mains::of(&stone).unwrap().table, [0]);
    let found = hearts_and_arrows(&stone, DIAMOND, VIEWER_CONES_DEG, &rough(), &unwatched).unwrap();
    assert!(figure(&found.arrows, "shaft area").median.is_some(), "{:?}", found.arrows);
}

#[test]
fn an_ideal_cut_departs_from_eightfold_by_nothing_however_it_is_turned_moved_or_scaled() {
    let whole = measured(UNCHANGED);
    let elsewhere = measured(Change { whole: 17.3, scale: 2.5, moved: DVec2::new(0.4, -0.7), ..UNCHANGED });
    for (found, same) in patterns(&whole).into_iter().zip(patterns(&elsewhere)) {
        for pattern in [found, same] {
            assert!(pattern.departure < 1e-9, "{}", pattern.departure);
            assert!(pattern.departures.iter().all(|by| *by < 1e-9), "{:?}", pattern.departures);
            for figure in &pattern.figures {
                assert!(figure.octants.iter().all(Option::is_some), "{figure:?}");
                assert!(figure.spread.unwrap() < 1e-9, "{figure:?}");
            }
        }
        for (figure, other) in found.figures.iter().zip(&same.figures) {
            let [a, b] = [figure, other].map(|figure| figure.median.unwrap());
            assert!((a - b).abs() < 1e-9, "{figure:?} {other:?}");
        }
    }
    assert!((elsewhere.arrows.azimuths_deg[0] - 17.3).abs() < 1e-9);
    assert!((elsewhere.hearts.azimuths_deg[0] - 39.8).abs() < 1e-9);
}

#[test]
fn a_main_that_is_turned_shows_in_its_arrow_and_the_opposite_one_and_in_the_hearts_beside() {
    let found = [0.05, 0.1, 0.3].map(turned);
    for (k, of) in found.iter().enumerate() {
        let more = found.get(k + 1);
        for (pattern, more) in patterns(of).into_iter().zip(more.map_or([None; 2], |m| patterns(m).map(Some)))
        {
            assert!(pattern.departure > 1e-3);
            assert!(more.is_none_or(|more| more.departure > 1.4 * pattern.departure));
        }
        let arrows = &of.arrows;
        assert!([3, 7].contains(&arrows.worst().octant), "{:?}", arrows.departures);
        for octant in [0, 1, 3, 4, 5, 7] {
            let least = arrows.departures[2].min(arrows.departures[6]);
            assert!(20.0 * arrows.departures[octant] < least, "{:?}", arrows.departures);
        }
        assert!([2, 3].contains(&of.hearts.worst().octant), "{:?}", of.hearts.departures);
        assert_eq!((arrows.mains[2].as_str(), of.hearts.mains[2].as_str()), ("main 3", "main 3 and main 4"));
    }
    // A small turn moves figures in proportion to it.
    for (of_arrows, name) in [(true, "shaft azimuth"), (false, "heart azimuth"), (false, "gap to the V")] {
        let by = |of: &HeartsAndArrows| {
            figure(if of_arrows { &of.arrows } else { &of.hearts }, name).spread.unwrap()
        };
        let [small, large] = [by(&found[0]), by(&found[1])];
        assert!(small > 1e-3 && (large / small - 2.0).abs() < 0.02, "{name}: {small} {large}");
    }
}

#[test]
fn turning_one_main_the_other_way_gives_the_mirror_image() {
    let [left, right] = [0.3, -0.3].map(turned);
    for (a, b) in patterns(&left).into_iter().zip(patterns(&right)) {
        assert!((a.departure - b.departure).abs() < 1e-9);
    }
    let lobe = |of: &HeartsAndArrows, name| figure(&of.hearts, name).octants;
    for octant in 0..OCTANTS {
        // The mirror through main 3 takes heart 3, after it, to heart 2, before it.
        let image = (OCTANTS + 3 - octant) % OCTANTS;
        let difference =
            lobe(&left, "left lobe")[octant].unwrap() - lobe(&right, "right lobe")[image].unwrap();
        assert!(difference.abs() < 1e-9, "{octant}: {difference}");
    }
}

#[test]
fn areas_are_those_of_the_strongest_exits_in_the_viewers_zones() {
    let found = turned(0.3);
    let (camera, ring) = VIEWER_CONES_DEG;
    let scope = Scope::hearts_and_arrows("viewer", camera, ring, [226, 0, 40]);
    let stone = changed(Change { turned: ("main 3", 0.3), ..UNCHANGED });
    for (side, pattern) in [(Side::Table, &found.arrows), (Side::Culet, &found.hearts)] {
        let options = BeamOptions { symmetry: false, ..rough() };
        let beams = trace(&stone.polytope, DIAMOND, &View { side, ..View::default() }, &options, &unwatched);
        let figures = by_beams(&beams.unwrap(), &scope);
        let zone = |name: &str| {
            figures.strongest_exit_area[scope.bands.iter().position(|band| band.name == name).unwrap()]
        };
        let expected = 100.0 * (zone("ring") + if side == Side::Table { zone("camera") } else { 0.0 });
        let least: f64 = pattern.areas.iter().map(|area| area.least).sum();
        let most: f64 = pattern.areas.iter().map(|area| area.most).sum();
        assert!((least - expected).abs() < 1e-9, "{least} {expected}");
        let undecided = 100.0 * figures.strongest_exit_undecided;
        assert!((pattern.undecided - undecided).abs() < 1e-9 && (most - least - undecided).abs() < 1e-9);
    }
}

#[test]
fn more_light_narrows_the_areas_within_what_less_light_leaves_open() {
    let stone = changed(UNCHANGED);
    let of = |unresolved| {
        let options = BeamOptions { unresolved, ..BeamOptions::default() };
        hearts_and_arrows(&stone, DIAMOND, VIEWER_CONES_DEG, &options, &unwatched).unwrap()
    };
    let [rough, fine] = [3e-2, 1e-2].map(of);
    for (wide, narrow) in patterns(&rough).into_iter().zip(patterns(&fine)) {
        for (wide, narrow) in wide.areas.iter().zip(&narrow.areas) {
            assert!(narrow.least >= wide.least - 1e-9 && narrow.most <= wide.most + 1e-9);
        }
    }
}

#[test]
fn heads_of_arrows_reach_from_the_table_to_the_girdle() {
    // The table's corners lie on the mains' azimuths, so that a head is as long as a bezel seen from above.
    let head = figure(&measured(UNCHANGED).arrows, "head length").median.unwrap();
    assert!((head - (100.0 - 56.0) / 2.0).abs() < 1e-9, "{head}");
}

#[test]
fn stones_without_eight_mains_are_refused() {
    let facets = TOLKOWSKY.facets().unwrap().into_iter().filter(|(name, _)| name != "main 2");
    let stone = Stone::new(&facets.collect::<Vec<_>>()).unwrap();
    let why = hearts_and_arrows(&stone, DIAMOND, VIEWER_CONES_DEG, &rough(), &unwatched).unwrap_err();
    assert!(why.to_string().contains("23 facets between girdle and culet"), "{why}");
}
