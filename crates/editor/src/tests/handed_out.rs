//! Tests of the data that the window gives to other programs (through the clipboard, in files, by opening folders and
//! pages), and of files that are dropped on it.

use super::*;
use brillianteer_cut::Design;
use brillianteer_files::cut_file;
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_paper::write_rgba_png;
use brillianteer_scene::{BackgroundRef, Specimen};
use brillianteer_session::model::{dialog::Dialog, document::Document};
use egui::OutputCommand;
use egui_kittest::kittest::NodeT;
use std::path::Path;

/// Runs some frames and returns what they copy: the texts, and the sizes of pictures.
fn copied(bench: &mut Bench, steps: usize) -> (Vec<String>, Vec<[usize; 2]>) {
    let (mut texts, mut pictures) = (vec![], vec![]);
    for _ in 0..steps {
        bench.harness.step();
        for command in &bench.harness.output().platform_output.commands {
            match command {
                OutputCommand::CopyText(text) => texts.push(text.clone()),
                OutputCommand::CopyImage(image) => pictures.push(image.size),
                _ => {}
            }
        }
    }
    (texts, pictures)
}

/// Clicks with the right button at a point.
fn open_menu(bench: &mut Bench, at: egui::Pos2) {
    bench.harness.hover_at(at);
    bench.harness.step();
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Secondary, egui::Modifiers::NONE);
        bench.harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        bench.harness.step();
    }
    bench.harness.run_steps(4);
}

fn open_menu_of(bench: &mut Bench, name: &str) {
    let at = bench.harness.get_by_label(name).rect().center();
    open_menu(bench, at);
}

#[test]
fn a_right_click_opens_a_menu_of_the_view_and_a_right_drag_turns_the_stone() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1000.0, 900.0));
    bench.harness.run_steps(3);
    open_menu_of(&mut bench, "ASET picture");
    assert_eq!(bench.editor().model.workspace.eye.turn, 0.0);
    bench.harness.get_by_label("Export this view…").click();
    bench.harness.run_steps(4);
    let Some(Dialog::Export(export)) = &bench.editor().model.session.dialog else { panic!("no export") };
    assert_eq!(export.plan.selection.views, [Shows::Aset]);
    bench.click("Cancel");
    open_menu_of(&mut bench, "Hearts picture");
    bench.click("Overlays");
    bench.harness.run_steps(4);
    bench.harness.get_by_label_contains("Wireframe").click();
    bench.harness.run_steps(4);
    assert_eq!(bench.editor().model.workspace.overlay.as_deref(), Some("wireframe"));
    bench.harness.state_mut().model.workspace.eye.lean = glam::DVec2::new(0.3, 0.1);
    open_menu_of(&mut bench, "ASET picture");
    bench.harness.get_by_label_contains("Reset view").click();
    bench.harness.run_steps(3);
    assert_eq!(bench.editor().model.workspace.eye.lean, glam::DVec2::ZERO);
    open_menu_of(&mut bench, "ASET picture");
    bench.click("Show");
    bench.harness.run_steps(4);
    bench.harness.get_by_label("Ideal-Scope").click();
    bench.harness.run_steps(4);
    assert_eq!(bench.editor().model.workspace.panes[0].shows, Shows::IdealScope);
}

#[test]
fn a_picture_is_copied_at_a_size_that_is_chosen() {
    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    let own = bench.editor().model.session.ordered.shots[0].1.film.size.map(|n| n as usize);
    open_menu_of(&mut bench, "ASET picture");
    bench.click("Copy picture at size");
    bench.harness.run_steps(4);
    bench.harness.get_by_label("512 pixels").click();
    bench.harness.step();
    let begun = Instant::now();
    let mut pictures = vec![];
    while pictures.is_empty() {
        assert!(begun.elapsed() < PATIENCE, "no picture is copied");
        pictures = copied(&mut bench, 1).1;
        std::thread::sleep(Duration::from_millis(5));
    }
    let [width, height] = pictures[0];
    assert_eq!(width.max(height), 512);
    let shape = |[w, h]: [usize; 2]| w as f64 / h as f64;
    assert!((shape(own) / shape(pictures[0]) - 1.0).abs() < 0.01, "{own:?} became {width} x {height}");
    assert!(bench.editor().model.session.notes.said().unwrap().contains("ASET copied, "));
}

#[test]
fn figures_are_copied_as_text_and_as_a_table() {
    let mut bench = Bench::new();
    bench.wait(|editor| editor.model.session.measured.figures.contains_key(&Which::Present));
    let copy = |bench: &mut Bench, entry: &str| {
        bench.click("Copy");
        bench.harness.run_steps(4);
        bench.harness.get_by_label(entry).click();
        copied(bench, 4).0.pop().unwrap()
    };
    let shown = |bench: &Bench| {
        let labels = bench.harness.query_all_by_label_contains("Light return");
        let shown =
            labels.filter_map(|node| node.accesskit_node().value()).find(|text| text.ends_with('%')).unwrap();
        shown.trim_start_matches("Light return").trim_end_matches('%').trim().parse::<f64>().unwrap()
    };
    // The figures may become finer meanwhile.
    let before = shown(&bench);
    let text = copy(&mut bench, "Copy as text");
    let percents = [before, shown(&bench)];
    let line = text.lines().find(|line| line.starts_with("Light return")).unwrap();
    let copied: f64 = line.trim_start_matches("Light return").trim_end_matches('%').trim().parse().unwrap();
    assert!(percents.iter().any(|percent| (copied - percent).abs() < 0.0051), "{line} beside {percents:?}");
    assert!(text.starts_with("Tolkowsky 1919: Table side, face up; ASET, energy; "), "{text}");
    let table = copy(&mut bench, "Copy as CSV");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    // The name of the view contains a comma, and so stands in quotes.
    assert!(rows.len() == 10 && rows[1..].iter().all(|row| row.len() == 6), "{table}");
    let heading = bench.harness.get_by_label("Against tilt").rect().center();
    open_menu(&mut bench, heading);
    assert!(bench.harness.query_by_label("Copy as CSV").is_some(), "the right button offers the same");
}

