//! A stone's profile: the stone seen along the girdle plane, table up, with its dimensions written on it.
//!
//! Lengths are percent of the diameter ([`Outline::diameter`]: that of the girdle, or for a stone that is not round, its
//! width). Angles are degrees from the girdle plane, as laboratories print them.

pub mod brilliant;

pub use super::drawing::{degrees, percent};

use super::drawing::{Align, DIMENSION, DrawnAspect, Inks, ROOM_FOR_ARROWS, Sheet, text_width};
use brillianteer_cut::{FacetZones, Outline, RoundBrilliant, TierZone};
use brillianteer_math::{Basis, Calipers, hull, span};
use brillianteer_scene::Stone;
use glam::{DVec2, DVec3};
use svg::Document;

/// The box that the stone is fitted into, in units of the drawing.
const ROOM: DVec2 = DVec2::new(540.0, 640.0);
/// Distance from the stone to the first dimension line, and from one dimension line to the next.
const LEVEL: f64 = 30.0;
/// Gap between the stone and an extension line, and length by which extension lines exceed a dimension line.
const GAP: f64 = 4.0;
/// Gap between a dimension line and the text beside it.
const BESIDE: f64 = 10.0;
/// The least distance between the middles of two lines of text.
const LINE: f64 = 20.0;

/// Lengths shorter than this part of the width count as zero.
const NOTHING: f64 = 1e-6;
/// The x or y axis counts as the direction of the width if the stone along it is wider than at its narrowest by no
/// more than this factor.
const NEARLY_NARROWEST: f64 = 1.01;

/// Draws a stone from the side and writes its proportions on it.
///
/// With `proportions`, the drawing is that of a round brilliant, which they must describe, and the numbers are those
/// given and derived. Without, or if they are impossible, the numbers are measured on the stone: its table, depth and
/// width, and its crown, girdle and pavilion if it has upright facets.
pub fn profile(stone: &Stone, title: &str, proportions: Option<&RoundBrilliant>) -> Document {
    match proportions.and_then(|given| Some((given, given.derived().ok()?))) {
        Some((given, derived)) => brilliant::draw(stone, title, given, &derived),
        None => measured_profile(stone, title),
    }
}

/// A length along one of the drawing's axes, in radii, and the percentage that is written for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// One end, in radii.
    pub from: f64,
    /// The other end, in radii.
    pub to: f64,
    /// The percentage.
    pub percent: f64,
}

impl Span {
    fn new(from: f64, to: f64, percent: f64) -> Self {
        Self { from, to, percent }
    }

    /// Returns the length, in radii.
    pub fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }
}

/// The dimensions of any stone. Heights run from their upper to their lower end.
#[derive(Debug, Clone, Copy)]
pub struct Dimensions {
    /// The stone's width.
    pub width: Span,
    /// The total depth.
    pub total: Span,
    /// The table; `None` where there is none.
    pub table: Option<Span>,
    /// The crown; `None` where the stone has none, as below.
    pub crown: Option<Span>,
    /// The girdle.
    pub girdle: Option<Span>,
    /// The pavilion.
    pub pavilion: Option<Span>,
    /// The culet, or the point in its place.
    pub culet: Span,
}

impl Dimensions {
    /// Measures the dimensions of any stone, in percent of its diameter. Crown, girdle and pavilion meet at the girdle's edges at
    /// the mains, so that they are those that a design gives, and those of its report.
    pub fn measured(stone: &Stone, basis: &Basis) -> Self {
        let polytope = &stone.polytope;
        let (left, right) = extent(polytope.vertices().iter().copied(), basis.right);
        let (low, high) = extent(polytope.vertices().iter().copied(), DVec3::Z);
        let outline = Outline::of(polytope);
        let diameter = outline.diameter;
        let span = |from: f64, to: f64| Span::new(from, to, 100.0 * (to - from).abs() / diameter);
        let something = |s: &Span| s.percent > 100.0 * NOTHING;
        let zones = FacetZones::of(polytope);
        let corners = |zone: TierZone| {
            let found: Vec<_> = polytope.facets().iter().filter(|f| zones.zone(f) == zone).collect();
            found.into_iter().flat_map(|f| polytope.corners(f)).collect::<Vec<_>>()
        };
        let table = corners(TierZone::Table);
        let has_girdle = polytope.facets().iter().any(|facet| zones.is_girdle(facet));
        let girdle = has_girdle.then_some(outline.girdle_at_mains);
        let table = (!table.is_empty()).then(|| extent(table.into_iter(), basis.right));
        let lowest = polytope.vertices().iter().copied().filter(|v| v.z - low <= NOTHING * diameter);
        let culet = extent(lowest, basis.right);
        Self {
            culet: span(culet.0, culet.1),
            width: span(left, right),
            total: span(high, low),
            table: table.map(|(from, to)| span(from, to)),
            crown: girdle.map(|[_, upper]| span(high, upper)).filter(something),
            girdle: girdle.map(|[lower, upper]| span(upper, lower)),
            pavilion: girdle.map(|[lower, _]| span(lower, low)).filter(something),
        }
    }

