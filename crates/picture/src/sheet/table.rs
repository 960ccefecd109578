//! The list of tiers on a cutter's sheet, as lines of print that fit the page: name, angle, indices, instruction.

use super::super::drawing::{Align, Ink, Sheet, Type, shortened, text_width};
use super::blocks::{SheetBlock, SheetRow, index_text};
use super::cutting_sheet::CuttingSheet;
use super::wrapping::{dashed, words};
use glam::DVec2;

/// Type of the list.
const BODY: Type = Type { size: 19.0, colour: Ink::Main };
/// Type of the names of blocks.
const HEADING: Type = Type { size: 17.0, colour: Ink::Main };
/// Type of notes.
const NOTE: Type = Type { size: 17.0, colour: Ink::Main };
/// Height of a line.
const LINE: f64 = 21.0;
/// Height of a block's name with the space above it.
const HEADING_HEIGHT: f64 = 36.0;
/// Space between tiers.
const BETWEEN: f64 = 4.0;
/// The least and the greatest width of the column of names.
const NAMES: [f64; 2] = [56.0, 190.0];
/// Width of the column of angles.
const ANGLES: f64 = 86.0;
/// Space between columns.
const GUTTER: f64 = 22.0;
/// The least width of the column of instructions.
const LEAST_INSTRUCTIONS: f64 = 200.0;
/// The greatest part of the page's width that instructions take.
const INSTRUCTIONS: f64 = 0.4;

/// A line of the list, with the contents of its columns.
#[derive(Debug, Clone, PartialEq)]
enum TableLine {
    Heading(&'static str),
    Cells { name: String, angle: String, indices: String, instruction: String },
    Note(String),
}

/// Lines that stay together on a page where they fit one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LineGroup {
    lines: Vec<TableLine>,
}

/// The columns of the list.
#[derive(Debug, Clone, Copy)]
pub(super) struct Columns {
    left: f64,
    width: f64,
    names: f64,
    indices: f64,
    instructions: f64,
}

impl Columns {
    /// Divides the width of a page among the columns of these tiers.
    pub fn of(data: &CuttingSheet, left: f64, width: f64) -> Self {
        let rows = || data.blocks.iter().flat_map(|block| &block.tiers);
        let widest = |texts: &mut dyn Iterator<Item = &String>| {
            texts.map(|text| text_width(text, BODY.size)).fold(0.0, f64::max)
        };
        let names = widest(&mut rows().map(|row| &row.name)).clamp(NAMES[0], NAMES[1]);
        let said = widest(&mut rows().map(|row| &row.instruction));
        let instructions = (said + 1.0).clamp(LEAST_INSTRUCTIONS, INSTRUCTIONS * width);
        let indices = width - names - ANGLES - instructions - 3.0 * GUTTER;
        Self { left, width, names, indices, instructions }
    }

    /// Returns all lines of the list.
    pub fn groups(&self, data: &CuttingSheet) -> Vec<LineGroup> {
        let mut groups: Vec<LineGroup> = data.blocks.iter().flat_map(|block| self.block(block)).collect();
        let mut notes: Vec<LineGroup> = data.notes.iter().map(|note| self.note(note)).collect();
        if let Some(first) = notes.first_mut() {
            first.lines.insert(0, TableLine::Heading("NOTES"));
        }
        groups.append(&mut notes);
        groups
    }

    fn block(&self, block: &SheetBlock) -> Vec<LineGroup> {
        let mut groups: Vec<LineGroup> = block.tiers.iter().map(|row| self.row(row)).collect();
        // A heading stays with its first tier.
        groups
            .iter_mut()
            .take(1)
            .for_each(|group| group.lines.insert(0, TableLine::Heading(block.name.name())));
        groups
    }

