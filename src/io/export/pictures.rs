//! Writes the pictures and drawings of a stone, one after the other.

use super::event::{Event, Reporter, WorkShares};
use super::viewing::Viewing;
use super::{Export, OutputFormat, Outputs, write_text};
use crate::io::{Failure, PngRows, WriteError, rasterize, write_exr, write_png};
use crate::picture::by_rays::ScopeSampling;
use crate::picture::{
    Caption, DiagramStyle, Layer, Palette, Picture, Rows, Scoped, diagram, paint, profile, vector,
};
use crate::scene::{Film, Glare, Scope, View};
use crate::trace::beam::{self, Beams};
use crate::trace::ray::Camera;
use crate::trace::{RayTracer, Subject, Tracer, Watch};

/// The share of the light that pictures leave unresolved where no bound is given: less than eight bits can show.
const UNRESOLVED: f64 = 1e-3;

/// The least share of the light that an energy drawing leaves unresolved. The drawing holds every polygon of the
/// subdivision, and no viewer could show a finer one.
const DRAWN_UNRESOLVED: f64 = 2e-2;

/// About how many polygons a drawing holds at most, some 30 MB. Only light that stays in the stone for long needs more.
const DRAWN_POLYGONS: usize = 100_000;

/// The number of rays along each side of a pixel, in pictures by rays.
const RAYS_PER_SIDE: u32 = 4;

/// Writes the pictures of a stone.
pub(super) struct Pictures<'a> {
    viewing: Viewing<'a>,
    outputs: &'a Outputs,
    tell: Reporter<'a>,
    /// The view that was traced last and its beams, which the scopes share.
    last: Option<(View, Beams)>,
}

/// A picture in a scope, with all that it is made from.
struct Plate<'a> {
    name: &'a str,
    /// The part of its files' names that describes the view.
    suffix: String,
    scope: Scope,
    viewing: Viewing<'a>,
    view: View,
    glare: Glare,
}

/// What a picture by strongest exits shows, in words.
const STRONGEST: &str = "strongest exits";

/// The width in pixels up to which a caption's lines are broken to fit; a caption of a wider picture is scaled up instead.
const CAPTION_WIDTH: u32 = 1000;

impl<'a> Pictures<'a> {
    pub fn new(export: &Export<'a>, tell: Reporter<'a>) -> Self {
        Self { viewing: export.viewing, outputs: export.outputs, tell, last: None }
    }

    /// Writes the files of one picture.
    pub fn make(&mut self, name: &str, picture: &Picture, watch: Watch) -> Result<(), Failure> {
        let design = &self.viewing.specimen.design;
        (self.tell)(Event::Begun(&self.title(name)))?;
        match (picture, self.viewing.specimen.stone()) {
            (Picture::Profile, Ok(stone)) => {
                self.drawing(name, &profile(stone, &design.name, design.cut.brilliant()))
            }
            (Picture::Diagram, Ok(stone)) => {
                self.drawing(name, &diagram(stone, &design.name, &DiagramStyle::SHEET))
            }
            (Picture::Profile | Picture::Diagram, Err(why)) => {
                (self.tell)(Event::Note(&format!("{name}: left out: {why}")))
            }
            (Picture::Scoped(scoped), _) => self.scoped(name, scoped, watch),
        }
    }

    fn title(&self, name: &str) -> String {
        format!("{}: {name}", self.viewing.specimen.design.name)
    }

    fn drawing(&self, name: &str, document: &svg::Document) -> Result<(), Failure> {
        let outputs = self.outputs;
        if !outputs.wants(OutputFormat::Svg) && !outputs.wants(OutputFormat::Png) {
            return (self.tell)(Event::Note(&format!("{name}: a drawing comes as PNG and SVG only")));
        }
        let text = document.to_string();
        if outputs.wants(OutputFormat::Svg) {
            write_text(&outputs.path("", name, OutputFormat::Svg), &text, self.tell)?;
        }
        if outputs.wants(OutputFormat::Png) {
            let path = outputs.path("", name, OutputFormat::Png);
            let (width, height, pixels) =
                rasterize(&text, outputs.size).map_err(|e| Failure::Output(e.to_string()))?;
            write_png(&path, (width, height), &self.title(name), |rows| rows.push(&pixels))?;
            (self.tell)(Event::Written(&path))?;
        }
        Ok(())
    }

