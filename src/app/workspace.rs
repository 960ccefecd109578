//! How a person has arranged the window: kept from one start to the next.

use super::eye::Eye;
use super::liquid::Liquid;
use super::shows::Shows;
use super::studio::Smoothing;
use crate::io::background::BackgroundRef;
use crate::picture::{Overlay, Pattern};
use crate::scene::{Glare, Projection, View};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// How many views there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum PaneLayout {
    /// One.
    One,
    /// Two side by side.
    Two,
    /// Four.
    #[default]
    Four,
}

impl PaneLayout {
    /// How many panes it has.
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

/// Which panels are open. The others are folded to strips, which open them again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Panels {
    /// Whether the design is, in a window that has room for both.
    pub design: bool,
    /// Whether the figures are, in a window that has room for both.
    pub figures: bool,
    /// The one that is in a window that has room for one.
    pub narrow: Option<PanelSide>,
}

impl Default for Panels {
    fn default() -> Self {
        Self { design: true, figures: true, narrow: Some(PanelSide::Design) }
    }
}

impl Panels {
    /// Whether a panel is open.
    pub fn is_open(&self, side: PanelSide, has_room_for_both: bool) -> bool {
        match (has_room_for_both, side) {
            (false, _) => self.narrow == Some(side),
            (true, PanelSide::Design) => self.design,
            (true, PanelSide::Figures) => self.figures,
        }
    }

    /// Opens a panel, or folds it.
    pub fn set(&mut self, side: PanelSide, has_room_for_both: bool, is_open: bool) {
        match (has_room_for_both, side) {
            (false, _) => self.narrow = is_open.then_some(side),
            (true, PanelSide::Design) => self.design = is_open,
            (true, PanelSide::Figures) => self.figures = is_open,
        }
    }
}

/// One view.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pane {
    /// What it shows.
    pub shows: Shows,
    /// Its own eye; none where it looks as the others do.
    pub own: Option<Eye>,
    /// Whether it shows the stone in perspective, from nearby; else along parallel rays.
    #[serde(default)]
    pub is_near: bool,
}

/// Distance of the eye that perspective begins with, girdle radii: a stone of 6.5 mm at 10 cm.
const DISTANCE: f64 = 30.0;

/// The most files remembered.
const MOST_RECENT: usize = 10;

/// All of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Workspace {
    /// How many views.
    pub layout: PaneLayout,
    /// The views; a layout of fewer shows the first of them.
    pub panes: [Pane; 4],
    /// One of them, shown alone for a while.
    pub large: Option<usize>,
    /// The eye of all linked views.
    pub eye: Eye,
    /// How far from the stone's origin the eye is in views in perspective, girdle radii.
    pub distance: f64,
    /// Half angle of the observer's head in ASET and figures, degrees.
    pub head: f64,
    /// Whether scopes show strongest exits alone.
    pub strongest: bool,
    /// Whether scopes and the zones of figures hold the glare of the stone's outer surface.
    pub glare: bool,
    /// What is drawn over pictures, by its name.
    pub overlay: Option<String>,
    /// Whether figures are those of strongest exits' areas, not of energy.
    pub by_area: bool,
    /// Whether both designs are seen side by side.
    pub is_split: bool,
    /// Files, the last one first.
    pub recent: Vec<PathBuf>,
    /// The file that was open.
    pub last: Option<PathBuf>,
    /// The light that was chosen.
    pub light: String,
    /// Stops.
    pub exposure: f64,
    /// Bands of wavelengths of renders.
    pub wavelengths: u32,
    /// What hangs behind stones in renders: the name of a pattern, or a photograph's file.
    pub behind: Option<String>,
    /// What a scene has hung there and set; with another stone it is again as it was.
    pub of_scene: Option<OfScene>,
    /// How far behind the middle that hangs, mm; none for a distance that goes with the stone.
    pub behind_mm: Option<f64>,
    /// How much of the way that refraction turns light is followed before it: 1 is physics.
    pub strength: f64,
    /// How edges of renders are evened out.
    pub smoothing: Smoothing,
    /// Whether views have the window to themselves.
    pub hides_panels: bool,
    /// Which panels are open else.
    pub panels: Panels,
    /// The pane of liquid glass.
    pub liquid: Liquid,
}

