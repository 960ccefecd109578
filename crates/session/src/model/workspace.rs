//! The user's arrangement of the window, which is kept from one start to the next.

use super::cutting::CuttingProgress;
use crate::model::eye::Eye;
use crate::shows::Shows;
use brillianteer_picture::Overlay;
use brillianteer_scene::{Glare, Projection, View};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The number of views in the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum PaneLayout {
    /// One view.
    One,
    /// Two views, side by side or one above the other.
    Two,
    /// Four views.
    #[default]
    Four,
}

impl PaneLayout {
    /// Returns the number of panes in the layout.
    pub fn panes(self) -> usize {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Four => 4,
        }
    }
}

/// A panel beside the views.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum PanelSide {
    /// The design, on the left.
    Design,
    /// The figures, on the right.
    Figures,
}

/// The open panels; the others are folded to strips, which open them again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Panels {
    /// True where the design panel is open in a window that has room for both.
    pub design: bool,
    /// True where the figures panel is open in a window that has room for both.
    pub figures: bool,
    /// The panel that is open in a window that has room for one.
    pub narrow: Option<PanelSide>,
}

impl Default for Panels {
    fn default() -> Self {
        Self { design: true, figures: true, narrow: Some(PanelSide::Design) }
    }
}

impl Panels {
    /// Returns whether a panel is open.
    pub fn is_open(&self, side: PanelSide, has_room_for_both: bool) -> bool {
        match (has_room_for_both, side) {
            (false, _) => self.narrow == Some(side),
            (true, PanelSide::Design) => self.design,
            (true, PanelSide::Figures) => self.figures,
        }
    }

    /// Opens or folds a panel.
    pub fn set(&mut self, side: PanelSide, has_room_for_both: bool, is_open: bool) {
        match (has_room_for_both, side) {
            (false, _) => self.narrow = is_open.then_some(side),
            (true, PanelSide::Design) => self.design = is_open,
            (true, PanelSide::Figures) => self.figures = is_open,
        }
    }
}

/// The settings of one view.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pane {
    /// The picture or drawing that the view shows.
    pub shows: Shows,
    /// The view's own eye; `None` where it uses the eye of the linked views.
    pub own: Option<Eye>,
    /// True for perspective, from nearby; false for parallel rays.
    #[serde(default)]
    pub is_near: bool,
    /// The picture of the stone that the view shows again when another document begins; `None` for the present one.
    #[serde(default)]
    pub stone: Option<Shows>,
}

/// The distance of the eye with which perspective begins, girdle radii: that of a stone of 6.5 mm from 10 cm.
const DISTANCE: f64 = 30.0;

/// The greatest number of recent files.
const MOST_RECENT: usize = 10;

/// The arrangement of the window, with all settings that are kept between starts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Workspace {
    /// The number of views in the window.
    pub layout: PaneLayout,
    /// The views; a layout with fewer shows the first of them.
    pub panes: [Pane; 4],
    /// The view that is shown alone for now, if any.
    pub large: Option<usize>,
    /// The eye of all linked views.
    pub eye: Eye,
    /// The distance of the eye from the stone's origin in perspective views, girdle radii.
    pub distance: f64,
    /// True where scopes show only the strongest exits.
    pub strongest: bool,
    /// True where scopes and the zones of figures include the glare of the stone's outer surface.
    pub glare: bool,
    /// The name of the overlay on pictures, if any.
    pub overlay: Option<String>,
    /// True where figures count the areas of the strongest exits, and not energy.
    pub by_area: bool,
    /// True where both designs of a comparison are seen side by side.
    pub is_split: bool,
    /// The recent files, the last one first.
    pub recent: Vec<PathBuf>,
    /// The file that was open last.
    pub last: Option<PathBuf>,
    /// True where the panels are hidden, so that views fill the window.
    pub hides_panels: bool,
    /// True where the table of tiers is open below the views.
    pub shows_tiers: bool,
    /// True where the list of the audit is open below the views.
    pub shows_audit: bool,
    /// True where the map of a measure is open.
    pub shows_map: bool,
    /// Progress at the faceting machine.
    pub cutting: CuttingProgress,
    /// The panels that are open where panels are not hidden.
    pub panels: Panels,
}

