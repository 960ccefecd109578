//! Fits a plane to triangles by least squares over their area.

use super::Surface;
use crate::math::Plane;
use glam::{DMat3, DVec3};

/// The number of sweeps of Jacobi's rotations. Each sweep squares what is left off the diagonal, so five reach rounding.
const SWEEPS: usize = 12;

/// A plane fitted to triangles, with the area and width of these.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaneFit {
    /// The plane; its unit normal is on the side that the triangles face.
    pub plane: Plane,
    /// The area of the triangles.
    pub area: f64,
    /// The width of the triangles in the plane, where they are narrowest: that of a rectangle with the same spread.
    pub width: f64,
}

/// Returns the plane with the least square distance from the triangles, in which each point of their area counts the same.
///
/// The plane runs through the centroid. `None` where the triangles have no area.
pub(super) fn fit(surface: &Surface, triangles: &[u32]) -> Option<PlaneFit> {
    let corners = || triangles.iter().map(|&t| surface.corners(t as usize));
    // Measuring from one of the corners keeps the digits of a small region far from the middle.
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
        spread += (outer(a) + outer(b) + outer(c) + outer(sum)) * (part / 12.0);
    }
    let (values, vectors) = eigen(spread * (1.0 / area));
    let normal = vectors[0] * if vectors[0].dot(facing) < 0.0 { -1.0 } else { 1.0 };
    let width = (12.0 * values[1].max(0.0)).sqrt();
    let plane = Plane::new(normal, normal.dot(middle)).normalized()?;
    (area > 0.0 && area.is_finite()).then_some(PlaneFit { plane, area, width })
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// Returns the eigenvalues of a symmetric matrix in rising order, and its eigenvectors (C. G. J. Jacobi 1846).
pub fn eigen(mut m: DMat3) -> ([f64; 3], [DVec3; 3]) {
    let mut turned = DMat3::IDENTITY;
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = m.col(q)[p];
            if off == 0.0 {
                continue;
            }
            let theta = (m.col(q)[q] - m.col(p)[p]) / (2.0 * off);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let cos = 1.0 / (t * t + 1.0).sqrt();
            let mut rotation = DMat3::IDENTITY;
            rotation.col_mut(p)[p] = cos;
            rotation.col_mut(q)[q] = cos;
            rotation.col_mut(q)[p] = t * cos;
            rotation.col_mut(p)[q] = -t * cos;
            m = rotation.transpose() * m * rotation;
            turned *= rotation;
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| m.col(i)[i].total_cmp(&m.col(j)[j]));
    (order.map(|i| m.col(i)[i]), order.map(|i| turned.col(i)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn eigenvectors_are_only_stretched(v in prop::array::uniform6(-1.0..1.0_f64)) {
            let [a, b, c, d, e, f] = v;
            let m = DMat3::from_cols(DVec3::new(a, b, c), DVec3::new(b, d, e), DVec3::new(c, e, f));
            let (values, vectors) = eigen(m);
            prop_assert!(values.is_sorted());
            for (value, vector) in values.into_iter().zip(vectors) {
                prop_assert!((m * vector - value * vector).length() < 1e-12);
                prop_assert!((vector.length() - 1.0).abs() < 1e-12);
            }
        }
    }

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
