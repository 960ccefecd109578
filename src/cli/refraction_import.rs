//! `refraction-template` writes the gradient that another renderer shows through its glass; `refraction-import` turns
//! its rendered picture into a refraction map.

use super::console::written;
use super::map_files::{MapFiles, MapKind, folder, kinds_or_usual};
use super::options::number;
use super::picture_options::within;
use super::progress::WorkProgress;
use super::specimen::stem;
use brillianteer_base::Failure;
use brillianteer_files::is_standard;
use brillianteer_paper::background;
use brillianteer_paper::export::Event;
use brillianteer_paper::refraction::{MOST_MAP_PIXELS, Template, read, write_template};
use brillianteer_scene::{Background, BackgroundRef};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// The part of the work of an import that is done when the map is read, for its progress.
const READING: f64 = 0.6;

/// The coding of a template, with its name on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TemplateCoding {
    /// 8 bits, 16 by 16 tiles: without filter, through glass that takes no light away
    Tiled,
    /// 16 bits, red and green: through any clear glass; blue becomes the weight
    Gradient,
}

impl TemplateCoding {
    fn template(self) -> Template {
        match self {
            Self::Tiled => Template::Tiles,
            Self::Gradient => Template::Gradient,
        }
    }
}

#[derive(Debug, Args)]
pub struct RefractionTemplate {
    /// The PNG file to write
    file: PathBuf,
    /// The coding: what the colours stand for
    #[arg(long, value_enum, default_value = "tiled")]
    coding: TemplateCoding,
    /// Pixels of each side, 256 to 4096
    #[arg(long, value_name = "PIXELS", default_value_t = MOST_MAP_PIXELS, value_parser = clap::value_parser!(u32).range(256..=i64::from(MOST_MAP_PIXELS)))]
    size: u32,
}

#[derive(Debug, Args)]
pub struct RefractionImport {
    /// The rendered picture, PNG or OpenEXR; or three for red, green and blue light; or the files of a map of this
    /// program
    #[arg(required = true, value_name = "PICTURE")]
    pictures: Vec<PathBuf>,
    /// The diffuse layer: the light that does not come from the background, and the cover where it hides it; PNG or
    /// OpenEXR with alpha
    #[arg(long, value_name = "FILE")]
    diffuse: Option<PathBuf>,
    /// The template that was rendered [default: tiled for 8 bits, gradient for more]
    #[arg(long, value_enum)]
    coding: Option<TemplateCoding>,
    /// Folder to write to
    #[arg(short, long, default_value = "out")]
    out: PathBuf,
    /// Kinds of file to write, separated by commas [default: tiled,page, and preview with a photograph]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "KIND")]
    format: Vec<MapKind>,
    /// A world (sunset, room, city), a pattern (page, grid, checks, stripes, dots, slit) or a photograph's file for the page
    /// and the preview
    #[arg(long, value_name = "WHAT")]
    background: Option<String>,
    /// The width of the template, seen straight on, as a multiple of the picture's
    #[arg(long, value_name = "TIMES", default_value_t = 2.0, value_parser = number)]
    span: f64,
    /// What the options add to the default names of files.
    #[arg(skip)]
    pub told_apart: String,
}

impl RefractionTemplate {
    pub fn run(&self) -> Result<(), Failure> {
        let is_png = self.file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        if is_standard(&self.file) || self.file.is_dir() || !is_png {
            let path = self.file.display();
            return Err(Failure::Usage(format!("{path}: give the name of a PNG file, such as template.png")));
        }
        write_template(&self.file, self.coding.template(), self.size)?;
        written(&self.file)
    }
}

impl RefractionImport {
    pub fn run(&self) -> Result<(), Failure> {
        folder(&self.out)?;
        within("span", self.span, [1.0, 100.0])?;
        let background = match &self.background {
            Some(text) => BackgroundRef::read(text, Path::new(""))?,
            None => BackgroundRef::Plain(Background::Transparent),
        };
        if self.background.is_some() && !background.is_picture() {
            let message = "--background: give a world, a pattern or a photograph, or leave it out";
            return Err(Failure::Usage(message.into()));
        }
        let kinds = kinds_or_usual(&self.format, background.is_picture())?;
        let stem = stem(&self.pictures[0]);
        let progress = WorkProgress::new(&format!("reading {stem}"));
        let found = read(&self.pictures, self.diffuse.as_deref(), self.coding.map(TemplateCoding::template))?;
        // The progress never asks to stop.
        let _ = progress.watch()(READING);
        found.warnings.iter().try_for_each(|warning| progress.report(Event::Warning(warning)))?;
        found.notes.iter().try_for_each(|note| progress.report(Event::Note(note)))?;
        let [width, height] = found.map.size;
        let photo = background::picture_behind(&background, width.max(height))?;
        let warnings = photo.iter().flat_map(|photo| &photo.warnings);
        warnings.into_iter().try_for_each(|warning| progress.report(Event::Warning(warning)))?;
        progress.report(Event::Begun(&format!("writing {stem}")))?;
        let description = format!(
            "{stem}; refraction map read from {}, bands {}; background {} times as wide",
            self.pictures[0].file_name().unwrap_or_default().display(),
            found.map.bands.len(),
            self.span
        );
        let files = MapFiles {
            out: &self.out,
            stem: &format!("{stem}{}", self.told_apart),
            kinds: &kinds,
            title: &stem,
            description: &description,
            span: self.span,
            background: &background,
            photo: photo.as_ref().map(|photo| &photo.panorama),
        };
        files.write(&found.map, &|path| progress.report(Event::Written(path)))
    }
}
