//! The panel of the design: proportions, material, size, light.

use super::desk::WAVELENGTHS;
use super::editor::Editor;
use super::files::Purpose;
use super::proportions::{EXCELLENT_DEPTH, PROPORTIONS, Proportion};
use super::rows::{ANY, NUMBER, Number, Row, named};
use super::studio::BEHIND;
use super::{company_rows, glass_rows, theme, tier_rows};
use crate::cut::{Cut, DesignError, MaterialRef, RoundBrilliant, Size, Unit};
use crate::optics::{line, materials};
use crate::picture::Pattern;
use crate::scene::{Company, LIGHTS, SpecimenError, light};
use egui::{
    Color32, ComboBox, Panel, Rect, RichText, Role, ScrollArea, Sense, Slider, SliderClamping, Stroke,
    StrokeKind, TextEdit, Ui, WidgetInfo, pos2, vec2,
};
use std::ops::RangeInclusive;

/// Stops that light can be raised or lowered by.
const STOPS: RangeInclusive<f64> = -4.0..=4.0;

/// Half angles of the observer's head, degrees.
const HEADS: RangeInclusive<f64> = 0.0..=30.0;

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    Panel::left("design").resizable(true).default_size(350.0).size_range(300.0..=460.0).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.add_space(8.0);
            identity(editor, ui);
            let work = &editor.document.work;
            if matches!(work.design.cut, Cut::Glass(_)) || work.company != Company::default() {
                company_rows::presets(editor, ui);
            }
            heading(
                ui,
                "Proportions",
                "Drag a slider or type a number; the green mark is the range GIA calls excellent.",
            );
            proportions(editor, ui);
            heading(ui, "Stone", "What it is made of, and how large it is.");
            material(editor, ui);
            size(editor, ui);
            heading(ui, "Light", "What the render is lit by; scopes bring their own light.");
            lighting(editor, ui);
            heading(ui, "Copies", "Renders show several of it, and let them move.");
            company_rows::show(editor, ui);
        });
    });
}

fn heading(ui: &mut Ui, text: &str, meaning: &str) {
    ui.add_space(8.0);
    ui.label(RichText::new(text).heading()).on_hover_text(meaning);
    ui.add_space(2.0);
}

/// What it is called, and what it is cut as.
fn identity(editor: &mut Editor, ui: &mut Ui) {
    let design = &mut editor.document.work.design;
    ui.horizontal(|ui| {
        let label = named(ui, "Name", "What the design is called, in its file and on its pictures.");
        let mut name = design.name.clone();
        let field = TextEdit::singleline(&mut name).desired_width(ui.available_width() - 12.0);
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
            Cut::RoundBrilliant(_) => "Round brilliant",
            Cut::Tiers(_) => "Tiers on an index gear",
            Cut::Planes(_) => "Facets by their planes",
            Cut::Mesh(_) => "Mesh, not convex",
            Cut::Glass(glass) => glass.called().1,
        });
    });
}

fn proportions(editor: &mut Editor, ui: &mut Ui) {
    let fault = editor.document.fault().map(ToString::to_string);
    let key = match editor.document.fault() {
        Some(SpecimenError::Design(DesignError::Proportion(fault))) => Some(fault.key()),
        _ => None,
    };
    let Cut::RoundBrilliant(brilliant) = &mut editor.document.work.design.cut else {
        match &mut editor.document.work.design.cut {
            Cut::Glass(glass) => glass_rows::show(glass, ui),
            Cut::Mesh(_) => {}
            cut => tier_rows::show(cut, ui),
        }
        warnings(editor, ui);
        if let Some(fault) = fault {
            wrong(ui, &fault);
        }
        return;
    };
    for proportion in &PROPORTIONS {
        row(ui, proportion, brilliant);
        if let Some(fault) = fault.as_ref().filter(|_| key == Some(proportion.key)) {
            wrong(ui, fault);
        }
    }
    derived(ui, brilliant);
    warnings(editor, ui);
    let is_name = matches!(editor.document.fault(), Some(SpecimenError::Design(DesignError::Name)));
    if let Some(fault) =
        fault.filter(|_| !is_name).filter(|_| !PROPORTIONS.iter().any(|p| key == Some(p.key)))
    {
        wrong(ui, &fault);
    }
}

