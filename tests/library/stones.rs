//! Writes stones as meshes and reads them back: as this program writes them, turned, and as another program would write
//! them.
#![cfg(feature = "interchange")]

use crate::common::meshes::{moved, stripped, turned};
use brillianteer::base::unwatched;
use brillianteer::cut::{Cut, Design, FacetZones, Outline, ProportionReport, SheetFigures, from_mesh::Up};
use brillianteer::io::{
    asc, cut_file,
    design_file::{self, DesignFormat, written},
    library, mesh,
    mesh_options::MeshOptions,
};
use brillianteer::measure::by_beams;
use brillianteer::scene::{ASET_CONE, Backing, Scope, Specimen, View};
use brillianteer::trace::beam;
use glam::{DQuat, DVec3};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

const FORMATS: [DesignFormat; 4] =
    [DesignFormat::Obj, DesignFormat::Stl, DesignFormat::Ply, DesignFormat::Glb];

/// The change of a file between being written and being read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// The file stays as it is.
    Kept,
    /// Its corners are turned by any angle about any axis; its statement of how the stone lies stays.
    Turned,
    /// The statement of how the stone lies is removed, as if another program had written the file.
    Stripped,
    /// The statement is removed and the corners are turned.
    StrippedAndTurned,
}

const WAYS: [Way; 4] = [Way::Kept, Way::Turned, Way::Stripped, Way::StrippedAndTurned];

/// The figures that must come back: the same facet up, and all measurements.
#[derive(Debug, Clone, Copy)]
struct Figures {
    volume_mm3: f64,
    carats: Option<f64>,
    table: [f64; 2],
    length_to_width: f64,
    crown: f64,
    depth: f64,
}

impl Figures {
    fn of(specimen: &Specimen) -> Self {
        let stone = &specimen.stone().unwrap().polytope;
        let outline = Outline::of(stone);
        Self {
            volume_mm3: stone.volume() * specimen.unit_mm().powi(3),
            carats: specimen.carats(),
            table: if stone.facets().iter().any(|facet| FacetZones::of(stone).is_table(facet)) {
                outline.table.map(|t| t / outline.width)
            } else {
                [0.0; 2]
            },
            length_to_width: outline.length / outline.width,
            crown: outline.crown_height() / outline.width,
            depth: (outline.top - outline.bottom) / outline.width,
        }
    }

    /// Returns the first difference between two sets of figures, in words.
    fn differ(&self, other: &Self, with_material: bool) -> Option<String> {
        let pairs = [
            ("volume", self.volume_mm3, other.volume_mm3),
            ("table", self.table[0], other.table[0]),
            ("table length", self.table[1], other.table[1]),
            ("L/W", self.length_to_width, other.length_to_width),
            ("depth", self.depth, other.depth),
            ("crown", self.crown, other.crown),
        ];
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-4 * b.abs().max(a.abs()).max(0.01);
        let carats = match (self.carats, other.carats) {
            _ if !with_material => true,
            (Some(a), Some(b)) => near(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        if !carats {
            return Some(format!("weight {:?} for {:?}", other.carats, self.carats));
        }
        // The girdle's edges follow from corners, and rounding may add corners: a crown is compared less closely.
        let close =
            |what: &str, a: f64, b: f64| if what == "crown" { (a - b).abs() < 0.01 } else { near(a, b) };
        pairs
            .into_iter()
            .find(|(what, a, b)| !close(what, *a, *b))
            .map(|(what, a, b)| format!("{what} {b:.6} for {a:.6}"))
    }
}

/// A random number generator that gives the same numbers in every run.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a random turn; all turns are equally likely (K. Shoemake 1992).
    fn turn(&mut self) -> DQuat {
        let [u, v, w] = [self.next(), self.next(), self.next()];
        let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
        let [v, w] = [v, w].map(|x| x * std::f64::consts::TAU);
        DQuat::from_xyzw(a * v.sin(), a * v.cos(), b * w.sin(), b * w.cos())
    }
}

/// Sends a stone through a file: returns `None` where it comes back, and otherwise the reason.
fn fate(specimen: &Specimen, format: DesignFormat, way: Way, turn: DQuat) -> Result<(), String> {
    let bytes = written(specimen, format).map_err(|e| e.to_string())?.bytes;
    let bytes = match way {
        Way::Kept => bytes,
        Way::Turned => turned(format, bytes, turn),
        Way::Stripped => stripped(format, bytes),
        Way::StrippedAndTurned => turned(format, stripped(format, bytes), turn),
    };
    let path = PathBuf::from(format!("x.{}", format.ending()));
    let imported = mesh::read(bytes, &path, &MeshOptions::default()).map_err(|e| e.to_string())?;
    let says = matches!(way, Way::Kept | Way::Turned);
    let notes = imported.notes.join("; ");
    let back = Specimen::new(imported.design).map_err(|e| e.to_string())?;
    back.stone().map_err(|_| format!("it came back as triangles: {notes}"))?;
    let doubt = if notes.contains("does not show clearly") { " (doubtful)" } else { "" };
    match Figures::of(specimen).differ(&Figures::of(&back), says) {
        None => Ok(()),
        Some(why) => Err(format!("{why}{doubt}")),
    }
}

fn designs() -> Vec<PathBuf> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/asc/library"));
    let Ok(listed) = std::fs::read_dir(folder) else {
        println!("SKIPPED: {} is not there, so no real design goes through a mesh", folder.display());
        return vec![];
    };
    let mut files: Vec<PathBuf> = listed.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|e| e.eq_ignore_ascii_case("asc")));
    files.sort();
    files
}

