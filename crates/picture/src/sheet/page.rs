//! Lays a cutter's sheet out on pages: heading, plans, figures and profiles on the first, then the tiers, which
//! continue over as many pages as they take.
//!
//! A unit of the drawing is half a point, 1/144 inch.

use super::super::drawing::{Align, Frame, HATCHING_LEGEND, Ink, Inks, Sheet, Type, shortened, text_width};
use super::cutting_sheet::CuttingSheet;
use super::table::{Columns, LineGroup};
use super::view::{SheetView, plan_half_height, profile_scale, profiles};
use super::wrapping::words;
use brillianteer_math::Basis;
use brillianteer_scene::Stone;
use glam::DVec2;
use svg::Document;

/// Units of the drawing per mm.
const PER_MM: f64 = 144.0 / 25.4;
/// Width of the white space on all sides.
const MARGIN: f64 = 64.0;
/// Height of the foot line with the space above it.
const FOOT: f64 = 26.0;
/// Type of the title.
const TITLE: Type = Type { size: 38.0, colour: Ink::Main };
/// Type of the title on pages after the first.
const TITLE_AGAIN: Type = Type { size: 22.0, colour: Ink::Main };
/// Type of the lines below the title and of the figures.
const FIGURES: Type = Type { size: 18.0, colour: Ink::Main };
/// Type of small print.
const SMALL: Type = Type { size: 13.5, colour: Ink::Quiet };
/// The most lines below the title.
const MOST_LINES: usize = 8;
/// Distance from line to line below the title and among figures.
const LINE: f64 = 22.0;
/// Distance from line to line in small print.
const SMALL_LINE: f64 = 16.0;
/// Width of the column of figures.
const FIGURES_WIDTH: f64 = 286.0;
/// The radii of the plans that are tried, the largest first.
const RADII: [f64; 4] = [190.0, 176.0, 162.0, 148.0];
/// The largest profile, beside its captions and leaders.
const PROFILE: DVec2 = DVec2::new(290.0, 230.0);

/// A size of paper, upright.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PaperSize {
    /// 210 by 297 mm.
    #[default]
    A4,
    /// 8½ by 11 inches.
    Letter,
}

impl PaperSize {
    /// All sizes.
    pub const ALL: [Self; 2] = [Self::A4, Self::Letter];

    /// Returns the name of the size.
    pub fn name(self) -> &'static str {
        match self {
            Self::A4 => "A4",
            Self::Letter => "US letter",
        }
    }

    /// Returns width and height in mm.
    pub fn size_mm(self) -> DVec2 {
        match self {
            Self::A4 => DVec2::new(210.0, 297.0),
            Self::Letter => DVec2::new(215.9, 279.4),
        }
    }
}

/// Draws a cutter's sheet, page by page.
pub fn sheet_pages(data: &CuttingSheet, paper: PaperSize) -> Vec<Document> {
    let stone = &data.stone;
    let size = paper.size_mm() * PER_MM;
    let frame = Frame { low: DVec2::splat(MARGIN), high: size - MARGIN - DVec2::Y * FOOT };
    let layout = Layout { data, stone, frame };
    let columns = Columns::of(data, frame.low.x, frame.high.x - frame.low.x);
    let groups = columns.groups(data);
    let drawn = RADII.into_iter().map(|radius| {
        let mut sheet = Sheet::new(Inks::PRINT);
        let y = layout.drawings(&mut sheet, radius);
        (sheet, y)
    });
    let list: f64 = groups.iter().map(LineGroup::height).sum();
    // Where no size of the drawings leaves room for the whole list, they are drawn as large as possible.
    let fits = |&(_, y): &(Sheet, f64)| y + list <= frame.high.y;
    let (mut first, mut all) = (None, drawn);
    let found = all.find(|drawing| {
        if first.is_none() {
            first = Some((drawing.0.clone(), drawing.1));
        }
        fits(drawing)
    });
    let Some((sheet, y)) = found.or(first) else { return vec![] };
    let mut pages = layout.fill(sheet, y, &columns, groups);
    let count = pages.len();
    pages.iter_mut().enumerate().for_each(|(k, page)| layout.foot(page, k + 1, count));
    pages.into_iter().map(|page| page.page(&data.title, size, paper.size_mm())).collect()
}

/// The content to be laid out, and the box of each page that it fills.
struct Layout<'a> {
    data: &'a CuttingSheet,
    stone: &'a Stone,
    frame: Frame,
}

