//! Reads and writes GemCad's text files, `.asc`. Each record is a line that begins with a letter; a list of facets may
//! continue on lines that begin with a blank. The format is described in docs/formats.md.
//!
//! A line that cannot be understood gives a warning, and the stone opens all the same. The file's texts (names,
//! instructions, headers) are kept.

use super::cutters::{self, Gear, WarningList};
use super::design_file::ImportedDesign;
use super::encoding::{self, is_padding};
use super::numbers::{NumberReader, Token};
use super::text::check_size;
use brillianteer_base::Fault;
use brillianteer_cut::{Indexed, MAX_PLANES, Tier, Tiers};
use std::borrow::Cow;

#[cfg(test)]
mod tests;
mod write;

pub use write::write;

/// The size of the largest file that is read, in bytes.
pub const MAX_BYTES: usize = 16 << 20;

/// The index of refraction of a file that gives none: that of quartz, which most designs are for.
const USUAL_INDEX: f64 = 1.54;

/// Returns whether a file's first bytes look like a GemCad text file.
pub fn looks_like(bytes: &[u8]) -> bool {
    let text = decoded(&bytes[..bytes.len().min(4096)]);
    let mut lines = lines(&text).map(str::trim_start).filter(|line| !line.is_empty());
    let first = lines.next().unwrap_or_default();
    let is_facet = |line: &str| {
        let (letter, rest) = record_of(line.trim_start());
        letter.eq_ignore_ascii_case("a")
            && rest.split_whitespace().take(3).filter(|t| Token::of(t).number().is_some()).count() == 3
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

/// Decodes text without the padding that some programs leave.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let text = encoding::decoded(bytes, None).text;
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
    numbers: NumberReader,
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
        self.numbers.read(text, self.number)
    }

    fn line(&mut self, line: &str) -> Result<(), Fault> {
        let trimmed = line.trim();
        let (first, _) = word(trimmed);
        if first.is_empty() {
            return Ok(());
        }
        // GemCad's own continuations begin with a blank; other programs leave it out.
        let goes_on = Token::of(first).is_numeric() || (self.in_tier && matches!(first, "n" | "N" | "G"));
        if goes_on && (self.in_tier || self.tiers.is_empty()) {
            return self.go_on(trimmed);
        }
        self.end_tier();
        let (letter, rest) = record_of(trimmed);
        match letter {
            "H" | "h" => self.headers.push(text_after(line)),
            "F" | "f" => self.footers.push(text_after(line)),
            "g" | "G" => self.gear(rest)?,
            "y" | "Y" => self.symmetry(rest),
            "I" | "i" => self.index_of_refraction(rest)?,
            "a" | "A" => self.tier(rest)?,
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
        let mut tokens = rest.split_whitespace();
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
        // The letter of the mirror may follow the number without a blank.
        let end = rest.find(|c: char| c.is_whitespace() || c.is_alphabetic()).unwrap_or(rest.len());
        let (fold, mirror) = rest.split_at(end);
        match Token::of(fold.trim_end_matches([',', ';'])) {
            Token::Number(fold) if fold.is_finite() => {
                self.symmetry = Some(cutters::symmetry(fold as i32, &self.place(), &mut self.warnings));
            }
            _ => self.warn(&format!("'{}' is not a symmetry; a number is expected", short(rest))),
        }
        self.mirror = word(mirror).0.starts_with(['y', 'Y']);
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
        let mut rest = line.trim_start();
        while !rest.is_empty() {
            let (token, after) = word(rest);
            match token {
                "G" | "g" => {
                    self.instructions(after);
                    break;
                }
                "n" | "N" => {
                    let (name, after) = word(after);
                    rest = after;
                    self.named(name);
                }
                _ => {
                    rest = after;
                    self.index_or_glued(token)?;
                }
            }
            rest = rest.trim_start();
        }
        Ok(())
    }

    fn instructions(&mut self, text: &str) {
        let Some(tier) = self.tiers.last_mut() else { return };
        if !tier.instructions.is_empty() {
            tier.instructions.push(' ');
        }
        tier.instructions.push_str(text.trim_end());
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

    /// Reads an index, a name that follows its letter without a blank, or an index and such a name.
    fn index_or_glued(&mut self, token: &str) -> Result<(), Fault> {
        let (index, name) = token.split_once(['n', 'N']).map_or((token, None), |(a, b)| (a, Some(b)));
        let is_glued =
            (index.is_empty() || Token::of(index).number().is_some()) && !Token::of(token).is_numeric();
        let Some(name) = name.filter(|_| is_glued) else { return self.index(token) };
        if !index.is_empty() {
            self.index(index)?;
        }
        self.named(name);
        Ok(())
    }

    fn index(&mut self, token: &str) -> Result<(), Fault> {
        // A list may have commas as well as blanks.
        let token = if token.len() > 1 { token.trim_end_matches([',', ';']) } else { token };
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

    fn brought(mut self, label: &str) -> Result<ImportedDesign, Fault> {
        let mut missing = |what: bool, text: &str| what.then(|| self.warnings.warn(|| text.to_owned()));
        missing(self.gear.is_none(), "the file names no index gear; one of 96 teeth is assumed");
        missing(self.ri.is_none(), "the file names no index of refraction; 1.54 is assumed");
        self.numbers.warning().into_iter().for_each(|text| self.warnings.warn(|| text));
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
    let text = text.trim_start();
    text.split_once(char::is_whitespace).unwrap_or((text, ""))
}

/// Parts a record into its letter and the rest. A number may follow g, y, I and a without a blank, and y or n the number of
/// a symmetry.
fn record_of(line: &str) -> (&str, &str) {
    let (first, rest) = word(line);
    let glued = first.strip_prefix(['g', 'G', 'y', 'Y', 'I', 'i', 'a', 'A']);
    let number = glued.map(|glued| {
        if first.starts_with(['y', 'Y']) {
            glued.trim_end_matches(['y', 'Y', 'n', 'N', ',', ';'])
        } else {
            glued
        }
    });
    let is_glued = number.is_some_and(|number| Token::of(number).is_numeric());
    if is_glued { line.split_at(1) } else { (first, rest.trim_start()) }
}

/// Returns the text behind a record's letter and one blank.
fn text_after(line: &str) -> String {
    let rest = &line.trim_start()[1..];
    rest.strip_prefix([' ', '\t']).unwrap_or(rest).to_owned()
}

/// Returns as much of a text as fits into a message.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}
