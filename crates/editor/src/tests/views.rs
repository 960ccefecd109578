//! Tests of the labels of views, and of navigation in them; and a test that unchanged views are not traced again.

use super::*;
use crate::views::modes::Mode;
use brillianteer_scene::{LIGHTS, Projection};
use brillianteer_session::model::workspace::Pane;
use egui::{Key, Modifiers, PointerButton, Role};

/// Opens a wide window with one view.
fn alone(shows: Shows) -> Bench {
    let pane = Pane { shows, ..Workspace::default().panes[0] };
    let workspace = Workspace { layout: PaneLayout::One, panes: [pane; 4], ..Workspace::default() };
    Bench::sized(Setup { workspace, ..Setup::default() }, egui::vec2(1500.0, 420.0))
}

fn projection(bench: &Bench, pane: usize) -> Projection {
    let slot = (pane, Which::Present);
    bench.editor().model.session.ordered.shots.iter().find(|(at, _)| *at == slot).unwrap().1.view.projection
}

#[test]
fn modes_are_named_in_the_head_of_a_view_and_a_click_ends_each() {
    let mut bench = alone(Shows::Aset);
    bench.harness.run_steps(2);
    for key in [Key::W, Key::P, Key::E, Key::X] {
        bench.harness.key_press(key);
    }
    bench.harness.state_mut().model.document.work.settings.look.head = Some(12.0);
    bench.harness.run_steps(2);
    bench.click("Linked");
    let names =
        ["unlinked ×", "perspective ×", "eye tilts ×", "wireframe ×", "strongest exits ×", "head 12.0° ×"];
    for name in names {
        bench.click(name);
        assert!(bench.harness.query_by_label(name).is_none(), "{name} does not end");
    }
    assert!(Mode::of(&bench.editor().model, 0).is_empty());
    let workspace = &bench.editor().model.workspace;
    assert!(workspace.panes[0].own.is_none() && !workspace.eye.eye_leans && workspace.overlay.is_none());
    assert!(
        projection(&bench, 0) == Projection::Orthographic
            && bench.editor().model.document.work.settings.look.head.is_none()
    );
}

#[test]
fn a_mixture_of_refraction_is_named_over_its_render() {
    let mut bench = alone(Shows::Render);
    let settings = &mut bench.harness.state_mut().model.document.work.settings;
    (settings.look.background, settings.look.strength) = (Some("page".into()), 0.25);
    bench.harness.run_steps(2);
    bench.click("strength 0.250 ×");
    assert_eq!(bench.editor().model.document.work.settings.look.strength, 1.0);
}

#[test]
fn modes_that_a_narrow_view_has_no_room_for_are_in_a_menu() {
    // Between both panels a view is some 150 points wide.
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1000.0, 420.0));
    for key in [Key::W, Key::P, Key::X] {
        bench.harness.key_press(key);
    }
    bench.harness.run_steps(3);
    let modes = Mode::of(&bench.editor().model, 0).len();
    let named = bench.harness.query_all_by_label_contains("×").count();
    assert!(modes == 3 && named < modes, "{named} fit");
    bench.harness.query_all_by_label_contains("+").next().unwrap().click();
    bench.harness.run_steps(4);
    bench.click("strongest exits ×");
    assert!(!bench.editor().model.workspace.strongest);
}

#[test]
fn perspective_is_of_one_view_and_what_becomes_a_scope_is_seen_along_parallel_rays() {
    let mut workspace = Bench::small();
    workspace.panes[0].shows = Shows::Render;
    let mut bench = Bench::with(Setup { workspace, ..Setup::default() });
    bench.harness.run_steps(2);
    bench.harness.key_press(Key::P);
    bench.harness.run_steps(2);
    assert!(matches!(projection(&bench, 0), Projection::Perspective { .. }));
    assert_eq!(projection(&bench, 1), Projection::Orthographic, "the linked scope stays as it was");
    bench.harness.state_mut().model.workspace.show(0, Shows::Aset);
    bench.harness.run_steps(2);
    assert_eq!(projection(&bench, 0), Projection::Orthographic);
    bench.harness.key_press(Key::P);
    bench.harness.run_steps(2);
    assert!(matches!(projection(&bench, 0), Projection::Perspective { .. }), "it was asked for here");
    bench.harness.state_mut().model.workspace.show(0, Shows::Contrast);
    for _ in 0..2 {
        bench.harness.run_steps(2);
        assert_eq!(projection(&bench, 0), Projection::Orthographic, "exact beams trace no perspective");
        bench.harness.key_press(Key::P);
    }
}

