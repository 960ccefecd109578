//! Compares figures with those that other programs have computed for the same stones.

use crate::common::*;
use brillianteer::base::unwatched;
use brillianteer::cut::{Cut, Design, MaterialRef};
use brillianteer::io::{cut_file, library};
use brillianteer::measure::{Bounds, Figures, by_beams, by_rays};
use brillianteer::picture::Scoped;
use brillianteer::render::{MeasureError, MeasureOptions, RenderError, Unfit, Wanted};
use brillianteer::scene::{
    ASET_CONE, Backing, Band, Medium, Projection, Scope, Side, Stone, View, Viewpoint,
};
use brillianteer::trace::{beam::Beam, ray};

const DIAMOND: Medium = Medium::clear(2.4175);

/// docs/optics.md, "Reference figures": 73 facets, polarised, face up; hold to .004, the part that was unresolved
/// there. Surface; transmitted green, red, blue, below; strongest green, red, blue, below.
type Row = ((f64, f64, f64), (f64, f64), f64, [f64; 4], Option<[f64; 4]>);

const TABLE: [Row; 3] = [
    (
        (53.0, 34.5, 40.75),
        (50.0, 75.0),
        0.174507,
        [0.0633, 0.5071, 0.1779, 0.0741],
        Some([0.0548, 0.6731, 0.2321, 0.0401]),
    ),
    (
        (56.0, 34.5, 40.8),
        (50.0, 77.0),
        0.174433,
        [0.0673, 0.5051, 0.1712, 0.0812],
        Some([0.0566, 0.6777, 0.2185, 0.0472]),
    ),
    ((57.0, 36.0, 41.8), (50.0, 77.0), 0.174875, [0.2311, 0.3920, 0.0743, 0.1242], None),
];

#[test]
fn three_brilliants_have_the_light_of_the_reference_figures() {
    for (angles, lengths, surface, transmitted, strongest) in TABLE {
        let stone = built(&brilliant(angles, lengths, 16));
        assert_eq!(stone.polytope.facets().len(), 73);
        let figures = face_up(&stone, DIAMOND, 1e-3);
        assert!((figures.silhouette_area - 3.061_467_458_9).abs() < 1e-9);
        assert!((figures.surface.iter().sum::<f64>() - surface).abs() < 1e-6, "{angles:?}");
        let in_order = |zones: &[f64]| [zones[1], zones[2], zones[3], zones[0]];
        let found = in_order(&figures.transmitted);
        assert!(largest_difference(&found, &transmitted) < 4e-3, "{angles:?}: {found:?}");
        if let Some(expected) = strongest {
            let found = in_order(&figures.strongest_exit_area);
            assert!(largest_difference(&found, &expected) < 4e-3, "{angles:?}: {found:?}");
        }
    }
}

#[test]
fn the_tables_reflection_turns_from_green_to_red_at_its_angle() {
    for (index, border) in [(2.4175, 40.7482), (2.4175 * 1.002, f64::NAN)] {
        let expected = (180.0 - ((45.0_f64).to_radians().sin() / index).asin().to_degrees()) / 4.0;
        assert!(border.is_nan() || (expected - border).abs() < 5e-5);
        let elevation = |pavilion: f64| {
            let stone = built(&brilliant((56.0, 34.5, pavilion), (50.0, 77.0), 96));
            let beams = traced(&stone, Medium::clear(index), &View::default(), 0.02, true);
            let path = ["table", "main", "main", "table"];
            let is_it = |id: u32| {
                let met = beams.facets(id);
                met.len() == 4 && met.iter().zip(path).all(|(&f, name)| stone.name(f).starts_with(name))
            };
            let beam = beams
                .iter()
                .filter(|b| b.weight > 0.5 && is_it(b.id))
                .max_by(|a, b| a.area.total_cmp(&b.area));
            beam.expect("the table's reflection").exit.z.asin().to_degrees()
        };
        assert!(elevation(expected - 1e-4) < 45.0, "index {index}: green below the border");
        assert!(elevation(expected + 1e-4) > 45.0, "index {index}: red above it");
    }
}

