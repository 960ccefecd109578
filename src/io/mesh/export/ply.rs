//! Writes PLY, by ply-rs-bw: binary, little-endian, corners in f64.

use super::Faces;
use glam::DVec3;
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Ply, PropertyAccess, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

/// The most corners of a polygon: their number is a byte, as most readers expect. Polygons with more are written as
/// triangles.
const MOST_CORNERS: usize = 255;

/// A row of the file: the position of a corner, or the corners of a polygon.
#[derive(Debug, Default)]
struct Row {
    at: DVec3,
    corners: Vec<i32>,
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self::default()
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        match name {
            "x" => Some(self.at.x),
            "y" => Some(self.at.y),
            "z" => Some(self.at.z),
            _ => None,
        }
    }

    fn get_list_int(&self, _: &str) -> Option<&[i32]> {
        Some(&self.corners)
    }
}

/// Encodes faces as PLY, with a comment if there is one.
pub(super) fn written(faces: &Faces<'_>, scale: f64, comment: Option<String>) -> std::io::Result<Vec<u8>> {
    let corner = |v: &DVec3| Row { at: *v * scale, corners: vec![] };
    let polygon = |corners: &[u32]| Row {
        at: DVec3::ZERO,
        corners: corners.iter().map(|&v| i32::try_from(v).unwrap_or_default()).collect(),
    };
    let polygons = faces.faces.iter().flat_map(|face| match face.corners.len() <= MOST_CORNERS {
        true => vec![polygon(&face.corners)],
        false => face.triangles.iter().map(|t| polygon(t)).collect(),
    });
    let mut ply = Ply::<Row>::new();
    ply.header.encoding = Encoding::BinaryLittleEndian;
    ply.header.comments.push("mm, z up".to_owned());
    ply.header.comments.extend(comment);
    let number = |name: &str| PropertyDef::new(name.to_owned(), PropertyType::Scalar(ScalarType::Double));
    let list = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    let list = PropertyDef::new("vertex_indices".to_owned(), list);
    for (name, properties) in [("vertex", ["x", "y", "z"].map(number).to_vec()), ("face", vec![list])] {
        let mut element = ElementDef::new(name.to_owned());
        properties.into_iter().for_each(|property| element.properties.add(property));
        ply.header.elements.add(element);
    }
    ply.payload.insert("vertex".to_owned(), faces.vertices.iter().map(corner).collect());
    ply.payload.insert("face".to_owned(), polygons.collect());
    let mut bytes = vec![];
    Writer::new().write_ply(&mut bytes, &mut ply)?;
    Ok(bytes)
}
