//! The click that may follow a ray through the stone, and the place where the window of its path opens.

use super::light_path::LightPath;
use brillianteer_session::model::action::ViewAction;
use egui::{Context, Pos2, Rect, pos2};
use glam::DVec2;

/// The time after which a click can no longer become a double click, seconds.
const PATIENCE: f64 = 0.32;

/// The first place of the window, unless a view there is clicked: over the views, beside the design panel.
const PLACE: Pos2 = pos2(372.0, 220.0);

/// The window of the light path, and the click that may open it.
#[derive(Debug, Default)]
pub struct Following {
    /// A click that may become a double click: the view, the point of its image, and the time in seconds.
    waiting: Option<(usize, DVec2, f64)>,
    /// True where Escape ended something else in the last frame.
    pub waits: bool,
    /// The rectangle on the screen of the view that was clicked.
    clicked: Option<Rect>,
    /// The drawing and the table of the path.
    pub view: LightPath,
}

impl Following {
    /// Takes a click on a point of a view; the ray there is followed unless the click becomes a double click.
    pub fn click(&mut self, pane: usize, at: DVec2, body: Rect, ctx: &Context) {
        self.clicked = Some(body);
        self.waiting = Some((pane, at, ctx.input(|i| i.time)));
        ctx.request_repaint_after_secs(PATIENCE as f32 + 0.02);
    }

    /// Forgets the click that waits: it was half of a double click.
    pub fn unclick(&mut self) {
        self.waiting = None;
    }

    /// Returns the place where the window opens, which does not cover the clicked view.
    pub fn place(&self) -> Pos2 {
        let covered = self.clicked.filter(|body| body.left() <= PLACE.x);
        covered.map_or(PLACE, |body| pos2(body.right(), PLACE.y))
    }

    /// Returns the click once it is certain that it became no double click.
    pub fn ripe(&mut self, ctx: &Context) -> Option<ViewAction> {
        let now = ctx.input(|i| i.time);
        let Some((pane, at, _)) = self.waiting.filter(|(.., since)| now - since > PATIENCE) else {
            self.waiting.iter().for_each(|_| ctx.request_repaint_after_secs(0.05));
            return None;
        };
        self.waiting = None;
        Some(ViewAction::Follow(pane, at))
    }
}
