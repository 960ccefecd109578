//! The square on which a picture is taken.

use crate::math::{Basis, Polytope};
use glam::{DAffine2, DMat2, DVec2};

/// Air around the silhouette, as a part of its half width.
const MARGIN: f64 = 0.04;

/// A square picture centred on the stone's origin, x to the right and y up in the image, rows counted downward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// Pixels along each side, at least 1.
    pub size: u32,
    /// Half the side's length, in girdle radii, above 0.
    pub half: f64,
}

impl Film {
    /// A film that takes in the whole stone, seen along parallel rays, with some air around it.
    pub fn around(polytope: &Polytope, view: &Basis, size: u32) -> Self {
        let reach = |v| view.project(v).abs().max_element();
        Self::reaching(polytope.vertices().iter().map(|&v| reach(v)).fold(0.0, f64::max), size)
    }

    /// A film on which something that reaches so far from the origin has some air around it.
    pub fn reaching(reach: f64, size: u32) -> Self {
        Self { size, half: reach * (1.0 + MARGIN) }
    }

    /// Pixels per girdle radius.
    pub fn scale(&self) -> f64 {
        f64::from(self.size) / (2.0 * self.half)
    }

    /// From image coordinates, first mapped by `copy`, to pixels: (0, 0) is the upper left corner.
    pub fn pixels_from_image(&self, copy: DMat2) -> DAffine2 {
        let middle = DVec2::splat(f64::from(self.size) / 2.0);
        let flip = DMat2::from_diagonal(DVec2::new(self.scale(), -self.scale()));
        DAffine2::from_mat2_translation(flip * copy, middle)
    }

    /// The image coordinates of a point given in pixels.
    pub fn image_from_pixels(&self, p: DVec2) -> DVec2 {
        let centred = p - f64::from(self.size) / 2.0;
        DVec2::new(centred.x, -centred.y) / self.scale()
    }
}
