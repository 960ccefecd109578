//! The user's arrangement of the window, which is kept from one start to the next.

use super::cutting::CuttingProgress;
use crate::app::liquid::Liquid;
use crate::app::model::eye::Eye;
use crate::app::shows::Shows;
use crate::app::studio::Smoothing;
use crate::io::background::BackgroundRef;
use crate::picture::{Bloom, Overlay};
use crate::render::USUAL_BOUNCES;
use crate::scene::{Glare, Projection, View};
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
    /// The half angle of the observer's head in ASET and figures, degrees.
    pub head: f64,
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
    /// The light that renders show: its name, or its file.
    pub light: String,
    /// The exposure of renders, in stops.
    pub exposure: f64,
    /// The number of bands of wavelengths of renders.
    pub wavelengths: u32,
    /// The backplate behind stones in renders: `light`, the name of a pattern, or a photograph's file.
    pub behind: Option<String>,
    /// The settings that a scene has changed, and their former values, which come back with another stone.
    pub of_scene: Option<OfScene>,
    /// The distance of the backplate behind the middle, mm; `None` for a distance that grows with the stone.
    pub behind_mm: Option<f64>,
    /// The strength of refraction, 0 to 1: the part of the turn by refraction that light follows before it meets the
    /// backplate; 1 is physics.
    pub strength: f64,
    /// The part of the light of sparkles that spreads around them in renders, 0 to 1.
    pub glow: f64,
    /// The greatest number of bounces inside a stone through which renders follow light.
    pub bounces: u32,
    /// The angle by which the light is turned about its axis, degrees.
    pub light_turn: f64,
    /// True where the light's axis points up in renders, false where it points to the eye.
    pub light_upright: bool,
    /// The method that smooths the edges of renders.
    pub smoothing: Smoothing,
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
    /// The pane of liquid glass.
    pub liquid: Liquid,
}

/// The settings that a scene has made, with the former ones: the backplate and the number of bands of wavelengths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OfScene {
    set: (Option<String>, u32),
    before: (Option<String>, u32),
    /// The perspective and smoothing of the views, with their former values.
    #[serde(default)]
    sight: Option<SightOfScene>,
    /// The light and its exposure in stops, with the values that the scene has set and the former values.
    #[serde(default)]
    light: Option<[(String, f64); 2]>,
    /// The view that is shown alone, and what the first view shows, with the values that the scene has set and the former
    /// values.
    #[serde(default)]
    alone: Option<[(Option<usize>, Shows); 2]>,
}

/// The distance of the eye, the views in perspective and the smoothing, with the values that a scene has set and the
/// former values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SightOfScene {
    set: (f64, [bool; 4], Smoothing),
    before: (f64, [bool; 4], Smoothing),
}

/// The numbers of bands of wavelengths that menus offer. With only three, each band can be told apart in the picture.
pub const WAVELENGTHS: [u32; 5] = [3, 8, 16, 32, 64];

impl Default for Workspace {
    fn default() -> Self {
        let pane = |shows| Pane { shows, own: None, is_near: false };
        Self {
            layout: PaneLayout::Four,
            panes: [Shows::Render, Shows::Aset, Shows::Hearts, Shows::Profile].map(pane),
            large: None,
            eye: Eye::default(),
            distance: DISTANCE,
            head: 0.0,
            strongest: false,
            glare: false,
            overlay: None,
            by_area: false,
            is_split: false,
            recent: vec![],
            last: None,
            light: crate::app::model::document::FIRST_LIGHT.to_owned(),
            exposure: 0.0,
            wavelengths: WAVELENGTHS[2],
            behind: None,
            of_scene: None,
            behind_mm: None,
            strength: 1.0,
            glow: Bloom::default().strength,
            bounces: USUAL_BOUNCES,
            light_turn: 0.0,
            light_upright: false,
            smoothing: Smoothing::None,
            hides_panels: false,
            shows_tiers: false,
            shows_audit: false,
            shows_map: false,
            cutting: CuttingProgress::default(),
            panels: Panels::default(),
            liquid: Liquid::default(),
        }
    }
}

impl Workspace {
    /// Returns whether scopes include glare.
    pub fn glare(&self) -> Glare {
        if self.glare { Glare::Included } else { Glare::LeftOut }
    }

    /// Returns the backplate behind stones in renders; `None` for none, and where its file no longer exists.
    pub fn background(&self) -> Option<BackgroundRef> {
        BackgroundRef::read(self.behind.as_deref()?, Path::new("")).ok()
    }

