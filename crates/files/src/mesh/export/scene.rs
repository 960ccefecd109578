//! Writes a scene, its stones and its metal where they lie, as one mesh.
//!
//! OBJ, PLY and STL are in mm with z up; glTF is in metres with y up. glTF has a node and a material for each body, and one mesh
//! for all bodies that share it; OBJ has an object for each body, and the name of its material; in PLY and STL the triangles
//! of all bodies are joined. No file states where the table of a stone is, since there are several stones.

use super::glb::{Buffers, Primitive, UPRIGHT, asset, material_json, used};
use super::{Face, Faces, METRE, decimals, faces, nameless, ply, stl};
use crate::mesh::file::MaterialHint;
use brillianteer_math::{Pose, ShadedSurface, rounded};
use brillianteer_scene::{Instance, MetalInstance, Scene};
use glam::DVec3;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::sync::Arc;

/// A body of a scene.
#[derive(Clone, Copy)]
enum SceneBody<'a> {
    Stone(&'a Instance),
    Metal(&'a MetalInstance),
}

impl<'a> SceneBody<'a> {
    /// Returns the bodies of a scene, the stones first, each with its number among those of its kind, from 1.
    fn all(scene: &'a Scene) -> impl Iterator<Item = (usize, Self)> {
        let stones = scene.instances.iter().enumerate().map(|(place, stone)| (place + 1, Self::Stone(stone)));
        let metals = scene.metals.iter().enumerate().map(|(place, metal)| (place + 1, Self::Metal(metal)));
        stones.chain(metals)
    }

    /// Returns the name of the body in files, on one line.
    fn name(self, number: usize) -> String {
        let (kind, label) = match self {
            Self::Stone(stone) => ("stone", &stone.label),
            Self::Metal(metal) => ("metal", &metal.label),
        };
        let label = label.replace(char::is_control, " ");
        if label.is_empty() { format!("{kind} {number}") } else { format!("{kind} {number}, {label}") }
    }

    fn material(self) -> String {
        match self {
            Self::Stone(stone) => stone.material.name.replace(char::is_control, " "),
            Self::Metal(metal) => metal.metal.name().to_owned(),
        }
    }

    fn pose(self) -> Pose {
        match self {
            Self::Stone(stone) => stone.pose,
            Self::Metal(metal) => metal.pose,
        }
    }

    /// Returns the faces of the body in its own frame.
    fn faces(self) -> Faces<'a> {
        match self {
            Self::Stone(stone) => faces(&stone.body),
            Self::Metal(metal) => faces_of_metal(metal.mesh.surface()),
        }
    }

    /// Returns whether two bodies have one shape in one size and one material.
    fn is_alike(self, other: Self) -> bool {
        let is_shaped = match (self, other) {
            (Self::Stone(a), Self::Stone(b)) => Arc::ptr_eq(&a.body, &b.body) && a.material == b.material,
            (Self::Metal(a), Self::Metal(b)) => {
                Arc::ptr_eq(&a.mesh, &b.mesh) && (a.metal, a.roughness) == (b.metal, b.roughness)
            }
            _ => false,
        };
        is_shaped && self.pose().scale == other.pose().scale
    }

    /// Returns the shape of the body as glTF has it, not yet placed; `scale` are units of the file per unit of its frame.
    fn primitive(self, scale: f64) -> Primitive {
        let mut shape = Primitive::default();
        match self {
            Self::Metal(metal) if !metal.mesh.surface().normals.is_empty() => {
                let ShadedSurface { points, corners, normals } = metal.mesh.surface();
                shape.corners = points.iter().map(|point| *point * scale).collect();
                shape.normals.clone_from(normals);
                shape.triangles = corners.iter().flatten().copied().collect();
            }
            _ => {
                let Faces { faces, vertices } = self.faces();
                faces.iter().for_each(|face| shape.add(face, &vertices, scale));
            }
        }
        shape
    }

    /// Returns the material of the body as glTF has it; `scale` are units of the file per unit of the body's frame.
    fn material_json(self, scale: f64) -> Value {
        match self {
            Self::Stone(stone) => material_json(&MaterialHint::of(&stone.material, METRE), scale),
            Self::Metal(metal) => {
                let [red, green, blue] = metal.metal.colour().to_array();
                json!({
                    "name": metal.metal.name(),
                    "pbrMetallicRoughness": { "baseColorFactor": [red, green, blue, 1.0],
                        "metallicFactor": 1.0, "roughnessFactor": metal.roughness },
                    "doubleSided": true,
                })
            }
        }
    }
}

fn faces_of_metal(surface: &ShadedSurface) -> Faces<'_> {
    let face = |(number, corners): (usize, &[u32; 3])| {
        let [a, b, c] = surface.triangle(number);
        let flat = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Z);
        nameless(*corners, [flat; 3])
    };
    let faces = surface.corners.iter().enumerate().map(face).collect();
    Faces { faces, vertices: surface.points.as_slice().into() }
}