/// Returns the virtual facets that make the shafts of a brilliant's arrows, under the table, and their heads, on the bezels:
/// light that two mains reflect. For each, the angle of its exit from the axis in degrees, and whether it is black in the
/// scope.
fn arrows(stone: &Stone, scope: &Scope) -> [Vec<(f64, bool)>; 2] {
    let beams = traced(stone, DIAMOND, &View::default(), 0.02, true);
    let kinds = [["table", "main", "main", "bezel"], ["bezel", "main", "main", "table"]];
    kinds.map(|kinds| {
        let is_it = |b: &Beam| {
            let met = beams.facets(b.id);
            if met.len() != 4 || !met.iter().zip(kinds).all(|(&f, kind)| stone.name(f).starts_with(kind)) {
                return false;
            }
            let number = |k: usize| stone.name(met[k]).rsplit(' ').next().and_then(|n| n.parse::<i32>().ok());
            let bezel = if kinds[0] == "bezel" { [0, 1] } else { [3, 2] };
            // The two mains lie opposite each other, and the bezel over one of them.
            let are_opposite = number(1).zip(number(2)).is_some_and(|(a, b)| (a - b).abs() == 4);
            are_opposite && number(bezel[0]) == number(bezel[1])
        };
        let strong = beams.iter().filter(|b| b.weight > 0.5 && b.area > 1e-4 && is_it(b));
        let row = |b: Beam| {
            let band = &scope.bands[scope.band(b.exit, beams.zenith)];
            (b.exit.z.acos().to_degrees(), band.colour == [0; 3])
        };
        strong.map(row).collect()
    })
}

/// Returns the angles from the axis at which the light of the shafts and of the heads leaves, in degrees, by the
/// formulas of docs/optics.md, "Ideal-Scope's hole".
fn arrows_angles(crown: f64, pavilion: f64) -> [f64; 2] {
    let sin = |degrees: f64| degrees.to_radians().sin();
    let outside = |inside: f64| (DIAMOND.index * sin(inside)).asin().to_degrees();
    let turned = 180.0 - 4.0 * pavilion;
    let entered = crown - (sin(crown) / DIAMOND.index).asin().to_degrees();
    [(outside(crown - turned) - crown).abs(), outside(entered - turned).abs()]
}

fn ideal_scope() -> Scope {
    let scoped = Scoped::ideal_scope();
    scoped.scope
}

#[test]
fn ideal_cuts_have_whole_dark_arrows_in_ideal_scope_and_others_do_not() {
    let scope = ideal_scope();
    let library = |name: &str| {
        let design = cut_file::parse(library::cut(name).unwrap(), name).unwrap();
        Stone::new(&design.facets().unwrap()).unwrap()
    };
    let is_dark = |facets: &Vec<(f64, bool)>| !facets.is_empty() && facets.iter().all(|(_, dark)| *dark);
    for name in ["modern-ideal", "tolkowsky"] {
        let [shafts, heads] = arrows(&library(name), &scope);
        assert!(is_dark(&shafts) && is_dark(&heads), "{name}: {shafts:?} {heads:?}");
    }
    for name in ["steep-deep", "fisheye"] {
        let [shafts, heads] = arrows(&library(name), &scope);
        assert!(!is_dark(&shafts), "{name}: {shafts:?} {heads:?}");
    }
    let hole = 90.0 - scope.bands.last().unwrap().from;
    let mut whole = 0;
    for crown in [34.0, 34.5, 35.0] {
        for pavilion in [40.6, 40.7, 40.75, 40.8, 40.85, 40.9, 41.0] {
            let stone = built(&brilliant((56.0, crown, pavilion), (50.0, 77.0), 16));
            let found = arrows(&stone, &scope);
            for (facets, expected) in found.iter().zip(arrows_angles(crown, pavilion)) {
                assert!(facets.len() == 1, "one wedge holds one of each: {facets:?}");
                assert!(
                    (facets[0].0 - expected).abs() < 1e-6,
                    "{crown}, {pavilion}: {facets:?}, not {expected}"
                );
                assert_eq!(facets[0].1, expected < hole);
            }
            // The range is that of docs/optics.md.
            let last = 40.958 - 0.179 * (crown - 34.5);
            assert_eq!(found.iter().all(is_dark), pavilion < last, "{crown}, {pavilion}: {found:?}");
            whole += usize::from(pavilion < last);
        }
    }
    assert_eq!(whole, 7 + 6 + 5);
}

