//! What goes out: pictures, animations, drawings, cutters' sheets, plots and reports as files, the light and the background
//! that they show, and what programs and people read of a stone: plain data and text tables.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod animation;
pub mod background;
#[cfg(feature = "interchange")]
pub mod cutting_sheet;
mod drawing_png;
#[cfg(feature = "exr")]
pub mod export;
#[cfg(feature = "exr")]
mod exr;
pub mod goal_file;
#[cfg(feature = "interchange")]
pub mod info;
mod letters;
pub mod lighting;
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
mod stored_light;
pub mod table;

pub use animation::{Animation, AnimationFormat, Frames, write_animation};
pub use drawing_png::{DrawingError, note_of_letters, rasterize, rasterize_clear, rasterize_within};
#[cfg(feature = "exr")]
pub use exr::write_exr;
pub use letters::SystemFont;
#[cfg(feature = "interchange")]
pub use pdf::pdf;
#[cfg(feature = "exr")]
pub use picture_file::write_linear_exr;
pub use picture_file::{Finish, with_cover, write_rgba_png};
pub use png::{MOST_PIXELS, PngFile, write_png};
pub use stored_light::StoredLight;
