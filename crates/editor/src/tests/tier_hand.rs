//! A tier in the hand: dragged by a facet, stopped at corners, and cut to a corner that is picked.

use super::tiers::{reach, tiers, type_text};
use super::*;
use brillianteer_cut::{CornerFault, Meet, Tier, TierChange, TierCorner, TierZone, Tiers};
use brillianteer_session::model::meet_pick::MeetPick;
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
    assert_eq!(bench.editor().model.session.picking, Some(MeetPick::new(table_place(&before), 1)));
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

/// Returns the place in the window of a corner of the design.
fn at_corner(bench: &Bench, corner: &TierCorner) -> Pos2 {
    let frame = bench.editor().model.document.specimen().frame;
    at(bench, frame.place(corner.at).truncate())
}

/// Returns the place of a tier and corners in sight from above, as many as a meet through them is to have, to which such a meet leads
/// the tier and changes its angle.
fn some_corners(bench: &Bench, count: usize) -> (usize, Vec<TierCorner>) {
    let tiers = tiers(bench);
    let places = (0..tiers.tiers.len()).filter(|&place| (5.0..85.0).contains(&tiers.tiers[place].angle));
    let found = places.into_iter().find_map(|place| {
        let all = tiers.corners_to_pick(place, count);
        let is_seen = |corner: &TierCorner| corner.normals.iter().any(|normal| normal.z > 1e-3);
        let place_of = |corner: &TierCorner| at_corner(bench, corner);
        // Of corners behind one another a click means the nearest to it.
        let is_alone = |corner: &&TierCorner| {
            let near = |other: &&TierCorner| place_of(other).distance(place_of(corner)) < 4.0;
            all.iter().map(|(other, _)| other).filter(|other| is_seen(other)).filter(near).count() == 1
        };
        let offered = all.iter().filter(|(_, fault)| fault.is_none()).map(|(corner, _)| corner);
        let beside: Vec<&TierCorner> =
            offered.filter(|corner| corner.facet == 0 && is_seen(corner)).filter(is_alone).collect();
        let changes = |set: &Vec<usize>| {
            let picked: Vec<&TierCorner> = set.iter().map(|&k| beside[k]).collect();
            let meet = tiers.meet_through(place, &picked).ok()?;
            let solved = tiers.changed(TierChange::Meet(place, Some(meet))).tiers;
            let turned = (solved.tiers[place].angle - tiers.tiers[place].angle).abs();
            (turned > 0.05).then(|| (place, picked.into_iter().cloned().collect::<Vec<_>>()))
        };
        sets(beside.len(), count).iter().find_map(changes)
    });
    found.unwrap_or_else(|| panic!("no {count} corners"))
}

/// Returns all sets of so many numbers below `of`.
fn sets(of: usize, count: usize) -> Vec<Vec<usize>> {
    let longer = |set: Vec<usize>| {
        let from = set.last().map_or(0, |last| last + 1);
        (from..of).map(move |next| set.iter().copied().chain([next]).collect())
    };
    (0..count).fold(vec![vec![]], |sets, _| sets.into_iter().flat_map(longer).collect())
}

#[test]
fn two_corners_that_are_picked_become_one_meet_as_one_step() {
    let mut bench = bench();
    let before = tiers(&bench);
    let (place, corners) = some_corners(&bench, 2);
    let button = format!("Pick two points of {}", before.tiers[place].name());
    reach(&mut bench, &button);
    bench.click(&button);
    assert_eq!(bench.editor().model.meet_pick(), Some(&MeetPick::new(place, 2)));
    let message = |bench: &Bench| bench.editor().model.session.message.clone();
    let body = bench.harness.get_by_label("ASET picture").rect();
    bench.harness.hover_at(body.left_top() + vec2(4.0, 4.0));
    bench.harness.run_steps(3);
    assert!(message(&bench).starts_with("Click two corners"), "{}", message(&bench));
    // Escape ends a pick that has begun, and nothing has changed.
    bench.click_at(at_corner(&bench, &corners[0]));
    assert_eq!(bench.editor().model.meet_pick().map(|pick| pick.corners.len()), Some(1));
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert_eq!((bench.editor().model.meet_pick(), tiers(&bench)), (None, before.clone()));
    bench.click(&button);
    for (picked, corner) in corners.iter().enumerate() {
        assert_eq!(tiers(&bench), before, "nothing changes before the last click");
        bench.click_at(at_corner(&bench, corner));
        bench.harness.run_steps(2);
        let left = ["one to go", ""][picked];
        assert!(message(&bench).contains(left), "{left}: {}", message(&bench));
    }
    assert_eq!(bench.editor().model.meet_pick(), None);
    let now = tiers(&bench);
    let tier = &now.tiers[place];
    let Some(Meet::Points(points)) = &tier.meet else { panic!("{:?}", tier.meet) };
    assert_eq!(points.len(), 2);
    let passes = |facet: &brillianteer_cut::Indexed| {
        let plane = now.plane(tier, facet.index);
        corners.iter().all(|corner| plane.distance(corner.at).abs() < THERE)
    };
    assert!(tier.facets.iter().any(passes));
    assert!((tier.angle - before.tiers[place].angle).abs() > 0.05);
    bench.choose("Edit", "Undo");
    assert_eq!(tiers(&bench), before, "one step");
}

