//! The drawing of the stone from the side, with its dimensions and with handles that shape the stone.
//!
//! A cut whose family has handles is shaped by them. Each changes one proportion, by pointer or arrow keys, in steps of a
//! tenth (with Shift a hundredth) of a percent or degree. Of a pair, such as crown angle and height, the one that was held
//! stays held. While a handle is dragged the drawing keeps its size, so that the handle stays under the pointer; when the
//! handle is released, the drawing is fitted anew.

mod body;
mod frame;
mod grab;
mod grips;
mod handle;
mod ink;
mod plan;
mod sheet;
mod sight;
#[cfg(test)]
mod tests;

use brillianteer_cut::{Cut, ProfileHandle};
use brillianteer_picture::DrawnMarks;
use brillianteer_scene::Stone;
use egui::accesskit::Role;
use egui::{CursorIcon, Key, PointerButton, Rect, RectAlign, Sense, Tooltip, Ui, WidgetInfo};
use frame::{MeasuredProfile, Offered, ProfileFrame};
use grab::Grab;
use grips::Grip;
use handle::Handle;
use sheet::Label;
use sight::ProfileBox;

/// The drawing moves to a new fit this many times faster than other animations run.
const QUICKER: f32 = 2.5;

/// The drawing's state from one frame to the next.
#[derive(Debug, Default)]
pub struct ProfileView {
    grab: Option<Grab>,
    shown: Option<ProfileBox>,
}