impl Layout<'_> {
    fn width(&self) -> f64 {
        self.frame.high.x - self.frame.low.x
    }

    /// Draws everything above the list. Returns the height at which the list begins.
    fn drawings(&self, sheet: &mut Sheet, radius: f64) -> f64 {
        let top = self.heading(sheet);
        let middle = (self.frame.low.x + self.frame.high.x) / 2.0;
        let below = top + 26.0 + 2.0 * plan_half_height(radius);
        let halves =
            [(self.frame.low.x, middle, Basis::FACE_UP), (middle, self.frame.high.x, Basis::FACE_DOWN)];
        for (left, right, basis) in halves {
            let bounds = Frame { low: DVec2::new(left, top), high: DVec2::new(right, below) };
            SheetView { data: self.data, stone: self.stone, bounds }.plan(sheet, basis, radius);
        }
        let figures = self.figures(sheet, below + 8.0);
        let profiles = self.profiles(sheet, below + 8.0, radius / RADII[0]);
        figures.max(profiles)
    }

    /// Writes the title and the lines below it. Returns the height at which they end.
    fn heading(&self, sheet: &mut Sheet) -> f64 {
        let at = |y: f64| DVec2::new(self.frame.low.x, y);
        let top = self.frame.low.y;
        let title = shortened(&self.data.title, TITLE.size, 0.98 * self.width());
        sheet.strong_text(TITLE, Align::Start, at(top + 20.0), &title);
        let lines = self.data.lines.iter().flat_map(|line| words(line, FIGURES.size, self.width()));
        let mut y = top + 46.0;
        for line in lines.take(MOST_LINES) {
            sheet.plain_text(FIGURES, Align::Start, at(y + LINE / 2.0), &line);
            y += LINE;
        }
        let rule = [self.frame.low.x, self.frame.high.x].map(|x| DVec2::new(x, y + 6.0));
        sheet.quiet_lines(&[(rule[0], rule[1])], "rule", 1.6);
        y + 18.0
    }

    /// Writes the figures. Returns the height at which they end.
    fn figures(&self, sheet: &mut Sheet, top: f64) -> f64 {
        let left = self.frame.low.x;
        let mut y = top + 10.0;
        for (k, line) in facts(self.data).into_iter().enumerate() {
            for line in words(&line, FIGURES.size, FIGURES_WIDTH - 20.0) {
                match k {
                    0 => drop(sheet.strong_text(FIGURES, Align::Start, DVec2::new(left, y), &line)),
                    _ => sheet.plain_text(FIGURES, Align::Start, DVec2::new(left, y), &line),
                }
                y += LINE;
            }
        }
        y += 8.0;
        let ratios = self.data.figures.ratios();
        let rows = ratios.len().div_ceil(2);
        for (k, (symbol, value)) in ratios.into_iter().enumerate() {
            let (column, row) = (k / rows, k % rows);
            let x = left + column as f64 * (FIGURES_WIDTH / 2.0);
            let height = y + row as f64 * LINE;
            sheet.plain_text(FIGURES, Align::Start, DVec2::new(x, height), symbol);
            let right = DVec2::new(x + FIGURES_WIDTH / 2.0 - 20.0, height);
            sheet.plain_text(FIGURES, Align::End, right, &format!("{value:.3}"));
        }
        y += rows as f64 * LINE + 6.0;
        for remark in remarks(self.data) {
            for line in words(&remark, SMALL.size, FIGURES_WIDTH - 20.0) {
                sheet.plain_text(SMALL, Align::Start, DVec2::new(left, y), &line);
                y += SMALL_LINE;
            }
            y += 3.0;
        }
        y
    }

    /// Draws end and side beside the figures. Returns the height at which they end.
    fn profiles(&self, sheet: &mut Sheet, top: f64, part: f64) -> f64 {
        let left = self.frame.low.x + FIGURES_WIDTH;
        let width = (self.frame.high.x - left) / 2.0;
        let scale = profile_scale(self.stone, PROFILE * part);
        let (low, high) = self.stone.polytope.bounds();
        let below = top + 32.0 + (high.z - low.z) * scale + 36.0;
        let named = profiles(self.stone).into_iter().zip([("END", "W"), ("SIDE", "L")]);
        for (k, (basis, names)) in named.enumerate() {
            let from = left + k as f64 * width;
            let bounds = Frame { low: DVec2::new(from, top), high: DVec2::new(from + width, below) };
            SheetView { data: self.data, stone: self.stone, bounds }.profile(sheet, basis, scale, names);
        }
        below
    }

    /// Writes the list below the drawings of the first page and on further pages.
    fn fill(&self, sheet: Sheet, y: f64, columns: &Columns, groups: Vec<LineGroup>) -> Vec<Sheet> {
        let (mut pages, mut page, mut y) = (vec![], sheet, y);
        let next = self.frame.low.y + 40.0;
        let room = self.frame.high.y - next;
        let groups: Vec<LineGroup> = groups.into_iter().flat_map(|group| group.divided(room)).collect();
        for (k, group) in groups.iter().enumerate() {
            // A block that a page holds is not divided, unless it is the first.
            let rest = groups[k + 1..].iter().take_while(|group| !group.begins_block());
            let block = group.height() + rest.map(LineGroup::height).sum::<f64>();
            let is_kept = k > 0 && group.begins_block() && block <= room;
            let needed = if is_kept { block } else { group.height() };
            if y + needed > self.frame.high.y {
                pages.push(std::mem::replace(&mut page, Sheet::new(Inks::PRINT)));
                let title = shortened(&self.data.title, TITLE_AGAIN.size, 0.98 * self.width());
                let at = DVec2::new(self.frame.low.x, self.frame.low.y + 12.0);
                page.strong_text(TITLE_AGAIN, Align::Start, at, &title);
                y = next;
            }
            columns.draw(&mut page, group, y);
            y += group.height();
        }
        pages.push(page);
        pages
    }

    /// Writes the small line at the foot of a page.
    fn foot(&self, sheet: &mut Sheet, page: usize, pages: usize) {
        let y = self.frame.high.y + FOOT - 6.0;
        let number = if pages > 1 { format!("page {page} of {pages} · ") } else { String::new() };
        let program = format!("{number}Brillianteer {}", env!("CARGO_PKG_VERSION"));
        sheet.plain_text(SMALL, Align::End, DVec2::new(self.frame.high.x, y), &program);
        let sense = if self.data.clockwise { "clockwise" } else { "counter-clockwise" };
        let said = format!(
            "Angles in degrees from the girdle plane. Indices of {} teeth, {sense} seen from above the table.",
            self.data.gear
        );
        let room = self.width() - text_width(&program, SMALL.size) - 20.0;
        sheet.plain_text(
            SMALL,
            Align::Start,
            DVec2::new(self.frame.low.x, y),
            &shortened(&said, SMALL.size, room),
        );
    }
}

