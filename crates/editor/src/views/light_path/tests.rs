use super::*;
use brillianteer_files::cut_file;
use brillianteer_scene::{ASET_CONE, Backing, Medium, Specimen, View};
use brillianteer_trace::ray::{Camera, RayOptions, StoneTracer};
use egui::{Event, Key, PointerButton, Pos2, Rect, Shape, Theme, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use glam::{DQuat, DVec2};
use std::sync::Arc;

/// The widget under test and its input: a path through a brilliant that is seen face up.
struct Shown {
    widget: LightPath,
    body: Arc<Body>,
    path: Path,
    scope: Scope,
}

impl Shown {
    fn new(least_weight: f64) -> Self {
        let design =
            cut_file::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cuts/modern-ideal.toml")).unwrap();
        let body = Specimen::new(design).unwrap().body;
        let options = RayOptions { least_weight, ..RayOptions::default() };
        let tracer = StoneTracer::new(body.solid(), Medium::clear(2.4173), options);
        let (origin, direction) = Camera::new(&View::default(), body.solid()).ray(DVec2::new(0.33, 0.21));
        let path = tracer.path(origin, direction).unwrap();
        let scope = Scope::aset(ASET_CONE, Backing::Black);
        Self { widget: LightPath::default(), body, path, scope }
    }

    fn show(&mut self, ui: &mut Ui) {
        let Self { widget, body, path, scope } = self;
        widget.show(ui, body, path, scope, &View::default());
    }

    /// Opens the widget in a window of this size and theme.
    fn harness(self, size: Vec2, theme: Theme) -> Harness<'static, Self> {
        // Time steps so short that two clicks can count as a double click.
        let builder =
            Harness::builder().with_step_dt(0.05).with_max_steps(64).with_size(size).with_theme(theme);
        let mut harness = builder.build_ui_state(|ui, shown: &mut Self| shown.show(ui), self);
        harness.run();
        harness
    }
}

/// The size of the smallest window in which everything must have room.
const SMALL: Vec2 = vec2(420.0, 600.0);

/// Returns each painted text with its rectangle and its clip rectangle, outside which it is cut off.
fn texts(harness: &Harness<Shown>) -> Vec<(String, Rect, Rect)> {
    let text = |shape: &Shape| match shape {
        Shape::Text(text) => Some((text.galley.text().to_owned(), text.visual_bounding_rect())),
        _ => None,
    };
    let all = harness.output().shapes.iter();
    all.filter_map(|s| text(&s.shape).map(|(text, rect)| (text, rect, s.clip_rect))).collect()
}

/// Returns how many lines are drawn in the colour of the highlighted step.
fn lit(harness: &Harness<Shown>) -> usize {
    let colour = harness.ctx.global_style().visuals.strong_text_color();
    let shapes = harness.output().shapes.iter();
    shapes.filter(|s| matches!(&s.shape, Shape::LineSegment { stroke, .. } if stroke.color == colour)).count()
}

/// Returns the row of a step as screen readers speak it.
fn spoken(harness: &Harness<Shown>, number: usize) -> String {
    let start = format!("Step {number}:");
    let row = harness.get_by_label_contains(&start);
    row.accesskit_node().label().unwrap()
}

fn drawing(harness: &Harness<Shown>) -> Pos2 {
    harness.get_by_label_contains("Light path through the stone").rect().center()
}

fn drag(harness: &mut Harness<Shown>, by: Vec2) {
    let from = drawing(harness);
    harness.drag_at(from);
    harness.step();
    harness.hover_at(from + by);
    harness.step();
    harness.drop_at(from + by);
    harness.run();
}

#[test]
fn every_step_is_a_row_that_can_be_read_aloud() {
    let shown = Shown::new(1e-3);
    let count = shown.path.steps.len();
    let harness = shown.harness(SMALL, Theme::Dark);
    assert_eq!(harness.get_all_by_label_contains("Step ").count(), count);
    let first =
        "Step 1: table, incidence 0.0°, 17.2 % leaves to blue, elevation 90.0°, azimuth –, 82.8 % goes on";
    harness.get_by_label(first);
    assert!(spoken(&harness, 2).ends_with("critical angle 24.4°, all reflected, 82.8 % goes on"));
}

#[test]
fn rows_tell_the_figures_of_the_path() {
    let shown = Shown::new(1e-3);
    let path = shown.path.clone();
    let harness = shown.harness(SMALL, Theme::Dark);
    for (number, step) in (1..).zip(&path.steps) {
        let row = spoken(&harness, number);
        assert!(row.contains(&format!("incidence {:.1}°", step.incidence)), "{row}");
        assert_eq!(row.contains("all reflected"), step.leaving.is_none(), "{row}");
    }
    let elevation = |d: DVec3| format!("elevation {:.1}°", d.z.asin().to_degrees()).replace('-', "−");
    let texts = path.steps.iter().filter_map(|s| s.leaving).map(|l| elevation(l.direction));
    assert!(texts.into_iter().all(|text| harness.get_all_by_label_contains(&text).count() > 0));
}

