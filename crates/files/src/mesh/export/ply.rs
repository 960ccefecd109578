//! Writes PLY, by ply-rs-bw: binary, little-endian, corners in f64. Facets are written as triangles, because many programs
//! read no others.

use super::Faces;
use glam::DVec3;
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Ply, PropertyAccess, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

/// A row of the file: the position of a corner, or the corners of a triangle.
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
    let triangle = |corners: &[u32; 3]| Row {
        at: DVec3::ZERO,
        corners: corners.iter().map(|&v| i32::try_from(v).unwrap_or_default()).collect(),
    };
    let triangles = faces.faces.iter().flat_map(|face| face.triangles.iter().map(triangle));
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
    ply.payload.insert("face".to_owned(), triangles.collect());
    let mut bytes = vec![];
    Writer::new().write_ply(&mut bytes, &mut ply)?;
    Ok(bytes)
}
