//! The state of the editor without a window, the actions that change it, and the tasks to be carried out outside of
//! it.
//!
//! Only [`update()`] changes a [`Model`]. A client, such as the window, draws the model, turns the user's input into
//! [`Action`]s, and carries out the resulting [`Task`]s, whose answers are actions again.

pub mod action;
pub mod audit;
pub mod choosing;
pub mod command;
pub mod compare;
pub mod cut_search;
pub mod cutting;
pub mod dialog;
pub mod document;
pub mod document_origin;
pub mod export;
pub mod export_sheet;
pub mod exporting;
pub mod extent;
pub mod eye;
pub mod figures;
pub mod fitting;
pub mod framing;
pub mod framing_fit;
pub mod goal_form;
pub mod growing_sweep;
pub mod history;
pub mod impossible;
pub mod measure_map;
pub mod measure_tilt;
pub mod meet_pick;
pub mod motion;
pub mod notes;
pub mod opening;
pub mod ordering;
pub mod plan;
pub mod preset;
pub mod recovery;
pub mod render_settings;
pub mod saving;
pub mod scene_fit;
pub mod session;
pub mod task;
pub mod update;
pub mod view_history;
pub mod work;
pub mod workspace;

pub use action::Action;
pub use task::Task;
pub use update::update;

use crate::liquid::{LightMotion, Liquid};
use crate::shows::Shows;
use crate::studio::Which;
use action::Edit;
use brillianteer_base::Failure;
use brillianteer_cut::Cut;
use brillianteer_scene::{Companions, Copies, Look, Pose, Specimen, View};
use document::Document;
use framing_fit::FramingFit;
use glam::DVec3;
use motion::WaveCache;
use scene_fit::SceneRoom;
use session::Session;
use std::sync::Arc;
use work::Work;
use workspace::Workspace;

/// The whole state of an editor.
#[derive(Debug, Clone)]
pub struct Model {
    /// The design that is open, with its light and its steps.
    pub document: Document,
    /// The arrangement of the window, which is kept from one start to the next.
    pub workspace: Workspace,
    /// The part of the state that ends with the window.
    pub session: Session,
}

impl Model {
    /// Opens the first design in a workspace as it was kept, but without what was seen of the document that was open.
    ///
    /// # Errors
    /// Fails only where the program itself is broken: it comes with the cut and the light that it starts with.
    pub fn new(mut workspace: Workspace) -> Result<Self, Failure> {
        let document = Document::first()?;
        workspace.begin_views();
        let session = Session::new(&document, &workspace)?;
        Ok(Self { document, workspace, session })
    }

    /// Returns the view that keys act on: the one under the pointer or with the focus, or else the first.
    pub fn active(&self) -> usize {
        let shown = self.workspace.shown();
        if shown.contains(&self.session.hovered) { self.session.hovered } else { shown[0] }
    }

    /// Returns one of the two stones.
    pub fn stone(&self, which: Which) -> Option<Arc<Specimen>> {
        match which {
            Which::Present => Some(Arc::clone(self.document.specimen())),
            Which::Other => Some(Arc::clone(&self.session.compared.as_ref()?.specimen)),
        }
    }

    /// Returns the stone of renders in its present phase, and the poses of its copies in renders.
    pub fn copies(&self, which: Which, waves: &mut WaveCache) -> Option<(Arc<Specimen>, Vec<Pose>)> {
        let stone = self.stone(which)?;
        let Work { copies, companions, .. } = &self.document.work;
        match (self.is_alone(), companions.is_empty()) {
            (true, _) => Some((stone, vec![Pose::STILL])),
            (false, true) => Some(self.session.motion.now(waves, &stone, copies)),
            // Among companions each copy lies at its own pose, and at rest.
            (false, false) => {
                let in_render = self.in_render();
                Some((stone, copies.poses.iter().map(|pose| in_render.after(pose)).collect()))
            }
        }
    }

    /// Returns the pose that carries bodies from their places in the document to those in renders, in girdle radii of
    /// the design: a scene turns about its middle, and all else about the origin.
    pub fn in_render(&self) -> Pose {
        let middle = self.session.framing.scene().map_or(DVec3::ZERO, |scene| scene.ball.middle);
        Pose { at: -middle / self.document.specimen().unit_mm(), ..Pose::STILL }
    }

