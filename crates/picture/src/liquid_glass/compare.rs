//! Traces the pane as a real body of glass, and measures the error of the approximation.
//!
//! The body is a slab of glass with the pane's outline and both edges rolled around. It lies a little above the
//! background and is seen along parallel rays. The strengths mean: depth is the thickness, as in the specification;
//! refraction is the index, 1 at 0 and 1.5 at 100; dispersion is the Abbe number, 55 at 100. Frost is left out, since
//! rough surfaces are not traced. The tint colours the light around the traced pane, as it colours that of the drawn one.

mod cost;

pub use cost::{Cost, Shifts};

use super::parts::thickness;
use super::prepared::laid;
use super::{GlassPane, pane as approximated, plain};
use crate::{Backdrop, Linear, RefractionMap, Survey, spectral};
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::{ImplicitForm, ImplicitSurface, ImplicitSurfaceError, Pose};
use brillianteer_optics::{Dispersion, DispersionError, Illuminant, Material, Strata, encoded_from_linear};
use brillianteer_scene::{Dome, Film, Instance, Lamp, Light, Mipmap, Panorama, Scene, View};
use brillianteer_trace::environment::{Backplate, Environment, EnvironmentMap};
use brillianteer_trace::ray::{ByRays, RayOptions};
use brillianteer_trace::sampling::{LitScene, Sampling};
use cost::Sums;
use glam::DVec2;

/// The index at strength 100, less 1.
const INDEX: f64 = 0.5;
/// The Abbe number at strength 100.
const ABBE: f64 = 55.0;

/// Share of light that glass of index 1.5 reflects at normal incidence.
const SQUARE_ON: f64 = 0.04;

/// The conditions under which a pane is traced.
#[derive(Debug, Clone, Copy)]
pub struct PaneLighting<'a> {
    /// The environment around the pane.
    pub map: &'a EnvironmentMap,
    /// Distance between pane and background, as a part of the pane's shorter side, above 0.
    pub gap: f64,
    /// The bands of wavelengths that are traced.
    pub strata: &'a Strata,
    /// The number of sample passes of both pictures, at least 1.
    pub passes: u32,
}

/// A drawn pane, the same pane traced, and their difference.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The drawn pane, of as many sample passes as the traced one.
    pub pane: Linear,
    /// The traced pane.
    pub traced: Linear,
    /// The difference between the two.
    pub cost: Cost,
}

