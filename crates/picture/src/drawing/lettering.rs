//! The lettering of drawings: type, the width of text, and the notation of numbers.

use super::inks::Ink;
use glam::DVec2;

/// A size and a colour of text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Type {
    /// Height of the type, in units of the drawing.
    pub size: f64,
    /// Colour of the type.
    pub colour: Ink,
}

/// Type of the drawing's title.
pub(crate) const TITLE: Type = Type { size: 24.0, colour: Ink::Main };
/// Type of dimensions.
pub(crate) const DIMENSION: Type = Type { size: 15.0, colour: Ink::Accent };
/// Type of remarks.
pub(crate) const REMARK: Type = Type { size: 13.0, colour: Ink::Quiet };

/// The part of a text that stands at the given point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Align {
    Start,
    Middle,
    End,
}

/// A box with sides along the axes, as its least and greatest corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    pub low: DVec2,
    pub high: DVec2,
}

impl Frame {
    pub const EMPTY: Self = Self { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY };

    /// Grows the box so that it includes a point.
    pub fn include(&mut self, p: DVec2) {
        (self.low, self.high) = (self.low.min(p), self.high.max(p));
    }
}

/// Distance from a text's base line to the middle of its figures, in type sizes.
pub(super) const MIDDLE_OF_FIGURES: f64 = 0.35;

/// Returns the width of a line of text, from the font's own advances. Characters beyond ASCII count as wide as the
/// widest, except for a few known ones.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
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

/// Returns the text, with its end replaced by an ellipsis where it is wider than `room`.
pub(crate) fn shortened(text: &str, size: f64, room: f64) -> String {
    let mut kept = text.to_owned();
    let mut shown = kept.clone();
    while !kept.is_empty() && text_width(&shown, size) > room {
        kept.pop();
        shown = format!("{}…", kept.trim_end());
    }
    shown
}

/// Writes a number to two decimals, without trailing zeros.
pub(crate) fn rounded(value: f64) -> String {
    format!("{}", (value * 100.0).round() / 100.0 + 0.0)
}

/// Writes a percentage, such as "53 %".
pub fn percent(value: f64) -> String {
    format!("{} %", rounded(value))
}

/// Writes an angle in degrees, such as "34.5°".
pub fn degrees(value: f64) -> String {
    format!("{}°", rounded(value))
}

/// Replaces characters that XML cannot hold by the replacement character.
pub(crate) fn printable(text: &str) -> String {
    let replaced =
        |c: char| if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') { '\u{fffd}' } else { c };
    text.chars().map(replaced).collect()
}

/// Returns the box that a line of text fills.
pub(crate) fn text_frame(size: f64, align: Align, at: DVec2, content: &str) -> Frame {
    let width = text_width(content, size);
    let left = match align {
        Align::Start => 0.0,
        Align::Middle => width / 2.0,
        Align::End => width,
    };
    let low = at - DVec2::new(left, 0.62 * size);
    Frame { low, high: low + DVec2::new(width, 1.2 * size) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use resvg::usvg::{Node, Options, Tree, fontdb};

    /// Returns the width that the font itself gives a text at a size of 100.
    fn set_width(text: &str) -> f64 {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
        let options = Options { fontdb: std::sync::Arc::new(fonts), ..Options::default() };
        let svg = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1 1'>\
             <text font-family='Ubuntu' font-size='100' font-kerning='none'>{text}</text></svg>"
        );
        let tree = Tree::from_str(&svg, &options).unwrap();
        let Some(Node::Text(text)) = tree.root().children().first() else { panic!("no text in {svg}") };
        f64::from(text.bounding_box().width())
    }

    #[test]
    fn widths_are_those_of_the_font() {
        for text in ["0123456789", "Length / width 1.43", "40.75°", "a · b – c", "ABCXYZ", "[(~@#%)]"] {
            let (set, expected) = (set_width(text), text_width(text, 100.0));
            assert!((set - expected).abs() < 0.02 * set, "{text}: {set}, not {expected}");
        }
    }

    #[test]
    fn a_text_is_shortened_to_its_room_and_no_further() {
        assert_eq!(shortened("star", 10.0, 100.0), "star");
        let long = shortened("a name that goes on and on", 10.0, 60.0);
        assert!(long.ends_with('…') && text_width(&long, 10.0) <= 60.0 && long.len() > 6, "{long}");
        assert_eq!(shortened("WWW", 10.0, 0.0), "…");
        assert_eq!(shortened("", 10.0, 0.0), "");
    }

    #[test]
    fn numbers_have_two_decimals_at_most_and_no_negative_zero() {
        let cases = [(40.75, "40.75"), (3.0, "3"), (16.1511, "16.15"), (76.9, "76.9"), (-0.001, "0")];
        for (value, text) in cases {
            assert_eq!(rounded(value), text);
        }
        assert_eq!(percent(53.0), "53 %");
        assert_eq!(degrees(34.5), "34.5°");
    }

    #[test]
    fn what_xml_cannot_hold_is_replaced() {
        assert_eq!(printable("a\u{0}b\n°\u{ffff}"), "a\u{fffd}b\u{fffd}°\u{fffd}");
    }
}
