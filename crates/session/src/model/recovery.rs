//! Unsaved work that is kept on disk, and work that a crash left there.

use super::render_settings::RenderSettings;
use super::view_history::ViewState;
use super::work::{ReadMesh, Work};
use brillianteer_base::Failure;
use brillianteer_cut::Design;
use brillianteer_files::cut_file;
use brillianteer_scene::{Companion, Companions, Copies, MetalInstance, Pose, SceneRing, Specimen};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::SystemTime;

/// The companions of the copies in an autosave, in mm.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct KeptCompanions {
    /// The text of each stone's cut file, and the stone's place.
    stones: Vec<(String, Pose)>,
    metals: Vec<MetalInstance>,
    /// The ring; autosaves of earlier versions have none.
    #[serde(default)]
    ring: Option<SceneRing>,
}

impl KeptCompanions {
    /// Returns the companions in the form in which an autosave keeps them.
    pub fn of(companions: &Companions) -> Self {
        let stone = |stone: &Companion| (cut_file::write(&stone.specimen.design), stone.pose);
        let Companions { stones, metals, ring } = companions;
        Self { stones: stones.iter().map(stone).collect(), metals: metals.clone(), ring: ring.clone() }
    }

    /// Builds the bodies again. Stones whose texts are alike are one specimen.
    ///
    /// # Errors
    /// Fails where a stone cannot be read or built.
    pub fn built(&self) -> Result<Companions, Failure> {
        let mut made: Vec<(&str, Arc<Specimen>)> = vec![];
        let mut stones = vec![];
        for (text, pose) in &self.stones {
            let known =
                made.iter().find(|(other, _)| other == text).map(|(_, specimen)| Arc::clone(specimen));
            let specimen = match known {
                Some(specimen) => specimen,
                None => {
                    let design = cut_file::parse(text, "unsaved work")?;
                    let specimen =
                        Specimen::new(design).map_err(|error| Failure::Input(error.to_string()))?;
                    let specimen = Arc::new(specimen);
                    made.push((text, Arc::clone(&specimen)));
                    specimen
                }
            };
            stones.push(Companion { specimen, pose: *pose });
        }
        // A file may name a body that is not there.
        let ring = self.ring.clone().filter(|ring| ring.metal < self.metals.len());
        Ok(Companions { stones, metals: self.metals.clone(), ring })
    }
}

/// The part of the scene that an autosave keeps.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct KeptScene {
    // Autosaves of earlier versions name the copies so.
    #[serde(alias = "company")]
    /// The copies of the design.
    pub copies: Copies,
    /// The companions of the copies; autosaves of earlier versions have none.
    #[serde(default)]
    pub companions: KeptCompanions,
    /// The copies and their companions as they were opened or last written as a scene, where they have been moved since.
    #[serde(default)]
    pub laid: Option<(Copies, KeptCompanions)>,
    /// The settings of pictures; autosaves of earlier versions have none.
    #[serde(default)]
    pub settings: RenderSettings,
    /// The views, where they were kept.
    #[serde(default)]
    pub views: Option<ViewState>,
}

/// The content of an autosave.
#[derive(Debug, Clone, PartialEq)]
pub struct UnsavedWork {
    /// The work.
    pub work: Work,
    /// The scene around the stone.
    pub around: KeptScene,
    /// The file that the design was opened from.
    pub path: Option<PathBuf>,
    /// The autosave file of a crash that this work went on from, which is removed once the work is kept.
    pub replaces: Option<PathBuf>,
}

/// Work that is found when the program starts: left by a crash, or open when the program ended.
#[derive(Debug, Clone, PartialEq)]
pub struct RecoveredWork {
    /// The design.
    pub design: Design,
    /// The part of the scene that was kept.
    pub around: KeptScene,
    /// The file that the design was opened from.
    pub path: Option<PathBuf>,
    /// The design in that file, where it can be read.
    pub on_disk: Option<Design>,
    /// The mesh file that the stone was read from, if it was one.
    pub mesh: Option<ReadMesh>,
    /// The time when the work was last kept.
    pub when: SystemTime,
    /// The autosave file.
    pub file: PathBuf,
}