/// The reasons why a pane cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PaneError {
    /// The pane covers no pixel of the picture.
    #[error(
        "the pane covers nothing of the picture: give it a place within, 1 pixel or more each way, and corners no \
        rounder than half of its shorter side"
    )]
    Nowhere,
    /// The pane's size and depth make no valid body.
    #[error(transparent)]
    Body(#[from] ImplicitSurfaceError),
    /// The strengths of refraction and dispersion make no valid glass.
    #[error(transparent)]
    Glass(#[from] DispersionError),
    /// The watch stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Returns the light that corresponds to a pane's light and tint.
///
/// It consists of a lamp, which glass shows about as bright and as large as the specification's shine, and an even sky,
/// which shows at the rim as bright as the specification's rim. Glass has no counterpart of the specification's Lambert
/// term. The tint colours both as far as it covers them.
pub fn surroundings(pane: &GlassPane) -> Light {
    let pane = pane.effective();
    let part = pane.light / 100.0;
    let colour = (pane.tint.w > 0.0).then(|| {
        pane.light_colour().to_array().map(|part| (255.0 * encoded_from_linear(part)).round() as u8)
    });
    let sky = Dome { from: -90.0, to: 90.0, soft: 0.0, radiance: 0.3 * part, end: None, colour };
    let lamp = Lamp {
        azimuth: pane.light_from.azimuth,
        elevation: pane.light_from.height,
        // A mirror turned by an angle turns light by twice that; cos³² is a half at 12 degrees.
        radius: 24.0,
        radiance: 0.5 * part / SQUARE_ON,
        colour,
    };
    Light { name: "pane".into(), dome: vec![sky], lamp: vec![lamp], ..Light::white() }
}

/// Draws and traces the pane before the background, which is as large as the picture, and compares the two.
///
/// # Errors
/// Fails with a [`PaneError`] that names the fault of the pane, or [`PaneError::Stopped`] when `watch` stops the
/// work.
pub fn compare(
    pane: &GlassPane,
    background: &Panorama,
    around: &PaneLighting,
    watch: Watch,
) -> Result<Comparison, PaneError> {
    let scene = PaneScene::new(pane, background)?;
    let half = |done: f64| move |part: f64| watch(done + part / 2.0);
    let plane = Backdrop { distance: scene.distance(around.gap), size: scene.size, both_sides: false };
    let strata = |count| Strata::new(count, 1, &Illuminant::D65, true);
    let survey = Survey { bands: &strata(3), places: 1, shades: &strata(0), passes: 1, strength: 1.0 };
    let behind = Mipmap::new(background.clone());
    let (map, carried) = scene.with_lit_scene(&behind, around, |lit_scene| {
        RefractionMap::trace(lit_scene, &plane, &survey, &half(0.0))
    })?;
    let traced = scene.traced(&behind, around, &half(0.5))?;
    let pane = approximated(pane, background, around.passes);
    let cost = Cost { behind: carried.behind, ..scene.cost(&map, &pane, &traced) };
    Ok(Comparison { pane, traced, cost })
}

/// Traces the pane before the background, without a comparison.
///
/// # Errors
/// Fails with a [`PaneError`] that names the fault of the pane, or [`PaneError::Stopped`] when `watch` stops the
/// work.
pub fn traced(
    pane: &GlassPane,
    background: &Panorama,
    around: &PaneLighting,
    watch: Watch,
) -> Result<Linear, PaneError> {
    let scene = PaneScene::new(pane, background)?;
    Ok(scene.traced(&Mipmap::new(background.clone()), around, watch)?)
}

/// The pane as a body, in a world whose unit is the pane's shorter side and whose origin is the picture's middle.
struct PaneScene<'a> {
    pane: &'a GlassPane,
    scene: Scene,
    /// Width and height of the whole picture.
    size: DVec2,
    thickness: f64,
    /// The first pixel of the picture that is traced, across and down.
    first: [u32; 2],
    /// The number of pixels that are traced, across and down.
    count: [u32; 2],
    film: Film,
}

impl<'a> PaneScene<'a> {
    fn new(pane: &'a GlassPane, background: &Panorama) -> Result<Self, PaneError> {
        if !pane.is_somewhere() {
            return Err(PaneError::Nowhere);
        }
        let (strengths, unit) = (pane.effective(), pane.unit());
        let whole = DVec2::new(f64::from(background.width), f64::from(background.height));
        let low = (pane.corner - 1.0).floor().clamp(DVec2::ZERO, whole);
        let high = (pane.corner + pane.size + 1.0).ceil().clamp(DVec2::ZERO, whole);
        let (first, count) = (low.as_uvec2().to_array(), (high - low).as_uvec2().to_array());
        if count.contains(&0) {
            return Err(PaneError::Nowhere);
        }
        let up = DVec2::new(1.0, -1.0) / unit;
        let middle = (pane.corner + pane.size / 2.0 - whole / 2.0) * up;
        let thickness = thickness(strengths.depth);
        let mut stones = Vec::new();
        if thickness > 0.0 {
            let corner = pane.radius / unit;
            let size = (pane.size / unit).extend(thickness);
            let body =
                ImplicitSurface::new(ImplicitForm::Pane { size, corner, edge: corner.min(thickness / 2.0) })?;
            let glass = glass(strengths.refraction, strengths.dispersion)?;
            stones.push(Instance::new(body, glass).moved(&Pose { at: middle.extend(0.0), ..Pose::STILL }));
        }
        let centre = (0.5 * (low + high) - whole / 2.0) * up;
        Ok(Self {
            pane,
            scene: Scene { instances: stones, metals: vec![], unit_mm: 1.0 },
            size: whole / unit,
            thickness,
            first,
            count,
            film: Film { centre, ..Film::new(count, 1.0 / unit) },
        })
    }

    fn distance(&self, gap: f64) -> f64 {
        self.thickness / 2.0 + gap
    }

    fn with_lit_scene<T>(
        &self,
        background: &Mipmap,
        around: &PaneLighting,
        work: impl FnOnce(&LitScene) -> T,
    ) -> T {
        let view = View::default();
        let distance = self.distance(around.gap);
        work(&LitScene {
            scene: &self.scene,
            environment: Environment {
                map: around.map,
                basis: view.light_basis(),
                eye: view.basis(),
                head: 0.0,
                backplate: Some(Backplate { picture: background, distance, width: self.size.x }),
                backdrop: true,
            },
            view: &view,
            film: self.film,
            options: RayOptions { polarised: true, most_bounces: 64, least_weight: 1e-4 },
        })
    }

    /// Returns the traced pixels: the place of each in the traced part and in the picture, and its middle in pixels.
    fn pixels(&self, width: u32) -> impl Iterator<Item = (usize, usize, DVec2)> {
        let ([across, down], [left, top]) = (self.count, self.first);
        let place = move |k: u32| {
            let (x, y) = (left + k % across, top + k / across);
            let middle = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
            (k as usize, y as usize * width as usize + x as usize, middle)
        };
        (0..across * down).map(place)
    }

    fn traced(&self, background: &Mipmap, around: &PaneLighting, watch: Watch) -> Result<Linear, Stopped> {
        // Drawn panes take points of the background, so traced ones do as well.
        let sampled = (around.strata, Sampling { stretches: false, ..Sampling::of(around.passes.max(1)) });
        let (piece, _) = self.with_lit_scene(background, around, |lit_scene| {
            let prepare = |rows| Ok::<_, Stopped>(ByRays::new(*lit_scene, rows));
            spectral::expose(lit_scene, sampled, ByRays::MOST_ROWS, prepare, watch)
        })?;
        let background = background.picture();
        let mut picture = plain(background);
        for (k, at, middle) in self.pixels(background.width) {
            let cover = self.pane.cover(middle);
            if cover > 0.0 {
                let [red, green, blue, _] = piece.pixels[k];
                laid(&mut picture.pixels[at], [red, green, blue], cover as f32);
            }
        }
        Ok(picture)
    }

    fn cost(&self, map: &RefractionMap, pane: &Linear, traced: &Linear) -> Cost {
        let mut sums = Sums::default();
        let whole = self.size * self.pane.unit();
        for (k, at, middle) in self.pixels(pane.width) {
            // Only pixels whose middle the pane covers are compared.
            if self.pane.cover(middle) <= 0.5 {
                continue;
            }
            sums.pixels += 1.0;
            for (a, b) in pane.pixels[at].iter().zip(traced.pixels[at]).take(3) {
                let off = f64::from(a.clamp(0.0, 1.0) - b.clamp(0.0, 1.0)).abs();
                sums.off += off / 3.0;
                sums.squares += off * off / 3.0;
            }
            let place = |band: usize| {
                let place = map.bands[band].places[k];
                let at = DVec2::new(f64::from(place.u), f64::from(place.v)) * whole;
                (place.weight > 0.0).then_some(at)
            };
            let [red, green, blue] = self.pane.shifts(middle);
            let (Some(short), Some(mid), Some(long)) = (place(0), place(1), place(2)) else {
                sums.blind += 1.0;
                continue;
            };
            sums.pane.add(green.length());
            sums.traced.add((mid - middle).length());
            sums.apart.add((mid - middle - green).length());
            sums.fringe[0].add((red - blue).length());
            sums.fringe[1].add((long - short).length());
        }
        sums.cost()
    }
}

/// Returns the glass that strengths of refraction and dispersion stand for.
fn glass(refraction: f64, dispersion: f64) -> Result<Material, DispersionError> {
    let n_d = 1.0 + INDEX * refraction / 100.0;
    let glass = Material::from_index("glass", n_d)?;
    if dispersion == 0.0 {
        return Ok(glass);
    }
    let law = Dispersion::Abbe { n_d, v_d: ABBE * 100.0 / dispersion };
    Ok(Material { dispersion: law.checked()?, ..glass })
}

#[cfg(test)]
mod tests;
