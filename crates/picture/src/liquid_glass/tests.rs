//! Tests of the pane.

use super::frost::{FIVE, FrostTap, THREE};
use super::lighting::{Brightness, Normals, SurfaceLight};
use super::parts::{falloff, smoothstep};
use super::*;
use pulp::Arch;

mod smoothness;

pub const SIZE: [u32; 2] = [72, 56];

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
    let (mut outside, mut changed) = (0, 0);
    for (k, (a, b)) in seen.pixels.iter().zip(&bare.pixels).enumerate() {
        let middle = DVec2::new((k % 72) as f64, (k / 72) as f64) + 0.5;
        // The pane's soft border ends half a pixel outside the outline.
        if full().cover(middle) == 0.0 {
            outside += 1;
            assert!(a == b, "pixel {k}");
        } else {
            changed += u32::from(a != b);
        }
    }
    // The pane covers 52 by 38 pixels less four corners of (4 - π) 12² / 4 each.
    assert!(outside > 1900 && changed > 1600, "{outside} {changed}");
}

/// Returns the brightness that the light of a pane gives a normal.
fn brightness(pane: &GlassPane, normal: DVec3) -> f64 {
    let normals = Normals(normal.as_vec3().to_array().map(|part| vec![part]));
    let mut to = [0.0];
    Arch::new().dispatch(Brightness { light: SurfaceLight::new(pane), normals: &normals, to: &mut to });
    f64::from(to[0])
}

#[test]
fn the_formulas_are_those_of_the_specification() {
    // Refraction begins in the middle and ends on the outline.
    for (distance, expected) in [(0.0, 0.0), (0.4, 0.5), (0.8, 1.0), (0.95, 1.0), (0.975, 0.5), (1.0, 0.0)] {
        near(falloff(distance), expected);
    }
    near(smoothstep(0.0, 0.8, 0.2), 0.15625);
    // Halfway to the right border of a disc: the dome is half a ball, so N = (0.5, 0, √0.75).
    let outline = PaneOutline::new(DVec2::splat(0.5), 0.5);
    let dome = outline.dome(DVec2::new(0.25, 0.0));
    near(dome.distance, 0.5);
    assert!(dome.radial == DVec2::X && dome.normal.abs_diff_eq(DVec3::new(0.5, 0.0, 0.75_f64.sqrt()), 1e-12));
    // smoothstep(0, 0.8, 0.5) = 0.625² (3 - 1.25) = 0.68359375; the shift is 0.5 of 0.015 and of 0.008.
    near(refraction(&dome, 100.0).x, 0.0115 * 0.683_593_75);
    near(refraction(&dome, 40.0).x, 0.4 * 0.0115 * 0.683_593_75);
    // Thickness 0.06: (0.5 0.06 0.1, 0.06 0.05) (1 - 0.15).
    assert!(depth(&dome, 50.0).abs_diff_eq(DVec2::new(0.002_55, 0.002_55), 1e-12));
    assert!(dispersion(&dome, 80.0).abs_diff_eq(DVec2::X * 0.0012, 1e-12));
    // All parts together at one place, for a disc of 50 pixels.
    let pane = GlassPane {
        refraction: 40.0,
        depth: 50.0,
        dispersion: 80.0,
        ..GlassPane::clear(DVec2::ZERO, DVec2::splat(50.0), 25.0)
    };
    let [red, green, blue] = pane.shifts(DVec2::new(37.5, 25.0));
    near(green.x, -50.0 * (0.4 * 0.0115 * 0.683_593_75 + 0.002_55));
    near(green.y, -50.0 * 0.002_55);
    near(red.x - green.x, 50.0 * 0.0012 * 1.1);
    near(blue.x - green.x, -50.0 * 0.0012 * 0.9);
}

