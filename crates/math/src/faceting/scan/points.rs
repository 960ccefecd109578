//! Sums over points, from which the plane that fits them best follows, with the points' moments in that plane.

use crate::Plane;
use crate::eigen::{eigen, outer};
use glam::{DMat3, DVec3};

/// Sums over points, about an origin near to them, which keeps their digits.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointSums {
    origin: DVec3,
    /// The number of points.
    pub count: usize,
    first: DVec3,
    second: DMat3,
}

impl PointSums {
    pub fn about(origin: DVec3) -> Self {
        Self { origin, count: 0, first: DVec3::ZERO, second: DMat3::ZERO }
    }

    pub fn add(&mut self, point: DVec3) {
        let from = point - self.origin;
        self.count += 1;
        self.first += from;
        self.second += outer(from, from);
    }

    /// Returns the sums over the points of both.
    pub fn with(&self, other: &Self) -> Self {
        let by = other.origin - self.origin;
        let count = other.count as f64;
        Self {
            origin: self.origin,
            count: self.count + other.count,
            first: self.first + other.first + count * by,
            second: self.second
                + other.second
                + outer(other.first, by)
                + outer(by, other.first)
                + outer(by, by) * count,
        }
    }

    /// Returns the plane with the least sum of squared distances (total least squares), whose normal points away from
    /// `inside`; `None` for fewer than three points, or points in one line.
    pub fn fit(&self, inside: DVec3) -> Option<PlaneEstimate> {
        if self.count < 3 {
            return None;
        }
        let mean = self.first / self.count as f64;
        let (values, vectors) = eigen(self.second - outer(mean, self.first));
        let middle = self.origin + mean;
        let normal = vectors[0] * if vectors[0].dot(middle - inside) < 0.0 { -1.0 } else { 1.0 };
        let plane = Plane::new(normal, normal.dot(middle)).normalized()?;
        let moments = [values[1], values[2]];
        let squares = values[0].max(0.0);
        // Points in one line have no plane.
        let has_width = moments[0] > 1e-12 * moments[1] && moments[0] > squares;
        has_width.then_some(PlaneEstimate {
            plane,
            middle,
            axes: [vectors[1], vectors[2]],
            moments,
            count: self.count,
            squares,
        })
    }
}

/// A plane that was fitted to points by total least squares.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaneEstimate {
    /// The plane, with its normal outward.
    pub plane: Plane,
    /// The mean of the points.
    pub middle: DVec3,
    /// The points' principal axes in the plane.
    pub axes: [DVec3; 2],
    /// The sums of the points' squared distances from the middle along the axes.
    pub moments: [f64; 2],
    /// The number of points.
    pub count: usize,
    /// The sum of the points' squared distances from the plane.
    pub squares: f64,
}

impl PlaneEstimate {
    /// Returns the number of points beyond the three that fix a plane.
    pub fn freedom(&self) -> usize {
        self.count.saturating_sub(3)
    }

    /// Returns the variance of the plane's distance at a place, in variances of one point's noise.
    pub fn leverage(&self, at: DVec3) -> f64 {
        let from = at - self.middle;
        let along = |k: usize| from.dot(self.axes[k]).powi(2) / self.moments[k];
        1.0 / self.count as f64 + along(0) + along(1)
    }

    /// Returns the mean square of the points' noise, estimated from their distances; 0 for three points.
    pub fn variance(&self) -> f64 {
        match self.freedom() {
            0 => 0.0,
            freedom => self.squares / freedom as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_two_lists_are_those_of_one() {
        let at = |k: i32| {
            let (x, y) = (f64::from(k % 4), f64::from(k / 4));
            DVec3::new(x, y, 5.0 + 0.2 * x + 1e-3 * f64::from((k * 7) % 5 - 2))
        };
        let sums = |of: std::ops::Range<i32>, origin| {
            let mut sums = PointSums::about(origin);
            of.for_each(|k| sums.add(at(k)));
            sums
        };
        let whole = sums(0..16, DVec3::Z).fit(DVec3::ZERO).unwrap();
        let parts = sums(0..7, DVec3::X).with(&sums(7..16, DVec3::NEG_Y * 3.0)).fit(DVec3::ZERO).unwrap();
        assert!(whole.plane.normal.distance(parts.plane.normal) < 1e-9 && whole.count == 16);
        assert!((whole.squares - parts.squares).abs() < 1e-10 && whole.plane.normal.z > 0.9);
        assert!(whole.middle.distance(parts.middle) < 1e-12 && whole.freedom() == 13);
        let line = (0..3).map(|k| DVec3::X * f64::from(k));
        let mut sums = PointSums::about(DVec3::ZERO);
        line.for_each(|p| sums.add(p));
        assert!(sums.fit(DVec3::NEG_Z).is_none());
    }
}