impl Default for Workspace {
    fn default() -> Self {
        let pane = |shows| Pane { shows, own: None, is_near: false, stone: None };
        Self {
            layout: PaneLayout::Four,
            panes: [Shows::Render, Shows::Aset, Shows::Hearts, Shows::Profile].map(pane),
            large: None,
            eye: Eye::default(),
            distance: DISTANCE,
            strongest: false,
            glare: false,
            overlay: None,
            by_area: false,
            is_split: false,
            recent: vec![],
            last: None,
            hides_panels: false,
            shows_tiers: false,
            shows_audit: false,
            shows_map: false,
            cutting: CuttingProgress::default(),
            panels: Panels::default(),
        }
    }
}

impl Workspace {
    /// Returns whether scopes include glare.
    pub fn glare(&self) -> Glare {
        if self.glare { Glare::Included } else { Glare::LeftOut }
    }

    /// Looks at the table of the whole stone in every view, as a document begins: linked, along parallel rays, with nothing drawn
    /// over it and no view alone. Views of a background show the picture of the stone again that they showed before.
    pub fn begin_views(&mut self) {
        self.reset_view();
        self.large = None;
        let usual = Self::default().panes;
        for (pane, usual) in self.panes.iter_mut().zip(usual) {
            let stone = if pane.shows.is_of_background() { usual.shows } else { pane.shows };
            pane.shows = pane.stone.take().unwrap_or(stone);
        }
    }

    /// Shows a view of a render alone, from a distance in girdle radii, or along parallel rays.
    pub fn show_scene(&mut self, distance: Option<f64>) {
        let panes = &mut self.panes[..self.layout.panes()];
        let found = panes.iter().position(|pane| pane.shows == Shows::Render);
        if found.is_none() {
            panes[0].stone = Some(panes[0].shows);
            panes[0].shows = Shows::Render;
        }
        self.large = (panes.len() > 1).then_some(found.unwrap_or(0));
        for pane in self.panes.iter_mut().filter(|pane| pane.shows == Shows::Render) {
            pane.is_near = distance.is_some();
        }
        self.distance = distance.unwrap_or(self.distance);
    }

    /// Returns the panes in sight, by their numbers.
    pub fn shown(&self) -> Vec<usize> {
        match self.large.filter(|&k| k < self.layout.panes()) {
            Some(large) => vec![large],
            None => (0..self.layout.panes()).collect(),
        }
    }

    /// Returns the eye of a pane.
    pub fn eye(&self, pane: usize) -> &Eye {
        self.panes[pane].own.as_ref().unwrap_or(&self.eye)
    }

    /// Writes the places of all eyes in another unit, of which `factor` make one of the unit before.
    pub fn eyes_in_unit(&mut self, factor: f64) {
        self.distance *= factor;
        let own = self.panes.iter_mut().filter_map(|pane| pane.own.as_mut());
        own.chain([&mut self.eye]).for_each(|eye| eye.centre *= factor);
    }

    /// Returns the view of the stone in a pane: from the side that its picture is made for, if any.
    pub fn view(&self, pane: usize) -> View {
        let view = self.eye(pane).view(self.panes[pane].shows.side());
        if self.is_near(pane) {
            View { projection: Projection::Perspective { distance: self.distance }, ..view }
        } else {
            view
        }
    }

    /// Returns whether a pane shows the stone from nearby, in perspective.
    pub fn is_near(&self, pane: usize) -> bool {
        let Pane { shows, is_near, .. } = self.panes[pane];
        is_near && shows.takes_perspective()
    }

    /// Changes what a pane shows.
    ///
    /// A scope uses parallel rays until the user asks for perspective.
    pub fn show(&mut self, pane: usize, shows: Shows) {
        let now = &mut self.panes[pane];
        now.is_near &= now.shows == shows || shows.scoped().is_none();
        let stone = now.stone.or((!now.shows.is_of_background()).then_some(now.shows));
        now.stone = stone.filter(|_| shows.is_of_background());
        now.shows = shows;
    }

    /// Looks at the table of the whole stone in all views, linked and along parallel rays, with nothing drawn over it.
    pub fn reset_view(&mut self) {
        self.panes.iter_mut().for_each(|pane| (pane.own, pane.is_near) = (None, false));
        let Self { eye, distance, strongest, glare, overlay, .. } = Self::default();
        (self.eye, self.distance, self.overlay) = (eye, distance, overlay);
        (self.strongest, self.glare) = (strongest, glare);
    }

