//! The pictures and drawings of a stone, written one after the other.

use super::sampler::{Sampler, Subject};
use super::told::{Pace, Tell, Told};
use super::viewing::{Tracer, Viewing};
use super::{Export, Format, Outputs, write_text};
use crate::io::{Failure, PngRows, WriteError, rasterize, write_exr, write_png};
use crate::picture::by_rays::Manner;
use crate::picture::{DiagramStyle, Layer, Palette, Picture, Rows, Scoped, diagram, paint, profile, vector};
use crate::scene::{Film, Scope, View};
use crate::trace::Watch;
use crate::trace::beam::{self, Beams};
use crate::trace::ray::Camera;

/// Where pictures stop following beams when not told: below what eight bits can show.
const UNRESOLVED: f64 = 1e-3;

/// An energy drawing holds every polygon of the subdivision; finer than this it would be for no viewer.
const DRAWN_UNRESOLVED: f64 = 2e-2;

/// Nor for more polygons than about this many, where light is caught so well that it needs more: some 30 MB.
const DRAWN_POLYGONS: usize = 100_000;

/// Rays along each side of a pixel, for pictures by rays.
const RAYS_PER_SIDE: u32 = 4;

/// Writes the pictures of a stone.
pub(super) struct Pictures<'a> {
    viewing: Viewing<'a>,
    outputs: &'a Outputs,
    tell: Tell<'a>,
    /// The view that was traced last: scopes share it.
    last: Option<(View, Beams)>,
}

/// A picture in a scope.
struct Plate<'a> {
    name: &'a str,
    scope: Scope,
    viewing: Viewing<'a>,
    view: View,
}

impl<'a> Pictures<'a> {
    pub fn new(export: &Export<'a>, tell: Tell<'a>) -> Self {
        Self { viewing: export.viewing, outputs: export.outputs, tell, last: None }
    }

    /// Writes the files of one.
    pub fn make(&mut self, name: &str, picture: &Picture, watch: Watch) -> Result<(), Failure> {
        let design = &self.viewing.specimen.design;
        (self.tell)(Told::Begun(&self.title(name)))?;
        match (picture, self.viewing.specimen.stone()) {
            (Picture::Profile, Ok(stone)) => {
                self.drawing(name, &profile(stone, &design.name, design.cut.brilliant()))
            }
            (Picture::Diagram, Ok(stone)) => {
                self.drawing(name, &diagram(stone, &design.name, &DiagramStyle::SHEET))
            }
            (Picture::Profile | Picture::Diagram, Err(why)) => {
                (self.tell)(Told::Note(&format!("{name}: left out: {why}")))
            }
            (Picture::Scoped(scoped), _) => self.scoped(name, scoped, watch),
        }
    }

    fn title(&self, name: &str) -> String {
        format!("{}: {name}", self.viewing.specimen.design.name)
    }

    fn drawing(&self, name: &str, document: &svg::Document) -> Result<(), Failure> {
        let outputs = self.outputs;
        if !outputs.wants(Format::Svg) && !outputs.wants(Format::Png) {
            return (self.tell)(Told::Note(&format!("{name}: a drawing comes as PNG and SVG only")));
        }
        let text = document.to_string();
        if outputs.wants(Format::Svg) {
            write_text(&outputs.path(name, Format::Svg), &text, self.tell)?;
        }
        if outputs.wants(Format::Png) {
            let path = outputs.path(name, Format::Png);
            let (width, height, pixels) =
                rasterize(&text, outputs.size).map_err(|e| Failure::Output(e.to_string()))?;
            write_png(&path, (width, height), &self.title(name), |rows| rows.push(&pixels))?;
            (self.tell)(Told::Written(&path))?;
        }
        Ok(())
    }

    fn scoped(&mut self, name: &str, scoped: &Scoped, watch: Watch) -> Result<(), Failure> {
        let viewing = self.viewing.facing(scoped.side);
        let head = if scoped.takes_head { viewing.head_deg } else { 0.0 };
        let scope = scoped.scope.clone().with_head(head);
        let plate = Plate { name, scope, viewing, view: viewing.viewpoint.view() };
        match viewing.tracer {
            Tracer::Beams => self.by_beams(&plate, watch),
            Tracer::Rays(first) => first.or_rays(self.tell, |used| self.by_rays(used, &plate, watch)),
        }
    }

    fn by_beams(&mut self, plate: &Plate, watch: Watch) -> Result<(), Failure> {
        let wants = |format| f64::from(u8::from(self.outputs.wants(format)));
        let parts = 1.0 + 2.0 * wants(Format::Png) + wants(Format::Exr) + wants(Format::Svg);
        let mut pace = Pace::new(watch, parts);
        let beams = pace.step(1.0, |watch| self.traced(plate, watch))?;
        let film = Film::around(plate.viewing.specimen.solid(), &beams.view, self.outputs.size);
        if self.outputs.wants(Format::Png) {
            pace.step(1.0, |watch| {
                let layer = Layer::energy(&beams, &plate.scope);
                self.paint(plate, ("", &layer, "unresolved"), &film, watch)
            })?;
            pace.step(1.0, |watch| {
                let layer = Layer::strongest(&beams, &plate.scope);
                self.paint(plate, ("-strongest", &layer, "undecided"), &film, watch)
            })?;
        }
        if self.outputs.wants(Format::Exr) {
            pace.step(1.0, |watch| self.bare(plate, &beams, &film, watch))?;
        }
        if self.outputs.wants(Format::Svg) {
            pace.step(1.0, |watch| self.drawn(plate, &beams, watch))?;
        }
        self.last = Some((plate.view, beams));
        Ok(())
    }

