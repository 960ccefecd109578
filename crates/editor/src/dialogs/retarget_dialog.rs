//! The dialog that fits the design to another material: each tier before and after, and the light of both.

use super::answers::{answer, body, buttons_alone};
use crate::panels::rows::{ChoiceRow, NUMBER, Number, explain, named_with_reset, skip_control};
use crate::panels::stone_rows::material_choice;
use crate::theme;
use brillianteer_cut::Retargeted;
use brillianteer_math::signed;
use brillianteer_session::model::{
    action::{Actions, DialogAction},
    fitting::{FitOptions, FitRule, RetargetForm, StoneLight},
};
use egui::{Grid, Label, RichText, ScrollArea, Ui, vec2};

/// The width of the dialog, points.
const WIDTH: f32 = 600.0;

/// The greatest height of the list of tiers, points.
const TIERS: f32 = 230.0;

const MATERIAL: &str = "The material that the design is fitted to.";
const RULE: &str =
    "How the angles follow the material. No rule promises more light: compare the figures below.";
const FACTOR: &str = "The factor of the tangents. Without a number that is typed, the main tier, the flattest of the pavilion that \
    reaches the lowest point, keeps its margin over the critical angle.";

/// Draws the dialog.
pub fn show(form: &RetargetForm, actions: &mut Actions, ui: &mut Ui) {
    body(ui, WIDTH, |ui| {
        ui.heading("Fit to another material");
        ui.add_space(4.0);
        options(form, actions, ui);
        ui.add_space(6.0);
        match &form.found {
            Ok(found) => {
                tiers(found, ui);
                light(form, ui);
                for note in &found.notes {
                    ui.add(Label::new(RichText::new(sentence(note)).weak().small()).wrap());
                }
            }
            Err(why) => {
                ui.label(RichText::new(sentence(&why.to_string())).color(theme::bad(ui.visuals())));
            }
        }
    });
    let answers = [DialogAction::Apply, DialogAction::Leave];
    if form.found.as_ref().is_ok_and(|found| !found.tiers.is_empty()) {
        answer(actions, answers, buttons_alone(ui, &["Apply", "Cancel"]))
    } else {
        answer(actions, [DialogAction::Leave], buttons_alone(ui, &["Cancel"]))
    }
}

/// Draws the choices: the new material, the rule and its factor.
fn options(form: &RetargetForm, actions: &mut Actions, ui: &mut Ui) {
    let mut options = form.options.clone();
    if let Some(material) = material_choice(ui, ("New material", MATERIAL), &options.material, None) {
        options.material = material;
    }
    ChoiceRow::new("Rule", RULE, options.rule.name()).show(ui, |ui| {
        for rule in FitRule::ALL {
            if ui.selectable_label(rule == options.rule, rule.name()).on_hover_text(rule.meaning()).clicked()
            {
                options = FitOptions { rule, factor: None, ..options.clone() };
            }
        }
    });
    if options.rule != FitRule::CriticalAngle {
        let own = form.found.as_ref().map_or(1.0, |found| found.factor);
        let before = options.factor.unwrap_or(own);
        let mut factor = before;
        let number = Number { decimals: 4, speed: 0.001, range: 0.1..=10.0, unit: "", default: None };
        ui.horizontal(|ui| {
            let (label, is_reset) = named_with_reset(ui, "Factor", FACTOR);
            skip_control(ui, 0.0);
            let field = number.show(ui, (NUMBER, label.id), &mut factor);
            explain(ui, field, FACTOR);
            if is_reset {
                // The rule finds the factor.
                options.factor = None;
            } else if factor != before {
                options.factor = Some(factor);
            }
        });
    }
    actions.push_changed(&form.options, options, DialogAction::Fit);
}

/// Draws the tiers that change.
fn tiers(found: &Retargeted, ui: &mut Ui) {
    let [from, to] = found.critical_deg;
    let text = format!(
        "Critical angle {from:.2}° to {to:.2}°. The main tier is {}, and its tangent ratio {:.4}.",
        found.main, found.factor
    );
    ui.label(text);
    if found.tiers.is_empty() {
        ui.label(RichText::new("No angle changes; choose another material or factor.").weak());
        return;
    }
    let area = ScrollArea::vertical().id_salt("tiers").max_height(TIERS).auto_shrink([false, true]);
    area.show(ui, |ui| {
        Grid::new("retargeted").num_columns(5).spacing(vec2(22.0, 3.0)).striped(true).show(ui, |ui| {
            ["Tier", "Facets", "Before", "After", "Above critical"].into_iter().for_each(|head| {
                ui.label(RichText::new(head).weak());
            });
            ui.end_row();
            for tier in &found.tiers {
                let margin = -tier.after_deg - to;
                ui.label(tier.name.replace('_', " "));
                ui.label(tier.facets.to_string());
                ui.label(format!("{:.2}°", tier.before_deg));
                ui.label(format!("{:.2}°", tier.after_deg));
                let margin_text = RichText::new(format!("{}°", signed(margin, 2)));
                let is_leaking = margin < 0.0;
                let colour = theme::caution(ui.visuals());
                if tier.after_deg < 0.0 {
                    ui.label(if is_leaking { margin_text.color(colour) } else { margin_text })
                } else {
                    ui.label("")
                };
                ui.end_row();
            }
        });
    });
}

/// Draws the light of the stones beside one another. While it is measured, dots stand for the figures, so that the dialog
/// keeps its size.
fn light(form: &RetargetForm, ui: &mut Ui) {
    ui.add_space(6.0);
    let measured: &[StoneLight] = match &form.light {
        Some(Err(why)) => {
            ui.label(RichText::new(why.to_string()).color(theme::bad(ui.visuals())));
            return;
        }
        Some(Ok(light)) => light,
        None => &[],
    };
    let labels = form.light_request().map(|request| request.stones).unwrap_or_default();
    Grid::new("light").num_columns(4).min_col_width(96.0).spacing(vec2(22.0, 3.0)).striped(true).show(
        ui,
        |ui| {
            ui.label(RichText::new("% of the face, face up").weak());
            labels.iter().for_each(|(label, _)| {
                ui.label(RichText::new(label).weak());
            });
            ui.end_row();
            let mut row = |name: &str, of: &dyn Fn(&StoneLight) -> String| {
                ui.label(name);
                for place in 0..labels.len() {
                    ui.label(measured.get(place).map_or("…".to_owned(), of));
                }
                ui.end_row();
            };
            row("Light return", &|stone| {
                format!("{:.2} ± {:.2}", 100.0 * stone.light_return, 100.0 * stone.error)
            });
            row("Leakage", &|stone| format!("{:.2}", 100.0 * stone.leakage));
            row("Weight", &|stone| {
                stone.carats.map_or("not known".to_owned(), |carats| format!("{carats:.3} ct"))
            });
        },
    );
    ui.add_space(4.0);
}

/// Begins a text with a capital letter and ends it with a full stop.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}.", letters.as_str().trim_end_matches('.'))
}
