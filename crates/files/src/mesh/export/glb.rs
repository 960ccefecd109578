//! The parts of a binary glTF file: its numbers, and materials in its terms.

use super::{FACET, Face};
use crate::mesh::file::MaterialHint;
use glam::DVec3;
use serde_json::{Value, json};

/// glTF's codes for numbers of f32 and of u32, and for the two purposes of buffer views.
const F32: u32 = 5126;
const U32: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// The rotation that makes y up out of z up: a quarter turn about x, as a quaternion.
pub(super) const UPRIGHT: [f64; 4] =
    [-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2];

/// The numbers of a file, and the views and accessors by which its meshes refer to them.
#[derive(Default)]
pub(super) struct Buffers {
    bin: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

/// Corners, each with its normal, and triangles by the indices of their corners.
#[derive(Default)]
pub(super) struct Primitive {
    pub corners: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    pub triangles: Vec<u32>,
}

impl Primitive {
    /// Adds a face, in units of the file of which `scale` make a unit of `vertices`.
    pub fn add(&mut self, face: &Face, vertices: &[DVec3], scale: f64) {
        let first = self.corners.len();
        let place = |v: &u32| (first + face.corners.iter().position(|o| o == v).unwrap_or_default()) as u32;
        self.triangles.extend(face.triangles.iter().flatten().map(place));
        self.corners.extend(face.corners.iter().map(|&v| vertices[v as usize] * scale));
        self.normals.extend(&face.normals);
    }
}

impl Buffers {
    /// Adds a shape, and returns the primitive that shows it in the material of that number; with a facet's name, if it has one.
    pub fn primitive(&mut self, name: Option<&str>, shape: &Primitive, material: usize) -> Value {
        let Primitive { corners, normals, triangles } = shape;
        let floats = |v: DVec3| v.as_vec3().to_array();
        let places: Vec<[f32; 3]> = corners.iter().map(|&v| floats(v)).collect();
        let low = places.iter().fold([f32::INFINITY; 3], |a, b| [0, 1, 2].map(|i| a[i].min(b[i])));
        let high = places.iter().fold([f32::NEG_INFINITY; 3], |a, b| [0, 1, 2].map(|i| a[i].max(b[i])));
        let bytes =
            |list: &[[f32; 3]]| list.iter().flatten().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
        let position = self.view(&bytes(&places), VERTICES);
        self.accessors.push(json!({ "bufferView": position, "componentType": F32, "count": places.len(),
            "type": "VEC3", "min": low, "max": high }));
        let normals: Vec<[f32; 3]> = normals.iter().map(|&v| floats(v)).collect();
        let normals = self.view(&bytes(&normals), VERTICES);
        self.accessors.push(json!({ "bufferView": normals, "componentType": F32, "count": places.len(),
            "type": "VEC3" }));
        let numbers: Vec<u8> = triangles.iter().flat_map(|i| i.to_le_bytes()).collect();
        let order = self.view(&numbers, INDICES);
        self.accessors.push(json!({ "bufferView": order, "componentType": U32, "count": triangles.len(),
            "type": "SCALAR" }));
        let attributes = json!({ "POSITION": position, "NORMAL": normals });
        let mut primitive = json!({ "attributes": attributes, "indices": order, "material": material });
        if let Some(name) = name {
            primitive["extras"] = json!({ FACET: name });
        }
        primitive
    }

    /// Adds a buffer view, and returns its number, which its accessor has as well.
    fn view(&mut self, bytes: &[u8], target: u32) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len(),
            "target": target }));
        self.bin.extend(bytes);
        self.views.len() - 1
    }

    /// Encodes a file of this content and these numbers as binary glTF.
    ///
    /// # Errors
    /// Fails only for lack of memory.
    pub fn encoded(self, mut content: Value) -> Result<Vec<u8>, gltf::Error> {
        let Self { bin, views, accessors } = self;
        content["buffers"] = json!([{ "byteLength": bin.len() }]);
        content["bufferViews"] = views.into();
        content["accessors"] = accessors.into();
        let header = gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 };
        let json = content.to_string().into_bytes();
        gltf::Glb { header, json: json.into(), bin: Some(bin.into()) }.to_vec()
    }
}

/// Returns a material in the form of glTF. Renderers that trace no rays use `thickness`, in units of the file, as the
/// length of the path inside.
pub(super) fn material_json(hint: &MaterialHint, thickness: f64) -> Value {
    let mut extensions = serde_json::Map::new();
    let mut extend = |name: &str, value: Value| extensions.insert(format!("KHR_materials_{name}"), value);
    if hint.transmits {
        extend("transmission", json!({ "transmissionFactor": 1.0 }));
        // A thickness above 0 means that the surface bounds a volume.
        let volume = match hint.attenuation {
            Some((colour, distance)) => {
                json!({ "thicknessFactor": thickness, "attenuationColor": colour, "attenuationDistance": distance })
            }
            None => json!({ "thicknessFactor": thickness }),
        };
        extend("volume", volume);
    }
    if let Some(ior) = hint.ior {
        extend("ior", json!({ "ior": ior }));
    }
    if let Some(dispersion) = hint.dispersion {
        extend("dispersion", json!({ "dispersion": dispersion }));
    }
    json!({
        "name": hint.name,
        "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 0.0 },
        "extensions": extensions,
    })
}

/// Returns the names of the extensions that a material uses.
pub(super) fn used(material: &Value) -> Vec<String> {
    let names = material["extensions"].as_object().map(|map| map.keys().cloned().collect());
    names.unwrap_or_default()
}

/// Returns the description of the file itself, with which its content begins.
pub(super) fn asset() -> Value {
    json!({ "version": "2.0", "generator": "Brillianteer" })
}
