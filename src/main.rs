//! The program: parse, call, print, exit code.

use std::process::ExitCode;

/// Tracing beams fills much memory in small steps, which the system's allocator does a third slower.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    brillianteer::cli::main()
}
