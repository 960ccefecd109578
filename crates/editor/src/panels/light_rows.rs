//! Rows for the light of renders, the backplate behind the stone, and the observer's head.

use crate::panels::rows::{ChoiceRow, Row, colour_row, field_width, skip_name};
use brillianteer_picture::light_picture;
use brillianteer_render::USUAL_BOUNCES;
use brillianteer_scene::{Background, BackgroundRef, LIGHTS, light};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit, FileAction},
    choosing::Purpose,
    command::Command,
    render_settings::{RenderSettings, SettingChange, WAVELENGTHS},
};
use brillianteer_session::studio::BEHIND;
use egui::{Button, ColorImage, Id, Image, TextureHandle, TextureOptions, Ui, Vec2, vec2};
use std::borrow::Cow;
use std::ops::RangeInclusive;
use std::path::Path;

/// The range of the exposure, in stops.
const STOPS: RangeInclusive<f64> = -4.0..=4.0;

/// The range of the half angle of the observer's head, degrees.
const HEADS: RangeInclusive<f64> = 0.0..=30.0;

/// The range of the strength of refraction: 0 is the straight ray, 1 is physics.
const STRENGTHS: RangeInclusive<f64> = 0.0..=1.0;

/// The range of the turn of the light, degrees.
const TURNS: RangeInclusive<f64> = -180.0..=180.0;

/// The range of the glow.
const GLOWS: RangeInclusive<f64> = 0.0..=1.0;

/// The range of the greatest number of bounces.
const BOUNCES: RangeInclusive<f64> = 1.0..=USUAL_BOUNCES as f64;

/// Draws the rows.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let (now, first) = (&model.document.work.settings, model.document.first_settings());
    light_row(now, first, actions, ui);
    let meaning = "The angle by which the light of renders is turned about its axis.";
    let turn = Row { step: 1.0, decimals: 1, unit: "°", ..Row::new("Light turn", meaning, TURNS) };
    let turn = turn.by_default(first.light_turn);
    turn.edit(ui, actions, now.light_turn, set(SettingChange::LightTurn));
    light_axis(now, first, actions, ui);
    let meaning = "The brightness of renders, in stops. One stop more is twice the light.";
    let exposure = Row { step: 0.1, decimals: 1, unit: " stops", ..Row::new("Exposure", meaning, STOPS) };
    let exposure = exposure.by_default(first.exposure);
    exposure.edit(ui, actions, now.exposure, set(SettingChange::Exposure));
    wavelengths(now, first, actions, ui);
    let meaning = "How much of the light of sparkles spreads around them in renders, as in an eye or a lens; 0 for none. A rough \
        picture has none.";
    let glow = Row { step: 0.01, decimals: 2, ..Row::new("Glow", meaning, GLOWS) }.by_default(first.glow);
    glow.edit(ui, actions, now.glow, set(SettingChange::Glow));
    let meaning = "The number of bounces inside the stone after which renders follow light no farther. Raise it from 1 to \
        see what each bounce adds; light that is left is dark.";
    let bounces = Row { step: 1.0, decimals: 0, ..Row::new("Most bounces", meaning, BOUNCES) };
    let bounces = bounces.by_default(f64::from(first.bounces));
    let counted = |bounces: f64| Edit::Setting(SettingChange::Bounces(bounces.round() as u32));
    bounces.edit(ui, actions, f64::from(now.bounces), counted);
    behind(now, first, actions, ui);
    if let Some(BackgroundRef::Plain(colours)) = now.background() {
        plain_colours(colours, actions, ui);
    } else if now.background.is_some() {
        behind_how(model, actions, ui);
    }
    let meaning =
        "Half angle of the observer's head, which blocks light in the ASET and in figures; 0 for none.";
    let head = Row { step: 0.1, decimals: 1, unit: "°", ..Row::new("Head", meaning, HEADS) };
    head.by_default(first.head).edit(ui, actions, now.head, set(SettingChange::Head));
    reset(now, first, actions, ui);
}

/// Returns the edit that a change of one of the settings makes.
fn set<T>(change: impl FnOnce(T) -> SettingChange) -> impl FnOnce(T) -> Edit {
    |value| Edit::Setting(change(value))
}

fn light_axis(now: &RenderSettings, first: &RenderSettings, actions: &mut Actions, ui: &mut Ui) {
    let mut upright = now.light_upright;
    let meaning = "Where the axis of the light points in renders: to the eye, as a sky over a stone that lies on its culet, or \
        up, so that a panorama's horizon lies level behind the stone. The worlds sunset, room and city stand upright in \
        any case.";
    let name = |is_upright| if is_upright { "up" } else { "to the eye" };
    let row = ChoiceRow::new("Light axis", meaning, name(upright)).by_default(name(first.light_upright));
    let is_reset = row.show(ui, |ui| {
        [false, true].into_iter().for_each(|each| drop(ui.selectable_value(&mut upright, each, name(each))));
    });
    let upright = if is_reset { first.light_upright } else { upright };
    actions.push_changed(&now.light_upright, upright, set(SettingChange::LightUpright));
}

