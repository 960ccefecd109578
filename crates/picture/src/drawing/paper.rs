//! Drawings on paper of a given size: nothing is shifted or scaled to fit, and headings are set in heavier letters.

use super::lettering::{Align, Frame, Type, printable, text_frame};
use super::{Ink, Sheet};
use glam::DVec2;
use svg::node::Blob;
use svg::node::element::{Group, Rectangle, Title};
use svg::{Document, Node};

/// Width of the line round the letters that makes them heavier, in type sizes.
const HEAVIER: f64 = 0.035;

impl Sheet {
    /// Writes one line of text in heavier letters, its middle height at `at`. Returns the box that it fills.
    pub fn strong_text(&mut self, kind: Type, align: Align, at: DVec2, content: &str) -> Frame {
        let frame = text_frame(kind.size, align, at, content);
        let (colour, width) = (self.inks.of(kind.colour), HEAVIER * kind.size);
        self.put(kind, align, at, content, frame, |text| {
            text.set("stroke", colour).set("stroke-width", width)
        })
    }

    /// Puts the element of another drawing under this one, where it fills a box.
    pub fn embed(&mut self, element: &str, frame: Frame) {
        [frame.low, frame.high].into_iter().for_each(|p| self.frame.include(p));
        self.embedded.append(Blob::new(element));
    }

    /// Returns the drawing as a page of `size` units, which is `size_mm` in print. Everything stays where it was drawn.
    pub fn page(self, title: &str, size: DVec2, size_mm: DVec2) -> Document {
        let paper = self.inks.of(Ink::Paper);
        let all = [self.embedded, self.stone, self.extensions, self.dimensions, self.texts];
        Document::new()
            .set("viewBox", (0, 0, size.x, size.y))
            .set("width", format!("{}mm", size_mm.x))
            .set("height", format!("{}mm", size_mm.y))
            .add(Title::new(printable(title)))
            .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", paper))
            .add(all.into_iter().fold(Group::new(), Group::add))
    }
}
