//! Rows for the light of renders, the backplate behind the stone, and the observer's head.

use crate::app::model::Model;
use crate::app::model::action::{Actions, Edit, FileAction, ViewAction};
use crate::app::model::choosing::Purpose;
use crate::app::model::command::Command;
use crate::app::model::workspace::{WAVELENGTHS, Workspace};
use crate::app::panels::rows::{Row, choice_row, colour_row};
use crate::app::studio::BEHIND;
use crate::io::background::BackgroundRef;
use crate::picture::{Background, light_picture};
use crate::render::USUAL_BOUNCES;
use crate::scene::{LIGHTS, light};
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
    let (work, workspace) = (&model.document.work, &model.workspace);
    light_row(&work.light, actions, ui);
    let meaning = "The angle by which the light of renders is turned about its axis.";
    let turn = Row { step: 1.0, decimals: 1, unit: "°", ..Row::new("Light turn", meaning, TURNS) };
    turn.edit(ui, actions, workspace.light_turn, ViewAction::LightTurn);
    let mut upright = workspace.light_upright;
    let meaning = "Where the axis of the light points in renders: to the eye, as a sky over a stone that lies on its culet, or \
        up, so that a panorama's horizon lies level behind the stone. The worlds sunset, room and city stand upright in \
        any case.";
    let names = ["to the eye", "up"];
    choice_row(ui, "Light axis", meaning, names[usize::from(upright)], |ui| {
        ui.selectable_value(&mut upright, false, names[0]);
        ui.selectable_value(&mut upright, true, names[1]);
    });
    actions.push_changed(&workspace.light_upright, upright, ViewAction::LightUpright);
    let meaning = "The brightness of renders, in stops. One stop more is twice the light.";
    let exposure = Row { step: 0.1, decimals: 1, unit: " stops", ..Row::new("Exposure", meaning, STOPS) };
    exposure.edit(ui, actions, work.exposure, Edit::Exposure);
    let mut count = workspace.wavelengths;
    let meaning = "The number of bands of wavelengths into which renders split light. With few, a rainbow breaks \
        into steps of colour; hold Z to see three.";
    choice_row(ui, "Wavelengths", meaning, &count.to_string(), |ui| {
        WAVELENGTHS.into_iter().for_each(|n| drop(ui.selectable_value(&mut count, n, n.to_string())));
    });
    actions.push_changed(&workspace.wavelengths, count, ViewAction::Wavelengths);
    let meaning = "How much of the light of sparkles spreads around them in renders, as in an eye or a lens; 0 for none. A rough \
        picture has none.";
    let glow = Row { step: 0.01, decimals: 2, ..Row::new("Glow", meaning, GLOWS) };
    glow.edit(ui, actions, workspace.glow, ViewAction::Glow);
    let meaning = "The number of bounces inside the stone after which renders follow light no farther. Raise it from 1 to \
        see what each bounce adds; light that is left is dark.";
    let bounces = Row { step: 1.0, decimals: 0, ..Row::new("Most bounces", meaning, BOUNCES) };
    let counted = |bounces: f64| ViewAction::Bounces(bounces.round() as u32);
    bounces.edit(ui, actions, f64::from(workspace.bounces), counted);
    behind(workspace, actions, ui);
    let background = workspace.background();
    if let Some(BackgroundRef::Plain(colours)) = background {
        plain_colours(colours, actions, ui);
    } else if workspace.behind.is_some() {
        behind_how(workspace, model.document.specimen().unit_mm(), actions, ui);
    }
    let meaning =
        "Half angle of the observer's head, which blocks light in the ASET and in figures; 0 for none.";
    let head = Row { step: 0.1, decimals: 1, unit: "°", ..Row::new("Head", meaning, HEADS) };
    head.edit(ui, actions, work.head, Edit::Head);
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
fn light_row(present: &str, actions: &mut Actions, ui: &mut Ui) {
    choice_row(ui, "Light", "The light around the stone in renders.", &short(present), |ui| {
        if ui.button("Another at random").on_hover_text(Command::AnotherLight.meaning()).clicked() {
            actions.push(Command::AnotherLight);
        }
        for name in LIGHTS {
            let about = light(name).map_or(String::new(), |light| light.description);
            let picture = light_thumbnail(ui, name);
            let entry = ui.add(Button::selectable(present == name, (picture, name)));
            if entry.on_hover_text(about).clicked() {
                actions.push(Edit::Light(name.to_owned()));
            }
        }
        let file = ui.button("From a file…");
        if file.on_hover_text("A light file, or a panorama: .hdr, .exr, .png or .jpg.").clicked() {
            actions.push(FileAction::Choose(Purpose::Light));
        }
    });
}

