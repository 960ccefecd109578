//! Measures how quickly the real window follows the hand, from events of the pointer to pixels on a screen that exists only
//! in memory (Xvfb). This takes some minutes and two cores that are idle otherwise, so it is not run with the other tests:
//! `cargo test --release --test program window_speed -- --ignored --nocapture`
//!
//! `BRILLIANTEER_PAINTER=card` measures the painter for graphics cards instead, by a driver that computes in software.
#![cfg(all(feature = "app", target_os = "linux"))]

use brillianteer::app::{Editor, Setup};
use egui::{Pos2, Rect, Role, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::ffi::OsStr;
use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{BufRead, BufReader};
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ConnectionExt as _, MOTION_NOTIFY_EVENT,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// The size of the window, in pixels.
const SIZE: [f32; 2] = [1440.0, 900.0];

/// The time that the program may take to start and to come to rest.
const PATIENCE: Duration = Duration::from_secs(600);

/// The time from one event of the pointer to the next: most mice report 125 times a second or more, and screens show 60
/// pictures.
const HAND: Duration = Duration::from_micros(16_667);

/// The time of a drag, and the time that the test waits for a step of a drag to show.
const DRAG: Duration = Duration::from_secs(6);
const STEP: Duration = Duration::from_millis(250);

/// Changes of a region that are closer together than this count as one, because the region is read while the server
/// writes it.
const ONE: Duration = Duration::from_millis(8);

/// The requirements: complete updates per second in a drag, images per second over menus, and milliseconds from the hand to
/// the number that it drags.
const UPDATES: f64 = 20.0;
const MENUS: f64 = 30.0;
const NUMBER: f64 = 40.0;

/// The largest share of the cores that other programs may use for the figures to count.
const OTHERS: f64 = 0.1;

/// The positions of things in the window, in points of one pixel.
struct Places {
    crown_angle: Rect,
    view_menu: Rect,
    /// Render, ASET, hearts, profile.
    views: [Rect; 4],
    figure: Rect,
}

/// Returns the position of the render of a design.
fn render_of(design: &Path) -> Rect {
    let setup = Setup { file: Some(design.to_owned()), ..Setup::default() };
    let mut harness = Harness::builder()
        .with_size(egui::Vec2::from(SIZE))
        .build_eframe(|context| Editor::new(context, setup).unwrap());
    let is_open =
        |harness: &Harness<Editor>| harness.query_by_role_and_label(Role::Image, "Render picture").is_some();
    let begun = Instant::now();
    while !is_open(&harness) {
        assert!(begun.elapsed() < PATIENCE, "{} does not open", design.display());
        harness.run_steps(1);
    }
    harness.run_steps(8);
    harness.get_by_role_and_label(Role::Image, "Render picture").rect()
}

impl Places {
    /// Finds the positions from the editor itself, in a window of the same size that is not shown.
    fn find() -> Self {
        let mut harness = Harness::builder()
            .with_size(egui::Vec2::from(SIZE))
            .build_eframe(|context| Editor::new(context, Setup::default()).unwrap());
        harness.run_steps(8);
        let views = ["Render picture", "ASET picture", "Hearts picture", "Profile of the stone"];
        let figures = harness.get_by_label("Figures").rect();
        Self {
            crown_angle: harness.get_by_role_and_label(Role::SpinButton, "Crown angle").rect(),
            view_menu: harness.get_by_label("View").rect(),
            views: views.map(|name| harness.get_by_role_and_label(Role::Image, name).rect()),
            // The figures of the zones follow some rows below their heading.
            figure: Rect::from_min_max(figures.left_bottom(), pos2(SIZE[0] - 12.0, figures.bottom() + 260.0)),
        }
    }
}

/// A screen in memory with the program's window.
struct Stage {
    server: Child,
    program: Child,
    pointer: RustConnection,
    root: u32,
    corner: [i16; 2],
    screen: File,
    start: u64,
    line: u64,
    folder: tempfile::TempDir,
}

impl Stage {
    /// Starts the program on a screen of its own, with the design that it opens by itself or another.
    fn open(design: Option<&Path>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut server = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                "1480x940x24",
                "-nocursor",
                "-noreset",
                "-nolisten",
                "tcp",
                "-fbdir",
            ])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is needed");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        let program = Command::new(env!("CARGO_BIN_EXE_brillianteer"))
            .args(design.map(|path| [OsStr::new("edit"), path.as_os_str()]).into_iter().flatten())
            .env("DISPLAY", &display)
            .env("XDG_DATA_HOME", folder.path())
            .env("XDG_RUNTIME_DIR", folder.path())
            .env("WINIT_X11_SCALE_FACTOR", "1")
            .env("BRILLIANTEER_STATE_FILE", folder.path().join("state.json"))
            .env_remove("WAYLAND_DISPLAY")
            .spawn()
            .unwrap();
        let (pointer, _) = x11rb::connect(Some(&display)).unwrap();
        let root = pointer.setup().roots[0].root;
        let screen = File::open(folder.path().join("Xvfb_screen0")).unwrap();
        let word = |k: u64| {
            let mut bytes = [0; 4];
            screen.read_exact_at(&mut bytes, 4 * k).unwrap();
            u64::from(u32::from_be_bytes(bytes))
        };
        // The file is an XWD: its header, 12 bytes for each colour of a map, and then the pixels.
        let (start, line) = (word(0) + 12 * word(19), word(12));
        let mut stage = Self { server, program, pointer, root, corner: [0, 0], screen, start, line, folder };
        stage.corner = stage.window();
        stage
    }

    /// Waits for the window and returns the position of its top left corner.
    fn window(&self) -> [i16; 2] {
        let begun = Instant::now();
        loop {
            let tree = self.pointer.query_tree(self.root).unwrap().reply().unwrap();
            for child in tree.children {
                let Ok(at) = self.pointer.get_geometry(child).unwrap().reply() else { continue };
                if [f32::from(at.width), f32::from(at.height)] == SIZE {
                    return [at.x, at.y];
                }
            }
            assert!(begun.elapsed() < PATIENCE, "the window does not come");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn event(&self, kind: u8, detail: u8, at: Pos2) {
        let [x, y] = [at.x as i16 + self.corner[0], at.y as i16 + self.corner[1]];
        self.pointer.xtest_fake_input(kind, detail, 0, self.root, x, y, 0).unwrap();
        self.pointer.flush().unwrap();
    }

    fn hand_at(&self, at: Pos2) {
        self.event(MOTION_NOTIFY_EVENT, 0, at);
    }

    fn press(&self, at: Pos2) {
        self.event(BUTTON_PRESS_EVENT, 1, at);
    }

    fn release(&self, at: Pos2) {
        self.event(BUTTON_RELEASE_EVENT, 1, at);
    }

    /// Returns a hash of some rows of a region.
    fn seen(&self, region: Rect) -> u64 {
        let mut hash = DefaultHasher::new();
        let rows = 16.0_f32.min(region.height());
        let mut line = vec![0_u8; 4 * region.width() as usize];
        for k in 0..rows as u32 {
            let y = region.min.y + (k as f32 + 0.5) * region.height() / rows;
            let y = y as u64 + self.corner[1] as u64;
            let x = region.min.x as u64 + self.corner[0] as u64;
            self.screen.read_exact_at(&mut line, self.start + y * self.line + 4 * x).unwrap();
            line.hash(&mut hash);
        }
        hash.finish()
    }

    /// Returns what the program last reported of itself.
    fn state(&self) -> serde_json::Value {
        let text = std::fs::read(self.folder.path().join("state.json")).unwrap_or_default();
        serde_json::from_slice(&text).unwrap_or_default()
    }

    /// Waits until the program has reported for a while that every picture and figure is final.
    fn rest(&self) {
        let (begun, mut since) = (Instant::now(), Instant::now());
        while since.elapsed() < Duration::from_secs(1) {
            assert!(begun.elapsed() < PATIENCE, "the window does not come to rest");
            std::thread::sleep(Duration::from_millis(50));
            if self.state()["at_rest"] != true {
                since = Instant::now();
            }
        }
    }

    /// Moves the hand along a path, one place each [`HAND`], for a while; returns how many times a second each region
    /// changed.
    fn changes(&self, path: impl Fn(u32) -> Pos2, regions: &[Rect], long: Duration) -> Vec<f64> {
        let begun = Instant::now();
        let mut seen: Vec<(u64, Option<Instant>, u32)> =
            regions.iter().map(|&region| (self.seen(region), None, 0)).collect();
        let mut step = 0;
        while begun.elapsed() < long {
            if begun.elapsed() >= HAND * step {
                self.hand_at(path(step));
                step += 1;
            }
            for ((last, when, count), &region) in seen.iter_mut().zip(regions) {
                let now = self.seen(region);
                if now != *last {
                    *last = now;
                    let is_same = when.is_some_and(|when: Instant| when.elapsed() < ONE);
                    (*when, *count) = (Some(Instant::now()), *count + u32::from(!is_same));
                }
            }
            std::thread::sleep(Duration::from_micros(1500));
        }
        seen.iter().map(|(.., count)| f64::from(*count) / long.as_secs_f64()).collect()
    }

    /// Moves the hand by steps, with time between them; returns the milliseconds until each region changes, the median and
    /// the slowest of all steps. Steps that do not change the first region are too small for it and do not count.
    fn delays(&self, path: impl Fn(u32) -> Pos2, regions: &[Rect], steps: u32) -> Vec<[f64; 2]> {
        let mut all: Vec<Vec<f64>> = vec![vec![]; regions.len()];
        for step in 0..steps {
            let before: Vec<u64> = regions.iter().map(|&region| self.seen(region)).collect();
            let begun = Instant::now();
            self.hand_at(path(step));
            let mut after = vec![None; regions.len()];
            while begun.elapsed() < STEP {
                for ((after, before), &region) in after.iter_mut().zip(&before).zip(regions) {
                    if after.is_none() && self.seen(region) != *before {
                        *after = Some(begun.elapsed().as_secs_f64() * 1e3);
                    }
                }
                std::thread::sleep(Duration::from_micros(500));
            }
            if after[0].is_none() {
                continue;
            }
            for (all, after) in all.iter_mut().zip(after) {
                all.push(after.unwrap_or(f64::INFINITY));
            }
        }
        assert!(2 * all[0].len() >= steps as usize, "{} of {steps} steps changed something", all[0].len());
        let both = |mut all: Vec<f64>| {
            all.sort_by(f64::total_cmp);
            [all[all.len() / 2], all[all.len() - 1]]
        };
        all.into_iter().map(both).collect()
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        for child in [&mut self.program, &mut self.server] {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// Returns the core seconds used until now: by the whole machine, and of these by this test, the program and the server.
fn used(stage: &Stage) -> [f64; 2] {
    // The system counts in ticks of a hundredth of a second, as everywhere on Linux.
    let sum = |text: &str, fields: std::ops::Range<usize>| -> f64 {
        let all: Vec<f64> = text.split_whitespace().map(|n| n.parse().unwrap_or(0.0)).collect();
        all[fields].iter().sum::<f64>() / 100.0
    };
    let stat = std::fs::read_to_string("/proc/stat").unwrap();
    let whole = stat.lines().next().unwrap().trim_start_matches("cpu").to_owned();
    // The fields are user, nice and system, and after the idle times interrupts and the time that a host took away.
    let machine = sum(&whole, 0..3) + sum(&whole, 5..8);
    let of = |id: u32| {
        let text = std::fs::read_to_string(format!("/proc/{id}/stat")).unwrap();
        sum(text.rsplit(')').next().unwrap(), 11..13)
    };
    [machine, [std::process::id(), stage.program.id(), stage.server.id()].into_iter().map(of).sum()]
}

/// Returns a point that swings to and fro, like a hand that looks for the best value.
fn swing(middle: Pos2, by: egui::Vec2, step: u32) -> Pos2 {
    let phase = (step % 80) as f32;
    middle + by * (phase.min(80.0 - phase) - 20.0)
}

/// Judges whether the measurements meet the requirements.
struct Judge(Vec<String>);

impl Judge {
    fn least(&mut self, what: &str, reached: f64, goal: f64) {
        self.0.extend((reached < goal).then(|| format!("{what}: {reached:.1}, not {goal}")));
    }

    fn most(&mut self, what: &str, reached: f64, goal: f64) {
        self.0.extend((reached > goal).then(|| format!("{what}: {reached:.1}, not {goal}")));
    }
}

#[test]
#[ignore = "takes minutes and two idle cores"]
fn the_window_follows_the_hand() {
    let places = Places::find();
    let stage = Stage::open(None);
    stage.rest();
    let cores = std::thread::available_parallelism().unwrap().get() as f64;
    let (begun, before) = (Instant::now(), used(&stage));
    let mut judge = Judge(vec![]);
    let number = places.crown_angle;
    let all: Vec<Rect> = places.views.into_iter().chain([places.figure]).collect();
    let along = |middle: Pos2, by: egui::Vec2| move |step: u32| swing(middle, by, step);
    for (name, hold, by) in [
        ("crown angle", number.center(), egui::vec2(1.0, 0.0)),
        ("tilt", places.views[1].center() + egui::vec2(40.0, 30.0), egui::vec2(1.5, 1.0)),
    ] {
        stage.hand_at(hold);
        std::thread::sleep(Duration::from_millis(200));
        stage.press(hold);
        let path = along(hold, by);
        let rates = stage.changes(path, &all, DRAG);
        // The profile does not tilt.
        let complete = rates.iter().enumerate().filter(|(k, _)| name != "tilt" || *k != 3);
        let complete = complete.map(|(_, rate)| *rate).fold(f64::MAX, f64::min);
        let [render, aset, hearts, profile, figure] = rates[..] else { unreachable!() };
        println!(
            "{name}: {complete:.1} complete updates a second (render {render:.1}, ASET {aset:.1}, hearts {hearts:.1}, \
             profile {profile:.1}, figures {figure:.1})"
        );
        judge.least(&format!("updates a second in a drag of {name}"), complete, UPDATES);
        let watched = match name {
            "tilt" => vec![("ASET", places.views[1]), ("figures", places.figure)],
            _ => vec![
                ("number", number),
                ("profile", places.views[3]),
                ("ASET", places.views[1]),
                ("figures", places.figure),
            ],
        };
        let regions: Vec<Rect> = watched.iter().map(|(_, region)| *region).collect();
        let delays = stage.delays(path, &regions, 24);
        println!(
            "{name}: milliseconds after a step, the middle of those that changed something and the slowest:"
        );
        for ((what, _), [middle, slowest]) in watched.iter().zip(&delays) {
            println!("    {what} {middle:.0} ({slowest:.0})");
        }
        if name == "crown angle" {
            judge.most("milliseconds from hand to number", delays[0][0], NUMBER);
        }
        stage.release(path(23));
        stage.rest();
    }
    let menu = places.view_menu;
    stage.hand_at(menu.center());
    stage.press(menu.center());
    stage.release(menu.center());
    stage.rest();
    let list = Rect::from_min_size(menu.left_bottom(), egui::vec2(180.0, 260.0));
    let entries = |step: u32| list.min + egui::vec2(60.0, 20.0 + 24.0 * (step % 9) as f32);
    let hovering = used(&stage)[1];
    let rate = stage.changes(entries, &[list], DRAG)[0];
    let hovering = (used(&stage)[1] - hovering) / DRAG.as_secs_f64();
    println!(
        "menus: {rate:.1} images a second, by {hovering:.2} of a core for all of program, server and test"
    );
    judge.least("images a second over menus", rate, MENUS);
    let after = used(&stage);
    let others = (after[0] - before[0] - (after[1] - before[1])) / (begun.elapsed().as_secs_f64() * cores);
    println!("other programs took {:.0} % of {cores} cores", 100.0 * others);
    if others > OTHERS {
        println!("NOT JUDGED: the machine is not idle");
    } else {
        assert!(judge.0.is_empty(), "{}", judge.0.join("; "));
    }
}

/// The designs that are turned: files that the environment names, as it does the paths of programs, or else all glass shapes.
fn turned() -> Vec<PathBuf> {
    let glass = |name| Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cuts/{name}.toml"));
    match std::env::var_os("BRILLIANTEER_TURNED") {
        Some(files) => std::env::split_paths(&files).collect(),
        None => ["pill", "prism", "cube", "plate", "fisheye"].map(glass).to_vec(),
    }
}

#[test]
#[ignore = "takes minutes and two idle cores"]
fn the_window_shows_designs_while_they_are_turned() {
    for design in turned() {
        let place = render_of(&design);
        let stage = Stage::open(Some(&design));
        stage.rest();
        let hold = place.center() + egui::vec2(40.0, 30.0);
        stage.hand_at(hold);
        std::thread::sleep(Duration::from_millis(200));
        stage.press(hold);
        let path = |step: u32| swing(hold, egui::vec2(1.5, 1.0), step);
        let rate = stage.changes(path, &[place], DRAG)[0];
        let state = stage.state();
        let [renders, others] =
            ["renders", "others"].map(|kind| state["blocks"][kind].as_f64().unwrap_or(f64::NAN));
        stage.release(path(23));
        let [across, down] = [place.width(), place.height()];
        println!(
            "{}: {rate:.1} renders of {across:.0} x {down:.0} points a second while it is turned, at the end in \
             blocks of {renders:.1} pixels, those of other pictures {others:.1}",
            design.display()
        );
    }
}
