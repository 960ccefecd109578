//! Reads Wavefront OBJ, by tobj in f64. tobj gets corners, faces, objects and groups, and normals only for opaque
//! bodies; lines and materials are kept from it, because they are not used and a fault in them is no reason to refuse
//! a mesh.

use super::limits;
use super::lines::Lines;
use super::number::number;
use super::parsed_mesh::ParsedMesh;
use super::polygons::Polygons;
use super::statement::Statement;
use crate::encoding::with_line_feeds;
use crate::numbers::NumberReader;
use brillianteer_base::Fault;
use glam::DVec3;
use std::cell::Cell;
use std::rc::Rc;
use tobj::{LoadError, LoadOptions, Model};

/// The names that tobj gives to objects without a name.
const NAMELESS: [&str; 2] = ["unnamed_object", "default"];

pub(super) fn read(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    read_by(bytes, false)
}

/// Reads a mesh with its normals, or without them where they cannot be read.
pub(super) fn read_shaded(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    read_by(bytes, true).or_else(|_| read(bytes))
}

fn read_by(bytes: &[u8], keeps_normals: bool) -> Result<ParsedMesh, Fault> {
    let bytes = &*with_line_feeds(bytes);
    let corners = bytes.split(|b| *b == b'\n').filter(|l| l.trim_ascii_start().starts_with(b"v ")).count();
    limits::count(corners, 0)?;
    let line = Rc::new(Cell::new(0));
    let mut odd = Odd { keeps_normals, line: line.clone(), ..Odd::default() };
    let mut lines = Lines::new(bytes, line.clone(), |line, out: &mut Vec<u8>| odd.hand_on(line, out));
    let options = LoadOptions { single_index: true, ..LoadOptions::default() };
    let loaded = tobj::load_obj_buf(&mut lines, &options, |_| Err(LoadError::OpenFileFailed));
    drop(lines);
    if let Some(fault) = odd.fault.take() {
        return Err(fault);
    }
    let models = loaded.map_err(|error| fault(&error, line.get(), bytes))?.0;
    let (mut polygons, mut normals) = (Polygons::default(), vec![]);
    for model in models {
        normals.extend(model.mesh.normals.as_chunks().0.iter().map(|&n: &[f64; 3]| DVec3::from(n)));
        gather(model, &mut polygons)?;
        normals.resize(polygons.surface.vertices.len(), DVec3::ZERO);
    }
    let (name, said) = (odd.object.take(), odd.said.take());
    let left_out = |count: usize, what: &str| (count > 0).then(|| format!("{count} {what} left out"));
    let curves = left_out(odd.curves, "curved surfaces, which no stone's facet is, are");
    polygons.short += odd.short;
    let warnings = [curves, polygons.warning("faces"), odd.numbers.warning()];
    let warnings = warnings.into_iter().flatten().collect();
    Ok(ParsedMesh { surface: polygons.surface, normals, warnings, name, said, ..ParsedMesh::default() })
}

/// Adds the faces of an object or a group as a group with its name.
fn gather(model: Model, polygons: &mut Polygons) -> Result<(), Fault> {
    let first = polygons.surface.vertices.len() as u32;
    let vertices = model.mesh.positions.chunks_exact(3).map(DVec3::from_slice);
    polygons.surface.vertices.extend(vertices);
    polygons.surface.names.push(if NAMELESS.contains(&model.name.as_str()) {
        String::new()
    } else {
        model.name
    });
    let corners: Vec<u32> = model.mesh.indices.iter().map(|corner| first + corner).collect();
    let mut rest = corners.as_slice();
    // A mesh of triangles alone lists no numbers of corners.
    let numbers = model.mesh.face_arities.iter().map(|&count| count as usize).chain(std::iter::repeat(3));
    for count in numbers {
        if rest.is_empty() {
            break;
        }
        let (face, later) = rest.split_at(count.min(rest.len()));
        polygons.add(face);
        limits::count(polygons.surface.vertices.len(), polygons.surface.triangles.len())?;
        rest = later;
    }
    Ok(())
}

/// A filter of lines for tobj, which counts the unusual lines that it keeps back.
#[derive(Default)]
struct Odd {
    keeps_normals: bool,
    /// The number of the line that is handed on.
    line: Rc<Cell<usize>>,
    continues: bool,
    curves: usize,
    short: usize,
    numbers: NumberReader,
    object: Option<String>,
    said: Option<String>,
    /// The first fault that tobj would not name.
    fault: Option<Fault>,
}

