//! The design panel: proportions, stone, light and copies.

use crate::panels::row_focus;
use crate::panels::rows::{ANY, FilledRow, NOT_KNOWN, Row, explain, field_width, named, wrong};
use crate::panels::{copy_rows, light_rows, mesh_rows, scene_rows, side_panels, stone_rows, tier_rows};
use crate::theme;
use brillianteer_base::Unit;
use brillianteer_cut::{Cut, Design, DesignError, MaterialRef, Proportion, Warning};
use brillianteer_math::fixed;
use brillianteer_scene::{Copies, SpecimenError};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
    command::Command,
    document::Document,
    impossible::{self, RowMessage},
    workspace::PanelSide,
};
use egui::{
    Button, Panel, Rect, RichText, Role, ScrollArea, Stroke, StrokeKind, TextEdit, Ui, WidgetInfo, pos2, vec2,
};
use std::ops::RangeInclusive;

/// Draws the design panel.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui, widths: RangeInclusive<f32>) {
    Panel::left("design").resizable(true).default_size(360.0).size_range(widths).show(ui, |ui| {
        side_panels::head(actions, ui, PanelSide::Design);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            identity(&model.document, actions, ui);
            let work = &model.document.work;
            let is_scene = !work.companions.is_empty();
            if !is_scene && (matches!(work.design.cut, Cut::Glass(_)) || work.copies != Copies::default()) {
                copy_rows::presets(actions, ui);
            }
            let meaning = if is_graded(&work.design) {
                "Drag a slider or type a number. The green band is the range that GIA calls excellent."
            } else {
                "Drag a slider or type a number."
            };
            heading(ui, "Proportions", meaning);
            mesh_rows::show(model, actions, ui);
            proportions(model, actions, ui);
            heading(ui, "Stone", "The material and the size of the stone.");
            stone_rows::show(model, actions, ui);
            heading(ui, "Light", "The light of renders. Scopes have a light of their own.");
            light_rows::show(model, actions, ui);
            if is_scene {
                heading(
                    ui,
                    "Scene",
                    "Renders show all stones of the scene; every other view shows the one that is edited.",
                );
                scene_rows::show(model, actions, ui);
            } else {
                heading(ui, "Copies", "Renders can show several copies, and move them.");
            }
            copy_rows::show(model, actions, ui);
        });
    });
}

/// Returns whether GIA's ranges for the grade Excellent apply to the design: they hold for diamond.
fn is_graded(design: &Design) -> bool {
    let is_diamond =
        matches!(&design.material, MaterialRef::Name(name) if name.eq_ignore_ascii_case("diamond"));
    is_diamond && design.cut.proportions().iter().any(|row| row.excellent.is_some())
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
        let label = named(ui, "Name", "The name of the design in its file and on its pictures.");
        let mut name = design.name.clone();
        let field = TextEdit::singleline(&mut name).desired_width(field_width(ui));
        actions.push_if(ui.add(field).labelled_by(label.id).changed(), Edit::Name(name));
    });
    if let Some(fault @ SpecimenError::Design(DesignError::Name)) = document.fault() {
        wrong(ui, &fault.to_string());
    }
    ui.horizontal(|ui| {
        named(
            ui,
            "Cut",
            "The family of the cut. It sets which facets there are, and which numbers shape them.",
        );
        let family = match design.cut {
            Cut::Tiers(_) => "Tiers on an index gear",
            Cut::Planes(_) => "Facets given by planes",
            Cut::Mesh(_) => "Triangles of a mesh",
            Cut::RoundBrilliant(_) | Cut::Family(_) | Cut::Glass(_) => {
                design.cut.family().map_or("", |family| family.name)
            }
        };
        let button = Button::new(format!("{family}…")).truncate().min_size(vec2(field_width(ui), 0.0));
        let response = ui.add(button).on_hover_text(Command::New.meaning());
        actions.push_if(response.clicked(), Command::New);
    });
}