    /// Returns the view that fits the stone into the drawing, with the middle of its width and height centred.
    fn aspect(&self, basis: Basis) -> DrawnAspect {
        let scale = (ROOM.x / self.width.length()).min(ROOM.y / self.total.length());
        let middle = |s: &Span| (s.from + s.to) / 2.0;
        let centre = DVec2::new(middle(&self.width), middle(&self.total));
        DrawnAspect { basis, centre, scale, place: DVec2::ZERO }
    }
}

/// Returns the least and the greatest coordinate along a direction.
fn extent(points: impl Iterator<Item = DVec3>, along: DVec3) -> (f64, f64) {
    span(points.map(|p| p.dot(along)))
}

fn measured_profile(stone: &Stone, title: &str) -> Document {
    let basis = across_the_width(stone);
    let dimensions = Dimensions::measured(stone, &basis);
    let (near, far) = extent(stone.polytope.vertices().iter().copied(), basis.toward);
    let mut drawing = Drawing::new(stone, dimensions, basis);
    drawing.table(1.0);
    drawing.heights();
    drawing.width("width", 1.0);
    let mut remarks = vec![format!("Length / width {:.2}", (far - near) / dimensions.width.length())];
    if has_wavy_girdle(stone) {
        remarks.push(
            "Girdle, crown and pavilion: at the mains, where the girdle's edges lie farthest out.".to_owned(),
        );
    }
    let Outline { diameter, width, .. } = Outline::of(&stone.polytope);
    let of = if diameter > width { "diameter" } else { "width" };
    drawing.sheet.document(title, &format!("profile · percent of the {of}, measured on the planes"), &remarks)
}

/// Returns whether the girdle is thicker at the mains than between them.
fn has_wavy_girdle(stone: &Stone) -> bool {
    let outline = Outline::of(&stone.polytope);
    outline.girdle_thickness() - (outline.girdle_top - outline.girdle_bottom) > NOTHING * outline.diameter
}

/// Returns the side view that shows the stone's width: along x or y if the stone is nearly narrowest that way, otherwise
/// along the direction in which it is narrowest as seen from above.
pub fn across_the_width(stone: &Stone) -> Basis {
    let vertices = stone.polytope.vertices();
    let width = |direction: DVec3| {
        let (low, high) = extent(vertices.iter().copied(), direction);
        high - low
    };
    let axis = if width(DVec3::X) <= width(DVec3::Y) { DVec3::X } else { DVec3::Y };
    let outline = hull(vertices.iter().map(|v| v.truncate()).collect());
    let narrowest = Calipers::of_stone(&outline).map_or(axis, |found| found.across.extend(0.0));
    let right = if width(axis) <= NEARLY_NARROWEST * width(narrowest) { axis } else { narrowest };
    Basis { right, up: DVec3::Z, toward: right.cross(DVec3::Z) }
}

/// A sheet with the stone on it, and the dimensions to draw.
struct Drawing<'a> {
    sheet: Sheet,
    stone: &'a Stone,
    aspect: DrawnAspect,
    dimensions: Dimensions,
}

/// The side on which the text of a dimension stands if it has no room between the ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Overflow {
    Left,
    Right,
}