/// What hangs behind and how many wavelengths there are: as a scene has set it, and before that.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct OfScene {
    set: (Option<String>, u32),
    before: (Option<String>, u32),
}

/// Bands of wavelengths that are offered; of three each shows.
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
            light: super::document::FIRST_LIGHT.to_owned(),
            exposure: 0.0,
            wavelengths: WAVELENGTHS[2],
            behind: None,
            of_scene: None,
            behind_mm: None,
            strength: 1.0,
            smoothing: Smoothing::None,
            hides_panels: false,
            panels: Panels::default(),
            liquid: Liquid::default(),
        }
    }
}

impl Workspace {
    /// Whether scopes hold glare.
    pub fn glare(&self) -> Glare {
        if self.glare { Glare::Included } else { Glare::LeftOut }
    }

    /// What hangs behind stones in renders; a file that has gone is none.
    pub fn background(&self) -> Option<BackgroundRef> {
        BackgroundRef::read(self.behind.as_deref()?, Path::new("")).ok()
    }

    /// Hangs the pattern behind that comes next in their order, after the last of them nothing.
    pub fn next_behind(&mut self) {
        let next = match self
            .behind
            .as_deref()
            .map(|now| Pattern::NAMES.iter().position(|(name, _)| *name == now))
        {
            Some(Some(now)) => now + 1,
            Some(None) | None => 0,
        };
        self.behind = Pattern::NAMES.get(next).map(|(name, _)| (*name).to_owned());
    }

    /// Hangs what a scene wants behind it, seen in so many wavelengths.
    pub fn enter_scene(&mut self, behind: Option<String>, wavelengths: Option<u32>) {
        let before = (self.behind.take(), self.wavelengths);
        (self.behind, self.wavelengths) = (behind, wavelengths.unwrap_or(self.wavelengths));
        self.of_scene = Some(OfScene { set: (self.behind.clone(), self.wavelengths), before });
    }

    /// Shows a render alone.
    pub fn enlarge_render(&mut self) {
        let panes = &mut self.panes[..self.layout.panes()];
        let found = panes.iter().position(|pane| pane.shows == Shows::Render);
        if found.is_none() {
            panes[0].shows = Shows::Render;
        }
        self.large = (panes.len() > 1).then_some(found.unwrap_or(0));
    }

    /// Forgets what goes with one stone: distances with its size, what its scene hung behind it, mixtures.
    pub fn rest(&mut self) {
        if let Some(OfScene { set, before }) = self.of_scene.take() {
            if self.behind == set.0 {
                self.behind = before.0;
            }
            if self.wavelengths == set.1 {
                self.wavelengths = before.1;
            }
        }
        (self.behind_mm, self.strength) = (None, 1.0);
    }

    /// How much of the way that refraction turns light is followed; without a picture behind all of it.
    pub fn strength(&self) -> f64 {
        if self.background().is_some() { self.strength.clamp(0.0, 1.0) } else { 1.0 }
    }

    /// The panes in sight, by their places.
    pub fn shown(&self) -> Vec<usize> {
        match self.large.filter(|&k| k < self.layout.panes()) {
            Some(large) => vec![large],
            None => (0..self.layout.panes()).collect(),
        }
    }

    /// The eye of a pane.
    pub fn eye(&self, pane: usize) -> &Eye {
        self.panes[pane].own.as_ref().unwrap_or(&self.eye)
    }

    /// How a pane looks at the stone: from the side that its picture is made for.
    pub fn view(&self, pane: usize) -> View {
        let Pane { shows, is_near, .. } = self.panes[pane];
        let view = self.eye(pane).view(shows.side());
        match is_near && shows.is_seen() {
            true => View { projection: Projection::Perspective { distance: self.distance }, ..view },
            false => view,
        }
    }

    /// Shows something else in a pane. A scope is seen along parallel rays until perspective is asked for.
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

    /// Shows the views that there were at the very first, and the panels; every view looks from where it did.
    pub fn reset_layout(&mut self) {
        let Self { layout, panes, large, is_split, hides_panels, panels, .. } = Self::default();
        (0..panes.len()).for_each(|pane| self.show(pane, panes[pane].shows));
        (self.layout, self.large) = (layout, large);
        (self.is_split, self.hides_panels, self.panels) = (is_split, hides_panels, panels);
    }

