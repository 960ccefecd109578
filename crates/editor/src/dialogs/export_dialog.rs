//! The export dialog, which writes files.

use super::answers::body;
use super::export_sheet::sheet_row;
use crate::theme;
use brillianteer_base::Failure;
use brillianteer_paper::export::OutputFormat;
use brillianteer_paper::refraction::{MOST_MAP_BANDS, MOST_PLACES};
use brillianteer_session::model::{
    action::{Actions, DialogAction, FileAction},
    choosing::Purpose,
    export::Selection,
    exporting::{ExportForm, ExportRun},
};
use brillianteer_session::shows::Shows;
use egui::{
    Color32, DragValue, Grid, Label, ProgressBar, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind,
    TextEdit, TextureHandle, Ui, WidgetInfo, pos2, vec2,
};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The side of a thumbnail, points.
const THUMBNAIL: f32 = 88.0;

/// The range of sizes that are offered, pixels.
const SIZES: std::ops::RangeInclusive<u32> = 16..=8192;

/// The width of the dialog, points.
const WIDTH: f32 = 560.0;

/// Draws the dialog.
pub fn show(
    export: &ExportForm,
    thumbnails: &HashMap<Shows, TextureHandle>,
    actions: &mut Actions,
    ui: &mut Ui,
) {
    if let Some(run) = &export.run {
        let folder = std::path::absolute(&export.plan.folder).unwrap_or_else(|_| export.plan.folder.clone());
        return working(run, &folder, actions, ui);
    }
    let files = export.plan.files();
    body(ui, WIDTH, |ui| {
        ui.heading("Export");
        let mut selection = export.plan.selection.clone();
        views(ui, export, &mut selection, thumbnails);
        if !export.plan.own.is_empty() {
            let names: Vec<&str> = export.plan.own.iter().map(|(shows, _)| shows.name()).collect();
            let text = format!("Exported as their own views show them: {}.", names.join(", "));
            ui.label(RichText::new(text).weak().small());
        }
        ui.add_space(6.0);
        settings(ui, export, &mut selection, actions);
        actions.push_changed(&export.plan.selection, selection, DialogAction::Select);
        listed(ui, &files);
    });
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        let can = files.as_ref().is_ok_and(|f| !f.is_empty());
        actions.push_if(ui.add_enabled(can, egui::Button::new("Write files")).clicked(), DialogAction::Write);
        actions.push_if(ui.button("Cancel").clicked(), DialogAction::Leave);
    });
}

/// Draws the thumbnails of all views that can be exported.
fn views(
    ui: &mut Ui,
    export: &ExportForm,
    selection: &mut Selection,
    thumbnails: &HashMap<Shows, TextureHandle>,
) {
    ui.horizontal_wrapped(|ui| {
        for shows in export.plan.can_be_shown() {
            let is_wanted = selection.views.contains(&shows);
            if thumbnail(ui, shows, is_wanted, thumbnails.get(&shows)) {
                selection.views.retain(|s| *s != shows);
                selection.views.extend((!is_wanted).then_some(shows));
            }
        }
    });
}

/// Draws a thumbnail that can be selected; returns whether it was clicked.
fn thumbnail(ui: &mut Ui, shows: Shows, wanted: bool, picture: Option<&TextureHandle>) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(THUMBNAIL + 12.0, THUMBNAIL + 30.0), Sense::click());
    response.widget_info(|| WidgetInfo::selected(egui::Role::CheckBox, true, wanted, shows.name()));
    let square = Rect::from_min_size(rect.min + vec2(6.0, 6.0), vec2(THUMBNAIL, THUMBNAIL));
    ui.painter().rect_filled(
        rect,
        5.0,
        if wanted { ui.visuals().selection.bg_fill } else { ui.visuals().faint_bg_color },
    );
    ui.painter().rect_filled(square, 3.0, ui.visuals().extreme_bg_color);
    if let Some(texture) = picture {
        let [w, h] = texture.size().map(|n| n as f32);
        if w != h {
            // Drawings are on white paper.
            ui.painter().rect_filled(square, 3.0, Color32::WHITE);
        }
        let size = vec2(w, h) * (THUMBNAIL / w.max(h));
        let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture.id(), Rect::from_center_size(square.center(), size), uv, Color32::WHITE);
    }
    let font = egui::TextStyle::Small.resolve(ui.style());
    let at = pos2(rect.center().x, rect.bottom() - 11.0);
    ui.painter().text(at, egui::Align2::CENTER_CENTER, shows.name(), font, ui.visuals().text_color());
    let edge = if wanted || response.has_focus() {
        Stroke::new(1.5, theme::accent(ui.visuals()))
    } else {
        Stroke::NONE
    };
    ui.painter().rect_stroke(rect, 5.0, edge, StrokeKind::Inside);
    response.on_hover_text(shows.meaning()).clicked()
}

