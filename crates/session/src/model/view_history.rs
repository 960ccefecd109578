//! The history of the views: tilt, zoom, layout and overlay. It is apart from the design's undo, so that a change of
//! the design need not be searched among a hundred tilts.

use crate::model::eye::Eye;
use crate::model::history::History;
use crate::model::workspace::{Pane, PaneLayout, Workspace};
use serde::{Deserialize, Serialize};

/// Changes closer together than this, seconds, are one step: turns of the wheel, keys held down.
const PAUSE: f64 = 0.5;

/// Everything that one step of the views restores.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ViewState {
    layout: PaneLayout,
    panes: [Pane; 4],
    large: Option<usize>,
    eye: Eye,
    distance: f64,
    strongest: bool,
    glare: bool,
    overlay: Option<String>,
    is_split: bool,
}

impl ViewState {
    /// Returns the views of a workspace as they are.
    pub fn of(workspace: &Workspace) -> Self {
        let Workspace { layout, panes, large, eye, distance, strongest, glare, is_split, .. } = *workspace;
        let overlay = workspace.overlay.clone();
        Self { layout, panes, large, eye, distance, strongest, glare, overlay, is_split }
    }

    /// Brings these views back into a workspace.
    pub fn lay(self, workspace: &mut Workspace) {
        let Self { layout, panes, large, eye, distance, strongest, glare, overlay, is_split } = self;
        (workspace.layout, workspace.panes, workspace.large, workspace.eye) = (layout, panes, large, eye);
        (workspace.distance, workspace.strongest, workspace.glare) = (distance, strongest, glare);
        (workspace.overlay, workspace.is_split) = (overlay, is_split);
    }
}

/// The states that the views have been in.
#[derive(Debug, Clone)]
pub struct ViewHistory {
    history: History<ViewState>,
    /// The last state, which may still be changing, and the time when it was recorded, seconds.
    last: (ViewState, f64),
}

impl ViewHistory {
    /// Begins with the workspace as it is.
    pub fn new(workspace: &Workspace) -> Self {
        let state = ViewState::of(workspace);
        Self { history: History::new(state.clone()), last: (state, 0.0) }
    }

    /// Writes the lengths of all states in another unit, of which `factor` make one of the unit before.
    pub fn in_unit(&mut self, factor: f64) {
        for state in self.history.each_mut().chain([&mut self.last.0]) {
            state.distance *= factor;
            let own = state.panes.iter_mut().filter_map(|pane| pane.own.as_mut());
            own.chain([&mut state.eye]).for_each(|eye| eye.centre *= factor);
        }
    }

    /// Records the workspace between two gestures, at the time `now`, seconds.
    pub fn note(&mut self, workspace: &Workspace, now: f64) {
        let state = ViewState::of(workspace);
        if state != self.last.0 {
            if now - self.last.1 > PAUSE {
                self.settle();
            }
            self.last = (state, now);
        }
    }

    /// Ends a step: the next change begins another.
    pub fn settle(&mut self) {
        self.history.settle(&self.last.0);
    }

    /// Returns whether there is a state to go back to, and one to go forward to.
    pub fn steps(&self) -> (bool, bool) {
        (self.history.can_undo() || self.last.0 != *self.history.present(), self.history.can_redo())
    }

    /// Goes back to the state before.
    pub fn back(&mut self, workspace: &mut Workspace) {
        self.settle();
        let state = self.history.undo();
        self.go(state, workspace);
    }

    /// Goes forward to the state from before the last step back.
    pub fn on(&mut self, workspace: &mut Workspace) {
        self.settle();
        let state = self.history.redo();
        self.go(state, workspace);
    }

    fn go(&mut self, state: Option<ViewState>, workspace: &mut Workspace) {
        if let Some(state) = state {
            self.last.0 = state.clone();
            state.lay(workspace);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_at_once_is_one_step_and_what_follows_later_another() {
        let mut workspace = Workspace::default();
        let mut history = ViewHistory::new(&workspace);
        let zooms = [(2.0, 10.0), (3.0, 10.1), (4.0, 10.2), (5.0, 11.0), (6.0, 11.1)];
        for (zoom, now) in zooms {
            workspace.eye.zoom = zoom;
            history.note(&workspace, now);
        }
        assert_eq!(history.steps(), (true, false));
        let mut seen = vec![];
        for _ in 0..3 {
            history.back(&mut workspace);
            seen.push(workspace.eye.zoom);
        }
        history.on(&mut workspace);
        seen.push(workspace.eye.zoom);
        assert_eq!((seen, history.steps()), (vec![4.0, 1.0, 1.0, 4.0], (true, true)));
    }
}
