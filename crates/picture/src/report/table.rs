//! The tables of reports, and their drawing on pages.

use super::super::drawing::{Align, Ink, Sheet, Type, shortened, text_width};
use super::super::sheet::words;
use glam::DVec2;

/// Type of the cells of tables.
const BODY: Type = Type { size: 16.5, colour: Ink::Main };
/// Type of the heads of columns.
const HEAD: Type = Type { size: 14.0, colour: Ink::Quiet };
/// Type of columns of sentences.
const REMARK: Type = Type { size: 13.5, colour: Ink::Quiet };
/// Height of a row of one line.
const ROW: f64 = 24.0;
/// Height of a further line of a sentence.
const REMARK_LINE: f64 = 16.0;
/// Space between columns.
const GUTTER: f64 = 22.0;
/// Space between the parts of a table that stand side by side.
const BETWEEN: f64 = 44.0;
/// The least part of the table's width that its first column takes.
const LEAST_FIRST: f64 = 0.16;

/// A table: columns with heads, and rows of as many cells.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportTable {
    /// The columns, at least one.
    pub columns: Vec<ReportColumn>,
    /// The cells of each row; missing ones are empty.
    pub rows: Vec<Vec<ReportCell>>,
    /// The number of parts of equal length that stand side by side on paper, at least 1.
    pub across: usize,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportColumn {
    /// The head above the column; where all heads are empty there is no line for them.
    pub head: String,
    /// The setting of its cells.
    pub flow: TextFlow,
}

/// The setting of the cells of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextFlow {
    /// Words, from the left.
    Words,
    /// Numbers, to the right.
    Numbers,
    /// Sentences in small type, broken into lines; they take the width that is left.
    Sentences,
}

/// A cell of a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReportCell {
    /// The text in the cell.
    pub text: String,
    /// True where the cell is set off from the others of its row, as the best one is.
    pub is_marked: bool,
}

impl<T: Into<String>> From<T> for ReportCell {
    fn from(text: T) -> Self {
        Self { text: text.into(), is_marked: false }
    }
}

impl ReportTable {
    /// Makes a table from the heads of its columns.
    pub fn new(columns: &[(&str, TextFlow)]) -> Self {
        let column = |&(head, flow): &(&str, TextFlow)| ReportColumn { head: head.to_owned(), flow };
        Self { columns: columns.iter().map(column).collect(), rows: vec![], across: 1 }
    }

    /// Makes a table of names and values without heads, of which `across` parts stand side by side.
    pub fn of_pairs(pairs: impl IntoIterator<Item = [String; 2]>, across: usize) -> Self {
        let rows = pairs.into_iter().map(|pair| pair.map(ReportCell::from).to_vec()).collect();
        Self { rows, across, ..Self::new(&[("", TextFlow::Words), ("", TextFlow::Numbers)]) }
    }

    /// Returns whether there is a line of heads.
    pub fn has_heads(&self) -> bool {
        self.columns.iter().any(|column| !column.head.is_empty())
    }
}

/// A table that has been given its place across a page.
pub(super) struct PlacedTable<'a> {
    table: &'a ReportTable,
    left: f64,
    /// The width of one of the parts side by side.
    width: f64,
    /// The left border and the width of each column, from the left of its part.
    columns: Vec<(f64, f64)>,
    /// The cells of each row as lines of print.
    rows: Vec<PlacedRow>,
}

struct PlacedRow {
    cells: Vec<Vec<String>>,
    height: f64,
}

impl<'a> PlacedTable<'a> {
    /// Divides the width among the columns and breaks sentences into lines.
    pub fn new(table: &'a ReportTable, left: f64, width: f64) -> Self {
        let across = table.across.max(1) as f64;
        let width = (width - BETWEEN * (across - 1.0)) / across;
        let columns = columns(table, width);
        let mut rows = vec![];
        for row in &table.rows {
            let mut cells = vec![];
            for ((column, &(_, room)), cell) in table.columns.iter().zip(&columns).zip(row) {
                cells.push(match column.flow {
                    TextFlow::Sentences => words(&cell.text, REMARK.size, room),
                    _ => vec![shortened(&cell.text, BODY.size, room)],
                });
            }
            let lines = cells.iter().map(Vec::len).max().unwrap_or(1).max(1);
            rows.push(PlacedRow { cells, height: ROW + REMARK_LINE * (lines - 1) as f64 });
        }
        Self { table, left, width, columns, rows }
    }

    /// Returns the height of the heads.
    pub fn head_height(&self) -> f64 {
        if self.table.has_heads() { ROW } else { 4.0 }
    }

