//! Tests of scenes of several designs and metal, worked on as a person does.

use super::copies::{at, bench, drag};
use super::{Bench, Setup};
use brillianteer_scene::MetalInstance;
use brillianteer_session::model::{
    Model,
    action::{Edit, FileAction},
    command::Command,
    dialog::Then,
    plan::export_plan,
    preset::Preset,
    recovery::KeptCompanions,
    update,
    work::Work,
    workspace::Workspace,
};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::Which;
use brillianteer_session::tasks::export_scene::SceneOut;
use egui::Key;
use egui_kittest::kittest::Queryable;
use glam::DVec3;

/// A row of three cubes of 12 mm and a pill of 20 mm.
const ROW: &str = "format = 1\nname = \"Mine\"\nlayout = \"row\"\n[[stone]]\ncut = \"cube\"\nsize = \"12mm\"\ncount = 3\n\
    [[stone]]\ncut = \"pill\"\nsize = \"20mm\"\n";

fn work(bench: &Bench) -> &Work {
    &bench.editor().model.document.work
}

/// Returns a model that has begun a scene of the program.
fn begun(scene: &str) -> Model {
    let mut model = Model::new(Workspace::default()).unwrap();
    update(&mut model, FileAction::Ask(Then::Preset(scene.to_owned())).into());
    model
}

/// Returns a point of each stone, in mm, with the name and the material of its design, and each corner of metal.
fn places(work: &Work, unit_mm: f64) -> Vec<(String, DVec3)> {
    let point = DVec3::new(0.4, -0.2, 0.1);
    let of = |design: &brillianteer_cut::Design| {
        format!("{} {:?} {:.6}", design.name, design.material, design.diameter_mm)
    };
    let own = work.copies.poses.iter().map(|pose| (of(&work.design), pose.place(point) * unit_mm));
    let beside = work.companions.stones.iter().map(|s| (of(&s.specimen.design), s.pose.place(point)));
    // A file may list the points in another order, but the triangles stay as they are.
    let metals = work.companions.metals.iter().flat_map(|metal| {
        let surface = metal.mesh.surface();
        let corners = surface.corners.iter().flatten();
        corners.map(move |&corner| ("metal".to_owned(), metal.pose.place(surface.points[corner as usize])))
    });
    let mut stones: Vec<_> = own.chain(beside).collect();
    stones.sort_by(|(a, p), (b, q)| {
        // Coarser than rounding, and finer than the distance of two stones.
        let order = |p: &DVec3| (p * 1e2).round().to_array();
        a.cmp(b).then(order(p).partial_cmp(&order(q)).unwrap())
    });
    stones.extend(metals);
    stones
}

fn assert_same_places(now: &[(String, DVec3)], before: &[(String, DVec3)]) {
    assert_eq!(now.len(), before.len());
    for ((name, at), (was, from)) in now.iter().zip(before) {
        assert!(name == was && at.distance(*from) < 1e-6, "{name} at {at}, and before {was} at {from}");
    }
}

fn unit_mm(model: &Model) -> f64 {
    model.document.specimen().unit_mm()
}

#[test]
fn a_stone_of_another_design_is_shown_and_dragged_and_stops_before_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, ROW).unwrap();
    let mut bench = bench(&path.to_string_lossy());
    bench.wait(|editor| editor.model.document.work.copies.poses.len() == 3);
    assert_eq!(work(&bench).design.diameter_mm, 12.0);
    let shown = bench.editor().model.session.ordered.shots[0].1.companions.clone();
    let before = shown.stones[0].pose;
    assert!(shown.stones.len() == 1 && (before.scale - 20.0 / 12.0).abs() < 1e-12);
    bench.wait(|editor| editor.views.gallery.traced.contains_key(&(0, Which::Present)));
    let (from, pixel) =
        (at(&bench, before.at.x, before.at.y), bench.editor().model.session.ordered.shots[0].1.film.pixel);
    drag(&mut bench, from, egui::vec2(0.0, -30.0));
    let moved = bench.editor().model.companions().stones[0].pose;
    assert!((moved.at - before.at - DVec3::Y * 30.0 * pixel).length() < 1e-5, "{} {}", moved.at, before.at);
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Z);
    bench.harness.run_steps(3);
    assert!(
        bench.editor().model.companions().stones[0].pose.at.distance(before.at) < 1e-12,
        "a drag is one step"
    );
    // The cube beside it is in its way; a drag on the empty side is free.
    let toward = work(&bench).copies.poses.iter().map(|pose| pose.at.x).fold(0.0, f64::max) - before.at.x;
    drag(&mut bench, from, egui::vec2((toward / pixel) as f32, 0.0));
    let stopped = bench.editor().model.companions().stones[0].pose.at;
    assert!((stopped.x - before.at.x).abs() < 0.7 * toward.abs(), "{stopped} from {}", before.at);
    assert!(!bench.editor().model.session.motion.is_on);
    bench.harness.key_press(Key::M);
    bench.harness.run_steps(2);
    assert!(!bench.editor().model.session.motion.is_on, "what stands among others does not tumble");
}

