//! Lays a report out on pages: a head with the known facts of the stone, then part below part, on as many pages as
//! they take.
//!
//! A unit of the drawing is half a point, 1/144 inch.

use super::super::drawing::{Align, Frame, Ink, Inks, Sheet, Type, shortened, text_width};
use super::super::sheet::{PaperSize, words};
use super::table::PlacedTable;
use super::{FigureRow, Report, ReportPart, ReportTable};
use glam::DVec2;
use svg::Document;

/// Units of the drawing per mm.
const PER_MM: f64 = 144.0 / 25.4;
/// Width of the white space on all sides.
const MARGIN: f64 = 68.0;
/// Height of the foot line with the space above it.
const FOOT: f64 = 30.0;
/// Type of the program's name at the top.
const IMPRINT: Type = Type { size: 15.0, colour: Ink::Accent };
/// Type of the title.
const TITLE: Type = Type { size: 36.0, colour: Ink::Main };
/// Type of the line below the title.
const SUBTITLE: Type = Type { size: 17.0, colour: Ink::Quiet };
/// Type of headings.
const HEADING: Type = Type { size: 19.0, colour: Ink::Accent };
/// Type of paragraphs.
const TEXT: Type = Type { size: 15.5, colour: Ink::Main };
/// Type of the values of facts.
const FACT: Type = Type { size: 18.0, colour: Ink::Main };
/// Type of captions, labels and feet.
const SMALL: Type = Type { size: 13.5, colour: Ink::Quiet };
/// Distance from line to line of paragraphs.
const LINE: f64 = 21.0;
/// The number of facts side by side.
const FACTS_ACROSS: usize = 4;
/// Height of a heading with the space around it.
const HEADING_HEIGHT: f64 = 52.0;
/// Height of a caption.
const CAPTION: f64 = 22.0;
/// Space between pictures.
const GAP: f64 = 16.0;
/// Space below a part.
const BELOW: f64 = 16.0;
/// Rows that stand at least together at the beginning of a table.
const LEAST_ROWS: usize = 3;

/// Draws a report, page by page.
pub fn report_pages(report: &Report, paper: PaperSize) -> Vec<Document> {
    let size = paper.size_mm() * PER_MM;
    let frame = Frame { low: DVec2::splat(MARGIN), high: size - MARGIN - DVec2::Y * FOOT };
    let mut flow = ReportFlow { frame, y: frame.low.y, sheet: Sheet::new(Inks::PAPER), pages: vec![] };
    flow.head(report);
    for (k, part) in report.parts.iter().enumerate() {
        match part {
            ReportPart::Heading(text) => flow.heading(text, report.parts.get(k + 1)),
            ReportPart::Figures(row) => flow.figures(row),
            ReportPart::Table(table) => flow.table(table),
            ReportPart::Text(text) => flow.text(text),
        }
    }
    flow.provenance(&report.provenance);
    let ReportFlow { mut pages, sheet, .. } = flow;
    pages.push(sheet);
    let count = pages.len();
    pages.iter_mut().enumerate().for_each(|(k, page)| foot(page, frame, (k + 1, count), report));
    pages.into_iter().map(|page| page.page(&report.title, size, paper.size_mm())).collect()
}

/// Pages that are being filled.
struct ReportFlow {
    /// The box of each page that is filled.
    frame: Frame,
    /// The height down to which the last page is filled.
    y: f64,
    sheet: Sheet,
    /// The pages before the last.
    pages: Vec<Sheet>,
}

impl ReportFlow {
    fn width(&self) -> f64 {
        self.frame.high.x - self.frame.low.x
    }

    fn left(&self, y: f64) -> DVec2 {
        DVec2::new(self.frame.low.x, y)
    }

    fn rule(&mut self, y: f64, width: f64) {
        let ends = (self.left(y), DVec2::new(self.frame.high.x, y));
        self.sheet.quiet_lines(&[ends], "rule", width);
    }

    /// Begins a page unless this one has so much room left, or is empty.
    fn need(&mut self, height: f64) {
        if self.y + height > self.frame.high.y && self.y > self.frame.low.y {
            self.pages.push(std::mem::replace(&mut self.sheet, Sheet::new(Inks::PAPER)));
            self.y = self.frame.low.y;
        }
    }

    /// Writes the title and the known facts of the stone.
    fn head(&mut self, report: &Report) {
        let top = self.frame.low.y;
        self.sheet.strong_text(IMPRINT, Align::Start, self.left(top + 8.0), "BRILLIANTEER");
        let right = DVec2::new(self.frame.high.x, top + 8.0);
        self.sheet.plain_text(SMALL, Align::End, right, "report on the light and the geometry of a cut");
        self.rule(top + 22.0, 1.8);
        let title = shortened(&report.title, TITLE.size, 0.96 * self.width());
        self.sheet.strong_text(TITLE, Align::Start, self.left(top + 54.0), &title);
        self.y = top + 84.0;
        for line in words(&report.subtitle, SUBTITLE.size, self.width()).into_iter().take(3) {
            self.sheet.plain_text(SUBTITLE, Align::Start, self.left(self.y + 4.0), &line);
            self.y += LINE;
        }
        self.y += 8.0;
        let across = self.width() / FACTS_ACROSS as f64;
        for row in report.facts.chunks(FACTS_ACROSS) {
            for (k, [label, value]) in row.iter().enumerate() {
                let at = self.left(self.y + 10.0) + DVec2::X * across * k as f64;
                self.sheet.plain_text(SMALL, Align::Start, at, label);
                let value = shortened(value, FACT.size, across - GAP);
                self.sheet.plain_text(FACT, Align::Start, at + DVec2::Y * 22.0, &value);
            }
            self.y += 50.0;
        }
        self.rule(self.y + 2.0, 1.0);
        self.y += 14.0;
    }

