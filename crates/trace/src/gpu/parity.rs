//! Tests of the shaders against their twins in Rust. Without a card, they check that the shaders are valid; with one,
//! that both give the same numbers.

mod glass;
mod lamps;
mod metal;
mod polarised;
mod rings;

use super::Gpu;
use super::gpu_types;
use super::imports::joined;
use super::pane::pane_source;
use super::peak::{ARITHMETIC_WGSL, MEMORY_WGSL};
use super::shaders::{ShaderSurface, ShaderTask, compiled, source};
use crate::coherency::{Coherency, s_axis};
use brillianteer_optics::{Incidence, fresnel, reflect, refract};
use glam::DVec3;
use std::io::Write;
use wgpu::naga::{self, front, valid};

/// Returns the fields of a struct of a shader with their places in bytes, and the size of the struct.
fn layout<'a>(module: &'a naga::Module, name: &str) -> (Vec<(&'a str, usize)>, usize) {
    let found = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name));
    let Some(naga::TypeInner::Struct { members, span }) = found.map(|(_, t)| &t.inner) else {
        panic!("no struct {name}");
    };
    let place = |m: &'a naga::StructMember| (m.name.as_deref().unwrap_or_default(), m.offset as usize);
    (members.iter().map(place).collect(), *span as usize)
}

/// Checks that a shader lays out structs as Rust does.
macro_rules! assert_laid_out {
    ($module:ident: $($name:ident),+) => {$(
        let own = (gpu_types::$name::PLACES.to_vec(), size_of::<gpu_types::$name>());
        assert_eq!(layout(&$module, stringify!($name)), own);
    )+};
}

#[test]
fn every_shader_is_valid_and_its_structs_are_laid_out_as_in_rust() {
    let kinds = [(ShaderTask::Scope, false), (ShaderTask::Light, false), (ShaderTask::Light, true)];
    for (facets, (reading, has_metal)) in
        ShaderSurface::ALL.into_iter().flat_map(|f| kinds.map(|kind| (f, kind)))
    {
        let text = source(facets, reading, has_metal);
        let module = front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        let mut validator =
            valid::Validator::new(valid::ValidationFlags::all(), valid::Capabilities::empty());
        validator.validate(&module).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        assert_laid_out!(module: Frame, Body, Medium);
        if facets == ShaderSurface::Many {
            assert_laid_out!(module: Cluster);
        }
        if facets == ShaderSurface::Triangles || has_metal {
            assert_laid_out!(module: Triangle, BvhNode);
        }
        if matches!(facets, ShaderSurface::Smooth | ShaderSurface::Wavy) {
            assert_laid_out!(module: ImplicitSurface);
        }
        if has_metal {
            assert_laid_out!(module: Finish);
        }
        if reading == ShaderTask::Scope {
            assert_laid_out!(module: Bands, ScopePixel);
        } else {
            assert_laid_out!(module: Environment, Lamp, Response, RadiancePixel);
        }
    }
}

#[test]
fn the_shaders_that_measure_a_card_or_draw_panes_are_valid() {
    for text in [ARITHMETIC_WGSL, MEMORY_WGSL, &pane_source()] {
        let module = front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
        let mut validator =
            valid::Validator::new(valid::ValidationFlags::all(), valid::Capabilities::empty());
        validator.validate(&module).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
        if text.contains("PaneData") {
            assert_laid_out!(module: PaneData);
        }
    }
}

#[test]
fn a_cards_peak_is_beyond_what_a_tenth_of_a_core_does() {
    let Some(gpu) = card("a_cards_peak_is_beyond_what_a_tenth_of_a_core_does") else { return };
    let peak = gpu.peak().unwrap();
    // Above these bounds, a compiler has optimised the work away.
    assert!((1e8..1e15).contains(&peak.flops), "{peak:?}");
    assert!((1e7..1e14).contains(&peak.bytes_per_second), "{peak:?}");
    assert!(peak.launch_s > 0.0 && peak.launch_s < 1.0, "{peak:?}");
    // No dispatch of these measurements belongs to a picture.
    assert_eq!(gpu.take_totals().count, 0);
}

