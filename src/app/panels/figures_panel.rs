//! The figures panel: where the light comes from, by exact beams or by rays, and how that changes when the stone is tilted.

use crate::app::editor::Editor;
use crate::app::model::figures::ShownFigures;
use crate::app::model::workspace::PanelSide;
use crate::app::panels::figures_text::{self, FiguresSubject};
use crate::app::panels::pane_rows;
use crate::app::panels::rows::explain;
use crate::app::panels::side_panels;
use crate::app::studio::{Grade, Tilts, Which};
use crate::app::theme;
use crate::measure::Figures;
use crate::scene::{ASET_CONE, Backing, Glare, Scope};
use egui::{Align, Button, Color32, Layout, Panel, Rect, RichText, ScrollArea, Sense, Ui, pos2, vec2};
use egui_plot::{GridInput, GridMark, HoverPosition, Plot, PlotPoint, PlotPoints};
use std::ops::RangeInclusive;

/// The zones that rows show: the name in the panel, the band in the scope, and the meaning of each.
pub(crate) const ZONES: [(&str, &str, &str); 5] = [
    ("Red", "red", "Light from 45° to 75° above the horizon: the brightest that rooms have."),
    ("Green", "green", "Light from the horizon to 45°: walls and windows."),
    ("Blue", "blue", "Light from straight above, which an observer's head blocks: it makes the contrast."),
    ("Head", "head", "Light that the observer's head shuts out."),
    ("Leakage", "below", "Light from behind the stone: what the pavilion lets out. A dark spot or a window."),
];

/// Draws the figures panel.
pub fn show(editor: &mut Editor, ui: &mut Ui, widths: RangeInclusive<f32>) {
    Panel::right("figures").resizable(true).default_size(280.0).size_range(widths).show(ui, |ui| {
        side_panels::head(editor, ui, PanelSide::Figures);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            pane_rows::show(editor, ui);
            ui.add_space(8.0);
            let whole = ui.scope(|ui| {
                figures(editor, ui);
                against_tilt(editor, ui);
            });
            whole.response.container_context_menu(|ui| copies(editor, ui));
        });
    });
}

fn figures(editor: &mut Editor, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("Figures").heading()).on_hover_text(
            "What becomes of the light of the linked view in the common ASET, in percent of the stone's outline, at \
             sodium's 589.3 nm. Each may be too low by what is unresolved; by rays, as of meshes and glass, there is the \
             error of sampling as well.",
        );
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.menu_button("Copy", |ui| copies(editor, ui));
        });
    });
    how(editor, ui);
    if let Some(measured) = editor.model.session.measured.figures.get(&Which::Present) {
        table(
            ui,
            &lines(measured, other(editor), (editor.model.workspace.by_area, editor.model.workspace.glare())),
        );
        ui.label(RichText::new(state(editor, measured)).weak().small());
    }
}

/// Returns the figures of the design compared with.
fn other(editor: &Editor) -> Option<&ShownFigures> {
    editor
        .model
        .session
        .compared
        .as_ref()
        .and_then(|_| editor.model.session.measured.figures.get(&Which::Other))
}

/// Says whether the figures are final, and their error where they are sampled.
fn state(editor: &Editor, measured: &ShownFigures) -> String {
    let is_asked = editor.model.session.ordered.figures.iter().any(|(_, ask)| *ask == measured.ask);
    let state = match is_asked && measured.grade == Grade::Fine {
        true if editor.model.document.shows_last_possible() => "those of the last possible stone",
        true => "final",
        false => "becoming finer…",
    };
    let glare = editor.model.workspace.glare().description();
    match measured.figures.standard_error {
        error if error > 0.0 => format!("{state}; by rays, standard error {:.2} %; {glare}", 100.0 * error),
        _ => format!("{state}; {glare}"),
    }
}

