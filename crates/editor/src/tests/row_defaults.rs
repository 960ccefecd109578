//! Tests of rows: each change is one step of undo, and a double click sets the default.

use super::light_and_glass::pick;
use super::*;
use brillianteer_scene::{LOOK_NUMBERS, Look, Smoothing, Tone};
use brillianteer_session::model::{
    action::{Edit, FileAction, ViewAction},
    command::Command,
    dialog::Then,
    render_settings::RenderSettings,
    update,
    work::Work,
};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Role};

/// Returns the names of all fields for numbers in sight, and the value of each.
fn numbers(bench: &Bench) -> Vec<(String, f64)> {
    let fields = bench.harness.query_all_by_role(Role::SpinButton);
    let number = |node: egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        Some((node.label()?, node.numeric_value()?))
    };
    fields.filter_map(number).collect()
}

fn number(bench: &Bench, name: &str) -> f64 {
    bench.field(Role::SpinButton, name).accesskit_node().numeric_value().unwrap()
}

fn work(bench: &Bench) -> Work {
    bench.editor().model.document.work.clone()
}

fn undo(bench: &mut Bench) {
    bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    bench.harness.run_steps(3);
}

pub fn double_click(bench: &mut Bench, at: Pos2) {
    bench.harness.hover_at(at);
    bench.harness.run_steps(2);
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        bench.harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
        bench.harness.run_steps(2);
    }
    // The first click could have been followed by another.
    bench.harness.run_steps(30);
}

/// Clicks the name of the row of a field twice; a heading may have the same name.
pub fn double_click_name(bench: &mut Bench, role: Role, name: &str) {
    bench.field(role, name).scroll_to_me();
    bench.harness.run_steps(SCROLLED);
    let row = bench.field(role, name).rect();
    let names = bench.harness.query_all_by_role_and_label(Role::Label, name).map(|label| label.rect());
    let label = names.into_iter().find(|label| label.y_range().contains(row.center().y)).unwrap();
    double_click(bench, label.left_center() + egui::vec2(8.0, 0.0));
}

/// Changes each number of a document, undoes that, changes it again and resets it, and returns how many there are.
fn assert_rows(bench: &mut Bench) -> usize {
    // The angle of view is a step of the views, and a number that is not known has no default.
    let is_meant = |(name, value): &(String, f64)| name != "View angle" && value.is_finite();
    let all: Vec<_> = numbers(bench).into_iter().filter(is_meant).collect();
    for (name, value) in &all {
        let before = work(bench);
        let is_least = *value == 0.0 || name == "Copies";
        let changed = if is_least { value + 1.0 } else { value * 0.93 };
        let changed = if *value == value.round() && value.abs() >= 3.0 { changed.floor() } else { changed };
        bench.type_number(name, &format!("{changed:.4}"));
        assert!(work(bench) != before, "{name}: {value} to {changed}");
        undo(bench);
        assert!(work(bench) == before, "{name}: undo restores everything");
        bench.type_number(name, &format!("{changed:.4}"));
        double_click_name(bench, Role::SpinButton, name);
        assert!(
            (number(bench, name) - value).abs() < 1e-4 * value.abs().max(1.0),
            "{name}: {}",
            number(bench, name)
        );
        undo(bench);
        undo(bench);
        assert!(work(bench) == before, "{name}: two steps lead back");
    }
    all.len()
}

#[test]
fn each_number_of_a_cut_and_of_its_light_is_undone_and_reset() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1200.0, 900.0));
    bench.change_look(|look| look.background = Some("page".into()));
    bench.harness.state_mut().act(ViewAction::Show(0, Shows::LiquidGlass));
    bench.harness.run_steps(3);
    let count = assert_rows(&mut bench);
    assert!(count > 25, "{count}");
}

