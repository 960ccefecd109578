//! The girdle: which facets it has, how wide it is, and which way the stone is turned about its axis.

use super::even::Even;
use super::{FromMeshError, Pose};
use crate::math::{Plane, Polytope};
use glam::{DQuat, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Facets whose normals rise or fall by less than this (sine, 6 degrees) are the girdle's: steep steps of a pavilion
/// lean more.
pub(super) const LEAST_UPRIGHT: f64 = 0.104_528_463;

/// An outline whose narrowest radius is at least this part of its widest is round, and its radius is that of its
/// corners: a decagon is.
const ROUND: f64 = 0.95;

/// Azimuths nearer than this are one, radians; noise of a thousandth turns facets by less.
const SAME_AZIMUTH: f64 = 0.02;

/// Areas whose ratio is less are equal.
const SAME_AREA: f64 = 1.01;

/// An outline whose second moments differ by more than this part of their sum is longer one way: by one percent.
const LONG: f64 = 0.01;

/// Widths whose ratio is nearer to 1 than this are equal.
const SAME_WIDTH: f64 = 0.005;

/// The pose of an even stone whose axis is up already: width along x, girdle at z = 0 with radius 1.
pub(super) fn placed(even: &Even, areas: &[f64]) -> Result<Pose, FromMeshError> {
    let solid = Polytope::from_planes(&even.planes)?;
    let rim = rim(&solid);
    let top = rim.iter().map(|v| v.z).fold(f64::NEG_INFINITY, f64::max);
    if rim.is_empty() {
        return Err(FromMeshError::NoGirdle);
    }
    let about = DQuat::from_rotation_z(-azimuth(even, areas, &rim));
    let flat: Vec<DVec3> = rim.iter().map(|v| about * *v).collect();
    let (low, high) = flat.iter().fold((flat[0], flat[0]), |(low, high), v| (low.min(*v), high.max(*v)));
    // About an axis the middle is known; else it is that of the box.
    let middle = if even.turns > 1 { DVec3::ZERO } else { (low + high) / 2.0 };
    let middle = DVec3::new(middle.x, middle.y, top);
    let scale = 1.0 / half_width(&solid, &flat, middle, high - low);
    Ok(Pose { scale, turn: about, shift: -scale * middle })
}

fn half_width(solid: &Polytope, rim: &[DVec3], middle: DVec3, extent: DVec3) -> f64 {
    let widest = rim.iter().map(|v| (*v - middle).truncate().length()).fold(0.0, f64::max);
    let girdle = solid.planes().filter(|p| p.normal.z.abs() < LEAST_UPRIGHT);
    // Without girdle facets the outline is judged by its extent alone.
    let narrowest = girdle.map(|p| p.offset).fold(extent.x.min(extent.y) / 2.0, f64::min);
    if narrowest >= ROUND * widest { widest } else { extent.x.min(extent.y) / 2.0 }
}

/// The corners of the girdle: of its facets, or between facets that face up and down.
fn rim(solid: &Polytope) -> Vec<DVec3> {
    let facing = |test: &dyn Fn(f64) -> bool| {
        let mut on = vec![false; solid.vertices().len()];
        let facets = solid.facets().iter().filter(|f| test(f.plane.normal.z));
        facets.flat_map(|f| &f.outline).for_each(|&v| on[v as usize] = true);
        on
    };
    let (up, down) = (facing(&|z| z >= LEAST_UPRIGHT), facing(&|z| z <= -LEAST_UPRIGHT));
    let upright = facing(&|z| z.abs() < LEAST_UPRIGHT);
    let at = |test: &dyn Fn(usize) -> bool| -> Vec<DVec3> {
        (0..up.len()).filter(|&v| test(v)).map(|v| solid.vertices()[v]).collect()
    };
    let girdle = at(&|v| up[v] && upright[v]);
    if girdle.is_empty() { at(&|v| up[v] && down[v]) } else { girdle }
}

/// The azimuth that becomes +x.
fn azimuth(even: &Even, areas: &[f64], rim: &[DVec3]) -> f64 {
    let mut candidates = candidates(even, rim);
    // Of equals, the nearest to the surface's own x axis is taken: what lies right is left as it is.
    let own = even.turn * DVec3::X;
    let apart = |azimuth: f64| -own.dot(DVec3::new(azimuth.cos(), azimuth.sin(), 0.0));
    candidates.sort_by(|&a, &b| apart(a).total_cmp(&apart(b)));
    let width = |azimuth: f64| {
        let along = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0);
        let reach = rim.iter().map(|v| v.dot(along));
        reach.clone().fold(f64::NEG_INFINITY, f64::max) - reach.fold(f64::INFINITY, f64::min)
    };
    let least = candidates.iter().map(|&c| width(c)).fold(f64::INFINITY, f64::min);
    let widest = candidates.iter().map(|&c| width(c)).fold(0.0, f64::max);
    // A round stone is as wide everywhere, but for its corners; a square one is narrowest from side to side.
    let limit = if least >= ROUND * widest { f64::INFINITY } else { least * (1.0 + SAME_WIDTH) };
    let narrow = candidates.into_iter().filter(|&c| width(c) <= limit);
    let facing = |azimuth: f64| crown_facing(even, areas, azimuth);
    let better =
        |best: (f64, f64), c: f64| if facing(c) > best.0 * SAME_AREA { (facing(c), c) } else { best };
    narrow.fold((f64::NEG_INFINITY, 0.0), better).1
}

