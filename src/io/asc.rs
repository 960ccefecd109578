//! Reads and writes GemCad's text files, `.asc`. Each record is a line that begins with a letter; a list of facets may
//! continue on lines that begin with a blank. The format is described in docs/formats.md.
//!
//! A line that cannot be understood gives a warning, and the stone opens all the same. The file's texts (names,
//! instructions, headers) are kept.

use super::cutters::{self, Gear, WarningList};
use super::design_file::{EncodedDesign, ImportedDesign};
use super::file_error::Fault;
use super::text::check_size;
use crate::cut::{Indexed, MAX_PLANES, Tier, Tiers, is_printable, with_finish};
use crate::scene::Specimen;
use encoding_rs::WINDOWS_1252;
use number::Token;
use std::borrow::Cow;
use std::fmt::Write;

pub(super) mod number;
#[cfg(test)]
mod tests;

/// The size of the largest file that is read, in bytes.
pub const MAX_BYTES: usize = 16 << 20;

/// The number of facets on a line that is written: GemCad's own lines end near there.
const PER_LINE: usize = 20;

/// The index of refraction of a file that gives none: that of quartz, which most designs are for.
const USUAL_INDEX: f64 = 1.54;

/// Returns whether a file's first bytes look like a GemCad text file.
pub fn looks_like(bytes: &[u8]) -> bool {
    let text = decoded(&bytes[..bytes.len().min(4096)]);
    let mut lines = text.lines().map(str::trim_start).filter(|line| !line.is_empty());
    let first = lines.next().unwrap_or_default();
    let is_facet = |line: &str| {
        let mut tokens = line.split_ascii_whitespace();
        tokens.next() == Some("a") && tokens.take(3).filter(|t| Token::of(t).number().is_some()).count() == 3
    };
    first.get(..6).is_some_and(|word| word.eq_ignore_ascii_case("gemcad"))
        || is_facet(first)
        || lines.any(is_facet)
}

/// Reads a GemCad text file; `label` is the path of the file, which names a design without a title.
///
/// # Errors
/// Fails where the file is too large, lists no facet or more than a stone may have, or makes no valid design. The
/// error has the line where one is at fault.
pub fn read(bytes: &[u8], label: &str) -> Result<ImportedDesign, Fault> {
    check_size(bytes.len(), MAX_BYTES as u64)?;
    let mut reader = Reader::default();
    let text = decoded(bytes);
    for (number, line) in (1..).zip(lines(&text)) {
        reader.number = number;
        reader.line(line)?;
        if reader.count > MAX_PLANES {
            let problem = format!("more than {MAX_PLANES} facets are listed; no stone has so many");
            return Err(Fault::line(number, problem));
        }
    }
    if reader.in_tier && !text.ends_with(['\n', '\r']) {
        reader.warn("the file ends here, within a tier and without an end of the line; it may be cut off");
    }
    reader.end_tier();
    if reader.count == 0 {
        let problem =
            "no facet is listed; a line such as `a 41.0 0.65 96 24 48 72` is expected for each tier";
        return Err(problem.into());
    }
    reader.brought(label)
}

/// Decodes UTF-8, or else Windows-1252, and drops the padding that some programs leave.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let text = std::str::from_utf8(bytes)
        .map_or_else(|_| WINDOWS_1252.decode_without_bom_handling(bytes).0, Cow::Borrowed);
    let is_padding = |c: char| matches!(c, '\0' | '\u{1a}' | '\u{feff}');
    if text.contains(is_padding) { Cow::Owned(text.replace(is_padding, "")) } else { text }
}

/// Splits text into lines that end in LF, CRLF or, as on old Macs, CR.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'))
}

#[derive(Default)]
struct Reader {
    number: usize,
    gear: Option<Gear>,
    symmetry: Option<u32>,
    mirror: bool,
    ri: Option<f64>,
    headers: Vec<String>,
    footers: Vec<String>,
    tiers: Vec<Tier>,
    /// The line where each tier begins.
    tier_lines: Vec<usize>,
    /// True where the line before was part of a tier, so that this line may continue it.
    in_tier: bool,
    /// A name that was read before the index that it belongs to.
    name: Option<String>,
    count: usize,
    /// The first number with a decimal comma, the line where it stands, and how many there are.
    commas: Option<(String, usize, usize)>,
    warnings: WarningList,
}

impl Reader {
    fn warn(&mut self, what: &str) {
        let place = self.place();
        self.warnings.warn(|| place + what);
    }

    /// Returns the beginning of a message about this line.
    fn place(&self) -> String {
        format!("line {}: ", self.number)
    }

    fn fault(&self, problem: String) -> Fault {
        Fault::line(self.number, problem)
    }

