//! Derivatives of the angles between the directions in which light of two wavelengths leaves.

use super::super::fan::{Pair, leaving};
use super::super::tree::Beams;
use super::PlaneDerivatives;
use super::WATCHED;
use brillianteer_base::{Stopped, Watch, go_on};
use brillianteer_math::Polytope;
use brillianteer_optics::cos_transmitted;
use glam::DVec3;

impl Beams {
    /// Returns how a sum over the [`fans`](Self::fans) of these beams changes with the planes of all facets of `polytope`,
    /// which must be the one that was traced, and with both indices if they change alike. `per_fan` is the change of the sum
    /// per radian of each beam's fan; it must be 0 where the fan is π, because light of one index is totally reflected there.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn fan_derivatives(
        &self,
        polytope: &Polytope,
        indices: [f64; 2],
        per_fan: &[f64],
        watch: Watch,
    ) -> Result<PlaneDerivatives, Stopped> {
        let facets = polytope.facets();
        let onward = self.onward_pairs(polytope, indices);
        let mut per_onward: Vec<Pair> = vec![[DVec3::ZERO; 2]; self.len()];
        let mut found = PlaneDerivatives::none(facets.len());
        for id in (0..self.len() as u32).rev() {
            if id.is_multiple_of(WATCHED) {
                go_on(watch, 1.0 - f64::from(id) / self.len() as f64)?;
            }
            let (node, k) = (&self.nodes[id], id as usize);
            let facet = node.facet as usize;
            let normal = facets[facet].plane.normal;
            let per = per_onward[k];
            let Some(&rays) = onward.get(node.parent as usize) else {
                for (index, per) in indices.into_iter().zip(per) {
                    let back = refraction(-self.view.toward, normal, 1.0 / index, per);
                    found.normals[facet] += back.normal;
                    found.index -= back.eta / (index * index);
                }
                continue;
            };
            let per_exit = Self::per_exit(rays, normal, indices, per_fan[k]);
            for i in 0..2 {
                let along = normal.dot(per[i]);
                let mut per_ray = per[i] - normal * (2.0 * along);
                found.normals[facet] -= rays[i] * (2.0 * along) + per[i] * (2.0 * rays[i].dot(normal));
                if let Some(per_exit) = per_exit {
                    let back = refraction(rays[i], -normal, indices[i], per_exit[i]);
                    found.normals[facet] -= back.normal;
                    found.index += back.eta;
                    per_ray += back.ray;
                }
                per_onward[node.parent as usize][i] += per_ray;
            }
        }
        Ok(found)
    }

    /// Returns the changes per direction of both exits; `None` where the fan does not count or does not open.
    fn per_exit(rays: Pair, normal: DVec3, indices: [f64; 2], per_fan: f64) -> Option<Pair> {
        if per_fan == 0.0 {
            return None;
        }
        let [Some(a), Some(b)] = leaving(rays, normal, indices) else { return None };
        let sin = a.cross(b).length();
        let away = |from: DVec3, other: DVec3| (from * a.dot(b) - other) * (per_fan / sin);
        (sin > 0.0).then(|| [away(a, b), away(b, a)])
    }
}

/// The derivatives of a sum by the quantities on which a refracted direction depends.
struct RefractionAdjoint {
    ray: DVec3,
    /// The derivative by the normal on the side that the light comes from.
    normal: DVec3,
    /// The derivative by the ratio of the indices.
    eta: f64,
}

/// Returns these derivatives from that by the refracted direction, by Snell's law. The light comes along `ray` to a
/// surface whose normal points against it.
fn refraction(ray: DVec3, normal: DVec3, eta: f64, per: DVec3) -> RefractionAdjoint {
    let cos_i = -ray.dot(normal);
    let Some(cos_t) = cos_transmitted(cos_i, eta).filter(|&cos_t| cos_t > 0.0) else {
        return RefractionAdjoint { ray: DVec3::ZERO, normal: DVec3::ZERO, eta: 0.0 };
    };
    let along = normal.dot(per);
    // The refracted direction is η ray + (η cos_i - cos_t) normal, with cos_t² = 1 - η² (1 - cos_i²).
    let per_cos_i = along * (eta - eta * eta * cos_i / cos_t);
    let per_eta = ray.dot(per) + along * (cos_i + eta * (1.0 - cos_i * cos_i) / cos_t);
    RefractionAdjoint {
        ray: per * eta - normal * per_cos_i,
        normal: per * (eta * cos_i - cos_t) - ray * per_cos_i,
        eta: per_eta,
    }
}
