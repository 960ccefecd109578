//! Parity of metal: random numbers and what rough surfaces reflect, on the card and in the library.

use super::super::imports::joined;
use super::{card, run};
use brillianteer_math::random_bits::{mixed, unit};
use brillianteer_optics::{Metal, RoughMetal, Roughness};
use glam::DVec3;
use num_complex::Complex64;

/// A shader that takes directions as (cosine to the eye, three random numbers), and returns the samples that metal
/// draws from them. The number of the invocation selects the metal. The tables of the surfaces come first in
/// `roughnesses`, then the finishes.
const SAMPLES_WGSL: &str = "
var<private> turns: u32;

@group(0) @binding(0) var<storage, read> given: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> found: array<array<vec4u, 3>>;
@group(0) @binding(2) var<storage, read> roughnesses: array<vec4f>;

@compute @workgroup_size(64)
fn samples(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    let g = given[id.x];
    let finish = finish_of(roughnesses[SURFACES * ROUGHNESS_ROWS + id.x % FINISHES]);
    let out = vec3f(sqrt(1.0 - g.x * g.x), 0.0, g.x);
    let drawn = sample_metal(finish, out, g.yzw);
    let bits = mixed_bits(vec2u(id.x, 77u * id.x));
    found[id.x] = array<vec4u, 3>(
        bitcast<vec4u>(vec4f(drawn.direction, drawn.weight)),
        vec4u(bits, bitcast<u32>(unit_of_bits(bits)), turns),
        bitcast<vec4u>(vec4f(drawn.solid_angle, 0.0, 0.0, 0.0)),
    );
}
";

const ROUGHNESS: [f64; 5] = [0.0, 0.1, 0.25, 0.6, 1.0];

fn metals(index_factor: f64) -> Vec<(RoughMetal, [f64; 4])> {
    let surfaces = ROUGHNESS.map(Roughness::shared);
    let of = |(k, surface): (usize, &std::sync::Arc<Roughness>)| {
        Metal::NAMES.map(|(_, metal)| {
            let index = metal.index(450.0 + 37.0 * k as f64) * Complex64::new(index_factor, 0.0);
            let metal = surface.of_metal(index);
            let finish = [index.re, index.im, metal.again(), k as f64];
            (metal, finish)
        })
    };
    surfaces.iter().enumerate().flat_map(of).collect()
}

/// Returns the greatest differences of direction, of weight and of the root of the solid angle, each as a part of its
/// value, between the card's and the library's metal, and the number of samples that were compared. The library's
/// index is multiplied by `index_factor`.
fn compared(given: &[[f32; 4]], found: &[[[u32; 4]; 3]], index_factor: f64) -> ([f64; 3], usize) {
    let metals = metals(index_factor);
    let (mut largest, mut count) = ([0.0_f64; 3], 0);
    for (k, (given, found)) in given.iter().zip(found).enumerate() {
        let [cos, u, v, w] = given.map(f64::from);
        let out = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
        let drawn = |off: f64| metals[k % metals.len()].0.sample(out, [u - off, v, w + off]);
        // Where the library's result depends on the last digits of f32, nothing can be compared.
        let (Some(own), Some(beside)) = (drawn(0.0), drawn(1e-6)) else { continue };
        if own.direction.distance(beside.direction) > 1e-3
            || (own.weight - beside.weight).abs() > 1e-3 * own.weight
        {
            continue;
        }
        let [x, y, z, weight] = found[0].map(|bits| f64::from(f32::from_bits(bits)));
        let angle = f64::from(f32::from_bits(found[2][0]));
        let exact = (1.0 / own.density).min(4.0 * std::f64::consts::PI);
        let off = [
            own.direction.distance(DVec3::new(x, y, z)),
            (weight - own.weight).abs() / own.weight,
            (angle.sqrt() - exact.sqrt()).abs() / exact.sqrt().max(1e-12),
        ];
        count += 1;
        largest.iter_mut().zip(off).for_each(|(most, off)| *most = most.max(off));
    }
    (largest, count)
}

#[test]
fn metal_reflects_on_the_card_as_in_the_library() {
    let Some(gpu) = card("metal_reflects_on_the_card_as_in_the_library") else { return };
    let given: Vec<[f32; 4]> = (0..20_000_u32)
        .map(|k| {
            let part = |step: f64| ((f64::from(k) + 0.5) * step).fract() as f32;
            [0.03 + 0.97 * part(0.754_877), 0.99 * part(0.819_172), part(0.671_043), part(0.549_700)]
        })
        .collect();
    let rows = ROUGHNESS.map(Roughness::shared);
    let tables = rows.iter().flat_map(|surface| surface.rows());
    let finishes = metals(1.0).into_iter().map(|(_, finish)| finish);
    let other: Vec<[f32; 4]> = tables.chain(finishes).map(|row| row.map(|x| x as f32)).collect();
    let text = format!(
        "const ROUGHNESS_ROWS: u32 = {}u;\nconst SURFACES: u32 = {}u;\nconst FINISHES: u32 = {}u;\n{}{SAMPLES_WGSL}",
        Roughness::ROWS,
        ROUGHNESS.len(),
        metals(1.0).len(),
        joined(&["random", "microfacets"]),
    );
    let found: Vec<[[u32; 4]; 3]> = run(&gpu, text, &given, Some(bytemuck::cast_slice(&other)));
    for (k, row) in (0_u64..).zip(&found) {
        let bits = mixed((77 * k) << 32 | k);
        assert_eq!([row[1][0], row[1][1]], [bits as u32, (bits >> 32) as u32], "{k}");
        assert!((f64::from(f32::from_bits(row[1][2])) - unit(bits)).abs() < 1e-7);
    }
    // Some light has met several mirrors, and some has not.
    let several = found.iter().filter(|row| row[1][3] > 0).count();
    assert!((200..10_000).contains(&several), "{several}");
    let ([direction, weight, angle], count) = compared(&given, &found, 1.0);
    assert!(count > 17_000, "{count} compared");
    assert!(direction < 1e-3 && weight < 2e-3 && angle < 5e-3, "{direction:e} {weight:e} {angle:e}");
    let mutant = compared(&given, &found, 1.05).0[1];
    assert!(mutant > 2e-2, "another index makes only {mutant:e}");
}
