//! The subject of a picture under light, and the sample passes that it is made from: the same for every tracer.

use super::environment::Environment;
use super::places::{place_in_pixel, stretch_of_pixel};
use super::{DispersedRay, Stopped, Watch};
use crate::optics::{SAMPLED_NM, Strata, Stratum};
use crate::scene::{Film, Instance, Medium, Scene, View};
use crate::trace::ray::{RayOptions, Roulette};
use glam::{DVec2, DVec3, DVec4};
use num_complex::Complex64;

/// Stones and metal in one world, the environment around them, and the camera.
#[derive(Clone, Copy)]
pub struct LitScene<'a> {
    /// The stones and the metal.
    pub scene: &'a Scene,
    /// The environment around the stones.
    pub environment: Environment<'a>,
    /// The view from which they are seen.
    pub view: &'a View,
    /// The picture's pixels.
    pub film: Film,
    /// How far rays are followed.
    pub options: RayOptions,
}

/// One sample pass over a picture: one ray of each pixel for each band of wavelengths.
#[derive(Debug, Clone, PartialEq)]
pub struct SamplePass {
    /// The place of the ray in its pixel, 0 to 1.
    pub shift: DVec2,
    /// The stretch of its pixel that a ray stands for, from one end to the other, in pixels to the right and down; 0 where it
    /// stands for its place alone. What the ray sees around the stones is averaged along it.
    pub footprint: DVec2,
    /// The media of the stones, in the units of their bodies: stone by stone, band by band.
    pub media: Vec<Vec<Medium>>,
    /// The complex indices of the bodies of metal: body by body, band by band.
    pub metals: Vec<Vec<Complex64>>,
    /// For each band, the colour of light of radiance 1 in each of the environment's four channels. A band is the share of a
    /// stratum that the pass stands for.
    pub responses: Vec<[DVec3; 4]>,
    /// The colour of such light in all strata together: that of light which goes straight to the eye, because there it is the
    /// same at all wavelengths.
    pub whole: [DVec3; 4],
    /// The share of refraction's turning of light that is followed, 0 to 1; see [`Sampling::strength`].
    pub strength: f64,
    /// The number of the pass.
    pub number: u32,
    /// The weight below which light goes on by chance; see [`Sampling::by_chance`].
    pub by_chance: f64,
}

/// How the sample passes of a picture are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// The number of sample passes, at least 1.
    pub count: u32,
    /// The share of refraction's turning of light that is followed, 0 to 1; 1 is physics. Below 1, light that goes on away
    /// from the eye is looked up on a mixture of its own ray and the straight one, which is a choice of looks and not
    /// physics.
    pub strength: f64,
    /// The share of a ray's light below which light goes on by chance alone, counting for more where it does; 0 where all light
    /// is followed. Packets heed this, and single rays in double precision in solids that are not convex, and between bodies
    /// and metal; graphics cards heed it between bodies where there is metal, and else follow all light.
    pub by_chance: f64,
    /// Whether each ray stands for a stretch of its pixel ([`stretch_of_pixel`](super::places::stretch_of_pixel)) and, where bands are
    /// divided into n shares, for √n of them but at most 2.5, so that what few rays see has fewer gaps. Else it stands for its place and its share
    /// alone.
    pub stretches: bool,
}

/// The most rays of one pixel that may wait to meet another stone.
pub const MOST_WAITING: usize = 24;

/// The light of one pixel: means over sample passes; `unresolved` and `absorbed` are means over wavelengths as well.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadiancePixel {
    /// Linear colour in sRGB's primaries; 0 beside the stones unless rays there see the environment.
    pub colour: DVec3,
    /// The share of rays that see anything.
    pub cover: f64,
    /// The share of the light that was not followed to its end.
    pub unresolved: f64,
    /// The share of the light that was absorbed.
    pub absorbed: f64,
}

/// Returns the colour of light that is given by channel, where light of radiance 1 has the colours `response`.
pub fn colour(response: &[DVec3; 4], light: DVec4) -> DVec3 {
    response.iter().zip(light.to_array()).map(|(&colour, light)| colour * light).sum()
}

/// Rows of a picture that grow clearer with every sample pass.
pub trait ProgressiveImage<E: From<Stopped>> {
    /// Adds one sample pass.
    ///
    /// # Errors
    /// [`Stopped`] when `watch` asks to stop, or the error of a graphics card.
    fn add_pass(&mut self, pass: &SamplePass, watch: Watch) -> Result<(), E>;

