//! The setup of a picture under light (stones, light, background and camera), and taking the picture.

use super::console::{report, say};
use super::options::unfit;
use super::picture_options::{FinishOptions, PictureOptions, within};
use super::specimen::note_colour;
use brillianteer_base::{Failure, Watch};
use brillianteer_files::assembly::Assembly;
use brillianteer_paper::export::Event;
use brillianteer_paper::{Finish, StoredLight, background, lighting};
use brillianteer_picture::{Bloom, Develop, Overlay};
use brillianteer_render::{
    Card, HungPicture, Job, LightProduct, Partial, Product, Quality, Renderer, Steps, Surroundings,
    mixture_note,
};
use brillianteer_scene::{BackgroundRef, Film, Look, Mipmap, Scene, Smoothing, Tone, View, Viewpoint};
use brillianteer_trace::environment::Lighting;
use brillianteer_trace::ray::{self, Camera, RayOptions};
use glam::DVec2;
use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

mod over_time;
mod tracing;

/// The margin around the stones, as a part of their half extent in the picture.
const MARGIN: f64 = 0.06;

/// The default background.
const BACKGROUND: &str = "#33373d-#0e0f11";

/// The setup of pictures, loaded once: stones, light, background, tracer and finish.
pub struct PictureSetup<'a> {
    options: &'a PictureOptions,
    finish: &'a FinishOptions,
    pub assembly: Assembly,
    /// The viewpoint of the stones, in the scene's perspective where the scene has one.
    pub viewpoint: Viewpoint,
    /// What the pictures are made with.
    pub look: Look,
    lighting: Arc<Lighting>,
    /// The background, also where the look names none.
    pub background: BackgroundRef,
    /// The world, pattern or photograph behind the stones.
    pub photo: Option<Arc<Mipmap>>,
    pub develop: Develop,
    renderer: RefCell<Renderer>,
    /// With temporal smoothing, the history of the samples so far.
    trail: RefCell<over_time::Trail>,
    /// The planned tracer, in words.
    tracer: String,
}

/// The light of a picture, and a description of how it was made.
pub struct RenderedPicture {
    pub light: StoredLight,
    pub description: String,
}

impl<'a> PictureSetup<'a> {
    /// Loads stones, light and background, prints their warnings, and chooses the tracer for a view.
    pub fn load(
        (options, finish): (&'a PictureOptions, &'a FinishOptions),
        file: &Path,
        viewpoint: Viewpoint,
    ) -> Result<Self, Failure> {
        let mut assembly = options.specimen.load_assembly(file)?;
        if let Some(seconds) = options.moment {
            let seconds = within("moment", seconds, [0.0, 1e5])?;
            let refused = |error: Failure| match error {
                Failure::Input(message) => Failure::Input(format!("{message} (leave out --moment)")),
                other => other,
            };
            assembly = assembly.at_moment(seconds, options.movement).map_err(refused)?;
        }
        assembly.scene.instances.iter().for_each(|stone| note_colour(&stone.material));
        let look = options.look(finish, &assembly.look, assembly.scene.unit_mm)?;
        let lighting = lighting::load(&look.light)?;
        lighting.warnings.iter().for_each(|w| say(&format!("warning: {w}")));
        // The stones' glow would stand out around the overlays that are drawn over them.
        let glows = look.glow > 0.0 && finish.overlay.is_empty();
        let mut develop = Develop {
            exposure: look.exposure,
            tone: look.tone,
            bloom: glows.then(|| Bloom { strength: look.glow, ..Bloom::default() }),
            ..Develop::default()
        };
        let background = look.background.clone().unwrap_or_else(|| BACKGROUND.into());
        if let BackgroundRef::Plain(plain) = background {
            develop.background = plain;
        }
        let [across, down] = options.size;
        let reading = background::picture_behind(&background, across.max(down))?;
        reading.iter().flat_map(|r| &r.warnings).for_each(|w| say(&format!("warning: {w}")));
        let photo = reading.map(|reading| Arc::new(Mipmap::new(reading.panorama)));
        let mut studio = Self {
            viewpoint: assembly.seen_from(viewpoint),
            options,
            finish,
            assembly,
            look,
            lighting: Arc::new(lighting),
            background,
            photo,
            develop,
            renderer: RefCell::new(Renderer::new(Card::Machine)),
            trail: RefCell::new(None),
            tracer: String::new(),
        };
        studio.tracer = studio.planned(&studio.viewpoint.view())?;
        Ok(studio)
    }

    /// Returns an error if `--photo-distance` is given without a world, pattern or photograph that could have a
    /// distance.
    pub fn with_what_has_a_distance(self) -> Result<Self, Failure> {
        if self.photo.is_some() || self.options.photo_distance.is_none() {
            return Ok(self);
        }
        Err(Failure::Usage(
            "--photo-distance: only a world, a pattern or a photograph has a distance; give one by --background"
                .into(),
        ))
    }

    /// Returns a description of the tracer that pictures of a view will have.
    fn planned(&self, view: &View) -> Result<String, Failure> {
        let job = self.job(&Arc::new(self.assembly.scene.clone()), view, 1.0);
        let plan = self.renderer.borrow().plan(&job).map_err(|why| unfit(&why, &self.assembly.path))?;
        Ok(plan.backend.description())
    }

    /// Returns the distance of a world, pattern or photograph behind the origin, in girdle radii.
    pub fn distance(&self) -> f64 {
        self.look.distance(self.assembly.scene.unit_mm)
    }

