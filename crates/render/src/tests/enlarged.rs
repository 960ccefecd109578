//! Rough pictures in full size.

use super::*;
use brillianteer_trace::ray::SceneProbe;

#[test]
fn a_rough_picture_is_enlarged_with_fine_outlines_and_a_fine_background() {
    let mut fine = several_lit();
    let stripes = (0..64 * 64).map(|k| [if k % 8 < 4 { 0.1 } else { 0.9 }; 3]).collect();
    let picture = Arc::new(Mipmap::new(Panorama { width: 64, height: 64, pixels: stripes }));
    fine.film = Film::square(72, 2.0);
    let Product::Light(product) = &mut fine.product else { panic!("no picture under light") };
    (product.steps, product.wavelengths) = (Steps::Glance { first: 0 }, 16);
    product.surroundings.shows_light = true;
    product.surroundings.backplate =
        Some(HungPicture { picture, span: 1.0, distance: 3.0, frame: fine.film });
    fine.quality = Quality { tracer: Wanted::Rays, samples: Some(1), ..fine.quality };
    let taken = |film: Film| lit(&Job { film, ..fine.clone() });
    let (rough_film, true_picture) =
        (Film { size: [24, 24], pixel: 3.0 * fine.film.pixel, ..fine.film }, taken(fine.film));
    let rough = taken(rough_film);
    let large = fine.enlarged(&rough, (&rough_film, DVec2::splat(0.5))).unwrap();
    let probe = SceneProbe::new(&fine.lit().unwrap());
    let (mut beside, mut off, mut off_blocks) = (0, 0.0, 0.0);
    for k in 0..72 * 72 {
        let (x, y) = (k % 72, k / 72);
        let [exact, enlarged] = [&true_picture, &large].map(|picture| picture.pixels[k]);
        let block = rough.pixels[y / 3 * 24 + x / 3];
        let gap =
            |light: [f32; 4]| (0..3).map(|c| f64::from((light[c] - exact[c]).abs().min(1.0))).sum::<f64>();
        assert_eq!(enlarged[3], exact[3], "{x}, {y}");
        if probe.through(x as f64 + 0.5, y as f64 + 0.5).is_none() {
            beside += 1;
            assert!(gap(enlarged) < 1e-5, "{x}, {y}: {enlarged:?} is not {exact:?}");
        }
        (off, off_blocks) = (off + gap(enlarged), off_blocks + gap(block));
    }
    assert!(beside > 1000 && off < 0.5 * off_blocks, "{beside} beside, {off} of {off_blocks}");
    // A picture of the same size stays as it is, but for rounding.
    let same = fine.enlarged(&true_picture, (&fine.film, DVec2::splat(0.5))).unwrap();
    let most = same.pixels.iter().flatten().zip(true_picture.pixels.iter().flatten());
    assert!(most.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) < 0.01);
}
