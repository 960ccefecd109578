//! Floor 5: files, in and out.

mod atomic;
pub mod cut_file;
mod drawing_png;
mod exr;
mod fault;
mod png;
pub mod scope_file;
mod text;

pub use atomic::{WriteError, write};
pub use drawing_png::{DrawingError, rasterize};
pub use exr::write_exr;
pub use png::{MOST_PIXELS, PngRows, write_png};
