//! Takes the pictures of docs/editor.md: `cargo test --lib guide -- --ignored`, and look at what it wrote.

use super::*;
use std::path::Path;

/// The window of a first start, drawn in the dark, on a file that comes with the program.
fn window(cut: &str, desk: &Desk) -> Bench {
    let file = Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("cuts").join(cut));
    let mut bench = Bench::drawn(Setup { file, ..Setup::default() }, egui::Theme::Dark);
    bench.harness.state_mut().desk = desk.clone();
    bench.settle();
    bench
}

/// Writes the window as it is once nothing changes any more.
fn take(bench: &mut Bench, name: &str) {
    bench.settle();
    bench.wait(|editor| !editor.studio.sharpens());
    bench.harness.remove_cursor();
    bench.harness.run_steps(30);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/images/editor");
    bench.harness.render().unwrap().save(folder.join(name).with_extension("png")).unwrap();
}

#[test]
#[ignore = "writes pictures into docs/images/editor, in some minutes"]
fn pictures_of_the_editors_guide() {
    let four = Desk::default();
    let mut bench = window("tolkowsky.toml", &four);
    take(&mut bench, "first");
    bench.click_at(bench.harness.get_by_label("ASET picture").rect().center() + egui::vec2(60.0, 24.0));
    (0..40).for_each(|_| bench.harness.step());
    take(&mut bench, "path");

    let mut bench = window("tolkowsky.toml", &four);
    bench.type_number("Crown angle", "32.5");
    take(&mut bench, "crown");

    let mut bench = window("tolkowsky.toml", &four);
    bench.harness.key_press(egui::Key::F);
    bench.settle();
    bench.harness.key_press(egui::Key::W);
    take(&mut bench, "tilt");

    let mut bench = window("tolkowsky.toml", &four);
    bench.type_number("Pavilion angle", "43.9");
    take(&mut bench, "profile");

    let mut bench = window("tolkowsky.toml", &Bench::small());
    bench.choose("Compare", "Compare with saved");
    bench.type_number("Pavilion angle", "42.2");
    take(&mut bench, "compare");

    let mut bench = window("tolkowsky.toml", &four);
    bench.choose("File", "Export…");
    let Some(crate::app::dialogs::Dialog::Export(export)) = &mut bench.harness.state_mut().dialog else {
        panic!("no dialog is open")
    };
    export.folder = "/home/me/stones/out".into();
    let has_come = |editor: &Editor| match &editor.dialog {
        Some(crate::app::dialogs::Dialog::Export(export)) => export.thumbnails_shown() == 9,
        _ => false,
    };
    bench.wait(has_come);
    take(&mut bench, "export");

    let mut bench = window("cube.toml", &four);
    bench.click("Rotating cube");
    bench.harness.run_steps(30);
    bench.harness.key_press(egui::Key::M);
    take(&mut bench, "glass");

    let shown = [Shows::Render, Shows::Refraction, Shows::LiquidGlass, Shows::TracedPane];
    let mut desk = Desk { behind: Some("page".into()), ..four };
    desk.panes.iter_mut().zip(shown).for_each(|(pane, shows)| pane.shows = shows);
    take(&mut window("cube.toml", &desk), "backgrounds");
}
