//! Reports on stones: pictures, drawings, tables and text as plain data, laid out on pages of paper.
//!
//! `io::report` puts the content together, and also writes the same data as a web page.

mod embedded;
mod flow;
mod table;

pub use embedded::EmbeddedDrawing;
pub use flow::report_pages;
pub use table::{ReportCell, ReportColumn, ReportTable, TextFlow};

/// The content of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The name of the stone, or those of the stones that are compared.
    pub title: String,
    /// The subject of the report, in a line or two.
    pub subtitle: String,
    /// The known facts before anything is measured, such as the material: pairs of a label and a value.
    pub facts: Vec<[String; 2]>,
    /// The parts below, from top to bottom.
    pub parts: Vec<ReportPart>,
    /// The way in which the report was made, so that it can be made again: pairs of a label and a value.
    pub provenance: Vec<[String; 2]>,
    /// The text at the foot of each page, such as a date; may be empty.
    pub mark: String,
}

/// A part of a report.
#[derive(Debug, Clone, PartialEq)]
pub enum ReportPart {
    /// The name of the parts that follow. It stays on their page.
    Heading(String),
    /// Pictures side by side, each at the same height.
    Figures(FigureRow),
    /// A table; it goes on over as many pages as it takes.
    Table(ReportTable),
    /// A paragraph.
    Text(String),
}

/// Pictures side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureRow {
    /// The pictures, from left to right.
    pub figures: Vec<ReportFigure>,
    /// The greatest height of the pictures, as a part of the width of the text, above 0.
    pub most_height: f64,
}

/// A picture with its caption.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportFigure {
    /// The text under the picture.
    pub caption: String,
    /// The picture.
    pub drawing: EmbeddedDrawing,
}
