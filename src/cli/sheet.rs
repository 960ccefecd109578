//! `sheet`: writes the sheets that gem cutters work from.

use super::batch::{distinct, each_file, print_json_of};
use super::choice::{PAPER_SIZES, SHEET_FORMATS, one_of};
use super::console::{OfFile, say, written};
use super::specimen::stem;
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_files::is_standard;
use brillianteer_paper::cutting_sheet::{SheetFormat, cutting_sheet, write};
use brillianteer_paper::note_of_letters;
use brillianteer_picture::PaperSize;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct SheetArguments {
    /// Designs of convex stones, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// A file, whose ending names the format, or a folder to write to; `-` is standard output and needs --format
    #[arg(short, long, default_value = "out", value_name = "FILE|FOLDER")]
    out: PathBuf,
    /// The format to write, whatever the ending [default: that of the ending, else pdf]
    #[arg(long, value_parser = one_of(&SHEET_FORMATS))]
    format: Option<SheetFormat>,
    /// The size of the paper
    #[arg(long, value_parser = one_of(&PAPER_SIZES), default_value = "a4")]
    paper: PaperSize,
    /// Give the indices of a gear that counts clockwise, for a left-handed machine
    #[arg(long)]
    left_handed: bool,
    /// Print the content of the sheet as JSON instead: one object, or for several files one object a line
    #[arg(long, conflicts_with_all = ["out", "format"])]
    json: bool,
    #[command(flatten)]
    specimen: SpecimenOptions,
    /// What the options add to the default names of files.
    #[arg(skip)]
    pub told_apart: String,
}

impl SheetArguments {
    pub fn run(&self) -> Result<(), Failure> {
        let format = if self.json { None } else { Some(self.format()?) };
        each_file(&self.files, self.json, |file| {
            let specimen = self.specimen.load(file)?;
            let sheet = cutting_sheet(&specimen, self.left_handed)?;
            let Some((format, is_folder)) = format else {
                return print_json_of(&self.files, &OfFile { file: &specimen.path, result: sheet });
            };
            let path = if is_folder {
                self.out.join(format!("{}{}-sheet.{}", stem(file), self.told_apart, format.ending()))
            } else {
                self.out.clone()
            };
            write(&sheet, self.paper, (format, &path))?.iter().try_for_each(|file| written(file))?;
            // The viewer of an SVG has fonts of its own.
            let texts = serde_json::to_string(&sheet).unwrap_or_default();
            if let Some(note) = note_of_letters([texts.as_str()]).filter(|_| format != SheetFormat::Svg) {
                say(&format!("note: {}: {note}", path.display()));
            }
            Ok(())
        })
    }

    /// Returns the format, and whether `--out` is a folder.
    fn format(&self) -> Result<(SheetFormat, bool), Failure> {
        let out = self.out.display();
        let is_folder = !is_standard(&self.out) && (self.out.is_dir() || self.out.extension().is_none());
        let of_name = SheetFormat::of_name(&self.out).filter(|_| !is_folder);
        if is_folder {
            distinct(&self.files)?;
        } else if self.files.len() > 1 {
            return Err(Failure::Usage(format!("--out {out}: several designs need a folder")));
        }
        match self.format.or(of_name) {
            Some(format) => Ok((format, is_folder)),
            None if is_folder => Ok((SheetFormat::Pdf, true)),
            None if is_standard(&self.out) => {
                Err(Failure::Usage("--out -: give the format by --format pdf, svg or png".to_owned()))
            }
            None => Err(Failure::Usage(format!(
                "--out {out}: the ending names no format; give .pdf, .svg, .png, --format, or a folder"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::run_line;
    use brillianteer_base::Failure;
    use std::path::Path;

    fn run(options: &[&str]) -> Result<(), Failure> {
        run_line(["brillianteer", "sheet"].iter().chain(options).map(Into::into).collect())
    }

    #[test]
    fn sheets_go_to_a_file_or_a_folder_in_the_format_of_the_ending() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
        run(&["tolkowsky", "--out", &path("a.svg"), "--paper", "letter"]).unwrap();
        run(&["tolkowsky", "shallow", "--out", &path(""), "--left-handed"]).unwrap();
        run(&["shallow", "--out", &path("b.bin"), "--format", "pdf"]).unwrap();
        run(&["shallow", "--json"]).unwrap();
        let is_there = |name: &str| Path::new(&path(name)).is_file();
        assert!(
            ["a.svg", "tolkowsky-left-handed-sheet.pdf", "shallow-left-handed-sheet.pdf", "b.bin"]
                .into_iter()
                .all(is_there)
        );
        assert!(std::fs::read_to_string(path("a.svg")).unwrap().contains("width=\"215.9mm\""));
        assert!(std::fs::read(path("b.bin")).unwrap().starts_with(b"%PDF-"));
        for (options, said) in [
            (vec!["tolkowsky", "--out", "a.jpg"], "the ending names no format"),
            (vec!["tolkowsky", "shallow", "--out", "a.pdf"], "several designs need a folder"),
            (vec!["tolkowsky", "--out", "-"], "--format"),
            (vec!["tolkowsky", "--out", "a.pdf", "--json"], "cannot be used with"),
            (vec!["pill", "--out", &path("pill.pdf")], "a glass shape is curved"),
        ] {
            let error = run(&options).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
    }
}
