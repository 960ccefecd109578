//! The program as a user runs it: real files in, real files out, messages, exit codes.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test fails by it")]

use brillianteer::optics::linear_from_encoded;
use brillianteer::picture::names;
use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};
use glam::{DVec2, DVec3};
use resvg::usvg::roxmltree::{Document, Node};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tempfile::{TempDir, tempdir};

const ZONES: [&str; 4] = ["green", "red", "blue", "below"];
const DRAWINGS: [&str; 2] = ["profile", "diagram"];

fn command(folder: &TempDir, line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_brillianteer"));
    command.current_dir(folder.path()).args(line.split_whitespace()).stdin(Stdio::null());
    command
}

fn no_panic(line: &str, output: &Output) -> String {
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(!said.contains("panicked") && output.status.code() != Some(101), "{line}: {said}");
    said
}

/// What the program prints when all goes well, and then it says nothing else.
fn done(folder: &TempDir, line: &str) -> String {
    let output = command(folder, line).output().unwrap();
    let said = no_panic(line, &output);
    assert!(output.status.success() && said.is_empty(), "{line}: {:?} {said}", output.status);
    String::from_utf8(output.stdout).unwrap()
}

/// What the program says when it refuses, which it does with this exit code.
fn refused(folder: &TempDir, line: &str, code: i32) -> String {
    let output = command(folder, line).output().unwrap();
    let said = no_panic(line, &output);
    assert_eq!(output.status.code(), Some(code), "{line}: {said}");
    said
}

fn told(folder: &TempDir, line: &str) -> Value {
    serde_json::from_str(&done(folder, line)).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn sum(zones: &Value) -> f64 {
    zones.as_object().unwrap().values().map(number).sum()
}

fn point(value: &Value) -> DVec3 {
    DVec3::from_slice(&list(value).iter().map(number).collect::<Vec<_>>())
}

fn near(found: f64, expected: f64, within: f64, what: &str) {
    assert!((found - expected).abs() <= within, "{what}: {found}, not {expected}");
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    entries.map(|p| (p.file_name().unwrap().to_str().unwrap().into(), std::fs::read(&p).unwrap())).collect()
}

/// A PNG's size, its pixels in linear light, and its description.
fn png(path: &Path) -> ((u32, u32), Vec<DVec3>, String) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let size = reader.next_frame(&mut bytes).map(|f| (f.width, f.height)).unwrap();
    let linear = |p: &[u8]| DVec3::from_array([0, 1, 2].map(|i| linear_from_encoded(f64::from(p[i]) / 255.0)));
    let described = reader.info().utf8_text.iter().find(|t| t.keyword == "Description").unwrap();
    (size, bytes.chunks_exact(3).map(linear).collect(), described.get_text().unwrap())
}

fn exr(path: &Path) -> BTreeMap<String, Vec<f32>> {
    let layer = read_first_flat_layer_from_file(path).unwrap().layer_data;
    let channel = |c: exr::prelude::AnyChannel<FlatSamples>| match c.sample_data {
        FlatSamples::F32(values) => (c.name.to_string(), values),
        other => panic!("{}: {other:?}", c.name),
    };
    layer.channel_data.list.into_iter().map(channel).collect()
}

/// A cut file of planes, each called side.
fn block(planes: &[([f64; 3], f64)]) -> String {
    let head = String::from("format = 1\nname = \"Block\"\nmaterial = \"diamond\"\n");
    let plane = |(n, offset): &([f64; 3], f64)| {
        format!("[[plane]]\nname = \"side\"\nnormal = {n:?}\noffset = {offset:?}\n")
    };
    planes.iter().map(plane).fold(head, |text, plane| text + &plane)
}

const CUBE: [([f64; 3], f64); 6] = [
    ([1.0, 0.0, 0.0], 1.0),
    ([-1.0, 0.0, 0.0], 1.0),
    ([0.0, 1.0, 0.0], 1.0),
    ([0.0, -1.0, 0.0], 1.0),
    ([0.0, 0.0, 1.0], 1.0),
    ([0.0, 0.0, -1.0], 1.0),
];

