//! Starts of the program with many more threads than cores. A lock or a lazy value that is filled by work which waits for
//! the thread pool makes some starts wait for ever: the waiting thread is handed a task that needs the same value.

use super::desk::*;
use crate::watchdog::ended;
use brillianteer::io::library::SCENES;
use brillianteer::scene::LIGHTS;
use std::process::Stdio;

/// The numbers of threads, which the starts take in turn.
const THREADS: [usize; 2] = [16, 32];

/// Returns how often each line is started. The variable `BRILLIANTEER_STARTS` asks for more than once.
fn starts() -> usize {
    std::env::var("BRILLIANTEER_STARTS").ok().and_then(|number| number.parse().ok()).unwrap_or(1)
}

/// Returns a line for every scene, light and world that comes with the program, and for every kind of work.
fn lines() -> Vec<String> {
    let small = "--size 24 --wavelengths 3 --samples 1";
    let mut lines: Vec<String> =
        SCENES.iter().map(|(name, _)| format!("render {name} {small} --out a.png")).collect();
    lines.extend(LIGHTS.iter().map(|light| format!("render tolkowsky --light {light} {small} --out a.png")));
    lines.extend(
        ["sunset", "room", "city"]
            .map(|world| format!("refraction-map pill --size 24 --background {world} --out map")),
    );
    lines.extend(
        [
            "render tolkowsky --tracer ray --light city --size 24 --wavelengths 3 --samples 1 --out a.png",
            "render cube --light sunset --background room --size 24 --wavelengths 3 --samples 1 --out a.exr",
            "liquid-glass --background city --size 48 --compare --samples 1 --out glass",
            "export tolkowsky --size 32 --out all --format png,svg,exr",
            "spin oval --light sunset --frames 3 --size 24 --wavelengths 3 --samples 1 --out a.png",
            "measure princess --measures",
            "sweep tolkowsky --over crown_angle=33:35:1 --of fire",
            "info heart --facets",
        ]
        .map(str::to_owned),
    );
    lines
}

#[test]
fn no_start_waits_for_ever_with_many_threads() {
    let desk = Desk::new();
    let mut stuck = vec![];
    let mut turns = THREADS.into_iter().cycle();
    for line in lines() {
        for threads in turns.by_ref().take(starts()) {
            let mut command = desk.command(&line);
            command.env("RAYON_NUM_THREADS", threads.to_string()).stdout(Stdio::null()).stderr(Stdio::null());
            match ended(&mut command.spawn().unwrap()) {
                Ok(status) => assert_eq!(status.code(), Some(0), "{line}"),
                Err(who) => stuck.push(format!("{line} with {threads} threads waits for ever:\n{who}")),
            }
        }
    }
    assert!(stuck.is_empty(), "{} starts are stuck; the first: {}", stuck.len(), stuck[0]);
}
