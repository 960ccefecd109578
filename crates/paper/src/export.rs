//! Writes a stone's pictures, drawings and figures to files, one after the other.

mod contrast;
mod event;
mod figures;
mod hearts;
mod measures;
mod pictures;
mod scope_picture;
mod sheet;
mod viewing;

#[cfg(test)]
mod tests;

pub(crate) use event::WorkShares;
pub use event::{Event, Reporter};
pub use figures::{EstimateErrors, EstimatedFigures, FigureReport, SeenBy, SeenFrom, ViewFigures, measure};
pub use hearts::{HeartsReport, ViewHearts, hearts};
pub use measures::{MeasureReport, ViewMeasures, light_measures};
pub use scope_picture::{ScopePicture, ScopeStill};
pub use sheet::{PROGRAM, caption_pixels};
pub use viewing::Viewing;
#[cfg(feature = "interchange")]
pub(crate) use viewing::note;

use brillianteer_base::{Failure, Watch};
use brillianteer_files::{WriteError, is_standard, write};
use brillianteer_picture::{Picture, Scoped};
use brillianteer_render::Renderer;
use pictures::Pictures;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// The least side of a picture with a caption, in pixels.
pub const LEAST_CAPTIONED: u32 = 96;

/// The number of files that a message names where there are too many.
const MOST_NAMED: usize = 3;

/// The rough effort of a drawing and of the figures, where a picture in a scope counts 1. Progress is counted by
/// these.
const DRAWING: f64 = 0.1;
const FIGURES: f64 = 1.0;

/// A file format of the outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputFormat {
    /// Pictures, sRGB.
    Png,
    /// Virtual facets, or squares of a contrast map, as polygons; drawings.
    Svg,
    /// Energy of each zone, or contrast, 32-bit and linear.
    Exr,
    /// Figures of the view, as `measure --json` prints them.
    Json,
}

impl OutputFormat {
    /// All formats.
    pub const ALL: [Self; 4] = [Self::Png, Self::Svg, Self::Exr, Self::Json];

    /// Returns the file extension, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
            Self::Exr => "exr",
            Self::Json => "json",
        }
    }
}

/// The outputs of a stone: their kinds and their folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Outputs {
    /// The folder, which is created if it is missing. `-` is standard output, which takes one file.
    pub folder: PathBuf,
    /// The beginning of the files' names. The [`suffix`](brillianteer_scene::Viewpoint::suffix) of the view follows in the names
    /// of files that show the view.
    pub stem: String,
    /// The pictures, each with the name that it bears in the files' names.
    pub pictures: Vec<(String, Picture)>,
    /// Pixels along each side, from 1 to [`MOST_PIXELS`](super::MOST_PIXELS).
    pub size: u32,
    /// The file formats.
    pub formats: Vec<OutputFormat>,
    /// True where pictures in scopes are written by strongest exits as well as by energy.
    pub strongest: bool,
    /// True where facet diagrams mark the findings of the stone's audit.
    pub mark_audit: bool,
    /// True where PNG and SVG pictures in scopes, and contrast maps, have a caption with a legend under them.
    pub caption: bool,
    /// True where the figures include the time that they took, which makes files differ from run to run.
    pub timing: bool,
}

impl Outputs {
    /// Refuses outputs that cannot be written beside each other.
    ///
    /// # Errors
    /// Fails with [`Failure::Usage`] where two outputs would have one name, or where the size is too small for a
    /// caption.
    pub fn check(&self) -> Result<(), Failure> {
        if self.caption && self.size < LEAST_CAPTIONED {
            let size = self.size;
            return Err(Failure::Usage(format!(
                "{size} pixels along each side: a caption needs {LEAST_CAPTIONED}"
            )));
        }
        match first_twice(std::slice::from_ref(self)) {
            None => Ok(()),
            Some((_, twice)) => Err(Failure::Usage(format!(
                "two outputs would be called '{twice}'; give each picture one name"
            ))),
        }
    }

