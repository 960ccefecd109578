//! The design panel: proportions, stone, light and copies.

use super::editor::Editor;
use super::files::Purpose;
use super::impossible::{self, RowMessage};
use super::rows::{ANY, Row, explain, field_width, named};
use super::studio::BEHIND;
use super::workspace::PanelSide;
use super::workspace::WAVELENGTHS;
use super::{company_rows, extent, mesh_rows, side_panels, stone_rows, theme, tier_rows};
use crate::cut::{Cut, Design, DesignError, MaterialRef, Proportion, Unit, Warning};
use crate::picture::Pattern;
use crate::scene::{Copies, LIGHTS, SpecimenError, light};
use egui::{
    ComboBox, Panel, Rect, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextEdit, Ui, WidgetInfo,
    pos2, vec2,
};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// The range of the exposure, in stops.
const STOPS: RangeInclusive<f64> = -4.0..=4.0;

/// The range of the half angle of the observer's head, degrees.
const HEADS: RangeInclusive<f64> = 0.0..=30.0;

/// Draws the design panel.
pub fn show(editor: &mut Editor, ui: &mut Ui, widths: RangeInclusive<f32>) {
    Panel::left("design").resizable(true).default_size(360.0).size_range(widths).show(ui, |ui| {
        side_panels::head(editor, ui, PanelSide::Design);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            identity(editor, ui);
            let work = &editor.document.work;
            if matches!(work.design.cut, Cut::Glass(_)) || work.company != Copies::default() {
                company_rows::presets(editor, ui);
            }
            let meaning = match is_graded(&editor.document.work.design) {
                true => "Drag a slider or type a number; the green mark is the range GIA calls excellent.",
                false => "Drag a slider or type a number.",
            };
            heading(ui, "Proportions", meaning);
            mesh_rows::show(editor, ui);
            proportions(editor, ui);
            heading(ui, "Stone", "What it is made of, and how large it is.");
            stone_rows::show(editor, ui);
            heading(ui, "Light", "What the render is lit by; scopes bring their own light.");
            lighting(editor, ui);
            heading(ui, "Copies", "Renders show several of it, and let them move.");
            company_rows::show(editor, ui);
        });
    });
}

/// Whether GIA's ranges for the grade Excellent apply: they are for diamond.
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
fn identity(editor: &mut Editor, ui: &mut Ui) {
    let design = &mut editor.document.work.design;
    ui.horizontal(|ui| {
        let label = named(ui, "Name", "What the design is called, in its file and on its pictures.");
        let mut name = design.name.clone();
        let field = TextEdit::singleline(&mut name).desired_width(field_width(ui));
        if ui.add(field).labelled_by(label.id).changed() {
            design.rename(name);
        }
    });
    if let Some(fault @ SpecimenError::Design(DesignError::Name)) = editor.document.fault() {
        wrong(ui, &fault.to_string());
    }
    let design = &editor.document.work.design;
    ui.horizontal(|ui| {
        named(ui, "Cut", "The family: which facets there are, and which numbers shape them.");
        ui.label(match design.cut {
            Cut::Tiers(_) => "Tiers on an index gear",
            Cut::Planes(_) => "Facets by their planes",
            Cut::Mesh(_) => "Triangles of a mesh",
            Cut::RoundBrilliant(_) | Cut::Glass(_) => design.cut.family().map_or("", |family| family.name),
        });
    });
}

fn proportions(editor: &mut Editor, ui: &mut Ui) {
    let said = impossible(editor);
    let is_graded = is_graded(&editor.document.work.design);
    let cut = &mut editor.document.work.design.cut;
    let (given, follow): (Vec<_>, Vec<_>) = cut.proportions().iter().partition(|row| row.give.is_some());
    for proportion in given {
        if row(ui, proportion, cut, is_graded) {
            editor.edited = Some(proportion.key);
        }
        if let Some(said) = said.as_ref().filter(|said| said.row == proportion) {
            wrong(ui, &said.text);
        }
    }
    if !follow.is_empty() && cut.check().is_ok() {
        derived(ui, &follow, cut, is_graded);
    }
    if matches!(cut, Cut::Tiers(_) | Cut::Planes(_)) {
        tiers(editor, ui);
    }
    warnings(editor, ui);
    let is_name = matches!(editor.document.fault(), Some(SpecimenError::Design(DesignError::Name)));
    if let Some(fault) = editor.document.fault().filter(|_| !is_name && said.is_none()) {
        wrong(ui, &impossible::by_name(fault));
    }
}

