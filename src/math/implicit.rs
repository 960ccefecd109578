//! Glass shapes as functions of space: below 0 inside, 0 on the surface, above 0 outside, with exact derivatives.
//!
//! The convex forms are a core (an outline drawn out along an axis) and a ball rolled around it, as Minkowski adds sets: the
//! function is the distance from the core less the ball's radius, and convex. The idea of such functions is Inigo Quilez's
//! (articles on 2D and 3D distance functions). The plate is a box sheared along z; its function is the box's, of the point
//! with the shear taken back.

mod body;
mod error;
mod jet;
#[cfg(feature = "gpu")]
mod parts;
mod profile;
mod roots;
mod triangles;
mod wave;

#[cfg(test)]
mod tests;

use self::body::RoundedBody;
pub use self::error::ImplicitSurfaceError;
pub use self::jet::Jet;
#[cfg(feature = "gpu")]
pub(crate) use self::parts::SurfaceParts;
use self::profile::{Profile, Triangle};
use self::wave::Wave;
use super::Surface;
use glam::{DMat3, DQuat, DVec3};

/// What a shape is, in girdle radii; its middle is the origin of its own frame. An `edge` of 0 is sharp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ImplicitForm {
    /// A stadium in x and y, long along the greater of the two, drawn out along z.
    Pill {
        /// Its outer dimensions.
        size: DVec3,
        /// Radius of all its edges; at most half of its least dimension.
        edge: f64,
    },
    /// A box.
    Block {
        /// Its outer dimensions.
        size: DVec3,
        /// Radius of its edges and corners; at most half of its least dimension.
        edge: f64,
    },
    /// A rounded rectangle in x and y, drawn out along z.
    Pane {
        /// Its outer dimensions.
        size: DVec3,
        /// Radius of the outline's corners; at most half of the lesser of x and y.
        corner: f64,
        /// Radius of the edges around both faces; at most half of z, and `corner`.
        edge: f64,
    },
    /// An isosceles triangle in y and z, its base down and its apex up, drawn out along x.
    Prism {
        /// Length x, base y and height z between its flat faces' planes; rounding takes the edges away, not the faces.
        size: DVec3,
        /// Radius of its edges and corners; at most half its length and the radius of the circle in the triangle.
        edge: f64,
    },
    /// A box sheared along z by a sin(k x + phase) sin(k y + phase), k = 2π / wavelength: as thick as the box measured along
    /// z. Not convex, unless the amplitude is 0.
    Plate {
        /// Outer dimensions of the box.
        size: DVec3,
        /// Radius of the box's edges and corners; at most half of its least dimension.
        edge: f64,
        /// The wave's a, 0 or more.
        amplitude: f64,
        /// Length of a wave along x and along y.
        wavelength: f64,
        /// Where the wave begins, in radians.
        phase: f64,
    },
}

/// A shape somewhere in the world.
///
/// Points, distances and derivatives are the world's. A point *on the surface* is one to which an entry or an exit led, up to
/// rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImplicitSurface {
    form: ImplicitForm,
    body: RoundedBody,
    wave: Option<Wave>,
    scale: f64,
    turn: DQuat,
    shift: DVec3,
}

impl ImplicitSurface {
    /// A shape in its own frame.
    ///
    /// # Errors
    /// Names the dimension that is no number or out of its range.
    pub fn new(form: ImplicitForm) -> Result<Self, ImplicitSurfaceError> {
        error::check(&form)?;
        let (body, wave) = match form {
            ImplicitForm::Pill { size, edge } => (RoundedBody::pill(size, edge), None),
            ImplicitForm::Block { size, edge } => (RoundedBody::block(size, edge), None),
            ImplicitForm::Pane { size, corner, edge } => (RoundedBody::pane(size, corner, edge), None),
            ImplicitForm::Prism { size, edge } => (RoundedBody::prism(size, edge), None),
            ImplicitForm::Plate { size, edge, amplitude, wavelength, phase } => (
                RoundedBody::block(size, edge),
                (amplitude > 0.0).then(|| Wave::new(amplitude, wavelength, phase)),
            ),
        };
        Ok(Self { form, body, wave, scale: 1.0, turn: DQuat::IDENTITY, shift: DVec3::ZERO })
    }

    /// The same shape elsewhere: scaled by a factor above 0, turned, then shifted.
    pub fn moved(&self, scale: f64, turn: DQuat, shift: DVec3) -> Self {
        Self {
            scale: self.scale * scale,
            turn: turn * self.turn,
            shift: turn * self.shift * scale + shift,
            ..*self
        }
    }

    /// What the shape is in its own frame.
    pub fn form(&self) -> ImplicitForm {
        self.form
    }

    /// Whether light that has left never meets it again.
    pub fn is_convex(&self) -> bool {
        self.wave.is_none()
    }

    /// The function and its derivatives at a point.
    ///
    /// Of a convex form the value is the distance from the surface, negative inside. Of a plate it is 0 on the surface and has
    /// the right sign elsewhere. Inside, where faces are equally near, derivatives are those of one of them.
    pub fn jet(&self, point: DVec3) -> Jet {
        self.jet_as(point, false)
    }

    /// The function alone; see [`jet`](Self::jet).
    pub fn value(&self, point: DVec3) -> f64 {
        self.jet(point).value
    }

