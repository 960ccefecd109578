//! Tests the drawing in a window, by pointer, by keyboard and by accessible names.

use super::ProfileView;
use brillianteer_cut::{Cut, Pavilion, ProfileHandle, RoundBrilliant, TOLKOWSKY};
use brillianteer_picture::DrawnMarks;
use brillianteer_scene::Stone;
use egui::{Event, Key, Modifiers, Pos2, Rect, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

const SIZE: Vec2 = vec2(700.0, 500.0);

struct Bench {
    view: ProfileView,
    given: RoundBrilliant,
    stone: Stone,
    with_proportions: bool,
    changes: u32,
    hidden: bool,
}

impl Bench {
    fn new(given: RoundBrilliant) -> Self {
        let stone = Stone::new(&given.facets().unwrap()).unwrap();
        Self { view: ProfileView::default(), given, stone, with_proportions: true, changes: 0, hidden: false }
    }

    fn show(&mut self, ui: &mut egui::Ui) {
        if self.hidden {
            return;
        }
        let rect = Rect::from_min_size(Pos2::ZERO, SIZE);
        let brilliant = Cut::RoundBrilliant(self.given);
        let shown = if self.with_proportions { brilliant } else { Cut::Planes(vec![]) };
        let mut cut = shown.clone();
        self.view.show(ui, rect, (&self.stone, &DrawnMarks::default()), &mut cut);
        if cut != shown {
            self.given = *cut.brilliant().unwrap();
            self.changes += 1;
            self.stone = Stone::new(&self.given.facets().unwrap()).unwrap();
        }
    }

    fn open(self) -> Harness<'static, Self> {
        let build = Harness::builder().with_size(SIZE).with_max_steps(100);
        let mut harness = build.build_ui_state(|ui, bench: &mut Self| bench.show(ui), self);
        harness.ctx.all_styles_mut(|style| style.interaction.tooltip_delay = 0.0);
        harness.run();
        harness
    }
}

fn place(harness: &Harness<'_, Bench>, label: &str) -> Pos2 {
    harness.get_by_label(label).rect().center()
}

fn take(harness: &mut Harness<'_, Bench>, at: Pos2) {
    harness.hover_at(at);
    harness.run();
    harness.drag_at(at);
    harness.run();
}

fn pull(harness: &mut Harness<'_, Bench>, to: Pos2) {
    harness.hover_at(to);
    harness.run();
}

fn drop(harness: &mut Harness<'_, Bench>, at: Pos2) {
    harness.drop_at(at);
    harness.run();
}

/// Takes a handle, pulls it and lets go. Returns the scale of the drawing, in points to a girdle radius.
fn drag(harness: &mut Harness<'_, Bench>, label: &str, by: Vec2) -> f64 {
    let [edge, line] = ["Table edge, percent", "Crown height, percent"].map(|l| place(harness, l));
    let scale = f64::from(edge.x - line.x) * 100.0 / harness.state().given.table;
    let from = place(harness, label);
    take(harness, from);
    pull(harness, from + by);
    drop(harness, from + by);
    scale
}

#[test]
fn a_handle_is_pulled_by_the_pointer() {
    for (label, by) in
        [("Table edge, percent", vec2(30.0, 9.0)), ("Girdle, lower edge, percent", vec2(0.0, 9.0))]
    {
        let mut harness = Bench::new(TOLKOWSKY).open();
        let scale = drag(&mut harness, label, by);
        let given = harness.state().given;
        let (found, expected) = match label {
            "Table edge, percent" => (given.table, 53.0 + 100.0 * 30.0 / scale),
            _ => (given.girdle_thickness, 3.0 + 50.0 * 9.0 / scale),
        };
        assert!((found - expected).abs() <= 0.051, "{label}: {found} for {expected}");
        assert!(harness.state().changes > 0 && !harness.state().view.is_dragging());
    }
}

