//! The pictures that `render` and `spin` write.

use super::desk::*;
use brillianteer::optics::linear_from_encoded;
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::Path;

/// Returns the mean of a picture, in linear light.
fn mean(pixels: &[DVec3]) -> DVec3 {
    pixels.iter().sum::<DVec3>() / pixels.len() as f64
}

fn picture(desk: &Desk, options: &str) -> (Vec<DVec3>, String) {
    let line = format!("render {options} --size 48 --samples 2 --wavelengths 4 --out a.png");
    assert_eq!(desk.done(&line).trim(), "a.png", "{line}");
    let (size, pixels, description) = png(&desk.at("a.png"));
    assert_eq!(size, (48, 48));
    (pixels, description)
}

/// Returns the bytes of a PNG's first frame and, where it is animated, the number of frames and how often they run.
fn frame(path: &Path) -> (Vec<u8>, Option<(u32, u32)>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let animation = reader.info().animation_control().map(|a| (a.num_frames, a.num_plays));
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    (bytes, animation)
}

#[test]
fn every_tracer_shows_the_same_stone_and_says_that_it_did() {
    let desk = Desk::new();
    let (exact, description) = picture(&desk, "modern-ideal --light dome --tracer beam");
    assert!(
        description.contains("light dome; 4 wavelengths in 2 samples, polarised; exact beams, unresolved"),
        "{description}"
    );
    assert!(
        description.ends_with("table side") && description.starts_with("Modern ideal; "),
        "{description}"
    );
    let (rays, description) = picture(&desk, "modern-ideal --light dome --tracer ray");
    assert!(description.contains("; point rays, unresolved"), "{description}");
    assert!((mean(&exact) - mean(&rays)).abs().max_element() < 0.02);
    let (other, _) = picture(&desk, "modern-ideal --tracer beam --light ring");
    assert!((mean(&exact) - mean(&other)).abs().max_element() > 0.05);
    // Rays trace several stones and perspective.
    let (_, description) = picture(&desk, "trilogy --perspective 12");
    assert!(description.contains("Trilogy; ") && description.contains("rays"), "{description}");
    let stderr = desk.refused("render trilogy --tracer beam", 2);
    assert!(stderr.contains("exact beams are for one convex stone"), "{stderr}");
}

#[test]
fn a_render_is_the_same_bytes_on_any_number_of_threads() {
    let desk = Desk::new();
    for options in [
        "modern-ideal --tracer beam --material ruby",
        "modern-ideal --tracer ray --eye-tilt 20 --overlay wireframe",
    ] {
        let made = ["1", "2"].map(|threads| {
            let line = format!("render {options} --size 64 --samples 2 --wavelengths 3 --out {threads}.png");
            let run = desk.command(&line).env("RAYON_NUM_THREADS", threads).output().unwrap();
            assert_eq!(outcome(&line, &run).0, 0);
            std::fs::read(desk.at(format!("{threads}.png"))).unwrap()
        });
        assert!(made[0] == made[1], "{options}");
    }
}

#[test]
fn a_clear_stone_vanishes_in_white_light_and_an_exr_holds_it() {
    let desk = Desk::new();
    for options in ["--tracer ray --background light", "--tracer beam"] {
        desk.done(&format!(
            "render modern-ideal --light white {options} --size 32 --samples 1 --wavelengths 5 --out a.exr"
        ));
        let channels: BTreeMap<String, Vec<f64>> = exr(&desk.at("a.exr"));
        assert!(channels.keys().eq(["A", "B", "G", "R"]));
        let all = |name: &str| channels[name].iter().sum::<f64>();
        for channel in ["R", "G", "B"] {
            // The tolerance is for unresolved light.
            near(all(channel) / all("A"), 1.0, 5e-3, channel);
        }
    }
}

#[test]
fn a_stone_of_colour_is_darker_the_larger_it_is_and_weighs_what_is_asked() {
    let desk = Desk::new();
    let brightness = |size: &str| {
        let (pixels, description) = picture(
            &desk,
            &format!("modern-ideal --material amethyst --stone {size} --light dome --background black"),
        );
        let absorbed: f64 =
            description.split("absorbed ").nth(1).unwrap().split(';').next().unwrap().trim().parse().unwrap();
        (mean(&pixels).y, absorbed)
    };
    let [small, carat, large] = ["3mm", "1ct", "12mm"].map(brightness);
    assert!(small.0 > carat.0 && carat.0 > large.0, "{small:?} {carat:?} {large:?}");
    assert!(small.1 < carat.1 && carat.1 < large.1, "{small:?} {carat:?} {large:?}");
    assert!(desk.refused("render modern-ideal --stone 3", 2).contains("mm"));
}

