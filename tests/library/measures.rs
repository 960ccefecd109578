//! Tests of measures of light: laws, an independent tracer, and published statements.

use crate::common::*;
use brillianteer::base::unwatched;
use brillianteer::math::{Plane, Polytope};
use brillianteer::measure::{Interval, LightMeasures, MeasureSettings, PatternSettings, hemisphere_return};
use brillianteer::optics::{line, material};
use brillianteer::scene::{DomeLight, Medium, Stone, View, elevation_deg};
use brillianteer::trace::{
    beam::{BeamOptions, trace},
    ray::{Camera, RayOptions, StoneTracer},
};
use glam::DVec2;
use proptest::prelude::*;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// The indices of diamond at B and G, and at D.
const DIAMOND: [f64; 3] = [2.4075, 2.4512, 2.4175];

fn usual() -> MeasureSettings {
    MeasureSettings::usual([DIAMOND[0], DIAMOND[1]])
}

fn measures(
    polytope: &Polytope,
    medium: Medium,
    view: &View,
    unresolved: f64,
    settings: &MeasureSettings,
) -> LightMeasures {
    let options = BeamOptions { unresolved, ..BeamOptions::default() };
    let beams = trace(polytope, medium, view, &options, &unwatched).unwrap();
    LightMeasures::of(&beams, polytope, settings, &unwatched).unwrap()
}

fn modern() -> Stone {
    built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 96))
}

