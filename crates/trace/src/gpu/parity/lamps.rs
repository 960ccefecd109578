//! Parity of lamps: the share of a fan that lies inside one, on the card and in the library.

use super::super::imports::joined;
use super::{card, run};
use crate::environment::share_inside;
use glam::DVec3;

/// A shader that takes the x and y of the vector from a lamp's middle and of the fan, and returns the share of the
/// fan inside the lamp. The z of both vectors is half of x.
const SHARE_WGSL: &str = "
const MOST_LAMPS: u32 = 1u;
const TEXEL_ANGLE: f32 = 1.0;

@group(0) @binding(0) var<storage, read> given: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> found: array<f32>;

@compute @workgroup_size(64)
fn shares(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    let g = given[id.x];
    found[id.x] = share_inside(vec3f(g.xy, 0.5 * g.x), vec3f(g.zw, 0.5 * g.z), CHORD_SQUARED);
}
";

/// The chord from a lamp's middle to its edge: a radius of 1.1 degrees.
const CHORD: f64 = 0.02;

#[test]
fn lamps_are_as_bright_on_the_card_however_far_a_fan_reaches() {
    let Some(gpu) = card("lamps_are_as_bright_on_the_card_however_far_a_fan_reaches") else { return };
    // Fans of 1e-5 to 1e4 radians that pass a lamp's middle at up to 1.2 chords, somewhere on their way.
    let given: Vec<[f32; 4]> = (0..20_000)
        .map(|k| {
            let part = |step: f64| (f64::from(k) * step).fract();
            let length = 10_f64.powf(9.0 * part(0.819_172_513) - 5.0);
            let beside = CHORD * 1.2 * (2.0 * part(0.671_043_607) - 1.0);
            let along = (CHORD + 0.5 * length) * (2.0 * part(0.549_700_478) - 1.0);
            let (sin, cos) = f64::from(k).sin_cos();
            // The unit vectors of the plane in which z is half of x.
            let ([x, y], [u, v]) = ([cos * 0.8_f64.sqrt(), sin], [-sin * 0.8_f64.sqrt(), cos]);
            [x * beside + u * along, y * beside + v * along, u * length, v * length].map(|n| n as f32)
        })
        .collect();
    let chord = format!("const CHORD_SQUARED: f32 = {};\n", CHORD * CHORD);
    let text = joined(&["environment"]) + &chord + SHARE_WGSL;
    let found: Vec<f32> = run(&gpu, text, &given, None);
    // The largest difference for short fans, and the light of all fans by their length.
    let (mut largest, mut light) = (0.0_f64, [[0.0; 2]; 9]);
    for (given, found) in given.iter().zip(found) {
        let [x, y, u, v] = given.map(f64::from);
        let (from, fan) = (DVec3::new(x, y, 0.5 * x), DVec3::new(u, v, 0.5 * u));
        let (exact, found) = (share_inside(from, fan, CHORD * CHORD), f64::from(found));
        // Differences are compared with the share of a fan through the middle.
        let most = (2.0 * CHORD / fan.length()).min(1.0);
        if fan.length() < 1.0 {
            largest = largest.max((found - exact).abs() / most);
        }
        let [all, of_card] = &mut light[(fan.length().log10() + 5.0).clamp(0.0, 8.0) as usize];
        (*all, *of_card) = (*all + exact / most, *of_card + found / most);
    }
    // Where a fan touches the lamp, the root of a number near 0 has half its digits.
    assert!(largest < 0.01, "off by {largest:e}");
    for [all, of_card] in light {
        assert!(all > 500.0 && (of_card / all - 1.0).abs() < 0.02, "{of_card} for {all}: {light:?}");
    }
}
