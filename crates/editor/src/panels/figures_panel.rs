//! The figures panel: the shares of the light by its origin, by exact beams or by rays, and their change when the
//! stone is tilted.

use crate::panels::figure_lines::{Counting, Figure, FigureLine, energy, lines, zones};
use crate::panels::rows::explain;
use crate::panels::{figures_text, pane_rows, side_panels, tilt_plot};
use crate::theme;
use brillianteer_math::signed;
use brillianteer_scene::Glare;
use brillianteer_session::model::{
    Model,
    action::{Actions, NoteAction, ViewAction},
    workspace::{PanelSide, Workspace},
};
use brillianteer_session::studio::{Tilts, Which};
use egui::{Align, Button, Color32, Layout, Panel, Rect, RichText, ScrollArea, Sense, Ui, pos2, vec2};
use egui_plot::{GridInput, GridMark, HoverPosition, Plot, PlotPoint, PlotPoints};
use std::ops::RangeInclusive;

/// Draws the figures panel.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui, widths: RangeInclusive<f32>) {
    Panel::right("figures").resizable(true).default_size(280.0).size_range(widths).show(ui, |ui| {
        side_panels::head(actions, ui, PanelSide::Figures);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            pane_rows::show(model, actions, ui);
            ui.add_space(8.0);
            let whole = ui.scope(|ui| {
                figures(model, actions, ui);
                against_tilt(model, actions, ui);
            });
            whole.response.container_context_menu(|ui| copies(model, actions, ui));
        });
    });
}

fn figures(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("Figures").heading()).on_hover_text(
            "The light of the linked views in the ordinary ASET, in percent of the stone's outline, at 589.3 nm \
                (sodium). While figures become finer, they may be too low by the unresolved light; then rays estimate \
                where it goes, which adds an error of sampling. Meshes and glass are measured by rays alone.",
        );
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.menu_button("Copy", |ui| copies(model, actions, ui));
        });
    });
    how(&model.workspace, actions, ui);
    if let Some(measured) = model.session.measured.figures.get(&Which::Present) {
        table(ui, &lines(measured, figures_text::other(model), Counting::of(&model.workspace)));
        ui.label(RichText::new(figures_text::state(model, measured)).weak().small());
    }
}

fn against_tilt(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    ui.add_space(8.0);
    ui.label(RichText::new("Against tilt").heading()).on_hover_text(
        "The same figures while the stone tilts from -30° to 30° toward the azimuth of the linked views, or one measure from \
            -45° to 45° toward the azimuths that you choose.",
    );
    let options = &model.session.tilt.options;
    tilt_plot::choices(options, actions, ui);
    if options.measure.is_some() {
        tilt_plot::show(model, ui);
        return;
    }
    if let Some((order, tilts)) = &model.session.measured.tilts {
        ui.label(RichText::new("in the colours of the zones above").weak().small());
        let is_ordered = model.session.ordered.tilts.as_ref() == Some(order);
        ui.add_enabled_ui(is_ordered, |ui| plot(ui, order.head, model.workspace.glare(), tilts));
    } else {
        ui.label(RichText::new("measured once everything else is done").weak());
    }
}

/// Draws the menu entries that copy the figures.
fn copies(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let tilts = model.session.measured.tilts.as_ref();
    let tilts = tilts.map(|(order, tilts)| figures_text::tilts(order.head, model.workspace.glare(), tilts));
    let all = "Copies a table for spreadsheets: energy and area of every figure, in percent.";
    let zones = "Copies a table for spreadsheets: the energy of each zone at each tilt, in percent.";
    for (name, meaning, text) in [
        (
            "Copy as text",
            "Copies the figures as they are shown, one per line.",
            figures_text::shown(model, false),
        ),
        ("Copy as CSV", all, figures_text::shown(model, true)),
        ("Copy tilts as CSV", zones, tilts),
    ] {
        let entry = ui.add_enabled(text.is_some(), Button::new(name)).on_hover_text(meaning);
        if let Some(text) = text.filter(|_| entry.clicked()) {
            ui.ctx().copy_text(text);
            actions.push(NoteAction::Say("Figures copied".to_owned()));
            ui.close();
        }
    }
}

fn how(workspace: &Workspace, actions: &mut Actions, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let mut by_area = workspace.by_area;
        ui.selectable_value(&mut by_area, false, "Energy")
            .on_hover_text("The share of the light that comes from each zone, over all exits of each point.");
        ui.selectable_value(&mut by_area, true, "Area").on_hover_text(
            "The part of the stone whose strongest light comes from each zone, as most ASET scores count it.",
        );
        actions.push_changed(&workspace.by_area, by_area, ViewAction::ByArea);
    });
    ui.label(RichText::new(figures_text::view(&workspace.eye)).weak());
}

fn table(ui: &mut Ui, lines: &[FigureLine]) {
    let zones = lines.iter().filter(|line| line.figure.band().is_some()).count();
    for (k, line) in lines.iter().enumerate() {
        if k == zones {
            ui.add_space(4.0);
        }
        row(ui, line);
    }
}

fn row(ui: &mut Ui, row: &FigureLine) {
    let Figure { name, meaning, is_strong, .. } = *row.figure;
    let visuals = ui.visuals();
    let plain = if is_strong { visuals.text_color() } else { visuals.weak_text_color() };
    let colour: Color32 = row.figure.band().map_or(plain, |band| theme::zone(band, visuals));
    let percent = 100.0 * row.share;
    let (width, height) = (ui.available_width(), 20.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let spoken = format!("{name} {percent:.2} %");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &spoken));
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
    let number = match (row.other, row.difference()) {
        (None, _) => format!("{percent:.2} %"),
        (Some(_), Some(difference)) => format!("{percent:.1} ({})", signed(100.0 * difference, 1)),
        (Some(_), None) => format!("{percent:.1} (…)"),
    };
    for (text, layout) in
        [(name, Layout::left_to_right(Align::Center)), (&number, Layout::right_to_left(Align::Center))]
    {
        let text = RichText::new(text);
        let place = egui::UiBuilder::new().max_rect(rect).layout(layout);
        ui.new_child(place).label(if is_strong { text.strong() } else { text });
    }
    // The explanation covers the whole row, the words too.
    let over = ui.interact(rect, response.id.with("row"), Sense::hover());
    explain(ui, over, meaning);
}

/// Returns marks at the multiples of ten in sight.
fn tens(input: GridInput) -> Vec<GridMark> {
    let (first, last) = (input.bounds.0 / 10.0, input.bounds.1 / 10.0);
    let tens = (first.ceil() as i32)..=(last.floor() as i32);
    // Only marks that are far apart leave room for a number on the narrow axis.
    let far = |k: i32| if k % 3 == 0 { 30.0 } else { 10.0 };
    tens.map(|k| GridMark { value: 10.0 * f64::from(k), step_size: far(k) }).collect()
}

/// Plots the light of the zones against tilt, in the colours of the bars above.
fn plot(ui: &mut Ui, head: f64, glare: Glare, tilts: &Tilts) {
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
        for (zone, number) in zones(head) {
            let Some(band) = zone.band().filter(|band| *band != "head") else { continue };
            let points = tilts.iter().map(|(tilt, figures)| [*tilt, 100.0 * energy(figures, number, glare)]);
            let colour = theme::zone(band, &plot.ctx().global_style().visuals);
            plot.line(
                egui_plot::Line::new(zone.name, PlotPoints::from_iter(points)).color(colour).width(1.8),
            );
        }
    });
}
