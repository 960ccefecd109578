//! The time that passes between frames of the window.

use egui::Context;

/// The longest step of time from one frame to the next, seconds: after a pause, motion goes on where it was.
const LONGEST: f32 = 0.1;

/// Returns the time since the last frame of the window, seconds, up to [`LONGEST`], and requests another frame; 0
/// while the window is hidden.
pub fn step(ctx: &Context) -> f64 {
    let is_hidden =
        ctx.input(|i| i.viewport().minimized == Some(true) || i.viewport().occluded == Some(true));
    if is_hidden {
        return 0.0;
    }
    ctx.request_repaint();
    f64::from(ctx.input(|i| i.stable_dt).min(LONGEST))
}