/// Returns the names of the designs that do not come back, each with the reason.
fn lost(files: &[PathBuf], format: DesignFormat, way: Way) -> Vec<String> {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    let turns: Vec<DQuat> = files.iter().map(|_| dice.turn()).collect();
    let fate = |(file, turn): (&PathBuf, &DQuat)| {
        let specimen = Specimen::new(design_file::read(file).ok()?.design).ok()?;
        let name = file.file_name()?.to_string_lossy().into_owned();
        fate(&specimen, format, way, *turn).err().map(|why| format!("{name}: {why}"))
    };
    files.par_iter().zip(&turns).filter_map(fate).collect()
}

/// Returns the convex designs that come with the program, each 7.3 mm wide, and those of [`cutters_designs`].
fn own_designs() -> Vec<(String, Specimen)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cuts");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let read = |file: &PathBuf| {
        let design = Design { diameter_mm: 7.3, ..design_file::read(file).unwrap().design };
        // The sizes of glass do not depend on a diameter, and a block to cut from has no shape that shows its top.
        if matches!(design.cut, Cut::Glass(_) | Cut::Tiers(_)) {
            return None;
        }
        // A stone without a table, such as a briolette, does not show with certainty which side is up; the reader
        // reports its doubt.
        let has_table = |made: &Specimen| {
            made.stone().is_ok_and(|stone| stone.names().iter().any(|name| name == "table"))
        };
        Some((file.display().to_string(), Specimen::new(design).ok().filter(has_table)?))
    };
    let made: Vec<(String, Specimen)> = files.iter().filter_map(read).chain(cutters_designs()).collect();
    assert!(made.len() >= 10, "{} designs", made.len());
    made
}