#[test]
fn the_light_is_diffuse_light_shine_and_a_rim_and_comes_from_where_it_is_set() {
    let from_above = full();
    let close =
        |found: f64, expected: f64| assert!((found - expected).abs() < 1e-6, "{found}, not {expected}");
    // Flat, toward the eye: N·L = 0.8; H = (0, -0.6, 1.8)/√3.6, N·H = √0.9, its 32nd power is 0.9¹⁶; no rim.
    close(brightness(&from_above, DVec3::Z), 0.24 + 0.5 * 0.9_f64.powi(16));
    // Level, away from the light: only the rim is left.
    close(brightness(&from_above, DVec3::Y), 0.3);
    // Level, toward the light: 0.3 · 0.6 of diffuse light, N·H = 0.6/√3.6, and the rim.
    close(brightness(&from_above, DVec3::NEG_Y), 0.18 + 0.5 * 0.1_f64.powi(16) + 0.3);
    let right = GlassPane { light_from: LightFrom { azimuth: 0.0, height: 0.0 }, ..full() };
    assert!(right.toward_light().abs_diff_eq(DVec3::X, 1e-15));
    close(brightness(&right, DVec3::X), 0.3 + 0.5 * 0.5_f64.powi(16) + 0.3);
    close(brightness(&right, DVec3::NEG_X), 0.3);
    for broken in [f64::NAN, f64::INFINITY] {
        let light_from = LightFrom { azimuth: broken, height: broken };
        assert!(GlassPane { light_from, ..full() }.effective().toward_light().abs_diff_eq(DVec3::X, 1e-15));
    }
    // In the picture the rim is bright on the side of the light, and on the other side where the light is there.
    let dark = even([0.0; 3]);
    let sides = |azimuth| {
        let light_from = LightFrom { azimuth, height: 30.0 };
        let seen = pane(&GlassPane { light_from, ..full() }, &dark, 1);
        [12, 59].map(|x| seen.pixels[28 * 72 + x][0])
    };
    let [right, left] = [sides(0.0), sides(180.0)];
    assert!(right[1] > 1.5 * right[0] && left[0] > 1.5 * left[1], "{right:?} {left:?}");
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
    // The roughness is a mean of noise from 0 to 1 by weights, a third of it, without jumps.
    let places = (0..4000).map(|k| DVec2::new(0.754_877_666_2, 0.569_840_291) * f64::from(k));
    let values: Vec<f64> = places.clone().map(|at| frost::roughness(at.fract())).collect();
    assert!(values.iter().all(|v| (0.0..=1.0 / 3.0).contains(v)));
    let mean = values.iter().sum::<f64>() / 4000.0;
    let deviation = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 4000.0).sqrt();
    assert!((mean - 1.0 / 6.0).abs() < 0.004 && (0.02..0.08).contains(&deviation), "{mean} {deviation}");
    for at in places {
        assert!((frost::roughness(at) - frost::roughness(at + 1e-7)).abs() < 1e-3);
    }
    let (at, dome) = (DVec2::new(0.4, 0.2), frost.outline().dome(DVec2::new(0.4, 0.2)));
    near(frost::blur(at, &dome, 50.0), 0.5 * 0.003 * (dome.normal.x + dome.normal.y) * frost::roughness(at));
}

#[test]
fn the_samples_of_frost_have_the_moments_of_a_gaussian() {
    let moment = |taps: &[FrostTap], x: i32, y: i32| {
        let parts = taps.iter().map(|tap| tap.weight * tap.at[0].powi(x) * tap.at[1].powi(y));
        parts.sum::<f32>()
    };
    for (order, expected) in [(0, 1.0), (1, 0.0), (2, 1.0), (3, 0.0), (4, 3.0)] {
        let near = |found: f32| (found - expected).abs() < 1e-5;
        assert!(near(moment(&FIVE, order, 0)) && near(moment(&FIVE, 0, order)), "{order}");
        assert!(near(moment(&THREE, order, 0)), "{order}");
    }
    // Three samples blur to the left and right alone.
    assert!(moment(&FIVE, 1, 1) == 0.0 && moment(&THREE, 0, 2) == 0.0);
}

#[test]
fn samples_of_frost_are_the_same_one_by_one_and_together() {
    let background = pattern(false);
    // In grey the channels of an undispersed pane, which takes samples one by one, are those of a dispersed one.
    let grey = Panorama { pixels: background.pixels.iter().map(|p| [p[0]; 3]).collect(), ..background };
    let seen = |quality, dispersion| {
        let pane = GlassPane { frost: 100.0, quality, dispersion, ..full() };
        PreparedPane::new(&pane, SIZE).through(&grey)
    };
    for quality in [PaneQuality::High, PaneQuality::Medium] {
        let (one_by_one, together) = (seen(quality, 0.0), seen(quality, 1e-9));
        assert!(one_by_one.apart(&together) < 1e-5, "{quality:?}: {}", one_by_one.apart(&together));
        assert!(one_by_one.apart(&seen(quality, 30.0)) > 0.01, "{quality:?}");
    }
    let qualities = [PaneQuality::High, PaneQuality::Medium].map(|quality| seen(quality, 1e-9));
    assert!(qualities[0].apart(&qualities[1]) > 1e-3, "{}", qualities[0].apart(&qualities[1]));
}

