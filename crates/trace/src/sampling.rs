//! The subject of a picture under light, and the sample passes of the picture, which are the same for every tracer.

use super::DispersedRay;
use super::environment::Environment;
use super::places::{place_in_pixel, stretch_of_pixel};
use crate::ray::{RayOptions, Roulette};
use brillianteer_base::{Stopped, Watch};
use brillianteer_optics::{SAMPLED_NM, Strata, Stratum};
use brillianteer_scene::{Film, Instance, Medium, Scene, View};
use glam::{DVec2, DVec3, DVec4};
use num_complex::Complex64;
use std::ops::Range;

/// Stones and metal in one world, the environment around them, and the camera.
#[derive(Clone, Copy)]
pub struct LitScene<'a> {
    /// The stones and the metal of the picture.
    pub scene: &'a Scene,
    /// The environment around the stones.
    pub environment: Environment<'a>,
    /// The view of the camera.
    pub view: &'a View,
    /// The picture's pixels.
    pub film: Film,
    /// The limits up to which rays are followed.
    pub options: RayOptions,
}

/// A sample pass over a picture: one ray of each pixel for each band of wavelengths.
#[derive(Debug, Clone, PartialEq)]
pub struct SamplePass {
    /// The place of the ray in its pixel, 0 to 1.
    pub shift: DVec2,
    /// The stretch of its pixel that a ray represents, from one end to the other, in pixels to the right and down; 0
    /// where the ray represents one point only. The light around the stones is averaged along the stretch.
    pub footprint: DVec2,
    /// The media of the stones, with lengths in the units of their bodies: stone by stone, band by band.
    pub media: Vec<Vec<Medium>>,
    /// The complex indices of the bodies of metal: body by body, band by band.
    pub metals: Vec<Vec<Complex64>>,
    /// For each band, the colour of light with radiance 1 in each of the environment's four channels. A band is the
    /// share of a stratum that the pass represents.
    pub responses: Vec<[DVec3; 4]>,
    /// The colour of such light in all strata together. It serves for light that goes straight to the eye, which is
    /// the same at all wavelengths.
    pub whole: [DVec3; 4],
    /// The share of refraction's change of direction that is followed, 0 to 1; see [`Sampling::strength`].
    pub strength: f64,
    /// The number of the pass.
    pub number: u32,
    /// The share of each band that the pass represents.
    pub share: ShareOfPass,
    /// The weight below which light goes on by chance; see [`Sampling::by_chance`].
    pub by_chance: f64,
}

/// The share of each band that a sample pass represents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShareOfPass {
    /// The number of the pass's place, from [`Strata::place`]: the number of the share, plus `turns` for each time that all
    /// shares have been taken before.
    pub place: u32,
    /// The number of shares of each band, at least 1.
    pub turns: u32,
}

/// The parameters of the sample passes of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// The number of sample passes, at least 1.
    pub count: u32,
    /// The share of refraction's change of direction that is followed, 0 to 1; 1 is physically correct. Below 1,
    /// light that goes on away from the eye is looked up along a mixture of its own ray and the straight ray, which
    /// only serves the look of the picture.
    pub strength: f64,
    /// The share of a ray's light below which light goes on only by chance, and counts for more where it does; 0
    /// where all light is followed. It concerns packets, and single rays in double precision in solids that are not
    /// convex and between bodies and metal. Graphics cards heed it between bodies where there is
    /// metal, and follow all other light.
    pub by_chance: f64,
    /// True where each ray represents a stretch of its pixel ([`stretch_of_pixel`])
    /// and, where bands are divided into shares, up to 5 of the shares, so that a picture of few rays
    /// has fewer gaps. Otherwise it represents one point and one share.
    pub stretches: bool,
}

/// The most rays of one pixel that may wait to meet another stone.
pub const MOST_WAITING: usize = 24;

/// The light of one pixel: means over sample passes; `unresolved` and `absorbed` are means over wavelengths as well.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadiancePixel {
    /// The linear colour in sRGB's primaries; 0 beside the stones, unless rays there see the environment.
    pub colour: DVec3,
    /// The share of rays that see a body or the environment.
    pub cover: f64,
    /// The share of the light that the tracer did not follow to its end.
    pub unresolved: f64,
    /// The share of the light that was absorbed.
    pub absorbed: f64,
}

/// Returns the colour of light given by channel, where light of radiance 1 in each channel has the colours
/// `response`.
pub fn colour(response: &[DVec3; 4], light: DVec4) -> DVec3 {
    response.iter().zip(light.to_array()).map(|(&colour, light)| colour * light).sum()
}

/// The rows of a picture, which become clearer with every sample pass.
pub trait ProgressiveImage<E: From<Stopped>> {
    /// Adds one sample pass.
    ///
    /// # Errors
    /// Fails with [`Stopped`] when `watch` stops the work, or with the error of a graphics card.
    fn add_pass(&mut self, pass: &SamplePass, watch: Watch) -> Result<(), E>;

    /// Adds the sample passes of these numbers, which `pass` makes. Some tracers do what passes have in common once; the
    /// others hold one pass at a time.
    ///
    /// # Errors
    /// Fails as [`add_pass`](Self::add_pass) does.
    fn add_passes(
        &mut self,
        numbers: Range<u32>,
        pass: &dyn Fn(u32) -> SamplePass,
        watch: Watch,
    ) -> Result<(), E> {
        let all = numbers.len() as f64;
        for (done, number) in numbers.enumerate() {
            self.add_pass(&pass(number), &|part| watch((done as f64 + part) / all))?;
        }
        Ok(())
    }

    /// Calls `each` with the means of all sample passes so far, pixel by pixel.
    ///
    /// # Errors
    /// Fails with the error of a graphics card.
    fn each_pixel(&self, each: &mut dyn FnMut(&RadiancePixel)) -> Result<(), E>;
}

