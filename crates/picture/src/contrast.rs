//! The colours of contrast maps: blue where a square is darker than the face in the mean, grey where it is as bright, and gold
//! where it is brighter. Brighter squares have lighter colours, so that the map reads as the stone does.

use super::raster::Rows;
use brillianteer_optics::{LinearRgb, SrgbEncoder, linear_from_encoded};

/// The colours of some contrasts, sRGB; those between are mixed in the sRGB code, in which steps look about equal.
const STOPS: [(f64, [u8; 3]); 5] = [
    (-1.0, [14, 26, 96]),
    (-0.5, [58, 98, 172]),
    (0.0, [150, 150, 150]),
    (0.5, [236, 178, 72]),
    (1.0, [255, 248, 214]),
];

/// Returns the colour of a contrast, as an sRGB code of each channel with fractions. Contrasts beyond the ends of the scale have
/// the colours of its ends.
fn code(contrast: f64) -> [f64; 3] {
    let at = contrast.clamp(STOPS[0].0, STOPS[STOPS.len() - 1].0);
    let upper = STOPS.iter().position(|stop| at <= stop.0).unwrap_or(0).max(1);
    let [(from, low), (to, high)] = [STOPS[upper - 1], STOPS[upper]];
    let part = (at - from) / (to - from);
    std::array::from_fn(|c| f64::from(low[c]) + part * (f64::from(high[c]) - f64::from(low[c])))
}

/// Returns the colour of a contrast, sRGB.
pub(super) fn contrast_colour(contrast: f64) -> [u8; 3] {
    code(contrast).map(|c| c.round() as u8)
}

/// Returns what the colours of contrast maps mean, from the brightest, in few letters: a view has room for a line of them.
pub fn contrast_legend() -> Vec<(String, [u8; 3])> {
    let text = |contrast: f64| match contrast {
        -1.0 => "dark".to_owned(),
        -0.5 => "−50 %".to_owned(),
        0.0 => "as the face".to_owned(),
        0.5 => "+50 %".to_owned(),
        _ => "+100 % or more".to_owned(),
    };
    STOPS.iter().rev().map(|&(contrast, colour)| (text(contrast), colour)).collect()
}

/// Appends the encoded pixels of row `y` of a contrast map to `out`, as red, green and blue.
///
/// The first channel is the contrast times the cover, the last channel is the cover. Where the stone does not cover a pixel,
/// black shows.
pub fn encode_contrast(rows: &Rows, encoder: &SrgbEncoder, y: u32, out: &mut Vec<u8>) {
    let cover = rows.row(y, rows.channels - 1);
    for (value, &covered) in rows.row(y, 0).iter().zip(cover) {
        let contrast = if covered > 0.0 { value / covered } else { 0.0 };
        let linear = code(contrast).map(|c| linear_from_encoded(c / 255.0));
        out.extend(encoder.encode_rgb(LinearRgb::from_array(linear) * covered.clamp(0.0, 1.0)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    #[test]
    fn brighter_squares_have_lighter_colours() {
        let lightness = |contrast: f64| code(contrast).iter().map(|c| c * c).sum::<f64>();
        let steps: Vec<f64> = (0..=40).map(|k| lightness(f64::from(k) / 20.0 - 1.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
        assert_eq!((contrast_colour(-7.0), contrast_colour(7.0)), (STOPS[0].1, STOPS[4].1));
        let legend = contrast_legend();
        assert_eq!(legend.len(), STOPS.len());
        assert!(legend.iter().any(|(text, colour)| text == "as the face" && *colour == contrast_colour(0.0)));
    }

    #[test]
    fn a_pixel_that_is_covered_in_part_has_the_contrast_of_its_covered_part() {
        let mut rows = Rows::new(0, 1, 2, 2);
        for (width, channel, weight) in [(1.5, 0, 0.5), (1.5, 1, 1.0)] {
            rows.add(
                &[(0.0, 0.0), (width, 0.0), (width, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y)),
                channel,
                weight,
            );
        }
        let mut out = vec![];
        encode_contrast(&rows.summed(), &SrgbEncoder::new(), 0, &mut out);
        assert_eq!(out[..3], STOPS[3].1);
        let half = STOPS[3].1.map(|c| linear_from_encoded(f64::from(c) / 255.0) / 2.0);
        assert_eq!(out[3..], SrgbEncoder::new().encode_rgb(LinearRgb::from_array(half)));
    }
}
