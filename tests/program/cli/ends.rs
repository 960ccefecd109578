//! Tests of the program's end: by signals, without a screen, in little memory, and with no messages on standard error
//! except its own.

use super::desk::*;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// Sends a signal to a program.
#[cfg(unix)]
fn signal(program: &Child, name: &str) {
    let sent = Command::new("sh").args(["-c", &format!("kill -{name} {}", program.id())]).status().unwrap();
    assert!(sent.success(), "kill -{name}");
}

/// Counts the files of a folder without the program's temporary files; 0 where there is no folder.
#[cfg(target_os = "linux")]
fn files_in(folder: &Path) -> usize {
    std::fs::read_dir(folder).into_iter().flatten().count() - temporary(folder)
}

/// Counts the program's temporary files in a folder.
fn temporary(folder: &Path) -> usize {
    let names = std::fs::read_dir(folder).into_iter().flatten().map(|e| e.unwrap().file_name());
    names.filter(|name| name.to_string_lossy().starts_with(".brillianteer-")).count()
}

/// Returns whether a thread of a program is just writing to standard output.
#[cfg(target_os = "linux")]
fn is_printing(program: &Child) -> bool {
    let mut threads =
        std::fs::read_dir(format!("/proc/{}/task", program.id())).into_iter().flatten().flatten();
    // The number of `write` is 1 on x86-64 and 64 on AArch64; its first argument is the file, here standard output.
    let is_write = |call: &str| call.starts_with("1 0x1 ") || call.starts_with("64 0x1 ");
    threads.any(|thread| {
        // A thread that has just ended has no such file.
        std::fs::read_to_string(thread.path().join("syscall")).is_ok_and(|call| is_write(&call))
    })
}

#[test]
#[cfg(unix)]
fn a_signal_ends_a_bench_at_once_with_its_own_exit_code() {
    let desk = Desk::new();
    for (name, code) in [("INT", 130), ("TERM", 143)] {
        let mut bench = desk.command("bench").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut printed = BufReader::new(bench.stdout.take().unwrap());
        let mut line = String::new();
        printed.read_line(&mut line).unwrap();
        assert!(line.starts_with("modern ideal; "), "{line}");
        signal(&bench, name);
        let rest: Vec<String> = printed.lines().map(Result::unwrap).collect();
        assert!(
            !rest.iter().any(|line| line.starts_with("diamond under")),
            "it went on to its end: {rest:?}"
        );
        let (ended, _, stderr) = outcome("bench", &bench.wait_with_output().unwrap());
        assert!(ended == code && stderr.ends_with("error: stopped\n"), "{name}: {ended}: {stderr}");
    }
}