fn against_tilt(editor: &mut Editor, ui: &mut Ui) {
    ui.add_space(8.0);
    ui.label(RichText::new("Against tilt").heading()).on_hover_text(
        "The same figures while the stone leans toward the azimuth of the linked views, -30° to 30°.",
    );
    if let Some((ask, tilts)) = &editor.model.session.measured.tilts {
        ui.label(RichText::new("in the colours of the zones above").weak().small());
        let (is_asked, glare) =
            (editor.model.session.ordered.tilts.as_ref() == Some(ask), editor.model.workspace.glare());
        ui.add_enabled_ui(is_asked, |ui| plot(ui, (ask.head, glare), tilts));
    } else {
        ui.label(RichText::new("comes when all else is done").weak());
    }
}

/// Draws the menu entries that copy the figures.
fn copies(editor: &mut Editor, ui: &mut Ui) {
    let copied = |editor: &mut Editor, ui: &mut Ui, text: String| {
        ui.ctx().copy_text(text);
        editor.model.session.notes.say("Figures copied");
        ui.close();
    };
    let measured = editor.model.session.measured.figures.get(&Which::Present);
    let has_figures = measured.is_some();
    let about = "The figures as they are shown, a line each.";
    if ui.add_enabled(has_figures, Button::new("Copy as text")).on_hover_text(about).clicked()
        && let Some(text) = as_text(editor, false)
    {
        copied(editor, ui, text);
    }
    let about = "A table for spreadsheets: energy and area of every figure, in percent.";
    if ui.add_enabled(has_figures, Button::new("Copy as CSV")).on_hover_text(about).clicked()
        && let Some(text) = as_text(editor, true)
    {
        copied(editor, ui, text);
    }
    let tilts = editor.model.session.measured.tilts.as_ref().map(|(ask, tilts)| (ask.head, tilts.clone()));
    let about = "A table for spreadsheets: the zones' energy at each tilt, in percent.";
    if ui.add_enabled(tilts.is_some(), Button::new("Copy tilts as CSV")).on_hover_text(about).clicked()
        && let Some((head, tilts)) = tilts
    {
        let text = figures_text::tilts((head, editor.model.workspace.glare()), &tilts);
        copied(editor, ui, text);
    }
}

/// Returns the figures as text, or as a table.
fn as_text(editor: &Editor, as_table: bool) -> Option<String> {
    let measured = editor.model.session.measured.figures.get(&Which::Present)?;
    let other = other(editor);
    let by_area = editor.model.workspace.by_area;
    let by = if by_area { "area of strongest exits" } else { "energy" };
    let (view, state) = (view(editor), format!("ASET, {by}; {}", state(editor, measured)));
    let about = FiguresSubject {
        design: &editor.model.document.work.design.name,
        view: &view,
        state: &state,
        other: editor
            .model
            .session
            .compared
            .as_ref()
            .filter(|_| other.is_some())
            .map(|compared| compared.name.as_str()),
    };
    let glare = editor.model.workspace.glare();
    let lines = |by_area| lines(measured, other, (by_area, glare));
    Some(match as_table {
        true => figures_text::csv(&about, &lines(false), &lines(true)),
        false => figures_text::text(&about, &lines(by_area)),
    })
}

fn how(editor: &mut Editor, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.selectable_value(&mut editor.model.workspace.by_area, false, "Energy")
            .on_hover_text("How much of the light comes from each zone, all exits of each point together.");
        ui.selectable_value(&mut editor.model.workspace.by_area, true, "Area").on_hover_text(
            "The part of the stone whose strongest light comes from each zone, as most ASET scores count.",
        );
    });
    ui.label(RichText::new(view(editor)).weak());
}

/// Says from where the stone is seen for the figures.
fn view(editor: &Editor) -> String {
    let tilt = editor.model.workspace.eye.tilt().to_degrees();
    let azimuth = (editor.model.workspace.eye.view(None).azimuth - editor.model.workspace.eye.turn)
        .to_degrees()
        .rem_euclid(360.0);
    let what = if editor.model.workspace.eye.eye_leans { "eye" } else { "stone" };
    let view = if tilt == 0.0 {
        "face up".to_owned()
    } else {
        format!("{what} tilted {tilt:.1}° toward {azimuth:.0}°")
    };
    format!("Table side, {view}")
}

