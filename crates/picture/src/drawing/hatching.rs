//! Hatching, which distinguishes frosted facets from polished ones in drawings.

use glam::DVec2;

/// The remark on hatching under drawings.
pub(crate) const LEGEND: &str = "Hatched facets are frosted.";

/// The distance between two lines of the hatching.
const STEP: f64 = 5.5;

/// Returns lines that rise to the right across a convex outline. They are parts of lines that are spread evenly over the whole
/// sheet, so that the hatching of neighbours is one.
pub(super) fn hatched(outline: &[DVec2]) -> Vec<(DVec2, DVec2)> {
    // Returns the coordinate of a point across the lines, in steps; y points down.
    let across = |p: DVec2| (p.x + p.y) * std::f64::consts::FRAC_1_SQRT_2 / STEP;
    let (low, high) = outline
        .iter()
        .map(|&p| across(p))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    if !(low.is_finite() && high.is_finite()) {
        return vec![];
    }
    let line = |k: i64| {
        let sides = outline.iter().zip(outline.iter().cycle().skip(1));
        let mut ends = sides.filter_map(|(&a, &b)| {
            let [from, to] = [a, b].map(|p| across(p) - k as f64);
            ((from < 0.0) != (to < 0.0)).then(|| a + (b - a) * (from / (from - to)))
        });
        Some((ends.next()?, ends.next()?))
    };
    (low.ceil() as i64..=high.floor() as i64).filter_map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hatching_fills_an_outline_evenly_and_stays_within() {
        let square = [[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]].map(DVec2::from_array);
        let lines = hatched(&square);
        let length: f64 = lines.iter().map(|(a, b)| a.distance(*b)).sum();
        // Lines at this distance cover an area of their length times the distance.
        assert!((length * STEP / 1600.0 - 1.0).abs() < 0.05, "{length}");
        let is_within = |p: &DVec2| p.min_element() > -1e-9 && p.max_element() < 40.0 + 1e-9;
        assert!(lines.iter().all(|(a, b)| is_within(a) && is_within(b)));
        assert!(
            lines.iter().all(|(a, b)| ((b.x - a.x) + (b.y - a.y)).abs() < 1e-9),
            "they rise to the right"
        );
        assert_eq!(hatched(&[]), []);
    }
}
