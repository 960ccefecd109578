//! Writes the pictures and drawings of a stone, one after the other.

use super::event::{Event, Reporter, WorkShares};
use super::sheet::{ScopeSheet, SheetFile, UNRESOLVED, how, in_percent, remark};
use super::viewing::{Viewing, note};
use super::{Export, OutputFormat, Outputs, write_text};
use crate::{note_of_letters, rasterize, write_exr, write_png};
use brillianteer_base::{Failure, Watch};
use brillianteer_picture::{
    DiagramStyle, DrawnMarks, Layer, Palette, Picture, Scoped, marked_diagram, profile, vector,
};
use brillianteer_render::{Job, Partial, Reading, Rendered, Renderer};
use brillianteer_scene::{Film, Stone, View};
use brillianteer_trace::beam::{self, Beams};

/// The least share of the light that an energy drawing leaves unresolved. The drawing holds every polygon of the
/// subdivision, and no viewer could show a finer one.
const DRAWN_UNRESOLVED: f64 = 2e-2;

/// About how many polygons a drawing holds at most, some 30 MB. Only light that stays in the stone for long needs more.
const DRAWN_POLYGONS: usize = 100_000;

/// Writes the pictures of a stone.
pub(super) struct Pictures<'a> {
    pub(super) viewing: Viewing<'a>,
    pub(super) outputs: &'a Outputs,
    pub(super) tell: Reporter<'a>,
    pub(super) renderer: &'a mut Renderer,
    /// The view of the last picture by beams.
    last: Option<View>,
}

impl<'a> Pictures<'a> {
    pub fn new(export: &Export<'a>, renderer: &'a mut Renderer, tell: Reporter<'a>) -> Self {
        Self { viewing: export.viewing, outputs: export.outputs, tell, renderer, last: None }
    }

    /// Writes the files of one picture.
    pub fn make(&mut self, name: &str, picture: &Picture, watch: Watch) -> Result<(), Failure> {
        let design = &self.viewing.specimen.design;
        (self.tell)(Event::Begun(&self.title(name)))?;
        match (picture, self.viewing.specimen.stone()) {
            (Picture::Profile, Ok(stone)) => {
                self.drawing(name, &profile(stone, &design.name, design.cut.brilliant()))
            }
            (Picture::Diagram, Ok(stone)) => self.drawing(
                name,
                &marked_diagram(stone, &design.name, &DiagramStyle::SHEET, &self.marks(stone)),
            ),
            (Picture::Profile | Picture::Diagram, Err(why)) => {
                (self.tell)(Event::Note(&format!("{name}: left out: {why}")))
            }
            (Picture::Scoped(scoped), _) => self.scoped(name, scoped, watch),
            (Picture::Contrast, _) => self.contrast(name, watch),
        }
    }

