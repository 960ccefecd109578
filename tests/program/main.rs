//! Tests of the program as a user runs it: on the command line, in a window, and by the pages that it writes.

mod cli;
#[cfg(feature = "cli")]
#[path = "../common/maps.rs"]
mod maps;
mod refraction_page;
mod window;
mod window_speed;
