//! Pictures under light, by every tracer.
#![allow(dead_code, reason = "each test uses its part")]

use brillianteer::math::{Polytope, Solid};
use brillianteer::optics::{material, strata};
use brillianteer::picture::spectral::{Remainder, expose_in};
use brillianteer::picture::{ByBeams, Linear};
use brillianteer::scene::{Film, Light, Panorama, Placed, Setting, View};
use brillianteer::trace::beam;
#[cfg(feature = "gpu")]
use brillianteer::trace::gpu::{Around, ByCard, Gpu, GpuError};
use brillianteer::trace::ray::{ByRays, Options};
use brillianteer::trace::sitting::{Looks, Sitting};
use brillianteer::trace::surround::{Behind, Sky, Surround};
use brillianteer::trace::{Stopped, unwatched};
use glam::{DVec2, DVec3};

pub const SIZE: u32 = 64;

/// A picture to take.
pub struct Shoot {
    pub setting: Setting,
    pub light: Light,
    pub view: View,
    pub wavelengths: u32,
    pub samples: u32,
    /// How much of the way that refraction turns light is followed.
    pub strength: f64,
    pub backdrop: bool,
    /// A photograph behind, and how far.
    pub photo: Option<(Panorama, f64)>,
    pub options: Options,
    /// Pixels across and down.
    pub size: u32,
    /// The point in the picture's middle.
    pub centre: DVec2,
}

impl Shoot {
    pub fn new(polytope: &Polytope, material_name: &str, light: Light) -> Self {
        Self::of(polytope.clone(), material_name, light)
    }

    pub fn of(solid: impl Into<Solid>, material_name: &str, light: Light) -> Self {
        let stone = Placed::new(solid, material(material_name).unwrap().clone());
        Self {
            setting: Setting { stones: vec![stone], unit_mm: 3.25 },
            light: Light { head: 0.0, ..light },
            view: View { tilt: 0.2, azimuth: 0.4, ..View::default() },
            wavelengths: 8,
            samples: 1,
            strength: 1.0,
            backdrop: true,
            photo: None,
            options: Options { polarised: true, most_bounces: 64, least_weight: 1e-4 },
            centre: DVec2::ZERO,
            size: SIZE,
        }
    }

    pub fn with<T>(&self, work: impl FnOnce(&Sitting) -> T) -> T {
        let sky = Sky::new(&self.light, None);
        let eye = self.view.basis();
        let surround = Surround {
            sky: &sky,
            basis: self.view.light_basis(),
            eye,
            head: self.light.head.to_radians(),
            behind: self.photo.as_ref().map(|(picture, distance)| Behind {
                picture,
                distance: *distance,
                width: 3.0,
            }),
            backdrop: self.backdrop,
        };
        work(&Sitting {
            setting: &self.setting,
            surround,
            view: &self.view,
            film: Film { centre: self.centre, ..Film::square(self.size, 1.1) },
            options: self.options,
        })
    }

    fn looks(&self) -> Looks {
        Looks { strength: self.strength, ..Looks::of(self.samples) }
    }

    pub fn by_rays(&self) -> (Linear, Remainder) {
        let strata = strata(self.wavelengths, &self.light.spectrum, true);
        self.with(|sitting| {
            let prepare = |rows| Ok::<_, Stopped>(ByRays::new(*sitting, rows));
            expose_in(sitting, (&strata, self.looks()), self.size, prepare, &unwatched).unwrap()
        })
    }

    pub fn by_beams(&self) -> (Linear, Remainder) {
        self.by_beams_in(self.size)
    }

    /// So many rows at a time.
    pub fn by_beams_in(&self, rows: u32) -> (Linear, Remainder) {
        let strata = strata(self.wavelengths, &self.light.spectrum, true);
        let options = beam::Options { unresolved: 1e-3, ..beam::Options::default() };
        self.with(|sitting| {
            let prepare = |rows| Ok::<_, Stopped>(ByBeams::of_rows(*sitting, options, rows).unwrap());
            expose_in(sitting, (&strata, self.looks()), rows, prepare, &unwatched).unwrap()
        })
    }

    #[cfg(feature = "gpu")]
    pub fn by_card(&self, gpu: &Gpu) -> (Linear, Remainder) {
        let strata = strata(self.wavelengths, &self.light.spectrum, true);
        self.with(|sitting| {
            let around = Around::new(gpu, &sitting.surround);
            let prepare = |rows| Ok::<_, Failed>(ByCard::new(gpu, sitting, &around, rows, strata.len())?);
            // A strip at a time, as large pictures are taken.
            expose_in(sitting, (&strata, self.looks()), 40, prepare, &unwatched).unwrap()
        })
    }
}

pub fn colour(pixel: &[f32; 4]) -> DVec3 {
    DVec3::new(f64::from(pixel[0]), f64::from(pixel[1]), f64::from(pixel[2]))
}

/// Means of 8 x 8 pixels.
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

/// The largest difference of any block's mean, as a part of full scale: the brightest block.
#[cfg(feature = "gpu")]
pub fn differ(shoot: &Shoot, twin: &Shoot, gpu: &Gpu) -> f64 {
    apart(&shoot.by_rays().0, &twin.by_card(gpu).0)
}

/// The same of two pictures that were taken.
pub fn apart(exact: &Linear, card: &Linear) -> f64 {
    let (exact, card) = (blocks(exact), blocks(card));
    let scale = exact.iter().map(|b| b.max_element()).fold(0.0, f64::max);
    exact.iter().zip(&card).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max) / scale
}
