//! Rows for the pane of liquid glass, which appear while a view shows it.

use crate::panels::row_focus;
use crate::panels::rows::{ChoiceRow, NUMBER, Row, control_width, explain, named_with_reset};
use brillianteer_base::NumberRow;
use brillianteer_picture::liquid_glass::PaneQuality;
use brillianteer_session::liquid::{LightMotion, Liquid, PANE_GAP, PANE_LIGHT_NUMBERS, PANE_NUMBERS};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
};
use brillianteer_session::shows::Shows;
use egui::{Button, ComboBox, RichText, Ui, vec2};

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
    PANE_NUMBERS.iter().for_each(|row| number(row, &mut liquid, &first, ui));
    if traced {
        number(&PANE_GAP, &mut liquid, &first, ui);
    }
    light_rows(&mut liquid, &first, ui);
    if liquid.light_motion == LightMotion::Fixed && before.light_motion != LightMotion::Fixed {
        // The light stays where it has come to.
        liquid.light_from = model.liquid().light_from;
    }
    tint_and_quality_rows(&mut liquid, &first, ui);
    actions.push_changed(&before, liquid, |liquid| Edit::Liquid(Box::new(liquid)));
}

/// Draws the row of a number of the pane.
fn number(row: &'static NumberRow<Liquid>, liquid: &mut Liquid, first: &Liquid, ui: &mut Ui) {
    let (Some(before), default) = ((row.get)(liquid), (row.get)(first)) else { return };
    let mut now = before;
    let logarithmic = row.key == PANE_GAP.key;
    let speed = if logarithmic { 0.002 } else { 0.2 };
    Row { speed, logarithmic, default, ..Row::of(row) }.show(ui, &mut now);
    if now != before {
        (row.set)(liquid, now);
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
    PANE_LIGHT_NUMBERS.iter().for_each(|row| number(row, liquid, first, ui));
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
