//! Divides a beam's outline, over which absorption makes light uneven, into strips of even light.

use brillianteer_math::{Affine, area, clip, integral_of_decay};
use brillianteer_scene::Medium;
use glam::DVec2;

/// Depth beyond the brightest point at which a beam is as good as black, so that one strip is enough there.
const DARK: f64 = 12.0;

/// Calls `even` with the parts of an outline, each with the mean of the light that absorption leaves there after a path.
///
/// Within a part the light changes by no more than the part `uneven` of itself. If a medium absorbs the two
/// polarisations differently, the parts of one come after those of the other, each with half the light.
pub(super) fn strips(
    outline: &[DVec2],
    path: Affine,
    medium: &Medium,
    uneven: f64,
    mut even: impl FnMut(&[DVec2], f64),
) {
    match medium.absorption {
        [0.0, 0.0] => even(outline, 1.0),
        [o, e] if o == e => faded(outline, path * o, uneven, even),
        both => {
            both.iter().for_each(|&a| faded(outline, path * a, uneven, |part, left| even(part, 0.5 * left)))
        }
    }
}

/// Calls `even` as [`strips`] does, for light that falls as exp(-depth).
fn faded(outline: &[DVec2], depth: Affine, uneven: f64, mut even: impl FnMut(&[DVec2], f64)) {
    let depths = || outline.iter().map(|&p| depth.at(p));
    let (low, high) = (depths().fold(f64::INFINITY, f64::min), depths().fold(0.0, f64::max));
    let deepest = high.min(low + DARK);
    let strips = ((deepest - low) / uneven).ceil() as u32;
    let mut lay = |part: &[DVec2]| {
        let size = area(part);
        if size > 0.0 {
            even(part, integral_of_decay(part, depth) / size);
        }
    };
    let (mut rest, mut strip, mut spare) = (outline.to_vec(), vec![], vec![]);
    for k in 1..strips {
        let border = low + (deepest - low) * f64::from(k) / f64::from(strips);
        let above = depth - Affine::new(border, DVec2::ZERO);
        clip(&rest, above * -1.0, &mut strip);
        clip(&rest, above, &mut spare);
        std::mem::swap(&mut rest, &mut spare);
        lay(&strip);
    }
    lay(&rest);
}
