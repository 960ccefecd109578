//! The plot against tilt of one measure, toward several azimuths, each with the band in which it certainly lies.

use super::rows::ChoiceRow;
use brillianteer_measure::{Interval, measure_words};
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
    measure_tilt::{AZIMUTHS, MOST_TILT, TiltCurve, TiltOptions},
};
use egui::{Color32, RichText, Ui};
use egui_plot::{FilledArea, GridInput, GridMark, HoverPosition, Line, Plot, PlotPoints};

/// The colours of the azimuths, which people who see no red or no green can tell apart (B. Wong, Nature Methods 8,
/// 441 (2011)).
const COLOURS: [Color32; AZIMUTHS.len()] = [
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(230, 159, 0),
];

/// The name of the plot where no measure is chosen.
const ZONES: &str = "Zones of the ASET";

/// Draws the choice of the measure and of the azimuths.
pub fn choices(options: &TiltOptions, actions: &mut Actions, ui: &mut Ui) {
    let mut now = options.clone();
    let shown = options.measure.map_or_else(|| ZONES.to_owned(), measure_words::name);
    let meaning = options.measure.map_or("The figures above at each tilt.", measure_words::meaning);
    ChoiceRow::new("Plotted", meaning, &shown).show(ui, |ui| {
        ui.selectable_value(&mut now.measure, None, ZONES);
        for measure in measure_words::all() {
            let entry = ui.selectable_value(&mut now.measure, Some(measure), measure_words::name(measure));
            entry.on_hover_text(measure_words::meaning(measure));
        }
    });
    if now.measure.is_some() {
        ui.horizontal_wrapped(|ui| {
            for ((azimuth, is_on), colour) in AZIMUTHS.into_iter().zip(&mut now.azimuths).zip(COLOURS) {
                let text = RichText::new(format!("{azimuth}°"));
                let text = if *is_on { text.color(colour_of(ui, colour)) } else { text };
                let chip = ui.selectable_label(*is_on, text);
                chip.widget_info(|| {
                    let name = format!("Azimuth {azimuth}°");
                    egui::WidgetInfo::selected(egui::Role::CheckBox, true, *is_on, name)
                });
                *is_on ^=
                    chip.on_hover_text(format!("A curve for tilts toward the azimuth {azimuth}°.")).clicked();
            }
        });
    }
    actions.push_changed(options, now, ViewAction::Tilt);
}

/// Returns a colour as it can be read on the background of the window.
fn colour_of(ui: &Ui, colour: Color32) -> Color32 {
    if ui.visuals().dark_mode { colour.lerp_to_gamma(Color32::WHITE, 0.3) } else { colour }
}

/// Draws the curves of the chosen measure.
pub fn show(model: &Model, ui: &mut Ui) {
    let tilt = &model.session.tilt;
    if model.document.specimen().stone().is_err() {
        ui.label(RichText::new("Only a convex stone between planes has measures.").weak());
        return;
    }
    let curves = tilt.curves();
    let state = match tilt.sweep.found() {
        _ if !tilt.options.azimuths.contains(&true) => "choose an azimuth",
        Some(found) if tilt.sweep.is_present() && found.is_whole() => {
            "percent against tilt from -45° to 45°; bands hold the true values"
        }
        Some(_) => "becoming finer…",
        None => "measured once the pictures are done",
    };
    ui.label(RichText::new(state).weak().small());
    if !curves.is_empty() {
        ui.add_enabled_ui(tilt.sweep.is_present(), |ui| plot(&curves, ui));
    }
}

/// Returns marks at the multiples of 15 degrees in sight.
fn fifteens(input: GridInput) -> Vec<GridMark> {
    let (first, last) = (input.bounds.0 / 15.0, input.bounds.1 / 15.0);
    let marks = (first.ceil() as i32)..=(last.floor() as i32);
    // Only marks that are far apart leave room for a number on the narrow axis.
    let far = |k: i32| if k % 3 == 0 { 45.0 } else { 15.0 };
    marks.map(|k| GridMark { value: 15.0 * f64::from(k), step_size: far(k) }).collect()
}

fn plot(curves: &[(f64, TiltCurve)], ui: &mut Ui) {
    let plot = Plot::new("measure against tilt")
        .height(200.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false);
    let plot = plot.show_x(false).show_y(false).include_x(-MOST_TILT).include_x(MOST_TILT).include_y(0.0);
    let plot = plot.x_grid_spacer(fifteens);
    let plot = plot
        .x_axis_formatter(|mark, _| format!("{}°", mark.value))
        .y_axis_formatter(|mark, _| format!("{} %", mark.value));
    let plot = plot.label_formatter(|nearest| match nearest {
        HoverPosition::NearDataPoint { plot_name, position, .. } => {
            Some(format!("{plot_name}: {:.1} % at {:.1}°", position.y, position.x))
        }
        HoverPosition::Elsewhere { .. } => None,
    });
    let shown = plot.show(ui, |plot| {
        for (azimuth, curve) in curves {
            let place = AZIMUTHS.iter().position(|known| known == azimuth).unwrap_or(0);
            let name = format!("toward {azimuth}°");
            let column = |of: fn(&(f64, Interval)) -> f64| curve.iter().map(of).collect::<Vec<f64>>();
            let tilts = column(|(tilt, _)| *tilt);
            let [least, most] =
                [column(|(_, found)| 100.0 * found.least), column(|(_, found)| 100.0 * found.most)];
            // Filled without softened borders: those of a band without width would stick out as long spikes.
            let band = FilledArea::new("", &tilts, &least, &most).allow_hover(false);
            plot.add(band.fill_color(COLOURS[place].gamma_multiply(0.3)));
            let middles = curve.iter().map(|(tilt, found)| [*tilt, 100.0 * found.middle()]);
            plot.line(Line::new(name, PlotPoints::from_iter(middles)).color(COLOURS[place]).width(1.8));
        }
    });
    shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Measure against tilt"));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{farthest_outside, single_shapes};
    use egui_kittest::Harness;

    #[test]
    fn a_band_of_no_width_has_no_spikes() {
        let no_width = |middle: f64| Interval { least: middle, most: middle };
        let curve = |height: f64| -> TiltCurve {
            (-9..=9)
                .map(|k| {
                    let tilt = 5.0 * f64::from(k);
                    (tilt, no_width(height + 1e-3 * tilt + 1e-6 * tilt * tilt))
                })
                .collect()
        };
        let curves = vec![(0.0, curve(0.3)), (45.0, curve(0.5))];
        let mut harness =
            Harness::builder().with_size(egui::vec2(300.0, 240.0)).build_ui(move |ui| plot(&curves, ui));
        harness.run_steps(2);
        let shapes = &harness.output().shapes;
        let all: Vec<_> = shapes.iter().flat_map(|clipped| single_shapes(&clipped.shape)).collect();
        let meshes = all.iter().filter(|shape| matches!(shape, egui::Shape::Mesh(_)));
        assert_eq!(meshes.count(), 2, "each curve has a band");
        for shape in &all {
            let beyond = farthest_outside(shape);
            assert!(beyond < 3.0, "{beyond} points beyond {:?}", shape.visual_bounding_rect());
        }
    }
}