    /// Restores the views and panels of the first start; every view keeps its eye.
    pub fn reset_layout(&mut self) {
        let Self { layout, panes, large, is_split, hides_panels, panels, .. } = Self::default();
        (0..panes.len()).for_each(|pane| self.show(pane, panes[pane].shows));
        (self.layout, self.large) = (layout, large);
        (self.is_split, self.hides_panels, self.panels) = (is_split, hides_panels, panels);
    }

    /// Returns the eye of a pane for a change: its own, or that of the linked views.
    pub fn eye_mut(&mut self, pane: usize) -> &mut Eye {
        self.panes[pane].own.as_mut().unwrap_or(&mut self.eye)
    }

    /// Returns the overlay on pictures.
    pub fn overlay(&self) -> Option<Overlay> {
        self.overlay.as_deref().and_then(|name| name.parse().ok())
    }

    /// Switches an overlay on pictures on, or off where it is the present one.
    pub fn toggle_overlay(&mut self, name: &str) {
        let same = self.overlay.as_deref() == Some(name);
        self.overlay = (!same).then(|| name.to_owned());
    }

    /// Remembers a file as the last one that was open.
    pub fn remember(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|p| *p != path);
        self.recent.insert(0, path.clone());
        self.recent.truncate(MOST_RECENT);
        self.last = Some(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_desk_is_kept_as_text_and_an_old_one_is_completed() {
        let mut workspace = Workspace { layout: PaneLayout::Two, ..Workspace::default() };
        workspace.eye.spin(brillianteer_scene::Side::Table, 0.5);
        workspace.remember(Path::new("/a/b.toml"));
        let text = serde_json::to_string(&workspace).unwrap();
        assert_eq!(serde_json::from_str::<Workspace>(&text).unwrap(), workspace);
        assert_eq!(serde_json::from_str::<Workspace>("{}").unwrap(), Workspace::default());
    }

    #[test]
    fn a_render_is_shown_alone_wherever_it_is_and_where_there_is_none() {
        let mut workspace = Workspace { layout: PaneLayout::Two, ..Workspace::default() };
        workspace.panes[..2].iter_mut().for_each(|pane| pane.shows = Shows::Aset);
        workspace.panes[3].shows = Shows::Render;
        workspace.show_scene(None);
        assert_eq!((workspace.shown(), workspace.panes[0].shows), (vec![0], Shows::Render));
        workspace.begin_views();
        assert_eq!((workspace.shown(), workspace.panes[0].shows), (vec![0, 1], Shows::Aset));
        workspace.layout = PaneLayout::Four;
        workspace.show_scene(Some(4.0));
        assert_eq!((workspace.shown(), workspace.panes[0].shows), (vec![3], Shows::Aset));
        assert!(workspace.panes[3].is_near && workspace.distance == 4.0);
    }

    #[test]
    fn a_view_of_a_background_and_all_else_that_is_seen_of_one_document_ends_with_it() {
        let mut workspace = Workspace { layout: PaneLayout::Two, ..Workspace::default() };
        workspace.show(0, Shows::Hearts);
        let before = workspace.clone();
        for shows in [Shows::Refraction, Shows::LiquidGlass, Shows::TracedPane] {
            workspace.show(0, shows);
        }
        (workspace.large, workspace.glare, workspace.strongest) = (Some(1), true, true);
        workspace.toggle_overlay("facets");
        (workspace.distance, workspace.panes[1].is_near, workspace.panes[2].own) =
            (3.0, true, Some(workspace.eye));
        workspace.eye.spin(brillianteer_scene::Side::Table, 0.5);
        workspace.begin_views();
        assert_eq!(workspace, before);
        // Workspaces of earlier versions do not say what a view showed before.
        workspace.panes[1].shows = Shows::LiquidGlass;
        workspace.begin_views();
        assert_eq!(workspace.panes[1].shows, Workspace::default().panes[1].shows);
    }

    #[test]
    fn recent_files_are_few_and_each_stands_once() {
        let mut workspace = Workspace::default();
        (0..30).for_each(|k| workspace.remember(Path::new(&format!("/{}.toml", k % 20))));
        assert_eq!(workspace.recent.len(), MOST_RECENT);
        assert_eq!(workspace.recent[0], Path::new("/9.toml"));
    }

    #[test]
    fn every_overlay_is_toggled() {
        let mut workspace = Workspace::default();
        for name in Overlay::names() {
            workspace.toggle_overlay(name);
            assert!(workspace.overlay().is_some(), "{name}");
            workspace.toggle_overlay(name);
            assert_eq!(workspace.overlay(), None);
        }
    }
}