fn settings(ui: &mut Ui, export: &ExportForm, selection: &mut Selection, actions: &mut Actions) {
    Grid::new("export").num_columns(2).spacing(vec2(16.0, 6.0)).show(ui, |ui| {
        ui.label("Formats");
        ui.horizontal(|ui| {
            for (format, name, meaning) in [
                (OutputFormat::Png, "PNG", "Pictures. Each scope gives two: its energy and its strongest exits."),
                (OutputFormat::Svg, "SVG", "Drawings, and scopes with each virtual facet as a polygon."),
                (OutputFormat::Exr, "EXR", "The energy of every zone as linear 32-bit numbers."),
                (OutputFormat::Json, "JSON", "The figures that the panel shows, of the table side."),
            ] {
                let mut wanted = selection.formats.contains(&format);
                if ui.checkbox(&mut wanted, name).on_hover_text(meaning).changed() {
                    selection.formats.retain(|f| *f != format);
                    if wanted {
                        selection.formats.push(format);
                    }
                }
            }
        });
        ui.end_row();
        ui.label("Scopes");
        let meaning = "Writes under each picture of a scope what each colour means, how the stone is tilted, how \
            much light is unresolved, and the names of the stone and the program.";
        ui.checkbox(&mut selection.caption, "Caption and legend").on_hover_text(meaning);
        ui.end_row();
        ui.label("Diagram");
        let meaning = "Marks in the facet diagram what the audit lists: places that may not be what the designer meant.";
        ui.checkbox(&mut selection.mark_audit, "Findings of the audit").on_hover_text(meaning);
        ui.end_row();
        ui.label("Also");
        also_row(selection, ui);
        ui.end_row();
        ui.label("Sheet");
        sheet_row(&mut selection.sheet, export.plan.can_have_sheet(), ui);
        ui.end_row();
        let label = ui.label("Size");
        ui.add(DragValue::new(&mut selection.size).range(SIZES).speed(8.0).suffix(" pixels"))
            .labelled_by(label.id);
        ui.end_row();
        let label = ui.label("Folder");
        ui.horizontal(|ui| {
            let mut text = export.plan.folder.display().to_string();
            let edit = TextEdit::singleline(&mut text).desired_width(360.0);
            if ui.add(edit).labelled_by(label.id).changed() {
                actions.push(DialogAction::Folder(PathBuf::from(text)));
            }
            actions.push_if(ui.button("Choose…").clicked(), FileAction::Choose(Purpose::Folder));
        });
        ui.end_row();
    });
}

/// Draws the choices of what an export writes besides pictures and drawings: a refraction map and a scene file.
fn also_row(selection: &mut Selection, ui: &mut Ui) {
    let meaning = "Writes a picture that says where on the background the light of each pixel comes from, a \
        picture of all other light, and a web page that refracts a moving background by both.";
    ui.horizontal(|ui| {
        ui.checkbox(&mut selection.map, "Refraction map and page").on_hover_text(meaning);
        let meaning = "Number of bands of wavelengths. With one band the map is grey and small; with several it \
            keeps the rainbow.";
        let bands = DragValue::new(&mut selection.bands).range(1..=MOST_MAP_BANDS).prefix("bands ");
        ui.add_enabled(selection.map, bands).on_hover_text(meaning);
        let meaning = "Number of places on the background that each pixel can show. With several, a pixel shows \
            everything that is seen through it at once. One map is written for each band and place.";
        let places = DragValue::new(&mut selection.places).range(1..=MOST_PLACES).prefix("places ");
        ui.add_enabled(selection.map, places).on_hover_text(meaning);
        let meaning = "Writes a scene file and a cut file of each design, with all stones and metal in their present places, \
            their light and their background. The editor opens the scene again.";
        ui.checkbox(&mut selection.scene, "Scene file and its cuts").on_hover_text(meaning);
    });
}

