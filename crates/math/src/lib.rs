//! Geometry: planes, convex solids, convex polygons, triangles and implicit surfaces, in f64.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod affine;
mod ball;
mod basis;
mod bvh;
mod bvh_build;
mod bvh_search;
mod calipers;
mod decay;
mod decimals;
mod draft;
mod edge;
mod edges;
mod eigen;
mod extent;
pub mod faceting;
mod grouping;
mod hull;
mod implicit;
mod linear;
pub mod mending;
mod mesh;
mod outline;
mod plane;
mod polygon;
mod polytope;
mod polytope_build;
mod pose;
pub mod random_bits;
mod regions;
mod shaded_mesh;
mod shaded_surface;
mod smooth;
mod solid;
mod surface;
mod symmetry;
mod triangle_mesh;

pub use affine::Affine;
pub use ball::Ball;
pub use basis::Basis;
pub use bvh::{Bvh, BvhNode, FromSide, Hit};
pub use calipers::{Calipers, hull};
pub use decay::{Moments, integral_of_decay, moments_along_edge, moments_of_decay};
pub use decimals::{as_written, at_most, fixed, rounded, signed};
pub use draft::{Draft, DraftCut};
pub use edge::Edge;
pub use eigen::{eigen, outer};
pub use extent::{bounds, span};
pub use grouping::grouped;
pub use hull::convex_hull;
pub use implicit::SurfaceParts;
pub use implicit::{ImplicitForm, ImplicitSurface, ImplicitSurfaceError, Jet, MOST_WAVES, STEEPEST};
pub use linear::solved;
pub use mesh::{Mesh, triangulate};
pub use outline::polygon_triangles;
pub use plane::Plane;
pub use polygon::{area, centroid, clip, contains, point_in_polygon};
pub use polytope::{Facet, Polytope};
pub use polytope_build::PolytopeError;
pub use pose::Pose;
pub use shaded_mesh::{ShadedMesh, ShadedSurfaceError, SurfaceNormals};
pub use shaded_surface::ShadedSurface;
pub use smooth::SmoothSolid;
pub use solid::{NotConvex, PosedSolid, SolidRef};
pub use surface::Surface;
pub use symmetry::Symmetry;
pub use triangle_mesh::{TriangleMesh, TriangleMeshError};

// The solids of tests, which tests of other crates share, name this crate.
#[cfg(test)]
extern crate self as brillianteer_math;
#[cfg(test)]
#[path = "../../../tests/common/solids.rs"]
mod solids;