#[test]
fn no_text_is_cut_off_or_overlaps_another_in_a_small_window() {
    for theme in [Theme::Dark, Theme::Light] {
        let harness = Shown::new(1e-3).harness(SMALL, theme);
        let texts = texts(&harness);
        assert!(texts.len() > 80, "{}", texts.len());
        for (k, (text, rect, clip)) in texts.iter().enumerate() {
            assert!(text.is_empty() || clip.contains_rect(*rect), "'{text}' is cut off");
            let others = texts[..k].iter().filter(|(other, r, _)| !other.is_empty() && r.intersects(*rect));
            assert!(text.is_empty() || others.count() == 0, "'{text}' lies over another");
        }
    }
}

#[test]
fn the_steps_that_carry_light_are_numbered_in_the_drawing() {
    let harness = Shown::new(1e-3).harness(SMALL, Theme::Dark);
    let edge = harness.get_by_label_contains("Light path through the stone").rect();
    let numbers = texts(&harness).into_iter().filter(|(_, rect, _)| edge.contains_rect(*rect));
    let mut numbers: Vec<u32> = numbers.map(|(text, _, _)| text.parse().unwrap()).collect();
    numbers.sort_unstable();
    let steps = &Shown::new(1e-3).path.steps;
    // All light meets the first facet; each later one meets what the step before sends on.
    let strong = 1 + steps.iter().take_while(|step| step.onward >= drawing::FAINT).count() as u32;
    assert!((5..steps.len() as u32).contains(&strong));
    assert_eq!(numbers, (1..=strong).collect::<Vec<_>>());
}

#[test]
fn a_long_path_and_a_narrow_window_scroll() {
    let shown = Shown::new(1e-9);
    assert!(shown.path.steps.len() > 30);
    for size in [vec2(200.0, 300.0), vec2(1200.0, 500.0), vec2(60.0, 40.0)] {
        let harness = Shown::new(1e-9).harness(size, Theme::Dark);
        let window = Rect::from_min_size(Pos2::ZERO, size);
        let clips = harness.output().shapes.iter().map(|s| s.clip_rect);
        assert!(clips.into_iter().all(|clip| !clip.is_positive() || window.expand(1.0).contains_rect(clip)));
    }
}

#[test]
fn dragging_and_arrow_keys_turn_the_stone_and_a_double_click_or_home_turns_it_back() {
    let mut harness = Shown::new(1e-3).harness(SMALL, Theme::Dark);
    let at_first = harness.state().widget.orbit;
    drag(&mut harness, vec2(50.0, -30.0));
    assert_ne!(harness.state().widget.orbit, at_first);
    let at = drawing(&harness);
    for pressed in [true, false, true, false] {
        let modifiers = egui::Modifiers::NONE;
        harness.event(Event::PointerButton { pos: at, button: PointerButton::Primary, pressed, modifiers });
    }
    harness.run();
    assert_eq!(harness.state().widget.orbit, at_first);
    harness.get_by_label_contains("Light path through the stone").focus();
    harness.run();
    harness.key_press(Key::ArrowLeft);
    harness.key_press(Key::ArrowUp);
    harness.run();
    assert_ne!(harness.state().widget.orbit, at_first);
    harness.key_press(Key::Home);
    harness.run();
    assert_eq!(harness.state().widget.orbit, at_first);
}

#[test]
fn the_row_under_the_pointer_lights_its_stretch_and_a_click_keeps_it_lit() {
    let mut harness = Shown::new(1e-3).harness(SMALL, Theme::Dark);
    assert_eq!(lit(&harness), 0);
    harness.get_by_label_contains("Step 3:").hover();
    harness.run();
    assert!(lit(&harness) > 0);
    harness.get_by_label_contains("Step 3:").click();
    harness.run();
    harness.remove_cursor();
    harness.run();
    assert!(lit(&harness) > 0);
    assert_eq!(harness.state().widget.kept, Some(2));
    harness.get_by_label_contains("Step 3:").click();
    harness.run();
    assert_eq!(harness.state().widget.kept, None);
}

#[test]
fn a_step_that_the_next_path_does_not_have_is_let_go() {
    let mut shown = Shown::new(1e-3);
    shown.widget.kept = Some(shown.path.steps.len());
    assert_eq!(shown.harness(SMALL, Theme::Dark).state().widget.kept, None);
}

#[test]
fn light_along_the_axis_has_no_azimuth_and_others_have_theirs_in_the_scopes_frame() {
    let Shown { body, path, scope, .. } = Shown::new(1e-3);
    let light = Basis::FACE_DOWN;
    let reading = Reading { body: &body, path: &path, scope: &scope, light, turn: DQuat::IDENTITY };
    assert_eq!(reading.azimuth(DVec3::NEG_Z), None);
    let azimuths = [DVec3::NEG_X, DVec3::Y, DVec3::X, DVec3::NEG_Y].map(|d| reading.azimuth(d).unwrap());
    assert!(
        azimuths.iter().zip([0.0, 90.0, 180.0, 270.0]).all(|(a, b)| (a - b).abs() < 1e-9),
        "{azimuths:?}"
    );
    assert_eq!(reading.band(DVec3::NEG_Z).name, "blue");
    assert_eq!(reading.colour(DVec3::NEG_Z), Color32::BLUE);
}
