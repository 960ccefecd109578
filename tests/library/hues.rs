//! Compares the hues along a cut through a rainbow: three wavelengths show three bands, unless each sample pass takes
//! others.

use brillianteer::base::{Stopped, unwatched};
use brillianteer::cut::{Glass, Sides};
use brillianteer::io::background::picture;
use brillianteer::math::{Plane, Polytope};
use brillianteer::optics::{Dispersion, Illuminant, Material, Strata};
use brillianteer::picture::{LUMINANCE, spectral::expose};
use brillianteer::scene::{BackgroundRef, Film, Instance, Light, Mipmap, Scene, View};
use brillianteer::trace::{
    environment::{Backplate, Environment, EnvironmentMap},
    ray::{ByRays, RayOptions},
    sampling::{LitScene, Sampling},
};
use glam::{DMat3, DVec2, DVec3};
use std::path::Path;

/// The number of pixels of the cut.
const PIXELS: u32 = 1024;

/// The least difference of two distinct hues, in degrees of CIELAB.
const GAP: f64 = 12.0;

/// The brightness below which no eye sees a pixel's hue, as a fraction of the brightest pixel.
const DIM: f64 = 0.02;

/// The matrix from linear sRGB to XYZ (IEC 61966-2-1).
const XYZ_FROM_SRGB: DMat3 =
    DMat3::from_cols_array(&[0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505]);

/// Traces the cut, a column of pixels from the slit up over the upper face of the prism.
fn cut(bands: (u32, u32), sampling: Sampling) -> Vec<DVec3> {
    let film = Film { centre: DVec2::new(0.0, 0.17), ..Film::new([1, PIXELS], 0.40 / f64::from(PIXELS)) };
    column(film, bands, sampling)
}

/// Traces a film with this number of bands of wavelengths and of shares of each band, where 0 stands for the middles
/// alone. The subject is a prism of rainbow soap in the dark, in front of the slit of `render prism --background slit`.
fn column(film: Film, bands: (u32, u32), sampling: Sampling) -> Vec<DVec3> {
    let prism = Glass::Prism(Sides { length: 100.0, width: 37.9, depth: 29.8, edge: 0.0 });
    let planes: Vec<Plane> = prism.planes().unwrap().into_iter().map(|(_, plane)| plane).collect();
    let mut material = Material::from_index("rainbow soap", 1.272).unwrap();
    material.dispersion = Dispersion::Abbe { n_d: 1.272, v_d: 2.0 };
    let stone = Instance::new(Polytope::from_planes(&planes).unwrap(), material);
    let scene = Scene { instances: vec![stone], metals: vec![], unit_mm: 20.0 };
    let slit = picture(&BackgroundRef::read("slit", Path::new("")).unwrap()).unwrap().unwrap().panorama;
    let slit = Mipmap::new(slit);
    shot((&scene, &slit), film, bands, sampling)
}

fn shot(
    (scene, slit): (&Scene, &Mipmap),
    film: Film,
    (wavelengths, shares): (u32, u32),
    sampling: Sampling,
) -> Vec<DVec3> {
    let dark = Light { dome: vec![], ..Light::white() };
    let (sky, view) = (EnvironmentMap::new(&dark, None), View::default());
    let behind = Backplate { picture: slit, distance: 0.75, width: 4.24 };
    let environment = Environment {
        map: &sky,
        basis: view.light_basis(),
        eye: view.basis(),
        head: 0.0,
        backplate: Some(behind),
        backdrop: true,
    };
    let options = RayOptions { polarised: true, most_bounces: 16, least_weight: 1e-4 };
    let lit_scene = LitScene { scene, environment, view: &view, film, options };
    let strata = match shares {
        0 => Strata::of_middles(wavelengths, &Illuminant::D65, true),
        _ => Strata::new(wavelengths, shares, &Illuminant::D65, true),
    };
    let prepare = |rows| Ok::<_, Stopped>(ByRays::new(lit_scene, rows));
    let (picture, _) = expose(&lit_scene, (&strata, sampling), PIXELS, prepare, &unwatched).unwrap();
    picture.pixels.iter().map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into())).collect()
}

/// Returns the hue in CIELAB, in degrees. Negative light is not cut off, so that colours outside every screen's range keep
/// their hue.
fn hue(colour: DVec3, white: f64) -> f64 {
    let xyz = XYZ_FROM_SRGB * colour / (XYZ_FROM_SRGB * DVec3::splat(white));
    let f = |t: f64| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    let [x, y, z] = xyz.to_array().map(f);
    (200.0 * (y - z)).atan2(500.0 * (x - y)).to_degrees().rem_euclid(360.0)
}

/// Returns the hues along a cut, in order; `None` where it is dark.
fn hues(cut: &[DVec3]) -> Vec<Option<f64>> {
    let brightness = |c: &DVec3| c.dot(DVec3::from_array(LUMINANCE.map(f64::from)));
    let most = cut.iter().map(brightness).fold(0.0, f64::max);
    assert!(most > 0.0, "no light");
    cut.iter().map(|c| (brightness(c) > DIM * most).then(|| hue(*c, most))).collect()
}