#[test]
fn each_document_has_the_light_and_the_views_of_its_own_and_undo_brings_them_back() {
    use brillianteer_session::model::action::ViewAction;
    let state = |model: &Model| {
        let near = model.workspace.panes.each_ref().map(|pane| (pane.shows, pane.is_near));
        (model.document.work.settings.clone(), (model.workspace.shown(), near))
    };
    let open = |model: &mut Model, then: Then| drop(update(model, FileAction::Ask(then).into()));
    let design = || Then::Library("tolkowsky".to_owned());
    for scene in ["halo-ring", "rotating-cube"] {
        let mut model = Model::new(Workspace::default()).unwrap();
        let first = state(&model);
        let edit = model.look_with(|look| look.light = "ring".to_owned());
        update(&mut model, edit.into());
        update(&mut model, ViewAction::Show(0, Shows::LiquidGlass).into());
        let before = (state(&model), model.document.work.design.clone());
        open(&mut model, Then::Preset(scene.to_owned()));
        let in_scene = state(&model);
        assert_eq!(in_scene.1.0.len(), 1, "{scene} is shown alone");
        assert!(in_scene.0 != first.0, "{scene} brings its light");
        let own = model.workspace.shown()[0];
        update(&mut model, ViewAction::Enlarge(own).into());
        open(&mut model, Then::Preset("prism-rainbow".to_owned()));
        open(&mut model, design());
        assert_eq!(state(&model), first, "{scene}: nothing of a scene is left");
        let started = Model::new(model.workspace.clone()).unwrap();
        assert_eq!(state(&started), first, "{scene}: nor at the next start");
        for _ in 0..2 {
            update(&mut model, Command::Undo.into());
        }
        assert_eq!(model.workspace.shown().len(), 4, "{scene}: the views as they were left");
        update(&mut model, Command::Undo.into());
        assert_eq!((state(&model), model.document.work.design.clone()), before, "{scene}");
    }
}

/// Returns the shot of the first view in sight, and the number of views in sight.
fn seen(bench: &Bench) -> (brillianteer_session::studio::Shot, usize) {
    let model = &bench.editor().model;
    (model.session.ordered.shots[0].1.clone(), model.workspace.shown().len())
}

#[test]
fn a_scene_and_a_shape_of_glass_begin_the_same_way_however_they_are_opened() {
    let folder = tempfile::tempdir().unwrap();
    let started = |file: std::path::PathBuf| {
        let mut bench = Bench::with(Setup { file: Some(file), ..Setup::default() });
        bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
        bench
    };
    let assert_alike = |bench: &Bench, first: &Bench, how: &str| {
        let ((shot, count), (other, _)) = (seen(bench), seen(first));
        assert_eq!((count, shot.shows), (1, Shows::Render), "{how}: a render is alone");
        assert_eq!(
            (shot.look.background, shot.look.strength, shot.look.exposure),
            (other.look.background, other.look.strength, other.look.exposure),
            "{how}"
        );
        assert_eq!(
            (shot.look.wavelengths, shot.view.projection),
            (other.look.wavelengths, other.view.projection),
            "{how}"
        );
        assert_eq!(shot.copies.len(), other.copies.len(), "{how}");
        let is_moving = |bench: &Bench| bench.editor().model.session.motion.is_on;
        assert_eq!(is_moving(bench), is_moving(first), "{how}");
    };
    for (scene, shape) in [("rotating-cube", Some("cube")), ("subtle-pill", Some("pill")), ("trilogy", None)]
    {
        let first = started(scene.into());
        let path = folder.path().join(format!("{scene}.toml"));
        std::fs::write(&path, brillianteer_files::library::scene(scene).unwrap()).unwrap();
        assert_alike(&started(path.clone()), &first, &format!("{scene} as a file"));
        let mut dropped = Bench::new();
        dropped.harness.state_mut().act(FileAction::Dropped(vec![path.clone()]));
        dropped
            .wait(|editor| !editor.model.document.work.copies.is_one_at_rest() || !editor.model.is_alone());
        assert_alike(&dropped, &first, &format!("{scene} dropped"));
        let Some(shape) = shape else { continue };
        assert_alike(&started(shape.into()), &first, &format!("{shape} by its name"));
        let path = folder.path().join(format!("{shape}.toml"));
        std::fs::write(&path, brillianteer_files::library::cut(shape).unwrap()).unwrap();
        assert_alike(&started(path), &first, &format!("{shape} as a file"));
        let mut chosen = Bench::new();
        chosen.harness.state_mut().act(FileAction::Ask(Then::Library(shape.to_owned())));
        chosen.harness.run_steps(3);
        assert_alike(&chosen, &first, &format!("{shape} by its picture"));
    }
}

