//! What a user meets on the first day: names of files that tell pictures apart, commands that say what they wrote, sizes that
//! nobody stated, and messages about files that are no designs.

use super::desk::*;

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