#[test]
fn measures_of_beams_say_how_far_they_are_and_stop_wherever_their_watch_asks_them_to() {
    let stone = modern();
    let (medium, options) =
        (Medium::clear(DIAMOND[2]), BeamOptions { unresolved: 0.05, ..BeamOptions::default() });
    let beams = trace(&stone.polytope, medium, &View::default(), &options, &unwatched).unwrap();
    let settings = MeasureSettings { pattern: Some(PatternSettings::usual(3.25)), ..usual() };
    // Stops at a call of the watch, and returns the parts that were done at each call until then.
    let stopped_at = |last: usize| {
        let calls = Mutex::new(vec![]);
        let watch = |done: f64| {
            let mut calls = calls.lock().unwrap();
            calls.push(done);
            if calls.len() > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let found = LightMeasures::of(&beams, &stone.polytope, &settings, &watch);
        (found.is_err(), calls.into_inner().unwrap())
    };
    let (is_stopped, all) = stopped_at(usize::MAX);
    assert!(!is_stopped && all.len() >= 10 && all.is_sorted(), "{all:?}");
    assert!(all.iter().all(|done| (0.0..=1.0).contains(done)), "{all:?}");
    for last in 0..all.len() {
        assert_eq!(stopped_at(last), (true, all[..=last].to_vec()), "it goes on after it was stopped");
    }
}

/// All intervals of some measures, with their names.
fn intervals(measures: &LightMeasures) -> Vec<(String, Interval)> {
    let LightMeasures { leakage, windowing, obstruction, extinction, contrast, fire, absorbed, .. } =
        measures;
    let named = [
        ("leakage", leakage),
        ("windowing", windowing),
        ("obstruction", obstruction),
        ("extinction", extinction),
        ("contrast", contrast),
        ("fire", fire),
        ("absorbed", absorbed),
    ];
    let domes = measures.domes.iter().map(|dome| (dome.dome.to_string(), dome.inside));
    named.into_iter().map(|(name, interval)| (name.to_owned(), *interval)).chain(domes).collect()
}

fn is_within(inner: Interval, outer: Interval) -> bool {
    let slack = 1e-12;
    inner.least >= outer.least - slack && inner.most <= outer.most + slack
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn an_even_dome_returns_what_neither_leaks_nor_is_absorbed_and_a_head_of_90_degrees_hides_all(
        planes in random_planes(),
        index in 1.3..2.7_f64,
        absorption in prop_oneof![Just(0.0), 0.0..0.5_f64],
        tilt in 0.0..0.7_f64,
        azimuth in 0.0..std::f64::consts::TAU,
    ) {
        let stone = nameless(&planes);
        let view = View { tilt, azimuth, ..View::default() };
        let options = BeamOptions { unresolved: 0.02, most_beams: 20_000, ..BeamOptions::default() };
        let beams = trace(&stone.polytope, Medium::grey(index, absorption), &view, &options, &unwatched).unwrap();
        let domes = ["even", "cos", "even@90", "cos2@90"].map(|text| text.parse::<DomeLight>().unwrap());
        let settings = MeasureSettings { domes: domes.to_vec(), ..usual() };
        let found = LightMeasures::of(&beams, &stone.polytope, &settings, &unwatched).unwrap();
        let surface = beams.iter().filter(|beam| beam.is_surface());
        let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
        let from_below = surface.filter(|beam| elevation_deg(beam.exit, beams.zenith) < 0.0);
        let glare_from_below: f64 = from_below.map(|beam| beam.weight * beam.area * share).sum();
        let lost = found.leakage.least + glare_from_below + found.absorbed.least + found.unresolved;
        let even = found.domes[0].with_glare();
        prop_assert!((even.least + lost - 1.0).abs() < 1e-12, "{} and {lost}", even.least);
        prop_assert!((even.error() - found.unresolved / 2.0).abs() < 1e-15);
        prop_assert!(found.domes[1].inside.least <= even.least);
        for hidden in &found.domes[2..] {
            prop_assert_eq!((hidden.inside, hidden.glare), (Interval { least: 0.0, most: 0.0 }, 0.0));
        }
        for (name, interval) in intervals(&found) {
            prop_assert!(interval.least <= interval.most && interval.least >= 0.0, "{name}: {interval:?}");
            prop_assert!(name == "contrast" || interval.most <= 1.0 + 1e-12, "{name}: {interval:?}");
        }
        prop_assert!(found.windowing.least <= found.leakage.least + 1e-15);
    }
}

#[test]
fn finer_beams_narrow_every_interval_and_never_leave_it() {
    let stone = modern();
    let view = View { tilt: 0.12, azimuth: 0.2, ..View::default() };
    for medium in [Medium::clear(DIAMOND[2]), Medium::clear(1.76)] {
        let found = [0.3, 0.05, 0.01, 0.002].map(|u| measures(&stone.polytope, medium, &view, u, &usual()));
        for pair in found.windows(2) {
            for ((name, wide), (_, narrow)) in intervals(&pair[0]).iter().zip(&intervals(&pair[1])) {
                assert!(is_within(*narrow, *wide), "{name}: {narrow:?} is not within {wide:?}");
            }
        }
        let last = intervals(&found[3]);
        assert!(last.iter().all(|(_, interval)| interval.error() < 0.05), "{last:?}");
    }
}

#[test]
fn symmetry_changes_no_measure() {
    let stone = modern();
    let of = |symmetry| {
        let options = BeamOptions { unresolved: 0.003, symmetry, ..BeamOptions::default() };
        let medium = Medium::clear(DIAMOND[2]);
        let beams = trace(&stone.polytope, medium, &View::default(), &options, &unwatched).unwrap();
        assert!(symmetry == (beams.symmetry.order() > 1));
        LightMeasures::of(&beams, &stone.polytope, &usual(), &unwatched).unwrap()
    };
    let (with, without) = (of(true), of(false));
    let open = with.unresolved.max(without.unresolved);
    for ((name, a), (_, b)) in intervals(&with).iter().zip(&intervals(&without)) {
        // Both follow light to the same bound, but in another order.
        assert!(a.least <= b.most + 1e-9 && b.least <= a.most + 1e-9, "{name}: {a:?}, {b:?}");
        assert!((a.middle() - b.middle()).abs() < 0.02 + open, "{name}: {a:?}, {b:?}");
    }
    assert!((with.spread_deg.unwrap() - without.spread_deg.unwrap()).abs() < 0.05);
}

#[test]
fn a_dome_returns_the_mean_over_the_exits_of_single_rays() {
    let stone = modern();
    let view = View { tilt: 0.1, azimuth: 0.4, ..View::default() };
    let medium = Medium { absorption: [0.05; 2], ..Medium::clear(DIAMOND[2]) };
    let domes = ["even", "cos", "cos2", "cos2@20"].map(|text| text.parse::<DomeLight>().unwrap());
    let settings = MeasureSettings { domes: domes.to_vec(), ..usual() };
    let found = measures(&stone.polytope, medium, &view, 1e-3, &settings);
    let tracer = StoneTracer::new(&stone.polytope, medium, RayOptions::default());
    let (camera, zenith) = (Camera::new(&view, &stone.polytope), view.zenith());
    let (mut hits, mut inside, mut glare) = (0_u32, [0.0; 4], [0.0; 4]);
    for k in 0..60_000_u32 {
        let p = (DVec2::new(0.754_877_666_246_692_8, 0.569_840_290_998_053_2) * f64::from(k + 1)).fract()
            * 2.4
            - 1.2;
        let (origin, direction) = camera.ray(p);
        let mut first = true;
        let followed = tracer.follow(origin, direction, |exit| {
            for ((inside, glare), dome) in inside.iter_mut().zip(&mut glare).zip(&domes) {
                // A cosine by its own formula: by the elevation, whose sine it is.
                let elevation = elevation_deg(exit.direction, zenith);
                let is_lit = elevation >= 0.0
                    && elevation < 90.0 - if dome.head_deg > 0.0 { dome.head_deg } else { -1.0 };
                let light =
                    if is_lit { exit.weight * elevation.to_radians().sin().powf(dome.power) } else { 0.0 };
                *(if first { glare } else { inside }) += light;
            }
            first = false;
        });
        hits += u32::from(followed.is_some());
    }
    assert!(hits > 30_000);
    for (k, dome) in found.domes.iter().enumerate() {
        let [inside, glare] = [inside[k], glare[k]].map(|sum| sum / f64::from(hits));
        assert!((dome.inside.middle() - inside).abs() < 2e-3 + dome.inside.error(), "{:?}, {inside}", dome);
        assert!((dome.glare - glare).abs() < 1e-3, "{dome:?}, {glare}");
    }
}

#[test]
fn fire_is_nothing_without_dispersion_and_grows_with_it() {
    let stone = modern();
    let with = |indices: [f64; 2]| {
        let medium = Medium::clear(f64::midpoint(indices[0], indices[1]));
        measures(&stone.polytope, medium, &View::default(), 5e-3, &MeasureSettings::usual(indices))
    };
    let none = with([2.4175; 2]);
    assert_eq!((none.fire, none.spread_deg), (Interval { least: 0.0, most: 0.0 }, Some(0.0)));
    let spreads = [0.005, 0.01, 0.02, 0.044, 0.1, 0.2];
    let found = spreads.map(|spread| with([2.4175 - spread / 2.0, 2.4175 + spread / 2.0]));
    for pair in found.windows(2) {
        assert!(pair[1].fire.least > 1.2 * pair[0].fire.least, "{:?}, {:?}", pair[0].fire, pair[1].fire);
        assert!(pair[1].spread_deg > pair[0].spread_deg);
    }
    // Small dispersions spread light in proportion.
    let ratio = found[1].spread_deg.unwrap() / found[0].spread_deg.unwrap();
    assert!((ratio - 2.0).abs() < 0.1, "{ratio}");
}

/// The fire of a modern ideal in some materials without colour, by rising dispersion: the dispersion between B and G, the fire, and the
/// light that crosses the stone without a reflection.
fn fire_of_materials() -> Vec<(&'static str, f64, Interval, f64)> {
    let names = [
        "quartz",
        "BK7",
        "sapphire",
        "spinel",
        "YAG",
        "lead crystal",
        "zircon",
        "SF10",
        "diamond",
        "SF11",
        "cubic zirconia",
        "moissanite",
        "strontium titanate",
        "rutile",
    ];
    let stone = modern();
    let of = |name: &'static str| {
        let material = material(name).unwrap();
        let indices = [line::FRAUNHOFER_B, line::FRAUNHOFER_G].map(|nm| material.index(nm));
        let medium = Medium::clear(material.index(line::SODIUM_D));
        let settings = MeasureSettings::usual(indices);
        let found = measures(&stone.polytope, medium, &View::default(), 5e-3, &settings);
        (name, indices[1] - indices[0], found.fire, found.windowing.least)
    };
    let found: Vec<_> = names.into_iter().map(of).collect();
    for (name, dispersion, fire, windowing) in &found {
        println!("{name}: {dispersion:.4}, {:.3} to {:.3}, windowing {windowing:.3}", fire.least, fire.most);
    }
    assert!(found.windows(2).all(|pair| pair[0].1 < pair[1].1), "the list is by dispersion");
    found
}