#[test]
fn views_and_layout_go_back_to_what_they_were_at_first() {
    // High enough to show the whole menu.
    let setup = Setup { workspace: Bench::small(), ..Setup::default() };
    let mut bench = Bench::sized(setup, egui::vec2(1000.0, 900.0));
    let width = |bench: &Bench| bench.field(Role::Slider, "Table").rect().right();
    bench.harness.run_steps(2);
    let before = width(&bench);
    bench.harness.get_all_by_label("Linked").next().unwrap().click();
    for key in [Key::W, Key::P, Key::F, Key::D, Key::H] {
        bench.harness.key_press(key);
    }
    bench.harness.run_steps(3);
    bench.choose("View", "Reset view");
    let first = Workspace::default();
    let workspace = &bench.editor().model.workspace;
    assert_eq!((workspace.eye, workspace.overlay.clone(), workspace.panes[0].own), (first.eye, None, None));
    assert_eq!(
        (workspace.layout, workspace.panes[0].shows),
        (PaneLayout::Two, Shows::Aset),
        "the layout stays"
    );
    bench.choose("View", "Reset layout");
    let workspace = &bench.editor().model.workspace;
    assert_eq!((workspace.layout, workspace.panes), (first.layout, first.panes));
    assert!(!workspace.hides_panels && (width(&bench) - before).abs() < 1.0);
    bench.harness.key_press(Key::Backspace);
    bench.harness.run_steps(2);
    assert_eq!(bench.editor().model.workspace.layout, PaneLayout::Two, "one step back undoes it");
}

#[test]
fn an_impossible_number_is_told_at_its_row_and_views_and_figures_say_which_stone_they_show() {
    let mut bench = Bench::new();
    bench.settle();
    let places = |bench: &Bench| -> Vec<egui::Rect> {
        ["Crown angle", "Crown height", "Table", "Exposure"]
            .map(|name| bench.field(Role::SpinButton, name).rect())
            .to_vec()
    };
    let before = places(&bench);
    bench.type_number("Crown angle", "89");
    let said = bench.harness.get_by_label_contains("Crown angle: 89° is impossible").rect();
    let [angle, height] =
        ["Crown angle", "Crown height"].map(|name| bench.field(Role::SpinButton, name).rect());
    assert!(said.top() > angle.center().y && said.bottom() < height.center().y, "it stands below its row");
    assert!(bench.harness.query_by_label_contains("it can be at most 84.").is_some());
    for (now, before) in places(&bench).iter().zip(&before) {
        assert_eq!(now.x_range(), before.x_range(), "no row is pushed aside");
    }
    bench.settle();
    assert_eq!(bench.harness.query_all_by_label("last possible stone").count(), 2);
    assert!(bench.harness.query_by_label_contains("figures of the last possible stone").is_some());
    assert!(bench.harness.query_by_label_contains("final").is_none());
    bench.choose("Edit", "Undo");
    bench.settle();
    assert!(bench.harness.query_by_label("last possible stone").is_none());
    assert_eq!(places(&bench), before);
}

#[test]
fn a_name_and_an_error_trace_nothing_anew() {
    let mut bench = Bench::new();
    bench.settle();
    let traced = bench.editor().studio.traced();
    assert!(traced > 4);
    bench.field(Role::TextInput, "Name").focus();
    bench.harness.run_steps(2);
    bench.harness.event(egui::Event::Text(" the second".to_owned()));
    bench.settle();
    assert!(bench.editor().model.document.work.design.name.contains("the second"));
    assert_eq!(bench.editor().studio.traced(), traced, "a new name");
    bench.harness.state_mut().model.session.notes.trouble("something went wrong");
    bench.settle();
    assert!(bench.harness.query_by_label_contains("something went wrong").is_some());
    assert_eq!(bench.editor().studio.traced(), traced, "an error that comes");
    bench.click("Dismiss");
    bench.settle();
    assert_eq!(bench.editor().studio.traced(), traced, "an error that goes");
    bench.type_number("Table", "54");
    bench.settle();
    assert!(bench.editor().studio.traced() > traced, "another stone");
}

#[test]
fn exposure_and_overlays_of_a_render_are_made_of_the_light_that_was_traced() {
    let pane = Pane { shows: Shows::Render, ..Workspace::default().panes[0] };
    let workspace = Workspace { layout: PaneLayout::One, panes: [pane; 4], ..Workspace::default() };
    let mut bench = Bench::sized(Setup { workspace, ..Setup::default() }, egui::vec2(900.0, 300.0));
    bench.settle();
    let (traced, dark) = (bench.editor().studio.traced(), bench.picture(0));
    bench.harness.state_mut().model.document.work.settings.look.exposure = 1.5;
    bench.settle();
    let bright = bench.picture(0);
    assert_eq!(bench.editor().studio.traced(), traced, "another exposure");
    let sum = |picture: &[[u8; 4]]| picture.iter().map(|p| u64::from(p[1])).sum::<u64>();
    assert!(sum(&bright) > sum(&dark), "{} after {}", sum(&bright), sum(&dark));
    bench.harness.state_mut().model.workspace.toggle_overlay("wireframe");
    bench.settle();
    assert_eq!(bench.editor().studio.traced(), traced, "an overlay");
    assert_ne!(bench.picture(0), bright);
    bench.harness.state_mut().model.workspace.toggle_overlay("wireframe");
    bench.harness.state_mut().model.document.work.settings.look.exposure = 0.0;
    bench.settle();
    assert_eq!(bench.picture(0), dark, "it is the picture that there was");
}

