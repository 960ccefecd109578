//! `refraction-map`: writes maps that give for each pixel the place in the background that its light comes from.
//! Pages and programs refract a moving background by looking it up in such a map.

use super::batch::{distinct, each_file};
use super::console::say;
use super::map_files::{MapFiles, MapKind, folder, kinds_or_usual};
use super::options::{ViewOptions, number};
use super::picture_options::{FinishOptions, PictureOptions, within};
use super::picturing::PictureSetup;
use super::progress::WorkProgress;
use super::specimen::stem;
use brillianteer_base::Failure;
use brillianteer_paper::export::Event;
use brillianteer_paper::refraction::{MOST_MAP_BANDS, MOST_MAP_PIXELS, MOST_PLACES};
use brillianteer_picture::{Backdrop, Carried};
use brillianteer_render::{Card, Job, MapProduct, Product, Rendered, Renderer};
use brillianteer_scene::{Background, BackgroundRef, Film, View};
use clap::Args;
use glam::DVec2;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Debug, Args)]
pub struct RefractionMaps {
    /// Designs, meshes, scene files, or names of cuts and scenes that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Folder to write to
    #[arg(short, long, default_value = "out")]
    out: PathBuf,
    /// Kinds of file to write, separated by commas [default: tiled,page, and preview with a photograph]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "KIND")]
    format: Vec<MapKind>,
    /// Make one map for each of N bands of wavelengths, 1 to 16, so that the look-up shows a rainbow
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_MAP_BANDS)))]
    bands: u32,
    /// Keep the places of the N strongest paths of each pixel, 1 to 8, so that a pixel through which two places are
    /// seen shows both; each band has N maps
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_PLACES)))]
    places: u32,
    /// The width of the background as a multiple of the picture's; light from beyond it is in the diffuse layer
    #[arg(long, value_name = "TIMES", default_value_t = 2.0, value_parser = number)]
    span: f64,
    /// Hang the same background in front of the stones too, so that light which they send back to the eye's side shows it
    #[arg(long)]
    both_sides: bool,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    picture: PictureOptions,
    /// What the options add to the default names of files.
    #[arg(skip)]
    pub told_apart: String,
}

impl RefractionMaps {
    pub fn run(&self) -> Result<(), Failure> {
        let refuse = |message: String| Err(Failure::Usage(message));
        if self.picture.size.iter().any(|&side| side > MOST_MAP_PIXELS) {
            return refuse(format!("--size: a map has {MOST_MAP_PIXELS} pixels each way at most"));
        }
        folder(&self.out)?;
        if self.bands * self.places > MOST_MAP_BANDS {
            let all = self.bands * self.places;
            return refuse(format!(
                "--bands, --places: these are {all} maps, and a page takes {MOST_MAP_BANDS} at most; give fewer"
            ));
        }
        within("span", self.span, [1.0, 100.0])?;
        distinct(&self.files)?;
        each_file(&self.files, false, |file| self.make(file))
    }

    fn make(&self, file: &Path) -> Result<(), Failure> {
        let viewpoint = self.view.viewpoint()?;
        // Maps are always traced by rays on the processor, so no card is opened.
        let finish = FinishOptions::default();
        let mut studio = PictureSetup::load((&self.picture, &finish), file, viewpoint)?;
        let view = studio.viewpoint.view();
        if studio.photo.is_none() {
            if self.picture.background.is_some() {
                return Err(Failure::Usage(
                    "--background: give a world, a pattern or a photograph, or leave it out".into(),
                ));
            }
            // The scene's background and the default are colours or the light itself, which a map does not show.
            studio.background = BackgroundRef::Plain(Background::Transparent);
        }
        if studio.look.strength < 1.0 {
            let (name, strength) = (&studio.assembly.name, studio.look.strength);
            say(&format!(
                "note: {name}: its strength of {strength} is ignored, because a refraction map is physics"
            ));
            studio.look.strength = 1.0;
        }
        let kinds = kinds_or_usual(&self.format, studio.photo.is_some())?;
        let bar = WorkProgress::new(&studio.assembly.name);
        let rendered = self.trace(&studio, &view, &bar)?;
        let tracer = rendered.backend.description();
        let (map, carried) = rendered.map()?;
        let map = map.developed(&studio.develop);
        let Carried { behind, single } = carried;
        let (name, light) = (&studio.assembly.name, studio.light());
        let description = format!(
            "{name}; refraction map, bands {}, places {}; background {} girdle radii behind, {} times as wide{}; light {light}; {}; {:.1} % of the \
             light comes from the background, {:.1} % of that from the map's places; {}",
            self.bands,
            self.places,
            studio.distance(),
            self.span,
            if self.both_sides { ", on both sides" } else { "" },
            tracer,
            100.0 * behind,
            100.0 * single,
            studio.viewpoint.description()
        );
        let files = MapFiles {
            out: &self.out,
            stem: &format!("{}{}{}", stem(file), self.told_apart, viewpoint.suffix()),
            kinds: &kinds,
            title: &studio.assembly.name,
            description: &description,
            span: self.span,
            background: &studio.background,
            photo: studio.photo.as_ref().map(|photo| photo.picture()),
        };
        files.write(&map, &|path| bar.report(Event::Written(path)))
    }

    fn trace(&self, studio: &PictureSetup, view: &View, bar: &WorkProgress) -> Result<Rendered, Failure> {
        let scene = Arc::new(studio.assembly.scene.clone());
        let pixel = studio.pixel(&scene, view)?;
        let distance = studio.distance();
        let [across, down] = self.picture.size.map(f64::from);
        let product = MapProduct {
            surroundings: studio.surroundings(pixel),
            plane: Backdrop {
                distance,
                size: DVec2::new(across, down) * pixel * self.span * view.widening(distance),
                both_sides: self.both_sides,
            },
            bands: self.bands,
            places: self.places,
            shades: studio.look.wavelengths,
            adapted: !self.picture.unadapted,
            strength: studio.look.strength,
        };
        let film = Film::new(self.picture.size, pixel);
        let product = Product::RefractionMap(product);
        let job = Job { scene, view: *view, film, product, quality: studio.quality() };
        let mut renderer = Renderer::new(Card::None);
        renderer.run(&job, &bar.watch(), &mut |_| Ok(()))
    }
}
