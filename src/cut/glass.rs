//! Glass shapes, on which spectral refraction is shown beside gems.
//!
//! Lengths are percent of the design's diameter, as with stones; +z points to the eye of the view face up. A cube or prism
//! with sharp edges is a solid between planes like any stone; every other shape is a smooth solid.

use super::Cut;
use super::ProportionError;
use super::family::BoundAt::{Fixed, Of};
use super::family::{Bound, Family, Proportion, Unit};
use crate::math::{ImplicitForm, ImplicitSurface, MOST_WAVES, Plane, STEEPEST};
use glam::DVec3;
use std::f64::consts::TAU;

/// A glass shape with its dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Glass {
    /// A stadium with rounded edges.
    Pill(Sides),
    /// A box; with three equal sides a cube.
    Cube(Sides),
    /// A prism along x, whose cross-section is an isosceles triangle with its apex toward the eye.
    Prism(Sides),
    /// A plate whose middle waves.
    Plate(Plate),
}

/// Outer dimensions, percent of the diameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sides {
    /// The length along x.
    pub length: f64,
    /// The width along y; of a prism its base.
    pub width: f64,
    /// The depth along z; of a prism its height.
    pub depth: f64,
    /// The radius of the edges; 0 is sharp.
    pub edge: f64,
}

/// A plate whose middle waves. Lengths are percent of the diameter. Measured along z it has the same thickness everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plate {
    /// The outer dimensions of the plate without its wave.
    pub sides: Sides,
    /// The height of the wave's crests, and the depth of its troughs.
    pub amplitude: f64,
    /// The distance from crest to crest, along x and along y.
    pub wavelength: f64,
    /// The phase at which the wave begins, degrees.
    pub phase: f64,
}

/// The least and the greatest length, percent: far enough apart for every use, and squares of their quotients keep digits.
const LENGTHS: [f64; 2] = [1e-4, 1e7];
/// The greatest phase, degrees: ten thousand turns.
const MOST_PHASE: f64 = 3.6e6;

