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

/// A box of 8 by 8 by 4 units.
const BOX: &str = "v 4 4 2\nv -4 4 2\nv -4 -4 2\nv 4 -4 2\nv 4 4 -2\nv -4 4 -2\nv -4 -4 -2\nv 4 -4 -2\n\
    f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

#[test]
fn the_size_of_a_mesh_is_told_and_may_be_given_by_its_unit_or_by_the_stone() {
    let desk = Desk::new();
    desk.write("box.obj", BOX);
    let assumed =
        "note: box.obj: the file states no unit; it is taken to be in mm, so that the stone is 8 mm across";
    for (options, diameter_mm, is_told) in [
        ("", 8.0, true),
        ("--unit mm", 8.0, false),
        ("--unit in", 203.2, false),
        ("--unit 0.5mm", 4.0, false),
        ("--stone 7mm", 7.0, false),
        ("--unit cm --stone 7mm", 7.0, false),
    ] {
        let (code, printed, stderr) = desk.run(&format!("info --json {options} box.obj"));
        let value: serde_json::Value = serde_json::from_str(&printed).unwrap();
        assert_eq!(code, 0, "{options}: {stderr}");
        assert!((at(&value, "diameter_mm") - diameter_mm).abs() < 1e-9, "{options}: {value}");
        assert_eq!(stderr.contains(assumed), is_told, "{options}: {stderr}");
    }
    // A weight gives the size that weighs it.
    let (_, printed, _) = desk.run("info --json --stone 2ct box.obj");
    let value: serde_json::Value = serde_json::from_str(&printed).unwrap();
    assert!((at(&value, "carats") - 2.0).abs() < 1e-9, "{value}");
    for (options, told) in [
        ("--unit feet", "'feet' is not a unit; give mm, cm, m, in, um, or the length of one unit in mm"),
        ("--unit m", "with a unit of 1000 mm the stone is 8000 mm across, where 0.1 to 1000 mm are possible"),
    ] {
        let (code, _, stderr) = desk.run(&format!("info {options} box.obj"));
        assert!(code != 0 && stderr.contains(told), "{options}: {stderr}");
    }
    // The size is kept by a conversion.
    desk.run("convert --unit cm box.obj large.stl");
    let (_, printed, _) = desk.run("info --json large.stl");
    let value: serde_json::Value = serde_json::from_str(&printed).unwrap();
    assert!((at(&value, "diameter_mm") - 80.0).abs() < 1e-9, "{value}");
}

