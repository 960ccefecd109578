//! What a picture under light is taken of, and the looks that it is made from: the same for every tracer.

use super::environment::Environment;
use super::{Stopped, Watch};
use crate::math::Solid;
use crate::optics::Stratum;
use crate::scene::{Film, Instance, Medium, Scene, View};
use crate::trace::ray::RayOptions;
use glam::{DVec2, DVec3};

/// Stones in one world, what stands around them, and the camera.
#[derive(Clone, Copy)]
pub struct LitScene<'a> {
    /// The stones.
    pub scene: &'a Scene,
    /// What stands around.
    pub environment: Environment<'a>,
    /// From where they are seen.
    pub view: &'a View,
    /// The picture's pixels.
    pub film: Film,
    /// How far rays are followed.
    pub options: RayOptions,
}

/// One ray of each pixel for each band of wavelengths.
#[derive(Debug, Clone, PartialEq)]
pub struct SamplePass {
    /// Where in its pixel the ray stands, 0 to 1.
    pub shift: DVec2,
    /// Where in its band the wavelength stands that is taken, 0 to 1.
    pub part: f64,
    /// What the stones are made of: stone by stone, band by band.
    pub media: Vec<Vec<Medium>>,
    /// For each band the colour of light of radiance 1 in the surround's four channels.
    pub responses: Vec<[DVec3; 4]>,
    /// How much of the way that refraction turns light is followed, 0 to 1; see [`Sampling::strength`].
    pub strength: f64,
}

/// How the looks of a picture are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// How many, at least 1.
    pub count: u32,
    /// Whether each takes other wavelengths, so that together they are a whole spectrum; else all take the middles of their
    /// bands.
    pub jitter: bool,
    /// How much of the way that refraction turns light is followed, 0 to 1: 1 is physics. Below, light that goes on away
    /// from the eye is looked up on a mixture of its own ray and the straight one, for its looks.
    pub strength: f64,
}

/// Rays of one pixel that may wait to meet another stone.
pub const MOST_WAITING: usize = 24;

/// What light shows of one pixel: means over looks; the last two over wavelengths as well.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadiancePixel {
    /// Linear colour, sRGB's primaries; 0 beside the stones unless the surround is the backdrop.
    pub colour: DVec3,
    /// The share of rays that see anything.
    pub cover: f64,
    /// Share of the light not followed to its end.
    pub unresolved: f64,
    /// Share absorbed.
    pub absorbed: f64,
}

/// Rows of a picture that grow clearer with every look.
pub trait ProgressiveImage<E: From<Stopped>> {
    /// Adds one look.
    ///
    /// # Errors
    /// [`Stopped`] when `watch` asks to stop, or what is wrong with a card.
    fn add_pass(&mut self, look: &SamplePass, watch: Watch) -> Result<(), E>;

    /// Calls `each` with what has been seen so far, pixel by pixel.
    ///
    /// # Errors
    /// What is wrong with a card.
    fn each_pixel(&self, each: &mut dyn FnMut(&RadiancePixel)) -> Result<(), E>;
}

/// The steps of M. Roberts' R3 sequence (2018), powers of 1/1.2207...: points of it are spread evenly over a cube however
/// many are taken. It is not random, so that pictures repeat.
const STEPS: DVec3 = DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3);

impl Sampling {
    /// So many looks at what is there, each at other wavelengths.
    pub fn of(count: u32) -> Self {
        Self { count, jitter: true, strength: 1.0 }
    }

    /// The look of a number, from 0: looks of many numbers fill pixels and strata evenly. The first is through the middle
    /// of both.
    pub fn pass(&self, setting: &Scene, strata: &[Stratum], number: u32) -> SamplePass {
        let mut at = (STEPS * f64::from(number) + 0.5).fract();
        if !self.jitter {
            at.z = 0.5;
        }
        let band = |s: &Stratum| (s.from_nm, s.at(at.z), s.to_nm);
        let medium = |stone: &Instance, s: &Stratum| Medium::of(&stone.material, band(s), setting.unit_mm);
        SamplePass {
            shift: at.truncate(),
            part: at.z,
            media: setting.instances.iter().map(|p| strata.iter().map(|s| medium(p, s)).collect()).collect(),
            responses: strata.iter().map(|s| s.response).collect(),
            strength: self.strength,
        }
    }
}

impl SamplePass {
    /// The look of a number at what is there, as [`Sampling::pass`].
    pub fn new(setting: &Scene, strata: &[Stratum], number: u32) -> Self {
        Sampling::of(1).pass(setting, strata, number)
    }

    /// The direction for which a ray stands that leaves in `direction`, at the wavelength taken: that of the middle of its
    /// band, around which `sweep` reaches half to either side.
    pub fn middle(&self, direction: DVec3, sweep: DVec3) -> DVec3 {
        direction + sweep * (0.5 - self.part)
    }

    /// The ray on which light is looked up that goes on as `ray` (its point, unit direction and sweep) where without any
    /// stone it would go as `straight` (a point and the unit direction): itself at full strength, and when it goes back to
    /// the eye's side; else the mixture of both.
    pub fn mixed(
        &self,
        straight: (DVec3, DVec3),
        (from, direction, sweep): (DVec3, DVec3, DVec3),
    ) -> (DVec3, DVec3, DVec3) {
        if self.strength >= 1.0 || direction.dot(straight.1) <= 0.0 {
            return (from, direction, sweep);
        }
        let beside = straight.0 + straight.1 * (from - straight.0).dot(straight.1);
        // Both go the same way, so that what is between them is never short.
        let between = straight.1.lerp(direction, self.strength);
        let length = between.length();
        (beside.lerp(from, self.strength), between / length, sweep * (self.strength / length))
    }
}

impl LitScene<'_> {
    /// A ball around each stone.
    pub fn balls(&self) -> Vec<(DVec3, f64)> {
        let ball = |stone: &Solid| {
            let (low, high) = stone.bounds();
            let middle = (low + high) / 2.0;
            let radius = stone.vertices().iter().map(|v| v.distance(middle)).fold(0.0, f64::max);
            // A hair more, for rounding.
            (middle, radius * (1.0 + 1e-5))
        };
        self.solids().map(ball).collect()
    }

    /// The stones' solids.
    pub fn solids(&self) -> impl Iterator<Item = &Solid> {
        self.scene.instances.iter().map(|s| &s.solid)
    }

    /// How far the stones reach from the origin.
    pub fn reach(&self) -> f64 {
        self.solids().flat_map(Solid::vertices).map(|v| v.length()).fold(0.0, f64::max)
    }
}