    /// The beams of a picture's view.
    fn traced(&mut self, plate: &Plate, watch: Watch) -> Result<Beams, Failure> {
        let Plate { viewing, view, .. } = plate;
        match self.last.take() {
            Some((last, beams)) if last == *view => Ok(beams),
            _ => {
                let options = viewing.beams(UNRESOLVED);
                let polytope = &viewing.stone()?.polytope;
                let beams = beam::trace(polytope, viewing.medium, view, &options, watch)?;
                viewing.warn_of_open(&beams, &options, self.tell)?;
                Ok(beams)
            }
        }
    }

    /// A layer in colour; `open` is what its description calls the part that is open.
    fn paint(
        &self,
        plate: &Plate,
        (kind, layer, open): (&str, &Layer, &str),
        film: &Film,
        watch: Watch,
    ) -> Result<(), Failure> {
        let path = self.outputs.path(&format!("{}{kind}", plate.name), Format::Png);
        let palette = Palette::of(&plate.scope);
        write_png(&path, film.size.into(), &self.told_of_beams(plate, open, layer.open), |png| {
            paint(layer, film, watch, |rows| encode(rows, (&palette, 0), png))
        })?;
        (self.tell)(Told::Written(&path))
    }

    fn bare(&self, plate: &Plate, beams: &Beams, film: &Film, watch: Watch) -> Result<(), Failure> {
        let path = self.outputs.path(plate.name, Format::Exr);
        let layer = Layer::full(beams, &plate.scope);
        write_exr(&path, &layer, film, &self.told_of_beams(plate, "unresolved", layer.open), watch)?;
        (self.tell)(Told::Written(&path))
    }

    fn drawn(&self, plate: &Plate, beams: &Beams, watch: Watch) -> Result<(), Failure> {
        let Plate { name, scope, viewing, view } = plate;
        let stone = viewing.stone()?;
        let options = viewing.beams(UNRESOLVED);
        let title = format!("{}, {}", self.title(name), viewing.viewpoint.told());
        let copies = beams.symmetry.order() as usize;
        let unresolved = options.unresolved.max(DRAWN_UNRESOLVED);
        let coarse = beam::Options { unresolved, most_beams: DRAWN_POLYGONS / copies, ..options };
        let coarse = beam::trace(&stone.polytope, viewing.medium, view, &coarse, watch)?;
        let is_small = beams.strongest_exits().len() * copies <= DRAWN_POLYGONS;
        let mapped = if is_small { beams } else { &coarse };
        let strongest = vector::strongest(stone, mapped, scope, &format!("{title}, strongest exits"));
        let path = self.outputs.path(&format!("{name}-strongest"), Format::Svg);
        write_text(&path, &strongest.to_string(), self.tell)?;
        let energy = vector::energy(stone, &coarse, scope, &format!("{title}, energy"));
        write_text(&self.outputs.path(name, Format::Svg), &energy.to_string(), self.tell)
    }

    fn by_rays(&self, sampler: Sampler, plate: &Plate, watch: Watch) -> Result<(), Failure> {
        let Plate { name, scope, viewing, view } = plate;
        let solid = viewing.specimen.solid();
        let options = viewing.rays(UNRESOLVED);
        let reach = Camera::new(view, solid).reach(solid).unwrap_or(1.0);
        let film = Film::reaching(reach, self.outputs.size);
        let palette = Palette::of(scope);
        let tracer = format!("{}, each followed to {:.2e}", sampler.told(), options.least_weight);
        let told = self.told(plate, &tracer);
        let manner = Manner { options, per_side: RAYS_PER_SIDE };
        let look = Subject { specimen: viewing.specimen, medium: viewing.medium, view, scope };
        let path = |name: &str| self.outputs.path(name, Format::Png);
        let (energy, strongest) = (path(name), path(&format!("{name}-strongest")));
        let size = film.size.into();
        // Both pictures come from the same rays.
        write_png(&energy, size, &told, |energy| {
            write_png(&strongest, size, &told, |strongest| {
                sampler.rows(look, &film, &manner, watch, |rows| {
                    encode(rows, (&palette, 0), energy)?;
                    encode(rows, (&palette, scope.bands.len()), strongest)
                })
            })
        })?;
        (self.tell)(Told::Written(&energy))?;
        (self.tell)(Told::Written(&strongest))
    }

    fn told_of_beams(&self, plate: &Plate, open: &str, part: f64) -> String {
        self.told(plate, &format!("exact beams, {open} {part:.2e}"))
    }

    /// What goes into a picture as text.
    fn told(&self, plate: &Plate, tracer: &str) -> String {
        let Viewing { viewpoint, medium, polarised, .. } = &plate.viewing;
        let polarised = if *polarised { "polarised" } else { "unpolarised" };
        let (title, view) = (self.title(plate.name), viewpoint.told());
        format!("{title}; {view}; index {}, {polarised}; {tracer}", medium.index)
    }
}

/// Encodes rows of a picture, whose bands begin at a channel, and adds them to its file.
fn encode(rows: &Rows, (palette, first): (&Palette, usize), png: &mut PngRows) -> Result<(), WriteError> {
    let mut pixels = Vec::with_capacity(3 * rows.width as usize * rows.count as usize);
    (rows.first..rows.first + rows.count).for_each(|y| palette.encode(rows, first, y, &mut pixels));
    png.push(&pixels)
}
