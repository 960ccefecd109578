//! Small systems of linear equations.

/// Solves N linear equations with a positive definite matrix by elimination (C. F. Gauss). Column N of `rows` holds the right
/// sides, so M is N + 1. Where the matrix is singular, numbers of the solution are not finite.
pub fn solved<const N: usize, const M: usize>(mut rows: [[f64; M]; N]) -> [f64; N] {
    for k in 0..N {
        let pivot = rows[k];
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k] / pivot[k];
            row.iter_mut().zip(pivot).for_each(|(a, b)| *a -= factor * b);
        }
    }
    std::array::from_fn(|k| rows[k][M - 1] / rows[k][k])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_fulfils_the_equations() {
        let rows = [[4.0, 1.0, 0.5, 1.0], [1.0, 3.0, -0.2, 2.0], [0.5, -0.2, 2.0, -1.0]];
        let found = solved(rows);
        for row in rows {
            let left: f64 = row.iter().zip(found).map(|(a, x)| a * x).sum();
            assert!((left - row[3]).abs() < 1e-14);
        }
    }
}
