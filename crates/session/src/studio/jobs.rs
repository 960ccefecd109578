//! Makes the renderer's jobs for the shots of views.

use super::effort::Effort;
use super::order::{FiguresOrder, Shot};
use brillianteer_measure::{Bounds, PatternSettings, head_of_measures};
use brillianteer_optics::line;
use brillianteer_picture::{Backdrop, Scoped, filling};
use brillianteer_render::{
    ContrastProduct, FiguresProduct, HungPicture, Job, LightProduct, MapProduct, PaneProduct, Product,
    Quality, Reading, ScopeProduct, Steps, Surroundings, Wanted,
};
use brillianteer_scene::{
    BackgroundRef, Film, Instance, Mipmap, Panorama, Pattern, Pose, Scene, Scope, View,
};
use brillianteer_trace::beam::BeamOptions;
use brillianteer_trace::ray::RayOptions;
use glam::DVec2;
use std::sync::Arc;

/// The width of a map's background as a multiple of the picture's; also the default of the command line.
pub const SPAN: f64 = 2.0;

/// The bands of wavelengths of a traced pane: before the picture is fair, and at its finest.
const FEW: u32 = 3;
const MANY: u32 = 12;

/// The resolution of a refraction map.
#[derive(Debug, Clone, Copy)]
pub struct MapDetail {
    /// The number of bands of wavelengths in which places are mapped.
    pub bands: u32,
    /// The number of places of a pixel in each band.
    pub places: u32,
    /// The number of wavelengths of the diffuse layer.
    pub shades: u32,
    /// The number of passes of the diffuse layer.
    pub samples: u32,
}

/// Returns the same film with larger pixels.
pub fn coarser(film: &Film, factor: f64) -> Film {
    let size = film.size.map(|n| ((f64::from(n) / factor).ceil() as u32).max(1));
    Film { size, pixel: film.pixel * f64::from(film.size[0]) / f64::from(size[0]), ..*film }
}

/// Returns the distance of the backplate behind the middle, in girdle radii: that of the shot, but at least so much
/// that all bodies are in front of it, however they are turned.
pub fn hung(shot: &Shot) -> f64 {
    let farthest = shot.copies.iter().map(|pose| pose.at.length()).fold(0.0, f64::max);
    shot.distance().max(farthest + shot.specimen.radius).max(shot.companions.reach())
}

/// Returns the quality of pictures in scopes at an effort; pictures and figures of equal quality share their beams.
fn scope_quality(effort: &Effort, samples: u32) -> Quality {
    let (unresolved, most_beams) = (effort.unresolved, effort.most_beams());
    let beams = BeamOptions { unresolved, most_beams, ..BeamOptions::default() };
    Quality { beams, samples: Some(samples), ..Quality::of_pictures(true) }
}

impl Shot {
    /// Returns the scene that a shot shows, in girdle radii of its stone.
    pub fn scene(&self) -> Arc<Scene> {
        let placed =
            |pose: &Pose| Instance::of(&self.specimen.body, self.specimen.material.clone(), "").moved(pose);
        let instances = self.copies.iter().map(placed).chain(self.companions.instances()).collect();
        let metals = self.companions.metals.clone();
        Arc::new(Scene { instances, metals, unit_mm: self.specimen.unit_mm() })
    }

    fn surroundings(&self, behind: Option<Arc<Mipmap>>) -> Surroundings {
        let backplate = behind.map(|picture| HungPicture {
            picture,
            span: self.look.background.as_ref().map_or(1.0, BackgroundRef::span),
            distance: hung(self),
            frame: self.whole,
        });
        let usual = Surroundings::of(Arc::clone(self.light.at_hand()));
        Surroundings {
            turn: self.look.light_turn.to_radians(),
            is_upright: self.look.light_upright,
            head: self.look.head.map_or(usual.head, f64::to_radians),
            shows_light: self.look.background == Some(BackgroundRef::Light),
            backplate,
            ..usual
        }
    }

    fn job(&self, product: Product, quality: Quality) -> Job {
        Job { scene: self.scene(), view: self.view, film: self.film, product, quality }
    }

    /// Returns the job of a render in at most `bands` bands of wavelengths, with the picture of the backplate.
    pub fn light_job(&self, behind: Option<Arc<Mipmap>>, bands: u32, steps: Steps, quality: Quality) -> Job {
        let product = LightProduct {
            surroundings: self.surroundings(behind),
            wavelengths: bands.min(self.look.wavelengths),
            adapted: true,
            strength: self.look.strength,
            jitter: self.jitter,
            steps,
        };
        let rays = RayOptions { most_bounces: self.look.bounces, ..quality.rays };
        self.job(Product::Light(product), Quality { rays, ..quality })
    }

