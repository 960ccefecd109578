//! Tests of the rows for light, material and motion, found by their accessible names as a person with a screen reader finds them.

use super::Bench;
use super::copies::bench;
use crate::setup::Setup;
use brillianteer_cut::MaterialRef;
use brillianteer_files::cut_file;
use brillianteer_math::Basis;
use brillianteer_optics::{Material, encoded_from_linear, line, linear_from_encoded};
use brillianteer_picture::Bloom;
use brillianteer_scene::Smoothing;
use brillianteer_scene::{LIGHTS, Light, light};
use brillianteer_session::model::{
    render_settings::RenderSettings,
    workspace::{PaneLayout, Workspace},
};
use brillianteer_session::studio::Shot;
use brillianteer_trace::environment::{Environment, EnvironmentMap};
use egui::{
    Color32, ColorImage, Context, FullOutput, ImageData, Key, Modifiers, Rect, Role, Shape, TextureId,
    TexturesDelta,
};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, TestRenderer};
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::{Arc, Mutex};

fn settings(bench: &Bench) -> &RenderSettings {
    &bench.editor().model.document.work.settings
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
    assert_eq!(
        (shot(&bench).look.light_turn, shot(&bench).look.bounces, shot(&bench).look.glow),
        (35.0, 4, 0.4)
    );
    assert_eq!(settings(&bench).look.background_mm, Some(80.0));
    let near = shot(&bench).view.projection;
    bench.type_number("View angle", "30");
    assert_ne!(shot(&bench).view.projection, near);
    pick(&mut bench, "Light axis", "up");
    assert!(shot(&bench).look.light_upright);
    bench.type_number("Exposure", "1.5");
    bench.type_number("Strength", "0.5");
    assert_eq!((shot(&bench).look.exposure, shot(&bench).look.strength), (1.5, 0.5));
    pick(&mut bench, "Wavelengths", "32");
    assert_eq!((settings(&bench).look.wavelengths, shot(&bench).look.wavelengths), (32, 32));
    pick(&mut bench, "Background", "city");
    assert_eq!(shot(&bench).look.background.as_ref().map(ToString::to_string), Some("city".to_owned()));
    pick(&mut bench, "Smoothing", "temporal");
    bench.type_number("Newest part", "0.25");
    assert_eq!(shot(&bench).look.smoothing, Smoothing::Temporal { newest: 0.25 });
    assert_eq!(RenderSettings::default().look.glow, Bloom::default().strength);
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
    // A coloured glass has a length in which half of the light is lost.
    assert!(bench.harness.query_by_role_and_label(Role::SpinButton, "Half-light path").is_none());
    bench.pick_colour("Body colour", [120, 190, 240]);
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
fn the_colour_of_a_gem_is_picked_and_stands_in_its_saved_cut_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let mut bench = bench("tolkowsky");
    bench.click("Index and colour");
    bench.harness.run_steps(super::SCROLLED);
    let before = bench.editor().model.document.specimen().material.clone();
    bench.pick_colour("Body colour", [230, 80, 60]);
    let design = bench.editor().model.document.work.design.clone();
    let material = bench.editor().model.document.specimen().material.clone();
    // The colour is that of a path as long as the stone is wide; a picker has steps of 1/255.
    let shown = |material: &Material| {
        let codes = material.colour_after(design.diameter_mm).to_array().map(encoded_from_linear);
        codes.map(|code| (255.0 * code).round() as i32)
    };
    let is_picked = |material: &Material| {
        shown(material).iter().zip([230, 80, 60]).all(|(code, picked)| (code - picked).abs() <= 1)
    };
    assert!(is_picked(&material) && !is_picked(&before), "{:?}, {:?}", shown(&material), shown(&before));
    assert_eq!(material.dispersion, before.dispersion, "the colour changes no index");
    assert!(material.colour_is_illustrative);
    bench.choices.lock().unwrap().push(path.clone());
    bench.harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    bench.wait(|editor| editor.model.document.path().is_some() && !editor.model.document.is_changed());
    let saved = cut_file::read(&path).unwrap();
    assert_eq!(saved, design);
    assert!(is_picked(&saved.material.material().unwrap()));
    let steps = bench.editor().model.document.steps();
    assert!(steps.0);
    while bench.editor().model.document.steps().0 {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        bench.harness.run_steps(3);
    }
    assert_eq!(bench.editor().model.document.specimen().material, before, "undone");
}

