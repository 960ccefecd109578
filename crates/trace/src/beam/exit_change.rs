//! The change of beams' exit directions with the wavelength.

use super::tree::Beams;
use brillianteer_math::Polytope;
use brillianteer_optics::{cos_transmitted, reflect, refract, refracted_change};
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
                    let cosines = (cos_i, cos_transmitted(cos_i, eta).unwrap_or(1.0));
                    let change = (DVec3::ZERO, DVec3::ZERO, -spread * eta * eta);
                    (refract(ray, normal, eta, cosines), refracted_change(ray, normal, eta, cosines, change))
                }
                Some(parent) => {
                    let (ray, change) = onward[parent as usize];
                    let cos_i = ray.dot(normal);
                    if let Some(cos_t) = cos_transmitted(cos_i, index) {
                        let both = (change, DVec3::ZERO, spread);
                        exit_changes[beam.id as usize] =
                            refracted_change(ray, -normal, index, (cos_i, cos_t), both);
                    }
                    (reflect(ray, -normal, cos_i), change - normal * (2.0 * change.dot(normal)))
                }
            });
        }
        exit_changes
    }
}
