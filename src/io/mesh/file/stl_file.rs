//! Reads STL, binary and text, by stl_io.

use super::limits;
use super::lines::{Lines, Rewound};
use super::parsed_mesh::ParsedMesh;
use super::sniff::{STL_HEADER, STL_START, STL_TRIANGLE, stl_triangles};
use super::statement::Statement;
use crate::io::file_error::Fault;
use crate::math::Surface;
use glam::DVec3;
use std::io::Cursor;

/// The first line that stl_io expects of a text.
const FIRST: &[u8] = b"solid stone\n";

pub(super) fn read_binary(mut bytes: Vec<u8>) -> Result<ParsedMesh, Fault> {
    let count = stl_triangles(&bytes).ok_or("this is too short for a binary STL")?;
    let there = (bytes.len() as u64).saturating_sub(STL_START as u64) / STL_TRIANGLE;
    if count > there {
        let message =
            format!("{count} triangles are announced, and the file holds {there}; it has been cut off");
        return Err(Fault::part(format!("offset {STL_HEADER}"), message));
    }
    limits::count(0, usize::try_from(count).unwrap_or(usize::MAX))?;
    let name = String::from_utf8_lossy(&bytes[..STL_HEADER]).trim_matches(['\0', ' ']).to_owned();
    // The header is not used any more, and with the word `solid` in it stl_io would take the file for text.
    bytes[..STL_HEADER].fill(0);
    let surface = triangles(&mut Cursor::new(bytes))
        .map_err(|(number, message)| Fault::part(format!("triangle {number}"), message))?;
    let said = Statement::is_meant(&name).then(|| name.clone());
    let name = name.strip_prefix("solid").map(|n| n.trim().to_owned());
    Ok(ParsedMesh { surface, name, said, ..ParsedMesh::default() })
}

pub(super) fn read_text(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    let mut first = true;
    let mut name = None;
    let mut solids = 0_usize;
    let change = |line: &[u8], out: &mut Vec<u8>| {
        let text = String::from_utf8_lossy(line);
        let text = text.trim_start_matches('\u{feff}').trim();
        let lower = text.to_ascii_lowercase();
        // Several solids in one file, which some programs write, are read as one.
        if lower.starts_with("solid") {
            solids += 1;
            let own = text[5..].trim();
            if std::mem::take(&mut first) && !own.is_empty() {
                name = Some(own.to_owned());
            }
        } else if !lower.starts_with("endsolid") && !lower.is_empty() {
            out.extend(lower.as_bytes());
            out.push(b'\n');
        }
    };
    // The lines `solid` and `endsolid` are left out above, and put around the whole: the first by `Rewound`, the last here.
    let (lines, line) = Lines::new(bytes, change);
    let closed = std::io::Read::chain(lines, &b"endsolid stone\n"[..]);
    let surface = triangles(&mut Rewound::new(FIRST, closed))
        .map_err(|(_, message)| Fault::line(line.get().max(1), message))?;
    let warnings = (solids > 1)
        .then(|| format!("{solids} solids are in this file; they are read as one surface"))
        .into_iter()
        .collect();
    Ok(ParsedMesh { surface, warnings, name, ..ParsedMesh::default() })
}

/// Reads all triangles, each with corners of its own; else returns the number, from 1, of the triangle that cannot be read,
/// and why.
fn triangles<R: std::io::Read + std::io::Seek>(reader: &mut R) -> Result<Surface, (usize, String)> {
    let unreadable = |number: usize, error: std::io::Error| (number, format!("this cannot be read: {error}"));
    let list = stl_io::create_stl_reader(reader).map_err(|error| unreadable(1, error))?;
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for (number, triangle) in (1..).zip(list) {
        let triangle = triangle.map_err(|error| unreadable(number, error))?;
        let corners = triangle.vertices.map(|v| v.0.map(f64::from));
        if let Some(bad) = corners.iter().find(|c| !c.iter().all(|x| x.is_finite())) {
            return Err((
                number,
                format!("{bad:?} is not a finite position; finite coordinates are expected"),
            ));
        }
        let first = vertices.len() as u32;
        vertices.extend(corners.map(DVec3::from_array));
        triangles.push([first, first + 1, first + 2]);
        limits::count(0, triangles.len()).map_err(|fault| (number, fault.problem))?;
    }
    Ok(Surface::new(vertices, triangles))
}
