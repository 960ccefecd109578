//! `export`: pictures, drawings and figures of a stone, as files.

use super::measure::measure;
use super::options::{LightOptions, Tracer, ViewOptions};
use super::progress::Progress;
use super::sampler::{Sampler, Subject};
use super::specimen::{Specimen, stem};
use super::{Failure, each_file, json, print, say};
use crate::cut::Cut;
use crate::io::{self, MOST_PIXELS, PngRows, WriteError, rasterize, scope_file, write_exr, write_png};
use crate::picture::by_rays::Manner;
use crate::picture::{Layer, Palette, Picture, Rows, Scoped, diagram, named, names, paint, profile, vector};
use crate::scene::{Film, Medium, Scope, View};
use crate::trace::Watch;
use crate::trace::beam::{self, Beams};
use crate::trace::ray::Camera;
use clap::{Args, ValueEnum};
use std::collections::HashSet;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Where pictures stop following beams when not told: below what eight bits can show.
const UNRESOLVED: f64 = 1e-3;

/// An energy drawing holds every polygon of the subdivision; finer than this it would be for no viewer.
const DRAWN_UNRESOLVED: f64 = 2e-2;

/// Nor for more polygons than about this many, where light is caught so well that it needs more: some 30 MB.
const DRAWN_POLYGONS: usize = 100_000;

/// The largest EXR: it is held in memory, a dozen channels deep.
const MOST_EXR_PIXELS: u32 = 8192;

/// Rays along each side of a pixel, for pictures by rays.
const RAYS_PER_SIDE: u32 = 4;

#[derive(Debug, Args)]
pub struct Export {
    /// Cut files, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Pictures to make, separated by commas [default: all of them]
    #[arg(long, value_delimiter = ',', value_parser = names().to_vec())]
    views: Vec<String>,
    /// A scope of your own, as a file (see `scopes`); may be given several times
    #[arg(long, value_name = "FILE")]
    scope: Vec<PathBuf>,
    /// Pixels along each side
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=i64::from(MOST_PIXELS)))]
    size: u32,
    /// Kinds of file to write, separated by commas
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = [Format::Png, Format::Svg, Format::Json])]
    format: Vec<Format>,
    /// Folder to write to
    #[arg(long, default_value = "out")]
    out: PathBuf,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    light: LightOptions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Pictures of energy and of strongest exits, sRGB
    Png,
    /// The virtual facets as polygons
    Svg,
    /// Energy of each zone, 32-bit and linear
    Exr,
    /// Figures of the view, as `measure --json` prints them
    Json,
}

impl Export {
    pub fn run(&self) -> Result<(), Failure> {
        if self.format.contains(&Format::Exr) && self.size > MOST_EXR_PIXELS {
            return Err(Failure::Usage(format!(
                "--size {}: an EXR may have {MOST_EXR_PIXELS} pixels a side",
                self.size
            )));
        }
        let pictures = self.pictures()?;
        self.distinct_outputs(&pictures)?;
        each_file(&self.files, |file| {
            let specimen = Specimen::load(file)?;
            let medium = self.light.medium(&specimen)?;
            let mut job = Job { export: self, medium, specimen: &specimen, last: None };
            let drawn = self.format.iter().any(|&f| f != Format::Json);
            for (name, picture) in pictures.iter().filter(|_| drawn) {
                match picture {
                    Picture::Profile => {
                        let brilliant = match &specimen.design.cut {
                            Cut::RoundBrilliant(brilliant) => Some(brilliant),
                            Cut::Planes(_) => None,
                        };
                        job.drawing(name, &profile(&specimen.stone, &specimen.design.name, brilliant))?;
                    }
                    Picture::Diagram => {
                        job.drawing(name, &diagram(&specimen.stone, &specimen.design.name))?
                    }
                    Picture::Scoped(scoped) => job.scoped(name, scoped)?,
                }
            }
            if self.format.contains(&Format::Json) { job.figures() } else { Ok(()) }
        })
    }

    fn pictures(&self) -> Result<Vec<(String, Picture)>, Failure> {
        let all = self.views.is_empty() && self.scope.is_empty();
        let wanted = if all { names().map(String::from).to_vec() } else { self.views.clone() };
        let mut pictures: Vec<(String, Picture)> =
            wanted.into_iter().filter_map(|name| named(&name).map(|p| (name, p))).collect();
        for path in &self.scope {
            let scope = scope_file::read(path).map_err(Failure::Input)?;
            let name = scope.name.clone();
            pictures.push((name, Picture::Scoped(Scoped { scope, side: None, takes_head: true })));
        }
        Ok(pictures)
    }

