//! Tests of the rows for light, material and motion, found by their accessible names as a person with a screen reader finds them.

use super::Bench;
use super::copies::bench;
use crate::app::model::workspace::Workspace;
use crate::app::studio::{Shot, Smoothing};
use crate::cut::MaterialRef;
use crate::optics::{Absorption, line};
use crate::picture::Bloom;
use crate::scene::LIGHTS;
use egui::{Key, Modifiers, Role};
use egui_kittest::kittest::Queryable;

fn workspace(bench: &Bench) -> &Workspace {
    &bench.editor().model.workspace
}

/// Returns the last order of the render.
fn shot(bench: &Bench) -> &Shot {
    &bench.editor().model.session.ordered.shots[0].1
}

/// Chooses an entry of the list of this name.
pub(super) fn pick(bench: &mut Bench, name: &str, entry: &str) {
    bench.harness.get_by_role_and_label(Role::ComboBox, name).scroll_to_me();
    bench.harness.run_steps(super::SCROLLED);
    bench.harness.get_by_role_and_label(Role::ComboBox, name).click();
    bench.harness.run_steps(4);
    bench.harness.get_by_label(entry).scroll_to_me();
    bench.harness.run_steps(super::SCROLLED);
    bench.click(entry);
}

#[test]
fn rows_of_light_change_what_renders_are_ordered_to_show() {
    let mut bench = bench("subtle-pill");
    bench.type_number("Light turn", "35");
    bench.type_number("Most bounces", "4");
    bench.type_number("Glow", "0.4");
    bench.type_number("Distance", "80");
    assert_eq!((shot(&bench).light_turn, shot(&bench).bounces, shot(&bench).glow), (35.0, 4, 0.4));
    assert_eq!(workspace(&bench).behind_mm, Some(80.0));
    let near = shot(&bench).view.projection;
    bench.type_number("View angle", "30");
    assert_ne!(shot(&bench).view.projection, near);
    pick(&mut bench, "Light axis", "up");
    assert!(shot(&bench).light_upright);
    bench.type_number("Exposure", "1.5");
    bench.type_number("Strength", "0.5");
    assert_eq!((shot(&bench).exposure, shot(&bench).strength), (1.5, 0.5));
    pick(&mut bench, "Wavelengths", "32");
    assert_eq!((workspace(&bench).wavelengths, shot(&bench).bands), (32, 32));
    pick(&mut bench, "Background", "city");
    assert_eq!(shot(&bench).behind.as_ref().map(ToString::to_string), Some("city".to_owned()));
    pick(&mut bench, "Smoothing", "temporal");
    bench.type_number("Newest part", "0.25");
    assert_eq!(shot(&bench).smoothing, Smoothing::Temporal { newest: 0.25 });
    assert_ne!(Workspace::default().glow, 0.4);
    assert_eq!(Workspace::default().glow, Bloom::default().strength);
}

#[test]
fn rows_of_the_material_make_one_of_the_users_own() {
    let mut bench = bench("subtle-pill");
    let before = bench.editor().model.document.work.design.material.clone();
    let material = |bench: &Bench| match &bench.editor().model.document.work.design.material {
        MaterialRef::Custom(own) => own.clone(),
        other => panic!("{other:?} is no material of one's own"),
    };
    bench.type_number("Index", "1.7");
    let index = material(&bench).index(line::HELIUM_D);
    // The law of an Abbe number has its index at 587.6 nm to four decimals.
    assert!((index - 1.7).abs() < 1e-4, "{index}");
    bench.type_number("Abbe number", "20");
    assert!((material(&bench).dispersion.abbe_number().unwrap() - 20.0).abs() < 0.05);
    bench.type_number("Dispersion B-G", "0.05");
    assert!((material(&bench).dispersion.dispersion_b_g() - 0.05).abs() < 1e-4);
    // The picker of the colour is there by its name; a coloured glass has a length in which half of the light is lost.
    let picker = bench.harness.query_all_by_label("Body colour").count();
    assert!(
        picker > 0 && bench.harness.query_by_role_and_label(Role::SpinButton, "Half-light path").is_none()
    );
    let colour = Absorption::of_colour(glam::DVec3::new(0.2, 0.5, 0.9), 40.0).unwrap();
    let mut own = material(&bench);
    own.absorption = [colour.clone(), colour];
    bench.harness.state_mut().act(crate::app::model::action::Edit::Material(MaterialRef::Custom(own)));
    bench.harness.run_steps(3);
    bench.type_number("Half-light path", "12");
    assert!((material(&bench).half_length().unwrap() - 12.0).abs() < 1e-6);
    // Further undoing changes nothing.
    for _ in 0..9 {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        bench.harness.run_steps(3);
    }
    assert!(bench.editor().model.document.work.design.material == before, "undone");
}

#[test]
fn a_gem_has_the_same_rows_under_a_heading() {
    let mut bench = bench("tolkowsky");
    assert!(bench.harness.query_by_role_and_label(Role::SpinButton, "Index").is_none(), "folded at first");
    let before = bench.editor().model.document.work.design.material.clone();
    bench.harness.get_by_label("Index and colour").scroll_to_me();
    bench.harness.run_steps(super::SCROLLED);
    bench.click("Index and colour");
    bench.harness.run_steps(super::SCROLLED);
    bench.type_number("Index", "1.9");
    bench.type_number("Abbe number", "40");
    let MaterialRef::Custom(own) = bench.editor().model.document.work.design.material.clone() else {
        panic!("it is no material of one's own")
    };
    assert!((own.index(line::HELIUM_D) - 1.9).abs() < 1e-4);
    assert!((own.dispersion.abbe_number().unwrap() - 40.0).abs() < 0.05);
    for _ in 0..2 {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        bench.harness.run_steps(3);
    }
    assert!(bench.editor().model.document.work.design.material == before, "undone");
}

#[test]
fn another_light_is_drawn_at_random_and_undone() {
    let mut bench = bench("subtle-pill");
    let before = bench.editor().model.document.work.light.clone();
    let mut seen = vec![before.clone()];
    for _ in 0..4 {
        pick(&mut bench, "Light", "Another at random");
        let now = bench.editor().model.document.work.light.clone();
        assert!(LIGHTS.contains(&now.as_str()) && Some(&now) != seen.last(), "{now} after {seen:?}");
        seen.push(now);
    }
    for _ in 0..4 {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        bench.harness.run_steps(3);
    }
    assert_eq!(bench.editor().model.document.work.light, before);
    bench.choose("View", "Another light");
    assert_ne!(bench.editor().model.document.work.light, before);
    pick(&mut bench, "Light", "office");
    assert_eq!(bench.editor().model.document.work.light, "office");
}
