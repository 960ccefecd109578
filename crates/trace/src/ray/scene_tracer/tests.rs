use super::*;
use crate::ray::RayOptions;
use brillianteer_math::{Plane, Polytope, Pose};
use brillianteer_optics::Material;
use brillianteer_scene::Instance;
use glam::DVec3;

/// Returns a cube of side 2 with this index, whose middle lies at this height.
fn cube(index: f64, height: f64) -> Instance {
    let planes: Vec<Plane> =
        DVec3::AXES.iter().flat_map(|&a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)]).collect();
    let cube =
        Instance::new(Polytope::from_planes(&planes).unwrap(), Material::from_index("glass", index).unwrap());
    cube.moved(&Pose { at: DVec3::Z * height, ..Pose::STILL })
}

/// Returns the bounces of a ray from above that runs down through all stones.
fn bounces(stones: &[Instance], most_bounces: u32) -> u32 {
    let options = RayOptions { most_bounces, ..RayOptions::default() };
    let medium = |stone: &Instance| Medium::clear(stone.material.index(550.0));
    let tracer = SceneTracer {
        tracers: InstanceTracer::of_all(stones, options, medium),
        metals: vec![],
        least_weight: options.least_weight,
    };
    let start = WaitingRay::from_eye(DispersedRay::new(DVec3::new(0.1, 0.2, 9.0), DVec3::NEG_Z));
    tracer.follow(&start, &tracer.first(&start).unwrap(), |_| ()).bounces
}

#[test]
fn bounces_are_those_of_the_longest_way_through_all_stones() {
    let (air, glass) = (|height| cube(1.0, height), |height| cube(1.5, height));
    assert_eq!((bounces(&[air(0.0)], 5), bounces(&[glass(0.0)], 5)), (1, 5));
    // All light leaves air at its first bounce.
    assert_eq!((bounces(&[air(3.0), glass(0.0)], 5), bounces(&[glass(0.0), air(3.0)], 5)), (6, 6));
    // The light runs down through both cubes, bounces four times in the glass, and runs up through both cubes again.
    assert_eq!(bounces(&[air(6.0), air(3.0), glass(0.0)], 5), 8);
}
