//! The recorder hashes everything that the program prints and writes, to check changes that must not alter any output.
//!
//! `BRILLIANTEER_RECORD=before.txt cargo test --release --test program cli::recorder -- --ignored` writes the file where there is none, and
//! otherwise fails with the lines that differ. Hashes hold on one machine only: other processors round sines differently.
//! The seconds that each command took are written beside it, to `before.txt.seconds` or, when it is compared, to
//! `before.txt.seconds-now`.

use super::desk::*;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::time::Instant;

const DESIGNS: [&str; 10] = [
    "tolkowsky",
    "modern-ideal",
    "fisheye",
    "sixty-sixty",
    "shallow",
    "steep-deep",
    "brick.asc",
    "cube.toml",
    "slanted.toml",
    "tilted.glb",
];
const COMMANDS: [&str; 27] = [
    "",
    "edit",
    "export",
    "render",
    "spin",
    "refraction-map",
    "refraction-template",
    "refraction-import",
    "liquid-glass",
    "measure",
    "sweep",
    "gradient",
    "optimise",
    "info",
    "report",
    "sheet",
    "retarget",
    "yield",
    "convert",
    "bench",
    "materials",
    "cuts",
    "scenes",
    "families",
    "scopes",
    "lights",
    "completions",
];
const SCENES: [&str; 4] = ["ring", "parcel", "free-diamond", "wavy-plate"];
const MESHES: [&str; 2] = ["stone.obj", "heart.stl"];
const GLASS: [&str; 4] = ["pill", "prism", "cube", "plate"];

fn hash(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

/// Finds the hashes of all files below a folder, by path.
fn tree(folder: &Path, prefix: &str, found: &mut BTreeMap<String, u64>) {
    for (name, bytes) in files(folder) {
        found.insert(format!("{prefix}{name}"), hash(&bytes));
    }
    for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|p| p.is_dir())
    {
        let name = entry.file_name().unwrap().to_string_lossy().into_owned();
        tree(&entry, &format!("{prefix}{name}/"), found);
    }
}

/// Runs a command, with a new folder in place of `{}`, and records its results.
fn record(desk: &Desk, line: &str, record: &mut String) {
    let folder = "recorded";
    let _ = std::fs::remove_dir_all(desk.at(folder));
    std::fs::create_dir(desk.at(folder)).unwrap();
    let (code, printed, stderr) = desk.run(&line.replace("{}", folder));
    let _ = writeln!(
        record,
        "{line}: code {code}, printed {:016x}, said {:016x}",
        hash(printed.as_bytes()),
        hash(stderr.as_bytes())
    );
    let mut found = BTreeMap::new();
    tree(&desk.at(folder), "", &mut found);
    found.iter().for_each(|(name, hash)| {
        let _ = writeln!(record, "{line}: {name} {hash:016x}");
    });
}

