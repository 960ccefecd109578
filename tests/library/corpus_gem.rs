//! Reads real designs of gem cutters, `.gem` and `.gcs`: each opens, and is the same after it is written and read again. The
//! designs are not part of the project; where they are missing the tests print a message and pass.
#![cfg(feature = "interchange")]

use brillianteer::cut::{Cut, Design, Tiers};
use brillianteer::io::{design_file::ImportedDesign, gcs, gem};
use brillianteer::math::Plane;
use brillianteer::scene::Specimen;
use std::path::{Path, PathBuf};

/// The largest difference, relative to their size, of planes that are written and read again.
const SAME: f64 = 1e-12;

/// The largest difference of planes that are given in degrees and teeth from those in the file.
const AS_STORED: f64 = 1e-10;

/// Returns the real files with an extension, sorted; `None` where there are no real files at all.
fn corpus(extension: &str) -> Option<Vec<PathBuf>> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data"));
    if !folder.is_dir() {
        println!("SKIPPED: {} is not there", folder.display());
        return None;
    }
    let mut files = Vec::new();
    for sub in ["asc", "asc/library"] {
        let entries = std::fs::read_dir(folder.join(sub)).unwrap().map(|entry| entry.unwrap().path());
        files.extend(
            entries.filter(|path| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension))),
        );
    }
    files.sort();
    assert!(!files.is_empty(), "no .{extension} among the real files");
    Some(files)
}

fn tiers(design: &Design) -> &Tiers {
    let Cut::Tiers(tiers) = &design.cut else { panic!("{} is not cut by tiers", design.name) };
    tiers
}

fn planes(design: &Design) -> Vec<Plane> {
    design.facets().unwrap().into_iter().map(|(_, plane)| plane).collect()
}

/// Returns the largest difference between the planes of two lists, relative to their size.
fn apart(one: &[Plane], other: &[Plane]) -> f64 {
    assert_eq!(one.len(), other.len());
    let pair = |(a, b): (&Plane, &Plane)| {
        (a.normal - b.normal)
            .length()
            .max((a.offset - b.offset).abs() / a.offset.abs().max(f64::MIN_POSITIVE))
    };
    // A plane through the origin has no size of its own.
    let sized = one.iter().zip(other).filter(|(a, b)| a.offset.max(b.offset) > 1e-14);
    sized.map(pair).fold(0.0, f64::max)
}

/// Reads the planes that a file stores, by a reader of the test's own: three numbers each, with y in the opposite direction.
fn stored(bytes: &[u8]) -> Vec<Plane> {
    let f64_at = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    let (mut at, mut planes) = (0, Vec::new());
    while f64_at(at) != -99999.0 {
        let p = glam::DVec3::new(f64_at(at), -f64_at(at + 8), f64_at(at + 16));
        planes.push(Plane::new(p, 1.0).normalized().unwrap());
        at += 28 + 1 + usize::from(bytes[at + 28]);
        while bytes[at] == 1 {
            at += 28;
        }
        at += 4;
    }
    planes
}

/// Reads the corners that a file stores.
fn corners(bytes: &[u8]) -> Vec<glam::DVec3> {
    let f64_at = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    let (mut at, mut corners) = (0, Vec::new());
    while f64_at(at) != -99999.0 {
        at += 28 + 1 + usize::from(bytes[at + 28]);
        while bytes[at] == 1 {
            corners.push(glam::DVec3::new(f64_at(at + 4), f64_at(at + 12), f64_at(at + 20)));
            at += 28;
        }
        at += 4;
    }
    corners
}

