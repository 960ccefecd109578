//! A ray that represents a band of wavelengths and a stretch of its pixel.

use glam::DVec3;

/// A ray from the eye, between two facets, or away from a stone. It includes its change over the range that it
/// represents: the wavelengths of a band, and a stretch of its pixel
/// ([`SamplePass::footprint`](super::sampling::SamplePass::footprint)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DispersedRay {
    /// The point where the ray begins.
    pub origin: DVec3,
    /// The direction in which the ray travels, of length 1.
    pub direction: DVec3,
    /// The change of the direction from one end of the range that the ray represents to the other.
    pub fan: DVec3,
    /// The displacement of the origin from one end of that range to the other.
    pub shift: DVec3,
}

impl DispersedRay {
    /// Returns a ray that represents one wavelength and one point of the pixel.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, fan: DVec3::ZERO, shift: DVec3::ZERO }
    }

    /// Returns whether the ray changes at all over the range that it represents.
    pub fn is_fanned(&self) -> bool {
        self.fan != DVec3::ZERO || self.shift != DVec3::ZERO
    }

    /// Returns the same ray with its origin moved ahead by this distance.
    pub fn ahead(&self, distance: f64) -> Self {
        Self {
            origin: self.origin + self.direction * distance,
            shift: self.shift + self.fan * distance,
            ..*self
        }
    }
}
