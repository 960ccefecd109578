//! Tests that a picture is the same to the bit, however its work is divided into dispatches.

use super::gpu_types::RadiancePixel;
use super::parity::card;
use super::shaders::ShaderSurface;
use super::throttle::Throttle;
use super::{ByCard, Gpu, GpuEnvironment, ScopePixel};
use crate::ScopeShot;
use crate::environment::{Environment, EnvironmentMap};
use crate::ray::RayOptions;
use crate::sampling::{LitScene, ProgressiveImage, SamplePass};
use brillianteer_base::unwatched;
use brillianteer_cut::{Design, Family, MaterialRef};
use brillianteer_math::{ShadedMesh, ShadedSurface};
use brillianteer_optics::{Illuminant, Metal, Strata};
use brillianteer_scene::{ASET_CONE, Backing, Film, Light, MetalInstance, Scene, Scope, Specimen, View};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// No side is a multiple of a tile's.
const SIZE: [u32; 2] = [61, 45];
const TILES: u32 = 8 * 6;
const BANDS: u32 = 5;
const PASSES: u32 = 2;

/// The ways to divide work: the throttle that a picture begins with, and the most bands of a dispatch.
fn divisions() -> [(Throttle, u32); 5] {
    [
        // The ways are: all work at once; tile by tile and band by band; twice as much each time, with two sets of
        // bands; one part, and then tile by tile.
        (Throttle::new(f64::INFINITY, 1e18), BANDS),
        (Throttle::new(0.0, 1.0), 1),
        (Throttle::new(f64::INFINITY, 1.0), BANDS),
        (Throttle::new(f64::INFINITY, 1.0), 2),
        (Throttle::new(0.0, 3e6), 3),
    ]
}

type Broken = Box<dyn std::error::Error>;

fn specimen(family: &str) -> Specimen {
    let design = Design {
        name: family.to_owned(),
        source: None,
        notes: None,
        material: MaterialRef::Name("diamond".to_owned()),
        diameter_mm: 6.5,
        cut: Family::of_key(family).unwrap().first.clone(),
    };
    Specimen::new(design).unwrap()
}

/// Returns an open leaf of gold under a stone, wider than it.
fn leaf() -> MetalInstance {
    let points = [[-2.0, -2.1], [2.2, -1.9], [0.1, 2.3]].map(|[x, y]| DVec3::new(x, y, -1.0)).to_vec();
    let surface = ShadedSurface { points, corners: vec![[0, 1, 2]], normals: vec![] };
    MetalInstance::new(&Arc::new(ShadedMesh::new(surface).unwrap()), Metal::Gold)
}

fn options() -> RayOptions {
    RayOptions { polarised: true, most_bounces: 6, least_weight: 1e-4 }
}

/// Returns the options of a picture in which metal sends light back. Software drivers end a shader's loops after 65,535
/// turns, and a dispatch of all bands must stay below that, so little light is followed.
fn options_with_metal() -> RayOptions {
    RayOptions { least_weight: 0.02, ..options() }
}

/// Traces a picture under light, divided in one way, with the first pass at this place in its pixels. Returns the
/// bits of its pixels and the number of dispatches.
fn lit(
    gpu: &Gpu,
    (scene, surface, map): (&Scene, ShaderSurface, &EnvironmentMap),
    (throttle, bands): (Throttle, u32),
    shift: f64,
) -> (Vec<u32>, u32) {
    let view = View { tilt: 0.2, ..View::default() };
    let (basis, eye) = (view.light_basis(), view.basis());
    let environment = Environment { map, basis, eye, head: 0.0, backplate: None, backdrop: true };
    let film = Film::new(SIZE, 0.05);
    let options = if scene.metals.is_empty() { options() } else { options_with_metal() };
    let lit_scene = LitScene { scene, environment, view: &view, film, options };
    let around = GpuEnvironment::new(gpu, &environment).unwrap();
    let mut image = ByCard::new(gpu, &lit_scene, &around, 0..SIZE[1], BANDS as usize).unwrap();
    *gpu.lights.kernel(&gpu.device, surface, !scene.metals.is_empty()).throttle() = throttle;
    image.stage.bands_at_once = bands;
    gpu.take_totals();
    for number in 0..PASSES {
        let strata = Strata::new(BANDS, 1, &Illuminant::D65, true);
        let mut pass = SamplePass::new(scene, &strata, number);
        pass.shift += DVec2::splat(shift);
        let added: Result<(), Broken> = image.add_pass(&pass, &unwatched);
        added.unwrap();
    }
    let bits = |pixels: &[RadiancePixel]| bytemuck::cast_slice(pixels).to_vec();
    (image.stage.read(SIZE[1], bits).unwrap(), gpu.take_totals().count)
}

