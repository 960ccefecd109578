//! Parity of metal in pictures: the card and the rays in f64 give the same light between metal and stones, pixel by
//! pixel.

use super::super::limits::{MOST_METALS, MOST_ROUGHNESSES};
use super::super::{ByCard, Gpu, GpuEnvironment, GpuError};
use super::card;
use crate::environment::{Environment, EnvironmentMap};
use crate::ray::{ByRays, PathLight, RayOptions};
use crate::sampling::{LitScene, ProgressiveImage, RadiancePixel, SamplePass, Sampling};
use crate::solids::heart;
use crate::solids::torus;
use brillianteer_base::{Stopped, unwatched};
use brillianteer_math::{
    ImplicitForm, ImplicitSurface, Plane, Polytope, Pose, ShadedMesh, ShadedSurface, Surface, TriangleMesh,
};
use brillianteer_optics::{Absorption, Material, Metal, Strata};
use brillianteer_scene::{Body, Film, Instance, Light, MetalInstance, Scene, View};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// Pixels along each side of a picture.
const SIZE: u32 = 48;

/// Pixels along each side of the blocks whose means are compared.
const BLOCK: u32 = 8;

type Broken = Box<dyn std::error::Error>;

/// A scene and the settings of its picture.
pub(super) struct ParityShot {
    pub scene: Scene,
    pub light: Light,
    pub view: View,
    pub passes: u32,
    pub wavelengths: u32,
    pub by_chance: f64,
    pub backdrop: bool,
    pub is_polarised: bool,
}

impl ParityShot {
    /// Returns a picture of a scene under a ring of light, seen at a tilt, in one pass of polarised light.
    pub fn of(scene: Scene) -> Self {
        Self {
            scene,
            light: Light { head: 0.0, ..Light::ring() },
            view: View { tilt: 0.4, azimuth: 0.3, ..View::default() },
            passes: 1,
            wavelengths: 3,
            by_chance: 0.0,
            backdrop: false,
            is_polarised: true,
        }
    }

    pub fn with<T>(&self, work: impl FnOnce(&LitScene) -> T) -> T {
        let (map, view) = (EnvironmentMap::new(&self.light, None), self.view);
        let (basis, eye) = (view.light_basis(), view.basis());
        let backdrop = self.backdrop;
        let environment = Environment { map: &map, basis, eye, head: 0.0, backplate: None, backdrop };
        let options = RayOptions { polarised: self.is_polarised, most_bounces: 64, least_weight: 1e-4 };
        let film = Film::square(SIZE, 1.1);
        work(&LitScene { scene: &self.scene, environment, view: &view, film, options })
    }

    fn pass(&self, number: u32) -> SamplePass {
        let strata = Strata::new(self.wavelengths, 1, &self.light.spectrum, true);
        let sampling = Sampling { by_chance: self.by_chance, ..Sampling::of(self.passes) };
        sampling.pass(&self.scene, &strata, number)
    }

    /// Adds the passes to a picture and returns its pixels.
    fn taken<E>(&self, mut image: impl ProgressiveImage<E>) -> Vec<RadiancePixel>
    where
        E: From<Stopped> + std::fmt::Debug,
    {
        for number in 0..self.passes {
            image.add_pass(&self.pass(number), &unwatched).unwrap();
        }
        let mut pixels = vec![];
        image.each_pixel(&mut |pixel| pixels.push(*pixel)).unwrap();
        pixels
    }

    pub fn by_rays(&self) -> Vec<RadiancePixel> {
        self.with(|lit_scene| self.taken::<Stopped>(ByRays::in_f64(*lit_scene, 0..SIZE)))
    }

    /// Returns the pixels of the first pass where `carry` makes other light of all light that goes to another body.
    pub fn by_rays_with(&self, carry: fn(PathLight) -> Option<PathLight>) -> Vec<RadiancePixel> {
        self.with(|lit_scene| ByRays::in_f64(*lit_scene, 0..SIZE).seen_with(&self.pass(0), carry))
    }

    pub fn by_card(&self, gpu: &Gpu) -> Vec<RadiancePixel> {
        self.with(|lit_scene| {
            let around = GpuEnvironment::new(gpu, &lit_scene.environment).unwrap();
            let image = ByCard::new(gpu, lit_scene, &around, 0..SIZE, self.wavelengths as usize).unwrap();
            self.taken::<Broken>(image)
        })
    }
}

/// A change of a scene.
type Change = fn(&mut Scene);

/// Returns an open square plate with sides along x and y.
fn plate(half: f64) -> Arc<ShadedMesh> {
    let points = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let points = points.map(|point| point * half).to_vec();
    let surface = ShadedSurface { points, corners: vec![[0, 1, 2], [0, 2, 3]], normals: vec![] };
    Arc::new(ShadedMesh::new(surface).unwrap())
}

