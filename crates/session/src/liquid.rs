//! The pane of liquid glass over the background of a view: its stored settings and its place in a picture.

use brillianteer_base::{NumberRow, Unit};
use brillianteer_optics::linear_from_encoded;
use brillianteer_picture::liquid_glass::{GlassPane, LightFrom, PaneQuality};
use glam::{DVec2, DVec4};
use serde::{Deserialize, Serialize};

/// The least side of the pane, pixels.
const LEAST: f64 = 8.0;

/// The speed at which time turns the light of a pane, degrees per second.
const TURN: f64 = 60.0;

/// The driver of a pane's light: nothing, the pointer or time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LightMotion {
    /// The light stays where it is set.
    #[default]
    Fixed,
    /// The light follows the pointer over the view.
    Pointer,
    /// The light goes round as time runs.
    Time,
}

/// The stored settings of the pane of liquid glass.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Liquid {
    /// The middle of the pane as parts of the view's width and height, from the upper left corner.
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
    /// The driver of the light.
    pub light_motion: LightMotion,
    /// The direction that the light comes from.
    pub light_from: LightFrom,
    /// The base colour of the pane in sRGB, and how far it colours the light.
    pub tint: [u8; 4],
    /// The part of the effect that is drawn.
    pub quality: PaneQuality,
    /// The height of the traced pane above the background, in parts of the pane's shorter side.
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
            light_motion: LightMotion::Fixed,
            light_from: LightFrom::default(),
            tint: [0; 4],
            quality: PaneQuality::High,
            gap: 0.02,
        }
    }
}

/// Makes a row of a number of the pane whose slider goes by whole steps.
macro_rules! number {
    ($key:literal, $name:literal, $unit:ident, $least:literal to $most:literal, $($field:ident).+, $meaning:literal) => {
        NumberRow {
            step: 1.0,
            decimals: 0,
            ..NumberRow::new(
                $key,
                $name,
                Unit::$unit,
                [$least, $most],
                $meaning,
                |liquid| Some(liquid.$($field).+),
                |liquid, value| liquid.$($field).+ = value,
            )
        }
    };
}

/// The numbers of the pane's shape and of its effects.
pub const PANE_NUMBERS: [NumberRow<Liquid>; 8] = [
    number!("width", "Pane width", Percent, 10.0 to 100.0, size.x, "The width of the pane, in percent of the view."),
    number!("height", "Pane height", Percent, 10.0 to 100.0, size.y, "The height of the pane, in percent of the view."),
    number!("corners", "Corners", Percent, 0.0 to 50.0, corners, "The radius of its corners, in percent of its shorter side."),
    number!("refraction", "Refraction", Ratio, 0.0 to 100.0, refraction, "Bends the background at the rim. In the traced pane it is the index, 1 to 1.5."),
    number!("depth", "Pane depth", Ratio, 0.0 to 100.0, depth, "The depth that the pane seems to have. In the traced pane it is the thickness."),
    number!("dispersion", "Dispersion", Ratio, 0.0 to 100.0, dispersion, "Separates red from blue. In the traced pane it sets the Abbe number, 55 at 100."),
    number!("frost", "Frost", Ratio, 0.0 to 100.0, frost, "Blurs the background toward the rim, unevenly. The traced pane is always clear."),
    number!("light", "Pane light", Ratio, 0.0 to 100.0, light, "The strength of shine, shade and rim. Around the traced pane it is the brightness of a lamp and a sky."),
];

/// The numbers of the direction that a light which stays comes from.
pub const PANE_LIGHT_NUMBERS: [NumberRow<Liquid>; 2] = [
    number!(
        "azimuth", "Light azimuth", Degrees, 0.0 to 360.0, light_from.azimuth,
        "The direction of the light, in degrees counter-clockwise from the right; 90 is above."
    ),
    number!(
        "elevation", "Light height", Degrees, 0.0 to 90.0, light_from.height,
        "The height of the light over the pane, in degrees: 0 along it, 90 from the eye."
    ),
];

/// The height of the traced pane above the background.
pub const PANE_GAP: NumberRow<Liquid> = NumberRow {
    step: 0.001,
    decimals: 3,
    ..number!(
        "gap", "Gap", Ratio, 0.001 to 1.0, gap,
        "The distance from the traced pane to the background, in parts of the pane's shorter side."
    )
};

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
            light_from: self.light_from,
            tint: DVec4::new(red, green, blue, alpha),
            quality: self.quality,
            ..GlassPane::clear(corner, size, radius)
        }
    }

    /// Turns the light toward a point of a view of this size, in parts of the view, as if a lamp hung there above the
    /// view, at half of the pane's shorter side.
    pub fn light_at(&mut self, place: DVec2, view: DVec2) {
        let away = (place - self.at) * view;
        let height = (self.size / 200.0 * view).min_element().max(1.0);
        let azimuth =
            if away == DVec2::ZERO { self.light_from.azimuth } else { -away.to_angle().to_degrees() };
        let height = height.atan2(away.length()).to_degrees();
        self.light_from = LightFrom { azimuth: azimuth.rem_euclid(360.0), height };
    }

    /// Turns the light on by so many seconds.
    pub fn turn_light(&mut self, seconds: f64) {
        self.light_from.azimuth = (self.light_from.azimuth + TURN * seconds).rem_euclid(360.0);
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
    fn the_light_comes_from_the_pointer_and_goes_round() {
        let mut liquid = Liquid::default();
        for (place, azimuth) in
            [((0.9, 0.5), 0.0), ((0.5, 0.1), 90.0), ((0.1, 0.5), 180.0), ((0.5, 0.9), 270.0)]
        {
            liquid.light_at(DVec2::from(place), DVec2::new(400.0, 400.0));
            assert!((liquid.light_from.azimuth - azimuth).abs() < 1e-9, "{place:?}: {:?}", liquid.light_from);
            // The lamp is 160 pixels away, and 100 pixels over the pane.
            assert!((liquid.light_from.height.to_radians().tan() - 100.0 / 160.0).abs() < 1e-9);
        }
        liquid.light_at(liquid.at, DVec2::new(400.0, 300.0));
        assert_eq!(liquid.light_from, LightFrom { azimuth: 270.0, height: 90.0 });
        liquid.turn_light(2.5);
        assert!((liquid.light_from.azimuth - 60.0).abs() < 1e-9, "{:?}", liquid.light_from);
    }

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
