//! A sheet on which dimensions are laid out. A number stands where it fits without an overlap; where there is no such
//! place, the number and its lines are left out.

use brillianteer_cut::Proportion;
use egui::{Align2, Pos2, Rect, Vec2, pos2, vec2};

/// The proportion that a line or number belongs to, if it belongs to one.
pub type About = Option<&'static Proportion>;

/// Space between the stone and a line that leads to a dimension, and length by which that line goes beyond the dimension, in
/// points.
pub const GAP: f32 = 4.0;
/// Space between a dimension line and text beside it, and between text in a line and the line's ends, in points.
pub const BESIDE: f32 = 6.0;
/// Half the length of the strokes that end a dimension line, in points.
const TICK: f32 = 3.5;
/// Space between lines and a number: before and behind it, and above and below it, in points.
const BEFORE: f32 = 4.0;
const ABOVE: f32 = 1.0;

/// The purpose of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    Dimension,
    /// A line that leads from the stone to a dimension.
    Extension,
}

/// A line of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetLine {
    pub points: Vec<Pos2>,
    /// The purpose of the line.
    pub weight: Weight,
    /// The proportion that the line belongs to, if it belongs to one.
    pub about: About,
}

/// A number on the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    pub text: String,
    /// The box that the text fills.
    pub frame: Rect,
    /// True where the text runs upward, so that it is read from the right.
    pub upright: bool,
    /// The proportion that the number gives, if it gives one.
    pub about: About,
}

/// Lines and numbers, and the places that must stay clear of numbers.
pub struct ProfileSheet<'a> {
    lines: Vec<SheetLine>,
    labels: Vec<Label>,
    room: Rect,
    outline: &'a [Pos2],
    taken: Vec<Rect>,
    measure: &'a dyn Fn(&str) -> Vec2,
}

impl<'a> ProfileSheet<'a> {
    /// Makes an empty sheet around a stone's outline. `measure` returns the size of a text, in points.
    pub fn new(room: Rect, outline: &'a [Pos2], measure: &'a dyn Fn(&str) -> Vec2) -> Self {
        Self { lines: vec![], labels: vec![], room, outline, taken: vec![], measure }
    }

    /// Keeps numbers off a place.
    pub fn keep_clear(&mut self, place: Rect) {
        self.taken.push(place);
    }

    /// Returns the size of a text, in points.
    pub fn size(&self, text: &str) -> Vec2 {
        (self.measure)(text)
    }

    /// Returns the screen x that the stone reaches to the left (`side` -1) or right (1) at a height at which its
    /// outline has corners; elsewhere, that of the whole outline.
    pub fn reach(&self, y: f32, side: f32) -> f32 {
        let near = |p: &&Pos2| (p.y - y).abs() < 0.5;
        let farther = |a: &f32, b: &f32| (a * side).total_cmp(&(b * side));
        let level = self.outline.iter().filter(near).map(|p| p.x).max_by(farther);
        level.or_else(|| self.outline.iter().map(|p| p.x).max_by(farther)).unwrap_or(self.room.center().x)
    }

    /// Writes a text if there is room for it, and returns its box.
    pub fn write(&mut self, text: &str, anchor: Align2, at: Pos2, about: About) -> Option<Rect> {
        let frame = anchor.anchor_size(at, self.size(text));
        self.put(text, frame, false, about)
    }

    /// Writes a text that is read from the right, centred at a point, if there is room for it, and returns its box.
    pub fn write_upright(&mut self, text: &str, at: Pos2, about: About) -> Option<Rect> {
        let size = self.size(text);
        self.put(text, Rect::from_center_size(at, vec2(size.y, size.x)), true, about)
    }

    fn put(&mut self, text: &str, frame: Rect, upright: bool, about: About) -> Option<Rect> {
        let free = self.room.contains_rect(frame)
            && !self.taken.iter().any(|taken| taken.intersects(frame))
            && !overlap(self.outline, frame);
        free.then(|| {
            self.taken.push(frame);
            self.labels.push(Label { text: text.to_owned(), frame, upright, about });
            frame
        })
    }

