//! Polygons of a picture by exact beams.

use crate::picture::strips::strips;
use crate::scene::Medium;
use crate::trace::beam::Beam;
use glam::{DAffine2, DVec2, DVec4};

/// Where absorption changes a beam's light by more than this part across its outline, the beam is painted in strips.
/// This may be coarse: one beam is a part of a part of what a pixel shows, and a strip's mean is exact.
pub(super) const UNEVEN: f64 = 1.0 / 16.0;

/// Polygons in pixel coordinates, each of one colour.
#[derive(Default)]
pub(super) struct Patches {
    pub corners: Vec<DVec2>,
    /// For each polygon its first corner, the one after its last, and its colour and cover.
    pub patches: Vec<(u32, u32, DVec4)>,
}

impl Patches {
    /// Adds a beam in a colour, which its absorption has not changed yet.
    pub fn add(&mut self, beam: &Beam, medium: &Medium, pixels: &DAffine2, colour: DVec4) {
        if colour == DVec4::ZERO {
            return;
        }
        if beam.is_surface() {
            return self.put(beam.outline, pixels, colour);
        }
        strips(beam.outline, beam.path, medium, UNEVEN, |part, left| {
            self.put(part, pixels, colour * DVec4::new(left, left, left, 1.0));
        });
    }

    /// Adds a polygon of the body's image, which `pixels` maps to pixels.
    pub fn put(&mut self, polygon: &[DVec2], pixels: &DAffine2, colour: DVec4) {
        let start = self.corners.len() as u32;
        self.corners.extend(polygon.iter().map(|&p| pixels.transform_point2(p)));
        self.patches.push((start, self.corners.len() as u32, colour));
    }
}
