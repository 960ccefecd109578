//! The buttons of dialogs, and the answers that they give.

use crate::app::model::action::{Actions, DialogAction};
use egui::{Key, Ui};

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