#[test]
fn a_handle_stays_under_the_pointer_and_comes_back_with_it() {
    for (label, by) in [
        ("Table edge, percent", vec2(-40.0, 0.0)),
        ("Crown height, percent", vec2(0.0, 40.0)),
        ("Crown angle, degrees", vec2(0.0, -20.0)),
        ("Girdle, upper edge, percent", vec2(0.0, -30.0)),
        ("Girdle, lower edge, percent", vec2(0.0, 30.0)),
        ("Pavilion angle, degrees", vec2(0.0, -30.0)),
        ("Pavilion depth, percent", vec2(0.0, 60.0)),
        ("Culet, percent", vec2(50.0, 0.0)),
    ] {
        let mut harness = Bench::new(TOLKOWSKY).open();
        let from = place(&harness, label);
        // The hand takes the handle slightly beside its centre.
        let hand = from + vec2(2.0, -1.0);
        take(&mut harness, hand);
        pull(&mut harness, hand + by);
        let off = (place(&harness, label) - from - by) * by.abs().normalized();
        assert!(off.length() < 1.0 && harness.state().view.is_dragging(), "{label}: {off}");
        assert_ne!(harness.state().given, TOLKOWSKY, "{label}");
        pull(&mut harness, hand);
        drop(&mut harness, hand);
        assert_eq!(harness.state().given, TOLKOWSKY, "{label}");
    }
}

#[test]
fn a_click_changes_nothing() {
    let odd = RoundBrilliant { table: 53.037, ..TOLKOWSKY };
    let mut harness = Bench::new(odd).open();
    drag(&mut harness, "Table edge, percent", Vec2::ZERO);
    assert_eq!((harness.state().given, harness.state().changes), (odd, 0));
    assert!(harness.get_by_label("Table edge, percent").is_focused());
}

#[test]
fn the_table_is_pulled_by_either_end() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    let [edge, line] = ["Table edge, percent", "Crown height, percent"].map(|l| place(&harness, l));
    let left = line - (edge - line);
    take(&mut harness, left);
    pull(&mut harness, left - vec2(20.0, 0.0));
    drop(&mut harness, left - vec2(20.0, 0.0));
    let grown = 53.0 * 20.0 / f64::from(edge.x - line.x);
    assert!((harness.state().given.table - 53.0 - grown).abs() <= 0.051);
}

#[test]
fn with_shift_a_handle_follows_ten_times_slower() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    let from = place(&harness, "Table edge, percent");
    take(&mut harness, from);
    harness.event(Event::ModifiersChanged(Modifiers::SHIFT));
    pull(&mut harness, from + vec2(40.0, 0.0));
    harness.run();
    let fine = harness.state().given.table;
    harness.event(Event::ModifiersChanged(Modifiers::NONE));
    drop(&mut harness, from + vec2(40.0, 0.0));
    let mut other = Bench::new(TOLKOWSKY).open();
    drag(&mut other, "Table edge, percent", vec2(4.0, 0.0));
    assert!((fine - other.state().given.table).abs() <= 0.06, "{fine}");
    assert_eq!(harness.state().given.table, fine);
    assert_eq!((fine * 100.0).round() / 100.0, fine);
}

#[test]
fn the_tip_goes_one_way_at_a_time() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    drag(&mut harness, "Pavilion depth, percent", vec2(4.0, 25.0));
    let deep = harness.state().given;
    assert!(deep.culet == 0.0 && deep.derived().unwrap().pavilion_depth > 44.0);
    assert!(matches!(deep.pavilion, Pavilion::Angle(_)));
    let mut harness = Bench::new(TOLKOWSKY).open();
    drag(&mut harness, "Pavilion depth, percent", vec2(-25.0, 4.0));
    let blunt = harness.state().given;
    assert!(blunt.culet > 5.0 && blunt.pavilion == TOLKOWSKY.pavilion);
}

#[test]
fn escape_puts_back_what_is_in_hand() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    let from = place(&harness, "Crown angle, degrees");
    take(&mut harness, from);
    pull(&mut harness, from + vec2(0.0, 20.0));
    assert_ne!(harness.state().given, TOLKOWSKY);
    harness.key_press(Key::Escape);
    harness.run();
    pull(&mut harness, from + vec2(0.0, 30.0));
    assert_eq!(harness.state().given, TOLKOWSKY);
    assert!(!harness.state().view.is_dragging());
}

#[test]
fn a_handle_let_go_while_the_drawing_was_hidden_has_no_say_any_more() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    let from = place(&harness, "Table edge, percent");
    take(&mut harness, from);
    pull(&mut harness, from + vec2(20.0, 0.0));
    harness.state_mut().hidden = true;
    drop(&mut harness, from);
    let other = RoundBrilliant { table: 60.0, ..TOLKOWSKY };
    harness.state_mut().given = other;
    harness.state_mut().hidden = false;
    harness.run();
    assert_eq!(harness.state().given, other);
}

