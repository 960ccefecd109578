//! A photograph in linear light: of all the surroundings, or of a backplate.

use glam::{DVec2, DVec3, Vec2, Vec3, Vec4};
use serde::{Deserialize, Serialize};

/// A picture in linear light of sRGB's primaries, row by row from the top.
///
/// As a panorama it is equirectangular: its first row is the zenith, its last the nadir. Azimuth runs to the left, as it
/// does for someone who looks up and turns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "PanoramaData")]
pub struct Panorama {
    /// The number of pixels across, at least 1.
    pub width: u32,
    /// The number of pixels down, at least 1.
    pub height: u32,
    /// Red, green and blue, finite and at least 0; `width` times `height` of them.
    pub pixels: Vec<[f32; 3]>,
}

/// A panorama that has been read and is not checked yet.
#[derive(Deserialize)]
struct PanoramaData {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

/// The reason why data make no panorama.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PanoramaError {
    /// The picture has no pixel, or not as many as its size says.
    #[error(
        "{width} by {height} pixels have {pixels} colours: give one for each pixel, and at least one pixel"
    )]
    Size {
        /// The number of pixels across.
        width: u32,
        /// The number of pixels down.
        height: u32,
        /// The number of colours that were given.
        pixels: usize,
    },
    /// A colour is negative or infinite.
    #[error("pixels[{place}] is {colour:?}: give finite numbers of 0 or more")]
    Colour {
        /// The place of the pixel, row by row from 0.
        place: usize,
        /// The colour.
        colour: [f32; 3],
    },
}

impl TryFrom<PanoramaData> for Panorama {
    type Error = PanoramaError;

    fn try_from(PanoramaData { width, height, pixels }: PanoramaData) -> Result<Self, PanoramaError> {
        let is_wrong = |colour: &[f32; 3]| colour.iter().any(|&part| !(part >= 0.0 && part.is_finite()));
        if let Some(place) = pixels.iter().position(is_wrong) {
            return Err(PanoramaError::Colour { place, colour: pixels[place] });
        }
        let panorama = Self { width, height, pixels };
        panorama.check().map(|()| panorama)
    }
}

impl Panorama {
    /// Checks that there is a colour for each pixel, and at least one pixel.
    ///
    /// # Errors
    /// Fails with [`PanoramaError::Size`] where the numbers differ, or where there is no pixel.
    pub fn check(&self) -> Result<(), PanoramaError> {
        let Self { width, height, ref pixels } = *self;
        if pixels.is_empty() || u64::from(width) * u64::from(height) != pixels.len() as u64 {
            return Err(PanoramaError::Size { width, height, pixels: pixels.len() });
        }
        Ok(())
    }

    /// Returns whether the picture is twice as wide as high, to one pixel, as a whole sphere is.
    pub fn is_whole_sphere(&self) -> bool {
        self.width.abs_diff(2 * self.height) <= 1
    }

