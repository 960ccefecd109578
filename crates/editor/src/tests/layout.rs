//! Tests of the window's layout: on small screens, beside errors, for stones of any outline.

use super::*;
use crate::theme;
use brillianteer_cut::{Design, MaterialRef};
use brillianteer_files::{cut_file, design_file};
use brillianteer_session::model::{
    command::MENUS,
    dialog::{Dialog, Then},
    document::Document,
    exporting::ExportForm,
    plan::export_plan,
};
use egui::{Color32, Rect, Role, vec2};
use egui_kittest::kittest::{By, NodeT};

/// A small window, in points: a screen of 1280 by 720 pixels at 150 %.
const SMALL: egui::Vec2 = vec2(853.0, 480.0);

/// The least size of the window, in points.
const LEAST: egui::Vec2 = vec2(640.0, 420.0);

/// The right edge of the design panel, in points.
const PANEL: f32 = 362.0;

/// Opens a window of the least size with two scopes.
fn small(pixels_per_point: f32) -> Bench {
    let setup = Setup { workspace: Bench::small(), ..Setup::default() };
    let mut bench =
        Bench::built(setup, Harness::builder().with_size(SMALL).with_pixels_per_point(pixels_per_point));
    bench.harness.run_steps(3);
    bench
}

fn window(bench: &Bench) -> Rect {
    bench.harness.ctx.content_rect()
}

/// Returns the names and places of all fields of a role to the left of the views.
fn fields(bench: &Bench, role: Role) -> Vec<(String, Rect)> {
    let nodes = bench.harness.query_all_by_role(role);
    let named = nodes.map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect()));
    named.filter(|(_, rect)| rect.right() < PANEL).collect()
}

/// Returns the colours and the words of all visible texts.
fn colours_of_texts(bench: &Bench) -> Vec<(Color32, String)> {
    fn add(shape: &egui::Shape, found: &mut Vec<(Color32, String)>) {
        match shape {
            egui::Shape::Text(text) => {
                let colours = text.galley.job.sections.iter().map(|section| section.format.color);
                let own =
                    text.override_text_color.or(colours.into_iter().next()).unwrap_or(text.fallback_color);
                found.push((own, text.galley.text().to_owned()));
            }
            egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| add(shape, found)),
            _ => {}
        }
    }
    let mut found = vec![];
    bench.harness.output().shapes.iter().for_each(|clipped| add(&clipped.shape, &mut found));
    found
}

#[test]
fn what_is_on_in_a_narrow_view_has_a_menu_that_can_be_read() {
    let setup = Setup { workspace: Workspace::default(), ..Setup::default() };
    let mut bench = Bench::sized(setup, SMALL);
    bench.harness.state_mut().model.workspace = Workspace::default();
    bench.harness.run_steps(3);
    bench.harness.key_press(egui::Key::W);
    bench.harness.run_steps(3);
    let menus: Vec<Rect> = bench.harness.query_all_by_label("+1").map(|node| node.rect()).collect();
    assert!(!menus.is_empty(), "no view is so narrow");
    let enlarge: Vec<Rect> = bench.harness.query_all_by_label("Enlarge").map(|node| node.rect()).collect();
    for menu in menus {
        assert!(menu.width() > 16.0, "{menu:?}");
        assert!(enlarge.iter().all(|button| !button.intersects(menu)), "{menu:?} {enlarge:?}");
    }
}

#[test]
fn a_small_window_folds_one_panel_and_a_click_opens_it_in_place_of_the_other() {
    for pixels_per_point in [1.0, 1.5] {
        let mut bench = small(pixels_per_point);
        let whole = window(&bench);
        let is_within = |bench: &Bench, name: &str| {
            let rect = bench.harness.get_by_label(name).rect();
            whole.contains_rect(rect) && rect.width() > 60.0
        };
        assert!(bench.harness.query_by_role_and_label(Role::SpinButton, "Table").is_some());
        assert!(bench.harness.query_by_label("Against tilt").is_none(), "there is no room for both panels");
        assert!(is_within(&bench, "ASET picture") && is_within(&bench, "Hearts picture"));
        bench.click("Open figures");
        bench.harness.run_steps(3);
        assert!(bench.harness.query_by_label("Against tilt").is_some());
        assert!(bench.harness.query_by_role_and_label(Role::SpinButton, "Table").is_none());
        assert!(is_within(&bench, "ASET picture"));
        bench.click("Fold figures");
        bench.harness.run_steps(3);
        assert!(
            bench.harness.query_by_label("Open figures").is_some()
                && bench.harness.query_by_label("Open design").is_some()
        );
        bench.click("Open design");
        bench.harness.run_steps(3);
        assert!(bench.harness.query_by_role_and_label(Role::SpinButton, "Table").is_some());
    }
}

