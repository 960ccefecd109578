//! Resolves a name on the command line: a file, or a cut or a scene that comes with the program.

use brillianteer_files::library;
use std::path::Path;

/// Returns whether a cut or a scene of this name comes with the program.
pub fn is_known(name: &Path) -> bool {
    let name = name.to_string_lossy();
    library::cut(&name).is_some() || library::scene(&name).is_some()
}