#[test]
fn every_real_gem_opens_and_reads_as_it_is_written() {
    let Some(files) = corpus("gem") else { return };
    let (mut worst, mut again, mut unlike, mut solids, mut warned) = (0.0_f64, 0.0_f64, vec![], 0, vec![]);
    for path in &files {
        let (bytes, label) = (std::fs::read(path).unwrap(), path.display().to_string());
        assert!(gem::looks_like(&bytes), "{label}");
        assert!(!gcs::looks_like(&bytes), "{label}");
        let ImportedDesign { design, warnings, .. } =
            gem::read(&bytes, &label).unwrap_or_else(|e| panic!("{e}"));
        warned.extend(warnings.iter().map(|warning| format!("{}: {warning}", design.name)));
        worst = worst.max(apart(&stored(&bytes), &planes(&design)));
        let specimen = match Specimen::new(design.clone()) {
            Ok(specimen) => specimen,
            Err(error) => {
                println!("no solid: {label}: {error}");
                continue;
            }
        };
        solids += 1;
        let written = gem::write(&specimen);
        let back = gem::read(&written.bytes, &label).unwrap().design;
        again = again.max(apart(&planes(&design), &planes(&back)));
        assert_eq!(tiers(&design).headers, tiers(&back).headers);
        if design != back {
            unlike.push(label);
        }
    }
    println!(
        "{} files, {solids} solids; off the stored planes {worst:.1e}, written and read {again:.1e}",
        files.len()
    );
    println!("{} warnings:\n{}", warned.len(), warned.join("\n"));
    assert!(unlike.is_empty(), "{} read otherwise than written: {unlike:#?}", unlike.len());
    assert!(worst < AS_STORED && again < SAME);
    assert!(solids * 100 >= files.len() * 95, "{solids} of {}", files.len());
}

/// Compares with the figures that the designs' library has found of each by its own reader.
#[test]
fn a_second_opinion_agrees_on_gear_index_lines_and_facets() {
    let Some(files) = corpus("gem") else { return };
    let folder =
        files.iter().find_map(|path| path.ancestors().find(|a| a.join("library-metadata.json").is_file()));
    let text = std::fs::read_to_string(folder.unwrap().join("library-metadata.json")).unwrap();
    let entries: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    let (mut compared, mut unlike) = (0, vec![]);
    for path in files.iter().filter(|path| path.parent().unwrap().ends_with("library")) {
        let file = path.file_name().unwrap().to_string_lossy();
        let Some(entry) = entries.iter().find(|entry| entry["name"] == *file) else { continue };
        let design = gem::read(&std::fs::read(path).unwrap(), &file).unwrap().design;
        // The library's reader leaves out unbounded facets.
        let specimen = Specimen::new(design.clone()).unwrap();
        if specimen.stone().unwrap().names().iter().any(|name| name.starts_with("block")) {
            continue;
        }
        compared += 1;
        let cut = tiers(&design);
        let index = design.material.material().unwrap().index(589.3);
        // The library's reader trims its lines.
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        let same = [
            f64::from(cut.gear.abs()) == entry["gear"].as_f64().unwrap(),
            (index - entry["ri"].as_f64().unwrap()).abs() < 1e-9,
            words(&cut.headers.join("\n")) == words(entry["header"].as_str().unwrap()),
            words(&cut.footers.join("\n")) == words(entry["comments"].as_str().unwrap()),
            cut.count() as f64 == entry["facetCount"].as_f64().unwrap(),
        ];
        if same.contains(&false) {
            unlike.push((file.clone(), same));
        }
    }
    println!("{compared} compared, unlike: {unlike:#?}");
    assert!(compared > 0 && unlike.is_empty());
}

/// The program does not read the corners that files store, but the planes must meet in them.
#[test]
fn stones_have_the_corners_that_their_files_store() {
    let Some(files) = corpus("gem") else { return };
    let (mut blanks, mut offs): (usize, Vec<(f64, String)>) = (0, vec![]);
    for path in files {
        let bytes = std::fs::read(&path).unwrap();
        let ImportedDesign { design, warnings, .. } = gem::read(&bytes, "x").unwrap();
        blanks += usize::from(warnings.iter().any(|warning| warning.contains("block")));
        if warnings.iter().any(|warning| warning.contains("block")) {
            continue;
        }
        let specimen = Specimen::new(design).unwrap();
        let (ours, theirs) = (corners(&gem::write(&specimen).bytes), corners(&bytes));
        let near = |a: &glam::DVec3, all: &[glam::DVec3]| {
            all.iter().map(|b| b.distance(*a)).fold(f64::INFINITY, f64::min)
        };
        let off = theirs.iter().map(|a| near(a, &ours)).fold(0.0, f64::max);
        offs.push((off, path.file_name().unwrap().to_string_lossy().into_owned()));
    }
    offs.sort_by(|a, b| a.0.total_cmp(&b.0));
    println!(
        "{blanks} end at the block; {} do not: median {:.1e}; worst {:?}",
        offs.len(),
        offs[offs.len() / 2].0,
        &offs[offs.len() - 5..]
    );
    assert!(offs[offs.len() / 2].0 < 1e-9);
}

