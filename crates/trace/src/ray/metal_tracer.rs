//! Reflects rays at bodies of metal.

use crate::DispersedRay;
use brillianteer_math::{Ball, Pose, ShadedMesh, SurfaceNormals};
use brillianteer_optics::{RoughMetal, Roughness};
use brillianteer_scene::MetalInstance;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::sync::Arc;

/// The lift of mirror images that smooth normals would send below the surface: a share of the outgoing direction's
/// sine above the surface, and the greatest sine.
const LIFT: (f64, f64) = (0.9, 0.01);

/// The least sine at which light leaves the true surface.
const LEAST_SINE: f64 = 1e-6;

/// The number of equal parts into which reflected light is divided; one look-up of the environment represents one
/// part. More parts would leave more noise to pictures of few passes; 32 widen an even highlight by √(1 + 1/32) - 1, 1.5 %.
const PARTS: f64 = 32.0;

/// The longest step of a hit over the stretch that a ray represents, in lengths of the stretch.
const LONGEST_STEP: f64 = 4.0;

/// The widest fan of directions, in radians, to which a curved surface opens the fan of a ray.
const WIDEST_BEND: f64 = 0.3;

/// A body of metal, and its reflectance in a band of wavelengths.
#[derive(Debug, Clone)]
pub(super) struct MetalTracer {
    mesh: Arc<ShadedMesh>,
    pose: Pose,
    /// A ball around the body, in the world.
    ball: Ball,
    roughness: f64,
    /// The rough surface with the index of the band; `None` before the body has an index.
    finish: Option<RoughMetal>,
}

/// The place where a ray meets a body of metal: the body, the triangle and the distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MetalHit {
    pub metal: usize,
    pub triangle: u32,
    pub distance: f64,
}

/// A ray that metal has reflected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MetalReflection {
    /// The reflected ray. It changes as at a mirror with the curvature of the surface.
    pub ray: DispersedRay,
    /// The factor by which the light from that direction counts.
    pub weight: f64,
    /// The side, in radians, of the square of directions that the ray represents; 0 for one direction.
    pub spread: f64,
}

impl MetalTracer {
    /// Prepares the bodies of a scene; [`made_of`](Self::made_of) gives them their indices.
    pub fn of_all(metals: &[MetalInstance]) -> Vec<Self> {
        let tracer = |metal: &MetalInstance| Self {
            mesh: Arc::clone(&metal.mesh),
            pose: metal.pose,
            ball: metal.ball(),
            roughness: metal.roughness,
            finish: None,
        };
        metals.iter().map(tracer).collect()
    }

    /// Returns the same body at a wavelength at which its metal has this index.
    pub fn made_of(&self, index: Complex64) -> Self {
        Self { finish: Some(Roughness::shared(self.roughness).of_metal(index)), ..self.clone() }
    }

    /// Returns the triangle and the distance at which a ray meets the body. `left` is the triangle that the ray has
    /// just left.
    fn meet(&self, origin: DVec3, direction: DVec3, left: Option<u32>) -> Option<(u32, f64)> {
        if !self.ball.is_met(origin, direction) {
            return None;
        }
        let (origin, direction) = (self.pose.unplace(origin), self.pose.turn.inverse() * direction);
        let hit = self.mesh.meet(origin, direction, left)?;
        Some((hit.triangle, hit.distance * self.pose.scale))
    }

    /// Returns the change of the smooth normal along a step in a triangle's plane; all vectors are in the world.
    fn change_of_normal(&self, triangle: u32, point: DVec3, step: DVec3) -> DVec3 {
        let step = self.pose.turn.inverse() * step / self.pose.scale;
        self.pose.turn * self.mesh.change_of_normal(triangle, self.pose.unplace(point), step)
    }

