//! The point where a ray meets a facet, and the displacement of that point over the range that the ray represents.

use super::facets::FacetSearch;
use crate::DispersedRay;
use brillianteer_optics::{reflect, reflected_change, refract, refracted_change};
use glam::DVec3;

/// The point where a ray meets a facet, with its change over the range that the ray represents.
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
    /// Returns the point where the ray meets a facet at this distance.
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

    /// Returns the ray that a facet reflects back inside. `cos_i` is the cosine of the angle between the ray and the
    /// outward normal. Where `is_fanned` is false, the ray stays without a fan.
    #[inline]
    pub(super) fn reflected_inside(&self, arrival: &Arrival, cos_i: f64, is_fanned: bool) -> Self {
        let &Arrival { point, normal, shift, of_normal } = arrival;
        let direction = reflect(self.direction, -normal, cos_i);
        let fan = match is_fanned {
            true => reflected_change(self.direction, normal, (self.fan, of_normal)),
            false => DVec3::ZERO,
        };
        Self { origin: point, direction, fan, shift }
    }

    /// Returns the direction and the fan of light that leaves a body of this index through a facet. `cosines` are
    /// those of the angles inside and outside. `spread` is the change of the index over the band of wavelengths; with
    /// `None` the light stays without a fan.
    #[inline]
    pub(super) fn refracted_outside(
        &self,
        arrival: &Arrival,
        index: f64,
        cosines: (f64, f64),
        spread: Option<f64>,
    ) -> (DVec3, DVec3) {
        let &Arrival { normal, of_normal, .. } = arrival;
        let change = |spread| {
            refracted_change(self.direction, -normal, index, cosines, (self.fan, -of_normal, spread))
        };
        (refract(self.direction, -normal, index, cosines), spread.map_or(DVec3::ZERO, change))
    }
}

/// Returns the displacement along the surface of the point where a ray meets it, when the ray there moves by `by`.
#[inline]
fn along_surface(by: DVec3, direction: DVec3, normal: DVec3) -> DVec3 {
    by - direction * (normal.dot(by) / normal.dot(direction))
}
