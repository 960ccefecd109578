//! Reads Wavefront OBJ, by tobj in f64. tobj gets corners, faces, objects and groups, and normals only for opaque
//! bodies; lines and materials are kept from it, because they are not used and a fault in them is no reason to refuse
//! a mesh.

use super::limits;
use super::lines::Lines;
use super::parsed_mesh::ParsedMesh;
use super::statement::Statement;
use crate::io::file_error::Fault;
use crate::math::Surface;
use glam::DVec3;
use tobj::{LoadError, LoadOptions, Model};

/// The names that tobj gives to objects without a name.
const NAMELESS: [&str; 2] = ["unnamed_object", "default"];

pub(super) fn read(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    read_by(bytes, Odd::default())
}

/// Reads a mesh with its normals, or without them where they cannot be read.
pub(super) fn read_shaded(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    let shaded = read_by(bytes, Odd { keeps_normals: true, ..Odd::default() });
    shaded.or_else(|_| read(bytes))
}

fn read_by(bytes: &[u8], mut odd: Odd) -> Result<ParsedMesh, Fault> {
    let corners = bytes.split(|b| *b == b'\n').filter(|l| l.trim_ascii_start().starts_with(b"v ")).count();
    limits::count(corners, 0)?;
    let (mut lines, line) = Lines::new(bytes, |line, out: &mut Vec<u8>| odd.hand_on(line, out));
    let options =
        LoadOptions { single_index: true, triangulate: true, ignore_points: true, ignore_lines: true };
    let loaded = tobj::load_obj_buf(&mut lines, &options, |_| Err(LoadError::OpenFileFailed));
    let models = loaded.map_err(|error| fault(&error, line.get(), bytes))?.0;
    drop(lines);
    let (mut surface, mut normals) = (Surface::default(), vec![]);
    for model in models {
        limits::count(surface.vertices.len() + model.mesh.positions.len() / 3, surface.triangles.len())?;
        normals.extend(model.mesh.normals.as_chunks().0.iter().map(|&n: &[f64; 3]| DVec3::from(n)));
        surface.append(part(model));
        normals.resize(surface.vertices.len(), DVec3::ZERO);
    }
    let (name, said) = (odd.object.take(), odd.said.take());
    Ok(ParsedMesh { surface, normals, warnings: odd.warnings(), name, said, hint: None })
}

fn part(model: Model) -> Surface {
    let vertices = model.mesh.positions.chunks_exact(3).map(DVec3::from_slice).collect();
    let triangles = model.mesh.indices.as_chunks().0.to_vec();
    let name = if NAMELESS.contains(&model.name.as_str()) { String::new() } else { model.name };
    Surface { names: vec![name], ..Surface::new(vertices, triangles) }
}

/// A filter of lines for tobj, which counts the unusual lines that it keeps back.
#[derive(Default)]
struct Odd {
    keeps_normals: bool,
    continues: bool,
    curves: usize,
    short: usize,
    object: Option<String>,
    said: Option<String>,
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
        match key {
            _ if continued => out.extend(self.corners(text).as_bytes()),
            "v" => {
                // Only three numbers are passed on: a weight would be 1, and a colour is not used.
                out.extend(b"v ");
                out.extend(rest.split_whitespace().take(3).collect::<Vec<_>>().join(" ").as_bytes());
            }
            "f" if rest.split_whitespace().count() < 3 && !more => self.short += 1,
            "f" => {
                out.extend(b"f ");
                out.extend(self.corners(rest).as_bytes());
            }
            "vn" if self.keeps_normals => out.extend(text.as_bytes()),
            "o" | "g" => {
                if key == "o" && self.object.is_none() {
                    self.object = Some(rest.trim().to_owned());
                }
                out.extend(text.as_bytes());
            }
            "curv" | "curv2" | "surf" => self.curves += 1,
            _ => {}
        }
        out.push(if more { b' ' } else { b'\n' });
    }

    /// Returns the corners of a face without their texture coordinates, and without their normals where these are not kept.
    fn corners(&self, text: &str) -> String {
        let corner = |corner: &str| {
            let mut parts = corner.split('/');
            let (place, normal) = (parts.next().unwrap_or_default(), parts.nth(1).unwrap_or_default());
            match self.keeps_normals && !normal.is_empty() {
                true => format!("{place}//{normal} "),
                false => format!("{place} "),
            }
        };
        text.split_whitespace().map(corner).collect()
    }

    fn warnings(&self) -> Vec<String> {
        let left_out = |count: usize, what: &str| (count > 0).then(|| format!("{count} {what} left out"));
        let all = [
            left_out(self.curves, "curved surfaces, which no stone's facet is, are"),
            left_out(self.short, "faces of fewer than three corners are"),
        ];
        all.into_iter().flatten().collect()
    }
}

fn fault(error: &LoadError, line: usize, bytes: &[u8]) -> Fault {
    match error {
        LoadError::PositionParseError => Fault::line(line, "three numbers are expected after `v`"),
        LoadError::FaceParseError => {
            Fault::line(line, "three or more numbers of corners, from 1, are expected after `f`")
        }
        LoadError::FaceVertexOutOfBounds => match first_out_of_bounds(bytes) {
            Some((line, corner, count)) => {
                Fault::line(line, format!("the face refers to corner {corner}, and the file has {count}"))
            }
            None => Fault::line(line, "a face above refers to a corner that is not there"),
        },
        other => Fault::line(line, format!("this cannot be read: {other}")),
    }
}

/// Returns the first face that refers to a missing corner: its line, that corner, and the number of corners. tobj
/// finds such a face only when an object ends.
fn first_out_of_bounds(bytes: &[u8]) -> Option<(usize, i64, i64)> {
    let text = String::from_utf8_lossy(bytes);
    let total = text.lines().filter(|line| line.trim_start().starts_with("v ")).count() as i64;
    let lines = text.lines().enumerate().filter(|(_, line)| line.trim_start().starts_with("f "));
    let mut numbers = lines.flat_map(|(number, line)| {
        let corners =
            line.split_whitespace().skip(1).filter_map(|c| c.split('/').next()?.parse::<i64>().ok());
        corners.map(move |corner| (number + 1, corner, total))
    });
    numbers.find(|(_, corner, total)| corner > total)
}
