//! Reads the scene of a glTF file: its nodes with their transforms, and the triangles of their meshes.

use super::super::hint::MaterialHint;
use super::super::limits;
use super::super::parsed_mesh::ParsedMesh;
use super::buffers::{self, Data};
use crate::io::file_error::Fault;
use crate::io::mesh::export::{FACET, STATEMENT};
use crate::math::Surface;
use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::Mode;
use gltf::scene::Transform;
use gltf::{Document, Material, Node, Primitive, Semantic};
use std::collections::BTreeMap;

/// The greatest depth of nodes within one another; deeper nodes are taken for a cycle.
const MOST_NESTED: usize = 100;

/// The most nodes that are visited; a node that is used twice counts twice.
const MOST_NODES: usize = 100_000;

/// Gathers all triangles of the scene.
pub(super) fn gather(document: &Document, data: &Data) -> Result<ParsedMesh, Fault> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let roots: Vec<Node<'_>> = match scene {
        Some(scene) => scene.nodes().collect(),
        None => rootless(document),
    };
    let mut gatherer =
        Gatherer { data, mesh: ParsedMesh::default(), visited: 0, materials: BTreeMap::new(), skipped: 0 };
    for root in roots {
        gatherer.node(&root, DAffine3::IDENTITY, 0)?;
    }
    gatherer.finish(document)
}

/// Returns the nodes that are no node's children, for a file without scenes.
fn rootless(document: &Document) -> Vec<Node<'_>> {
    let mut child = vec![false; document.nodes().len()];
    document.nodes().flat_map(|n| n.children().collect::<Vec<_>>()).for_each(|c| child[c.index()] = true);
    document.nodes().filter(|n| !child[n.index()]).collect()
}

struct Gatherer<'a> {
    data: &'a Data,
    mesh: ParsedMesh,
    visited: usize,
    /// The number of triangles of each material that is described, by the material's number.
    materials: BTreeMap<usize, usize>,
    skipped: usize,
}

impl Gatherer<'_> {
    fn node(&mut self, node: &Node<'_>, above: DAffine3, depth: usize) -> Result<(), Fault> {
        self.visited += 1;
        if depth > MOST_NESTED || self.visited > MOST_NODES {
            let message = format!(
                "nodes are nested more than {MOST_NESTED} deep, or there are more than {MOST_NODES}; perhaps a node \
                    contains itself"
            );
            return Err(Fault::part(format!("node {}", node.index()), message));
        }
        let placed = above * transform(&node.transform());
        if self.mesh.said.is_none() {
            self.mesh.said = text_of(node.extras(), STATEMENT);
        }
        if let Some(mesh) = node.mesh() {
            let name = mesh.name().or(node.name()).unwrap_or_default();
            for primitive in mesh.primitives() {
                self.primitive(&primitive, name, placed).map_err(|fault| {
                    let joint = if fault.key.is_some() { ", " } else { ": " };
                    let own = format!("mesh {}, primitive {}{joint}", mesh.index(), primitive.index());
                    fault.within(&own, &own)
                })?;
            }
        }
        node.children().try_for_each(|child| self.node(&child, placed, depth + 1))
    }

    fn primitive(&mut self, primitive: &Primitive<'_>, name: &str, placed: DAffine3) -> Result<(), Fault> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.skipped += 1;
            return Ok(());
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            return Err("it has no POSITION; places of its corners are expected".into());
        };
        buffers::check(&positions, &[DataType::F32], Dimensions::Vec3, self.data)?;
        if let Some(indices) = primitive.indices() {
            let types = [DataType::U8, DataType::U16, DataType::U32];
            buffers::check(&indices, &types, Dimensions::Scalar, self.data)?;
        }
        let reader = primitive.reader(|buffer| self.data.get(buffer.index()).map(Vec::as_slice));
        let unreadable = || Fault::whole("its corners cannot be read");
        let at = |p: [f32; 3]| placed.transform_point3(DVec3::from_array(p.map(f64::from)));
        let vertices: Vec<DVec3> = reader.read_positions().ok_or_else(unreadable)?.map(at).collect();
        let normals = self.normals(primitive, placed);
        let order: Vec<u32> = match primitive.indices() {
            Some(_) => reader.read_indices().ok_or_else(unreadable)?.into_u32().collect(),
            None => (0..vertices.len() as u32).collect(),
        };
        if let Some(bad) = order.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(format!("it refers to corner {bad}, from 0, and there are {}", vertices.len()).into());
        }
        let triangles = triangles(&order, mode);
        let whole = &self.mesh.surface;
        limits::count(whole.vertices.len() + vertices.len(), whole.triangles.len() + triangles.len())?;
        if let Some(index) = primitive.material().index().filter(|_| hint(&primitive.material()).is_some()) {
            *self.materials.entry(index).or_default() += triangles.len();
        }
        let name = text_of(primitive.extras(), FACET).unwrap_or_else(|| name.to_owned());
        self.mesh.normals.extend(normals);
        self.mesh.surface.append(Surface { names: vec![name], ..Surface::new(vertices, triangles) });
        self.mesh.normals.resize(self.mesh.surface.vertices.len(), DVec3::ZERO);
        Ok(())
    }

    /// Returns the normals of a primitive's corners; none where they cannot be read.
    fn normals(&self, primitive: &Primitive<'_>, placed: DAffine3) -> Vec<DVec3> {
        let reader = primitive.reader(|buffer| self.data.get(buffer.index()).map(Vec::as_slice));
        let is_sound = |accessor: &gltf::Accessor<'_>| {
            buffers::check(accessor, &[DataType::F32], Dimensions::Vec3, self.data).is_ok()
        };
        let turn = placed.matrix3.inverse().transpose();
        let corners = primitive.get(&Semantic::Positions).map_or(0, |positions| positions.count());
        let given = primitive.get(&Semantic::Normals).filter(is_sound).and_then(|_| reader.read_normals());
        given.into_iter().flatten().take(corners).map(|n| turn * DVec3::from(n.map(f64::from))).collect()
    }

    fn finish(mut self, document: &Document) -> Result<ParsedMesh, Fault> {
        let most = self.materials.iter().max_by_key(|(index, count)| (**count, std::cmp::Reverse(**index)));
        self.mesh.hint = most.and_then(|(&index, _)| hint(&document.materials().nth(index)?));
        let mut warn = |odd: bool, text: String| self.mesh.warnings.extend(odd.then_some(text));
        warn(self.skipped > 0, format!("{} parts of points or lines are left out", self.skipped));
        warn(
            self.materials.len() > 1,
            format!(
                "{} materials are described; the one that most triangles have is used",
                self.materials.len()
            ),
        );
        warn(
            document.skins().len() > 0,
            "the mesh is in the pose in which it was modelled; skins are not read".into(),
        );
        Ok(self.mesh)
    }
}