fn in_scope(gpu: &Gpu, specimen: &Specimen, throttle: Throttle, per_side: u32) -> (Vec<u32>, u32) {
    let shot = ScopeShot {
        solid: specimen.body.solid(),
        medium: specimen.medium(589.3),
        view: &View::default(),
        scope: &Scope::aset(ASET_CONE, Backing::Black),
        film: Film::new(SIZE, 0.05),
        per_side,
        shift: DVec2::splat(0.5),
        options: options(),
    };
    *gpu.scopes.kernel(&gpu.device, ShaderSurface::Few, false).throttle() = throttle;
    gpu.take_totals();
    let mut bits = vec![];
    let taken = gpu.scope::<Broken>(&shot, &unwatched, |_, pixels: &[ScopePixel]| {
        bits.extend_from_slice(bytemuck::cast_slice(pixels));
        Ok(())
    });
    taken.unwrap();
    (bits, gpu.take_totals().count)
}

#[test]
fn pictures_under_light_are_the_same_to_the_bit_however_they_are_divided() {
    let Some(gpu) = card("pictures_under_light_are_the_same_to_the_bit_however_they_are_divided") else {
        return;
    };
    let map = EnvironmentMap::new(&Light::lamps_on_dome(), None);
    for (family, surface, metals) in [
        ("round_brilliant", ShaderSurface::Few, vec![]),
        ("plate", ShaderSurface::Wavy, vec![]),
        ("round_brilliant", ShaderSurface::Few, vec![leaf()]),
    ] {
        let scene = Scene { metals, ..Scene::alone(&specimen(family)) };
        let of_shift = |shift: f64| {
            let [whole, others @ ..] =
                divisions().map(|division| lit(&gpu, (&scene, surface, &map), division, shift));
            assert_eq!(whole.1, PASSES);
            let lit = whole.0.iter().filter(|&&bits| bits != 0).count();
            assert!(lit > whole.0.len() / 4, "{family} is empty");
            for (k, (bits, count)) in others.into_iter().enumerate() {
                assert!(count > PASSES && count <= TILES * BANDS * PASSES, "{count} dispatches");
                assert!(bits == whole.0, "{family}, {shift}: division {k} of {count} dispatches");
            }
            whole.0
        };
        // The second comparison is of rays through other places in their pixels.
        assert!(of_shift(0.0) != of_shift(0.23), "{family}: the comparison notices nothing");
    }
}

#[test]
fn pictures_in_a_scope_are_the_same_to_the_bit_however_they_are_divided() {
    let Some(gpu) = card("pictures_in_a_scope_are_the_same_to_the_bit_however_they_are_divided") else {
        return;
    };
    let specimen = specimen("round_brilliant");
    let [whole, others @ ..] = divisions().map(|(throttle, _)| in_scope(&gpu, &specimen, throttle, 2));
    assert_eq!(whole.1, 4);
    for (bits, count) in others {
        assert!(count > whole.1 && count <= 4 * TILES, "{count} dispatches");
        assert!(bits == whole.0, "divided into {count} dispatches");
    }
    assert!(in_scope(&gpu, &specimen, divisions()[0].0.clone(), 1).0 != whole.0);
}
