//! The design panel: proportions, stone, light and copies.

use crate::app::model::Model;
use crate::app::model::action::{Actions, Edit};
use crate::app::model::document::Document;
use crate::app::model::workspace::PanelSide;
use crate::app::panels::impossible::{self, RowMessage};
use crate::app::panels::proportions::{EXCELLENT_DEPTH, PROPORTIONS, Proportion};
use crate::app::panels::rows::{ANY, NUMBER, Number, control_width, explain, field_width, named};
use crate::app::panels::{
    company_rows, glass_rows, light_rows, mesh_rows, side_panels, stone_rows, tier_rows,
};
use crate::app::theme;
use crate::cut::{Cut, Design, DesignError, MaterialRef, RoundBrilliant, Unit};
use crate::scene::{Copies, SpecimenError};
use egui::{
    Color32, Panel, Rect, RichText, Role, ScrollArea, Sense, Slider, SliderClamping, Stroke, StrokeKind,
    TextEdit, Ui, WidgetInfo, pos2, vec2,
};
use std::ops::RangeInclusive;

/// Draws the design panel.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui, widths: RangeInclusive<f32>) {
    Panel::left("design").resizable(true).default_size(360.0).size_range(widths).show(ui, |ui| {
        side_panels::head(actions, ui, PanelSide::Design);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            identity(&model.document, actions, ui);
            let work = &model.document.work;
            if matches!(work.design.cut, Cut::Glass(_)) || work.company != Copies::default() {
                company_rows::presets(actions, ui);
            }
            let meaning = match is_graded(&work.design) {
                true => "Drag a slider or type a number; the green mark is the range GIA calls excellent.",
                false => "Drag a slider or type a number.",
            };
            heading(ui, "Proportions", meaning);
            mesh_rows::show(model, actions, ui);
            proportions(model, actions, ui);
            heading(ui, "Stone", "What it is made of, and how large it is.");
            stone_rows::show(model, actions, ui);
            heading(ui, "Light", "What the render is lit by; scopes bring their own light.");
            light_rows::show(model, actions, ui);
            heading(ui, "Copies", "Renders show several of it, and let them move.");
            company_rows::show(model, actions, ui);
        });
    });
}

/// Whether GIA's ranges for the grade Excellent apply: they are for round brilliants of diamond.
fn is_graded(design: &Design) -> bool {
    let is_diamond =
        matches!(&design.material, MaterialRef::Name(name) if name.eq_ignore_ascii_case("diamond"));
    is_diamond && matches!(design.cut, Cut::RoundBrilliant(_))
}

fn heading(ui: &mut Ui, text: &str, meaning: &str) {
    ui.add_space(8.0);
    let label = ui.label(RichText::new(text).heading());
    explain(ui, label, meaning);
    ui.add_space(2.0);
}

/// Draws the rows for the name of the design and the family of its cut.
fn identity(document: &Document, actions: &mut Actions, ui: &mut Ui) {
    let design = &document.work.design;
    ui.horizontal(|ui| {
        let label = named(ui, "Name", "What the design is called, in its file and on its pictures.");
        let mut name = design.name.clone();
        let field = TextEdit::singleline(&mut name).desired_width(field_width(ui));
        if ui.add(field).labelled_by(label.id).changed() {
            actions.push(Edit::Name(name));
        }
    });
    if let Some(fault @ SpecimenError::Design(DesignError::Name)) = document.fault() {
        wrong(ui, &fault.to_string());
    }
    ui.horizontal(|ui| {
        named(ui, "Cut", "The family: which facets there are, and which numbers shape them.");
        ui.label(match design.cut {
            Cut::RoundBrilliant(_) => "Round brilliant",
            Cut::Tiers(_) => "Tiers on an index gear",
            Cut::Planes(_) => "Facets by their planes",
            Cut::Mesh(_) => "Triangles of a mesh",
            Cut::Glass(glass) => glass.called().1,
        });
    });
}

/// Draws the rows for the shape of the stone, and what is wrong with it.
fn proportions(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let document = &model.document;
    let said = impossible(model);
    match &document.work.design.cut {
        Cut::RoundBrilliant(brilliant) => {
            let changed = brilliant_rows(*brilliant, is_graded(&document.work.design), said.as_ref(), ui);
            changed.into_iter().for_each(|edit| actions.push(edit));
        }
        Cut::Glass(glass) => {
            let mut changed = *glass;
            glass_rows::show(&mut changed, ui);
            actions.push_changed(glass, changed, |glass| Edit::Cut(Cut::Glass(glass)));
        }
        Cut::Mesh(_) => {}
        Cut::Tiers(_) | Cut::Planes(_) => tier_rows::show(document, actions, ui),
    }
    warnings(document, ui);
    let is_name = matches!(document.fault(), Some(SpecimenError::Design(DesignError::Name)));
    if let Some(fault) = document.fault().filter(|_| !is_name && said.is_none()) {
        wrong(ui, &fault.to_string());
    }
}

