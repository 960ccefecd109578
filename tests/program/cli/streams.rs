//! Standard input and output as files, names of files, and links.

use super::desk::*;
use serde_json::Value;
use std::process::Stdio;

/// An OBJ mesh of four faces, without a name.
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// Runs a command with a file as standard input and returns its exit code, the bytes of its standard output and its standard
/// error.
fn fed(desk: &Desk, line: &str, input: &str) -> (i32, Vec<u8>, String) {
    let file = std::fs::File::open(desk.at(input)).unwrap();
    let output = desk.command(line).stdin(file).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(!stderr.contains("panicked"), "{line}: {stderr}");
    (output.status.code().unwrap(), output.stdout, stderr)
}

#[test]
fn a_dash_is_standard_input_for_every_format_and_command() {
    let desk = Desk::new();
    let facets = |text: &[u8]| {
        let info: Value = serde_json::from_slice(text).unwrap();
        (info["file"].as_str().unwrap().to_owned(), list(&info["facets"]).len())
    };
    for ending in ["toml", "asc", "gem", "gcs", "obj", "stl", "ply", "glb"] {
        let file = format!("t.{ending}");
        assert_eq!(desk.run(&format!("convert tolkowsky {file}")).0, 0);
        let (code, printed, _) = fed(&desk, "info --json -", &file);
        assert_eq!((code, facets(&printed)), (0, ("-".to_owned(), 153)), "{ending}");
    }
    desk.write("scene.toml", desk.done("scenes trilogy"));
    let (code, printed, stderr) = fed(&desk, "info -", "scene.toml");
    assert!(code == 0 && String::from_utf8(printed).unwrap().starts_with("stdin: "), "{stderr}");
    let (code, printed, stderr) = fed(&desk, "export - --views profile --format svg", "cube.toml");
    assert_eq!((code, printed.as_slice()), (0, b"out/stdin-profile.svg\n".as_slice()), "{stderr}");
    desk.write("nameless.stl", TETRAHEDRON);
    let (code, printed, stderr) = fed(&desk, "info -", "nameless.stl");
    assert!(code == 0 && String::from_utf8(printed).unwrap().starts_with("stdin\n"), "{stderr}");
    desk.write("empty", "");
    let (code, _, stderr) = fed(&desk, "info -", "empty");
    assert!(code == 1 && stderr == "error: -: the file is empty\n", "{code}: {stderr}");
    let (code, _, stderr) = fed(&desk, "measure -", "bad/nan.toml");
    assert!(code == 1 && stderr.starts_with("error: -:6: "), "{code}: {stderr}");
    assert!(!desk.at("-").exists());
}

#[test]
fn a_dash_is_standard_output_where_one_file_is_written_and_refused_where_several_are() {
    let desk = Desk::new();
    for (line, file) in [
        ("render cube.toml --size 16 --samples 1 --wavelengths 1 --out", "a.png"),
        ("convert tolkowsky --format asc", "a.asc"),
        ("convert tolkowsky --format glb", "a.glb"),
        ("liquid-glass --background dots --size 64 --out", "liquid-glass/liquid-glass-dots.png"),
        ("export cube.toml --views profile --format svg --out", "svg/cube-profile.svg"),
        ("export cube.toml --format exr --views aset --size 32 --out", "exr/cube-aset.exr"),
        ("export cube.toml --format png --views aset --size 32 --out", "png/cube-aset.png"),
    ] {
        let folder = file.split('/').next().unwrap();
        let written = desk.command(&format!("{line} {folder}")).output().unwrap();
        let printed = desk.command(&format!("{line} -")).output().unwrap();
        assert_eq!((written.status.code(), printed.status.code()), (Some(0), Some(0)), "{line}");
        assert!(printed.stdout == std::fs::read(desk.at(file)).unwrap(), "{line}");
    }
    let (code, printed, _) = desk.run("export cube.toml --format json --out -");
    assert_eq!((code, &serde_json::from_str::<Value>(&printed).unwrap()["name"]), (0, &"Cube".into()));
    let (code, printed, _) = fed(&desk, "convert - - --format toml", "cube.toml");
    assert!(code == 0 && printed.starts_with(b"format = 1"));
    for (line, why) in [
        (
            "export cube.toml --out -",
            "21 would be written (cube-aset.png, cube-aset.svg, cube-aset-white.png, and 18 more)",
        ),
        (
            "export cube.toml --views aset,hearts --format png --out -",
            "2 would be written (cube-aset.png, cube-hearts.png); choose one picture and one format",
        ),
        ("export cube.toml tolkowsky --format json --out -", "several stones need a folder"),
        ("render cube.toml tolkowsky --out -", "several stones need a folder"),
        ("spin cube.toml --out -", "give a file or a folder"),
        ("refraction-map cube.toml --out -", "give a folder"),
        ("liquid-glass --background dots --compare --out -", "give a folder"),
        ("convert tolkowsky -", "--format"),
    ] {
        let (code, printed, stderr) = desk.run(line);
        assert!(code == 2 && printed.is_empty() && stderr.contains(why), "{line}: {code}: {stderr}");
    }
    assert!(!desk.at("-").exists());
    let gone = || std::io::pipe().unwrap().1;
    let line = "convert tolkowsky - --format asc";
    assert_eq!(
        desk.command(line).stdout(gone()).stderr(Stdio::null()).output().unwrap().status.code(),
        Some(0)
    );
}

