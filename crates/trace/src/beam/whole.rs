//! Decides whether a beam lands as a whole on one facet, as most beams do. All neighbours of the facet are tried side
//! by side.
//!
//! The processor's abilities are detected when the program runs. The code has no closures, because closures would not
//! be compiled for the wider instructions; with them it took twice as long as a search corner by corner. Sums are not
//! fused, so that the result does not depend on the processor.

use super::split::{GRAZING, Ray, SAME};
use crate::lanes::{Vec3s, dot, splat};
use brillianteer_math::{Affine, Plane, Polytope};
use glam::{DVec2, DVec3};
use pulp::{Arch, Simd, WithSimd};

/// The most planes that any processor tries at once.
const WIDEST: usize = 8;

/// The planes around each facet, coordinate by coordinate. Whole rows are filled up with zero normals, toward which
/// no ray runs.
#[derive(Debug, Clone)]
pub(super) struct FacetNeighbours {
    normal: [Vec<f64>; 3],
    offset: Vec<f64>,
    /// For each facet, the place of the first of the planes around it, and their number.
    of: Vec<(usize, usize)>,
    arch: Arch,
}

/// A beam that may land on one facet as a whole.
#[derive(Clone, Copy)]
pub(super) struct Candidate<'a> {
    pub ray: &'a Ray,
    pub outline: &'a [DVec2],
    /// The centre of the outline, in the image.
    pub centre: DVec2,
    pub facet: u32,
    /// The distance to the facet, over the image.
    pub distance: Affine,
    /// Half the extent of the largest image of the stone.
    pub extent: f64,
}

impl FacetNeighbours {
    pub fn new(polytope: &Polytope) -> Self {
        let facets = polytope.facets();
        let (mut planes, mut of) = (vec![], vec![]);
        for facet in facets {
            of.push((planes.len(), facet.neighbours.len()));
            planes.extend(facet.neighbours.iter().map(|&k| facets[k as usize].plane));
            planes.resize(planes.len().next_multiple_of(WIDEST), Plane { normal: DVec3::ZERO, offset: 0.0 });
        }
        let column = |pick: fn(&Plane) -> f64| planes.iter().map(pick).collect();
        Self {
            normal: [column(|p| p.normal.x), column(|p| p.normal.y), column(|p| p.normal.z)],
            offset: column(|p| p.offset),
            of,
            arch: Arch::new(),
        }
    }

    /// Returns whether the facet is the nearest at the beam's centre, and no neighbour of it is nearer at any corner.
    pub fn hold(&self, candidate: Candidate) -> bool {
        self.arch.dispatch(Hold { around: self, candidate })
    }
}

struct Hold<'a> {
    around: &'a FacetNeighbours,
    candidate: Candidate<'a>,
}

impl WithSimd for Hold<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Candidate { ray, outline, centre, facet, distance, extent } = self.candidate;
        let (first, number) = self.around.of[facet as usize];
        let planes = first..first + number.next_multiple_of(WIDEST);
        let [x, y, z] = &self.around.normal;
        let x = S::as_simd_f64s(&x[planes.clone()]).0;
        let y = S::as_simd_f64s(&y[planes.clone()]).0;
        let z = S::as_simd_f64s(&z[planes.clone()]).0;
        let offset = S::as_simd_f64s(&self.around.offset[planes]).0;
        let direction = splat(simd, ray.direction);
        let [start, along_x, along_y] = &ray.origin;
        let starts = [splat(simd, *start), splat(simd, *along_x), splat(simd, *along_y)];
        let here = splat(simd, DVec3::new(distance.constant, distance.gradient.x, distance.gradient.y));
        let (grazing, same) = (simd.splat_f64s(GRAZING), simd.splat_f64s(SAME));
        let extents = simd.splat_f64s(extent);
        let (one, magnitude) = (simd.splat_f64s(1.0), simd.splat_f64s(distance.magnitude(extent)));
        let here_at_centre = simd.splat_f64s(distance.at(centre));
        for row in 0..number.div_ceil(S::F64_LANES) {
            let normal = [x[row], y[row], z[row]];
            let speed = dot(simd, normal, direction);
            let per = simd.div_f64s(one, speed);
            let there = [
                simd.mul_f64s(simd.sub_f64s(offset[row], dot(simd, normal, starts[0])), per),
                simd.mul_f64s(simd.neg_f64s(dot(simd, normal, starts[1])), per),
                simd.mul_f64s(simd.neg_f64s(dot(simd, normal, starts[2])), per),
            ];
            let of_there = magnitudes(simd, there, extents);
            let tolerance = simd.mul_f64s(same, simd.add_f64s(magnitude, of_there));
            let (least, most) = range(simd, minus(simd, there, here), outline);
            let uncut = simd.and_m64s(
                simd.greater_than_or_equal_f64s(least, simd.neg_f64s(tolerance)),
                simd.greater_than_f64s(most, tolerance),
            );
            let beyond = simd.greater_than_or_equal_f64s(at(simd, there, centre), here_at_centre);
            let behind = simd.less_than_or_equal_f64s(speed, grazing);
            let holds = simd.or_m64s(behind, simd.and_m64s(uncut, beyond));
            if simd.first_true_m64s(simd.not_m64s(holds)) != S::F64_LANES {
                return false;
            }
        }
        true
    }
}

/// Returns affine functions, each a constant and a gradient, at a point.
#[inline(always)]
fn at<S: Simd>(simd: S, [constant, x, y]: Vec3s<S>, p: DVec2) -> S::f64s {
    let (px, py) = (simd.splat_f64s(p.x), simd.splat_f64s(p.y));
    simd.add_f64s(constant, simd.add_f64s(simd.mul_f64s(x, px), simd.mul_f64s(y, py)))
}

/// Returns the least and the greatest values of affine functions at these points.
#[inline(always)]
fn range<S: Simd>(simd: S, functions: Vec3s<S>, points: &[DVec2]) -> (S::f64s, S::f64s) {
    let (mut least, mut most) = (simd.splat_f64s(f64::INFINITY), simd.splat_f64s(f64::NEG_INFINITY));
    for &point in points {
        let value = at(simd, functions, point);
        least = simd.min_f64s(value, least);
        most = simd.max_f64s(value, most);
    }
    (least, most)
}

/// Computes [`Affine::magnitude`] for several functions at once.
#[inline(always)]
fn magnitudes<S: Simd>(simd: S, [constant, x, y]: Vec3s<S>, extent: S::f64s) -> S::f64s {
    let slope = simd.add_f64s(simd.abs_f64s(x), simd.abs_f64s(y));
    simd.add_f64s(simd.abs_f64s(constant), simd.mul_f64s(extent, slope))
}

#[inline(always)]
fn minus<S: Simd>(simd: S, a: Vec3s<S>, b: Vec3s<S>) -> Vec3s<S> {
    [simd.sub_f64s(a[0], b[0]), simd.sub_f64s(a[1], b[1]), simd.sub_f64s(a[2], b[2])]
}
