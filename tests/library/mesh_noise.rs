//! Meshes whose corners are off: a stone still lies table up, is measured across the same width, and has the size that the
//! file gives it.
#![cfg(feature = "interchange")]

use crate::common::meshes::{moved, stripped};
use brillianteer::cut::{Cut, Outline, ProportionReport};
use brillianteer::io::{
    cut_file,
    design_file::{self, DesignFormat, ImportedDesign, written},
    library, mesh,
    mesh_options::{MeshForm, MeshOptions, MeshUnit},
};
use brillianteer::math::{Calipers, hull};
use brillianteer::scene::Specimen;
use glam::{DQuat, DVec3};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};

/// The sizes of the noise, in girdle radii: the most by which each coordinate of a corner is off.
const NOISES: [f64; 3] = [2e-4, 5e-4, 2e-3];

/// Returns the cuts that come with the program and are no smooth glass, each with its stone.
fn cuts() -> Vec<(&'static str, Specimen)> {
    let stone = |(name, text): &(&'static str, &str)| {
        let design = cut_file::parse(text, name).unwrap();
        (!matches!(design.cut, Cut::Glass(_))).then(|| (*name, Specimen::new(design).unwrap()))
    };
    library::CUTS.iter().filter_map(stone).collect()
}

/// Returns a corner that noise has moved; the same corner is always moved in the same way, so that triangles stay joined.
fn shaken(corner: DVec3, noise: f64) -> DVec3 {
    let mut state = corner.to_array().iter().fold(0x9e37_79b9_7f4a_7c15_u64, |state, x| {
        (state ^ x.to_bits()).wrapping_mul(0xff51_afd7_ed55_8ccd).rotate_left(31)
    });
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    corner + noise * DVec3::new(next(), next(), next())
}

/// Reads the mesh of a stone as another program would have written it, with noise, and with its table facing z or y.
fn read(specimen: &Specimen, noise: f64, is_y_up: bool) -> ImportedDesign {
    let bytes = stripped(DesignFormat::Obj, written(specimen, DesignFormat::Obj).unwrap().bytes);
    let noise_mm = noise * specimen.unit_mm();
    let lies = |v: DVec3| if is_y_up { DVec3::new(v.x, v.z, -v.y) } else { v };
    let bytes = moved(DesignFormat::Obj, bytes, &|v| lies(shaken(v, noise_mm)));
    mesh::read(bytes, Path::new("x.obj"), &MeshOptions::default()).unwrap()
}

/// The figures of a stone that show how it lies and which width it has.
#[derive(Debug)]
struct Posed {
    /// The depth divided by the cube root of the volume, which no width enters.
    depth: f64,
    /// The height of the crown, divided by the depth; 0 for triangles.
    crown: f64,
    /// The width divided by the cube root of the volume.
    width: f64,
    length_to_width: f64,
    /// The diameter by which percentages are measured, where that of the size is 2.
    diameter: f64,
}

impl Posed {
    fn of(specimen: &Specimen) -> Self {
        let size = specimen.solid().volume().cbrt();
        if let Ok(stone) = specimen.stone() {
            let Outline { width, length, diameter, bottom, top, .. } = Outline::of(&stone.polytope);
            let report = ProportionReport::of(&stone.polytope, stone.names());
            let (depth, crown) = ((top - bottom) / size, report.crown_height / report.total_depth);
            return Self { depth, crown, width: width / size, length_to_width: length / width, diameter };
        }
        let around = hull(specimen.solid().vertices().iter().map(|v| v.truncate()).collect());
        let Calipers { width, length, .. } = Calipers::of_stone(&around).unwrap();
        let (low, high) = specimen.solid().bounds();
        let depth = (high - low).z / size;
        Self { depth, crown: 0.0, width: width / size, length_to_width: length / width, diameter: 2.0 }
    }
}

/// A mesh that was read, compared with the stone that it was made from.
struct Trial {
    label: String,
    noise: f64,
    is_doubtful: bool,
    before: Posed,
    after: Posed,
}

