//! Tests of the program as a user runs it: on the command line, in a window, and by the pages that it writes.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::too_many_lines,
    reason = "a test fails by it, says what it skips, or lists many cases"
)]

mod cli;
#[cfg(feature = "cli")]
#[path = "../common/maps.rs"]
mod maps;
mod refraction_page;
#[cfg(feature = "cli")]
#[path = "../common/shown_commands.rs"]
mod shown_commands;
mod watchdog;
mod window;
mod window_speed;
