//! A stone's profile: seen along the girdle plane, table up, with its dimensions written on it.
//!
//! Lengths are percent of the girdle diameter (of the width, for a stone given by its planes), angles degrees from
//! the girdle plane, as laboratories print them. Star and lower half are measured in plan, at 22.5 degrees from the
//! drawing's plane, where the projection shortens the part and the whole alike.

use super::drawing::{
    Align, Aspect, DIMENSION, ROOM_FOR_ARROWS, Sheet, degrees, percent, rounded, text_width,
};
use crate::cut::{Derived, RoundBrilliant};
use crate::math::{Basis, Facet};
use crate::scene::Stone;
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_8;
use svg::Document;

/// The box that the stone is fitted into, units of the drawing.
const ROOM: DVec2 = DVec2::new(540.0, 640.0);
/// From the stone to the first dimension line, and from one to the next.
const LEVEL: f64 = 30.0;
/// Between the stone and an extension line, and from a dimension line to the end of its extension lines.
const GAP: f64 = 4.0;
/// Between dimension lines and text beside them.
const BESIDE: f64 = 10.0;
/// Least distance between the middles of two lines of text.
const LINE: f64 = 20.0;

/// Facets this close to upright (sine of the angle) make up the girdle, and to level the table.
const UPRIGHT: f64 = 1e-6;
/// Lengths shorter than this part of the width are none at all.
const NOTHING: f64 = 1e-6;
/// An axis is taken for the direction of the width if the stone is that little wider along it than at its narrowest.
const NEARLY_NARROWEST: f64 = 1.01;

/// Draws a stone from the side and writes its proportions on it.
///
/// With `proportions` the drawing is that of a round brilliant, which they must describe; the numbers written are
/// those given and derived. Without, what can be measured on the stone is written: its table, depth and width, and
/// crown, girdle and pavilion if it has upright facets. So it is too if the proportions are impossible.
pub fn profile(stone: &Stone, title: &str, proportions: Option<&RoundBrilliant>) -> Document {
    match proportions.and_then(|given| Some((given, given.derived().ok()?))) {
        Some((given, derived)) => brilliant_profile(stone, title, given, &derived),
        None => measured_profile(stone, title),
    }
}

/// A length along one of the drawing's axes, in radii, and what is written of it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Span {
    from: f64,
    to: f64,
    percent: f64,
}

impl Span {
    fn new(from: f64, to: f64, percent: f64) -> Self {
        Self { from, to, percent }
    }

    fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }
}

/// What every stone has; heights go from their upper to their lower end.
#[derive(Debug, Clone, Copy)]
struct Dimensions {
    width: Span,
    total: Span,
    table: Option<Span>,
    crown: Option<Span>,
    girdle: Option<Span>,
    pavilion: Option<Span>,
}

impl Dimensions {
    fn of_brilliant(given: &RoundBrilliant, derived: &Derived) -> Self {
        let (crown, girdle) = (derived.crown_height / 50.0, given.girdle_thickness / 50.0);
        let culet = crown - derived.total_depth / 50.0;
        let table = given.table / 100.0;
        Self {
            width: Span::new(-1.0, 1.0, 100.0),
            total: Span::new(crown, culet, derived.total_depth),
            table: Some(Span::new(-table, table, given.table)),
            crown: Some(Span::new(crown, 0.0, derived.crown_height)),
            girdle: Some(Span::new(0.0, -girdle, given.girdle_thickness)),
            pavilion: Some(Span::new(-girdle, culet, derived.pavilion_depth)),
        }
    }

