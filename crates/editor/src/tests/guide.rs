//! Takes the pictures of docs/editor.md and docs/cutting.md. Run `cargo test --release --lib guide -- --ignored`, and look at the pictures.

use super::emerald::build;
use super::fitting::pick;
use super::tiers::reach;
use super::*;
use brillianteer_paper::cutting_sheet::{SheetFormat, cutting_sheet, write};
use brillianteer_picture::PaperSize;
use brillianteer_session::model::dialog::Dialog;
use std::path::Path;

/// Opens the window as at a first start, in the dark theme, with a file that comes with the program.
fn window(cut: &str, workspace: &Workspace) -> Bench {
    let file = Some(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("cuts").join(cut));
    let mut bench = Bench::drawn(Setup { file, ..Setup::default() }, egui::Theme::Dark);
    bench.harness.state_mut().model.workspace = workspace.clone();
    bench.settle();
    bench
}

/// Writes a picture of the window once nothing changes any more.
fn take(bench: &mut Bench, name: &str) {
    bench.settle();
    bench.wait(|editor| !editor.studio.sharpens());
    draw(bench, name);
}

/// Writes a picture of the window without waiting for the finest renders, which take a quarter of an hour for glass.
fn draw(bench: &mut Bench, name: &str) {
    bench.settle();
    bench.harness.remove_cursor();
    bench.harness.run_steps(30);
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("docs/images/editor");
    bench.harness.render().unwrap().save(folder.join(name).with_extension("png")).unwrap();
}

