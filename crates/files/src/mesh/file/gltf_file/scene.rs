//! Reads the scene of a glTF file: its nodes with their transforms, and the triangles of their meshes.

use super::super::hint::MaterialHint;
use super::super::limits;
use super::super::parsed_mesh::ParsedMesh;
use super::buffers::{self, Data};
use super::draco::{self, Unpacked};
use super::instances;
use crate::mesh::export::{FACET, STATEMENT};
use brillianteer_base::Fault;
use brillianteer_math::Surface;
use glam::{DAffine3, DMat4, DVec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::{Mesh, Mode};
use gltf::scene::Transform;
use gltf::{Document, Material, Node, Primitive, Scene, Semantic};
use std::collections::{BTreeMap, BTreeSet};

/// The greatest depth of nodes within one another; deeper nodes are taken for a cycle.
const MOST_NESTED: usize = 100;

/// The most nodes that are visited; a node that is used twice counts twice.
const MOST_NODES: usize = 100_000;

/// The name of the extension that hides nodes.
pub(super) const HIDDEN: &str = "KHR_node_visibility";

/// Gathers all triangles of a scene, and returns them with the scene's name: of the default scene, or else of the first one
/// that has triangles.
pub(super) fn gather(document: &Document, data: &Data) -> Result<(ParsedMesh, Option<String>), Fault> {
    let default = document.default_scene();
    let first = default.as_ref().map(Scene::index);
    let others = document.scenes().filter(|scene| Some(scene.index()) != first);
    let scenes: Vec<Scene<'_>> = default.into_iter().chain(others).collect();
    let with_nodes = scenes.iter().filter(|scene| scene.nodes().len() > 0).count();
    for (place, scene) in scenes.iter().enumerate() {
        let mut mesh = gather_from(scene.nodes().collect(), document, data)?;
        if mesh.surface.triangles.is_empty() {
            continue;
        }
        let called = scene.name().map(|name| format!(" `{name:.60}`")).unwrap_or_default();
        if place > 0 || with_nodes > 1 {
            let read =
                format!("{} scenes are in the file; scene {}{called} is read", scenes.len(), scene.index());
            mesh.notes.push(if place > 0 {
                let others = if first.is_some() {
                    "the scene that is to be shown has"
                } else {
                    "those before it have"
                };
                format!("{read}, as {others} no triangles")
            } else {
                read
            });
        }
        return Ok((mesh, scene.name().map(str::to_owned)));
    }
    let mut mesh = gather_from(rootless(document), document, data)?;
    if mesh.surface.triangles.is_empty() {
        mesh = gather_unplaced(document, data)?;
    } else if !scenes.is_empty() {
        mesh.notes.push("no scene of the file has triangles; all its nodes are read".to_owned());
    }
    Ok((mesh, None))
}

/// Gathers the triangles of the meshes that no node places, where they were modelled.
fn gather_unplaced(document: &Document, data: &Data) -> Result<ParsedMesh, Fault> {
    let placed: BTreeSet<usize> =
        document.nodes().filter_map(|node| node.mesh()).map(|mesh| mesh.index()).collect();
    let mut gatherer = Gatherer::of(document, data);
    for mesh in document.meshes().filter(|mesh| !placed.contains(&mesh.index())) {
        let (name, weights) = (mesh.name().unwrap_or_default(), mesh.weights().unwrap_or_default());
        gatherer.mesh(&mesh, Posture { name, placed: DAffine3::IDENTITY, weights })?;
    }
    let mut mesh = gatherer.finish();
    if !mesh.surface.triangles.is_empty() {
        mesh.notes
            .push("no node places the meshes of the file; they are read as they were modelled".to_owned());
    }
    Ok(mesh)
}

fn gather_from(roots: Vec<Node<'_>>, document: &Document, data: &Data) -> Result<ParsedMesh, Fault> {
    let mut gatherer = Gatherer::of(document, data);
    for root in roots {
        gatherer.node(&root, DAffine3::IDENTITY, 0)?;
    }
    Ok(gatherer.finish())
}

/// Returns the nodes that are no node's children, for a file without scenes.
fn rootless(document: &Document) -> Vec<Node<'_>> {
    let mut child = vec![false; document.nodes().len()];
    document.nodes().flat_map(|n| n.children().collect::<Vec<_>>()).for_each(|c| child[c.index()] = true);
    document.nodes().filter(|n| !child[n.index()]).collect()
}

