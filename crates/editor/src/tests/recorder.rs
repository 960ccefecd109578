//! The recorder: a hash of every view at rest, for changes that must leave all results as they are.
//!
//! `BRILLIANTEER_RECORD=before.txt cargo test --release --lib recorder -- --ignored` writes the file where there is none, and else
//! fails with the lines that differ. Hashes hold for one machine: other processors round sines differently.

use super::*;
use brillianteer_measure::Figures;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

fn hash(value: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// Returns a hash of the numbers of figures.
fn numbers(figures: &Figures) -> u64 {
    let zones = [&figures.surface, &figures.transmitted, &figures.strongest_exit_area];
    let others = [figures.silhouette_area, figures.absorbed, figures.unresolved, figures.standard_error];
    hash(zones.into_iter().flatten().chain(&others).map(|number| number.to_bits()).collect::<Vec<_>>())
}

/// Adds a line to `record`: hashes of the finest picture of one view of a slightly tilted design, and of its figures.
fn record(cut: &str, shows: Shows, record: &mut String) {
    let file = Some(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("cuts").join(cut));
    let mut workspace = Workspace { layout: PaneLayout::One, ..Workspace::default() };
    workspace.panes[0].shows = shows;
    workspace.eye.lean = glam::DVec2::new(0.05, -0.12);
    // A window so small that glass, which is traced by rays, becomes fine within seconds.
    let mut bench = Bench::sized(Setup { file, workspace, ..Setup::default() }, egui::vec2(800.0, 400.0));
    bench.settle();
    bench.wait(|editor| !editor.studio.sharpens());
    bench.settle();
    let editor = bench.editor();
    let picture = editor.shown((0, Which::Present)).map(|shown| {
        let image = &shown.taken.image;
        (image.size, hash(&image.rgba), shown.taken.unresolved, shown.taken.tracer)
    });
    let figures =
        editor.model.session.measured.figures.get(&Which::Present).map(|measured| numbers(&measured.figures));
    let tilts = editor.model.session.measured.tilts.as_ref().map(|(_, tilts)| {
        hash(tilts.iter().map(|(tilt, figures)| (tilt.to_bits(), numbers(figures))).collect::<Vec<_>>())
    });
    let _ = writeln!(record, "{cut} {shows:?}: {picture:x?}, figures {figures:x?}, against tilt {tilts:x?}");
}

#[test]
#[ignore = "for changes that are to change nothing; see the top of the file"]
fn every_view_is_as_it_was() {
    let Some(path) = std::env::var_os("BRILLIANTEER_RECORD") else {
        panic!("say by BRILLIANTEER_RECORD=FILE where the record is")
    };
    let mut now = String::new();
    for cut in ["tolkowsky.toml", "cube.toml"] {
        Shows::ALL.into_iter().for_each(|shows| record(cut, shows, &mut now));
    }
    let Ok(before) = std::fs::read_to_string(&path) else {
        std::fs::write(&path, &now).unwrap();
        return;
    };
    let [before, now] = [&before, &now].map(|text| text.lines().collect::<BTreeSet<_>>());
    let gone: Vec<_> = before.difference(&now).collect();
    let new: Vec<_> = now.difference(&before).collect();
    assert!(gone.is_empty() && new.is_empty(), "no longer: {gone:#?}\nnow: {new:#?}");
}
