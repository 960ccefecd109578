//! Commands: when each is possible or switched on, and its effect.

use super::begin::compare_no_more;
use super::{begin, dialogs, edits, files, fitting, searching};
use crate::model::Model;
use crate::model::action::{DialogAction, Edit, FileAction};
use crate::model::choosing::Purpose;
use crate::model::command::Command;
use crate::model::compare::Compared;
use crate::model::dialog::{AboutForm, Dialog, Then};
use crate::model::eye::Eye;
use crate::model::meet_pick::MeetPick;
use crate::model::task::{Task, WindowTask};
use crate::model::work::Work;
use crate::model::workspace::PaneLayout;
use brillianteer_cut::Cut;
use brillianteer_picture::DrawnMarks;
use brillianteer_scene::{LIGHTS, scattered};

impl Model {
    /// Returns whether a command can be carried out now.
    pub fn is_possible(&self, command: Command) -> bool {
        let (undo, redo) = self.document.steps();
        let (back, on) = self.session.views.steps();
        match command {
            Command::ViewBack => back,
            Command::ViewOn => on,
            Command::Undo => undo || self.meet_pick().is_some(),
            Command::Redo => redo,
            Command::Save => self.document.is_changed() || self.document.path().is_none(),
            Command::IntoTiers => !self.has_tiers() && self.document.specimen().stone().is_ok(),
            Command::Retarget | Command::Yield => self.document.specimen().stone().is_ok(),
            Command::Tiers | Command::BenchMode => self.has_tiers(),
            Command::LayOut => self.document.work.copies.poses.len() > 1 && self.can_move(),
            Command::Play => self.can_move(),
            Command::PreviousTilt => self.workspace.eye(self.active()).last.is_some(),
            Command::Split | Command::NoCompare => self.session.compared.is_some(),
            _ => true,
        }
    }

    /// Returns whether the design is cut by tiers.
    pub fn has_tiers(&self) -> bool {
        matches!(self.document.work.design.cut, Cut::Tiers(_))
    }

    /// Returns whether bench mode, with one step of the cutting, is in sight in the place of the views.
    pub fn is_at_bench(&self) -> bool {
        self.workspace.cutting.is_open && self.has_tiers()
    }

    /// Returns whether the table of tiers is in sight.
    pub fn shows_tiers(&self) -> bool {
        self.workspace.shows_tiers && self.has_tiers() && !self.is_at_bench()
    }

    /// Returns the pick of a tier's meet in the views; `None` where there is none. The stone in sight must be the one that
    /// these tiers make, so that a corner on the screen belongs to them.
    pub fn meet_pick(&self) -> Option<&MeetPick> {
        let is_seen = self.shows_tiers() && !self.document.shows_last_possible();
        self.session.picking.as_ref().filter(|_| is_seen)
    }

    /// Returns the marks of the selected finding where the list of the audit is in sight, else no marks.
    pub fn found_marks(&self) -> DrawnMarks {
        let finding = self.session.audit.selected_finding().filter(|_| self.shows_audit());
        match (finding, self.document.specimen().stone()) {
            (Some(finding), Ok(stone)) => DrawnMarks::of(stone, [finding]),
            _ => DrawnMarks::default(),
        }
    }

    /// Returns whether the list of the audit is in sight.
    pub fn shows_audit(&self) -> bool {
        self.workspace.shows_audit && !self.is_at_bench()
    }

    /// Returns whether the map of a measure is in sight.
    pub fn shows_map(&self) -> bool {
        self.workspace.shows_map && !self.is_at_bench()
    }

    /// Returns whether the window of the search for a better cut is in sight.
    pub fn shows_search(&self) -> bool {
        self.session.search.is_open && !self.is_at_bench()
    }

    /// Returns whether menus show a command as switched on.
    pub fn is_chosen(&self, command: Command) -> bool {
        let workspace = &self.workspace;
        let overlay = |name| workspace.overlay.as_deref() == Some(name);
        match command {
            // A view that is shown alone is one view, whatever the layout to which it goes back.
            Command::One => workspace.shown().len() == 1,
            Command::Two => workspace.shown().len() == 2,
            Command::Four => workspace.shown().len() == 4,
            Command::Perspective => workspace.is_near(self.active()),
            Command::EyeLeans => workspace.eye(self.active()).eye_leans,
            Command::Wireframe => overlay("wireframe"),
            Command::Facets => overlay("facets"),
            Command::Bounces => overlay("bounces"),
            Command::Unresolved => overlay("unresolved"),
            Command::Total => overlay("total"),
            Command::Strongest => workspace.strongest,
            Command::Glare => workspace.glare,
            Command::Split => workspace.is_split,
            Command::LightPath => self.session.followed.is_open,
            Command::Play => self.session.motion.is_on,
            Command::Panels => workspace.hides_panels,
            Command::Tiers => workspace.shows_tiers,
            Command::BenchMode => workspace.cutting.is_open,
            Command::Audit => workspace.shows_audit,
            Command::Map => workspace.shows_map,
            Command::Search => self.session.search.is_open,
            _ => false,
        }
    }
}

