//! The formulas of the specification, one function each. Lengths are parts of the pane's shorter side, strengths 0 to
//! 100.

use super::outline::DomePoint;
use glam::{DVec2, DVec3};

/// Direction toward the light: from above, at 53 degrees of elevation. y points down.
pub(super) const TOWARD_LIGHT: DVec3 = DVec3::new(0.0, -0.6, 0.8);

/// How far dispersion moves red, green and blue, as parts of its amount.
const APART: [f64; 3] = [1.1, 0.0, -0.9];

/// Hermite's smooth step from 0 at `from` to 1 at `to`, as in WGSL.
pub(super) fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns how strongly refraction acts: 0 in the middle and on the outline, 1 between 0.8 and 0.95 of the way.
pub(super) fn falloff(distance: f64) -> f64 {
    smoothstep(0.0, 0.8, distance) * (1.0 - smoothstep(0.95, 1.0, distance))
}

/// Returns the shift of refraction: how far nearer to the middle the place is that a pixel shows.
pub(super) fn refraction(dome: &DomePoint, strength: f64) -> DVec2 {
    let by_normal = dome.normal.truncate() * 0.015;
    let by_radius = dome.radial * dome.distance * 0.008;
    (by_normal + by_radius) * falloff(dome.distance) * strength / 100.0
}

/// Returns the thickness that a strength of depth stands for.
pub(super) fn thickness(strength: f64) -> f64 {
    0.12 * strength / 100.0
}

/// Returns the shift of depth, for the body under the surface: how far nearer to the middle, and by up to half as much
/// higher, the place is that a pixel shows.
pub(super) fn depth(dome: &DomePoint, strength: f64) -> DVec2 {
    let thickness = thickness(strength);
    let along = dome.normal.truncate() * thickness * 0.1 + DVec2::new(0.0, thickness * 0.05);
    along * (1.0 - 0.3 * dome.distance)
}

/// Returns the shifts of dispersion: how far outward red, green and blue are looked up.
pub(super) fn dispersion(dome: &DomePoint, strength: f64) -> [DVec2; 3] {
    let amount = dome.distance * 0.003 * strength / 100.0;
    APART.map(|part| dome.radial * (amount * part))
}

/// Returns the white light that the surface adds, after J. H. Lambert and J. F. Blinn (1977), with a rim in place of
/// Fresnel's reflection.
pub(super) fn light(normal: DVec3, strength: f64) -> f64 {
    let half = TOWARD_LIGHT + DVec3::Z;
    let half = half / half.length();
    let diffuse = normal.dot(TOWARD_LIGHT).max(0.0) * 0.3;
    let shine = normal.dot(half).max(0.0).powi(32) * 0.5;
    let rim = (1.0 - normal.z).powi(3) * 0.3;
    (diffuse + shine + rim) * strength / 100.0
}