/// What the rows of lengths have in common.
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
    meaning: "From left to right, along x.",
    get: |cut| side(cut, |s| s.length),
    give: Some(|cut, v| give_side(cut, |s| s.length = v)),
    ..SIDE
};
const WIDTH: Proportion = Proportion {
    key: "width",
    name: "Width",
    meaning: "From front to back, along y.",
    get: |cut| side(cut, |s| s.width),
    give: Some(|cut, v| give_side(cut, |s| s.width = v)),
    ..SIDE
};
const DEPTH: Proportion = Proportion {
    key: "depth",
    name: "Depth",
    meaning: "Toward the eye of the view face up, along z.",
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
    meaning: "How far the middle rises and falls.",
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
    meaning: "From crest to crest, along x and along y.",
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
    meaning: "Where the wave begins.",
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
pub static PILL: Family = Family {
    key: "pill",
    name: "Pill",
    proportions: SIDES,
    first: Cut::Glass(Glass::Pill(Sides { length: 100.0, width: 28.75, depth: 15.5, edge: 7.75 })),
};
/// The family of cubes and other boxes.
pub static CUBE: Family = Family {
    key: "cube",
    name: "Cube",
    proportions: SIDES,
    first: Cut::Glass(Glass::Cube(Sides { length: 100.0, width: 100.0, depth: 100.0, edge: 19.0 })),
};
/// The family of prisms.
pub static PRISM: Family = Family {
    key: "prism",
    name: "Prism",
    proportions: SIDES,
    first: Cut::Glass(Glass::Prism(Sides { length: 100.0, width: 37.9, depth: 29.8, edge: 0.0 })),
};
/// The family of plates.
pub static PLATE: Family = Family {
    key: "plate",
    name: "Wavy plate",
    proportions: &[LENGTH, WIDTH, DEPTH, EDGE, AMPLITUDE, WAVELENGTH, PHASE],
    first: Cut::Glass(Glass::Plate(Plate {
        sides: Sides { length: 100.0, width: 100.0, depth: 17.4, edge: 3.0 },
        amplitude: 4.9,
        wavelength: 154.6,
        phase: 0.0,
    })),
};

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

impl Glass {
    /// Returns the outer dimensions.
    pub fn sides(&self) -> &Sides {
        match self {
            Self::Pill(sides) | Self::Cube(sides) | Self::Prism(sides) | Self::Plate(Plate { sides, .. }) => {
                sides
            }
        }
    }

    /// Returns the shape as an implicit form, `unit` long for each percent.
    fn form(&self, unit: f64) -> ImplicitForm {
        let Sides { length, width, depth, edge } = *self.sides();
        let (size, edge) = (DVec3::new(length, width, depth) * unit, edge * unit);
        match self {
            Self::Pill(_) => ImplicitForm::Pill { size, edge },
            Self::Cube(_) => ImplicitForm::Block { size, edge },
            Self::Prism(_) => ImplicitForm::Prism { size, edge },
            Self::Plate(p) => ImplicitForm::Plate {
                size,
                edge,
                amplitude: p.amplitude * unit,
                wavelength: p.wavelength * unit,
                phase: p.phase.to_radians(),
            },
        }
    }

    /// Returns the shape's implicit surface, in girdle radii.
    ///
    /// # Errors
    /// The dimension at fault, in the unit in which it is written.
    pub fn field(&self) -> Result<ImplicitSurface, ProportionError> {
        Cut::Glass(*self).check().map(|()| ImplicitSurface::checked(self.form(0.02)))
    }

    /// Returns the faces with their names and planes; `None` unless all faces are flat and all edges sharp.
    pub fn planes(&self) -> Option<Vec<(String, Plane)>> {
        let (Self::Cube(sides) | Self::Prism(sides)) = self else { return None };
        if sides.edge != 0.0 {
            return None;
        }
        let field = self.field().ok()?;
        let surface = field.surface(1);
        let plane = |(group, name): (u32, &&str)| {
            let triangle = surface.triangles.iter().zip(&surface.groups).find(|(_, g)| **g == group)?.0;
            let [a, b, c] = triangle.map(|v| surface.vertices[v as usize]);
            let normal = field.normal((a + b + c) / 3.0);
            Some(((*name).to_owned(), Plane::new(normal, normal.dot(a))))
        };
        // The field's facets past the flat faces are its edges, which have no extent here.
        Some((0..).zip(field.facets()).filter_map(plane).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Polytope;

    fn families() -> impl Iterator<Item = (&'static Family, Glass)> {
        [&PILL, &CUBE, &PRISM, &PLATE].into_iter().map(|family| match family.first {
            Cut::Glass(glass) => (family, glass),
            _ => panic!("{} is no glass", family.key),
        })
    }

    /// Returns a shape with one dimension set.
    fn with(family: &Family, key: &str, value: f64) -> Glass {
        let mut cut = family.first.clone();
        family.proportion(key).unwrap().set(&mut cut, value);
        *glass(&cut).unwrap()
    }

    #[test]
    fn every_shape_can_be_made_and_what_is_sharp_has_planes() {
        for (family, glass) in families() {
            let volume = glass.field().unwrap().volume();
            let sharp = with(family, "edge", 0.0);
            let planes = sharp.planes();
            assert_eq!(planes.is_some(), ["cube", "prism"].contains(&family.key), "{}", family.key);
            if let Some(planes) = planes {
                let solid =
                    Polytope::from_planes(&planes.iter().map(|(_, p)| *p).collect::<Vec<_>>()).unwrap();
                assert!((solid.volume() - sharp.field().unwrap().volume()).abs() < 1e-12);
                let faces = if family.key == "cube" { 6 } else { 5 };
                assert!(solid.volume() >= volume - 1e-12 && planes.len() == faces);
            }
        }
    }

    #[test]
    fn impossible_dimensions_are_named_in_percent() {
        for (family, _) in families() {
            for row in family.proportions {
                let error = with(family, row.key, f64::NAN).field().unwrap_err();
                assert_eq!(error.row(), row);
            }
        }
        let told = |family, key, value| with(family, key, value).field().unwrap_err().to_string();
        assert_eq!(
            told(&CUBE, "edge", 51.0),
            "edge: 51 % must be at most 50 %, for which the shape has room; lower it by at least 1"
        );
        let mut still = Cut::Glass(with(&PLATE, "amplitude", 0.0));
        PLATE.proportion("wavelength").unwrap().set(&mut still, 0.3);
        let short = still.check().unwrap_err().to_string();
        assert!(
            short.starts_with("wavelength: 0.3 % must be at least 0.5 %, the shortest wave of so"),
            "{short}"
        );
        assert!(
            told(&PLATE, "amplitude", 300.0).starts_with("amplitude: 300 % must be at most 196.84 %, where")
        );
        assert!(
            told(&PILL, "length", -3.0).starts_with("length: -3 % must be at least 0.0001 %, the smallest")
        );
    }

    #[test]
    fn what_is_too_small_to_compute_with_is_told_in_percent_as_it_was_written() {
        // A length that is a possible number of girdle radii were it in percent, and an edge that rounding takes past
        // its room.
        let small = with(&CUBE, "depth", 2e-5).field().unwrap_err().to_string();
        assert!(small.starts_with("depth: 2e-5 % must be at least 0.0001 %"), "{small}");
        for k in 1..2000 {
            let sides =
                Sides { length: 100.0, width: 0.37 * f64::from(k), depth: 0.13 * f64::from(k), edge: 0.0 };
            let edge = Glass::Prism(sides).form(1.0).largest_edge();
            let field = Glass::Prism(Sides { edge, ..sides }).field();
            assert!(field.is_ok_and(|field| field.volume() > 0.0), "{k}");
        }
    }
}
