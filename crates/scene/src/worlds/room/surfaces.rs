//! The surface at the point where a ray meets the room.

use glam::{DVec2, DVec3};

/// The surface at the point where a ray meets the room.
pub(super) struct RoomSurface {
    pub(super) normal: DVec3,
    /// The share of light that is sent back; zero where the surface only emits light.
    pub(super) albedo: DVec3,
    /// The radiance that the surface emits itself, white being 1.
    pub(super) own: DVec3,
    /// The part of the room's light that reaches it, 0 to 1.
    pub(super) shelter: f64,
    /// The strength of its mirror image, 0 to 1, the blur of the image in radians, and the lean of the mirror.
    pub(super) gloss: f64,
    pub(super) blur: f64,
    pub(super) tilt: DVec2,
}

impl RoomSurface {
    pub(super) fn new(normal: DVec3, albedo: DVec3) -> Self {
        Self { normal, albedo, own: DVec3::ZERO, shelter: 1.0, gloss: 0.0, blur: 0.0, tilt: DVec2::ZERO }
    }

    pub(super) fn shining(light: DVec3) -> Self {
        Self { own: light, ..Self::new(DVec3::Z, DVec3::ZERO) }
    }
}
