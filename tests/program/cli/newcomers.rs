//! What a user meets on the first day: names of files that tell pictures apart, commands that say what they wrote, sizes that
//! nobody stated, and messages about files that are no designs.

use super::desk::*;

/// A stone of GemCad with two tiers of the name G.
const TWO_GIRDLES: &str = "GemCad 5.0\ng 96 0.0\ny 8 y\nI 1.54\nH two tiers of one name\n\
    a -45.0 0.7 96 n P 12 24 36 48 60 72 84 G pavilion\na 90.0 1.0 96 n G 12 24 36 48 60 72 84 G girdle\n\
    a -90.0 1.0 6 n G 18 30 42 54 66 78 90 G girdle\na 35.0 0.75 96 n C 12 24 36 48 60 72 84 G crown\n\
    a 0.0 0.3 96 n T G table\n";

#[test]
fn default_names_tell_apart_what_options_change() {
    let desk = Desk::new();
    desk.write("mine.toml", desk.done("lights ring"));
    let quick = "--size 16 --samples 1 --wavelengths 1";
    for (options, name) in [
        ("", "cube-render.png"),
        ("--smoothing none", "cube-render.png"),
        ("--tone neutral", "cube-tone-neutral-render.png"),
        ("--material ruby", "cube-ruby-render.png"),
        ("--light ring", "cube-ring-render.png"),
        ("--light ./mine.toml --turn 30 --upright", "cube-mine-turn-30-upright-render.png"),
        ("--stone 2mm --tilt 5", "cube-2mm-tilt-5-render.png"),
        ("--background #404850-#101215 --exposure -0.5", "cube-exposure--0.5-404850-101215-render.png"),
    ] {
        let printed = desk.done(&format!("render cube.toml {quick} {options}"));
        assert_eq!(printed, format!("out/{name}\n"), "{options}");
    }
    let printed = desk.done("export cube.toml --views aset --format png --size 16 --index 1.7");
    assert_eq!(printed, "out/cube-index-1.7-aset.png\nout/cube-index-1.7-aset-strongest.png\n");
    let map =
        desk.done("refraction-map cube.toml --size 16 --samples 1 --wavelengths 1 --format tiled --span 3");
    assert!(map.starts_with("out/cube-span-3-refraction"), "{map}");
    assert_eq!(desk.done("sheet tolkowsky --left-handed"), "out/tolkowsky-left-handed-sheet.pdf\n");
}

#[test]
fn commands_print_the_names_of_the_files_that_they_write() {
    let desk = Desk::new();
    for (line, file) in [
        ("convert cube.toml a.toml", "a.toml"),
        ("sweep cube.toml --over index=1.5,1.6 --of leakage --unresolved 0.2 -o a.csv", "a.csv"),
        ("retarget tolkowsky --material sapphire --rule critical-angle --no-light -o b.toml", "b.toml"),
        ("sheet tolkowsky -o c.svg", "c.svg"),
    ] {
        let printed = desk.done(line);
        assert_eq!(printed.lines().last(), Some(file), "{line}: {printed}");
        assert!(desk.at(file).is_file());
    }
}

#[test]
fn beside_json_the_names_of_written_files_are_said_on_standard_error() {
    let desk = Desk::new();
    let quick = "--scatter 2 --climbs 1 --unresolved 0.1";
    for (line, files) in [
        (
            "retarget tolkowsky --material sapphire --rule critical-angle --no-light --json -o d.toml",
            "d.toml",
        ),
        (
            &*format!(
                "optimise tolkowsky --raise return-cos2 --vary table=53:60 {quick} --json -o e.toml --plot e.svg"
            ),
            "e.svg e.toml",
        ),
        ("sweep cube.toml --over index=1.5,1.6 --of leakage --unresolved 0.2 --json --plot f.svg", "f.svg"),
    ] {
        let (code, printed, stderr) = desk.run(line);
        let said: Vec<&str> = stderr.lines().filter_map(|line| line.strip_prefix("wrote ")).collect();
        assert_eq!((code, said.join(" ")), (0, files.to_owned()), "{line}: {stderr}");
        assert!(files.split(' ').all(|file| desk.at(file).is_file()), "{line}");
        let values = serde_json::Deserializer::from_str(&printed).into_iter::<serde_json::Value>();
        assert!(
            values.into_iter().all(|value| value.is_ok_and(|value| value.is_object())),
            "{line}: {printed}"
        );
    }
}

#[test]
fn every_command_that_takes_out_takes_its_short_form() {
    let desk = Desk::new();
    let help = desk.done("--help");
    let commands = help.lines().skip_while(|line| !line.starts_with("Commands:")).skip(1);
    let commands: Vec<&str> = commands
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    let mut with_out = 0;
    for command in commands.into_iter().filter(|command| *command != "help") {
        let help = desk.done(&format!("{command} --help"));
        let option =
            help.lines().map(str::trim_start).find(|line| line.starts_with('-') && line.contains("--out "));
        with_out += usize::from(option.is_some());
        assert!(option.is_none_or(|line| line.starts_with("-o, --out ")), "{command}: {option:?}");
    }
    assert!(with_out >= 10, "{with_out}");
}