/// Returns whether a widget lies within the window.
fn is_in_sight(bench: &Bench, label: &str) -> bool {
    window(bench).contains_rect(bench.harness.get_by_label_contains(label).rect())
}

#[test]
fn in_a_small_window_every_entry_of_a_menu_is_reached_and_a_bar_shows_that_there_is_more() {
    for size in [SMALL, LEAST, vec2(1440.0, 900.0)] {
        let mut bench = Bench::sized(Setup::default(), size);
        bench.harness.run_steps(3);
        for (menu, last) in [("File", "Quit"), ("View", "Reset layout"), ("Help", "About Brillianteer")] {
            let before = bars(&bench);
            bench.click(menu);
            bench.harness.run_steps(4);
            if !is_in_sight(&bench, last) {
                assert!(bars(&bench) > before, "{menu} at {size}: no bar shows that there is more");
                bench.harness.get_by_label_contains(last).scroll_to_me();
                bench.harness.run_steps(30);
            }
            assert!(is_in_sight(&bench, last), "{menu}: {last}");
            bench.harness.key_press(egui::Key::Escape);
            bench.harness.run_steps(4);
        }
    }
}

/// Returns the number of scroll bars in sight: filled rectangles that are as narrow as their handles.
fn bars(bench: &Bench) -> usize {
    let shapes = bench.harness.output().shapes.iter().flat_map(|clipped| single_shapes(&clipped.shape));
    let is_bar = |shape: &egui::Shape| match shape {
        egui::Shape::Rect(bar) => bar.fill.a() > 60 && bar.rect.width() == 6.0 && bar.rect.height() > 24.0,
        _ => false,
    };
    shapes.filter(is_bar).count()
}

