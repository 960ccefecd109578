//! Rows for the pane of liquid glass, which appear while a view shows it.

use crate::panels::row_focus;
use crate::panels::rows::{ChoiceRow, NUMBER, Row, control_width, explain, named_with_reset};
use brillianteer_picture::liquid_glass::PaneQuality;
use brillianteer_session::liquid::{LightMotion, Liquid};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
    render_settings::SettingChange,
};
use brillianteer_session::shows::Shows;
use egui::{Button, ComboBox, RichText, Ui, vec2};
use std::ops::RangeInclusive;

/// The range of the pane's width and height, percent of the view.
const EXTENTS: RangeInclusive<f64> = 10.0..=100.0;
/// The range of the corners' radius, percent of the pane's shorter side.
const CORNERS: RangeInclusive<f64> = 0.0..=50.0;
/// The range of the strengths.
const STRENGTHS: RangeInclusive<f64> = 0.0..=100.0;

/// The range of the gap between pane and background, in parts of the pane's shorter side.
const GAPS: RangeInclusive<f64> = 0.001..=1.0;

/// The range of the light's azimuth, degrees.
const AZIMUTHS: RangeInclusive<f64> = 0.0..=360.0;
/// The range of the light's height, degrees.
const HEIGHTS: RangeInclusive<f64> = 0.0..=90.0;

/// The drivers of the light: the name of each, and its meaning.
const MOTIONS: [(LightMotion, &str, &str); 3] = [
    (LightMotion::Fixed, "fixed", "The light stays where the next two rows set it."),
    (LightMotion::Pointer, "pointer", "The light follows the pointer over the view."),
    (LightMotion::Time, "time", "The light goes round the pane once in six seconds."),
];

/// The qualities: the name of each, and the part of the effect that it draws.
const QUALITIES: [(PaneQuality, &str, &str); 3] = [
    (PaneQuality::High, "high", "All effects; frost takes five samples, along both axes."),
    (PaneQuality::Medium, "medium", "Frost takes three samples side by side, and dispersion is 30 at most."),
    (PaneQuality::Low, "low", "Only refraction: no depth, dispersion, frost, light or tint."),
];

/// Draws the rows, where liquid glass is in sight.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let workspace = &model.workspace;
    let is_seen = |shows| workspace.shown().iter().any(|&pane| workspace.panes[pane].shows == shows);
    let [drawn, traced] = [Shows::LiquidGlass, Shows::TracedPane].map(is_seen);
    if !drawn && !traced {
        return;
    }
    ui.add_space(8.0);
    ui.label(RichText::new("Liquid glass").heading()).on_hover_text(
        "A pane in front of the background: drawn by five formulas as screens do it, or traced as real glass. \
            Strengths run from 0 to 100.",
    );
    let before = model.document.work.settings.liquid;
    let first = model.document.first_settings().liquid;
    let mut liquid = before;
    shape_rows(&mut liquid, &first, ui);
    if traced {
        let meaning =
            "The distance from the traced pane to the background, in parts of the pane's shorter side.";
        let row = Row::new("Gap", meaning, GAPS);
        let row = Row { step: 0.001, decimals: 3, speed: 0.002, logarithmic: true, ..row };
        row.by_default(first.gap).show(ui, &mut liquid.gap);
    }
    light_rows(&mut liquid, &first, ui);
    if liquid.light_motion == LightMotion::Fixed && before.light_motion != LightMotion::Fixed {
        // The light stays where it has come to.
        liquid.light_from = model.liquid().light_from;
    }
    tint_and_quality_rows(&mut liquid, &first, ui);
    actions.push_changed(&before, liquid, |liquid| Edit::Setting(SettingChange::Liquid(Box::new(liquid))));
}

/// Draws the rows for the pane's size and the strengths of its effects.
fn shape_rows(liquid: &mut Liquid, first: &Liquid, ui: &mut Ui) {
    let Liquid { size, corners, .. } = liquid;
    let width = "The width of the pane, in percent of the view.";
    let height = "The height of the pane, in percent of the view.";
    let radius = "The radius of its corners, in percent of its shorter side.";
    for (name, meaning, value, usual, range) in [
        ("Pane width", width, &mut size.x, first.size.x, EXTENTS),
        ("Pane height", height, &mut size.y, first.size.y, EXTENTS),
        ("Corners", radius, corners, first.corners, CORNERS),
    ] {
        let row = Row { step: 1.0, decimals: 0, speed: 0.2, unit: " %", ..Row::new(name, meaning, range) };
        row.by_default(usual).show(ui, value);
    }
    strength_rows(liquid, first, ui);
}

