//! Tests of real meshes, where they are on the machine, and of large meshes that the tests make.

use super::*;
use crate::solids::divided;

/// Reads one of the real meshes; prints a line and returns `None` where their folder is not there.
fn real(name: &str) -> Option<MeshFile> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/mesh"));
    if !folder.is_dir() {
        println!("SKIPPED: {} is not there", folder.display());
        return None;
    }
    Some(read(&folder.join(name)).unwrap())
}

/// Returns a stone's tiers: name, number of facets, degrees from the girdle plane.
fn tiers(stone: &FromMesh) -> Vec<(String, usize, f64)> {
    let mut tiers: Vec<(String, usize, f64)> = vec![];
    for (name, plane) in &stone.facets {
        let stem = brillianteer_cut::tier_stem(name).to_owned();
        let slope = plane.normal.z.abs().min(1.0).acos().to_degrees();
        match tiers.last_mut().filter(|t| t.0 == stem) {
            Some(last) => last.1 += 1,
            None => tiers.push((stem, 1, (10.0 * slope).round() / 10.0)),
        }
    }
    tiers
}

#[test]
fn real_meshes_open_as_what_they_are() {
    // The number of facets, the order of symmetry that is found, and how near corners must lie to facets, in girdle radii;
    // `None` for a mesh that is dented.
    let expected = [
        ("deepar-princess.obj", Some((69, 4, 5e-4))),
        ("diamond-webgl-brilliant_cut.obj", Some((89, 8, 1e-5))),
        ("diamond-webgl-oval_cut.obj", Some((71, 2, 1e-4))),
        ("gkjohnson-diamond.glb", Some((69, 1, 2e-3))),
    ];
    for (name, expected) in expected {
        let Some(file) = real(name) else { return };
        let mended = file.surface.mend().unwrap();
        let found = match facets(mended.surface) {
            SurfaceKind::Convex(found) => Some(found),
            SurfaceKind::Concave(_) => None,
        };
        println!("{name}: {:?}", mended.mending);
        assert_eq!(found.is_some(), expected.is_some(), "{name}");
        let (Some(found), Some((count, turns, within))) = (found, expected) else { continue };
        let stone = from_mesh(&found, Up::Found, Evening::default()).unwrap();
        println!("  deviation {:.1e}, {:?}", stone.deviation, tiers(&stone));
        assert_eq!((stone.facets.len(), stone.evened.turns), (count, turns), "{name}");
        assert!(stone.deviation < within, "{name}: {}", stone.deviation);
        assert_eq!(stone.facets[0].0, "table");
    }
}

#[test]
fn a_million_triangles_load_in_seconds() {
    let file = open(write_stl(&body(96), 3.0, None).unwrap());
    let mut surface = file.surface.mend().unwrap().surface;
    while surface.triangles.len() < 1_000_000 {
        surface = divided(&surface);
    }
    let mut bytes = vec![0; 80];
    bytes.extend((surface.triangles.len() as u32).to_le_bytes());
    for t in 0..surface.triangles.len() {
        bytes.extend([0; 12]);
        surface
            .corners(t)
            .iter()
            .flat_map(|c| c.as_vec3().to_array())
            .for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    let start = std::time::Instant::now();
    let file = open(bytes);
    let read = start.elapsed().as_secs_f64();
    let mended = file.surface.mend().unwrap();
    let welded = start.elapsed().as_secs_f64();
    let SurfaceKind::Convex(found) = facets(mended.surface) else { panic!("taken for concave") };
    let faceted = start.elapsed().as_secs_f64();
    let stone_back = from_mesh(&found, Up::Found, Evening::default()).unwrap();
    let all = start.elapsed().as_secs_f64();
    println!(
        "{} triangles: read {read:.2} s, mended {welded:.2} s, facets {faceted:.2} s, posed {all:.2} s; tolerance {:.1e}",
        surface.triangles.len(),
        found.tolerance
    );
    assert_eq!(stone_back.facets.len(), brilliant(96).names().len());
    // It takes five seconds, and many times as long where other programs hold the cores.
    assert!(all < 300.0, "{all} s");
}
