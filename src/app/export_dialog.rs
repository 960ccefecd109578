//! The export dialog, which writes files.

use super::editor::Editor;
use super::export_job::{ExportPlan, Job, PictureAspect, Selection, thumbnails};
use super::files::Purpose;
use super::pose_cache::PoseCache;
use super::shows::Shows;
use super::studio::Shot;
use super::theme;
use crate::io::export::OutputFormat;
use crate::io::refraction::{MOST_BANDS, MOST_PLACES};
use crate::scene::{Copies, Specimen, View};
use egui::{
    Color32, ColorImage, DragValue, Grid, Label, ProgressBar, Rect, RichText, ScrollArea, Sense, Stroke,
    StrokeKind, TextEdit, TextureHandle, Ui, WidgetInfo, pos2, vec2,
};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// The side of a thumbnail, points.
const THUMBNAIL: f32 = 88.0;

/// The range of sizes that are offered, pixels: renders and EXRs are held in memory.
const SIZES: std::ops::RangeInclusive<u32> = 16..=8192;

/// The state of the export dialog.
pub struct ExportDialog {
    pub(super) folder: PathBuf,
    pub(super) plan: ExportPlan,
    thumbnails: Receiver<(Shows, ColorImage)>,
    pictures: HashMap<Shows, TextureHandle>,
    job: Option<Job>,
}

impl ExportDialog {
    /// Creates the dialog for the open document, seen as the linked views see it.
    pub fn new(editor: &mut Editor) -> Self {
        let here = || std::env::current_dir().unwrap_or_default();
        let folder = editor.document.path().and_then(|p| p.parent()).map_or_else(here, ToOwned::to_owned);
        let stem = editor.document.path().and_then(|p| p.file_stem()).map_or_else(
            || editor.document.work.design.name.to_lowercase().replace([' ', '/'], "-"),
            |s| s.to_string_lossy().into_owned(),
        );
        let upright = editor.document.named(editor.document.specimen());
        let (linked, own) = aspects(editor, &upright);
        let render =
            own.iter().find(|(shows, _)| *shows == Shows::Render).map_or(&linked, |(_, aspect)| aspect);
        let shot = editor.render_shot(render.view, render.turn);
        let specimen = match Arc::ptr_eq(&shot.specimen, &editor.posed(render.turn)) {
            // A stone alone and at rest is the one that scopes show.
            true => Arc::clone(&render.turned),
            false => editor.document.named(&shot.specimen),
        };
        let shot = Shot { specimen, ..shot };
        let light = match PathBuf::from(&editor.light.0) {
            file if file.is_file() => std::path::absolute(&file).unwrap_or(file),
            name => name,
        };
        let selection = editor.selection.clone();
        // Renders are as large as in their view, or smaller, so that no copy is left out.
        let copies = Copies::at(shot.company.clone(), shot.specimen.solid().vertices());
        let reach = editor.reach(Shows::Render).max(copies.reach(0.0));
        let mut plan =
            ExportPlan { shot, upright, linked, own, reach, selection, light, folder: folder.clone(), stem };
        let can_be_shown: Vec<Shows> = plan.can_be_shown().collect();
        plan.selection.views.retain(|shows| can_be_shown.contains(shows));
        let wake = editor.studio.wake();
        let thumbnails = thumbnails(plan.clone(), move || wake());
        Self { folder: folder.join("out"), plan, thumbnails, pictures: HashMap::new(), job: None }
    }

    /// Asks the export to stop; returns whether files are being written.
    pub fn stop(&self) -> bool {
        let job = self.job.as_ref().filter(|job| job.end().is_none());
        job.map(Job::stop).is_some()
    }

    /// Returns the number of thumbnails that have arrived.
    #[cfg(test)]
    pub fn thumbnails_shown(&self) -> usize {
        self.pictures.len()
    }

    /// Returns the export that is under way or has ended.
    #[cfg(test)]
    pub fn job(&self) -> Option<&Job> {
        self.job.as_ref()
    }

    /// Returns how the export ended, once it has.
    #[cfg(test)]
    pub fn end(&self) -> Option<Result<(), String>> {
        self.job.as_ref()?.end()
    }

    /// Whether files are being written.
    pub fn is_busy(&self) -> bool {
        self.job.as_ref().is_some_and(|job| job.end().is_none())
    }
}

