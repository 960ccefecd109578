//! Jobs: the request for a picture, a map or figures as one value, with the scene, the view, the film, the product
//! and the quality. A job is plain data, so that it can be sent to a thread, a page or another machine.
//!
//! To add a product, add a variant of `Product` with what it needs as plain data, its demands in `plan`, the ranges
//! of its numbers in `check`, and in `renderer` its `Output`, its usual number of samples and its arm in `attempt`.
//!
//! To add a reading of a scope's light, which beams, rays and the card can all give, add a variant of `Reading`,
//! its layer in `crates/picture/src/layer.rs`, its channels in `by_rays.rs` and `by_gpu.rs` there, and its arms in
//! `scope` and in `crates/paper/src/export/sheet.rs`. Other colours for the same light need no product: they are
//! another palette.

use super::Wanted;
use super::surroundings::Surroundings;
use brillianteer_measure::{Bounds, MeasureName, MeasureSettings, PatternSettings};
use brillianteer_optics::Strata;
use brillianteer_picture::liquid_glass::GlassPane;
use brillianteer_picture::{Backdrop, Linear, Survey, enlarged};
use brillianteer_scene::{Film, Glare, Medium, Panorama, Scene, Scope, USUAL_BOUNCES, View};
use brillianteer_trace::beam::BeamOptions;
use brillianteer_trace::ray::RayOptions;
use brillianteer_trace::sampling::LitScene;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// One piece of work for a [`Renderer`](super::Renderer).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// The stones. Scopes and figures use only the first, in the frame of its body, without its pose.
    pub scene: Arc<Scene>,
    /// The view from which they are seen.
    pub view: View,
    /// The pixels of the picture; figures have none.
    pub film: Film,
    /// The product.
    pub product: Product,
    /// The accuracy of the product.
    pub quality: Quality,
}

/// The product of a [`Job`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Product {
    /// A picture under light.
    Light(LightProduct),
    /// A picture in a scope.
    Scope(ScopeProduct),
    /// A map that gives for each pixel the place in the background that its light comes from.
    RefractionMap(MapProduct),
    /// A traced pane of liquid glass.
    LiquidGlass(PaneProduct),
    /// Figures in a scope.
    Figures(FiguresProduct),
    /// Measures of light.
    Measures(MeasuresProduct),
    /// The contrast that an eye resolves on the face.
    Contrast(ContrastProduct),
}

/// A picture of stones under light.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LightProduct {
    /// The surroundings of the stones: light, and background.
    pub surroundings: Surroundings,
    /// The number of bands of wavelengths, at least 1.
    pub wavelengths: u32,
    /// True where the eye is adapted to the light, so that a white sheet is white.
    pub adapted: bool,
    /// The strength of refraction: the part of its turn that refracted light takes, 0 to 1; 1 is physics.
    pub strength: f64,
    /// True where each pass takes another share of each band of wavelengths, so that together they show all hues;
    /// else all passes take only the middle wavelengths.
    pub jitter: bool,
    /// The steps in which the picture is made.
    pub steps: Steps,
}

/// The steps in which a picture under light is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Steps {
    /// Some rows after the other, each handed out once it is finished, which takes little memory.
    Strips,
    /// As a whole, shown after the first, the second, the fourth pass and so on, once these passes together have
    /// enough wavelengths that white is white.
    Passes {
        /// The number of the first pass. Passes of other numbers take other places in the pixels.
        first: u32,
        /// The number of first passes that are not shown, because a picture as good is in sight; the last is always
        /// shown.
        hidden: u32,
    },
    /// By the beams of one wavelength, spread to the others to first order; for a picture that is about to change. Rays
    /// take one pass.
    Glance {
        /// The number of the pass that rays take.
        first: u32,
    },
}

/// A picture of one stone in a scope.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScopeProduct {
    /// The scope whose bands the light is divided into.
    pub scope: Scope,
    /// The stone's medium.
    pub medium: Medium,
    /// Included where the energy contains glare.
    pub glare: Glare,
    /// The readings of the light; each becomes a picture of its own.
    pub readings: Vec<Reading>,
}