#[test]
fn scenes_glass_and_moved_copies_are_there_again_at_the_next_start() {
    let folder = tempfile::tempdir().unwrap();
    let start = |file: Option<&str>| {
        let setup =
            Setup { safe: Some(folder.path().to_owned()), file: file.map(Into::into), ..Setup::default() };
        let mut bench = Bench::with(setup);
        bench.harness.run_steps(3);
        bench
    };
    let end = |mut bench: Bench| {
        let work = bench.editor().model.document.work.clone();
        let shown = bench.editor().model.workspace.shown();
        bench.harness.state_mut().act(FileAction::Close);
        assert!(bench.editor().model.session.dialog.is_none(), "nothing is lost, so nothing is asked");
        bench.harness.state_mut().act(FileAction::Ended);
        drop(bench);
        (work, shown)
    };
    for scene in ["subtle-pill", "trilogy", "plate"] {
        let mut bench = start(Some(scene));
        bench.harness.state_mut().model.session.motion.rest();
        if scene != "trilogy" {
            bench.harness.state_mut().act(Edit::LayOut(3));
        }
        bench.change_look(|look| look.glow = 0.3);
        bench.harness.run_steps(3);
        let (work, shown) = end(bench);
        let again = start(None);
        let model = &again.editor().model;
        assert!(model.session.dialog.is_none(), "{scene}");
        assert_eq!(model.document.work.design, work.design, "{scene}");
        assert_eq!(model.document.work.copies, work.copies, "{scene}");
        assert_eq!(model.document.work.settings, work.settings, "{scene}");
        assert_eq!(model.document.work.companions.stones.len(), work.companions.stones.len(), "{scene}");
        assert_eq!(model.workspace.shown(), shown, "{scene}");
        assert!(!model.document.is_changed() && !model.document.steps().0);
        // What was laid out and never saved as a scene still counts as unsaved.
        assert_eq!(model.document.has_moved_copies(), scene != "trilogy", "{scene}");
    }
    // A design from a file is read from there, under the settings that it had.
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, brillianteer_files::library::cut("oval").unwrap()).unwrap();
    let mut bench = start(path.to_str());
    bench.wait(|editor| editor.model.document.path().is_some());
    bench.change_look(|look| look.exposure = 1.5);
    bench.harness.run_steps(3);
    end(bench);
    let mut again = start(None);
    again.wait(|editor| editor.model.document.path() == Some(&path));
    assert_eq!(again.editor().model.document.work.settings.look.exposure, 1.5);
    assert!(again.editor().model.workspace.shown().len() > 1);
}

#[test]
fn another_stone_of_the_scene_is_edited_by_its_button_and_nothing_moves() {
    let mut bench = bench("trilogy");
    let before = places(work(&bench), unit_mm(&bench.editor().model));
    let title = work(&bench).design.material.clone();
    bench.click("Edit diamond, 6.46 mm, Modern ideal");
    assert_ne!(work(&bench).design.material, title);
    assert_same_places(&places(work(&bench), unit_mm(&bench.editor().model)), &before);
    assert!(!bench.editor().model.document.is_changed() && !bench.editor().model.document.has_moved_copies());
    // Its numbers are in the panel now: a wider stone stays in its place, and so do the others.
    let at_mm = work(&bench).copies.poses[0].at * unit_mm(&bench.editor().model);
    let wider = work(&bench).design.diameter_mm - 1.0;
    bench.harness.state_mut().act(Edit::Diameter(wider));
    bench.harness.run_steps(3);
    let now_mm = work(&bench).copies.poses[0].at * unit_mm(&bench.editor().model);
    assert!(now_mm.distance(at_mm) < 1e-9, "{now_mm} {at_mm}");
    for _ in 0..2 {
        bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Z);
        bench.harness.run_steps(3);
    }
    assert_eq!(work(&bench).design.material, title);
    assert_same_places(&places(work(&bench), unit_mm(&bench.editor().model)), &before);
    assert!(bench.editor().model.session.notes.troubles().is_empty());
}

