//! Compares the window with pictures that a person has looked at. After a change of its looks that was intended, run
//! `UPDATE_SNAPSHOTS=1 cargo test --release --lib looks`, and look at the new pictures.

use super::*;
use brillianteer_trace::gpu::Gpu;
use egui_kittest::SnapshotOptions;

/// Returns whether a window can be drawn here. Where it cannot, this prints why, or fails if `BRILLIANTEER_REQUIRE_GPU` is set.
fn can_draw(test: &str) -> bool {
    match Gpu::open() {
        Ok(_) => true,
        Err(error) => {
            assert!(std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_none(), "{error}");
            println!("SKIPPED {test}: {error}");
            false
        }
    }
}

/// Returns a workspace of four views that are made quickly.
fn arrows_first() -> Workspace {
    let mut workspace = Workspace::default();
    workspace.panes[0].shows = Shows::Arrows;
    workspace
}

fn compare(bench: &mut Bench, name: &str) {
    // Drivers round edges of letters and lines differently by a shade.
    let options = SnapshotOptions::new().threshold(1.0).max_failed_pixels(60);
    bench.harness.state_mut().studio.rename_device("processor");
    bench.harness.remove_cursor();
    bench.harness.run_steps(2);
    bench.harness.snapshot_options(name, &options);
}

#[test]
fn the_first_window_in_the_dark() {
    if !can_draw("the_first_window_in_the_dark") {
        return;
    }
    let mut bench = Bench::drawn(Setup { workspace: arrows_first(), ..Setup::default() }, egui::Theme::Dark);
    bench.settle();
    compare(&mut bench, "dark");
}

#[test]
fn a_light_path_in_the_light() {
    if !can_draw("a_light_path_in_the_light") {
        return;
    }
    let mut bench = Bench::drawn(Setup { workspace: arrows_first(), ..Setup::default() }, egui::Theme::Light);
    bench.settle();
    let at = bench.harness.get_by_label("ASET picture").rect().center() + egui::vec2(60.0, 24.0);
    bench.click_at(at);
    (0..40).for_each(|_| bench.harness.step());
    bench.settle();
    compare(&mut bench, "light-path");
}

#[test]
fn what_may_be_exported() {
    if !can_draw("what_may_be_exported") {
        return;
    }
    let mut bench = Bench::drawn(Setup { workspace: arrows_first(), ..Setup::default() }, egui::Theme::Dark);
    bench.settle();
    bench.choose("File", "Export…");
    let Some(brillianteer_session::model::dialog::Dialog::Export(export)) =
        &mut bench.harness.state_mut().model.session.dialog
    else {
        panic!()
    };
    export.plan.folder = "/home/me/stones/out".into();
    bench.wait(|editor| editor.thumbnails.len() == 10);
    compare(&mut bench, "export");
}
