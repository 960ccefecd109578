//! Packets of rays: one ray in each lane of the processor's registers, in single precision, for pictures that are looked at.
//!
//! A packet follows the same chain of bounces as [`ray`](super::ray) does in double precision, through bodies from which light
//! that has left never returns. Each ray has a medium of its own, so that the wavelengths of one pixel share a packet. When a
//! ray ends, the next one takes its lane. `shaders/trace.wgsl` does the same on a graphics card.

mod by_packets;
mod chain;
mod entering;
mod lanes;
mod optics;
mod planes;
mod rays;
mod sky;

pub(in crate::trace) use self::by_packets::PacketTracer;
use self::lanes::{Lanes, Vectors};
use pulp::Simd;

/// Where rays meet a surface.
struct Met<S: Simd> {
    /// Infinite where a ray misses.
    distance: Lanes<S>,
    /// The unit outward normals.
    normal: Vectors<S>,
}

/// The surface of a convex body, as packets meet it.
trait PacketSurface: Sync {
    /// Whether normals change along the surface.
    const IS_CURVED: bool;

    /// Returns where rays from points inside or on the surface leave.
    fn exit<S: Simd>(&self, simd: S, origin: Vectors<S>, direction: Vectors<S>) -> Met<S>;

    /// Returns the change of the unit normals where points move along the surface.
    fn turned<S: Simd>(&self, simd: S, point: Vectors<S>, by: Vectors<S>) -> Vectors<S>;
}
