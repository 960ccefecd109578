//! Tests of the table of tiers: the changes that it makes, and the selection that it shares with the views.

use super::row_defaults::double_click;
use super::*;
use brillianteer_cut::{Tier, TierChange, TierZone, Tiers};
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_session::model::{Action, action::Edit, update};
use egui::Role;

/// Returns the tiers of the open design.
pub fn tiers(bench: &Bench) -> Tiers {
    match &bench.editor().model.document.work.design.cut {
        Cut::Tiers(tiers) => tiers.clone(),
        other => panic!("{other:?}"),
    }
}

/// Opens an editor in which the first cut has been turned into tiers.
fn turned() -> Bench {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1400.0, 900.0));
    bench.settle();
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    bench
}

/// Opens an editor in which the oval has been turned into tiers.
fn turned_oval() -> Bench {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1400.0, 900.0));
    bench.choose("File", "New from a cut");
    bench.click("Oval 1.40");
    bench.settle();
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    bench
}

/// Scrolls the table until a widget is in sight.
pub fn reach(bench: &mut Bench, label: &str) {
    bench.harness.get_by_label(label).scroll_to_me();
    bench.harness.run_steps(SCROLLED);
}

/// Types a text into a field of the table, and Return.
pub fn type_text(bench: &mut Bench, name: &str, text: &str) {
    reach(bench, name);
    bench.field(Role::TextInput, name).focus();
    bench.harness.step();
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    bench.harness.step();
    match text {
        "" => bench.harness.key_press(egui::Key::Backspace),
        _ => bench.harness.get_by_role_and_label(Role::TextInput, name).type_text(text),
    }
    bench.harness.run_steps(2);
    bench.harness.key_press(egui::Key::Enter);
    bench.harness.run_steps(3);
}

fn names(tiers: &Tiers) -> Vec<String> {
    tiers.tiers.iter().map(|tier| tier.name().to_owned()).collect()
}

#[test]
fn a_brilliant_that_is_turned_into_tiers_stays_where_it_is_and_comes_back_by_undo() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1400.0, 900.0));
    bench.settle();
    let (given, before) = (bench.brilliant(), Arc::clone(bench.editor().model.document.specimen()));
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    let now = Arc::clone(bench.editor().model.document.specimen());
    assert!((now.solid().volume() - before.solid().volume()).abs() < 1e-9);
    assert!((now.unit_mm() - before.unit_mm()).abs() < 1e-9);
    assert!(bench.editor().model.workspace.shows_tiers);
    assert_eq!(tiers(&bench).count(), given.facets().unwrap().len());
    bench.choose("Edit", "Undo");
    assert_eq!(bench.brilliant(), given);
}

#[test]
fn tiers_are_added_named_indexed_muted_copied_and_deleted_by_name() {
    let mut bench = turned();
    let before = tiers(&bench);
    bench.click("Select P2");
    bench.click("Add tier");
    let added = tiers(&bench);
    assert_eq!(added.tiers.len(), before.tiers.len() + 1);
    let place = bench.editor().model.session.tier.unwrap();
    let name = added.tiers[place].name().to_owned();
    // It touches the stone alone, so the stone is the same.
    let volume = bench.editor().model.document.specimen().solid().volume();
    bench.settle();
    assert!((bench.editor().model.document.specimen().solid().volume() - volume).abs() < 1e-9);
    type_text(&mut bench, &format!("Name of {name}"), "K1");
    assert!(names(&tiers(&bench)).contains(&"K1".to_owned()), "{:?}", names(&tiers(&bench)));
    type_text(&mut bench, "Indices of K1", "12-84");
    assert_eq!(tiers(&bench).tiers[place].indices(96), "12-84");
    // A text that is no list of indices changes nothing.
    type_text(&mut bench, "Indices of K1", "12-x");
    assert_eq!(tiers(&bench).tiers[place].indices(96), "12-84");
    reach(&mut bench, "Cut K1");
    bench.click("Cut K1");
    assert!(!tiers(&bench).tiers[place].is_cut);
    bench.click("Copy tier");
    assert_eq!(names(&tiers(&bench)).iter().filter(|name| name.starts_with('K')).count(), 2);
    bench.click("Delete tier");
    bench.click("Delete tier");
    assert_eq!(names(&tiers(&bench)), names(&before));
    while bench.editor().model.document.steps().0 {
        bench.choose("Edit", "Undo");
    }
    assert!(matches!(bench.editor().model.document.work.design.cut, Cut::RoundBrilliant(_)));
}

