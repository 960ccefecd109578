//! Exact light in gemstone cuts: proportions or planes in, ASET, Ideal-Scope, hearts and arrows out.
//!
//! Floors, each importing only from those before it: `math`, `optics`; `cut`; `scene`; `trace`; `picture`,
//! `measure`; `io`; `cli`. See docs/architecture.md.
//!
//! Frame: right-handed, +z out of the table, z = 0 at the crown-side girdle, girdle radius 1. Lengths in files are
//! percent of the girdle diameter, angles degrees; inside, girdle radii and radians.

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
