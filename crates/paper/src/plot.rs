//! Plots of numbers over one or two axes, as SVG.

mod curves;
mod panels;

pub use curves::{COLOURS_OF_CURVES, PlotCurve, curves, marked_curves};
pub use panels::{PlotPanel, panels};

use contour::ContourBuilder;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use std::ops::Range;

/// The usual size of a plot, in units of its drawing.
pub const PLOT_SIZE: (u32, u32) = (1000, 680);

/// The width of a map's scale of colours.
const SCALE_WIDTH: i32 = 150;

/// The approximate number of lines of equal value on a map.
const LINES: f64 = 8.0;

/// The colour of places without a value.
const NOTHING: RGBColor = RGBColor(225, 225, 225);

/// The reason why a plot cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// An axis with fewer than two values, or whose values do not rise or fall throughout.
    #[error("an axis of a plot needs two or more numbers that rise or fall; {label} has not")]
    Axis {
        /// The label of the axis.
        label: String,
    },
    /// There is no number at any place.
    #[error("there is no number to plot")]
    Nothing,
    /// The library that draws has failed.
    #[error("the plot cannot be drawn: {reason}")]
    Drawing {
        /// The reason that it gives.
        reason: String,
    },
}

/// An axis of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotAxis {
    /// The label beside it.
    pub label: String,
    /// Its places, which rise or fall throughout.
    pub values: Vec<f64>,
}

impl PlotAxis {
    /// Checks that the axis can be plotted.
    ///
    /// # Errors
    /// Fails with [`PlotError::Axis`] where it has fewer than two values, or they do not rise or fall throughout.
    pub fn check(&self) -> Result<(), PlotError> {
        self.ends().map(drop)
    }

    /// Returns the ends of the axis, rising.
    fn ends(&self) -> Result<Range<f64>, PlotError> {
        let fault = || PlotError::Axis { label: self.label.clone() };
        let rises = self.values.windows(2).all(|pair| pair[0] < pair[1]);
        let falls = self.values.windows(2).all(|pair| pair[0] > pair[1]);
        match *self.values.as_slice() {
            [first, .., last] if rises || falls => Ok(first.min(last)..first.max(last)),
            _ => Err(fault()),
        }
    }

    /// Returns the borders of the cells around the places, one more than there are places.
    fn borders(&self) -> Vec<f64> {
        let v = &self.values;
        let half = |a: f64, b: f64| f64::midpoint(a, b);
        let inner = v.windows(2).map(|pair| half(pair[0], pair[1]));
        let (n, first) = (v.len(), 2.0 * v[0] - half(v[0], v[1]));
        let last = 2.0 * v[n - 1] - half(v[n - 1], v[n - 2]);
        std::iter::once(first).chain(inner).chain([last]).collect()
    }

    /// Returns the place at a fraction of the steps, 0 at the first place.
    fn at(&self, step: f64) -> f64 {
        let last = self.values.len() - 1;
        let step = step.clamp(0.0, last as f64);
        let before = (step.floor() as usize).min(last.saturating_sub(1));
        let part = step - before as f64;
        self.values[before] * (1.0 - part) + self.values[(before + 1).min(last)] * part
    }
}

