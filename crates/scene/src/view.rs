//! A view: the direction from which a stone is seen, and the lean of scope, stone and eye against one another.

use brillianteer_math::Basis;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// The side of the stone that faces the eye while nothing is tilted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// Face up, through the table.
    #[default]
    Table,
    /// Face down, through the pavilion, as hearts are seen.
    Culet,
}

impl Side {
    /// Returns the side's name in figures and pictures.
    pub fn name(self) -> &'static str {
        match self {
            Self::Table => "table",
            Self::Culet => "culet",
        }
    }
}

/// The object that moves when a view is tilted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Lean {
    /// The stone leans, its table toward the azimuth; eye and scope stay.
    #[default]
    Stone,
    /// The eye moves toward the azimuth; stone and light stay.
    Eye,
}

/// The projection: how rays reach the eye.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub enum Projection {
    /// Parallel rays, as to an eye far away.
    #[default]
    Orthographic,
    /// An eye at this distance from the origin, in girdle radii; it must be outside the stone.
    Perspective {
        /// The distance, in girdle radii.
        distance: f64,
    },
}

/// A view of a stone.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// The side that faces the eye while nothing is tilted.
    pub side: Side,
    /// The object that the tilt moves.
    pub lean: Lean,
    /// The tilt, radians, -π/2 to π/2.
    pub tilt: f64,
    /// The azimuth, radians in the frame of a stone that is not turned, toward which the tilt leans.
    pub azimuth: f64,
    /// The rotation of the stone under eye and light. The view is given in the stone's own frame, so that a turning
    /// stone keeps its geometry.
    pub turn: DQuat,
    /// Parallel rays or perspective.
    pub projection: Projection,
}

impl View {
    /// Returns the view of a stone that is turned further, before the turn of this view.
    pub fn of_turned(&self, turn: DQuat) -> Self {
        Self { turn: self.turn * turn, ..*self }
    }

    /// Returns the image plane in the stone's frame. Its axis points to the eye.
    pub fn basis(&self) -> Basis {
        self.leaning().turned(self.turn.inverse())
    }

    /// Returns the image plane in the frame of a stone that is not turned.
    fn leaning(&self) -> Basis {
        let rest = self.rest();
        let side = DVec3::new(self.azimuth.cos(), self.azimuth.sin(), 0.0);
        // A stone that leans toward an azimuth shows the eye its other side. Through the pavilion the eye is at the opposite
        // end of the same line, which reverses both cases.
        let toward_azimuth = match (self.lean, self.side) {
            (Lean::Stone, Side::Table) => -1.0,
            (Lean::Stone, Side::Culet) | (Lean::Eye, _) => 1.0,
        };
        let (sin, cos) = self.tilt.sin_cos();
        rest.aimed(rest.toward * cos + side * (toward_azimuth * sin))
    }

    /// Returns the scope's axis in the stone's frame. Elevations of light are counted from the plane square to it.
    pub fn zenith(&self) -> DVec3 {
        self.light_basis().toward
    }

    /// Returns the frame in which light is given: its axis, and the other two axes of the image before the tilt.
    pub fn light_basis(&self) -> Basis {
        match self.lean {
            Lean::Stone => self.basis(),
            Lean::Eye => self.rest().turned(self.turn.inverse()),
        }
    }

    /// Returns the factor by which a picture that hangs `behind` girdle radii behind the origin must be larger than
    /// one in the image plane, to fill the view.
    pub fn widening(&self, behind: f64) -> f64 {
        match self.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective { distance } => (distance + behind) / distance,
        }
    }

    fn rest(&self) -> Basis {
        match self.side {
            Side::Table => Basis::FACE_UP,
            Side::Culet => Basis::FACE_DOWN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_untilted_view_looks_down_on_the_table_or_up_at_the_culet() {
        let table = View::default();
        assert_eq!(table.basis(), Basis::FACE_UP);
        assert_eq!(table.zenith(), DVec3::Z);
        assert_eq!(View { side: Side::Culet, ..table }.basis(), Basis::FACE_DOWN);
    }

    #[test]
    fn a_leaning_stone_turns_its_far_side_to_the_eye_and_carries_the_scope_along() {
        let view = View { tilt: 0.2, azimuth: 0.0, ..View::default() };
        assert!(view.basis().toward.x < 0.0);
        assert_eq!(view.zenith(), view.basis().toward);
        let eye = View { lean: Lean::Eye, ..view };
        assert!(eye.basis().toward.x > 0.0);
        assert_eq!(eye.zenith(), DVec3::Z);
    }

    #[test]
    fn the_pavilion_side_of_a_leaning_stone_is_seen_from_the_opposite_end_of_the_same_line() {
        let table = View { tilt: 0.3, azimuth: 1.0, ..View::default() };
        let culet = View { side: Side::Culet, ..table };
        assert!((table.basis().toward + culet.basis().toward).length() < 1e-15);
    }
}