/// Between materials of nearly the same dispersion the index is as important: light near the critical angle spreads
/// most, and a cut for diamond has more of this light with a lower index.
#[test]
fn materials_have_fire_in_the_order_of_their_dispersion() {
    let found = fire_of_materials();
    let told: Vec<String> = found
        .iter()
        .map(|(name, dispersion, fire, _)| format!("{name} {dispersion:.4} {:.3}", fire.middle()))
        .collect();
    let order = ["BK7", "zircon", "diamond", "cubic zirconia", "moissanite", "strontium titanate"];
    let of = |name: &str| found.iter().find(|found| found.0 == name).unwrap();
    for pair in order.windows(2) {
        let [less, more] = [of(pair[0]), of(pair[1])];
        assert!(less.1 < more.1 && less.2.most < more.2.least, "{pair:?} are not in order: {told:?}");
    }
    // Of two materials without a window, the one with half as much dispersion again has more fire.
    let whole: Vec<_> = found.iter().filter(|(.., windowing)| *windowing < 1e-3).collect();
    assert!(whole.len() == found.len() - 1, "BK7 alone has a window: {told:?}");
    for (k, less) in whole.iter().enumerate() {
        for more in whole[k + 1..].iter().filter(|more| more.1 > 1.5 * less.1) {
            assert!(less.2.most < more.2.least, "{} and {} are not in order: {told:?}", less.0, more.0);
        }
    }
}

