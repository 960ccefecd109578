//! Technical drawings: a sheet with a stone, dimension lines, arrows and text on it.
//!
//! Coordinates are those of the drawing, y down, a unit a pixel where the drawing is shown 1000 wide. A sheet knows
//! how far what is drawn on it reaches, so nothing is clipped. Text is set in Ubuntu Light, which `io` rasterises
//! with; other viewers fall back on their own sans-serif of about the same widths.

use crate::math::{Basis, Facet};
use crate::scene::Stone;
use glam::{DVec2, DVec3};
use std::fmt::{Display, Write};
use svg::Document;
use svg::node::element::{Circle, Group, Path, Polygon, Rectangle, Text, Title};

/// Colour of outlines and names.
pub(super) const INK: &str = "#2a2e34";
/// Colour of edges between facets.
pub(super) const EDGE: &str = "#868c95";
/// Colour of remarks, and of what is there only to be read against.
pub(super) const QUIET: &str = "#70767f";
/// Colour of dimensions.
pub(super) const ACCENT: &str = "#1c5a94";
/// The lighter colour of the lines that lead from a dimension to what it measures.
const EXTENSION: &str = "#a9c2da";

/// Width that a drawing has unless it needs more.
const LEAST_WIDTH: f64 = 1000.0;
/// White space all round.
const MARGIN: f64 = 36.0;
/// Heights of the heading and of a line under the drawing.
const HEADING: f64 = 70.0;
const FOOT_LINE: f64 = 19.0;
/// Length and half width of an arrow head.
const ARROW: DVec2 = DVec2::new(9.0, 2.6);
/// A dimension shorter than this has its arrows outside.
pub(super) const ROOM_FOR_ARROWS: f64 = 26.0;

/// From a text's base line to the middle of its figures, in type sizes.
const MIDDLE_OF_FIGURES: f64 = 0.35;

/// A facet whose normal leans less than this toward the eye is seen edge on: rounding of a unit normal.
const EDGE_ON: f64 = 1e-9;

/// A size and a colour of text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Type {
    /// Height of the type, in units of the drawing.
    pub size: f64,
    /// Its colour.
    pub colour: &'static str,
}

/// Of the drawing's title.
const TITLE: Type = Type { size: 24.0, colour: INK };
/// Of dimensions.
pub(super) const DIMENSION: Type = Type { size: 15.0, colour: ACCENT };
/// Of remarks.
pub(super) const REMARK: Type = Type { size: 13.0, colour: QUIET };

/// Which part of a text stands at the point given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Align {
    Start,
    Middle,
    End,
}

/// A box with sides along the axes, as its least and greatest corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub low: DVec2,
    pub high: DVec2,
}

impl Frame {
    const EMPTY: Self = Self { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY };

    fn include(&mut self, p: DVec2) {
        (self.low, self.high) = (self.low.min(p), self.high.max(p));
    }
}

/// Width of a line of text, from the font's own advances; what is not ASCII counts as wide as it may be.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    /// Advances of U+0020 to U+007E in Ubuntu Light, thousandths of the type size.
    const ADVANCES: [u16; 95] = [
        228, 274, 392, 653, 564, 831, 648, 240, 310, 310, 472, 564, 246, 282, 246, 359, 564, 564, 564, 564,
        564, 564, 564, 564, 564, 564, 246, 246, 564, 564, 564, 380, 940, 641, 630, 609, 702, 555, 520, 658,
        692, 248, 487, 599, 502, 865, 709, 774, 592, 774, 618, 517, 548, 680, 624, 921, 608, 569, 560, 310,
        359, 310, 564, 490, 376, 509, 583, 460, 583, 548, 376, 573, 569, 237, 237, 495, 255, 863, 569, 582,
        583, 583, 374, 428, 387, 569, 480, 775, 499, 474, 455, 319, 262, 319, 564,
    ];
    let advance = |c: char| match c {
        ' '..='~' => ADVANCES[c as usize - 32],
        '°' => 318,
        '–' => 496,
        '·' => 246,
        _ => 1000,
    };
    text.chars().map(|c| f64::from(advance(c))).sum::<f64>() * size / 1000.0
}

/// The text, with its end left out where it is wider than `room`.
pub(super) fn shortened(text: &str, size: f64, room: f64) -> String {
    let mut kept = text.to_owned();
    let mut shown = kept.clone();
    while !kept.is_empty() && text_width(&shown, size) > room {
        kept.pop();
        shown = format!("{}…", kept.trim_end());
    }
    shown
}

/// A number to two decimals, without trailing zeros.
pub(super) fn rounded(value: f64) -> String {
    format!("{}", (value * 100.0).round() / 100.0 + 0.0)
}

/// Percent as they are written.
pub(super) fn percent(value: f64) -> String {
    format!("{} %", rounded(value))
}