/// Returns designs of the kinds that cutters make: long, half round, three-sided, without symmetry, without a table, with a
/// knife edge.
fn cutters_designs() -> Vec<(String, Specimen)> {
    let sides = |azimuths: &[(f64, f64)]| -> String {
        let facet = |(index, (azimuth, distance)): (usize, &(f64, f64))| {
            let teeth = azimuth / 360.0 * 96.0;
            let scaled = |by: f64| by * distance;
            format!(
                "a -90 {} {teeth} n G{index}\na -42 {} {teeth} n P{index}\na 36 {} {teeth} n C{index}\n",
                scaled(1.0),
                scaled(0.70),
                scaled(0.66)
            )
        };
        azimuths.iter().enumerate().map(facet).collect()
    };
    let half_round: Vec<(f64, f64)> =
        (0..9).map(|k| (22.5 * f64::from(k), 1.0)).chain([(270.0, 0.2)]).collect();
    let designs = [
        ("long", sides(&[(10.0, 1.0), (100.0, 1.6), (190.0, 1.0), (280.0, 1.6)]), "a 0 0.4 0 n T\n"),
        ("half round", sides(&half_round), "a 0 0.3 0 n T\n"),
        ("three-sided", sides(&[(0.0, 1.0), (120.0, 1.0), (240.0, 1.0)]), "a 0 0.45 0 n T\n"),
        (
            "uneven",
            sides(&[(3.0, 1.0), (71.0, 1.2), (140.0, 0.9), (222.0, 1.1), (300.0, 1.3)]),
            "a 0 0.4 0 n T\n",
        ),
        (
            "without a table",
            sides(&[(0.0, 1.0), (60.0, 1.0), (120.0, 1.0), (180.0, 1.0), (240.0, 1.0), (300.0, 1.0)]),
            "",
        ),
    ];
    let made = designs.map(|(name, facets, table)| {
        let text = format!("GemCad 5.0\ng 96 0.0\ny 1 n\nI 1.54\nH {name}\n{facets}{table}");
        let design = asc::read(text.as_bytes(), name).unwrap().design;
        (name.to_owned(), Specimen::new(design).unwrap())
    });
    made.to_vec()
}

#[test]
fn what_this_program_writes_comes_back_whatever_is_done_to_its_corners() {
    let mut dice = Dice(7);
    for (name, specimen) in own_designs() {
        for format in FORMATS {
            for way in [Way::Kept, Way::Turned] {
                let came = fate(&specimen, format, way, dice.turn());
                assert_eq!(came, Ok(()), "{name} as {}, {way:?}", format.ending());
            }
        }
    }
}

#[test]
fn what_another_program_writes_is_found_by_its_shape() {
    let mut dice = Dice(11);
    for (name, specimen) in own_designs() {
        for format in FORMATS {
            for way in [Way::Stripped, Way::StrippedAndTurned] {
                let came = fate(&specimen, format, way, dice.turn());
                // Where the file's unit gives the stone no plausible size, it gets the size that any such mesh gets.
                let same_size = Design { diameter_mm: 6.5, ..specimen.design.clone() };
                let came =
                    came.or_else(|_| fate(&Specimen::new(same_size).unwrap(), format, way, dice.turn()));
                assert_eq!(came, Ok(()), "{name} as {}, {way:?}", format.ending());
            }
        }
    }
}

/// Returns the stone that a mesh is read as, with the notes and the warnings about it.
fn read(format: DesignFormat, bytes: Vec<u8>, up: Up) -> (Specimen, Vec<String>, Vec<String>) {
    let path = PathBuf::from(format!("x.{}", format.ending()));
    let imported = mesh::read(bytes, &path, &MeshOptions { up, ..MeshOptions::default() }).unwrap();
    (Specimen::new(imported.design).unwrap(), imported.notes, imported.warnings)
}

fn tolkowsky() -> Specimen {
    let design = cut_file::parse(library::cut("tolkowsky").unwrap(), "tolkowsky").unwrap();
    Specimen::new(Design { diameter_mm: 5.2, ..design }).unwrap()
}

