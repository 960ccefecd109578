//! Captions of pictures in scopes: the subject of the picture, its tracer, and the meaning of each colour.

use super::drawing::{Ink, Inks, REMARK, TITLE, Type, degrees, hex, page, printable, shortened, text_width};
use brillianteer_scene::Scope;
use glam::DVec2;
use svg::Document;
use svg::node::element::{Group, Rectangle, Text};

/// White space to the left and right, and above and below, in units of the drawing.
const MARGIN: (f64, f64) = (24.0, 18.0);
/// Distance from one line of remarks, or row of the legend, to the next, and between lines of the title, in type sizes.
const LINE: f64 = 21.0 / 13.0;
const TITLE_LINE: f64 = 4.0 / 3.0;
/// Side of the square that shows a zone's colour, in type sizes.
const FIELD: f64 = 14.0 / 13.0;
/// Gap between a colour's square and its words, and between the words and the next square, in type sizes.
const GAPS: (f64, f64) = (7.0 / 13.0, 20.0 / 13.0);
/// The width below which a caption is drawn smaller.
const WHOLE_WIDTH: f64 = 360.0;
/// The smallest type of the title and of the rest that can be read, in pixels. Longer text is broken into more lines.
const LEAST_TYPE: (f64, f64) = (12.0, 9.0);
/// The smallest part of the margins that is left.
const LEAST_MARGIN: f64 = 0.25;
/// The most lines of a title, which may be as long as a design's name.
const TITLE_LINES: usize = 2;

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
        Self::with_legend(title, remarks, zones.map(|(k, band)| (band_text(scope, k), band.colour)).collect())
    }

    /// Builds a caption whose legend says what each of some colours means.
    pub fn with_legend(title: &str, remarks: Vec<String>, zones: Vec<(String, [u8; 3])>) -> Self {
        Self { title: title.to_owned(), remarks, zones }
    }

    /// Builds a caption without a legend.
    pub fn plain(title: &str, remarks: Vec<String>) -> Self {
        Self { title: title.to_owned(), remarks, zones: vec![] }
    }

    /// Returns the caption alone, as a drawing of this width. Its small type is 13 units high, and down to 9 where the
    /// drawing is narrow.
    pub fn document(&self, width: f64) -> Document {
        let (group, height) = self.drawn(width);
        page(DVec2::new(width, height)).add(group)
    }

    /// Returns the height that [`document`](Self::document) has at this width.
    pub fn height(&self, width: f64) -> f64 {
        self.drawn(width).1
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
        let sheet = Sheet::of(width);
        let [left, top] = sheet.margin;
        let mut texts =
            Group::new().set("font-family", "Ubuntu, 'Ubuntu Light', sans-serif").set("font-weight", 300);
        let (title, lines) = sheet.title(&self.title);
        let mut y = top;
        for text in lines {
            texts = texts.add(line(title, [left, y + TITLE_LINE * title.size / 2.0], &text));
            y += TITLE_LINE * title.size;
        }
        let step = LINE * sheet.remark.size;
        for remark in self.remarks.iter().flat_map(|remark| broken(remark, sheet.remark.size, sheet.room)) {
            texts = texts.add(line(sheet.remark, [left, y + step / 2.0], &remark));
            y += step;
        }
        let (fields, texts, below) =
            if self.zones.is_empty() { (Group::new(), texts, y) } else { self.legend(&sheet, y, texts) };
        let height = (below + top).ceil();
        let paper = Rectangle::new().set("width", width).set("height", height).set("fill", "#ffffff");
        (Group::new().set("class", "caption").add(paper).add(fields).add(texts), height)
    }

    /// Draws the legend from a height on: its colours, its words added to `texts`, and the height where it ends.
    fn legend(&self, sheet: &Sheet, top: f64, mut texts: Group) -> (Group, Group, f64) {
        let (left, size) = (sheet.margin[0], sheet.remark.size);
        let [step, field, gap, apart] = [LINE, FIELD, GAPS.0, GAPS.1].map(|part| part * size);
        let mut fields = Group::new().set("stroke", Inks::PAPER.of(Ink::Edge)).set("stroke-width", 0.8);
        let (mut x, mut y) = (left, top + step / 2.0);
        for (label, colour) in &self.zones {
            let lines = broken(label, size, sheet.room - field - gap);
            let widest = lines.iter().map(|text| text_width(text, size)).fold(0.0, f64::max);
            let wide = field + gap + widest;
            if x > left && (lines.len() > 1 || x + wide > left + sheet.room) {
                (x, y) = (left, y + step);
            }
            let square = Rectangle::new().set("x", x).set("y", y - field / 2.0).set("fill", hex(*colour));
            fields = fields.add(square.set("width", field).set("height", field));
            for (k, text) in lines.iter().enumerate() {
                y += if k > 0 { step } else { 0.0 };
                texts = texts.add(line(sheet.remark, [x + field + gap, y], text));
            }
            // Words of several lines fill their row.
            x = if lines.len() > 1 { left + sheet.room } else { x + wide + apart };
        }
        (fields, texts, y + step / 2.0)
    }
}

