//! The point where a ray meets a facet, and how that point moves over what the ray stands for.

use super::facets::FacetSearch;
use crate::trace::DispersedRay;
use glam::DVec3;

/// The point where a ray meets a facet, and how it changes over what the ray stands for.
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
    /// Returns the point where the ray meets a facet that is this far away.
    #[inline]
    pub(super) fn arrival<F: FacetSearch>(&self, facets: &F, facet: usize, distance: f64) -> Arrival {
        let point = self.origin + self.direction * distance;
        let normal = facets.normal(facet, point);
        if !self.is_fanned() {
            return Arrival { point, normal, shift: DVec3::ZERO, of_normal: DVec3::ZERO };
        }
        let shift = along_surface(self.shift + self.fan * distance, self.direction, normal);
        Arrival { point, normal, shift, of_normal: facets.turned(point, shift) }
    }
}

/// Returns the displacement along the surface of the point where a ray meets it, when the ray there moves by `by`.
#[inline]
fn along_surface(by: DVec3, direction: DVec3, normal: DVec3) -> DVec3 {
    by - direction * (normal.dot(by) / normal.dot(direction))
}
