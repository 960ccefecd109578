//! Whether the planes of a stone are evened.

use serde::{Deserialize, Serialize};

/// Whether planes are given the symmetry that they have except for noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Evening {
    /// Planes are evened where the even stone is as likely as the one that was found.
    #[default]
    WhereLikely,
    /// Planes stay as they were found.
    AsFound,
}