#[test]
fn a_tint_colours_the_light_as_far_as_it_covers_it() {
    let dark = even([0.0; 3]);
    let tinted = |tint| pane(&GlassPane { tint, light: 60.0, ..none() }, &dark, 1);
    let white = tinted(DVec4::ZERO);
    let lit = white.pixels.iter().filter(|p| p[0] > 0.05).count();
    assert!(lit > 1500, "{lit}");
    for (alpha, [red, green, blue]) in [(0.5, [0.6, 0.8, 1.0]), (1.0, [0.2, 0.6, 1.0])] {
        let seen = tinted(DVec4::new(0.2, 0.6, 1.0, alpha));
        for (seen, white) in seen.pixels.iter().zip(&white.pixels) {
            for (seen, part) in seen.iter().zip([red, green, blue]) {
                assert!((seen - part * white[0]).abs() < 1e-6, "{seen} {part} {white:?}");
            }
        }
    }
    // Without light there is nothing to colour.
    let background = pattern(false);
    assert!(pane(&GlassPane { tint: DVec4::ONE, ..none() }, &background, 1) == plain(&background));
}

#[test]
fn a_layer_is_premultiplied_and_laid_over_its_background_it_is_the_picture() {
    let background = pattern(false);
    for passes in [1, 3] {
        let clear = GlassPane { light: 0.0, frost: 60.0, ..full() };
        let alone = layer(&clear, &background, passes);
        // All of the background is at most white, so no colour is brighter than its cover.
        assert!(alone.pixels.iter().all(|p| p[..3].iter().all(|part| *part <= p[3] + 1e-6)));
        let partly = alone.pixels.iter().filter(|p| p[3] > 0.01 && p[3] < 0.99).count();
        let none = alone.pixels.iter().filter(|p| **p == [0.0; 4]).count();
        assert!(partly > 40 && none > 1900, "{partly} {none}");
        let lit = full();
        let (alone, mut laid_over) = (layer(&lit, &background, passes), plain(&background));
        for (below, above) in laid_over.pixels.iter_mut().zip(&alone.pixels) {
            below.iter_mut().zip(above).for_each(|(below, part)| *below = part + *below * (1.0 - above[3]));
        }
        assert!(apart(&laid_over, &pane(&lit, &background, passes)) < 1e-6);
        // Colours that were not premultiplied would not add up to the picture.
        assert!(alone.pixels.iter().any(|p| p[3] > 0.2 && p[3] < 0.8 && p[0] / p[3] - p[0] > 0.05));
    }
}

#[test]
fn with_passes_a_pixel_is_the_mean_over_places_in_it() {
    let background = pattern(false);
    let seen = pane(&none(), &background, 3);
    let middle = DVec2::new(30.0, 20.0);
    let own: DVec3 = (0..3).map(|k| background.between(middle + place_in_pixel(k, 3) - 0.5)).sum();
    let found = seen.pixels[20 * 72 + 30];
    for (found, own) in found.iter().zip((own / 3.0).to_array()) {
        assert!((f64::from(*found) - own).abs() < 1e-6, "{found} {own}");
    }
    assert!(apart(&seen, &plain(&background)) > 0.05);
}

#[test]
fn light_adds_the_same_to_every_background() {
    let dark = even([0.0; 3]);
    let glow = layer(&GlassPane { light: 80.0, ..none() }, &dark, 1);
    let (background, lit) = (pattern(false), GlassPane { light: 80.0, ..none() });
    for (k, (seen, own)) in pane(&lit, &background, 1).pixels.iter().zip(&background.pixels).enumerate() {
        let alone = glow.pixels[k];
        for channel in 0..3 {
            assert!((seen[channel] - own[channel] - alone[channel]).abs() < 1e-6, "pixel {k}");
        }
    }
}

#[test]
fn a_prepared_pane_serves_other_lights_backgrounds_and_places() {
    let (first, second) = (pattern(false), pattern(true));
    let mut prepared = PreparedPane::new(&full(), SIZE);
    let moved = GlassPane {
        corner: full().corner + DVec2::new(-3.0, 4.0),
        light_from: LightFrom { azimuth: 200.0, height: 20.0 },
        tint: DVec4::new(1.0, 0.5, 0.2, 0.7),
        light: 20.0,
        ..full()
    };
    assert!(prepared.suits(&moved, SIZE));
    assert!(prepared.lit(&full(), &prepared.through(&first), Some(&first)) == pane(&full(), &first, 1));
    prepared.moved_to(&moved);
    assert!(prepared.lit(&moved, &prepared.through(&second), Some(&second)) == pane(&moved, &second, 1));
    for other in [
        GlassPane { frost: 50.0, ..full() },
        GlassPane { radius: 9.0, ..full() },
        GlassPane { quality: PaneQuality::Low, ..full() },
        GlassPane { corner: full().corner + 0.25, ..full() },
        GlassPane { corner: full().corner - 20.0, ..full() },
    ] {
        assert!(!prepared.suits(&other, SIZE), "{other:?}");
    }
    assert!(!prepared.suits(&full(), [72, 57]));
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
