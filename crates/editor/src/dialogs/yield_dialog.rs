//! The dialog of size and yield: the stone that a piece of rough gives, or that has a weight.

use super::answers::{answer, body, buttons_alone};
use crate::panels::rows::{ChoiceRow, Number, number_row};
use crate::theme;
use brillianteer_cut::{Finished, FitLimit, Rough};
use brillianteer_session::model::{
    Model,
    action::{Actions, DialogAction},
    fitting::{SizeBy, YieldForm, YieldOptions},
};
use egui::{Grid, RichText, Ui, vec2};
use std::ops::RangeInclusive;

/// The width of the dialog, points.
const WIDTH: f32 = 420.0;

/// The sides of rough that can be typed, mm.
const SIDES_MM: RangeInclusive<f64> = 0.1..=1000.0;

/// The weights that can be typed, carats; 0 stands for one that is not known.
const CARATS: RangeInclusive<f64> = 0.0..=1e6;

/// The thickness of a girdle that can be typed, mm.
const GIRDLES_MM: RangeInclusive<f64> = 0.0..=100.0;

/// The thickness that the girdle's field first shows when the user asks for another girdle than the design's, mm.
const FIRST_GIRDLE_MM: f64 = 0.3;

const SIDES: [(&str, &str); 3] = [
    ("Rough length", "The length of the box of rough, square to the stone's axis."),
    ("Rough width", "The width of the box of rough, square to the stone's axis."),
    ("Rough depth", "The depth of the box of rough, along the stone's axis."),
];

/// Draws the dialog.
pub fn show(model: &Model, form: &YieldForm, actions: &mut Actions, ui: &mut Ui) {
    body(ui, WIDTH, |ui| {
        ui.heading("Size and yield");
        ui.add_space(4.0);
        let mut options = form.options;
        numbers(&mut options, &form.first, ui);
        actions.push_changed(&form.options, options, DialogAction::Size);
        ui.add_space(8.0);
        match &form.found {
            Ok(found) => results(model, &form.options, found, ui),
            Err(why) => {
                ui.label(RichText::new(why.to_string()).color(theme::bad(ui.visuals())));
            }
        }
    });
    // A design cannot keep a girdle thickness in mm, so its size can be taken over only where the girdle is that of
    // the design.
    let answers = [DialogAction::Apply, DialogAction::Leave];
    if form.found.is_ok() && form.options.girdle_mm.is_none() {
        answer(actions, answers, buttons_alone(ui, &["Use this size", "Close"]))
    } else {
        answer(actions, [DialogAction::Leave], buttons_alone(ui, &["Close"]))
    }
}

/// Draws the rows in which numbers are typed: the rough or the weight, and the girdle.
fn numbers(options: &mut YieldOptions, first: &YieldOptions, ui: &mut Ui) {
    let mm = |range: RangeInclusive<f64>, first: f64| Number {
        decimals: 3,
        speed: 0.02,
        range,
        unit: " mm",
        default: Some(first),
    };
    let ct =
        |first: f64| Number { decimals: 3, speed: 0.02, range: CARATS, unit: " ct", default: Some(first) };
    ChoiceRow::new("Size by", "The rough or a weight sets the size.", options.by.name()).show(ui, |ui| {
        for by in SizeBy::ALL {
            if ui.selectable_label(by == options.by, by.name()).on_hover_text(by.meaning()).clicked() {
                options.by = by;
            }
        }
    });
    if options.by == SizeBy::Rough {
        for ((side, row), first) in options.sides_mm.iter_mut().zip(SIDES).zip(first.sides_mm) {
            number_row(ui, row, mm(SIDES_MM, first), side);
        }
    } else {
        let meaning = "The weight of the finished stone.";
        number_row(ui, ("Wanted weight", meaning), ct(first.carats), &mut options.carats);
    }
    let meaning =
        "The weight of the rough, of which the yield is a part as well. 0 stands for one that is not known.";
    let mut rough = options.rough_carats.unwrap_or(0.0);
    number_row(ui, ("Rough weight", meaning), ct(first.rough_carats.unwrap_or(0.0)), &mut rough);
    options.rough_carats = (rough > 0.0).then_some(rough);
    let mut is_own = options.girdle_mm.is_some();
    let meaning = "The finished girdle has a thickness in mm, whatever the size of the stone. Otherwise it grows with the stone.";
    if ui.checkbox(&mut is_own, "Girdle of its own").on_hover_text(meaning).changed() {
        options.girdle_mm = is_own.then_some(FIRST_GIRDLE_MM);
    }
    if let Some(girdle) = &mut options.girdle_mm {
        number_row(ui, ("Girdle thickness", meaning), mm(GIRDLES_MM, FIRST_GIRDLE_MM), girdle);
    }
}

/// Draws the size, the weight and the yield of the finished stone.
fn results(model: &Model, options: &YieldOptions, found: &Finished, ui: &mut Ui) {
    let carats = model.document.specimen().material.carats(found.volume_mm3);
    Grid::new("yield").num_columns(2).spacing(vec2(22.0, 3.0)).striped(true).show(ui, |ui| {
        let mut line = |name: &str, text: String| {
            ui.label(name);
            ui.label(RichText::new(text).strong());
            ui.end_row();
        };
        let [length, width, depth] = found.own_size_mm;
        line("Finished size", format!("{length:.3} × {width:.3} × {depth:.3} mm"));
        line(
            "Finished weight",
            carats.map_or("the density is not known".to_owned(), |carats| format!("{carats:.3} ct")),
        );
        if let Some(mm) = found.girdle_mm {
            line("Finished girdle", format!("{mm:.3} mm"));
        }
        if options.by == SizeBy::Rough {
            let limit = match found.limit {
                FitLimit::Footprint => "the rough's length and width",
                FitLimit::Depth => "the rough's depth",
                FitLimit::Weight => "the weight",
                FitLimit::Diameter => "the diameter",
            };
            line("Limited by", limit.to_owned());
            line("Turned in the rough", format!("{:.2}°", found.turn_deg));
            line("Depth left for the girdle", format!("{:.3} mm", found.depth_left_mm));
            let rough = Rough { sides_mm: options.sides_mm };
            line("Yield of the box", format!("{:.2} %", 100.0 * found.yield_of(rough.volume_mm3())));
        }
        if let Some((carats, rough)) = carats.zip(options.rough_carats) {
            line("Yield of the weight", format!("{:.2} %", 100.0 * carats / rough));
        }
    });
}
