//! The lines of equal value on a map of a measure. They are computed once for the answered points, and not in each
//! frame.

use brillianteer_measure::MeasureName;
use brillianteer_paper::plot::{PlotAxis, levels, lines};
use egui::{Context, Id};
use std::ops::Range;
use std::sync::Arc;

/// The data that lines are computed from, by which stored lines are found again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapLinesOf {
    /// The number of the sweep.
    pub number: u64,
    /// The number of its points that have been answered.
    pub answered: usize,
    /// The measure.
    pub measure: MeasureName,
}

/// Lines, whose corners are parts of the way across and up, 0 to 1.
type MapLines = Arc<Vec<Vec<[f64; 2]>>>;

/// Returns the lines of a map. `values` gives the values of a square grid, row by row from below, with their range,
/// or `None` where one of them is missing; it is called only where `of` differs from that of the last call.
pub fn map_lines(
    ctx: &Context,
    of: MapLinesOf,
    values: impl FnOnce() -> Option<(Vec<f64>, Range<f64>)>,
) -> MapLines {
    let id = Id::unique("lines of a map");
    let known = ctx.data(|data| data.get_temp::<(MapLinesOf, MapLines)>(id));
    if let Some((_, lines)) = known.filter(|(before, _)| *before == of) {
        return lines;
    }
    let found: MapLines =
        Arc::new(values().map_or_else(Vec::new, |(values, range)| of_grid(&values, &range)));
    ctx.data_mut(|data| data.insert_temp(id, (of, Arc::clone(&found))));
    found
}

/// Returns the lines between the values of a square grid.
fn of_grid(values: &[f64], range: &Range<f64>) -> Vec<Vec<[f64; 2]>> {
    let side = values.len().isqrt();
    let parts = (0..side).map(|place| place as f64 / (side.max(2) - 1) as f64).collect();
    let axis = PlotAxis { label: String::new(), values: parts };
    let values: Vec<Option<f64>> = values.iter().copied().map(Some).collect();
    let found = lines((&axis, &axis), &values, &levels(range));
    found.into_iter().map(|line| line.into_iter().map(|(x, y)| [x, y]).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lie_where_a_slope_has_their_value_and_are_found_once() {
        let (ctx, side) = (Context::default(), 5);
        let slope: Vec<f64> = (0..side * side).map(|k| (k % side) as f64 / 4.0).collect();
        let of = MapLinesOf { number: 1, answered: 25, measure: MeasureName::Fire };
        let found = map_lines(&ctx, of, || Some((slope.clone(), 0.0..1.0)));
        assert!(!found.is_empty());
        for [x, y] in found.iter().flatten() {
            let step = 5.0 * x;
            assert!((step - step.round()).abs() < 1e-6 && (-1e-9..=1.0 + 1e-9).contains(y), "{x} {y}");
        }
        let again = map_lines(&ctx, of, || panic!("they are known"));
        assert_eq!(again, found);
        let other = MapLinesOf { measure: MeasureName::Leakage, ..of };
        assert!(map_lines(&ctx, other, || None).is_empty());
    }
}
