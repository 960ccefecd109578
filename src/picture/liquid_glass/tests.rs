//! Tests of the pane.

use super::outline::DomePoint;
use super::parts::{falloff, smoothstep};
use super::*;

const SIZE: [u32; 2] = [72, 56];

/// Returns a pattern with edges and colours in both directions; with `symmetric`, left and right are mirror images.
pub fn pattern(symmetric: bool) -> Panorama {
    let [width, height] = SIZE;
    let light = |k: u32| {
        let (x, y) = (k % width, k / width);
        let x = if symmetric { x.min(width - 1 - x) } else { x };
        let check = f32::from(((x / 5 + y / 7) % 2) as u8);
        [0.1 + 0.8 * check, 0.013 * x as f32, 0.9 - 0.012 * y as f32]
    };
    Panorama { width, height, pixels: (0..width * height).map(light).collect() }
}

pub fn even(colour: [f32; 3]) -> Panorama {
    Panorama { width: SIZE[0], height: SIZE[1], pixels: vec![colour; (SIZE[0] * SIZE[1]) as usize] }
}

/// Returns a pane in the picture's middle with all strengths in full.
pub fn full() -> GlassPane {
    let place = (DVec2::new(10.0, 9.0), DVec2::new(52.0, 38.0));
    GlassPane { frost: 100.0, light: 100.0, ..GlassPane::clear(place.0, place.1, 12.0) }
}

pub fn none() -> GlassPane {
    GlassPane { refraction: 0.0, depth: 0.0, dispersion: 0.0, frost: 0.0, light: 0.0, ..full() }
}