    /// Reads a number, also with a decimal comma; `None` where the text is no number.
    fn number(&mut self, text: &str) -> Result<Option<f64>, Fault> {
        match Token::of(text) {
            Token::Number(number) => Ok(Some(number)),
            Token::WithComma(number) => {
                self.commas.get_or_insert_with(|| (text.to_owned(), self.number, 0)).2 += 1;
                Ok(Some(number))
            }
            Token::Broken => Err(self.fault(format!(
                "'{}' is not a number; write a decimal point, and blanks between numbers",
                short(text)
            ))),
            Token::Word => Ok(None),
        }
    }

    fn line(&mut self, line: &str) -> Result<(), Fault> {
        let trimmed = line.trim_ascii();
        let (first, _) = word(trimmed);
        if first.is_empty() {
            return Ok(());
        }
        let goes_on =
            Token::of(first).is_numeric() || (line.starts_with([' ', '\t']) && matches!(first, "n" | "G"));
        if goes_on && (self.in_tier || self.tiers.is_empty()) {
            return self.go_on(trimmed);
        }
        self.end_tier();
        let (letter, rest) = record_of(trimmed);
        match letter {
            "H" | "h" => self.headers.push(text_after(line)),
            "F" | "f" => self.footers.push(text_after(line)),
            "g" => self.gear(rest)?,
            "y" => self.symmetry(rest),
            "I" | "i" => self.index_of_refraction(rest)?,
            "a" => self.tier(rest)?,
            _ if first.get(..6).is_some_and(|word| word.eq_ignore_ascii_case("gemcad")) => {}
            _ => self.warn(&format!("'{}' is not a known record and is left out", short(trimmed))),
        }
        Ok(())
    }

    /// Reads a line without a record's letter: the continuation of a tier, or a gear whose letter was left out.
    fn go_on(&mut self, line: &str) -> Result<(), Fault> {
        if self.in_tier {
            return self.facets(line);
        }
        if self.gear.is_none() {
            return self.gear(line);
        }
        self.warn(&format!("'{}' belongs to no tier and is left out", short(line)));
        Ok(())
    }

    fn gear(&mut self, rest: &str) -> Result<(), Fault> {
        let mut tokens = rest.split_ascii_whitespace();
        let teeth = self.number(tokens.next().unwrap_or_default())?.filter(|teeth| teeth.fract() == 0.0);
        let Some(teeth) = teeth else {
            self.warn(&format!("'{}' is not a gear; a number of teeth is expected", short(rest)));
            return Ok(());
        };
        let offset = self.number(tokens.next().unwrap_or("0"))?.unwrap_or_else(|| {
            self.warn("the gear's offset is not a number and is read as 0");
            0.0
        });
        self.gear = Some(Gear::given(teeth as i32, offset, &self.place(), &mut self.warnings));
        Ok(())
    }

    fn symmetry(&mut self, rest: &str) {
        let mut tokens = rest.split_ascii_whitespace();
        match tokens.next().map(str::parse::<f64>) {
            Some(Ok(fold)) if fold.is_finite() => {
                self.symmetry = Some(cutters::symmetry(fold as i32, &self.place(), &mut self.warnings));
            }
            _ => self.warn(&format!("'{}' is not a symmetry; a number is expected", short(rest))),
        }
        self.mirror = tokens.next().is_some_and(|word| word.starts_with(['y', 'Y']));
    }

    fn index_of_refraction(&mut self, rest: &str) -> Result<(), Fault> {
        match self.number(word(rest).0)? {
            Some(ri) => self.ri = Some(ri),
            None => {
                self.warn(&format!("'{}' is not an index of refraction; a number is expected", short(rest)));
            }
        }
        Ok(())
    }

