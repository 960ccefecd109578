//! The surroundings of the stones in a picture: light, and the backplate.

use brillianteer_math::Basis;
use brillianteer_scene::{Film, Mipmap, View};
use brillianteer_trace::environment::{Backplate, Environment, Lighting};
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The surroundings of the stones in a picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Surroundings {
    /// The light around the stones, with its map.
    pub lighting: Arc<Lighting>,
    /// The angle by which the light is turned about its axis, and a world about its vertical, radians.
    pub turn: f64,
    /// True where the light's axis points up in the picture, so that its horizon lies level behind the stones and its
    /// azimuth 0 in the middle; else the axis points to the eye. Worlds stand upright in any case.
    pub is_upright: bool,
    /// The half angle of the observer's head, radians; 0 for no head.
    pub head: f64,
    /// True where pixels beside the stones show the light.
    pub shows_light: bool,
    /// The picture behind the stones.
    pub backplate: Option<HungPicture>,
}

/// A picture that hangs behind the stones and fills the film from there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HungPicture {
    /// The pixels, as linear light, with their coarser levels.
    pub picture: Arc<Mipmap>,
    /// The width of the picture as a multiple of the film's.
    pub span: f64,
    /// The distance behind the origin, in girdle radii.
    pub distance: f64,
    /// The film that it fills: that of the picture without zoom and displacement.
    pub frame: Film,
}

impl Surroundings {
    /// Returns the surroundings of a light alone: no picture hangs behind, and pixels beside the stones are clear.
    pub fn of(lighting: Arc<Lighting>) -> Self {
        let head = lighting.light.head.to_radians();
        Self { lighting, turn: 0.0, is_upright: false, head, shows_light: false, backplate: None }
    }

    /// Returns the frame of the light in a view, turned.
    fn light_basis(&self, view: &View) -> Basis {
        let rest = view.light_basis();
        // Worlds are drawn upright: their vertical axis is y.
        let is_world = self.lighting.light.world.is_some();
        let rest = if self.is_upright && !is_world {
            Basis { right: -rest.toward, up: -rest.right, toward: rest.up }
        } else {
            rest
        };
        let turned = |x: DVec3| rest.right * x.x + rest.up * x.y + rest.toward * x.z;
        if is_world {
            let turn = DQuat::from_rotation_y(self.turn);
            return Basis { right: turned(turn * DVec3::X), up: rest.up, toward: turned(turn * DVec3::Z) };
        }
        let turn = DQuat::from_rotation_z(self.turn);
        Basis { right: turned(turn * DVec3::X), up: turned(turn * DVec3::Y), toward: rest.toward }
    }

    /// Returns the environment of a view.
    pub(super) fn around(&self, view: &View) -> Environment<'_> {
        let basis = self.light_basis(view);
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
