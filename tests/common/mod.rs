//! Helpers of several tests: stones from cut files, random stones, figures by zone.

pub mod maps;
pub mod meshes;
#[cfg(feature = "gpu")]
pub mod pixels;
pub mod scans;
pub mod shoot;
pub mod solids;

use brillianteer::base::unwatched;
use brillianteer::cut::{Crown, Cut, DesignError, LowerHalf, Pavilion, RoundBrilliant};
use brillianteer::io::cut_file;
use brillianteer::math::Plane;
use brillianteer::measure::{Figures, by_beams};
use brillianteer::scene::{ASET_CONE, Backing, Medium, Scope, Stone, View};
use brillianteer::trace::beam;
use glam::DVec3;
use proptest::prelude::*;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The project's cut files whose bodies are not bounded by planes that enclose a convex solid, so that beams cannot trace
/// them: the heart is a mesh with a cleft, the others are curved.
const NOT_BETWEEN_PLANES: [&str; 4] = ["cube", "heart", "pill", "plate"];

/// Returns the project's cut files of convex stones between planes, of every family, with their names.
pub fn cut_files() -> Vec<(String, PathBuf)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cuts");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.retain(|p| p.extension().is_some_and(|e| e == "toml"));
    files.sort();
    let named = files.into_iter().map(|p| (p.file_stem().unwrap().to_string_lossy().into_owned(), p));
    let (others, convex): (Vec<_>, Vec<_>) =
        named.partition(|(name, _)| NOT_BETWEEN_PLANES.contains(&name.as_str()));
    assert_eq!(others.len(), NOT_BETWEEN_PLANES.len(), "{others:?}");
    for (name, path) in others {
        let facets = cut_file::read(&path).unwrap().facets();
        assert!(matches!(facets, Err(DesignError::NotConvex(_))), "{name} lies between planes: trace it too");
    }
    assert!(convex.len() >= 29, "the project's cut files are missing");
    convex
}

/// Returns the cut files of round brilliants among [`cut_files`].
pub fn round_brilliants() -> Vec<(String, PathBuf)> {
    let mut files = cut_files();
    files.retain(|(_, path)| matches!(cut_file::read(path).unwrap().cut, Cut::RoundBrilliant(_)));
    assert!(files.len() >= 6, "the project's round brilliants are missing");
    files
}

/// The stone of a cut file.
pub fn stone(path: &Path) -> Stone {
    Stone::new(&cut_file::read(path).unwrap().facets().unwrap()).unwrap()
}

/// Returns a round brilliant with a pointed culet and a girdle of 3 %.
pub fn brilliant(
    (table, crown, pavilion): (f64, f64, f64),
    (star, lower): (f64, f64),
    girdle_facets: u32,
) -> RoundBrilliant {
    RoundBrilliant {
        table,
        crown: Crown::Angle(crown),
        pavilion: Pavilion::Angle(pavilion),
        star_length: star,
        lower_half: LowerHalf::Radial(lower),
        girdle_thickness: 3.0,
        girdle_facets,
        culet: 0.0,
    }
}

/// Builds the stone of a round brilliant.
pub fn built(cut: &RoundBrilliant) -> Stone {
    Stone::new(&cut.facets().unwrap()).unwrap()
}

pub fn aset() -> Scope {
    Scope::aset(ASET_CONE, Backing::Black)
}

/// Traces the beams of a stone until no more than `unresolved` of the light is left.
pub fn traced(stone: &Stone, medium: Medium, view: &View, unresolved: f64, polarised: bool) -> beam::Beams {
    let options = beam::BeamOptions { unresolved, polarised, ..beam::BeamOptions::default() };
    beam::trace(&stone.polytope, medium, view, &options, &unwatched).unwrap()
}

/// ASET figures of a stone seen face up.
pub fn face_up(stone: &Stone, medium: Medium, unresolved: f64) -> Figures {
    by_beams(&traced(stone, medium, &View::default(), unresolved, true), &aset())
}

/// Returns the figures of a view in one list, so that two views can be compared.
pub fn row(figures: &Figures) -> Vec<f64> {
    let zones = [&figures.surface, &figures.transmitted, &figures.strongest_exit_area];
    zones.into_iter().flatten().copied().chain([figures.absorbed]).collect()
}

/// Returns the largest difference between two lists of figures.
pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Generates the planes of a random convex solid: a cube that some planes cut.
pub fn random_planes() -> impl Strategy<Value = Vec<Plane>> {
    let plane =
        (0.0..std::f64::consts::TAU, -1.0..1.0_f64, 0.55..1.2_f64).prop_map(|(azimuth, z, offset)| {
            let r = (1.0 - z * z).sqrt();
            Plane::new(DVec3::new(r * azimuth.cos(), r * azimuth.sin(), z), offset)
        });
    prop::collection::vec(plane, 4..24).prop_map(|mut planes| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        planes.extend(axes.into_iter().flat_map(|a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)]));
        planes
    })
}

/// Builds a stone of planes that have no names of their own.
pub fn nameless(planes: &[Plane]) -> Stone {
    let named: Vec<(String, Plane)> = planes.iter().map(|&p| ("facet".to_string(), p)).collect();
    Stone::new(&named).unwrap()
}

/// Returns the path of files that the project does not own; `None`, with a message that the test is skipped, where they are
/// missing.
pub fn shared(test: &str, path: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(path);
    if path.exists() {
        return Some(path);
    }
    // Written directly, because the test harness hides what passing tests print.
    let _ = writeln!(std::io::stderr(), "SKIPPED {test}: {} is not on this machine", path.display());
    None
}

/// Returns the card; where there is none, `None` with a message that the test is skipped, or a failure where a card is
/// required.
#[cfg(feature = "gpu")]
pub fn card(test: &str) -> Option<brillianteer::trace::gpu::Gpu> {
    match brillianteer::trace::gpu::Gpu::open() {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_some() => panic!("{test}: {error}"),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "SKIPPED {test}: {error}");
            None
        }
    }
}