    fn scoped(&mut self, name: &str, scoped: &Scoped, watch: Watch) -> Result<(), Failure> {
        let viewing = self.viewing.facing(scoped.side);
        let scope = scoped.with_head(viewing.head_deg);
        let (suffix, view) = (self.viewing.suffix(scoped), viewing.view());
        let plate = Plate { name, suffix, scope, viewing, view, glare: viewing.glare.unwrap_or_default() };
        match viewing.tracer {
            Tracer::Beams => self.by_beams(&plate, watch),
            Tracer::Rays(first) => first.or_rays(self.tell, |used| self.by_rays(used, &plate, watch)),
        }
    }

    fn by_beams(&mut self, plate: &Plate, watch: Watch) -> Result<(), Failure> {
        let wants = |format| f64::from(u8::from(self.outputs.wants(format)));
        let strongest = f64::from(u8::from(self.outputs.strongest));
        let parts = 1.0
            + (1.0 + strongest) * wants(OutputFormat::Png)
            + wants(OutputFormat::Exr)
            + wants(OutputFormat::Svg);
        let mut pace = WorkShares::new(watch, parts);
        let beams = pace.step(1.0, |watch| self.traced(plate, watch))?;
        let film = Film::around(plate.viewing.specimen.solid(), &beams.view, self.outputs.size);
        if self.outputs.wants(OutputFormat::Png) {
            pace.step(1.0, |watch| {
                let layer = Layer::energy(&beams, &plate.scope, plate.glare);
                self.paint(plate, (Reading::Energy, &layer), &film, watch)
            })?;
        }
        if self.outputs.wants(OutputFormat::Png) && self.outputs.strongest {
            pace.step(1.0, |watch| {
                let layer = Layer::strongest(&beams, &plate.scope);
                self.paint(plate, (Reading::Strongest, &layer), &film, watch)
            })?;
        }
        if self.outputs.wants(OutputFormat::Exr) {
            pace.step(1.0, |watch| self.bare(plate, &beams, &film, watch))?;
        }
        if self.outputs.wants(OutputFormat::Svg) {
            pace.step(1.0, |watch| self.drawn(plate, &beams, watch))?;
        }
        self.last = Some((plate.view, beams));
        Ok(())
    }

    /// Returns the beams of a picture's view, those of the last picture where it had the same view.
    fn traced(&mut self, plate: &Plate, watch: Watch) -> Result<Beams, Failure> {
        let Plate { viewing, view, .. } = plate;
        match self.last.take() {
            Some((last, beams)) if last == *view => Ok(beams),
            _ => {
                let options = viewing.beams(UNRESOLVED);
                let polytope = &viewing.stone()?.polytope;
                let beams = beam::trace(polytope, viewing.medium, view, &options, watch)?;
                viewing.warn_of_open((beams.unresolved(), beams.len()), options.unresolved, self.tell)?;
                Ok(beams)
            }
        }
    }

    /// Writes a layer in colour as a PNG, with its caption under it.
    fn paint(
        &self,
        plate: &Plate,
        (reading, layer): (Reading, &Layer),
        film: &Film,
        watch: Watch,
    ) -> Result<(), Failure> {
        let path =
            self.outputs.path(&plate.suffix, &format!("{}{}", plate.name, reading.kind()), OutputFormat::Png);
        let palette = Palette::of(&plate.scope);
        let how = reading.how(layer.open);
        let caption = self.caption_pixels(plate, reading, &reading.in_percent(layer.open))?;
        let size = (film.size[0], film.size[1] + caption.0);
        write_png(&path, size, &self.description(plate, &reading.remark(plate.glare), &how), |png| {
            paint(layer, film, watch, |rows| encode(rows, (&palette, 0), png))?;
            png.push(&caption.1).map_err(Failure::from)
        })?;
        (self.tell)(Event::Written(&path))
    }