/// Draws the row of backplates behind the stone in renders.
fn behind(workspace: &Workspace, actions: &mut Actions, ui: &mut Ui) {
    let mut behind = workspace.behind.clone();
    let meaning = "The background of renders. Each ray shows the point of the background that it meets.";
    let present = workspace.behind.as_deref().map_or("nothing".into(), short);
    choice_row(ui, "Background", meaning, &present, |ui| {
        ui.selectable_value(&mut behind, None, "nothing");
        ui.selectable_value(&mut behind, Some("light".to_owned()), "light")
            .on_hover_text("The light itself, for example a panorama.");
        for name in BackgroundRef::names() {
            ui.selectable_value(&mut behind, Some(name.to_owned()), name);
        }
        for (name, colours) in [("one colour", ONE_COLOUR), ("two colours", TWO_COLOURS)] {
            let is_chosen = is_plain(workspace.background(), colours);
            if ui.selectable_label(is_chosen, name).clicked() && !is_chosen {
                behind = Some(colours.to_string());
            }
        }
        if ui.button("From a file…").on_hover_text("A picture: .png, .jpg, .hdr or .exr.").clicked() {
            actions.push(FileAction::Choose(Purpose::Behind));
        }
    });
    actions.push_changed(&workspace.behind, behind, ViewAction::Behind);
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
            picker(ui, ("Back colour", "The colour of the background of renders."), colour);
        }
        Background::Gradient { top, bottom } => {
            picker(ui, ("Upper colour", "The colour at the upper border of renders."), top);
            picker(ui, ("Lower colour", "The colour at the lower border of renders."), bottom);
        }
    }
    actions.push_changed(&before, now, |colours| ViewAction::Behind(Some(colours.to_string())));
}

/// Draws a row with a picker for one of the colours.
fn picker(ui: &mut Ui, row: (&str, &str), colour: &mut [f32; 3]) {
    if let Some(picked) = colour_row(ui, row, colour.map(f64::from)) {
        *colour = picked.map(|part| part as f32);
    }
}

/// Draws the rows for the backplate's distance and the strength of refraction.
fn behind_how(workspace: &Workspace, unit_mm: f64, actions: &mut Actions, ui: &mut Ui) {
    if workspace.behind.as_deref() != Some("light") {
        let mm = workspace.behind_mm.unwrap_or(BEHIND * unit_mm);
        let about = "Distance of the background behind the middle of the scene. It is never nearer than the stones \
            reach.";
        let row = Row::new("Distance", about, 0.0..=20.0 * unit_mm);
        let row = Row { limits: 0.0..=f64::INFINITY, step: 0.1, decimals: 1, unit: " mm", ..row };
        row.edit(ui, actions, mm, ViewAction::BehindMm);
    }
    let meaning = "The strength of refraction. 1 is physics. A smaller number mixes the refracted ray with the \
        straight ray, which designers use for its looks.";
    let row = Row::new("Strength", meaning, STRENGTHS);
    Row { step: 0.005, decimals: 3, ..row }.edit(ui, actions, workspace.strength, ViewAction::Strength);
}