    fn tier(&mut self, rest: &str) -> Result<(), Fault> {
        let (angle, after) = word(rest);
        let (distance, after) = word(after);
        let (Some(angle), Some(distance)) = (self.number(angle)?, self.number(distance)?) else {
            self.warn(&format!("'a {}' has no angle and distance, and is left out", short(rest)));
            return Ok(());
        };
        if !(angle.is_finite() && distance.is_finite()) {
            self.warn(&format!("'a {}' has an infinite angle or distance, and is left out", short(rest)));
            return Ok(());
        }
        self.tier_lines.push(self.number);
        self.tiers.push(Tier {
            angle,
            distance,
            instructions: String::new(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets: vec![],
        });
        (self.in_tier, self.name) = (true, None);
        self.facets(after)
    }

    /// Reads indices, names and instructions of the open tier.
    fn facets(&mut self, line: &str) -> Result<(), Fault> {
        let mut rest = line.trim_ascii_start();
        while !rest.is_empty() {
            let (token, after) = word(rest);
            rest = after.trim_ascii_start();
            match token {
                "G" => {
                    self.instructions(after);
                    break;
                }
                "n" => {
                    let (name, after) = word(rest);
                    rest = after.trim_ascii_start();
                    self.named(name);
                }
                _ => self.index(token)?,
            }
        }
        Ok(())
    }

    fn instructions(&mut self, text: &str) {
        let Some(tier) = self.tiers.last_mut() else { return };
        if !tier.instructions.is_empty() {
            tier.instructions.push(' ');
        }
        tier.instructions.push_str(text.trim_ascii_end());
    }

    fn named(&mut self, name: &str) {
        let last = self.tiers.last_mut().and_then(|tier| tier.facets.last_mut());
        match last {
            _ if name.is_empty() => self.warn("a name is missing after n"),
            Some(facet) if facet.name.is_empty() => name.clone_into(&mut facet.name),
            Some(facet) => {
                let other = std::mem::replace(&mut facet.name, name.to_owned());
                self.warn(&format!(
                    "a facet has two names, '{}' and '{}'; the second is used",
                    short(&other),
                    short(name)
                ));
            }
            None => self.name = Some(name.to_owned()),
        }
    }

    fn index(&mut self, token: &str) -> Result<(), Fault> {
        let Some(tier) = self.tiers.last_mut() else { return Ok(()) };
        match Token::of(token) {
            Token::Number(index) if index.is_finite() => {
                tier.facets.push(Indexed { index, name: self.name.take().unwrap_or_default() });
                self.count += 1;
            }
            // Read as one index between two teeth, the token makes one facet; read as two indices, it makes two facets, and
            // so another stone.
            Token::WithComma(_) | Token::Broken => {
                return Err(self.fault(format!(
                    "'{}' may be one index or several; write a decimal point, and blanks between indices",
                    short(token)
                )));
            }
            _ => self.warn(&format!("'{}' is not an index of a facet, and is left out", short(token))),
        }
        Ok(())
    }

    /// Ends the open tier. A tier without indices cuts nothing and is dropped, except for a table, whose index means
    /// nothing.
    fn end_tier(&mut self) {
        self.in_tier = false;
        let Some(tier) = self.tiers.last_mut().filter(|tier| tier.facets.is_empty()) else { return };
        if tier.angle == 0.0 {
            tier.facets.push(Indexed { index: 0.0, name: self.name.take().unwrap_or_default() });
            self.count += 1;
        } else {
            self.tiers.pop();
            self.tier_lines.pop();
            self.warn("the tier before has no indices, and is left out");
        }
    }

    fn warn_of_commas(&mut self) {
        let Some((first, line, count)) = self.commas.take() else { return };
        let number = first.replace(',', ".");
        let others = match count - 1 {
            0 => String::new(),
            others => format!(", and so are {others} more numbers"),
        };
        self.warnings.warn(|| {
            format!("line {line}: '{first}' has a decimal comma and is read as {number}{others}; write decimal points")
        });
    }

    fn brought(mut self, label: &str) -> Result<ImportedDesign, Fault> {
        let mut missing = |what: bool, text: &str| what.then(|| self.warnings.warn(|| text.to_owned()));
        missing(self.gear.is_none(), "the file names no index gear; one of 96 teeth is assumed");
        missing(self.ri.is_none(), "the file names no index of refraction; 1.54 is assumed");
        self.warn_of_commas();
        let name = cutters::title(&self.headers, label);
        let material = cutters::material(self.ri.unwrap_or(USUAL_INDEX), "", &mut self.warnings);
        let mut tiers = Tiers {
            symmetry: self.symmetry.unwrap_or(1),
            mirror: self.mirror,
            headers: self.headers,
            footers: self.footers,
            tiers: self.tiers,
            ..self.gear.unwrap_or_default().tiers()
        };
        cutters::finish_as_said(&mut tiers, &mut self.warnings);
        for beyond in tiers.beyond_gear() {
            let line = self.tier_lines[beyond.tier - 1];
            self.warnings.warn(|| format!("line {line}: {beyond}"));
        }
        cutters::brought(name, material, tiers, self.warnings)
    }
}

/// Parts a text into its first word and the rest after the blank.
fn word(text: &str) -> (&str, &str) {
    let text = text.trim_ascii_start();
    text.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((text, ""))
}

/// Parts a record into its letter and the rest. A number may follow g, y, I and a without a blank.
fn record_of(line: &str) -> (&str, &str) {
    let (first, rest) = word(line);
    let is_glued = first.starts_with(['g', 'y', 'I', 'a']) && first[1..].parse::<f64>().is_ok();
    if is_glued { line.split_at(1) } else { (first, rest.trim_ascii_start()) }
}

/// Returns the text behind a record's letter and one blank.
fn text_after(line: &str) -> String {
    let rest = &line.trim_ascii_start()[1..];
    rest.strip_prefix([' ', '\t']).unwrap_or(rest).to_owned()
}

/// Returns as much of a text as fits into a message.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Encodes the design of a specimen as a GemCad text file.
pub fn write(specimen: &Specimen) -> EncodedDesign {
    let mut lost = vec![];
    let tiers = cutters::tiers_of(specimen, &mut lost).into_owned();
    let ri = cutters::refractive_index(specimen, &mut lost);
    let title = tiers.headers.iter().find(|header| is_printable(header.trim()));
    cutters::untold(&specimen.design, title, &mut lost);
    let mut out = String::from("GemCad 5.0\n");
    let _ = writeln!(out, "g {} {:?}", tiers.gear, tiers.offset);
    let _ = writeln!(out, "y {} {}", tiers.symmetry, if tiers.mirror { 'y' } else { 'n' });
    let _ = writeln!(out, "I {ri}");
    let mut texts = Texts::default();
    for header in &tiers.headers {
        let _ = writeln!(out, "{}", record('H', &texts.line(header)));
    }
    for tier in tiers.tiers.iter().filter(|tier| tier.is_cut && !tier.facets.is_empty()) {
        write_tier(&mut out, tier, &mut texts);
    }
    for footer in &tiers.footers {
        let _ = writeln!(out, "{}", record('F', &texts.line(footer)));
    }
    lost.extend(texts.lost());
    lost.extend(left_out(&tiers));
    EncodedDesign { bytes: encoded(out), lost }
}

/// Returns messages about the parts of a design's tiers that the format cannot hold.
fn left_out(tiers: &Tiers) -> Vec<String> {
    let uncut = tiers.tiers.iter().filter(|tier| !tier.is_cut || tier.facets.is_empty()).count();
    let keys: Vec<&str> = tiers.remarks.keys().map(String::as_str).collect();
    let mut lost = vec![];
    if uncut > 0 {
        lost.push(format!("{uncut} tiers that cut nothing are left out"));
    }
    if !keys.is_empty() {
        lost.push(format!("the format cannot hold these remarks: {}", keys.join(", ")));
    }
    lost
}

/// Fits texts into lines and words, and remembers the changes.
#[derive(Default)]
struct Texts {
    are_joined: bool,
    are_filled: bool,
}

impl Texts {
    /// Returns the text on one line, with a blank in place of each line break.
    fn line(&mut self, text: &str) -> String {
        let breaks = |c: char| matches!(c, '\n' | '\r' | '\0' | '\u{1a}' | '\u{feff}');
        self.are_joined |= text.contains(breaks);
        text.replace(breaks, " ")
    }

