//! Reads `.gcs` files.

use super::{COLOUR, ROOT, VERSION, guard};
use crate::cutters::{self, Gear, WarningList};
use crate::design_file::ImportedDesign;
use crate::numbers::NumberReader;
use brillianteer_base::Fault;
use brillianteer_cut::{MaterialRef, Tiers};
use roxmltree::{Document, Node, ParsingOptions};
use std::fmt::Display;

/// The most elements and blanks between them: ten thousand facets of fifty corners each.
const MOST_NODES: u32 = 1_000_000;

/// The attributes of `<index>` that are read; others become remarks.
const INDEX: [&str; 4] = ["gear", "base", "symmetry", "mirror"];

/// The attributes of `<info>` with the lines at the top and, below, at the end. The last of each holds all further lines.
const HEADERS: [&str; 3] = ["title", "author", "header2"];
const FOOTERS: [&str; 2] = ["footer1", "footer2"];

/// Reads a design of Gem Cut Studio; `label` is the path of the file, which names a design without a title.
///
/// # Errors
/// Fails where the file is no such design; the error has a line where there is one.
pub fn read(bytes: &[u8], label: &str) -> Result<ImportedDesign, Fault> {
    let (text, warning) = guard::text(bytes)?;
    if !text.trim_start_matches('\u{feff}').trim_start().starts_with('<') {
        let problem = "this is not a Gem Cut Studio file: such a file is XML and begins with `<`; check what the file holds, or \
                       its name's ending";
        return Err(problem.into());
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, options)
        .map_err(|error| Fault::line(error.pos().row as usize, unread(&error)))?;
    let mut reader =
        Reader { document: &document, warnings: WarningList::default(), numbers: NumberReader::default() };
    warning.into_iter().for_each(|text| reader.warnings.warn(|| text));
    let (tiers, material) = reader.design()?;
    reader.numbers.warning().into_iter().for_each(|text| reader.warnings.warn(|| text));
    let name = cutters::title(tiers.headers.first(), label);
    cutters::brought(name, material, tiers, reader.warnings)
}

/// Says in plain words why a text is no XML that can be read.
fn unread(error: &roxmltree::Error) -> String {
    use roxmltree::Error;
    let what = match error {
        Error::UnexpectedCloseTag(expected, found, _) => {
            format!("`</{expected:.40}>` is expected, and `</{found:.40}>` is there")
        }
        Error::UnexpectedEntityCloseTag(_) => "an element ends that has not begun".to_owned(),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            "the file ends within an element: it has been cut off, get it again".to_owned()
        }
        Error::NoRootNode => "there is no element".to_owned(),
        Error::DuplicatedAttribute(name, _) => {
            format!("the attribute `{name:.40}` is there twice; leave one of them out")
        }
        Error::UnknownEntityReference(..) | Error::MalformedEntityReference(_) => {
            "a character `&` must be written as `&amp;`".to_owned()
        }
        Error::InvalidAttributeValue(_) => {
            "a character `<` within a value must be written as `&lt;`".to_owned()
        }
        Error::InvalidChar(found, expected, _) => {
            format!("`{}` is expected, and `{}` is there", char::from(*expected), char::from(*found))
        }
        Error::InvalidChar2(expected, found, _) => {
            format!("{expected} is expected, and `{}` is there", char::from(*found))
        }
        Error::NonXmlChar(c, _) => {
            format!("the character U+{:04X} is not allowed; leave it out", u32::from(*c))
        }
        Error::DtdDetected => "it has a DOCTYPE, which a design does not need; leave it out".to_owned(),
        Error::NodesLimitReached => format!("it has more than {MOST_NODES} elements"),
        _ => "its elements are not those of XML".to_owned(),
    };
    format!("this XML cannot be read: {what}; or save the design again from Gem Cut Studio")
}

pub(super) struct Reader<'d> {
    document: &'d Document<'d>,
    pub warnings: WarningList,
    numbers: NumberReader,
}

impl<'d> Reader<'d> {
    fn line(&self, node: Node<'_, '_>) -> usize {
        self.document.text_pos_at(node.range().start).row as usize
    }

    pub fn fault(&self, node: Node<'_, '_>, problem: impl Display) -> Fault {
        Fault::line(self.line(node), problem)
    }

    pub fn warn(&mut self, node: Node<'_, '_>, text: impl FnOnce() -> String) {
        let document = self.document;
        self.warnings.warn(|| format!("line {}: {}", document.text_pos_at(node.range().start).row, text()));
    }

    /// Returns an attribute as text, with the line breaks that it has in the file; `None` where it is empty or missing.
    pub fn text(&self, node: Node<'_, '_>, key: &str) -> Option<String> {
        let attribute = node.attribute_node(key).filter(|attribute| !attribute.value().is_empty())?;
        let raw = &self.document.input_text()[attribute.range_value()];
        Some(guard::unfolded(raw, attribute.value()))
    }

