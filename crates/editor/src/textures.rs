//! Pictures of the studio as textures of the window.

use brillianteer_session::pixels::Pixels;
use egui::ColorImage;

/// Returns a picture as egui takes it, its cover multiplied into the colours.
pub fn image(pixels: &Pixels) -> ColorImage {
    ColorImage::from_rgba_unmultiplied(pixels.size, &pixels.rgba)
}
