//! The part of a ray's light that does not leave the stone.

/// The part of a ray's light that did not leave the stone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Loss {
    /// Share of the light that was absorbed.
    pub absorbed: f64,
    /// Share of the light that was not followed to its end.
    pub unresolved: f64,
    /// The number of bounces inside the stone, along the longest path where there are several.
    pub bounces: u32,
}

impl Loss {
    /// Adds up the losses of two passages; `bounces` is the greater of the two.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self {
            absorbed: self.absorbed + other.absorbed,
            unresolved: self.unresolved + other.unresolved,
            bounces: self.bounces.max(other.bounces),
        }
    }
}