fn of(mesh: &Arc<ShadedMesh>, metal: Metal, roughness: f64, pose: Pose) -> MetalInstance {
    MetalInstance { roughness, pose, ..MetalInstance::new(mesh, metal) }
}

/// A rotation that keeps edges and walls away from the axes, where rounding would decide.
pub(super) fn askew() -> DQuat {
    DQuat::from_rotation_x(0.13) * DQuat::from_rotation_y(-0.21) * DQuat::from_rotation_z(0.17)
}

/// Returns a glass with this index that absorbs, by its coefficient for both polarisations, per mm.
pub(super) fn dark(index: f64, per_mm: f64) -> Material {
    let mut material = Material::from_index("glass", index).unwrap();
    material.absorption = [(); 2].map(|()| Absorption::new(vec![(550.0, per_mm)]).unwrap());
    material
}

/// Returns an octahedron with a table, which the ring cuts into.
pub(super) fn gem() -> Polytope {
    let sides = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| DVec3::new(x, y, z))));
    let sides = sides.into_iter().flatten().flatten().map(|n| Plane::new(n / n.length(), 0.6));
    let planes: Vec<Plane> = sides.chain([Plane::new(DVec3::Z, 0.4)]).collect();
    Polytope::from_planes(&planes).unwrap()
}

fn band(is_smooth: bool) -> Arc<ShadedMesh> {
    Arc::new(torus((0.95, 0.25), (96, 48), is_smooth))
}

/// Returns a stone in a ring that cuts into it, above an open plate that mirrors on both sides, and a smaller ring of
/// the same mesh beside them.
fn ring(body: impl Into<Body>, roughness: f64) -> ParityShot {
    let pose = |at: DVec3, scale: f64| Pose { at, turn: askew(), scale };
    let stone = Instance { pose: pose(DVec3::ZERO, 0.7), ..Instance::new(body, dark(1.8, 0.05)) };
    let band = band(true);
    let metals = vec![
        of(&band, Metal::Gold, roughness, pose(DVec3::ZERO, 0.7)),
        of(&plate(1.0), Metal::Silver, 0.0, pose(DVec3::new(0.0, 0.0, -0.55), 1.0)),
        of(&band, Metal::Platinum, 0.5, pose(DVec3::new(0.75, 0.6, 0.2), 0.25)),
    ];
    ParityShot::of(Scene { instances: vec![stone], metals, unit_mm: 3.25 })
}

/// The differences between two pictures of one scene.
#[derive(Debug)]
pub(super) struct Differences {
    /// The share of pixels, of those that see anything, that differ by more than a hundredth of the brightest.
    pub pixels: f64,
    /// The share of them that differ by more than 1e-4 of the brightest.
    pub fine: f64,
    /// The largest difference of a block's mean, as a part of the brightest block.
    pub blocks: f64,
    /// The differences of the shares that were absorbed and not followed to their ends.
    rest: [f64; 2],
}

pub(super) fn differences(exact: &[RadiancePixel], card: &[RadiancePixel]) -> Differences {
    let scale = exact.iter().map(|p| p.colour.max_element()).fold(0.0, f64::max);
    let pairs = || exact.iter().zip(card).filter(|(a, b)| a.cover > 0.0 || b.cover > 0.0);
    let count = pairs().count() as f64;
    let share_beyond = |part: f64| {
        let far = |(a, b): &(&RadiancePixel, &RadiancePixel)| {
            (a.colour - b.colour).abs().max_element() > part * scale
        };
        pairs().filter(far).count() as f64 / count
    };
    let across = SIZE / BLOCK;
    let block = |pixels: &[RadiancePixel], k: u32| {
        let own = (0..SIZE * SIZE).filter(|at| at / SIZE / BLOCK * across + at % SIZE / BLOCK == k);
        own.map(|at| pixels[at as usize].colour).sum::<DVec3>()
    };
    let blocks = (0..across * across).map(|k| (block(exact, k), block(card, k)));
    let (most, off) = blocks.fold((0.0_f64, 0.0_f64), |(most, off), (a, b)| {
        (most.max(a.max_element()), off.max((a - b).abs().max_element()))
    });
    let sum = |of: fn(&RadiancePixel) -> f64| pairs().map(|(a, b)| of(b) - of(a)).sum::<f64>() / count;
    Differences {
        pixels: share_beyond(0.01),
        fine: share_beyond(1e-4),
        blocks: off / most,
        rest: [sum(|p| p.absorbed), sum(|p| p.unresolved)],
    }
}

/// The greatest share of pixels that may differ. Curved metal, like glass shapes, spreads neighbouring rays apart,
/// and their rounding errors with them. Where the card meets another edge or decides a chance otherwise, the whole
/// pixel changes.
const LEFT_OUT: f64 = 0.02;

pub(super) fn assert_same(name: &str, found: &Differences) {
    assert!(found.pixels < LEFT_OUT && found.blocks < 0.01, "{name}: {found:?}");
    assert!(found.rest.iter().all(|rest| rest.abs() < 2e-3), "{name}: {found:?}");
}

