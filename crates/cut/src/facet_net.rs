//! The facets of a cut while a family makes them: planes through points where facets meet, and the check that each of
//! them has room on the stone.

use super::facet_zones::EXACT;
use super::names;
use brillianteer_math::{Facet, Plane, Polytope, Surface, span, triangulate};
use glam::DVec3;
use std::collections::BTreeSet;

/// A facet of crown or pavilion that is less wide than this, girdle radii, is a sliver: 1 % of the stone's width, as in an
/// audit.
const NARROWEST: f64 = 0.02;

/// The least width of table and culet, girdle radii. On a stone of 6.5 mm it is 0.01 mm.
const NARROWEST_LEVEL: f64 = 0.003;

/// An upright facet whose area is below this part of the median area of all upright facets is a sliver, if the girdle
/// closes beside it.
const SLIVER: f64 = 0.02;

/// The girdle closes, or nearly does, at both ends of a facet that is lower than this part of the highest upright
/// facet.
const CLOSING: f64 = 0.5;

/// Corners nearer to one another than this, girdle radii, are one except for rounding.
const SAME: f64 = 1e-9;

/// Areas within this factor of the smallest are alike: those of facets that are each other's image differ by rounding.
const ALIKE: f64 = 1.0 + 1e-6;

/// A triangle whose height is below this part of its longest side has no certain plane, because of rounding.
const FLAT: f64 = 1e-9;

/// A facet whose normal leans less than this toward the plane x = 0 (sine) is square to it.
const SQUARE: f64 = 1e-12;

/// The facets of a cut by their tiers. Lengths are in girdle radii: half of the stone's width is 1.
#[derive(Debug, Clone, Default)]
pub struct FacetNet {
    facets: Vec<(&'static str, Plane)>,
    /// True where the facets are those of one half, at x of 0 and more, of a stone that need not be convex.
    is_half: bool,
}

/// The plane in which both halves of a stone meet.
const MIRROR: Plane = Plane { normal: DVec3::NEG_X, offset: 0.0 };

/// The tier for which the numbers of a family leave no room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoRoom {
    /// The tier of the facets without room; empty where the whole stone has none.
    pub tier: &'static str,
}

impl FacetNet {
    /// Returns an empty net for the facets of one half, at x of 0 and more, of a stone. The other half is its mirror image. Each
    /// half is convex; the stone need not be so. A facet with an edge in the plane x = 0, square to it, lies on both; a level facet
    /// does so if it reaches that plane.
    pub fn half() -> Self {
        Self { is_half: true, ..Self::default() }
    }

    /// Returns whether the net is one half of a stone.
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
    /// The error names the tier if the points lie on one line, or if the plane runs through `inside`.
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

    /// Returns the number of facets.
    pub fn count(&self) -> usize {
        self.facets.len()
    }

    /// Checks that facets, those from a place on, cut none of these points off.
    ///
    /// # Errors
    /// The error names the tier of a facet that does.
    pub fn keep(&self, from: usize, points: &[DVec3]) -> Result<(), NoRoom> {
        let cuts_off = |plane: &Plane| points.iter().any(|point| plane.distance(*point) > SAME);
        match self.facets.iter().skip(from).find(|(_, plane)| cuts_off(plane)) {
            Some((tier, _)) => Err(NoRoom { tier }),
            None => Ok(()),
        }
    }

    /// Returns every facet's name, no two alike, and its plane with a unit normal.
    pub fn named(&self) -> Vec<(String, Plane)> {
        let names = names::unique(self.facets.iter().map(|(tier, _)| *tier));
        names.into_iter().zip(self.facets.iter().map(|(_, plane)| *plane)).collect()
    }

    /// Returns the net with the facets that have room on the stone, and the solid between them: the stone, or one
    /// half of it. Where the girdle closes to a knife edge, upright facets that are not on the solid, or of which
    /// only a sliver is left, are dropped; their neighbours, or the facets above and below, replace them.
    ///
    /// # Errors
    /// The error names the first tier with another facet that has no room.
    pub fn settled(mut self) -> Result<(Self, Polytope), NoRoom> {
        loop {
            let planes: Vec<Plane> =
                self.facets.iter().map(|(_, plane)| *plane).chain(self.mirror()).collect();
            let solid = Polytope::from_planes(&planes).map_err(|_| NoRoom::default())?;
            let dropped = self.without_place(&solid);
            if dropped.is_empty() {
                self.check_room(&solid)?;
                return Ok((self, solid));
            }
            let mut place = 0..;
            self.facets.retain(|_| !place.next().is_some_and(|place| dropped.contains(&place)));
        }
    }

    /// Returns the plane in which both halves of a stone meet.
    fn mirror(&self) -> Option<Plane> {
        self.is_half.then_some(MIRROR)
    }

