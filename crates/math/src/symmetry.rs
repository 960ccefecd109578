//! The rotations and mirror images under which a stone, seen along one axis, looks the same.

use super::{Affine, Basis, Plane};
use glam::{DMat2, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Two planes count as one if their normals and offsets differ by less than this: the copy of a beam then differs by
/// no more.
const SAME: f64 = 1e-9;

/// The symmetry of a picture: `turns` rotations about its origin and, with a mirror line, as many reflections.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Symmetry {
    /// The number of rotations, by multiples of 2π/turns; at least 1.
    pub turns: u32,
    /// The direction of one mirror line, in radians from the image's x axis; `None` without mirrors.
    pub mirror: Option<f64>,
}

impl Symmetry {
    /// The symmetry of a picture that only a full turn leaves unchanged.
    pub const NONE: Self = Self { turns: 1, mirror: None };

    /// Returns the symmetry that all `planes` share, seen along `view.toward`, and that leaves the direction `fixed`
    /// unchanged too.
    pub fn of(planes: impl Iterator<Item = Plane>, view: &Basis, fixed: DVec3) -> Self {
        let rings = rings(planes, view);
        let lean = view.project(fixed);
        if lean.length() > SAME {
            let mirror = lean.to_angle();
            let holds = rings.iter().all(|r| r.is_same(|a| 2.0 * mirror - a));
            return Self { turns: 1, mirror: holds.then_some(mirror) };
        }
        let Some(smallest) = rings.iter().min_by_key(|r| r.azimuths.len()) else { return Self::NONE };
        // A rotation permutes every ring, so its order divides the number of facets in each ring.
        let common = rings.iter().fold(0, |g, r| gcd(g, r.azimuths.len()));
        let turned = |n: usize| rings.iter().all(|r| r.is_same(|a| a + TAU / n as f64));
        let turns = (1..=common).rev().find(|&n| common.is_multiple_of(n) && turned(n)).unwrap_or(1);
        let first = smallest.azimuths[0];
        let candidates = smallest.azimuths.iter().map(|&a| (first + a) / 2.0);
        let mirror = candidates.into_iter().find(|m| rings.iter().all(|r| r.is_same(|a| 2.0 * m - a)));
        Self { turns: turns as u32, mirror }
    }

    /// Returns the number of copies of the domain that make up the picture.
    pub fn order(&self) -> u32 {
        if self.mirror.is_some() { 2 * self.turns } else { self.turns }
    }

    /// Returns the maps that carry the domain to each of its copies, the identity first.
    pub fn copies(&self) -> Vec<DMat2> {
        let turn = |k: u32| DMat2::from_angle(TAU * f64::from(k) / f64::from(self.turns));
        let mut copies: Vec<DMat2> = (0..self.turns).map(turn).collect();
        if let Some(m) = self.mirror {
            let (sin, cos) = (2.0 * m).sin_cos();
            let flip = DMat2::from_cols(DVec2::new(cos, sin), DVec2::new(sin, -cos));
            copies.extend((0..self.turns).map(|k| turn(k) * flip));
        }
        copies
    }

    /// Returns half-planes whose intersection is one domain, a wedge at the origin. Each half-plane contains the
    /// points where its function is not negative.
    pub fn domain(&self) -> Vec<Affine> {
        let order = self.order();
        if order == 1 {
            return vec![];
        }
        let first = self.mirror.unwrap_or(0.0);
        let side = |angle: f64| Affine::new(0.0, DVec2::from_angle(angle).perp());
        let start = side(first);
        let end = side(first + TAU / f64::from(order)) * -1.0;
        // With two copies the plane is divided in two, so one line is enough.
        if order == 2 { vec![start] } else { vec![start, end] }
    }
}

/// Facets that differ only in azimuth.
struct Ring {
    /// The normal's component along the axis, its component away from the axis, and the plane's offset.
    key: [f64; 3],
    /// The azimuths in radians, sorted, in [0, 2π).
    azimuths: Vec<f64>,
}

impl Ring {
    fn is_same(&self, map: impl Fn(f64) -> f64) -> bool {
        // The nearer a normal is to the axis, the less its azimuth matters.
        let tolerance = SAME / self.key[1].max(SAME);
        self.azimuths.iter().all(|&a| {
            let image = map(a).rem_euclid(TAU);
            let near = |b: f64| (((image - b) + PI).rem_euclid(TAU) - PI).abs() < tolerance;
            let at = self.azimuths.partition_point(|&b| b < image);
            let last = self.azimuths.len() - 1;
            let around = [at.saturating_sub(1), at.min(last), 0, last];
            around.into_iter().any(|i| near(self.azimuths[i]))
        })
    }
}

/// Returns the rings of facets around the view axis. Facets perpendicular to the axis have no azimuth and are left
/// out.
fn rings(planes: impl Iterator<Item = Plane>, view: &Basis) -> Vec<Ring> {
    let mut rings: Vec<Ring> = Vec::new();
    for plane in planes {
        let across = view.project(plane.normal);
        let key = [view.toward.dot(plane.normal), across.length(), plane.offset];
        if across.length() < SAME {
            continue;
        }
        let azimuth = across.to_angle().rem_euclid(TAU);
        let same = |r: &&mut Ring| r.key.iter().zip(key).all(|(a, b)| (a - b).abs() < SAME);
        match rings.iter_mut().find(same) {
            Some(ring) => ring.azimuths.push(azimuth),
            None => rings.push(Ring { key, azimuths: vec![azimuth] }),
        }
    }
    rings.iter_mut().for_each(|r| r.azimuths.sort_by(f64::total_cmp));
    rings
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
