//! Exact light in gemstone cuts: takes proportions or planes, and gives ASET, Ideal-Scope, hearts and arrows.
//!
//! Each module but `cli` and `app` is a crate of its own, and `io` is two of them, `files` and `paper`. docs/architecture.md
//! says what each owns and which of the others it uses.
//!
//! From a cut file to figures:
//!
//! ```
//! let design = brillianteer::io::cut_file::read("cuts/tolkowsky.toml")?;
//! let measured = brillianteer::measure(&design, &Default::default())?;
//! assert!((measured.light_return() - 0.750).abs() < 0.001);
//! // All light is accounted for, up to the error of the part that rays estimate.
//! assert!((measured.figures.sum() - 1.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`render::MeasureOptions`] choose the view, the scope, the wavelength and the bound on unresolved light. Programs in the
//! folder `examples/` measure a design, sweep an angle, write an ASET picture and read a mesh.
//!
//! The frame is right-handed: +z out of the table, z = 0 at the crown-side girdle, girdle radius 1. In files, lengths are
//! percent of the girdle diameter and angles are degrees; inside the program, girdle radii and radians.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

#[cfg(feature = "cli")]
pub mod cli;
/// Files, in and out.
pub mod io {
    pub use brillianteer_files::*;
    pub use brillianteer_paper::*;
}

/// What every room shares: work that can be watched and stopped, and faults in files.
pub use brillianteer_base as base;
pub use brillianteer_cut as cut;
/// The editor's window.
#[cfg(feature = "app")]
pub use brillianteer_editor as app;
pub use brillianteer_math as math;
pub use brillianteer_measure as measure;
pub use brillianteer_optics as optics;
pub use brillianteer_picture as picture;
pub use brillianteer_render as render;
pub use brillianteer_render::measure;
pub use brillianteer_scene as scene;
pub use brillianteer_search as search;
pub use brillianteer_trace as trace;
pub use glam;