/// Carries out a command, if it is possible.
pub fn run(model: &mut Model, tasks: &mut Vec<Task>, command: Command) {
    if !model.is_possible(command) {
        return;
    }
    model.session.views.settle();
    match command {
        Command::Open => files::choose(model, tasks, Purpose::Open),
        Command::Save => files::save(model, tasks),
        Command::SaveAs => files::choose(model, tasks, Purpose::SaveAs),
        Command::CompareFile => files::choose(model, tasks, Purpose::Compare),
        Command::Quit => files::change(model, tasks, FileAction::Ask(Then::Close)),
        Command::Export => dialogs::answer(model, tasks, DialogAction::Export(None)),
        Command::CopyPicture => tasks.push(Task::Window(WindowTask::CopyShown(model.active()))),
        Command::FullScreen => tasks.push(Task::Window(WindowTask::FullScreen)),
        Command::ResetLayout => {
            model.workspace.reset_layout();
            tasks.push(Task::Window(WindowTask::ForgetPanelWidths));
        }
        Command::IntoTiers => {
            edits::edit(model, Edit::IntoTiers);
            model.workspace.shows_tiers = true;
        }
        Command::Retarget => fitting::open_retarget(model, tasks),
        Command::Yield => fitting::open_yield(model),
        Command::AnotherLight => another_light(model),
        Command::ResetLight => edits::edit(model, Edit::ResetLight),
        Command::LayOut => edits::edit(model, Edit::LayOut(model.document.work.copies.poses.len())),
        Command::Search => searching::toggle(model, tasks),
        Command::Undo if model.meet_pick().is_some() => {
            // The design has not changed since the pick began.
            model.session.picking = model.session.picking.as_ref().and_then(MeetPick::undone);
        }
        Command::Undo | Command::Redo => {
            searching::interrupt(model, tasks);
            let Work { companions: beside, origin, .. } = model.document.work.clone();
            if command == Command::Undo {
                model.document.undo()
            } else {
                model.document.redo()
            }
            model.document.update();
            edits::note_meet_faults(model);
            // The step may have reordered the tiers.
            model.session.picking = None;
            if !model.document.is_of_this_scene(origin) {
                begin::come_back(model, tasks, origin);
                edits::note_meet_faults(model);
            } else if model.document.work.origin != origin || model.document.work.companions != beside {
                if model.document.work.origin != origin {
                    // Both refer to the stone that was edited.
                    (model.session.held, model.session.tier) = (None, None);
                }
                model.session.framing.follow(&model.document);
            }
        }
        other => look(model, other),
    }
}

/// Lights renders by another light of the program, chosen at random and turned at random. The light is a step of
/// undo.
fn another_light(model: &mut Model) {
    model.session.lights_drawn += 1;
    let [place, turn] = [0, 1].map(|k| scattered(2 * model.session.lights_drawn + k));
    let mut look = model.document.work.settings.look.clone();
    let others: Vec<&str> = LIGHTS.into_iter().filter(|name| *name != look.light).collect();
    others[(place * others.len() as f64) as usize % others.len()].clone_into(&mut look.light);
    look.light_turn = (360.0 * turn - 180.0).round();
    edits::edit(model, Edit::Look(Box::new(look)));
}

/// Carries out a command that changes only the views.
fn look(model: &mut Model, command: Command) {
    let active = model.active();
    let Model { document, workspace, session } = model;
    match command {
        Command::ViewBack => session.views.back(workspace),
        Command::ViewOn => session.views.on(workspace),
        Command::Top => seen(model, Eye::top),
        Command::Side => seen(model, Eye::side),
        Command::Bottom => seen(model, Eye::bottom),
        Command::PreviousTilt => seen(model, Eye::back),
        Command::Fit => seen(model, Eye::fit),
        Command::Perspective => {
            let pane = &mut workspace.panes[active];
            pane.is_near = pane.shows.takes_perspective() && !pane.is_near;
        }
        Command::EyeLeans => {
            let eye = workspace.eye_mut(active);
            eye.eye_leans = !eye.eye_leans;
        }
        Command::One => (workspace.layout, workspace.large) = (PaneLayout::One, None),
        Command::Two => (workspace.layout, workspace.large) = (PaneLayout::Two, None),
        Command::Four => (workspace.layout, workspace.large) = (PaneLayout::Four, None),
        Command::Wireframe => workspace.toggle_overlay("wireframe"),
        Command::Facets => workspace.toggle_overlay("facets"),
        Command::Bounces => workspace.toggle_overlay("bounces"),
        Command::Unresolved => workspace.toggle_overlay("unresolved"),
        Command::Total => workspace.toggle_overlay("total"),
        Command::Strongest => workspace.strongest = !workspace.strongest,
        Command::Glare => workspace.glare = !workspace.glare,
        Command::CompareSaved => match Compared::of_saved(document) {
            Ok(compared) => session.compared = Some(compared),
            Err(why) => session.notes.trouble(why),
        },
        Command::Split => workspace.is_split = !workspace.is_split,
        Command::NoCompare => compare_no_more(model),
        Command::Play => session.motion.is_on = !session.motion.is_on,
        Command::NextBehind => document.work.settings.look.next_background(),
        Command::Panels => workspace.hides_panels = !workspace.hides_panels,
        Command::BenchMode => workspace.cutting.is_open = !workspace.cutting.is_open,
        Command::Audit => workspace.shows_audit = !workspace.shows_audit,
        Command::Map => workspace.shows_map = !workspace.shows_map,
        Command::Tiers => workspace.shows_tiers = !workspace.shows_tiers,
        Command::ResetView => {
            workspace.reset_view();
            session.framing.renew(document);
        }
        Command::LightPath => session.followed.is_open = !session.followed.is_open,
        Command::New => session.dialog = Some(Dialog::Cuts),
        Command::Keys => session.dialog = Some(Dialog::Keys),
        Command::About => session.dialog = Some(Dialog::About(AboutForm::default())),
        _ => {}
    }
}

/// Fits the views to the present stone and moves the eye of the active view by `look`.
fn seen(model: &mut Model, look: impl FnOnce(&mut Eye)) {
    model.session.framing.renew(&model.document);
    let active = model.active();
    look(model.workspace.eye_mut(active));
}
