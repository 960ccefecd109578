//! The invitation that covers the window while files are dragged over it.

use egui::{Align2, Color32, Context, FontId, Id, LayerId, Order};

/// Draws a text that says what dropping the files does, while they are held over the window.
pub fn invite(ctx: &Context) {
    if ctx.input(|i| i.raw.hovered_files.is_empty()) {
        return;
    }
    let painter = ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique("drop")));
    let whole = ctx.content_rect();
    painter.rect_filled(whole, 0.0, Color32::from_black_alpha(170));
    let text = "Drop a cut, a mesh or a scene to open it,\na panorama or a light file to light the stone,\na \
        picture to make it the background.";
    painter.text(whole.center(), Align2::CENTER_CENTER, text, FontId::proportional(20.0), Color32::WHITE);
}
