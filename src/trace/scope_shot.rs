//! What point rays trace for a picture in a scope, on the processor or a graphics card.

use super::ray::RayOptions;
use crate::math::SolidRef;
use crate::scene::{Film, Medium, Scope, View};
use glam::DVec2;

/// One picture in a scope; its rays stand on a regular grid in each pixel.
#[derive(Clone, Copy)]
pub struct ScopeShot<'a> {
    /// The stone.
    pub solid: SolidRef<'a>,
    /// The stone's medium.
    pub medium: Medium,
    /// The view from which the stone is seen.
    pub view: &'a View,
    /// The scope; graphics cards take one of eight bands at most.
    pub scope: &'a Scope,
    /// The picture's pixels.
    pub film: Film,
    /// Rays along each side of a pixel, at least 1.
    pub per_side: u32,
    /// The place of each ray in its cell of that grid, 0 to 1; (0.5, 0.5) is the middle.
    pub shift: DVec2,
    /// How far rays are followed; graphics cards follow them to `MOST_BOUNCES` at most.
    pub options: RayOptions,
}
