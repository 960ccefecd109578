//! Faults in files, command lines and outputs, and the messages about them.

use super::desk::*;
use serde_json::{Value, json};

#[test]
fn a_file_at_fault_is_named_with_its_line_or_facet_and_nothing_is_written() {
    let desk = Desk::new();
    let line = "x".repeat(1 << 20);
    let cube = desk.read("cube.toml");
    let named = |(name, text): (&String, &Vec<u8>)| {
        let first = String::from_utf8_lossy(text).lines().next().unwrap().to_string();
        (name.clone(), first.strip_prefix("# says: ").unwrap().to_string())
    };
    let mut cases: Vec<(String, String)> = files(&desk.at("bad")).iter().map(named).collect();
    for (name, says, text) in [
        ("empty", ": the file is empty", vec![]),
        ("rubbish", ":1: this is not UTF-8", (0..4096_u32).map(|i| ((i * i * 7) >> 3) as u8 | 128).collect()),
        ("noughts", ":1: ", vec![0; 4096]),
        ("long-line", ":2: ", format!("format = 1\n{line}\n").into_bytes()),
        ("long-name", ":3: material", cube.replace("diamond", &line).into_bytes()),
        ("large", "larger than 4 MiB", vec![b'#'; (4 << 20) + 1]),
        ("missing", "no such file", vec![]),
        ("directory", "directory", vec![]),
    ] {
        desk.write(&format!("bad/{name}.toml"), text);
        cases.push((format!("{name}.toml"), says.into()));
    }
    std::fs::remove_file(desk.at("bad/missing.toml")).unwrap();
    std::fs::remove_file(desk.at("bad/directory.toml")).unwrap();
    std::fs::create_dir(desk.at("bad/directory.toml")).unwrap();
    for (name, says) in cases {
        for command in ["export --out out", "info --json", "measure"] {
            let stderr = desk.refused(&format!("{command} bad/{name}"), 1);
            assert!(
                stderr.starts_with(&format!("error: bad/{name}:")) && stderr.contains(&says),
                "{stderr:.500}"
            );
            assert!(
                stderr.lines().count() == 1 && stderr.len() < 1000,
                "{} bytes: {stderr:.500}",
                stderr.len()
            );
        }
        assert!(!desk.at("out").exists(), "{name}: something is written");
    }
}

#[test]
fn what_has_no_figures_is_refused_and_never_measured_as_nothing() {
    let desk = Desk::new();
    let wrong = |(offset, options): &(&str, &str)| {
        let text = desk.read("cube.toml").replace("offset = 1", &format!("offset = {offset}"));
        desk.write("other.toml", text);
        let (code, printed, stderr) = desk.run(&format!("measure other.toml --json {options}"));
        if code == 1 {
            return !stderr.starts_with("error: other.toml");
        }
        let figures: Value = serde_json::from_str(&printed).unwrap();
        figures["unresolved"].is_null() || (energy(&figures) - 1.0).abs() > 1e-9
    };
    let mut cases = vec![
        ("1e300", ""),
        ("1e-300", ""),
        ("1e60", ""),
        ("1e-60", ""),
        ("10", "--perspective 5"),
        ("10", "--perspective 9.9"),
    ];
    cases.retain(wrong);
    assert!(cases.is_empty(), "cubes of these offsets have figures that do not add up: {cases:?}");
}

