//! Captions of pictures in scopes: what the picture shows, how it was traced, and what each colour means.

use super::drawing::{Ink, Inks, REMARK, TITLE, Type, degrees, hex, page, printable, shortened, text_width};
use crate::scene::Scope;
use glam::DVec2;
use svg::Document;
use svg::node::element::{Group, Rectangle, Text};

/// White space to the left and right, and above and below, in units of the drawing.
const MARGIN: (f64, f64) = (24.0, 18.0);
/// Distance from one line of remarks, or row of the legend, to the next.
const LINE: f64 = 21.0;
/// Height of the title's line.
const TITLE_LINE: f64 = 32.0;
/// Side of the square that shows a zone's colour.
const FIELD: f64 = 14.0;
/// Gap between a colour's square and its words, and between the words and the next square.
const GAPS: (f64, f64) = (7.0, 20.0);

/// The caption under a picture: a title, remarks, and a legend of the scope's zones.
#[derive(Debug, Clone, PartialEq)]
pub struct Caption {
    title: String,
    remarks: Vec<String>,
    zones: Vec<(String, [u8; 3])>,
}

impl Caption {
    /// Builds a caption with the zones of a scope as its legend. Long remarks are broken into lines.
    pub fn new(title: &str, remarks: Vec<String>, scope: &Scope) -> Self {
        let zones = scope.bands.iter().enumerate().rev();
        let zones = zones.map(|(k, band)| (band_text(scope, k), band.colour)).collect();
        Self { title: title.to_owned(), remarks, zones }
    }

    /// Returns the caption alone, as a drawing of this width; its small type is 13 units high.
    pub fn document(&self, width: f64) -> Document {
        let (group, height) = self.drawn(width);
        page(DVec2::new(width, height)).add(group)
    }

    /// Returns a square drawing of this side with the caption under it.
    pub fn under(&self, square: Document, side: f64) -> Document {
        let (group, height) = self.drawn(side);
        square
            .set("viewBox", (0, 0, side, side + height))
            .set("height", side + height)
            .add(group.set("transform", format!("translate(0 {side})")))
    }

    /// Returns the caption's elements, drawn from the origin on, and the height that they take.
    fn drawn(&self, width: f64) -> (Group, f64) {
        let room = width - 2.0 * MARGIN.0;
        let mut texts =
            Group::new().set("font-family", "Ubuntu, 'Ubuntu Light', sans-serif").set("font-weight", 300);
        let mut fields = Group::new().set("stroke", Inks::PAPER.of(Ink::Edge)).set("stroke-width", 0.8);
        let mut y = MARGIN.1 + TITLE_LINE / 2.0;
        texts = texts.add(line(TITLE, [MARGIN.0, y], &shortened(&self.title, TITLE.size, room)));
        y += (TITLE_LINE + LINE) / 2.0;
        for remark in self.remarks.iter().flat_map(|remark| broken(remark, room)) {
            texts = texts.add(line(REMARK, [MARGIN.0, y], &remark));
            y += LINE;
        }
        let mut x = MARGIN.0;
        for (label, colour) in &self.zones {
            let label = shortened(label, REMARK.size, room - FIELD - GAPS.0);
            let wide = FIELD + GAPS.0 + text_width(&label, REMARK.size);
            if x > MARGIN.0 && x + wide > width - MARGIN.0 {
                (x, y) = (MARGIN.0, y + LINE);
            }
            let field = Rectangle::new().set("x", x).set("y", y - FIELD / 2.0).set("fill", hex(*colour));
            fields = fields.add(field.set("width", FIELD).set("height", FIELD));
            texts = texts.add(line(REMARK, [x + FIELD + GAPS.0, y], &label));
            x += wide + GAPS.1;
        }
        let height = (y + LINE / 2.0 + MARGIN.1).ceil();
        let paper = Rectangle::new().set("width", width).set("height", height).set("fill", "#ffffff");
        (Group::new().set("class", "caption").add(paper).add(fields).add(texts), height)
    }
}

/// Returns the legend's text for a band.
fn band_text(scope: &Scope, band: usize) -> String {
    let name = &scope.bands[band].name;
    match scope.elevations(band) {
        [-90.0, to] => format!(
            "{name} {}: light from behind",
            if to == 0.0 { "the horizon".into() } else { degrees(to) }
        ),
        [from, to] => format!("{name}, {} to {}", degrees(from), degrees(to)),
    }
}

/// Returns a line of text whose middle height is at a point.
fn line(kind: Type, [x, y]: [f64; 2], content: &str) -> Text {
    Text::new(printable(content))
        .set("x", x)
        .set("y", y + 0.35 * kind.size)
        .set("font-size", kind.size)
        .set("fill", Inks::PAPER.of(kind.colour))
}

/// Breaks a text between words into lines that fit the room.
fn broken(text: &str, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(last) if text_width(&format!("{last} {word}"), REMARK.size) <= room => {
                last.push(' ');
                last.push_str(word);
            }
            _ => lines.push(shortened(word, REMARK.size, room)),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ASET_CONE, Backing};

    #[test]
    fn a_caption_tells_every_zone_and_breaks_what_is_too_long() {
        let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(10.0);
        let remark = "one two three four five six seven eight nine ten eleven twelve thirteen".to_owned();
        let caption = Caption::new("A title", vec![remark], &scope);
        let [narrow, wide] = [200.0, 1000.0].map(|width| caption.drawn(width));
        assert!(narrow.1 > wide.1, "{} and {}", narrow.1, wide.1);
        let text = caption.document(1000.0).to_string();
        for label in
            ["A title", "twelve thirteen", "head, 80° to 90°", "blue, 75° to 80°", "green, 0° to 45°"]
        {
            assert!(text.contains(label), "{label}: {text}");
        }
        assert!(text.contains("below the horizon: light from behind") && text.contains("#00ff00"));
    }

    #[test]
    fn lines_fit_their_room() {
        let lines = broken("a word and another word, and averyveryverylongonethatfitsnowhere", 80.0);
        assert!(lines.len() > 2 && lines.iter().all(|l| text_width(l, REMARK.size) <= 80.0), "{lines:?}");
    }
}
