//! Parts of the window that scroll where they are higher than their room: dialogs, menus and windows over the views.

use egui::scroll_area::ScrollBarVisibility;
use egui::style::ScrollStyle;
use egui::{Id, Rect, ScrollArea, Ui};

/// Draws contents that scroll where they are higher than `height` points. Their scroll bar is always in sight then, so
/// that it shows that there is more, and the widget that gets the keyboard's focus comes into sight.
pub fn scrolled<R>(ui: &mut Ui, name: &str, height: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let style = ui.style().spacing.scroll;
    // A floating bar is seen only under the pointer.
    ui.spacing_mut().scroll = ScrollStyle { foreground_color: true, ..ScrollStyle::solid() };
    let area = ScrollArea::vertical().id_salt(name).max_height(height).min_scrolled_height(height.min(64.0));
    let shown = area.scroll_bar_visibility(ScrollBarVisibility::VisibleWhenNeeded).show(ui, |ui| {
        let inner = contents(ui);
        follow_focus(ui);
        inner
    });
    ui.spacing_mut().scroll = style;
    shown.inner
}

/// Brings the widget that has got the keyboard's focus since the last frame into sight; called at the end of what scrolls.
pub fn follow_focus(ui: &Ui) {
    let (id, focused) = (ui.scope_id().with("focus before"), ui.memory(|memory| memory.focused()));
    let before: Option<Id> = ui.data(|data| data.get_temp(id)).flatten();
    if focused == before {
        return;
    }
    ui.data_mut(|data| data.insert_temp(id, focused));
    let response = focused.and_then(|focused| ui.ctx().read_response(focused));
    let own = response.filter(|response| response.layer_id == ui.layer_id()).map(|response| response.rect);
    if let Some(rect) = own.filter(|rect| is_within(ui.min_rect(), *rect)) {
        ui.scroll_to_rect(rect, None);
    }
}

/// Returns whether a widget belongs to contents that take in this rectangle.
fn is_within(contents: Rect, widget: Rect) -> bool {
    contents.expand(1.0).contains_rect(widget)
}
