//! Packets of rays, one ray in each lane of the processor's registers, in single precision. They serve for pictures
//! under light.
//!
//! A packet follows the same chains of bounces as [`ray`](super::ray) does in double precision, by the same formulae for
//! all but polarisation, which is a coherency matrix here and two fields there. It runs through bodies of planes and
//! glass shapes; light may enter a plate with waves again. Each ray has its own medium, so that the wavelengths of one
//! pixel share a packet. When a ray ends, the next ray takes its lane. `shaders/trace.wgsl` does the
//! same on a graphics card.

mod backplate;
mod chain;
mod entering;
mod environment;
mod fields;
mod lanes;
mod outside;
mod planes;
mod rays;

mod tracer;

use self::lanes::{Lanes, Vectors};
pub(crate) use self::tracer::{EyeRay, PacketTracer};
use pulp::Simd;

/// The places where rays meet a surface.
struct PacketHit<S: Simd> {
    /// The distance along each ray; infinite where the ray misses.
    distance: Lanes<S>,
    /// The unit outward normals; undefined, possibly NaN, where a ray misses.
    normal: Vectors<S>,
}

/// A surface that packets of rays meet, in its own frame.
///
/// The result in each lane depends only on the ray of that lane. A ray with NaN misses.
trait PacketSurface: Sync {
    /// Returns the places where rays from outside enter. A ray that runs from the surface outward does not meet its
    /// own start.
    fn entry<S: Simd>(&self, simd: S, origin: Vectors<S>, direction: Vectors<S>) -> PacketHit<S>;

    /// Returns the places where rays from inside or from the surface leave.
    fn exit<S: Simd>(&self, simd: S, origin: Vectors<S>, direction: Vectors<S>) -> PacketHit<S>;

    /// Returns the change of the unit normals at points of the surface that move along it by `by`; `None` where the
    /// surface is flat.
    fn turned<S: Simd>(&self, simd: S, point: Vectors<S>, by: Vectors<S>) -> Option<Vectors<S>>;
}
