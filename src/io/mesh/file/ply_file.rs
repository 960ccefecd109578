//! Reads PLY, text and binary, by ply-rs-bw.

use super::limits::{self, MAX_VERTICES};
use super::parsed_mesh::ParsedMesh;
use super::statement::Statement;
use crate::io::file_error::Fault;
use crate::math::Surface;
use glam::DVec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Header, Property, PropertyAccess, PropertyAccessResult};
use std::io::Read as _;

/// The size of the longest header that is read, in bytes: hundreds of comments.
const MAX_HEADER: usize = 1 << 20;

/// The used values of a row of a file: the position of a corner, or the corners of a face.
#[derive(Default)]
struct Row {
    at: DVec3,
    corners: Vec<i64>,
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let place = match name {
            "x" => &mut self.at.x,
            "y" => &mut self.at.y,
            "z" => &mut self.at.z,
            "vertex_indices" | "vertex_index" => return self.set_corners(value),
            _ => return PropertyAccessResult::Ignored,
        };
        match number(&value) {
            Some(number) => *place = number,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl Row {
    fn set_corners(&mut self, value: Property) -> PropertyAccessResult {
        self.corners = match value {
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

fn number(value: &Property) -> Option<f64> {
    Some(match value {
        Property::Char(n) => f64::from(*n),
        Property::UChar(n) => f64::from(*n),
        Property::Short(n) => f64::from(*n),
        Property::UShort(n) => f64::from(*n),
        Property::Int(n) => f64::from(*n),
        Property::UInt(n) => f64::from(*n),
        Property::Float(n) => f64::from(*n),
        Property::Double(n) => *n,
        _ => return None,
    })
}

pub(super) fn read(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    let end = b"end_header";
    let beginning = &bytes[..bytes.len().min(MAX_HEADER)];
    let Some(header) = beginning.windows(end.len()).position(|w| w == end) else {
        return Err("the header has no end; a line `end_header` is expected".into());
    };
    // Comments may be in any encoding.
    let readable: Vec<u8> = bytes[..header].iter().map(|b| if b.is_ascii() { *b } else { b'?' }).collect();
    let parser = Parser::<Row>::new();
    let mut reader = Reader::new(readable.as_slice().chain(&bytes[header..]));
    let header = parser.read_header(&mut reader).map_err(fault)?;
    check(&header)?;
    let mut surface = Surface::new(vec![], vec![]);
    let mut warnings = vec![];
    for (name, element) in &header.elements {
        let rows = parser.read_payload_for_element(&mut reader, element, &header).map_err(fault)?;
        match name.as_str() {
            "vertex" => surface.vertices = rows.into_iter().map(|row| row.at).collect(),
            "face" => faces(rows, &mut surface)?,
            "tristrips" => warnings.push("strips of triangles are not read; save faces".to_owned()),
            _ => {}
        }
    }
    let said = header.comments.iter().find(|comment| Statement::is_meant(comment)).cloned();
    Ok(ParsedMesh { surface, warnings, said, ..ParsedMesh::default() })
}

/// Checks that the counts in a header are of a sane size, before anything is read by them, and that it has corners and
/// faces.
fn check(header: &Header) -> Result<(), Fault> {
    for (name, element) in &header.elements {
        if element.count > MAX_VERTICES || element.properties.is_empty() && element.count > 0 {
            let message = format!(
                "{} rows of {} properties are announced; at most {MAX_VERTICES} rows of one or more are expected",
                element.count,
                element.properties.len()
            );
            return Err(Fault::part(format!("element {name}"), message));
        }
    }
    let lacks = |element: &str, names: &[&str]| {
        let there =
            header.elements.get(element).is_some_and(|e| names.iter().any(|n| e.properties.contains_key(*n)));
        (!there).then(|| Fault::part("header", format!("`{}` of element `{element}` is expected", names[0])))
    };
    let coordinates = ["x", "y", "z"].iter().find_map(|name| lacks("vertex", &[name]));
    let missing = coordinates.or_else(|| lacks("face", &["vertex_indices", "vertex_index"]));
    missing.map_or(Ok(()), Err)
}

fn faces(rows: Vec<Row>, surface: &mut Surface) -> Result<(), Fault> {
    for (number, row) in (1..).zip(rows) {
        let corner = |&n: &i64| {
            u32::try_from(n).map_err(|_| {
                let message = format!("it refers to corner {n}; a number from 0 is expected");
                Fault::part(format!("face {number}"), message)
            })
        };
        let corners = row.corners.iter().map(corner).collect::<Result<Vec<u32>, _>>()?;
        for pair in corners.get(1..).unwrap_or_default().windows(2) {
            surface.triangles.push([corners[0], pair[0], pair[1]]);
            surface.groups.push(0);
        }
        limits::count(0, surface.triangles.len())?;
    }
    Ok(())
}

#[allow(clippy::needless_pass_by_value, reason = "it maps an error")]
fn fault(error: ParseError) -> Fault {
    let message = format!("this cannot be read: {error}");
    match error.line() {
        Some(line) => Fault::line(line, message),
        None => Fault::whole(message),
    }
}
