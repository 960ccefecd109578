//! Runs the real program in a real window, on a screen that exists only in memory (Xvfb), and presses keys by xdotool.
#![cfg(all(feature = "app", target_os = "linux"))]

use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The time that a window may take to open, to close or to finish all its pictures, where cores are few and shared.
const PATIENCE: Duration = Duration::from_secs(600);

/// A screen in memory.
struct Screen {
    server: Child,
    display: String,
    folder: tempfile::TempDir,
}

/// The picture of a screen: its width, its height, and red, green and blue of each pixel.
#[derive(PartialEq)]
struct Pixels(u32, u32, Vec<u8>);

impl Screen {
    /// Opens a screen of this size; returns `None` where Xvfb or xdotool is missing, and fails where they are required.
    fn open(test: &str, size: [u32; 2]) -> Option<Self> {
        let is_there = |name: &str| {
            Command::new(name).arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
        };
        if !is_there("Xvfb") || !is_there("xdotool") {
            assert!(
                std::env::var_os("BRILLIANTEER_REQUIRE_WINDOW").is_none(),
                "Xvfb and xdotool are required"
            );
            println!("SKIPPED {test}: it needs Xvfb and xdotool");
            return None;
        }
        let folder = tempfile::tempdir().unwrap();
        // Without -noreset the server starts anew whenever its last client leaves, and refuses connections meanwhile: each
        // call of xdotool could shut out the program.
        let screen = format!("{}x{}x24", size[0], size[1]);
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", &screen, "-noreset", "-nolisten", "tcp", "-fbdir"])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.trim().is_empty(), "Xvfb ended before it had opened a screen");
        Some(Self { server, display: format!(":{}", number.trim()), folder })
    }

    /// Starts the program with so many threads; returns it with the picture of the screen once the window is at rest with
    /// this arrangement of views.
    fn start(&self, home: &Path, layout: &str, threads: &str) -> (Child, Pixels) {
        let program = self.begin(home, &[("RAYON_NUM_THREADS", threads)]);
        (program, self.at_rest(layout))
    }

    /// Starts the program with these variables, and waits until its window is there.
    fn begin(&self, home: &Path, variables: &[(&str, &str)]) -> Child {
        // The file may be from an earlier window.
        let _ = std::fs::remove_file(self.state_file());
        let messages = self.folder.path().join("messages");
        let mut program = Command::new(env!("CARGO_BIN_EXE_brillianteer"))
            // Without a window the program writes files to the folder in which it runs.
            .current_dir(self.folder.path())
            .stderr(std::fs::File::create(&messages).unwrap())
            .env("DISPLAY", &self.display)
            .envs(variables.iter().copied())
            .env("XDG_DATA_HOME", home)
            .env("XDG_RUNTIME_DIR", home)
            .env("BRILLIANTEER_STATE_FILE", self.state_file())
            .env_remove("WAYLAND_DISPLAY")
            .spawn()
            .unwrap();
        self.until("the window", || {
            if let Some(status) = program.try_wait().unwrap() {
                let messages = std::fs::read_to_string(&messages).unwrap();
                panic!("the program ended without a window ({status}); it wrote:\n{messages}");
            }
            !self.xdotool(&["search", "--name", "Brillianteer"]).trim().is_empty()
        });
        program
    }

