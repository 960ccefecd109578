//! Finds the plane that a ray meets. All planes are tried, as many side by side as the processor's registers hold.
//!
//! The processor's abilities are detected when the program runs, so that one build is quick on all processors. The
//! loops contain no closures, because closures would not be compiled for the wider instructions. Sums are not fused,
//! so that the result does not depend on the processor.

use crate::lanes::{Vec3s, dot, splat};
use brillianteer_math::Plane;
use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};

/// The most planes that any processor tries at once.
const WIDEST: usize = 8;

/// The least gap between a point and a plane; smaller gaps count as this one. So where rounding has put a point just
/// outside a plane, the ray meets that plane at once.
const LEAST_GAP: f64 = 1e-290;

/// Planes, coordinate by coordinate. Whole rows are filled up with zero normals, toward which no ray runs.
#[derive(Debug, Clone)]
pub(super) struct Search {
    normal: [Vec<f64>; 3],
    offset: Vec<f64>,
    /// The plane's number, in the bits of `tag_bits`.
    tag: Vec<f64>,
    /// The low bits of a ratio's fraction; they hold the number of the ratio's plane. With 16,384 planes, two ratios
    /// that differ by less than 4e-12 of their size are confused; their facets then meet in an edge near that point.
    tag_bits: u64,
    arch: Arch,
}

impl Search {
    pub fn new(planes: &[Plane]) -> Self {
        let whole = planes.len().next_multiple_of(WIDEST);
        let column = |pick: &dyn Fn(&Plane) -> f64| {
            let mut column: Vec<f64> = planes.iter().map(pick).collect();
            column.resize(whole, 0.0);
            column
        };
        Self {
            normal: [column(&|p| p.normal.x), column(&|p| p.normal.y), column(&|p| p.normal.z)],
            offset: column(&|p| p.offset),
            tag: (0..whole as u64).map(f64::from_bits).collect(),
            tag_bits: whole.next_power_of_two() as u64 - 1,
            arch: Arch::new(),
        }
    }

    /// Returns the facet by which a ray from a point inside leaves: the facet with the greatest ratio of the speed
    /// toward its plane to the gap before that plane. Planes behind the ray have negative ratios and are never
    /// chosen.
    #[inline]
    pub fn next(&self, point: DVec3, direction: DVec3) -> usize {
        self.plane(self.arch.dispatch(Next { search: self, point, direction }))
    }

    /// Returns the facet by which a ray from a point outside enters; `None` where it misses.
    pub fn entry(&self, origin: DVec3, direction: DVec3) -> Option<usize> {
        self.arch.dispatch(Entry { search: self, origin, direction }).map(|ratio| self.plane(ratio))
    }

    fn plane(&self, tagged: f64) -> usize {
        (tagged.to_bits() & self.tag_bits) as usize
    }

    #[inline(always)]
    fn rows<S: Simd>(&self) -> Rows<'_, S> {
        let [x, y, z] = &self.normal;
        Rows {
            normal: [S::as_simd_f64s(x).0, S::as_simd_f64s(y).0, S::as_simd_f64s(z).0],
            offset: S::as_simd_f64s(&self.offset).0,
            tag: S::as_simd_f64s(&self.tag).0,
        }
    }

    #[inline(always)]
    fn clear<S: Simd>(&self, simd: S) -> S::f64s {
        simd.splat_f64s(f64::from_bits(!self.tag_bits))
    }
}

/// The planes in rows, each as long as the processor's registers.
struct Rows<'a, S: Simd> {
    normal: [&'a [S::f64s]; 3],
    offset: &'a [S::f64s],
    tag: &'a [S::f64s],
}

impl<S: Simd> Rows<'_, S> {
    #[inline(always)]
    fn normal(&self, row: usize) -> Vec3s<S> {
        let [x, y, z] = self.normal;
        [x[row], y[row], z[row]]
    }
}

struct Next<'a> {
    search: &'a Search,
    point: DVec3,
    direction: DVec3,
}

impl WithSimd for Next<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (point, direction) = (splat(simd, self.point), splat(simd, self.direction));
        let (zero, least_gap) = (simd.splat_f64s(0.0), simd.splat_f64s(LEAST_GAP));
        let clear = self.search.clear(simd);
        let mut greatest = zero;
        let rows = self.search.rows::<S>();
        for row in 0..rows.tag.len() {
            let normal = rows.normal(row);
            let speed = dot(simd, normal, direction);
            if simd.first_true_m64s(simd.greater_than_f64s(speed, zero)) == S::F64_LANES {
                continue;
            }
            let gap = simd.sub_f64s(rows.offset[row], dot(simd, normal, point));
            let ratio = simd.div_f64s(speed, simd.max_f64s(gap, least_gap));
            let tagged = simd.or_f64s(simd.and_f64s(ratio, clear), rows.tag[row]);
            greatest = simd.max_f64s(tagged, greatest);
        }
        simd.reduce_max_f64s(greatest)
    }
}

struct Entry<'a> {
    search: &'a Search,
    origin: DVec3,
    direction: DVec3,
}

impl WithSimd for Entry<'_> {
    type Output = Option<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Option<f64> {
        let (origin, direction) = (splat(simd, self.origin), splat(simd, self.direction));
        let (zero, never) = (simd.splat_f64s(0.0), simd.splat_f64s(f64::INFINITY));
        let clear = self.search.clear(simd);
        let (mut into, mut out) = (zero, never);
        let rows = self.search.rows::<S>();
        for row in 0..rows.tag.len() {
            let normal = rows.normal(row);
            let speed = dot(simd, normal, direction);
            let gap = simd.sub_f64s(rows.offset[row], dot(simd, normal, origin));
            let distance = simd.div_f64s(gap, speed);
            let tagged = simd.or_f64s(simd.and_f64s(distance, clear), rows.tag[row]);
            let (before, behind) = (simd.less_than_f64s(speed, zero), simd.greater_than_f64s(speed, zero));
            into = simd.max_f64s(simd.select_f64s(before, tagged, zero), into);
            out = simd.min_f64s(simd.select_f64s(behind, distance, never), out);
            // A ray that runs along a plane on its outer side never enters.
            let beside = simd.and_m64s(simd.equal_f64s(speed, zero), simd.less_than_f64s(gap, zero));
            out = simd.select_f64s(beside, zero, out);
        }
        let (into, out) = (simd.reduce_max_f64s(into), simd.reduce_min_f64s(out));
        (into > 0.0 && into < out).then_some(into)
    }
}