/// One figure, as the panel shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FigureLine {
    /// The name of the figure.
    pub name: &'static str,
    /// What the figure means.
    pub meaning: &'static str,
    /// The figure, as a part of the stone's outline.
    pub share: f64,
    /// The same figure of the design compared with, if any.
    pub other: Option<f64>,
    /// How far apart `share` and `other` may be in one and the same stone; 0 once both are final.
    pub error: f64,
    /// The zone whose colour the figure has, if any.
    pub band: Option<&'static str>,
    /// Whether the figure stands out among the others.
    pub is_strong: bool,
}

impl FigureLine {
    /// Returns how much more the present design has than the one compared with.
    ///
    /// `None` while the difference may be no more than what both are still uncertain by.
    pub fn difference(&self) -> Option<f64> {
        let difference = self.share - self.other?;
        (self.error == 0.0 || difference.abs() > self.error).then_some(difference)
    }
}

/// The number of standard errors within which figures by rays almost always lie.
const SIGMAS: f64 = 4.0;

/// Returns how far apart two figures of the same stone may be while one or both are becoming finer.
///
/// Each may be too low by what is unresolved. Figures that are final are compared as they are: their error is 0.
fn error(present: &ShownFigures, other: &ShownFigures, by_area: bool) -> f64 {
    if [present, other].iter().all(|measured| measured.grade == Grade::Fine) {
        return 0.0;
    }
    let unresolved =
        |m: &ShownFigures| PanelZones::of(&m.figures, m.ask.head, (by_area, Glare::Included)).unresolved;
    let sampled = SIGMAS * (present.figures.standard_error + other.figures.standard_error);
    unresolved(present).max(unresolved(other)) + sampled
}

/// The figures that are no zones: name, meaning, source, and whether the figure stands out.
const TOTALS: [(&str, &str, Pick, bool); 5] = [
    (
        "Light return",
        "Light from above the horizon that has been inside the stone: what makes it bright. Glare is not in it.",
        |zones| zones.lit,
        true,
    ),
    (WITH_GLARE, "Light return, and the glare from above the horizon.", |zones| zones.lit_with_glare, false),
    (
        "Glare",
        "Light that the outer surface reflects without having been inside.",
        |zones| zones.glare,
        false,
    ),
    ("Absorbed", "Light that the stone's colour takes away.", |zones| zones.absorbed, false),
    (
        "Unresolved",
        "Light that was not followed to its end: by it, figures may be too low.",
        |zones| zones.unresolved,
        false,
    ),
];

/// The name of the row that is shown where glare is included.
const WITH_GLARE: &str = "With glare";

/// Returns all figures in the order of the panel: those of zones first.
pub(crate) fn lines(
    measured: &ShownFigures,
    other: Option<&ShownFigures>,
    (by_area, glare): (bool, Glare),
) -> Vec<FigureLine> {
    let error = other.map_or(0.0, |other| error(measured, other, by_area));
    let zones = |m: &ShownFigures| PanelZones::of(&m.figures, m.ask.head, (by_area, glare));
    let (present, other) = (zones(measured), other.map(zones));
    let shown = ZONES.iter().filter(|(_, band, _)| *band != "head" || measured.ask.head > 0.0);
    let of_zones = shown.map(|&(name, band, meaning)| FigureLine {
        name,
        meaning,
        share: present.band(band),
        other: other.as_ref().map(|zones| zones.band(band)),
        error,
        band: Some(band),
        is_strong: false,
    });
    let total = |&(name, meaning, of, is_strong): &(&'static str, &'static str, Pick, bool)| FigureLine {
        name,
        meaning,
        share: of(&present),
        other: other.as_ref().map(of),
        error,
        band: None,
        is_strong,
    };
    let undecided = "Where a stronger exit may hide in what is unresolved, or nothing leaves the stone.";
    match by_area {
        true => of_zones.chain([total(&("Undecided", undecided, |zones| zones.unresolved, false))]).collect(),
        false => {
            let is_shown =
                |(name, ..): &&(&str, &str, Pick, bool)| *name != WITH_GLARE || glare == Glare::Included;
            of_zones.chain(TOTALS.iter().filter(is_shown).map(total)).collect()
        }
    }
}