/// Returns the angle between two hues, in degrees.
fn apart(a: f64, b: f64) -> f64 {
    let difference = (a - b).abs();
    difference.min(360.0 - difference)
}

/// Counts distinct hues: takes one after the other, and leaves out those nearer than the gap to one that was taken.
fn distinct(hues: &[Option<f64>]) -> usize {
    let mut found: Vec<f64> = vec![];
    for &hue in hues.iter().flatten() {
        if found.iter().all(|&other| apart(hue, other) > GAP) {
            found.push(hue);
        }
    }
    found.len()
}

/// Returns the widest step of hue from one lit pixel to the next, and the number of dark gaps between lit pixels.
fn steps(hues: &[Option<f64>]) -> (f64, usize) {
    let pairs = || hues.windows(2);
    let step = pairs().filter_map(|w| Some(apart(w[0]?, w[1]?))).fold(0.0, f64::max);
    let lit =
        hues.iter().position(Option::is_some).unwrap()..=hues.iter().rposition(Option::is_some).unwrap();
    let dark = hues[lit].windows(2).filter(|w| w[0].is_some() && w[1].is_none()).count();
    (step, dark)
}

/// Returns the root mean square of the difference of two cuts, as a part of the root mean square of the other.
fn differ(cut: &[DVec3], other: &[DVec3]) -> f64 {
    let off: f64 = cut.iter().zip(other).map(|(a, b)| (*a - *b).length_squared()).sum();
    (off / other.iter().map(|c| c.length_squared()).sum::<f64>()).sqrt()
}

#[test]
fn three_wavelengths_show_three_hues_and_with_other_ones_in_each_pass_a_whole_rainbow() {
    let all = cut((64, 32), Sampling::of(32));
    let shown = [(3, 0), (8, 0), (16, 0), (16, 1), (3, 32), (16, 32)].map(|bands| {
        let own = cut(bands, Sampling::of(32));
        let (found, off) = (hues(&own), differ(&own, &all));
        let ((step, dark), mean) = (steps(&found), own.iter().sum::<DVec3>() / all.iter().sum::<DVec3>());
        let count = distinct(&found);
        println!(
            "{bands:?}: {count} hues, widest step {step:.1} degrees, {dark} gaps, {off:.4} off, mean {mean:.5}"
        );
        (count, step, dark, off, (mean - 1.0).abs().max_element())
    });
    let [three, eight, sixteen, whole, three_shared, sixteen_shared] = shown;
    assert_eq!((three.0, three.2), (3, 2), "three lines, apart");
    assert!(eight.0 > 3 && sixteen.0 >= 12 && sixteen.2 < three.2, "nearly a whole rainbow: {shown:?}");
    assert!(whole.0 > 20 && whole.1 < GAP && whole.2 == 0, "whole strata blend into one another: {whole:?}");
    for shared in [three_shared, sixteen_shared] {
        assert!(shared.0 > 20 && shared.1 < GAP && shared.3 < 0.02, "as smooth: {shared:?}");
        assert!(shared.4 < 2e-3, "the mean is that of the spectrum: {shared:?}");
    }
}

#[test]
fn pixels_of_a_rainbow_have_little_noise_with_three_wavelengths() {
    // A column through both rainbows of the guide's picture, with its pixels.
    let film = Film::new([1, 240], 2.12 / 640.0);
    let of = |bands, samples: u32, stretches| {
        column(film, (bands, samples), Sampling { stretches, ..Sampling::of(samples) })
    };
    let off = [32, 64].map(|samples| {
        let all = of(64, samples, true);
        [true, false].map(|stretches| differ(&of(3, samples, stretches), &all))
    });
    println!("32 and 64 samples, with stretches and without: {off:.4?}");
    assert!(off.iter().all(|[own, points]| own < points) && off[0][0] < 0.02 && off[1][0] < 0.012, "{off:?}");
}

#[test]
fn no_strength_at_all_leaves_the_slit_where_it_is_and_full_strength_is_physics() {
    let at = |strength| {
        let cut = cut((8, 4), Sampling { strength, ..Sampling::of(4) });
        let lit: Vec<usize> = (0..cut.len()).filter(|&k| cut[k].y > 0.2).collect();
        (lit.first().copied(), lit.len())
    };
    // The cut begins above the slit, whose image is moved up less and less.
    let moved = [1.0, 0.5, 0.2].map(at);
    assert!(moved[0].1 > 0 && moved[0].0 < moved[1].0 && moved[1].0 < moved[2].0, "{moved:?}");
    let (straight, bare) =
        (cut((8, 1), Sampling { strength: 0.0, ..Sampling::of(4) }), cut((8, 4), Sampling::of(4)));
    // Without refraction each pixel shows the slit behind it, in one colour except for what the faces reflect.
    assert!(
        straight.iter().all(|c| (c.max_element() - c.min_element()).abs() < 0.05 * c.max_element() + 1e-6)
    );
    assert!(bare.iter().any(|c| (c.max_element() - c.min_element()).abs() > 0.05));
}