    /// Refuses what would write two things to one file.
    fn distinct_outputs(&self, pictures: &[(String, Picture)]) -> Result<(), Failure> {
        let mut seen = HashSet::new();
        for file in &self.files {
            let stem = stem(file);
            let pictured = pictures.iter().flat_map(|(name, picture)| {
                let strongest =
                    matches!(picture, Picture::Scoped(_)).then(|| format!("{stem}-{name}-strongest"));
                strongest.into_iter().chain([format!("{stem}-{name}")])
            });
            let figures = format!("{stem}-figures.json");
            if let Some(twice) = pictured.chain([figures]).find(|name| !seen.insert(name.clone())) {
                return Err(Failure::Usage(format!(
                    "{}: two outputs would be called '{twice}'; give each stone and picture one name, or export \
                     to different --out folders",
                    file.display()
                )));
            }
        }
        Ok(())
    }
}

/// One stone to export.
struct Job<'a> {
    export: &'a Export,
    specimen: &'a Specimen,
    medium: Medium,
    /// The view that was traced last: scopes share it.
    last: Option<(View, Beams)>,
}

impl Job<'_> {
    fn path(&self, name: &str, ending: &str) -> PathBuf {
        self.export.out.join(format!("{}-{name}.{ending}", stem(Path::new(&self.specimen.path))))
    }

    fn wants(&self, format: Format) -> bool {
        self.export.format.contains(&format)
    }

    fn done(&self, path: &Path) -> Result<(), Failure> {
        print(&path.display().to_string())
    }

    fn text(&self, path: &Path, text: &str) -> Result<(), Failure> {
        io::write(path, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))?;
        self.done(path)
    }

    fn figures(&self) -> Result<(), Failure> {
        let measured = measure(self.specimen, &self.export.view, &self.export.light)?;
        let path = self.path("figures", "json");
        self.text(&path, &(json(&measured.json(self.specimen, &self.export.view, &self.export.light)) + "\n"))
    }

    fn drawing(&self, name: &str, document: &svg::Document) -> Result<(), Failure> {
        if !self.wants(Format::Svg) && !self.wants(Format::Png) {
            say(&format!("note: {name}: a drawing comes as PNG and SVG only"));
            return Ok(());
        }
        let text = document.to_string();
        if self.wants(Format::Svg) {
            self.text(&self.path(name, "svg"), &text)?;
        }
        if self.wants(Format::Png) {
            let path = self.path(name, "png");
            let (width, height, pixels) =
                rasterize(&text, self.export.size).map_err(|e| Failure::Output(e.to_string()))?;
            write_png(&path, (width, height), &self.title(name), |rows| rows.push(&pixels))?;
            self.done(&path)?;
        }
        Ok(())
    }

    fn title(&self, name: &str) -> String {
        format!("{}: {name}", self.specimen.design.name)
    }

    fn scoped(&mut self, name: &str, scoped: &Scoped) -> Result<(), Failure> {
        let head = if scoped.takes_head { self.export.light.head()? } else { 0.0 };
        let scope = scoped.scope.clone().with_head(head);
        let view = self.export.view.view(scoped.side)?;
        let progress = Progress::new(&self.title(name));
        let watch = progress.watch();
        match self.export.light.tracer(&view, self.specimen)? {
            Tracer::Beams => {
                let beams = match self.last.take() {
                    Some((last, beams)) if last == view => beams,
                    _ => {
                        let options = self.export.light.beams(UNRESOLVED)?;
                        let polytope = &self.specimen.stone.polytope;
                        let beams = beam::trace(polytope, self.medium, &view, &options, &watch)?;
                        self.export.light.warn_of_open(self.specimen, &beams, &options);
                        beams
                    }
                };
                self.by_beams(name, &scope, (&view, &beams), &watch)?;
                self.last = Some((view, beams));
                Ok(())
            }
            Tracer::Rays(first) => first.or_rays(|used| self.by_rays(used, name, (&scope, &view), &watch)),
        }
    }

    fn by_beams(
        &self,
        name: &str,
        scope: &Scope,
        (view, beams): (&View, &Beams),
        watch: Watch,
    ) -> Result<(), Failure> {
        let film = Film::around(&self.specimen.stone.polytope, &beams.view, self.export.size);
        let told = |open: &str, part: f64| self.told(name, view, &format!("exact beams, {open} {part:.2e}"));
        if self.wants(Format::Png) {
            let palette = Palette::of(scope);
            let paint = |name: &str, layer: &Layer, open| {
                self.paint(name, layer, &film, (&palette, &told(open, layer.open)), watch)
            };
            paint(name, &Layer::energy(beams, scope), "unresolved")?;
            paint(&format!("{name}-strongest"), &Layer::strongest(beams, scope), "undecided")?;
        }
        if self.wants(Format::Exr) {
            let (path, layer) = (self.path(name, "exr"), Layer::full(beams, scope));
            write_exr(&path, &layer, &film, &told("unresolved", layer.open), watch)?;
            self.done(&path)?;
        }
        if self.wants(Format::Svg) {
            self.drawn(name, scope, (view, beams), watch)?;
        }
        Ok(())
    }

    fn drawn(
        &self,
        name: &str,
        scope: &Scope,
        (view, beams): (&View, &Beams),
        watch: Watch,
    ) -> Result<(), Failure> {
        let stone = &self.specimen.stone;
        let options = self.export.light.beams(UNRESOLVED)?;
        let title = format!("{}, {}", self.title(name), self.export.view.told(view));
        let copies = beams.symmetry.order() as usize;
        let unresolved = options.unresolved.max(DRAWN_UNRESOLVED);
        let coarse = beam::Options { unresolved, most_beams: DRAWN_POLYGONS / copies, ..options };
        let coarse = beam::trace(&stone.polytope, self.medium, view, &coarse, watch)?;
        let is_small = beams.strongest_exits().len() * copies <= DRAWN_POLYGONS;
        let mapped = if is_small { beams } else { &coarse };
        let strongest = vector::strongest(stone, mapped, scope, &format!("{title}, strongest exits"));
        self.text(&self.path(&format!("{name}-strongest"), "svg"), &strongest.to_string())?;
        let energy = vector::energy(stone, &coarse, scope, &format!("{title}, energy"));
        self.text(&self.path(name, "svg"), &energy.to_string())
    }

    fn paint(
        &self,
        name: &str,
        layer: &Layer,
        film: &Film,
        (palette, told): (&Palette, &str),
        watch: Watch,
    ) -> Result<(), Failure> {
        let path = &self.path(name, "png");
        write_png(path, film.size.into(), told, |png| {
            paint(layer, film, watch, |rows| encode(rows, (palette, 0), png))
        })?;
        self.done(path)
    }

    fn by_rays(
        &self,
        sampler: Sampler,
        name: &str,
        (scope, view): (&Scope, &View),
        watch: Watch,
    ) -> Result<(), Failure> {
        let only = format!("{name}: rays make PNG pictures only; SVG and EXR need exact beams");
        if !self.wants(Format::Png) {
            return Err(Failure::Usage(only));
        }
        if self.wants(Format::Exr) || self.wants(Format::Svg) {
            say(&format!("note: {only}"));
        }
        let polytope = &self.specimen.stone.polytope;
        let options = self.export.light.rays(UNRESOLVED)?;
        let reach = Camera::new(view, polytope).reach(polytope).unwrap_or(1.0);
        let film = Film::reaching(reach, self.export.size);
        let palette = Palette::of(scope);
        let told = self.told(
            name,
            view,
            &format!("{}, each followed to {:.2e}", sampler.told(), options.least_weight),
        );
        let manner = Manner { options, per_side: RAYS_PER_SIDE };
        let look = Subject { specimen: self.specimen, medium: self.medium, view, scope };
        let [energy, strongest] = [name, &format!("{name}-strongest")].map(|name| self.path(name, "png"));
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
        self.done(&energy)?;
        self.done(&strongest)
    }

    fn told(&self, name: &str, view: &View, tracer: &str) -> String {
        let polarised = if self.export.light.unpolarised { "unpolarised" } else { "polarised" };
        let (title, view) = (self.title(name), self.export.view.told(view));
        format!("{title}; {view}; index {}, {polarised}; {tracer}", self.medium.index)
    }
}

/// Encodes rows of a picture, whose bands begin at a channel, and adds them to its file.
fn encode(rows: &Rows, (palette, first): (&Palette, usize), png: &mut PngRows) -> Result<(), WriteError> {
    let mut pixels = Vec::with_capacity(3 * rows.width as usize * rows.count as usize);
    (rows.first..rows.first + rows.count).for_each(|y| palette.encode(rows, first, y, &mut pixels));
    png.push(&pixels)
}
