//! Reports on stones: puts together a report as laboratories give it out, on one stone or on the comparison of
//! several, and writes it as PDF or as a web page of one file.
//!
//! The same stones, options and program give the same bytes.

mod comparison;
mod figures;
mod fingerprint;
mod html;
mod pictures;
mod single;
mod stone;
mod tilts;

#[cfg(test)]
mod tests;

pub use fingerprint::fingerprint;
pub use html::report_html;

use super::export::{Reporter, Viewing, WorkShares};
use super::pdf;
use brillianteer_base::{Failure, Watch};
use brillianteer_files::{WriteError, write as write_whole};
use brillianteer_picture::{PaperSize, Report, report_pages};
use brillianteer_render::Renderer;
use std::path::Path;
use stone::ReportedStone;

/// The most stones that one report compares: as many as plots have colours.
pub const MOST_COMPARED: usize = 7;

/// A format of reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReportFormat {
    /// Pages of paper, with text that can be searched.
    Pdf,
    /// A web page of one file, which needs no network.
    Html,
}

impl ReportFormat {
    /// Returns the format that the ending of a file's name stands for.
    pub fn of_name(path: &Path) -> Option<Self> {
        match path.extension()?.to_string_lossy().to_lowercase().as_str() {
            "pdf" => Some(Self::Pdf),
            "html" | "htm" => Some(Self::Html),
            _ => None,
        }
    }
}

/// The default number of pixels along each side of a picture: 300 per inch where five stand side by side.
pub const PICTURE_SIDE: u32 = 420;

/// The origin of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportOrigin {
    /// The command that makes the same report again.
    pub command: String,
    /// The number of pixels along each side of a picture, above 0.
    pub picture_side: u32,
    /// The date, in whatever words; a report without one is the same every day.
    pub date: Option<String>,
    /// The notes and warnings on how the files of the stones were read, as `warning: scan.stl: ...`.
    pub remarks: Vec<String>,
}

/// Refuses a report on so many stones.
///
/// # Errors
/// Fails with [`Failure::Usage`] for none or more than [`MOST_COMPARED`].
pub fn check_count(count: usize) -> Result<(), Failure> {
    if (1..=MOST_COMPARED).contains(&count) {
        return Ok(());
    }
    Err(Failure::Usage(format!("a report is on 1 to {MOST_COMPARED} stones; {count} were given")))
}

/// Takes the pictures and the measures of one stone, or of several, and returns the report on it or the comparison.
///
/// # Errors
/// Fails with [`Failure::Usage`] for no stone or more than [`MOST_COMPARED`], an error of `tell`, the errors of
/// tracing, or [`Failure::Stopped`] when `watch` asks to stop.
pub fn report(
    viewings: &[Viewing],
    origin: &ReportOrigin,
    renderer: &mut Renderer,
    watch: Watch,
    tell: Reporter,
) -> Result<Report, Failure> {
    let count = viewings.len();
    check_count(count)?;
    let mut shares = WorkShares::new(watch, count as f64);
    let mut stones = vec![];
    for viewing in viewings {
        stones.push(shares.step(1.0, |watch| {
            ReportedStone::examine((viewing, origin.picture_side), renderer, watch, tell)
        })?);
    }
    match stones.as_slice() {
        [stone] => single::report(stone, origin),
        stones => comparison::report(stones, origin),
    }
}

/// Writes a report, whole or not at all; the paper is that of a PDF.
///
/// # Errors
/// Fails with [`Failure::Output`] where the file system refuses.
pub fn write(path: &Path, format: ReportFormat, report: &Report, paper: PaperSize) -> Result<(), Failure> {
    let bytes = match format {
        ReportFormat::Html => report_html(report).into_bytes(),
        ReportFormat::Pdf => {
            let pages: Vec<String> = report_pages(report, paper).iter().map(ToString::to_string).collect();
            pdf(&pages, &report.title).map_err(|e| Failure::Output(format!("{}: {e}", path.display())))?
        }
    };
    write_whole(path, |file| file.write_all(&bytes).map_err(|e| WriteError::io(path, e)))?;
    Ok(())
}

/// Returns the lines on how a report was made, after those with the stones' fingerprints.
fn provenance(fingerprints: Vec<[String; 2]>, origin: &ReportOrigin) -> Vec<[String; 2]> {
    let line = |label: &str, value: &str| [label.to_owned(), value.to_owned()];
    let mut lines = fingerprints;
    lines.extend(origin.remarks.iter().map(|remark| line("as read", remark)));
    lines.push(line("program", concat!("Brillianteer ", env!("CARGO_PKG_VERSION"))));
    lines.push(line("made again by", &format!("{} -o FILE", origin.command)));
    lines.extend(origin.date.iter().map(|date| line("date", date)));
    lines
}
