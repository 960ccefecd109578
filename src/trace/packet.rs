//! Packets of rays in f32, a ray in each lane of the processor's registers.

#![allow(dead_code, reason = "the tracer of packets calls it")]

mod fields;
mod lanes;

use pulp::Simd;

/// A vector in each lane: x, y, z.
type Vec3s<S> = [<S as Simd>::f32s; 3];

/// Where rays meet a surface.
struct Met<S: Simd> {
    /// The distance along the ray; infinity where a ray misses.
    pub distance: S::f32s,
    /// The unit outward normal; where a ray misses it may be anything, NaN included.
    pub normal: Vec3s<S>,
}

/// A surface that packets of rays meet, in its own frame.
///
/// Each lane depends on its own ray alone, so that the result is the same whatever the number of lanes. A lane that holds
/// NaN misses.
trait PacketSurface {
    /// Returns where rays from outside enter. A ray from the surface outward does not meet its own start.
    fn entry<S: Simd>(&self, simd: S, origin: Vec3s<S>, direction: Vec3s<S>) -> Met<S>;

    /// Returns where rays from inside or from the surface leave.
    fn exit<S: Simd>(&self, simd: S, origin: Vec3s<S>, direction: Vec3s<S>) -> Met<S>;

    /// Returns the change of the unit normal at a point of the surface where the point moves by `by` along the surface.
    fn turned<S: Simd>(&self, simd: S, point: Vec3s<S>, by: Vec3s<S>) -> Vec3s<S>;
}