    fn measured(stone: &Stone, basis: &Basis) -> Self {
        let polytope = &stone.polytope;
        let (left, right) = extent(polytope.vertices().iter().copied(), basis.right);
        let (low, high) = extent(polytope.vertices().iter().copied(), DVec3::Z);
        let span = |from: f64, to: f64| Span::new(from, to, 100.0 * (to - from).abs() / (right - left));
        let something = |s: &Span| s.percent > 100.0 * NOTHING;
        let corners = |is: fn(&Facet) -> bool| {
            let found: Vec<_> = polytope.facets().iter().filter(|f| is(f)).collect();
            found.into_iter().flat_map(|f| polytope.corners(f)).collect::<Vec<_>>()
        };
        let table = corners(|f| f.plane.normal.truncate().length() < UPRIGHT && f.plane.normal.z > 0.0);
        let upright = corners(|f| f.plane.normal.z.abs() < UPRIGHT);
        let girdle = (!upright.is_empty()).then(|| extent(upright.into_iter(), DVec3::Z));
        let table = (!table.is_empty()).then(|| extent(table.into_iter(), basis.right));
        Self {
            width: span(left, right),
            total: span(high, low),
            table: table.map(|(from, to)| span(from, to)),
            crown: girdle.map(|(_, upper)| span(high, upper)).filter(something),
            girdle: girdle.map(|(lower, upper)| span(upper, lower)),
            pavilion: girdle.map(|(lower, _)| span(lower, low)).filter(something),
        }
    }

    /// The view that fits the stone into the drawing, its girdle diameter centred.
    fn aspect(&self, basis: Basis) -> Aspect {
        let scale = (ROOM.x / self.width.length()).min(ROOM.y / self.total.length());
        let middle = |s: &Span| (s.from + s.to) / 2.0;
        let centre = DVec2::new(middle(&self.width), middle(&self.total));
        Aspect { basis, centre, scale, place: DVec2::ZERO }
    }
}

/// Least and greatest coordinate along a direction.
fn extent(points: impl Iterator<Item = DVec3>, along: DVec3) -> (f64, f64) {
    points.map(|p| p.dot(along)).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
}

/// The bezels at azimuth 0 and 180 degrees edge on, so that crown and pavilion angle are seen in their true size.
const BRILLIANT_BASIS: Basis = Basis { right: DVec3::X, up: DVec3::Z, toward: DVec3::NEG_Y };

fn brilliant_profile(stone: &Stone, title: &str, given: &RoundBrilliant, derived: &Derived) -> Document {
    let dimensions = Dimensions::of_brilliant(given, derived);
    let mut drawing = Drawing::new(stone, dimensions, BRILLIANT_BASIS);
    drawing.star(given, derived);
    drawing.table(2.0);
    drawing.heights();
    drawing.angles(given, derived);
    drawing.culet(given);
    drawing.lower_half(given, derived);
    drawing.width("girdle diameter", 3.0);
    let angles = [
        ("Star", derived.star_angle),
        ("upper half", derived.upper_half_angle),
        ("lower half", derived.lower_half_angle),
    ];
    let angles = angles.map(|(name, angle)| format!("{name} {}", degrees(angle))).join(" · ");
    let remarks = [
        format!("{angles} · lower half, seen from the side, {}", percent(derived.lower_half_length_vertical)),
        "Star and lower half in plan: of the way from the table's edge to the girdle, and from the girdle to the \
         centre."
            .to_owned(),
    ];
    let subtitle = "profile · percent of the girdle diameter, degrees from the girdle plane";
    drawing.sheet.document(title, subtitle, &remarks)
}

fn measured_profile(stone: &Stone, title: &str) -> Document {
    let basis = across_the_width(stone);
    let dimensions = Dimensions::measured(stone, &basis);
    let (near, far) = extent(stone.polytope.vertices().iter().copied(), basis.toward);
    let mut drawing = Drawing::new(stone, dimensions, basis);
    drawing.table(1.0);
    drawing.heights();
    drawing.width("width", 1.0);
    let remarks = [format!("Length / width {}", rounded((far - near) / dimensions.width.length()))];
    drawing.sheet.document(title, "profile · percent of the width, measured on the planes", &remarks)
}