struct Gatherer<'a> {
    document: &'a Document,
    data: &'a Data,
    mesh: ParsedMesh,
    visited: usize,
    /// The number of triangles of each material that is described, by the material's number.
    materials: BTreeMap<usize, usize>,
    skipped: usize,
    hidden: usize,
    /// The number of parts with corners at the end that make no whole triangle.
    uneven: usize,
    /// The number of nodes whose matrix is no placement, and of those that state their placement twice.
    slanted: usize,
    doubled: usize,
}

/// Where the corners of a node's mesh lie, and what they are called.
#[derive(Clone, Copy)]
struct Posture<'a> {
    name: &'a str,
    placed: DAffine3,
    /// The part of each displacement of corners that is added.
    weights: &'a [f32],
}

impl<'a> Gatherer<'a> {
    fn of(document: &'a Document, data: &'a Data) -> Self {
        Gatherer {
            document,
            data,
            mesh: ParsedMesh::default(),
            visited: 0,
            materials: BTreeMap::new(),
            skipped: 0,
            hidden: 0,
            uneven: 0,
            slanted: 0,
            doubled: 0,
        }
    }

    /// Counts one more node or copy.
    fn visit(&mut self, node: &Node<'_>, depth: usize) -> Result<(), Fault> {
        self.visited += 1;
        if depth > MOST_NESTED || self.visited > MOST_NODES {
            let message = format!(
                "nodes are nested more than {MOST_NESTED} deep, or there are more than {MOST_NODES} with their copies; \
                 perhaps a node contains itself"
            );
            return Err(Fault::part(format!("node {}", node.index()), message));
        }
        Ok(())
    }

    fn node(&mut self, node: &Node<'_>, above: DAffine3, depth: usize) -> Result<(), Fault> {
        self.visit(node, depth)?;
        let visible = node.extension_value(HIDDEN).and_then(|extension| extension.get("visible")?.as_bool());
        if visible == Some(false) {
            self.hidden += 1;
            return Ok(());
        }
        self.mark_odd(node);
        let placed = above * transform(&node.transform());
        if self.mesh.said.is_none() {
            self.mesh.said = text_of(node.extras(), STATEMENT);
        }
        if let Some(mesh) = node.mesh() {
            // Several nodes may show one mesh, so that their own names tell them apart.
            let name = node.name().or(mesh.name()).unwrap_or_default();
            let weights = node.weights().or(mesh.weights()).unwrap_or_default();
            let place = format!("node {}", node.index());
            let copies = instances::places(node, self.document, self.data);
            for copy in copies.map_err(|fault| Fault::part(place, fault))? {
                self.visit(node, depth)?;
                self.mesh(&mesh, Posture { name, placed: placed * copy, weights })?;
            }
        }
        node.children().try_for_each(|child| self.node(&child, placed, depth + 1))
    }

    fn mesh(&mut self, mesh: &Mesh<'_>, posture: Posture<'_>) -> Result<(), Fault> {
        for primitive in mesh.primitives() {
            self.primitive(&primitive, posture).map_err(|fault| {
                let joint = if fault.key.is_some() { ", " } else { ": " };
                let own = format!("mesh {}, primitive {}{joint}", mesh.index(), primitive.index());
                fault.within(&own, &own)
            })?;
        }
        Ok(())
    }

    /// Counts a node whose placement is more or other than glTF allows.
    fn mark_odd(&mut self, node: &Node<'_>) {
        let Transform::Matrix { matrix } = node.transform() else { return };
        let last = matrix.map(|column| column[3]);
        self.slanted += usize::from(last != [0.0, 0.0, 0.0, 1.0]);
        let stated = &self.document.as_json().nodes[node.index()];
        let is_doubled = stated.translation.is_some() || stated.rotation.is_some() || stated.scale.is_some();
        self.doubled += usize::from(is_doubled);
    }