/// Draws the rows for the shape of the stone, with a message where the shape is impossible.
fn proportions(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let document = &model.document;
    let said = impossible(model);
    let is_name = matches!(document.fault(), Some(SpecimenError::Design(DesignError::Name)));
    let is_possible = is_name || document.fault().is_none();
    let changed = proportion_rows(document, is_possible, said.as_ref(), ui);
    changed.into_iter().for_each(|edit| actions.push(edit));
    if matches!(document.work.design.cut, Cut::Tiers(_) | Cut::Planes(_)) {
        tier_rows::show(document, actions, ui);
    }
    warnings(document, ui);
    if let Some(fault) = document.fault().filter(|_| !is_name && said.is_none()) {
        wrong(ui, &impossible::by_name(fault));
    }
}

/// Draws the rows for the proportions of the family of a cut, if it has one; returns the user's edit. Numbers that follow
/// from impossible proportions are not shown.
fn proportion_rows(
    document: &Document,
    is_possible: bool,
    said: Option<&RowMessage>,
    ui: &mut Ui,
) -> Option<Edit> {
    let design = &document.work.design;
    let first = &document.saved().cut;
    let is_of_family = first.family().map(|own| own.key) == design.cut.family().map(|own| own.key);
    // A cut without a family may hold a mesh, which is not copied for nothing.
    design.cut.family()?;
    let is_graded = is_graded(design);
    let (mut cut, mut edited) = (design.cut.clone(), None);
    let (given, follow): (Vec<_>, Vec<_>) = cut.proportions().iter().partition(|row| row.can_be_set());
    for proportion in given {
        let default = is_of_family.then(|| (proportion.get)(first));
        // What follows from impossible numbers is no number of a stone; one that is wrong itself is shown as it was set.
        let is_known =
            is_possible || proportion.give.is_some() || said.is_some_and(|said| said.row == proportion);
        if row(ui, (proportion, default, is_known), &mut cut, is_graded) {
            edited = Some(proportion.key);
        }
        if let Some(said) = said.filter(|said| said.row == proportion) {
            wrong(ui, &said.text);
        } else if let Some(moved) = moved(proportion, &cut) {
            ui.add(egui::Label::new(RichText::new(moved).weak().small()).wrap());
        }
    }
    if !follow.is_empty() && is_possible {
        derived(ui, &follow, &cut, is_graded);
    }
    match edited {
        Some(key) => Some(Edit::Proportion(key, cut)),
        None => (cut != design.cut).then_some(Edit::Cut(cut)),
    }
}

/// Returns the names of the numbers that a proportion moves, with their values; `None` for one that moves no others.
fn moved(row: &Proportion, cut: &Cut) -> Option<String> {
    let named = |key: &&str| {
        let row = cut.proportion(key)?;
        Some(format!("{} {}", row.name.to_lowercase(), row.written((row.get)(cut))))
    };
    let moved: Vec<String> = row.moves.iter().filter_map(named).collect();
    (!moved.is_empty()).then(|| format!("{} by {}", row.name, moved.join(", ")))
}

/// Returns the message about impossible proportions and the row that shows it.
fn impossible(model: &Model) -> Option<RowMessage> {
    let Some(SpecimenError::Design(DesignError::Proportion(fault))) = model.document.fault() else {
        return None;
    };
    let (given, last) = (&model.document.work.design.cut, &model.document.specimen().design.cut);
    let is_same_family = given.family()?.key == last.family()?.key;
    is_same_family.then(|| impossible::explain(given, last, model.session.edited, fault))
}

/// The greatest number of warnings that the panel shows.
const MOST_WARNINGS: usize = 12;

/// Draws the warnings about the stone and its file.
fn warnings(document: &Document, ui: &mut Ui) {
    let specimen = document.specimen();
    let unusual = specimen.unusual.iter().map(Warning::by_name);
    let stones = unusual.chain(specimen.warnings.iter().cloned()).filter(|_| document.fault().is_none());
    let all: Vec<String> = stones.chain(document.work.remarks.iter().cloned()).collect();
    let small = |text: &str| egui::Label::new(RichText::new(text).weak().small()).wrap();
    for warning in all.iter().take(MOST_WARNINGS) {
        ui.add(small(warning));
    }
    if all.len() > MOST_WARNINGS {
        ui.add(small(&format!("and {} more", all.len() - MOST_WARNINGS)));
    }
}