fn wavelengths(now: &RenderSettings, first: &RenderSettings, actions: &mut Actions, ui: &mut Ui) {
    let mut count = now.wavelengths;
    let meaning = "The number of bands of wavelengths into which renders split light. With few, a rainbow breaks \
        into steps of colour; hold Z to see three.";
    let (present, usual) = (count.to_string(), first.wavelengths.to_string());
    let is_reset = ChoiceRow::new("Wavelengths", meaning, &present).by_default(&usual).show(ui, |ui| {
        WAVELENGTHS.into_iter().for_each(|n| drop(ui.selectable_value(&mut count, n, n.to_string())));
    });
    let count = if is_reset { first.wavelengths } else { count };
    actions.push_changed(&now.wavelengths, count, set(SettingChange::Wavelengths));
}

/// Draws the button that resets all rows of the light.
fn reset(now: &RenderSettings, first: &RenderSettings, actions: &mut Actions, ui: &mut Ui) {
    let mut reset = now.clone();
    reset.reset_light(first);
    ui.horizontal(|ui| {
        skip_name(ui);
        let size = vec2(field_width(ui), ui.spacing().interact_size.y);
        let button = Button::new(Command::ResetLight.name()).min_size(size);
        let button = ui.add_enabled(reset != *now, button);
        actions.push_if(button.on_hover_text(Command::ResetLight.meaning()).clicked(), Command::ResetLight);
    });
}

/// Returns the name of a file without its folders; any other name unchanged.
fn short(name: &str) -> Cow<'_, str> {
    Path::new(name).file_name().map_or(name.into(), |file| file.to_string_lossy())
}

/// The size of a light's picture in the list, points.
const THUMBNAIL: Vec2 = vec2(36.0, 18.0);

/// Returns the picture of a light of the program, which is drawn when it is first shown.
fn light_thumbnail(ui: &Ui, name: &str) -> Image<'static> {
    let id = Id::unique(("light thumbnail", name));
    let known = ui.data(|data| data.get_temp::<TextureHandle>(id));
    let texture = known.unwrap_or_else(|| {
        let size = [2 * THUMBNAIL.x as u32, 2 * THUMBNAIL.y as u32];
        let rgb = light(name)
            .map_or_else(|| vec![0; 3 * (size[0] * size[1]) as usize], |light| light_picture(&light, size));
        let image = ColorImage::from_rgb(size.map(|side| side as usize), &rgb);
        let texture = ui.ctx().load_texture(format!("light {name}"), image, TextureOptions::LINEAR);
        ui.data_mut(|data| data.insert_temp(id, texture.clone()));
        texture
    });
    Image::new((texture.id(), THUMBNAIL))
}

/// Draws the row of lights.
fn light_row(now: &RenderSettings, first: &RenderSettings, actions: &mut Actions, ui: &mut Ui) {
    let (present, usual) = (short(&now.light), short(&first.light));
    let row = ChoiceRow::new("Light", "The light around the stone in renders.", &present).by_default(&usual);
    let mut chosen = now.light.clone();
    let is_reset = row.show(ui, |ui| {
        if ui.button("Another at random").on_hover_text(Command::AnotherLight.meaning()).clicked() {
            actions.push(Command::AnotherLight);
        }
        for name in LIGHTS {
            let about = light(name).map_or(String::new(), |light| light.description);
            let picture = light_thumbnail(ui, name);
            let entry = ui.add(Button::selectable(now.light == name, (picture, name)));
            if entry.on_hover_text(about).clicked() {
                name.clone_into(&mut chosen);
            }
        }
        let file = ui.button("From a file…");
        if file.on_hover_text("A light file, or a panorama: .hdr, .exr, .png or .jpg.").clicked() {
            actions.push(FileAction::Choose(Purpose::Light));
        }
    });
    let chosen = if is_reset { first.light.clone() } else { chosen };
    actions.push_changed(&now.light, chosen, set(SettingChange::Light));
}

/// Returns the words for a background.
fn background_name(background: Option<&str>) -> Cow<'_, str> {
    let plain = |name| {
        BackgroundRef::read(name, Path::new("")).ok().filter(|it| matches!(it, BackgroundRef::Plain(_)))
    };
    match background {
        None => "nothing".into(),
        Some(name) => match plain(name) {
            Some(BackgroundRef::Plain(Background::Gradient { .. })) => "two colours".into(),
            Some(_) => "one colour".into(),
            None => short(name),
        },
    }
}