/// Returns the commands that open dialogs, with the names of the buttons of each.
fn dialogs() -> Vec<(&'static str, &'static [&'static str])> {
    vec![
        ("Export…", &["Write files", "Cancel"]),
        ("Keys and terms", &["Close"]),
        ("About Brillianteer", &["Close"]),
        ("New from a cut…", &["Cancel"]),
        ("Fit to another material…", &["Cancel"]),
        ("Size and yield…", &["Use this size", "Close"]),
    ]
}

#[test]
fn buttons_of_every_dialog_are_always_in_sight_and_so_is_what_has_the_focus() {
    for (size, pixels_per_point) in [(SMALL, 1.5), (LEAST, 2.0), (vec2(1707.0, 960.0), 0.75)] {
        let builder = Harness::builder().with_size(size).with_pixels_per_point(pixels_per_point);
        let mut bench = Bench::built(Setup::default(), builder);
        bench
            .harness
            .ctx
            .all_styles_mut(|style| style.scroll_animation = egui::style::ScrollAnimation::none());
        bench.harness.run_steps(3);
        for (entry, names) in dialogs() {
            let menu = MENUS
                .iter()
                .find(|menu| menu.groups.iter().copied().flatten().any(|command| command.name() == entry));
            bench.choose(menu.unwrap().title, entry);
            bench.harness.run_steps(6);
            for name in names {
                assert_in_window(&bench, entry, name);
            }
            for _ in 0..if size == LEAST { 16 } else { 0 } {
                bench.harness.key_press(egui::Key::Tab);
                bench.harness.run_steps(3);
                let focused = bench.harness.query_all(By::new().predicate(|node| node.is_focused())).next();
                let rect = focused.expect("Tab gives something the focus").rect();
                assert!(window(&bench).expand(1.0).contains_rect(rect), "{entry}: the focus is at {rect:?}");
            }
            bench.harness.key_press(egui::Key::Escape);
            bench.harness.run_steps(4);
            assert!(bench.editor().model.session.dialog.is_none(), "{entry}");
        }
        let mut asked =
            vec![(Dialog::Unsaved(Then::Close), "Cancel"), (Dialog::Moved(Then::Close), "Cancel")];
        asked.push((Dialog::ChangedOutside, "Reload the file"));
        for (dialog, last) in asked {
            bench.harness.state_mut().model.session.dialog = Some(dialog);
            bench.harness.run_steps(4);
            assert_in_window(&bench, "a question", last);
            bench.harness.state_mut().model.session.dialog = None;
            bench.harness.run_steps(4);
        }
    }
}

fn assert_in_window(bench: &Bench, dialog: &str, button: &str) {
    let rect = bench.harness.get_by_role_and_label(Role::Button, button).rect();
    assert!(window(bench).shrink(8.0).contains_rect(rect), "{dialog}: {button} is at {rect:?}");
}

#[test]
fn errors_take_one_line_over_the_views_which_keep_their_size_and_can_be_opened() {
    let mut bench = small(1.0);
    let before = bench.harness.get_by_label("ASET picture").rect();
    let long = "a word that is said again and again; ".repeat(20);
    let notes = &mut bench.harness.state_mut().model.session.notes;
    (0..6).for_each(|k| notes.trouble(format!("trouble {k}: {long}")));
    bench.harness.run_steps(4);
    assert_eq!(bench.harness.get_by_label("ASET picture").rect(), before, "views are as they were");
    let line = bench.harness.get_by_label_contains("trouble 5").rect();
    assert!(line.height() < 24.0 && window(&bench).contains_rect(line), "{line}");
    assert!(bench.harness.query_by_label_contains("trouble 4").is_none());
    bench.click("Show all 6");
    bench.harness.run_steps(4);
    assert_eq!(bench.harness.query_all_by_label_contains("trouble").count(), 6);
    assert!(window(&bench).contains_rect(bench.harness.get_by_label("Dismiss all").rect()));
    bench.click("Dismiss all");
    bench.harness.run_steps(4);
    assert!(bench.harness.query_by_label_contains("trouble").is_none());
}

#[test]
fn the_fields_of_a_panel_stand_in_one_column() {
    let pill = Some("subtle-pill".into());
    let mut tiers = Document::first().unwrap().work.design;
    tiers.cut = Cut::Planes(tiers.cut.brilliant().unwrap().facets().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("planes.toml");
    std::fs::write(&path, cut_file::write(&tiers)).unwrap();
    for file in [None, pill, Some(path)] {
        let setup = Setup { file: file.clone(), workspace: Bench::small(), ..Setup::default() };
        let mut bench = Bench::sized(setup, vec2(1200.0, 900.0));
        bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
        bench.harness.state_mut().model.document.work.settings.look.background = Some("grid".into());
        bench.harness.run_steps(3);
        let numbers = fields(&bench, Role::SpinButton);
        let numbers: Vec<_> = numbers.into_iter().filter(|(name, _)| !name.contains("Angle")).collect();
        assert!(numbers.len() > 5, "{numbers:?}");
        let right = numbers[0].1.right();
        for (name, rect) in &numbers {
            assert!((rect.right() - right).abs() < 0.6, "{name} ends at {}, not at {right}", rect.right());
            assert!((rect.width() - numbers[0].1.width()).abs() < 0.6, "{name}: {rect}");
        }
        let choices = fields(&bench, Role::ComboBox);
        assert!(choices.len() > 3);
        for (name, rect) in &choices {
            assert!((rect.right() - right).abs() < 0.6, "{name} ends at {}, not at {right}", rect.right());
            assert!((rect.left() - choices[0].1.left()).abs() < 0.6, "{name}: {rect}");
        }
        let sliders = fields(&bench, Role::Slider);
        assert!(
            sliders.iter().all(|(_, rect)| (rect.left() - choices[0].1.left()).abs() < 0.6),
            "{sliders:?}"
        );
    }
}

#[test]
fn nothing_is_red_while_nothing_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let mut workspace = Bench::small();
    workspace.layout = PaneLayout::One;
    workspace.panes[0].shows = Shows::Render;
    let setup = Setup { file: Some("cube".into()), workspace, ..Setup::default() };
    // A small window, because renders take long.
    let mut bench = Bench::sized(setup, vec2(900.0, 300.0));
    bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
    bench.leave_one();
    let settings = &mut bench.harness.state_mut().model.document.work.settings;
    (settings.look.background, settings.look.strength) = (Some("grid".into()), 0.5);
    bench.look();
    bench.harness.state_mut().model.session.notes.warn("it was saved, but not all of it".into());
    let editor = bench.harness.state_mut();
    let mut export = ExportForm { plan: export_plan(&editor.model), run: None };
    export.plan.folder = folder.path().to_owned();
    for file in export.plan.files().unwrap() {
        std::fs::write(file, "").unwrap();
    }
    editor.model.session.dialog = Some(Dialog::Export(Box::new(export)));
    bench.harness.run_steps(4);
    let red = theme::bad(&bench.harness.ctx.global_style().visuals);
    let is_red = |bench: &Bench| -> Vec<String> {
        colours_of_texts(bench)
            .into_iter()
            .filter(|(colour, _)| *colour == red)
            .map(|(_, text)| text)
            .collect()
    };
    assert!(bench.harness.query_by_label_contains("will be replaced").is_some());
    assert_eq!(is_red(&bench), Vec::<String>::new());
    let editor = bench.harness.state_mut();
    (editor.model.session.dialog, editor.model.session.notes) = (None, Default::default());
    editor.model.session.notes.trouble("it was not saved");
    bench.harness.run_steps(4);
    assert_eq!(is_red(&bench), ["it was not saved"]);
}

#[test]
fn laboratories_ranges_are_for_round_brilliants_of_diamond_alone() {
    let mut bench = Bench::sized(Setup::default(), vec2(1200.0, 900.0));
    bench.harness.run_steps(3);
    let green = |bench: &Bench| {
        let good = theme::good(&bench.harness.ctx.global_style().visuals);
        let marks = [good, good.gamma_multiply(0.75)];
        let shapes = bench.harness.output().shapes.iter();
        let bands = shapes.filter(
            |clipped| matches!(&clipped.shape, egui::Shape::Rect(rect) if marks.contains(&rect.fill)),
        );
        (bands.count(), colours_of_texts(bench).iter().filter(|(colour, _)| *colour == good).count())
    };
    assert_eq!(green(&bench), (6, 0), "five bands and that of the total depth");
    bench.harness.state_mut().model.document.work.design.material = MaterialRef::Name("sapphire".into());
    bench.harness.run_steps(3);
    assert_eq!(green(&bench), (0, 0));
    bench.harness.state_mut().model.document.work.design.material = MaterialRef::Name("Diamond".into());
    bench.harness.run_steps(3);
    assert_eq!(green(&bench), (6, 0));
}

#[test]
fn a_stone_that_is_not_round_has_length_and_width_and_a_tier_its_distance_in_mm() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oblong.asc");
    let text = "GemCad 5.0\ng 96 0.0\ny 2 y\nI 1.76\nH An oblong\na -90 1.25 24 n G1 72\na -90 1 96 n G2 48\n\
                a -43 0.9 96 n P1 24 48 72\na 35 0.8 96 n C1 24 48 72\na 0 0.45 0 n T\n";
    std::fs::write(&path, text).unwrap();
    let mut bench = Bench::sized(Setup { file: Some(path), ..Setup::default() }, vec2(1200.0, 900.0));
    bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
    let size = |bench: &Bench| {
        let specimen = bench.editor().model.document.specimen();
        let (low, high) = specimen.stone().unwrap().polytope.bounds();
        let across = (high - low).truncate() * specimen.unit_mm();
        [across.max_element(), across.min_element()]
    };
    let is = |found: [f64; 2], wanted: [f64; 2]| (0..2).all(|k| (found[k] - wanted[k]).abs() < 1e-9);
    assert!(bench.harness.query_by_label("Diameter").is_none());
    bench.type_number("Width", "8");
    assert!(is(size(&bench), [10.0, 8.0]), "{:?}", size(&bench));
    bench.type_number("Length", "5");
    assert!(is(size(&bench), [5.0, 4.0]), "{:?}", size(&bench));
    let value = |bench: &Bench, name: &str| {
        let field = bench.harness.get_by_role_and_label(Role::SpinButton, name);
        field.accesskit_node().value().unwrap_or_default()
    };
    assert!(value(&bench, "Width").starts_with("4.0") && value(&bench, "Width").ends_with(" mm"));
    let distance = value(&bench, "G2 · 2 Distance");
    assert!(distance.starts_with("2.0") && distance.ends_with(" mm"), "{distance}");
    bench.type_number("G2 · 2 Distance", "2.25");
    assert!(is(size(&bench), [5.0, 4.5]), "{:?}", size(&bench));
}

