//! `report`: writes a report on a design, or on how several compare, as a laboratory would hand it out.

use super::batch::{ends_all, of_several, report_failure};
use super::choice::{PAPER_SIZES, one_of};
use super::console::{say, written};
use super::options::{LightOptions, SideName, ViewOptions};
use super::progress::WorkProgress;
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_files::{check_writable, is_standard};
use brillianteer_paper::note_of_letters;
use brillianteer_paper::report::{PICTURE_SIDE, ReportFormat, ReportOrigin, check_count, report, write};
use brillianteer_picture::PaperSize;
use brillianteer_render::{Card, Renderer, Wanted};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Designs and meshes, or names of cuts that come with the program: one alone, or several that are compared
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The file to write; it ends in .pdf, or in .html for a web page of one file
    #[arg(short = 'o', long, value_name = "FILE")]
    out: PathBuf,
    /// The size of a PDF's paper
    #[arg(long, value_parser = one_of(&PAPER_SIZES), default_value = "a4")]
    paper: PaperSize,
    /// A date to print, in any words; without one the same report is the same every day
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
    /// Pixels along each side of a picture, 16 to 2000
    #[arg(long, value_name = "N", default_value_t = PICTURE_SIDE, value_parser = clap::value_parser!(u32).range(16..=2000))]
    pixels: u32,
    #[command(flatten)]
    specimen: SpecimenOptions,
}

impl ReportArguments {
    pub fn run(&self) -> Result<(), Failure> {
        let format = ReportFormat::of_name(&self.out).filter(|_| !is_standard(&self.out));
        let format = format.ok_or_else(|| {
            Failure::Usage(format!(
                "--out {}: give a file whose name ends in .pdf or .html",
                self.out.display()
            ))
        })?;
        check_count(self.files.len())?;
        check_writable(&self.out)?;
        let light = self.light();
        // The last digits of a card's results differ from the processor's, so reports use the processor alone.
        let mut renderer = Renderer::new(Card::None);
        let (mut specimens, mut failed) = (vec![], vec![]);
        for file in &self.files {
            let loaded = self.specimen.load(file).and_then(|specimen| {
                light.viewing(&specimen, &FACE_UP, &renderer)?;
                Ok(specimen)
            });
            match loaded {
                Ok(specimen) => specimens.push((file, specimen)),
                Err(failure) if self.files.len() == 1 || ends_all(&failure) => return Err(failure),
                Err(failure) => {
                    report_failure(file, &failure, false)?;
                    failed.push((file, failure));
                }
            }
        }
        if specimens.is_empty() {
            return of_several(&failed, self.files.len());
        }
        let mut viewings = vec![];
        for (_, specimen) in &specimens {
            viewings.push(light.viewing(specimen, &FACE_UP, &renderer)?);
        }
        let reported: Vec<&PathBuf> = specimens.iter().map(|(file, _)| *file).collect();
        let (command, date) = (self.command(&reported), self.date.clone());
        let remarks = specimens.iter().flat_map(|(_, specimen)| specimen.remarks.clone()).collect();
        let origin = ReportOrigin { command, picture_side: self.pixels, date, remarks };
        let report = {
            let progress = WorkProgress::new("report");
            report(&viewings, &origin, &mut renderer, &progress.watch(), &|event| progress.report(event))?
        };
        write(&self.out, format, &report, self.paper)?;
        written(&self.out)?;
        let designs = specimens.iter().map(|(_, specimen)| &specimen.design);
        let texts =
            designs.flat_map(|design| [Some(design.name.as_str()), design.source.as_deref()]).flatten();
        // The browser that shows a web page has fonts of its own.
        if let Some(note) = note_of_letters(texts).filter(|_| format == ReportFormat::Pdf) {
            say(&format!("note: {}: {note}", self.out.display()));
        }
        of_several(&failed, self.files.len())
    }

    /// Returns the options of the light, which are the same for every report, so that reports can be compared.
    fn light(&self) -> LightOptions {
        LightOptions {
            no_glare: false,
            index: None,
            wavelength: None,
            head: 0.0,
            unresolved: None,
            exact: false,
            unpolarised: false,
            tracer: Wanted::Quickest,
        }
    }

    /// Returns the command that makes the same report of these files again; options that do not change the content are left
    /// out.
    fn command(&self, files: &[&PathBuf]) -> String {
        let mut words = vec!["brillianteer".to_owned(), "report".to_owned()];
        words.extend(files.iter().map(|file| file.display().to_string()));
        words.extend(self.specimen.words());
        if self.pixels != PICTURE_SIDE {
            words.extend(["--pixels".to_owned(), self.pixels.to_string()]);
        }
        words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }
}

/// Returns a word in quotes where a shell needs them.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./+=:,@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// The view of every report.
const FACE_UP: ViewOptions =
    ViewOptions { side: SideName::Table, tilt: 0.0, eye_tilt: 0.0, azimuth: 0.0, perspective: None };

#[cfg(test)]
mod tests {
    use super::super::run_line;
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        report: ReportArguments,
    }

    fn command(options: &str) -> String {
        let words = ["b"].into_iter().chain(options.split(' '));
        let report = Line::try_parse_from(words).unwrap().report;
        report.command(&report.files.iter().collect::<Vec<_>>())
    }

    #[test]
    fn a_report_says_what_makes_it_again() {
        let said = command(
            "a.toml b.stl -o x.pdf --date today --paper letter --stone 1.5ct --pixels 99 --up -y --as faceted --unit in",
        );
        let again =
            "brillianteer report a.toml b.stl --stone 1.5ct --up 0,-1,0 --as faceted --unit in --pixels 99";
        assert_eq!(said, again);
        assert_eq!(
            command(&again["brillianteer report ".len()..].replace("b.stl", "b.stl -o y.html")),
            again
        );
        assert_eq!(command("oval -o x.html --material ruby"), "brillianteer report oval --material ruby");
    }

    #[test]
    fn a_name_without_a_known_ending_is_refused_before_any_work() {
        for out in ["report", "report.svg", "-"] {
            let line = ["brillianteer", "report", "tolkowsky", "-o", out];
            let error = run_line(line.map(Into::into).to_vec()).unwrap_err();
            assert!(
                error.to_string().contains(".pdf or .html") && matches!(error, Failure::Usage(_)),
                "{error}"
            );
        }
    }
}