/// Degrees as they are written.
pub(super) fn degrees(value: f64) -> String {
    format!("{}°", rounded(value))
}

/// A coordinate: three digits behind the point, no negative zero.
fn coordinate(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0 + 0.0
}

/// A point as paths and polygons write it.
fn point(p: DVec2) -> impl Display {
    format!("{},{}", coordinate(p.x), coordinate(p.y))
}

/// What XML cannot hold is shown by the sign for it.
fn printable(text: &str) -> String {
    let replaced =
        |c: char| if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') { '\u{fffd}' } else { c };
    text.chars().map(replaced).collect()
}

/// Straight lines as a path.
fn segments(lines: &[(DVec2, DVec2)]) -> Path {
    let mut data = String::new();
    for &(a, b) in lines {
        // Writing to a string cannot fail.
        let _ = write!(data, "M{}L{}", point(a), point(b));
    }
    Path::new().set("d", data)
}

/// A parallel view of a stone, in units of a drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aspect {
    /// The image plane.
    pub basis: Basis,
    /// The image coordinates that come to the sheet's origin, radii.
    pub centre: DVec2,
    /// Units of the drawing to a girdle radius.
    pub scale: f64,
    /// Where the centre comes to lie on the sheet.
    pub place: DVec2,
}

impl Aspect {
    /// A point of the stone on the sheet.
    pub fn at(&self, p: DVec3) -> DVec2 {
        self.on_sheet(self.basis.project(p))
    }

    /// Image coordinates, in radii, on the sheet.
    pub fn on_sheet(&self, image: DVec2) -> DVec2 {
        self.place + (image - self.centre) * DVec2::new(self.scale, -self.scale)
    }

    /// Whether a facet turns its face to the eye.
    pub fn shows(&self, facet: &Facet) -> bool {
        facet.plane.normal.dot(self.basis.toward) > EDGE_ON
    }

    /// The corners of a facet on the sheet.
    pub fn outline(&self, stone: &Stone, facet: &Facet) -> Vec<DVec2> {
        stone.polytope.corners(facet).map(|p| self.at(p)).collect()
    }
}

/// A drawing that grows.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    stone: Group,
    extensions: Group,
    dimensions: Group,
    texts: Group,
    frame: Frame,
}

impl Sheet {
    pub fn new() -> Self {
        let lines = |class: &str, colour: &str, width: f64| {
            Group::new().set("class", class).set("stroke", colour).set("stroke-width", width)
        };
        Self {
            stone: Group::new().set("class", "stone").set("stroke-linecap", "round").set("fill", "none"),
            extensions: lines("extensions", EXTENSION, 0.8),
            dimensions: lines("dimensions", ACCENT, 1.0).set("fill", "none"),
            texts: Group::new()
                .set("class", "text")
                .set("font-family", "Ubuntu, 'Ubuntu Light', sans-serif")
                .set("font-weight", 300)
                .set("paint-order", "stroke")
                .set("stroke", "#ffffff")
                .set("stroke-linejoin", "round"),
            frame: Frame::EMPTY,
        }
    }

    /// Draws the facets that `drawn` admits, each as a polygon with its name, and every edge in sight once.
    pub fn stone(&mut self, stone: &Stone, aspect: &Aspect, drawn: impl Fn(&Facet) -> bool) {
        let facets = stone.polytope.facets();
        let mut faces = Group::new().set("class", "facets");
        let (mut outline, mut edges, mut girdle) = (vec![], vec![], vec![]);
        for (id, facet) in facets.iter().enumerate() {
            let corners = aspect.outline(stone, facet);
            corners.iter().for_each(|&p| self.frame.include(p));
            if drawn(facet) {
                faces = faces.add(face(stone.name(id as u32), &corners, shade(facet, aspect)));
            }
            for (k, &other) in facet.neighbours.iter().enumerate().filter(|_| aspect.shows(facet)) {
                let line = (corners[k], corners[(k + 1) % corners.len()]);
                let beyond = &facets[other as usize];
                match (aspect.shows(beyond), is_vertical(facet) && is_vertical(beyond)) {
                    (false, _) => outline.push(line),
                    (true, _) if other < id as u32 => {}
                    (true, true) => girdle.push(line),
                    (true, false) => edges.push(line),
                }
            }
        }
        self.onto_stone(faces.set("stroke", "none"));
        for (lines, class, colour, width) in
            [(girdle, "girdle", EDGE, 0.35), (edges, "edges", EDGE, 0.9), (outline, "outline", INK, 1.8)]
        {
            self.onto_stone(
                segments(&lines).set("class", class).set("stroke", colour).set("stroke-width", width),
            );
        }
    }