/// The textures that a window has been given.
#[derive(Clone, Default)]
struct KeptTextures(Arc<Mutex<HashMap<TextureId, Arc<ColorImage>>>>);

impl TestRenderer for KeptTextures {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let mut kept = self.0.lock().unwrap();
        let set = std::mem::take(&mut delta.set);
        for (id, given) in set.into_iter().flat_map(|(id, all)| all.into_iter().map(move |given| (id, given)))
        {
            let ImageData::Color(image) = given.image;
            // Letters come in parts; all else is given whole.
            if given.pos.is_none() {
                kept.insert(id, image);
            }
        }
        delta.clear();
    }

    fn render(&mut self, _: &Context, _: &FullOutput) -> Result<image::RgbaImage, String> {
        Err("this window keeps its textures and draws nothing".to_owned())
    }
}

/// Returns the places in the window where textures are drawn.
fn drawn(shape: &Shape) -> Vec<(TextureId, Rect)> {
    match shape {
        Shape::Vec(shapes) => shapes.iter().flat_map(drawn).collect(),
        other => vec![(other.texture_id(), other.visual_bounding_rect())],
    }
}

/// Opens the list of lights and returns the picture in the entry of each light.
fn thumbnails() -> Vec<Arc<ColorImage>> {
    let kept = KeptTextures::default();
    let workspace = Workspace { layout: PaneLayout::One, ..Workspace::default() };
    let builder = Harness::builder().with_size(egui::vec2(860.0, 1240.0)).renderer(kept.clone());
    let mut bench = Bench::built(Setup { workspace, ..Setup::default() }, builder);
    bench.harness.run_steps(3);
    let textures = |bench: &Bench| {
        let shapes = bench.harness.output().shapes.iter();
        shapes.flat_map(|clipped| drawn(&clipped.shape)).collect::<Vec<_>>()
    };
    let is_light = |bench: &Bench, id: TextureId| {
        let manager = bench.harness.ctx.tex_manager();
        manager.read().meta(id).is_some_and(|meta| meta.name.starts_with("light "))
    };
    assert!(!textures(&bench).iter().any(|(id, _)| is_light(&bench, *id)), "the list is closed");
    bench.harness.get_by_role_and_label(Role::ComboBox, "Light").scroll_to_me();
    bench.harness.run_steps(super::SCROLLED);
    bench.harness.get_by_role_and_label(Role::ComboBox, "Light").click();
    bench.harness.run_steps(4);
    let picture = |name: &str| {
        bench.harness.get_by_role_and_label(Role::Button, name).scroll_to_me();
        bench.harness.run_steps(super::SCROLLED);
        let entry = bench.harness.get_by_role_and_label(Role::Button, name).rect();
        let within: Vec<_> = textures(&bench)
            .into_iter()
            .filter(|(id, rect)| is_light(&bench, *id) && entry.contains(rect.center()))
            .collect();
        assert_eq!(within.len(), 1, "{name}: one picture stands in its entry");
        assert!(within[0].1.width() > 30.0 && entry.contains_rect(within[0].1), "{name}: {within:?}");
        Arc::clone(&kept.0.lock().unwrap()[&within[0].0])
    };
    LIGHTS.map(picture).to_vec()
}

/// Returns the mean colour of a picture of all directions, each weighed by its solid angle, in linear light.
fn mean_of_picture(image: &ColorImage) -> DVec3 {
    let [width, height] = image.size;
    let row = |y: usize| {
        let weight = ((y as f64 + 0.5) / height as f64 * PI).sin();
        let pixels = image.pixels[y * width..(y + 1) * width].iter();
        let linear = |pixel: &Color32| {
            [pixel.r(), pixel.g(), pixel.b()].map(|c| linear_from_encoded(f64::from(c) / 255.0))
        };
        (weight * width as f64, pixels.map(|pixel| weight * DVec3::from(linear(pixel))).sum::<DVec3>())
    };
    let (weights, sums): (Vec<f64>, Vec<DVec3>) = (0..height).map(row).unzip();
    sums.into_iter().sum::<DVec3>() / weights.into_iter().sum::<f64>()
}

