//! Glass shapes, on which spectral refraction is shown beside gems.
//!
//! Lengths are percent of the design's diameter, as with stones; +z points to the eye of the view face up. A cube or prism
//! with sharp edges is a solid between planes like any stone; every other shape is a smooth solid.

use crate::math::{ImplicitForm, ImplicitSurface, ImplicitSurfaceError, Plane};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A glass shape with its dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plate {
    /// The length along x.
    pub length: f64,
    /// The width along y.
    pub width: f64,
    /// The thickness along z.
    pub depth: f64,
    /// The radius of the edges; 0 is sharp.
    pub edge: f64,
    /// The height of the wave's crests, and the depth of its troughs.
    pub amplitude: f64,
    /// The distance from crest to crest, along x and along y.
    pub wavelength: f64,
    /// The phase at which the wave begins, degrees.
    #[serde(default)]
    pub phase: f64,
}

/// The description of one number of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimension {
    /// The number's key in a cut file.
    pub key: &'static str,
    /// The meaning of the number, in words.
    pub meaning: &'static str,
    /// The unit of the number, as written after it.
    pub unit: &'static str,
    /// The least and greatest value that a slider gives it.
    pub range: [f64; 2],
}

/// The reason why a shape cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key}: {message}")]
pub struct GlassError {
    /// The dimension at fault.
    pub key: &'static str,
    /// What is wrong with that dimension, and what is expected.
    pub message: String,
}

const fn dimension(
    key: &'static str,
    unit: &'static str,
    range: [f64; 2],
    meaning: &'static str,
) -> Dimension {
    Dimension { key, meaning, unit, range }
}

const LENGTH: Dimension = dimension("length", " %", [2.0, 200.0], "From left to right, along x.");
const WIDTH: Dimension = dimension("width", " %", [2.0, 200.0], "From front to back, along y.");
const DEPTH: Dimension =
    dimension("depth", " %", [2.0, 200.0], "Toward the eye of the view face up, along z.");
const EDGE: Dimension = dimension("edge", " %", [0.0, 50.0], "Radius of the edges; 0 is sharp.");
const AMPLITUDE: Dimension = dimension("amplitude", " %", [0.0, 30.0], "How far the middle rises and falls.");
const WAVELENGTH: Dimension =
    dimension("wavelength", " %", [5.0, 250.0], "From crest to crest, along x and along y.");
const PHASE: Dimension = dimension("phase", "°", [-360.0, 360.0], "Where the wave begins.");

impl Glass {
    /// All shapes with their default dimensions: the key in a cut file, the name that people read, and the shape.
    pub const ALL: [(&str, &str, Self); 4] = [
        ("pill", "Pill", Self::Pill(Sides { length: 100.0, width: 28.75, depth: 15.5, edge: 7.75 })),
        ("prism", "Prism", Self::Prism(Sides { length: 100.0, width: 37.9, depth: 29.8, edge: 0.0 })),
        ("cube", "Cube", Self::Cube(Sides { length: 100.0, width: 100.0, depth: 100.0, edge: 19.0 })),
        (
            "plate",
            "Wavy plate",
            Self::Plate(Plate {
                length: 100.0,
                width: 100.0,
                depth: 17.4,
                edge: 3.0,
                amplitude: 4.9,
                wavelength: 154.6,
                phase: 0.0,
            }),
        ),
    ];

    /// Returns the shape's key in a cut file, and the name that people read.
    pub fn called(&self) -> (&'static str, &'static str) {
        let same = |other: &Self| std::mem::discriminant(self) == std::mem::discriminant(other);
        Self::ALL
            .iter()
            .find(|(.., other)| same(other))
            .map_or(("glass", "Glass"), |(key, name, _)| (key, name))
    }

    /// Returns the shape's numbers with their descriptions, to be read and set.
    pub fn dimensions(&mut self) -> Vec<(Dimension, &mut f64)> {
        match self {
            Self::Pill(sides) | Self::Cube(sides) | Self::Prism(sides) => {
                let Sides { length, width, depth, edge } = sides;
                vec![(LENGTH, length), (WIDTH, width), (DEPTH, depth), (EDGE, edge)]
            }
            Self::Plate(plate) => {
                let Plate { length, width, depth, edge, amplitude, wavelength, phase } = plate;
                vec![
                    (LENGTH, length),
                    (WIDTH, width),
                    (DEPTH, depth),
                    (EDGE, edge),
                    (AMPLITUDE, amplitude),
                    (WAVELENGTH, wavelength),
                    (PHASE, phase),
                ]
            }
        }
    }

