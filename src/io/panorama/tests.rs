//! Intact and damaged files: none may make the reader panic or ask for much memory.

use super::*;
use crate::io::{write_linear_exr, write_rgba_png};
use crate::optics::SrgbEncoder;
use crate::picture::Linear;
use std::path::PathBuf;
use tempfile::TempDir;

fn at(folder: &TempDir, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join("sky.bin");
    std::fs::write(&path, bytes).unwrap();
    path
}

fn light(k: u32) -> [f32; 3] {
    [k as f32 * 0.25, 30.0 / (k + 1) as f32, 0.125 * (k % 7) as f32]
}

fn exr_file(folder: &TempDir, width: u32, height: u32) -> Vec<u8> {
    let path = folder.path().join("made.exr");
    let pixels = (0..width * height).map(light).map(|[r, g, b]| [r, g, b, 1.0]).collect();
    write_linear_exr(&path, &mut &Linear { width, height, pixels }, "sky").unwrap();
    std::fs::read(path).unwrap()
}

fn png_file(folder: &TempDir, width: u32, height: u32) -> Vec<u8> {
    let path = folder.path().join("made.png");
    let rgba: Vec<u8> =
        (0..width * height).flat_map(|k| [k as u8, 255 - k as u8, (7 * k) as u8, 255]).collect();
    write_rgba_png(&path, &rgba, (width, height), "sky").unwrap();
    std::fs::read(path).unwrap()
}

/// Returns a Radiance file that is not packed.
fn hdr_file(signature: &str, width: u32, height: u32) -> Vec<u8> {
    let mut file = format!("{signature}\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    (0..width * height).for_each(|k| file.extend([200, 100 + (k % 100) as u8, 50, 130]));
    file
}

fn jpeg_file(width: u32, height: u32) -> Vec<u8> {
    let mut out = vec![];
    let image =
        image::RgbImage::from_fn(width, height, |x, y| image::Rgb([(8 * x) as u8, (8 * y) as u8, 128]));
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut out, 95).encode_image(&image).unwrap();
    out
}

#[test]
fn an_exr_reads_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let reading = read(&at(&folder, &exr_file(&folder, 16, 8))).unwrap();
    assert_eq!(reading.warnings, Vec::<String>::new());
    assert_eq!((reading.panorama.width, reading.panorama.height), (16, 8));
    assert_eq!(reading.panorama.pixels, (0..128).map(light).collect::<Vec<_>>());
}

#[test]
fn radiance_is_read_by_either_name() {
    let folder = tempfile::tempdir().unwrap();
    for signature in ["#?RADIANCE", "#?RGBE"] {
        let reading = read(&at(&folder, &hdr_file(signature, 6, 3))).unwrap();
        // Mantissas of 8 bits, their exponent from 128: 200 · 2^(130 − 136).
        assert!(
            (reading.panorama.pixels[0][0] - 200.0 / 64.0).abs() < 0.02,
            "{:?}",
            reading.panorama.pixels[0]
        );
        assert_eq!(reading.panorama.pixels.len(), 18);
    }
}

#[test]
fn photographs_become_linear_light() {
    let folder = tempfile::tempdir().unwrap();
    let encoder = SrgbEncoder::new();
    let reading = read(&at(&folder, &png_file(&folder, 20, 10))).unwrap();
    for (k, pixel) in reading.panorama.pixels.iter().enumerate() {
        let codes = pixel.map(|c| encoder.encode(f64::from(c)));
        assert_eq!(codes, [k as u8, 255 - k as u8, (7 * k) as u8]);
    }
    let reading = read_photo(&at(&folder, &jpeg_file(24, 16))).unwrap();
    let codes = reading.panorama.pixels[8 * 24 + 12].map(|c| encoder.encode(f64::from(c)));
    assert!(codes.iter().zip([96, 64, 128]).all(|(&a, b)| a.abs_diff(b) < 8), "{codes:?}");
    assert!(reading.warnings.is_empty());
}

#[test]
fn what_is_transparent_is_dark() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    write_rgba_png(&path, &[255, 255, 255, 0, 255, 255, 255, 51], (2, 1), "").unwrap();
    let pixels = read(&path).unwrap().panorama.pixels;
    assert!(pixels[0] == [0.0; 3] && (pixels[1][0] - 0.2).abs() < 1e-6, "{pixels:?}");
}

