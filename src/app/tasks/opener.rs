//! Opens folders and pages by the programs that the system has for them.

use std::io;
use std::sync::Arc;

/// A function that opens a folder by its path, or a page of the web by its address.
pub type Opener = Arc<dyn Fn(&str) -> io::Result<()> + Send + Sync>;

/// Opens by the system's own programs, without waiting for them.
///
/// # Errors
/// Fails where the system has nothing that opens it.
pub fn by_system(what: &str) -> io::Result<()> {
    open::that_detached(what)
}