    /// Returns the name of a background that cannot be shown, because its file is gone or no background has that name.
    pub fn missing_background(&self) -> Option<&str> {
        self.behind.as_deref().filter(|_| self.background().is_none())
    }

    /// Chooses the next world or pattern as the background of renders, in the order of their names; after the last
    /// one, none.
    pub fn next_behind(&mut self) {
        let place = |now: &str| BackgroundRef::names().position(|name| name == now);
        let next = self.behind.as_deref().and_then(place).map_or(0, |now| now + 1);
        self.behind = BackgroundRef::names().nth(next).map(str::to_owned);
    }

    /// Chooses the backplate and the number of bands of wavelengths of a scene, and remembers the former ones.
    pub fn enter_scene(&mut self, behind: Option<String>, wavelengths: Option<u32>) {
        let before = (self.behind.take(), self.wavelengths);
        (self.behind, self.wavelengths) = (behind, wavelengths.unwrap_or(self.wavelengths));
        self.of_scene = Some(OfScene {
            set: (self.behind.clone(), self.wavelengths),
            before,
            sight: None,
            light: None,
            alone: None,
        });
    }

    /// Shows renders as a scene states it, face up and whole: in perspective from a distance in girdle radii, or
    /// along parallel rays; neither edges nor motion are smoothed.
    pub fn see_under(&mut self, distance: Option<f64>) {
        let before = self.sight();
        self.eye = Eye::default();
        for pane in self.panes.iter_mut().filter(|pane| pane.shows == Shows::Render) {
            (pane.own, pane.is_near) = (None, distance.is_some());
        }
        self.distance = distance.unwrap_or(self.distance);
        self.smoothing = Smoothing::None;
        let set = self.sight();
        if let Some(of_scene) = &mut self.of_scene {
            of_scene.sight = Some(SightOfScene { set, before });
        }
    }

    /// Returns the distance of the eye, which views are in perspective, and how moving edges are smoothed.
    fn sight(&self) -> (f64, [bool; 4], Smoothing) {
        (self.distance, self.panes.each_ref().map(|pane| pane.is_near), self.smoothing)
    }

    /// Shows a view of a render alone as long as the present scene is open.
    pub fn enlarge_render(&mut self) {
        let before = self.alone();
        let panes = &mut self.panes[..self.layout.panes()];
        let found = panes.iter().position(|pane| pane.shows == Shows::Render);
        if found.is_none() {
            panes[0].shows = Shows::Render;
        }
        self.large = (panes.len() > 1).then_some(found.unwrap_or(0));
        let set = self.alone();
        if let Some(of_scene) = &mut self.of_scene {
            of_scene.alone = Some([set, before]);
        }
    }

    /// Returns the view that is shown alone, and what the first view shows.
    fn alone(&self) -> (Option<usize>, Shows) {
        (self.large, self.panes[0].shows)
    }

    /// Remembers the light and the exposure that a scene has set, and the former ones.
    pub fn light_scene(&mut self, set: (String, f64), before: (String, f64)) {
        if let Some(of_scene) = &mut self.of_scene {
            of_scene.light = Some([set, before]);
        }
    }

    /// Forgets the light and the exposure from before a scene.
    pub fn forget_light(&mut self) {
        if let Some(of_scene) = &mut self.of_scene {
            of_scene.light = None;
        }
    }

    /// Returns the light and the exposure with which another design begins: those from before the scene where the
    /// present ones are the scene's, else the present ones.
    pub fn light_after_scene(&self, present: (String, f64)) -> (String, f64) {
        match self.of_scene.as_ref().and_then(|of_scene| of_scene.light.as_ref()) {
            Some([set, before]) if *set == present => before.clone(),
            _ => present,
        }
    }

    /// Resets the settings that go with one stone: the backplate's distance in mm, the settings of its scene (also
    /// its perspective, the view that it shows alone, and the turn and axis of its light), and a strength below 1.
    pub fn rest(&mut self) {
        if let Some(OfScene { set, before, sight, alone, .. }) = self.of_scene.take() {
            if let Some([_, before]) = alone.filter(|[set, _]| *set == self.alone()) {
                (self.large, self.panes[0].shows) = before;
            }
            // Settings that the user has changed since then are no longer the scene's, and stay.
            if let Some(SightOfScene { before: (distance, is_near, smoothing), .. }) =
                sight.filter(|sight| sight.set == self.sight())
            {
                (self.distance, self.smoothing) = (distance, smoothing);
                self.panes.iter_mut().zip(is_near).for_each(|(pane, is_near)| pane.is_near = is_near);
            }
            if self.behind == set.0 {
                self.behind = before.0;
            }
            if self.wavelengths == set.1 {
                self.wavelengths = before.1;
            }
        }
        (self.behind_mm, self.strength) = (None, 1.0);
        (self.light_turn, self.light_upright, self.bounces) = (0.0, false, USUAL_BOUNCES);
    }