    /// Writes a heading, together with the beginning of the part that follows.
    fn heading(&mut self, text: &str, next: Option<&ReportPart>) {
        let begins = match next {
            Some(ReportPart::Figures(row)) => self.height_of(row) + CAPTION,
            Some(ReportPart::Table(table)) => {
                let placed = PlacedTable::new(table, 0.0, self.width());
                placed.head_height() + placed.height(0, placed.count().min(LEAST_ROWS * table.across))
            }
            Some(_) => 2.0 * LINE,
            None => 0.0,
        };
        self.need(HEADING_HEIGHT + begins);
        let at = self.left(self.y + 24.0);
        let text = shortened(text, HEADING.size, 0.96 * self.width());
        self.sheet.strong_text(HEADING, Align::Start, at, &text);
        self.rule(self.y + 38.0, 1.0);
        self.y += HEADING_HEIGHT;
    }

    /// Returns the height of the pictures of a row.
    fn height_of(&self, row: &FigureRow) -> f64 {
        let gaps = GAP * row.figures.len().saturating_sub(1) as f64;
        let aspects: f64 = row.figures.iter().map(|figure| figure.drawing.aspect()).sum();
        let room = (self.frame.high.y - self.frame.low.y) / 2.0;
        ((self.width() - gaps) / aspects.max(f64::MIN_POSITIVE)).min(row.most_height * self.width()).min(room)
    }

    fn figures(&mut self, row: &FigureRow) {
        let height = self.height_of(row);
        self.need(height + CAPTION);
        let gaps = GAP * row.figures.len().saturating_sub(1) as f64;
        let aspects: f64 = row.figures.iter().map(|figure| figure.drawing.aspect()).sum();
        let mut left = self.frame.low.x;
        for figure in &row.figures {
            // Pictures that could be wider stand in the middle of their part of the width.
            let cell = (self.width() - gaps) * figure.drawing.aspect() / aspects;
            let (middle, half) = (left + cell / 2.0, height * figure.drawing.aspect() / 2.0);
            let low = DVec2::new(middle - half, self.y);
            let frame = Frame { low, high: DVec2::new(middle + half, self.y + height) };
            self.sheet.embed(&figure.drawing.within(frame), frame);
            let caption = shortened(&figure.caption, SMALL.size, cell);
            let at = DVec2::new(middle, self.y + height + CAPTION / 2.0 + 2.0);
            self.sheet.plain_text(SMALL, Align::Middle, at, &caption);
            left += cell + GAP;
        }
        self.y += height + CAPTION + BELOW / 2.0;
    }

    fn table(&mut self, table: &ReportTable) {
        let placed = PlacedTable::new(table, self.frame.low.x, self.width());
        let mut from = 0;
        while from < placed.count() {
            let least = placed.height(from, (placed.count() - from).min(LEAST_ROWS * table.across.max(1)));
            self.need(placed.head_height() + least);
            let room = self.frame.high.y - self.y - placed.head_height();
            // A row that is higher than a page is still drawn on one.
            let count = placed.fitting(from, room).max(1);
            // No one or two rows are left alone on the next page.
            let (rest, few) = (placed.count() - from - count, LEAST_ROWS * table.across.max(1));
            let count = if rest > 0 && rest < few { count.saturating_sub(few - rest).max(1) } else { count };
            placed.draw(&mut self.sheet, (from, count), self.y);
            self.y += placed.head_height() + placed.height(from, count);
            from += count;
        }
        self.y += BELOW;
    }

    fn text(&mut self, text: &str) {
        for line in words(text, TEXT.size, self.width()) {
            self.need(LINE);
            self.sheet.plain_text(TEXT, Align::Start, self.left(self.y + LINE / 2.0), &line);
            self.y += LINE;
        }
        self.y += BELOW / 2.0;
    }

    /// Writes the lines on how the report was made.
    fn provenance(&mut self, lines: &[[String; 2]]) {
        let labels = lines.iter().map(|[label, _]| text_width(label, SMALL.size)).fold(0.0, f64::max) + GAP;
        let lines: Vec<(&str, Vec<String>)> = lines
            .iter()
            .map(|[label, value]| (label.as_str(), words(value, SMALL.size, self.width() - labels)))
            .collect();
        let height: f64 = lines.iter().map(|(_, lines)| 18.0 * lines.len().max(1) as f64).sum();
        self.need(height + 30.0);
        self.rule(self.y + 10.0, 1.0);
        self.y += 24.0;
        for (label, values) in lines {
            self.sheet.plain_text(SMALL, Align::Start, self.left(self.y), label);
            for value in &values {
                self.sheet.plain_text(SMALL, Align::Start, self.left(self.y) + DVec2::X * labels, value);
                self.y += 18.0;
            }
            self.y += if values.is_empty() { 18.0 } else { 0.0 };
        }
    }
}

/// Writes the small line at the foot of a page.
fn foot(sheet: &mut Sheet, frame: Frame, (page, pages): (usize, usize), report: &Report) {
    let y = frame.high.y + FOOT - 6.0;
    let program = format!("page {page} of {pages} · Brillianteer {}", env!("CARGO_PKG_VERSION"));
    sheet.plain_text(SMALL, Align::End, DVec2::new(frame.high.x, y), &program);
    let said = if report.mark.is_empty() {
        report.title.clone()
    } else {
        format!("{} · {}", report.title, report.mark)
    };
    let room = frame.high.x - frame.low.x - text_width(&program, SMALL.size) - 20.0;
    let said = shortened(&said, SMALL.size, room);
    sheet.plain_text(SMALL, Align::Start, DVec2::new(frame.low.x, y), &said);
}