/// The weighted light return of GIA's study (Hemphill, Reinitz, Johnson and Shigley, 1998): an even white hemisphere
/// lights the stone, and light that leaves it upward counts by cos². Two reviews (JCK; Professional Jeweler) state
/// its results in words.
#[test]
fn weighted_light_return_orders_brilliants_as_published() {
    let with = |(table, crown, pavilion): (f64, f64, f64)| {
        let stone = built(&brilliant((table, crown, pavilion), (50.0, 75.0), 96));
        let found = hemisphere_return(
            &stone.polytope,
            Medium::clear(DIAMOND[2]),
            2.0,
            (RayOptions::default(), 12_000),
        );
        assert!(found.standard_error < 3e-3, "{found:?}");
        found.value
    };
    let of_crown = |crown: f64| with((53.0, crown, 40.5));
    let shallow = of_crown(23.0);
    for crown in [26.0, 29.0, 34.5, 37.0, 40.0] {
        assert!(of_crown(crown) < shallow, "crown {crown}: {} is not below {shallow}", of_crown(crown));
    }
    // Above 34.5 it is never high.
    assert!(of_crown(40.0) < of_crown(37.0) && of_crown(37.0) < of_crown(34.5));
    // At 34.5, a pavilion of 39.7 to 41.6 returns more than those far from it.
    let of_pavilion = |pavilion: f64| with((56.0, 34.5, pavilion));
    let within = [39.7, 40.8, 41.6].map(of_pavilion).into_iter().fold(f64::INFINITY, f64::min);
    for beyond in [36.5, 45.0] {
        assert!(of_pavilion(beyond) < within, "{beyond}: {} is not below {within}", of_pavilion(beyond));
    }
}

/// Returns a round brilliant whose table lies at the girdle's upper edge, so that it has no crown.
fn without_crown(pavilion: f64) -> Polytope {
    let facets = brilliant((53.0, 23.0, pavilion), (50.0, 75.0), 96).facets().unwrap();
    let edge = facets.iter().find(|(name, _)| name.starts_with("bezel")).map(|(_, bezel)| {
        // The bezel's plane meets the circle of the girdle at its upper edge.
        (bezel.offset - bezel.normal.truncate().length()) / bezel.normal.z
    });
    let below = facets.iter().map(|(_, plane)| *plane).filter(|plane| plane.normal.z < 1e-9);
    let planes: Vec<Plane> = below.chain([Plane::new(glam::DVec3::Z, edge.unwrap())]).collect();
    Polytope::from_planes(&planes).unwrap()
}

