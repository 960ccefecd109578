//! Reads TOML texts, each parsed once, with faults that name the line by the spans of the parsed values.

use super::text::line_after;
use brillianteer_base::{Fault, NumberRow, nearest};
use brillianteer_cut::{FAMILIES, Family};
use brillianteer_scene::LOOK_NUMBERS;
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue, Deserializer, Error};

/// The meanings of keys, for someone who left a key out or wrote something else. Those of proportions are in their
/// families' tables.
const MEANINGS: [(&str, &str); 51] = [
    ("name", "what it is called"),
    ("material", "a material's name, an index, or a table of its own"),
    ("diameter_mm", "girdle diameter in mm"),
    ("normal", "outward, [x, y, z]"),
    ("offset", "n·x <= offset, with the girdle radius 1"),
    ("gear", "teeth of the index gear"),
    ("angle", "degrees from the girdle plane, below 0 for the pavilion"),
    ("distance", "from the origin to the facet's plane"),
    ("indices", "teeth at which the tier is cut"),
    ("index", "the gear, a table [index]"),
    ("cauchy", "[A, B] of n = A + B / L², L in µm"),
    ("abbe", "[n_d, v_d]"),
    ("sellmeier", "[[B, C], ...], C in µm"),
    ("absorption", "a number per mm, or [[nm, per mm], ...]"),
    ("absorption_e", "of the extraordinary polarisation: a number per mm, or [[nm, per mm], ...]"),
    ("valid_nm", "[first, last]"),
    ("density", "g/cm³"),
    ("light", "a light's name, or a file"),
    ("light_upright", "true or false"),
    ("layout", "row, ring or parcel"),
    ("style", "band, four-prong, six-prong, halo or eternity"),
    ("metal", "gold, platinum, silver or rhodium"),
    ("gap_mm", "mm between the girdles of a layout"),
    ("angle_of_view", "degrees of a perspective"),
    ("background", "a colour, light, the name of a world or a pattern, or a photograph"),
    ("stone", "a table [[stone]] for each kind"),
    ("cut", "a cut's name, or a cut file"),
    ("count", "how many"),
    ("turn", "degrees about the stone's axis"),
    ("tilt", "degrees that the table leans toward the azimuth"),
    ("at", "[x, y, z] in mm"),
    ("from", "degrees of elevation at which it begins, -90 to 90"),
    ("colour", "[red, green, blue] of sRGB, 0 to 255 each"),
    ("spectrum", "D65, A, E, or daylight such as 5000 K"),
    ("tone", "neutral, filmic or linear"),
    ("dome", "belts of the sky, each a table [[dome]]"),
    ("box", "rectangles of light, each a table [[box]]"),
    ("lamp", "discs of light, each a table [[lamp]]"),
    ("field", "many lamps, each field a table [[field]]"),
    ("panorama", "a picture of the surroundings, a table [panorama]"),
    ("world", "sunset, room or city"),
    ("to", "degrees of elevation at which it ends, -90 to 90"),
    ("soft", "width of its edges, degrees"),
    ("radiance", RADIANCE),
    ("end", RADIANCE),
    ("azimuth", "degrees, counter-clockwise"),
    ("elevation", "degrees from the horizon, -90 to 90"),
    ("width", "degrees"),
    ("height", "degrees"),
    ("radius", "degrees from its middle to its edge"),
    ("file", "a picture: .hdr, .exr, .png or .jpg"),
];
const RADIANCE: &str = "0 to 1e6; 1 is a white sheet in full light";
/// Serde's words for the expected type, and the words that this program uses.
const WORDS: [(&str, &str); 15] = [
    ("expected f64", "expected a number"),
    ("expected f32", "expected a number"),
    ("expected u64", "expected a whole number, 0 or more"),
    ("expected usize", "expected a whole number, 0 or more"),
    ("expected u32", "expected a whole number, 0 or more"),
    ("expected u8", "expected a whole number from 0 to 255"),
    ("expected an array of length 3", "expected a list of 3 numbers"),
    ("expected i64", "expected a whole number"),
    ("expected a string", "expected text"),
    (" as i128", ""),
    (" as u128", ""),
    ("expected a sequence", "expected a list"),
    ("invalid type: sequence", "invalid type: list"),
    ("invalid type: map", "invalid type: table"),
    ("floating point", "number"),
];

