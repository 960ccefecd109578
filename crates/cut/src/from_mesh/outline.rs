//! Measures the girdle: its facets, its width, and the turn of the stone about its axis.

use super::error::FromMeshError;
use super::even::Even;
use crate::Outline;
use crate::outline::ROUND;
use brillianteer_math::{Calipers, Plane, Polytope, Pose, hull, span};
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Facets whose normals rise or fall by less than this (sine, 6 degrees) belong to the girdle. Steep steps of a pavilion
/// lean more.
pub(super) const LEAST_UPRIGHT: f64 = 0.104_528_463;

/// Azimuths that differ by less than this are the same, radians. Noise of a thousandth turns facets by less.
const SAME_AZIMUTH: f64 = 0.02;

/// Areas are equal if their ratio is below this.
const SAME_AREA: f64 = 1.01;

/// An outline that is longer than wide by more than this part of its width visibly has a width.
const LONG: f64 = 0.01;

/// Widths are equal if their ratio differs from 1 by less than this.
const SAME_WIDTH: f64 = 0.005;

/// Returns the pose of a stone whose axis is up already: its width along x, its middle on the axis, its girdle at z = 0, and
/// half its diameter 1.
pub(super) fn placed(even: &Even, areas: &[f64]) -> Result<Pose, FromMeshError> {
    let solid = Polytope::from_planes(&even.planes)?;
    let around = hull(solid.vertices().iter().map(|v| v.truncate()).collect());
    let turn = DQuat::from_rotation_z(-azimuth(even, areas, &around));
    let Outline { diameter, girdle_top, middle, .. } = Outline::of(&solid.reframed(&Pose::turned(turn)));
    let top = girdle_edge(&solid).unwrap_or(girdle_top);
    // The middle of a stone with rotational symmetry lies exactly on the axis.
    let middle = if even.turns > 1 { DVec2::ZERO } else { middle };
    let scale = 2.0 / diameter;
    Ok(Pose { at: -scale * middle.extend(top), turn, scale })
}

/// Returns z of the highest corner in which facets of the girdle meet facets of the crown, or, without a girdle, facets of
/// the pavilion meet facets of the crown; `None` where there is no such corner.
fn girdle_edge(solid: &Polytope) -> Option<f64> {
    let facing = |test: &dyn Fn(f64) -> bool| {
        let mut on = vec![false; solid.vertices().len()];
        let facets = solid.facets().iter().filter(|f| test(f.plane.normal.z));
        facets.flat_map(|f| &f.outline).for_each(|&v| on[v as usize] = true);
        on
    };
    let (up, down) = (facing(&|z| z >= LEAST_UPRIGHT), facing(&|z| z <= -LEAST_UPRIGHT));
    let upright = facing(&|z| z.abs() < LEAST_UPRIGHT);
    let highest = |test: &dyn Fn(usize) -> bool| {
        (0..up.len()).filter(|&v| test(v)).map(|v| solid.vertices()[v].z).max_by(f64::total_cmp)
    };
    highest(&|v| up[v] && upright[v]).or_else(|| highest(&|v| up[v] && down[v]))
}

/// Returns the rest of a known pose once the axis is up and the origin in its place.
pub(super) fn as_posed(even: &Even, pose: &Pose) -> Pose {
    let right = pose.turn * (even.turn.inverse() * DVec3::X);
    Pose { scale: pose.scale, ..Pose::turned(DQuat::from_rotation_z(right.y.atan2(right.x))) }
}

/// Returns the azimuth that becomes +x.
fn azimuth(even: &Even, areas: &[f64], rim: &[DVec2]) -> f64 {
    let mut candidates = candidates(even, rim);
    // Of equal directions, the one nearest to the surface's own x axis is taken, so that a surface in the right
    // position is not turned.
    let own = even.turn * DVec3::X;
    let apart = |azimuth: f64| -own.dot(DVec3::new(azimuth.cos(), azimuth.sin(), 0.0));
    candidates.sort_by(|&a, &b| apart(a).total_cmp(&apart(b)));
    let width = |azimuth: f64| {
        let along = DVec2::from_angle(azimuth);
        let (low, high) = span(rim.iter().map(|v| v.dot(along)));
        high - low
    };
    let least = candidates.iter().map(|&c| width(c)).fold(f64::INFINITY, f64::min);
    let widest = candidates.iter().map(|&c| width(c)).fold(0.0, f64::max);
    // A round stone is equally wide in all directions, except for its corners; a square one is narrowest from side to
    // side.
    let limit = if least >= ROUND * widest { f64::INFINITY } else { least * (1.0 + SAME_WIDTH) };
    let narrow = candidates.into_iter().filter(|&c| width(c) <= limit);
    let facing = |azimuth: f64| crown_facing(even, areas, azimuth);
    let better =
        |best: (f64, f64), c: f64| if facing(c) > best.0 * SAME_AREA { (facing(c), c) } else { best };
    narrow.fold((f64::NEG_INFINITY, 0.0), better).1
}

/// Returns the azimuths that may become +x: those of mirrors, else of facets, else of the outline.
fn candidates(even: &Even, rim: &[DVec2]) -> Vec<f64> {
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

/// Returns the direction in which an outline is narrowest; `None` where it is as wide as long.
fn narrow_axis(rim: &[DVec2]) -> Option<f64> {
    let found = Calipers::of_stone(rim).filter(|found| found.length > (1.0 + LONG) * found.width)?;
    Some(found.across.to_angle())
}

fn is_crown(plane: &Plane) -> bool {
    plane.normal.z >= LEAST_UPRIGHT && plane.normal.truncate().length() > SAME_AZIMUTH
}

/// Returns the area of the largest facet of the crown that faces an azimuth.
fn crown_facing(even: &Even, areas: &[f64], azimuth: f64) -> f64 {
    let toward = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0);
    let crown = even.planes.iter().zip(areas).filter(|(p, _)| is_crown(p));
    let faces = |p: &Plane| p.normal.dot(toward) >= SAME_AZIMUTH.cos() * p.normal.truncate().length();
    crown.filter(|(p, _)| faces(p)).map(|(_, area)| *area).fold(0.0, f64::max)
}
