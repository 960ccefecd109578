//! A small file that says whether the window is at rest. Tests that operate the real program wait for its content,
//! and not for a length of time.

use brillianteer_files::{WriteError, write};
use brillianteer_session::model::workspace::PaneLayout;
use serde::Serialize;
use std::path::PathBuf;

/// The environment variable that names the file; without it, no file is written.
const VARIABLE: &str = "BRILLIANTEER_STATE_FILE";

/// The number of quiet frames in a row after which a window is at rest.
///
/// A frame has still to be painted when it is noted, a driver keeps up to three painted frames before it shows them, and
/// drawings glide to their places meanwhile.
const QUIET_FRAMES: u32 = 30;

/// The content of the file, as JSON.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct State {
    /// True once every picture and figure is final and the screen shows them.
    at_rest: bool,
    /// The layout of the views.
    layout: PaneLayout,
    blocks: BlockSizes,
}

/// The factors by which pixels of pictures in sight are larger than those of the film.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct BlockSizes {
    /// The factor of the coarsest render; 1 where there is none.
    pub renders: f64,
    /// The factor of the coarsest of the other pictures; 1 where there is none.
    pub others: f64,
}

/// Writes the file whenever the state has changed.
#[derive(Debug)]
pub struct StateFile {
    path: PathBuf,
    written: Option<State>,
    quiet_frames: u32,
}

impl StateFile {
    /// Returns the file that the environment names, if it names one.
    pub fn from_environment() -> Option<Self> {
        let path = std::env::var_os(VARIABLE).filter(|path| !path.is_empty())?;
        Some(Self { path: path.into(), written: None, quiet_frames: 0 })
    }

    /// Records a frame, at its end. `is_quiet` says that no work is going on; `blocks` are those of the pictures in sight.
    ///
    /// Returns whether one more frame is needed to find out whether the window is at rest.
    pub fn note(&mut self, is_quiet: bool, layout: PaneLayout, blocks: BlockSizes) -> bool {
        self.quiet_frames = if is_quiet { self.quiet_frames.saturating_add(1) } else { 0 };
        let at_rest = self.quiet_frames >= QUIET_FRAMES;
        let state = State { at_rest, layout, blocks };
        // If the file cannot be written, the test that waits for it fails; no user has to know.
        if self.written != Some(state) && self.put(&state).is_ok() {
            self.written = Some(state);
        }
        is_quiet && !at_rest
    }

    fn put(&self, state: &State) -> Result<(), WriteError> {
        let text = serde_json::to_vec(state).map_err(|e| WriteError::io(&self.path, e))?;
        write(&self.path, |file| file.write_all(&text).map_err(|e| WriteError::io(&self.path, e)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_rests_after_enough_quiet_frames_and_stops_resting_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("state.json");
        let mut file = StateFile { path: path.clone(), written: None, quiet_frames: 0 };
        let mut note = |is_quiet| {
            let needs_another =
                file.note(is_quiet, PaneLayout::Two, BlockSizes { renders: 1.0, others: 1.0 });
            let text = std::fs::read(&path).unwrap();
            let state: serde_json::Value = serde_json::from_slice(&text).unwrap();
            (needs_another, state["at_rest"].as_bool().unwrap())
        };
        for _ in 0..2 {
            assert_eq!(note(false), (false, false));
            for _ in 1..QUIET_FRAMES {
                assert_eq!(note(true), (true, false));
            }
            assert_eq!(note(true), (false, true));
            assert_eq!(note(true), (false, true));
        }
    }
}
