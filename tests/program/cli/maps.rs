//! The files that `refraction-map` writes.

use super::desk::*;
use crate::maps::read;
use brillianteer::io::refraction::{Coding, diffuse_path, paths};
use brillianteer::picture::SourcePlace;
use glam::DVec3;
use std::path::Path;

#[test]
fn a_refraction_map_comes_in_every_coding_with_its_diffuse_layer_a_page_and_a_preview() {
    let desk = Desk::new();
    desk.done("render cube.toml --background #c08040 --size 40 --samples 1 --wavelengths 2 --out photo.png");
    let line =
        "refraction-map cube.toml --size 48x32 --samples 1 --wavelengths 2 --tilt 20 --background photo.png";
    let printed = desk.done(&format!("{line} --out maps --format tiled,png16,exr,page,preview"));
    let endings = [".png", "-16bit.png", ".exr", "-diffuse.png", ".html", "-preview.png"];
    let expected = endings.map(|ending| format!("maps/cube-photo-tilt-20-refraction{ending}"));
    assert_eq!(printed.lines().collect::<Vec<_>>(), expected);
    assert_eq!(files(&desk.at("maps")).len(), 6, "nothing else is left");
    let maps = [Coding::Tiles, Coding::Sixteen, Coding::Float].map(|coding| {
        let folder = desk.at("maps");
        read(&paths(&folder, "cube-photo-tilt-20", 1, coding), &diffuse_path(&folder, "cube-photo-tilt-20"))
    });
    for k in 0..48 * 32 {
        let [tiles, sixteen, float] = maps.each_ref().map(|map| map.bands[0].places[k]);
        if float.weight > 0.0 {
            near(tiles.u.into(), float.u.into(), 1.0 / 4096.0, "tiles");
            near(tiles.v.into(), float.v.into(), 1.0 / 4096.0, "tiles");
            near(sixteen.u.into(), float.u.into(), 1e-5, "16 bits");
        }
    }
    let (size, _, description) = png(&desk.at("maps/cube-photo-tilt-20-refraction-preview.png"));
    assert_eq!(size, (48, 32));
    assert!(
        description
            .contains("refraction map, bands 1, places 1; background 3 girdle radii behind, 2 times as wide"),
        "{description}"
    );
    assert!(description.contains("% of the light comes from the background"), "{description}");
    let page = desk.read("maps/cube-photo-tilt-20-refraction.html");
    assert!(page.contains("<h1>Cube</h1>") && page.contains("data:image/png;base64,"));
    let printed = desk
        .done("refraction-map cube.toml --size 32 --samples 1 --wavelengths 2 --background dots --out dots");
    assert_eq!(printed.lines().count(), 4, "{printed}");
    assert!(
        desk.read("dots/cube-dots-refraction.html")
            .contains("\"background\":{\"name\":\"Dots\",\"picture\":\"data:image/")
    );
    // Each of several bands has its own map; without a photograph there is no preview.
    let printed =
        desk.done("refraction-map cube.toml --size 32 --samples 1 --wavelengths 2 --bands 3 --out three");
    let names = ["-01.png", "-02.png", "-03.png", "-diffuse.png", ".html"];
    assert_eq!(printed.lines().collect::<Vec<_>>(), names.map(|n| format!("three/cube-refraction{n}")));
    let three = paths(&desk.at("three"), "cube", 3, Coding::Tiles);
    let map = read(&three, &diffuse_path(&desk.at("three"), "cube"));
    assert!(map.bands.len() == 3 && map.bands[0].nm < map.bands[2].nm);
    // Each of several places has its own map as well, the stronger place first.
    desk.done(
        "refraction-map cube.toml --size 32 --samples 1 --wavelengths 2 --bands 2 --places 2 --tilt 25 --perspective 5 --out four",
    );
    let stem = "cube-tilt-25-perspective-5";
    let four = paths(&desk.at("four"), stem, 4, Coding::Tiles);
    let map = read(&four, &diffuse_path(&desk.at("four"), stem));
    assert!(map.bands[0].nm == map.bands[1].nm && map.bands[1].nm < map.bands[2].nm);
    let weight = |band: usize| map.bands[band].places.iter().map(|place| place.weight).sum::<f32>();
    assert!(weight(1) > 0.0 && weight(0) > weight(1), "{} {}", weight(0), weight(1));
}

#[test]
fn a_refraction_map_is_the_same_bytes_on_any_number_of_threads() {
    let desk = Desk::new();
    for threads in ["1", "2"] {
        let line = format!(
            "refraction-map tolkowsky --size 40 --samples 2 --wavelengths 2 --format tiled,exr --out {threads}"
        );
        let run = desk.command(&line).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert_eq!(outcome(&line, &run).0, 0);
    }
    assert!(files(&desk.at("1")) == files(&desk.at("2")));
}

#[test]
fn what_a_refraction_map_cannot_be_is_told() {
    let desk = Desk::new();
    for (options, expected) in [
        ("--format preview", "--background"),
        ("--size 5000", "4096"),
        ("--background light", "photograph"),
        ("--background #ff0000", "a pattern or a photograph"),
        ("--span 0.5", "--span"),
        ("--bands 17", "17"),
        ("--bands 8 --places 3", "these are 24 maps"),
        ("--places 9", "9"),
    ] {
        let stderr = desk.refused(&format!("refraction-map cube.toml --out none {options}"), 2);
        assert!(stderr.contains(expected), "{options}: {stderr}");
    }
    std::fs::create_dir(desk.at("a")).unwrap();
    std::fs::copy(desk.at("cube.toml"), desk.at("a/cube.toml")).unwrap();
    let twins = desk.refused("refraction-map cube.toml a/cube.toml --out none", 2);
    assert!(twins.contains("cube.toml and a/cube.toml"), "{twins}");
    assert!(desk.refused("render cube.toml a/cube.toml --out none", 2).contains("a/cube.toml"));
    assert!(desk.refused("refraction-map none.toml --out none", 1).contains("none.toml"));
    assert!(!desk.at("none").exists());
}

