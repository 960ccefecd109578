//! Brings the lines of a PLY header into the form that ply-rs-bw takes, and says what is wrong with those that have no such
//! form.

use brillianteer_base::Fault;

/// The words that begin the lines of a header. Lines of other words are left out.
const WORDS: [&str; 7] = ["ply", "format", "comment", "obj_info", "element", "property", "end_header"];

/// The encodings of the rows.
const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// The types of numbers.
const TYPES: [&str; 16] = [
    "char", "uchar", "short", "ushort", "int", "uint", "float", "double", "int8", "uint8", "int16", "uint16",
    "int32", "uint32", "float32", "float64",
];

/// A reader of the lines of a header.
#[derive(Default)]
pub(super) struct HeaderLines {
    has_format: bool,
    /// The names of the elements so far.
    elements: Vec<String>,
    /// The names of the properties of the last element.
    properties: Vec<String>,
    /// The first line at fault.
    pub fault: Option<Fault>,
}

impl HeaderLines {
    /// Hands on a line, from 1, in small letters and without blanks around it. Blank lines are left out.
    pub fn hand_on(&mut self, line: &[u8], number: usize, out: &mut Vec<u8>) {
        if line.trim_ascii().is_empty() {
            return;
        }
        // Comments may be in any encoding.
        let line: String =
            line.iter().map(|byte| if byte.is_ascii() { char::from(*byte) } else { '?' }).collect();
        let lower = line.trim().to_ascii_lowercase();
        let words: Vec<&str> = lower.split_whitespace().collect();
        if let Err(problem) = self.check(&words) {
            self.fault.get_or_insert(Fault::line(number, problem));
        }
        let text = match words.first() {
            Some(&("comment" | "obj_info")) => line.trim().to_owned(),
            Some(word) if WORDS.contains(word) => words.join(" "),
            _ => "comment".to_owned(),
        };
        out.extend(text.as_bytes());
        out.push(b'\n');
    }

    fn check(&mut self, words: &[&str]) -> Result<(), String> {
        match *words {
            ["format", ref rest @ ..] => {
                self.has_format = true;
                let encoding = rest.first().copied().unwrap_or_default();
                match ENCODINGS.contains(&encoding) {
                    true if rest.len() == 2 => Ok(()),
                    true => Err(format!("`format {encoding} 1.0` is expected here")),
                    false => Err(format!(
                        "the format `{encoding:.40}` is not known; save the file with one of {}",
                        ENCODINGS.join(", ")
                    )),
                }
            }
            ["element", name, count] => self.element(name, count),
            ["element", ..] => Err("a name and a number of rows are expected after `element`".to_owned()),
            ["property", "list", count, of, name] => self
                .property(name, &[count, of])
                .map_err(|problem| format!("property `{name:.40}`: {problem}")),
            ["property", of, name] if of != "list" => {
                self.property(name, &[of]).map_err(|problem| format!("property `{name:.40}`: {problem}"))
            }
            ["property", ..] => Err("a type and a name are expected after `property`".to_owned()),
            ["end_header", ..] if !self.has_format => {
                Err("the header has no line of its format; one such as `format ascii 1.0` is expected"
                    .to_owned())
            }
            _ => Ok(()),
        }
    }

    fn element(&mut self, name: &str, count: &str) -> Result<(), String> {
        if count.parse::<u64>().is_err() {
            return Err(format!(
                "element `{name:.40}`: `{count:.40}` is not a number of rows; a whole number, 0 or more, is expected"
            ));
        }
        if self.elements.iter().any(|known| known == name) {
            return Err(format!("element `{name:.40}` is announced a second time; save the file with one"));
        }
        self.elements.push(name.to_owned());
        self.properties.clear();
        Ok(())
    }

    fn property(&mut self, name: &str, types: &[&str]) -> Result<(), String> {
        if self.elements.is_empty() {
            return Err("a line of the element that it belongs to is expected above it".to_owned());
        }
        if let Some(unknown) = types.iter().find(|of| !TYPES.contains(of)) {
            return Err(format!("the type `{unknown:.40}` is not read; {} are", TYPES[..8].join(", ")));
        }
        if self.properties.iter().any(|known| known == name) {
            return Err("it is announced a second time for the element; save the file with one".to_owned());
        }
        self.properties.push(name.to_owned());
        Ok(())
    }
}