    fn row(&self, row: &SheetRow) -> LineGroup {
        let items: Vec<String> = row.indices.iter().map(|&index| index_text(index)).collect();
        let indices = dashed(&items, BODY.size, self.indices);
        let said = words(&row.instruction, BODY.size, self.instructions);
        let cell = |texts: &[String], k: usize| texts.get(k).cloned().unwrap_or_default();
        let line = |k: usize| TableLine::Cells {
            name: if k == 0 { shortened(&row.name, BODY.size, self.names) } else { String::new() },
            angle: match k {
                0 => format!("{:.2}{}", row.angle_deg, if row.below_critical { " *" } else { "" }),
                _ => String::new(),
            },
            indices: cell(&indices, k),
            instruction: cell(&said, k),
        };
        LineGroup { lines: (0..indices.len().max(said.len()).max(1)).map(line).collect() }
    }

    fn note(&self, note: &str) -> LineGroup {
        LineGroup { lines: words(note, NOTE.size, self.width).into_iter().map(TableLine::Note).collect() }
    }

    /// Draws a group whose upper edge lies at this height.
    pub fn draw(&self, sheet: &mut Sheet, group: &LineGroup, mut y: f64) {
        let ends = |y: f64| (DVec2::new(self.left, y), DVec2::new(self.left + self.width, y));
        for line in &group.lines {
            let middle = |height: f64| DVec2::new(self.left, y + height / 2.0);
            match line {
                TableLine::Heading(name) => {
                    let at = DVec2::new(self.left, y + HEADING_HEIGHT - 14.0);
                    sheet.strong_text(HEADING, Align::Start, at, name);
                    sheet.quiet_lines(&[ends(y + HEADING_HEIGHT - 2.0)], "rule", 1.2);
                }
                TableLine::Note(text) => sheet.plain_text(NOTE, Align::Start, middle(LINE), text),
                TableLine::Cells { name, angle, indices, instruction } => {
                    self.cells(sheet, middle(LINE + BETWEEN), [name, angle, indices, instruction]);
                }
            }
            y += line.height();
        }
        if let Some(TableLine::Cells { .. }) = group.lines.last() {
            let (from, to) = ends(y + BETWEEN);
            sheet.extension(from, to);
        }
    }

    fn cells(&self, sheet: &mut Sheet, at: DVec2, [name, angle, indices, instruction]: [&str; 4]) {
        let angle_right = self.names + ANGLES;
        let indices_left = angle_right + GUTTER;
        let said_left = indices_left + self.indices + GUTTER;
        if !name.is_empty() {
            sheet.strong_text(BODY, Align::Start, at, name);
        }
        // The star stands beside the column, so that the decimals stay one below the other.
        let (number, star) = angle.split_once(' ').unwrap_or((angle, ""));
        let at = |x: f64| at + DVec2::X * x;
        for (align, x, text) in [
            (Align::End, angle_right - 12.0, number),
            (Align::Start, angle_right - 9.0, star),
            (Align::Start, indices_left, indices),
            (Align::Start, said_left, instruction),
        ] {
            if !text.is_empty() {
                sheet.plain_text(BODY, align, at(x), text);
            }
        }
    }
}

impl TableLine {
    fn height(&self) -> f64 {
        match self {
            Self::Heading(_) => HEADING_HEIGHT,
            Self::Cells { .. } | Self::Note(_) => LINE,
        }
    }
}

impl LineGroup {
    /// Returns the height of the group with the space below it.
    pub fn height(&self) -> f64 {
        self.lines.iter().map(TableLine::height).sum::<f64>() + BETWEEN
    }

    /// Returns whether a block begins with this group.
    pub fn begins_block(&self) -> bool {
        matches!(self.lines.first(), Some(TableLine::Heading(_)))
    }

    /// Divides the group where it is higher than `room`, so that each part fits; a part has one line at least.
    pub fn divided(self, room: f64) -> Vec<Self> {
        let mut parts = vec![Self { lines: vec![] }];
        let mut height = BETWEEN;
        for line in self.lines {
            if height + line.height() > room && parts.last().is_some_and(|part| !part.lines.is_empty()) {
                parts.push(Self { lines: vec![] });
                height = BETWEEN;
            }
            height += line.height();
            parts.iter_mut().last().into_iter().for_each(|part| part.lines.push(line.clone()));
        }
        parts
    }
}
