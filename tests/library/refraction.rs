//! Checks refraction maps: places by Snell, weights by Fresnel, and pictures looked up compared with pictures traced.
#![cfg(feature = "exr")]

use crate::common::{self, maps};
use brillianteer::base::{Stopped, unwatched};
use brillianteer::io::{panorama, refraction as files};
use brillianteer::math::{Plane, Polytope};
use brillianteer::optics::{Illuminant, Material, Strata, encoded_from_linear, material};
use brillianteer::picture::{Backdrop, Carried, Linear, RefractionMap, Survey, refract, spectral};
use brillianteer::scene::{Film, Instance, Lean, Light, Mipmap, Panorama, Projection, Scene, View};
use brillianteer::trace::{
    environment::{Backplate, Environment, EnvironmentMap},
    ray::{self, ByRays},
    sampling::{LitScene, Sampling},
};
use files::Coding;
use glam::{DVec2, DVec3};
use std::ops::ControlFlow;
use std::path::Path;

/// Half a picture's side, in the image's plane, and the distance of the background.
const HALF: f64 = 1.1;
const DISTANCE: f64 = 2.5;

/// The scene, the view and the background to map.
pub(super) struct Shoot {
    pub(super) scene: Scene,
    pub(super) view: View,
    pub(super) size: [u32; 2],
    pub(super) light: Light,
    pub(super) span: f64,
    pub(super) bands: u32,
    pub(super) places: u32,
    pub(super) both_sides: bool,
    pub(super) strength: f64,
}

pub(super) fn boxed(low: DVec3, high: DVec3) -> Polytope {
    let planes =
        [DVec3::X, DVec3::Y, DVec3::Z].into_iter().zip(low.to_array().into_iter().zip(high.to_array()));
    let both = planes.flat_map(|(normal, (low, high))| {
        [Plane { normal, offset: high }, Plane { normal: -normal, offset: -low }]
    });
    Polytope::from_planes(&both.collect::<Vec<_>>()).unwrap()
}

pub(super) fn glass(index: f64) -> Material {
    Material::from_index("glass", index).unwrap()
}

pub(super) fn diamond() -> Material {
    material("diamond").unwrap().clone()
}

fn dark() -> Light {
    Light { dome: Vec::new(), ..Light::white() }
}

/// Returns a photograph in the pictures' aspect ratio: a picture by the program, which has all sorts of edges and colours.
pub(super) fn photo() -> Panorama {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/images/gallery/ring.png");
    let Panorama { width, height, pixels } = panorama::read_photo(&path).unwrap().panorama;
    // The map does not hold what rays meet outside the map's plane.
    let (across, down) = (width.min(height * 4 / 3), height.min(width * 3 / 4));
    let (left, top) = ((width - across) / 2, (height - down) / 2);
    let row = |y: u32| &pixels[((top + y) * width + left) as usize..][..across as usize];
    Panorama { width: across, height: down, pixels: (0..down).flat_map(row).copied().collect() }
}

impl Shoot {
    pub(super) fn of(solid: Polytope, material: Material) -> Self {
        Self {
            scene: Scene { instances: vec![Instance::new(solid, material)], metals: vec![], unit_mm: 3.0 },
            view: View::default(),
            size: [96, 72],
            light: dark(),
            span: 2.0,
            bands: 1,
            places: 1,
            both_sides: false,
            strength: 1.0,
        }
    }

    fn film(&self) -> Film {
        Film::new(self.size, 2.0 * HALF / f64::from(self.size[0]))
    }