#[test]
fn a_scenes_mixture_is_left_aside_and_that_is_told() {
    let desk = Desk::new();
    let line = "refraction-map wavy-plate --size 32 --samples 1 --wavelengths 2 --format tiled --out maps";
    let (code, _, stderr) = outcome(line, &desk.command(line).output().unwrap());
    assert!(code == 0 && stderr.contains("strength of 0.2 is ignored"), "{code}: {stderr}");
}

/// Returns the numbers of a template in 16 bits, 0 to 1, as a renderer reads them that is told that they are no colours.
fn codes(path: &Path) -> (usize, Vec<f32>) {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut data).unwrap();
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Sixteen));
    let code = |pair: &[u8]| f32::from(u16::from_be_bytes([pair[0], pair[1]])) / 65_535.0;
    (info.width as usize, data.chunks_exact(2).map(code).collect())
}

/// Returns the peak signal to noise of one picture in linear light against another, in dB.
fn psnr(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    let error: f64 = a.iter().zip(b).map(|(a, b)| a.distance_squared(*b) / 3.0).sum();
    10.0 * (a.len() as f64 / error).log10()
}

#[test]
fn a_template_is_written_as_png_alone() {
    let desk = Desk::new();
    for name in ["template.jpg", "template", "-"] {
        let stderr = desk.refused(&format!("refraction-template {name}"), 2);
        assert!(stderr.contains(&format!("{name}: give the name of a PNG file")), "{stderr}");
    }
    assert!(!desk.at("template.jpg").exists());
}

#[test]
fn a_map_read_from_a_render_of_the_template_is_the_programs_own_map() {
    let desk = Desk::new();
    // A glass without dispersion, in the dark, so that all light comes from the template.
    let dark = "name = \"dark\"\n[[lamp]]\nazimuth = 0\nelevation = 90\nradius = 0.01\nradiance = 1e-9\n";
    desk.write("dark.toml", dark);
    desk.done(
        "render cube.toml --background #c08040-#204080 --size 96 --samples 4 --wavelengths 4 --out photo.png",
    );
    desk.done("refraction-template template.png --coding gradient --size 1024");
    // The template hangs behind the glass as linear light: what other programs call Non-Color.
    let (side, numbers) = codes(&desk.at("template.png"));
    exr::prelude::write_rgb_file(desk.at("template.exr"), side, side, |x, y| {
        let at = 3 * (y * side + x);
        (numbers[at], numbers[at + 1], numbers[at + 2])
    })
    .unwrap();
    let view = "pill --material 1.5 --light dark.toml --size 80 --tilt 12 --perspective 6";
    desk.done(&format!(
        "render {view} --background template.exr --samples 64 --wavelengths 1 --no-jitter --glow 0 --unadapted \
        --tracer ray --out render.exr"
    ));
    let to = "--span 1 --background photo.png --format exr,preview --out";
    desk.done(&format!("refraction-import render.exr --coding gradient {to} foreign"));
    desk.done(&format!("refraction-map {view} --samples 1 --wavelengths 1 {to} own"));
    let (own, foreign) = (
        ("own", "pill-span-1-dark-photo-material-1.5-tilt-12-perspective-6"),
        ("foreign", "render-photo-span-1"),
    );
    let places = |(folder, stem): (&str, &str)| {
        let folder = desk.at(folder);
        let map = read(&paths(&folder, stem, 1, Coding::Float), &diffuse_path(&folder, stem));
        assert_eq!(map.size, [80, 80]);
        map.bands[0].places.clone()
    };
    let apart = |own: &[SourcePlace], foreign: &[SourcePlace]| {
        let pairs = own.iter().zip(foreign).filter(|(own, _)| own.weight > 0.5);
        let far = |(a, b): (&SourcePlace, &SourcePlace)| 80.0 * f64::from((a.u - b.u).hypot(a.v - b.v));
        let mut all: Vec<f64> = pairs.map(far).collect();
        all.sort_by(f64::total_cmp);
        let at = |part: f64| all[((all.len() - 1) as f64 * part) as usize];
        println!("{} places, {:.4}, {:.4}, {:.4} pixels apart", all.len(), at(0.5), at(0.9), at(0.99));
        (all.len(), at(0.5), at(0.9))
    };
    let preview =
        |(folder, stem): (&str, &str)| png(&desk.at(format!("{folder}/{stem}-refraction-preview.png"))).1;
    let (mine, theirs) = (places(own), places(foreign));
    let (count, median, most) = apart(&mine, &theirs);
    let same = psnr(&preview(own), &preview(foreign));
    let mirrored: Vec<SourcePlace> = mine.chunks(80).flat_map(|row| row.iter().rev().copied()).collect();
    let (_, other, _) = apart(&mirrored, &theirs);
    println!("{same:.1} dB");
    assert!(count > 5000 && median < 0.01 && most < 0.2 && same > 40.0);
    assert!(other > 20.0, "a mirrored map would be seen");
}
