//! Writes stones as meshes: OBJ with facets as polygons, STL, PLY and binary glTF with triangles.
//!
//! `scale` is in units of the file per girdle radius: for OBJ, PLY and STL the radius in mm, as is usual in the
//! trade; for glTF the radius in metres, as its standard requires. OBJ keeps 15 digits of the largest coordinate and
//! PLY all of f64; the others are f32. Every file states the direction, the size and the material of its stone, in a
//! [`Statement`]. OBJ and glTF keep the names of the facets. A solid that is not convex is written by its triangles.
//! Scenes, their stones with their metal, are written by `scene`.

mod glb;
mod ply;
mod scene;

pub use scene::{write_scene_glb, write_scene_obj, write_scene_ply, write_scene_stl};

use super::file::{MaterialHint, STL_HEADER, Statement};
use brillianteer_cut::MaterialRef;
use brillianteer_math::{Surface, rounded, triangulate};
use brillianteer_scene::Body;
use glam::DVec3;
use glb::{Buffers, Primitive, UPRIGHT, asset, material_json, used};
use serde_json::json;
use std::borrow::Cow;
use std::fmt::Write as _;

/// The key of a facet's name among the extras of its glTF primitive.
pub(super) const FACET: &str = "facet";

/// The key of the statement among the extras of a glTF node.
pub(super) const STATEMENT: &str = "brillianteer";

/// The number of digits of an OBJ's largest coordinate.
const DIGITS: f64 = 15.0;

/// The most decimals of an OBJ's coordinates, which the least f64 above 0 needs.
const MOST_DECIMALS: f64 = 340.0;

/// The most bytes of a statement in formats that set no other limit.
const LONGEST: usize = 400;

/// The number of millimetres in glTF's unit, the metre.
const METRE: f64 = 1000.0;

/// The number of steps into which a quarter of a turn of a smooth surface is cut.
pub const FINENESS: usize = 24;

/// A facet, or a triangle of a mesh: its name, its corners, counter-clockwise seen from outside, and the normals there.
struct Face<'a> {
    name: Option<&'a str>,
    corners: Vec<u32>,
    normals: Vec<DVec3>,
    /// The triangles of the facet, by corners of the solid.
    triangles: Vec<[u32; 3]>,
}

/// The corners of a solid, and the faces between them.
struct Faces<'a> {
    vertices: Cow<'a, [DVec3]>,
    faces: Vec<Face<'a>>,
}

impl Faces<'_> {
    /// Returns the statement of a file with `mm_per_unit` mm per unit, in which `up` is up: +z, or +y as in glTF.
    fn statement(
        &self,
        up: DVec3,
        mm_per_unit: f64,
        scale: f64,
        material: Option<&MaterialRef>,
    ) -> Statement {
        let triangles = self.faces.iter().flat_map(|face| face.triangles.iter().copied()).collect();
        let stone = Surface::new(self.vertices.to_vec(), triangles);
        Statement::of(&stone, up, mm_per_unit, scale * mm_per_unit, material)
    }
}

fn faces(body: &Body) -> Faces<'_> {
    match body {
        Body::Stone(stone) => {
            let mut triangles = vec![vec![]; stone.polytope.facets().len()];
            let mesh = triangulate(&stone.polytope);
            mesh.triangles.iter().zip(&mesh.facets).for_each(|(t, &f)| triangles[f as usize].push(*t));
            let facets = stone.polytope.facets().iter().zip(triangles).enumerate();
            let face = facets.map(|(place, (facet, triangles))| Face {
                name: stone.names().get(place).map(String::as_str),
                normals: vec![facet.plane.normal; facet.outline.len()],
                corners: facet.outline.clone(),
                triangles,
            });
            Faces { faces: face.collect(), vertices: stone.polytope.vertices().into() }
        }
        Body::Mesh(shell) => {
            let face = |(t, &f): (&[u32; 3], &u32)| nameless(*t, [shell.planes()[f as usize].normal; 3]);
            let faces = shell.surface().triangles.iter().zip(shell.facets()).map(face).collect();
            Faces { faces, vertices: shell.vertices().into() }
        }
        Body::Glass(smooth) => {
            let Surface { vertices, triangles, .. } = smooth.field().surface(FINENESS);
            let normals: Vec<DVec3> = vertices.iter().map(|v| smooth.field().normal(*v)).collect();
            let face = |t: &[u32; 3]| nameless(*t, t.map(|v| normals[v as usize]));
            Faces { faces: triangles.iter().map(face).collect(), vertices: vertices.into() }
        }
    }
}

fn nameless<'a>(triangle: [u32; 3], normals: [DVec3; 3]) -> Face<'a> {
    Face { name: None, corners: triangle.to_vec(), normals: normals.to_vec(), triangles: vec![triangle] }
}