impl<'a> Drawing<'a> {
    fn new(stone: &'a Stone, dimensions: Dimensions, basis: Basis) -> Self {
        let mut sheet = Sheet::new(Inks::PAPER);
        let aspect = dimensions.aspect(basis);
        sheet.stone(stone, &aspect, |facet| aspect.shows(facet));
        Self { sheet, stone, aspect, dimensions }
    }

    /// Returns the place of a point of the profile, in radii, on the sheet.
    fn at(&self, x: f64, z: f64) -> DVec2 {
        self.aspect.on_sheet(DVec2::new(x, z))
    }

    /// Returns the distance that the stone reaches to the right at a height where it has corners.
    fn reach(&self, z: f64) -> f64 {
        let near = |v: &&DVec3| (v.z - z).abs() <= NOTHING * self.dimensions.width.length();
        let corners = self.stone.polytope.vertices().iter().filter(near);
        let (_, right) = extent(corners.copied(), self.aspect.basis.right);
        if right.is_finite() { right } else { self.dimensions.width.to }
    }

    /// Draws a dimension from left to right at sheet height `y`, with an extension line to a point of the stone at
    /// either end.
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

    /// Returns the sheet height of a dimension line; positive levels lie above the stone, negative ones below.
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

    /// Returns the height of the stone's lowest corner at the coordinate of one of its sides.
    fn lowest_at(&self, x: f64) -> f64 {
        let (right, near) = (self.aspect.basis.right, NOTHING * self.dimensions.width.length());
        let corners = self.stone.polytope.vertices().iter().filter(|v| (v.dot(right) - x).abs() <= near);
        let (low, _) = extent(corners.copied(), DVec3::Z);
        if low.is_finite() { low } else { self.dimensions.girdle.map_or(0.0, |g| g.to) }
    }

    /// Draws the heights: crown, girdle and pavilion in one line on the right, and the total depth in another.
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

    /// Draws heights one below the other and returns the right end of their text. Where a height is too short for
    /// arrows, the arrows of its neighbours mark its ends; an end without an arrow gets a dot.
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
        let middles = spread(lines.iter().map(|(a, b)| (a + b) / 2.0).collect(), highest, LINE);
        let mut right = x;
        for ((name, span), y) in parts.iter().zip(middles) {
            let text = format!("{name} {}", percent(span.percent));
            let at = DVec2::new(x + BESIDE, y);
            right = right.max(self.sheet.text(DIMENSION, Align::Start, at, &text).high.x);
        }
        right
    }
}

