//! Compares beams with rays, point by point: two tracers that share nothing but Fresnel's equations and the stone.

use crate::common::*;
use brillianteer::math::{Plane, contains};
use brillianteer::scene::{Lean, Medium, Side, Stone, View};
use brillianteer::trace::{
    beam::{Beam, Beams},
    ray::{Camera, Exit, RayOptions, StoneTracer},
};
use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;

/// The distance from an edge of a beam within which points are left out, in girdle radii: such a point may be seen on
/// either side of the edge.
const NEAR_EDGE: f64 = 1e-6;

/// The result of comparing beams and rays over a grid of points.
#[derive(Debug, Default)]
struct Comparison {
    compared: u32,
    near_edge: u32,
    /// The largest differences in the weight of an exit, in its direction and in the path up to it.
    weight: f64,
    direction: f64,
    path: f64,
}

impl Comparison {
    fn agrees(&self) -> bool {
        let worst = self.weight.max(self.direction).max(self.path);
        self.compared > 100 && self.near_edge * 100 <= self.compared && worst < 1e-8
    }
}

fn compare(beams: &Beams, stone: &Stone, view: &View, medium: Medium) -> Comparison {
    let options = RayOptions { most_bounces: 200, least_weight: 0.0, polarised: beams.polarised };
    let tracer = StoneTracer::new(&stone.polytope, medium, options);
    let camera = Camera::new(view, &stone.polytope);
    let mut children: Vec<Vec<u32>> = vec![vec![]; beams.len()];
    for beam in beams.iter() {
        if let Some(parent) = beam.parent {
            children[parent as usize].push(beam.id);
        }
    }
    let mut result = Comparison::default();
    for k in 0..400_u32 {
        let p = (DVec2::new(0.754_877_666, 0.569_840_29) * f64::from(k + 1)).fract() * 2.0 - 1.0;
        let (origin, direction) = camera.ray(p);
        let mut exits: Vec<Exit> = vec![];
        if tracer.follow(origin, direction, |exit| exits.push(exit)).is_none() {
            continue;
        }
        let Some(chain) = chain(beams, &children, p) else {
            result.near_edge += 1;
            continue;
        };
        result.compared += 1;
        for (exit, (expected, weight, path)) in exits.iter().zip(chain) {
            result.weight = result.weight.max((exit.weight - weight).abs());
            result.path = result.path.max((exit.path - path).abs());
            result.direction = result.direction.max((exit.direction - expected).length());
        }
    }
    result
}

/// Returns the exits of the beams at a point, as directions, weights and paths, in order; `None` near an edge.
fn chain(beams: &Beams, children: &[Vec<u32>], p: DVec2) -> Option<Vec<(DVec3, f64, f64)>> {
    let roots: Vec<u32> = beams.iter().filter(Beam::is_surface).map(|b| b.id).collect();
    let inside = |among: &[u32], q: DVec2| {
        among.iter().copied().find(|&id| contains(beams.get(id).outline, q, NEAR_EDGE))
    };
    for copy in beams.symmetry.copies() {
        let q = copy.transpose() * p;
        let Some(root) = inside(&roots, q) else { continue };
        let (mut exits, mut at) = (vec![], root);
        loop {
            let beam = beams.get(at);
            if beam.weight > 0.0 {
                exits.push((turned(beams, copy, beam.exit), pointwise(beams, &beam, q), beam.path.at(q)));
            }
            if children[at as usize].is_empty() {
                return Some(exits);
            }
            at = inside(&children[at as usize], q)?;
        }
    }
    None
}

/// Returns a direction as it is in a copy of the picture's domain.
fn turned(beams: &Beams, copy: DMat2, direction: DVec3) -> DVec3 {
    let view = beams.view;
    view.lift(copy * view.project(direction)) + view.toward * view.toward.dot(direction)
}

/// Returns a beam's weight at a point: its mean weight, with the absorption along the ray through this point.
fn pointwise(beams: &Beams, beam: &Beam, q: DVec2) -> f64 {
    let medium = beams.medium;
    if medium.is_clear() {
        return beam.weight;
    }
    let mean_of = |a| brillianteer::math::integral_of_decay(beam.outline, beam.path * a) / beam.area;
    let mean = medium.absorption.map(mean_of).iter().sum::<f64>() / 2.0;
    beam.weight / mean * medium.transmittance(beam.path.at(q))
}

fn views() -> [View; 5] {
    let face_up = View::default();
    [
        face_up,
        View { side: Side::Culet, ..face_up },
        View { tilt: 0.17, azimuth: 0.3, ..face_up },
        View { lean: Lean::Eye, tilt: 0.45, azimuth: 2.0, ..face_up },
        View { side: Side::Culet, tilt: 0.25, azimuth: 4.0, ..face_up },
    ]
}

#[test]
fn beams_and_rays_agree_on_every_cut_file_between_planes() {
    let view = View { tilt: 0.17, azimuth: 0.3, ..View::default() };
    let medium = Medium { absorption: [0.1, 0.5], ..Medium::clear(1.77) };
    cut_files().par_iter().for_each(|(name, path)| {
        let stone = stone(path);
        let beams = traced(&stone, medium, &view, 0.05, true);
        let result = compare(&beams, &stone, &view, medium);
        assert!(result.agrees(), "{name}: {result:?}");
    });
}

#[test]
fn beams_and_rays_agree_on_round_brilliants_in_several_tilts_and_materials() {
    for (name, path) in round_brilliants() {
        let stone = stone(&path);
        for view in views() {
            for (medium, polarised) in [
                (Medium::clear(2.4175), true),
                (Medium::clear(1.544), false),
                (Medium { absorption: [0.1, 0.5], ..Medium::clear(1.77) }, true),
            ] {
                let beams = traced(&stone, medium, &view, 0.02, polarised);
                let result = compare(&beams, &stone, &view, medium);
                assert!(result.agrees(), "{name}, {view:?}, {medium:?}: {result:?}");
            }
        }
    }
}

#[test]
fn the_comparison_sees_every_small_change() {
    let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 96));
    let (view, medium) = (View { tilt: 0.17, azimuth: 0.3, ..View::default() }, Medium::clear(2.4175));
    let beams = traced(&stone, medium, &view, 0.02, true);
    assert!(compare(&beams, &stone, &view, medium).agrees());

    assert!(!compare(&beams, &stone, &view, Medium::clear(2.4176)).agrees(), "another index");
    let absorbing = Medium { absorption: [1e-4; 2], ..medium };
    assert!(!compare(&beams, &stone, &view, absorbing).agrees(), "a trace of absorption");
    let tilted = View { tilt: 0.1701, ..view };
    assert!(!compare(&beams, &stone, &tilted, medium).agrees(), "another tilt");
    let mut mixed = traced(&stone, medium, &view, 0.02, false);
    mixed.polarised = true;
    assert!(!compare(&mixed, &stone, &view, medium).agrees(), "polarisation forgotten");

    let mut planes: Vec<Plane> = stone.polytope.planes().collect();
    planes[3].offset += 1e-4;
    assert!(!compare(&beams, &nameless(&planes), &view, medium).agrees(), "one facet moved");
}