#[test]
fn odd_light_and_odd_shapes_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("odd.exr");
    let mut picture = Linear::new(4, 4);
    picture.pixels[0] = [f32::NAN, 1.0, 1.0, 1.0];
    picture.pixels[1] = [1.0, f32::INFINITY, -1.0, 1.0];
    write_linear_exr(&path, &mut &picture, "").unwrap();
    let reading = read(&path).unwrap();
    assert_eq!(reading.panorama.pixels[..2], [[0.0, 1.0, 1.0], [1.0, 0.0, 0.0]]);
    assert_eq!(reading.warnings.len(), 2, "{:?}", reading.warnings);
    assert!(reading.warnings[0].contains("odd.exr: 2 pixels") && reading.warnings[1].contains("4 by 4"));
}

#[test]
fn what_is_no_picture_says_what_to_give() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.hdr");
    assert!(read(&path).unwrap_err().to_string().ends_with("none.hdr: there is no such file"));
    assert!(read(folder.path()).unwrap_err().to_string().contains("OpenEXR"));
    let gif: &[u8] = b"GIF89a\x01\x00\x01\x00\x00\x00\x00;";
    for garbage in [b"".as_slice(), b"a", b"#?", b"#?RADIANCE\n\n", b"hello, world", &[0xff; 50], gif] {
        let error = read(&at(&folder, garbage)).unwrap_err().to_string();
        assert!(error.contains("sky.bin: ") && error.contains("PNG"), "{error}");
    }
}

#[test]
fn lying_headers_are_found_out() {
    let folder = tempfile::tempdir().unwrap();
    for (width, height, word) in [
        (16_385, 2, "too many"),
        (2, 8193, "too many"),
        (4_294_967_295_u32, 4_294_967_295_u32, ""),
        (16_384, 8192, "cannot hold"),
        (0, 4, ""),
    ] {
        let mut file = hdr_file("#?RADIANCE", 1, 1);
        let text = format!("#?RADIANCE\n\n-Y {height} +X {width}\n");
        file.splice(.., text.into_bytes());
        let error = read(&at(&folder, &file)).unwrap_err().to_string();
        assert!(error.contains(word), "hdr {width} {height}: {error}");
        let mut file = png_file(&folder, 4, 4);
        file[16..20].copy_from_slice(&width.to_be_bytes());
        file[20..24].copy_from_slice(&height.to_be_bytes());
        assert!(read(&at(&folder, &file)).is_err());
        let mut file = exr_file(&folder, 4, 4);
        for window in [b"dataWindow\0box2i\0".as_slice(), b"displayWindow\0box2i\0"] {
            let start = file.windows(window.len()).position(|w| w == window).unwrap() + window.len() + 12;
            file[start..start + 4].copy_from_slice(&width.wrapping_sub(1).to_le_bytes());
            file[start + 4..start + 8].copy_from_slice(&height.wrapping_sub(1).to_le_bytes());
        }
        assert!(read(&at(&folder, &file)).is_err(), "exr {width} {height}");
    }
}

#[test]
fn cut_and_spoilt_files_are_errors_or_pictures_but_never_panics() {
    let folder = tempfile::tempdir().unwrap();
    let files =
        [exr_file(&folder, 9, 5), png_file(&folder, 9, 5), hdr_file("#?RADIANCE", 9, 5), jpeg_file(16, 9)];
    let mut seed = 1_u32;
    let mut random = move || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as usize
    };
    for file in files {
        for length in (0..file.len()).step_by(1 + file.len() / 100) {
            let _ = read(&at(&folder, &file[..length]));
        }
        for _ in 0..400 {
            let mut spoilt = file.clone();
            for _ in 0..1 + random() % 4 {
                let at = random() % if random() % 2 == 0 { spoilt.len() } else { spoilt.len().min(300) };
                spoilt[at] = [0, 255, 128, 127, random() as u8][random() % 5];
            }
            if let Ok(reading) = read(&at(&folder, &spoilt)) {
                let Panorama { width, height, pixels } = reading.panorama;
                assert_eq!(pixels.len(), width as usize * height as usize);
                assert!(pixels.iter().flatten().all(|c| c.is_finite() && *c >= 0.0));
            }
        }
    }
}