#[test]
fn each_number_of_a_scene_of_glass_is_undone_and_reset_to_that_of_its_preset() {
    let mut bench = Bench::sized(
        Setup { file: Some("subtle-pill".into()), ..Setup::default() },
        egui::vec2(1200.0, 900.0),
    );
    bench.harness.run_steps(3);
    assert!(assert_rows(&mut bench) > 12);
    bench.type_number("Strength", "0.5");
    bench.type_number("Exposure", "2");
    pick(&mut bench, "Background", "city");
    bench.click("Reset light");
    let first = bench.editor().model.document.first_settings().clone();
    assert_eq!(
        (work(&bench).settings, first.look.strength, first.look.background.clone()),
        (first.clone(), 0.035, Some("page".into()))
    );
    undo(&mut bench);
    assert_eq!(work(&bench).settings.look.background, Some("city".into()));
}

#[test]
fn each_choice_is_undone_and_reset() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1200.0, 900.0));
    bench.harness.run_steps(3);
    for (row, entry) in [
        ("Material", "sapphire"),
        ("Light", "office"),
        ("Light axis", "up"),
        ("Wavelengths", "64"),
        ("Background", "two colours"),
        ("Smoothing", "FXAA"),
    ] {
        let before = work(&bench);
        pick(&mut bench, row, entry);
        let after = work(&bench);
        assert!(after != before, "{row}");
        undo(&mut bench);
        assert!(work(&bench) == before, "{row}");
        bench.harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
        bench.harness.run_steps(3);
        assert!(work(&bench) == after, "{row}");
        let shown = bench.field(Role::ComboBox, row).accesskit_node().value();
        assert!(shown.is_none_or(|shown| shown == entry), "{row} shows its entry in words");
        double_click_name(&mut bench, Role::ComboBox, row);
        assert!(work(&bench) == before, "{row}");
    }
}

#[test]
fn a_double_click_on_a_slider_is_one_step() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1200.0, 900.0));
    bench.type_number("Exposure", "2");
    let before = work(&bench);
    bench.field(Role::Slider, "Exposure").scroll_to_me();
    bench.harness.run_steps(SCROLLED);
    let rect = bench.field(Role::Slider, "Exposure").rect();
    double_click(&mut bench, rect.left_center() + egui::vec2(12.0, 0.0));
    assert_eq!(work(&bench).settings.look.exposure, 0.0);
    undo(&mut bench);
    assert!(work(&bench) == before, "the first click is no step of its own");
}

/// Every change of a setting that a picture is made with: each number of a look by its row, and each of the rest.
fn changes() -> Vec<RenderSettings> {
    let usual = RenderSettings::default();
    let of_look = |look: Look| RenderSettings { look, ..usual.clone() };
    let number = |row: &&'static brillianteer_base::NumberRow<Look>| {
        let mut look = usual.look.clone();
        let [least, most] = row.span;
        let now = (row.get)(&look);
        (row.set)(&mut look, if now == Some(most) { least } else { most });
        of_look(look)
    };
    let other = |change: fn(&mut Look)| {
        let mut look = usual.look.clone();
        change(&mut look);
        of_look(look)
    };
    let rest: [fn(&mut Look); 5] = [
        |look| look.light = "office".into(),
        |look| look.light_upright = true,
        |look| look.tone = Tone::Filmic,
        |look| look.background = Some("grid".into()),
        |look| look.smoothing = Smoothing::Fxaa,
    ];
    let liquid = brillianteer_session::liquid::Liquid { frost: 40.0, ..Default::default() };
    let liquid = RenderSettings { liquid, ..usual.clone() };
    LOOK_NUMBERS.iter().map(number).chain(rest.map(other)).chain([liquid]).collect()
}

/// Changes the settings of a model to these.
fn set(model: &mut Model, settings: &RenderSettings) {
    let RenderSettings { look, liquid } = settings.clone();
    if look != model.document.work.settings.look {
        update(model, Edit::Look(Box::new(look)).into());
    }
    if liquid != model.document.work.settings.liquid {
        update(model, Edit::Liquid(Box::new(liquid)).into());
    }
}

