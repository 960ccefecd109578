//! Tests of meshes on the command line: how they are read, and which messages about them appear, and how often.

use super::desk::*;

/// Every command that reads a mesh, except `edit`, with options that keep it short.
const COMMANDS: [&str; 7] = [
    "info FILE",
    "info --json FILE",
    "measure --unresolved 0.1 FILE",
    "convert FILE out.obj",
    "export --views aset --size 16 --format json --unresolved 0.1 --out out FILE",
    "render --size 16 --samples 1 --wavelengths 1 --tracer ray --out out FILE",
    "refraction-map --size 16 --format tiled --out out FILE",
];

/// A cube whose upper side is bent inward: two of its corners are lowered and the side is split along the diagonal between
/// them.
const BENT: &str = "v 1 1 0.97\nv -1 1 1\nv -1 -1 0.97\nv 1 -1 1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 -1\nv 1 -1 -1\n\
    f 1 2 3\nf 1 3 4\nf 5 7 6\nf 5 8 7\nf 1 5 6\nf 1 6 2\nf 2 6 7\nf 2 7 3\nf 3 7 8\nf 3 8 4\nf 4 8 5\nf 4 5 1\n";

#[test]
fn what_is_found_in_a_mesh_is_a_note_and_is_said_once() {
    let desk = Desk::new();
    desk.write("bent.obj", BENT);
    for command in COMMANDS {
        let command = command.replace("FILE", "bent.obj");
        let (code, _, stderr) = desk.run(&command);
        assert_eq!(code, 0, "{command}: {stderr}");
        for what in ["facets were found", "diamond is used", "bends inward at 1 edges"] {
            assert_eq!(stderr.matches(what).count(), 1, "{command}: {stderr}");
            let line = stderr.lines().find(|line| line.contains(what)).unwrap();
            assert!(line.starts_with("note: bent.obj: "), "{command}: {line}");
        }
        assert!(!stderr.contains("warning"), "{command}: {stderr}");
    }
}

#[test]
fn a_mesh_is_read_as_facets_or_triangles_by_every_command() {
    let desk = Desk::new();
    desk.write("bent.obj", BENT);
    for command in COMMANDS.into_iter().filter(|command| !command.starts_with("export")) {
        for (form, said_of_it) in
            [("faceted", "facets were found"), ("triangles", "it is traced as 12 triangles")]
        {
            let command = format!("{} --as {form} --up -z", command.replace("FILE", "bent.obj"));
            let (code, _, stderr) = desk.run(&command);
            assert!(code == 0 && stderr.contains(said_of_it), "{command}: {stderr}");
        }
    }
    let (_, faceted, _) = desk.run("info --json --as faceted bent.obj");
    let (_, triangles, _) = desk.run("info --json --as triangles bent.obj");
    let [faceted, triangles] =
        [faceted, triangles].map(|text| serde_json::from_str::<serde_json::Value>(&text).unwrap());
    assert!(at(&faceted, "volume") > 1.002 * at(&triangles, "volume") && triangles["triangles"] == 12);
    assert!(faceted["facets"].as_array().unwrap().len() >= 6 && faceted["triangles"].is_null());
}

#[test]
fn what_is_kept_of_a_design_is_told_for_each_format_of_meshes() {
    let desk = Desk::new();
    for (line, kept) in [
        ("tolkowsky a.obj", "its facets, their names, its size and the name of its material"),
        ("tolkowsky a.stl", "its facets, its size and the name of its material"),
        ("tolkowsky a.ply", "its facets, its size and the name of its material"),
        (
            "tolkowsky a.glb",
            "its facets, their names, its size, the name of its material and the material in red, green and blue",
        ),
    ] {
        let (code, _, stderr) = desk.run(&format!("convert {line}"));
        assert!(
            code == 0 && stderr.contains(&format!("only this part of the design is kept: {kept}\n")),
            "{line}: {stderr}"
        );
    }
}