    /// Calls `each` with the means of all sample passes so far, pixel by pixel.
    ///
    /// # Errors
    /// The error of a graphics card.
    fn each_pixel(&self, each: &mut dyn FnMut(&RadiancePixel)) -> Result<(), E>;
}

/// The most shares of a band of wavelengths that a ray stands for. With more, a few bands of a glass that spreads colours as none
/// in nature does would blur its rainbow by a percent.
const WIDEST_BAND: f64 = 2.5;

impl Sampling {
    /// Returns a sampling of `count` passes at full strength, all light followed, whose rays stand for stretches of their pixels.
    pub fn of(count: u32) -> Self {
        Self { count, strength: 1.0, by_chance: 0.0, stretches: true }
    }

    /// Returns the sample pass of a number, from 0. Passes of many numbers fill pixels and strata evenly; the first goes
    /// through the middle of pixels.
    pub fn pass(&self, scene: &Scene, strata: &Strata, number: u32) -> SamplePass {
        let bands: Vec<Stratum> = strata.of_pass(number).collect();
        let wider = if self.stretches { f64::from(strata.turns()).sqrt().min(WIDEST_BAND) } else { 1.0 };
        let medium = |stone: &Instance, s: &Stratum| {
            let (from, to) = widened(s, wider);
            scene.medium(stone, (from, 0.5 * (from + to), to))
        };
        SamplePass {
            shift: place_in_pixel(number, self.count),
            footprint: if self.stretches { stretch_of_pixel(number, self.count) } else { DVec2::ZERO },
            media: scene.instances.iter().map(|p| bands.iter().map(|s| medium(p, s)).collect()).collect(),
            metals: scene
                .metals
                .iter()
                .map(|m| bands.iter().map(|s| m.metal.index(s.at(0.5))).collect())
                .collect(),
            responses: bands.iter().map(|s| s.response).collect(),
            whole: strata.response(),
            strength: self.strength,
            number,
            by_chance: self.by_chance,
        }
    }
}

/// Returns the ends, in nm, of a range of wavelengths that is `wider` times as wide around the same middle, moved so that it does not
/// go beyond the wavelengths that are sampled.
fn widened(share: &Stratum, wider: f64) -> (f64, f64) {
    if wider <= 1.0 {
        return (share.from_nm, share.to_nm);
    }
    let (least, most) = SAMPLED_NM.into_inner();
    let half = 0.5 * wider * (share.to_nm - share.from_nm);
    let middle = share.at(0.5).clamp((least + half).min(most), (most - half).max(least));
    (middle - half, middle + half)
}

impl SamplePass {
    /// Returns the sample pass of a number, as [`Sampling::pass`] does at full strength, whose rays stand for their places in
    /// the pixels alone.
    pub fn new(scene: &Scene, strata: &Strata, number: u32) -> Self {
        Sampling { stretches: false, ..Sampling::of(1) }.pass(scene, strata, number)
    }

    /// Returns the stretch of a pixel of a film that a ray stands for, in image coordinates.
    pub fn footprint_in_image(&self, film: &Film) -> DVec2 {
        DVec2::new(self.footprint.x, -self.footprint.y) * film.pixel
    }

    /// Returns the roulette of a ray through a pixel, in one band; `None` where all light is followed.
    pub fn roulette(&self, pixel: [u32; 2], band: usize) -> Option<Roulette> {
        let number = u64::from(self.number) * self.responses.len() as u64 + band as u64;
        (self.by_chance > 0.0).then(|| Roulette::new(self.by_chance, pixel, number))
    }

    /// Returns the ray on which light is looked up.
    ///
    /// The light leaves the stones along its own ray; without any stone it would follow `straight`. The result is its own ray at full strength, and where that goes back to the eye's side; else a mixture of
    /// both.
    pub fn mixed(&self, straight: &DispersedRay, own: &DispersedRay) -> DispersedRay {
        if self.strength >= 1.0 || own.direction.dot(straight.direction) <= 0.0 {
            return *own;
        }
        let beside = straight.ahead((own.origin - straight.origin).dot(straight.direction));
        // Both go to the same side, so that a vector between them is never short.
        let between = straight.direction.lerp(own.direction, self.strength);
        let length = between.length();
        DispersedRay {
            origin: beside.origin.lerp(own.origin, self.strength),
            direction: between / length,
            fan: beside.fan.lerp(own.fan, self.strength) / length,
            shift: beside.shift.lerp(own.shift, self.strength),
        }
    }
}
