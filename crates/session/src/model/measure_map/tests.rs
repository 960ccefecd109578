//! Tests of the map: its choices, its moves of the design, and the changes after which it begins anew.

use super::*;
use crate::model::document::Document;
use brillianteer_base::{Stopped, unwatched};
use brillianteer_cut::Crown;

fn design(name: &str) -> Design {
    Document::of_library(name).unwrap().work.design
}

/// Returns a map of a design, and the number of sweeps that it has begun.
fn map(design: &Design) -> (MeasureMap, u64) {
    let (mut map, mut numbers) = (MeasureMap::default(), 0);
    map.follow(design, &mut numbers);
    (map, numbers)
}

fn keys(map: &MeasureMap) -> [String; 2] {
    map.options().unwrap().axes.each_ref().map(|axis| axis.key.to_string())
}

/// Returns a design as tiers.
fn tiers(name: &str) -> Design {
    let document = Document::of_library(name).unwrap();
    let tiers = brillianteer_files::as_tiers(document.specimen()).unwrap().with_found_meets();
    Design { cut: Cut::Tiers(tiers), ..document.work.design }
}

#[test]
fn every_place_is_measured_once_and_coarse_ones_first() {
    let (map, _) = map(&design("tolkowsky"));
    let order = map.sweep.wanted().unwrap();
    let mut points = order.points.to_vec();
    points.sort_unstable();
    assert_eq!(points, (0..(STEPS + 1).pow(2)).collect::<Vec<_>>());
    assert!(order.points[..order.coarse].iter().all(|point| point % 16 == point / (STEPS + 1) % 16));
    let axes = &map.options().unwrap().axes;
    let values: Vec<String> =
        order.sweep.values(point(16, 64)).into_iter().map(ToString::to_string).collect();
    assert_eq!(values, [axes[0].at(16), axes[1].at(64)].map(|value| value.to_string()));
}

#[test]
fn every_cut_that_comes_with_the_program_offers_two_axes_or_has_nothing_to_vary() {
    let mut offered = 0;
    for (name, _) in brillianteer_files::library::CUTS {
        let design = design(name);
        let (map, _) = map(&design);
        let Some(options) = map.options() else {
            assert!(MapAxis::all(&design.cut).len() < 2, "{name}");
            continue;
        };
        let [across, up] = &options.axes;
        assert!(!across.is_paired(up, &design.cut), "{name}");
        let here = [across, up].map(|axis| axis.value(&design.cut).unwrap());
        assert!(map.moved(&design, here).is_ok(), "{name}: {here:?}");
        offered += 1;
    }
    assert!(offered > 20, "{offered}");
}

#[test]
fn a_side_and_the_tier_by_which_its_scale_is_told_make_no_map() {
    let mut design = design("tolkowsky");
    design.cut = Cut::Tiers(
        brillianteer_files::as_tiers(&brillianteer_scene::Specimen::new(design.clone()).unwrap()).unwrap(),
    );
    let all = MapAxis::all(&design.cut);
    let of = |key: &str| all.iter().find(|axis| axis.key == SweepKey::of(key)).unwrap();
    let told = design.cut.tier_of_side(ScaledSide::Crown).unwrap();
    let (scale, tier, other) = (of("crown_scale"), of(&format!("tier:{told}")), of("tier:P1"));
    assert!(scale.is_paired(tier, &design.cut) && tier.is_paired(scale, &design.cut));
    assert!(!scale.is_paired(other, &design.cut) && !other.is_paired(scale, &design.cut));
}

