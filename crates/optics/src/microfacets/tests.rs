//! The laws of rough metal, each with a comparison that fails.

use super::*;
use crate::Metal;

/// A metal that reflects all but a hundred-millionth of the light.
const PERFECT: Complex64 = Complex64::new(1.0, 1e9);

fn rough(roughness: f64) -> Arc<Roughness> {
    Arc::new(Roughness::new(roughness))
}

fn toward(cos: f64, azimuth: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).sqrt();
    DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos)
}

/// Returns numbers that fill the unit cube evenly.
fn luck(k: u32) -> [f64; 3] {
    let steps = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_939_7];
    steps.map(|step| (0.5 + step * f64::from(k)).fract())
}

/// Returns the mean of the light that a surface reflects along `out`, from light that depends on its direction.
fn sampled(metal: &RoughMetal, out: DVec3, light: impl Fn(DVec3) -> f64) -> f64 {
    let count = 120_000;
    let of = |k| metal.sample(out, luck(k)).map_or(0.0, |found| found.weight * light(found.direction));
    (0..count).map(of).sum::<f64>() / f64::from(count)
}

/// Returns the same by adding up the surface's value over the half sphere.
fn added_up(metal: &RoughMetal, out: DVec3, light: impl Fn(DVec3) -> f64) -> f64 {
    let (rings, around) = (400, 400);
    let cell = |k: u32| {
        let (i, j) = (f64::from(k % rings) + 0.5, f64::from(k / rings) + 0.5);
        let from = toward((i / f64::from(rings)).sqrt(), TAU * j / f64::from(around));
        // Rings of equal light: the cosine is in their widths.
        metal.value(out, from) * light(from)
    };
    (0..rings * around).map(cell).sum::<f64>() * std::f64::consts::PI / f64::from(rings * around)
}

#[test]
fn a_surface_that_absorbs_nothing_returns_all_light_whatever_its_roughness() {
    for roughness in [0.0, 0.1, 0.3, 0.6, 1.0] {
        let surface = rough(roughness);
        let metal = surface.of_metal(PERFECT);
        for cos in [0.02, 0.1, 0.4, 0.8, 1.0] {
            let returned = sampled(&metal, toward(cos, 0.7), |_| 1.0);
            assert!((returned - 1.0).abs() < 5e-3, "{roughness} {cos}: {returned}");
            // A single reflection alone loses light that the bound would notice.
            if roughness >= 0.6 && cos < 0.5 {
                assert!(surface.once(cos) < 0.97, "{roughness} {cos}: {}", surface.once(cos));
            }
        }
    }
}

#[test]
fn a_plate_returns_of_even_light_what_fresnel_returns_on_average() {
    for (name, metal) in Metal::NAMES {
        for nm in [450.0, 650.0] {
            let index = metal.index(nm);
            let mean =
                (0..2000).map(|k| unpolarised(((f64::from(k) + 0.5) / 2000.0).sqrt(), index)).sum::<f64>()
                    / 2000.0;
            let albedo = |roughness: f64| {
                let surface = rough(roughness);
                let metal = surface.of_metal(index);
                let even = |k: u32| toward(((f64::from(k) + 0.5) / 40.0).sqrt(), f64::from(k));
                (0..40).map(|k| sampled(&metal, even(k), |_| 1.0)).sum::<f64>() / 40.0
            };
            assert!((albedo(0.0) - mean).abs() < 1e-3, "{name} {nm}");
            assert!((albedo(0.2) - mean).abs() < 8e-3, "{name} {nm}: {} {mean}", albedo(0.2));
            // Light that is reflected several times is absorbed several times.
            let rough = albedo(1.0);
            assert!(rough < mean + 4e-3 && rough > mean.powi(3), "{name} {nm}: {rough} {mean}");
            assert!(mean > 0.9 || rough < mean - 4e-3, "{name} {nm}: {rough} {mean}");
        }
    }
}

#[test]
fn two_directions_can_be_exchanged() {
    for roughness in [0.2, 0.5, 1.0] {
        let surface = rough(roughness);
        let metal = surface.of_metal(Metal::Gold.index(520.0));
        for k in 0..200 {
            let [a, b, c] = luck(k);
            let (one, other) = (toward(0.05 + 0.95 * a, 0.0), toward(0.05 + 0.95 * b, TAU * c));
            let (there, back) = (metal.value(one, other), metal.value(other, one));
            assert!((there - back).abs() <= 1e-12 * there, "{there} {back}");
            // With the cosine of one side it is not the same.
            assert!((one.z - other.z).abs() < 1e-3 || (there * one.z - back * other.z).abs() > 1e-9 * there);
        }
    }
}

#[test]
fn what_is_drawn_is_what_the_value_says() {
    let light = |from: DVec3| 0.3 + from.x.max(0.0) + 2.0 * from.y * from.y + from.z;
    for roughness in [0.4, 0.7, 1.0] {
        let surface = rough(roughness);
        let metal = surface.of_metal(Metal::Gold.index(500.0));
        for cos in [0.3, 0.7, 0.98] {
            let out = toward(cos, 0.4);
            let (drawn, added) = (sampled(&metal, out, light), added_up(&metal, out, light));
            assert!((drawn / added - 1.0).abs() < 6e-3, "{roughness} {cos}: {drawn} {added}");
            let other = rough(0.6 * roughness);
            let mutant = added_up(&other.of_metal(Metal::Gold.index(500.0)), out, |from| light(from).powi(2));
            let own = added_up(&metal, out, |from| light(from).powi(2));
            assert!((mutant / own - 1.0).abs() > 6e-3, "{roughness} {cos}: {mutant} {own}");
        }
    }
}

#[test]
fn directions_are_of_length_1_above_the_surface_and_weights_are_bounded() {
    for roughness in [0.0, 0.05, 0.3, 1.0] {
        let surface = rough(roughness);
        let metal = surface.of_metal(PERFECT);
        for k in 0..20_000 {
            let [a, b, _] = luck(k);
            let Some(found) = metal.sample(toward(1e-6 + a * (1.0 - 2e-6), TAU * b), luck(7 * k + 1)) else {
                continue;
            };
            assert!((found.direction.length() - 1.0).abs() < 1e-9 && found.direction.z > 0.0);
            assert!(found.weight.is_finite() && (0.0..=8.0).contains(&found.weight), "{found:?}");
            assert!(found.density > 0.0, "{found:?}");
        }
    }
}

#[test]
fn surfaces_of_one_roughness_are_made_once() {
    let first = Roughness::shared(0.3217);
    assert!(Arc::ptr_eq(&first, &Roughness::shared(0.3217)));
    assert!(!Arc::ptr_eq(&first, &Roughness::shared(0.3218)));
    assert_eq!((first.once(0.4), first.once_mean), {
        let own = Roughness::new(0.3217);
        (own.once(0.4), own.once_mean)
    });
}
