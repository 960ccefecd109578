//! Reads and writes meshes: glTF, OBJ, STL and PLY.
//!
//! A mesh becomes a design in these steps ([`read`]):
//!
//! 1. `file` finds the format by the content, and reads the triangles, the material and the statement about the
//!    stone;
//! 2. the triangles are mended into a closed surface ([`math::mending`](brillianteer_math::mending)); `parts` takes one of the
//!    solids in it, whose facets are found ([`math::faceting`](brillianteer_math::faceting));
//! 3. `place` decides which way is up, and `size` the size of the stone;
//! 4. `design` makes a stone of the facets ([`cut::from_mesh`](brillianteer_cut::from_mesh)), or of the triangles where the solid is
//!    not convex, and collects notes and warnings.
//!
//! `export` writes stones and scenes as meshes. `metal` reads meshes of opaque bodies, which need not be closed.

mod departure;
mod design;
mod export;
mod file;
mod metal;
mod parts;
mod place;
mod size;
#[cfg(test)]
#[allow(clippy::print_stdout, reason = "a test that is left out says so")]
mod trials;

pub use design::{read, read_bodies, upward};
pub use export::{FINENESS, Stated, stated_in_stl, write_glb, write_obj, write_ply, write_stl};
pub use export::{write_scene_glb, write_scene_obj, write_scene_ply, write_scene_stl};
pub use file::{MAX_BYTES, MaterialHint, MeshFile, looks_like, parse};
pub use metal::{read_shaded, write_shaded};
pub use parts::MeshBody;
