//! Standard input and output, which the path `-` stands for, as on most command lines.

use std::io::{self, Read};
use std::path::Path;
use std::sync::OnceLock;

/// The path that stands for standard input where a file is read and for standard output where one is written. A file of
/// that name is `./-`.
pub const STANDARD: &str = "-";

/// The size of the largest file that is read, a mesh, in bytes.
const LARGEST: u64 = 512 << 20;

/// Returns whether a path stands for standard input or output.
pub fn is_standard(path: &Path) -> bool {
    path == Path::new(STANDARD)
}

/// Returns the content of standard input, up to the size of the largest file that is read and a byte more. Standard
/// input is read once and kept, so that callers can ask for it again.
pub(super) fn input() -> io::Result<&'static [u8]> {
    static KEPT: OnceLock<Vec<u8>> = OnceLock::new();
    if let Some(kept) = KEPT.get() {
        return Ok(kept);
    }
    let mut bytes = Vec::new();
    io::stdin().lock().take(LARGEST + 1).read_to_end(&mut bytes)?;
    Ok(KEPT.get_or_init(|| bytes))
}