/// The side view that shows the stone's width: along x or y where it is next to narrowest that way, else wherever it
/// is narrowest seen from above, which is square to one of the outline's edges.
fn across_the_width(stone: &Stone) -> Basis {
    let vertices = stone.polytope.vertices();
    let width = |direction: DVec3| {
        let (low, high) = extent(vertices.iter().copied(), direction);
        high - low
    };
    let axis = if width(DVec3::X) <= width(DVec3::Y) { DVec3::X } else { DVec3::Y };
    let outline = hull(vertices.iter().map(|v| v.truncate()).collect());
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    let across = edges.filter_map(|(&a, &b)| Some((b - a).perp().try_normalize()?.extend(0.0)));
    let narrowest = across.min_by(|&a, &b| width(a).total_cmp(&width(b))).unwrap_or(axis);
    let right = if width(axis) <= NEARLY_NARROWEST * width(narrowest) { axis } else { narrowest };
    Basis { right, up: DVec3::Z, toward: right.cross(DVec3::Z) }
}

/// The convex hull of some points, counter-clockwise (Andrew's monotone chain).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = vec![];
        for p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter().copied());
    lower.extend(half(&mut points.iter().rev().copied()));
    lower
}

/// A sheet with the stone on it, and what its dimensions are measured between.
struct Drawing<'a> {
    sheet: Sheet,
    stone: &'a Stone,
    aspect: Aspect,
    dimensions: Dimensions,
}

/// Where the text of a dimension goes that has no room between its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Overflow {
    Left,
    Right,
}

impl<'a> Drawing<'a> {
    fn new(stone: &'a Stone, dimensions: Dimensions, basis: Basis) -> Self {
        let mut sheet = Sheet::new();
        let aspect = dimensions.aspect(basis);
        sheet.stone(stone, &aspect, |facet| aspect.shows(facet));
        Self { sheet, stone, aspect, dimensions }
    }

    /// A point of the profile, in radii, on the sheet.
    fn at(&self, x: f64, z: f64) -> DVec2 {
        self.aspect.on_sheet(DVec2::new(x, z))
    }

    /// How far the stone reaches to the right at a height where it has corners.
    fn reach(&self, z: f64) -> f64 {
        let near = |v: &&DVec3| (v.z - z).abs() <= NOTHING * self.dimensions.width.length();
        let corners = self.stone.polytope.vertices().iter().filter(near);
        let (_, right) = extent(corners.copied(), self.aspect.basis.right);
        if right.is_finite() { right } else { self.dimensions.width.to }
    }

    /// A dimension from left to right at sheet height `y`, leading to a point of the stone at either end.
    fn across(&mut self, y: f64, ends: [DVec2; 2], overflow: Overflow, text: &str) {
        for end in ends {
            let side = (y - end.y).signum();
            self.sheet.extension(end + DVec2::Y * GAP * side, DVec2::new(end.x, y + GAP * side));
        }
        let [a, b] = ends.map(|end| DVec2::new(end.x, y));
        let inside = self.sheet.arrows(a, b);
        let outside = DVec2::X * if inside { BESIDE } else { 2.5 * BESIDE };
        let (align, at) = match overflow {
            _ if text_width(text, DIMENSION.size) + 2.0 * ROOM_FOR_ARROWS < b.x - a.x => {
                (Align::Middle, (a + b) / 2.0)
            }
            Overflow::Left => (Align::End, a - outside),
            Overflow::Right => (Align::Start, b + outside),
        };
        let frame = self.sheet.text(DIMENSION, align, at, text);
        if align == Align::Middle {
            self.sheet.clear(frame);
        }
    }

    /// The sheet height of a dimension line over or, negative, under the stone.
    fn level(&self, level: f64) -> f64 {
        let edge = if level > 0.0 { self.dimensions.total.from } else { self.dimensions.total.to };
        self.at(0.0, edge).y - level * LEVEL
    }

    fn table(&mut self, level: f64) {
        let Some(table) = self.dimensions.table else { return };
        let ends = [table.from, table.to].map(|x| self.at(x, self.dimensions.total.from));
        self.across(self.level(level), ends, Overflow::Left, &format!("table {}", percent(table.percent)));
    }

    fn width(&mut self, name: &str, level: f64) {
        let width = self.dimensions.width;
        let ends = [width.from, width.to].map(|x| self.at(x, self.lowest_at(x)));
        self.across(self.level(-level), ends, Overflow::Left, &format!("{name} {}", percent(width.percent)));
    }

