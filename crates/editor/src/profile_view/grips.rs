//! Handles on the screen: their squares for pointer and keyboard, and their discs.

use super::handle::Handle;
use super::ink::ProfileInks;
use super::sight::ProfileProjection;
use crate::arrows;
use brillianteer_cut::{Cut, ProfileHandle};
use brillianteer_picture::profile::Dimensions;
use brillianteer_session::value_grid::ValueGrid;
use egui::accesskit::{Action, ActionData};
use egui::{Id, Modifiers, Painter, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2, WidgetInfo};
use glam::DVec2;

/// Half the width of the square in which a handle takes the pointer, where there is room, in points. The window's own
/// tolerance comes on top.
const REACH: f32 = 6.0;
/// The least half width of that square where handles lie close together, in points.
const LEAST_REACH: f32 = 1.5;
/// Radii of a disc at rest, and of one that the pointer is over, in points.
const AT_REST: f32 = 3.5;
const GROWN: f32 = 6.0;
/// Strength of a disc's rim while the pointer is elsewhere, 0 to 1.
const RESTING: f32 = 0.65;

/// A handle on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// The part of the profile that the handle pulls.
    pub handle: Handle,
    /// True for a second copy, on the stone's other side.
    pub mirrored: bool,
    /// The centre of the handle.
    pub at: Pos2,
    /// Half the width of the square in which the handle takes the pointer, in points; 0 where only the keyboard reaches it.
    pub reach: f32,
}

/// Returns the handles of a cut whose profile has these dimensions. The table has one at either end. Pavilion depth and
/// culet lie in the same place, and the pointer takes them as one handle.
pub fn grips(cut: &Cut, dimensions: &Dimensions, sight: &ProfileProjection) -> Vec<Grip> {
    let handles = || ProfileHandle::ALL.into_iter().filter_map(|part| Handle::of(cut, part));
    let left = handles().filter(|handle| handle.part == ProfileHandle::TableEdge);
    let all = handles().map(|handle| (handle, false)).chain(left.map(|handle| (handle, true)));
    let grip = |(handle, mirrored): (Handle, bool)| {
        let place = handle.at(dimensions)? * DVec2::new(if mirrored { -1.0 } else { 1.0 }, 1.0);
        Some(Grip { handle, mirrored, at: sight.at(place), reach: 0.0 })
    };
    let mut grips: Vec<Grip> = all.filter_map(grip).collect();
    for k in 0..grips.len() {
        grips[k].reach = reach(&grips, k);
    }
    grips
}

/// Returns half the width of a handle's square. Squares do not overlap, so that the nearest one takes the pointer.
fn reach(grips: &[Grip], k: usize) -> f32 {
    let for_keys = |grip: &Grip| grip.handle.part == ProfileHandle::CuletEdge;
    if for_keys(&grips[k]) {
        return 0.0;
    }
    let others = grips.iter().enumerate().filter(|&(other, grip)| other != k && !for_keys(grip));
    let nearest = others.map(|(_, grip)| (grip.at - grips[k].at).abs().max_elem()).fold(f32::MAX, f32::min);
    (nearest / 2.0).clamp(LEAST_REACH, REACH)
}

impl Grip {
    /// Returns the square in which the handle takes the pointer.
    pub fn square(&self) -> Rect {
        Rect::from_center_size(self.at, Vec2::splat(2.0 * self.reach.max(LEAST_REACH)))
    }

    /// Returns the identity of the handle within that of the drawing.
    pub fn id(&self, drawing: Id) -> Id {
        drawing.with((self.handle.name(), self.mirrored))
    }

    /// Offers the handle to the pointer and, unless it is a mirrored copy, to the keyboard.
    pub fn offer(&self, ui: &Ui, drawing: Id) -> Response {
        let sense = match (self.mirrored, self.reach > 0.0) {
            (true, _) => Sense::DRAG,
            (false, true) => Sense::drag(),
            (false, false) => Sense::focusable_noninteractive(),
        };
        ui.interact(self.square(), self.id(drawing), sense)
    }

    /// Returns the proportions after this frame's key presses and requests of screen readers.
    pub fn keyed(&self, ui: &Ui, response: &Response, given: Cut) -> Cut {
        let row = self.handle.row;
        // Shift first: a search for a key without modifiers also finds it pressed with one.
        let steps = [(ValueGrid::FINE, Modifiers::SHIFT), (ValueGrid::COARSE, Modifiers::NONE)]
            .map(|(grid, modifiers)| (grid, self.key_steps(ui, response, modifiers)));
        let requested = (ValueGrid::COARSE, requested_steps(ui, response.id));
        let stepped = steps.into_iter().chain([requested]).filter(|&(_, steps)| steps != 0);
        let stepped = stepped.fold(given, |given, (grid, steps)| grid.stepped(row, &given, steps));
        match requested_value(ui, response.id) {
            Some(value) => ValueGrid::FINE.toward(row, &stepped, value),
            None => stepped,
        }
    }

    /// Returns the steps by which arrow keys change the value. Up and down move the handle the way they point; left and
    /// right lower and raise its value.
    fn key_steps(&self, ui: &Ui, response: &Response, modifiers: Modifiers) -> i32 {
        if !response.has_focus() {
            return 0;
        }
        arrows::keep(ui, response.id);
        let way = arrows::way(ui, modifiers);
        (way.x + if self.handle.grows_downward() { -way.y } else { way.y }) as i32
    }

    /// Reports the handle's name and value to screen readers.
    pub fn show_value(&self, ui: &Ui, response: &Response, value: f64) {
        let label = format!("{}, {}", self.handle.name(), self.handle.row.unit.name());
        response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), value, &label));
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_numeric_value_step(ValueGrid::COARSE.step());
            for action in [Action::Increment, Action::Decrement, Action::SetValue] {
                node.add_action(action);
            }
        });
    }

    /// Paints the handle's disc. Its rim is stronger the more the pointer is `near` the drawing, and it is larger the more
    /// the handle is `pointed_at` (both 0 to 1). A ring marks the keyboard focus.
    pub fn paint(&self, painter: &Painter, inks: &ProfileInks, [near, pointed_at]: [f32; 2], focused: bool) {
        let rest = AT_REST.min(self.reach).max(LEAST_REACH + 1.0);
        let radius = rest + (GROWN - AT_REST) * pointed_at;
        let fill = inks.paper.lerp_to_gamma(inks.accent, pointed_at);
        let rim = inks.paper.lerp_to_gamma(inks.accent, RESTING + (1.0 - RESTING) * near);
        painter.circle(self.at, radius, fill, Stroke::new(1.4, rim));
        if focused {
            painter.circle_stroke(self.at, radius + 3.0, Stroke::new(1.0, inks.accent));
        }
    }
}

/// Returns the steps that a screen reader requests; negative ones lower the value.
fn requested_steps(ui: &Ui, id: Id) -> i32 {
    ui.input(|i| {
        let count = |action| i.num_accesskit_action_requests(id, action) as i32;
        count(Action::Increment) - count(Action::Decrement)
    })
}

/// Returns the value that a screen reader sets, if any.
fn requested_value(ui: &Ui, id: Id) -> Option<f64> {
    ui.input(|i| {
        let values = i.accesskit_action_requests(id, Action::SetValue).filter_map(|r| match r.data {
            Some(ActionData::NumericValue(value)) => Some(value),
            _ => None,
        });
        values.last()
    })
}