    /// The same, to be moved.
    pub fn eye_mut(&mut self, pane: usize) -> &mut Eye {
        self.panes[pane].own.as_mut().unwrap_or(&mut self.eye)
    }

    /// Looks at the table, in all views.
    pub fn face_up(&mut self) {
        self.eye.top();
        self.panes.iter_mut().filter_map(|p| p.own.as_mut()).for_each(Eye::top);
    }

    /// What is drawn over pictures.
    pub fn overlay(&self) -> Option<Overlay> {
        self.overlay.as_deref().and_then(|name| name.parse().ok())
    }

    /// Draws something over pictures, or no longer.
    pub fn toggle_overlay(&mut self, name: &str) {
        let same = self.overlay.as_deref() == Some(name);
        self.overlay = (!same).then(|| name.to_owned());
    }

    /// Remembers a file.
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
        let mut desk = Workspace { layout: PaneLayout::Two, ..Workspace::default() };
        desk.eye.spin(crate::scene::Side::Table, 0.5);
        desk.remember(Path::new("/a/b.toml"));
        let text = serde_json::to_string(&desk).unwrap();
        assert_eq!(serde_json::from_str::<Workspace>(&text).unwrap(), desk);
        assert_eq!(serde_json::from_str::<Workspace>("{}").unwrap(), Workspace::default());
    }

    #[test]
    fn what_a_scene_hangs_and_sets_goes_with_it_but_not_what_was_chosen_since() {
        let own = Workspace { behind: Some("grid".to_owned()), wavelengths: 64, ..Workspace::default() };
        let mut desk = own.clone();
        desk.enter_scene(Some("page".to_owned()), Some(8));
        (desk.strength, desk.behind_mm) = (0.1, Some(3.0));
        assert_eq!((desk.behind.as_deref(), desk.wavelengths), (Some("page"), 8));
        let mut chosen = Workspace { behind: Some("dots".to_owned()), ..desk.clone() };
        desk.rest();
        assert_eq!(desk, own);
        chosen.rest();
        assert_eq!(chosen, Workspace { behind: Some("dots".to_owned()), ..own });
    }

    #[test]
    fn a_render_is_shown_alone_wherever_it_is_and_where_there_is_none() {
        let mut desk = Workspace { layout: PaneLayout::Two, ..Workspace::default() };
        desk.panes[..2].iter_mut().for_each(|pane| pane.shows = Shows::Aset);
        desk.panes[3].shows = Shows::Render;
        desk.enlarge_render();
        assert_eq!((desk.shown(), desk.panes[0].shows), (vec![0], Shows::Render));
        desk.layout = PaneLayout::Four;
        desk.panes[0].shows = Shows::Aset;
        desk.enlarge_render();
        assert_eq!((desk.shown(), desk.panes[0].shows), (vec![3], Shows::Aset));
    }

    #[test]
    fn recent_files_are_few_and_each_stands_once() {
        let mut desk = Workspace::default();
        (0..30).for_each(|k| desk.remember(Path::new(&format!("/{}.toml", k % 20))));
        assert_eq!(desk.recent.len(), MOST_RECENT);
        assert_eq!(desk.recent[0], Path::new("/9.toml"));
    }

    #[test]
    fn backgrounds_come_one_after_the_other_and_around() {
        let mut desk = Workspace { behind: Some("/a/photo.png".to_owned()), ..Workspace::default() };
        let mut seen = vec![];
        for _ in 0..Pattern::NAMES.len() + 1 {
            desk.next_behind();
            seen.push(desk.behind.clone());
        }
        assert_eq!(seen.iter().flatten().count(), Pattern::NAMES.len());
        assert_eq!((seen[0].as_deref(), seen.last()), (Some("page"), Some(&None)));
    }

    #[test]
    fn every_overlay_is_toggled() {
        let mut desk = Workspace::default();
        for name in Overlay::names() {
            desk.toggle_overlay(name);
            assert!(desk.overlay().is_some(), "{name}");
            desk.toggle_overlay(name);
            assert_eq!(desk.overlay(), None);
        }
    }
}