#[test]
fn a_stone_of_a_bare_index_has_a_weight_once_its_density_is_set() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bare.toml");
    let first = Document::first().unwrap().work.design;
    let bare = Design { material: MaterialRef::Index(1.54), ..first };
    std::fs::write(&path, cut_file::write(&bare)).unwrap();
    let mut bench = Bench::sized(Setup { file: Some(path.clone()), ..Setup::default() }, vec2(1200.0, 900.0));
    bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
    assert!(bench.harness.query_by_role_and_label(Role::SpinButton, "Weight").is_none());
    bench.type_number("Density", "2.65");
    let carats = bench.editor().model.document.specimen().carats().unwrap();
    assert!((bench.editor().model.document.specimen().medium(589.3).index - 1.54).abs() < 1e-12);
    bench.type_number("Weight", "2");
    assert!((bench.editor().model.document.specimen().carats().unwrap() - 2.0).abs() < 1e-9 && carats != 2.0);
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::S);
    bench.wait(|editor| !editor.model.document.is_changed());
    assert_eq!(design_file::read(&path).unwrap().design, bench.editor().model.document.work.design);
    // A material of the library has a density of its own.
    bench.harness.state_mut().model.document.work.design.material = MaterialRef::Name("diamond".into());
    bench.harness.run_steps(3);
    assert!(bench.harness.query_by_role_and_label(Role::SpinButton, "Density").is_none());
}

