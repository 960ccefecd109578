//! Opening folders and pages by whatever the system opens them with.

use std::sync::Arc;

/// Opens a folder, by its path, or a page of the web, by its address; or says why not.
pub type Opener = Arc<dyn Fn(&str) -> Result<(), String> + Send + Sync>;

/// Opens by the system's own programs, without waiting for them.
///
/// # Errors
/// Text that names what was to be opened, where the system has nothing that opens it.
pub fn by_system(what: &str) -> Result<(), String> {
    open::that_detached(what).map_err(|e| format!("{what} was not opened: {e}"))
}
