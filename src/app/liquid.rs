//! A pane of liquid glass over the background of a view: it is moved by hand, and drawn as screens draw it or traced.

use super::editor::{Editor, Shown};
use super::lookup::{LookupRequest, backdrop};
use super::pane::{enlarge, focus};
use super::shows::Shows;
use super::studio::{Grade, Which};
use super::view_menu;
use crate::optics::linear_from_encoded;
use crate::picture::liquid_glass::{GlassPane, Quality};
use egui::{
    Color32, EventFilter, Key, Modifiers, PointerButton, Rect, Response, Role, Sense, StrokeKind, Ui,
    WidgetInfo, pos2,
};
use glam::{DVec2, DVec4};
use serde::{Deserialize, Serialize};

/// The least side of the pane, pixels.
const LEAST: f64 = 8.0;

/// How far an arrow key moves the pane, in parts of the view.
const STEP: f64 = 0.01;

/// The settings of the pane of liquid glass, as they are kept.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Liquid {
    /// The middle of the pane, in parts of the view from the upper left corner.
    pub at: DVec2,
    /// The width and height of the pane, percent of the view's.
    pub size: DVec2,
    /// The radius of the corners, percent of the pane's shorter side.
    pub corners: f64,
    /// The strength of the refraction, 0 to 100.
    pub refraction: f64,
    /// The strength of the depth, 0 to 100.
    pub depth: f64,
    /// The strength of the dispersion, 0 to 100.
    pub dispersion: f64,
    /// The strength of the frost, 0 to 100.
    pub frost: f64,
    /// The strength of the light, 0 to 100.
    pub light: f64,
    /// The base colour of the pane in sRGB, and how much of it covers what is behind.
    pub tint: [u8; 4],
    /// How much of the effect is drawn.
    pub quality: Quality,
    /// How far above the background the traced pane lies, in parts of the pane's shorter side.
    pub gap: f64,
}

impl Default for Liquid {
    fn default() -> Self {
        Self {
            at: DVec2::splat(0.5),
            size: DVec2::new(62.0, 50.0),
            corners: 30.0,
            refraction: 100.0,
            depth: 100.0,
            dispersion: 100.0,
            frost: 0.0,
            light: 30.0,
            tint: [0; 4],
            quality: Quality::High,
            gap: 0.02,
        }
    }
}

impl Liquid {
    /// Returns the pane in a picture of a size in pixels; the pane lies wholly within the picture.
    pub fn pane(&self, picture: [u32; 2]) -> GlassPane {
        let whole = DVec2::from(picture.map(f64::from));
        let size = (whole * self.size / 100.0).round().clamp(DVec2::splat(LEAST).min(whole), whole);
        let corner = (whole * self.at - size / 2.0).round().clamp(DVec2::ZERO, whole - size);
        let radius = size.min_element() * (self.corners / 100.0).clamp(0.0, 0.5);
        let [red, green, blue, alpha] = self.tint.map(|code| f64::from(code) / 255.0);
        let [red, green, blue] = [red, green, blue].map(linear_from_encoded);
        GlassPane {
            refraction: self.refraction,
            depth: self.depth,
            dispersion: self.dispersion,
            frost: self.frost,
            light: self.light,
            tint: DVec4::new(red, green, blue, alpha),
            quality: self.quality,
            ..GlassPane::clear(corner, size, radius)
        }
    }

    /// Moves the pane by parts of the view, but not out of it.
    fn drag(&mut self, by: DVec2) {
        let half = (self.size / 200.0).clamp(DVec2::ZERO, DVec2::splat(0.5));
        self.at = (self.at + by).clamp(half, 1.0 - half);
    }
}

/// Draws the view, and moves the pane by drags and arrow keys.
pub fn show(editor: &mut Editor, ui: &mut Ui, (pane, shows): (usize, Shows), body: Rect, size: [u32; 2]) {
    let response = ui.interact(body, ui.scope_id().with("picture"), Sense::click_and_drag());
    let name = format!("{} picture", shows.name());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
    if response.dragged_by(PointerButton::Primary) {
        let by = response.drag_delta() / body.size();
        editor.desk.liquid.drag(DVec2::new(by.x.into(), by.y.into()));
    }
    if response.has_focus() {
        by_keys(&mut editor.desk.liquid, ui, &response);
    }
    if shows == Shows::LiquidGlass {
        ask(editor, pane, size);
    }
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    if let Some(Shown { texture, .. }) =
        editor.shown((pane, Which::Present)).filter(|shown| shown.shot.shows == shows)
    {
        let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture.id(), body, uv, Color32::WHITE);
    }
    ui.painter().rect_stroke(body, 4.0, focus(ui, &response), StrokeKind::Inside);
    view_menu::attach(editor, &response, pane);
    if response.double_clicked() {
        enlarge(editor, pane);
    }
    if response.hovered() || response.has_focus() {
        editor.hovered = pane;
    }
}

fn by_keys(liquid: &mut Liquid, ui: &Ui, response: &Response) {
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|m| m.set_focus_lock_filter(response.id, arrows));
    let pressed = |key| ui.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key)) as f64;
    let along = |more, less| pressed(more) - pressed(less);
    let by = DVec2::new(along(Key::ArrowRight, Key::ArrowLeft), along(Key::ArrowDown, Key::ArrowUp));
    if by != DVec2::ZERO {
        liquid.drag(by * STEP);
    }
}

/// Requests the pane as screens draw it.
fn ask(editor: &mut Editor, pane: usize, size: [u32; 2]) {
    let light = editor.light();
    if let Some(shot) = editor.shot(pane, Which::Present, size, &light) {
        let behind = backdrop(shot.behind.as_ref());
        let ask = LookupRequest { shot, grade: Grade::Fine, map: None, behind };
        editor.looker.ask((pane, Which::Present), ask);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pane_stays_in_its_picture() {
        let mut liquid = Liquid::default();
        for by in [DVec2::new(9.0, -9.0), DVec2::new(-0.1, 0.3), DVec2::splat(-9.0)] {
            liquid.drag(by);
            for picture in [[200, 120], [33, 400], [8, 8]] {
                let pane = liquid.pane(picture);
                let whole = DVec2::from(picture.map(f64::from));
                assert!(pane.corner.min_element() >= 0.0 && (pane.corner + pane.size).cmple(whole).all());
                assert!(pane.unit() >= LEAST && pane.radius <= pane.unit() / 2.0, "{pane:?}");
            }
        }
        assert_eq!(liquid.at, liquid.size / 200.0, "it lies in the corner");
    }
}
