//! Glass shapes: what spectral refraction is shown on, beside gems.
//!
//! Lengths are percent of the design's diameter, as with stones; z is toward the eye of the view face up. What is sharp all
//! over is a solid between planes like any stone; anything rounded is a smooth one.

use crate::math::{ImplicitForm, ImplicitSurface, ImplicitSurfaceError, Plane};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A glass shape with its dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Glass {
    /// A stadium with rounded edges.
    Pill(Sides),
    /// A box, as a cube has it with three equal sides.
    Cube(Sides),
    /// An isosceles triangle across, its apex toward the eye, drawn out along x.
    Prism(Sides),
    /// A plate whose middle waves.
    Plate(Plate),
}

/// Outer dimensions, percent of the diameter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sides {
    /// Along x.
    pub length: f64,
    /// Along y; of a prism its base.
    pub width: f64,
    /// Along z; of a prism its height.
    pub depth: f64,
    /// Radius of the edges.
    pub edge: f64,
}

/// A plate, as thick as it is deep wherever it is measured along z.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plate {
    /// Along x, percent of the diameter.
    pub length: f64,
    /// Along y.
    pub width: f64,
    /// Thickness, along z.
    pub depth: f64,
    /// Radius of the edges.
    pub edge: f64,
    /// How far the middle rises and falls.
    pub amplitude: f64,
    /// From crest to crest, along x and along y.
    pub wavelength: f64,
    /// Where the wave begins, degrees.
    #[serde(default)]
    pub phase: f64,
}

/// One number of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimension {
    /// Its key in a cut file.
    pub key: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// What it is measured in.
    pub unit: &'static str,
    /// From where to where a slider takes it.
    pub range: [f64; 2],
}

/// Why there is no such shape.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key}: {message}")]
pub struct GlassError {
    /// The dimension at fault.
    pub key: &'static str,
    /// What is wrong with it.
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
    /// The shapes in the dimensions that they are first shown in: their key, what they are called, themselves.
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

    /// Its key in a cut file, and what it is called.
    pub fn called(&self) -> (&'static str, &'static str) {
        let same = |other: &Self| std::mem::discriminant(self) == std::mem::discriminant(other);
        Self::ALL
            .iter()
            .find(|(.., other)| same(other))
            .map_or(("glass", "Glass"), |(key, name, _)| (key, name))
    }

    /// Its numbers, to be read and set.
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

    /// The shape with `unit` for each percent.
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

    /// The shape's function, in girdle radii.
    ///
    /// # Errors
    /// The dimension at fault, in the unit in which it is written.
    pub fn field(&self) -> Result<ImplicitSurface, GlassError> {
        // Checked in percent, so that what is told is what was written.
        ImplicitSurface::new(self.form(1.0))
            .and_then(|_| ImplicitSurface::new(self.form(0.02)))
            .map_err(in_percent)
    }

    /// Its faces with their names, where all of it is flat and sharp.
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
        // The last of its facets are the edges, which have no extent.
        Some((0..).zip(field.facets()).filter_map(plane).collect())
    }
}

/// What is wrong, by the key at fault.
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
