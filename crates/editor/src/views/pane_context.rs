//! The context in which one view is drawn.

use super::gallery::Shown;
use super::tools::ViewTools;
use crate::menus::entry;
use brillianteer_session::model::{Model, action::Actions, command::Command, eye::Eye, session::Flowing};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::Which;
use egui::{Response, Stroke, Ui};

/// The context of one view in one frame: the state that it shows, and the user's actions in it.
pub struct PaneContext<'a> {
    pub model: &'a Model,
    /// The tools that all views share.
    pub tools: &'a mut ViewTools,
    pub actions: &'a mut Actions,
    /// The number of the view.
    pub pane: usize,
    pub shows: Shows,
    /// The state of the background in a view of a refraction map, which this frame changes.
    pub flowing: Flowing,
}

impl<'a> PaneContext<'a> {
    /// Begins to draw a view.
    pub fn new(model: &'a Model, tools: &'a mut ViewTools, actions: &'a mut Actions, pane: usize) -> Self {
        let (shows, flowing) = (model.workspace.panes[pane].shows, model.session.flowing[pane]);
        Self { model, tools, actions, pane, shows, flowing }
    }

    /// Draws the entry of a command in a menu.
    pub fn entry(&mut self, ui: &mut Ui, command: Command) {
        entry(self.model, self.actions, ui, command);
    }

    /// Returns the view's eye.
    pub fn eye(&self) -> Eye {
        *self.model.workspace.eye(self.pane)
    }

    /// Returns a picture of the view.
    pub fn shown(&self, which: Which) -> Option<&Shown> {
        self.tools.gallery.shown(self.model, (self.pane, which))
    }
}

/// Returns the frame around a picture that has the keyboard focus.
pub fn focus(ui: &Ui, response: &Response) -> Stroke {
    if response.has_focus() { ui.visuals().selection.stroke } else { Stroke::NONE }
}

/// Returns whether a row has more than so many points left.
pub fn has_room(ui: &Ui, points: f32) -> bool {
    ui.available_width() > points
}
