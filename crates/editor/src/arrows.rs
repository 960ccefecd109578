//! Reads the arrow keys and other keys for a picture that has the focus.

use egui::{EventFilter, Id, Key, Modifiers, Ui};
use glam::DVec2;

/// Keeps arrow keys for the widget that has the focus, so that they do not move the focus.
pub fn keep(ui: &Ui, id: Id) {
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|m| m.set_focus_lock_filter(id, arrows));
}

/// Returns how often a key was pressed with these modifiers, and consumes it.
pub fn pressed(ui: &Ui, modifiers: Modifiers, key: Key) -> f64 {
    ui.input_mut(|i| i.count_and_consume_key(modifiers, key)) as f64
}

/// Returns how often arrow keys were pressed with these modifiers, to the right and up, and consumes them.
pub fn way(ui: &Ui, modifiers: Modifiers) -> DVec2 {
    let along = |more, less| pressed(ui, modifiers, more) - pressed(ui, modifiers, less);
    DVec2::new(along(Key::ArrowRight, Key::ArrowLeft), along(Key::ArrowUp, Key::ArrowDown))
}
