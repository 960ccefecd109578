//! The angles between the directions in which light of two wavelengths leaves each beam.

use super::tree::{Beam, Beams};
use brillianteer_math::Polytope;
use brillianteer_optics::{cos_transmitted, reflect, refract};
use glam::DVec3;

/// The directions of light of two indices.
pub(super) type Pair = [DVec3; 2];

impl Beams {
    /// Returns, for each beam, the angle in radians between the directions in which light of two refractive indices leaves
    /// it, followed from the eye along the facets of the beam; π where light of one index leaves and that of the other is
    /// totally reflected. It is 0 for the surface's glare, and where the beam's own light does not leave.
    ///
    /// The result is exact and not to first order. `polytope` must be the one that was traced.
    pub fn fans(&self, polytope: &Polytope, indices: [f64; 2]) -> Vec<f64> {
        let onward = self.onward_pairs(polytope, indices);
        let fan = |beam: Beam| {
            let Some(parent) = beam.parent.filter(|_| beam.weight > 0.0) else { return 0.0 };
            let normal = polytope.facets()[beam.facet as usize].plane.normal;
            match leaving(onward[parent as usize], normal, indices) {
                [Some(a), Some(b)] => a.cross(b).length().atan2(a.dot(b)),
                _ => std::f64::consts::PI,
            }
        };
        self.iter().map(fan).collect()
    }

    /// Returns the directions in which light of two indices goes on inside from the end of each beam.
    pub(super) fn onward_pairs(&self, polytope: &Polytope, indices: [f64; 2]) -> Vec<Pair> {
        let mut onward: Vec<Pair> = Vec::with_capacity(self.len());
        for beam in self.iter() {
            let normal = polytope.facets()[beam.facet as usize].plane.normal;
            let next = match beam.parent {
                Some(parent) => onward[parent as usize]
                    .map(|ray| reflect(ray, -normal, ray.dot(normal)).normalize_or_zero()),
                None => indices.map(|index| {
                    let (ray, eta) = (-self.view.toward, 1.0 / index);
                    let cos_i = -ray.dot(normal);
                    // From outside, light always enters. At index 1 and grazing incidence, rounding may give no
                    // cosine.
                    let cos_t = cos_transmitted(cos_i, eta).unwrap_or(0.0);
                    refract(ray, normal, eta, (cos_i, cos_t)).normalize_or_zero()
                }),
            };
            onward.push(next);
        }
        onward
    }
}

/// Returns the directions in which light of two indices leaves through a facet; `None` for light that is totally
/// reflected.
pub(super) fn leaving(rays: Pair, normal: DVec3, indices: [f64; 2]) -> [Option<DVec3>; 2] {
    std::array::from_fn(|k| {
        let cos_i = rays[k].dot(normal);
        let cos_t = cos_transmitted(cos_i, indices[k])?;
        Some(refract(rays[k], -normal, indices[k], (cos_i, cos_t)))
    })
}

#[cfg(test)]
mod tests {
    use super::super::{BeamOptions, grow::trace_bounces, trace};
    use brillianteer_base::unwatched;
    use brillianteer_cut::TOLKOWSKY;
    use brillianteer_math::{Plane, Polytope};
    use brillianteer_scene::{Medium, View};
    use glam::DVec3;

    #[test]
    fn the_fan_of_near_indices_is_the_exit_change_to_first_order_and_that_of_one_index_is_nothing() {
        let planes: Vec<Plane> = TOLKOWSKY.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
        let stone = Polytope::from_planes(&planes).unwrap();
        let spread = 1e-6;
        let medium = Medium { spread, ..Medium::clear(2.4175) };
        let view = View { tilt: 0.2, azimuth: 0.3, ..View::default() };
        let options = BeamOptions { unresolved: 0.05, ..BeamOptions::default() };
        let beams = trace(&stone, medium, &view, &options, &unwatched).unwrap();
        let indices = [medium.index - spread / 2.0, medium.index + spread / 2.0];
        let (fans, exit_changes) = (beams.fans(&stone, indices), beams.exit_changes(&stone));
        let mut compared = 0;
        for (fan, exit_change) in
            fans.iter().zip(&exit_changes).filter(|(fan, _)| **fan > 1e-8 && **fan < 1e-4)
        {
            assert!((fan / exit_change.length() - 1.0).abs() < 1e-3, "{fan} is not {}", exit_change.length());
            compared += 1;
        }
        assert!(compared > 300, "{compared}");
        assert!(beams.fans(&stone, [2.4175; 2]).iter().all(|&fan| fan == 0.0));
    }

