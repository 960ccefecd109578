//! The ranges of all numbers of a job. A job may come from another program, so it is checked before it is planned.

use super::job::{
    ContrastProduct, Job, LightProduct, MapProduct, MeasuresProduct, PaneProduct, Product, Quality,
};
use super::surroundings::Surroundings;
use brillianteer_optics::{DispersionError, INDICES, INDICES_IN_WORDS};
use brillianteer_scene::{
    Film, HEADS_DEG, Medium, Panorama, PanoramaError, Pose, Projection, Scene, Scope, ScopeError, View,
};
use brillianteer_trace::environment::LightingError;
use glam::DQuat;
use std::f64::consts::FRAC_PI_2;
use std::ops::RangeInclusive;

/// The numbers of pixels along a side of a film.
const SIDES: Counts = Counts { range: 1..=65_536, text: "1 to 65,536 pixels" };

/// The numbers of bands of wavelengths.
const BANDS: Counts = Counts { range: 1..=1024, text: "1 to 1024 bands" };

/// The numbers of wavelengths of a map's diffuse layer, which may be left out.
const SHADES: Counts = Counts { range: 0..=1024, text: "0 to 1024 wavelengths" };

/// The numbers of places of a map's pixel.
const PLACES: Counts = Counts { range: 1..=256, text: "1 to 256 places" };

/// The numbers of sample passes.
const PASSES: Counts = Counts { range: 1..=65_536, text: "1 to 65,536 passes" };

/// The numbers of rays along a side of a pixel in a scope.
const RAYS: Counts = Counts { range: 1..=1024, text: "1 to 1024 rays along each side of a pixel" };

/// The numbers of rays along a side of a lattice for figures.
pub(super) const LATTICES: Counts = Counts { range: 1..=16_384, text: "1 to 16,384" };

/// The range of the half angle of an observer's head, in words.
pub(super) const HEADS: &str = "0 to 89 degrees";

/// Returns whether a head may have this half angle, degrees.
pub(super) fn is_head(degrees: f64) -> bool {
    let [least, most] = HEADS_DEG;
    (least..=most).contains(&degrees)
}

/// The keys of a film, as errors name them.
const FILM: FilmKeys = FilmKeys { size: "film.size", pixel: "film.pixel", centre: "film.centre" };

/// The keys of the film that a picture behind the stones fills.
const FRAME: FilmKeys = FilmKeys {
    size: "surroundings.backplate.frame.size",
    pixel: "surroundings.backplate.frame.pixel",
    centre: "surroundings.backplate.frame.centre",
};

/// A range of counts, also in words.
pub(super) struct Counts {
    range: RangeInclusive<u32>,
    text: &'static str,
}

struct FilmKeys {
    size: &'static str,
    pixel: &'static str,
    centre: &'static str,
}

/// A number is out of its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key} is {value}; give {range}")]
pub struct OutOfRange {
    /// The number's key in the job, or its name among the options.
    pub key: &'static str,
    /// The value of the number.
    pub value: f64,
    /// The range that is allowed, in words.
    pub range: &'static str,
}