    /// Returns the marks of all findings of the stone's audit, if the outputs mark them.
    fn marks(&self, stone: &Stone) -> DrawnMarks {
        let audit = self.outputs.mark_audit.then(|| self.viewing.specimen.audit().ok()).flatten();
        audit.map_or_else(DrawnMarks::default, |audit| DrawnMarks::of(stone, &audit.findings))
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
            if let Some(note) = note_of_letters([text.as_str()]) {
                (self.tell)(Event::Note(&format!("{}: {note}", path.display())))?;
            }
            let (width, height, pixels) =
                rasterize(&text, outputs.size).map_err(|e| Failure::Output(e.to_string()))?;
            write_png(&path, (width, height), &self.title(name), |rows| rows.push(&pixels))?;
            (self.tell)(Event::Written(&path))?;
        }
        Ok(())
    }

    fn scoped(&mut self, name: &str, scoped: &Scoped, watch: Watch) -> Result<(), Failure> {
        let viewing = self.viewing.facing(scoped.side);
        let sheet = ScopeSheet {
            name,
            suffix: self.viewing.suffix(scoped.side),
            scope: scoped.with_head(viewing.head_deg),
            viewing,
            glare: viewing.glare.unwrap_or_default(),
        };
        let job = sheet.job(self.outputs.size, self.readings());
        let wants = |format| f64::from(u8::from(self.outputs.wants(format)));
        let parts = 1.0 + self.readings().len() as f64;
        let mut pace = WorkShares::new(watch, parts + wants(OutputFormat::Exr) + wants(OutputFormat::Svg));
        let rendered = pace.step(parts, |watch| self.pixels(&sheet, &job, watch))?;
        let Some(beams) = rendered.beams() else { return Ok(()) };
        self.warn_of_open(&viewing, &job, &beams)?;
        if self.outputs.wants(OutputFormat::Exr) {
            pace.step(1.0, |watch| self.bare(&sheet, &beams, &job.film, watch))?;
        }
        if self.outputs.wants(OutputFormat::Svg) {
            pace.step(1.0, |watch| self.drawn(&sheet, &beams, watch))?;
        }
        Ok(())
    }

    /// Warns once of a view whose beams, which its pictures share, leave too much light unresolved.
    pub(super) fn warn_of_open(
        &mut self,
        viewing: &Viewing,
        job: &Job,
        beams: &Beams,
    ) -> Result<(), Failure> {
        if self.last.replace(job.view) == Some(job.view) {
            return Ok(());
        }
        viewing.warn_of_open((beams.unresolved(), beams.len()), job.quality.beams.unresolved, self.tell)
    }

    /// Returns the readings that are written as pixels.
    fn readings(&self) -> Vec<Reading> {
        match (self.outputs.wants(OutputFormat::Png), self.outputs.strongest) {
            (false, _) => vec![],
            (true, false) => vec![Reading::Energy],
            (true, true) => vec![Reading::Energy, Reading::Strongest],
        }
    }

    /// Traces a picture in a scope and writes its readings in colour, each with its caption under it.
    fn pixels(&mut self, sheet: &ScopeSheet, job: &Job, watch: Watch) -> Result<Rendered, Failure> {
        let (outputs, tell) = (self.outputs, self.tell);
        let palette = Palette::of(&sheet.scope);
        let mut files: Vec<SheetFile> = vec![];
        self.renderer.run(job, watch, &mut |part| match part {
            Partial::Begun { reading, backend, unresolved } => {
                files.retain(|file| file.reading != reading);
                files.push(SheetFile::begin(outputs, sheet, job, reading, (backend, unresolved))?);
                Ok(())
            }
            Partial::Rows { reading, rows, first_channel } => {
                let Some(k) = files.iter().position(|file| file.reading == reading) else { return Ok(()) };
                if files[k].push(rows, &palette, first_channel)? {
                    tell(Event::Written(&files.remove(k).finish()?))?;
                }
                Ok(())
            }
            other => note(&other, tell),
        })
    }

    /// Returns the SVG text of a drawing with its caption under it.
    fn captioned(&self, drawn: svg::Document, sheet: &ScopeSheet, reading: Reading, open: f64) -> String {
        if !self.outputs.caption {
            return drawn.to_string();
        }
        let caption = sheet.caption(reading, &in_percent(reading, open));
        caption.under(drawn, f64::from(vector::SIDE)).to_string()
    }

    fn bare(&self, sheet: &ScopeSheet, beams: &Beams, film: &Film, watch: Watch) -> Result<(), Failure> {
        let path = self.outputs.path(&sheet.suffix, sheet.name, OutputFormat::Exr);
        let layer = Layer::full(beams, &sheet.scope);
        let how = how(Reading::Energy, layer.open);
        write_exr(&path, &layer, film, &sheet.description("all light, by channels", &how), watch)?;
        (self.tell)(Event::Written(&path))
    }

    fn drawn(&self, sheet: &ScopeSheet, beams: &Beams, watch: Watch) -> Result<(), Failure> {
        let ScopeSheet { name, suffix, scope, viewing, .. } = sheet;
        let view = &viewing.view();
        let stone = viewing.stone()?;
        let options = viewing.beams(UNRESOLVED);
        let title = format!("{}, {}", sheet.title(), viewing.described().description());
        let copies = beams.symmetry.order() as usize;
        let unresolved = options.unresolved.max(DRAWN_UNRESOLVED);
        let coarse = beam::BeamOptions { unresolved, most_beams: DRAWN_POLYGONS / copies, ..options };
        let coarse = beam::trace(&stone.polytope, viewing.medium, view, &coarse, watch)?;
        if self.outputs.strongest {
            let is_small = beams.strongest_exits().len() * copies <= DRAWN_POLYGONS;
            let mapped = if is_small { beams } else { &coarse };
            let strongest = vector::strongest(
                stone,
                mapped,
                scope,
                &format!("{title}, {}", remark(Reading::Strongest, sheet.glare)),
            );
            let undecided = mapped.undecided(&mapped.strongest_exits());
            let strongest = self.captioned(strongest, sheet, Reading::Strongest, undecided);
            let path = self.outputs.path(suffix, &format!("{name}-strongest"), OutputFormat::Svg);
            write_text(&path, &strongest, self.tell)?;
        }
        let reading = remark(Reading::Energy, sheet.glare);
        let energy = vector::energy(stone, &coarse, (scope, sheet.glare), &format!("{title}, {reading}"));
        let energy = self.captioned(energy, sheet, Reading::Energy, coarse.unresolved());
        write_text(&self.outputs.path(suffix, name, OutputFormat::Svg), &energy, self.tell)
    }
}