    /// The height of the stone's lowest corner at one of its sides.
    fn lowest_at(&self, x: f64) -> f64 {
        let (right, near) = (self.aspect.basis.right, NOTHING * self.dimensions.width.length());
        let corners = self.stone.polytope.vertices().iter().filter(|v| (v.dot(right) - x).abs() <= near);
        let (low, _) = extent(corners.copied(), DVec3::Z);
        if low.is_finite() { low } else { self.dimensions.girdle.map_or(0.0, |g| g.to) }
    }

    /// Crown, girdle and pavilion in one line on the right, the total depth in another.
    fn heights(&mut self) {
        let Dimensions { total, crown, girdle, pavilion, .. } = self.dimensions;
        let parts = [("crown", crown), ("girdle", girdle), ("pavilion", pavilion)];
        let parts: Vec<_> = parts.into_iter().filter_map(|(name, span)| Some((name, span?))).collect();
        let mut x = self.at(self.dimensions.width.to, 0.0).x + LEVEL;
        let mut heights = vec![total.from, total.to];
        if parts.iter().any(|(_, span)| span.length() < total.length()) {
            heights.extend(parts.iter().flat_map(|(_, span)| [span.from, span.to]));
            self.extend_right(&heights[2..], x);
            x = self.chain(x, &parts) + LEVEL;
        }
        self.extend_right(&heights[..2], x);
        let [a, b] = [total.from, total.to].map(|z| DVec2::new(x, self.at(0.0, z).y));
        self.sheet.arrows(a, b);
        let text = format!("total depth {}", percent(total.percent));
        self.sheet.text(DIMENSION, Align::Start, (a + b) / 2.0 + DVec2::X * BESIDE, &text);
    }

    fn extend_right(&mut self, heights: &[f64], x: f64) {
        for (_, &z) in heights.iter().enumerate().filter(|&(k, z)| !heights[..k].contains(z)) {
            let start = self.at(self.reach(z), z) + DVec2::X * GAP;
            self.sheet.extension(start, DVec2::new(x + GAP, start.y));
        }
    }

    /// Heights one under the other, and where their text ends. Where one is too short for arrows those of its
    /// neighbours stand for its own; a dot marks an end that has none.
    fn chain(&mut self, x: f64, parts: &[(&str, Span)]) -> f64 {
        let y = |z: f64| self.at(0.0, z).y;
        let lines: Vec<(f64, f64)> = parts.iter().map(|(_, span)| (y(span.from), y(span.to))).collect();
        let long = |&(a, b): &(f64, f64)| b - a >= ROOM_FOR_ARROWS;
        for line in &lines {
            let [a, b] = [line.0, line.1].map(|y| DVec2::new(x, y));
            if long(line) {
                self.sheet.arrows(a, b);
            } else {
                self.sheet.stroke(a, b);
                for end in [a, b] {
                    let marked =
                        lines.iter().any(|other| long(other) && (other.0 == end.y || other.1 == end.y));
                    if !marked {
                        self.sheet.dot(end);
                    }
                }
            }
        }
        let highest = self.level(1.0) + LINE;
        let middles = spread(lines.iter().map(|(a, b)| (a + b) / 2.0).collect(), highest);
        let mut right = x;
        for ((name, span), y) in parts.iter().zip(middles) {
            let text = format!("{name} {}", percent(span.percent));
            let at = DVec2::new(x + BESIDE, y);
            right = right.max(self.sheet.text(DIMENSION, Align::Start, at, &text).high.x);
        }
        right
    }
}

/// Moves heights, given from the highest down, so that no two lines of text at them touch and none is above `highest`.
fn spread(mut heights: Vec<f64>, highest: f64) -> Vec<f64> {
    // The girdle's is held where it is, as it is the shortest; its neighbours give way.
    let middle = heights.len() / 2;
    for k in (0..middle).rev() {
        heights[k] = heights[k].min(heights[k + 1] - LINE);
    }
    let mut least = highest;
    for height in &mut heights {
        *height = height.max(least);
        least = *height + LINE;
    }
    heights
}

