//! Makes the plan of an export from the open document and its views.

use super::Model;
use super::export::{ExportPlan, PictureAspect};
use super::motion::WaveCache;
use super::ordering::Orders;
use crate::shows::Shows;
use crate::studio::{Paper, Shot};
use brillianteer_scene::View;
use std::path::PathBuf;

/// Plans an export of the open document, seen by the eye of the linked views.
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
        file if file.is_file() => std::path::absolute(&file).unwrap_or(file).to_string_lossy().into_owned(),
        _ => session.light.name.clone(),
    };
    let room = model.room();
    let selection = session.selection.clone();
    let (folder, stem) = (document.folder().join("out"), document.stem());
    let sheet_files = vec![];
    let movement = document.work.copies.movement;
    let mut plan = ExportPlan {
        shot,
        upright,
        linked,
        own,
        room,
        selection,
        movement,
        light,
        folder,
        sheet_files,
        stem,
    };
    let can_be_shown: Vec<Shows> = plan.can_be_shown().collect();
    plan.selection.views.retain(|shows| can_be_shown.contains(shows));
    plan.list_sheet();
    plan
}

/// Returns the aspect of the linked views, and that of each view that is not linked.
///
/// Of several views that show the same, the active one counts, or else the first.
fn aspects(model: &Model) -> (PictureAspect, Vec<(Shows, PictureAspect)>) {
    let workspace = &model.workspace;
    let linked = PictureAspect { view: workspace.eye.view(None), turn: workspace.eye.turn };
    let mut panes = workspace.shown();
    panes.sort_by_key(|&pane| (pane != model.active(), pane));
    let mut own: Vec<(Shows, PictureAspect)> = vec![];
    for pane in panes {
        let shows = workspace.panes[pane].shows;
        if shows.is_seen() && own.iter().all(|(other, _)| *other != shows) {
            own.push((shows, PictureAspect { view: model.view(pane), turn: workspace.eye(pane).turn }));
        }
    }
    let side = |shows: Shows| shows.side().unwrap_or(linked.view.side);
    own.retain(|(shows, aspect)| aspect.view != View { side: side(*shows), ..linked.view });
    (linked, own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::action::FileAction;
    use crate::model::dialog::Then;
    use crate::model::framing_fit::FramingFit;
    use crate::model::motion::Motion;
    use crate::model::update;
    use crate::model::workspace::Workspace;
    use brillianteer_paper::export::OutputFormat;
    use brillianteer_scene::{Copies, Side};

    #[test]
    fn a_plate_alone_is_exported_in_the_phase_and_the_frame_in_which_it_is_shown() {
        let mut model = Model::new(Workspace::default()).unwrap();
        update(&mut model, FileAction::Ask(Then::Library("plate".to_owned())).into());
        model.document.work.copies = Copies::default();
        model.workspace.begin_views();
        let at_rest = export_plan(&model).shot(Shows::Render, 64);
        model.session.motion = Motion::at(0.7);
        let plan = export_plan(&model);
        let waved = plan.shot(Shows::Render, 64);
        assert_eq!(waved.specimen.design.cut, plan.shot.specimen.design.cut, "as in the scene file");
        assert_ne!(waved.specimen.design.cut, at_rest.specimen.design.cut);
        assert_eq!(waved.film, FramingFit::reaching(model.reach(Shows::Render)).film([64; 2]));
        let scope = plan.shot(Shows::Aset, 64);
        assert_eq!(scope.specimen.design.cut, at_rest.specimen.design.cut, "scopes show it at rest");
    }

    #[test]
    fn figures_are_exported_of_the_side_that_the_panel_shows() {
        let mut model = Model::new(Workspace::default()).unwrap();
        model.workspace.eye.bottom();
        model.session.selection.formats = vec![OutputFormat::Json];
        let plan = export_plan(&model);
        let parts = plan.parts();
        let figures = parts.iter().filter(|(outputs, _)| outputs.formats.contains(&OutputFormat::Json));
        assert_eq!(figures.map(|(_, viewing)| viewing.viewpoint.side).collect::<Vec<_>>(), [Side::Table]);
        assert_eq!(parts[0].1.viewpoint.side, Side::Culet, "pictures are of the side that is seen");
    }
}
