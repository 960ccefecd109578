//! Takes pictures under light by every tracer.

use brillianteer::base::{Stopped, unwatched};
use brillianteer::math::Polytope;
use brillianteer::optics::{Strata, material};
use brillianteer::picture::{
    ByBeams, Linear,
    spectral::{Remainder, expose, seen},
};
use brillianteer::scene::{Body, Film, Instance, Light, Mipmap, Panorama, Scene, View};
#[cfg(feature = "gpu")]
use brillianteer::trace::gpu::{ByCard, Gpu, GpuEnvironment, GpuError};
use brillianteer::trace::{
    beam,
    environment::{Backplate, Environment, EnvironmentMap},
    ray::{ByRays, RayOptions},
    sampling::{LitScene, Sampling},
};
use glam::{DVec2, DVec3};

pub const SIZE: u32 = 64;

/// A picture to take.
pub struct Shoot {
    pub scene: Scene,
    pub light: Light,
    pub view: View,
    pub wavelengths: u32,
    pub samples: u32,
    /// The number of shares into which each band of wavelengths is divided.
    pub shares: u32,
    /// The share of refraction's change of direction that is followed; 1 is physically correct.
    pub strength: f64,
    /// The weight below which light goes on only by chance; 0 where all light is followed.
    pub by_chance: f64,
    /// True where rays represent stretches of their pixels.
    pub stretches: bool,
    pub backdrop: bool,
    /// A photograph behind the stones, and its distance.
    pub photo: Option<(Panorama, f64)>,
    pub options: RayOptions,
    /// Pixels across and down.
    pub size: u32,
    /// The point in the picture's middle.
    pub centre: DVec2,
}

impl Shoot {
    pub fn new(polytope: &Polytope, material_name: &str, light: Light) -> Self {
        Self::of(polytope.clone(), material_name, light)
    }

    pub fn of(body: impl Into<Body>, material_name: &str, light: Light) -> Self {
        Self::of_stone(Instance::new(body, material(material_name).unwrap().clone()), light)
    }

    pub fn of_stone(stone: Instance, light: Light) -> Self {
        Self {
            scene: Scene { instances: vec![stone], metals: vec![], unit_mm: 3.25 },
            light: Light { head: 0.0, ..light },
            view: View { tilt: 0.2, azimuth: 0.4, ..View::default() },
            wavelengths: 8,
            samples: 1,
            shares: 1,
            strength: 1.0,
            by_chance: 0.0,
            stretches: true,
            backdrop: true,
            photo: None,
            options: RayOptions { polarised: true, most_bounces: 64, least_weight: 1e-4 },
            centre: DVec2::ZERO,
            size: SIZE,
        }
    }

    pub fn with<T>(&self, work: impl FnOnce(&LitScene) -> T) -> T {
        let sky = EnvironmentMap::new(&self.light, None);
        let photo = self.photo.as_ref().map(|(picture, distance)| (Mipmap::new(picture.clone()), *distance));
        let eye = self.view.basis();
        let environment = Environment {
            map: &sky,
            basis: self.view.light_basis(),
            eye,
            head: self.light.head.to_radians(),
            backplate: photo.as_ref().map(|(picture, distance)| Backplate {
                picture,
                distance: *distance,
                width: 3.0,
            }),
            backdrop: self.backdrop,
        };
        work(&LitScene {
            scene: &self.scene,
            environment,
            view: &self.view,
            film: Film { centre: self.centre, ..Film::square(self.size, 1.1) },
            options: self.options,
        })
    }

    /// Returns the strata, of which each sample pass sees one share after the other.
    fn strata(&self) -> Strata {
        Strata::new(self.wavelengths, self.shares, &self.light.spectrum, true)
    }

    fn sampling(&self) -> Sampling {
        let Self { strength, by_chance, stretches, .. } = *self;
        Sampling { strength, by_chance, stretches, ..Sampling::of(self.samples) }
    }

    /// Traces the picture by single rays in double precision.
    pub fn by_rays(&self) -> (Linear, Remainder) {
        let strata = self.strata();
        self.with(|lit_scene| {
            let prepare = |rows| Ok::<_, Stopped>(ByRays::in_f64(*lit_scene, rows));
            expose(lit_scene, (&strata, self.sampling()), self.size, prepare, &unwatched).unwrap()
        })
    }

    /// Traces the picture by packets of rays in single precision.
    pub fn by_packets(&self) -> (Linear, Remainder) {
        let strata = self.strata();
        self.with(|lit_scene| {
            let prepare = |rows| Ok::<_, Stopped>(ByRays::new(*lit_scene, rows));
            expose(lit_scene, (&strata, self.sampling()), self.size, prepare, &unwatched).unwrap()
        })
    }

