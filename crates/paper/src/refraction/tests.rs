#[path = "../../../../tests/common/maps.rs"]
mod maps;

use super::*;
use glam::{DMat3, DVec2};

/// Makes a map of all sorts of places, 61 by 37 pixels.
fn map(bands: usize) -> RefractionMap {
    let [width, height] = [61_u32, 37];
    let place = |k: u32, band: usize| {
        let k = f64::from(k) + 0.37 * band as f64;
        let part = |step: f64| (k * step).fract() as f32;
        // Borders, and pixels through which nothing behind is seen.
        let edge = [0.0, 1.0, part(0.618_034), part(0.754_877)];
        let weight = if k as u32 % 7 == 3 { 0.0 } else { part(0.569_840) };
        SourcePlace { u: edge[k as usize % 4], v: edge[(k as usize / 4) % 4], weight }
    };
    let band = |band: usize| MapBand {
        nm: 400.0 + 60.0 * band as f64,
        response: DMat3::from_diagonal(glam::DVec3::splat(1.0 / bands as f64)),
        places: (0..width * height).map(|k| place(k, band)).collect(),
    };
    let light = |k: u32| {
        let part = |step: f32| (k as f32 * step).fract();
        [part(0.31), part(0.17), part(0.53), 1.0 - place(k, 0).weight]
    };
    let pixels = (0..width * height).map(light).collect();
    RefractionMap {
        size: [width, height],
        bands: (0..bands).map(band).collect(),
        diffuse: Linear { width, height, pixels },
    }
}

/// Writes a map, and reads it back.
fn again(map: &RefractionMap, coding: Coding) -> RefractionMap {
    let folder = tempfile::tempdir().unwrap();
    let paths = paths(folder.path(), "a", map.bands.len(), coding);
    let diffuse = diffuse_path(folder.path(), "a");
    write_places(&paths, map, coding, "a test").unwrap();
    write_diffuse(&diffuse, map, "a test").unwrap();
    maps::read(&paths, &diffuse)
}

/// Returns the largest differences of places, and of weights, between two maps, where light comes from the background.
fn apart(a: &RefractionMap, b: &RefractionMap) -> (f64, f64) {
    let both = a.bands.iter().zip(&b.bands).flat_map(|(a, b)| a.places.iter().zip(&b.places));
    both.filter(|(a, _)| a.weight > 0.0).fold((0.0, 0.0), |(place, weight), (a, b)| {
        let off = |a: f32, b: f32| f64::from((a - b).abs());
        (off(a.u, b.u).max(off(a.v, b.v)).max(place), off(a.weight, b.weight).max(weight))
    })
}

#[test]
fn every_code_of_the_tiles_is_a_place_and_the_nearest_one_to_itself() {
    for blue in 0..=255 {
        for fine in 0..=255 {
            let code = [fine, 255 - fine, blue];
            let at = maps::place(code);
            // The formula as it is printed, in numbers of 0 to 1, but with blue of 1 kept in the last column.
            let [r, g, b] = code.map(|byte| f64::from(byte) / 255.0);
            let column = (16.0 * b).floor().min(15.0);
            let printed =
                DVec2::new(16.0 * r + 16.0 * column, 16.0 * g + 16.0 * (255.0 * b).round().rem_euclid(16.0));
            assert!(at.abs_diff_eq(printed / 255.0, 1e-12), "{code:?}");
            assert!(at.min_element() >= 0.0 && at.max_element() <= 256.0 / 255.0 + 1e-12);
            if at.max_element() <= 1.0 {
                assert!(maps::place(tiles::code(at)).abs_diff_eq(at, 1e-12), "{code:?}");
            }
        }
    }
}

#[test]
fn tiles_keep_a_place_within_a_4096th() {
    let mut worst = 0.0_f64;
    for k in 0..=200_000 {
        let u = f64::from(k) / 200_000.0;
        let at = DVec2::new(u, (u * 77.0).fract());
        worst = (maps::place(tiles::code(at)) - at).abs().max_element().max(worst);
    }
    assert!(worst > 1.0 / 8200.0 && worst <= 1.0 / 8128.0 + 1e-12, "{worst}");
    for (odd, kept) in [(f64::NAN, 0.0), (-1.0, 0.0), (7.0, 1.0), (f64::INFINITY, 1.0)] {
        assert!((maps::place(tiles::code(DVec2::splat(odd))) - kept).abs().max_element() < 1.0 / 8128.0);
    }
}