#[test]
fn an_angle_that_is_typed_keeps_its_side_and_moves_one_tier() {
    let mut bench = turned();
    let before = tiers(&bench);
    let place = before.tiers.iter().position(|tier| tier.name() == "P2").unwrap();
    reach(&mut bench, "Angle of P2");
    bench.type_number("Angle of P2", "41.25");
    let now = tiers(&bench);
    assert_eq!(now.tiers[place].angle, -41.25);
    assert_eq!(before.tiers[place].facets.len(), 8);
    let others = |tiers: &Tiers| -> Vec<Tier> {
        tiers.tiers.iter().filter(|tier| tier.name() != "P2").cloned().collect()
    };
    for (now, before) in others(&now).iter().zip(&others(&before)) {
        assert!((now.distance - before.distance).abs() < 1e-9 && now.angle == before.angle, "{now:?}");
    }
}

/// Returns the tangents of the angles of a side, above 0.
fn tangents(tiers: &Tiers, zone: TierZone) -> Vec<f64> {
    let side = tiers.tiers.iter().filter(|tier| tier.zone() == zone);
    side.map(|tier| tier.angle.abs().to_radians().tan()).collect()
}

#[test]
fn a_side_is_scaled_by_name_as_one_step_whether_it_is_typed_or_dragged() {
    let mut bench = turned();
    let before = tiers(&bench);
    let [crown, pavilion] = [TierZone::Crown, TierZone::Pavilion].map(|zone| tangents(&before, zone));
    let ratios = |bench: &Bench, zone, of: &[f64]| -> Vec<f64> {
        tangents(&tiers(bench), zone).iter().zip(of).map(|(now, before)| now / before).collect()
    };
    let steps = bench.editor().model.document.steps();
    bench.type_number("Scale of the crown", "90");
    bench.settle();
    let of_crown = ratios(&bench, TierZone::Crown, &crown);
    assert!(of_crown.len() > 2 && of_crown.iter().all(|ratio| (ratio - 0.9).abs() < 1e-12), "{of_crown:?}");
    assert_eq!(tangents(&tiers(&bench), TierZone::Pavilion), pavilion);
    assert!(bench.editor().model.session.meet_faults.iter().all(Option::is_none));
    let at = bench.field(Role::SpinButton, "Scale of the pavilion").rect().center();
    bench.at_once(vec![egui::Event::PointerMoved(at)]);
    bench.at_once(vec![egui::Event::PointerButton {
        pos: at,
        button: egui::PointerButton::Primary,
        pressed: true,
        modifiers: egui::Modifiers::NONE,
    }]);
    let mut dragged = vec![];
    for by in [10.0, 25.0, 40.0] {
        bench.at_once(vec![egui::Event::PointerMoved(at + egui::vec2(by, 0.0))]);
        dragged.push(ratios(&bench, TierZone::Pavilion, &pavilion));
    }
    bench.at_once(vec![egui::Event::PointerButton {
        pos: at + egui::vec2(40.0, 0.0),
        button: egui::PointerButton::Primary,
        pressed: false,
        modifiers: egui::Modifiers::NONE,
    }]);
    bench.settle();
    let of_pavilion = ratios(&bench, TierZone::Pavilion, &pavilion);
    // Each change counts from the beginning of the drag, so that the last value is that of the field.
    let last = of_pavilion[0];
    assert!(last > dragged[0][0] && (1.01..1.06).contains(&last), "{dragged:?} {last}");
    assert!(of_pavilion.iter().all(|ratio| (ratio - last).abs() < 1e-12), "{of_pavilion:?}");
    let percent = 100.0 * last;
    assert!((percent - (100.0 * percent).round() / 100.0).abs() < 1e-9, "{percent} is a sum of factors");
    for (zone, of) in [(TierZone::Pavilion, &pavilion), (TierZone::Crown, &crown)] {
        bench.choose("Edit", "Undo");
        bench.settle();
        assert_eq!(&tangents(&tiers(&bench), zone), of, "one step each");
    }
    assert_eq!((tiers(&bench), bench.editor().model.document.steps().0), (before, steps.0));
}