    /// Returns the job of a picture of a scene, with pixels of the side `pixel`.
    pub fn job(&self, scene: &Arc<Scene>, view: &View, pixel: f64) -> Job {
        let product = Product::Light(LightProduct {
            surroundings: self.surroundings(pixel),
            wavelengths: self.look.wavelengths,
            adapted: !self.options.unadapted,
            strength: self.look.strength,
            jitter: !self.finish.no_jitter,
            steps: Steps::Strips,
        });
        let film = Film::new(self.options.size, pixel);
        Job { scene: Arc::clone(scene), view: *view, film, product, quality: self.quality() }
    }

    /// Returns the surroundings of the stones in a picture with pixels of the side `pixel`.
    pub fn surroundings(&self, pixel: f64) -> Surroundings {
        let hung = |picture: &Arc<Mipmap>| HungPicture {
            picture: Arc::clone(picture),
            span: self.background.span(),
            distance: self.distance(),
            frame: Film::new(self.options.size, pixel),
        };
        let usual = Surroundings::of(Arc::clone(&self.lighting));
        Surroundings {
            is_upright: self.look.light_upright,
            turn: self.look.light_turn.to_radians(),
            head: self.look.head.map_or(usual.head, f64::to_radians),
            shows_light: self.background == BackgroundRef::Light,
            backplate: self.photo.as_ref().map(hung),
            ..usual
        }
    }

    /// Returns the quality with which pictures are traced.
    pub fn quality(&self) -> Quality {
        let usual = Quality::of_pictures(!self.options.unpolarised);
        let rays = RayOptions { most_bounces: self.look.bounces, ..usual.rays };
        Quality { tracer: self.finish.tracer, samples: self.options.samples, rays, ..usual }
    }

    /// Returns the side of a pixel, in world units, with which the stones fill the picture up to a margin.
    ///
    /// # Errors
    /// Fails with [`Failure::Input`] where the eye of a perspective is not in front of all stones.
    pub fn pixel(&self, scene: &Scene, view: &View) -> Result<f64, Failure> {
        let camera = Camera::reaching(view, scene.reach());
        let Some(extent) = camera.extent(scene.vertices()) else {
            let message = "the eye of the perspective is not in front of all of it; move it farther off by --perspective";
            return Err(Failure::Input(format!("{}: {message}", self.assembly.path)));
        };
        let size = DVec2::new(f64::from(self.options.size[0]), f64::from(self.options.size[1]));
        Ok((2.0 * extent * (1.0 + MARGIN) / size).max_element())
    }

    /// Takes a picture. Where the card fails, the processor traces this picture and, if the card is lost, all later ones. With
    /// temporal smoothing its samples are blended one after the other.
    pub fn take(&self, job: &Job, watch: Watch) -> Result<RenderedPicture, Failure> {
        match self.look.smoothing {
            Smoothing::Temporal { newest } => self.take_over_time(job, newest, watch),
            Smoothing::None | Smoothing::Fxaa => self.take_at_once(job, watch),
        }
    }

    fn take_at_once(&self, job: &Job, watch: Watch) -> Result<RenderedPicture, Failure> {
        let mut light = StoredLight::new(job.film.size)?;
        let rendered = self.renderer.borrow_mut().run(job, watch, &mut |part| match part {
            Partial::Note(text) => report(Event::Note(text)),
            Partial::LightRow { y, pixels } => Ok(light.push(y, pixels)?),
            _ => Ok(()),
        })?;
        Ok(RenderedPicture { light, description: self.described(rendered)? })
    }

    /// Returns the settings by which a picture is developed, with the chosen overlays.
    pub fn finish<'j>(&'j self, job: &'j Job) -> Finish<'j> {
        let fxaa = self.look.smoothing == Smoothing::Fxaa;
        Finish { develop: self.develop, fxaa, overlays: &self.finish.overlay, lit_scene: job.lit() }
    }

    /// Returns lines that explain the colours of the overlays.
    pub fn legend(&self) -> Vec<String> {
        let lines = |overlay: &Overlay| {
            let name = format!("{overlay:?}").to_lowercase();
            let line = move |(what, [r, g, b]): (String, [u8; 3])| {
                format!("{name}: #{r:02x}{g:02x}{b:02x} is {what}")
            };
            overlay.legend().into_iter().map(line).collect::<Vec<_>>()
        };
        self.finish.overlay.iter().flat_map(lines).collect()
    }

    /// Returns a description of the light, the tracer and any mixture in words.
    pub fn description(&self) -> String {
        format!("light {}; {}{}", self.lighting.light.name, self.tracer, mixture_note(self.look.strength))
    }

    /// Returns the light's name.
    pub fn light(&self) -> &str {
        &self.lighting.light.name
    }

    /// Returns a note for EXR files where exposure, tone curve or overlays are set: an EXR holds bare light without them.
    pub fn undeveloped(&self) -> Option<&'static str> {
        let Develop { exposure, tone, .. } = self.develop;
        let is_told = exposure != 0.0
            || tone != Tone::default()
            || !self.finish.overlay.is_empty()
            || self.look.smoothing == Smoothing::Fxaa;
        is_told.then_some("an EXR holds the bare light: exposure, tone, FXAA and overlays are for PNG")
    }

    /// Describes the facet at a point of a picture, in pixels from its upper left corner; "nothing" beside the stones.
    pub fn probe(&self, job: &Job, at: DVec2) -> String {
        let found = job.lit().and_then(|lit_scene| ray::facet_at(&lit_scene, at.x, at.y));
        let Some((stone, facet)) = found else { return "nothing".into() };
        let placed = &job.scene.instances[stone];
        let name = placed
            .body
            .names()
            .get(facet as usize)
            .cloned()
            .unwrap_or_else(|| format!("facet {}", facet + 1));
        if job.scene.instances.len() == 1 {
            return name;
        }
        format!("{name} of stone {}, {}, {}", stone + 1, placed.label, placed.material.name)
    }
}
