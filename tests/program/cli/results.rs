//! The keys of all JSON that the program prints. `results.txt` lists them, command by command: programs of users read them.

use super::desk::*;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// The commands with all keys that each prints: a line for each key of the outermost object, with the paths of the keys
/// inside it. A path goes through objects by a point, and through lists by `[]`.
const KEYS: &str = include_str!("results.txt");

/// A command that prints JSON and takes too long for a test here. Its own file tests its keys.
const LONG: &str = "bench";

/// Returns the paths of all keys whose value is no object and no list of such.
fn paths(value: &Value, at: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) if !object.is_empty() => {
            let path = |key: &str| if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") };
            object.iter().for_each(|(key, value)| paths(value, &path(key), found));
        }
        Value::Array(list) if !list.is_empty() => {
            list.iter().for_each(|value| paths(value, &format!("{at}[]"), found));
        }
        Value::Array(_) => drop(found.insert(format!("{at}[]"))),
        _ => drop(found.insert(at.to_owned())),
    }
}

/// Formats the keys of some values, a line for each key of the outermost object.
fn listed(values: &[Value]) -> String {
    let mut found = BTreeSet::new();
    values.iter().for_each(|value| paths(value, "", &mut found));
    let mut lines: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for path in &found {
        // The first two signs may be those of a list, `[].`.
        let end =
            path.char_indices().skip(3).find(|(_, sign)| *sign == '.').map_or(path.len(), |(end, _)| end);
        lines.entry(&path[..end]).or_default().push(&path[end..]);
    }
    let mut text = String::new();
    for (key, inside) in lines {
        let inside: Vec<&str> = inside.into_iter().filter(|path| !path.is_empty()).collect();
        let _ = writeln!(text, "{}", format!("{key} {}", inside.join(", ")).trim_end());
    }
    text
}

/// A solid of 12 by 12 squares on each side of a cube, whose corners are moved by noise.
fn scan() -> String {
    const SQUARES: u32 = 12;
    let moved = |corner: [f64; 3]| {
        let seed = 12.9898 * corner[0] + 78.233 * corner[1] + 37.719 * corner[2];
        [0, 1, 2].map(|axis| corner[axis] + 2e-3 * ((seed + 7.0 * axis as f64).sin() * 43_758.545_3).fract())
    };
    let mut text = String::new();
    for (side, square) in (0..6_usize).flat_map(|side| (0..SQUARES * SQUARES).map(move |k| (side, k))) {
        let (axis, sign) = (side / 2, if side % 2 == 0 { -1.0 } else { 1.0 });
        let corner = |k: usize| {
            let [u, v] = [square % SQUARES + [0, 1, 1, 0][k], square / SQUARES + [0, 0, 1, 1][k]];
            let mut corner = [sign; 3];
            corner[(axis + 1) % 3] = 2.0 * f64::from(u) / f64::from(SQUARES) - 1.0;
            corner[(axis + 2) % 3] = 2.0 * f64::from(v) / f64::from(SQUARES) - 1.0;
            moved(corner)
        };
        for k in if sign > 0.0 { [0, 1, 2, 3] } else { [3, 2, 1, 0] } {
            let [x, y, z] = corner(k);
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        text += "f -4 -3 -2\nf -4 -2 -1\n";
    }
    text
}

/// Returns a folder with all files that the commands read.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("red.toml", desk.read("cube.toml").replace("\"diamond\"", "\"ruby\""));
    desk.run("convert tolkowsky plain.asc");
    let plain = desk.read("plain.asc");
    let table = plain.lines().find(|line| line.starts_with("a 0")).unwrap();
    desk.write("frosted.asc", plain.replace(table, &format!("{table} G Frosted")));
    desk.write("scan.obj", scan());
    let tetrahedron = |name: &str, x: f64| {
        let corners = [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0], [x, 0.0, 1.0]];
        let corners = corners.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
        format!("o {name}\n{corners}f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -2 -4 -1\n")
    };
    desk.write("bodies.obj", tetrahedron("one", 0.0) + &tetrahedron("two", 3.0));
    desk
}

/// Runs a command, and returns the values that it prints, or writes where it names a file.
fn printed(desk: &Desk, line: &str) -> Vec<Value> {
    let (_, printed, stderr) = desk.run(line);
    let text = if line.starts_with("export") { desk.read(printed.trim()) } else { printed };
    let values = match serde_json::from_str(&text) {
        Ok(value) => Ok(vec![value]),
        Err(_) => text.lines().map(serde_json::from_str).collect(),
    };
    values.unwrap_or_else(|error| panic!("{line}: {error}: {text}\n{stderr}"))
}

#[test]
fn no_key_of_printed_json_vanishes_and_none_comes_unlisted() {
    let desk = desk();
    for block in KEYS.split("$ ").skip(1) {
        let (line, keys) = block.split_once('\n').unwrap();
        let found = listed(&printed(&desk, line));
        let expected: BTreeSet<&str> = keys.lines().filter(|line| !line.is_empty()).collect();
        let now: BTreeSet<&str> = found.lines().collect();
        assert!(
            expected == now,
            "brillianteer {line}\nlisted, and not printed: {:#?}\nprinted, and not listed: {:#?}\nall:\n{found}",
            expected.difference(&now).collect::<Vec<_>>(),
            now.difference(&expected).collect::<Vec<_>>()
        );
    }
}

#[test]
fn every_command_that_prints_json_has_its_keys_listed() {
    let desk = Desk::new();
    let help = desk.done("--help");
    let list =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let commands: Vec<&str> = list.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(commands.len() > 20, "{help}");
    for command in commands.into_iter().filter(|command| !["help", LONG].contains(command)) {
        let has_json = desk.done(&format!("{command} --help")).contains("--json");
        assert!(!has_json || KEYS.contains(&format!("$ {command} ")), "{command}");
    }
}