    /// Adds a line.
    pub fn line(&mut self, points: Vec<Pos2>, weight: Weight, about: About) {
        self.lines.push(SheetLine { points, weight, about });
    }

    /// Adds a dimension line with strokes at its ends.
    pub fn dimension(&mut self, [a, b]: [Pos2; 2], about: About) {
        let across = (b - a).normalized().rot90() * TICK;
        for end in [a, b] {
            self.line(vec![end - across, end + across], Weight::Dimension, about);
        }
        self.line(vec![a, b], Weight::Dimension, about);
    }

    /// Adds a dimension from left to right at height `y`, which leads to a point of the stone at either end. Its text stands
    /// in the line, or beside it where the line is too short. Where the text fits nowhere, the dimension is left out.
    pub fn across(&mut self, y: f32, ends: [Pos2; 2], text: &str, about: About) {
        let [a, b] = ends.map(|end| pos2(end.x, y));
        let fits = self.size(text).x + 2.0 * (GAP + BESIDE) < b.x - a.x;
        let inside = fits.then(|| self.write(text, Align2::CENTER_CENTER, a.lerp(b, 0.5), about)).flatten();
        let placed = inside
            .or_else(|| self.write(text, Align2::RIGHT_CENTER, a - vec2(BESIDE, 0.0), about))
            .or_else(|| self.write(text, Align2::LEFT_CENTER, b + vec2(BESIDE, 0.0), about));
        if placed.is_none() {
            return;
        }
        for end in ends {
            let side = (y - end.y).signum();
            let points = vec![end + vec2(0.0, GAP * side), pos2(end.x, y + GAP * side)];
            self.line(points, Weight::Extension, about);
        }
        self.dimension([a, b], about);
    }

    /// Returns all lines, broken where they would run through a number, and all numbers.
    pub fn finish(self) -> (Vec<SheetLine>, Vec<Label>) {
        let mut lines = vec![];
        for line in self.lines {
            let SheetLine { points, weight, about } = line;
            match points[..] {
                [a, b] => lines.extend(broken([a, b], &self.labels).into_iter().map(|ends| SheetLine {
                    points: ends.to_vec(),
                    weight,
                    about,
                })),
                _ => lines.push(SheetLine { points, weight, about }),
            }
        }
        (lines, self.labels)
    }
}

/// Returns the parts of a line that keep clear of all numbers.
fn broken(line: [Pos2; 2], labels: &[Label]) -> Vec<[Pos2; 2]> {
    labels.iter().fold(vec![line], |parts, label| {
        let room = if label.upright { vec2(ABOVE, BEFORE) } else { vec2(BEFORE, ABOVE) };
        parts.into_iter().flat_map(|part| beside(part, label.frame.expand2(room))).collect()
    })
}

/// Returns the parts of a line before and behind a box.
fn beside([a, b]: [Pos2; 2], frame: Rect) -> Vec<[Pos2; 2]> {
    let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
    for axis in 0..2 {
        let (from, way) = (a[axis], b[axis] - a[axis]);
        let sides = [frame.min[axis], frame.max[axis]];
        if way == 0.0 {
            if from <= sides[0] || from >= sides[1] {
                return vec![[a, b]];
            }
            continue;
        }
        let [near, far] = sides.map(|side| (side - from) / way);
        (enter, leave) = (enter.max(near.min(far)), leave.min(near.max(far)));
    }
    if enter >= leave {
        return vec![[a, b]];
    }
    let parts = [(0.0, enter), (leave, 1.0)].into_iter().filter(|(from, to)| from < to);
    parts.map(|(from, to)| [a.lerp(b, from), a.lerp(b, to)]).collect()
}