/// Returns how the linked views see a stone, and how each view that looks on its own sees it.
///
/// Of several views that show the same, the one that keys act on counts, or else the first.
fn aspects(editor: &Editor, upright: &Arc<Specimen>) -> (PictureAspect, Vec<(Shows, PictureAspect)>) {
    let desk = &editor.desk;
    // A cache apart from that of the views, so that theirs keeps its poses.
    let mut posed = PoseCache::default();
    let mut aspect = |view: View, turn: f64| PictureAspect { view, turn, turned: posed.of(upright, turn) };
    let linked = aspect(desk.eye.view(None), desk.eye.turn);
    let mut panes = desk.shown();
    panes.sort_by_key(|&pane| (pane != editor.active(), pane));
    let mut own: Vec<(Shows, PictureAspect)> = vec![];
    for pane in panes {
        let shows = desk.panes[pane].shows;
        if shows.is_seen() && own.iter().all(|(other, _)| *other != shows) {
            own.push((shows, aspect(desk.view(pane), desk.eye(pane).turn)));
        }
    }
    let side = |shows: Shows| shows.side().unwrap_or(linked.view.side);
    own.retain(|(shows, aspect)| {
        (aspect.view, aspect.turn) != (View { side: side(*shows), ..linked.view }, linked.turn)
    });
    (linked, own)
}

/// Draws the dialog; returns whether it stays open.
pub fn show(editor: &mut Editor, ui: &mut Ui, export: &mut ExportDialog) -> bool {
    ui.set_width(560.0);
    ui.heading("Export");
    for (shows, image) in export.thumbnails.try_iter() {
        let texture =
            ui.ctx().load_texture(format!("thumbnail {shows:?}"), image, egui::TextureOptions::LINEAR);
        export.pictures.insert(shows, texture);
    }
    if let Some(job) = &export.job {
        if export.plan.selection.scene && job.end() == Some(Ok(())) {
            editor.document.keep_copies();
        }
        let folder = std::path::absolute(&export.plan.folder).unwrap_or_else(|_| export.plan.folder.clone());
        return working(editor, ui, (job, &folder));
    }
    views(ui, export);
    if !export.plan.own.is_empty() {
        let names: Vec<&str> = export.plan.own.iter().map(|(shows, _)| shows.name()).collect();
        let text = format!("As seen in their own views: {}.", names.join(", "));
        ui.label(RichText::new(text).weak().small());
    }
    ui.add_space(6.0);
    settings(editor, ui, export);
    export.plan.folder = export.folder.clone();
    let files = export.plan.files();
    listed(ui, &files);
    editor.selection = Selection { scene: false, ..export.plan.selection.clone() };
    ui.add_space(8.0);
    let mut stays = true;
    ui.horizontal(|ui| {
        let can = files.as_ref().is_ok_and(|f| !f.is_empty());
        if ui.add_enabled(can, egui::Button::new("Write files")).clicked() {
            let wake = editor.studio.wake();
            export.job = Some(Job::begin(export.plan.clone(), move || wake()));
        }
        stays = !ui.button("Cancel").clicked();
    });
    stays
}