    /// Returns the number of rows.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// Returns the number of rows from this one on that fit into a height below the heads, where parts of the table
    /// stand side by side.
    pub fn fitting(&self, from: usize, room: f64) -> usize {
        let rest = self.count() - from;
        (1..=rest).rev().find(|&count| self.height(from, count) <= room).unwrap_or(0)
    }

    /// Returns the height of so many rows from this one on.
    pub fn height(&self, from: usize, count: usize) -> f64 {
        self.parts(from, count).map(|(_, rows)| rows.iter().map(|row| row.height).sum()).fold(0.0, f64::max)
    }

    /// Returns the number of the first row and the rows of each part, from left to right.
    fn parts(&self, from: usize, count: usize) -> impl Iterator<Item = (usize, &[PlacedRow])> {
        let each = count.div_ceil(self.table.across.max(1)).max(1);
        let starts = (from..from + count).step_by(each);
        starts.map(move |start| (start, &self.rows[start..(start + each).min(from + count)]))
    }

    /// Draws the heads and so many rows from this one on, from this height down.
    pub fn draw(&self, sheet: &mut Sheet, (from, count): (usize, usize), top: f64) {
        for (k, (first, rows)) in self.parts(from, count).enumerate() {
            let left = self.left + k as f64 * (self.width + BETWEEN);
            let rule = |y: f64| (DVec2::new(left, y), DVec2::new(left + self.width, y));
            let mut y = top + self.head_height();
            if self.table.has_heads() {
                for (column, &(x, width)) in self.table.columns.iter().zip(&self.columns) {
                    let (align, x) = aligned(column.flow, left + x, width);
                    let head = shortened(&column.head, HEAD.size, width);
                    sheet.plain_text(HEAD, align, DVec2::new(x, top + ROW / 2.0), &head);
                }
                sheet.quiet_lines(&[rule(y)], "rule", 1.0);
            }
            for (row, cells) in rows.iter().zip(&self.table.rows[first..]) {
                self.row(sheet, (row, cells), left, y + ROW / 2.0);
                y += row.height;
                let (a, b) = rule(y);
                sheet.extension(a, b);
            }
        }
    }

    fn row(&self, sheet: &mut Sheet, (row, cells): (&PlacedRow, &[ReportCell]), left: f64, y: f64) {
        let columns = self.table.columns.iter().zip(&self.columns);
        for (((column, &(x, width)), lines), cell) in columns.zip(&row.cells).zip(cells) {
            let (align, x) = aligned(column.flow, left + x, width);
            let kind = if column.flow == TextFlow::Sentences { REMARK } else { BODY };
            for (k, line) in lines.iter().enumerate().filter(|(_, line)| !line.is_empty()) {
                let at = DVec2::new(x, y + REMARK_LINE * k as f64);
                if cell.is_marked {
                    sheet.strong_text(kind, align, at, line);
                } else {
                    sheet.plain_text(kind, align, at, line);
                }
            }
        }
    }
}

/// Returns the alignment of a column's cells, and the x of the side that they are aligned to.
fn aligned(flow: TextFlow, left: f64, width: f64) -> (Align, f64) {
    match flow {
        TextFlow::Numbers => (Align::End, left + width),
        TextFlow::Words | TextFlow::Sentences => (Align::Start, left),
    }
}

/// Divides a width among the columns. A surplus goes to the column of sentences, or else to the first; where there is
/// too little, every column except that one is narrowed alike.
fn columns(table: &ReportTable, width: f64) -> Vec<(f64, f64)> {
    let count = table.columns.len();
    let sentences = table.columns.iter().position(|column| column.flow == TextFlow::Sentences);
    let widest = |k: usize| {
        let cells = table.rows.iter().filter_map(|row| row.get(k));
        // Marked cells are set in heavier letters.
        let cells = cells.map(|cell| 1.03 * text_width(&cell.text, BODY.size));
        cells.fold(text_width(&table.columns[k].head, HEAD.size), f64::max).ceil()
    };
    let rest = sentences.unwrap_or(0);
    let mut widths: Vec<f64> = (0..count).map(|k| if k == rest { 0.0 } else { widest(k) }).collect();
    let gutters = GUTTER * count.saturating_sub(1) as f64;
    let taken: f64 = widths.iter().sum();
    let least = if sentences.is_some() { 0.3 } else { LEAST_FIRST } * width;
    let room = (width - gutters - least).max(0.0);
    if taken > room {
        widths.iter_mut().for_each(|of| *of *= room / taken);
    }
    widths[rest] = (width - gutters - widths.iter().sum::<f64>()).max(0.0);
    let mut left = 0.0;
    let placed = widths.into_iter().map(|width| {
        let at = left;
        left += width + GUTTER;
        (at, width)
    });
    placed.collect()
}
