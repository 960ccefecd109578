//! Glass shapes as functions of space, with exact derivatives: below 0 inside, 0 on the surface, above 0 outside.
//!
//! A convex form is the Minkowski sum of a core (an outline drawn out along an axis) and a ball. Its function is the
//! distance from the core less the ball's radius, which is convex. The idea of such functions is Inigo Quilez's (articles on
//! 2D and 3D distance functions). The plate is a box sheared along z. Its function is that of the box, taken at the point
//! with the shear undone.

use serde::{Deserialize, Serialize};

mod body;
mod error;
mod jet;
mod parts;
mod profile;
mod roots;
mod triangles;
mod wave;

#[cfg(test)]
mod tests;

use self::body::RoundedBody;
pub use self::error::{ImplicitSurfaceError, MOST_WAVES, STEEPEST};
pub use self::jet::Jet;
pub use self::parts::SurfaceParts;
use self::profile::{Profile, Triangle};
use self::wave::Wave;
use super::Surface;
use glam::{DMat3, DVec3};

/// The form of a glass shape and its dimensions, in girdle radii.
///
/// The middle of the shape is the origin of its own frame. An `edge` of 0 is sharp.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum ImplicitForm {
    /// A stadium in x and y, long along the greater of the two and drawn out along z.
    Pill {
        /// The outer dimensions.
        size: DVec3,
        /// The radius of all edges; at most half of the least dimension.
        edge: f64,
    },
    /// A box.
    Block {
        /// The outer dimensions.
        size: DVec3,
        /// The radius of the edges and corners; at most half of the least dimension.
        edge: f64,
    },
    /// A rounded rectangle in x and y, drawn out along z.
    Pane {
        /// The outer dimensions.
        size: DVec3,
        /// The radius of the outline's corners; at most half of the lesser of x and y.
        corner: f64,
        /// The radius of the edges around both faces; at most half of z, and at most `corner`.
        edge: f64,
    },
    /// An isosceles triangle in y and z, with its base below and its apex above, drawn out along x.
    Prism {
        /// The length x, base y and height z between the planes of the flat faces. Rounding takes the edges away, not the
        /// faces.
        size: DVec3,
        /// The radius of the edges and corners; at most half of the length, and at most the radius of the triangle's
        /// inscribed circle.
        edge: f64,
    },
    /// A box sheared along z by the wave a sin(k x + phase) sin(k y + phase), k = 2π / wavelength.
    ///
    /// Measured along z it is as thick as the box. It is not convex, unless the amplitude is 0.
    Plate {
        /// The outer dimensions of the box.
        size: DVec3,
        /// The radius of the box's edges and corners; at most half of its least dimension.
        edge: f64,
        /// The amplitude a of the wave, 0 or more.
        amplitude: f64,
        /// The length of the wave along x and along y.
        wavelength: f64,
        /// The phase of the wave, in radians.
        phase: f64,
    },
}

/// A glass shape in its own frame.
///
/// A point *on the surface* is one that an entry or an exit has led to, up to rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImplicitSurface {
    form: ImplicitForm,
    body: RoundedBody,
    wave: Option<Wave>,
}

impl ImplicitSurface {
    /// Makes a shape in its own frame.
    ///
    /// # Errors
    /// Names the dimension that is not a number or is out of its range.
    pub fn new(form: ImplicitForm) -> Result<Self, ImplicitSurfaceError> {
        error::check(&form)?;
        Ok(Self::checked(form))
    }

    /// Makes a shape in its own frame. The caller has checked its dimensions, perhaps in another unit: an edge that
    /// rounding has made too large is made as large as there is room for.
    pub fn checked(form: ImplicitForm) -> Self {
        let most = form.largest_edge();
        let (body, wave) = match form {
            ImplicitForm::Pill { size, edge } => (RoundedBody::pill(size, edge.min(most)), None),
            ImplicitForm::Block { size, edge } => (RoundedBody::block(size, edge.min(most)), None),
            ImplicitForm::Pane { size, corner, edge } => {
                (RoundedBody::pane(size, corner, edge.min(most)), None)
            }
            ImplicitForm::Prism { size, edge } => (RoundedBody::prism(size, edge.min(most)), None),
            ImplicitForm::Plate { size, edge, amplitude, wavelength, phase } => (
                RoundedBody::block(size, edge.min(most)),
                (amplitude > 0.0).then(|| Wave::new(amplitude, wavelength, phase)),
            ),
        };
        Self { form, body, wave }
    }