/// Returns the mean over all directions of the light that renders look up, without its lamps, each colour rolled off as in the
/// list's pictures.
fn mean_of_light(name: &str) -> DVec3 {
    const COUNT: usize = 40_000;
    let map = EnvironmentMap::new(&Light { lamp: vec![], field: vec![], ..light(name).unwrap() }, None);
    let basis = Basis { right: DVec3::X, up: DVec3::Y, toward: DVec3::Z };
    let around = Environment { map: &map, basis, eye: basis, head: 0.0, backplate: None, backdrop: true };
    let colour = |k: usize| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / COUNT as f64;
        let way = DVec2::from_angle(k as f64 * PI * (3.0 - 5.0_f64.sqrt())) * (1.0 - z * z).sqrt();
        let all = around.radiance(DVec3::ZERO, way.extend(z), DVec3::ZERO);
        let colour = DVec3::new(all.y, all.z, all.w) + DVec3::splat(all.x);
        colour / (DVec3::ONE + colour)
    };
    (0..COUNT).map(colour).sum::<DVec3>() / COUNT as f64
}

#[test]
fn every_light_in_the_list_has_a_picture_in_the_mean_colour_of_its_own_light() {
    let pictures = thumbnails();
    let share = |colour: DVec3| colour / colour.element_sum();
    let mut coloured = 0;
    for (k, (name, picture)) in LIGHTS.into_iter().zip(&pictures).enumerate() {
        assert!(picture.pixels.iter().all(|pixel| pixel.a() == 255), "{name}");
        for (other, before) in LIGHTS.into_iter().zip(&pictures[..k]) {
            assert!(before.pixels != picture.pixels, "{name} has the picture of {other}");
        }
        let (seen, lit) = (mean_of_picture(picture), mean_of_light(name));
        let is_coloured = share(lit).distance(DVec3::splat(1.0 / 3.0)) > 0.02;
        // A lamp is drawn larger than it is, so that it can be seen: it adds light, to a world in another colour.
        let has_lamps = !light(name).unwrap().lamps().is_empty();
        let off = (seen - lit) / lit.max_element();
        let is_alike = off.min_element() > -0.1 && (has_lamps || off.max_element() < 0.1);
        let has_colour = share(seen).distance(share(lit)) < 0.02 || has_lamps && is_coloured;
        assert!(is_alike && has_colour, "{name}: {seen} instead of {lit}");
        // The pictures of nearly all other lights would be too bright, too dark or of another colour in its place.
        let is_seen = |other: &&Arc<ColorImage>| {
            let seen = mean_of_picture(other);
            share(seen).distance(share(lit)) > 0.02
                || (seen - lit).abs().max_element() > 0.1 * lit.max_element()
        };
        let noticed = pictures.iter().filter(|other| !Arc::ptr_eq(other, picture)).filter(is_seen).count();
        assert!(noticed >= 8, "{name}: {noticed} of 11");
        coloured += usize::from(is_coloured);
    }
    assert!(coloured >= 3, "worlds have colours");
}

#[test]
fn another_light_is_drawn_at_random_and_undone() {
    let mut bench = bench("subtle-pill");
    let before = bench.editor().model.document.work.settings.look.light.clone();
    let mut seen = vec![before.clone()];
    for _ in 0..4 {
        pick(&mut bench, "Light", "Another at random");
        let now = bench.editor().model.document.work.settings.look.light.clone();
        assert!(LIGHTS.contains(&now.as_str()) && Some(&now) != seen.last(), "{now} after {seen:?}");
        seen.push(now);
    }
    for _ in 0..4 {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        bench.harness.run_steps(3);
    }
    assert_eq!(bench.editor().model.document.work.settings.look.light, before);
    bench.choose("View", "Another light");
    assert_ne!(bench.editor().model.document.work.settings.look.light, before);
    pick(&mut bench, "Light", "office");
    assert_eq!(bench.editor().model.document.work.settings.look.light, "office");
}

#[test]
fn what_is_under_the_pointer_is_outlined_on_facets_and_not_on_glass() {
    let outlines = |scene: &str| {
        let mut bench = bench(scene);
        bench.harness.run_steps(3);
        let at = shot(&bench).copies[0].at;
        let at = super::copies::at(&bench, at.x, at.y);
        bench.harness.hover_at(at);
        bench.harness.run_steps(3);
        assert!(!bench.editor().model.session.message.is_empty(), "{scene}: something is under the pointer");
        let shapes = bench.harness.output().shapes.iter();
        let single = shapes.flat_map(|clipped| super::single_shapes(&clipped.shape));
        let is_outline = |shape: &egui::Shape| match shape {
            egui::Shape::LineSegment { stroke, .. } => stroke.color == egui::Color32::from_white_alpha(220),
            _ => false,
        };
        single.filter(is_outline).count()
    };
    assert_eq!(outlines("subtle-pill"), 0);
    assert!(outlines("trilogy") > 2);
}
