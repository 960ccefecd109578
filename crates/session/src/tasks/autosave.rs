//! Autosave: keeps unsaved work on disk while the program runs, and finds it again after a crash.

use crate::model::recovery::{KeptScene, RecoveredWork, UnsavedWork};
use crate::model::work::ReadMesh;
use brillianteer_cut::from_mesh::{Evening, Up};
use brillianteer_cut::{Cut, Design};
use brillianteer_files::mesh_options::{MeshForm, MeshOptions, MeshPart, MeshUnit};
use brillianteer_files::{WriteError, cut_file, design_file, write};
use brillianteer_math::Plane;
use brillianteer_scene::{Copies, MOST_STONES};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The autosave of one run of the program, so that a crash loses no unsaved work.
///
/// While the program runs it holds a lock on its file; a file without a lock was left behind by a crash.
pub struct Autosave {
    folder: PathBuf,
    /// The file of this run of the program; no run before or after uses the same name.
    own: PathBuf,
    held: Option<File>,
}

/// The content of an autosave file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Kept {
    path: Option<PathBuf>,
    /// True where the cut is a mesh, which lies in its own file and is not kept here.
    #[serde(default)]
    mesh: bool,
    /// The mesh file that the stone was read from, if it was one; autosave files of older versions lack this.
    #[serde(default)]
    read: Option<KeptMesh>,
    design: String,
    #[serde(default)]
    around: KeptScene,
}

/// A mesh file and the options by which it was read, as the autosave file holds them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct KeptMesh {
    path: PathBuf,
    /// The direction in which the table faces, if the user gave one.
    up: Option<DVec3>,
    form: MeshForm,
    /// The unit of the file; autosave files of older versions lack it.
    #[serde(default)]
    unit: MeshUnit,
    /// The solid that was chosen of several, in words; empty for the one that the program finds.
    #[serde(default)]
    part: String,
    #[serde(default)]
    parts: Vec<String>,
    /// Whether the facets were evened; autosave files of older versions lack this.
    #[serde(default)]
    evening: Evening,
    is_doubtful: bool,
    diameter_mm: f64,
}

impl KeptMesh {
    fn of(mesh: &ReadMesh) -> Self {
        Self {
            path: mesh.path.clone(),
            up: match mesh.options.up {
                Up::Given(up) => Some(up),
                // The editor opens meshes either by a direction that the user gave, or by the one that the program
                // finds.
                Up::Found | Up::FoundBy(_) | Up::Known(_) | Up::Posed(_) => None,
            },
            form: mesh.options.form,
            unit: mesh.options.unit,
            part: mesh.options.part.to_string(),
            parts: mesh.parts.clone(),
            evening: mesh.options.evening,
            is_doubtful: mesh.is_doubtful,
            diameter_mm: mesh.diameter_mm,
        }
    }

    fn read_mesh(self) -> ReadMesh {
        let Self { path, up, form, unit, part, parts, evening, is_doubtful, diameter_mm } = self;
        let part = MeshPart::from(part.as_str());
        let options = MeshOptions { up: up.map_or(Up::Found, Up::Given), form, unit, part, evening };
        ReadMesh { path, options, parts, is_doubtful, diameter_mm }
    }
}

/// The beginning of the names of autosave files.
const PREFIX: &str = "unsaved-";

/// The name of the file that holds the work with which the next start begins.
const LAST: &str = "last-work.json";

impl Autosave {
    /// Creates an autosave in a folder; nothing is written yet.
    pub fn new(folder: PathBuf) -> Self {
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        let own = folder.join(format!("{PREFIX}{}-{}.json", std::process::id(), since.as_nanos()));
        Self { folder, own, held: None }
    }

    /// Writes the design, the options of its mesh and the scene around it to the autosave file.
    ///
    /// # Errors
    /// Fails where the file cannot be written.
    pub fn keep(&mut self, unsaved: &UnsavedWork) -> Result<(), WriteError> {
        let name = &self.own;
        write_kept(name, unsaved)?;
        // The write has replaced the file that was locked.
        let file = File::open(name).map_err(|e| WriteError::io(name, e))?;
        file.try_lock().map_err(|e| WriteError::io(name, std::io::Error::from(e)))?;
        self.held = Some(file);
        unsaved.replaces.iter().for_each(|path| forget(path));
        Ok(())
    }

    /// Writes the work with which the next start begins.
    ///
    /// # Errors
    /// Fails where the file cannot be written.
    pub fn keep_last(&self, work: &UnsavedWork) -> Result<(), WriteError> {
        write_kept(&self.folder.join(LAST), work)
    }

    /// Returns the work that was open when the program last ended; `None` where there is none, or where it cannot be read.
    pub fn last(&self) -> Option<RecoveredWork> {
        let path = self.folder.join(LAST);
        let file = File::open(&path).ok()?;
        // A design with a file is read from there.
        read_kept(&file, path).map(|(found, _)| found)
    }

