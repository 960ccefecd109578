//! Technical drawings: a sheet with a stone, dimension lines, arrows and text on it.
//!
//! Coordinates are those of the drawing, y down; a unit is a pixel where the drawing is shown 1000 wide. A sheet
//! records the box of its contents, so that nothing is clipped. Text is set in Ubuntu Light, with which `io`
//! rasterises; other viewers fall back on their own sans-serif, of about the same widths.

mod hatching;
mod inks;
mod lettering;
mod paper;
mod room;

pub(crate) use hatching::LEGEND as HATCHING_LEGEND;
pub use inks::Inks;
pub(super) use inks::{Ink, between, hex};
pub(super) use lettering::{
    Align, DIMENSION, Frame, REMARK, TITLE, Type, printable, shortened, text_frame, text_width,
};
pub use lettering::{degrees, percent};
pub(super) use room::{LeaderRoom, overlap, room_for};

use brillianteer_math::{Basis, Facet};
use brillianteer_scene::Stone;
use glam::{DVec2, DVec3};
use lettering::MIDDLE_OF_FIGURES;
use std::fmt::{Display, Write};
use svg::node::element::{Circle, Group, Path, Polygon, Rectangle, Text, Title};
use svg::{Document, Node};

/// Width of a drawing, unless it needs more.
const LEAST_WIDTH: f64 = 1000.0;
/// Width of the white space on all sides.
const MARGIN: f64 = 36.0;
/// Height of the heading.
const HEADING: f64 = 70.0;
/// Height of a line under the drawing.
const FOOT_LINE: f64 = 19.0;
/// Length and half width of an arrow head, as x and y.
const ARROW: DVec2 = DVec2::new(9.0, 2.6);
/// Length below which a dimension has its arrows outside.
pub(super) const ROOM_FOR_ARROWS: f64 = 26.0;

/// The colour of marks: amber, which is visible on white paper and on a dark screen.
const MARK: [u8; 3] = [0xe0, 0x8a, 0x00];

/// Cosine below which a facet counts as seen edge on: the rounding of a unit normal.
const EDGE_ON: f64 = 1e-9;

/// Rounds a coordinate to three decimals, without negative zero.
fn coordinate(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0 + 0.0
}

/// Returns a point as paths and polygons write it.
fn point(p: DVec2) -> impl Display {
    format!("{},{}", coordinate(p.x), coordinate(p.y))
}

/// Returns straight lines as one path.
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
pub(super) struct DrawnAspect {
    /// The image plane.
    pub basis: Basis,
    /// The image coordinates that lie at `place`, in radii.
    pub centre: DVec2,
    /// Units of the drawing per girdle radius.
    pub scale: f64,
    /// The point of the sheet where `centre` lies.
    pub place: DVec2,
}

impl DrawnAspect {
    /// Returns the place of a point of the stone on the sheet.
    pub fn at(&self, p: DVec3) -> DVec2 {
        self.on_sheet(self.basis.project(p))
    }

    /// Returns the place of image coordinates, in radii, on the sheet.
    pub fn on_sheet(&self, image: DVec2) -> DVec2 {
        self.place + (image - self.centre) * DVec2::new(self.scale, -self.scale)
    }

    /// Returns whether a facet faces the eye.
    pub fn shows(&self, facet: &Facet) -> bool {
        facet.plane.normal.dot(self.basis.toward) > EDGE_ON
    }

    /// Returns the corners of a facet on the sheet.
    pub fn outline(&self, stone: &Stone, facet: &Facet) -> Vec<DVec2> {
        stone.polytope.corners(facet).map(|p| self.at(p)).collect()
    }
}

/// A drawing to which elements are added; it keeps the box that they fill.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    /// Drawings that stand on this one, under everything else.
    embedded: Group,
    stone: Group,
    extensions: Group,
    dimensions: Group,
    texts: Group,
    frame: Frame,
    inks: Inks,
    /// True where facets are hatched.
    is_hatched: bool,
}

