//! Vectors of f64, with the vector of one ray in each lane of the processor's registers.
//!
//! Products and sums are not fused, so that the result does not depend on the processor.

use glam::DVec3;
use pulp::Simd;

/// A vector in each lane: all x coordinates, then all y, then all z.
pub(crate) type Vec3s<S> = [<S as Simd>::f64s; 3];

#[inline(always)]
pub(crate) fn dot<S: Simd>(simd: S, a: Vec3s<S>, b: Vec3s<S>) -> S::f64s {
    let xy = simd.add_f64s(simd.mul_f64s(a[0], b[0]), simd.mul_f64s(a[1], b[1]));
    simd.add_f64s(xy, simd.mul_f64s(a[2], b[2]))
}

/// Returns the same vector in all lanes.
#[inline(always)]
pub(crate) fn splat<S: Simd>(simd: S, v: DVec3) -> Vec3s<S> {
    [simd.splat_f64s(v.x), simd.splat_f64s(v.y), simd.splat_f64s(v.z)]
}