#[test]
fn a_statement_that_no_longer_holds_is_told() {
    let specimen = tolkowsky();
    let bytes = |format| written(&specimen, format).unwrap().bytes;
    for format in FORMATS {
        let (back, _, warnings) = read(format, bytes(format), Up::Found);
        assert_eq!((back.design.diameter_mm, warnings), (5.2, vec![]), "{}", format.ending());
        assert_eq!(back.design.material, specimen.design.material);
        // The mesh is turned, scaled, both, and moved; a move needs no message.
        let quarter = DQuat::from_rotation_x(1.2);
        let warnings = |to: &dyn Fn(DVec3) -> DVec3| {
            let (back, _, warnings) = read(format, moved(format, bytes(format), to), Up::Found);
            assert_eq!(Figures::of(&specimen).differ(&Figures::of(&back), true), None, "{}", format.ending());
            warnings.join("; ")
        };
        assert!(warnings(&|v| quarter * v).contains("but its corners have been turned since"));
        assert!(
            warnings(&|v| 25.4 * v).contains("its corners have been scaled by 25.4000 since; 5.2 mm is kept")
        );
        assert!(warnings(&|v| 0.5 * (quarter * v)).contains("turned since, so that its table faces"));
        assert_eq!(warnings(&|v| v + DVec3::new(0.001, -0.002, 0.003)), "");
        // A flattened mesh is another stone, and the statement in the file does not fit it.
        let flat = moved(format, bytes(format), &|v| {
            v * DVec3::new(1.0, 1.0, if format == DesignFormat::Glb { 1.0 } else { 0.8 })
                * DVec3::new(1.0, if format == DesignFormat::Glb { 0.8 } else { 1.0 }, 1.0)
        });
        let (back, _, warnings) = read(format, flat, Up::Found);
        assert!(
            warnings.iter().any(|w| w.contains("its shape has changed since that was written")),
            "{warnings:?}"
        );
        // The unit of the file, mm or m, still tells the size.
        assert!((back.design.diameter_mm - 5.2).abs() < 1e-5, "{}", back.design.diameter_mm);
    }
    let broken = String::from_utf8(bytes(DesignFormat::Obj)).unwrap().replace("up=z d=5.2", "up=w d=5.2");
    let (back, _, warnings) = read(DesignFormat::Obj, broken.into_bytes(), Up::Found);
    assert!(warnings.iter().any(|w| w.contains("up=w: y or z is expected")), "{warnings:?}");
    assert!(back.stone().is_ok());
}

/// Writes a solid of polygons as OBJ, with each corner moved by `to`.
fn obj(corners: &[[f64; 3]], faces: &[&[usize]], to: impl Fn(DVec3) -> DVec3) -> Vec<u8> {
    let vertex = |corner: &[f64; 3]| {
        let v = to(DVec3::from_array(*corner));
        format!("v {} {} {}\n", v.x, v.y, v.z)
    };
    let face =
        |face: &&[usize]| format!("f{}\n", face.iter().map(|k| format!(" {}", k + 1)).collect::<String>());
    (corners.iter().map(vertex).collect::<String>() + &faces.iter().map(face).collect::<String>())
        .into_bytes()
}

#[test]
fn a_cube_stands_and_an_octahedron_stands_on_its_point() {
    let cube: Vec<[f64; 3]> =
        (0..8).map(|k| [k & 1, (k >> 1) & 1, (k >> 2) & 1].map(|bit| f64::from(bit) * 2.0 - 1.0)).collect();
    let sides: [&[usize]; 6] =
        [&[0, 2, 3, 1], &[4, 5, 7, 6], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 4, 6, 2], &[1, 3, 7, 5]];
    // In mm, in m, and away from the origin the stone is the same, but in m its size is not known.
    for (scale, shift, side_mm) in
        [(3.0, DVec3::ZERO, 6.0_f64), (0.003, DVec3::ZERO, 6.5), (3.0, DVec3::new(100.0, -7.0, 20.0), 6.0)]
    {
        let (stone, notes, warnings) =
            read(DesignFormat::Obj, obj(&cube, &sides, |v| scale * v + shift), Up::Found);
        let figures = Figures::of(&stone);
        assert!(
            (figures.table[0] - 1.0).abs() < 1e-9 && (figures.length_to_width - 1.0).abs() < 1e-9,
            "{figures:?}"
        );
        assert!((figures.volume_mm3 - side_mm.powi(3)).abs() < 1e-6, "{figures:?}");
        assert!(warnings.is_empty() && stone.warnings.is_empty(), "{warnings:?} {:?}", stone.warnings);
        assert!(!notes.iter().any(|note| note.contains("doubt")), "{notes:?}");
    }
    let points = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let faces: Vec<Vec<usize>> = (0..8_usize)
        .map(|k| {
            let corners = vec![k & 1, 2 + ((k >> 1) & 1), 4 + ((k >> 2) & 1)];
            let even = (k & 1) + ((k >> 1) & 1) + ((k >> 2) & 1);
            if even % 2 == 0 { corners } else { corners.into_iter().rev().collect() }
        })
        .collect();
    let faces: Vec<&[usize]> = faces.iter().map(Vec::as_slice).collect();
    for up in [Up::Found, Up::Given(DVec3::ONE), Up::Given(DVec3::NEG_X)] {
        let (stone, _, warnings) = read(DesignFormat::Obj, obj(&points, &faces, |v| v), up);
        assert!(
            warnings.is_empty() && stone.warnings.is_empty(),
            "{up:?}: {warnings:?} {:?}",
            stone.warnings
        );
        let Figures { depth, table, .. } = Figures::of(&stone);
        match up {
            // Standing on its point it is as high as its square is wide from corner to corner.
            Up::Found => {
                assert!((depth - 2_f64.sqrt()).abs() < 1e-9 && table == [0.0; 2], "{depth} {table:?}")
            }
            Up::Given(DVec3::ONE) => assert!(table[0] > 0.5, "{table:?}"),
            _ => assert!((depth - 2_f64.sqrt()).abs() < 1e-9, "{depth}"),
        }
    }
}

