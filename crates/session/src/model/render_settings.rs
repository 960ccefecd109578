//! The settings that renders, scopes and backgrounds are made with beside the stones: a part of the work, which undo restores.

use crate::liquid::Liquid;
use brillianteer_files::scene_file::SceneFile;
use brillianteer_scene::{BackgroundRef, Look};
use serde::{Deserialize, Serialize};

/// The numbers of bands of wavelengths that menus offer. With only three, each band can be told apart in the picture.
pub const BANDS: [u32; 5] = [3, 8, 16, 32, 64];

/// The settings that pictures of a document are made with.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(from = "StoredSettings")]
pub struct RenderSettings {
    /// What renders are made with; its head is that of scopes and figures too.
    #[serde(flatten)]
    pub look: Look,
    /// The pane of liquid glass.
    pub liquid: Liquid,
}

/// The settings as they are kept between two starts.
#[derive(Default, Deserialize)]
#[serde(default)]
struct StoredSettings {
    #[serde(flatten)]
    look: Look,
    liquid: Liquid,
    /// The head that earlier versions kept, 0 for none.
    head: f64,
}

impl From<StoredSettings> for RenderSettings {
    fn from(StoredSettings { mut look, liquid, head }: StoredSettings) -> Self {
        look.head = look.head.or(Some(head).filter(|head| *head > 0.0));
        Self { look, liquid }
    }
}

impl RenderSettings {
    /// Returns the settings that a scene states, and the program's for all others.
    pub fn of_scene(scene: &SceneFile) -> Self {
        Self { look: absolute(&scene.look), liquid: Liquid::default() }
    }

    /// Returns the part of the turn by refraction that light follows, 0 to 1; without a background, all of it.
    pub fn strength(&self) -> f64 {
        if self.look.background_at_hand().is_some() { self.look.strength.clamp(0.0, 1.0) } else { 1.0 }
    }
}

/// Returns a look that names its files from any folder.
fn absolute(look: &Look) -> Look {
    let whole = |path: &std::path::Path| path.is_file().then(|| std::path::absolute(path).ok()).flatten();
    let light = whole(look.light.as_ref()).map(|path| path.to_string_lossy().into_owned());
    let background = look.background.as_ref().map(|background| match background {
        BackgroundRef::Photo(path) => BackgroundRef::Photo(whole(path).unwrap_or_else(|| path.clone())),
        other => other.clone(),
    });
    Look { light: light.unwrap_or_else(|| look.light.clone()), background, ..look.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_kept_as_text_and_older_ones_are_completed() {
        let look = Look { glow: 0.7, background: Some("page".into()), ..Look::default() };
        let settings = RenderSettings { look, ..RenderSettings::default() };
        let text = serde_json::to_string(&settings).unwrap();
        assert_eq!(serde_json::from_str::<RenderSettings>(&text).unwrap(), settings);
        assert_eq!(serde_json::from_str::<RenderSettings>("{}").unwrap(), RenderSettings::default());
        // As earlier versions wrote them.
        let old = r#"{"light": "dome", "exposure": 1.0, "head": 0.0, "background": "/a/b.png", "smoothing": "Fxaa"}"#;
        let RenderSettings { look, .. } = serde_json::from_str(old).unwrap();
        assert_eq!((look.light.as_str(), look.exposure, look.head), ("dome", 1.0, None));
        assert_eq!(look.background, Some(BackgroundRef::Photo("/a/b.png".into())));
        let set = serde_json::from_str::<RenderSettings>(r#"{"head": 12.0}"#).unwrap();
        assert_eq!(set.look.head, Some(12.0));
    }
}