fn wrong(ui: &mut Ui, fault: &str) {
    ui.label(RichText::new(fault).color(theme::bad(ui.visuals())));
}

/// Lines of what is odd that a panel has room for.
const MOST_WARNINGS: usize = 12;

/// What is odd about the stone, and what was about its file.
fn warnings(editor: &Editor, ui: &mut Ui) {
    let stones = editor.document.specimen().warnings.iter().filter(|_| editor.document.fault().is_none());
    let all: Vec<&String> = stones.chain(editor.document.odd()).collect();
    let small = |text: &str| egui::Label::new(RichText::new(text).weak().small()).wrap();
    for warning in all.iter().take(MOST_WARNINGS) {
        ui.add(small(warning));
    }
    if all.len() > MOST_WARNINGS {
        ui.add(small(&format!("and {} more", all.len() - MOST_WARNINGS)));
    }
}

/// One proportion: name, slider, number, and of a pair whether it is held.
fn row(ui: &mut Ui, proportion: &Proportion, brilliant: &mut RoundBrilliant) {
    ui.horizontal(|ui| {
        let label = named(ui, proportion.name, proportion.meaning);
        let held = ui.spacing().interact_size.y;
        ui.spacing_mut().slider_width = (ui.available_width() - NUMBER - held - 24.0).max(40.0);
        let (first, last) = (*proportion.slider.start(), *proportion.slider.end());
        let mut value = (proportion.get)(brilliant);
        let before = value;
        let whole = proportion.unit == Unit::Count;
        let decimals = if whole { 0 } else { 2 };
        let step = if whole { 8.0 } else { 0.1 };
        let mark = ui.painter().add(egui::Shape::Noop);
        let slider = Slider::new(&mut value, first..=last).show_value(false).step_by(step).smart_aim(false);
        let slider = ui
            .add(slider.clamping(SliderClamping::Never))
            .labelled_by(label.id)
            .on_hover_text(range(proportion));
        if let Some(good) = &proportion.excellent {
            let band = band(slider.rect, good, &proportion.slider);
            ui.painter().set(
                mark,
                egui::Shape::rect_filled(band, 2.0, theme::good(ui.visuals()).gamma_multiply(0.75)),
            );
        }
        let (speed, unit) = (if whole { 0.2 } else { 0.02 }, proportion.unit.to_string());
        Number { decimals, speed, range: ANY, unit: &unit }.show(ui, (NUMBER, label.id), &mut value);
        if value != before && value.is_finite() {
            (proportion.set)(brilliant, value);
        }
        hold(ui, proportion, brilliant);
    });
}

/// Where on a slider a range lies: a band under its rail.
fn band(slider: Rect, range: &RangeInclusive<f64>, whole: &RangeInclusive<f64>) -> Rect {
    let handle = slider.height() / 2.5;
    let (left, right) = (slider.left() + handle, slider.right() - handle);
    let x = |v: f64| left + (right - left) * ((v - whole.start()) / (whole.end() - whole.start())) as f32;
    let y = slider.center().y;
    Rect::from_min_max(pos2(x(*range.start()), y + 5.0), pos2(x(*range.end()), y + 8.0))
}