    /// Returns the caption of a picture if captions are wanted; `how` says how the picture was traced.
    fn caption(&self, plate: &Plate, reading: Reading, how: &str) -> Option<Caption> {
        if !self.outputs.caption {
            return None;
        }
        let Plate { scope, viewing, .. } = plate;
        let Viewing { medium, polarised, wavelength_nm, specimen, .. } = viewing;
        let material = &specimen.material;
        let light = match wavelength_nm {
            // A material that is given by its index alone has no other name.
            Some(nm) if material.name.starts_with("index ") => {
                format!("index {:.4} at {nm} nm", medium.index)
            }
            Some(nm) => format!("{}, index {:.4} at {nm} nm", material.name, medium.index),
            None => format!("index {}", medium.index),
        };
        let colour = if material.colour_is_illustrative { ", colour illustrative" } else { "" };
        let polarised = if *polarised { "polarised" } else { "unpolarised" };
        let view =
            format!("{}: {}; {}", scope.name, reading.remark(plate.glare), viewing.described().description());
        let program = concat!("Brillianteer ", env!("CARGO_PKG_VERSION"));
        let mut remarks = vec![view, format!("{light}{colour}, {polarised}; {how}; {program}")];
        if matches!(reading, Reading::Energy) {
            remarks.push("Mixed colours: light from several zones.".to_owned());
        }
        Some(Caption::new(&specimen.design.name, remarks, scope))
    }

    /// Returns the caption's height in pixels and its pixels, in rows as wide as the picture.
    fn caption_pixels(&self, plate: &Plate, reading: Reading, how: &str) -> Result<(u32, Vec<u8>), Failure> {
        let Some(caption) = self.caption(plate, reading, how) else { return Ok((0, vec![])) };
        let size = self.outputs.size;
        let text = caption.document(f64::from(size.min(CAPTION_WIDTH))).to_string();
        let (_, height, pixels) = rasterize(&text, size).map_err(|e| Failure::Output(e.to_string()))?;
        Ok((height, pixels))
    }

    /// Returns the SVG text of a drawing with its caption under it.
    fn captioned(&self, drawn: svg::Document, plate: &Plate, reading: Reading, open: f64) -> String {
        match self.caption(plate, reading, &reading.in_percent(open)) {
            Some(caption) => caption.under(drawn, f64::from(vector::SIDE)).to_string(),
            None => drawn.to_string(),
        }
    }

    fn bare(&self, plate: &Plate, beams: &Beams, film: &Film, watch: Watch) -> Result<(), Failure> {
        let path = self.outputs.path(&plate.suffix, plate.name, OutputFormat::Exr);
        let layer = Layer::full(beams, &plate.scope);
        let how = Reading::Energy.how(layer.open);
        write_exr(&path, &layer, film, &self.description(plate, "all light, by channels", &how), watch)?;
        (self.tell)(Event::Written(&path))
    }

    fn drawn(&self, plate: &Plate, beams: &Beams, watch: Watch) -> Result<(), Failure> {
        let Plate { name, suffix, scope, viewing, view, .. } = plate;
        let stone = viewing.stone()?;
        let options = viewing.beams(UNRESOLVED);
        let title = format!("{}, {}", self.title(name), viewing.described().description());
        let copies = beams.symmetry.order() as usize;
        let unresolved = options.unresolved.max(DRAWN_UNRESOLVED);
        let coarse = beam::BeamOptions { unresolved, most_beams: DRAWN_POLYGONS / copies, ..options };
        let coarse = beam::trace(&stone.polytope, viewing.medium, view, &coarse, watch)?;
        if self.outputs.strongest {
            let is_small = beams.strongest_exits().len() * copies <= DRAWN_POLYGONS;
            let mapped = if is_small { beams } else { &coarse };
            let strongest = vector::strongest(stone, mapped, scope, &format!("{title}, {STRONGEST}"));
            let undecided = mapped.undecided(&mapped.strongest_exits());
            let strongest = self.captioned(strongest, plate, Reading::Strongest, undecided);
            let path = self.outputs.path(suffix, &format!("{name}-strongest"), OutputFormat::Svg);
            write_text(&path, &strongest, self.tell)?;
        }
        let reading = Reading::Energy.remark(plate.glare);
        let energy = vector::energy(stone, &coarse, (scope, plate.glare), &format!("{title}, {reading}"));
        let energy = self.captioned(energy, plate, Reading::Energy, coarse.unresolved());
        write_text(&self.outputs.path(suffix, name, OutputFormat::Svg), &energy, self.tell)
    }

