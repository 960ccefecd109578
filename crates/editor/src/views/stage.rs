//! The stage: the views, side by side.

use super::pane;
use super::pane_context::PaneContext;
use super::tools::{Attention, ViewTools};
use crate::trouble_bar;
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
    ordering::Seen,
    workspace::PaneLayout,
};
use egui::{CentralPanel, Key, Rect, RichText, Ui, UiBuilder, pos2};
use std::path::Path;

/// The gap between views, points.
const GAP: f32 = 6.0;

/// Draws the views; returns each view in sight with the size of its picture in pixels.
pub fn show(model: &Model, tools: &mut ViewTools, actions: &mut Actions, ui: &mut Ui) -> Vec<Seen> {
    let mut seen = vec![];
    tools.attention = Attention::default();
    if !ui.input(|i| i.pointer.any_down() || i.pointer.any_released()) {
        // The view in which the user dragged a facet may be gone.
        tools.tiers.drag = None;
    }
    let is_for_views = model.session.dialog.is_none() && !ui.ctx().text_edit_focused();
    if model.meet_pick().is_some() && is_for_views && ui.input(|i| i.key_pressed(Key::Escape)) {
        actions.push(ViewAction::PickMeet(None));
    }
    let frame = egui::Frame::NONE.fill(ui.visuals().panel_fill);
    CentralPanel::no_frame().frame(frame).show(ui, |ui| {
        let whole = ui.max_rect().shrink(GAP);
        let shown = model.workspace.shown();
        let layout = if shown.len() == 1 { PaneLayout::One } else { model.workspace.layout };
        for (place, &pane) in shown.iter().enumerate() {
            let rect = part(whole, layout, place);
            let mut ui = ui.new_child(UiBuilder::new().max_rect(rect).id_salt(("pane", pane)));
            ui.set_clip_rect(rect.intersect(ui.clip_rect()));
            let mut cx = PaneContext::new(model, tools, actions, pane);
            seen.push((pane, pane::show(&mut cx, &mut ui, rect)));
        }
        trouble_bar::show(model, actions, ui.ctx(), whole);
    });
    tools.attention.report(model, actions);
    seen
}

/// Draws an empty stage, which says what file is being read.
pub fn show_reading(file: &Path, ui: &mut Ui) {
    let frame = egui::Frame::NONE.fill(ui.visuals().panel_fill);
    let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy();
    CentralPanel::no_frame().frame(frame).show(ui, |ui| {
        ui.centered_and_justified(|ui| ui.label(RichText::new(format!("reading {name}…")).weak()));
    });
}

fn part(whole: Rect, layout: PaneLayout, place: usize) -> Rect {
    let (across, down) = match layout {
        PaneLayout::One => (1, 1),
        // Two views stand side by side where the stage is wider than high: stones suit long and narrow views least.
        PaneLayout::Two if whole.width() > whole.height() => (2, 1),
        PaneLayout::Two => (1, 2),
        PaneLayout::Four => (2, 2),
    };
    let size = egui::vec2(
        (whole.width() - GAP * (across - 1) as f32) / across as f32,
        (whole.height() - GAP * (down - 1) as f32) / down as f32,
    );
    let (x, y) = (place % across, place / across);
    let corner = pos2(whole.min.x + x as f32 * (size.x + GAP), whole.min.y + y as f32 * (size.y + GAP));
    Rect::from_min_size(corner, size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_fill_the_stage_and_do_not_overlap() {
        let whole = Rect::from_min_size(pos2(10.0, 20.0), egui::vec2(900.0, 600.0));
        for layout in [PaneLayout::One, PaneLayout::Two, PaneLayout::Four] {
            let parts: Vec<Rect> = (0..layout.panes()).map(|k| part(whole, layout, k)).collect();
            assert_eq!(parts.iter().copied().reduce(Rect::union), Some(whole));
            for (k, a) in parts.iter().enumerate() {
                assert!(parts[..k].iter().all(|b| !a.shrink(1.0).intersects(*b)));
            }
        }
    }
}
