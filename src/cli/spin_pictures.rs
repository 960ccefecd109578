//! The pictures of an animation: under light, or in a scope.

use super::console::report;
use super::options::{checked_head, scoped};
use super::picture_options::{FinishOptions, PictureOptions};
use super::picturing::PictureSetup;
use super::specimen::{LoadedSpecimen, asked_material, note_colour};
use super::spin_motion::{SpinMotion, SpinPose};
use brillianteer_base::{Failure, Watch};
use brillianteer_cut::Design;
use brillianteer_optics::line;
use brillianteer_paper::export::{PROGRAM, ScopePicture, ScopeStill, Viewing};
use brillianteer_paper::with_cover;
use brillianteer_picture::{Caption, Scoped};
use brillianteer_render::{Card, Renderer};
use brillianteer_scene::{Background, Medium, Scene, Viewpoint};
use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

/// A picture of an animation: red, green, blue and cover of each pixel, and a description of its content.
pub struct SpinPicture {
    pub rgba: Vec<u8>,
    pub description: String,
}

/// A source of the pictures of an animation, all with pixels of one size.
pub trait SpinPictures {
    /// Returns the subject of the animation, for its text and its progress.
    fn title(&self) -> String;

    /// Returns a description of how the pictures are made, for the animation's text.
    fn description(&self) -> String;

    /// Returns the design whose measures can be drawn; `None` for a scene.
    fn design(&self) -> Result<Option<Design>, Failure>;

    /// Returns whether the pictures have a transparent background.
    fn is_transparent(&self) -> bool;

    /// Returns the colours that have a meaning and must not change when the format reduces the number of colours.
    fn exact_colours(&self) -> Vec<[u8; 3]>;

    /// Returns the caption of the picture of a pose.
    fn caption(&self, pose: &SpinPose) -> Caption;

    /// Takes the picture with this number.
    fn take(&self, number: usize, pose: &SpinPose, watch: Watch) -> Result<SpinPicture, Failure>;
}

/// The frames of stones under light, all with pixels of one size.
pub struct LitPictures<'a> {
    setup: PictureSetup<'a>,
    material: Option<&'a str>,
    stones: Arc<Scene>,
    pixel: f64,
}

impl<'a> LitPictures<'a> {
    /// Loads stones, light and background. The viewpoint is the one that the options give.
    pub fn load(
        options: (&'a PictureOptions, &'a FinishOptions),
        file: &Path,
        viewpoint: Viewpoint,
    ) -> Result<Self, Failure> {
        let setup = PictureSetup::load(options, file, viewpoint)?.with_what_has_a_distance()?;
        let stones = Arc::new(setup.assembly.scene.clone());
        Ok(Self { setup, material: options.0.specimen.material.as_deref(), stones, pixel: 0.0 })
    }

    /// Returns the viewpoint in which the stones rest: in the scene's perspective where the options give none.
    pub fn rest(&self) -> Viewpoint {
        self.setup.viewpoint
    }

    /// Returns the same pictures with pixels so large that the stones fit into each frame.
    pub fn fitting(self, poses: &[SpinPose]) -> Result<Self, Failure> {
        let mut pixels = poses.iter().map(|pose| self.setup.pixel(&self.stones, &pose.view()));
        let pixel = pixels.try_fold(0.0_f64, |most, pixel| pixel.map(|p| most.max(p)))?;
        Ok(Self { pixel, ..self })
    }
}

impl SpinPictures for LitPictures<'_> {
    fn title(&self) -> String {
        self.setup.assembly.name.clone()
    }

    fn description(&self) -> String {
        self.setup.description()
    }

    fn design(&self) -> Result<Option<Design>, Failure> {
        let Some(mut design) = self.setup.assembly.design.clone() else { return Ok(None) };
        if let Some(text) = self.material {
            design.material = asked_material(text)?.0;
        }
        Ok(Some(design))
    }

    fn is_transparent(&self) -> bool {
        self.setup.develop.background == Background::Transparent
    }

    fn exact_colours(&self) -> Vec<[u8; 3]> {
        vec![]
    }

    fn caption(&self, pose: &SpinPose) -> Caption {
        let materials: Vec<&str> =
            self.stones.instances.iter().map(|stone| stone.material.name.as_str()).collect();
        let material = match materials.as_slice() {
            [first, rest @ ..] if rest.iter().all(|other| other == first) => format!("{first}, "),
            _ => String::new(),
        };
        let light = format!("{material}light {}; {PROGRAM}", self.setup.light());
        Caption::plain(&self.title(), vec![pose.words(), light])
    }

    fn take(&self, _: usize, pose: &SpinPose, watch: Watch) -> Result<SpinPicture, Failure> {
        let job = self.setup.job(&self.stones, &pose.view(), self.pixel);
        let mut taken = self.setup.take(&job, watch)?;
        let rgba = self.setup.finish(&job).pixels(&mut taken.light, watch)?;
        Ok(SpinPicture { rgba, description: taken.description })
    }
}

