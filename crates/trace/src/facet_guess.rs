//! Guesses the facet that a ray inside a stone meets. All planes are tried in single precision, as many side by side
//! as the processor's registers hold.
//!
//! Single precision tries twice as many planes at once as double precision would. The caller must verify the guess:
//! near an edge it may be the facet on the other side of the edge.

use brillianteer_math::Plane;
use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};

/// The most planes that any processor tries at once.
const WIDEST: usize = 16;

/// The least gap between a point and a plane; smaller gaps count as this one.
const LEAST_GAP: f32 = 1e-30;

/// Planes, coordinate by coordinate. Whole rows are filled up with zero normals, toward which no ray runs.
#[derive(Debug, Clone)]
pub(crate) struct FacetGuess {
    normal: [Vec<f32>; 3],
    offset: Vec<f32>,
    /// The numbers of the planes, in the bits of `tag_bits`.
    tag: Vec<f32>,
    /// The low bits of a ratio's fraction; they hold the number of the ratio's plane.
    tag_bits: u32,
    /// The number of the last plane. Places beyond it in the last row are no facets.
    last: u32,
    arch: Arch,
}

impl FacetGuess {
    pub fn new(planes: impl Iterator<Item = Plane> + Clone) -> Self {
        let number = planes.clone().count();
        let whole = number.next_multiple_of(WIDEST);
        let column = |pick: fn(Plane) -> f64| {
            let mut column: Vec<f32> = planes.clone().map(|plane| pick(plane) as f32).collect();
            column.resize(whole, 0.0);
            column
        };
        Self {
            normal: [column(|p| p.normal.x), column(|p| p.normal.y), column(|p| p.normal.z)],
            offset: column(|p| p.offset),
            tag: (0..whole as u32).map(f32::from_bits).collect(),
            tag_bits: whole.next_power_of_two() as u32 - 1,
            last: number.saturating_sub(1) as u32,
            arch: Arch::new(),
        }
    }

    /// Returns the number of the facet through which a ray from a point inside leaves: the facet with the greatest
    /// ratio of the speed toward its plane to the gap before that plane. Planes behind the ray have negative ratios
    /// and are never chosen.
    #[inline]
    pub fn ahead_of(&self, point: DVec3, direction: DVec3) -> u32 {
        let tagged = self.arch.dispatch(Ahead { planes: self, point, direction });
        (tagged.to_bits() & self.tag_bits).min(self.last)
    }
}

struct Ahead<'a> {
    planes: &'a FacetGuess,
    point: DVec3,
    direction: DVec3,
}

impl WithSimd for Ahead<'_> {
    type Output = f32;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f32 {
        let (point, direction) = (splat(simd, self.point), splat(simd, self.direction));
        let least_gap = simd.splat_f32s(LEAST_GAP);
        let clear = simd.splat_f32s(f32::from_bits(!self.planes.tag_bits));
        let [x, y, z] = &self.planes.normal;
        let (x, y, z) = (S::as_simd_f32s(x).0, S::as_simd_f32s(y).0, S::as_simd_f32s(z).0);
        let (offset, tag) = (S::as_simd_f32s(&self.planes.offset).0, S::as_simd_f32s(&self.planes.tag).0);
        let mut greatest = simd.splat_f32s(0.0);
        for row in 0..tag.len() {
            let normal = [x[row], y[row], z[row]];
            let speed = dot(simd, normal, direction);
            let gap = simd.sub_f32s(offset[row], dot(simd, normal, point));
            let ratio = simd.div_f32s(speed, simd.max_f32s(gap, least_gap));
            greatest = simd.max_f32s(simd.or_f32s(simd.and_f32s(ratio, clear), tag[row]), greatest);
        }
        simd.reduce_max_f32s(greatest)
    }
}

#[inline(always)]
fn dot<S: Simd>(simd: S, a: [S::f32s; 3], b: [S::f32s; 3]) -> S::f32s {
    let xy = simd.add_f32s(simd.mul_f32s(a[0], b[0]), simd.mul_f32s(a[1], b[1]));
    simd.add_f32s(xy, simd.mul_f32s(a[2], b[2]))
}

#[inline(always)]
fn splat<S: Simd>(simd: S, v: DVec3) -> [S::f32s; 3] {
    [simd.splat_f32s(v.x as f32), simd.splat_f32s(v.y as f32), simd.splat_f32s(v.z as f32)]
}