fn table(ui: &mut Ui, lines: &[FigureLine]) {
    let zones = lines.iter().filter(|line| line.band.is_some()).count();
    for (k, line) in lines.iter().enumerate() {
        if k == zones {
            ui.add_space(4.0);
        }
        row(ui, line);
    }
}

/// Reads a number from what the panel shows.
type Pick = fn(&PanelZones) -> f64;

/// What the panel shows, as shares of the outline.
pub(crate) struct PanelZones {
    bands: Vec<(String, f64)>,
    glare: f64,
    absorbed: f64,
    unresolved: f64,
    /// Light from above the horizon that has been inside the stone, but for what the head shuts out.
    lit: f64,
    /// The same, with glare.
    lit_with_glare: f64,
}

impl PanelZones {
    fn of(figures: &Figures, head: f64, (by_area, glare): (bool, Glare)) -> Self {
        let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(head);
        let share =
            |k: usize| if by_area { figures.strongest_exit_area[k] } else { energy(figures, k, glare) };
        let bands = scope.bands.iter().enumerate().map(|(k, b)| (b.name.clone(), share(k))).collect();
        let lit = figures.light_return(&scope);
        let lit_with_glare = lit + figures.glare_return(&scope);
        let unresolved = if by_area { figures.strongest_exit_undecided } else { figures.unresolved };
        let glare = figures.surface.iter().sum();
        Self { bands, glare, absorbed: figures.absorbed, unresolved, lit, lit_with_glare }
    }

    fn band(&self, name: &str) -> f64 {
        self.bands.iter().find(|(n, _)| n == name).map_or(0.0, |(_, share)| *share)
    }
}

fn row(ui: &mut Ui, row: &FigureLine) {
    let visuals = ui.visuals();
    let plain = if row.is_strong { visuals.text_color() } else { visuals.weak_text_color() };
    let colour: Color32 = row.band.map_or(plain, |band| theme::zone(band, visuals));
    let percent = 100.0 * row.share;
    let (width, height) = (ui.available_width(), 20.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let told = format!("{} {percent:.2} %", row.name);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &told));
    let bar = Rect::from_min_max(
        pos2(rect.left() + 86.0, rect.top() + 5.0),
        pos2(rect.right() - 66.0, rect.bottom() - 5.0),
    );
    ui.painter().rect_filled(bar, 2.0, ui.visuals().extreme_bg_color);
    let end = bar.left() + bar.width() * row.share.clamp(0.0, 1.0) as f32;
    ui.painter().rect_filled(Rect::from_min_max(bar.min, pos2(end, bar.bottom())), 2.0, colour);
    if let Some(other) = row.other {
        let x = bar.left() + bar.width() * other.clamp(0.0, 1.0) as f32;
        ui.painter().vline(x, bar.y_range().expand(3.0), egui::Stroke::new(2.0, ui.visuals().text_color()));
    }
    let text = |ui: &mut Ui, text: String| {
        let text = RichText::new(text);
        ui.label(if row.is_strong { text.strong() } else { text })
    };
    let mut left =
        ui.new_child(egui::UiBuilder::new().max_rect(rect).layout(Layout::left_to_right(Align::Center)));
    text(&mut left, row.name.to_owned());
    let mut right =
        ui.new_child(egui::UiBuilder::new().max_rect(rect).layout(Layout::right_to_left(Align::Center)));
    let number = match (row.other, row.difference()) {
        (None, _) => format!("{percent:.2} %"),
        (Some(_), Some(difference)) => format!("{percent:.1} ({:+.1})", 100.0 * difference),
        (Some(_), None) => format!("{percent:.1} (…)"),
    };
    text(&mut right, number);
    // The explanation covers the whole row, the words too.
    let over = ui.interact(rect, response.id.with("row"), Sense::hover());
    explain(ui, over, row.meaning);
}

