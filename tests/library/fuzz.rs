//! Runs every reader on damaged files: whatever the bytes, it returns soon and does not panic. Each target runs for
//! `BRILLIANTEER_FUZZ_SECONDS` (1 if not set), from the seed `BRILLIANTEER_FUZZ_SEED` (0 if not set), and keeps the bytes
//! that it fails on in the system's folder for temporary files.
#![cfg(feature = "interchange")]

use brillianteer::cut::from_mesh::{Evening, Up, from_mesh};
use brillianteer::io::{
    asc, cut_file,
    design_file::{DesignFormat, written},
    gcs, gem, library, light_file, mesh, scene_file, scope_file,
};
use brillianteer::math::{
    TriangleMesh,
    faceting::{SurfaceKind, facets},
};
use brillianteer::scene::{LIGHTS, Specimen, light};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// The time that a reader may take for a file of a few kilobytes. It takes milliseconds, but other programs may
/// occupy the cores.
const PATIENCE: Duration = Duration::from_secs(60);

/// The largest size of a damaged file, in bytes.
const LARGEST: usize = 16 << 10;

/// Numbers that readers often fail on, as texts and as bytes.
const TEXTS: [&str; 16] = [
    "NaN",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-320",
    "0",
    "-0.0",
    "4294967296",
    "-1",
    "99999999999999999999",
    "\0",
    "\u{feff}",
    "{{{{",
    "<!DOCTYPE a [",
    "]]>",
];

/// The random number generator SplitMix64: Steele, Lea and Flood, Fast splittable pseudorandom number generators (2014).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.roll() % count.max(1) as u64) as usize
    }

    /// Damages one place of a file: bits, a number, or a piece that is cut out, doubled or taken from elsewhere.
    fn spoil(&mut self, bytes: &mut Vec<u8>, other: &[u8]) {
        let at = self.below(bytes.len());
        let end = (at + 1 + self.below(24)).min(bytes.len());
        match self.below(7) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << self.below(8),
            1 if !bytes.is_empty() => bytes[at] = self.roll() as u8,
            2 => drop(bytes.drain(at.min(end)..end)),
            3 => {
                let piece = bytes[at.min(end)..end].to_vec();
                bytes.splice(at..at, piece);
            }
            4 => {
                let text = TEXTS[self.below(TEXTS.len())];
                bytes.splice(at.min(end)..end, text.bytes());
            }
            5 => {
                let from = self.below(other.len());
                let to = (from + self.below(200)).min(other.len());
                bytes.splice(at.min(end)..end, other[from.min(to)..to].iter().copied());
            }
            _ => {
                let extreme = [0u8, 0xff, 0x7f, 0x80][self.below(4)];
                bytes[at.min(end)..end].fill(extreme);
            }
        }
        bytes.truncate(LARGEST);
    }
}

fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

/// Damages files and runs a reader on them until the time is up.
fn fuzz(target: &str, files: &[Vec<u8>], read: impl Fn(&[u8])) {
    let time = Duration::from_secs(number("BRILLIANTEER_FUZZ_SECONDS", 1));
    let mut dice = Dice(number("BRILLIANTEER_FUZZ_SEED", 0));
    let begun = Instant::now();
    let mut count = 0;
    while begun.elapsed() < time {
        let mut bytes = files[dice.below(files.len())].clone();
        bytes.truncate(LARGEST);
        let other = &files[dice.below(files.len())];
        (0..1 + dice.below(6)).for_each(|_| dice.spoil(&mut bytes, other));
        let started = Instant::now();
        let came = catch_unwind(AssertUnwindSafe(|| read(&bytes)));
        if came.is_err() || started.elapsed() > PATIENCE {
            let kept = std::env::temp_dir().join(format!("brillianteer-fuzz-{target}"));
            std::fs::write(&kept, &bytes).unwrap();
            panic!("{target}: after {count} files, panic or {:?}: {}", started.elapsed(), kept.display());
        }
        count += 1;
    }
    println!("{target}: {count} files in {:?}", begun.elapsed());
    assert!(count > 0);
}