/// The greatest number of shares of a band of wavelengths that a ray represents. Many samples need no wider bands to have
/// little noise.
const WIDEST_BAND: f64 = 5.0;

/// The number of shares that a ray represents, as a part of the square root of the number of shares in all bands. The noise
/// of a rainbow and its blur are then about equal (docs/notes.md).
const BAND_BY_ROOT: f64 = 0.35;

impl Sampling {
    /// Returns a sampling of `count` passes at full strength, in which all light is followed and rays represent
    /// stretches of their pixels.
    pub fn of(count: u32) -> Self {
        Self { count, strength: 1.0, by_chance: 0.0, stretches: true }
    }

    /// Returns the sample pass with this number, from 0. Many passes fill pixels and strata evenly; a single pass
    /// goes through the middle of the pixels.
    pub fn pass(&self, scene: &Scene, strata: &Strata, number: u32) -> SamplePass {
        let (bands, place): (Vec<Stratum>, u32) = (strata.of_pass(number).collect(), strata.place(number));
        let wider = if self.stretches { band_in_shares(strata) } else { 1.0 };
        let medium = |stone: &Instance, s: &Stratum| {
            let (from, to) = widened(s, wider);
            scene.medium(stone, (from, 0.5 * (from + to), to))
        };
        SamplePass {
            shift: place_in_pixel(place, self.count),
            footprint: if self.stretches { stretch_of_pixel(place, self.count) } else { DVec2::ZERO },
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
            share: ShareOfPass { place, turns: strata.turns() },
            by_chance: self.by_chance,
        }
    }
}

/// Returns the number of neighbouring shares of a band that a ray represents, at least 1.
fn band_in_shares(strata: &Strata) -> f64 {
    let (shares, bands) = (f64::from(strata.turns()), strata.whole().len() as f64);
    (BAND_BY_ROOT * (shares * bands).sqrt()).min(shares.sqrt()).clamp(1.0, WIDEST_BAND)
}

/// Returns the ends, in nm, of a range of wavelengths that is `wider` times as wide around the same middle. The range
/// is moved so that it stays within the wavelengths that are sampled.
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
    /// Returns the sample pass with this number, as [`Sampling::pass`] does at full strength, but with rays that
    /// represent only their points in the pixels.
    pub fn new(scene: &Scene, strata: &Strata, number: u32) -> Self {
        Sampling { stretches: false, ..Sampling::of(1) }.pass(scene, strata, number)
    }

    /// Returns the stretch of a film's pixel that a ray represents, in image coordinates.
    pub fn footprint_in_image(&self, film: &Film) -> DVec2 {
        DVec2::new(self.footprint.x, -self.footprint.y) * film.pixel
    }

    /// Returns the roulette of a ray through a pixel, in one band; `None` where all light is followed.
    pub fn roulette(&self, pixel: [u32; 2], band: usize) -> Option<Roulette> {
        let ShareOfPass { place, turns } = self.share;
        let [whole, share] = [place / turns, place % turns].map(u64::from);
        // Rays of neighbouring wavelengths have neighbouring numbers, so that the roulette is even for any part of a
        // rainbow as well.
        let number = (whole * self.responses.len() as u64 + band as u64) * u64::from(turns) + share;
        (self.by_chance > 0.0).then(|| Roulette::new(self.by_chance, pixel, number))
    }

    /// Returns the ray along which light is looked up.
    ///
    /// The light leaves the stones along `own`; without any stone it would go on along `straight`. The result is
    /// `own` at full strength, and where `own` goes back to the eye's side; otherwise it is a mixture of both.
    pub fn mixed(&self, straight: &DispersedRay, own: &DispersedRay) -> DispersedRay {
        if self.strength >= 1.0 || own.direction.dot(straight.direction) <= 0.0 {
            return *own;
        }
        let beside = straight.ahead((own.origin - straight.origin).dot(straight.direction));
        // Both rays go to the same side, so the mixture of their directions is never short.
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

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_optics::Illuminant;

    #[test]
    fn the_roulette_is_even_over_any_part_of_the_spectrum() {
        let (bands, passes, part) = (8_usize, 32_u32, 40);
        let strata = Strata::new(bands as u32, passes, &Illuminant::D65, true);
        let sampling = Sampling { by_chance: 0.1, ..Sampling::of(passes) };
        let scene = Scene { instances: vec![], metals: vec![], unit_mm: 1.0 };
        // The wavelengths of all rays of a pixel, each with its first random number, and with that of another order.
        let mut rays: Vec<(f64, [f64; 2])> = (0..passes)
            .flat_map(|number| {
                let pass = sampling.pass(&scene, &strata, number);
                let shares: Vec<Stratum> = strata.of_pass(number).collect();
                (0..bands)
                    .map(move |band| {
                        let other = u64::from(number) * bands as u64 + band as u64;
                        let drawn = [
                            pass.roulette([3, 5], band).unwrap().draw(),
                            Roulette::new(0.1, [3, 5], other).draw(),
                        ];
                        (shares[band].from_nm, drawn)
                    })
                    .collect::<Vec<_>>()
            })
            .collect();
        rays.sort_by(|a, b| a.0.total_cmp(&b.0));
        let widest = |order: usize| {
            let gap = |rays: &[(f64, [f64; 2])]| {
                let mut drawn: Vec<f64> = rays.iter().map(|(_, drawn)| drawn[order]).collect();
                drawn.sort_by(f64::total_cmp);
                drawn.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max) * part as f64
            };
            rays.windows(part).map(gap).fold(0.0, f64::max)
        };
        assert!(widest(0) < 3.0 && widest(1) > 4.0, "{} {}", widest(0), widest(1));
    }
}
