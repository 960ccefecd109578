//! Reads the places of the copies of a node's mesh, by EXT_mesh_gpu_instancing.

use super::buffers::{self, Data};
use brillianteer_base::Fault;
use glam::{DAffine3, DQuat, DVec3};
use gltf::{Accessor, Document, Node};

/// The name of the extension.
pub(super) const NAME: &str = "EXT_mesh_gpu_instancing";

/// The attributes of a copy that place it; others are not used.
pub(super) const PLACING: [&str; 3] = ["TRANSLATION", "ROTATION", "SCALE"];

/// Returns the accessors by which the copies of a node's mesh are placed.
pub(super) fn accessors<'d>(node: &Node<'_>, document: &'d Document) -> Vec<Accessor<'d>> {
    PLACING.iter().filter_map(|name| attribute(node, document, name)).collect()
}

fn attribute<'d>(node: &Node<'_>, document: &'d Document, name: &str) -> Option<Accessor<'d>> {
    let index = node.extension_value(NAME)?.get("attributes")?.get(name)?.as_u64()?;
    document.accessors().nth(usize::try_from(index).ok()?)
}

/// Returns the places of the copies of a node's mesh within the node: one where it lies, if the node states none.
///
/// # Errors
/// Fails where the places cannot be read, or their numbers differ.
pub(super) fn places(node: &Node<'_>, document: &Document, data: &Data) -> Result<Vec<DAffine3>, Fault> {
    let [translation, rotation, scale] = PLACING.map(|name| attribute(node, document, name));
    let counts: Vec<usize> =
        [&translation, &rotation, &scale].into_iter().flatten().map(Accessor::count).collect();
    let Some(&count) = counts.first() else { return Ok(vec![DAffine3::IDENTITY]) };
    if counts.iter().any(|other| *other != count) {
        let problem = format!(
            "the copies by {NAME} have {counts:?} places, turns and sizes; equal numbers are expected"
        );
        return Err(problem.into());
    }
    let vectors = |accessor: Option<Accessor<'_>>, usual| {
        accessor.map_or_else(|| Ok(vec![usual; count]), |accessor| buffers::vectors(&accessor, data))
    };
    let (at, sizes) = (vectors(translation, DVec3::ZERO)?, vectors(scale, DVec3::ONE)?);
    let turns =
        rotation.map_or_else(|| Ok(vec![[0.0, 0.0, 0.0, 1.0]; count]), |a| buffers::quaternions(&a, data))?;
    let placed = |((at, size), turn): ((DVec3, DVec3), [f64; 4])| {
        DAffine3::from_scale_rotation_translation(size, turned(turn), at)
    };
    Ok(at.into_iter().zip(sizes).zip(turns).map(placed).collect())
}

/// Returns the rotation of a quaternion of any length; none where it has no length.
pub(super) fn turned(turn: [f64; 4]) -> DQuat {
    let turn = DQuat::from_array(turn);
    if turn.length() > 0.0 { turn * (1.0 / turn.length()) } else { DQuat::IDENTITY }
}
