//! The formulas of the specification, one function each. Lengths are parts of the pane's shorter side, strengths 0 to
//! 100.

use super::outline::DomePoint;
use glam::DVec2;

/// The shifts of red and blue by dispersion, as parts of its amount; green stays.
pub(super) const RED_AND_BLUE: [f64; 2] = [1.1, -0.9];

/// Hermite's smooth step from 0 at `from` to 1 at `to`, as in WGSL.
pub(super) fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns the strength of refraction at a distance: 0 in the middle and on the outline, 1 between 0.8 and 0.95 of
/// the way.
pub(super) fn falloff(distance: f64) -> f64 {
    smoothstep(0.0, 0.8, distance) * (1.0 - smoothstep(0.95, 1.0, distance))
}

/// Returns the shift of refraction: a pixel shows a place that is nearer to the middle by it.
pub(super) fn refraction(dome: &DomePoint, strength: f64) -> DVec2 {
    let by_normal = dome.normal.truncate() * 0.015;
    let by_radius = dome.radial * dome.distance * 0.008;
    (by_normal + by_radius) * falloff(dome.distance) * strength / 100.0
}

/// Returns the thickness that a strength of depth stands for.
pub(super) fn thickness(strength: f64) -> f64 {
    0.12 * strength / 100.0
}

/// Returns the shift of depth, for the body under the surface: a pixel shows a place that is nearer to the middle,
/// and higher by up to half as much.
pub(super) fn depth(dome: &DomePoint, strength: f64) -> DVec2 {
    let thickness = thickness(strength);
    let along = dome.normal.truncate() * thickness * 0.1 + DVec2::new(0.0, thickness * 0.05);
    along * (1.0 - 0.3 * dome.distance)
}

/// Returns a unit of dispersion: the outward shift of the look-up for a colour whose part of the amount is 1.
pub(super) fn dispersion(dome: &DomePoint, strength: f64) -> DVec2 {
    dome.radial * (dome.distance * 0.003 * strength / 100.0)
}