    /// Returns an attribute as a finite number, also with a decimal comma; `None` where it is missing, and with a warning
    /// where it is anything else.
    pub fn number(&mut self, node: Node<'_, '_>, key: &str) -> Option<f64> {
        let text = node.attribute(key)?;
        let read = self.numbers.read(text.trim(), self.line(node));
        let number = read.ok().flatten().filter(|number| number.is_finite());
        if number.is_none() {
            self.warn(node, || format!("{key}: '{text:.40}' is not a finite number; it is not read"));
        }
        number
    }

    pub fn is(&self, node: Node<'_, '_>, key: &str, otherwise: bool) -> bool {
        match node.attribute(key).map(|text| text.trim().to_ascii_lowercase()).as_deref() {
            Some("true" | "1") => true,
            Some("false" | "0") => false,
            _ => otherwise,
        }
    }

    fn design(&mut self) -> Result<(Tiers, MaterialRef), Fault> {
        let root = self.document.root_element();
        if !root.has_tag_name(ROOT) {
            return Err(self.fault(root, format!("<{ROOT}> is expected; this is another kind of XML")));
        }
        if root.attribute("version") != Some(VERSION) {
            self.warn(root, || format!("version: only {VERSION} is known; it is read as that"));
        }
        let mut tiers = self.gear(root).tiers();
        self.index(root, &mut tiers);
        self.info(root, &mut tiers);
        let material = self.render(root, &mut tiers);
        tiers.tiers = self.tiers(root, Gear { teeth: tiers.gear, offset: tiers.offset })?;
        Ok((tiers, material))
    }

    fn gear(&mut self, root: Node<'d, 'd>) -> Gear {
        let Some(node) = child(root, "index") else {
            self.warn(root, || "<index> is missing".to_owned());
            return Gear::default();
        };
        let teeth = self.number(node, "gear").unwrap_or_default();
        let offset = self.number(node, "base").unwrap_or_default();
        // A number that is not whole becomes 0, which no gear has.
        let teeth = if teeth.fract() == 0.0 { teeth as i32 } else { 0 };
        let place = format!("line {}: ", self.line(node));
        Gear::given(teeth, offset, &place, &mut self.warnings)
    }

    fn index(&mut self, root: Node<'d, 'd>, tiers: &mut Tiers) {
        let Some(node) = child(root, "index") else { return };
        let symmetry = self.number(node, "symmetry").unwrap_or(1.0) as i32;
        let place = format!("line {}: ", self.line(node));
        tiers.symmetry = cutters::symmetry(symmetry, &place, &mut self.warnings);
        tiers.mirror = self.is(node, "mirror", false);
        self.remark(node, &INDEX, tiers);
    }

    fn info(&mut self, root: Node<'d, 'd>, tiers: &mut Tiers) {
        let Some(node) = child(root, "info") else { return };
        tiers.headers = self.lines(node, &HEADERS);
        tiers.footers = self.lines(node, &FOOTERS);
        self.remark(node, &[HEADERS.as_slice(), &FOOTERS].concat(), tiers);
    }

    fn lines(&self, node: Node<'_, '_>, keys: &[&str]) -> Vec<String> {
        let mut texts: Vec<String> =
            keys.iter().map(|key| self.text(node, key).unwrap_or_default()).collect();
        let last = texts.pop().unwrap_or_default();
        texts.extend(last.split('\n').map(str::to_owned));
        cutters::up_to_the_last(texts)
    }

    fn render(&mut self, root: Node<'d, 'd>, tiers: &mut Tiers) -> MaterialRef {
        let Some(node) = child(root, "render") else {
            return cutters::material(f64::NAN, "", &mut self.warnings);
        };
        self.remark(node, &["refractive_index"], tiers);
        if let Some(colour) = child(node, "color") {
            let parts = ["r", "g", "b"].map(|key| colour.attribute(key).unwrap_or("0").trim());
            self.keep(colour, COLOUR.0, parts.join(" "), tiers);
        }
        let index = self.number(node, "refractive_index").unwrap_or(f64::NAN);
        let place = format!("line {}: ", self.line(node));
        cutters::material(index, &place, &mut self.warnings)
    }

    /// Keeps the attributes that are not in `known` as remarks.
    fn remark(&mut self, node: Node<'_, '_>, known: &[&str], tiers: &mut Tiers) {
        for attribute in node.attributes().filter(|attribute| !known.contains(&attribute.name())) {
            if let Some(text) = self.text(node, attribute.name()) {
                self.keep(node, attribute.name(), text, tiers);
            }
        }
    }

    fn keep(&mut self, node: Node<'_, '_>, key: &str, text: String, tiers: &mut Tiers) {
        if super::RENDER.contains(&(key, Some(&text))) || (key, text.as_str()) == COLOUR {
            return;
        }
        if tiers.remarks.contains_key(key) {
            self.warn(node, || format!("{key}: it is given twice; '{text:.40}' is not kept"));
        } else {
            tiers.remarks.insert(key.to_owned(), text);
        }
    }
}

/// Returns a child element by its name.
fn child<'d>(node: Node<'d, 'd>, name: &str) -> Option<Node<'d, 'd>> {
    node.children().find(|child| child.has_tag_name(name))
}