    fn by_rays(&self, sampler: RayTracer, plate: &Plate, watch: Watch) -> Result<(), Failure> {
        let Plate { name, suffix, scope, viewing, view, glare } = plate;
        let solid = viewing.specimen.solid();
        let options = viewing.rays(UNRESOLVED);
        let reach = Camera::new(view, solid).reach(solid).unwrap_or(1.0);
        let film = Film::reaching(reach, self.outputs.size);
        let palette = Palette::of(scope);
        let how = format!("{}, each followed to {:.2e}", sampler.description(), options.least_weight);
        let manner = ScopeSampling { options, per_side: RAYS_PER_SIDE, glare: *glare };
        let look = Subject { specimen: viewing.specimen, medium: viewing.medium, view, scope };
        let path = |name: &str| self.outputs.path(suffix, name, OutputFormat::Png);
        let (energy, strongest) = (path(name), path(&format!("{name}-strongest")));
        let both = [Reading::Energy, Reading::Strongest];
        let [told, strongest_told] =
            both.map(|reading| self.description(plate, &reading.remark(*glare), &how));
        let caption = self.caption_pixels(plate, Reading::Energy, &how)?;
        let strongest_caption = self.caption_pixels(plate, Reading::Strongest, &how)?;
        let size = |caption: &(u32, Vec<u8>)| (film.size[0], film.size[1] + caption.0);
        if !self.outputs.strongest {
            write_png(&energy, size(&caption), &told, |energy| {
                sampler.rows(look, &film, &manner, watch, |rows| encode(rows, (&palette, 0), energy))?;
                energy.push(&caption.1).map_err(Failure::from)
            })?;
            return (self.tell)(Event::Written(&energy));
        }
        // Both pictures come from the same rays.
        write_png(&energy, size(&caption), &told, |energy| {
            write_png(&strongest, size(&strongest_caption), &strongest_told, |strongest| {
                sampler.rows(look, &film, &manner, watch, |rows| {
                    encode(rows, (&palette, 0), energy)?;
                    encode(rows, (&palette, scope.bands.len()), strongest)
                })?;
                strongest.push(&strongest_caption.1).map_err(Failure::from)
            })?;
            energy.push(&caption.1).map_err(Failure::from)
        })?;
        (self.tell)(Event::Written(&energy))?;
        (self.tell)(Event::Written(&strongest))
    }

    /// The text that is stored in a picture's file: what it shows, and how it was traced.
    fn description(&self, plate: &Plate, reading: &str, how: &str) -> String {
        let Viewing { medium, polarised, .. } = &plate.viewing;
        let polarised = if *polarised { "polarised" } else { "unpolarised" };
        let (title, view) = (self.title(plate.name), plate.viewing.described().description());
        format!("{title}; {view}; index {}, {polarised}; {reading}; {how}", medium.index)
    }
}

/// Which of the two readings of a scope a picture shows.
#[derive(Clone, Copy)]
enum Reading {
    Energy,
    Strongest,
}

impl Reading {
    /// The part of the file's name that follows the scope's name.
    fn kind(self) -> &'static str {
        match self {
            Self::Energy => "",
            Self::Strongest => "-strongest",
        }
    }

    /// Describes the reading in words.
    fn remark(self, glare: Glare) -> String {
        match self {
            Self::Energy => format!("energy, {}", glare.description()),
            Self::Strongest => STRONGEST.to_owned(),
        }
    }

    /// Describes a trace by exact beams that leaves `part` of the light or the area open.
    fn how(self, part: f64) -> String {
        let open = match self {
            Self::Energy => "unresolved",
            Self::Strongest => "undecided",
        };
        format!("exact beams, {open} {part:.2e}")
    }

    /// Describes the same trace in percent, for captions.
    fn in_percent(self, part: f64) -> String {
        let what = match self {
            Self::Energy => "light unresolved",
            Self::Strongest => "area undecided",
        };
        format!("exact beams, {:.2} % of the {what}", 100.0 * part)
    }
}

/// Encodes rows of a picture whose bands begin at the channel `first`, and adds them to its file.
fn encode(rows: &Rows, (palette, first): (&Palette, usize), png: &mut PngRows) -> Result<(), WriteError> {
    let mut pixels = Vec::with_capacity(3 * rows.width as usize * rows.count as usize);
    (rows.first..rows.first + rows.count).for_each(|y| palette.encode(rows, first, y, &mut pixels));
    png.push(&pixels)
}