    /// Runs xdotool and returns what it prints.
    fn xdotool(&self, line: &[&str]) -> String {
        let output = Command::new("xdotool").args(line).env("DISPLAY", &self.display).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// Presses a key in the window.
    fn press(&self, key: &str) {
        let window = self.xdotool(&["search", "--name", "Brillianteer"]);
        let window = window.lines().next().unwrap().to_owned();
        self.xdotool(&["windowfocus", &window]);
        self.xdotool(&["key", "--clearmodifiers", key]);
    }

    fn until(&self, what: &str, mut come: impl FnMut() -> bool) {
        let begun = Instant::now();
        while !come() {
            assert!(begun.elapsed() < PATIENCE, "{what} does not come");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Returns the picture of the screen, which the server keeps in an XWD file.
    fn pixels(&self) -> Pixels {
        let file = std::fs::read(self.folder.path().join("Xvfb_screen0")).unwrap();
        let word = |k: usize| u32::from_be_bytes(file[4 * k..4 * k + 4].try_into().unwrap()) as usize;
        let (width, height, line, start) = (word(4), word(5), word(12), word(0) + 12 * word(19));
        let row = |y: usize| &file[start + y * line..start + y * line + 4 * width];
        let rgb =
            (0..height).flat_map(|y| row(y).as_chunks::<4>().0.iter().flat_map(|&[b, g, r, _]| [r, g, b]));
        Pixels(width as u32, height as u32, rgb.collect())
    }

    /// Returns the path of the file in which the program reports whether its window is at rest.
    fn state_file(&self) -> PathBuf {
        self.folder.path().join("state.json")
    }

    /// Returns the picture of the screen once the program reports that its window is at rest with this arrangement of views.
    fn at_rest(&self, layout: &str) -> Pixels {
        let state =
            || -> Option<Value> { serde_json::from_slice(&std::fs::read(self.state_file()).ok()?).ok() };
        self.until("a window at rest", || {
            state().is_some_and(|state| state["at_rest"] == true && state["layout"] == layout)
        });
        self.pixels()
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Pixels {
    fn save(&self, name: &str) -> PathBuf {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), self.0, self.1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(&self.2).unwrap();
        println!("the window: {}", path.display());
        path
    }

    /// Returns the fraction of pixels that differ from those of another picture.
    fn changed(&self, other: &Self) -> f64 {
        let apart = self.2.as_chunks::<3>().0.iter().zip(other.2.as_chunks::<3>().0).filter(|(a, b)| a != b);
        apart.count() as f64 / f64::from(self.0 * self.1)
    }

    fn colours(&self) -> usize {
        self.2.as_chunks::<3>().0.iter().collect::<std::collections::HashSet<_>>().len()
    }
}

fn exit_code(program: &mut Child, screen: &Screen) -> Option<i32> {
    let begun = Instant::now();
    loop {
        if let Some(status) = program.try_wait().unwrap() {
            return status.code();
        }
        if begun.elapsed() > PATIENCE {
            program.kill().unwrap();
            screen.pixels().save("window-stuck.png");
            panic!("the program does not end");
        }
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn the_program_opens_its_window_ends_cleanly_and_comes_back_as_it_was_left() {
    let Some(screen) = Screen::open("the_program_opens_its_window", [1480, 940]) else { return };
    let home = tempfile::tempdir().unwrap();
    let (mut program, four) = screen.start(home.path(), "Four", "16");
    four.save("window.png");
    assert!(four.colours() > 2000, "only {} colours: no stone is in sight", four.colours());
    screen.press("2");
    let two = screen.at_rest("Two");
    assert!(two.changed(&four) > 0.1, "two views look like four");
    screen.press("ctrl+q");
    assert_eq!(exit_code(&mut program, &screen), Some(0));
    let (mut again, restored) = screen.start(home.path(), "Two", "32");
    restored.save("window-again.png");
    let off = restored.changed(&two);
    assert!(off < 0.01, "{:.1} % of the window is another after a new start", 100.0 * off);
    screen.press("ctrl+q");
    assert_eq!(exit_code(&mut again, &screen), Some(0));
}

#[test]
fn the_window_fits_a_small_screen_of_large_points() {
    let Some(screen) = Screen::open("the_window_fits_a_small_screen", [1280, 720]) else { return };
    let home = tempfile::tempdir().unwrap();
    let mut program = screen.begin(home.path(), &[("WINIT_X11_SCALE_FACTOR", "1.5")]);
    let geometry = || {
        screen.xdotool(&["search", "--onlyvisible", "--name", "Brillianteer", "getwindowgeometry", "--shell"])
    };
    screen.until("a window in sight", || geometry().contains("HEIGHT"));
    let text = geometry();
    let number = |key: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(&format!("{key}=")));
        line.unwrap_or_else(|| panic!("{text}")).parse::<i32>().unwrap()
    };
    let [x, y, width, height] = ["X", "Y", "WIDTH", "HEIGHT"].map(number);
    assert!(x >= 0 && y >= 0 && x + width <= 1280 && y + height <= 720, "{text}");
    assert!(width >= 1200 && height >= 600, "{text}");
    screen.press("ctrl+q");
    assert_eq!(exit_code(&mut program, &screen), Some(0));
}