/// Reads every cut with every noise, with z and with y up.
fn trials() -> Vec<Trial> {
    let cuts = cuts();
    let all: Vec<_> = cuts
        .iter()
        .flat_map(|cut| NOISES.into_iter().flat_map(move |noise| [false, true].map(|up| (cut, noise, up))))
        .collect();
    let trial = |((name, specimen), noise, is_y_up): ((&str, &Specimen), f64, bool)| {
        let imported = read(specimen, noise, is_y_up);
        Trial {
            label: format!("{name} with {noise}, {} up", if is_y_up { "y" } else { "z" }),
            noise,
            is_doubtful: imported.doubt == Some(true),
            before: Posed::of(specimen),
            after: Posed::of(&Specimen::new(imported.design).unwrap()),
        }
    };
    all.into_par_iter().map(|((name, specimen), noise, up)| trial(((name, specimen), noise, up))).collect()
}

#[test]
fn noise_lays_no_stone_on_its_side_nor_measures_it_across_another_width() {
    let trials = trials();
    assert!(trials.len() >= 186, "{} trials", trials.len());
    let mut doubts = 0;
    for Trial { label, noise, is_doubtful, before, after } in &trials {
        doubts += usize::from(*is_doubtful);
        let lies_alike =
            (after.depth / before.depth - 1.0).abs() < 0.02 && (after.crown - before.crown).abs() < 0.08;
        assert!(lies_alike, "{label}, doubt {is_doubtful}: {before:?} {after:?}");
        // The knife edge of a rose is where its flat facets meet, which noise moves by many times itself.
        let most = if *noise < 1e-3 || !label.starts_with("rose") { 0.003 + 3.0 * noise } else { 0.05 };
        let width = (after.width / before.width - 1.0).abs();
        let length = (after.length_to_width / before.length_to_width - 1.0).abs();
        assert!(width < most && length < most, "{label}: {before:?} {after:?}");
        // Percentages and carats are of one width.
        assert!((after.diameter - 2.0).abs() < 1e-4, "{label}: {after:?}");
    }
    assert!(doubts <= 4, "{doubts} doubts in {} trials", trials.len());
}

/// Triangles have no facets, but those of their hull show the direction of the table.
#[test]
fn what_is_read_as_triangles_lies_table_up_whichever_axis_of_its_file_is_up() {
    let stones: Vec<_> =
        cuts().into_iter().filter(|(name, _)| ["heart", "marquise", "tolkowsky"].contains(name)).collect();
    assert_eq!(stones.len(), 3);
    for (name, specimen) in &stones {
        let (low, high) = specimen.solid().bounds();
        let depth = (high - low).z / specimen.solid().volume().cbrt();
        for format in [DesignFormat::Obj, DesignFormat::Stl, DesignFormat::Ply, DesignFormat::Glb] {
            let bytes = stripped(format, written(specimen, format).unwrap().bytes);
            for turn in
                [DQuat::IDENTITY, DQuat::from_rotation_x(-FRAC_PI_2), DQuat::from_rotation_x(FRAC_PI_2)]
            {
                let bytes = moved(format, bytes.clone(), &|v| turn * v);
                let path = PathBuf::from(format!("x.{}", format.ending()));
                let options = MeshOptions { form: MeshForm::Triangles, ..MeshOptions::default() };
                let found = mesh::read(bytes, &path, &options).unwrap();
                assert!(matches!(found.design.cut, Cut::Mesh(_)) && found.doubt == Some(false));
                let solid = Specimen::new(found.design).unwrap();
                let (low, high) = solid.solid().bounds();
                // The table is up: most of the stone lies near to it.
                assert!(
                    ((high - low).z / solid.solid().volume().cbrt() / depth - 1.0).abs() < 1e-5,
                    "{name} {format:?} {turn}"
                );
                let corners = solid.solid().vertices();
                let middle = corners.iter().map(|v| v.z).sum::<f64>() / corners.len() as f64;
                assert!(middle > (low.z + high.z) / 2.0 + 0.02, "{name} {format:?} {turn}");
            }
        }
    }
}