    /// Returns the part of the turn by refraction that light follows, 0 to 1; without a backplate, all of it.
    pub fn strength(&self) -> f64 {
        if self.background().is_some() { self.strength.clamp(0.0, 1.0) } else { 1.0 }
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
        if let Some(sight) = self.of_scene.as_mut().and_then(|of_scene| of_scene.sight.as_mut()) {
            sight.set.0 *= factor;
        }
        let own = self.panes.iter_mut().filter_map(|pane| pane.own.as_mut());
        own.chain([&mut self.eye]).for_each(|eye| eye.centre *= factor);
    }

    /// Returns the view of the stone in a pane: from the side that its picture is made for, if any.
    pub fn view(&self, pane: usize) -> View {
        let Pane { shows, is_near, .. } = self.panes[pane];
        let view = self.eye(pane).view(shows.side());
        match is_near && shows.is_seen() {
            true => View { projection: Projection::Perspective { distance: self.distance }, ..view },
            false => view,
        }
    }

    /// Changes what a pane shows.
    ///
    /// A scope uses parallel rays until the user asks for perspective.
    pub fn show(&mut self, pane: usize, shows: Shows) {
        let now = &mut self.panes[pane];
        now.is_near &= now.shows == shows || shows.scoped().is_none();
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

    /// Looks at the table, in all views.
    pub fn face_up(&mut self) {
        self.eye.top();
        self.panes.iter_mut().filter_map(|p| p.own.as_mut()).for_each(Eye::top);
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
        workspace.eye.spin(crate::scene::Side::Table, 0.5);
        workspace.remember(Path::new("/a/b.toml"));
        let text = serde_json::to_string(&workspace).unwrap();
        assert_eq!(serde_json::from_str::<Workspace>(&text).unwrap(), workspace);
        assert_eq!(serde_json::from_str::<Workspace>("{}").unwrap(), Workspace::default());
    }

    #[test]
    fn what_a_scene_hangs_and_sets_goes_with_it_but_not_what_was_chosen_since() {
        let own = Workspace { behind: Some("grid".to_owned()), wavelengths: 64, ..Workspace::default() };
        let mut workspace = own.clone();
        workspace.enter_scene(Some("page".to_owned()), Some(8));
        (workspace.strength, workspace.behind_mm) = (0.1, Some(3.0));
        assert_eq!((workspace.behind.as_deref(), workspace.wavelengths), (Some("page"), 8));
        let mut chosen = Workspace { behind: Some("dots".to_owned()), ..workspace.clone() };
        workspace.rest();
        assert_eq!(workspace, own);
        chosen.rest();
        assert_eq!(chosen, Workspace { behind: Some("dots".to_owned()), ..own });
    }

    #[test]
    fn a_render_is_shown_alone_wherever_it_is_and_where_there_is_none() {
        let mut workspace = Workspace { layout: PaneLayout::Two, ..Workspace::default() };
        workspace.panes[..2].iter_mut().for_each(|pane| pane.shows = Shows::Aset);
        workspace.panes[3].shows = Shows::Render;
        workspace.enlarge_render();
        assert_eq!((workspace.shown(), workspace.panes[0].shows), (vec![0], Shows::Render));
        workspace.layout = PaneLayout::Four;
        workspace.panes[0].shows = Shows::Aset;
        workspace.enlarge_render();
        assert_eq!((workspace.shown(), workspace.panes[0].shows), (vec![3], Shows::Aset));
    }

    #[test]
    fn recent_files_are_few_and_each_stands_once() {
        let mut workspace = Workspace::default();
        (0..30).for_each(|k| workspace.remember(Path::new(&format!("/{}.toml", k % 20))));
        assert_eq!(workspace.recent.len(), MOST_RECENT);
        assert_eq!(workspace.recent[0], Path::new("/9.toml"));
    }

    #[test]
    fn backgrounds_come_one_after_the_other_and_around() {
        let mut workspace = Workspace { behind: Some("/a/photo.png".to_owned()), ..Workspace::default() };
        let mut seen = vec![];
        for _ in 0..BackgroundRef::names().count() + 1 {
            workspace.next_behind();
            seen.push(workspace.behind.clone());
        }
        assert_eq!(seen.iter().flatten().count(), BackgroundRef::names().count());
        assert_eq!((seen[0].as_deref(), seen.last()), (Some("sunset"), Some(&None)));
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
