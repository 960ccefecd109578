//! A drawing that is placed on a page among others.

use super::super::drawing::Frame;
use glam::DVec2;

/// A finished SVG drawing, taken apart so that it can be put on a page or into a web page.
#[derive(Debug, Clone, PartialEq)]
pub struct EmbeddedDrawing {
    /// The upper left corner and the size of the drawing's contents, in its own units.
    view: [f64; 4],
    /// Everything within the drawing's root.
    content: String,
}

impl EmbeddedDrawing {
    /// Takes the text of a drawing apart; `None` where it has no root with a `viewBox`.
    pub fn of(svg: &str) -> Option<Self> {
        let root = &svg[svg.find("<svg")?..];
        let (tag, rest) = root.split_once('>')?;
        let content = &rest[..rest.rfind("</svg>")?];
        let (_, view) = tag.split_once("viewBox=\"")?;
        let numbers = view.split_once('"')?.0.split([' ', ',']).filter(|number| !number.is_empty());
        let numbers: Vec<f64> = numbers.map(|number| number.parse().ok()).collect::<Option<_>>()?;
        let view: [f64; 4] = numbers.try_into().ok()?;
        let is_shown = view.iter().all(|number| number.is_finite()) && view[2] > 0.0 && view[3] > 0.0;
        is_shown.then(|| Self { view, content: content.to_owned() })
    }

    /// Makes a drawing that shows one picture of this size in pixels, whose file is at `href`.
    pub fn of_picture([width, height]: [u32; 2], href: &str) -> Self {
        let content = format!("<image width=\"{width}\" height=\"{height}\" href=\"{href}\"/>");
        Self { view: [0.0, 0.0, f64::from(width.max(1)), f64::from(height.max(1))], content }
    }

    /// Returns the width divided by the height.
    pub fn aspect(&self) -> f64 {
        self.view[2] / self.view[3]
    }

    /// Returns the drawing as an element of a web page, which `label` describes; the label must have no markup.
    pub fn element(&self, label: &str) -> String {
        let [x, y, width, height] = self.view;
        let content = &self.content;
        format!(
            "<svg viewBox=\"{x} {y} {width} {height}\" role=\"img\" aria-label=\"{label}\">{content}</svg>"
        )
    }

    /// Returns the drawing as an element that fills a box of another one.
    pub(super) fn within(&self, frame: Frame) -> String {
        let [x, y, width, height] = self.view;
        let (low, size) = (frame.low, frame.high - frame.low);
        let DVec2 { x: across, y: down } = size;
        // The border of the box clips nothing, because PDF files of the program cannot clip.
        format!(
            "<svg x=\"{:.3}\" y=\"{:.3}\" width=\"{across:.3}\" height=\"{down:.3}\" \
             viewBox=\"{x} {y} {width} {height}\" overflow=\"visible\">{}</svg>",
            low.x, low.y, self.content
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_is_taken_apart_whatever_stands_before_it_and_however_its_numbers_are_parted() {
        for svg in [
            "<svg viewBox=\"1 2 30 20\" width=\"3\"><g/></svg>",
            "<?xml?>\n<svg width=\"3\" viewBox=\"1,2,30,20\">\n<g/></svg>\n",
        ] {
            let drawing = EmbeddedDrawing::of(svg).unwrap();
            assert_eq!((drawing.aspect(), drawing.content.trim()), (1.5, "<g/>"));
            assert!(
                drawing.element("a").starts_with("<svg viewBox=\"1 2 30 20\" role=\"img\" aria-label=\"a\">")
            );
        }
        for bad in [
            "",
            "<svg/>",
            "<svg><g/></svg>",
            "<svg viewBox=\"0 0 1\"></svg>",
            "<svg viewBox=\"0 0 0 1\"></svg>",
        ] {
            assert_eq!(EmbeddedDrawing::of(bad), None, "{bad}");
        }
    }
}