#[test]
fn one_bad_file_keeps_no_other_from_being_done_and_two_of_one_name_are_refused() {
    let desk = Desk::new();
    let three = "tolkowsky bad/nan.toml cube.toml";
    let stderr = desk.refused(&format!("export --views profile --format svg {three}"), 1);
    assert!(
        stderr.starts_with("error: bad/nan.toml:6: ")
            && stderr.ends_with("1 of 3 files failed: bad/nan.toml\n")
    );
    let made: Vec<String> = files(&desk.at("out")).into_keys().collect();
    assert_eq!(made, ["cube-profile.svg", "tolkowsky-profile.svg"]);
    for command in ["info", "measure"] {
        let (code, printed, _) = desk.run(&format!("{command} --json {three}"));
        let file = |line| serde_json::from_str::<Value>(line).unwrap()["file"].clone();
        assert_eq!(
            (code, printed.lines().map(file).collect()),
            (1, vec![json!("tolkowsky"), json!("bad/nan.toml"), json!("cube.toml")])
        );
    }
    std::fs::copy(desk.at("cube.toml"), desk.at("bad/cube.toml")).unwrap();
    let (code, _, stderr) = desk.run("export cube.toml bad/cube.toml --out twins");
    assert!(code != 0 && stderr.contains("bad/cube.toml") && !desk.at("twins").exists(), "{stderr}");
    desk.write("strongest.toml", desk.done("scopes aset").replace("\"aset\"", "\"strongest\""));
    std::fs::copy(desk.at("cube.toml"), desk.at("cube-aset.toml")).unwrap();
    let line = "export cube.toml cube-aset.toml --views aset --scope strongest.toml --out twins";
    assert!(desk.refused(line, 2).contains("'cube-aset-strongest'") && !desk.at("twins").exists());
}

#[test]
fn every_command_of_several_files_goes_on_after_one_that_fails_and_counts_it() {
    let desk = Desk::new();
    let files = "tolkowsky heart cube.toml";
    for (line, made, code) in [
        // A heart is not convex.
        (format!("measure --measures --unresolved 0.2 --json {files}"), vec![], 1),
        (format!("measure --tracer beam --unresolved 0.2 --json {files}"), vec![], 2),
        (format!("sheet {files} --json"), vec![], 1),
        (
            format!("sheet {files} --format svg --out sheets"),
            vec!["cube-sheet.svg", "tolkowsky-sheet.svg"],
            1,
        ),
        (
            "render tolkowsky none.toml cube.toml --size 16 --samples 1 --out renders".into(),
            vec!["cube-render.png", "tolkowsky-render.png"],
            1,
        ),
    ] {
        let (ended, printed, stderr) = desk.run(&line);
        let failed = if line.contains("none") { "none.toml" } else { "heart" };
        assert_eq!(ended, code, "{line}: {stderr}");
        assert!(stderr.ends_with(&format!("1 of 3 files failed: {failed}\n")), "{line}: {stderr}");
        assert!(stderr.contains(&format!("error: {failed}:")), "{line}: {stderr}");
        if line.contains("--json") {
            let lines: Vec<Value> = printed.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
            let named: Vec<&str> = lines.iter().map(|line| line["file"].as_str().unwrap()).collect();
            assert_eq!(named, ["tolkowsky", "heart", "cube.toml"], "{line}");
            let errors: Vec<bool> = lines.iter().map(|line| line["error"].is_string()).collect();
            assert_eq!(errors, [false, true, false], "{line}");
        } else {
            let folder = if line.contains("sheets") { "sheets" } else { "renders" };
            let mut found: Vec<String> = super::desk::files(&desk.at(folder)).into_keys().collect();
            found.sort();
            assert_eq!(found, made, "{line}");
        }
    }
    // A folder stands where one of the pictures belongs.
    std::fs::create_dir_all(desk.at("renders/prism-render.png")).unwrap();
    let line = "render prism slanted.toml --size 16 --samples 1 --out renders";
    assert!(desk.refused(line, 3).ends_with("1 of 2 files failed: prism\n"));
    assert!(desk.at("renders/slanted-render.png").is_file());
    // A report compares the designs that can be read, and names only those.
    let (code, _, stderr) = desk.run("report tolkowsky none.toml cube.toml -o r.html --pixels 16");
    assert!(code == 1 && stderr.ends_with("1 of 3 files failed: none.toml\n"), "{stderr}");
    assert!(desk.read("r.html").contains("brillianteer report tolkowsky cube.toml"));
}

