//! The film: the rectangle of the image plane that a picture shows.

use brillianteer_math::{Basis, SolidRef};
use glam::{DAffine2, DMat2, DVec2};
use serde::{Deserialize, Serialize};

/// The air around the silhouette, as a part of its half width.
const MARGIN: f64 = 0.04;

/// A picture's pixels in the image plane through the world's origin, x to the right and y up. Rows are counted downward.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Film {
    /// The numbers of pixels across and down.
    pub size: [u32; 2],
    /// The side of a pixel in world units (for a stone alone, girdle radii), above 0.
    pub pixel: f64,
    /// The point of the image plane that lies in the picture's middle.
    pub centre: DVec2,
}

impl Film {
    /// The film of products without pixels, such as figures.
    pub const NONE: Self = Self { size: [0; 2], pixel: 1.0, centre: DVec2::ZERO };

    /// Returns a film of `size` pixels around the origin.
    pub fn new(size: [u32; 2], pixel: f64) -> Self {
        Self { size, pixel, centre: DVec2::ZERO }
    }

    /// Returns a square film around the origin with `size` pixels along each side. `half` is half its side in world units.
    pub fn square(size: u32, half: f64) -> Self {
        Self::new([size; 2], 2.0 * half / f64::from(size))
    }

    /// Returns a square film that holds the whole stone, seen along parallel rays, with some air around it.
    pub fn around<'a>(solid: impl Into<SolidRef<'a>>, view: &Basis, size: u32) -> Self {
        let reach = |v| view.project(v).abs().max_element();
        Self::reaching(solid.into().vertices().iter().map(|&v| reach(v)).fold(0.0, f64::max), size)
    }

    /// Returns a square film that holds everything up to `reach` from the origin to each side, with some air around it.
    pub fn reaching(reach: f64, size: u32) -> Self {
        Self::holding(DVec2::splat(reach), [size; 2])
    }

    /// Returns a film of `size` pixels that holds everything up to `half` from the origin, to either side and up and down,
    /// with some air around it.
    pub fn holding(half: DVec2, size: [u32; 2]) -> Self {
        let pixels = DVec2::new(f64::from(size[0].max(1)), f64::from(size[1].max(1)));
        Self::new(size, (2.0 * half * (1.0 + MARGIN) / pixels).max_element())
    }

    /// Returns the number of pixels per world unit.
    pub fn scale(&self) -> f64 {
        1.0 / self.pixel
    }

    /// Returns the map from image coordinates, first transformed by `copy`, to pixels. Pixel (0, 0) is the upper left
    /// corner.
    pub fn pixels_from_image(&self, copy: DMat2) -> DAffine2 {
        let flip = DMat2::from_diagonal(DVec2::new(1.0, -1.0) / self.pixel);
        DAffine2::from_mat2_translation(flip * copy, self.middle() - flip * self.centre)
    }

    /// Returns the image coordinates of a point given in pixels.
    pub fn image_from_pixels(&self, p: DVec2) -> DVec2 {
        let centred = p - self.middle();
        DVec2::new(centred.x, -centred.y) * self.pixel + self.centre
    }

    /// Returns the shift, in pixels, that makes this film of one around the origin.
    pub fn shift(&self) -> DVec2 {
        DVec2::new(self.centre.x, -self.centre.y) / self.pixel
    }

    fn middle(&self) -> DVec2 {
        DVec2::new(f64::from(self.size[0]), f64::from(self.size[1])) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_and_image_are_one_anothers_inverse() {
        let film = Film { centre: DVec2::new(0.3, -0.2), ..Film::new([40, 20], 0.05) };
        assert!(film.image_from_pixels(DVec2::new(20.0, 10.0)).abs_diff_eq(film.centre, 1e-15));
        assert!(film.image_from_pixels(DVec2::ZERO).abs_diff_eq(DVec2::new(-0.7, 0.3), 1e-15));
        let map = film.pixels_from_image(DMat2::IDENTITY);
        let at = DVec2::new(3.25, 17.5);
        assert!(map.transform_point2(film.image_from_pixels(at)).abs_diff_eq(at, 1e-12));
        let around = Film { centre: DVec2::ZERO, ..film };
        assert!(around.image_from_pixels(at + film.shift()).abs_diff_eq(film.image_from_pixels(at), 1e-12));
    }
}