/// Draws a map of values over two axes with lines of equal value. `values` has the places of `x` row by row, as many rows as `y` has
/// places; `None` where there is no value. `unit` stands beside the scale of colours.
///
/// # Errors
/// Fails with a [`PlotError`] for an axis that does not rise or fall, or no number.
pub fn heat_map(
    title: &str,
    (x, y): (&PlotAxis, &PlotAxis),
    unit: &str,
    values: &[Option<f64>],
) -> Result<String, PlotError> {
    x.check()?;
    y.check()?;
    let range = room(values.iter().flatten().copied()).ok_or(PlotError::Nothing)?;
    let (low, high) =
        values.iter().flatten().fold((range.end, range.start), |(l, h), v| (l.min(*v), h.max(*v)));
    let range = if high > low { low..high } else { range };
    let levels = levels(&range);
    drawn(PLOT_SIZE, |root| {
        let (left, right) = root.split_horizontally(PLOT_SIZE.0 as i32 - SCALE_WIDTH);
        draw_map((&left, title), (x, y), values, (&range, &levels))?;
        draw_scale(&right, unit, &range, &levels)
    })
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn draw_map(
    (area, title): (&Area, &str),
    (x, y): (&PlotAxis, &PlotAxis),
    values: &[Option<f64>],
    (range, levels): (&Range<f64>, &[f64]),
) -> Result<(), PlotError> {
    let (across, up) = (x.borders(), y.borders());
    let ends = |borders: &[f64]| {
        let (a, b) = (borders[0], borders[borders.len() - 1]);
        a.min(b)..a.max(b)
    };
    let mut chart = ChartBuilder::on(area)
        .margin(24)
        .caption(title, ("sans-serif", 24))
        .x_label_area_size(52)
        .y_label_area_size(72)
        .build_cartesian_2d(ends(&across), ends(&up))
        .map_err(failed)?;
    chart
        .configure_mesh()
        .x_label_formatter(&number)
        .y_label_formatter(&number)
        .disable_mesh()
        .x_desc(&x.label)
        .y_desc(&y.label)
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 18))
        .draw()
        .map_err(failed)?;
    let (last_x, last_y) = (x.values.len(), y.values.len());
    let from = |k: usize, (i, j): (usize, usize)| [(across[k % last_x], up[k / last_x]), (across[i], up[j])];
    let cell = |k: usize| from(k, (k % last_x + 1, k / last_x + 1));
    // Each cell reaches to the far corner, and the next ones cover it, so that no background shows between cells.
    let filled = values.iter().enumerate().filter_map(|(k, value)| Some((k, (*value)?)));
    let filled =
        filled.map(|(k, value)| Rectangle::new(from(k, (last_x, last_y)), colour(value, range).filled()));
    chart.draw_series(filled).map_err(failed)?;
    for line in lines((x, y), values, levels) {
        chart.draw_series([PathElement::new(line, WHITE.stroke_width(1))]).map_err(failed)?;
    }
    // These cells hide the lines that the library drew where there is no value.
    let empty = values.iter().enumerate().filter(|(_, value)| value.is_none());
    chart.draw_series(empty.map(|(k, _)| Rectangle::new(cell(k), NOTHING.filled()))).map_err(failed)?;
    Ok(())
}

fn draw_scale(area: &Area, unit: &str, range: &Range<f64>, levels: &[f64]) -> Result<(), PlotError> {
    const STEPS: u32 = 128;
    let mut chart = ChartBuilder::on(area)
        .margin(24)
        .margin_top(58)
        .margin_right(12)
        .x_label_area_size(52)
        .y_label_area_size(66)
        .build_cartesian_2d(0.0..1.0, range.clone())
        .map_err(failed)?;
    chart
        .configure_mesh()
        .y_label_formatter(&number)
        .disable_mesh()
        .disable_x_axis()
        .y_desc(unit)
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 18))
        .draw()
        .map_err(failed)?;
    let at = |step: u32| range.start + (range.end - range.start) * f64::from(step) / f64::from(STEPS);
    let steps = (0..STEPS).map(|k| {
        let middle = f64::midpoint(at(k), at(k + 1));
        Rectangle::new([(0.0, at(k)), (1.0, range.end)], colour(middle, range).filled())
    });
    chart.draw_series(steps).map_err(failed)?;
    let lines =
        levels.iter().map(|&level| PathElement::new([(0.0, level), (1.0, level)], WHITE.stroke_width(1)));
    chart.draw_series(lines).map_err(failed)?;
    Ok(())
}

fn drawn(size: (u32, u32), draw: impl FnOnce(&Area) -> Result<(), PlotError>) -> Result<String, PlotError> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        draw(&root)?;
        root.present().map_err(failed)?;
    }
    Ok(text)
}

/// Formats a number beside an axis. It is rounded, because ticks are sums of steps.
fn number(value: &f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6 + 0.0)
}

fn failed(error: impl std::fmt::Display) -> PlotError {
    PlotError::Drawing { reason: error.to_string() }
}

/// Returns a range that holds all these numbers with some room around them; `None` where there are none.
fn room(numbers: impl Iterator<Item = f64>) -> Option<Range<f64>> {
    let finite = numbers.filter(|number| number.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let margin = if high > low { 0.04 * (high - low) } else { 0.5_f64.max(0.01 * low.abs()) };
    (low <= high).then_some(low - margin..high + margin)
}

/// Returns about eight round numbers within a range.
pub fn levels(range: &Range<f64>) -> Vec<f64> {
    let rough = (range.end - range.start) / LINES;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * power).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(rough);
    let first = (range.start / step).ceil();
    let count = (((range.end / step).floor() - first).max(-1.0) + 1.0).min(100.0) as usize;
    (0..count).map(|k| (first + k as f64) * step).collect()
}

fn colour(value: f64, range: &Range<f64>) -> RGBColor {
    ViridisRGB.get_color_normalized(value as f32, range.start as f32, range.end as f32)
}

