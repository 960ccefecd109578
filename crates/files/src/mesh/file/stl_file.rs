//! Reads STL: binary by stl_io, text by a reader of its own. stl_io takes only texts that follow the format to the letter,
//! and of three corners; programs leave out normals, write more corners, and spell the words in several ways.

use super::limits;
use super::number::number;
use super::parsed_mesh::ParsedMesh;
use super::polygons::Polygons;
use super::sniff::{STL_HEADER, STL_START, STL_TRIANGLE, stl_triangles};
use super::statement::Statement;
use crate::encoding::with_line_feeds;
use crate::numbers::NumberReader;
use brillianteer_base::Fault;
use brillianteer_math::Surface;
use glam::DVec3;
use std::io::Cursor;
use std::str::SplitWhitespace;

/// The most characters of a word that a message quotes.
const QUOTED: usize = 40;

pub(super) fn read_binary(mut bytes: Vec<u8>) -> Result<ParsedMesh, Fault> {
    let announced = stl_triangles(&bytes).ok_or("this is too short for a binary STL")?;
    let (count, warning) = count(announced, bytes.len() - STL_START);
    limits::count(0, usize::try_from(count).unwrap_or(usize::MAX))?;
    let name = String::from_utf8_lossy(&bytes[..STL_HEADER]).trim_matches(['\0', ' ']).to_owned();
    // The header is not used any more, and with the word `solid` in it stl_io would take the file for text.
    bytes[..STL_HEADER].fill(0);
    bytes[STL_HEADER..STL_START].copy_from_slice(&u32::try_from(count).unwrap_or_default().to_le_bytes());
    let surface = triangles(bytes)?;
    let said = Statement::is_meant(&name).then(|| name.clone());
    let name = name.strip_prefix("solid").map(|n| n.trim().to_owned());
    Ok(ParsedMesh { surface, name, said, warnings: warning.into_iter().collect(), ..ParsedMesh::default() })
}

/// Returns the number of triangles to read where a header announces `announced` of them and `length` bytes follow it, and a
/// warning where the two disagree. The length decides, unless more bytes follow than the triangles need.
fn count(announced: u64, length: usize) -> (u64, Option<String>) {
    let (there, rest) = (length as u64 / STL_TRIANGLE, length as u64 % STL_TRIANGLE);
    if announced == there {
        return (announced, None);
    }
    if announced > 0 && announced < there && rest > 0 {
        let behind = length as u64 - announced * STL_TRIANGLE;
        let warning = format!(
            "offset {STL_HEADER}: {announced} triangles are announced; {behind} bytes behind them are left out"
        );
        return (announced, Some(warning));
    }
    let cut_off = if rest > 0 { "; the last one has been cut off" } else { "" };
    let warning = format!(
        "offset {STL_HEADER}: {announced} triangles are announced, and the file holds {there}, which are read{cut_off}"
    );
    (there, Some(warning))
}

/// Reads all triangles of a binary STL, each with corners of its own.
fn triangles(bytes: Vec<u8>) -> Result<Surface, Fault> {
    let unreadable = |number: usize| {
        Fault::part(format!("triangle {number}"), "its bytes cannot be read; save the file again as STL")
    };
    let mut reader = Cursor::new(bytes);
    let list = stl_io::create_stl_reader(&mut reader).map_err(|_| unreadable(1))?;
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for (number, triangle) in (1..).zip(list) {
        let triangle = triangle.map_err(|_| unreadable(number))?;
        let first = vertices.len() as u32;
        vertices.extend(triangle.vertices.map(|v| DVec3::from_array(v.0.map(f64::from))));
        triangles.push([first, first + 1, first + 2]);
    }
    Ok(Surface::new(vertices, triangles))
}

pub(super) fn read_text(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    let mut text = Text::default();
    for (number, line) in (1..).zip(with_line_feeds(bytes).split(|byte| *byte == b'\n')) {
        text.line = number;
        text.read(&String::from_utf8_lossy(line))?;
    }
    text.end_loop()?;
    let several = (text.solids > 1)
        .then(|| format!("{} solids are in this file; they are read as one surface", text.solids));
    let strange = text.strange.as_ref().map(|(word, line, count)| {
        let more = if *count > 1 { format!(", as {} more lines are", count - 1) } else { String::new() };
        format!("line {line}: `{word}` is not a word of STL; the line is left out{more}")
    });
    let warnings = [several, strange, text.polygons.warning("facets"), text.numbers.warning()];
    let warnings = warnings.into_iter().flatten().collect();
    Ok(ParsedMesh { surface: text.polygons.surface, warnings, name: text.name, ..ParsedMesh::default() })
}