/// A shader that takes rays at a surface, as (cos_i, eta, turn of the axes, unused), and returns all results of the
/// optics for each.
const MEETING_WGSL: &str = "
@group(0) @binding(0) var<storage, read> given: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> found: array<array<vec4f, 9>>;

const OF_D = vec3f(0.03, -0.01, 0.02);
const OF_N = vec3f(0.02, 0.04, 0.0);

@compute @workgroup_size(64)
fn meeting(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    let cos_i = given[id.x].x;
    let eta = given[id.x].y;
    let c = cos(given[id.x].z);
    let s = sin(given[id.x].z);
    let f = fresnel(cos_i, eta);
    let sin_i = sqrt(max(1.0 - cos_i * cos_i, 0.0));
    let d = vec3f(sin_i, 0.0, -cos_i);
    let n = vec3f(0.0, 0.0, 1.0);
    let before = vec3f(0.0, 1.0, 0.0);
    let light = turned_to(Coherency(0.6, 0.25, 0.1, -0.2), before * c + cross(d, before) * s, before, d);
    let up = reflected(light, f);
    let on = transmitted(light, f);
    found[id.x] = array<vec4f, 9>(
        vec4f(f.r_s, f.r_p),
        vec4f(reflect_ray(d, n, cos_i), f.cos_t),
        vec4f(refract_ray(d, n, eta, cos_i, f.cos_t), 0.0),
        // Near the critical angle the change grows beyond what f32 holds.
        vec4f(refracted_change(d, n, eta, cos_i, f.cos_t, OF_D, OF_N, 0.05) * f.cos_t * f.cos_t, 0.0),
        vec4f(reflected_change(d, n, OF_D, OF_N), 0.0),
        vec4f(light.ss, light.pp, light.re, light.im),
        vec4f(up.ss, up.pp, up.re, up.im),
        vec4f(on.ss, on.pp, on.re, on.im),
        vec4f(s_axis(vec3f(sin_i * c, sin_i * s, -cos_i), n, vec3f(0.6, -0.8, 0.0)), weight_of(on)),
    );
}
";

/// Computes the same with the library, in f64.
fn meeting(cos_i: f64, eta: f64, turn: f64) -> [[f64; 4]; 9] {
    let f = fresnel(cos_i, eta);
    let sin_i = (1.0 - cos_i * cos_i).max(0.0).sqrt();
    let (d, n) = (DVec3::new(sin_i, 0.0, -cos_i), DVec3::Z);
    let cos_t = f.cos_t_or_zero();
    let (back, onward) = (reflect(d, n, cos_i), refract(d, n, eta, (cos_i, cos_t)));
    let (of_d, of_n) = (DVec3::new(0.03, -0.01, 0.02), DVec3::new(0.02, 0.04, 0.0));
    let incidence = Incidence { direction: d, normal: n, cos_i, of_direction: of_d, of_normal: Some(of_n) };
    let moved = incidence.refracted_change(eta, 0.05, cos_t.max(1e-9)) * cos_t * cos_t;
    let mirrored = incidence.reflected_change();
    let (sin, cos) = turn.sin_cos();
    let before = DVec3::Y;
    let light = Coherency { ss: 0.6, pp: 0.25, re: 0.1, im: -0.2 };
    let light = light.turned_to(before * cos + d.cross(before) * sin, before, d);
    let (up, on) = (light.reflected(&f), light.transmitted(&f));
    let s = s_axis(DVec3::new(sin_i * cos, sin_i * sin, -cos_i), n, DVec3::new(0.6, -0.8, 0.0));
    let of_vector = |v: DVec3, last: f64| [v.x, v.y, v.z, last];
    let of_light = |light: Coherency| [light.ss, light.pp, light.re, light.im];
    [
        [f.r_s.re, f.r_s.im, f.r_p.re, f.r_p.im],
        of_vector(back, cos_t),
        of_vector(onward, 0.0),
        of_vector(moved, 0.0),
        of_vector(mirrored, 0.0),
        of_light(light),
        of_light(up),
        of_light(on),
        of_vector(s, on.weight()),
    ]
}

