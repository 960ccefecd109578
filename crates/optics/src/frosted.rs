//! Frosted surfaces of transparent media. Their microscopic facets reflect and refract; the slopes of the facets
//! follow the law of Trowbridge and Reitz (GGX).
//!
//! The model is that of B. Walter et al., *Microfacet Models for Refraction through Rough Surfaces*, EGSR 2007, with
//! Smith's masking. Light that meets more than one microscopic facet is followed on, as in E. Heitz et al.,
//! *Multiple-Scattering Microfacet BSDFs with the Smith Model*, SIGGRAPH 2016: a ray walks among the facets until it
//! leaves them on one side. Every walk carries all of its light, so that the surface loses none. The code was written
//! from the papers' formulas.

use super::fresnel::reflectance;
use super::microfacets::{hidden, visible_normal};
use super::snell::{cos_transmitted, reflect, refract};
use glam::DVec3;

/// The least width of the law of slopes that a frosted surface may have.
const LEAST_ALPHA: f64 = 1e-3;

/// The most microscopic facets that a ray may meet; fewer than one ray in a million meets as many.
const MOST_MET: usize = 100;

/// The least cosine between a ray and a microscopic facet that it meets, against rounding.
const LEAST_COS: f64 = 1e-9;

/// The greatest share of the surface below a microscopic facet, against rounding.
const HIGHEST: f64 = 1.0 - 1e-12;

/// A frosted surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrostedSurface {
    /// The width of the law of slopes.
    alpha: f64,
}

/// Light that a frosted surface has scattered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrostedScatter {
    /// The direction in which the light goes on, of length 1.
    pub direction: DVec3,
    /// True where the light has passed to the other side of the surface.
    pub passes: bool,
}

impl FrostedSurface {
    /// Makes a frosted surface. `frosting`, above 0 to 1, is the width α of the law of slopes.
    pub fn new(frosting: f64) -> Self {
        Self { alpha: frosting.clamp(LEAST_ALPHA, 1.0) }
    }

    /// Returns the side, in radians, of a square of directions that is small compared with the lobe into which the
    /// surface scatters light: its area is a sixty-fourth of the area of a square with the side 2 α.
    pub fn spread(&self) -> f64 {
        0.25 * self.alpha
    }

    /// Scatters light that arrives in a direction of length 1 at a surface whose unit normal points to the side that
    /// the light comes from. `eta` is incident index / transmitted index. Two random numbers from 0 to below 1 decide
    /// the path: `first` decides about the first microscopic facet, `more` about all further ones. All light goes on
    /// in the direction that is returned.
    ///
    /// `None` where the light meets too many facets, or does not travel towards the surface.
    pub fn scatter(
        &self,
        arriving: DVec3,
        normal: DVec3,
        eta: f64,
        first: [f64; 3],
        mut more: impl FnMut() -> f64,
    ) -> Option<FrostedScatter> {
        let (right, ahead) = normal.any_orthonormal_pair();
        let mut way = DVec3::new(arriving.dot(right), arriving.dot(ahead), arriving.dot(normal));
        if way.z >= 0.0 {
            return None;
        }
        if eta == 1.0 {
            // Between equal media there is no surface.
            return Some(FrostedScatter { direction: arriving, passes: true });
        }
        let (mut eta, mut passes) = (eta, false);
        // The share of the surface that lies below the ray; `way.z` is positive where the ray runs away from the surface,
        // on the ray's side of it.
        let mut below = 1.0;
        let mut luck = Some(first);
        for _ in 0..MOST_MET {
            below = next_below(self.alpha, way.z, below, more());
            if below >= 1.0 {
                let side = if passes { -1.0 } else { 1.0 };
                let direction = right * way.x + ahead * way.y + normal * (side * way.z);
                return Some(FrostedScatter { direction: direction / direction.length(), passes });
            }
            let [u, v, chance] = luck.take().unwrap_or_else(|| [more(), more(), more()]);
            let facet = visible_normal(self.alpha, -way, [u, v]);
            let cos_i = (-way.dot(facet)).clamp(LEAST_COS, 1.0);
            match cos_transmitted(cos_i, eta) {
                Some(cos_t) if chance >= reflectance(cos_i, eta).unwrap_or(1.0) => {
                    let through = unit(refract(way, facet, eta, (cos_i, cos_t)));
                    // Seen from the other side, the surface is upside down.
                    way = DVec3::new(through.x, through.y, -through.z);
                    (below, eta, passes) = (1.0 - below, 1.0 / eta, !passes);
                }
                _ => way = unit(reflect(way, facet, cos_i)),
            }
        }
        None
    }
}

/// Returns the share of the surface below the place where a ray meets the next microscopic facet; 1 or more where the
/// ray meets none. `up` is the cosine between the ray and the normal, positive on the way away from the surface,
/// `below` the share of the surface below the ray's beginning, and `chance` a random number from 0 to below 1. (Heitz
/// et al. 2016, section 4.1: a ray meets nothing between two heights with a probability of the quotient of these
/// shares to the power of Smith's Λ, which is below 0 on the way down.)
fn next_below(alpha: f64, up: f64, below: f64, chance: f64) -> f64 {
    let lambda = hidden(alpha, up);
    match up > 0.0 {
        true => below * chance.powf(-1.0 / lambda),
        // A ray on its way down always meets a facet.
        false => (below * chance.powf(1.0 / (1.0 + lambda))).min(HIGHEST),
    }
}

