//! The curve of progress: the goal of the best cut so far against the number of designs that were tried.

use brillianteer_search::ProgressPoint;
use egui::{Color32, Role, Ui, WidgetInfo};
use egui_plot::{GridInput, GridMark, HoverPosition, Line, Plot, PlotPoints, Points};

/// The colour of the curve, which can be read on light and dark (B. Wong, Nature Methods 8, 441 (2011)).
const CURVE: Color32 = Color32::from_rgb(0, 158, 115);

/// The height of the plot, points.
const HEIGHT: f32 = 200.0;

/// Draws the curve of a search that has tried `tried` designs.
pub fn show(curve: &[ProgressPoint], tried: usize, ui: &mut Ui) {
    let end = tried.max(1) as f64;
    let plot = Plot::new("progress of the search")
        .height(HEIGHT)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .show_x(false)
        .show_y(false)
        .include_x(0.0)
        .include_x(end)
        .x_grid_spacer(sixths)
        .x_axis_label("designs tried")
        .y_axis_label("goal");
    let plot = plot.label_formatter(|nearest| match nearest {
        HoverPosition::NearDataPoint { position, .. } => {
            Some(format!("{:.4} after {:.0} designs", position.y, position.x))
        }
        HoverPosition::Elsewhere { .. } => None,
    });
    let shown = plot.show(ui, |plot| {
        // As a band, the plot would fill the space between points that lie one above the other.
        let line = Line::new("best so far", PlotPoints::from(steps(curve, end))).allow_band(false);
        plot.line(line.color(CURVE).width(1.8));
        let found: Vec<[f64; 2]> = curve.iter().map(|point| [point.appraised as f64, point.total]).collect();
        plot.points(Points::new("best so far", PlotPoints::from(found)).color(CURVE).radius(3.0));
    });
    let spoken = match curve {
        [] => "Progress of the search: nothing yet".to_owned(),
        [.., last] => format!("Progress of the search: {:.4} after {tried} designs", last.total),
    };
    shown.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &spoken));
}

/// Returns marks at round numbers of designs, about six of them, so that each has room for its number.
fn sixths(input: GridInput) -> Vec<GridMark> {
    let (first, last) = input.bounds;
    let least = ((last - first) / 6.0).max(1.0);
    let power = 10.0_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0].map(|factor| factor * power).into_iter().find(|step| *step >= least);
    let step = step.unwrap_or(10.0 * power);
    let marks = (first / step).ceil() as i32..=(last / step).floor() as i32;
    marks.map(|k| GridMark { value: step * f64::from(k), step_size: step }).collect()
}

/// Returns the corners of the curve: the best stays as it is until a better one is found.
fn steps(curve: &[ProgressPoint], end: f64) -> Vec<[f64; 2]> {
    let mut corners: Vec<[f64; 2]> = vec![];
    for point in curve {
        let at = point.appraised as f64;
        if let Some(&[_, before]) = corners.last() {
            corners.push([at, before]);
        }
        corners.push([at, point.total]);
    }
    if let Some(&[_, last]) = corners.last() {
        corners.push([end, last]);
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_stays_until_a_better_one_is_found() {
        let point = |appraised, total| ProgressPoint { appraised, total };
        let corners = steps(&[point(0, 0.5), point(7, 0.6)], 10.0);
        assert_eq!(corners, [[0.0, 0.5], [7.0, 0.5], [7.0, 0.6], [10.0, 0.6]]);
        assert!(steps(&[], 10.0).is_empty());
    }
}