    /// Returns the names of the files, most without an extension. No other output may have one of them, in whatever
    /// format.
    fn names(&self) -> impl Iterator<Item = String> + '_ {
        let stem = &self.stem;
        let pictured = self.pictures.iter().flat_map(move |(name, picture)| {
            let is_twofold = self.strongest && matches!(picture, Picture::Scoped(_));
            let strongest = is_twofold.then(|| format!("{stem}-{name}-strongest"));
            strongest.into_iter().chain([format!("{stem}-{name}")])
        });
        pictured.chain([format!("{stem}-figures.json")])
    }

    /// Returns the path of the file of this name; `suffix` describes the viewpoint.
    fn path(&self, suffix: &str, name: &str, format: OutputFormat) -> PathBuf {
        if is_standard(&self.folder) {
            return self.folder.clone();
        }
        self.folder.join(format!("{}{suffix}-{name}.{}", self.stem, format.ending()))
    }

    fn wants(&self, format: OutputFormat) -> bool {
        self.formats.contains(&format)
    }

    /// Returns the pictures, or none where figures are the only format.
    fn drawn(&self) -> impl Iterator<Item = &(String, Picture)> {
        let draws = self.formats.iter().any(|&f| f != OutputFormat::Json);
        self.pictures.iter().filter(move |_| draws)
    }
}

/// Returns the first name that occurs twice among the outputs of several stones into one folder, with the index of the
/// stone where it occurs again.
pub fn first_twice(stones: &[Outputs]) -> Option<(usize, String)> {
    let mut seen = HashSet::new();
    let mut all = stones.iter().enumerate().flat_map(|(k, outputs)| outputs.names().map(move |n| (k, n)));
    all.find(|(_, name)| !seen.insert(name.clone()))
}

/// An export: a stone in its view, and the outputs that are written of it.
#[derive(Clone, Copy)]
pub struct Export<'a> {
    /// The stone with its view and tracer.
    pub viewing: Viewing<'a>,
    /// The outputs to write.
    pub outputs: &'a Outputs,
}

