//! Writes cutters' sheets as SVG, PDF and PNG.

use super::cutters::tiers_of;
use super::{DrawingError, Failure, WriteError, pdf, rasterize, write as write_whole, write_png};
use crate::picture::{CuttingSheet, PaperSize, sheet_pages};
use crate::scene::{Body, Specimen};
use std::path::{Path, PathBuf};

#[cfg(test)]
mod tests;

/// Pixels an inch of sheets in PNG.
const PIXELS_PER_INCH: f64 = 300.0;

/// A format of sheets. clap prints these comments as the option's help.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum SheetFormat {
    /// Portable documents, all pages in one file, with text that can be searched.
    Pdf,
    /// Drawings, a file for each page.
    Svg,
    /// Pictures of 300 pixels an inch, a file for each page.
    Png,
}

impl SheetFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Pdf, Self::Svg, Self::Png];

    /// Returns the ending of the format's files, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Pdf => "pdf",
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// Returns the format that the ending of a file's name stands for.
    pub fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        Self::ALL.into_iter().find(|format| format.ending() == ending)
    }
}

/// Describes the sheet of a stone. A stone that is not cut by tiers is given those that its planes make; see
/// [`asc`](super::asc), which writes the same.
///
/// # Errors
/// [`Failure::Input`] for a solid without facets that can be cut: a mesh that is not convex, a smooth glass shape.
pub fn cutting_sheet(specimen: &Specimen, left_handed: bool) -> Result<CuttingSheet, Failure> {
    let name = &specimen.design.name;
    let refused = |why: &str| Failure::Input(format!("{name}: {why}"));
    let stone = match &*specimen.body {
        Body::Stone(stone) => stone,
        Body::Mesh(_) => {
            return Err(refused(
                "a cutter's sheet needs a convex stone between planes, and this mesh is not convex",
            ));
        }
        Body::Glass(_) => {
            return Err(refused("a cutter's sheet needs flat facets, and this glass shape is smooth"));
        }
    };
    // What the tiers do not hold (proportions, a shift along the axis) does not change the settings of the machine.
    let tiers = tiers_of(specimen, &mut Vec::new());
    Ok(CuttingSheet::new(specimen, stone, &tiers, left_handed))
}

/// Writes a sheet to a file, or with formats of one page a file, to several, whose names get the page's number from 2.
/// Returns the files.
///
/// # Errors
/// [`Failure::Usage`] for several pages to standard output, [`Failure::Output`] where the file system refuses.
pub fn write(
    specimen: &Specimen,
    sheet: &CuttingSheet,
    paper: PaperSize,
    (format, path): (SheetFormat, &Path),
) -> Result<Vec<PathBuf>, Failure> {
    let drawn = specimen.stone().map(|stone| sheet_pages(sheet, stone, paper));
    let pages = drawn.map_err(|e| Failure::Input(format!("{}: {e}", sheet.title)))?;
    let pages: Vec<String> = pages.iter().map(|page| page.to_string()).collect();
    let drawing = |e: DrawingError| Failure::Output(format!("{}: {e}", path.display()));
    if format == SheetFormat::Pdf {
        let bytes = pdf(&pages, &sheet.title).map_err(drawing)?;
        write_bytes(path, &bytes)?;
        return Ok(vec![path.to_owned()]);
    }
    if pages.len() > 1 && super::is_standard(path) {
        let count = pages.len();
        return Err(Failure::Usage(format!(
            "--out -: the sheet has {count} pages; write it as pdf, or to a file"
        )));
    }
    let mut files = vec![];
    for (k, page) in pages.iter().enumerate() {
        let file = page_file(path, k);
        if format == SheetFormat::Svg {
            write_bytes(&file, page.as_bytes())?;
        } else {
            let width = (paper.size_mm().x / 25.4 * PIXELS_PER_INCH).round() as u32;
            let (width, height, pixels) = rasterize(page, width).map_err(drawing)?;
            write_png(&file, (width, height), &sheet.title, |rows| rows.push(&pixels))?;
        }
        files.push(file);
    }
    Ok(files)
}

fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_whole(path, |file| file.write_all(bytes).map_err(|e| WriteError::io(path, e)))?;
    Ok(())
}

/// Returns the file of a page, from 0: `sheet.svg`, `sheet-2.svg`, ...
fn page_file(path: &Path, page: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    match (page, path.extension()) {
        (0, _) => path.to_owned(),
        (_, None) => path.with_file_name(format!("{stem}-{}", page + 1)),
        (_, Some(ending)) => path.with_file_name(format!("{stem}-{}.{}", page + 1, ending.to_string_lossy())),
    }
}