/// Returns the side of a pixel in the first view, in girdle radii, and the point of the image plane at the view's centre.
fn film(bench: &Bench) -> (f64, glam::DVec2) {
    let shot = &bench.editor().model.session.ordered.shots[0].1;
    (shot.film.pixel, shot.film.centre)
}

#[test]
fn a_stone_keeps_its_scale_while_one_number_changes() {
    let mut bench = Bench::with(Setup { file: Some("pill".into()), ..Setup::default() });
    bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
    bench.leave_one();
    bench.harness.run_steps(3);
    let before = film(&bench);
    let width = bench.harness.get_by_role_and_label(Role::SpinButton, "Width").rect();
    assert!(width.width() > 0.0);
    let reach = bench.editor().model.document.specimen().reach;
    bench.type_number("Length", "80");
    bench.harness.run_steps(3);
    assert_ne!(bench.editor().model.document.specimen().reach, reach, "the stone is another");
    assert_eq!(film(&bench), before, "its scale is not");
    bench.harness.key_press(egui::Key::Num0);
    bench.harness.run_steps(3);
    assert!(film(&bench).0 < before.0, "fitted anew, it is larger");
}

#[test]
fn a_diagram_is_dark_in_the_dark_and_light_in_the_light() {
    for (theme, is_dark) in [(egui::ThemePreference::Dark, true), (egui::ThemePreference::Light, false)] {
        let mut workspace = Bench::small();
        workspace.panes[1].shows = Shows::Diagram;
        let mut bench = Bench::with(Setup { workspace, ..Setup::default() });
        bench.harness.ctx.set_theme(theme);
        bench.harness.run_steps(3);
        bench.look();
        let picture = bench.picture(1);
        let light = picture.iter().filter(|p| p[0] > 200).count() as f64 / picture.len() as f64;
        assert_eq!(light < 0.2, is_dark, "{theme:?}: {light} of it is light");
    }
}