fn range(proportion: &Proportion) -> String {
    let good = proportion
        .excellent
        .as_ref()
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
    let response = response.on_hover_text(meaning);
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

/// What follows from the proportions.
fn derived(ui: &mut Ui, brilliant: &RoundBrilliant) {
    let Ok(derived) = brilliant.derived() else { return };
    let depth = derived.total_depth;
    let colour =
        if EXCELLENT_DEPTH.contains(&depth) { theme::good(ui.visuals()) } else { ui.visuals().text_color() };
    ui.add_space(4.0);
    egui::Grid::new("derived").num_columns(2).spacing(vec2(12.0, 4.0)).show(ui, |ui| {
        let mut line = |name: &str, value: String, colour: Option<Color32>, meaning: &str| {
            ui.label(RichText::new(name).weak()).on_hover_text(meaning);
            let text = RichText::new(value).monospace();
            ui.label(match colour {
                Some(colour) => text.color(colour),
                None => text,
            });
            ui.end_row();
        };
        line(
            "Total depth",
            format!("{depth:6.2} %"),
            Some(colour),
            "From table to culet. GIA calls 58.1 to 63.6 % excellent.",
        );
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

fn material(editor: &mut Editor, ui: &mut Ui) {
    let known = editor.document.specimen().material.clone();
    let design = &mut editor.document.work.design;
    ui.horizontal(|ui| {
        let label =
            named(ui, "Material", "What the stone is made of: it sets refraction, dispersion and colour.");
        let name = match &design.material {
            MaterialRef::Name(name) => name.clone(),
            MaterialRef::Index(index) => format!("index {index}"),
            MaterialRef::Custom(material) => material.name.clone(),
        };
        let combo =
            ComboBox::from_id_salt("material").selected_text(&name).width(ui.available_width() - 12.0);
        let combo = combo.height(420.0).show_ui(ui, |ui| {
            let mut all: Vec<_> = materials().iter().collect();
            all.sort_by_key(|m| m.name.as_str());
            for material in all {
                let chosen = name == material.name;
                let about = format!("{}\nindex {:.4}", material.description, material.index(line::SODIUM_D));
                if ui.selectable_label(chosen, &material.name).on_hover_text(about).clicked() && !chosen {
                    design.material = MaterialRef::Name(material.name.clone());
                }
            }
        });
        combo.response.labelled_by(label.id);
    });
    if matches!(design.cut, Cut::Glass(_)) {
        company_rows::two_numbers(&mut design.material, &known, ui);
    }
}

fn size(editor: &mut Editor, ui: &mut Ui) {
    let specimen = std::sync::Arc::clone(editor.document.specimen());
    let design = &mut editor.document.work.design;
    ui.horizontal(|ui| {
        let label = named(ui, "Diameter", "Of the girdle. A larger stone of colour is darker.");
        let number = Number { decimals: 3, speed: 0.01, range: 0.1..=1000.0, unit: " mm" };
        number.show(ui, (92.0, label.id), &mut design.diameter_mm);
    });
    ui.horizontal(|ui| {
        let label = named(ui, "Weight", "From the stone's volume and its material's density.");
        let volume = specimen.solid().volume() * (0.5 * design.diameter_mm).powi(3);
        let Some(mut carats) = specimen.material.carats(volume) else {
            ui.label(RichText::new("this material's density is not known").weak());
            return;
        };
        let before = carats;
        let number = Number { decimals: 3, speed: 0.01, range: 1e-6..=1e9, unit: " ct" };
        number.show(ui, (92.0, label.id), &mut carats);
        let asked = Size::Carats(carats).diameter_mm(specimen.solid().volume(), &specimen.material);
        if let (true, Ok(diameter)) = (carats != before, asked) {
            design.diameter_mm = diameter;
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
        let combo = ComboBox::from_id_salt("light").selected_text(name).width(ui.available_width() - 12.0);
        let combo = combo.show_ui(ui, |ui| {
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
        let combo = ComboBox::from_id_salt("wavelengths").selected_text(wavelengths.to_string()).width(64.0);
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

/// What hangs behind the stone in renders; whether a file is asked for.
fn behind(editor: &mut Editor, ui: &mut Ui) -> bool {
    let mut asks = false;
    let desk = &mut editor.desk;
    ui.horizontal(|ui| {
        let label =
            named(ui, "Behind", "A picture behind the stone in renders, refracted where each ray meets it.");
        let name = desk.behind.as_deref().map_or("nothing", |name| {
            std::path::Path::new(name).file_name().and_then(|n| n.to_str()).unwrap_or(name)
        });
        let combo = ComboBox::from_id_salt("behind")
            .selected_text(name.to_owned())
            .width(ui.available_width() - 12.0);
        let combo = combo.show_ui(ui, |ui| {
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

/// From the straight ray to physics.
const STRENGTHS: RangeInclusive<f64> = 0.0..=1.0;
