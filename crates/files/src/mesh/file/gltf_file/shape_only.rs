//! Reduces a glTF file to its shape, for files in which some other part is broken.

use super::instances;
use super::meshopt;
use super::repair::{DRACO, list};
use super::scene::HIDDEN;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// The extensions of materials about the passage of light, with the keys of each that are read.
const OF_MATERIALS: [(&str, &[&str]); 4] = [
    ("KHR_materials_ior", &["ior"]),
    ("KHR_materials_dispersion", &["dispersion"]),
    ("KHR_materials_transmission", &["transmissionFactor"]),
    ("KHR_materials_volume", &["thicknessFactor", "attenuationDistance", "attenuationColor"]),
];

/// Returns the JSON of a glTF file with nothing but its scenes, the positions of corners and the triangles, and, if
/// `keeps_materials` is set, the materials' statements about light. `None` where the JSON is no object.
pub(super) fn shape_alone(root: &Value, keeps_materials: bool) -> Option<Vec<u8>> {
    let mut root = root.clone();
    let root = root.as_object_mut()?;
    for key in ["animations", "cameras", "images", "samplers", "skins", "textures", "extensions", "extras"] {
        root.remove(key);
    }
    if !keeps_materials {
        root.remove("materials");
    }
    let materials = list(root, "materials").iter_mut().map(|material| *material = of_light(material)).count();
    let (mut accessors, mut packed) = (BTreeSet::new(), BTreeSet::new());
    for node in list(root, "nodes").iter_mut().filter_map(Value::as_object_mut) {
        let keys =
            ["name", "children", "mesh", "weights", "matrix", "translation", "rotation", "scale", "extras"];
        keep(node, &[keys.as_slice(), &["extensions"]].concat());
        keep_extensions(node, &[HIDDEN, instances::NAME]);
        accessors.extend(instances::PLACING.iter().filter_map(|name| {
            index(node.get("extensions")?.get(instances::NAME)?.get("attributes")?, name)
        }));
    }
    for mesh in list(root, "meshes").iter_mut().filter_map(Value::as_object_mut) {
        keep(mesh, &["name", "primitives", "weights"]);
        for primitive in list(mesh, "primitives").iter_mut().filter_map(Value::as_object_mut) {
            keep(
                primitive,
                &["attributes", "indices", "mode", "material", "targets", "extensions", "extras"],
            );
            keep_extensions(primitive, &[DRACO]);
            packed
                .extend(primitive.get("extensions").and_then(|found| index(found.get(DRACO)?, "bufferView")));
            let targets =
                list(primitive, "targets").iter_mut().map(|target| places(Some(target))).collect::<Vec<_>>();
            accessors.extend(targets.into_iter().chain([places(primitive.get_mut("attributes"))]).flatten());
            accessors.extend(primitive.get("indices").and_then(Value::as_u64));
            if primitive.get("material").and_then(Value::as_u64).is_none_or(|place| place >= materials as u64)
            {
                primitive.remove("material");
            }
        }
    }
    // An accessor without a buffer view would be refused.
    let unused = json!({ "bufferView": 0, "componentType": 5126, "count": 1, "type": "SCALAR" });
    let mut views = only(list(root, "accessors"), &accessors, &unused, &view_of_accessor);
    views.append(&mut packed);
    let unused = json!({ "buffer": 0, "byteLength": 1 });
    let buffers = only(list(root, "bufferViews"), &views, &unused, &|view| {
        let packed = view.get("extensions").and_then(|found| found.get(meshopt::NAME));
        [Some(view), packed].into_iter().flatten().filter_map(|view| index(view, "buffer")).collect()
    });
    only(list(root, "buffers"), &buffers, &json!({ "byteLength": 1 }), &|_| vec![]);
    serde_json::to_vec(root).ok()
}

/// Reduces the attributes of corners to their positions, and returns the accessor of these.
fn places(attributes: Option<&mut Value>) -> Option<u64> {
    let attributes = attributes?.as_object_mut()?;
    keep(attributes, &["POSITION"]);
    attributes.get("POSITION")?.as_u64()
}

/// Keeps those of an object's extensions that have these names.
fn keep_extensions(object: &mut Map<String, Value>, names: &[&str]) {
    match object.get_mut("extensions").and_then(Value::as_object_mut) {
        Some(extensions) => keep(extensions, names),
        None => drop(object.remove("extensions")),
    }
}

fn keep(object: &mut Map<String, Value>, keys: &[&str]) {
    object.retain(|key, _| keys.contains(&key.as_str()));
}

/// Returns a material with only its name and its statements about light.
fn of_light(material: &Value) -> Value {
    let mut extensions = Map::new();
    for (name, keys) in OF_MATERIALS {
        if let Some(extension) = material.pointer(&format!("/extensions/{name}")).and_then(Value::as_object) {
            let is_number = |value: &Value| match value {
                Value::Array(list) => list.iter().all(Value::is_number),
                value => value.is_number(),
            };
            let mut extension = extension.clone();
            keep(&mut extension, keys);
            // A missing number would be read as the extension's usual one.
            if !extension.values().all(is_number) {
                continue;
            }
            extensions.insert(name.to_owned(), Value::Object(extension));
        }
    }
    match material.get("name") {
        Some(name) => json!({ "name": name, "extensions": extensions }),
        None => json!({ "extensions": extensions }),
    }
}

fn index(object: &Value, key: &str) -> Option<u64> {
    object.get(key)?.as_u64()
}

/// Returns the buffer views of an accessor.
fn view_of_accessor(accessor: &Value) -> Vec<u64> {
    let sparse = ["/sparse/indices/bufferView", "/sparse/values/bufferView"];
    let sparse = sparse.iter().filter_map(|at| accessor.pointer(at)?.as_u64());
    index(accessor, "bufferView").into_iter().chain(sparse).collect()
}

/// Replaces all entries except the needed ones by `unused`, and returns the entries that the needed ones need in
/// turn.
fn only(
    entries: &mut [Value],
    needed: &BTreeSet<u64>,
    unused: &Value,
    needs: &dyn Fn(&Value) -> Vec<u64>,
) -> BTreeSet<u64> {
    let mut further = BTreeSet::new();
    for (place, entry) in (0..).zip(entries) {
        if needed.contains(&place) {
            further.extend(needs(entry));
        } else {
            *entry = unused.clone();
        }
    }
    further
}