    /// Reflects a ray in a direction that is drawn by three random numbers; `None` where the drawn light is lost, and
    /// where the body has no index yet.
    pub fn reflect(&self, ray: &DispersedRay, hit: &MetalHit, luck: [f64; 3]) -> Option<MetalReflection> {
        let DispersedRay { origin: point, direction, fan, shift } = ray.ahead(hit.distance);
        let SurfaceNormals { flat, shading } = self.mesh.normals(hit.triangle, self.pose.unplace(point));
        let [flat, shading] = [flat, shading].map(|normal| self.pose.turn * normal);
        let out = -direction;
        let side = if flat.dot(out) < 0.0 { -1.0 } else { 1.0 };
        let (flat, shading) = (flat * side, shading * side);
        let up = bent(shading, flat, out);
        let (right, ahead) = up.any_orthonormal_pair();
        let own = DVec3::new(right.dot(out), ahead.dot(out), up.dot(out).max(LEAST_SINE));
        let found = self.finish.as_ref()?.sample(own / own.length(), luck)?;
        let own = found.direction;
        let toward = above(right * own.x + ahead * own.y + up * own.z, flat);
        let middle = (toward + out).normalize_or(up);
        let step = step_along(shift, direction, flat);
        let turn = self.change_of_normal(hit.triangle, point, step) * side;
        let spread = (1.0 / found.density).min(4.0 * PI) / PARTS;
        Some(MetalReflection {
            ray: DispersedRay {
                origin: point,
                direction: toward,
                fan: mirrored_fan(fan, direction, middle, turn),
                shift,
            },
            weight: found.weight,
            spread: spread.sqrt(),
        })
    }
}