    /// Removes the autosave file, because the work is saved or discarded.
    pub fn empty(&mut self) {
        if self.held.take().is_some() {
            forget(&self.own);
        }
    }

    /// Returns the work that crashes left behind, the latest first.
    pub fn found(&self) -> Vec<RecoveredWork> {
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let ours = |e: &std::fs::DirEntry| e.file_name().to_string_lossy().starts_with(PREFIX);
        let mut found: Vec<RecoveredWork> = entries.filter(ours).filter_map(|e| orphan(e.path())).collect();
        found.sort_by_key(|found| std::cmp::Reverse(found.when));
        found
    }
}

/// Removes an autosave file that a crash left behind.
pub fn forget(path: &Path) {
    // A file that cannot be removed is offered again, which loses nothing.
    let _ = std::fs::remove_file(path);
}

/// Returns the plane that the autosave file holds in the place of a mesh, which is not kept there.
fn stand_in() -> (String, Plane) {
    ("mesh".to_owned(), Plane::new(DVec3::Z, 1.0))
}

/// Writes work into a file.
fn write_kept(name: &Path, unsaved: &UnsavedWork) -> Result<(), WriteError> {
    let UnsavedWork { work, around, path, .. } = unsaved;
    let design = &work.design;
    // A mesh already lies in a file, and may be large: only the rest of the design is kept.
    let (mesh, design) = match (&design.cut, path) {
        (Cut::Mesh(_), Some(_)) => {
            (true, Cow::Owned(Design { cut: Cut::Planes(vec![stand_in()]), ..design.clone() }))
        }
        _ => (false, Cow::Borrowed(design)),
    };
    let kept = Kept {
        path: path.clone(),
        mesh,
        read: work.mesh.as_ref().map(KeptMesh::of),
        design: cut_file::write(&design),
        around: around.clone(),
    };
    let text = serde_json::to_string(&kept).map_err(|e| WriteError::io(name, e))?;
    write(name, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(name, e)))
}

/// Reads work from a file; `None` where it cannot be read. The design of a mesh is without its triangles.
fn read_kept(file: &File, path: PathBuf) -> Option<(RecoveredWork, bool)> {
    let mut kept: Kept = serde_json::from_reader(BufReader::new(file)).ok()?;
    if !(1..=MOST_STONES).contains(&kept.around.copies.poses.len()) {
        kept.around.copies = Copies::default();
    }
    let design = cut_file::parse(&kept.design, "unsaved work").ok()?;
    let when = file.metadata().and_then(|m| m.modified()).ok()?;
    let Kept { around, path: own, mesh: is_mesh, read, .. } = kept;
    let mesh = read.map(KeptMesh::read_mesh);
    Some((RecoveredWork { design, around, path: own, on_disk: None, mesh, when, file: path }, is_mesh))
}

/// Reads an autosave file; `None` where a running program holds it, or where it cannot be read.
fn orphan(path: PathBuf) -> Option<RecoveredWork> {
    let file = File::open(&path).ok()?;
    file.try_lock().ok()?;
    let (mut found, is_mesh) = read_kept(&file, path)?;
    let own = found.path.clone();
    if is_mesh {
        found.design.cut = mesh_again(found.mesh.as_ref(), own.as_deref())?;
    }
    // The mesh is read in the direction that the program finds: a direction that the user chose is a change that the
    // file lacks.
    found.on_disk = own.as_deref().and_then(|path| design_file::read(path).ok()).map(|read| read.design);
    Some(found)
}

