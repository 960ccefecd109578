//! How the views have been looked at, to go back over: apart from the design's own steps, which nobody wants to search
//! among a hundred tilts.

use super::eye::Eye;
use super::history::History;
use super::workspace::{Pane, PaneLayout, Workspace};

/// Changes nearer to each other than this, seconds, are one step: turns of the wheel, keys held down.
const PAUSE: f64 = 0.5;

/// All that a look is.
#[derive(Debug, Clone, PartialEq)]
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
    fn of(desk: &Workspace) -> Self {
        let Workspace { layout, panes, large, eye, distance, strongest, glare, is_split, .. } = *desk;
        let overlay = desk.overlay.clone();
        Self { layout, panes, large, eye, distance, strongest, glare, overlay, is_split }
    }

    fn lay(self, desk: &mut Workspace) {
        let Self { layout, panes, large, eye, distance, strongest, glare, overlay, is_split } = self;
        (desk.layout, desk.panes, desk.large, desk.eye) = (layout, panes, large, eye);
        (desk.distance, desk.strongest, desk.glare) = (distance, strongest, glare);
        (desk.overlay, desk.is_split) = (overlay, is_split);
    }
}

/// The looks that there were.
#[derive(Debug)]
pub struct ViewHistory {
    history: History<ViewState>,
    /// The last look, which may still be on its way, and when it came, seconds.
    last: (ViewState, f64),
}

impl ViewHistory {
    /// Begins with the desk as it is.
    pub fn new(desk: &Workspace) -> Self {
        let look = ViewState::of(desk);
        Self { history: History::new(look.clone()), last: (look, 0.0) }
    }

    /// Takes note of the desk between two gestures.
    pub fn note(&mut self, desk: &Workspace, now: f64) {
        let look = ViewState::of(desk);
        if look != self.last.0 {
            if now - self.last.1 > PAUSE {
                self.settle();
            }
            self.last = (look, now);
        }
    }

    /// Ends a step: what comes is another.
    pub fn settle(&mut self) {
        self.history.settle(&self.last.0);
    }

    /// Whether there is a look to go back to, and one to come back from.
    pub fn steps(&self) -> (bool, bool) {
        (self.history.can_undo() || self.last.0 != *self.history.present(), self.history.can_redo())
    }

    /// Looks as before.
    pub fn back(&mut self, desk: &mut Workspace) {
        self.settle();
        let look = self.history.undo();
        self.go(look, desk);
    }

    /// Looks as before the last going back.
    pub fn on(&mut self, desk: &mut Workspace) {
        self.settle();
        let look = self.history.redo();
        self.go(look, desk);
    }

    fn go(&mut self, look: Option<ViewState>, desk: &mut Workspace) {
        if let Some(look) = look {
            self.last.0 = look.clone();
            look.lay(desk);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_at_once_is_one_step_and_what_follows_later_another() {
        let mut desk = Workspace::default();
        let mut looks = ViewHistory::new(&desk);
        let zooms = [(2.0, 10.0), (3.0, 10.1), (4.0, 10.2), (5.0, 11.0), (6.0, 11.1)];
        for (zoom, now) in zooms {
            desk.eye.zoom = zoom;
            looks.note(&desk, now);
        }
        assert_eq!(looks.steps(), (true, false));
        let mut seen = vec![];
        for _ in 0..3 {
            looks.back(&mut desk);
            seen.push(desk.eye.zoom);
        }
        looks.on(&mut desk);
        seen.push(desk.eye.zoom);
        assert_eq!((seen, looks.steps()), (vec![4.0, 1.0, 1.0, 4.0], (true, true)));
    }
}
