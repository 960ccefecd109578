//! Temporal antialiasing: each picture of moving bodies is blended with the ones before, which are first shifted to
//! the present places of the bodies.
//!
//! Light that has changed since, such as a background seen through moving glass, is clamped to the range that the
//! newest picture shows around the pixel, so that nothing leaves a trail (B. Karis, High-quality temporal
//! supersampling, SIGGRAPH 2014 courses).

use super::Linear;
use glam::DVec2;
use rayon::prelude::*;

/// The distance by which older light may lie outside the range that the newest picture shows around a pixel, as a
/// part of that range.
const BEYOND: f32 = 0.25;

/// The body at a pixel's middle, and its motion since the picture before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionVector {
    /// The body, if there is one.
    pub body: Option<u32>,
    /// The place of the same point of the body in the picture before, in pixels from that picture's upper left, to
    /// the right and down. It is not finite where the point was not in sight.
    pub from: DVec2,
}

/// A sequence of pictures, blended into one.
#[derive(Debug, Clone, PartialEq)]
pub struct TemporalHistory {
    /// The blended picture, in linear light.
    pub picture: Linear,
    /// The body that each pixel shows, or at whose rim the pixel is.
    bodies: Vec<Option<u32>>,
    /// The number of pictures that were blended.
    pub count: u32,
}

impl TemporalHistory {
    /// Begins with a first picture; `moved` has an entry for each of its pixels.
    pub fn begin(picture: Linear, moved: &[MotionVector]) -> Self {
        let picture = picture.whole();
        let frames = Frames { now: &picture, moved };
        let bodies = (0..picture.pixels.len()).map(|k| frames.from(k).0).collect();
        Self { picture, bodies, count: 1 }
    }

    /// Blends the next picture with the ones before; `newest` is its share, 0 to 1. The next picture replaces the ones
    /// before where it shows something that was not seen before, and altogether if its size differs or `moved` does not
    /// have one entry per pixel.
    pub fn lay(&mut self, picture: Linear, moved: &[MotionVector], newest: f64) {
        let next = Self::begin(picture, moved);
        let same = (next.picture.width, next.picture.height) == (self.picture.width, self.picture.height);
        if !same || moved.len() != next.bodies.len() {
            *self = next;
            return;
        }
        let newest = newest.clamp(0.0, 1.0) as f32;
        let frames = Frames { now: &next.picture, moved };
        let pixels = (0..moved.len()).into_par_iter().map(|k| {
            let now = next.picture.pixels[k];
            let Some(before) = self.before(frames.from(k)) else { return now };
            let [least, most] = frames.around(k);
            let held = |c: usize| before[c].max(least[c]).min(most[c]);
            std::array::from_fn(|c| held(c) + (now[c] - held(c)) * newest)
        });
        self.picture.pixels = pixels.collect();
        (self.bodies, self.count) = (next.bodies, self.count + 1);
    }

    /// Returns the light that was seen around a point of the picture; `None` where the body was not in sight there.
    fn before(&self, (body, from): (Option<u32>, DVec2)) -> Option<[f32; 4]> {
        let (width, height) = (self.picture.width as usize, self.picture.height as usize);
        let at = from - 0.5;
        let corner = at.floor();
        let is_inside = from.is_finite()
            && from.min_element() >= 0.0
            && from.x <= width as f64
            && from.y <= height as f64;
        if !is_inside {
            return None;
        }
        let [right, down] = (at - corner).to_array();
        let mut sum = [0.0; 4];
        let mut is_known = false;
        for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let share =
                (if dx > 0.0 { right } else { 1.0 - right }) * (if dy > 0.0 { down } else { 1.0 - down });
            let x = (corner.x + dx).clamp(0.0, width as f64 - 1.0) as usize;
            let y = (corner.y + dy).clamp(0.0, height as f64 - 1.0) as usize;
            is_known |= share > 0.0 && self.bodies[y * width + x] == body;
            let pixel = self.picture.pixels[y * width + x];
            (0..4).for_each(|c| sum[c] += pixel[c] * share as f32);
        }
        (is_known && sum.iter().all(|light| light.is_finite())).then_some(sum)
    }
}

/// The newest picture.
struct Frames<'a> {
    now: &'a Linear,
    moved: &'a [MotionVector],
}

