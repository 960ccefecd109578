//! A ray whose wavelengths spread apart on their way, and the point where it meets a facet.

use super::facets::FacetSearch;
use glam::DVec3;

/// A ray from the eye or between two facets, and how it changes over the spread of wavelengths.
#[derive(Clone, Copy)]
pub(super) struct DispersedRay {
    pub origin: DVec3,
    /// The direction in which the ray travels, of length 1.
    pub direction: DVec3,
    /// The change of its direction.
    pub fan: DVec3,
    /// The displacement of its origin.
    pub shift: DVec3,
}

/// The point where a ray meets a facet, and how it changes over the spread of wavelengths.
pub(super) struct Arrival {
    pub point: DVec3,
    /// The facet's unit outward normal at the point.
    pub normal: DVec3,
    /// The displacement of the point.
    pub shift: DVec3,
    /// The change of the normal.
    pub of_normal: DVec3,
}

impl DispersedRay {
    /// Returns a ray that is the same at all wavelengths.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, fan: DVec3::ZERO, shift: DVec3::ZERO }
    }

    /// Returns the point where the ray meets a facet that is this far away.
    #[inline]
    pub fn arrival<F: FacetSearch>(&self, facets: &F, facet: usize, distance: f64) -> Arrival {
        let point = self.origin + self.direction * distance;
        let normal = facets.normal(facet, point);
        if !self.is_fanned() {
            return Arrival { point, normal, shift: DVec3::ZERO, of_normal: DVec3::ZERO };
        }
        let shift = along_surface(self.shift + self.fan * distance, self.direction, normal);
        Arrival { point, normal, shift, of_normal: facets.turned(point, shift) }
    }

    /// Whether the ray changes at all over the spread of wavelengths.
    pub fn is_fanned(&self) -> bool {
        self.fan != DVec3::ZERO || self.shift != DVec3::ZERO
    }
}

/// Returns the displacement along the surface of the point where a ray meets it, when the ray there moves by `by`.
#[inline]
fn along_surface(by: DVec3, direction: DVec3, normal: DVec3) -> DVec3 {
    by - direction * (normal.dot(by) / normal.dot(direction))
}
