//! Writes a design as a GemCad text file.

use super::is_padding;
use crate::cutters;
use crate::design_file::EncodedDesign;
use brillianteer_cut::{Tier, Tiers, is_printable, with_finish};
use brillianteer_scene::Specimen;
use encoding_rs::WINDOWS_1252;
use std::fmt::Write;

/// The number of facets on a line that is written: GemCad's own lines end near there.
const PER_LINE: usize = 20;

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
    EncodedDesign { bytes: encoded(&out), lost }
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
        let breaks = |c: char| matches!(c, '\n' | '\r') || is_padding(c);
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
/// would be read as UTF-8. Lines end in CRLF, as GemCad writes them: programs that expect that read the last word of a line
/// that ends in LF alone wrongly.
fn encoded(text: &str) -> Vec<u8> {
    let text = text.replace('\n', "\r\n");
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
