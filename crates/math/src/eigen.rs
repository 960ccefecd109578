//! Eigenvalues and eigenvectors of symmetric matrices.

use glam::{DMat3, DVec3};

/// The number of sweeps of Jacobi's rotations. Each sweep squares the remainder off the diagonal, so five reach
/// rounding.
const SWEEPS: usize = 12;

/// Returns the outer product a bᵀ.
#[inline]
pub fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
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
}
