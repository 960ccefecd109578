//! Tests of the views that show a background behind glass: refraction maps, and liquid glass.

use super::*;
use brillianteer_paper::lighting;
use brillianteer_picture::RefractionMap;
use brillianteer_picture::liquid_glass::PaneQuality;
use brillianteer_session::liquid::Liquid;
use brillianteer_session::model::{action::Computed, command::Command, workspace::Pane};
use brillianteer_session::studio::ShotLight;

impl Bench {
    /// Chooses what a view shows from its menu, by name.
    fn show(&mut self, view: usize, shows: Shows) {
        let before = self.editor().model.workspace.panes[view].shows;
        self.click(&format!("View {}: {}", view + 1, before.name()));
        self.harness.run_steps(4);
        self.click(shows.name());
        self.settle();
        assert_eq!(self.editor().model.workspace.panes[view].shows, shows);
    }

    /// Returns the refraction map by which a view shows its background.
    fn map(&self, view: usize) -> Arc<RefractionMap> {
        self.editor().views.gallery.traced[&(view, Which::Present)].taken.map.clone().unwrap()
    }

    /// Drags in a picture, to the right and upward.
    fn drag(&mut self, picture: &str) {
        let at = self.harness.get_by_label(picture).rect().center();
        self.harness.hover_at(at);
        self.harness.step();
        self.harness.drag_at(at);
        self.harness.step();
        for by in [10.0, 20.0, 30.0] {
            self.harness.hover_at(at + egui::vec2(by, -by / 2.0));
            self.harness.step();
        }
        self.harness.drop_at(at + egui::vec2(30.0, -15.0));
        self.harness.run_steps(3);
    }

    /// Waits until the first view uses another map than `last`.
    fn wait_for_map(&mut self, last: &Arc<RefractionMap>) {
        self.wait(|editor| {
            let map = editor
                .views
                .gallery
                .traced
                .get(&(0, Which::Present))
                .and_then(|shown| shown.taken.map.as_ref());
            map.is_some_and(|map| !Arc::ptr_eq(map, last))
        });
    }
}

/// Returns whether a picture has more than one colour.
fn is_drawn(picture: &[[u8; 4]]) -> bool {
    picture.iter().any(|pixel| *pixel != picture[0])
}

#[test]
fn a_background_is_dragged_through_a_map_that_is_not_traced_again() {
    let mut bench = Bench::new();
    bench.show(0, Shows::Refraction);
    let (first, map) = (bench.picture(0), bench.map(0));
    assert!(is_drawn(&first));
    bench.drag("Refraction map picture");
    bench.settle();
    let moved = bench.picture(0);
    assert!(moved != first, "the background has moved");
    assert!(Arc::ptr_eq(&bench.map(0), &map) && bench.editor().model.workspace.eye.tilt() == 0.0);
    // Another background behind the same map.
    bench.harness.state_mut().model.document.work.settings.look.background = Some("stripes".into());
    bench.settle();
    let other = bench.picture(0);
    assert!(other != moved && Arc::ptr_eq(&bench.map(0), &map));
    bench.click("Map");
    assert!(is_drawn(&bench.picture(0)) && bench.picture(0) != other, "the codes are shown");
}

#[test]
fn a_photograph_that_vanishes_is_named_over_the_render_and_removed_by_a_click() {
    let mut bench = Bench::new();
    bench.harness.state_mut().model.workspace.panes[0].shows = Shows::Render;
    let settings = &mut bench.harness.state_mut().model.document.work.settings;
    (settings.look.background, settings.look.strength) = (Some("/nowhere/garden.jpg".into()), 0.3);
    assert_eq!(settings.strength(), 1.0);
    bench.harness.run_steps(4);
    bench.click("garden.jpg is missing ×");
    bench.harness.run_steps(4);
    assert_eq!(bench.editor().model.document.work.settings.look.background, None);
}

#[test]
fn a_map_is_traced_anew_for_a_stone_that_is_tilted_there_or_elsewhere() {
    let mut bench = Bench::new();
    bench.show(0, Shows::Refraction);
    let map = bench.map(0);
    bench.drag("Hearts picture");
    let lean = bench.editor().model.workspace.eye.lean;
    assert!(lean.length() > 0.1);
    bench.wait_for_map(&map);
    bench.harness.event(egui::Event::ModifiersChanged(egui::Modifiers::COMMAND));
    bench.drag("Refraction map picture");
    assert!(
        bench.editor().model.workspace.eye.lean != lean
            && bench.editor().model.session.flowing[0].moved == glam::DVec2::ZERO
    );
    bench.wait_for_map(&map);
}

#[test]
fn a_background_flows_until_it_is_stopped_and_nothing_is_drawn_after() {
    let mut bench = Bench::new();
    bench.show(0, Shows::Refraction);
    let (first, map) = (bench.picture(0), bench.map(0));
    bench.click("Flow");
    bench.wait(|editor| editor.model.session.flowing[0].moved.x > 0.02);
    assert!(bench.harness.try_run().is_err(), "it is drawn again and again");
    bench.click("Flow");
    bench.settle();
    let moved = bench.editor().model.session.flowing[0].moved;
    let count = bench.harness.run();
    assert!(count <= 3, "{count} frames for nothing");
    assert_eq!(bench.editor().model.session.flowing[0].moved, moved);
    assert!(bench.picture(0) != first && Arc::ptr_eq(&bench.map(0), &map));
}