/// The beginnings of the parser's messages about a text that is not TOML, and the words that this program uses.
const SYNTAX: [(&str, &str); 12] = [
    ("duplicate key", "this key is there a second time; leave one of them out"),
    ("floating-point number overflowed", "the number is too large"),
    ("integer number overflowed", "the number is too large"),
    ("string values must be quoted", "text must stand between quotation marks, as in \"diamond\""),
    (
        "key with no value",
        "a line `key = value`, a table's name as `[name]` or a remark after `#` is expected",
    ),
    ("cannot recurse further", "lists or tables lie too deep within one another"),
    ("invalid unquoted key", "a key has only letters, digits, - and _"),
    (
        "invalid key-value pair",
        "a line `key = value`, a table's name as `[name]` or a remark after `#` is expected",
    ),
    ("invalid basic string, expected `\"`", "the text has no end; a quotation mark is expected behind it"),
    (
        "invalid basic string",
        "the text has a character that it must not have; leave it out, or write \\\\ for \\",
    ),
    ("invalid float", "this is not a number"),
    ("unclosed array", "the list has no end; `]` is expected behind its last value"),
];

/// A TOML text that has been parsed.
pub struct TomlText<'t> {
    text: &'t str,
    table: Spanned<DeTable<'t>>,
}

impl<'t> TomlText<'t> {
    /// Parses a text.
    pub fn parse(text: &'t str) -> Result<Self, Fault> {
        let table = DeTable::parse(text).map_err(|error| syntax(text, &error))?;
        Ok(Self { text, table })
    }

    /// Returns the value of a key at the top of the file.
    pub fn get(&self, key: &str) -> Option<&Spanned<DeValue<'t>>> {
        self.table.get_ref().get(key)
    }

    /// Returns the line where a value begins, from 1.
    pub fn line(&self, value: &Spanned<DeValue<'_>>) -> usize {
        line_at(self.text, value.span().start)
    }

    /// Reads the form of the text, and returns what `make` makes of it. A fault of `make` gets the line of its key.
    pub fn read<T: Deserialize<'t>, U>(self, make: impl FnOnce(T) -> Result<U, Fault>) -> Result<U, Fault> {
        self.read_beside(&[], |_| Ok(()), |form, ()| make(form)).map(|(made, _)| made)
    }

    /// Reads the form of a text that may have further keys, which `take` takes out and reads first; each is given with the name
    /// of its table, which is empty at the top. Returns what `make` makes of both, and the lines of the keys.
    pub(crate) fn read_beside<T: Deserialize<'t>, B, U>(
        self,
        further: &[(&str, &str)],
        take: impl FnOnce(&mut DeTable<'t>) -> Result<B, Error>,
        make: impl FnOnce(T, B) -> Result<U, Fault>,
    ) -> Result<(U, KeyLines<'t>), Fault> {
        let Self { text, mut table } = self;
        let lines = KeyLines { text, spans: spans(table.get_ref()) };
        let beside = take(table.get_mut()).map_err(|error| misshapen(text, error, &[]))?;
        let form = T::deserialize(Deserializer::from(table));
        let form = form.map_err(|error| misshapen(text, error, further))?;
        match make(form, beside) {
            Ok(made) => Ok((made, lines)),
            Err(fault) => {
                let line = fault.line.or_else(|| lines.of(fault.key.as_deref()?));
                Err(Fault { line, ..fault })
            }
        }
    }
}

/// The lines of the keys of a text.
pub(super) struct KeyLines<'t> {
    text: &'t str,
    spans: DeTable<'t>,
}

impl KeyLines<'_> {
    /// Returns the line, from 1, of the value at a path such as `tier/0/indices`, or of the nearest value that encloses it;
    /// `None` if that is the whole text.
    pub fn of(&self, path: &str) -> Option<usize> {
        Some(line_at(self.text, start(&self.spans, path)?))
    }
}

/// Returns the number, from 1, of the line at a byte offset of a text.
pub(super) fn line_at(text: &str, offset: usize) -> usize {
    line_after(&text.as_bytes()[..offset.min(text.len())])
}

/// Copies the values of a text for their spans. The numbers of a mesh are left out, since there may be millions of them and
/// no fault names one by its key.
fn spans<'t>(table: &DeTable<'t>) -> DeTable<'t> {
    let copy = |(key, value): (&Spanned<DeString<'t>>, &Spanned<DeValue<'t>>)| match key.get_ref().as_ref() {
        "mesh" => (key.clone(), Spanned::new(value.span(), DeValue::Boolean(false))),
        _ => (key.clone(), value.clone()),
    };
    table.iter().map(copy).collect()
}

/// Makes a fault of the parser's error about a text that is not TOML.
fn syntax(text: &str, error: &Error) -> Fault {
    let Some(span) = error.span() else {
        return Fault::whole(format!("this TOML cannot be read: {}", error.message()));
    };
    let start = span.start.min(text.len());
    let line = text.as_bytes()[..start].rsplit(|byte| *byte == b'\n').next().unwrap_or_default();
    let column = 1 + String::from_utf8_lossy(line).chars().count();
    let whole = text[start - line.len()..].lines().next().unwrap_or_default();
    let key = whole.split_once('=').map(|(key, _)| key.trim()).filter(|key| !key.is_empty());
    let key = key.map_or(String::new(), |key| format!("{key}: "));
    let said = error.message();
    let known = SYNTAX.iter().find(|(start, _)| said.starts_with(start));
    let problem = format!("{key}column {column}: {}{}", known.map_or(said, |(_, words)| words), hint(whole));
    Fault::line(line_at(text, start), problem)
}