/// A reading of the light: the quantity that a picture in a scope shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Reading {
    /// The energy of each band, of all light.
    Energy,
    /// The strongest exit of each point alone.
    Strongest,
}

/// A refraction map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapProduct {
    /// The surroundings of the stones; their backplate is not used.
    pub surroundings: Surroundings,
    /// The plane on which places are mapped.
    pub plane: Backdrop,
    /// The number of bands of wavelengths in which places are mapped.
    pub bands: u32,
    /// The number of places of a pixel in each band.
    pub places: u32,
    /// The number of wavelengths of the diffuse layer.
    pub shades: u32,
    /// True where the eye is adapted to the light.
    pub adapted: bool,
    /// The strength of refraction: the part of its turn that refracted light takes, 0 to 1; 1 is physics.
    pub strength: f64,
}

/// A pane of liquid glass, traced as real glass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PaneProduct {
    /// The outline and the strengths of the pane, in pixels of the picture.
    pub pane: GlassPane,
    /// The background behind it, in the size of the picture.
    pub background: Arc<Panorama>,
    /// Distance between pane and background, as a part of the pane's shorter side, above 0.
    pub gap: f64,
    /// The number of bands of wavelengths.
    pub wavelengths: u32,
    /// True where the pane is compared with a drawn one.
    pub compares: bool,
}

/// Figures of one stone in a scope.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FiguresProduct {
    /// The scope whose bands the figures list.
    pub scope: Scope,
    /// The stone's medium.
    pub medium: Medium,
}

/// Measures of one stone's light, which are sums over exact beams.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeasuresProduct {
    /// The light, head and eye of the measures.
    pub settings: MeasureSettings,
    /// The stone's medium.
    pub medium: Medium,
    /// The measures whose derivatives are taken as well.
    #[serde(default)]
    pub derivatives: Vec<MeasureName>,
}

/// The contrast that an eye resolves on the face of one stone, from exact beams.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContrastProduct {
    /// The half angle of the observer's head under the even dome, degrees, 0 to 89.
    pub head_deg: f64,
    /// The size of the stone and the resolution of the eye; the stone does not rock.
    pub pattern: PatternSettings,
    /// The stone's medium.
    pub medium: Medium,
}

/// The accuracy of a job, and its tracer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Quality {
    /// The tracer to use, or the choice of the quickest.
    pub tracer: Wanted,
    /// The limits to which exact beams are followed.
    pub beams: BeamOptions,
    /// The standard error, a part of the silhouette's light, to which figures estimate by rays what beams have left, above
    /// 0; `None` where they estimate nothing. Pictures do not use it.
    pub standard_error: Option<f64>,
    /// The limits to which rays are followed.
    pub rays: RayOptions,
    /// The number of samples: passes of a picture under light, of a map's diffuse layer and of a pane; rays along each side
    /// of a pixel in a scope, and along each side of a lattice for figures. `None` is the usual number.
    pub samples: Option<u32>,
}

/// The default share of the light that exact beams leave unresolved in a picture under light.
const UNRESOLVED_LIGHT: f64 = 2e-3;

/// The default limit of beams of one wavelength. Without symmetry, reaching the bound of unresolved light would take
/// many times as long as the rest of the work.
const MOST_BEAMS: usize = 100_000;

/// The default end of rays: after this many bounces, or where no more than this weight is left.
const RAYS: RayOptions = RayOptions { polarised: true, most_bounces: USUAL_BOUNCES, least_weight: 5e-4 };

impl Quality {
    /// Returns the default quality of pictures under light.
    pub fn of_pictures(polarised: bool) -> Self {
        let (unresolved, most_beams) = (UNRESOLVED_LIGHT, MOST_BEAMS);
        Self {
            tracer: Wanted::Quickest,
            beams: BeamOptions { unresolved, polarised, most_beams, ..BeamOptions::default() },
            standard_error: None,
            rays: RayOptions { polarised, ..RAYS },
            samples: None,
        }
    }

