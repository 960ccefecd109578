//! The numbers that a shape's function is made of, for tracers that compute it elsewhere.

use super::ImplicitSurface;
use super::profile::Profile;
use glam::{DMat3, DVec2, DVec3};

/// In the shape's own frame, in units of its `reach`: lengths there are 1 at most.
pub(crate) struct SurfaceParts {
    /// The outline: a rectangle's half sides, 0 for a triangle; or a triangle's corner.
    pub corner: DVec2,
    /// Radius of the disc rolled around a rectangle; z of a triangle's apex.
    pub round: f64,
    /// Of a triangle, the outward unit normal of the flank at +y, and that flank's length.
    pub flank: Option<(DVec2, f64)>,
    /// Half the length of the core.
    pub half: f64,
    /// Radius of the ball.
    pub edge: f64,
    /// Distance of the body's farthest point from the origin.
    pub body_reach: f64,
    /// Amplitude of the wave, its waves per unit, and its phase in turns.
    pub wave: Option<[f64; 3]>,
    /// The frame's axes in the world.
    pub axes: DMat3,
    /// Its origin there.
    pub shift: DVec3,
    /// The length of its unit there.
    pub unit: f64,
}

impl ImplicitSurface {
    /// See [`SurfaceParts`].
    pub(crate) fn parts(&self) -> SurfaceParts {
        let reach = self.own_reach();
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
            axes: DMat3::from_quat(self.turn),
            shift: self.shift,
            unit: self.scale * reach,
        }
    }
}