#[test]
fn a_stone_is_found_lying_on_its_side_upside_down_and_with_y_up() {
    let specimen = tolkowsky();
    let quarter = std::f64::consts::FRAC_PI_2;
    let ways = [
        ("y up", DQuat::from_rotation_x(-quarter)),
        ("on its side", DQuat::from_rotation_y(quarter)),
        ("upside down", DQuat::from_rotation_x(2.0 * quarter)),
        ("askew", DQuat::from_rotation_x(0.7) * DQuat::from_rotation_z(0.4)),
    ];
    for format in FORMATS {
        let foreign = || stripped(format, written(&specimen, format).unwrap().bytes);
        for (name, turn) in ways {
            let (back, notes, _) = read(format, turned(format, foreign(), turn), Up::Found);
            let why = Figures::of(&specimen).differ(&Figures::of(&back), false);
            assert_eq!(why, None, "{name} as {}", format.ending());
            assert!(!notes.iter().any(|note| note.contains("doubt")), "{name}: {notes:?}");
        }
        // A given direction is taken as up even where it is wrong.
        let (back, ..) = read(format, foreign(), Up::Given(DVec3::X));
        assert!(Figures::of(&specimen).differ(&Figures::of(&back), false).is_some());
    }
}

#[test]
fn a_shape_that_leaves_a_doubt_says_how_to_set_it() {
    // Two pyramids joined at their bases, the upper one as steep as the lower.
    let corners = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 0.7],
        [0.0, 0.0, -0.8],
    ];
    let faces: [&[usize]; 8] =
        [&[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4], &[1, 0, 5], &[2, 1, 5], &[3, 2, 5], &[0, 3, 5]];
    let (_, notes, _) = read(DesignFormat::Obj, obj(&corners, &faces, |v| v), Up::Found);
    let doubt = notes.iter().find(|note| note.contains("does not show clearly")).expect("a doubt");
    assert!(doubt.contains("z was chosen, and -z is nearly as likely"), "{doubt}");
}

#[test]
fn a_half_round_stone_lies_around_its_axis() {
    for (name, specimen) in cutters_designs() {
        let middle = Outline::of(&specimen.stone().unwrap().polytope).middle;
        assert!(middle.length() < 1e-9, "{name}: {middle}");
    }
}

#[test]
fn light_is_the_same_before_and_after() {
    let specimen = tolkowsky();
    let figures = |specimen: &Specimen| {
        let stone = specimen.stone().unwrap();
        let options = beam::BeamOptions { unresolved: 1e-3, ..beam::BeamOptions::default() };
        let (medium, view) = (specimen.medium(589.3), View::default());
        let beams = beam::trace(&stone.polytope, medium, &view, &options, &unwatched).unwrap();
        by_beams(&beams, &Scope::aset(ASET_CONE, Backing::Black))
    };
    let before = figures(&specimen);
    let mut dice = Dice(3);
    for format in FORMATS {
        for way in [Way::Kept, Way::Turned, Way::Stripped] {
            let bytes = written(&specimen, format).unwrap().bytes;
            let bytes = match way {
                Way::Turned => turned(format, bytes, dice.turn()),
                Way::Stripped => stripped(format, bytes),
                _ => bytes,
            };
            let after = figures(&read(format, bytes, Up::Found).0);
            let error = before.unresolved + after.unresolved + 1e-4;
            for (a, b) in before.transmitted.iter().zip(&after.transmitted) {
                assert!((a - b).abs() <= error, "{} {way:?}: {a} {b}", format.ending());
            }
        }
    }
}