    fn plane(&self) -> Backdrop {
        let near = match self.view.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective { distance } => (distance + DISTANCE) / distance,
        };
        let [width, height] = self.size.map(f64::from);
        let size = DVec2::new(width, height) * self.film().pixel * self.span * near;
        Backdrop { distance: DISTANCE, size, both_sides: self.both_sides }
    }

    /// Does work with the lit scene, with or without a photograph behind it.
    fn with_lit_scene<T>(&self, photo: Option<&Panorama>, work: impl FnOnce(&LitScene) -> T) -> T {
        let sky = EnvironmentMap::new(&self.light, None);
        let Backdrop { distance, size, .. } = self.plane();
        let levels = photo.map(|picture| Mipmap::new(picture.clone()));
        let behind = levels.as_ref().map(|levels| {
            let picture = levels.picture();
            let shape = f64::from(picture.width) / f64::from(picture.height);
            Backplate { picture: levels, distance, width: size.x.max(size.y * shape) }
        });
        let environment = Environment {
            map: &sky,
            basis: self.view.light_basis(),
            eye: self.view.basis(),
            head: 0.0,
            backplate: behind,
            backdrop: photo.is_some(),
        };
        let options = ray::RayOptions { polarised: true, most_bounces: 1000, least_weight: 1e-6 };
        work(&LitScene { scene: &self.scene, environment, view: &self.view, film: self.film(), options })
    }

    pub(super) fn map(&self) -> (RefractionMap, Carried) {
        let bands = Strata::of_middles(self.bands, &Illuminant::D65, true);
        let survey =
            Survey { bands: &bands, places: self.places, shades: &bands, passes: 1, strength: self.strength };
        self.with_lit_scene(None, |s| RefractionMap::trace(s, &self.plane(), &survey, &unwatched)).unwrap()
    }

    /// Returns the program's render with a photograph behind: one pass, through the same points at the same wavelengths.
    fn traced(&self, photo: &Panorama) -> Linear {
        let bands = Strata::of_middles(self.bands, &Illuminant::D65, true);
        let prepare = |lit_scene: &LitScene<'_>| {
            let rows = |rows| Ok::<_, Stopped>(ByRays::new(*lit_scene, rows));
            spectral::expose(
                lit_scene,
                (&bands, Sampling { stretches: false, ..Sampling::of(1) }),
                self.size[1],
                rows,
                &unwatched,
            )
            .unwrap()
            .0
        };
        self.with_lit_scene(Some(photo), prepare)
    }
}

/// Returns the peak signal-to-noise ratio, in dB, between two pictures in eight-bit codes.
pub(super) fn psnr(a: &Linear, b: &Linear) -> f64 {
    assert_eq!((a.width, a.height), (b.width, b.height));
    let code = |c: f32| (encoded_from_linear(f64::from(c).clamp(0.0, 1.0)) * 255.0).round();
    let squares = a
        .pixels
        .iter()
        .zip(&b.pixels)
        .flat_map(|(a, b)| [0, 1, 2].map(|c| (code(a[c]) - code(b[c])).powi(2)));
    let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), s| (sum + s, count + 1.0));
    10.0 * (255.0_f64.powi(2) / (sum / count).max(1e-9)).log10()
}

/// Writes a map in a coding and reads it again.
fn written(map: &RefractionMap, coding: Coding) -> RefractionMap {
    let folder = tempfile::tempdir().unwrap();
    let paths = files::paths(folder.path(), "a", map.bands.len(), coding);
    let diffuse = files::diffuse_path(folder.path(), "a");
    files::write_places(&paths, map, coding, "").unwrap();
    files::write_diffuse(&diffuse, map, "").unwrap();
    maps::read(&paths, &diffuse)
}

pub(super) fn brilliant() -> Polytope {
    let (_, path) = common::cut_files().into_iter().find(|(name, _)| name == "modern-ideal").unwrap();
    common::stone(&path).polytope
}