    /// Returns the job of a picture in a scope.
    pub fn scope_job(&self, scope: Scope, effort: &Effort, rays_per_side: u32) -> Job {
        let product = ScopeProduct {
            scope,
            medium: self.specimen.medium(line::SODIUM_D),
            glare: self.glare,
            readings: vec![if self.strongest { Reading::Strongest } else { Reading::Energy }],
        };
        self.job(Product::Scope(product), scope_quality(effort, rays_per_side))
    }

    /// Returns the job of a contrast map.
    pub fn contrast_job(&self, effort: &Effort) -> Job {
        let product = ContrastProduct {
            head_deg: head_of_measures(self.look.head_of_scopes()),
            pattern: PatternSettings::usual(self.specimen.unit_mm()),
            medium: self.specimen.medium(line::SODIUM_D),
        };
        self.job(Product::Contrast(product), Quality { samples: None, ..scope_quality(effort, 1) })
    }

    /// Returns the job of the refraction map of a shot.
    pub fn map_job(&self, detail: &MapDetail) -> Job {
        let distance = hung(self);
        let whole = DVec2::from(self.whole.size.map(f64::from)) * self.whole.pixel;
        let size = whole * SPAN * self.view.widening(distance);
        let product = MapProduct {
            surroundings: self.surroundings(None),
            plane: Backdrop { distance, size, both_sides: false },
            bands: detail.bands,
            places: detail.places,
            shades: detail.shades,
            adapted: true,
            strength: self.look.strength,
        };
        let quality = Quality { samples: Some(detail.samples), ..Quality::of_pictures(true) };
        self.job(Product::RefractionMap(product), quality)
    }

    /// Returns the job of a traced pane of liquid glass of `size` pixels over its background.
    pub fn pane_job(&self, behind: &Panorama, size: [u32; 2], is_fine: bool, samples: u32) -> Job {
        let product = PaneProduct {
            pane: self.liquid.pane(size),
            background: Arc::new(filling(behind, size)),
            gap: self.liquid.gap,
            wavelengths: if is_fine { MANY } else { FEW },
            compares: false,
        };
        Job::of_pane(product, Quality { samples: Some(samples), ..Quality::of_pictures(true) })
    }

    /// Returns whether a background hangs behind what a shot shows.
    pub fn hangs(&self, background: &BackgroundRef) -> bool {
        self.look.background.as_ref() == Some(background)
            || (self.shows.is_pane() && self.pane_background() == *background)
    }

    /// Returns the background of a shot whose picture needs one.
    pub fn pane_background(&self) -> BackgroundRef {
        backdrop(self.look.background.as_ref())
    }

    /// Returns the job whose lit scene the overlay is drawn from: the shot as a render on this film.
    pub fn overlay_job(&self, film: Film) -> Job {
        let steps = Steps::Glance { first: 0 };
        Job { film, ..self.light_job(None, 1, steps, Quality::of_pictures(true)) }
    }
}

impl FiguresOrder {
    /// Returns the job of figures within these bounds, seen by another view.
    pub fn job(&self, view: View, bounds: &Bounds) -> Job {
        self.job_in(view, Quality::of_figures(bounds, Wanted::Quickest))
    }

    /// Returns the job of rough figures, from the beams that the pictures of the same effort share.
    pub fn rough_job(&self, effort: &Effort, lattice: u32) -> Job {
        self.job_in(self.view, scope_quality(effort, lattice))
    }

    fn job_in(&self, view: View, quality: Quality) -> Job {
        let scope = Scoped::aset().with_head(self.head);
        let medium = self.specimen.medium(line::SODIUM_D);
        let product = Product::Figures(FiguresProduct { scope, medium });
        Job { scene: Arc::new(Scene::alone(&self.specimen)), view, film: Film::NONE, product, quality }
    }
}

/// The backplate where a picture needs one and none is chosen.
const FIRST_BACKDROP: Pattern = Pattern::Page;

/// Returns the backplate of a picture that needs one: the chosen one where it is a picture, else a pattern.
pub fn backdrop(chosen: Option<&BackgroundRef>) -> BackgroundRef {
    chosen.filter(|chosen| chosen.is_picture()).cloned().unwrap_or(BackgroundRef::Pattern(FIRST_BACKDROP))
}
