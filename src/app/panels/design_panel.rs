//! The design panel: proportions, stone, light and copies.

use crate::app::editor::Editor;
use crate::app::model::action::FileAction;
use crate::app::model::choosing::Purpose;
use crate::app::model::extent;
use crate::app::model::workspace::PanelSide;
use crate::app::model::workspace::WAVELENGTHS;
use crate::app::panels::company_rows;
use crate::app::panels::glass_rows;
use crate::app::panels::impossible::{self, RowMessage};
use crate::app::panels::mesh_rows;
use crate::app::panels::proportions::{EXCELLENT_DEPTH, PROPORTIONS, Proportion};
use crate::app::panels::rows::{ANY, NUMBER, Number, Row, control_width, explain, field_width, named};
use crate::app::panels::side_panels;
use crate::app::panels::stone_rows;
use crate::app::panels::tier_rows;
use crate::app::studio::BEHIND;
use crate::app::theme;
use crate::cut::{Cut, Design, DesignError, MaterialRef, RoundBrilliant, Unit};
use crate::picture::Pattern;
use crate::scene::{Copies, LIGHTS, SpecimenError, light};
use egui::{
    Color32, ComboBox, Panel, Rect, RichText, Role, ScrollArea, Sense, Slider, SliderClamping, Stroke,
    StrokeKind, TextEdit, Ui, WidgetInfo, pos2, vec2,
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
            let work = &editor.model.document.work;
            if matches!(work.design.cut, Cut::Glass(_)) || work.company != Copies::default() {
                company_rows::presets(editor, ui);
            }
            let meaning = match is_graded(&editor.model.document.work.design) {
                true => "Drag a slider or type a number; the green mark is the range GIA calls excellent.",
                false => "Drag a slider or type a number.",
            };
            heading(ui, "Proportions", meaning);
            mesh_rows::show(editor, ui);
            proportions(editor, ui);
            heading(ui, "Stone", "What it is made of, and how large it is.");
            stone_rows::show(&editor.model, &mut editor.actions, ui);
            heading(ui, "Light", "What the render is lit by; scopes bring their own light.");
            lighting(editor, ui);
            heading(ui, "Copies", "Renders show several of it, and let them move.");
            company_rows::show(editor, ui);
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
fn identity(editor: &mut Editor, ui: &mut Ui) {
    let design = &mut editor.model.document.work.design;
    ui.horizontal(|ui| {
        let label = named(ui, "Name", "What the design is called, in its file and on its pictures.");
        let mut name = design.name.clone();
        let field = TextEdit::singleline(&mut name).desired_width(field_width(ui));
        if ui.add(field).labelled_by(label.id).changed() {
            design.rename(name);
        }
    });
    if let Some(fault @ SpecimenError::Design(DesignError::Name)) = editor.model.document.fault() {
        wrong(ui, &fault.to_string());
    }
    let design = &editor.model.document.work.design;
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

fn proportions(editor: &mut Editor, ui: &mut Ui) {
    let fault = editor.model.document.fault().map(ToString::to_string);
    let said = impossible(editor);
    let mut edited = editor.model.session.edited;
    let is_graded = is_graded(&editor.model.document.work.design);
    let Cut::RoundBrilliant(brilliant) = &mut editor.model.document.work.design.cut else {
        match &mut editor.model.document.work.design.cut {
            Cut::Glass(glass) => glass_rows::show(glass, ui),
            Cut::Mesh(_) => {}
            _ => tiers(editor, ui),
        }
        warnings(editor, ui);
        if let Some(fault) = fault {
            wrong(ui, &fault);
        }
        return;
    };
    for proportion in &PROPORTIONS {
        if row(ui, proportion, brilliant, is_graded) {
            edited = Some(proportion.key);
        }
        if let Some(said) = said.as_ref().filter(|said| said.key == proportion.key) {
            wrong(ui, &said.text);
        }
    }
    derived(ui, brilliant, is_graded);
    editor.model.session.edited = edited;
    warnings(editor, ui);
    let is_name = matches!(editor.model.document.fault(), Some(SpecimenError::Design(DesignError::Name)));
    if let Some(fault) = fault.filter(|_| !is_name && said.is_none()) {
        wrong(ui, &fault);
    }
}

/// Explains what is wrong with the proportions of a round brilliant, and at which row to say so.
fn impossible(editor: &Editor) -> Option<RowMessage> {
    let Some(SpecimenError::Design(DesignError::Proportion(fault))) = editor.model.document.fault() else {
        return None;
    };
    let given = editor.model.document.work.design.cut.brilliant()?;
    let last = editor.model.document.specimen().design.cut.brilliant()?;
    Some(impossible::explain(given, last, editor.model.session.edited, fault))
}

/// Draws the rows for the tiers of a cut.
///
/// Setting one tier leaves all others where they are, in mm: a stone that becomes wider gets a greater diameter.
fn tiers(editor: &mut Editor, ui: &mut Ui) {
    let specimen = Arc::clone(editor.model.document.specimen());
    let unit = editor.model.document.extent().unit;
    let design = &mut editor.model.document.work.design;
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
    let stones =
        editor.model.document.specimen().warnings.iter().filter(|_| editor.model.document.fault().is_none());
    let all: Vec<&String> = stones.chain(editor.model.document.work.remarks.iter()).collect();
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

fn lighting(editor: &mut Editor, ui: &mut Ui) {
    let mut asks = false;
    let work = &mut editor.model.document.work;
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
        let wavelengths = &mut editor.model.workspace.wavelengths;
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
    head.show(ui, &mut editor.model.document.work.head);
    if asks {
        editor.actions.push(FileAction::Choose(Purpose::Light));
    }
    if asks_picture {
        editor.actions.push(FileAction::Choose(Purpose::Behind));
    }
}

/// Draws the rows for the backplate behind the stone in renders; returns whether the user wants to choose a file.
fn behind(editor: &mut Editor, ui: &mut Ui) -> bool {
    let mut asks = false;
    let desk = &mut editor.model.workspace;
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
            let unit_mm = editor.model.document.specimen().unit_mm();
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