/// The setup of `spin` in a scope before the frames are known: stone, scope and options.
pub struct ScopeSetup<'a> {
    options: (&'a PictureOptions, &'a FinishOptions),
    specimen: LoadedSpecimen,
    scoped: Scoped,
    medium: Medium,
    renderer: RefCell<Renderer>,
}

impl<'a> ScopeSetup<'a> {
    /// Loads a stone and a scope; the scope is a name or a file.
    pub fn load(
        (options, finish): (&'a PictureOptions, &'a FinishOptions),
        file: &Path,
        scope: &Path,
    ) -> Result<Self, Failure> {
        let scoped = scoped(scope)?;
        options.head.map(checked_head).transpose()?;
        let specimen = options.specimen.load(file)?;
        note_colour(&specimen.material);
        let material = &specimen.material;
        let index = material.dispersion.try_index(line::SODIUM_D);
        let index = index
            .map_err(|error| Failure::Input(format!("{}: {}: {error}", specimen.path, material.name)))?;
        let absorption = Medium::absorption_of(material, line::SODIUM_D, specimen.unit_mm());
        let medium = Medium { index, absorption, spread: 0.0 };
        let renderer = RefCell::new(Renderer::new(Card::Machine));
        Ok(Self { options: (options, finish), specimen, scoped, medium, renderer })
    }

    /// Returns the name of the scope in the names of files.
    pub fn name(&self) -> &str {
        &self.scoped.scope.name
    }

    fn viewing(&self, pose: &SpinPose) -> Viewing<'_> {
        let (options, finish) = self.options;
        Viewing {
            specimen: &self.specimen,
            file: &self.specimen.path,
            viewpoint: pose.viewpoint,
            turned_deg: pose.turned_deg,
            medium: self.medium,
            wavelength_nm: Some(line::SODIUM_D),
            head_deg: options.head.unwrap_or(0.0),
            unresolved: None,
            standard_error: None,
            polarised: !options.unpolarised,
            glare: None,
            tracer: finish.tracer,
        }
    }

    /// Returns the source of the pictures of these poses.
    pub fn pictures(&self, motion: &SpinMotion, poses: &[SpinPose]) -> Result<ScopePictures<'_>, Failure> {
        let viewings: Vec<Viewing> = poses.iter().map(|pose| self.viewing(pose)).collect();
        let stills =
            ScopeStill::alike(&viewings, &self.scoped, self.options.0.size, &self.renderer.borrow())?;
        Ok(ScopePictures { setup: self, stills, rest: motion.rest })
    }
}

/// The frames of a stone in a scope, all with pixels of one size.
pub struct ScopePictures<'a> {
    setup: &'a ScopeSetup<'a>,
    stills: Vec<ScopeStill<'a>>,
    rest: Viewpoint,
}

impl SpinPictures for ScopePictures<'_> {
    fn title(&self) -> String {
        format!("{}: {}", self.setup.specimen.design.name, self.setup.name())
    }

    fn description(&self) -> String {
        let polarised = if self.setup.options.0.unpolarised { "unpolarised" } else { "polarised" };
        let side = self.rest.facing(self.setup.scoped.side).side.name();
        format!("{side} side; index {}, {polarised}; energy", self.setup.medium.index)
    }

    fn design(&self) -> Result<Option<Design>, Failure> {
        Ok(Some(self.setup.specimen.design.clone()))
    }

    fn is_transparent(&self) -> bool {
        false
    }

    fn exact_colours(&self) -> Vec<[u8; 3]> {
        self.setup
            .scoped
            .with_head(self.setup.options.0.head.unwrap_or(0.0))
            .bands
            .iter()
            .map(|b| b.colour)
            .collect()
    }

    fn caption(&self, pose: &SpinPose) -> Caption {
        let side = pose.viewpoint.facing(self.setup.scoped.side).side.name();
        let words = format!("{side} side, {}", pose.words());
        ScopeStill { viewing: self.setup.viewing(pose), ..self.stills[0] }.caption(&words)
    }

    fn take(&self, number: usize, _: &SpinPose, watch: Watch) -> Result<SpinPicture, Failure> {
        let mut renderer = self.setup.renderer.borrow_mut();
        let ScopePicture { rgb, description } = self.stills[number].take(&mut renderer, watch, &report)?;
        Ok(SpinPicture { rgba: with_cover(&rgb), description })
    }
}
