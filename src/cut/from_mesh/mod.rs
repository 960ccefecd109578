//! Makes a stone of the facets that were found on a surface: puts it upright, evens it where noise alone kept it from being
//! even, scales it by its girdle, and names its facets.
//!
//! The stone's frame is that of docs/architecture.md: +z out of the table, z = 0 at the crown's side of the girdle, +x
//! through a bezel or another facet of the crown that is its own mirror image. A long stone's width lies along x.

mod aim;
mod cues;
mod even;
mod name;
mod outline;

#[cfg(test)]
mod tests;

use crate::math::faceting::{Faceted, deviation};
use crate::math::{Plane, Polytope, PolytopeError, Symmetry};
use glam::{DQuat, DVec3};

pub use aim::directions;
use aim::{Aim, aim};
use outline::LEAST_UPRIGHT;

/// The direction that a surface's table faces, and how it is known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Up {
    /// Found from the shape; z is up by custom.
    #[default]
    Found,
    /// Found from the shape; this axis of the surface's frame is up by custom, as y is in glTF.
    FoundBy(DVec3),
    /// Given in the surface's frame, with any length but zero. The largest facet within 5 degrees is the table.
    Given(DVec3),
    /// Known exactly, in the surface's frame, of length 1. Only a facet square to it is the table.
    Known(DVec3),
    /// Known together with the whole pose of the stone. The surface is moved exactly so.
    Posed(Alignment),
}

/// Another direction that a person might have taken for up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Doubt {
    /// The direction in the surface's frame, a unit vector.
    pub other: DVec3,
}

/// How a surface was moved into the stone's frame: `stone = scale · (turn · surface) + shift`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// The scale, in girdle radii per unit of the surface.
    pub scale: f64,
    /// The rotation from the surface's frame into the stone's.
    pub turn: DQuat,
    /// The shift after scale and turn, girdle radii.
    pub shift: DVec3,
}

impl Alignment {
    /// Returns where a point of the surface lies in the stone's frame.
    pub fn of(&self, point: DVec3) -> DVec3 {
        self.scale * (self.turn * point) + self.shift
    }

    /// Returns the point of the surface that becomes the origin of the stone's frame.
    pub fn origin(&self) -> DVec3 {
        self.turn.inverse() * (-self.shift / self.scale)
    }

    fn plane(&self, plane: &Plane) -> Plane {
        let normal = self.turn * plane.normal;
        Plane::new(normal, self.scale * plane.offset + normal.dot(self.shift))
    }
}

/// A stone that was found in a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct FromMesh {
    /// Names, no two alike, and planes in the stone's frame, in the order table, crown, girdle, pavilion, culet.
    pub facets: Vec<(String, Plane)>,
    /// How the surface was moved into the stone's frame.
    pub pose: Alignment,
    /// The distance from the stone of the surface's corner that is farthest off, girdle radii.
    pub deviation: f64,
    /// The symmetry that the planes were given because they had it but for noise; [`Symmetry::NONE`] where they were left as
    /// found.
    pub evened: Symmetry,
    /// The direction that was taken as up, in the surface's frame, a unit vector.
    pub up: DVec3,
    /// Another direction that may be up, where the shape leaves a doubt.
    pub doubt: Option<Doubt>,
}

/// The reason why facets make no stone.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FromMeshError {
    /// A direction up that is zero or not finite.
    #[error("the direction up, {0}, points nowhere; three finite numbers that are not all 0 are expected")]
    Up(DVec3),
    /// The planes enclose nothing.
    #[error("the facets that were found make no stone: {0}")]
    Polytope(#[from] PolytopeError),
}

/// Poses, evens and names the facets of a surface.
///
/// # Errors
/// A direction up that is zero or not finite, or facets that enclose nothing once they are evened.
pub fn from_mesh(found: &Faceted, up: Up) -> Result<FromMesh, FromMeshError> {
    let posed = if let Up::Posed(pose) = up { Some(pose) } else { None };
    let middle = match posed {
        Some(pose) => pose.origin() - found.centre,
        None => even::centroid(&found.polytope),
    };
    let parts = even::FacetParts::about(found, middle);
    let Aim { axis, table, doubt } = aim(&found.polytope, &parts, up)?;
    let even = even::evened(&parts, axis, posed.is_some());
    let upright = match posed {
        Some(pose) => outline::as_posed(&even, &pose),
        None => outline::placed(&even, &parts.areas)?,
    };
    let posed: Vec<Plane> = even.planes.iter().map(|p| upright.plane(p)).collect();
    let polytope = Polytope::from_planes(&posed)?;
    let turn = upright.turn * even.turn;
    let shift = upright.shift - upright.scale * (turn * (found.centre + middle));
    let pose = Alignment { turn, shift, ..upright };
    let points: Vec<DVec3> = found.surface.vertices.iter().map(|&v| pose.of(v + found.centre)).collect();
    let given = found.faces.iter().map(|f| f.name.clone()).collect::<Option<Vec<_>>>();
    let facets = name::named(&posed, table, given, upright.scale * found.tolerance);
    Ok(FromMesh {
        facets,
        pose,
        deviation: deviation(&polytope, &points),
        evened: even.symmetry(upright.turn),
        up: axis,
        doubt,
    })
}
