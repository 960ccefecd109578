//! Reads real files of real cutters where there are any: in `../shared/data`, beside the checkout.
#![cfg(feature = "interchange")]

use brillianteer::cut::{Cut, Outline, SheetFigures, Tiers};
use brillianteer::io::design_file::{self, DesignFormat, written};
use brillianteer::math::{Facet, Polytope};
use brillianteer::scene::{Specimen, Stone};
use glam::DVec3;
use serde_json::Value;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/asc");

/// Returns the files with these extensions, in order; where there is no corpus, none, with a message.
pub fn files(endings: &[&str]) -> Vec<PathBuf> {
    if !Path::new(CORPUS).is_dir() {
        println!("SKIPPED: {CORPUS} is not there, so no real file is read");
        return vec![];
    }
    let folders = [CORPUS.to_owned(), format!("{CORPUS}/library")];
    let listed = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let mut files: Vec<PathBuf> = listed.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| {
        file.extension().is_some_and(|e| endings.contains(&e.to_string_lossy().to_lowercase().as_str()))
    });
    files.sort();
    assert!(!files.is_empty(), "{CORPUS} holds no file that ends in {endings:?}");
    files
}

fn open(file: &Path) -> Result<Specimen, String> {
    let imported = design_file::read(file).map_err(|e| e.to_string())?;
    Specimen::new(imported.design).map_err(|e| e.to_string())
}

/// Files that make no stone, each with the reason that a look into the file showed.
const NO_STONE: [(&str, &str); 1] = [("gemcadviewer-sample-01.asc", "no facet is listed")];

#[test]
fn nearly_every_text_file_opens_and_the_others_say_why() {
    let files = files(&["asc"]);
    let mut failed = 0;
    for file in &files {
        let Err(why) = open(file) else { continue };
        failed += 1;
        let name = file.file_name().unwrap().to_string_lossy();
        println!("{name}: {why}");
        let known = NO_STONE.iter().find(|(known, _)| *known == name);
        assert!(known.is_some_and(|(_, reason)| why.contains(reason)), "{name}: {why}");
    }
    assert!(failed as f64 <= 0.005 * files.len() as f64, "{failed} of {} do not open", files.len());
    println!("{} of {} open", files.len() - failed, files.len());
}

fn tiers(specimen: &Specimen) -> &Tiers {
    let Cut::Tiers(tiers) = &specimen.design.cut else { panic!("tiers are expected") };
    tiers
}

/// Writes a stone in a format and reads it again; returns it with the messages about what is lost.
fn again(specimen: &Specimen, format: DesignFormat) -> (Specimen, Vec<String>) {
    let written = written(specimen, format).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("again.{}", format.ending()));
    std::fs::write(&path, written.bytes).unwrap();
    (open(&path).unwrap_or_else(|why| panic!("{}: {why}", specimen.design.name)), written.lost)
}

#[test]
fn what_is_written_reads_back_equal() {
    for file in files(&["asc"]) {
        let Ok(specimen) = open(&file) else { continue };
        for format in [DesignFormat::Toml, DesignFormat::Asc] {
            let (back, lost) = again(&specimen, format);
            assert!(lost.iter().all(|what| what.starts_with("the name ")), "{}: {lost:?}", file.display());
            assert!(tiers(&back) == tiers(&specimen), "{} as {}", file.display(), format.ending());
        }
    }
}

#[test]
fn a_stone_written_as_a_mesh_is_read_as_a_stone() {
    // The ratio is the same however the stone is turned and scaled.
    let compact = |s: &Specimen| {
        s.stone().unwrap().polytope.volume() / s.stone().unwrap().polytope.surface_area().powf(1.5)
    };
    for file in files(&["asc"]).iter().step_by(25) {
        let Ok(specimen) = open(file) else { continue };
        for format in [DesignFormat::Obj, DesignFormat::Stl, DesignFormat::Glb] {
            let (back, _) = again(&specimen, format);
            let (after, before) = (compact(&back), compact(&specimen));
            let (name, ending) = (file.display(), format.ending());
            assert!((after / before - 1.0).abs() < 1e-3, "{name} as {ending}: {after} {before}");
        }
    }
}