impl ProfileView {
    /// Draws `stone` within `rect`, with its `marks`; where its family has handles, they change the proportions of
    /// `cut`.
    ///
    /// A [`Ui`] can hold one such drawing, whose state goes by the identity of that `Ui`. Of a cut without proportions, or
    /// with impossible ones, the drawing shows what can be measured and has no handles.
    pub fn show(&mut self, ui: &mut Ui, rect: Rect, (stone, marks): (&Stone, &DrawnMarks), cut: &mut Cut) {
        let id = ui.make_persistent_id("profile");
        let response = ui.interact(rect, id, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, ui.is_enabled(), "Profile of the stone"));
        let measured = MeasuredProfile::new(stone, cut);
        let extent = self.extent(ui, &measured);
        let frame = ProfileFrame::new(ui, id, rect, &measured, extent);
        let offered = frame.offer(ui);
        let labels = frame.paint(ui, &offered, self.active(&offered), marks);
        if measured.cut.is_none() {
            self.grab = None;
            return;
        }
        let new = self.edited(ui, &frame, &offered, cut.clone());
        frame.show_values(ui, &offered, &new);
        self.guide(ui, &measured, &offered, &labels);
        if new != *cut {
            *cut = new;
            ui.ctx().request_repaint();
        }
    }

    /// Returns whether a handle is dragged: all changes until its release are one gesture.
    pub fn is_dragging(&self) -> bool {
        self.grab.is_some()
    }

    /// Returns the part of the profile to show: an unchanged part while a handle is dragged, else one that moves
    /// toward the new fit.
    fn extent(&mut self, ui: &Ui, measured: &MeasuredProfile<'_>) -> ProfileBox {
        let fitting = ProfileBox::of(&measured.dimensions);
        let shown = match (&self.grab, &measured.cut) {
            (Some(grab), Some(cut)) => grab.shown(cut),
            _ => {
                let time = (ui.style().animation_time / QUICKER).max(f32::MIN_POSITIVE);
                let part = 1.0 - (-ui.input(|i| i.stable_dt) / time).exp();
                self.shown.unwrap_or(fitting).toward(fitting, f64::from(part))
            }
        };
        if shown != fitting && self.grab.is_none() {
            ui.ctx().request_repaint();
        }
        *self.shown.insert(shown)
    }

    /// Returns the handle that is dragged, else the one under the pointer, else the one with the keyboard focus.
    fn active(&self, offered: &[Offered]) -> Option<Handle> {
        let find = |is: fn(&Offered) -> bool| offered.iter().find(|o| is(o)).map(|o| o.grip.handle);
        let held = self.grab.as_ref().map(|grab| grab.handle);
        held.or_else(|| find(Offered::is_pointed_at)).or_else(|| find(|o| o.response.has_focus()))
    }

    /// Returns the cut after the changes by pointer and keys.
    fn edited(&mut self, ui: &Ui, frame: &ProfileFrame<'_>, offered: &[Offered], given: Cut) -> Cut {
        let first = offered.iter().filter(|o| !o.grip.mirrored);
        let keyed = first.fold(given, |given, o| o.grip.keyed(ui, &o.response, given));
        for o in offered.iter().filter(|o| o.response.drag_started_by(PointerButton::Primary)) {
            self.take(ui, frame, o, &keyed);
        }
        self.pulled(ui, frame, offered).unwrap_or(keyed)
    }

    fn take(&mut self, ui: &Ui, frame: &ProfileFrame<'_>, offered: &Offered, given: &Cut) {
        let Offered { grip, response } = offered;
        let pressed = ui.input(|i| i.pointer.press_origin()).or(response.interact_pointer_pos());
        let dimensions = frame.measured.dimensions;
        self.grab = self
            .shown
            .map(|shown| Grab::new(grip, given.clone(), dimensions, shown, pressed.unwrap_or(grip.at)));
        // The focus lets arrow keys go on where the pointer ended.
        let first = Grip { mirrored: false, ..*grip };
        ui.memory_mut(|m| m.request_focus(first.id(frame.id)));
    }

    /// Returns the cut that the dragged handle makes; Escape gives that before the drag.
    fn pulled(&mut self, ui: &Ui, frame: &ProfileFrame<'_>, offered: &[Offered]) -> Option<Cut> {
        let mut grab = self.grab.take()?;
        if ui.input(|i| i.key_pressed(Key::Escape)) {
            return Some(grab.start);
        }
        let held = offered.iter().any(|o| o.response.dragged());
        // A handle that was released while the drawing was not shown changes nothing any more.
        if !held && !offered.iter().any(|o| o.response.drag_stopped()) {
            return None;
        }
        let (pointer, fine) = ui.input(|i| (i.pointer.interact_pos(), i.modifiers.shift));
        if let Some(to) = pointer {
            grab.follow(to, fine);
        }
        let new = grab.pulled(&frame.sight);
        self.grab = held.then_some(grab);
        Some(new)
    }

    /// Sets the look of the pointer, and shows a hint beside the handle under it.
    ///
    /// For a handle that is dragged or has the keyboard focus the drawing itself shows enough; a hint appears only where
    /// the drawing has no room.
    fn guide(&self, ui: &Ui, measured: &MeasuredProfile<'_>, offered: &[Offered], labels: &[Label]) {
        let Some(cut) = &measured.cut else { return };
        for o in offered {
            let held = self.grab.as_ref().filter(|_| o.response.dragged());
            if o.is_pointed_at() {
                ui.ctx().set_cursor_icon(cursor(o.grip.handle, held));
            }
            let handle = held.map_or(o.grip.handle, |grab| grab.handle);
            let row = handle.row;
            let value = format!("{} {}", row.name, row.written((row.get)(cut)));
            let is_shown = labels.iter().any(|label| label.about == Some(row));
            if held.is_some() || (o.response.has_focus() && !o.is_pointed_at()) {
                if !is_shown {
                    hint(Tooltip::for_widget(&o.response), handle, &value, None);
                }
            } else if o.is_pointed_at() {
                hint(Tooltip::for_enabled(&o.response), handle, &value, Some(handle.hint()));
            }
        }
    }
}

fn cursor(handle: Handle, held: Option<&Grab>) -> CursorIcon {
    match held {
        Some(grab) if !grab.is_undecided => grab.handle.cursor(),
        _ if handle.part == ProfileHandle::PavilionTip => CursorIcon::Move,
        _ => handle.cursor(),
    }
}

fn hint(mut tooltip: Tooltip<'_>, handle: Handle, value: &str, how: Option<&str>) {
    // The hint lies over the stone, where no numbers are.
    tooltip.popup =
        tooltip.popup.align(if handle.is_on_crown() { RectAlign::BOTTOM } else { RectAlign::TOP });
    tooltip.gap(8.0).show(|ui| {
        ui.label(value);
        if let Some(how) = how {
            ui.weak(format!("{how} · Shift: finer"));
        }
    });
}
