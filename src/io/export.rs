//! A stone as files: pictures, drawings and figures, one after the other.

mod event;
mod figures;
mod pictures;
mod sampler;
mod viewing;

#[cfg(test)]
mod tests;

pub use event::{Event, Reporter};
pub use figures::{FigureReport, measure};
pub use viewing::Viewing;

use super::{Failure, WriteError, is_standard, write};
use crate::picture::{Picture, Scoped};
use crate::trace::{Tracer, Watch};
use event::WorkShares;
use pictures::Pictures;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// The largest side of an EXR, in pixels: it is held in memory, a dozen channels deep.
pub const MOST_EXR_PIXELS: u32 = 8192;

/// The least side of a picture with a caption, in pixels.
pub const LEAST_CAPTIONED: u32 = 192;

/// How many of too many files a message names.
const MOST_NAMED: usize = 3;

/// How long a drawing takes, and the figures, where a picture in a scope takes 1: roughly, for progress.
const DRAWING: f64 = 0.1;
const FIGURES: f64 = 1.0;

/// A kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputFormat {
    /// Pictures of energy and of strongest exits, and drawings; sRGB.
    Png,
    /// The virtual facets as polygons, and drawings.
    Svg,
    /// Energy of each zone, 32-bit and linear.
    Exr,
    /// Figures of the view.
    Json,
}

impl OutputFormat {
    /// All there are.
    pub const ALL: [Self; 4] = [Self::Png, Self::Svg, Self::Exr, Self::Json];

    /// How its files end, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
            Self::Exr => "exr",
            Self::Json => "json",
        }
    }
}

/// What is written of a stone, and where to.
#[derive(Debug, Clone, PartialEq)]
pub struct Outputs {
    /// The folder; made if it is missing. `-` is standard output, which takes one file.
    pub folder: PathBuf,
    /// What the files' names begin with; the [`suffix`](crate::scene::Viewpoint::suffix) of the view follows where the file
    /// shows it.
    pub stem: String,
    /// Pictures, each with its name in the files' names.
    pub pictures: Vec<(String, Picture)>,
    /// Pixels along each side, from 1 to [`MOST_PIXELS`](super::MOST_PIXELS); for EXR to [`MOST_EXR_PIXELS`].
    pub size: u32,
    /// Kinds of file.
    pub formats: Vec<OutputFormat>,
    /// Whether pictures in scopes are written by strongest exits too, and not by energy alone.
    pub strongest: bool,
    /// Whether a caption with the legend of the scope's zones is drawn under pictures in scopes, of PNG and SVG.
    pub caption: bool,
    /// Whether the figures hold the time that they took, which makes files differ from run to run.
    pub timing: bool,
}

impl Outputs {
    /// Whether they can be written beside each other.
    ///
    /// # Errors
    /// [`Failure::Usage`] where two would bear one name, or the size is too large.
    pub fn check(&self) -> Result<(), Failure> {
        if self.wants(OutputFormat::Exr) && self.size > MOST_EXR_PIXELS {
            let size = self.size;
            let message = format!("{size} pixels along each side: an EXR may have {MOST_EXR_PIXELS}");
            return Err(Failure::Usage(message));
        }
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

    /// The names of its files, most without ending: no other output may bear one, in whatever format.
    fn names(&self) -> impl Iterator<Item = String> + '_ {
        let stem = &self.stem;
        let pictured = self.pictures.iter().flat_map(move |(name, picture)| {
            let is_twofold = self.strongest && matches!(picture, Picture::Scoped(_));
            let strongest = is_twofold.then(|| format!("{stem}-{name}-strongest"));
            strongest.into_iter().chain([format!("{stem}-{name}")])
        });
        pictured.chain([format!("{stem}-figures.json")])
    }

    /// The file of a name; `suffix` says from where the stone is seen.
    fn path(&self, suffix: &str, name: &str, format: OutputFormat) -> PathBuf {
        if is_standard(&self.folder) {
            return self.folder.clone();
        }
        self.folder.join(format!("{}{suffix}-{name}.{}", self.stem, format.ending()))
    }

    fn wants(&self, format: OutputFormat) -> bool {
        self.formats.contains(&format)
    }

    /// The pictures, if more than figures is wanted.
    fn drawn(&self) -> impl Iterator<Item = &(String, Picture)> {
        let draws = self.formats.iter().any(|&f| f != OutputFormat::Json);
        self.pictures.iter().filter(move |_| draws)
    }
}

/// The first name that comes twice among the outputs of several stones into one folder: the stone where it comes
/// again, by its place, and the name.
pub fn first_twice(stones: &[Outputs]) -> Option<(usize, String)> {
    let mut seen = HashSet::new();
    let mut all = stones.iter().enumerate().flat_map(|(k, outputs)| outputs.names().map(move |n| (k, n)));
    all.find(|(_, name)| !seen.insert(name.clone()))
}

/// A stone to be written to files.
#[derive(Clone, Copy)]
pub struct Export<'a> {
    /// The stone and how it is looked at.
    pub viewing: Viewing<'a>,
    /// What to write.
    pub outputs: &'a Outputs,
}