    /// Returns the same picture with half as many pixels each way. Each is the mean of the four that it replaces; where
    /// there are fewer at the border, the border's own count twice.
    pub fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mean = |x: u32, y: u32| {
            let at = |x: u32, y: u32| (y.min(self.height - 1) * self.width + x.min(self.width - 1)) as usize;
            let all =
                [at(2 * x, 2 * y), at(2 * x + 1, 2 * y), at(2 * x, 2 * y + 1), at(2 * x + 1, 2 * y + 1)];
            [0, 1, 2].map(|c| all.iter().map(|&k| 0.25 * self.pixels[k][c]).sum())
        };
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| mean(x, y))).collect();
        Self { width, height, pixels }
    }

    /// Returns the light at a place, in pixels from the middle of the first pixel, interpolated between the middles of the
    /// four pixels around it. Beyond the edge it is the edge's.
    pub fn between(&self, at: DVec2) -> DVec3 {
        self.mixed(at, |x| x.clamp(0, i64::from(self.width) - 1))
    }

    /// Returns the light at a place as [`between`](Self::between) does, in single precision. It is always inlined, so that it is compiled
    /// for the instructions of its caller, which rounds down by one of them.
    #[inline(always)]
    pub fn near(&self, at: Vec2) -> Vec3 {
        let base = at.floor();
        let part = at - base;
        let (left, top, width, height) =
            (base.x as i32, base.y as i32, self.width as i32, self.height as i32);
        let texels = self.pixels.as_flattened();
        // Four numbers are read at once: the last is not used. The very last pixel has no number after it.
        let texel = |x: i32, y: i32| {
            let first = 3 * (y * width + x) as usize;
            match texels.get(first..first + 4) {
                Some(four) => Vec4::from_slice(four),
                None => Vec3::from_slice(&texels[first..]).extend(0.0),
            }
        };
        let mut columns = [left, left.saturating_add(1)];
        let mut rows = [top, top.saturating_add(1)];
        if left < 0 || top < 0 || left >= width - 1 || top >= height - 1 {
            columns = columns.map(|x| x.clamp(0, width - 1));
            rows = rows.map(|y| y.clamp(0, height - 1));
        }
        let row = |y: i32| {
            let (from, to) = (texel(columns[0], y), texel(columns[1], y));
            from + (to - from) * part.x
        };
        let (high, low) = (row(rows[0]), row(rows[1]));
        (high + (low - high) * part.y).truncate()
    }

    /// Returns the light from a unit direction, z up, interpolated between pixels.
    pub fn toward(&self, d: DVec3) -> DVec3 {
        let size = DVec2::new(f64::from(self.width), f64::from(self.height));
        let (azimuth, polar) = (d.y.atan2(d.x), d.z.clamp(-1.0, 1.0).acos());
        let part =
            DVec2::new((0.5 - azimuth / std::f64::consts::TAU).rem_euclid(1.0), polar / std::f64::consts::PI);
        self.mixed(part * size - 0.5, |x| x.rem_euclid(i64::from(self.width)))
    }

    fn mixed(&self, at: DVec2, column: impl Fn(i64) -> i64) -> DVec3 {
        let base = at.floor();
        let part = (at - base).as_vec2();
        let (left, top, width) = (base.x as i64, base.y as i64, i64::from(self.width));
        let mean = |columns: [i64; 2], rows: [i64; 2]| {
            let pixel = |x: i64, y: i64| Vec3::from_array(self.pixels[(y * width + x) as usize]);
            let [high, low] = rows.map(|y| pixel(columns[0], y).lerp(pixel(columns[1], y), part.x));
            high.lerp(low, part.y).as_dvec3()
        };
        // Most places have all four pixels around them, so they skip the search for pixels beyond the edge.
        let last = i64::from(self.height) - 1;
        if (0..width - 1).contains(&left) && (0..last).contains(&top) {
            return mean([left, left + 1], [top, top + 1]);
        }
        let rows = [top, top.saturating_add(1)].map(|y| y.clamp(0, last));
        mean([column(left), column(left.saturating_add(1))], rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panorama_shows_every_pixel_in_its_direction() {
        let (width, height) = (16, 8);
        let pixels = (0..width * height).map(|k| [k as f32, 1.0, 0.5]).collect();
        let picture = Panorama { width, height, pixels };
        for k in 0..width * height {
            let (x, y) = (f64::from(k % width) + 0.5, f64::from(k / width) + 0.5);
            let (azimuth, polar) = (std::f64::consts::TAU * (0.5 - x / 16.0), std::f64::consts::PI * y / 8.0);
            let d = DVec3::new(polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos());
            assert!((picture.toward(d) - DVec3::new(f64::from(k), 1.0, 0.5)).length() < 1e-4, "{k}");
        }
        assert_eq!(picture.between(DVec2::new(-5.0, 99.0)).x, 112.0);
        // Each pixel of the halved picture is the mean of four. Pixels that are missing beyond an odd border equal those of
        // the border.
        let half = picture.halved();
        assert_eq!((half.width, half.height, half.pixels[9]), (8, 4, [42.5, 1.0, 0.5]));
        let odd = Panorama { width: 1, height: 3, pixels: vec![[1.0; 3], [3.0; 3], [5.0; 3]] }.halved();
        assert_eq!((odd.width, odd.height, odd.pixels), (1, 2, vec![[2.0; 3], [5.0; 3]]));
    }
}