    /// Returns the shape as an implicit form, `unit` long for each percent.
    fn form(&self, unit: f64) -> ImplicitForm {
        let size = |length: f64, width: f64, depth: f64| DVec3::new(length, width, depth) * unit;
        let sides = |s: &Sides| (size(s.length, s.width, s.depth), s.edge * unit);
        match self {
            Self::Pill(s) => {
                let (size, edge) = sides(s);
                ImplicitForm::Pill { size, edge }
            }
            Self::Cube(s) => {
                let (size, edge) = sides(s);
                ImplicitForm::Block { size, edge }
            }
            Self::Prism(s) => {
                let (size, edge) = sides(s);
                ImplicitForm::Prism { size, edge }
            }
            Self::Plate(p) => ImplicitForm::Plate {
                size: size(p.length, p.width, p.depth),
                edge: p.edge * unit,
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
    pub fn field(&self) -> Result<ImplicitSurface, GlassError> {
        // First checked in percent, so that messages hold the numbers that were written.
        ImplicitSurface::new(self.form(1.0))
            .and_then(|_| ImplicitSurface::new(self.form(0.02)))
            .map_err(in_percent)
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

/// Converts an error of the implicit surface into one that names the key of the cut file.
fn in_percent(error: ImplicitSurfaceError) -> GlassError {
    let (key, message) = match error {
        ImplicitSurfaceError::Dimension { name, value } => {
            (key(name), format!("{value} % is no length; a number above 0 is expected"))
        }
        ImplicitSurfaceError::Number { name, value } => {
            (key(name), format!("{value} must be a number from 0 up"))
        }
        ImplicitSurfaceError::Edge { edge, most } => {
            ("edge", format!("{edge} % is rounder than the shape has room for, {most:.4} %"))
        }
        ImplicitSurfaceError::Slope { .. } => ("amplitude", error.to_string()),
        ImplicitSurfaceError::Wavelength { wavelength, least } => (
            "wavelength",
            format!("{wavelength} % is too short; for so large a plate it must be {least:.4} % or more"),
        ),
    };
    GlassError { key, message }
}

fn key(name: &str) -> &'static str {
    match name {
        "the size along x" => "length",
        "the size along y" => "width",
        "the size along z" => "depth",
        "the edge's radius" => "edge",
        "the amplitude" => "amplitude",
        "the wavelength" => "wavelength",
        _ => "phase",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Polytope;

    #[test]
    fn every_shape_can_be_made_and_what_is_sharp_has_planes() {
        for (key, _, mut glass) in Glass::ALL {
            let field = glass.field().unwrap();
            assert_eq!(glass.called().0, key);
            let volume = field.volume();
            match glass.dimensions().into_iter().find(|(d, _)| d.key == "edge") {
                Some((_, edge)) => *edge = 0.0,
                None => panic!(),
            }
            let planes = glass.planes();
            assert_eq!(planes.is_some(), matches!(key, "cube" | "prism"), "{key}");
            if let Some(planes) = planes {
                let solid =
                    Polytope::from_planes(&planes.iter().map(|(_, p)| *p).collect::<Vec<_>>()).unwrap();
                assert!((solid.volume() - glass.field().unwrap().volume()).abs() < 1e-12);
                assert!(
                    solid.volume() >= volume - 1e-12 && planes.len() == if key == "cube" { 6 } else { 5 }
                );
            }
        }
    }

    #[test]
    fn what_cannot_be_is_told_by_its_key_in_percent() {
        for (_, _, glass) in Glass::ALL {
            let count = { glass }.dimensions().len();
            for k in 0..count {
                let mut bad = glass;
                let key = {
                    let (dimension, value) = bad.dimensions().swap_remove(k);
                    *value = f64::NAN;
                    dimension.key
                };
                assert_eq!(bad.field().unwrap_err().key, key);
            }
        }
        let mut cube = Glass::ALL[2].2;
        *cube.dimensions().swap_remove(3).1 = 51.0;
        assert_eq!(
            cube.field().unwrap_err().to_string(),
            "edge: 51 % is rounder than the shape has room for, 50.0000 %"
        );
    }
}