#[test]
#[ignore = "writes pictures into docs/images/editor"]
fn the_first_window_and_a_path() {
    let mut bench = window("tolkowsky.toml", &Workspace::default());
    take(&mut bench, "first");
    bench.click_at(bench.harness.get_by_label("ASET picture").rect().center() + egui::vec2(60.0, 24.0));
    (0..40).for_each(|_| bench.harness.step());
    take(&mut bench, "path");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn the_cuts_to_begin_from() {
    let mut bench = window("tolkowsky.toml", &Bench::small());
    bench.choose("File", "New from a cut…");
    draw(&mut bench, "cuts");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn a_lower_crown() {
    let mut bench = window("tolkowsky.toml", &Workspace::default());
    bench.type_number("Crown angle", "32.5");
    take(&mut bench, "crown");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn a_tilt_with_wireframe() {
    let mut bench = window("tolkowsky.toml", &Workspace::default());
    bench.harness.state_mut().model.workspace.eye.lean = glam::DVec2::new(-0.25, -0.55);
    bench.settle();
    bench.harness.key_press(egui::Key::W);
    take(&mut bench, "tilt");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn a_deeper_pavilion() {
    let mut bench = window("tolkowsky.toml", &Workspace::default());
    bench.type_number("Pavilion angle", "43.9");
    take(&mut bench, "profile");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn two_designs_side_by_side() {
    let mut bench = window("tolkowsky.toml", &Bench::small());
    bench.choose("Compare", "Compare with saved");
    bench.type_number("Pavilion angle", "42.2");
    bench.harness.key_press(egui::Key::D);
    take(&mut bench, "compare");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn what_to_export() {
    let mut bench = window("tolkowsky.toml", &Workspace::default());
    bench.choose("File", "Export…");
    let Some(Dialog::Export(export)) = &mut bench.harness.state_mut().model.session.dialog else { panic!() };
    export.plan.folder = "/home/me/stones/out".into();
    bench.wait(|editor| editor.thumbnails.len() == 9);
    take(&mut bench, "export");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn four_cubes() {
    let mut bench = window("cube.toml", &Bench::small());
    bench.click("Rotating cube");
    bench.harness.run_steps(30);
    bench.harness.key_press(egui::Key::M);
    draw(&mut bench, "glass");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn what_lies_behind() {
    let shown = [Shows::Render, Shows::Refraction, Shows::LiquidGlass, Shows::TracedPane];
    let mut bench = window("cube.toml", &Workspace::default());
    bench.leave_one();
    let model = &mut bench.harness.state_mut().model;
    model.document.work.settings.look.background = Some("page".into());
    model.workspace.panes.iter_mut().zip(shown).for_each(|(pane, shows)| pane.shows = shows);
    draw(&mut bench, "backgrounds");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn an_oval_as_tiers() {
    let mut bench = window("oval.toml", &Bench::small());
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    bench.click_at(bench.harness.get_by_label("ASET picture").rect().center() + egui::vec2(60.0, 140.0));
    take(&mut bench, "tiers");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn the_corners_that_a_bezel_can_be_cut_to() {
    let mut bench = window("tolkowsky.toml", &Bench::small());
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    reach(&mut bench, "Pick meet of C1");
    bench.click("Pick meet of C1");
    take(&mut bench, "pick");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn a_step_at_the_bench() {
    let mut bench = window("tolkowsky.toml", &Bench::small());
    bench.choose("Edit", "Turn into tiers");
    bench.choose("View", "Bench mode");
    ["Next step", "Index 12", "Index 24"].into_iter().for_each(|label| bench.click(label));
    bench.harness.run_steps(8);
    take(&mut bench, "bench-mode");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn an_oval_with_a_lower_pavilion() {
    let mut bench = window("oval.toml", &Workspace::default());
    bench.type_number("Pavilion angle", "40.2");
    bench.type_number("Table", "56");
    take(&mut bench, "oval");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn an_oval_for_sapphire() {
    let mut bench = window("oval.toml", &Bench::small());
    bench.choose("Design", "Fit to another material…");
    pick(&mut bench, "New material", "sapphire");
    pick(&mut bench, "Rule", "Critical angle");
    bench.wait(|editor| match &editor.model.session.dialog {
        Some(Dialog::Retarget(form)) => form.light.is_some(),
        _ => false,
    });
    take(&mut bench, "retarget");
}

#[test]
#[ignore = "writes a picture into docs/images/editor"]
fn an_oval_from_a_piece_of_rough() {
    let mut bench = window("oval.toml", &Bench::small());
    bench.choose("Design", "Size and yield…");
    for (name, number) in
        [("Rough length", "12"), ("Rough width", "9"), ("Rough depth", "7"), ("Rough weight", "12")]
    {
        bench.type_number(name, number);
    }
    take(&mut bench, "yield");
}

#[test]
#[ignore = "writes pictures into docs/images and docs/images/editor"]
fn an_emerald_cut_from_a_block_its_sheet_and_a_step_at_the_bench() {
    let mut bench = window("block.toml", &Bench::small());
    build(&mut bench);
    bench.harness.state_mut().model.document.work.design.name = "Emerald cut".to_owned();
    bench.click("Select P6");
    bench.harness.key_press(egui::Key::Num0);
    take(&mut bench, "emerald");
    let specimen = bench.editor().model.document.named(bench.editor().model.document.specimen());
    let sheet = cutting_sheet(&specimen, false).unwrap();
    let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("docs/images/emerald-sheet.svg");
    let pages = write(&sheet, PaperSize::A4, (SheetFormat::Svg, &file)).unwrap();
    assert_eq!(pages.len(), 1);
    bench.choose("View", "Bench mode");
    (0..6).for_each(|_| bench.click("Next step"));
    ["Index 12", "Index 36", "Index 60"].into_iter().for_each(|index| bench.click(index));
    bench.harness.run_steps(8);
    take(&mut bench, "bench-emerald");
}

#[test]
#[ignore = "writes pictures into docs/images/editor"]
fn a_map_of_fire_and_leakage_against_tilt() {
    let mut bench = window("tolkowsky.toml", &Bench::small());
    bench.choose("View", "Map of a measure");
    pick(&mut bench, "Measure", "Return, even light, head 15°");
    pick(&mut bench, "Plotted", "Leakage");
    take(&mut bench, "map");
}
