//! What views are drawn with beside the model.

use super::following::Following;
use super::gallery::Gallery;
use super::probe::ProbeCache;
use crate::app::model::Model;
use crate::app::model::action::{Actions, ViewAction};
use crate::app::model::ordering::Orders;
use crate::app::model::stones::Stones;
use crate::app::profile_view::ProfileView;
use crate::app::studio::Paper;

/// What views are drawn with that is no state of the editor: pictures, and what is kept for speed or for a gesture.
#[derive(Default)]
pub struct ViewTools {
    /// The pictures of the views.
    pub gallery: Gallery,
    /// The stones as the views show them.
    pub stones: Stones,
    /// Finds what lies under the pointer.
    pub probe: ProbeCache,
    /// The drawing of the stone from the side, in each view.
    pub profiles: [ProfileView; 4],
    /// The window of the light path.
    pub following: Following,
    /// The colours and the scale of drawings, light or dark as the window is.
    pub paper: Paper,
    /// What the pointer and the focus were at in the last frame.
    pub attention: Attention,
}

impl ViewTools {
    /// Returns what makes the orders of pictures.
    pub fn orders<'a>(&'a mut self, model: &'a Model) -> Orders<'a> {
        Orders { model, stones: &mut self.stones, paper: self.paper }
    }

    /// Whether a handle of a profile is dragged.
    pub fn is_handle_dragged(&self) -> bool {
        self.profiles.iter().any(ProfileView::is_dragging)
    }
}

/// What the pointer and the focus are at, as the views of one frame find it.
#[derive(Debug, Default)]
pub struct Attention {
    /// The view under the pointer or with the focus.
    pub hovered: Option<usize>,
    /// The view whose menu is open: commands act on it, wherever the pointer is.
    pub menu: Option<usize>,
    /// What the status line says of what is under the pointer.
    pub message: String,
    /// Whether a picture has the focus, so that Space lays out the copies in it.
    pub is_picture_focused: bool,
}

impl Attention {
    /// Reports to the model what has changed.
    pub fn report(&self, model: &Model, actions: &mut Actions) {
        let hovered = self.menu.or(self.hovered);
        if let Some(pane) = hovered.filter(|&pane| pane != model.session.hovered) {
            actions.push(ViewAction::Hover(pane));
        }
        if self.message != model.session.message {
            actions.push(ViewAction::Message(self.message.clone()));
        }
    }
}
