//! Double clicks, which set a row to its default.

use egui::{Context, Id, PointerButton, Response, Ui};

/// Where the time of the last click on a slider is kept.
fn clicked_id() -> Id {
    Id::unique("slider of a row was clicked")
}

/// Returns whether the name of a row or its slider was clicked twice.
pub fn is_wanted(ui: &Ui, name: &Response, slider: Option<&Response>) -> bool {
    let is_double = |slider: &Response| {
        slider.contains_pointer()
            && ui.input(|input| input.pointer.button_double_clicked(PointerButton::Primary))
    };
    if slider.is_some_and(Response::drag_stopped) {
        // The time is read first: egui locks its data while it is written.
        let now = ui.input(|input| input.time);
        ui.data_mut(|data| data.insert_temp(clicked_id(), now));
    }
    name.double_clicked() || slider.is_some_and(is_double)
}

/// Returns whether a slider was let go so short a time ago that the click may be the first of a double click: it sets the slider,
/// and the second click sets the default, as one change.
pub fn may_follow(ctx: &Context) -> bool {
    let Some(clicked) = ctx.data(|data| data.get_temp::<f64>(clicked_id())) else { return false };
    let delay = ctx.options(|options| options.input_options.max_double_click_delay);
    let left = clicked + delay - ctx.input(|input| input.time);
    if left > 0.0 {
        ctx.request_repaint_after_secs(left as f32);
    }
    left > 0.0
}
