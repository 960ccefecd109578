//! The settings that renders, scopes and backgrounds are made with beside the stones: a part of the work, which undo restores.

use crate::liquid::Liquid;
use crate::studio::Smoothing;
use brillianteer_files::scene_file::SceneFile;
use brillianteer_picture::Bloom;
use brillianteer_render::USUAL_BOUNCES;
use brillianteer_scene::BackgroundRef;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The light that a design begins with.
pub const FIRST_LIGHT: &str = "studio";

/// The numbers of bands of wavelengths that menus offer. With only three, each band can be told apart in the picture.
pub const WAVELENGTHS: [u32; 5] = [3, 8, 16, 32, 64];

/// The settings that pictures of a document are made with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RenderSettings {
    /// The light of renders: its name, or its file.
    pub light: String,
    /// The angle by which the light is turned about its axis, degrees.
    pub light_turn: f64,
    /// True where the light's axis points up in renders, false where it points to the eye.
    pub light_upright: bool,
    /// The exposure of renders, in stops.
    pub exposure: f64,
    /// The number of bands of wavelengths of renders.
    pub wavelengths: u32,
    /// The part of the light of sparkles that spreads around them in renders, 0 to 1.
    pub glow: f64,
    /// The greatest number of bounces inside a stone through which renders follow light.
    pub bounces: u32,
    /// The background of renders: `light`, the name of a world or a pattern, colours, or a photograph's file.
    pub background: Option<String>,
    /// The distance of the background behind the middle, mm; `None` for a distance that grows with the stone.
    pub background_mm: Option<f64>,
    /// The strength of refraction, 0 to 1: the part of the turn by refraction that light follows before it meets the
    /// background; 1 is physics.
    pub strength: f64,
    /// The method that smooths the edges of renders while anything moves.
    pub smoothing: Smoothing,
    /// The half angle of the observer's head in ASET and figures, degrees; 0 for none.
    pub head: f64,
    /// The pane of liquid glass.
    pub liquid: Liquid,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            light: FIRST_LIGHT.to_owned(),
            light_turn: 0.0,
            light_upright: false,
            exposure: 0.0,
            wavelengths: WAVELENGTHS[2],
            glow: Bloom::default().strength,
            bounces: USUAL_BOUNCES,
            background: None,
            background_mm: None,
            strength: 1.0,
            smoothing: Smoothing::None,
            head: 0.0,
            liquid: Liquid::default(),
        }
    }
}

/// A change of one of the settings, with the new value.
#[derive(Debug, Clone, PartialEq)]
pub enum SettingChange {
    /// The name or the file of the light.
    Light(String),
    /// The light's turn about the vertical, degrees.
    LightTurn(f64),
    /// True where the light stands upright.
    LightUpright(bool),
    /// The exposure, stops.
    Exposure(f64),
    /// The number of bands of wavelengths.
    Wavelengths(u32),
    /// The strength of the glow.
    Glow(f64),
    /// The number of bounces after which rays end.
    Bounces(u32),
    /// The background by its name; `None` for the light itself.
    Background(Option<String>),
    /// The distance of the background, mm; `None` for the usual one.
    BackgroundMm(Option<f64>),
    /// The strength of refraction and dispersion, 1 for physics.
    Strength(f64),
    /// How edges are smoothed.
    Smoothing(Smoothing),
    /// The half angle of the observer's head, degrees.
    Head(f64),
    /// The pane of liquid glass.
    Liquid(Box<Liquid>),
}

impl RenderSettings {
    /// Returns the settings that a scene states, and the program's for all others; `wavelengths` is the number of bands that
    /// goes with the scene, if any.
    pub fn of_scene(scene: &SceneFile, wavelengths: Option<u32>) -> Self {
        let own = Self::default();
        let light = scene.light.as_ref().map(|light| {
            let light = if light.is_file() { std::path::absolute(light).ok() } else { None }
                .unwrap_or_else(|| light.clone());
            light.to_string_lossy().into_owned()
        });
        Self {
            light: light.unwrap_or(own.light),
            light_turn: scene.light_turn,
            light_upright: scene.light_upright,
            exposure: scene.exposure,
            wavelengths: wavelengths.unwrap_or(own.wavelengths),
            background: scene.background.as_ref().map(ToString::to_string),
            background_mm: scene.background_distance_mm,
            strength: scene.strength,
            ..Self::default()
        }
    }

    /// Changes one of the settings.
    pub fn change(&mut self, change: SettingChange) {
        match change {
            SettingChange::Light(light) => self.light = light,
            SettingChange::LightTurn(degrees) => self.light_turn = degrees,
            SettingChange::LightUpright(is_upright) => self.light_upright = is_upright,
            SettingChange::Exposure(stops) => self.exposure = stops,
            SettingChange::Wavelengths(count) => self.wavelengths = count,
            SettingChange::Glow(glow) => self.glow = glow,
            SettingChange::Bounces(bounces) => self.bounces = bounces,
            SettingChange::Background(background) => self.background = background,
            SettingChange::BackgroundMm(mm) => self.background_mm = mm,
            SettingChange::Strength(strength) => self.strength = strength,
            SettingChange::Smoothing(smoothing) => self.smoothing = smoothing,
            SettingChange::Head(degrees) => self.head = degrees,
            SettingChange::Liquid(liquid) => self.liquid = *liquid,
        }
    }

    /// Sets all rows of light and background to those of other settings.
    pub fn reset_light(&mut self, first: &Self) {
        *self = Self { smoothing: self.smoothing, liquid: self.liquid, ..first.clone() };
    }

    /// Returns the background of renders; `None` for none, and where its file no longer exists.
    pub fn background(&self) -> Option<BackgroundRef> {
        BackgroundRef::read(self.background.as_deref()?, Path::new("")).ok()
    }

    /// Returns the name of a background that cannot be shown, because its file is gone or no background has that name.
    pub fn missing_background(&self) -> Option<&str> {
        self.background.as_deref().filter(|_| self.background().is_none())
    }

    /// Chooses the next world or pattern as the background of renders, in the order of their names; after the last
    /// one, none.
    pub fn next_background(&mut self) {
        let place = |now: &str| BackgroundRef::names().position(|name| name == now);
        let next = self.background.as_deref().and_then(place).map_or(0, |now| now + 1);
        self.background = BackgroundRef::names().nth(next).map(str::to_owned);
    }

    /// Returns the part of the turn by refraction that light follows, 0 to 1; without a background, all of it.
    pub fn strength(&self) -> f64 {
        if self.background().is_some() { self.strength.clamp(0.0, 1.0) } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_kept_as_text_and_older_ones_are_completed() {
        let settings =
            RenderSettings { glow: 0.7, background: Some("page".into()), ..RenderSettings::default() };
        let text = serde_json::to_string(&settings).unwrap();
        assert_eq!(serde_json::from_str::<RenderSettings>(&text).unwrap(), settings);
        assert_eq!(serde_json::from_str::<RenderSettings>("{}").unwrap(), RenderSettings::default());
    }

    #[test]
    fn backgrounds_come_one_after_the_other_and_around() {
        let mut settings =
            RenderSettings { background: Some("/a/photo.png".to_owned()), ..RenderSettings::default() };
        let mut seen = vec![];
        for _ in 0..BackgroundRef::names().count() + 1 {
            settings.next_background();
            seen.push(settings.background.clone());
        }
        assert_eq!(seen.iter().flatten().count(), BackgroundRef::names().count());
        assert_eq!((seen[0].as_deref(), seen.last()), (Some("sunset"), Some(&None)));
    }
}