/// The measures of a caption of one width: those of a wide one, or smaller ones.
struct Sheet {
    /// White space to the left and right, and above and below.
    margin: [f64; 2],
    /// The width between the margins.
    room: f64,
    /// The part of the whole size at which the caption is drawn, up to 1.
    part: f64,
    /// Type of remarks and legend.
    remark: Type,
}

impl Sheet {
    fn of(width: f64) -> Self {
        let part = (width / WHOLE_WIDTH).min(1.0);
        let margin = [MARGIN.0, MARGIN.1].map(|margin| margin * part.max(LEAST_MARGIN));
        let remark = Type { size: (part * REMARK.size).max(LEAST_TYPE.1), ..REMARK };
        Self { margin, room: width - 2.0 * margin[0], part, remark }
    }

    /// Returns the title's type and lines: smaller type, then more lines, then an ellipsis where it is too long.
    fn title(&self, title: &str) -> (Type, Vec<String>) {
        let usual = self.part * TITLE.size;
        let fitting = usual * self.room / text_width(title, usual).max(self.room);
        let size = fitting.max(LEAST_TYPE.0);
        let mut lines = broken(title, size, self.room);
        if lines.len() > TITLE_LINES {
            let rest = lines.split_off(TITLE_LINES - 1).join(" ");
            lines.push(shortened(&rest, size, self.room));
        }
        (Type { size, ..TITLE }, lines)
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

/// Breaks a text between words into lines of type of a size that fit the room.
fn broken(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(last) if text_width(&format!("{last} {word}"), size) <= room => {
                last.push(' ');
                last.push_str(word);
            }
            _ => lines.push(shortened(word, size, room)),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::{ASET_CONE, Backing};
    use resvg::usvg::roxmltree;

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
    fn a_caption_without_a_legend_is_lower_and_as_high_as_it_says() {
        let scope = Scope::aset(ASET_CONE, Backing::Black);
        let remarks = vec!["one".to_owned(), "two".to_owned()];
        let (with, without) =
            (Caption::new("A title", remarks.clone(), &scope), Caption::plain("A title", remarks));
        assert!(without.height(400.0) < with.height(400.0));
        for caption in [with, without] {
            let text = caption.document(400.0).to_string();
            assert!(text.contains(&format!("0 0 400 {}", caption.height(400.0))), "{text}");
        }
    }

    #[test]
    fn lines_fit_their_room() {
        let text = "a word and another word, and averyveryverylongonethatfitsnowhere";
        let lines = broken(text, REMARK.size, 80.0);
        assert!(lines.len() > 2 && lines.iter().all(|l| text_width(l, REMARK.size) <= 80.0), "{lines:?}");
    }

    /// Returns the texts of a drawing, each with its left end, its type size and its content.
    fn texts(document: &Document) -> Vec<(f64, f64, String)> {
        let text = document.to_string();
        let tree = roxmltree::Document::parse(&text).unwrap();
        let texts = tree.descendants().filter(|node| node.has_tag_name("text"));
        let number = |node: &roxmltree::Node, key: &str| node.attribute(key).unwrap().parse().unwrap();
        texts
            .map(|n| (number(&n, "x"), number(&n, "font-size"), n.text().unwrap().trim().to_owned()))
            .collect()
    }

    #[test]
    fn a_caption_of_any_width_is_readable_and_nothing_of_it_is_cut_off() {
        let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(10.0);
        let remarks =
            ["aset: energy, glare left out; table side", "Mixed colours: light from several zones."];
        for title in
            ["Tolkowsky 1919", "A round brilliant after the tables of the nineteen-twenties, cut anew"]
        {
            let caption = Caption::new(title, remarks.map(str::to_owned).to_vec(), &scope);
            let whole = texts(&caption.document(2000.0));
            for width in [96.0, 128.0, 200.0, 256.0, 512.0, 1000.0] {
                let drawn = texts(&caption.document(width));
                for (left, size, text) in &drawn {
                    assert!(*left >= 4.0 && left + text_width(text, *size) <= width - 4.0, "{width}: {text}");
                    assert!((LEAST_TYPE.1..=TITLE.size).contains(size), "{width}: {text}: {size}");
                }
                let words = |all: &[(f64, f64, String)]| {
                    all.iter().map(|(.., text)| text.as_str()).collect::<Vec<_>>().join(" ")
                };
                let (found, expected) = (words(&drawn), words(&whole));
                let from = expected.find("aset:").unwrap();
                assert!(found.ends_with(&expected[from..]), "{width}: {found}");
                let is_whole = found.starts_with(title);
                assert!(
                    is_whole || found.contains('…') && title.len() > 20 && width < 512.0,
                    "{width}: {found}"
                );
            }
        }
    }

    #[test]
    fn a_wide_caption_has_the_type_of_other_drawings() {
        let caption =
            Caption::new("A title", vec!["a remark".to_owned()], &Scope::aset(ASET_CONE, Backing::Black));
        for width in [360.0, 1000.0] {
            let sizes: Vec<f64> = texts(&caption.document(width)).iter().map(|(_, size, _)| *size).collect();
            assert_eq!(sizes[..2], [TITLE.size, REMARK.size]);
        }
    }
}