#[test]
fn the_folder_of_an_export_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::new();
    bench.choose("File", "Export…");
    let Some(Dialog::Export(export)) = &mut bench.harness.state_mut().model.session.dialog else { panic!() };
    export.plan.folder = folder.path().join("out");
    export.plan.selection.views = vec![Shows::Profile];
    export.plan.selection.size = 64;
    bench.harness.run_steps(2);
    bench.click("Write files");
    bench.wait(|editor| matches!(&editor.model.session.dialog, Some(Dialog::Export(e)) if !e.is_busy()));
    bench.click("Open folder");
    let opened = Arc::clone(&bench.opened);
    bench.wait(move |_| !opened.lock().unwrap().is_empty());
    assert_eq!(*bench.opened.lock().unwrap(), [folder.path().join("out").display().to_string()]);
}

#[test]
fn the_program_says_what_it_is_and_what_it_is_built_of() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1000.0, 800.0));
    bench.choose("Help", "About Brillianteer");
    let version = format!("Brillianteer {}", env!("CARGO_PKG_VERSION"));
    assert!(bench.harness.query_by_label(&version).is_some());
    bench.click("Licence MIT");
    assert!(bench.harness.query_by_label_contains("WITHOUT WARRANTY OF ANY KIND").is_some());
    bench.click("Built with");
    bench.harness.get_by_role_and_label(egui::Role::TextInput, "Find").focus();
    bench.harness.run_steps(2);
    bench.harness.event(egui::Event::Text("egui_plot".to_owned()));
    bench.harness.run_steps(3);
    bench.harness.get_by_label_contains("egui_plot 0").click();
    let opened = Arc::clone(&bench.opened);
    bench.wait(move |_| !opened.lock().unwrap().is_empty());
    let opened = bench.opened.lock().unwrap().clone();
    assert!(opened.len() == 1 && opened[0].starts_with("https://"), "{opened:?}");
}

/// A file as the window system hands it over.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|e| e.to_string())
    }
}

fn drop_on(bench: &mut Bench, files: &[&Path]) {
    let files = files.iter().map(|path| Arc::new(Dropped((*path).to_owned())) as egui::DroppedFileHandle);
    bench.harness.input_mut().dropped_files = files.collect();
    bench.harness.run_steps(2);
    bench.wait(|editor| !editor.model.session.awaited.dropped);
}

#[test]
fn files_of_every_kind_are_dropped_on_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let first = Document::first().unwrap();
    let design = Design { name: "dropped".into(), ..first.work.design.clone() };
    std::fs::write(at("design.toml"), cut_file::write(&design)).unwrap();
    design_file::write(
        &Specimen::new(first.work.design.clone()).unwrap(),
        DesignFormat::Stl,
        &at("mesh.stl"),
    )
    .unwrap();
    let scene = brillianteer_files::library::scene("subtle-pill").unwrap();
    std::fs::write(at("scene.toml"), scene).unwrap();
    let grey: Vec<u8> = [128, 128, 128, 255].repeat(8 * 4);
    write_rgba_png(&at("photo.png"), &grey, (8, 4), "grey").unwrap();
    std::fs::write(
        at("lamp.toml"),
        brillianteer_files::light_file::text(&brillianteer_scene::light("ring").unwrap()).unwrap(),
    )
    .unwrap();
    let mut hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n".to_vec();
    hdr.extend([128, 128, 128, 129].repeat(8));
    std::fs::write(at("sky.hdr"), hdr).unwrap();

    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    drop_on(&mut bench, &[&at("design.toml")]);
    bench.wait(|editor| editor.model.document.work.design.name == "dropped");
    drop_on(&mut bench, &[&at("mesh.stl")]);
    bench.wait(|editor| matches!(editor.model.document.work.design.cut, Cut::Planes(_)));
    drop_on(&mut bench, &[&at("photo.png")]);
    assert_eq!(
        bench.editor().model.document.work.settings.look.background,
        Some(BackgroundRef::Photo(at("photo.png")))
    );
    for light in ["lamp.toml", "sky.hdr"] {
        drop_on(&mut bench, &[&at(light)]);
        bench.wait(|editor| {
            editor.model.session.light.loading.is_none() && editor.model.session.light.name.ends_with(light)
        });
        assert!(
            bench.editor().model.session.notes.troubles().is_empty(),
            "{:?}",
            bench.editor().model.session.notes
        );
    }
    drop_on(&mut bench, &[&at("scene.toml"), &at("design.toml")]);
    bench.wait(|editor| {
        editor.model.document.work.copies.poses.len() > 1 || editor.model.session.dialog.is_some()
    });
    assert!(bench.editor().model.session.dialog.is_none());
    drop_on(&mut bench, &[&at("nothing.xyz")]);
    bench.wait(|editor| !editor.model.session.notes.troubles().is_empty());
    assert!(bench.harness.query_by_label_contains("nothing.xyz").is_some());
    bench.harness.input_mut().hovered_files = vec![egui::HoveredFile::default()];
    bench.harness.run_steps(1);
    let is_invited = bench.harness.output().shapes.iter().any(|clipped| {
        matches!(&clipped.shape, egui::Shape::Text(text) if text.galley.text().starts_with("Drop a cut"))
    });
    assert!(is_invited);
}