#[test]
fn stones_have_the_volumes_that_are_known() {
    let Some(files) = corpus("gem") else { return };
    for (name, volume) in [("SRB", 1.672616), ("CubeIllusionTri", 1.222301), ("Compear125", 0.795785)] {
        let path = files.iter().find(|path| path.file_stem().is_some_and(|stem| stem == name)).unwrap();
        let design = gem::read(&std::fs::read(path).unwrap(), name).unwrap().design;
        let solid = brillianteer::math::Polytope::from_planes(&planes(&design)).unwrap();
        println!("{name}: {:.9}", solid.volume());
        assert!((solid.volume() - volume).abs() < 1e-6, "{name}: {}", solid.volume());
    }
}

/// Returns the values of an attribute throughout a text.
fn numbers(xml: &str, key: &str) -> Vec<f64> {
    xml.split(&format!("{key}=\""))
        .skip(1)
        .map(|text| text.split('"').next().unwrap().parse().unwrap())
        .collect()
}

#[test]
fn every_real_gcs_opens_and_reads_as_it_is_written() {
    let Some(files) = corpus("gcs") else { return };
    for path in files {
        let (bytes, label) = (std::fs::read(&path).unwrap(), path.display().to_string());
        assert!(gcs::looks_like(&bytes) && !gem::looks_like(&bytes));
        let ImportedDesign { design, warnings, .. } =
            gcs::read(&bytes, &label).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(warnings, Vec::<String>::new());
        let cut = tiers(&design);
        println!("{label}: {} tiers, {} facets, remarks {:?}", cut.tiers.len(), cut.count(), cut.remarks);
        let specimen = Specimen::new(design.clone()).unwrap();
        let written = gcs::write(&specimen);
        assert_eq!(gcs::read(&written.bytes, &label).unwrap().design, design);
        let [ours, theirs] =
            [&written.bytes, &bytes].map(|xml| std::str::from_utf8(xml).unwrap().replace("base", "offset"));
        for key in [" angle", "depth", "index_angle", "nx", "ny", "nz", "gear", "offset", "mirror"] {
            let (ours, theirs) = (numbers(&ours, key), numbers(&theirs, key));
            assert_eq!(ours.len(), theirs.len(), "{key}");
            let off = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("{key}: {} numbers, off by {off:.1e}", ours.len());
            assert!(off < 1e-9, "{key}");
        }
    }
}

#[test]
fn real_designs_go_from_one_format_to_the_other_and_back() {
    let Some(files) = corpus("gem") else { return };
    let (mut worst, mut unlike) = (0.0_f64, vec![]);
    for path in files {
        let label = path.display().to_string();
        let design = gem::read(&std::fs::read(&path).unwrap(), &label).unwrap().design;
        let Ok(specimen) = Specimen::new(design) else { continue };
        let ImportedDesign { design, warnings, .. } =
            gcs::read(&gcs::write(&specimen).bytes, &label).unwrap_or_else(|e| panic!("{e}"));
        if !warnings.is_empty() {
            println!("{label}: {warnings:?}");
        }
        let specimen = Specimen::new(design.clone()).unwrap_or_else(|e| panic!("{label}: {e}"));
        let back = gcs::read(&gcs::write(&specimen).bytes, &label).unwrap().design;
        worst = worst.max(apart(&planes(&design), &planes(&back)));
        if design != back {
            unlike.push(label);
        }
    }
    println!("written and read {worst:.1e}; unlike: {unlike:#?}");
    assert!(worst < SAME && unlike.is_empty());
}
