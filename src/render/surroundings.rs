//! What is around the stones of a picture: light, and what hangs behind.

use crate::math::Basis;
use crate::scene::{Film, Mipmap, View};
use crate::trace::environment::{Backplate, Environment, Lighting};
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What is around the stones of a picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Surroundings {
    /// The light around the stones, ready to be looked up.
    pub lighting: Arc<Lighting>,
    /// The angle by which the light is turned about its axis, radians.
    pub turn: f64,
    /// Whether the light's axis points up in the picture, so that its horizon lies level behind the stones and its azimuth 0 in
    /// the middle; else the axis points to the eye.
    pub is_upright: bool,
    /// The half angle of the observer's head, radians; 0 for no head.
    pub head: f64,
    /// Whether pixels beside the stones show the light.
    pub shows_light: bool,
    /// The picture behind the stones.
    pub backplate: Option<HungPicture>,
}

/// A picture that hangs behind the stones, and fills the film from there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HungPicture {
    /// The pixels, as linear light, with their coarser levels.
    pub picture: Arc<Mipmap>,
    /// How many times as wide as the film it is.
    pub span: f64,
    /// The distance behind the origin, in girdle radii.
    pub distance: f64,
    /// The film that it fills: that of the picture without zoom and displacement.
    pub frame: Film,
}

impl Surroundings {
    /// Returns the plain surroundings of a light: nothing hangs behind, and pixels beside the stones are clear.
    pub fn of(lighting: Arc<Lighting>) -> Self {
        let head = lighting.light.head.to_radians();
        Self { lighting, turn: 0.0, is_upright: false, head, shows_light: false, backplate: None }
    }

    /// Returns the environment of a view.
    pub(super) fn around(&self, view: &View) -> Environment<'_> {
        let turn = DQuat::from_rotation_z(self.turn);
        let mut basis = view.light_basis();
        if self.is_upright {
            basis = Basis { right: -basis.toward, up: -basis.right, toward: basis.up };
        }
        let turned = |x: DVec3| basis.right * x.x + basis.up * x.y + basis.toward * x.z;
        let (right, up) = (turned(turn * DVec3::X), turned(turn * DVec3::Y));
        (basis.right, basis.up) = (right, up);
        let backplate = self
            .backplate
            .as_ref()
            .map(|hung| Backplate::filling(&hung.picture, hung.span, hung.distance, view, &hung.frame));
        Environment {
            map: &self.lighting.map,
            basis,
            eye: view.basis(),
            head: self.head,
            backplate,
            backdrop: self.shows_light || backplate.is_some(),
        }
    }
}
