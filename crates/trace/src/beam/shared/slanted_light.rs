//! The directions of light of several wavelengths inside a stone, behind the facet by which it entered.

use super::super::grow::entry_points;
use brillianteer_math::{Basis, Plane};
use brillianteer_optics::{Incidence, reflect, refract};
use glam::{DVec2, DVec3};

/// The least square of the cosine of refraction by which slants are divided.
const LEAST_COS_SQUARED: f64 = 1e-18;

/// A facet by which parallel light enters a stone, and the light that comes through it, at all wavelengths.
#[derive(Debug, Clone, Copy)]
pub struct EntryFacet {
    /// The facet.
    pub facet: u32,
    /// The unit direction of the light that the facet's outer side reflects, followed from the eye.
    pub glare: DVec3,
    /// The outward unit normal.
    pub(super) normal: DVec3,
    /// The cosine of the angle of incidence.
    pub(super) cos_i: f64,
    /// The square of the sine of that angle.
    sin_squared: f64,
}

/// The refraction of light of one index behind a facet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slant {
    /// The refractive index.
    pub index: f64,
    /// The tangent of the angle of refraction per sine of the angle of incidence. The place where light lands on a
    /// facet is affine in this number, whatever facets have reflected the light before.
    pub slant: f64,
    /// The cosine of the angle of refraction.
    pub cos_t: f64,
}

/// The rays behind one facet, mirrored by all facets that they have met: for each image point a start, and for each
/// slant a direction.
///
/// None of the numbers depends on the wavelength. Each reflection replaces the rays by their mirror images, so the
/// start stays on the image of the facet by which the light entered.
#[derive(Debug, Clone, Copy)]
pub(super) struct SlantedLight {
    /// The start of the ray at the image's origin, and its changes along the image's axes.
    pub origin: [DVec3; 3],
    /// The displacement of light that is not slanted, per unit of depth behind the facet.
    pub down: DVec3,
    /// The change of that displacement per slant.
    pub along: DVec3,
}

impl EntryFacet {
    /// Returns the light into which the eye's rays turn behind a facet that they meet at an angle of cosine `cos_i`.
    pub(super) fn new(facet: u32, plane: &Plane, view: &Basis, cos_i: f64) -> (Self, SlantedLight) {
        let ray = -view.toward;
        let along = ray + plane.normal * cos_i;
        let (glare, sin_squared) = (reflect(ray, plane.normal, cos_i), along.length_squared());
        let light = SlantedLight { origin: entry_points(view, plane), down: -plane.normal, along };
        (Self { facet, glare, normal: plane.normal, cos_i, sin_squared }, light)
    }

    /// Returns the slant of light of an index.
    pub fn slant(&self, index: f64) -> Slant {
        let eta = 1.0 / index;
        let cos_t = (1.0 - eta * eta * self.sin_squared).max(LEAST_COS_SQUARED).sqrt();
        Slant { index, slant: eta / cos_t, cos_t }
    }
}

impl SlantedLight {
    /// Returns the displacement of the light per unit of depth behind the facet by which it entered.
    pub fn way(&self, slant: f64) -> DVec3 {
        self.down + self.along * slant
    }

    /// Returns the unit direction of the light.
    pub fn direction(&self, slant: &Slant) -> DVec3 {
        self.way(slant.slant) * slant.cos_t
    }

    /// Returns the start of the ray of image point `p`.
    pub fn start(&self, p: DVec2) -> DVec3 {
        let [o, u, v] = self.origin;
        o + u * p.x + v * p.y
    }

    /// Returns the mirror image of the light in a plane.
    pub fn mirrored(&self, plane: &Plane) -> Self {
        let n = plane.normal;
        let way = |v: DVec3| v - n * (2.0 * n.dot(v));
        let [o, u, v] = self.origin;
        Self {
            origin: [o - n * (2.0 * (n.dot(o) - plane.offset)), way(u), way(v)],
            down: way(self.down),
            along: way(self.along),
        }
    }

    /// Returns the direction in which a ray of this light leaves through a facet with this normal, and the change of
    /// that direction over a spread of indices around that of its slant.
    pub fn leaving(
        &self,
        entry: &EntryFacet,
        (slant, spread): (&Slant, f64),
        ray: DVec3,
        normal: DVec3,
        cos_t: f64,
    ) -> (DVec3, DVec3) {
        let (index, eta) = (slant.index, 1.0 / slant.index);
        let of_eta = -spread * eta * eta;
        let of_cos = -eta * entry.sin_squared * of_eta / slant.cos_t;
        let cos_i = ray.dot(normal);
        let of_direction = self.down * of_cos + self.along * of_eta;
        let incidence = Incidence { direction: ray, normal: -normal, cos_i, of_direction, of_normal: None };
        let leaving = refract(ray, -normal, index, (cos_i, cos_t));
        (leaving, incidence.refracted_change(index, spread, cos_t))
    }
}
