//! The tools by which views are drawn, besides the model.

use super::following::Following;
use super::gallery::Gallery;
use super::probe::ProbeCache;
use super::tier_drag::TierHand;
use crate::profile_view::ProfileView;
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
    motion::WaveCache,
    ordering::Orders,
};
use brillianteer_session::studio::Paper;

/// The tools of the views besides the model: pictures, caches, and the state of gestures.
#[derive(Default)]
pub struct ViewTools {
    /// The pictures of the views.
    pub gallery: Gallery,
    /// The stones in their present phase.
    pub waves: WaveCache,
    /// The probes that find the facet and light under the pointer.
    pub probe: ProbeCache,
    /// The drawing of the stone from the side, in each view.
    pub profiles: [ProfileView; 4],
    /// The hand on a tier of the design.
    pub tiers: TierHand,
    /// The window of the light path.
    pub following: Following,
    /// The colours and the scale of drawings, light or dark as the window is.
    pub paper: Paper,
    /// The views and pictures under the pointer or with the focus in the last frame.
    pub attention: Attention,
}

impl ViewTools {
    /// Returns the maker of the orders of pictures.
    pub fn orders<'a>(&'a mut self, model: &'a Model) -> Orders<'a> {
        Orders { model, waves: &mut self.waves, paper: self.paper }
    }

    /// Returns whether a handle of a profile or a facet of a tier is dragged.
    pub fn is_handle_dragged(&self) -> bool {
        self.tiers.is_dragging() || self.profiles.iter().any(ProfileView::is_dragging)
    }
}

/// The view under the pointer or with the focus, found while a frame is drawn.
#[derive(Debug, Default)]
pub struct Attention {
    /// The view under the pointer or with the focus.
    pub hovered: Option<usize>,
    /// The view whose menu is open: commands act on it, wherever the pointer is.
    pub menu: Option<usize>,
    /// The status line about the facet or light under the pointer.
    pub message: String,
    /// True where a picture has the focus, so that Space lays out the copies in it.
    pub is_picture_focused: bool,
}

impl Attention {
    /// Reports changes to the model.
    pub fn report(&self, model: &Model, actions: &mut Actions) {
        let hovered = self.menu.or(self.hovered);
        if let Some(pane) = hovered.filter(|&pane| pane != model.session.hovered) {
            actions.push(ViewAction::Hover(pane));
        }
        actions.push_changed(&model.session.message, self.message.clone(), ViewAction::Message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_session::model::{action::Action, workspace::Workspace};

    /// Returns the view that an attention reports as the one that commands act on, and the text for the status line.
    fn reported(attention: Attention) -> (Option<usize>, Option<String>) {
        let (model, mut actions) = (Model::new(Workspace::default()).unwrap(), Actions::default());
        attention.report(&model, &mut actions);
        let mut reported = (None, None);
        for action in actions.take() {
            match action {
                Action::View(ViewAction::Hover(pane)) => reported.0 = Some(pane),
                Action::View(ViewAction::Message(text)) => reported.1 = Some(text),
                other => panic!("{other:?}"),
            }
        }
        reported
    }

    #[test]
    fn commands_act_on_the_view_whose_menu_is_open_wherever_the_pointer_is() {
        let attention = |hovered, menu| Attention { hovered, menu, ..Attention::default() };
        assert_eq!(reported(attention(Some(2), Some(1))).0, Some(1));
        assert_eq!(reported(attention(Some(2), None)).0, Some(2));
    }

    #[test]
    fn what_is_as_it_was_is_not_reported() {
        assert_eq!(reported(Attention { hovered: Some(0), ..Attention::default() }), (None, None));
        let text = || "table".to_owned();
        assert_eq!(reported(Attention { message: text(), ..Attention::default() }), (None, Some(text())));
    }
}