/// Designs of the library that do not come back from the files that this program writes, with the reason.
const LOST: [(&str, &str); 0] = [];

/// Every twenty-fifth design of the library comes back from this program's files, unchanged and turned, where the library is
/// on the machine.
#[test]
fn real_designs_come_back() {
    let files: Vec<PathBuf> = designs().into_iter().step_by(25).collect();
    for (format, way) in FORMATS.into_iter().flat_map(|format| [(format, Way::Kept), (format, Way::Turned)]) {
        let lost = lost(&files, format, way);
        let unknown = lost.iter().filter(|why| !LOST.iter().any(|(name, _)| why.starts_with(name)));
        let unknown: Vec<&String> = unknown.collect();
        assert!(unknown.is_empty(), "{} {way:?}: {unknown:?}", format.ending());
    }
}

/// The whole library comes back, which takes long: `STONES_STEP=10` takes every tenth design, `STONES_WAYS=Kept,Turned` only
/// these ways.
#[test]
#[ignore = "it takes a quarter of an hour: cargo test --release --test library stones -- --ignored --nocapture"]
fn the_whole_library_comes_back() {
    let set = |name: &str| std::env::var(name).ok();
    let step = set("STONES_STEP").and_then(|step| step.parse().ok()).unwrap_or(1);
    let files: Vec<PathBuf> = designs().into_iter().step_by(step).collect();
    let chosen = |name: &str, of: &str| set(name).is_none_or(|list| list.split(',').any(|one| one == of));
    for way in WAYS.into_iter().filter(|way| chosen("STONES_WAYS", &format!("{way:?}"))) {
        for format in FORMATS.into_iter().filter(|format| chosen("STONES_FORMATS", format.ending())) {
            let lost = lost(&files, format, way);
            let share = 100.0 * lost.len() as f64 / files.len().max(1) as f64;
            println!("{way:?} {}: {} of {} lost, {share:.2} %", format.ending(), lost.len(), files.len());
            lost.iter().for_each(|why| println!("    {why}"));
        }
    }
}

#[test]
fn proportions_that_a_design_gives_are_those_that_are_measured_on_its_stone() {
    let mut count = 0;
    for (name, text) in library::CUTS {
        let design = cut_file::parse(text, name).unwrap();
        let specimen = Specimen::new(design).unwrap();
        let Ok(stone) = specimen.stone() else { continue };
        let cut = &specimen.design.cut;
        let report = ProportionReport::of(&stone.polytope, stone.names());
        // A culet cuts off the point down to which some families count the pavilion.
        let has_culet = cut.proportion("culet").is_some_and(|row| (row.get)(cut) > 0.0);
        for (key, measured) in [
            ("crown_height", report.crown_height),
            ("girdle_thickness", report.girdle_thickness),
            ("pavilion_depth", report.pavilion_depth),
            ("total_depth", report.total_depth),
        ] {
            let given = cut.proportion(key).map(|row| (row.get)(cut)).filter(|given| given.is_finite());
            let Some(given) = given.filter(|_| key != "pavilion_depth" || !has_culet) else { continue };
            assert!((given - measured).abs() < 1e-6, "{name}: {key}: {given} is given, {measured} measured");
            count += 1;
        }
        let (along, sheet) = (report.along_axes, SheetFigures::of(&stone.polytope, stone.names()));
        assert_eq!(
            [along.pavilion_to_width, along.girdle_to_width, along.crown_to_width, along.height_to_width],
            [sheet.pavilion_to_width, sheet.girdle_to_width, sheet.crown_to_width, sheet.height_to_width]
        );
    }
    assert!(count > 60, "{count}");
}
