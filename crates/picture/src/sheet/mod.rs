//! The cutter's sheet: everything that a faceter needs at the machine, on one page of paper or as many as its
//! instructions take.
//!
//! [`CuttingSheet`] is its content as plain data; [`sheet_pages`] draws it. The order follows the sheets that GemCad
//! prints (R. Strickland, gemcad.com/lesson4.htm).

mod blocks;
mod cutting_sheet;
mod index_ring;
mod naming;
mod page;
mod table;
mod view;
mod wrapping;

pub use blocks::{BlockKind, SheetBlock, SheetRow};
pub use cutting_sheet::CuttingSheet;
pub use page::{PaperSize, sheet_pages};
pub(super) use wrapping::words;
