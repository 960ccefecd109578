//! Checks the page of a refraction map as a browser shows it. Without Chromium the tests print that they are skipped, and
//! with `BRILLIANTEER_REQUIRE_CHROMIUM=1` they fail.
#![cfg(feature = "cli")]

use crate::maps;
use brillianteer::io::{panorama, refraction};
use brillianteer::optics::encoded_from_linear;
use brillianteer::picture::{Linear, refract};
use glam::DVec2;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];
const PATIENCE: Duration = Duration::from_secs(600);

/// Returns the browser; `None`, with a message, where there is none.
fn browser() -> Option<PathBuf> {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let all = std::env::split_paths(&folders).flat_map(|folder| NAMES.map(|name| folder.join(name)));
    let found = all.into_iter().find(|path| path.is_file());
    let required = std::env::var_os("BRILLIANTEER_REQUIRE_CHROMIUM").is_some_and(|value| value == "1");
    assert!(found.is_some() || !required, "BRILLIANTEER_REQUIRE_CHROMIUM is set, and there is no Chromium");
    if found.is_none() {
        eprintln!("SKIPPED: there is no Chromium, so the page of refraction maps was not tested");
    }
    found
}

/// Opens a page and returns what the browser prints.
fn open(browser: &Path, folder: &Path, page: &str, options: &[&str]) -> String {
    let profile = folder.join("profile");
    let mut child = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--hide-scrollbars", "--force-device-scale-factor=1"])
        .args([
            "--force-color-profile=srgb",
            "--disable-dev-shm-usage",
            "--no-first-run",
            "--disable-extensions",
        ])
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(options)
        .arg(format!("file://{}", folder.join(page).display()))
        .stdin(Stdio::null())
        .stdout(std::fs::File::create(folder.join("printed")).unwrap())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("{page}: the browser did not end");
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    std::fs::read_to_string(folder.join("printed")).unwrap()
}

/// Options that make the browser draw by the processor, so that pictures are the same on all machines.
const SOFTWARE: [&str; 3] = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/// Writes a map of 200 by 150 pixels and its page into a new folder.
fn made(options: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let photo = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/images/gallery/ring.png");
    std::fs::copy(photo, folder.path().join("photo.png")).unwrap();
    let line =
        format!("refraction-map modern-ideal --size 200x150 --samples 1 --wavelengths 3 --out . {options}");
    let output = Command::new(env!("CARGO_BIN_EXE_brillianteer"))
        .current_dir(folder.path())
        .args(line.split_whitespace())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

/// Returns the picture that the page should show, looked up in the map's files, in eight-bit codes.
fn expected(folder: &Path, stem: &str, bands: usize, offset: DVec2) -> Vec<[u8; 3]> {
    let paths = refraction::paths(folder, stem, bands, refraction::Coding::Tiles);
    let map = maps::read(&paths, &refraction::diffuse_path(folder, stem));
    let photo = panorama::read_photo(&folder.join("photo.png")).unwrap().panorama;
    let Linear { pixels, .. } = refract(&map, &photo, offset);
    let code = |c: f32| (encoded_from_linear(f64::from(c).clamp(0.0, 1.0)) * 255.0).round() as u8;
    pixels.iter().map(|&[r, g, b, _]| [r, g, b].map(code)).collect()
}

/// Returns the upper left 200 by 150 pixels of a screenshot.
fn shot(path: &Path) -> Vec<[u8; 3]> {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let (width, each) = (info.width as usize, info.color_type.samples());
    let at = |k: usize| ((k / 200) * width + k % 200) * each;
    (0..200 * 150).map(|k| [bytes[at(k)], bytes[at(k) + 1], bytes[at(k) + 2]]).collect()
}

/// Returns the peak signal-to-noise ratio, in dB.
fn psnr(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    let squares = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2));
    10.0 * (255.0_f64.powi(2) / (squares.sum::<f64>() / (3 * a.len()) as f64).max(1e-9)).log10()
}

#[test]
fn the_page_shows_what_the_program_refracts() {
    let Some(browser) = browser() else { return };
    let tilted = (1, "--tilt 20", "modern-ideal-tilt-20");
    let near = (5, "--bands 5 --both-sides --perspective 6", "modern-ideal-perspective-6");
    for (bands, options, stem) in [tilted, near] {
        let offset = DVec2::new(0.375, -0.25) * f64::from(bands - 1);
        let folder = made(&format!("--background photo.png {options}"));
        let picture = folder.path().join("shot.png");
        let shoot = format!("--screenshot={}", picture.display());
        let more = ["--window-size=400,300", &shoot];
        let page = format!("{stem}-refraction.html#still,{},{}", offset.x, offset.y);
        open(&browser, folder.path(), &page, &[&SOFTWARE[..], &more].concat());
        let (found, wanted) = (shot(&picture), expected(folder.path(), stem, bands as usize, offset));
        let (same, mut mirrored) = (psnr(&found, &wanted), wanted.clone());
        mirrored.chunks_mut(200).for_each(<[_]>::reverse);
        let other = psnr(&found, &mirrored);
        eprintln!("{bands} bands: {same:.1} dB; against its mirror image {other:.1} dB");
        assert!(same >= 40.0 && other < 30.0, "{bands} bands: {same} and {other} dB");
    }
}

#[test]
fn the_page_moves_has_its_controls_and_says_when_it_cannot() {
    let Some(browser) = browser() else { return };
    let folder = made("");
    let dump = ["--dump-dom"];
    let page = "modern-ideal-refraction.html";
    let shown = open(&browser, folder.path(), page, &[&SOFTWARE[..], &dump].concat());
    assert!(shown.contains("role=\"alert\" hidden"), "the page reports a fault");
    for control in ["Pause</button>", "<option>Ribbons</option>", "<option>Lines</option>", "type=\"file\""] {
        assert!(shown.contains(control), "{control}");
    }
    // Pictures a second apart differ, except where the browser requests less motion.
    for (wish, moves) in [("--disable-extensions", true), ("--force-prefers-reduced-motion", false)] {
        let pictures = ["2000", "3000"].map(|time| {
            let path = folder.path().join(format!("{time}.png"));
            let (budget, shoot) =
                (format!("--virtual-time-budget={time}"), format!("--screenshot={}", path.display()));
            open(&browser, folder.path(), page, &[&SOFTWARE[..], &[wish, &budget, &shoot]].concat());
            std::fs::read(path).unwrap()
        });
        assert_eq!(pictures[0] != pictures[1], moves, "{wish}");
    }
    let without =
        open(&browser, folder.path(), page, &[&["--disable-3d-apis", "--disable-gpu"][..], &dump].concat());
    assert!(without.contains("This browser has no WebGL 2"), "the page is silent without WebGL");
}