impl Frames<'_> {
    /// Returns the pixels around one, including itself, with the steps to them.
    fn near(&self, k: usize) -> impl Iterator<Item = (usize, DVec2)> + '_ {
        let (width, height) = (self.now.width as i64, self.now.height as i64);
        let (x, y) = (k as i64 % width, k as i64 / width);
        let near = (-1..=1)
            .flat_map(move |dy| (-1..=1).map(move |dx| (x + dx, y + dy, DVec2::new(dx as f64, dy as f64))));
        near.filter(move |(x, y, _)| (0..width).contains(x) && (0..height).contains(y))
            .map(move |(x, y, by)| ((y * width + x) as usize, by))
    }

    /// Returns the body that a pixel shows, and its place in the picture before. A pixel beside a body counts as the
    /// body's rim, which covers a part of the pixel.
    fn from(&self, k: usize) -> (Option<u32>, DVec2) {
        let Some(own) = self.moved.get(k) else { return (None, DVec2::NAN) };
        if own.body.is_some() {
            return (own.body, own.from);
        }
        let rim = self.near(k).find(|(other, _)| self.moved.get(*other).is_some_and(|m| m.body.is_some()));
        rim.map_or((None, own.from), |(other, by)| (self.moved[other].body, self.moved[other].from - by))
    }

    /// Returns the least and the greatest value of each channel in the pixels around one, widened a little for light
    /// that none of them happens to show.
    fn around(&self, k: usize) -> [[f32; 4]; 2] {
        let mut ends = [[f32::INFINITY; 4], [f32::NEG_INFINITY; 4]];
        for (other, _) in self.near(k) {
            for (c, light) in self.now.pixels[other].into_iter().enumerate() {
                (ends[0][c], ends[1][c]) = (ends[0][c].min(light), ends[1][c].max(light));
            }
        }
        let beyond: [f32; 4] = std::array::from_fn(|c| BEYOND * (ends[1][c] - ends[0][c]));
        [std::array::from_fn(|c| ends[0][c] - beyond[c]), std::array::from_fn(|c| ends[1][c] + beyond[c])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 24;

    /// Returns a picture of a striped disc; each pixel is sampled at one point, which lies at `shift` from its upper
    /// left.
    fn disc(middle: DVec2, shift: DVec2) -> Linear {
        let mut picture = Linear::new(SIDE, SIDE);
        for (k, pixel) in picture.pixels.iter_mut().enumerate() {
            let at = DVec2::new((k as u32 % SIDE).into(), (k as u32 / SIDE).into()) + shift - middle;
            if at.length() < 7.0 {
                let light = 0.5 + 0.5 * (at.x * 0.9 + at.y * 0.4).sin();
                *pixel = [light as f32, 0.2, 1.0 - light as f32, 1.0];
            }
        }
        picture
    }

    /// Returns the picture of the same disc, sampled at many points per pixel.
    fn exact(middle: DVec2) -> Linear {
        let mut sum = Linear::new(SIDE, SIDE);
        let points = (0..64).map(|n| DVec2::new(f64::from(n % 8) + 0.5, f64::from(n / 8) + 0.5) / 8.0);
        for point in points {
            let one = disc(middle, point);
            for (sum, one) in sum.pixels.iter_mut().zip(one.pixels) {
                (0..4).for_each(|c| sum[c] += one[c] / 64.0);
            }
        }
        sum
    }

    /// Returns the motion of a disc that has moved by this much.
    fn moved(middle: DVec2, by: DVec2) -> Vec<MotionVector> {
        let pixel = |k: u32| {
            let at = DVec2::new(f64::from(k % SIDE), f64::from(k / SIDE)) + 0.5;
            let is_body = (at - middle).length() < 7.0;
            MotionVector { body: is_body.then_some(0), from: if is_body { at - by } else { at } }
        };
        (0..SIDE * SIDE).map(pixel).collect()
    }

    fn off(a: &Linear, b: &Linear) -> f64 {
        let pairs = a.pixels.iter().flatten().zip(b.pixels.iter().flatten());
        (pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>() / a.pixels.len() as f64).sqrt()
    }

    /// Follows a disc that moves for some time, seen at one point per pixel. Returns the errors of the blended pictures
    /// and of the last picture alone.
    fn run(speed: DVec2, motion: DVec2, newest: f64) -> (f64, f64) {
        let place = |n: u32| DVec2::splat(9.0) + speed * f64::from(n);
        let shift = |n: u32| ((DVec2::new(0.755, 0.57) * f64::from(n)) + 0.5).fract();
        let mut trail = TemporalHistory::begin(disc(place(0), shift(0)), &moved(place(0), motion));
        const LAST: u32 = 19;
        for n in 1..=LAST {
            trail.lay(disc(place(n), shift(n)), &moved(place(n), motion), newest);
        }
        assert_eq!(trail.count, LAST + 1);
        let exact = exact(place(LAST));
        (off(&trail.picture, &exact), off(&disc(place(LAST), shift(LAST)), &exact))
    }

    #[test]
    fn what_stands_still_or_moves_becomes_smoother_than_one_picture() {
        for (speed, most) in
            [(DVec2::ZERO, 0.45), (DVec2::new(0.31, 0.17), 0.8), (DVec2::new(0.0, 0.25), 0.8)]
        {
            let (laid, alone) = run(speed, speed, 0.2);
            assert!(laid < most * alone, "{speed}: {laid} of {alone}");
        }
    }

    #[test]
    fn without_its_true_motion_it_is_worse() {
        let speed = DVec2::new(0.31, 0.17);
        let ((followed, _), (still, _)) = (run(speed, speed, 0.2), run(speed, DVec2::ZERO, 0.2));
        assert!(still > 1.15 * followed, "{still} and {followed}");
    }

    #[test]
    fn nothing_is_kept_of_what_was_not_seen_nor_of_other_sizes() {
        let (here, there) = (DVec2::new(8.0, 8.0), DVec2::new(16.0, 16.0));
        let half = DVec2::splat(0.5);
        let (first, second) = (disc(here, half), disc(there, half));
        let lost: Vec<MotionVector> =
            moved(there, DVec2::ZERO).into_iter().map(|m| MotionVector { from: DVec2::NAN, ..m }).collect();
        let mut trail = TemporalHistory::begin(first.clone(), &moved(here, DVec2::ZERO));
        trail.lay(second.clone(), &lost, 0.1);
        assert!(trail.picture == second);
        let small = Linear::new(3, 3);
        trail.lay(small.clone(), &[MotionVector { body: None, from: DVec2::ONE }; 9], 0.1);
        assert!(trail.picture == small && trail.count == 1);
        let mut trail = TemporalHistory::begin(first, &moved(here, DVec2::ZERO));
        trail.lay(second.clone(), &moved(there, DVec2::ZERO), 1.0);
        assert!(off(&trail.picture, &second) < 1e-6, "all of the newest");
    }
}
