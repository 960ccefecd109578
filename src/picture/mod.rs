//! Floor 4: pictures. A picture is a view, a scope and a reading of the light; nothing here traces.

#[cfg(feature = "gpu")]
pub mod by_gpu;
pub mod by_rays;
mod diagram;
mod drawing;
mod film;
mod layer;
mod linear;
mod paint;
mod palette;
mod profile;
mod raster;
pub mod spectral;
pub mod vector;
mod views;

pub use diagram::diagram;
pub use film::Film;
pub use layer::Layer;
pub use linear::Linear;
pub use paint::paint;
pub use palette::Palette;
pub use profile::profile;
pub use raster::Rows;
pub use views::{Picture, Scoped, named, names};
