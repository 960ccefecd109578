//! The pictures that `liquid-glass` writes.

use super::desk::*;
use brillianteer::optics::linear_from_encoded;
use glam::DVec3;

/// A desk with a photograph in its folder.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.done(
        "render cube.toml --background #c08040 --size 64x48 --samples 1 --wavelengths 2 --out photo.png",
    );
    desk
}

/// Returns the first number of the printed line that starts with a name.
fn figure(printed: &str, name: &str) -> f64 {
    let line = printed.lines().find(|line| line.starts_with(name)).unwrap();
    line.split_whitespace().find_map(|word| word.parse().ok()).unwrap()
}

#[test]
fn liquid_glass_comes_drawn_traced_and_side_by_side_with_what_the_drawing_costs() {
    let desk = desk();
    let line = "liquid-glass --background photo.png --size 64x48 --pane 40x30+8+6 --samples 2";
    assert_eq!(desk.done(&format!("{line} --out alone")), "alone/liquid-glass-photo-pane-40x30+8+6.png\n");
    // A path that ends in .png is the picture itself.
    assert_eq!(desk.done(&format!("{line} --out alone/pane.png")), "alone/pane.png\n");
    assert_eq!(
        std::fs::read(desk.at("alone/pane.png")).unwrap(),
        std::fs::read(desk.at("alone/liquid-glass-photo-pane-40x30+8+6.png")).unwrap()
    );
    let printed = desk.done(&format!("{line} --out all --compare --tint #3060ff40 --frost 50"));
    let names = ["", "-traced", "-both"]
        .map(|name| format!("all/liquid-glass-photo-pane-40x30+8+6-frost-50-tint-3060ff40{name}.png"));
    assert_eq!(printed.lines().take(3).collect::<Vec<_>>(), names);
    assert_eq!(files(&desk.at("all")).len(), 3, "nothing else is left");
    // As drawn, at most (0.015 + 0.008 + 0.012 0.7 + ...) of 30 pixels.
    let moved = figure(&printed, "drawn: background is shifted by");
    assert!(moved > 0.2 && moved < 1.5, "{printed}");
    assert!(figure(&printed, "traced: background is shifted by") > 0.0, "{printed}");
    assert!(figure(&printed, "mean difference in linear light") > 0.01, "{printed}");
    let (size, _, description) = png(&desk.at(&names[0]));
    assert_eq!(size, (64, 48));
    assert!(
        description.contains("quality high; pane 40x30+8+6, corners 9.0; refraction 100"),
        "{description}"
    );
    assert!(
        description.contains("frost 50, light 30 from 90.0,53.1; tint 0.030 0.117 1.000 0.251"),
        "{description}"
    );
    let (size, _, description) = png(&desk.at(&names[1]));
    assert_eq!(size, (64, 48));
    assert!(description.contains("traced by rays, gap 0.02, 12 wavelengths in 2 samples"), "{description}");
    assert_eq!(png(&desk.at(&names[2])).0, (129, 48));
    // The bytes are the same on any number of threads.
    for threads in ["1", "2"] {
        let line = format!("{line} --compare --frost 80 --out {threads}");
        let run = desk.command(&line).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert_eq!(outcome(&line, &run).0, 0);
    }
    assert!(files(&desk.at("1")) == files(&desk.at("2")));
}

#[test]
fn a_pane_without_strength_is_its_background() {
    let desk = desk();
    let off = "--refraction 0 --depth 0 --dispersion 0 --light 0";
    let made = |options: &str| {
        let printed = desk.done(&format!("liquid-glass --background #336699 --size 32 {options}"));
        png(&desk.at(printed.trim()))
    };
    let (size, pixels, _) = made(off);
    let own = DVec3::from([0x33, 0x66, 0x99].map(|code: u8| linear_from_encoded(f64::from(code) / 255.0)));
    assert_eq!((size, pixels.len()), ((32, 32), 32 * 32));
    assert!(pixels.iter().all(|p| *p == own));
    // A tint colours light alone, of which there is none.
    assert!(made(&format!("{off} --tint #00000080")).1 == pixels);
    let lit = off.replace("--light 0", "--light 50");
    let drawn = |more: &str| made(&format!("{lit} {more}")).1;
    let white = drawn("");
    assert!(white != pixels && drawn("--tint #00000080") != white);
    assert!(drawn("--tint #000000ff") == pixels && drawn("--quality low") == pixels);
    assert!(
        drawn("--light-from 270,30") != white && drawn("--light-from -90,30") == drawn("--light-from 270,30")
    );
}