    pub fn by_beams(&self) -> (Linear, Remainder) {
        self.by_beams_in(self.size)
    }

    /// Traces the picture by exact beams, `rows` rows at a time.
    pub fn by_beams_in(&self, rows: u32) -> (Linear, Remainder) {
        let strata = self.strata();
        let options = beam::BeamOptions { unresolved: 1e-3, ..beam::BeamOptions::default() };
        self.with(|lit_scene| {
            let prepare = |rows| Ok::<_, Stopped>(ByBeams::of_rows(*lit_scene, options, rows).unwrap());
            expose(lit_scene, (&strata, self.sampling()), rows, prepare, &unwatched).unwrap()
        })
    }

    /// Traces the picture by exact beams, which wavelengths share unless they are traced apart.
    pub fn by_beams_of(&self, options: beam::BeamOptions, is_apart: bool) -> (Linear, Remainder) {
        let strata = self.strata();
        self.with(|lit_scene| {
            let prepare = |rows| {
                let image = ByBeams::of_rows(*lit_scene, options, rows).unwrap();
                Ok::<_, Stopped>(if is_apart { image.apart() } else { image })
            };
            expose(lit_scene, (&strata, self.sampling()), self.size, prepare, &unwatched).unwrap()
        })
    }

    /// Traces the picture by the exact beams of the middle wavelength alone.
    pub fn glanced(&self) -> (Linear, Remainder) {
        let strata = self.strata();
        let options = beam::BeamOptions { unresolved: 1e-3, ..beam::BeamOptions::default() };
        self.with(|lit_scene| {
            let mut image = ByBeams::new(*lit_scene, options).unwrap();
            image.glance(strata.whole(), &unwatched).unwrap();
            seen::<Stopped, _>(lit_scene, &image).unwrap()
        })
    }

    #[cfg(feature = "gpu")]
    pub fn by_card(&self, gpu: &Gpu) -> (Linear, Remainder) {
        let strata = self.strata();
        self.with(|lit_scene| {
            let around = GpuEnvironment::new(gpu, &lit_scene.environment).unwrap();
            let prepare =
                |rows| Ok::<_, Failed>(ByCard::new(gpu, lit_scene, &around, rows, strata.whole().len())?);
            // The picture is traced in strips, as large pictures are.
            expose(lit_scene, (&strata, self.sampling()), 40, prepare, &unwatched).unwrap()
        })
    }
}

pub fn colour(pixel: &[f32; 4]) -> DVec3 {
    DVec3::new(f64::from(pixel[0]), f64::from(pixel[1]), f64::from(pixel[2]))
}

/// Returns the means of blocks of 8 x 8 pixels.
pub fn blocks(picture: &Linear) -> Vec<DVec3> {
    let (across, down) = (picture.width / 8, picture.height / 8);
    let mean = |k: u32| {
        let pixels = (0..64).map(|p| (k / across * 8 + p / 8) * picture.width + k % across * 8 + p % 8);
        pixels.map(|at| colour(&picture.pixels[at as usize])).sum::<DVec3>() / 64.0
    };
    (0..across * down).map(mean).collect()
}

#[cfg(feature = "gpu")]
#[derive(Debug)]
#[expect(dead_code, reason = "what went wrong is printed by its Debug")]
pub struct Failed(String);

#[cfg(feature = "gpu")]
impl From<GpuError> for Failed {
    fn from(error: GpuError) -> Self {
        Self(error.to_string())
    }
}

#[cfg(feature = "gpu")]
impl From<Stopped> for Failed {
    fn from(error: Stopped) -> Self {
        Self(error.to_string())
    }
}

/// Returns the largest difference of a block's mean between rays and card, as a fraction of the brightest block.
#[cfg(feature = "gpu")]
pub fn differ(shoot: &Shoot, twin: &Shoot, gpu: &Gpu) -> f64 {
    apart(&shoot.by_rays().0, &twin.by_card(gpu).0)
}

/// Returns the largest difference of a block's mean between two pictures, as a fraction of the brightest block.
pub fn apart(exact: &Linear, card: &Linear) -> f64 {
    differences(exact, card)[0]
}

/// Returns the differences of all blocks' means between two pictures, the largest first, as fractions of the brightest block.
pub fn differences(exact: &Linear, card: &Linear) -> Vec<f64> {
    let (exact, card) = (blocks(exact), blocks(card));
    let scale = exact.iter().map(|b| b.max_element()).fold(0.0, f64::max);
    let each = exact.iter().zip(&card).map(|(a, b)| (*a - *b).abs().max_element() / scale);
    let mut all: Vec<f64> = each.collect();
    all.sort_by(|a, b| b.total_cmp(a));
    all
}
