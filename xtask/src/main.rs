//! Makes what is generated for the program and its releases: `cargo run -p xtask -- TASK`.

mod licences;

use std::process::ExitCode;

const USAGE: &str = "usage: cargo run -p xtask -- TASK\n\n\
    crates     write assets/crates.tsv, the list of crates in the editor's About window\n\
    licences   print all crates that the program is built of, and the texts of their licences, for a release";

fn main() -> ExitCode {
    let task = std::env::args().nth(1);
    let done = match task.as_deref() {
        Some("crates") => licences::write_list(),
        Some("licences") => licences::print_texts(),
        _ => Err(USAGE.into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            use std::io::Write;
            let _ = writeln!(std::io::stderr(), "{error}");
            ExitCode::FAILURE
        }
    }
}
