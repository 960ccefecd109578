//! Parity of glass shapes: value, gradient and bend of their functions, on the card and in the library.

use super::super::fields::field;
use super::super::gpu_types;
use super::super::imports::joined;
use super::{card, run};
use brillianteer_math::{ImplicitForm, ImplicitSurface, Jet};
use glam::{DMat3, DVec3};

/// A shader that takes points, each with the number of its shape, and returns the function's gradient and value there
/// and its bend along each axis.
const JETS_WGSL: &str = "
@group(0) @binding(0) var<storage, read> given: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> found: array<array<vec4f, 4>>;
@group(0) @binding(2) var<storage, read> fields: array<ImplicitSurface>;

@compute @workgroup_size(64)
fn jets(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    let shape = fields[u32(given[id.x].w)];
    let p = given[id.x].xyz;
    let jet = jet_at(shape, p, vec3f(0.0));
    found[id.x] = array<vec4f, 4>(
        vec4f(jet.gradient, jet.value),
        vec4f(bend(shape, p, vec3f(1.0, 0.0, 0.0)), 0.0),
        vec4f(bend(shape, p, vec3f(0.0, 1.0, 0.0)), 0.0),
        vec4f(bend(shape, p, vec3f(0.0, 0.0, 1.0)), 0.0),
    );
}
";

/// Returns a shape of every form, sharp and rounded.
fn shapes() -> Vec<ImplicitSurface> {
    let plate = |edge, amplitude, wavelength| ImplicitForm::Plate {
        size: DVec3::new(1.7, 1.6, 0.3),
        edge,
        amplitude,
        wavelength,
        phase: 0.7,
    };
    let forms = [
        ImplicitForm::Pill { size: DVec3::splat(1.5), edge: 0.75 },
        ImplicitForm::Pill { size: DVec3::new(2.0, 0.575, 0.8), edge: 0.155 },
        ImplicitForm::Pill { size: DVec3::new(0.6, 1.8, 0.8), edge: 0.0 },
        ImplicitForm::Block { size: DVec3::splat(1.15), edge: 0.22 },
        ImplicitForm::Block { size: DVec3::new(0.5, 1.15, 1.65), edge: 0.0 },
        ImplicitForm::Prism { size: DVec3::new(1.965, 0.745, 0.585), edge: 0.0 },
        ImplicitForm::Prism { size: DVec3::new(1.6, 0.9, 0.8), edge: 0.15 },
        plate(0.0, 0.1, 1.5),
        plate(0.1, 0.02, 0.4),
    ];
    forms.into_iter().map(|form| ImplicitSurface::new(form).unwrap()).collect()
}

/// Returns the function's gradient and value, and the change of the unit normal along each axis, all in units of the
/// shape's reach. The point `p` is in those units as well.
fn jet(shape: &ImplicitSurface, p: DVec3) -> ([f64; 4], DMat3) {
    let reach = shape.reach();
    let Jet { value, gradient, hessian } = shape.jet(p * reach);
    let (value, hessian) = (value / reach, hessian * reach);
    let n = gradient.normalize_or_zero();
    let within = DMat3::IDENTITY - DMat3::from_cols(n * n.x, n * n.y, n * n.z);
    (gradient.extend(value).to_array(), within * hessian * within * gradient.length().recip())
}

/// Returns points slightly inside or outside the surface all around, in units of its reach. For a sharp shape all
/// points are inside: outside, the library's function is the distance from an edge, and the card's is the distance
/// from the edge's faces.
fn points(shape: &ImplicitSurface) -> impl Iterator<Item = DVec3> + '_ {
    let is_sharp = shape.parts().edge == 0.0;
    (0..2000).filter_map(move |k| {
        let z: f64 = 1.0 - 2.0 * (f64::from(k) + 0.5) / 2000.0;
        let turn = 2.399_963 * f64::from(k);
        let out = DVec3::new((1.0 - z * z).sqrt() * turn.cos(), (1.0 - z * z).sqrt() * turn.sin(), z);
        let reach = shape.reach();
        let point = out * (2.0 * reach - shape.entry(out * (2.0 * reach), -out)?);
        let off = 0.02 * turn.sin();
        Some(point / reach + shape.normal(point) * if is_sharp { -off.abs() } else { off })
    })
}

#[test]
fn glass_has_the_same_value_gradient_and_bend_on_the_card() {
    let Some(gpu) = card("glass_has_the_same_value_gradient_and_bend_on_the_card") else { return };
    let shapes = shapes();
    let given: Vec<(usize, DVec3)> =
        shapes.iter().enumerate().flat_map(|(k, shape)| points(shape).map(move |p| (k, p))).collect();
    let narrow: Vec<[f32; 4]> = given.iter().map(|&(k, p)| gpu_types::with(p, k as f64)).collect();
    let told: Vec<gpu_types::ImplicitSurface> = shapes.iter().map(field).collect();
    let text = joined(&["jets"]) + JETS_WGSL;
    let found: Vec<[[f32; 4]; 4]> = run(&gpu, text, &narrow, Some(bytemuck::cast_slice(&told)));
    let (mut value, mut gradient, mut bend, mut compared) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
    for ((&(k, _), narrow), found) in given.iter().zip(&narrow).zip(&found) {
        let p = DVec3::new(narrow[0].into(), narrow[1].into(), narrow[2].into());
        let (own, bent) = jet(&shapes[k], p);
        let apart = |a: DMat3, b: DMat3| (0..3).map(|i| a.col(i).distance(b.col(i))).fold(0.0, f64::max);
        // Where two pieces of a surface meet, rounding decides which of them is taken.
        let beside = DVec3::AXES.into_iter().flat_map(|a| [a, -a]).map(|a| jet(&shapes[k], p + a * 1e-6));
        let size = 1.0 + apart(bent, DMat3::ZERO);
        if beside.into_iter().any(|(_, b)| apart(b, bent) > 0.01 * size) {
            continue;
        }
        compared += 1;
        let found = found.map(|row| row.map(f64::from));
        value = value.max((found[0][3] - own[3]).abs());
        gradient = (0..3).map(|i| (found[0][i] - own[i]).abs()).fold(gradient, f64::max);
        let columns = [1, 2, 3].map(|i| DVec3::new(found[i][0], found[i][1], found[i][2]));
        let [x, y, z] = columns;
        bend = bend.max(apart(DMat3::from_cols(x, y, z), bent) / size);
    }
    assert!(compared * 10 > given.len() * 9, "{compared} of {} compared", given.len());
    // Coordinates reach 1 and are rounded to 6e-8; a gradient changes by up to 20 over a unit, and a bend by that squared.
    assert!(
        value < 1e-6 && gradient < 1e-5 && bend < 1e-4,
        "value {value:e}, gradient {gradient:e}, bend {bend:e}"
    );
}