/// Returns the greatest difference between two pictures.
pub fn apart(a: &Linear, b: &Linear) -> f32 {
    assert_eq!((a.width, a.height, a.pixels.len()), (b.width, b.height, b.pixels.len()));
    let pairs = a.pixels.iter().flatten().zip(b.pixels.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
}

#[test]
fn a_pane_without_strength_leaves_the_background_to_the_bit() {
    let background = pattern(false);
    for quality in [PaneQuality::High, PaneQuality::Medium, PaneQuality::Low] {
        assert!(pane(&GlassPane { quality, ..none() }, &background, 1) == plain(&background));
    }
    let faint = GlassPane { light: 1.0, ..none() };
    assert!(
        pane(&faint, &background, 1) != plain(&background),
        "the comparison sees one percent of the light"
    );
}

#[test]
fn outside_of_the_outline_nothing_changes() {
    let background = pattern(false);
    let (seen, bare) = (pane(&full(), &background, 1), plain(&background));
    let outline = full().outline();
    let (mut outside, mut changed) = (0, 0);
    for (k, (a, b)) in seen.pixels.iter().zip(&bare.pixels).enumerate() {
        let middle = DVec2::new((k % 72) as f64, (k / 72) as f64) + 0.5;
        // The pane's soft border ends half a pixel outside the outline.
        if outline.distance(full().own(middle)) * full().unit() >= 0.5 {
            outside += 1;
            assert!(a == b, "pixel {k}");
        } else {
            changed += u32::from(a != b);
        }
    }
    // The pane covers 52 by 38 pixels less four corners of (4 - π) 12² / 4 each.
    assert!(outside > 1900 && changed > 1600, "{outside} {changed}");
}

#[test]
fn the_formulas_are_those_of_the_specification() {
    // Refraction begins in the middle and ends on the outline.
    for (distance, expected) in [(0.0, 0.0), (0.4, 0.5), (0.8, 1.0), (0.95, 1.0), (0.975, 0.5), (1.0, 0.0)] {
        near(falloff(distance), expected);
    }
    near(smoothstep(0.0, 0.8, 0.2), 0.15625);
    // Halfway to the right border of a pane 2 by 1: N = (0.5, 0, √0.75).
    let outline = PaneOutline { half: DVec2::new(1.0, 0.5), radius: 0.25 };
    let dome = outline.dome(DVec2::new(0.5, 0.0));
    let expected = (0.5, DVec2::X, DVec3::new(0.5, 0.0, 0.75_f64.sqrt()));
    assert_eq!((dome.distance, dome.radial, dome.normal), expected);
    // smoothstep(0, 0.8, 0.5) = 0.625² (3 - 1.25) = 0.68359375; the shift is 0.5 of 0.015 and of 0.008.
    near(refraction(&dome, 100.0).x, 0.0115 * 0.683_593_75);
    near(refraction(&dome, 40.0).x, 0.4 * 0.0115 * 0.683_593_75);
    // Thickness 0.06: (0.5 0.06 0.1, 0.06 0.05) (1 - 0.15).
    assert!(depth(&dome, 50.0).abs_diff_eq(DVec2::new(0.002_55, 0.002_55), 1e-15));
    let [red, green, blue] = dispersion(&dome, 80.0);
    assert!(red.abs_diff_eq(DVec2::X * 0.0012 * 1.1, 1e-15) && green == DVec2::ZERO);
    assert!(blue.abs_diff_eq(DVec2::NEG_X * 0.0012 * 0.9, 1e-15));
    // Flat, toward the eye: N·L = 0.8; H = (0, -0.6, 1.8)/√3.6, N·H = √0.9, its 32nd power is 0.9¹⁶; no rim.
    near(light(DVec3::Z, 100.0), 0.24 + 0.5 * 0.9_f64.powi(16));
    // Level, away from the light: only the rim is left.
    near(light(DVec3::Y, 50.0), 0.15);
    // All parts together at one place, for a pane of 100 by 50 pixels.
    let pane = GlassPane {
        refraction: 40.0,
        depth: 50.0,
        dispersion: 80.0,
        ..GlassPane::clear(DVec2::ZERO, DVec2::new(100.0, 50.0), 12.5)
    };
    let [red, green, _] = pane.shifts(DVec2::new(75.0, 25.0));
    near(green.x, -50.0 * (0.4 * 0.0115 * 0.683_593_75 + 0.002_55));
    near(green.y, -50.0 * 0.002_55);
    near(red.x - green.x, 50.0 * 0.0012 * 1.1);
}

#[test]
fn the_dome_is_upright_in_the_middle_level_on_the_outline_and_without_a_jump() {
    for (half, radius) in [((1.7, 0.5), 0.2), ((0.5, 0.9), 0.5), ((0.5, 0.5), 0.5), ((0.8, 0.5), 0.01)] {
        let outline = PaneOutline { half: DVec2::from(half), radius };
        assert_eq!(
            outline.dome(DVec2::ZERO),
            DomePoint { distance: 0.0, radial: DVec2::ZERO, normal: DVec3::Z }
        );
        for k in 0..720 {
            let way = DVec2::from_angle(f64::from(k).to_radians() / 2.0);
            let border = way / outline.dome(way * 0.01).distance * 0.01;
            assert!(outline.distance(border).abs() < 1e-12, "{k}: the outline is at distance 1");
            for part in [0.1, 0.5, 0.9] {
                let dome = outline.dome(border * part);
                near(dome.distance, part);
                near(dome.normal.length(), 1.0);
                // The normal is square to the outline there.
                let outside = outline.distance(border + dome.normal.truncate() / part * 1e-3);
                assert!((outside - 1e-3).abs() < 1e-9, "{k}: {outside}");
                let beside = outline.dome(border.rotate(DVec2::from_angle(1e-6)) * part);
                assert!((beside.normal - dome.normal).length() < 1e-3);
            }
        }
        assert_eq!(outline.dome(DVec2::new(9.0, 9.0)).distance, 1.0);
    }
}

#[test]
fn without_dispersion_grey_stays_grey_and_with_it_it_does_not() {
    let mut grey = pattern(false);
    grey.pixels.iter_mut().for_each(|p| *p = [p[0]; 3]);
    let colour = |dispersion| {
        let picture = pane(&GlassPane { dispersion, ..full() }, &grey, 1);
        let spread = |p: &[f32; 4]| (p[0] - p[1]).abs().max((p[2] - p[1]).abs());
        picture.pixels.iter().map(spread).fold(0.0, f32::max)
    };
    assert!(colour(0.0) == 0.0 && colour(100.0) > 0.05);
}

#[test]
fn each_quality_does_what_it_says() {
    let background = pattern(false);
    let of = |quality, other: GlassPane| pane(&GlassPane { quality, ..other }, &background, 1);
    let plain_refraction = GlassPane { refraction: 70.0, ..none() };
    for quality in [PaneQuality::High, PaneQuality::Medium] {
        assert!(of(quality, plain_refraction) == of(PaneQuality::Low, plain_refraction));
    }
    let tinted = GlassPane { tint: DVec4::new(0.2, 0.4, 0.9, 0.5), ..full() };
    assert!(
        of(PaneQuality::Low, GlassPane { refraction: 70.0, ..tinted })
            == of(PaneQuality::Low, plain_refraction)
    );
    // Without frost, medium quality equals high quality with a dispersion of 30 at most.
    let clear = GlassPane { frost: 0.0, ..tinted };
    assert!(of(PaneQuality::Medium, clear) == of(PaneQuality::High, GlassPane { dispersion: 30.0, ..clear }));
    assert!(of(PaneQuality::Medium, clear) != of(PaneQuality::High, clear));
    let few = GlassPane { dispersion: 20.0, ..clear };
    assert!(of(PaneQuality::Medium, few) == of(PaneQuality::High, few));
    assert!(
        of(PaneQuality::Medium, GlassPane { frost: 100.0, ..few })
            != of(PaneQuality::High, GlassPane { frost: 100.0, ..few })
    );
    assert!("best".parse::<PaneQuality>().is_err() && "Low".parse() == Ok(PaneQuality::Low));
}

#[test]
fn frost_is_the_same_every_time_and_keeps_an_even_background() {
    let frost = GlassPane { frost: 100.0, ..none() };
    let background = pattern(false);
    let seen = pane(&frost, &background, 1);
    assert!(seen == pane(&frost, &background, 1) && apart(&seen, &plain(&background)) > 0.01);
    let even = even([0.3, 0.5, 0.7]);
    assert!(apart(&pane(&frost, &even, 1), &plain(&even)) < 1e-7);
    // The noise is spread around 0 within its bounds, without jumps.
    let places = (0..4000).map(|k| DVec2::new(0.754_877_666_2, 0.569_840_291) * f64::from(k));
    let values: Vec<f64> = places.clone().map(|at| frost::noise(at.fract(), 0)).collect();
    assert!(values.iter().all(|v| v.abs() <= 1.0));
    let mean = values.iter().sum::<f64>() / 4000.0;
    let deviation = (values.iter().map(|v| v * v).sum::<f64>() / 4000.0).sqrt();
    assert!(mean.abs() < 0.02 && (0.15..0.5).contains(&deviation), "{mean} {deviation}");
    for at in places {
        assert!((frost::noise(at, 1) - frost::noise(at + 1e-7, 1)).abs() < 1e-3);
    }
    let pane = frost.outline().dome(DVec2::new(0.4, 0.2));
    let reach = 0.003 * (pane.normal.x + pane.normal.y);
    for count in [3, 5] {
        let taps = taps(DVec2::new(0.4, 0.2), &pane, 100.0, count);
        assert_eq!(taps.len(), count);
        assert!(taps.iter().all(|t| t.length() <= reach * (1.0 + 2.0_f64.sqrt())));
    }
}

#[test]
fn a_tint_covers_by_its_alpha() {
    let background = even([0.8, 0.4, 0.2]);
    let tinted = |tint| pane(&GlassPane { tint, ..none() }, &background, 1);
    assert!(tinted(DVec4::new(0.1, 0.9, 0.5, 0.0)) == plain(&background));
    let middle = |picture: Linear| picture.pixels[28 * 72 + 36];
    let half = middle(tinted(DVec4::new(0.2, 0.6, 1.0, 0.5)));
    let all = middle(tinted(DVec4::new(0.2, 0.6, 1.0, 1.0)));
    for (k, (a, b)) in [(0.5, 0.2), (0.5, 0.6), (0.6, 1.0)].into_iter().enumerate() {
        assert!((half[k] - a).abs() < 1e-6 && (all[k] - b).abs() < 1e-6);
    }
}

#[test]
fn what_is_symmetric_stays_so() {
    let background = pattern(true);
    // Frost is left out: its noise is not symmetric.
    let seen = pane(&GlassPane { frost: 0.0, ..full() }, &background, 1);
    let mirrored = Linear {
        pixels: seen.pixels.chunks(72).flat_map(|row| row.iter().rev().copied()).collect(),
        ..seen.clone()
    };
    assert!(apart(&seen, &mirrored) < 1e-5);
    assert!(apart(&seen, &plain(&background)) > 0.1);
}

#[test]
fn no_pane_makes_it_panic() {
    let background = pattern(false);
    let bad = [f64::NAN, f64::INFINITY, -1e300, 1e300, 0.0, -1.0, 1e-300];
    for v in bad {
        for w in bad {
            let place = GlassPane::clear(DVec2::new(v, 3.0), DVec2::new(20.0, w), w);
            let strengths =
                GlassPane { refraction: v, depth: w, dispersion: v, frost: w, light: v, ..full() };
            for one in
                [place, strengths, GlassPane { corner: DVec2::splat(w), size: DVec2::splat(v), ..full() }]
            {
                assert_eq!(pane(&one, &background, 1).pixels.len(), background.pixels.len());
            }
        }
    }
    let over_the_border = GlassPane { corner: DVec2::new(-20.0, 40.0), ..full() };
    assert!(pane(&over_the_border, &background, 1) != plain(&background));
    assert!(pane(&GlassPane { radius: 20.0, ..full() }, &background, 1) == plain(&background));
}