/// Explains what is wrong with the proportions, and at which row to say so.
fn impossible(editor: &Editor) -> Option<RowMessage> {
    let Some(SpecimenError::Design(DesignError::Proportion(fault))) = editor.document.fault() else {
        return None;
    };
    let (given, last) = (&editor.document.work.design.cut, &editor.document.specimen().design.cut);
    let is_same_family = given.family()?.key == last.family()?.key;
    is_same_family.then(|| impossible::explain(given, last, editor.edited, fault))
}

/// Draws the rows for the tiers of a cut.
///
/// Setting one tier leaves all others where they are, in mm: a stone that becomes wider gets a greater diameter.
fn tiers(editor: &mut Editor, ui: &mut Ui) {
    let specimen = Arc::clone(editor.document.specimen());
    let unit = editor.framing.extent(&specimen).unit;
    let design = &mut editor.document.work.design;
    let before = design.cut.clone();
    tier_rows::show(&mut design.cut, specimen.unit_mm() * unit, ui);
    if design.cut != before
        && let Some(now) = extent::unit(design)
    {
        design.diameter_mm *= unit / now;
    }
}

fn wrong(ui: &mut Ui, fault: &str) {
    ui.label(RichText::new(fault).color(theme::bad(ui.visuals())));
}

/// The greatest number of warnings that the panel shows.
const MOST_WARNINGS: usize = 12;

/// Draws the warnings about the stone and its file.
fn warnings(editor: &Editor, ui: &mut Ui) {
    let specimen = editor.document.specimen();
    let unusual = specimen.unusual.iter().map(Warning::by_name);
    let stones = unusual.chain(specimen.warnings.iter().cloned());
    let stones = stones.filter(|_| editor.document.fault().is_none());
    let all: Vec<String> = stones.chain(editor.document.work.remarks.iter().cloned()).collect();
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
fn row(ui: &mut Ui, proportion: &Proportion, cut: &mut Cut, is_graded: bool) -> bool {
    let Proportion { name, unit, usual: [first, last], step, speed, .. } = *proportion;
    ui.horizontal(|ui| {
        let mut value = (proportion.get)(cut);
        let before = value;
        let mark = ui.painter().add(egui::Shape::Noop);
        let decimals = if unit == Unit::Count { 0 } else { 2 };
        let (meaning, unit) = (range(proportion, is_graded), unit.to_string());
        let row = Row::new(name, &meaning, first..=last);
        let row = Row { limits: ANY, step, decimals, speed, unit: &unit, ..row };
        let slider = row.fill(ui, &mut value);
        if let Some(good) = proportion.excellent.filter(|_| is_graded) {
            let band = band(slider, good, proportion.usual);
            let colour = theme::good(ui.visuals()).gamma_multiply(0.75);
            ui.painter().set(mark, egui::Shape::rect_filled(band, 2.0, colour));
        }
        let is_changed = value != before && value.is_finite();
        if is_changed {
            proportion.set(cut, value);
        }
        hold(ui, proportion, cut);
        is_changed
    })
    .inner
}

/// Returns where a range lies on a slider: a band under its rail.
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

fn hold(ui: &mut Ui, proportion: &Proportion, cut: &mut Cut) {
    if proportion.pair.is_none() {
        return;
    }
    let held = (proportion.is_given)(cut);
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
                None => format!("{value:6.2}{}", row.unit),
            };
            let is_excellent =
                is_graded && row.excellent.is_some_and(|[least, most]| (least..=most).contains(&value));
            let text = RichText::new(text).monospace();
            ui.label(if is_excellent { text.color(theme::good(ui.visuals())) } else { text });
            ui.end_row();
        }
    });
}