    /// Returns the facets of a solid as (index of the plane, facet), without that in which both halves meet.
    fn facets_of<'a>(&self, solid: &'a Polytope) -> impl Iterator<Item = (usize, &'a Facet)> + use<'a> {
        let count = self.facets.len();
        solid.facets().iter().map(|facet| (facet.source, facet)).filter(move |(index, _)| *index < count)
    }

    /// Returns the upright planes that are not on the solid, or else those of the smallest slivers, which are alike;
    /// an empty set where all upright planes have room.
    fn without_place(&self, solid: &Polytope) -> BTreeSet<usize> {
        let is_upright =
            |index: &usize| self.facets.get(*index).is_some_and(|(_, plane)| plane.normal.z == 0.0);
        let unseen: BTreeSet<usize> = unseen(solid).filter(is_upright).collect();
        if !unseen.is_empty() {
            return unseen;
        }
        let upright = self.facets_of(solid).filter(|(index, _)| is_upright(index));
        let sized: Vec<(usize, Upright)> =
            upright.map(|(index, facet)| (index, Upright::of(solid, facet))).collect();
        let mut areas: Vec<f64> = sized.iter().map(|(_, upright)| upright.area).collect();
        areas.sort_by(f64::total_cmp);
        let median = areas.get(areas.len() / 2).copied().unwrap_or(0.0);
        let highest = sized.iter().map(|(_, upright)| upright.height).fold(0.0, f64::max);
        let slivers = || sized.iter().filter(|(_, upright)| upright.is_sliver(median, highest));
        let smallest = slivers().map(|(_, upright)| upright.area).fold(f64::INFINITY, f64::min);
        slivers().filter(|(_, upright)| upright.area <= ALIKE * smallest).map(|(index, _)| *index).collect()
    }

    /// Checks that every facet that leans or lies flat is on a solid and is no sliver.
    fn check_room(&self, solid: &Polytope) -> Result<(), NoRoom> {
        let least = |facet: &Facet| match facet.plane.normal {
            normal if normal.z == 0.0 => 0.0,
            normal if normal.truncate().length() < EXACT => NARROWEST_LEVEL,
            _ => NARROWEST,
        };
        let narrow = || {
            let found = self.facets_of(solid).find(|(_, facet)| solid.facet_width(facet) < least(facet));
            found.map(|(index, _)| index)
        };
        match unseen(solid).next().or_else(narrow) {
            Some(index) => Err(NoRoom { tier: self.facets.get(index).map_or("", |(tier, _)| tier) }),
            None => Ok(()),
        }
    }

    /// Returns the closed surface of both halves, given the solid of one: a group of triangles with a name of its own for each
    /// facet.
    ///
    /// # Errors
    /// Fails where the half does not reach the plane x = 0.
    pub fn both_halves(&self, half: &Polytope) -> Result<Surface, NoRoom> {
        let (sides, mirror) = (triangulate(half), self.facets.len());
        let mirrored = half.facets().iter().find(|facet| facet.source == mirror);
        let seam = mirrored.ok_or(NoRoom::default())?.outline.as_slice();
        let mut vertices = sides.vertices;
        seam.iter().for_each(|corner| vertices[*corner as usize].x = 0.0);
        // The mirror image of each corner; corners of the seam are their own images.
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
            let normal = facet.plane.normal;
            let on_seam =
                facet.outline.iter().filter(|corner| vertices[**corner as usize].x.abs() < SAME).count();
            // Mains in one plane that touch the seam only in the point of a pavilion without a culet stay two. Table and culet
            // are each one cut, however they reach the seam.
            let least = if normal.truncate().length() < SQUARE { 1 } else { 2 };
            let is_both = on_seam >= least && normal.x.abs() < SQUARE;
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

/// The measures of an upright facet.
struct Upright {
    area: f64,
    height: f64,
    /// The extent along the girdle.
    length: f64,
    /// True where the girdle closes at one of the facet's ends.
    is_closed: bool,
}

impl Upright {
    fn of(solid: &Polytope, facet: &Facet) -> Self {
        let along = facet.plane.normal.cross(DVec3::Z);
        let extent = |direction: DVec3| span(solid.corners(facet).map(|corner| corner.dot(direction)));
        let ((low, high), (from, to)) = (extent(DVec3::Z), extent(along));
        let is_closed = [from, to].iter().any(|end| {
            let here = solid.corners(facet).filter(|corner| (corner.dot(along) - end).abs() < SAME);
            let (low, high) = span(here.map(|corner| corner.z));
            high - low < SAME
        });
        Self { area: solid.facet_area(facet), height: high - low, length: to - from, is_closed }
    }

    /// Returns whether the facet is a remainder where the girdle closes: too small or too short to be cut. `median`
    /// is the median area of the upright facets, `highest` the height of the highest.
    fn is_sliver(&self, median: f64, highest: f64) -> bool {
        let is_closing = self.is_closed || self.height < CLOSING * highest;
        is_closing && (self.area < SLIVER * median || self.length < NARROWEST.min(self.height))
    }
}

/// Returns the indices of the planes that have no facet of their own on a solid.
fn unseen(solid: &Polytope) -> impl Iterator<Item = usize> + '_ {
    let merged = solid.merged().iter().map(|(dropped, _)| *dropped);
    solid.redundant().iter().copied().chain(merged)
}