#[test]
fn what_lies_behind_is_a_colour_nothing_or_a_photograph() {
    let desk = Desk::new();
    let (pixels, _) = picture(&desk, "modern-ideal --background #336699 --glow 0");
    let linear = |rgb: [u8; 3]| DVec3::from_array(rgb.map(|c| linear_from_encoded(f64::from(c) / 255.0)));
    assert_eq!(pixels[0], linear([0x33, 0x66, 0x99]));
    desk.done("render modern-ideal --background #c08040 --glow 0 --size 40 --samples 1 --wavelengths 2 --out behind.png");
    let (photo, description) = picture(&desk, "cube.toml --background behind.png --light white");
    assert!(
        description.contains("rays") && (photo[0] - linear([0xc0, 0x80, 0x40])).length() < 0.01,
        "{description}: {}",
        photo[0]
    );
    let stderr = desk.refused("render modern-ideal --background mauve", 2);
    assert!(
        stderr.contains("mauve") && stderr.contains("page, grid, checks") && stderr.contains("photograph"),
        "{stderr}"
    );
}

#[test]
fn a_pattern_is_seen_through_glass_with_the_strength_asked_for() {
    let desk = Desk::new();
    let of = |options: &str| picture(&desk, &format!("prism --light dome --background checks {options}"));
    let (physics, description) = of("");
    assert!(
        description.contains("rays") && !description.contains("strength") && !description.contains("jitter"),
        "{description}"
    );
    assert_eq!(physics, of("--strength 1").0);
    let (mixed, description) = of("--strength 0.1 --no-jitter");
    assert!(description.contains("4 wavelengths in 2 samples, without jitter"), "{description}");
    assert!(
        description.contains("strength 0.1: refracted and straight rays are mixed, which is not physics"),
        "{description}"
    );
    assert!((mean(&physics) - mean(&mixed)).abs().max_element() < 0.5 && physics != mixed);
    // Without refraction, and with hardly any reflection, the squares are where they are without glass.
    let (bare, _) = of("--material 1.0001");
    let (straight, _) = of("--material 1.0001 --strength 0");
    assert!(bare.iter().zip(&straight).all(|(a, b)| (*a - *b).abs().max_element() < 0.02));
    // The strength of a scene, and one that an option gives instead.
    let (_, description) = picture(&desk, "subtle-pill");
    assert!(
        description.starts_with("Subtle pill; light sunset")
            && description.contains("strength 0.035: refracted and straight rays are mixed"),
        "{description}"
    );
    let (_, description) = picture(&desk, "subtle-pill --strength 1 --background black");
    assert!(!description.contains("rays are mixed"), "{description}");
    let stderr = desk.refused("render modern-ideal --strength 0.5 --tracer beam", 2);
    assert!(stderr.contains("--tracer ray, or --strength 1"), "{stderr}");
    let (by_card, description) = of("--strength 0.1 --no-jitter --tracer gpu");
    assert!(
        description.contains("strength 0.1: refracted and straight rays are mixed, which is not physics"),
        "{description}"
    );
    assert!((mean(&by_card) - mean(&mixed)).abs().max_element() < 0.005);
}

#[test]
fn a_spin_is_numbered_frames_and_an_animation_of_them() {
    let desk = Desk::new();
    for motion in ["turn", "rock", "wobble"] {
        let line = format!(
            "spin modern-ideal --motion {motion} --frames 3 --seconds 0.6 --size 40 --wavelengths 2 --samples 1 --eye-tilt 10 --out {motion}"
        );
        let line = if motion == "wobble" { line.replace("--eye-tilt 10", "") } else { line };
        let name = match motion {
            "turn" => "modern-ideal-eye-tilt-10-spin",
            "rock" => "modern-ideal-motion-rock-eye-tilt-10-spin",
            _ => "modern-ideal-motion-wobble-spin",
        };
        assert_eq!(desk.done(&line).trim(), format!("{motion}/{name}.png"));
        let frames = files(&desk.at(format!("{motion}/{name}")));
        assert!(frames.keys().eq(["0001.png", "0002.png", "0003.png"]), "{:?}", frames.keys());
        assert!(frames["0001.png"] != frames["0002.png"]);
        if motion == "turn" {
            // The stones turn, and not only the light: the drawn facets of dark frames differ.
            desk.done("spin modern-ideal --frames 2 --size 32 --wavelengths 1 --samples 1 --exposure -40 --glow 0 --overlay facets --out dark");
            let dark = files(&desk.at("dark/modern-ideal-exposure--40-glow-0-overlay-facets-spin"));
            assert!(dark["0001.png"] != dark["0002.png"]);
        }
        let (moving, animation) = frame(&desk.at(format!("{motion}/{name}.png")));
        assert_eq!(animation, Some((3, 0)));
        let (still, none) = frame(&desk.at(format!("{motion}/{name}/0001.png")));
        assert!(moving == still && none.is_none(), "{motion}");
    }
}