#[test]
fn liquid_glass_is_drawn_and_traced_as_strong_as_it_is_set() {
    let mut bench = Bench::new();
    assert!(bench.harness.query_by_label("Pane depth").is_none(), "no liquid glass is in sight");
    bench.show(0, Shows::LiquidGlass);
    bench.show(1, Shows::TracedPane);
    let both = |bench: &Bench| [bench.picture(0), bench.picture(1)];
    let first = both(&bench);
    assert!(first.iter().all(|picture| is_drawn(picture)) && first[0] != first[1]);
    for (name, number) in [("Refraction", "30"), ("Pane depth", "60"), ("Pane width", "40")] {
        let before = both(&bench);
        bench.type_number(name, number);
        bench.look();
        let after = both(&bench);
        assert!(before[0] != after[0] && before[1] != after[1], "{name}");
    }
    let before = both(&bench);
    bench.drag("Liquid glass picture");
    bench.look();
    let after = both(&bench);
    assert!(
        before[0] != after[0]
            && before[1] != after[1]
            && bench.editor().model.document.work.settings.liquid.at.x > 0.55
    );
    bench.click("Reset");
    bench.look();
    assert!(both(&bench) == first);
    // The proportions of the stone do not affect liquid glass.
    bench.type_number("Crown angle", "33");
    bench.look();
    assert!(both(&bench) == first);
}

#[test]
fn each_row_of_liquid_glass_changes_its_picture() {
    let mut bench = Bench::new();
    bench.show(0, Shows::LiquidGlass);
    let liquid = |bench: &Bench| bench.editor().model.document.work.settings.liquid;
    let numbers = |bench: &Bench| {
        let Liquid { size, corners, refraction, depth, dispersion, frost, light, .. } = liquid(bench);
        [size.x, size.y, corners, refraction, depth, dispersion, frost, light]
    };
    let names = [
        "Pane width",
        "Pane height",
        "Corners",
        "Refraction",
        "Pane depth",
        "Dispersion",
        "Frost",
        "Pane light",
    ];
    for (row, name) in names.into_iter().enumerate() {
        let before = bench.picture(0);
        bench.type_number(name, "44");
        bench.look();
        assert_eq!(numbers(&bench)[row], 44.0, "{name}");
        assert!(bench.picture(0) != before, "{name} changes nothing");
    }
    let before = bench.picture(0);
    super::light_and_glass::pick(&mut bench, "Quality", "low");
    bench.look();
    assert!(liquid(&bench).quality == PaneQuality::Low && bench.picture(0) != before);
}

#[test]
fn the_light_of_liquid_glass_is_set_by_rows_and_follows_the_pointer_or_time() {
    let mut bench = Bench::new();
    bench.show(0, Shows::LiquidGlass);
    let first = bench.picture(0);
    bench.type_number("Light azimuth", "200");
    bench.type_number("Light height", "20");
    bench.look();
    let set = bench.picture(0);
    let from = |bench: &Bench| bench.editor().model.liquid().light_from;
    assert!(set != first && (from(&bench).azimuth, from(&bench).height) == (200.0, 20.0));
    let follow = |bench: &mut Bench, what: &str| {
        bench.field(egui::Role::ComboBox, "Light follows").scroll_to_me();
        bench.harness.run_steps(8);
        bench.field(egui::Role::ComboBox, "Light follows").click();
        bench.harness.run_steps(4);
        bench.harness.get_by_label(what).click();
        bench.harness.run_steps(4);
    };
    follow(&mut bench, "pointer");
    assert!(bench.harness.query_by_label("Light azimuth").is_none(), "the rows set nothing now");
    let view = bench.harness.get_by_label("Liquid glass picture").rect();
    for (at, azimuth) in [(view.right_center(), 0.0), (view.center_top(), 90.0)] {
        bench.harness.hover_at(at + 0.1 * (view.center() - at));
        bench.settle();
        let off = (from(&bench).azimuth - azimuth + 180.0).rem_euclid(360.0) - 180.0;
        assert!(off.abs() < 3.0, "{azimuth}: {:?}", from(&bench));
    }
    assert!(bench.picture(0) != set);
    let begun = from(&bench).azimuth;
    follow(&mut bench, "time");
    bench.wait(|editor| (editor.model.liquid().light_from.azimuth - begun).abs() > 5.0);
    assert!(bench.harness.try_run().is_err(), "it is drawn again and again");
    follow(&mut bench, "fixed");
    bench.settle();
    assert!(bench.harness.run() <= 3, "nothing moves");
}