#[test]
fn a_scale_that_cannot_be_leaves_the_design_and_says_why() {
    let mut bench = turned();
    let mut steep = tiers(&bench);
    let place = steep.tiers.iter().position(|tier| tier.name() == "P1").unwrap();
    steep.tiers[place].angle = -89.4;
    let of = Box::new(Cut::Tiers(steep));
    let before = tiers(&bench);
    let edit = Edit::Scale { side: brillianteer_cut::ScaledSide::Pavilion, percent: 200.0, of };
    let model = &mut bench.harness.state_mut().model;
    update(model, Action::Edit(edit));
    bench.settle();
    assert_eq!(tiers(&bench), before);
    assert!(
        bench.harness.query_by_label_contains("The design stays: tier 'P1' would go from 89.40").is_some()
    );
}

#[test]
fn a_facet_that_is_clicked_selects_its_tier_and_rows_are_ordered() {
    let mut bench = turned();
    bench.harness.run_steps(3);
    // The middle of a view face up is the table.
    let view = bench.harness.get_by_label("ASET picture").rect().center();
    bench.click_at(view);
    bench.settle();
    let place = bench.editor().model.session.tier.expect("a tier is selected");
    assert_eq!(tiers(&bench).tiers[place].name(), "T");
    assert!(!bench.editor().model.session.followed.is_open, "no ray is followed beside the table");
    bench.click("Earlier");
    assert_eq!(tiers(&bench).tiers[place - 1].name(), "T");
    assert_eq!(bench.editor().model.session.tier, Some(place - 1));
    bench.click("Later");
    assert_eq!(tiers(&bench).tiers[place].name(), "T");
}

#[test]
fn bench_mode_shows_one_step_and_keeps_what_was_cut() {
    let mut bench = turned();
    let design = tiers(&bench);
    bench.choose("View", "Bench mode");
    assert!(bench.harness.query_by_label("ASET picture").is_none());
    bench.click("Next step");
    let first = design.tiers[1].facets[0].index;
    let chip = format!("Index {}", if first == 0.0 { 96.0 } else { first });
    bench.click(&chip);
    let marked = |bench: &Bench| bench.harness.query_by_label_contains("1 of 8 indices are cut").is_some();
    assert!(marked(&bench));
    // The arrow keys turn the pages.
    bench.harness.key_press(egui::Key::ArrowLeft);
    bench.harness.run_steps(2);
    assert!(!marked(&bench));
    bench.harness.key_press(egui::Key::ArrowRight);
    bench.harness.run_steps(2);
    assert!(marked(&bench));
    // A gear that counts the other way round shows other numbers for the same marks.
    bench.click("Left-handed gear");
    assert!(marked(&bench));
    bench.click("Leave bench mode");
    bench.settle();
    // Another angle is another step, whose marks are void.
    reach(&mut bench, "Angle of P2");
    bench.type_number("Angle of P2", "41.5");
    bench.choose("View", "Bench mode");
    assert!(!marked(&bench));
    let text = serde_json::to_string(&bench.editor().model.workspace).unwrap();
    let read: Workspace = serde_json::from_str(&text).unwrap();
    assert_eq!(read.cutting, bench.editor().model.workspace.cutting);
}

