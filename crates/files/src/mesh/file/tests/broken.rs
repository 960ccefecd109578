//! glTF files in which something besides the shape is broken: the shape is read, and a warning says so.

use super::*;
use proptest::prelude::*;

/// Returns an image of one pixel as text within a file.
fn pixel() -> String {
    use base64::Engine as _;
    let mut bytes = std::io::Cursor::new(vec![]);
    image::RgbImage::new(1, 1).write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    let text = base64::engine::general_purpose::STANDARD.encode(bytes.into_inner());
    format!("data:image/png;base64,{text}")
}

/// Returns the test file with a texture and an image in it, none of it wrong.
fn textured() -> serde_json::Value {
    let mut root: serde_json::Value = serde_json::from_str(&gltf()).unwrap();
    root["images"] = serde_json::json!([{ "uri": pixel(), "mimeType": "image/png" }]);
    root["samplers"] = serde_json::json!([{ "wrapS": 10497 }]);
    root["textures"] = serde_json::json!([{ "source": 0, "sampler": 0 }]);
    root["materials"][0]["pbrMetallicRoughness"] = serde_json::json!({ "baseColorTexture": { "index": 0 } });
    root["materials"][0]["name"] = "glass".into();
    root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 0.into();
    // Normals, without which the shape is read.
    root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 3.into();
    let normals = serde_json::json!({ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" });
    root["accessors"].as_array_mut().unwrap().push(normals);
    let said = "brillianteer up=y d=6.5 u=1000 v=1 s=0,1 m=0,0,0 n=ruby";
    root["nodes"][0]["extras"] = serde_json::json!({ "brillianteer": said });
    root
}

fn opened(root: &serde_json::Value) -> Result<MeshFile, FileError> {
    parse(root.to_string().into_bytes(), "f.gltf", None)
}

#[test]
fn broken_textures_and_materials_are_a_warning_and_the_shape_is_read() {
    let whole = opened(&textured()).unwrap();
    assert_eq!((whole.warnings.as_slice(), whole.surface.triangles.len()), ([].as_slice(), 4));
    let json = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    let faults = [
        // For each case: the broken part, its place, the replacement, and whether the statements about light survive.
        (
            "a texture that is not there",
            "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
            "7",
            true,
        ),
        ("a texture without a number", "/materials/0/pbrMetallicRoughness/baseColorTexture", "{}", true),
        ("an image that is not there", "/textures/0/source", "3", true),
        (
            "a texture without an image, as webp has it",
            "/textures/0",
            r#"{"extensions":{"EXT_texture_webp":{"source":0}}}"#,
            true,
        ),
        ("a sampler that is not there", "/textures/0/sampler", "9", true),
        ("a sampler of no kind", "/samplers/0/wrapS", "1", true),
        ("an image in no buffer view", "/images/0", r#"{"bufferView":99,"mimeType":"image/png"}"#, true),
        ("a type that is a number", "/images/0/mimeType", "5", true),
        ("an image that is text", "/images/0", r#""cat.png""#, true),
        ("images that are no list", "/images", "{}", true),
        ("a colour in words", "/materials/0/pbrMetallicRoughness", r#"{"baseColorFactor":"red"}"#, true),
        ("an alpha mode of no name", "/materials/0/alphaMode", r#""SEE""#, true),
        (
            "coordinates of a texture that are not there",
            "/meshes/0/primitives/0/attributes/TEXCOORD_0",
            "99",
            true,
        ),
        ("a material that is not there", "/meshes/0/primitives/0/material", "4", false),
        ("a material in words", "/meshes/0/primitives/0/material", r#""gold""#, false),
        ("a name that is a list", "/materials/0/name", "[]", false),
    ];
    for (what, place, instead, keeps_light) in faults {
        let mut root = textured();
        match root.pointer_mut(place) {
            Some(found) => *found = json(instead),
            None => root["materials"][0]["alphaMode"] = json(instead),
        }
        let file = opened(&root).unwrap_or_else(|e| panic!("{what}: {e}"));
        assert_eq!(file.surface, whole.surface, "{what}");
        let warnings = file.warnings.join("; ");
        assert!(
            warnings.contains("beside the shape are left out, because the file is broken: "),
            "{what}: {warnings}"
        );
        assert!(!warnings.contains("no glTF") && file.warnings.len() == 1, "{what}: {warnings}");
        assert!(whole.statement.is_some() && file.statement == whole.statement, "{what}");
        assert_eq!(file.hint.is_some(), keeps_light, "{what}: {:?}", file.hint);
        assert!(!keeps_light || file.hint == whole.hint, "{what}: {:?}", file.hint);
    }
}

#[test]
fn a_number_about_light_that_is_none_is_left_out_alone() {
    let whole = opened(&textured()).unwrap().hint.unwrap();
    for instead in [r#""high""#, "null", "{}"] {
        let mut root = textured();
        root["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] =
            serde_json::from_str(instead).unwrap();
        let hint = opened(&root).unwrap().hint.unwrap();
        assert_eq!(hint, MaterialHint { ior: None, ..whole.clone() }, "{instead}");
    }
}

#[test]
fn images_that_are_missing_or_no_pictures_are_a_warning() {
    let cut_off = pixel()[..62].to_owned();
    for (image, why) in [
        (serde_json::json!({ "uri": pixel() }), None),
        (serde_json::json!({ "uri": "missing.png" }), Some("`missing.png` is not a file beside this one")),
        (serde_json::json!({ "uri": "data:image/png;base64,###" }), Some("are not base64")),
        (serde_json::json!({ "uri": cut_off }), Some("it ends too soon: it has been cut off")),
        (
            serde_json::json!({ "bufferView": 1, "mimeType": "image/png" }),
            Some("its bytes are not a picture of a kind that glTF allows"),
        ),
        (serde_json::json!({}), Some("it has neither a file nor a buffer view")),
    ] {
        let mut root = textured();
        root["images"] = serde_json::json!([image]);
        let file = opened(&root).unwrap();
        assert_eq!(file.surface, opened(&textured()).unwrap().surface, "{image}");
        match (why, file.warnings.as_slice()) {
            (None, []) => {}
            (Some(why), [warning]) => {
                assert!(
                    warning.starts_with("image 0, of a texture, is left out: ") && warning.contains(why),
                    "{warning}"
                );
            }
            (_, warnings) => panic!("{image}: {warnings:?}"),
        }
    }
    let mut root = textured();
    root["images"] = serde_json::json!([{ "uri": pixel() }, {}, {}]);
    let warnings = opened(&root).unwrap().warnings;
    assert!(
        warnings[0].starts_with("image 1") && warnings[0].ends_with("; one more image is broken"),
        "{warnings:?}"
    );
}

#[test]
fn textures_whose_files_are_missing_keep_no_shape_from_being_read() {
    let mut root = textured();
    root["images"] = serde_json::json!([{ "uri": "missing.png" }, { "bufferView": 2 }]);
    root["buffers"]
        .as_array_mut()
        .unwrap()
        .push(serde_json::json!({ "byteLength": 10, "uri": "missing.bin" }));
    root["bufferViews"].as_array_mut().unwrap().push(serde_json::json!({ "buffer": 1, "byteLength": 10 }));
    let file = opened(&root).unwrap();
    assert_eq!(file.surface.triangles.len(), 4);
    for name in ["EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds", "KHR_materials_unknown"] {
        root["extensionsRequired"] = serde_json::json!([name]);
        assert_eq!(opened(&root).unwrap().surface, file.surface, "{name}");
    }
}

#[test]
fn a_broken_shape_is_an_error_though_textures_are_broken_too() {
    for (place, instead) in [
        ("/accessors/0/bufferView", "99"),
        ("/accessors/0/count", "1000"),
        ("/meshes/0/primitives/0/indices", "99"),
        ("/nodes/1/mesh", "5"),
    ] {
        for breaks_texture in [false, true] {
            let mut root = textured();
            *root.pointer_mut(place).unwrap() = serde_json::from_str(instead).unwrap();
            if breaks_texture {
                root["textures"][0]["source"] = 9.into();
            }
            assert!(opened(&root).is_err(), "{place}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn whatever_stands_beside_the_shape_the_shape_is_read(
        key in prop::sample::select(vec!["images", "textures", "samplers", "materials", "animations", "cameras", "skins"]),
        value in prop::sample::select(vec![
            "null", "1", "-1", "true", "\"x\"", "{}", "[]", "[null]", "[1]", "[{}]", "[[]]", "[{\"name\":1}]",
            "[{\"source\":-1}]", "[{\"uri\":\"../x\"}]", "[{\"extensions\":{\"KHR_materials_volume\":[]}}]",
            "[{\"extensions\":{\"KHR_materials_ior\":{\"ior\":null}}}]",
            "[{\"channels\":[{}]}]", "[{\"joints\":[99]}]",
        ]),
    ) {
        let mut root = textured();
        root[key] = serde_json::from_str(value).unwrap();
        let file = opened(&root);
        prop_assert!(file.is_ok(), "{key} {value}: {}", file.unwrap_err());
        prop_assert_eq!(file.unwrap().surface.triangles.len(), 4);
    }
}
