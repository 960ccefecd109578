//! The point where a ray meets a facet, and the displacement of that point over the range that the ray represents.

use super::facets::FacetSearch;
use crate::DispersedRay;
use crate::dispersed_ray::Arrival;
use glam::DVec3;

impl DispersedRay {
    /// Returns the point where the ray meets a facet at this distance, with the facet's outward normal.
    #[inline]
    pub(super) fn arrival<F: FacetSearch>(&self, facets: &F, facet: usize, distance: f64) -> Arrival<DVec3> {
        let point = self.origin + self.direction * distance;
        let normal = facets.normal(facet, point);
        if !self.is_fanned() {
            return Arrival { point, normal, shift: DVec3::ZERO, of_normal: None };
        }
        let shift = self.along_surface(distance, normal);
        let of_normal = facets.turned(point, shift);
        Arrival { point, normal, shift, of_normal }
    }
}