    /// Returns the companions of the copies in renders, in girdle radii of the design.
    pub fn companions(&self) -> Companions {
        let unit = Pose { scale: 1.0 / self.document.specimen().unit_mm(), ..Pose::STILL };
        self.document.work.companions.carried(&self.in_render().after(&unit))
    }

    /// Returns the view of a pane. An eye in perspective is outside the scene that it sees.
    pub fn view(&self, pane: usize) -> View {
        let view = self.workspace.view(pane);
        let has_copies = self.workspace.panes[pane].shows.has_copies();
        match self.session.framing.scene().filter(|_| has_copies) {
            Some(scene) => scene.seen_from_outside(view, self.document.specimen().unit_mm()),
            None => view,
        }
    }

    /// Returns why the scene's ring cannot be made as its numbers and stones are now; `None` where it can, or is being made.
    pub fn ring_fault(&self) -> Option<&str> {
        let (refused, why) = self.session.ring.refused.as_ref()?;
        let plan = self.document.ring_plan()?;
        (*refused == plan).then_some(why)
    }

    /// Returns whether renders show the stone alone and at rest.
    pub fn is_alone(&self) -> bool {
        let Work { copies, companions, .. } = &self.document.work;
        copies.is_one_at_rest() && companions.is_empty() && self.session.motion.seconds == 0.0
    }

    /// Returns whether the document is a scene: several bodies, or a shape of glass, which is nothing without what is around it.
    pub fn is_scene(&self) -> bool {
        let Work { design, copies, companions, .. } = &self.document.work;
        matches!(design.cut, Cut::Glass(_)) || *copies != Copies::default() || !companions.is_empty()
    }

    /// Returns the edit that changes what renders are made with.
    pub fn look_with(&self, change: impl FnOnce(&mut Look)) -> Edit {
        let mut look = self.document.work.settings.look.clone();
        change(&mut look);
        Edit::Look(Box::new(look))
    }

    /// Returns the pane of liquid glass under its present light.
    pub fn liquid(&self) -> Liquid {
        let own = self.document.work.settings.liquid;
        let moving = self.session.liquid_light.filter(|_| own.light_motion != LightMotion::Fixed);
        Liquid { light_from: moving.unwrap_or(own.light_from), ..own }
    }

    /// Returns whether time can go on in renders: copies tumble only where no companion is in their way.
    pub fn can_move(&self) -> bool {
        self.document.work.companions.is_empty()
    }

    /// Returns the fit of a view: to the stone that views are fitted to, to all copies, or to the whole scene.
    pub fn fit(&self, shows: Shows, view: &View) -> FramingFit {
        match self.room().filter(|_| shows.has_copies()) {
            Some(room) => room.fit(view),
            None => self.session.framing.fit(view),
        }
    }

    /// Returns the part of space that renders take in; `None` where they show the stone alone and at rest.
    pub fn room(&self) -> Option<SceneRoom> {
        let unit_mm = self.document.specimen().unit_mm();
        let ball = self.session.framing.scene().map(|scene| scene.ball.radius / unit_mm);
        let room = ball.map_or_else(
            || SceneRoom::Square { half: self.reach(Shows::Render) },
            |radius| SceneRoom::Ball { radius },
        );
        (!self.is_alone()).then_some(room)
    }

    /// Returns how far a view's picture, seen face up, reaches from its middle across or up, girdle radii.
    ///
    /// Both designs are shown on one scale, that of the present design.
    pub fn reach(&self, shows: Shows) -> f64 {
        let Specimen { reach, radius, .. } = **self.document.specimen();
        if !shows.has_copies() {
            return reach;
        }
        if let Some(scene) = self.session.framing.scene() {
            return scene.across_mm / self.document.specimen().unit_mm();
        }
        let copies = &self.document.work.copies;
        match self.session.motion.tumbles(self.document.specimen(), copies) {
            // A stone that tumbles shows all its sides.
            true => copies
                .poses
                .iter()
                .map(|p| p.at.truncate().abs().max_element() + radius)
                .fold(copies.reach(radius), f64::max),
            false => copies.reach(reach),
        }
    }

    /// Returns whether a view shows a picture that is looked up in a map or drawn, and not traced.
    pub fn is_looked_up(&self, pane: usize) -> bool {
        let shows = self.workspace.panes[pane].shows;
        shows == Shows::LiquidGlass || (shows == Shows::Refraction && !self.session.flowing[pane].is_map)
    }
}
