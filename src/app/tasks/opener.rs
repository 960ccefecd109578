//! Opens folders and pages by the programs that the system has for them.

use std::sync::Arc;

/// A function that opens a folder by its path, or a page of the web by its address; the error says why not.
pub type Opener = Arc<dyn Fn(&str) -> Result<(), String> + Send + Sync>;

/// Opens by the system's own programs, without waiting for them.
///
/// # Errors
/// The text names what was to be opened, where the system has nothing that opens it.
pub fn by_system(what: &str) -> Result<(), String> {
    open::that_detached(what).map_err(|e| format!("{what} was not opened: {e}"))
}