/// Directions of mirrors, else of facets, else of the outline.
fn candidates(even: &Even, rim: &[DVec3]) -> Vec<f64> {
    match (even.mirror, even.turns) {
        (Some(mirror), 1 | 2) => (0..4).map(|k| mirror + f64::from(k) * FRAC_PI_2).collect(),
        (Some(mirror), turns) => {
            (0..2 * turns).map(|k| mirror + f64::from(k) * PI / f64::from(turns)).collect()
        }
        (None, 3..) => crown_azimuths(even),
        (None, _) => narrow_axis(rim).map_or_else(|| crown_azimuths(even), |axis| vec![axis]),
    }
}

fn crown_azimuths(even: &Even) -> Vec<f64> {
    even.planes.iter().filter(|p| is_crown(p)).map(|p| p.normal.y.atan2(p.normal.x)).collect()
}

/// The direction across a corner set's longer axis, by its second moments; `None` where it has none.
fn narrow_axis(rim: &[DVec3]) -> Option<f64> {
    let middle = rim.iter().sum::<DVec3>() / rim.len() as f64;
    let sum = |f: &dyn Fn(DVec3) -> f64| rim.iter().map(|v| f(*v - middle)).sum::<f64>();
    let (difference, mixed) = (sum(&|v| v.x * v.x - v.y * v.y), sum(&|v| 2.0 * v.x * v.y));
    let whole = sum(&|v| v.x * v.x + v.y * v.y);
    (difference.hypot(mixed) > LONG * whole).then(|| mixed.atan2(difference) / 2.0 + FRAC_PI_2)
}

fn is_crown(plane: &Plane) -> bool {
    plane.normal.z >= LEAST_UPRIGHT && plane.normal.truncate().length() > SAME_AZIMUTH
}

/// The area of the largest facet of the crown that faces an azimuth.
fn crown_facing(even: &Even, areas: &[f64], azimuth: f64) -> f64 {
    let toward = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0);
    let crown = even.planes.iter().zip(areas).filter(|(p, _)| is_crown(p));
    let faces = |p: &Plane| p.normal.dot(toward) >= SAME_AZIMUTH.cos() * p.normal.truncate().length();
    crown.filter(|(p, _)| faces(p)).map(|(_, area)| *area).fold(0.0, f64::max)
}
