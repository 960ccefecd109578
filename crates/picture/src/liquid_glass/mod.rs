//! Liquid glass: a pane that only looks as if it refracted light. Each pixel takes five pieces of arithmetic, and no
//! ray is traced.
//!
//! The effect is that of screens: flat, cheap, approximate by design. docs/optics.md, "Liquid glass", separates the
//! parts that its specification gives from the choices that were made here. [`compare()`] traces the same pane
//! physically.
//!
//! A pixel is drawn in these steps: `outline` finds its place on the dome over the pane; `parts` gives the shifts of
//! refraction, depth and dispersion there; `frost` spreads the look-up; `lighting` adds the light of the surface, which the
//! tint colours. `look_up` reads the background; `prepared` keeps the results that depend on the pane's shape alone,
//! so that a moving light or background costs little. `on_card` does the same on a graphics card, by
//! `shaders/liquid_glass.wgsl`.
//!
//! Lengths are parts of the pane's shorter side, measured from the pane's middle, x to the right and y down. A pixel
//! shows the background at a shifted place, so a shift toward the middle makes the background look larger.

mod compare;
mod frost;
mod lighting;
mod look_up;
#[cfg(feature = "gpu")]
mod on_card;
mod outline;
mod parts;
mod prepared;

pub use compare::{Comparison, Cost, PaneError, PaneLighting, Shifts, compare, surroundings, traced};
#[cfg(feature = "gpu")]
pub use on_card::PanesOnCard;
pub use prepared::{PreparedPane, SeenThrough};

use super::{Linear, NameError};
use brillianteer_scene::Panorama;
use brillianteer_trace::places::place_in_pixel;
use glam::{DVec2, DVec3, DVec4};
use outline::{DomePoint, PaneOutline};
use parts::{RED_AND_BLUE, depth, dispersion, refraction};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// The greatest coordinate and size of a pane, in pixels; sums of such numbers stay exact whole numbers.
const FARTHEST: f64 = 1e6;

/// The quality of the effect: the parts of it that are computed.
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
    /// The direction that the light comes from.
    #[serde(default)]
    pub light_from: LightFrom,
    /// The base colour in linear sRGB, and the part, 0 to 1, by which it colours the light.
    pub tint: DVec4,
    /// The quality: the parts of the effect that are computed.
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
            light_from: LightFrom::default(),
            tint: DVec4::ZERO,
            quality: PaneQuality::High,
        }
    }

    /// Returns the pane with the strengths that its quality leaves. A strength, a height or a part of the tint out of its
    /// range counts as the nearer end, NaN as 0.
    pub fn effective(&self) -> Self {
        let strength = |v: f64| if v > 0.0 { v.min(100.0) } else { 0.0 };
        let high = Self {
            refraction: strength(self.refraction),
            depth: strength(self.depth),
            dispersion: strength(self.dispersion),
            frost: strength(self.frost),
            light: strength(self.light),
            light_from: self.light_from.checked(),
            tint: DVec4::from(self.tint.to_array().map(|part| if part > 0.0 { part.min(1.0) } else { 0.0 })),
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

    /// Returns whether the pane's place, size and corner radius are valid.
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
        PaneOutline::new(self.size / (2.0 * unit), self.radius / unit)
    }

    /// Converts a place of the picture, in pixels, to the pane's own frame and unit.
    fn own(&self, at: DVec2) -> DVec2 {
        (at - self.corner - self.size / 2.0) / self.unit()
    }

    /// Returns the part of a pixel that the pane covers, 0 to 1; `at` is the pixel's middle in pixels. At the outline
    /// the part changes over the width of one pixel.
    fn cover(&self, at: DVec2) -> f64 {
        (0.5 - self.outline().distance(self.own(at)) * self.unit()).clamp(0.0, 1.0)
    }

    /// Returns the shifts from a place of the pane at which red, green and blue are looked up. Place and shifts are
    /// in pixels; frost is not included.
    fn shifts(&self, at: DVec2) -> [DVec2; 3] {
        let pane = self.effective();
        let (green, apart) = pane.shifts_on(&pane.outline().dome(pane.own(at)));
        let [red, blue] = RED_AND_BLUE.map(|part| green + apart * part);
        [red, green, blue]
    }

    /// Returns the shift from a point of its dome at which the pane, whose numbers are within their ranges, looks up
    /// green light, and the further shift by a unit of dispersion, both in pixels.
    fn shifts_on(&self, dome: &DomePoint) -> (DVec2, DVec2) {
        let all = refraction(dome, self.refraction) + depth(dome, self.depth);
        (-all * self.unit(), dispersion(dome, self.dispersion) * self.unit())
    }

    /// Returns the unit direction toward the light; x to the right, y down, z toward the eye.
    fn toward_light(&self) -> DVec3 {
        let LightFrom { azimuth, height } = self.light_from;
        let ((sin, cos), (up, level)) = (azimuth.to_radians().sin_cos(), height.to_radians().sin_cos());
        DVec3::new(level * cos, -level * sin, up)
    }

    /// Returns the colour of the light in linear sRGB: white, mixed with the base colour by the tint's part.
    fn light_colour(&self) -> DVec3 {
        DVec3::ONE.lerp(self.tint.truncate(), self.tint.w)
    }
}

