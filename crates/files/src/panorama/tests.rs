//! Intact and damaged files: none may make the reader panic or ask for much memory.

use super::*;
use ::exr::prelude::write_rgba_file;
use brillianteer_optics::SrgbEncoder;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn at(folder: &TempDir, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join("sky.bin");
    std::fs::write(&path, bytes).unwrap();
    path
}

fn light(k: u32) -> [f32; 3] {
    [k as f32 * 0.25, 30.0 / (k + 1) as f32, 0.125 * (k % 7) as f32]
}

fn write_exr(path: &Path, width: u32, pixels: &[[f32; 4]]) {
    let (across, down) = (width as usize, pixels.len() / width as usize);
    let pixel = |x: usize, y: usize| <(f32, f32, f32, f32)>::from(pixels[y * across + x]);
    write_rgba_file(path, across, down, pixel).unwrap();
}

fn write_png(path: &Path, rgba: &[u8], (width, height): (u32, u32)) {
    image::save_buffer_with_format(
        path,
        rgba,
        width,
        height,
        image::ColorType::Rgba8,
        image::ImageFormat::Png,
    )
    .unwrap();
}

fn exr_file(folder: &TempDir, width: u32, height: u32) -> Vec<u8> {
    let path = folder.path().join("made.exr");
    let pixels: Vec<_> = (0..width * height).map(light).map(|[r, g, b]| [r, g, b, 1.0]).collect();
    write_exr(&path, width, &pixels);
    std::fs::read(path).unwrap()
}

fn png_file(folder: &TempDir, width: u32, height: u32) -> Vec<u8> {
    let path = folder.path().join("made.png");
    let rgba: Vec<u8> =
        (0..width * height).flat_map(|k| [k as u8, 255 - k as u8, (7 * k) as u8, 255]).collect();
    write_png(&path, &rgba, (width, height));
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
    write_png(&path, &[255, 255, 255, 0, 255, 255, 255, 51], (2, 1));
    let pixels = read(&path).unwrap().panorama.pixels;
    assert!(pixels[0] == [0.0; 3] && (pixels[1][0] - 0.2).abs() < 1e-6, "{pixels:?}");
}

#[test]
fn odd_light_and_odd_shapes_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("odd.exr");
    let mut pixels = [[0.0; 4]; 16];
    pixels[0] = [f32::NAN, 1.0, 1.0, 1.0];
    pixels[1] = [1.0, f32::INFINITY, -1.0, 1.0];
    write_exr(&path, 4, &pixels);
    let reading = read(&path).unwrap();
    // A sun that overflowed is bright.
    assert_eq!(reading.panorama.pixels[..2], [[0.0, 1.0, 1.0], [1.0, LARGEST_HALF, 0.0]]);
    let [infinite, dark, shape] = &reading.warnings[..] else { panic!("{:?}", reading.warnings) };
    assert!(infinite.contains("odd.exr: 1 pixels are too bright") && infinite.ends_with("read as 65504"));
    assert!(dark.contains("odd.exr: 2 pixels") && shape.contains("4 by 4"));
    // Where the picture holds more than 16 bits can, its brightest light.
    pixels[2] = [1e6; 4];
    write_exr(&path, 4, &pixels);
    assert_eq!(read(&path).unwrap().panorama.pixels[1], [1.0, 1e6, 0.0]);
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

mod layers {
    use super::*;
    use ::exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
    use ::exr::math::Vec2;
    use ::exr::meta::attribute::{IntegerBounds, Text};
    use ::exr::meta::header::{ImageAttributes, LayerAttributes};
    use ::exr::prelude::WritableImage;
    use ::exr::prelude::f16;

    const SIZE: (usize, usize) = (8, 4);