/// The largest error of a plane that goes through other formats, in girdle radii: the last digit of tiers given by angles.
const SAME_PLANE: f64 = 1e-8;

#[test]
fn every_format_holds_every_stone() {
    for file in files(&["asc"]).iter().step_by(10) {
        let Ok(specimen) = open(file) else { continue };
        for format in [DesignFormat::Gem, DesignFormat::Gcs] {
            let (back, _) = again(&specimen, format);
            let (name, ending) = (file.display(), format.ending());
            assert_eq!(
                back.stone().unwrap().polytope.facets().len(),
                specimen.stone().unwrap().polytope.facets().len(),
                "{name} as {ending}"
            );
            for (a, b) in
                back.stone().unwrap().polytope.planes().zip(specimen.stone().unwrap().polytope.planes())
            {
                let apart = (a.normal - b.normal).length().max((a.offset - b.offset).abs());
                assert!(apart < SAME_PLANE, "{name} as {ending}: {apart:e}");
            }
        }
    }
}

#[test]
fn twins_of_text_and_bytes_agree() {
    let all = files(&["asc"]);
    let twins: Vec<_> =
        all.iter().map(|asc| (asc, asc.with_extension("gem"))).filter(|(_, gem)| gem.exists()).collect();
    assert!(all.is_empty() || twins.len() >= 3, "{twins:?}");
    for (asc, gem) in twins {
        let [text, bytes] = [asc, &gem].map(|file| design_file::read(file).unwrap().design.facets().unwrap());
        assert_eq!(text.len(), bytes.len(), "{}", asc.display());
        for (name, plane) in &text {
            let apart = bytes.iter().map(|(_, other)| {
                (other.normal - plane.normal).length().max((other.offset - plane.offset).abs())
            });
            let nearest = apart.fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-5, "{}: {name} is off by {nearest:e}", asc.display());
        }
    }
}

/// Counts how often a figure agrees with the library's, and holds the share that must agree.
struct Tally {
    what: &'static str,
    least: f64,
    agree: usize,
    differ: Vec<String>,
}

impl Tally {
    fn count(&mut self, file: &str, ours: f64, theirs: f64) {
        if (ours - theirs).abs() <= 0.005 * theirs.abs().max(1e-3) {
            self.agree += 1;
        } else {
            self.differ.push(format!("{file}: {ours:.5} against {theirs:.5}"));
        }
    }
}

#[test]
fn what_is_measured_is_what_the_library_says() {
    let path = format!("{CORPUS}/library-metadata.json");
    let Ok(text) = std::fs::read_to_string(&path) else { return println!("SKIPPED: {path} is not there") };
    let entries: Vec<Value> = serde_json::from_str(&text).unwrap();
    let by_name: BTreeMap<&str, &Value> = entries.iter().map(|e| (e["name"].as_str().unwrap(), e)).collect();
    let tally = |(what, least)| Tally { what, least, agree: 0, differ: vec![] };
    let keys = ["lw", "pw", "cw", "tw", "uw", "facetCount", "girdleCount"].map(|what| (what, 0.99));
    let mut tallies = keys.map(tally);
    // By the library's own rule for girdles only the solids are compared.
    let mut by_their_rule = [("pw", 0.995), ("cw", 0.995)].map(tally);
    for file in files(&["asc", "gem"]) {
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        let (Some(entry), Ok(specimen)) = (by_name.get(name.as_str()), open(&file)) else { continue };
        let stone = specimen.stone().unwrap();
        let theirs = |tally: &Tally| entry[tally.what].as_f64().unwrap();
        // Where the library finds no girdle it gives half of the stone's depth for each, which measures nothing.
        let sees_girdle = entry["girdleCount"] != 0;
        for (tally, ours) in tallies.iter_mut().zip(measured(stone)) {
            if sees_girdle || !["pw", "cw"].contains(&tally.what) {
                tally.count(&name, ours, theirs(tally));
            }
        }
        for (tally, ours) in by_their_rule.iter_mut().zip(depths_by_their_rule(&stone.polytope)) {
            if sees_girdle {
                tally.count(&name, ours, theirs(tally));
            }
        }
    }
    let all = tallies.iter().map(|tally| ("", tally));
    let all = all.chain(by_their_rule.iter().map(|tally| (" by the library's rule", tally)));
    for (how, Tally { what, least, agree, differ }) in all {
        let share = *agree as f64 / (agree + differ.len()) as f64;
        println!(
            "{what}{how}: {agree} of {} agree, {:.2} %; not {}",
            agree + differ.len(),
            100.0 * share,
            differ.iter().take(8).cloned().collect::<Vec<_>>().join(", ")
        );
        assert!(*agree > 1000 && share >= *least, "{what}{how}: {differ:#?}");
    }
}

