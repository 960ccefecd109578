//! The view of an eye through an exit: the head, the dome or the space below, its brightness, and the colours that
//! the eye tells apart.

use brillianteer_scene::elevation_deg;
use brillianteer_trace::beam::{Beam, Beams};

/// The part of the surroundings that the eye sees through an exit.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum ExitSight {
    Below,
    Head,
    Dome,
}

impl ExitSight {
    pub fn of(beam: &Beam, beams: &Beams, head_deg: f64) -> Self {
        let elevation = elevation_deg(beam.exit, beams.zenith);
        match elevation {
            below if below < 0.0 => Self::Below,
            above if head_deg > 0.0 && above >= 90.0 - head_deg => Self::Head,
            _ => Self::Dome,
        }
    }
}

/// Returns the brightness through each beam under an even dome with a head, without glare: the light of all exits up to the
/// beam's end.
pub(super) fn brightness(beams: &Beams, head_deg: f64) -> Vec<f64> {
    let mut bright: Vec<f64> = Vec::with_capacity(beams.len());
    for beam in beams.iter() {
        let before = beam.parent.map_or(0.0, |parent| bright[parent as usize]);
        bright.push(before + if shines(&beam, beams, head_deg) { beam.weight } else { 0.0 });
    }
    bright
}

/// Returns whether a beam's exit counts for the brightness: its light has been inside and comes from the dome beside
/// the head.
pub(super) fn shines(beam: &Beam, beams: &Beams, head_deg: f64) -> bool {
    !beam.is_surface() && beam.weight > 0.0 && ExitSight::of(beam, beams, head_deg) == ExitSight::Dome
}

/// Returns the part of a fan's colours that an eye tells apart, 0 to 1; `fan` is in radians.
pub(super) fn seen_apart(fan: f64, blur_deg: f64) -> f64 {
    let blur = blur_deg.to_radians();
    if fan > blur { 1.0 - blur / fan } else { 0.0 }
}
