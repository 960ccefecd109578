//! Writes cutters' sheets as SVG, PDF and PNG.

use super::{DrawingError, pdf, rasterize, write_png};
use brillianteer_base::Failure;
use brillianteer_cut::{Cut, TierZone, Tiers};
use brillianteer_files::{WriteError, in_tiers, write as write_whole};
use brillianteer_picture::{CuttingSheet, PaperSize, sheet_pages};
use brillianteer_scene::{Specimen, Stone};
use glam::DVec3;
use std::path::{Path, PathBuf};

#[cfg(test)]
mod tests;

/// The resolution of sheets in PNG, pixels per inch.
const PIXELS_PER_INCH: f64 = 300.0;

/// A format of sheets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

    /// Returns the name of the format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pdf => "PDF",
            Self::Svg => "SVG",
            Self::Png => "PNG",
        }
    }

    /// Returns the format that the ending of a file's name stands for.
    pub fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        Self::ALL.into_iter().find(|format| format.ending() == ending)
    }
}

/// Describes the sheet of a stone. A stone that is not cut by tiers gets those that the editor turns it into: pavilion,
/// girdle, crown and table with cutters' names; see [`in_tiers`]. A tier without an instruction gets the meet that the stone
/// shows, and where none is found, its depth.
///
/// # Errors
/// Fails with [`Failure::Input`] for a solid without facets that can be cut: a mesh that is not convex, a smooth
/// glass shape.
pub fn cutting_sheet(specimen: &Specimen, left_handed: bool) -> Result<CuttingSheet, Failure> {
    let refused = |why: String| Failure::Input(format!("{}: no cutter's sheet: {why}", specimen.design.name));
    let by_tiers = in_tiers(specimen).map_err(|why| refused(why.to_string()))?;
    let stone = by_tiers.stone().map_err(|why| refused(why.to_string()))?;
    let Cut::Tiers(tiers) = &by_tiers.design.cut else { return Err(refused("it has no tiers".to_owned())) };
    let named = tiers.with_kept_stated_meets().with_names_in_meets();
    let (met, _) = named.with_found_meets_followed();
    let tiers = with_depths(&by_tiers, stone, &met);
    Ok(CuttingSheet::new(specimen, stone, &tiers, left_handed))
}

/// Returns the tiers with their depth as the instruction where they have neither a meet nor an instruction, and with a footer
/// that defines depth. A depth is the distance of a facet's plane from the origin of the tiers, in widths of the stone.
fn with_depths(turned: &Specimen, stone: &Stone, tiers: &Tiers) -> Tiers {
    let mut tiers = tiers.clone();
    let (low, high) = stone.polytope.bounds();
    let width = (high - low).truncate().min_element();
    let free = tiers.tiers.iter_mut().filter(|tier| tier.meet.is_none() && tier.instructions.is_empty());
    let mut count = 0;
    for tier in free {
        // The sign of the distance of a flat facet says which way it faces.
        let (label, distance) = match tier.zone() {
            TierZone::Table => ("Table, depth", tier.distance.abs()),
            TierZone::Culet => ("Culet, depth", tier.distance.abs()),
            _ => ("Depth", tier.distance),
        };
        tier.instructions = format!("{label} {:.4} W", distance * turned.frame.scale / width);
        count += 1;
    }
    if count > 0 {
        let origin = (turned.frame.place(DVec3::ZERO).z - low.z) / width;
        tiers.footers.push(format!(
            "Depth is the distance of the facet from the point of the axis that lies {origin:.4} W above the lowest point of \
             the stone. It stands where no meet of earlier facets was found that places the tier."
        ));
    }
    tiers
}

/// Returns the files that [`write()`] makes of a sheet, in that order.
pub fn files(sheet: &CuttingSheet, paper: PaperSize, (format, path): (SheetFormat, &Path)) -> Vec<PathBuf> {
    let count = match format {
        SheetFormat::Pdf => 1,
        SheetFormat::Svg | SheetFormat::Png => sheet_pages(sheet, paper).len(),
    };
    (0..count).map(|page| page_file(path, page)).collect()
}

/// Writes a sheet to a file, or with formats of one page a file, to several, whose names get the page's number from 2.
/// Returns the files.
///
/// # Errors
/// Fails with [`Failure::Usage`] for several pages to standard output, [`Failure::Output`] where the file system
/// refuses.
pub fn write(
    sheet: &CuttingSheet,
    paper: PaperSize,
    (format, path): (SheetFormat, &Path),
) -> Result<Vec<PathBuf>, Failure> {
    let pages: Vec<String> = sheet_pages(sheet, paper).iter().map(|page| page.to_string()).collect();
    let drawing = |e: DrawingError| Failure::Output(format!("{}: {e}", path.display()));
    if format == SheetFormat::Pdf {
        let bytes = pdf(&pages, &sheet.title).map_err(drawing)?;
        write_bytes(path, &bytes)?;
        return Ok(vec![path.to_owned()]);
    }
    if pages.len() > 1 && brillianteer_files::is_standard(path) {
        let count = pages.len();
        return Err(Failure::Usage(format!(
            "the sheet has {count} pages, and standard output takes one; write it as pdf, or to a file"
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
