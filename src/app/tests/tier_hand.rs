//! A tier in the hand: dragged by a facet, stopped at corners, and cut to a corner that is picked.

use super::tiers::{reach, tiers};
use super::*;
use crate::cut::{Tier, TierCorner, Tiers};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use glam::{DMat2, DVec2};

/// The greatest distance between a tier and the corner that a meet brings it to, in parts of the largest distance.
const THERE: f64 = 2e-5;

/// Opens the first cut as tiers with the table tier selected, face up in a scope.
fn bench() -> Bench {
    let mut bench = Bench::sized(Setup::default(), vec2(1400.0, 900.0));
    bench.settle();
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    let middle = at(&bench, DVec2::ZERO);
    bench.click_at(middle);
    bench.settle();
    assert_eq!(table(&tiers(&bench)).name(), "T");
    bench
}

/// Returns the place in the window of a point of the image of the first view.
fn at(bench: &Bench, image: DVec2) -> Pos2 {
    let body = bench.harness.get_by_label("ASET picture").rect();
    let shots = &bench.editor().model.session.ordered.shots;
    let film = shots.iter().find(|(slot, _)| *slot == (0, Which::Present)).unwrap().1.film;
    let pixel = film.pixels_from_image(DMat2::IDENTITY).transform_point2(image);
    body.min + vec2(pixel.x as f32, pixel.y as f32)
}

/// Returns the points of the window for each unit of the design.
fn points_per_unit(bench: &Bench) -> f64 {
    let apart = at(bench, DVec2::X) - at(bench, DVec2::ZERO);
    f64::from(apart.x) * bench.editor().model.document.specimen().frame.scale
}

fn table_place(tiers: &Tiers) -> usize {
    tiers.tiers.iter().position(|tier| tier.angle == 0.0).unwrap()
}

fn table(tiers: &Tiers) -> &Tier {
    &tiers.tiers[table_place(tiers)]
}

fn press(bench: &mut Bench, pos: Pos2, pressed: bool, modifiers: Modifiers) {
    bench.harness.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
    bench.harness.step();
}

/// Presses the button at a point and moves the pointer, without releasing the button.
fn pull(bench: &mut Bench, from: Pos2, by: Vec2, modifiers: Modifiers) {
    bench.harness.hover_at(from);
    bench.harness.step();
    bench.harness.event(Event::ModifiersChanged(modifiers));
    press(bench, from, true, modifiers);
    for k in 1..=8 {
        bench.harness.hover_at(from + by * (k as f32 / 8.0));
        bench.harness.step();
    }
}

/// Drags from a point of the window, lets go, and releases the keys that were held.
fn drag(bench: &mut Bench, from: Pos2, by: Vec2, modifiers: Modifiers) {
    pull(bench, from, by, modifiers);
    press(bench, from + by, false, modifiers);
    bench.harness.event(Event::ModifiersChanged(Modifiers::NONE));
    bench.harness.run_steps(3);
}

/// Returns a corner that the table can be cut to, far enough from where it is.
fn another_corner(bench: &Bench) -> TierCorner {
    let tiers = tiers(bench);
    let (now, scale) = (table(&tiers).distance, points_per_unit(bench));
    let corners = tiers.tier_corners(table_place(&tiers));
    let is_apart = |corner: &&TierCorner| (15.0..60.0).contains(&((corner.distance - now).abs() * scale));
    corners.iter().find(is_apart).unwrap_or_else(|| panic!("{now} {corners:?}")).clone()
}

#[test]
fn a_facet_that_is_dragged_moves_its_tier_as_one_step() {
    let mut bench = bench();
    let before = tiers(&bench);
    let (from, scale) = (at(&bench, DVec2::new(0.1, 0.1)), points_per_unit(&bench));
    drag(&mut bench, from, vec2(0.0, -24.0), Modifiers::COMMAND);
    let now = tiers(&bench);
    let moved = table(&now).distance - table(&before).distance;
    // A table face up is pulled upward.
    assert!((moved * scale - 24.0).abs() < 0.01, "{}", moved * scale);
    assert_eq!(table(&now).meet, None, "a distance of its own is no meet");
    bench.choose("Edit", "Undo");
    assert_eq!(tiers(&bench), before);
    assert!(bench.editor().model.document.steps().1);
}

