//! The princess cut: a square brilliant with bevelled corners. Its pavilion has mains in an X and rows of chevrons.
//!
//! Ranges: the crown has two mains a side, stars at an azimuth of 6 degrees and equal widths at mid-side (B. Harding,
//! on the AGS's model); 2, 3 or 4 rows of chevrons (briangavindiamonds.com); table 60 to 80, total depth 65 to 80
//! percent (brilliancelab). No figures are published for the mains' angles; those here give crowns 8 to 15 percent
//! high. In addition to its chevrons, each side has one facet along the girdle, because a level girdle does not allow
//! two.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::chevrons::{Chevrons, StarCrown};
use super::steps::{self, Rectangle};
use super::{rows, step_rows};
use brillianteer_base::Unit;

const LENGTH: usize = 0;
const CORNER: usize = 1;
const TABLE: usize = 2;
const MAIN_1: usize = 3;
const MAIN_2: usize = 4;
const STAR_AZIMUTH: usize = 5;
const CHEVRONS: usize = 6;
const DEPTH: usize = 7;
const STEP: usize = 8;
const SHOULDER: usize = 9;
const GIRDLE: usize = 10;
const CULET: usize = 11;

/// The family of the princess cut.
pub static PRINCESS: Family = Family {
    key: "princess",
    name: "Princess cut",
    first: FamilyCut::first(&PRINCESS, &[1.0, 2.0, 70.0, 38.0, 26.0, 6.0, 3.0, 57.0, 7.0, 30.0, 3.0, 0.0]),
    net: Some(net),
    depth: Some(depth),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.3]),
        step_rows::corner::<CORNER>([1.0, 5.0]),
        rows::table::<TABLE>([60.0, 80.0]),
        Proportion {
            meaning: "The angle between the girdle plane and those mains of the sides that begin at the girdle.",
            ..rows::slope::<MAIN_1>("main_1_angle", "First mains", [32.0, 46.0])
        },
        Proportion {
            meaning: "The angle between the girdle plane and those mains of the sides that reach the table.",
            ..rows::slope::<MAIN_2>("main_2_angle", "Second mains", [18.0, 30.0])
        },
        star_azimuth::<STAR_AZIMUTH>([4.0, 9.0]),
        chevrons::<CHEVRONS>(),
        pavilion_depth::<DEPTH>([50.0, 64.0]),
        chevron_step::<STEP>(),
        shoulder::<SHOULDER>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
        rows::chevron_depth([65.0, 80.0]),
    ],
};

/// Returns the row for the azimuth of the stars.
pub(super) const fn star_azimuth<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        key: "star_azimuth",
        name: "Star azimuth",
        unit: Unit::Degrees,
        of: "from the direction of the end of the stone",
        meaning: "The angle by which each of the two stars of an end turns away from the direction of the end; 0 would be a table with straight sides.",
        usual,
        least: Bound::before(Fixed(0.0), "where both stars of a side would be one"),
        most: Bound::before(Fixed(45.0), "where the table's corners would vanish"),
        ..number::<PLACE>()
    }
}

/// Returns the row for the number of rows of chevrons.
pub(super) const fn chevrons<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The number of rows of chevrons, pairs of facets that form a V, on each side of the pavilion.",
        ..step_rows::count::<PLACE>(
            "chevrons",
            "Chevrons",
            [2.0, 4.0],
            ["the fewest rows of any such cut", "the most rows of any such cut"],
        )
    }
}

/// Returns the row for the depth of the pavilion.
pub(super) const fn pavilion_depth<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The depth of the mains' point below the girdle, in percent of the width of the stone.",
        least: Bound::at(Fixed(2.0), "the shallowest pavilion allowed"),
        most: Bound::at(Fixed(300.0), "the deepest pavilion allowed"),
        ..rows::of_width::<PLACE>("pavilion_depth", "Pavilion depth", usual)
    }
}

/// Returns the row for the angle between neighbouring chevrons.
pub(super) const fn chevron_step<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The angle by which each row of the pavilion is steeper than the next inner row, along the middle of a side.",
        ..step_rows::step::<PLACE>("chevron_step", "Chevron step", [4.0, 9.0])
    }
}

/// Returns the row for the width of the mains.
pub(super) const fn shoulder<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The distance from the middle at which neighbouring mains touch and the chevrons begin, along the middle of a side.",
        ..rows::part::<PLACE>(
            "shoulder",
            "Main shoulders",
            "of the way from the middle to the girdle",
            [18.0, 40.0],
        )
    }
}

fn depth(cut: &FamilyCut) -> f64 {
    let mains: f64 = [MAIN_1, MAIN_2].map(|main| cut[main].to_radians().tan()).iter().sum();
    let crown = 0.5 * (1.0 - cut[TABLE] / 100.0) * mains;
    crown + (cut[GIRDLE] + cut[DEPTH] * (1.0 - cut[CULET] / 100.0)) / 50.0
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let outline = Rectangle { length: cut[LENGTH], corner: cut[CORNER] / 50.0, keel: 1.0 };
    let thickness = cut[GIRDLE] / 50.0;
    let crown = StarCrown {
        table: cut[TABLE] / 100.0,
        mains: [MAIN_1, MAIN_2].map(|main| cut[main].to_radians().tan()),
        star_azimuth: cut[STAR_AZIMUTH].to_radians(),
        has_divided_corners: false,
    };
    let pavilion = Chevrons {
        count: cut[CHEVRONS] as usize,
        depth: cut[DEPTH] / 50.0,
        step: cut[STEP],
        shoulder: cut[SHOULDER] / 100.0,
        corner_step: None,
        culet: cut[CULET] / 100.0,
    };
    let mut net = FacetNet::default();
    crown.add_to(&mut net, &outline, -0.5 * thickness)?;
    steps::add_girdle(&mut net, &outline.sides(), thickness);
    pavilion.add_to(&mut net, &outline, thickness)?;
    Ok(net)
}
