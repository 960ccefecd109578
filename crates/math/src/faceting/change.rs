//! The differences between a surface and the convex solid that replaces it.

use super::deviation::outermost;
use crate::edges::Edges;
use crate::{Plane, Polytope, Surface};
use glam::DVec3;
use rayon::prelude::*;

/// Edges that bend inward by less than this are flat, in radians: 0.06 degrees.
const BENT: f64 = 1e-3;

/// The number of steps of the search for the deepest point of a triangle. Each step leaves 0.62 of the range, so all
/// of them leave a millionth.
const STEPS: usize = 30;

/// The differences between a convex solid and the surface that it was made from. Lengths are in the surface's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// The additional volume of the solid, as a part of the surface's volume.
    pub volume: f64,
    /// The depth of the deepest point of the surface below the solid's surface.
    pub deepest: f64,
    /// The number of edges of the surface that bend inward.
    pub bent: usize,
    /// The greatest angle between the normals beside one of these edges, in radians.
    pub sharpest: f64,
}

impl Change {
    /// Compares a closed surface with a solid that contains it, except for noise.
    pub fn of(surface: &Surface, solid: &Polytope) -> Self {
        let angles = bends(surface, BENT);
        Self {
            volume: solid.volume() / surface.volume() - 1.0,
            deepest: deepest(surface, solid),
            bent: angles.len(),
            sharpest: angles.into_iter().fold(0.0, f64::max),
        }
    }
}

impl Change {
    /// Returns the part of a surface's edges that bend inward by more than an angle, radians.
    pub(super) fn inward_part(surface: &Surface, least: f64) -> f64 {
        bends(surface, least).len() as f64 / (1.5 * surface.triangles.len() as f64)
    }
}

/// Returns the angles of the edges that bend inward by more than an angle, in radians.
fn bends(surface: &Surface, least: f64) -> Vec<f64> {
    let normal = |t: usize| surface.area_vector(t).normalize_or_zero();
    let sum = |t: usize| surface.corners(t).iter().sum::<DVec3>();
    let edges = Edges::of(surface);
    let bent = edges.pairs().filter_map(|(t, _, n)| {
        let (one, other) = (normal(t), normal(n));
        let angle = one.cross(other).length().atan2(one.dot(other));
        (angle > least && (other - one).dot(sum(n) - sum(t)) < 0.0).then_some(angle)
    });
    bent.collect()
}

/// Returns the greatest depth of a surface below the surface of a convex solid.
///
/// The depth of a point is its least distance from a plane, which is a concave function of the place. So it has one
/// greatest value within a triangle. An upper bound of this value is the greatest depth of the three corners below
/// the plane that is nearest to one of them.
fn deepest(surface: &Surface, solid: &Polytope) -> f64 {
    let planes: Vec<Plane> = solid.planes().collect();
    let depth = |point: DVec3| -outermost(&planes, point).1;
    let at: Vec<(usize, f64)> = surface.vertices.par_iter().map(|v| outermost(&planes, *v)).collect();
    let bound = |corners: &[u32; 3]| {
        let most = |plane: usize| {
            corners.iter().map(|&v| -planes[plane].distance(surface.vertices[v as usize])).fold(0.0, f64::max)
        };
        corners.iter().map(|&v| most(at[v as usize].0)).fold(f64::INFINITY, f64::min)
    };
    let mut bounds: Vec<(f64, usize)> =
        surface.triangles.iter().enumerate().map(|(t, corners)| (bound(corners), t)).collect();
    bounds.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut most = at.iter().map(|(_, distance)| -distance).fold(0.0, f64::max);
    for (bound, triangle) in bounds {
        if bound <= most {
            break;
        }
        let [a, b, c] = surface.corners(triangle);
        let along = |u: f64| greatest(|v| depth(a + u * (b - a) + (1.0 - u) * v * (c - a)));
        most = most.max(greatest(along));
    }
    most
}

/// Returns the greatest value of a concave function on 0 to 1, by golden section search.
fn greatest(of: impl Fn(f64) -> f64) -> f64 {
    let part = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = (0.0, 1.0);
    let (mut p, mut q) = (1.0 - part, part);
    let (mut at_p, mut at_q) = (of(p), of(q));
    for _ in 0..STEPS {
        if at_p > at_q {
            (high, q, at_q) = (q, p, at_p);
            p = high - part * (high - low);
            at_p = of(p);
        } else {
            (low, p, at_p) = (p, q, at_q);
            q = low + part * (high - low);
            at_q = of(q);
        }
    }
    at_p.max(at_q)
}
