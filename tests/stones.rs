//! Stones that go out as meshes and come back: as this program writes them, turned since, and as another program would.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by it, and tells what it saw")]

#[path = "common/meshes.rs"]
mod meshes;

use brillianteer::cut::{Outline, is_table};
use brillianteer::io::design_file::{self, Format, written};
use brillianteer::io::mesh_design;
use brillianteer::io::mesh_options::MeshOptions;
use brillianteer::scene::Specimen;
use glam::DQuat;
use meshes::{stripped, turned};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

const FORMATS: [Format; 4] = [Format::Obj, Format::Stl, Format::Ply, Format::Glb];

/// What happens to a file between being written and being read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// Nothing.
    Kept,
    /// Its corners are turned by any angle about any axis; what it says stays.
    Turned,
    /// Another program writes it, which says nothing of how it lies.
    Stripped,
    /// Both.
    StrippedAndTurned,
}

const WAYS: [Way; 4] = [Way::Kept, Way::Turned, Way::Stripped, Way::StrippedAndTurned];

/// What must come back: the same facet up, and all that is measured.
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
            table: if stone.facets().iter().any(is_table) {
                outline.table.map(|t| t / outline.width)
            } else {
                [0.0; 2]
            },
            length_to_width: outline.length / outline.width,
            crown: outline.crown_height() / outline.width,
            depth: (outline.top - outline.bottom) / outline.width,
        }
    }

    /// Why these are not the same, if they are not.
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
        // Where the girdle's edges lie is told by corners, which rounding may add: a crown is compared less closely.
        let close =
            |what: &str, a: f64, b: f64| if what == "crown" { (a - b).abs() < 0.01 } else { near(a, b) };
        pairs
            .into_iter()
            .find(|(what, a, b)| !close(what, *a, *b))
            .map(|(what, a, b)| format!("{what} {b:.6} for {a:.6}"))
    }
}

/// Numbers that are the same every time.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Any turn, each as likely (K. Shoemake 1992).
    fn turn(&mut self) -> DQuat {
        let [u, v, w] = [self.next(), self.next(), self.next()];
        let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
        let [v, w] = [v, w].map(|x| x * std::f64::consts::TAU);
        DQuat::from_xyzw(a * v.sin(), a * v.cos(), b * w.sin(), b * w.cos())
    }
}

/// What became of a stone that went through a file: none where it came back, else why not.
fn fate(specimen: &Specimen, format: Format, way: Way, turn: DQuat) -> Result<(), String> {
    let bytes = written(specimen, format).map_err(|e| e.to_string())?.bytes;
    let bytes = match way {
        Way::Kept => bytes,
        Way::Turned => turned(format, bytes, turn),
        Way::Stripped => stripped(format, bytes),
        Way::StrippedAndTurned => turned(format, stripped(format, bytes), turn),
    };
    let path = PathBuf::from(format!("x.{}", format.ending()));
    let brought = mesh_design::read(bytes, &path, MeshOptions::default()).map_err(|e| e.to_string())?;
    let says = matches!(way, Way::Kept | Way::Turned);
    let told = brought.notes.join("; ");
    let back = Specimen::new(brought.design).map_err(|e| e.to_string())?;
    back.stone().map_err(|_| format!("it came back as triangles: {told}"))?;
    let doubt = if told.contains("doubt") { " (doubtful)" } else { "" };
    match Figures::of(specimen).differ(&Figures::of(&back), says) {
        None => Ok(()),
        Some(why) => Err(format!("{why}{doubt}")),
    }
}

fn library() -> Vec<PathBuf> {
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

/// The names of those that do not come back, each with the reason.
fn lost(files: &[PathBuf], format: Format, way: Way) -> Vec<String> {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    let turns: Vec<DQuat> = files.iter().map(|_| dice.turn()).collect();
    let fate = |(file, turn): (&PathBuf, &DQuat)| {
        let specimen = Specimen::new(design_file::read(file).ok()?.design).ok()?;
        let name = file.file_name()?.to_string_lossy().into_owned();
        if std::env::var_os("STONES_DUMP").is_some() { println!("FILE {name}"); }
        fate(&specimen, format, way, *turn).err().map(|why| format!("{name}: {why}"))
    };
    files.par_iter().zip(&turns).filter_map(fate).collect()
}

/// Of the whole library, by the hour: `STONES_STEP=10` takes every tenth design, `STONES_WAYS=Kept,Turned` only these ways.
#[test]
#[ignore = "it takes a quarter of an hour: cargo test --test stones -- --ignored --nocapture"]
fn the_whole_library_comes_back() {
    let set = |name: &str| std::env::var(name).ok();
    let step = set("STONES_STEP").and_then(|step| step.parse().ok()).unwrap_or(1);
    let files: Vec<PathBuf> = library().into_iter().step_by(step).collect();
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