/// The rows of results that are undefined where reflection is total and no ray is refracted.
const OF_REFRACTED: [usize; 2] = [2, 3];

#[test]
fn the_shaders_optics_are_those_of_the_library() {
    let Some(gpu) = card("the_shaders_optics_are_those_of_the_library") else { return };
    let etas = [1.0 / 2.4175, 0.75, 1.33, 1.77, 2.4175, 2.9];
    let given: Vec<[f32; 4]> =
        (0..6000).map(|k| [(k / 6) as f32 / 999.0, etas[k % 6], 0.001 * k as f32, 0.0]).collect();
    let text = joined(&["optics"]) + MEETING_WGSL;
    let found = run(&gpu, text, &given, None);
    // The tolerance is the error of the root of 1e-3 in f32.
    let (count, largest) = compared(&given, &found, 1.0);
    assert!(count > 5900 && largest < 5e-5, "{count} compared, off by {largest:e}");
    let mutant = compared(&given, &found, 1.001).1;
    assert!(mutant > 1e-3, "another index makes only {mutant:e}");
    let of_square_on =
        found.iter().zip(&given).filter(|(_, given)| given[0] == 1.0).map(|(found, _)| found[8]);
    assert_eq!(of_square_on.filter(|s| s[..3] == [0.6, -0.8, 0.0]).count(), etas.len());
}

/// Compares the card's results with the exact ones at `factor` times the index. Returns the number of comparisons and
/// the largest difference.
fn compared(given: &[[f32; 4]], found: &[[[f32; 4]; 9]], factor: f64) -> (u32, f64) {
    let (mut compared, mut largest) = (0, 0.0_f64);
    for (given, found) in given.iter().zip(found) {
        let [cos_i, eta, turn, _] = given.map(f64::from);
        let eta = eta * factor;
        let squared = (1.0 - eta * eta) + (eta * cos_i).powi(2);
        // The root of a number near 0 has few digits in f32.
        if squared.abs() < 1e-3 {
            continue;
        }
        let exact = meeting(cos_i, eta, turn);
        let both = found.iter().zip(&exact).enumerate();
        let meant = both.filter(|(row, _)| squared > 0.0 || !OF_REFRACTED.contains(row));
        let meant = meant.flat_map(|(_, (found, exact))| found.iter().zip(exact));
        largest = meant.map(|(a, b)| (f64::from(*a) - b).abs()).fold(largest, f64::max);
        compared += 1;
    }
    (compared, largest)
}

/// Opens the card. Where there is none, it reports that the test is skipped, or panics if a card is required.
pub(super) fn card(test: &str) -> Option<Gpu> {
    match Gpu::open() {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_some() => panic!("{test}: {error}"),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "SKIPPED {test}: {error}");
            None
        }
    }
}

/// Runs a shader with one entry point on each set of four numbers, with other data where it needs them, and returns
/// its results.
fn run<T: bytemuck::Pod>(gpu: &Gpu, text: String, given: &[[f32; 4]], other: Option<&[u8]>) -> Vec<T> {
    let device = &gpu.device;
    let pipeline = compiled(device, text);
    let input = gpu.buffer("given", bytemuck::cast_slice(given), wgpu::BufferUsages::STORAGE);
    let size = (given.len() * size_of::<T>()) as u64;
    let buffer = |usage| {
        device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    };
    let output = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let back = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let other = other.map(|bytes| gpu.buffer("other", bytes, wgpu::BufferUsages::STORAGE));
    let buffers = [Some(&input), Some(&output), other.as_ref()];
    let entries: Vec<_> = buffers
        .into_iter()
        .flatten()
        .enumerate()
        .map(|(k, b)| wgpu::BindGroupEntry { binding: k as u32, resource: b.as_entire_binding() })
        .collect();
    let bound = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bound, &[]);
        pass.dispatch_workgroups(given.len().div_ceil(64) as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&output, 0, &back, 0, size);
    gpu.queue.submit([encoder.finish()]);
    back.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.wait().expect("the card does its work");
    let mapped = back.get_mapped_range(..).expect("mapped");
    bytemuck::pod_collect_to_vec(&mapped)
}