/// The same reviews: no crown at all is the overall maximum. So it is here, if each crown has the pavilion that is best for it.
#[test]
fn no_crown_at_all_returns_the_most_light() {
    let wlr = |stone: &Polytope| {
        hemisphere_return(stone, Medium::clear(DIAMOND[2]), 2.0, (RayOptions::default(), 6_000))
    };
    let none = wlr(&without_crown(44.0));
    for (crown, pavilion) in [(3.0, 43.0), (8.0, 44.0), (14.0, 43.0), (23.0, 40.5), (34.5, 40.5)] {
        let with = wlr(&built(&brilliant((53.0, crown, pavilion), (50.0, 75.0), 96)).polytope);
        let error = none.standard_error.hypot(with.standard_error);
        assert!(with.value + 3.0 * error < none.value, "crown {crown}: {with:?} is not below {none:?}");
    }
}

/// GIA's range of excellent stones leans: under a steeper crown it requires a flatter pavilion. So does the return of
/// a dome that is brightest above, once a head hides its middle. A head with a sharp border makes the return jump
/// where light crosses it, so heads of 10° to 20° are averaged.
#[test]
fn over_a_steeper_crown_the_best_pavilion_is_flatter() {
    let heads = (10..=20).step_by(2).map(|deg| DomeLight { head_deg: f64::from(deg), ..DomeLight::of(2.0) });
    let settings = MeasureSettings { domes: heads.collect(), ..usual() };
    let with = |crown: f64, pavilion: f64| {
        let stone = built(&brilliant((57.0, crown, pavilion), (50.0, 77.0), 96));
        let medium = Medium::clear(DIAMOND[2]);
        let found = measures(&stone.polytope, medium, &View::default(), 0.01, &settings);
        let mean = |end: fn(&Interval) -> f64| {
            found.domes.iter().map(|dome| end(&dome.inside)).sum::<f64>() / found.domes.len() as f64
        };
        Interval { least: mean(|of| of.least), most: mean(|of| of.most) }
    };
    let pavilions: Vec<f64> = (0..=10).map(|k| 39.6 + 0.3 * f64::from(k)).collect();
    let crowns = [32.5, 34.5, 36.5];
    let best = crowns.map(|crown| {
        let found: Vec<(f64, Interval)> = pavilions.iter().map(|&p| (p, with(crown, p))).collect();
        let best = found.iter().max_by(|a, b| a.1.middle().total_cmp(&b.1.middle())).unwrap();
        // The best pavilion is not at an end of the range.
        for end in [found[0], found[found.len() - 1]] {
            assert!(best.1.least > end.1.most, "crown {crown}: {best:?} is not above {end:?}");
        }
        best.0
    });
    assert!(best[0] > best[1] && best[1] > best[2], "{best:?}");
    let slope = (best[2] - best[0]) / (crowns[2] - crowns[0]);
    assert!(
        (-0.4..-0.15).contains(&slope),
        "{slope}° of pavilion for each degree of the crown, from {best:?}"
    );
}

/// The example of BOG's manual: in tourmaline, a round with pavilion 41 and crown 28 is brighter with crown 19 under an even
/// dome alone.
#[test]
fn a_lower_crown_is_brighter_under_an_even_dome_alone() {
    let with = |crown: f64| {
        let cut = brilliant((56.0, crown, 41.0), (50.0, 75.0), 96);
        let settings = MeasureSettings { domes: vec![DomeLight::of(0.0)], ..usual() };
        let tourmaline = Medium::clear(1.63);
        measures(&built(&cut).polytope, tourmaline, &View::default(), 2e-3, &settings).domes[0]
            .inside
            .middle()
    };
    let (low, usual) = (with(19.0), with(28.0));
    assert!(low > usual, "{low} is not above {usual}");
    assert!(low < usual * 1.1, "{low} is far above {usual}");
}

#[test]
fn a_window_is_seen_where_the_pavilion_is_too_flat() {
    let with = |pavilion: f64| {
        let stone = built(&brilliant((56.0, 34.5, pavilion), (50.0, 77.0), 96));
        measures(&stone.polytope, Medium::clear(1.544), &View::default(), 5e-3, &usual()).windowing
    };
    // Quartz has a critical angle of 40.4 degrees: below it, light falls straight through the pavilion's mains.
    let (flat, steep) = (with(36.0), with(43.0));
    assert!(flat.least > 0.2 && steep.most < 0.05, "{flat:?}, {steep:?}");
}
