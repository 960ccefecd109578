//! Finds the facets that a ray may cross, by discs around them. All discs are tried, as many side by side as the processor's
//! registers hold.

use crate::math::Plane;
use crate::trace::lanes::{Vec3s, dot, splat};
use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};

/// The most discs that any processor tries at once.
const WIDEST: usize = 8;

/// The most discs. A set of them is summed up as the bits of a number, and so many bits are exact in f64.
pub(super) const MOST_DISCS: usize = 52;

/// The part by which distances and radii are larger, so that rounding leaves out no facet.
const SLACK: f64 = 1e-9;

/// A facet's plane and a ball around the facet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Disc {
    pub plane: Plane,
    /// The middle of the ball.
    pub middle: DVec3,
    /// The radius of the ball.
    pub radius: f64,
}

/// Discs, number by number. Whole rows are filled up with zero normals, toward which no ray runs.
#[derive(Debug, Clone)]
pub(super) struct DiscSearch {
    normal: [Vec<f64>; 3],
    offset: Vec<f64>,
    middle: [Vec<f64>; 3],
    radius_squared: Vec<f64>,
    /// Two to the power of the disc's number.
    mark: Vec<f64>,
    arch: Arch,
}

impl DiscSearch {
    /// Prepares at most [`MOST_DISCS`] discs.
    pub fn new(discs: &[Disc]) -> Self {
        let whole = discs.len().next_multiple_of(WIDEST);
        let column = |pick: &dyn Fn(&Disc) -> f64| {
            let mut column: Vec<f64> = discs.iter().map(pick).collect();
            column.resize(whole, 0.0);
            column
        };
        let vectors = |pick: &dyn Fn(&Disc) -> DVec3| [0, 1, 2].map(|axis| column(&|disc| pick(disc)[axis]));
        Self {
            normal: vectors(&|disc| disc.plane.normal),
            offset: column(&|disc| disc.plane.offset),
            middle: vectors(&|disc| disc.middle),
            radius_squared: column(&|disc| (disc.radius * (1.0 + SLACK)).powi(2)),
            mark: (0..whole).map(|k| if k < MOST_DISCS { (1_u64 << k) as f64 } else { 0.0 }).collect(),
            arch: Arch::new(),
        }
    }

    /// Returns the discs that a ray crosses from behind before it has gone `most`, which is positive: bit k stands for disc k.
    /// Discs that the ray crosses hardly later or hardly misses, or that lie behind the ray's origin, may be among them.
    #[inline]
    pub fn crossed(&self, (point, direction): (DVec3, DVec3), most: f64) -> u64 {
        self.arch.dispatch(Crossed { search: self, point, direction, most: most * (1.0 + SLACK) }) as u64
    }
}

struct Crossed<'a> {
    search: &'a DiscSearch,
    point: DVec3,
    direction: DVec3,
    most: f64,
}

impl WithSimd for Crossed<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (point, direction) = (splat(simd, self.point), splat(simd, self.direction));
        let (zero, most) = (simd.splat_f64s(0.0), simd.splat_f64s(self.most));
        let DiscSearch { normal, offset, middle, radius_squared, mark, .. } = self.search;
        let [offset, radius_squared, mark] = [rows::<S>(offset), rows::<S>(radius_squared), rows::<S>(mark)];
        let (normal, middle) = (vector_rows::<S>(normal), vector_rows::<S>(middle));
        let mut marks = zero;
        for row in 0..mark.len() {
            let own = [normal[0][row], normal[1][row], normal[2][row]];
            let speed = dot(simd, own, direction);
            let gap = simd.sub_f64s(offset[row], dot(simd, own, point));
            let is_before = simd.less_than_f64s(gap, simd.mul_f64s(most, speed));
            let is_crossed = simd.and_m64s(simd.greater_than_f64s(speed, zero), is_before);
            let distance = simd.div_f64s(gap, speed);
            let mut away = point;
            for axis in 0..3 {
                let end = simd.add_f64s(point[axis], simd.mul_f64s(direction[axis], distance));
                away[axis] = simd.sub_f64s(end, middle[axis][row]);
            }
            let is_near = simd.less_than_or_equal_f64s(dot(simd, away, away), radius_squared[row]);
            let is_found = simd.and_m64s(is_crossed, is_near);
            marks = simd.add_f64s(marks, simd.select_f64s(is_found, mark[row], zero));
        }
        simd.reduce_sum_f64s(marks)
    }
}

#[inline(always)]
fn rows<S: Simd>(column: &[f64]) -> &[S::f64s] {
    S::as_simd_f64s(column).0
}

#[inline(always)]
fn vector_rows<S: Simd>([x, y, z]: &[Vec<f64>; 3]) -> [&[S::f64s]; 3] {
    [rows::<S>(x), rows::<S>(y), rows::<S>(z)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(part: [f64; 3]) -> DVec3 {
        DVec3::from(part)
    }

    proptest! {
        #[test]
        fn no_disc_that_a_ray_crosses_is_left_out(
            discs in prop::collection::vec((prop::array::uniform3(-1.0..1.0_f64), prop::array::uniform3(-1.0..1.0_f64), 0.01..1.0_f64), 0..MOST_DISCS),
            at in prop::array::uniform3(-1.0..1.0_f64), way in prop::array::uniform3(-1.0..1.0_f64), most in 0.01..3.0_f64,
        ) {
            let discs: Vec<Disc> = discs.into_iter().map(|(normal, middle, radius)| {
                let (normal, middle) = (vector(normal).normalize_or(DVec3::X), vector(middle));
                Disc { plane: Plane::new(normal, normal.dot(middle)), middle, radius }
            }).collect();
            let (point, direction) = (vector(at), vector(way).normalize_or(DVec3::X));
            let marked = DiscSearch::new(&discs).crossed((point, direction), most);
            for (k, Disc { plane, middle, radius }) in discs.iter().enumerate() {
                let (speed, gap) = (plane.normal.dot(direction), -plane.distance(point));
                let away = (point + direction * (gap / speed)).distance(*middle);
                let is_marked = marked >> k & 1 == 1;
                if speed > 0.0 && gap < most * speed && away <= *radius {
                    prop_assert!(is_marked, "{k} is left out");
                }
                // Farther than rounding reaches, nothing is marked.
                if speed <= 0.0 || gap > 1.001 * most * speed || away > 1.001 * radius {
                    prop_assert!(!is_marked, "{k} is not crossed");
                }
            }
            prop_assert_eq!(marked.checked_shr(discs.len() as u32).unwrap_or(0), 0);
        }
    }
}