/// The direction of a pane's light.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LightFrom {
    /// The azimuth in degrees, counter-clockwise from the right as the pane is seen; 90 is above.
    pub azimuth: f64,
    /// The height over the pane in degrees: 0 is along the pane, 90 from the eye.
    pub height: f64,
}

impl Default for LightFrom {
    /// Returns light from above; its height has a sine of 0.8.
    fn default() -> Self {
        Self { azimuth: 90.0, height: 53.130_102_354_155_98 }
    }
}

impl LightFrom {
    /// Returns the direction with its numbers within their ranges; a number that is not finite counts as 0.
    fn checked(self) -> Self {
        let finite = |v: f64| if v.is_finite() { v } else { 0.0 };
        Self { azimuth: finite(self.azimuth).rem_euclid(360.0), height: finite(self.height).clamp(0.0, 90.0) }
    }
}

/// Draws the pane over a background, which is as large as the picture; all pixels are covered.
///
/// With `passes` of 1, a pixel shows the background as seen at its middle, as on screens; with more, the mean over as
/// many places in it. A pane without extent, or with corners rounder than half of its shorter side, is not drawn.
pub fn pane(pane: &GlassPane, background: &Panorama, passes: u32) -> Linear {
    drawn(pane, background, passes, true)
}

/// Draws the pane alone, as a layer over the background that is seen through it: colours are premultiplied by cover, which
/// is 0 beside the pane. Laid over its background, it gives the same picture as [`pane`].
pub fn layer(pane: &GlassPane, background: &Panorama, passes: u32) -> Linear {
    drawn(pane, background, passes, false)
}

fn drawn(pane: &GlassPane, background: &Panorama, passes: u32, is_over: bool) -> Linear {
    let size = [background.width, background.height];
    let (prepared, below) = (PreparedPane::new(pane, size), is_over.then_some(background));
    if passes <= 1 {
        return prepared.lit(pane, &prepared.through(background), below);
    }
    let mut sums = vec![];
    for place in (0..passes).map(|number| place_in_pixel(number, passes)) {
        PreparedPane::at(pane, size, place).add_to(&mut sums, pane, background);
    }
    let share = 1.0 / passes as f32;
    sums.iter_mut().flatten().for_each(|sum| *sum *= share);
    prepared.composed(&sums, None, below)
}

/// Returns the background alone.
fn plain(background: &Panorama) -> Linear {
    let pixels = background.pixels.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
    Linear { width: background.width, height: background.height, pixels }.whole()
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