#[test]
fn each_setting_is_a_step_of_undo_and_outlives_no_document() {
    for changed in changes() {
        let mut model = Model::new(Workspace::default()).unwrap();
        let first = model.document.work.clone();
        assert_ne!(changed, first.settings);
        set(&mut model, &changed);
        assert_eq!(model.document.work.settings, changed);
        update(&mut model, Command::Undo.into());
        assert_eq!(model.document.work, first, "{changed:?}");
        update(&mut model, Command::Redo.into());
        assert_eq!(model.document.work.settings, changed);
        update(&mut model, Command::ResetLight.into());
        let is_light = changed.liquid == first.settings.liquid && changed.look.smoothing == Smoothing::None;
        assert_eq!(model.document.work.settings == first.settings, is_light, "{changed:?}");
        for next in ["modern-ideal", "subtle-pill"] {
            let is_scene = next == "subtle-pill";
            let then = if is_scene { Then::Preset(next.to_owned()) } else { Then::Library(next.to_owned()) };
            set(&mut model, &changed);
            update(&mut model, FileAction::Ask(then).into());
            let first = model.document.first_settings();
            assert_eq!(model.document.work.settings, *first, "{changed:?} in {next}");
        }
    }
    assert_eq!(
        RenderSettings::default(),
        *Model::new(Workspace::default()).unwrap().document.first_settings()
    );
}

#[test]
fn a_field_says_what_it_means_and_no_tooltip_stays_over_a_dialog() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1200.0, 700.0));
    bench.harness.ctx.all_styles_mut(|style| style.interaction.tooltip_delay = 0.0);
    bench.harness.run_steps(3);
    let meaning = "The angle between the bezels";
    for (role, name) in [(Role::SpinButton, "Crown angle"), (Role::Slider, "Crown angle")] {
        let at = bench.field(role, name).rect().center();
        for x in [0.0, 1.0, 2.0] {
            bench.harness.hover_at(at + egui::vec2(x, 0.0));
            bench.harness.step();
        }
        (0..40).for_each(|_| bench.harness.step());
        assert!(bench.harness.query_by_label_contains(meaning).is_some(), "{role:?}");
        assert!(bench.harness.query_by_label_contains("A double click sets 34.5").is_some(), "{role:?}");
    }
    bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::E);
    bench.harness.run_steps(4);
    assert!(bench.editor().model.session.dialog.is_some());
    assert!(bench.harness.query_by_label_contains(meaning).is_none());
}

#[test]
fn a_note_of_what_was_saved_ends_with_the_next_change() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, brillianteer_files::library::cut("tolkowsky").unwrap()).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path), ..Setup::default() });
    bench.wait(|editor| editor.model.document.path().is_some());
    bench.type_number("Table", "57");
    bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    bench.wait(|editor| !editor.model.document.is_changed());
    assert!(bench.harness.query_by_label_contains("Saved ").is_some());
    bench.type_number("Table", "58");
    assert!(bench.harness.query_by_label_contains("Saved ").is_none());
}

#[test]
fn menus_mark_how_many_views_are_in_sight() {
    let mut model = Model::new(Workspace::default()).unwrap();
    let marked =
        |model: &Model| [Command::One, Command::Two, Command::Four].map(|command| model.is_chosen(command));
    assert_eq!(marked(&model), [false, false, true]);
    update(&mut model, ViewAction::Enlarge(2).into());
    assert_eq!(marked(&model), [true, false, false], "a view is alone");
}

#[test]
fn what_follows_from_an_impossible_number_is_not_known() {
    let mut bench = Bench::new();
    let depth = |bench: &Bench| bench.field(Role::SpinButton, "Total depth").accesskit_node().numeric_value();
    let is_known = |bench: &Bench| depth(bench).is_some_and(|depth| (50.0..70.0).contains(&depth));
    assert!(is_known(&bench), "{:?}", depth(&bench));
    bench.type_number("Crown angle", "120");
    bench.harness.run_steps(2);
    assert!(bench.editor().model.document.fault().is_some());
    assert!(!depth(&bench).is_some_and(f64::is_finite), "{:?}", depth(&bench));
    bench.type_number("Crown angle", "34");
    bench.harness.run_steps(2);
    assert!(is_known(&bench), "{:?}", depth(&bench));
}
