//! The facets of a cut while a family makes them: planes through points where facets meet, and the check that each of them
//! has its place on the stone.

use super::names;
use crate::math::{Plane, Polytope, Surface, triangulate};
use glam::DVec3;

/// A facet that reaches less than this across, girdle radii, is a sliver: no cutter polishes it. On a stone of 6.5 mm it
/// is 0.01 mm.
const NARROWEST: f64 = 0.003;

/// A triangle whose height is below this part of its longest side gives no plane: only rounding is left of it.
const FLAT: f64 = 1e-9;

/// A facet whose normal leans less than this toward the plane x = 0 (sine) is square to it.
const SQUARE: f64 = 1e-12;

/// The facets of a cut by their tiers. Lengths are in girdle radii: half of the stone's width is 1.
#[derive(Debug, Clone, Default)]
pub struct FacetNet {
    facets: Vec<(&'static str, Plane)>,
    /// Whether the facets are those of one half, at x of 0 and more, of a stone that need not be convex.
    is_half: bool,
}

/// The plane in which both halves of a stone meet.
const MIRROR: Plane = Plane { normal: DVec3::NEG_X, offset: 0.0 };

/// What the numbers of a family leave no room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoRoom {
    /// The tier of the facets that have no room; empty where it is the whole stone.
    pub tier: &'static str,
}

impl FacetNet {
    /// Returns an empty net for the facets of one half, at x of 0 and more, of a stone. The other half is its mirror image. Each
    /// half is convex; the stone need not be so. A facet square to the plane x = 0 lies on both.
    pub fn half() -> Self {
        Self { is_half: true, ..Self::default() }
    }

    /// Whether the net is one half of a stone.
    pub fn is_half(&self) -> bool {
        self.is_half
    }

    /// Returns the tier and the plane of each facet.
    pub fn facets(&self) -> impl Iterator<Item = (&'static str, Plane)> + '_ {
        self.facets.iter().copied()
    }

    /// Adds a facet. The normal points out of the stone and has any length but zero.
    pub fn plane(&mut self, tier: &'static str, normal: DVec3, through: DVec3) {
        let normal = normal.normalize_or(DVec3::Z);
        self.facets.push((tier, Plane::new(normal, normal.dot(through))));
    }

    /// Adds the facet through three points; `inside` is any point on its inner side, as the middle of the stone is.
    ///
    /// # Errors
    /// The tier, if the points lie on one line or the plane runs through `inside`.
    pub fn through(&mut self, tier: &'static str, points: [DVec3; 3], inside: DVec3) -> Result<(), NoRoom> {
        let [a, b, c] = points;
        let across = (b - a).cross(c - a);
        let longest = (b - a).length().max((c - a).length()).max((c - b).length());
        let side = across.dot(inside - a);
        if across.length() <= FLAT * longest * longest || !side.is_normal() {
            return Err(NoRoom { tier });
        }
        self.plane(tier, -across * side.signum(), a);
        Ok(())
    }

    /// Returns every facet's name, no two alike, and its plane with a unit normal.
    pub fn named(&self) -> Vec<(String, Plane)> {
        let names = names::unique(self.facets.iter().map(|(tier, _)| *tier));
        names.into_iter().zip(self.facets.iter().map(|(_, plane)| *plane)).collect()
    }

    /// Returns the solid between the facets, the stone or one half of it, and checks that each facet is on it and is no sliver.
    /// Upright facets may vanish where the girdle is a knife edge.
    ///
    /// # Errors
    /// The first tier with a facet that has no room.
    pub fn solid(&self) -> Result<Polytope, NoRoom> {
        let mirror = self.is_half.then_some(MIRROR);
        let planes: Vec<Plane> = self.facets.iter().map(|(_, plane)| *plane).chain(mirror).collect();
        let stone = Polytope::from_planes(&planes).map_err(|_| NoRoom::default())?;
        let leaning = |index: &usize| planes[*index].normal.z != 0.0;
        let merged = stone.merged().iter().map(|(dropped, _)| *dropped);
        let unseen = stone.redundant().iter().copied().chain(merged).find(leaning);
        let narrow = || {
            let facets = stone.facets().iter().filter(|facet| facet.plane.normal.z != 0.0);
            facets.into_iter().find(|facet| width(&stone, facet) < NARROWEST).map(|facet| facet.source)
        };
        match unseen.or_else(narrow) {
            Some(index) => Err(NoRoom { tier: self.facets.get(index).map_or("", |(tier, _)| tier) }),
            None => Ok(stone),
        }
    }

    /// Returns the closed surface of both halves, given the solid of one: a group of triangles with a name of its own for each
    /// facet.
    ///
    /// # Errors
    /// The half does not reach the plane x = 0.
    pub fn both_halves(&self, half: &Polytope) -> Result<Surface, NoRoom> {
        let (sides, mirror) = (triangulate(half), self.facets.len());
        let mirrored = half.facets().iter().find(|facet| facet.source == mirror);
        let seam = mirrored.ok_or(NoRoom::default())?.outline.as_slice();
        let mut vertices = sides.vertices;
        seam.iter().for_each(|corner| vertices[*corner as usize].x = 0.0);
        // The mirror image of each corner; those of the seam are their own.
        let mut images: Vec<u32> = (0..vertices.len() as u32).collect();
        for corner in 0..images.len() as u32 {
            if !seam.contains(&corner) {
                images[corner as usize] = vertices.len() as u32;
                vertices.push(vertices[corner as usize] * DVec3::new(-1.0, 1.0, 1.0));
            }
        }
        let mut surface = Surface::default();
        let mut tiers = vec![];
        for (place, facet) in half.facets().iter().enumerate().filter(|(_, facet)| facet.source != mirror) {
            let is_both = facet.plane.normal.x.abs() < SQUARE;
            let own = tiers.len() as u32;
            let other = if is_both { own } else { own + 1 };
            tiers.extend(vec![self.facets[facet.source].0; (other - own + 1) as usize]);
            let triangles = sides.triangles.iter().zip(&sides.facets);
            for (&[a, b, c], _) in triangles.filter(|(_, of)| **of as usize == place) {
                surface.triangles.extend([[a, b, c], [b, a, c].map(|corner| images[corner as usize])]);
                surface.groups.extend([own, other]);
            }
        }
        surface.names = names::unique(tiers.into_iter());
        surface.vertices = vertices;
        Ok(surface)
    }
}

/// Returns how far a facet reaches across: twice its area over its longest diagonal or side, so that it is the height of a
/// triangle.
fn width(stone: &Polytope, facet: &crate::math::Facet) -> f64 {
    let corners: Vec<DVec3> = stone.corners(facet).collect();
    let pairs = corners.iter().flat_map(|a| corners.iter().map(move |b| (*a - *b).length()));
    2.0 * stone.facet_area(facet) / pairs.fold(f64::MIN_POSITIVE, f64::max)
}
