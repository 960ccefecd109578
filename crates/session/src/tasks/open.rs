//! Reads, saves and watches files of designs, and finds out what dropped files are for.

use super::TaskAnswer;
use super::runner::JobHandle;
use crate::model::action::FileAction;
use crate::model::choosing::Purpose;
use crate::model::document::Document;
use crate::model::opening::{FileRequest, OpenedFile, OpeningPurpose};
use crate::model::preset::Preset;
use crate::model::saving::{SaveRequest, SavedDesign, Stamp};
use brillianteer_base::Failure;
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_files::{has_comments, light_file, scene_file};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Reads a file; a scene file must have a stone to work on.
///
/// # Errors
/// Fails where the file cannot be read, or makes neither a stone nor a scene. The text names file, line and key, and
/// says what to do.
pub fn read(request: &FileRequest) -> Result<OpenedFile, Failure> {
    let FileRequest { purpose, path, mesh } = request;
    if *purpose == OpeningPurpose::Anew && is_scene(path) {
        Ok(OpenedFile::Scene(Box::new(Preset::read(path)?)))
    } else {
        Ok(OpenedFile::Design(Box::new(Document::open(path, mesh)?)))
    }
}

/// Returns whether a file is a scene; only files whose names end in .toml are read for that.
fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) && scene_file::is_scene(path)
}

/// Saves a design in the format of the file's name, or as .toml where the name has no ending.
///
/// # Errors
/// Fails where the file cannot be written, and where the completed name would replace another file.
pub fn save(request: SaveRequest) -> Result<SavedDesign, Failure> {
    let SaveRequest { path, design, specimen, .. } = request;
    let completed = path.with_extension("toml");
    if path.extension().is_none() && completed.exists() {
        let problem = format!("{} exists; type its full name to replace it", completed.display());
        return Err(Failure::Usage(problem));
    }
    let path = if path.extension().is_some() { path } else { completed };
    let specimen = specimen.remade(design.clone()).map_err(|e| Failure::Input(e.to_string()))?;
    let format = DesignFormat::of_name(&path).unwrap_or(DesignFormat::Toml);
    let had_comments = format == DesignFormat::Toml && has_comments(&path);
    let mut lost = design_file::write(&specimen, format, &path)?;
    if had_comments {
        lost.push("the comments of the file that was there are not kept".to_owned());
    }
    Ok(SavedDesign { stamp: Stamp::of(&path), path, design, lost })
}

/// The time from one look at a watched file to the next.
const PAUSE: Duration = Duration::from_millis(500);

/// Watches a file, whose last known stamp is `known`, until the job is stopped.
pub fn watch(path: &Path, mut known: Stamp, job: &JobHandle<TaskAnswer>) {
    while !job.is_stopped() {
        let now = Stamp::of(path);
        if now != known {
            known = now;
            job.send(FileAction::OnDisk(path.to_owned(), now).into());
        }
        std::thread::sleep(PAUSE);
    }
}

/// Returns the purposes of dropped files, by their names and, for TOML, by their content.
pub fn look_into(files: Vec<PathBuf>) -> Vec<(PathBuf, Purpose)> {
    let purpose = |path: &Path| {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        match ending.as_str() {
            "hdr" | "exr" => Purpose::Light,
            "png" | "jpg" | "jpeg" => Purpose::Behind,
            "toml" | "light" if light_file::read(path).is_ok() => Purpose::Light,
            _ => Purpose::Open,
        }
    };
    files.into_iter().map(|path| (purpose(&path), path)).map(|(purpose, path)| (path, purpose)).collect()
}
