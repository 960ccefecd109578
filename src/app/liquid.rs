//! The pane of liquid glass over the background of a view: its settings, as they are kept, and its place in a picture.

use crate::optics::linear_from_encoded;
use crate::picture::liquid_glass::{GlassPane, PaneQuality};
use glam::{DVec2, DVec4};
use serde::{Deserialize, Serialize};

/// The least side of the pane, pixels.
const LEAST: f64 = 8.0;

/// The settings of the pane of liquid glass, as they are kept.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Liquid {
    /// The middle of the pane, in parts of the view from the upper left corner.
    pub at: DVec2,
    /// The width and height of the pane, percent of the view's.
    pub size: DVec2,
    /// The radius of the corners, percent of the pane's shorter side.
    pub corners: f64,
    /// The strength of the refraction, 0 to 100.
    pub refraction: f64,
    /// The strength of the depth, 0 to 100.
    pub depth: f64,
    /// The strength of the dispersion, 0 to 100.
    pub dispersion: f64,
    /// The strength of the frost, 0 to 100.
    pub frost: f64,
    /// The strength of the light, 0 to 100.
    pub light: f64,
    /// The base colour of the pane in sRGB, and how much of it covers what is behind.
    pub tint: [u8; 4],
    /// How much of the effect is drawn.
    pub quality: PaneQuality,
    /// How far above the background the traced pane lies, in parts of the pane's shorter side.
    pub gap: f64,
}

impl Default for Liquid {
    fn default() -> Self {
        Self {
            at: DVec2::splat(0.5),
            size: DVec2::new(62.0, 50.0),
            corners: 30.0,
            refraction: 100.0,
            depth: 100.0,
            dispersion: 100.0,
            frost: 0.0,
            light: 30.0,
            tint: [0; 4],
            quality: PaneQuality::High,
            gap: 0.02,
        }
    }
}

impl Liquid {
    /// Returns the pane in a picture of a size in pixels; the pane lies wholly within the picture.
    pub fn pane(&self, picture: [u32; 2]) -> GlassPane {
        let whole = DVec2::from(picture.map(f64::from));
        let size = (whole * self.size / 100.0).round().clamp(DVec2::splat(LEAST).min(whole), whole);
        let corner = (whole * self.at - size / 2.0).round().clamp(DVec2::ZERO, whole - size);
        let radius = size.min_element() * (self.corners / 100.0).clamp(0.0, 0.5);
        let [red, green, blue, alpha] = self.tint.map(|code| f64::from(code) / 255.0);
        let [red, green, blue] = [red, green, blue].map(linear_from_encoded);
        GlassPane {
            refraction: self.refraction,
            depth: self.depth,
            dispersion: self.dispersion,
            frost: self.frost,
            light: self.light,
            tint: DVec4::new(red, green, blue, alpha),
            quality: self.quality,
            ..GlassPane::clear(corner, size, radius)
        }
    }

    /// Moves the pane by parts of the view, but not out of it.
    pub fn drag(&mut self, by: DVec2) {
        let half = (self.size / 200.0).clamp(DVec2::ZERO, DVec2::splat(0.5));
        self.at = (self.at + by).clamp(half, 1.0 - half);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pane_stays_in_its_picture() {
        let mut liquid = Liquid::default();
        for by in [DVec2::new(9.0, -9.0), DVec2::new(-0.1, 0.3), DVec2::splat(-9.0)] {
            liquid.drag(by);
            for picture in [[200, 120], [33, 400], [8, 8]] {
                let pane = liquid.pane(picture);
                let whole = DVec2::from(picture.map(f64::from));
                assert!(pane.corner.min_element() >= 0.0 && (pane.corner + pane.size).cmple(whole).all());
                assert!(pane.unit() >= LEAST && pane.radius <= pane.unit() / 2.0, "{pane:?}");
            }
        }
        assert_eq!(liquid.at, liquid.size / 200.0, "it lies in the corner");
    }
}
