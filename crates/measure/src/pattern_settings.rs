//! The settings of measures of the pattern that an eye sees on the face.

use serde::{Deserialize, Serialize};

/// The resolution of an eye, mm: one minute of arc at 250 mm.
pub const EYE_RESOLVES_MM: f64 = 250.0 * std::f64::consts::PI / (180.0 * 60.0);

/// The size of a thing whose shape an eye recognises, as a multiple of the eye's resolution: letters of a line that
/// is just legible are five times as high as their strokes are wide (H. Snellen, Optotypi ad visum determinandum,
/// 1862).
pub const SHAPE_IS_SEEN: f64 = 5.0;

/// The default angle in degrees by which a stone rocks for scintillation.
pub const ROCK_DEG: f64 = 3.0;

/// The size of the stone and the resolution of the eye.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PatternSettings {
    /// The resolution of the eye, mm, above 0; [`EYE_RESOLVES_MM`] unless the stone is seen from another distance.
    pub resolves_mm: f64,
    /// The girdle radius in mm, above 0.
    pub unit_mm: f64,
    /// The angle by which the stone rocks for scintillation, degrees, above 0 and at most 45; `None` leaves
    /// scintillation out.
    pub rock_deg: Option<f64>,
}

impl PatternSettings {
    /// Returns the usual settings for a stone of this girdle radius, without scintillation.
    pub fn usual(unit_mm: f64) -> Self {
        Self { resolves_mm: EYE_RESOLVES_MM, unit_mm, rock_deg: None }
    }

    /// Returns the resolution of the eye, in girdle radii.
    pub(super) fn resolves(&self) -> f64 {
        self.resolves_mm / self.unit_mm
    }
}
