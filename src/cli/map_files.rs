//! The files of a refraction map, which `refraction-map` traces and `refraction-import` reads.

use super::console::say;
use brillianteer_base::Failure;
use brillianteer_files::is_standard;
use brillianteer_paper::refraction::{
    Coding, MOST_MEGABYTES, Page, diffuse_path, paths, takes, write_diffuse, write_page, write_places,
};
use brillianteer_paper::{background, write_rgba_png};
use brillianteer_picture::{Develop, RefractionMap, develop, refract};
use brillianteer_scene::{BackgroundRef, Panorama, Tone};
use clap::ValueEnum;
use glam::DVec2;
use std::path::{Path, PathBuf};

/// A kind of file that a map is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MapKind {
    /// 8-bit PNG of 16 by 16 tiles, and the diffuse layer
    Tiled,
    /// 16-bit PNG: u, v and weight, and the diffuse layer
    Png16,
    /// OpenEXR: u, v and weight in 32 bits, and the diffuse layer
    Exr,
    /// A web page that refracts a moving background
    Page,
    /// The photograph of --background, refracted by the map
    Preview,
}

/// The output of a map's command: the files and their texts.
pub struct MapFiles<'a> {
    pub out: &'a Path,
    /// The beginning of the files' names.
    pub stem: &'a str,
    pub kinds: &'a [MapKind],
    /// The heading of the page.
    pub title: &'a str,
    /// A description of how the map was made.
    pub description: &'a str,
    /// The width of the background as a multiple of the map's.
    pub span: f64,
    pub background: &'a BackgroundRef,
    /// The picture of the background, where it has one.
    pub photo: Option<&'a Panorama>,
}

/// Returns an error where `--out` is standard output.
pub fn folder(out: &Path) -> Result<(), Failure> {
    if is_standard(out) {
        Err(Failure::Usage("--out -: several files are written; give a folder".into()))
    } else {
        Ok(())
    }
}

/// Returns the kinds that `--format` lists, or the usual ones.
pub fn kinds_or_usual(asked: &[MapKind], has_photo: bool) -> Result<Vec<MapKind>, Failure> {
    if asked.contains(&MapKind::Preview) && !has_photo {
        return Err(Failure::Usage(
            "--format preview: give a pattern or a photograph by --background".into(),
        ));
    }
    let usual = [MapKind::Tiled, MapKind::Page].into_iter().chain(has_photo.then_some(MapKind::Preview));
    Ok(if asked.is_empty() { usual.collect() } else { asked.to_vec() })
}

impl MapFiles<'_> {
    /// Writes the files, and calls `written` with the path of each.
    pub fn write(
        &self,
        map: &RefractionMap,
        written: &dyn Fn(&Path) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let codings = [
            (MapKind::Tiled, Coding::Tiles),
            (MapKind::Png16, Coding::Sixteen),
            (MapKind::Exr, Coding::Float),
        ];
        let asked: Vec<Coding> = codings
            .into_iter()
            .filter(|(kind, _)| self.kinds.contains(kind))
            .map(|(_, coding)| coding)
            .collect();
        for &coding in &asked {
            let paths = paths(self.out, self.stem, map.bands.len(), coding);
            write_places(&paths, map, coding, self.description)?;
            paths.iter().try_for_each(|path| written(path))?;
        }
        if !asked.is_empty() {
            let path = diffuse_path(self.out, self.stem);
            write_diffuse(&path, map, self.description)?;
            written(&path)?;
        }
        if self.kinds.contains(&MapKind::Page) {
            let path = self.path("html");
            let bytes = self.page_background()?;
            let ground = self.background.title();
            let background = bytes.as_deref().map(|bytes| (ground.as_str(), bytes));
            let page = Page { title: self.title, description: self.description, span: self.span, background };
            write_page(&path, map, &page)?;
            written(&path)?;
        }
        match self.photo {
            Some(photo) if self.kinds.contains(&MapKind::Preview) => self.preview(map, photo, written),
            _ => Ok(()),
        }
    }

    fn path(&self, ending: &str) -> PathBuf {
        self.out.join(format!("{}-refraction.{ending}", self.stem))
    }

    fn preview(
        &self,
        map: &RefractionMap,
        photo: &Panorama,
        written: &dyn Fn(&Path) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let path = self.out.join(format!("{}-refraction-preview.png", self.stem));
        // The diffuse layer is developed already, and the photograph shows as it is.
        let manner = Develop { bloom: None, tone: Tone::Linear, ..Develop::default() };
        let [width, height] = map.size;
        let rgba = develop(&refract(map, photo, DVec2::ZERO), &manner);
        write_rgba_png(&path, &rgba, (width, height), self.description)?;
        written(&path)
    }

    /// Returns the bytes of the pattern's or photograph's file for the page. Where the page cannot take them, it returns
    /// `None` and prints a note.
    fn page_background(&self) -> Result<Option<Vec<u8>>, Failure> {
        let Some(bytes) = background::bytes(self.background)? else { return Ok(None) };
        if takes(&bytes) {
            return Ok(Some(bytes));
        }
        say(&format!(
            "note: the photograph is not put into the page, which takes PNG and JPEG of up to {MOST_MEGABYTES} MiB"
        ));
        Ok(None)
    }
}