/// The height of the list of files, points: the same for any number of files, so that nothing moves under the pointer.
const LISTED: f32 = 96.0;
/// The least height of the list of files, points, where the window has no room for the whole dialog.
const LEAST_LISTED: f32 = 32.0;

/// The height of a window that has room for the whole dialog, points.
const ROOMY: f32 = 700.0;

/// Draws the list of the files that will be written, and marks those that exist already.
fn listed(ui: &mut Ui, files: &Result<Vec<PathBuf>, Failure>) {
    match files {
        Err(why) => drop(ui.label(RichText::new(why.to_string()).color(theme::bad(ui.visuals())))),
        Ok(files) if files.is_empty() => {
            drop(ui.label("None of the chosen formats can hold any of the chosen views."))
        }
        Ok(files) => {
            let there = files.iter().filter(|f| f.exists()).count();
            let already = if there > 0 { format!("; {there} will be replaced") } else { String::new() };
            ui.label(
                RichText::new(format!(
                    "{} file{}{already}",
                    files.len(),
                    if files.len() == 1 { "" } else { "s" }
                ))
                .weak(),
            );
            let missing = (ROOMY - ui.ctx().content_rect().height()).max(0.0);
            let height = (LISTED - missing).max(LEAST_LISTED);
            ScrollArea::vertical()
                .max_height(height)
                .min_scrolled_height(height)
                .auto_shrink(false)
                .id_salt("files")
                .show(ui, |ui| {
                    for file in files {
                        let name =
                            file.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
                        let text = RichText::new(name).small();
                        ui.label(if file.exists() {
                            text.color(theme::caution(ui.visuals()))
                        } else {
                            text.weak()
                        });
                    }
                });
        }
    }
}

/// The height of the messages, points: the same for any number of them, so that the button below stays in its place.
const TOLD: f32 = 220.0;

/// Draws the progress of the export, its messages, and the button that ends it, or those for its end.
fn working(run: &ExportRun, folder: &Path, actions: &mut Actions, ui: &mut Ui) {
    body(ui, WIDTH, |ui| progress(run, ui));
    ui.add_space(8.0);
    if run.end.is_none() {
        let stop = ui.add_enabled(!run.is_stopped, egui::Button::new("Stop"));
        let meaning = "Ends the export. Complete files stay, and the file being written is left out. Escape does the same.";
        actions.push_if(stop.on_hover_text(meaning).clicked(), DialogAction::Stop);
        return;
    }
    // The buttons stand in one line, so that the dialog grows no higher and no button moves under the pointer.
    ui.horizontal(|ui| {
        actions.push_if(ui.button("Close").clicked(), DialogAction::Leave);
        if ui.button("Open folder").on_hover_text("Opens the folder of the written files.").clicked() {
            actions.push(FileAction::OpenOutside(folder.display().to_string()));
        }
    });
}

/// Draws the progress of the export and its messages.
fn progress(run: &ExportRun, ui: &mut Ui) {
    ui.heading("Export");
    ui.add(ProgressBar::new(run.done()));
    ui.add(Label::new(run.standing()).truncate());
    let lines = ScrollArea::vertical().max_height(TOLD).min_scrolled_height(TOLD).auto_shrink(false);
    lines.stick_to_bottom(true).show(ui, |ui| {
        run.messages.iter().for_each(|line| drop(ui.label(RichText::new(line).small())));
        if let (Some(Err(why)), false) = (&run.end, run.is_stopped) {
            ui.label(RichText::new(why.to_string()).color(theme::bad(ui.visuals())));
        }
    });
    // A line that is always there keeps the button in its place.
    ui.label(
        RichText::new(if run.end == Some(Ok(())) { "All files have been written." } else { "" }).strong(),
    );
}