#[test]
fn drawings_come_without_figures_unless_they_are_asked_for() {
    let desk = Desk::new();
    let names = |line: &str| {
        let printed = desk.done(&format!("{line} --size 32"));
        printed.lines().map(|line| line.trim_start_matches("out/").to_owned()).collect::<Vec<_>>()
    };
    let drawings = ["cube-profile.svg", "cube-profile.png", "cube-diagram.svg", "cube-diagram.png"];
    assert_eq!(names("export cube.toml --views profile,diagram"), drawings);
    assert_eq!(names("export cube.toml --views profile --format json"), ["cube-figures.json"]);
    let lit = names("export cube.toml --views profile,aset --unresolved 0.1");
    assert_eq!(lit.last().map(String::as_str), Some("cube-figures.json"));
}

#[test]
fn a_file_without_a_size_is_said_to_have_none_unless_one_is_given() {
    let desk = Desk::new();
    desk.write("two.asc", TWO_GIRDLES);
    let said = "note: two.asc: the file states no size; the stone is taken to be 6.5 mm across\n";
    for command in ["info", "measure --unresolved 0.2", "sheet --json", "render --size 16 --samples 1"] {
        let (code, _, stderr) = desk.run(&format!("{command} two.asc"));
        assert!(code == 0 && stderr.contains(said), "{command}: {stderr}");
        let (code, _, stderr) = desk.run(&format!("{command} two.asc --stone 7mm"));
        assert!(code == 0 && !stderr.contains("6.5 mm"), "{command}: {stderr}");
    }
    for format in ["gem", "gcs"] {
        desk.run(&format!("convert two.asc b.{format}"));
        let (_, _, stderr) = desk.run(&format!("info b.{format}"));
        assert!(stderr.contains(": the file states no size; "), "{format}: {stderr}");
    }
    desk.done("convert two.asc b.toml --stone 8mm");
    assert_eq!(desk.run("info b.toml").2, "");
}

#[test]
fn tiers_of_one_name_are_listed_by_the_names_that_keys_take() {
    let desk = Desk::new();
    desk.write("two.asc", TWO_GIRDLES);
    let rows = desk.json("info two.asc --json")["measured"]["tiers"].clone();
    let rows: Vec<(&str, u64)> = list(&rows)
        .iter()
        .map(|row| (row["name"].as_str().unwrap(), row["facets"].as_u64().unwrap()))
        .collect();
    assert_eq!(rows, [("P", 8), ("G", 8), ("G#2", 8), ("C", 8), ("T", 1)]);
    assert!(desk.done("info two.asc").contains("\n  G#2  "));
    let quick = "--of leakage --unresolved 0.2";
    let said =
        "note: two.asc: 2 tiers are called G; distance:G is the first of them, and the others are G#2\n";
    let (code, _, stderr) = desk.run(&format!("sweep two.asc --over distance:G=1,1.01 {quick}"));
    assert!(code == 0 && stderr.contains(said), "{stderr}");
    let (code, _, stderr) = desk.run(&format!("gradient two.asc --by distance:G {quick}"));
    assert!(code == 0 && stderr.contains(said), "{stderr}");
    for key in ["distance:G#2", "distance:C"] {
        let (code, _, stderr) = desk.run(&format!("sweep two.asc --over {key}=1,1.01 {quick}"));
        assert!(code == 0 && !stderr.contains("are called"), "{key}: {stderr}");
    }
}

#[test]
fn a_file_of_prose_is_said_to_be_no_design_in_one_line() {
    let desk = Desk::new();
    desk.write("README.md", "# Title\n\nProse of a kind.\n\n[link](there)\n\n[section]\nkey = 1\n");
    desk.write("notes", "Buy a stone; then cut it = done\n");
    for file in ["README.md", "notes"] {
        for command in ["info", "render", "measure"] {
            let stderr = desk.refused(&format!("{command} {file}"), 1);
            let is_one_line = stderr.trim_end().lines().count() == 1;
            let begins = format!("error: {file}: this is not a design: designs as .toml, .asc");
            assert!(is_one_line && stderr.starts_with(&begins), "{command}: {stderr}");
        }
    }
}

#[test]
fn notes_on_meshes_have_plain_numbers_and_say_each_option_once() {
    let desk = Desk::new();
    desk.run("convert tolkowsky a.stl");
    desk.run("convert modern-ideal b.stl");
    let (code, _, stderr) = desk.run("info a.stl b.stl");
    let is_exponent = |word: &str| word.contains("e-") && word.parse::<f64>().is_ok();
    assert!(code == 0 && stderr.contains("girdle radii"), "{stderr}");
    assert!(!stderr.split_whitespace().any(is_exponent), "{stderr}");
    for option in ["--as-found", "--as and --up", "--part NUMBER"] {
        assert!(stderr.matches(option).count() <= 1, "{stderr}");
    }
}

#[test]
fn a_material_by_its_index_is_titled_once() {
    let desk = Desk::new();
    for kind in ["", "--measures", "--hearts"] {
        let printed = desk.done(&format!("measure tolkowsky --material 1.54 --unresolved 0.2 {kind}"));
        let title = printed.lines().next().unwrap();
        assert_eq!(title.matches("1.54").count(), 1, "{title}");
        assert!(title.contains(", index 1.5400, "), "{title}");
    }
}