/// Encodes a solid as OBJ, z up: each facet is a polygon in a group of its name.
pub fn write_obj(body: &Body, name: &str, scale: f64, material: Option<&MaterialRef>) -> String {
    let all = faces(body);
    let statement = all.statement(DVec3::Z, 1.0, scale, material).text(LONGEST);
    let Faces { faces, vertices } = all;
    let mut text = format!("# {} faces, mm, z up\n", faces.len());
    // Formatting into a String cannot fail.
    if let Some(statement) = statement {
        let _ = writeln!(text, "# {statement}");
    }
    let _ = writeln!(text, "o {name}");
    let decimals = decimals(vertices.iter().map(|v| scale * v.abs().max_element()).fold(0.0, f64::max));
    for v in vertices.iter() {
        let [x, y, z] = (*v * scale).to_array().map(|x| rounded(x, decimals));
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for face in faces {
        if let Some(name) = face.name {
            let _ = writeln!(text, "g {name}");
        }
        let corners: String = face.corners.iter().map(|v| format!(" {}", v + 1)).collect();
        let _ = writeln!(text, "f{corners}");
    }
    text
}

/// Returns the number of decimals of a file's coordinates, given the largest of them: enough for [`DIGITS`] digits. Digits
/// beyond are the rounding of f64.
fn decimals(largest: f64) -> usize {
    (DIGITS - 1.0 - largest.log10().floor()).clamp(0.0, MOST_DECIMALS) as usize
}

/// Encodes a solid as binary STL, z up. A statement that does not fit into its header is left out whole.
///
/// # Errors
/// Fails only for lack of memory: a list of bytes refuses nothing that is written to it.
pub fn write_stl(body: &Body, scale: f64, material: Option<&MaterialRef>) -> std::io::Result<Vec<u8>> {
    let all = faces(body);
    let statement = all.statement(DVec3::Z, 1.0, scale, material).text(STL_HEADER);
    let mut bytes = stl(&all, scale)?;
    if let Some(statement) = statement {
        bytes[..statement.len()].copy_from_slice(statement.as_bytes());
    }
    Ok(bytes)
}

/// Encodes faces as binary STL with an empty header.
fn stl(all: &Faces<'_>, scale: f64) -> std::io::Result<Vec<u8>> {
    let Faces { faces, vertices } = all;
    let vector = |v: DVec3| stl_io::Vector::new(v.as_vec3().to_array());
    let triangle = |face: &Face, corners: [u32; 3]| stl_io::Triangle {
        normal: vector(face.normals[0]),
        vertices: corners.map(|v| vector(vertices[v as usize] * scale)),
    };
    let each = faces.iter().flat_map(|face| face.triangles.iter().map(move |t| triangle(face, *t)));
    let triangles: Vec<stl_io::Triangle> = each.collect();
    let mut bytes = vec![];
    stl_io::write_stl(&mut bytes, triangles.iter())?;
    Ok(bytes)
}

/// The statements in the header of an STL.
pub struct Stated {
    /// True where it states the size of the stone and its direction.
    pub place: bool,
    /// True where it states the material.
    pub material: bool,
}

/// Returns the statements in the header of an STL that [`write_stl`] has encoded.
pub fn stated_in_stl(stl: &[u8]) -> Stated {
    let header = String::from_utf8_lossy(&stl[..stl.len().min(STL_HEADER)]);
    let stated = Statement::parse(header.trim_end_matches('\0')).ok();
    Stated { place: stated.is_some(), material: stated.is_some_and(|stated| stated.material.is_some()) }
}

/// Encodes a solid as binary PLY, z up.
///
/// # Errors
/// Fails only for lack of memory.
pub fn write_ply(body: &Body, scale: f64, material: Option<&MaterialRef>) -> std::io::Result<Vec<u8>> {
    let all = faces(body);
    let statement = all.statement(DVec3::Z, 1.0, scale, material).text(LONGEST);
    ply::written(&all, scale, statement)
}

/// Encodes a solid as binary glTF, y up.
///
/// Each named facet is a primitive with flat normals and its name among its extras; all triangles of a mesh are one
/// primitive. The material is written by its extensions.
///
/// # Errors
/// Fails only for lack of memory.
pub fn write_glb(
    body: &Body,
    name: &str,
    scale: f64,
    (hint, material): (&MaterialHint, Option<&MaterialRef>),
) -> Result<Vec<u8>, gltf::Error> {
    let mut parts = Buffers::default();
    let mut primitives = vec![];
    let all = faces(body);
    let statement = all.statement(DVec3::Y, METRE, scale, material).text(LONGEST);
    let Faces { faces, vertices } = all;
    let mut nameless = Primitive::default();
    for face in faces {
        let mut own = Primitive::default();
        let primitive = if face.name.is_some() { &mut own } else { &mut nameless };
        primitive.add(&face, &vertices, scale);
        if let Some(name) = face.name {
            primitives.push(parts.primitive(Some(name), &own, 0));
        }
    }
    if !nameless.triangles.is_empty() {
        primitives.push(parts.primitive(None, &nameless, 0));
    }
    let content = json!({
        "asset": asset(),
        "scene": 0,
        "scenes": [{ "name": name, "nodes": [0] }],
        "nodes": [{ "name": name, "mesh": 0, "rotation": UPRIGHT, "extras": { STATEMENT: statement } }],
        "meshes": [{ "name": name, "primitives": primitives }],
        "materials": [material_json(hint, scale)],
        "extensionsUsed": used(&material_json(hint, scale)),
    });
    parts.encoded(content)
}
