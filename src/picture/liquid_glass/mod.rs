//! Liquid glass: a pane that only looks as if it refracted. Each pixel takes five parts of arithmetic, and no ray is
//! traced.
//!
//! The effect is that of screens: flat, cheap, approximate by design. docs/optics.md, "Liquid glass", says what its
//! specification gives, and what it leaves open and was chosen here. [`compare()`] traces the same pane rightly.
//!
//! A pixel is drawn in these steps: `outline` finds its place on the dome over the pane; `parts` gives the shifts of
//! refraction, depth and dispersion there, and the light that the surface adds; `frost` spreads the look-up; the tint is
//! laid over what is seen.
//!
//! Lengths are parts of the pane's shorter side, measured from the pane's middle, x to the right and y down. A pixel
//! shows the background at a shifted place, so a shift toward the middle makes the background look larger.

mod compare;
mod frost;
mod outline;
mod parts;

pub use compare::{Comparison, Cost, PaneError, PaneLighting, Shifts, compare, surroundings, traced};

use super::{Linear, NameError};
use crate::scene::Panorama;
use crate::trace::sampling::place_in_pixel;
use frost::taps;
use glam::{DVec2, DVec3, DVec4};
use outline::PaneOutline;
use parts::{depth, dispersion, light, refraction};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// The greatest coordinate and size of a pane, in pixels; sums of such numbers stay exact whole numbers.
const FARTHEST: f64 = 1e6;

/// How much of the effect is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PaneQuality {
    /// The whole effect, with five samples of frost.
    #[default]
    High,
    /// The whole effect, with three samples of frost, and dispersion of strength 30 at most.
    Medium,
    /// Refraction alone: no depth, dispersion, frost, light or tint.
    Low,
}

/// A pane of liquid glass over a picture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GlassPane {
    /// The pane's upper left corner, in pixels from the picture's.
    pub corner: DVec2,
    /// The pane's width and height in pixels, above 0.
    pub size: DVec2,
    /// Radius of the outline's corners in pixels, from 0 to half of the shorter side.
    pub radius: f64,
    /// Strength of the refraction; like all strengths it is from 0 to 100.
    pub refraction: f64,
    /// Strength of the depth.
    pub depth: f64,
    /// Strength of the dispersion.
    pub dispersion: f64,
    /// Strength of the frost.
    pub frost: f64,
    /// Strength of the light.
    pub light: f64,
    /// The base colour in linear sRGB, and how much it covers the background, 0 to 1.
    pub tint: DVec4,
    /// How much of the effect is computed.
    pub quality: PaneQuality,
}

impl GlassPane {
    /// Returns a clear pane of this place and size: refraction, depth and dispersion in full, a light of 30, no frost.
    pub fn clear(corner: DVec2, size: DVec2, radius: f64) -> Self {
        Self {
            corner,
            size,
            radius,
            refraction: 100.0,
            depth: 100.0,
            dispersion: 100.0,
            frost: 0.0,
            light: 30.0,
            tint: DVec4::ZERO,
            quality: PaneQuality::High,
        }
    }

    /// Returns the pane with the strengths that its quality leaves. A strength out of its range counts as the nearer
    /// end, NaN as 0.
    pub fn effective(&self) -> Self {
        let strength = |v: f64| if v > 0.0 { v.min(100.0) } else { 0.0 };
        let high = Self {
            refraction: strength(self.refraction),
            depth: strength(self.depth),
            dispersion: strength(self.dispersion),
            frost: strength(self.frost),
            light: strength(self.light),
            ..*self
        };
        match self.quality {
            PaneQuality::High => high,
            PaneQuality::Medium => Self { dispersion: high.dispersion.min(30.0), ..high },
            PaneQuality::Low => {
                Self { depth: 0.0, dispersion: 0.0, frost: 0.0, light: 0.0, tint: DVec4::ZERO, ..high }
            }
        }
    }

    /// Whether the pane's place, size and corner radius are valid.
    fn is_somewhere(&self) -> bool {
        let range = -FARTHEST..=FARTHEST;
        let within = |v: DVec2| range.contains(&v.x) && range.contains(&v.y);
        within(self.corner)
            && within(self.size)
            && self.unit() > 0.0
            && (0.0..=self.unit() / 2.0).contains(&self.radius)
    }

    /// Returns the shorter side in pixels, the unit of all lengths of the effect.
    pub fn unit(&self) -> f64 {
        self.size.min_element()
    }