fn transform(given: &Transform) -> DAffine3 {
    match *given {
        Transform::Matrix { matrix } => {
            DAffine3::from_mat4(DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from))))
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let [t, s] = [translation, scale].map(|v| DVec3::from_array(v.map(f64::from)));
            let turn = DQuat::from_array(rotation.map(f64::from));
            // A rotation that has no length turns nothing.
            let turn = if turn.length() > 0.0 { turn * (1.0 / turn.length()) } else { DQuat::IDENTITY };
            DAffine3::from_scale_rotation_translation(s, turn, t)
        }
    }
}

fn triangles(order: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    let windows = || order.windows(3).map(|w| [w[0], w[1], w[2]]);
    match mode {
        Mode::TriangleStrip => {
            let turned = |(i, [a, b, c]): (usize, [u32; 3])| if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
            windows().enumerate().map(turned).collect()
        }
        Mode::TriangleFan => {
            order.get(1..).unwrap_or_default().windows(2).map(|w| [order[0], w[0], w[1]]).collect()
        }
        _ => order.as_chunks().0.to_vec(),
    }
}

/// Returns the text under a key of extras.
fn text_of(extras: &gltf::json::Extras, key: &str) -> Option<String> {
    let extras: serde_json::Value = serde_json::from_str(extras.as_ref()?.get()).ok()?;
    Some(extras.get(key)?.as_str()?.to_owned())
}

/// Returns the shortest number that f32 rounds to this one, without the digits that f32 adds: the one that someone
/// wrote.
fn as_written(number: f32) -> f64 {
    number.to_string().parse().unwrap_or_else(|_| number.into())
}

/// Returns the statements of a material about the passage of light, if it has any.
fn hint(material: &Material<'_>) -> Option<MaterialHint> {
    let dispersion = material.extension_value("KHR_materials_dispersion");
    let dispersion = dispersion.and_then(|value| value.get("dispersion")?.as_f64());
    let volume = material.volume();
    let attenuation =
        volume.map(|v| (v.attenuation_color().map(f64::from), f64::from(v.attenuation_distance())));
    let found = MaterialHint {
        name: material.name().map(str::to_owned),
        ior: material.ior().map(as_written),
        dispersion,
        attenuation: attenuation.filter(|(_, distance)| distance.is_finite() && *distance > 0.0),
        transmits: material.transmission().is_some_and(|t| t.transmission_factor() > 0.0),
    };
    let nothing = MaterialHint { name: found.name.clone(), ..MaterialHint::default() };
    (found != nothing).then_some(found)
}