#[test]
fn one_of_several_bodies_is_chosen_by_its_number_or_name_in_every_command() {
    let desk = Desk::new();
    let body = |name: &str, height: u32, x: u32| {
        let base = format!("v {x} -1 0\nv {} 0 0\nv {x} 1 0\nv {}.0 0 0\n", x + 1, x - 1);
        let faces = "f -2 -3 -4 -5\nf -5 -4 -1\nf -4 -3 -1\nf -3 -2 -1\nf -2 -5 -1\n";
        format!("o {name}\n{base}v {x} 0 {height}\n{faces}")
    };
    desk.write(
        "two.obj",
        &(body("low", 1, 5) + &body("high", 4, 20) + "v 0 0 9\nv 1 0 9\nv 0 1 9\nf -1 -2 -3\n"),
    );
    for command in COMMANDS {
        for (part, read) in [("", "2 is read"), (" --part 1", "1 is read"), (" --part LOW", "1 is read")] {
            let command = format!("{}{part}", command.replace("FILE", "two.obj"));
            let (code, _, stderr) = desk.run(&command);
            let list = "2 separate bodies are in the file: 1 `low` (6 triangles); 2 `high`";
            assert!(code == 0 && stderr.contains(list) && stderr.contains(read), "{command}: {stderr}");
            assert!(stderr.contains("is no closed surface and is left out"), "{command}: {stderr}");
            let choice = "note: two.obj: --part NUMBER, --part NAME or --part all chooses";
            assert!(stderr.contains(choice), "{command}: {stderr}");
        }
    }
    let (code, _, stderr) = desk.run("info --part 3 two.obj");
    assert!(
        code != 0 && stderr.contains("two.obj: there is no body 3 in the file, which has 1 `low`"),
        "{stderr}"
    );
    // A scene of both renders as they lie.
    let (code, _, stderr) = desk.run("convert --scene --material ruby two.obj both.toml");
    assert!(code == 0 && stderr.contains("is no closed surface and is left out"), "{stderr}");
    let (_, printed, _) = desk.run("info --json both.toml");
    let value: serde_json::Value = serde_json::from_str(&printed).unwrap();
    let at = |k: usize, axis: usize| value["stones"][k]["at_mm"][axis].as_f64().unwrap();
    // Sizes are kept to six decimals.
    assert!((at(1, 0) - at(0, 0) - 15.0).abs() < 2e-5, "{printed}");
    assert_eq!([0, 1].map(|k| value["stones"][k]["cut"].as_str().unwrap()), ["low", "high"]);
    assert_eq!(
        (value["stones"].as_array().unwrap().len(), &value["stones"][1]["material"]),
        (2, &"ruby".into())
    );
    let refused = desk.refused("convert --scene two.obj both.obj", 2);
    assert!(refused.contains("--scene writes a scene file"), "{refused}");
    desk.write("one.obj", body("low", 1, 5));
    let (_, printed, _) = desk.run("info --json one.obj");
    assert!(printed.contains("\"name\": \"low\"") && !printed.contains("bodies"), "{printed}");
    let (_, printed, _) = desk.run("info --json --part low two.obj");
    let value: serde_json::Value = serde_json::from_str(&printed).unwrap();
    let expected = [
        r#"{"number":1,"name":"low","triangles":6,"is_closed":true,"extent":[2.0,2.0,1.0],"inside":null,"is_read":true}"#,
        r#"{"number":2,"name":"high","triangles":6,"is_closed":true,"extent":[2.0,2.0,4.0],"inside":null,"is_read":false}"#,
        r#"{"number":null,"name":"high","triangles":1,"is_closed":false,"extent":[1.0,1.0,0.0],"inside":null,"is_read":false}"#,
    ];
    let expected: Vec<serde_json::Value> =
        expected.iter().map(|text| serde_json::from_str(text).unwrap()).collect();
    assert_eq!(value["bodies"], serde_json::Value::Array(expected));
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

#[test]
fn a_scene_is_written_as_a_mesh_of_all_its_bodies() {
    let desk = Desk::new();
    for ending in ["glb", "obj", "stl", "ply"] {
        let (code, printed, stderr) = desk.run(&format!("convert solitaire ring.{ending}"));
        assert_eq!((code, printed), (0, format!("ring.{ending}\n")), "{stderr}");
        let note = format!("note: ring.{ending}: only this part of the scene is kept: ");
        assert!(stderr.starts_with(&note), "{stderr}");
    }
    // The stone of a ring can be taken out again by its name.
    let (_, before, _) = desk.run("info --json solitaire");
    let before: serde_json::Value = serde_json::from_str(&before).unwrap();
    let name = before["stones"][0]["cut"].as_str().unwrap();
    let text = desk.read("ring.obj");
    assert!(
        text.contains(&format!("\no stone 1, {name}\nusemtl diamond\n"))
            && text.contains("\nusemtl platinum\n")
    );
    for (line, message) in [
        (
            "convert solitaire ring.asc",
            "error: solitaire: this is a scene, which is converted to .glb, .obj, .ply or .stl only, not to .asc\n",
        ),
        (
            "convert --meets solitaire ring.toml",
            "error: solitaire: this is a scene, where the file or the name of a cut is expected\n",
        ),
    ] {
        let (code, _, stderr) = desk.run(line);
        assert!(code != 0 && stderr == message, "{line}: {stderr}");
    }
}
