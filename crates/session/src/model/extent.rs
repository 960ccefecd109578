//! The extent of a stone seen from above, by which its size is stated.

use brillianteer_cut::{Cut, Design, Outline, Tiers, round_diameter};
use brillianteer_math::{Calipers, hull};
use brillianteer_scene::{Body, Specimen, Stone};
use glam::DVec3;

/// The extent of a stone seen from above, in the unit of its frame (half the diameter).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The greater of the two sides.
    pub length: f64,
    /// The smaller of the two sides.
    pub width: f64,
    /// True where the diameter alone states the size: see [`Outline::diameter`].
    pub is_round: bool,
}

/// Returns the unit of a design's own distances, in the unit of its stone's frame; `None` where the design makes no stone.
///
/// Designs of tiers are scaled to their diameter; all others use the unit of the frame.
pub fn unit(design: &Design) -> Option<f64> {
    let Cut::Tiers(_) = design.cut else { return Some(1.0) };
    let mut facets = design.facets().ok()?;
    let stone = Stone::new(&facets).or_else(|_| {
        facets.extend(Tiers::block());
        Stone::new(&facets)
    });
    Some(2.0 / Outline::of(&stone.ok()?.polytope).diameter)
}

impl Extent {
    /// Measures a stone, with or without facets.
    ///
    /// Length and width are those of [`Outline`]; of glass, they are the sides of its box.
    pub fn of(specimen: &Specimen) -> Self {
        let solid = specimen.solid();
        let (low, high) = solid.bounds();
        let sides = (high - low).truncate();
        let by_sides = Self { length: sides.max_element(), width: sides.min_element(), is_round: false };
        if matches!(*specimen.body, Body::Glass(_)) {
            return by_sides;
        }
        let outline = hull(solid.vertices().iter().copied().map(DVec3::truncate).collect());
        // A solid so thin that rounding leaves no outline is measured along its axes.
        Calipers::of_stone(&outline).map_or(by_sides, |Calipers { length, width, middle, .. }| {
            let is_round = round_diameter(&outline, middle, width).is_some();
            Self { length, width, is_round }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;
    use brillianteer_cut::RoundBrilliant;
    use brillianteer_math::Plane;
    use std::f64::consts::FRAC_PI_2;

    fn extent(name: &str) -> Extent {
        Extent::of(Document::of_library(name).unwrap().specimen())
    }

    #[test]
    fn a_brilliant_of_few_girdle_facets_is_round_and_a_cube_is_not() {
        let mut design = Document::first().unwrap().work.design;
        let Cut::RoundBrilliant(first) = design.cut else { panic!() };
        // A round brilliant is scaled by its diameter, however few its girdle facets.
        for (sides, is_round) in [(16, true), (96, true)] {
            design.cut = Cut::RoundBrilliant(RoundBrilliant { girdle_facets: sides, ..first });
            assert_eq!(Extent::of(&Specimen::new(design.clone()).unwrap()).is_round, is_round, "{sides}");
        }
        for (sides, is_round) in [(8_u32, false), (10, true)] {
            let upright = (0..sides).map(|k| {
                let azimuth = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
                (format!("girdle {k}"), Plane::from_slope(FRAC_PI_2, azimuth, 1.0))
            });
            let ends = [("table", DVec3::Z), ("culet", -DVec3::Z)];
            let ends = ends.map(|(name, normal)| (name.to_owned(), Plane::new(normal, 0.5)));
            design.cut = Cut::Planes(upright.chain(ends).collect());
            assert_eq!(Extent::of(&Specimen::new(design.clone()).unwrap()).is_round, is_round, "{sides}");
        }
        let cube = extent("cube");
        assert_eq!((cube.is_round, cube.length, cube.width), (false, 2.0, 2.0), "as `info` has it");
        let pill = extent("pill");
        assert!(!pill.is_round && pill.length > 1.2 * pill.width, "{pill:?}");
    }
}