    /// A part of a file: its name, and its channels, each of one value.
    type Part<'a> = (Option<&'a str>, &'a [(&'a str, f32)]);

    fn layer(part: &Part, at: Vec2<i32>, samples: fn(f32) -> FlatSamples) -> Layer<AnyChannels<FlatSamples>> {
        let channels = part.1.iter().map(|&(name, value)| AnyChannel::new(name, samples(value)));
        let attributes = LayerAttributes {
            layer_name: part.0.map(Text::from),
            layer_position: at,
            ..LayerAttributes::default()
        };
        Layer::new(SIZE, attributes, Encoding::FAST_LOSSLESS, AnyChannels::sort(channels.collect()))
    }

    /// Writes parts whose data lie in a display window.
    fn file(
        folder: &TempDir,
        parts: &[Part],
        window: IntegerBounds,
        samples: fn(f32) -> FlatSamples,
    ) -> PathBuf {
        let path = folder.path().join("layers.exr");
        let layers: Vec<Layer<_>> = parts.iter().map(|part| layer(part, Vec2(0, 0), samples)).collect();
        let image = Image::from_layers(ImageAttributes::new(window), layers);
        image.write().to_file(&path).unwrap();
        path
    }

    fn floats(value: f32) -> FlatSamples {
        FlatSamples::F32(vec![value; SIZE.0 * SIZE.1])
    }

    fn whole() -> IntegerBounds {
        IntegerBounds { position: Vec2(0, 0), size: Vec2(SIZE.0, SIZE.1) }
    }

    const RGB: [(&str, f32); 3] = [("R", 1.0), ("G", 2.0), ("B", 3.0)];

    #[test]
    fn the_picture_is_found_in_layers_of_any_name() {
        let folder = tempfile::tempdir().unwrap();
        let other = [("a.R", 9.0), ("a.G", 9.0), ("a.B", 9.0)];
        let combined =
            [("View.Combined.R", 1.0), ("View.Combined.G", 2.0), ("View.Combined.B", 3.0), ("View.Z", 5.0)];
        let both = [&other[..], &combined[..]].concat();
        let plain_too = [&other[..], &RGB[..], &[("A", 0.5)][..]].concat();
        let lower = [("r", 1.0), ("g", 2.0), ("b", 3.0)];
        let words = [("beauty.red", 1.0), ("beauty.green", 2.0), ("beauty.blue", 3.0)];
        let normal = [("N.X", 1.0), ("N.Y", 2.0), ("N.Z", 3.0)];
        let cases: [(&[Part], bool); 8] = [
            (&[(None, &RGB)], false),
            (&[(None, &combined)], false),
            (&[(None, &both[..])], true),
            (&[(None, &plain_too[..])], false),
            (&[(None, &lower)], false),
            (&[(None, &words)], false),
            (&[(Some("depth"), &normal), (Some("picture"), &RGB)], false),
            (&[(Some("glow"), &[("R", 9.0), ("G", 9.0), ("B", 9.0)]), (Some("Beauty"), &RGB)], true),
        ];
        for (number, (parts, is_doubtful)) in cases.into_iter().enumerate() {
            let reading = read(&file(&folder, parts, whole(), floats)).unwrap();
            assert_eq!(reading.panorama.pixels, [[1.0, 2.0, 3.0]; 32], "case {number}");
            let warned = reading.warnings.iter().any(|text| text.contains("of its layers with colours"));
            assert_eq!(
                (warned, reading.warnings.len()),
                (is_doubtful, usize::from(is_doubtful)),
                "case {number}"
            );
        }
        let error = read(&file(&folder, &[(None, &normal)], whole(), floats)).unwrap_err().to_string();
        assert!(error.contains("no layer has channels R, G and B, or the luminance Y"), "{error}");
    }

    #[test]
    fn luminance_is_grey_and_chroma_gives_it_colour() {
        let folder = tempfile::tempdir().unwrap();
        let grey = read(&file(&folder, &[(None, &[("Y", 0.5)])], whole(), floats)).unwrap();
        assert_eq!((&grey.panorama.pixels[..], grey.warnings.len()), (&[[0.5; 3]; 32][..], 0));
        let [r, g, b] = [0.25_f32, 0.5, 0.75];
        let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let chroma = [("Y", y), ("RY", (r - y) / y), ("BY", (b - y) / y)];
        let read = read(&file(&folder, &[(None, &chroma)], whole(), floats)).unwrap().panorama.pixels;
        assert!(read[7].iter().zip([r, g, b]).all(|(a, b)| (a - b).abs() < 1e-5), "{:?}", read[7]);
    }

    #[test]
    fn numbers_of_every_kind_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let halves = |value| FlatSamples::F16(vec![f16::from_f32(value); 32]);
        let wholes = |value| FlatSamples::U32(vec![value as u32; 32]);
        for samples in [halves as fn(f32) -> FlatSamples, wholes] {
            let read = read(&file(&folder, &[(None, &RGB)], whole(), samples)).unwrap();
            assert_eq!(read.panorama.pixels, [[1.0, 2.0, 3.0]; 32]);
        }
    }

    #[test]
    fn data_lie_at_their_place_in_the_window_of_the_picture() {
        let folder = tempfile::tempdir().unwrap();
        let of = |x, y, width, height| {
            let window = IntegerBounds { position: Vec2(x, y), size: Vec2(width, height) };
            read(&file(&folder, &[(None, &RGB)], window, floats)).unwrap()
        };
        // The data are the right lower quarter of a picture of 16 by 8.
        let larger = of(-8, -4, 16, 8);
        assert_eq!((larger.panorama.width, larger.panorama.height), (16, 8));
        for (k, pixel) in larger.panorama.pixels.iter().enumerate() {
            let is_held = k % 16 >= 8 && k / 16 >= 4;
            assert_eq!(*pixel, if is_held { [1.0, 2.0, 3.0] } else { [0.0; 3] }, "{k}");
        }
        assert!(
            larger.warnings[0].contains("cover 25.000 % of the picture of 16 by 8"),
            "{:?}",
            larger.warnings
        );
        // The data go beyond the picture on all sides.
        let smaller = of(2, 1, 4, 2);
        assert_eq!(smaller.panorama.pixels, [[1.0, 2.0, 3.0]; 8]);
        assert_eq!(smaller.warnings, Vec::<String>::new());
    }
}

