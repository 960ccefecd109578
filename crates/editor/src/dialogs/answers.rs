//! The frame of dialogs: their contents, which scroll where the window is low, and below them the buttons, which are
//! always in sight, with the answers that they give.

use crate::scrolled::scrolled;
use brillianteer_session::model::action::{Actions, DialogAction};
use egui::{Key, Ui};

/// The space that dialogs leave free above and below, their own margins included, points.
const AROUND_DIALOG: f32 = 48.0;

/// The space that dialogs leave free to the left and the right, their own margins included, points.
const BESIDE_DIALOG: f32 = 60.0;

/// The height of the buttons below the contents of a dialog, with the space above them, points.
const BUTTONS: f32 = 42.0;

/// The height of the contents of a dialog in a window that has room for all of them, points.
const ANY: f32 = f32::INFINITY;

/// Draws the contents of a dialog of this width, points, above its buttons.
pub fn body<R>(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    body_of(ui, width, ANY, contents)
}

/// Draws the contents of a dialog above its buttons; they scroll where they are higher than `height` points or than
/// the window.
pub fn body_of<R>(ui: &mut Ui, width: f32, height: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let window = ui.ctx().content_rect().size();
    ui.set_width(width.min(window.x - BESIDE_DIALOG));
    let room = window.y - AROUND_DIALOG;
    ui.set_max_height(room);
    scrolled(ui, "dialog", height.min(room - BUTTONS), contents)
}

/// Draws buttons in a row and returns the number of the chosen one.
///
/// The first button is the default: Return presses it as well, where no widget has the focus.
pub fn buttons(ui: &mut Ui, names: &[&str]) -> Option<usize> {
    let is_answered = ui.memory(|m| m.focused().is_none()) && ui.input(|i| i.key_pressed(Key::Enter));
    buttons_alone(ui, names).or(is_answered.then_some(0))
}

/// Draws buttons in a row without a default for Return; returns the number of the chosen one.
pub fn buttons_alone(ui: &mut Ui, names: &[&str]) -> Option<usize> {
    ui.add_space(10.0);
    ui.horizontal(|ui| {
        let mut chosen = None;
        for (k, name) in names.iter().enumerate() {
            if ui.button(*name).clicked() {
                chosen = Some(k);
            }
        }
        chosen
    })
    .inner
}

/// Adds the answer of the button that was chosen, if any.
pub fn answer<const N: usize>(actions: &mut Actions, answers: [DialogAction; N], chosen: Option<usize>) {
    answers.into_iter().nth(chosen.unwrap_or(N)).into_iter().for_each(|answer| actions.push(answer));
}