#[test]
fn later_meets_follow_a_tier_that_moves_and_undo_brings_them_back() {
    let mut bench = turned();
    let before = tiers(&bench);
    let met = before.tiers.iter().filter(|tier| tier.meet.is_some()).count();
    assert!(met >= 2, "{met} meets are found on a brilliant");
    reach(&mut bench, "Angle of C1");
    bench.type_number("Angle of C1", "33.5");
    let now = tiers(&bench);
    let moved = before.tiers.iter().zip(&now.tiers).filter(|(a, b)| (a.distance - b.distance).abs() > 1e-4);
    let moved: Vec<&str> = moved.map(|(tier, _)| tier.name()).collect();
    assert_eq!(moved, ["C3", "T"], "upper halves and table follow the bezels");
    assert!(bench.editor().model.session.meet_faults.iter().all(Option::is_none));
    // Meets hold: followed once more, nothing moves.
    let again = now.solved();
    let farthest = again.tiers.tiers.iter().zip(&now.tiers).map(|(a, b)| (a.distance - b.distance).abs());
    assert!(farthest.fold(0.0, f64::max) < 1e-9);
    bench.choose("Edit", "Undo");
    assert_eq!(tiers(&bench), before);
}

#[test]
fn a_meet_that_is_typed_places_the_tier_and_one_that_fails_is_said() {
    let mut bench = turned();
    let before = tiers(&bench);
    let place = before.tiers.iter().position(|tier| tier.name() == "C1").unwrap();
    // A text that is no meet is not taken.
    type_text(&mut bench, "Meet of C1", "somewhere");
    assert_eq!(tiers(&bench), before);
    type_text(&mut bench, "Meet of C1", "Meet P1-P9");
    let fault = bench.editor().model.session.meet_faults[place].clone();
    assert!(fault.is_some() || tiers(&bench) == before, "{fault:?}");
    bench.click("Select C1");
    bench.click("Find meets");
    assert_eq!(tiers(&bench).tiers.len(), before.tiers.len());
}

#[test]
fn a_tier_that_is_named_anew_keeps_its_meets_and_another_gear_moves_no_facet() {
    let mut bench = turned();
    let before = tiers(&bench);
    let stone = Arc::clone(bench.editor().model.document.specimen());
    let naming = |tiers: &Tiers, name: &str| {
        let words = tiers.tiers.iter().filter_map(|tier| tier.meet.as_ref()).map(ToString::to_string);
        words.filter(|words| words.contains(name)).count()
    };
    let count = naming(&before, "C1");
    assert!(count > 0 && naming(&before, "Bezel") == 0);
    type_text(&mut bench, "Name of C1", "Bezel1");
    let now = tiers(&bench);
    assert_eq!((naming(&now, "C1"), naming(&now, "Bezel1")), (0, count));
    assert!(bench.editor().model.session.meet_faults.iter().all(Option::is_none));
    bench.type_number("Gear", "80");
    bench.click("Clockwise");
    bench.settle();
    assert_eq!(tiers(&bench).gear, -80);
    let again = Arc::clone(bench.editor().model.document.specimen());
    let planes = |specimen: &brillianteer_scene::Specimen| {
        specimen.stone().unwrap().polytope.planes().collect::<Vec<_>>()
    };
    for (now, then) in planes(&again).iter().zip(&planes(&stone)) {
        assert!((now.normal - then.normal).length() < 1e-9 && (now.offset - then.offset).abs() < 1e-9);
    }
    while bench.editor().model.document.steps().0 {
        bench.choose("Edit", "Undo");
    }
    assert!(matches!(bench.editor().model.document.work.design.cut, Cut::RoundBrilliant(_)));
}

/// Makes the design in the window a file of GemCad, and opens an editor with it and the table of tiers.
fn reopened(bench: &Bench, folder: &std::path::Path) -> Bench {
    let path = folder.join("turned.asc");
    design_file::write(bench.editor().model.document.specimen(), DesignFormat::Asc, &path).unwrap();
    let mut bench = Bench::sized(Setup { file: Some(path), ..Setup::default() }, egui::vec2(1400.0, 900.0));
    bench.settle();
    bench.choose("View", "Table of tiers");
    bench.settle();
    bench
}