/// Returns a flat Radiance file with these lines in its header, whose pixels are `rgbe`.
fn hdr_of(lines: &str, resolution: &str, pixels: &[[u8; 4]]) -> Vec<u8> {
    let mut file = format!("#?RADIANCE\n{lines}\n{resolution}\n").into_bytes();
    pixels.iter().for_each(|pixel| file.extend(pixel));
    file
}

#[test]
fn pixels_of_radiance_are_put_upright_from_every_order() {
    let folder = tempfile::tempdir().unwrap();
    let (width, height) = (4_usize, 2_usize);
    // The brightness of a pixel is its number in rows from the top, times a power of 2.
    let pixel = |x: usize, y: usize| [10 * (1 + y * width + x) as u8, 0, 0, 136];
    let expected: Vec<[f32; 3]> = (0..8).map(|k| [10.0 * (1 + k) as f32, 0.0, 0.0]).collect();
    for from_right in [false, true] {
        for from_bottom in [false, true] {
            let at_x = |x| if from_right { width - 1 - x } else { x };
            let at_y = |y| if from_bottom { height - 1 - y } else { y };
            let signs = [if from_bottom { "+Y" } else { "-Y" }, if from_right { "-X" } else { "+X" }];
            let rows: Vec<_> = (0..8).map(|k| pixel(at_x(k % width), at_y(k / width))).collect();
            let columns: Vec<_> = (0..8).map(|k| pixel(at_x(k / height), at_y(k % height))).collect();
            for (order, pixels) in [
                (format!("{} 2 {} 4", signs[0], signs[1]), rows),
                (format!("{} 4 {} 2", signs[1], signs[0]), columns),
            ] {
                let path = at(&folder, &hdr_of("FORMAT=32-bit_rle_rgbe\n", &order, &pixels));
                let reading = read(&path).unwrap();
                assert_eq!(reading.panorama.pixels, expected, "{order}");
                assert_eq!((reading.panorama.width, reading.warnings.len()), (4, 0), "{order}");
            }
        }
    }
}

