//! The state of the editor, without a window.

pub mod command;
pub mod compare;
pub mod document;
pub mod extent;
pub mod eye;
pub mod framing;
pub mod history;
pub mod keeping;
pub mod moving;
pub mod notes;
pub mod opening;
pub mod ordering;
pub mod pose_cache;
pub mod preset;
pub mod view_history;
pub mod workspace;
