//! Rows for the light of renders, the backplate behind the stone, and the observer's head.

use crate::panels::rows::{ChoiceRow, Row, colour_row, field_width, skip_name};
use brillianteer_base::NumberRow;
use brillianteer_picture::light_picture;
use brillianteer_scene::{
    BACKGROUND_DISTANCE, BOUNCES, Background, BackgroundRef, EXPOSURE, GLOW, HEAD, LIGHT_TURN, LIGHTS, Look,
    STRENGTH, Tone, USUAL_DISTANCE, WAVELENGTHS, light,
};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit, FileAction},
    choosing::Purpose,
    command::Command,
    render_settings::BANDS,
};
use egui::{Button, ColorImage, Id, Image, TextureHandle, TextureOptions, Ui, Vec2, vec2};
use std::borrow::Cow;
use std::path::Path;

/// Draws the rows.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let before = &model.document.work.settings.look;
    let first = &model.document.first_settings().look;
    let mut look = before.clone();
    light_row(&mut look, first, actions, ui);
    number(ui, &LIGHT_TURN, &mut look, first);
    light_axis(&mut look, first, ui);
    number(ui, &EXPOSURE, &mut look, first);
    tone(&mut look, first, ui);
    wavelengths(&mut look, first, ui);
    number(ui, &GLOW, &mut look, first);
    number(ui, &BOUNCES, &mut look, first);
    behind(&mut look, first, actions, ui);
    match look.background.clone().filter(|background| !background.is_missing()) {
        Some(BackgroundRef::Plain(colours)) => plain_colours(colours, &mut look, ui),
        Some(_) => behind_how(&mut look, first, model.document.specimen().unit_mm(), ui),
        None => {}
    }
    number(ui, &HEAD, &mut look, first);
    // Who sets 0 wants no head of his own. A scene that states 0 keeps it until then.
    if look.head != before.head {
        look.head = look.head.filter(|head| *head > 0.0);
    }
    actions.push_changed(before, look, |look| Edit::Look(Box::new(look)));
    reset(before, first, actions, ui);
}

/// Draws the row of a number; one that is not stated shows as 0.
fn number(ui: &mut Ui, row: &'static NumberRow<Look>, look: &mut Look, first: &Look) {
    let stated = |look: &Look| (row.get)(look).unwrap_or(0.0);
    let mut now = stated(look);
    Row::of(row).by_default(stated(first)).show(ui, &mut now);
    if now != stated(look) {
        (row.set)(look, now);
    }
}

fn light_axis(look: &mut Look, first: &Look, ui: &mut Ui) {
    let meaning = "Where the axis of the light points in renders: to the eye, as a sky over a stone that lies on its culet, or \
        up, so that a panorama's horizon lies level behind the stone. The worlds sunset, room and city stand upright in \
        any case.";
    let name = |is_upright| if is_upright { "up" } else { "to the eye" };
    let row =
        ChoiceRow::new("Light axis", meaning, name(look.light_upright)).by_default(name(first.light_upright));
    let is_reset = row.show(ui, |ui| {
        for each in [false, true] {
            ui.selectable_value(&mut look.light_upright, each, name(each));
        }
    });
    if is_reset {
        look.light_upright = first.light_upright;
    }
}

fn tone(look: &mut Look, first: &Look, ui: &mut Ui) {
    let meaning = "The curve that brings bright light of renders below white. Linear cuts it off; neutral leaves all that a \
        screen can show as it is; filmic has deeper shadows and soft highlights.";
    let row = ChoiceRow::new("Tone curve", meaning, look.tone.name()).by_default(first.tone.name());
    let is_reset = row.show(ui, |ui| {
        for (name, each) in Tone::NAMES {
            ui.selectable_value(&mut look.tone, each, name);
        }
    });
    if is_reset {
        look.tone = first.tone;
    }
}

fn wavelengths(look: &mut Look, first: &Look, ui: &mut Ui) {
    let (present, usual) = (look.wavelengths.to_string(), first.wavelengths.to_string());
    let row = ChoiceRow::new(WAVELENGTHS.name, WAVELENGTHS.meaning, &present).by_default(&usual);
    let is_reset = row.show(ui, |ui| {
        for count in BANDS {
            ui.selectable_value(&mut look.wavelengths, count, count.to_string());
        }
    });
    if is_reset {
        look.wavelengths = first.wavelengths;
    }
}