#[test]
fn a_double_click_on_the_name_of_a_tier_in_the_panel_sets_its_saved_angle_and_distance() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = reopened(&turned(), folder.path());
    bench.choose("View", "Table of tiers");
    bench.settle();
    let before = bench.editor().model.document.work.clone();
    let setting = before.design.cut.settings()[2].clone();
    let name = format!("{} · {}", setting.name, setting.facets);
    let place = tiers(&bench).place_of_cut(2);
    let change = TierChange::Setting(place, setting.angle + 0.2, setting.distance * 1.001);
    bench.harness.state_mut().act(Edit::Tiers(change));
    bench.settle();
    assert!(bench.editor().model.document.work.design.cut != before.design.cut);
    let label = |bench: &Bench| {
        let label = bench.harness.get_by_role_and_label(Role::Label, &name);
        label.scroll_to_me();
        label.rect().left_center() + egui::vec2(8.0, 0.0)
    };
    label(&bench);
    bench.harness.run_steps(SCROLLED);
    let at = label(&bench);
    double_click(&mut bench, at);
    let now = bench.editor().model.document.work.design.cut.settings()[2].clone();
    let off = (now.angle - setting.angle).abs().max((now.distance - setting.distance).abs());
    assert!(off < 1e-9, "{now:?}, and saved {setting:?}");
    bench.choose("Edit", "Undo");
    bench.settle();
    let before = bench.editor().model.document.work.design.cut.settings()[2].angle;
    assert!((before - setting.angle - 0.2).abs() < 1e-9, "it was one step");
}

#[test]
fn meets_that_a_file_states_are_taken_when_it_is_opened_and_later_tiers_follow() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = reopened(&turned(), folder.path());
    let before = tiers(&bench);
    let place = |name: &str| before.tiers.iter().position(|tier| tier.name() == name).unwrap();
    let said = |tiers: &Tiers, place: usize| tiers.tiers[place].meet.as_ref().map(ToString::to_string);
    assert!(said(&before, place("C3")).is_some_and(|words| words.contains("C1")));
    assert!(before.tiers[place("C3")].instructions.starts_with("Meet "));
    assert!(!bench.editor().model.document.is_changed() && !bench.editor().model.document.steps().0);
    // "Find meets" reads the instructions as well.
    type_text(&mut bench, "Meet of C3", "");
    assert_eq!(said(&tiers(&bench), place("C3")), None);
    bench.click("Find meets");
    let found = tiers(&bench);
    for (now, then) in found.tiers.iter().zip(&before.tiers) {
        assert!((now.distance - then.distance).abs() < 1e-9 && now.meet == then.meet, "{now:?} {then:?}");
    }
    reach(&mut bench, "Angle of C1");
    bench.type_number("Angle of C1", "33.5");
    let now = tiers(&bench);
    let moved = before.tiers.iter().zip(&now.tiers).filter(|(a, b)| (a.distance - b.distance).abs() > 1e-4);
    let moved: Vec<&str> = moved.map(|(tier, _)| tier.name()).collect();
    assert_eq!(moved, ["C3", "T"], "upper halves and table follow the bezels");
    bench.choose("Edit", "Undo");
    assert_eq!(tiers(&bench), found);
}

#[test]
fn an_oval_becomes_tiers_whose_meets_follow_and_undo_brings_it_back() {
    let mut bench = turned_oval();
    let given = bench.editor().model.document.step_before().unwrap().design.cut.clone();
    assert!(matches!(given, Cut::Family(_)));
    let before = tiers(&bench);
    // The first tier that another one follows by its meet.
    let followed = |place: &usize| {
        let tier = &before.tiers[*place];
        let change = TierChange::Setting(*place, tier.angle + 0.25f64.copysign(tier.angle), tier.distance);
        let now = before.changed(change);
        let moved =
            |(k, (a, b)): (usize, (&Tier, &Tier))| k != *place && (a.distance - b.distance).abs() > 1e-4;
        now.errors().count() == 0 && before.tiers.iter().zip(&now.tiers.tiers).enumerate().any(moved)
    };
    let place = (0..before.tiers.len()).find(followed).expect("a tier follows another");
    let name = before.tiers[place].name().to_owned();
    let angle = before.tiers[place].angle.abs() + 0.25;
    reach(&mut bench, &format!("Angle of {name}"));
    bench.type_number(&format!("Angle of {name}"), &angle.to_string());
    let now = tiers(&bench);
    let apart = |(a, b): (&Tier, &Tier)| (a.distance - b.distance).abs() > 1e-4;
    assert!(before.tiers.iter().zip(&now.tiers).filter(|pair| apart(*pair)).count() >= 1);
    assert!(bench.editor().model.session.meet_faults.iter().all(Option::is_none));
    let again = now.solved();
    assert!(!again.tiers.tiers.iter().zip(&now.tiers).any(apart), "the meets hold");
    bench.choose("Edit", "Undo");
    assert_eq!(tiers(&bench), before);
    bench.choose("Edit", "Undo");
    assert_eq!(bench.editor().model.document.work.design.cut, given);
}

