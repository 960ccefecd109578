//! Exact light in gemstone cuts: proportions or planes in, ASET, Ideal-Scope, hearts and arrows out.
//!
//! Floors, each importing only from those before it: `math`, `optics`; `cut`; `scene`; `trace`; `picture`,
//! `measure`; `io`; `cli`. See docs/architecture.md.
//!
//! From a cut file to figures:
//!
//! ```
//! use brillianteer::io::cut_file;
//! use brillianteer::measure::by_beams;
//! use brillianteer::scene::{ASET_CONE, Backing, Medium, Scope, Stone, View};
//! use brillianteer::trace::{beam, unwatched};
//!
//! let design = cut_file::read("cuts/tolkowsky.toml")?;
//! let stone = Stone::new(&design.facets()?)?;
//! let view = View { tilt: 5_f64.to_radians(), ..View::default() };
//! let options = beam::Options { unresolved: 0.01, ..beam::Options::default() };
//! let beams = beam::trace(&stone.polytope, Medium::clear(2.4175), &view, &options, &unwatched)?;
//! let figures = by_beams(&beams, &Scope::aset(ASET_CONE, Backing::Black));
//! assert!((figures.sum() - 1.0).abs() < 1e-9 && figures.unresolved <= 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
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