impl Odd {
    fn hand_on(&mut self, line: &[u8], out: &mut Vec<u8>) {
        let text = String::from_utf8_lossy(line);
        let (text, comment) = text.split_once('#').unwrap_or((&text, ""));
        if self.said.is_none() && Statement::is_meant(comment) {
            self.said = Some(comment.to_owned());
        }
        let text = text.trim();
        let (text, more) = text.strip_suffix('\\').map_or((text, false), |text| (text, true));
        let continued = std::mem::replace(&mut self.continues, more);
        let (key, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        match key.to_ascii_lowercase().as_str() {
            _ if continued => out.extend(self.corners(text).as_bytes()),
            "v" => self.position(rest, out),
            "f" | "fo" if rest.split_whitespace().count() < 3 && !more => self.short += 1,
            "f" | "fo" => {
                out.extend(b"f ");
                out.extend(self.corners(rest).as_bytes());
            }
            "vn" if self.keeps_normals => out.extend(text.as_bytes()),
            word @ ("o" | "g") => {
                if word == "o" && self.object.is_none() {
                    self.object = Some(rest.trim().to_owned());
                }
                out.extend(format!("{word} {rest}").as_bytes());
            }
            "curv" | "curv2" | "surf" => self.curves += 1,
            _ => {}
        }
        out.push(if more { b' ' } else { b'\n' });
    }

    /// Hands on the position of a corner: only its three numbers, because a weight would be 1, and a colour is not used.
    fn position(&mut self, rest: &str, out: &mut Vec<u8>) {
        out.extend(b"v");
        let is_plain = |byte: u8| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E');
        for text in rest.split_whitespace().take(3) {
            out.push(b' ');
            if text.bytes().all(is_plain) {
                out.extend(text.as_bytes());
                continue;
            }
            match number(&mut self.numbers, text, self.line.get()) {
                Ok(number) => out.extend(number.to_string().as_bytes()),
                Err(fault) => drop(self.fault.get_or_insert(fault)),
            }
        }
    }

    /// Returns the corners of a face without their texture coordinates, and without their normals where these are not kept.
    fn corners(&self, text: &str) -> String {
        let corner = |corner: &str| {
            let mut parts = corner.split('/');
            let (place, normal) = (parts.next().unwrap_or_default(), parts.nth(1).unwrap_or_default());
            if self.keeps_normals && !normal.is_empty() {
                format!("{place}//{normal} ")
            } else {
                format!("{place} ")
            }
        };
        text.split_whitespace().map(corner).collect()
    }
}

fn fault(error: &LoadError, line: usize, bytes: &[u8]) -> Fault {
    match error {
        LoadError::PositionParseError => Fault::line(line, "three numbers are expected after `v`"),
        LoadError::FaceParseError => {
            Fault::line(line, "three or more numbers of corners, from 1, are expected after `f`")
        }
        LoadError::FaceVertexOutOfBounds => first_out_of_bounds(bytes)
            .unwrap_or_else(|| Fault::line(line, "a face above refers to a corner that is not there")),
        _ => Fault::line(line, "this line cannot be read; save the file again as OBJ"),
    }
}

/// Returns the fault of the first face that refers to a missing corner. tobj finds such a face only when an object ends.
fn first_out_of_bounds(bytes: &[u8]) -> Option<Fault> {
    let text = String::from_utf8_lossy(bytes);
    let word = |line: &str| line.split_whitespace().next().unwrap_or_default().to_ascii_lowercase();
    let total = text.lines().filter(|line| word(line) == "v").count() as i64;
    let mut above = 0;
    for (number, line) in (1..).zip(text.lines()) {
        above += i64::from(word(line) == "v");
        if !matches!(word(line).as_str(), "f" | "fo") {
            continue;
        }
        let corners =
            line.split_whitespace().skip(1).filter_map(|c| c.split('/').next()?.parse::<i64>().ok());
        for corner in corners {
            let message = match corner {
                0 => "the face refers to corner 0; numbers of corners count from 1".to_owned(),
                _ if corner > total => {
                    format!("the face refers to corner {corner}, and the file has {total}")
                }
                _ if -corner > above => {
                    format!("the face refers to corner {corner}, and {above} are above it")
                }
                _ => continue,
            };
            return Some(Fault::line(number, message));
        }
    }
    None
}
