//! Tests of the numbers that describe families: length to width, total depth, sources of ranges, and weights.

use super::tests::{Solid, made, on_random_cuts, stone};
use crate::{Family, Proportion, ProportionReport, SheetFigures};
use proptest::prelude::*;

/// The trade's factor k of a family, carats for each cubic millimetre of length, width and depth, at the length to width of its
/// first cut. The comments give the source, and the reason where the first cut fills another part of its box.
const TRADE: [(&str, f64); 9] = [
    // esslinger.com: 0.0062 times the square of the mean of length and width. The trade's shoulders are fuller.
    ("oval", 0.0062 * 1.44 / 1.4),
    // esslinger.com. Mains run straight from a thin girdle to one point.
    ("marquise", 0.0058),
    ("pear", 0.00594),
    ("heart", 0.0059),
    // esslinger.com, triangle. Corners far from the culet are shallow.
    ("trillion", 0.0057),
    // dnaldoog/Gemwest gives the factors of long cuts at a few lengths to width; between these they are interpolated.
    ("emerald", 0.0086 + 0.8 * (0.009_26 - 0.0086)),
    // The trade's number is for square emerald cuts.
    ("asscher", 0.0080),
    // The trade's number is for emerald cuts of the same length to width.
    ("baguette", 0.0100),
    ("radiant", 0.0081 + 0.4 * (0.0084 - 0.0081)),
];

/// The carats of a cubic millimetre of diamond.
const CARATS: f64 = 0.017_575;

#[test]
fn length_to_width_is_one_number_of_a_family_in_info_and_on_sheets() {
    on_random_cuts(|family, cut| {
        let Some((stone, names)) = stone(cut) else { return Ok(false) };
        let info = ProportionReport::of(&stone, &names).length_to_width;
        let sheet = SheetFigures::of(&stone, &names).length_to_width;
        prop_assert!((info - sheet).abs() < 1e-9, "{}: {info}, and {sheet} on the sheet", family.key);
        // A drop is long along its axis.
        let row = family.proportion("length_to_width").filter(|_| family.key != "briolette");
        if let Some(own) = row.map(|row| (row.get)(cut)) {
            let own = if row.is_some_and(|row| row.can_be_set()) { own.max(1.0 / own) } else { own };
            prop_assert!((own - info).abs() < 1e-9, "{}: {own}, and {info} in info", family.key);
        }
        Ok(true)
    });
    let trillion = Family::of_key("trillion").unwrap();
    assert!((trillion.proportion("length_to_width").unwrap().get)(&trillion.first) > 1.04, "no square stone");
}

#[test]
fn every_usual_range_has_a_source() {
    let missing = made().flat_map(|(family, _)| {
        let rows = family.settable().filter(|row| family.range_source(row).is_none_or(str::is_empty));
        rows.map(|row| (family.key, row.key))
    });
    assert_eq!(missing.collect::<Vec<_>>(), []);
    // The search finds nothing for a name that no family has.
    let (oval, table) =
        (Family::of_key("oval").unwrap(), Family::of_key("oval").unwrap().proportion("table").unwrap());
    let unknown = Proportion { key: "no_such_number", ..Proportion::BLANK };
    assert!(oval.range_source(table).is_some() && oval.range_source(&unknown).is_none());
}

#[test]
fn the_total_depth_is_that_of_the_stone_and_can_be_set() {
    on_random_cuts(|family, cut| {
        let Some(solid) = Solid::of(cut) else { return Ok(false) };
        let row = family.proportion("total_depth").expect("every family has it");
        let depth = (row.get)(cut);
        // In girdle radii.
        let miss = |wanted: f64, solid: &Solid| (wanted / 50.0 - solid.size.z).abs();
        prop_assert!(miss(depth, &solid) < 1e-9, "{}: {depth}, off by {}", family.key, miss(depth, &solid));
        // Setting a flatter stone and setting it back gives the same stone.
        let mut set = cut.clone();
        row.set(&mut set, 0.98 * depth);
        if let Some(flat) = Solid::of(&set) {
            let off = miss(0.98 * depth, &flat);
            prop_assert!(off < 1e-9, "{}: {depth} made flatter, off by {off}", family.key);
        }
        row.set(&mut set, depth);
        let again = Solid::of(&set).expect("it was a stone");
        prop_assert_eq!(again.facets.len(), solid.facets.len());
        for ((name, plane), (_, before)) in again.facets.iter().zip(&solid.facets) {
            let off = plane.normal.distance(before.normal).max((plane.offset - before.offset).abs());
            prop_assert!(off < 1e-9, "{name} is off by {off}");
        }
        Ok(true)
    });
}

#[test]
fn first_cuts_weigh_about_what_the_trade_estimates() {
    for (key, k) in TRADE {
        let solid = Solid::of(&Family::of_key(key).unwrap().first).unwrap();
        let share = solid.volume / solid.size.element_product();
        assert!((share * CARATS / k - 1.0).abs() < 0.11, "{key}: {share} for {}", k / CARATS);
    }
}
