//! Exact light in gemstone cuts: proportions or planes in, ASET, Ideal-Scope, hearts and arrows out.
//!
//! Floors, each importing only from those before it: `math`, `optics`; `cut`; `scene`; `trace`; `picture`,
//! `measure`; `io`; `cli`, `app`. See docs/architecture.md.
//!
//! From a cut file to figures:
//!
//! ```
//! let design = brillianteer::io::cut_file::read("cuts/tolkowsky.toml")?;
//! let measured = brillianteer::measure(&design, &Default::default())?;
//! assert!((measured.light_return() - 0.750).abs() < 0.001);
//! assert!((measured.figures.sum() - 1.0).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`measure::MeasureOptions`] choose the view, the scope, the wavelength and the bound on what is unresolved. The folder
//! `examples/` measures a design, sweeps an angle, writes an ASET picture and reads a mesh.
//!
//! Frame: right-handed, +z out of the table, z = 0 at the crown-side girdle, girdle radius 1. Lengths in files are
//! percent of the girdle diameter, angles degrees; inside, girdle radii and radians.

#[cfg(feature = "app")]
pub mod app;
#[cfg(feature = "cli")]
pub mod cli;
pub mod cut;
pub mod io;
pub mod math;
pub mod measure;
pub mod optics;
pub mod picture;
pub mod scene;
pub mod trace;

pub use glam;
pub use measure::measure;