impl Export<'_> {
    /// The files that [`write`](Self::write) writes, in that order.
    ///
    /// # Errors
    /// What keeps all of them from being written: [`Failure::Input`] where the eye is not in front of the whole
    /// stone, [`Failure::Usage`] where outputs and tracer do not go together.
    pub fn files(&self) -> Result<Vec<PathBuf>, Failure> {
        self.check()?;
        Ok(self.paths())
    }

    fn paths(&self) -> Vec<PathBuf> {
        let outputs = self.outputs;
        let drawn = outputs.drawn().flat_map(|(name, picture)| self.files_of(name, picture));
        let figures = outputs.wants(OutputFormat::Json).then(|| self.figures_path());
        drawn.chain(figures).collect()
    }

    /// Writes the files, each whole or not at all. `watch` is told the part done of all the work.
    ///
    /// # Errors
    /// Those of [`files`](Self::files), before anything is written; [`Failure::Output`]; what `tell` answers; or
    /// [`Failure::Stopped`] when `watch` asks to stop. Files told as written stay.
    pub fn write(&self, watch: Watch, tell: Reporter) -> Result<(), Failure> {
        self.check()?;
        let outputs = self.outputs;
        let is_scoped = |(_, picture): &(String, Picture)| matches!(picture, Picture::Scoped(_));
        let wants_more = outputs.wants(OutputFormat::Exr) || outputs.wants(OutputFormat::Svg);
        if wants_more && matches!(self.viewing.tracer, Tracer::Rays(_)) && outputs.drawn().any(is_scoped) {
            tell(Event::Note(&only_png("pictures in scopes")))?;
        }
        let mut pictures = Pictures::new(self, tell);
        let measured = if outputs.wants(OutputFormat::Json) { FIGURES } else { 0.0 };
        let mut pace =
            WorkShares::new(watch, outputs.drawn().map(|(_, p)| effort(p)).sum::<f64>() + measured);
        for (name, picture) in outputs.drawn() {
            pace.step(effort(picture), |watch| pictures.make(name, picture, watch))?;
        }
        if outputs.wants(OutputFormat::Json) {
            pace.step(FIGURES, |watch| self.write_figures(watch, tell))?;
        }
        // Nothing is left to stop.
        let _ = watch(1.0);
        Ok(())
    }

    fn check(&self) -> Result<(), Failure> {
        let (viewing, outputs) = (&self.viewing, self.outputs);
        outputs.check()?;
        self.fits_standard_output()?;
        for (name, picture) in outputs.drawn() {
            let Picture::Scoped(scoped) = picture else { continue };
            viewing.facing(scoped.side).check()?;
            if matches!(viewing.tracer, Tracer::Rays(_)) && !outputs.wants(OutputFormat::Png) {
                return Err(Failure::Usage(only_png(name)));
            }
        }
        if outputs.wants(OutputFormat::Json) { viewing.check() } else { Ok(()) }
    }

    /// Refuses several files where standard output is to take them.
    fn fits_standard_output(&self) -> Result<(), Failure> {
        if !is_standard(&self.outputs.folder) {
            return Ok(());
        }
        let named = Outputs { folder: PathBuf::new(), ..self.outputs.clone() };
        let paths = Export { outputs: &named, ..*self }.paths();
        if paths.len() == 1 {
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

    /// The files of a picture, in the order in which they are finished.
    fn files_of(&self, name: &str, picture: &Picture) -> Vec<PathBuf> {
        use OutputFormat::{Exr, Png, Svg};
        let files: &[(&str, OutputFormat)] = match (picture, self.viewing.tracer) {
            (Picture::Profile | Picture::Diagram, _) if self.viewing.specimen.stone().is_err() => &[],
            (Picture::Profile | Picture::Diagram, _) => &[("", Svg), ("", Png)],
            (Picture::Scoped(_), Tracer::Beams) => {
                &[("", Png), ("-strongest", Png), ("", Exr), ("-strongest", Svg), ("", Svg)]
            }
            (Picture::Scoped(_), Tracer::Rays(_)) => &[("", Png), ("-strongest", Png)],
        };
        let outputs = self.outputs;
        let wanted = files
            .iter()
            .filter(|(kind, format)| outputs.wants(*format) && (outputs.strongest || kind.is_empty()));
        let suffix = match picture {
            Picture::Scoped(scoped) => self.viewing.suffix(scoped),
            Picture::Profile | Picture::Diagram => String::new(),
        };
        wanted.map(|(kind, format)| self.outputs.path(&suffix, &format!("{name}{kind}"), *format)).collect()
    }

    fn figures_path(&self) -> PathBuf {
        self.outputs.path(&self.viewing.viewpoint.suffix(), "figures", OutputFormat::Json)
    }

    fn write_figures(&self, watch: Watch, tell: Reporter) -> Result<(), Failure> {
        tell(Event::Begun(&format!("measuring {}", self.viewing.file)))?;
        let report = measure(&self.viewing, &Scoped::aset(), watch, tell)?;
        write_text(&self.figures_path(), &format!("{:#}\n", report.json(self.outputs.timing)), tell)
    }
}

/// How long a picture takes, roughly.
fn effort(picture: &Picture) -> f64 {
    if matches!(picture, Picture::Scoped(_)) { 1.0 } else { DRAWING }
}

/// What to say of a picture that only exact beams make.
fn only_png(name: &str) -> String {
    format!("{name}: rays make PNG pictures only; SVG and EXR need exact beams")
}

fn write_text(path: &Path, text: &str, tell: Reporter) -> Result<(), Failure> {
    write(path, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))?;
    tell(Event::Written(path))
}
