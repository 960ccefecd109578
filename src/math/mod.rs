//! Floor 0: planes, convex solids, convex polygons and triangles in f64.

mod affine;

mod basis;
mod bvh;
mod bvh_build;
mod calipers;
mod decay;
mod field;
mod hull;
mod mesh;
mod plane;
mod polygon;
mod polytope;
mod polytope_build;
mod regions;
mod shell;
mod smooth;
mod solid;
pub mod surface;
mod symmetry;

pub use affine::Affine;
pub use basis::Basis;
pub use bvh::{Bvh, Hit, Node};
pub use calipers::{Calipers, hull};
pub use decay::integral_of_decay;
#[cfg(feature = "gpu")]
pub(crate) use field::Parts;
pub use field::{Field, FieldError, Form, Jet};
pub use hull::convex_hull;
pub use mesh::{Mesh, triangulate};
pub use plane::Plane;
pub use polygon::{area, centroid, clip, contains};
pub use polytope::{Facet, Polytope};
pub use polytope_build::PolytopeError;
pub use shell::{Shell, ShellError};
pub use smooth::Smooth;
pub use solid::{Edge, NotConvex, Solid, SolidRef};
pub use surface::Surface;
pub use symmetry::Symmetry;

#[cfg(test)]
#[path = "../../tests/common/solids.rs"]
pub mod fixture;
