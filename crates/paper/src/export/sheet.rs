//! A picture in a scope as it is written: its pixels, and under them the explanatory caption.

use super::viewing::Viewing;
use super::{OutputFormat, Outputs};
use crate::{PngFile, rasterize};
use brillianteer_base::Failure;
use brillianteer_picture::{Caption, Palette, Rows};
use brillianteer_render::{Backend, Job, Product, Reading, ScopeProduct};
use brillianteer_scene::{Glare, Scope};
use std::path::PathBuf;

/// The share of the light that pictures leave unresolved where no bound is given: less than a step of eight bits.
pub(super) const UNRESOLVED: f64 = 1e-3;

/// The width in pixels up to which a caption's lines are broken to fit; a caption of a wider picture is scaled up instead.
const CAPTION_WIDTH: u32 = 1000;

/// The program as captions name it.
pub const PROGRAM: &str = concat!("Brillianteer ", env!("CARGO_PKG_VERSION"));

/// A picture in a scope, with all that it is made from.
pub(super) struct ScopeSheet<'a> {
    /// The name that the picture bears in the names of its files.
    pub name: &'a str,
    /// The part of its files' names that describes the view.
    pub suffix: String,
    /// The scope, with the observer's head.
    pub scope: Scope,
    /// The stone, seen from the side that the picture is made for.
    pub viewing: Viewing<'a>,
    /// Included where the energy contains glare.
    pub glare: Glare,
}

/// Describes a reading in words.
pub(super) fn remark(reading: Reading, glare: Glare) -> String {
    match reading {
        Reading::Energy => format!("energy, {}", glare.description()),
        Reading::Strongest => "strongest exits".to_owned(),
    }
}

/// The part of a file's name that follows the scope's name.
pub(super) fn kind(reading: Reading) -> &'static str {
    match reading {
        Reading::Energy => "",
        Reading::Strongest => "-strongest",
    }
}

/// Describes a trace by exact beams that leaves `part` of the light or the area open.
pub(super) fn how(reading: Reading, part: f64) -> String {
    let open = match reading {
        Reading::Energy => "unresolved",
        Reading::Strongest => "undecided",
    };
    format!("exact beams, {open} {part:.2e}")
}

/// Describes how a job was traced. Exact beams give `open`, the part of the light or of the area that they leave open; rays give
/// `None`.
pub(super) fn traced(reading: Reading, (backend, open): (&Backend, Option<f64>), job: &Job) -> String {
    match open {
        Some(open) => how(reading, open),
        None => format!("{}, each followed to {:.2e}", backend.description(), job.quality.rays.least_weight),
    }
}

/// Describes the same trace in percent, for captions.
pub(super) fn in_percent(reading: Reading, part: f64) -> String {
    let what = match reading {
        Reading::Energy => "light unresolved",
        Reading::Strongest => "area undecided",
    };
    format!("exact beams, {:.2} % of the {what}", 100.0 * part)
}

impl ScopeSheet<'_> {
    /// Returns the job of this picture, with these readings, on a square of `size` pixels.
    pub fn job(&self, size: u32, readings: Vec<Reading>) -> Job {
        let (scope, medium, glare) = (self.scope.clone(), self.viewing.medium, self.glare);
        let product = Product::Scope(ScopeProduct { scope, medium, glare, readings });
        self.viewing.job(self.viewing.film(size), product, UNRESOLVED)
    }

    /// Returns the picture's title, for texts in files.
    pub fn title(&self) -> String {
        format!("{}: {}", self.viewing.specimen.design.name, self.name)
    }

    /// Returns the text that is stored in a picture's file: the subject of the picture, and its tracer.
    pub fn description(&self, reading: &str, how: &str) -> String {
        format!("{}; {reading}; {how}", self.viewing.seen_in_words(self.name))
    }

    /// Returns the caption; `how` describes the tracing.
    pub fn caption(&self, reading: Reading, how: &str) -> Caption {
        let seen = self.viewing.described().description();
        self.caption_of(reading, &seen, &format!("{how}; "))
    }

    /// Returns the caption of a picture of energy in an animation: `seen` describes the viewpoint, and the tracing is
    /// left out.
    pub fn moving_caption(&self, seen: &str) -> Caption {
        self.caption_of(Reading::Energy, seen, "")
    }

    fn caption_of(&self, reading: Reading, seen: &str, how: &str) -> Caption {
        let ScopeSheet { scope, viewing, .. } = self;
        let view = format!("{}: {}; {seen}", scope.name, remark(reading, self.glare));
        let mut remarks = vec![view, format!("{}; {how}{PROGRAM}", viewing.light_in_words())];
        if reading == Reading::Energy {
            remarks.push("Mixed colours: light from several zones.".to_owned());
        }
        Caption::new(&viewing.specimen.design.name, remarks, scope)
    }
}

/// The PNG of one reading that is being written.
pub(super) struct SheetFile {
    pub reading: Reading,
    pub path: PathBuf,
    png: PngFile,
    caption: Vec<u8>,
    rows_missing: u32,
}

impl SheetFile {
    /// Begins the file of a reading; exact beams leave the part `open` of the light or the area unresolved.
    pub fn begin(
        outputs: &Outputs,
        sheet: &ScopeSheet,
        job: &Job,
        reading: Reading,
        (backend, open): (&Backend, Option<f64>),
    ) -> Result<Self, Failure> {
        let path =
            outputs.path(&sheet.suffix, &format!("{}{}", sheet.name, kind(reading)), OutputFormat::Png);
        let how = traced(reading, (backend, open), job);
        let in_caption = open.map_or_else(|| how.clone(), |open| in_percent(reading, open));
        let [width, height] = job.film.size;
        let (below, caption) = if outputs.caption {
            caption_pixels(&sheet.caption(reading, &in_caption), width)?
        } else {
            (0, vec![])
        };
        let description = sheet.description(&remark(reading, sheet.glare), &how);
        let png = PngFile::begin(&path, (width, height + below), &description)?;
        Ok(Self { reading, path, png, caption, rows_missing: height })
    }

    /// Adds rows whose bands begin at a channel; says whether the picture is complete.
    pub fn push(&mut self, rows: &Rows, palette: &Palette, first_channel: usize) -> Result<bool, Failure> {
        let mut pixels = Vec::with_capacity(3 * rows.width as usize * rows.count as usize);
        for y in rows.first..rows.first + rows.count {
            palette.encode(rows, first_channel, y, &mut pixels);
        }
        self.png.push(&pixels)?;
        self.rows_missing -= rows.count;
        Ok(self.rows_missing == 0)
    }

    /// Adds the caption and moves the file to its path, which it returns.
    pub fn finish(mut self) -> Result<PathBuf, Failure> {
        self.png.push(&self.caption)?;
        self.png.finish()?;
        Ok(self.path)
    }
}

/// Returns a caption's height in pixels and its pixels (red, green and blue), in rows of this width.
///
/// # Errors
/// Fails with [`Failure::Output`] where the caption cannot be drawn.
pub fn caption_pixels(caption: &Caption, width: u32) -> Result<(u32, Vec<u8>), Failure> {
    let text = caption.document(f64::from(width.min(CAPTION_WIDTH))).to_string();
    let (_, height, pixels) = rasterize(&text, width).map_err(|e| Failure::Output(e.to_string()))?;
    Ok((height, pixels))
}
