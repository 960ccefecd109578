//! Files of designs, meshes, scenes, lights, scopes and panoramas, in and out. The path `-` is standard input and output
//! everywhere.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

#[cfg(feature = "interchange")]
pub mod asc;
#[cfg(feature = "interchange")]
pub mod assembly;
mod atomic;
#[cfg(feature = "interchange")]
pub mod bodies_scene;
#[cfg(feature = "interchange")]
pub mod built_design;
pub mod cut_file;
#[cfg(feature = "interchange")]
mod cutters;
#[cfg(feature = "interchange")]
pub mod design_file;
mod encoding;
#[cfg(feature = "interchange")]
mod foreign;
#[cfg(feature = "interchange")]
pub mod gcs;
#[cfg(feature = "interchange")]
pub mod gem;
pub mod library;
pub mod light_file;
#[cfg(feature = "interchange")]
pub mod mesh;
pub mod mesh_options;
#[cfg(feature = "interchange")]
mod numbers;
mod overwriting;
pub mod panorama;
pub mod scene_file;
#[cfg(feature = "interchange")]
pub mod scene_mesh;
pub mod scope_file;
mod standard;
pub mod text;
mod toml_comments;
mod toml_format;
pub mod toml_text;
mod undecoded;

pub use atomic::{
    Abandoned, Sink, WholeFile, WriteError, abandon_writes, check_writable, report_made_folders, write,
};
#[cfg(feature = "interchange")]
pub use cutters::{NoTiers, as_tiers, in_tiers};
#[cfg(feature = "interchange")]
pub use mesh::{write_glb, write_obj, write_ply, write_stl};
pub use standard::{STANDARD, is_standard};
pub use toml_comments::has_comments;
pub use undecoded::Undecoded;

// Files that tests of several crates share.
#[cfg(test)]
#[path = "../../../tests/common/proportions.rs"]
mod random;
#[cfg(test)]
#[path = "../../../tests/common/solids.rs"]
mod solids;