impl Sheet {
    /// Builds an empty sheet for drawing in these colours.
    pub fn new(inks: Inks) -> Self {
        let lines = |class: &str, colour: Ink, width: f64| {
            Group::new().set("class", class).set("stroke", inks.of(colour)).set("stroke-width", width)
        };
        Self {
            embedded: Group::new(),
            stone: Group::new().set("class", "stone").set("stroke-linecap", "round").set("fill", "none"),
            extensions: lines("extensions", Ink::Extension, 0.8),
            dimensions: lines("dimensions", Ink::Accent, 1.0).set("fill", "none"),
            texts: Group::new()
                .set("class", "text")
                .set("font-family", "Ubuntu, 'Ubuntu Light', sans-serif")
                .set("font-weight", 300)
                .set("paint-order", "stroke")
                .set("stroke", inks.of(Ink::Paper))
                .set("stroke-linejoin", "round"),
            frame: Frame::EMPTY,
            inks,
            is_hatched: false,
        }
    }

    /// Draws the facets that `drawn` admits, each as a polygon with its name, and every edge in sight once.
    /// Frosted facets are hatched.
    pub fn stone(&mut self, stone: &Stone, aspect: &DrawnAspect, drawn: impl Fn(&Facet) -> bool) {
        let facets = stone.polytope.facets();
        let mut faces = Group::new().set("class", "facets");
        let (mut outline, mut edges, mut girdle, mut hatching) = (vec![], vec![], vec![], vec![]);
        for (id, facet) in facets.iter().enumerate() {
            let corners = aspect.outline(stone, facet);
            corners.iter().for_each(|&p| self.frame.include(p));
            if drawn(facet) {
                if facet.frosting > 0.0 {
                    hatching.extend(hatching::hatched(&corners));
                }
                faces = faces.add(face(&stone.name(id as u32), &corners, self.shade(facet, aspect)));
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
        self.stone.append(faces.set("stroke", "none"));
        if !hatching.is_empty() {
            self.is_hatched = true;
            self.quiet_lines(&hatching, "frosted", 0.6);
        }
        for (lines, class, colour, width) in [
            (girdle, "girdle", Ink::Edge, 0.35),
            (edges, "edges", Ink::Edge, 0.9),
            (outline, "outline", Ink::Main, 1.8),
        ] {
            let lines = segments(&lines).set("class", class).set("stroke", self.inks.of(colour));
            self.stone.append(lines.set("stroke-width", width));
        }
    }

    /// Returns the fill of a facet: slightly shaded where the facet turns away from the eye, so that the drawing shows
    /// relief.
    fn shade(&self, facet: &Facet, aspect: &DrawnAspect) -> String {
        between(self.inks.faces, facet.plane.normal.dot(aspect.basis.toward).clamp(0.0, 1.0))
    }

    /// Draws unobtrusive lines beside the stone, such as those of a scale.
    pub fn quiet_lines(&mut self, lines: &[(DVec2, DVec2)], class: &str, width: f64) {
        lines.iter().for_each(|&(a, b)| [a, b].into_iter().for_each(|p| self.frame.include(p)));
        let lines = segments(lines).set("class", class).set("stroke", self.inks.of(Ink::Edge));
        self.stone.append(lines.set("stroke-width", width));
    }

    /// Draws an extension line, which leads from a dimension to the measured point.
    pub fn extension(&mut self, a: DVec2, b: DVec2) {
        [a, b].into_iter().for_each(|p| self.frame.include(p));
        self.extensions.append(segments(&[(a, b)]));
    }

    /// Draws a line of the same weight as dimension lines.
    pub fn stroke(&mut self, a: DVec2, b: DVec2) {
        [a, b].into_iter().for_each(|p| self.frame.include(p));
        self.dimensions.append(segments(&[(a, b)]));
    }

    /// Draws an arrow head whose tip lies at `tip`, pointing along the unit vector `toward`.
    pub fn arrow_head(&mut self, tip: DVec2, toward: DVec2) {
        let (back, side) = (tip - toward * ARROW.x, toward.perp() * ARROW.y);
        let data = format!("M{}L{}L{}Z", point(tip), point(back + side), point(back - side));
        self.dimensions
            .append(Path::new().set("d", data).set("fill", self.inks.of(Ink::Accent)).set("stroke", "none"));
    }

    /// Outlines a marked facet.
    pub fn mark_outline(&mut self, corners: &[DVec2]) {
        let mut data = String::new();
        for (k, &corner) in corners.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = write!(data, "{}{}", if k == 0 { "M" } else { "L" }, point(corner));
        }
        let outline = Path::new().set("class", "marked-facet").set("d", data + "Z").set("fill", "none");
        self.dimensions.append(outline.set("stroke", hex(MARK)).set("stroke-width", 2.2));
    }

    /// Draws a ring around a marked corner.
    pub fn mark_corner(&mut self, at: DVec2) {
        let ring = Circle::new().set("cx", coordinate(at.x)).set("cy", coordinate(at.y)).set("r", 5);
        let ring = ring.set("class", "marked-corner").set("fill", "none");
        self.dimensions.append(ring.set("stroke", hex(MARK)).set("stroke-width", 2.2));
    }

    /// Draws a small disc, for where a leader ends on a facet or two short dimensions meet.
    pub fn dot(&mut self, at: DVec2) {
        let disc = Circle::new().set("cx", coordinate(at.x)).set("cy", coordinate(at.y)).set("r", 2);
        self.dimensions.append(disc.set("fill", self.inks.of(Ink::Accent)).set("stroke", "none"));
    }

    /// Draws a dimension line between two points. Returns whether there is room for its arrows between them; without it
    /// they stand outside.
    pub fn arrows(&mut self, a: DVec2, b: DVec2) -> bool {
        let Some(along) = (b - a).try_normalize() else { return false };
        let inside = (b - a).length() >= ROOM_FOR_ARROWS;
        // A halo breaks the lines underneath, so that this line reads as lying on top.
        let halo = segments(&[(a + along * 3.0, b - along * 3.0)]).set("stroke", self.inks.of(Ink::Paper));
        self.dimensions.append(halo.set("stroke-width", 5));
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

    /// Clears a box for a text by breaking the dimension lines behind it.
    pub fn clear(&mut self, frame: Frame) {
        let (low, size) = (frame.low - DVec2::X * 5.0, frame.high - frame.low + DVec2::X * 10.0);
        let blank = Rectangle::new()
            .set("x", coordinate(low.x))
            .set("y", coordinate(low.y))
            .set("width", coordinate(size.x))
            .set("height", coordinate(size.y));
        self.dimensions.append(blank.set("fill", self.inks.of(Ink::Paper)).set("stroke", "none"));
    }

    /// Draws an arc of dimension weight about `centre`, the short way from `from` to `to`, both at its radius. The arc
    /// has arrow heads where it is long enough.
    pub fn arc(&mut self, centre: DVec2, from: DVec2, to: DVec2) {
        let radius = (from - centre).length();
        let turn = (from - centre).perp_dot(to - centre).signum();
        let sweep = i32::from(turn > 0.0);
        let data = format!("M{0}A{1},{1} 0 0 {2} {3}", point(from), coordinate(radius), sweep, point(to));
        self.dimensions.append(Path::new().set("d", data));
        if (to - from).length() >= ROOM_FOR_ARROWS {
            // An arrow head is a chord of the arc, so it is turned off the tangent by half the angle that it spans.
            for (end, sense) in [(from, -turn), (to, turn)] {
                let tangent = (end - centre).perp() * (sense / radius);
                let off = DVec2::from_angle(-sense * ARROW.x / radius / 2.0);
                self.arrow_head(end, off.rotate(tangent));
            }
        }
    }

    /// Writes one line of text, its middle height at `at`, with a halo of paper round its letters that lifts it off
    /// lines underneath. Returns the box that it fills.
    pub fn text(&mut self, kind: Type, align: Align, at: DVec2, content: &str) -> Frame {
        let frame = text_frame(kind.size, align, at, content);
        self.put(kind, align, at, content, frame, |text| text.set("stroke-width", 5))
    }

    /// Writes one line of text as [`text`](Self::text) does, without the halo.
    pub fn plain_text(&mut self, kind: Type, align: Align, at: DVec2, content: &str) {
        let frame = text_frame(kind.size, align, at, content);
        self.put(kind, align, at, content, frame, |text| text.set("stroke", "none"));
    }

    /// Writes one line of text turned by a right angle, to be read from the right, without a halo. It is aligned along
    /// its upward line, and the middle of its height is at `at`.
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
            .set("fill", self.inks.of(kind.colour))
            .set("text-anchor", anchor);
        self.texts.append(finish(text));
        frame
    }

    /// Returns the finished drawing: a heading above the contents, remarks below, and white space on all sides.
    pub fn document(mut self, title: &str, subtitle: &str, remarks: &[String]) -> Document {
        let drawn = self.frame;
        let legend = self.is_hatched.then(|| hatching::LEGEND.to_owned());
        let remarks: Vec<&String> = remarks.iter().chain(&legend).collect();
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
        let frame = Frame { low: DVec2::new(left, top), high: DVec2::new(left + inner, self.frame.high.y) };
        self.finish(title, frame, MARGIN)
    }

    /// Returns the drawing without a heading, as wide as its contents, with a margin of paper on all sides.
    pub fn bare(self, title: &str, margin: f64) -> Document {
        let frame = self.frame;
        self.finish(title, frame, margin)
    }

    fn finish(self, title: &str, frame: Frame, margin: f64) -> Document {
        let shift = (DVec2::splat(margin) - frame.low).map(f64::round);
        let size = (frame.high + shift + margin).map(f64::ceil);
        let paper = self.inks.of(Ink::Paper);
        let all = [self.stone, self.extensions, self.dimensions, self.texts];
        let content = all.into_iter().fold(Group::new(), Group::add);
        page(size)
            .add(Title::new(printable(title)))
            .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", paper))
            .add(content.set("transform", format!("translate({} {})", shift.x, shift.y)))
    }
}

/// Returns an empty drawing of this size.
pub(super) fn page(size: DVec2) -> Document {
    Document::new().set("viewBox", (0, 0, size.x, size.y)).set("width", size.x).set("height", size.y)
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

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::Plane;

    fn cube() -> Stone {
        let sides = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let plane = |(k, n): (usize, &DVec3)| (format!("side {k}"), Plane::new(*n, 1.0));
        Stone::new(&sides.iter().enumerate().map(plane).collect::<Vec<_>>()).unwrap()
    }

    fn aspect(basis: Basis) -> DrawnAspect {
        DrawnAspect { basis, centre: DVec2::ZERO, scale: 100.0, place: DVec2::new(10.0, 20.0) }
    }

    #[test]
    fn the_sheet_has_its_y_axis_downward() {
        let up = aspect(Basis::FACE_UP);
        assert_eq!(up.at(DVec3::new(0.5, 1.0, 3.0)), DVec2::new(60.0, -80.0));
        assert_eq!(aspect(Basis::FACE_DOWN).at(DVec3::new(0.5, 1.0, 3.0)), DVec2::new(-40.0, -80.0));
        let stone = cube();
        let shown: Vec<_> = stone.polytope.facets().iter().filter(|f| up.shows(f)).collect();
        assert!(shown.len() == 1 && shown[0].plane.normal == DVec3::Z);
    }

    #[test]
    fn every_edge_in_sight_is_drawn_once() {
        let toward = DVec3::new(0.6, -0.48, 0.64);
        let stone = cube();
        let aspect = aspect(Basis::FACE_UP.aimed(toward));
        let mut sheet = Sheet::new(Inks::PAPER);
        sheet.stone(&stone, &aspect, |facet| aspect.shows(facet));
        let svg = sheet.document("cube", "", &[]).to_string();
        let count = |class: &str| {
            let line = svg.lines().find(|line| line.contains(&format!("class=\"{class}\""))).unwrap();
            line.matches('M').count()
        };
        assert_eq!([count("outline"), count("edges"), count("girdle")], [6, 2, 1]);
    }

    #[test]
    fn a_drawing_holds_all_that_is_on_it_within_its_margins() {
        let mut sheet = Sheet::new(Inks::PAPER);
        sheet.stroke(DVec2::new(-900.0, 30.0), DVec2::new(700.0, 40.0));
        let svg = sheet.document("Wide", "", &["a remark".to_owned()]).to_string();
        assert!(svg.contains("width=\"1672\""), "{svg}");
        assert!(svg.contains("translate(936 "), "{svg}");
    }

    #[test]
    fn arrows_stand_outside_where_there_is_no_room_between_them() {
        let arrows = |length: f64| {
            let mut sheet = Sheet::new(Inks::PAPER);
            let inside = sheet.arrows(DVec2::ZERO, DVec2::X * length);
            (inside, sheet.frame.high.x - sheet.frame.low.x)
        };
        assert_eq!(arrows(100.0), (true, 100.0));
        assert_eq!(arrows(10.0), (false, 10.0 + 4.0 * ARROW.x));
        assert!(!arrows(0.0).0);
    }

    #[test]
    fn upright_text_fills_a_box_turned_by_a_right_angle() {
        let mut sheet = Sheet::new(Inks::PAPER);
        sheet.upright_text(DIMENSION, Align::Start, DVec2::ZERO, "crown");
        let size = sheet.frame.high - sheet.frame.low;
        assert!(
            (size.y - text_width("crown", DIMENSION.size)).abs() < 1e-9 && sheet.frame.high.y.abs() < 1e-9
        );
    }
}
