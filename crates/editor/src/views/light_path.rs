//! The path of one ray through a stone: drawn in space, and described step by step.

mod drawing;
mod orbit;
mod table;
#[cfg(test)]
mod tests;

use self::orbit::Orbit;
use self::table::PathTable;
use brillianteer_math::Basis;
use brillianteer_scene::{Band, Body, Scope, View, elevation_deg};
use brillianteer_trace::ray::Path;
use egui::{Align, Color32, CursorIcon, Layout, Sense, Ui, Vec2, WidgetInfo, accesskit::Role, vec2};
use glam::{DQuat, DVec3};

/// The least width at which the table stands beside the drawing, as a multiple of the table's own width.
const ROOM_FOR_BOTH: f32 = 1.8;

/// The part of the height that the drawing takes where it is above the table.
const UPPER_PART: f32 = 0.55;

/// The help on turning the drawing, for screen readers.
const HELP: &str = "Drag or press arrow keys to turn it, double-click or press Home to turn it back";

/// The sine of the angle to the scope's axis below which light has no azimuth.
const OVERHEAD: f64 = 1e-6;

/// The view of a ray's path; it keeps the direction of the eye and the step that was picked.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LightPath {
    orbit: Orbit,
    kept: Option<usize>,
}

/// A path, with the stone, scope and frame by which the destinations of its light are described.
struct Reading<'a> {
    body: &'a Body,
    path: &'a Path,
    scope: &'a Scope,
    light: Basis,
    /// The rotation of the stone as the views show it.
    turn: DQuat,
}

impl LightPath {
    /// Draws the path through its stone, and beside or below it a table of its steps, over all the room there is.
    ///
    /// Elevations are counted from the plane square to the axis of the view's [`light_basis`](View::light_basis), azimuths
    /// counter-clockwise from its `right`.
    pub fn show(&mut self, ui: &mut Ui, body: &Body, path: &Path, scope: &Scope, view: &View) {
        let reading = Reading { body, path, scope, light: view.light_basis(), turn: view.turn };
        let table = PathTable::new(&reading);
        let (room, width) = (ui.available_size(), table.width(ui));
        // In a place that scrolls, the height may have no limit.
        let height = room.y.min(2.0 * room.x);
        let beside = room.x > ROOM_FOR_BOTH * width;
        let size = if beside {
            vec2(room.x - width - ui.spacing().item_spacing.x, height)
        } else {
            vec2(room.x, height * UPPER_PART)
        };
        let layout = if beside { Layout::left_to_right(Align::Min) } else { Layout::top_down(Align::Min) };
        self.kept = self.kept.filter(|&k| k < path.steps.len());
        ui.with_layout(layout, |ui| self.parts(ui, size, &reading, &table));
    }

    fn parts(&mut self, ui: &mut Ui, size: Vec2, reading: &Reading, table: &PathTable) {
        let (response, painter) = ui.allocate_painter(size, Sense::click_and_drag());
        let response = response.on_hover_cursor(CursorIcon::Grab);
        self.orbit.turned_by(ui, &response);
        response.widget_info(|| {
            let met = reading.path.steps.len();
            WidgetInfo::labeled(
                Role::Canvas,
                true,
                format!("Light path through the stone, {met} facets met. {HELP}"),
            )
        });
        let hovered = ui.vertical(|ui| table.show(ui, &mut self.kept)).inner;
        let lit = hovered.or(self.kept);
        let eye = self.orbit.eye().turned(reading.turn.inverse());
        drawing::paint(&painter, ui.visuals(), (eye, response.has_focus()), reading, lit);
    }
}

impl Reading<'_> {
    fn band(&self, direction: DVec3) -> &Band {
        &self.scope.bands[self.scope.band(direction, self.light.toward)]
    }

    /// Returns the colour of the scope's zone in a direction.
    fn colour(&self, direction: DVec3) -> Color32 {
        let [r, g, b] = self.band(direction).colour;
        Color32::from_rgb(r, g, b)
    }

    /// Returns the height of a direction above the scope's plane, degrees.
    fn elevation(&self, direction: DVec3) -> f64 {
        elevation_deg(direction, self.light.toward)
    }

    /// Returns the azimuth of a direction, counter-clockwise from the frame's right, 0 to 360 degrees; `None` along the
    /// scope's axis.
    fn azimuth(&self, direction: DVec3) -> Option<f64> {
        let across = self.light.project(direction);
        let turn = across.y.atan2(across.x).to_degrees().rem_euclid(360.0);
        (across.length() > OVERHEAD).then_some(turn)
    }
}
