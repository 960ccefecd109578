//! Checks maps that another renderer makes of the template. The other renderer is the program's own tracer: it says which
//! place a pixel shows, and the pixel takes the template's colour there.
#![cfg(feature = "exr")]

use super::refraction::{Shoot, brilliant, diamond, photo, psnr};
use crate::common::maps;
use brillianteer::io::refraction::{self as files, LoadedMap, Template};
use brillianteer::optics::encoded_from_linear;
use brillianteer::picture::{Linear, RefractionMap, SourcePlace, refract};
use glam::{DMat3, DVec2, DVec3};
use std::path::{Path, PathBuf};

/// The side of the templates of these tests.
const SIDE: u32 = 4096;

/// The error of a place by the nearest pixel of a template and the coding in tiles.
const STEP: f64 = 0.5 / SIDE as f64 + 1.0 / 8128.0 + 1e-6;

/// The numbers of a PNG, by channels and with the most that one can be.
struct Raw {
    width: usize,
    channels: usize,
    values: Vec<f64>,
}

fn raw(path: &Path) -> Raw {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut data).unwrap();
    let values = match info.bit_depth {
        png::BitDepth::Sixteen => {
            data.chunks_exact(2).map(|c| f64::from(u16::from_be_bytes([c[0], c[1]])) / 65_535.0).collect()
        }
        _ => data.iter().map(|&c| f64::from(c) / 255.0).collect(),
    };
    Raw { width: info.width as usize, channels: info.color_type.samples(), values }
}

/// Returns a template of the program, as another renderer reads it.
fn template(kind: Template) -> Raw {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("template.png");
    files::write_template(&path, kind, SIDE).unwrap();
    let found = raw(&path);
    assert!(found.width == SIDE as usize && found.channels == 3);
    found
}

/// Renders a map: the nearest colour of the template at each place, times the weight where light is lost.
fn rendered(map: &RefractionMap, template: &Raw, loses_light: bool) -> Vec<[f64; 3]> {
    let colour = |place: &SourcePlace| {
        let column = |part: f32| ((f64::from(part) * f64::from(SIDE)) as usize).min(SIDE as usize - 1);
        let at = 3 * (column(place.v) * template.width + column(place.u));
        let share = match () {
            () if place.weight <= 0.0 => 0.0,
            () if loses_light => f64::from(place.weight),
            () => 1.0,
        };
        [0, 1, 2].map(|c| template.values[at + c] * share)
    };
    map.bands[0].places.iter().map(colour).collect()
}