fn views(ui: &mut Ui, export: &mut ExportDialog) {
    ui.horizontal_wrapped(|ui| {
        for shows in export.plan.can_be_shown().collect::<Vec<_>>() {
            let mut wanted = export.plan.selection.views.contains(&shows);
            if thumbnail(ui, shows, wanted, export.pictures.get(&shows)) {
                wanted = !wanted;
                export.plan.selection.views.retain(|s| *s != shows);
                if wanted {
                    export.plan.selection.views.push(shows);
                }
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

fn settings(editor: &mut Editor, ui: &mut Ui, export: &mut ExportDialog) {
    Grid::new("export").num_columns(2).spacing(vec2(16.0, 6.0)).show(ui, |ui| {
        ui.label("Formats");
        ui.horizontal(|ui| {
            for (format, name, meaning) in [
                (OutputFormat::Png, "PNG", "Pictures; of scopes both energy and strongest exits."),
                (OutputFormat::Svg, "SVG", "Drawings, and every virtual facet of scopes as a polygon."),
                (OutputFormat::Exr, "EXR", "The energy of every zone, linear, in 32 bits."),
                (OutputFormat::Json, "JSON", "The figures of this view."),
            ] {
                let mut wanted = export.plan.selection.formats.contains(&format);
                if ui.checkbox(&mut wanted, name).on_hover_text(meaning).changed() {
                    export.plan.selection.formats.retain(|f| *f != format);
                    if wanted {
                        export.plan.selection.formats.push(format);
                    }
                }
            }
        });
        ui.end_row();
        ui.label("Scopes");
        let meaning = "Under each picture in a scope: what each colour means, how the stone is tilted, what is unresolved, the \
            stone and the program.";
        ui.checkbox(&mut export.plan.selection.caption, "Caption and legend").on_hover_text(meaning);
        ui.end_row();
        ui.label("Also");
        let meaning = "Where the light behind each pixel comes from, as a picture; the layer of all other light; and a page \
            that refracts a moving background through both.";
        ui.horizontal(|ui| {
            ui.checkbox(&mut export.plan.selection.map, "Refraction map and page").on_hover_text(meaning);
            let meaning = "Bands of wavelengths: of one the map is grey and small, of several its look-up keeps the rainbow.";
            let bands = DragValue::new(&mut export.plan.selection.bands).range(1..=MOST_BANDS).prefix("bands ");
            ui.add_enabled(export.plan.selection.map, bands).on_hover_text(meaning);
            let meaning = "Places of each pixel: of several, what is seen twice through it shows twice; bands times places \
                maps are written.";
            let places = DragValue::new(&mut export.plan.selection.places).range(1..=MOST_PLACES).prefix("places ");
            ui.add_enabled(export.plan.selection.map, places).on_hover_text(meaning);
            let meaning = "The copies as they lie now, with their light and what hangs behind: a scene file and its cut, \
                which this program opens again and draws.";
            ui.checkbox(&mut export.plan.selection.scene, "Scene file and its cut").on_hover_text(meaning);
        });
        ui.end_row();
        let label = ui.label("Size");
        ui.add(DragValue::new(&mut export.plan.selection.size).range(SIZES).speed(8.0).suffix(" pixels"))
            .labelled_by(label.id);
        ui.end_row();
        let label = ui.label("Folder");
        ui.horizontal(|ui| {
            let mut text = export.folder.display().to_string();
            let edit = TextEdit::singleline(&mut text).desired_width(360.0);
            if ui.add(edit).labelled_by(label.id).changed() {
                export.folder = PathBuf::from(text);
            }
            if ui.button("Choose…").clicked() {
                editor.choose(Purpose::Folder);
            }
        });
        ui.end_row();
    });
}

/// The height of the list of files, points: the same for any number of files, so that nothing moves under the pointer.
const LISTED: f32 = 96.0;
/// The least height of the list of files, points, where the window has no room for the whole dialog.
const LEAST_LISTED: f32 = 32.0;

/// The height of a window that has room for the whole dialog, points.
const ROOMY: f32 = 700.0;

/// Draws the list of the files that will be written, and marks those that exist already.
fn listed(ui: &mut Ui, files: &Result<Vec<PathBuf>, String>) {
    match files {
        Err(why) => drop(ui.label(RichText::new(why).color(theme::bad(ui.visuals())))),
        Ok(files) if files.is_empty() => drop(ui.label("Nothing is chosen that these formats can hold.")),
        Ok(files) => {
            let there = files.iter().filter(|f| f.exists()).count();
            let already = if there > 0 {
                format!("; {there} are there already and will be replaced")
            } else {
                String::new()
            };
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

/// Draws the progress of the export and its messages; returns whether the dialog stays open.
fn working(editor: &mut Editor, ui: &mut Ui, (job, folder): (&Job, &Path)) -> bool {
    let end = job.end();
    ui.add(ProgressBar::new(job.done()));
    ui.add(Label::new(job.standing()).truncate());
    let lines = ScrollArea::vertical().max_height(TOLD).min_scrolled_height(TOLD).auto_shrink(false);
    lines.stick_to_bottom(true).show(ui, |ui| {
        job.messages().iter().for_each(|line| drop(ui.label(RichText::new(line).small())));
        match &end {
            Some(Err(why)) if !job.is_stopped() => {
                ui.label(RichText::new(why).color(theme::bad(ui.visuals())));
            }
            _ => {}
        }
    });
    // A line that is always there keeps the button in its place.
    ui.label(RichText::new(if end == Some(Ok(())) { "All files are written." } else { "" }).strong());
    if end.is_none() {
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(80));
        let stop = ui.add_enabled(!job.is_stopped(), egui::Button::new("Stop"));
        if stop
            .on_hover_text("What is written stays; nothing is left half written. Escape does the same.")
            .clicked()
        {
            job.stop();
        }
        return true;
    }
    // In one line, so that the dialog grows no higher and the button does not move under the pointer.
    ui.horizontal(|ui| {
        let stays = !ui.button("Close").clicked();
        if ui.button("Open folder").on_hover_text("Shows the files that were written.").clicked() {
            editor.open_outside(&folder.display().to_string());
        }
        stays
    })
    .inner
}