#[test]
fn a_map_stays_along_its_axes_and_begins_anew_beside_them() {
    for held in [Crown::Angle(34.5), Crown::Height(16.0)] {
        let mut design = design("tolkowsky");
        let Cut::RoundBrilliant(brilliant) = &mut design.cut else { panic!() };
        brilliant.crown = held;
        let (mut map, mut numbers) = map(&design);
        assert_eq!(keys(&map), ["pavilion_angle", "crown_angle"]);
        let moved = Design { cut: map.moved(&design, [41.2, 33.0]).unwrap(), ..design.clone() };
        let Cut::RoundBrilliant(brilliant) = &moved.cut else { panic!() };
        assert_eq!(
            matches!(brilliant.crown, Crown::Angle(_)),
            matches!(held, Crown::Angle(_)),
            "what was held is held"
        );
        let here = map.options().unwrap().axes.each_ref().map(|axis| axis.value(&moved.cut).unwrap());
        assert!((here[0] - 41.2).abs() < 1e-9 && (here[1] - 33.0).abs() < 1e-9, "{here:?}");
        let renamed = Design { name: "another".into(), ..moved.clone() };
        for along in [&moved, &renamed, &design] {
            map.follow(along, &mut numbers);
            assert_eq!(numbers, 1);
        }
        let mut beside = design.clone();
        let Cut::RoundBrilliant(brilliant) = &mut beside.cut else { panic!() };
        brilliant.table += 1.0;
        map.follow(&beside, &mut numbers);
        map.follow(&Design { material: MaterialRef::Index(1.7), ..beside.clone() }, &mut numbers);
        assert_eq!(numbers, 3, "another table, and another material");
    }
}

#[test]
fn a_design_of_tiers_is_mapped_by_two_angles_and_its_meets_follow() {
    let design = tiers("tolkowsky");
    let (mut map, mut numbers) = map(&design);
    let axes = map.options().unwrap().axes.clone();
    assert!(axes.iter().all(|axis| matches!(axis.key, SweepKey::Tier(_))), "{axes:?}");
    let here = axes.each_ref().map(|axis| axis.value(&design.cut).unwrap());
    let cut = map.moved(&design, [here[0] + 0.3, here[1] - 0.2]).unwrap();
    let there = axes.each_ref().map(|axis| axis.value(&cut).unwrap());
    assert!((there[0] - here[0] - 0.3).abs() < 1e-9 && (there[1] - here[1] + 0.2).abs() < 1e-9);
    map.follow(&Design { cut: cut.clone(), ..design.clone() }, &mut numbers);
    assert_eq!(numbers, 1, "the map stays");
    let mut beside = cut;
    let Cut::Tiers(changed) = &mut beside else { panic!() };
    changed.tiers[0].distance *= 0.99;
    map.follow(&Design { cut: beside, ..design }, &mut numbers);
    assert_eq!(numbers, 2, "another distance is beside the axes");
}

#[test]
fn a_design_of_tiers_or_planes_is_mapped_by_the_scales_of_its_sides() {
    let planes = design("tolkowsky");
    let planes = Design { cut: Cut::Planes(planes.facets().unwrap()), ..planes };
    for design in [tiers("tolkowsky"), planes] {
        let (mut map, mut numbers) = map(&design);
        let all = MapAxis::all(&design.cut);
        let of = |key: &str| all.iter().find(|axis| axis.key == SweepKey::of(key)).unwrap().clone();
        let axes = [of("pavilion_scale"), of("crown_scale")];
        map.choose(MapOptions { axes: axes.clone(), ..map.options().unwrap().clone() });
        map.follow(&design, &mut numbers);
        let begun = numbers;
        let here = |design: &Design| axes.each_ref().map(|axis| axis.value(&design.cut).unwrap());
        assert!(here(&design).iter().all(|percent| (percent - 100.0).abs() < 1e-9));
        // Two moves count from the design of the first, not one from the other.
        let first = Design { cut: map.moved(&design, [101.0, 90.0]).unwrap(), ..design.clone() };
        let second = Design { cut: map.moved(&first, [103.0, 110.0]).unwrap(), ..design.clone() };
        let at_once = map.moved(&design, [103.0, 110.0]).unwrap();
        assert!(is_same_cut(&second.cut, &at_once) && !is_same_cut(&first.cut, &at_once));
        let there = here(&second);
        assert!((there[0] - 103.0).abs() < 1e-9 && (there[1] - 110.0).abs() < 1e-9, "{there:?}");
        for moved in [&first, &second] {
            map.follow(moved, &mut numbers);
            assert_eq!(numbers, begun, "the map stays");
        }
        // A map that begins at a scaled design has the same places.
        let mut other = MeasureMap { options: map.options.clone(), ..MeasureMap::default() };
        other.follow(&second, &mut numbers);
        let [at_first, at_second] =
            [&map, &other].map(|map| map.sweep.wanted().unwrap().sweep.design_at(point(16, 40)).unwrap());
        assert!(is_same_cut(&at_first.cut, &at_second.cut));
    }
}

