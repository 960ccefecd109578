//! Backgrounds that the program draws itself: square drawings of 2048 units, in black, white and colours. Their edges
//! lie on whole units, so that 2048 pixels show them crisp.

mod page;

use brillianteer_scene::Pattern;
use std::fmt::Write as _;
use svg::Document;
use svg::node::element::{Path, Rectangle};

/// Side of a pattern, in units of its drawing.
pub const PATTERN_SIDE: u32 = 2048;

const INK: &str = "#000000";
const PAPER: &str = "#ffffff";

/// Side of a square, width of a stripe, and distance from line to line and from disc to disc.
const STEP: u32 = 64;

/// Half the height of the slit: so narrow that a prism near it keeps three images of it apart.
const HALF_SLIT: u32 = 5;

/// Draws a pattern.
pub fn pattern_drawing(pattern: Pattern) -> Document {
    let sheet = Document::new().set("viewBox", (0, 0, PATTERN_SIDE, PATTERN_SIDE));
    let all = || 0..PATTERN_SIDE / STEP;
    match pattern {
        Pattern::Page => page::page(sheet),
        Pattern::Grid => {
            let across = all().map(|k| (0, k * STEP + STEP / 2 - 3, PATTERN_SIDE, 6));
            let down = all().map(|k| (k * STEP + STEP / 2 - 3, 0, 6, PATTERN_SIDE));
            let paper = sheet.add(rectangle((0, 0, PATTERN_SIDE, PATTERN_SIDE)).set("fill", PAPER));
            paper.add(rectangles(across).set("fill", "#c01020")).add(rectangles(down).set("fill", "#1030c0"))
        }
        Pattern::Checks => {
            let squares = all().flat_map(|y| (0..PATTERN_SIDE / STEP / 2).map(move |x| (x, y)));
            let place = |(x, y)| ((2 * x + y % 2) * STEP, y * STEP, STEP, STEP);
            sheet.add(rectangles(squares.map(place)).set("fill", INK))
        }
        Pattern::Stripes => {
            let stripes = all().step_by(2).map(|y| (0, y * STEP, PATTERN_SIDE, STEP));
            sheet.add(rectangles(stripes).set("fill", INK))
        }
        Pattern::Dots => {
            let (radius, middle) = (STEP / 4, STEP / 2);
            let mut discs = String::new();
            for (x, y) in all().flat_map(|y| all().map(move |x| (x * STEP, y * STEP + middle))) {
                let (left, across) = (x + middle - radius, 2 * radius);
                // Writing to a string cannot fail.
                let _ = write!(
                    discs,
                    "M{left},{y}a{radius},{radius} 0 1 0 {across},0a{radius},{radius} 0 1 0 -{across},0"
                );
            }
            sheet.add(Path::new().set("d", discs).set("fill", INK))
        }
        Pattern::Slit => {
            let dark = rectangle((0, 0, PATTERN_SIDE, PATTERN_SIDE)).set("fill", INK);
            let slit = (0, PATTERN_SIDE / 2 - HALF_SLIT, PATTERN_SIDE, 2 * HALF_SLIT);
            sheet.add(dark).add(rectangle(slit).set("fill", PAPER))
        }
    }
}

type Corner = (u32, u32, u32, u32);

fn rectangle((x, y, width, height): Corner) -> Rectangle {
    Rectangle::new().set("x", x).set("y", y).set("width", width).set("height", height)
}

/// Returns many rectangles of one colour as one path.
fn rectangles(all: impl Iterator<Item = Corner>) -> Path {
    let mut data = String::new();
    for (x, y, width, height) in all {
        let _ = write!(data, "M{x},{y}h{width}v{height}h-{width}z");
    }
    Path::new().set("d", data)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_short_drawings() {
        for (name, pattern) in Pattern::NAMES {
            assert!(pattern_drawing(pattern).to_string().len() < 1 << 17, "{name}");
        }
    }
}