#[test]
fn the_bright_facets_beside_the_arrows_of_ideal_cuts_stay_red() {
    // Light of a star and a main leaves 73.2 to 74.8 degrees up: a wider hole would include it and blur the arrows.
    for (angles, lengths) in [((56.0, 34.5, 40.8), (50.0, 77.0)), ((53.0, 34.5, 40.75), (50.0, 75.0))] {
        let stone = built(&brilliant(angles, lengths, 16));
        let figures = by_beams(&traced(&stone, DIAMOND, &View::default(), 1e-3, true), &ideal_scope());
        let dark = *figures.strongest_exit_area.last().unwrap();
        let wider =
            by_beams(&traced(&stone, DIAMOND, &View::default(), 1e-3, true), &Scope::ideal_scope(17.0));
        assert!((0.19..0.25).contains(&dark), "{angles:?}: {dark} of the face is dark");
        assert!(*wider.strongest_exit_area.last().unwrap() > dark + 0.05, "{angles:?}: {wider:?}");
    }
}

fn design(name: &str) -> Design {
    cut_file::parse(library::cut(name).unwrap(), name).unwrap()
}

#[test]
fn one_call_measures_a_design_as_the_tracers_do() {
    let tolkowsky = design("tolkowsky");
    let bounds = Bounds::exact(2e-3);
    let options = MeasureOptions { bounds, ..MeasureOptions::default() };
    let measured = brillianteer::measure(&tolkowsky, &options).unwrap();
    let stone = Stone::new(&tolkowsky.facets().unwrap()).unwrap();
    let medium = Medium::clear(measured.index);
    let by_hand = by_beams(&traced(&stone, medium, &View::default(), 2e-3, true), &aset());
    assert_eq!((&measured.figures, measured.tracer.as_str()), (&by_hand, "beam"));
    let zones = ["green", "red", "blue", "below"].map(|name| measured.zone(name).unwrap());
    let lit = zones[..3].iter().map(|z| z.transmitted).sum::<f64>();
    assert!((measured.light_return() - lit).abs() < 1e-15 && (0.74..0.76).contains(&lit), "{lit}");
    assert_eq!(measured.leakage(), zones[3].transmitted);
    assert!((measured.glare() - zones.iter().map(|z| z.glare).sum::<f64>()).abs() < 1e-15);
    let glare = zones[..3].iter().map(|z| z.glare).sum::<f64>();
    assert!((measured.glare_return() - glare).abs() < 1e-15 && measured.zone("purple").is_none());
    assert_eq!(measured.error(), measured.figures.unresolved);
    // An observer's head sends no light, and Ideal-Scope's returned light is its red.
    let head =
        brillianteer::measure(&tolkowsky, &MeasureOptions { head_deg: 10.0, ..options.clone() }).unwrap();
    assert!(head.light_return() < lit - 0.01 && head.scope.bands.last().unwrap().name == "head");
    let red = brillianteer::measure(&tolkowsky, &MeasureOptions { scope: ideal_scope(), ..options.clone() })
        .unwrap();
    assert_eq!(red.light_return(), red.zone("red").unwrap().transmitted);
}