#[test]
fn three_corners_that_are_picked_set_angle_and_index_as_one_step_and_undo_takes_back_one_at_a_time() {
    let mut bench = bench();
    let meant = tiers(&bench);
    // Without meets no other tier follows this one, so that all corners around it stay.
    for tier in meant.tiers.iter().filter(|tier| tier.meet.is_some()) {
        type_text(&mut bench, &format!("Meet of {}", tier.name()), "");
    }
    let place = meant.tiers.iter().position(|tier| tier.name() == "C1").unwrap();
    reach(&mut bench, "Angle of C1");
    bench.type_number("Angle of C1", "33");
    bench.settle();
    let before = tiers(&bench);
    assert!(before.tiers.iter().all(|tier| tier.meet.is_none()) && before.tiers[place].angle == 33.0);
    // Three of the corners in which the tier met others lead it back.
    let there = meant.plane(&meant.tiers[place], meant.tiers[place].facets[0].index);
    let offered = before.corners_to_pick(place, 3).into_iter().filter(|(_, fault)| fault.is_none());
    let is_seen = |corner: &TierCorner| corner.normals.iter().any(|normal| normal.z > 1e-3);
    let around: Vec<TierCorner> = offered
        .map(|(corner, _)| corner)
        .filter(|corner| is_seen(corner) && there.distance(corner.at).abs() < THERE)
        .collect();
    let leads = |set: &Vec<usize>| {
        let picked: Vec<&TierCorner> = set.iter().map(|&k| &around[k]).collect();
        before.meet_through(place, &picked).is_ok()
    };
    let set = sets(around.len(), 3).into_iter().find(leads).unwrap_or_else(|| panic!("{around:?}"));
    let corners: Vec<TierCorner> = set.iter().map(|&k| around[k].clone()).collect();
    let button = "Pick three points of C1".to_owned();
    reach(&mut bench, &button);
    bench.click(&button);
    assert_eq!(bench.editor().model.meet_pick(), Some(&MeetPick::new(place, 3)));
    let count = |bench: &Bench| bench.editor().model.meet_pick().map(|pick| pick.corners.len());
    let pick = |bench: &mut Bench, corner: &TierCorner| {
        bench.click_at(at_corner(bench, corner));
        bench.harness.run_steps(2);
    };
    // Undo takes back one corner after the other, then leaves the pick, and never touches the design.
    let undo = |bench: &mut Bench| {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        bench.harness.run_steps(2);
    };
    corners[..2].iter().for_each(|corner| pick(&mut bench, corner));
    for left in [Some(1), Some(0), None] {
        undo(&mut bench);
        assert_eq!((count(&bench), tiers(&bench)), (left, before.clone()));
    }
    reach(&mut bench, &button);
    bench.click(&button);
    let message = |bench: &Bench| bench.editor().model.session.message.clone();
    for (corner, left) in corners.iter().zip(["two to go", "one to go", ""]) {
        assert_eq!(tiers(&bench), before, "nothing changes before the last click");
        pick(&mut bench, corner);
        assert!(message(&bench).contains(left), "{left}: {}", message(&bench));
    }
    assert_eq!(bench.editor().model.meet_pick(), None);
    let now = tiers(&bench);
    let tier = &now.tiers[place];
    assert!(matches!(&tier.meet, Some(Meet::Points(points)) if points.len() == 3), "{:?}", tier.meet);
    let passes = |facet: &brillianteer_cut::Indexed| {
        let plane = now.plane(tier, facet.index);
        corners.iter().all(|corner| plane.distance(corner.at).abs() < THERE)
    };
    assert!(tier.facets.iter().any(passes));
    assert!((tier.angle - meant.tiers[place].angle).abs() < 0.01, "{}", tier.angle);
    undo(&mut bench);
    assert_eq!(tiers(&bench), before, "one step");
}

#[test]
fn corners_across_the_girdle_are_dim_and_say_why_a_tier_is_not_cut_to_them() {
    let mut bench = bench();
    let before = tiers(&bench);
    let place = before.tiers.iter().position(|tier| tier.zone() == TierZone::Pavilion).unwrap();
    let name = before.tiers[place].name().to_owned();
    reach(&mut bench, &format!("Pick meet of {name}"));
    bench.click(&format!("Pick meet of {name}"));
    let all = before.corners_to_pick(place, 1);
    let is_seen = |corner: &TierCorner| corner.normals.iter().any(|normal| normal.z > 1e-3);
    let is_across = |fault: &CornerFault| matches!(fault, CornerFault::Across { .. });
    let across = all.iter().find(|(corner, fault)| is_seen(corner) && fault.as_ref().is_some_and(is_across));
    let place_of = at_corner(&bench, &across.unwrap().0);
    bench.harness.hover_at(place_of);
    bench.harness.run_steps(3);
    let said = "the corner is on the crown, and a pavilion tier that is cut to it would take the girdle away";
    let message = bench.editor().model.session.message.clone();
    assert!(message.contains(said), "{message}");
    bench.click_at(place_of);
    bench.harness.run_steps(2);
    assert_eq!(tiers(&bench), before, "a click there cuts nothing");
    assert_eq!(bench.editor().model.meet_pick(), Some(&MeetPick::new(place, 1)), "the pick goes on");
}

#[test]
fn a_corner_that_is_clicked_again_is_taken_back() {
    let mut bench = bench();
    let before = tiers(&bench);
    let (place, corners) = some_corners(&bench, 2);
    let (corner, name) = (&corners[0], before.tiers[place].name().to_owned());
    let button = format!("Pick two points of {name}");
    reach(&mut bench, &button);
    bench.click(&button);
    let count = |bench: &Bench| bench.editor().model.meet_pick().map(|pick| pick.corners.len());
    for expected in [1, 0, 1] {
        bench.click_at(at_corner(&bench, corner));
        bench.harness.run_steps(2);
        assert_eq!(count(&bench), Some(expected));
    }
    // Another kind of pick begins anew.
    bench.click(&format!("Pick meet of {name}"));
    assert_eq!(bench.editor().model.meet_pick(), Some(&MeetPick::new(place, 1)));
    assert_eq!(tiers(&bench), before);
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
