//! `render`: writes pictures of stones under light.

use super::batch::{distinct, each_file};
use super::console::{print, say, written};
use super::options::ViewOptions;
use super::picture_options::{FinishOptions, PictureOptions};
use super::picturing::PictureSetup;
use super::progress::WorkProgress;
use super::specimen::stem;
use brillianteer_base::Failure;
use brillianteer_files::{STANDARD, is_standard};
use brillianteer_paper::write_linear_exr;
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Debug, Args)]
pub struct Render {
    /// Designs, meshes, scene files, or names of cuts and scenes that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// File (.png or .exr) or folder to write to; `-` is standard output, as PNG
    #[arg(short, long, default_value = "out")]
    out: PathBuf,
    /// Name the facet at X,Y, in pixels from the upper left corner, instead of drawing a picture
    #[arg(long, value_name = "X,Y", value_parser = point)]
    probe: Option<glam::DVec2>,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    picture: PictureOptions,
    #[command(flatten)]
    finish: FinishOptions,
    /// What the options add to the default names of files.
    #[arg(skip)]
    pub told_apart: String,
}

fn point(text: &str) -> Result<glam::DVec2, String> {
    let both = text.split_once(',').and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    both.map(glam::DVec2::from).ok_or_else(|| "give two numbers, such as 200,150".into())
}

/// Returns the ending of `--out` where it is that of a picture format that the program does not write.
fn unknown_ending(out: &Path) -> Option<String> {
    const OTHERS: [&str; 9] = ["jpg", "jpeg", "gif", "webp", "tif", "tiff", "bmp", "svg", "hdr"];
    let ending = out.extension()?.to_str()?.to_ascii_lowercase();
    (!out.is_dir() && OTHERS.contains(&ending.as_str())).then_some(ending)
}

impl Render {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(ending) = unknown_ending(&self.out) {
            return Err(Failure::Usage(format!(
                "--out: .{ending} is not written; give a .png, an .exr or a folder"
            )));
        }
        let (_, is_file) = self.output(Path::new("x"), "");
        if is_file && self.files.len() > 1 {
            return Err(Failure::Usage("--out: several stones need a folder".into()));
        }
        if self.probe.is_none() {
            distinct(&self.files)?;
        }
        each_file(&self.files, false, |file| self.render(file))
    }

    /// Returns the path of a file's picture, and whether `--out` is a single file and not a folder. In a folder, the name
    /// ends with the viewpoint's suffix and `-render.png`.
    fn output(&self, file: &Path, suffix: &str) -> (PathBuf, bool) {
        if is_standard(&self.out) {
            return (STANDARD.into(), true);
        }
        let ending = self.out.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("png" | "exr") if !self.out.is_dir() => (self.out.clone(), true),
            _ => (self.out.join(format!("{}{}{suffix}-render.png", stem(file), self.told_apart)), false),
        }
    }

    fn render(&self, file: &Path) -> Result<(), Failure> {
        let asked = self.view.viewpoint()?;
        let studio =
            PictureSetup::load((&self.picture, &self.finish), file, asked)?.with_what_has_a_distance()?;
        let view = studio.viewpoint.view();
        let scene = Arc::new(studio.assembly.scene.clone());
        let job = studio.job(&scene, &view, studio.pixel(&scene, &view)?);
        if let Some(at) = self.probe {
            let [width, height] = job.film.size.map(f64::from);
            if !(0.0..width).contains(&at.x) || !(0.0..height).contains(&at.y) {
                return Err(Failure::Usage(format!(
                    "--probe {},{}: the picture has {width} by {height} pixels, counted from 0",
                    at.x, at.y
                )));
            }
            return print(&studio.probe(&job, at));
        }
        let mut taken = {
            let progress = WorkProgress::new(&studio.assembly.name);
            studio.take(&job, &progress.watch())?
        };
        let description = format!("{}; {}", taken.description, studio.viewpoint.description());
        let (path, _) = self.output(file, &asked.suffix());
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) {
            if let Some(without) = studio.undeveloped() {
                say(&format!("note: {}: {without}", path.display()));
            }
            write_linear_exr(&path, &mut taken.light, &description)?;
        } else {
            let progress = WorkProgress::new(&format!("{}: developing", studio.assembly.name));
            studio.finish(&job).write_png(&path, &mut taken.light, &description, &progress.watch())?;
            studio.legend().iter().for_each(|line| say(&format!("note: {line}")));
        }
        written(&path)
    }
}
