//! The cuts that come with the program as the chooser offers them, each with a line drawing made of its stone.

use brillianteer_cut::{BY_TIERS, GROUPS};
use brillianteer_files::{cut_file, library};
use brillianteer_math::{Basis, Edge, SolidRef};
use brillianteer_scene::Specimen;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// A cut that comes with the program.
#[derive(Debug)]
pub struct LibraryCut {
    /// The name by which the library finds the cut.
    pub key: &'static str,
    /// The name that people read.
    pub title: String,
    /// The place where the cut is published, or a short description of it.
    pub about: String,
    /// The place of its group among [`GROUPS`].
    pub group: usize,
    /// Straight lines: the crown seen from above, or the side of a stone that is higher than wide. The stone is centred and
    /// reaches 1 along the longer of both axes; y points up.
    pub lines: Vec<[DVec2; 2]>,
}

/// Facets whose normals have a greater cosine than this are one in a drawing.
const SAME_FACET: f64 = 0.9999;

/// A facet that faces the eye by less than this is seen edge on: the rounding of a unit normal.
const EDGE_ON: f64 = 1e-9;

/// The number of corners in the outline of a smooth shape.
const OUTLINE: usize = 96;

/// Returns all cuts, in the order of the library. They are built and drawn once.
pub fn library_cuts() -> &'static [LibraryCut] {
    static CUTS: OnceLock<Vec<LibraryCut>> = OnceLock::new();
    CUTS.get_or_init(|| library::CUTS.iter().filter_map(|(key, text)| library_cut(key, text)).collect())
}

/// Returns a cut of the library; `None` if its file makes no stone, which a test rules out.
fn library_cut(key: &'static str, text: &str) -> Option<LibraryCut> {
    let design = cut_file::parse(text, key).ok()?;
    let family = design.cut.family().map_or(BY_TIERS, |family| family.key);
    let group = GROUPS.iter().position(|(_, families)| families.contains(&family))?;
    let (title, source) = (design.name.clone(), design.source.clone());
    let specimen = Specimen::new(design).ok()?;
    let about = source.unwrap_or_else(|| "A cut that comes with the program.".to_owned());
    Some(LibraryCut { key, title, about, group, lines: lines(specimen.solid()) })
}

/// Returns the lines of a solid, scaled and centred.
fn lines(solid: SolidRef<'_>) -> Vec<[DVec2; 2]> {
    let (low, high) = solid.bounds();
    let size = high - low;
    let is_tall = size.z > size.x.max(size.y);
    let side = Basis { right: DVec3::X, up: DVec3::Z, toward: DVec3::NEG_Y };
    let basis = if is_tall { side } else { Basis::FACE_UP };
    let half = (basis.project(high) - basis.project(low)).abs().max_element() / 2.0;
    let middle = basis.project(low + high) / 2.0;
    let place = |point: DVec3| (basis.project(point) - middle) / half.max(f64::MIN_POSITIVE);
    match solid {
        SolidRef::Smooth(_) => outline(solid, basis).into_iter().map(|ends| ends.map(place)).collect(),
        SolidRef::Convex(_) | SolidRef::Triangles(_) => {
            let is_drawn = |edge: &Edge| {
                let [a, b] = edge.normals;
                a.dot(b) < SAME_FACET && [a, b].iter().any(|normal| normal.dot(basis.toward) > EDGE_ON)
            };
            solid.edges().into_iter().filter(is_drawn).map(|edge| edge.ends.map(place)).collect()
        }
    }
}

/// Returns the outline of a smooth shape as a polygon of its outermost corners.
fn outline(solid: SolidRef<'_>, basis: Basis) -> Vec<[DVec3; 2]> {
    let outermost = |step: usize| {
        let (sin, cos) = (TAU * step as f64 / OUTLINE as f64).sin_cos();
        let out = basis.right * cos + basis.up * sin;
        solid.vertices().iter().copied().max_by(|a, b| a.dot(out).total_cmp(&b.dot(out)))
    };
    let corners: Vec<DVec3> = (0..OUTLINE).filter_map(outermost).collect();
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| [*a, *b]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cut_of_the_library_is_offered_with_a_drawing_that_fills_its_square() {
        let cuts = library_cuts();
        assert_eq!(cuts.len(), library::CUTS.len());
        for LibraryCut { key, lines, .. } in cuts {
            let reach = lines.iter().flatten().map(|end| end.abs().max_element()).fold(0.0, f64::max);
            // Smooth shapes are drawn by points of their surface.
            assert!((reach - 1.0).abs() < 5e-3 && lines.len() >= 4, "{key}: {reach}, {} lines", lines.len());
        }
    }

    #[test]
    fn a_brilliant_shows_its_crown_and_a_briolette_its_side() {
        let cut = |key: &str| library_cuts().iter().find(|cut| cut.key == key).unwrap();
        let extent = |key: &str| {
            let ends = || cut(key).lines.iter().flatten();
            ends().fold(DVec2::ZERO, |most, end| most.max(end.abs()))
        };
        // 8 sides of the table, 16 of stars, 8 between halves, 16 of bezels, and the girdle's upper edge of 96.
        assert_eq!(cut("tolkowsky").lines.len(), 8 + 16 + 8 + 16 + 96);
        assert!((extent("briolette").x - 1.0 / 1.8).abs() < 0.02, "{}", extent("briolette"));
    }
}
