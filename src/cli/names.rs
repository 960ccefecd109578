//! What a name on the command line stands for: a file, or a cut or a scene that comes with the program.

use crate::io::library::{self, CUTS, SCENES};
use crate::io::{is_standard, nearest, scene_file};
use std::path::Path;

/// Returns whether a cut or a scene of this name comes with the program.
pub fn is_known(name: &Path) -> bool {
    let name = name.to_string_lossy();
    library::cut(&name).is_some() || library::scene(&name).is_some()
}

/// Returns whether a path means a scene: a scene file, or the name of a scene that comes with the program.
pub fn is_scene(file: &Path) -> bool {
    match file.is_file() || is_standard(file) {
        true => scene_file::is_scene(file),
        false => library::scene(&file.to_string_lossy()).is_some(),
    }
}

/// Returns the end of an error message about a file that cannot be read as a design: that it is a scene, or the most similar
/// name of a cut or a scene that comes with the program. Empty where neither applies.
pub fn hint(file: &Path) -> String {
    if is_scene(file) {
        return "; this is a scene, where the file or the name of a cut is expected".to_owned();
    }
    let asked = file.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let known: Vec<&str> = CUTS.iter().chain(&SCENES).map(|(name, _)| *name).collect();
    match nearest(&asked, &known).filter(|_| !file.exists()) {
        Some(name) => {
            let kind = if library::cut(name).is_some() { "cut" } else { "scene" };
            format!("; did you mean the {kind} '{name}'?")
        }
        None => String::new(),
    }
}
