//! `export`: writes pictures, drawings and figures of stones to files.

use super::batch::each_file;
use super::choice::{OUTPUT_FORMATS, one_of};
use super::options::{LightOptions, ViewOptions, scoped};
use super::progress::WorkProgress;
use super::specimen::stem;
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_files::is_standard;
use brillianteer_paper::MOST_PIXELS;
use brillianteer_paper::export::{self, OutputFormat, Outputs, first_twice};
use brillianteer_picture::{Picture, PictureName};
use brillianteer_render::{Card, Renderer, Unfit};
use brillianteer_scene::Glare;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct ExportArguments {
    /// Designs or meshes, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Pictures to make, separated by commas [default: all of them]
    #[arg(long, value_delimiter = ',', value_parser = PictureName::ALL.map(PictureName::key).to_vec())]
    views: Vec<String>,
    /// A scope of your own, as a file, or a scope's name (see `scopes`); may be given several times
    #[arg(long, value_name = "SCOPE")]
    scope: Vec<PathBuf>,
    /// Pixels along each side
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=i64::from(MOST_PIXELS)))]
    size: u32,
    /// Kinds of file to write, separated by commas [default: png and svg, and json where a picture in a scope is among the
    /// pictures]
    #[arg(long, value_parser = one_of(&OUTPUT_FORMATS), value_delimiter = ',')]
    format: Vec<OutputFormat>,
    /// Folder to write to; `-` is standard output, for a single file; of the two pictures in a scope it gets energy
    #[arg(short, long, default_value = "out")]
    out: PathBuf,
    /// Draw a caption under pictures in scopes and contrast maps: what each colour means, view, error, stone and program
    #[arg(long)]
    caption: bool,
    /// Mark the findings of the audit, as `info --audit` lists them, in facet diagrams
    #[arg(long)]
    mark_audit: bool,
    /// Add to the figures how long they took, which differs from run to run
    #[arg(long)]
    timing: bool,
    #[command(flatten)]
    view: ViewOptions,
    /// Add glare, the light that the stone's outer surface reflects, to pictures: a camera in the scope records it,
    /// but it is orange and pink where graders look for red
    #[arg(long, conflicts_with = "no_glare", help_heading = "Light")]
    glare: bool,
    #[command(flatten)]
    light: LightOptions,
    #[command(flatten)]
    specimen: SpecimenOptions,
    /// What the options add to the default names of files.
    #[arg(skip)]
    pub told_apart: String,
}

impl ExportArguments {
    pub fn run(&self) -> Result<(), Failure> {
        if is_standard(&self.out) && self.files.len() > 1 {
            return Err(Failure::Usage("--out -: several stones need a folder".into()));
        }
        let pictures = self.pictures()?;
        let all: Vec<Outputs> = self.files.iter().map(|file| self.outputs(file, &pictures)).collect();
        self.distinct(&all)?;
        all.iter().try_for_each(Outputs::check)?;
        each_file(&self.files, false, |file| {
            let specimen = self.specimen.load(file)?;
            let mut renderer = Renderer::new(Card::Machine);
            let mut viewing = self.light.viewing(&specimen, &self.view, &renderer)?;
            viewing.glare = if self.glare { Some(Glare::Included) } else { viewing.glare };
            let outputs = self.outputs(file, &pictures);
            let progress = WorkProgress::new(&specimen.design.name);
            let export = export::Export { viewing, outputs: &outputs };
            let no_facets = || specimen.stone().err().map(|why| why.to_string());
            if export.files(&renderer)?.is_empty() {
                let no_contrast = viewing.why_no_contrast(&renderer);
                if let Some(eye @ Unfit::Eye) = &no_contrast {
                    return Err(eye.failure(&specimen.path));
                }
                let why = no_facets().or_else(|| no_contrast.map(|why| why.to_string())).unwrap_or_default();
                return Err(Failure::Usage(format!(
                    "{}: none of the pictures can be drawn: {why}",
                    specimen.path
                )));
            }
            export.write(&mut renderer, &progress.watch(), &|event| progress.report(event))
        })
    }

    fn outputs(&self, file: &Path, pictures: &[(String, Picture)]) -> Outputs {
        Outputs {
            folder: self.out.clone(),
            stem: stem(file) + &self.told_apart,
            pictures: pictures.to_vec(),
            size: self.size,
            formats: self.formats(pictures),
            caption: self.caption,
            mark_audit: self.mark_audit,
            // Standard output takes a single file: the picture of energy.
            strongest: !is_standard(&self.out),
            timing: self.timing,
        }
    }

    /// Returns the kinds of file. The figures are those of light, so drawings alone come without them unless they are asked
    /// for.
    fn formats(&self, pictures: &[(String, Picture)]) -> Vec<OutputFormat> {
        if !self.format.is_empty() {
            return self.format.clone();
        }
        let is_lit = pictures.iter().any(|(_, picture)| matches!(picture, Picture::Scoped(_)));
        let figures = is_lit.then_some(OutputFormat::Json);
        [OutputFormat::Png, OutputFormat::Svg].into_iter().chain(figures).collect()
    }

    fn pictures(&self) -> Result<Vec<(String, Picture)>, Failure> {
        let all = self.views.is_empty() && self.scope.is_empty();
        let names: Vec<PictureName> = if all {
            PictureName::ALL.to_vec()
        } else {
            self.views.iter().filter_map(|view| PictureName::of_key(view)).collect()
        };
        let mut pictures: Vec<(String, Picture)> =
            names.into_iter().map(|name| (name.key().to_owned(), name.picture())).collect();
        for path in &self.scope {
            let scoped = scoped(path)?;
            pictures.push((scoped.scope.name.clone(), Picture::Scoped(scoped)));
        }
        Ok(pictures)
    }

    /// Returns an error if two outputs would be written to the same file.
    fn distinct(&self, all: &[Outputs]) -> Result<(), Failure> {
        let Some((stone, twice)) = first_twice(all) else { return Ok(()) };
        Err(Failure::Usage(format!(
            "{}: two outputs would be called '{twice}'; give each stone and picture one name, or export \
             to different --out folders",
            self.files[stone].display()
        )))
    }
}