#[test]
fn light_return_counts_from_the_horizon_whatever_the_borders_of_the_scope() {
    let tolkowsky = design("tolkowsky");
    let band = |name: &str, from, colour| Band { name: name.into(), from, colour };
    let bands = vec![
        band("low", -90.0, [9, 9, 9]),
        band("wide", -30.0, [255, 0, 0]),
        band("high", 50.0, [0, 0, 255]),
    ];
    let scope = Scope { name: "mine".into(), bands };
    for tracer in [Wanted::Beams, Wanted::Rays] {
        let bounds = Bounds { lattice: 48, ..Bounds::exact(2e-3) };
        let options = MeasureOptions { bounds, tracer, ..MeasureOptions::default() };
        let usual = brillianteer::measure(&tolkowsky, &options).unwrap();
        let mine =
            brillianteer::measure(&tolkowsky, &MeasureOptions { scope: scope.clone(), ..options }).unwrap();
        assert!((mine.light_return() - usual.light_return()).abs() < 1e-12);
        assert!((mine.glare_return() - usual.glare_return()).abs() < 1e-12);
        assert_eq!((mine.scope.bands.len(), mine.figures.transmitted.len()), (3, 3));
        assert!((mine.figures.sum() - 1.0).abs() < 1e-9);
        let wide = mine.zone("wide").unwrap().transmitted;
        assert!(wide > 0.1, "{wide}");
    }
}

#[test]
fn what_cannot_be_measured_is_refused_by_name() {
    let tolkowsky = design("tolkowsky");
    let refused = |options: MeasureOptions| brillianteer::measure(&tolkowsky, &options).unwrap_err();
    let cases = [
        (
            MeasureOptions { head_deg: 90.0, ..MeasureOptions::default() },
            "head_deg is 90; give 0 to 89 degrees",
        ),
        (MeasureOptions { index: Some(0.5), ..MeasureOptions::default() }, "index is 0.5; give 1 (air) to 6"),
        (MeasureOptions { wavelength_nm: f64::NAN, ..MeasureOptions::default() }, "wavelength_nm is NaN"),
        (
            MeasureOptions { bounds: Bounds::exact(0.0), ..MeasureOptions::default() },
            "unresolved is 0; give a part between 0 and 1",
        ),
        (
            MeasureOptions {
                bounds: Bounds { lattice: 0, ..Bounds::default() },
                ..MeasureOptions::default()
            },
            "lattice is 0; give 1 to 16,384",
        ),
        (
            MeasureOptions {
                viewpoint: Viewpoint { tilt_deg: 91.0, ..Viewpoint::default() },
                ..MeasureOptions::default()
            },
            "tilt_deg is 91",
        ),
        (
            MeasureOptions {
                viewpoint: Viewpoint {
                    projection: Projection::Perspective { distance: -8.0 },
                    ..Viewpoint::default()
                },
                ..MeasureOptions::default()
            },
            "distance is -8; give a finite number above 0",
        ),
    ];
    for (options, says) in cases {
        let error = refused(options);
        assert!(error.to_string().starts_with(says), "{error}");
    }
    let near = Viewpoint { projection: Projection::Perspective { distance: 8.0 }, ..Viewpoint::default() };
    let by_beams = MeasureOptions { viewpoint: near, tracer: Wanted::Beams, ..MeasureOptions::default() };
    assert!(matches!(refused(by_beams), MeasureError::Render(RenderError::Unfit(Unfit::Perspective))));
    let inside = Viewpoint { projection: Projection::Perspective { distance: 0.2 }, ..near };
    let inside = MeasureOptions { viewpoint: inside, ..MeasureOptions::default() };
    assert!(matches!(refused(inside), MeasureError::Render(RenderError::Unfit(Unfit::Eye))));
    let broken = Design { material: MaterialRef::Index(9.0), ..tolkowsky.clone() };
    let error = brillianteer::measure(&broken, &MeasureOptions::default()).unwrap_err();
    assert!(matches!(error, MeasureError::Specimen(_)), "{error}");
    assert!(matches!(tolkowsky.cut, Cut::RoundBrilliant(_)) && near.side == Side::Table);
    let aset = Scope::aset(ASET_CONE, Backing::White);
    let twice = Scope { bands: [&aset.bands[..], &aset.bands[..]].concat(), ..aset };
    assert!(matches!(
        refused(MeasureOptions { scope: twice, ..MeasureOptions::default() }),
        MeasureError::Scope(_)
    ));
    let mut headed = Scope::aset(ASET_CONE, Backing::Black);
    headed.bands[3].name = "head".into();
    let two_heads = refused(MeasureOptions { scope: headed, head_deg: 10.0, ..MeasureOptions::default() });
    assert!(two_heads.to_string().contains("two bands are called 'head'"), "{two_heads}");
}

