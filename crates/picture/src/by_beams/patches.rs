//! The polygons from which exact beams paint a picture.

use crate::strips::strips;
use brillianteer_scene::Medium;
use brillianteer_trace::beam::Beam;
use glam::{DAffine2, DVec2, DVec4};

/// Where absorption changes a beam's light by more than this part across its outline, the beam is painted in strips.
/// The number may be large, because each beam gives only a small part of a pixel's light, and the mean of a strip is
/// exact.
pub(super) const UNEVEN: f64 = 1.0 / 16.0;

/// Polygons in pixel coordinates, each of one colour.
#[derive(Default)]
pub(super) struct Patches {
    pub corners: Vec<DVec2>,
    /// For each polygon, the index of its first corner, that after its last corner, and its colour and cover.
    pub patches: Vec<(u32, u32, DVec4)>,
}

impl Patches {
    /// Adds a beam in a colour that does not include absorption.
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

    /// Adds a polygon of the body's image; `pixels` maps it to pixels.
    pub fn put(&mut self, polygon: &[DVec2], pixels: &DAffine2, colour: DVec4) {
        let start = self.corners.len() as u32;
        self.corners.extend(polygon.iter().map(|&p| pixels.transform_point2(p)));
        self.patches.push((start, self.corners.len() as u32, colour));
    }
}
