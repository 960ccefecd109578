//! The program's descriptions of itself: help, lists, tables, completions, manuals.

use super::desk::*;
use serde_json::Value;

/// The long options that a command's help lists.
fn options(desk: &Desk, command: &str) -> Vec<String> {
    let help = desk.done(&format!("help {command}"));
    let words = help.lines().filter_map(|line| {
        line.trim_start().split("--").nth(1).filter(|_| line.trim_start().starts_with('-'))
    });
    words.map(|rest| rest.split([' ', ',', '.']).next().unwrap().to_owned()).collect()
}

#[test]
fn the_help_of_a_command_lists_what_it_takes_and_nothing_else() {
    let desk = Desk::new();
    let [map, render, spin] = ["refraction-map", "render", "spin"].map(|command| options(&desk, command));
    for option in ["tracer", "glow", "overlay", "strength", "no-jitter"] {
        let is_listed = |list: &[String]| list.iter().any(|listed| listed == option);
        assert!(is_listed(&render) && is_listed(&spin) && !is_listed(&map), "{option}: {map:?}");
        let stderr = desk.refused(&format!("refraction-map cube.toml --{option}"), 2);
        assert!(stderr.contains("unexpected argument"), "{option}: {stderr}");
    }
    assert!(
        ["light", "exposure", "both-sides"].iter().all(|option| map.iter().any(|listed| listed == option))
    );
}

#[test]
fn legends_are_notes_and_printed_are_names_of_files_alone() {
    let desk = Desk::new();
    let (code, printed, stderr) = desk
        .run("render cube.toml --size 16 --samples 1 --wavelengths 1 --overlay bounces,total --out a.png");
    assert_eq!((code, printed.as_str()), (0, "a.png\n"));
    assert!(
        stderr.lines().all(|line| line.starts_with("note: ")) && stderr.contains("note: total: #"),
        "{stderr}"
    );
}

#[test]
fn info_weighs_a_stone_or_a_scene_of_another_material() {
    let desk = Desk::new();
    let carats = |options: &str| at(&desk.json(&format!("info --json {options}")), "carats");
    for file in ["tolkowsky", "ring"] {
        let [diamond, ruby] = ["diamond", "ruby"].map(|m| carats(&format!("{file} --material {m}")));
        // The densities of diamond and corundum, g/cm³.
        near(ruby / diamond, 4.0 / 3.515, 0.01, file);
    }
    let ruby = desk.json("info --json tolkowsky --material ruby");
    assert_eq!(ruby["material"], "ruby");
    assert!(desk.done("info tolkowsky --material ruby").contains("ruby"));
    assert!(desk.json("info --json tolkowsky --material 1.9")["carats"].is_null(), "an index has no density");
    assert!(desk.refused("info tolkowsky --material rubby", 2).contains("did you mean 'ruby'"));
}

#[test]
fn measure_says_which_command_takes_glare() {
    let desk = Desk::new();
    let refused = desk.refused("measure tolkowsky --glare", 2);
    assert!(refused.contains("--glare is an option of `export`"), "{refused}");
    let [measure, export] = ["measure", "export"].map(|command| options(&desk, command));
    let has = |list: &[String], option: &str| list.iter().any(|listed| listed == option);
    assert!(has(&export, "glare") && has(&export, "no-glare"), "{export:?}");
    assert!(!has(&measure, "glare") && has(&measure, "no-glare"), "{measure:?}");
}