    /// Returns the pane's outline in the pane's own unit.
    fn outline(&self) -> PaneOutline {
        let unit = self.unit();
        PaneOutline { half: self.size / (2.0 * unit), radius: self.radius / unit }
    }

    /// Converts a place of the picture, in pixels, to the pane's own frame and unit.
    fn own(&self, at: DVec2) -> DVec2 {
        (at - self.corner - self.size / 2.0) / self.unit()
    }

    /// Returns how much of a pixel the pane covers, 0 to 1; `at` is the pixel's middle in pixels. At the outline it
    /// changes over the width of one pixel.
    fn cover(&self, at: DVec2) -> f64 {
        (0.5 - self.outline().distance(self.own(at)) * self.unit()).clamp(0.0, 1.0)
    }

    /// Returns how far from a place of the pane red, green and blue are looked up. Place and shifts are in pixels; frost
    /// is not included.
    fn shifts(&self, at: DVec2) -> [DVec2; 3] {
        let pane = self.effective();
        let dome = pane.outline().dome(pane.own(at));
        let all = refraction(&dome, pane.refraction) + depth(&dome, pane.depth);
        dispersion(&dome, pane.dispersion).map(|apart| (apart - all) * pane.unit())
    }

    /// Returns the colour that the pane shows at a place of the picture, in pixels.
    fn colour(&self, background: &Panorama, at: DVec2) -> DVec3 {
        let pane = self.effective();
        let own = pane.own(at);
        let dome = pane.outline().dome(own);
        let count = if self.quality == PaneQuality::High { 5 } else { 3 };
        let taps = taps(own, &dome, pane.frost, count);
        let places = pane.shifts(at).map(|shift| at + shift - 0.5);
        let seen = |&tap: &DVec2| {
            let look = |place: DVec2| background.between(place + tap * pane.unit());
            if pane.dispersion == 0.0 {
                return look(places[1]);
            }
            DVec3::new(look(places[0]).x, look(places[1]).y, look(places[2]).z)
        };
        let sum: DVec3 = taps.iter().map(seen).sum();
        pane.tinted(sum / taps.len() as f64) + light(dome.normal, pane.light)
    }

    /// Lays the base colour over a colour.
    fn tinted(&self, colour: DVec3) -> DVec3 {
        // Written as a sum, so that without a tint the colour stays the same to the bit.
        colour + (self.tint.truncate() - colour) * self.tint.w
    }
}

/// Draws the pane over a background, which is as large as the picture; all pixels are covered.
///
/// With `passes` of 1, a pixel shows what is seen at its middle, as on screens; with more, the mean over as many places
/// in it. A pane without extent, or with corners rounder than half of its shorter side, is not drawn.
pub fn pane(pane: &GlassPane, background: &Panorama, passes: u32) -> Linear {
    let shifts: Vec<DVec2> = places(passes);
    let mut picture = plain(background);
    if !pane.is_somewhere() {
        return picture;
    }
    let row_length = background.width.max(1) as usize;
    picture.pixels.par_chunks_mut(row_length).enumerate().for_each(|(y, row)| {
        for (x, pixel) in row.iter_mut().enumerate() {
            let corner = DVec2::new(x as f64, y as f64);
            let cover = pane.cover(corner + 0.5);
            if cover > 0.0 {
                let seen: DVec3 = shifts.iter().map(|&at| pane.colour(background, corner + at)).sum();
                laid(pixel, seen / shifts.len() as f64, cover);
            }
        }
    });
    picture
}

/// Returns where in a pixel the samples of this many passes stand, 0 to 1; the first stands in the middle.
fn places(passes: u32) -> Vec<DVec2> {
    (0..passes.max(1)).map(place_in_pixel).collect()
}

/// Returns the background alone.
fn plain(background: &Panorama) -> Linear {
    let pixels = background.pixels.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
    Linear { width: background.width, height: background.height, pixels }.whole()
}

/// Lays a colour over a pixel with this cover.
fn laid(pixel: &mut [f32; 4], colour: DVec3, cover: f64) {
    for (own, new) in pixel.iter_mut().zip(colour.to_array()) {
        *own = (f64::from(*own) + (new - f64::from(*own)) * cover) as f32;
    }
}

impl FromStr for PaneQuality {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Self, NameError> {
        match text.to_ascii_lowercase().as_str() {
            "high" => Ok(Self::High),
            "medium" => Ok(Self::Medium),
            "low" => Ok(Self::Low),
            _ => Err(NameError::Quality),
        }
    }
}

#[cfg(test)]
mod tests;