#[test]
fn once_let_go_the_drawing_is_fitted_anew() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    let top = place(&harness, "Crown height, percent");
    drag(&mut harness, "Pavilion depth, percent", vec2(0.0, 150.0));
    let [table, tip] = ["Crown height, percent", "Pavilion depth, percent"].map(|l| place(&harness, l));
    assert!(tip.y < SIZE.y - 20.0 && table.y > 20.0 && table != top, "{table} {tip}");
}

#[test]
fn arrow_keys_move_a_handle_the_way_they_point() {
    for (label, key, expected) in [
        ("Table edge, percent", Key::ArrowRight, 53.1),
        ("Crown height, percent", Key::ArrowUp, 16.2),
        ("Crown angle, degrees", Key::ArrowDown, 34.4),
        ("Girdle, upper edge, percent", Key::ArrowUp, 3.1),
        ("Girdle, lower edge, percent", Key::ArrowUp, 2.9),
        ("Pavilion angle, degrees", Key::ArrowDown, 40.8),
        ("Pavilion depth, percent", Key::ArrowUp, 43.0),
        ("Culet, percent", Key::ArrowRight, 0.1),
    ] {
        let mut harness = Bench::new(TOLKOWSKY).open();
        harness.get_by_label(label).focus();
        harness.run();
        harness.key_press(key);
        harness.run();
        let found = harness.get_by_label(label).accesskit_node().numeric_value().unwrap();
        assert!((found - expected).abs() < 1e-9, "{label}: {found}");
        assert!(harness.get_by_label(label).is_focused(), "{label}");
        assert_eq!(harness.state().changes, 1, "{label}");
    }
}

#[test]
fn with_shift_arrow_keys_move_by_hundredths() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    harness.get_by_label("Table edge, percent").focus();
    harness.run();
    harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowLeft);
    harness.run();
    assert_eq!(harness.state().given.table, 52.99);
}

#[test]
fn screen_readers_step_and_set_values() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    harness.get_by_label("Pavilion angle, degrees").increment_accesskit();
    harness.run();
    assert_eq!(harness.state().given.pavilion, Pavilion::Angle(40.8));
    harness.get_by_label("Culet, percent").set_value_accesskit(1.25);
    harness.run();
    assert_eq!(harness.state().given.culet, 1.25);
}

#[test]
fn tab_goes_through_all_handles_once() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    let focused = |harness: &Harness<'_, Bench>| {
        harness
            .query_all_by(|node| node.is_focused() && node.label().is_some())
            .next()
            .and_then(|n| n.accesskit_node().label())
    };
    let mut seen = vec![];
    for _ in 0..8 {
        harness.key_press(Key::Tab);
        harness.run();
        seen.extend(focused(&harness));
    }
    let names = ProfileHandle::ALL.map(|part| {
        let handle = super::handle::Handle::of(&Cut::RoundBrilliant(TOLKOWSKY), part).unwrap();
        format!("{}, {}", handle.name(), handle.row.unit.name())
    });
    assert_eq!(seen, names);
}

#[test]
fn a_handle_says_what_it_does_when_it_is_pointed_at() {
    let mut harness = Bench::new(TOLKOWSKY).open();
    let at = place(&harness, "Table edge, percent");
    harness.hover_at(at);
    harness.run_steps(4);
    assert!(harness.query_by_label_contains("drag left or right").is_some());
    assert!(harness.query_by_label("Table 53 %").is_some());
}

#[test]
fn a_stone_without_proportions_has_no_handles() {
    let bench = Bench { with_proportions: false, ..Bench::new(TOLKOWSKY) };
    let harness = bench.open();
    assert!(harness.query_by_label("Table edge, percent").is_none());
    assert!(harness.query_by_label("Profile of the stone").is_some());
    let impossible = RoundBrilliant { table: 99.0, ..TOLKOWSKY };
    let harness = Bench { given: impossible, ..Bench::new(TOLKOWSKY) }.open();
    assert!(harness.query_by_label("Table edge, percent").is_none());
}
