//! Floor 7: files, in and out. The path `-` is standard input and output everywhere.

mod animation;
#[cfg(feature = "interchange")]
pub mod asc;
#[cfg(feature = "interchange")]
pub mod assembly;
mod atomic;
pub mod background;
#[cfg(feature = "interchange")]
pub mod bodies_scene;
#[cfg(feature = "interchange")]
pub mod built_design;
pub mod cut_file;
#[cfg(feature = "interchange")]
mod cutters;
#[cfg(feature = "interchange")]
pub mod cutting_sheet;
#[cfg(feature = "interchange")]
pub mod design_file;
mod drawing_png;
mod encoding;
#[cfg(feature = "exr")]
pub mod export;
#[cfg(feature = "exr")]
mod exr;
#[cfg(feature = "interchange")]
mod foreign;
#[cfg(feature = "interchange")]
pub mod gcs;
#[cfg(feature = "interchange")]
pub mod gem;
pub mod goal_file;
mod letters;
pub mod library;
pub mod light_file;
pub mod lighting;
#[cfg(feature = "interchange")]
pub mod mesh;
pub mod mesh_options;
#[cfg(feature = "interchange")]
mod numbers;
mod overwriting;
pub mod panorama;
#[cfg(feature = "interchange")]
mod pdf;
mod picture_file;
#[cfg(feature = "interchange")]
pub mod plot;
mod png;
mod png_bytes;
#[cfg(feature = "exr")]
pub mod refraction;
#[cfg(all(feature = "exr", feature = "interchange"))]
pub mod report;
pub mod scene_file;
pub mod scope_file;
mod standard;
mod stored_light;
mod text;
mod toml_comments;
mod toml_format;
mod toml_text;
mod undecoded;

pub use animation::{Animation, AnimationFormat, Frames, write_animation};
pub use atomic::{
    Abandoned, Sink, WholeFile, WriteError, abandon_writes, check_writable, report_made_folders, write,
};
#[cfg(feature = "interchange")]
pub use cutters::{NoTiers, as_tiers, in_tiers};
pub use drawing_png::{DrawingError, note_of_letters, rasterize, rasterize_clear, rasterize_within};
#[cfg(feature = "exr")]
pub use exr::write_exr;
pub use letters::SystemFont;
#[cfg(feature = "interchange")]
pub use mesh::{write_glb, write_obj, write_ply, write_stl};
#[cfg(feature = "interchange")]
pub use pdf::pdf;
#[cfg(feature = "exr")]
pub use picture_file::write_linear_exr;
pub use picture_file::{Finish, with_cover, write_rgba_png};
pub use png::{MOST_PIXELS, PngFile, write_png};
pub use standard::{STANDARD, is_standard};
pub use stored_light::StoredLight;
pub use toml_comments::has_comments;