/// Measures the time of a look-up. This is ignored by default, because measuring takes time: `cargo test --release
/// --lib backgrounds -- --ignored --nocapture`
#[test]
#[ignore = "measures times, which needs two idle cores"]
fn looking_up_keeps_up_with_the_window() {
    let mut workspace = Bench::small();
    workspace.layout = PaneLayout::One;
    workspace.panes[0].shows = Shows::Refraction;
    let setup = Setup { workspace, file: Some("plate".into()), ..Setup::default() };
    let mut bench = Bench::sized(setup, egui::vec2(1144.0, 600.0));
    bench.settle();
    let size = bench.editor().shown((0, Which::Present)).unwrap().taken.image.size;
    for shows in [Shows::Refraction, Shows::LiquidGlass] {
        bench.harness.state_mut().model.workspace.panes[0].shows = shows;
        bench.settle();
        let mut took: Vec<f64> = vec![];
        for k in 1..=40 {
            let editor = bench.harness.state_mut();
            editor.model.session.flowing[0].moved.x = 0.01 * f64::from(k);
            editor.model.document.work.settings.liquid.at.x = 0.4 + 0.004 * f64::from(k);
            bench.harness.step();
            let begun = Instant::now();
            while !bench.editor().is_idle() {
                bench.harness.step();
            }
            took.push(begun.elapsed().as_secs_f64() * 1e3);
        }
        took.sort_by(f64::total_cmp);
        println!("{shows:?} {size:?}: {:.1} ms, the slowest {:.1} ms", took[20], took[39]);
    }
}

#[test]
fn a_world_that_is_being_drawn_is_shown_coarsely_at_once_and_the_status_line_says_so() {
    let pane = Pane { shows: Shows::Render, own: None, is_near: false, stone: None };
    let workspace = Workspace { layout: PaneLayout::One, panes: [pane; 4], ..Workspace::default() };
    let mut bench = Bench::sized(Setup { workspace, ..Setup::default() }, egui::vec2(700.0, 300.0));
    let settings = &mut bench.harness.state_mut().model.document.work.settings;
    (settings.look.wavelengths, settings.look.background) = (3, Some("sunset".into()));
    bench.harness.run_steps(2);
    assert!(bench.harness.query_by_label_contains("done ·").is_none(), "an order is on its way");
    bench.wait(|editor| editor.studio.preparing().is_some());
    assert_eq!(bench.editor().studio.preparing().as_deref(), Some("drawing the sunset…"));
    assert!(bench.harness.query_by_label_contains("drawing the sunset… ·").is_some());
    bench.wait(|editor| editor.views.gallery.traced.contains_key(&(0, Which::Present)));
    // The first picture has a world behind it, which is the coarse one unless the whole one is drawn by then.
    let shown = &bench.editor().views.gallery.traced[&(0, Which::Present)];
    let [_, _, blue, cover] = shown.taken.image.rgba.as_chunks::<4>().0[0];
    assert!(shown.grade == Grade::Rough && cover == 255 && blue > 0, "{blue} {cover}");
}

#[test]
fn a_light_that_is_being_drawn_is_shown_coarsely_at_once_and_nothing_fine_is_made_of_it() {
    let pane = Pane { shows: Shows::Render, own: None, is_near: false, stone: None };
    let workspace = Workspace { layout: PaneLayout::One, panes: [pane; 4], ..Workspace::default() };
    let mut bench = Bench::sized(Setup { workspace, ..Setup::default() }, egui::vec2(700.0, 300.0));
    // The light is loaded by this test, so that each state lasts until it has been seen.
    let model = &mut bench.harness.state_mut().model;
    (model.document.work.settings.look.wavelengths, model.document.work.settings.look.light) =
        (3, "sunset".to_owned());
    model.session.light.loading = Some("sunset".to_owned());
    let come = |bench: &mut Bench, light: &ShotLight| {
        let answer = Computed::Light("sunset".to_owned(), Ok(light.clone()));
        bench.harness.state_mut().act(answer);
        let slot = (0, Which::Present);
        let is_shown = |shown: &Shown| shown.shot.light == *light;
        bench.wait(|editor| editor.views.gallery.traced.get(&slot).is_some_and(is_shown));
    };
    let says = |bench: &Bench, what: &str| bench.harness.query_by_label_contains(what).is_some();
    bench.wait(|editor| editor.views.gallery.traced.contains_key(&(0, Which::Present)));
    assert!(says(&bench, "loading the light… ·"), "the light before is shown");
    let coarse = ShotLight::coarse(lighting::load("ring").unwrap());
    come(&mut bench, &coarse);
    let rough = bench.editor().shown((0, Which::Present)).unwrap().taken.image.clone();
    assert!(is_drawn(rough.rgba.as_chunks().0) && says(&bench, "drawing the light… ·"));
    bench.wait(|editor| editor.studio.is_idle());
    assert!(!bench.editor().is_idle() && says(&bench, "drawing the light… ·"));
    assert!(bench.editor().views.gallery.traced[&(0, Which::Present)].grade == Grade::Rough);
    // No picture of a coarse light leaves the program.
    bench.harness.state_mut().act(Command::CopyPicture);
    bench.harness.run_steps(2);
    assert!(says(&bench, "still being drawn"));
    come(&mut bench, &ShotLight::whole(lighting::load("ring").unwrap()));
    bench.settle();
    assert!(bench.editor().views.gallery.traced[&(0, Which::Present)].grade == Grade::Fine);
}
