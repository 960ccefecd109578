//! The plan of an export: what the open document's pictures show, as the views see it.

use super::Model;
use super::export::{ExportPlan, PictureAspect};
use super::motion::WaveCache;
use super::ordering::Orders;
use crate::app::shows::Shows;
use crate::app::studio::{Paper, Shot};
use crate::scene::{Copies, Pose, View};
use std::path::PathBuf;

/// Plans an export of the open document, seen as the linked views see it.
pub fn export_plan(model: &Model) -> ExportPlan {
    let Model { document, session, .. } = model;
    let upright = document.named(document.specimen());
    let (linked, own) = aspects(model);
    let render = own.iter().find(|(shows, _)| *shows == Shows::Render).map_or(&linked, |(_, aspect)| aspect);
    let mut waves = WaveCache::default();
    let shot = Orders { model, waves: &mut waves, paper: Paper::default() }.render(render.view);
    let specimen = document.named(&shot.specimen);
    let shot = Shot { specimen, ..shot };
    let light = match PathBuf::from(&session.light.name) {
        file if file.is_file() => std::path::absolute(&file).unwrap_or(file),
        name => name,
    };
    // Renders are as large as in their view, or smaller, so that no copy is left out.
    let turned = Pose::turned(shot.view.turn);
    let poses = shot.copies.iter().map(|pose| turned.after(pose)).collect();
    let copies = Copies::at(poses, shot.specimen.solid().vertices());
    let reach = model.reach(Shows::Render).max(copies.reach(0.0));
    let selection = session.selection.clone();
    let (folder, stem) = (document.folder().join("out"), document.stem());
    let mut plan = ExportPlan { shot, upright, linked, own, reach, selection, light, folder, stem };
    let can_be_shown: Vec<Shows> = plan.can_be_shown().collect();
    plan.selection.views.retain(|shows| can_be_shown.contains(shows));
    plan
}

/// Returns how the linked views see a stone, and how each view that is not linked sees it.
///
/// Of several views that show the same, the one that keys act on counts, or else the first.
fn aspects(model: &Model) -> (PictureAspect, Vec<(Shows, PictureAspect)>) {
    let workspace = &model.workspace;
    let linked = PictureAspect { view: workspace.eye.view(None), turn: workspace.eye.turn };
    let mut panes = workspace.shown();
    panes.sort_by_key(|&pane| (pane != model.active(), pane));
    let mut own: Vec<(Shows, PictureAspect)> = vec![];
    for pane in panes {
        let shows = workspace.panes[pane].shows;
        if shows.is_seen() && own.iter().all(|(other, _)| *other != shows) {
            own.push((shows, PictureAspect { view: workspace.view(pane), turn: workspace.eye(pane).turn }));
        }
    }
    let side = |shows: Shows| shows.side().unwrap_or(linked.view.side);
    own.retain(|(shows, aspect)| aspect.view != View { side: side(*shows), ..linked.view });
    (linked, own)
}