pub(super) fn compared(shot: &ParityShot, gpu: &Gpu) -> Differences {
    differences(&shot.by_rays(), &shot.by_card(gpu))
}

#[test]
fn light_between_metal_and_a_stone_is_that_of_the_rays_on_the_card() {
    let Some(gpu) = card("light_between_metal_and_a_stone_is_that_of_the_rays_on_the_card") else { return };
    for (roughness, by_chance) in [(0.0, 0.0), (0.1, 0.0), (0.4, 0.1)] {
        let shot = ParityShot { by_chance, backdrop: by_chance > 0.0, ..ring(gem(), roughness) };
        let found = compared(&shot, &gpu);
        assert_same(&format!("roughness {roughness}"), &found);
    }
}

#[test]
fn the_comparison_of_metal_sees_every_change() {
    let Some(gpu) = card("the_comparison_of_metal_sees_every_change") else { return };
    let base = || ring(gem(), 0.3);
    let exact = base().by_rays();
    assert_same("no change", &differences(&exact, &base().by_card(&gpu)));
    let changes: [(&str, Change); 7] = [
        ("metal", |s| s.metals[0].metal = Metal::Silver),
        ("roughness", |s| s.metals[0].roughness = 0.35),
        ("a mirror's roughness", |s| s.metals[1].roughness = 0.2),
        ("smooth normals", |s| s.metals[0].mesh = band(false)),
        ("a place", |s| s.metals[1].pose.at.z -= 0.02),
        ("a body less", |s| drop(s.metals.pop())),
        ("absorption", |s| s.instances[0].material = dark(1.8, 0.3)),
    ];
    for (name, change) in changes {
        let mut mutant = base();
        change(&mut mutant.scene);
        let found = differences(&exact, &mutant.by_card(&gpu));
        assert!(found.pixels > 1.5 * LEFT_OUT, "{name}: {found:?}");
    }
}

#[test]
fn metal_stands_on_the_card_beside_every_kind_of_solid_and_alone() {
    let Some(gpu) = card("metal_stands_on_the_card_beside_every_kind_of_solid_and_alone") else { return };
    let (vertices, triangles) = heart();
    let heart = Arc::new(TriangleMesh::new(Surface::new(vertices, triangles)).unwrap());
    // There are more planes than the uniform array takes, so the stone is packed as triangles.
    let many: Vec<Plane> = (0..400)
        .map(|i| {
            let z: f64 = 1.0 - 2.0 * (f64::from(i) + 0.5) / 400.0;
            Plane::from_slope(z.acos(), 2.399_963 * f64::from(i), 0.7)
        })
        .collect();
    let form = ImplicitForm::Block { size: DVec3::splat(1.0), edge: 0.2 };
    let bodies: [(&str, Body); 3] = [
        ("a heart", heart.into()),
        ("many planes", Polytope::from_planes(&many).unwrap().into()),
        ("a cube", ImplicitSurface::new(form).unwrap().into()),
    ];
    for (name, body) in bodies {
        let shot = ParityShot { wavelengths: 1, passes: 4, ..ring(body, 0.3) };
        let found = compared(&shot, &gpu);
        // For light that has left a mesh or a shape, the random numbers of single pixels differ.
        assert!(found.blocks < 0.05, "{name}: {found:?}");
        assert!(found.rest.iter().all(|rest| rest.abs() < 5e-3), "{name}: {found:?}");
    }
    let mut alone = ring(gem(), 0.3);
    alone.scene.instances.clear();
    assert_same("no stone", &compared(&alone, &gpu));
}

#[test]
fn metal_beyond_the_limits_of_a_card_is_refused_and_does_not_lose_it() {
    let Some(gpu) = card("metal_beyond_the_limits_of_a_card_is_refused_and_does_not_lose_it") else { return };
    let of_many = |count: usize, roughness: fn(usize) -> f64| {
        let (mut shot, small) = (ring(gem(), 0.3), plate(0.1));
        let body = |k| of(&small, Metal::Gold, roughness(k), Pose::STILL);
        shot.scene.metals = (0..count).map(body).collect();
        shot.with(|lit_scene| {
            let around = GpuEnvironment::new(&gpu, &lit_scene.environment).unwrap();
            ByCard::new(&gpu, lit_scene, &around, 0..8, 3).err()
        })
    };
    let (count, most) = (MOST_METALS + 1, MOST_METALS);
    assert_eq!(of_many(count, |_| 0.1), Some(GpuError::TooManyMetals { count, most }));
    let (count, most) = (MOST_ROUGHNESSES + 1, MOST_ROUGHNESSES);
    let found = of_many(count, |k| k as f64 / 100.0);
    assert_eq!(found, Some(GpuError::TooManyRoughnesses { count, most }));
    assert_eq!(of_many(MOST_METALS, |k| (k % MOST_ROUGHNESSES) as f64 / 100.0), None);
}
