//! Keeps docs/families.md current: the tables of all families whose facets a function makes, and the weights of their
//! first cuts.
//!
//! `BRILLIANTEER_RECORD=1 cargo test --release -p brillianteer-cut documented` writes the file.

use super::range_sources::range_source;
use super::tests::{Solid, made, on_random_cuts, stone};
use crate::{Bound, BoundAt, Family, Proportion, ProportionReport, SheetFigures};
use brillianteer_base::Unit;
use proptest::prelude::*;
use std::fmt::Write;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/families.md");

const BEGINNING: &str = "\
# Families of cuts

A cut file gives the numbers of a family in a table with the family's key, such as `[oval]`. This page is generated from the
tables in `crates/cut/src/families`, and a test keeps it current. [Formats](formats.md#cut-files) describes the rest of a cut file
and `[round_brilliant]`.

W is the [diameter](formats.md#diameter-length-and-width): of a round outline, that of the circle through its corners; of any
other, the shorter extent of the outline along x and y. (With a `length_to_width` below 1, which lies outside of the usual ranges
of all families but the heart, it stays the extent along x; of a heart it is always the shorter one.) Lengths are in percent of W unless the unit is named, and angles are
in degrees from the girdle plane. \"Usual\" is the range of the
editor's slider, with its source: \"published\" means that a page or a cutter's design gives it, \"ours\" that no source does.
\"Possible\" is the range that the program accepts, as long as the facets have room.

The key `length_to_width` is the extent of the outline along y, which is up in pictures, divided by that along x. Below 1, as the
trade has it of hearts, the stone is wider than long. (Of a briolette it is the length of the drop along its axis.) What is
measured of a stone is L/W, the longer extent divided by the shorter, so never below 1: in the table below, and the same in
`info`, in reports and on cutters' sheets.

All keys are required, except those that have a default and `total_depth`. The total depth follows from the other numbers, but
it can be set: the numbers that it moves then change by one factor (angles by that of their tangents, the tangent ratio) until
the stone has this depth. A file gives either `total_depth` or the numbers that it moves; with `total_depth`, these keep the
ratios of the cut's own file in `cuts/`. Where no stone has the depth, the message names the possible depths.

![All families of this page: facets, ASET, and a render under the studio light](images/contact-sheet.png)

The picture shows each family's first cut, in the order of the tables below, in diamond: its facets seen from above, its ASET,
and a render under the light `studio`. [`contact-sheet.sh`](images/contact-sheet.sh) makes it by the program's own commands.

## Where facets meet in points

Facets meet in points as on real stones: in no stone of these families do four facets nearly meet, apart from edges that real stones of
the cut have as well, which an [audit](formats.md#audit) lists as split meets where they are shorter than 12 % of W. Edges of a small
culet are as short as it is. The table of an Asscher or of a cushion barion has corners: below it a crown of one row has four or eight facets at the
corners of the outline, whose upper edges are 9.9 to 12 % of W long with the narrowest corners and the smallest tables of the usual ranges.

## What the families weigh

The trade estimates the weight of a set diamond from its dimensions in mm: carats = length · width · depth · k. Diamond has
0.017575 carats per cubic millimetre, so k / 0.017575 is the filled share of the box around the stone, whose sides are length,
width and depth. The trade's k are for thin to medium girdles; thick girdles, high shoulders and bulging pavilions add up to
10 % each.

| family | facets without the girdle | L/W, measured | depth, % of W | volume / (L W D) | the trade's | why it differs |
|---|---|---|---|---|---|---|
";

/// The trade's factor k of a family at the length to width of its first cut, its source, and the reason why the first
/// cut differs.
const TRADE: [(&str, f64, &str, &str); 9] = [
    (
        "oval",
        0.0062 * 1.44 / 1.4,
        "esslinger.com: 0.0062 times the square of the mean of length and width",
        "a stretched round brilliant fills its box as the round one does (0.0061, which is 0.347); the trade's shoulders are \
         fuller: a fullness of 2.3 makes 0.361",
    ),
    (
        "marquise",
        0.0058,
        "esslinger.com",
        "mains run straight from a thin girdle to one point; a girdle of 5 makes 0.323, fuller sides \
    (110) 0.318",
    ),
    (
        "pear",
        0.00594,
        "esslinger.com",
        "the same as for the marquise; a girdle of 5 makes 0.333, fuller shoulders (110) 0.325",
    ),
    ("heart", 0.0059, "esslinger.com", ""),
    (
        "trillion",
        0.0057,
        "esslinger.com: triangle",
        "corners far from the culet are shallow; a bulge of 12 makes 0.311, a girdle of 6 0.312",
    ),
    ("emerald", 0.0086 + 0.8 * (0.009_26 - 0.0086), GEMWEST, ""),
    ("asscher", 0.0080, GEMWEST, "the trade's number is for square emerald cuts"),
    ("baguette", 0.0100, GEMWEST, "the trade's number is for emerald cuts of the same length to width"),
    ("radiant", 0.0081 + 0.4 * (0.0084 - 0.0081), GEMWEST, ""),
];

/// The source of the factors of long cuts. It gives them at a few lengths to width; between these they are
/// interpolated.
const GEMWEST: &str = "dnaldoog/Gemwest";

/// The carats of a cubic millimetre of diamond.
const CARATS: f64 = 0.017_575;

/// Returns the number of facets without the girdle, and the other figures of the row of weights, for a family's first
/// cut.
fn weight(family: &Family) -> String {
    let solid = Solid::of(&family.first).expect("the first cut is a stone");
    let size = solid.size;
    let facets = solid.tiers.iter().filter(|(tier, _)| *tier != "girdle").map(|(_, count)| count);
    let trade = TRADE.iter().find(|(key, ..)| *key == family.key);
    let trade = trade.map_or("none found | ".to_owned(), |(_, k, source, why)| {
        format!("{:.3} ({source}) | {why}", k / CARATS)
    });
    format!(
        "| [{}](#{}) | {} | {:.2} | {:.1} | {:.3} | {trade} |\n",
        family.name,
        family.key,
        facets.sum::<usize>(),
        size.truncate().max_element() / size.truncate().min_element(),
        // Half the diameter is 1.
        50.0 * size.z,
        solid.volume / (size.x * size.y * size.z),
    )
}

/// Writes a bound and the reason for it.
fn bound(word: [&str; 2], bound: Option<Bound>) -> Option<String> {
    let Bound { at, inclusive, reason } = bound?;
    let BoundAt::Fixed(at) = at else { return Some(format!("a limit that depends on other keys: {reason}")) };
    Some(format!("{} {at} ({reason})", if inclusive { word[0] } else { word[1] }))
}

fn row(family: &Family, row: &Proportion) -> String {
    let unit = match row.unit {
        Unit::Count => "whole number".to_owned(),
        _ => row.hint(),
    };
    let bounds = [bound(["from", "above"], row.least), bound(["to", "below"], row.most)];
    let bounds = match row.moves.is_empty() {
        true => bounds.into_iter().flatten().collect::<Vec<_>>().join(", "),
        false => "limits that depend on the numbers that it moves".to_owned(),
    };
    let moved: Vec<String> = row.moves.iter().map(|key| format!("`{key}`")).collect();
    let moved = match moved.as_slice() {
        [] => String::new(),
        [moved] => format!(" Setting it moves {moved}; a file may give it in its place."),
        moved => format!(" Setting it moves {}; a file may give it in their place.", moved.join(" and ")),
    };
    let default = row.default.map_or(String::new(), |value| format!(" Default {value}."));
    let [least, most] = row.usual;
    // Derived numbers have more digits than a reader needs.
    let value = (1e4 * (row.get)(&family.first)).round() / 1e4;
    let source = range_source(family, row).unwrap_or_default();
    format!(
        "| `{}` | {unit} | {least} to {most} | {source} | {bounds} | {value} | {}{moved}{default} |\n",
        row.key, row.meaning
    )
}

fn section(family: &'static Family) -> String {
    let mut text = format!("\n## {}\n\n", family.key);
    let _ = write!(text, "{}. The table is `[{}]`.\n\n", family.name, family.key);
    text.push_str("| key | unit | usual | where that comes from | possible | first | meaning |\n|---|---|---|---|---|---|---|\n");
    family.settable().for_each(|given| text.push_str(&row(family, given)));
    let derived = family.proportions.iter().filter(|row| !row.can_be_set());
    let derived: Vec<String> =
        derived.map(|row| format!("`{}` ({}): {}", row.key, row.hint(), row.meaning)).collect();
    if !derived.is_empty() {
        let _ = write!(text, "\nThese follow: {}\n", derived.join(" "));
    }
    let solid = Solid::of(&family.first).expect("the first cut is a stone");
    let tiers: Vec<String> = solid.tiers.iter().map(|(tier, count)| format!("{count} `{tier}`")).collect();
    let _ = write!(text, "\nFacets of the first cut: {}.\n", tiers.join(", "));
    text
}

fn page() -> String {
    let mut text = BEGINNING.to_owned();
    made().for_each(|(family, _)| text.push_str(&weight(family)));
    made().for_each(|(family, _)| text.push_str(&section(family)));
    text
}

#[test]
fn the_page_of_families_is_current() {
    let page = page();
    if std::env::var_os("BRILLIANTEER_RECORD").is_some() {
        std::fs::write(FILE, &page).unwrap();
    }
    let found = std::fs::read_to_string(FILE).unwrap_or_default();
    let differs = page.lines().zip(found.lines()).find(|(new, old)| new != old);
    assert!(page == found, "write docs/families.md anew (BRILLIANTEER_RECORD=1); it differs at {differs:?}");
}

#[test]
fn length_to_width_is_one_number_of_a_family_in_info_on_sheets_and_on_the_page() {
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
    let page = page();
    let mut compared = 0;
    for (family, _) in made() {
        let Some((stone, names)) = stone(&family.first) else { continue };
        let line = page.lines().find(|line| line.starts_with(&format!("| [{}](", family.name))).unwrap();
        let printed: f64 = line.split('|').nth(3).unwrap().trim().parse().unwrap();
        let info = ProportionReport::of(&stone, &names).length_to_width;
        assert!((printed - info).abs() < 0.005 + 1e-9, "{}: {printed}, and {info} in info", family.key);
        compared += 1;
    }
    // A heart alone is not convex.
    assert_eq!(compared, made().count() - 1);
    let trillion = Family::of_key("trillion").unwrap();
    assert!((trillion.proportion("length_to_width").unwrap().get)(&trillion.first) > 1.04, "no square stone");
}

#[test]
fn every_usual_range_has_a_source() {
    let missing = made().flat_map(|(family, _)| {
        let rows = family.settable().filter(|row| range_source(family, row).is_none_or(str::is_empty));
        rows.map(|row| (family.key, row.key))
    });
    assert_eq!(missing.collect::<Vec<_>>(), []);
    // The search finds nothing for a name that no family has.
    let (oval, table) =
        (Family::of_key("oval").unwrap(), Family::of_key("oval").unwrap().proportion("table").unwrap());
    let unknown = Proportion { key: "no_such_number", ..Proportion::BLANK };
    assert!(range_source(oval, table).is_some() && range_source(oval, &unknown).is_none());
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
    for (key, k, ..) in TRADE {
        let solid = Solid::of(&Family::of_key(key).unwrap().first).unwrap();
        let share = solid.volume / solid.size.element_product();
        assert!((share * CARATS / k - 1.0).abs() < 0.11, "{key}: {share} for {}", k / CARATS);
    }
}
