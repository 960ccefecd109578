//! Tests of the keyboard in rows: Tab goes from number to number, and keys of the view do not act while a row has the focus.

use super::*;
use brillianteer_cut::Crown;
use egui::{Event, Key, Modifiers, Role};

/// Presses a key, and gives the window the frames in which the focus moves.
fn press(bench: &mut Bench, modifiers: Modifiers, key: Key) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(6);
}

/// Types a text as a keyboard does: each letter is a key and a text.
fn type_text(bench: &mut Bench, text: &str) {
    for letter in text.chars() {
        if let Some(key) = Key::from_name(&letter.to_string()) {
            bench.harness.key_press(key);
        }
        bench.harness.event(Event::Text(letter.to_string()));
        bench.harness.run_steps(2);
    }
}

fn focus(bench: &mut Bench, role: Role, name: &str) {
    bench.field(role, name).focus();
    bench.harness.run_steps(4);
}

/// Returns whether the field of this role and name has the focus.
fn has_focus(bench: &Bench, role: Role, name: &str) -> bool {
    bench.field(role, name).is_focused()
}

fn crown_angle(bench: &Bench) -> f64 {
    match bench.brilliant().crown {
        Crown::Angle(angle) => angle,
        Crown::Height(_) => panic!("the crown's angle is held"),
    }
}

fn layout(bench: &Bench) -> (PaneLayout, Vec<usize>) {
    let workspace = &bench.editor().model.workspace;
    (workspace.layout, workspace.shown())
}

#[test]
fn tab_goes_from_number_to_number_and_digits_change_no_layout() {
    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    let before = layout(&bench);
    focus(&mut bench, Role::SpinButton, "Table");
    type_text(&mut bench, "57");
    press(&mut bench, Modifiers::NONE, Key::Tab);
    assert!(has_focus(&bench, Role::SpinButton, "Crown angle"));
    type_text(&mut bench, "34,25");
    press(&mut bench, Modifiers::NONE, Key::Tab);
    assert!(has_focus(&bench, Role::SpinButton, "Crown height"), "Tab passes over the padlock");
    assert!((bench.brilliant().table - 57.0).abs() < 1e-9);
    assert!((crown_angle(&bench) - 34.25).abs() < 1e-9);
    assert_eq!(layout(&bench), before);
    for name in ["Crown angle", "Table"] {
        press(&mut bench, Modifiers::SHIFT, Key::Tab);
        assert!(has_focus(&bench, Role::SpinButton, name), "{name}");
    }
    type_text(&mut bench, "99");
    press(&mut bench, Modifiers::NONE, Key::Escape);
    assert!((bench.brilliant().table - 57.0).abs() < 1e-9, "Escape takes back what was typed");
}

#[test]
fn what_comes_within_one_frame_goes_to_the_fields_in_which_it_was_typed() {
    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    focus(&mut bench, Role::SpinButton, "Table");
    let key =
        |key, modifiers| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    let text = |text: &str| Event::Text(text.to_owned());
    let (tab, back) = (key(Key::Tab, Modifiers::NONE), key(Key::Tab, Modifiers::SHIFT));
    let typed = vec![
        text("58"),
        tab.clone(),
        text("33.5"),
        tab,
        back,
        text("33.75"),
        key(Key::Enter, Modifiers::NONE),
    ];
    bench.at_once(typed);
    bench.harness.run_steps(12);
    assert!((bench.brilliant().table - 58.0).abs() < 1e-9, "{}", bench.brilliant().table);
    assert!((crown_angle(&bench) - 33.75).abs() < 1e-9, "{}", crown_angle(&bench));
}

#[test]
fn a_number_typed_over_a_slider_goes_to_its_field_and_no_key_of_the_view_acts() {
    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    let (before, eye) = (layout(&bench), bench.editor().model.workspace.eye);
    for (begin, expected) in [("4", 4.0), (".5", 0.5), (",25", 0.25), ("-1,5", -1.5), ("1", 1.0)] {
        focus(&mut bench, Role::Slider, "Exposure");
        type_text(&mut bench, begin);
        press(&mut bench, Modifiers::NONE, Key::Enter);
        let exposure = bench.editor().model.document.work.settings.look.exposure;
        assert!((exposure - expected).abs() < 1e-9, "{begin}: {exposure}");
    }
    focus(&mut bench, Role::Slider, "Exposure");
    for key in [Key::B, Key::X, Key::E, Key::Num2, Key::Num1] {
        focus(&mut bench, Role::Slider, "Exposure");
        press(&mut bench, Modifiers::NONE, key);
    }
    press(&mut bench, Modifiers::SHIFT, Key::T);
    focus(&mut bench, Role::ComboBox, "Light");
    press(&mut bench, Modifiers::NONE, Key::Num1);
    assert_eq!((layout(&bench), bench.editor().model.workspace.eye), (before, eye));
    assert!(!bench.editor().model.workspace.strongest);
    press(&mut bench, Modifiers::NONE, Key::Escape);
    press(&mut bench, Modifiers::NONE, Key::Num1);
    assert_eq!(layout(&bench).0, PaneLayout::One, "without a focus, keys are those of the view");
}

#[test]
fn a_screen_reader_reaches_slider_and_padlock_and_return_opens_the_number() {
    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    focus(&mut bench, Role::Slider, "Crown angle");
    assert!(has_focus(&bench, Role::Slider, "Crown angle"));
    press(&mut bench, Modifiers::NONE, Key::ArrowRight);
    assert!(has_focus(&bench, Role::Slider, "Crown angle") && crown_angle(&bench) > 34.5);
    press(&mut bench, Modifiers::NONE, Key::Enter);
    assert!(has_focus(&bench, Role::SpinButton, "Crown angle"));
    focus(&mut bench, Role::CheckBox, "Hold crown height");
    assert!(has_focus(&bench, Role::CheckBox, "Hold crown height"));
    press(&mut bench, Modifiers::NONE, Key::Tab);
    assert!(has_focus(&bench, Role::SpinButton, "Pavilion angle"));
    focus(&mut bench, Role::SpinButton, "Crown height");
    bench.harness.event(Event::Text(" ".to_owned()));
    bench.harness.run_steps(3);
    assert!(matches!(bench.brilliant().crown, Crown::Height(_)), "Space holds the number");
}

#[test]
fn tab_goes_on_from_a_number_that_return_has_ended() {
    let mut bench = Bench::new();
    bench.type_number("Table", "56");
    press(&mut bench, Modifiers::NONE, Key::Tab);
    assert!(has_focus(&bench, Role::SpinButton, "Crown angle"));
}
