//! The program: parse, call, print, exit code.

use std::process::ExitCode;

/// Tracing beams fills much memory in small steps, which the system's allocator does a third slower.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    brillianteer::cli::main(editor())
}

/// What opens the window, where this program has one.
fn editor() -> Option<brillianteer::cli::Editor> {
    #[cfg(feature = "app")]
    return Some(|file, mesh| brillianteer::app::run(file, mesh).map_err(|error| error.to_string()));
    #[cfg(not(feature = "app"))]
    None
}