#[test]
fn a_quick_drag_of_a_handle_is_not_lost() {
    let mut workspace = Bench::small();
    workspace.panes[1].shows = Shows::Profile;
    let mut bench = Bench::with(Setup { workspace, ..Setup::default() });
    bench.harness.run_steps(3);
    let before = bench.brilliant().derived().unwrap().pavilion_depth;
    let tip = bench.harness.get_by_label("Pavilion depth, percent").rect().center();
    let end = tip + egui::vec2(0.0, 14.0);
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    bench.at_once(vec![
        egui::Event::PointerMoved(tip),
        egui::Event::PointerButton { pos: tip, button, pressed: true, modifiers },
        egui::Event::PointerMoved(tip + egui::vec2(0.0, 9.0)),
        egui::Event::PointerMoved(end),
        egui::Event::PointerButton { pos: end, button, pressed: false, modifiers },
    ]);
    let after = bench.brilliant().derived().unwrap().pavilion_depth;
    assert!(after > before + 1.0, "from {before} to {after}");
}

#[test]
fn keys_that_other_programs_have() {
    let mut bench = Bench::new();
    bench.type_number("Table", "57");
    bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    bench.harness.run_steps(2);
    assert!(bench.brilliant().table < 56.0);
    bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    bench.harness.run_steps(2);
    assert!((bench.brilliant().table - 57.0).abs() < 1e-12);
    let key = Key::F11;
    let modifiers = Modifiers::NONE;
    let pressed = egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    bench.harness.input_mut().events.push(pressed);
    bench.harness.step();
    let commands = |bench: &Bench| -> Vec<egui::ViewportCommand> {
        bench.harness.output().viewport_output.values().flat_map(|v| v.commands.clone()).collect()
    };
    assert!(commands(&bench).contains(&egui::ViewportCommand::Fullscreen(true)));
}

#[cfg(not(target_os = "macos"))]
#[test]
fn alt_and_a_letter_open_a_menu_and_type_nothing() {
    let mut bench = Bench::new();
    bench.field(Role::TextInput, "Name").focus();
    bench.harness.run_steps(2);
    let name = bench.editor().model.document.work.design.name.clone();
    let (key, modifiers) = (Key::F, Modifiers::ALT);
    bench.at_once(vec![
        egui::Event::ModifiersChanged(modifiers),
        egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers },
        egui::Event::Text("f".to_owned()),
        egui::Event::Key { key, physical_key: None, pressed: false, repeat: false, modifiers },
        egui::Event::ModifiersChanged(Modifiers::NONE),
    ]);
    assert_eq!(bench.editor().model.document.work.design.name, name);
    assert!(bench.harness.query_by_label_contains("Save as…").is_some(), "the menu File is open");
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(20);
    assert!(bench.harness.query_by_label_contains("Save as…").is_none());
}

#[test]
fn every_light_can_be_clicked() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1000.0, 900.0));
    bench.harness.run_steps(2);
    bench.field(Role::ComboBox, "Light").scroll_to_me();
    bench.harness.run_steps(6);
    bench.field(Role::ComboBox, "Light").click();
    bench.harness.run_steps(6);
    let last = LIGHTS[LIGHTS.len() - 1];
    let at = bench.harness.get_by_label(last).rect().center();
    bench.click_at(at);
    assert_eq!(bench.editor().model.document.work.settings.look.light, last);
}

#[test]
fn what_a_row_means_is_told_over_its_words_beside_the_panel_and_not_while_something_is_typed() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1200.0, 700.0));
    bench.harness.ctx.all_styles_mut(|style| style.interaction.tooltip_delay = 0.0);
    bench.wait(|editor| editor.model.session.measured.figures.contains_key(&Which::Present));
    let hover = |bench: &mut Bench, at: egui::Pos2| {
        for x in [0.0, 1.0, 2.0] {
            bench.harness.hover_at(at + egui::vec2(x, 0.0));
            bench.harness.step();
        }
        (0..40).for_each(|_| bench.harness.step());
    };
    let row = bench.harness.get_by_label_contains("Red ").rect();
    hover(&mut bench, row.left_center() + egui::vec2(16.0, 0.0));
    let meaning = bench.harness.get_by_label_contains("where rooms are brightest").rect();
    assert!(meaning.right() <= row.left() + 1.0, "{meaning:?} covers {row:?}");
    let name = bench.harness.get_by_role_and_label(Role::Label, "Crown angle").rect();
    hover(&mut bench, name.center());
    let meaning = bench.harness.get_by_label_contains("The angle between the bezels").rect();
    let field = bench.field(Role::SpinButton, "Crown height").rect();
    assert!(meaning.left() >= field.right(), "{meaning:?} covers {field:?}");
    let field = bench.field(Role::SpinButton, "Crown height").rect();
    bench.click_at(field.center());
    hover(&mut bench, name.center());
    assert!(
        bench.harness.query_by_label_contains("The angle between the bezels").is_none(),
        "a number is being typed"
    );
}