/// Returns whether words begin a facet.
fn begins_facet(mut words: SplitWhitespace<'_>) -> bool {
    let mut is = |known: &[&str]| {
        words.next().is_some_and(|word| known.iter().any(|known| word.eq_ignore_ascii_case(known)))
    };
    is(&["facet"]) && is(&["normal", "outer"])
}

/// Returns whether a word goes on behind the normal of a facet.
fn is_after_normal(word: &str) -> bool {
    ["outer", "outerloop", "loop", "vertex"].iter().any(|known| word.eq_ignore_ascii_case(known))
}

/// A reader of the lines of a text.
#[derive(Default)]
struct Text {
    line: usize,
    solids: usize,
    name: Option<String>,
    polygons: Polygons,
    /// The corners of the loop that is open.
    corners: Vec<DVec3>,
    numbers: NumberReader,
    /// The first unknown word, its line, and how many lines begin with one.
    strange: Option<(String, usize, usize)>,
}

impl Text {
    fn read(&mut self, line: &str) -> Result<(), Fault> {
        let mut words = line.split_whitespace();
        while let Some(word) = words.next() {
            match word.to_ascii_lowercase().as_str() {
                "solid" => {
                    // The name may hold any word; the solid begins where a facet does.
                    let mut name = vec![];
                    while !begins_facet(words.clone()) {
                        let Some(word) = words.next() else { break };
                        name.push(word);
                    }
                    self.solid(&name.join(" "));
                }
                // The rest of such a line is a name or a colour.
                "endsolid" | "color" | "colour" => return Ok(()),
                "end" if words.next().is_some_and(|next| next.eq_ignore_ascii_case("solid")) => return Ok(()),
                "vertex" => self.vertex(&mut words)?,
                // A loop ends with its own word, in two writings, or with its facet.
                "facet" | "endfacet" | "endloop" | "end" => self.end_loop()?,
                // The normal is not used, whatever is written there.
                "normal" => {
                    while words.clone().next().is_some_and(|next| !is_after_normal(next)) {
                        words.next();
                    }
                }
                "outer" | "loop" | "outerloop" => {}
                _ if word.parse::<f64>().is_ok() || word.contains([',', '.']) => {}
                // Padding behind the last line.
                _ if word.chars().all(char::is_control) => {}
                _ => {
                    let quoted = || (word.chars().take(QUOTED).collect(), self.line, 0);
                    self.strange.get_or_insert_with(quoted).2 += 1;
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// Begins a solid. Several solids in one file, which some programs write, are groups of one surface.
    fn solid(&mut self, name: &str) {
        self.solids += 1;
        self.polygons.surface.names.push(name.to_owned());
        if self.solids == 1 && !name.is_empty() {
            self.name = Some(name.to_owned());
        }
    }

    fn vertex(&mut self, words: &mut SplitWhitespace<'_>) -> Result<(), Fault> {
        let mut at = DVec3::ZERO;
        for axis in 0..3 {
            let word = words
                .next()
                .ok_or_else(|| Fault::line(self.line, "three numbers are expected after `vertex`"))?;
            at[axis] = number(&mut self.numbers, word, self.line)?;
        }
        self.corners.push(at);
        Ok(())
    }

    fn end_loop(&mut self) -> Result<(), Fault> {
        if self.corners.is_empty() {
            return Ok(());
        }
        let first = self.polygons.surface.vertices.len() as u32;
        let corners: Vec<u32> = (first..).take(self.corners.len()).collect();
        self.polygons.surface.vertices.append(&mut self.corners);
        if self.polygons.surface.names.is_empty() {
            self.polygons.surface.names.push(String::new());
        }
        self.polygons.add(&corners);
        let Surface { vertices, triangles, .. } = &self.polygons.surface;
        limits::count(vertices.len(), triangles.len())
            .map_err(|fault| Fault { line: Some(self.line), ..fault })
    }
}
