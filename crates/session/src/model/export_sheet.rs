//! The cutter's sheet in an export: its choices and its files.

use super::export::ExportPlan;
use brillianteer_base::Failure;
use brillianteer_paper::cutting_sheet::{SheetFormat, cutting_sheet, files, write};
use brillianteer_picture::PaperSize;
use std::path::PathBuf;

/// The choices of the cutter's sheet in the export dialog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SheetChoice {
    /// True where a sheet is written.
    pub is_wanted: bool,
    /// The format of its files.
    pub format: SheetFormat,
    /// The size of its paper.
    pub paper: PaperSize,
    /// True where its indices are those of a gear that counts clockwise.
    pub left_handed: bool,
}

impl Default for SheetChoice {
    fn default() -> Self {
        Self { is_wanted: false, format: SheetFormat::Pdf, paper: PaperSize::A4, left_handed: false }
    }
}

impl ExportPlan {
    /// Returns whether the stone can have a sheet: only convex stones between planes can.
    pub fn can_have_sheet(&self) -> bool {
        self.upright.stone().is_ok()
    }

    /// Returns whether the export writes a sheet.
    pub fn writes_sheet(&self) -> bool {
        self.selection.sheet.is_wanted && self.can_have_sheet()
    }

    /// Lists the files of the sheet. Where their number has to be counted, this takes up to some tenths of a second.
    pub fn list_sheet(&mut self) {
        let SheetChoice { format, paper, left_handed, .. } = self.selection.sheet;
        let first = self.sheet_path();
        self.sheet_files = match (self.writes_sheet(), format) {
            (false, _) => vec![],
            (true, SheetFormat::Pdf) => vec![first],
            (true, SheetFormat::Svg | SheetFormat::Png) => match cutting_sheet(&self.upright, left_handed) {
                Ok(sheet) => files(&sheet, paper, (format, &first)),
                // `write_sheet` reports the fault.
                Err(_) => vec![first],
            },
        };
    }

    /// Writes the sheet and returns its files.
    ///
    /// # Errors
    /// Fails where the stone has no sheet, or where a file cannot be written.
    pub fn write_sheet(&self) -> Result<Vec<PathBuf>, Failure> {
        let SheetChoice { format, paper, left_handed, .. } = self.selection.sheet;
        let sheet = cutting_sheet(&self.upright, left_handed)?;
        write(&sheet, paper, (format, &self.sheet_path()))
    }

    fn sheet_path(&self) -> PathBuf {
        self.folder.join(format!("{}-sheet.{}", self.stem, self.selection.sheet.format.ending()))
    }
}
