//! Floor 6: the editor's window.

pub mod profile_view;