    /// Quiet lines beside the stone, as those of a scale.
    pub fn quiet_lines(&mut self, lines: &[(DVec2, DVec2)], class: &str, width: f64) {
        lines.iter().for_each(|&(a, b)| [a, b].into_iter().for_each(|p| self.frame.include(p)));
        self.onto_stone(segments(lines).set("class", class).set("stroke", EDGE).set("stroke-width", width));
    }

    fn onto_stone(&mut self, element: impl Into<Box<dyn svg::Node>>) {
        self.stone = std::mem::take(&mut self.stone).add(element);
    }

    /// A line that leads from a dimension to what it measures.
    pub fn extension(&mut self, a: DVec2, b: DVec2) {
        [a, b].into_iter().for_each(|p| self.frame.include(p));
        self.extensions = std::mem::take(&mut self.extensions).add(segments(&[(a, b)]));
    }

    /// A line of the weight of dimensions.
    pub fn stroke(&mut self, a: DVec2, b: DVec2) {
        [a, b].into_iter().for_each(|p| self.frame.include(p));
        self.onto_dimensions(segments(&[(a, b)]));
    }

    fn onto_dimensions(&mut self, element: impl Into<Box<dyn svg::Node>>) {
        self.dimensions = std::mem::take(&mut self.dimensions).add(element);
    }

    /// An arrow head whose tip lies at `tip`, pointing along the unit vector `toward`.
    pub fn arrow_head(&mut self, tip: DVec2, toward: DVec2) {
        let (back, side) = (tip - toward * ARROW.x, toward.perp() * ARROW.y);
        let data = format!("M{}L{}L{}Z", point(tip), point(back + side), point(back - side));
        self.onto_dimensions(Path::new().set("d", data).set("fill", ACCENT).set("stroke", "none"));
    }

    /// A small disc, where a leader ends on a facet or two short dimensions meet.
    pub fn dot(&mut self, at: DVec2) {
        let disc = Circle::new().set("cx", coordinate(at.x)).set("cy", coordinate(at.y)).set("r", 2);
        self.onto_dimensions(disc.set("fill", ACCENT).set("stroke", "none"));
    }

    /// A dimension line between two points, with its arrows outside where there is no room between; whether there
    /// was.
    pub fn arrows(&mut self, a: DVec2, b: DVec2) -> bool {
        let Some(along) = (b - a).try_normalize() else { return false };
        let inside = (b - a).length() >= ROOM_FOR_ARROWS;
        // Whatever the line crosses is broken there, so that it reads as lying on top.
        let halo =
            segments(&[(a + along * 3.0, b - along * 3.0)]).set("stroke", "#ffffff").set("stroke-width", 5);
        self.onto_dimensions(halo);
        let outward = if inside { 1.0 } else { -1.0 };
        self.stroke(a, b);
        for (tip, toward) in [(a, -along * outward), (b, along * outward)] {
            self.arrow_head(tip, toward);
            if !inside {
                self.stroke(tip, tip - toward * 2.0 * ARROW.x);
            }
        }
        inside
    }

    /// Breaks dimension lines where a text is to stand.
    pub fn clear(&mut self, frame: Frame) {
        let (low, size) = (frame.low - DVec2::X * 5.0, frame.high - frame.low + DVec2::X * 10.0);
        let blank = Rectangle::new()
            .set("x", coordinate(low.x))
            .set("y", coordinate(low.y))
            .set("width", coordinate(size.x))
            .set("height", coordinate(size.y));
        self.onto_dimensions(blank.set("fill", "#ffffff").set("stroke", "none"));
    }

    /// An arc of dimension weight about `centre`, from `from` to `to`, both at its radius, the short way round; arrow
    /// heads where it is long enough.
    pub fn arc(&mut self, centre: DVec2, from: DVec2, to: DVec2) {
        let radius = (from - centre).length();
        let turn = (from - centre).perp_dot(to - centre).signum();
        let sweep = i32::from(turn > 0.0);
        let data = format!("M{0}A{1},{1} 0 0 {2} {3}", point(from), coordinate(radius), sweep, point(to));
        self.onto_dimensions(Path::new().set("d", data));
        if (to - from).length() >= ROOM_FOR_ARROWS {
            // An arrow head is a chord of the arc: half the angle that it spans off the tangent.
            for (end, sense) in [(from, -turn), (to, turn)] {
                let tangent = (end - centre).perp() * (sense / radius);
                let off = DVec2::from_angle(-sense * ARROW.x / radius / 2.0);
                self.arrow_head(end, off.rotate(tangent));
            }
        }
    }

    /// One line of text, its middle height at `at`, lifted off the lines under it by white round its letters.
    pub fn text(&mut self, kind: Type, align: Align, at: DVec2, content: &str) -> Frame {
        let frame = text_frame(kind.size, align, at, content);
        self.put(kind, align, at, content, frame, |text| text.set("stroke-width", 5))
    }