/// Draws the button that resets all rows of the light.
fn reset(now: &Look, first: &Look, actions: &mut Actions, ui: &mut Ui) {
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
fn light_row(look: &mut Look, first: &Look, actions: &mut Actions, ui: &mut Ui) {
    let (present, usual) = (look.light.clone(), short(&first.light));
    let shown = short(&present);
    let row = ChoiceRow::new("Light", "The light around the stone in renders.", &shown).by_default(&usual);
    let is_reset = row.show(ui, |ui| {
        if ui.button("Another at random").on_hover_text(Command::AnotherLight.meaning()).clicked() {
            actions.push(Command::AnotherLight);
        }
        for name in LIGHTS {
            let about = light(name).map_or(String::new(), |light| light.description);
            let picture = light_thumbnail(ui, name);
            let entry = ui.add(Button::selectable(present == name, (picture, name)));
            if entry.on_hover_text(about).clicked() {
                name.clone_into(&mut look.light);
            }
        }
        let file = ui.button("From a file…");
        if file.on_hover_text("A light file, or a panorama: .hdr, .exr, .png or .jpg.").clicked() {
            actions.push(FileAction::Choose(Purpose::Light));
        }
    });
    if is_reset {
        look.light.clone_from(&first.light);
    }
}

/// Returns the words for a background.
fn background_name(background: Option<&BackgroundRef>) -> Cow<'_, str> {
    match background {
        None => "nothing".into(),
        Some(BackgroundRef::Plain(Background::Gradient { .. })) => "two colours".into(),
        Some(BackgroundRef::Plain(_)) => "one colour".into(),
        Some(other) => short(&other.to_string()).into_owned().into(),
    }
}

/// Draws the row of backgrounds behind the stone in renders.
fn behind(look: &mut Look, first: &Look, actions: &mut Actions, ui: &mut Ui) {
    let meaning = "The background of renders. Each ray shows the point of the background that it meets.";
    let before = look.background.clone();
    let [present, usual] = [before.as_ref(), first.background.as_ref()].map(background_name);
    let is_reset = ChoiceRow::new("Background", meaning, &present).by_default(&usual).show(ui, |ui| {
        let behind = &mut look.background;
        ui.selectable_value(behind, None, "nothing");
        ui.selectable_value(behind, Some(BackgroundRef::Light), "light")
            .on_hover_text("The light itself, for example a panorama.");
        for name in BackgroundRef::names() {
            ui.selectable_value(behind, Some(name.into()), name);
        }
        for (name, colours) in [("one colour", ONE_COLOUR), ("two colours", TWO_COLOURS)] {
            let is_chosen = is_plain(before.as_ref(), colours);
            if ui.selectable_label(is_chosen, name).clicked() && !is_chosen {
                *behind = Some(BackgroundRef::Plain(colours));
            }
        }
        if ui.button("From a file…").on_hover_text("A picture: .png, .jpg, .hdr or .exr.").clicked() {
            actions.push(FileAction::Choose(Purpose::Behind));
        }
    });
    if is_reset {
        look.background.clone_from(&first.background);
    }
}

/// The colour with which a background of one colour begins: that of light grey paper.
const ONE_COLOUR: Background = Background::Plain([0.75; 3]);

/// The colours with which a background of two colours begins: light grey above, darker below.
const TWO_COLOURS: Background = Background::Gradient { top: [0.85; 3], bottom: [0.45; 3] };

/// Returns whether a background has as many colours as another.
fn is_plain(behind: Option<&BackgroundRef>, other: Background) -> bool {
    let Some(BackgroundRef::Plain(colours)) = behind else { return false };
    std::mem::discriminant(colours) == std::mem::discriminant(&other)
}

/// Draws the pickers for the colours of a plain background.
fn plain_colours(before: Background, look: &mut Look, ui: &mut Ui) {
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
    if now != before {
        look.background = Some(BackgroundRef::Plain(now));
    }
}

/// Draws a row with a picker for one of the colours.
fn picker(ui: &mut Ui, row: (&str, &str), colour: &mut [f32; 3], usual: [f32; 3]) {
    if let Some(picked) = colour_row(ui, row, colour.map(f64::from), Some(usual.map(f64::from))) {
        *colour = picked.map(|part| part as f32);
    }
}

/// Draws the rows for the background's distance and the strength of refraction; `unit_mm` is the radius of the stone.
fn behind_how(look: &mut Look, first: &Look, unit_mm: f64, ui: &mut Ui) {
    if look.background != Some(BackgroundRef::Light) {
        // A distance that is not set grows with the stone.
        let mm = |look: &Look| look.background_mm.unwrap_or(USUAL_DISTANCE * unit_mm);
        let mut now = mm(look);
        let row = Row { range: 0.0..=20.0 * unit_mm, ..Row::of(&BACKGROUND_DISTANCE) };
        row.by_default(mm(first)).show(ui, &mut now);
        if now != mm(look) {
            look.background_mm = if now == mm(first) { first.background_mm } else { Some(now) };
        }
    }
    number(ui, &STRENGTH, look, first);
}