    /// Its gradient: of length 1 for convex forms.
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        self.jet(point).gradient
    }

    /// Unit outward normal at a point of the surface; on a sharp edge that of one of its faces.
    pub fn normal(&self, point: DVec3) -> DVec3 {
        self.jet_as(point, true).normal()
    }

    /// How far the unit normal at a point of the surface changes over a displacement along the surface (the shape operator):
    /// symmetric, in 1 / girdle radii. The part of a displacement that is off the surface does not count.
    pub fn bend(&self, point: DVec3) -> DMat3 {
        self.jet_as(point, true).bend()
    }

    /// The distance, 0 or more, at which a ray from outside or from the surface first goes in; `None` where it does not. From a
    /// start inside it is 0 where the way leads deeper.
    ///
    /// The direction is a unit vector. `None` as well where a thousand steps do not lead there.
    pub fn entry(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.entry_counted(origin, direction).0
    }

    /// The distance, 0 or more, at which a ray from inside or from the surface next goes out.
    ///
    /// The direction is a unit vector. `None` where rounding has let the ray slip out, which takes one that runs along the
    /// surface, and where a thousand steps do not lead there.
    pub fn exit(&self, point: DVec3, direction: DVec3) -> Option<f64> {
        self.exit_counted(point, direction).0
    }

    /// The smallest box along the axes that holds it, (least, greatest); around a plate one that is large enough.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let high = DVec3::from(DVec3::AXES.map(|axis| self.support(axis)));
        let low = DVec3::from(DVec3::AXES.map(|axis| -self.support(-axis)));
        (low, high)
    }

    /// A distance from the origin that no point of it exceeds; a convex form's farthest point's, where it was not shifted.
    pub fn reach(&self) -> f64 {
        self.shift.length() + self.scale * self.own_reach()
    }

    /// Enclosed volume, by Steiner's formula; a shear keeps it.
    pub fn volume(&self) -> f64 {
        self.body.volume() * self.scale.powi(3)
    }

    /// Area of the shadow that a convex form casts along a unit direction; `None` for a plate with waves.
    pub fn silhouette_area(&self, direction: DVec3) -> Option<f64> {
        let own = self.turn.inverse() * direction;
        self.is_convex().then(|| self.body.silhouette_area(own) * self.scale * self.scale)
    }

    /// Where a point of this shape's matter is in `to`, the same shape at another place or time: a wave carries it up and down.
    pub fn carried(&self, point: DVec3, to: &Self) -> DVec3 {
        let body = self.unsheared(self.own(point));
        to.world(body + DVec3::Z * to.wave.map_or(0.0, |wave| wave.height(body)))
    }

    /// Names of its facets: faces that are flat or, of a pill, the side, and last what is rounded.
    pub fn facets(&self) -> &'static [&'static str] {
        match self.form {
            ImplicitForm::Pill { .. } => &["side", "top", "bottom", "edge"],
            ImplicitForm::Block { .. } | ImplicitForm::Pane { .. } | ImplicitForm::Plate { .. } => {
                &["right", "left", "back", "front", "top", "bottom", "edge"]
            }
            ImplicitForm::Prism { .. } => {
                &["base", "back flank", "front flank", "right end", "left end", "edge"]
            }
        }
    }

    /// The facet that a point of the surface is part of, by its place in [`facets`](Self::facets).
    pub fn facet(&self, point: DVec3) -> u32 {
        self.own_facet(self.unsheared(self.own(point)))
    }

    /// Of a point of the body.
    fn own_facet(&self, point: DVec3) -> u32 {
        // A flat face's normal is the same number all over.
        let normal = self.body.jet(point, true).gradient;
        let among =
            |normals: &[DVec3]| normals.iter().position(|n| *n == normal).unwrap_or(normals.len()) as u32;
        let [right, back, top] = DVec3::AXES;
        match (self.form, self.body.profile) {
            (ImplicitForm::Pill { .. }, _) if normal.z == 0.0 => 0,
            (ImplicitForm::Pill { .. }, _) => 1 + among(&[top, -top]),
            (_, Profile::Rectangle { .. }) => among(&[right, -right, back, -back, top, -top]),
            (_, Profile::Triangle(Triangle { normal: n, .. })) => {
                let flank = |side: f64| DVec3::new(0.0, side * n.x, n.y);
                among(&[-top, flank(1.0), flank(-1.0), right, -right])
            }
        }
    }

    fn jet_as(&self, point: DVec3, on_surface: bool) -> Jet {
        let own = self.own(point);
        let jet = self.body.jet(self.unsheared(own), on_surface);
        self.wave.map_or(jet, |wave| wave.shear(jet, own)).moved(self.scale, DMat3::from_quat(self.turn))
    }

    /// Greatest coordinate along a unit direction of the world.
    fn support(&self, direction: DVec3) -> f64 {
        let own = self.turn.inverse() * direction;
        let lift = self.wave.map_or(0.0, |wave| wave.amplitude * own.z.abs());
        (self.body.support(own) + lift) * self.scale + self.shift.dot(direction)
    }

    fn own_reach(&self) -> f64 {
        self.body.reach() + self.wave.map_or(0.0, |wave| wave.amplitude)
    }

    fn own(&self, point: DVec3) -> DVec3 {
        self.turn.inverse() * (point - self.shift) / self.scale
    }

    fn world(&self, own: DVec3) -> DVec3 {
        self.turn * own * self.scale + self.shift
    }

    /// A point of the own frame with the shear taken back.
    fn unsheared(&self, own: DVec3) -> DVec3 {
        self.wave.map_or(own, |wave| own - DVec3::Z * wave.height(own))
    }
}
