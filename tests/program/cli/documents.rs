//! The commands in the blocks of the documents, run one after the other as a reader would type them, with small pictures and
//! short searches. `src/cli/documents.rs` checks that they name what exists.

use super::desk::*;
use crate::shown_commands::{ShownCommand, commands, shown};
use std::path::Path;
use std::process::Stdio;

/// Sets the value of an option, where the command gives it or else `is_added`.
fn set(words: &mut Vec<String>, option: &str, is_added: bool, value: impl Fn(&str) -> String) {
    match words.iter().position(|word| word == option) {
        Some(at) => words[at + 1] = value(&words[at + 1]),
        None if is_added => words.extend([option.to_owned(), value("")]),
        None => {}
    }
}

/// Makes a size a tenth as large, but at least `least` pixels.
fn smaller(size: &str, least: u32) -> String {
    let parts = size.split('x').map(|part| (part.parse::<u32>().unwrap_or(0) / 10).max(least).to_string());
    parts.collect::<Vec<_>>().join("x")
}

/// Makes a command take little time, and paths of the repository whole.
fn shortened(words: &mut Vec<String>) {
    let command = words[0].clone();
    let is = |names: &[&str]| names.contains(&command.as_str());
    // Curves below a picture need room, and so do captions.
    let has = |option: &str| words.iter().any(|word| word == option);
    let least = if is(&["spin"]) && has("--of") {
        320
    } else if has("--caption") {
        96
    } else {
        16
    };
    set(words, "--size", is(&["export", "render", "spin", "refraction-map"]), |size| smaller(size, least));
    set(words, "--pane", false, |size| smaller(size, 16));
    set(words, "--samples", is(&["render", "refraction-map", "liquid-glass"]), |_| "1".to_owned());
    set(words, "--wavelengths", is(&["render", "refraction-map"]), |_| "2".to_owned());
    set(words, "--frames", is(&["spin"]), |_| "3".to_owned());
    set(words, "--bands", false, |_| "2".to_owned());
    set(words, "--unresolved", is(&["sweep"]), |_| "0.2".to_owned());
    set(words, "--seconds", is(&["optimise"]), |_| "0.2".to_owned());
    set(words, "--pixels", is(&["report"]), |_| "64".to_owned());
    for word in words {
        if word.starts_with("docs/") || word.starts_with("cuts/") {
            *word = Path::new(env!("CARGO_MANIFEST_DIR")).join(&*word).display().to_string();
        }
        // A range keeps its ends.
        if let [key, to, _] = word.split(':').collect::<Vec<_>>()[..]
            && let (Some((_, from)), Ok(to)) = (key.split_once('='), to.parse::<f64>())
            && let Ok(from) = from.parse::<f64>()
        {
            *word = format!("{key}:{to}:{}", to - from);
        }
    }
}

/// Returns a folder with the files that readers of the documents have.
fn stocked() -> Desk {
    let desk = Desk::new();
    // Their notes tell what those formats cannot hold.
    for line in ["convert --meets emerald design.asc", "convert modern-ideal scan.stl"] {
        assert_eq!(desk.run(line).0, 0, "{line}");
    }
    desk.write("emerald.toml", desk.done("cuts emerald"));
    std::fs::create_dir(desk.at("designs")).unwrap();
    desk.write("designs/cube.toml", desk.read("cube.toml"));
    let photo = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/images/gallery/page.png");
    std::fs::copy(photo, desk.at("photo.jpg")).unwrap();
    desk.done("refraction-map cube.toml --size 32 --samples 1 --wavelengths 2 --format tiled --out map");
    for (made, name) in [("", "render.png"), ("-diffuse", "shine.png")] {
        std::fs::copy(desk.at(format!("map/cube-refraction{made}.png")), desk.at(name)).unwrap();
    }
    desk
}

/// Runs the commands of a document in their order, and returns their number.
fn run_all(document: &str) -> usize {
    let desk = stocked();
    let all = commands(document);
    let count = all.len();
    for ShownCommand { at, mut words, to, from } in all {
        shortened(&mut words);
        let line = words.join(" ");
        let mut command = desk.command("");
        command.args(&words);
        if let Some(from) = from {
            command.stdin(Stdio::from(std::fs::File::open(desk.at(from)).unwrap()));
        }
        let output = command.output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{at}: brillianteer {line}: {said}");
        assert!(!said.contains("panicked"), "{at}: brillianteer {line}: {said}");
        let is_telling = !output.stdout.is_empty() || words.iter().any(|word| word == "--plot");
        assert!(is_telling, "{at}: brillianteer {line} prints nothing");
        // Files of the user's own folders stay on the desk.
        if let Some(name) = to.as_deref().and_then(|to| Path::new(to).file_name()) {
            std::fs::write(desk.at(name), output.stdout).unwrap();
        }
    }
    count
}

#[test]
fn every_command_of_the_guide_does_its_work() {
    assert!(run_all("docs/guide.md") > 50);
}

#[test]
fn every_command_of_the_gallery_does_its_work() {
    assert!(run_all("docs/gallery.md") > 15);
}

#[test]
fn every_command_of_the_other_documents_does_its_work() {
    let documents = ["docs/cutting.md", "docs/editor.md", "docs/formats.md", "docs/performance.md"];
    assert!(documents.into_iter().map(run_all).sum::<usize>() >= 4);
}

#[test]
fn the_reader_of_commands_keeps_quotes_redirections_and_comments_apart() {
    let shown =
        shown("render a --material \"rainbow soap\" < in.toml > out.png   # then look", String::new());
    assert_eq!(shown.words, ["render", "a", "--material", "rainbow soap"]);
    assert_eq!((shown.to.as_deref(), shown.from.as_deref()), (Some("out.png"), Some("in.toml")));
    let mut words = ["sweep", "--over", "tilt=-30:30:2", "--size", "800x450"].map(str::to_owned).to_vec();
    shortened(&mut words);
    assert_eq!(words[..5], ["sweep", "--over", "tilt=-30:30:60", "--size", "80x45"]);
}
