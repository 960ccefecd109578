//! What is painted piece by piece is what is painted at once.

use super::Painter;
use egui::Context;

/// Runs and paints a frame of egui at 400 × 300 points, and returns the areas that have changed.
fn paint(painter: &mut Painter, context: &Context, draw: impl FnMut(&mut egui::Ui)) -> Vec<super::Area> {
    let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(400.0, 300.0));
    let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
    let mut output = context.run_ui(input, draw);
    let primitives = context.tessellate(output.shapes, output.pixels_per_point);
    painter.paint([400, 300], output.pixels_per_point, &primitives, &mut output.textures_delta)
}

#[test]
fn only_what_changes_is_painted_and_the_image_is_the_same_as_painted_at_once() {
    let context = Context::default();
    let mut painter = Painter::default();
    let image = egui::ColorImage::filled([40, 30], egui::Color32::RED);
    let mut texture = context.load_texture("picture", image.clone(), egui::TextureOptions::LINEAR);
    let place = egui::Rect::from_min_size(egui::pos2(300.0, 200.0), egui::vec2(80.0, 60.0));
    let show = |painter: &mut Painter, texture: &egui::TextureHandle, number: u32| {
        let id = texture.id();
        paint(painter, &context, |ui| {
            ui.heading("A line that stays");
            ui.label(format!("number {number}"));
            egui::Image::new((id, place.size())).paint_at(ui, place);
        })
    };
    let whole = |areas: &[super::Area]| areas.iter().map(|a| a.size()[0] * a.size()[1]).sum::<u32>();
    let all = show(&mut painter, &texture, 11);
    assert_eq!(whole(&all), 400 * 300);
    // Layout comes to rest in a few frames.
    (0..3).for_each(|_| drop(show(&mut painter, &texture, 11)));
    assert_eq!(show(&mut painter, &texture, 11), []);
    let one = show(&mut painter, &texture, 14);
    assert!(!one.is_empty() && one.iter().all(|a| a.bottom <= 96 && a.right <= 128), "{one:?}");
    texture.set(egui::ColorImage::filled([40, 30], egui::Color32::BLUE), egui::TextureOptions::LINEAR);
    let picture = show(&mut painter, &texture, 14);
    assert!(!picture.is_empty() && picture.iter().all(|a| a.top >= 192 && a.left >= 256), "{picture:?}");
    // New letters change the texture of letters, but only the pieces that show them read the changed part.
    let letters = show(&mut painter, &texture, 56);
    assert!(letters.iter().all(|a| a.bottom <= 96), "{letters:?}");
    let kept = painter.canvas.pixels.clone();
    painter.tiles = super::Tiles::default();
    assert_eq!(whole(&show(&mut painter, &texture, 56)), 400 * 300);
    assert!(kept == painter.canvas.pixels, "what was painted piece by piece is another image");
}
