//! Pictures with coarser levels, by which the mean over a long stretch takes few look-ups.

use super::Panorama;
use glam::{DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// A picture with coarser levels (L. Williams, *Pyramidal parametrics*, 1983). As data it is the picture alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "Panorama", into = "Panorama")]
pub struct Mipmap {
    /// The finest first; each has half the width and height of the one before, rounded down, until one of them is 1.
    levels: Vec<Panorama>,
    /// The width and height of each level as parts of those of the finest.
    scales: Vec<Vec2>,
}

/// The most look-ups along a stretch.
const MOST_TAPS: f64 = 8.0;

/// The same number as an exponent of 2.
const TAP_BITS: i32 = 3;

impl From<Panorama> for Mipmap {
    fn from(picture: Panorama) -> Self {
        Self::new(picture)
    }
}

impl From<Mipmap> for Panorama {
    fn from(mut mipmap: Mipmap) -> Self {
        mipmap.levels.swap_remove(0)
    }
}

impl Mipmap {
    /// Makes the coarser levels of a picture; one that [`Panorama::check`] refuses has none.
    pub fn new(picture: Panorama) -> Self {
        let is_whole = picture.check().is_ok();
        let mut levels = vec![picture];
        while let Some(last) = levels.last().filter(|last| is_whole && last.width.min(last.height) > 1) {
            levels.push(halved(last));
        }
        let size = |level: &Panorama| Vec2::new(level.width as f32, level.height as f32);
        let scales = levels.iter().map(|level| size(level) / size(&levels[0])).collect();
        Self { levels, scales }
    }

    /// Returns the picture itself.
    pub fn picture(&self) -> &Panorama {
        &self.levels[0]
    }

    /// Returns the picture and its coarser levels, the finest first.
    pub fn levels(&self) -> &[Panorama] {
        &self.levels
    }

    /// Returns the mean light along a stretch of this length, in pixels. `at` gives the places along it, for 0 to 1, in pixels
    /// from the middle of the first pixel.
    ///
    /// It takes up to eight look-ups, in the finest level in which they lie no more than one pixel apart, or in the coarsest.
    pub fn along(&self, length: f64, at: impl Fn(f64) -> DVec2) -> DVec3 {
        if length <= 1.0 {
            return self.picture().between(at(0.5));
        }
        let level = (length / MOST_TAPS).log2().ceil().clamp(0.0, (self.levels.len() - 1) as f64);
        let taps = (length / level.exp2()).ceil().clamp(1.0, MOST_TAPS);
        let picture = &self.levels[level as usize];
        let finest = self.picture();
        let scale = DVec2::new(
            f64::from(picture.width) / f64::from(finest.width),
            f64::from(picture.height) / f64::from(finest.height),
        );
        let sum: DVec3 = (0..taps as u32)
            .map(|k| picture.between((at((f64::from(k) + 0.5) / taps) + 0.5) * scale - 0.5))
            .sum();
        sum / taps
    }

    /// Returns the level in which a stretch of this length, in pixels, is looked up in single precision, and the
    /// number of look-ups, as [`along`](Self::along) takes them.
    #[inline(always)]
    pub fn taps(&self, length: f32) -> (usize, u32) {
        if length <= 1.0 {
            return (0, 1);
        }
        // The exponent of the least power of 2 that is not below the length.
        let rounded_up = ((length.to_bits() + 0x007f_ffff) >> 23) as i32 - 127;
        let level = (rounded_up - TAP_BITS).clamp(0, self.levels.len() as i32 - 1);
        let taps = (length * f32::from_bits(((127 - level) as u32) << 23)).ceil();
        (level as usize, (taps as u32).clamp(1, 1 << TAP_BITS))
    }

    /// Returns the light of a level, from [`taps`](Self::taps), at a place in pixels from the middle of the picture's first
    /// pixel, interpolated in single precision; beyond the edge it is the edge's.
    #[inline(always)]
    pub fn near(&self, level: usize, at: Vec2) -> Vec3 {
        let picture = &self.levels[level];
        let at = if level == 0 { at } else { (at + 0.5) * self.scales[level] - 0.5 };
        picture.near(at)
    }
}

/// Returns the next coarser level, whose pixels are means over the area that they cover.
fn halved(fine: &Panorama) -> Panorama {
    let (width, height) = ((fine.width / 2).max(1), (fine.height / 2).max(1));
    let columns: Vec<_> = (0..width).map(|x| covered(x, width, fine.width)).collect();
    let row = |y: u32| {
        let rows = covered(y, height, fine.height);
        let mean = move |columns: &[(u32, f32)]| {
            let weighted = rows.iter().flat_map(|&(y, down)| {
                columns.iter().map(move |&(x, across)| {
                    Vec3::from_array(fine.pixels[(y * fine.width + x) as usize]) * (down * across)
                })
            });
            weighted.sum::<Vec3>().to_array()
        };
        columns.iter().map(|columns| mean(columns)).collect::<Vec<_>>()
    };
    let pixels = (0..height).into_par_iter().flat_map_iter(row).collect();
    Panorama { width, height, pixels }
}

/// Returns the fine pixels that a coarse one covers along one side, each with its share.
fn covered(coarse: u32, count: u32, of: u32) -> Vec<(u32, f32)> {
    let size = f64::from(of) / f64::from(count);
    let (from, to) = (f64::from(coarse) * size, f64::from(coarse + 1) * size);
    let share = |k: u32| (to.min(f64::from(k + 1)) - from.max(f64::from(k))) / size;
    let last = (to.ceil() as u32).min(of);
    (from as u32..last).map(|k| (k, share(k) as f32)).filter(|(_, share)| *share > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes a picture whose light rises evenly from column to column and from row to row.
    fn ramp(width: u32, height: u32) -> Panorama {
        let pixel = |k: u32| [(k % width) as f32, (k / width) as f32, 1.0];
        Panorama { width, height, pixels: (0..width * height).map(pixel).collect() }
    }

    #[test]
    fn all_levels_hold_the_same_light() {
        for (width, height) in [(1, 1), (2, 1), (7, 5), (64, 32), (33, 100)] {
            let mipmap = Mipmap::new(ramp(width, height));
            for level in mipmap.levels() {
                let all: Vec3 = level.pixels.iter().map(|&p| Vec3::from_array(p)).sum();
                let mean = all / level.pixels.len() as f32;
                let middle = Vec3::new((width - 1) as f32 / 2.0, (height - 1) as f32 / 2.0, 1.0);
                assert!((mean - middle).length() < 1e-3, "{width} x {height}: {mean} is not {middle}");
            }
            let sizes: Vec<_> = mipmap.levels().iter().map(|level| (level.width, level.height)).collect();
            assert!(
                sizes.windows(2).all(|s| s[1] == ((s[0].0 / 2).max(1), (s[0].1 / 2).max(1))),
                "{sizes:?}"
            );
        }
    }

    #[test]
    fn the_light_of_a_stretch_is_its_mean() {
        let mipmap = Mipmap::new(ramp(512, 512));
        for (from, to) in [
            (DVec2::splat(200.0), DVec2::splat(200.0)),
            (DVec2::new(100.0, 250.0), DVec2::new(103.0, 250.0)),
            (DVec2::new(150.0, 300.0), DVec2::new(350.0, 220.0)),
        ] {
            let seen = mipmap.along(from.distance(to), |part| from.lerp(to, part));
            let middle = 0.5 * (from + to);
            assert!((seen.truncate() - middle).length() < 1e-2, "{seen} is not {middle}");
        }
        // A line of one bright column is missed by no stretch across it, and counts in proportion to its width.
        let line = (0..512 * 512).map(|k| [if k % 512 == 256 { 1.0 } else { 0.0 }; 3]).collect();
        let line = Mipmap::new(Panorama { width: 512, height: 512, pixels: line });
        for (length, start) in [(6.0, 253.3), (8.0, 251.9), (40.0, 230.1), (100.0, 200.7)] {
            let seen = line.along(length, |part| DVec2::new(start + part * length, 256.0)).x;
            assert!((seen * length - 1.0).abs() < 0.35, "{length}: {}", seen * length);
        }
    }

    #[test]
    fn single_precision_finds_the_same() {
        let (width, height) = (211, 130);
        let pixels = (0..width * height).map(|k| [(k % 7) as f32, (k * k % 11) as f32, 1.0]).collect();
        let mipmap = Mipmap::new(Panorama { width, height, pixels });
        for k in 0..400 {
            let from = DVec2::new(f64::from(k) * 0.611 - 10.0, f64::from(k * 7 % 400) * 0.4 - 10.0);
            let by = DVec2::from_angle(f64::from(k)) * (f64::from(k) * 0.03).exp2();
            let place = |part: f64| from + by * part;
            let (level, taps) = mipmap.taps(by.length() as f32);
            let middle = |tap: u32| place((f64::from(tap) + 0.5) / f64::from(taps)).as_vec2();
            let mean = (0..taps).map(|tap| mipmap.near(level, middle(tap))).sum::<Vec3>() / taps as f32;
            let off = mean.as_dvec3() - mipmap.along(by.length(), place);
            assert!(off.abs().max_element() < 1e-3, "{k}: {taps} in level {level}: {off}");
        }
    }

    #[test]
    fn as_data_it_is_the_picture() {
        let mipmap = Mipmap::new(ramp(5, 3));
        let text = serde_json::to_string(&mipmap).unwrap();
        assert_eq!(text, serde_json::to_string(&ramp(5, 3)).unwrap());
        assert_eq!(serde_json::from_str::<Mipmap>(&text).unwrap(), mipmap);
    }
}
