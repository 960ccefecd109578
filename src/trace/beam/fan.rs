//! How far apart light of two wavelengths leaves a beam.

use super::tree::Beams;
use crate::math::Polytope;
use crate::optics::{cos_transmitted, reflect, refract};
use glam::DVec3;

impl Beams {
    /// Returns, for each beam, the angle in radians between the directions in which light of two refractive indices leaves
    /// it, followed from the eye along the facets of the beam; π where light of one index leaves and that of the other is
    /// totally reflected. It is 0 for the surface's glare, and where the beam's own light does not leave.
    ///
    /// Nothing is linearised. `polytope` must be the one that was traced.
    pub fn fans(&self, polytope: &Polytope, indices: [f64; 2]) -> Vec<f64> {
        let mut fans = Vec::with_capacity(self.len());
        // For each beam, the directions of light of both indices that goes on inside.
        let mut onward: Vec<[DVec3; 2]> = Vec::with_capacity(self.len());
        for beam in self.iter() {
            let normal = polytope.facets()[beam.facet as usize].plane.normal;
            let Some(parent) = beam.parent else {
                let ray = -self.view.toward;
                let cos_i = -ray.dot(normal);
                onward.push(indices.map(|index| {
                    let eta = 1.0 / index;
                    // From outside, light always enters; at index 1 and grazing incidence rounding may say otherwise.
                    let cos_t = cos_transmitted(cos_i, eta).unwrap_or(0.0);
                    refract(ray, normal, eta, (cos_i, cos_t)).normalize_or_zero()
                }));
                fans.push(0.0);
                continue;
            };
            let rays = onward[parent as usize];
            let leaving = |k: usize| {
                let cos_i = rays[k].dot(normal);
                let cos_t = cos_transmitted(cos_i, indices[k])?;
                Some(refract(rays[k], -normal, indices[k], (cos_i, cos_t)))
            };
            fans.push(match (beam.weight > 0.0, leaving(0), leaving(1)) {
                (false, ..) => 0.0,
                (true, Some(a), Some(b)) => a.cross(b).length().atan2(a.dot(b)),
                (true, ..) => std::f64::consts::PI,
            });
            onward.push(rays.map(|ray| reflect(ray, -normal, ray.dot(normal)).normalize_or_zero()));
        }
        fans
    }
}

#[cfg(test)]
mod tests {
    use super::super::{BeamOptions, trace};
    use crate::cut::TOLKOWSKY;
    use crate::math::{Plane, Polytope};
    use crate::scene::{Medium, View};
    use crate::trace::unwatched;

    #[test]
    fn the_fan_of_near_indices_is_the_sweep_to_first_order_and_that_of_one_index_is_nothing() {
        let planes: Vec<Plane> = TOLKOWSKY.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
        let stone = Polytope::from_planes(&planes).unwrap();
        let spread = 1e-6;
        let medium = Medium { spread, ..Medium::clear(2.4175) };
        let view = View { tilt: 0.2, azimuth: 0.3, ..View::default() };
        let options = BeamOptions { unresolved: 0.05, ..BeamOptions::default() };
        let beams = trace(&stone, medium, &view, &options, &unwatched).unwrap();
        let indices = [medium.index - spread / 2.0, medium.index + spread / 2.0];
        let (fans, sweeps) = (beams.fans(&stone, indices), beams.sweeps(&stone));
        let mut compared = 0;
        for (fan, sweep) in fans.iter().zip(&sweeps).filter(|(fan, _)| **fan > 1e-8 && **fan < 1e-4) {
            assert!((fan / sweep.length() - 1.0).abs() < 1e-3, "{fan} is not {}", sweep.length());
            compared += 1;
        }
        assert!(compared > 300, "{compared}");
        assert!(beams.fans(&stone, [2.4175; 2]).iter().all(|&fan| fan == 0.0));
    }
}