#[test]
fn a_tilted_slab_shifts_what_is_behind_as_snell_says() {
    // The slab is so wide that no ray of the picture meets its rim.
    let (index, thickness, tilt) = (1.5, 0.4, 35_f64.to_radians());
    let slab = boxed(DVec3::new(-9.0, -9.0, -thickness / 2.0), DVec3::new(9.0, 9.0, thickness / 2.0));
    let mut shoot = Shoot::of(slab, glass(index));
    shoot.view = View { tilt, lean: Lean::Eye, ..View::default() };
    shoot.strength = 0.4;
    let (mixed, _) = shoot.map();
    shoot.strength = 1.0;
    let (map, carried) = shoot.map();
    // Parallel rays are shifted by d sin i (1 - cos i / (n cos t)), against the side that the eye has moved to. Of a mixture with
    // the straight ray, they are shifted by the strength times that.
    let (sin, cos) = tilt.sin_cos();
    let cos_t = (1.0 - (sin / index).powi(2)).sqrt();
    let shift = thickness * sin * (1.0 - cos / (index * cos_t));
    let basis = shoot.view.basis();
    let along = basis.project(DVec3::Z);
    let along = along / along.length();
    let plane = shoot.plane();
    let mut worst = 0.0_f64;
    let places = |map: &RefractionMap| map.bands[0].places.clone().into_iter().enumerate();
    let all = places(&map).map(|found| (found, 1.0)).chain(places(&mixed).map(|found| (found, 0.4)));
    for ((k, place), strength) in all {
        let (x, y, shift) = (k % 96, k / 96, shift * strength);
        let at = shoot.film().image_from_pixels(DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
        let expected = (at - along * shift) * DVec2::new(1.0, -1.0) / plane.size + 0.5;
        let other = (at + along * shift) * DVec2::new(1.0, -1.0) / plane.size + 0.5;
        let found = DVec2::new(f64::from(place.u), f64::from(place.v));
        assert!((found - other).length() > 0.01, "the shift is told from its contrary");
        worst = (found - expected).abs().max_element().max(worst);
    }
    assert!(worst < 1e-6, "{worst}");
    // Of all light that passes, (1 - R) / (1 + R) for each polarisation, the first path carries (1 - R)².
    let reflected = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    let both = [reflected(cos, index * cos_t), reflected(index * cos, cos_t)];
    let mean = |part: fn(f64) -> f64| (part(both[0]) + part(both[1])) / 2.0;
    let (all, first) = (mean(|r| (1.0 - r) / (1.0 + r)), mean(|r| (1.0 - r).powi(2)));
    assert!((carried.behind - all).abs() < 1e-4, "{} is not {all}", carried.behind);
    assert!((carried.single - first / all).abs() < 1e-4, "{} is not {}", carried.single, first / all);
}

#[test]
fn a_pixel_beside_the_stone_shows_what_is_straight_behind_it() {
    for projection in [Projection::Orthographic, Projection::Perspective { distance: 6.0 }] {
        let mut shoot = Shoot::of(boxed(DVec3::splat(-0.1), DVec3::splat(0.1)), glass(1.5));
        (shoot.view.projection, shoot.span) = (projection, 3.0);
        let (map, _) = shoot.map();
        let place = map.bands[0].places[96 * 10 + 20];
        let expected = (DVec2::new(20.5 / 96.0, 10.5 / 72.0) - 0.5) / 3.0 + 0.5;
        assert!(
            (f64::from(place.u) - expected.x).abs() < 1e-7 && (f64::from(place.v) - expected.y).abs() < 1e-7
        );
        assert_eq!((place.weight, map.diffuse.pixels[96 * 10 + 20]), (1.0, [0.0; 4]));
    }
}

#[test]
fn refracting_by_the_map_is_tracing_to_40_db() {
    let photo = photo();
    let cube = boxed(DVec3::splat(-0.6), DVec3::splat(0.6));
    let leaning = View { tilt: 0.5, azimuth: 0.6, ..View::default() };
    let from_near = View { projection: Projection::Perspective { distance: 5.0 }, ..leaning };
    let thin = || boxed(DVec3::new(-0.9, -0.7, -0.1), DVec3::new(0.9, 0.7, 0.1));
    for (name, solid, view, material) in [
        ("a plate", thin(), leaning, glass(1.5)),
        ("a plate from near by", thin(), from_near, glass(1.5)),
        ("a cube", cube.clone(), leaning, glass(1.5)),
        ("a cube from near by", cube, from_near, glass(1.5)),
        ("a diamond", brilliant(), View::default(), diamond()),
        ("a diamond from near by", brilliant(), from_near, diamond()),
    ] {
        // From near by a pixel may show two places, of which a map of one place loses one. A map of four places loses
        // little but through its coding.
        let alone = if view == from_near { 29.0 } else { 40.0 };
        for (bands, places, least) in [(1, 1, alone), (5, 1, alone), (1, 2, 40.0), (5, 2, 40.0), (1, 4, 45.0)]
        {
            let shoot = Shoot { view, bands, places, ..Shoot::of(solid.clone(), material.clone()) };
            let (map, _) = shoot.map();
            let (own, traced) = (refract(&map, &photo, DVec2::ZERO), shoot.traced(&photo));
            for coding in [Coding::Tiles, Coding::Sixteen, Coding::Float] {
                let found = refract(&written(&map, coding), &photo, DVec2::ZERO);
                let (to_map, to_all) = (psnr(&found, &own), psnr(&found, &traced));
                let case = format!("{name}, {bands} bands, {places} places, {coding:?}");
                assert!(to_map >= 40.0 && to_all >= least, "{case}: {to_map} and {to_all}");
            }
        }
    }
}

#[test]
fn a_white_background_and_a_white_light_leave_no_trace_of_a_clear_stone() {
    let white = Panorama { width: 3, height: 2, pixels: vec![[1.0; 3]; 6] };
    for both_sides in [false, true] {
        let mut shoot = Shoot::of(brilliant(), diamond());
        (shoot.light, shoot.bands, shoot.both_sides) = (Light::white(), 3, both_sides);
        let (map, carried) = shoot.map();
        for pixel in refract(&map, &white, DVec2::ZERO).pixels {
            assert!(pixel[..3].iter().all(|c| (c - 1.0).abs() < 1e-3), "{pixel:?}");
        }
        // Face up, a brilliant sends back nearly all.
        assert_eq!(carried.behind > 0.3, both_sides, "{carried:?}");
    }
}

#[test]
fn bands_keep_the_rainbow_and_one_band_has_none() {
    // A prism of strong dispersion in front of a white line on black.
    let planes = [(DVec3::new(0.0, 0.28, 0.96), 0.3), (DVec3::new(0.0, 0.0, -1.0), 0.3), (DVec3::NEG_Y, 0.9)];
    let sides = [DVec3::X, DVec3::NEG_X].map(|n| (n, 0.9));
    let planes: Vec<Plane> =
        planes.into_iter().chain(sides).map(|(normal, offset)| Plane { normal, offset }).collect();
    let prism = Polytope::from_planes(&planes).unwrap();
    let lit = |y: u32| [f32::from(u8::from((y / 20) % 2 == 1)); 3];
    let lines = Panorama { width: 640, height: 480, pixels: (0..640 * 480).map(|k| lit(k / 640)).collect() };
    let colour = |bands| {
        let mut shoot = Shoot { bands, ..Shoot::of(prism.clone(), diamond()) };
        shoot.span = 4.0;
        let picture = refract(&shoot.map().0, &lines, DVec2::ZERO);
        let spread = |p: &[f32; 4]| {
            p[..3].iter().copied().fold(0.0, f32::max) - p[..3].iter().copied().fold(1.0, f32::min)
        };
        picture.pixels.iter().map(spread).fold(0.0, f32::max)
    };
    let (one, many) = (colour(1), colour(8));
    assert!(one < 1e-5 && many > 0.2, "{one}, {many}");
}

#[test]
fn a_background_that_moves_is_seen_moving_and_mirrored_beyond_its_border() {
    // The stone is outside the picture, which shows the photograph alone.
    let mut shoot = Shoot::of(boxed(DVec3::splat(8.0), DVec3::splat(8.1)), glass(1.5));
    shoot.span = 1.0;
    let (map, _) = shoot.map();
    let ramp =
        Panorama { width: 96, height: 72, pixels: (0..96 * 72).map(|k| [(k % 96) as f32; 3]).collect() };
    for (offset, first, last) in [(0.0, 0.0, 95.0), (0.25, 24.0, 72.0), (1.0, 95.0, 0.0), (-2.0, 0.0, 95.0)] {
        let row = &refract(&map, &ramp, DVec2::new(offset, 0.0)).pixels[96 * 30..96 * 31];
        assert!((row[0][0] - first).abs() < 1e-3 && (row[95][0] - last).abs() < 1e-3, "{offset}");
    }
}

#[test]
fn a_map_is_the_same_every_time_and_can_be_stopped() {
    let shoot = Shoot::of(brilliant(), diamond());
    assert_eq!(shoot.map(), shoot.map());
    let bands = Strata::new(1, 1, &Illuminant::D65, true);
    let survey = Survey { bands: &bands, places: 1, shades: &bands, passes: 1, strength: 1.0 };
    let stop = |part: f64| if part > 0.3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let stopped = shoot.with_lit_scene(None, |s| RefractionMap::trace(s, &shoot.plane(), &survey, &stop));
    assert_eq!(stopped.err(), Some(Stopped));
}
