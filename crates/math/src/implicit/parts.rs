//! The numbers that define a shape's function, for tracers that compute it elsewhere.

use super::ImplicitSurface;
use super::profile::Profile;
use glam::DVec2;

/// The numbers of a shape in its own frame, in units of its `reach`, so that no length exceeds 1.
pub struct SurfaceParts {
    /// The half sides of a rectangular outline without its disc; of a triangular one, the corner at +y.
    pub corner: DVec2,
    /// The radius of the disc rolled around a rectangle; of a triangle, the z of the apex.
    pub round: f64,
    /// Of a triangle, the outward unit normal of the flank at +y and the length of that flank; `None` for a rectangle.
    pub flank: Option<(DVec2, f64)>,
    /// Half the length of the core.
    pub half: f64,
    /// The radius of the ball.
    pub edge: f64,
    /// The distance of the body's farthest point from the origin.
    pub body_reach: f64,
    /// The amplitude of the wave, its waves per unit, and its phase in turns.
    pub wave: Option<[f64; 3]>,
}

impl ImplicitSurface {
    /// Returns the numbers of this shape.
    pub fn parts(&self) -> SurfaceParts {
        let reach = self.reach();
        let (corner, round, flank) = match self.body.profile {
            Profile::Rectangle { half, round } => (half, round, None),
            Profile::Triangle(t) => (t.corner, t.apex, Some((t.normal, t.flank / reach))),
        };
        SurfaceParts {
            corner: corner / reach,
            round: round / reach,
            flank,
            half: self.body.half / reach,
            edge: self.body.edge / reach,
            body_reach: self.body.reach() / reach,
            wave: self.wave.map(|wave| wave.parts(reach)),
        }
    }
}
