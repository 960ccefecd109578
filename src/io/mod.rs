//! Floor 5: files, in and out.

mod apng;
pub mod asc;
mod atomic;
pub mod background;
pub mod cut_file;
mod cutters;
pub mod design_file;
mod drawing_png;
pub mod export;
mod exr;
mod failure;
mod fault;
pub mod gcs;
pub mod gem;
pub mod library;
pub mod light_file;
pub mod lighting;
pub mod mesh_design;
mod mesh_export;
pub mod mesh_file;
pub mod panorama;
mod picture_file;
mod png;
pub mod refraction_map;
pub mod refraction_page;
pub mod scene_file;
pub mod scope_file;
mod text;

pub use apng::{Animation, Frames, write_apng};
pub use atomic::{WriteError, write};
pub use drawing_png::{DrawingError, rasterize};
pub use exr::write_exr;
pub use failure::Failure;
pub use mesh_export::{write_glb, write_obj, write_stl};
pub use picture_file::{write_linear_exr, write_rgba_png};
pub use png::{MOST_PIXELS, PngRows, write_png};
