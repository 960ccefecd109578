//! How far a stone reaches from above: what its size is told by.

use crate::cut::{Cut, Design, Outline, Tiers};
use crate::math::{Calipers, hull};
use crate::scene::{Specimen, Stone};
use glam::{DVec2, DVec3};

/// Directions in which a stone's breadth is compared, over half a turn.
const DIRECTIONS: u32 = 36;

/// A stone is round if its breadths in all directions agree to this part: a girdle of 16 facets is, one of 8 is not.
const ROUND: f64 = 0.03;

/// How far a stone reaches from above, in the unit of its frame (half the diameter).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The greater of its two sides.
    pub length: f64,
    /// The smaller.
    pub width: f64,
    /// Whether one number, a diameter, says as much as both.
    pub is_round: bool,
    /// The unit of the design's own distances.
    pub unit: f64,
}

/// The unit of a design's own distances, in that of its stone's frame: designs of tiers are scaled to their diameter, all
/// others have the frame's own. `None` where the design makes no stone.
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
    /// Measures a stone, with or without facets: length and width are those of [`Outline`].
    pub fn of(specimen: &Specimen) -> Self {
        let points = specimen.solid().vertices();
        let (length, width) = match specimen.stone() {
            Ok(stone) => {
                let Outline { length, width, .. } = Outline::of(&stone.polytope);
                (length, width)
            }
            Err(_) => across(points),
        };
        let angles = (0..DIRECTIONS).map(|k| std::f64::consts::PI * f64::from(k) / f64::from(DIRECTIONS));
        let breadths = angles.map(|angle| breadth(points, DVec2::from_angle(angle)));
        let (least, most) = breadths.fold((f64::INFINITY, 0.0_f64), |(a, b), w| (a.min(w), b.max(w)));
        let unit = unit(&specimen.design).unwrap_or(1.0);
        Self { length, width, is_round: most <= (1.0 + ROUND) * least, unit }
    }
}

/// Length and width of points, seen along the axis.
fn across(points: &[DVec3]) -> (f64, f64) {
    match Calipers::of(&hull(points.iter().map(|p| p.truncate()).collect())) {
        Some(Calipers { length, width, .. }) => (length, width),
        // A solid so thin that rounding leaves no outline is measured along its axes.
        None => {
            let across = DVec2::new(breadth(points, DVec2::X), breadth(points, DVec2::Y));
            (across.max_element(), across.min_element())
        }
    }
}

/// How far apart the outermost points lie in a direction of the girdle plane.
fn breadth(points: &[DVec3], toward: DVec2) -> f64 {
    let along = points.iter().map(|p| p.truncate().dot(toward));
    let (least, most) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    most - least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Document;
    use crate::cut::RoundBrilliant;

    fn extent(name: &str) -> Extent {
        Extent::of(Document::of_library(name).unwrap().specimen())
    }

    #[test]
    fn a_brilliant_of_few_girdle_facets_is_round_and_a_cube_is_not() {
        let mut design = Document::first().unwrap().work.design;
        let Cut::RoundBrilliant(first) = design.cut else { panic!() };
        design.cut = Cut::RoundBrilliant(RoundBrilliant { girdle_facets: 16, ..first });
        assert!(Extent::of(&Specimen::new(design).unwrap()).is_round);
        let cube = extent("cube");
        assert!(!cube.is_round && (cube.length - cube.width).abs() < 0.1 * cube.width, "{cube:?}");
        let pill = extent("pill");
        assert!(!pill.is_round && pill.length > 1.2 * pill.width, "{pill:?}");
    }
}