#[test]
fn a_row_comes_into_sight_when_its_facet_is_clicked_and_rows_are_dragged() {
    let mut bench = turned_oval();
    let row = |bench: &Bench, name: &str| bench.harness.get_by_label(&format!("Select {name}")).rect();
    assert!(row(&bench, "T").bottom() > 900.0, "{:?}", row(&bench, "T"));
    bench.click_at(bench.harness.get_by_label("ASET picture").rect().center());
    bench.harness.run_steps(SCROLLED);
    let (table, left) = (row(&bench, "T"), row(&bench, "P1").left());
    assert!(table.bottom() < 900.0 && table.left() == left && left < 700.0, "{table:?}");
    // The first tiers change places.
    reach(&mut bench, "Select P1");
    let before = names(&tiers(&bench));
    let (from, to) = (row(&bench, "P1").center(), row(&bench, "P2").center());
    let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
    bench.harness.hover_at(from);
    bench.harness.step();
    bench.harness.event(egui::Event::PointerButton { pos: from, button, pressed: true, modifiers });
    bench.harness.step();
    for part in [0.3, 0.7, 1.0] {
        bench.harness.hover_at(from + (to - from) * part);
        bench.harness.step();
    }
    bench.harness.event(egui::Event::PointerButton { pos: to, button, pressed: false, modifiers });
    bench.harness.run_steps(3);
    let now = names(&tiers(&bench));
    assert_eq!((now[0].as_str(), now[1].as_str()), (before[1].as_str(), before[0].as_str()));
    bench.choose("Edit", "Undo");
    assert_eq!(names(&tiers(&bench)), before);
}

#[test]
fn a_tier_is_frosted_in_the_table_and_polished_by_undo() {
    let mut bench = turned();
    let before = tiers(&bench);
    reach(&mut bench, "Frosting of P2");
    bench.type_number("Frosting of P2", "0.5");
    bench.settle();
    let frosted = |bench: &Bench| {
        let stone = bench.editor().model.document.specimen().stone().unwrap();
        stone.polytope.facets().iter().filter(|facet| facet.frosting == 0.5).count()
    };
    assert_eq!(frosted(&bench), 8);
    let now = tiers(&bench);
    assert_eq!(now.tiers.iter().filter(|tier| tier.frosting == 0.5).count(), 1);
    bench.choose("Edit", "Undo");
    assert_eq!((tiers(&bench), frosted(&bench)), (before, 0));
}

#[test]
#[ignore = "measures the time of an edit; run it alone, in release"]
fn an_edit_of_a_tier_is_timed() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1400.0, 900.0));
    bench.choose("File", "New from a cut");
    bench.click("Portuguese");
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    let before = tiers(&bench);
    let met = before.tiers.iter().filter(|tier| tier.meet.is_some()).count();
    let place = before.tiers.iter().position(|tier| tier.angle < 0.0 && tier.angle > -80.0).unwrap();
    let model = &mut bench.harness.state_mut().model;
    let mut times: Vec<f64> = (1..=41)
        .map(|k| {
            let angle = before.tiers[place].angle + 0.001 * f64::from(k);
            let change = TierChange::Setting(place, angle, before.tiers[place].distance);
            let begun = Instant::now();
            update(model, Action::Edit(Edit::Tiers(change)));
            1e3 * begun.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!(
        "{} facets in {} tiers, {met} with meets: an edit takes {:.2} ms (median), {:.2} ms at most",
        before.count(),
        before.tiers.len(),
        times[20],
        times[40]
    );
}