#[test]
fn measures_of_a_frosted_stone_are_those_of_the_polished_one_with_a_warning() {
    let desk = Desk::new();
    desk.run("convert tolkowsky plain.asc");
    let plain = desk.read("plain.asc");
    let table = plain.lines().find(|line| line.starts_with("a 0")).unwrap();
    desk.write("frosted.asc", plain.replace(table, &format!("{table} G Frosted")));
    let (code, printed, stderr) =
        desk.run("measure plain.asc frosted.asc --measures --unresolved 0.1 --json");
    let lines: Vec<Value> = printed.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((code, lines.len()), (0, 2), "{stderr}");
    assert_eq!(lines[0]["measures"], lines[1]["measures"]);
    assert_eq!((&lines[0]["as_polished"], &lines[1]["as_polished"]), (&Value::Null, &json!(true)));
    assert!(
        stderr
            .contains("measures of light and contrast maps are those of the stone as if they were polished"),
        "{stderr}"
    );
    let swept =
        desk.run("sweep frosted.asc plain.asc --over index=1.6,1.7 --of return-even --unresolved 0.2");
    let rows: Vec<&str> = swept.1.lines().skip(1).map(|line| line.split_once(',').unwrap().1).collect();
    assert_eq!((swept.0, rows.len()), (0, 4), "{}", swept.2);
    assert_eq!(rows[..2], rows[2..]);
}

#[test]
fn metal_without_stones_has_no_weight_of_stones() {
    let desk = Desk::new();
    desk.run("convert cube.toml metal.obj");
    desk.write(
        "scene.toml",
        "format = 1\nname = \"bare\"\n[[metal]]\nmesh = \"metal.obj\"\nmetal = \"gold\"\n",
    );
    let (code, printed, stderr) = desk.run("info scene.toml");
    assert!(code == 0 && !printed.contains("weight") && !printed.contains("-0"), "{printed}{stderr}");
    assert_eq!(desk.json("info --json scene.toml")["carats"], json!(0.0));
}

#[test]
fn an_output_that_cannot_be_written_ends_with_code_3_and_leaves_no_pieces() {
    let desk = Desk::new();
    for out in ["cube.toml", "cube.toml/deeper"] {
        let stderr = desk.refused(&format!("export cube.toml --size 16 --out {out}"), 3);
        assert!(stderr.starts_with("error: cube.toml") && stderr.lines().count() == 1, "{stderr}");
    }
    std::fs::create_dir_all(desk.at("out/cube-aset.png")).unwrap();
    assert!(desk.refused("export cube.toml --size 16 --views aset", 3).contains("cube-aset.png"));
    assert_eq!(std::fs::read_dir(desk.at("out")).unwrap().count(), 1);
    if let Ok(full) = std::fs::File::options().write(true).open("/dev/full") {
        assert_eq!(desk.command("info cube.toml").stdout(full).output().unwrap().status.code(), Some(3));
    }
}

#[test]
fn a_reader_that_goes_away_is_no_reason_to_panic() {
    let desk = Desk::new();
    let gone = || std::io::pipe().unwrap().1;
    for line in [
        "info tolkowsky",
        "measure cube.toml --json",
        "materials",
        "cuts",
        "families oval",
        "scenes",
        "scopes aset",
        "lights fire",
        "--help",
    ] {
        let (code, _, stderr) = outcome(line, &desk.command(line).stdout(gone()).output().unwrap());
        assert!(code == 0 && stderr.is_empty(), "{line}: code {code}: {stderr}");
    }
    let line = "info bad/nan.toml tolkowsky";
    let (code, printed, _) = outcome(line, &desk.command(line).stderr(gone()).output().unwrap());
    assert!(code == 1 && printed.contains("Tolkowsky"), "code {code}");
}

#[test]
fn the_editor_says_what_it_takes_where_it_is_given_more() {
    let desk = Desk::new();
    for line in
        ["tolkowsky --material ruby", "cube.toml --foo", "cube.toml tolkowsky", "edit cube.toml --tilt 5"]
    {
        let stderr = desk.refused(line, 2);
        assert!(!stderr.contains("subcommand"), "{line}: {stderr}");
        assert!(
            stderr.contains("the editor takes one FILE") && stderr.contains("`brillianteer export`"),
            "{line}: {stderr}"
        );
    }
    std::fs::create_dir(desk.at("folder")).unwrap();
    for line in ["folder", "./folder", "edit folder"] {
        assert!(
            desk.refused(line, 1).ends_with("folder: this is a directory; a file is expected\n"),
            "{line}"
        );
    }
    desk.write("odd.obj", "v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n");
    assert!(desk.refused("info odd.obj", 1).starts_with("error: odd.obj:2: 'zero' is not a number"));
    desk.write("none.stl", "solid x\nendsolid x\n");
    for line in ["info none.stl", "info --up y none.stl"] {
        assert!(desk.refused(line, 1).contains("none.stl: this holds no triangles"), "{line}");
    }
}

