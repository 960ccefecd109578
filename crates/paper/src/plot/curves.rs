//! Curves over one axis, each with the band in which its values lie.

use super::{Area, PlotAxis, PlotError, drawn, failed, number, room};
use plotters::prelude::*;

/// The width of the key of curves.
const KEY_WIDTH: i32 = 240;

/// The number of colours of curves; further curves repeat them.
pub const COLOURS_OF_CURVES: usize = 7;

/// The colours of curves, which people who see no red or no green can tell apart (B. Wong, Nature Methods 8, 441
/// (2011)).
const COLOURS: [RGBColor; COLOURS_OF_CURVES] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(0, 0, 0),
];

/// The colour of the line at a marked place.
const MARK: RGBColor = RGBColor(60, 60, 60);

/// A curve, drawn as a band from its least to its greatest values.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotCurve {
    /// The name of the curve in the key.
    pub name: String,
    /// The least and the greatest value at each place of the axis; `None` where there is none.
    pub bands: Vec<Option<[f64; 2]>>,
}

/// Draws curves over one axis, on a plot of this size in units of its drawing. `unit` stands beside their values; an empty title
/// takes no room.
///
/// # Errors
/// Fails with a [`PlotError`] for an axis that does not rise or fall, or no number.
pub fn curves(
    title: (&str, (u32, u32)),
    axis: &PlotAxis,
    unit: &str,
    curves: &[PlotCurve],
) -> Result<String, PlotError> {
    marked_curves(title, (axis, None), unit, curves)
}

/// Draws curves as [`curves`] does, with a line up the chart at a place of the axis.
///
/// # Errors
/// Those of [`curves`].
pub fn marked_curves(
    (title, size): (&str, (u32, u32)),
    (axis, mark): (&PlotAxis, Option<f64>),
    unit: &str,
    curves: &[PlotCurve],
) -> Result<String, PlotError> {
    axis.check()?;
    room(numbers(curves)).ok_or(PlotError::Nothing)?;
    drawn(size, |root| {
        let (left, right) = root.split_horizontally(size.0 as i32 - KEY_WIDTH);
        draw_key(&right, if title.is_empty() { 40 } else { 90 }, curves)?;
        draw_curves(&left, (title, 24), (axis, mark), unit, curves)
    })
}

/// Returns all numbers of curves.
pub(super) fn numbers(curves: &[PlotCurve]) -> impl Iterator<Item = f64> {
    curves.iter().flat_map(|curve| curve.bands.iter().flatten().flatten().copied())
}

/// Draws a chart of curves, with a title of this size above it, and a line at a marked place of the axis.
pub(super) fn draw_curves(
    area: &Area,
    (title, size): (&str, u32),
    (axis, mark): (&PlotAxis, Option<f64>),
    unit: &str,
    curves: &[PlotCurve],
) -> Result<(), PlotError> {
    let (across, up) = (axis.ends()?, room(numbers(curves)).ok_or(PlotError::Nothing)?);
    let mut builder = ChartBuilder::on(area);
    if !title.is_empty() {
        builder.caption(title, ("sans-serif", size));
    }
    let mut chart = builder
        .margin(24)
        .margin_right(0)
        .x_label_area_size(52)
        .y_label_area_size(72)
        .build_cartesian_2d(across, up.clone())
        .map_err(failed)?;
    chart
        .configure_mesh()
        .x_label_formatter(&number)
        .y_label_formatter(&number)
        .max_light_lines(0)
        .bold_line_style(RGBColor(215, 215, 215))
        .x_desc(&axis.label)
        .y_desc(unit)
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 18))
        .draw()
        .map_err(failed)?;
    let parts: Vec<_> =
        curves.iter().zip(COLOURS.iter().cycle()).flat_map(|(c, of)| c.parts(axis, of)).collect();
    let bands = parts.iter().map(|(part, colour)| {
        let back = part.iter().rev().map(|&(x, [_, most])| (x, most));
        Polygon::new(
            part.iter().map(|&(x, [least, _])| (x, least)).chain(back).collect::<Vec<_>>(),
            paler(**colour, 4),
        )
    });
    chart.draw_series(bands).map_err(failed)?;
    // Bands hide those below them, so their borders are drawn above all.
    let borders = parts.iter().flat_map(|(part, colour)| {
        let border = |end: usize| {
            let points = part.iter().map(|&(x, band)| (x, band[end]));
            PathElement::new(points.collect::<Vec<_>>(), paler(**colour, 2).stroke_width(1))
        };
        [border(0), border(1)]
    });
    chart.draw_series(borders).map_err(failed)?;
    let middles = parts.iter().map(|(part, colour)| {
        let points = part.iter().map(|&(x, [least, most])| (x, f64::midpoint(least, most)));
        PathElement::new(points.collect::<Vec<_>>(), colour.stroke_width(2))
    });
    chart.draw_series(middles).map_err(failed)?;
    let line = mark.map(|at| PathElement::new([(at, up.start), (at, up.end)], MARK.stroke_width(2)));
    chart.draw_series(line).map_err(failed)?;
    Ok(())
}