#[test]
#[cfg(unix)]
fn a_signal_leaves_whole_files_and_no_temporary_ones() {
    let desk = Desk::new();
    for (name, code) in [("INT", 130), ("TERM", 143)] {
        let line = format!("export tolkowsky --views profile,aset --format png --size 16384 --out {name}");
        let mut export = desk.command(&line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut printed = BufReader::new(export.stdout.take().unwrap()).lines();
        assert_eq!(printed.next().unwrap().unwrap(), format!("{name}/tolkowsky-profile.png"));
        // The next picture is large enough that the signal arrives while it is being written.
        while temporary(&desk.at(name)) == 0 {
            assert!(export.try_wait().unwrap().is_none(), "it ended before it could be stopped");
            std::thread::yield_now();
        }
        signal(&export, name);
        let (ended, _, stderr) = outcome(&line, &export.wait_with_output().unwrap());
        assert!(ended == code && stderr.ends_with("error: stopped\n"), "{name}: {ended}: {stderr}");
        let left = std::fs::read_dir(desk.at(name)).unwrap().map(|e| e.unwrap().file_name());
        assert_eq!(left.collect::<Vec<_>>(), ["tolkowsky-profile.png"]);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_signal_ends_a_program_whose_output_nobody_reads() {
    use std::io::Write;
    let desk = Desk::new();
    for (name, code) in [("INT", 130), ("TERM", 143)] {
        // A pipe of Linux holds 64 KiB, so there is no room for the first file name that is printed.
        let (unread, mut full) = std::io::pipe().unwrap();
        full.write_all(&[0; 1 << 16]).unwrap();
        let line = format!("export cube.toml --views profile --format svg,png --size 64 --out {name}");
        let mut export = desk.command(&line).stdout(full).stderr(Stdio::piped()).spawn().unwrap();
        while files_in(&desk.at(name)) == 0 {
            assert!(export.try_wait().unwrap().is_none(), "it ended though nobody read");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        while !is_printing(&export) {
            assert!(export.try_wait().unwrap().is_none(), "it ended though nobody read");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        signal(&export, name);
        let began = std::time::Instant::now();
        while export.try_wait().unwrap().is_none() {
            if began.elapsed().as_secs() > 600 {
                export.kill().unwrap();
                panic!("{name}: it waits for its reader");
            }
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        let output = export.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{name}");
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(said, format!("note: the folder {name} was missing and has been made\nerror: stopped\n"));
        drop(unread);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn without_a_screen_the_main_pictures_and_figures_are_written_unless_the_editor_is_asked_for_by_name() {
    let desk = Desk::new();
    let run = |line: &str| {
        let mut command = desk.command(line);
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        outcome(line, &command.output().unwrap())
    };
    let views = ["aset", "aset-strongest", "ideal-scope", "ideal-scope-strongest"];
    for (line, stem) in [("", "tolkowsky"), ("cube.toml", "cube")] {
        let (code, printed, stderr) = run(line);
        assert!(
            code == 0 && stderr.contains("written to the folder 'out' instead"),
            "{line}: {code}: {stderr}"
        );
        assert!(
            stderr.contains(if cfg!(feature = "app") { "there is no display" } else { "built without" }),
            "{stderr}"
        );
        assert!(stderr.contains(&format!("brillianteer render {stem}")), "{stderr}");
        let folder = desk.at("out").canonicalize().unwrap();
        assert!(stderr.trim_end().ends_with(&folder.display().to_string()), "{stderr}");
        assert_eq!(printed.lines().count(), 12, "{line}: {printed}");
        for name in printed.lines() {
            assert!(desk.at(name).is_file(), "{name}");
        }
        let made = |name: &str| printed.contains(&format!("out/{stem}-{name}.png"));
        assert!(made("render") && views.iter().all(|view| made(view)), "{printed}");
        assert!(desk.at(format!("out/{stem}-figures.json")).is_file());
        std::fs::remove_dir_all(folder).unwrap();
    }
    for line in ["edit", "edit cube.toml"] {
        let (code, _, stderr) = run(line);
        assert!(code == 3 && stderr.contains("`brillianteer export`"), "{line}: {code}: {stderr}");
    }
    let (code, _, stderr) = run("bad/nan.toml");
    assert!(code == 1 && stderr.contains("error: bad/nan.toml:6: "), "{code}: {stderr}");
    assert!(!desk.at("out").exists());
}

/// A driver that looks for a Wayland screen when it is loaded and reports its failure, in the same words as libwayland does
/// for Mesa's layer for choosing a card.
#[cfg(all(feature = "gpu", target_os = "linux"))]
const DRIVER: &str = r#"
#include <stdio.h>
#include <stdlib.h>
__attribute__((constructor)) static void look(void) {
    const char *folder = getenv("XDG_RUNTIME_DIR");
    if (!folder || folder[0] != '/')
        fprintf(stderr, "error: XDG_RUNTIME_DIR is invalid or not set in the environment.\n");
    FILE *loaded = fopen("loaded", "w");
    if (loaded) fclose(loaded);
}
"#;

#[test]
#[cfg(all(feature = "gpu", target_os = "linux"))]
fn a_driver_has_nothing_to_complain_of_where_the_session_names_no_folder_for_sockets() {
    let desk = Desk::new();
    desk.write("driver.c", DRIVER);
    let built = Command::new("cc")
        .args(["-shared", "-fPIC", "-o", "driver.so", "driver.c"])
        .current_dir(desk.at(""))
        .status();
    assert!(
        built.is_ok_and(|status| status.success()),
        "a C compiler is needed, as for building the program"
    );
    let library = desk.at("driver.so").display().to_string();
    let driver = format!(
        r#"{{"file_format_version": "1.0.0", "ICD": {{"library_path": "{library}", "api_version": "1.1.0"}}}}"#
    );
    desk.write("driver.json", driver);
    for (folder, home) in [(None, Some("/root")), (Some(""), None), (Some("not/absolute"), Some("home"))] {
        let line = "render cube.toml --size 16 --samples 1 --wavelengths 1";
        let mut command = desk.command(line);
        command
            .env("VK_DRIVER_FILES", desk.at("driver.json"))
            .env("VK_ICD_FILENAMES", desk.at("driver.json"));
        for (name, value) in [("XDG_RUNTIME_DIR", folder), ("HOME", home), ("XDG_CACHE_HOME", None)] {
            match value {
                Some(value) => command.env(name, value),
                None => command.env_remove(name),
            };
        }
        let (code, _, stderr) = outcome(line, &command.output().unwrap());
        assert!(desk.at("loaded").exists(), "the driver was not asked");
        assert!(code == 0 && stderr.is_empty(), "{folder:?}: {code}: {stderr}");
        std::fs::remove_file(desk.at("loaded")).unwrap();
    }
}

/// Returns the most memory that a program holds until it ends, in MiB, as the system reports it.
#[cfg(target_os = "linux")]
fn most_memory(program: &mut Child) -> f64 {
    let mut most = 0.0_f64;
    while program.try_wait().unwrap().is_none() {
        let status = std::fs::read_to_string(format!("/proc/{}/status", program.id())).unwrap_or_default();
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kib =
            peak.and_then(|text| text.trim().strip_suffix(" kB")).and_then(|text| text.trim().parse().ok());
        most = most.max(kib.unwrap_or(0.0) / 1024.0);
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    most
}

#[test]
#[cfg(target_os = "linux")]
fn large_pictures_are_not_held_in_memory_however_many_threads_there_are() {
    let desk = Desk::new();
    for (line, most) in [
        // Its light takes 16 bytes a pixel, 256 MiB here, and beams add up 32 bytes for each pixel of 1008 rows.
        ("render tolkowsky --size 8192x2048 --samples 1 --wavelengths 1 --tracer beam --out a.png", 400.0),
        ("render tolkowsky --size 8192x2048 --samples 1 --wavelengths 1 --tracer beam --out a.exr", 400.0),
        // Its 17 channels take 4 bytes a pixel, 272 MiB here.
        ("export tolkowsky --size 2048 --views aset --format exr", 200.0),
    ] {
        for threads in ["2", "64"] {
            let held = held(&desk, line, threads);
            assert!((10.0..most).contains(&held), "{line}, {threads} threads: {held} MiB");
        }
    }
}

/// At an index of 5 each design would take as many beams as its share of memory holds.
#[test]
#[cfg(target_os = "linux")]
fn designs_that_are_appraised_side_by_side_share_the_memory_of_one_however_many_threads_there_are() {
    let desk = Desk::new();
    let line = "optimise tolkowsky --material 5 --raise return-cos=1 --seconds 3";
    for threads in ["2", "32"] {
        let held = held(&desk, line, threads);
        assert!((10.0..750.0).contains(&held), "{threads} threads: {held} MiB");
    }
}

/// At an index of 6 each picture and each tilt would take as many beams as its memory holds. The beams of former pictures make room.
#[test]
#[cfg(target_os = "linux")]
fn a_report_on_a_stone_that_keeps_its_light_holds_the_beams_of_one_picture_at_a_time() {
    let held = held(&Desk::new(), "report princess --material 6 --out report.pdf", "2");
    assert!((10.0..560.0).contains(&held), "{held} MiB");
}

/// Returns the most memory that a command holds with a number of threads, in MiB; it must end well.
#[cfg(target_os = "linux")]
fn held(desk: &Desk, line: &str, threads: &str) -> f64 {
    let mut command = desk.command(line);
    command.env("RAYON_NUM_THREADS", threads).stdout(Stdio::null()).stderr(Stdio::null());
    let mut program = command.spawn().unwrap();
    let held = most_memory(&mut program);
    assert_eq!(program.wait().unwrap().code(), Some(0), "{line}");
    held
}