#[test]
fn a_command_line_at_fault_ends_with_code_2() {
    let desk = Desk::new();
    let ill_formed = "polish, measure, measure cube.toml --colour, measure cube.toml --index two, export cube.toml --size 15, \
        measure cube.toml --tilt 1 --eye-tilt 1, measure cube.toml --index 2 --wavelength 500, measure cube.toml --side up, \
        export cube.toml --size 16385, export cube.toml --views asset, export cube.toml --format gif";
    let stderr = desk.refused("measure cube.toml --tilt abc", 2);
    assert!(stderr.contains("a number is expected"), "{stderr}");
    let out_of_range = "--index 0.9, --index nan, --wavelength 0, --tilt 91, --eye-tilt nan, --azimuth inf, --head 90, \
        --unresolved 0, --unresolved nan, --perspective 1, --perspective 5 --tracer beam";
    let impossible = "export cube.toml --format exr --size 16385, export cube.toml --views aset,aset, cuts none, scopes none, lights none";
    let ranged = out_of_range.split(", ").map(|options| format!("measure cube.toml {options}"));
    let lines = ill_formed.split(", ").chain(impossible.split(", ")).map(String::from).chain(ranged);
    let wrong: Vec<_> = lines.map(|line| (desk.run(&line).0, line)).filter(|(code, _)| *code != 2).collect();
    assert!(wrong.is_empty() && !desk.at("out").exists(), "not code 2: {wrong:?}");
}

#[test]
fn a_folder_that_was_missing_is_made_and_named_by_every_command() {
    let desk = Desk::new();
    for (folder, line) in [
        ("a/b", "convert oval a/b/oval.stl"),
        ("c", "sheet oval --out c/"),
        ("d", "retarget oval --material ruby --rule critical-angle --no-light --out d/oval.toml"),
        ("e", "export oval --views diagram --out e"),
        ("f", "render oval --size 16 --samples 1 --out f/oval.png"),
        ("g", "sweep tolkowsky --over table=50,55 --of leakage --unresolved 0.05 --out g/table.csv"),
    ] {
        let said_twice = [(); 2].map(|()| {
            let output = desk.command(line).output().unwrap();
            let stderr = String::from_utf8(output.stderr).unwrap();
            assert!(output.status.success() && desk.at(folder).is_dir(), "{line}: {stderr}");
            stderr
        });
        let note = format!("note: the folder {folder} was missing and has been made\n");
        assert_eq!(said_twice.each_ref().map(|said| said.matches(&note).count()), [1, 0], "{said_twice:?}");
    }
}

#[test]
fn an_option_refuses_a_negative_value_by_its_own_name() {
    let desk = Desk::new();
    for (line, option, told) in [
        ("export tolkowsky --stone -2mm", "--stone", "-2 mm must be from 0.1 to 1000 mm across"),
        ("render tolkowsky --stone -2mm", "--stone", "-2 mm must be"),
        ("gradient tolkowsky --stone -2ct", "--stone", "-2 ct is not a weight"),
        ("optimise tolkowsky --stone -2", "--stone", "has no unit"),
        ("yield tolkowsky --rough -2x3x4", "--rough", "a side of -2 mm must be from 0.1"),
        ("yield tolkowsky --weight 1 --rough-weight -2", "--rough-weight", "more than 0"),
        ("info tolkowsky --material -1.5", "--material", "-1.5 must be from 1"),
        ("gradient tolkowsky --head -5", "--head", "0 to 89 degrees"),
        ("optimise tolkowsky --angle-step -1", "--angle-step", "0.001 to 10"),
        ("export tolkowsky --size -5", "--size", "-5 is not in 16"),
        ("spin tolkowsky --frames -5", "--frames", "-5 is not in 2"),
    ] {
        let stderr = desk.refused(line, 2);
        assert!(stderr.contains(told) && stderr.contains(option), "{line}: {stderr}");
        assert!(!stderr.contains("unexpected argument"), "{line}: {stderr}");
    }
}
