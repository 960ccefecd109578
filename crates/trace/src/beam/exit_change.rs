//! The change of beams' exit directions with the wavelength.

use super::tree::Beams;
use brillianteer_math::Polytope;
use brillianteer_optics::{Incidence, cos_transmitted, reflect, refract};
use glam::DVec3;

impl Beams {
    /// Returns, for each beam, the change of its exit direction over the medium's spread of indices. It is 0 for the
    /// surface's glare, and where reflection is total. `polytope` must be the one that was traced.
    pub fn exit_changes(&self, polytope: &Polytope) -> Vec<DVec3> {
        let (index, spread) = (self.medium.index, self.medium.spread);
        let mut exit_changes = vec![DVec3::ZERO; self.len()];
        // For each beam, the direction of the light that goes on inside, and the change of this direction.
        let mut onward: Vec<(DVec3, DVec3)> = Vec::with_capacity(self.len());
        for beam in self.iter() {
            let normal = polytope.facets()[beam.facet as usize].plane.normal;
            onward.push(match beam.parent {
                None => {
                    let (ray, eta) = (-self.view.toward, 1.0 / index);
                    let cos_i = -ray.dot(normal);
                    let cos_t = cos_transmitted(cos_i, eta).unwrap_or(1.0);
                    let incidence = incidence(ray, normal, cos_i, DVec3::ZERO);
                    let change = incidence.refracted_change(eta, -spread * eta * eta, cos_t);
                    (refract(ray, normal, eta, (cos_i, cos_t)), change)
                }
                Some(parent) => {
                    let (ray, change) = onward[parent as usize];
                    let cos_i = ray.dot(normal);
                    if let Some(cos_t) = cos_transmitted(cos_i, index) {
                        let incidence = incidence(ray, -normal, cos_i, change);
                        exit_changes[beam.id as usize] = incidence.refracted_change(index, spread, cos_t);
                    }
                    (reflect(ray, -normal, cos_i), change - normal * (2.0 * change.dot(normal)))
                }
            });
        }
        exit_changes
    }
}

/// Returns the incidence of a ray at a facet, where the ray's direction changes by `of_direction`.
fn incidence(direction: DVec3, normal: DVec3, cos_i: f64, of_direction: DVec3) -> Incidence<DVec3> {
    Incidence { direction, normal, cos_i, of_direction, of_normal: None }
}
