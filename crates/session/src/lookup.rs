//! The backplate of pictures of backgrounds behind glass, and the conversion of their light for the screen.

use crate::pixels::Pixels;
use brillianteer_picture::{Develop, Linear, Tone, develop};
use brillianteer_scene::BackgroundRef;
use brillianteer_scene::Pattern;

/// The backplate where a picture needs one and none is chosen.
const FIRST: Pattern = Pattern::Page;

/// Returns the backplate of a picture that needs one: the chosen one where it is a picture, else a pattern.
pub fn backdrop(chosen: Option<&BackgroundRef>) -> BackgroundRef {
    chosen.filter(|chosen| chosen.is_picture()).cloned().unwrap_or(BackgroundRef::Pattern(FIRST))
}

/// Returns a picture for the screen whose light is encoded as it is, without exposure, bloom or tone mapping.
pub fn as_screens(picture: &Linear) -> Pixels {
    let manner = Develop { bloom: None, tone: Tone::Linear, ..Develop::default() };
    let size = [picture.width as usize, picture.height as usize];
    Pixels { size, rgba: develop(picture, &manner) }
}
