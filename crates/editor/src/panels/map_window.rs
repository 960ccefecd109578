//! The window with the map of a measure: the choices of measure and axes, the map, and the values under the pointer.

use super::map_plot::{MapPlot, MapReading};
use super::rows::{ANY, ChoiceRow, NUMBER, Number, named_with_reset};
use crate::scrolled::scrolled;
use brillianteer_cut::{Cut, Design};
use brillianteer_measure::measure_words;
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
    measure_map::{MapAxis, MapOptions, MeasureMap, no_stone},
};
use egui::{Context, Pos2, RichText, Ui, Vec2, Window, pos2, vec2};

/// The size of the window at first, and at least, points.
const SIZES: [Vec2; 2] = [vec2(560.0, 600.0), vec2(420.0, 260.0)];

/// The first place of the window's upper left corner, points: right of the design panel, whose fields it does not
/// cover.
const PLACE: Pos2 = pos2(376.0, 64.0);

/// The label of the published range.
pub const PUBLISHED: &str = "GIA's published range for EX: an estimate, not a grade";

/// Draws the window where it is open.
pub fn show(model: &Model, actions: &mut Actions, ctx: &Context) {
    if !model.shows_map() {
        return;
    }
    let mut is_open = true;
    let window = Window::new("Map of a measure")
        .open(&mut is_open)
        .default_size(SIZES[0])
        .min_size(SIZES[1])
        .default_pos(PLACE);
    window.show(ctx, |ui| {
        let room = ui.available_height();
        scrolled(ui, "map", room, |ui| {
            // The map takes what is left of the room, and no less than a map needs.
            ui.set_max_height(room);
            contents(model, actions, ui);
        });
    });
    actions.push_if(!is_open, brillianteer_session::model::command::Command::Map);
}

fn contents(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let design = &model.document.work.design;
    if model.document.specimen().stone().is_err() {
        ui.label("Only a convex stone between planes can be mapped: its light is followed exactly.");
        return;
    }
    let Some(options) = model.session.map.options() else {
        ui.label("The design has no two proportions or tiers to vary.");
        return;
    };
    let mut now = options.clone();
    choices(&mut now, &design.cut, ui);
    actions.push_changed(options, now, ViewAction::Map);
    ui.label(RichText::new(state(&model.session.map)).weak().small());
    let plot = MapPlot::new(&model.session.map, options, design);
    let reading = plot.show(actions, ui);
    ui.label(said(options, reading.as_ref(), design));
    if options.published_range(design).is_some() {
        ui.label(RichText::new(format!("Frame: {PUBLISHED}.")).weak().small());
    }
}

/// Draws the choice of the measure and of both axes with their ends.
fn choices(options: &mut MapOptions, cut: &Cut, ui: &mut Ui) {
    let meaning = measure_words::meaning(options.measure);
    let before = options.measure;
    ChoiceRow::new("Measure", meaning, &measure_words::name(before)).show(ui, |ui| {
        for measure in measure_words::all() {
            let entry = ui.selectable_value(&mut options.measure, measure, measure_words::name(measure));
            entry.on_hover_text(measure_words::meaning(measure));
        }
    });
    let all = MapAxis::all(cut);
    for (place, [name, least, most]) in
        [["Across", "Least across", "Greatest across"], ["Up", "Least up", "Greatest up"]]
            .into_iter()
            .enumerate()
    {
        let other = options.axes[1 - place].clone();
        let axis = &mut options.axes[place];
        let meaning = "The number that varies along this axis. Where one number follows from another, only one of them can vary.";
        ChoiceRow::new(name, meaning, &axis.name.clone()).show(ui, |ui| {
            for offered in all.iter().filter(|offered| !offered.is_paired(&other, cut)) {
                if ui.selectable_label(offered.key == axis.key, &offered.name).clicked()
                    && offered.key != axis.key
                {
                    *axis = offered.clone();
                }
            }
        });
        ui.horizontal(|ui| {
            let ends = [
                (least, "The value at the first end of the axis."),
                (most, "The value at the other end of the axis."),
            ];
            let first = all.iter().find(|offered| offered.key == axis.key).map(|offered| offered.ends);
            for (k, (end, (name, meaning))) in axis.ends.iter_mut().zip(ends).enumerate() {
                let (label, is_reset) = named_with_reset(ui, name, meaning);
                if let Some(first) = first.filter(|_| is_reset) {
                    *end = first[k];
                }
                let number = Number { decimals: 2, speed: 0.05, range: ANY, unit: axis.unit, default: None };
                number.show(ui, (NUMBER, label.id), end);
            }
        });
    }
}

/// Describes how many points of the map have been answered.
fn state(map: &MeasureMap) -> String {
    match map.sweep.found() {
        Some(found) if !map.sweep.is_present() => {
            let count = found.answered;
            format!(
                "the map of the design before ({count} places); the new one begins when the pictures are done…"
            )
        }
        Some(found) if found.is_whole() => format!("{} places, face up; final", found.answered),
        Some(found) => {
            format!("{} of {} places, face up; becoming finer…", found.answered, found.order.points.len())
        }
        None => "the map begins when the pictures are done…".to_owned(),
    }
}

/// Describes the place under the pointer, or the place of the design.
fn said(options: &MapOptions, reading: Option<&MapReading>, design: &Design) -> String {
    let [across, up] = &options.axes;
    let place = |values: [f64; 2]| {
        format!("{} {}, {} {}", across.name, across.written(values[0]), up.name, up.written(values[1]))
    };
    match reading {
        Some(MapReading { at, found: None }) => format!("{}: not measured yet", place(*at)),
        Some(MapReading { at, found: Some(Err(error)) }) => {
            format!("{}: no stone: {}", place(*at), no_stone(error))
        }
        Some(MapReading { at, found: Some(Ok(stone)) }) => match options.measure.of(&stone.measures) {
            Some(found) => format!("{}: {}", place(*at), measure_words::value(found)),
            None => format!("{}: not measured", place(*at)),
        },
        None => match (across.value(&design.cut), up.value(&design.cut)) {
            (Some(x), Some(y)) => format!("The design: {}. Click or drag to move it.", place([x, y])),
            _ => "Click or drag to move the design.".to_owned(),
        },
    }
}