#[test]
fn a_map_comes_back_from_every_coding() {
    for bands in [1, 3] {
        let map = map(bands);
        for (coding, place, weight) in [
            (Coding::Tiles, 1.0 / 4096.0, 2.0),
            (Coding::Sixteen, 0.5001 / 65_535.0, 0.5001 / 65_535.0),
            (Coding::Float, 0.0, 0.0),
        ] {
            let found = again(&map, coding);
            let weight = if coding == Coding::Tiles && bands > 1 { 0.5001 / 255.0 } else { weight };
            let (places, weights) = apart(&map, &found);
            assert!(places <= place && weights <= weight, "{coding:?}: {places}, {weights}");
            assert_eq!((found.size, found.bands.len()), (map.size, bands));
            for (a, b) in found.bands.iter().zip(&map.bands) {
                assert!(a.nm == b.nm && a.response == b.response, "{coding:?}");
            }
        }
    }
}

#[test]
fn the_diffuse_layer_keeps_its_light_and_what_it_hides() {
    let map = map(1);
    let found = again(&map, Coding::Tiles);
    for (k, (a, b)) in map.diffuse.pixels.iter().zip(&found.diffuse.pixels).enumerate() {
        let most = a[..3].iter().copied().fold(a[3], f32::max);
        assert!((b[3] - most).abs() <= 1.001 / 255.0, "{k}: cover {}, not {most}", b[3]);
        for c in 0..3 {
            // A code of sRGB is 0.9 % of the light at the brightest.
            assert!((a[c] - b[c]).abs() < 0.006, "{k}: {} is not {}", b[c], a[c]);
        }
        // Tiles without their own weights take the share that the layer leaves.
        assert_eq!(found.bands[0].places[k].weight, 1.0 - b[3]);
    }
}

#[test]
fn maps_that_lack_pixels_are_not_written() {
    let folder = tempfile::tempdir().unwrap();
    for broken in [
        RefractionMap { size: [60, 37], ..map(1) },
        RefractionMap { size: [0, 0], bands: map(1).bands, diffuse: Linear::new(0, 0) },
    ] {
        for coding in [Coding::Tiles, Coding::Sixteen, Coding::Float] {
            assert!(write_places(&paths(folder.path(), "a", 1, coding), &broken, coding, "").is_err());
        }
    }
    assert!(
        write_diffuse(&folder.path().join("a"), &RefractionMap { diffuse: Linear::new(0, 4), ..map(1) }, "")
            .is_err()
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn files_that_are_not_all_of_one_map_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let text = |pictures: &[PathBuf]| read(pictures, None, None).map(|_| ()).unwrap_err().to_string();
    for coding in [Coding::Tiles, Coding::Sixteen] {
        let [one, other, three] = [("a", 1), ("b", 1), ("c", 3)].map(|(stem, bands)| {
            let paths = paths(folder.path(), stem, bands, coding);
            write_places(&paths, &map(bands), coding, "a test").unwrap();
            paths
        });
        assert_eq!(read(&three, None, None).unwrap().map.size, [61, 37]);
        assert_eq!(read(&one, None, None).unwrap().map.size, [61, 37]);
        assert!(text(&three[..1]).contains("one of 3 files of a map, and 1 are given"));
        assert!(text(&three[..2]).contains("one of 3 files of a map, and 2 are given"));
        let both = [one[0].clone(), other[0].clone()];
        assert!(text(&both).contains("one of 1 files of a map, and 2 are given"));
    }
    // Too many files are refused before any is read.
    let missing = vec![folder.path().join("missing.png"); 17];
    assert!(text(&missing).contains("17 files: a map has 16 at most"), "{}", text(&missing));
}
