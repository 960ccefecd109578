//! Tests of features for graders: scopes without glare unless it is switched on, captions, and the mark of
//! illustrative colours.

use super::*;
use brillianteer_scene::Glare;
use brillianteer_session::model::dialog::Dialog;
use egui_kittest::kittest::NodeT;

/// Returns the share that a row of the figures shows, in percent.
fn share(bench: &Bench, name: &str) -> Option<f64> {
    let rows = bench.harness.query_all_by_label_contains(name);
    let values = rows.filter_map(|node| node.accesskit_node().value());
    values.filter_map(|text| text.strip_prefix(name)?.trim().strip_suffix(" %")?.parse().ok()).next()
}

#[test]
fn scopes_show_no_glare_until_it_is_asked_for_and_then_only_they_are_taken_anew() {
    let workspace = Workspace { layout: PaneLayout::One, ..Bench::small() };
    let mut bench = Bench::sized(Setup { workspace, ..Setup::default() }, egui::vec2(1280.0, 900.0));
    bench.settle();
    assert_eq!(bench.editor().shown((0, Which::Present)).unwrap().shot.glare, Glare::LeftOut);
    assert!(bench.harness.query_by_label("without glare").is_some(), "the view says what it shows");
    let (bare, green) = (bench.picture(0), share(&bench, "Green").unwrap());
    assert!(share(&bench, "With glare").is_none());
    let returned = share(&bench, "Light return").unwrap();
    bench.harness.key_press(egui::Key::V);
    bench.settle();
    assert!(bench.harness.query_by_label("with glare ×").is_some());
    assert_ne!(bench.picture(0), bare);
    assert!(
        share(&bench, "Green").unwrap() > green + 1.0,
        "the crown reflects what is low above the horizon"
    );
    assert_eq!(share(&bench, "Light return"), Some(returned), "light return holds no glare");
    let with = share(&bench, "With glare").unwrap();
    assert!(with > returned + 10.0, "{returned} without, {with} with");
    bench.harness.key_press(egui::Key::V);
    bench.settle();
    assert_eq!(bench.picture(0), bare);
    // A view of strongest exits never has glare, so that it is not traced again when glare is switched on.
    let strongest = |glare| {
        let shot = bench.editor().shown((0, Which::Present)).unwrap().shot.clone();
        Shot { strongest: true, glare, ..shot }
    };
    assert_eq!(strongest(Glare::Included), strongest(Glare::LeftOut));
}

#[test]
fn a_gem_whose_colour_is_no_measurement_is_called_so_where_it_is_chosen() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1000.0, 900.0));
    bench.harness.run_steps(2);
    assert!(bench.harness.query_by_label("illustrative colour").is_none());
    bench.harness.get_by_role_and_label(egui::Role::ComboBox, "Material").click();
    bench.harness.run_steps(4);
    // Entries far down the list are scrolled out of sight. Diamond is always in sight, because it is chosen.
    let mut measured =
        brillianteer_optics::materials().iter().filter(|m| !m.colour_is_illustrative && m.name != "diamond");
    let is_in_sight = |name: &str| bench.harness.query_all_by_label(name).next().is_some();
    assert!(
        measured.any(|material| is_in_sight(&material.name)),
        "one that is measured bears its name alone"
    );
    let entry = bench.harness.get_by_label_contains("almandine");
    assert!(entry.accesskit_node().label().unwrap().contains("illustrative colour"));
    entry.click();
    bench.harness.run_steps(4);
    assert_eq!(bench.editor().model.document.specimen().material.name, "almandine");
    assert!(bench.harness.query_by_label("illustrative colour").is_some());
}

#[test]
fn pictures_of_scopes_are_exported_with_a_caption_where_it_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    bench.choose("File", "Export…");
    let Some(Dialog::Export(export)) = &mut bench.harness.state_mut().model.session.dialog else { panic!() };
    export.plan.folder = folder.path().join("out");
    export.plan.selection.views = vec![Shows::Aset];
    bench.harness.run_steps(2);
    bench.click("Caption and legend");
    bench.type_number("Size", "200");
    bench.click("Write files");
    bench.wait(|editor| matches!(&editor.model.session.dialog, Some(Dialog::Export(e)) if !e.is_busy()));
    let Some(Dialog::Export(export)) = &bench.editor().model.session.dialog else { panic!() };
    assert_eq!(export.run.as_ref().and_then(|run| run.end.clone()), Some(Ok(())));
    let written = std::fs::read_dir(folder.path().join("out")).unwrap().map(|f| f.unwrap().path());
    let pictures: Vec<_> = written.map(|path| image::image_dimensions(path).unwrap()).collect();
    assert!(pictures.len() == 2 && pictures.iter().all(|&(w, h)| w == 200 && h > 240), "{pictures:?}");
}