#[test]
fn colours_and_factors_of_radiance_are_those_that_its_header_states() {
    let folder = tempfile::tempdir().unwrap();
    let grey = [[128, 128, 128, 129]; 2];
    let first = |lines: &str| {
        let reading = read(&at(&folder, &hdr_of(lines, "-Y 1 +X 2", &grey))).unwrap();
        (reading.panorama.pixels[0], reading.warnings.join("; "))
    };
    // No line of the header is needed.
    assert_eq!(first(""), ([1.0; 3], String::new()));
    assert_eq!(first("EXPOSURE=1\n").1, "");
    let (light, warning) = first("EXPOSURE=2\nEXPOSURE=2\nCOLORCORR=1 0.5 1\n");
    assert_eq!(light, [0.25, 0.5, 0.25]);
    assert!(warning.contains("were multiplied by 4, 2 and 4; this is undone"), "{warning}");
    // X = Y = Z is a little red beside the white of sRGB, and of luminance Y.
    let ([r, g, b], warning) = first("FORMAT=32-bit_rle_xyze\n");
    assert!((0.2126 * r + 0.7152 * g + 0.0722 * b - 1.0).abs() < 1e-4, "{r} {g} {b}");
    assert!(
        (r - 1.2048).abs() < 1e-3 && (b - 0.9088).abs() < 1e-3 && warning.is_empty(),
        "{r} {b} {warning}"
    );
    assert!(first("PRIMARIES=0.64 0.33 0.29 0.6 0.15 0.06 0.333 0.333\n").1.is_empty());
    assert!(first("GAMMA=1\nPRIMARIES=0 0 0 0 0 0 0 0\n").1.is_empty());
    assert!(first("PRIMARIES=0.708 0.292 0.17 0.797 0.131 0.046 0.3127 0.329\n").1.contains("primaries"));
}

#[test]
fn an_exr_with_sparse_channels_is_refused_by_the_name_of_the_first() {
    let folder = tempfile::tempdir().unwrap();
    for (width, sparse, named) in [
        (64, &b"B"[..], "channel 'B' has one sample for 2 by 2 pixels: such"),
        (64, b"BR", "channel 'B' has one sample for 2 by 2 pixels, and 1 more channel has too few:"),
        // The decoder takes such a picture for a damaged one.
        (63, b"A", "channel 'A' has one sample for 2 by 2 pixels: such"),
    ] {
        let mut file = exr_file(&folder, width, 32);
        for name in sparse {
            // A channel's name and its type f32, then four bytes before both steps between samples.
            let entry = [*name, 0, 2, 0, 0, 0];
            let found = file.windows(entry.len()).position(|part| part == entry).unwrap() + entry.len() + 4;
            [found, found + 4].into_iter().for_each(|place| file[place] = 2);
        }
        let told = read(&at(&folder, &file)).unwrap_err().to_string();
        assert!(
            told.contains(named) && told.contains("; save it as RGB, with all channels of full size"),
            "{told}"
        );
    }
}

#[test]
fn what_a_decoder_gives_up_on_is_told_in_plain_words() {
    let folder = tempfile::tempdir().unwrap();
    let spoilt = |mut file: Vec<u8>, at: usize| {
        (at..at + 8).for_each(|k| file[k] = !file[k]);
        file
    };
    let half = |file: Vec<u8>| file[..file.len() / 2].to_vec();
    let (png, exr, jpeg) = (png_file(&folder, 64, 32), exr_file(&folder, 64, 32), jpeg_file(64, 32));
    let hdr = hdr_file("#?RADIANCE", 64, 32);
    let middle = png.len() / 2;
    for (file, reasons) in [
        (half(png.clone()), ["it ends too soon", "PNG data are damaged"]),
        (spoilt(png, middle), ["PNG data are damaged", "data are damaged"]),
        (half(exr), ["it ends too soon", "OpenEXR data are damaged"]),
        (half(hdr), ["it ends too soon", "data are damaged"]),
        (jpeg[..100].to_vec(), ["JPEG data are damaged", "it ends too soon"]),
    ] {
        let told = read(&at(&folder, &file)).unwrap_err().to_string();
        let is_known = reasons.iter().any(|reason| told.contains(reason));
        assert!(is_known && told.contains("this picture cannot be read: "), "{told}");
        assert!(
            told.ends_with("; get the file again, or save it again as OpenEXR, Radiance HDR, PNG or JPEG"),
            "{told}"
        );
    }
}