    fn primitive(&mut self, primitive: &Primitive<'_>, posture: Posture<'_>) -> Result<(), Fault> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.skipped += 1;
            return Ok(());
        }
        let (mut vertices, order) = match draco::unpacked(primitive, self.document, self.data)? {
            Some(Unpacked { vertices, order }) => (vertices, order),
            None => self.plain(primitive)?,
        };
        self.displace(primitive, posture.weights, &mut vertices)?;
        vertices.iter_mut().for_each(|v| *v = posture.placed.transform_point3(*v));
        if let Some(bad) = order.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(format!("it refers to corner {bad}, from 0, and there are {}", vertices.len()).into());
        }
        self.uneven += usize::from(mode == Mode::Triangles && !order.len().is_multiple_of(3));
        let mut triangles = triangles(&order, mode);
        if posture.placed.matrix3.determinant() < 0.0 {
            // A mirror image shows the other side of its triangles.
            triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let whole = &self.mesh.surface;
        limits::count(whole.vertices.len() + vertices.len(), whole.triangles.len() + triangles.len())?;
        if let Some(index) = primitive.material().index().filter(|_| hint(&primitive.material()).is_some()) {
            *self.materials.entry(index).or_default() += triangles.len();
        }
        let normals = self.normals(primitive, posture.placed, vertices.len());
        let name = text_of(primitive.extras(), FACET).unwrap_or_else(|| posture.name.to_owned());
        self.mesh.normals.extend(normals);
        self.mesh.surface.append(Surface { names: vec![name], ..Surface::new(vertices, triangles) });
        self.mesh.normals.resize(self.mesh.surface.vertices.len(), DVec3::ZERO);
        Ok(())
    }

    /// Returns the corners of a primitive that is not packed, and the numbers of those that its triangles have.
    fn plain(&self, primitive: &Primitive<'_>) -> Result<(Vec<DVec3>, Vec<u32>), Fault> {
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            return Err("it has no POSITION; places of its corners are expected".into());
        };
        let vertices = buffers::vectors(&positions, self.data)?;
        let Some(indices) = primitive.indices() else {
            let order = (0..vertices.len() as u32).collect();
            return Ok((vertices, order));
        };
        let types = [DataType::U8, DataType::U16, DataType::U32];
        buffers::check(&indices, &types, Dimensions::Scalar, self.data)?;
        let reader = primitive.reader(|buffer| self.data.get(buffer.index()).map(Vec::as_slice));
        let order = reader.read_indices().ok_or_else(|| Fault::whole("its triangles cannot be read"))?;
        Ok((vertices, order.into_u32().collect()))
    }

    /// Adds the displacements of a primitive's morph targets to its corners.
    fn displace(
        &self,
        primitive: &Primitive<'_>,
        weights: &[f32],
        vertices: &mut [DVec3],
    ) -> Result<(), Fault> {
        for (target, &weight) in primitive.morph_targets().zip(weights).filter(|(_, weight)| **weight != 0.0)
        {
            let Some(positions) = target.positions() else { continue };
            let shifts = buffers::vectors(&positions, self.data)?;
            if shifts.len() != vertices.len() {
                return Err(format!(
                    "a morph target displaces {} corners, and there are {}; save the file without morph targets",
                    shifts.len(),
                    vertices.len()
                )
                .into());
            }
            vertices.iter_mut().zip(shifts).for_each(|(v, shift)| *v += f64::from(weight) * shift);
        }
        Ok(())
    }

    /// Returns the normals of a primitive's corners; none where they cannot be read.
    fn normals(&self, primitive: &Primitive<'_>, placed: DAffine3, corners: usize) -> Vec<DVec3> {
        let turn = placed.matrix3.inverse().transpose();
        let given = primitive
            .get(&Semantic::Normals)
            .filter(|_| primitive.extension_value(super::repair::DRACO).is_none());
        let given = given.and_then(|accessor| buffers::vectors(&accessor, self.data).ok());
        given.into_iter().flatten().take(corners).map(|normal| turn * normal).collect()
    }

    fn finish(mut self) -> ParsedMesh {
        let document = self.document;
        let most = self.materials.iter().max_by_key(|(index, count)| (**count, std::cmp::Reverse(**index)));
        self.mesh.hint = most.and_then(|(&index, _)| hint(&document.materials().nth(index)?));
        let mut warn = |odd: bool, text: String| self.mesh.warnings.extend(odd.then_some(text));
        warn(self.skipped > 0, format!("{} parts of points or lines are left out", self.skipped));
        warn(self.hidden > 0, format!("{} hidden nodes are left out, with all below them", self.hidden));
        let count = self.uneven;
        warn(count > 0, format!("the last corners of {count} parts make no whole triangle and are left out"));
        warn(
            self.slanted > 0,
            format!(
                "the matrices of {} nodes do more than place; their last rows are left out",
                self.slanted
            ),
        );
        warn(
            self.doubled > 0,
            format!("{} nodes state their places twice; those of their matrices are read", self.doubled),
        );
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
        self.mesh
    }
}

fn transform(given: &Transform) -> DAffine3 {
    match *given {
        Transform::Matrix { matrix } => {
            DAffine3::from_mat4(DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from))))
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let [t, s] = [translation, scale].map(|v| DVec3::from_array(v.map(f64::from)));
            DAffine3::from_scale_rotation_translation(s, instances::turned(rotation.map(f64::from)), t)
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