/// Returns the colour of a value on the scale of maps, as sRGB codes; values beyond the range have the colour of its end.
pub fn map_colour(value: f64, range: &Range<f64>) -> [u8; 3] {
    let RGBColor(red, green, blue) = colour(value, range);
    [red, green, blue]
}

/// Returns the lines of equal value between the places, whose values are as in [`heat_map`]. Where places have no
/// value, the lines have no meaning.
pub fn lines((x, y): (&PlotAxis, &PlotAxis), values: &[Option<f64>], levels: &[f64]) -> Vec<Vec<(f64, f64)>> {
    // A place without a value takes that of the place before it, so that lines end near it.
    let mut last = values.iter().flatten().copied().next().unwrap_or(0.0);
    let full: Vec<f64> = values
        .iter()
        .map(|value| {
            last = value.unwrap_or(last);
            last
        })
        .collect();
    let found = ContourBuilder::new(x.values.len(), y.values.len(), true).lines(&full, levels);
    let found = found.unwrap_or_default();
    // The library puts the first place at 0.5, and runs lines around the border at 0 and at the number of places.
    let [most_x, most_y] = [x, y].map(|axis| axis.values.len() as f64 - 1.0);
    let within = |at: f64, most: f64| (-1e-9..=most + 1e-9).contains(&at);
    let is_inside = |p: &(f64, f64)| within(p.0, most_x) && within(p.1, most_y);
    let mut all = vec![];
    for line in found.iter().flat_map(|line| line.geometry().0.iter()) {
        let points: Vec<(f64, f64)> = line.0.iter().map(|c| (c.x - 0.5, c.y - 0.5)).collect();
        let parts = points.split(|p| !is_inside(p)).filter(|part| part.len() > 1);
        all.extend(parts.map(|part| part.iter().map(|p| (x.at(p.0), y.at(p.1))).collect()));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(label: &str, values: &[f64]) -> PlotAxis {
        PlotAxis { label: label.into(), values: values.into() }
    }

    #[test]
    fn lines_of_equal_value_lie_where_a_plane_has_the_value() {
        let (x, y) = (axis("x", &[0.0, 1.0, 3.0, 4.0]), axis("y", &[10.0, 8.0, 5.0]));
        let plane = |x: f64, y: f64| 2.0 * x + y;
        let values: Vec<Option<f64>> =
            y.values.iter().flat_map(|&y| x.values.iter().map(move |&x| Some(plane(x, y)))).collect();
        let found = lines((&x, &y), &values, &[9.0, 12.0]);
        assert!(found.len() >= 2, "{found:?}");
        for (x, y) in found.iter().flatten() {
            let value = plane(*x, *y);
            assert!((value - 9.0).abs() < 1e-6 || (value - 12.0).abs() < 1e-6, "{value} at {x}, {y}");
        }
        let ends =
            found.iter().flatten().fold([f64::INFINITY, 0.0_f64], |[l, h], p| [l.min(p.0), h.max(p.0)]);
        assert!(ends[0] < 1e-6 && ends[1] > 3.4, "the lines run to the borders: {ends:?}");
    }

    #[test]
    fn levels_are_round_numbers_within_the_range() {
        for (range, first, step) in
            [(0.0..1.0, 0.0, 0.2), (43.2..71.0, 45.0, 5.0), (-0.003..0.004, -0.003, 0.001)]
        {
            let found = levels(&range);
            assert!((3..=12).contains(&found.len()), "{found:?}");
            assert!(
                (found[0] - first).abs() < 1e-12 && (found[1] - found[0] - step).abs() < 1e-12,
                "{found:?}"
            );
            assert!(found.iter().all(|level| *level >= range.start - 1e-12 && *level <= range.end + 1e-12));
        }
    }

    #[test]
    fn places_without_a_value_are_grey() {
        let (x, y) = (axis("a < b", &[1.0, 2.0]), axis("y", &[3.0, 4.0]));
        let drawn = heat_map("t", (&x, &y), "%", &[Some(1.0), None, Some(2.0), Some(3.0)]).unwrap();
        assert!(drawn.contains("#E1E1E1") && drawn.contains("a &lt; b"), "{drawn}");
        let even = heat_map("t", (&x, &y), "%", &[Some(1.0); 4]).unwrap();
        assert!(!even.contains("#E1E1E1"));
        assert_eq!(heat_map("t", (&x, &y), "%", &[None; 4]), Err(PlotError::Nothing));
        let bad = axis("x", &[1.0, 1.0]);
        assert_eq!(
            heat_map("t", (&bad, &y), "%", &[Some(1.0); 4]),
            Err(PlotError::Axis { label: "x".into() })
        );
    }
}
