//! The tables of the dimensions of glass shapes.

use super::Cut;
use super::family::BoundAt::{Fixed, Of};
use super::family::{Bound, Family, Proportion};
use super::glass::{Glass, Plate, Sides};
use brillianteer_base::Unit;
use brillianteer_math::{MOST_WAVES, STEEPEST};
use std::f64::consts::TAU;

/// The least and the greatest length, percent: far enough apart for every use, and such that squares of their
/// quotients keep their digits.
const LENGTHS: [f64; 2] = [1e-4, 1e7];
/// The greatest phase, degrees: ten thousand turns.
const MOST_PHASE: f64 = 3.6e6;

/// The row of lengths, without the properties in which they differ.
const SIDE: Proportion = Proportion {
    of: "of the diameter",
    usual: [2.0, 200.0],
    step: 0.0,
    speed: 0.05,
    least: Bound::at(Fixed(LENGTHS[0]), "the smallest dimension allowed"),
    most: Bound::at(Fixed(LENGTHS[1]), "the largest dimension allowed"),
    ..Proportion::BLANK
};

const LENGTH: Proportion = Proportion {
    key: "length",
    name: "Length",
    meaning: "The size from left to right, along x.",
    get: |cut| side(cut, |s| s.length),
    give: Some(|cut, v| give_side(cut, |s| s.length = v)),
    ..SIDE
};
const WIDTH: Proportion = Proportion {
    key: "width",
    name: "Width",
    meaning: "The size from front to back, along y.",
    get: |cut| side(cut, |s| s.width),
    give: Some(|cut, v| give_side(cut, |s| s.width = v)),
    ..SIDE
};
const DEPTH: Proportion = Proportion {
    key: "depth",
    name: "Depth",
    meaning: "The size along z, toward the eye of the view face up.",
    get: |cut| side(cut, |s| s.depth),
    give: Some(|cut, v| give_side(cut, |s| s.depth = v)),
    ..SIDE
};
const EDGE: Proportion = Proportion {
    key: "edge",
    name: "Edge",
    meaning: "Radius of the edges; 0 is sharp.",
    usual: [0.0, 50.0],
    least: Bound::at(Fixed(0.0), "a sharp edge"),
    most: Bound::at(
        Of(|cut| glass(cut).map_or(f64::NAN, |g| g.form(1.0).largest_edge())),
        "for which the shape has room",
    ),
    get: |cut| side(cut, |s| s.edge),
    give: Some(|cut, v| give_side(cut, |s| s.edge = v)),
    ..SIDE
};
const AMPLITUDE: Proportion = Proportion {
    key: "amplitude",
    name: "Amplitude",
    meaning: "The distance by which the middle of the plate rises and falls.",
    usual: [0.0, 30.0],
    least: Bound::at(Fixed(0.0), "a plate without waves"),
    most: Bound::at(
        Of(|cut| wave(cut, |p| STEEPEST * p.wavelength / TAU)),
        "where the wave is as steep as 8 to 1; a longer wavelength makes it less steep",
    ),
    get: |cut| wave(cut, |p| p.amplitude),
    give: Some(|cut, v| give_wave(cut, |p| p.amplitude = v)),
    ..SIDE
};
const WAVELENGTH: Proportion = Proportion {
    key: "wavelength",
    name: "Wavelength",
    meaning: "The distance from crest to crest, along x and along y.",
    usual: [5.0, 250.0],
    least: Bound::at(
        Of(|cut| wave(cut, |p| (p.sides.length.max(p.sides.width) / MOST_WAVES).max(LENGTHS[0]))),
        "the shortest wave of so large a plate",
    ),
    get: |cut| wave(cut, |p| p.wavelength),
    give: Some(|cut, v| give_wave(cut, |p| p.wavelength = v)),
    ..SIDE
};
const PHASE: Proportion = Proportion {
    key: "phase",
    name: "Phase",
    unit: Unit::Degrees,
    of: "at which the wave begins",
    meaning: "The place where the wave begins.",
    usual: [-360.0, 360.0],
    least: Bound::at(Fixed(-MOST_PHASE), "ten thousand turns"),
    most: Bound::at(Fixed(MOST_PHASE), "ten thousand turns"),
    default: Some(0.0),
    get: |cut| wave(cut, |p| p.phase),
    give: Some(|cut, v| give_wave(cut, |p| p.phase = v)),
    ..SIDE
};

const SIDES: &[Proportion] = &[LENGTH, WIDTH, DEPTH, EDGE];

/// The family of pills.
pub static PILL: Family =
    of_sides("pill", "Pill", Glass::Pill(Sides { length: 100.0, width: 28.75, depth: 15.5, edge: 7.75 }));
/// The family of cubes and other boxes.
pub static CUBE: Family =
    of_sides("cube", "Cube", Glass::Cube(Sides { length: 100.0, width: 100.0, depth: 100.0, edge: 19.0 }));
/// The family of prisms.
pub static PRISM: Family =
    of_sides("prism", "Prism", Glass::Prism(Sides { length: 100.0, width: 37.9, depth: 29.8, edge: 0.0 }));
/// The family of plates.
pub static PLATE: Family = Family {
    key: "plate",
    name: "Wavy plate",
    proportions: &[LENGTH, WIDTH, DEPTH, EDGE, AMPLITUDE, WAVELENGTH, PHASE],
    net: None,
    depth: None,
    first: Cut::Glass(Glass::Plate(Plate {
        sides: Sides { length: 100.0, width: 100.0, depth: 17.4, edge: 3.0 },
        amplitude: 4.9,
        wavelength: 154.6,
        phase: 0.0,
    })),
};

const fn of_sides(key: &'static str, name: &'static str, first: Glass) -> Family {
    Family { key, name, proportions: SIDES, first: Cut::Glass(first), net: None, depth: None }
}

fn glass(cut: &Cut) -> Option<&Glass> {
    if let Cut::Glass(glass) = cut { Some(glass) } else { None }
}

fn side(cut: &Cut, read: fn(&Sides) -> f64) -> f64 {
    glass(cut).map_or(f64::NAN, |glass| read(glass.sides()))
}

fn wave(cut: &Cut, read: fn(&Plate) -> f64) -> f64 {
    if let Some(Glass::Plate(plate)) = glass(cut) { read(plate) } else { f64::NAN }
}

fn give_side(cut: &mut Cut, write: impl FnOnce(&mut Sides)) {
    if let Cut::Glass(
        Glass::Pill(sides) | Glass::Cube(sides) | Glass::Prism(sides) | Glass::Plate(Plate { sides, .. }),
    ) = cut
    {
        write(sides);
    }
}

fn give_wave(cut: &mut Cut, write: impl FnOnce(&mut Plate)) {
    if let Cut::Glass(Glass::Plate(plate)) = cut {
        write(plate);
    }
}