/// The reason why a job is impossible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JobError {
    /// A number is out of its range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// A stone of the scene is at fault.
    #[error("scene.instances[{place}]: {error}")]
    Instance {
        /// The place of the stone among the instances, from 0.
        place: usize,
        /// The fault of the stone.
        error: Box<JobError>,
    },
    /// A number of a body of metal is out of its range.
    #[error("scene.metals[{place}]: {error}")]
    Metal {
        /// The place of the body among the metals, from 0.
        place: usize,
        /// The fault of the body.
        error: OutOfRange,
    },
    /// The law of dispersion of a material gives no index.
    #[error("material.dispersion: {0}")]
    Dispersion(#[from] DispersionError),
    /// The scope is not valid.
    #[error(transparent)]
    Scope(#[from] ScopeError),
    /// A picture has fewer or more pixels than its size says.
    #[error("{key}: {error}")]
    Picture {
        /// The picture's key in the job.
        key: &'static str,
        /// The fault of the picture.
        error: PanoramaError,
    },
    /// The light has no map that could be looked up.
    #[error("surroundings.lighting: {0}")]
    Lighting(#[from] LightingError),
}

/// Refuses a number unless it is in its range.
pub(super) fn demand(
    is_right: bool,
    key: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), OutOfRange> {
    if is_right { Ok(()) } else { Err(OutOfRange { key, value, range }) }
}

/// Refuses a standard error that is out of its range.
pub(super) fn demand_error(key: &'static str, error: f64) -> Result<(), OutOfRange> {
    demand((1e-6..1.0).contains(&error), key, error, "a part from 0.000001 to below 1")
}

/// Refuses a count that is out of its range.
pub(super) fn demand_count(key: &'static str, count: u32, counts: &Counts) -> Result<(), OutOfRange> {
    demand(counts.range.contains(&count), key, f64::from(count), counts.text)
}

fn finite(key: &'static str, value: f64) -> Result<(), OutOfRange> {
    demand(value.is_finite(), key, value, "a finite number")
}

fn not_negative(key: &'static str, value: f64) -> Result<(), OutOfRange> {
    demand(value >= 0.0 && value.is_finite(), key, value, "a finite number of 0 or more")
}

/// Refuses a length or a scale that is not a finite number above 0.
pub(super) fn positive(key: &'static str, value: f64) -> Result<(), OutOfRange> {
    demand(value > 0.0 && value.is_finite(), key, value, "a finite number above 0")
}

fn share(key: &'static str, value: f64) -> Result<(), OutOfRange> {
    demand((0.0..=1.0).contains(&value), key, value, "a part from 0 to 1")
}

fn rotation(key: &'static str, turn: DQuat) -> Result<(), OutOfRange> {
    demand(turn.is_normalized(), key, turn.length(), "a quaternion of length 1")
}

impl Job {
    /// Checks every number that the product depends on. The film of figures and panes is not checked, nor the scene
    /// of scopes and figures beyond its bodies, as these products do not use them.
    ///
    /// # Errors
    /// The [`JobError`] names the first number at fault, its value and its range.
    pub fn check(&self) -> Result<(), JobError> {
        check_view(&self.view)?;
        self.quality.check(&self.product)?;
        match &self.product {
            Product::Light(light) => {
                check_film(&self.film, &FILM)?;
                check_scene(&self.scene)?;
                light.check()
            }
            Product::RefractionMap(map) => {
                check_film(&self.film, &FILM)?;
                check_scene(&self.scene)?;
                map.check()
            }
            Product::Scope(product) => {
                check_film(&self.film, &FILM)?;
                check_scope(&product.scope, &product.medium)
            }
            Product::Figures(product) => check_scope(&product.scope, &product.medium),
            Product::Measures(product) => product.check(),
            Product::Contrast(product) => product.check(),
            Product::LiquidGlass(pane) => pane.check(),
        }
    }
}

impl Quality {
    fn check(&self, product: &Product) -> Result<(), JobError> {
        share("quality.beams.unresolved", self.beams.unresolved)?;
        self.standard_error.map_or(Ok(()), |error| demand_error("quality.standard_error", error))?;
        share("quality.rays.least_weight", self.rays.least_weight)?;
        let counts = match product {
            Product::Light(_) | Product::RefractionMap(_) | Product::LiquidGlass(_) => PASSES,
            Product::Scope(_) => RAYS,
            Product::Figures(_) | Product::Measures(_) | Product::Contrast(_) => LATTICES,
        };
        self.samples.map_or(Ok(()), |samples| demand_count("quality.samples", samples, &counts))?;
        Ok(())
    }
}

impl LightProduct {
    fn check(&self) -> Result<(), JobError> {
        demand_count("wavelengths", self.wavelengths, &BANDS)?;
        share("strength", self.strength)?;
        self.surroundings.check()
    }
}

impl MeasuresProduct {
    fn check(&self) -> Result<(), JobError> {
        let Self { settings, medium, .. } = self;
        check_medium(medium)?;
        for dome in &settings.domes {
            let range = "0 to 20, and a head of 0 to 90 degrees";
            demand(dome.is_valid(), "settings.domes.power", dome.power, range)?;
        }
        let head = settings.head_deg;
        demand(is_head(head), "settings.head_deg", head, HEADS)?;
        positive("settings.blur_deg", settings.blur_deg)?;
        for index in settings.indices {
            demand(INDICES.contains(&index), "settings.indices", index, INDICES_IN_WORDS)?;
        }
        if let Some(pattern) = &settings.pattern {
            positive("settings.pattern.resolves_mm", pattern.resolves_mm)?;
            positive("settings.pattern.unit_mm", pattern.unit_mm)?;
            let is_rock = |rock: f64| rock > 0.0 && rock <= 45.0;
            let rock =
                |rock| demand(is_rock(rock), "settings.pattern.rock_deg", rock, "above 0 to 45 degrees");
            pattern.rock_deg.map_or(Ok(()), rock)?;
        }
        Ok(())
    }
}

impl ContrastProduct {
    fn check(&self) -> Result<(), JobError> {
        let Self { head_deg, pattern, medium } = self;
        check_medium(medium)?;
        demand(is_head(*head_deg), "head_deg", *head_deg, HEADS)?;
        positive("pattern.resolves_mm", pattern.resolves_mm)?;
        positive("pattern.unit_mm", pattern.unit_mm)?;
        Ok(())
    }
}

impl MapProduct {
    fn check(&self) -> Result<(), JobError> {
        not_negative("plane.distance", self.plane.distance)?;
        self.plane.size.to_array().into_iter().try_for_each(|side| positive("plane.size", side))?;
        demand_count("bands", self.bands, &BANDS)?;
        demand_count("places", self.places, &PLACES)?;
        demand_count("shades", self.shades, &SHADES)?;
        share("strength", self.strength)?;
        self.surroundings.check()
    }
}

impl PaneProduct {
    fn check(&self) -> Result<(), JobError> {
        positive("gap", self.gap)?;
        demand_count("wavelengths", self.wavelengths, &BANDS)?;
        check_picture("background", &self.background)
    }
}

impl Surroundings {
    fn check(&self) -> Result<(), JobError> {
        finite("surroundings.turn", self.turn)?;
        let is_head = (0.0..=FRAC_PI_2).contains(&self.head);
        demand(is_head, "surroundings.head", self.head, "0 to a quarter of a turn, in radians")?;
        self.lighting.map.check()?;
        let Some(hung) = &self.backplate else { return Ok(()) };
        positive("surroundings.backplate.span", hung.span)?;
        not_negative("surroundings.backplate.distance", hung.distance)?;
        check_film(&hung.frame, &FRAME)?;
        check_picture("surroundings.backplate.picture", hung.picture.picture())
    }
}

fn check_view(view: &View) -> Result<(), OutOfRange> {
    finite("view.tilt", view.tilt)?;
    finite("view.azimuth", view.azimuth)?;
    rotation("view.turn", view.turn)?;
    match view.projection {
        Projection::Orthographic => Ok(()),
        Projection::Perspective { distance } => positive("view.projection.distance", distance),
    }
}

fn check_film(film: &Film, keys: &FilmKeys) -> Result<(), OutOfRange> {
    film.size.into_iter().try_for_each(|side| demand_count(keys.size, side, &SIDES))?;
    positive(keys.pixel, film.pixel)?;
    film.centre.to_array().into_iter().try_for_each(|x| finite(keys.centre, x))
}

fn check_scene(scene: &Scene) -> Result<(), JobError> {
    positive("scene.unit_mm", scene.unit_mm)?;
    for (place, metal) in scene.metals.iter().enumerate() {
        let of_metal = |error: OutOfRange| JobError::Metal { place, error };
        check_pose(&metal.pose).map_err(of_metal)?;
        share("roughness", metal.roughness).map_err(of_metal)?;
    }
    let mut checked = None;
    for (place, instance) in scene.instances.iter().enumerate() {
        let of_instance = |error| JobError::Instance { place, error: Box::new(error) };
        check_pose(&instance.pose).map_err(|error| of_instance(error.into()))?;
        let dispersion = &instance.material.dispersion;
        // The stones of a scene often share a material, and editors plan many jobs a second.
        if checked != Some(dispersion) {
            dispersion.clone().checked().map_err(|error| of_instance(error.into()))?;
            checked = Some(dispersion);
        }
    }
    Ok(())
}

fn check_pose(pose: &Pose) -> Result<(), OutOfRange> {
    pose.at.to_array().into_iter().try_for_each(|x| finite("pose.at", x))?;
    rotation("pose.turn", pose.turn)?;
    positive("pose.scale", pose.scale)
}

fn check_scope(scope: &Scope, medium: &Medium) -> Result<(), JobError> {
    scope.validate()?;
    check_medium(medium)?;
    Ok(())
}

fn check_medium(medium: &Medium) -> Result<(), OutOfRange> {
    let is_index = medium.index >= 1.0 && medium.index.is_finite();
    demand(is_index, "medium.index", medium.index, "a finite number of 1 (air) or more")?;
    medium.absorption.into_iter().try_for_each(|a| not_negative("medium.absorption", a))?;
    finite("medium.spread", medium.spread)
}

fn check_picture(key: &'static str, picture: &Panorama) -> Result<(), JobError> {
    picture.check().map_err(|error| JobError::Picture { key, error })
}