#[test]
fn what_lies_at_a_point_is_told_by_its_name() {
    let desk = Desk::new();
    let at = |line: &str, point: &str| {
        desk.done(&format!("render {line} --size 200 --probe {point}")).trim().to_owned()
    };
    assert_eq!(at("modern-ideal", "100,100"), "table");
    assert_eq!(at("modern-ideal", "180,100"), "bezel 1");
    assert_eq!(at("modern-ideal", "2,2"), "nothing");
    assert!(at("trilogy", "100,100").starts_with("table of stone 2, "), "{}", at("trilogy", "100,100"));
    assert!(!desk.at("out").exists());
}

#[test]
fn a_render_at_fault_is_refused_and_says_why() {
    let desk = Desk::new();
    for (line, code, expected) in [
        ("render modern-ideal --light moon", 2, "no light 'moon'"),
        ("render modern-ideal --light studoi", 2, "did you mean 'studio'?"),
        ("render modern-ideal --material rubi", 2, "did you mean 'ruby'?"),
        ("render modern-ideal --size 4", 2, "give 16 to 8192 pixels"),
        ("render modern-ideal --size 100x9000", 2, "give 16 to 8192 pixels"),
        ("render modern-ideal --turn nan", 2, "--turn NaN"),
        ("render modern-ideal --head 90", 2, "--head 90: give 0 to 89"),
        ("render modern-ideal --glow 2", 2, "--glow 2: give 0 to 1"),
        ("render modern-ideal --overlay hair", 2, "wireframe"),
        ("render modern-ideal --strength 1.1", 2, "--strength 1.1: give 0 to 1"),
        ("render modern-ideal --out a.jpg", 2, ".jpg is not written"),
        ("render modern-ideal --background none.png", 1, "none.png: there is no such file"),
        ("spin modern-ideal --out a.jpg", 2, ".jpg is not written"),
        ("render modern-ideal tolkowsky --out a.png", 2, "several stones need a folder"),
        ("spin modern-ideal --seconds 0", 2, "--seconds 0: 48 frames of 0 ms"),
        ("spin modern-ideal --motion rock --swing 100", 2, "--swing 100: with the tilt"),
        ("spin modern-ideal --motion rock --tilt 80 --swing 20", 2, "--swing 20: with the tilt"),
        ("spin modern-ideal --motion wobble --tilt 8", 2, "leave out --tilt"),
        ("render no-such-cut", 1, "no-such-cut"),
    ] {
        let stderr = desk.refused(line, code);
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
    assert!(!desk.at("out").exists());
}

#[test]
fn edges_are_smoothed_in_the_finished_picture_or_over_time() {
    let desk = Desk::new();
    // In a white world glass is white: before black its outline is all that there is to smooth.
    let taken = |options: &str| {
        let scene = "prism --light white --background black --glow 0 --tracer ray --wavelengths 3";
        let line = format!("render {scene} --azimuth 20 --tilt 20 --size 96 {options} --out a.png");
        assert_eq!(desk.run(&line).0, 0, "{line}");
        let (_, pixels, description) = png(&desk.at("a.png"));
        (pixels, description)
    };
    let (exact, description) = taken("--samples 64");
    assert!(!description.contains("smoothed"), "{description}");
    let off =
        |pixels: &[DVec3]| pixels.iter().zip(&exact).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>();
    let rough = off(&taken("--samples 1").0);
    for (options, most) in [
        ("--samples 1 --smoothing fxaa", 0.8),
        ("--samples 12 --smoothing temporal", 0.6),
        ("--samples 12 --smoothing temporal:0.2", 0.5),
    ] {
        let (pixels, description) = taken(options);
        let how = options.rsplit(' ').next().unwrap();
        assert!(description.contains(&format!(", smoothed by {how},")), "{description}");
        let part = off(&pixels) / rough;
        println!("{options}: {part:.3} of the error");
        assert!(part < most, "{options}: {part}");
    }
    assert_eq!(taken("--samples 2 --smoothing none").0, taken("--samples 2").0);
    desk.done("spin prism --smoothing temporal --samples 1 --frames 3 --size 32 --out b.png");
    for (line, message) in [
        ("render prism --smoothing taa", "'taa': give none, fxaa, temporal, or temporal:PART"),
        ("render prism --smoothing temporal:3", "'temporal:3': give none"),
        (
            "render prism --smoothing temporal --size 4096",
            "--smoothing temporal: 4096 by 4096 pixels are too many",
        ),
    ] {
        let stderr = desk.refused(line, 2);
        assert!(stderr.contains(message), "{stderr}");
    }
    let (code, _, noted) = desk.run("render prism --smoothing fxaa --size 32 --samples 1 --out c.exr");
    assert_eq!(code, 0);
    assert!(
        noted.contains("an EXR holds the bare light: exposure, tone, FXAA and overlays are for PNG"),
        "{noted}"
    );
}