/// Returns marks at the multiples of ten in sight.
fn tens(input: GridInput) -> Vec<GridMark> {
    let (first, last) = (input.bounds.0 / 10.0, input.bounds.1 / 10.0);
    let tens = (first.ceil() as i32)..=(last.floor() as i32);
    // Only marks that are far apart have room for a number on the narrow axis.
    let far = |k: i32| if k % 3 == 0 { 30.0 } else { 10.0 };
    tens.map(|k| GridMark { value: 10.0 * f64::from(k), step_size: far(k) }).collect()
}

/// Plots the light of the zones against tilt, in the colours of the bars above.
fn plot(ui: &mut Ui, (head, glare): (f64, Glare), tilts: &Tilts) {
    let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(head);
    let plot = Plot::new("tilts")
        .height(200.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .show_x(false)
        .show_y(false);
    let plot = plot.include_y(0.0).include_y(60.0).x_grid_spacer(tens).y_grid_spacer(tens);
    let plot = plot
        .x_axis_formatter(|mark, _| format!("{}°", mark.value))
        .y_axis_formatter(|mark, _| format!("{} %", mark.value));
    let now = |name: &str, point: &PlotPoint| format!("{name}: {:.1} % at {:.0}°", point.y, point.x);
    let plot = plot.label_formatter(move |nearest| match nearest {
        HoverPosition::NearDataPoint { plot_name, position, .. } => Some(now(plot_name, position)),
        HoverPosition::Elsewhere { .. } => None,
    });
    plot.show(ui, |plot| {
        for (name, band, _) in ZONES.into_iter().filter(|(_, band, _)| *band != "head") {
            let Some(k) = scope.bands.iter().position(|b| b.name == band) else { continue };
            let points = tilts.iter().map(|(tilt, f)| [*tilt, 100.0 * energy(f, k, glare)]);
            let colour = theme::zone(band, &plot.ctx().global_style().visuals);
            plot.line(egui_plot::Line::new(name, PlotPoints::from_iter(points)).color(colour).width(1.8));
        }
    });
}

/// Returns the light of a band, with or without glare; 0 where the figures lack the band, as they may lack the head.
pub(crate) fn energy(figures: &Figures, band: usize, glare: Glare) -> f64 {
    let of = |zones: &[f64]| zones.get(band).copied().unwrap_or(0.0);
    of(&figures.transmitted) + if glare == Glare::Included { of(&figures.surface) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::document::Document;
    use crate::app::studio::FiguresOrder;
    use crate::measure::by_beams;
    use crate::optics::line;
    use crate::scene::View;
    use crate::trace::{beam, unwatched};
    use std::sync::Arc;

    /// Returns the figures of the first stone, with a share of the light left unresolved.
    fn measured(unresolved: f64, grade: Grade) -> ShownFigures {
        let specimen = Arc::clone(Document::first().unwrap().specimen());
        let options = beam::BeamOptions { unresolved, ..beam::BeamOptions::default() };
        let (medium, view) = (specimen.medium(line::SODIUM_D), View::default());
        let beams =
            beam::trace(&specimen.stone().unwrap().polytope, medium, &view, &options, &unwatched).unwrap();
        let figures = by_beams(&beams, &Scope::aset(ASET_CONE, Backing::Black));
        ShownFigures { ask: FiguresOrder { specimen, view, head: 0.0 }, grade, figures }
    }

    #[test]
    fn two_grades_of_the_same_stone_are_never_different() {
        let fine = measured(1.5e-4, Grade::Fine);
        let mut apart: f64 = 0.0;
        for unresolved in [2e-3, 2e-2, 8e-2] {
            let rough = measured(unresolved, Grade::Rough);
            for by_area in [false, true] {
                let error = error(&rough, &fine, by_area);
                let [a, b] =
                    [&rough, &fine].map(|m| PanelZones::of(&m.figures, 0.0, (by_area, Glare::Included)));
                for (_, band, _) in ZONES {
                    let difference = (a.band(band) - b.band(band)).abs();
                    assert!(difference <= error, "{band} at {unresolved}: {difference} is above {error}");
                    apart = apart.max(difference);
                }
            }
        }
        assert!(apart > 5e-3, "the grades differ visibly: by {apart}");
        assert_eq!(error(&fine, &fine, false), 0.0);
    }
}