#[test]
fn a_leaning_facet_is_dragged_outward_and_other_facets_tilt_the_stone() {
    let mut bench = bench();
    let before = tiers(&bench);
    let eye = bench.editor().model.workspace.eye;
    let bezel = at(&bench, DVec2::new(0.8, 0.01));
    drag(&mut bench, bezel, vec2(20.0, 0.0), Modifiers::NONE);
    assert!(tiers(&bench) == before && bench.editor().model.workspace.eye != eye, "the stone tilts");
    bench.harness.key_press(Key::Backspace);
    bench.settle();
    bench.click_at(bezel);
    let place = bench.editor().model.session.tier.unwrap();
    assert_eq!(before.tiers[place].name(), "C1");
    let eye = bench.editor().model.workspace.eye;
    let distance = |bench: &Bench| tiers(bench).tiers[place].distance;
    drag(&mut bench, bezel, vec2(-8.0, 0.0), Modifiers::COMMAND);
    assert!(distance(&bench) < before.tiers[place].distance - 1e-3, "{}", distance(&bench));
    assert_eq!(bench.editor().model.workspace.eye, eye, "the stone stays");
}

#[test]
fn a_facet_that_is_dragged_to_a_corner_stops_there_and_takes_its_meet() {
    let mut bench = bench();
    let before = tiers(&bench);
    let (corner, scale) = (another_corner(&bench), points_per_unit(&bench));
    let by = (corner.distance - table(&before).distance) * scale;
    let from = at(&bench, DVec2::new(0.1, 0.1));
    // Some points too far.
    pull(&mut bench, from, vec2(0.0, -by as f32 + 3.0), Modifiers::NONE);
    let now = tiers(&bench);
    assert!((table(&now).distance - corner.distance).abs() < THERE, "{} {corner:?}", table(&now).distance);
    let meet = table(&now).meet.clone().expect("a meet").to_string();
    bench.harness.step();
    let message = bench.editor().model.session.message.clone();
    assert!(message.starts_with("T: ") && message.contains(&meet), "{message}");
    // Escape takes the whole drag back, and movements of the pointer until the release change nothing.
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    let eye = bench.editor().model.workspace.eye;
    bench.harness.hover_at(from + vec2(30.0, 30.0));
    bench.harness.run_steps(2);
    press(&mut bench, from, false, Modifiers::NONE);
    bench.harness.run_steps(2);
    assert_eq!((tiers(&bench), bench.editor().model.workspace.eye), (before, eye));
}

#[test]
fn a_corner_that_is_picked_becomes_the_meet_of_the_tier() {
    let mut bench = bench();
    let before = tiers(&bench);
    let corner = another_corner(&bench);
    reach(&mut bench, "Pick meet of T");
    bench.click("Pick meet of T");
    assert_eq!(bench.editor().model.session.picking, Some(table_place(&before)));
    // A click beside all corners picks nothing, and Escape ends it.
    bench.click_at(at(&bench, DVec2::ZERO));
    assert_eq!(tiers(&bench), before);
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert_eq!(bench.editor().model.session.picking, None);
    reach(&mut bench, "Pick meet of T");
    bench.click("Pick meet of T");
    let frame = bench.editor().model.document.specimen().frame;
    let place = at(&bench, frame.place(corner.at).truncate());
    bench.click_at(place + vec2(3.0, -2.0));
    let now = tiers(&bench);
    assert!((table(&now).distance - corner.distance).abs() < THERE, "{} {corner:?}", table(&now).distance);
    assert!(table(&now).meet.as_ref().is_some_and(|meet| meet.to_string().starts_with("Meet ")));
    assert_eq!(bench.editor().model.session.picking, None);
    bench.choose("Edit", "Undo");
    assert_eq!(tiers(&bench), before);
    // Another edit ends a pick, because its tier may stand in another place then.
    reach(&mut bench, "Pick meet of T");
    bench.click("Pick meet of T");
    bench.click("Earlier");
    assert_eq!(bench.editor().model.session.picking, None);
}

#[test]
fn buttons_cut_a_tier_to_the_next_corner_and_back() {
    let mut bench = bench();
    let before = tiers(&bench);
    bench.click("In to a meet");
    let deeper = tiers(&bench);
    assert!(table(&deeper).distance < table(&before).distance - THERE && table(&deeper).meet.is_some());
    bench.click("Out to a meet");
    assert!((table(&tiers(&bench)).distance - table(&before).distance).abs() < THERE);
    // The buttons are reached by Tab and pressed by Space like all others.
    bench.harness.get_by_label("In to a meet").focus();
    bench.harness.step();
    bench.harness.key_press(Key::Space);
    bench.harness.run_steps(3);
    assert!((table(&tiers(&bench)).distance - table(&deeper).distance).abs() < THERE);
    (0..3).for_each(|_| bench.choose("Edit", "Undo"));
    assert_eq!(tiers(&bench), before);
}