/// Returns whether a convex outline and a box overlap.
fn overlap(outline: &[Pos2], frame: Rect) -> bool {
    let corners = [frame.left_top(), frame.right_top(), frame.left_bottom(), frame.right_bottom()];
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    // The sign of `side` at the outline's own middle tells which side of an edge is inside.
    let middle = outline.iter().fold(Vec2::ZERO, |sum, p| sum + p.to_vec2()) / outline.len().max(1) as f32;
    let parts = |(&a, &b): (&Pos2, &Pos2)| {
        let side = |p: Pos2| (b - a).rot90().dot(p - a);
        let inward = side(middle.to_pos2()).signum();
        corners.iter().all(|&corner| side(corner) * inward < 0.0)
    };
    let bounds = Rect::from_points(outline);
    bounds.intersects(frame) && !edges.into_iter().any(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Rect = Rect { min: Pos2::ZERO, max: pos2(400.0, 300.0) };

    fn measure(text: &str) -> Vec2 {
        vec2(6.0 * text.chars().count() as f32, 12.0)
    }

    fn stone() -> Vec<Pos2> {
        vec![pos2(100.0, 100.0), pos2(300.0, 100.0), pos2(200.0, 200.0)]
    }

    #[test]
    fn a_text_stands_only_where_nothing_else_is() {
        let outline = stone();
        let mut sheet = ProfileSheet::new(ROOM, &outline, &measure);
        let mut at = |x: f32, y: f32| sheet.write("five5", Align2::CENTER_CENTER, pos2(x, y), None).is_some();
        assert!(!at(10.0, 50.0) && !at(200.0, 150.0) && !at(140.0, 110.0));
        assert!(at(120.0, 170.0) && !at(130.0, 175.0) && at(120.0, 183.0));
    }

    #[test]
    fn a_dimension_without_room_for_its_number_is_left_out() {
        let outline = stone();
        let mut sheet = ProfileSheet::new(ROOM, &outline, &measure);
        let ends = [pos2(100.0, 100.0), pos2(300.0, 100.0)];
        sheet.across(80.0, ends, "table 56 %", None);
        assert_eq!((sheet.labels.len(), sheet.labels[0].frame.center()), (1, pos2(200.0, 80.0)));
        let lines = sheet.lines.len();
        sheet.across(82.0, ends, &"x".repeat(70), None);
        assert_eq!((sheet.labels.len(), sheet.lines.len()), (1, lines));
    }

    #[test]
    fn lines_break_where_they_would_run_through_a_number() {
        let outline = stone();
        let mut sheet = ProfileSheet::new(ROOM, &outline, &measure);
        sheet.across(80.0, [pos2(100.0, 100.0), pos2(300.0, 100.0)], "table 56 %", None);
        sheet.line(vec![pos2(200.0, 40.0), pos2(200.0, 95.0)], Weight::Extension, None);
        sheet.line(vec![pos2(50.0, 90.0), pos2(350.0, 92.0)], Weight::Extension, None);
        let (lines, labels) = sheet.finish();
        let frame = labels[0].frame;
        let through = |ends: &[Pos2]| ends.iter().all(|p| p.x == 200.0);
        let pieces: Vec<_> = lines.iter().filter(|l| through(&l.points)).map(|l| &l.points).collect();
        let expected = [(40.0, frame.min.y - ABOVE), (frame.max.y + ABOVE, 95.0)];
        for (piece, (from, to)) in pieces.iter().zip(expected) {
            assert!((piece[0].y - from).abs() < 1e-3 && (piece[1].y - to).abs() < 1e-3, "{piece:?}");
        }
        let level = lines.iter().filter(|l| l.points.iter().all(|p| p.y == 80.0)).count();
        assert_eq!((pieces.len(), level), (2, 2));
        assert!(lines.iter().any(|l| l.points == [pos2(50.0, 90.0), pos2(350.0, 92.0)]));
    }

    #[test]
    fn a_number_too_wide_for_its_line_stands_beside_it() {
        let outline = stone();
        let mut sheet = ProfileSheet::new(ROOM, &outline, &measure);
        sheet.across(80.0, [pos2(190.0, 100.0), pos2(240.0, 100.0)], "culet 12.5 %", None);
        sheet.across(60.0, [pos2(50.0, 100.0), pos2(70.0, 100.0)], "culet 12.5 %", None);
        let found: Vec<_> = sheet.labels.iter().map(|l| (l.frame.min.x, l.frame.max.x)).collect();
        assert_eq!(found, [(112.0, 184.0), (76.0, 148.0)]);
    }
}
