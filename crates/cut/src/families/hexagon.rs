//! The hexagon step cut: six sides, two of which run along the stone.
//!
//! Ranges are chosen: a regular hexagon has L/W 1.155 and points of 120 degrees; slopes and table are those of emerald cuts
//! (diamondcuttersintl.com).

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::steps::{self, StepPlaces, StepSide};
use super::{rows, step_rows};
use brillianteer_base::Unit;
use glam::DVec2;

const LENGTH: usize = 0;
const POINT: usize = 1;
const TABLE: usize = 2;
const CROWN_ROWS: usize = 3;
const CROWN: usize = 4;
const CROWN_STEP: usize = 5;
const PAVILION_ROWS: usize = 6;
const PAVILION: usize = 7;
const PAVILION_STEP: usize = 8;
const KEEL: usize = 9;
const GIRDLE: usize = 10;

const PLACES: StepPlaces = StepPlaces {
    table: TABLE,
    crown: [CROWN_ROWS, CROWN, CROWN_STEP],
    pavilion: [PAVILION_ROWS, PAVILION, PAVILION_STEP],
    girdle: GIRDLE,
};

/// The family of the hexagon step cut.
pub static HEXAGON: Family = Family {
    key: "hexagon",
    name: "Hexagon step cut",
    first: FamilyCut::first(&HEXAGON, &[1.4, 120.0, 60.0, 2.0, 34.0, 10.0, 3.0, 45.0, 8.0, 100.0, 3.0]),
    net: Some(net),
    depth: Some(|cut| PLACES.profile(cut, 1.0).depth()),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.15, 2.0]),
        Proportion {
            key: "point_angle",
            name: "Point angle",
            unit: Unit::Degrees,
            of: "between the two sides of a point",
            meaning: "The angle of the outline at either end of the stone.",
            usual: [100.0, 140.0],
            least: Bound::at(Fixed(40.0), "the sharpest point allowed"),
            most: Bound::at(Fixed(175.0), "the bluntest point allowed"),
            ..number::<POINT>()
        },
        rows::table::<TABLE>([50.0, 75.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([26.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        step_rows::pavilion_rows::<PAVILION_ROWS>(),
        step_rows::pavilion::<PAVILION>([40.0, 52.0]),
        step_rows::pavilion_step::<PAVILION_STEP>(),
        step_rows::keel::<KEEL>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::step_depth([58.0, 76.0]),
    ],
};

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let (length, keel) = (cut[LENGTH], cut[KEEL] / 100.0);
    // This is the length of a point beyond the ends of the straight sides.
    let point = 1.0 / (0.5 * cut[POINT]).to_radians().tan();
    if point >= length {
        return Err(NoRoom { tier: "girdle" });
    }
    // With this keel, the sides of the points are as steep as those along the stone.
    let even = DVec2::new(0.0, (length - point.hypot(1.0)).max(0.0));
    let to = |x: f64, y: f64, through| StepSide::toward(DVec2::new(x, y), through, even, even * keel);
    let (side, tip) = (DVec2::X, DVec2::new(0.0, length));
    let sides = [
        to(1.0, 0.0, side),
        to(point, 1.0, tip),
        to(-point, 1.0, tip),
        to(-1.0, 0.0, -side),
        to(-point, -1.0, -tip),
        to(point, -1.0, -tip),
    ];
    steps::net(&sides, PLACES.profile(cut, 1.0))
}