    /// Returns planes of a brilliant without symmetry. They meet by threes, so that each may move alone.
    fn uneven_planes() -> Vec<Plane> {
        let mut state = 0.5;
        // Numbers spread evenly over -0.01 to 0.01 by the golden section.
        let mut some = || {
            state = f64::fract(state + 0.618_033_988_749_895);
            0.01 * (2.0 * state - 1.0)
        };
        let facets = TOLKOWSKY.facets().unwrap().into_iter().filter(|(name, _)| !name.starts_with("girdle"));
        let moved = |(_, plane): (String, Plane)| Plane {
            normal: (plane.normal + DVec3::new(some(), some(), some())).normalize_or_zero(),
            offset: plane.offset + some(),
        };
        facets.map(moved).collect()
    }

    #[test]
    fn derivatives_of_fans_by_planes_and_by_the_index_are_those_of_differences() {
        let planes = uneven_planes();
        let view = View { tilt: 0.13, azimuth: 0.4, ..View::default() };
        let options = BeamOptions { symmetry: false, ..BeamOptions::default() };
        let of = |planes: &[Plane], by: f64| {
            let stone = Polytope::from_planes(planes).unwrap();
            let beams = trace_bounces(&stone, Medium::clear(2.4175 + by), &view, &options, 3);
            (beams.fans(&stone, [2.40 + by, 2.44 + by]), beams, stone)
        };
        let (fans, beams, stone) = of(&planes, 0.0);
        // Neighbouring stones have the same beams in the same order. Wide fans change too fast for differences.
        let is_even = |fan: f64| fan > 1e-6 && fan < 0.2;
        let sum = |planes: &[Plane], by: f64| {
            let (other, ..) = of(planes, by);
            assert_eq!(other.len(), fans.len());
            fans.iter().zip(&other).filter(|(own, _)| is_even(**own)).map(|(_, other)| other).sum::<f64>()
        };
        let per: Vec<f64> = fans.iter().map(|&fan| if is_even(fan) { 1.0 } else { 0.0 }).collect();
        assert!(per.iter().sum::<f64>() > 300.0);
        let found = beams.fan_derivatives(&stone, [2.40, 2.44], &per, &brillianteer_base::unwatched).unwrap();
        let difference = |step: f64, of: &dyn Fn(f64) -> f64| {
            (8.0 * (of(step) - of(-step)) - (of(2.0 * step) - of(-2.0 * step))) / (12.0 * step)
        };
        let by_index = difference(1e-5, &|h| sum(&planes, h));
        assert!((found.index / by_index - 1.0).abs() < 1e-6, "{} is not {by_index}", found.index);
        for (k, facet) in stone.facets().iter().enumerate().step_by(5) {
            let at =
                planes.iter().position(|plane| plane.normal.distance(facet.plane.normal) < 1e-9).unwrap();
            let (axis, _) = facet.plane.normal.any_orthonormal_pair();
            let turned = difference(1e-6, &|h| {
                let mut planes = planes.clone();
                planes[at].normal = facet.plane.normal * h.cos() + axis * h.sin();
                sum(&planes, 0.0)
            });
            let own = found.normals[k].dot(axis);
            assert!((own - turned).abs() < 1e-6 * turned.abs().max(1.0), "facet {k}: {own} is not {turned}");
        }
    }
}
