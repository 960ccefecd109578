//! Tests of glare: light is neither made nor lost, nothing turns negative, and the picture's size does not matter.

use super::*;
use crate::Linear;

/// Adds glare to a picture.
fn spread(bloom: &Bloom, picture: &mut Linear) {
    let Ok(glare) = bloom.glare(&mut &*picture, |pixel| *pixel);
    let rows = picture.pixels.chunks_mut(picture.width as usize).enumerate();
    rows.for_each(|(y, row)| glare.iter().for_each(|glare| glare.add(y, row)));
}

fn total(picture: &Linear) -> [f64; 3] {
    let sum = |c: usize| picture.pixels.iter().map(|p| f64::from(p[c])).sum();
    [sum(0), sum(1), sum(2)]
}

fn point(size: u32, light: [f32; 3]) -> Linear {
    let mut picture = Linear::new(size, size);
    let [r, g, b] = light;
    picture.pixels[(size / 2 * size + size / 2) as usize] = [r, g, b, 1.0];
    picture
}

#[test]
fn spreading_neither_makes_nor_loses_light() {
    for (size, streaks) in [(101, 0), (256, 4), (333, 6), (300, 7)] {
        let mut picture = point(size, [900.0, 500.0, 700.0]);
        for k in 0..5 {
            let at = (size / 2 + 3 * k) * size + size / 2 - 2 * k;
            picture.pixels[at as usize] = [3.0, 40.0, 0.5 * k as f32, 0.5];
        }
        let before = total(&picture);
        spread(&Bloom { streaks, ..Bloom::default() }, &mut picture);
        for (before, after) in before.into_iter().zip(total(&picture)) {
            assert!((after / before - 1.0).abs() < 0.01, "{size}, {streaks} rays: {before} became {after}");
        }
    }
}

#[test]
fn a_large_picture_conserves_light_too_and_glares_alike() {
    let glare = |size: u32| {
        let bright = 100.0 * (size as f32 / 512.0).powi(2);
        let mut picture = point(size, [bright; 3]);
        spread(&Bloom { streaks: 0, ..Bloom::default() }, &mut picture);
        assert!((total(&picture)[1] / f64::from(bright) - 1.0).abs() < 0.01);
        picture.pixels[((size / 2) * size + size / 2 + size / 20) as usize][1]
    };
    let (small, large) = (glare(512), glare(4096));
    assert!((small / large - 1.0).abs() < 0.05 && small > 0.0, "{small} against {large}");
}

#[test]
fn a_grid_that_is_halved_once_more_glares_alike() {
    let bloom = Bloom { streak_length: 0.05, ..Bloom::default() };
    let bright = BrightPass { strength: 0.5, threshold: 1.0 };
    // A part of a picture 3000 pixels wide, with three bright points.
    let size = [1500, 1100];
    let mut picture = Linear::new(size[0], size[1]);
    for (k, pixel) in picture.pixels.iter_mut().enumerate() {
        let (x, y) = ((k % 1500) as i32, (k / 1500) as i32);
        let from = |(at_x, at_y): (i32, i32)| (x - at_x).pow(2) + (y - at_y).pow(2);
        *pixel =
            if [(300, 401), (750, 550), (1101, 800)].map(from).contains(&0) { [1e4; 4] } else { [0.0; 4] };
    }
    let glare = |halvings| {
        let Ok(source) = bright.source(&mut &picture, |pixel| *pixel, halvings);
        let spread = bloom.spread(source, 3000, halvings);
        GatheredGlare { bright, size, halvings, spread }
    };
    let rows = |halvings| {
        let (glare, mut rows) = (glare(halvings), vec![]);
        for y in 0..size[1] as usize {
            let mut row = vec![[0.0; 4]; size[0] as usize];
            glare.add(y, &mut row);
            rows.extend(row.into_iter().map(|pixel| f64::from(pixel[1])));
        }
        rows
    };
    let (fine, coarse) = (rows(0), rows(1));
    let square = |light: &[f64]| light.iter().map(|l| l * l).sum::<f64>();
    let apart: Vec<f64> = fine.iter().zip(&coarse).map(|(fine, coarse)| fine - coarse).collect();
    let part = (square(&apart) / square(&fine)).sqrt();
    assert!(part < 0.02, "{part} of the glare differs");
}