/// What only a round brilliant has.
impl Drawing<'_> {
    /// The star's length in plan, over the right half of the crown.
    fn star(&mut self, given: &RoundBrilliant, derived: &Derived) {
        let cos = FRAC_PI_8.cos();
        let edge = given.table / 100.0 * cos;
        let tip = edge + given.star_length / 100.0 * (1.0 - edge);
        let tip_height = derived.crown_angle.to_radians().tan() * (1.0 - tip * cos);
        let ends = [self.at(edge * cos, self.dimensions.total.from), self.at(tip * cos, tip_height)];
        let text = format!("star {}", percent(given.star_length));
        self.across(self.level(1.0), ends, Overflow::Right, &text);
    }

    /// The lower half's length in plan, under the right half of the pavilion.
    fn lower_half(&mut self, given: &RoundBrilliant, derived: &Derived) {
        let cos = FRAC_PI_8.cos();
        let tip = (1.0 - derived.lower_half_length / 100.0) * cos;
        let girdle = -given.girdle_thickness / 50.0;
        let tip_height = girdle - derived.pavilion_angle.to_radians().tan() * (1.0 - tip * cos);
        let ends = [self.at(tip, tip_height.max(self.dimensions.total.to)), self.at(cos, girdle)];
        let text = format!("lower half {}", percent(derived.lower_half_length));
        self.across(self.level(-2.0), ends, Overflow::Left, &text);
    }

    fn culet(&mut self, given: &RoundBrilliant) {
        let bottom = self.dimensions.total.to;
        let text = format!("culet {}", percent(given.culet));
        let y = self.level(-1.0);
        let culet = given.culet / 100.0;
        if culet * self.aspect.scale > 1.0 {
            let ends = [-culet, culet].map(|x| self.at(x, bottom));
            return self.across(y, ends, Overflow::Left, &text);
        }
        let tip = self.at(0.0, bottom) + DVec2::Y * GAP;
        let knee = DVec2::new(tip.x - BESIDE, y);
        self.sheet.stroke(knee, tip);
        if let Some(toward) = (tip - knee).try_normalize() {
            self.sheet.arrow_head(tip, toward);
        }
        self.sheet.text(DIMENSION, Align::End, knee - DVec2::X * GAP, &text);
    }

    /// Crown angle at the table's corner, pavilion angle at the culet, both outside the stone on the left.
    fn angles(&mut self, given: &RoundBrilliant, derived: &Derived) {
        let girdle = -given.girdle_thickness / 50.0;
        let table = self.at(-given.table / 100.0, self.dimensions.total.from);
        self.angle(table, self.at(-1.0, 0.0), derived.crown_angle);
        let culet = self.at(-given.culet / 100.0, self.dimensions.total.to);
        self.angle(culet, self.at(-1.0, girdle), derived.pavilion_angle);
    }

    /// The angle at `vertex` between the level line to the left and the line to `end`.
    fn angle(&mut self, vertex: DVec2, end: DVec2, angle: f64) {
        let radius = if angle < 20.0 { 110.0 } else { 64.0 };
        let down = (end.y - vertex.y).signum();
        let arm = DVec2::new(-angle.to_radians().cos(), down * angle.to_radians().sin());
        self.sheet.extension(vertex - DVec2::X * GAP, vertex - DVec2::X * (radius + 2.0 * GAP));
        if (end - vertex).length() < radius + GAP {
            self.sheet.extension(end + arm * GAP, vertex + arm * (radius + 2.0 * GAP));
        }
        self.sheet.arc(vertex, vertex - DVec2::X * radius, vertex + arm * radius);
        let half = (angle / 2.0).to_radians();
        let text_at = if angle < 11.0 {
            // Too narrow for text between the lines.
            vertex + DVec2::new(-radius - 2.0 * GAP, -down * LINE / 2.0)
        } else {
            vertex + DVec2::new(-half.cos(), down * half.sin()) * (radius + BESIDE)
        };
        self.sheet.text(DIMENSION, Align::End, text_at, &degrees(angle));
    }
}