fn lighting(editor: &mut Editor, ui: &mut Ui) {
    let mut asks = false;
    let work = &mut editor.document.work;
    ui.horizontal(|ui| {
        let label = named(ui, "Light", "What stands around the stone in renders.");
        let name = std::path::Path::new(&work.light)
            .file_name()
            .map_or(work.light.clone(), |n| n.to_string_lossy().into_owned());
        let combo = ComboBox::from_id_salt("light").selected_text(name).width(field_width(ui));
        let combo = combo.height(420.0).show_ui(ui, |ui| {
            for name in LIGHTS {
                let about = light(name).map_or(String::new(), |l| l.description);
                let chosen = work.light == name;
                if ui.selectable_label(chosen, name).on_hover_text(about).clicked() {
                    work.light = name.to_owned();
                }
            }
            asks = ui
                .button("From a file…")
                .on_hover_text("A light file, or a panorama: .hdr, .exr, .png or .jpg.")
                .clicked();
        });
        combo.response.labelled_by(label.id);
    });
    let meaning = "How bright renders are shown, in stops: one more is twice the light.";
    let exposure = Row { step: 0.1, decimals: 1, unit: " stops", ..Row::new("Exposure", meaning, STOPS) };
    exposure.show(ui, &mut work.exposure);
    ui.horizontal(|ui| {
        let meaning = "Into how many bands of wavelengths renders take light apart; few show as bands in the colours. Hold Z \
            to see what three show.";
        let label = named(ui, "Wavelengths", meaning);
        let wavelengths = &mut editor.desk.wavelengths;
        let combo = ComboBox::from_id_salt("wavelengths").selected_text(wavelengths.to_string());
        let combo = combo.width(field_width(ui));
        let combo = combo.show_ui(ui, |ui| {
            WAVELENGTHS.into_iter().for_each(|n| drop(ui.selectable_value(wavelengths, n, n.to_string())));
        });
        combo.response.labelled_by(label.id);
    });
    let asks_picture = behind(editor, ui);
    let meaning = "Half angle of the observer's head, which shuts out light in ASET and figures; 0 for none.";
    let head = Row { step: 0.1, decimals: 1, unit: "°", ..Row::new("Head", meaning, HEADS) };
    head.show(ui, &mut editor.document.work.head);
    if asks {
        editor.choose(Purpose::Light);
    }
    if asks_picture {
        editor.choose(Purpose::Behind);
    }
}

/// Draws the rows for the backplate behind the stone in renders; returns whether the user wants to choose a file.
fn behind(editor: &mut Editor, ui: &mut Ui) -> bool {
    let mut asks = false;
    let desk = &mut editor.desk;
    ui.horizontal(|ui| {
        let label =
            named(ui, "Behind", "A picture behind the stone in renders, refracted where each ray meets it.");
        let name = desk.behind.as_deref().map_or("nothing", |name| {
            std::path::Path::new(name).file_name().and_then(|n| n.to_str()).unwrap_or(name)
        });
        let combo = ComboBox::from_id_salt("behind").selected_text(name.to_owned()).width(field_width(ui));
        let combo = combo.height(420.0).show_ui(ui, |ui| {
            ui.selectable_value(&mut desk.behind, None, "nothing");
            ui.selectable_value(&mut desk.behind, Some("light".to_owned()), "light")
                .on_hover_text("What shines, a panorama for one.");
            for (name, _) in Pattern::NAMES {
                ui.selectable_value(&mut desk.behind, Some(name.to_owned()), name);
            }
            asks = ui.button("From a file…").on_hover_text("A picture: .png, .jpg, .hdr or .exr.").clicked();
        });
        combo.response.labelled_by(label.id);
    });
    if desk.behind.is_some() {
        let meaning = "How much of the way that refraction turns light is followed: 1 is physics, less a mixture with the \
            straight ray, for its looks.";
        if desk.behind.as_deref() != Some("light") {
            let unit_mm = editor.document.specimen().unit_mm();
            let mut mm = desk.behind_mm.unwrap_or(BEHIND * unit_mm);
            let before = mm;
            let about = "How far behind the middle it hangs; never nearer than the stones reach.";
            let row = Row::new("Distance", about, 0.0..=20.0 * unit_mm);
            Row { limits: 0.0..=f64::INFINITY, step: 0.1, decimals: 1, unit: " mm", ..row }.show(ui, &mut mm);
            if mm != before {
                desk.behind_mm = Some(mm);
            }
        }
        let row = Row::new("Strength", meaning, STRENGTHS);
        Row { step: 0.005, decimals: 3, ..row }.show(ui, &mut desk.strength);
    }
    asks
}

/// The range of the strength of refraction: 0 is the straight ray, 1 is physics.
const STRENGTHS: RangeInclusive<f64> = 0.0..=1.0;