#[test]
fn light_gathered_some_rows_at_a_time_is_that_of_the_whole_picture() {
    let mut picture = Linear::new(2051, 1501);
    for (k, pixel) in picture.pixels.iter_mut().enumerate() {
        *pixel = [(k % 7) as f32, (k % 11) as f32, (k % 5) as f32, 1.0];
    }
    let pass = BrightPass { strength: 0.5, threshold: 1.0 };
    let gathered = |halvings| pass.source(&mut &picture, |pixel| *pixel, halvings).map(|[red, ..]| red);
    let (Ok(fine), Ok(coarse)) = (gathered(0), gathered(2));
    let whole = fine.halved().halved();
    assert_eq!((coarse.width, coarse.height), (513, 376));
    assert!(coarse.cells == whole.cells && !coarse.is_dark());
}

#[test]
fn light_below_the_threshold_and_cover_stay() {
    let mut picture = point(64, [0.4, 0.4, 0.4]);
    let before = picture.clone();
    spread(&Bloom::default(), &mut picture);
    assert_eq!(picture, before);
    let mut picture = point(64, [30.0, 30.0, 30.0]);
    spread(&Bloom::default(), &mut picture);
    let covered = |p: &Linear| p.pixels.iter().map(|p| p[3]).collect::<Vec<_>>();
    assert_eq!(covered(&picture), covered(&before));
    assert!(picture.pixels.iter().all(|p| p[0] >= 0.0));
    assert!(picture.pixels[(32 * 64 + 36) as usize][0] > 0.0, "nothing was spread");
}

#[test]
fn the_glow_is_round() {
    let mut picture = point(401, [1000.0; 3]);
    spread(&Bloom { streaks: 0, radius: 0.05, ..Bloom::default() }, &mut picture);
    let at = |x: i32, y: i32| picture.pixels[((200 + y) * 401 + 200 + x) as usize][1];
    for (x, y) in [(15, 20), (9, 12), (30, 40), (21, 28)] {
        let across = ((x * x + y * y) as f64).sqrt() as i32;
        let (slanting, straight) = (at(x, y), at(across, 0));
        // A diamond or a square would be off by more than half at this distance.
        assert!(
            (slanting / straight - 1.0).abs() < 0.12,
            "{across} cells out: {slanting} against {straight}"
        );
        assert!((at(-x, -y) / slanting - 1.0).abs() < 0.02);
    }
}

#[test]
fn rays_point_where_they_should_and_fade_alike() {
    let mut picture = point(601, [1e4; 3]);
    spread(&Bloom { streak_length: 0.05, ..Bloom::default() }, &mut picture);
    let ring = |angle: f64| {
        let (x, y) = (300.0 + 100.0 * angle.sin(), 300.0 - 100.0 * angle.cos());
        let near = |dx: i32, dy: i32| {
            picture.pixels[((y.round() as i32 + dy) * 601 + x.round() as i32 + dx) as usize][1]
        };
        let disc =
            (-5..=5).flat_map(|dy| (-5..=5).map(move |dx| (dx, dy))).filter(|(x, y)| x * x + y * y <= 25);
        disc.map(|(dx, dy)| near(dx, dy)).sum::<f32>()
    };
    let rays: Vec<f32> = (0..6).map(|k| ring(f64::from(k) * 60_f64.to_radians())).collect();
    let gap = ring(30_f64.to_radians());
    for ray in &rays {
        // A disc of pixels holds a little more of an upright ray.
        assert!((ray / rays[0] - 1.0).abs() < 0.08 && *ray > 3.0 * gap, "{rays:?}, between them {gap}");
    }
}

#[test]
fn the_same_light_gives_the_same_numbers_on_any_number_of_threads() {
    let on = |threads: usize| {
        let mut picture = point(200, [50.0, 70.0, 60.0]);
        picture.pixels[150] = [9.0, 8.0, 7.0, 1.0];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| spread(&Bloom::default(), &mut picture));
        picture
    };
    assert_eq!(on(1), on(3));
}