#[test]
fn figures_by_rays_agree_with_beams_within_their_error() {
    let stone = built(&brilliant((57.0, 36.0, 41.8), (50.0, 77.0), 96));
    let view = View { tilt: 0.2, azimuth: 0.4, ..View::default() };
    for medium in [DIAMOND, Medium::grey(1.77, 0.3)] {
        let exact = by_beams(&traced(&stone, medium, &view, 2e-3, true), &aset());
        let options = ray::RayOptions { least_weight: 1e-4, ..ray::RayOptions::default() };
        let sampled = by_rays(&stone.polytope, medium, &view, &aset(), (options, 48), &unwatched).unwrap();
        assert!((sampled.sum() - 1.0).abs() < 1e-9);
        assert!(sampled.standard_error > 1e-5 && sampled.standard_error < 3e-3, "{}", sampled.standard_error);
        let allowed = exact.unresolved + sampled.unresolved + 4.0 * sampled.standard_error;
        let worst = largest_difference(&row(&exact), &row(&sampled));
        assert!(worst < allowed, "{worst} over {allowed}");
    }
}

/// Returns all light of each zone, glare included, as an independent path tracer reports it.
fn all_light(figures: &Figures) -> [f64; 4] {
    std::array::from_fn(|i| figures.surface[i] + figures.transmitted[i])
}

#[test]
fn an_independent_path_tracer_finds_the_same_light() {
    let Some(path) = shared("an_independent_path_tracer_finds_the_same_light", "oracle/aset_mitsuba.json")
    else {
        return;
    };
    let oracle: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let number = |v: &serde_json::Value| v.as_f64().unwrap();
    let stones = oracle["stones"].as_object().unwrap();
    assert_eq!(stones.len(), 2);
    for (name, stone) in stones {
        // The stone goes through a cut file, as a user's stone does.
        let plane = |p: &serde_json::Value| {
            format!(
                "[[plane]]\nname = {}\nnormal = {}\noffset = {:?}\n",
                p["name"],
                p["normal"],
                number(&p["offset"])
            )
        };
        let planes: String = stone["planes"].as_array().unwrap().iter().map(plane).collect();
        let text = format!("format = 1\nname = \"{name}\"\nmaterial = 2.4175\n{planes}");
        let built = Stone::new(&cut_file::parse(&text, name).unwrap().facets().unwrap()).unwrap();
        assert!((built.polytope.volume() - number(&stone["volume"])).abs() < 1e-9);
        assert_eq!(built.polytope.vertices().len() as u64, stone["n_vertices"].as_u64().unwrap());
        let scope: Scope = aset();
        let figures = by_beams(&traced(&built, DIAMOND, &View::default(), 4e-4, false), &scope);
        assert!(figures.unresolved <= 4e-4);
        let all = &stone["all_light"];
        let expected = [&stone["below_horizon"], &all["green"], &all["red"], &all["blue"]].map(number);
        for (zone, (found, expected)) in all_light(&figures).into_iter().zip(expected).enumerate() {
            // 0.15 % of this stone's light leaves within .02 degrees of the horizon: green and below share it.
            let allowed = if name == "a_modern" && zone <= 1 { 1.6e-3 } else { 6e-4 };
            assert!((found - expected).abs() < allowed, "{name}, zone {zone}: {found}, not {expected}");
        }
        let polarised = by_beams(&traced(&built, DIAMOND, &View::default(), 4e-4, true), &scope);
        let shift = &stone["polarised_minus_unpolarised"];
        for (zone, key) in [(1, "green"), (2, "red"), (3, "blue")] {
            let found = all_light(&polarised)[zone] - all_light(&figures)[zone];
            assert!(
                (found - number(&shift[key])).abs() < 4e-4,
                "{name}, {key}: polarisation shifts by {found}"
            );
        }
    }
}
