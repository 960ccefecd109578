//! Floor 0: planes, convex solids and convex polygons in f64.

mod affine;

mod basis;
mod decay;
mod mesh;
mod plane;
mod polygon;
mod polytope;
mod polytope_build;
pub mod surface;
mod symmetry;

pub use affine::Affine;
pub use basis::Basis;
pub use decay::integral_of_decay;
pub use mesh::{Mesh, triangulate};
pub use plane::Plane;
pub use polygon::{area, centroid, clip, contains};
pub use polytope::{Facet, Polytope};
pub use polytope_build::PolytopeError;
pub use symmetry::Symmetry;