#[test]
fn the_size_of_a_stone_is_that_of_its_file_or_assumed_with_a_note() {
    let design = cut_file::parse(library::cut("emerald").unwrap(), "emerald").unwrap();
    let specimen = Specimen::new(brillianteer::cut::Design { diameter_mm: 8.0, ..design }).unwrap();
    let open = |format: DesignFormat, scale: f64, unit: MeshUnit| {
        let bytes = stripped(format, written(&specimen, format).unwrap().bytes);
        let path = PathBuf::from(format!("x.{}", format.ending()));
        let bytes = moved(format, bytes, &|v| scale * v);
        let ImportedDesign { design, notes, .. } =
            mesh::read(bytes, &path, &MeshOptions { unit, ..MeshOptions::default() }).unwrap();
        let noted = notes.into_iter().filter(|note| note.contains("mm across")).collect::<Vec<_>>();
        (design.diameter_mm, noted.join("; "))
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-5 * b;
    for format in [DesignFormat::Obj, DesignFormat::Stl, DesignFormat::Ply] {
        let (size, note) = open(format, 1.0, MeshUnit::Found);
        assert!(near(size, 8.0) && note.contains("taken to be in mm"), "{format:?}: {size} {note}");
        let (size, note) = open(format, 1e-3, MeshUnit::Found);
        assert!(size == 6.5 && note.contains("not known"), "{format:?}: {size} {note}");
        let (size, note) = open(format, 1e-3, MeshUnit::Millimetres(1000.0));
        assert!(near(size, 8.0) && note.is_empty(), "{format:?}: {size} {note}");
    }
    let (size, note) = open(DesignFormat::Glb, 1.0, MeshUnit::Found);
    assert!(near(size, 8.0) && note.is_empty(), "{size} {note}");
    let (size, note) = open(DesignFormat::Glb, 1000.0, MeshUnit::Found);
    assert!(size == 6.5 && note.contains("8.0000 m across"), "{size} {note}");
}

#[test]
fn what_a_file_of_this_program_says_of_its_size_needs_no_note_and_yields_to_a_unit_that_is_given() {
    let (_, specimen) = cuts().swap_remove(0);
    for format in [DesignFormat::Obj, DesignFormat::Stl, DesignFormat::Ply, DesignFormat::Glb] {
        let bytes = written(&specimen, format).unwrap().bytes;
        let path = PathBuf::from(format!("x.{}", format.ending()));
        let open = |unit, bytes: Vec<u8>| {
            mesh::read(bytes, &path, &MeshOptions { unit, ..MeshOptions::default() }).unwrap()
        };
        let kept = open(MeshUnit::Found, bytes.clone());
        assert_eq!(kept.design.diameter_mm, specimen.design.diameter_mm);
        assert!(!kept.notes.iter().any(|note| note.contains("mm across")), "{:?}", kept.notes);
        let doubled = moved(format, bytes, &|v| 2.0 * v);
        let unit_mm = if format == DesignFormat::Glb { 1000.0 } else { 1.0 };
        let given = open(MeshUnit::Millimetres(unit_mm), doubled);
        let ratio = given.design.diameter_mm / specimen.design.diameter_mm;
        assert!((ratio - 2.0).abs() < 1e-5 && given.warnings.is_empty(), "{ratio} {:?}", given.warnings);
    }
}

/// The trials that failed for others; they are not part of the project.
#[test]
fn meshes_that_lay_on_their_side_or_were_measured_across_corners_are_read_as_meant() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/trials"));
    if !folder.is_dir() {
        println!("SKIPPED: {} is not there", folder.display());
        return;
    }
    let measured = |name: &str| {
        let ImportedDesign { design, notes, .. } = design_file::read(&folder.join(name)).unwrap();
        let specimen = Specimen::new(design).unwrap();
        let stone = specimen.stone().unwrap();
        (ProportionReport::of(&stone.polytope, stone.names()), specimen.design.diameter_mm, notes)
    };
    let near = |a: f64, b: f64, within: f64| assert!((a - b).abs() <= within, "{a} is not {b}");
    let (brilliant, ..) = measured("brilliant-lies-on-its-side.obj");
    near(brilliant.length_to_width, 1.0, 5e-3);
    // Its corners lie on a circle of 2.00 and 1.32 above one another; those of the table on a circle of 1.08.
    near(brilliant.total_depth, 66.0, 0.2);
    near(brilliant.table[0], 54.0 * (std::f64::consts::PI / 8.0).cos(), 0.2);
    let (pear, ..) = measured("pear-jitter-0.05-percent-lies-on-its-side.obj");
    near(pear.total_depth, 60.9, 0.3);
    near(pear.length_to_width, 1.6, 5e-3);
    let (princess, ..) = measured("princess-scan-measured-across-corners.obj");
    near(princess.total_depth, 69.5, 0.2);
    near(princess.table[0], 69.6, 0.3);
    let (_, diameter_mm, notes) = measured("scan-of-8mm.stl");
    // It is 8 mm from corner to corner and has eight sides, so that its width is from side to side.
    near(diameter_mm, 8.0 * (std::f64::consts::PI / 8.0).cos(), 1e-3);
    assert!(notes.iter().any(|note| note.contains("the file states no unit")), "{notes:?}");
}
