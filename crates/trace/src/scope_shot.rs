//! The subject of a picture in a scope by point rays, for the processor and for graphics cards.

use super::ray::RayOptions;
use brillianteer_math::SolidRef;
use brillianteer_scene::{Film, Medium, Scope, View};
use glam::DVec2;

/// One picture in a scope, whose rays form a regular grid in each pixel.
#[derive(Clone, Copy)]
pub struct ScopeShot<'a> {
    /// The stone.
    pub solid: SolidRef<'a>,
    /// The stone's medium.
    pub medium: Medium,
    /// The view from which the stone is seen.
    pub view: &'a View,
    /// The scope; graphics cards accept a scope of at most eight bands.
    pub scope: &'a Scope,
    /// The picture's pixels.
    pub film: Film,
    /// The number of rays along each side of a pixel, at least 1.
    pub per_side: u32,
    /// The place of each ray in its cell of the grid, 0 to 1; (0.5, 0.5) is the middle.
    pub shift: DVec2,
    /// The limits up to which rays are followed; graphics cards follow them for at most `MOST_BOUNCES` bounces.
    pub options: RayOptions,
}