    /// The same, without the white.
    pub fn plain_text(&mut self, kind: Type, align: Align, at: DVec2, content: &str) {
        let frame = text_frame(kind.size, align, at, content);
        self.put(kind, align, at, content, frame, |text| text.set("stroke", "none"));
    }

    /// The same, read from the right; aligned along its upward line, the middle of whose height is at `at`.
    pub fn upright_text(&mut self, kind: Type, align: Align, at: DVec2, content: &str) {
        let level = text_frame(kind.size, align, DVec2::ZERO, content);
        let turned = [level.low, level.high].map(|p| at - p.perp());
        let frame = Frame { low: turned[0].min(turned[1]), high: turned[0].max(turned[1]) };
        let turn = format!("rotate(-90 {} {})", coordinate(at.x), coordinate(at.y));
        self.put(kind, align, at, content, frame, |text| text.set("stroke", "none").set("transform", turn));
    }

    fn put(
        &mut self,
        kind: Type,
        align: Align,
        at: DVec2,
        content: &str,
        frame: Frame,
        finish: impl FnOnce(Text) -> Text,
    ) -> Frame {
        [frame.low, frame.high].into_iter().for_each(|p| self.frame.include(p));
        let anchor = match align {
            Align::Start => "start",
            Align::Middle => "middle",
            Align::End => "end",
        };
        let text = Text::new(printable(content))
            .set("x", coordinate(at.x))
            .set("y", coordinate(at.y + MIDDLE_OF_FIGURES * kind.size))
            .set("font-size", kind.size)
            .set("fill", kind.colour)
            .set("text-anchor", anchor);
        self.texts = std::mem::take(&mut self.texts).add(finish(text));
        frame
    }

    /// The finished drawing: a heading over what was drawn, remarks under it, white space all round.
    pub fn document(mut self, title: &str, subtitle: &str, remarks: &[String]) -> Document {
        let drawn = self.frame;
        let remark_width = remarks.iter().map(|r| text_width(r, REMARK.size)).fold(0.0, f64::max);
        let inner = (drawn.high.x - drawn.low.x).max(remark_width).max(LEAST_WIDTH - 2.0 * MARGIN);
        let left = (drawn.low.x + drawn.high.x - inner) / 2.0;
        let top = drawn.low.y - HEADING;
        let heading = shortened(title, TITLE.size, inner);
        self.plain_text(TITLE, Align::Start, DVec2::new(left, top + 14.0), &heading);
        self.plain_text(REMARK, Align::Start, DVec2::new(left, top + 40.0), subtitle);
        for (k, remark) in remarks.iter().enumerate() {
            let below = drawn.high.y + 14.0 + FOOT_LINE * (k + 1) as f64;
            self.plain_text(REMARK, Align::Start, DVec2::new(left, below), remark);
        }
        let shift = DVec2::new(MARGIN - left, MARGIN - top).map(f64::round);
        let size = (DVec2::new(left + inner, self.frame.high.y) + shift + MARGIN).map(f64::ceil);
        let all = [self.stone, self.extensions, self.dimensions, self.texts];
        let content = all.into_iter().fold(Group::new(), Group::add);
        Document::new()
            .set("viewBox", (0, 0, size.x, size.y))
            .set("width", size.x)
            .set("height", size.y)
            .add(Title::new(printable(title)))
            .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "#ffffff"))
            .add(content.set("transform", format!("translate({} {})", shift.x, shift.y)))
    }
}

/// The box that a line of text fills.
pub(super) fn text_frame(size: f64, align: Align, at: DVec2, content: &str) -> Frame {
    let width = text_width(content, size);
    let left = match align {
        Align::Start => 0.0,
        Align::Middle => width / 2.0,
        Align::End => width,
    };
    let low = at - DVec2::new(left, 0.62 * size);
    Frame { low, high: low + DVec2::new(width, 1.2 * size) }
}

fn face(name: &str, corners: &[DVec2], fill: String) -> Polygon {
    let points = corners.iter().map(|&p| point(p).to_string()).collect::<Vec<_>>().join(" ");
    let name = printable(name);
    Polygon::new()
        .set("points", points)
        .set("fill", fill)
        .set("data-name", name.as_str())
        .add(Title::new(name))
}

fn is_vertical(facet: &Facet) -> bool {
    facet.plane.normal.z.abs() < EDGE_ON
}

/// A trace of grey on facets that turn away, so that the eye sees relief.
fn shade(facet: &Facet, aspect: &Aspect) -> String {
    let facing = facet.plane.normal.dot(aspect.basis.toward).clamp(0.0, 1.0);
    let grey = (232.0 + 23.0 * facing).round();
    format!("#{0:02x}{0:02x}{1:02x}", grey as u8, (grey + 3.0).min(255.0) as u8)
}