/// Moves heights, given from the highest down, so that any two are at least `line` apart and none is above `highest`.
pub fn spread(mut heights: Vec<f64>, highest: f64, line: f64) -> Vec<f64> {
    // The girdle in the middle stays in place, as it is the shortest; its neighbours give way.
    let middle = heights.len() / 2;
    for k in (0..middle).rev() {
        heights[k] = heights[k].min(heights[k + 1] - line);
    }
    let mut least = highest;
    for height in &mut heights {
        *height = height.max(least);
        least = *height + line;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::Plane;
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4};

    /// Returns a rectangular stone with slopes of 45 degrees and these half widths, its x axis turned by `turn` radians.
    fn gem(turn: f64, half: DVec2) -> Stone {
        let mut facets = vec![("table".to_owned(), Plane::new(DVec3::Z, 0.2))];
        for (k, reach) in [half.x, half.y, half.x, half.y].into_iter().enumerate() {
            let azimuth = turn + FRAC_PI_2 * k as f64;
            for (name, slope, offset) in [
                ("crown", FRAC_PI_4, reach * FRAC_1_SQRT_2),
                ("girdle", FRAC_PI_2, reach),
                ("pavilion", 3.0 * FRAC_PI_4, (reach + 0.1) * FRAC_1_SQRT_2),
            ] {
                facets.push((format!("{name} {k}"), Plane::from_slope(slope, azimuth, offset)));
            }
        }
        Stone::new(&facets).unwrap()
    }

    fn measured(stone: &Stone) -> Dimensions {
        Dimensions::measured(stone, &across_the_width(stone))
    }

    #[test]
    fn a_stone_of_planes_is_measured_across_its_width_however_it_is_turned() {
        for (turn, half) in [(0.0, [0.7, 1.0]), (0.0, [1.0, 0.7]), (0.5, [0.7, 1.0]), (FRAC_PI_4, [0.7, 0.7])]
        {
            let stone = gem(turn, DVec2::from_array(half));
            let found = measured(&stone);
            let expected = [
                (Some(found.width), 100.0),
                (Some(found.total), 100.0 / 1.4),
                (found.table, 100.0 / 1.4),
                (found.crown, 20.0 / 1.4),
                (found.girdle, 10.0 / 1.4),
                (found.pavilion, 50.0),
            ];
            for (span, percent) in expected {
                let span = span.unwrap();
                assert!((span.percent - percent).abs() < 1e-9, "{turn} {half:?}: {found:?}");
                assert!((span.length() * 100.0 / 1.4 - percent).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_round_stone_of_few_sides_is_measured_by_its_circle() {
        // The width is that of a regular polygon of sixteen sides, 1.9 % less than the circle through its corners.
        let sides = (0..16).map(|k| {
            let plane = Plane::from_slope(FRAC_PI_2, (f64::from(k) + 0.5) * FRAC_PI_4 / 2.0, 1.0);
            (format!("girdle {k}"), plane)
        });
        let ends = [("table", DVec3::Z), ("culet", -DVec3::Z)];
        let ends = ends.map(|(name, normal)| (name.to_owned(), Plane::new(normal, 0.5)));
        let stone = Stone::new(&sides.chain(ends).collect::<Vec<_>>()).unwrap();
        let circle = 2.0 / (std::f64::consts::PI / 16.0).cos();
        let found = measured(&stone);
        assert!((found.total.percent - 100.0 / circle).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn length_to_width_and_the_measures_are_written() {
        let svg = profile(&gem(0.5, DVec2::new(0.7, 1.0)), "Test", None).to_string();
        for text in
            ["Length / width 1.43", "table 71.43 %", "crown 14.29 %", "girdle 7.14 %", "pavilion 50 %"]
        {
            assert!(svg.lines().any(|line| line == text), "{text}");
        }
    }

    #[test]
    fn a_brilliant_of_planes_is_seen_along_its_axes() {
        let given = brillianteer_cut::TOLKOWSKY;
        let stone = Stone::new(&given.facets().unwrap()).unwrap();
        assert_eq!(across_the_width(&stone).right, DVec3::X);
        let (found, derived) = (measured(&stone), given.derived().unwrap());
        let total = found.total.percent;
        assert!((total - derived.total_depth).abs() < 1e-9);
        // The parts of the height are those of `info`, which leave out the tips of the girdle.
        let names: Vec<String> = stone.names().to_vec();
        let report = brillianteer_cut::ProportionReport::of(&stone.polytope, &names);
        let parts = [found.crown, found.girdle, found.pavilion].map(|span| span.unwrap().percent);
        let expected = [report.crown_height, report.girdle_thickness, report.pavilion_depth];
        assert!(
            parts.iter().zip(expected).all(|(part, expected)| (part - expected).abs() < 1e-9),
            "{parts:?}"
        );
        assert!((parts.iter().sum::<f64>() - total).abs() < 1e-9);
        assert!((parts[1] - given.girdle_thickness).abs() < 1e-9, "{parts:?}");
    }

    #[test]
    fn the_view_from_the_side_is_a_right_handed_frame() {
        for turn in [0.0, 0.3, 1.0, 2.0] {
            let basis = across_the_width(&gem(turn, DVec2::new(0.5, 0.9)));
            assert!(basis.right.cross(basis.up).distance(basis.toward) < 1e-12);
        }
    }

    #[test]
    fn texts_stand_clear_of_one_another_and_of_what_is_above() {
        assert_eq!(spread(vec![50.0, 100.0, 200.0], 0.0, 20.0), [50.0, 100.0, 200.0]);
        assert_eq!(spread(vec![95.0, 100.0, 105.0], 0.0, 20.0), [80.0, 100.0, 120.0]);
        assert_eq!(spread(vec![95.0, 100.0, 105.0], 90.0, 20.0), [90.0, 110.0, 130.0]);
        assert_eq!(spread(vec![5.0], 0.0, 20.0), [5.0]);
    }
}
