//! A ray that stands for more than itself: for the wavelengths of a band, and for a stretch of its pixel.

use glam::DVec3;

/// A ray from the eye, between two facets or away from a stone, and how it changes over what it stands for: over the
/// wavelengths of a band, and over a stretch of its pixel ([`SamplePass::footprint`](super::sampling::SamplePass::footprint)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DispersedRay {
    /// The point where the ray begins.
    pub origin: DVec3,
    /// The direction in which the ray travels, of length 1.
    pub direction: DVec3,
    /// The change of its direction, from one end of what it stands for to the other.
    pub fan: DVec3,
    /// The displacement of its origin, from one end to the other.
    pub shift: DVec3,
}

impl DispersedRay {
    /// Returns a ray that stands for itself alone.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, fan: DVec3::ZERO, shift: DVec3::ZERO }
    }

    /// Whether the ray changes at all over what it stands for.
    pub fn is_fanned(&self) -> bool {
        self.fan != DVec3::ZERO || self.shift != DVec3::ZERO
    }

    /// Returns the same ray, beginning at this distance ahead.
    pub fn ahead(&self, distance: f64) -> Self {
        Self {
            origin: self.origin + self.direction * distance,
            shift: self.shift + self.fan * distance,
            ..*self
        }
    }
}
