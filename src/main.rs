//! The program: parse, call, print, exit code.

use std::process::ExitCode;

fn main() -> ExitCode {
    brillianteer::cli::main()
}