#[test]
fn info_lists_tiers_and_facets_only_where_they_are_asked_for() {
    let desk = Desk::new();
    let rows = |line: &str, name: &str| {
        desk.done(line).lines().filter(|row| row.split_whitespace().next() == Some(name)).count()
    };
    let facets = |cut: &str, name: &str| {
        rows(&format!("info {cut} --facets"), name) - rows(&format!("info {cut}"), name)
    };
    assert_eq!([facets("tolkowsky", "girdle"), facets("cube.toml", "side")], [96, 6]);
    assert_eq!([rows("info tolkowsky", "upper_half"), rows("info tolkowsky", "main")], [1, 1]);
    for line in ["info tolkowsky --facets", "info cube.toml --facets", "info modern-ideal --facets"] {
        let table = desk.done(line);
        assert!(!table.contains("360.0000") && !table.contains("-0.0000"), "{table}");
    }
    let info = desk.json("info --json tolkowsky");
    assert!(list(&info["facets"]).iter().all(|f| (0.0..360.0 - 1e-9).contains(&at(f, "azimuth_deg"))));
}

#[test]
fn every_family_prints_the_numbers_that_its_cuts_give() {
    let desk = Desk::new();
    let all = desk.json("families --json");
    assert_eq!(list(&all).len(), 27);
    for family in list(&all) {
        let key = family["key"].as_str().unwrap();
        let [page, object] = ["", " --json"].map(|json| desk.done(&format!("families {key}{json}")));
        let object: Value = serde_json::from_str(&object).unwrap();
        let numbers = list(&object["numbers"]);
        let keys: Vec<&str> = numbers.iter().map(|number| number["key"].as_str().unwrap()).collect();
        let is_on_page = |key: &&str| page.contains(&format!("\n{key} ("));
        assert!(!keys.is_empty() && keys.iter().all(is_on_page), "{key}: {page}");
        for number in numbers.iter().filter(|number| number["can_be_set"] == true) {
            let [least, first, most] = [at(number, "usual/0"), at(number, "first"), at(number, "usual/1")];
            assert!(
                least <= first && first <= most && !number["meaning"].as_str().unwrap().is_empty(),
                "{number}"
            );
        }
        let cut = family["cuts"][0].as_str().unwrap_or_else(|| panic!("no cut of {key}"));
        let given = desk.json(&format!("info --json {cut}"))["given"].clone();
        assert!(given.as_object().unwrap().keys().all(|given| keys.contains(&given.as_str())), "{given}");
    }
    assert!(desk.refused("families ovla", 2).contains("did you mean 'oval'?"));
}

#[test]
fn every_list_comes_as_json_and_not_beside_a_name() {
    let desk = Desk::new();
    for (command, name, key, least) in [
        ("materials", "diamond", "n_D", 20),
        ("cuts", "tolkowsky", "title", 5),
        ("scenes", "trilogy", "stones", 5),
        ("scopes", "aset", "band", 7),
        ("lights", "studio", "description", 5),
    ] {
        let entries = desk.json(&format!("{command} --json"));
        let found = list(&entries).iter().find(|entry| entry["name"] == name);
        assert!(
            list(&entries).len() >= least && found.is_some_and(|entry| !entry[key].is_null()),
            "{command}"
        );
        if command != "materials" {
            assert!(desk.refused(&format!("{command} {name} --json"), 2).contains("cannot be used with"));
        }
    }
    let bands = |entry: &Value| list(&entry["band"]).len();
    assert_eq!(list(&desk.json("scopes --json")).iter().map(bands).min(), Some(4));
}

#[test]
fn shells_complete_every_command_and_manuals_have_a_page_of_each() {
    let desk = Desk::new();
    let commands = ["export", "render", "refraction-map", "measure", "info", "convert", "completions", "man"];
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = desk.done(&format!("completions {shell}"));
        assert!(
            commands.iter().all(|command| script.contains(command)) && script.contains("brillianteer"),
            "{shell}"
        );
    }
    assert!(desk.refused("completions cmd", 2).contains("bash"));
    let page = desk.done("man");
    assert!(page.contains(".TH") && commands.iter().all(|c| page.contains(&c.replace('-', "\\-"))), "{page}");
    let page = desk.done("man render");
    assert!(page.contains(".TH brillianteer-render") && page.contains("\\-\\-overlay"), "{page:.400}");
    assert!(desk.refused("man polish", 2).contains("give one of edit, export"));
}