/// Returns the pose that carries a body into the scene, in mm.
fn in_mm(body: SceneBody<'_>, scene: &Scene) -> Pose {
    Pose { scale: scene.unit_mm, ..Pose::STILL }.after(&body.pose())
}

/// Returns the faces of all bodies in one list, in mm.
fn joined(scene: &Scene) -> Faces<'static> {
    let (mut vertices, mut all) = (vec![], vec![]);
    for (_, body) in SceneBody::all(scene) {
        let first = vertices.len() as u32;
        let (pose, own) = (in_mm(body, scene), body.faces());
        vertices.extend(own.vertices.iter().map(|v| pose.place(*v)));
        all.extend(own.faces.into_iter().map(|face| Face {
            name: None,
            corners: face.corners.iter().map(|v| first + v).collect(),
            normals: face.normals.iter().map(|normal| pose.turn * *normal).collect(),
            triangles: face.triangles.iter().map(|t| t.map(|v| first + v)).collect(),
        }));
    }
    Faces { vertices: vertices.into(), faces: all }
}

/// Encodes a scene as binary STL.
///
/// # Errors
/// Fails only for lack of memory.
pub fn write_scene_stl(scene: &Scene) -> std::io::Result<Vec<u8>> {
    stl(&joined(scene), 1.0)
}

/// Encodes a scene as binary PLY.
///
/// # Errors
/// Fails only for lack of memory.
pub fn write_scene_ply(scene: &Scene) -> std::io::Result<Vec<u8>> {
    ply::written(&joined(scene), 1.0, None)
}

/// Encodes a scene as OBJ: each body is an object, facets of stones are polygons, and metal has its normals.
pub fn write_scene_obj(scene: &Scene) -> String {
    let mut text = String::from("# the bodies of a scene, mm, z up\n");
    let decimals =
        decimals(scene.vertices().map(|v| scene.unit_mm * v.abs().max_element()).fold(0.0, f64::max));
    let (mut first, mut first_normal) = (1, 1);
    // Formatting into a String cannot fail.
    for (number, body) in SceneBody::all(scene) {
        let (pose, Faces { faces, vertices }) = (in_mm(body, scene), body.faces());
        let _ = writeln!(text, "o {}\nusemtl {}", body.name(number), body.material());
        for v in vertices.iter() {
            let [x, y, z] = pose.place(*v).to_array().map(|x| rounded(x, decimals));
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        let normals = match body {
            SceneBody::Metal(metal) => metal.mesh.surface().normals.as_slice(),
            SceneBody::Stone(_) => &[],
        };
        for normal in normals {
            let DVec3 { x, y, z } = pose.turn * *normal;
            let _ = writeln!(text, "vn {x} {y} {z}");
        }
        for face in faces {
            let corner = |v: &u32| {
                if normals.is_empty() {
                    format!(" {}", first + v)
                } else {
                    format!(" {}//{}", first + v, first_normal + v)
                }
            };
            let _ = writeln!(text, "f{}", face.corners.iter().map(corner).collect::<String>());
        }
        first += vertices.len() as u32;
        first_normal += normals.len() as u32;
    }
    text
}

/// Encodes a scene as binary glTF.
///
/// # Errors
/// Fails only for lack of memory.
pub fn write_scene_glb(scene: &Scene, name: &str) -> Result<Vec<u8>, gltf::Error> {
    let mut buffers = Buffers::default();
    let (mut nodes, mut meshes, mut materials) = (vec![], vec![], vec![]);
    // A body of each mesh.
    let mut kinds: Vec<SceneBody> = vec![];
    for (number, body) in SceneBody::all(scene) {
        let Pose { at, turn, scale } = in_mm(body, scene);
        let mesh = kinds.iter().position(|kind| kind.is_alike(body)).unwrap_or_else(|| {
            let material = body.material_json(scale / METRE);
            let place = materials.iter().position(|known| *known == material).unwrap_or(materials.len());
            if place == materials.len() {
                materials.push(material);
            }
            let shape = buffers.primitive(None, &body.primitive(scale / METRE), place);
            meshes.push(json!({ "name": body.name(number), "primitives": [shape] }));
            kinds.push(body);
            kinds.len() - 1
        });
        nodes.push(json!({ "name": body.name(number), "mesh": mesh, "translation": (at / METRE).to_array(),
            "rotation": turn.to_array() }));
    }
    let children: Vec<usize> = (1..=nodes.len()).collect();
    nodes.insert(0, json!({ "name": name, "children": children, "rotation": UPRIGHT }));
    let extensions: BTreeSet<String> = materials.iter().flat_map(used).collect();
    let mut content = json!({
        "asset": asset(),
        "scene": 0,
        "scenes": [{ "name": name, "nodes": [0] }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
    });
    // The standard allows no empty list.
    if !extensions.is_empty() {
        content["extensionsUsed"] = json!(extensions);
    }
    buffers.encoded(content)
}
