//! The facets of a cut while a family makes them: planes through points where facets meet, and the check that each of them
//! has its place on the stone.

use super::names;
use crate::math::{Plane, Polytope};
use glam::DVec3;

/// A facet that reaches less than this across, girdle radii, is a sliver: no cutter polishes it. On a stone of 6.5 mm it
/// is 0.01 mm.
const NARROWEST: f64 = 0.003;

/// A triangle whose height is below this part of its longest side gives no plane: only rounding is left of it.
const FLAT: f64 = 1e-9;

/// The facets of a cut by their tiers. Lengths are in girdle radii: half of the stone's width is 1.
#[derive(Debug, Clone, Default)]
pub struct FacetNet {
    facets: Vec<(&'static str, Plane)>,
}

/// What the numbers of a family leave no room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unfit {
    /// The tier of the facets that have no room; empty where it is the whole stone.
    pub tier: &'static str,
}

impl FacetNet {
    /// Adds a facet. The normal points out of the stone and has any length but zero.
    pub fn plane(&mut self, tier: &'static str, normal: DVec3, through: DVec3) {
        let normal = normal.normalize_or(DVec3::Z);
        self.facets.push((tier, Plane::new(normal, normal.dot(through))));
    }

    /// Adds the facet through three points; `inside` is any point on its inner side, as the middle of the stone is.
    ///
    /// # Errors
    /// The tier, if the points lie on one line or the plane runs through `inside`.
    pub fn through(&mut self, tier: &'static str, points: [DVec3; 3], inside: DVec3) -> Result<(), Unfit> {
        let [a, b, c] = points;
        let across = (b - a).cross(c - a);
        let longest = (b - a).length().max((c - a).length()).max((c - b).length());
        let side = across.dot(inside - a);
        if across.length() <= FLAT * longest * longest || !side.is_normal() {
            return Err(Unfit { tier });
        }
        self.plane(tier, -across * side.signum(), a);
        Ok(())
    }

    /// Returns every facet's name, no two alike, and its plane with a unit normal.
    pub fn named(&self) -> Vec<(String, Plane)> {
        let names = names::unique(self.facets.iter().map(|(tier, _)| *tier));
        names.into_iter().zip(self.facets.iter().map(|(_, plane)| *plane)).collect()
    }

    /// Checks that the facets close a stone, and that each of them is on it and is no sliver. Upright facets may vanish
    /// where the girdle is a knife edge.
    ///
    /// # Errors
    /// The first tier with a facet that has no room.
    pub fn check(&self) -> Result<(), Unfit> {
        let planes: Vec<Plane> = self.facets.iter().map(|(_, plane)| *plane).collect();
        let stone = Polytope::from_planes(&planes).map_err(|_| Unfit::default())?;
        let leaning = |index: &usize| planes[*index].normal.z != 0.0;
        let merged = stone.merged().iter().map(|(dropped, _)| *dropped);
        let unseen = stone.redundant().iter().copied().chain(merged).find(leaning);
        let narrow = || {
            let facets = stone.facets().iter().filter(|facet| facet.plane.normal.z != 0.0);
            facets.into_iter().find(|facet| width(&stone, facet) < NARROWEST).map(|facet| facet.source)
        };
        match unseen.or_else(narrow) {
            Some(index) => Err(Unfit { tier: self.facets[index].0 }),
            None => Ok(()),
        }
    }
}

/// Returns how far a facet reaches across: twice its area over its longest diagonal or side, so that it is the height of a
/// triangle.
fn width(stone: &Polytope, facet: &crate::math::Facet) -> f64 {
    let corners: Vec<DVec3> = stone.corners(facet).collect();
    let pairs = corners.iter().flat_map(|a| corners.iter().map(move |b| (*a - *b).length()));
    2.0 * stone.facet_area(facet) / pairs.fold(f64::MIN_POSITIVE, f64::max)
}