/// Draws the rows for the proportions of a round brilliant; returns what the user has changed.
fn brilliant_rows(
    before: RoundBrilliant,
    is_graded: bool,
    said: Option<&RowMessage>,
    ui: &mut Ui,
) -> Option<Edit> {
    let (mut brilliant, mut edited) = (before, None);
    for proportion in &PROPORTIONS {
        if row(ui, proportion, &mut brilliant, is_graded) {
            edited = Some(proportion.key);
        }
        if let Some(said) = said.filter(|said| said.key == proportion.key) {
            wrong(ui, &said.text);
        }
    }
    derived(ui, &brilliant, is_graded);
    let cut = Cut::RoundBrilliant(brilliant);
    match edited {
        Some(key) => Some(Edit::Proportion(key, cut)),
        None => (brilliant != before).then_some(Edit::Cut(cut)),
    }
}

/// Explains what is wrong with the proportions of a round brilliant, and at which row to say so.
fn impossible(model: &Model) -> Option<RowMessage> {
    let Some(SpecimenError::Design(DesignError::Proportion(fault))) = model.document.fault() else {
        return None;
    };
    let given = model.document.work.design.cut.brilliant()?;
    let last = model.document.specimen().design.cut.brilliant()?;
    Some(impossible::explain(given, last, model.session.edited, fault))
}

fn wrong(ui: &mut Ui, fault: &str) {
    ui.label(RichText::new(fault).color(theme::bad(ui.visuals())));
}

/// The greatest number of warnings that the panel shows.
const MOST_WARNINGS: usize = 12;

/// Draws the warnings about the stone and its file.
fn warnings(document: &Document, ui: &mut Ui) {
    let stones = document.specimen().warnings.iter().filter(|_| document.fault().is_none());
    let all: Vec<&String> = stones.chain(document.work.remarks.iter()).collect();
    let small = |text: &str| egui::Label::new(RichText::new(text).weak().small()).wrap();
    for warning in all.iter().take(MOST_WARNINGS) {
        ui.add(small(warning));
    }
    if all.len() > MOST_WARNINGS {
        ui.add(small(&format!("and {} more", all.len() - MOST_WARNINGS)));
    }
}

/// Draws one proportion: name, slider, number, and for one of a pair whether it is held; where GIA grades it, also the
/// range of the grade Excellent. Returns whether it was changed.
fn row(ui: &mut Ui, proportion: &Proportion, brilliant: &mut RoundBrilliant, is_graded: bool) -> bool {
    ui.horizontal(|ui| {
        let label = named(ui, proportion.name, proportion.meaning);
        ui.spacing_mut().slider_width = control_width(ui);
        let (first, last) = (*proportion.slider.start(), *proportion.slider.end());
        let mut value = (proportion.get)(brilliant);
        let before = value;
        let whole = proportion.unit == Unit::Count;
        let decimals = if whole { 0 } else { 2 };
        let step = if whole { 8.0 } else { 0.1 };
        let mark = ui.painter().add(egui::Shape::Noop);
        let slider = Slider::new(&mut value, first..=last).show_value(false).step_by(step).smart_aim(false);
        let slider = ui.add(slider.clamping(SliderClamping::Never)).labelled_by(label.id);
        let slider = explain(ui, slider, &range(proportion, is_graded));
        if let Some(good) = proportion.excellent.as_ref().filter(|_| is_graded) {
            let band = band(slider.rect, good, &proportion.slider);
            ui.painter().set(
                mark,
                egui::Shape::rect_filled(band, 2.0, theme::good(ui.visuals()).gamma_multiply(0.75)),
            );
        }
        let (speed, unit) = (if whole { 0.2 } else { 0.02 }, proportion.unit.to_string());
        Number { decimals, speed, range: ANY, unit: &unit }.show(ui, (NUMBER, label.id), &mut value);
        let is_changed = value != before && value.is_finite();
        if is_changed {
            (proportion.set)(brilliant, value);
        }
        hold(ui, proportion, brilliant);
        is_changed
    })
    .inner
}

