//! Checks the page of a refraction map as a browser shows it. Without Chromium the tests print that they are skipped, and
//! with `BRILLIANTEER_REQUIRE_CHROMIUM=1` they fail.
#![cfg(feature = "cli")]

use crate::maps;
use brillianteer::io::{panorama, refraction};
use brillianteer::optics::encoded_from_linear;
use brillianteer::picture::{Linear, SourcePlace, refract};
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
    let tilted = (1, "--tilt 20", "modern-ideal-photo-tilt-20");
    let near = (5, "--bands 5 --both-sides --perspective 6", "modern-ideal-both-sides-photo-perspective-6");
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

/// Writes the picture that another renderer would make of the gradient, by the map of a file in OpenEXR: 16 bits, the
/// nearest pixel of the template, dark by the weight.
fn rendered_elsewhere(folder: &Path, map: &refraction::LoadedMap) {
    const SIDE: f32 = 4096.0;
    let nearest = |part: f32| ((part * SIDE).floor().min(SIDE - 1.0) + 0.5) / SIDE;
    let code = |part: f32| ((part * 65_535.0).round() as u16).to_be_bytes();
    let colour = |place: &SourcePlace| {
        [nearest(place.u), nearest(place.v), 1.0].map(|part| code(part * place.weight)).into_iter().flatten()
    };
    let data: Vec<u8> = map.map.bands[0].places.iter().flat_map(colour).collect();
    let file = std::fs::File::create(folder.join("foreign.png")).unwrap();
    let mut encoder = png::Encoder::new(file, map.map.size[0], map.map.size[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
}

#[test]
fn the_page_of_a_foreign_map_shows_the_picture_of_the_own_page() {
    let Some(browser) = browser() else { return };
    let folder = made("--background photo.png --both-sides --format exr,page");
    let stem = "modern-ideal-both-sides-photo";
    let own = refraction::read(
        &refraction::paths(folder.path(), stem, 1, refraction::Coding::Float),
        Some(&refraction::diffuse_path(folder.path(), stem)),
        None,
    );
    rendered_elsewhere(folder.path(), &own.unwrap());
    let output = Command::new(env!("CARGO_BIN_EXE_brillianteer"))
        .current_dir(folder.path())
        .args(["refraction-import", "foreign.png", "--background", "photo.png", "--out", "."])
        .arg("--diffuse")
        .arg(refraction::diffuse_path(folder.path(), stem))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let seen = |page: &str| {
        let picture = folder.path().join(format!("{page}.png"));
        let shoot = format!("--screenshot={}", picture.display());
        let address = format!("{page}-refraction.html#still,0.125,0.25");
        let more = ["--window-size=400,300", &shoot];
        open(&browser, folder.path(), &address, &[&SOFTWARE[..], &more].concat());
        shot(&picture)
    };
    let (own, foreign) = (seen(stem), seen("foreign-photo"));
    let mut mirrored = own.clone();
    mirrored.chunks_mut(200).for_each(<[_]>::reverse);
    let (same, other) = (psnr(&own, &foreign), psnr(&mirrored, &foreign));
    eprintln!("{same:.1} dB; against its mirror image {other:.1} dB");
    assert!(same >= 40.0 && other < 30.0, "{same} and {other} dB");
}

#[test]
fn the_page_measures_its_start_and_its_frames() {
    let Some(browser) = browser() else { return };
    let folder = made("");
    let page = "modern-ideal-refraction.html#timing,20";
    let shown = open(&browser, folder.path(), page, &[&SOFTWARE[..], &["--dump-dom"]].concat());
    let (_, after) = shown.split_once("data-timing=\"").expect("the page says how long it took");
    let text = after.split('"').next().unwrap().replace("&quot;", "\"");
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let mut frames: Vec<f64> =
        found["frames"].as_array().unwrap().iter().map(|ms| ms.as_f64().unwrap()).collect();
    assert_eq!(frames.len(), 20);
    frames.sort_by(f64::total_cmp);
    let first = found["first"].as_f64().unwrap();
    eprintln!("first picture after {first:.0} ms, a frame in {:.0} ms (median)", frames[10]);
    assert!(first > 0.0 && frames[0] >= 0.0);
    let without = open(
        &browser,
        folder.path(),
        "modern-ideal-refraction.html",
        &[&SOFTWARE[..], &["--dump-dom"]].concat(),
    );
    assert!(!without.contains("data-timing="), "a page measures only if it is asked to");
}