/// A place of an axis, with the least and the greatest value there.
type BandPoint = (f64, [f64; 2]);

impl PlotCurve {
    /// Returns the parts into which places without a value divide the curve.
    fn parts<'a>(&self, axis: &PlotAxis, colour: &'a RGBColor) -> Vec<(Vec<BandPoint>, &'a RGBColor)> {
        let points: Vec<_> = axis.values.iter().copied().zip(self.bands.iter().copied()).collect();
        let parts = points.split(|(_, band)| band.is_none()).filter(|part| !part.is_empty());
        let known = |point: &(f64, Option<[f64; 2]>)| Some((point.0, point.1?));
        parts.map(|part| (part.iter().filter_map(known).collect(), colour)).collect()
    }
}

/// Draws the key, with the colour and name of each curve, from this height down.
pub(super) fn draw_key(area: &Area, top: i32, curves: &[PlotCurve]) -> Result<(), PlotError> {
    for (row, (curve, colour)) in (0..).zip(curves.iter().zip(COLOURS.iter().cycle())) {
        let y = top + 28 * row;
        area.draw(&PathElement::new([(16, y), (44, y)], colour.stroke_width(3))).map_err(failed)?;
        area.draw(&Text::new(curve.name.clone(), (52, y - 7), ("sans-serif", 16))).map_err(failed)?;
    }
    Ok(())
}

/// Returns a part of a colour on white: its half by 2, its quarter by 4. Drawings have no transparency, so that they can be written as
/// PDF.
fn paler(colour: RGBColor, by: u8) -> RGBColor {
    let part = |value: u8| 255 - (255 - value) / by;
    RGBColor(part(colour.0), part(colour.1), part(colour.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_is_one_more_line_whose_place_follows_the_axis() {
        let x = PlotAxis { label: "x".into(), values: vec![-30.0, 0.0, 30.0] };
        let all = [PlotCurve { name: "a".into(), bands: vec![Some([1.0, 2.0]); 3] }];
        let of = |mark| marked_curves(("t", (800, 400)), (&x, mark), "%", &all).unwrap();
        assert_eq!(of(None), curves(("t", (800, 400)), &x, "%", &all).unwrap());
        // Nothing else in the drawing has the line's colour.
        let places = [-30.0, 0.0, 30.0].map(|at| {
            let text = of(Some(at));
            let line = text.lines().find(|line| line.contains("#3C3C3C")).unwrap();
            let points = line.split("points=\"").nth(1).unwrap();
            points.split([',', ' ']).next().unwrap().parse::<f64>().unwrap()
        });
        assert!((places[1] - (places[0] + places[2]) / 2.0).abs() <= 1.0, "{places:?}");
        assert!(places[0] + 100.0 < places[2] && !of(None).contains("#3C3C3C"));
    }

    #[test]
    fn a_curve_has_a_gap_where_it_has_no_value() {
        let x = PlotAxis { label: "x".into(), values: vec![1.0, 2.0, 3.0, 4.0, 5.0] };
        let of = |gap: Option<usize>| {
            let bands = (0..5).map(|k| (Some(k) != gap).then_some([k as f64, k as f64 + 0.5])).collect();
            curves(("t", super::super::PLOT_SIZE), &x, "%", &[PlotCurve { name: "fire".into(), bands }])
                .unwrap()
        };
        let parts = |text: &str| text.matches("<polygon").count();
        assert_eq!(parts(&of(Some(2))), parts(&of(None)) + 1);
        assert!(of(None).contains("fire"));
        assert_eq!(curves(("t", super::super::PLOT_SIZE), &x, "%", &[]), Err(PlotError::Nothing));
    }
}