#[test]
#[cfg(unix)]
fn what_is_written_to_a_link_goes_where_the_link_leads() {
    let desk = Desk::new();
    std::fs::create_dir(desk.at("store")).unwrap();
    std::os::unix::fs::symlink("store/real.asc", desk.at("link.asc")).unwrap();
    for cut in ["cube.toml", "tolkowsky"] {
        let (code, _, stderr) = desk.run(&format!("convert {cut} link.asc"));
        assert_eq!(code, 0, "{stderr}");
        let [real, link] =
            ["store/real.asc", "link.asc"].map(|file| desk.json(&format!("info --json {file}")));
        assert_eq!(real["facets"], link["facets"]);
        assert!(desk.at("link.asc").is_symlink() && !desk.at("store/real.asc").is_symlink());
    }
    assert_eq!(std::fs::read_dir(desk.at("store")).unwrap().count(), 1);
}

#[test]
fn the_view_is_in_the_names_of_files_so_that_two_views_stand_side_by_side() {
    let desk = Desk::new();
    let names = |line: &str| {
        let printed = desk.done(line);
        printed.lines().map(|name| name.trim_start_matches("out/").to_owned()).collect::<Vec<_>>()
    };
    let export = "export cube.toml --views aset,hearts,profile --format png --size 16";
    let tilted = names(&format!("{export} --tilt 15 --azimuth 22.5"));
    let named = [
        "cube-tilt-15-azimuth-22.5-aset.png",
        "cube-tilt-15-azimuth-22.5-aset-strongest.png",
        "cube-tilt-15-azimuth-22.5-hearts.png",
        "cube-tilt-15-azimuth-22.5-hearts-strongest.png",
        "cube-profile.png",
    ];
    assert_eq!(tilted, named);
    let plain = [
        "cube-aset.png",
        "cube-aset-strongest.png",
        "cube-hearts.png",
        "cube-hearts-strongest.png",
        "cube-profile.png",
    ];
    assert_eq!(names(export), plain);
    // Hearts are seen through the pavilion, whichever side is requested.
    let behind = names(&format!("{export} --side culet"));
    assert_eq!((behind[0].as_str(), behind[2].as_str()), ("cube-culet-aset.png", "cube-hearts.png"));
    let figures = |options: &str| names(&format!("export cube.toml --format json {options}")).remove(0);
    assert_eq!(figures("--eye-tilt 5"), "cube-eye-tilt-5-figures.json");
    assert_eq!(figures("--perspective 8"), "cube-perspective-8-figures.json");
    let quick = "--size 16 --samples 1 --wavelengths 1 --tilt 4";
    assert_eq!(names(&format!("render cube.toml {quick}")), ["cube-tilt-4-render.png"]);
    assert_eq!(names(&format!("spin cube.toml --frames 3 {quick}")), ["cube-tilt-4-spin.png"]);
    assert!(desk.at("out/cube-tilt-4-spin/0001.png").is_file());
    let map = names(&format!("refraction-map cube.toml --format tiled {quick}"));
    assert_eq!(map, ["cube-tilt-4-refraction.png", "cube-tilt-4-refraction-diffuse.png"]);
}