/// Draws the rows for how strongly the pane changes what is behind it.
fn strength_rows(liquid: &mut Liquid, first: &Liquid, ui: &mut Ui) {
    let Liquid { refraction, depth, dispersion, frost, light, .. } = liquid;
    for (name, meaning, value, usual) in [
        (
            "Refraction",
            "Bends the background at the rim. In the traced pane it is the index, 1 to 1.5.",
            refraction,
            first.refraction,
        ),
        (
            "Pane depth",
            "The depth that the pane seems to have. In the traced pane it is the thickness.",
            depth,
            first.depth,
        ),
        (
            "Dispersion",
            "Separates red from blue. In the traced pane it sets the Abbe number, 55 at 100.",
            dispersion,
            first.dispersion,
        ),
        (
            "Frost",
            "Blurs the background toward the rim, unevenly. The traced pane is always clear.",
            frost,
            first.frost,
        ),
        (
            "Pane light",
            "The strength of shine, shade and rim. Around the traced pane it is the brightness of a lamp and a sky.",
            light,
            first.light,
        ),
    ] {
        let row = Row { step: 1.0, decimals: 0, speed: 0.2, ..Row::new(name, meaning, STRENGTHS) };
        row.by_default(usual).show(ui, value);
    }
}

/// Draws the rows for the direction of the light.
fn light_rows(liquid: &mut Liquid, first: &Liquid, ui: &mut Ui) {
    let name = |motion| MOTIONS.iter().find(|(m, ..)| *m == motion).map_or("", |(_, name, _)| name);
    let meaning = "The light of the pane stays, follows the pointer, or goes round.";
    let row = ChoiceRow::new("Light follows", meaning, name(liquid.light_motion));
    let is_reset = row.by_default(name(first.light_motion)).show(ui, |ui| {
        for (motion, name, meaning) in MOTIONS {
            ui.selectable_value(&mut liquid.light_motion, motion, name).on_hover_text(meaning);
        }
    });
    if is_reset {
        liquid.light_motion = first.light_motion;
    }
    if liquid.light_motion != LightMotion::Fixed {
        return;
    }
    let from = &mut liquid.light_from;
    for (name, meaning, value, usual, range) in [
        (
            "Light azimuth",
            "The direction of the light, in degrees counter-clockwise from the right; 90 is above.",
            &mut from.azimuth,
            first.light_from.azimuth,
            AZIMUTHS,
        ),
        (
            "Light height",
            "The height of the light over the pane, in degrees: 0 along it, 90 from the eye.",
            &mut from.height,
            first.light_from.height,
            HEIGHTS,
        ),
    ] {
        let row = Row { step: 1.0, decimals: 0, speed: 0.5, unit: "°", ..Row::new(name, meaning, range) };
        row.by_default(usual).show(ui, value);
    }
}

/// Draws the rows for tint and quality.
fn tint_and_quality_rows(liquid: &mut Liquid, first: &Liquid, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let meaning = "The colour of the pane. Its alpha says how far it colours the light.";
        let (label, is_reset) = named_with_reset(ui, "Tint", meaning);
        if is_reset {
            liquid.tint = first.tint;
        }
        let button = ui.color_edit_button_srgba_unmultiplied(&mut liquid.tint).labelled_by(label.id);
        row_focus::part(&button);
        explain(ui, button, meaning);
    });
    ui.horizontal(|ui| {
        let meaning = "A lower quality draws fewer parts of the effect, in less time.";
        let (label, is_reset) = named_with_reset(ui, "Quality", meaning);
        if is_reset {
            liquid.quality = first.quality;
        }
        let chosen = QUALITIES.iter().find(|(q, ..)| *q == liquid.quality).map_or("", |(_, name, _)| name);
        let width = control_width(ui);
        let combo = ComboBox::from_id_salt("quality").selected_text(chosen).width(width).show_ui(ui, |ui| {
            for (quality, name, meaning) in QUALITIES {
                ui.selectable_value(&mut liquid.quality, quality, name).on_hover_text(meaning);
            }
        });
        let combo = combo.response.labelled_by(label.id);
        row_focus::part(&combo);
        explain(ui, combo, meaning);
        let reset = ui.add_sized(vec2(NUMBER, ui.spacing().interact_size.y), Button::new("Reset"));
        if reset.on_hover_text("Resets the pane to its first state.").clicked() {
            *liquid = *first;
        }
    });
}