/// Returns the first hit of a ray on metal. `left` is the body, and its triangle, that the ray has just left.
pub(super) fn nearest_metal(
    metals: &[MetalTracer],
    (origin, direction): (DVec3, DVec3),
    left: Option<(usize, u32)>,
) -> Option<MetalHit> {
    let hit = |(metal, tracer): (usize, &MetalTracer)| {
        let own = left.filter(|(left, _)| *left == metal).map(|(_, triangle)| triangle);
        let (triangle, distance) = tracer.meet(origin, direction, own)?;
        Some(MetalHit { metal, triangle, distance })
    };
    metals.iter().enumerate().filter_map(hit).min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Returns the step in the plane with the normal `flat` by which the hit moves where the ray's origin is shifted. It is at
/// most [`LONGEST_STEP`] times as long as the shift, which would be unbounded at outlines.
fn step_along(shift: DVec3, direction: DVec3, flat: DVec3) -> DVec3 {
    let slope = direction.dot(flat);
    if slope == 0.0 {
        return DVec3::ZERO;
    }
    let step = shift - direction * (shift.dot(flat) / slope);
    step.clamp_length_max(LONGEST_STEP * shift.length())
}

/// Returns the fan of a ray that a mirror with the normal `middle` reflects, which turns by `turn` over the stretch that the
/// ray represents (H. Igehy, *Tracing Ray Differentials*, SIGGRAPH 1999, eq. 15); no wider than [`WIDEST_BEND`].
fn mirrored_fan(fan: DVec3, direction: DVec3, middle: DVec3, turn: DVec3) -> DVec3 {
    let turn = turn - middle * middle.dot(turn);
    let along = middle * (fan.dot(middle) + direction.dot(turn)) + turn * direction.dot(middle);
    (fan - along * 2.0).clamp_length_max(WIDEST_BEND.max(fan.length()))
}

/// Returns the side of the square of directions that a ray represents after it has been spread by one rough surface and
/// then by another, each with its own side. Squares grow as the widths of independent errors do, and no wider than a
/// part of the whole sphere. What stone and metal between the two do to the width of the first is left out.
pub(super) fn wider(own: f64, before: f64) -> f64 {
    own.hypot(before).min((4.0 * PI / PARTS).sqrt())
}

/// Returns the normal of a smooth surface, turned toward the true normal just far enough that the mirror image along
/// it leaves the true surface (A. Keller et al., *The Iray Light Transport Simulation and Rendering System*, 2017,
/// appendix A.3).
fn bent(shading: DVec3, flat: DVec3, out: DVec3) -> DVec3 {
    let image = shading * (2.0 * shading.dot(out)) - out;
    let least = (LIFT.0 * flat.dot(out)).min(LIFT.1);
    let lacking = least - image.dot(flat);
    if lacking <= 0.0 {
        return shading;
    }
    let lifted = (image + flat * lacking).normalize_or(flat);
    (out + lifted).normalize_or(flat)
}

/// Returns a direction unchanged where it leaves the true surface, and otherwise its mirror image in that surface, so
/// that light which rough metal sends below the surface is not lost.
fn above(direction: DVec3, flat: DVec3) -> DVec3 {
    let sine = direction.dot(flat);
    let lifted = direction + flat * (sine.abs().max(LEAST_SINE) - sine);
    if sine >= LEAST_SINE { direction } else { lifted.normalize_or(flat) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bent_normal_mirrors_above_the_surface_and_is_kept_where_that_is_so_anyway() {
        let flat = DVec3::Z;
        let mut kept = [0; 2];
        for k in 0..2000 {
            let (a, b) = (f64::from(k) * 0.618_034 % 1.0, f64::from(k) * 0.754_878 % 1.0);
            let (lean, low) = (1.2 * a, 1.57 * b);
            let shading = DVec3::new(
                lean.sin() * (f64::from(k) * 0.3).cos(),
                lean.sin() * (f64::from(k) * 0.3).sin(),
                lean.cos(),
            );
            let out = DVec3::new(low.sin(), 0.0, low.cos());
            let up = bent(shading, flat, out);
            let image = |up: DVec3| up * (2.0 * up.dot(out)) - out;
            assert!((up.length() - 1.0).abs() < 1e-12 && up.dot(out) > 0.0);
            let is_above = image(shading).dot(flat) >= LIFT.1;
            assert!(image(up).dot(flat) > 0.0, "{k}: {}", image(up).dot(flat));
            assert!(!is_above || up == shading);
            kept[usize::from(up == shading)] += 1;
        }
        assert!(kept.iter().all(|&count| count > 100), "{kept:?}");
    }

    #[test]
    fn what_would_go_below_the_surface_is_mirrored_up() {
        let below = DVec3::new(0.6, 0.0, -0.8);
        assert!(above(below, DVec3::Z).distance(DVec3::new(0.6, 0.0, 0.8)) < 1e-12);
        assert_eq!(above(-below, DVec3::Z), -below);
        assert!(above(DVec3::X, DVec3::Z).z > 0.0);
    }

    #[test]
    fn a_round_mirror_opens_a_fan_as_the_rays_at_its_ends_say() {
        for (normal, side) in [
            (DVec3::new(0.36, -0.48, 0.8), DVec3::X),
            (DVec3::new(0.64, 0.48, 0.6), DVec3::new(0.6, 0.8, 0.0)),
        ] {
            // The ray runs along -z, and meets a ball with radius 1 after a distance of 1.
            let (shift, fan) = (side * 1e-5, DVec3::Y * 2e-5);
            let mirrored = |part: f64| {
                let from = normal + DVec3::Z + shift * part;
                let way = DVec3::NEG_Z + fan * part;
                let way = way / way.length();
                let b = from.dot(way);
                let met = from - way * (b + (b * b - from.length_squared() + 1.0).sqrt());
                way - met * (2.0 * way.dot(met))
            };
            let expected = mirrored(0.5) - mirrored(-0.5);
            // The normal of such a ball turns by as much as the hit moves.
            let turn = step_along(shift + fan, DVec3::NEG_Z, normal);
            let found = mirrored_fan(fan, DVec3::NEG_Z, normal, turn);
            assert!(found.distance(expected) < 1e-9 && expected.length() > 3e-5, "{found} {expected}");
            assert!(mirrored_fan(fan, DVec3::NEG_Z, normal, DVec3::ZERO).distance(expected) > 1e-5);
        }
        let grazing = step_along(DVec3::X, DVec3::new(0.0, -1.0, 0.0), DVec3::new(0.8, 1e-9, 0.6));
        assert!((grazing.length() - LONGEST_STEP).abs() < 1e-9);
        assert!(mirrored_fan(DVec3::ZERO, DVec3::NEG_Z, DVec3::Z, DVec3::X).length() <= WIDEST_BEND + 1e-12);
    }
}