/// Reads the triangles of kept work again: from its mesh file with the same options as before, or else from the file that
/// the work was saved in.
fn mesh_again(mesh: Option<&ReadMesh>, path: Option<&Path>) -> Option<Cut> {
    let triangles = MeshOptions { form: MeshForm::Triangles, ..MeshOptions::default() };
    let sources = mesh.map(|mesh| (mesh.path.as_path(), &mesh.options)).into_iter();
    sources.chain(path.map(|path| (path, &triangles))).find_map(|(path, options)| {
        let cut = design_file::read_with(path, options).ok()?.design.cut;
        matches!(cut, Cut::Mesh(_)).then_some(cut)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;
    use crate::model::render_settings::RenderSettings;
    use crate::model::work::Work;
    use brillianteer_files::design_file::DesignFormat;
    use brillianteer_scene::Look;
    use std::sync::Arc;

    /// Returns work without a scene around it.
    fn alone(work: &Work, path: Option<&Path>) -> UnsavedWork {
        let (work, path) = (work.clone(), path.map(Path::to_owned));
        UnsavedWork { work, around: KeptScene::default(), path, replaces: None }
    }

    #[test]
    fn work_is_found_after_a_crash_and_only_then() {
        let folder = tempfile::tempdir().unwrap();
        let work = Document::first().unwrap().work;
        let mut safe = Autosave::new(folder.path().to_owned());
        let corners = [DVec3::ONE, -DVec3::ONE];
        let copies = Copies::scattered(3, &corners, 2);
        let around = KeptScene {
            copies,
            settings: RenderSettings {
                look: Look {
                    background: Some("page".into()),
                    background_mm: Some(12.5),
                    strength: 0.2,
                    ..Look::default()
                },
                ..RenderSettings::default()
            },
            ..KeptScene::default()
        };
        let path = Some("/x/mine.toml".into());
        let unsaved = UnsavedWork { work: work.clone(), around: around.clone(), path, replaces: None };
        safe.keep(&unsaved).unwrap();
        safe.keep(&unsaved).unwrap();
        let next = Autosave::new(folder.path().to_owned());
        assert_eq!(next.found(), [], "the program still runs");
        drop(safe);
        let found = next.found();
        assert_eq!(
            (found.len(), &found[0].design, found[0].path.as_deref()),
            (1, &work.design, Some(Path::new("/x/mine.toml")))
        );
        assert_eq!(found[0].around, around);
        found.iter().for_each(|found| forget(&found.file));
        assert_eq!(next.found(), []);
    }

    #[test]
    fn of_a_mesh_what_was_changed_is_kept_and_the_mesh_is_taken_from_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("heart.toml");
        let (vertices, triangles) = crate::solids::heart();
        let solid =
            brillianteer_math::TriangleMesh::new(brillianteer_math::Surface::new(vertices, triangles))
                .unwrap();
        let first = Document::first().unwrap().work.design;
        let cut = Cut::Mesh(brillianteer_cut::MeshShape(Arc::new(solid)));
        std::fs::write(&path, cut_file::write(&Design { cut, ..first })).unwrap();
        let mesh = design_file::read(&path).unwrap().design;
        let changed = Design { name: "changed".to_owned(), diameter_mm: 9.0, ..mesh };
        let work = Work { design: changed.clone(), ..Document::first().unwrap().work };
        let mut safe = Autosave::new(folder.path().join("safe"));
        safe.keep(&alone(&work, Some(&path))).unwrap();
        drop(safe);
        let next = Autosave::new(folder.path().join("safe"));
        assert!(next.found()[0].design == changed);
        let kept = std::fs::read_dir(folder.path().join("safe")).unwrap().next().unwrap().unwrap();
        assert!(kept.metadata().unwrap().len() < 1000);
    }

    #[test]
    fn how_a_mesh_was_read_is_kept_and_work_of_an_older_program_is_found_without_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("heart.glb");
        let (vertices, triangles) = crate::solids::heart();
        let solid =
            brillianteer_math::TriangleMesh::new(brillianteer_math::Surface::new(vertices, triangles))
                .unwrap();
        let first = Document::first().unwrap().work.design;
        let heart = Design { cut: Cut::Mesh(brillianteer_cut::MeshShape(Arc::new(solid))), ..first };
        let specimen = brillianteer_scene::Specimen::new(heart).unwrap();
        design_file::write(&specimen, DesignFormat::Glb, &path).unwrap();
        for form in [MeshForm::Triangles, MeshForm::Faceted] {
            let options = MeshOptions {
                up: Up::Given(DVec3::new(0.0, 0.6, 0.8)),
                form,
                unit: MeshUnit::Millimetres(500.0),
                part: MeshPart::Number(1),
                evening: Evening::AsFound,
            };
            let work = Document::open(&path, &options).unwrap().work;
            let mut safe = Autosave::new(folder.path().join("safe"));
            safe.keep(&alone(&work, Some(&path))).unwrap();
            drop(safe);
            let found = Autosave::new(folder.path().join("safe")).found().remove(0);
            assert!(found.design == work.design, "{form:?}");
            let recovered = Document::recovered(&found).unwrap();
            assert_eq!(recovered.work.mesh, work.mesh);
            assert_eq!(recovered.work.mesh.as_ref().map(|mesh| &mesh.options), Some(&options));
            assert!(recovered.is_changed());
            let mut older: serde_json::Value =
                serde_json::from_slice(&std::fs::read(&found.file).unwrap()).unwrap();
            older.as_object_mut().unwrap().remove("read").unwrap();
            let around = older["around"].as_object_mut().unwrap();
            let copies = around.remove("copies").unwrap();
            around.insert("company".to_owned(), copies);
            std::fs::write(&found.file, older.to_string()).unwrap();
            let found = Autosave::new(folder.path().join("safe")).found().remove(0);
            assert!(found.mesh.is_none() && matches!(found.design.cut, Cut::Mesh(_) | Cut::Planes(_)));
            forget(&found.file);
        }
    }

    #[test]
    fn saved_work_is_not_offered_again_and_rubbish_is_passed_over() {
        let folder = tempfile::tempdir().unwrap();
        let mut safe = Autosave::new(folder.path().join("new"));
        assert_eq!(safe.found(), []);
        safe.keep(&alone(&Document::first().unwrap().work, None)).unwrap();
        safe.empty();
        drop(safe);
        let next = Autosave::new(folder.path().join("new"));
        std::fs::write(folder.path().join("new/unsaved-1.json"), "{").unwrap();
        assert_eq!(next.found(), []);
    }
}
