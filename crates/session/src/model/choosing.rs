//! Questions for files, which the user answers in a dialog of the system or of the window.

use std::path::PathBuf;

/// The purpose for which the user chooses a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A design to open.
    Open,
    /// A file to save to.
    SaveAs,
    /// A design to compare with.
    Compare,
    /// A light or a panorama.
    Light,
    /// A picture for the backplate.
    Behind,
    /// A folder to export to.
    Folder,
    /// A goal of the search for a better cut.
    Goal,
    /// A file to save that goal to.
    SaveGoal,
}

impl Purpose {
    /// Returns the heading of the dialog that asks for the file.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Open => "Open a cut",
            Self::SaveAs => "Save the cut as",
            Self::Compare => "Compare with a cut",
            Self::Light => "Choose a light or a panorama",
            Self::Behind => "Choose a background picture",
            Self::Folder => "Choose a folder for the files",
            Self::Goal => "Open a goal",
            Self::SaveGoal => "Save the goal as",
        }
    }

    /// Returns whether the file is to be written, so that it need not exist.
    pub fn is_new(self) -> bool {
        matches!(self, Self::SaveAs | Self::SaveGoal)
    }
}

/// A question for a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// The purpose of the file.
    pub purpose: Purpose,
    /// The name that is proposed for a new file.
    pub name: String,
    /// The number of the document that the file is for.
    pub document: u64,
}

/// The answer to a question.
#[derive(Debug, Clone, PartialEq)]
pub enum Choice {
    /// The file that was chosen.
    File(PathBuf),
    /// The user chose no file.
    GivenUp,
    /// The user was not asked: the system has no dialog.
    NoDialog,
}