/// Makes a fault of serde's error about a text that does not have the form of its file, in the words of this program.
fn misshapen(text: &str, mut error: Error, further: &[(&str, &str)]) -> Fault {
    // Without its text the error shows the path of its key on a line of its own: in `plane.normal`.
    error.set_input(None);
    let shown = error.to_string();
    let path = shown.trim_end().rsplit_once("\nin `").and_then(|(_, path)| path.strip_suffix('`'));
    let keys_of = |path: &str| -> Vec<&str> {
        further.iter().filter(|(table, _)| *table == path).map(|(_, key)| *key).collect()
    };
    let problem = match path {
        Some(path) => format!("{path}: {}", reworded(error.message(), path, &keys_of(path))),
        None => reworded(error.message(), "", &keys_of("")),
    };
    let line = error.span().map(|span| line_at(text, span.start));
    Fault { line, ..Fault::whole(problem) }
}

/// Returns the byte offset of the value at a path, or of the nearest value that encloses it; `None` if that is the whole
/// text.
fn start(table: &DeTable<'_>, path: &str) -> Option<usize> {
    let mut steps = path.split('/');
    let mut value = table.get(steps.next()?)?;
    for step in steps {
        let inner = match value.get_ref() {
            DeValue::Table(table) => table.get(step),
            DeValue::Array(array) => step.parse().ok().and_then(|index: usize| array.get(index)),
            _ => None,
        };
        match inner {
            Some(inner) => value = inner,
            None => break,
        }
    }
    Some(value.span().start)
}

/// Returns a hint at what someone may have meant by a line that is no TOML.
fn hint(line: &str) -> &'static str {
    let value = line.split_once('=').map_or(line, |(_, value)| value).trim_start();
    let number: String = value.chars().take_while(|c| c.is_ascii_digit() || "+-.,".contains(*c)).collect();
    let rest = value[number.len()..].trim_start();
    if number.contains(',') {
        "; numbers have a decimal point, as in 34.5"
    } else if !number.is_empty() && rest.starts_with(['%', '°']) {
        "; leave the unit out: percent and degrees are understood"
    } else {
        ""
    }
}

/// Returns a hint at an unknown key: the known key that is most like it, or the table that it belongs to.
pub(super) fn meant(asked: &str, known: &[&str]) -> String {
    let is_at_top = FAMILIES.iter().any(|family| known.contains(&family.key));
    let mut families = FAMILIES.iter().filter(|_| is_at_top);
    if let Some(family) = families.find(|family| family.proportion(asked).is_some()) {
        return format!("; it belongs below a line [{}]", family.key);
    }
    nearest(asked, known).map_or(String::new(), |key| format!("; did you mean `{key}`?"))
}

/// Returns serde's message with keys for fields, numbers for f64, and the meaning of the key. `further` are known
/// keys that serde does not know.
fn reworded(message: &str, path: &str, further: &[&str]) -> String {
    if let Some(rest) = message.strip_prefix("unknown field ") {
        let mut keys = rest.split('`').skip(1).step_by(2);
        let asked = keys.next().unwrap_or_default();
        let known: Vec<&str> = keys.chain(further.iter().copied()).collect();
        let further: String = further.iter().map(|key| format!(", `{key}`")).collect();
        let rest = rest.replace("expected one of", "known here are");
        return format!("unknown key {rest}{further}{}", meant(asked, &known));
    }
    let table = path.split('.').next().unwrap_or_default();
    if let Some(rest) = message.strip_prefix("missing field ") {
        return format!("the key {rest} is missing{}", meaning(table, rest.trim_matches('`')));
    }
    in_plain_words(message) + &meaning(table, path.rsplit('.').next().unwrap_or_default())
}

/// Returns a message of serde with the names that people give to types.
pub(super) fn in_plain_words(message: &str) -> String {
    WORDS.iter().fold(message.to_owned(), |text, (serde, word)| text.replace(serde, word))
}

/// Returns the meaning of a key in brackets, where it is known; `table` is the top table of the file that holds the
/// key.
fn meaning(table: &str, key: &str) -> String {
    let row = Family::of_key(table).and_then(|family| family.proportion(key));
    let found = MEANINGS.iter().find(|(known, _)| *known == key).map(|(_, meaning)| (*meaning).to_owned());
    let number = LOOK_NUMBERS.into_iter().find(|row| row.key == key);
    let found = row.map(|row| row.hint()).or_else(|| number.map(NumberRow::hint)).or(found);
    found.map(|meaning| format!(" ({meaning})")).unwrap_or_default()
}