/// Returns the commands whose outputs are recorded.
fn lines() -> Vec<String> {
    let mut lines: Vec<String> = COMMANDS.into_iter().map(|command| format!("{command} --help")).collect();
    for list in ["cuts", "families", "materials", "scenes", "lights", "scopes"] {
        lines.extend([list.to_owned(), format!("{list} --json")]);
    }
    for design in DESIGNS.into_iter().chain(MESHES) {
        lines.extend([
            format!("info {design} --json --facets"),
            format!("info {design}"),
            format!("measure {design} --json --unresolved 0.01"),
            format!("measure {design} --tilt 12 --azimuth 20 --unresolved 0.03 --head 10"),
            format!("measure {design} --tracer ray --json --perspective 9 --unresolved 0.01"),
            format!("export {design} --size 64 --out {{}} --unresolved 0.02"),
            format!("export {design} --size 200 --caption --no-glare --views aset,hearts,ideal-scope --format png,svg --tilt 5 --out {{}}"),
            format!("export {design} --size 48 --tracer ray --format png,json --out {{}} --unresolved 0.01"),
            format!("render {design} --size 64 --samples 2 --out {{}}"),
            format!("render {design} --size 48x32 --samples 2 --tracer ray --tilt 9 --turn 20 --head 12 --background page --out {{}}/a.png"),
            format!("render {design} --size 40 --samples 1 --light office --overlay wireframe,facets --exposure 0.5 --background light --out {{}}/a.png"),
            format!("render {design} --size 40 --samples 1 --strength 0.5 --out {{}}/a.exr"),
            format!("measure {design} --measures --json --unresolved 0.03"),
            format!("sheet {design} --json"),
            format!("sheet {design} --out {{}}/sheet.pdf"),
            format!("sheet {design} --out {{}}/sheet.svg"),
            format!("report {design} --date today --pixels 48 --out {{}}/report.pdf"),
            format!("gradient {design} --unresolved 0.02 --json"),
            format!("sweep {design} --over tilt=-10:10:10 --unresolved 0.05 --out {{}}/sweep.csv"),
            format!("retarget {design} --material sapphire --rule tangent-ratio --no-light --json --out {{}}/a.toml"),
            format!("yield {design} --rough 6x7x8 --json"),
        ]);
        for format in ["toml", "asc", "gem", "gcs", "obj", "stl", "ply", "glb"] {
            lines.push(format!("convert {design} {{}}/converted.{format}"));
        }
    }
    for scene in SCENES {
        lines.extend([
            format!("info {scene} --json"),
            format!("render {scene} --size 48 --samples 1 --out {{}}/a.png"),
            format!("render {scene} --size 48 --samples 1 --perspective 8 --probe 20,20"),
            format!("spin {scene} --size 32 --samples 1 --frames 3 --out {{}}"),
        ]);
    }
    for glass in GLASS {
        lines.extend([
            format!("info {glass} --json"),
            format!("render {glass} --size 40 --samples 2 --out {{}}/a.png"),
            format!("measure {glass} --json --unresolved 0.05"),
            format!("refraction-map {glass} --size 24 --samples 1 --background page --out {{}}"),
        ]);
    }
    lines.extend(
        [
            "spin tolkowsky --size 32 --samples 1 --frames 3 --tilt 10 --out {}",
            "refraction-map tolkowsky --size 24 --bands 3 --places 2 --format png16,exr,page --out {}",
            "liquid-glass --background dots --size 64 --out {}",
            "liquid-glass --background page --size 48 --compare --out {}",
            "export tolkowsky --tracer gpu --size 48 --format png,json --out {}",
            "render tolkowsky --tracer gpu --size 48 --samples 2 --perspective 9 --out {}/a.png",
            "render ring --tracer gpu --size 32 --samples 1 --out {}/a.png",
            "render tolkowsky --tracer beam --perspective 9 --size 32 --out {}",
            "render missing.toml --out {}",
            "info stone.obj brick.asc missing.toml tolkowsky --json",
            "report tolkowsky modern-ideal --date today --pixels 48 --out {}/report.html",
            "gradient tolkowsky --by crown_angle --of return-cos2 --unresolved 0.02",
            "sweep tolkowsky --over crown_angle=33:36:1 --over material=diamond,ruby --unresolved 0.05 --out {}/sweep.jsonl --plot {}/plot.svg",
            "sweep tolkowsky --over pavilion_angle=40:41.5:0.5 --unresolved 0.05 --out {}/sweep.parquet",
            "optimise tolkowsky --raise return-cos2=1 --vary crown_angle=32:36 --unresolved 0.05 --scatter 4 --climbs 1 --seconds 600 --json --out {}/better.toml",
            "refraction-template {}/template.png --size 64",
            "completions bash",
            "man",
            "man render",
            "render tolkowsky --glow 0 --no-jitter --unpolarised --unadapted --size 48 --samples 3 --out {}/a.png",
        ]
        .map(String::from),
    );
    lines
}

#[test]
#[ignore = "for changes that are to change nothing; see the top of the file"]
fn everything_is_as_it_was() {
    let Some(path) = std::env::var_os("BRILLIANTEER_RECORD") else {
        panic!("say by BRILLIANTEER_RECORD=FILE where the record is")
    };
    let desk = Desk::new();
    for (design, file) in
        [("tolkowsky", "stone.obj"), ("modern-ideal", "tilted.glb"), ("slanted.toml", "brick.asc")]
    {
        desk.run(&format!("convert {design} {file}"));
    }
    desk.write("heart.stl", heart());
    let (mut now, mut seconds) = (String::new(), String::new());
    for line in lines() {
        let start = Instant::now();
        record(&desk, &line, &mut now);
        let _ = writeln!(seconds, "{:.3} {line}", start.elapsed().as_secs_f64());
    }
    let beside = |ending: &str| Path::new(&path).with_added_extension(ending);
    let Ok(before) = std::fs::read_to_string(&path) else {
        std::fs::write(beside("seconds"), &seconds).unwrap();
        std::fs::write(&path, &now).unwrap();
        return;
    };
    std::fs::write(beside("seconds-now"), &seconds).unwrap();
    let [before, now] = [&before, &now].map(|text| text.lines().collect::<std::collections::BTreeSet<_>>());
    let gone: Vec<_> = before.difference(&now).collect();
    let new: Vec<_> = now.difference(&before).collect();
    assert!(gone.is_empty() && new.is_empty(), "no longer: {gone:#?}\nnow: {new:#?}");
}

/// An STL text of a solid that is not convex: two pyramids, one up and one down, on a four-sided base with a corner that is
/// bent inward.
fn heart() -> String {
    let corners = [[1.0, 0.0, 0.0], [0.1, 0.1, 0.0], [0.0, 1.0, 0.0], [-0.6, -0.6, 0.0]];
    let (top, bottom) = ([0.0, 0.0, 0.4], [0.0, 0.0, -0.5]);
    let mut text = String::from("solid heart\n");
    for k in 0..4 {
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        for facet in [[a, b, top], [b, a, bottom]] {
            text += "facet normal 0 0 0\nouter loop\n";
            facet.iter().for_each(|[x, y, z]| {
                let _ = writeln!(text, "vertex {x} {y} {z}");
            });
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid heart\n"
}
