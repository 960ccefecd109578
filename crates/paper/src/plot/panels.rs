//! Families of curves: one panel for each measure, and in each one curve for each member of the family.

use super::curves::{draw_curves, draw_key, numbers};
use super::{PLOT_SIZE, PlotAxis, PlotCurve, PlotError, drawn, failed, room};
use plotters::prelude::*;

/// One panel of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotPanel {
    /// The name above it.
    pub name: String,
    /// Its curves, in the same order and with the same names in all panels of a plot.
    pub curves: Vec<PlotCurve>,
}

/// The size of one of several panels, in units of the drawing.
const PANEL: (u32, u32) = (460, 320);

/// The size of the name above a panel.
const NAME: u32 = 18;

/// The width of the key beside panels, and the height of the title above them.
const MARGIN: (u32, u32) = (190, 56);

/// Draws panels over one axis. Curves with the same place in their panels have one colour, and one key names them under `family`.
/// `unit` stands beside the values.
///
/// # Errors
/// Fails with a [`PlotError`] for an axis that does not rise or fall, or a panel without a number.
pub fn panels(
    title: &str,
    axis: &PlotAxis,
    (unit, family): (&str, &str),
    panels: &[PlotPanel],
) -> Result<String, PlotError> {
    axis.check()?;
    let first = panels.first().ok_or(PlotError::Nothing)?;
    let columns = match panels.len() {
        1 => 1,
        2..=4 => 2,
        _ => 3,
    };
    let rows = panels.len().div_ceil(columns);
    let size = match panels.len() {
        1 => PLOT_SIZE,
        _ => (columns as u32 * PANEL.0 + MARGIN.0, rows as u32 * PANEL.1 + MARGIN.1),
    };
    for panel in panels {
        room(numbers(&panel.curves)).ok_or(PlotError::Nothing)?;
    }
    drawn(size, |root| {
        let (head, body) = root.split_vertically(MARGIN.1);
        let caption = TextStyle::from(("sans-serif", 24).into_font());
        head.draw(&Text::new(title.to_owned(), (24, 18), caption)).map_err(failed)?;
        let (left, right) = body.split_horizontally(size.0 - MARGIN.0);
        let heading = TextStyle::from(("sans-serif", 16).into_font());
        right.draw(&Text::new(family.to_owned(), (16, 8), heading)).map_err(failed)?;
        draw_key(&right, 44, &first.curves)?;
        for (area, panel) in left.split_evenly((rows, columns)).iter().zip(panels) {
            draw_curves(area, (&panel.name, NAME), (axis, None), unit, &panel.curves)?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_share_one_key_and_a_curve_has_one_colour_in_all() {
        let axis = PlotAxis { label: "tilt".into(), values: vec![-1.0, 0.0, 1.0] };
        let curve =
            |name: &str, at: f64| PlotCurve { name: name.into(), bands: vec![Some([at, at + 0.5]); 3] };
        let panel =
            |name: &str| PlotPanel { name: name.into(), curves: vec![curve("0°", 1.0), curve("45°", 2.0)] };
        let all = ["leakage", "fire", "contrast"].map(panel);
        let drawn = panels("stone", &axis, ("%", "azimuth"), &all).unwrap();
        for text in ["leakage", "fire", "contrast", "azimuth", "stone"] {
            assert!(drawn.contains(text), "{text}");
        }
        assert_eq!(drawn.matches("45°").count(), 1);
        // A band and a middle for each curve in each panel, and a line in the key.
        assert_eq!(drawn.matches("<polygon").count(), 6);
        assert_eq!(drawn.matches("#D55E00").count(), 4);
        let empty = PlotPanel { name: "none".into(), curves: vec![] };
        assert_eq!(panels("t", &axis, ("%", "azimuth"), &[empty]), Err(PlotError::Nothing));
        assert_eq!(panels("t", &axis, ("%", "azimuth"), &[]), Err(PlotError::Nothing));
    }
}