/// A folder with cube.toml in it, sides 2, and perhaps more.
fn folder(more: &[(&str, &[u8])]) -> TempDir {
    let folder = tempdir().unwrap();
    std::fs::write(folder.path().join("cube.toml"), block(&CUBE)).unwrap();
    more.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
    folder
}

#[test]
fn export_makes_every_picture_in_every_format_and_the_same_bytes_on_any_number_of_threads() {
    let folder = folder(&[]);
    let export = "export tolkowsky --size 96 --unresolved 0.02 --format png,svg,exr,json --out";
    let exports = ["2", "2", "1"].into_iter().enumerate().map(|(i, threads)| {
        let run = command(&folder, &format!("{export} {i}")).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(run.status.success() && run.stderr.is_empty());
        let mut made = files(&folder.path().join(i.to_string()));
        let printed = String::from_utf8(run.stdout).unwrap();
        let printed: BTreeSet<String> = printed.lines().map(|l| l.replace(&format!("{i}/"), "")).collect();
        assert_eq!(printed, made.keys().cloned().collect());
        let mut figures: Value = serde_json::from_slice(&made["tolkowsky-figures.json"]).unwrap();
        figures["seconds"] = json!(0);
        made.insert("tolkowsky-figures.json".into(), figures.to_string().into_bytes());
        made
    });
    let exports: Vec<_> = exports.collect();
    for later in &exports[1..] {
        let differing: Vec<&String> = later.keys().filter(|k| exports[0].get(*k) != later.get(*k)).collect();
        assert!(differing.is_empty() && later.len() == exports[0].len(), "{differing:?}");
    }
    let mut expected = BTreeSet::from(["tolkowsky-figures.json".to_string()]);
    for name in names() {
        let scoped = !DRAWINGS.contains(&name);
        let endings = if scoped { vec![".png", "-strongest.png", ".svg", "-strongest.svg", ".exr"] } else { vec![".png", ".svg"] };
        expected.extend(endings.iter().map(|e| format!("tolkowsky-{name}{e}")));
        for png_file in endings.iter().filter(|e| e.ends_with("png")) {
            let ((width, height), _, described) = png(&folder.path().join(format!("0/tolkowsky-{name}{png_file}")));
            assert!(width == 96 && (height == 96 || !scoped), "{name}: {width} by {height}");
            assert!(described.starts_with(&format!("Tolkowsky 1919: {name}")), "{described}");
            if scoped {
                assert!(described.contains("index 2.417") && described.contains("polarised"), "{described}");
                let unresolved: f64 = described.split("exact beams, unresolved ").nth(1).unwrap().parse().unwrap();
                assert!(unresolved > 0.0 && unresolved <= 0.02, "{described}");
            }
        }
    }
    assert_eq!(exports[0].keys().cloned().collect::<BTreeSet<_>>(), expected);
    let svgs = exports[0].iter().filter(|(name, _)| name.ends_with(".svg"));
    svgs.for_each(|(name, text)| assert!(Document::parse(std::str::from_utf8(text).unwrap()).is_ok(), "{name}"));
}

#[test]
fn pictures_hold_the_light_that_is_measured() {
    let text = done(&folder(&[]), "cuts tolkowsky").replace("\"diamond\"", "{ index = 1.8, absorption = 0.1 }");
    let folder = folder(&[("dark.toml", text.as_bytes())]);
    for (file, view) in
        [("tolkowsky", "--tilt 0"), ("tolkowsky", "--tilt 12 --azimuth 22.5"), ("dark.toml", "--side culet")]
    {
        let options = format!("{file} --unresolved 0.002 {view}");
        let figures = told(&folder, &format!("measure --json {options}"));
        done(&folder, &format!("export {options} --views aset --size 256 --format png,exr --out {view}"));
        let out = folder.path().join("--tilt");
        let out = if out.exists() { out } else { folder.path().join(view) };
        let _ = (&out, &figures);
    }
}
