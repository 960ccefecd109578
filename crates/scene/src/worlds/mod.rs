//! Worlds that the program draws itself, each a function from direction to radiance: as the light around stones, as the
//! whole sphere, and as a photograph of its best side. Radiance 1 is that of a white sheet in full light.
//!
//! z is up, and the middle of the photograph is at azimuth 0, which is +x. The photograph is a plain perspective whose
//! film may be shifted upward, so that what is upright stays upright.
//!
//! To add a world, add a function from direction and footprint to radiance in a file here, a variant with its name
//! in `NAMES`, its arms, its light in `lights.rs` beside this folder, and its mean radiance in the tests. What is
//! finer than the footprint must fade into its mean.

mod city;
mod drawing;
mod noise;
mod room;
mod sunset;
mod table;
mod waves;

use super::panorama::Panorama;
use drawing::drawn;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::{ControlFlow, Range};

/// The tangent of half the angle across a photograph of span 1: 60 degrees across.
const HALF_ACROSS: f64 = 0.577_350_269_189_625_8;

/// The rows of a part of a picture that is drawn in parts.
const PART_ROWS: usize = 64;

/// A world that the program draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum World {
    /// A sunset over water.
    Sunset,
    /// A lit living room at dusk.
    Room,
    /// A city at night across water.
    City,
}

impl World {
    /// The worlds with their names.
    pub const NAMES: [(&str, Self); 3] =
        [("sunset", Self::Sunset), ("room", Self::Room), ("city", Self::City)];

    /// Returns the world of this name; upper and lower case are the same.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, world)| *world)
    }

    /// Returns the world's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sunset => "sunset",
            Self::Room => "room",
            Self::City => "city",
        }
    }

    /// Returns the radiance from a unit direction, as linear light of sRGB's primaries, each finite and at least 0.
    /// `footprint` is the angle in radians over which it is averaged, approximately and with soft borders.
    pub fn radiance(self, direction: DVec3, footprint: f64) -> DVec3 {
        let light = match self {
            Self::Sunset => sunset::radiance(direction, footprint),
            Self::Room => room::radiance(direction, footprint),
            Self::City => city::radiance(direction, footprint),
        };
        light.max(DVec3::ZERO)
    }

    /// Returns the world's direction that corresponds to a direction in the frame of a light, whose z points to the
    /// eye and whose y is up in the picture: the middle of the photograph lies behind the stones.
    pub fn from_light(direction: DVec3) -> DVec3 {
        DVec3::new(-direction.z, -direction.x, direction.y)
    }

    /// Draws the whole sphere, equirectangular, as [`Panorama::toward`] looks it up; half as high as wide, at least 2
    /// pixels wide.
    pub fn panorama(self, width: u32) -> Panorama {
        let width = width.max(2);
        let height = width / 2;
        let toward = |at: DVec2| {
            let azimuth = PI - TAU * at.x / f64::from(width);
            let elevation = FRAC_PI_2 - PI * at.y / f64::from(height);
            (super::toward(azimuth.to_degrees(), elevation.to_degrees()), TAU / f64::from(width))
        };
        self.taken([width, height], toward)
    }

    /// Takes a photograph of the world's best side, at least 1 pixel each way. `span` is its width in widths of a
    /// photograph 60 degrees across: the middle half of one of span 2 is that of span 1.
    pub fn picture(self, [width, height]: [u32; 2], span: f64) -> Panorama {
        let size = [width.max(1), height.max(1)];
        self.taken(size, |at| self.seen_at(at, size, span))
    }

    /// Takes the same photograph as [`picture`](Self::picture), a part after the other. `go_on` is called before each part
    /// with the share that is done, and stops the work; there is no photograph then.
    pub fn picture_in_parts(
        self,
        [width, height]: [u32; 2],
        span: f64,
        mut go_on: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Option<Panorama> {
        let size = [width.max(1), height.max(1)];
        let [across, down] = size.map(|side| side as usize);
        let mut pixels = Vec::with_capacity(across * down);
        for first in (0..down).step_by(PART_ROWS) {
            if go_on(first as f64 / down as f64).is_break() {
                return None;
            }
            let rows = first..(first + PART_ROWS).min(down);
            let part = self.drawn([across, down], rows, |at| self.seen_at(at, size, span));
            pixels.extend(part.into_iter().map(|light| light.as_vec3().to_array()));
        }
        Some(Panorama { width: size[0], height: size[1], pixels })
    }

    /// Returns the unit direction that a place in a photograph shows, in pixels from its upper left corner, and the angle
    /// that a pixel spans there.
    fn seen_at(self, at: DVec2, [width, height]: [u32; 2], span: f64) -> (DVec3, f64) {
        let pixel = 2.0 * HALF_ACROSS * span / f64::from(width);
        let off = (at - 0.5 * DVec2::new(f64::from(width), f64::from(height))) * pixel;
        let through = DVec3::new(1.0, -off.x, self.shift() - off.y);
        let away = through.length();
        (through / away, pixel / away)
    }

    /// Returns the tangent of the elevation in the middle of the photograph.
    fn shift(self) -> f64 {
        match self {
            Self::Sunset => 0.10,
            Self::Room => 0.0,
            Self::City => 0.11,
        }
    }

    fn taken(self, [width, height]: [u32; 2], toward: impl Fn(DVec2) -> (DVec3, f64) + Sync) -> Panorama {
        let size = [width, height].map(|side| side as usize);
        let light = self.drawn(size, 0..size[1], toward);
        Panorama {
            width,
            height,
            pixels: light.into_iter().map(|light| light.as_vec3().to_array()).collect(),
        }
    }

    /// Draws some rows of any view of the world, one after the other. `toward` gives for a place, in pixels from the first
    /// corner of the whole view, the unit direction and the angle in radians that a pixel spans there.
    pub fn drawn(
        self,
        size: [usize; 2],
        rows: Range<usize>,
        toward: impl Fn(DVec2) -> (DVec3, f64) + Sync,
    ) -> Vec<DVec3> {
        drawn(size, rows, |at, share| {
            let (direction, footprint) = toward(at);
            self.radiance(direction, footprint * share)
        })
    }
}

#[cfg(test)]
mod tests;