/// Draws the row of backgrounds behind the stone in renders.
fn behind(now: &RenderSettings, first: &RenderSettings, actions: &mut Actions, ui: &mut Ui) {
    let mut behind = now.background.clone();
    let meaning = "The background of renders. Each ray shows the point of the background that it meets.";
    let [present, usual] = [now, first].map(|settings| background_name(settings.background.as_deref()));
    let is_reset = ChoiceRow::new("Background", meaning, &present).by_default(&usual).show(ui, |ui| {
        ui.selectable_value(&mut behind, None, "nothing");
        ui.selectable_value(&mut behind, Some("light".to_owned()), "light")
            .on_hover_text("The light itself, for example a panorama.");
        for name in BackgroundRef::names() {
            ui.selectable_value(&mut behind, Some(name.to_owned()), name);
        }
        for (name, colours) in [("one colour", ONE_COLOUR), ("two colours", TWO_COLOURS)] {
            let is_chosen = is_plain(now.background(), colours);
            if ui.selectable_label(is_chosen, name).clicked() && !is_chosen {
                behind = Some(colours.to_string());
            }
        }
        if ui.button("From a file…").on_hover_text("A picture: .png, .jpg, .hdr or .exr.").clicked() {
            actions.push(FileAction::Choose(Purpose::Behind));
        }
    });
    let behind = if is_reset { first.background.clone() } else { behind };
    actions.push_changed(&now.background, behind, set(SettingChange::Background));
}

/// The colour with which a background of one colour begins: that of light grey paper.
const ONE_COLOUR: Background = Background::Plain([0.75; 3]);

/// The colours with which a background of two colours begins: light grey above, darker below.
const TWO_COLOURS: Background = Background::Gradient { top: [0.85; 3], bottom: [0.45; 3] };

/// Returns whether a background has as many colours as another.
fn is_plain(behind: Option<BackgroundRef>, other: Background) -> bool {
    let Some(BackgroundRef::Plain(colours)) = behind else { return false };
    std::mem::discriminant(&colours) == std::mem::discriminant(&other)
}

/// Draws the pickers for the colours of a plain background.
fn plain_colours(before: Background, actions: &mut Actions, ui: &mut Ui) {
    let mut now = before;
    match &mut now {
        Background::Transparent => {}
        Background::Plain(colour) => {
            let Background::Plain(usual) = ONE_COLOUR else { return };
            picker(ui, ("Back colour", "The colour of the background of renders."), colour, usual);
        }
        Background::Gradient { top, bottom } => {
            let Background::Gradient { top: upper, bottom: lower } = TWO_COLOURS else { return };
            picker(ui, ("Upper colour", "The colour at the upper border of renders."), top, upper);
            picker(ui, ("Lower colour", "The colour at the lower border of renders."), bottom, lower);
        }
    }
    let set = |colours: Background| Edit::Setting(SettingChange::Background(Some(colours.to_string())));
    actions.push_changed(&before, now, set);
}

/// Draws a row with a picker for one of the colours.
fn picker(ui: &mut Ui, row: (&str, &str), colour: &mut [f32; 3], usual: [f32; 3]) {
    if let Some(picked) = colour_row(ui, row, colour.map(f64::from), Some(usual.map(f64::from))) {
        *colour = picked.map(|part| part as f32);
    }
}

/// Draws the rows for the background's distance and the strength of refraction.
fn behind_how(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let (now, first) = (&model.document.work.settings, model.document.first_settings());
    let unit_mm = model.document.specimen().unit_mm();
    if now.background.as_deref() != Some("light") {
        // A distance that is not set grows with the stone.
        let mm = |settings: &RenderSettings| settings.background_mm.unwrap_or(BEHIND * unit_mm);
        let about = "Distance of the background behind the middle of the scene. It is never nearer than the stones \
            reach.";
        let row = Row::new("Distance", about, 0.0..=20.0 * unit_mm);
        let row = Row { limits: 0.0..=f64::INFINITY, step: 0.1, decimals: 1, unit: " mm", ..row };
        let set = |set: f64| {
            let is_first = set == mm(first);
            Edit::Setting(SettingChange::BackgroundMm(if is_first { first.background_mm } else { Some(set) }))
        };
        row.by_default(mm(first)).edit(ui, actions, mm(now), set);
    }
    let meaning = "The strength of refraction. 1 is physics. A smaller number mixes the refracted ray with the \
        straight ray, which designers use for its looks.";
    let row = Row { step: 0.005, decimals: 3, ..Row::new("Strength", meaning, STRENGTHS) };
    row.by_default(first.strength).edit(ui, actions, now.strength, set(SettingChange::Strength));
}
