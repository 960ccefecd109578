//! Signs and letters that the fonts of the window lack.

use brillianteer_paper::SystemFont;
use egui::FontData;
use egui::epaint::text::{FallbackRequest, FontInsert, FontPriority, FontProvider, InsertFontFamily};
use egui::{
    Color32, ColorImage, GlyphBitmap, GlyphRasterizer, GlyphRasterizerRequest, RasterizedGlyph, vec2,
};
use std::sync::Arc;

/// The sign on egui's button that copies the numbers of a colour.
const CLIPBOARD: &str = "\u{1f4cb}";

/// The width and the height of the clipboard, as parts of the font's size.
const SIZE: [f32; 2] = [0.72, 0.94];

/// The number of points along each side of a pixel that are tried for its cover.
const POINTS: usize = 4;

/// Returns what draws the signs.
pub fn signs() -> GlyphRasterizer {
    GlyphRasterizer::new("brillianteer signs", |request: &GlyphRasterizerRequest| {
        (request.cluster == CLIPBOARD).then(|| clipboard(request.font_size_px))
    })
}

/// Returns what finds fonts of the system for letters that the window's own fonts lack, as in the name of a design.
pub fn fonts_of_system() -> Arc<dyn FontProvider> {
    Arc::new(|request: &FallbackRequest<'_>| {
        let letter = request.cluster.chars().next().filter(|_| request.cluster != CLIPBOARD)?;
        let SystemFont { name, data, index } = SystemFont::with(letter)?;
        let data = FontData { index, ..FontData::from_owned(data) };
        let family = InsertFontFamily { family: request.family.clone(), priority: FontPriority::Lowest };
        Some(FontInsert::new(&name, data, vec![family]))
    })
}

/// Draws a clipboard for a font of a size in pixels.
fn clipboard(font: f32) -> RasterizedGlyph {
    let size = SIZE.map(|part| (part * font).ceil().max(1.0));
    let [width, height] = size.map(|side| side as usize);
    let cover = |x: usize, y: usize| {
        let at = |pixel: usize, point: usize| (pixel as f32 + (point as f32 + 0.5) / POINTS as f32) / font;
        let points = (0..POINTS * POINTS).map(|k| [at(x, k % POINTS), at(y, k / POINTS)]);
        let inked = points.filter(|&[x, y]| is_inked(x, y)).count();
        Color32::from_white_alpha((255 * inked / (POINTS * POINTS)) as u8)
    };
    let pixels = (0..width * height).map(|k| cover(k % width, k / width)).collect();
    let image = ColorImage::new([width, height], pixels);
    // The sign reaches a little below the line on which letters stand.
    let offset_px = vec2(0.0, (0.1 * font).round() - size[1]);
    let bitmap = GlyphBitmap { image, offset_px, is_color: false };
    RasterizedGlyph { bitmap, advance_px: size[0] + (0.08 * font).round() }
}

/// Returns whether a point of the clipboard is drawn, in parts of the font's size from the upper left corner: the board's
/// border, the clip, or a line of text.
fn is_inked(x: f32, y: f32) -> bool {
    let within = |left: f32, top: f32, right: f32, bottom: f32| {
        (left..right).contains(&x) && (top..bottom).contains(&y)
    };
    let border = within(0.02, 0.1, 0.7, 0.92) && !within(0.1, 0.18, 0.62, 0.84);
    let clip = within(0.2, 0.02, 0.52, 0.24);
    let line = |top: f32| within(0.2, top, 0.52, top + 0.07);
    border || clip || [0.34, 0.5, 0.66].into_iter().any(line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clipboard_is_drawn_at_any_size_and_nothing_else_is() {
        for font in [0.5, 9.0, 14.0, 51.0] {
            let RasterizedGlyph { bitmap, advance_px } = clipboard(font);
            let [width, height] = bitmap.image.size;
            assert_eq!(bitmap.image.pixels.len(), width * height);
            assert!(advance_px >= width as f32);
            let inked = bitmap.image.pixels.iter().map(|pixel| f32::from(pixel.a()) / 255.0).sum::<f32>();
            let share = inked / (width * height) as f32;
            assert!(font < 1.0 || (0.2..0.7).contains(&share), "{font}: {share}");
        }
        let asked = |cluster| {
            let family = &egui::FontFamily::Proportional;
            let request =
                GlyphRasterizerRequest { cluster, family, font_size_px: 14.0, subpixel_offset_px: 0.0 };
            (signs().rasterize)(&request).is_some()
        };
        assert!(asked(CLIPBOARD) && !asked("a") && !asked("\u{1f4cc}"));
    }
}