    /// Returns the form of the shape.
    pub fn form(&self) -> ImplicitForm {
        self.form
    }

    /// Whether the shape is convex, so that light that has left it never meets it again.
    pub fn is_convex(&self) -> bool {
        self.wave.is_none()
    }

    /// Returns the function and its derivatives at a point.
    ///
    /// For a convex form the value is the distance from the surface, negative inside. For a plate it is 0 on the surface and
    /// has the right sign elsewhere. Inside, where several faces are equally near, the derivatives are those of one of them.
    pub fn jet(&self, point: DVec3) -> Jet {
        self.jet_as(point, false)
    }

    /// Returns the value of the function alone; see [`jet`](Self::jet).
    pub fn value(&self, point: DVec3) -> f64 {
        self.jet(point).value
    }

    /// Returns the unit outward normal at a point of the surface; on a sharp edge that of one of its faces.
    pub fn normal(&self, point: DVec3) -> DVec3 {
        self.jet_as(point, true).normal()
    }

    /// Returns how the unit normal at a point of the surface changes with a displacement along the surface (the shape
    /// operator).
    ///
    /// The matrix is symmetric, in 1 / girdle radii. The part of a displacement that leads off the surface does not count.
    pub fn bend(&self, point: DVec3) -> DMat3 {
        self.jet_as(point, true).bend()
    }

    /// Returns the distance, 0 or more, at which a ray from outside or from the surface first enters.
    ///
    /// The direction is a unit vector. From a start inside, the distance is 0 if the ray leads deeper. `None` if the ray
    /// does not enter, or if a thousand steps do not lead to the place.
    pub fn entry(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.way_in(origin, direction, &mut 0)
    }

    /// Returns the distance, 0 or more, at which a ray from inside or from the surface next leaves.
    ///
    /// The direction is a unit vector. `None` if rounding has let the ray slip out, which happens only to rays that run
    /// along the surface, or if a thousand steps do not lead to the place.
    pub fn exit(&self, point: DVec3, direction: DVec3) -> Option<f64> {
        self.way_out(point, direction, &mut 0)
    }

    /// Returns a distance from the origin that no point of the shape exceeds. For a convex form it is the distance of the
    /// farthest point.
    pub fn reach(&self) -> f64 {
        self.body.reach() + self.wave.map_or(0.0, |wave| wave.amplitude)
    }

    /// Returns the enclosed volume, by Steiner's formula; a shear does not change it.
    pub fn volume(&self) -> f64 {
        self.body.volume()
    }

    /// Returns the area of the shadow that a convex form casts along a unit direction; `None` for a plate with waves.
    pub fn silhouette_area(&self, direction: DVec3) -> Option<f64> {
        self.is_convex().then(|| self.body.silhouette_area(direction))
    }

    /// Returns where a point of this shape's matter lies in `to`, the same shape at another time.
    ///
    /// A wave carries the matter up and down.
    pub fn carried(&self, point: DVec3, to: &Self) -> DVec3 {
        let body = self.unsheared(point);
        body + DVec3::Z * to.wave.map_or(0.0, |wave| wave.height(body))
    }

    /// Returns the names of the facets: the flat faces (and the side of a pill), then the rounded part.
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

    /// Returns the facet that a point of the surface belongs to, by its place in [`facets`](Self::facets).
    pub fn facet(&self, point: DVec3) -> u32 {
        self.own_facet(self.unsheared(point))
    }

    /// Returns the facet that a point of the body's surface belongs to.
    fn own_facet(&self, point: DVec3) -> u32 {
        // A flat face has exactly the same normal everywhere.
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
        let jet = self.body.jet(self.unsheared(point), on_surface);
        self.wave.map_or(jet, |wave| wave.shear(jet, point))
    }

    /// Returns the greatest coordinate along a unit direction, or with waves a bound of it.
    pub fn support(&self, direction: DVec3) -> f64 {
        let lift = self.wave.map_or(0.0, |wave| wave.amplitude * direction.z.abs());
        self.body.support(direction) + lift
    }

    /// Returns a point with the shear undone.
    fn unsheared(&self, point: DVec3) -> DVec3 {
        self.wave.map_or(point, |wave| point - DVec3::Z * wave.height(point))
    }
}