/// Draws one proportion: name, slider and number, and for one of a pair a padlock; where GIA grades it, also the
/// range of the grade Excellent. A double click sets it to `first`. A value that is not known is shown as a dash. Returns whether the
/// user changed it.
fn row(
    ui: &mut Ui,
    (proportion, first, is_known): (&Proportion, Option<f64>, bool),
    cut: &mut Cut,
    is_graded: bool,
) -> bool {
    let Proportion { name, unit, usual: [least, most], step, speed, .. } = *proportion;
    ui.horizontal(|ui| {
        let mut value = if is_known { (proportion.get)(cut) } else { NOT_KNOWN };
        let before = value;
        let mark = ui.painter().add(egui::Shape::Noop);
        let decimals = if unit == Unit::Count { 0 } else { 2 };
        let (meaning, unit) = (range(proportion, is_graded), unit.to_string());
        let row = Row::new(name, &meaning, least..=most);
        let row = Row { limits: ANY, step, decimals, speed, unit: &unit, default: first, ..row };
        let known = ui.make_persistent_id(("number of", proportion.key));
        let is_held = proportion.pair.is_some() && row_focus::takes_space(ui, known);
        let FilledRow { slider, number } = row.fill(ui, &mut value);
        ui.data_mut(|data| data.insert_temp(known, number));
        if let Some(good) = proportion.excellent.filter(|_| is_graded) {
            let band = band(slider, good, proportion.usual);
            let colour = theme::good(ui.visuals()).gamma_multiply(0.75);
            ui.painter().set(mark, egui::Shape::rect_filled(band, 2.0, colour));
        }
        let is_changed = value != before && value.is_finite();
        if is_changed {
            proportion.set(cut, value);
        }
        hold(ui, proportion, cut, is_held);
        is_changed
    })
    .inner
}

/// Returns the rectangle of a range on a slider: a band under its rail.
fn band(slider: Rect, range: [f64; 2], whole: [f64; 2]) -> Rect {
    let handle = slider.height() / 2.5;
    let (left, right) = (slider.left() + handle, slider.right() - handle);
    let x = |v: f64| left + (right - left) * ((v - whole[0]) / (whole[1] - whole[0])) as f32;
    let y = slider.center().y;
    Rect::from_min_max(pos2(x(range[0]), y + 5.0), pos2(x(range[1]), y + 8.0))
}

/// Returns the meaning of a proportion, and the range of the grade Excellent where it applies.
fn range(proportion: &Proportion, is_graded: bool) -> String {
    let Proportion { meaning, unit, .. } = *proportion;
    match proportion.excellent.filter(|_| is_graded) {
        Some([least, most]) => format!("{meaning} GIA calls {least} to {most}{unit} excellent."),
        None => meaning.to_owned(),
    }
}

fn hold(ui: &mut Ui, proportion: &Proportion, cut: &mut Cut, is_asked: bool) {
    if proportion.pair.is_none() {
        return;
    }
    let held = (proportion.is_given)(cut);
    let meaning = if held {
        "Held: this number stays when other proportions change."
    } else {
        "Hold this number when other proportions change. Space in its field does the same."
    };
    let side = ui.spacing().interact_size.y;
    let (rect, response) = ui.allocate_exact_size(vec2(side, side), row_focus::passed_over(ui));
    row_focus::part(&response);
    lock(ui, rect, held, &response);
    let response = explain(ui, response, meaning);
    let name = format!("Hold {}", proportion.name.to_lowercase());
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, held, &name));
    if (response.clicked() || is_asked) && !held {
        proportion.hold(cut);
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

/// Draws the proportions that only follow from others.
fn derived(ui: &mut Ui, rows: &[&Proportion], cut: &Cut, is_graded: bool) {
    ui.add_space(4.0);
    egui::Grid::new("derived").num_columns(2).spacing(vec2(12.0, 4.0)).show(ui, |ui| {
        for row in rows {
            let label = ui.label(RichText::new(row.name).weak());
            explain(ui, label, &range(row, is_graded));
            let value = (row.get)(cut);
            let text = match row.nothing.filter(|_| value <= 0.0) {
                Some(word) => word.to_owned(),
                None => format!("{:>6}{}", fixed(value, 2), row.unit),
            };
            let is_excellent =
                is_graded && row.excellent.is_some_and(|[least, most]| (least..=most).contains(&value));
            let text = RichText::new(text).monospace();
            ui.label(if is_excellent { text.color(theme::good(ui.visuals())) } else { text });
            ui.end_row();
        }
    });
}