/// Returns where a range lies on a slider: a band under its rail.
fn band(slider: Rect, range: &RangeInclusive<f64>, whole: &RangeInclusive<f64>) -> Rect {
    let handle = slider.height() / 2.5;
    let (left, right) = (slider.left() + handle, slider.right() - handle);
    let x = |v: f64| left + (right - left) * ((v - whole.start()) / (whole.end() - whole.start())) as f32;
    let y = slider.center().y;
    Rect::from_min_max(pos2(x(*range.start()), y + 5.0), pos2(x(*range.end()), y + 8.0))
}

fn range(proportion: &Proportion, is_graded: bool) -> String {
    let good = proportion
        .excellent
        .as_ref()
        .filter(|_| is_graded)
        .map(|e| format!(" GIA calls {} to {}{} excellent.", e.start(), e.end(), proportion.unit));
    format!("{}{}", proportion.meaning, good.unwrap_or_default())
}

fn hold(ui: &mut Ui, proportion: &Proportion, brilliant: &mut RoundBrilliant) {
    let Some(hold) = &proportion.hold else { return };
    let held = (hold.is)(brilliant);
    let meaning = if held {
        "Held: it stays when other proportions change."
    } else {
        "Hold this one when other proportions change."
    };
    let side = ui.spacing().interact_size.y;
    let (rect, response) = ui.allocate_exact_size(vec2(side, side), Sense::click());
    lock(ui, rect, held, &response);
    let response = explain(ui, response, meaning);
    let name = format!("Hold {}", proportion.name.to_lowercase());
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, held, &name));
    if response.clicked() && !held {
        (hold.set)(brilliant);
    }
}

/// Draws a padlock, open or shut.
fn lock(ui: &Ui, rect: Rect, shut: bool, response: &egui::Response) {
    let visuals = ui.style().interact(response);
    let colour =
        if shut { theme::accent(ui.visuals()) } else { visuals.fg_stroke.color.gamma_multiply(0.55) };
    let body = Rect::from_center_size(rect.center() + vec2(0.0, 3.0), vec2(10.0, 7.0));
    ui.painter().rect_filled(body, 1.5, colour);
    let (left, right) = (body.left() + 2.0, body.right() - 2.0);
    let lift = if shut { 0.0 } else { 2.5 };
    let (foot, top) = (body.top(), body.top() - 6.0 - lift);
    let bow = vec![
        pos2(left, foot),
        pos2(left, top + 2.0),
        pos2(left + 2.0, top),
        pos2(right - 2.0, top),
        pos2(right, top + 2.0),
        pos2(right, foot - 2.0 * lift),
    ];
    ui.painter().line(bow, Stroke::new(1.6, colour));
    if response.has_focus() {
        ui.painter().rect_stroke(rect.shrink(1.0), 3.0, ui.visuals().selection.stroke, StrokeKind::Inside);
    }
}

/// Draws the quantities that follow from the proportions.
fn derived(ui: &mut Ui, brilliant: &RoundBrilliant, is_graded: bool) {
    let Ok(derived) = brilliant.derived() else { return };
    let depth = derived.total_depth;
    let is_excellent = is_graded && EXCELLENT_DEPTH.contains(&depth);
    let colour = if is_excellent { theme::good(ui.visuals()) } else { ui.visuals().text_color() };
    let about = if is_graded { " GIA calls 58.1 to 63.6 % excellent." } else { "" };
    ui.add_space(4.0);
    egui::Grid::new("derived").num_columns(2).spacing(vec2(12.0, 4.0)).show(ui, |ui| {
        let mut line = |name: &str, value: String, colour: Option<Color32>, meaning: &str| {
            let label = ui.label(RichText::new(name).weak());
            explain(ui, label, meaning);
            let text = RichText::new(value).monospace();
            ui.label(match colour {
                Some(colour) => text.color(colour),
                None => text,
            });
            ui.end_row();
        };
        line("Total depth", format!("{depth:6.2} %"), Some(colour), &format!("From table to culet.{about}"));
        line(
            "Star angle",
            format!("{:6.2}°", derived.star_angle),
            None,
            "How steep the small facets around the table are.",
        );
        line(
            "Upper halves",
            format!("{:6.2}°", derived.upper_half_angle),
            None,
            "How steep the crown facets at the girdle are.",
        );
        line(
            "Lower halves",
            format!("{:6.2}°", derived.lower_half_angle),
            None,
            "How steep the pavilion facets at the girdle are.",
        );
        let thinnest = derived.girdle_thickness_valley;
        let thinnest = if thinnest > 0.0 { format!("{thinnest:6.2} %") } else { "closed".to_owned() };
        let valley = "Thickness of the rim where it is thinnest, between the bezels.";
        line("Girdle valleys", thinnest, None, valley);
    });
}