    /// Returns the text as one word, with `_` in place of each blank.
    fn word(&mut self, text: &str) -> String {
        let blank = |c: char| c.is_whitespace() || c.is_control();
        self.are_filled |= text.contains(blank);
        text.replace(blank, "_")
    }

    fn lost(&self) -> impl Iterator<Item = String> {
        let joined = self.are_joined.then_some("lines within a text are joined");
        let filled = self.are_filled.then_some("blanks in names of facets become _");
        joined.into_iter().chain(filled).map(str::to_owned)
    }
}

/// Encodes text in Windows-1252, which GemCad expects, or in UTF-8 where Windows-1252 cannot hold the text or its bytes
/// would be read as UTF-8.
fn encoded(text: String) -> Vec<u8> {
    let (bytes, _, is_lossy) = WINDOWS_1252.encode(&text);
    let is_read_as_utf8 = !text.is_ascii() && std::str::from_utf8(&bytes).is_ok();
    if is_lossy || is_read_as_utf8 { text.into_bytes() } else { bytes.into_owned() }
}

fn record(letter: char, text: &str) -> String {
    if text.is_empty() { letter.to_string() } else { format!("{letter} {text}") }
}

fn write_tier(out: &mut String, tier: &Tier, texts: &mut Texts) {
    let _ = write!(out, "a {} {}", tier.angle, tier.distance);
    for (k, facet) in tier.facets.iter().enumerate() {
        if k > 0 && k % PER_LINE == 0 {
            out.push('\n');
        }
        let _ = write!(out, " {}", facet.index);
        if !facet.name.is_empty() {
            let _ = write!(out, " n {}", texts.word(&facet.name));
        }
    }
    let instruction = with_finish(tier.instruction(), tier.frosting);
    if !instruction.is_empty() {
        let _ = write!(out, " G {}", texts.line(&instruction));
    }
    out.push('\n');
}