#[test]
fn axes_of_which_one_follows_from_the_other_are_refused() {
    let design = design("tolkowsky");
    let (mut map, mut numbers) = map(&design);
    let before = map.options().unwrap().clone();
    let all = MapAxis::all(&design.cut);
    let of = |key: &str| all.iter().find(|axis| axis.key == SweepKey::of(key)).unwrap().clone();
    let bad = [
        [of("pavilion_angle"), of("pavilion_depth")],
        [of("table"), of("table")],
        [MapAxis { ends: [50.0, 50.0], ..of("table") }, of("crown_angle")],
    ];
    for axes in bad {
        map.choose(MapOptions { axes, ..before.clone() });
        assert_eq!(map.options(), Some(&before));
    }
    let other = MapOptions { axes: [of("table"), of("crown_angle")], ..before };
    map.choose(other.clone());
    map.follow(&design, &mut numbers);
    assert_eq!((map.options(), numbers), (Some(&other), 2));
    // Another measure is of the same places.
    map.choose(MapOptions { measure: MeasureName::Fire, ..other });
    map.follow(&design, &mut numbers);
    assert_eq!(numbers, 2);
}

#[test]
fn the_published_range_is_that_of_the_round_brilliant_of_diamond() {
    let design = design("tolkowsky");
    let (map, _) = map(&design);
    let options = map.options().unwrap();
    assert_eq!(options.published_range(&design), Some([[40.6, 41.8], [31.5, 36.5]]));
    let sapphire = Design { material: MaterialRef::Name("sapphire".into()), ..design.clone() };
    assert_eq!(options.published_range(&sapphire), None);
    let all = MapAxis::all(&design.cut);
    let star = all.iter().find(|axis| axis.key == SweepKey::of("star_length")).unwrap().clone();
    let other = MapOptions { axes: [star, options.axes[1].clone()], ..options.clone() };
    assert_eq!(other.published_range(&design), None, "stars");
}

#[test]
fn a_place_without_a_stone_says_why_and_moves_nothing() {
    let design = design("tolkowsky");
    let (mut map, mut numbers) = map(&design);
    let options = map.options().unwrap().clone();
    let all = MapAxis::all(&design.cut);
    let table = all.iter().find(|axis| axis.key == SweepKey::of("table")).unwrap();
    let wide = MapAxis { ends: [50.0, 99.9], ..table.clone() };
    map.choose(MapOptions { axes: [wide, options.axes[1].clone()], ..options });
    map.follow(&design, &mut numbers);
    let why = map.moved(&design, [99.9, 34.0]).unwrap_err().to_string();
    assert!(why.starts_with("no stone there: ") && !why.contains('_'), "{why}");
    // The places of the grid give the same.
    let order = map.sweep.wanted().unwrap().clone();
    let mut found = vec![];
    let ends = [point(0, 32), point(STEPS, 32)];
    order
        .sweep
        .run::<Stopped>(ends, &unwatched, |_, result| {
            found.push(result);
            Ok(())
        })
        .unwrap();
    assert!(
        found[0].is_ok() && found[1].as_ref().is_err_and(|error| why.ends_with(&no_stone(error))),
        "{why}"
    );
}
