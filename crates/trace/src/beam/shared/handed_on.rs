//! The results that [`trace_shared`](super::trace_shared) hands on: the beams that land on each facet, the light that
//! leaves there, and the ends of beams.

use super::group_light::ArrivingLight;
use super::moving::MovingCorner;
use super::slanted_light::{EntryFacet, Slant, SlantedLight};
use crate::beam::follow::attenuated;
use crate::coherency::Coherency;
use brillianteer_math::Affine;
use brillianteer_optics::fresnel;
use brillianteer_scene::Medium;
use glam::{DVec2, DVec3};
use std::ops::Range;

/// A part of a beam that lands on one facet, for a group of wavelengths.
pub struct SharedBeam<'a> {
    /// The range of the wavelengths, by their numbers among the media.
    pub group: Range<usize>,
    /// The facet by which the light entered.
    pub entry: &'a EntryFacet,
    /// The outline at `slant`, convex and counter-clockwise, with the drift of its corners.
    pub outline: &'a [MovingCorner],
    /// The slant in the middle of the group.
    pub slant: Slant,
    /// The outline's area at `slant`.
    pub area: f64,
    /// The share of the light that arrives, as the mean of the group and without absorption; 1 for a beam that enters here.
    pub weight: f64,
    /// The light inside; `None` for a beam that enters here, of which the surface reflects a part.
    pub inside: Option<Inside>,
}

/// Light inside a stone that arrives at a facet.
pub struct Inside {
    /// The outward unit normal of the facet.
    pub(super) normal: DVec3,
    pub(super) light: SlantedLight,
    /// The weight and polarisation of the light, in the axes of the facet.
    pub(super) arriving: ArrivingLight,
    /// The depths of the facet before and of this one behind the facet by which the light entered.
    pub(super) depths: [Affine; 2],
    /// The speed toward this facet, in two parts: that of light that is not slanted, and the part per slant.
    pub(super) speed: DVec2,
}

/// Light of one wavelength that leaves a shared beam.
#[derive(Debug, Clone, Copy)]
pub struct SharedExit {
    /// The unit direction, followed from the eye.
    pub direction: DVec3,
    /// The change of the direction over the medium's spread of indices.
    pub change: DVec3,
    /// The share of the light from that direction that reaches the eye, if nothing is absorbed.
    pub weight: f64,
}

/// Receives the beams of a piece of work, in the order of the tree.
pub trait SharedBeams: Send {
    /// Receives a part of a beam that lands on one facet.
    fn take(&mut self, beam: &SharedBeam);

    /// Receives the end of a beam that is not followed further.
    fn leave(&mut self, end: BeamEnd);

    /// Ends the piece of work; no more beams follow.
    fn finish(&mut self);
}

/// The end of a beam that is too weak to be followed.
pub struct BeamEnd {
    /// The range of the wavelengths, by their numbers among the media.
    pub group: Range<usize>,
    /// The outline at `slant`.
    pub outline: Vec<DVec2>,
    /// The outline's area.
    pub area: f64,
    /// The slant in the middle of the group.
    pub slant: Slant,
    /// The share of the light that goes on, without absorption.
    pub weight: f64,
    /// The greatest light of one wavelength that goes on, as share times area, with absorption.
    pub energy: f64,
    pub(crate) coherency: Coherency,
    /// The axis s of `coherency`: a unit vector perpendicular to the ray.
    pub(crate) s: DVec3,
    pub(super) light: SlantedLight,
    pub(super) depth: Affine,
}

impl BeamEnd {
    /// Returns the ray that goes on from an image point: its start, its unit direction, and the length of its path so
    /// far.
    pub(crate) fn ray(&self, p: DVec2) -> (DVec3, DVec3, f64) {
        let (depth, way) = (self.depth.at(p), self.light.way(self.slant.slant));
        (self.light.start(p) + way * depth, self.light.direction(&self.slant), depth / self.slant.cos_t)
    }
}

impl SharedBeam<'_> {
    /// Returns three numbers a, b and c: after a change x of the slant, the outline's area is a + b x + c x², below 0 where
    /// corners have passed one another.
    pub fn areas(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        let next = self.outline.iter().skip(1).chain(self.outline.first());
        for (a, b) in self.outline.iter().zip(next) {
            sums[0] += a.at.perp_dot(b.at);
            sums[1] += a.at.perp_dot(b.drift) + a.drift.perp_dot(b.at);
            sums[2] += a.drift.perp_dot(b.drift);
        }
        sums.map(|sum| 0.5 * sum)
    }

    /// Returns the share of light that the surface reflects where light enters a medium. The reflected light comes
    /// from the direction of the [glare](EntryFacet::glare).
    pub fn glare(&self, medium: &Medium) -> f64 {
        fresnel(self.entry.cos_i, 1.0 / medium.index).reflectance()
    }

    /// Returns the energy, weight times area, that media absorb between the facet before and this one, at the beam's slant.
    pub fn absorbed(&self, media: &[Medium]) -> f64 {
        let Some(inside) = &self.inside else { return 0.0 };
        let outline: Vec<DVec2> = self.outline.iter().map(|corner| corner.at).collect();
        let [before, after] = inside.depths.map(|depth| depth * (1.0 / self.slant.cos_t));
        let lost =
            |medium: &Medium| attenuated(&outline, before, medium) - attenuated(&outline, after, medium);
        self.weight * media.iter().map(lost).sum::<f64>()
    }
}

impl Inside {
    /// Returns the light that leaves here at the wavelength of a medium; `None` where reflection is total.
    pub fn exit(&self, entry: &EntryFacet, medium: &Medium) -> Option<SharedExit> {
        let slant = entry.slant(medium.index);
        let ray = self.light.direction(&slant);
        let surface = fresnel(ray.dot(self.normal), medium.index);
        let (direction, change) =
            self.light.leaving(entry, (&slant, medium.spread), ray, self.normal, surface.cos_t()?);
        let weight = self.arriving.at(medium.index, |arriving| arriving.split(&surface).1);
        Some(SharedExit { direction, change, weight })
    }

    /// Returns the length of the path inside the stone to the facet, over the image, at a slant. `middle` is the
    /// beam's slant.
    pub fn path(&self, middle: &Slant, slant: &Slant) -> Affine {
        let speed = |slant: &Slant| self.speed.x + self.speed.y * slant.slant;
        self.depths[1] * (speed(middle) / (speed(slant) * slant.cos_t))
    }
}