    /// Returns the quality of figures within these bounds.
    pub fn of_figures(bounds: &Bounds, tracer: Wanted) -> Self {
        let Bounds { standard_error, polarised, lattice, .. } = *bounds;
        let (unresolved, least_weight) = (bounds.left_by_beams(), bounds.left_by_rays());
        Self {
            tracer,
            beams: BeamOptions { unresolved, polarised, ..BeamOptions::default() },
            standard_error,
            rays: RayOptions { least_weight, polarised, ..RayOptions::default() },
            samples: Some(lattice),
        }
    }
}

impl Job {
    /// Returns the job of a pane of liquid glass, which has no stones and no view.
    pub fn of_pane(pane: PaneProduct, quality: Quality) -> Self {
        let film = Film { size: [pane.background.width, pane.background.height], ..Film::NONE };
        let scene = Arc::new(Scene { instances: vec![], metals: vec![], unit_mm: 1.0 });
        Self { scene, view: View::default(), film, product: Product::LiquidGlass(pane), quality }
    }

    /// Returns the lit scene of a job under light; `None` for other products.
    pub fn lit(&self) -> Option<LitScene<'_>> {
        match &self.product {
            Product::Light(light) => Some(self.lit_scene(&light.surroundings)),
            Product::RefractionMap(map) => Some(self.lit_scene(&map.surroundings)),
            Product::Scope(_)
            | Product::LiquidGlass(_)
            | Product::Figures(_)
            | Product::Measures(_)
            | Product::Contrast(_) => None,
        }
    }

    /// Returns a rough picture of this job in full size, as [`enlarged`] makes it; `None` where the job is no picture
    /// under light, or has metal, whose outlines are not computed. `film` is the rough picture's own, and `shift` the
    /// place of its rays in its pixels.
    pub fn enlarged(&self, rough: &Linear, (film, shift): (&Film, DVec2)) -> Option<Linear> {
        let Product::Light(light) = &self.product else { return None };
        if !self.scene.metals.is_empty() {
            return None;
        }
        let white = light.strata(1).response();
        Some(enlarged(rough, (film, shift), &self.lit_scene(&light.surroundings), &white))
    }

    /// Returns the lit scene of a job in these surroundings.
    pub fn lit_scene<'a>(&'a self, surroundings: &'a Surroundings) -> LitScene<'a> {
        LitScene {
            scene: &self.scene,
            environment: surroundings.around(&self.view),
            view: &self.view,
            film: self.film,
            options: self.quality.rays,
        }
    }
}

/// Returns the note of a picture that follows refraction only by a part, which is not physics; it begins with a semicolon,
/// and is empty where the strength is 1.
pub fn mixture_note(strength: f64) -> String {
    let note =
        || format!("; strength {strength}: refracted and straight rays are mixed, which is not physics");
    (strength < 1.0).then(note).unwrap_or_default()
}

impl LightProduct {
    /// Returns the strata of wavelengths that are traced in a number of sample passes. At a glance each pass stands for whole
    /// strata, and without jitter for their middle wavelengths.
    pub fn strata(&self, passes: u32) -> Strata {
        let spectrum = &self.surroundings.lighting.light.spectrum;
        let shares = if matches!(self.steps, Steps::Glance { .. }) { 1 } else { passes };
        if self.jitter {
            Strata::new(self.wavelengths, shares, spectrum, self.adapted)
        } else {
            Strata::of_middles(self.wavelengths, spectrum, self.adapted)
        }
    }
}

impl MapProduct {
    /// Traces the survey of this map with this many passes of the diffuse layer, and returns what `work` makes of it.
    pub(super) fn surveyed<T>(&self, passes: u32, work: impl FnOnce(&Survey) -> T) -> T {
        let strata = |count, shares| {
            Strata::new(count, shares, &self.surroundings.lighting.light.spectrum, self.adapted)
        };
        let (bands, shades) = (strata(self.bands, 1), strata(self.shades, passes));
        work(&Survey { bands: &bands, places: self.places, shades: &shades, passes, strength: self.strength })
    }
}