/// Returns the figures of a cutter's sheet: L/W, P/W, C/W, T/W, U/W, facets, girdle facets.
fn measured(stone: &Stone) -> [f64; 7] {
    let found = SheetFigures::of(&stone.polytope, stone.names());
    // The library counts each of several facets in one plane.
    let twice = stone.polytope.merged().len();
    [
        found.length_to_width,
        found.pavilion_to_width,
        found.crown_to_width,
        found.table_to_width,
        found.table_across_to_width,
        (found.facets + found.girdle_facets + twice) as f64,
        found.girdle_facets as f64,
    ]
}

/// Returns the width that the library relates its figures to: the smaller of the extents along x and y.
fn width_along_axes(stone: &Polytope) -> f64 {
    let (low, high) = stone.bounds();
    (high - low).truncate().min_element()
}

/// Returns the depths of pavilion and crown, relative to the width, by the library's rule.
///
/// The rule divides each upright facet into a fan of triangles and sorts the corners of all triangles from below. The
/// corners a tenth and nine tenths of the way up the list give the girdle's edges.
fn depths_by_their_rule(stone: &Polytope) -> [f64; 2] {
    let (Outline { bottom, top, .. }, width) = (Outline::of(stone), width_along_axes(stone));
    let upright = stone.facets().iter().filter(|facet| facet.plane.normal.z.abs() < 1f64.to_radians().sin());
    let mut levels: Vec<f64> = upright.flat_map(|facet| levels_of_fan(stone, facet)).collect();
    levels.sort_by(f64::total_cmp);
    let Some(last) = levels.len().checked_sub(1) else { return [0.0; 2] };
    let at = |tenths: usize| levels[last * tenths / 10];
    [at(1) - bottom, top - at(9)].map(|depth| depth / width)
}

/// Returns z of the corners of the triangles of an upright facet: once for each triangle that meets in a corner.
fn levels_of_fan(stone: &Polytope, facet: &Facet) -> Vec<f64> {
    let corners: Vec<DVec3> = stone.corners(facet).collect();
    let mean = corners.iter().sum::<DVec3>() / corners.len() as f64;
    // The fan starts at the first corner, counter-clockwise from outside, after the right of the facet's middle or after
    // its left, depending on the side of the stone.
    let DVec3 { x, y, .. } = facet.plane.normal;
    let from_right = if x.abs() > 0.9 { x < 0.0 } else { y > 0.0 };
    let right = DVec3::Z.cross(facet.plane.normal);
    let turn = |k: usize| {
        let from_middle = corners[k] - mean;
        let angle = from_middle.z.atan2(from_middle.dot(right));
        (angle - if from_right { 0.0 } else { PI }).rem_euclid(TAU)
    };
    let first = (0..corners.len()).min_by(|&a, &b| turn(a).total_cmp(&turn(b))).unwrap();
    let triangles = |k: usize| match (k + corners.len() - first) % corners.len() {
        0 => corners.len() - 2,
        from if from == 1 || from == corners.len() - 1 => 1,
        _ => 2,
    };
    corners.iter().enumerate().flat_map(|(k, corner)| vec![corner.z; triangles(k)]).collect()
}