#[test]
fn a_ring_is_begun_from_the_menu_and_drawn_with_its_metal() {
    let mut bench = bench("trilogy");
    bench.click("File");
    bench.click("Scene of gems");
    bench.click("Four prong");
    bench.wait(|editor| editor.model.document.work.companions.metals.len() == 1);
    bench.wait(|editor| {
        let shown = editor.views.gallery.traced.get(&(0, Which::Present));
        shown.is_some_and(|shown| shown.shot.companions.metals.len() == 1)
    });
    assert!(bench.harness.query_by_label("four-prong ring").is_some());
    assert!(bench.editor().model.session.notes.troubles().is_empty());
}

#[test]
fn a_scene_that_is_exported_opens_as_it_was() {
    for scene in ["trilogy", "halo-ring", "parcel"] {
        let folder = tempfile::tempdir().unwrap();
        let model = begun(scene);
        let mut plan = export_plan(&model);
        (plan.folder, plan.stem) = (folder.path().to_owned(), "mine".to_owned());
        SceneOut::of(&plan).write().unwrap();
        assert!(plan.scene_paths().iter().all(|path| path.exists()), "{scene}");
        let again = Preset::read(&folder.path().join("mine-scene.toml")).unwrap();
        let Preset { design, copies, companions, scene: file, .. } = again;
        let unit = 0.5 * design.diameter_mm;
        let read = Work { design, copies, companions, ..model.document.work.clone() };
        assert_same_places(&places(&read, unit), &places(&model.document.work, unit_mm(&model)));
        let shot = &plan.shot;
        assert_eq!(
            (file.look.exposure, file.look.light_turn, file.look.strength),
            (shot.look.exposure, shot.look.light_turn, shot.look.strength)
        );
        let metals = read.companions.metals.iter().zip(&model.document.work.companions.metals);
        for (now, before) in metals {
            assert_eq!((now.metal, now.roughness), (before.metal, before.roughness));
            let normals = |metal: &MetalInstance| {
                let surface = metal.mesh.surface();
                let corners = surface.corners.iter().flatten();
                corners.map(|&corner| metal.pose.turn * surface.normals[corner as usize]).collect::<Vec<_>>()
            };
            assert!(normals(now).iter().zip(&normals(before)).all(|(a, b)| a.distance(*b) < 1e-9));
        }
    }
}

#[test]
fn what_stands_beside_a_stone_is_found_after_a_crash() {
    let model = begun("halo-ring");
    let companions = &model.document.work.companions;
    let text = serde_json::to_string(&KeptCompanions::of(companions)).unwrap();
    let built = serde_json::from_str::<KeptCompanions>(&text).unwrap().built().unwrap();
    let again = Work { companions: built, ..model.document.work.clone() };
    assert_same_places(&places(&again, unit_mm(&model)), &places(&model.document.work, unit_mm(&model)));
    let first = &again.companions.stones[0].specimen;
    assert!(
        again.companions.stones.iter().all(|s| std::sync::Arc::ptr_eq(&s.specimen, first)),
        "one for all"
    );
}

#[test]
fn a_scene_has_its_own_name_in_the_window_and_in_the_names_of_files() {
    let model = begun("halo-ring");
    assert_eq!(
        (model.document.title(), model.document.design_stem()),
        ("Halo ring".into(), "modern-ideal".into())
    );
    let plan = export_plan(&model);
    assert_eq!((plan.stem.as_str(), plan.shot.title.as_str()), ("halo-ring", "Halo ring"));
    // The view of a scene is tilted by some fraction of a degree, which the names of files round.
    for (_, viewing) in plan.parts() {
        let suffix = viewing.viewpoint.suffix();
        assert!(
            suffix.split('-').all(|part| part.split_once('.').is_none_or(|(_, digits)| digits.len() < 4)),
            "{suffix}"
        );
    }
}

#[test]
fn a_scene_without_a_head_is_not_changed_by_its_row() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bare.toml");
    let text = "format = 1\nname = \"Bare\"\nlight = \"office\"\nhead = 0\nstone = [{ cut = \"cube\" }]";
    std::fs::write(&path, text).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path), ..Setup::default() });
    bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
    bench.harness.run_steps(4);
    let head = |bench: &Bench| bench.editor().model.document.work.settings.look.head;
    assert_eq!(
        (head(&bench), bench.editor().model.document.first_settings().look.head),
        (Some(0.0), Some(0.0))
    );
    bench.type_number("Head", "12");
    assert_eq!(head(&bench), Some(12.0));
    bench.type_number("Head", "0");
    assert_eq!(head(&bench), None, "the light's own");
}
