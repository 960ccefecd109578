//! Shapes that EXT_meshopt_compression and KHR_draco_mesh_compression have packed.

use super::*;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use proptest::prelude::*;
use serde_json::{Value, json};

/// The corners of the tetrahedron of the tests as f32, packed as attributes.
const CORNERS: [u8; 79] = {
    let mut bytes = [0; 79];
    let given = [
        160, 0, 0, 1, 60, 0, 0, 0, 255, 255, 1, 60, 0, 0, 0, 126, 125, 0, 0, 1, 15, 0, 0, 0, 255, 255, 1, 15,
        0, 0, 0, 126, 125, 0, 0, 1, 3, 0, 0, 0, 255, 1, 3, 0, 0, 0, 126,
    ];
    let mut k = 0;
    while k < given.len() {
        bytes[k] = given[k];
        k += 1;
    }
    bytes
};

/// Its triangles 0 2 1, 0 1 3, 1 2 3 and 0 3 2, packed as triangles and as a sequence.
const TRIANGLES: [u8; 23] =
    [225, 254, 14, 18, 3, 240, 4, 0, 118, 135, 86, 103, 120, 169, 134, 101, 137, 104, 152, 1, 105, 0, 0];
const SEQUENCE: [u8; 17] = [209, 0, 8, 2, 2, 4, 8, 6, 4, 4, 10, 12, 2, 0, 0, 0, 0];

/// The same tetrahedron, packed by Draco with 14 bits.
const DRACO: [u8; 76] = [
    68, 82, 65, 67, 79, 2, 2, 1, 1, 0, 0, 0, 4, 4, 0, 3, 0, 0, 1, 47, 1, 1, 16, 1, 255, 0, 0, 1, 0, 9, 3, 0,
    0, 2, 0, 1, 1, 0, 3, 3, 1, 32, 1, 32, 3, 0, 240, 131, 36, 145, 0, 0, 0, 0, 0, 255, 63, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63, 14,
];

/// Returns a file whose one mesh has packed corners, and triangles that are packed in a mode.
fn meshopt(corners: &[u8], triangles: &[u8], mode: &str) -> Value {
    let packed = |from: usize, bytes: &[u8], stride: usize, count: usize, mode: &str| {
        json!({ "EXT_meshopt_compression": { "buffer": 0, "byteOffset": from, "byteLength": bytes.len(),
            "byteStride": stride, "count": count, "mode": mode } })
    };
    let all = [corners, triangles].concat();
    json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "extensionsUsed": ["EXT_meshopt_compression"], "extensionsRequired": ["EXT_meshopt_compression"],
        "buffers": [
            { "byteLength": all.len(), "uri": format!("data:;base64,{}", STANDARD.encode(&all)) },
            { "byteLength": 72, "extensions": { "EXT_meshopt_compression": { "fallback": true } } },
        ],
        "bufferViews": [
            { "buffer": 1, "byteLength": 48, "byteStride": 12, "extensions": packed(0, corners, 12, 4, "ATTRIBUTES") },
            { "buffer": 1, "byteOffset": 48, "byteLength": 24,
                "extensions": packed(corners.len(), triangles, 2, 12, mode) },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1] },
            { "bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR" },
        ],
    })
}

fn draco(bytes: &[u8]) -> Value {
    json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "extensions": {
            "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } } }] }],
        "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
        "buffers": [{ "byteLength": bytes.len(), "uri": format!("data:;base64,{}", STANDARD.encode(bytes)) }],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "accessors": [
            { "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1] },
            { "componentType": 5123, "count": 12, "type": "SCALAR" },
        ],
    })
}

fn opened(root: &Value) -> Result<MeshFile, FileError> {
    parse(root.to_string().into_bytes(), "f.gltf", None)
}

#[test]
fn packed_shapes_are_unpacked() {
    for (root, error) in [
        (meshopt(&CORNERS, &TRIANGLES, "TRIANGLES"), 1e-12),
        (meshopt(&CORNERS, &SEQUENCE, "INDICES"), 1e-12),
        (draco(&DRACO), 1e-4),
    ] {
        let file = opened(&root).unwrap();
        assert!((volume(&file) - 1.0 / 6.0).abs() < error, "{}", volume(&file));
        assert_eq!((file.surface.triangles.len(), file.warnings.as_slice()), (4, [].as_slice()));
    }
    // Broken materials keep no packed shape from being read.
    for mut root in [meshopt(&CORNERS, &TRIANGLES, "TRIANGLES"), draco(&DRACO)] {
        root["images"] = json!(3);
        let file = opened(&root).unwrap();
        assert_eq!((file.surface.triangles.len(), file.warnings.len()), (4, 1), "{:?}", file.warnings);
    }
}

#[test]
fn packed_bytes_that_are_broken_are_named() {
    for (root, expected) in [
        (
            meshopt(&CORNERS[..60], &TRIANGLES, "TRIANGLES"),
            "bufferView 0: its 60 bytes of EXT_meshopt_compression",
        ),
        (
            meshopt(&CORNERS, &TRIANGLES, "SPHERES"),
            "bufferView 1: its 23 bytes of EXT_meshopt_compression (SPHERES)",
        ),
        (draco(&DRACO[..40]), "mesh 0, primitive 0: its KHR_draco_mesh_compression cannot be read: "),
    ] {
        let error = opened(&root).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    let mut root = meshopt(&CORNERS, &TRIANGLES, "TRIANGLES");
    root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = json!(1_000_000_000_000_u64);
    let error = opened(&root).unwrap_err().to_string();
    assert!(error.contains("does not lie within its buffer"), "{error}");
    // The length of the view agrees with the count, and both are beyond any memory.
    root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = json!(1_u64 << 58);
    root["bufferViews"][0]["byteLength"] = json!(12 * (1_u64 << 58));
    let error = opened(&root).unwrap_err().to_string();
    assert!(error.contains("bufferView 0: it is larger than its buffer"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn no_packed_bytes_make_it_panic(
        kind in 0..3,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(),
        whole in any::<bool>(),
    ) {
        let mut bytes = [&DRACO[..], &TRIANGLES, &SEQUENCE][kind as usize].to_vec();
        for (place, value) in changes {
            let at = place.index(bytes.len());
            bytes[at] = value;
        }
        if !whole {
            bytes.truncate(cut.index(bytes.len() + 1));
        }
        let mut corners = CORNERS;
        corners[bytes.len() % 79] ^= bytes.first().copied().unwrap_or(0);
        let mode = ["", "TRIANGLES", "INDICES"][kind as usize];
        let _ = opened(&if kind == 0 { draco(&bytes) } else { meshopt(&corners, &bytes, mode) });
    }
}