/// Writes colours as a PNG of 8 or 16 bits without texts, with alpha where there is some.
fn write(path: &Path, size: [u32; 2], colours: &[[f64; 3]], alpha: Option<&[f64]>, bits: u32) {
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let mut encoder = png::Encoder::new(file, size[0], size[1]);
    encoder.set_color(if alpha.is_some() { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(if bits == 8 { png::BitDepth::Eight } else { png::BitDepth::Sixteen });
    let parts = colours.iter().enumerate().flat_map(|(k, c)| c.iter().copied().chain(alpha.map(|a| a[k])));
    let data: Vec<u8> = match bits {
        8 => parts.map(|part| (part * 255.0).round() as u8).collect(),
        _ => parts.flat_map(|part| ((part * 65_535.0).round() as u16).to_be_bytes()).collect(),
    };
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
}

/// Writes a foreign picture and reads it.
fn loaded(size: [u32; 2], colours: &[[f64; 3]], bits: u32) -> Result<LoadedMap, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("foreign.png");
    write(&path, size, colours, None, bits);
    files::read(&[path], None, None).map_err(|e| e.to_string())
}

/// Returns why a foreign picture is refused.
fn refused(size: [u32; 2], colours: &[[f64; 3]], bits: u32) -> String {
    match loaded(size, colours, bits) {
        Err(error) => error,
        Ok(found) => panic!("it is read, with {:?} and {:?}", found.warnings, found.notes),
    }
}

fn shoot(size: [u32; 2]) -> Shoot {
    Shoot { size, both_sides: true, ..Shoot::of(brilliant(), diamond()) }
}

/// Returns the largest distance between places that both maps have, and the part of them farther apart than `bound`.
fn apart(a: &RefractionMap, b: &RefractionMap, bound: f64) -> (f64, f64) {
    assert_eq!(a.size, b.size);
    let (mut worst, mut beyond, mut count) = (0.0_f64, 0, 0);
    for (a, b) in a.bands[0].places.iter().zip(&b.bands[0].places) {
        if a.weight > 0.0 && b.weight > 0.0 {
            let far = f64::from((a.u - b.u).abs().max((a.v - b.v).abs()));
            worst = worst.max(far);
            beyond += usize::from(far > bound);
            count += 1;
        }
    }
    assert!(count > a.bands[0].places.len() / 3, "{count} places are compared");
    (worst, beyond as f64 / count as f64)
}

#[test]
fn the_template_through_another_renderer_is_the_programs_own_map() {
    let (map, _) = shoot([160, 120]).map();
    for kind in [Template::Tiles, Template::Gradient] {
        let template = template(kind);
        let is_gradient = kind == Template::Gradient;
        let colours = rendered(&map, &template, is_gradient);
        let found = loaded(map.size, &colours, if is_gradient { 16 } else { 8 }).unwrap();
        assert_eq!((&found.warnings, &found.notes), (&vec![], &vec![]), "{kind:?}");
        let bound = STEP + if is_gradient { 1e-2 } else { 0.0 };
        let (worst, _) = apart(&map, &found.map, bound);
        assert!(worst <= bound, "{kind:?}: {worst}");
        for (own, found) in map.bands[0].places.iter().zip(&found.map.bands[0].places) {
            if is_gradient && own.weight > 0.25 {
                let far = (own.u - found.u).abs().max((own.v - found.v).abs());
                // Red and blue are rounded by half a code each, which counts the more the darker the pixel is.
                let rounding = 1.1 / (65_535.0 * f64::from(own.weight));
                assert!(f64::from(far) <= 0.5 / f64::from(SIDE) + rounding, "weight {}: {far}", own.weight);
            }
            let weight = if is_gradient { own.weight } else { f32::from(u8::from(own.weight > 0.0)) };
            // The gradient loses places that are nearly dark.
            assert!((weight - found.weight).abs() < if is_gradient { 3e-3 } else { 1e-6 });
        }
        // The comparison sees a template that is turned.
        let turned: Vec<[f64; 3]> = match is_gradient {
            true => colours.iter().map(|&[u, v, w]| [v, u, w]).collect(),
            false => colours
                .iter()
                .map(|&[r, g, b]| {
                    let b = (b * 255.0).round() as u8;
                    [g, r, f64::from(b.rotate_left(4)) / 255.0]
                })
                .collect(),
        };
        let turned = loaded(map.size, &turned, if is_gradient { 16 } else { 8 }).unwrap();
        assert!(apart(&map, &turned.map, bound).1 > 0.5, "{kind:?}");
    }
}

#[test]
fn a_foreign_map_refracts_a_photograph_as_the_own_map_does() {
    let (map, _) = shoot([160, 120]).map();
    let photo = photo();
    let found = loaded(map.size, &rendered(&map, &template(Template::Gradient), true), 16).unwrap();
    // The foreign map has no diffuse layer.
    let own = RefractionMap { diffuse: Linear::new(160, 120), ..map.clone() };
    let pictures = [&own, &found.map].map(|map| refract(map, &photo, DVec2::ZERO));
    let same = psnr(&pictures[0], &pictures[1]);
    let mut mirrored = own;
    mirrored.bands[0].places.iter_mut().for_each(|place| place.u = 1.0 - place.u);
    let other = psnr(&pictures[0], &refract(&mirrored, &photo, DVec2::ZERO));
    assert!(same >= 40.0 && other < 30.0, "{same} and {other} dB");
}

/// Returns the picture of four by four samples in each pixel.
fn antialiased(fine: &[[f64; 3]], [width, height]: [usize; 2]) -> Vec<[f64; 3]> {
    let pixel = |k: usize| {
        let (x, y) = (k % width, k / width);
        let sample = |s: usize| DVec3::from(fine[(4 * y + s / 4) * 4 * width + 4 * x + s % 4]);
        ((0..16).map(sample).sum::<DVec3>() / 16.0).to_array()
    };
    (0..width * height).map(pixel).collect()
}

#[test]
fn borders_of_tiles_that_antialiasing_damaged_are_mended_and_counted() {
    let glass = super::refraction::glass(1.5);
    let cube = super::refraction::boxed(DVec3::splat(-0.6), DVec3::splat(0.6));
    let view = brillianteer::scene::View { tilt: 0.5, azimuth: 0.6, ..Default::default() };
    let of = |size| Shoot { size, view, ..Shoot::of(cube.clone(), glass.clone()) }.map().0;
    // The middle of four by four samples is not a sample; the place there is, but for the pixels on edges.
    let (map, fine) = (of([192, 144]), of([768, 576]));
    let template = template(Template::Tiles);
    let damaged = antialiased(&rendered(&fine, &template, false), [192, 144]);
    let found = loaded(map.size, &damaged, 8).unwrap();
    let [warning] = &found.warnings[..] else { panic!("{:?}", found.warnings) };
    assert!(warning.contains("antialiased"), "{warning}");
    let at = |place: &SourcePlace| DVec2::new(place.u.into(), place.v.into());
    let own = |k: usize| at(&map.bands[0].places[k]);
    // On edges a mixture of two places has no right one; within a surface it has.
    let is_within = |&k: &usize| {
        let (x, y) = (k % 192, k / 192);
        (1..191).contains(&x)
            && (1..143).contains(&y)
            && [k, k - 1, k + 1, k - 192, k + 192]
                .iter()
                .all(|&j| map.bands[0].places[j].weight > 0.0 && (own(j) - own(k)).abs().max_element() < 0.03)
    };
    let within: Vec<usize> = (0..192 * 144).filter(is_within).collect();
    let bound = 8.0 / 4064.0;
    let off = |found: &dyn Fn(usize) -> DVec2| {
        within.iter().filter(|&&k| (found(k) - own(k)).abs().max_element() > bound).count() as f64
            / within.len() as f64
    };
    let before = off(&|k| maps::place(damaged[k].map(|c| (c * 255.0).round() as u8)));
    let after = off(&|k| at(&found.map.bands[0].places[k]));
    println!(
        "{:.2} % of the places are damaged, {:.2} % after mending: {warning}",
        100.0 * before,
        100.0 * after
    );
    assert!(within.len() > 9000 && before > 0.05 && after < 0.4 * before, "{before}, {after}");
    // A map that is not antialiased is left as it is, even one full of small facets.
    let (map, _) = shoot([160, 120]).map();
    let colours = rendered(&map, &template, false);
    let found = loaded(map.size, &colours, 8).unwrap();
    for (colour, place) in colours.iter().zip(&found.map.bands[0].places) {
        let at = maps::place(colour.map(|c| (c * 255.0).round() as u8)).as_vec2();
        assert!(place.weight == 0.0 || (place.u - at.x).abs().max((place.v - at.y).abs()) < 1e-6);
    }
}

#[test]
fn what_is_empty_counts_for_nothing_whether_by_alpha_or_by_colour() {
    let (map, _) = shoot([160, 120]).map();
    let mut colours = rendered(&map, &template(Template::Tiles), false);
    // The lower third shows nothing of the template.
    let empty = |k: usize| k / 160 >= 80;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let alpha: Vec<f64> = (0..colours.len()).map(|k| f64::from(u8::from(!empty(k)))).collect();
    write(&path, map.size, &colours, Some(&alpha), 8);
    let by_alpha = files::read(std::slice::from_ref(&path), None, None).unwrap();
    for (k, colour) in colours.iter_mut().enumerate() {
        *colour = if empty(k) { [0.25, 0.5, 0.125] } else { *colour };
    }
    let by_colour = loaded(map.size, &colours, 8).unwrap();
    assert!(
        by_alpha.notes.is_empty() && by_colour.notes[0].contains("6400 pixels have the one colour #408020")
    );
    for found in [by_alpha, by_colour] {
        for (k, place) in found.map.bands[0].places.iter().enumerate() {
            let is_seen = !empty(k) && map.bands[0].places[k].weight > 0.0;
            assert_eq!(place.weight, f32::from(u8::from(is_seen)), "{k}");
            assert_eq!(found.map.diffuse.pixels[k], [0.0, 0.0, 0.0, 1.0 - place.weight]);
        }
    }
}

#[test]
fn what_is_no_map_is_an_error_and_a_tone_curve_is_named() {
    let photo = photo();
    let size = [photo.width, photo.height];
    let colours: Vec<[f64; 3]> =
        photo.pixels.iter().map(|p| p.map(|c| encoded_from_linear(c.into()))).collect();
    for bits in [8, 16] {
        let error = refused(size, &colours, bits);
        assert!(error.contains("foreign.png: this is no map"), "{bits}: {error}");
    }
    let (map, _) = shoot([160, 120]).map();
    let curved = |kind, loses| -> Vec<[f64; 3]> {
        rendered(&map, &template(kind), loses).iter().map(|c| c.map(encoded_from_linear)).collect()
    };
    let error = refused(map.size, &curved(Template::Tiles, false), 8);
    assert!(error.contains("a tone curve has changed its numbers"), "{error}");
    let found = loaded(map.size, &curved(Template::Gradient, false), 16).unwrap();
    assert!(found.warnings.iter().any(|w| w.contains("a tone curve seems")), "{:?}", found.warnings);
    for (colour, word) in
        [([0.0; 3], "nothing of the template"), ([0.3, 0.2, 0.9], "nothing of the template")]
    {
        let error = loaded([64, 64], &[colour; 4096], 8).unwrap_err();
        assert!(error.contains(word), "{error}");
    }
}

#[test]
fn three_pictures_make_a_rainbow_and_a_diffuse_layer_shines_over_them() {
    let maps = [1, 2, 3].map(|_| shoot([96, 72]).map().0);
    let template = template(Template::Tiles);
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let paths: Vec<PathBuf> = ["r.png", "g.png", "b.png"].map(at).into();
    for (path, map) in paths.iter().zip(&maps) {
        write(path, map.size, &rendered(map, &template, false), None, 8);
    }
    let shine = at("shine.png");
    write(&shine, [96, 72], &[[1.0, 0.5, 0.25]; 96 * 72], Some(&[0.2; 96 * 72]), 8);
    let found = files::read(&paths, Some(&shine), None).unwrap().map;
    let sum: DMat3 = found.bands.iter().map(|band| band.response).fold(DMat3::ZERO, |a, b| a + b);
    assert_eq!((found.bands.len(), sum), (3, DMat3::IDENTITY));
    for (k, own) in maps[0].bands[0].places.iter().enumerate() {
        let [red, green, _, cover] = found.diffuse.pixels[k];
        let weight = if own.weight > 0.0 { 0.8 } else { 0.0 };
        assert!(
            (found.bands[1].places[k].weight - weight).abs() < 1e-6 && (cover + weight - 1.0).abs() < 1e-6
        );
        assert!((red - 0.2).abs() < 1e-6 && (green - 0.2 * 0.214).abs() < 1e-3);
    }
    let fault = |pictures: &[PathBuf], layer: Option<&Path>| {
        files::read(pictures, layer, None).unwrap_err().to_string()
    };
    assert!(fault(&paths[..2], None).contains("one picture, or three"));
    assert!(fault(&[], None).contains("give at least one"));
    assert!(fault(&paths[..1], Some(&paths[1])).contains("no alpha"));
    write(&shine, [95, 72], &[[1.0; 3]; 95 * 72], Some(&[0.2; 95 * 72]), 8);
    assert!(fault(&paths, Some(&shine)).contains("95 by 72 pixels, and the map 96 by 72"));
    assert!(fault(&[at("none.png")], None).contains("none.png: there is no such file"));
}

#[test]
fn no_bytes_make_the_reader_panic() {
    let (map, _) = shoot([40, 30]).map();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    write(&path, map.size, &rendered(&map, &template(Template::Tiles), false), None, 8);
    let foreign = std::fs::read(&path).unwrap();
    let mut whole = vec![foreign];
    for coding in [files::Coding::Tiles, files::Coding::Sixteen, files::Coding::Float] {
        let paths = files::paths(folder.path(), "own", 1, coding);
        files::write_places(&paths, &map, coding, "").unwrap();
        whole.push(std::fs::read(&paths[0]).unwrap());
    }
    files::write_diffuse(&path, &map, "").unwrap();
    whole.push(std::fs::read(&path).unwrap());
    let mut seed = 7_u32;
    let mut random = move || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as usize
    };
    let mut read = 0;
    for file in whole {
        for turn in 0..300 {
            let mut spoilt = file.clone();
            if turn % 3 == 0 {
                spoilt.truncate(random() % file.len());
            }
            for _ in 0..1 + random() % 4 {
                let at = random() % spoilt.len().max(1);
                if let Some(byte) = spoilt.get_mut(at) {
                    *byte = [0, 255, 128, 127, random() as u8][random() % 5];
                }
            }
            std::fs::write(&path, &spoilt).unwrap();
            for (pictures, layer) in [(1, None), (1, Some(path.as_path())), (3, None)] {
                if let Ok(found) = files::read(&vec![path.clone(); pictures], layer, None) {
                    read += 1;
                    let count = (found.map.size[0] * found.map.size[1]) as usize;
                    assert!(found.map.diffuse.pixels.len() == count);
                    for band in &found.map.bands {
                        assert_eq!(band.places.len(), count);
                        let is_part = |part: f32| (0.0..=1.0).contains(&part);
                        assert!(
                            band.places.iter().all(|p| is_part(p.u) && is_part(p.v) && is_part(p.weight))
                        );
                    }
                }
            }
        }
    }
    assert!(read > 0, "every file was refused, so the reader was not tried");
}

#[test]
fn the_programs_own_files_read_back_as_the_tests_read_them() {
    for bands in [1, 3] {
        let (map, _) = Shoot { bands, ..shoot([80, 60]) }.map();
        for coding in [files::Coding::Tiles, files::Coding::Sixteen, files::Coding::Float] {
            let folder = tempfile::tempdir().unwrap();
            let paths = files::paths(folder.path(), "a", bands as usize, coding);
            let diffuse = files::diffuse_path(folder.path(), "a");
            files::write_places(&paths, &map, coding, "").unwrap();
            files::write_diffuse(&diffuse, &map, "").unwrap();
            let found = files::read(&paths, Some(&diffuse), None).unwrap();
            assert!(found.map == maps::read(&paths, &diffuse), "{bands} bands, {coding:?}");
        }
    }
}