fn unit(vector: DVec3) -> DVec3 {
    vector / vector.length()
}

#[cfg(test)]
mod tests {
    use super::super::microfacets::Roughness;
    use super::*;
    use std::f64::consts::TAU;

    /// Returns numbers from 0 to below 1 that look random (G. L. Steele et al., *Fast splittable pseudorandom number
    /// generators*, 2014: SplitMix).
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut place = seed.wrapping_mul(0xd134_2543_de82_ef95);
        move || {
            place = place.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut bits = (place ^ (place >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    fn scattered(alpha: f64, arriving: DVec3, eta: f64, seed: u64) -> Option<FrostedScatter> {
        let mut more = numbers(seed);
        let first = [more(), more(), more()];
        FrostedSurface::new(alpha).scatter(arriving, DVec3::Z, eta, first, more)
    }

    /// Returns the share of even light from one side that passes.
    fn passed_of_even_light(alpha: f64, eta: f64) -> f64 {
        let count = 200_000;
        let passes = |seed: &u64| {
            let mut luck = numbers(seed + (1 << 40));
            let (square, azimuth) = (luck(), TAU * luck());
            let sin = (1.0 - square).sqrt();
            let arriving = DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), -square.sqrt().max(1e-6));
            scattered(alpha, arriving, eta, *seed).unwrap().passes
        };
        (0..count).filter(passes).count() as f64 / count as f64
    }

    #[test]
    fn all_light_goes_on_and_on_the_side_that_is_said() {
        for alpha in [0.001, 0.1, 0.5, 1.0] {
            for eta in [1.0 / 2.42, 1.0 / 1.54, 1.0, 1.54, 2.42] {
                for seed in 0..2000 {
                    let slope = (seed as f64 + 0.5) / 2000.0;
                    let arriving = DVec3::new((1.0 - slope * slope).sqrt(), 0.0, -slope);
                    let found = scattered(alpha, arriving, eta, seed).unwrap();
                    assert!((found.direction.length() - 1.0).abs() < 1e-12);
                    assert_eq!(found.direction.z < 0.0, found.passes, "{alpha} {eta} {found:?}");
                }
            }
        }
        assert_eq!(scattered(0.5, DVec3::Z, 1.5, 0), None, "light that does not arrive");
    }

    #[test]
    fn even_light_passes_both_ways_alike() {
        // Even light carries n² as much in the denser medium, and in balance as much passes in as out.
        for (alpha, index) in [(0.01, 1.54), (0.3, 1.54), (0.5, 2.42), (1.0, 1.77)] {
            let [inward, outward] = [1.0 / index, index].map(|eta| passed_of_even_light(alpha, eta));
            let off = inward - outward * index * index;
            assert!(
                off.abs() < 4.0 * index * index * 0.5 / 200_000_f64.sqrt(),
                "{alpha} {index}: {inward} {outward}"
            );
        }
        // The law notices an index that is wrong by a hundredth.
        let [inward, outward] = [1.0 / 1.54, 1.56].map(|eta| passed_of_even_light(0.3, eta));
        assert!((inward - outward * 1.54 * 1.54).abs() > 0.006, "{}", inward - outward * 1.54 * 1.54);
    }

    #[test]
    fn a_surface_that_is_hardly_frosted_reflects_and_refracts_as_a_smooth_one() {
        let (eta, arriving) = (1.0 / 1.54, DVec3::new(0.6, 0.0, -0.8));
        let count = 100_000;
        let (mut reflected, mut off) = (0, 0.0_f64);
        let cos_t = cos_transmitted(0.8, eta).unwrap();
        for seed in 0..count {
            let found = scattered(0.001, arriving, eta, seed).unwrap();
            reflected += u32::from(!found.passes);
            let expected = if found.passes {
                refract(arriving, DVec3::Z, eta, (0.8, cos_t))
            } else {
                DVec3::new(0.6, 0.0, 0.8)
            };
            off += found.direction.distance(expected) / count as f64;
        }
        assert!(off < 0.004, "{off}");
        let expected = reflectance(0.8, eta).unwrap();
        assert!((f64::from(reflected) / count as f64 - expected).abs() < 0.003);
    }

    #[test]
    fn facets_that_reflect_all_send_out_at_first_as_much_as_rough_metal_does() {
        // Rough metal has a table of that share, integrated over slopes with masking that is correlated by height.
        let surface = |alpha: f64| Roughness::new(alpha.sqrt());
        for (alpha, cos) in [(0.2, 0.9), (0.5, 0.5), (0.8, 0.3), (1.0, 0.8)] {
            let count = 100_000;
            let leaves_at_once = |seed: &u64| {
                let mut luck = numbers(*seed);
                let way = DVec3::new((1.0_f64 - cos * cos).sqrt(), 0.0, -cos);
                let below = next_below(alpha, way.z, 1.0, luck());
                let facet = visible_normal(alpha, -way, [luck(), luck()]);
                let out = reflect(way, facet, -way.dot(facet));
                next_below(alpha, out.z, below, luck()) >= 1.0
            };
            let share = (0..count).filter(leaves_at_once).count() as f64 / count as f64;
            let expected = surface(alpha).once(cos);
            assert!((share - expected).abs() < 0.007, "{alpha} {cos}: {share} {expected}");
        }
    }
}
