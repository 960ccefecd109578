//! Fits a plane to triangles by least squares over their area.

use crate::eigen::{eigen, outer};
use crate::{Plane, Surface};
use glam::{DMat3, DVec3};

/// A plane fitted to triangles, with the area and the width of the triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaneFit {
    /// The plane; its unit normal is on the side that the triangles face.
    pub plane: Plane,
    /// The area of the triangles.
    pub area: f64,
    /// The least width of the triangles in the plane: that of a rectangle with the same second moments.
    pub width: f64,
}

/// Returns the plane with the least mean square distance from the triangles, in which each point of their area has
/// the same weight.
///
/// The plane runs through the centroid. `None` where the triangles have no area.
pub(super) fn fit(surface: &Surface, triangles: &[u32]) -> Option<PlaneFit> {
    let corners = || triangles.iter().map(|&t| surface.corners(t as usize));
    // The corner as origin keeps the digits of a small region far from the middle.
    let origin = surface.corners(*triangles.first()? as usize)[0];
    let (mut area, mut first, mut facing) = (0.0, DVec3::ZERO, DVec3::ZERO);
    for [a, b, c] in corners() {
        let cross = (b - a).cross(c - a) / 2.0;
        let part = cross.length();
        facing += cross;
        area += part;
        first += part * (a + b + c - 3.0 * origin) / 3.0;
    }
    let middle = origin + first / area;
    let mut spread = DMat3::ZERO;
    for triangle in corners() {
        let part = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).length() / 2.0;
        let [a, b, c] = triangle.map(|v| v - middle);
        let sum = a + b + c;
        // ∫ x xᵀ dA over a triangle.
        spread += (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum)) * (part / 12.0);
    }
    let (values, vectors) = eigen(spread * (1.0 / area));
    let normal = vectors[0] * if vectors[0].dot(facing) < 0.0 { -1.0 } else { 1.0 };
    let width = (12.0 * values[1].max(0.0)).sqrt();
    let plane = Plane::new(normal, normal.dot(middle)).normalized()?;
    (area > 0.0 && area.is_finite()).then_some(PlaneFit { plane, area, width })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_of_a_rectangle_is_found_with_its_area_and_width() {
        let at = |x: f64, y: f64| DVec3::new(x, y, 1.0 + 0.5 * x);
        let vertices = vec![at(10.0, 0.0), at(11.0, 0.0), at(11.0, 0.25), at(10.0, 0.25)];
        let square = Surface::new(vertices, vec![[0, 1, 2], [0, 2, 3]]);
        let found = fit(&square, &[0, 1]).unwrap();
        let slope = 1.25_f64.sqrt();
        assert!((found.plane.normal - DVec3::new(-0.5, 0.0, 1.0) / slope).length() < 1e-14);
        assert!((found.plane.offset - 1.0 / slope).abs() < 1e-13);
        assert!((found.area - 0.25 * slope).abs() < 1e-14 && (found.width - 0.25).abs() < 1e-12);
        let line = Surface::new(vec![DVec3::ZERO, DVec3::X, DVec3::X * 2.0], vec![[0, 1, 2]]);
        assert!(fit(&line, &[0]).is_none() && fit(&square, &[]).is_none());
    }
}