impl Export<'_> {
    /// Returns the paths of the files that [`write`](Self::write) writes, in that order.
    ///
    /// # Errors
    /// Fails with [`Failure::Input`] where the eye is not in front of the whole stone, [`Failure::Usage`] where
    /// outputs and tracer do not go together: then nothing can be written.
    pub fn files(&self, renderer: &Renderer) -> Result<Vec<PathBuf>, Failure> {
        let by_beams = self.check(renderer)?;
        Ok(self.paths(renderer, by_beams))
    }

    fn paths(&self, renderer: &Renderer, by_beams: bool) -> Vec<PathBuf> {
        let outputs = self.outputs;
        let drawn =
            outputs.drawn().flat_map(|(name, picture)| self.files_of(name, picture, (renderer, by_beams)));
        let figures = outputs.wants(OutputFormat::Json).then(|| self.figures_path());
        drawn.chain(figures).collect()
    }

    /// Writes the files, each whole or not at all, and reports the part of the work that is done to `watch`.
    ///
    /// # Errors
    /// Returns the errors of [`files`](Self::files), before anything is written; [`Failure::Output`]; an error of
    /// `tell`; or [`Failure::Stopped`] where `watch` asks to stop. Files that were reported as written stay.
    pub fn write(&self, renderer: &mut Renderer, watch: Watch, tell: Reporter) -> Result<(), Failure> {
        let by_beams = self.check(renderer)?;
        let outputs = self.outputs;
        let is_scoped = |(_, picture): &(String, Picture)| matches!(picture, Picture::Scoped(_));
        let wants_more = outputs.wants(OutputFormat::Exr) || outputs.wants(OutputFormat::Svg);
        if wants_more && !by_beams && outputs.drawn().any(is_scoped) {
            tell(Event::Note(&only_png("pictures in scopes")))?;
        }
        let mut pictures = Pictures::new(self, renderer, tell);
        let measured = if outputs.wants(OutputFormat::Json) { FIGURES } else { 0.0 };
        let mut pace =
            WorkShares::new(watch, outputs.drawn().map(|(_, p)| effort(p)).sum::<f64>() + measured);
        for (name, picture) in outputs.drawn() {
            pace.step(effort(picture), |watch| pictures.make(name, picture, watch))?;
        }
        if outputs.wants(OutputFormat::Json) {
            pace.step(FIGURES, |watch| self.write_figures(pictures.renderer, watch, tell))?;
        }
        // The work is done, so a request to stop has no effect.
        let _ = watch(1.0);
        Ok(())
    }

    /// Refuses outputs that cannot be written, and returns whether exact beams trace the pictures in scopes.
    fn check(&self, renderer: &Renderer) -> Result<bool, Failure> {
        let (viewing, outputs) = (&self.viewing, self.outputs);
        outputs.check()?;
        let mut by_beams = viewing.plans_beams(renderer).unwrap_or(false);
        self.fits_standard_output(renderer, by_beams)?;
        for (name, picture) in outputs.drawn() {
            let Picture::Scoped(scoped) = picture else { continue };
            by_beams = viewing.facing(scoped.side).check(renderer)?;
            if !by_beams && !outputs.wants(OutputFormat::Png) {
                return Err(Failure::Usage(only_png(name)));
            }
        }
        if outputs.wants(OutputFormat::Json) { viewing.check(renderer) } else { Ok(by_beams) }
    }

    /// Refuses to write several files to standard output.
    fn fits_standard_output(&self, renderer: &Renderer, by_beams: bool) -> Result<(), Failure> {
        if !is_standard(&self.outputs.folder) {
            return Ok(());
        }
        let named = Outputs { folder: PathBuf::new(), ..self.outputs.clone() };
        let paths = Export { outputs: &named, ..*self }.paths(renderer, by_beams);
        if paths.len() <= 1 {
            return Ok(());
        }
        let count = paths.len();
        let mut names: Vec<String> =
            paths.iter().take(MOST_NAMED).map(|path| path.display().to_string()).collect();
        if count > MOST_NAMED {
            names.push(format!("and {} more", count - MOST_NAMED));
        }
        Err(Failure::Usage(format!(
            "standard output takes one file, and {count} would be written ({}); choose one picture and one format, or \
             give a folder",
            names.join(", ")
        )))
    }

    /// Returns the paths of a picture's files, in the order in which they are finished.
    fn files_of(
        &self,
        name: &str,
        picture: &Picture,
        (renderer, by_beams): (&Renderer, bool),
    ) -> Vec<PathBuf> {
        use OutputFormat::{Exr, Png, Svg};
        let files: &[(&str, OutputFormat)] = match (picture, by_beams) {
            (Picture::Profile | Picture::Diagram, _) if self.viewing.specimen.stone().is_err() => &[],
            (Picture::Profile | Picture::Diagram, _) => &[("", Svg), ("", Png)],
            (Picture::Contrast, _) if self.viewing.why_no_contrast(renderer).is_some() => &[],
            (Picture::Contrast, _) => &[("", Png), ("", Exr), ("", Svg)],
            (Picture::Scoped(_), true) => {
                &[("", Png), ("-strongest", Png), ("", Exr), ("-strongest", Svg), ("", Svg)]
            }
            (Picture::Scoped(_), false) => &[("", Png), ("-strongest", Png)],
        };
        let outputs = self.outputs;
        let wanted = files
            .iter()
            .filter(|(kind, format)| outputs.wants(*format) && (outputs.strongest || kind.is_empty()));
        let suffix = match picture {
            Picture::Scoped(scoped) => self.viewing.suffix(scoped.side),
            Picture::Contrast => self.viewing.suffix(None),
            Picture::Profile | Picture::Diagram => String::new(),
        };
        wanted.map(|(kind, format)| self.outputs.path(&suffix, &format!("{name}{kind}"), *format)).collect()
    }

    fn figures_path(&self) -> PathBuf {
        self.outputs.path(&self.viewing.viewpoint.suffix(), "figures", OutputFormat::Json)
    }

    fn write_figures(&self, renderer: &mut Renderer, watch: Watch, tell: Reporter) -> Result<(), Failure> {
        tell(Event::Begun(&format!("measuring {}", self.viewing.file)))?;
        let report = measure(&self.viewing, &Scoped::aset(), renderer, watch, tell)?;
        let figures = serde_json::to_string_pretty(&report.figures(self.outputs.timing));
        let path = self.figures_path();
        let text = figures.map_err(|error| Failure::Output(format!("{}: {error}", path.display())))?;
        write_text(&path, &(text + "\n"), tell)
    }
}

/// Returns the rough effort of a picture, where a picture in a scope counts 1.
fn effort(picture: &Picture) -> f64 {
    match picture {
        Picture::Scoped(_) | Picture::Contrast => 1.0,
        Picture::Profile | Picture::Diagram => DRAWING,
    }
}

/// Returns the message about a picture in a format that only exact beams can make.
fn only_png(name: &str) -> String {
    format!("{name}: rays make PNG pictures only; SVG and EXR need exact beams")
}

fn write_text(path: &Path, text: &str, tell: Reporter) -> Result<(), Failure> {
    write(path, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))?;
    tell(Event::Written(path))
}
