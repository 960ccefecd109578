//! Changes mesh files as other programs do: turns them, and removes this program's statements from them.
#![cfg(feature = "interchange")]

use brillianteer::io::design_file::DesignFormat;
use glam::{DQuat, DVec3};

/// Returns the file with every corner turned about the origin, and nothing else changed.
pub fn turned(format: DesignFormat, bytes: Vec<u8>, turn: DQuat) -> Vec<u8> {
    moved(format, bytes, &|v| turn * v)
}

/// Returns the file with every corner moved, and nothing else changed.
pub fn moved(format: DesignFormat, mut bytes: Vec<u8>, to: &dyn Fn(DVec3) -> DVec3) -> Vec<u8> {
    match format {
        DesignFormat::Obj => {
            let text = String::from_utf8(bytes).unwrap();
            let line = |line: &str| match line.strip_prefix("v ") {
                Some(rest) => {
                    let numbers: Vec<f64> = rest.split_whitespace().map(|n| n.parse().unwrap()).collect();
                    let v = to(DVec3::from_slice(&numbers));
                    format!("v {} {} {}\n", v.x, v.y, v.z)
                }
                None => format!("{line}\n"),
            };
            text.lines().map(line).collect::<String>().into_bytes()
        }
        DesignFormat::Stl => {
            for triangle in bytes[84..].chunks_exact_mut(50) {
                triangle[12..48].chunks_exact_mut(12).for_each(|corner| move_f32(corner, to));
            }
            bytes
        }
        DesignFormat::Ply => {
            let start = header(&bytes);
            let text = String::from_utf8_lossy(&bytes[..start]);
            let count = text.lines().find_map(|l| l.strip_prefix("element vertex ")?.parse::<usize>().ok());
            for corner in bytes[start..start + 24 * count.unwrap()].chunks_exact_mut(24) {
                let number = |k: usize| f64::from_le_bytes(corner[8 * k..8 * k + 8].try_into().unwrap());
                let v = to(DVec3::new(number(0), number(1), number(2))).to_array();
                (0..3).for_each(|k| corner[8 * k..8 * k + 8].copy_from_slice(&v[k].to_le_bytes()));
            }
            bytes
        }
        DesignFormat::Glb => {
            let (json, start) = json(&bytes);
            // The node turns z up into y up, and corners are moved in the frame outside the node.
            let node = DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2);
            let own = |v: DVec3| node.inverse() * to(node * v);
            let positions = json["meshes"][0]["primitives"].as_array().unwrap().iter();
            let accessors = positions.map(|p| p["attributes"]["POSITION"].as_u64().unwrap() as usize);
            for accessor in accessors {
                let view = json["accessors"][accessor]["bufferView"].as_u64().unwrap() as usize;
                let place = |key: &str| json["bufferViews"][view][key].as_u64().unwrap_or(0) as usize;
                let from = start + place("byteOffset");
                let places = &mut bytes[from..from + place("byteLength")];
                places.chunks_exact_mut(12).for_each(|corner| move_f32(corner, &own));
            }
            bytes
        }
        other => panic!("{other:?} is no mesh"),
    }
}

/// Returns the file without the statement of how its stone lies.
pub fn stripped(format: DesignFormat, mut bytes: Vec<u8>) -> Vec<u8> {
    let without = |text: &str| -> String {
        text.lines().filter(|line| !line.contains("brillianteer ")).map(|line| format!("{line}\n")).collect()
    };
    match format {
        DesignFormat::Obj => without(&String::from_utf8(bytes).unwrap()).into_bytes(),
        DesignFormat::Stl => {
            bytes[..80].fill(0);
            bytes
        }
        DesignFormat::Ply => {
            let start = header(&bytes);
            let text = without(std::str::from_utf8(&bytes[..start]).unwrap());
            [text.into_bytes(), bytes[start..].to_vec()].concat()
        }
        DesignFormat::Glb => {
            // The replacement is as long as the text, so that no offset changes.
            let text = b"\"extras\":{\"brillianteer\"";
            let at = bytes.windows(text.len()).position(|w| w == text).unwrap();
            bytes[at..at + text.len()].copy_from_slice(b"\"extras\":{\"someone-else\"");
            bytes
        }
        other => panic!("{other:?} is no mesh"),
    }
}

fn move_f32(corner: &mut [u8], to: &dyn Fn(DVec3) -> DVec3) {
    let number = |k: usize| f64::from(f32::from_le_bytes(corner[4 * k..4 * k + 4].try_into().unwrap()));
    let v = to(DVec3::new(number(0), number(1), number(2))).as_vec3().to_array();
    (0..3).for_each(|k| corner[4 * k..4 * k + 4].copy_from_slice(&v[k].to_le_bytes()));
}

/// Returns the offset at which the header of a PLY ends.
fn header(bytes: &[u8]) -> usize {
    let end = b"end_header\n";
    bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len()
}

/// Returns the JSON of a binary glTF, and the offset of its binary data.
fn json(bytes: &[u8]) -> (serde_json::Value, usize) {
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    (serde_json::from_slice(&bytes[20..20 + length]).unwrap(), 20 + length + 8)
}