#[test]
fn a_pane_alone_has_alpha_and_its_times_are_told() {
    let desk = desk();
    let line = "liquid-glass --background photo.png --size 64x48 --pane 40x30+8+6 --light 0";
    let printed = desk.done(&format!("{line} --alone --exr --timing"));
    let lines: Vec<&str> = printed.lines().collect();
    let stem = "out/liquid-glass-photo-pane-40x30+8+6-light-0";
    assert_eq!(lines[..2], [format!("{stem}-alone.png"), format!("{stem}-alone.exr")]);
    for name in
        ["shape, once", "dispersion", "frost", "frame, background moves", "high from medium", "high from low"]
    {
        assert!(lines.iter().any(|line| line.starts_with(name)), "{name}: {printed}");
    }
    let alone = std::fs::read(desk.at(lines[0])).unwrap();
    // The header's colour type is 6: red, green, blue and alpha.
    assert_eq!(alone[25], 6);
    desk.done(line);
    assert_eq!(std::fs::read(desk.at(format!("{stem}.png"))).unwrap()[25], 2);
}

#[test]
fn a_pane_lies_over_patterns_as_it_does_over_photographs() {
    let desk = desk();
    let mut seen = vec![];
    for name in ["page", "grid", "checks", "stripes", "dots", "slit", "sunset", "room", "city"] {
        desk.done(&format!("liquid-glass --background {name} --size 64x48 --out {name}"));
        let (size, pixels, _) = png(&desk.at(format!("{name}/liquid-glass-{name}.png")));
        assert_eq!(size, (64, 48));
        assert!(!seen.contains(&pixels), "{name} is another pattern's");
        seen.push(pixels);
    }
}

#[test]
fn what_liquid_glass_cannot_be_is_told() {
    let desk = desk();
    let line = "liquid-glass --size 64x48 --background";
    for (options, code, expected) in [
        ("photo.png --pane 70x20", 2, "within the picture of 64 by 48"),
        ("photo.png --pane 40x30+30+6", 2, "within the picture of 64 by 48"),
        ("photo.png --pane 4x30", 2, "8 pixels and more"),
        ("photo.png --pane 40", 2, "WIDTHxHEIGHT+X+Y"),
        ("photo.png --pane 40x30+8", 2, "WIDTHxHEIGHT+X+Y"),
        ("photo.png --pane 40x30 --radius 16", 2, "--radius 16: give 0 to 15"),
        ("photo.png --refraction 101", 2, "--refraction 101: give 0 to 100"),
        ("photo.png --depth NaN", 2, "--depth NaN: give 0 to 100"),
        ("photo.png --light-from 20", 2, "azimuth and height"),
        ("photo.png --light-from 20,91", 2, "the height is 0 to 90"),
        ("photo.png --tint #3060ff", 2, "#3060ff40"),
        ("photo.png --tint #é0é0é0", 2, "#3060ff40"),
        ("photo.png --quality best", 2, "high, medium or low"),
        ("photo.png --compare --gap 0", 2, "--gap 0: give 0.001 to 100"),
        ("photo.png --compare --gap -1", 2, "--gap -1: give 0.001 to 100"),
        ("photo.png --gap 0.5", 2, "--compare"),
        ("photo.png --out pane.jpg", 2, "give a .png, or a folder"),
        ("none.png", 1, "none.png: there is no such file"),
        ("mauve", 2, "or a photograph's file"),
        ("transparent", 2, "needs something behind it"),
        ("light", 2, "needs something behind it"),
        ("pages", 2, "page, grid, checks"),
        ("cube.toml", 1, "not a picture of a known format"),
    ] {
        let stderr = desk.refused(&format!("{line} {options}"), code);
        assert!(stderr.contains(expected), "{options}: {stderr}");
    }
    let small = desk.refused("liquid-glass --background white --size 8", 2);
    assert!(small.contains("give 16 to 8192 pixels"), "{small}");
    assert!(desk.refused("liquid-glass", 2).contains("--background"));
}
