//! Derivatives of measures of the face: its dark part, and the unevenness of its brightness.

use super::super::exit_sight::{ExitSight, brightness, shines};
use super::{BeamSum, divide_by_silhouette, share};
use brillianteer_trace::beam::{Beam, BeamPartials, Beams};

/// Sums the area whose strongest exit meets the head or comes from below.
pub(super) fn extinction(beams: &Beams, head_deg: f64) -> BeamSum {
    let share = share(beams);
    let mut sum = BeamSum { value: 0.0, partials: BeamPartials::none(beams.len()), per_fan: vec![] };
    let is_dark = |beam: &Beam| ExitSight::of(beam, beams, head_deg) != ExitSight::Dome;
    for cell in beams.strongest_exits().iter().filter(|cell| !cell.undecided) {
        if cell.strongest.is_some_and(|exit| is_dark(&beams.get(exit))) {
            sum.value += beams.get(cell.outline).area * share;
            sum.partials.area[cell.outline as usize] = share;
        }
    }
    divide_by_silhouette(&mut sum.partials, beams, sum.value);
    sum
}

/// Returns the contrast of the light that was followed: σ / m, with m = Σ a b the mean brightness of the finest parts of the face
/// and σ² = Σ a b² - m², a the area of each and b its brightness.
pub(super) fn contrast(beams: &Beams, head_deg: f64) -> BeamSum {
    let share = share(beams);
    let bright = brightness(beams, head_deg);
    let leaves: Vec<u32> = beams.leaves().collect();
    let (mut mean, mut square) = (0.0, 0.0);
    for &id in &leaves {
        let (area, bright) = (beams.get(id).area * share, bright[id as usize]);
        mean += area * bright;
        square += area * bright * bright;
    }
    let deviation = (square - mean * mean).max(0.0).sqrt();
    let mut partials = BeamPartials::none(beams.len());
    let value = if mean > 0.0 { deviation / mean } else { 0.0 };
    if deviation > 0.0 && mean > 0.0 {
        let per_square = 0.5 / (mean * deviation);
        let per_mean = -1.0 / deviation - deviation / (mean * mean);
        // The derivative by the brightness through each beam, summed over all its parts.
        let mut per_bright = vec![0.0; beams.len()];
        let mut parts = 0.0;
        for &id in &leaves {
            let (area, bright) = (beams.get(id).area * share, bright[id as usize]);
            let per_area = bright * (bright * per_square + per_mean);
            partials.area[id as usize] += per_area * share;
            parts += per_area * area;
            per_bright[id as usize] += area * (2.0 * bright * per_square + per_mean);
        }
        for id in (0..beams.len() as u32).rev() {
            let (beam, per) = (beams.get(id), per_bright[id as usize]);
            if shines(&beam, beams, head_deg) {
                // The exit's weight is its energy divided by the area.
                partials.energy[id as usize] += per / beam.area;
                partials.area[id as usize] -= per * beam.weight / beam.area;
            }
            if let Some(parent) = beam.parent {
                per_bright[parent as usize] += per;
            }
        }
        divide_by_silhouette(&mut partials, beams, parts);
    }
    BeamSum { value, partials, per_fan: vec![] }
}
