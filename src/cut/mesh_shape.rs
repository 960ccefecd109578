//! The shape of a stone that no planes describe.

use crate::math::Shell;
use std::ops::Deref;
use std::sync::Arc;

/// A closed surface of triangles in the stone's frame: z up, half its width 1. Shared, as it may be large.
#[derive(Debug, Clone)]
pub struct MeshShape(pub Arc<Shell>);

impl PartialEq for MeshShape {
    /// By corners and triangles: what else a shell has follows from them, but for the rounding of the way it was made.
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (self.surface(), other.surface());
        Arc::ptr_eq(&self.0, &other.0) || (&a.vertices, &a.triangles) == (&b.vertices, &b.triangles)
    }
}

impl Deref for MeshShape {
    type Target = Shell;

    fn deref(&self) -> &Shell {
        &self.0
    }
}