/// Returns a brilliant of few facets as a file of a format.
fn brilliant(format: DesignFormat) -> Vec<u8> {
    let text = library::cut("tolkowsky").unwrap().replace("girdle_facets = 96", "girdle_facets = 16");
    let specimen = Specimen::new(cut_file::parse(&text, "t").unwrap()).unwrap();
    written(&specimen, format).unwrap().bytes
}

/// Builds a design and writes it in every format.
fn built(design: brillianteer::cut::Design) {
    if let Ok(specimen) = Specimen::new(design) {
        for format in DesignFormat::ALL {
            let _ = written(&specimen, format);
        }
    }
}

fn lossy(read: impl Fn(&str)) -> impl Fn(&[u8]) {
    move |bytes| read(&String::from_utf8_lossy(bytes))
}

#[test]
fn cut_files() {
    let as_tiers = asc::read(&brilliant(DesignFormat::Asc), "t").unwrap().design;
    let files = [cut_file::write(&as_tiers).into_bytes(), library::cut("tolkowsky").unwrap().into()];
    fuzz("toml", &files, lossy(|text| drop(cut_file::parse(text, "x").map(built))));
}

#[test]
fn cutters_texts() {
    fuzz("asc", &[brilliant(DesignFormat::Asc)], |bytes| {
        drop(asc::read(bytes, "x").map(|imported| built(imported.design)))
    });
}

#[test]
fn cutters_bytes() {
    fuzz("gem", &[brilliant(DesignFormat::Gem)], |bytes| {
        let _ = gem::looks_like(bytes);
        drop(gem::read(bytes, "x").map(|imported| built(imported.design)));
    });
}

#[test]
fn cutters_xml() {
    fuzz("gcs", &[brilliant(DesignFormat::Gcs)], |bytes| {
        drop(gcs::read(bytes, "x").map(|imported| built(imported.design)))
    });
}

/// Reads a mesh, mends it and finds its facets.
fn mesh(bytes: &[u8]) {
    let Ok(file) = mesh::parse(bytes.to_vec(), "x", None) else { return };
    let Ok((mended, _)) = file.surface.mend_closed() else { return };
    mended.parts.iter().for_each(|part| drop(mended.part(part)));
    match facets(mended.surface) {
        SurfaceKind::Convex(found) => drop(from_mesh(&found, Up::Found, Evening::default())),
        SurfaceKind::Concave(surface) => drop(TriangleMesh::new(surface)),
    }
}

#[test]
fn meshes_of_polygons() {
    fuzz("obj", &[brilliant(DesignFormat::Obj)], mesh);
}

#[test]
fn meshes_of_triangles() {
    let text = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
                 facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid a\n";
    fuzz("stl", &[brilliant(DesignFormat::Stl), text.to_vec()], mesh);
}

#[test]
fn meshes_of_properties() {
    let head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n\
                property list uchar int vertex_indices\nend_header\n";
    let body = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    let mut bytes = head.replace("ascii", "binary_little_endian").into_bytes();
    for v in [[0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        v.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    for face in [[0i32, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
        bytes.push(3);
        face.iter().for_each(|k| bytes.extend(k.to_le_bytes()));
    }
    fuzz("ply", &[format!("{head}{body}").into_bytes(), bytes], mesh);
}

#[test]
fn meshes_of_gltf() {
    let binary = brilliant(DesignFormat::Glb);
    // The first chunk serves as a text glTF as well.
    let length = u32::from_le_bytes(binary[12..16].try_into().unwrap()) as usize;
    let text = binary[20..20 + length].to_vec();
    fuzz("gltf", &[binary, text], mesh);
}

#[test]
fn scopes_lights_and_scenes() {
    let texts: Vec<Vec<u8>> = library::SCENES.iter().map(|(_, text)| text.as_bytes().to_vec()).collect();
    let lights =
        LIGHTS.iter().filter_map(|name| light_file::text(&light(name)?).ok()).map(String::into_bytes);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.toml");
    fuzz("others", &texts.into_iter().chain(lights).collect::<Vec<_>>(), |bytes| {
        std::fs::write(&path, bytes).unwrap();
        let _ = (scope_file::read(&path).is_ok(), light_file::read(&path).is_ok());
        let _ = scene_file::parse(&String::from_utf8_lossy(bytes), "x", None).is_ok();
    });
}