/// Writes a number with up to four decimals.
fn short_number(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4)
}

/// Returns the facts about the design in words.
fn facts(data: &CuttingSheet) -> Vec<String> {
    let figures = &data.figures;
    let (facets, girdle) = (figures.facets, figures.girdle_facets);
    let mirror = if data.mirror { ", mirror-image" } else { "" };
    let hand = if data.clockwise { ", clockwise" } else { "" };
    let mut facts = vec![
        format!("Angles for R.I. = {}", short_number(data.refractive_index)),
        format!("{facets} + {girdle} girdle = {} facets", facets + girdle),
        format!("{}-fold{mirror} symmetry", data.symmetry),
        format!("{} index{hand}", data.gear),
    ];
    facts.extend(data.material.iter().map(|name| format!("Material: {name}")));
    facts
}

/// Returns the remarks on the figures in small print.
fn remarks(data: &CuttingSheet) -> Vec<String> {
    let mut remarks =
        vec!["H is P + C and the girdle as it is measured, G; GemCad prints 0.02 W for G.".to_owned()];
    remarks.extend(between_teeth(data));
    if data.is_frosted {
        remarks.push(HATCHING_LEGEND.to_owned());
    }
    if let Some(angle) = data.critical_angle_deg {
        remarks.push(match data.below_critical.as_slice() {
            [] => format!("Critical angle {angle:.2}°: all pavilion tiers lie above it."),
            names => format!(
                "* Critical angle {angle:.2}°: light leaks through pavilion tiers below it: {}.",
                names.join(", ")
            ),
        });
    }
    remarks
}

/// Returns a note on indices that are no whole teeth, which says what to do; `None` where all are whole.
fn between_teeth(data: &CuttingSheet) -> Option<String> {
    let said = format!(
        "Indices with decimals lie between teeth of the gear of {}, rounded to 0.001 tooth: set the tooth, and the rest by the \
         cheater.",
        data.gear
    );
    Some(said).filter(|_| !data.between_teeth.is_empty())
}
